"""Disk cam with a flat face on a rocking arm.

As with a roller on an arm, the cam axis O is the origin, the arm's pivot A lies on the x axis at the centre distance
``a``, ``psi`` is the arm's angle at A from the line A -> O, and ``sigma = +1``: the cam turns counter-clockwise and
``psi`` grows against it.  The face is parallel to the arm, ``b`` from the pivot, ``b > 0`` away from the cam.  It
stands ``p = a sin psi + b`` from the cam axis; it is touched ``q = a cos psi / (1 + sigma v)`` along the arm from the
pivot; with the cam's normal turning by ``-sigma (1 + sigma v)`` per cam angle, ``rho = p + d2p/dtheta2`` is

    rho = b + a [(1 + sigma v)(1 + 2 sigma v) sin psi + w cos psi] / (1 + sigma v)^3

Source: derived here from the support function; Norton, Cam Design and Manufacturing Handbook, treats the follower.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..geometry import Body, Outline, vector
from ..motion import MotionProgram, motion_in
from ..quantities import choice, quantity, text_if
from ..quantities.kinds import a_number
from ..quantities.types import Array, Value
from ..units import deg, mm, rpm
from . import bodies
from .conjugate import opposite
from .directions import ROTATIONS
from .extremes import lowest
from .flat_analysis import OF_ROLLERS, FlatAnalysis
from .follower_measures import FLAT_CURVE, jump_margin
from .followers import DiskCam, RockingAnalysis, over_the_motion, rise_and_return
from .loads import ArmLoad, Friction
from .lubricated_pair import AnyContact, contact_choice
from .measures import ROCKING
from .shaking import MAKERS
from .sizing import if_possible, refuse_radius


def _closed() -> ArmLoad:
    return ArmLoad(mass=0.5, speed=300 * rpm, spring_rate=5, preload=2)


@dataclass(frozen=True)
class OscillatingFlatCam(DiskCam):
    """A disk cam that rocks an arm through a flat face.

    ``motion`` gives the arm's angle beyond ``start_angle``, which the arm has at the motion's level 0, wherever the
    motion begins.  ``rotation`` is ``sigma``: +1 where a growing arm angle goes against the cam's rotation, -1 where
    it goes with it.

    >>> cam = OscillatingFlatCam().analyse()
    >>> print(f"{cam.profile_margin.value / mm:.3f} mm")
    13.879 mm

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a face that would pass the cam axis,
    an arm that moves with the cam as fast as the cam, or one that is too short.
    """

    motion: MotionProgram = motion_in("deg", 12, 60, lambda: rise_and_return(12 * deg))
    centre_distance: float = quantity("a", 80, 40, 160, "mm", "cam axis to arm pivot")
    start_angle: float = quantity(
        "psi_0", 20, -30, 60, "deg", "arm's angle from the line of centres at the level 0", above=None
    )
    face_offset: float = quantity("b", 5, -20, 40, "mm", "face from the pivot, away from the cam", above=None)
    arm_length: float = quantity("l", 110, 30, 200, "mm", "arm pivot to the end of the face")
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")
    load: ArmLoad = field(default_factory=_closed)
    friction: Friction = field(default_factory=Friction)
    contact: AnyContact = contact_choice()

    name: ClassVar[str] = "rocking face"
    roller_radius: ClassVar[float] = 0.0
    """There is no roller."""

    def following(self) -> dict[str, str]:
        """No roller, no pin, no bearing."""
        return dict.fromkeys(OF_ROLLERS, "a flat face has no roller")

    @property
    def base_radius(self) -> Value:
        """``p_0 = a sin psi_0 + b``: cam axis to face at the motion's level 0, m."""
        return self.centre_distance * np.sin(self.start_angle) + self.face_offset

    def analyse(self, n: int = 721) -> OscillatingFlatAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(OscillatingFlatAnalysis, self, n)

    def face_offset_for(self, *, min_radius: Value) -> Value:
        """Least offset of the face with which no radius of curvature is below ``min_radius``, m.

        The offset makes the cam larger all around, `base_radius` and every radius of curvature alike.
        ``ValueError`` (``nan`` in a population) where the arm's speed drops at once: no offset keeps it there.

        >>> cam = OscillatingFlatCam()
        >>> wide = cam.replace(face_offset=cam.face_offset_for(min_radius=18 * mm))
        >>> print(f"{wide.face_offset / mm:.3f} mm, {wide.analyse().profile_margin.value / mm:.6f} mm")
        9.121 mm, 18.000000 mm
        """
        refuse_radius(min_radius)
        analysis = OscillatingFlatAnalysis(self, self.motion.resolution.angle)
        size = min_radius - lowest(analysis, lambda at: at.offset_free_radius).value
        return if_possible(size, analysis.corner(-1))

    def conjugate(self, spread: Value, face_offset: Value | None = None) -> OscillatingFlatCam:
        """The second cam of a pair: it carries a second face on the same arm, ``spread`` (rad) from the first.

        Given in the machine's frame mirrored in the line of centres, so its arm again stands above that line.
        """
        return self.replace(
            motion=opposite(self.motion),
            start_angle=a_number(spread, "the angle between the faces") - self.start_angle,
            face_offset=self.face_offset if face_offset is None else face_offset,
            rotation=-self.rotation,
            load=self.load.opposite(spread, 1.0, 1.0),
        )


@dataclass(frozen=True)
class OscillatingFlatAnalysis(RockingAnalysis, FlatAnalysis):
    """What follows from an `OscillatingFlatCam` at the given cam angles."""

    cam: OscillatingFlatCam

    @cached_property
    def _swing(self) -> Array:
        return self.cam.start_angle + self.motion.s

    @cached_property
    def _gain(self) -> np.ndarray:
        """``1 + sigma v``: arm motion as seen from the cam."""
        return 1 + self.cam.rotation * self.velocity

    @property
    def facing_rate(self) -> Value:
        """``1 + sigma v``."""
        return self._gain

    @cached_property
    def _contact_length(self) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.cam.centre_distance * np.cos(self._swing) / self._gain

    @cached_property
    def _face_distance(self) -> Array:
        return self.cam.centre_distance * np.sin(self._swing) + self.cam.face_offset

    @property
    def clear(self) -> Array:
        """Where the face is clear of the cam axis and long enough."""
        upright, slow = abs(self._swing) < np.pi / 2, self._gain > 0
        reached = upright & slow & (self._contact_length <= self.cam.arm_length)
        return reached & (self._face_distance > 0)

    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""
        low, high = np.degrees(self._swing.min()), np.degrees(self._swing.max())
        gain, distance = self._gain.min(), self._face_distance.min()
        short = (
            f"the face is touched up to {self._contact_length.max() / mm:.4g} mm from the arm's pivot; "
            f"the arm is {self.cam.arm_length / mm:.4g} mm long and must reach that far"
        )
        near = f"the face comes down to {distance / mm:.4g} mm from the cam axis; it must stay above 0 mm"
        fast = (
            f"the arm moves with the cam by {1 - gain:.4g} rad for each rad of cam angle; "
            "it must stay below 1, or the face is touched nowhere"
        )
        far = (
            f"the arm swings from {low:.4g} to {high:.4g} deg from the line of centres; "
            "it must stay between -90 and 90 deg"
        )
        slow = text_if(gain <= 0, fast, text_if(distance <= 0, near, short))
        return text_if((low <= -90) | (high >= 90), far, slow)

    @cached_property
    def arm_angle(self) -> np.ndarray:
        """``psi``: the arm's angle from the line pivot -> cam axis, rad."""
        return np.where(self.buildable, self._swing, np.nan)

    @cached_property
    def contact_length(self) -> np.ndarray:
        """``q``: from the pivot along the arm to where its face is touched, m."""
        return np.where(self.buildable, self._contact_length, np.nan)

    @cached_property
    def offset_free_radius(self) -> np.ndarray:
        """``rho - b``: radius of curvature that the cam would have without an offset of the face, m."""
        v, gain = self.cam.rotation * self.velocity, self._gain
        bent = gain * (1 + 2 * v) * np.sin(self._swing) + self.acceleration * np.cos(self._swing)
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.cam.centre_distance * bent / gain**3

    @cached_property
    def profile_radius(self) -> np.ndarray:
        """``rho``: radius of curvature of the cam, convex > 0, m."""
        return np.where(self.buildable, self.cam.face_offset + self.offset_free_radius, np.nan)

    @cached_property
    def pressure_angle(self) -> np.ndarray:
        """``alpha``, signed: ``tan alpha = b / q``, rad."""
        return np.arctan2(self.cam.face_offset, self.contact_length)

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal: square to the face, to the side of a growing arm angle."""
        return np.stack([np.sin(self.arm_angle), np.cos(self.arm_angle)])

    def _on_face(self, along: Array) -> np.ndarray:
        """Points of the face ``along`` the arm from the pivot, machine's frame, m."""
        sin, cos = self.normal
        b = self.cam.face_offset
        return np.stack([self.cam.centre_distance - along * cos + b * sin, along * sin + b * cos])

    def contact_point(self, flank: Value = 1) -> np.ndarray:
        """Where face and cam touch, machine's frame, m; ``nan`` for an outer flank."""
        return self._on_face(np.where(np.greater(flank, 0), self.contact_length, np.nan))

    @cached_property
    def face_reach(self) -> tuple[Value, Value]:
        """Where along the arm the face must begin and end: least and largest distance from the pivot, m."""
        return self.lowest(lambda at: at.contact_length).value, self.highest(lambda at: at.contact_length).value

    @property
    def face(self) -> np.ndarray:
        """Both ends of the narrowest face in the frame of the machine, ``(2, 2, ...)``: x, y of each end, m."""
        return np.stack([self._on_face(np.expand_dims(x, -1)) for x in self.face_reach], axis=1)

    @property
    def cranks(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """The arm: its pivot ``(2,)`` and where its face is touched ``(2, n)``, machine's frame, m."""
        return {"arm": (vector(self.cam.centre_distance, 0.0), self.contact_point())}

    @property
    def follower(self) -> tuple[Body, ...]:
        """The arm, cranked by the face's offset, with its face, as narrow as it may be."""
        length, offset, place = self.cam.arm_length, -self.cam.face_offset, {"x": self.cam.centre_distance}
        arm = np.stack([np.stack([0.0, 0.0, length]), np.stack([0.0, offset, offset])])
        face = np.stack([np.stack(self.face_reach), np.stack([offset, offset])])
        along = np.pi - self.arm_angle
        return (
            Outline("arm", "arm", arm, angle=along, **place),
            Outline("arm", "pivot", bodies.PIN, **place),
            Outline("arm", "face", face, angle=along, **place),
        )

    @property
    def lever(self) -> np.ndarray:
        """``q``, m."""
        return self.contact_length


OscillatingFlatCam.measures = (*FLAT_CURVE, jump_margin, *ROCKING)
OscillatingFlatCam.makers = MAKERS
