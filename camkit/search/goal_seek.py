"""`goal_seek`: the least change of the free quantities that gives a measure a wanted value.

It asks the study backwards: what must change for the pressure angle to be 25 deg?
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..quantities import D
from ..quantities.kinds import finite, one_number, refuse_arguments
from ..quantities.types import Array
from ..study.slsqp import slsqp
from ..study.study import KEPT, Evaluation, Study
from .minimax import BAD, NEAR, Epigraph
from .minimise import TRIES
from .minimum import SAME, Found, Minimum, described, listed

REACHED = 1e-6
"""A wanted value is reached to within this share of itself."""
ENDED = "Ended"
CROWD = 128
"""So many random designs say where else a search can begin."""
HILLS = 2
"""So many of the highest hills of a curve are tried where its peak has to grow."""
ROUNDS = 8
"""How often points of curves that turn out to matter are added."""
STEPS, PRECISION, ROUGH = 60, 1e-12, 1e-5
"""How many steps SLSQP may take each time, how exactly it ends, and how exactly where the value is not reached."""


def goal_seek(study: Study[D], value: float) -> Minimum[D]:
    """The design nearest to the study's start whose objective has ``value`` (SI) and that keeps every limit.

    Near means a small sum of squared changes, each as a share of its bounds' width.  Where no such design is found the
    result is the one that comes nearest to the value, and ``message`` says what stops it there; ``f`` is what was
    reached, in the sense of the study (``-measure`` is minimised as its negative).

    >>> from camkit import mm, shaft_study
    >>> found = goal_seek(shaft_study(), 5000 * mm**2)
    >>> found.message, found.design.outer_diameter > shaft_study().start.outer_diameter
    ('The area of the tube is 5000 mm^2.', True)

    Raises ``ValueError`` for a study with several objectives, and a value that is no finite number.
    """
    refuse_arguments(goal_seek, locals())
    if len(study.minimise) != 1:
        raise ValueError(f"the study has {len(study.minimise)} objectives; a wanted value is that of one measure")
    measure = study.minimise[0]
    value = one_number(value, f"the wanted {measure.name}", "be a finite number", finite)
    problem = _Nearest(study, value)
    found = problem.sought()
    if found is None:
        end = problem.farthest(problem.start)
        if problem.passed(end):  # the start misses limits
            problem.down = not problem.down
            end = problem.farthest(end)
        return _stopped(problem, problem.told(end))
    told = problem.told(found)
    return replace(told, message=f"The {measure.name} is {measure.text(measure.sign * told.f)}.")


def _stopped(problem: _Nearest, end: Minimum[D]) -> Minimum[D]:
    """The design that comes nearest, and in words what holds it."""
    measure = end.study.minimise[0]
    text = f"The {measure.name} cannot be {measure.text(measure.sign * problem.value)}"
    if not end.feasible:
        return replace(end, message=f"{text}. {end.message.removeprefix(f'{ENDED}. ')}")
    held = ["its own limit" if a.name == measure.name else str(a) for a in end.active if a.kind != "peak"]
    by = f"; it is held by {listed(held)}" if held else ""
    which = "lowest" if problem.down == (measure.sign > 0) else "highest"
    return replace(end, message=f"{text}: the {which} found is {measure.text(measure.sign * end.f)}{by}.")


class _Nearest:
    """Least change of the free values, as shares of their bounds, so that the objective comes to ``value``.

    Where it has to fall, every point of its curve lies below; where it has to grow, the largest lies above.
    """

    def __init__(self, study: Study, value: float) -> None:
        self.study, self.value = study, value
        self.start = np.clip(study.x0, *study.bounds)
        now = float(study.evaluate(self.start).f[0, 0])
        self.now = abs(now) if np.isfinite(now) else 0.0
        self.size = abs(value) or self.now or 1.0
        self.epigraph = Epigraph(study, self.size, KEPT / 2)
        self.start = self.epigraph.u(self.start)
        self.down = not now < value
        self.evaluations, self.off = 0, 0.0

    def judged(self, u: Array) -> Evaluation:
        return self.study.evaluate(self.epigraph.x(u))

    def reached(self, u: Array) -> bool:
        """Whether a design keeps every limit and has the value."""
        there = self.judged(u)
        return bool(there.feasible[0] and abs(there.f[0, 0] - self.value) <= REACHED * self.size)

    def passed(self, u: Array) -> bool:
        """Whether a design that keeps every limit lies on the other side of the value than the start."""
        there = self.judged(u)
        return bool(there.feasible[0] and (there.f[0, 0] <= self.value) == self.down)

    def told(self, u: Array) -> Minimum:
        """A design, and in words what holds it."""
        count = self.evaluations + self.epigraph.evaluations
        return described(self.study, Found(self.epigraph.x(u), count, (), ENDED))

    def sought(self) -> Array | None:
        """The nearest design that has the value, sought from the start, then from others near the value."""
        found = self.solve(self.start)
        if not self.reached(found) and self.passed(found):  # limits have driven it past the value
            found = self.solve(found, exactly=True)
        others = iter(self.others if not self.reached(found) else ())
        while not self.reached(found):
            begin = next(others, None)
            if begin is None:
                return None
            found = self.solve(begin, exactly=True)
        return found

    @property
    def others(self) -> Array:
        """Of random designs that keep every limit and lie beyond the value those nearest to it, ``(up to 2, n)``."""
        crowd = np.random.default_rng(1).random((CROWD, len(self.start)))
        there = self.study.evaluate(self.epigraph.x(crowd))
        self.evaluations += CROWD
        beyond = there.feasible & ((there.f[:, 0] <= self.value) == self.down)
        near = np.argsort(np.where(beyond, abs(there.f[:, 0] - self.value), np.inf), kind="stable")
        return crowd[near[: min(2, beyond.sum())]]

    def farthest(self, u: Array) -> Array:
        """How far the objective comes from ``u`` towards the value within the limits."""
        there = self.study if self.down else self.study.replace(minimise=(-self.study.minimise[0],))
        descent = Epigraph(there, self.now or self.size, 2 * ROUGH)  # the value may be far away
        for _ in range(TRIES if (descent.at(u) != BAD).any() else 0):
            u = descent.descend(u, ROUGH).u
            missed = self.judged(u).missed[0]
            if not missed.any() or missed.max() > SAME:
                break
            descent.tighten(1.1 * missed)
        self.evaluations += descent.evaluations
        return u

    def solve(self, u: Array, exactly: bool = False) -> Array:
        """The least change, sought from ``u``, with the objective at the value or beyond it, or ``exactly`` there."""
        if (self.epigraph.at(u) == BAD).all():
            return u
        self.below, self.above = self.down or exactly, exactly or not self.down
        for _ in range(TRIES):
            ends = [self._solved(u, hill) for hill in self._hills(u)]
            u = min(ends, key=lambda end: (not self.reached(end), ((end - self.start) ** 2).sum()))
            if self.reached(u) or not self._corrected(u):
                break
        return u

    def _corrected(self, u: Array) -> bool:
        """Whether a design misses by a hair, by which value and limits are moved: points of a curve are not exact."""
        there, top = self.judged(u), self.epigraph.at(u)[self._head].max()
        missed, off = there.missed[0], there.f[0, 0] / self.size - top
        if not (missed.max(initial=0.0) < SAME and abs(off) < SAME):
            return False
        self.off = float(off)
        self.epigraph.tighten(1.1 * missed)
        return True

    def _hills(self, u: Array) -> Array:
        """Which of the objective's points can be the largest: the highest of its hills where it has to grow."""
        curve = self.epigraph.at(u)[self._head]
        padded = np.concatenate([[-np.inf], curve, [-np.inf]])
        hills = np.flatnonzero((curve >= padded[:-2]) & (curve > padded[2:]))
        return hills[np.argsort(-curve[hills], kind="stable")][: HILLS if self.above and not self.below else 1]

    def _solved(self, u: Array, hill: int) -> Array:
        self.hill = hill
        seen = np.append(self.epigraph.even, True) | (self._excess(u) > -NEAR)
        for _ in range(ROUNDS):
            u = np.clip(self._slsqp(u, np.flatnonzero(seen)).x, 0, 1)
            broken = self._excess(u) > KEPT
            if not (broken & ~seen).any():
                break
            seen |= broken
        return u

    def _excess(self, u: Array) -> Array:
        """By how much the objective's points lie above the value, limits above 0, the largest point below the value."""
        c, head = self.epigraph.at(u), self._head
        if (c == BAD).all():
            return np.full(len(c) + 1, BAD)
        above = c[head] + self.off - self.value / self.size
        top = -(above.max() if self.below else above[self.hill])
        return np.concatenate([above if self.below else -np.ones_like(above), c[~head], [top if self.above else -1]])

    def _slopes(self, u: Array) -> Array:
        slopes, head = self.epigraph.slopes(u), self._head
        top = slopes[head][self.epigraph.at(u)[head].argmax() if self.below else self.hill]
        return np.vstack([slopes[head] * self.below, slopes[~head], -top * self.above])

    @property
    def _head(self) -> Array:
        """Which columns are the objective's: they come first."""
        return self.epigraph.owner >= 0

    def _slsqp(self, u: Array, seen: Array) -> Any:
        change = lambda z: 0.5 * float(((z - self.start) ** 2).sum()), lambda z: z - self.start
        room = lambda z: -self._excess(z)[seen], lambda z: -self._slopes(z)[seen]
        return slsqp(u, change, room, PRECISION, STEPS)
