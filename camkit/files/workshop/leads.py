"""How a tool comes on to its path and leaves it: along arcs that are tangent to the path and touch nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...quantities.types import Array
from .arcs import ArcPath, arc_path
from .curves import Contour
from .toolpath import ToolPath

QUARTER = float(np.tan(np.pi / 8))
"""The bulge of a quarter of a circle."""
SMOOTH = 1e-4
"""A path that turns by less (rad) from one arc to the next has no corner there."""
SHORTER = (1.0, 0.5, 0.25, 0.125)
"""Shares of the radius asked for that are tried one after the other."""
SLACK = 5e-9
"""So much deeper than it may the tool lie in a wall, m: rounding."""


class Run(NamedTuple):
    """A path from where the tool goes down to where it goes up."""

    path: ArcPath
    """Open; a closed path ends where it began."""
    led: bool
    """Whether the first arc leads on to the path, and the last one off it."""


def run(path: ToolPath, number: int, tolerance: float, radius: float, clockwise: bool) -> Run:
    """The run along one of a tool's paths, with leads of a ``radius`` (m) where there is room for them."""
    centre = path.contours[number]
    way: Contour = centre.backwards if clockwise else centre
    found = arc_path(way, tolerance)
    left = path.inside[number] != clockwise
    if radius > 0 and not path.one_pass:
        for share in SHORTER:
            at = _room(found, path, share * radius, left)
            if at is not None:
                return Run(_led(_opened(found, at), share * radius, left), True)
    return Run(_opened(found, 0), False)


def _opened(path: ArcPath, at: int) -> ArcPath:
    """A closed path from one of its corners around to the same one; an open one as it is."""
    if not path.closed:
        return path
    corners = np.roll(path.corners, -at, axis=1)
    return ArcPath(path.layer, np.column_stack([corners, corners[:, 0]]), np.roll(path.bulges, -at), False)


def _room(path: ArcPath, tool: ToolPath, radius: float, left: bool) -> int | None:
    """The first corner at which the tool can come on to the path and off it; of an open one the ends."""
    leaving, arriving = tangents(path)
    last = -1 if path.closed else path.corners.shape[1] - 1
    for k in range(len(path.bulges) if path.closed else 1):
        on, off = leaving[:, k], arriving[:, k + last if path.closed else -1]
        corner = path.closed and abs(on[0] * off[1] - on[1] * off[0]) > SMOOTH
        start, end = path.corners[:, k], path.corners[:, k if path.closed else last]
        arcs = [lead(start, on, -radius, left), lead(end, off, radius, left)]
        if not corner and (tool.keep_out.depth(np.hstack(arcs)) <= SLACK).all():
            return k
    return None


def tangents(path: ArcPath) -> tuple[Array, Array]:
    """The directions in which each of its ways leaves and arrives, unit vectors ``(2, n)``."""
    chord = path.ends - path.starts
    x, y = chord / np.hypot(*chord)
    c, s = np.cos(2 * np.arctan(path.bulges)), np.sin(2 * np.arctan(path.bulges))
    return np.stack([c * x + s * y, c * y - s * x]), np.stack([c * x - s * y, c * y + s * x])


def lead(point: Array, way: Array, radius: float, left: bool) -> Array:
    """Points of the quarter of a circle by which a tool leaves a path that goes a ``way``, to its left or its right.

    With a ``radius`` below 0 it is that by which it comes on to the path, from the path's point on too, ``(2, 24)``.
    """
    (x, y), turn = way, np.linspace(0, np.pi / 2, 24)
    side = np.array([-y, x]) if left else np.array([y, -x])
    size = abs(radius)
    return point[:, None] + size * np.outer(side, 1 - np.cos(turn)) + radius * np.outer(way, np.sin(turn))


def _led(path: ArcPath, radius: float, left: bool) -> ArcPath:
    """An open path with a quarter of a circle before it and one behind it, on its left or on its right."""
    leaving, arriving = tangents(path)
    first = lead(path.corners[:, 0], leaving[:, 0], -radius, left)[:, -1]
    last = lead(path.corners[:, -1], arriving[:, -1], radius, left)[:, -1]
    bulge = QUARTER if left else -QUARTER
    corners = np.column_stack([first, path.corners, last])
    return ArcPath(path.layer, corners, np.concatenate([[bulge], path.bulges, [bulge]]), False)
