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
from .entrainment import Entrainment, entrainment, reversals
from .film import Lubricant, film_thickness
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
from .life import BearingLife, NoBearing, RollerBearing, SurfaceStrength, load_stress_factor
from .loads import ArmLoad, Contact, Friction
from .lubricated_pair import LubricatedPair
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
from .pins import CamWithPins, pin_pressure, pin_pv, pin_volume, pivot_pressure, pivot_pv, ring_thickness
from .roller_analysis import RollerAnalysis
from .shaking import vibration_at
from .slide import SlideFriction, SlideLoad
from .surface_measures import (
    bearing_life,
    bearing_load,
    min_entrainment,
    min_film,
    min_film_ratio,
    min_life,
    peak_load_stress,
    peak_rubbing,
    pressure_share,
    roller_life,
    thin_film,
)
from .surfaces import SurfaceLife, cam_life
from .timing import at_lift
from .translating_flat import TranslatingFlatAnalysis, TranslatingFlatCam
from .translating_roller import TranslatingRollerAnalysis, TranslatingRollerCam

__all__ = [
    "ArmLoad",
    "BarrelAnalysis",
    "BarrelCam",
    "BearingLife",
    "CamAnalysis",
    "CamOutline",
    "CamWithPins",
    "Compared",
    "ConjugatePair",
    "ConjugatePairAnalysis",
    "Contact",
    "ContactJump",
    "ContactPair",
    "DrawnOutline",
    "Entrainment",
    "FlatAnalysis",
    "Friction",
    "Lubricant",
    "LubricatedPair",
    "MeasuredOutline",
    "NoBearing",
    "NoContact",
    "OscillatingBarrelAnalysis",
    "OscillatingBarrelCam",
    "OscillatingFlatAnalysis",
    "OscillatingFlatCam",
    "OscillatingRollerAnalysis",
    "OscillatingRollerCam",
    "OutlineMotion",
    "RollerAnalysis",
    "RollerBearing",
    "SlideFriction",
    "SlideLoad",
    "SurfaceLife",
    "SurfaceStrength",
    "TorqueBalance",
    "TranslatingFlatAnalysis",
    "TranslatingFlatCam",
    "TranslatingRollerAnalysis",
    "TranslatingRollerCam",
    "arm_acceleration",
    "arm_travel",
    "at_lift",
    "base_radius",
    "bearing_life",
    "bearing_load",
    "bottom_pressure_angle",
    "cam_from_outline",
    "cam_life",
    "contact_along",
    "deviation_from",
    "entrainment",
    "face_width",
    "film_thickness",
    "groove_gap",
    "jump_margin",
    "jump_speed",
    "leaving_speed",
    "load_stress_factor",
    "max_pressure_angle",
    "mean_efficiency",
    "mean_torque",
    "min_concave_radius",
    "min_convex_radius",
    "min_entrainment",
    "min_film",
    "min_film_ratio",
    "min_force",
    "min_life",
    "min_profile_radius",
    "motion_from_outline",
    "peak_acceleration",
    "peak_force",
    "peak_load_stress",
    "peak_pressure",
    "peak_rubbing",
    "peak_skid",
    "peak_torque",
    "peak_wear",
    "pin_pressure",
    "pin_pv",
    "pin_volume",
    "pivot_pressure",
    "pivot_pv",
    "preload_needed",
    "pressure_share",
    "published_mean_efficiency",
    "reversals",
    "ring_thickness",
    "roller_life",
    "rolling_cone",
    "thin_film",
    "torque_balance",
    "track_rollers",
    "travel",
    "undercut_margin",
    "vibration_at",
    "work_efficiency",
]
