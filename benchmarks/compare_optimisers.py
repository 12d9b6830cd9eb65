"""How many evaluations different optimisers need: measures camkit/data/optimiser_comparison.json anew.

    python benchmarks/compare_optimisers.py
    python benchmarks/compare_optimisers.py --methods "GA (pymoo)"      measures these alone, the others stay

Every method searches every problem once for each seed, with the same budget of evaluations.  What counts is the
number of designs evaluated until the best feasible one so far lies within each target above the known optimum.
A design asked for twice in a row of questions (objective, then limits) counts once.  Methods keep the defaults of
their library but where their function or `METHODS` says otherwise; those that end before the budget is spent start
again from another random design.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import platform
from collections.abc import Callable, Collection
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pymoo
import scipy
from pymoo.algorithms.soo.nonconvex.de import DE
from pymoo.algorithms.soo.nonconvex.ga import GA
from scipy.optimize import NonlinearConstraint, differential_evolution, minimize

from camkit import __version__
from camkit.machines.shaft import lightest_shaft, shaft_study
from camkit.search.competitive import CompetitiveAlgorithm
from camkit.search.evolution import StudyProblem
from camkit.study.study import Evaluation, Study
from known_problems import KNOWN_PROBLEMS
from stored import in_rows

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "optimiser_comparison.json"
BUDGET = 10_000
SEEDS = 30
TARGETS = (0.1, 0.01, 0.001)
TOLERANCE = 1e-6
"""How far a limit may be missed, as a share of it; the same for every method."""


@dataclass(frozen=True)
class Problem:
    """A study and its known optimum."""

    study: Study
    optimum: float


PROBLEMS = {
    "universal-joint shaft": Problem(shaft_study(), float(lightest_shaft().analyse().area)),
    **{known.name: Problem(known.study, float(known.study.evaluate(known.x).f[0, 0])) for known in KNOWN_PROBLEMS},
}


class Enough(Exception):
    """Every target is reached, or the budget is spent."""


class CountedStudy:
    """A study that counts its evaluations and notes when the best feasible design comes within each target."""

    def __init__(self, problem: Problem, budget: int) -> None:
        self.problem, self.budget, self.count = problem, budget, 0
        self.reached: list[int | None] = [None] * len(TARGETS)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.problem.study, name)

    def evaluate(self, x: Any) -> Evaluation:
        """What the study says; raises `Enough` when there is nothing left to find out."""
        evaluation = self.problem.study.evaluate(x)
        kept = (evaluation.g <= TOLERANCE).all(-1)
        gap = np.where(kept, evaluation.f[:, 0] / self.problem.optimum - 1, np.inf)[: self.budget - self.count]
        for i, target in enumerate(TARGETS):
            near = np.flatnonzero(gap <= target)
            if self.reached[i] is None and len(near):
                self.reached[i] = self.count + int(near[0]) + 1
        self.count += len(evaluation.f)
        if None not in self.reached or self.count >= self.budget:
            raise Enough
        return evaluation


class Scaled:
    """A study one design at a time, free values as shares ``u`` of their bounds; asked again, it remembers."""

    def __init__(self, study: CountedStudy) -> None:
        self.study, self.low, self.width = study, study.bounds[0], np.diff(study.bounds, axis=0)[0]
        self._known: dict[bytes, tuple[float, np.ndarray]] = {}

    def __call__(self, u: Any) -> tuple[float, np.ndarray]:
        """Objective and limits (kept where <= 0)."""
        key = np.asarray(u, dtype=float).tobytes()
        if key not in self._known:
            evaluation = self.study.evaluate(self.low + np.clip(u, 0, 1) * self.width)
            self._known[key] = evaluation.f[0, 0], evaluation.g[0]
        return self._known[key]


def random_search(study: CountedStudy, seed: int) -> None:
    """Designs drawn evenly over the box."""
    rng = np.random.default_rng(seed)
    while True:
        study.evaluate(rng.uniform(*study.bounds, (100, len(study.free))))


def slsqp(study: CountedStudy, seed: int) -> None:
    """Sequential quadratic programming with differences, from random designs (scipy)."""
    rng = np.random.default_rng(seed)
    while True:
        ask, u = Scaled(study), rng.random(len(study.free))
        size = abs(ask(u)[0])
        minimize(
            lambda u, ask=ask, size=size: ask(u)[0] / size,
            u,
            method="SLSQP",
            bounds=[(0, 1)] * len(u),
            constraints={"type": "ineq", "fun": lambda u, ask=ask: -ask(u)[1]},
        )


def scipy_de(study: CountedStudy, seed: int) -> None:
    """Differential evolution best/1/bin, CR 0.7, 15 designs for each free value (scipy).

    It goes on until the budget is spent (``tol=0``), without a last descent (``polish=False``).
    """
    ask = Scaled(study)
    differential_evolution(
        lambda u: ask(u)[0],
        [(0, 1)] * len(study.free),
        constraints=NonlinearConstraint(lambda u: ask(u)[1], -np.inf, 0),
        maxiter=study.budget,
        tol=0,
        polish=False,
        rng=seed,
    )


def with_pymoo(make: Callable[[], Any], study: CountedStudy, seed: int) -> None:
    """One of pymoo's algorithms, generation after generation."""
    algorithm = make().setup(StudyProblem(study), termination=("n_gen", 10**9), seed=seed, verbose=False)  # type: ignore[arg-type]
    while True:
        algorithm.next()


def penalty(study: CountedStudy, seed: int) -> None:
    """Sequential unconstrained minimisation with an interior penalty (Fiacco, McCormick 1968).

    From the first feasible design that is drawn: ``f + r sum(1 / distance to each limit and bound)`` by Nelder and
    Mead's simplex, ``r`` a tenth each time, over seven tenths.
    """
    rng = np.random.default_rng(seed)
    while True:
        ask, u = Scaled(study), rng.random(len(study.free))
        while not (ask(u)[1] < 0).all():
            u = rng.random(len(study.free))
        size = abs(ask(u)[0])
        for r in 10.0 ** -np.arange(1, 9):
            options = {"xatol": 1e-6, "fatol": 1e-9, "maxfev": 10**6}
            u = minimize(_with_barrier, u, args=(ask, size, r), method="Nelder-Mead", options=options).x


def _with_barrier(u: np.ndarray, ask: Scaled, size: float, r: float) -> float:
    if (u <= 0).any() or (u >= 1).any():
        return np.inf
    f, g = ask(u)
    return f / size + r * (sum(-1 / g) + sum(1 / u + 1 / (1 - u))) if (g < 0).all() else np.inf


METHODS: dict[str, Callable[[CountedStudy, int], None]] = {
    "SLSQP": slsqp,
    "penalty method": penalty,
    "DE (scipy)": scipy_de,
    "DE (pymoo)": partial(with_pymoo, DE),
    "DE (pymoo), CR 0.7": partial(with_pymoo, partial(DE, CR=0.7)),
    "GA (pymoo)": partial(with_pymoo, GA),
    "competitive": partial(with_pymoo, CompetitiveAlgorithm),
    "competitive, narrowing": partial(with_pymoo, partial(CompetitiveAlgorithm, narrowing=0.9)),
    "random search": random_search,
}


def trial(problem: str, method: str, seed: int, budget: int = BUDGET) -> list[int | None]:
    """Evaluations until each of `TARGETS` was reached, ``None`` where it was not."""
    study = CountedStudy(PROBLEMS[problem], budget)
    with contextlib.suppress(Enough):
        METHODS[method](study, seed)
    return study.reached


def _trials(task: tuple[str, str, int]) -> list[list[int | None]]:
    problem, method, seeds = task
    with np.errstate(all="ignore"):
        return [trial(problem, method, seed) for seed in range(seeds)]


def described(problem: Problem) -> dict[str, float]:
    """Size and difficulty of a problem: the feasible share is that of 100 000 designs drawn evenly over the box."""
    study = problem.study
    drawn = np.random.default_rng(0).uniform(*study.bounds, (100_000, len(study.free)))
    with np.errstate(all="ignore"):
        share = float(study.evaluate(drawn).feasible.mean())
    return {"free": len(study.free), "limits": len(study.limits), "optimum": problem.optimum, "feasible_share": share}


def measured_with() -> dict[str, Any]:
    """All that counts may depend on but problems and methods."""
    return {
        "made_with": {
            "camkit": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "pymoo": pymoo.__version__,
            "machine": platform.machine(),
        },
        "budget": BUDGET,
        "tolerance": TOLERANCE,
        "targets": list(TARGETS),
    }


def measure(methods: Collection[str], seeds: int, processes: int) -> dict[str, dict[str, Any]]:
    """Evaluations of some methods on every problem: for each problem and method a row for each target."""
    tasks = [(problem, method, seeds) for problem in PROBLEMS for method in methods]
    with ProcessPoolExecutor(processes) as pool:
        measured = dict(zip(tasks, pool.map(_trials, tasks), strict=True))
    return {p: {m: np.transpose(measured[p, m, seeds]).tolist() for m in methods} for p in PROBLEMS}


def joined(known: dict[str, Any], measured: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """For each problem the methods in the order of `METHODS`, measured now or else known."""
    rows = {problem: known.get(problem, {}) | measured[problem] for problem in PROBLEMS}
    return {problem: {method: rows[problem][method] for method in METHODS} for problem in PROBLEMS}


def data(seeds: int, evaluations: dict[str, Any]) -> dict[str, Any]:
    """What the data file holds."""
    return {
        "about": "evaluations until the best feasible design is within each target above the known optimum; "
        "null: not within the budget",
        "rebuild": "python benchmarks/compare_optimisers.py",
        "seeds": seeds,
        **measured_with(),
        "problems": {name: described(problem) for name, problem in PROBLEMS.items()},
        "evaluations": evaluations,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--out", type=Path, default=CACHE)
    arguments = parser.parse_args()
    known: dict[str, Any] = {}
    if set(arguments.methods) != set(METHODS):
        old = json.loads(arguments.out.read_text(encoding="utf-8"))
        now = {"seeds": arguments.seeds, **measured_with()}
        changed = [name for name, value in now.items() if old[name] != value]
        if changed:
            parser.error(f"the other methods were measured with another {', '.join(changed)}: measure all of them")
        known = old["evaluations"]
    measured = measure(arguments.methods, arguments.seeds, min(2, os.cpu_count() or 1))
    text = json.dumps(data(arguments.seeds, joined(known, measured)), indent=1)
    arguments.out.write_text(in_rows(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
