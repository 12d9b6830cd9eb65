"""Where a function of an angle that has no more than a second harmonic is zero.

Such a function is ``c_0 + c_1 z + c_2 z^2`` plus its conjugate with ``z = exp(i phi)``: its zeros are the roots
on the unit circle of a quartic in ``z``.  With ``z = z_0 (1 + i t) / (1 - i t)`` the circle becomes the real line
and the quartic real, so no tolerance has to say which root lies on the circle.  ``z_0`` is turned so that the
quartic never loses its leading term.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..quantities.types import Array, Value

SAMPLES = 2 * np.pi * np.arange(5) / 5
"""Five angles are enough to know a function with two harmonics."""
ROUNDING = 1e-12
"""A discriminant that is negative by no more than this is a linkage stretched out or folded."""


def reaches(a: Value, b: Any, k: Any) -> Array:
    """Whether ``a sin(x) + b cos(x) + k = 0`` has a solution, rounding forgiven."""
    return a**2 + b**2 - k**2 >= -ROUNDING * (1 + k**2)


def harmonics(function: Callable[[Any], Any]) -> np.ndarray:
    """The complex ``c_0, c_1, c_2`` of ``function``, ``(..., 3)``: its value is ``re(c_0 + c_1 z + c_2 z^2)``.

    >>> harmonics(lambda angle: 1 + 2 * np.cos(angle) + 3 * np.sin(2 * angle)).round(9) + 0
    array([1.+0.j, 2.+0.j, 0.-3.j])
    """
    return np.fft.rfft(function(SAMPLES))[..., :3] * np.array([1, 2, 2]) / 5


def value(c: np.ndarray, angle: Value) -> Array:
    """The function with harmonics ``c`` ``(..., 3)`` at angles ``(..., n)``."""
    z = np.exp(1j * np.asarray(angle))
    return (c[..., 0:1] + c[..., 1:2] * z + c[..., 2:3] * z**2).real


def slope(c: np.ndarray) -> np.ndarray:
    """The harmonics of the derivative with respect to the angle."""
    return c * 1j * np.arange(3)


def zeros(c: np.ndarray) -> np.ndarray:
    """The angles in [0, 2 pi) where the function is zero, ``(..., 4)``, growing; ``nan`` where there are fewer.

    >>> np.degrees(zeros(harmonics(lambda angle: np.cos(angle) - 0.5))).round(6).tolist()
    [60.0, 300.0, nan, nan]
    """
    start = _far_from_zero(c)
    quartic = _real_quartic(c * np.exp(1j * start * np.arange(3)))
    with np.errstate(divide="ignore", invalid="ignore"):
        monic = quartic[..., 1:] / quartic[..., :1]
    known = np.isfinite(monic).all(-1, keepdims=True)
    companion = np.zeros((*monic.shape, 4))
    companion[..., 1:, :3] = np.eye(3)
    companion[..., 0, :] = -np.where(known, monic, 1.0)
    t = np.linalg.eigvals(companion)
    angle = np.mod(start + 2 * np.arctan(t.real), 2 * np.pi)
    return np.sort(np.where(known & (t.imag == 0), angle, np.nan), axis=-1)


def _far_from_zero(c: np.ndarray) -> np.ndarray:
    """Half a turn from the sample at which the function is largest, ``(..., 1)``."""
    largest = np.argmax(abs(value(c, SAMPLES)), axis=-1, keepdims=True)
    return SAMPLES[largest] - np.pi


def _real_quartic(c: np.ndarray) -> np.ndarray:
    """Coefficients of ``(1 + t^2)^2`` times the function at ``angle = 2 arctan t``, highest power first."""
    (c0, c1, c2), (_, s1, s2) = np.moveaxis(c.real, -1, 0), np.moveaxis(-c.imag, -1, 0)
    terms = (c0 - c1 + c2, 2 * s1 - 4 * s2, 2 * c0 - 6 * c2, 2 * s1 + 4 * s2, c0 + c1 + c2)
    return np.stack(terms, axis=-1)
