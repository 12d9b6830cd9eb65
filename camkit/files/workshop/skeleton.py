"""The skeleton of a linkage, and the tube of a shaft, as a DXF drawing."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...data.tubes import TUBE_FILES, standard_tubes
from ...linkage import RSSRAnalysis
from ...machines.shaft_analysis import ShaftAnalysis, nearest_of
from ...quantities import Quantity, declarations, words
from ...quantities.extras import extra
from ...quantities.types import Array
from ...units import in_unit, mm
from .dxf_sheet import without_codes
from .subject import analysis_of, design_of
from .title import TitleBlock
from .written import LENGTHS, Made, length_unit

SAME = 1e-7
"""Diameters that differ by less (m) are one."""
LINKS = "CRANK", "COUPLER", "ROCKER"
LAYERS = "CRANK", "COUPLER", "ROCKER", "FRAME", "PATHS", "TUBE", "BORE", "CENTRE", "JOINTS", "NOTES"
COLOURS = dict(zip(LAYERS, (1, 3, 5, 8, 9, 7, 8, 1, 5, 8), strict=True))
"""Of the layers, by AutoCAD's numbers."""
REACH = 0.2
"""How far the axes are drawn beyond a link's root, in lengths of the longest link."""


TEXT = 5 * mm
"""Height of the notes."""


class Drawn(NamedTuple):
    """A polyline in space, ``(3, n)``, m, and its layer."""

    layer: str
    points: Array


def skeleton(given: object, *, unit: str = "mm", title: TitleBlock = TitleBlock()) -> Made:
    """A drawing of the links of a linkage as lines in space, or of a shaft's tube from the side, as DXF.

    Of a linkage: crank, coupler and rocker at the first position on layers of these names, both axes and the common
    perpendicular on ``FRAME``, the paths of both ball joints on ``PATHS``.  Of a shaft: the tube with its bore, both
    joints, and which standard tube it is or comes near to.

    >>> from camkit import RSSR
    >>> skeleton(RSSR(crank=0.02)).what
    '3 links and 2 axes'
    """
    unit, analysis = length_unit(unit), analysis_of(given)
    lines = list(title.lines(type(design_of(given)).__name__, unit))
    if isinstance(analysis, RSSRAnalysis):
        drawn, what = [*_linkage(analysis)], "3 links and 2 axes"
        lines += _sizes(analysis, unit)
    elif isinstance(analysis, ShaftAnalysis):
        drawn, what = [*_tube(analysis)], "a tube between two joints"
    else:
        raise ValueError(f"{type(design_of(given)).__name__} has no lengths in space to be drawn")
    said = tube_callout(analysis)
    data = _dxf(drawn, [*lines, *said], unit)
    return Made(data, what, _deviation(data, drawn, unit), tuple(said))


def tube_callout(analysis: object) -> list[str]:
    """Which tube a shaft has, in sentences: a standard one, or the nearest of each series that keeps every limit.

    Of anything else nothing is said.

    >>> from camkit import UniversalJointShaft
    >>> for line in tube_callout(UniversalJointShaft().analyse()):
    ...     print(line)
    tube 128.64 x 13.43 mm is no standard size
    nearest that keeps every limit: EN 10210-2 139.7 x 12.5
    nearest that keeps every limit: GB/T 17395 133 x 16
    """
    if not isinstance(analysis, ShaftAnalysis):
        return []
    here = analysis.here
    tube = _designation(here)
    standard = [series for series in TUBE_FILES if abs(standard_tubes(series) - here).max(-1).min() < SAME]
    if standard:
        return [f"tube {series} {tube}" for series in standard]
    said = [f"tube {tube} mm is no standard size"]
    for series, tubes in analysis.sizes.holding.items():
        near = _designation(nearest_of(here, tubes)) if len(tubes) else ""
        said.append(
            f"nearest that keeps every limit: {series} {near}" if near else f"none of {series} keeps every limit"
        )
    return said


def _designation(tube: Array) -> str:
    """Outer diameter by wall, mm."""
    outer, inner = in_unit(tube, "mm")
    return f"{outer:.6g} x {(outer - inner) / 2:.4g}"


def _linkage(analysis: RSSRAnalysis) -> Iterator[Drawn]:
    chain, linkage = analysis.chain, analysis.linkage
    for k, layer in enumerate(LINKS):
        yield Drawn(layer, chain[:, k : k + 2, 0])
    reach = REACH * max(linkage.crank, linkage.coupler, linkage.rocker)
    for root, axis, foot in (
        (linkage.crank_root, linkage.crank_axis, np.zeros(3)),
        (linkage.rocker_root, linkage.rocker_axis, np.array([linkage.axis_distance, 0.0, 0.0])),
    ):
        along = sorted((0.0, float((root - foot) @ axis)))
        yield Drawn("FRAME", foot[:, None] + axis[:, None] * np.array([along[0] - reach, along[1] + reach]))
    if linkage.axis_distance:
        yield Drawn("FRAME", np.array([[0.0, linkage.axis_distance], [0.0, 0.0], [0.0, 0.0]]))
    yield from (Drawn("PATHS", points) for points in (analysis.crank_joint, analysis.rocker_joint))


def _tube(analysis: ShaftAnalysis) -> Iterator[Drawn]:
    length, radii = analysis.shaft.length, analysis.here / 2
    ends = np.array([0.0, length])
    for layer, radius in zip(("TUBE", "BORE"), radii, strict=True):
        yield from (Drawn(layer, np.stack([ends, 0 * ends + side * radius, 0 * ends])) for side in (1, -1))
    for x in ends:
        yield Drawn("TUBE", np.array([[x, x], [-radii[0], radii[0]], [0, 0]]))
        yield Drawn("JOINTS", np.array([[x, x], [-1.5 * radii[0], 1.5 * radii[0]], [0, 0]]))
    beyond = np.array([-0.5, 0.5]) * analysis.shaft.outer_diameter
    yield Drawn("CENTRE", np.stack([ends + beyond, 0 * ends, 0 * ends]))


def _sizes(analysis: RSSRAnalysis, unit: str) -> list[str]:
    """The lengths of the links and where their axes are, in words."""
    linkage = analysis.linkage
    texts = {
        name: f"{in_unit(getattr(linkage, name), 'deg' if declared.unit == 'deg' else unit):.6g}"
        for name, declared in declarations(linkage).items()
        if isinstance(declared, Quantity)
    }
    return [f"{words(name)} {text}" + (" deg" if name == "axis_angle" else f" {unit}") for name, text in texts.items()]


def _dxf(drawn: Sequence[Drawn], lines: Sequence[str], unit: str) -> bytes:
    with extra("a drawing"):
        import ezdxf
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM if unit == "mm" else ezdxf.units.IN)
    for layer in dict.fromkeys([*(line.layer for line in drawn), "NOTES"]):
        drawing.layers.add(layer, color=COLOURS[layer])
    space = drawing.modelspace()
    for layer, points in drawn:
        line = in_unit(points, unit).T.tolist()
        if len(line) == 2:
            space.add_line(line[0], line[1], dxfattribs={"layer": layer})
        else:
            space.add_polyline3d(line, dxfattribs={"layer": layer})
    height = in_unit(TEXT, unit)
    corner = in_unit(np.min([points.min(-1) for _, points in drawn], axis=0), unit)
    for k, text in enumerate(map(without_codes, lines), 1):
        where = (float(corner[0]), float(corner[1]) - 2 * k * height)
        space.add_text(text, height=height, dxfattribs={"layer": "NOTES"}).set_placement(where)
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue().encode()


def _deviation(data: bytes, drawn: Sequence[Drawn], unit: str) -> float:
    """How far the ends of lines in a drawing lie from where they are to be, m."""
    import ezdxf

    space = ezdxf.read(io.StringIO(data.decode())).modelspace()
    lines = [np.array([line.dxf.start, line.dxf.end]) for line in space.query("LINE")]
    lines += [np.array([list(v.dxf.location) for v in line.vertices]) for line in space.query("POLYLINE")]  # type: ignore[attr-defined]
    exact = sorted((points for _, points in drawn), key=lambda points: points.shape[1] > 2)
    return max(float(abs(line.T * LENGTHS[unit] - points).max()) for line, points in zip(lines, exact, strict=True))
