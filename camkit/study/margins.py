"""A study whose limits are tightened, so that a search that knows nothing of tolerances leaves room for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple, Self

import numpy as np

from ..quantities import D
from ..quantities.types import Array
from .study import KEPT, Evaluation, Study

RIDGE = 1e-2
"""How much a fit prefers margins that are the same everywhere."""
NEAR = 0.02
"""How near to its limit a design counts half for a fit."""


@dataclass(frozen=True)
class TightenedStudy(Study[D]):
    """A study whose limits are tightened by ``margins``: a function of designs ``(p, n_free)``, ``(p, n_limits)``."""

    margins: Callable[[Array], Array] | None = None

    def tightening(self, x: Array) -> Array:
        """The margins at designs ``(p, n_free)``."""
        return np.zeros(()) if self.margins is None else self.margins(x)

    def judged_by(self, x: np.ndarray, values: Array) -> Evaluation:
        """Objectives and tightened limits of designs ``(p, n_free)`` of which the values are at hand."""
        found = super().judged_by(x, values)
        return found if self.margins is None else replace(found, g=found.g + self.margins(x))


def tightened(study: Study[D], margins: Callable[[Array], Array]) -> TightenedStudy[D]:
    """``study`` without tolerances, its limits tightened by ``margins``."""
    known: dict[str, Any] = {f.name: getattr(study, f.name) for f in fields(Study)}
    return TightenedStudy(**known, margins=margins)


class FittedMargins(NamedTuple):
    """Margins that change slowly over the bounds: a quadratic through some designs, within what was seen of them."""

    bounds: Array
    coefficients: Array
    low: Array
    high: Array
    raised: Array

    @classmethod
    def to(cls, bounds: Array, x: Array, g: Array, margins: Array) -> Self:
        """A fit to designs ``(p, n_free)``, their limits ``g`` and ``margins`` ``(p, n_limits)``.

        It is closest where a limit is reached: there it matters.
        """
        mean, basis = np.median(margins, axis=0), _basis(bounds, x)
        weight = (1 / (1 + ((g + margins) / NEAR) ** 2)).T[..., None]
        left = basis.T @ (weight * basis) + RIDGE * np.eye(basis.shape[1])
        slopes = np.linalg.solve(left, basis.T @ (weight * (margins - mean).T[..., None]))[..., 0].T
        slopes[0] += mean
        return cls(bounds, slopes, margins.min(0), margins.max(0), np.zeros(margins.shape[1]))

    def at(self, x: Array) -> Array:
        """The margins at designs ``(p, n_free)``, ``(p, n_limits)``."""
        return np.clip(_basis(self.bounds, x) @ self.coefficients, self.low, self.high) + self.raised

    def above(self, x: Array, g: Array, margins: Array) -> Self:
        """The same fit, raised for each limit by as much as designs that keep it are beyond it with ``margins``."""
        fitted = self.at(x)
        beyond = np.where(g + fitted <= KEPT, np.minimum(margins - fitted, g + margins), 0)
        return self._replace(raised=self.raised + beyond.max(0, initial=0.0))


def _basis(bounds: Array, x: Array) -> Array:
    """1, the shares of the bounds from -1 to 1, and their products, ``(p, 1 + n + n (n + 1) / 2)``."""
    low, high = bounds
    u = 2 * (x - low) / (high - low) - 1
    i, j = np.triu_indices(u.shape[1])
    return np.hstack([np.ones((len(u), 1)), u, u[:, i] * u[:, j]])
