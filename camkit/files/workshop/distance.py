"""How far points lie from a curve."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...quantities.types import Array

FINE = 8
"""Into how many parts a step of a curve is divided to find the nearest of them."""
ROUNDS = 4
"""Of stepping along the tangent to the foot of a point."""
Way = Callable[[Array], tuple[Array, Array]]
"""Points and derivatives of a curve, ``(2, n)`` or ``(3, n)``, at places along it."""


def from_curve(curve: Way, steps: int, points: Array) -> Array:
    """From each of ``points`` near a curve, ``(2, n)`` or ``(3, n)``, to its nearest place from 0 to ``steps``.

    >>> def circle(place):
    ...     x, y = np.cos(place), np.sin(place)
    ...     return np.stack([x, y]), np.stack([-y, x])
    >>> from_curve(circle, 3, np.array([[0.0, 0.0, 1.001], [0.999, 1.002, 0.0]])).round(9).tolist()
    [0.001, 0.002, 0.001]
    """
    from scipy.spatial import cKDTree

    place = cKDTree(curve(np.linspace(0, steps, steps * FINE + 1))[0].T).query(points.T)[1] / FINE
    for _ in range(ROUNDS):
        foot, way = curve(place)
        place = np.clip(place + ((points - foot) * way).sum(0) / (way * way).sum(0), 0, steps)
    return np.sqrt(((points - curve(place)[0]) ** 2).sum(0))
