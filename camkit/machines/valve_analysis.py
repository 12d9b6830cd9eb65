"""What follows from a valve cam: its lift in time, the paper's measures, radii, forces, contact and the lift table.

Under either follower it is a cam of the family with the offset 0 (see `camkit.cam.translating_flat` and
`camkit.cam.translating_roller`); of the forces only those of the open valve reach the cam.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..cam.force_closure import jump_speed, preload_needed
from ..cam.measures import radius_of
from ..contact import LineContact, line_contact
from ..extrema import Extreme
from ..geometry import Body, Disc, Outline
from ..motion import Kinematics
from ..units import deg, mm
from .valve_train import FLAT, ROLLER

if TYPE_CHECKING:
    from .valve_cam import ValveCam

ROUNDING = 1e-12
"""A lift this little (m) below 0 is the start of the flank."""


@dataclass(frozen=True)
class ValveAnalysis:
    """What follows from a `ValveCam` at the given cam angles, counted from the start of the opening flank.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``; points ``(2, n)`` and ``(2, p, n)``; numbers of
    the cam as a whole are one or ``(p,)``.  Derivatives are by cam angle.  ``nan`` where a member of a population
    cannot be built.
    """

    offers: ClassVar[tuple[str, ...]] = (
        "whole",
        "lift",
        "velocity",
        "acceleration",
        "jerk",
        "flat_radius",
        "spring_force",
        "contact_stress",
        "follower_force",
    )
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    cam: ValveCam
    cam_angle: np.ndarray

    @cached_property
    def whole(self) -> ValveAnalysis:
        """The whole cam at as many angles, from half a turn before the nose to half a turn after it."""
        turn = np.linspace(-np.pi, np.pi, self.cam_angle.shape[-1])
        return ValveAnalysis(self.cam, turn + self.cam.half_angle)

    @cached_property
    def event(self) -> ValveAnalysis:
        """From the start of the opening ramp to the end of the closing one, at twice as many angles."""
        half = self.cam.half_angle + self.cam.ramp_angle
        around = np.linspace(-1, 1, 2 * self.cam_angle.shape[-1] - 1)
        return ValveAnalysis(self.cam, self.cam.half_angle + half * around)

    @property
    def turn_range(self) -> np.ndarray:
        """Cam angles between which the cam turns once, the nose in the middle, rad."""
        return self.cam.half_angle + np.array([-np.pi, np.pi])

    @property
    def turn(self) -> np.ndarray:
        """How far the cam has turned counter-clockwise at each cam angle, rad."""
        return self.cam_angle

    @property
    def coefficients(self) -> np.ndarray:
        """``C_p, C_q, C_r, C_s``, m."""
        return np.stack([_number(c * self.cam.max_lift) for c in self.cam.flank.coefficients])

    @property
    def exponents(self) -> np.ndarray:
        """``p, q, r, s``."""
        return np.stack([_number(e) for e in self.cam.flank.exponents])

    @cached_property
    def motion(self) -> Kinematics:
        """Lift and its derivatives, ``s, v, a, j``."""
        return self.cam.motion(self.cam_angle)

    @property
    def lift(self) -> np.ndarray:
        """``h``: from the start of the flank, m; negative on ramp and base circle."""
        return self.motion.s

    @property
    def velocity(self) -> np.ndarray:
        """``h'``, m/rad."""
        return self.motion.v

    @property
    def acceleration(self) -> np.ndarray:
        """``h''``, m/rad^2."""
        return self.motion.a

    @property
    def jerk(self) -> np.ndarray:
        """``h'''``, m/rad^3."""
        return self.motion.j

    @cached_property
    def in_time(self) -> Kinematics:
        """Lift, velocity, acceleration, jerk by time at the camshaft's speed: m, m/s, m/s^2, m/s^3."""
        return Kinematics(*(x * self.cam.speed**k for k, x in enumerate(self.motion)))

    @cached_property
    def fullness(self) -> Any:
        """``xi = 1 + sum C_i / (1 + e_i) / C_0``: mean lift of a flank over the lift at the nose."""
        return 1 + (self.coefficients / (1 + self.exponents)).sum(0) / _number(self.cam.max_lift)

    @cached_property
    def _nose_curve(self) -> Any:
        """``h''`` at the nose, ``2 C_p / alpha_B^2``, m/rad^2."""
        return 2 * self.coefficients[0] / _number(self.cam.half_angle) ** 2

    @cached_property
    def nose_acceleration(self) -> Any:
        """Of the follower at the nose, m/s^2, negative."""
        return self._nose_curve * _number(self.cam.speed) ** 2

    @cached_property
    def peak_acceleration(self) -> Any:
        """Largest acceleration of the opening follower, anywhere on the flank, m/s^2."""
        return self.opening.highest(_acceleration).value * _number(self.cam.speed) ** 2

    @cached_property
    def nose_radius(self) -> Any:
        """Radius of curvature at the nose under a flat follower, ``r_0 + h + h''``, m."""
        return _number(self.cam.base_radius) + _number(self.cam.max_lift) + self._nose_curve

    @property
    def opening(self) -> Any:
        """The opening flank under the chosen follower, a cam of the family, at angles that show its extremes."""
        return self.cam.opening

    @property
    def min_radius(self) -> Any:
        """Least convex radius of curvature of the cam under the chosen follower, m; below 0 it is undercut."""
        return self.opening.profile_margin.value

    @property
    def min_radius_angle(self) -> Any:
        """Cam angle of the `min_radius`, rad."""
        return self.opening.profile_margin.cam_angle

    @property
    def min_concave_radius(self) -> Any:
        """Least radius of the hollow flank under a roller, m: a grinding wheel must be smaller; ``inf`` if none is."""
        if self.cam.follower == FLAT:
            return np.inf + 0 * self.fullness
        return radius_of(self.opening.sharpest(-1).value) + _number(self.cam.roller_radius)

    def base_radius_for(self, min_radius: float) -> Any:
        """Least base radius from which on the cam keeps the given `min_radius`, m."""
        return self.opening.cam.base_radius_for(min_radius=min_radius)

    def highest(self, f: Callable[[Any], Any]) -> Extreme:
        """The largest value of ``f(analysis)`` over the opening flank, whichever cam angles the analysis has."""
        return self.opening.highest(f)

    def lowest(self, f: Callable[[Any], Any]) -> Extreme:
        """As `highest`, for the least value."""
        return self.opening.lowest(f)

    def _under(self, follower: Any) -> Any:
        """The disk cam under ``follower`` at the same cam angles."""
        curve = follower.analysis(follower.on(self.cam, self.cam.motion), self.cam_angle)
        known = {"motion": self.motion, "buildable": np.atleast_1d(self.cam.buildable)}
        curve.__dict__.update(known)  # cached properties
        return curve

    @cached_property
    def flat(self) -> Any:
        """The cam under a flat face, whichever follower is chosen."""
        return self._under(FLAT)

    @cached_property
    def roller(self) -> Any:
        """The cam under the roller, whichever follower is chosen."""
        return self._under(ROLLER)

    @property
    def curve(self) -> Any:
        """The cam under the chosen follower."""
        return self.flat if self.cam.follower == FLAT else self.roller

    @property
    def flat_radius(self) -> np.ndarray:
        """Radius of curvature of the cam for a flat follower, ``rho = r_0 + h + h''``, m."""
        return self.flat.profile_radius

    @property
    def curvature(self) -> np.ndarray:
        """Curvature of a roller centre's path on the cam (pitch curve), convex > 0, 1/m."""
        return self.roller.curvature

    @property
    def roller_profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam for a roller, convex > 0, m; ``inf`` where it turns hollow."""
        with np.errstate(divide="ignore"):
            return 1 / self.curvature - self.cam.roller_radius

    @property
    def profile_curvature(self) -> np.ndarray:
        """Curvature of the cam under the chosen follower, convex > 0, 1/m."""
        return self.curve.profile_curvature

    @property
    def profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam under the chosen follower, convex > 0, m."""
        return self.flat_radius if self.cam.follower == FLAT else self.roller_profile_radius

    @property
    def undercut(self) -> np.ndarray:
        """Where the chosen follower would cut the cam away: the two cannot fit."""
        return self.curve.undercut

    @property
    def pressure_angle(self) -> np.ndarray:
        """Between the contact normal and the line of travel, rad; 0 for a flat face."""
        return self.curve.pressure_angle

    @property
    def contact_point(self) -> np.ndarray:
        """Where follower and cam touch, in the frame of the machine, m."""
        return self.curve.contact_point()

    def on_cam(self, points: np.ndarray) -> np.ndarray:
        """Points of the machine's frame as they lie on the cam at each cam angle."""
        return self.curve.on_cam(points)

    @property
    def profile(self) -> np.ndarray:
        """The cam under the chosen follower, m; closed for the `whole` cam."""
        return self.curve.profile

    @property
    def pitch(self) -> np.ndarray:
        """Path of the roller's centre on the cam, m; ``nan`` under a flat face, which has none."""
        return self.curve.pitch if self.cam.follower == ROLLER else np.nan * self.profile

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The follower of one design: face or roller, with its stem."""
        cam, r = self.cam, self.cam.roller_radius
        flat, length, wide = cam.follower == FLAT, 1.6 * cam.max_lift, 1.15 * abs(self.velocity).max()
        at: Any = {"x": 0.0, "y": cam.base_radius + self.lift + (0.0 if flat else r)}
        face = Outline("follower", "face", np.array([[-wide, wide], [0, 0]]), **at)
        stem = Outline("follower", "arm", np.array([[0, 0], [0, length + (0.0 if flat else r)]]), **at)
        return face if flat else Disc("follower", "roller", r, **at), stem

    @property
    def face_normal(self) -> np.ndarray | None:
        """A flat face's normal as the cam sees it, outward, at each cam angle; ``None`` under a roller."""
        return self.curve.face_normal if self.cam.follower == FLAT else None

    @property
    def outer_profile(self) -> np.ndarray:
        """``nan``: a valve cam has no groove and so no outer flank."""
        return self.curve.outer_profile

    @property
    def profile_angle(self) -> np.ndarray:
        """The cam angle at which the follower touches each point of the profile, rad."""
        return self.cam_angle

    @cached_property
    def stretch(self) -> np.ndarray:
        """Which part of the cam each point belongs to, in words."""
        from_nose = abs(self.cam_angle - self.cam.half_angle)
        on_flank, on_ramp = from_nose <= self.cam.half_angle, from_nose <= self.cam.half_angle + self.cam.ramp_angle
        side = np.where(self.cam_angle <= self.cam.half_angle, "opening ", "closing ")
        part = np.where(on_flank, "flank", "ramp")
        return np.where(on_ramp, np.char.add(side, part), "base circle")

    @property
    def valve_open(self) -> np.ndarray:
        """Where the cam holds the valve open; on ramp and base circle the lash is open instead."""
        return self.lift >= -ROUNDING

    def force_at(self, speed: Any) -> np.ndarray:
        """Force between cam and follower along the line of travel with the camshaft at ``speed``, N.

        0 where the valve is shut; negative where the follower would have to be pulled: there it jumps.
        """
        return np.where(self.valve_open, self.spring_force - self.needed_at(speed), 0 * self.lift)

    def needed_at(self, speed: Any) -> np.ndarray:
        """Spring force that keeps the train on the cam at ``speed``, N; negative where the cam lifts it anyway."""
        return np.where(self.valve_open, -self.cam.train_mass * speed**2 * self.acceleration, 0 * self.lift)

    @cached_property
    def spring_force(self) -> np.ndarray:
        """Force of the valve spring, N."""
        return self.cam.load.static_force(np.maximum(self.lift, 0))

    @cached_property
    def follower_force(self) -> np.ndarray:
        """Force between cam and follower along the line of travel, N."""
        return self.force_at(self.cam.speed)

    @cached_property
    def contact_force(self) -> np.ndarray:
        """Force between cam and follower along the contact normal, without friction, N."""
        return self.follower_force / np.cos(self.pressure_angle)

    @cached_property
    def contact(self) -> LineContact:
        """Pressure, half width and shear at the contact; ``nan`` where the cam is undercut."""
        return _pressed(self.cam, self.contact_force, self.curve.fit)

    @property
    def contact_stress(self) -> np.ndarray:
        """``p_0``: largest pressure between cam and follower, Pa."""
        return self.contact.pressure

    @cached_property
    def peak_contact_stress(self) -> Any:
        """The largest over the opening flank, Pa."""
        return self.highest(lambda at: _pressed(self.cam, at.contact_force, at.fit).pressure).value

    @cached_property
    def cam_torque(self) -> np.ndarray:
        """Torque that turns the camshaft, without friction, N m: power in = power out."""
        return self.follower_force * self.velocity

    @cached_property
    def jump_speed(self) -> Any:
        """Speed of the camshaft at which the follower first leaves the cam, rad/s."""
        return jump_speed(self.opening)

    @property
    def jump_margin(self) -> Any:
        """How far the `jump_speed` lies above the speed, as a share of it."""
        return self.jump_speed / _number(self.cam.speed) - 1

    @property
    def top_speed(self) -> Any:
        """Speed of the camshaft with the speed margin, rad/s."""
        return self.cam.speed * (1 + self.cam.speed_margin)

    @cached_property
    def preload_needed(self) -> Any:
        """Least preload that keeps the follower on the cam up to the speed margin at the given rate, N."""
        return preload_needed(self.opening, self.top_speed)

    @cached_property
    def rate_needed(self) -> Any:
        """Least spring rate that keeps the follower on the cam up to the speed margin with the given preload, N/m."""

        def lacking(at: Any) -> Any:
            lift, force = at.motion.s, -self.cam.train_mass * self.top_speed**2 * at.acceleration
            return np.maximum(force - self.cam.spring_preload, 0) / np.where(lift > 0, lift, np.inf)

        return self.highest(lacking).value

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
        at = ValveAnalysis(self.cam, angle + self.cam.half_angle)
        return {
            "cam angle [deg]": angle / deg,
            "lift [mm]": (at.lift + self.cam.ramp_height) / mm,
            "velocity [mm/rad]": at.velocity / mm,
            "acceleration [mm/rad^2]": at.acceleration / mm,
            "profile radius [mm]": at.profile_radius / mm,
        }


def _number(value: Any) -> Any:
    """A field of a design as a number of the cam as a whole: one, or ``(p,)`` from ``(p, 1)``."""
    return np.atleast_1d(value)[..., 0]


def _pressed(cam: ValveCam, force: Any, fit: Any) -> LineContact:
    """The contact under a force along its normal; without one where the follower would have to be pulled."""
    return line_contact(np.maximum(force, 0) / cam.materials.width, fit, cam.materials.modulus)


def _acceleration(analysis: Any) -> Any:
    return analysis.acceleration
