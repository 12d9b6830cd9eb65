"""Dry friction in the hinges and ball joints of an RSSR linkage that moves steadily.

Every joint rubs with Coulomb friction against its own motion.  A hinge has two bearings, ``b`` apart and alike on both
sides of the link's plane, and resists with ``mu R (|N_1| + |N_2|)``: each bears half of the force, and ``M / b`` of the
moment across the axis, one to the one side and one to the other.  Far apart that is ``mu R`` times the force.  A ball
joint resists with the moment ``mu R |F|`` against the angular velocity of the one link against the other.  Links weigh
nothing besides the load; nothing sticks.

With moments at its ends the coupler's force is no longer along it: ``F = S u + |S| kappa``, ``u`` along the coupler.
The coupler may spin about its own axis, and does so at the rate at which both ball joints take it along as much as
they hold it back: the moments along ``u`` are in balance.  That is also the spin with the least loss.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..geometry import dot
from ..quantities import Design, quantity
from ..quantities.known import certain
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .rssr_analysis import RSSRAnalysis

STEPS = 12
"""Newton's steps for the force along the coupler: of a concave function they come from one side, and end there."""
ROUNDING = 1e-12
"""A slip across the coupler below this share of what turns is none."""
SAME = 1e-9
"""By what share of it the force may miss the balance of the rocker."""


@dataclass(frozen=True)
class LinkageFriction(Design):
    """What rubs in an `RSSR` linkage: both hinges and both ball joints, which are alike; none by itself.

    >>> from camkit import deg
    >>> from camkit.linkage import RSSR, RockerLoad
    >>> plain, rubs = (RSSR().analyse(60 * deg, load=RockerLoad(), friction=LinkageFriction(ball_coefficient=mu))
    ...                for mu in (0.0, 0.15))
    >>> print(f"{plain.crank_torque[0]:.3f}, with friction {rubs.crank_torque[0]:.3f} N m")
    -9.269, with friction -9.013 N m

    Raises ``ValueError`` for a size below 0.
    """

    crank_coefficient: float = quantity("mu_1", 0, 0, 0.5, "", "friction in the crank's hinge", at_least=0)
    crank_pin: float = quantity("R_1", 10, 0, 50, "mm", "radius of the pin of the crank's hinge", at_least=0)
    crank_spacing: float = quantity("b_1", 100, 10, 300, "mm", "between both bearings of the crank")
    ball_coefficient: float = quantity("mu_2", 0, 0, 0.5, "", "friction in the ball joints", at_least=0)
    ball_radius: float = quantity("R_2", 10, 0, 50, "mm", "radius of the balls", at_least=0)
    rocker_coefficient: float = quantity("mu_3", 0, 0, 0.5, "", "friction in the rocker's hinge", at_least=0)
    rocker_pin: float = quantity("R_3", 10, 0, 50, "mm", "radius of the pin of the rocker's hinge", at_least=0)
    rocker_spacing: float = quantity("b_3", 100, 10, 300, "mm", "between both bearings of the rocker")

    @property
    def circles(self) -> tuple[Value, Value, Value]:
        """Radius times coefficient of the crank's hinge, the ball joints and the rocker's hinge, m."""
        ball = self.ball_coefficient * self.ball_radius
        return self.crank_coefficient * self.crank_pin, ball, self.rocker_coefficient * self.rocker_pin

    @property
    def none(self) -> bool:
        """Whether nothing rubs for sure."""
        return all(certain(circle == 0) for circle in self.circles)


def _length(vectors: Array) -> Array:
    return np.sqrt(dot(vectors, vectors))


def _direction(vectors: Array) -> Array:
    """Unit vectors; 0 where there is none."""
    length = _length(vectors)
    return vectors / np.where(length > 0, length, 1.0)


@dataclass(frozen=True)
class Hinge:
    """What a hinge bears: a force ``A + S B`` and, across its ``axis``, a moment ``C + S D``, vectors ``(3, ...)``."""

    axis: Array
    circle: Value
    spacing: Value
    force: tuple[Array, Array]
    moment: tuple[Array, Array]

    @cached_property
    def _bearings(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """The forces of both bearings, each ``A + S B``."""
        couple = [np.cross(moment, self.axis, axis=0) / self.spacing for moment in self.moment]
        (a, b), (c, d) = self.force, couple
        return (a / 2 + c, b / 2 + d), (a / 2 - c, b / 2 - d)

    def friction(self, s: Array) -> tuple[Array, Array]:
        """Moment of the friction, N m, and by how much it grows with ``S``."""
        value, slope = 0.0 * s, 0.0 * s
        for a, b in self._bearings:
            force = a + s * b
            value, slope = value + _length(force), slope + dot(_direction(force), b)
        return self.circle * value, self.circle * slope

    @property
    def at_rest(self) -> Array:
        """Moment of the friction where ``S`` is 0, N m."""
        (a, _), (other, _) = self._bearings
        return self.circle * (_length(a) + _length(other))

    @property
    def steepest(self) -> Array:
        """By how much the moment of the friction grows with a large ``S``, m."""
        (_, b), (_, other) = self._bearings
        return self.circle * (_length(b) + _length(other))


@dataclass(frozen=True)
class Rubbing:
    """Forces and losses of an analysis with friction; angular velocities are per that of the crank, whichever way."""

    at: RSSRAnalysis

    @cached_property
    def crank_turning(self) -> Array:
        """Angular velocity of the crank."""
        return self.at.sense * self.at.everywhere(self.at.linkage.crank_axis)

    @cached_property
    def rocker_turning(self) -> Array:
        """Angular velocity of the rocker."""
        return self.at.sense * self.at.ratio * self.at.everywhere(self.at.linkage.rocker_axis)

    @cached_property
    def _swung(self) -> tuple[Array, tuple[Array, Array], tuple[Array, Array]]:
        """Angular velocity of the coupler across itself; against crank and rocker, across and along the coupler."""
        at, u = self.at, self.at.coupler_direction
        l1, l2, l3 = at.linkage.crank, at.linkage.coupler, at.linkage.rocker
        faster = at.sense * (l3 * at.ratio * at.rocker_motion - l1 * at.crank_motion)
        across = np.cross(u, faster, axis=0) / l2
        along = [-dot(turning, u) for turning in (self.crank_turning, self.rocker_turning)]
        turnings = (self.crank_turning, along[0]), (self.rocker_turning, along[1])
        crank, rocker = (across - turning - q * u for turning, q in turnings)
        least = ROUNDING * (1 + abs(at.ratio))
        crank, rocker = (np.where(_length(slip) > least, slip, 0.0) for slip in (crank, rocker))
        return across, (crank, rocker), (along[0], along[1])

    @cached_property
    def _directions(self) -> tuple[Array, Array]:
        """Unit vectors in which the coupler slips in both ball joints; shorter where one does not slip, but holds.

        With ``p`` across and ``q + spin`` along the coupler, the sum of ``sqrt(p^2 + (q + spin)^2)`` is least, and both
        moments along it in balance, where ``(q_1 + spin) / p_1 = -(q_3 + spin) / p_3 = (q_1 - q_3) / (p_1 + p_3)``.
        """
        _, (first, second), (q1, q3) = self._swung
        both, apart = _length(first) + _length(second), q1 - q3
        size = np.sqrt(both**2 + apart**2)
        across, along = (x / np.where(size > 0, size, 1.0) for x in (both, apart * self.at.coupler_direction))
        return across * _direction(first) + along, across * _direction(second) - along

    @cached_property
    def coupler_turning(self) -> Array:
        """Angular velocity of the coupler, with its spin."""
        across, (first, second), (q1, q3) = self._swung
        p1, p3 = _length(first), _length(second)
        spin = -(q1 * p3 + q3 * p1) / np.where(p1 + p3 > 0, p1 + p3, 1.0)
        return across + spin * self.at.coupler_direction

    @cached_property
    def crank_slip(self) -> Array:
        """Angular velocity of the coupler against the crank."""
        return self.coupler_turning - self.crank_turning

    @cached_property
    def rocker_slip(self) -> Array:
        """Angular velocity of the coupler against the rocker."""
        return self.coupler_turning - self.rocker_turning

    @cached_property
    def _sideways(self) -> tuple[Array, Array]:
        """``kappa``, and ``|F|`` over ``|S|``, of the balance ``u x F = -(mu R / l_2) |F| (e_1 + e_3)``."""
        at, u = self.at, self.at.coupler_direction
        moments = sum(self._directions)
        tau = -at.friction.circles[1] / at.linkage.coupler * np.cross(moments, u, axis=0)
        room = 1 - dot(tau, tau)
        grown = 1 / np.sqrt(np.where(room > 0, room, np.nan))
        return tau * grown, grown

    @cached_property
    def _per_side(self) -> tuple[Array, Array, Array, Array]:
        """``s``, the sign of ``S``; then by ``S``: force on the rocker, moments of the balls on crank and rocker."""
        kappa, grown = self._sideways
        ball = self.at.friction.circles[1] * grown
        by_crank, by_rocker = (ball * direction for direction in self._directions)
        s = np.sign(self._load * self._lever)
        return s, self.at.coupler_direction + s * kappa, s * by_crank, s * by_rocker

    @cached_property
    def _lever(self) -> Array:
        """Of the coupler about the rocker's axis without friction, m."""
        return self.at.linkage.rocker * dot(self.at.coupler_direction, self.at.rocker_motion)

    @cached_property
    def _way(self) -> Array:
        """Which way the rocker turns."""
        return np.sign(self.at.sense * self.at.ratio)

    @cached_property
    def _load(self) -> Array:
        """What the coupler has to overcome before it bears anything, N m: the load, and what rubs under the weight."""
        weight, arm = self.at.weight, self.at.load_arm
        none = np.zeros_like(weight)
        hinge = self._rocker_hinge((-weight, none), (-np.cross(arm, weight, axis=0), none))
        return self.at.resisting_torque + self._way * hinge.at_rest

    def _rocker_hinge(self, force: tuple[Array, Array], moment: tuple[Array, Array]) -> Hinge:
        friction = self.at.friction
        axis = self.at.everywhere(self.at.linkage.rocker_axis)
        return Hinge(axis, friction.circles[2], friction.rocker_spacing, force, moment)

    @cached_property
    def rocker_hinge(self) -> Hinge:
        """The hinge of the rocker."""
        _, push, _, ball = self._per_side
        weight, arm = self.at.weight, self.at.load_arm
        moment = -np.cross(self.at.rocker_arm, push, axis=0) - ball
        return self._rocker_hinge((-weight, -push), (-np.cross(arm, weight, axis=0), moment))

    @cached_property
    def crank_hinge(self) -> Hinge:
        """The hinge of the crank."""
        _, push, ball, _ = self._per_side
        none, friction = np.zeros_like(push), self.at.friction
        moment = np.cross(self.at.crank_arm, push, axis=0) - ball
        axis = self.at.everywhere(self.at.linkage.crank_axis)
        return Hinge(axis, friction.circles[0], friction.crank_spacing, (none, push), (none, moment))

    @cached_property
    def _rocker_lever(self) -> Array:
        """Moment of the coupler about the rocker's axis by ``S``, m."""
        _, push, _, ball = self._per_side
        axis = self.at.everywhere(self.at.linkage.rocker_axis)
        return self.at.linkage.rocker * dot(push, self.at.rocker_motion) + dot(axis, ball)

    @cached_property
    def jams(self) -> Array:
        """Whether no force along the coupler, however large, keeps the rocker moving.

        The friction grows with the force as fast as what the force does, or faster.
        """
        s, load = self._per_side[0], self.at.resisting_torque
        pushes = self._rocker_lever * np.sign(self._lever) - self.rocker_hinge.steepest * (
            s * self._lever * self._way > 0
        )
        value, _ = self.rocker_hinge.friction(self._found)
        missing = abs(self._rocker_lever * self._found - self._way * value - load)
        balanced = missing <= SAME * (abs(load) + value + abs(self._rocker_lever * self._found))
        return np.logical_not((pushes > 0) & balanced & (self._found * s >= 0))

    @cached_property
    def _found(self) -> Array:
        """``S`` of the balance ``lever S - way H(S) = T``, by Newton's steps from where ``H`` is that without ``S``."""
        lever, load, hinge = self._rocker_lever, self.at.resisting_torque, self.rocker_hinge
        with np.errstate(divide="ignore", invalid="ignore"):
            s = self._load / lever
            for _ in range(STEPS):
                value, slope = hinge.friction(s)
                s = s - (lever * s - self._way * value - load) / (lever - self._way * slope)
        return s

    @cached_property
    def coupler_force(self) -> Array:
        """``S``: along the coupler, N, compression positive; infinite where friction jams the linkage."""
        return np.where(self.jams, np.copysign(np.inf, self._per_side[0]), self._found)

    @cached_property
    def _force(self) -> Array:
        """``S``, ``nan`` where friction jams the linkage."""
        return np.where(self.jams, np.nan, self._found)

    @cached_property
    def push(self) -> Array:
        """Force of the coupler on the rocker, N."""
        return self._force * self._per_side[1]

    @cached_property
    def crank_ball_moment(self) -> Array:
        """Moment of the coupler on the crank by what rubs in their ball joint, N m."""
        return self._force * self._per_side[2]

    @cached_property
    def rocker_ball_moment(self) -> Array:
        """Moment of the coupler on the rocker by what rubs in their ball joint, N m."""
        return self._force * self._per_side[3]

    @cached_property
    def crank_torque(self) -> Array:
        """On the crank, N m; infinite where friction jams the linkage."""
        at, (friction, _) = self.at, self.crank_hinge.friction(self._force)
        axis = at.everywhere(at.linkage.crank_axis)
        torque = at.linkage.crank * dot(self.push, at.crank_motion) - dot(axis, self.crank_ball_moment)
        return np.where(self.jams, at.sense * np.inf, torque + at.sense * friction)

    @cached_property
    def loss(self) -> Array:
        """What friction takes in all joints, J per rad of the crank: moment times angular velocity of each."""
        at, s = self.at, self._force
        balls = _length(self.crank_ball_moment) * _length(self.crank_slip)
        balls = balls + _length(self.rocker_ball_moment) * _length(self.rocker_slip)
        hinges = self.crank_hinge.friction(s)[0] + abs(at.ratio) * self.rocker_hinge.friction(s)[0]
        return np.where(self.jams, np.inf, balls + hinges)

    @property
    def work(self) -> Array:
        """What friction takes over the whole sweep, J, by the trapezoid rule."""
        turned = abs(self.at.crank_angle - self.at.crank_angle[..., :1])
        return np.trapezoid(self.loss, turned, axis=-1)

    @cached_property
    def driving_torque(self) -> Array:
        """Torque on the crank the way it turns, N m; < 0 where the load drives it and it has to be held back.

        Above 0 where the load helps, the linkage is self-locking there: the load alone cannot move it.
        """
        return self.at.sense * self.at.crank_torque

    @cached_property
    def efficiency(self) -> Array:
        """Power out over power in, whichever of crank and load drives; 0 where it jams, ``nan`` without power.

        Below 0 where the load drives and the crank has to be driven too: self-locking.
        """
        load, crank = self.at.resisting_torque * self.at.ratio, self.at.crank_torque
        drives = self.at.sense * load > 0
        into, out = np.where(drives, crank, load), np.where(drives, load, crank)
        return np.where(load == 0, np.nan, out / np.where(into == 0, np.nan, into))
