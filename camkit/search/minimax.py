"""The smooth form of a study whose objective or limits are largest values of curves, and its descent by SLSQP.

A maximum over angles has a ridge wherever two angles share it, and there a gradient method stalls.  In epigraph
form a number ``t`` of its own bounds the whole curve, every angle becomes an inequality, and ``t`` is made small:
all functions are smooth again.  Limits on peaks become inequalities at every angle in the same way.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..study.slsqp import slsqp
from ..study.study import KEPT, Study
from ..study.weighted import parts_of, points_of

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
    """

    def __init__(self, study: Study, scale: float = 1.0, margins: float | np.ndarray = 0.0) -> None:
        self.study, self.scale = study, scale
        self.margins = np.broadcast_to(margins, len(study.limits))
        self.evaluations = 0
        self._last: tuple[bytes, np.ndarray] = b"", np.empty(0)

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

    def _blocks(self, u: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """The points of each part of the objective and of each limit, for designs ``(p, n)``."""
        self.evaluations += len(u)
        x = self.x(u)
        p, analysis, heads = len(u), self.study.analysis(x), []
        for factor, part in parts_of(self.study.minimise[0]):
            heads.append(points_of(part, analysis, factor / self.scale, p))
        margins = np.broadcast_to(self.margins + self.study.tightening(x), (p, len(self.study.limits)))
        limits = [
            points_of(m, analysis, sense / (abs(v) or 1.0), p) - (sense * np.sign(v) - margin[:, None])
            for (m, v, sense), margin in zip(self.study.limits, margins.T, strict=True)
        ]
        return heads, limits

    @cached_property
    def _sizes(self) -> tuple[list[int], list[int]]:
        """How many columns each part of the objective has, and each limit."""
        heads, limits = self._blocks(np.full((1, len(self.study.free)), 0.5))
        return [block.shape[1] for block in heads], [block.shape[1] for block in limits]

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
        heads, limits = self._blocks(u)
        c = np.maximum(np.concatenate([*heads, *limits], axis=-1), -BAD)  # as infinite as a radius can be
        return np.where(np.isfinite(c).all(-1, keepdims=True), c, BAD)

    def at(self, u: np.ndarray) -> np.ndarray:
        """The columns of one design; the last one is remembered."""
        if self._last[0] != u.tobytes():
            self._last = u.tobytes(), self.columns(u[None])[0]
        return self._last[1]

    def slopes(self, u: np.ndarray) -> np.ndarray:
        """Derivatives of the columns by ``u``: central differences within the bounds, all designs in one call."""
        steps, here = STEP * np.eye(len(u)), self.at(u)
        up, down = np.clip(u + steps, 0, 1), np.clip(u - steps, 0, 1)
        above, below = np.split(self.columns(np.concatenate([up, down])), 2)
        up, above = _only_built(above, (up, u), (above, here))
        down, below = _only_built(below, (down, u), (below, here))
        width = (up - down).sum(-1)
        return (above - below).T / np.where(width == 0, 1, width)

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


def _only_built(c: np.ndarray, *pairs: tuple[np.ndarray, np.ndarray]) -> list[np.ndarray]:
    """The first of each pair, or the second where the design with the columns ``c`` cannot be built."""
    bad = (c == BAD).all(-1, keepdims=True)
    return [np.where(bad, second, first) for first, second in pairs]
