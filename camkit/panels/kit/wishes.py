"""What is wanted of a design: for each of its measures whether it is to be small or large, and between which limits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from ...quantities import Measure, PeakMeasure
from ...units import factor, in_unit
from .inputs import Amount, Menu
from .parts import Group, Part, Words, row
from .quiet import Quiet

GOALS = ("–", 0), ("small", 1), ("large", -1)
LIMITS = ("–", ()), ("at most", (1,)), ("at least", (-1,)), ("between", (-1, 1))
"""By their senses: +1 for at most, -1 for at least."""
DIGITS = 4
"""So many has a limit that nobody has typed yet."""


class Wish:
    """One row: what is wanted of a measure, beside its value now.

    A limit is exact as long as nobody types another; one that nobody has typed begins at the value now.
    """

    def __init__(self, measure: Measure) -> None:
        self.measure, self._now, self._quiet = measure, np.nan, Quiet()
        self._held: dict[int, float] = {}
        self.name, self.now = Words(value=[measure.name]), Words(look="right")
        self.goal = Menu(GOALS, tooltip=f"{measure.name}: make it")
        self.limit = Menu(LIMITS, tooltip=f"{measure.name}: keep it")
        self.boxes = {sense: self._box(sense) for sense in (-1, 1)}
        self._limits = row(*self.boxes.values(), look="limits")
        self._show()
        self._quiet.hear(self.limit, lambda _: self._show())

    def _box(self, sense: int) -> Amount:
        said = "at most" if sense > 0 else "at least"
        box = Amount(unit=self.measure.unit, description=f"{self.measure.name}, {said}")
        self._quiet.hear(box, lambda value: self._held.update({sense: value * factor(self.measure.unit)}))
        return box

    @property
    def parts(self) -> tuple[Part, ...]:
        """What stands in the row."""
        return self.name, self.now, self.goal, self.limit, self._limits

    def follow(self, now: float) -> None:
        """Show the value of another design."""
        self._now = now
        self.now.say(self.measure.text(now) if np.isfinite(now) else "–")

    def _show(self) -> None:
        """Boxes for the limits that there are; what nobody has typed begins at the value now."""
        with self._quiet:
            for sense, box in self.boxes.items():
                box.visible = sense in self.limit.value
                if box.visible and sense not in self._held:
                    self._held[sense] = self._rounded(sense) * factor(self.measure.unit)
                if box.visible:
                    box.value = in_unit(self._held[sense], self.measure.unit)

    def _rounded(self, sense: int) -> float:
        """The value now in its unit with four digits, so that it keeps the limit."""
        value = in_unit(self._now, self.measure.unit) if np.isfinite(self._now) else 0.0
        step = 10.0 ** (np.floor(np.log10(abs(value))) + 1 - DIGITS) if value else 1.0
        return float(f"{sense * np.ceil(sense * value / step - 1e-9) * step:.{DIGITS}g}")

    @property
    def objective(self) -> Measure | None:
        """The measure as a search makes it small; ``None`` if nothing is wanted of it."""
        return {0: None, 1: self.measure, -1: -self.measure}[self.goal.value]

    @property
    def limits(self) -> dict[int, float]:
        """The limits (SI) by their senses."""
        return {sense: self._held[sense] for sense in self.limit.value}

    def ask(self, goal: int, limits: Mapping[int, float]) -> None:
        """Want something else."""
        with self._quiet:
            self._held.update(limits)
            self.goal.value, self.limit.value = goal, tuple(sorted(limits))
        self._show()


class Wishes:
    """A row for each measure; ``part`` is all of them."""

    def __init__(self, measures: Iterable[Measure]) -> None:
        self.rows = {measure: Wish(measure) for measure in measures}
        self._heads = [Words(value=[head], look="hint") for head in ("measure", "now", "make it", "keep it")]
        self.part = Group(look="wishes")

    def follow(self, analysis: object) -> None:
        """Show the values of another design."""
        for measure, wish in self.rows.items():
            wish.follow(measure.one(analysis))

    def ask(self, minimise: Iterable[Measure], limits: Iterable[tuple[Measure, float, int]]) -> None:
        """Want this of the measures, which come first then, and nothing of the others."""
        wanted: dict[Measure, tuple[int, dict[int, float]]] = {}
        for objective in minimise:
            measure, sign = self._read(objective)
            wanted[measure] = sign, {}
        for limited, limit, sense in limits:
            measure, sign = self._read(limited)
            wanted.setdefault(measure, (0, {}))[1][sign * sense] = sign * limit
        self.rows = {m: self.rows.get(m) or Wish(m) for m in dict.fromkeys((*wanted, *self.rows))}
        for measure, wish in self.rows.items():
            wish.ask(*wanted.get(measure, (0, {})))
        self.part.children = (*self._heads, *(part for wish in self.rows.values() for part in wish.parts))

    def _read(self, measure: Measure) -> tuple[Measure, int]:
        """The measure of a row, and whether this is that one (1) or its opposite (-1)."""
        least = isinstance(measure, PeakMeasure)  # the opposite of the largest of opposites
        other = measure not in self.rows and measure.sign < 0 and not least
        return (-measure, -1) if other or -measure in self.rows else (measure, 1)

    @property
    def minimise(self) -> tuple[Measure, ...]:
        """The objectives, in the order of the rows."""
        return tuple(wanted for wish in self.rows.values() if (wanted := wish.objective) is not None)

    def limits(self, sense: int) -> dict[Measure, float]:
        """The limits of a sense (SI) by measure."""
        return {m: wish.limits[sense] for m, wish in self.rows.items() if sense in wish.limits}
