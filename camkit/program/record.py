"""Plain numpy code is run once on arrays that note what is done to them (numpy's protocols NEP 13 and NEP 18)."""

from __future__ import annotations

import gc
import operator
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike, DTypeLike

from ..quantities.known import known
from .operations import ALONG, EACH, FOLDS, MOVES, OF_NO_WHOLE, operands
from .texts import SPEC, Template, Texts
from .written import BY, whole

HERE, ROOT = Path(__file__).parent, Path(__file__).parents[2]


class CannotRecord(ValueError):
    """Plain numpy code asks for something that is not known before the program runs; the sentence says where."""


def cannot(what: str) -> CannotRecord:
    """``what`` cannot be recorded, at the line that asked for it: the last outside of this wing, numpy, scipy."""
    frame = sys._getframe(1)
    while frame.f_back and _of_the_machinery(frame.f_code.co_filename):
        frame = frame.f_back
    file = Path(frame.f_code.co_filename)
    told = file.relative_to(ROOT) if file.is_relative_to(ROOT) else file.name
    return CannotRecord(f"{told}, line {frame.f_lineno}: {what}")


def _of_the_machinery(file: str) -> bool:
    return (
        Path(file).is_relative_to(HERE) or file.startswith("<") or not {"numpy", "scipy"}.isdisjoint(Path(file).parts)
    )


@contextmanager
def uncollected() -> Iterator[None]:
    """What is made meanwhile stays: to search it for garbage, again and again, takes as long as to make it."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


def mapped(f: Callable[[object], object], value: Any) -> Any:
    """``f`` of every argument in nested tuples and lists."""
    if not isinstance(value, (tuple, list)):
        return f(value)
    each = [mapped(f, x) if isinstance(x, (tuple, list)) else f(x) for x in value]
    return each if isinstance(value, list) else tuple(each)


class Recording:
    """The calls that have been made so far, in order, and what they give; one that is made again is the same."""

    def __init__(self) -> None:
        self.calls: list[Recorded] = []
        self.values: list[np.ndarray] = []
        self.texts = Texts()
        self.refusals: dict[int, Template] = {}
        self._known: dict[object, Recorded] = {}

    def input(self, value: ArrayLike) -> Recorded:
        """An input, for which ``value`` stands while the program is recorded."""
        return Recorded(self, lambda: np.asarray(value, dtype=float)[()], (), {})

    def call(self, function: Callable[..., Any], *arguments: object, **named: object) -> Any:
        """The result of a function of numpy."""
        if function in BY:
            return _written(function, arguments, named)
        _check(function, arguments, named)
        key = (function, *map(key_of, arguments), repr(named))
        if key not in self._known:
            self._known[key] = Recorded(self, function, arguments, named)
        return self._known[key]

    def close(self) -> None:
        """Forget what only more calls would need."""
        self.values.clear()
        self._known.clear()


def _check(function: Callable[..., Any], arguments: tuple[Any, ...], named: dict[str, object]) -> None:
    """Raise `CannotRecord` unless it is known what the function is elsewhere."""
    if function in EACH:
        if named or len(arguments) != operands(EACH[function]):
            raise cannot(f"{name_of(function)} cannot be recorded with these arguments")
        if function in OF_NO_WHOLE and arguments[0].dtype.kind in "iu":
            raise cannot(f"{name_of(function)} of whole numbers cannot be recorded")
    elif function in FOLDS or function in ALONG:
        if named.keys() - {"axis", "keepdims"}:
            raise cannot(f"{name_of(function)} can be recorded with axis and keepdims alone")
    elif function not in MOVES:
        raise cannot(f"{name_of(function)} cannot be recorded; it is not in the table of operations")


def name_of(function: object) -> str:
    """What a function of numpy is called."""
    owner = getattr(function, "__self__", None)
    return f"{owner.__name__ + '.' if isinstance(owner, np.ufunc) else ''}{getattr(function, '__name__', function)}"


def _written(function: Any, arguments: tuple[object, ...], named: dict[str, object]) -> object:
    try:
        return BY[function](*arguments, **named)
    except TypeError as unfit:
        raise cannot(f"{name_of(function)} cannot be recorded with these arguments: {unfit}") from None


def key_of(argument: object) -> object:
    """What tells one argument from another."""
    if isinstance(argument, Recorded):
        return argument.number
    if isinstance(argument, (tuple, list)):
        return (type(argument), *map(key_of, argument))
    if isinstance(argument, np.ndarray):
        return argument.shape, argument.dtype.str, argument.tobytes()
    return repr(argument)


class Recorded(NDArrayOperatorsMixin):
    """An array of a recording: numpy computes with it as with any other, what is in it is known when it runs.

    It is what ``function`` gives of ``arguments``, of which some may be recorded too.
    """

    __slots__ = ("arguments", "dtype", "function", "named", "ndim", "number", "recording", "shape", "size")
    recorded = True
    """By which physics can tell it from a known value (see `camkit.quantities.known`)."""

    def __init__(
        self, recording: Recording, function: Callable[..., Any], arguments: tuple[object, ...], named: dict[str, Any]
    ) -> None:
        self.recording, self.function, self.arguments, self.named = recording, function, arguments, named
        value = self.result(recording.values)
        if value.dtype.kind not in "fbiu":
            raise cannot("complex numbers and texts cannot be recorded")
        self.shape, self.dtype, self.ndim, self.size = value.shape, value.dtype, value.ndim, value.size
        self.number = len(recording.calls)
        recording.calls.append(self)
        recording.values.append(value)

    def result(self, results: Sequence[np.ndarray] | Mapping[int, np.ndarray]) -> np.ndarray:
        """What it is, by the results of the calls before it."""
        given = mapped(lambda x: results[x.number] if isinstance(x, Recorded) else x, self.arguments)
        return self.function(*given, **self.named)

    @property
    def T(self) -> np.ndarray:
        """Transposed."""
        return np.transpose(self)

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise cannot("a truth value, a number, a text or a plain array of a recorded value is asked for")

    __bool__ = __float__ = __int__ = __index__ = __complex__ = __array__ = __str__ = __round__ = _refuse

    def __getattr__(self, name: str) -> NoReturn:
        if name.startswith("_"):  # numpy asks for protocols that it may have
            raise AttributeError(name)
        raise cannot(f"the {name} of a recorded value is asked for")

    def __format__(self, spec: str) -> str:
        if self.ndim or not spec:
            raise cannot("a text of several numbers, or of one without a format, is asked for")
        if not SPEC.fullmatch(spec):
            raise cannot(f"a number is written as '{spec}'; as '.4g', '.1f', '+.1f' or '.0%' it can be recorded")
        return self.recording.texts.placed((self.number, spec))

    def text_if(self, words: str) -> str:
        """A part of a text that is there where this holds."""
        if self.ndim:
            raise cannot("a text is asked for where several values hold")
        return self.recording.texts.placed((self.number, self.recording.texts.parted(words)))

    def refuse(self, why: str) -> NoReturn:
        """Physics cannot do without what is not known yet: ``why``, and what is possible."""
        raise cannot(why)

    def refusing(self) -> Callable[[str], None] | None:
        """What notes the sentence for a design for which this does not hold; members of a population have none."""
        return None if self.ndim or self.number in self.recording.refusals else self._note

    def _note(self, sentence: str) -> None:
        self.recording.refusals[self.number] = self.recording.texts.parted(sentence)

    def __setitem__(self, at: object, value: object) -> None:
        raise cannot("a recorded array is written into")

    def __hash__(self) -> int:
        return id(self)

    def __len__(self) -> int:
        return len(self.recording.values[self.number])

    def __iter__(self) -> Iterator[Any]:
        return (self[k] for k in range(len(self)))

    def __pow__(self, exponent: object) -> np.ndarray:
        return self.recording.call(operator.pow, self, exponent)

    def __getitem__(self, at: Any) -> Any:
        within = at if isinstance(at, tuple) else (at,)
        if all(map(known, within)):
            return self if isinstance(at, tuple) and not at else self.recording.call(operator.getitem, self, at)
        *before, places = within
        if known(places) or places.dtype.kind not in "iu" or len(before) > 1:
            raise cannot("an array is indexed by computed values; only its last axis can be, by whole numbers")
        if not before or before[0] is Ellipsis:
            return np.take(self, places, axis=-1 if before else 0)
        if self.ndim != 2 or not np.array_equal(before[0], np.arange(len(self))[:, None]):
            raise cannot("an array is indexed by computed places, not one row after the other")
        return np.take_along_axis(self, places, axis=-1)

    def __array_ufunc__(
        self, ufunc: np.ufunc, method: str, *inputs: object, out: object = None, **named: object
    ) -> Any:
        if out is not None:
            raise cannot("a computed value is written into an array")
        return self.recording.call(ufunc if method == "__call__" else getattr(ufunc, method), *inputs, **named)

    def __array_function__(
        self, function: Callable[..., Any], types: object, arguments: Any, named: dict[str, object]
    ) -> Any:
        if function in (np.shape, np.ndim, np.size):
            return function(self.recording.values[self.number], *arguments[1:], **named)
        return self.recording.call(function, *arguments, **named)

    def astype(self, dtype: DTypeLike, copy: bool = True) -> Any:
        """As whole numbers, as truths, or as they are."""
        kind = np.dtype(dtype).kind
        return self.recording.call(whole, self) if kind == "i" else self != 0 if kind == "b" else self + 0.0

    def reshape(self, *shape: Any) -> np.ndarray:
        """The same numbers in another shape."""
        return np.reshape(self, shape[0] if len(shape) == 1 else shape)


def _method(function: Callable[..., np.ndarray]) -> Callable[..., object]:
    return lambda self, *arguments, **named: self.recording.call(function, self, *arguments, **named)


for _name in ("max", "min", "sum", "prod", "mean", "any", "all", "argmax", "argmin", "cumsum", "clip", "ravel", "copy",
              "squeeze", "repeat", "transpose", "swapaxes", "take"):  # fmt: skip
    setattr(Recorded, _name, _method(getattr(np, _name)))
