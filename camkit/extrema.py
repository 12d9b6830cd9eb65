"""The largest value of a curve, wherever between its samples it stands: the one peak finder.

A curve is known at samples that are even within each of its smooth pieces: of a law between its kinks, of a cam where
its motion has something to say (see `camkit.motion.resolution`), whatever cam angles an analysis was asked for.
Every local maximum among them is raised to the top of the parabola through its neighbours; around the highest the
curve is evaluated once more, and if its top is not found there, by zooming in.

A curve of which a search sees every point has all its maxima raised, and evaluated closely where the parabola is not
sure of them (see `with_tops`): the largest is within 0.1 %.  Linkages and joints are measured at the positions that an
analysis was asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from .quantities.known import certain, known
from .quantities.types import Array, Value

CLOSER, AROUND = 1 / 16, 5
"""How near to the top of a parabola the curve is evaluated again, in steps, and at how many angles."""
ZOOM, ZOOMS = 17, 3
"""Where the top is not found there: at how many angles between its neighbours, and how often, each time closer."""
SMOOTH, SHARP = 4.0, 0.02
"""How much a curve may bend at its top, over the parabola (else it has a corner), and over its size (else a needle)."""
ROUND, POINTED, NEAR = 0.5, 1.3, 1e-3
"""A top is that of the quartic if its fourth difference is below this share of the second, if by the second share it
is sharp, and if that is not farther above the parabola than this share of it."""
NEEDLE = 100.0
"""How high a needle may be, over how much it bends."""
BESIDE, DOUBTS = (-2, -1, 0, 1, 2), 4
"""The neighbours that a quartic goes through; how many places of a design a program looks closely at: three at
once were the most seen in doubt among 70 000 curves."""
LEVEL = 1e-14
"""Values that differ by less than this share of their size are the same."""
SAME = 1e-11
"""Tops that differ by less than this share are those of one shape: a return that mirrors the rise has them twice."""
EDGE, STEPS = 1e-11, 400
"""How far inside its ends a piece is sampled (a share: a kink speaks for the neighbour), and in how many steps."""


class Extreme(NamedTuple):
    """An extreme value of a curve and the cam angle (rad) at which it stands: numbers, or ``(p,)``."""

    value: Any
    cam_angle: Any


def raised(values: Array, inner: Value = True) -> Array:
    """``values`` at even steps, each local maximum raised to the top of the parabola through its neighbours.

    ``inner`` says which of them have a neighbour at an even step on both sides.

    >>> x = np.linspace(0, 3, 31)
    >>> print(f"{1 - np.sin(x).max():.0e}, {1 - raised(np.sin(x)).max():.0e}")
    4e-04, 1e-06
    """
    if not known(values):  # a program does the same at every sample, be it a maximum or not
        return _raised_everywhere(values, inner)
    tops = np.array(values, dtype=float, order="C")
    flat, at = tops.reshape(-1), _maxima(values, inner)
    flat[at] += _summit(flat[at - 1], flat[at], flat[at + 1])[1]
    return tops


def _raised_everywhere(values: Array, inner: Any) -> Array:
    left, mid, right = values[..., :-2], values[..., 1:-1], values[..., 2:]
    top = (mid >= left) & (mid > right) & np.broadcast_to(inner, values.shape)[..., 1:-1]
    tops = mid + np.where(top, _summit(left, mid, right)[1], 0.0)
    return np.concatenate([values[..., :1], tops, values[..., -1:]], axis=-1)


def _maxima(values: Array, inner: Value) -> Array:
    """Where the local maxima are, as indices of the flat array."""
    with np.errstate(invalid="ignore"):
        up = values[..., 1:] >= values[..., :-1]
    top = np.zeros(values.shape, dtype=bool)
    np.greater(up[..., :-1], up[..., 1:], out=top[..., 1:-1])
    top &= inner
    return np.flatnonzero(top)


def crests(values: Array, inner: Value = True) -> Array:
    """At each of ``values`` at even steps the largest within half a step, on the parabola through its neighbours.

    Unlike `raised` it changes smoothly where a maximum moves from one step to the next: a search by slopes can follow.

    >>> x = np.linspace(0, 3, 31)
    >>> print(f"{1 - crests(np.sin(x)).max():.0e}")
    1e-06
    """
    left, right = np.roll(values, 1, axis=-1), np.roll(values, -1, axis=-1)
    with np.errstate(invalid="ignore"):
        bend, lean = 2 * values - left - right, abs(right - left) / 2
    inside = inner & np.isfinite(bend)
    bend, lean = np.where(inside, bend, 0.0), np.where(inside, lean, 0.0)
    x = np.where(lean < bend / 2, lean / np.where(bend > 0, bend, 1.0), 0.5)
    return values + lean * x - bend * x * x / 2


def highest(f: Callable[[Array], Value], angle: Array, inner: Array) -> Extreme:
    """The largest value of ``f(cam_angle)``, sampled at the cam angles ``angle`` and then more closely; the first one.

    ``inner`` says which of them have a neighbour at the same step, without a jump in between, on both sides.

    >>> x = np.linspace(0, 3, 31)
    >>> found = highest(np.sin, x, np.isin(x, x[[0, -1]], invert=True))
    >>> print(f"{found.value:.9f} at {found.cam_angle:.4f}")
    1.000000000 at 1.5708
    """
    angle, values, inner = np.broadcast_arrays(angle, f(angle), inner)
    best = _first_of_the_highest(raised(values, inner))
    before, after = best - 1, (best + 1) % angle.shape[-1]
    inside = _at(inner, best)
    low = _at(angle, np.where(inside | _at(inner, before), before, best))
    high = _at(angle, np.where(inside | _at(inner, after), after, best))
    centre, near = _at(angle, best), CLOSER * (high - low) / 2
    around = _at(values, before), _at(values, best), _at(values, after)
    centre = centre + np.where(inside, _summit(*around)[0], 0.0) * (high - low) / 2
    value, place, bend, edge = _around(f, np.maximum(centre - near, low), np.minimum(centre + near, high), low, high)
    with np.errstate(invalid="ignore"):
        bent = 2 * around[1] - around[0] - around[2]
        smooth = (bend <= SMOOTH * (2 * CLOSER / (AROUND - 1)) ** 2 * bent) & (bent <= SHARP * abs(value))
    level = bend <= LEVEL * abs(value)
    found = edge | level | inside & smooth | ~np.isfinite(value)
    if not certain(found):
        zoomed, there = _zoomed(f, low, high)
        value, place = np.where(found, value, zoomed), np.where(found, place, there)
    return Extreme(value[..., 0], place[..., 0])


def _first_of_the_highest(tops: Array) -> Array:
    """Where the largest of each row is: of those that rounding alone tells apart the first, and the first ``nan``."""
    top = tops.max(-1, keepdims=True)
    with np.errstate(invalid="ignore"):
        alike = (tops >= top - SAME * np.abs(top)) | (tops == top) | np.isnan(tops)
    return np.argmax(alike, axis=-1, keepdims=True)


def highest_between(f: Callable[[Array], Value], ends: Sequence[Value]) -> Extreme:
    """The largest value of ``f``, which is smooth between each two of ``ends``: numbers in order, or ``(p, 1)``.

    >>> found = highest_between(lambda x: abs(x * (1 - x)), (0.0, 0.8))
    >>> print(f"{found.value:.9f} at {found.cam_angle:.6f}")
    0.250000000 at 0.500000
    """
    share = np.linspace(EDGE, 1 - EDGE, STEPS + 1)
    pieces = np.broadcast_arrays(*(low + (high - low) * share for low, high in pairwise(ends)))
    inner = np.tile((share > share[0]) & (share < share[-1]), len(pieces))
    return highest(f, np.concatenate(pieces, axis=-1), inner)


Sample = Callable[[Any, Array, Array], Array]


def with_tops(values: Array, inner: Array, sample: Sample, but: Value = False) -> Array:
    """A curve's ``values`` at even steps, each local maximum raised to its top: to 0.1 % where it may be the largest.

    That of the quartic through five of them.  Where this is in doubt ``sample(rows, at, x)`` says how high the curve is
    ``x`` steps, ``(..., k, m)``, beside the places ``at``, ``(..., k)``, of some rows, or of all (``None``); not so in
    the rows ``but``.

    >>> x = np.linspace(0, 9, 46)
    >>> inner = np.isin(x, x[[0, -1]], invert=True)
    >>> hills = with_tops(np.sin(x), inner, lambda rows, at, steps: np.sin(x[at][..., None] + 0.2 * steps))
    >>> print(f"{1 - hills[:20].max():.0e}, {1 - hills[30:].max():.0e}")
    4e-08, 1e-07
    """
    if not known(values):
        return _with_tops_everywhere(values, inner, sample, but)
    tops, at, hope = _hills(values, inner)
    row = at // len(inner)
    reach, vain = tops.max(-1).reshape(-1)[row], np.broadcast_to(but, values.shape[:-1]).reshape(-1)[row]
    at = at[(hope >= reach) & ~vain]
    if at.size:
        rows, column = np.divmod(at, len(inner))
        side = _side(inner, column)[:, None]
        top = _zoomed_top(sample, rows, column[:, None], np.minimum(side - 1, 0), np.maximum(side + 1, 0))
        tops.reshape(-1)[at] = np.maximum(top[:, 0], values.reshape(-1)[at])
    return tops


def _with_tops_everywhere(values: Array, inner: Array, sample: Sample, but: Value) -> Array:
    """The same of recorded values: a program looks at every place, and closely at as many of each design."""
    tops, hope = _hills_everywhere(values, inner)
    doubt = (hope >= tops.max(-1, keepdims=True)) & np.logical_not(np.expand_dims(but, -1))
    hope, places, doubted, found = np.where(doubt, hope, -np.inf), np.arange(len(inner)), [], []
    for _ in range(DOUBTS):
        found.append(np.argmax(hope, axis=-1, keepdims=True))
        doubted.append((places == found[-1]) & (hope > -np.inf))
        hope = np.where(places == found[-1], -np.inf, hope)
    at = np.concatenate(found, axis=-1)
    side = np.take_along_axis(np.broadcast_to(_side(inner, places), values.shape), at, -1)
    top = _zoomed_top(sample, None, at, np.minimum(side - 1, 0), np.maximum(side + 1, 0))
    top = np.maximum(top, np.take_along_axis(values, at, -1))
    for k, here in enumerate(doubted):
        tops = np.where(here, top[..., k : k + 1], tops)
    return tops


def _hills(values: Array, inner: Array) -> tuple[Array, Array, Array]:
    """``values`` with the tops of their quartics; where these may be too low, in the flat array, and up to where."""
    tops, at = np.array(values, dtype=float, order="C"), _maxima(values, inner)
    flat, high, far = values.reshape(-1), tops.reshape(-1), _far(inner, at % len(inner))
    high[at], room = _quartic_tops([flat[np.where(far, at + k, at) if abs(k) > 1 else at + k] for k in BESIDE], far)
    ends = np.flatnonzero(~inner)
    more = _room_by_ends(values, inner, ends)
    at = np.concatenate([at, np.arange(values.size).reshape(values.shape)[..., ends].reshape(-1)])
    room = np.concatenate([room, more.reshape(-1)])
    at, room = at[room > 0], room[room > 0]
    return tops, at, high[at] + room


def _hills_everywhere(values: Array, inner: Array) -> tuple[Array, Array]:
    """The same of values that are recorded, at every place; ``-inf`` where there is no doubt."""
    around, ends, place = [np.roll(values, -k, axis=-1) for k in BESIDE], np.flatnonzero(~inner), np.arange(len(inner))
    maximum = (values >= around[1]) & np.logical_not(around[3] >= values) & inner
    quartic, room = _quartic_tops(around, _far(inner, place))
    tops = np.where(maximum, quartic, values)
    place[ends] = len(inner) + np.arange(len(ends))
    room = np.concatenate([np.where(maximum, room, 0.0), _room_by_ends(values, inner, ends)], axis=-1)[..., place]
    return tops, np.where(room > 0, tops + room, -np.inf)


def _zoomed_top(sample: Sample, rows: Any, at: Array, low: Array, high: Array, zooms: int = ZOOMS) -> Array:
    """How high a curve is between ``low`` and ``high`` steps beside each of the places ``at`` of some rows."""
    x = np.expand_dims(low, -1) + np.expand_dims(high - low, -1) * np.linspace(0, 1, ZOOM)
    values = sample(rows, at, x)
    best = np.argmax(values, axis=-1, keepdims=True)
    middle = np.clip(best, 1, ZOOM - 2)
    around = np.moveaxis(np.take_along_axis(values, np.clip(middle + np.array(BESIDE), 0, ZOOM - 1), -1), -1, 0)
    top, room = _quartic_tops([*around], ((middle > 1) & (middle < ZOOM - 2))[..., 0])
    edge, highest = (best != middle)[..., 0], values.max(-1)
    top, steep = np.where(edge, highest, top), abs(highest - around[2])
    more = np.where(edge, steep > NEAR * abs(highest), room > 0)
    if zooms == 1 or certain(np.logical_not(more)):
        return top
    low, high = (np.take_along_axis(x, np.clip(best + k, 0, ZOOM - 1), -1)[..., 0] for k in (-1, 1))
    if rows is None:
        return np.where(more, np.maximum(_zoomed_top(sample, rows, at, low, high, zooms - 1), highest), top)
    some = more[:, 0]
    closer = _zoomed_top(sample, rows[some], at[some], low[some], high[some], zooms - 1)
    top[some] = np.maximum(closer, highest[some])
    return top


def _far(inner: Array, column: Array) -> Array:
    """Which samples have two neighbours on both sides."""
    return inner[column - 1] & inner[column] & inner[(column + 1) % len(inner)]


def _side(inner: Array, column: Array) -> Array:
    """On which side, +1 or -1, the piece of an end lies; 0 where there is one on both."""
    return np.where(inner[column], 0, np.where(inner[(column + 1) % len(inner)], 1, -1))


def _quartic_tops(around: Sequence[Array], far: Array) -> tuple[Array, Array]:
    """The tops of the quartics through local maxima and four neighbours; by how much they may be too low.

    0 where that is no matter.  A parabola's, where a piece ends next to the maximum and not ``far``.
    """
    left2, left, mid, right, right2 = around
    left2, right2 = np.where(far, left2, mid), np.where(far, right2, mid)
    parabola, bend = mid + _summit(left, mid, right)[1], 2 * mid - left - right
    slopes = (
        (left2 - 8 * left + 8 * right - right2) / 12,
        (16 * (left + right) - 30 * mid - left2 - right2) / 12,
        (right2 - 2 * right + 2 * left - left2) / 2,
        left2 - 4 * left + 6 * mid - 4 * right + right2,
    )
    top = np.where(far, mid + _quartic_top(*slopes), parabola)
    with np.errstate(invalid="ignore"):
        resolved = far & (abs(slopes[3]) <= ROUND * bend) & (abs(top - parabola) <= NEAR * abs(top))
        sure = resolved | (bend <= NEAR * abs(mid)) | ~np.isfinite(bend)
        room = np.where(abs(slopes[3]) <= POINTED * bend, bend, NEEDLE * bend)
    return np.where(np.isfinite(top), np.maximum(top, mid), mid), np.where(sure, 0.0, room)


def _quartic_top(*slopes: Array) -> Value:
    """How far the top of a quartic with those four derivatives at 0 lies above its value there, by Newton's method."""
    a, b, c, d = slopes
    half, sixth = d / 2, d / 6
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.minimum(np.maximum(-a / b, -1), 1)
        for _ in range(2):
            x = x - (a + x * (b + x * (c / 2 + x * sixth))) / (b + x * (c + x * half))
            x = np.minimum(np.maximum(x, -1), 1)
    return x * (a + x * (b / 2 + x * (c / 6 + x * d / 24)))


def _room_by_ends(values: Array, inner: Array, ends: Array) -> Array:
    """How much higher it may be beside a piece's end that is higher than its neighbour; 0: the top is not between."""
    way = _side(inner, ends)
    end, near, next_ = (values[..., ends + k * way] for k in range(3))
    with np.errstate(invalid="ignore"):
        bend = 2 * near - end - next_
        between = (end >= near) & (near - end + bend / 2 > 0) & (bend > NEAR * abs(end))
    return np.where(between, bend, 0.0)


def roughly_highest(angle: Value, values: Value, inner: Array) -> Extreme:
    """As `highest`, of ``values`` at the cam angles ``angle`` alone: the top of the parabola at the highest of them."""
    angle, values, inner = np.broadcast_arrays(angle, values, inner)
    best = np.argmax(values, axis=-1, keepdims=True)
    around = (_at(values, np.clip(best + k, 0, values.shape[-1] - 1)) for k in (-1, 0, 1))
    value = _at(values, best) + np.where(_at(inner, best), _summit(*around)[1], 0.0)
    return Extreme(value[..., 0], _at(angle, best)[..., 0])


def _around(
    f: Callable[[Array], Value], begin: Value, end: Value, low: Value, high: Value
) -> tuple[Array, Array, Array, Array]:
    """The highest of a few angles from ``begin`` to ``end``, where it is, how much it bends, and if it is at an end.

    It bends by ``inf`` if it seems to lie beyond them; ``low`` and ``high`` are ends, beyond which there is nothing.
    """
    step = (end - begin) / (AROUND - 1)
    angle, values = np.broadcast_arrays(begin + step * np.arange(AROUND), f(begin + step * np.arange(AROUND)))
    best = np.argmax(values, axis=-1, keepdims=True)
    middle = np.clip(best, 1, AROUND - 2)
    left, mid, right = (_at(values, middle + k) for k in (-1, 0, 1))
    share, more = _summit(left, mid, right)
    inside = best == middle
    value = _at(values, best) + np.where(inside, more, 0.0)
    place = _at(angle, best) + np.where(inside, share, 0.0) * step
    with np.errstate(invalid="ignore"):
        level = values.min(-1, keepdims=True) >= value - LEVEL * abs(value)
        bend = np.where(level, 0.0, np.where(inside, 2 * mid - left - right, np.inf))
    edge = ((best == 0) & (begin <= low)) | ((best == AROUND - 1) & (end >= high))
    return value, place, bend, edge


def _zoomed(f: Callable[[Array], Value], low: Value, high: Value) -> tuple[Array, Array]:
    """The highest between two angles: each time it is evaluated again between the best angle's neighbours."""
    for _ in range(ZOOMS):
        angle = low + (high - low) * np.linspace(0, 1, ZOOM)
        angle, values = np.broadcast_arrays(angle, f(angle))
        best = np.argmax(values, axis=-1, keepdims=True)
        low, high = _at(angle, np.maximum(best - 1, 0)), _at(angle, np.minimum(best + 1, ZOOM - 1))
    middle = np.clip(best, 1, ZOOM - 2)
    _, more = _summit(*(_at(values, middle + k) for k in (-1, 0, 1)))
    return _at(values, best) + np.where(best == middle, more, 0.0), _at(angle, best)


def _summit(left: Array, mid: Array, right: Array) -> tuple[Array, Array]:
    """Where the top of the parabola through three neighbours lies beside the highest, in steps, and how far above."""
    with np.errstate(invalid="ignore"):
        bend, lean = 2 * mid - left - right, right - left
        curved = (bend > 0) & np.isfinite(bend) & (abs(lean) <= bend)
    bend, lean = np.where(curved, bend, 1.0), np.where(curved, lean, 0.0)
    return lean / (2 * bend), lean**2 / (8 * bend)


def _at(values: Array, column: Array) -> Array:
    """The values in one column of each row, ``(1,)`` or ``(p, 1)``."""
    return values[column] if values.ndim == 1 else values[np.arange(len(values))[:, None], column]
