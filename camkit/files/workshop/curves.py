"""Smooth curves by exact points and exact tangents, and contours made of them.

Between two points a stretch is the cubic with both tangents, which for points as dense as those of `contours` is the
curve itself to a tenth of a nanometre.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...quantities.types import Array

SAME = 1e-8
"""Points closer than this (m) are one."""
TURNED = 1e-5
"""Tangents that differ by less (rad) are those of a smooth curve."""


class Stretch(NamedTuple):
    """A smooth part of a contour, in the direction of travel.

    >>> turn = np.linspace(0, np.pi / 2, 10)
    >>> quarter = Stretch(np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)]))
    >>> bool(abs(np.hypot(*quarter.finer(8).points) - 1).max() < 1e-9)
    True
    """

    points: Array
    """On the cam, ``(2, k)``, m."""
    tangents: Array
    """Unit vectors, ``(2, k)``."""

    @property
    def backwards(self) -> Stretch:
        """The same the other way round."""
        return Stretch(self.points[:, ::-1], -self.tangents[:, ::-1])

    @property
    def length(self) -> float:
        """Of its chords, m."""
        return float(np.hypot(*np.diff(self.points)).sum())

    def at(self, place: Array) -> Stretch:
        """Points and tangents at places along it: the number of the point before, and the share from there."""
        k = np.clip(np.floor(place).astype(int), 0, self.points.shape[1] - 2)
        ends = self.points[:, k], self.tangents[:, k], self.points[:, k + 1], self.tangents[:, k + 1]
        return hermite(*ends, place - k)

    def finer(self, steps: int) -> Stretch:
        """With ``steps`` even ones from each point to the next."""
        k = self.points.shape[1] - 1
        return self.at(np.linspace(0, k, k * steps + 1))

    def part(self, start: float, end: float) -> Stretch:
        """From one place along it to another."""
        inner = np.arange(np.floor(start) + 1, np.ceil(end))
        return self.at(np.concatenate([[start], inner, [end]]))


@dataclass(frozen=True)
class Contour:
    """A line of a cam as it is made, stretch by stretch, each of which begins where the one before ends."""

    layer: str
    """What it is: ``CAM``, ``GROOVE``, ``PITCH``, ``FAULT``."""
    stretches: tuple[Stretch, ...]
    closed: bool
    """Whether its end is its start; it then runs counter-clockwise."""

    @property
    def points(self) -> Array:
        """All of them, ``(2, n)``, m."""
        return np.hstack([stretch.points for stretch in self.stretches])

    @property
    def backwards(self) -> Contour:
        """The same the other way round."""
        return Contour(self.layer, tuple(s.backwards for s in self.stretches[::-1]), self.closed)

    @property
    def counter_clockwise(self) -> Contour:
        """The same, running counter-clockwise; of an open one, as seen from the cam axis."""
        x, y = self.points
        swept = (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() + self.closed * (x[-1] * y[0] - x[0] * y[-1])
        return self if swept >= 0 else self.backwards


def tangent_length(start: Array, leaving: Array, end: Array, arriving: Array) -> Array:
    """Of the derivatives (m) at both ends of the cubic that is nearest to an arc from ``start`` to ``end``, ``(2, n)``.

    The chord over ``cos^2(theta / 4)``, for unit tangents that turn by ``theta``.
    """
    half = np.sqrt(np.clip((1 + (leaving * arriving).sum(0)) / 2, 0, 1))
    return np.hypot(*(end - start)) * 2 / (1 + half)


def cubics(start: Array, leaving: Array, end: Array, arriving: Array) -> Array:
    """From ``start`` to ``end``, ``(2, n)``, with unit tangents at both, as powers of a share: ``(4, 2, n)``, m."""
    size, along = tangent_length(start, leaving, end, arriving), end - start
    a, b = size * leaving, size * arriving
    return np.stack([start, a, 3 * along - 2 * a - b, a + b - 2 * along])


def hermite(start: Array, leaving: Array, end: Array, arriving: Array, share: Array) -> Stretch:
    """Points and unit tangents at shares of the `cubics` from ``start`` to ``end``, ``(2, n)``."""
    u, (p, a, b, c) = share, cubics(start, leaving, end, arriving)
    ways = a + 2 * u * b + 3 * u**2 * c
    long = np.hypot(*ways)
    return Stretch(p + u * a + u**2 * b + u**3 * c, np.where(long > 0, ways / np.where(long > 0, long, 1.0), leaving))


def from_cubic(start: Stretch, end: Stretch, points: Array) -> Array:
    """How far points ``(2, n)`` are from cubics that go from one point to another each, or from one cubic, m."""
    chord = end.points - start.points
    size = np.maximum(np.hypot(*chord), SAME)
    share = np.clip(((points - start.points) * chord).sum(0) / size**2, 0, 1)
    for _ in range(4):
        at = hermite(*start, *end, share)
        share = np.clip(share + ((points - at.points) * at.tangents).sum(0) / size, 0, 1)
    return np.hypot(*(points - hermite(*start, *end, share).points))


def smooth_runs(contour: Contour, angle: float = TURNED) -> list[Stretch]:
    """The contour from corner to corner; one that has none in one run, which then ends where it begins."""
    parts = list(contour.stretches)
    corner = [not smooth(parts[k - 1], parts[k], angle) for k in range(len(parts))]
    if contour.closed and any(corner):
        first = corner.index(True)
        parts, corner = parts[first:] + parts[:first], corner[first:] + corner[:first]
    cuts = [k for k in range(1, len(parts)) if corner[k]]
    return [joined(parts[i:j]) for i, j in zip([0, *cuts], [*cuts, len(parts)], strict=True)]


def arc(centre: Array, start: Array, turn: float) -> Stretch:
    """An arc about a centre from a point on, by an angle (rad), above 0 counter-clockwise."""
    steps = max(4, int(np.ceil(abs(turn) / 0.08)))
    spoke, angle = start - centre, turn * np.linspace(0, 1, steps + 1)
    x, y = spoke[0] * np.cos(angle) - spoke[1] * np.sin(angle), spoke[0] * np.sin(angle) + spoke[1] * np.cos(angle)
    points = centre[:, None] + np.stack([x, y])
    return Stretch(points, np.sign(turn) * np.stack([-y, x]) / np.hypot(*spoke))


def line(start: Array, end: Array) -> Stretch:
    """A straight one."""
    along = (end - start) / np.hypot(*(end - start))
    return Stretch(np.stack([start, end], axis=1), np.stack([along, along], axis=1))


def smooth(before: Stretch, after: Stretch, angle: float = TURNED) -> bool:
    """Whether one stretch goes on from another with a tangent that differs by no more than an angle (rad)."""
    one, other = before.tangents[:, -1], after.tangents[:, 0]
    return bool(abs(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other)) <= angle)


def joined(parts: Sequence[Stretch]) -> Stretch:
    """Stretches that are one smooth curve as one."""
    first, *others = parts
    points = [first.points, *(other.points[:, 1:] for other in others)]
    return Stretch(np.hstack(points), np.hstack([first.tangents, *(other.tangents[:, 1:] for other in others)]))
