"""What stands on every sheet and in the head of every file: what it is, who made it, when, with which camkit."""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import date
from importlib.metadata import version

from ...quantities.kinds import refuse_kinds

_PARTS = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


@dataclass(frozen=True)
class TitleBlock:
    """The words of a title block; what is left empty is filled in or left out.

    >>> TitleBlock(number="C-17", author="M. Curie", date="2026-11-30").lines("TranslatingRollerCam", "mm")[0]
    'Translating roller cam, C-17'
    """

    title: str = ""
    """Empty: the kind of the design in words."""
    number: str = ""
    """Of the drawing."""
    author: str = ""
    material: str = ""
    date: str = ""
    """Empty: today."""
    faults: tuple[str, ...] = ()
    """What is wrong with the design, in sentences, to be marked on every sheet: it is made nevertheless."""

    def __post_init__(self) -> None:
        refuse_kinds(self)

    def name(self, kind: str) -> str:
        """The title, or the ``kind`` of the design (the name of its class) in words."""
        return self.title or (kind if kind.isupper() else _PARTS.sub(" ", kind).capitalize())

    def marked(self, kind: str) -> str:
        """The name, which says so where the design is faulty."""
        return f"FAULTY: {self.name(kind)}" if self.faults else self.name(kind)

    @property
    def day(self) -> str:
        """The date, as it stands or today's."""
        return self.date or date.today().isoformat()

    def lines(self, kind: str, unit: str, tolerance: str = "") -> tuple[str, ...]:
        """The lines that say where a file comes from: title, faults, units and tolerance, version, date, author."""
        named = ", ".join(filter(None, (self.name(kind), self.number)))
        units = f"lengths in {'inches' if unit == 'in' else unit}" + (f", {tolerance}" if tolerance else "")
        made = f"camkit {version('camkit')}, {self.day}" + (f", {self.author}" if self.author else "")
        about = (f"material: {self.material}",) if self.material else ()
        return (named, *(f"FAULTY: {fault}" for fault in self.faults), units, *about, made)
