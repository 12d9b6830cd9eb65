"""A study with two free quantities, seen as a plane: objective and limits on a grid, and where the best design is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..quantities import Measure, counted
from ..quantities.declaration import Quantity
from ..quantities.kinds import numbers, refuse_kinds, shown
from .options import refuse_menus
from .slsqp import slsqp
from .study import Evaluation, Study

STEP = 1e-6
"""Step of a difference, as a share of the bounds' width."""


@dataclass(frozen=True)
class DesignMap:
    """A study with two free quantities over a ``window`` of their plane.

    ``window`` holds a lower and an upper bound of each free quantity, ``(2, 2)`` SI like `Study.bounds`, which it is
    unless said otherwise; it may reach beyond them.  ``n`` is the number of grid lines each way.

    >>> from camkit.machines import shaft_study
    >>> plane = DesignMap(shaft_study())
    >>> plane.objective.shape, plane.limits.shape, (1e3 * plane.best).round(4).tolist()
    ((81, 81), (4, 81, 81), [129.1907, 103.0])

    Raises ``ValueError`` for a study with another number of free quantities or with several objectives.
    """

    study: Study
    window: Any = None
    n: int = 81

    def __post_init__(self) -> None:
        refuse_kinds(self)
        counted(self.n, "grid lines of a plane", most=2_000)
        free, objectives = len(self.study.free), len(self.study.minimise)
        if free != 2:
            raise ValueError(f"a plane shows two free quantities; this study has {free}")
        refuse_menus(self.study, "a plane")
        if objectives != 1:
            raise ValueError(f"a plane shows one objective; this study has {objectives}")
        if self.window is None:
            object.__setattr__(self, "window", self.study.bounds)
        window = numbers(self.window, "the window of a plane")
        if window.shape != (2, 2) or not np.isfinite(window).all() or not (window[0] < window[1]).all():
            raise ValueError(
                f"the window of a plane is {shown(self.window)}; it must be the two lower ends of both quantities, "
                "then the two upper ones"
            )
        object.__setattr__(self, "window", window)

    @cached_property
    def axes(self) -> np.ndarray:
        """Values of both quantities along the grid, ``(2, n)``, SI."""
        return np.linspace(self.window[0], self.window[1], self.n, axis=1)

    @property
    def declared(self) -> tuple[Quantity, Quantity]:
        """The declarations of both quantities."""
        first, second = self.study.declared.values()
        return first, second

    @cached_property
    def _points(self) -> np.ndarray:
        """All designs of the grid, the first quantity fastest, ``(n^2, 2)``."""
        return np.stack(np.meshgrid(*self.axes), axis=-1).reshape(-1, 2)

    @cached_property
    def evaluation(self) -> Evaluation:
        """What the study says of all designs of the grid, in one call."""
        return self.study.evaluate(self._points)

    @cached_property
    def objective(self) -> np.ndarray:
        """``(n, n)``, SI; a row for each value of the second quantity, ``nan`` where nothing can be built."""
        f = self.evaluation.f[:, 0].reshape(self.n, self.n)
        return np.where(np.isfinite(f), f, np.nan)

    @cached_property
    def limits(self) -> np.ndarray:
        """Each limit as ``(value - limit) / |limit|``, kept where <= 0; ``(k, n, n)``."""
        g = self.evaluation.g.T.reshape(-1, self.n, self.n)
        return np.where(np.isfinite(g), g, np.nan)

    @property
    def worst(self) -> np.ndarray:
        """The largest of ``limits``, ``(n, n)``: everything is kept where it is <= 0; 1 where nothing can be built."""
        largest = np.nan_to_num(self.limits, nan=1.0).max(axis=0, initial=-1.0)
        return np.where(np.isnan(self.objective), 1.0, largest)

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The measures that are limited, in the order of ``limits``."""
        return tuple(measure for measure, _, _ in self.study.limits)

    @property
    def best_on_grid(self) -> np.ndarray | None:
        """Free values of the grid's best design within bounds and limits, ``(2,)`` SI; ``None`` if there is none."""
        low, high = self.study.bounds
        kept = self.evaluation.feasible & ((low <= self._points) & (self._points <= high)).all(-1)
        f = np.where(kept, self.evaluation.f[:, 0], np.inf)
        return self._points[f.argmin()] if np.isfinite(f).any() else None

    @cached_property
    def best(self) -> np.ndarray:
        """The free values of the best design within the study's bounds, ``(2,)`` SI; ``nan`` if none keeps every limit.

        SLSQP, started from the best design of a coarse grid over the bounds; what ends within rounding of a bound
        lies on it.
        """
        coarse = np.stack(np.meshgrid(*np.linspace([0, 0], [1, 1], 21, axis=1)), axis=-1).reshape(-1, 2)
        start = coarse[self._first(self._at(coarse))]
        size = abs(self._at(start).f[0, 0])
        objective = lambda u: self._at(u).f[0, 0] / size, lambda u: self._slopes(u)[0] / size
        room = lambda u: -self._at(u).g[0], lambda u: -self._slopes(u)[1]
        found = slsqp(start, objective, room, 1e-12).x.round(12) if np.isfinite(size) else start
        both = self._at(np.array([start, found]))
        chosen = self._first(both)
        return both.x[chosen] if both.feasible[chosen] else np.full(2, np.nan)

    @property
    def best_design(self) -> Any:
        """The design at ``best``; raises ``ValueError`` if none within the bounds keeps every limit."""
        if not np.isfinite(self.best).all():
            raise ValueError("no design within the bounds keeps every limit")
        return self.study.design(self.best)

    def _at(self, u: np.ndarray) -> Evaluation:
        """What the study says of designs given as shares of the bounds."""
        low, high = self.study.bounds
        return self.study.evaluate(low + np.clip(u, 0, 1) * (high - low))

    def _slopes(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How objective ``(2,)`` and limits ``(k, 2)`` grow with each share: differences within the bounds."""
        up, down = (np.clip(u + s * STEP * np.eye(2), 0, 1) for s in (1, -1))
        width = np.diagonal(up - down)[:, None]
        above, below = self._at(up), self._at(down)
        return ((above.f - below.f) / width)[:, 0], ((above.g - below.g) / width).T

    @staticmethod
    def _first(evaluation: Evaluation) -> int:
        """Which design misses its limits least, and among those that miss none, is best."""
        return int(np.lexsort((evaluation.f[:, 0], evaluation.missed.sum(-1)))[0])
