"""A program whose moves become polynomials, so that every transition is matched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..quantities import certain
from ..quantities.kinds import shown
from .families.constant_velocity import ConstantVelocity
from .form import FormedProgram
from .matched import MatchedProgram
from .parts import FREE, MATCH, Boundary, Part, Polynomial, Uniform
from .program import MotionProgram
from .segments import Dwell, Move, Segment


def matched(program: MotionProgram) -> MatchedProgram:
    """The same angles and levels with every transition matched: moves become polynomials.

    Dwells stay, and what moves at constant velocity; where the motion turns back its velocity is 0.  An advance and an
    error of form stay, too.

    >>> from camkit.motion import Return, Rise, SimpleHarmonic
    >>> law = SimpleHarmonic()
    >>> rough = MotionProgram((Rise(2.0, 0.02, law), Dwell(2.0), Return(2 * np.pi - 4, 0.02, law)))
    >>> [transition.lawful for transition in rough.transitions()]
    [False, False, False]
    >>> [transition.lawful for transition in matched(rough).transitions()]
    [True, True, True]
    """
    if not isinstance(program, MotionProgram):
        raise ValueError(f"the program is {shown(program)}; it must be a MotionProgram")
    if isinstance(program, MatchedProgram):
        return program.replace(boundaries=tuple(_all_matched(boundary) for boundary in program.boundaries))
    parts = tuple(_freed(program, i) for i in range(len(program.segments)))
    turn = certain(program.periodic)
    boundaries = [_boundary(program, parts, i, turn) for i in range(len(parts) + (not turn))]
    smooth = MatchedProgram(parts, tuple(boundaries), advance=program.advance)
    return program.form.on(smooth) if isinstance(program, FormedProgram) else smooth


def _all_matched(boundary: Boundary) -> Boundary:
    """A boundary where nothing up to the acceleration may jump."""
    return boundary.replace(**{letter: MATCH for letter in "sva" if getattr(boundary, letter) is FREE})


def _freed(program: MotionProgram, i: int) -> Segment | Part:
    """What moves as a part that follows from its ends."""
    segment, name = program.segments[i], program.names[i]
    if segment.still:
        return Dwell(segment.angle, name=name)
    if not isinstance(segment, Move):
        return replace(segment, name=name)
    if _uniform(segment) and not any(still or _uniform(other) for other, still in _neighbours(program, i)):
        return Uniform(travel=segment.change, angle=segment.angle, name=name)
    return Polynomial(segment.angle, name=name)


def _uniform(segment: Segment) -> bool:
    return isinstance(segment, Move) and isinstance(segment.law, ConstantVelocity)


def _neighbours(program: MotionProgram, i: int) -> list[tuple[Segment, bool]]:
    """The segments on both sides, with whether they rest; beyond the ends of a shorter program there are none."""
    places = [i - 1, (i + 1) % len(program.segments)] if certain(program.periodic) else [i - 1, i + 1]
    found = [program.segments[k] for k in places if -certain(program.periodic) <= k < len(program.segments)]
    return [(segment, segment.still) for segment in found]


def _boundary(program: MotionProgram, parts: tuple[Segment | Part, ...], i: int, turn: bool) -> Boundary:
    """What a boundary of the matched program holds, so that levels stay."""
    n, level = len(parts), program.levels[i]
    if not turn and i in (0, n):
        _, v, a, _ = program.segments[min(i, n - 1)].motion(np.array(float(i == n)))
        return Boundary(level, v, a) if isinstance(parts[min(i, n - 1)], Polynomial) else Boundary(level)
    if not isinstance(parts[i], Part) and not isinstance(parts[i - 1], Part):
        return Boundary(level, FREE, FREE)
    back = certain(program.segments[i - 1].change * program.segments[i].change < 0)
    return (
        Boundary(level, 0.0)
        if back and not isinstance(parts[i - 1], Uniform) and not isinstance(parts[i], Uniform)
        else Boundary(level)
    )
