"""Pairs of cams on one shaft that hold a follower from both sides, so that no spring is needed."""

from __future__ import annotations

from ..motion import MotionProgram, Return, Rise, Segment
from ..motion.curve import Solved
from ..motion.segments import Move
from ..motion.table import Table


def opposite(program: MotionProgram) -> MotionProgram:
    """The same motion downwards: what the second cam of a pair gives its follower.

    >>> from camkit.motion import Cycloidal, Dwell
    >>> program = opposite(MotionProgram((Rise(1.0, 0.5, Cycloidal()), Dwell(1.0))))
    >>> program([0.25, 0.5, 1.0, 2.0]).s.round(6).tolist()
    [-0.045423, -0.25, -0.5, -0.5]
    """
    downwards = tuple(_opposite(segment) for segment in program.segments)
    return MotionProgram(downwards, -program.start, advance=-program.advance)


def _opposite(segment: Segment) -> Segment:
    if isinstance(segment, (Table, Solved)):
        return segment.opposite
    if not isinstance(segment, Move):
        return segment
    other = Return if isinstance(segment, Rise) else Rise
    return other(segment.angle, segment.lift, segment.law, name=segment.name)
