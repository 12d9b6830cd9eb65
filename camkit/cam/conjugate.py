"""Pairs of cams on one shaft that hold a follower from both sides, so that no spring is needed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..motion import MotionProgram, Return, Rise, Segment
from ..motion.segments import Move
from ..quantities.types import Array

if TYPE_CHECKING:
    from .analysis import CamAnalysis


def opposite(program: MotionProgram) -> MotionProgram:
    """The same motion downwards: what the second cam of a pair gives its follower.

    >>> from camkit.motion import Cycloidal, Dwell
    >>> program = opposite(MotionProgram((Rise(1.0, 0.5, Cycloidal()), Dwell(1.0))))
    >>> program([0.25, 0.5, 1.0, 2.0]).s.round(6).tolist()
    [-0.045423, -0.25, -0.5, -0.5]
    """
    return MotionProgram(tuple(_opposite(segment) for segment in program.segments), -program.start)


def _opposite(segment: Segment) -> Segment:
    if not isinstance(segment, Move):
        return segment
    other = Return if isinstance(segment, Rise) else Rise
    return other(segment.angle, segment.lift, segment.law, name=segment.name)


class PairForces(NamedTuple):
    """Contact forces of both cams of a pair without play and preload, N: one of them is 0."""

    first: Array
    second: Array


def pair_forces(first: CamAnalysis, second: CamAnalysis) -> PairForces:
    """What each cam of a pair gives, from both analyses: each pushes only, the one where the other cannot."""
    return PairForces(np.maximum(first.contact_force, 0), np.maximum(second.contact_force, 0))
