"""`quick_front`: the Pareto front of a study with few free quantities, fast enough to follow a slider.

An archive search.  It keeps the designs that no other beats, evenly spread, and tries a batch of others near them in
every round: between and beyond neighbours where the front has its widest gaps, by the differences of neighbours
(the step of differential evolution: it has the front's own direction and size), and by steps along one quantity that
shrink from round to round.  The rounds look roughly, at few angles of each design; the last rounds look exactly.

It knows studies, not mechanisms.  `nsga2` serves any number of free quantities.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from ..decision.choosers import normalised
from ..quantities import D, counted
from ..quantities.kinds import refuse_arguments
from ..study.study import Evaluation, Study
from .checkpoint import versions
from .front import Front, dominated
from .options import alone, fronts_of_options, refuse_many
from .protocol import Step, looked_at, on_grid
from .robust_front import FITTED, RAISED, Room, looked_at_closely, surviving
from .threads import in_one_thread

MOST_FREE = 4
"""A box of more free quantities has too many corners for this search."""
BATCH = 256
"""Designs of a round."""
GAPS, STEPS = 0.1, 0.3
"""Shares of a batch that go into gaps of the front and along one quantity; the others are differences."""
NEIGHBOURS = 10
"""How many places away on the front a neighbour may be."""
SHRINKING = 0.75
"""How the steps along one quantity shrink from round to round."""
LAST_ROUNDS = 2
"""Rounds on all angles."""
RENEWED = 10 / 24
"""After which share of the rounds the margins for tolerances are fitted again."""
FEW = 12
"""So few designs that keep their limits are joined by those that miss them least for what they are worth."""
GROWN = 3
"""At how many times its size the archive is thinned."""
DIGITS = 2.0**36
"""Objectives are compared to 11 digits, so that the last bits of a processor do not grow into another front."""


class Pace(NamedTuple):
    """How thoroughly a search goes: designs all over the box, rounds on few angles, first step as a share."""

    first: int
    rounds: int
    step: float


COLD, WARM = Pace(512, 24, 0.25), Pace(128, 4, 0.05)
"""From nothing, and from a front that is near."""


class Archive(NamedTuple):
    """Designs as shares of the bounds ``u``, their objectives ``f`` and by how much they miss their limits."""

    u: np.ndarray
    f: np.ndarray
    missed: np.ndarray


def quick_front(study: Study[D], size: int = 100, start: Front[D] | None = None) -> Front[D]:
    """The Pareto front of ``study``, up to ``size`` designs, in tenths of a second; the same at every call.

    ``start`` is the front of a study like this one, which saves most of the search.  Every design that is returned
    was judged on all angles of the study, and under tolerances by exact parts (``yields``); an empty front says in
    ``message`` which limit stood in the way.

    Where menus are free there is a search for each combination of options, up to 200, and what is best of all of them
    is the front; ``options`` says what each reached.

    >>> from camkit.machines import door_handle_study
    >>> front = quick_front(door_handle_study())
    >>> len(front), front.study.evaluate(front.x).feasible.all()
    (100, np.True_)

    Raises ``ValueError`` for a study with one objective or more than four free quantities, and for a start with
    other free quantities.
    """
    front = modelled_front(study, size, start)
    return front if study.menus else surviving(front)


def modelled_front(study: Study[D], size: int = 100, start: Front[D] | None = None) -> Front[D]:
    """`quick_front` without exact parts: under tolerances its designs survive by the models of their limits."""
    with in_one_thread():
        *_, last = fast_front_steps(study, size, start)
        return last.front


def fast_front_steps(study: Study, size: int = 100, start: Front | None = None) -> Iterator[Step]:
    """`quick_front` one round at a time; leave the loop to stop."""
    _refuse(study, start)
    if study.menus:
        steps = partial(_steps_with_options, size)
        yield from fronts_of_options(study, steps, start, lambda f: spread(f, size))
        return
    began, told = time.monotonic(), versions()
    size, draw = counted(size, "designs on the front", 4), np.random.default_rng(0)
    coarse, room = study.roughly, Room(study.roughly)
    pace = WARM if start is not None and len(start) and coarse.evaluate(start.x).feasible.any() else COLD
    # The first round goes on from all of these: beside a beaten design may lie a part of the front.
    archive = _judged(room.within(coarse), np.vstack([_near(study, start), _everywhere(len(study.free), pace.first)]))
    designs = len(archive.u)
    for number in range(pace.rounds + LAST_ROUNDS):
        judge = coarse if number < pace.rounds else study
        if room.needed and number in (0, int(RENEWED * pace.rounds)):
            room.renew(_x(study, _thinned(_best(archive, size), FITTED).u))
            archive = _judged(room.within(coarse), archive.u)
        if number == pace.rounds:
            if room.needed:
                room.raise_to(_x(study, _thinned(archive, RAISED).u))
            archive = _best(_judged(room.within(study), archive.u), size)
        tried = _judged(room.within(judge), _tried(archive, pace.step * SHRINKING**number, draw))
        archive, designs = _best(_joined(archive, tried), size), designs + len(tried.u)
        record = {"designs": designs, "seconds": time.monotonic() - began, "versions": told}
        found = partial(_exactly, study, archive, size)
        yield Step(number + 1, pace.rounds + LAST_ROUNDS, study, found, designs, record=record)


def _steps_with_options(size: int, study: Study, start: Front | None) -> Iterator[Step]:
    return fast_front_steps(study, size, start) if study.free else alone(study)


def _exactly(study: Study, archive: Archive, size: int) -> Evaluation:
    """An even spread of the archive's designs, judged on all angles."""
    return looked_at_closely(study, study.roughly, _x(study, _thinned(archive, size).u))


def _refuse(study: Study, start: Front | None) -> None:
    refuse_arguments(_refuse, locals())
    refuse_many(study, "a quick front", "nsga2()")
    n, objectives = max(len(made.study.free) for made in study.options.each()), len(study.minimise)
    if n > MOST_FREE:
        raise ValueError(f"a quick front takes up to {MOST_FREE} free quantities; this study has {n}: take nsga2()")
    if objectives < 2:
        raise ValueError("a quick front takes two or more objectives; this study has one: take minimise")
    if start is not None and start.study.menus != study.menus:
        raise ValueError("the start has other menus, or other options in them, than this study")
    if start is not None and tuple(start.study.free) != tuple(study.free):
        raise ValueError(
            f"the start has the free quantities {', '.join(start.study.free)}; this study has {', '.join(study.free)}"
        )


def _x(study: Study, u: np.ndarray) -> np.ndarray:
    """Free values of shares of the bounds."""
    low, high = study.bounds
    return np.clip(low + u * (high - low), low, high)


def _near(study: Study, start: Front | None) -> np.ndarray:
    """A former front as shares of the bounds, ``(p, n)``."""
    low, high = study.bounds
    return np.zeros((0, len(low))) if start is None else (start.x - low) / (high - low)


def _everywhere(n: int, count: int) -> np.ndarray:
    """Shares all over the box: Sobol's, and the corners and middles, where limits of the box hold a front."""
    from scipy.stats import qmc

    lattice = np.stack(np.meshgrid(*[[0, 0.5, 1]] * n), axis=-1).reshape(-1, n)
    return np.vstack([lattice, qmc.Sobol(n, rng=0).random(count)])


def _judged(study: Study, u: np.ndarray) -> Archive:
    """What the study says of shares, moved into the bounds and onto the grid, each once."""
    u = on_grid(np.clip(u, 0, 1))
    u = u[_each_once(u)]
    evaluation = looked_at(study, _x(study, u))
    built = np.isfinite(evaluation.f).all(-1)
    mantissa, exponent = np.frexp(evaluation.f)
    f = np.ldexp(np.round(mantissa * DIGITS) / DIGITS, exponent)
    return Archive(u, f, np.where(built, evaluation.missed.sum(-1), np.inf))


def _joined(first: Archive, second: Archive) -> Archive:
    return Archive(*map(np.concatenate, zip(first, second, strict=True)))


def _best(archive: Archive, size: int) -> Archive:
    """What keeps its limits and is not beaten, in order of the first objective; thinned if it has grown too large.

    As long as nothing keeps its limits: what misses them least.
    """
    kept = np.flatnonzero(archive.missed == 0)
    if not len(kept):
        return _of(archive, np.argsort(archive.missed, kind="stable")[:size])
    best = kept[_unbeaten(archive.f[kept])]
    if len(best) < FEW:
        near = np.flatnonzero((archive.missed > 0) & np.isfinite(archive.missed))
        near = near[_unbeaten(np.column_stack([archive.f[near], archive.missed[near]]))]
        best = np.append(best, near[np.argsort(archive.missed[near], kind="stable")][: FEW - len(best)])
        return _of(archive, best[np.argsort(archive.f[best, 0], kind="stable")])
    found = _of(archive, best)
    return found if len(found.f) <= GROWN * size else _thinned(found, size)


def _of(archive: Archive, rows: np.ndarray) -> Archive:
    return Archive(*(values[rows] for values in archive))


def _unbeaten(f: np.ndarray) -> np.ndarray:
    """Indices of the rows that no other beats, of equal rows one, in order of the first objective."""
    once = _each_once(f)
    return once[~dominated(f[once])]


def _each_once(rows: np.ndarray) -> np.ndarray:
    """Indices of rows in order of their numbers, of equal rows the first: ``np.unique``, in a fifth of its time."""
    order = np.lexsort(rows.T[::-1])
    new = np.ones(len(rows), dtype=bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(-1)
    return order[new]


def _thinned(archive: Archive, size: int) -> Archive:
    """An even spread of ``size`` designs."""
    return _of(archive, spread(archive.f, size))


def spread(f: np.ndarray, size: int) -> np.ndarray:
    """Which ``size`` rows of objectives are spread evenly: again and again the one farthest from those taken."""
    if len(f) <= size:
        return np.arange(len(f))
    columns = np.ascontiguousarray(normalised(f).T)
    taken = list(dict.fromkeys(columns.argmin(1).tolist()))
    gap, apart, places = np.full(len(f), np.inf), np.empty_like(columns), columns[:, :, None]
    for one in taken:
        _nearer(gap, apart, columns, places[:, one])
    while len(taken) < size:
        taken.append(int(gap.argmax()))
        _nearer(gap, apart, columns, places[:, taken[-1]])
    return np.sort(taken)


def _nearer(gap: np.ndarray, apart: np.ndarray, columns: np.ndarray, one: np.ndarray) -> None:
    """Let ``gap`` be how far all designs are from ``one``, squared, where that is less; ``apart`` is room for it."""
    np.subtract(columns, one, out=apart)
    np.multiply(apart, apart, out=apart)
    first, *others = apart
    for other in others:
        np.add(first, other, out=first)
    np.minimum(gap, first, out=gap)


def _tried(archive: Archive, step: float, draw: np.random.Generator) -> np.ndarray:
    """The shares of a round."""
    gaps, steps = int(GAPS * BATCH), int(STEPS * BATCH)
    return np.vstack(
        [
            _in_gaps(archive, gaps, draw),
            _along_one(archive.u, steps, step, draw),
            _by_differences(archive.u, BATCH - gaps - steps, draw),
        ]
    )


def _in_gaps(archive: Archive, count: int, draw: np.random.Generator) -> np.ndarray:
    """Between and beyond neighbours (in the order of each objective) that lie far apart on the front."""
    f, u = normalised(np.where(np.isfinite(archive.f), archive.f, 0)), archive.u
    order = np.argsort(f, axis=0, kind="stable").T
    first, second = order[:, :-1].ravel(), order[:, 1:].ravel()
    widest = np.argsort(-((f[first] - f[second]) ** 2).sum(-1), kind="stable")[:count]
    share = draw.uniform(-0.5, 1.5, (len(widest), 1))
    share[::2] = 0.5
    return u[first[widest]] * (1 - share) + u[second[widest]] * share


def _along_one(u: np.ndarray, count: int, step: float, draw: np.random.Generator) -> np.ndarray:
    """Steps of up to twice ``step`` along one quantity."""
    base = np.resize(draw.permutation(len(u)), count)
    direction = np.eye(u.shape[1])[draw.integers(u.shape[1], size=count)]
    return u[base] + 2 * step * draw.uniform(-1, 1, (count, 1)) * direction


def _by_differences(u: np.ndarray, count: int, draw: np.random.Generator) -> np.ndarray:
    """Moves by the difference, whole or half, of two neighbours on the front, which is in order of an objective."""
    base = draw.integers(len(u), size=count)
    first, second = np.clip(base + draw.integers(-NEIGHBOURS, NEIGHBOURS + 1, (2, count)), 0, len(u) - 1)
    return u[base] + draw.choice([0.5, 1.0], (count, 1)) * (u[first] - u[second])
