"""Paths read back from an SVG drawing: lines and arcs, as this package writes them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from ...quantities.types import Array
from .arcs import ArcPath

_STEP = re.compile(r"([MLAZ])([^MLAZ]*)")


def read_paths(drawing: str, names: tuple[str, ...]) -> Iterator[ArcPath]:
    """The paths of these classes in the order of a drawing, on the paper: mm, y downwards, bulges as they are seen."""
    for element in ElementTree.fromstring(drawing).iter("{http://www.w3.org/2000/svg}path"):
        if (name := element.get("class", "")) in names:
            corners, bulges, closed = read_path(element.get("d", ""))
            yield ArcPath(name, corners, bulges, closed)


def read_path(data: str) -> tuple[Array, Array, bool]:
    """Corners ``(2, k)`` of a path, the bulge of the way from each to the next, and whether it is closed.

    >>> corners, bulges, closed = read_path("M10 0A10 10 0 0 0 0 -10L0 0Z")
    >>> corners.T.tolist(), bulges.round(6).tolist(), closed
    ([[10.0, 0.0], [0.0, -10.0], [0.0, 0.0]], [0.414214, 0.0, 0.0], True)
    """
    corners: list[Array] = []
    bulges: list[float] = []
    closed = False
    for letter, numbers in _STEP.findall(data):
        values = np.array(numbers.split(), dtype=float)
        if letter == "Z":
            closed = True
            continue
        end = values[-2:]
        if letter != "M":
            bulges.append(_bulge(corners[-1], end, values) if letter == "A" else 0.0)
        corners.append(end)
    if closed and np.hypot(*(corners[-1] - corners[0])) < 1e-9:
        corners.pop()
    elif closed:
        bulges.append(0.0)
    return np.array(corners).T, np.array(bulges), closed


def _bulge(start: Array, end: Array, arc: Array) -> float:
    """Of an arc by its radius and flags: large, and clockwise as it is seen."""
    radius, _, _, large, clockwise, *_ = arc
    half = float(np.arcsin(min(1.0, np.hypot(*(end - start)) / (2 * radius))))
    bulge = float(np.tan((np.pi - half if large else half) / 2))
    return -bulge if clockwise else bulge
