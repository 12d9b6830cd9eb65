"""A motion as the cam table of an electronic cam, as the controllers of four makers take it.

Each is text that is imported or pasted where the maker's manual says:

- ``codesys``: rows of the cam editor's table, X, Y, V, A and the segment type; CODESYS SoftMotion, *Tab: Cam Table*
  (content.helpme-codesys.com, SMC_CAM_TYPE.XYVA): between two rows Poly5 has what both hold.
- ``twincat``: rows of MC_MotionFunctionPoint, from PointIndex to SlaveAcc; Beckhoff TF5050 NC Camming
  (infosys.beckhoff.com): function type 15, MOTIONFUNCTYPE_POLYNOM5_MM, is the polynomial of degree 5 from motion to
  motion; point type 8 is MOTIONPOINTTYPE_MOTION; RelIndexNextPoint is 1.
- ``kollmorgen``: a cam profile for *Import Cam Profile* of the KAS IDE (webhelp.kollmorgen.com): X;Y;SPLINE between
  TABLE_BEGIN and TABLE_END.  On import X and Y are divided by their largest values, which become the scales.
- ``rockwell``: the CAM array of MCCP, MASTER, SLAVE, SegmentType (Rockwell MOTION-RM002, chapter 10): type 1 is cubic;
  MCCP puts a cubic spline through the points, with the start and end slopes that are its operands.

Master positions are in deg, slave positions in mm, inches or deg; V and A are by the master's deg.  The first two hold
speed and acceleration and are followed exactly where a law is of degree 5; the others hold positions alone.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ...motion import MotionProgram
from ...motion.controller import controller_rows, hermite
from ...quantities.kinds import shown
from ...quantities.types import Array
from ...units import deg, factor, in_unit
from .written import Made

FEWEST = 5
"""Rows: KAS takes no profile of fewer than four splines."""
APART = 1e-6
"""Two rows of one angle, where the acceleration jumps, are written so far (deg) apart: masters must grow."""
EVERY = 7
"""Between two rows the curve is compared at so many places."""
Curve = Callable[[Array], Array]
"""What a controller makes of a table: the slave's position by the master's."""


def controller_table(program: MotionProgram, form: str, unit: str, step: float = 1 * deg) -> Made:
    """The cam table of a program in one of `FORMS`, its slave in ``unit``, with a row at least every ``step`` (rad).

    ``deviation`` is that of the curve which the controller makes of the numbers in the file, m or rad.

    >>> from camkit.motion import Cycloidal, Dwell, Return, Rise
    >>> from camkit.units import mm
    >>> up, down = (move(120 * deg, 20 * mm, Cycloidal()) for move in (Rise, Return))
    >>> made = controller_table(MotionProgram((up, Dwell(60 * deg), down, Dwell(60 * deg))), "codesys", "mm", 5 * deg)
    >>> made.data.decode().splitlines()[0], made.deviation < 1e-9
    ('X,Y,V,A,Segment type', True)
    """
    if form not in FORMS:
        raise ValueError(f"the controller is {shown(form)}; there are tables for {', '.join(FORMS)}")
    form_of = FORMS[form]
    rows = controller_rows(program, form_of.way, step)
    if len(rows.angle) < FEWEST:
        raise ValueError(f"a cam table with {len(rows.angle)} rows is too short; take a smaller step")
    master = in_unit(rows.angle, "deg")
    master = np.where(np.diff(master, prepend=-1.0) > 0, master, master + APART)
    values = np.stack([in_unit(column * deg**k, unit) for k, column in enumerate(rows.values)])
    slopes = in_unit(controller_rows(program, "cubic", None).values[1][[0, -1]] * deg, unit)
    cyclic = bool(np.all(program.periodic) and np.all(program.comes_back))
    grows = np.diff(master.astype(form_of.number), prepend=-1) > 0
    data = form_of.write(master[grows], values[:, grows], cyclic).encode()
    place = (rows.angle[:-1] + np.diff(rows.angle) * np.linspace(0, 1, EVERY)[:, None]).ravel()
    away = form_of.read(data, slopes)(in_unit(place, "deg")) * factor(unit) - program(place).s
    remarks = (form_of.remark.format(*slopes),) if form_of.remark else ()
    return Made(data, f"{grows.sum()} rows for {form}, master in deg, slave in {unit}", float(abs(away).max()), remarks)


def _csv(rows: Iterable[Iterable[object]], delimiter: str = ",") -> str:
    out = io.StringIO()
    csv.writer(out, delimiter=delimiter, lineterminator="\r\n").writerows(rows)
    return out.getvalue()


def _said(value: float, digits: int = 15) -> str:
    return f"{value:z.{digits}g}"


def _numbers(data: bytes, start: int, columns: slice, delimiter: str = ",", end: int | None = None) -> Array:
    """Columns of the rows of a file from number ``start`` on, ``(k, n)``."""
    rows = [*csv.reader(io.StringIO(data.decode(), newline=""), delimiter=delimiter)][start:end]
    return np.array([[float(x) for x in row[columns]] for row in rows]).T


def _codesys(master: Array, values: Array, cyclic: bool) -> str:
    table = ([*map(_said, row), "Poly5"] for row in np.vstack([master, values]).T)
    return _csv([["X", "Y", "V", "A", "Segment type"], *table])


def _twincat(master: Array, values: Array, cyclic: bool) -> str:
    heading = ["PointIndex", "FunctionType", "PointType", "RelIndexNextPoint"]
    heading += ["MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc"]
    table = ([k, 15, 8, 1, *map(_said, row)] for k, row in enumerate(np.vstack([master, values]).T, 1))
    return _csv([heading, *table])


def _kollmorgen(master: Array, values: Array, cyclic: bool) -> str:
    table = ([_said(x), _said(y), "SPLINE"] for x, y in zip(master, values[0], strict=True))
    head = [["CYCLIC", "YES" if cyclic else "NO", ""], ["TABLE_BEGIN", "", ""]]
    return _csv([*head, *table, ["TABLE_END", "", ""]], ";")


def _rockwell(master: Array, values: Array, cyclic: bool) -> str:
    table = ([_said(x, 9), _said(y, 9), 1] for x, y in zip(master, values[0], strict=True))
    return _csv([["MASTER", "SLAVE", "SegmentType"], *table])


def _poly5(data: bytes, columns: slice) -> Curve:
    """Between two rows the polynomial of degree 5 with position, speed and acceleration of both."""
    from scipy.interpolate import PPoly

    master, *values = _numbers(data, 1, columns)
    steps = np.diff(master)
    coefficients = hermite([v[:-1] for v in values], [v[1:] for v in values], steps)
    return PPoly((coefficients / steps ** np.arange(len(coefficients))[:, None])[::-1], master)


def _follow_codesys(data: bytes, slopes: Array) -> Curve:
    return _poly5(data, slice(0, 4))


def _follow_twincat(data: bytes, slopes: Array) -> Curve:
    return _poly5(data, slice(4, 8))


def _follow_kollmorgen(data: bytes, slopes: Array) -> Curve:
    """The cubic spline through the points; that of a cyclic one goes on as it began."""
    from scipy.interpolate import CubicSpline

    master, slave = _numbers(data, 2, slice(0, 2), ";", -1)
    if data.startswith(b"CYCLIC;YES"):
        slave[-1] = slave[0]  # but for rounding
        return CubicSpline(master, slave, bc_type="periodic")
    return CubicSpline(master, slave)


def _follow_rockwell(data: bytes, slopes: Array) -> Curve:
    """The cubic spline through the points, numbers of 32 bits, with the slopes at both ends."""
    from scipy.interpolate import CubicSpline

    master, slave = _numbers(data, 1, slice(0, 2)).astype(np.float32).astype(float)
    return CubicSpline(master, slave, bc_type=((1, slopes[0]), (1, slopes[1])))


class Form(NamedTuple):
    """How a maker's table is written, what its controller makes of it, and what rows hold (see `controller_rows`)."""

    write: Callable[[Array, Array, bool], str]
    """From master positions (deg), slave positions with their derivatives, and whether it is cyclic."""
    read: Callable[[bytes, Array], Curve]
    """From the file and the slopes at both ends."""
    way: str
    remark: str = ""
    number: type = float
    """Its master positions: of 32 bits some rows are at the same."""


FORMS = {
    "codesys": Form(_codesys, _follow_codesys, "poly5"),
    "twincat": Form(_twincat, _follow_twincat, "poly5"),
    "kollmorgen": Form(_kollmorgen, _follow_kollmorgen, "linear"),
    "rockwell": Form(
        _rockwell, _follow_rockwell, "linear", "MCCP needs start slope {:.7g} and end slope {:.7g}", np.float32
    ),
}
"""The controllers by name."""
