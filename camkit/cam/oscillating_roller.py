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
from typing import Any

import numpy as np

from ..geometry import offset_curvature, rotated
from ..motion import Cycloidal, Dwell, Kinematics, MotionProgram, Return, Rise
from ..quantities import Design, fails, quantity
from ..units import deg, mm
from .load import ArmLoad, Contact, Friction
from .measures import CURVE


def _rise_and_return() -> MotionProgram:
    law = Cycloidal()
    return MotionProgram(
        (Rise(120 * deg, 30 * deg, law), Dwell(60 * deg), Return(120 * deg, 30 * deg, law), Dwell(60 * deg))
    )


@dataclass(frozen=True)
class OscillatingRollerCam(Design):
    """A disk cam that rocks an arm through a roller, as a plate (inner flank) or a groove (both flanks).

    ``motion`` gives the arm's angle beyond ``start_angle``; ``rotation`` is ``sigma``: +1 where a growing arm
    angle goes against the cam's rotation, -1 where it goes with it.

    >>> cam = OscillatingRollerCam(centre_distance=120*mm, arm_length=80*mm, start_angle=30*deg)
    >>> print(f"{np.degrees(cam.analyse(721).pressure_angle[0]):.4f} deg")
    -21.7380 deg

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for an arm that would have to pass
    the line of centres or a roller that would cover the cam axis.
    """

    motion: MotionProgram = field(default_factory=_rise_and_return)
    centre_distance: float = quantity("a", 80, 40, 160, "mm", "cam axis to arm pivot")
    arm_length: float = quantity("l", 60, 20, 120, "mm", "arm pivot to roller centre")
    start_angle: float = quantity("psi_0", 25, 5, 90, "deg", "arm's angle from the line of centres at the start")
    roller_radius: float = quantity("r_T", 5, 0, 40, "mm", "roller; 0 is a knife edge", at_least=0)
    rotation: int = 1
    load: ArmLoad = field(default_factory=ArmLoad)
    friction: Friction = field(default_factory=Friction)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.rotation not in (1, -1):
            raise ValueError(f"the rotation is {self.rotation!r}; it must be +1 or -1")

    def analyse(self, n: int = 721) -> OscillatingRollerAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        turn = np.linspace(0, 1, n) * self.motion.span
        analysis = OscillatingRollerAnalysis(self, turn)
        analysis.refuse_impossible()
        return analysis


@dataclass(frozen=True)
class OscillatingRollerAnalysis:
    """What follows from an `OscillatingRollerCam` at the given cam angles.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``; points ``(2, n)`` and ``(2, p, n)``.  Each is
    computed when first asked for.  ``nan`` where a member of a population cannot be built.
    """

    cam: OscillatingRollerCam
    cam_angle: np.ndarray

    @cached_property
    def motion(self) -> Kinematics:
        """The arm's travel and its derivatives with respect to the cam angle, ``s, v, a, j`` (rad)."""
        return self.cam.motion(self.cam_angle)

    @cached_property
    def buildable(self) -> Any:
        """Whether the design can be built, ``(..., 1)``: arm clear of the line of centres, roller of the axis."""
        psi = self.cam.start_angle + self.motion.s
        clear = (psi > 0) & (psi < np.pi) & (self._pitch_radius(psi) > self.cam.roller_radius)
        return clear.all(-1, keepdims=True)

    def refuse_impossible(self) -> None:
        """``ValueError`` in a sentence if this is one design and it cannot be built."""
        if not fails(self.buildable[..., 0]):
            return
        psi = self.cam.start_angle + self.motion.s
        if psi.min() <= 0 or psi.max() >= np.pi:
            raise ValueError(
                f"the arm swings from {np.degrees(psi.min()):.4g} to {np.degrees(psi.max()):.4g} deg from the line "
                "of centres; it must stay between 0 and 180 deg"
            )
        raise ValueError(
            f"the roller of radius {self.cam.roller_radius / mm:.4g} mm comes within "
            f"{self._pitch_radius(psi).min() / mm:.4g} mm of the cam axis; it must stay outside it"
        )

    def _pitch_radius(self, psi: Any) -> Any:
        a, l = self.cam.centre_distance, self.cam.arm_length
        return np.sqrt(a**2 + l**2 - 2 * a * l * np.cos(psi))

    @cached_property
    def arm_angle(self) -> np.ndarray:
        """``psi``: the arm's angle from the line pivot -> cam axis, rad."""
        return np.where(self.buildable, self.cam.start_angle + self.motion.s, np.nan)

    @property
    def curves(self) -> dict[str, OscillatingRollerAnalysis]:
        """Every cam curve of the machine by its name: this one."""
        return {"cam": self}

    @property
    def stretch(self) -> np.ndarray:
        """The name of the stretch of the profile to which each point belongs."""
        return np.full(self.cam_angle.shape[-1], "cam")

    @property
    def profile_angle(self) -> np.ndarray:
        """The cam angle at which the roller touches each point of the profile, rad."""
        return self.cam_angle

    @property
    def cranks(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Every rocking arm by its name: its pivot ``(2,)`` and its roller's centre ``(2, n)``, machine's frame, m."""
        return {"arm": (np.array([self.cam.centre_distance, 0.0]), self.roller_centre)}

    @property
    def turn(self) -> np.ndarray:
        """How far the cam has turned counter-clockwise at each cam angle, rad."""
        return self.cam.rotation * self.cam_angle

    @property
    def velocity(self) -> np.ndarray:
        """``v = dpsi/dphi``."""
        return self.motion.v

    @property
    def acceleration(self) -> np.ndarray:
        """``w = d2psi/dphi2``, 1/rad."""
        return self.motion.a

    @property
    def jerk(self) -> np.ndarray:
        """``d3psi/dphi3``, 1/rad^2."""
        return self.motion.j

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
    def pressure_angle(self) -> np.ndarray:
        """``alpha``, signed: ``tan alpha = G / D``, rad."""
        return np.arctan2(self._along, self._across)

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature of the pitch curve, convex > 0, 1/m."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        gain, w = self._gain, self.acceleration
        top = a**2 + l**2 * gain**3 - a * l * gain * (1 + gain) * self._cos - w * a * l * self._sin
        return top / (self._along**2 + self._across**2) ** 1.5

    @cached_property
    def profile_curvature(self) -> np.ndarray:
        """Curvature of the inner flank (the plate cam), convex > 0, 1/m."""
        return offset_curvature(self.curvature, -self.cam.roller_radius)

    @cached_property
    def outer_profile_curvature(self) -> np.ndarray:
        """Curvature of a groove's outer flank, convex seen from the cam axis > 0, 1/m."""
        return offset_curvature(self.curvature, self.cam.roller_radius)

    @cached_property
    def undercut(self) -> np.ndarray:
        """Where the roller would cut away the inner flank: ``r_T kappa >= 1``."""
        return self.cam.roller_radius * self.curvature >= 1

    @cached_property
    def outer_undercut(self) -> np.ndarray:
        """Where the roller would cut away a groove's outer flank: ``-r_T kappa >= 1``."""
        return -self.cam.roller_radius * self.curvature >= 1

    @cached_property
    def roller_centre(self) -> np.ndarray:
        """The roller's centre in the frame of the machine, m."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        return np.stack(np.broadcast_arrays(a - l * self._cos, l * self._sin))

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal, a unit vector from cam to roller in the frame of the machine."""
        a, l = self.cam.centre_distance, self.cam.arm_length
        direction = np.stack(np.broadcast_arrays(a - l * self._gain * self._cos, l * self._gain * self._sin))
        return direction / np.sqrt(self._along**2 + self._across**2)

    def on_cam(self, points: np.ndarray) -> np.ndarray:
        """Points of the machine's frame as they lie on the cam at each cam angle."""
        return rotated(points, -self.turn)

    @cached_property
    def pitch(self) -> np.ndarray:
        """Pitch curve: the roller's centre as the cam sees it, m."""
        return self.on_cam(self.roller_centre)

    @cached_property
    def profile(self) -> np.ndarray:
        """Inner flank, the profile of a plate cam, m."""
        return self.on_cam(self.roller_centre - self.cam.roller_radius * self.normal)

    @cached_property
    def outer_profile(self) -> np.ndarray:
        """Outer flank of a groove cam, m."""
        return self.on_cam(self.roller_centre + self.cam.roller_radius * self.normal)

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """Torque about the arm's pivot that the cam has to overcome, N m, positive against a growing angle."""
        return self.cam.load.resisting_torque(self.cam.arm_length, self.arm_angle, self.motion.s, self.acceleration)

    @cached_property
    def contact_force(self) -> np.ndarray:
        """Force between cam and roller without friction, N; < 0 where only a groove's outer flank can give it."""
        return self.resisting_torque / (self.cam.arm_length * np.cos(self.pressure_angle))

    @cached_property
    def cam_torque(self) -> np.ndarray:
        """Torque on the cam without friction, N m: power in = power out."""
        return self.resisting_torque * self.velocity

    @cached_property
    def _contact(self) -> Contact:
        a, l = self.cam.centre_distance, self.cam.arm_length
        alpha, v = self.pressure_angle, self.velocity
        offset = l * self.cam.rotation * v * np.cos(alpha)
        reach = a * self._sin * np.cos(alpha) + (l - a * self._cos) * np.sin(alpha)
        return Contact(l, self.cam.roller_radius, self.cam.rotation, v, alpha, offset, reach)

    @cached_property
    def efficiency(self) -> np.ndarray:
        """Power out over power in against a resisting torque, as published: cautious at the roller."""
        return self.cam.friction.published_efficiency(self._contact)

    @cached_property
    def free_body_efficiency(self) -> np.ndarray:
        """Power out over power in against a resisting torque, from the free-body diagram."""
        return self.cam.friction.free_body_efficiency(self._contact)


OscillatingRollerCam.measures = CURVE
