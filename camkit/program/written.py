"""Functions of numpy as numpy writes them with others, to the last digit the same; and two that it has as methods."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..quantities.known import known
from ..quantities.types import Array, Value

Axis = int | tuple[int, ...] | None


def whole(values: Array) -> Array:
    """``values`` as integers: the fraction is cut off."""
    return values.astype(int)


def picked(values: Array, places: Array, size: int) -> Array:
    """What stands in each row, of so many numbers, at the places of that row."""
    return np.take_along_axis(values, places, axis=-1)


def _broadcast_arrays(*arrays: Any) -> tuple[Array, ...]:
    shape, recording = (np.broadcast_shapes(*map(np.shape, arrays)), next(a for a in arrays if not known(a)).recording)
    return tuple(recording.call(np.broadcast_to, array, shape) for array in arrays)


def _folded(ufunc: np.ufunc) -> Callable[..., Array]:
    return lambda a, axis=None, *, keepdims=False: ufunc.reduce(a, axis=axis, keepdims=keepdims)


def _mean(a: Array, axis: Axis = None, *, keepdims: bool = False) -> Array:
    total = np.sum(a, axis, keepdims=keepdims)
    return total / (np.size(a) // np.size(total))


def _clip(a: Array, low: Value | None = None, high: Value | None = None) -> Array:
    above = a if low is None else np.maximum(a, low)
    return above if high is None else np.minimum(above, high)


def _diff(a: Array, *, axis: int = -1) -> Array:
    a = _last(a, axis)
    return a[..., 1:] - a[..., :-1]


def _trapezoid(y: Array, x: Array | None = None, dx: float = 1.0, axis: int = -1) -> Array:
    step, y = dx if x is None else np.diff(x), _last(y, axis)
    return (step * (y[..., 1:] + y[..., :-1]) / 2.0).sum(-1)


def _unwrap(p: Array, *, axis: int = -1) -> Array:
    p = _last(p, axis)
    step = np.diff(p)
    wrapped = np.mod(step + np.pi, 2 * np.pi) - np.pi
    wrapped = np.where((wrapped == -np.pi) & (step > 0), np.pi, wrapped)
    more = np.where(abs(step) < np.pi, 0.0, wrapped - step)
    return np.concatenate([p[..., :1], p[..., 1:] + np.cumsum(more, axis=-1)], axis=-1)


def _select(conditions: Sequence[Array], values: Sequence[Value], default: Value = 0) -> Value:
    for condition, value in zip(conditions[::-1], values[::-1], strict=True):
        default = np.where(condition, value, default)
    return default


def _interp(x: Array, xp: Array, fp: Array) -> Array:
    y = np.where(x == xp[-1], fp[-1], np.where(x > xp[-1], fp[-1], x))
    for k in range(len(xp) - 2, -1, -1):
        slope = (fp[k + 1] - fp[k]) / (xp[k + 1] - xp[k])
        y = np.where((x >= xp[k]) & (x < xp[k + 1]), slope * (x - xp[k]) + fp[k], y)
    return np.where(x < xp[0], fp[0], y)


def _cross(a: Array, b: Array, *, axis: int = -1) -> Array:
    (a0, a1, a2), (b0, b1, b2) = np.moveaxis(a, axis, 0), np.moveaxis(b, axis, 0)
    return np.stack(np.broadcast_arrays(a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0), axis=axis)


def _take(a: Any, indices: Any, axis: int | None = None) -> Any:
    a, size, shape = (np.ravel(a) if axis is None else _last(a, axis), np.size(indices), np.shape(indices))
    places = np.broadcast_to(np.ravel(indices), (*a.shape[:-1], size))
    return np.reshape(a.recording.call(picked, a, places, a.shape[-1]), (*a.shape[:-1], *shape))


def _take_along_axis(arr: Any, indices: Any, axis: int = -1) -> Any:
    recording, rows = ((indices if known(arr) else arr).recording, np.moveaxis(arr, axis, -1))
    found = recording.call(picked, rows, np.moveaxis(indices, axis, -1), rows.shape[-1])
    return np.moveaxis(found, -1, axis)


def _last(a: Array, axis: int) -> Array:
    if axis not in (-1, np.ndim(a) - 1):
        raise TypeError("the axis must be the last one")
    return a


BY: dict[object, Callable[..., object]] = {
    np.max: _folded(np.maximum),
    np.min: _folded(np.minimum),
    np.sum: _folded(np.add),
    np.prod: _folded(np.multiply),
    np.any: _folded(np.logical_or),
    np.all: _folded(np.logical_and),
    np.broadcast_arrays: _broadcast_arrays,
    np.ptp: lambda a, axis=None, **more: np.max(a, axis, **more) - np.min(a, axis, **more),
    np.mean: _mean,
    np.argmin: lambda a, axis=None, **more: np.argmax(-a, axis=axis, **more),
    np.cumsum: lambda a, axis=None: np.add.accumulate(np.ravel(a) if axis is None else a, axis=axis or 0),
    np.clip: _clip,
    np.diff: _diff,
    np.trapezoid: _trapezoid,
    np.unwrap: _unwrap,
    np.select: _select,
    np.interp: _interp,
    np.cross: _cross,
    np.linalg.norm: lambda x, *, axis: np.sqrt(np.add.reduce(x * x, axis=axis)),
    np.zeros_like: lambda a: np.zeros(a.shape, dtype=a.dtype),
    np.ones_like: lambda a: np.ones(a.shape, dtype=a.dtype),
    np.full_like: lambda a, value: np.broadcast_to(value, a.shape),
    np.append: lambda a, values: np.concatenate([np.ravel(a), np.ravel(values)]),
    np.take: _take,
    np.take_along_axis: _take_along_axis,
}
"""What numpy offers, and how it is written."""
