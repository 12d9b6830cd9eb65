"""Cam angles that show every stretch of a program, however narrow, and its joints and kinks from both sides."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import perm
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..geometry import end_to_end
from ..quantities.known import known
from ..quantities.types import Array, Value
from .closing import TURN
from .law import Kinematics, polynomial

if TYPE_CHECKING:
    from .program import MotionProgram
    from .segments import Segment

STEPS, LEAST, REST = 128, 16, 2
"""Even steps in a segment that moves, in the least of its smooth pieces, and in a dwell in which nothing happens."""
PER_WAVE = 12
"""Even steps for each wave that rides on the motion in a turn, of however much of it a segment is."""
ROUGH = 48
"""Even steps in a segment that moves where a search looks roughly."""
HAIR, ROUNDING = 1e-9, 4e-12
"""How far inside the ends of a piece its first and last angles lie: a share of it, and at least so many rad."""
HALVINGS = 44
"""Of a step, in which the level goes through a given one."""
TABLED = (
    "the load has a table, and which of its entries a segment of the motion passes differs from design to design; a "
    "constant load, a spring and its preload can be recorded"
)


class Resolution(NamedTuple):
    """Cam angles in the order of the program; within each of its smooth pieces they are even."""

    angle: np.ndarray
    """The cam angles, ``(n,)`` or ``(p, n)``, rad."""
    first: np.ndarray
    """Where each piece begins, ``(k,)``; its first and last angles lie a hair inside it, so that both sides speak."""
    last: np.ndarray
    """Where each piece ends, ``(k,)``."""
    moves: np.ndarray
    """Which angles belong to a segment that moves, ``(n,)``."""
    shares: tuple[tuple[int, Array], ...]
    """Of each piece the number of its segment, and its angles as shares of that."""

    @property
    def inner(self) -> np.ndarray:
        """Which angles have a neighbour of the same piece on both sides, ``(n,)``."""
        inside = np.ones(self.angle.shape[-1], dtype=bool)
        inside[self.first] = inside[self.last] = False
        return inside

    @property
    def weights(self) -> np.ndarray:
        """By which values at these angles add up to their integral over the angle: Simpson's rule in each piece."""
        steps = self.last - self.first
        step = (self.angle[..., self.last] - self.angle[..., self.first]) / np.maximum(steps, 1)
        rule = np.concatenate([_simpson(int(n)) for n in steps])
        return rule * step[..., np.repeat(np.arange(len(steps)), steps + 1)]

    def within(self, segments: Sequence[int]) -> np.ndarray:
        """Which angles belong to segments of those numbers, ``(n,)``."""
        return np.repeat([i in segments for i, _ in self.shares], self.last - self.first + 1)

    def of(self, segments: Sequence[int]) -> Resolution:
        """The angles of some segments alone."""
        return self._of_pieces(np.array([i in segments for i, _ in self.shares]))

    def _of_pieces(self, wanted: Array) -> Resolution:
        sizes = self.last - self.first + 1
        here, ends = np.repeat(wanted, sizes), np.cumsum(sizes[wanted])
        shares = tuple(piece for piece, kept in zip(self.shares, wanted, strict=True) if kept)
        return Resolution(self.angle[..., here], ends - sizes[wanted], ends - 1, self.moves[here], shares)

    def between(self, low: float, high: float, span: Value) -> Resolution:
        """As many angles of each piece between two cam angles (rad) alone; past the start if the first is larger.

        Where both are the same, that angle alone; ``nan`` beyond the ``span`` of the motion.
        """
        low, high = (x if 0 <= x <= TURN else x % TURN for x in (low, high))
        zones = [(low, high)] if low <= high else [(low, TURN), (0.0, high)]
        first, *others = [self._between(np.where(a <= span, a, np.nan), np.minimum(b, span)) for a, b in zones]
        return first._followed_by(others[0]) if others else first

    def _between(self, low: Array, high: Array) -> Resolution:
        """A piece that lies elsewhere is left out; where joints differ from design to design it shrinks to an end."""
        begins, ends = self.angle[..., self.first], self.angle[..., self.last]
        begin, end = (np.minimum(np.maximum(x, low), high) for x in (begins, ends))
        piece = np.repeat(np.arange(len(self.first)), self.last - self.first + 1)
        share = (self.angle - begins[..., piece]) / (ends - begins)[..., piece]
        shown = self._replace(angle=begin[..., piece] + share * (end - begin)[..., piece])
        inside = end > begin
        if not known(inside) or inside.ndim > 1 or np.isnan(begin).any():
            return shown
        return shown._of_pieces(inside if inside.any() else np.arange(len(inside)) == 0)

    def _followed_by(self, other: Resolution) -> Resolution:
        n = self.angle.shape[-1]
        first, last = (
            np.concatenate([mine, its + n]) for mine, its in ((self.first, other.first), (self.last, other.last))
        )
        moves = np.concatenate([self.moves, other.moves])
        return Resolution(end_to_end(self.angle, other.angle), first, last, moves, self.shares + other.shares)


def _simpson(steps: int) -> Array:
    """Simpson's rule for even steps of 1; of an odd number of them the last three by the three-eighths rule."""
    if steps < 2:
        return np.full(steps + 1, steps / 2)
    rule, even = np.zeros(steps + 1), steps if steps % 2 == 0 else steps - 3
    for k in range(3 if even else 0):
        rule[k : even + k - 1 : 2] += (1 / 3, 4 / 3, 1 / 3)[k]
    if even < steps:
        rule[even:] += np.array([3, 9, 9, 3]) / 8
    return rule


def resolve(
    program: MotionProgram,
    steps: int = STEPS,
    at_angles: Sequence[float] = (),
    at_levels: Sequence[float] = (),
    rest: int = REST,
) -> Resolution:
    """The same number of ``steps`` for every segment that moves, whatever its angle, and ``rest`` for a dwell.

    What else depends on the cam angle or on the level may have corners: at the cam angles ``at_angles`` (rad), and
    wherever the level goes through one of ``at_levels`` (m or rad).  Pieces end there, too.

    >>> from camkit.motion import Cycloidal, Dwell, MotionProgram, Rise
    >>> narrow = resolve(MotionProgram((Dwell(3.0), Rise(0.01, 1.0, Cycloidal()))))
    >>> narrow.angle.size, int((narrow.angle > 3).sum())
    (132, 129)
    >>> resolve(MotionProgram((Dwell(3.0),)), at_angles=[1.0]).angle[[0, 16, 17, 33]].round(6)
    array([0., 1., 1., 3.])
    """
    span: Any = program.span
    if (len(at_angles) or len(at_levels)) and not known(span):
        span.refuse(TABLED)
    steps, rest = max(steps, PER_WAVE * program.waves), max(rest, PER_WAVE * program.waves)
    shares, pieces, moves = [], [], []
    for i, segment in enumerate(program.segments):
        start, end = program.starts[i], program.starts[i + 1]
        passes = len(at_levels) and not segment.still
        passed = _passed(segment, np.asarray(at_levels) - program.levels[i]) if passes else []
        corners = [(angle - start) / (end - start) for angle in at_angles]
        for low, high, even in _pieces(
            segment, steps, rest, [x for x in (*corners, *passed) if np.any((x > 0) & (x < 1))]
        ):
            shares.append((i, low, high, even))
            pieces.append((start + low * (end - start), start + high * (end - start), even))
            moves.append(not segment.still)
    sizes = np.array([even + 1 for *_, even in pieces])
    angles = [np.atleast_1d(_inside(low, high, even)) for low, high, even in pieces]
    ends = np.cumsum(sizes)
    by_piece = tuple((i, _inside(low, high, even)) for i, low, high, even in shares)
    return Resolution(end_to_end(*angles), ends - sizes, ends - 1, np.repeat(moves, sizes), by_piece)


def _pieces(segment: Segment, steps: int, rest: int, corners: list[Value]) -> list[tuple[Value, Value, int]]:
    """The smooth pieces of a segment: from and to, as shares, and their steps.

    They end at ``corners`` too.  Where ends move with the design all pieces have as many steps, of one design as of a
    population: of one whose members have the same corners.
    """
    if segment.still and not corners:
        return [(0.0, 1.0, rest)]
    kinks = () if segment.still else segment.kinks
    pieces = list(pairwise((0.0, *(_in_order([*kinks, *corners]) if corners else kinks), 1.0)))
    if segment.still:
        return [(low, high, max(LEAST, rest)) for low, high in pieces]
    if corners or segment.kinks_move:
        shares = [1 / (1 + len(kinks) + len(corners))] * len(pieces)
    else:
        shares = [high - low for low, high in pieces]
    return [(*piece, max(LEAST, int(np.ceil(steps * x)))) for piece, x in zip(pieces, shares, strict=True)]


def _in_order(shares: list[Value]) -> list[Value]:
    """Ends of pieces in order; a population's ``(p, 1)`` that lie outside a member's segment stand at its end."""
    if not any(np.ndim(x) for x in shares):
        return sorted({float(x) for x in shares})
    columns = np.concatenate([np.atleast_1d(x) for x in np.broadcast_arrays(*shares)], axis=-1)
    columns = np.sort(np.clip(columns, 0.0, 1.0), axis=-1)
    return [columns[..., k : k + 1] for k in range(columns.shape[-1])]


def _passed(segment: Segment, changes: np.ndarray) -> list[Value]:
    """The shares of a segment at which it has changed the level by one of ``changes``.

    The first time and, if that is another one, the last; 1 where it never has.  A list of numbers, or of ``(p, 1)`` for
    a population.
    """
    u = np.linspace(0.0, 1.0, STEPS + 1)
    beyond = np.expand_dims(segment.motion(u).s, -2) > changes[..., None]
    crosses = beyond[..., 1:] != beyond[..., :-1]
    found = []
    for first in (np.argmax(crosses, -1), STEPS - 1 - np.argmax(crosses[..., ::-1], -1)):
        low, high = u[first], u[first + 1]
        side = np.take_along_axis(beyond, first[..., None], -1)[..., 0]
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            same = (segment.motion(middle).s > changes) == side
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found.append(np.where(crosses.any(-1), high, 1.0))
    both = found[0] if np.array_equal(found[0], found[1]) else np.concatenate(found, axis=-1)
    return [both[..., k] if both.ndim == 1 else both[..., k : k + 1] for k in range(both.shape[-1])]


def _inside(low: Value, high: Value, steps: int) -> Array:
    hair = np.minimum(np.maximum(HAIR * (high - low), ROUNDING), (high - low) / 4)
    return low + hair + (high - low - 2 * hair) * np.linspace(0, 1, steps + 1)


_LOW = np.array([1, 1, 1 / 2, 1 / 6])
_AT_END = np.array([[perm(i, k) for i in range(4)] for k in range(4)])
_HIGHER = np.array([[35, -15, 2.5, -1 / 6], [-84, 39, -7, 0.5], [70, -34, 6.5, -0.5], [-20, 10, -2, 1 / 6]])
"""Of a polynomial's coefficients: ``x^0 .. x^3`` from ``s, v, a, j`` at 0, what these give at 1, and ``x^4 .. x^7``
from what is lacking there."""


def between(first: Kinematics, second: Kinematics, step: Array) -> Any:
    """The polynomial of degree 7 in a share of a ``step`` that has ``s, v, a, j`` at both ends, of one smooth piece.

    Its factors, that of the lowest power first (see `along`).

    >>> from camkit.motion import Cycloidal
    >>> law = Cycloidal()
    >>> found = along(between(law(0.25), law(0.26), 0.01), 0.01, 0.3)
    >>> float(abs(found.a - law(0.253).a)) < 1e-9
    True
    """
    low_of, at_end, higher = (table.reshape(table.shape + (1,) * np.ndim(step)) for table in (_LOW, _AT_END, _HIGHER))
    powers = np.stack([np.ones(np.shape(step)), step, step**2, step**3])
    low, end = np.stack(first) * powers * low_of, np.stack(second) * powers
    return np.concatenate([low, ((end - (low * at_end).sum(1)) * higher).sum(1)])


def along(powers: Sequence[Value], step: Array, x: Value) -> Kinematics:
    """``s, v, a, j`` at a share ``x`` of a ``step`` of a polynomial in that share."""
    return Kinematics(*(value / step**k for k, value in enumerate(polynomial(powers, x))))
