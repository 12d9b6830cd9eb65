"""Searches for the best designs of a study: one protocol, `search`, with its methods and their results behind it.

What needs pymoo is loaded when it is first asked for.  ``nsga2``, ``minimise`` and ``polish`` are modules here; the
functions of these names come from ``camkit`` itself.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ..quantities.extras import extra
from .cycle_time import IntervalStep, shortest_interval
from .epsilon_constraint import dominated_shares, trade_off
from .every import compute
from .fast_front import quick_front
from .front import Front, dominated, front_of, reference_point
from .goal_seek import goal_seek
from .minimum import Active, Minimum
from .protocol import Step, search

if TYPE_CHECKING:
    from .competitive import CompetitiveAlgorithm
    from .evolution import StudyProblem
    from .toolbox_genetic import ToolboxGenetic

_PYMOO = {"CompetitiveAlgorithm": "competitive", "StudyProblem": "evolution", "ToolboxGenetic": "toolbox_genetic"}

__all__ = [
    "Active",
    "CompetitiveAlgorithm",
    "Front",
    "IntervalStep",
    "Minimum",
    "Step",
    "StudyProblem",
    "ToolboxGenetic",
    "compute",
    "dominated",
    "dominated_shares",
    "front_of",
    "goal_seek",
    "quick_front",
    "reference_point",
    "search",
    "shortest_interval",
    "trade_off",
]


def __getattr__(name: str) -> Any:
    if name not in _PYMOO:
        raise AttributeError(f"camkit.search has no {name!r}")
    with extra(name):
        return getattr(import_module(f".{_PYMOO[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
