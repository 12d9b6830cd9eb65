"""Live panels for JupyterLab: sliders on one side, pictures and numbers of the same design on the other."""

from .cycle import CycleTime, shorten
from .decide import decide
from .explore import Explorer, explore
from .judge import Judgements, judge
from .live_front import LiveFrontPanel, live_front
from .minimum import Improvement, improve
from .offer import offer
from .program import ProgramEditor, edit_program
from .search import Search, search
from .survey import survey
from .tolerance import Tolerated, tolerate
from .trade import Trade, trade
from .tray import tray
from .trial import try_everything

__all__ = [
    "CycleTime",
    "Explorer",
    "Improvement",
    "Judgements",
    "LiveFrontPanel",
    "ProgramEditor",
    "Search",
    "Tolerated",
    "Trade",
    "decide",
    "edit_program",
    "explore",
    "improve",
    "judge",
    "live_front",
    "offer",
    "search",
    "shorten",
    "survey",
    "tolerate",
    "trade",
    "tray",
    "try_everything",
]
