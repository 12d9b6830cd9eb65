"""The lines of a DXF drawing as paths of arcs, each by itself, to compare them with what was to be drawn."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from ...quantities.extras import extra
from ..drawings import UNITS, edges_of
from .arcs import ArcPath, biarcs
from .curves import Stretch

if TYPE_CHECKING:
    from ezdxf.entities import DXFGraphic

STEPS = 16
"""Places on a spline from knot to knot, between which it is as good as arcs."""


def paths_of(data: bytes) -> list[ArcPath]:
    """Polylines, lines, arcs, circles and splines in the bytes of a drawing, in m."""
    with extra("a DXF drawing"):
        from ezdxf import recover
    document, _ = recover.read(io.BytesIO(data))
    worth, found = UNITS[document.header["$INSUNITS"]], []
    for entity in document.modelspace():
        if entity.dxftype() == "SPLINE":
            found.append(_of_spline(entity, worth))
        else:
            found += [ArcPath(edge.layer, edge.corners, edge.bulges, False) for edge in edges_of(entity, worth)]
    return found


def _of_spline(entity: DXFGraphic, worth: float) -> ArcPath:
    curve = entity.construction_tool()  # type: ignore[attr-defined]
    knots = np.unique(curve.knots())
    places = np.interp(np.arange(STEPS * (len(knots) - 1) + 1) / STEPS, np.arange(len(knots)), knots)
    pairs = [curve.derivative(float(t), 1) for t in places]
    points, ways = (np.array([(pair[k].x, pair[k].y) for pair in pairs]).T for k in (0, 1))
    corners, bulges = biarcs(Stretch(points * worth, ways / np.hypot(*ways)))
    return ArcPath(entity.dxf.layer, corners, bulges, False)
