"""camkit: the open workbook for mechanism design in JupyterLab.

What notebooks and users need first is importable from here, the rest from the wings: ``camkit.motion``, ``camkit.cam``,
``camkit.views`` and so on.  The maths needs numpy and scipy alone; what needs pymoo, matplotlib or ipywidgets is loaded
when it is first asked for.  Where these are not installed, `__all__` leaves out what needs them, and asking for one of
these names says what to install.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from .cam import (
    ArmLoad,
    Friction,
    OscillatingFlatCam,
    OscillatingRollerCam,
    SlideLoad,
    TranslatingFlatCam,
    TranslatingRollerCam,
    motion_from_outline,
)
from .decision import Judgements, ahp, group, knee, most_isolated, topsis, weighted_sum
from .files import Decision, Session, read, read_motion, to_workshop, write, write_dxf, write_table
from .linkage import RSSR
from .machines import (
    DoorHandleCam,
    HighSpeedCam,
    UniversalJointShaft,
    ValveCam,
    door_handle_study,
    high_speed_study,
    rssr_study,
    shaft_study,
    valve_study,
)
from .motion import LAWS, Cycloidal, Dwell, ModifiedSine, MotionProgram, Poly345, Return, Rise, SimpleHarmonic
from .quantities import Measure, PeakMeasure, quantities_of, quantity, with_quantities
from .quantities.extras import extra
from .search import Front, quick_front
from .search.minimise import minimise
from .search.polish import polish
from .study import DesignMap, Study, Sweep, Tolerances
from .units import GPa, MPa, N, cm, deg, inch, kg, kN, kW, lbf, m, mm, psi, rad, rpm, um

if TYPE_CHECKING:
    from .panels import ahp_panel as ahp_panel
    from .panels import choose_panel as choose_panel
    from .panels import compare_fronts as compare_fronts
    from .panels import contour_panel as contour_panel
    from .panels import cycle_time_panel as cycle_time_panel
    from .panels import edit_program as edit_program
    from .panels import live_pareto_panel as live_pareto_panel
    from .panels import optimise_panel as optimise_panel
    from .panels import pareto_panel as pareto_panel
    from .panels import study_panel as study_panel
    from .panels import tolerance_panel as tolerance_panel
    from .panels.instrument import explore as explore
    from .panels.presets import presets as presets
    from .panels.shortlist import shortlist as shortlist
    from .render.figure import picture as picture
    from .render.living import to_html as to_html
    from .search.nsga2 import nsga2 as nsga2

__version__ = "0.1.0"

_EXTRA = ("pymoo", "matplotlib", "ipywidgets", "anywidget")
"""What the names below need."""
_LATER = {
    "ahp_panel": "panels",
    "choose_panel": "panels",
    "compare_fronts": "panels",
    "contour_panel": "panels",
    "cycle_time_panel": "panels",
    "edit_program": "panels",
    "explore": "panels",
    "live_pareto_panel": "panels",
    "nsga2": "search.nsga2",
    "optimise_panel": "panels",
    "pareto_panel": "panels",
    "picture": "render.figure",
    "presets": "panels",
    "shortlist": "panels",
    "study_panel": "panels",
    "to_html": "render.living",
    "tolerance_panel": "panels",
}
"""Where they live."""
_WINGS = ("papers", "views", "panels", "render", "course")
"""Wings that are loaded when they are first asked for."""


def _installed(library: str) -> bool:
    try:
        return find_spec(library) is not None
    except ImportError:
        return False


_LAB = all(map(_installed, _EXTRA))

__all__ = [
    "ArmLoad",
    "Cycloidal",
    "Decision",
    "DesignMap",
    "DoorHandleCam",
    "Dwell",
    "Friction",
    "Front",
    "GPa",
    "HighSpeedCam",
    "Judgements",
    "LAWS",
    "MPa",
    "Measure",
    "ModifiedSine",
    "MotionProgram",
    "N",
    "OscillatingFlatCam",
    "OscillatingRollerCam",
    "PeakMeasure",
    "Poly345",
    "RSSR",
    "Return",
    "Rise",
    "Session",
    "SimpleHarmonic",
    "SlideLoad",
    "Study",
    "Sweep",
    "Tolerances",
    "TranslatingFlatCam",
    "TranslatingRollerCam",
    "UniversalJointShaft",
    "ValveCam",
    "ahp",
    "cm",
    "deg",
    "door_handle_study",
    "group",
    "high_speed_study",
    "inch",
    "kN",
    "kW",
    "kg",
    "knee",
    "lbf",
    "m",
    "minimise",
    "mm",
    "most_isolated",
    "motion_from_outline",
    "polish",
    "psi",
    "quantities_of",
    "quantity",
    "quick_front",
    "rad",
    "read",
    "read_motion",
    "rpm",
    "rssr_study",
    "shaft_study",
    "to_workshop",
    "topsis",
    "um",
    "valve_study",
    "weighted_sum",
    "with_quantities",
    "write",
    "write_dxf",
    "write_table",
    *(_LATER if _LAB else ()),
]


def __getattr__(name: str) -> Any:
    if name not in (*_LATER, *_WINGS):
        raise AttributeError(f"camkit has no {name!r}")
    with extra(name):
        home = import_module(f".{_LATER.get(name, name)}", __name__)
    return getattr(home, name) if name in _LATER else home


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *(_WINGS if _LAB else _WINGS[:2])})
