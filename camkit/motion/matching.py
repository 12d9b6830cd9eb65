"""How the parts of a matched program find their motion: what holds at each transition, and the smoothest that meets it.

Among all motions that meet the conditions it is the one with the least integral of a derivative squared over its
polynomials, that of the jerk or, where a jerk is given or matched, of the one after it.

Source: VDI 2143 part 1; de Boor, A Practical Guide to Splines (the extremal property of natural splines).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import compress, pairwise
from typing import Any, NamedTuple

import numpy as np

from ..program import CannotRecord
from ..quantities import certain, known, unless
from ..quantities.types import Value
from .curve import _Curve, _LiftedLaw, bending, hermite, newton, slope_at, slopes
from .families.free import LETTERS
from .linear import Conditions, Linear, weighed
from .parts import MATCH, Boundary, OpenMove, Part, Polynomial, Uniform
from .segments import Dwell, Segment

NAMES = ("level", "velocity", "acceleration", "jerk")
NONE = 1e-9
"""A derivative of a law, of lift 1 over a time of 1, is 0 at an end if it is smaller."""
ITS_ENDS = (
    "whether the law of an open move comes to rest at its ends follows from its numbers, and with it which conditions "
    "there are; a law that rests at both, or a polynomial part in its place, can be recorded"
)
State = Sequence[Linear]
"""``s, v, a, j`` (m or rad, per rad^k) as they follow from unknowns."""


class Laid(NamedTuple):
    """A part with its ends, what it adds to what is to be least, and the segment it becomes by its numbers."""

    start: State
    end: State
    sizes: Sequence[Linear]
    made: Callable[[Callable[[Linear], Value]], Segment]


class Matching(NamedTuple):
    """What is solved: the segments, where each begins and the last ends, and whether it could be."""

    segments: tuple[Segment, ...]
    levels: list[Value]
    possible: Any


class Asked(NamedTuple):
    """A part with its name and the cam angle that it takes (rad); ``order`` is that of the derivative to be least."""

    part: Segment | Part
    name: str
    angle: Value
    order: int


def solved(asked: Sequence[Asked], boundaries: Sequence[Boundary], advance: Value | None) -> Matching:
    """The motion of parts with ``boundaries``: where each begins, and where the last ends, unless a turn goes on.

    Over the end of a turn the level is an ``advance`` further; ``None``: it does not go on.
    """
    conditions = Conditions()
    with np.errstate(all="ignore"):
        laid = [_laid(each, conditions) for each in asked]
        for i, boundary in enumerate(boundaries):
            where = f"where {asked[i].name} begins" if i < len(asked) else f"where {asked[-1].name} ends"
            sides = _sides(laid, i, advance)
            for k in range(asked[0].order):
                _join(conditions, [side[k] for side in sides], getattr(boundary, LETTERS[k]), f"the {NAMES[k]} {where}")
        numbers = conditions.least(size for each in laid for size in each.sizes)

        def number(form: Linear) -> Value:
            found = form.put(numbers).constant
            return float(found) if isinstance(found, int) else found

        segments = tuple(each.made(number) for each in laid)
        levels = [*(number(each.start[0]) for each in laid), number(laid[-1].end[0])]
    return Matching(segments, levels, _sound(conditions))


def _sound(conditions: Conditions) -> Any:
    """Whether the conditions could be met; one program is refused if not."""
    possible: Any = True
    for ok, sentence in conditions.sound:
        if (refuse := unless(ok)) and (said := sentence()):
            refuse(said)
        possible = possible & ok
    return possible


def _sides(laid: Sequence[Laid], i: int, advance: Value | None) -> list[State]:
    """What meets at the transition ``i``."""
    sides = [laid[i].start] if i < len(laid) else []
    if i > 0:
        sides.append(laid[i - 1].end)
    elif advance is not None:
        level, *others = laid[-1].end
        sides.append([level - Linear.known(advance), *others])
    return sides


def _join(conditions: Conditions, sides: Sequence[Linear], wanted: Value | str, name: str) -> None:
    """Meet what is wanted of one of ``s, v, a, j`` at a transition."""
    if isinstance(wanted, str):
        if wanted == MATCH and len(sides) > 1:
            conditions.meet(sides[0] - sides[1], name)
        return
    for side in sides:
        conditions.meet(side - Linear.known(wanted), name)


def _laid(asked: Asked, conditions: Conditions) -> Laid:
    part = asked.part
    if isinstance(part, Polynomial):
        return (_single if part.through and part.form == "polynomial" else _spline)(part, asked, conditions)
    level = conditions.unknown(f"the level where {asked.name} begins")
    if isinstance(part, Uniform):
        return _uniform(part, asked, conditions, level)
    if isinstance(part, OpenMove):
        return _open_move(part, asked, conditions, level)
    return _as_it_is(part, asked, level)


def _as_it_is(segment: Any, asked: Asked, level: Linear) -> Laid:
    """A segment that knows its motion."""
    if isinstance(segment, Dwell):
        rest = [level, Linear(), Linear(), Linear()]
        return Laid(rest, rest, [], lambda number: Dwell(asked.angle, name=asked.name))
    start, end = (_end_of(segment, asked.angle, level, u) for u in (0.0, 1.0))
    return Laid(start, end, [], lambda number: segment.replace(name=asked.name))


def _end_of(segment: Segment, angle: Value, level: Linear, u: float) -> list[Linear]:
    """The state of a segment at an end; what is 0 there but for rounding counts as large as its motion is."""
    motion, scale = segment.motion(np.array(u)), np.abs(segment.change)
    s, *others = (Linear.known(x, np.abs(x) + scale / angle**k) for k, x in enumerate(motion))
    return [level + s, *others]


def _uniform(part: Uniform, asked: Asked, conditions: Conditions, level: Linear) -> Laid:
    speed = part.speed(asked.angle)
    v = conditions.unknown(f"the velocity of {asked.name}") if speed is None else Linear.known(speed)
    end = level + v * asked.angle

    def made(number: Callable[[Linear], Value]) -> Segment:
        travel = number(v) * asked.angle
        return _Curve(asked.angle, (0.0, 1.0), ((0.0, travel),), travel, asked.name)

    return Laid([level, v, Linear(), Linear()], [end, v, Linear(), Linear()], [], made)


def _open_move(part: OpenMove, asked: Asked, conditions: Conditions, level: Linear) -> Laid:
    lift, law = conditions.unknown(f"the lift of {asked.name}"), part.law
    first, last = law(np.array(0.0)), law(np.array(1.0))
    start, end = (
        [lift * _slope(law, k, motion[k], asked.angle) for k in range(1, len(LETTERS))] for motion in (first, last)
    )
    top = level + lift * (last.s - first.s)
    return Laid([level, *start], [top, *end], [], lambda number: _LiftedLaw(asked.angle, law, number(lift), asked.name))


def _slope(law: Any, k: int, value: Value, angle: Value) -> Any:
    """A derivative of a law over ``angle``; where it surely is none the whole number 0."""
    none = certain(np.abs(value) < NONE) if known(value) else _rests(law, value, k)
    return 0 if none else value / angle**k


def _rests(law: Any, value: Any, k: int) -> bool:
    """Whether a derivative of a law, whose ``value`` is recorded, is 0 at its ends whatever its numbers are."""
    try:
        return bool(getattr(law, "continuity", 0) >= k)
    except CannotRecord:
        return bool(value.refuse(ITS_ENDS))


def _spline(part: Polynomial, asked: Asked, conditions: Conditions) -> Laid:
    """Polynomials between the ends and the points inside."""
    states = [_state(place, asked, conditions) for place in _places(part, asked)]
    knots = [0.0, *_knots(part, asked, conditions), 1.0]
    for point, state, place in zip(part.through, states[1:-1], _places(part, asked)[1:-1], strict=True):
        for k, value in point.given.items():
            conditions.meet(state[k] - Linear.known(value), f"the {NAMES[k]} {place}")
    widths = [(high - low) * asked.angle for low, high in pairwise(knots)]
    pieces = [_by_share(*ends, width) for ends, width in zip(pairwise(states), widths, strict=True)]
    sizes = [size for powers, width in zip(pieces, widths, strict=True) for size in _sizes(powers, width, asked)]
    return Laid(states[0], states[-1], sizes, partial(_curve, asked, knots, pieces))


def _single(part: Polynomial, asked: Asked, conditions: Conditions) -> Laid:
    """One polynomial of the least degree through its ends and the points inside."""
    first, last = (_state(_places(part, asked)[end], asked, conditions) for end in (0, -1))
    knots = _knots(part, asked, conditions)
    wanted = [(i, k, value) for i, point in enumerate(part.through) for k, value in point.given.items()]
    more = newton(asked.order, [knots[i] for i, *_ in wanted])
    factors = [conditions.unknown(f"the motion inside {asked.name}") for _ in wanted]
    base = [*_by_share(first, last, asked.angle), *(Linear() for _ in wanted)]
    for i, k, value in wanted:
        at = [slope_at(row, k, knots[i]) for row in more]
        there = [sum(point == i for point, *_ in wanted[:n]) <= k for n in range(len(wanted))]  # others vanish there
        forms = [weighed(base, slopes(len(base), k, knots[i])), *compress(factors, there), Linear.known(value)]
        zero = weighed(forms, (1, *compress(at, there), -(asked.angle**k)))
        name, own = f"the {NAMES[k]} inside {asked.name}", list(compress(more, there))[-1]
        conditions.needs(list(compress(at, there))[-1], slope_at([np.abs(x) for x in own], k, knots[i]), name)
        conditions.meet(zero, name)
    rows = [[*row, *np.zeros(len(base) - len(row)).tolist()] for row in more]
    powers = [weighed((base[i], *factors), (1, *(row[i] for row in rows))) for i in range(len(base))]
    return Laid(first, last, _sizes(powers, asked.angle, asked), partial(_curve, asked, [0.0, 1.0], [powers]))


def _places(part: Polynomial, asked: Asked) -> list[str]:
    """Where a polynomial begins, its points, and where it ends, in words."""
    return [
        f"where {asked.name} begins",
        *(f"at {point} of {asked.name}" for point in part.point_names),
        f"where {asked.name} ends",
    ]


def _state(place: str, asked: Asked, conditions: Conditions) -> list[Linear]:
    """``s, v, a`` (and ``j``), not known yet."""
    return [conditions.unknown(f"the {name} {place}") for name in NAMES[: asked.order]]


def _knots(part: Polynomial, asked: Asked, conditions: Conditions) -> list[Value]:
    """The shares at which the points of a polynomial lie."""
    knots = [point.place(asked.angle) for point in part.through]
    rises = [low < high for low, high in pairwise((0.0, *knots, 1.0))]
    for ok in rises:
        if refuse := unless(ok):
            refuse(f"the points of {asked.name} must lie inside it, one after the other")
        conditions.sound.append((ok, str))
    return knots


def _by_share(first: State, last: State, width: Value) -> list[Linear]:
    """The powers of the share of a piece, ``width`` wide (rad), by what holds at its ends."""
    ends = [value * width**k if k else value for state in (first, last) for k, value in enumerate(state)]
    return [weighed(ends, row) for row in hermite(len(first))]


def _sizes(powers: Sequence[Linear], width: Value, asked: Asked) -> list[Linear]:
    """What is to be least, of one piece."""
    rows = bending(asked.order, len(powers) - 1)
    return [weighed(powers, row) * width ** (0.5 - asked.order) for row in rows]


def _curve(
    asked: Asked, knots: Sequence[Value], pieces: Sequence[Sequence[Linear]], number: Callable[[Linear], Value]
) -> Segment:
    """The segment of the pieces of a polynomial, by their powers."""
    first = pieces[0][0]
    found = [[number(power) for power in (powers[0] - first, *powers[1:])] for powers in pieces]
    end = number(weighed((*pieces[-1], first), (*(1 for _ in pieces[-1]), -1)))
    return _Curve(asked.angle, tuple(knots), tuple(map(tuple, found)), end, asked.name)
