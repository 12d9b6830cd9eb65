"""What kind of thing a value is: a number or a column of numbers, and what a field's annotation asks for.

Every frozen dataclass that a user makes checks its fields here, so that a wrong kind is refused in a sentence when it
is given, and not by an error of Python when it is used.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import types
import typing
from collections.abc import Callable, Container, Mapping, Sequence, Sized
from functools import cache
from typing import Any, Generic, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .known import certain, floats, known, unless
from .types import Value

LONGEST = 60
"""A value whose text is longer is named by its type."""
DEEPEST = 8
"""No table of numbers has more dimensions."""


def number(value: Any) -> Value | None:
    """``value`` as a float, or as an array of floats of shape ``(p, 1)``; ``None`` for anything else.

    >>> number(5), number(np.array([[1], [2]])).tolist(), number(True), number([1.0]), number(np.ones(3))
    (5.0, [[1.0], [2.0]], None, None, None)
    """
    if type(value) is float or not known(value):
        return value
    if isinstance(value, np.ndarray):
        real, fits = plain(value) and value.dtype.kind in "iuf", value.shape == () or value.shape[1:] == (1,)
        return value.astype(float, copy=False)[()] if real and fits else None
    if isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            return np.copysign(np.inf, 1 if value > 0 else -1)
    return None


def plain(array: np.ndarray) -> bool:
    """Whether an array is an array and nothing more: the masked ones and matrices of numpy reckon in their own way."""
    return not isinstance(array, (np.ma.MaskedArray, np.matrix))


def finite(value: object) -> Any:
    """Whether ``value`` is a finite number, element by element of a column; ``False`` for what is no number.

    >>> finite(1.5), finite("1.5"), finite(np.array([[1.0], [np.nan]])).tolist()
    (np.True_, False, [[True], [False]])
    """
    read = number(value)
    return False if read is None else np.isfinite(read)


def a_number(
    value: object, what: str, must: str = "be a finite number", holds: Callable[[Value], Value] | None = None
) -> Value:
    """``value`` as a float or a column; ``ValueError`` if it is none, or one number for which ``holds`` does not hold.

    Members of a column that are not finite, or for which it does not, become ``nan``.

    >>> a_number(-1, "the speed", "be at least 0", lambda speed: speed >= 0)
    Traceback (most recent call last):
        ...
    ValueError: the speed is -1; it must be at least 0
    """
    read = number(value)
    if read is None:
        raise ValueError(f"{what} is {shown(value)}; it must {must}")
    ok = np.isfinite(read) & (True if holds is None else holds(read))
    if certain(ok):
        return read
    if refuse := unless(ok):
        refuse(f"{what} is {shown(value)}; it must {must}")
    return np.where(ok, read, np.nan)


def one_number(
    value: object, what: str, must: str = "be a finite number", holds: Callable[[float], bool] | None = None
) -> float:
    """``value`` as a float, finite or not; ``ValueError`` for what is no single number or not as ``holds`` asks."""
    read: Any = number(value)
    if read is None or np.ndim(read) or (holds and not holds(float(read))):
        raise ValueError(f"{what} is {shown(value)}; it must {must}")
    return float(read) if known(read) else read


def numbers(value: object, what: str) -> np.ndarray:
    """``value`` as an array of floats of any shape; ``ValueError`` for what holds anything but real numbers.

    Of what is nested more than `DEEPEST` times too: numpy's functions take no more dimensions than 32.
    """
    if isinstance(value, float) or not known(value):
        return floats(value)
    try:
        array = np.asanyarray(value)
        if not plain(array) or array.ndim > DEEPEST or (array.dtype.kind not in "iuf" and array.size):
            raise TypeError
        return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{what} must be numbers; given is {shown(value)}") from None


def whole(value: object, what: str, least: int, most: int = 1_000_000) -> int:
    """``value`` if it is a whole number from ``least`` to ``most``; a ``ValueError`` in a sentence otherwise."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise ValueError(f"{what} is {shown(value)}; it must be a whole number of at least {least}")
    if value > most:
        raise ValueError(f"{what} is {shown(value)}; it must be a whole number of at most {most}")
    return int(value)


def listed(value: object, what: str, each: str = "number") -> tuple[Any, ...]:
    """``value`` as a tuple; ``ValueError`` for what is no tuple, list or array."""
    if isinstance(value, (tuple, list)) or (isinstance(value, np.ndarray) and value.ndim):
        return tuple(value)
    raise ValueError(f"{what} is {shown(value)}; it must be a tuple, with a place for each {each}")


ARRAYS = {
    "c": " of complex numbers",
    "b": " of truths",
    "U": " of text",
    "S": " of text",
    "M": " of dates",
    "O": " of mixed things",
}
"""What an array holds, by the letter of its type; numbers need no word."""


def shown(value: object) -> str:
    """``value`` as a sentence can hold it.

    >>> shown("22"), shown([]), shown(np.ones(3)), shown(dict.fromkeys(range(99)))
    ("'22'", 'an empty list', 'an array of shape (3,)', 'a dict')
    >>> shown("x" * 1000)
    "'xxxxxxxxxxxxxxxxxxxxxxxxxxx...xxxxxxxxxxxxxxxxxxxxxxxxxxx'"
    """
    if isinstance(value, str) and len(value) + 2 > LONGEST:
        value = f"{value[:27]}...{value[-27:]}"
    if not known(value) and getattr(value, "shape", None) == ():
        return format(value, ".6g")
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, np.ndarray) and not plain(value):
        return "a matrix" if isinstance(value, np.matrix) else "a masked array"
    if type(value) is float:
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return f"an array{ARRAYS.get(value.dtype.kind, '')} of shape {value.shape}"
    if isinstance(value, (tuple, list, set, dict)) and not value:
        return f"an empty {type(value).__name__}"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits, or a list of thousands of lists
        text = " at 0x"
    if len(text) <= LONGEST and "\n" not in text and " at 0x" not in text and "array(" not in text:
        return text
    if isinstance(value, int):
        return "a very large number"
    return f"{_article(type(value).__name__)} {type(value).__name__}" if type(value) is not object else "something else"


def _article(name: str) -> str:
    """What stands before a name: "a universal joint", "an oscillating cam"; "an RSSR", which is spelt."""
    vowels = "AEFHILMNORSX" if name.isupper() else "AEIOU"
    return "an" if name[0].upper() in vowels and name[:3].lower() != "uni" else "a"


def kind_words(kind: type, article: bool = False) -> str:
    """The name of a class as a person says it.

    >>> class RockerLoad: ...
    >>> class RSSR: ...
    >>> kind_words(RockerLoad, article=True), kind_words(RSSR, article=True)
    ('a rocker load', 'an RSSR')
    """
    name = kind.__name__
    said = name if name.isupper() else re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()
    return f"{_article(said)} {said}" if article else said


class Kind(NamedTuple):
    """What an annotation asks for: a test of a value, and how a sentence says it."""

    holds: Callable[[Any], bool]
    said: str


def refuse_kinds(thing: object, but: Container[str] = ()) -> None:
    """``ValueError`` in a sentence for a field of the dataclass ``thing`` that is not of its annotation's kind.

    The fields in ``but`` are left out, and those annotated ``Any``.
    """
    for name, kind in _kinds(type(thing)):  # type: ignore[arg-type]
        value = getattr(thing, name)
        if name not in but and not kind.holds(value):
            raise ValueError(f"the {name.replace('_', ' ')} is {shown(value)}; it must be {kind.said}")


def refuse_fields(thing: Any, changes: Mapping[str, object]) -> None:
    """``ValueError`` in a sentence for a change of a field that the dataclass ``thing`` does not have."""
    names = [f.name for f in dataclasses.fields(thing)]
    if unknown := sorted(changes.keys() - set(names)):
        raise ValueError(f"{type(thing).__name__} has no {', '.join(unknown)}; it has {', '.join(names)}")


def refuse_arguments(function: Callable[..., object], given: Mapping[str, object]) -> None:
    """``ValueError`` in a sentence for an argument of ``function`` that is not of its annotation's kind.

    ``given`` are its ``locals()`` at its door; what is annotated ``Any`` is the function's own business.

    >>> def turned(angle: float, times: int = 1) -> float:
    ...     refuse_arguments(turned, locals())
    ...     return times * angle
    >>> turned(0.5, "twice")
    Traceback (most recent call last):
        ...
    ValueError: the argument times is 'twice'; it must be a whole number
    """
    for parameter, kind in _argument_kinds(function):
        for name, value in _each(parameter, given[parameter.name]):
            if not kind.holds(value):
                raise ValueError(f"{name} is {shown(value)}; it must be {kind.said}")


def _each(parameter: inspect.Parameter, value: Any) -> list[tuple[str, object]]:
    """What is given for a parameter, with its name; several if it gathers arguments."""
    if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
        return [(f"one of the {parameter.name}", each) for each in value]
    if parameter.kind is inspect.Parameter.VAR_KEYWORD:
        return [(f"the argument {name}", each) for name, each in value.items()]
    return [(f"the argument {parameter.name}", value)]


@cache
def _argument_kinds(function: Callable[..., object]) -> tuple[tuple[inspect.Parameter, Kind], ...]:
    """The arguments of a function that can be checked."""
    hints = typing.get_type_hints(function)
    parameters = inspect.signature(function).parameters.values()
    kinds = ((p, _kind(hints[p.name])) for p in parameters if p.name in hints)
    return tuple((parameter, kind) for parameter, kind in kinds if kind is not None)


def refuse_empty(given: Sized, what: str) -> None:
    """``ValueError`` in a sentence if there is nothing in ``given``."""
    if not len(given):
        raise ValueError(f"there are no {what}; name one or more")


def refuse_shapes(arrays: Mapping[str, np.ndarray]) -> None:
    """``ValueError`` in a sentence if arrays, by what they are, have shapes that numpy cannot bring together."""
    try:
        np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        told = " and ".join(f"{what} of the shape {array.shape}" for what, array in arrays.items())
        raise ValueError(f"there are {told}; each must fit the others, or be one number") from None


def refuse_lengths(thing: Any) -> None:
    """``ValueError`` in a sentence if columns in the dataclass ``thing``, or in what it holds, differ in length.

    A column of one member goes with any other.
    """
    refuse_unequal({f.name: getattr(thing, f.name) for f in dataclasses.fields(thing)}, type(thing).__name__)


def refuse_unequal(held: Mapping[str, object], what: str) -> None:
    """The same for what ``what`` holds by name."""
    found = ((name, _lengths_of(value, name)) for name, value in held.items())
    several = [(name, length) for name, lengths in found for length in lengths if length != 1]
    if len({length for _, length in several}) > 1:
        told = " and ".join(f"{length} in its {name.replace('_', ' ')}" for name, length in several)
        raise ValueError(f"the {what} has columns of {told}; they must be equally long")


def _lengths_of(value: object, name: str) -> set[int]:
    try:
        return _lengths(value)
    except RecursionError:
        raise ValueError(f"the {name.replace('_', ' ')} holds itself, or lists within lists without end") from None


def columns(thing: object) -> bool:
    """Whether a number of ``thing``, or of what it holds, is a column: it is a population.

    >>> columns((1.0, np.array([[2.0], [3.0]]))), columns((1.0, 2.0))
    (True, False)
    """
    return bool(_lengths(thing))


def _lengths(value: Any) -> set[int]:
    """How many members the columns within ``value`` have."""
    if type(value) is float:
        return set()
    if isinstance(value, np.ndarray) or not known(value):
        return {len(value)} if value.ndim == 2 else set()
    if isinstance(value, (tuple, list)):
        return set() if {*map(type, value)} == {float} else set().union(*map(_lengths, value))
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return set().union(*(_lengths(getattr(value, f.name)) for f in dataclasses.fields(value)))
    return set()


@cache
def _kinds(cls: type) -> tuple[tuple[str, Kind], ...]:
    """The fields of a dataclass that can be checked."""
    hints = typing.get_type_hints(cls)
    kinds = ((f.name, _kind(hints[f.name])) for f in dataclasses.fields(cls))
    return tuple((name, kind) for name, kind in kinds if kind is not None)


def _one(value: object) -> bool:
    read = number(value)
    return read is not None and np.ndim(read) == 0 and (not known(read) or bool(np.isfinite(read)))


SIMPLE: dict[object, Kind] = {
    float: Kind(_one, "a finite number"),
    int: Kind(lambda v: isinstance(v, (int, np.integer)) and not isinstance(v, bool), "a whole number"),
    bool: Kind(lambda v: isinstance(v, (bool, np.bool_)), "True or False"),
    str: Kind(lambda v: isinstance(v, str), "a text"),
    types.NoneType: Kind(lambda v: v is None, "None"),
    np.ndarray: Kind(lambda v: isinstance(v, np.ndarray), "an array"),
}


def _kind(hint: Any) -> Kind | None:
    """What an annotation asks for; ``None`` where anything will do."""
    if hint in (Any, object):
        return None
    if hint in SIMPLE:
        return SIMPLE[hint]
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if any(set() < {*typing.get_args(wide)} <= {*parts} for wide in (Value, ArrayLike)):
            return None  # who takes a number or a column says itself what is wrong with it
        kinds = [_kind(part) for part in parts]
        sure = [kind for kind in kinds if kind is not None]
        if len(sure) < len(kinds):
            return None
        return Kind(lambda v: any(k.holds(v) for k in sure), " or ".join(k.said for k in sure))
    if origin is Callable:
        return Kind(lambda v: callable(v) and not isinstance(v, type), "a function")
    if origin is tuple and parts[-1] is not ... and float not in parts:
        return _places([_kind(part) for part in parts])
    if origin is tuple:
        return _sequence(_kind(parts[0]) if isinstance(parts[0], type) and parts[0] is not float else None)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return _mapping(_kind(parts[0]), _kind(parts[1]) if parts[1] is not float else None)
    if origin is Sequence:
        return _sequence(_kind(parts[0]) if parts[0] is not float else None)
    if getattr(hint, "_is_protocol", False):
        said = str(inspect.getdoc(hint)).partition("\n")[0].rstrip(".")
        return Kind(lambda v: isinstance(v, hint) and not isinstance(v, type), said[0].lower() + said[1:])
    if isinstance(origin, type) and issubclass(origin, Generic):
        return _kind(origin)
    if isinstance(hint, type):
        return Kind(lambda v: isinstance(v, hint), f"{_article(hint.__name__)} {hint.__name__}")
    return None


def _places(kinds: Sequence[Kind | None]) -> Kind:
    def holds(value: Any) -> bool:
        fits = isinstance(value, (tuple, list)) and len(value) == len(kinds)
        return fits and all(kind is None or kind.holds(v) for kind, v in zip(kinds, value, strict=True))

    return Kind(holds, f"a tuple of {', '.join('something' if k is None else k.said for k in kinds)}")


def _sequence(kind: Kind | None) -> Kind:
    def holds(value: Any) -> bool:
        several = isinstance(value, (tuple, list)) or (isinstance(value, np.ndarray) and value.ndim > 0)
        return several and (kind is None or all(kind.holds(v) for v in value))

    return Kind(holds, "a tuple" if kind is None else f"a tuple of which each is {kind.said}")


def _mapping(names: Kind | None, values: Kind | None) -> Kind:
    def holds(value: Any) -> bool:
        if not isinstance(value, Mapping):
            return False
        each = ((names, value), (values, value.values()))
        return all(kind is None or all(map(kind.holds, held)) for kind, held in each)

    told = (f", each {what} {kind.said}" for what, kind in (("name", names), ("value", values)) if kind)
    return Kind(holds, "a mapping such as {name: value}" + "".join(told))
