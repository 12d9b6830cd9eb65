"""A program as loops: every number has an address on one heap, and what is done to it stands in stages of few loops.

Moves cost nothing: they are done to the addresses.  What is done for each element becomes a loop over a stretch of
addresses; loops of one length whose elements need only each other's go together, and what only they read is never
stored.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from .operations import POWERS, TABLE, Along, Each, Fold, Move, Pick, as_type
from .program import Program
from .record import Call, Ref, mapped

CHAIN = 32
"""So many numbers, at most, are folded by one operation after the other for all columns at once."""
LONGEST = 80
"""So many steps, at most, are in one loop: an engine optimises no function that is too long."""
TRUTHS: dict[Any, Any] = {np.add: np.logical_or, np.multiply: np.logical_and}
"""What sum and product of truths are."""


@dataclass(frozen=True)
class Span:
    """Addresses: the first, and the step from each to the next, 0 or 1 in a loop."""

    first: int
    step: int


@dataclass(eq=False)
class Step:
    """A part of a loop: ``code`` of operands for ``count`` results from the address ``out`` on.

    With a ``start`` the results are folded into one; a ``call`` goes along its one operand, of ``count`` numbers.
    """

    code: str
    out: int
    count: int
    operands: Sequence[Span | float]
    start: float | None = None
    call: bool = False
    results: int = 1
    stage: int = 0
    group: Any = None
    stored: bool = True

    def reads(self, span: Span) -> range:
        """The addresses that an operand stands for."""
        return range(span.first, span.first + (self.count - 1) * span.step + 1, span.step or 1)


@dataclass
class Heap:
    """What has an address: inputs first, then constants and results."""

    size: int = 0
    constants: dict[int, np.ndarray] = field(default_factory=dict)
    _known: dict[Any, np.ndarray] = field(default_factory=dict)

    def new(self, shape: tuple[int, ...]) -> np.ndarray:
        """Addresses for an array."""
        count = int(np.prod(shape))
        self.size += count
        return np.arange(self.size - count, self.size).reshape(shape)

    def constant(self, value: Any) -> np.ndarray:
        """The addresses of a constant."""
        value = np.asarray(value, dtype=float)
        key = value.shape, value.tobytes()
        if key not in self._known:
            self._known[key] = self.new(value.shape)
            self.constants[self.size - value.size] = value.ravel()
        return self._known[key]


class Loops:
    """The steps of a program in their stages, and where inputs, constants and outputs stand on the heap."""

    def __init__(self, program: Program) -> None:
        self.heap, self.steps = Heap(), []
        self._program, self._at = program, {}
        for k in range(len(program.inputs)):
            self._at[k] = self.heap.new(program.calls[k].shape)
        for k in program.needed:
            self._at[k] = self._lowered(program.calls[k])
        self.outputs = [self._in_a_row(np.ravel(self._addresses(out))) for out in program.outputs.values()]
        _schedule(self.steps, self.heap.size, self.outputs)

    steps: list[Step]
    outputs: list[np.ndarray]
    _at: dict[int, np.ndarray]

    @cached_property
    def groups(self) -> list[list[Step]]:
        """The steps that go together, in the order in which they run: single numbers, loops, calls of each stage."""
        found = defaultdict(list)
        for step in self.steps:
            found[step.group].append(step)
        return [found[key] for key in sorted(found)]

    def _addresses(self, argument: Any) -> np.ndarray:
        return self._at[argument.number] if isinstance(argument, Ref) else self.heap.constant(argument)

    def _lowered(self, call: Call) -> np.ndarray:
        """The addresses of the result of a call; its steps are noted."""
        row = TABLE[call.function]
        if call.function is as_type:
            row = self._converted(call)
        if isinstance(row, Move):
            data, *others = call.arguments
            moved = mapped(self._addresses, data) if isinstance(data, (tuple, list)) else self._addresses(data)
            assert call.function
            return np.asarray(call.function(moved, *others, **call.named))
        out = self.heap.new(call.shape)
        if isinstance(row, Each):
            self._each(row, call, out)
        elif isinstance(row, Fold):
            self._fold(row, _rows(self._addresses(call.arguments[0]), _axis(call, 0)), out.ravel())
        elif isinstance(row, Along):
            self._along(row, call, out)
        else:
            assert isinstance(row, Pick)
            self._pick(call, out.ravel())
        return out

    def _converted(self, call: Call) -> Each | Move:
        before = self._program.calls[call.arguments[0].number].dtype.kind
        if call.dtype.kind == before or call.dtype.kind == "f" or before == "b":
            return Move()
        return Each("+({0}!==0)") if call.dtype.kind == "b" else Each("M.trunc({0})")

    def _each(self, row: Each, call: Call, out: np.ndarray) -> None:
        function, given = call.function, call.arguments[: row.operands]
        if call.dtype.kind == "b" and function in TRUTHS:
            row = TABLE[TRUTHS[function]]  # type: ignore[assignment]
        operands = [x if _literal(x) else _spread(self._addresses(x), call.shape) for x in given]
        if row is TABLE[np.power] and _literal(given[1]) and given[1] in POWERS:
            row, operands = Each(POWERS[given[1]]), operands[:1]
        self._loop(row.javascript, out.ravel(), operands)

    def _loop(self, code: str, out: np.ndarray, operands: Sequence[Any]) -> None:
        """Steps for each stretch in which the addresses of all operands grow by 0 or 1."""
        for low, high in _stretches([x for x in operands if not _literal(x)], len(out)):
            spans = [float(x) if _literal(x) else _span(x[low:high]) for x in operands]
            self.steps.append(Step(code, int(out[low]), high - low, spans, results=high - low))

    def _fold(self, row: Fold, rows: np.ndarray, out: np.ndarray) -> None:
        code = TABLE[row.by].javascript  # type: ignore[union-attr]
        if rows.shape[1] > CHAIN or len(rows) == 1 < rows.shape[1]:
            for address, one in zip(out, rows, strict=True):
                span = _span(self._in_a_row(one))
                self.steps.append(Step(code, int(address), len(one), [span], row.start))
            return
        so_far: Any = rows[:, 0] if rows.shape[1] else row.start
        for column in rows.T[1:-1]:
            so_far, before = self.heap.new(out.shape), so_far
            self._loop(code, so_far, [before, column])
        self._loop(code if rows.shape[1] > 1 else "{0}", out, [so_far, rows[:, -1]] if rows.size else [so_far])

    def _along(self, row: Along, call: Call, out: np.ndarray) -> None:
        axis = _axis(call, -1 if call.function is np.sort else None if call.function is np.argmax else 0)
        rows = _rows(self._addresses(call.arguments[0]), axis)
        if not row.many:
            for address, one in zip(out.ravel(), rows, strict=True):
                self._call(f"H[{address}]={row.javascript}({{0}},{len(one)})", int(address), one)
            return
        sorted_out = _rows(out, axis)
        for into, one in zip(sorted_out, rows, strict=True):
            found = self.heap.new(one.shape)
            self._call(f"{row.javascript}({{0}},{len(one)},{found[0]})", int(found[0]), one, len(one))
            self._loop("{0}", into, [found])

    def _pick(self, call: Call, out: np.ndarray) -> None:
        values, places = (self._addresses(x) for x in call.arguments[:2])
        axis = call.named.get("axis", call.arguments[2] if len(call.arguments) > 2 else None)
        if call.function is np.take:
            rows = np.repeat(_rows(values, axis), places.size, axis=0)
            places = np.tile(places.ravel(), len(rows) // places.size)
        else:
            lead = np.broadcast_shapes(values.shape[:-1], places.shape[:-1])
            rows = np.broadcast_to(values[..., None, :], (*lead, places.shape[-1], values.shape[-1]))
            rows = rows.reshape(-1, values.shape[-1])
            places = np.broadcast_to(places, (*lead, places.shape[-1])).ravel()
        for address, one, place in zip(out, rows, places, strict=True):
            self._call(f"H[{address}]=pick({{0}},{len(one)},H[{place}])", int(address), one, place=int(place))

    def _call(self, code: str, out: int, row: np.ndarray, results: int = 1, place: int | None = None) -> None:
        """A call of a function of the page that goes along a row."""
        operands = [_span(self._in_a_row(row))] + ([] if place is None else [Span(place, 0)])
        self.steps.append(Step(code, out, len(row), operands, call=True, results=results))

    def _in_a_row(self, addresses: np.ndarray) -> np.ndarray:
        """The addresses one after the other; copied where they are not."""
        if (np.diff(addresses) == 1).all():
            return addresses
        copied = self.heap.new(addresses.shape)
        self._loop("{0}", copied, [addresses])
        return copied


def _literal(argument: Any) -> bool:
    return not isinstance(argument, (Ref, np.ndarray)) and np.ndim(argument) == 0


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
    """The stage and the group of each step, and which results are read from the heap."""
    maker = np.full(size, -1)
    counts: dict[Any, int] = defaultdict(int)
    for k, step in enumerate(steps):
        step.stage = max((_earliest(steps[m], step, span) for m, span in _made(maker, step)), default=0)
        maker[step.out : step.out + step.results] = k
        kind = 2 if step.call else 1 if step.count > 1 else 0
        key = step.stage, kind, step.count if kind == 1 else 0
        step.group = (*key, counts[key] // LONGEST)
        counts[key] += 1
        step.stored = kind != 1 or step.start is not None
    for step in steps:
        for m, span in _made(maker, step):
            if not (steps[m].group == step.group and _beside(steps[m], step, span)):
                steps[m].stored = True
    for addresses in outputs:
        for m in set(maker[addresses].tolist()) - {-1}:
            steps[m].stored = True


def _made(maker: np.ndarray, step: Step) -> Iterator[tuple[int, Span]]:
    """The steps that make what a step reads, with the operand that reads it."""
    for span in step.operands:
        if isinstance(span, Span):
            last = span.first + (step.count - 1) * span.step + 1
            yield from ((m, span) for m in set(maker[span.first : last].tolist()) if m >= 0)


def _beside(made: Step, step: Step, span: Span) -> bool:
    """Whether each element needs only the one beside it of what has been made: both can go in one loop."""
    looped = made.start is None and not made.call and not step.call
    return looped and made.count == step.count > 1 and span == Span(made.out, 1)


def _earliest(made: Step, step: Step, span: Span) -> int:
    """The first stage in which a step can stand; single numbers come before the loops of a stage, calls after them."""
    single = made.count == 1 and not made.call and made.start is None
    return made.stage if single or _beside(made, step, span) else made.stage + 1
