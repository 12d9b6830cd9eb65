"""A motion program: rises, returns and dwells in a row, against cam angle.

>>> from camkit.motion import Cycloidal, Dwell, Return, Rise
>>> from camkit.units import deg, mm
>>> rise, back = Rise(120 * deg, 20 * mm, Cycloidal()), Return(180 * deg, 20 * mm, Cycloidal())
>>> program = MotionProgram((rise, Dwell(60 * deg), back))
>>> program([60 * deg, 150 * deg, 360 * deg]).s.round(6)
array([0.01, 0.02, 0.  ])
>>> round(program.peaks().velocity.value, 6)
0.019099
>>> program.transitions()[0].verdict
'120°: jerk step -0.08594 follower units/rad³, acceptable'
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, is_dataclass, replace
from functools import cached_property, reduce
from itertools import accumulate
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from ..geometry import end_to_end
from ..quantities import Declared, Quantity, certain, floats, known, unless
from ..quantities.kinds import a_number, finite, listed, numbers, whole
from ..quantities.types import Array, Value
from .closing import TURN, closed, closing
from .law import Kinematics
from .refused import NEARLY, ROUNDED, refuse_program
from .resolution import Resolution, resolve
from .segments import Segment, degrees, kind_of, positive
from .transitions import ProgramPeaks, Transition, find_peaks, find_transitions

SAME_ANGLE = 1e-9
"""Cam angles closer than this (rad) are the same."""
SAME_JOINT = 1e-12
"""An angle this little (rad) before a joint is the joint: what rounding does to ``120 * deg``."""
SAME_LEVEL = 1e-9
"""Levels closer than this, relative to the lifts, are the same."""


START = Quantity("s_0", 0, -10, 10, "", "the follower's level where the motion begins", above=None)


@dataclass(frozen=True)
class MotionProgram(Declared):
    """Segments that follow one another from cam angle 0, the level beginning at ``start``.

    Called with cam angles (rad) it gives ``s, v, a, j``: the level in the follower's unit (m or rad) and
    its derivatives per rad, rad^2, rad^3.  A program that spans 360 deg repeats with every turn and must
    come back to its first level; a shorter one is ``nan`` outside [0, span].  What the rounding of its angles
    leaves open (1e-4 deg) is closed; a program that misses the turn by more, but by less than 0.5 deg, is refused.
    Cam sizes and springs are counted from the level 0, wherever the program begins.

    A motion that goes on, as that of an indexing table or a rotary knife does, says by how much it is further after
    each turn: its ``advance`` (m or rad), below 0 for one that goes backwards.

    >>> from camkit import Dwell, ModifiedSine, Rise, deg
    >>> index = MotionProgram((Rise(120 * deg, 60 * deg, ModifiedSine()), Dwell(240 * deg)), advance=60 * deg)
    >>> (index([-60 * deg, 60 * deg, 420 * deg, 1000 * deg]).s / deg).round(9)
    array([  0.,  30.,  90., 180.])

    Paths call the segments by their own names, or ``rise``, ``dwell``, ``return``, ``dwell2`` by kind and count.  A
    program that spans 360 deg stays closed when its segments are given other values by path: the last dwell (the last
    segment, where there is none) takes up the angle and the last move the lift, so these two are no quantities.  The
    ``advance`` stays.

    >>> from camkit import Cycloidal, Return
    >>> from camkit.quantities import quantities_of, with_quantities
    >>> rise, back = Rise(120 * deg, 0.02, Cycloidal()), Return(120 * deg, 0.02, Cycloidal())
    >>> turn = MotionProgram((rise, Dwell(60 * deg), back, Dwell(60 * deg, name="rest")))
    >>> list(quantities_of(turn))
    ['rise.angle', 'rise.lift', 'dwell.angle', 'return.angle', 'start']
    >>> other = with_quantities(turn, {"rise.angle": 130 * deg, "rise.lift": 0.03})
    >>> print(f"{other.segments[3].angle / deg:.4f} deg, {other.segments[2].lift} m")
    50.0000 deg, 0.03 m

    >>> MotionProgram((Dwell(240 * deg), Dwell(119.99 * deg)))
    Traceback (most recent call last):
        ...
    ValueError: the program spans 359.99 deg; 0.01 deg are missing to a full turn: lengthen a segment or add a dwell

    A population holds arrays of shape ``(p, 1)`` in its segments, its laws, its ``start`` or its ``advance``; cam
    angles of shape ``(n,)`` or ``(p, n)`` then give ``(p, n)``.  One program that cannot be is refused by
    ``ValueError``; in a population its row is ``nan``.
    """

    segments: tuple[Segment, ...]
    start: Value = field(default=0.0, metadata={"declared": START, "by_owner": True})
    advance: Value = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments", listed(self.segments, "what the program is made of", "segment"))
        for name in ("start", "advance"):
            object.__setattr__(self, name, a_number(getattr(self, name), f"the {name} of the program"))
        refuse_program(self)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What paths call the segments."""
        kinds = [kind_of(segment) for segment in self.segments]
        counts = [kinds[: i + 1].count(kind) for i, kind in enumerate(kinds)]
        by_kind = [kind if count == 1 else f"{kind}{count}" for kind, count in zip(kinds, counts, strict=True)]
        return tuple(segment.name or name for segment, name in zip(self.segments, by_kind, strict=True))

    def branches(self) -> dict[str, Segment]:
        """The segments by name."""
        return {n: segment for n, segment in zip(self.names, self.segments, strict=True) if is_dataclass(segment)}

    @property
    def _turns(self) -> bool:
        """Whether the program, or each member of a population that can be, spans a turn."""
        return bool(np.all(self.periodic | np.isnan(self._beyond)))

    def following(self) -> dict[str, str]:
        """The angle and the lift that close a turn."""
        if not self._turns:
            return {}
        angle, lift = closing(self.segments)
        found = {f"{self.names[angle]}.angle": "it takes up what the other segments leave of the turn"}
        if lift is not None:
            found[f"{self.names[lift]}.lift"] = f"it takes the follower {self._where_to}"
        return found

    @property
    def comes_back(self) -> bool | Array:
        """Whether the follower is after a turn where it was before: its ``advance`` is 0."""
        return self.advance == 0

    @property
    def _where_to(self) -> str:
        """Where the follower is after a turn, in words."""
        return "back to where the turn began" if certain(self.comes_back) else "on by the advance of a turn"

    def suited(self) -> bool:
        """Whether neither the level nor the velocity jumps at a joint, as with a half law that meets a dwell."""
        return all(joint.order in (None, 2, 3) for joint in self.transitions())

    def changed(self, changes: Mapping[str, Any]) -> MotionProgram:
        """With other segments by name; a turn is closed again."""
        segments = [changes.get(name, segment) for name, segment in zip(self.names, self.segments, strict=True)]
        segments = closed(segments, self.segments, self.advance) if self._turns else segments
        return self.replace(segments=tuple(segments), start=changes.get("start", self.start))

    def with_edge(self, number: int, angle: float) -> Self:
        """With the transition of that number at another cam angle (rad); what one neighbour gains the other gives.

        Transition 1 is the end of the first segment; the ends of the program stay.  A segment whose angle follows from
        its other numbers is moved along.  ``ValueError`` where a neighbour has not so much to give.

        >>> from camkit.motion import Cycloidal, Dwell, Return, Rise
        >>> rise, back = Rise(2.0, 0.02, Cycloidal()), Return(2.0, 0.02, Cycloidal())
        >>> [segment.angle for segment in MotionProgram((rise, Dwell(1.0), back)).with_edge(2, 3.5).segments]
        [2.0, 1.5, 1.5]
        """
        number = whole(number, "the number of the transition", 1, max(1, len(self.segments) - 1))
        to = a_number(angle, f"the cam angle of transition {number}")
        before, after = (self._giving(range(*ends)) for ends in ((number - 1, -1, -1), (number, len(self.segments))))
        by, angles = to - self.starts[number], [segment.angle for segment in self.segments]
        if refuse := unless((by > -angles[before]) & (by < angles[after])):
            low, high = (self.starts[number] + by for by in (-angles[before], angles[after]))
            refuse(
                f"transition {number} is to be at {degrees(to)}; it can lie between {degrees(low)} and "
                f"{degrees(high)}, where {self.names[before]} and {self.names[after]} have some angle left"
            )
        return self._with_angles({before: angles[before] + by, after: angles[after] - by})

    def _giving(self, numbers: range) -> int:
        """Which of some segments, in that order, is the first whose angle can be another."""
        return numbers[0]

    def _with_angles(self, angles: Mapping[int, Value]) -> Self:
        """With other angles of some segments."""
        segments = enumerate(self.segments)
        return self.replace(segments=tuple(replace(s, angle=angles[i]) if i in angles else s for i, s in segments))

    @cached_property
    def _beyond(self) -> Value:
        """By how much the segments' angles together exceed a full turn, rad."""
        return sum(segment.angle for segment in self.segments) - TURN

    @cached_property
    def starts(self) -> list[Value]:
        """The cam angle at which each segment begins, and at last the span."""
        *starts, end = accumulate((segment.angle for segment in self.segments), initial=0.0)
        return [*starts, np.where(self.periodic, TURN, end)[()]]

    @cached_property
    def levels(self) -> list[Any]:
        """The level at which each segment begins, and at last the final one."""
        return self._levels()

    def _levels(self) -> list[Any]:
        return list(accumulate((segment.change for segment in self.segments), initial=self.start))

    @property
    def waves(self) -> int:
        """How many waves ride on the motion in a turn: none."""
        return 0

    @property
    def span(self) -> Value:
        """The cam angle of the whole program, rad."""
        return self.starts[-1]

    @property
    def edges(self) -> Value:
        """The cam angles of the joints from 0 to ``span``, rad: ``(k + 1,)`` for ``k`` segments, or ``(p, k + 1)``."""
        return np.concatenate([np.atleast_1d(edge) for edge in np.broadcast_arrays(*self.starts)], axis=-1)

    @cached_property
    def resolution(self) -> Resolution:
        """Cam angles that show every segment, however narrow, with its joints and kinks from both sides."""
        return resolve(self)

    def over(self, shown: Resolution) -> Kinematics:
        """``s, v, a, j`` at the cam angles of a resolution: a law is asked once for all of a population."""
        with np.errstate(all="ignore"):
            pieces = [[_along(u, values) for values in self._moved(i, u)] for i, u in shown.shares]
            joined = (end_to_end(*values) for values in zip(*pieces, strict=True))
            return self._if_possible(*np.broadcast_arrays(*joined, shown.angle)[:4])

    @property
    def periodic(self) -> bool | Array:
        """Whether the program spans 360 deg."""
        return np.abs(self._beyond) <= ROUNDED

    @property
    def _misses(self) -> Value:
        """Whether the program is a little short of a turn."""
        return (self._beyond > -NEARLY) & (self._beyond < -ROUNDED)

    @property
    def closes(self) -> bool | Array:
        """Whether the last level is the first one and the advance, or need not be: there is no turn, nor an advance."""
        gap = np.abs(self.levels[-1] - self.start - self.advance)
        return np.where(self.periodic, gap <= SAME_LEVEL * self._size(), self.comes_back)[()]

    def _size(self) -> Value:
        """How large levels and their changes are."""
        return sum(segment.reach[1] - segment.reach[0] for segment in self.segments)

    @cached_property
    def possible(self) -> bool:
        """Whether the program can be; of a population, which rows can."""
        each = [finite(segment.change) & positive(segment.angle) for segment in self.segments]
        fits = (self._beyond <= ROUNDED) & np.logical_not(self._misses)
        return reduce(np.logical_and, each, finite(self.start) & finite(self.advance) & fits & self.closes)

    def __call__(self, cam_angle: ArrayLike) -> Kinematics:
        """``s, v, a, j`` at ``cam_angle`` (rad); at a joint the segment that begins there speaks."""
        phi = numbers(cam_angle, "the cam angles")
        with np.errstate(all="ignore"):
            motion = self._turned(np.atleast_1d(phi))
        return motion if phi.ndim else Kinematics(*(values[..., 0] for values in motion))

    def in_time(self, cam_angle: ArrayLike, speed: Value) -> Kinematics:
        """``s, v, a, j`` with respect to time (m or rad, per s^k) at a constant shaft ``speed`` (rad/s).

        ``speed`` may be an array of shape ``(p, 1)``.  ``ValueError`` for one that is not finite
        or below 0 (a cam that turns back runs another program).

        >>> from camkit.motion import Rise, SimpleHarmonic
        >>> from camkit.units import deg, mm, rpm
        >>> rise = MotionProgram((Rise(120 * deg, 50 * mm, SimpleHarmonic()),))
        >>> rise.in_time(60 * deg, 100 * rpm).v.round(2)
        np.float64(0.39)
        """
        must = "be a finite number of at least 0"
        speed = a_number(speed, "the speed of the shaft", must, lambda speed: speed >= 0)
        speed = floats(speed)
        s, v, a, j = self(cam_angle)
        with np.errstate(over="ignore"):
            square, cube = speed**2, speed**3
        return Kinematics(s + 0 * speed, v * speed, a * square, j * cube)

    def transitions(self) -> list[Transition]:
        """A record for each joint, in order; over 360 deg the joint of the last to the first segment comes last.

        ``ValueError`` for a population, whose members have joints of their own.
        """
        if np.ndim(self.possible):
            raise ValueError("the program is a population; joints are named for one program at a time")
        return find_transitions(self)

    def peaks(self) -> ProgramPeaks:
        """Peak |v|, |a|, |j| with the cam angle of each, found between samples and on both sides of joints.

        ``inf`` where a lower derivative jumps, at a joint or inside a law.  A population gives arrays ``(p,)``.
        """
        return find_peaks(self)

    def _turned(self, phi: Array) -> Kinematics:
        """``s, v, a, j`` at cam angles of any turn; the level is one ``advance`` further for each."""
        x = self._within(phi)
        s, v, a, j = self._at(x)
        if not certain(self.comes_back):
            s = s + self.advance * np.floor((phi - x) / TURN + 0.5)
        return Kinematics(s, v, a, j)

    def _within(self, phi: Array) -> Array:
        """Cam angles brought into the turn, ``nan`` where the program says nothing."""
        x = phi
        within = (phi >= 0) & (phi <= TURN)
        if not (certain(within) or certain(np.logical_not(self.periodic))):
            once = np.where(np.abs(phi - TURN) <= SAME_ANGLE, TURN, np.mod(phi, TURN))
            x = np.where(self.periodic & np.logical_not(within), once, phi)
        return np.where((x >= -SAME_ANGLE) & (x <= self.span + SAME_ANGLE), x, np.nan)

    def _at(self, x: Array) -> Kinematics:
        begun = [x >= edge - SAME_JOINT for edge in self.starts[1:-1]]
        over, ahead = (*map(certain, begun), False), (False, *(certain(np.logical_not(here)) for here in begun))
        first, *others = [i for i in range(len(self.segments)) if not (over[i] or ahead[i])] or [0]
        if others and all(map(known, (x, *begun))):
            pieces = self._by_columns(x, begun, [first, *others])
            if all(known(value) for *_, values in pieces for value in values):
                return self._if_possible(*_put_together(x, begun, pieces))
        motion = self._piece(first, x)
        for i in others:
            pairs = zip(self._piece(i, x), motion, strict=True)
            motion = Kinematics(*(np.where(begun[i - 1], *pair) for pair in pairs))
        return self._if_possible(*np.broadcast_arrays(*motion, x)[:4])

    def _by_columns(self, x: Array, begun: list[Array], segments: list[int]) -> list[_Columns]:
        """Each segment asked at those cam angles only at which any member of a population is in it."""
        whole = np.ones(1, dtype=bool)
        here = [whole, *begun], [*(np.logical_not(ahead) for ahead in begun), whole]
        inside = [np.atleast_2d(late & early).any(0) for late, early in zip(*here, strict=True)]
        pieces = []
        for i in segments:
            columns = np.flatnonzero(np.broadcast_to(inside[i], x.shape[-1:]))
            known_at = x if len(columns) == x.shape[-1] else x[..., columns]
            pieces.append(_Columns(i, columns, np.broadcast_arrays(*self._piece(i, known_at), known_at)[:4]))
        return pieces

    def _piece(self, i: int, x: Array) -> Kinematics:
        """What segment ``i`` says at the cam angles ``x``; before it begins and after it ends it rests."""
        return self._moved(i, np.minimum(np.maximum((x - self.starts[i]) / self.segments[i].angle, 0.0), 1.0))

    def _moved(self, i: int, u: Array) -> Kinematics:
        """What segment ``i`` says at the share ``u`` of it."""
        s, v, a, j = self.segments[i].motion(u)
        return Kinematics(self.levels[i] + s, v, a, j)

    def _if_possible(self, *motion: Array) -> Kinematics:
        """``motion``, ``nan`` in the rows of programs that cannot be."""
        if certain(self.possible):
            return Kinematics(*motion)
        return Kinematics(*(np.where(self.possible, values, np.nan) for values in motion))


class _Columns(NamedTuple):
    """What a segment says at some of the cam angles."""

    segment: int
    columns: Array
    values: Sequence[Array]


def _put_together(x: Array, begun: list[Array], pieces: list[_Columns]) -> tuple[Array, ...]:
    """The motion at the cam angles ``x``, of what each segment says at those where it has begun."""
    shape = np.broadcast_shapes(*(values[0].shape[:-1] for *_, values in pieces), *(b.shape[:-1] for b in begun))
    motion = tuple(np.full((*shape, x.shape[-1]), np.nan) for _ in range(4))
    for i, columns, values in pieces:
        mine = np.broadcast_to(begun[i - 1] if i else np.True_, (*shape, x.shape[-1]))[..., columns]
        for found, value in zip(motion, values, strict=True):
            found[..., columns] = np.where(mine, value, found[..., columns])
    return motion


def _along(u: Array, values: Any) -> Array:
    """``values`` at each of ``u``, also where a law gives one for all."""
    return values if np.shape(values)[-1:] == u.shape[-1:] else np.broadcast_to(values, u.shape)
