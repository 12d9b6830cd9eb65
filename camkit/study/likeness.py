"""What two things have in common, by value, so that native code made for one serves the other and no third.

Functions of a user read more than what they are given: variables of a notebook, attributes, arrays.  When one of these
changes, what the function says does too, though it is the same function.
"""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Hashable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property, partial
from types import CodeType, FunctionType, MethodType, ModuleType

import numpy as np

from ..quantities import Quantity

LIBRARIES = {"camkit", "numpy", "scipy", *sys.stdlib_module_names} - {"__main__"}
"""They say the same as long as the process runs; but their functions may hold a user's."""
PLAIN = (int, float, complex, str, bytes, type(None))
CONTAINERS = (tuple, list, dict, set, frozenset)
WRAPPERS = (MethodType, partial, property, cached_property, staticmethod, classmethod)
MOST = 2000
"""After so many things nobody looks further."""


def likeness(thing: object) -> Hashable:
    """What two things have in common that differ in declared numbers alone."""
    if isinstance(thing, (tuple, list)):
        return (type(thing), *map(likeness, thing))
    if isinstance(thing, Mapping):
        return (type(thing), *((key, likeness(value)) for key, value in thing.items()))
    if isinstance(thing, np.ndarray):
        return thing.shape, thing.dtype.str, thing.tobytes()
    if not dataclasses.is_dataclass(thing) or isinstance(thing, type):
        return type(thing), thing
    return (type(thing), *(_likeness_of(f, getattr(thing, f.name)) for f in dataclasses.fields(thing)))


def _likeness_of(f: dataclasses.Field[object], value: object) -> Hashable:
    """The same of a field: of declared numbers whether they are there."""
    if isinstance(f.metadata.get("declared"), Quantity):
        return value is None
    if "row" in f.metadata and isinstance(value, (tuple, list)):
        return tuple(each is None for each in value)
    return likeness(value)


def read_by(design: object, *functions: object) -> tuple[Hashable, ...]:
    """What the functions of a user, and the classes in a design, read besides what they are given.

    Nothing where all are those of libraries; ``TypeError`` for more than anybody can look through.

    >>> factor = [2.0]
    >>> double = lambda x: factor[0] * x
    >>> double.__module__ = "__main__"  # as in a notebook
    >>> before = read_by(None, double)
    >>> factor[0] = 3.0
    >>> read_by(None, double) == before
    False
    """
    found, seen, left = list[Hashable](), dict[int, object](), [*functions, *_behind(design)]
    while left:
        thing = left.pop()
        if isinstance(thing, PLAIN):
            found.append((type(thing), repr(thing)))
        elif isinstance(thing, np.ndarray):
            if type(thing) is not np.ndarray or thing.dtype.hasobject:
                raise TypeError("an array that holds more than its numbers is read")
            found.append((thing.shape, thing.dtype.str, thing.tobytes()))
        elif id(thing) not in seen:
            seen[id(thing)] = thing
            found.append(_own(thing))
            left += _inside(thing)
        if len(found) > MOST:
            raise TypeError("too much is read")
    users = any(isinstance(thing, FunctionType | type) and foreign(thing) for thing in seen.values())
    return tuple(found) if users else ()


def _behind(design: object) -> Iterator[object]:
    """The classes of a design and its parts, and what else is in them, declared numbers apart."""
    if not dataclasses.is_dataclass(design) or isinstance(design, type):
        for each in design if isinstance(design, (tuple, list)) else ():
            yield from _behind(each)
        yield from () if isinstance(design, (tuple, list)) else (design,)
        return
    yield type(design)
    for f in dataclasses.fields(design):
        if not (isinstance(f.metadata.get("declared"), Quantity) or "row" in f.metadata):
            yield from _behind(getattr(design, f.name))


def foreign(thing: FunctionType | type) -> bool:
    """Whether it is a user's."""
    return str(thing.__module__).partition(".")[0] not in LIBRARIES


def _own(thing: object) -> Hashable:
    """What tells a thing from another, but for what is inside."""
    if isinstance(thing, FunctionType):
        return thing.__code__
    if isinstance(thing, type):
        return "class", thing
    inside = hasattr(thing, "__dict__") or isinstance(thing, CONTAINERS)
    return type(thing), 0 if inside else id(thing)


def _inside(thing: object) -> Iterator[object]:
    """What a thing reads or holds."""
    if isinstance(thing, FunctionType):
        yield from (thing.__defaults__, thing.__kwdefaults__, *_cells(thing))
        if foreign(thing):
            yield from _globals(thing.__code__, vars(sys.modules["builtins"]) | thing.__globals__)
    elif isinstance(thing, type):
        if foreign(thing):
            yield from thing.__bases__
            yield from (value for name, value in vars(thing).items() if name[:2] != "__" or callable(value))
    elif isinstance(thing, Mapping):
        yield from (*thing.keys(), *thing.values())
    elif isinstance(thing, CONTAINERS):
        yield from sorted(thing, key=repr) if isinstance(thing, (set, frozenset)) else thing
    elif isinstance(thing, np.ndarray):
        yield from thing.ravel().tolist()
    elif dataclasses.is_dataclass(thing):
        yield type(thing)
        yield from (getattr(thing, f.name) for f in dataclasses.fields(thing))
    elif not isinstance(thing, ModuleType):
        yield from _of_object(thing)


def _of_object(thing: object) -> Iterator[object]:
    """The same of what is neither a function nor a class nor declared."""
    for name in ("__func__", "__self__", "func", "args", "keywords", "fget", "__wrapped__"):
        yield from (getattr(thing, name),) if isinstance(thing, WRAPPERS) and hasattr(thing, name) else ()
    if foreign(type(thing)):
        yield type(thing)
        yield from vars(thing).values() if hasattr(thing, "__dict__") else ()


def _cells(function: FunctionType) -> Iterator[object]:
    """The variables of functions around it, as far as they are there."""
    for cell in function.__closure__ or ():
        with suppress(ValueError):
            yield cell.cell_contents


def _globals(code: CodeType, there: Mapping[str, object]) -> Iterator[object]:
    """What a function's text names: variables, and those of a user's modules."""
    found = [there[name] for name in code.co_names if name in there]
    yield from found
    for module in found:
        if isinstance(module, ModuleType) and module.__name__.partition(".")[0] not in LIBRARIES:
            yield from (vars(module)[name] for name in code.co_names if name in vars(module))
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _globals(inner, there)
