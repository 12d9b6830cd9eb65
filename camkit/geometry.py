"""Plane geometry shared by the mechanisms; points are ``(2, ..., n)``, components first."""

from __future__ import annotations

from typing import Any

import numpy as np


def rotated(points: Any, angle: Any) -> np.ndarray:
    """``points`` turned counter-clockwise by ``angle`` (rad; one angle or one per point).

    >>> rotated(np.array([1.0, 0.0]), np.pi / 2).round(6).tolist()
    [0.0, 1.0]
    """
    x, y = points
    c, s = np.cos(angle), np.sin(angle)
    return np.stack(np.broadcast_arrays(c * x - s * y, s * x + c * y))


def polar_angle(point: Any) -> Any:
    """Direction of ``point`` from the origin, rad, counter-clockwise from the x axis."""
    return np.arctan2(point[1], point[0])


def angle_opposite(side: Any, first: Any, second: Any) -> Any:
    """Angle of a triangle between sides ``first`` and ``second``, opposite ``side``; ``nan`` if none closes.

    >>> round(float(angle_opposite(5, 3, 4)), 6) == round(np.pi / 2, 6)
    True
    """
    cosine = (first**2 + second**2 - side**2) / (2 * first * second)
    with np.errstate(invalid="ignore"):
        return np.arccos(cosine)


def circle(centre: Any, radius: float, n: int = 73) -> np.ndarray:
    """A closed circle of ``n`` points, ``(2, n)``."""
    turn = np.linspace(0, 2 * np.pi, n)
    return np.stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def offset_curvature(curvature: Any, distance: Any) -> Any:
    """Curvature of the curve parallel to one of ``curvature``, ``distance`` along the outward normal.

    Convex is positive; the radius of curvature grows by ``distance``.  ``inf`` where it shrinks to nothing.
    """
    with np.errstate(divide="ignore"):
        return np.divide(curvature, 1 + distance * curvature)
