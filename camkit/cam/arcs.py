"""Plane curves cut into arcs where they cross, and arcs joined again end to end.

Between two points a curve is a straight segment while crossings are looked for, and the cubic through four points
where one is found.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyder, polyfit, polyval

SAME = 1e-9
"""Points closer than this (m) are one."""
NEAR = 0.3
"""Curved, two segments cross within this share of the shorter one from where they cross straight, or are not smooth."""
BLOCK = 256
"""How many segments are compared with all others at once."""


@dataclass(frozen=True)
class Curve:
    """A plane curve through ``points`` ``(2, n)``, m."""

    points: np.ndarray

    @cached_property
    def closed(self) -> bool:
        """Whether its last point is the first."""
        return bool(np.allclose(self.points[:, 0], self.points[:, -1], rtol=0, atol=SAME))

    @property
    def segments(self) -> int:
        """How many there are between its points."""
        return self.points.shape[1] - 1


class Node(NamedTuple):
    """Where a curve crosses another or itself, or ends."""

    place: float
    """Along the curve: the number of the point before it, and the share of the segment from there."""
    name: object
    """The curves that meet at a node have the same."""
    point: np.ndarray


class Arc(NamedTuple):
    """A part of a curve between two nodes; on a closed one the second may lie beyond the last point."""

    curve: int
    start: Node
    end: Node
    inner: np.ndarray
    """Numbers of the curve's points between them."""


def arcs(curves: Sequence[Curve]) -> list[Arc]:
    """All curves, cut wherever one crosses another or itself.

    >>> x = np.linspace(0, 2 * np.pi, 101)
    >>> eight = Curve(np.array([np.sin(2 * x + 1), np.sin(x + 0.5)]))
    >>> [(round(arc.start.place, 1), round(arc.end.place, 1)) for arc in arcs([eight])]
    [(42.0, 92.0), (92.0, 142.0)]
    """
    nodes = _crossings(curves)
    return [arc for i in range(len(curves)) for arc in _between(i, curves[i], nodes[i])]


def whole(curves: Sequence[Curve]) -> list[Arc]:
    """All curves as they are: an arc each."""
    return [arc for i, curve in enumerate(curves) for arc in _between(i, curve, [])]


def points_of(arc: Arc, curves: Sequence[Curve]) -> np.ndarray:
    """The points of an arc from node to node, ``(2, n)``."""
    return np.column_stack([arc.start.point, curves[arc.curve].points[:, arc.inner], arc.end.point])


def chains(given: Sequence[Arc]) -> Iterator[list[Arc]]:
    """Arcs in rows in which each begins at the node where the one before ends."""
    waiting = list(given)
    while waiting:
        ends = {arc.end.name for arc in waiting}
        chain = [waiting.pop(next((k for k, arc in enumerate(waiting) if arc.start.name not in ends), 0))]
        while (k := _beginning(waiting, chain[-1].end)) is not None:
            chain.append(waiting.pop(k))
            if is_ring(chain):
                break
        yield chain


def is_ring(chain: Sequence[Arc]) -> bool:
    """Whether a row of arcs ends where it begins."""
    return bool(chain[-1].end.name == chain[0].start.name)


def _beginning(given: Sequence[Arc], node: Node) -> int | None:
    """The number of the first arc that begins at a node."""
    return next((k for k, arc in enumerate(given) if arc.start.name == node.name), None)


def _between(i: int, curve: Curve, crossings: Sequence[Node]) -> Iterator[Arc]:
    """The arcs of one curve between its crossings."""
    n = curve.segments
    for start, end in pairwise(_with_ends(i, curve, sorted(crossings, key=lambda node: node.place))):
        inner = np.arange(int(np.floor(start.place)) + 1, int(np.ceil(end.place)))
        yield Arc(i, start, end, inner % n if curve.closed else inner)


def _with_ends(i: int, curve: Curve, crossings: list[Node]) -> list[Node]:
    """The crossings of a curve with its two ends, or, once round a closed one, with the first of them again."""
    n, first, last = float(curve.segments), curve.points[:, 0], curve.points[:, -1]
    if not curve.closed:
        return [Node(0.0, _rounded(first), first), *crossings, Node(n, _rounded(last), last)]
    if crossings:
        return [*crossings, crossings[0]._replace(place=crossings[0].place + n)]
    return [Node(0.0, (i, "whole"), first), Node(n, (i, "whole"), first)]


def _rounded(point: np.ndarray) -> tuple[float, ...]:
    """A point as something to compare with others, to a tenth of a micrometre."""
    return tuple(np.round(point, 7).tolist())


# ---------------------------------------------------------------- crossings


class _Segments(NamedTuple):
    """The straight segments of some curves: their ends ``(2, k)``, whose they are and the which there."""

    starts: np.ndarray
    ends: np.ndarray
    curve: np.ndarray
    number: np.ndarray

    @property
    def along(self) -> np.ndarray:
        """From start to end."""
        return self.ends - self.starts


def _segments_of(curves: Sequence[Curve]) -> _Segments:
    return _Segments(
        np.hstack([c.points[:, :-1] for c in curves]),
        np.hstack([c.points[:, 1:] for c in curves]),
        np.concatenate([np.full(c.segments, i) for i, c in enumerate(curves)]),
        np.concatenate([np.arange(c.segments) for c in curves]),
    )


def _crossings(curves: Sequence[Curve]) -> list[list[Node]]:
    """For each curve the nodes at which other segments cross it."""
    segments = _segments_of(curves)
    found: list[list[Node]] = [[] for _ in curves]
    for a, b, straight in _crossing_pairs(segments):
        point, shares = _curved_crossing(curves, segments, (a, b), straight)
        for segment, share in zip((a, b), shares, strict=True):
            place = float(segments.number[segment] + share)
            found[segments.curve[segment]].append(Node(place, ("crossing", a, b), point))
    return found


def _crossing_pairs(segments: _Segments) -> Iterator[tuple[int, int, np.ndarray]]:
    """Each two segments that cross and are no neighbours, and the shares of them at which they do."""
    low, high = np.minimum(segments.starts, segments.ends), np.maximum(segments.starts, segments.ends)
    for first in range(0, low.shape[1], BLOCK):
        (x0, y0), (x1, y1) = (ends[:, first : first + BLOCK, None] for ends in (low, high))
        (left, below), (right, above) = (ends[:, first:] for ends in (low, high))
        i, j = np.nonzero((x0 <= right) & (left <= x1) & (y0 <= above) & (below <= y1))
        i, j = first + i[i < j], first + j[i < j]
        shares = _straight_crossing(segments, i, j)
        for k in np.flatnonzero(((shares >= 0) & (shares < 1)).all(0)):
            a, b = int(i[k]), int(j[k])
            if not _neighbours(segments, a, b):
                yield a, b, shares[:, k]


def _straight_crossing(segments: _Segments, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """The shares of segments ``i`` and ``j``, ``(2, k)``, at which the straight lines along them cross."""
    one, other = segments.along[:, i], segments.along[:, j]
    apart = segments.starts[:, j] - segments.starts[:, i]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.stack([_cross(apart, other), _cross(apart, one)]) / _cross(one, other)


def _neighbours(segments: _Segments, a: int, b: int) -> bool:
    """Whether two segments share an end."""
    p, q = (np.stack([segments.starts[:, k], segments.ends[:, k]]) for k in (a, b))
    return bool((abs(p[:, None] - q[None]).max(-1) <= SAME).any())


def _curved_crossing(
    curves: Sequence[Curve], segments: _Segments, pair: tuple[int, int], straight: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where two curves cross, and at which shares of their segments, from where the straight segments do."""
    a = pair[0]
    on_line = segments.starts[:, a] + straight[0] * segments.along[:, a]
    one, other = (_cubic(curves[segments.curve[k]], int(segments.number[k])) for k in pair)
    point, shares = _met(one, other, straight)
    shorter = np.hypot(*segments.along[:, list(pair)]).min()
    return (point, shares) if np.hypot(*(point - on_line)) < NEAR * shorter else (on_line, straight)


def _cubic(curve: Curve, segment: int) -> np.ndarray:
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
