"""Dimensions: lengths as a drawing says them, with their limits, and the lines and arrows that carry them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...data import load
from ...quantities import quantities_of, value_of
from ...units import factor
from .blank import DIN, Blank, Keyway
from .svg import ARROW, Paper, text_width
from .written import LENGTHS

SIZE, BEYOND, AWAY = 3.5, 1.5, 0.8
"""Of a dimension's text, of what an extension line reaches beyond its dimension, and of its gap to the part, mm."""
DECIMALS = {"mm": 3, "in": 4}
SAME = 1e-7
"""Lengths that differ by less (m) are the same dimension."""


@dataclass(frozen=True)
class Words:
    """Lengths in the unit of a drawing, with the tolerances of a design's quantities by their paths (half widths, m).

    >>> Words("mm").length(0.03), Words("in").length(0.03), Words("mm").plus_minus(0.0002)
    ('30', '1.1811', ' ±0.2')
    """

    unit: str
    tolerances: Mapping[str, float] = field(default_factory=dict)

    @property
    def first_angle(self) -> bool:
        """Of the projection: as in Europe, for drawings in mm; drawings in inches have the third angle."""
        return self.unit == "mm"

    def length(self, value: float) -> str:
        said = f"{value / LENGTHS[self.unit]:z.{DECIMALS[self.unit]}f}"
        return said.rstrip("0").rstrip(".") if self.unit == "mm" else said

    def plus_minus(self, half: float) -> str:
        return f" ±{self.length(half)}" if half else ""

    def tolerance(self, design: object, name: str, value: float) -> float:
        """The half width given for the quantity of a ``name`` that has this ``value``, m; 0: none is given."""
        for path, declared in quantities_of(design).items():
            same = declared.unit == "mm" and abs(value_of(design, path) - value) < SAME
            if path.rpartition(".")[2] == name and same and path in self.tolerances:
                return self.tolerances[path]
        return 0.0

    def fit(self, value: float, name: str) -> tuple[float, float] | None:
        """Lower and upper limit (m) of a ``value`` in a fit of ``camkit/data/fits.json``; ``None``: it has none."""
        fit = load("fits")[name]
        size = value / factor(fit["of"])
        for over, to, limit in fit["rows"]:
            if over < size <= to * (1 + 1e-9):
                upper = limit * factor(fit["unit"])
                return (-upper if name == "JS9" else 0.0), upper
        return None

    def bore(self, blank: Blank) -> str:
        return f"Ø{self.length(blank.bore)}" + (" H7" if self.fit(blank.bore, "H7") else "")

    def key_width(self, blank: Blank) -> str:
        return self.length(_keyway(blank).width) + (" JS9" if blank.key == DIN else "")

    def key_reach(self, blank: Blank) -> str:
        """From the bore's far side to the bottom of the keyway."""
        said = self.length(blank.bore + _keyway(blank).depth)
        limits = self.fit(_keyway(blank).width, "hub depth") if blank.key == DIN else None
        return f"{said} +{self.length(limits[1])} / 0" if limits else said

    def limits(self, blank: Blank) -> list[str]:
        """What the fits of bore and keyway mean, a line for each."""
        found = []
        if blank.bore and (limits := self.fit(blank.bore, "H7")):
            found.append(f"{self.bore(blank)}: +{self.length(limits[1])} / 0")
        if blank.keyway and blank.key == DIN and (limits := self.fit(blank.keyway.width, "JS9")):
            found.append(f"{self.key_width(blank)}: ±{self.length(limits[1])}")
        return found


def _keyway(blank: Blank) -> Keyway:
    assert blank.keyway is not None
    return blank.keyway


def across(paper: Paper, left: float, right: float, part: float, level: float, text: str) -> None:
    """A dimension of a width, ``left`` to ``right``, of what ends at the height ``part``, written at a ``level``."""
    way = np.sign(level - part)
    for x in (left, right):
        paper.line((x, part + AWAY * way), (x, level + BEYOND * way))
    inside = right - left > text_width(text, SIZE) + 2 * ARROW + 1
    reach = 0.0 if inside else 2 * ARROW
    paper.line((left - reach, level), (right + reach, level))
    way_in = 1.0 if inside else -1.0
    paper.arrow((left, level), (-way_in, 0.0))
    paper.arrow((right, level), (way_in, 0.0))
    if inside:
        paper.text(((left + right) / 2, level - 0.8), text, SIZE, "middle")
    else:
        paper.text((right + reach + 1, level + 0.35 * SIZE), text, SIZE)


def upright(paper: Paper, ends: tuple[float, float], part: float, level: float, text: str) -> None:
    """A dimension of a height, written at the ``level`` to the right or left of what ends at ``part``."""
    way, (top, bottom) = np.sign(level - part), sorted(ends)
    for y in (top, bottom):
        paper.line((part + AWAY * way, y), (level + BEYOND * way, y))
    inside = bottom - top > 2 * ARROW + 1
    reach = 0.0 if inside else 2 * ARROW
    paper.line((level, top - reach), (level, bottom + reach))
    way_in = 1.0 if inside else -1.0
    paper.arrow((level, top), (0.0, -way_in))
    paper.arrow((level, bottom), (0.0, way_in))
    if bottom - top > text_width(text, SIZE) + 2 * ARROW + 1:
        paper.text((level - 0.8, (top + bottom) / 2), text, SIZE, "middle", upright=True)
    else:
        side = "start" if way > 0 else "end"
        paper.text((level + way * (BEYOND + 0.8), (top + bottom) / 2 + 0.35 * SIZE), text, SIZE, side)
