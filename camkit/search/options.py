"""Searches through free menus: one plain search for each combination of options, and what is best of all."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ..quantities import D
from ..quantities.types import Array
from ..study.options import Plain
from ..study.study import Evaluation, Study
from .front import Front, front_of
from .minimum import Found, Minimum, Reached, described
from .protocol import Step
from .robust_front import surviving

MOST = 200
"""So many combinations of options are gone through one by one."""
FEW = 5
"""So many of them a message names beside the best."""
ALONE = "Nothing but options is free"


def refuse_many(study: Study, search: str, instead: str) -> None:
    """``ValueError`` in a sentence for more combinations of options than can be gone through."""
    if study.options.count > MOST:
        raise ValueError(
            f"there are {study.options.count} combinations of options; {search} goes through up to {MOST}: "
            f"free fewer options, or take {instead}"
        )


# ---------------------------------------------------------------- one objective


def best_of_options(study: Study[D], judge: Study[D], find: Callable[[Study[D]], Minimum[D]]) -> Minimum[D]:
    """The best of what ``find`` finds with each combination of options; ``judge`` is the study of the result."""
    refuse_many(study, "this method", 'method="ga"')
    every = [(made, _found(made, find)) for made in study.options.each()]
    reached = [_reached(judge, made, found) for made, found in every]
    good = [(made, found) for made, found in every if isinstance(found, Minimum)]
    if not good:
        return replace(described(judge, Found(judge.x0, 0, (), "No options can be built")), options=tuple(reached))
    rows = np.vstack([made.rows(found.x[None]) for made, found in good])
    said = judge.evaluate(rows)
    i = int(np.lexsort((said.f[:, 0], said.missed.sum(-1), ~said.feasible))[0])
    made, best = good[i]
    used = sum(found.evaluations for _, found in good)
    message = f"{best.message} {_told(made.name, reached)}".rstrip()
    return replace(best, study=judge, x=rows[i], evaluations=used, message=message, options=tuple(reached))


def _found(made: Plain[Study[D]], find: Callable[[Study[D]], Minimum[D]]) -> Minimum[D] | str:
    """What is found with some options, or why nothing is."""
    if made.why:
        return made.why
    try:
        if made.study.free:
            return find(made.study)
        return described(made.study, Found(np.zeros(0), 1, (), ALONE))
    except ValueError as refusal:  # what cannot be built with these options
        return str(refusal)


def _reached(study: Study, made: Plain, found: Minimum | str) -> Reached:
    if isinstance(found, str):
        return Reached(made.names, (np.nan,) * len(study.minimise), False, found)
    objective = study.minimise[0]
    text = objective.text(objective.sign * found.f) if found.feasible else found.message.partition(". ")[2]
    return Reached(made.names, (found.f,), found.feasible, text)


def _told(name: str, reached: list[Reached]) -> str:
    """How the options compare, in words."""
    if len(reached) < 2:
        return ""
    good = sorted((r for r in reached if r.feasible), key=lambda r: r.f)
    others = "; ".join(f"{r.name} {r.text}" for r in good[1 : FEW + 1])
    more = f", and {len(good) - FEW - 1} more" if len(good) > FEW + 1 else ""
    missed = len(reached) - len(good)
    none = f" {missed} of them {'keeps' if missed == 1 else 'keep'} not every limit." if missed else ""
    return f"Best of {len(reached)} options: {name}{'; then ' + others if others else ''}{more}.{none}"


# ---------------------------------------------------------------- several objectives

Steps = Callable[[Study[D], Front[D] | None], Iterator[Step]]


class _Part(NamedTuple):
    """What was found with some options: rows of the whole study and their objectives."""

    x: Array
    f: Array


def fronts_of_options(
    study: Study[D],
    steps: Steps[D],
    start: Front[D] | None,
    thin: Callable[[Array], Array],
) -> Iterator[Step]:
    """The ``steps`` of the search with each combination of options, and a last one with what is best of all.

    ``thin`` says which rows of objectives stay where they are many.
    """
    every = [*study.options.each()]
    began, evaluated, number, of = time.monotonic(), 0, 0, 0
    parts, reached = [_Part(np.zeros((0, len(study.free))), np.zeros((0, len(study.minimise))))], []
    for k, made in enumerate(every):
        front: Front[D] | str = made.why or "no search was made"
        try:
            for step in () if made.why else steps(made.study, _within(start, made)):
                number, of = k * step.of + step.number, len(every) * step.of
                if step.number < step.of:
                    so_far = partial(_together, study, [*parts], made, step)
                    yield replace(_step(study, began, number, of, evaluated + step.evaluated), found=so_far)
                else:
                    front, evaluated = surviving(step.front), evaluated + step.evaluated
        except ValueError as refusal:
            front = str(refusal)
        if isinstance(front, Front):
            parts.append(_Part(made.rows(front.x), front.f))
        reached.append(_reached_by(study, made, front))
    x, f = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    whole = front_of(_judged(study, x, f), study)
    kept = thin(whole.f)
    found = _judged(study, whole.x[kept], whole.f[kept])
    yield replace(_step(study, began, of or 1, of or 1, evaluated), found=found, options=tuple(reached))


def alone(study: Study) -> Iterator[Step]:
    """The one step of a study in which nothing is free but options."""
    yield Step(1, 1, study, study.evaluate(np.zeros((1, 0))), 1)


def _step(study: Study, began: float, number: int, of: int, evaluated: int) -> Step:
    from .checkpoint import versions

    none = _judged(study, np.zeros((0, len(study.free))), np.zeros((0, len(study.minimise))))
    record = {"designs": evaluated, "seconds": time.monotonic() - began, "versions": versions()}
    return Step(number, of, study, none, evaluated, record=record)


def _judged(study: Study, x: Array, f: Array) -> Evaluation:
    """An evaluation of designs that keep every limit."""
    return Evaluation(x, f, np.zeros((len(x), len(study.limits))))


def _together(study: Study, parts: list[_Part], made: Plain, step: Step) -> Evaluation:
    """What was found so far, with what the search now works with."""
    now, x, f = step.evaluation, *(np.concatenate(columns) for columns in zip(*parts, strict=True))
    before = _judged(study, x, f)
    both = ((before.x, made.rows(now.x)), (before.f, now.f), (before.g, now.g))
    return Evaluation(*(np.concatenate(columns) for columns in both))


def _within(start: Front[D] | None, made: Plain[Study[D]]) -> Front[D] | None:
    """The part of a former front that has these options."""
    if start is None:
        return None
    rows = made.row == start.x
    rows[:, made.columns] = True
    at = rows.all(-1)
    return Front(made.study, made.x(start.x[at]), start.f[at])


def _reached_by(study: Study, made: Plain, front: Front | str) -> Reached:
    """What the front with some options reached."""
    if isinstance(front, str) or not len(front):
        why = front if isinstance(front, str) else front.message
        return Reached(made.names, (np.nan,) * len(study.minimise), False, why)
    least = front.f.min(0)
    text = ", ".join(f"{m.name} {m.text(m.sign * v)}" for m, v in zip(study.minimise, least, strict=True))
    return Reached(made.names, tuple(map(float, least)), True, text)
