"""Measures of an RSSR linkage over a sweep: a number per design, for tables, limits and objectives."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ..quantities import LeastMeasure, Measure, PeakMeasure
from ..quantities.kinds import numbers, one_number, refuse_arguments, shown
from ..quantities.types import Array, Value
from ..study.residuals import SumOfResiduals
from ..units import deg
from .ball_joints import BallJoint, as_axis
from .rssr_analysis import RSSRAnalysis
from .space import Box

TARGET = 30 * deg
"""The pressure angle that the paper aims at."""


def departures(target: float = TARGET, weights: object = None) -> Callable[[RSSRAnalysis], np.ndarray]:
    """Pressure angles less ``target``, times the weight of their position: a function of an analysis, ``(..., 2n)``.

    The crank's come first, then the rocker's.  The paper's weights ``1 / f_j*`` divide by nothing where a position
    is perfect; without ``weights`` each counts 1.
    """
    one_number(target, "the pressure angle that is aimed at", holds=math.isfinite)
    w = numbers(1.0 if weights is None else weights, "the weights of the positions")
    if w.ndim > 1:
        raise ValueError(f"the weights of the positions have the shape {w.shape}; they must be one for each position")
    if not (np.isfinite(w).all() and (w >= 0).all()):
        raise ValueError("the weights of the positions must be finite, none negative")

    def of(analysis: RSSRAnalysis) -> np.ndarray:
        both = (analysis.crank_pressure_angle, analysis.rocker_pressure_angle)
        if w.size not in (1, np.shape(both[0])[-1]):
            raise ValueError(
                f"there are {w.size} weights for {np.shape(both[0])[-1]} positions; there must be one for each"
            )
        return np.concatenate([w * (angle - target) for angle in both], axis=-1)

    return of


def departure(target: float = TARGET, weights: object = None) -> Measure:
    """The paper's objective ``sum_j w_j (|alpha_1j - target| + |alpha_2j - target|)``."""
    of, name = departures(target, weights), _name("pressure angles off", target, weights)
    return SumOfResiduals(name, "deg", of, made=_made("departure", target, weights))


def excess(target: float = TARGET, weights: object = None) -> Measure:
    """The same sum over the pressure angles above ``target`` only: a smaller one is no fault."""
    of, name = departures(target, weights), _name("pressure angles above", target, weights)
    made = _made("excess", target, weights)
    return SumOfResiduals(name, "deg", of, above_only=True, made=made)


def max_departure(target: float = TARGET, weights: object = None) -> Measure:
    """The largest ``w_j |alpha - target|``: minimax."""
    of, name = departures(target, weights), _name("pressure angle farthest off", target, weights)
    made = _made("largest departure", target, weights)
    return PeakMeasure(name, "deg", lambda a: np.concatenate([of(a), -of(a)], axis=-1), made=made)


def _made(name: str, target: float, weights: object) -> tuple[object, ...]:
    return (name, float(target)) if weights is None else ()


def _name(what: str, target: float, weights: object) -> str:
    return f"{what} {target / deg:g} deg" + ("" if weights is None else ", weighted")


def room_in(box: Box) -> Measure:
    """How far the centre lines of all links stay within a box, from the nearest wall; < 0 where one leaves it."""
    refuse_arguments(room_in, locals())
    made = ("room in", tuple(box.low), tuple(box.high), box.name)

    def room(analysis: RSSRAnalysis) -> Array:
        return np.concatenate([joint for wall in box.depths(analysis.chain) for joint in wall], axis=-1)

    return LeastMeasure(f"room within {box.name}", "mm", room, made=made)


def clearance_from(box: Box) -> Measure:
    """How far the centre lines of all links stay clear of a box; < 0 where one enters it."""
    refuse_arguments(clearance_from, locals())
    made = ("clearance from", tuple(box.low), tuple(box.high), box.name)

    def clearance(analysis: RSSRAnalysis) -> Array:
        return box.clearance(analysis.chain[:, :-1], analysis.chain[:, 1:]).min((0, -1))

    return Measure(f"clearance from {box.name}", "mm", clearance, made=made)


def max_ball_angle(joint: str, axis: tuple[float, float, float] | None = None) -> Measure:
    """The largest angle between the coupler and the axis of the socket of a ball joint, "crank" or "rocker".

    Without an ``axis`` it is half the smallest cone's, whose axis lies best.  An axis is given as the link sees it:
    along the link from its own axis to the joint, the way the joint moves, along the link's axis.
    """
    ball, given = _joint(joint), None if axis is None else _axis(axis)
    name = f"maximum angle of the ball joint, {joint}" + (f", from {_shown(axis)}" if axis is not None else "")

    def angle(analysis: RSSRAnalysis) -> Array:
        return ball(analysis).angle if given is None else ball(analysis).angle_from(given)

    made = ("ball joint", joint, *(map(float, axis) if axis is not None else ()))
    return PeakMeasure(name, "deg", angle, angle=lambda a: a.crank_angle, made=made)


def max_stud_tilt(joint: str, axis: tuple[float, float, float] = (0, 0, 1)) -> Measure:
    """How far the coupler tilts from square to the stud of a rod end, which stands along an ``axis`` of the link.

    Unless said otherwise the stud stands along the axis about which the link turns; see `max_ball_angle`.
    """
    ball, given = _joint(joint), _axis(axis)

    def tilt(analysis: RSSRAnalysis) -> Array:
        return abs(ball(analysis).angle_from(given) - np.pi / 2)

    own, made = tuple(axis) == (0, 0, 1), ("rod end", joint, *map(float, axis))
    name = f"maximum tilt of the rod end, {joint}" + ("" if own else f", stud along {_shown(axis)}")
    return PeakMeasure(name, "deg", tilt, angle=lambda a: a.crank_angle, made=made)


def _shown(axis: tuple[float, float, float]) -> str:
    return f"({', '.join(f'{part:g}' for part in axis)})"


def _joint(joint: str) -> Callable[[RSSRAnalysis], BallJoint]:
    """What gives the ball joint of an analysis; ``ValueError`` for what is none."""
    if not (isinstance(joint, str) and joint in ("crank", "rocker")):
        raise ValueError(f"the joint is {shown(joint)}; it must be 'crank' or 'rocker'")
    return lambda a: a.crank_ball if joint == "crank" else a.rocker_ball


def _axis(axis: object) -> Array:
    """The axis of a joint as a unit vector; ``ValueError`` for what is none."""
    given = numbers(axis, "the axis of the joint")
    if given.shape != (3,) or not np.isfinite(given).all() or not given.any():
        raise ValueError(f"the axis of the joint is {shown(axis)}; it must be three finite numbers, not all of them 0")
    return as_axis(*given.tolist())


MAKERS: dict[str, Callable[..., Measure]] = {
    "departure": departure,
    "excess": excess,
    "largest departure": max_departure,
    "room in": lambda low, high, name: room_in(Box(low, high, name)),
    "clearance from": lambda low, high, name: clearance_from(Box(low, high, name)),
    "ball joint": lambda joint, *axis: max_ball_angle(joint, axis or None),
    "rod end": lambda joint, *axis: max_stud_tilt(joint, axis),
}
"""How files have such measures made again."""


max_crank_pressure_angle = PeakMeasure(
    "maximum pressure angle, crank", "deg", lambda a: a.crank_pressure_angle, angle=lambda a: a.crank_angle
)
max_rocker_pressure_angle = PeakMeasure(
    "maximum pressure angle, rocker", "deg", lambda a: a.rocker_pressure_angle, angle=lambda a: a.crank_angle
)
max_pressure_angle = PeakMeasure(
    "maximum pressure angle",
    "deg",
    lambda a: np.concatenate([a.crank_pressure_angle, a.rocker_pressure_angle], axis=-1),
    angle=lambda a: np.concatenate([a.crank_angle, a.crank_angle], axis=-1),
)
min_crank_transmission = -PeakMeasure(
    "minimum transmission angle, crank", "deg", lambda a: -a.crank_transmission_angle, angle=lambda a: a.crank_angle
)
min_rocker_transmission = -PeakMeasure(
    "minimum transmission angle, rocker", "deg", lambda a: -a.rocker_transmission_angle, angle=lambda a: a.crank_angle
)
swing = Measure("output swing", "deg", lambda a: np.ptp(a.rocker_angle, axis=-1))
assembly_margin = Measure("minimum discriminant of the sweep", "", lambda a: a.min_discriminant[..., 0])
possible_turn = Measure("possible turn of the crank", "deg", lambda a: a.possible_turn[..., 0])
"""From limit to limit; 360 deg: all the way round."""
peak_coupler_force = Measure("peak coupler force", "N", lambda a: abs(a.coupler_force).max(-1))
peak_crank_torque = Measure("peak crank torque", "N m", lambda a: abs(a.crank_torque).max(-1))


def _longest(vectors: np.ndarray) -> Value:
    return np.linalg.norm(vectors, axis=0).max(-1)


peak_crank_bearing_force = Measure("peak force on the crank's bearing", "N", lambda a: _longest(a.crank_bearing_force))
peak_crank_bearing_moment = Measure(
    "peak moment on the crank's bearing", "N m", lambda a: _longest(a.crank_bearing_moment)
)
peak_hinge_force = Measure("peak force on the rocker's bearing", "N", lambda a: _longest(a.rocker_bearing_force))
peak_hinge_moment = Measure("peak moment on the rocker's bearing", "N m", lambda a: _longest(a.rocker_bearing_moment))
max_ratio = Measure("maximum velocity ratio", "", lambda a: abs(a.ratio).max(-1))

SWEEP = (
    departure(),
    max_crank_pressure_angle,
    max_rocker_pressure_angle,
    min_crank_transmission,
    min_rocker_transmission,
    swing,
    assembly_margin,
    possible_turn,
    max_ratio,
    peak_coupler_force,
    peak_crank_torque,
    peak_crank_bearing_force,
    peak_crank_bearing_moment,
    peak_hinge_force,
    peak_hinge_moment,
)
"""What a table of one sweep shows."""

max_crank_ball_angle, max_rocker_ball_angle = max_ball_angle("crank"), max_ball_angle("rocker")
"""Half the cone that the coupler needs in each ball joint; those that can be bought have 15 to 30 deg."""
min_efficiency = LeastMeasure("minimum efficiency", "%", lambda a: a.rubbing.efficiency, angle=lambda a: a.crank_angle)
"""Power out over power in where it is least; below 0 the linkage is self-locking, `nan` where the load has no power."""
min_driving_torque = LeastMeasure(
    "minimum driving torque of the crank", "N m", lambda a: a.rubbing.driving_torque, angle=lambda a: a.crank_angle
)
"""The way the crank turns.  Above 0 all the way the load cannot move the linkage by itself; < 0: it is held back."""
friction_work = Measure("work of friction", "J", lambda a: a.rubbing.work)

JOINTS = (
    max_crank_ball_angle,
    max_rocker_ball_angle,
    max_stud_tilt("crank"),
    max_stud_tilt("rocker"),
    min_efficiency,
    min_driving_torque,
    friction_work,
)
"""What the joints bear and how far they turn."""
