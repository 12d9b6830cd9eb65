"""Functions of numpy as numpy writes them with others: to the last digit the same."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..quantities.known import known


def _broadcast_arrays(*arrays: Any) -> tuple[Any, ...]:
    shape, recording = np.broadcast_shapes(*map(np.shape, arrays)), next(a for a in arrays if not known(a)).recording
    return tuple(recording.call(np.broadcast_to, array, shape) for array in arrays)


def _folded(ufunc: Any) -> Any:
    def fold(a: Any, axis: Any = None, *, keepdims: bool = False) -> Any:
        return ufunc.reduce(a, axis=axis, keepdims=keepdims)

    return fold


def _ptp(a: Any, axis: Any = None, *, keepdims: bool = False) -> Any:
    return np.max(a, axis, keepdims=keepdims) - np.min(a, axis, keepdims=keepdims)


def _mean(a: Any, axis: Any = None, *, keepdims: bool = False) -> Any:
    total = np.sum(a, axis, keepdims=keepdims)
    return total / (np.size(a) // np.size(total))


def _argmin(a: Any, axis: Any = None, *, keepdims: bool = False) -> Any:
    return np.argmax(-a, axis=axis, keepdims=keepdims)


def _cumsum(a: Any, axis: Any = None) -> Any:
    return np.add.accumulate(np.ravel(a) if axis is None else a, axis=-1 if axis is None else axis)


def _clip(a: Any, low: Any = None, high: Any = None) -> Any:
    above = a if low is None else np.maximum(a, low)
    return above if high is None else np.minimum(above, high)


def _diff(a: Any, n: int = 1, axis: int = -1) -> Any:
    for _ in range(n):
        along = np.moveaxis(a, axis, -1)
        a = np.moveaxis(along[..., 1:] - along[..., :-1], -1, axis)
    return a


def _trapezoid(y: Any, x: Any = None, dx: float = 1.0, axis: int = -1) -> Any:
    if axis not in (-1, np.ndim(y) - 1):
        raise TypeError("the axis must be the last one")
    step = dx if x is None else np.diff(x)
    return (step * (y[..., 1:] + y[..., :-1]) / 2.0).sum(-1)


def _unwrap(p: Any, *, axis: int = -1) -> Any:
    along = np.moveaxis(p, axis, -1)
    step = np.diff(along)
    wrapped = np.mod(step + np.pi, 2 * np.pi) - np.pi
    wrapped = np.where((wrapped == -np.pi) & (step > 0), np.pi, wrapped)
    more = np.where(abs(step) < np.pi, 0.0, wrapped - step)
    turned = np.concatenate([along[..., :1], along[..., 1:] + np.cumsum(more, axis=-1)], axis=-1)
    return np.moveaxis(turned, -1, axis)


def _select(conditions: Sequence[Any], values: Sequence[Any], default: Any = 0) -> Any:
    for condition, value in zip(conditions[::-1], values[::-1], strict=True):
        default = np.where(condition, value, default)
    return default


def _interp(x: Any, xp: Any, fp: Any) -> Any:
    y = np.where(x == xp[-1], fp[-1], np.where(x > xp[-1], fp[-1], x))
    for k in range(len(xp) - 2, -1, -1):
        slope = (fp[k + 1] - fp[k]) / (xp[k + 1] - xp[k])
        y = np.where((x >= xp[k]) & (x < xp[k + 1]), slope * (x - xp[k]) + fp[k], y)
    return np.where(x < xp[0], fp[0], y)


def _cross(a: Any, b: Any, *, axis: int = -1) -> Any:
    (a0, a1, a2), (b0, b1, b2) = np.moveaxis(a, axis, 0), np.moveaxis(b, axis, 0)
    parts = (a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0)
    return np.stack(np.broadcast_arrays(*parts), axis=axis)


def _norm(x: Any, *, axis: Any) -> Any:
    return np.sqrt(np.add.reduce(x * x, axis=axis))


def _zeros_like(a: Any) -> Any:
    return np.zeros(a.shape, dtype=a.dtype)


def _ones_like(a: Any) -> Any:
    return np.ones(a.shape, dtype=a.dtype)


def _full_like(a: Any, value: Any) -> Any:
    return np.broadcast_to(value, a.shape)


def _append(a: Any, values: Any, axis: int | None = None) -> Any:
    return np.concatenate([np.ravel(a), np.ravel(values)] if axis is None else [a, values], axis=axis or 0)


def _outer(a: Any, b: Any) -> Any:
    return np.ravel(a)[:, None] * np.ravel(b)


BY: dict[Any, Any] = {
    np.broadcast_arrays: _broadcast_arrays,
    np.max: _folded(np.maximum),
    np.min: _folded(np.minimum),
    np.sum: _folded(np.add),
    np.prod: _folded(np.multiply),
    np.any: _folded(np.logical_or),
    np.all: _folded(np.logical_and),
    np.ptp: _ptp,
    np.mean: _mean,
    np.argmin: _argmin,
    np.cumsum: _cumsum,
    np.clip: _clip,
    np.diff: _diff,
    np.trapezoid: _trapezoid,
    np.unwrap: _unwrap,
    np.select: _select,
    np.interp: _interp,
    np.cross: _cross,
    np.linalg.norm: _norm,
    np.zeros_like: _zeros_like,
    np.ones_like: _ones_like,
    np.full_like: _full_like,
    np.outer: _outer,
    np.append: _append,
}
"""What numpy offers, and how it is written."""
