"""The field of a design that holds the motion of its follower: what its numbers are called and their units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from typing import Any

from ..quantities import Quantity
from ..quantities.kinds import refuse_arguments
from .parts import per_radian
from .program import START, MotionProgram
from .segments import LIFT


def motion_in(unit: str, lift: float, most: float, make: Callable[[], MotionProgram]) -> Any:
    """A dataclass field for the motion program of a follower whose level is in ``unit``.

    A usual ``lift`` and the largest that a slider offers are in that unit; ``make`` makes the field's default.
    """
    refuse_arguments(motion_in, locals())
    says = {
        "lift": Quantity("h", lift, most / 60, most, unit, LIFT.meaning, at_least=0),
        "start": Quantity("s_0", 0, -most, most, unit, START.meaning, above=None),
        "offset": Quantity(
            "e_0", 0, -most / 100, most / 100, unit, "by how much the profile lies too far out", above=None
        ),
        "amplitude": Quantity("A", 0, 0, most / 100, unit, "of the waves on the profile", at_least=0),
        **per_radian(unit, most),
    }
    return field(default_factory=make, metadata={"says": says})
