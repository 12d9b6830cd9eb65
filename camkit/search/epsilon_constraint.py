"""What one objective costs the other: designs between the best in either, by limits on the second."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..quantities import counted
from ..quantities.kinds import numbers, refuse_arguments
from ..study.study import Study
from .front import Front
from .minimise import ROUGH, minimise_steps
from .minimum import Minimum
from .protocol import Step

ROOM = 4 * ROUGH
"""How far above its least value, as a share, the second objective may lie at the end of the front.

It is twice what a rough descent keeps from its limits: with less room it would find no design that keeps them.
"""


def trade_off(study: Study, points: int = 9, **search: Any) -> Iterator[Minimum]:
    """The front of a study with two objectives, from the best in the first to the best in the second.

    Between them the first is made small under a limit on the second (epsilon-constraint), at ``points`` even limits
    in all; each search starts where the last one ended, and ``search`` goes to `minimise`.  Every design keeps the
    study's limits if it is ``feasible``.  Leave the loop to stop.

    >>> from camkit.machines import high_speed_measures as fast
    >>> study = fast.high_speed_study().replace(minimise=(fast.peak_stress, fast.peak_wear))
    >>> front = [best.x for best in trade_off(study, 3)]
    >>> (study.evaluate(front).f * 0.001**0.5).round(1).tolist()
    [[1.7, 268.4], [1.7, 245.6], [5.5, 222.8]]

    Raises ``ValueError`` for another number of objectives or fewer than two points.
    """
    steps = epsilon_constraint_steps(study, points, **search)
    return (step.best for step in steps if step.message and step.best)


def epsilon_constraint_steps(study: Study, points: int = 9, **search: Any) -> Iterator[Step]:
    """The front of `trade_off` as it grows; a step with a ``message`` ends the search for one of its designs.

    >>> from camkit.machines import high_speed_measures as fast
    >>> study = fast.high_speed_study().replace(minimise=(fast.peak_stress, fast.peak_wear))
    >>> steps = epsilon_constraint_steps(study, 3)
    >>> [(step.number, step.of, len(step.front)) for step in steps if step.message]
    [(1, 3, 1), (2, 3, 2), (3, 3, 3)]
    """
    refuse_arguments(epsilon_constraint_steps, locals())
    if len(study.minimise) != 2:
        raise ValueError(f"the study has {len(study.minimise)} objectives; a trade-off is between two")
    return _Tradeoff(study, counted(points, "points"), search).steps()


class _Tradeoff:
    """The searches, one after the other, and what they have found."""

    def __init__(self, study: Study, points: int, search: Mapping[str, Any]) -> None:
        self.study, self.points, self.search = study, points, search
        self.found = np.zeros((0, len(study.free)))
        self.evaluated = 0

    def steps(self) -> Iterator[Step]:
        first, second = self.study.minimise
        one, known = self.study.replace(minimise=(first,)), self.study.at_most or {}
        best = yield from self._best(one)
        other = yield from self._best(one.replace(minimise=(second,), start=best.design), kept=False)
        least = other.f + ROOM * abs(other.f)
        worst = float(self.study.evaluate(best.x).f[0, 1])
        for limit in np.linspace(worst, least, self.points)[1:]:
            start = best.design if limit > least else other.design
            limits = {**known, second: min(float(limit), known.get(second, np.inf))}
            best = yield from self._best(one.replace(start=start, at_most=limits))

    def _best(self, study: Study, kept: bool = True) -> Generator[Step, None, Minimum]:
        """One search; what it finds is a design of the front if it is ``kept``."""
        before = self.evaluated
        for step in minimise_steps(study, **self.search):
            self.evaluated = before + step.evaluated
            if step.message and kept:
                assert step.best is not None
                self.found = np.vstack([self.found, step.best.x])
            yield self._step(step, kept)
        assert step.best is not None
        return step.best

    def _step(self, step: Step, kept: bool) -> Step:
        x, message = self.found, step.message if kept else ""
        found = partial(self.study.evaluate, x)
        return Step(len(x), self.points, self.study, found, self.evaluated, step.best, message)


def dominated_shares(fronts: Mapping[str, Front], worst: object) -> dict[str, float]:
    """Hypervolumes that can be compared: which share of a box each front dominates.

    The box goes from the best in each objective, of all fronts, to ``worst``; 1 would be a design that is best in
    everything.  ``nan`` if ``worst`` is no worse than the best in some objective.

    >>> from camkit.machines import high_speed_measures as fast
    >>> study = fast.high_speed_study().replace(minimise=(fast.peak_stress, fast.peak_wear))
    >>> *_, step = epsilon_constraint_steps(study, 5)
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
