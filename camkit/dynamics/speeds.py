"""An elastic train over many speeds of its cam: what it does at each, and at which it first leaves the cam.

The least force is not monotone in the speed: where a harmonic of the motion meets the natural frequency the train
swings, and may leave the cam far below the speed at which a rigid follower would.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import unless
from ..quantities.kinds import numbers, refuse_arguments, shown
from ..quantities.types import Array, Value
from .driven import Analysed, Driven, bottom, driven
from .steady import LEAST, Response, a_speed, enough
from .trains import Train

BLOCK = 1 << 14
"""So many numbers of a curve are worked out at once: they stay in the processor's cache."""
SLOWEST, FASTEST = 1 / 256, 32.0
"""Between these shares of its natural frequency a train is looked at for the loss of contact."""
STEP = 0.01
"""From speed to speed, as a share of it, at most; half the damping ratio where that is less, but not below `FINEST`.

A resonance that is narrower than this is looked at where it is."""
FINEST = 1e-3
MOST_SECANTS, EXACT, TINY = 50, 1e-13, 1e-300
"""The speed of contact loss is right to such a share of the step in which it is found."""
CLOSE = 5760
"""Samples of a turn at which the speed of contact loss is found in the end, at least."""


class SpeedSweep(NamedTuple):
    """What an elastic train does at each speed: arrays ``(k,)`` for one design, ``(p, k)`` for a population.

    ``dwell_vibration`` has an axis more, that of the dwells, last.
    """

    speed: Array
    """Of the cam, rad/s, ``(k,)``."""
    max_force: Array
    """The largest contact force, N."""
    least_force: Array
    """The least, N; below 0 the motion is formal."""
    max_acceleration: Array
    """Of the last mass, m/s^2 or rad/s^2."""
    dwell_vibration: Array
    """The largest deviation from rest in each dwell, m or rad."""


def speed_sweep(analysis: Any, train: Train, speeds: ArrayLike, samples: int | None = None) -> SpeedSweep:
    """Steady motion behind one cam, or each of a population, at several ``speeds`` (rad/s), ``(k,)``.

    >>> from camkit import TranslatingFlatCam, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> sweep = speed_sweep(TranslatingFlatCam().analyse(), ElasticTrain(), np.array([300, 600, 900]) * rpm)
    >>> print(sweep.least_force.round(1))
    [49.1 42.4  0.8]

    Raises ``ValueError`` for speeds that are not finite numbers above 0 in a row, and as `Train.follow` does.
    """
    refuse_arguments(speed_sweep, locals())
    row = numbers(speeds, "the speeds of the cam")
    if row.ndim != 1 or not row.size:
        raise ValueError(f"the speeds of the cam are {shown(speeds)}; they must be numbers in a row")
    for speed in row[np.isnan(np.ravel(a_speed(row[:, None])))][:1]:
        a_speed(float(speed))
    first = train.follow(analysis, float(row.min()), samples or LEAST)
    count = samples or enough(first.natural_frequency, float(row.min()))
    given = first.driven if len(first.cam_angle) == count else driven(analysis, count)
    many = first.train_force.ndim > 1
    blocks = np.array_split(row, max(1, given.travel.size * row.size // BLOCK)) if not many else row[:, None]
    found = [_measured(Response(train, given, np.reshape(block, (-1, 1)))) for block in blocks]
    joined = (np.stack(part, axis=1) if many else np.concatenate(part) for part in zip(*found, strict=True))
    return SpeedSweep(row, *joined)


def _measured(response: Response) -> tuple[Value, ...]:
    response.refuse_resonance()
    return response.max_force, response.least_force, response.max_acceleration, response.dwell_vibration


def contact_loss_speed(analysis: Any, train: Train) -> Value:
    """The lowest speed of the cam at which an elastic train leaves it, rad/s: the least force there is 0.

    ``inf`` where it stays on up to 32 times its natural frequency; 0 where it does not even stay on a resting cam.
    `camkit.cam.jump_speed` is that of a rigid follower.  Undamped, every resonance loses contact: the train needs some
    damping.

    >>> from camkit import TranslatingFlatCam, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> print(f"{contact_loss_speed(TranslatingFlatCam().analyse(), ElasticTrain()) / rpm:.1f} rpm")
    902.1 rpm

    Raises ``ValueError`` for a train without damping, and as `Train.follow` does.
    """
    refuse_arguments(contact_loss_speed, locals())
    first = train.follow(analysis, samples=LEAST)
    rest = bottom(_at_rest(train, first.driven))
    shape = (*np.broadcast_shapes(rest.shape, first.train_force.shape[:-1]), 1)
    frequency, ratio = (
        np.broadcast_to(np.expand_dims(x, -1), shape) for x in (first.natural_frequency, first.damping_ratios.min(-1))
    )
    damped = np.logical_not(ratio <= 0)
    if refuse := unless(damped.all() if damped.size == 1 else damped):
        refuse("the train has no damping: every resonance loses contact; it must have some")
    scan = _Scan(analysis, train, *(np.where(damped, x, np.nan) for x in (frequency, ratio)))
    low, high = scan.bracket()
    speed = scan.between(low, high)
    closed = getattr(analysis, "form_closed", False)
    lost = np.where(closed, np.inf, np.where(rest <= 0, 0.0, speed[..., 0]))
    return np.where(np.isnan(rest) | ~damped[..., 0], np.nan, lost)[()]


def _at_rest(train: Train, given: Driven) -> Array:
    """The force on a cam that hardly turns, ``N_0 + k_f (k_s s + q) / (k_f + k_s)`` over the lever."""
    k = train.static_stiffness
    return (given.preload + k * (given.rate * given.travel + given.load) / (k + given.rate)) / given.lever


class _Scan:
    """The search for the lowest speed at which the least force of a train is 0."""

    def __init__(self, analysis: Analysed, train: Train, frequency: Array, ratio: Array) -> None:
        self.analysis, self.train, self.frequency = analysis, train, frequency
        self.step = min(float(np.nanmin(ratio, initial=np.inf)) / 2, STEP)
        self.given: dict[int, Driven] = {}

    def driven(self, samples: int) -> Driven:
        if samples not in self.given:
            self.given[samples] = driven(self.analysis, samples)
        return self.given[samples]

    def least(self, speed: Array, samples: int) -> Array:
        """The least force at speeds ``(k, 1)``, or ``(p, 1)`` of a population, in its shape."""
        return np.expand_dims(bottom(Response(self.train, self.driven(samples), speed).contact_force), -1)

    def bracket(self) -> tuple[Array, Array]:
        """Two speeds between which the least force falls below 0; both ``inf`` where it never does."""
        low = high = np.where(np.isnan(self.frequency), np.nan, np.inf)
        share = SLOWEST
        while np.isinf(high).any() and share < FASTEST:
            begin = self.frequency * share
            samples = enough(self.frequency[..., 0], np.nanmin(begin, initial=np.inf))
            low, high = self._octave(begin, self._steps(share), samples, low, high)
            share *= 2
        return low, high

    def _steps(self, share: float) -> Array:
        """The speeds of an octave, over its first one, which is a ``share`` of the natural frequency."""
        step = max(self.step, FINEST)
        even = np.exp(np.linspace(0, np.log(2), 1 + int(np.ceil(np.log(2) / step))))
        if self.step >= FINEST:
            return even
        hits = 1 / (share * np.arange(1, 1 + int(1 / share)))
        return np.union1d(even, hits[hits < 2])

    def _octave(self, begin: Array, steps: Array, samples: int, low: Array, high: Array) -> tuple[Array, Array]:
        """The same, of an octave of speeds."""
        if self.frequency.ndim == 1:
            blocks = np.array_split(steps, max(1, samples * len(steps) // BLOCK))
            least = np.concatenate([self.least(begin * block[:, None], samples) for block in blocks])[:, 0]
            lost = np.flatnonzero(least < 0)
            if lost.size:
                return begin * steps[max(lost[0] - 1, 0)], begin * steps[lost[0]]
            return low, high
        before = begin
        for factor in steps[1:]:
            now = begin * factor
            lost = np.isinf(high) & (self.least(now, samples) < 0)
            low, high = np.where(lost, before, low), np.where(lost, now, high)
            before = now
        return low, high

    def between(self, low: Array, high: Array) -> Array:
        """The speed between two at which the least force is 0, by secants (Dowell and Jarratt's Illinois method)."""
        found = np.isfinite(high)
        if not found.any():
            return high
        samples = max(CLOSE, enough(self.frequency[..., 0], np.min(low, where=found, initial=np.inf)))
        low, high = np.where(found, low, 1.0), np.where(found, high, 1.0)
        held, lacks = np.maximum(self.least(low, samples), TINY), np.minimum(self.least(high, samples), -TINY)
        size, before, at = held - lacks, np.zeros(found.shape), high
        for _ in range(MOST_SECANTS):
            at = high - lacks * (high - low) / (lacks - held)
            least = self.least(at, samples)
            lost = least < 0
            held, lacks = (
                np.where(lost, np.where(before < 0, held / 2, held), least),
                np.where(lost, least, np.where(before > 0, lacks / 2, lacks)),
            )
            low, high, before = np.where(lost, low, at), np.where(lost, at, high), np.where(lost, -1.0, 1.0)
            if np.all((abs(least) <= EXACT * size) | (high - low <= EXACT * high) | ~found):
                break
        return np.where(found, at, np.inf)
