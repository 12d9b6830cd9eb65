"""A cam that was measured beside the one that was designed: by how much its outline stands out, point by point."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..motion import MotionProgram
from ..motion.closing import TURN
from ..motion.program import SAME_ANGLE
from ..quantities import Measure
from ..quantities.design import refuse_population
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array, Value
from .measures import over_cam

MOST = 720
"""Points that are compared: of more one of each few, that which stands out most from its neighbours."""
SHARPEST = 1e9
"""Curvature of a corner, 1/m."""
TIE = 1e-6
"""Of places as near as each other, to this share of their distance, the one whose normal points there is taken."""


class Compared(NamedTuple):
    """Points of an outline against a cam's profile, counter-clockwise.

    ``deviation`` is normal to the profile, above 0 where the outline stands out, m; ``nan`` where the follower leaps
    over the outline, so that the design has no profile there.  ``foot`` and ``normal`` are those of the profile.
    """

    points: Array
    angle: Array
    deviation: Array
    foot: Array
    normal: Array

    @property
    def largest(self) -> Value:
        """The largest size of a deviation, m."""
        return np.max(np.where(np.isnan(self.deviation), 0.0, abs(self.deviation)))


def compared(points: Array, analysis: Any) -> Compared:
    """Points of an outline ``(2, n)``, m, against the profile of a cam's analysis, each with the place next to it.

    To second order the profile is its circle of curvature: between its points the deviation is that from the circle.

    Raises ``ValueError`` for a population.
    """
    refuse_population(analysis, "the analysis")
    points = _counter_clockwise(np.asarray(points, dtype=float))
    profile, normals = analysis.profile, analysis.on_cam(analysis.normal)
    bend = np.minimum(np.maximum(analysis.profile_curvature, -SHARPEST), SHARPEST)
    x, y = (np.expand_dims(row, -1) for row in points)
    far = np.hypot(x - profile[0], y - profile[1])
    out = (x - profile[0]) * normals[0] + (y - profile[1]) * normals[1]
    near = np.argmin(far * (far - TIE * out), axis=-1)  # at a corner, which has many normals, the one that fits
    px, py, nx, ny, k = (
        np.take_along_axis(row, near, axis=-1) for row in (profile[0], profile[1], normals[0], normals[1], bend)
    )
    out = (points[0] - px) * nx + (points[1] - py) * ny
    along = (points[1] - py) * nx - (points[0] - px) * ny
    ahead = np.where(analysis.cam.rotation * along < 0, 1, -1)
    beside = np.minimum(np.maximum(near + ahead, 0), len(analysis.cam_angle) - 1)
    k = np.where(abs(k) < SHARPEST, k, np.take_along_axis(bend, beside, axis=-1))  # beside a corner its flank counts
    deviation = (2 * out + k * (out**2 + along**2)) / (1 + np.sqrt((1 + k * out) ** 2 + (k * along) ** 2))
    foot, normal = np.stack([points[0] - deviation * nx, points[1] - deviation * ny]), np.stack([nx, ny])
    lost = _leapt(analysis, near, along)
    angle = np.mod(np.arctan2(points[1], points[0]), TURN)
    return Compared(points, angle, np.where(lost, np.nan, deviation), foot, normal)


def _counter_clockwise(points: Array) -> Array:
    order = np.argsort(np.mod(np.arctan2(points[1], points[0]), TURN), kind="stable")
    points, few = points[:, order], -(-points.shape[1] // MOST)
    r = np.hypot(*points)
    stands_out = abs(np.roll(r, 1) + np.roll(r, -1) - 2 * r)
    blocks = np.pad(stands_out, (0, -len(r) % few), constant_values=-1.0).reshape(-1, few)
    return points[:, np.arange(len(blocks)) * few + blocks.argmax(-1)]


def _leapt(analysis: Any, near: Array, along: Array) -> Array:
    """Which points lie on the far side of the profile's end, where the contact leaps."""
    angle, jumps = analysis.cam_angle, getattr(analysis.cam.motion, "jumps", ())
    before = np.zeros(len(angle))
    after = np.zeros(len(angle))
    for jump in jumps:
        k = 0 if jump[0] > TURN - SAME_ANGLE else int(np.searchsorted(angle, jump[0]))
        if k < len(angle):  # 0: behind the start of the turn, and ahead of its end
            after[k - 1] = before[k] = 1.0
    way = -analysis.cam.rotation * along  # the contact runs clockwise on a cam that turns the other way
    level = 0.0 * analysis.profile[0]
    behind, ahead = (np.take_along_axis(row + level, near, axis=-1) for row in (before, after))
    return np.where(way > 0, ahead, behind) > 0.5


def deviation_from(motion: MotionProgram, unit: str = "mm") -> Measure:
    """The measure of how far a follower's motion is from another one, such as that of the cam that is to be replaced.

    It is the largest ``|s - s_other|`` over the cam, levels counted from the level 0 of each: a limit on it keeps what
    the machine does, while a study makes the motion better.  ``unit`` is ``mm``, or ``deg`` for an arm.

    >>> from camkit import TranslatingRollerCam
    >>> cam = TranslatingRollerCam()
    >>> deviation_from(cam.motion).one(cam.analyse())
    0.0
    """
    refuse_arguments(deviation_from, locals())
    if unit not in ("mm", "deg"):
        raise ValueError(f"unit is {unit!r}; it must be 'mm' for a sliding follower or 'deg' for an arm")

    def away(analysis: Any) -> Value:
        return abs(analysis.motion.s - motion(analysis.cam_angle).s)

    return over_cam("deviation from the other motion", unit, away)
