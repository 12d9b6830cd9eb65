"""camkit: the open workbook for mechanism design in JupyterLab.

All public names are importable from here.  The maths needs numpy and scipy alone; what needs pymoo,
matplotlib or ipywidgets is loaded when it is first asked for.  Where these are not installed, `__all__` leaves out
what needs them, and asking for one of these names says what to install.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from .cam.cam_lever import CamLever, cam_lever_study
from .cam.closing import ContactPair
from .cam.door_handle import DoorHandleCam, door_handle_paper_study, door_handle_study, lift_curve_study
from .cam.high_speed import HighSpeedCam
from .cam.high_speed_load import ConstantTorque, InertialSpringLoad, SliderLoad
from .cam.high_speed_study import high_speed_study
from .cam.load import ArmLoad, Friction
from .cam.oscillating_flat import OscillatingFlatCam
from .cam.oscillating_roller import OscillatingRollerCam
from .cam.slide import SlideFriction, SlideLoad
from .cam.translating_flat import TranslatingFlatCam
from .cam.translating_roller import TranslatingRollerCam
from .cam.valve import ValveCam
from .cam.valve_study import corrected_valve_study, valve_front_study, valve_study
from .contact import hertz_line
from .decision import ahp, crowding, judgement_ranges, knee, topsis, weighted_sum, winner_map
from .export import load, save
from .linkage.cabin_door import CabinDoorLinkage, ninety_degree_study, rssr_study
from .linkage.load import RockerLoad
from .linkage.rssr import RSSR
from .linkage.space import Box
from .motion import *  # noqa: F403
from .motion import __all__ as _motion_names
from .plane import Plane
from .polish import SumOfResiduals, polish
from .profile_files import profile_csv, profile_dxf
from .quantities import Measure, PeakMeasure, UnitRemark, quantity
from .shaft import UniversalJointShaft, lightest_shaft, shaft_study
from .side_by_side import side_by_side
from .study import Study, weighted
from .sweep import Sweep
from .tolerance import Curve, Tolerances
from .units import GPa, MPa, N, cm, deg, kg, kN, kW, m, mm, rad, rpm
from .universal_joint import DoubleUniversalJoint, UniversalJoint

__version__ = "0.1.0"

_LATER = {
    "CompetitiveAlgorithm": "competitive",
    "decide": "app",
    "edit_program": "app",
    "explore": "app",
    "Front": "optimise",
    "improve": "app",
    "judge": "app",
    "live_front": "app",
    "minimise": "minimum",
    "nsga2": "optimise",
    "offer": "app",
    "picture": "plot.picture",
    "quick_front": "archive",
    "search": "app",
    "shorten": "app",
    "shortest_interval": "cycle_time",
    "survey": "app",
    "tolerate": "app",
    "trade": "app",
    "trade_off": "trade_offs",
    "trade_off_steps": "trade_offs",
    "tray": "app",
    "try_everything": "app",
}
"""Names whose modules need more than numpy and scipy, and where they live."""

_EXTRA = ("pymoo", "matplotlib", "ipywidgets", "anywidget")
"""What they need."""


def _installed(library: str) -> bool:
    try:
        return find_spec(library) is not None
    except ImportError:
        return False


_LAB = all(map(_installed, _EXTRA))

__all__ = [
    "ArmLoad",
    "Box",
    "CabinDoorLinkage",
    "CamLever",
    "ConstantTorque",
    "ContactPair",
    "Curve",
    "DoorHandleCam",
    "DoubleUniversalJoint",
    "Friction",
    "GPa",
    "HighSpeedCam",
    "InertialSpringLoad",
    "MPa",
    "Measure",
    "N",
    "OscillatingFlatCam",
    "OscillatingRollerCam",
    "PeakMeasure",
    "Plane",
    "RSSR",
    "RockerLoad",
    "SlideFriction",
    "SlideLoad",
    "SliderLoad",
    "Study",
    "SumOfResiduals",
    "Sweep",
    "Tolerances",
    "TranslatingFlatCam",
    "TranslatingRollerCam",
    "UnitRemark",
    "UniversalJoint",
    "UniversalJointShaft",
    "ValveCam",
    "ahp",
    "cam_lever_study",
    "cm",
    "corrected_valve_study",
    "crowding",
    "deg",
    "door_handle_paper_study",
    "door_handle_study",
    "hertz_line",
    "high_speed_study",
    "judgement_ranges",
    "kN",
    "kW",
    "kg",
    "knee",
    "lift_curve_study",
    "lightest_shaft",
    "load",
    "m",
    "mm",
    "ninety_degree_study",
    "polish",
    "profile_csv",
    "profile_dxf",
    "quantity",
    "rad",
    "rpm",
    "rssr_study",
    "save",
    "shaft_study",
    "side_by_side",
    "topsis",
    "valve_front_study",
    "valve_study",
    "weighted",
    "weighted_sum",
    "winner_map",
    *(_LATER if _LAB else ()),
    *_motion_names,
]


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"camkit has no {name!r}")
    try:
        return getattr(import_module(f".{_LATER[name]}", __name__), name)
    except ModuleNotFoundError as missing:
        library = (missing.name or "").partition(".")[0]
        if library == __name__:
            raise
        raise ModuleNotFoundError(
            f"{name} needs {library}, which is not installed: pip install 'camkit[lab]'", name=library
        ) from None


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
