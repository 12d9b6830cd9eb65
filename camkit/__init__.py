"""camkit: the open workbook for mechanism design in JupyterLab.

All public names are importable from here.  The maths needs numpy and scipy alone; what needs pymoo,
matplotlib or ipywidgets is loaded when it is first asked for.  Where these are not installed, `__all__` leaves out
what needs them, and asking for one of these names says what to install.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from .cam.force_closure import ContactPair
from .cam.loads import ArmLoad, Friction
from .cam.oscillating_flat import OscillatingFlatCam
from .cam.oscillating_roller import OscillatingRollerCam
from .cam.slide import SlideFriction, SlideLoad
from .cam.translating_flat import TranslatingFlatCam
from .cam.translating_roller import TranslatingRollerCam
from .contact import line_contact
from .decision import (
    Judgements,
    ahp,
    judgement_ranges,
    knee,
    most_isolated,
    side_by_side,
    topsis,
    weighted_sum,
    winner_map,
)
from .files import Session, profile_csv, profile_dxf, read, write
from .linkage.load import RockerLoad
from .linkage.rssr import RSSR
from .linkage.space import Box
from .linkage.universal_joint import DoubleUniversalJoint, UniversalJoint
from .machines.cabin_door import CabinDoorLinkage, ninety_degree_study, rssr_study
from .machines.cam_lever import CamLever, cam_lever_study
from .machines.door_handle import DoorHandleCam, door_handle_paper_study, door_handle_study, lift_curve_study
from .machines.high_speed_cam import HighSpeedCam
from .machines.high_speed_load import ConstantTorque, InertialSpringLoad, SliderLoad
from .machines.high_speed_study import high_speed_study
from .machines.shaft import UniversalJointShaft, lightest_shaft, shaft_study
from .machines.valve_cam import ValveCam
from .machines.valve_study import corrected_valve_study, valve_front_study, valve_study
from .motion import *  # noqa: F403
from .motion import __all__ as _motion_names
from .quantities import (
    Measure,
    PeakMeasure,
    UnitRemark,
    choices_of,
    quantities_of,
    quantity,
    value_of,
    with_quantities,
)
from .search.polish import polish
from .study.design_map import DesignMap
from .study.residuals import SumOfResiduals
from .study.study import Study, weighted
from .study.sweep import Sweep
from .study.tolerances import AnalysisCurve, Tolerances
from .units import GPa, MPa, N, cm, deg, inch, kg, kN, kW, lbf, m, mm, psi, rad, rpm, um

__version__ = "0.1.0"

_LATER = {
    "ahp_panel": "panels",
    "choose_panel": "panels",
    "compare_fronts": "panels",
    "CompetitiveAlgorithm": "search.competitive",
    "contour_panel": "panels",
    "cycle_time_panel": "panels",
    "edit_program": "panels",
    "explore": "panels",
    "Front": "search.front",
    "live_pareto_panel": "panels",
    "minimise": "search.minimise",
    "nsga2": "search.nsga2",
    "optimise_panel": "panels",
    "pareto_panel": "panels",
    "picture": "render.picture",
    "presets": "panels",
    "quick_front": "search.fast_front",
    "shortest_interval": "search.cycle_time",
    "shortlist": "panels",
    "tolerance_panel": "panels",
    "trade_off": "search.epsilon_constraint",
    "try_everything": "panels",
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
    "AnalysisCurve",
    "DoorHandleCam",
    "DoubleUniversalJoint",
    "Friction",
    "GPa",
    "HighSpeedCam",
    "InertialSpringLoad",
    "Judgements",
    "MPa",
    "Measure",
    "N",
    "OscillatingFlatCam",
    "OscillatingRollerCam",
    "PeakMeasure",
    "DesignMap",
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
    "choices_of",
    "cm",
    "corrected_valve_study",
    "most_isolated",
    "deg",
    "door_handle_paper_study",
    "door_handle_study",
    "line_contact",
    "high_speed_study",
    "judgement_ranges",
    "inch",
    "kN",
    "lbf",
    "psi",
    "um",
    "kW",
    "kg",
    "knee",
    "lift_curve_study",
    "lightest_shaft",
    "read",
    "m",
    "mm",
    "ninety_degree_study",
    "polish",
    "profile_csv",
    "profile_dxf",
    "quantities_of",
    "quantity",
    "rad",
    "rpm",
    "rssr_study",
    "Session",
    "write",
    "shaft_study",
    "side_by_side",
    "topsis",
    "value_of",
    "valve_front_study",
    "valve_study",
    "weighted",
    "weighted_sum",
    "winner_map",
    "with_quantities",
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
