"""What one objective costs the other: designs between the best in either, by limits on the second."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..kinds import numbers, refuse_arguments
from ..quantities import counted
from ..study.study import Evaluation, Study
from .front import Front
from .minimise import Minimum, minimise
from .nsga2 import Generation

ROOM = 1e-6
"""How far above its least value, as a share, the second objective may lie at the end of the front."""


def trade_off(study: Study, points: int = 9, **search: Any) -> Iterator[Minimum]:
    """The front of a study with two objectives, from the best in the first to the best in the second.

    Between them the first is made small under a limit on the second (epsilon-constraint), at ``points`` even limits
    in all; each search starts where the last one ended, and ``search`` goes to `minimise`.  Every design keeps the
    study's limits if it is ``feasible``.  Leave the loop to stop.

    >>> from camkit.machines.high_speed_study import high_speed_study, peak_stress, peak_wear
    >>> study = high_speed_study().replace(minimise=(peak_stress, peak_wear))
    >>> front = [best.x for best in trade_off(study, 3)]
    >>> (study.evaluate(front).f * 0.001**0.5).round(1).tolist()
    [[1.7, 268.4], [1.7, 245.6], [5.5, 222.8]]

    Raises ``ValueError`` for another number of objectives or fewer than two points.
    """
    refuse_arguments(trade_off, locals())
    if len(study.minimise) != 2:
        raise ValueError(f"the study has {len(study.minimise)} objectives; a trade-off is between two")
    return _front(study, counted(points, "points"), search)


def trade_off_steps(study: Study, points: int = 9, **search: Any) -> Iterator[Generation]:
    """The front of `trade_off` as it grows: after each search all designs so far, as NSGA-II gives its generations.

    >>> from camkit.machines.high_speed_study import high_speed_study, peak_stress, peak_wear
    >>> study = high_speed_study().replace(minimise=(peak_stress, peak_wear))
    >>> [(step.number, step.of, len(step.front)) for step in trade_off_steps(study, 3)]
    [(1, 3, 1), (2, 3, 2), (3, 3, 3)]
    """
    minima = trade_off(study, points, **search)
    return _steps(study, points, minima)


def _steps(study: Study, points: int, minima: Iterator[Minimum]) -> Iterator[Generation]:
    found: list[Evaluation] = []
    for number, best in enumerate(minima, start=1):
        found.append(study.evaluate(best.x))
        x, f, g = (np.concatenate([getattr(one, name) for one in found]) for name in ("x", "f", "g"))
        yield Generation(number, points, Evaluation(x, f, g), study)


def _front(study: Study, points: int, search: Any) -> Iterator[Minimum]:
    first, second = study.minimise
    one = study.replace(minimise=(first,))
    best = minimise(one, **search)
    yield best
    other = minimise(one.replace(minimise=(second,), start=best.design), **search)
    least = other.f + ROOM * abs(other.f)
    for limit in np.linspace(float(study.evaluate(best.x).f[0, 1]), least, points)[1:]:
        start = best.design if limit > least else other.design
        limits = {**(study.at_most or {}), second: min(float(limit), (study.at_most or {}).get(second, np.inf))}
        best = minimise(one.replace(start=start, at_most=limits), **search)
        yield best


def dominated_shares(fronts: Mapping[str, Front], worst: Any) -> dict[str, float]:
    """Hypervolumes that can be compared: which share of a box each front dominates.

    The box goes from the best in each objective, of all fronts, to ``worst``; 1 would be a design that is best in
    everything.  ``nan`` if ``worst`` is no worse than the best in some objective.

    >>> from camkit.machines.high_speed_study import high_speed_study, peak_stress, peak_wear
    >>> study = high_speed_study().replace(minimise=(peak_stress, peak_wear))
    >>> *_, step = trade_off_steps(study, 5)
    >>> few = {"two": Front(study, step.front.x[::4], step.front.f[::4]), "five": step.front}
    >>> [round(share, 3) for share in dominated_shares(few, study.evaluate(study.x0).f[0]).values()]
    [0.757, 0.924]
    """
    refuse_arguments(dominated_shares, locals())
    worst = numbers(worst, "the worst objectives")
    if others := {front.f.shape[1:] for front in fronts.values()} - {worst.shape}:
        told = " x ".join(map(str, worst.shape)) or "one"
        raise ValueError(f"there are {told} worst objectives for fronts of {max(others)[0]}; they must be as many")
    found = [front.f for front in fronts.values() if len(front)]
    if not found:
        return dict.fromkeys(fronts, 0.0)
    best = np.concatenate(found).min(0)
    size = worst - best
    if not (size > 0).all():
        return dict.fromkeys(fronts, np.nan)
    return {n: replace(front, f=(front.f - best) / size).hypervolume(np.ones(len(best))) for n, front in fronts.items()}
