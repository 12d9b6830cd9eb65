"""The flanks of a cam as its follower draws them: their whole envelope, undercut or not.

An analysis gives a point for each cam angle.  Where the path of a roller's centre has a corner, the roller turns about
it and draws an arc that belongs to no cam angle; where an open groove ends it draws a half circle; and where the
follower's speed jumps at the start of the turn, the last point and the first are joined.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.polynomial import polyfit

from ..geometry import rotated
from ..quantities.types import Value
from ..units import deg
from .arcs import SAME, Curve

CORNER = 2 * deg
"""A normal that turns by more between two points, and five times as far as before and after, turns on a corner."""
ARC = 91
"""How many points an arc has that belongs to no cam angle."""


@dataclass(frozen=True)
class Flank(Curve):
    """A flank by its name, with the number of the row (the cam angle) of each point; -1: a point between rows."""

    name: str
    rows: np.ndarray


def face_envelope(profile: np.ndarray, normals: np.ndarray) -> list[Flank]:
    """The one flank under a face with those normals, ``(2, n)``."""
    flank = Flank(profile, "profile", np.arange(profile.shape[1]))
    return [_joined(flank) if _same(normals[:, 0], normals[:, -1]) else flank]


def roller_envelope(theory: dict[str, np.ndarray], pitch: np.ndarray, radius: float, period: Value) -> list[Flank]:
    """The flanks by name under a roller whose centre runs along ``pitch``, ``(2, n)``, and on after a ``period``."""
    found = [_with_corners(name, points, pitch, radius) for name, points in theory.items()]
    if len(theory) > 1 and not _same(pitch[:, 0] + period, pitch[:, -1]):
        inner = theory["profile"]
        found += [_groove_end(inner[:, k], pitch[:, k], pitch[:, k] - pitch[:, j]) for k, j in ((0, 1), (-1, -2))]
    return found


def _same(one: Value, other: Value) -> bool:
    return bool(np.allclose(one, other, rtol=0, atol=SAME))


def _joined(flank: Flank, arc: np.ndarray | None = None) -> Flank:
    """The flank closed, by an ``arc`` or a straight line, if it is not."""
    if flank.closed:
        return flank
    arc = np.empty((2, 0)) if arc is None else arc
    rows = np.append(flank.rows, np.full(arc.shape[1] + 1, -1))
    return Flank(np.hstack([flank.points, arc, flank.points[:, :1]]), flank.name, rows)


def _with_corners(name: str, points: np.ndarray, pitch: np.ndarray, radius: float) -> Flank:
    """A flank with the arcs that a roller makes where its path has a corner."""
    rows = np.arange(points.shape[1])
    if not radius:
        return Flank(points, name, rows)
    direction = np.unwrap(np.arctan2(*(points - pitch)[::-1]))
    parts, numbers, done = [], [], 0
    for i in _corners(direction):
        turning = np.linspace(
            direction[i], direction[i + 1], int(abs(direction[i + 1] - direction[i]) / CORNER) * 4 + 2
        )
        arc = _around(_meeting(pitch[:, i - 2 : i + 1], pitch[:, i + 1 : i + 4]), radius, turning)
        parts += [points[:, done : i + 1], arc]
        numbers += [rows[done : i + 1], np.full(len(turning), -1)]
        done = i + 1
    flank = Flank(np.hstack([*parts, points[:, done:]]), name, np.concatenate([*numbers, rows[done:]]))
    if not _same(pitch[:, 0], pitch[:, -1]):
        return flank
    back = (direction[0] - direction[-1] + np.pi) % (2 * np.pi) - np.pi
    return _joined(flank, _around(pitch[:, 0], radius, direction[-1] + np.linspace(0, back, ARC)[1:-1]))


def _corners(direction: np.ndarray) -> list[int]:
    """After which points the normal, in that ``direction`` (rad), turns on a corner; not next to an end."""
    turned = abs(np.diff(direction))
    beside = np.maximum(np.append(turned[1:], 0), np.insert(turned[:-1], 0, 0))
    return [int(i) for i in np.flatnonzero((turned > CORNER) & (turned > 5 * beside)) if 2 <= i < len(direction) - 3]


def _around(centre: np.ndarray, radius: float, direction: np.ndarray) -> np.ndarray:
    """Points of a circle, ``(2, n)``."""
    return np.asarray(centre[:, None] + radius * np.array([np.cos(direction), np.sin(direction)]))


def _meeting(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The corner between three points of a path before it and three after it, all at even steps."""
    one, other = polyfit((-2, -1, 0), before.T, 2), polyfit((1, 2, 3), after.T, 2)
    apart = one - other
    turn = apart[1] / np.hypot(*apart[1])
    steps = np.roots((apart @ turn)[::-1]).real
    step = np.clip(steps[abs(steps - 0.5).argmin()], 0, 1)
    return np.asarray(np.array([1, step, step**2]) @ (one + other) / 2)


def _groove_end(inner: np.ndarray, centre: np.ndarray, onward: np.ndarray) -> Flank:
    """The half circle with which an open groove ends, from its inner to its outer flank."""
    spoke = inner - centre
    sense = np.sign(spoke[0] * onward[1] - spoke[1] * onward[0])
    points = centre[:, None] + rotated(spoke[:, None], sense * np.linspace(0, np.pi, ARC))
    return Flank(points, "groove end", np.full(ARC, -1))
