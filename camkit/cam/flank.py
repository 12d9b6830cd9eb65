"""What the tool leaves of a cam's flanks: the follower's envelope without the loops in which it crosses itself.

The roller, or the face, is the tool.  Where a flank is undercut, the points at which the follower should touch it lie
in the way of the tool at another cam angle: there is no cam.  What is left ends in a corner where two arcs of the
flank cross, and the follower, resting on the corner, does not reach its place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyder, polyfit, polyval
from scipy.spatial import cKDTree

from ..geometry import rotated
from ..units import deg, mm

CLEAR, BETWEEN = 1e-9, 5e-7
"""A point that lies less deep in the tool (m) is clear of it; one that was worked out between the rows may err more."""
CORNER = 2 * deg
"""A normal that turns by more between two points, and five times as far as before and after, turns on a corner."""
NEAR = 0.3
"""Curved, two segments cross within this share of the shorter one from where they cross straight, or are not smooth."""
BLOCK = 256
"""How many segments are compared with all others at once."""


class Piece(NamedTuple):
    """A stretch of a flank, ``(2, n)``, m; ``closed`` if its last point joins its first."""

    flank: str
    points: np.ndarray
    closed: bool


class Cut(NamedTuple):
    """A stretch that the tool cuts away: its cam angles (rad), and how far the follower stays from its place, m.

    It may begin before the end of the turn and end after it: ``start`` is then the larger.
    """

    flank: str
    start: float
    end: float
    gap: float

    def __str__(self) -> str:
        lost, place = f"{self.gap / mm:.3g} mm", f"{self.start / deg:.4g} to {self.end / deg:.4g} deg"
        return f"the {self.flank} from {place}, where the follower stays {lost} from its place"


@dataclass(frozen=True)
class Roller:
    """Rollers at ``centres`` ``(2, n)``, or none: ``radius`` 0 cuts nothing away."""

    centres: np.ndarray
    radius: float

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.centres.T)

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How deep points lie in a roller, < 0 outside of all, m."""
        return np.asarray(self.radius - self._tree.query(points.T)[0])

    def gaps(self, rows: np.ndarray, left: np.ndarray) -> np.ndarray:
        """How far the rollers of ``rows`` are from touching the points that are ``left``, m."""
        return np.asarray(cKDTree(left.T).query(self.centres[:, rows].T)[0] - self.radius)


@dataclass(frozen=True)
class Face:
    """Straight faces with outward normals ``(2, n)`` through ``points`` ``(2, n)``."""

    normals: np.ndarray
    points: np.ndarray

    @cached_property
    def _reach(self) -> np.ndarray:
        return np.asarray((self.normals * self.points).sum(0))

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How far points lie beyond a face, < 0 before all, m."""
        blocks = np.array_split(points, max(points.shape[1] // BLOCK, 1), axis=1)
        return np.concatenate([(b.T @ self.normals - self._reach).max(-1) for b in blocks])

    def gaps(self, rows: np.ndarray, left: np.ndarray) -> np.ndarray:
        """How far the faces of ``rows`` are from touching the points that are ``left``, m."""
        return np.asarray(self._reach[rows] - (self.normals[:, rows].T @ left).max(-1))


class _Curve(NamedTuple):
    """A flank with the number of the row to which each point belongs, -1 for a point between rows."""

    flank: str
    points: np.ndarray
    rows: np.ndarray

    @property
    def closed(self) -> bool:
        return bool(np.allclose(self.points[:, 0], self.points[:, -1], rtol=0, atol=CLEAR))


class _Arc(NamedTuple):
    """A part of a curve between two places on it where curves cross (or an open one ends)."""

    curve: int
    start: float
    end: float
    """Places are numbers of points; beyond the last one they go on from the first."""
    nodes: tuple[Any, Any]
    """What is at the start and at the end: arcs that meet have the same."""
    points: np.ndarray
    kept: bool


@dataclass(frozen=True)
class Flanks:
    """What the tool leaves of the ``theory``, the flanks of a cam by name, each ``(2, n)``, a point for a cam angle."""

    theory: dict[str, np.ndarray]
    cam_angle: np.ndarray
    tool: Roller | Face
    _curves: tuple[_Curve, ...]

    @cached_property
    def _clear(self) -> list[np.ndarray]:
        """Which points of each curve the tool does not cover."""
        return [self.tool.depth(c.points) <= np.where(c.rows >= 0, CLEAR, BETWEEN) for c in self._curves]

    @cached_property
    def _arcs(self) -> list[_Arc]:
        cuts = {} if all(clear.all() for clear in self._clear) else _crossings(self._curves)
        return [arc for i in range(len(self._curves)) for arc in self._arcs_of(i, cuts.get(i, []))]

    def _arcs_of(self, i: int, cuts: list[tuple[float, Any, np.ndarray]]) -> Iterator[_Arc]:
        curve, cuts = self._curves[i], sorted(cuts, key=lambda cut: cut[0])
        n, ends = curve.points.shape[1] - 1, curve.points[:, [0, -1]].T
        if not curve.closed:
            cuts = [(0.0, _place(ends[0]), ends[0]), *cuts, (float(n), _place(ends[1]), ends[1])]
        elif cuts:
            cuts = [*cuts, (cuts[0][0] + n, *cuts[0][1:])]
        else:
            cuts = [(0.0, (i, "whole"), ends[0]), (float(n), (i, "whole"), ends[0])]
        for (a, from_, p), (b, to, q) in pairwise(cuts):
            between = np.arange(int(np.floor(a)) + 1, int(np.ceil(b)))
            between = between % n if curve.closed else between
            inner, clear = curve.points[:, between], self._clear[i][between]
            shallow = clear if len(clear) else self.tool.depth(((p + q) / 2)[:, None]) <= BETWEEN
            kept = bool(shallow.mean() > 0.5)
            points = np.column_stack([p, inner[:, clear] if kept else inner, q])
            yield _Arc(i, a, b, (from_, to), points, kept)

    @cached_property
    def left(self) -> tuple[Piece, ...]:
        """What is left of the flanks."""
        return tuple(_chained(self._curves, [arc for arc in self._arcs if arc.kept]))

    @cached_property
    def lost(self) -> tuple[Piece, ...]:
        """The stretches of the theory that the tool cuts away."""
        return tuple(_chained(self._curves, [arc for arc in self._arcs if not arc.kept]))

    @cached_property
    def _rows(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """For each flank which rows are cut away, and the points of all rows on what is left."""
        return {c.flank: self._rows_of(i) for i, c in enumerate(self._curves) if (c.rows >= 0).any()}

    def _rows_of(self, i: int) -> tuple[np.ndarray, np.ndarray]:
        curve, arcs = self._curves[i], [arc for arc in self._arcs if arc.curve == i]
        n, closed = curve.points.shape[1] - 1, curve.closed
        own = np.flatnonzero(curve.rows >= 0)
        kept = np.zeros(len(curve.rows), dtype=bool)
        places: list[Any] = []
        anchors: list[np.ndarray] = []
        for arc in (arc for arc in arcs if arc.kept):
            inside = np.arange(int(np.ceil(arc.start)), int(np.floor(arc.end)) + 1)
            kept[inside % n if closed else inside] = True
            places += [arc.start % n if closed else arc.start, arc.end % n if closed else arc.end]
            anchors += [arc.points[:, 0], arc.points[:, -1]]
        if closed:
            kept[-1] = kept[0]
        kept &= self._clear[i]
        points, whole = curve.points.copy(), np.flatnonzero(kept)
        at, rests = np.append(places, whole), np.vstack([*anchors, curve.points[:, whole].T]).reshape(-1, 2)
        away = abs(at - np.flatnonzero(~kept)[:, None])
        away = np.minimum(away, n - away) if closed else away
        points[:, ~kept] = rests[away.argmin(-1)].T if len(at) else np.nan
        return ~kept[own], points[:, own]

    @property
    def cut_away(self) -> dict[str, np.ndarray]:
        """Where each flank is cut away, ``(n,)``."""
        return {flank: rows for flank, (rows, _) in self._rows.items()}

    @property
    def points(self) -> dict[str, np.ndarray]:
        """Each flank ``(2, n)``, a point for each cam angle; a point that is cut away stands on the corner."""
        return {flank: points for flank, (_, points) in self._rows.items()}

    @property
    def _closed(self) -> dict[str, bool]:
        return {curve.flank: curve.closed for curve in self._curves}

    @cached_property
    def cuts(self) -> tuple[Cut, ...]:
        """What the tool cuts away, stretch by stretch."""
        found: list[Cut] = []
        for flank, rows in self.cut_away.items():
            left = [piece.points for piece in self.left if piece.flank == flank]
            for run in _runs(rows, self._closed[flank]):
                gaps = self.tool.gaps(run, np.concatenate(left, axis=1)) if left else np.array([np.inf])
                first, last = self.cam_angle[run[[0, -1]]]
                found.append(Cut(flank, float(first), float(last), float(gaps.max())))
        return tuple(found)

    @property
    def message(self) -> str:
        """What the tool cuts away, where and by how much, in a sentence; empty if it is nothing."""
        return f"The tool cuts away {'; '.join(map(str, self.cuts))}." if self.cuts else ""


def flanks(analysis: Any) -> Flanks:
    """What the follower, as a tool, leaves of the flanks of one cam's analysis.

    >>> from camkit import TranslatingFlatCam, TranslatingRollerCam, mm
    >>> flanks(TranslatingRollerCam().analyse()).message
    ''
    >>> for cut in flanks(TranslatingFlatCam(base_radius=10 * mm).analyse()).cuts:
    ...     print(cut)
    the profile from 80 to 95 deg, where the follower stays 0.00294 mm from its place
    the profile from 205 to 220 deg, where the follower stays 0.00294 mm from its place
    """
    inner, outer = analysis.profile, analysis.outer_profile
    pitch, radius = analysis.pitch, float(np.ravel(analysis.cam.roller_radius)[0])
    normals = getattr(analysis, "face_normal", None)
    rows = np.arange(inner.shape[-1])
    if normals is not None:
        curve = _Curve("profile", inner, rows)
        turns = np.allclose(normals[:, 0], normals[:, -1], rtol=0, atol=CLEAR)
        return Flanks({"profile": inner}, analysis.profile_angle, Face(normals, inner), (_ended(curve, turns),))
    theory = {"profile": inner} | ({"outer profile": outer} if np.isfinite(outer).all() else {})
    curves = [_with_corners(name, points, pitch, radius) for name, points in theory.items()]
    if len(theory) > 1 and not np.allclose(pitch[:, 0], pitch[:, -1], rtol=0, atol=CLEAR):
        curves += [_end(inner[:, k], pitch[:, k], pitch[:, k] - pitch[:, j]) for k, j in ((0, 1), (-1, -2))]
    return Flanks(theory, analysis.profile_angle, Roller(pitch, radius), tuple(curves))


def _with_corners(flank: str, points: np.ndarray, pitch: np.ndarray, radius: float) -> _Curve:
    """A flank with the arc that a roller makes where its path has a corner."""
    rows = np.arange(points.shape[1])
    if not radius:
        return _Curve(flank, points, rows)
    direction = np.unwrap(np.arctan2(*(points - pitch)[::-1]))
    turned = abs(np.diff(direction))
    beside = np.maximum(np.append(turned[1:], 0), np.insert(turned[:-1], 0, 0))
    done = 0
    parts: list[np.ndarray] = []
    numbers: list[np.ndarray] = []
    for i in np.flatnonzero((turned > CORNER) & (turned > 5 * beside)):
        if not 2 <= i < points.shape[1] - 3:
            continue
        between = np.linspace(direction[i], direction[i + 1], int(turned[i] / CORNER) * 4 + 2)
        corner = _meeting(pitch[:, i - 2 : i + 1], pitch[:, i + 1 : i + 4])
        parts += [points[:, done : i + 1], corner[:, None] + radius * np.array([np.cos(between), np.sin(between)])]
        numbers += [rows[done : i + 1], np.full(len(between), -1)]
        done = int(i) + 1
    curve = _Curve(flank, np.hstack([*parts, points[:, done:]]), np.concatenate([*numbers, rows[done:]]))
    last = direction[-1] + np.linspace(0, (direction[0] - direction[-1] + np.pi) % (2 * np.pi) - np.pi, 91)[1:-1]
    arc = pitch[:, :1] + radius * np.array([np.cos(last), np.sin(last)])
    return _ended(curve, np.allclose(pitch[:, 0], pitch[:, -1], rtol=0, atol=CLEAR), arc)


def _ended(curve: _Curve, turns: bool, between: np.ndarray = np.empty((2, 0))) -> _Curve:  # noqa: B008
    """The flank of a follower that ``turns`` round and round, closed if it is not: its speed jumps at the start."""
    if curve.closed or not turns:
        return curve
    points = np.hstack([curve.points, between, curve.points[:, :1]])
    return _Curve(curve.flank, points, np.append(curve.rows, np.full(between.shape[1] + 1, -1)))


def _meeting(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The corner between three points of a path before it and three after it, all at even steps."""
    one, other = polyfit((-2, -1, 0), before.T, 2), polyfit((1, 2, 3), after.T, 2)
    apart = one - other
    turn = apart[1] / np.hypot(*apart[1])
    steps = np.roots((apart @ turn)[::-1]).real
    step = np.clip(steps[abs(steps - 0.5).argmin()], 0, 1)
    return np.asarray(np.array([1, step, step**2]) @ (one + other) / 2)


def _end(inner: np.ndarray, centre: np.ndarray, onward: np.ndarray) -> _Curve:
    """The half circle with which an open groove ends, from its inner to its outer flank."""
    spoke = inner - centre
    sense = np.sign(spoke[0] * onward[1] - spoke[1] * onward[0])
    points = centre[:, None] + rotated(spoke[:, None], sense * np.linspace(0, np.pi, 91))
    return _Curve("groove end", points, np.full(91, -1))


def _place(point: np.ndarray) -> tuple[float, ...]:
    """A point as something to compare with others, to a tenth of a micrometre."""
    return tuple(np.round(point, 7).tolist())


def _crossings(curves: Sequence[_Curve]) -> dict[int, list[tuple[float, Any, np.ndarray]]]:
    """For each curve where other segments cross it: place on it, name of the crossing, point."""
    starts = np.hstack([c.points[:, :-1] for c in curves])
    ends = np.hstack([c.points[:, 1:] for c in curves])
    owner = np.concatenate([np.full(c.points.shape[1] - 1, i) for i, c in enumerate(curves)])
    number = np.concatenate([np.arange(c.points.shape[1] - 1) for c in curves])
    low, high, along = np.minimum(starts, ends), np.maximum(starts, ends), ends - starts
    found: dict[int, list[tuple[float, Any, np.ndarray]]] = {}
    for first in range(0, starts.shape[1], BLOCK):
        block = np.arange(first, min(first + BLOCK, starts.shape[1]))
        meet = (low[:, block, None] <= high[:, None]).all(0) & (low[:, None] <= high[:, block, None]).all(0)
        i, j = np.nonzero(meet & (block[:, None] < np.arange(starts.shape[1])))
        i = block[i]
        apart = starts[:, j] - starts[:, i]
        with np.errstate(divide="ignore", invalid="ignore"):
            skew = _cross(along[:, i], along[:, j])
            s, t = _cross(apart, along[:, j]) / skew, _cross(apart, along[:, i]) / skew
        for k in np.flatnonzero((s >= 0) & (s < 1) & (t >= 0) & (t < 1)):
            a, b = int(i[k]), int(j[k])
            if _neighbours(starts, ends, a, b):
                continue
            one, other = (_cubic(curves[owner[segment]], int(number[segment])) for segment in (a, b))
            point, shares = _met(one, other, np.array([s[k], t[k]]))
            if not np.hypot(*(point - starts[:, a] - s[k] * along[:, a])) < NEAR * np.hypot(*along[:, [a, b]]).min():
                point, shares = starts[:, a] + s[k] * along[:, a], np.array([s[k], t[k]])
            for segment, share in zip((a, b), shares, strict=True):
                place = float(number[segment] + share)
                found.setdefault(int(owner[segment]), []).append((place, ("crossing", a, b), point))
    return found


def _cubic(curve: _Curve, segment: int) -> np.ndarray:
    """The cubic through the ends of a segment, at 0 and 1, and the points beside them, lowest power first."""
    n = curve.points.shape[1] - curve.closed
    first = segment - 1 if curve.closed else min(max(segment - 1, 0), n - 4)
    steps = np.arange(first, first + 4)
    return np.asarray(polyfit(steps - segment, curve.points[:, steps % n].T, 3))


def _met(one: np.ndarray, other: np.ndarray, shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where two cubics cross, by Newton's method from given places on them."""
    for _ in range(5):
        apart = polyval(shares[0], one) - polyval(shares[1], other)
        slopes = np.column_stack([polyval(shares[0], polyder(one)), -polyval(shares[1], polyder(other))])
        shares = shares - np.linalg.lstsq(slopes, apart, rcond=None)[0]
    return np.asarray(polyval(shares[0], one)), shares


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def _neighbours(starts: np.ndarray, ends: np.ndarray, a: int, b: int) -> bool:
    """Whether two segments share an end."""
    p, q = np.stack([starts[:, a], ends[:, a]]), np.stack([starts[:, b], ends[:, b]])
    return bool((abs(p[:, None] - q[None]).max(-1) <= CLEAR).any())


def _chained(curves: Sequence[_Curve], arcs: list[_Arc]) -> Iterator[Piece]:
    """Arcs of one flank that begin where another ends, joined."""
    for flank in dict.fromkeys(curve.flank for curve in curves):
        waiting = [arc for arc in arcs if curves[arc.curve].flank == flank]
        while waiting:
            ends = {arc.nodes[1] for arc in waiting}
            first = next((arc for arc in waiting if arc.nodes[0] not in ends), waiting[0])
            chain = [first]
            waiting.remove(first)
            while following := [arc for arc in waiting if arc.nodes[0] == chain[-1].nodes[1]]:
                chain.append(following[0])
                waiting.remove(following[0])
                if chain[-1].nodes[1] == first.nodes[0]:
                    break
            points = np.hstack([chain[0].points, *(arc.points[:, 1:] for arc in chain[1:])])
            closed = chain[-1].nodes[1] == first.nodes[0]
            yield Piece(flank, points[:, :-1] if closed else points, closed)


def _runs(where: np.ndarray, closed: bool) -> list[np.ndarray]:
    """Runs of numbers at which something is so; on a closed curve one may go on beyond the end."""
    numbers = np.flatnonzero(where)
    if not len(numbers):
        return []
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    if closed and len(runs) > 1 and where[0] and where[-1]:
        runs = [*runs[1:-1], np.concatenate([runs[-1], runs[0]])]
    return runs
