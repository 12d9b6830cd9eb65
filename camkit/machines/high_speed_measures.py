"""Measures of a high-speed cam, and the questions asked of it.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..cam.force_closure import jump_speed
from ..cam.measures import number
from ..quantities import Measure, Paths, PeakMeasure
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..study.study import Space, Study
from ..units import mm
from . import high_speed_curves as curves
from .high_speed_analysis import HighSpeedAnalysis
from .high_speed_cam import STRONG, FreeLawCam, HighSpeedCam
from .high_speed_load import InertialSpringLoad


def peak(name: str, unit: str, curve: Callable[[Any], Array]) -> PeakMeasure:
    """The largest value of ``curve`` over rise and fall."""
    return PeakMeasure(name, unit, curve, angle=lambda a: a.moving_angle)


def _steepness(part: HighSpeedAnalysis) -> Array:
    return abs(part.pressure_angle)


def _torque(part: HighSpeedAnalysis) -> Array:
    return abs(part.cam_torque)


def _spring_use(analysis: HighSpeedAnalysis) -> Array:
    """What the inertia needs of the closing spring; nothing in a groove."""
    if analysis.groove:
        return abs(0.0 * analysis.springs)
    return analysis.cam.speed**2 * analysis.springs / analysis.spring_rate


peak_stress = peak("stress index F_sigma", "N^0.5 mm^-0.5", lambda a: a.stress)
peak_wear = peak("wear index", "N^1.5 mm^-0.5", lambda a: a.wear)
max_pressure_angle = peak("maximum pressure angle", "deg", lambda a: a.tops(_steepness))
peak_force = peak("peak normal force", "N", lambda a: a.tops(curves.push))
peak_pressure = peak("peak Hertz pressure", "MPa", lambda a: a.pressure)
peak_torque = peak("peak cam torque without friction", "N mm", lambda a: a.tops(_torque))
spring_use = peak("closing spring needed", "%", _spring_use)
min_force = -peak("minimum normal force", "N", lambda a: -a.forces)
lift_off = Measure("speed at which the roller leaves the cam", "%", jump_speed)
overrun = peak("arm beyond its ends / swing", "%", lambda a: a.beyond)
min_lead = -peak("minimum travel from the ends (3-4-5: 1)", "", lambda a: -a.lead)
undercut_margin = -peak("undercut margin", "", lambda a: -a.margins)
min_radius = Measure("minimum radius r_k1", "mm", lambda a: a.min_radius)
gap = Measure("gap from roller to pivot", "mm", lambda a: number(a.cam.arm_length - a.cam.roller_radius))
spring_factor = Measure("closing spring K", "", lambda a: a.spring_factor)

COMMON = (peak_pressure, peak_force, peak_torque, max_pressure_angle, undercut_margin, min_radius)
"""What the tables of all these cams show."""
HIGH_SPEED_MEASURES = (
    peak_stress,
    peak_wear,
    *COMMON,
    gap,
    spring_factor,
    spring_use,
    overrun,
    min_force,
    lift_off,
)
"""What a table of a high-speed cam shows; peaks are those of rise and fall together."""
HighSpeedCam.measures = (*HIGH_SPEED_MEASURES, min_lead)

GEOMETRY = {
    "arm_length": (40 * mm, 290 * mm),
    "roller_radius": (20 * mm, 200 * mm),
    "max_radius": (60 * mm, 140 * mm),
}
"""The paper's three free sizes; ``l >= 40``, ``r >= 20`` and ``r_k2 <= 140 mm`` are its limits, the others are wide."""
COEFFICIENTS = tuple(f"{way}_law.c{i}" for way in ("rise", "return") for i in range(4))
"""Paths of what shapes both laws."""
WEAK = 0.2
"""From here to ``STRONG`` the closing spring ``K`` is free."""
CLEAR = 1e-3
"""Least margin of undercut within a search: where it is 0 the stress is infinite."""


def laws_free(start: FreeLawCam) -> dict[str, tuple[float, float]]:
    """The eight coefficients of shaped laws, as far as their families let them go."""
    return {path: (c.low, c.high) for path, c in Paths(start, COEFFICIENTS).declared.items()}


def high_speed_study(
    start: HighSpeedCam | None = None,
    objective: Measure = peak_stress,
    *,
    free_laws: bool = False,
    free_spring: bool = True,
    space: Space | None = None,
    at_most: Mapping[Measure, float] | None = None,
    at_least: Mapping[Measure, float] | None = None,
    angles: int = 201,
) -> Study:
    """The paper's problem: the largest contact stress (or wear) of the turn small, ``r_k1`` at least 30 mm.

    Free are arm, roller and largest radius, with ``free_laws`` the eight coefficients too.  The closing spring is
    then free as well: its weakest rate is a maximum over the angles in turn, which descends better as the limit
    that no more spring is needed than there is.  Methods without slopes do better with ``free_spring=False``, the
    weakest spring for every law.  The roller may not lift at the speed of ``start``; a groove holds it without a
    spring.  ``space`` replaces the bounds of the sizes; ``at_most`` and ``at_least`` add limits.

    >>> study = high_speed_study()
    >>> print(f"{study.evaluate(study.x0).f[0, 0] * mm**0.5:.4f}")
    2.4780
    """
    refuse_arguments(high_speed_study, locals())
    start = start or HighSpeedCam()
    start = start.ready_for(COEFFICIENTS) if free_laws else start
    free: dict[str, tuple[float, float]] = dict(space or GEOMETRY) | (laws_free(start) if free_laws else {})
    most: dict[Measure, float] = {}
    least: dict[Measure, float] = {min_radius: 30 * mm, undercut_margin: CLEAR}
    if not start.groove:
        least[min_force] = 0.0
    if free_laws:
        least[min_lead] = 0.0
    if free_laws and free_spring and isinstance(start.load, InertialSpringLoad) and not start.groove:
        free["spring_factor"] = (WEAK, STRONG)
        most[spring_use] = 1.0
    if free_laws and not free_spring:
        start = start.replace(spring_factor=0.0)
    return Study(
        start=start.ready_for(free),
        free=free,
        minimise=(objective,),
        at_most=most | dict(at_most or {}),
        at_least=least | dict(at_least or {}),
        angles=angles,
    )
