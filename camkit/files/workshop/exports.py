"""All that can be written of a design: one list, which the button, the menu of a page and the command line read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from ...quantities import Analysable
from ...quantities.kinds import one_number
from ...study.robust import RobustStudy
from ...study.spread import Source
from ...study.study import NOTHING, Study
from ...units import mm
from .blank import Blank
from .deviations import half_widths
from .faults import has_profile
from .inspection import largest_deviation
from .subject import DRAWN, JOINTED, analysis_of, design_of, subjects
from .tables import LIMIT, table
from .title import TitleBlock
from .written import Made, length_unit


@dataclass(frozen=True)
class Order:
    """What is to be made, and how, with what its sheets are to say."""

    analysis: object
    """All of it: given as a design, an analysis or a panel.  What one file has found of it the others need not find."""
    unit: str = "mm"
    """``"mm"`` or ``"in"``."""
    title: TitleBlock = TitleBlock()
    blank: Blank = Blank()
    tool_radius: float = 5 * mm
    study: Study | None = None
    tolerances: Mapping[str | Source, object] | None = None
    """Half widths by path, SI, or what a `RobustStudy` takes."""
    more: tuple[Export, ...] = ()
    """What there is beside `EXPORTS`: a panel gives the page that it shows."""

    whole: Analysable | None = None
    """The design that was given, where its analysis knows but the cam in it: of pins, a drive, an elastic train."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "whole", self.whole or design_of(self.analysis))
        object.__setattr__(self, "analysis", analysis_of(self.analysis))
        object.__setattr__(self, "unit", length_unit(self.unit))
        one_number(self.tool_radius, "the radius of the tool", "lie above 0 and be finite", lambda r: 0 < r < np.inf)

    @cached_property
    def limits(self) -> tuple[float, float]:
        """How far a point of the profile may be off, m: the same in the drawing and in the inspection file."""
        cams = subjects(self.analysis)
        half = largest_deviation(cams, half_widths(cams[0].design, self.tolerances)) or LIMIT
        return -half, half

    @property
    def design(self) -> Analysable:
        """The whole of it."""
        assert self.whole is not None
        return self.whole

    @property
    def kind(self) -> str:
        """The name of the design's class."""
        return type(self.design).__name__


_, CAD, SOLID, MACHINE, TABLE, RECORD = GROUPS = ("", "Drawing and CAD", "3D", "Machines", "Tables", "Records")
"""Under which headings files are offered, in this order; without one: what is asked for most."""


class Export(NamedTuple):
    """One kind of file."""

    key: str
    """By which a page and the command line ask for it."""
    ending: str
    """Of its name, behind the kind of the design."""
    group: str
    """Its heading, one of `GROUPS`."""
    words: str
    """What it is called."""
    use: str
    """Who takes it, and what for."""
    make: Callable[[Order], Made]
    of: Callable[[Order], bool] = lambda order: True
    """Whether there can be one."""


def _cam(order: Order) -> bool:
    return has_profile(order.analysis)


def _json(order: Order) -> Made:
    from ..designs import to_json

    return Made(to_json(order.design).encode(), "the design, all of its numbers with units")


def _study(order: Order) -> Made:
    from ..designs import to_json
    from ..sessions import Session

    assert order.study is not None
    session = Session(order.study.around(order.design), order.design)
    return Made(to_json(session).encode(), "the design with its limits, objectives and what may change")


def _dxf(order: Order) -> Made:
    from .dxf import dxf

    return dxf(order.analysis, unit=order.unit, blank=order.blank, title=order.title)


def _asks(order: Order) -> bool:
    """Whether there is more to it than limits."""
    return order.study is not None and NOTHING not in order.study.minimise


def _flat(order: Order) -> bool:
    return _cam(order) and not any(subject.drum for subject in subjects(order.analysis))


def _gcode(order: Order) -> Made:
    """With a cutter of the roller's radius where the order's is too large for a groove."""
    from .gcode import gcode

    grooves = [s.analysis for s in subjects(order.analysis) if np.isfinite(s.analysis.outer_profile).all()]
    radius = min([order.tool_radius, *(float(np.ravel(each.cam.roller_radius)[0]) for each in grooves)])
    made = gcode(order.analysis, unit=order.unit, title=order.title, blank=order.blank, tool_radius=radius)
    if radius == order.tool_radius:
        return made
    wide = f"a tool of radius {order.tool_radius / mm:.4g} mm does not go into the groove"
    return replace(made, remarks=(f"{wide}: this is for {radius / mm:.4g} mm", *made.remarks))


def _step(order: Order) -> Made:
    from .solid import step

    return step(order.analysis, unit=order.unit, title=order.title, blank=order.blank)


def _stl(order: Order) -> Made:
    from .printing import stl

    return stl(order.analysis, title=order.title, blank=order.blank)


def _3mf(order: Order) -> Made:
    from .printing import three_mf

    return three_mf(order.analysis, unit=order.unit, title=order.title, blank=order.blank)


def _plate(order: Order) -> bool:
    """Whether there is one profile."""
    outer = getattr(order.analysis, "outer_profile", 0.0)  # a pair has no one profile
    return _flat(order) and not np.isfinite(outer).any()


def _one_motion(order: Order) -> bool:
    return _cam(order) and hasattr(order.analysis, "cam_torque")


def _linkage(order: Order) -> bool:
    return isinstance(order.analysis, JOINTED)


def _drawn(order: Order) -> bool:
    return _cam(order) or isinstance(order.analysis, DRAWN)


def _solid(order: Order) -> bool:
    return _flat(order) or isinstance(order.analysis, DRAWN)


def _table(
    kind: str, ending: str, group: str, words: str, use: str, of: Callable[[Order], bool], key: str = ""
) -> Export:
    def make(order: Order) -> Made:
        return table(
            order.analysis,
            kind,
            ending,
            unit=order.unit,
            title=order.title,
            tool_radius=order.tool_radius,
            limits=order.limits if kind == "inspection" else (-LIMIT, LIMIT),
        )

    return Export(key or kind, ".csv" if key == "csv" else f"-{key or kind}.{ending}", group, words, use, make, of)


TABLES = (
    _table(
        "profile", "csv", TABLE, "Profile (CSV)", "for spreadsheets: points of pitch curve and profile", _cam, "csv"
    ),
    _table("polar", "csv", TABLE, "Radii (CSV)", "for machines and gauges: radius at whole degrees", _flat, "radii"),
    _table(
        "motion",
        "csv",
        TABLE,
        "Motion (CSV)",
        "for spreadsheets: motion, pressure angle, radii, force and torque",
        _cam,
    ),
    _table("motion", "xlsx", TABLE, "Motion (XLSX)", "the same as a workbook", _cam, "workbook"),
    _table("wheel", "csv", MACHINE, "Path of the tool (CSV)", "for grinders: where the wheel's centre stands", _plate),
    _table("inspection", "csv", MACHINE, "Inspection (CSV)", "for measuring machines: points, normals, limits", _cam),
    _table("joints", "csv", TABLE, "Joints (CSV)", "for CAD: where the joints are over the turn", _linkage),
    _table("solidworks", "sldcrv", CAD, "Curve for SolidWorks", "Curve Through XYZ Points", _plate),
    _table("inventor", "xlsx", CAD, "Curve for Inventor", "Import Points", _plate),
    _table("creo", "ibl", CAD, "Curve for Creo", "Curve from File", _plate),
    _table("nx", "dat", CAD, "Curve for NX", "Spline from Points from File", _plate),
    _table("codesys", "csv", MACHINE, "Cam table for CODESYS", "rows of the cam editor", _one_motion),
    _table("twincat", "csv", MACHINE, "Cam table for TwinCAT", "rows of MC_MotionFunctionPoint", _one_motion),
    _table("kollmorgen", "csv", MACHINE, "Cam profile for Kollmorgen KAS", "Import Cam Profile", _one_motion),
    _table(
        "rockwell", "csv", MACHINE, "Cam array for Rockwell Logix", "MASTER, SLAVE, SegmentType for MCCP", _one_motion
    ),
)
"""Tables and points of it."""


def _drawing(order: Order, ending: str) -> Made:
    from .drawing import drawing

    return drawing(
        order.analysis,
        ending,
        tolerances=order.tolerances,
        profile_tolerance=2 * order.limits[1],
        blank=order.blank,
        unit=order.unit,
        title=order.title,
    )


def _report(order: Order, ending: str) -> Made:
    from .report import report

    known = order.study is None or isinstance(order.study, RobustStudy)  # without limits every part is good
    within = None if known else order.tolerances
    given = order.analysis if design_of(order.analysis) is order.design else order.design
    return report(given, ending, order.title, order.study, within, order.unit, order.blank)


EXPORTS = (
    Export(
        "json", ".json", "", "Design (JSON)", "for camkit: opens again in a notebook, a page or 'camkit check'", _json
    ),
    Export("dxf", ".dxf", CAD, "Profile or skeleton (DXF)", "for laser, wire erosion, milling and CAD", _dxf, _drawn),
    Export(
        "drawing",
        "-drawing.pdf",
        CAD,
        "Drawing (PDF)",
        "for the maker and for inspection: to scale, with dimensions and a table of radii",
        partial(_drawing, ending=".pdf"),
        _cam,
    ),
    Export(
        "picture",
        "-drawing.svg",
        CAD,
        "Drawing (SVG)",
        "for the maker: the same to be printed from a browser or opened in Inkscape",
        partial(_drawing, ending=".svg"),
        _cam,
    ),
    Export(
        "step",
        ".step",
        SOLID,
        "Solid (STEP)",
        "for CAD, CAM and inspection: a cam with bore, keyway and hub, links as bars, a shaft as its tube",
        _step,
        _solid,
    ),
    Export("stl", ".stl", SOLID, "Mesh (STL)", "for 3D printing, in mm", _stl, _cam),
    Export("3mf", ".3mf", SOLID, "Mesh (3MF)", "for 3D printing, with its unit and title", _3mf, _cam),
    Export(
        "nc",
        ".ngc",
        MACHINE,
        "Tool path (G-code)",
        "for a milling machine: LinuxCNC, arcs, feeds to be set",
        _gcode,
        _flat,
    ),
    *TABLES,
    Export(
        "report",
        "-report.pdf",
        RECORD,
        "Report (PDF)",
        "for colleagues: one or two A4 pages",
        partial(_report, ending=".pdf"),
    ),
    Export(
        "page",
        "-report.html",
        RECORD,
        "Report (HTML)",
        "for colleagues, in a browser",
        partial(_report, ending=".html"),
    ),
    Export("study", "-study.json", RECORD, "Study (JSON)", "for camkit: limits and objectives", _study, _asks),
)
"""All files that can be made of a design alone."""


def exports_of(order: Order) -> tuple[Export, ...]:
    """What there can be of a design, in the order in which it is offered."""
    found = (export for export in (*EXPORTS, *order.more) if export.of(order))
    return tuple(sorted(found, key=lambda export: GROUPS.index(export.group)))
