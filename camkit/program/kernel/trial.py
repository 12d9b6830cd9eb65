"""Whether the library's sine and cosine are numpy's, which has them from the system: tried before code is made."""

from __future__ import annotations

from functools import cache

import numpy as np

from . import compiler
from .library import circle
from .numpys import table
from .text import many

BLOCK = """define internal void @block(ptr %S, ptr %H, ptr %N, ptr %X, ptr %O, i64 %p) #1 {{
  %x = load {numbers}, ptr %X, align 8
  %sine = call fastcc {numbers} @sin(ptr %N, {numbers} %x)
  store {numbers} %sine, ptr %O, align 8
  %cosine = call fastcc {numbers} @cos(ptr %N, {numbers} %x)
  %o = getelementptr double, ptr %O, i64 %p
  store {numbers} %cosine, ptr %o, align 8
  ret void
}}"""
TRIED = 2**14


@cache
def own_circle() -> bool:
    """Whether they are, to the last bit, at numbers of every size; else a kernel calls numpy's.

    >>> own_circle() in (True, False)
    True
    """
    x = angles()
    found, lanes = np.empty((2, len(x))), compiler.lanes()
    text = (circle(lanes, True), BLOCK.format(numbers=f"<{lanes} x double>"), many(lanes))
    function, engine = compiler.loaded(compiler.machine_code("\n".join(text)))
    addresses = (array.ctypes.data for array in (table(), x, found))
    function(None, None, *addresses, len(x), 0, len(x))
    del engine
    with np.errstate(invalid="ignore"):
        return np.array_equal(found, np.stack([np.sin(x), np.cos(x)]), equal_nan=True)


def angles() -> np.ndarray:
    """Angles of every size, and what is none."""
    draw = np.random.default_rng(1)
    sizes = np.repeat([0.13, 0.9, 2.5, 7.0, 1e3, 1e9], TRIED // 8)
    small = np.exp(draw.uniform(-60, 20, TRIED - len(sizes) - 8))
    awkward = (0.0, -0.0, np.inf, -np.inf, np.nan, 1.0, np.pi, -np.pi / 2)
    return np.concatenate([sizes * draw.uniform(-1, 1, len(sizes)), small, awkward])
