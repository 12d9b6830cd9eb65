"""Tables of a cam, a linkage or a shaft: for people, spreadsheets, CAD, inspection and controllers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar

import numpy as np

from ...cam.analysis import CamAnalysis
from ...quantities.applied import a_new_file
from ...quantities.kinds import numbers, refuse_arguments, shown
from ...quantities.types import Array
from ...units import deg, in_unit, mm, um
from .cad_curves import CAD, cad_curve
from .columns import Table, Units, motion_columns, polar_columns, profile_columns, slides, stacked, wheel_columns
from .controllers import FORMS, controller_table
from .deviations import Within, half_widths
from .faults import has_profile, marked
from .inspection import inspection_columns
from .joints import joint_columns
from .named import curves_of
from .sheets import ENDINGS, Sheet, numbers_in
from .subject import analysis_of, design_of, frame, subjects
from .title import TitleBlock
from .toolpath import tool_path
from .written import LENGTHS, Made, Written, length_unit, refuse_ending, written

T = TypeVar("T")
KINDS = {
    "profile": "pitch curve and profile by the cam angle, in space that of a drum",
    "polar": "radius by direction",
    "motion": "s, v, a, j, pressure angle, radii of curvature, contact force and torque by the cam angle",
    "wheel": "centre of a grinding wheel or a cutter by direction",
    "inspection": "points with normals and limits, for a coordinate measuring machine",
    "joints": "joints of a linkage or a shaft over the turn",
    **{program: "points of one curve for CAD" for program in CAD},
    **{form: "cam table of a controller" for form in FORMS},
}
"""The kinds of tables, and what each is."""
LIMIT = 25 * um
"""Deviation that a probed point may have to either side, where nobody says another."""


def write_table(
    cam: object,
    path: str | Path,
    kind: str = "profile",
    *,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    step: float = 1 * deg,
    curve: str = "",
    tool_radius: float = 5 * mm,
    limits: tuple[float, float] = (-LIMIT, LIMIT),
    tolerances: Within | None = None,
    decimal: str = ".",
) -> Written:
    """Write a table of a design, an analysis or a panel, of one of `KINDS`; as CSV or XLSX, by the ending of ``path``.

    ``unit`` is ``"mm"`` or ``"in"``; with inches forces are in lbf and torques in lbf in.  ``step`` (rad) is that of
    the rows of ``polar``, ``wheel``, ``motion`` and cam tables, which also have rows where the motion needs them.
    ``tool_radius`` (m) is that of the wheel (see `tool_path`), ``limits`` (m) are those of the deviation of every
    probed point; with ``tolerances`` (half widths by path, SI, or `Tolerances`) that move the cam they are what the
    worst part within them deviates by, point by point.  The first row are headings with units, the last column's says
    where the table comes from (`title`) and is empty below; a decimal comma goes with semicolons.  Both cams of a pair
    stand below each other, as they are on their shaft.

    ``solidworks``, ``inventor``, ``creo`` and ``nx`` are points of one ``curve``, without headings (see `cad_curves`),
    ``codesys``, ``twincat``, ``kollmorgen`` and ``rockwell`` cam tables of one motion (see `controllers`); where there
    are several the sentence that asks names them.

    >>> from tempfile import TemporaryDirectory
    >>> from camkit import TranslatingRollerCam
    >>> with TemporaryDirectory() as folder:
    ...     print(write_table(TranslatingRollerCam(), f"{folder}/radii.csv", "polar").what)
    360 rows of polar

    Raises ``ValueError`` in a sentence for a kind, a unit or a curve that there is not.
    """
    refuse_arguments(write_table, locals())
    path = a_new_file(path)
    ending = path.suffix.lower().lstrip(".")
    more = table(
        cam,
        kind,
        ending,
        unit=unit,
        title=title,
        step=step,
        curve=curve,
        tool_radius=tool_radius,
        limits=limits,
        tolerances=tolerances,
        decimal=decimal,
    )
    return written(more, path)


def table(
    cam: object,
    kind: str = "profile",
    ending: str = "csv",
    *,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    step: float = 1 * deg,
    curve: str = "",
    tool_radius: float = 5 * mm,
    limits: tuple[float, float] = (-LIMIT, LIMIT),
    tolerances: Within | None = None,
    decimal: str = ".",
) -> Made:
    """The same as bytes, with the ``ending`` of the file's name."""
    if kind not in KINDS:
        raise ValueError(f"the kind of the table is {shown(kind)}; it must be one of {', '.join(KINDS)}")
    _refuse_ending(kind, ending)
    unit = length_unit(unit)
    tool = f"tool radius {in_unit(tool_radius, unit):.6g} {unit}" if kind == "wheel" else ""
    title = marked(title, cam) if has_profile(analysis_of(cam)) else title
    lines = title.lines(type(design_of(cam)).__name__, unit, tool)
    if kind in CAD:
        return cad_curve(_one_of(_curves(cam), curve, "curve"), kind, unit, lines, ending)
    if kind in FORMS:
        motion = _one_of(_motions(cam), curve, "motion")
        return controller_table(motion.cam.motion, kind, unit if slides(motion) else "deg", step)
    path = tool_path(cam, tool_radius) if kind == "wheel" else None
    columns = (
        {"": wheel_columns(path, Units(unit), step)}
        if path
        else _columns(cam, kind, Units(unit), step, limits, tolerances)
    )
    whole = stacked(columns, "cam")
    if has_profile(analysis_of(cam)):
        lines = (*lines, frame(subjects(cam), unit), "directions run counter-clockwise from x")
    data = Sheet(whole, lines).written(ending, decimal)
    rows = len(next(iter(whole.values())))
    away = np.nan if kind == "motion" else _deviation(whole, numbers_in(data, decimal), unit)
    remarks = (*map(str, path.uncut), *path.remarks) if path else ()
    return Made(data, f"{rows} rows of {kind}", away, remarks)


def _refuse_ending(kind: str, ending: str) -> None:
    """Points for CAD that are no file have no ending."""
    if ending or kind not in CAD:
        refuse_ending(ending, f"a table of {kind}", CAD.get(kind, ("csv",) if kind in FORMS else ENDINGS))


def _columns(
    cam: object, kind: str, units: Units, step: float, limits: tuple[float, float], tolerances: Within | None
) -> Mapping[str, Table]:
    """The columns of a table of every cam by name, or of the one mechanism."""
    if kind == "joints":
        joints = joint_columns(analysis_of(cam), units)
        if joints is None:
            raise ValueError(f"{type(design_of(cam)).__name__} has no joints in space; a linkage or a shaft has")
        return {"": joints}
    make = {
        "profile": lambda one: profile_columns(one, units),
        "polar": lambda one: polar_columns(one, units, step),
        "motion": lambda one: motion_columns(one, units, step),
        "inspection": lambda one: inspection_columns(one, units, _limits(limits), half_widths(one.design, tolerances)),
    }[kind]
    return {one.name: make(one) for one in subjects(cam)}


def _limits(given: object) -> tuple[float, float]:
    lower, upper = numbers(given, "the limits of the deviation (m), lower and upper,").tolist()
    if not -np.inf < lower < upper < np.inf:
        raise ValueError(f"the limits of the deviation are {shown(given)}; the lower must be below the upper, m")
    return lower, upper


def _curves(cam: object) -> dict[str, list[Array]]:
    return {f"{one.name} {name}".strip(): parts for one in subjects(cam) for name, parts in curves_of(one).items()}


def _motions(cam: object) -> dict[str, CamAnalysis]:
    """The motion of every curve of a cam; of a pair that of the first, which the follower has."""
    return dict(subjects(cam)[0].analysis.curves)


def _one_of(there: Mapping[str, T], name: str, what: str) -> T:
    """That of some things which is named, or the only one, or the profile of a cam."""
    default = [key for key in there if key == "profile"] or list(there)
    if not name and len(default) == 1:
        return there[default[0]]
    if name not in there:
        asked = f"there is no {what} {shown(name)}" if name else f"there are several {what}s"
        raise ValueError(f"{asked}; curve= must be one of {', '.join(map(repr, there))}")
    return there[name]


def _deviation(given: Table, read: Table, unit: str) -> float:
    """By how much the lengths in a file differ from those that were to be written, m; ``nan`` where there are none."""
    lengths = [heading for heading in given if heading.endswith(f"[{unit}]")]
    away = [np.nanmax(abs(read[heading] - np.asarray(given[heading])), initial=0.0) for heading in lengths]
    return float(max(away, default=np.nan)) * LENGTHS[unit]
