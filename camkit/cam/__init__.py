"""Disk and barrel cams with a follower on a straight guide or an arm, a roller or a flat face; loads and measures."""

from ..data.track_rollers import track_rollers
from .analysis import CamAnalysis
from .barrel import (
    BarrelAnalysis,
    BarrelCam,
    OscillatingBarrelAnalysis,
    OscillatingBarrelCam,
    bottom_pressure_angle,
    peak_skid,
    rolling_cone,
)
from .compared import Compared, deviation_from
from .flat_analysis import FlatAnalysis
from .follower_measures import (
    face_width,
    jump_margin,
    leaving_speed,
    mean_torque,
    min_force,
    min_profile_radius,
    peak_pressure,
)
from .force_closure import (
    ContactPair,
    NoContact,
    TorqueBalance,
    contact_along,
    jump_speed,
    preload_needed,
    torque_balance,
)
from .from_outline import ContactJump, OutlineMotion, cam_from_outline, motion_from_outline
from .loads import ArmLoad, Contact, Friction
from .measured_outline import MeasuredOutline
from .measures import (
    arm_acceleration,
    arm_travel,
    base_radius,
    groove_gap,
    max_pressure_angle,
    mean_efficiency,
    min_concave_radius,
    min_convex_radius,
    peak_acceleration,
    peak_force,
    peak_torque,
    peak_wear,
    published_mean_efficiency,
    travel,
    undercut_margin,
    work_efficiency,
)
from .oscillating_flat import OscillatingFlatAnalysis, OscillatingFlatCam
from .oscillating_roller import OscillatingRollerAnalysis, OscillatingRollerCam
from .outlines import CamOutline, DrawnOutline
from .pair import ConjugatePair, ConjugatePairAnalysis
from .roller_analysis import RollerAnalysis
from .shaking import vibration_at
from .slide import SlideFriction, SlideLoad
from .timing import at_lift
from .translating_flat import TranslatingFlatAnalysis, TranslatingFlatCam
from .translating_roller import TranslatingRollerAnalysis, TranslatingRollerCam

__all__ = [
    "ArmLoad",
    "BarrelAnalysis",
    "BarrelCam",
    "CamAnalysis",
    "CamOutline",
    "Compared",
    "ConjugatePair",
    "ConjugatePairAnalysis",
    "Contact",
    "ContactJump",
    "ContactPair",
    "DrawnOutline",
    "FlatAnalysis",
    "Friction",
    "MeasuredOutline",
    "NoContact",
    "OscillatingBarrelAnalysis",
    "OscillatingBarrelCam",
    "OscillatingFlatAnalysis",
    "OscillatingFlatCam",
    "OscillatingRollerAnalysis",
    "OscillatingRollerCam",
    "OutlineMotion",
    "RollerAnalysis",
    "SlideFriction",
    "SlideLoad",
    "TorqueBalance",
    "TranslatingFlatAnalysis",
    "TranslatingFlatCam",
    "TranslatingRollerAnalysis",
    "TranslatingRollerCam",
    "arm_acceleration",
    "arm_travel",
    "at_lift",
    "base_radius",
    "bottom_pressure_angle",
    "cam_from_outline",
    "contact_along",
    "deviation_from",
    "face_width",
    "groove_gap",
    "jump_margin",
    "jump_speed",
    "leaving_speed",
    "max_pressure_angle",
    "mean_efficiency",
    "mean_torque",
    "min_concave_radius",
    "min_convex_radius",
    "min_force",
    "min_profile_radius",
    "motion_from_outline",
    "peak_acceleration",
    "peak_force",
    "peak_pressure",
    "peak_skid",
    "peak_torque",
    "peak_wear",
    "preload_needed",
    "published_mean_efficiency",
    "rolling_cone",
    "torque_balance",
    "track_rollers",
    "travel",
    "undercut_margin",
    "vibration_at",
    "work_efficiency",
]
