"""What had another name in an earlier camkit: one table, by which files that have the earlier names are read."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any

from ..units import factor

RENAMED: dict[tuple[str, str], str] = {
    ("DoorHandleCam", "friction"): "friction.coefficient",
    ("DoorHandleCam", "cam_friction_circle"): "friction.cam_axis",
    ("DoorHandleCam", "roller_friction_circle"): "friction.roller_pin",
    ("DoorHandleCam", "pivot_friction_circle"): "friction.arm_pivot",
    ("DoorHandleCam", "lift_arm_mass"): "lift_load.mass",
    ("DoorHandleCam", "handle_speed"): "lift_load.speed [rpm]",
    ("DoorHandleCam", "door_torque"): "lift_load.torque",
    ("DoorHandleCam", "door_spring"): "lift_load.spring_rate",
    ("DoorHandleCam", "gravity"): "lift_load.gravity",
    ("DoorHandleCam", "up_angle"): "lift_load.up_angle",
    ("DoorHandleCam", "door_torque_table"): "lift_load.torque_table",
    ("DoorHandleCam", "relief_arm_mass"): "relief_load.mass",
    ("DoorHandleCam", "flap_torque"): "-relief_load.torque",
    **{
        (cam, before): now
        for cam in ("HighSpeedCam", "CamLever")
        for before, now in {
            "rise_law": "rise_law.base",
            "return_law": "return_law.base",
            "family": "rise_law.family, return_law.family",
            **{f"{law}_c{i}": f"{law}_law.c{i}" for law in ("rise", "return") for i in range(4)},
            "contact_width": "contact.width",
            "cam_modulus": "contact.cam_modulus",
            "roller_modulus": "contact.follower_modulus",
        }.items()
    },
}
"""``{(where, earlier name): name of today}``.

``where`` is the class whose field or path it is, such as ``"HighSpeedCam"``; or ``"kind"`` for a class, ``"measure"``
for a measure, ``"rule"`` or ``"mode"`` for an entry of a search's menus.  Names stand without their units, but for a
new name whose number has another unit today; a minus before it stands for a number of the other sign.  What was a
field of its own and stands deeper in the design today has a path for its new name, such as ``"load.spring_rate"``; the
order of a file's entries then is the order in which they are put in, so a law comes before its coefficients.  What was
one and is several today has their paths with commas between.  What is renamed twice has a row for each of its earlier
names.
"""

MANY = 4
"""So many names are remarked on by name."""
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
        each = [f"{before} is now {now}".replace("_", " ") for before, now in self.renamed.items()]
        more = f" and {len(each) - MANY} names more are others" * (len(each) > MANY)
        return [", ".join(each[:MANY]) + more] if each else []

    def name(self, where: str, entry: Any) -> Any:
        """The name of today for ``entry``, its unit and its sign kept; anything but a name as it is."""
        if not isinstance(entry, str):
            return entry
        minus = "-" if where == "measure" and entry.startswith("-") else ""
        before, bracket, unit = entry.removeprefix(minus).partition(" [")
        now = self.table.get((where, before), before)
        if now == before:
            return entry
        now, other, changed = now.partition(" [") if where in self.kinds else (now, "", "")
        self.renamed[before] = now.removeprefix("-") if where in self.kinds else now
        return f"{minus}{self.renamed[before]}{other or bracket}{changed or unit}"

    def times(self, where: str, name: str) -> float:
        """What the number of a field or path of an earlier name is multiplied by."""
        before, _, unit = name.removesuffix("]").partition(" [")
        now, _, changed = self.table.get((where, before), "").removesuffix("]").partition(" [")
        return (-1.0 if now.startswith("-") else 1.0) * (factor(unit) / factor(changed) if changed else 1.0)

    def design(self, entry: Any) -> Any:
        """A design, a law, or whatever else says its kind, and all that is inside it."""
        if isinstance(entry, list):
            return [self.design(each) for each in entry]
        if not isinstance(entry, dict):
            return entry
        kind = entry.get("kind")
        kind = kind if isinstance(kind, str) and kind in self.kinds else self.name("kind", kind)
        earlier = any(self._is_earlier(str(kind), k) for k in entry)
        fields = (self._field(str(kind), k, v, earlier) for k, v in entry.items() if k != "kind")
        inner = {path: value for names, value in fields for path in names.split(", ")}
        return {"kind": kind, **inner} if "kind" in entry else inner

    def _is_earlier(self, kind: str, name: str) -> bool:
        """Whether this was the name of a field, and is none today."""
        before = name.partition(" [")[0]
        return (kind, before) in self.table and not self.table[kind, before].startswith(f"{before}.")

    def _field(self, kind: str, name: str, entry: Any, earlier: bool) -> tuple[str, Any]:
        """A field of today, or several; a name that is also one of today's is renamed only among ``earlier`` ones."""
        if not earlier:
            return name, self.design(entry)
        return self.name(kind, name), _multiplied(self.design(entry), self.times(kind, name))

    def study(self, entry: Any) -> Any:
        """A study, and all that is saved with it."""
        if not isinstance(entry, dict):
            return entry
        parts = {k: self._part(k, v) for k, v in entry.items()}
        start = parts.get("start")
        where = str(start.get("kind")) if isinstance(start, dict) else ""
        if isinstance(entry.get("free"), dict):
            times = [self.times(where, k) for k in entry["free"]]
            bounds = [_multiplied(ends, t) for ends, t in zip(entry["free"].values(), times, strict=True)]
            parts["free"] = dict(zip((self.name(where, k) for k in entry["free"]), bounds, strict=True))
            if any(t != 1 for t in times) and isinstance(entry.get("front"), list):
                parts["front"] = [
                    [x * t for x, t in zip(row, times, strict=False)] if len(row) == len(times) else row
                    for row in entry["front"]
                ]
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


def _multiplied(entry: Any, times: float) -> Any:
    """A number, or each in a list; anything else is left to what reads it."""
    if times == 1:
        return entry
    if isinstance(entry, list):
        each = [_multiplied(x, times) for x in entry]
        return each[::-1] if times < 0 else each  # bounds stay in order
    return entry * times + 0.0 if isinstance(entry, (int, float)) and not isinstance(entry, bool) else entry
