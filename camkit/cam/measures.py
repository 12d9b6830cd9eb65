"""Measures of one cam curve: a number per design, for tables, limits and objectives.

Each takes an analysis with a ``cam_angle`` axis last, so it serves one design and a population alike.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np

from ..quantities import Measure


def peak(f: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """A function of an analysis: the largest value of ``f`` over the cam."""
    return lambda analysis: analysis.highest(f).value


def least_radius_where(bent: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """A function of an analysis: the least radius where the curvature ``bent`` is above 0; ``inf`` if nowhere."""

    def radius(analysis: Any) -> Any:
        most = peak(bent)(analysis)
        with np.errstate(divide="ignore"):
            return np.where(most > 0, 1 / most, np.where(np.isnan(most), np.nan, np.inf))[()]

    return radius


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


def _tightest(analysis: Any) -> Any:
    return analysis.cam.roller_radius * (abs(analysis.curvature) if analysis.groove else analysis.curvature)


steepest = Measure("steepest pressure angle", "deg", peak(lambda a: abs(a.pressure_angle)))
base_radius = Measure("base radius (pitch)", "mm", lambda a: a.lowest(lambda at: at.pitch_radius).value)
least_convex_radius = Measure("least convex radius (pitch)", "mm", least_radius_where(lambda a: a.curvature))
least_concave_radius = Measure("least concave radius (pitch)", "mm", least_radius_where(lambda a: -a.curvature))
undercut_margin = Measure("undercut margin of the groove", "", lambda a: 1 - peak(_tightest)(a))
peak_force = Measure("peak contact force", "N", peak(lambda a: abs(a.contact_force)))
peak_torque = Measure("peak cam torque", "N mm", peak(lambda a: abs(a.cam_torque)))
mean_efficiency = Measure("mean efficiency", "%", lambda a: mean_over(a.cam_angle, a.efficiency, a.velocity != 0))
work_efficiency = Measure("work out / work in", "%", work_ratio)

MOTION = (
    Measure("peak velocity", "", peak(lambda a: abs(a.velocity))),
    Measure("peak acceleration", "1/rad", peak(lambda a: abs(a.acceleration))),
    Measure("peak jerk", "1/rad^2", peak(lambda a: abs(a.jerk))),
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
