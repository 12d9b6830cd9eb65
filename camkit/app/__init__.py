"""Live panels for JupyterLab: sliders on one side, pictures and numbers of the same design on the other."""

from .explore import Explorer, explore
from .judge import Judgements, judge
from .offer import offer
from .program import ProgramEditor, edit_program
from .search import Search, search
from .trial import try_everything

__all__ = [
    "Explorer",
    "Judgements",
    "ProgramEditor",
    "Search",
    "edit_program",
    "explore",
    "judge",
    "offer",
    "search",
    "try_everything",
]
