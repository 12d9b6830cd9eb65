"""How the strokes of a cam shake a follower that is one mass on a spring: a measure for each natural frequency."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby
from typing import Any

import numpy as np

from ..geometry import end_to_end
from ..motion import MotionProgram, Segment
from ..motion.vibration import left_swinging
from ..quantities import Measure, PeakMeasure
from ..quantities.kinds import one_number
from ..quantities.known import certain
from ..quantities.types import Array
from .drive import flywheel
from .timing import at_lift


def vibration_at(frequency: float, damping: float = 0.0) -> PeakMeasure:
    """The residual vibration of a follower with the natural ``frequency`` (Hz) at the speed of its cam.

    What still swings after a stroke that began at rest, after the worst of them, as a share of the whole travel;
    ``damping`` is a share of the critical one.  The strokes lie between the dwells, one of them perhaps over the start
    of the turn; where there is none all of the motion is one.  A search sees the swing and its phases, so that it finds
    a law that leaves nothing to swing.

    >>> from camkit import TranslatingRollerCam
    >>> left = vibration_at(40)
    >>> print(f"{left.name}: {left.text(left(TranslatingRollerCam().analyse()))}")
    residual vibration at 40 Hz: 1.692 %

    Raises ``ValueError`` for a frequency that is not above 0, a damping that is not from 0 to below 1, and for a cam
    that has no speed.
    """
    frequency = one_number(frequency, "the natural frequency", "be a finite number above 0", lambda f: 0 < f < np.inf)
    damping = one_number(damping, "the damping", "be at least 0 and below 1", lambda z: 0 <= z < 1)
    damped = f", damping {damping:.6g}" if damping else ""

    def points(analysis: Any) -> Array:
        curve = next(iter(analysis.curves.values()))
        program, periods = curve.program, frequency / np.where(curve.cam.load.speed > 0, curve.cam.load.speed, np.nan)
        left = [left_swinging(stroke, stroke.span * periods, damping) for stroke in _strokes(program)]
        return end_to_end(*left) / _travel(program) if left else np.zeros(1)

    made = "vibration at", frequency, damping
    return PeakMeasure(f"residual vibration at {frequency:.6g} Hz{damped}", "%", points, made=made)


def _strokes(program: MotionProgram) -> list[MotionProgram]:
    """What moves between two dwells, also over the start of the turn."""
    runs = [tuple(run) for still, run in groupby(program.segments, _still) if not still]
    ends = program.segments[0], program.segments[-1]
    if len(runs) > 1 and not any(map(_still, ends)) and certain(program.periodic):
        runs[0] = runs.pop() + runs[0]
    return [MotionProgram(run) for run in runs]


def _still(segment: Segment) -> bool:
    return segment.still


def _travel(program: MotionProgram) -> Array:
    """Between the lowest and the highest level of a motion, ``(1,)`` or ``(p, 1)``; ``nan`` where it does not move."""
    pairs = zip(program.levels, program.segments, strict=False)
    ends = [np.atleast_1d(level + end) for level, segment in pairs for end in segment.reach]
    travel = np.ptp(np.stack(np.broadcast_arrays(*ends), axis=-1), axis=-1)
    return np.where(travel > 0, travel, np.nan)


MAKERS: dict[str, Callable[..., Measure]] = {
    "vibration at": vibration_at,
    "at lift": at_lift,
    "flywheel": flywheel,
}
"""How files have such measures made again."""
