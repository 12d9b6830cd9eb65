"""A study with one free quantity, swept over its bounds: how each limit is used, and where all are kept."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..quantities import Measure, Quantity, counted
from ..quantities.kinds import refuse_kinds
from .options import refuse_menus
from .study import Evaluation, Study


@dataclass(frozen=True)
class Sweep:
    """``study`` at ``n`` values of its one free quantity, evaluated in one call.

    >>> from camkit import DoorHandleCam, mm
    >>> from camkit.machines import lift_curve_study
    >>> sweep = Sweep(lift_curve_study(space={"lift_arm": (40 * mm, 60 * mm)}))
    >>> sweep.limits.shape, bool(sweep.feasible.any())
    ((3, 121), True)

    Raises ``ValueError`` for a study with another number of free quantities.
    """

    study: Study
    n: int = 121

    def __post_init__(self) -> None:
        refuse_kinds(self)
        counted(self.n, "values of a sweep", most=100_000)
        if len(self.study.free) != 1:
            raise ValueError(f"a sweep shows one free quantity; this study has {len(self.study.free)}")
        refuse_menus(self.study, "a sweep")

    @property
    def name(self) -> str:
        """The free quantity's name."""
        return str(next(iter(self.study.free)))

    @property
    def declared(self) -> Quantity:
        """The free quantity's declaration."""
        return self.study.declared[self.name]

    @cached_property
    def x(self) -> np.ndarray:
        """Values of the free quantity, ``(n,)``, SI."""
        low, high = self.study.bounds[:, 0]
        return np.linspace(low, high, self.n)

    @cached_property
    def evaluation(self) -> Evaluation:
        """What the study says of all of them."""
        return self.study.evaluate(self.x[:, None])

    @cached_property
    def limits(self) -> np.ndarray:
        """Each limit as ``(value - limit) / |limit|``, kept where <= 0, ``(k, n)``; ``nan`` where none can be built."""
        g = self.evaluation.g.T
        return np.where(np.isfinite(g), g, np.nan)

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The measures that are limited, in the order of ``limits``."""
        return tuple(measure for measure, _, _ in self.study.limits)

    @property
    def feasible(self) -> np.ndarray:
        """Where every limit is kept, ``(n,)``."""
        return self.evaluation.feasible

    @property
    def now(self) -> float:
        """The starting design's value of the free quantity, SI."""
        return float(self.study.x0[0])
