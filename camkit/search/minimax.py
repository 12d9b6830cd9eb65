"""The smooth form of a study whose objective or limits are largest values of curves, and its descent by SLSQP.

A maximum over angles has a ridge wherever two angles share it, and there a gradient method stalls.  In epigraph
form a number ``t`` of its own bounds the whole curve, every angle becomes an inequality, and ``t`` is made small:
all functions are smooth again.  Limits on peaks become inequalities at every angle in the same way.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..quantities import CurveMeasure, Measure
from ..study.native import Answers
from ..study.slsqp import slsqp
from ..study.study import KEPT, Study
from ..study.weighted import Curve, is_curve, parts_of

STEP = 1e-6
"""Step of a central difference, as a share of the bounds' width."""
EDGE = 1e-12
"""A share of the bounds this near to one of them is that one: a roller of 5e-25 mm is none."""
BAD = 1e3
"""What stands for a design that cannot be built, in sizes of the objective at the start."""
SEEN, NEAR = 100, 0.02
"""Of each curve SLSQP sees at least so many points, evenly, and all that come this near to their bound."""
ROUNDS, STEPS = 20, 100
"""How often points are added at most, and how many steps SLSQP may take each time."""
SMALL, FLAT = 1e-3, 1e-4
"""A change as a share of the bounds, and how much of it the objective, in its own size, falls by where it is flat."""


class Descent(NamedTuple):
    """Where a descent ended: ``u`` are free values as shares of their bounds."""

    u: np.ndarray
    steps: int
    finished: bool


class Epigraph:
    """A study in ``(u, t)``: free values as shares of their bounds, and one ``t`` for each part of the objective.

    Points of curves and single numbers stand side by side as columns, first those of the objective over ``scale``,
    then those of the limits, which are kept where <= 0.  ``margins`` says for each limit how far inside it, as a
    share of it, the solution shall lie.  ``evaluations`` counts designs.

    A design and its neighbours are asked for in one call: those that no slope needs are not counted.
    """

    def __init__(self, study: Study, scale: float = 1.0, margins: float | np.ndarray = 0.0) -> None:
        self.study, self.scale = study, scale
        self.margins = np.broadcast_to(margins, len(study.limits))
        self.evaluations = 0
        self._last: tuple[bytes, np.ndarray] = b"", np.empty(0)
        self._asked = np.empty(0), np.empty(0)

    def tighten(self, margins: np.ndarray) -> None:
        """Tighten the limits further, each by a share of it."""
        self.margins, self._last = self.margins + margins, (b"", np.empty(0))

    def x(self, u: np.ndarray) -> np.ndarray:
        """Free values from shares of their bounds; a share that only rounding keeps from a bound is on it."""
        low, high = self.study.bounds
        return low + np.where(u < EDGE, 0.0, np.where(u > 1 - EDGE, 1.0, u)) * (high - low)

    def u(self, x: np.ndarray) -> np.ndarray:
        """Shares of the bounds from free values."""
        low, high = self.study.bounds
        return np.clip((x - low) / (high - low), 0, 1)

    @cached_property
    def _seen(self) -> tuple[list[tuple[float, Measure]], list[tuple[float, Measure]]]:
        """The parts of the objective and the limits, each a factor times a measure."""
        heads = [(factor / self.scale, part) for factor, part in parts_of(self.study.minimise[0])]
        return heads, [(sense / (abs(v) or 1.0), measure) for measure, v, sense in self.study.limits]

    @cached_property
    def answers(self) -> Answers:
        """What is said of all points, of a curve without its sign; and of each measure, where a search is followed."""
        seen = [
            Curve(m) if isinstance(m, CurveMeasure) and is_curve(m, factor) else m
            for factor, m in (*self._seen[0], *self._seen[1])
        ]
        more = self.study.measures if hasattr(self.study, "follow") else ()
        return Answers(self.study, tuple(self.study.free), (*seen, *more))

    @cached_property
    def _sizes(self) -> tuple[list[int], list[int]]:
        """How many columns each part of the objective has, and each limit."""
        self.evaluations += 1
        middle = self.study.analysis(self.x(np.full((1, len(self.study.free)), 0.5)))
        sizes = [each.of(middle, 1).size for each in self.answers.asked]
        heads, limits = map(len, self._seen)
        return sizes[:heads], sizes[heads : heads + limits]

    @cached_property
    def _factors(self) -> np.ndarray:
        """By what each column is multiplied."""
        factors = [f * m.sign if is_curve(m, f) else f for f, m in (*self._seen[0], *self._seen[1])]
        return np.repeat(factors, [*self._sizes[0], *self._sizes[1]])

    @cached_property
    def owner(self) -> np.ndarray:
        """The number of the ``t`` that bounds each column, -1 where 0 does."""
        heads, limits = self._sizes
        return np.append(np.repeat(np.arange(len(heads)), heads), np.full(sum(limits), -1))

    @cached_property
    def limit(self) -> np.ndarray:
        """The number of the limit of each column, -1 of those of the objective."""
        heads, limits = self._sizes
        return np.append(np.repeat(-1, sum(heads)), np.repeat(np.arange(len(limits)), limits))

    @cached_property
    def even(self) -> np.ndarray:
        """Some of the columns, evenly from each part and limit."""
        sizes = [*self._sizes[0], *self._sizes[1]]
        return np.concatenate([np.arange(size) % (size // SEEN + 1) == 0 for size in sizes])

    def columns(self, u: np.ndarray) -> np.ndarray:
        """All columns of designs ``(p, n)``; of a design that cannot be built all are ``BAD``."""
        return self._columns(self.x(u), self.answers(self.x(u)))

    def _columns(self, x: np.ndarray, told: np.ndarray) -> np.ndarray:
        limits = self.study.limits
        margins = np.broadcast_to(self.margins + self.study.tightening(x), (len(x), len(limits)))
        bounds = np.repeat([sense * np.sign(v) for _, v, sense in limits] - margins, self._sizes[1], axis=-1)
        c = self._factors * told[:, : len(self._factors)]
        c[:, len(self._factors) - bounds.shape[1] :] -= bounds
        c = np.maximum(c, -BAD)  # as infinite as a radius can be
        return np.where(np.isfinite(c).all(-1, keepdims=True), c, BAD)

    def at(self, u: np.ndarray) -> np.ndarray:
        """The columns of one design."""
        if self._last[0] != u.tobytes():
            x = self.x(np.vstack([u, *_beside(u)]))
            told = self.answers(x)
            self._last = u.tobytes(), self._columns(x, told)
            self._asked = x, told
            self._looked_at(slice(1))
        return self._last[1][0]

    def slopes(self, u: np.ndarray) -> np.ndarray:
        """Derivatives of the columns by ``u``: central differences within the bounds, by what `at` has asked for."""
        here, (up, down) = self.at(u), _beside(u)
        above, below = np.split(self._last[1][1:], 2)
        self._looked_at(slice(1, None))
        up, above = _only_built(above, (up, u), (above, here))
        down, below = _only_built(below, (down, u), (below, here))
        width = (up - down).sum(-1)
        return (above - below).T / np.where(width == 0, 1, width)

    def _looked_at(self, some: slice) -> None:
        """Count some of the designs that were asked for last, and hand them on to who follows the search."""
        x, told = (each[some] for each in self._asked)
        self.evaluations += len(x)
        if follow := getattr(self.study, "follow", None):
            follow(self.study.judged_by(x, told[:, len(self._factors) :]))

    def tops(self, c: np.ndarray) -> np.ndarray:
        """The least ``t`` that bound the columns."""
        return np.array([c[self.owner == k].max() for k in range(self.owner.max() + 1)])

    def excess(self, c: np.ndarray, t: np.ndarray) -> np.ndarray:
        """By how much each column lies above its bound."""
        return c - np.append(t, 0.0)[self.owner]

    def descend(self, u: np.ndarray, precision: float = 1e-12) -> Descent:
        """SLSQP from ``u``, on the columns that matter; whichever turns out to matter is added until all are kept."""
        c = self.at(u)
        t = self.tops(c)
        seen = self.even | (self.excess(c, t) > -NEAR)
        steps = 0
        for _ in range(ROUNDS):
            found = self._slsqp(u, t, np.flatnonzero(seen), precision)
            u, t = np.split(found.x, [len(u)])
            steps += found.nit
            broken = self.excess(self.at(u), t) > KEPT
            if not (broken & ~seen).any():
                return Descent(u, steps, bool(found.success) or self.is_flat(u, seen))
            seen |= broken
            t = self.tops(self.at(u))
        return Descent(u, steps, False)

    def is_flat(self, u: np.ndarray, seen: np.ndarray | slice = slice(None)) -> bool:
        """Whether no small change lowers the objective within its limits, to first order by linear programming.

        SLSQP says so itself where its line search does not end in the last digits, which differ between processors.
        """
        from scipy.optimize import linprog

        c, slopes = self.at(u), self.slopes(u)[seen]
        t = self.tops(c)
        by_t = (self.owner[seen, None] == np.arange(len(t))).astype(float)
        change = zip(np.maximum(-SMALL, -u), np.minimum(SMALL, 1 - u), strict=True)
        found = linprog(
            np.concatenate([np.zeros_like(u), np.ones_like(t)]),
            A_ub=np.hstack([slopes, -by_t]),
            b_ub=np.maximum(-self.excess(c, t)[seen], 0),
            bounds=[*change, *[(None, None)] * len(t)],
        )
        return bool(found.status == 0 and -found.fun <= FLAT * SMALL)

    def _slsqp(self, u: np.ndarray, t: np.ndarray, seen: np.ndarray, precision: float) -> Any:
        slope = np.concatenate([np.zeros_like(u), np.ones_like(t)])
        by_t = (self.owner[seen, None] == np.arange(len(t))).astype(float)

        def total(z: np.ndarray) -> float:
            return BAD if (self.at(z[: len(u)]) == BAD).all() else float(z[len(u) :].sum())

        def room(z: np.ndarray) -> np.ndarray:
            return -self.excess(self.at(z[: len(u)]), z[len(u) :])[seen]

        def room_slopes(z: np.ndarray) -> np.ndarray:
            return np.hstack([-self.slopes(z[: len(u)])[seen], by_t])

        whole = np.concatenate([u, t])
        return slsqp(whole, (total, lambda z: slope), (room, room_slopes), precision, STEPS, unbounded=len(t))


def _beside(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The neighbours of a design above and below, within the bounds, one for each free value."""
    steps = STEP * np.eye(len(u))
    return np.clip(u + steps, 0, 1), np.clip(u - steps, 0, 1)


def _only_built(c: np.ndarray, *pairs: tuple[np.ndarray, np.ndarray]) -> list[np.ndarray]:
    """The first of each pair, or the second where the design with the columns ``c`` cannot be built."""
    bad = (c == BAD).all(-1, keepdims=True)
    return [np.where(bad, second, first) for first, second in pairs]
