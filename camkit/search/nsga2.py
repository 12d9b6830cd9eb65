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
from pymoo.indicators.hv import HV
from scipy.stats import qmc

from ..kinds import applied, numbers, refuse_arguments, refuse_kinds, shown, whole
from ..quantities import counted
from ..study.study import Evaluation, Study
from .checkpoint import ALGORITHM, WORST, Checkpoint, fingerprint, remove_parts, taken_up, versions, why

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


def on_grid(shares: np.ndarray) -> np.ndarray:
    """Shares of the width between two bounds, moved to the nearest millionth (``2^-20``).

    Processors differ in the last bits of a power.  A search doubles such differences from generation to generation;
    on a grid they never arise, and a seed gives the same front everywhere.
    """
    return np.round(shares * 2**20) / 2**20


class OnGrid(Repair):
    """Moves free values onto the grid of `on_grid`."""

    def _do(self, problem: Problem, x: np.ndarray, **kwargs: Any) -> np.ndarray:
        low, high = problem.xl, problem.xu
        return np.clip(low + on_grid((x - low) / (high - low)) * (high - low), low, high)


@dataclass(frozen=True)
class Front:
    """Designs of which none is better than another in every objective, in order of the first objective.

    ``len(front)``, ``front[i]`` is a design again, ``front.x`` and ``front.f`` are ``(p, n)`` arrays in SI.
    An empty front says in ``message`` what stood in the way.  ``record`` says how a search found it: population,
    generations and seed or how many designs were looked at, seconds, versions.
    """

    study: Study
    x: np.ndarray
    f: np.ndarray
    message: str = ""
    record: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for name, table, columns in (("x", self.x, self.study.free), ("f", self.f, self.study.minimise)):
            if table.shape != (len(self.x), len(columns)):
                raise ValueError(
                    f"the front's {name} has the shape {table.shape}; it must have a row for each design "
                    f"and a column for each of {len(columns)}"
                )

    def __len__(self) -> int:
        return len(self.x)

    def __getitem__(self, i: int) -> Any:
        return self.study.design(self.x[i if isinstance(i, slice) else self._place(i)])

    def _place(self, i: Any) -> Any:
        """One or more places on the front; past its end `IndexError`, by which a loop over it ends."""
        numbers(i, "the place on the front")
        place = np.asarray(i)
        if place.dtype.kind not in "iu" or place.ndim > 1:
            raise ValueError(f"the place on the front is {shown(i)}; it must be a whole number, or several")
        if not ((-len(self) <= place) & (place < len(self))).all():
            raise IndexError(f"there is no design {shown(i)} on the front; it has {len(self)}, counted from 0")
        return place

    def hypervolume(self, reference: Any = None) -> float:
        """The volume of objectives that the front dominates up to ``reference`` (default: `reference_point`).

        Raises ``ValueError`` for a reference that is not one finite number for each objective.
        """
        point = reference_point(self.study) if reference is None else _point(reference, len(self.study.minimise))
        if not np.isfinite(self.f).all():
            raise ValueError("the front has an objective that is not a finite number")
        return float(HV(ref_point=point)(self.f)) if len(self) else 0.0

    def judged_by(self, study: Study) -> Front:
        """The same designs under a study with other objectives (for instance new AHP weights), dominated ones out."""
        refuse_arguments(Front.judged_by, locals())
        if not len(self):
            return Front(study, self.x, np.zeros((0, len(study.minimise))), self.message, self.record)
        return replace(front_of(study.evaluate(self.x), study), record=self.record)


def _point(reference: Any, k: int) -> np.ndarray:
    """A point in the space of ``k`` objectives."""
    try:
        point = numbers(reference, "the reference point")
    except ValueError:
        point = np.zeros(())
    if point.shape != (k,) or not np.isfinite(point).all():
        raise ValueError(f"the reference point is {shown(reference)}; it must be {k} finite numbers")
    return point


def front_of(evaluation: Evaluation, study: Study) -> Front:
    """The feasible designs of an evaluation that no other dominates."""
    refuse_arguments(front_of, locals())
    kept = np.flatnonzero(evaluation.feasible)
    f = evaluation.f[kept]
    kept = kept[~dominated(f)]
    kept = kept[np.argsort(evaluation.f[kept, 0], kind="stable")]
    return Front(study, evaluation.x[kept], evaluation.f[kept], "" if len(kept) else _why_empty(evaluation, study))


def dominated(f: np.ndarray) -> np.ndarray:
    """Which rows another row beats: nowhere worse, somewhere better; ``(p,)``."""
    f = numbers(f, "the objectives")
    if f.ndim != 2:
        raise ValueError(f"the objectives have the shape {f.shape}; they must be a table, a row for each design")
    no_worse = (f[:, None] <= f[None]).all(-1)
    better = (f[:, None] < f[None]).any(-1)
    return np.asarray((no_worse & better).any(0))


def _why_empty(evaluation: Evaluation, study: Study) -> str:
    built = np.isfinite(evaluation.f).all(-1)
    if not built.any():
        return "no design that was looked at can be built; widen or move the bounds"
    nearest = np.argmin(np.where(built, evaluation.missed.sum(-1), np.inf))
    missed = study.worst_miss(evaluation.g[nearest])
    return f"no design that was looked at keeps every limit; the nearest misses {missed}"


def reference_point(study: Study, n: int = 256) -> np.ndarray:
    """A fixed point for hypervolumes: the worst objectives among the feasible of ``n`` Sobol points of the box.

    It depends on the study alone, so hypervolumes of different searches can be compared.
    """
    refuse_arguments(reference_point, locals())
    unit = qmc.Sobol(len(study.free), rng=0).random(counted(n, "Sobol points", 1))
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
