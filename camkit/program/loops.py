"""A program as loops: every number has an address on one heap, and each loop does one operation again and again.

Moves cost nothing: they are done to the addresses.  A loop whose result stays where it is folds many numbers into one;
one that reads what it has just written adds up.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from math import prod
from typing import Any, NamedTuple

import numpy as np

from .operations import ALONG, EACH, FOLDS, MOVES
from .program import Program, numbers_in
from .record import Recorded, mapped
from .written import picked

COPY = "{0}"
Span = tuple[int, int]
"""Addresses one after the other: the first, and the step to the next."""


class Loop(NamedTuple):
    """``operation``, so many times: on the spans of its result, which is first, and of what it is made of."""

    operation: str
    times: int
    spans: tuple[Span, ...]
    moving: bool
    """Whether it depends on an input that moves."""


class Place:
    """Where the numbers of an array are."""

    def __init__(self, addresses: np.ndarray) -> None:
        self.addresses, self.size = addresses, addresses.size

    @cached_property
    def span(self) -> Span | None:
        """The same as a span, if it is one."""
        flat = self.addresses.ravel()
        step = int(flat[1] - flat[0]) if len(flat) > 1 else 0
        return (int(flat[0]), step) if (flat[1:] - flat[:-1] == step).all() else None

    def spread(self, out: Place) -> Place:
        """Where they are if they are broadcast to the shape of a result."""
        return self if self.size in (1, out.size) else Place(np.broadcast_to(self.addresses, out.addresses.shape))


class Loops:
    """The loops of a program in order, and its constants, which stand on the heap first; its inputs come next.

    So many of the inputs are steady; what depends on none that moves need not be done again while they stay.
    Of a part of a program ``made`` says which calls are given, as inputs are, and which follow from them.
    """

    def __init__(self, program: Program, steady: int, made: tuple[Sequence[int], Sequence[int]] | None = None) -> None:
        given, needed = made or (range(len(program.inputs)), program.needed)
        self.loops = list[Loop]()
        self._size, self._constants, self._known = 0, list[np.ndarray](), dict[Any, Place]()
        self._at = {k: self._new(program.calls[k].shape) for k in given}
        self.inputs = self._size
        moving = set(range(steady, len(program.inputs)))
        for k in needed:
            self._moving = not moving.isdisjoint(numbers_in(program.calls[k].arguments))
            moving |= {k} if self._moving else set()
            self._at[k] = self._lowered(program.calls[k])
        self._moving = True
        outputs = [self._in_a_row(np.ravel(self._place(out).addresses)) for out in program.outputs.values()]
        self.constants = np.concatenate([*self._constants[::-1], []])
        self.size = len(self.constants) + self._size
        self.outputs = [(len(self.constants) + int(at[0]), len(at)) if at.size else (0, 0) for at in outputs]
        """Where each output begins on the heap, and how many numbers it has."""

    def _new(self, shape: tuple[int, ...]) -> Place:
        first, self._size = self._size, self._size + prod(shape)
        place = Place(np.arange(first, self._size).reshape(shape))
        place.span = (first, int(place.size > 1))
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
        into = _rows(out.addresses, axis) if call.shape == values.shape else out.addresses.reshape(-1, 1)
        if not name:
            self._fold(FOLDS[function], rows, into)
            return out
        for one, (to, *others) in zip(rows.tolist(), into.tolist(), strict=True):
            self.loops.append(Loop(name, len(one), ((to, others[0] - to if others else 1), (one[0], 1)), self._moving))
        return out

    def _loop(self, operation: str, out: Place, *operands: Place) -> Place:
        """A loop for each stretch in which all go on by even steps; where its results are."""
        places = [out, *[operand.spread(out) for operand in operands]]
        spans = [span for place in places if (span := place.span)]
        if len(spans) == len(places):
            self.loops.append(Loop(operation, out.size, tuple(spans), self._moving))
        else:
            each = [np.broadcast_to(place.addresses, out.addresses.shape).ravel() for place in places]
            stretches = _stretches(np.stack(each))
            self.loops += (Loop(operation, times, spans, self._moving) for times, spans in stretches)
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


def _stretches(addresses: np.ndarray) -> Iterator[tuple[int, tuple[Span, ...]]]:
    """How far all rows of addresses go on by even steps, and their spans there, from one stretch to the next."""
    steps, begin, last = np.diff(addresses, append=addresses[:, -1:]), 0, addresses.shape[1] - 1
    changes = np.flatnonzero((steps[:, 1:-1] != steps[:, :-2]).any(0)) + 1
    for k in (*changes.tolist(), last):
        if k > begin or k == last:  # the steps from k to k + 1 are others than those before
            spans = zip(addresses[:, begin].tolist(), steps[:, begin].tolist(), strict=True)
            yield k + 1 - begin, tuple(spans)
            begin = k + 1


def _rows(addresses: np.ndarray, axis: Any) -> np.ndarray:
    """Addresses as rows along an axis, or several."""
    addresses = np.atleast_1d(addresses)
    axes = tuple(range(addresses.ndim)) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    last = np.moveaxis(addresses, axes, range(-len(axes), 0))
    return last.reshape(prod(last.shape[: last.ndim - len(axes)]), -1)
