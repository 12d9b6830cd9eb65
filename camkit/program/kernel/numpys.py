"""Where numpy's own loops are, which a kernel calls for what it cannot write itself."""

from __future__ import annotations

import ctypes
from functools import cache

import numpy as np

from .words import BY_NUMPY


class _Ufunc(ctypes.Structure):
    """``PyUFuncObject`` of numpy's C interface (``ufuncobject.h``), behind the head that every object has."""

    _fields_ = (
        *((name, ctypes.c_int) for name in ("takes", "gives", "all", "identity")),
        ("loops", ctypes.POINTER(ctypes.c_void_p)),
        ("data", ctypes.POINTER(ctypes.c_void_p)),
        ("kinds", ctypes.c_int),
        ("reserved", ctypes.c_int),
        ("name", ctypes.c_char_p),
    )


@cache
def table() -> np.ndarray:
    """The address of the loop for doubles and of its data, for each function of `BY_NUMPY`.

    ``NotImplementedError`` where numpy keeps them otherwise.

    >>> table().size == 2 * len(BY_NUMPY)
    True
    """
    found = [address for function in BY_NUMPY for address in _loop(function)]
    return np.array(found, dtype=np.uint64)


def _loop(function: np.ufunc) -> tuple[int, int]:
    inside = _Ufunc.from_address(id(function) + object.__basicsize__)
    told = (inside.takes, inside.gives, inside.kinds, inside.name)
    if told != (function.nin, function.nout, function.ntypes, function.__name__.encode()):
        raise NotImplementedError("numpy's functions are not as they were")
    place = function.types.index("d" * function.nin + "->d")
    return inside.loops[place] or 0, inside.data[place] or 0
