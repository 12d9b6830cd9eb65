"""A program as loops: every number has an address on one heap, and what is done to it stands in stages of few loops.

Moves cost nothing: they are done to the addresses.  What is done for each element becomes a loop over a stretch of
addresses; loops of one length whose elements need only each other's go together, and what only they read is never
stored.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from .operations import POWERS, TABLE, Along, Each, Fold, Move, Pick
from .program import Program
from .record import Call, Ref, mapped

LONGEST = 80
"""So many steps, at most, are in one loop: an engine optimises no function that is too long."""
TRUTHS: dict[Any, Any] = {np.add: np.logical_or, np.multiply: np.logical_and}
"""What sum and product of truths are."""


class Span(NamedTuple):
    """What an operand reads: as many addresses as there are elements from ``first`` on, or (``step`` 0) this one."""

    first: int
    step: int


@dataclass(eq=False)
class Step:
    """``code`` of operands for each of ``count`` elements, with results from the address ``out`` on.

    With a ``start`` they are folded into one result.  A step without ``count`` is a call, which reads whole rows.
    """

    code: str
    out: int
    count: int
    operands: Sequence[Any]
    results: int
    start: float | None = None
    group: tuple[int, ...] = ()
    stored: bool = False

    def reads(self) -> Iterator[tuple[Any, range]]:
        """Each operand that is read, and its addresses."""
        for x in self.operands:
            if isinstance(x, Span):
                yield x, range(x.first, x.first + (self.count - 1) * x.step + 1)
            elif isinstance(x, range):
                yield x, x

    def beside(self, made: Step, operand: object) -> bool:
        """Whether each element needs only the one beside it of what has been ``made``: both can go in one loop."""
        return made.start is None and made.count == self.count > 1 and operand == Span(made.out, 1)


class Loops:
    """The steps of a program, and where its constants and outputs stand on a heap of a ``size``; inputs come first."""

    def __init__(self, program: Program) -> None:
        self.size, self.constants = 0, dict[int, np.ndarray]()
        self._steps, self._at, self._known = (list[Step](), dict[int, np.ndarray](), dict[Any, np.ndarray]())
        for k in range(len(program.inputs)):
            self._at[k] = self._new(program.calls[k].shape)
        for k in program.needed:
            self._at[k] = self._lowered(program.calls[k])
        self.outputs = [self._in_a_row(np.ravel(self._addresses(out))) for out in program.outputs.values()]

    @cached_property
    def groups(self) -> list[list[Step]]:
        """The steps that go together, in the order in which they run: single numbers, loops, calls of each stage."""
        _schedule(self._steps, self.size, self.outputs)
        found = defaultdict(list)
        for step in self._steps:
            found[step.group].append(step)
        return [found[key] for key in sorted(found)]

    def _new(self, shape: tuple[int, ...]) -> np.ndarray:
        first, self.size = self.size, self.size + int(np.prod(shape))
        return np.arange(first, self.size).reshape(shape)

    def _addresses(self, argument: Any) -> np.ndarray:
        if isinstance(argument, Ref):
            return self._at[argument.number]
        value = np.asarray(argument, dtype=float)
        key = value.shape, value.tobytes()
        if key not in self._known:
            self._known[key] = self._new(value.shape)
            self.constants[self.size - value.size] = value.ravel()
        return self._known[key]

    def _lowered(self, call: Call) -> np.ndarray:
        """The addresses of the result of a call; its steps are noted."""
        row, first, others = TABLE[call.function], call.arguments[0], call.arguments[1:]
        if isinstance(row, Move):
            moved = mapped(self._addresses, first) if isinstance(first, (tuple, list)) else self._addresses(first)
            assert call.function
            return np.asarray(call.function(moved, *others, **call.named))
        out = self._new(call.shape)
        if not out.size:
            return out
        if isinstance(row, Each):
            self._each(row, call, out.ravel())
            return out
        values = self._addresses(first)
        if isinstance(row, Fold):
            self._fold(row, _rows(values, _axis(call, 0)), out.ravel())
        elif isinstance(row, Along):
            rows = _rows(values, _axis(call, row.axis))
            into = _rows(out, _axis(call, row.axis)) if out.shape == values.shape else out.reshape(-1, 1)
            for one, to in zip(rows, into, strict=True):
                self._call(row.javascript, one, to)
        else:
            assert isinstance(row, Pick)
            for one, to, place in zip(*_picked(call, values, self._addresses(others[0])), strict=True):
                self._call("pick", one, out.ravel()[to : to + 1], place)
        return out

    def _each(self, row: Each, call: Call, out: np.ndarray) -> None:
        given, truths = (call.arguments, call.dtype.kind == "b" and call.function in TRUTHS)
        code = TABLE[TRUTHS[call.function]].javascript if truths else row.javascript  # type: ignore[union-attr]
        operands = [x if _literal(x) else _spread(self._addresses(x), call.shape) for x in given]
        if row is TABLE[np.power] and _literal(given[1]) and given[1] in POWERS:
            code, operands = POWERS[given[1]], operands[:1]
        self._loop(code, out, operands)

    def _loop(self, code: str, out: np.ndarray, operands: Sequence[Any]) -> None:
        """Steps for each stretch in which the addresses of all operands grow by 0 or 1."""
        for low, high in _stretches([x for x in operands if not _literal(x)], len(out)):
            spans = [float(x) if _literal(x) else _span(x[low:high]) for x in operands]
            self._steps.append(Step(code, int(out[low]), high - low, spans, high - low))

    def _fold(self, row: Fold, rows: np.ndarray, out: np.ndarray) -> None:
        """A loop along each row or, where there are more rows than columns, one over the rows for each column."""
        code = TABLE[row.by].javascript  # type: ignore[union-attr]
        if len(rows) < rows.shape[1]:
            for to, one in zip(out, map(self._in_a_row, rows), strict=True):
                self._steps.append(Step(code, int(to), len(one), [_span(one)], 1, row.start))
            return
        so_far: Any = row.start
        for column in rows.T:
            so_far, before = self._new(out.shape), so_far
            self._loop(code, so_far, [before, column])
        self._loop("{0}", out, [so_far])

    def _call(self, name: str, row: np.ndarray, to: np.ndarray, *more: np.ndarray) -> None:
        """A call of a function of the page's library, which goes along a row."""
        row, into = self._in_a_row(row), to if _even(to) else self._new(to.shape)
        places = [row[0], len(row), into[0], *more]
        reads = [range(row[0], row[-1] + 1), *(range(place, place + 1) for place in more)]
        self._steps.append(Step(f"{name}({','.join(map(str, places))});", int(into[0]), 0, reads, len(into)))
        if into is not to:
            self._loop("{0}", to, [into])

    def _in_a_row(self, addresses: np.ndarray) -> np.ndarray:
        """The addresses one after the other; copied where they are not."""
        if _even(addresses):
            return addresses
        copied = self._new(addresses.shape)
        self._loop("{0}", copied, [addresses])
        return copied


def _literal(argument: Any) -> bool:
    return not isinstance(argument, (Ref, np.ndarray)) and np.ndim(argument) == 0


def _even(addresses: np.ndarray) -> bool:
    return bool((np.diff(addresses) == 1).all())


def _spread(addresses: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    return (addresses if addresses.shape == shape else np.broadcast_to(addresses, shape)).ravel()


def _axis(call: Call, default: int | None) -> Any:
    return call.named.get("axis", call.arguments[1] if len(call.arguments) > 1 else default)


def _rows(addresses: np.ndarray, axis: Any) -> np.ndarray:
    """Addresses as rows along an axis, or several."""
    addresses = np.atleast_1d(addresses)
    axes = tuple(range(addresses.ndim)) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    last = np.moveaxis(addresses, axes, range(-len(axes), 0))
    return last.reshape(int(np.prod(last.shape[: last.ndim - len(axes)])), -1)


def _picked(call: Call, values: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, range, np.ndarray]:
    """For each result the row from which it is picked, its number, and the address of its place in the row."""
    if call.function is np.take:
        rows, places = (np.repeat(_rows(values, _axis(call, None)), places.size, 0), places.ravel())
        places = np.tile(places, len(rows) // len(places))
    else:
        places = np.broadcast_to(places, (*np.broadcast_shapes(values.shape[:-1], places.shape[:-1]), places.shape[-1]))
        rows = np.broadcast_to(values[..., None, :], (*places.shape, values.shape[-1])).reshape(places.size, -1)
    return rows, range(places.size), places.ravel()


def _span(addresses: np.ndarray) -> Span:
    return Span(int(addresses[0]), int(addresses[1] - addresses[0]) if len(addresses) > 1 else 0)


def _stretches(operands: Sequence[np.ndarray], count: int) -> Iterator[tuple[int, int]]:
    """From where to where every operand's addresses grow by one number, 0 or 1."""
    if count < 2 or not operands:
        yield from [(0, count)] * bool(count)
        return
    steps = np.diff(np.reshape(operands, (len(operands), count)), axis=-1)
    ok = ((steps == 0) | (steps == 1)).all(0)
    same = np.append(False, (steps[:, 1:] == steps[:, :-1]).all(0))
    low = 0
    for k in np.flatnonzero(~(ok & same)):
        if k > low or not ok[k]:  # the step from k to k + 1 is another than the one before
            yield low, int(k) + 1
            low = int(k) + 1
    yield low, count


def _schedule(steps: Sequence[Step], size: int, outputs: Sequence[np.ndarray]) -> None:
    """The group of each step, its stage first, and which results are read from the heap."""
    maker, counts = np.full(size, -1), defaultdict[Any, int](int)
    for k, step in enumerate(steps):
        stage = max((_earliest(steps[m], step, x) for m, x in _made(maker, step)), default=0)
        maker[step.out : step.out + step.results] = k
        kind = (stage, 2 if step.count == 0 else int(step.count > 1), step.count)
        step.group = (*kind, counts[kind] // LONGEST)
        counts[kind] += 1
    for step in steps:
        for m, x in _made(maker, step):
            steps[m].stored |= steps[m].group != step.group or not step.beside(steps[m], x)
    for m in {m for addresses in outputs for m in maker[addresses].tolist() if m >= 0}:
        steps[m].stored = True


def _made(maker: np.ndarray, step: Step) -> Iterator[tuple[int, Any]]:
    """The steps that make what a step reads, with the operand that reads it."""
    for x, addresses in step.reads():
        yield from ((m, x) for m in set(maker[addresses.start : addresses.stop].tolist()) if m >= 0)


def _earliest(made: Step, step: Step, operand: object) -> int:
    """The first stage in which a step can stand; single numbers come before the loops of a stage, calls after them."""
    single = made.count == 1 and made.start is None
    return made.group[0] + (not single and not step.beside(made, operand))
