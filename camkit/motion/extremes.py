"""The largest |f| of a smooth function, found on a grid and then by zooming in, whole populations at once."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from .law import Kinematics, Law, Peaks

EDGE = 1e-11
"""How far inside its ends an interval is searched, as a share of it: a kink there speaks for the neighbour."""
COARSE, FINE, ZOOMS = 401, 21, 6


def largest(f: Callable[[Any], Any], low: Any, high: Any) -> tuple[Any, Any]:
    """The largest ``|f(u)|`` between ``low`` and ``high``, and the ``u`` where it is.

    ``low`` and ``high`` are numbers or arrays of shape ``(p, 1)``, ``f`` gives ``(n,)`` or ``(p, n)``; the
    results keep a last axis of length 1.

    >>> value, u = largest(lambda u: u * (1 - u), 0.0, 0.8)
    >>> value.round(9), u.round(6)
    (array([0.25]), array([0.5]))
    """
    inner = EDGE * (high - low)
    low, high = low + inner, high - inner
    u, value = _best(f, low, high, COARSE)
    step = (high - low) / (COARSE - 1)
    for _ in range(ZOOMS):
        u, value = _best(f, np.maximum(u - step, low), np.minimum(u + step, high), FINE)
        step = 2 * step / (FINE - 1)
    return value, u


def _best(f: Callable[[Any], Any], low: Any, high: Any, n: int) -> tuple[Any, Any]:
    u = low + (high - low) * np.linspace(0.0, 1.0, n)
    size = np.abs(f(u))
    u = np.broadcast_to(u, size.shape)
    best = np.argmax(size, axis=-1, keepdims=True)
    return np.take_along_axis(u, best, -1), np.take_along_axis(size, best, -1)


def derivative(motion: Callable[[Any], Kinematics], k: int) -> Callable[[Any], Any]:
    """The derivative of order ``k`` alone, as a function."""
    return lambda u: motion(u)[k]


def law_peaks(law: Law) -> Peaks:
    """``Cv, Ca, Cj`` of a law that has no closed form for them: shape ``()``, or ``(p, 1)`` for a population."""
    return Peaks(*(_law_peak(law, k) for k in (1, 2, 3)))


def _law_peak(law: Law, k: int) -> Any:
    pieces = pairwise((0.0, *law.kinks, 1.0))
    found = [largest(derivative(law, k), low, high)[0] for low, high in pieces]
    value = np.max(np.stack(np.broadcast_arrays(*found)), axis=0)
    return value if value.ndim > 1 else value[0]
