"""How a follower moves, is led and what it resists with, whatever touches the cam: on a straight guide or an arm."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property, reduce
from typing import Any, ClassVar, TypeVar

import numpy as np

from ..geometry import vector
from ..motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from ..quantities import Design, counted, unless
from ..quantities.types import Array, Value
from ..units import deg
from .analysis import CamAnalysis
from .statics import Guide, Pivot


def rise_and_return(lift: float) -> MotionProgram:
    """``lift`` (m or rad) up and down, with dwells."""
    law = Cycloidal()
    return MotionProgram((Rise(120 * deg, lift, law), Dwell(60 * deg), Return(120 * deg, lift, law), Dwell(60 * deg)))


def top_level(motion: MotionProgram) -> Array:
    """The highest level at which a segment of ``motion`` begins or ends, m; of a table its highest one."""
    tops = (level + segment.reach[1] for level, segment in zip(motion.levels, motion.segments, strict=False))
    return reduce(np.maximum, tops)


def comes_back(motion: MotionProgram, kind: str) -> bool | Array:
    """Whether a motion is one of a cam with one outline; ``ValueError`` in a sentence for one that goes on."""
    if refuse := unless(motion.comes_back):
        refuse(
            f"the motion goes on by {motion.advance:.6g} (follower units) with each turn; a {kind} takes its follower "
            "back to where it was: the advance of its motion must be 0"
        )
    return motion.comes_back


Kind = TypeVar("Kind", bound=CamAnalysis)


def over_the_motion(kind: type[Kind], cam: Any, n: int) -> Kind:
    """The analysis of a cam at ``n`` even cam angles over its motion's span; ``ValueError`` if it cannot be built."""
    analysis = kind(cam, np.linspace(0, 1, counted(n, "cam angles")) * cam.motion.span)
    analysis.refuse_impossible()
    return analysis


class DiskCam(Design, ABC):
    """A cam with one outline, which its follower goes around with each turn: its motion comes back."""

    motion: MotionProgram

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(comes_back(self.motion, "disk cam"))

    @abstractmethod
    def analyse(self, n: int = 721) -> CamAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""


class SlidingAnalysis(CamAnalysis):
    """A cam under a follower that slides along +y, its axis at ``x = offset``; at the level 0 at a ``start_height``."""

    @cached_property
    def travel(self) -> np.ndarray:
        """``s``, m."""
        return np.where(self.buildable, self.motion.s, np.nan)

    @property
    def start_height(self) -> Value:
        """Of the roller's centre, or of the face, above the cam axis at the level 0, m."""
        return self.cam.start_height

    @cached_property
    def height(self) -> np.ndarray:
        """``h``: of the roller's centre, or of the face, above the cam axis, m."""
        height: np.ndarray = self.start_height + self.travel
        return height

    @property
    def foot(self) -> np.ndarray:
        """The lower end of the follower on its axis, machine's frame, ``(2, n)``, m."""
        return vector(self.cam.offset, self.height)

    @property
    def cranks(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """The follower: the mouth of its guide ``(2,)`` and its foot ``(2, n)``, machine's frame, m."""
        return {"follower": (vector(self.cam.offset, self.bearing.mouth), self.foot)}

    @property
    def bearing(self) -> Guide:
        """The guide in which the follower slides."""
        cam, friction = self.cam, self.cam.friction
        mouth = self.start_height + top_level(cam.motion) + friction.overhang
        return Guide(cam.offset, mouth, friction.guide_length, self.velocity, friction.guide, cam.load.side_force)

    @property
    def inertia(self) -> Array:
        """Of the follower, kg."""
        return self.cam.load.mass

    @cached_property
    def static_resistance(self) -> np.ndarray:
        """Force along the travel besides inertia, N."""
        return self.cam.load.static_force(self.travel, self.cam_angle)

    @cached_property
    def resistance(self) -> np.ndarray:
        """Force along the travel that the cam has to overcome, N, positive against the rise."""
        return self.cam.load.resisting_force(self.travel, self.acceleration, self.cam_angle, self.velocity)

    @property
    def damping(self) -> Value:
        """Force over the follower's velocity, N s/m."""
        return self.cam.load.damping


class RockingAnalysis(CamAnalysis):
    """A cam under a follower on an arm of the ``arm_length`` about a pivot on the x axis at the ``centre_distance``."""

    acceleration_unit: ClassVar[str] = "1/rad"

    @property
    @abstractmethod
    def arm_angle(self) -> np.ndarray:
        """``psi``: the arm's angle from the line pivot -> cam axis, rad; ``nan`` where it cannot be built."""

    @property
    def bearing(self) -> Pivot:
        """The pivot about which the arm rocks."""
        return Pivot(self.cam.centre_distance, self.velocity, self.cam.friction.arm_pivot)

    @property
    def inertia(self) -> Array:
        """Of the arm about its pivot, kg m^2."""
        return self.cam.load.inertia(self.cam.arm_length)

    @cached_property
    def static_resistance(self) -> np.ndarray:
        """Torque about the arm's pivot besides inertia, N m."""
        return self.cam.load.static_torque(self.cam.arm_length, self.arm_angle, self.motion.s, self.cam_angle)

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """Torque about the arm's pivot that the cam has to overcome, N m, positive against a growing angle."""
        load, l, s = self.cam.load, self.cam.arm_length, self.motion.s
        return load.resisting_torque(l, self.arm_angle, s, self.acceleration, self.cam_angle, self.velocity)

    @property
    def resistance(self) -> np.ndarray:
        """The `resisting_torque`."""
        return self.resisting_torque

    @property
    def arm_force(self) -> Array:
        """Sum of the forces on the arm besides those of cam and pivot, its inertia among them, ``(2, n)``, N."""
        return self.cam.load.arm_force(self.cam.arm_length, self.arm_angle, self.velocity, self.acceleration)

    @property
    def damping(self) -> Value:
        """Torque over the arm's velocity, N m s/rad."""
        return self.cam.load.damping
