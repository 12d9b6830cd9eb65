"""How a motion program that spans a turn stays closed when its segments change.

The last dwell takes up the angle that the others leave of the turn (the last segment, where there is no dwell), and
the last move takes the follower back to where it began, or on by the advance of a turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..quantities import unless
from ..quantities.kinds import refuse_unequal
from ..quantities.types import Value
from .segments import Dwell, Move, Return, Segment, degrees, kind_of

TURN = 2 * np.pi


def closing(segments: Sequence[Segment]) -> tuple[int, int | None]:
    """Which segment takes up the angle, and which the lift (``None`` where nothing moves)."""
    dwells = [i for i, segment in enumerate(segments) if isinstance(segment, Dwell)]
    moves = [i for i, segment in enumerate(segments) if isinstance(segment, Move)]
    return dwells[-1] if dwells else len(segments) - 1, moves[-1] if moves else None


def closed(segments: Sequence[Segment], before: Sequence[Segment], advance: Value = 0.0) -> list[Segment]:
    """``segments`` of a turn, closed again where angles or lifts are not those that they were ``before``."""
    found: list[Segment] = list(segments)
    angle, lift = closing(before)
    pairs = list(zip(segments, before, strict=True))
    if any(new.angle is not old.angle for new, old in pairs):
        found[angle] = replace(found[angle], angle=_angle_left(found, angle))
    if lift is not None and any(new.change is not old.change for new, old in pairs):
        found[lift] = replace(found[lift], lift=_lift_left(found, lift, advance))
    return found


def _angle_left(segments: Sequence[Segment], i: int) -> Value:
    """What the others leave of the turn."""
    others = _of_the_others(segments, i, "angle")
    if refuse := unless(others < TURN):
        refuse(
            f"the other segments take {degrees(others)} of the turn; they must leave some for the "
            f"{kind_of(segments[i])} that closes it"
        )
    return TURN - others


def _lift_left(segments: Sequence[Segment], i: int, advance: Value) -> Value:
    """What the segment has to move for the turn to end where it began, or its ``advance`` further."""
    others = _of_the_others(segments, i, "change") - advance
    lift = others if isinstance(segments[i], Return) else -others
    if refuse := unless(lift >= 0):
        kind = kind_of(segments[i])
        refuse(
            f"the {kind} that closes the turn would have to move by {lift:.6g} (follower units); it must be "
            f"at least 0: the lifts before it are too {'small' if kind == 'return' else 'large'}"
        )
    return lift


def _of_the_others(segments: Sequence[Segment], i: int, name: str) -> Value:
    """The angles or changes of all segments but one, added."""
    others = {f"segment {k}": getattr(segment, name) for k, segment in enumerate(segments, 1) if k != i + 1}
    refuse_unequal(others, "program")
    return sum(others.values())
