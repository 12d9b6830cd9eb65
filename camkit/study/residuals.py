"""Measures that are a sum of residuals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..quantities import Measure, PeakMeasure
from ..quantities.types import Array
from .weighted import WeightedSum


@dataclass(frozen=True)
class SumOfResiduals(Measure):
    """The sum of ``|r|``: ``function`` gives the signed residuals ``r`` of an analysis, ``(..., m)``.

    ``above_only``: the sum of ``max(r, 0)`` instead, where a residual below 0 is no fault.

    >>> missed = SumOfResiduals("missed", "", lambda shot: shot - np.array([1.0, 2.0, 3.0]))
    >>> float(missed(np.array([1.5, 2.0, 1.0])))
    2.5
    """

    above_only: bool = False

    def sides(self, analysis: object) -> np.ndarray:
        """Both numbers of which the larger one counts for each residual, ``(..., m, 2)``."""
        r = self.given(analysis)
        return np.stack([r, 0 * r if self.above_only else -r], axis=-1)

    def __call__(self, analysis: object) -> Array:
        return self.sign * self.sides(analysis).max(-1).sum(-1)

    def spelled_out(self, analysis: object) -> WeightedSum:
        """The same sum as one peak for each residual of ``analysis``, which `Epigraph` bounds one by one."""
        sides = _remembered(self.sides)
        m = sides(analysis).shape[-2]
        peaks = tuple(PeakMeasure(f"{self.name}, {i}", self.unit, _row(sides, i)) for i in range(m))
        return WeightedSum(self.name, self.unit, self.function, 1, peaks, (1.0,) * m, (1.0,) * m)


def _row(sides: Callable[[object], np.ndarray], i: int) -> Callable[[object], np.ndarray]:
    return lambda analysis: sides(analysis)[..., i, :]


def _remembered(function: Callable[[object], np.ndarray]) -> Callable[[object], np.ndarray]:
    """``function``, computed once for each analysis in a row: every residual asks for it."""
    last: list[object] = [None, None]

    def of(analysis: object) -> np.ndarray:
        if last[0] is not analysis:
            last[:] = analysis, function(analysis)
        return np.asarray(last[1])

    return of
