"""What follows from an RSSR linkage: positions, transmission, static forces.

Formulas after Liu Jianwei, Geng Kaizhen, Ship Sci. Technol. 41(6) 2019, 143-146, put right as in `rssr`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from ..geometry import dot, inclination
from ..quantities import text_if, unless
from ..quantities.types import Array, Value
from ..units import deg, mm
from . import limits
from .ball_joints import BallJoint, crank_ball, rocker_ball
from .load import RockerLoad
from .rubbing import LinkageFriction, Rubbing

if TYPE_CHECKING:
    from .rssr import RSSR

NEXT_TO = 1e-7
"""How far before a limit angle a linkage can be shown, rad: the angle itself is known to a few digits less."""


@dataclass(frozen=True)
class RSSRAnalysis:
    """What follows from an `RSSR` linkage at the given crank angles on one branch.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``; points and vectors ``(3, n)`` and ``(3, p, n)``.
    Each is computed when first asked for.  A member of a population that cannot be assembled at one of the crank
    angles is ``nan`` at all of them; its ``discriminant`` still says by how much.
    """

    offers: ClassVar[tuple[str, ...]] = (
        "chain",
        "rocker_angle",
        "crank_pressure_angle",
        "ratio",
        "acceleration_ratio",
        "crank_torque",
        "coupler_force",
    )
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    linkage: RSSR
    crank_angle: np.ndarray
    branch: int = 1
    load: RockerLoad = field(default_factory=RockerLoad)
    through: bool = False
    """Whether the crank passes all angles between the given ones."""
    friction: LinkageFriction = field(default_factory=LinkageFriction)
    turning: Value | None = None
    """Which way the crank turns, +1 or -1, for what rubs; ``None``: from the first angle to the last."""

    @cached_property
    def _closure(self) -> tuple[Array, Array, Array]:
        return self.linkage.closure(self.crank_angle)

    @cached_property
    def buildable(self) -> Array:
        """Whether the linkage can be assembled at every crank angle, ``(..., 1)``."""
        can = self.linkage.has_possible_sizes & limits.reaches(*self._closure).all(-1, keepdims=True)
        if not self.through:
            return can
        return can & self.linkage.assembles(self._extremes_passed).all(-1, keepdims=True)

    def refuse_impossible(self) -> None:
        """``ValueError`` in a sentence if this is one design and it cannot be assembled."""
        if refuse := unless(self.buildable[..., 0]):
            (low, high), (other_low, other_high) = self.linkage.all_possible_crank_angles / deg
            other = text_if(np.isfinite(other_low), f" and {other_low:.5g} to {other_high:.5g}")
            refuse(text_if(np.isfinite(low), self._why_not(f"{low:.5g} to {high:.5g}{other}"), self._never()))

    def _never(self) -> str:
        low, high = self._joint_distances()
        return (
            f"the coupler of {self.linkage.coupler / mm:.5g} mm cannot be assembled at any crank angle; "
            f"from crank to rocker it is {low / mm:.5g} to {high / mm:.5g} mm"
        )

    def _why_not(self, ranges: str) -> str:
        """Which of the crank angles are not within the ranges that are possible."""
        if self.through:
            start, end = self.crank_angle[[0, -1]] / deg
            part = "; give it other sizes for a whole turn, or analyse a part of the turn"
            return (
                f"the crank cannot sweep from {start:.5g} to {end:.5g} deg: "
                f"the linkage can be assembled from {ranges} deg only" + text_if(end - start >= 360, part)
            )
        first = np.argmax(np.logical_not(limits.reaches(*self._closure)), axis=-1)[..., None]
        angle = np.take_along_axis(self._turn, first, -1)[..., 0] / deg
        return f"at a crank angle of {angle:.5g} deg the linkage cannot be assembled; possible are {ranges} deg"

    @cached_property
    def _room_to_turn(self) -> tuple[Array, Array, Array]:
        """A crank angle clear of the limits, and how far each way the next limit lies, ``(..., 1)``; ``nan``: none."""
        clearest = np.argmax(np.broadcast_to(self.discriminant, self._shape), axis=-1)[..., None]
        clear = np.take_along_axis(self._turn, clearest, -1)
        ends = self.linkage.all_limit_angles
        ways = np.mod(clear - ends, 2 * np.pi), np.mod(ends - clear, 2 * np.pi)
        below, above = (np.fmin.reduce(way, axis=-1, keepdims=True) for way in ways)
        return clear, below, above

    @property
    def possible_turn(self) -> Array:
        """How far the crank can turn on its branch, from limit to limit, rad, ``(..., 1)``; 2 pi: all the way round."""
        _, below, above = self._room_to_turn
        turn = np.where(np.isnan(below), 2 * np.pi, below + above)
        return np.where(self.buildable, turn, np.nan)

    @cached_property
    def turn_range(self) -> tuple[Value, Value]:
        """How far the crank can turn from its sweep, one design, rad: to the limits, or a turn about the middle."""
        clear, below, above = (value[..., 0] for value in self._room_to_turn)
        middle, free = (self.crank_angle.min() + self.crank_angle.max()) / 2, np.isnan(below)
        low = np.where(free, middle - np.pi, clear - np.maximum(below - NEXT_TO, 0))
        return low[()], np.where(free, middle + np.pi, clear + np.maximum(above - NEXT_TO, 0))[()]

    def at(self, crank_angle: float, branch: int | None = None) -> RSSRAnalysis:
        """The same linkage at one crank angle, or at the limit before it; on its own branch unless said otherwise."""
        angle = np.clip(crank_angle, *self.turn_range)
        here = self.linkage.analyse(angle, branch or self.branch, self.load, self.friction)
        return replace(here, turning=self.sense)

    def one_turn(self, branch: int | None = None, n: int = 361) -> RSSRAnalysis:
        """One turn of the crank about the middle of the sweep, position by position.

        Arrays are ``(n, 1)``, with more positions beside the limits, and ``nan`` where it cannot be assembled.
        """
        start = (self.crank_angle.min() + self.crank_angle.max()) / 2 - np.pi
        limit = self.linkage.all_limit_angles
        after = np.mod(limit - start, 2 * np.pi)
        beside = np.where(np.isnan(limit), 0.0, np.stack([after - NEXT_TO, after + NEXT_TO]))
        angles = start + np.sort(np.append(2 * np.pi * np.linspace(0, 1, n), beside))
        branch = branch or self.branch
        return RSSRAnalysis(
            self.linkage, angles[:, None], branch, self.load, friction=self.friction, turning=self.sense
        )

    def _joint_distances(self) -> tuple[Value, Value]:
        """The least and the largest distance from any place of the crank's ball joint to any of the rocker's."""
        a, b, k = self.linkage.closure(np.linspace(0, 2 * np.pi, 3601))
        twice = 2 * self.linkage.crank * self.linkage.rocker
        squared = self.linkage.coupler**2 + twice * k
        reach = twice * np.sqrt(a**2 + b**2)
        return np.sqrt(np.maximum((squared - reach).min(), 0)), np.sqrt((squared + reach).max())

    @cached_property
    def discriminant(self) -> np.ndarray:
        """``A^2 + B^2 - K^2``: 0 where the linkage is stretched out or folded and the branches meet."""
        a, b, k = self._closure
        return a**2 + b**2 - k**2

    @cached_property
    def _extremes_passed(self) -> np.ndarray:
        """Crank angles of the sweep, also between the given ones, where the discriminant is least or largest.

        ``(..., 4)``, filled up with the lowest crank angle.
        """
        low, high = (end(self.crank_angle, axis=-1, keepdims=True) for end in (np.min, np.max))
        extremes = low + np.mod(self.linkage.extreme_angles - low, 2 * np.pi)
        return np.where(extremes <= high, extremes, low)

    @cached_property
    def min_discriminant(self) -> Array:
        """The least discriminant over the whole sweep, also between its crank angles, ``(..., 1)``.

        Above 0 both branches are continuous over the sweep and never meet.
        """
        between = self.linkage.discriminant(self._extremes_passed).min(-1, keepdims=True)
        return np.minimum(self.discriminant.min(-1, keepdims=True), between)

    @cached_property
    def rocker_angle(self) -> np.ndarray:
        """``phi_3 = atan2(A, B) +- arccos(-K / sqrt(A^2 + B^2))``, rad; it begins in [0, 2 pi) and never jumps."""
        a, b, k = self._closure
        between = np.arctan2(np.sqrt(np.maximum(self.discriminant, 0)), -k)
        angle = np.unwrap(np.arctan2(a, b) + self.branch * between, axis=-1)
        angle = angle - 2 * np.pi * np.floor(angle[..., :1] / (2 * np.pi))
        return np.broadcast_to(np.where(self.buildable, angle, np.nan), self._shape)

    @cached_property
    def crank_joint(self) -> np.ndarray:
        """``B``: the ball joint of crank and coupler, m."""
        return self.everywhere(self.linkage.crank_root) + self.crank_arm

    @cached_property
    def rocker_joint(self) -> np.ndarray:
        """``C``: the ball joint of rocker and coupler, m."""
        return self.everywhere(self.linkage.rocker_root) + self.rocker_arm

    @cached_property
    def _shape(self) -> tuple[int, ...]:
        """``(n,)`` or ``(p, n)``."""
        given = (*vars(self.load).values(), *vars(self.friction).values())
        numbers = (*self.linkage.sizes, *given, self.crank_angle)
        return np.broadcast_shapes(*map(np.shape, numbers))

    @property
    def _turn(self) -> np.ndarray:
        """The crank angle of every member of a population."""
        return np.broadcast_to(self.crank_angle, self._shape)

    def everywhere(self, vector: np.ndarray) -> np.ndarray:
        """A vector of the design, ``(3,)`` or ``(3, p, 1)``, at every crank angle."""
        own = vector if vector.ndim > 1 else vector.reshape(3, *(1 for _ in self._shape))
        return np.broadcast_to(own, (3, *self._shape))

    @property
    def crank_arm(self) -> np.ndarray:
        """From the crank's root to its ball joint, m."""
        return self.linkage.crank * self.linkage.crank_direction(self._turn)

    @property
    def rocker_arm(self) -> np.ndarray:
        """From the rocker's root to its ball joint, m."""
        return self.linkage.rocker * self.linkage.rocker_direction(self.rocker_angle)

    @cached_property
    def chain(self) -> np.ndarray:
        """The ends of the links in order, ``(3, 4, ..., n)``: crank root, both ball joints, rocker root, m."""
        first, last = self.everywhere(self.linkage.crank_root), self.everywhere(self.linkage.rocker_root)
        return np.stack([first, self.crank_joint, self.rocker_joint, last], axis=1)

    @cached_property
    def coupler_direction(self) -> np.ndarray:
        """``F``: unit vector along the coupler from crank to rocker, the line of its force."""
        return (self.rocker_joint - self.crank_joint) / self.linkage.coupler

    @cached_property
    def crank_motion(self) -> np.ndarray:
        """``v_B``: unit vector in which the crank's ball joint moves while the crank angle grows."""
        return self.linkage.crank_direction(self._turn + np.pi / 2)

    @cached_property
    def rocker_motion(self) -> np.ndarray:
        """``v_C``: unit vector in which the rocker's ball joint moves while the rocker angle grows."""
        return self.linkage.rocker_direction(self.rocker_angle + np.pi / 2)

    @cached_property
    def crank_pressure_angle(self) -> np.ndarray:
        """``alpha_1``: between the coupler and the motion of the crank's ball joint, 0 .. pi/2 rad."""
        return inclination(self.coupler_direction, self.crank_motion)

    @cached_property
    def rocker_pressure_angle(self) -> np.ndarray:
        """``alpha_2``: between the coupler and the motion of the rocker's ball joint, 0 .. pi/2 rad."""
        return inclination(self.coupler_direction, self.rocker_motion)

    @cached_property
    def crank_ball(self) -> BallJoint:
        """How far the coupler turns in the ball joint of the crank."""
        return crank_ball(self)

    @cached_property
    def rocker_ball(self) -> BallJoint:
        """How far the coupler turns in the ball joint of the rocker."""
        return rocker_ball(self)

    @property
    def crank_transmission_angle(self) -> np.ndarray:
        """``pi/2 - alpha_1``, rad."""
        return np.pi / 2 - self.crank_pressure_angle

    @property
    def rocker_transmission_angle(self) -> np.ndarray:
        """``pi/2 - alpha_2``, rad."""
        return np.pi / 2 - self.rocker_pressure_angle

    @cached_property
    def ratio(self) -> np.ndarray:
        """``dphi_3 / dphi_1 = l_1 F.v_B / (l_3 F.v_C)``; infinite at a limit angle."""
        return self._over_reach(self.linkage.crank * dot(self.coupler_direction, self.crank_motion))

    def _over_reach(self, value: Array) -> Array:
        """``value / (l_3 F.v_C)``: over the coupler's lever about the rocker's axis."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return value / (self.linkage.rocker * dot(self.coupler_direction, self.rocker_motion))

    @cached_property
    def acceleration_ratio(self) -> np.ndarray:
        """``d2phi_3 / dphi_1^2``, 1/rad: the rocker's angular acceleration over the crank's speed squared.

        The closure ``G(phi_1, phi_3) = 0`` differentiated twice, with ``v`` the `ratio`:
        ``G_11 + 2 G_13 v + G_33 v^2 + G_3 a = 0``.
        """
        a, b, k = self._closure
        sin, cos = np.sin(self.crank_angle), np.cos(self.crank_angle)
        sin3, cos3, v = np.sin(self.rocker_angle), np.cos(self.rocker_angle), self.ratio
        l3, L = self.linkage.rocker, self.linkage.axis_angle
        bend = (self.linkage.rocker_offset * np.sin(L) * sin + self.linkage.axis_distance * cos) / l3
        g11 = np.cos(L) * sin * sin3 + cos * cos3 + bend
        g13 = -np.cos(L) * cos * cos3 - sin * sin3
        with np.errstate(divide="ignore", invalid="ignore"):
            return -(g11 + 2 * g13 * v + k * v**2) / (a * cos3 - b * sin3)

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """Torque about the rocker's axis that the coupler has to overcome, N m, positive against a growing angle."""
        return self.load.resisting_torque(self.rocker_angle)

    @property
    def sense(self) -> Array:
        """Which way the crank turns, +1 or -1, ``(1,)`` or ``(p, 1)``."""
        if self.turning is not None:
            return np.atleast_1d(self.turning)
        swept = self.crank_angle[..., -1:] - self.crank_angle[..., :1]
        return np.where(swept < 0, -1.0, 1.0)

    @cached_property
    def rubbing(self) -> Rubbing:
        """What rubs, how fast, and the forces with it."""
        return Rubbing(self)

    @property
    def trouble(self) -> str:
        """Where friction jams the linkage, in a sentence; empty if it does nowhere."""
        jams = np.zeros(1, dtype=bool) if self.friction.none else self.rubbing.jams
        first = np.take_along_axis(self._turn, np.argmax(jams, axis=-1)[..., None], -1)[..., 0] / deg
        return text_if(jams.any(), f"friction jams the linkage, at a crank angle of {first:.4g} deg first")

    @cached_property
    def frictionless(self) -> RSSRAnalysis:
        """The same without friction."""
        return replace(self, friction=LinkageFriction())

    @cached_property
    def coupler_force(self) -> np.ndarray:
        """Force along the coupler, N, compression positive; infinite at a limit angle.  The links weigh nothing."""
        return self._over_reach(self.resisting_torque) if self.friction.none else self.rubbing.coupler_force

    @cached_property
    def push(self) -> np.ndarray:
        """Force of the coupler on the rocker, N: along the coupler, but for friction in its ball joints."""
        return self.coupler_force * self.coupler_direction if self.friction.none else self.rubbing.push

    @cached_property
    def crank_torque(self) -> np.ndarray:
        """Torque on the crank, N m, in the sense of a growing crank angle: ``S l_1 F.v_B``, and what rubs."""
        if not self.friction.none:
            return self.rubbing.crank_torque
        return self.coupler_force * self.linkage.crank * dot(self.coupler_direction, self.crank_motion)

    @cached_property
    def crank_bearing_force(self) -> np.ndarray:
        """Force of the frame on the crank, N."""
        return self.push

    @cached_property
    def crank_bearing_moment(self) -> np.ndarray:
        """Moment of the frame on the crank, across its axis, about its root, N m."""
        moment = np.cross(self.crank_arm, self.push, axis=0)
        if not self.friction.none:
            moment = moment - self.rubbing.crank_ball_moment
        return self._across(moment, self.linkage.crank_axis)

    def _across(self, moment: np.ndarray, axis: np.ndarray) -> np.ndarray:
        """What of a moment lies across an axis."""
        along = self.everywhere(axis)
        return moment - along * dot(along, moment)

    @cached_property
    def weight(self) -> np.ndarray:
        """Weight of what turns with the rocker as a vector, N."""
        load, linkage = self.load, self.linkage
        downhill = self.everywhere(linkage.rocker_direction(load.downhill))
        up = self.everywhere(linkage.rocker_axis)
        return load.mass * load.gravity * (np.sin(load.lean) * downhill - np.cos(load.lean) * up)

    @cached_property
    def centre_of_gravity(self) -> np.ndarray:
        """Centre of gravity of what turns with the rocker, m."""
        return self.everywhere(self.linkage.rocker_root) + self.load_arm

    @property
    def load_arm(self) -> np.ndarray:
        """From the rocker's root to the centre of gravity, m."""
        along = self.load.rise * self.everywhere(self.linkage.rocker_axis)
        return along + self.load.reach * self.linkage.rocker_direction(self.rocker_angle + self.load.mass_angle)

    @cached_property
    def rocker_bearing_force(self) -> np.ndarray:
        """Force of the frame on the rocker, N: against the coupler's force and the weight."""
        return -self.push - self.weight

    @cached_property
    def rocker_bearing_moment(self) -> np.ndarray:
        """Moment of the frame on the rocker, across its axis, about its root, N m."""
        moment = np.cross(self.rocker_arm, self.push, axis=0) + np.cross(self.load_arm, self.weight, axis=0)
        if not self.friction.none:
            moment = moment + self.rubbing.rocker_ball_moment
        return -self._across(moment, self.linkage.rocker_axis)
