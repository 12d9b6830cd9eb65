"""The outline of a cam that exists: drawn of lines and arcs, or measured by points.

An outline goes once around the cam axis, the origin, counter-clockwise; it consists of pieces, and of each place of a
piece one can ask its point, the direction of the normal that points away from the cam, and its radius of curvature.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..motion.closing import TURN
from ..motion.smoothing import BadRow
from ..quantities import Declared
from ..quantities.kinds import listed, numbers, one_number, refuse_arguments
from ..quantities.types import Array
from ..units import deg, mm
from .compared import Compared, compared

TANGENT = 0.05 * deg
"""Pieces whose normals differ by less where they meet were meant to be tangent."""
SAME = 1e-9
"""Points closer than this (m) are one."""
LARGEST = 10.0
"""No cam reaches so far from its axis (m)."""
MOST = 20_000
"""Points or corners of an outline."""
CHORDS, ROUGH = 720, 100
"""So many chords of an outline are tried for crossings at most, but not with the next of each, one in so many."""


class Place(NamedTuple):
    """Places of an outline: points ``(2, n)``, m, their normals' directions, rad, and radii of curvature, m.

    The radius is above 0 where the outline is convex, ``inf`` on a line, 0 on a corner.
    """

    point: Array
    normal: Array
    radius: Array


class Piece(ABC):
    """A smooth piece of an outline."""

    looks: int = 65
    """At so many places its contacts are looked for."""

    @property
    @abstractmethod
    def closed(self) -> bool:
        """Whether it is the whole outline."""

    @abstractmethod
    def at(self, u: Array) -> Place:
        """The places at shares ``u`` of it."""

    def beginning(self, u: float) -> Piece:
        """A closed one that begins at another share of it."""
        return self


@dataclass(frozen=True)
class Straight(Piece):
    """A line from one point to another."""

    start: Array
    end: Array
    looks = 17

    @property
    def closed(self) -> bool:
        return False

    def at(self, u: Array) -> Place:
        x, y = along = self.end - self.start
        point = self.start[:, None] + along[:, None] * u
        return Place(point, np.full(len(u), np.arctan2(-x, y)), np.full(len(u), np.inf))


@dataclass(frozen=True)
class Bend(Piece):
    """An arc about a centre, along which the normal turns from a direction on by ``turn``; a corner if its radius is 0.

    ``radius`` is below 0 and so is ``turn`` where the outline is hollow.
    """

    centre: Array
    radius: float
    normal: float
    turn: float

    def at(self, u: Array) -> Place:
        normal = self.normal + self.turn * u
        point = self.centre[:, None] + self.radius * np.array([np.cos(normal), np.sin(normal)])
        return Place(point, normal, np.full(len(u), self.radius))

    @property
    def closed(self) -> bool:
        return bool(abs(self.turn) > TURN - 1e-9)

    def beginning(self, u: float) -> Bend:
        return replace(self, normal=self.normal + self.turn * u)

    def followed_by(self, other: Piece) -> Bend | None:
        """Both as one arc, if the other goes on about the same centre."""
        if not isinstance(other, Bend) or abs(self.radius - other.radius) > SAME or self is other:
            return None
        if np.hypot(*(self.centre - other.centre)) > SAME:
            return None
        return replace(self, turn=self.turn + other.turn)


class CamOutline(Declared, ABC):
    """The outline of a cam, m, about the cam axis at the origin, as it lies at cam angle 0."""

    said: tuple[str, ...]
    """What was understood of it where it was read."""

    @property
    @abstractmethod
    def pieces(self) -> tuple[Piece, ...]:
        """Its smooth pieces, counter-clockwise."""

    @property
    @abstractmethod
    def points(self) -> Array:
        """Points on it as it was given, ``(2, n)``, m."""

    @property
    @abstractmethod
    def remarks(self) -> tuple[str, ...]:
        """What it is, in sentences."""

    def compared(self, analysis: Any) -> Compared:
        """The outline against the profile of a cam's analysis."""
        return compared(self.points, analysis)

    @property
    @abstractmethod
    def noise(self) -> float:
        """By how much its points scatter (rms), m."""

    @property
    @abstractmethod
    def bad_points(self) -> tuple[BadRow, ...]:
        """Points far off the curve through all others: number, polar angle (rad) and deviation (m)."""

    @property
    @abstractmethod
    def criterion(self) -> str:
        """How much of it was smoothed away."""


@dataclass(frozen=True)
class DrawnOutline(CamOutline):
    """An outline of lines and arcs, through ``corners`` (x, y, m) in their order; the last is joined to the first.

    ``bulges`` has for each corner what becomes of the way to the next: 0 is a line, and an arc that turns by ``theta``
    to the left has the bulge ``tan(theta / 4)``, below 0 to the right.  It may go around either way.

    >>> square = DrawnOutline(((0.01, -0.01), (0.01, 0.01), (-0.01, 0.01), (-0.01, -0.01)))
    >>> square.remarks
    ('an outline of 4 lines and 4 corners, 10 to 14.1421 mm from the cam axis',)
    >>> DrawnOutline.circle(0.04, 0.0, -0.015).remarks
    ('an outline of 1 arc, 25 to 55 mm from the cam axis',)

    Raises ``ValueError`` for what is no such outline, and for one that does not go around the cam axis.
    """

    corners: tuple[tuple[float, float], ...] = field(metadata={"most": MOST})
    bulges: tuple[float, ...] = field(default=(), metadata={"most": MOST})
    said: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        corners, bulges = points_of_outline(self.corners, 2), numbers(self.bulges, "the bulges of the outline")
        bulges = bulges if bulges.size else np.zeros(corners.shape[1])
        if bulges.shape != corners.shape[1:] or not np.isfinite(bulges).all():
            raise ValueError(
                f"the outline has {corners.shape[1]} corners and {bulges.size} bulges; it needs a finite one for each"
            )
        object.__setattr__(self, "corners", tuple(map(tuple, corners.T.tolist())))
        object.__setattr__(self, "bulges", tuple(bulges.tolist()))
        object.__setattr__(self, "said", tuple(map(str, listed(self.said, "what was understood", "sentence"))))
        refuse_not_around(self.points)

    @classmethod
    def circle(cls, radius: float, x: float = 0.0, y: float = 0.0) -> DrawnOutline:
        """A circle of a radius about a point, m: an eccentric, if that is not the cam axis."""
        refuse_arguments(DrawnOutline.circle, locals())
        r = one_number(radius, "the radius of the circle", "be above 0 m", lambda value: 0 < value < LARGEST)
        x, y = (one_number(value, "the place of the circle's centre") for value in (x, y))
        return cls(((x + r, y), (x - r, y)), (1.0, 1.0))

    @classmethod
    def tangent(
        cls, base_radius: float, nose_radius: float, nose_distance: float, flank_radius: float | None = None
    ) -> DrawnOutline:
        """A tangent cam: base circle, nose and two flanks that are tangent to both; its nose points to +y.

        The nose's centre is at the ``nose_distance`` from the cam axis.  Flanks are lines, or arcs of a
        ``flank_radius``: above 0 they are convex, below 0 hollow.  All in m.

        >>> DrawnOutline.tangent(0.025, 0.008, 0.040).remarks
        ('an outline of 2 arcs and 2 lines, 25 to 48 mm from the cam axis',)
        """
        refuse_arguments(DrawnOutline.tangent, locals())
        given = {"base circle": base_radius, "nose": nose_radius, "nose's distance": nose_distance}
        must = "be a finite number above 0 m"
        r, n, c = (one_number(x, f"the {k} of the cam", must, lambda x: 0 < x < np.inf) for k, x in given.items())
        base, nose = _flank_normals(r, n, c, flank_radius)
        right = [(r * np.sin(base), r * np.cos(base)), (n * np.sin(nose), c + n * np.cos(nose))]
        left = [(-x, y) for x, y in right]
        flank = float(np.tan((base - nose) / 4))
        around = (float(np.tan((TURN - 2 * base) / 4)), flank, float(np.tan(nose / 2)), flank)
        return cls((left[0], *right, left[1]), around)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        return tuple(_with_corners(_joined([_edge(*edge) for edge in self._edges()])))

    def _edges(self) -> Iterator[tuple[Array, Array, float]]:
        """The ways from corner to corner, counter-clockwise, and their bulges."""
        corners, bulges = np.array(self.corners), np.array(self.bulges)
        if signed_area(self.points) < 0:
            corners, bulges = corners[::-1], -np.roll(bulges[::-1], -1)
        for start, end, bulge in zip(corners, np.roll(corners, -1, 0), bulges, strict=True):
            if np.hypot(*(end - start)) > SAME:
                yield start, end, float(bulge)

    @cached_property
    def points(self) -> Array:
        corners, bulges = np.array(self.corners), np.array(self.bulges)
        parts = []
        for start, end, bulge in zip(corners, np.roll(corners, -1, 0), bulges, strict=True):
            seen = (np.arctan2(end[1], end[0]) - np.arctan2(start[1], start[0]) + np.pi) % TURN - np.pi
            n = 2 * max(1, int(np.ceil(max(abs(seen), abs(4 * np.arctan(bulge))) / deg)))
            parts.append(_edge(start, end, float(bulge)).at(np.arange(n) / n).point)
        return np.concatenate(parts, axis=1)

    @property
    def noise(self) -> float:
        return 0.0

    @property
    def bad_points(self) -> tuple[BadRow, ...]:
        return ()

    @property
    def criterion(self) -> str:
        return "exact lines and arcs"

    @property
    def remarks(self) -> tuple[str, ...]:
        kinds = [
            "line" if isinstance(p, Straight) else "arc" if isinstance(p, Bend) and p.radius else "corner"
            for p in self.pieces
        ]
        counts = [f"{kinds.count(kind)} {kind}{'s' * (kinds.count(kind) > 1)}" for kind in dict.fromkeys(sorted(kinds))]
        order = sorted(counts, key=lambda words: words.endswith(("corner", "corners")))
        return (f"an outline of {_listed(order)}, {reach_in_words(self.points)}", *self.said)


def _listed(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def reach_in_words(points: Array) -> str:
    """How far from the cam axis an outline is."""
    far = np.hypot(*points) / mm
    return f"{far.min():.6g} to {far.max():.6g} mm from the cam axis"


def points_of_outline(given: object, least: int) -> Array:
    """Points ``(2, n)`` from pairs or from two rows; ``ValueError`` in a sentence for anything else."""
    points = numbers(given, "the points of the outline")
    if points.ndim == 2 and points.shape[1] == 2:
        points = points.T
    if points.ndim != 2 or points.shape[0] != 2 or not least <= points.shape[1] <= MOST:
        shape = " x ".join(map(str, points.shape)) or "one number"
        raise ValueError(f"the points of the outline are {shape}; they must be {least} to {MOST} pairs of x and y")
    if not np.isfinite(points).all():
        row = int(np.argmin(np.isfinite(points).all(0))) + 1
        raise ValueError(f"point {row} of the outline holds a number that is not finite; every one must be")
    if abs(points).max() > LARGEST:
        raise ValueError(
            f"the outline reaches {abs(points).max():.6g} m from the cam axis; coordinates are in m (for mm write "
            "points * mm)"
        )
    return points


def signed_area(points: Array) -> float:
    """The area within a closed line, m^2, above 0 if it runs counter-clockwise."""
    x, y = points
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


def refuse_not_around(points: Array) -> None:
    """An outline that does not go around the cam axis once is no cam."""
    if np.hypot(*points).min() < SAME:
        raise ValueError("the outline passes through the cam axis, the origin; a cam must go around it")
    angle = np.arctan2(points[1], points[0])
    steps = (np.diff(angle, append=angle[0]) + np.pi) % TURN - np.pi
    turns = round(float(steps.sum()) / TURN)
    if abs(turns) != 1:
        around = f"goes around the cam axis {abs(turns)} times" if turns else "lies beside the cam axis, the origin"
        order = ", its points in their order" if turns else ""
        raise ValueError(f"the outline {around}; a cam's goes around it once{order}")
    _refuse_crossing(points[:, :: -(-points.shape[1] // CHORDS)])


def _refuse_crossing(corners: Array) -> None:
    """An outline whose chords cross, other than those next to each other, which may be rough, is no cam."""
    ahead = np.roll(corners, -1, axis=1)
    side = _side_of(corners, ahead, corners) * _side_of(corners, ahead, ahead)
    apart = abs(np.subtract.outer(*2 * [np.arange(corners.shape[1])]))
    apart = np.minimum(apart, corners.shape[1] - apart)
    crossing = (side < 0) & (side.T < 0) & (apart > corners.shape[1] // ROUGH)
    if crossing.any():
        x, y = corners[:, np.argmax(crossing.any(1))] / mm
        raise ValueError(f"the outline crosses itself near x {x:.4g}, y {y:.4g} mm; the edge of a cam does not")


def _side_of(begin: Array, end: Array, points: Array) -> Array:
    """On which side of each line, in rows, each of some points is."""
    (x, y), (dx, dy) = begin[:, :, None], (end - begin)[:, :, None]
    return np.sign(dx * (points[1] - y) - dy * (points[0] - x))


def _flank_normals(r: float, n: float, c: float, flank: float | None) -> tuple[float, float]:
    """How far from the nose's direction the flank is tangent to the base circle and to the nose, rad."""
    if flank is None:
        cosine = (r - n) / c
        angles = np.arccos([cosine, cosine]) if abs(cosine) < 1 else [np.nan] * 2
    else:
        R = one_number(flank, "the flank's radius", "be a number other than 0 m, below 0 if it is hollow", bool)
        one, other = abs(R - np.array([r, n]))
        with np.errstate(divide="ignore", invalid="ignore"):
            cosines = [(one**2 + c**2 - other**2) / (2 * one * c), (one**2 - c**2 - other**2) / (2 * other * c)]
            away = np.arccos(cosines)
        angles = np.pi - away if R > 0 else away
    if not (np.isfinite(angles).all() and 0 < angles[0] < np.pi and 0 < angles[1] < np.pi and c + n > r):
        sizes = f"base circle {r / mm:.4g} mm, nose {n / mm:.4g} mm, {c / mm:.4g} mm from the cam axis"
        raise ValueError(f"no flank touches base circle and nose ({sizes}); the nose must stand out of the base circle")
    return float(angles[0]), float(angles[1])


def _edge(start: Array, end: Array, bulge: float) -> Piece:
    if abs(bulge) < 1e-12:
        return Straight(start, end)
    x, y = along = end - start
    centre = (start + end) / 2 + (1 - bulge**2) / (4 * bulge) * np.array([-y, x])
    out = (start - centre) * np.sign(bulge)
    radius = float(np.hypot(*along)) * (1 + bulge**2) / (4 * bulge)
    return Bend(centre, radius, float(np.arctan2(out[1], out[0])), float(4 * np.arctan(bulge)))


def _joined(edges: list[Piece]) -> list[Piece]:
    """Arcs that go on about the same centre as one."""
    found: list[Piece] = []
    for edge in [*edges[1:], *edges[:1]]:
        before = found[-1] if found else None
        whole = before.followed_by(edge) if isinstance(before, Bend) else None
        found = [*found[:-1], whole] if whole else [*found, edge]
    return found


def _with_corners(edges: list[Piece]) -> Iterator[Piece]:
    """Pieces with the corners between them."""
    ends = np.array([0.0, 1.0])
    for edge, after in zip(edges, edges[1:] + edges[:1], strict=True):
        yield edge
        place, normal = edge.at(ends), after.at(ends).normal[0]
        turn = float((normal - place.normal[1] + np.pi) % TURN - np.pi)
        if turn > TANGENT:
            yield Bend(place.point[:, 1], 0.0, float(place.normal[1]), turn)
