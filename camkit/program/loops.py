"""A program as loops: every number has an address on one heap, and each loop does one operation again and again.

Moves cost nothing: they are done to the addresses.  A loop whose result stays where it is folds many numbers into one;
one that reads what it has just written adds up.
"""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from math import prod
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from .operations import ALONG, EACH, FOLDS, MOVES
from .program import Program
from .record import Recorded, mapped
from .written import picked

COPY = "{0}"


class Span(NamedTuple):
    """Addresses one after the other: from which number of an array on, the first, and the step to the next."""

    begin: int
    first: int
    step: int


class Loop(NamedTuple):
    """``operation``, so many times: on the spans of its result, which is first, and of what it is made of."""

    operation: str
    times: int
    spans: tuple[Span, ...]


class Place:
    """Where the numbers of an array are."""

    def __init__(self, addresses: np.ndarray) -> None:
        self.addresses, self.size = addresses, addresses.size

    @cached_property
    def spans(self) -> list[Span]:
        """The same as spans: each goes on until the next begins."""
        flat = self.addresses.ravel()
        steps, begin, found = flat[1:] - flat[:-1], 0, list[Span]()
        for k in (np.flatnonzero(steps[1:] != steps[:-1]) + 1).tolist():
            if k > begin:  # the step from k to k + 1 is another than the one before
                found.append(Span(begin, int(flat[begin]), int(steps[begin])))
                begin = k + 1
        return [*found, Span(begin, int(flat[begin]), int(steps[begin]) if begin < len(steps) else 0)]

    def spread(self, out: Place) -> list[Span]:
        """Its spans if it is broadcast to the shape of a result."""
        whole = self.size == 1 or self.size == out.size
        return self.spans if whole else Place(np.broadcast_to(self.addresses, out.addresses.shape)).spans


class Loops:
    """The loops of a program in order, and its constants, which stand on the heap first; its inputs come next."""

    def __init__(self, program: Program) -> None:
        self.loops = list[Loop]()
        self._size, self._constants, self._known = 0, list[np.ndarray](), dict[Any, Place]()
        self._at = {k: self._new(program.calls[k].shape) for k in range(len(program.inputs))}
        self.inputs = self._size
        for k in program.needed:
            self._at[k] = self._lowered(program.calls[k])
        outputs = [self._in_a_row(np.ravel(self._place(out).addresses)) for out in program.outputs.values()]
        self.constants = np.concatenate([*self._constants[::-1], []])
        self.size = len(self.constants) + self._size
        self.outputs = [(len(self.constants) + int(at[0]), len(at)) if at.size else (0, 0) for at in outputs]
        """Where each output begins on the heap, and how many numbers it has."""

    def _new(self, shape: tuple[int, ...]) -> Place:
        first, self._size = self._size, self._size + prod(shape)
        place = Place(np.arange(first, self._size).reshape(shape))
        place.spans = [Span(0, first, int(place.size > 1))]
        return place

    def _place(self, argument: Any) -> Place:
        """Where an argument is; constants stand at negative addresses until all are there."""
        if isinstance(argument, Recorded):
            return self._at[argument.number]
        value = np.asarray(argument, dtype=float)
        key = value.shape, value.tobytes()
        if key not in self._known:
            end = -sum(map(len, self._constants))
            self._constants.append(value.ravel())
            self._known[key] = Place(np.arange(end - value.size, end).reshape(value.shape))
        return self._known[key]

    def _lowered(self, call: Recorded) -> Place:
        """Where the result of a call is; its loops are noted."""
        function = np.logical_or if call.function is np.add and call.dtype == bool else call.function
        if function in MOVES:
            first, *others = call.arguments
            moved = mapped(lambda x: self._place(x).addresses, first)
            return Place(np.asarray(function(moved, *others, **call.named)))
        if not call.size:
            return self._new(call.shape)
        if function in EACH:
            operands = [self._place(x) for x in call.arguments]
            if function is picked:  # what counts is where each row begins
                operands[0] = Place(self._in_a_row(operands[0].addresses)[..., :1])
            return self._loop(EACH[function], self._new(call.shape), *operands)
        return self._along(function, self._place(call.arguments[0]).addresses, call)

    def _along(self, function: object, values: np.ndarray, call: Recorded) -> Place:
        name, default = ALONG.get(function, ("", 0))
        axis = call.named.get("axis", call.arguments[1] if len(call.arguments) > 1 else default)
        rows = self._in_a_row(_rows(values, axis)) if name else _rows(values, axis)
        out = self._new(call.shape)
        into = _rows(out.addresses, axis) if out.size == rows.size else out.addresses.reshape(-1, 1)
        if not name:
            self._fold(FOLDS[function], rows, into)
        for one, to in zip(rows.tolist(), into.tolist(), strict=True) if name else ():
            self.loops.append(Loop(name, len(one), (Span(0, to[0], 1), Span(0, one[0], 1))))
        return out

    def _loop(self, operation: str, out: Place, *operands: Place) -> Place:
        """A loop for each stretch in which all go on by even steps; where its results are."""
        each = [out.spans, *[operand.spread(out) for operand in operands]]
        if max(map(len, each)) == 1:
            self.loops.append(Loop(operation, out.size, tuple([spans[0] for spans in each])))
            return out
        begins = sorted({span.begin for spans in each for span in spans})
        for begin, end in zip(begins, [*begins[1:], out.size], strict=True):
            self.loops.append(Loop(operation, end - begin, tuple(_from(begin, spans) for spans in each)))
        return out

    def _fold(self, operation: str, rows: np.ndarray, into: np.ndarray) -> None:
        """The first number of each row, and what comes of it with each of the rest; the longer way in one loop."""
        self._loop(COPY, Place(into[:, :1]), Place(rows[:, :1]))
        rest, kept = rows[:, 1:], into.shape == rows.shape
        result = into[:, 1:] if kept else np.broadcast_to(into, rest.shape)
        each = [result, into[:, :-1] if kept else result, rest]
        if rest.size:
            self._loop(operation, *map(Place, each if len(rows) < len(rest.T) else map(np.transpose, each)))

    def _in_a_row(self, addresses: np.ndarray) -> np.ndarray:
        """Addresses one after the other; copied where they are not."""
        if (np.diff(addresses.ravel()) == 1).all():
            return addresses
        return self._loop(COPY, self._new(addresses.shape), Place(addresses)).addresses


def _from(begin: int, spans: list[Span]) -> Span:
    """What is left, from a number on, of the span that it is in."""
    span = spans[bisect_right(spans, begin, key=attrgetter("begin")) - 1]
    return Span(begin, span.first + (begin - span.begin) * span.step, span.step)


def _rows(addresses: np.ndarray, axis: Any) -> np.ndarray:
    """Addresses as rows along an axis, or several."""
    addresses = np.atleast_1d(addresses)
    axes = tuple(range(addresses.ndim)) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    last = np.moveaxis(addresses, axes, range(-len(axes), 0))
    return last.reshape(prod(last.shape[: last.ndim - len(axes)]), -1)
