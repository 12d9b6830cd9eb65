"""A cam as a DXF drawing that CAD and machine tools take: closed polylines of arcs, or splines, or chords.

Written by ezdxf as DXF of the year 2000, which every reader knows; read back by it, too.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...quantities.kinds import one_number, refuse_arguments, shown
from ...quantities.types import Array
from ...units import deg, um
from .arcs import ArcPath, arc_path, chord_path, dense_path, distances
from .blank import Blank
from .contours import contours
from .curves import Contour
from .dxf_read import paths_of
from .dxf_sheet import Sheet, drawing, without_codes
from .faults import marked
from .plan import plan
from .skeleton import skeleton
from .splines import Spline, splines
from .subject import DRAWN, Subject, analysis_of, frame, subjects
from .title import TitleBlock
from .written import Made, Written, length_unit, new_file, written

ENTITIES = "arcs", "spline", "chords"
CHECK = 23
"""Steps of the contours with which what was written is compared: other cam angles than those it was made of."""
WRAPPED = 90
"""Letters of a line of text."""


CUT = "CAM", "GROOVE"


def dxf(
    cam: object,
    tolerance: float = 1 * um,
    entity: str = "arcs",
    unit: str = "mm",
    blank: Blank = Blank(),
    title: TitleBlock = TitleBlock(),
) -> Made:
    """A cam as a DXF drawing, from a design, its analysis or a panel, the cam axis at the origin.

    What is cut lies on the layers ``CAM`` or ``GROOVE``, each contour one entity that is nowhere farther from the exact
    cam than the ``tolerance`` (m): with ``entity`` ``"arcs"`` a polyline of tangent arcs, ``"spline"`` a cubic spline
    (one for each part between two corners), ``"chords"`` a polyline of lines.  ``PITCH`` is the path of the roller's
    centre; ``BORE``, ``KEYWAY`` and ``HUB`` are those of the ``blank``; ``DATUM`` shows angle 0 and the direction of
    rotation; ``FAULT`` what undercut takes away, with a sentence; ``NOTES`` says what it is.  Both cams of a pair lie
    as they stand on their shaft, on ``CAM1`` and ``CAM2``.  A drum is unrolled at its mean radius.  Of a linkage or a
    shaft it is the `skeleton`.

    >>> from camkit import TranslatingFlatCam
    >>> print(dxf(TranslatingFlatCam()).what)
    56 arcs on CAM

    Raises ``ValueError`` for what has no profile, and for another entity, unit or tolerance.
    """
    if entity not in ENTITIES:
        raise ValueError(f"the entity is {shown(entity)}; it must be one of {', '.join(map(repr, ENTITIES))}")
    must = "be 0.01 um to 1 mm, in m"
    tolerance = one_number(tolerance, "the tolerance of the drawing", must, lambda x: 1e-8 <= x <= 1e-3)
    unit = length_unit(unit)
    if isinstance(analysis_of(cam), DRAWN):
        return skeleton(cam, unit=unit, title=title)
    cams = subjects(cam)
    exact = {layer: line for s in cams for layer, line in _by_layer(s, cams, CHECK).items()}
    given = [contour for s in cams for lines in _by_layer(s, cams).values() for contour in lines]
    drawn = [each for contour in given for each in _fitted(contour, tolerance, entity)]
    said = f"{entity} within {tolerance / um:.4g} um of the exact cam"
    faults = marked(title, cam).faults
    about = replace(title, faults=())

    def file(told: str) -> bytes:
        notes = [*about.lines(cams[0].kind, unit, told), frame(cams, unit)]
        return drawing(_sheet(cams, drawn, blank, faults, notes), unit)

    first = paths_of(file(said))
    off = deviation(first, exact)
    data = file(f"{said}; read back, at most {off / um:.3g} um off")
    again = paths_of(data)
    same = len(first) == len(again) and all(map(_same, first, again))
    found = off if same else deviation(again, exact)
    return Made(data, _what(drawn), found, (*faults, *_remarks(cams, given, unit)))


def write_dxf(
    cam: object,
    path: str | Path,
    tolerance: float = 1 * um,
    entity: str = "arcs",
    *,
    unit: str = "mm",
    blank: Blank = Blank(),
    title: TitleBlock = TitleBlock(),
) -> Written:
    """Write a cam, or the skeleton of a linkage or a shaft, as a DXF drawing (see `camkit.files.workshop.dxf.dxf`).

    >>> import tempfile
    >>> from camkit import TranslatingFlatCam
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(write_dxf(TranslatingFlatCam(), f"{folder}/cam.dxf"))
    cam.dxf: 56 arcs on CAM; read back, at most 0.99 um off
    """
    refuse_arguments(write_dxf, locals())
    path = new_file(path, "a DXF drawing", (".dxf",))
    return written(dxf(cam, tolerance, entity, unit, blank, title), path)


def deviation(drawn: Sequence[ArcPath], exact: dict[str, list[Contour]]) -> float:
    """The largest distance (m) between the lines of a drawing and the exact contours of the same layers, either way."""
    most = 0.0
    for layer, lines in exact.items():
        if layer.startswith("FAULT"):
            continue
        found = [path for path in drawn if path.layer == layer]
        there = np.hstack([stretch.finer(2).points for line in lines for stretch in line.stretches])
        here = np.hstack([path.points(4) for path in found]) if found else np.full((2, 1), np.inf)
        for paths, points in ((found, there), ([dense_path(line) for line in lines], here)):
            away = np.min([distances(path, points) for path in paths], axis=0) if paths else np.array([np.inf])
            most = max(most, float(away.max()))
    return most


def _same(one: ArcPath, other: ArcPath) -> bool:
    """Whether two paths have the same numbers."""
    return np.array_equal(one.corners, other.corners) and np.array_equal(one.bulges, other.bulges)


def _by_layer(subject: Subject, cams: Sequence[Subject], *steps: int) -> dict[str, list[Contour]]:
    """The contours of a cam by their layers, which of a pair are numbered."""
    number = f"{cams.index(subject) + 1}" if len(cams) > 1 else ""
    found: dict[str, list[Contour]] = {}
    for contour in contours(subject, *steps):
        layer = contour.layer + number
        found.setdefault(layer, []).append(Contour(layer, contour.stretches, contour.closed))
    return found


def _fitted(contour: Contour, tolerance: float, entity: str) -> Sequence[ArcPath | Spline]:
    if entity == "spline":
        return splines(contour, tolerance)
    return [(arc_path if entity == "arcs" else chord_path)(contour, tolerance)]


def _what(drawn: Sequence[ArcPath | Spline]) -> str:
    """How many lines of which kind are to be cut."""
    counts: dict[tuple[str, str], int] = {}
    for each in drawn:
        if each.layer.startswith(CUT):
            kind = "spline" if isinstance(each, Spline) else "arc" if each.bulges.any() else "chord"
            key = kind, each.layer
            counts[key] = counts.get(key, 0) + (1 if isinstance(each, Spline) else len(each.bulges))
    return ", ".join(f"{n} {kind}{'s' * (n > 1)} on {layer}" for (kind, layer), n in counts.items())


# ---------------------------------------------------------------- what is said


def _remarks(cams: Sequence[Subject], given: Sequence[Contour], unit: str) -> tuple[str, ...]:
    """What whoever uses it should know."""
    if cams[0].drum:
        return (frame(cams, unit),)
    open_ = any(not line.closed and line.layer.startswith(CUT) for line in given)
    span = float(np.ravel(cams[0].analysis.cam_angle)[-1]) / deg
    return (f"the motion covers {span:.4g} deg; where it ends the contour is open",) if open_ else ()


# ---------------------------------------------------------------- what is drawn


def _sheet(
    cams: Sequence[Subject],
    drawn: list[ArcPath | Spline],
    blank: Blank,
    faults: Iterable[str],
    notes: Iterable[str],
) -> Sheet:
    points = np.hstack([each.controls if isinstance(each, Spline) else each.points(4) for each in drawn])
    size = float(np.hypot(*points).max())
    height = size / 36
    below = float(points[1].min()) if cams[0].drum else -size
    left = float(points[0].min()) if cams[0].drum else -size
    about, texts = (_beside_drum if cams[0].drum else _around)(cams[0], points, blank, height)
    lines = [("FAULT", f"FAULTY: {line}") for line in faults] + [("NOTES", line) for line in notes]
    rows = [(layer, row) for layer, line in lines for row in textwrap.wrap(without_codes(line), WRAPPED)]
    at = below - 4 * height
    texts += [(layer, row, left, at - 1.7 * height * k) for k, (layer, row) in enumerate(rows)]
    return Sheet(drawn, about, texts, height)


Texts = list[tuple[str, str, float, float]]


def _around(subject: Subject, points: Array, blank: Blank, height: float) -> tuple[list[ArcPath], Texts]:
    """Centre lines, the blank, and the datum with its arrow."""
    size, sense = float(np.hypot(*points).max()), subject.sense
    far, arrow = size + 2 * height, size + 4 * height
    way = np.array([35.0, 55.0])[::sense] * deg
    tip = arrow * np.array([np.cos(way[1]), np.sin(way[1])])
    back = way[1] - sense * 0.06
    barbs = [(arrow + k * 0.4 * height) * np.array([np.cos(back), np.sin(back)]) for k in (-1, 1)]
    about = [
        _line("CENTRE", [(-far, 0), (far, 0)]),
        _line("CENTRE", [(0, -far), (0, far)]),
        *plan(blank),
        _line("DATUM", [(size + height, 0), (arrow, 0)]),
        ArcPath("DATUM", arrow * np.array([np.cos(way), np.sin(way)]), np.array([sense * np.tan(5 * deg)]), False),
        _line("DATUM", [barbs[0], tip, barbs[1]]),
    ]
    beyond = arrow + height
    return about, [("DATUM", "0 deg", beyond, -height / 2), ("DATUM", "turns", 0.75 * beyond, 0.75 * beyond)]


def _beside_drum(subject: Subject, points: Array, blank: Blank, height: float) -> tuple[list[ArcPath], Texts]:
    """The line of cam angle 0 and an arrow to where cam angles grow."""
    low, high = float(points[1].min()) - height, float(points[1].max()) + height
    sense = subject.sense
    tip, barb = np.array([8 * sense * height, high]), np.array([7 * sense * height, high])
    across = np.array([0.0, 0.4 * height])
    about = [_line("DATUM", [(0, low), (0, high)]), _line("DATUM", [(0, high), tip])]
    about.append(_line("DATUM", [barb + across, tip, barb - across]))
    return about, [("DATUM", "0 deg", 0.0, high + height), ("DATUM", "cam angle", float(tip[0]), high + height)]


def _line(layer: str, corners: Sequence[object]) -> ArcPath:
    points = np.array(corners, dtype=float).T
    return ArcPath(layer, points, np.zeros(points.shape[1] - 1), False)
