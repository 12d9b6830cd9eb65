"""`nsga2`: the Pareto front of a study with any number of free quantities, through pymoo."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.population import Population

from ..quantities import D
from ..quantities.kinds import refuse_arguments, whole
from ..study.study import Evaluation, Study
from .checkpoint import ALGORITHM, WORST, Checkpoint, fingerprint, remove_parts, resume, versions, why
from .evolution import OnGrid, StudyProblem, mixed
from .front import Front
from .protocol import Step
from .robust_front import FITTED, RAISED, Room, looked_at_closely, surviving
from .threads import one_by_one

RENEWED = 1 / 6, 1 / 3, 5 / 6
"""After which shares of the generations the margins for tolerances are fitted to the population; then only raised."""
MOST_SEED = 2**63 - 1
"""The largest seed that a file can hold."""


def nsga2_steps(
    study: Study,
    population: int = 100,
    generations: int = 200,
    seed: int = 1,
    checkpoint: str | Path | None = None,
) -> Iterator[Step]:
    """NSGA-II one generation at a time; leave the loop to stop, the last front stays.

    With the file ``checkpoint`` each generation is written there before it is given.  If the file is there already,
    the search goes on from it, first giving the generation that it holds; see `nsga2`.  Where the file cannot be
    written the search goes on without it, and the ``message`` says why from then on.
    """
    population = whole(population, "the population", 4)
    generations = whole(generations, "the number of generations", 1)
    seed = whole(seed, "the seed", 0, MOST_SEED)
    refuse_arguments(nsga2_steps, locals())
    given = {"repair": OnGrid(), **mixed(study, eta=15, prob=0.9)}
    algorithm = NSGA2(pop_size=population, eliminate_duplicates=False, **given)
    room = Room(study, fits=not checkpoint and not study.menus)
    algorithm.setup(StudyProblem(room.within(study)), termination=("n_gen", generations), seed=seed, verbose=False)
    record: dict[str, Any] = {"population": int(population), "seed": int(seed), "versions": versions()}
    about = {"study": fingerprint(study), "algorithm": ALGORITHM, **record} if checkpoint else {}
    number, began, message = 0, time.monotonic(), ""

    def step() -> Step:
        so_far = {**record, "generations": number, "seconds": time.monotonic() - began}
        found = _found(algorithm, study, closely=room.needed)
        return Step(number, generations, study, found, number * population, None, message, so_far)

    if checkpoint:
        remove_parts(checkpoint)
    if checkpoint and Path(checkpoint).exists():
        found = resume(checkpoint, study, population, generations, seed)
        _go_on(algorithm, found)
        number, began = found.number, began - found.seconds
        yield step()
    while algorithm.has_next():
        _make_room(algorithm, room, study, number, generations)
        algorithm.next()
        number += 1
        if checkpoint and not message:
            seconds = time.monotonic() - began
            message = _written(checkpoint, number=number, seconds=seconds, **about, **_state(algorithm))
        yield step()


def _written(checkpoint: str | Path, **state: Any) -> str:
    """Write a checkpoint; why it cannot be written, empty if it can."""
    try:
        Checkpoint(**state).write(checkpoint)
    except OSError as error:
        return why(error)
    return ""


def _found(algorithm: NSGA2, study: Study, closely: bool) -> Evaluation | Callable[[], Evaluation]:
    """What is known of the population, or what there is to know of it ``closely``."""
    x, f, g = algorithm.pop.get("X", "F", "G")
    return partial(looked_at_closely, study, study, x) if closely else Evaluation(x, np.where(f < WORST, f, np.inf), g)


def _make_room(algorithm: NSGA2, room: Room, study: Study, number: int, generations: int) -> None:
    """Fit the margins for tolerances to the population, or raise them to what it needs, and judge it again."""
    renewed = [int(share * generations) for share in RENEWED]
    if not (room.needed and number and number in renewed):
        return
    anew = number != renewed[-1]
    designs = algorithm.pop.get("X")
    (room.renew if anew else room.raise_to)(designs[: FITTED if anew else RAISED])
    algorithm.problem.study = room.within(study)
    people = algorithm.evaluator.eval(algorithm.problem, Population.new(X=designs))
    given = {"algorithm": algorithm, "random_state": algorithm.random_state}
    algorithm.pop = algorithm.survival.do(algorithm.problem, people, n_survive=len(people), **given)
    algorithm._set_optimum()


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
    study: Study[D],
    population: int = 100,
    generations: int = 200,
    seed: int = 1,
    checkpoint: str | Path | None = None,
) -> Front[D]:
    """The Pareto front of ``study`` by NSGA-II (Deb et al. 2002), through pymoo.

    A generation is one batched evaluation.  The result is repeatable for a seed; a front without a design says
    in ``message`` which limit stood in the way.

    Where menus are free an option is that of one parent or the other, and any other in its place is a mutation.

    Under tolerances limits are tightened by margins that are fitted to the population in between, and each design of
    the result is judged by exact parts.  With a checkpoint every design is looked at within its tolerances.

    ``checkpoint`` names a file that is written after each generation.  The same call goes on from it when the process
    was killed, without losing a generation, and ends with the same front to the last bit.  A full disk or a missing
    folder ends no search: it warns (``RuntimeWarning``) and goes on without the file.

    Raises ``ValueError`` for a population below 4, or generations or a seed that are no whole numbers; for a
    checkpoint that is damaged, or of another study, population, seed or version, and for one of more generations.
    """
    warned = False
    for step in one_by_one(nsga2_steps(study, population, generations, seed, checkpoint)):
        if step.message and not warned:
            warned = True
            warnings.warn(
                f"the search goes on without the file {Path(str(checkpoint)).name}: {step.message}",
                RuntimeWarning,
                stacklevel=2,
            )
    return surviving(step.front)
