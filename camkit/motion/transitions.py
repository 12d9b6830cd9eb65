"""What happens where two segments of a program meet: the fundamental law of cam design, in words.

Position, velocity and acceleration must be continuous and the jerk finite over the whole turn.

Source: Norton, Cam Design and Manufacturing Handbook (the fundamental law of cam design); VDI 2143 part 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..extrema import Extreme, highest_between
from ..quantities.types import Value
from ..units import factor, in_unit
from .law import Kinematics, derivative_size

if TYPE_CHECKING:
    from .program import MotionProgram

SMOOTH = 1e-6
"""A jump below this share of lift / angle^k of the program's steepest segment is rounding."""
HAIR = 1e-12
"""How far (share of a segment) the two sides of a kink inside a law are taken from it."""

NAMES = ("position", "velocity", "acceleration", "jerk")
PER = ("", "/rad", "/rad²", "/rad³")
MEANINGS = (
    "the follower would have to leap: impact, forbidden",
    "infinite acceleration: impact, forbidden",
    "infinite jerk: vibration, not for a fast cam",
    "acceptable",
)


@dataclass(frozen=True)
class Transition:
    """A joint of a program: its cam ``angle`` (rad) and the jumps of ``s, v, a, j`` there, after minus before.

    Jumps are in the follower's unit (m or rad) per rad^k.  ``order`` is that of the lowest derivative that
    jumps (0 position ... 3 jerk), ``None`` where all four are continuous.  A jump is ``inf`` where a law begins or ends
    with an infinite derivative, as a polynomial with an exponent between 2 and 3 does.
    """

    angle: float
    s: float
    v: float
    a: float
    j: float
    order: int | None

    @property
    def lawful(self) -> bool:
        """Whether the fundamental law holds: no jump of position, velocity or acceleration, and no infinite jerk."""
        return self.order is None or (self.order == 3 and bool(np.isfinite(self.j)))

    @property
    def verdict(self) -> str:
        """What jumps, by how much, and what that means for the machine."""
        return self.text()

    def text(self, unit: str = "", speed: float | None = None) -> str:
        """The `verdict` with the jump in the follower's ``unit``, a length or an angle; without one as it is, SI.

        At a ``speed`` of the shaft (rad/s) derivatives are those in time.

        >>> Transition(0.5235987756, 0, 0, 0, 0.1963, 3).text("mm")
        '30°: jerk step 196.3 mm/rad³, acceptable'
        >>> Transition(0.5235987756, 0, 0, 0, 0.1963, 3).text("m", speed=10.0)
        '30°: jerk step 196.3 m/s³, acceptable'
        """
        place = f"{in_unit(self.angle, 'deg'):.6g}°"
        if self.order is None:
            return f"{place}: smooth"
        size = (self.s, self.v, self.a, self.j)[self.order] / factor(unit)
        if not np.isfinite(size):
            return f"{place}: {MEANINGS[self.order - 1]}"
        per = PER[self.order]
        if speed is not None:
            size, per = size * speed**self.order, per.replace("rad", "s")
        told = f"{NAMES[self.order]} step {size:.4g} {unit or 'follower units'}{per}"
        return f"{place}: {told}, {MEANINGS[self.order]}"


class ProgramPeaks(NamedTuple):
    """The peaks of |v|, |a| and |j| of a program (m or rad, per rad^k); ``inf`` where a lower derivative jumps."""

    velocity: Extreme
    acceleration: Extreme
    jerk: Extreme


def find_transitions(program: MotionProgram) -> list[Transition]:
    """A record for each joint of one program; see ``MotionProgram.transitions``."""
    scales = _scales(program)
    return [_transition(angle, before, after, scales) for angle, before, after in _sides(program)]


def _transition(angle: Value, before: Kinematics, after: Kinematics, scales: list[Value]) -> Transition:
    s, v, a, j = (float(y - x) for x, y in zip(before, after, strict=True))
    broken = [not abs(jump) <= SMOOTH * scale for jump, scale in zip((s, v, a, j), scales, strict=True)]
    return Transition(float(angle), s, v, a, j, broken.index(True) if any(broken) else None)


def find_peaks(program: MotionProgram) -> ProgramPeaks:
    """The peaks of a program or of each in a population; see ``MotionProgram.peaks``."""
    with np.errstate(all="ignore"):
        return ProgramPeaks(*(_highest([*_inner(program, k), *_infinite(program, k)]) for k in (1, 2, 3)))


def _sides(program: MotionProgram) -> list[tuple[Value, Kinematics, Kinematics]]:
    """The cam angle of each joint with the motion just before and just after it, the turn's own joint last."""
    first = [_side(program, i, 0.0) for i in range(len(program.segments))]
    last = [_side(program, i, 1.0) for i in range(len(program.segments))]
    pairs = [(program.starts[i], last[i - 1], first[i]) for i in range(1, len(program.segments))]
    if np.all(program.periodic):
        s, v, a, j = first[0]
        pairs.append((program.span, last[-1], Kinematics(s + program.advance, v, a, j)))
    return pairs


def _kink_sides(program: MotionProgram) -> list[tuple[Value, Kinematics, Kinematics]]:
    """As ``_sides``, for the kinks inside the laws."""
    return [
        (program.starts[i] + u * segment.angle, _side(program, i, u - HAIR), _side(program, i, u + HAIR))
        for i, segment in enumerate(program.segments)
        for u in segment.kinks
    ]


def _side(program: MotionProgram, i: int, u: Value) -> Kinematics:
    """The motion of segment ``i`` at the share ``u`` of it, whatever follows."""
    s, v, a, j = program.segments[i].motion(np.asarray(u))
    return Kinematics(program.levels[i] + s, v, a, j)


def _scales(program: MotionProgram) -> list[Value]:
    """A size for each of ``s, v, a, j``: lift / angle^k of the steepest segment."""
    moves = [(segment.reach[1] - segment.reach[0], segment.angle) for segment in program.segments]
    return [np.max(np.stack(np.broadcast_arrays(*(h / beta**k for h, beta in moves))), axis=0) for k in range(4)]


def _inner(program: MotionProgram, k: int) -> list[tuple[Value, Value]]:
    """The peaks of derivative ``k`` within each segment, with their cam angles."""
    found: list[tuple[Value, Value]] = []
    for start, segment in zip(program.starts, program.segments, strict=False):
        top = highest_between(derivative_size(segment.motion, k), (0.0, *segment.kinks, 1.0))
        value, u = (x[..., None] for x in top)
        found.append((value, start + u * segment.angle))
    return found


def _infinite(program: MotionProgram, k: int) -> list[tuple[Value, Value]]:
    """``inf`` for each place where a derivative below ``k`` jumps or that of order ``k`` is infinite, 0 elsewhere."""
    scales = _scales(program)[:k]
    found: list[tuple[Value, Value]] = []
    for angle, before, after in [*_sides(program), *_kink_sides(program)]:
        jumps = [np.abs(y - x) > SMOOTH * scale for x, y, scale in zip(before, after, scales, strict=False)]
        endless = [np.isinf(side[k]) for side in (before, after)]
        found.append((np.where(np.logical_or.reduce(np.broadcast_arrays(*jumps, *endless)), np.inf, 0.0), angle))
    return found


def _highest(found: list[tuple[Value, Value]]) -> Extreme:
    """The largest of some ``(value, angle)``, row by row: numbers, or arrays of shape ``(p,)``."""
    rows = np.broadcast_shapes(*(np.shape(x)[:-1] for pair in found for x in pair))
    values, angles = ([np.broadcast_to(pair[side], (*rows, 1))[..., 0] for pair in found] for side in (0, 1))
    best = np.argmax(values, axis=0)[None]
    pick = [np.take_along_axis(np.stack(side), best, axis=0)[0] for side in (values, angles)]
    return Extreme(*(x if rows else float(x) for x in pick))
