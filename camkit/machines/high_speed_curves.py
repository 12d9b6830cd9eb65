"""What is to be small along a high-speed cam's rise and fall: each a function of a part of the cam.

Their peaks are the measures of the cam (see `HighSpeedAnalysis.tops`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..quantities.known import known
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .high_speed_analysis import HighSpeedAnalysis

AT_REST = 1e-6
"""Share of the swing below which the arm counts as not having moved."""
BESIDE = 1e-4
"""Share of an interval so near to its end that the travel from there is lost in rounding."""


def spring_needed(part: HighSpeedAnalysis) -> Array:
    """``-psi''/psi``: ``K`` of the spring that holds the arm's inertia at the rated speed.

    Very negative, and of no account, where the arm has not moved.
    """
    psi = part.motion.s
    at_rest = psi <= AT_REST * part.cam.swing
    return np.where(at_rest, -1e12, -part.motion.a / np.where(at_rest, 1, psi))


def tightness(part: HighSpeedAnalysis) -> Array:
    """``-q``: above 0 the roller undercuts the profile."""
    return -part.margin


def pull(part: HighSpeedAnalysis) -> Array:
    """The force with which the roller would have to be pulled, N."""
    return -part.contact_force


def push(part: HighSpeedAnalysis) -> Array:
    """The force between cam and roller, of a groove that of either flank, N."""
    return abs(part.contact_force) if part.groove else part.contact_force


def strain(part: HighSpeedAnalysis) -> Array:
    """``-1 / F_sigma^2``."""
    return -part.ease


def attrition(part: HighSpeedAnalysis) -> Array:
    """``-1 / F_wear^2``."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return -part.ease / part.contact_force**2


def before(part: HighSpeedAnalysis) -> Array:
    """How far the arm is before its start, as a share of the swing."""
    return -part.motion.s / part.cam.swing


def after(part: HighSpeedAnalysis) -> Array:
    """How far the arm is beyond its end, as a share of the swing."""
    return part.motion.s / part.cam.swing - 1


def lag(part: HighSpeedAnalysis) -> Array:
    """Travel from either end as a share of what a 3-4-5 polynomial makes of it, the smaller one, below 0.

    Above 0 the arm is beyond an end.  It stays of a size near the ends, where the travel itself vanishes.
    """
    cam, (s, _, a, j) = part.cam, part.motion
    begun = cam.rise_angle + cam.dwell_angle
    back = part.cam_angle > begun - cam.dwell_angle / 2
    angle, way = np.where(back, cam.return_angle, cam.rise_angle), np.where(back, -1, 1) / cam.swing
    share, travel = (part.cam_angle - np.where(back, begun, 0.0)) / angle, back + way * s
    a, j = way * angle**2 * a, way * angle**3 * j
    return -np.minimum(_over_345(share, travel, a, j), _over_345(1 - share, 1 - travel, -a, j))


def _over_345(u: Array, s: Array, a: Array, j: Array) -> Value:
    """``s`` over that of a 3-4-5 polynomial at ``u`` from its beginning; next to that, by its derivatives ``a, j``.

    There both are rounding.  ``s = u^2 a / 4 - u^3 j / 12`` where it is of the third to fifth power of ``u``.
    """
    share = s / (u * u * u * (10 + u * (6 * u - 15)))
    if not known(share):
        return _beside(u, s, a, j, share)
    near = np.flatnonzero(np.atleast_2d(u < BESIDE).any(0))
    share[..., near] = _beside(*(np.broadcast_to(x, share.shape)[..., near] for x in (u, s, a, j, share)))
    return share


def _beside(u: Array, s: Array, a: Array, j: Array, share: Array) -> Array:
    """That ``share``, by the derivatives where it is rounding."""
    smooth = abs(a) <= 2 * u * abs(j) + 1e-6
    limit = np.where(u > 1e-7, (a / u - j / 3) / 40, np.where(smooth, j / 60, a / (20 * u)))
    return np.where((u < BESIDE) & (abs(s) < 1e-11), limit, share)
