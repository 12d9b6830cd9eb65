"""The views of an analysis that nobody chose: of the shapes and curves that it offers, in its order."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..study.tolerances import AnalysisCurve
from ..units import deg, factor
from . import cam, high_speed, linkage, sizes, universal_joint, valve
from .picture import Axes, Line, Picture, View

VIEW_OF: dict[str, View] = {
    "bodies": cam.mechanism,
    "motion": cam.motion,
    "pressure_angle": cam.pressure_angle,
    "contact_force": cam.contact_force,
    "cam_torque": cam.cam_torque,
    "curvature": cam.curvature,
    "efficiency": cam.efficiency,
    "contact_pressure": cam.contact_pressure,
    "stress_coefficient": high_speed.contact_stress,
    "wear_coefficient": high_speed.wear,
    "hertz_pressure": high_speed.hertz_pressure,
    "stress": high_speed.stress_over_way,
    "wear": high_speed.wear_over_way,
    "way": high_speed.slider_load,
    "whole": valve.cam_and_follower,
    "lift": valve.lift,
    "velocity": valve.velocity,
    "acceleration": valve.acceleration,
    "jerk": valve.jerk,
    "profile_radius": valve.radius_of_curvature,
    "spring_force": valve.spring_and_inertia,
    "contact_stress": valve.contact_stress,
    "resistance": valve.camshaft_torque,
    "chain": linkage.linkage_in_space,
    "rocker_angle": linkage.output_angle,
    "crank_pressure_angle": linkage.pressure_angles,
    "ratio": linkage.velocity_ratio,
    "acceleration_ratio": linkage.acceleration_ratio,
    "crank_torque": linkage.torques,
    "coupler_force": linkage.forces,
    "drive": universal_joint.drive,
    "output_speed": universal_joint.speeds,
    "lead": universal_joint.leads,
    "output_torque": universal_joint.torques,
    "output_couple": universal_joint.couples,
    "sizes": sizes.sizes,
    "utilisation": sizes.utilisation,
    "rings": sizes.section,
}
"""By what an analysis offers: the name of one of its attributes."""


def default_views(analysis: Any) -> tuple[View, ...]:
    """A view of everything that ``analysis.offers``, which names attributes or holds curves (`AnalysisCurve`).

    >>> from camkit import OscillatingFlatCam
    >>> [view.__name__ for view in default_views(OscillatingFlatCam().analyse(91))][:3]
    ['mechanism', 'motion', 'pressure_angle']
    """
    return tuple(
        curve_view(offered) if isinstance(offered, AnalysisCurve) else VIEW_OF[offered]
        for offered in getattr(analysis, "offers", ())
    )


def curve_view(curve: AnalysisCurve) -> View:
    """A view of one curve of an analysis over its angle, with its limits."""

    def view(analysis: Any) -> Picture:
        name, angle = curve.angle(analysis)
        x, unit = angle / deg, factor(curve.unit)
        limits = [
            Line(f"limit {i}", np.asarray(x)[[0, -1]], [limit / unit] * 2, role="limit")
            for i, limit in enumerate(curve.limits)
        ]
        title = curve.label[:1].upper() + curve.label[1:]
        axes = Axes(title=title, xlabel=f"{name}  [deg]", ylabel=f"[{curve.unit}]")
        return Picture.of(axes, limits, Line("curve", x, curve.values(analysis) / unit, role="position"))

    view.__name__ = curve.label.replace(" ", "_")
    return view
