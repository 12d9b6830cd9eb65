"""The profile's radius in given directions, exact: where rays from the cam's axis cross its contours.

From point to point of a contour runs the cubic that has their points and tangents (Hermite).  How far it lies beside a
ray is a cubic too: between the places where that turns back it crosses the ray once or not at all.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.polynomial.polynomial import polyval

from ...quantities.types import Array
from .contours import contours
from .curves import Stretch, cubics
from .subject import Subject

NAMES = {"CAM": ("profile",), "GROOVE": ("inner wall", "outer wall"), "PITCH": ("pitch curve",)}
"""What the curves of a layer are called; of two the first is the one nearest to the axis."""
ON = 1e-9
"""An end of a curve this near (m) to a ray is on it: curves that meet leave gaps of rounding."""
HALVINGS = 60
"""Of a piece of a curve that crosses a ray."""


def polar(subject: Subject, direction: Array) -> dict[str, Array]:
    """The radius (m) of each curve of a cam in every ``direction`` (rad, from the drawing's x axis), by its name.

    Of a plate the ``profile``, of a groove the ``inner wall`` and the ``outer wall``, and the ``pitch curve`` of a
    roller.  Where a ray crosses a curve more than once it is the outermost point, of an inner wall the innermost;
    ``nan`` where it crosses nothing, as beside an open groove.

    >>> from camkit import TranslatingRollerCam, mm
    >>> from .subject import subjects
    >>> (cam,) = subjects(TranslatingRollerCam())
    >>> {name: (radius / mm).round(6).tolist() for name, radius in polar(cam, np.array([np.pi / 2])).items()}
    {'inner wall': [30.0], 'outer wall': [46.0], 'pitch curve': [38.0]}

    Raises ``ValueError`` for a drum, which is drawn unrolled.
    """
    if subject.drum:
        raise ValueError(f"{subject.kind} is a drum, which has no radii by direction; its other tables can be written")
    found: dict[str, Array] = {}
    curves = contours(subject)
    for layer, names in NAMES.items():
        stretches = [stretch for curve in curves if curve.layer == layer for stretch in curve.stretches]
        if stretches:
            inner, outer = radii(stretches, direction)
            found |= dict(zip(names, (inner, outer) if len(names) > 1 else (outer,), strict=True))
    return found


def radii(stretches: Iterable[Stretch], direction: Array) -> tuple[Array, Array]:
    """The least and the largest distance (m) at which a ray from the origin crosses curves, for each ``direction``.

    >>> t = np.linspace(0, 2 * np.pi, 181)  # a circle of R 50 with its centre 25 below
    >>> circle = Stretch(50 * np.array([np.cos(t), np.sin(t) - 0.5]), np.array([-np.sin(t), np.cos(t)]))
    >>> _, radius = radii([circle], np.array([0.0, np.pi / 2]))
    >>> radius.round(6).tolist()
    [43.30127, 25.0]
    """
    inner, outer = np.full(len(direction), np.inf), np.full(len(direction), -np.inf)
    for stretch in stretches:
        ends = (each[:, part] for part in (slice(None, -1), slice(1, None)) for each in stretch)
        ray, radius = _crossings(cubics(*ends), direction)
        np.minimum.at(inner, ray, radius)
        np.maximum.at(outer, ray, radius)
    met = np.isfinite(outer)
    return np.where(met, inner, np.nan), np.where(met, outer, np.nan)


def _crossings(cubics: Array, direction: Array) -> tuple[Array, Array]:
    """Which rays cross cubics, and how far from the origin (m)."""
    along = np.stack([np.cos(direction), np.sin(direction)])
    across = np.stack([-along[1], along[0]])
    ray, curve = np.nonzero(_near(np.tensordot(across, cubics, (0, 1))))
    beside, away = ((cubics[:, :, curve] * way[:, ray]).sum(1) for way in (across, along))
    ends = _turns(beside)
    values = polyval(ends, beside, tensor=False)
    values = np.where(abs(values) <= ON, 0.0, values)
    piece, k = np.nonzero(values[:-1] * values[1:] <= 0)
    place = _root(beside[:, k], ends[piece, k], ends[piece + 1, k])
    radius = polyval(place, away[:, k], tensor=False)
    return ray[k][radius > 0], radius[radius > 0]


def _near(beside: Array) -> Array:
    """Which cubics ``(rays, 4, n)`` can be 0 between 0 and 1: their control values do not all have the same sign."""
    a, b, c, d = np.moveaxis(beside, 1, 0)
    control = np.stack([a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d])
    return (control.min(0) <= ON) & (control.max(0) >= -ON)


def _turns(beside: Array) -> Array:
    """0, 1 and the places between them at which cubics ``(4, k)`` turn back, in order, ``(4, k)``."""
    _, b, c, d = beside
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(np.maximum(c * c - 3 * b * d, 0.0))
        q = -(c + np.copysign(root, c))
        turns = np.stack([q / (3 * d), b / q])
    inside = np.clip(np.where(np.isfinite(turns), turns, 0.0), 0, 1)
    return np.concatenate([np.zeros((1, len(b))), np.sort(inside, axis=0), np.ones((1, len(b)))])


def _root(beside: Array, low: Array, high: Array) -> Array:
    """Where cubics ``(4, k)`` that rise or fall from ``low`` to ``high`` are 0, by halving."""
    way = np.sign(polyval(high, beside, tensor=False) - polyval(low, beside, tensor=False))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        before = way * polyval(middle, beside, tensor=False) < 0
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return high
