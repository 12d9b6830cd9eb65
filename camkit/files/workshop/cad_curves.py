"""Points for *curve through points* of CAD programs: no headings, no columns but x, y, z.

- ``solidworks``: *Curve Through XYZ Points*: x, y, z with their unit, a point a line (as SolidWorks saves them in
  .sldcrv: codestack.net, *edit curve file*; help.solidworks.com, InsertCurveFile).
- ``inventor``: *Import Points* of a sketch: the first sheet of a workbook from cell A1 on, which holds the unit of all,
  then x, y, z a row (help.autodesk.com, *To import points from an Excel spreadsheet*); as csv the same rows.
- ``creo``: *Curve from File* (.ibl): a section and a curve for every smooth part, each beginning at the point where the
  one before ends (PTC, *Importing a datum curve*; two points are a line, more a spline).
- ``nx``: *Spline, Points from File* (.dat): x y z a line, ``#`` begins a comment of at most 132 letters (Siemens NX,
  *Points From File*).

A closed curve ends with its first point.  How near such a spline comes to the cam is found with the cubic through the
points of the file, with a parameter that grows with their distances; programs differ a little from it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...quantities.kinds import shown
from ...quantities.markup import plain
from ...quantities.types import Array
from ...units import in_unit, um
from .distance import from_curve
from .sheets import read_workbook, workbook
from .written import LENGTHS, Made

CAD = {"solidworks": ("sldcrv", "txt"), "inventor": ("xlsx", "csv"), "creo": ("ibl",), "nx": ("dat", "txt")}
"""The programs, and how their files may end."""
THIN = 32, 16, 8, 4, 2, 1
"""Every so many points is one enough, if the spline through them is near enough."""
NEAR = 1 * um
"""The spline stays within this of the cam, if there are points enough."""
DIGITS = 9
"""Behind the decimal point."""
KNOWS_UNIT = "solidworks", "inventor"
"""Programs that read the unit in the file."""
UNITS = {"mm": "mm", "in": "inches"}
LONGEST = 130
"""Letters of a comment."""


def cad_curve(pieces: Sequence[Array], program: str, unit: str, lines: Sequence[str] = (), ending: str = "") -> Made:
    """The points of a curve for one of `CAD`, thinned as far as a spline through them stays within 1 um.

    ``pieces`` are its smooth parts, exact points ``(2, n)`` or ``(3, n)`` (m), each beginning where the one before
    ends.  ``lines`` say where it comes from, for those that read comments.

    >>> from camkit.units import mm
    >>> turn = np.linspace(0, 2 * np.pi, 721)
    >>> made = cad_curve([20 * mm * np.array([np.cos(turn), np.sin(turn)])], "solidworks", "mm")
    >>> made.data.decode().splitlines()[0], made.deviation < 1 * um
    ('20mm 0mm 0mm', True)

    Raises ``ValueError`` for a program that there is none of, and for corners where it takes one spline alone.
    """
    ending = _ending(program, ending)
    if len(pieces) > 1 and program != "creo":
        raise ValueError(
            f"the curve has corners between {len(pieces)} smooth parts; {program} puts one spline through all points, "
            "which would round them: take creo, or a DXF"
        )
    exact = [np.vstack([piece, np.zeros((3 - len(piece), piece.shape[1]))]) for piece in pieces]
    for thin in THIN:
        data = _written([in_unit(piece[:, _kept(piece, thin)], unit) for piece in exact], program, unit, lines, ending)
        read = [piece * LENGTHS[unit] for piece in read_cad_curve(data, program)]
        away = max(float(_away(one, other).max()) for one, other in zip(read, exact, strict=True))
        if away <= NEAR:
            break
    points = sum(piece.shape[1] for piece in read)
    said = f"{points} points for {program}" + (f" in {len(read)} splines" if len(read) > 1 else "")
    return Made(data, said, away, () if program in KNOWS_UNIT else (f"the part must be in {UNITS[unit]}",))


def read_cad_curve(data: bytes, program: str) -> list[Array]:
    """The curves in such a file, points ``(3, n)`` in its unit."""
    if program == "inventor" and data.startswith(b"PK"):
        return [np.array([row[:3] for row in read_workbook(data)[1:]], dtype=float).T]
    lines = data.decode().splitlines()
    if program == "inventor":
        return [np.array([line.split(",") for line in lines[1:]], dtype=float).T]
    if program == "creo":
        parts = "\n".join(lines[1:]).lower().split("begin curve")[1:]
        return [_points([line for line in part.splitlines()[1:] if "begin" not in line]) for part in parts]
    return [_points([line.partition("#")[0] for line in lines])]


def _points(lines: Sequence[str]) -> Array:
    rows = [[float(x.removesuffix("mm").removesuffix("in")) for x in line.split()] for line in lines if line.split()]
    return np.array(rows).T


def _ending(program: str, ending: str) -> str:
    if program not in CAD:
        raise ValueError(f"the program is {shown(program)}; there are points for {', '.join(CAD)}")
    if ending and ending not in CAD[program]:
        can = " or ".join(CAD[program])
        raise ValueError(f"a file of points for {program} ends in {shown(ending)}; it can end in {can}")
    return ending or CAD[program][0]


def _kept(piece: Array, thin: int) -> Array:
    """Every so manieth point and the last."""
    numbers = np.arange(piece.shape[1])
    return (numbers % thin == 0) | (numbers == len(numbers) - 1)


def _away(read: Array, exact: Array) -> Array:
    """How far exact points lie from the spline through those of a file."""
    from scipy.interpolate import CubicSpline

    lengths = np.sqrt((np.diff(read) ** 2).sum(0))
    closed = bool((read[:, 0] == read[:, -1]).all())
    where = np.append(0, np.cumsum(lengths))
    spline = CubicSpline(where, read.T, bc_type="periodic" if closed else "not-a-knot")
    place = np.arange(len(where))

    def curve(at: Array) -> tuple[Array, Array]:
        length = np.interp(at, place, where)
        return spline(length).T, spline(length, 1).T * lengths[np.minimum(at.astype(int), len(lengths) - 1)]

    return from_curve(curve, len(lengths), exact)


def _written(pieces: Sequence[Array], program: str, unit: str, lines: Sequence[str], ending: str) -> bytes:
    said = [[[f"{x:z.{DIGITS}f}" for x in point] for point in piece.T] for piece in pieces]
    if program == "solidworks":
        text = "\n".join(" ".join(f"{x.rstrip('0').rstrip('.')}{unit}" for x in point) for point in said[0])
    elif program == "nx":
        comments = [f"# {plain(line)}"[:LONGEST] for line in lines]
        text = "\n".join([*comments, *(" ".join(point) for point in said[0])])
    elif program == "creo":
        kind = "Closed" if said[0][0] == said[-1][-1] else "Open"
        heads = ([f"Begin section ! {k}", f"Begin curve ! {k}"] for k in range(1, len(said) + 1))
        sections = ([*head, *(" ".join(point) for point in piece)] for head, piece in zip(heads, said, strict=True))
        text = "\n".join([f"{kind} Index Arclength", *(line for section in sections for line in section)])
    elif ending == "xlsx":
        return workbook([[unit], *pieces[0].T.round(DIGITS).tolist()], headed=False)
    else:
        text = "\n".join([unit, *(",".join(point) for point in said[0])])
    return f"{text}\n".encode()
