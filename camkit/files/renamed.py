"""What had another name in an earlier camkit: one table, by which files that have the earlier names are read."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any

RENAMED: dict[tuple[str, str], str] = {}
"""``{(where, earlier name): name of today}``.

``where`` is the class whose field or path it is, such as ``"HighSpeedCam"``; or ``"kind"`` for a class, ``"measure"``
for a measure, ``"rule"`` or ``"mode"`` for an entry of a search's menus.  Names stand without their units.  What was a
field of its own and stands deeper in the design today has a path for its new name, such as ``"load.spring_rate"``; the
order of a file's entries then is the order in which they are put in, so a law comes before its coefficients.  What is
renamed twice has a row for each of its earlier names.
"""

MEASURES_AT = ("at_most", "at_least", "made", "weights")
"""Entries of a study whose keys are measures."""


@dataclass(frozen=True)
class Renaming:
    """Puts the names of today into what a file holds; ``kinds`` are those that there are today.

    >>> renaming = Renaming({"Cam"}, {("Cam", "largest_radius"): "max_radius"})
    >>> renaming.design({"kind": "Cam", "largest_radius [mm]": 130.0}), renaming.remarks
    ({'kind': 'Cam', 'max_radius [mm]': 130.0}, ['largest radius is now max radius'])
    """

    kinds: Collection[str]
    table: dict[tuple[str, str], str] = field(default_factory=lambda: RENAMED)
    renamed: dict[str, str] = field(default_factory=dict)
    """What was renamed, each once."""

    @property
    def remarks(self) -> list[str]:
        """What is to be remarked about it."""
        each = ", ".join(f"{before} is now {now}" for before, now in self.renamed.items())
        return [each.replace("_", " ")] if each else []

    def name(self, where: str, entry: Any) -> Any:
        """The name of today for ``entry``, its unit and its sign kept; anything but a name as it is."""
        if not isinstance(entry, str):
            return entry
        minus = "-" if where == "measure" and entry.startswith("-") else ""
        before, bracket, unit = entry.removeprefix(minus).partition(" [")
        now = self.table.get((where, before), before)
        if now != before:
            self.renamed[before] = now
        return f"{minus}{now}{bracket}{unit}"

    def design(self, entry: Any) -> Any:
        """A design, a law, or whatever else says its kind, and all that is inside it."""
        if isinstance(entry, list):
            return [self.design(each) for each in entry]
        if not isinstance(entry, dict):
            return entry
        kind = entry.get("kind")
        kind = kind if isinstance(kind, str) and kind in self.kinds else self.name("kind", kind)
        inner = {self.name(str(kind), k): self.design(v) for k, v in entry.items() if k != "kind"}
        return {"kind": kind, **inner} if "kind" in entry else inner

    def study(self, entry: Any) -> Any:
        """A study, and all that is saved with it."""
        if not isinstance(entry, dict):
            return entry
        parts = {k: self._part(k, v) for k, v in entry.items()}
        start = parts.get("start")
        where = str(start.get("kind")) if isinstance(start, dict) else ""
        if isinstance(entry.get("free"), dict):
            parts["free"] = {self.name(where, k): bounds for k, bounds in entry["free"].items()}
        return parts

    def _part(self, name: str, entry: Any) -> Any:
        if name in ("start", "design"):
            return self.design(entry)
        if name in MEASURES_AT and isinstance(entry, dict):
            return {self.name("measure", k): v for k, v in entry.items()}
        if name in ("minimise", "sums") and isinstance(entry, list):
            return [self._objective(each) for each in entry]
        if name == "search" and isinstance(entry, dict):
            return {k: self.name(k, v) for k, v in entry.items()}
        return entry

    def _objective(self, entry: Any) -> Any:
        """The name of a measure, or a weighted sum of measures."""
        if isinstance(entry, dict):
            return {k: self._part(k, v) for k, v in entry.items()}
        return self.name("measure", entry)
