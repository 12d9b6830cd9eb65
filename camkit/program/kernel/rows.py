"""The loops of a program in the order in which numpy works, so that its numbers are numpy's to the last bit."""

from __future__ import annotations

import operator
from collections.abc import Iterator

import numpy as np

from ..loops import COPY, Loop, Loops, Place
from ..operations import EACH, FOLDS
from ..operations import operands as count
from ..program import Program
from ..record import Recorded
from .needed import Reasons, reasons

FEW = 4
"""Rows of so few numbers are folded number by number, all rows at once."""
EIGHT, BLOCK = 8, 128
"""So many sums of a row numpy has side by side, for so many of its numbers."""
ADD, POWER = EACH[np.add], EACH[np.power]
RAISED = "raised({0},{1})"
"""A power whose exponent is one number for all: `numpy` looks at it first."""
OF_ONE = {2.0: EACH[np.square], 0.5: EACH[np.sqrt], -1.0: EACH[np.reciprocal], 1.0: COPY}
"""What such a power is, by its exponent."""


class Rows(Loops):
    """The loops of the moving part of a program: folds of long rows are loops of their own, with one operand.

    ``given`` are the calls whose results are there, ``moving`` those that are made of them, both by number; of what
    is given ``steady`` numbers are the same for all designs, and stand first.
    """

    def __init__(self, program: Program, given: list[int], moving: list[int], steady: int) -> None:
        self.blocks = list[int]()
        """Where each array begins."""
        self.steady = steady
        self.needed = list[int | None]()
        """For each loop the address of what says whether it is needed, if it is not always."""
        self._reasons, self._flags = reasons(program, moving), dict[Reasons, int]()
        super().__init__(program, 0, (given, moving))
        self.needed += [None] * (len(self.loops) - len(self.needed))

    def _new(self, shape: tuple[int, ...]) -> Place:
        self.blocks.append(self._size)
        return super()._new(shape)

    def _lowered(self, call: Recorded) -> Place:
        """Where the result of a call is; whether its loops are needed is found out before them."""
        flag = self._flag(self._reasons.get(call.number, ()))
        self.needed += [None] * (len(self.loops) - len(self.needed))
        place = self._in_order(call)
        self.needed += [flag] * (len(self.loops) - len(self.needed))
        return place

    def _flag(self, why: Reasons) -> int | None:
        """Where it stands whether all reasons are there."""
        if why and why not in self._flags:
            before = self._flag(why[:-1])
            each = [self._anywhere(self._at[number].addresses, wanted) for number, wanted in sorted(why[-1])]
            there = self._folded(np.logical_or, np.reshape(each, (1, -1)))
            if before is not None:  # where that does not hold the others were not asked for, and may say anything
                there = self._folded(np.logical_and, np.array([[before, there]]))
            self._flags[why] = there
        return self._flags.get(why)

    def _anywhere(self, condition: np.ndarray, wanted: bool) -> int:
        """Where it stands whether one number of a condition is as it is wanted."""
        if not wanted:
            condition = self._loop(EACH[np.logical_not], self._new(condition.shape), Place(condition)).addresses
        return self._folded(np.logical_or, condition.reshape(1, -1))

    def _folded(self, function: np.ufunc, row: np.ndarray) -> int:
        """The address of one number of a row."""
        found = self._new((1, 1)).addresses
        self._fold(FOLDS[function.reduce], row, found)
        return int(found[0, 0])

    def _in_order(self, call: Recorded) -> Place:
        if call.function in (operator.pow, np.power) and call.size:
            return self._power(call)
        if call.function == np.add.reduce and call.size and _last_are_summed(call):
            values = self._place(call.arguments[0]).addresses
            return Place(self._sums(values.reshape(call.size, -1)).reshape(call.shape))
        return super()._lowered(call)

    def _power(self, call: Recorded) -> Place:
        """A power: of one exponent for all that is known, what numpy makes of it."""
        operands, operation, exponent = [*map(self._place, call.arguments)], POWER, call.arguments[1]
        if operands[1].size == 1 and not isinstance(exponent, Recorded):
            operation = OF_ONE.get(float(np.asarray(exponent).item()), POWER)
        elif operands[1].size == 1 and int(operands[1].addresses.flat[0]) < self.steady:
            operation = RAISED
        return self._loop(operation, self._new(call.shape), *operands[: count(operation)])

    def _sums(self, rows: np.ndarray) -> np.ndarray:
        """The sum of each row, in numpy's order (``pairwise_sum``): halves, then eight sums beside each other."""
        p, n = rows.shape
        if n > BLOCK:
            half = n // 2 - n // 2 % EIGHT
            return self._added(self._sums(rows[:, :half]), self._sums(rows[:, half:]))
        whole = n - n % EIGHT
        beside = rows[:, :whole].reshape(p, -1, EIGHT).swapaxes(1, 2).reshape(p * EIGHT, -1) if whole else rows
        found = self._new((len(beside), 1)).addresses
        self._fold(ADD, beside, found)
        while found.size > p:
            pairs = found.reshape(-1, 2)
            found = self._added(pairs[:, 0], pairs[:, 1])
        for k in range(whole or n, n):
            found = self._added(found, rows[:, k])
        return found.ravel()

    def _added(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return self._loop(ADD, self._new(a.shape), Place(a), Place(b.reshape(a.shape))).addresses

    def _fold(self, operation: str, rows: np.ndarray, into: np.ndarray) -> None:
        if into.shape == rows.shape or rows.shape[1] <= FEW:
            super()._fold(operation, rows, into)
            return
        for row, to in zip(rows, into.ravel().tolist(), strict=True):
            for k, (first, times, step) in enumerate(_even(row)):
                operands = ((first, step),) if k == 0 else ((to, 0), (first, step))
                self.loops.append(Loop(operation, times, ((to, 0), *operands), True))


def _even(addresses: np.ndarray) -> Iterator[tuple[int, int, int]]:
    """Where addresses go on by even steps: the first, how many, and the step."""
    begin, steps = 0, np.diff(addresses).tolist()
    for k in range(1, len(addresses) + 1):
        if k == len(addresses) or (k > begin + 1 and steps[k - 1] != steps[begin]):
            yield int(addresses[begin]), k - begin, steps[begin] if k > begin + 1 else 0
            begin = k


def _last_are_summed(call: Recorded) -> bool:
    """Whether numbers that stand beside each other are added; those of several rows numpy adds row by row."""
    values: Recorded = call.arguments[0]  # type: ignore[assignment]
    axis, n = call.named.get("axis", 0), values.ndim
    axes = range(n) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    return values.dtype.kind == "f" and sorted(k % n for k in axes) == [*range(n - len(axes), n)]
