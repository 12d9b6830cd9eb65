"""Loops of a program that are done together: each of a group goes as often, and reads what another has just made.

A number that only its own group needs has no place on the heap; it stays in a register.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import pairwise

import numpy as np

from ..loops import COPY, Loop, Span
from ..operations import ALONG, EACH
from ..operations import operands as count
from ..record import CannotRecord
from ..written import picked
from .rows import Rows

PICKED = EACH[picked]
ALONG_ROWS = {name for name, _ in ALONG.values()}


@dataclass(eq=False)
class Step:
    """A loop, and what it is made of; a fold begins with nothing, or goes on with what stands at its result."""

    operation: str
    times: int
    result: Span
    operands: list[Span]
    fold: bool
    begins: bool = False
    group: int = -1
    stored: bool = False
    """Whether its result is read elsewhere than in its group, place by place."""


@dataclass
class Group:
    """Steps that are done together, so many times; if they are not always ``needed``, what says so stands there."""

    times: int
    alone: bool
    steps: list[Step] = field(default_factory=list)
    needed: int | None = None


class Fused:
    """The groups of a program's loops, in order; addresses below ``steady`` hold what no loop makes."""

    def __init__(self, loops: Rows) -> None:
        self.loops, self.steady = loops, loops.steady
        self.groups: list[Group] = []
        self._open: dict[tuple[int, int | None], list[int]] = {}
        self._makers: list[Step | None] = [None] * (loops.size - len(loops.constants))
        for loop, needed in zip(loops.loops, loops.needed, strict=True):
            for part in _cut(loop, self.steady):
                self._place(part, needed)
        self.outputs = [at + k - len(loops.constants) for at, size in loops.outputs for k in range(size)]
        """The address of each number of the outputs."""
        for at in self.outputs:
            if maker := self._makers[at]:
                maker.stored = True
        self.places, self.size = self._heap()

    def value(self, address: int) -> float:
        """What a constant is."""
        return float(self.loops.constants[address])

    def _place(self, loop: Loop, needed: int | None) -> None:
        result, *operands = loop.spans
        folds = loop.times > 1 and (loop.operation in ALONG_ROWS or result[1] == 0)
        if loop.operation == "argmax":
            result = (result[0], 0)
        step = Step(loop.operation, loop.times, result, operands, folds, folds and len(operands) == 1)
        alone = loop.operation == "sorted" or any(_runs_into(result, span, loop.times) for span in operands)
        makers = [made for k in range(len(operands)) for made in self._makers_of(step, k)]
        if needed is not None and (flag := self._makers[needed]):
            makers.append((flag, False))
        step.group = self._group(step, needed, max((m.group + (not beside) for m, beside in makers), default=0), alone)
        for maker, beside in makers:
            maker.stored |= not beside or maker.group != step.group
        step.stored = alone or step.fold
        self.groups[step.group].steps.append(step)
        for address in _addresses(result, step.times if result[1] else 1):
            self._makers[address] = step

    def _makers_of(self, step: Step, k: int) -> list[tuple[Step, bool]]:
        """What has made an operand, and whether that can be done in the same group."""
        span = step.operands[k]
        addresses = _addresses(span, step.times)
        if step.operation == PICKED and k == 0:
            size = int(self.value(step.operands[2][0]))
            addresses = [a + i for a in dict.fromkeys(addresses) for i in range(size)]
        if addresses[0] < self.steady <= addresses[-1]:
            raise CannotRecord("numbers that move and numbers that stay stand in one row")
        makers = {id(m): m for a in addresses if a >= 0 and (m := self._makers[a])}
        at_once = k == 0 and (step.operation == PICKED or (step.fold and not step.begins))
        beside = len(makers) == 1 and not at_once
        return [
            (m, beside and not m.fold and m.times == step.times and _same(m.result, span, m.times))
            for m in makers.values()
        ]

    def _heap(self) -> tuple[np.ndarray, int]:
        """Where each number is that is stored, and how many there are at a time: a place is used again and again."""
        used = self._used()
        owner = self._owners([span for span, _, _ in used])
        first, last = dict[int, int](), dict[int, int]()
        for (low, _), number, writes in used:
            one = int(owner[low])
            last[one] = max(last.get(one, 0), number)
            if writes:
                first[one] = min(first.get(one, number), number)
        places, size = np.full(len(owner), -1), 0
        free, busy = dict[int, list[int]](), list[tuple[int, int, int]]()
        for one in sorted(first, key=first.__getitem__):
            while busy and busy[0][0] < first[one]:
                _, at, count = heappop(busy)
                free.setdefault(count, []).append(at)
            begin, end = np.searchsorted(owner, [one, one + 1]).tolist()
            count = end - begin
            if not free.get(count):
                free[count], size = [size], size + count
            at = free[count].pop()
            places[begin:end] = range(at, at + count)
            heappush(busy, (last[one], at, count))
        return places, size

    def _used(self) -> list[tuple[Span, int, bool]]:
        """The least and the largest address of what is read or written, in which group, and whether it is written."""
        steps = [(step, number) for number, group in enumerate(self.groups) for step in group.steps]
        used = [(self._reach(s, k), number, k < 0) for s, number in steps for k in range(-s.stored, len(s.operands))]
        used += [((k, k), 0, True) for k in range(self.steady, len(self._makers)) if self._makers[k] is None]
        used += [((at, at), len(self.groups), False) for at in self.outputs]
        used += [((g.needed, g.needed), number, False) for number, g in enumerate(self.groups) if g.needed is not None]
        return [use for use in used if use[0][0] >= self.steady]

    def _owners(self, spans: list[Span]) -> np.ndarray:
        """To which array each address belongs; arrays that are one row for a span are one."""
        begins = np.zeros(len(self._makers), dtype=int)
        begins[[first for first in self.loops.blocks if first < len(begins)]] = 1
        for low, high in spans:
            begins[low + 1 : high + 1] = 0
        return np.cumsum(begins)

    def _reach(self, step: Step, k: int) -> Span:
        """The least and the largest address of an operand, or of the result."""
        span = step.operands[k] if k >= 0 else step.result
        at = _addresses(span, step.times if k >= 0 or span[1] else 1)
        more = int(self.value(step.operands[2][0])) - 1 if step.operation == PICKED and k == 0 else 0
        return min(at[0], at[-1]), max(at[0], at[-1]) + more

    def _group(self, step: Step, needed: int | None, first: int, alone: bool) -> int:
        same = self._open.setdefault((step.times, needed), [])
        at = bisect_left(same, first)
        if alone or at == len(same):
            self.groups.append(Group(step.times, alone, needed=needed))
            number = len(self.groups) - 1
            if not alone:
                same.append(number)
            return number
        return same[at]


def _cut(loop: Loop, steady: int) -> Iterator[Loop]:
    """A loop in parts, in each of which an operand either moves or stays."""
    cuts = {0, loop.times}
    for first, step in loop.spans[1:]:
        last = first + step * (loop.times - 1)
        if min(first, last) < steady <= max(first, last):
            cuts.add(-((first - steady) // step) if step > 0 else (first - steady) // -step + 1)
    ends = sorted(cuts)
    for begin, end in pairwise(ends):
        result, *operands = ((first + step * begin, step) for first, step in loop.spans)
        if begin and len(operands) == 1 and not result[1]:  # a fold goes on
            operands.insert(0, result)
        alone = end - begin == 1 and len(operands) < count(loop.operation)
        yield Loop(COPY if alone else loop.operation, end - begin, (result, *operands), loop.moving)


def _same(one: Span, other: Span, times: int) -> bool:
    return one[0] == other[0] and (times == 1 or one[1] == other[1])


def _addresses(span: Span, times: int) -> list[int] | range:
    first, step = span
    return range(first, first + step * times, step) if step and times > 1 else [first]


def _runs_into(result: Span, operand: Span, times: int) -> bool:
    """Whether a loop reads what it has made before, as a running sum does."""
    if times == 1 or result[1] == 0 or result == operand:
        return False
    return not {*_addresses(result, times)}.isdisjoint(_addresses(operand, times))
