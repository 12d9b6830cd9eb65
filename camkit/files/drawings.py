"""Closed outlines in a DXF drawing: lines and arcs as they are, splines and ellipses by points on them."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..quantities.extras import extra
from ..quantities.kinds import shown
from ..quantities.types import Array
from ..units import inch, mm, um

UNITS = {1: inch, 2: 12 * inch, 4: mm, 5: 10 * mm, 6: 1.0, 8: 1e-6 * inch, 9: 1e-3 * inch, 13: um, 14: 0.1}
"""What a unit of a drawing is worth in m, by the number in its header."""
NAMES = {"mm": mm, "cm": 10 * mm, "m": 1.0, "um": um, "in": inch, "thou": inch / 1000}
NEAR, GAP = 1e-6, 0.02 * mm
"""Ends closer than this (m) meet; a gap of an outline that is not wider is closed."""
MOST_ENTITIES, MOST_POINTS = 20_000, 20_000
"""Of a drawing that is read, and of one of its entities."""
ON_CURVE = 240
"""Points on a spline or an ellipse."""
KINDS = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "SPLINE", "ELLIPSE")


class Edge(NamedTuple):
    """Corners ``(2, n)`` in m, each but the last with the bulge of the way to the next; on which layer."""

    corners: Array
    bulges: Array
    layer: str
    exact: bool = True

    @property
    def backwards(self) -> Edge:
        return self._replace(corners=self.corners[:, ::-1], bulges=-self.bulges[::-1])


@dataclass(frozen=True)
class Loop:
    """A closed outline of a drawing, and by how much its widest gap was open, m."""

    corners: Array
    bulges: Array
    layer: str
    exact: bool
    gap: float


class Drawing(NamedTuple):
    """What a drawing has: closed loops; open chains by where and how wide they are open; what was not read."""

    loops: tuple[Loop, ...]
    open: tuple[tuple[Array, float], ...]
    unit: str
    worth: float
    """What its unit is worth, m."""
    left: tuple[str, ...]


def is_drawing(data: bytes) -> bool:
    """Whether the bytes of a file look like a DXF drawing."""
    start = data[:200].lstrip(b"\xef\xbb\xbf \t\r\n")
    first = start.split(b"\n", 1)[0].strip()
    return data.startswith(b"AutoCAD Binary DXF") or (first in (b"0", b"999") and b"\n" in start)


def drawing_of(data: bytes, unit: str | None) -> Drawing:
    """The outlines in the bytes of a DXF file; ``ValueError`` in a sentence for what cannot be read."""
    with extra("a DXF drawing"):
        from ezdxf import recover
    try:
        document, _ = recover.read(io.BytesIO(data))
        entities = list(document.modelspace())
        header = int(document.header.get("$INSUNITS", 0))
    except Exception as error:  # whatever a damaged drawing makes of its reader
        raise ValueError(f"the drawing cannot be read ({shown(str(error))}); save it again as DXF") from None
    if len(entities) > MOST_ENTITIES:
        raise ValueError(f"the drawing has {len(entities)} entities; at most {MOST_ENTITIES} are read")
    said, worth = _worth(unit, header)
    edges = [edge for entity in entities if entity.dxftype() in KINDS for edge in edges_of(entity, worth)]
    left = sorted({entity.dxftype() for entity in entities} - {*KINDS, "TEXT", "MTEXT", "POINT", "DIMENSION"})
    loops, ways = _chained([edge for edge in edges if np.isfinite(edge.corners).all() and edge.corners.shape[1] > 1])
    return Drawing(tuple(loops), tuple(ways), said, worth, tuple(left))


def _worth(unit: str | None, header: int) -> tuple[str, float]:
    if unit is not None:
        return f"coordinates in {unit}", NAMES[unit]
    if header in UNITS:
        names = {worth: name for name, worth in NAMES.items()}
        return f"coordinates in {names.get(UNITS[header], f'{UNITS[header] / mm:.6g} mm')} by its header", UNITS[header]
    return "coordinates in mm as its header names no unit", mm


def edges_of(entity: Any, worth: float) -> Iterator[Edge]:
    """What an entity draws; nothing of one that says too little or nonsense."""
    try:
        corners, bulges, exact = SHAPES[entity.dxftype()](entity)
    except Exception:  # an entity without its numbers
        return
    corners = np.asarray(corners, dtype=float).reshape(-1, 2).T * worth
    bulges = np.asarray(bulges, dtype=float)
    if corners.shape[1] == len(bulges):  # closed: back to the first corner
        corners = np.column_stack([corners, corners[:, 0]])
    if 1 < corners.shape[1] <= MOST_POINTS and np.isfinite(bulges).all():
        far = np.hypot(*np.diff(corners)) > NEAR
        corners = np.column_stack([corners[:, :1], corners[:, 1:][:, far]])
        yield Edge(corners, bulges[far], str(entity.dxf.layer), exact)


def _flat(entity: Any, points: Iterable[Any]) -> tuple[list[tuple[float, float]], float]:
    """Points of an entity in the plane of the drawing, and -1 where it is seen from behind."""
    ocs, found = entity.ocs(), [entity.ocs().to_wcs(point) for point in points]
    return [(point.x, point.y) for point in found], -1.0 if ocs.uz.z < 0 else 1.0


def _line(entity: Any) -> tuple[Any, Any, bool]:
    start, end = entity.dxf.start, entity.dxf.end
    return [(start.x, start.y), (end.x, end.y)], [0.0], True


def _arc(entity: Any) -> tuple[Any, Any, bool]:
    turn = np.radians((entity.dxf.end_angle - entity.dxf.start_angle) % 360 or 360)
    half = np.radians(entity.dxf.start_angle) + np.array([0.0, turn / 2, turn])  # two halves: a bulge of 1 at most
    return _round(entity, half, np.tan(turn / 8))


def _circle(entity: Any) -> tuple[Any, Any, bool]:
    return _round(entity, np.array([0.0, np.pi, 2 * np.pi]), 1.0)


def _round(entity: Any, angles: Array, bulge: float) -> tuple[Any, Any, bool]:
    from ezdxf.math import Vec3

    centre, radius = entity.dxf.center, float(entity.dxf.radius)
    corners, side = _flat(entity, [Vec3.from_angle(float(a), radius) + centre for a in angles])
    return corners, [side * bulge] * 2, True


def _polyline(entity: Any) -> tuple[Any, Any, bool]:
    from ezdxf.math import Vec3

    if entity.dxftype() == "LWPOLYLINE":
        given = [(x, y, bulge) for x, y, bulge in entity.get_points("xyb")]
        level, closed = float(entity.dxf.elevation), bool(entity.closed)
    else:
        vertices = list(entity.vertices)
        given = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in vertices]
        level, closed = 0.0, bool(entity.is_closed)
    corners, side = _flat(entity, [Vec3(x, y, level) for x, y, _ in given])
    bulges = [side * bulge for _, _, bulge in given]
    return corners, bulges if closed else bulges[:-1], True


def _spline(entity: Any) -> tuple[Any, Any, bool]:
    curve = entity.construction_tool()
    if curve.count * curve.degree > MOST_POINTS:
        raise ValueError("too many control points")
    points = list(curve.approximate(max(ON_CURVE, 4 * curve.count)))
    return [(p.x, p.y) for p in points], [0.0] * (len(points) - 1), False


def _ellipse(entity: Any) -> tuple[Any, Any, bool]:
    points = list(entity.vertices(entity.params(ON_CURVE)))
    return [(p.x, p.y) for p in points], [0.0] * (len(points) - 1), False


SHAPES: dict[str, Callable[[Any], tuple[Any, Any, bool]]] = {
    "LINE": _line,
    "ARC": _arc,
    "CIRCLE": _circle,
    "LWPOLYLINE": _polyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
    "ELLIPSE": _ellipse,
}
"""Corners and bulges of each kind of entity, as many bulges as corners where it is closed, and whether it is exact."""


def _chained(edges: Sequence[Edge]) -> tuple[list[Loop], list[tuple[Array, float]]]:
    """Edges of a layer joined end to end, whichever way each was drawn: the closed loops, and where others are open."""
    loops: list[Loop] = []
    gaps: list[tuple[Array, float]] = []
    for layer in dict.fromkeys(edge.layer for edge in edges):
        for chain, gap in _chains([edge for edge in edges if edge.layer == layer]):
            if gap <= GAP:
                loops.append(_loop(chain, gap))
            else:
                gaps.append((chain[-1].corners[:, -1], gap))
    return loops, gaps


def _chains(edges: Sequence[Edge]) -> Iterator[tuple[list[Edge], float]]:
    """Rows of edges, and the widest gap in each, between its end and its start too."""
    from scipy.spatial import cKDTree

    if not edges:
        return
    ends = np.concatenate([np.stack([edge.corners[:, 0], edge.corners[:, -1]]) for edge in edges])
    tree, free = cKDTree(ends), set(range(len(edges)))
    while free:
        first = min(free)
        free.discard(first)
        chain, gap = [edges[first]], 0.0
        while np.hypot(*(chain[-1].corners[:, -1] - chain[0].corners[:, 0])) > NEAR:
            near = [k for k in tree.query_ball_point(chain[-1].corners[:, -1], GAP) if k // 2 in free]
            if not near:
                break
            k = min(near, key=lambda k: float(np.hypot(*(ends[k] - chain[-1].corners[:, -1]))))
            gap = max(gap, float(np.hypot(*(ends[k] - chain[-1].corners[:, -1]))))
            free.discard(k // 2)
            chain.append(edges[k // 2].backwards if k % 2 else edges[k // 2])
        yield chain, max(gap, float(np.hypot(*(chain[-1].corners[:, -1] - chain[0].corners[:, 0]))))


def _loop(chain: Sequence[Edge], gap: float) -> Loop:
    corners = np.column_stack([edge.corners[:, :-1] for edge in chain])
    bulges = np.concatenate([edge.bulges for edge in chain])
    return Loop(corners, bulges, chain[0].layer, all(edge.exact for edge in chain), gap)
