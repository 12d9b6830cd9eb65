"""How fast a machine may run: the shortest interval in which a study's optimum still keeps a limit.

The optimum is no formula of the interval, so the interval is halved around it: an outer bisection, each inner
search starting where the last one ended.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, log2
from typing import Any

import numpy as np

from ..quantities import Paths, Quantity, with_quantities
from ..quantities.kinds import refuse_arguments
from ..study.study import Study
from ..units import deg
from .minimise import minimise_steps
from .minimum import Minimum
from .protocol import Step

INTERVALS = ("rise_angle", "return_angle")
"""The paths of the cam angles of a design's moves, unless others are named."""


@dataclass(frozen=True, kw_only=True)
class IntervalStep(Step):
    """A step that ends an interval: ``tried`` [rad] with its ``optimum``; ``best`` is of the shortest so far.

    ``low`` is too short (0 while none is known to be), ``high`` is long enough; ``best`` is ``None`` if not even the
    longest keeps the limit.
    """

    tried: float
    optimum: Minimum
    low: float
    high: float
    first: float
    limit: float

    @property
    def saving(self) -> float:
        """By how much shorter than the first interval, as a share of it."""
        return 1 - self.high / self.first

    @property
    def gain(self) -> float:
        """More output per hour, as a share, if the machine's cycle shrinks as the interval does."""
        return self.first / self.high - 1

    @property
    def words(self) -> str:
        """What is known of the interval."""
        measure = self.optimum.study.minimise[0]
        limit = f"{measure.name} of at most {measure.text(self.limit)}"
        if self.best is None:
            least = f"the least there is {measure.text(self.optimum.f)}" if self.optimum.feasible else "no design fits"
            return f"An interval of {self.tried / deg:.4g} deg does not keep the {limit}: {least}."
        shorter = f", one of {self.low / deg:.4g} deg does not" if self.low else ""
        return f"An interval of {self.high / deg:.4g} deg keeps the {limit}{shorter}: {self._gained}."

    @property
    def _gained(self) -> str:
        if self.high == self.first:
            return "it is the longest, from which gains count"
        return (
            f"{100 * self.saving:.1f} % less time than {self.first / deg:.4g} deg, and {100 * self.gain:.1f} % more "
            "output per hour if the machine's cycle shrinks as the interval does"
        )


def shortest_interval(
    study: Study,
    limit: float,
    shortest: float,
    longest: float,
    *,
    intervals: tuple[str, ...] = INTERVALS,
    tolerance: float = 0.1 * deg,
    **search: Any,
) -> Iterator[IntervalStep]:
    """The shortest interval with which the optimum of ``study`` is at most ``limit``, step by step.

    The quantities ``intervals`` of the design are set alike, from ``longest`` down to ``shortest`` (rad), until they
    are known to ``tolerance``.  Leave the loop to stop: every step holds the best so far.  ``search`` goes to
    `minimise`.  Gains count from ``longest``.

    >>> from camkit.machines import cam_lever_study
    >>> from camkit.units import cm
    >>> *_, last = shortest_interval(cam_lever_study(free_laws=False), 9 / cm**0.5, 50 * deg, 61 * deg)
    >>> print(f"{last.high / deg:.0f} deg, {100 * last.gain:.0f} % more output")
    57 deg, 7 % more output

    Raises ``ValueError`` for angles that are not ``0 < shortest < longest``, or a tolerance that is not above 0.
    """
    steps = cycle_time_steps(study, limit, shortest, longest, intervals=intervals, tolerance=tolerance, **search)
    return (step for step in steps if isinstance(step, IntervalStep))


def cycle_time_steps(
    study: Study,
    limit: float,
    shortest: float,
    longest: float,
    *,
    intervals: tuple[str, ...] = INTERVALS,
    tolerance: float = 0.1 * deg,
    **search: Any,
) -> Iterator[Step]:
    """`shortest_interval` with the steps of each of its searches; an `IntervalStep` ends the search of an interval."""
    refuse_arguments(cycle_time_steps, locals())
    if not len(intervals):
        raise ValueError("there is no interval to shorten; name one or more of the design's")
    Paths(study.start, intervals, Quantity)  # refuses what is none
    if not 0 < shortest < longest < np.inf:
        raise ValueError(
            f"the interval is to lie between {shortest / deg:.4g} and {longest / deg:.4g} deg; "
            "both must be above 0 deg, the first below the second"
        )
    if not tolerance > 0:
        raise ValueError(f"the tolerance is {tolerance / deg:.4g} deg; it must be above 0 deg")
    return _bisection(study, limit, shortest, longest, intervals, tolerance, search)


def _bisection(
    study: Study, limit: float, low: float, high: float, intervals: tuple[str, ...], tolerance: float, search: Any
) -> Iterator[Step]:
    first, too_short, tried, number, evaluated = high, 0.0, high, 0, 0
    best: Minimum | None = None
    of = 2 + ceil(log2(max((high - low) / tolerance, 1)))
    while high - max(too_short, low) > tolerance or best is None:
        start = with_quantities(best.design if best else study.start, dict.fromkeys(intervals, tried))
        for step in minimise_steps(study.replace(start=start), **search):
            if not step.message:
                yield replace(step, number=number, of=of, evaluated=evaluated + step.evaluated, best=best)
        optimum, number, evaluated = step.best, number + 1, evaluated + step.evaluated
        assert optimum is not None
        if optimum.feasible and optimum.f <= limit:
            best, high = optimum, tried
        else:
            too_short = tried
        last = IntervalStep(
            number,
            of,
            step.study,
            step.found,
            evaluated,
            best,
            tried=tried,
            optimum=optimum,
            low=too_short,
            high=high,
            first=first,
            limit=limit,
        )
        yield replace(last, message=last.words)
        if best is None:
            return
        tried = (too_short + high) / 2 if too_short else low
