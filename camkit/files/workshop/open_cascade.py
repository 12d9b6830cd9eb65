"""Solids of planes and cylinders, made and measured by Open CASCADE, which works in mm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from ...quantities.types import Array
from ...units import mm
from .arcs import ArcPath
from .prisms import Prism

if TYPE_CHECKING:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Solid, TopoDS_Wire

FLAT = 1e-9
"""An arc that rises less than this above its chord is a line, m."""


def solid(added: Sequence[Prism], cut: Sequence[Prism]) -> TopoDS_Solid:
    """The prisms that are ``added``, as one solid, less those that are ``cut``."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
    from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain

    whole = reduce(lambda one, other: BRepAlgoAPI_Fuse(one, other).Shape(), map(prism, added))
    whole = reduce(lambda one, other: BRepAlgoAPI_Cut(one, other).Shape(), map(prism, cut), whole)
    merged = ShapeUpgrade_UnifySameDomain(whole, True, True, False)
    merged.Build()
    (one,) = solids_of(merged.Shape())
    return one


def prism(made: Prism) -> TopoDS_Shape:
    """A solid with a cylinder for every arc and a plane for every line."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec
    from OCP.TopoDS import TopoDS

    face = BRepBuilderAPI_MakeFace(wire(made.outline, made.low), True)
    for hole in made.holes:
        face.Add(TopoDS.Wire(wire(hole, made.low).Reversed()))
    return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, (made.high - made.low) / mm)).Shape()


def wire(path: ArcPath, height: float) -> TopoDS_Wire:
    """A closed path at a height (m) over the plane."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex, BRepBuilderAPI_MakeWire
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.gp import gp_Pnt

    chord = path.ends - path.starts
    middles = (path.starts + path.ends + path.bulges * np.stack([chord[1], -chord[0]])) / 2
    points, between = ([gp_Pnt(*at, height / mm) for at in (x / mm).T] for x in (path.starts, middles))
    vertices = [BRepBuilderAPI_MakeVertex(point).Vertex() for point in points]
    bent = abs(path.bulges) * np.hypot(*chord) / 2 > FLAT
    made = BRepBuilderAPI_MakeWire()
    for k in range(len(points)):
        ends, to = (vertices[k], vertices[k + 1 - len(points)]), points[k + 1 - len(points)]
        curve = (GC_MakeArcOfCircle(points[k], between[k], to).Value(),) if bent[k] else ()
        made.Add(BRepBuilderAPI_MakeEdge(*curve, *ends).Edge())
    return made.Wire()


def solids_of(shape: TopoDS_Shape) -> list[TopoDS_Solid]:
    """The solids in a shape."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return [TopoDS.Solid(each) for each in _each(shape, TopAbs_ShapeEnum.TopAbs_SOLID)]


def faces_of(shape: TopoDS_Shape) -> list[TopoDS_Face]:
    """The faces of a shape."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return [TopoDS.Face(each) for each in _each(shape, TopAbs_ShapeEnum.TopAbs_FACE)]


def _each(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    from OCP.TopExp import TopExp_Explorer

    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def valid(shape: TopoDS_Shape) -> bool:
    """Whether Open CASCADE finds nothing wrong with it."""
    from OCP.BRepCheck import BRepCheck_Analyzer

    return bool(BRepCheck_Analyzer(shape).IsValid())


def volume(shape: TopoDS_Shape) -> float:
    """Of a solid whose faces look outwards, m^3."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, found)
    return float(found.Mass()) * mm**3


def outlines(shape: TopoDS_Shape, height: float) -> list[ArcPath]:
    """The edges around the flat faces of a solid at a height (m)."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    return [
        _outline(TopoDS.Wire(wire), face)
        for face in faces_of(shape)
        if _lies_at(face, height / mm)
        for wire in _each(face, TopAbs_ShapeEnum.TopAbs_WIRE)
    ]


def _lies_at(face: TopoDS_Face, height: float) -> bool:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    surface = BRepAdaptor_Surface(face)
    if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_Plane:
        return False
    plane = surface.Plane()
    return abs(abs(plane.Axis().Direction().Z()) - 1) < 1e-9 and abs(plane.Location().Z() - height) < 1e-6


def _outline(wire: TopoDS_Wire, face: TopoDS_Face) -> ArcPath:
    """Every edge as two arcs, since one may be a whole circle."""
    from OCP.BRepTools import BRepTools_WireExplorer

    explorer, found = BRepTools_WireExplorer(wire, face), []
    while explorer.More():
        found.append(_places(explorer.Current()))
        explorer.Next()
    start, before, middle, after, end = np.stack(found, axis=-1)
    from_, to = (np.stack(pair, axis=-1).reshape(2, -1) for pair in ((start, middle), (middle, end)))
    across, rise = to - from_, np.stack([before, after], axis=-1).reshape(2, -1) - (from_ + to) / 2
    bulges = 2 * (rise[0] * across[1] - rise[1] * across[0]) / (across**2).sum(0)
    return ArcPath("", from_, bulges, True)


def _places(edge: TopoDS_Edge) -> Array:
    """Five points of an edge in its direction, ``(5, 2)``, m."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.TopAbs import TopAbs_Orientation

    curve = BRepAdaptor_Curve(edge)
    at = (curve.Value(place) for place in np.linspace(curve.FirstParameter(), curve.LastParameter(), 5))
    points = np.array([[point.X(), point.Y()] for point in at]) * mm
    return points[::-1] if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else points


def round_bar(start: Array, end: Array, outer: float, inner: float) -> TopoDS_Solid:
    """A bar from one point in space to another, with diameters (m); with an inner one above 0 a tube."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    along = np.asarray(end) - start
    axes = gp_Ax2(gp_Pnt(*np.asarray(start) / mm), gp_Dir(*along / np.linalg.norm(along)))
    whole, *hole = (
        BRepPrimAPI_MakeCylinder(axes, diameter / 2 / mm, float(np.linalg.norm(along)) / mm).Shape()
        for diameter in (outer, inner)
        if diameter > 0
    )
    (one,) = solids_of(BRepAlgoAPI_Cut(whole, *hole).Shape() if hole else whole)
    return one


def flat_centres(shape: TopoDS_Shape) -> Array:
    """The centres of the flat faces of a shape, ``(3, n)``, m."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.BRepGProp import BRepGProp
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.GProp import GProp_GProps

    found = []
    for face in faces_of(shape):
        if BRepAdaptor_Surface(face).GetType() == GeomAbs_SurfaceType.GeomAbs_Plane:
            about = GProp_GProps()
            BRepGProp.SurfaceProperties_s(face, about)
            found.append([about.CentreOfMass().Coord(axis) for axis in (1, 2, 3)])
    return np.transpose(found) * mm
