"""What one objective costs the other: designs between the best in either, by limits on the second."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .minimise import Minimum, minimise
from .quantities import counted
from .study import Study

ROOM = 1e-6
"""How far above its least value, as a share, the second objective may lie at the end of the front."""


def trade_off(study: Study, points: int = 9, **search: Any) -> Iterator[Minimum]:
    """The front of a study with two objectives, from the best in the first to the best in the second.

    Between them the first is made small under a limit on the second (epsilon-constraint), at ``points`` even limits
    in all; each search starts where the last one ended, and ``search`` goes to `minimise`.  Every design keeps the
    study's limits if it is ``feasible``.  Leave the loop to stop.

    >>> from camkit.cam.high_speed_study import high_speed_study, peak_stress, peak_wear
    >>> study = high_speed_study().replace(minimise=(peak_stress, peak_wear))
    >>> front = [best.x for best in trade_off(study, 3)]
    >>> (study.evaluate(front).f * 0.001**0.5).round(1).tolist()
    [[1.7, 268.4], [1.7, 245.6], [5.5, 222.8]]

    Raises ``ValueError`` for another number of objectives or fewer than two points.
    """
    if len(study.minimise) != 2:
        raise ValueError(f"the study has {len(study.minimise)} objectives; a trade-off is between two")
    return _front(study, counted(points, "points"), search)


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
