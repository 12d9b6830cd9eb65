"""Measures of a cam and its follower beyond those of one curve: margins, closing, wear."""

from __future__ import annotations

from operator import attrgetter

import numpy as np

from ..quantities import LeastMeasure, Measure
from ..quantities.types import Value
from .analysis import CamAnalysis
from .force_closure import ContactPair, jump_speed, torque_balance
from .measures import (
    CURVE,
    base_radius,
    groove_gap,
    least_over_cam,
    max_pressure_angle,
    mean_efficiency,
    number,
    over_cam,
    peak_force,
    peak_torque,
    seen_at,
)

min_profile_radius = LeastMeasure(
    "minimum convex radius of curvature, profile",
    "mm",
    lambda a: a.profile_margin.value,
    angle=seen_at,
    points=lambda a: a.profile_radii,
    in_trouble=True,
)
undercut_place = Measure("cam angle of the minimum convex radius", "deg", lambda a: a.profile_margin.cam_angle)
face_width = Measure("minimum width of the face", "mm", lambda a: a.face_width)
min_force = least_over_cam("minimum contact force", "N", attrgetter("contact_force"), "struck")


def _mean_torque(analysis: CamAnalysis) -> Value:
    """Mean over the cam angle of what turns the cam, friction included, however many angles the analysis has."""
    shown = analysis.resolved
    return torque_balance(shown.cam_angle, shown.rubbing.cam_torque).mean


mean_torque = Measure("mean cam torque with friction", "N mm", _mean_torque)


def _overspeed(analysis: CamAnalysis) -> Value:
    """How much faster the cam may run before the follower jumps, as a share; ``inf`` for a cam at rest."""
    with np.errstate(divide="ignore"):
        return jump_speed(analysis) / np.abs(number(analysis.cam.load.speed)) - 1


leaving_speed = Measure("speed at which the follower leaves the cam", "rpm", jump_speed)
jump_margin = Measure("overspeed before the follower leaves the cam", "%", _overspeed)


peak_pressure = over_cam("peak contact pressure", "MPa", attrgetter("contact_pressure"), "struck")
"""The largest Hertz pressure along a cam whose contact is given; ``nan`` if a flank is undercut."""
ContactPair.measures = (peak_pressure,)

_CLOSING = (min_force, mean_torque, leaving_speed)
ROLLER_CURVE = (*CURVE, groove_gap, min_profile_radius, undercut_place, *_CLOSING)
"""What a table of a cam under a sliding roller shows."""
FLAT_CURVE = (
    max_pressure_angle,
    base_radius,
    min_profile_radius,
    undercut_place,
    face_width,
    peak_force,
    peak_torque,
    mean_efficiency,
    *_CLOSING,
)
"""What a table of a cam under a flat face shows."""
