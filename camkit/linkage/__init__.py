"""Linkages in space: the RSSR linkage and universal joints, their loads and measures."""

from . import universal_joint
from .load import RockerLoad
from .measures import (
    SWEEP,
    assembly_margin,
    clearance_from,
    departure,
    excess,
    max_crank_pressure_angle,
    max_departure,
    max_pressure_angle,
    max_ratio,
    max_rocker_pressure_angle,
    min_crank_transmission,
    min_rocker_transmission,
    peak_coupler_force,
    peak_crank_bearing_force,
    peak_crank_bearing_moment,
    peak_crank_torque,
    peak_hinge_force,
    peak_hinge_moment,
    possible_turn,
    room_in,
    swing,
)
from .rssr import RSSR
from .rssr_analysis import RSSRAnalysis
from .space import Box
from .universal_joint import DoubleUniversalJoint, DoubleUniversalJointAnalysis, UniversalJoint, UniversalJointAnalysis

__all__ = [
    "RSSR",
    "SWEEP",
    "Box",
    "DoubleUniversalJoint",
    "DoubleUniversalJointAnalysis",
    "RSSRAnalysis",
    "RockerLoad",
    "UniversalJoint",
    "UniversalJointAnalysis",
    "assembly_margin",
    "clearance_from",
    "departure",
    "excess",
    "max_crank_pressure_angle",
    "max_departure",
    "max_pressure_angle",
    "max_ratio",
    "max_rocker_pressure_angle",
    "min_crank_transmission",
    "min_rocker_transmission",
    "peak_coupler_force",
    "peak_crank_bearing_force",
    "peak_crank_bearing_moment",
    "peak_crank_torque",
    "peak_hinge_force",
    "peak_hinge_moment",
    "possible_turn",
    "room_in",
    "swing",
    "universal_joint",
]
