"""What an elastic train does between two speeds of its cam, as measures: a search makes a cam that is good at them all.

The speeds are in even steps of their logarithm, of 1 % at most unless their number is given.  Of each measure a search
sees every cam angle at every speed, so that the minimax method of `camkit.minimise` makes the largest of all peaks
small.  Cam, preload and spring are the same at every speed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..extrema import crests
from ..quantities import LeastMeasure, PeakMeasure, counted, members, unless
from ..quantities.kinds import one_number
from ..quantities.types import Array, Value
from ..units import in_unit
from .driven import bottom, driven, top
from .steady import FASTEST, Response, enough

if TYPE_CHECKING:
    from .follower import Elastic

STEP, MOST = 0.01, 2000
"""From speed to speed, as a share of it, at most; so many speeds at most."""
BLOCK = 1 << 15
"""So many numbers of a curve are worked out at once, of each design at one speed at least."""


def dwell_vibration_between(low: float, high: float, speeds: int | None = None) -> PeakMeasure:
    """Vibration in the dwells, over the travel, at its largest between two speeds of the cam (rad/s).

    >>> from camkit import TranslatingFlatCam, rpm
    >>> from camkit.dynamics import ElasticFollower
    >>> within = dwell_vibration_between(250 * rpm, 350 * rpm)
    >>> print(f"{within.name}: {within.text(within(ElasticFollower(TranslatingFlatCam()).analyse()))}")
    vibration in the dwells, of the travel, 250 to 350 rpm: 0.009132 %

    Raises ``ValueError`` for what are no two speeds above 0, the lower one first, or a number of them above 2000; as a
    measure for a train without damping, which has no steady motion at a resonance.
    """
    within = _Between("vibration in the dwells, of the travel", low, high, speeds)
    return PeakMeasure(within.name, "%", within.most(_still), points=within.every(_away), made=within.made)


def peak_force_between(low: float, high: float, speeds: int | None = None) -> PeakMeasure:
    """The largest contact force between two speeds of the cam (rad/s), N; refused as `dwell_vibration_between` is."""
    within = _Between("peak contact force", low, high, speeds)
    peaks, points = within.most(lambda at: top(_force(at))), within.every(lambda at: crests(_force(at)))
    return PeakMeasure(within.name, "N", peaks, points=points, made=within.made)


def min_force_between(low: float, high: float, speeds: int | None = None) -> LeastMeasure:
    """The least contact force between two speeds of the cam (rad/s), N: below 0 the follower leaves the cam.

    Refused as `dwell_vibration_between` is.
    """
    within = _Between("minimum contact force", low, high, speeds)
    deepest = within.most(lambda at: -bottom(at.contact_force))
    points = within.every(lambda at: -crests(-at.contact_force))
    return LeastMeasure(within.name, "N", lambda a: -deepest(a), points=points, made=within.made)


MAKERS = {
    "vibration in the dwells, of the travel": dwell_vibration_between,
    "peak contact force": peak_force_between,
    "minimum contact force": min_force_between,
}
"""By the names of what they measure, for files."""
Seen = Callable[[Response], Array]
"""Of a response at ``k`` speeds, ``(..., k)`` and an axis more, or none."""


def _force(response: Response) -> Array:
    return abs(response.contact_force)


def _still(response: Response) -> Array:
    """The vibration in each dwell over the travel; 0 where there is no dwell."""
    found = response.dwell_vibration
    shown = found if found.shape[-1] else np.zeros((*found.shape[:-1], 1))
    return shown / _travel(response)


def _away(response: Response) -> Array:
    """The same at every cam angle; 0 outside the dwells."""
    angle, away = response.cam_angle, abs(response.position - response.rest)
    dwells = [(angle >= start) & (angle <= end) for start, end in response.driven.dwells]
    within = np.any(dwells, axis=0) if dwells else np.zeros(angle.shape, dtype=bool)
    deep = within & np.roll(within, 1, axis=-1) & np.roll(within, -1, axis=-1)
    return np.where(within, crests(away, deep), 0.0) / _travel(response)


def _travel(response: Response) -> Array:
    return np.ptp(response.driven.travel, axis=-1, keepdims=True)


@dataclass(frozen=True)
class _Between:
    """Speeds of a cam from ``low`` to ``high``, for a measure of that name."""

    of: str
    low: float
    high: float
    count: int | None

    def __post_init__(self) -> None:
        must = f"be a finite number above 0 and at most {FASTEST:g} rad/s"
        for which in ("low", "high"):
            one_number(getattr(self, which), f"the {which}est speed of the cam", must, lambda w: 0 < w <= FASTEST)
        if self.high < self.low:
            raise ValueError(f"the speeds are from {self._rpm[0]} to {self._rpm[1]} rpm; the lower one must come first")
        counted(self._count, f"speeds from {self._rpm[0]} to {self._rpm[1]} rpm", 1, MOST)

    @property
    def _rpm(self) -> tuple[str, str]:
        return f"{in_unit(self.low, 'rpm'):.6g}", f"{in_unit(self.high, 'rpm'):.6g}"

    @property
    def _count(self) -> int:
        return 1 + int(np.ceil(np.log(self.high / self.low) / STEP)) if self.count is None else self.count

    @property
    def name(self) -> str:
        return f"{self.of}, {' to '.join(self._rpm)} rpm"

    @property
    def made(self) -> tuple[object, ...]:
        """How a file has it made again."""
        return (self.of, float(self.low), float(self.high), *(() if self.count is None else (self.count,)))

    def most(self, peaks: Seen) -> Callable[[Elastic], Value]:
        """The largest of ``peaks``."""
        return lambda analysis: self._seen(analysis, peaks).max(-1)[()]

    def every(self, curve: Seen) -> Callable[[Elastic], Value]:
        """All points of a curve: as many for every design."""
        return lambda analysis: self._seen(analysis, curve, analysis.samples + analysis.samples % 2)

    def _seen(self, analysis: Elastic, of: Seen, samples: int | None = None) -> Array:
        """What is seen at all speeds, side by side: ``(m,)``, or ``(p, m)`` of a population."""
        several = analysis.response.train_force.shape[:-1]
        parts = (of(response) for response in self._responses(analysis, several, samples))
        return np.concatenate([part.reshape(*several, -1) for part in parts], axis=-1)

    def _responses(self, analysis: Elastic, several: tuple[int, ...], samples: int | None) -> Iterator[Response]:
        """Steady motion at the speeds, some at a time: ``(k, n)``, or ``(p, k, n)`` of a population."""
        found = analysis.response
        damped = np.atleast_1d(found.damping_ratio > 0)
        if refuse := unless(damped.all() if damped.size == 1 else damped):
            refuse("the train has no damping, so no steady motion at a resonance; between two speeds it must have some")
        count = samples or max(analysis.samples + analysis.samples % 2, enough(found.natural_frequency, self.low))
        train, given = found.train, found.driven if len(found.cam_angle) == count else driven(analysis, count)
        for rows in (np.arange(p)[:, None] for p in several):
            train, given = members(train, rows), members(given, rows)
        speeds = np.geomspace(self.low, self.high, self._count)[:, None]
        numbers = int(np.prod(several)) * self._count * count
        for block in np.array_split(speeds, min(self._count, 1 + numbers // BLOCK)):
            yield Response(train, given, np.where(damped[:, None, None], block, np.nan) if several else block)
