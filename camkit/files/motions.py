"""The motion in a table that somebody saved: what its columns, units and rows mean."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..motion.table import LEAST_ROWS, MOST_ROWS, TableMotion, motion_from_points, motion_from_table
from ..quantities.applied import a_path
from ..quantities.kinds import refuse_arguments, shown
from ..quantities.types import Array
from ..units import deg, inch, mm, um
from .cells import Cells, TableQuestion, cells_of
from .json_file import LARGEST, MOST_BYTES

ANGLES = {"deg": 1.0, "rad": 1 / deg, "crank deg": 0.5}
"""What an angle of a table is worth in degrees of the cam."""
LIFTS = {"mm": mm, "cm": 10 * mm, "m": 1.0, "um": um, "in": inch, "thou": inch / 1000, "deg": deg, "rad": 1.0}
_IN_WORDS = {
    "crank deg": r"crank|kurbel|\bkw\b|°kw|vilebrequin",
    "thou": r"\bthou(sandths?)?\b|\bmils?\b|1/1000 ?(in|\")|0?\.001 ?(in|\")",
    "um": r"\b[uµμ]m\b|\bmicrons?\b",
    "mm": r"\bmm\b|millimet",
    "cm": r"\bcm\b|centimet",
    "in": r"\binch(es)?\b|\bzoll\b|\bin\b(?! [a-z])|\"",
    "m": r"[\[(] ?m ?[\])]|\bmet(er|re)s?\b| m$",
    "deg": r"\bdeg(rees?)?\b|°|\bgrad\b",
    "rad": r"\brad(ians?)?\b",
}
"""Units as headings name them; the first that is found counts."""
_ANGLE = r"angle|winkel|crank|kurbel|\bphi\b|\btheta\b|master|\bcam\b|rotation|\bdeg|°|\bgrad\b|\brad|^x\b"
_LIFT = r"lift|hub|stroke|displ|travel|follower|slave|weg|level|position|\bmm\b|\binch|thou|^[ys]\b"
_OTHER = r"veloc|geschw|accel|beschl|jerk|ruck|/ ?(deg|rad|s|°)|^[vaj]\b|\bno\b|\bnr\b|^#"


MOST_PAIRS, MOST_LETTERS = 40, 24
"""So many pairs of columns are offered at most, with so much of their headings; of words behind rows, too."""


class _Columns(NamedTuple):
    angle: int
    lift: int
    derivatives: tuple[int, ...] = ()
    """Of a controller's rows that hold ``v, a`` or ``v, a, j``."""


def read_motion(
    path: str | Path | bytes,
    *,
    delimiter: str | None = None,
    decimal: str | None = None,
    sheet: str | None = None,
    columns: Sequence[int] | None = None,
    angle_unit: str | None = None,
    lift_unit: str | None = None,
    rest: bool | None = None,
    tolerance: float | None = None,
    advance: float = 0.0,
) -> TableMotion:
    """The motion in a table: CSV or another text, or a workbook (XLSX), by its path or as the bytes of the file.

    Delimiter, decimal sign, heading, columns and units are found out; ``.remarks`` begin with what was understood.
    Where the table leaves open what is meant, the sentence of the ``ValueError`` names the argument that says it:
    ``delimiter`` (one of ``; , |``, tab and blank), ``decimal`` (point or comma), ``sheet``, ``columns`` (of angle
    and lift, counted from 1), ``angle_unit`` (``deg``, ``rad``, ``crank deg``), ``lift_unit`` (``mm``, ``in``, ``thou``
    and others).  Cam angles are those of the table, modulo a turn, where the motion goes around one (see
    `camkit.motion.motion_from_table`, also for ``rest`` and for ``tolerance`` and ``advance``, in m or rad).

    Rows that end in POLY5, POLY7 or, with a velocity, in CUBIC are a controller's: angle, lift and its derivatives by
    that angle, ``v`` or ``v, a`` or ``v, a, j``, of polynomials between them, which are taken exactly; so are those for
    which ``columns`` names these.  Of a turn that does not come back they say themselves by how much it goes on.

    The result is a motion program of any cam, with its ``remarks``, ``noise``, ``bad_rows`` and ``criterion``.

    >>> text = "angle [deg];lift [mm]\\n" + "\\n".join(f"{k};{5 - 5 * np.cos(k * deg):.4f}" for k in range(360))
    >>> motion = read_motion(text.replace(".", ",").encode())
    >>> print(f"{float(motion(90 * deg).s) / mm:.3f} mm")
    5.000 mm
    >>> motion.remarks[0][:75]
    'semicolons and decimal commas, angles in deg (of the cam), levels in mm, 36'

    Raises ``ValueError`` in a sentence for what holds no such table, and for rows that cannot be a motion; what asks is
    a `TableQuestion` with its ``argument`` and its ``options``.
    """
    refuse_arguments(read_motion, locals())
    _refuse_answers(delimiter, decimal, angle_unit, lift_unit)
    cells = cells_of(_bytes(path), delimiter, decimal, sheet)
    table, words = _numbers(cells, 2 if cells.behind[0] or columns else LEAST_ROWS), _words(cells)
    at = _columns(cells, words, columns, table)
    x, angle_said = _angles(table[:, at.angle], angle_unit, words[at.angle] or words[-1])
    unit, lift_said = _lift_unit(lift_unit, words[at.lift] or words[-1])
    shown_in = unit if unit in ("deg", "rad") else "mm"
    if at.derivatives:
        said = ", ".join([cells.how, angle_said, f"{lift_said}, derivatives by that angle"])
        per = deg * _worth(table[:, at.angle], x)
        given = [table[:, i] * LIFTS[unit] / per**k for k, i in enumerate((at.lift, *at.derivatives))]
        return motion_from_points(x * deg, given, shown_in, f"{said}, ")
    x, y, turned = _in_order(x, table[:, at.lift])
    digit = LIFTS[unit] * _digit([row[at.lift] for row in cells.rows])
    said = ", ".join(part for part in (cells.how, angle_said, lift_said, *turned, *_kinds(cells)) if part)
    return motion_from_table(
        x * deg,
        y * LIFTS[unit],
        shown_in,
        digit=digit,
        rest=rest,
        tolerance=tolerance,
        advance=advance,
        said=f"{said}, ",
    )


def _refuse_answers(delimiter: str | None, decimal: str | None, angle: str | None, lift: str | None) -> None:
    every = {
        "delimiter": (delimiter, [";", ",", "|", "\t", " "]),
        "decimal": (decimal, [".", ","]),
        "angle_unit": (angle, list(ANGLES)),
        "lift_unit": (lift, list(LIFTS)),
    }
    for name, (given, offered) in every.items():
        if given is not None and given not in offered:
            raise ValueError(f"{name} is {shown(given)}; it must be one of {', '.join(map(repr, offered))}")
    if delimiter == decimal == ",":
        raise ValueError("delimiter and decimal are both a comma; columns could not be told apart")


def _bytes(path: str | Path | bytes) -> bytes:
    if isinstance(path, bytes):
        return path
    with a_path(path).open("rb") as file:
        return file.read(MOST_BYTES + 1)


def _numbers(cells: Cells, least: int) -> Array:
    """The numbers of the rows, if there are enough of them, and none is absurd."""
    if not least <= len(cells.rows) <= MOST_ROWS:
        raise ValueError(f"the table has {len(cells.rows)} rows; it needs {LEAST_ROWS} to {MOST_ROWS} of them")
    table = np.array(cells.rows, dtype=float)
    if not (abs(table) < LARGEST).all():
        row = int(np.argmin((abs(table) < LARGEST).all(1)))
        raise ValueError(f"line {cells.lines[row]} of the table holds a number that no cam can have")
    return table


def _words(cells: Cells) -> list[str]:
    """What the heading says of each column, and, at last, what it says besides."""
    count = len(cells.rows[0])
    most = count if cells.how.startswith("blanks") else np.inf  # words are not columns
    above = [line for line in cells.heading if count <= len([cell for cell in line if cell]) <= most]
    named = [line for line in above[-2:-1] if any(re.search(f"{_ANGLE}|{_LIFT}", _tidy(cell)) for cell in line)]
    each = [" ".join(line[i] for line in (*named, *above[-1:])) for i in range(count)]
    return [_tidy(words) for words in (*each, " ".join(" ".join(line) for line in cells.heading))]


def _tidy(words: str) -> str:
    return re.sub(r"[_,:]+", " ", words.lower()).strip()


def _columns(cells: Cells, words: Sequence[str], given: Sequence[int] | None, table: Array) -> _Columns:
    """Where angle and lift stand."""
    count = len(cells.rows[0])
    if given is not None:
        right = len(given) in (2, 4, 5) and len(set(given)) == len(given)
        if not right or not all(isinstance(i, int) and 1 <= i <= count for i in given):
            raise ValueError(
                f"columns is {shown(given)}; it must be two numbers from 1 to {count}, of angle and lift, or four or "
                "five with v, a and j of a controller's polynomials"
            )
        return _Columns(given[0] - 1, given[1] - 1, tuple(i - 1 for i in given[2:]))
    if _by_polynomials(cells, words):
        return _Columns(0, 1, tuple(range(2, count)))
    plain = [i for i in range(count) if not re.search(_OTHER, words[i])]
    angles = [i for i in plain if re.search(_ANGLE, words[i])]
    lifts = [i for i in plain if re.search(_LIFT, words[i])]
    if count == 2:
        backwards = angles == [1] or (lifts == [0] and 1 not in lifts)
        return _Columns(1, 0) if backwards and 0 not in angles else _Columns(0, 1)
    lifts = [i for i in lifts if i not in angles[:1]]
    if len(angles) >= 1 and len(lifts) == 1:
        return _Columns(angles[0], lifts[0])
    why = f"the table has {count} columns ({cells.how}), and it is not clear which are angle and lift"
    raise TableQuestion(why, "columns=(1, 2)", "columns", _pairs(table, words))


def _pairs(table: Array, words: Sequence[str]) -> dict[str, tuple[int, int]]:
    """Which columns could be angle and lift: the angles go on from row to row, but for one step back."""
    ahead, moves = np.diff(table, axis=0) > 0, np.ptp(table, axis=0) > 0
    goes = moves & (np.minimum(ahead.sum(0), (~ahead).sum(0)) <= 1)
    ends = zip(words, table.min(0), table.max(0), strict=False)
    each = [
        f"{i} ({word[:MOST_LETTERS]}{', ' * bool(word)}{low:.6g} to {high:.6g})"
        for i, (word, low, high) in enumerate(ends, 1)
    ]
    far = abs(np.ptp(table, axis=0) - 360)
    pairs = [(i, k) for i in np.flatnonzero(goes).tolist() for k in np.flatnonzero(moves).tolist() if i != k]
    pairs.sort(key=lambda pair: (goes[pair[1]], far[pair[0]]))  # the likeliest first: a turn, and what goes up and down
    return {f"angle in column {each[i]}, lift in column {each[k]}": (i + 1, k + 1) for i, k in pairs[:MOST_PAIRS]}


def _by_polynomials(cells: Cells, words: Sequence[str]) -> bool:
    """Whether rows hold the derivatives of a controller's polynomials, and end in their name."""
    count = len(cells.rows[0])
    way = {3: "cubic", 4: r"poly\D*5", 5: r"poly\D*7"}.get(count, "$.")
    return any(re.match(way, word.lower()) for word in _ways(cells)) and (count > 3 or bool(re.match("v", words[2])))


def _unit(words: str, offered: Sequence[str]) -> str | None:
    """The unit that a heading names."""
    return next((unit for unit in _IN_WORDS if unit in offered and re.search(_IN_WORDS[unit], words)), None)


def _angles(x: Array, given: str | None, words: str) -> tuple[Array, str]:
    """Cam angles in degrees, and what was understood of them."""
    unit, span = given or _unit(words, list(ANGLES)), float(np.ptp(x))
    step = span / (len(x) - 1) if len(x) > 1 else span
    if unit is None and span < 7:
        if abs(span - 2 * np.pi) > 1.5 * step:
            why, say = f"the angles span {span:.6g} without a unit", "angle_unit='deg' or angle_unit='rad'"
            raise TableQuestion(why, say, "angle_unit", {"degrees": "deg", "radians": "rad"})
        unit = "rad"
    for power in (10, 100, 1000) if given is None and unit in (None, "deg") else ():
        if abs(span - 360 * power) <= 1.5 * step:
            return x / power, f"angles in {1 / power:g} deg (of the cam)"
    turned = x * ANGLES[unit or "deg"]
    if np.ptp(turned) > 360 * (1 + 1e-6):
        _refuse_span(float(np.ptp(turned)), unit)
    said = {"crank deg": "angles in deg of the crank (two turns for one of the cam)"}
    assumed = "" if unit else " as no unit is named"
    return turned, said.get(unit or "", f"angles in {unit or 'deg'} (of the cam){assumed}")


def _refuse_span(span: float, unit: str | None) -> None:
    """More than a turn: of a crank, perhaps, if nobody says that it is the cam's."""
    why, beyond = f"the angles span {span:.6g} deg, more than a turn of the cam", "take out what is beyond the turn"
    if unit in ("crank deg", "rad") or span > 720 * (1 + 1e-6):
        raise ValueError(f"{why}; {beyond}")
    say = f"angle_unit='crank deg' for a crank that turns twice as often, or {beyond}"
    raise TableQuestion(why, say, "angle_unit", {"degrees of a crank that turns twice as often": "crank deg"})


def _lift_unit(given: str | None, words: str) -> tuple[str, str]:
    """The unit of the levels, and what was understood of it."""
    unit = given or _unit(words, list(LIFTS))
    said = {"thou": "thousandths of an inch"}
    return unit or "mm", f"levels in {said.get(unit or '', unit or 'mm')}{'' if unit else ' as no unit is named'}"


def _in_order(x: Array, y: Array) -> tuple[Array, Array, list[str]]:
    """Rows from the least angle on: backwards where they fall, one turn back where they begin before the turn ends.

    So where they lie around its end, and none is on the other side of the turn.
    """
    steps = np.diff(x)
    if len(x) > 1 and (steps < 0).all():
        return x[::-1], y[::-1], ["rows backwards, so that row 1 is the last of the table"]
    back = np.flatnonzero(steps < -180)
    if (steps > 0).all() and steps.max() > 90 and x[0] + 360 - x[-1] < 3 * np.median(steps):
        k = int(np.argmax(steps)) + 1
        x, y = np.append(x[k:] - 360, x[:k]), np.append(y[k:], y[:k])
        once = np.append(True, np.diff(x) > 0)
        return x[once], y[once], [f"rows from {x[0] + 360:.6g} deg on around the end of the turn, counted from there"]
    if len(back) == 1:
        return x - 360 * (np.arange(len(x)) <= back[0]), y, ["rows from before the end of a turn on"]
    return x, y, []


def _digit(texts: Sequence[str]) -> float:
    """The last digit of the levels as they were written; 0 where these have as many as a computer has."""
    places = []
    for text in texts:
        mantissa, _, power = text.lower().partition("e")
        places.append(len(mantissa.partition(".")[2]) - int(power or 0))
    most = max(places)
    return 0.0 if most > 12 else 10.0**-most


def _ways(cells: Cells) -> set[str]:
    """What stands behind the numbers of the rows: how a controller goes on from each."""
    return {cell.upper() for behind in cells.behind for cell in behind if cell and not cell.startswith(("/", "#"))}


def _kinds(cells: Cells) -> list[str]:
    """What a controller's table says of the way between its rows."""
    kinds = sorted({way[:MOST_LETTERS] for way in _ways(cells)})
    told = ", ".join(kinds[:3]) + (" and others" if len(kinds) > 3 else "")
    return [f"points of a smooth curve for the controller's {told}"] if kinds else []


def _worth(given: Array, x: Array) -> float:
    """What one of the table's angles is worth in degrees of the cam."""
    return float(np.ptp(x) / np.ptp(given))
