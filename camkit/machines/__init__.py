"""Whole machines: design, measures and study, one module each, whose other names are asked of it: ``shaft.twist``."""

from . import cabin_door, cam_lever, door_handle, high_speed_cam, high_speed_measures, shaft, valve_cam, valve_measures
from .cabin_door import CabinDoorLinkage, ninety_degree_study, rssr_study
from .cam_lever import CamLever, cam_lever_study
from .door_handle import DoorHandleCam, door_handle_paper_study, door_handle_study, lift_curve_study
from .high_speed_cam import HighSpeedCam
from .high_speed_load import ConstantTorque, InertialSpringLoad, SliderLoad
from .high_speed_measures import high_speed_study
from .shaft import UniversalJointShaft, lightest_shaft, shaft_study, standard_tubes
from .valve_cam import ValveCam
from .valve_measures import corrected_valve_study, valve_front_study, valve_study

__all__ = [
    "CabinDoorLinkage",
    "CamLever",
    "ConstantTorque",
    "DoorHandleCam",
    "HighSpeedCam",
    "InertialSpringLoad",
    "SliderLoad",
    "UniversalJointShaft",
    "ValveCam",
    "cabin_door",
    "cam_lever",
    "cam_lever_study",
    "corrected_valve_study",
    "door_handle",
    "door_handle_paper_study",
    "door_handle_study",
    "high_speed_cam",
    "high_speed_measures",
    "high_speed_study",
    "lift_curve_study",
    "lightest_shaft",
    "ninety_degree_study",
    "rssr_study",
    "shaft",
    "shaft_study",
    "standard_tubes",
    "valve_cam",
    "valve_front_study",
    "valve_measures",
    "valve_study",
]
