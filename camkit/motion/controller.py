"""Rows of a motion program for the controller of an electronic cam, and how near its curve between them comes.

Between two rows a controller follows the polynomial that has what both hold: positions alone (linear), velocities too
(cubic), accelerations (degree 5), jerks (degree 7).  There is a row wherever the motion changes its law.

Source: VDI 2143 part 1 (the quintic by ``s, v, a`` at both ends); Davis, Interpolation and Approximation (the error of
Hermite's polynomial of degree 2m - 1 is at most ``h^2m max|s^(2m)| / (4^m (2m)!)``: h^2 |a| / 8 for straight lines,
h^4 / 384 for cubics, h^6 / 46080 for degree 5).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial, perm
from typing import NamedTuple

import numpy as np

from ..quantities.kinds import a_number, refuse_arguments, shown
from ..quantities.types import Array
from ..units import deg
from .law import polynomial
from .program import MotionProgram
from .segments import Segment
from .transitions import _scales

WAYS = {"linear": 1, "cubic": 2, "poly5": 3, "poly7": 4}
"""How a controller goes on from row to row, and how many of ``s, v, a, j`` a row then holds."""
MOST_ROWS = 20_000
SAME_ANGLE = 1e-9
"""Rows of a grid nearer (rad) to another row than this are that row."""
JUMPS, NOISE = 1e-8, 1e-13
"""Shares of a value's size: a jump of more is one, a value of less is 0."""
HAIR = 1e-12
"""How far (share of a segment) the two sides of a kink are taken from it."""
INSIDE = np.linspace(0, 1, 33)[1:-1]
"""Where between two rows the controller's curve is compared, as shares."""


class ControllerRows(NamedTuple):
    """Rows in order; two of one cam angle where a derivative that they hold jumps."""

    angle: np.ndarray
    """Cam angles, ``(n,)``, rad."""
    values: np.ndarray
    """``s``, ``v``, ``a``, ``j`` of each, as many as the way needs, ``(m, n)``; m or rad, per rad^k."""


def controller_rows(program: MotionProgram, way: str = "poly5", step: float | None = 1 * deg) -> ControllerRows:
    """What a controller has to know of a program: rows where segments meet, laws have kinks or conditions inside.

    And at each multiple of ``step`` (rad); ``None``: those alone, of which ``poly5`` makes exactly what is of degree 5.
    ``way`` is ``linear``, ``cubic``, ``poly5`` or ``poly7``.

    >>> from camkit.motion import Dwell, Poly345, Rise
    >>> rows = controller_rows(MotionProgram((Rise(2.0, 0.02, Poly345()), Dwell(1.0))), "poly5", None)
    >>> rows.angle.tolist(), rows.values[0].tolist()
    ([0.0, 2.0, 3.0], [0.0, 0.02, 0.02])

    Raises ``ValueError`` in a sentence for a population, a ``step`` that is not above 0, more than 20 000 rows, and a
    motion that leaps to another level.
    """
    refuse_arguments(controller_rows, locals())
    held = _held(program, way)
    grid = _multiples(program, step)
    angle, before, after = _joined(_segments(program, grid))
    before, after = before[:held], after[:held]
    if not np.isfinite(before + after).all():
        raise ValueError(
            f"a derivative that rows of {way} hold is infinite somewhere; take a way that holds fewer, such as cubic"
        )
    scale = program_scales(program)[:held]
    jumps = abs(after - before) > JUMPS * scale
    if jumps[0].any():
        place = f"{angle[int(np.argmax(jumps[0]))] / deg:.6g} deg"
        raise ValueError(f"the motion leaps to another level at {place}; no controller can follow it")
    twice = jumps.any(0)
    at = np.repeat(np.arange(len(angle)), 1 + twice)
    first = np.append(at[1:] == at[:-1], False)
    values = np.where(first, before[:, at], after[:, at])
    return ControllerRows(angle[at], np.where(abs(values) < NOISE * scale, 0.0, values))


def program_scales(program: MotionProgram) -> Array:
    """A size for each of ``s, v, a, j`` of one program, ``(4, 1)``: lift / angle^k of the steepest segment."""
    return np.array([float(scale) for scale in _scales(program)])[:, None]


def controller_error(program: MotionProgram, way: str = "poly5", step: float | None = 1 * deg) -> float:
    """By how much the controller's curve through `controller_rows` strays from the program at most (m or rad).

    >>> from camkit.motion import Cycloidal, Rise
    >>> from camkit.units import mm
    >>> rise = MotionProgram((Rise(120 * deg, 20 * mm, Cycloidal()),))
    >>> [f"{controller_error(rise, way) / mm:.2e}" for way in ("linear", "cubic", "poly5")]
    ['1.09e-03', '6.23e-08', '1.43e-12']
    """
    angle, values = controller_rows(program, way, step)
    goes = np.diff(angle) > SAME_ANGLE
    steps = np.diff(angle)[goes]
    first, second = values[:, :-1][:, goes], values[:, 1:][:, goes]
    curve = polynomial(list(hermite(first, second, steps)[..., None]), INSIDE).s
    there = angle[:-1][goes][:, None] + steps[:, None] * INSIDE
    return float(abs(curve - program(there).s).max())


def hermite(first: Sequence[Array] | Array, second: Sequence[Array] | Array, step: Array) -> Array:
    """The polynomials in a share of each ``step`` that have ``s, v, ...`` as given at both ends.

    What stands before their powers, that of the lowest first: ``(2m, n)`` of ``m`` values for each of ``n`` steps.

    >>> hermite([np.array([0.0]), np.array([0.0])], [np.array([1.0]), np.array([0.0])], np.array([2.0])).T
    array([[ 0.,  0.,  3., -2.]])
    """
    m, scales = len(first), step ** np.arange(len(first)).reshape(-1, *[1] * np.ndim(step))
    low = np.asarray(first) * scales / np.array([factorial(k) for k in range(m)]).reshape(-1, *[1] * np.ndim(step))
    of_low = np.array([[perm(k, i) for k in range(m)] for i in range(m)], dtype=float)
    of_high = np.array([[perm(m + k, i) for k in range(m)] for i in range(m)], dtype=float)
    lacking = np.asarray(second) * scales - np.tensordot(of_low, low, 1)
    return np.concatenate([low, np.tensordot(np.linalg.inv(of_high), lacking, 1)])


def _held(program: MotionProgram, way: str) -> int:
    if way not in WAYS:
        raise ValueError(f"the way of the controller is {shown(way)}; it must be one of {', '.join(WAYS)}")
    refuse_many(program)
    return WAYS[way]


def refuse_many(program: MotionProgram) -> None:
    """``ValueError`` for a population of programs, which has no table."""
    if np.ndim(program.possible) or np.ndim(program.span):
        raise ValueError("the program is a population; a table is of one motion program")


def _multiples(program: MotionProgram, step: float | None) -> Array:
    """Multiples of a step inside the span, rad."""
    if step is None:
        return np.zeros(0)
    step = float(a_number(step, "the step of the table (rad)", "be above 0", lambda value: value > 0))
    if program.span / step > MOST_ROWS:
        raise ValueError(f"the table would have {program.span / step:.0f} rows; there can be at most {MOST_ROWS}")
    return step * np.arange(1, int(program.span / step) + 1)


def _segments(program: MotionProgram, grid: Array) -> list[tuple[Array, Array, Array]]:
    """Of each segment the cam angles of its rows, and what the motion is on both sides of each, ``(4, n)``."""
    found = []
    for i, segment in enumerate(program.segments):
        start, end = (float(edge) for edge in program.starts[i : i + 2])
        own = np.array(sorted({0.0, *segment_corners(segment), 1.0}))
        near = (grid > start + SAME_ANGLE) & (grid < end - SAME_ANGLE)
        inside = grid[near]
        far = abs(inside[:, None] - (start + own * (end - start))).min(-1) > SAME_ANGLE
        u = np.concatenate([own, (inside[far] - start) / (end - start)])
        order = np.argsort(u)
        angle = np.concatenate([start + own * (end - start), inside[far]])[order]
        found.append((angle, *_sides(segment, u[order], np.isin(u[order], own), program.levels[i])))
    return found


def segment_corners(segment: Segment) -> tuple[float, ...]:
    """Where inside a segment rows are needed, as shares: its kinks, and the knots of a table."""
    return tuple(float(u) for u in (*segment.kinks, *getattr(segment, "knots", ())) if 0 < u < 1)


def _sides(segment: Segment, u: Array, corner: Array, level: float) -> tuple[Array, Array]:
    """``s, v, a, j`` just before and just after each share; where they do not jump, exactly there."""
    at = _motion(segment, u, level)
    before, after = (_motion(segment, np.clip(u + side, 0, 1), level) for side in (-HAIR, HAIR))
    scale = abs(at).max(-1, keepdims=True)  # of this segment alone
    jumps = corner & (u > 0) & (u < 1) & (abs(after - before) > JUMPS * scale)
    return np.where(jumps, before, at), np.where(jumps, after, at)


def _motion(segment: Segment, u: Array, level: float) -> Array:
    s, v, a, j = np.broadcast_arrays(*segment.motion(u), u)[:4]
    return np.stack([level + s, v, a, j])


def _joined(parts: list[tuple[Array, Array, Array]]) -> tuple[Array, Array, Array]:
    """All segments in a row: where two meet the first says what is before, the second what is after."""
    angle, before, after = (np.concatenate(values, axis=-1) for values in zip(*parts, strict=True))
    begins = np.cumsum([0, *(len(part[0]) for part in parts[:-1])])
    after[:, begins[1:] - 1] = after[:, begins[1:]]
    kept = np.isin(np.arange(len(angle)), begins[1:], invert=True)
    return angle[kept], before[:, kept], after[:, kept]
