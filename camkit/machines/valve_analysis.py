"""What follows from a valve cam: its lift in time, the paper's measures, radii, forces, contact and the lift table.

Under either follower it is a cam of the family with the offset 0 (see `camkit.cam.translating_flat` and
`camkit.cam.translating_roller`): what is not said here is said there.  Of the forces only those of the open valve
reach the cam, and extremes are those of the opening flank, which the closing one mirrors.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from ..cam.analysis import CamAnalysis
from ..cam.measures import number, radius_of
from ..cam.translating_flat import TranslatingFlatAnalysis, TranslatingFlatCam
from ..cam.translating_roller import TranslatingRollerAnalysis, TranslatingRollerCam
from ..contact import LineContact, line_contact
from ..geometry import Body, Disc, Outline
from ..motion import Kinematics, MotionProgram
from ..motion.resolution import STEPS
from ..quantities import refuse_population, unremarked
from ..quantities.types import Array, Value
from ..units import deg, mm

OFFERS = (
    "whole",
    "lift",
    "velocity",
    "acceleration",
    "jerk",
    "profile_radius",
    "spring_force",
    "contact_stress",
    "resistance",
)
ROUNDING = 1e-12
"""A lift this little (m) below 0 is the start of the flank."""


@dataclass(frozen=True)
class ValveAnalysis(CamAnalysis):
    """What follows from a `ValveCam` at the given cam angles, counted from the start of the opening flank."""

    @property
    def offers(self) -> tuple[str, ...]:
        """The shapes and curves that are shown of it where nobody chooses, in this order."""
        return (*OFFERS, *getattr(self.cam.contact, "more", ()))

    @property
    def program(self) -> MotionProgram:
        """The opening flank alone."""
        program: MotionProgram = self.cam.opening
        return program

    def steps(self) -> int:
        """As many for a rough look: the acceleration of a full lift has its peak within a few degrees."""
        return STEPS

    @cached_property
    def whole(self) -> Self:
        """The whole cam at as many angles, from half a turn before the nose to half a turn after it."""
        turn = np.linspace(-np.pi, np.pi, self.cam_angle.shape[-1])
        whole: Self = self.at(turn + self.cam.half_angle)
        return whole

    @cached_property
    def event(self) -> Self:
        """From the start of the opening ramp to the end of the closing one, at twice as many angles."""
        half = self.cam.half_angle + self.cam.ramp_angle
        around = np.linspace(-1, 1, 2 * self.cam_angle.shape[-1] - 1)
        event: Self = self.at(self.cam.half_angle + half * around)
        return event

    @property
    @abstractmethod
    def family(self) -> TranslatingFlatCam | TranslatingRollerCam:
        """The opening flank as a disk cam of the family."""

    def base_radius_for(self, min_radius: float) -> Value:
        """Least base radius from which on the cam has no convex radius of curvature below ``min_radius``, m."""
        return self.family.base_radius_for(min_radius=min_radius)

    @property
    def flat(self) -> FlatValveAnalysis:
        """The same under a flat face, whichever follower is chosen."""
        return FlatValveAnalysis(self.cam, self.cam_angle)

    @property
    def roller(self) -> RollerValveAnalysis:
        """The same under the roller, whichever follower is chosen."""
        return RollerValveAnalysis(self.cam, self.cam_angle)

    @property
    def turn_range(self) -> np.ndarray:
        """Cam angles between which the cam turns once, the nose in the middle, rad."""
        return self.cam.half_angle + np.array([-np.pi, np.pi])

    @property
    def coefficients(self) -> np.ndarray:
        """``C_p, C_q, C_r, C_s``, m."""
        return np.stack([number(c * self.cam.max_lift) for c in self.cam.flank.coefficients])

    @property
    def exponents(self) -> np.ndarray:
        """``p, q, r, s``."""
        return np.stack([number(e) for e in self.cam.flank.exponents])

    @property
    def lift(self) -> np.ndarray:
        """``h``: from the start of the flank, m; negative on ramp and base circle."""
        return self.motion.s

    @cached_property
    def in_time(self) -> Kinematics:
        """Lift, velocity, acceleration, jerk by time at the camshaft's speed: m, m/s, m/s^2, m/s^3."""
        return Kinematics(*(x * self.cam.load.speed**k for k, x in enumerate(self.motion)))

    @cached_property
    def fullness(self) -> Array:
        """``xi = 1 + sum C_i / (1 + e_i) / C_0``: mean lift of a flank over the lift at the nose."""
        return 1 + (self.coefficients / (1 + self.exponents)).sum(0) / number(self.cam.max_lift)

    @cached_property
    def _nose_curve(self) -> Array:
        """``h''`` at the nose, ``2 C_p / alpha_B^2``, m/rad^2."""
        return 2 * self.coefficients[0] / number(self.cam.half_angle) ** 2

    @cached_property
    def nose_acceleration(self) -> Array:
        """Of the follower at the nose, m/s^2, negative."""
        return self._nose_curve * number(self.cam.load.speed) ** 2

    @cached_property
    def peak_acceleration(self) -> Value:
        """Largest acceleration of the opening follower, anywhere on the flank, m/s^2."""
        return self.highest(_acceleration).value * number(self.cam.load.speed) ** 2

    @cached_property
    def nose_radius(self) -> Array:
        """Radius of curvature at the nose under a flat follower, ``r_0 + h + h''``, m."""
        return number(self.cam.base_radius) + number(self.cam.max_lift) + self._nose_curve

    @cached_property
    def stretch(self) -> np.ndarray:
        """Which part of the cam each point belongs to, in words."""
        from_nose = abs(self.cam_angle - self.cam.half_angle)
        on_flank, on_ramp = from_nose <= self.cam.half_angle, from_nose <= self.cam.half_angle + self.cam.ramp_angle
        side = np.where(self.cam_angle <= self.cam.half_angle, "opening ", "closing ")
        part = np.where(on_flank, "flank", "ramp")
        return np.where(on_ramp, np.char.add(side, part), "base circle")

    @property
    def is_open(self) -> np.ndarray:
        """Where the cam holds the valve open; on ramp and base circle the lash is open instead."""
        return self.lift >= -ROUNDING

    def force_at(self, speed: Value) -> np.ndarray:
        """Force between cam and follower along the line of travel with the camshaft at ``speed``, N.

        0 where the valve is shut; negative where the follower would have to be pulled: there it jumps.
        """
        return np.where(self.is_open, self.spring_force - self.needed_at(speed), 0 * self.lift)

    def needed_at(self, speed: Value) -> np.ndarray:
        """Spring force that keeps the train on the cam at ``speed``, N; negative where the cam lifts it anyway."""
        return np.where(self.is_open, -self.cam.load.mass * speed**2 * self.acceleration, 0 * self.lift)

    @cached_property
    def spring_force(self) -> np.ndarray:
        """Force of the valve spring, N."""
        force: np.ndarray = self.cam.load.static_force(np.maximum(self.lift, 0))
        return force

    @property
    def other_force(self) -> Array:
        """What resists the lift besides spring and inertia, N: it helps to hold the follower."""
        return self.cam.load.replace(spring_rate=0.0, preload=0.0).static_force(self.lift)

    @cached_property
    def resistance(self) -> np.ndarray:
        """Force between cam and follower along the line of travel, N."""
        return self.force_at(self.cam.load.speed)

    @cached_property
    def contact(self) -> LineContact:
        """Pressure, half width and shear at the contact; ``nan`` where the cam is undercut."""
        pair = self.cam.contact  # there is none where the follower would have to be pulled
        return line_contact(np.maximum(self.contact_force, 0) / pair.width, self.fit, pair.modulus)

    @property
    def contact_stress(self) -> np.ndarray:
        """``p_0``: largest pressure between cam and follower, Pa."""
        return self.contact.pressure

    @property
    def top_speed(self) -> Array:
        """Speed of the camshaft with the speed margin, rad/s."""
        return self.cam.load.speed * (1 + self.cam.speed_margin)

    @property
    def tables(self) -> dict[str, dict[str, np.ndarray]]:
        """What a workshop asks for, by its name: columns by heading."""
        return {"Lift table": self.lift_table}

    @cached_property
    def lift_table(self) -> dict[str, np.ndarray]:
        """The whole cam every degree from the nose, -180 .. 179: columns by heading, in the units they name.

        The lift counts from the base circle.
        """
        angle = np.arange(-180, 180) * deg
        at: Any = self.at(angle + self.cam.half_angle)
        return {
            "cam angle [deg]": angle / deg,
            "lift [mm]": (at.lift + self.cam.ramp_height) / mm,
            "velocity [mm/rad]": at.velocity / mm,
            "acceleration [mm/rad^2]": at.acceleration / mm,
            "profile radius [mm]": at.profile_radius / mm,
        }


def _acceleration(analysis: CamAnalysis) -> Array:
    return analysis.acceleration


def _stem(analysis: ValveAnalysis, foot: Value) -> Outline:
    """The follower's stem, which begins ``foot`` above the cam."""
    refuse_population(analysis, "what is drawn")
    cam, points = analysis.cam, np.stack([np.zeros(2), np.append(0.0, 1.6 * analysis.cam.max_lift + foot)])
    return Outline("follower", "arm", points, x=0.0, y=cam.base_radius + analysis.lift + foot)


@dataclass(frozen=True)
class FlatValveAnalysis(ValveAnalysis, TranslatingFlatAnalysis):
    """What follows from a valve cam under a flat face."""

    cam: Any

    @property
    def start_height(self) -> Value:
        """Of the face where the flank begins, m: a roller has no part in it."""
        return self.cam.base_radius

    @property
    def pitch(self) -> np.ndarray:
        """``nan``: there is no roller."""
        return np.nan * self.profile

    @property
    def min_concave_radius(self) -> Array:
        """``inf``: the profile is hollow nowhere."""
        return np.inf + 0 * self.fullness

    @property
    def family(self) -> TranslatingFlatCam:
        """The disk cam that lifts the face over the opening flank."""
        with unremarked():
            return TranslatingFlatCam(self.program, self.cam.base_radius)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The follower of one design: face and stem."""
        stem, wide = _stem(self, 0.0), 1.15 * abs(self.velocity).max()
        return Outline("follower", "face", np.stack([np.stack([-wide, wide]), np.zeros(2)]), x=stem.x, y=stem.y), stem


@dataclass(frozen=True)
class RollerValveAnalysis(ValveAnalysis, TranslatingRollerAnalysis):
    """What follows from a valve cam under a roller."""

    cam: Any

    @property
    def profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam, convex > 0, m; ``inf`` where it turns hollow."""
        with np.errstate(divide="ignore"):
            return 1 / self.curvature - self.cam.roller_radius

    @property
    def min_concave_radius(self) -> Value:
        """Least radius of the hollow flank, m: a grinding wheel must be smaller; ``inf`` if none is hollow."""
        return radius_of(self.sharpest(-1).value) + number(self.cam.roller_radius)

    @property
    def family(self) -> TranslatingRollerCam:
        """The disk cam that lifts the roller over the opening flank."""
        with unremarked():
            return TranslatingRollerCam(self.program, self.cam.base_radius, self.cam.roller_radius, groove=False)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The follower of one design: roller and stem."""
        stem = _stem(self, self.cam.roller_radius)
        return Disc("follower", "roller", self.cam.roller_radius, x=stem.x, y=stem.y), stem
