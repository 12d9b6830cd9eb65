"""Measures of one cam curve: a number per design, for tables, limits and objectives.

Each takes an analysis with a ``cam_angle`` axis last, so it serves one design and a population alike.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from ..quantities import Measure
from ..quantities.types import Value

if TYPE_CHECKING:
    from .analysis import CamAnalysis
    from .pair import ConjugatePairAnalysis
    from .roller_analysis import RollerAnalysis

STILL = 1e-8
"""A follower slower than this share of its largest speed rests: what is left is rounding."""


def peak(f: Callable[[Any], Value]) -> Callable[[Any], Value]:
    """A function of an analysis: the largest value of ``f`` over the cam."""
    return lambda analysis: analysis.highest(f).value


def _min_radius(side: int) -> Callable[[RollerAnalysis], Value]:
    """The least radius of the pitch curve where it is convex (``side`` = 1) or hollow (-1); ``inf`` if nowhere."""
    return lambda analysis: radius_of(analysis.sharpest(side).value)


def number(value: Value) -> Value:
    """A field of a design as a number of the whole: one, or ``(p,)`` from ``(p, 1)``."""
    return np.atleast_1d(value)[..., 0]


def radius_of(curvature: Value) -> Value:
    """The radius of a curvature; ``inf`` where it is not above 0, ``nan`` stays."""
    with np.errstate(divide="ignore"):
        return np.where(curvature > 0, 1 / curvature, np.where(np.isnan(curvature), np.nan, np.inf))[()]


def _groove_margin(analysis: RollerAnalysis) -> Value:
    """``1 - r_T kappa`` on the inner flank, ``1 + r_T kappa`` on a groove's outer one too, at its least."""
    sides = (1, -1) if analysis.groove else (1,)
    r, most = number(analysis.cam.roller_radius), [analysis.sharpest(side).value for side in sides]
    with np.errstate(invalid="ignore"):
        margin = 1 - r * reduce(np.maximum, most)
    cornered = reduce(np.logical_or, map(np.isinf, most))
    return np.where((r == 0) & cornered, 1.0, margin)[()]  # a knife edge fits into every corner


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


max_pressure_angle = Measure("maximum pressure angle", "deg", peak(lambda a: abs(a.pressure_angle)))
base_radius = Measure("base radius (pitch)", "mm", lambda a: a.lowest(lambda at: at.pitch_radius).value)
min_convex_radius = Measure("minimum convex radius of curvature, pitch curve", "mm", _min_radius(1))
min_concave_radius = Measure("minimum concave radius of curvature, pitch curve", "mm", _min_radius(-1))
undercut_margin = Measure("undercut margin", "", _groove_margin, in_trouble=True)
groove_gap = Measure("wall between parts of the groove", "mm", lambda a: a.groove_gap, in_trouble=True)
"""A width only below a quarter of the roller's radius.  A larger number says that no wall is thinner than a quarter:
it is an estimate from above, and where nothing but neighbours along the curve is near it tells of them, up to 1.14
radii."""
peak_force = Measure("peak contact force", "N", peak(lambda a: abs(a.contact_force)))
peak_torque = Measure("peak cam torque without friction", "N mm", peak(lambda a: abs(a.cam_torque)))
mean_efficiency = Measure("mean efficiency", "%", lambda a: mean_over(a, "efficiency"))
published_mean_efficiency = Measure(
    "mean efficiency, published formula", "%", lambda a: mean_over(a, "published_efficiency")
)
work_efficiency = Measure("work efficiency", "%", work_ratio)

MOTION = (
    Measure("peak velocity", "", peak(lambda a: abs(a.velocity))),
    Measure("peak acceleration", "1/rad", peak(lambda a: abs(a.acceleration))),
    Measure("peak jerk", "1/rad^2", peak(lambda a: abs(a.jerk))),
)
"""Peaks of a rocking arm's motion, derivatives with respect to the cam angle."""

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
    return Measure(
        f"{measure.name}, {name}", measure.unit, lambda a: measure(getattr(a, name)), in_trouble=measure.in_trouble
    )


def worst(measure: Measure, names: tuple[str, ...], of: Callable[..., Value] = np.maximum) -> Measure:
    """The largest (``of=np.minimum``: least) value of ``measure`` over several curves of a machine."""
    return Measure(
        f"{measure.name}, worse curve",
        measure.unit,
        lambda a: reduce(of, [measure(getattr(a, name)) for name in names]),
        in_trouble=measure.in_trouble,
    )
