"""Live panels for JupyterLab: sliders on one side, pictures and numbers of the same design on the other."""

from ..quantities.extras import extra
from ..study.tolerances import general_tolerances

with extra("camkit.panels"):
    from .ahp import AhpPanel, ahp_panel
    from .choose import choose_panel
    from .contours import contour_panel
    from .cycle_time import CycleTimePanel, cycle_time_panel
    from .fronts import FrontsPanel, compare_fronts
    from .instrument import Instrument, explore
    from .live_pareto import LiveParetoPanel, live_pareto_panel
    from .optimise import OptimisePanel, optimise_panel
    from .pareto import ParetoPanel, pareto_panel
    from .presets import presets
    from .program import ProgramEditor, edit_program
    from .shortlist import shortlist
    from .study import StudyPanel, study_panel
    from .tables import TablePanel, table_panel
    from .tolerances import TolerancePanel, tolerance_panel

__all__ = [
    "AhpPanel",
    "CycleTimePanel",
    "FrontsPanel",
    "Instrument",
    "LiveParetoPanel",
    "OptimisePanel",
    "ParetoPanel",
    "ProgramEditor",
    "StudyPanel",
    "TablePanel",
    "TolerancePanel",
    "ahp_panel",
    "choose_panel",
    "compare_fronts",
    "contour_panel",
    "cycle_time_panel",
    "edit_program",
    "explore",
    "general_tolerances",
    "live_pareto_panel",
    "optimise_panel",
    "pareto_panel",
    "presets",
    "shortlist",
    "study_panel",
    "table_panel",
    "tolerance_panel",
]
