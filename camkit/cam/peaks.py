"""The largest value of a curve over a cam, wherever it stands: how the measures of cams find their peaks.

A program is looked at where its motion has something to say (see `camkit.motion.resolution`), whatever cam angles an
analysis was asked for.  Every local maximum between those angles is raised to the top of the parabola through its
neighbours; around the highest the curve is looked at once more, and if its top is not found there, by zooming in.

The peaks of a high-speed cam's rise and fall, which its study sees as curves, are `raised` alone: within some 0.4 % of
their size.  Linkages and joints are measured at the positions that an analysis was asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

CLOSER, LOOKS = 1 / 16, 5
"""How near to the top of a parabola the curve is looked at again, in steps, and at how many angles."""
ZOOM, ZOOMS = 17, 3
"""Where the top is not found there: at how many angles between its neighbours, and how often, each time closer."""
SMOOTH, SHARP = 4.0, 0.02
"""How much a curve may bend at its top, over the parabola (else it has a corner), and over its size (else a needle)."""
LEVEL = 1e-14
"""Values that differ by less than this share of their size are the same."""


class Extreme(NamedTuple):
    """An extreme value over the cam and the cam angle (rad) at which it stands: numbers, or ``(p,)``."""

    value: Any
    cam_angle: Any


def raised(values: Any, inner: Any = True) -> Any:
    """``values`` at even steps, each local maximum raised to the top of the parabola through its neighbours.

    ``inner`` says which of them have a neighbour at an even step on both sides.

    >>> x = np.linspace(0, 3, 31)
    >>> print(f"{1 - np.sin(x).max():.0e}, {1 - raised(np.sin(x)).max():.0e}")
    4e-04, 1e-06
    """
    tops = np.array(values, dtype=float)
    flat, at = tops.reshape(-1), _maxima(values, inner)
    flat[at] += _summit(flat[at - 1], flat[at], flat[at + 1])[1]
    return tops


def _maxima(values: Any, inner: Any) -> Any:
    """Where the local maxima are, as indices of the flat array."""
    with np.errstate(invalid="ignore"):
        up = values[..., 1:] >= values[..., :-1]
    top = np.zeros(values.shape, dtype=bool)
    np.greater(up[..., :-1], up[..., 1:], out=top[..., 1:-1])
    top &= inner
    return np.flatnonzero(top)


def highest(f: Callable[[Any], Any], angle: Any, inner: Any) -> Extreme:
    """The largest value of ``f(cam_angle)``, by looking at the cam angles ``angle`` and then more closely.

    ``inner`` says which of them have a neighbour at the same step, without a jump in between, on both sides.

    >>> x = np.linspace(0, 3, 31)
    >>> found = highest(np.sin, x, np.isin(x, x[[0, -1]], invert=True))
    >>> print(f"{found.value:.9f} at {found.cam_angle:.4f}")
    1.000000000 at 1.5708
    """
    angle, values = np.broadcast_arrays(angle, f(angle))
    best = np.argmax(raised(values, inner), axis=-1, keepdims=True)
    before, after = best - 1, (best + 1) % angle.shape[-1]
    low = _at(angle, np.where(inner[best] | inner[before], before, best))
    high = _at(angle, np.where(inner[best] | inner[after], after, best))
    centre, near = _at(angle, best), CLOSER * (high - low) / 2
    around = _at(values, before), _at(values, best), _at(values, after)
    centre = centre + np.where(inner[best], _summit(*around)[0], 0.0) * (high - low) / 2
    value, place, bend, edge = _looked(f, np.maximum(centre - near, low), np.minimum(centre + near, high), low, high)
    with np.errstate(invalid="ignore"):
        bent = 2 * around[1] - around[0] - around[2]
        smooth = (bend <= SMOOTH * (2 * CLOSER / (LOOKS - 1)) ** 2 * bent) & (bent <= SHARP * abs(value))
    level = bend <= LEVEL * abs(value)
    found = edge | level | inner[best] & smooth | ~np.isfinite(value)
    if not found.all():
        zoomed, there = _zoomed(f, low, high)
        value, place = np.where(found, value, zoomed), np.where(found, place, there)
    return Extreme(value[..., 0], place[..., 0])


def roughly_highest(angle: Any, values: Any, inner: Any) -> Extreme:
    """As `highest`, of ``values`` at the cam angles ``angle`` alone: the top of the parabola at the highest of them."""
    angle, values = np.broadcast_arrays(angle, values)
    best = np.argmax(values, axis=-1, keepdims=True)
    around = (_at(values, np.clip(best + k, 0, values.shape[-1] - 1)) for k in (-1, 0, 1))
    value = _at(values, best) + np.where(inner[best], _summit(*around)[1], 0.0)
    return Extreme(value[..., 0], _at(angle, best)[..., 0])


def _looked(f: Callable[[Any], Any], begin: Any, end: Any, low: Any, high: Any) -> tuple[Any, Any, Any, Any]:
    """The highest of a few angles from ``begin`` to ``end``, where it is, how much it bends, and if it is at an end.

    It bends by ``inf`` if it seems to lie beyond them; ``low`` and ``high`` are ends, beyond which there is nothing.
    """
    step = (end - begin) / (LOOKS - 1)
    angle, values = np.broadcast_arrays(begin + step * np.arange(LOOKS), f(begin + step * np.arange(LOOKS)))
    best = np.argmax(values, axis=-1, keepdims=True)
    middle = np.clip(best, 1, LOOKS - 2)
    left, mid, right = (_at(values, middle + k) for k in (-1, 0, 1))
    share, more = _summit(left, mid, right)
    inside = best == middle
    value = _at(values, best) + np.where(inside, more, 0.0)
    place = _at(angle, best) + np.where(inside, share, 0.0) * step
    with np.errstate(invalid="ignore"):
        level = values.min(-1, keepdims=True) >= value - LEVEL * abs(value)
        bend = np.where(level, 0.0, np.where(inside, 2 * mid - left - right, np.inf))
    edge = ((best == 0) & (begin <= low)) | ((best == LOOKS - 1) & (end >= high))
    return value, place, bend, edge


def _zoomed(f: Callable[[Any], Any], low: Any, high: Any) -> tuple[Any, Any]:
    """The highest between two angles: each time it is looked at again between the best angle's neighbours."""
    for _ in range(ZOOMS):
        angle = low + (high - low) * np.linspace(0, 1, ZOOM)
        angle, values = np.broadcast_arrays(angle, f(angle))
        best = np.argmax(values, axis=-1, keepdims=True)
        low, high = _at(angle, np.maximum(best - 1, 0)), _at(angle, np.minimum(best + 1, ZOOM - 1))
    middle = np.clip(best, 1, ZOOM - 2)
    _, more = _summit(*(_at(values, middle + k) for k in (-1, 0, 1)))
    return _at(values, best) + np.where(best == middle, more, 0.0), _at(angle, best)


def _summit(left: Any, mid: Any, right: Any) -> tuple[Any, Any]:
    """Where the top of the parabola through three neighbours lies beside the highest, in steps, and how far above."""
    with np.errstate(invalid="ignore"):
        bend, lean = 2 * mid - left - right, right - left
        curved = (bend > 0) & np.isfinite(bend) & (abs(lean) <= bend)
    bend, lean = np.where(curved, bend, 1.0), np.where(curved, lean, 0.0)
    return lean / (2 * bend), lean**2 / (8 * bend)


def _at(values: Any, column: Any) -> Any:
    """The values in one column of each row, ``(1,)`` or ``(p, 1)``."""
    return values[column] if values.ndim == 1 else values[np.arange(len(values))[:, None], column]
