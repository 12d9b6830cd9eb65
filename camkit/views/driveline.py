"""View of a driveline, universal joints in a row, in space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from ..quantities.types import Array, Value
from ..units import deg
from .picture import Axes, Picture
from .shafts import REACH, fork
from .turntable import Turntable

LENGTH, END = 3.0, 1.9
"""Of a shaft between two joints and of one at an end, in lengths of which a pin has 1."""


class Bent(Protocol):
    """The shafts of a driveline over a turn of the first: their directions, and those of their pins at both ends."""

    @property
    def input_angle(self) -> Array: ...
    @property
    def shafts(self) -> Sequence[Array]: ...
    def pins(self, turn: Value) -> Sequence[tuple[Array, Array]]: ...


def driveline(analysis: Bent, turn: float = 0.0, azimuth: float = -75 * deg, elevation: float = 25 * deg) -> Picture:
    """All shafts with their forks and crosses, the input shaft turned by ``turn`` (rad)."""
    axes, pins = analysis.shafts, analysis.pins(turn)
    joints = [np.zeros(3)]
    for axis in axes[1:-1]:
        joints.append(joints[-1] + LENGTH * axis)
    centre = (joints[0] + joints[-1]) / 2
    size = LENGTH * (len(joints) - 1) / 2 + 2.0
    table = Turntable(np.eye(3), np.zeros(3), size, size / 2, azimuth, elevation)
    for i, (joint, (before, behind)) in enumerate(zip(joints, pins, strict=True)):
        at = joint - centre
        first, last = i == 0, i == len(joints) - 1
        away, back = axes[i + 1], axes[i]
        name = "input" if first else "intermediate"
        fork(table, name, 2 * i, at, -back, REACH * before, at - (END if first else LENGTH / 2) * back)
        name = "driven" if last else "intermediate"
        fork(table, name, 2 * i + 1, at, away, REACH * behind, at + (END if last else LENGTH / 2) * away)
    ends = (-size, size), (-size / 2, size / 2)
    return table.picture(Axes(title="Driveline", equal=True, bare=True, xlim=ends[0], ylim=ends[1]))
