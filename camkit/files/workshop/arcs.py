"""Contours as arcs: the fewest that keep a tolerance and go through exact points along exact tangents.

Between two points two arcs, tangent to each other, keep the tangents at both: a biarc.  Of all such pairs the one whose
control points are as far from both ends is taken.  From each point the longest biarc within the tolerance goes on; none
crosses a corner.

Source: Bolton, Biarc curves, Computer-Aided Design 7 (1975).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ...quantities.types import Array
from .curves import Contour, Stretch

FINE = 8
"""Places at which each step of a stretch is compared with its arcs."""
KEPT = 0.995
"""Of the tolerance, where places are compared: between them an arc may be a little farther."""
STRAIGHT = 1e-8
"""A bulge below this is that of a line."""
MOST = np.tan(np.pi / 4) * (1 + 1e-9)
"""No arc turns by more than half a turn: its bulge is 1."""
ROUND = 1e-10
"""Arcs that would bow by less than about this (m) from each other are one."""
BLOCK = 16
"""How many points are compared with arcs at once."""


class ArcPath(NamedTuple):
    """Lines and arcs from corner to corner; an arc that turns by ``theta`` to the left has the bulge ``tan(theta/4)``.

    >>> circle = ArcPath("CAM", np.array([[1.0, -1.0], [0.0, 0.0]]), np.array([1.0, 1.0]), True)
    >>> distances(circle, np.array([[0.0, 0.0, 0.6], [0.0, 3.0, 0.8]])).round(12).tolist()
    [1.0, 2.0, 0.0]
    """

    layer: str
    corners: Array
    """``(2, k)``, m."""
    bulges: Array
    """Of the way from each corner to the next, ``(k,)`` if it is closed, or else ``(k - 1,)``."""
    closed: bool

    @property
    def starts(self) -> Array:
        """Where each arc begins, ``(2, n)``."""
        return self.corners[:, : len(self.bulges)]

    @property
    def ends(self) -> Array:
        """Where each arc ends, ``(2, n)``."""
        return np.roll(self.corners, -1, axis=1)[:, : len(self.bulges)]

    def points(self, steps: int) -> Array:
        """Points at even steps on every arc, and at the end, ``(2, n)``."""
        start, chord, bulge = self.starts[:, :, None], (self.ends - self.starts)[:, :, None], self.bulges[:, None]
        u = np.arange(steps) / steps
        theta = 4 * np.arctan(bulge)
        bent = abs(bulge) > STRAIGHT
        safe = np.where(bent, theta, 1.0)
        share = np.where(bent, np.sin(safe * u / 2) / np.sin(safe / 2), u)  # of the chord, turned
        turn = np.where(bent, safe * (u - 1) / 2, 0.0)
        x, y = share * np.cos(turn) * np.ones_like(theta), share * np.sin(turn)
        points = start + np.stack([x * chord[0] - y * chord[1], x * chord[1] + y * chord[0]])
        return np.column_stack([points.reshape(2, -1), self.ends[:, -1]])


def arc_path(contour: Contour, tolerance: float) -> ArcPath:
    """The contour as arcs that lie nowhere farther from it than the tolerance (m).

    >>> from .contours import contours
    >>> from .subject import subjects
    >>> from camkit import TranslatingRollerCam
    >>> inner, *_ = contours(subjects(TranslatingRollerCam())[0])
    >>> path = arc_path(inner, 1e-6)
    >>> len(path.bulges) < 80 and float(distances(path, inner.points).max()) <= 1e-6
    True
    """
    corners, bulges = zip(*(_arcs(stretch.finer(FINE), tolerance) for stretch in contour.stretches), strict=True)
    last = [] if contour.closed else [contour.stretches[-1].points[:, -1:]]
    return ArcPath(contour.layer, np.hstack([*corners, *last]), np.concatenate(bulges), contour.closed)


def dense_path(contour: Contour, steps: int = 3) -> ArcPath:
    """The contour as many arcs, a nanometre from it at most: ``2 * steps`` from each point to the next."""
    corners, bulges = zip(*(biarcs(stretch.finer(steps)) for stretch in contour.stretches), strict=True)
    last = [] if contour.closed else [corners[-1][:, -1:]]
    return ArcPath(
        contour.layer, np.hstack([*(c[:, :-1] for c in corners), *last]), np.concatenate(bulges), contour.closed
    )


def chord_path(contour: Contour, tolerance: float) -> ArcPath:
    """The contour as chords that lie nowhere farther from it than the tolerance (m)."""
    corners = [_chords(stretch, tolerance) for stretch in contour.stretches]
    last = [] if contour.closed else [contour.stretches[-1].points[:, -1:]]
    found = np.hstack([*corners, *last])
    return ArcPath(contour.layer, found, np.zeros(found.shape[1] - 1 + contour.closed), contour.closed)


def _chords(stretch: Stretch, tolerance: float) -> Array:
    """Corners but for the last."""
    (px, py), (tx, ty) = (x[:, :-1] for x in stretch)
    (qx, qy), (ux, uy) = (x[:, 1:] for x in stretch)
    bow = np.hypot(qx - px, qy - py) * abs(np.arctan2(tx * uy - ty * ux, tx * ux + ty * uy)) / 8
    fine = stretch.finer(min(512, max(2, int(np.ceil(16 * np.sqrt(bow.max() / tolerance)))))).points

    def off(i: int, j: int) -> float:
        between = fine[:, i : j + 1]
        return float(_from_line(between, between[:, :1], between[:, -1:]).max())

    return fine[:, list(spans(fine.shape[1] - 1, off, tolerance))[:-1]]


def _arcs(fine: Stretch, tolerance: float) -> tuple[Array, Array]:
    """Corners but for the last, and bulges."""

    def off(i: int, j: int) -> float:
        with np.errstate(divide="ignore", invalid="ignore"):  # around a whole circle there is none
            corners, bulges = biarcs(Stretch(fine.points[:, [i, j]], fine.tangents[:, [i, j]]))
        if not (abs(bulges) <= MOST).all():
            return np.inf
        between = fine.points[:, i : j + 1, None]
        return float(_from_arc(between, corners[:, None, :-1], corners[:, None, 1:], bulges).min(-1).max())

    knots = list(spans(fine.points.shape[1] - 1, off, tolerance))
    corners, bulges = biarcs(Stretch(fine.points[:, knots], fine.tangents[:, knots]))
    return _without_joints(corners, bulges)


def spans(last: int, off: Callable[[int, int], float], tolerance: float) -> Iterator[int]:
    """Numbers from 0 to ``last``, each as far from the one before as keeps ``off(one, other)`` within the tolerance."""
    start, reach = 0, 1
    yield start
    while start < last:
        good, bad = 1, last - start + 1
        while good + 1 < bad:
            trial = min(max(reach, good + 1), bad - 1)
            within = off(start, start + trial) <= KEPT * tolerance
            good, bad = (trial, bad) if within else (good, trial)
            reach = good + good // 2 + 1 if start + bad > last else (good + bad) // 2
        start, reach = start + good, good
        yield start


def biarcs(stretch: Stretch) -> tuple[Array, Array]:
    """Two arcs from each point to the next: corners ``(2, 2n + 1)`` and bulges ``(2n,)`` for ``n + 1`` points."""
    (p, q), (t, u) = ((x[:, :-1], x[:, 1:]) for x in stretch)
    way = q - p
    along, square = (way * (t + u)).sum(0), (way**2).sum(0)
    size = square / (along + np.sqrt(along**2 + 2 * (1 - (t * u).sum(0)) * square))
    middle = (p + q + size * (t - u)) / 2
    corners = np.stack([p, middle], axis=2).reshape(2, -1)
    bulges = np.stack([_bulge(t, middle - p), -_bulge(-u, middle - q)], axis=1).ravel()
    return np.column_stack([corners, q[:, -1]]), bulges


def _bulge(tangent: Array, chord: Array) -> Array:
    """``tan(theta / 4)`` of an arc that leaves along a tangent: its chord turns from that by ``theta / 2``."""
    turn = np.arctan2(tangent[0] * chord[1] - tangent[1] * chord[0], (tangent * chord).sum(0))
    return np.tan(turn / 2)


def _without_joints(corners: Array, bulges: Array) -> tuple[Array, Array]:
    """Without corners at which an arc goes on about the same centre; the last corner is left out."""
    turns, chords = 4 * np.arctan(bulges), np.hypot(*np.diff(corners))
    curvature = 2 * np.sin(turns / 2) / chords
    kept, found = [0], [float(turns[0])]
    for k in range(1, len(turns)):
        whole = found[-1] + turns[k]
        way = np.hypot(*(corners[:, k + 1] - corners[:, kept[-1]])) + chords[k]
        if abs(curvature[k] - curvature[kept[-1]]) * way**2 < ROUND and abs(whole) <= np.pi:
            found[-1] = whole
        else:
            kept.append(k)
            found.append(float(turns[k]))
    return corners[:, kept], np.tan(np.array(found) / 4)


def distances(path: ArcPath, points: Array) -> Array:
    """How far points ``(2, n)`` are from the path, m."""
    starts, ends, bulges = path.starts, path.ends, path.bulges
    middle = (starts + ends) / 2
    reach = np.hypot(*(ends - starts)) / 2 * np.maximum(1, abs(bulges))
    found = [np.empty(0)]
    for block in np.array_split(points, max(1, -(-points.shape[1] // BLOCK)), axis=1):
        about = block.mean(1, keepdims=True)
        wide, far = np.hypot(*(block - about)).max(), np.hypot(*(middle - about))
        near = np.flatnonzero(far - reach - wide <= (far + reach + wide).min())
        each = _from_arc(block[:, :, None], starts[:, None, near], ends[:, None, near], bulges[near])
        found.append(each.min(-1))
    return np.concatenate(found)


def _from_arc(points: Array, start: Array, end: Array, bulge: Array) -> Array:
    """Distances from lines and arcs, m; points, starts and ends of any shapes that go together."""
    points, start, end = (_like(x, points) for x in (points, start, end))
    chord, bulge = end - start, np.asarray(bulge)
    size = (chord**2).sum(0)
    bent = (abs(bulge) > STRAIGHT) & (size > 0)
    if not bent.any():
        return _from_line(points, start, end)
    b = np.where(bent, bulge, 1.0)
    side = np.stack([-chord[1], chord[0]])
    spoke = points - (start + end) / 2 - (1 - b**2) / (4 * b) * side
    radius = np.sqrt(size) * (1 + b**2) / (4 * abs(b))
    ends = np.minimum(np.hypot(*(points - start)), np.hypot(*(points - end)))
    along, across = (1 - b**2) * chord, 2 * b * side
    begun, over = ((points - start) * (along - across)).sum(0) >= 0, ((points - end) * (along + across)).sum(0) > 0
    within = np.where(abs(b) <= 1, begun & ~over, begun | ~over)
    arched = np.where(within, abs(np.hypot(*spoke) - radius), ends)
    return arched if bent.all() else np.where(bent, arched, _from_line(points, start, end))


def _from_line(points: Array, start: Array, end: Array) -> Array:
    """Distances from lines, m."""
    chord = end - start
    size = (chord**2).sum(0)
    share = np.clip(((points - start) * chord).sum(0) / np.where(size > 0, size, 1.0), 0, 1)
    return np.asarray(np.hypot(*(points - start - share * chord)))


def _like(x: Array, points: Array) -> Array:
    return x.reshape(x.shape + (1,) * (points.ndim - x.ndim))
