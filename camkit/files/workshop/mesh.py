"""Cams as watertight meshes of triangles, put together by manifold, which works in mm here."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...quantities.types import Array
from ...units import mm
from .arcs import ArcPath
from .prisms import Part, Prism

if TYPE_CHECKING:
    from manifold3d import Manifold

NEAR = 24
"""So many triangles are looked at for the one that a point is nearest to."""


class Mesh(NamedTuple):
    """A body in space: its points ``(n, 3)``, m, and its triangles ``(k, 3)``, counter-clockwise from outside."""

    points: Array
    triangles: Array

    @property
    def watertight(self) -> bool:
        """Whether every edge of a triangle is the edge of one other, the other way round."""
        start, end = self.triangles.ravel(), np.roll(self.triangles, -1, axis=1).ravel()
        ahead, back = start * len(self.points) + end, end * len(self.points) + start
        return len(np.unique(ahead)) == len(ahead) and np.array_equal(np.sort(ahead), np.sort(back))

    @property
    def volume(self) -> float:
        """Of the tetrahedra from the origin to all triangles, m^3; above 0 where normals lead outwards."""
        a, b, c = np.moveaxis(self.points[self.triangles], 1, 0)
        return float((a * np.cross(b, c)).sum() / 6)

    @property
    def area(self) -> float:
        """Of its surface, m^2."""
        a, b, c = np.moveaxis(self.points[self.triangles], 1, 0)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=-1).sum() / 2)

    def moved(self, x: float) -> Mesh:
        """The same along the x axis, m."""
        return Mesh(self.points + np.array([x, 0.0, 0.0]), self.triangles)


def mesh(part: Part, tolerance: float) -> Mesh:
    """A cam, its arcs as chords that keep the tolerance (m)."""
    whole = reduce(lambda one, other: one + other, (body(prism, tolerance) for prism in part.added))
    return as_mesh(reduce(lambda one, other: one - other, (body(prism, tolerance) for prism in part.cut), whole))


def as_mesh(made: Manifold) -> Mesh:
    """What manifold has made, in m."""
    found = made.to_mesh64()
    return Mesh(found.vert_properties[:, :3] * mm, found.tri_verts.astype(np.int64))


def body(prism: Prism, tolerance: float) -> Manifold:
    """A prism whose arcs are chords."""
    from manifold3d import CrossSection, FillRule, Manifold

    rings = [chords(path, tolerance).T / mm for path in (prism.outline, *prism.holes)]
    section = CrossSection(rings, FillRule.EvenOdd)
    return Manifold.extrude(section, (prism.high - prism.low) / mm).translate((0, 0, prism.low / mm))


def chords(path: ArcPath, tolerance: float) -> Array:
    """Points ``(2, n)`` on a closed path, between which it rises no more than the tolerance (m)."""
    turns, long = 4 * np.arctan(abs(path.bulges)), np.hypot(*(path.ends - path.starts))
    rise = tolerance * 2 * np.sin(turns / 2) / long  # over the arc's radius
    steps = np.ceil(turns / np.maximum(2 * np.arccos(1 - np.minimum(rise, 1)), 1e-9)).clip(1).astype(int)
    one = (
        ArcPath("", np.stack([start, end], axis=1), bulge[None], False).points(count)[:, :-1]
        for start, end, bulge, count in zip(path.starts.T, path.ends.T, path.bulges, steps, strict=True)
    )
    return np.hstack(list(one))


def off(body: Mesh, points: Array) -> Array:
    """How far points ``(n, 3)`` are from the surface of a mesh, m, nearest to triangles whose middle is near."""
    from scipy.spatial import cKDTree

    corners = body.points[body.triangles]
    _, near = cKDTree(corners.mean(1)).query(points, k=min(NEAR, len(corners)))
    return _from_triangles(points[:, None], *np.moveaxis(corners[near], 2, 0)).min(1)


def _from_triangles(points: Array, a: Array, b: Array, c: Array) -> Array:
    """Distances from triangles: to the plane where the foot lies within, or else to the nearest side."""
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=-1)
    level = abs(((points - a) * normal).sum(-1)) / np.where(size > 0, size, 1.0)
    pairs = ((a, b), (b, c), (c, a))
    within = reduce(np.logical_and, ((np.cross(q - p, points - p) * normal).sum(-1) >= 0 for p, q in pairs), size > 0)
    return np.where(within, level, reduce(np.minimum, (_from_side(points, p, q) for p, q in pairs)))


def _from_side(points: Array, p: Array, q: Array) -> Array:
    way = q - p
    square = (way**2).sum(-1)
    share = np.clip(((points - p) * way).sum(-1) / np.where(square > 0, square, 1.0), 0, 1)
    return np.linalg.norm(points - p - share[..., None] * way, axis=-1)
