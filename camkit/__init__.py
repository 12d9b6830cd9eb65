"""camkit: the open workbook for mechanism design in JupyterLab.

All public names are importable from here.  The maths needs numpy and scipy alone; what needs pymoo,
matplotlib or ipywidgets is loaded when it is first asked for.
"""

from importlib import import_module
from typing import Any

from .cam.closing import ContactPair
from .cam.door_handle import DoorHandleCam, door_handle_study
from .cam.load import ArmLoad, Friction
from .cam.oscillating_flat import OscillatingFlatCam
from .cam.oscillating_roller import OscillatingRollerCam
from .cam.slide import SlideFriction, SlideLoad
from .cam.translating_flat import TranslatingFlatCam
from .cam.translating_roller import TranslatingRollerCam
from .cam.valve import ValveCam
from .cam.valve_study import corrected_valve_study, valve_front_study, valve_study
from .contact import hertz_line
from .decision import ahp, crowding, topsis, weighted_sum
from .export import load, profile_csv, save
from .linkage.cabin_door import CabinDoorLinkage, ninety_degree_study, rssr_study
from .linkage.load import RockerLoad
from .linkage.rssr import RSSR
from .linkage.space import Box
from .motion import *  # noqa: F403
from .motion import __all__ as _motion_names
from .plane import Plane
from .polish import polish
from .quantities import Measure, quantity
from .shaft import UniversalJointShaft, lightest_shaft, shaft_study
from .study import Study, weighted
from .sweep import Sweep
from .units import GPa, MPa, N, cm, deg, kg, kN, kW, m, mm, rad, rpm
from .universal_joint import DoubleUniversalJoint, UniversalJoint

__version__ = "0.1.0"

_LATER = {
    "CompetitiveAlgorithm": "competitive",
    "Front": "optimise",
    "minimise": "minimise",
    "offer": "app",
    "nsga2": "optimise",
    "explore": "app",
    "judge": "app",
    "search": "app",
    "edit_program": "app",
    "try_everything": "app",
    "picture": "plot.picture",
}
"""Names whose modules need more than numpy and scipy, and where they live."""

__all__ = [
    "CabinDoorLinkage",
    "ninety_degree_study",
    "rssr_study",
    "RockerLoad",
    "RSSR",
    "Box",
    "Plane",
    "polish",
    "UniversalJointShaft",
    "lightest_shaft",
    "shaft_study",
    "Sweep",
    "hertz_line",
    "ValveCam",
    "corrected_valve_study",
    "valve_front_study",
    "valve_study",
    "DoubleUniversalJoint",
    "UniversalJoint",
    "ArmLoad",
    "ContactPair",
    "DoorHandleCam",
    "Friction",
    "GPa",
    "MPa",
    "Measure",
    "N",
    "OscillatingFlatCam",
    "OscillatingRollerCam",
    "SlideFriction",
    "SlideLoad",
    "Study",
    "TranslatingFlatCam",
    "TranslatingRollerCam",
    "ahp",
    "load",
    "profile_csv",
    "save",
    "cm",
    "crowding",
    "deg",
    "door_handle_study",
    "kN",
    "kW",
    "kg",
    "m",
    "mm",
    "quantity",
    "rad",
    "rpm",
    "topsis",
    "weighted",
    "weighted_sum",
    *_LATER,
    *_motion_names,
]


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(f".{_LATER[name]}", __name__), name)
    raise AttributeError(f"camkit has no {name!r}")
