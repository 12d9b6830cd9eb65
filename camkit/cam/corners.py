"""Where the follower's speed jumps: corners of its motion, between two of its smooth pieces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..motion import MotionProgram
from ..motion.resolution import Resolution

if TYPE_CHECKING:
    from .analysis import CamAnalysis

JUMP = 1e-6
"""A jump of position or speed below this share of the largest one is rounding."""


def corners(
    shown: CamAnalysis, resolution: Resolution, program: MotionProgram
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """By how much the speed of the follower jumps, how far it leaps, and at which cam angles (see `CamAnalysis`)."""
    first, last = resolution.first, resolution.last
    s, v = (x - 0.0 * shown.cam_angle for x in shown.motion[:2])
    leaps, jumps = (np.roll(x[..., first], -1, axis=-1) - x[..., last] for x in (s, v))
    leaps = np.where(abs(leaps) > JUMP * abs(s).max(-1, keepdims=True), np.inf, 0.0)
    real = abs(jumps) > JUMP * abs(v).max(-1, keepdims=True)
    inside = program.periodic | (np.arange(len(first)) < len(first) - 1)
    angle = np.roll(shown.cam_angle[..., first], -1, axis=-1)
    return np.where(inside, np.where(real, jumps, 0.0), 0.0), np.where(inside, leaps, 0.0), angle
