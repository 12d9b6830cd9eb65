"""A motion program as a table: for CAD and spreadsheets, and for the controller of an electronic cam."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..motion import MotionProgram
from ..motion.controller import MOST_ROWS, NOISE, controller_rows, program_scales, refuse_many
from ..quantities.kinds import a_number, refuse_arguments, shown, whole
from ..quantities.markup import csv_cell
from ..quantities.types import Array
from ..units import deg, factor, follower_unit, in_unit

DIGITS = 12
"""Fewer would spoil the acceleration between the rows: by up to 5.8 d / h^2, of a last digit d and rows h apart."""
LAST = 1e-9
"""A row nearer (rad) to the end of the motion than this is the end."""
FASTEST = 1e9
"""Speed of a shaft (rad/s) in a table of values in time."""


def motion_csv(
    program: MotionProgram,
    steps: int = 360,
    *,
    step: float | None = None,
    unit: str = "mm",
    decimal: str = ".",
    repeated: bool = True,
    speed: float | None = None,
) -> str:
    """A motion program as CSV text: a row for each cam angle with ``s, v, a, j``, units in the heading, 12 digits.

    ``steps`` divide the span evenly; or there is a row at each multiple of ``step`` (rad), such as ``1 * deg``, and at
    the end.  ``unit`` is the follower's.  A decimal comma goes with semicolons between the cells.  The last row of a
    turn repeats the first (of a motion that goes on, its advance further), unless ``repeated`` is false.  With a
    ``speed`` (rad/s) derivatives are by time, which has a column.

    >>> from camkit.motion import Cycloidal, Dwell, Return, Rise
    >>> from camkit.units import mm
    >>> law = Cycloidal()
    >>> up, back = Rise(120 * deg, 20 * mm, law), Return(120 * deg, 20 * mm, law)
    >>> text = motion_csv(MotionProgram((up, Dwell(60 * deg), back, Dwell(60 * deg))), 6)
    >>> print(*text.splitlines()[:3], sep="\\n")
    cam angle [deg],s [mm],v [mm/rad],a [mm/rad^2],j [mm/rad^3]
    0,0,0,0,85.9436692696
    60,10,19.098593171,0,-85.9436692696

    Raises ``ValueError`` in a sentence for a population, and for rows that are none or more than 20 000.
    """
    refuse_arguments(motion_csv, locals())
    refuse_many(program)
    follower_unit(unit)
    angle = _angles(program, steps, step)
    values = _values(program, angle)
    columns = {"cam angle [deg]": in_unit(angle, "deg")}
    per, times = "rad", 1.0
    if speed is not None:
        may = f"be above 0 and at most {FASTEST:g}"
        times = float(a_number(speed, "the speed (rad/s)", may, lambda value: (value > 0) & (value <= FASTEST)))
        per = "s"
        columns["time [s]"] = angle / times
    for k, (name, column) in enumerate(zip("svaj", values, strict=True)):
        columns[f"{name} [{derived_unit(unit, per, k)}]"] = in_unit(column * times**k, unit)
    last = None if repeated or not np.all(program.periodic) else -1
    return _text({name: column[:last] for name, column in columns.items()}, decimal)


def electronic_cam_csv(
    program: MotionProgram,
    way: str = "poly5",
    step: float | None = 1 * deg,
    *,
    unit: str = "mm",
    master: str = "deg",
    decimal: str = ".",
) -> str:
    """A motion program as the rows of a controller's cam table, CSV text with 12 digits.

    X is the master's angle in the unit ``master``, Y the follower's level; as much as the ``way`` needs of V, A and J,
    the derivatives of Y by X, follows: V for ``cubic``, V and A for ``poly5``, V, A and J for ``poly7``; none for
    ``linear``.  The last cell of a row names the way.  Rows stand where segments meet, where laws have kinks or
    conditions inside, and at each multiple of ``step`` (rad; ``None``: nowhere else).  Where a derivative that rows
    hold jumps there are two of one angle; a jerk that jumps needs none with ``poly5``.

    How near the controller comes says `camkit.motion.controller_error`.

    >>> from camkit.motion import Dwell, Poly345, Rise
    >>> from camkit.units import mm
    >>> index = MotionProgram((Rise(120 * deg, 20 * mm, Poly345()), Dwell(240 * deg)), advance=20 * mm)
    >>> print(electronic_cam_csv(index, step=None), end="")
    X [deg],Y [mm],V [mm/deg],A [mm/deg^2],way
    0,0,0,0,POLY5
    120,20,0,0,POLY5
    360,20,0,0,POLY5

    Raises ``ValueError`` in a sentence for a population, a way that no controller has, and a motion that leaps.
    """
    refuse_arguments(electronic_cam_csv, locals())
    follower_unit(unit)
    rows = controller_rows(program, way, step)
    columns: dict[str, Array] = {f"X [{master}]": in_unit(rows.angle, _an_angle(master))}
    for k, (name, column) in enumerate(zip("YVAJ", rows.values, strict=False)):
        columns[f"{name} [{derived_unit(unit, master, k)}]"] = in_unit(column * factor(master) ** k, unit)
    return _text(columns, decimal, {"way": way.upper()})


def _angles(program: MotionProgram, steps: int, step: float | None) -> Array:
    """Cam angles of the rows from 0 to the span, rad."""
    span = float(program.span)
    if step is None:
        return np.linspace(0, span, whole(steps, "the number of steps", 1, MOST_ROWS) + 1)
    step = float(a_number(step, "the step of the table (rad)", "be above 0", lambda value: value > 0))
    if span / step > MOST_ROWS:
        raise ValueError(f"the table would have {span / step:.0f} rows; there can be at most {MOST_ROWS}")
    multiples = step * np.arange(int(span / step) + 2)
    return np.append(multiples[multiples < span - LAST], span)


def _values(program: MotionProgram, angle: Array) -> Array:
    """``s, v, a, j``, ``(4, n)``, without the noise of rounding; the end of a turn moves as its start does."""
    values = np.stack(program(angle))
    if np.all(program.periodic):
        values[1:, -1] = values[1:, 0]
    return np.where(abs(values) < NOISE * program_scales(program), 0.0, values)


def _an_angle(master: str) -> str:
    if master not in ("deg", "rad"):
        raise ValueError(f"the unit of the master is {shown(master)}; it must be 'deg' or 'rad'")
    return master


def derived_unit(unit: str, of: str, k: int) -> str:
    """The unit of a ``k``-th derivative."""
    return unit + ("" if k == 0 else f"/{of}" if k == 1 else f"/{of}^{k}")


def _text(columns: Mapping[str, Array], decimal: str, behind: Mapping[str, str] | None = None) -> str:
    """Columns of numbers as CSV text, with the same words ``behind`` each row."""
    if decimal not in (".", ","):
        raise ValueError(f"the decimal sign is {shown(decimal)}; it must be a point or a comma")
    between, behind = ("," if decimal == "." else ";"), behind or {}
    heading = between.join(map(csv_cell, [*columns, *behind]))
    rows = zip(*columns.values(), strict=True)
    lines = (between.join([*(_cell(x, decimal) for x in row), *behind.values()]) for row in rows)
    return "".join(f"{line}\n" for line in (heading, *lines))


def _cell(value: float, decimal: str) -> str:
    return f"{value:z.{DIGITS}g}".replace(".", decimal)
