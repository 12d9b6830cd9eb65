"""A program of one design as native code, for many at once."""

from __future__ import annotations

import os
import threading
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np

from ...quantities.types import Array
from ..program import Program, numbers_in
from ..record import Recorded, uncollected
from . import compiler, stored
from .fused import Fused
from .numpys import table
from .rows import Rows
from .stored import Code
from .text import text
from .trial import own_circle

ALIGNED = 64
SHARED = 256
"""Up to so many designs are not shared among threads."""


@uncollected()
def code_of(program: Program, inputs: Sequence[str]) -> Code:
    """A program as native code for this processor, made anew; ``inputs`` are those that differ between designs.

    What depends on no input of these numpy works out, once for all designs of a call.
    """
    given, steady, moving = _parts(program, inputs)
    first = sum(program.calls[k].size for k in given) - len(inputs)
    loops = Rows(program, given, moving, first)
    fused, lanes = Fused(loops), compiler.lanes()
    made = compiler.machine_code(text(fused, len(inputs), lanes, own_circle()))
    outputs = tuple(at + len(loops.constants) if at < first else -1 for at in fused.outputs)
    return Code(made, loops.constants, tuple(given), tuple(steady), outputs, fused.size, lanes)


def _parts(program: Program, inputs: Sequence[str]) -> tuple[list[int], list[int], list[int]]:
    """The calls by number: what stands on the heap before a kernel runs, what leads to that, and what moves."""
    own = [program.inputs.index(name) for name in inputs]
    changing, given = set(own), dict[int, None]()
    steady, moving = list[int](), list[int]()
    for k in program.needed:
        behind = list(numbers_in(program.calls[k].arguments))
        if changing.isdisjoint(behind):
            steady.append(k)
            continue
        changing.add(k)
        moving.append(k)
        given |= dict.fromkeys(number for number in behind if number not in changing)
    outputs = (out.number for out in program.outputs.values() if isinstance(out, Recorded))
    given |= dict.fromkeys(number for number in outputs if number not in changing)
    return [*given, *own], steady, moving


class Kernel:
    """A program that runs as native code; one that was made before is read from the user's cache.

    ``inputs`` are those that differ from one design to another; they and all others are one number each.

    >>> from camkit.program import recorded
    >>> program = recorded(lambda given: {"area": given["width"] * given["height"]}, {"width": 2.0, "height": 3.0})
    >>> area = Kernel(program, ["width"])
    >>> area({"height": 5.0}, np.array([[4.0], [6.0]])).tolist()
    [[20.0], [30.0]]
    """

    def __init__(self, program: Program, inputs: Sequence[str]) -> None:
        self.program, self.inputs = program.of_numbers, tuple(inputs)
        name = stored.name(self.program, inputs, compiler.processor())
        code = stored.read(name)
        if code is None:
            code = code_of(self.program, inputs)
            stored.write(name, code)
        self._code, (self._function, self._engine) = code, compiler.loaded(code.machine_code)
        self._others = [k for k, name in enumerate(self.program.inputs) if name not in self.inputs]
        self._heap = threading.local()
        self._last: tuple[bytes, Array] = b"", np.empty(0)

    def __call__(self, others: Mapping[str, float], x: Array) -> Array:
        """The outputs one after the other, ``(p, n)``, of inputs ``(p, n_inputs)`` and all others by name."""
        steady, lanes = self._steady(others), self._code.lanes
        padded = np.pad(np.asarray(x, dtype=float), ((0, -len(x) % lanes), (0, 0)), mode="edge")
        inputs = np.ascontiguousarray(padded.T)
        found = np.empty((len(self._code.outputs), inputs.shape[1]))
        if len(x):
            self._run(steady, inputs, found)
        for k, at in enumerate(self._code.outputs):
            if at >= 0:
                found[k] = steady[at]
        return found.T[: len(x)]

    def _steady(self, others: Mapping[str, float]) -> Array:
        """Constants, and what numpy says of what is the same for all designs; the last is remembered."""
        values = np.array([others[self.program.inputs[k]] for k in self._others], dtype=float)
        last, numbers = self._last
        if last == values.tobytes() and numbers.size:
            return numbers
        results = dict(zip(self._others, values, strict=True))
        with np.errstate(all="ignore"):
            for k in self._code.steady:
                results[k] = self.program.calls[k].result(results)
        given = self._code.given[: len(self._code.given) - len(self.inputs)]
        numbers = np.concatenate([self._code.constants, *(np.ravel(results[k]) for k in given), [0.0]], dtype=float)
        self._last = values.tobytes(), numbers
        return numbers

    def _run(self, steady: Array, inputs: Array, found: Array) -> None:
        p, lanes = inputs.shape[1], self._code.lanes

        def some(begin: int, end: int) -> None:
            arrays = (table(), inputs, found)
            self._function(steady.ctypes.data, self._memory(), *(a.ctypes.data for a in arrays), p, begin, end)

        if p <= SHARED or threads() == 1:
            some(0, p)
            return
        step = -(-p // (lanes * threads())) * lanes
        list(_pool().map(some, range(0, p, step), (min(at + step, p) for at in range(0, p, step))))

    def _memory(self) -> int:
        """The address of the heap of this thread."""
        if not hasattr(self._heap, "bytes"):
            self._heap.bytes = np.empty(8 * self._code.size * self._code.lanes + ALIGNED, dtype=np.uint8)
        address = int(self._heap.bytes.ctypes.data)
        return address + -address % ALIGNED


def threads() -> int:
    """How many processors there are for this process; ``OMP_NUM_THREADS`` may say fewer, as among many processes."""
    told = os.environ.get("OMP_NUM_THREADS", "")
    if told.isdecimal() and int(told):
        return min(int(told), _processors())
    return _processors()


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads(), "camkit-kernel")


if hasattr(os, "register_at_fork"):  # a process that is forked has none of the threads
    os.register_at_fork(after_in_child=_pool.cache_clear)
