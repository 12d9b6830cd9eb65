"""Measures of one cam curve: a number per design, for tables, limits and objectives.

Each takes an analysis with a ``cam_angle`` axis last, so it serves one design and a population alike.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from ..geometry import end_to_end
from ..quantities import CurveMeasure, LeastMeasure, Measure, PeakMeasure, floats
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .analysis import CamAnalysis
    from .pair import ConjugatePairAnalysis
    from .roller_analysis import RollerAnalysis

STILL = 1e-8
"""A follower slower than this share of its largest speed rests: what is left is rounding."""


def peak(f: Callable[[Any], Value]) -> Callable[[Any], Value]:
    """A function of an analysis: the largest value of ``f`` over the cam."""
    return lambda analysis: analysis.highest(f).value


def over_cam(name: str, unit: str, f: Callable[[Any], Value], without_end: str = "") -> PeakMeasure:
    """The largest value of ``f`` over the cam, of which a search sees every cam angle.

    It is ``inf`` where the analysis says by the name ``without_end`` that the curve has none.
    """

    def points(analysis: CamAnalysis) -> Value:
        return analysis.seen(f) + _end(analysis, without_end)[..., None]

    return PeakMeasure(name, unit, lambda a: a.highest(f).value + _end(a, without_end), angle=seen_at, points=points)


def least_over_cam(name: str, unit: str, f: Callable[[Any], Value], without_end: str = "") -> LeastMeasure:
    """The least value of ``f`` over the cam, of which a search sees every cam angle; ``-inf`` as in `over_cam`."""

    def points(analysis: CamAnalysis) -> Value:
        return analysis.seen(f, -1) - _end(analysis, without_end)[..., None]

    return LeastMeasure(name, unit, lambda a: a.lowest(f).value - _end(a, without_end), angle=seen_at, points=points)


def _end(analysis: CamAnalysis, without_end: str) -> Array:
    return np.where(getattr(analysis, without_end), np.inf, 0.0) if without_end else np.zeros(())


def seen_at(analysis: CamAnalysis) -> Array:
    """The cam angles that show every peak, rad."""
    return analysis.seen_at


def _min_radius(kind: str, side: int) -> LeastMeasure:
    """The least radius of the pitch curve where it is convex (``side`` = 1) or hollow (-1); ``inf`` if nowhere."""
    name = f"minimum {kind} radius of curvature, pitch curve"

    def points(analysis: RollerAnalysis) -> Value:
        return radius_of(analysis.bends(side))

    return LeastMeasure(name, "mm", lambda a: radius_of(a.sharpest(side).value), angle=seen_at, points=points)


def number(value: Value) -> Value:
    """A field of a design as a number of the whole: one, or ``(p,)`` from ``(p, 1)``."""
    return np.atleast_1d(value)[..., 0]


def radius_of(curvature: Value) -> Value:
    """The radius of a curvature; ``inf`` where it is not above 0, ``nan`` stays."""
    with np.errstate(divide="ignore"):
        return np.where(curvature > 0, 1 / curvature, np.where(np.isnan(curvature), np.nan, np.inf))[()]


def _groove_margin(analysis: RollerAnalysis) -> Value:
    """``1 - r_T kappa`` on the inner flank, ``1 + r_T kappa`` on a groove's outer one too, at its least."""
    r, most = number(analysis.cam.roller_radius), [analysis.sharpest(side).value for side in _flanks(analysis)]
    return _room(r, reduce(np.maximum, most))


def _groove_margins(analysis: RollerAnalysis) -> Array:
    """The same at every cam angle, on one flank and then on the other."""
    r = floats(analysis.cam.roller_radius)
    return end_to_end(*(_room(r, analysis.bends(side)) for side in _flanks(analysis)))


def _flanks(analysis: RollerAnalysis) -> tuple[int, ...]:
    return (1, -1) if analysis.groove else (1,)


def _room(r: Value, curvature: Value) -> Array:
    with np.errstate(invalid="ignore"):
        margin = 1 - r * curvature
    return np.where((r == 0) & np.isinf(curvature), 1.0, margin)[()]  # a knife edge fits into every corner


def mean_over(analysis: CamAnalysis | ConjugatePairAnalysis, name: str) -> Value:
    """Mean over the cam angle of what the analysis calls ``name``, over the strokes: dwells are left out.

    ``nan`` if the follower does not move at all.
    """
    shown, resolution = analysis.resolved, analysis.resolution
    angle, values = shown.cam_angle, getattr(shown, name)
    step = np.diff(angle, axis=-1) * resolution.moves[:-1] * resolution.moves[1:]
    total = ((values[..., 1:] + values[..., :-1]) / 2 * step).sum(-1)
    span = step.sum(-1)
    return np.where(span > 0, total / np.where(span > 0, span, 1.0), np.nan)[()]


def work_ratio(analysis: CamAnalysis | ConjugatePairAnalysis) -> Value:
    """Work out over work in of a constant resisting torque: the power-weighted mean efficiency.

    Where a stroke begins or ends, the work in for a step of cam angle is that towards which it goes there: against
    the friction of the cam's bearing it is not 0, though the follower and with it the efficiency is at rest.
    """
    shown, pieces = analysis.resolved, analysis.resolution
    v, eta = np.broadcast_arrays(abs(shown.velocity), shown.efficiency)
    moving = v > STILL * v.max(-1, keepdims=True)
    jammed = (moving & (eta <= 0)).any(-1)
    passes, at = moving & (eta > 0), np.arange(v.shape[-1])
    power_in = np.where(passes, v / np.where(passes, eta, 1.0), 0.0)
    for ends, inward in ((pieces.first, 1), (pieces.last, -1)):
        near, far, farther = (np.roll(power_in, -k * inward, axis=-1) for k in (1, 2, 3))
        resting = np.isin(at, ends[pieces.moves[ends]]) & np.logical_not(moving)
        power_in = np.where(resting, 3 * (near - far) + farther, power_in)
    work_out, work_in = (np.trapezoid(power, shown.cam_angle, axis=-1) for power in (v, power_in))
    ratio = np.where(work_in > 0, work_out / np.where(work_in > 0, work_in, 1.0), 0.0)
    return np.where(np.isnan(eta).any(-1), np.nan, np.where(jammed, 0.0, ratio))


max_pressure_angle = over_cam("maximum pressure angle", "deg", lambda a: abs(a.pressure_angle))
base_radius = Measure("base radius (pitch)", "mm", lambda a: a.lowest(lambda at: at.pitch_radius).value)
min_convex_radius, min_concave_radius = _min_radius("convex", 1), _min_radius("concave", -1)
undercut_margin = LeastMeasure(
    "undercut margin",
    "",
    _groove_margin,
    angle=lambda a: end_to_end(*(seen_at(a) for _ in _flanks(a))),
    points=_groove_margins,
    in_trouble=True,
)
groove_gap = Measure("wall between parts of the groove", "mm", lambda a: a.groove_gap, in_trouble=True)
"""A width only below a quarter of the roller's radius.  A larger number says that no wall is thinner than a quarter:
it is an estimate from above, and where nothing but neighbours along the curve is near it tells of them, up to 1.14
radii."""
peak_force = over_cam("peak contact force", "N", lambda a: abs(a.contact_force), "struck")
peak_torque = over_cam("peak cam torque without friction", "N mm", lambda a: abs(a.cam_torque), "struck")
peak_wear = over_cam("wear index", "N^1.5 mm^-0.5", lambda a: a.wear_index, "struck")
mean_efficiency = Measure("mean efficiency", "%", lambda a: mean_over(a, "efficiency"))
published_mean_efficiency = Measure(
    "mean efficiency, published formula", "%", lambda a: mean_over(a, "published_efficiency")
)
work_efficiency = Measure("work efficiency", "%", work_ratio)


def _acceleration(analysis: CamAnalysis) -> Array:
    return abs(analysis.acceleration)


def _travel(analysis: CamAnalysis) -> Array:
    return analysis.motion.s


MOTION = (
    over_cam("peak velocity", "", lambda a: abs(a.velocity)),
    over_cam("peak acceleration", "1/rad", _acceleration, "bumps"),
    over_cam("peak jerk", "1/rad^2", lambda a: abs(a.jerk)),
)
"""Peaks of a rocking arm's motion, derivatives with respect to the cam angle."""
travel, arm_travel = (over_cam("travel", unit, _travel) for unit in ("mm", "deg"))
"""From the motion's level 0, of a sliding follower and of an arm."""
peak_acceleration, arm_acceleration = over_cam("peak acceleration", "mm/rad^2", _acceleration, "bumps"), MOTION[1]
"""By the cam angle, of a sliding follower and of an arm."""
rms_torque = Measure("rms cam torque without friction", "N mm", lambda a: a.turning.rms)
surplus_work = Measure("surplus work of the cam torque", "J", lambda a: a.turning.swing)
"""Between the largest and the least over the turn: what a flywheel has to store."""
DRIVE = rms_torque, surplus_work
SLIDING, ROCKING = (travel, peak_acceleration, peak_wear, *DRIVE), (arm_travel, arm_acceleration, peak_wear, *DRIVE)
"""What a law can make small, or has to keep at some cam angles, beside what the tables show."""

CURVE = (
    max_pressure_angle,
    base_radius,
    min_convex_radius,
    min_concave_radius,
    undercut_margin,
    peak_force,
    peak_torque,
    mean_efficiency,
    work_efficiency,
)
"""What a table of one cam curve shows."""
ARM_CURVE = (*CURVE, published_mean_efficiency, groove_gap)
"""As `CURVE`, for a roller on a rocking arm, of whose efficiency a formula is published."""


def part(measure: Measure, name: str) -> Measure:
    """``measure`` of one curve of a machine that has several: ``part(max_pressure_angle, "lift")``."""
    told = f"{measure.name}, {name}"
    if not isinstance(measure, CurveMeasure):
        return Measure(told, measure.unit, lambda a: measure(getattr(a, name)), in_trouble=measure.in_trouble)
    at = measure.angle or seen_at
    return replace(
        measure,
        name=told,
        function=lambda a: measure.sign * measure(getattr(a, name)),
        points=lambda a: measure.curve(getattr(a, name)),
        angle=lambda a: at(getattr(a, name)),
    )


def worst(measure: Measure, names: tuple[str, ...], of: Callable[..., Value] = np.maximum) -> Measure:
    """The largest (``of=np.minimum``: least) value of ``measure`` over several curves of a machine."""
    told = f"{measure.name}, worse curve"

    def whole(analysis: Any) -> Value:
        return reduce(of, [measure(getattr(analysis, name)) for name in names])

    def each(analysis: Any) -> Array:
        return np.stack(np.broadcast_arrays(*[measure(getattr(analysis, name)) for name in names]), axis=-1)

    if not isinstance(measure, CurveMeasure):
        kind = LeastMeasure if of is np.minimum else PeakMeasure
        return kind(told, measure.unit, whole, points=each, in_trouble=measure.in_trouble)
    at = measure.angle or seen_at
    return replace(
        measure,
        name=told,
        function=whole,
        points=lambda a: end_to_end(*(measure.curve(getattr(a, name)) for name in names)),
        angle=lambda a: end_to_end(*(at(getattr(a, name)) for name in names)),
    )
