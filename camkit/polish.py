"""The last step of a search whose objective is made of absolute values, which no gradient method likes.

Each ``|r|`` is replaced by a number ``t`` of its own and a pair of inequalities, ``-t <= r <= t``: smooth again,
and small where the sum of all ``t`` is small.  The largest ``|r|`` needs one ``t`` for all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import minimize

from .study import Evaluation, Study

NORMS = ("sum", "excess", "largest")
"""What is made small: the sum of ``|r|``, the sum of ``max(r, 0)``, the largest ``|r|``."""

STEP = 1e-6
"""Step of a central difference, as a share of the bounds' width."""

MARGIN = 1e-9
"""How far inside its limits the polished design is kept, as a share of the limit, so that rounding breaks none."""

BAD = 1e3
"""What stands for a residual or a limit of a design that cannot be built, in sizes of the largest at the start."""


@dataclass(frozen=True)
class Polished:
    """The design after the last step; ``message`` says how it went."""

    study: Study
    x: np.ndarray
    f: np.ndarray
    feasible: bool
    evaluations: int
    message: str

    @property
    def design(self) -> Any:
        """The design itself."""
        return self.study.design(self.x)


@dataclass(frozen=True)
class SmoothProblem:
    """The smooth problem in ``z = (u, t)``: free values as shares of their bounds, and what bounds the residuals.

    ``residuals`` takes an analysis of ``p`` designs and gives ``(p, m)``; they are divided by the largest of the
    start, so that ``u`` and ``t`` are of a size.
    """

    study: Study
    residuals: Callable[[Any], Any]
    start: np.ndarray
    norm: str

    @cached_property
    def scale(self) -> float:
        """The largest residual at the start, or 1."""
        return float(abs(self.residuals(self.study.analyse(self.start[None]))).max()) or 1.0

    def x(self, u: np.ndarray) -> np.ndarray:
        """Free values from shares of their bounds."""
        low, high = self.study.bounds
        return low + np.clip(u, 0, 1) * (high - low)

    def values(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residuals ``(p, m)`` and limits ``(p, n_limits)`` of ``p`` designs."""
        x = self.x(u)
        r = self.residuals(self.study.analyse(x)) / self.scale
        g = self.study.evaluate(x).g + MARGIN
        return np.where(np.isfinite(r), r, BAD), np.where(np.isfinite(g), g, BAD)

    def slopes(self, u: np.ndarray) -> tuple[np.ndarray, ...]:
        """What `values` gains with each of ``u``, ``(m, n)`` and ``(n_limits, n)``: differences within the bounds."""
        steps = STEP * np.eye(len(u))
        up, down = np.clip(u + steps, 0, 1), np.clip(u - steps, 0, 1)
        width = np.diagonal(up - down)
        return tuple((a - b).T / width for a, b in zip(self.values(up), self.values(down), strict=True))

    def bounded_by(self, t: np.ndarray, residuals: int) -> np.ndarray:
        """The bound of each residual; ``t`` has one for each, or one for all."""
        return np.broadcast_to(t, (residuals, *t.shape[1:]))

    def kept(self, r: np.ndarray, bound: np.ndarray, g: np.ndarray) -> np.ndarray:
        """All inequalities, kept where >= 0."""
        below = [] if self.norm == "excess" else [bound + r]
        return np.concatenate([bound - r, *below, -g])

    def inequalities(self, z: np.ndarray) -> np.ndarray:
        """Both sides of every residual, and the limits, at ``z``."""
        u, t = np.split(z, [len(self.start)])
        (r,), (g,) = self.values(u[None])
        return self.kept(r, self.bounded_by(t, len(r)), g)

    def inequality_slopes(self, z: np.ndarray) -> np.ndarray:
        """The derivatives of `inequalities` with respect to ``z``."""
        u, t = np.split(z, [len(self.start)])
        r, g = self.slopes(u)
        by_u = self.kept(r, np.zeros_like(r), g)
        bound = self.bounded_by(np.eye(len(t)), len(r))
        by_t = self.kept(np.zeros_like(bound), bound, np.zeros((len(g), len(t))))
        return np.hstack([by_u, by_t])

    def first(self) -> tuple[np.ndarray, np.ndarray]:
        """``u`` and the smallest ``t`` at the start."""
        low, high = self.study.bounds
        u = (self.start - low) / (high - low)
        (r,), _ = self.values(u[None])
        t = np.maximum(r, 0) if self.norm == "excess" else abs(r)
        return u, t.max(keepdims=True) if self.norm == "largest" else t

    def solve(self) -> Any:
        """SLSQP from the start."""
        u, t = self.first()
        slope = np.concatenate([np.zeros_like(u), np.ones_like(t)])
        return minimize(
            lambda z: slope @ z,
            np.concatenate([u, t]),
            jac=lambda z: slope,
            bounds=[(0, 1)] * len(u) + [(0, None)] * len(t),
            constraints={"type": "ineq", "fun": self.inequalities, "jac": self.inequality_slopes},
            method="SLSQP",
            options={"maxiter": 100, "ftol": 1e-12},
        )


def polish(study: Study, residuals: Callable[[Any], Any], x: Any = None, norm: str = "sum") -> Polished:
    """The design next to ``x`` (default: the study's start) whose ``residuals`` are small within all limits.

    ``residuals`` gives the signed residuals of an analysis, ``(p, m)``, and ``norm`` says what is made of them:
    the ``"sum"`` of their absolute values, the ``"excess"`` above 0, or the ``"largest"`` absolute value.  It has
    to be the study's objective, by which start and end are compared.  SLSQP on the pairs of inequalities.

    >>> from camkit.linkage.cabin_door import rssr_study
    >>> from camkit.linkage.measures import departures
    >>> found = polish(rssr_study(), departures())
    >>> print(f"{np.degrees(found.f[0]):.5f} deg, crank {1e3 * found.design.crank:.2f} mm")
    213.29848 deg, crank 80.00 mm

    Raises ``ValueError`` for another ``norm``, or a start that lies outside its bounds or cannot be built.
    """
    if norm not in NORMS:
        raise ValueError(f"the norm is {norm!r}; there are {', '.join(map(repr, NORMS))}")
    start = np.asarray(study.x0 if x is None else x, dtype=float)
    low, high = study.bounds
    before = study.evaluate(start)
    if not ((low <= start) & (start <= high)).all():
        raise ValueError("the design to polish lies outside the bounds of the study")
    if not np.isfinite(before.f).all():
        raise ValueError("the design to polish cannot be built; start from one that a search has found")
    problem = SmoothProblem(study, residuals, start, norm)
    found = problem.solve()
    after = study.evaluate(problem.x(found.x[: len(start)]))
    evaluations = found.nfev + 2 * len(start) * found.njev
    if _merit(before) <= _merit(after):
        return _polished(study, before, evaluations, "no better design lies next to the start")
    words = f"best of its neighbours after {found.nit} steps" if found.success else "stopped before it was the best"
    return _polished(study, after, evaluations, words)


def _merit(evaluation: Evaluation) -> tuple[float, float]:
    """Broken limits first, then the objective."""
    return float(np.maximum(evaluation.g, 0).sum()), float(evaluation.f[0, 0])


def _polished(study: Study, evaluation: Evaluation, evaluations: int, message: str) -> Polished:
    feasible = bool(evaluation.feasible[0])
    broken = "" if feasible else "; it keeps not every limit"
    return Polished(study, evaluation.x[0], evaluation.f[0], feasible, evaluations, message + broken)
