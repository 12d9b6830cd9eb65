"""Motion from a table: rows that were measured or printed, smoothed, as the motion program of a follower.

Source: VDI 2143 part 1 (motions given by tables); `camkit.motion.smoothing` for the curve through the rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import comb

import numpy as np
from numpy.typing import ArrayLike

from ..quantities.kinds import a_number, listed, numbers, refuse_arguments, refuse_lengths
from ..quantities.types import Array, Value
from ..units import deg, factor, follower_unit, in_unit
from .closing import TURN
from .controller import hermite
from .families.free import piecewise
from .law import Kinematics
from .program import MotionProgram
from .segments import Dwell, Segment, _refuse_angle, _refuse_name
from .smoothing import BadRow, Rows, Smoothed

MOST_PIECES, MOST_ROWS = 2000, 20_000
"""Of a table in a program, and of what was read."""
LEAST_ROWS = 6
LOOKS = 24
"""A smooth table is looked at in no more pieces than about so many."""
GAP = 1.5
"""Rows whose ends are this many of their widest steps apart, or less, go around the turn."""
LEVEL = 2e-3
"""Ends that differ by less than so much of the range are level, and so do those that differ by what rounding does."""
AGREES = 1.1
"""Rows agree with a rest at their ends if cross-validation is at most this much worse, for about as free a curve."""
HOLE = 15.0
"""Rows that are more than so many usual steps, and degrees, apart leave a hole."""
SAME = 1e-6
"""Levels of exact rows that differ by less than so much of the range are the same."""
CORNER = 1e-6
"""A jump of the jerk below this share of the largest jerk is rounding."""


@dataclass(frozen=True)
class Table(Segment):
    """A segment that follows polynomials over ``angle`` (rad), one between each two of ``knots``, shares of it.

    ``powers`` has a row for each power of the distance (a share) from the knot before, what stands before it in each
    piece, m or rad.  What cannot be is refused by ``ValueError``.

    >>> up = Table(2.0, (0.0, 0.5, 1.0), ((0.0, 0.5), (0.0, 2.0), (2.0, -2.0)))
    >>> [float(x) for x in up.motion(np.array([0.5, 1.0])).s], float(up.change)
    ([0.5, 1.0], 1.0)
    """

    angle: Value
    knots: tuple[float, ...] = field(metadata={"most": MOST_PIECES + 1})
    powers: tuple[tuple[float, ...], ...] = field(repr=False)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _refuse_name(self)
        _refuse_angle(self)
        knots = numbers(listed(self.knots, "the knots of the table"), "the knots of the table")
        powers = numbers(listed(self.powers, "the powers of the table"), "the powers of the table")
        if knots.ndim != 1 or len(knots) < 2 or knots[0] != 0 or knots[-1] != 1 or not (np.diff(knots) > 0).all():
            raise ValueError("the knots of the table must increase strictly from 0 to 1")
        if powers.ndim != 2 or powers.shape[1] != len(knots) - 1 or not np.isfinite(powers).all():
            raise ValueError(
                f"the powers of the table have the shape {powers.shape}; they must be finite numbers in rows, each "
                f"with one for each of {len(knots) - 1} pieces"
            )
        object.__setattr__(self, "knots", tuple(knots.tolist()))
        object.__setattr__(self, "powers", tuple(map(tuple, powers.tolist())))
        refuse_lengths(self)

    @cached_property
    def _table(self) -> Array:
        powers = np.array(self.powers)
        powers[0] -= powers[0, 0]
        return powers

    def at(self, u: Array) -> Kinematics:
        """As `motion`, with derivatives with respect to ``u``."""
        return piecewise(self._table, self.knots[:-1], self.knots[1:-1], u)

    def motion(self, u: Array) -> Kinematics:
        return Kinematics(*(value / self.angle**k for k, value in enumerate(self.at(u))))

    @property
    def change(self) -> Value:
        return float(self.at(np.array(1.0)).s)

    @property
    def still(self) -> bool:
        return bool(self.reach == (0, 0))

    @cached_property
    def reach(self) -> tuple[Value, Value]:
        knots = np.array(self.knots)
        s = self.at((knots[:-1, None] + np.diff(knots)[:, None] * np.linspace(0, 1, 17)).ravel()).s
        return float(s.min()), float(s.max())

    @cached_property
    def kinks(self) -> tuple[Value, ...]:
        """Where the jerk jumps, and, for all of a long table to be looked at, some knots between."""
        knots, hair = np.array(self.knots), 1e-9
        inner = knots[1:-1]
        jump = abs(self.at(inner + hair * np.diff(knots)[1:]).j - self.at(inner - hair * np.diff(knots)[:-1]).j)
        some = np.arange(len(inner)) % max(1, len(inner) // LOOKS) == 0
        return tuple(inner[some | (jump > CORNER * abs(self.at(knots).j).max(initial=0.0))].tolist())

    @property
    def opposite(self) -> Table:
        """The same downwards."""
        return self.replace(powers=tuple(tuple(-x for x in row) for row in self.powers))


@dataclass(frozen=True)
class TableMotion(MotionProgram):
    """The motion of a follower as a table gives it, smoothed; a motion program in all else (see `read_motion`).

    ``remarks`` say in sentences what was understood; ``noise`` is by how much the rows scatter around the curve (rms,
    m or rad), ``bad_rows`` were left out, ``criterion`` says how much was smoothed away.  ``row_angles`` and
    ``row_levels`` (rad; m or rad) are all rows, bad ones too, at the cam angles of the program.
    """

    remarks: tuple[str, ...] = ()
    noise: float = 0.0
    bad_rows: tuple[tuple[int, float, float], ...] = ()
    criterion: str = ""
    row_angles: tuple[float, ...] = field(default=(), repr=False, compare=False, metadata={"most": MOST_ROWS})
    row_levels: tuple[float, ...] = field(default=(), repr=False, compare=False, metadata={"most": MOST_ROWS})
    unit: str = "mm"

    def __post_init__(self) -> None:
        object.__setattr__(self, "bad_rows", tuple(BadRow(*row) for row in self.bad_rows))
        super().__post_init__()

    def row_differences(self, k: int) -> tuple[Array, Array]:
        """Cam angles (rad) and the ``k``-th derivative there as the rows say it by themselves, unsmoothed.

        By divided differences of ``k + 1`` rows that follow one another, per rad^k, at the mean of their cam angles;
        around the end of the turn where the table goes around it.  Empty where there are no rows.
        """
        x, y = np.unwrap(np.array(self.row_angles)), np.array(self.row_levels)
        if self.periodic and len(self.segments) == 1:
            x, y = np.concatenate([x, x[:k] + TURN]), np.concatenate([y, y[:k] + self.advance])
        values = y
        for order in range(1, k + 1):
            values = order * np.diff(values) / (x[order:] - x[: len(x) - order])
        at = np.lib.stride_tricks.sliding_window_view(x, k + 1).mean(-1) if len(x) > k else x[:0]
        return (np.mod(at, TURN) if self.periodic else at), values


def motion_from_table(
    angle: ArrayLike,
    level: ArrayLike,
    unit: str = "mm",
    *,
    digit: float = 0.0,
    rest: bool | None = None,
    tolerance: float | None = None,
    advance: float = 0.0,
    said: str = "",
) -> TableMotion:
    """The motion through rows of cam ``angle`` (rad, increasing) and ``level`` (m or rad), smoothed.

    Rows around a turn give a motion that goes on smoothly from the last to the first; rows of a part of it that end
    as high as they begin are closed to a turn by a dwell, and keep their cam angles; other rows give a motion from cam
    angle 0 on.  Ends are as free as the rows are, or at ``rest`` (v = a = 0) on request; where nobody says, level ends
    rest as far as the rows agree with it: cross-validation is no worse for it.

    ``digit`` is what the levels are rounded to: less is not smoothed away.  ``tolerance`` takes the smoothest
    curve that passes every good row so closely, in place of cross-validation.  ``advance`` (m or rad) is by how much
    the follower is further after each turn, of rows of a turn that do not come back.  ``said`` begins the first remark,
    and ``unit`` is that of the follower in all of them.

    >>> lobe = motion_from_table(np.radians([-60, -40, -20, 0, 20, 40, 60]), [0, 3e-3, 8e-3, 1e-2, 8e-3, 3e-3, 0])
    >>> [segment.name or type(segment).__name__ for segment in lobe.segments], round(float(lobe(0.0).s), 4)
    (['Table', 'Dwell', 'Table'], 0.01)

    Raises ``ValueError`` for rows that are too few, not finite, not in order, of more than a turn, or always as high.
    """
    refuse_arguments(motion_from_table, locals() | {"angle": (), "level": ()})
    follower_unit(unit)
    digit = float(a_number(digit, "the digit", "be 0 or more", lambda value: value >= 0))
    (x, y), count, size = _refused(angle, level), np.size(angle), float(np.ptp(level))
    near = None if tolerance is None else float(a_number(tolerance, "the tolerance", "be above 0", lambda x: x > 0))
    advance = float(a_number(advance, "the advance of the table"))
    x, y, ends = _ends(x, y - advance * (x - x[0]) / TURN, max(LEVEL * size, 2 * digit))
    _refuse_gap(x, advance, ends)
    turned = np.mod(x, TURN) if ends == "turn" else x - x[0]
    order, span = np.argsort(turned, kind="stable"), TURN if ends == "turn" else float(x[-1] - x[0])
    rows = Rows(turned[order] / span, y[order] / size, min(max(digit / size, 1e-9), 1.0), ends, 0, near and near / size)
    found = _smoothed(rows, rest)
    off = zip(order[list(found.bad)], found.off, strict=True)
    knots, powers = _curve(found, size, advance, float(x[0]))
    segments, start = _segments(knots, powers, 0.0 if ends == "turn" else float(x[0]), span, ends != "free")
    motion = TableMotion(
        segments,
        start,
        noise=found.noise * size,
        bad_rows=tuple(sorted(BadRow(int(i) + 1, float(x[i]), far * size) for i, far in off)),
        criterion=_criterion(found, near, digit, unit),
        row_angles=tuple((turned if ends == "free" else np.mod(x, TURN)).tolist()),
        row_levels=tuple((y + advance * (turned - x[0]) / TURN).tolist()),
        unit=unit,
        advance=advance,
    )
    y = y + advance * (x - x[0]) / TURN
    return motion.replace(remarks=tuple(_remarks(motion, x, y, ends, said + f"{count} rows")))


def _curve(found: Smoothed, size: float, advance: float, first: float) -> tuple[Array, Array]:
    """Where the pieces of the curve begin and what stands before their powers; with it goes an ``advance`` in a turn.

    It is a straight line from the angle of the ``first`` row on, which changes nothing that is smoothed.
    """
    powers = found.powers * size
    knots = np.arange(powers.shape[1]) / powers.shape[1]
    powers[:2] += advance * np.stack([knots - first / TURN, np.ones(len(knots))])
    return knots, powers


def _smoothed(rows: Rows, rest: bool | None) -> Smoothed:
    """The curve through the rows, whose ends rest as far as was asked for, or as they agree."""
    if rows.ends == "turn" or rest is False or (rest is None and rows.ends == "free"):
        return rows.smoothed
    if rest:
        return replace(rows, rest=2).smoothed
    tried = [replace(rows, rest=k).smoothed for k in (2, 1, 0)]
    return next(each for each in tried if _agrees(each, tried[-1]))


def _refused(angle: ArrayLike, level: ArrayLike) -> tuple[Array, Array]:
    """The rows, if they can be a motion."""
    x, y = numbers(angle, "the cam angles of the table"), numbers(level, "the levels of the table")
    if x.ndim != 1 or x.shape != y.shape or len(x) < LEAST_ROWS:
        shapes = f"{x.size} cam angles and {y.size} levels"
        raise ValueError(f"the table has {shapes}; it needs as many of each, and {LEAST_ROWS} at least")
    if len(x) > MOST_ROWS:
        raise ValueError(f"the table has {len(x)} rows; there can be at most {MOST_ROWS}")
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        row = int(np.argmin(np.isfinite(x) & np.isfinite(y))) + 1
        raise ValueError(f"row {row} of the table holds a number that is not finite; every one must be")
    if not (np.diff(x) > 0).all():
        row = int(np.argmin(np.diff(x) > 0)) + 2
        raise ValueError(
            f"row {row} of the table has the cam angle {_deg(x[row - 1])} after {_deg(x[row - 2])}; the angles must "
            "increase, each must be there once"
        )
    if np.ptp(y) < 1e-12:
        raise ValueError("the level is the same in every row of the table; a motion must move")
    return x, y


def _ends(x: Array, y: Array, close: float) -> tuple[Array, Array, str]:
    """The rows without one that repeats the first, and how they end."""
    span, steps = x[-1] - x[0], np.diff(x)
    if span > TURN + 1e-6:
        raise ValueError(f"the table spans {_deg(span)}; a motion has at most one turn of the cam")
    if span >= TURN - 0.01 * steps.min():
        if abs(y[-1] - y[0]) > max(close, abs(y[1] - y[0])):
            raise ValueError(
                f"after a turn the table is {y[-1] - y[0]:.6g} from its start; it must come back to it, or say by its "
                "advance how far it goes on with each turn"
            )
        return x[:-1], y[:-1], "turn"
    step_over = 3 * abs(np.diff(y)).max() + close
    if TURN - span <= GAP * steps.max() and abs(y[-1] - y[0]) <= step_over:
        return x, y, "turn"
    return x, y, "level" if abs(y[-1] - y[0]) <= close else "free"


def _refuse_gap(x: Array, advance: float, ends: str) -> None:
    """Where rows are missing nobody knows what the follower does, nor where a part of a turn goes on."""
    if advance and ends != "turn":
        raise ValueError(f"the table spans {_deg(x[-1] - x[0])}; only rows of a whole turn can go on by an advance")
    steps = np.diff(x)
    if steps.max() > max(HOLE * float(np.median(steps)), HOLE * deg):
        row = int(np.argmax(steps)) + 1
        raise ValueError(
            f"between rows {row} and {row + 1} of the table ({_deg(x[row - 1])} and {_deg(x[row])}) rows are missing; "
            "add some, also where the follower rests"
        )


def _agrees(some: Smoothed, free: Smoothed) -> bool:
    """Whether ends at rest make a curve no worse than free ends do, nor more crooked."""
    return some.validated <= AGREES * free.validated and some.free <= AGREES * free.free + 2


def _segments(
    knots: Array, powers: Array, first: float, span: float, closed: bool
) -> tuple[tuple[Segment, ...], float]:
    """The segments of the motion from cam angle 0 on, and where it begins; ``first`` is the angle of the first row."""
    if not closed:
        return (_part(knots, powers, 0.0, 1.0, span),), float(powers[0, 0])
    begins = float(np.mod(first + 1e-12, TURN)) - 1e-12
    ahead, rest = begins + span - TURN, (Dwell(TURN - span),) if TURN - span > 1e-9 else ()
    if ahead > 1e-9:  # it goes on over the end of the turn
        cut = 1 - ahead / span
        later, start = _part(knots, powers, 0.0, cut, span - ahead), float(_shifted(knots, powers, cut)[0])
        return (_part(knots, powers, cut, 1.0, ahead), *rest, later), start
    before = (Dwell(begins),) if begins > 1e-9 else ()
    after = (Dwell(-ahead),) if ahead < -1e-9 else ()
    return (*before, _part(knots, powers, 0.0, 1.0, span), *after), float(powers[0, 0])


def _shifted(knots: Array, powers: Array, u: float) -> Array:
    """The powers of the distance from a share ``u`` of the span."""
    place, orders = int(np.searchsorted(knots, u, side="right")) - 1, range(len(powers))
    far = u - knots[place]
    return np.array([sum(comb(j, k) * powers[j, place] * far ** (j - k) for j in orders[k:]) for k in orders])


def _part(knots: Array, powers: Array, low: float, high: float, angle: float) -> Table:
    """The table between two shares of the span, over ``angle``; ``knots`` are where its pieces begin."""
    inside = (knots > low + 1e-9) & (knots < high - 1e-9)
    scale = (high - low) ** np.arange(len(powers))[:, None]
    pieces = np.column_stack([_shifted(knots, powers, low), powers[:, inside]]) * scale
    pieces[0] -= pieces[0, 0]
    shares = (0.0, *((knots[inside] - low) / (high - low)).tolist(), 1.0)
    return Table(angle, shares, tuple(map(tuple, pieces.tolist())))


def motion_from_points(angle: Array, given: Sequence[Array], unit: str, said: str) -> TableMotion:
    """The motion of a controller through rows of cam ``angle`` (rad) and of ``s, v, a``, and ``j`` where there is one.

    Between two rows it is the polynomial of degree 5, or 7, that has what both say; where a derivative jumps there are
    two rows of one angle.  Rows of a turn, and those that begin and end at one level, are closed to a turn.
    """
    s, *_ = given
    step, size = np.diff(angle), float(np.ptp(s))
    if not (step >= 0).all() or not (step > 0).any() or size == 0:
        raise ValueError("the angles of the table must not fall from row to row, and its level must move")
    goes, span = step > 1e-9, float(angle[-1] - angle[0])
    if (leap := abs(np.diff(s)[~goes]) > SAME * size).any():
        raise ValueError(f"row {np.flatnonzero(~goes)[np.argmax(leap)] + 2} leaps to another level at the same angle")
    closed = abs(s[-1] - s[0]) <= SAME * size
    if span > TURN + 1e-6:
        raise ValueError(f"the table spans {_deg(span)}; it must span a turn at most")
    advance = 0.0 if closed or span < TURN - 1e-6 else float(s[-1] - s[0])
    first, second = ([row[:-1][goes] for row in given], [row[1:][goes] for row in given])
    second[0] = np.where(np.arange(goes.sum()) == goes.sum() - 1, s[0] if closed else s[-1], second[0])
    pieces = hermite(first, second, step[goes])
    knots, powers = (
        (angle[:-1][goes] - angle[0]) / span,
        pieces * (span / step[goes]) ** np.arange(len(pieces))[:, None],
    )
    span = TURN if abs(span - TURN) < 1e-6 else span
    segments, start = _segments(knots, powers, float(angle[0]), span, closed)
    criterion = f"polynomials of degree {len(pieces) - 1} between the rows, as the controller runs them"
    begins = "" if closed or angle[0] == 0 else f"; cam angle 0 is the first row, at {_deg(angle[0])}"
    on = f"; it goes on by {in_unit(advance, unit):.6g} {unit} with each turn" if advance else ""
    remarks = (f"{said}{len(angle)} rows: {criterion}{begins}{on}",)
    return TableMotion(segments, start, remarks, criterion=criterion, unit=unit, advance=advance)


def _deg(angle: float) -> str:
    return f"{in_unit(float(angle), 'deg'):.6g} deg"


def _criterion(found: Smoothed, tolerance: float | None, digit: float, unit: str) -> str:
    if tolerance is not None:
        return f"the smoothest curve within {in_unit(tolerance, unit):.4g} {unit} of every good row"
    if found.by == "rounding":
        return (
            f"the smoothest curve that leaves what rounding to {in_unit(digit, unit):.4g} {unit} does (1/sqrt 12 of it)"
        )
    return "least generalised cross-validation"


def _remarks(motion: TableMotion, x: Array, y: Array, ends: str, said: str) -> list[str]:
    unit, (low, high) = motion.unit, (in_unit(float(level), motion.unit) for level in (y.min(), y.max()))
    kind = {
        "turn": "a whole turn, which goes on smoothly over its end"
        + (f", {in_unit(motion.advance, unit):.6g} {unit} further with each" if motion.advance else ""),
        "level": f"its ends are level, so a dwell of {_deg(TURN - (x[-1] - x[0]))} closes the turn",
        "free": f"a motion over {_deg(x[-1] - x[0])} with ends as the rows have them"
        + ("" if abs(x[0]) < 1e-9 else f"; cam angle 0 is the first row, at {_deg(x[0])}"),
    }[ends]
    told = [f"{said} from {_deg(x[0])} on, {low:.6g} to {high:.6g} {unit}: {kind}"]
    told.append(f"smoothed by {motion.criterion}; the rows scatter by {motion.noise / factor(unit):.3g} {unit} (rms)")
    told += [
        f"row {row} at {_deg(angle)} is {off / factor(unit):.3g} {unit} off the curve through the others: left out"
        for row, angle, off in motion.bad_rows
    ]
    if ends == "level":
        jumps = [joint for joint in motion.transitions() if not joint.lawful]
        told[0] += "" if jumps else ", and the rows agree with a rest at both"
        told += [f"at {joint.text(unit)}; rest=True lets the table begin and end at rest" for joint in jumps]
    return told
