"""Functions of one's own in a file: by module and name, and looked up where the file is read.

A file is never a reason to import a module, and of those that are there it can only name what was made to be a law: a
plain function of one argument ``u``, or one that is declared as a `UserLaw`.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from types import FunctionType
from typing import Any

from ..motion import UserLaw
from ..quantities.kinds import shown

MAIN = "__main__"


def place_of(function: object, where: str) -> str:
    """The module and the name of a function; ``ValueError`` for one that would not be found again under them."""
    module, name = getattr(function, "__module__", ""), getattr(function, "__qualname__", "")
    if not isinstance(function, FunctionType) or not name.isidentifier():
        raise ValueError(
            f"the {where} is a function of one's own without a name in its module, which no file can hold: "
            "define it by def at the top of a module or notebook"
        )
    if _found(module, name) is not function:
        raise ValueError(
            f"the {where} is the function {name}, which no file can hold: {_says(module)} has another of this name "
            "today, or its argument is not u"
        )
    return f"{module}:{name}"


def function_at(place: object) -> Callable[..., Any]:
    """The function at a place that `place_of` gave; ``ValueError`` in a sentence where it is not."""
    module, _, name = place.partition(":") if isinstance(place, str) else ("", "", "")
    if not name.isidentifier():
        raise ValueError(f"the file says {shown(place)} for a function; 'module:name' belongs there")
    if (function := _found(module, name)) is not None:
        return function
    first = "run the cell that defines it" if module == MAIN else f"import {module}"
    lacks = f"{_says(module)} has none" if module in sys.modules else "which is not imported here"
    told = f"the file has a law that is the function {shown(name)} of {_says(module)}"
    raise ValueError(f"{told}, {lacks}: {first}, then read it again")


def _says(module: str) -> str:
    return "this notebook" if module == MAIN else f"the module {shown(module)}"


def _found(module: str, name: str) -> FunctionType | None:
    """The function of that name in a module that is imported, if it was made to be a law."""
    held = vars(sys.modules[module]).get(name) if module in sys.modules else None
    declared = isinstance(held, UserLaw)
    function = held.function if isinstance(held, UserLaw) else held
    if not isinstance(function, FunctionType) or (function.__module__, function.__qualname__) != (module, name):
        return None
    return function if declared or _of_u(function) else None


def _of_u(function: FunctionType) -> bool:
    """Whether a function has one argument, ``u``, besides those that have a default."""
    asked = [p.name for p in inspect.signature(function).parameters.values() if p.default is p.empty]
    return asked == ["u"]
