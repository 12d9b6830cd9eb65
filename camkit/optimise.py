"""Search: pymoo and scipy.optimize behind verbs that take a `Study` and know no mechanism."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.problem import Problem
from pymoo.indicators.hv import HV
from scipy.stats import qmc

from .study import Evaluation, Study

WORST = 1e12
"""What pymoo is told of an objective or a limit that is not a number."""


class StudyProblem(Problem):
    """A `Study` as pymoo sees it: one call evaluates a whole generation."""

    def __init__(self, study: Study) -> None:
        low, high = study.bounds
        super().__init__(
            n_var=len(study.free),
            n_obj=len(study.minimise),
            n_ieq_constr=len(study.limits),
            xl=low,
            xu=high,
        )
        self.study = study

    def _evaluate(self, x: np.ndarray, out: dict[str, Any], *args: Any, **kwargs: Any) -> None:
        evaluation = self.study.evaluate(x)
        out["F"] = np.minimum(evaluation.f, WORST)
        out["G"] = np.minimum(evaluation.g, WORST)


@dataclass(frozen=True)
class Front:
    """Designs of which none is better than another in every objective, in order of the first objective.

    ``len(front)``, ``front[i]`` is a design again, ``front.x`` and ``front.f`` are ``(p, n)`` arrays in SI.
    An empty front says in ``message`` what stood in the way.
    """

    study: Study
    x: np.ndarray
    f: np.ndarray
    message: str = ""

    def __len__(self) -> int:
        return len(self.x)

    def __getitem__(self, i: int) -> Any:
        return self.study.design(self.x[i])

    def hypervolume(self, reference: Any = None) -> float:
        """The volume of objectives that the front dominates up to ``reference`` (default: `reference_point`)."""
        reference = reference_point(self.study) if reference is None else np.asarray(reference, dtype=float)
        return float(HV(ref_point=reference)(self.f)) if len(self) else 0.0

    def judged_by(self, study: Study) -> Front:
        """The same designs under a study with other objectives (for instance new AHP weights), dominated ones out."""
        if not len(self):
            return Front(study, self.x, np.zeros((0, len(study.minimise))), self.message)
        return front_of(study.evaluate(self.x), study)


def front_of(evaluation: Evaluation, study: Study) -> Front:
    """The feasible designs of an evaluation that no other dominates."""
    kept = np.flatnonzero(evaluation.feasible)
    f = evaluation.f[kept]
    kept = kept[~dominated(f)]
    kept = kept[np.argsort(evaluation.f[kept, 0], kind="stable")]
    return Front(study, evaluation.x[kept], evaluation.f[kept], "" if len(kept) else _why_empty(evaluation, study))


def dominated(f: np.ndarray) -> np.ndarray:
    """Which rows another row beats: nowhere worse, somewhere better; ``(p,)``."""
    no_worse = (f[:, None] <= f[None]).all(-1)
    better = (f[:, None] < f[None]).any(-1)
    return np.asarray((no_worse & better).any(0))


def _why_empty(evaluation: Evaluation, study: Study) -> str:
    built = np.isfinite(evaluation.f).all(-1)
    if not built.any():
        return "no design of the last generation can be built; widen or move the bounds"
    g = np.where(built[:, None], evaluation.g, np.inf)
    nearest = np.argmin(np.maximum(g, 0).sum(-1))
    measure, limit, sense = study.limits[int(np.argmax(g[nearest]))]
    return (
        f"no design of the last generation keeps every limit; the nearest misses the {measure.name} "
        f"{'of at most' if sense > 0 else 'of at least'} {measure.text(limit)} by {100 * g[nearest].max():.3g} % of it"
    )


def reference_point(study: Study, n: int = 256) -> np.ndarray:
    """A fixed point for hypervolumes: the worst objectives among the feasible of ``n`` Sobol points of the box.

    It depends on the study alone, so hypervolumes of different searches can be compared.
    """
    unit = qmc.Sobol(len(study.free), rng=0).random(n)
    evaluation = study.evaluate(qmc.scale(unit, *study.bounds))
    usable = evaluation.feasible if evaluation.feasible.any() else np.isfinite(evaluation.f).all(-1)
    if not usable.any():
        return study.evaluate(study.x0).f[0]
    return evaluation.f[usable].max(axis=0)


@dataclass(frozen=True)
class Generation:
    """Where a search stands after ``number`` of ``of`` generations."""

    number: int
    of: int
    evaluation: Evaluation
    study: Study

    @cached_property
    def front(self) -> Front:
        """The front so far."""
        return front_of(self.evaluation, self.study)

    @property
    def feasible(self) -> int:
        """How many of the generation's designs keep every limit."""
        return int(self.evaluation.feasible.sum())


def nsga2_generations(study: Study, population: int, generations: int, seed: int) -> Iterator[Generation]:
    """NSGA-II one generation at a time; leave the loop to stop, the last front stays."""
    for name, value, least in (("population", population, 4), ("generations", generations, 1), ("seed", seed, 0)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
            raise ValueError(f"the {name} is {value!r}; it must be a whole number of at least {least}")
    algorithm = NSGA2(pop_size=population, eliminate_duplicates=False)
    algorithm.setup(StudyProblem(study), termination=("n_gen", generations), seed=seed, verbose=False)
    number = 0
    while algorithm.has_next():
        algorithm.next()
        number += 1
        x, f, g = algorithm.pop.get("X", "F", "G")
        yield Generation(number, generations, Evaluation(x, np.where(f < WORST, f, np.inf), g), study)


def nsga2(study: Study, population: int = 100, generations: int = 200, seed: int = 1) -> Front:
    """The Pareto front of ``study`` by NSGA-II (Deb et al. 2002), through pymoo.

    A generation is one batched evaluation.  The result is repeatable for a seed; a front without a design says
    in ``message`` which limit stood in the way.  Raises ``ValueError`` for a population below 4, or generations
    or a seed that are no whole numbers.
    """
    *_, last = nsga2_generations(study, population, generations, seed)
    return last.front
