"""The outline of a cam that somebody measured or drew: points in a table, or a DXF drawing."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..cam.from_outline import cam_from_outline
from ..cam.measured_outline import LEAST, MeasuredOutline
from ..cam.outline_contact import MEETS
from ..cam.outlines import TURN, CamOutline, DrawnOutline, signed_area
from ..quantities import Design
from ..quantities.kinds import kind_words, one_number, refuse_arguments, shown
from ..quantities.types import Array
from ..units import deg, in_unit, mm
from .cells import Cells, TableQuestion, cells_of
from .drawings import NAMES, Drawing, Loop, drawing_of, is_drawing
from .json_file import LARGEST, MOST_BYTES
from .motions import _angles, _bytes, _digit, _refuse_answers, _unit, _words

BENT, FINE = 1e-6, 20 * deg
"""Lines that meet at an angle between these are points on a curve, if there are many."""
MANY = 24
BACK = 0.2
"""An angle that goes on from row to row steps back less often, or nearly always."""
LINEAR = list(NAMES)
PROFILES = "profile", "outline", "cam"
"""Layers on which the outline is, if one of several loops is on such a one."""
X, Y, RADIUS, POLAR_ANGLE = r"\bx\b|x$", r"\by\b|y$", r"\br\b|radi|\brho\b", r"theta|angle|winkel|\bphi\b|polar"
"""What the headings of columns name, but for their units."""


def read_outline(
    path: str | Path | bytes,
    *,
    delimiter: str | None = None,
    decimal: str | None = None,
    sheet: str | None = None,
    columns: Sequence[int] | None = None,
    polar: bool | None = None,
    unit: str | None = None,
    angle_unit: str | None = None,
    axis: Sequence[float] | None = None,
    loop: int | None = None,
    tolerance: float | None = None,
) -> DrawnOutline | MeasuredOutline:
    """The outline of a cam in a file, by its path or as its bytes, for `camkit.motion_from_outline`.

    A table (CSV or another text, or XLSX) has points, ``x`` and ``y`` or radius and polar angle; its dialect, columns
    and units are found out.  A DXF drawing has lines, arcs, circles and polylines with bulges, which stay what they
    are, and splines and ellipses, of which points are taken, as of polylines that draw a curve by many short lines; its
    header says its unit.  The cam axis is the origin, or at ``axis``, in the unit of the file.  ``.remarks`` say what
    was understood.

    Where the file leaves open what is meant, the sentence of the ``ValueError`` names the argument that says it:
    ``delimiter``, ``decimal``, ``sheet`` (see `read_motion`), ``columns`` (of x and y, or of radius and angle, counted
    from 1), ``polar``, ``unit`` (``mm``, ``in`` and others), ``angle_unit``, ``loop`` (which of several around the
    axis).  ``tolerance`` (m) is that of `camkit.cam.MeasuredOutline`.

    >>> turn = np.arange(0, 360, 3) * deg
    >>> text = "x [mm];y [mm]\\n" + "\\n".join(f"{40 * np.cos(t):.4f};{40 * np.sin(t) - 15:.4f}" for t in turn)
    >>> read_outline(text.encode()).remarks[1]
    'semicolons and decimal points, x and y in mm'

    Raises ``ValueError`` in a sentence for what holds no outline around the cam axis.
    """
    refuse_arguments(read_outline, locals())
    _refuse_answers(delimiter, decimal, angle_unit, None)
    if unit is not None and unit not in NAMES:
        raise ValueError(f"unit is {shown(unit)}; it must be one of {', '.join(map(repr, NAMES))}")
    data, centre = _bytes(path), _axis(axis)
    if not is_drawing(data):
        cells = cells_of(data, delimiter, decimal, sheet, "an outline", "x and y, or radius and angle,")
        return _of_cells(cells, columns, polar, unit, angle_unit, centre, tolerance)
    if len(data) > MOST_BYTES:
        raise ValueError(f"the drawing has more than {MOST_BYTES // 10**6} million bytes; no outline of a cam has")
    return _of_drawing(drawing_of(data, unit), loop, centre, tolerance)


def takes_outline(design: Design) -> bool:
    """Whether the cam of a design can have any outline: a disk cam with one of the usual followers."""
    return type(design) in MEETS


def with_outline(design: Design, outline: CamOutline) -> Any:
    """The design with a cam of this outline (see `cam_from_outline`); ``ValueError`` for one that has no disk cam."""
    if not takes_outline(design):
        raise ValueError(
            f"it goes with a disk cam, and this is {kind_words(type(design), article=True)}; in a cell, "
            "motion_from_outline(read_outline(path), follower) is the motion of a follower on it"
        )
    return cam_from_outline(outline, design)


def is_outline(file: bytes) -> bool:
    """Whether a file is a drawing, or a table of an outline rather than of a motion.

    Its heading names coordinates of a profile, or radii by an angle; or no column goes on from row to row.
    """
    if is_drawing(file):
        return True
    try:
        cells = cells_of(file, None, None, None)
    except (ValueError, ModuleNotFoundError):
        return False
    words = _words(cells)
    if re.search("lift|hub|stroke|displ|travel|follower", " ".join(words)):
        return False
    of_a_profile = [*(word for word in words[:-1] if re.search("profile|outline", word)), ""]
    named = [_named(of_a_profile, X), _named(of_a_profile, Y)], [_named(words, RADIUS), _named(words, POLAR_ANGLE)]
    return any(None not in pair for pair in named) or _goes_to_and_fro(np.array(cells.rows, dtype=float))


def _goes_to_and_fro(table: Array) -> bool:
    """Whether a good part of the steps from row to row are back, in each column."""
    back = (np.diff(table, axis=0) < 0).mean(0) if len(table) >= LEAST else np.zeros(1)
    return bool(((back > BACK) & (back < 1 - BACK)).all())


def _axis(axis: Sequence[float] | None) -> Array:
    if axis is None:
        return np.zeros(2)
    if len(axis) != 2:
        raise ValueError(f"axis is {shown(axis)}; it must be x and y of the cam axis, in the unit of the file")
    must = "be a finite number"
    return np.array([one_number(x, "a coordinate of the axis", must, lambda x: abs(x) < LARGEST) for x in axis])


# ---------------------------------------------------------------- tables


def _of_cells(
    cells: Cells,
    columns: Sequence[int] | None,
    polar: bool | None,
    unit: str | None,
    angle_unit: str | None,
    axis: Array,
    tolerance: float | None,
) -> MeasuredOutline:
    table = np.array(cells.rows, dtype=float)
    if not (abs(table) < LARGEST).all():
        row = int(np.argmin((abs(table) < LARGEST).all(1)))
        raise ValueError(f"line {cells.lines[row]} of the table holds a number that no cam can have")
    words = _words(cells)
    one, other, round_ = _outline_columns(table, words, columns, polar, cells.how)
    named = unit or _unit(words[one] or words[-1], LINEAR)
    worth, digit = NAMES[named or "mm"], _digit([row[one] for row in cells.rows])
    assumed = "" if named else " as no unit is named"
    if round_:
        angle, told = _angles(table[:, other], angle_unit, words[other] or words[-1])
        told = re.sub(r" \(of the cam\)", "", told)
        x, y = (table[:, one] * f(angle * deg) for f in (np.cos, np.sin))
        said = f"{cells.how}, radii in {named or 'mm'}{assumed}, {told}"
    else:
        x, y = table[:, one], table[:, other]
        said = f"{cells.how}, x and y in {named or 'mm'}{assumed}"
    points = (np.array([x, y]) - axis[:, None]) * worth
    return MeasuredOutline(points.T, digit * worth, tolerance, (said,))


def _outline_columns(
    table: Array, words: Sequence[str], given: Sequence[int] | None, polar: bool | None, how: str
) -> tuple[int, int, bool]:
    """Where x and y stand, or radius and angle, and whether it is these."""
    count = table.shape[1]
    if given is not None:
        if len(given) != 2 or given[0] == given[1] or not all(isinstance(i, int) and 1 <= i <= count for i in given):
            raise ValueError(
                f"columns is {shown(given)}; it must be two numbers from 1 to {count}, of x and y or radius and angle"
            )
        one, other = given[0] - 1, given[1] - 1
        turns = _turns(table[:, other]) and bool((table[:, one] > 0).all())
        return one, other, turns if polar is None else polar
    across, up = (_named(words, axis) for axis in (X, Y))
    if across is not None and up is not None and not polar:
        return across, up, False
    radius, angle = _named(words, RADIUS), _named(words, POLAR_ANGLE)
    if radius is not None and angle is not None and polar is not False:
        return radius, angle, True
    return _unnamed(table, polar, how)


def _named(words: Sequence[str], pattern: str) -> int | None:
    """The one column whose heading says so; of several that of the profile."""
    found = [i for i, word in enumerate(words[:-1]) if re.search(pattern, _without_unit(word))]
    if len(found) > 1:
        found = [i for i in found if re.search("profile|outline", words[i]) and not re.search("outer|theory", words[i])]
    return found[0] if len(found) == 1 else None


def _without_unit(word: str) -> str:
    return re.sub(r"[\[(].*|\b(mm|in|um|deg|rad)\b", "", word).strip()


def _unnamed(table: Array, polar: bool | None, how: str) -> tuple[int, int, bool]:
    """Two columns, or three of which one counts the points or is the height at which they were measured."""
    count = table.shape[1]
    left = [i for i in range(count) if count == 2 or not (_counts(table[:, i]) or np.ptp(table[:, i]) == 0)]
    if len(left) != 2:
        raise TableQuestion(
            f"the table has {count} columns ({how}), and it is not clear which are x and y",
            "columns=(1, 2)",
            "columns",
            {f"columns {i + 1} and {i + 2}": (i + 1, i + 2) for i in range(count - 1)},
        )
    one, other = left
    for angle, radius in ((one, other), (other, one)):
        if _turns(table[:, angle]) and (table[:, radius] > 0).all() and polar is not False:
            return radius, angle, True
    if polar:
        raise ValueError("no column of the table goes once around as a polar angle does")
    return one, other, False


def _counts(x: Array) -> bool:
    return bool((np.diff(x) == 1).all())


def _turns(x: Array) -> bool:
    """Whether numbers go once around as polar angles do, in degrees or radians, begun anywhere."""
    steps = np.diff(x)
    for turn in (360.0, TURN):
        way = 1 if np.median(steps) > 0 else -1
        once = np.mod(way * steps, turn)
        span = float(once.sum())
        if (once < turn / 4).all() and abs(span - turn) <= 1.5 * float(once.max()) and np.ptp(x) > turn / 2:
            return True
    return False


# ---------------------------------------------------------------- drawings


def _of_drawing(
    drawing: Drawing, loop: int | None, axis: Array, tolerance: float | None
) -> DrawnOutline | MeasuredOutline:
    moved = [_moved(each, axis * drawing.worth) for each in drawing.loops]
    around = [each for each in moved if _goes_around(each)]
    profiles = [each for each in around if each.layer.lower() in PROFILES] or _inner_wall(around)
    if not around:
        raise ValueError(_no_loop(drawing, moved))
    chosen = _chosen(profiles if len(profiles) == 1 and loop is None else around, loop)
    said = [f"the loop on layer {shown(chosen.layer)} of a DXF drawing, {drawing.unit}"]
    if chosen.gap > 1e-6:
        said.append(f"a gap of {chosen.gap / mm:.3g} mm was closed")
    if drawing.left:
        said.append(f"not read: {', '.join(drawing.left)}")
    if chosen.exact and not _drawn_by_points(chosen) and tolerance is None:
        return DrawnOutline(chosen.corners.T.tolist(), tuple(chosen.bulges.tolist()), tuple(said))
    said.append("its curve taken by points on it")
    points = chosen.corners.T if not chosen.bulges.any() else _points(chosen)
    return MeasuredOutline(points, 0.0, tolerance, tuple(said))  # type: ignore[arg-type]


def _inner_wall(around: Sequence[Loop]) -> list[Loop]:
    """Of a groove's walls, on a layer of this name, the one on which a roller goes out."""
    walls = [each for each in around if each.layer.lower() == "groove"]
    return sorted(walls, key=lambda each: abs(signed_area(each.corners)))[:1]


def _points(loop: Loop) -> Array:
    return DrawnOutline(loop.corners.T.tolist(), tuple(loop.bulges.tolist())).points.T


def _moved(loop: Loop, axis: Array) -> Loop:
    return Loop(loop.corners - axis[:, None], loop.bulges, loop.layer, loop.exact, loop.gap)


def _goes_around(loop: Loop) -> bool:
    return not _refusal(loop)


def _refusal(loop: Loop) -> str:
    try:
        _points(loop)
    except ValueError as refusal:
        return str(refusal)
    return ""


def _chosen(around: Sequence[Loop], loop: int | None) -> Loop:
    if loop is not None:
        if isinstance(loop, bool) or not 1 <= loop <= len(around):
            raise ValueError(f"loop is {shown(loop)}; it must be a number from 1 to {len(around)}")
        return around[loop - 1]
    if len(around) > 1:
        options = {f"loop {k + 1} ({_told(each)})": k + 1 for k, each in enumerate(around)}
        raise TableQuestion(
            f"{len(around)} closed loops of the drawing go around the cam axis: {'; '.join(options)}",
            "loop=1",
            "loop",
            options,
        )
    return around[0]


def _told(loop: Loop) -> str:
    far = in_unit(np.hypot(*_points(loop).T), "mm")
    return f"layer {shown(loop.layer)}, {far.min():.4g} to {far.max():.4g} mm from the axis"


def _no_loop(drawing: Drawing, moved: Sequence[Loop]) -> str:
    if len(moved) == 1:
        return f"{_refusal(moved[0])}; say axis=(x, y), in the unit of the drawing, for a cam axis that is elsewhere"
    if moved:
        return (
            f"none of the {len(drawing.loops)} closed loops of the drawing goes around its origin, the cam axis; say "
            "axis=(x, y), where the axis is in the unit of the drawing"
        )
    if drawing.open:
        at, gap = min(drawing.open, key=lambda each: each[1])
        x, y = in_unit(at, "mm")
        return f"no outline of the drawing is closed: at x {x:.6g}, y {y:.6g} mm one is open by {gap / mm:.4g} mm"
    unread = f" (it has {', '.join(drawing.left)}, which are not read: blocks must be exploded)" if drawing.left else ""
    return f"the drawing has no lines, arcs, circles, polylines, splines or ellipses{unread}"


def _drawn_by_points(loop: Loop) -> bool:
    """Whether many short lines draw a curve."""
    ways = np.diff(loop.corners, append=loop.corners[:, :1])
    angle = np.arctan2(ways[1], ways[0])
    turns = abs((np.roll(angle, -1) - angle + np.pi) % TURN - np.pi)
    straight = (loop.bulges == 0) & (np.roll(loop.bulges, -1) == 0)
    return bool((straight & (turns > BENT) & (turns < FINE)).sum() >= MANY and abs(signed_area(loop.corners)) > 0)
