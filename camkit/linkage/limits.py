"""Where a function of an angle that has no more than a second harmonic is zero.

Such a function is ``c_0 + c_1 cos + c_2 cos 2 + s_1 sin + s_2 sin 2`` of the angle.  With ``t = tan(angle / 2)`` it is
a quartic in ``t`` over ``(1 + t^2)^2``, of which only real zeros count, so no tolerance has to say which they are.  The
angle is turned so that the quartic never loses its leading term.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..quantities.types import Array, Value

SAMPLES = 2 * np.pi * np.arange(5) / 5
"""Five angles are enough to know a function with two harmonics."""
WEIGHTS = np.stack([0.5 + 0 * SAMPLES, *(wave(k * SAMPLES) for wave in (np.cos, np.sin) for k in (1, 2))]) * 2 / 5
"""What is each harmonic's share of its values there."""
ROUNDING = 1e-12
"""A discriminant that is negative by no more than this is a linkage stretched out or folded."""
NEAR, SAME = 1e-5, 1e-14
"""By what share no rounding displaces a zero, and what of the parts of a difference is 0 but for rounding."""


def reaches(a: Array, b: Array, k: Array) -> Array:
    """Whether ``a sin(x) + b cos(x) + k = 0`` has a solution, rounding forgiven."""
    return a**2 + b**2 - k**2 >= -ROUNDING * (1 + k**2)


def harmonics(function: Callable[[Array], Array]) -> np.ndarray:
    """``c_0, c_1, c_2, s_1, s_2`` of ``function``, ``(..., 5)``.

    >>> harmonics(lambda angle: 1 + 2 * np.cos(angle) + 3 * np.sin(2 * angle)).round(9) + 0
    array([1., 2., 0., 0., 3.])
    """
    return (function(SAMPLES)[..., None, :] * WEIGHTS).sum(-1)


def value(c: np.ndarray, angle: Value) -> Array:
    """The function with harmonics ``c`` ``(..., 5)`` at angles ``(..., n)``."""
    c0, c1, c2, s1, s2 = np.moveaxis(c[..., None, :], -1, 0)
    return c0 + c1 * np.cos(angle) + c2 * np.cos(2 * angle) + s1 * np.sin(angle) + s2 * np.sin(2 * angle)


def slope(c: np.ndarray) -> np.ndarray:
    """The harmonics of the derivative with respect to the angle."""
    return c[..., [0, 3, 4, 1, 2]] * np.array([0, 1, 2, -1, -2])


def zeros(c: np.ndarray) -> np.ndarray:
    """The angles in [0, 2 pi) where the function is zero, ``(..., 4)``, growing; ``nan`` where there are fewer.

    >>> np.degrees(zeros(harmonics(lambda angle: np.cos(angle) - 0.5))).round(6).tolist()
    [60.0, 300.0, nan, nan]
    """
    start = _far_from_zero(c)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = _real_zeros(*_monic_quartic(_turned(c, start[..., 0])))
    return np.sort(np.mod(start + 2 * np.arctan(t), 2 * np.pi), axis=-1)


def _far_from_zero(c: np.ndarray) -> Array:
    """Half a turn from the sample at which the function is largest, ``(..., 1)``."""
    return 2 * np.pi / 5 * np.argmax(abs(value(c, SAMPLES)), axis=-1, keepdims=True) - np.pi


def _turned(c: np.ndarray, by: Array) -> tuple[Array, ...]:
    """The harmonics of the function of the angle beyond ``by``."""
    c0, c1, c2, s1, s2 = np.moveaxis(c, -1, 0)
    cos, sin, cos2, sin2 = np.cos(by), np.sin(by), np.cos(2 * by), np.sin(2 * by)
    return c0, c1 * cos + s1 * sin, c2 * cos2 + s2 * sin2, s1 * cos - c1 * sin, s2 * cos2 - c2 * sin2


def _monic_quartic(c: tuple[Array, ...]) -> tuple[Array, ...]:
    """Of ``(1 + t^2)^2`` times the function at ``angle = 2 arctan t``, over that of ``t^4``, of ``t^3`` first."""
    c0, c1, c2, s1, s2 = c
    return tuple(x / (c0 - c1 + c2) for x in (2 * s1 - 4 * s2, 2 * c0 - 6 * c2, 2 * s1 + 4 * s2, c0 + c1 + c2))


def _real_zeros(a: Array, b: Array, c: Array, d: Array) -> Array:
    """The real ``t`` at which ``t^4 + a t^3 + b t^2 + c t + d`` is 0, ``(..., 4)``; ``nan`` where there are fewer.

    Ferrari: with ``t = y - a / 4`` it is ``(y^2 + u)^2 - (m y - w)^2``, where ``u`` is the largest root of a cubic.
    """
    p, q = b - 3 / 8 * a * a, c - a * b / 2 + a * a * a / 8
    r = d - a * c / 4 + a * a * b / 16 - 3 / 256 * a * a * a * a
    u = _largest_root(-p / 2, -r, p * r / 2 - q * q / 8)
    m, w = np.sqrt(np.maximum(2 * u - p, 0)), np.sqrt(np.maximum(u * u - r, 0))
    m, w = np.where(m >= w, m, abs(q) / (2 * w)), np.where(m >= w, q / (2 * m), np.copysign(w, q))
    w = np.where(m > 0, w, np.sqrt(np.maximum(u * u - r, 0)))
    side, root = m * m / 4 - u, m / 2
    apart = np.sqrt(np.stack([side - w, side - w, side + w, side + w], axis=-1)) * np.array([1, -1, 1, -1])
    t = np.stack([root, root, -root, -root], axis=-1) + apart - a[..., None] / 4
    return _newton(t, a, b, c, d)


def _largest_root(a: Array, b: Array, c: Array) -> Array:
    """The largest real ``x`` at which ``x^3 + a x^2 + b x + c`` is 0."""
    p, q = b / 3 - a * a / 9, (a * (2 / 27 * a * a - b / 3) + c) / 2
    several = q * q + p * p * p <= SAME * q * q
    size = np.sqrt(np.where(several, -p, 1.0))
    angle = np.arccos(np.clip(-q / (size * size * size), -1, 1)) / 3
    part = np.cbrt(abs(q) + np.sqrt(np.maximum(q * q + p * p * p, 0)))
    alone = np.where(part > 0, np.copysign(part - p / part, -q), 0.0)
    return _newton((np.where(several, 2 * size * np.cos(angle), alone) - a / 3)[..., None], a, b, c)[..., 0]


def _newton(x: Any, *c: Any) -> Array:
    """A zero of ``x^n + c_0 x^(n-1) + ...``, without the rounding by which ``x`` ``(..., k)`` misses it."""
    for _ in range(2):
        f, slope = 1.0, 0.0
        for k in c:
            slope = slope * x + f
            f = f * x + k[..., None]
        step = f / slope
        x = x - np.where(abs(step) < NEAR * (1 + abs(x)), step, 0.0)
    return x
