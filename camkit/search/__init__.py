"""Searches for the best designs of a study: one protocol, `search`, with its methods and their results behind it.

Names are loaded when they are first asked for, so that only what needs pymoo loads it.  ``nsga2``, ``minimise`` and
``polish`` are modules here; the functions of that name come from ``camkit`` itself.
"""

from importlib import import_module
from typing import Any

_HOMES = {
    "competitive": ("CompetitiveAlgorithm",),
    "cycle_time": ("IntervalStep", "shortest_interval"),
    "epsilon_constraint": ("dominated_shares", "trade_off"),
    "evolution": ("StudyProblem",),
    "fast_front": ("quick_front",),
    "front": ("Front", "dominated", "front_of", "reference_point"),
    "minimum": ("Active", "Minimum"),
    "protocol": ("Step", "search"),
    "toolbox_genetic": ("ToolboxGenetic",),
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"camkit.search has no {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
