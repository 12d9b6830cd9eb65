"""What drives a train over a turn of the cam, as a rigid follower's analysis has it, at even cam angles."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol, Self

import numpy as np

from ..extrema import Extreme, raised
from ..motion import Kinematics
from ..motion.closing import TURN
from ..quantities import unless
from ..quantities.applied import applied
from ..quantities.types import Array, Value
from ..units import in_unit

ROUND = 2.0
"""By how much more than beside it values may bend at a sample, else they have a corner there."""
MARGIN = 5
"""So many cam angles show a step at either end of a dwell."""


class Analysed(Protocol):
    """The analysis of a cam with one follower, as every cam of `camkit.cam` has it."""

    cam: Any

    @property
    def motion(self) -> Kinematics: ...

    @property
    def static_resistance(self) -> Array: ...

    @property
    def closing_rate(self) -> Value: ...

    @property
    def inertia(self) -> Value: ...

    @property
    def speed(self) -> Value: ...

    @property
    def lever(self) -> Array: ...

    @property
    def buildable(self) -> Array: ...

    def at(self, cam_angle: Array) -> Self: ...

    def corner(self, way: int) -> Extreme: ...


@dataclass(frozen=True)
class Driven:
    """The cam's motion and the load at even cam angles from 0: ``(n,)`` or ``(p, n)``; the rest ``(1,)`` or ``(p, 1)``.

    Lengths in m, forces in N, masses in kg; of an arm angles in rad, torques in N m, moments of inertia in kg m^2.
    """

    cam_angle: Array
    travel: Array
    """``s``: from the cam angle 0."""
    velocity: Array
    """``v``: by the cam angle, as are its derivatives."""
    acceleration: Array
    load: Array
    """``q``: what resists besides inertia and the return spring, less what does at the cam angle 0."""
    lever: Array
    """Force along the travel that a contact force of 1 N carries."""
    level: Array
    """Of the follower at the cam angle 0."""
    preload: Array
    """``N_0``: what resists at the cam angle 0."""
    mass: Array
    """Of the load, all of it."""
    rate: Array
    """``k_s``: of the return spring."""
    damping: Array
    """Of the load to the frame, besides that of the train, N s/m or N m s/rad."""
    speed: Array
    """Of the cam, rad/s."""
    dwells: tuple[tuple[Array, Array], ...]
    """From which cam angle to which the follower rests."""
    margins: tuple[tuple[Array, Array, Array], ...] = ()
    """Cam angles in the first and the last step of each dwell, with ``s`` and ``q`` there: a short dwell is no more."""

    def at(self, analysis: Analysed, cam_angle: Array) -> Driven:
        """The same at other cam angles of the ``analysis``, ``(k,)`` or ``(p, k)``."""
        at = analysis.at(cam_angle)
        s, v, w, _ = at.motion
        travel, static = s - self.level, at.static_resistance + 0.0 * s
        load = static - self.preload - self.rate * travel
        changed = {"travel": travel, "velocity": v, "acceleration": w, "load": load, "lever": at.lever}
        return replace(self, cam_angle=cam_angle, **changed)

    def with_margins(self, analysis: Analysed) -> Driven:
        """With what is seen closely where dwells begin and end."""
        if not self.dwells:
            return self
        close = np.linspace(0, 1, MARGIN) * TURN / len(self.cam_angle)
        ends = [
            side
            for start, end in self.dwells
            for side in (np.minimum(start + close, end), np.maximum(end - close, start))
        ]
        at = self.at(analysis, np.concatenate(np.broadcast_arrays(*ends), axis=-1))
        parts = (np.split(values, len(self.dwells), axis=-1) for values in (at.cam_angle, at.travel, at.load))
        return replace(self, margins=tuple(zip(*parts, strict=True)))


def driven(analysis: Analysed, samples: int) -> Driven:
    """What drives a train, from the ``analysis`` of any cam with one follower.

    ``ValueError`` (``nan`` in a population) for a motion that is shorter than a turn, or whose position or velocity
    jumps: no train can follow that.
    """
    with applied("an elastic train", analysis):
        motion, angle = analysis.cam.motion, TURN * np.arange(samples) / samples
        possible = _possible(analysis)
        at = analysis.at(angle)
        s, v, w, _ = at.motion
        static, rate = np.where(possible, at.static_resistance, np.nan), column(at.closing_rate)
        level, preload = s[..., :1], static[..., :1]
        travel = s - level
        load = static - preload - rate * travel
        still = (i for i, segment in enumerate(motion.segments) if segment.still)
        dwells = tuple((column(motion.starts[i]), column(motion.starts[i + 1])) for i in still)
        mass, rubs, speed = (column(x) for x in (at.inertia, getattr(at, "damping", 0.0), at.speed))
        found = Driven(angle, travel, v, w, load, at.lever, level, preload, mass, rate, rubs, speed, dwells)
        return found.with_margins(analysis)


def column(value: Value) -> Array:
    """A number of a design, ``(1,)`` or ``(p, 1)``."""
    return np.atleast_1d(value)[..., :1]


def _possible(analysis: Analysed) -> Array:
    """Whether a train can follow, ``(1,)`` or ``(p, 1)``."""
    periodic = np.atleast_1d(analysis.cam.motion.periodic)
    if refuse := unless(periodic.all() if periodic.ndim == 1 else periodic):
        span = in_unit(analysis.cam.motion.span, "deg")
        refuse(f"the motion program spans {span:.6g} deg; for steady motion it must span a full turn of 360 deg")
    up, down = (analysis.corner(way) for way in (1, -1))
    jump, place = np.maximum(up.value, down.value), np.where(up.value > down.value, up.cam_angle, down.cam_angle)
    if refuse := unless(np.logical_not(jump > 0)):
        what, at = "position" if np.isinf(jump) else "velocity", round(in_unit(float(place), "deg"), 4)
        refuse(
            f"the {what} of the follower jumps at {at:.6g} deg of the cam; an elastic train needs a motion whose "
            "position and velocity are continuous"
        )
    return periodic & np.expand_dims(np.logical_not(jump > 0), -1) & analysis.buildable


def top(values: Array) -> Array:
    """The largest of values at even cam angles of a turn, with the parabola through three neighbours.

    >>> phi = TURN * np.arange(24) / 24
    >>> print(f"{top(np.cos(phi - 0.1)):.5f}")
    0.99993
    """
    return _raised(values, np.array(True)).max(-1)


def top_with_corners(values: Array) -> Array:
    """The same of values that may have corners: where they bend at one sample alone, that is the top.

    >>> phi = TURN * np.arange(24) / 24
    >>> corner = 1 + np.minimum(3 * np.sin(phi), -np.sin(phi))
    >>> print(f"{top(corner):.3f} {top_with_corners(corner):.3f}")
    1.032 1.000
    """
    bend = 2 * values - np.roll(values, 1, axis=-1) - np.roll(values, -1, axis=-1)
    beside = np.maximum(abs(np.roll(bend, 1, axis=-1)), abs(np.roll(bend, -1, axis=-1)))
    return _raised(values, bend <= ROUND * beside).max(-1)


def _raised(values: Array, inner: Array) -> Array:
    around = np.concatenate([values[..., -1:], values, values[..., :1]], axis=-1)
    inside = np.concatenate([inner[..., -1:], inner, inner[..., :1]], axis=-1) if inner.ndim else inner
    return raised(around, inside)[..., 1:-1]


def bottom(values: Array) -> Array:
    """The least of them."""
    return -top(-values)
