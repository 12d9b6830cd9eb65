"""What holds at a transition, or at a point inside a polynomial: s, v, a, j each matched, free or a value."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from ...motion import Boundary, Through
from ...motion.parts import FREE, MATCH
from ...units import deg, in_unit
from ...views.laws import MotionUnits
from .inputs import Amount, Menu
from .parts import icon, row
from .quiet import Quiet

LETTERS = ("s", "v", "a", "j")
NAMES = ("position", "velocity", "acceleration", "jerk")
VALUE = "value"
USUAL = Boundary()
"""What holds at a transition of which nothing is said."""
DIGITS = 6
"""Of a value that is taken from the motion as it is; one that is shown has one more."""

Wanted = float | str
"""A value (m or rad, per rad^k), ``match`` or ``free``."""


class Condition:
    """One of s, v, a, j: a menu, and a box where a value is given; ``take(k, wanted)`` hears of another."""

    def __init__(self, k: int, options: Sequence[str], quiet: Quiet, take: Callable[[int, Wanted], None]) -> None:
        self.k, self._take = k, take
        self.menu = Menu((*options, VALUE), LETTERS[k], tooltip=NAMES[k])
        self.box = Amount(description=f"{NAMES[k]} given", tooltip=NAMES[k])
        self.group = row(self.menu, self.box, look="condition")
        self._now, self._factor = 0.0, 1.0
        quiet.hear(self.menu, lambda wanted: take(k, self._now if wanted == VALUE else wanted))
        quiet.hear(self.box, lambda value: take(k, value * self._factor))

    def show(self, wanted: Wanted, now: float, units: MotionUnits, usual: bool) -> None:
        """Show what is ``wanted``, where ``now`` is what the motion has; what is ``usual`` is pale."""
        given = not isinstance(wanted, str)
        self._factor = units.factor(self.k)
        self._now = float(f"{now / self._factor:.{DIGITS}g}") * self._factor
        self.menu.value = VALUE if given else wanted
        self.box.visible, self.box.unit = given, units.name(self.k)
        if given:
            self.box.value = float(f"{float(wanted) / self._factor:.{DIGITS + 1}g}")
        self.group.look = "condition usual" if usual else "condition"


class BoundaryRow:
    """The conditions of one transition."""

    def __init__(self, quiet: Quiet, take: Callable[[int, Wanted], None]) -> None:
        self.conditions = [Condition(k, (MATCH, FREE), quiet, take) for k in range(4)]
        self.group = row(*(condition.group for condition in self.conditions), look="boundary")

    def show(self, boundary: Boundary, now: Sequence[float], units: MotionUnits) -> None:
        """Show the conditions of a boundary; ``now`` are s, v, a, j there."""
        for condition, letter, there in zip(self.conditions, LETTERS, now, strict=True):
            wanted = getattr(boundary, letter)
            condition.show(wanted, there, units, wanted == getattr(USUAL, letter))


class PointRow:
    """A point inside a polynomial: where it is, and s, v, a there; ``take(make)`` gets another, or none."""

    def __init__(self, quiet: Quiet, take: Callable[[Callable[[], Through | None]], None]) -> None:
        self.place = Amount(description="at", unit="deg", named=True, tooltip="cam angle from the start of the segment")
        self.conditions = [Condition(k, (FREE,), quiet, self._given) for k in range(3)]
        self._take = take
        drop = icon("−", lambda: take(lambda: None), "remove this point")
        self.group = row(self.place, *(one.group for one in self.conditions), drop, look="boundary point")
        quiet.hear(self.place, self._placed)

    def show(self, point: Through, angle: float, now: Sequence[float], units: MotionUnits) -> None:
        """Show a point of a segment that takes ``angle`` (rad); ``now`` are s, v, a, j there."""
        self.point = point
        self.place.value = round(in_unit(float(point.place(angle)) * angle, "deg"), 9)
        for condition, letter, there in zip(self.conditions, LETTERS, now, strict=False):
            wanted = getattr(point, letter)
            condition.show(FREE if wanted is None else wanted, there, units, wanted is None)

    def _placed(self, angle: float) -> None:
        point = self.point
        self._take(lambda: replace(point, share=None, angle=angle * deg))

    def _given(self, k: int, wanted: Wanted) -> None:
        point = self.point
        given: dict[str, Any] = {LETTERS[k]: None if isinstance(wanted, str) else wanted}
        self._take(lambda: replace(point, **given))
