"""Measures of one cam curve: a number per design, for tables, limits and objectives.

Each takes an analysis with a ``cam_angle`` axis last, so it serves one design and a population alike.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np

from ..quantities import Measure


def least_convex_radius_of(curvature: Any) -> Any:
    """Least radius of curvature where the curve is convex; ``inf`` where it never is, ``nan`` stays."""
    most = curvature.max(-1)
    with np.errstate(divide="ignore"):
        return np.where(most > 0, 1 / most, np.where(np.isnan(most), np.nan, np.inf))


def mean_over(angle: Any, values: Any, where: Any) -> Any:
    """Mean of ``values`` over the steps of the cam angle at either end of which ``where`` holds (trapezoid rule)."""
    step = np.diff(angle, axis=-1) * (where[..., 1:] | where[..., :-1])
    return ((values[..., 1:] + values[..., :-1]) / 2 * step).sum(-1) / step.sum(-1)


def work_ratio(analysis: Any) -> Any:
    """Work out over work in of a constant resisting torque: the power-weighted mean efficiency."""
    v, eta = abs(analysis.velocity), analysis.efficiency
    moving = (v > 0) & (eta > 0)
    power_in = np.divide(v, eta, out=np.zeros_like(v * eta), where=moving)
    jammed = ((v > 0) & (eta <= 0)).any(-1)
    work_out, work_in = (np.trapezoid(power, analysis.cam_angle, axis=-1) for power in (v, power_in))
    ratio = np.divide(work_out, work_in, out=np.zeros_like(1.0 * work_in), where=work_in > 0)
    return np.where(np.isnan(eta).any(-1), np.nan, np.where(jammed, 0.0, ratio))


steepest = Measure("steepest pressure angle", "deg", lambda a: abs(a.pressure_angle).max(-1))
base_radius = Measure("base radius (pitch)", "mm", lambda a: a.pitch_radius.min(-1))
least_convex_radius = Measure("least convex radius (pitch)", "mm", lambda a: least_convex_radius_of(a.curvature))
least_concave_radius = Measure("least concave radius (pitch)", "mm", lambda a: least_convex_radius_of(-a.curvature))
undercut_margin = Measure(
    "undercut margin of the groove",
    "",
    lambda a: 1 - (a.cam.roller_radius * (abs(a.curvature) if a.groove else a.curvature)).max(-1),
)
peak_force = Measure("peak contact force", "N", lambda a: abs(a.contact_force).max(-1))
peak_torque = Measure("peak cam torque", "N mm", lambda a: abs(a.cam_torque).max(-1))
mean_efficiency = Measure("mean efficiency", "%", lambda a: mean_over(a.cam_angle, a.efficiency, a.velocity != 0))
work_efficiency = Measure("work out / work in", "%", work_ratio)

MOTION = (
    Measure("peak velocity", "", lambda a: abs(a.velocity).max(-1)),
    Measure("peak acceleration", "1/rad", lambda a: abs(a.acceleration).max(-1)),
    Measure("peak jerk", "1/rad^2", lambda a: abs(a.jerk).max(-1)),
)
"""Peaks of a rocking arm's motion, derivatives with respect to the cam angle."""

CURVE = (
    steepest,
    base_radius,
    least_convex_radius,
    least_concave_radius,
    undercut_margin,
    peak_force,
    peak_torque,
    mean_efficiency,
    work_efficiency,
)
"""What a table of one cam curve shows."""


def part(measure: Measure, name: str) -> Measure:
    """``measure`` of one curve of a machine that has several: ``part(steepest, "lift")``."""
    return Measure(f"{measure.name}, {name}", measure.unit, lambda a: measure(getattr(a, name)))


def worst(measure: Measure, names: tuple[str, ...], of: Callable[..., Any] = np.maximum) -> Measure:
    """The largest (``of=np.minimum``: least) value of ``measure`` over several curves of a machine."""
    return Measure(
        f"{measure.name}, worse curve",
        measure.unit,
        lambda a: reduce(of, [measure(getattr(a, name)) for name in names]),
    )
