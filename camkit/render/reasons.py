"""Why a measure is what it is: what the code says of it and of what it takes from an analysis, word for word."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from dataclasses import is_dataclass
from operator import attrgetter
from types import CodeType, FunctionType
from typing import Any

from ..data import load
from ..extrema import Extreme
from ..quantities import Measure

MOST = 3
"""So many formulas at most: those that the measure is made of first."""
SOURCE = re.compile(r"(?:Sources?:\s*|(?=Formulas after|Formulas of))([^\n]+(?:\n(?!\n)[^\n]*)*)")
"""The paragraph of a module that names what its formulas are from."""
Named = tuple[str, object]
"""What a function names: a "word", or another "function" or "measure" that it calls."""


def reason_of(measure: Measure, analysis: object) -> dict[str, object]:
    """What is said of a measure: its ``formula``, its ``source``, and the ``test`` of the package that holds it.

    The formula is what the code says of the measure, or of what it takes from the analysis; the source what their
    modules name as theirs, or those of the analysis.  What nobody says is empty.

    >>> from camkit import TranslatingRollerCam
    >>> from camkit.cam import peak_force
    >>> for words in reason_of(peak_force, TranslatingRollerCam().analyse()).values():
    ...     print(str(words)[:70])
    ["Force between cam and follower without friction, N; < 0 where only a
    Norton, Cam Design and Manufacturing Handbook (cam size determination)
    tests/cam/test_followers.py::test_power_in_is_power_out_without_fricti
    """
    named = [*dict.fromkeys(_named(measure, set()))]
    parts = _parts(analysis, [str(word) for kind, word in named if kind == "word"])
    own = [thing for kind, thing in named if kind == "function"]
    taken = [member for kind, word in named if kind == "word" for part in parts if (member := _member(part, str(word)))]
    said = dict.fromkeys(words for thing in (*own, *taken) if (words := _says(thing)))
    homes = dict.fromkeys((*map(_home, taken), *(home for part in reversed(parts) for home in _homes(part))))
    held = (_test(thing) for _, thing in named if isinstance(thing, Measure))
    return {
        "formula": [*said][:MOST],
        "source": next(filter(None, map(_source, homes)), ""),
        "test": next(filter(None, held), ""),
    }


def _named(thing: object, seen: set[int]) -> Iterator[Named]:
    """What a measure or a function names in its code, and what those name that it calls."""
    if id(thing) in seen:
        return
    seen.add(id(thing))
    if isinstance(thing, Measure):
        yield "measure", thing
        yield from _named(thing.function, seen)
    elif isinstance(thing, FunctionType):
        maker = thing.__globals__.get(thing.__qualname__.partition(".<locals>")[0])
        if isinstance(maker, FunctionType) and (maker is thing or maker.__name__.startswith("_")):
            yield "function", maker
        yield from _in_code(thing.__code__, thing.__globals__, seen)
        for cell in thing.__closure__ or ():
            yield from _inside(cell.cell_contents, seen)


def _inside(held: object, seen: set[int]) -> Iterator[Named]:
    """What a function was made with."""
    for one in held if isinstance(held, (tuple, list)) else (held,):
        if isinstance(one, str):
            yield "word", one
        if isinstance(one, attrgetter):
            yield from (("word", word) for word in one.__reduce__()[1])
        yield from _named(one, seen)


def _in_code(code: CodeType, known: dict[str, Any], seen: set[int]) -> Iterator[Named]:
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _in_code(constant, known, seen)
        elif isinstance(constant, str) and constant.isidentifier():
            yield "word", constant
    for name in code.co_names:
        if isinstance(called := known.get(name), (FunctionType, Measure)) and name.startswith("_"):
            yield from _named(called, seen)
        else:
            yield "word", name


def _parts(analysis: object, words: list[str]) -> list[object]:
    """The analysis, and what it holds by these words: the analyses of its curves, a chain."""
    parts = [analysis]
    for word in words:
        if _property(type(analysis), word) is not None and _whole(held := getattr(analysis, word, None)):
            parts.append(held)
    return parts


def _property(kind: type, word: str) -> object:
    return inspect.getattr_static(kind, word, None)


def _member(part: object, word: str) -> object:
    """The function that computes a part's property of this name, if that says what it is."""
    member = _property(type(part), word)
    function = getattr(member, "fget", None) or getattr(member, "func", None)
    says = _says(function) if function else ""
    return function if says and not says.startswith("Whether") and not _whole(getattr(part, word, None)) else None


def _whole(thing: object) -> bool:
    """Whether it is a thing of several numbers: an analysis, a resolution."""
    return is_dataclass(thing) and not isinstance(thing, (type, Extreme))


def _says(thing: object) -> str:
    """The first paragraph of a docstring."""
    return " ".join((inspect.getdoc(thing) or "").partition("\n\n")[0].split())


def _home(thing: object) -> str:
    return str(getattr(thing, "__module__", ""))


def _homes(part: object) -> list[str]:
    """The modules of an analysis, and of the designs that it holds."""
    held = [type(one) for one in vars(part).values() if is_dataclass(one)]
    return [kind.__module__ for kind in (*held, *type(part).__mro__)]


def _source(module: str) -> str:
    found = SOURCE.search(inspect.getdoc(sys.modules.get(module)) or "") if module else None
    return " ".join(found[1].split()) if found else ""


def _test(measure: Measure) -> str:
    """Which test of the package holds a measure of its own."""
    wings: dict[str, dict[str, str]] = load("measures_held")
    wing = str(getattr(measure.function, "__module__", "")).removeprefix("camkit.").partition(".")[0]
    return wings.get(wing, {}).get(measure.name, "")
