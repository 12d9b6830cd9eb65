"""The workshop drawing of a cam, to scale, as SVG and as PDF: a sheet for each cam, with its table of radii."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...quantities.kinds import one_number, refuse_arguments
from ...units import um
from .arcs import distances
from .blank import Blank
from .contours import STEPS, contours
from .deviations import Within, half_widths
from .dimensions import Words
from .faults import marked
from .inspection import largest_deviation
from .layout import Plan, Sheet, sheets_of
from .pdf import DRAWING, pdf_of, typst_for
from .subject import subjects
from .svg import document
from .svg_path import read_paths
from .title import TitleBlock
from .view import ROLES, scale_text
from .written import Made, Written, length_unit, new_file, refuse_ending, written

ENDINGS = (".svg", ".pdf")
FINER = 3
"""So many times more points than it is drawn from is a curve compared at."""


def write_drawing(
    cam: object,
    path: str | Path,
    *,
    blank: Blank = Blank(),
    tolerances: Within | None = None,
    profile_tolerance: float = 0.0,
    sheet: str = "A3",
    scale: float | None = None,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
) -> Written:
    """Write the drawing of a cam, of both cams of a pair, to scale: ``.svg``, or ``.pdf`` (extra ``report``).

    ``tolerances`` are half widths by path (SI), which stand behind the dimensions that they belong to.
    ``profile_tolerance`` is the width of the zone in which the profile must lie (m); 0: twice the tolerance of the base
    radius, if it has one.  A ``sheet`` "A3" has the table of radii beside the cam, "A4" on a second sheet.  The
    ``scale`` is the largest standard one for which there is room, or a number: 0.5 is 1:2.

    >>> from tempfile import TemporaryDirectory
    >>> from camkit import TranslatingFlatCam
    >>> with TemporaryDirectory() as folder:
    ...     print(write_drawing(TranslatingFlatCam(), f"{folder}/cam.svg").what)
    1 sheet A3, scale 1:1
    """
    refuse_arguments(write_drawing, locals())
    path = new_file(path, "a drawing", ENDINGS)
    made = drawing(
        cam,
        path.suffix.lower(),
        blank=blank,
        tolerances=tolerances,
        profile_tolerance=profile_tolerance,
        sheet=sheet,
        scale=scale,
        unit=unit,
        title=title,
    )
    return written(made, path)


def drawing(
    cam: object,
    ending: str,
    *,
    blank: Blank = Blank(),
    tolerances: Within | None = None,
    profile_tolerance: float = 0.0,
    sheet: str = "A3",
    scale: float | None = None,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
) -> Made:
    """The file of `write_drawing`, by its ending."""
    refuse_ending(ending, "a drawing", ENDINGS)
    if ending == ".pdf":
        typst_for(DRAWING)
    parts, title = subjects(cam), marked(title, cam)
    given = half_widths(parts[0].design, tolerances)
    said_as = Words(length_unit(unit), given)
    zone = _above_0(profile_tolerance, "the profile tolerance", least=0.0) or 2 * largest_deviation(parts, given)
    plan = Plan(parts, said_as, title, blank, sheet, None if scale is None else _above_0(scale, "the scale"), zone)
    sheets = sheets_of(plan)
    deviation = max(_read_back(sheet) for sheet in sheets if sheet.seen is not None)
    about = "\n".join(title.lines(parts[0].kind, said_as.unit))
    name = title.name(parts[0].kind)
    scales = ", ".join(dict.fromkeys(scale_text(s.view.scale) for s in sheets if s.view is not None))
    what = f"{len(sheets)} sheet{'s' * (len(sheets) > 1)} {sheet}, scale {scales}"
    if ending == ".svg":
        return Made(document([s.paper for s in sheets], name, about).encode(), what, deviation)
    data, remarks = pdf_of([document([s.paper], name, about) for s in sheets], plan.size)
    return Made(data, what, deviation, remarks)


def _above_0(value: object, what: str, least: float = 1e-6) -> float:
    return one_number(value, what, f"be finite and at least {least:g}", lambda x: least <= x < np.inf)


def _read_back(sheet: Sheet) -> float:
    """How far the curves on a sheet lie from the exact cam when they are read, m; the sheet says so then."""
    paper, seen, view, corner = sheet
    assert seen is not None
    assert view is not None
    drawn = read_paths(document([paper], ""), tuple(ROLES))
    exact = contours(seen.subject, FINER * STEPS)
    away = [distances(view.back(path), curve.points).max() for path, curve in zip(drawn, exact, strict=True)]
    worst = float(np.max(away))
    paper.text(corner, f"read back, its curves lie at most {worst / um:.2g} um from the exact cam", 2.5, "end")
    return worst
