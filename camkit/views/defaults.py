"""The views of an analysis that nobody chose: of the shapes and curves that it offers, in its order."""

from __future__ import annotations

from ..study.tolerances import AnalysisCurve
from ..units import deg, factor
from . import at_speed, cam, development, driveline, event, intervals, outlines, shafts, sizes, space, speeds, surfaces
from .picture import Axes, Line, Picture, View
from .turning import torque_and_work, torque_over_speed

VIEW_OF: dict[str, View] = {
    "bodies": cam.mechanism,
    "train_bodies": at_speed.cam_and_train,
    "response": at_speed.force_beside_rigid,
    "load_acceleration": at_speed.acceleration_beside_cam,
    "over_speed": at_speed.force_over_speed,
    "harmonics": at_speed.spectrum_of_lift,
    "flight": at_speed.gap_and_strikes,
    "development": development.unrolled_cam,
    "shapes": development.shapes_in_space,
    "motion": cam.motion,
    "pressure_angle": cam.pressure_angle,
    "contact_force": cam.contact_force,
    "cam_torque": cam.cam_torque,
    "curvature": cam.curvature,
    "efficiency": cam.efficiency,
    "turning": torque_and_work,
    "torque_sweep": torque_over_speed,
    "contact_pressure": cam.contact_pressure,
    "surface_rates": surfaces.entrainment,
    "surfaces": surfaces.film_ratio,
    "stress_coefficient": intervals.contact_stress,
    "wear_coefficient": intervals.wear,
    "pressure": intervals.hertz_pressure,
    "stress": intervals.stress_over_way,
    "wear": intervals.wear_over_way,
    "way": intervals.load_over_way,
    "whole": event.cam_and_follower,
    "lift": event.lift,
    "velocity": event.velocity,
    "acceleration": event.acceleration,
    "jerk": event.jerk,
    "profile_radius": event.radius_of_curvature,
    "spring_force": event.spring_and_inertia,
    "contact_stress": event.stress_over_event,
    "resistance": event.camshaft_torque,
    "chain": space.linkage_in_space,
    "rocker_angle": space.output_angle,
    "crank_pressure_angle": space.pressure_angles,
    "ratio": space.velocity_ratio,
    "acceleration_ratio": space.acceleration_ratio,
    "crank_torque": space.torques,
    "coupler_force": space.forces,
    "drive": shafts.drive,
    "shafts": driveline.driveline,
    "output_speed": shafts.speeds,
    "lead": shafts.leads,
    "output_torque": shafts.torques,
    "output_couple": shafts.couples,
    "sizes": sizes.plane_of_sizes,
    "utilisation": sizes.utilisation,
    "rings": sizes.section,
    "beside_plain": speeds.vibration_beside_plain,
    "forces_beside_plain": speeds.force_beside_plain,
    "outline_deviation": outlines.outline_deviation,
}
"""By what an analysis offers: the name of one of its attributes."""


def default_views(analysis: object) -> tuple[View, ...]:
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
    """A view of one curve of an analysis over its angle, with its limits.

    A velocity, an acceleration or a jerk, by the name of the attribute, has the role of one.
    """
    attribute = curve.name.rpartition(".")[2]
    role = attribute if attribute in cam.MOTION else "position"

    def view(analysis: object) -> Picture:
        name, angle = curve.angle(analysis)
        x, unit = angle / deg, factor(curve.unit)
        limits = [
            Line(f"limit {i}", x[[0, -1]], [limit / unit] * 2, role="limit") for i, limit in enumerate(curve.limits)
        ]
        title = curve.label[:1].upper() + curve.label[1:]
        axes = Axes(title=title, xlabel=f"{name}  [deg]", ylabel=f"[{curve.unit}]")
        shaped = role == "acceleration"
        return Picture.of(axes, limits, Line("curve", x, curve.values(analysis) / unit, role=role, shaped=shaped))

    view.__name__ = curve.label.replace(" ", "_")
    return view
