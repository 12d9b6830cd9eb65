"""Trials of optimisers: how many evaluations each needed, and what may be said from a limited number of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..data import load
from ..quantities.kinds import refuse_arguments, refuse_empty
from .published import Table

TARGETS = (0.01, 0.001)
"""How near to the optimum, as shares of it, pictures and tables ask for."""


@dataclass(frozen=True)
class Trials:
    """One method on one problem, once for each seed, every time with the same budget of evaluations.

    ``evaluations`` is ``(targets, seeds)``: how many there were when the best feasible design came within a target
    (a share of the known optimum) of it; ``inf`` where that did not happen within the budget.

    >>> four = Trials("a problem", "a method", (0.01,), np.array([[10, 30, 20, np.inf]]), budget=100)
    >>> four.successes(0.01), four.median(0.01), four.expected(0.01)
    (3, 20.0, 53.333333333333336)
    """

    problem: str
    method: str
    targets: tuple[float, ...]
    evaluations: np.ndarray
    budget: int

    def to(self, target: float) -> np.ndarray:
        """The evaluations that each seed needed to come within ``target``, ``(seeds,)``."""
        if target not in self.targets:
            raise ValueError(f"the target {target!r} was not measured; there are {', '.join(map(str, self.targets))}")
        return self.evaluations[self.targets.index(target)]

    def successes(self, target: float) -> int:
        """How many seeds came within ``target``."""
        return int(np.isfinite(self.to(target)).sum())

    def success_interval(self, target: float) -> tuple[float, float]:
        """Between which shares the true rate of success lies, 95 % confidence (Wilson 1927)."""
        from scipy.stats import binomtest

        interval = binomtest(self.successes(target), len(self.to(target))).proportion_ci(method="wilson")
        return float(interval.low), float(interval.high)

    def quantile(self, target: float, share: float) -> float:
        """The evaluations within which ``share`` of all seeds came within ``target``; ``inf`` where fewer did."""
        return float(np.quantile(self.to(target), share, method="inverted_cdf"))

    def median(self, target: float) -> float:
        """The evaluations within which half of all seeds came within ``target``."""
        return self.quantile(target, 0.5)

    def expected(self, target: float) -> float:
        """Evaluations spent, those of failures too, for each success: what one success costs with restarts.

        The expected running time of Auger, Hansen (2005); ``inf`` without a success.
        """
        spent = np.minimum(self.to(target), self.budget).sum()
        return float(spent / self.successes(target)) if self.successes(target) else np.inf


def probability_faster(first: Trials, second: Trials, target: float) -> tuple[float, float]:
    """How often the first method comes within ``target`` sooner than the second (ties half), and the p-value.

    Two runs that both fail are a tie.  Vargha and Delaney's A (2000); two-sided rank test of Mann and Whitney.

    >>> few, many = (Trials("", "", (0.1,), np.array([[n, n + 1, n + 2]]), 9) for n in (1, 5))
    >>> share, p = probability_faster(few, many, 0.1)
    >>> share, round(p, 3)
    (1.0, 0.1)
    """
    refuse_arguments(probability_faster, locals())
    from scipy.stats import mannwhitneyu

    a, b = first.to(target), second.to(target)
    share = float(np.mean((a[:, None] < b) + 0.5 * (a[:, None] == b)))
    if len(np.unique(np.concatenate([a, b]))) == 1:
        return share, 1.0
    # ranks alone count, and the test takes no infinite numbers
    failed = 2.0 * max(first.budget, second.budget)
    return share, float(mannwhitneyu(np.minimum(a, failed), np.minimum(b, failed)).pvalue)


def measured_trials(problem: str) -> tuple[Trials, ...]:
    """Every method on ``problem``, as measured by ``benchmarks/compare_optimisers.py``.

    Raises ``ValueError`` for a problem that was not measured, naming those that were.
    """
    refuse_arguments(measured_trials, locals())
    data = load("optimiser_comparison")
    if problem not in data["evaluations"]:
        raise ValueError(f"there are no trials of {problem!r}; there are {', '.join(data['evaluations'])}")
    return tuple(
        Trials(problem, method, tuple(data["targets"]), _numbers(rows), data["budget"])
        for method, rows in data["evaluations"][problem].items()
    )


def _numbers(rows: Sequence[Sequence[float | None]]) -> np.ndarray:
    return np.array([[np.inf if n is None else n for n in row] for row in rows], dtype=float)


def trial_table(trials: Sequence[Trials]) -> Table:
    """Trials of several methods on one problem, a row for each method.

    For each of `TARGETS`: how many runs arrived, between which shares the true rate lies (95 %), the median of the
    evaluations over all runs, and the evaluations for each success.
    """
    refuse_arguments(trial_table, locals())
    refuse_empty(trials, "trials")
    words = ("arrived", "rate, 95 %", "median", "for each")
    head = ("method", *(f"to {100 * target:g} %: {word}" for target in TARGETS for word in words))
    rows = [(t.method, *(cell for target in TARGETS for cell in _cells(t, target))) for t in trials]
    return Table(head, rows, trials[0].problem)


def _cells(trials: Trials, target: float) -> tuple[str, ...]:
    low, high = (f"{100 * share:.0f}" for share in trials.success_interval(target))
    arrived = f"{trials.successes(target)} of {len(trials.to(target))}"
    return arrived, f"{low} to {high} %", _count(trials.median(target)), _count(trials.expected(target))


def _count(evaluations: float) -> str:
    return f"{evaluations:.0f}" if np.isfinite(evaluations) else "none"
