"""A search from many seeds: each a search of its own, shared among processes, and the best of all."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping
from contextlib import closing
from dataclasses import fields
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..quantities.kinds import refuse_arguments, shown, whole
from ..study.study import Evaluation, Study
from .checkpoint import versions
from .jobs import Cost, Crew, crew_of, done, pays, refuse_crew
from .minimum import Active, Minimum, Reached
from .parts import Arrays, Parts, parts_of
from .protocol import Step, search

TRIED = 0.5
"""After so many seconds of the processor a seed may be left to other processes."""
MOST_SEEDS, MOST_SEED = 10_000, 2**63 - 1


class Found(NamedTuple):
    """What was found with a seed, as it is sent and kept: designs, and the rest in what JSON knows."""

    arrays: Arrays
    told: Mapping[str, Any]


def seeds_steps(
    study: Study,
    method: str,
    seeds: object,
    jobs: int = 1,
    cluster: str = "",
    checkpoint: str | Path | None = None,
    **options: Any,
) -> Iterator[Step]:
    """A step for each seed with which a search has ended; see `search`."""
    chosen = seeds_of(seeds)
    refuse_crew(jobs, cluster)
    refuse_arguments(seeds_steps, locals())
    if "seed" in options:
        raise ValueError("there are a seed and seeds; give one of them")
    search(study, method, seed=chosen[0], **options)  # refuses what it does not take
    parts = Parts() if checkpoint is None else parts_of(checkpoint, study, f"{method} with seeds", options)
    return _steps(partial(searched, study, method, options), study, chosen, parts, (jobs, cluster))


def seeds_of(given: object) -> tuple[int, ...]:
    """Seeds, each once; ``ValueError`` in a sentence for what are none.

    >>> seeds_of(range(3))
    (0, 1, 2)
    """
    if not isinstance(given, range) and not (isinstance(given, (tuple, list, np.ndarray)) and np.ndim(given) == 1):
        raise ValueError(f"the seeds are {shown(given)}; they must be whole numbers, such as range(30)")
    few = given[: MOST_SEEDS + 1]  # of a range that may be longer than Python counts
    if not 0 < len(few) <= MOST_SEEDS:
        raise ValueError(
            f"there are {'too many' if len(few) else 0} seeds; there must be one or more, up to {MOST_SEEDS}"
        )
    found = [whole(seed, "one of the seeds", 0, MOST_SEED) for seed in given]
    if twice := [seed for i, seed in enumerate(found) if seed in found[:i]]:
        raise ValueError(f"the seed {twice[0]} is there twice; a search with it would find the same")
    return tuple(found)


def searched(study: Study, method: str, options: Mapping[str, Any], seed: int) -> Found:
    """What a search ends with."""
    *_, last = search(study, method, seed=seed, **options)
    return found_in(last)


def _steps(
    work: partial[Found], study: Study, seeds: tuple[int, ...], parts: Parts, asked: tuple[int, str]
) -> Iterator[Step]:
    found: dict[int, Step] = {}
    for (seed, *_), arrays, told in parts.kept():
        found[seed] = restored(study, Found(arrays, told), parts)
    waiting = [seed for seed in seeds if seed not in found]
    if found:
        yield _together(study, seeds, found, parts)
    if not waiting:
        return
    with crew_of(*asked) as crew, closing(_shared(work, waiting, crew)) as results:
        for seed, result in results:
            parts.keep([seed], result.arrays, result.told)
            found[seed] = restored(study, result, parts)
            yield _together(study, seeds, found, parts)


def _shared(work: partial[Found], seeds: list[int], crew: Crew) -> Generator[tuple[int, Found]]:
    """Each seed with what was found; the first is tried here, and says whether it pays to share them."""
    begun, last, outside = Cost.now(), None, False
    study, method, options = work.args
    with closing(search(study, method, seed=seeds[0], **options)) as steps:  # type: ignore[type-var]
        for last in steps:
            spent = Cost.since(begun)
            if spent.all > TRIED and (outside := pays(spent.times(_rest(last)), len(seeds), crew)):
                break
    if not outside and last is not None:
        yield seeds[0], found_in(last)
        seeds, outside = seeds[1:], pays(Cost.since(begun), len(seeds) - 1, crew)
    yield from done(work, seeds, crew if outside else Crew())


def _rest(step: Step) -> float:
    """How many times as long as up to a step a search will take; twice where nobody knows."""
    return step.of / step.number if step.of and step.number else 2.0


def _together(study: Study, seeds: tuple[int, ...], found: Mapping[int, Step], parts: Parts) -> Step:
    """What was found with all seeds so far, in their order."""
    ended = {seed: found[seed] for seed in seeds if seed in found}
    each = [step.evaluation for step in ended.values()]
    evaluation = Evaluation(*(np.concatenate([getattr(e, name) for e in each]) for name in ("x", "f", "g")))
    evaluated = sum(step.evaluated for step in ended.values())
    known = [step.best for step in ended.values() if step.best is not None]
    best = min(known, key=lambda best: (not best.feasible, best.f), default=None)
    message = best.message if best is not None and len(ended) == len(seeds) else ""
    record = {"seeds": [*ended], "designs": evaluated, "seconds": parts.seconds, "versions": versions()}
    return Step(len(ended), len(seeds), study, evaluation, evaluated, best, message, record,
        seconds=parts.seconds, unkept=parts.unkept, seeds=ended)  # fmt: skip


# ---------------------------------------------------------------- as it is sent and kept


def found_in(step: Step) -> Found:
    """What a step has found, without its study."""
    evaluation, best = step.evaluation, step.best if len(step.study.minimise) == 1 else None
    told = {"evaluated": int(step.evaluated), "message": step.message, "record": dict(step.record), "best": None}
    if best is not None:
        values = {f.name: getattr(best, f.name) for f in fields(Minimum) if f.name != "study"}
        lists = {name: value.tolist() for name, value in values.items() if isinstance(value, np.ndarray)}
        told["best"] = {**values, **lists, "angles": best.study.angles}
    return Found((evaluation.x, evaluation.f, evaluation.g), told)


def restored(study: Study, found: Found, parts: Parts) -> Step:
    """The step that it was; ``ValueError`` in a sentence for what a damaged file makes of it."""
    told, x, f, g = found.told, *found.arrays
    sizes = (len(study.free), len(study.minimise), len(study.limits))
    try:
        if tuple(table.shape[1] for table in (x, f, g)) != sizes or not len(x) == len(f) == len(g):
            raise parts.damaged
        best = None if told["best"] is None else _minimum(study, dict(told["best"]))
        return Step(1, 1, study, Evaluation(x, f, g), told["evaluated"], best, told["message"], told["record"])
    except (KeyError, TypeError, IndexError):
        raise parts.damaged from None


def _minimum(study: Study, told: dict[str, Any]) -> Minimum:
    angles = told.pop("angles")
    judge = study if angles == study.angles else study.replace(angles=angles)
    told["x"] = np.array(told["x"], dtype=float)
    told["descended"] = None if told["descended"] is None else np.array(told["descended"], dtype=float)
    told["options"] = tuple(Reached(names, tuple(f), *rest) for names, f, *rest in told["options"])
    told["active"] = tuple(Active(kind, name, value, tuple(at)) for kind, name, value, at in told["active"])
    return Minimum(judge, **{**told, "ends": tuple(told["ends"])})
