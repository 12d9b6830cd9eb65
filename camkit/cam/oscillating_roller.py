"""Disk cam with a roller on a rocking arm.

The cam axis O is the origin, the arm's pivot A lies on the x axis at the centre distance ``a``, the arm of
length ``l`` stands above it.  ``psi`` is the arm's angle at A from the line A -> O, so the roller's centre is
``(a - l cos psi, l sin psi)``.  ``sigma = +1``: the cam turns counter-clockwise and ``psi`` grows against it;
``sigma = -1``: the cam turns clockwise (or, the same thing, the crank is mirrored).

Formulas after Gong, Liu, He (2025), with the signs of their equation (14) put right, and checked against
brute-force geometry for both senses.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..geometry import Body, vector
from ..motion import MotionProgram, motion_in
from ..quantities import choice, quantity, text_if
from ..quantities.kinds import a_number
from ..quantities.types import Array, Value
from ..units import deg, mm
from . import bodies
from .conjugate import opposite
from .directions import CLOSURES, ROTATIONS
from .followers import DiskCam, RockingAnalysis, over_the_motion, rise_and_return
from .loads import ArmLoad, Contact, Friction
from .lubricated_pair import AnyContact, contact_choice
from .measures import ARM_CURVE, ROCKING
from .roller_analysis import RollerAnalysis
from .shaking import MAKERS


@dataclass(frozen=True)
class OscillatingRollerCam(DiskCam):
    """A disk cam that rocks an arm through a roller, as a plate (inner flank) or a groove (both flanks).

    ``motion`` gives the arm's angle beyond ``start_angle``, which the arm has at the motion's level 0, wherever the
    motion begins.  ``rotation`` is ``sigma``: +1 where a growing arm angle goes against the cam's rotation, -1 where
    it goes with it.

    >>> cam = OscillatingRollerCam(centre_distance=120*mm, arm_length=80*mm, start_angle=30*deg)
    >>> print(f"{np.degrees(cam.analyse(721).pressure_angle[0]):.4f} deg")
    -21.7380 deg

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for an arm that would have to pass
    the line of centres or a roller that would cover the cam axis.
    """

    motion: MotionProgram = motion_in("deg", 30, 90, lambda: rise_and_return(30 * deg))
    centre_distance: float = quantity("a", 80, 40, 160, "mm", "cam axis to arm pivot")
    arm_length: float = quantity("l", 60, 20, 120, "mm", "arm pivot to roller centre")
    start_angle: float = quantity("psi_0", 25, 5, 90, "deg", "arm's angle from the line of centres at the level 0")
    roller_radius: float = quantity("r_T", 5, 0, 40, "mm", "roller; 0 is a knife edge", at_least=0)
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")
    load: ArmLoad = field(default_factory=ArmLoad)
    friction: Friction = field(default_factory=Friction)
    groove: bool = choice("g", True, CLOSURES, "what guides the roller: a groove, or a plate and a spring or weight")
    """Whether the roller runs in a groove, or (``False``) on a plate to which a spring or a weight holds it."""
    contact: AnyContact = contact_choice()

    name: ClassVar[str] = "rocking roller"

    def analyse(self, n: int = 721) -> OscillatingRollerAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(OscillatingRollerAnalysis, self, n)

    def conjugate(
        self, spread: Value, arm_length: Value | None = None, roller_radius: Value | None = None
    ) -> OscillatingRollerCam:
        """The second cam of a pair: it carries a second roller on the same shaft, ``spread`` (rad) from the first.

        Given in the machine's frame mirrored in the line of centres, so its arm again stands above that line.
        """
        spread = a_number(spread, "the angle between the arms")
        must = "be a finite number above 0"
        l = a_number(self.arm_length if arm_length is None else arm_length, "the second arm", must, lambda l: l > 0)
        return self.replace(
            motion=opposite(self.motion),
            arm_length=l,
            start_angle=spread - self.start_angle,
            roller_radius=self.roller_radius if roller_radius is None else roller_radius,
            rotation=-self.rotation,
            load=self.load.opposite(spread, self.arm_length, l),
        )


@dataclass(frozen=True)
class OscillatingRollerAnalysis(RockingAnalysis, RollerAnalysis):
    """What follows from an `OscillatingRollerCam` at the given cam angles."""

    cam: OscillatingRollerCam

    @property
    def clear(self) -> Value:
        """Whether the arm is clear of the line of centres and the roller of the axis, ``(..., 1)``."""
        psi = self.cam.start_angle + self.motion.s
        low, high = psi.min(-1, keepdims=True), psi.max(-1, keepdims=True)  # nearest to the axis at the low end
        return (low > 0) & (high < np.pi) & (self._pitch_radius(low) > self.cam.roller_radius)

    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""
        psi = self.cam.start_angle + self.motion.s
        low, high = psi.min(), psi.max()
        return text_if(
            (low <= 0) | (high >= np.pi),
            f"the arm swings from {np.degrees(low):.4g} to {np.degrees(high):.4g} deg from the line "
            "of centres; it must stay between 0 and 180 deg",
            f"the roller of radius {self.cam.roller_radius / mm:.4g} mm comes within "
            f"{self._pitch_radius(psi).min() / mm:.4g} mm of the cam axis; it must stay outside it",
        )

    def _pitch_radius(self, psi: Value) -> Array:
        a, l = self.cam.centre_distance, self.cam.arm_length
        return np.sqrt(a**2 + l**2 - 2 * a * l * np.cos(psi))

    @cached_property
    def arm_angle(self) -> np.ndarray:
        """``psi``: the arm's angle from the line pivot -> cam axis, rad."""
        return np.where(self.buildable, self.cam.start_angle + self.motion.s, np.nan)

    @property
    def cranks(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Every rocking arm by its name: its pivot ``(2,)`` and its roller's centre ``(2, n)``, machine's frame, m."""
        return {"arm": (vector(self.cam.centre_distance, 0.0), self.roller_centre)}

    @property
    def follower(self) -> tuple[Body, ...]:
        """The arm with its roller."""
        ((name, (pivot, centre)),) = self.cranks.items()
        return *bodies.rocker(name, pivot, centre), bodies.roller(name, centre, self.cam.roller_radius)

    @cached_property
    def pitch_radius(self) -> np.ndarray:
        """``R``: cam axis to roller centre, m."""
        return self._pitch_radius(self.arm_angle)

    @cached_property
    def _gain(self) -> np.ndarray:
        """``1 + sigma v``: arm motion as seen from the cam."""
        return 1 + self.cam.rotation * self.velocity

    @cached_property
    def _cos(self) -> np.ndarray:
        return np.cos(self.arm_angle)

    @cached_property
    def _sin(self) -> np.ndarray:
        return np.sin(self.arm_angle)

    @cached_property
    def _along(self) -> np.ndarray:
        """``G``: the contact normal's component along the arm."""
        return self.cam.arm_length * self._gain - self.cam.centre_distance * self._cos

    @cached_property
    def _across(self) -> np.ndarray:
        """``D``: the contact normal's component across the arm."""
        return self.cam.centre_distance * self._sin

    @cached_property
    def _size(self) -> np.ndarray:
        """``sqrt(G^2 + D^2)``: the length of that normal."""
        return np.sqrt(self._along * self._along + self._across * self._across)

    @cached_property
    def pressure_angle(self) -> np.ndarray:
        """``alpha``, signed: ``tan alpha = G / D``, rad."""
        return np.arctan2(self._along, self._across)

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature of the pitch curve, convex > 0, 1/m."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        gain, w, size = self._gain, self.acceleration, self._size
        top = a**2 + l**2 * gain * gain * gain - a * l * gain * (1 + gain) * self._cos - w * a * l * self._sin
        return top / (size * size * size)

    @cached_property
    def roller_centre(self) -> np.ndarray:
        """The roller's centre in the frame of the machine, m."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        return vector(a - l * self._cos, l * self._sin)

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal, a unit vector from cam to roller in the frame of the machine."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        direction = vector(a - l * self._gain * self._cos, l * self._gain * self._sin)
        return direction / self._size

    @property
    def lever(self) -> np.ndarray:
        """``l cos alpha``, m: ``cos alpha = D / sqrt(G^2 + D^2)``."""
        return self.cam.arm_length * self._across / self._size

    @cached_property
    def _contact(self) -> Contact:
        a, l = self.cam.centre_distance, self.cam.arm_length
        alpha, v = self.pressure_angle, self.velocity
        offset = l * self.cam.rotation * v * np.cos(alpha)
        reach = a * self._sin * np.cos(alpha) + (l - a * self._cos) * np.sin(alpha)
        return Contact(l, self.cam.roller_radius, self.cam.rotation, v, alpha, offset, reach)

    @cached_property
    def published_efficiency(self) -> np.ndarray:
        """Power out over power in against a resisting torque, as published: cautious at the roller."""
        return self.cam.friction.published_efficiency(self._contact)


OscillatingRollerCam.measures = (*ARM_CURVE, *ROCKING)
OscillatingRollerCam.makers = MAKERS
