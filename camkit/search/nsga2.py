"""Search: pymoo and scipy.optimize behind verbs that take a `Study` and know no mechanism."""

from __future__ import annotations

import time
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.population import Population
from pymoo.core.problem import Problem
from pymoo.core.repair import Repair

from ..kinds import applied, refuse_arguments, whole
from ..study.study import Evaluation, Study
from .checkpoint import ALGORITHM, WORST, Checkpoint, fingerprint, remove_parts, taken_up, versions, why
from .front import Front, front_of
from .protocol import on_grid

MOST_SEED = 2**63 - 1
"""The largest seed that a file can hold."""


class StudyProblem(Problem):
    """A `Study` as pymoo sees it: one call evaluates a whole generation."""

    def __init__(self, study: Study) -> None:
        with applied("a search", study):
            low, high = study.bounds
            counts = {"n_obj": len(study.minimise), "n_ieq_constr": len(study.limits)}
        super().__init__(n_var=len(study.free), xl=low, xu=high, **counts)
        self.study = study

    def _evaluate(self, x: np.ndarray, out: dict[str, Any], *args: Any, **kwargs: Any) -> None:
        evaluation = self.study.evaluate(x)
        out["F"] = np.minimum(evaluation.f, WORST)
        out["G"] = np.minimum(np.where(evaluation.missed > 0, evaluation.g, np.minimum(evaluation.g, 0)), WORST)


class OnGrid(Repair):
    """Moves free values onto the grid of `on_grid`."""

    def _do(self, problem: Problem, x: np.ndarray, **kwargs: Any) -> np.ndarray:
        low, high = problem.xl, problem.xu
        return np.clip(low + on_grid((x - low) / (high - low)) * (high - low), low, high)


@dataclass(frozen=True)
class Generation:
    """Where a search stands after ``number`` of ``of`` generations."""

    number: int
    of: int
    evaluation: Evaluation
    study: Study
    record: Mapping[str, Any] = field(default_factory=dict)
    unkept: str = ""
    """Why the search is not kept in its checkpoint any more; empty while it is."""

    @cached_property
    def front(self) -> Front:
        """The front so far."""
        return replace(front_of(self.evaluation, self.study), record=self.record)

    @property
    def feasible(self) -> int:
        """How many of the generation's designs keep every limit."""
        return int(self.evaluation.feasible.sum())


def nsga2_generations(
    study: Study, population: int, generations: int, seed: int, checkpoint: str | Path | None = None
) -> Iterator[Generation]:
    """NSGA-II one generation at a time; leave the loop to stop, the last front stays.

    With the file ``checkpoint`` each generation is written there before it is given.  If the file is there already,
    the search goes on from it, first giving the generation that it holds; see `nsga2`.  Where the file cannot be
    written the search goes on without it, and says so in ``unkept`` from then on.
    """
    whole(population, "the population", 4)
    whole(generations, "the number of generations", 1)
    whole(seed, "the seed", 0, MOST_SEED)
    refuse_arguments(nsga2_generations, locals())
    algorithm = NSGA2(pop_size=population, eliminate_duplicates=False, repair=OnGrid())
    algorithm.setup(StudyProblem(study), termination=("n_gen", generations), seed=seed, verbose=False)
    record: dict[str, Any] = {"population": int(population), "seed": int(seed), "versions": versions()}
    about = {"study": fingerprint(study), "algorithm": ALGORITHM, **record} if checkpoint else {}
    number, began, unkept = 0, time.monotonic(), ""

    def generation() -> Generation:
        x, f, g = algorithm.pop.get("X", "F", "G")
        told = {**record, "generations": number, "seconds": time.monotonic() - began}
        return Generation(number, generations, Evaluation(x, np.where(f < WORST, f, np.inf), g), study, told, unkept)

    if checkpoint:
        remove_parts(checkpoint)
    if checkpoint and Path(checkpoint).exists():
        found = taken_up(checkpoint, study, population, generations, seed)
        _go_on(algorithm, found)
        number, began = found.number, began - found.seconds
        yield generation()
    while algorithm.has_next():
        algorithm.next()
        number += 1
        if checkpoint and not unkept:
            seconds = time.monotonic() - began
            try:
                Checkpoint(number=number, seconds=seconds, **about, **_state(algorithm)).write(checkpoint)
            except OSError as error:
                unkept = why(error)
        yield generation()


def _state(algorithm: NSGA2) -> dict[str, Any]:
    """All that the next generation depends on."""
    x, f, g, rank, crowding = algorithm.pop.get("X", "F", "G", "rank", "crowding")
    ranks = {"rank": rank.astype(float), "crowding": crowding.astype(float)}  # None becomes nan
    return {"random": algorithm.random_state.bit_generator.state, "x": x, "f": f, "g": g, **ranks}


def _go_on(algorithm: NSGA2, found: Checkpoint) -> None:
    """Put the algorithm where it stood."""
    algorithm._initialize()
    algorithm.pop = Population.new(X=found.x, F=found.f, G=found.g)
    algorithm.pop.set("rank", found.rank, "crowding", found.crowding)
    algorithm.random_state.bit_generator.state = found.random
    algorithm.is_initialized, algorithm.n_iter = True, found.number
    algorithm._post_advance()


def nsga2(
    study: Study,
    population: int = 100,
    generations: int = 200,
    seed: int = 1,
    checkpoint: str | Path | None = None,
) -> Front:
    """The Pareto front of ``study`` by NSGA-II (Deb et al. 2002), through pymoo.

    A generation is one batched evaluation.  The result is repeatable for a seed; a front without a design says
    in ``message`` which limit stood in the way.

    ``checkpoint`` names a file that is written after each generation.  The same call goes on from it when the process
    was killed, without losing a generation, and ends with the same front to the last bit.  A full disk or a missing
    folder ends no search: it warns (``RuntimeWarning``) and goes on without the file.

    Raises ``ValueError`` for a population below 4, or generations or a seed that are no whole numbers; for a
    checkpoint that is damaged, or of another study, population, seed or version, and for one of more generations.
    """
    told = False
    for generation in nsga2_generations(study, population, generations, seed, checkpoint):
        if generation.unkept and not told:
            told = True
            warnings.warn(
                f"the search goes on without the file {Path(str(checkpoint)).name}: {generation.unkept}",
                RuntimeWarning,
                stacklevel=2,
            )
    return generation.front
