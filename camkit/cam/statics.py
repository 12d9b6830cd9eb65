"""Forces between cam and follower with Coulomb friction, as vectors in the machine's frame.

The cam pushes the follower in the contact point ``K`` with a force that leans from the contact normal to the side
to which the cam's surface runs past the follower.  What the follower's bearing leaves of it is compared with
the load.  All follows for a force of 1 N and is scaled afterwards, as everything is linear in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .analysis import CamAnalysis

Vector = tuple[Value, Value] | Array
ROUNDING = 1e-9
"""A support that bears less than this share of the forces bears nothing."""


class Bearing(Protocol):
    """What leads a follower."""

    def velocity_at(self, point: Vector) -> Vector:
        """Velocity of the follower's point at ``point``, per speed of the cam, m."""

    def share(self, point: Vector, force: Vector) -> Value:
        """What ``force`` in ``point`` does along the follower's motion after the bearing's friction."""

    def least(self, load: Value) -> Value:
        """What the follower resists with while nothing pushes it: ``load`` and the bearing's friction."""

    def needed(self, point: Vector, force: Vector, load: Value) -> Value:
        """How many times ``force`` in ``point`` moves the follower against ``load``; ``inf`` where friction jams it."""


@dataclass(frozen=True)
class Pivot:
    """A rocking arm's pivot on the x axis; the arm's angle grows clockwise; its force touches a friction circle."""

    distance: Value
    velocity: Array
    friction_circle: Value

    def velocity_at(self, point: Vector) -> Vector:
        """A clockwise turn about the pivot."""
        return self.velocity * point[1], -self.velocity * (point[0] - self.distance)

    def share(self, point: Vector, force: Vector) -> Value:
        """Moment about the pivot, m."""
        moment = point[1] * force[0] - (point[0] - self.distance) * force[1]
        return moment - np.sign(self.velocity) * self.friction_circle

    def least(self, load: Value) -> Value:
        """The ``load``: a pivot that bears nothing does not rub."""
        return load

    def needed(self, point: Vector, force: Vector, load: Value) -> Value:
        """``load`` over `share`, N per N."""
        return _pushing(load, self.share(point, force))


@dataclass(frozen=True)
class Guide:
    """A straight guide along +y, borne at both ends: at the height ``mouth`` and ``length`` above it.

    ``across`` is the part of the follower's weight along +x, which acts in the middle of the guide, N.
    """

    axis: Value
    mouth: Value
    length: Value
    velocity: Array
    coefficient: Value
    across: Value = 0.0

    def velocity_at(self, point: Vector) -> Vector:
        """Along the guide."""
        return 0.0 * self.velocity, self.velocity

    @property
    def _rub(self) -> Value:
        """Coefficient of friction, against the motion."""
        return np.sign(self.velocity) * self.coefficient

    def _ends(self, point: Vector, force: Vector) -> Vector:
        """What the upper and the lower end bear of a force: like the supports of a beam."""
        top = ((point[0] - self.axis) * force[1] + (self.mouth - point[1]) * force[0]) / self.length
        return top, force[0] + top

    def share(self, point: Vector, force: Vector) -> Value:
        """Force along the guide less the friction at its ends, without the follower's weight."""
        top, bottom = self._ends(point, force)
        return force[1] - self._rub * (np.abs(top) + np.abs(bottom))

    def least(self, load: Value) -> Value:
        """``load`` and the friction of the weight across the guide."""
        return load + self._rub * np.abs(self.across)

    def needed(self, point: Vector, force: Vector, load: Value) -> Value:
        """The least ``F >= 0`` with ``F y = load + mu (|F t - W / 2| + |F b + W / 2|)``, ``t, b`` borne by the ends.

        The sums are straight between the places where an end changes sides, so each pair of sides gives one ``F``,
        which counts if it bears them out.
        """
        (top, bottom), half = self._ends(point, force), self.across / 2
        best = np.inf + 0.0 * (load + top)
        for one, two in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            needed = _pushing(load + self._rub * half * (two - one), force[1] - self._rub * (one * top + two * bottom))
            with np.errstate(invalid="ignore"):
                ends = one * (needed * top - half), two * (needed * bottom + half)
                borne = np.minimum(*ends) >= -ROUNDING * (np.abs(needed) + np.abs(half))
            best = np.where(borne, np.minimum(best, needed), best)
        return best


def _pushing(load: Value, share: Value) -> Value:
    """``load / share`` where that is a push; ``inf`` where it would have to pull."""
    with np.errstate(divide="ignore", invalid="ignore"):
        needed = load / share
        return np.where((needed >= 0) | np.isnan(load + share), needed, np.inf)


class Push(NamedTuple):
    """What a force of 1 N between cam and follower does."""

    follower: Value
    """Along the follower's motion, N per N, or N m per N for an arm."""
    cam: Value
    """Torque that turns the cam against it, N m per N."""
    normal: Value
    """Its part along the contact normal."""
    point: Vector
    """Where it acts, machine's frame, m."""
    force: Vector
    """The force itself, N per N."""


def push(analysis: CamAnalysis, flank: Value) -> Push:
    """A push by the inner flank (``flank`` +1) or by a groove's outer flank (-1), element by element."""
    point = analysis.contact_point(flank)
    nx, ny = analysis.normal
    (sx, sy), (vx, vy) = analysis.surface_velocity(point), analysis.bearing.velocity_at(point)
    past_x, past_y = sx - vx, sy - vy  # velocity of the cam's surface past the follower
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.sin(analysis.lean) / np.hypot(past_x, past_y)
    normal = flank * np.cos(analysis.lean)
    force = normal * nx + along * past_x, normal * ny + along * past_y
    torque = sx * force[0] + sy * force[1] + analysis.cam.friction.cam_axis
    return Push(analysis.bearing.share(point, force), torque, normal, point, force)


def efficiency(analysis: CamAnalysis, flank: Value) -> Array:
    """Power out over power in with ``flank`` pushing; 0 where the follower rests or friction jams it.

    Where the follower moves with the push, the cam drives it; where it moves against the push, it drives the cam.
    Of what passes through the contact: the friction of a weight across the guide, which is there without it, is not
    counted here but in `rubbing`.
    """
    v, pushed = analysis.velocity, push(analysis, flank)
    out = v * pushed.follower
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(out > 0, out / pushed.cam, pushed.cam / out)
    return np.where(v == 0, 0.0 * out, np.maximum(ratio, 0.0))


class Rubbing(NamedTuple):
    """Forces with friction; ``inf`` where friction jams the follower."""

    contact_force: Value
    """Along the contact normal, N; < 0 at a groove's outer flank."""
    cam_torque: Value
    """N m."""


def rubbing(analysis: CamAnalysis) -> Rubbing:
    """The forces that the load on the follower calls for: by the inner flank, or the outer one where it pulls."""
    Q = analysis.resistance
    flank = np.where(analysis.bearing.least(Q) < 0, -1.0, 1.0)
    pushed = push(analysis, flank)
    force = analysis.bearing.needed(pushed.point, pushed.force, Q)
    return Rubbing(force * pushed.normal, force * pushed.cam)
