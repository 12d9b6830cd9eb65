"""What rides on a valve cam: the follower's face or roller, the mass it moves and the spring that holds it down.

The follower travels in line with the cam axis, along +y of the machine's frame; the cam turns counter-clockwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..cam import peaks
from ..cam.peaks import Extreme
from ..geometry import offset_curvature
from ..motion import Kinematics


@dataclass(frozen=True)
class FlatFollower:
    """A flat face across the line of travel.

    The face is a tangent of the cam, so ``r_0 + h`` is the cam's support function: contact at ``(h', r_0 + h)``,
    radius of curvature ``rho = r_0 + h + h''``.
    """

    name: ClassVar[str] = "flat face"

    def pressure_angle(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> Any:
        """0: the face is square to the line of travel."""
        return 0 * motion.s

    def contact_point(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> np.ndarray:
        """Where face and cam touch, machine's frame, m."""
        return np.stack(np.broadcast_arrays(motion.v, base_radius + motion.s))

    def profile_curvature(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> Any:
        """Of the cam, convex > 0, 1/m; < 0 where the face undercuts it."""
        with np.errstate(divide="ignore"):
            return 1 / (base_radius + motion.s + motion.a)

    def fit(self, profile_curvature: Any, roller_radius: Any) -> Any:
        """Sum of both curvatures at the contact, 1/m."""
        return profile_curvature


@dataclass(frozen=True)
class RollerFollower:
    """A roller whose centre travels in line with the cam axis.

    ``R = r_0 + r_r + h``; ``tan alpha = h' / R``; radius of curvature of the centre's path
    ``rho = (R^2 + h'^2)^1.5 / (R^2 + 2 h'^2 - R h'')``, of the cam ``rho - r_r``.
    """

    name: ClassVar[str] = "roller"

    def pressure_angle(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> Any:
        """Between the contact normal and the line of travel, > 0 while the valve opens, rad."""
        return np.arctan2(motion.v, base_radius + roller_radius + motion.s)

    def contact_point(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> np.ndarray:
        """Where roller and cam touch, machine's frame, m."""
        alpha = self.pressure_angle(motion, base_radius, roller_radius)
        height = base_radius + roller_radius + motion.s - roller_radius * np.cos(alpha)
        return np.stack(np.broadcast_arrays(roller_radius * np.sin(alpha), height))

    def pitch_curvature(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> Any:
        """Of the roller centre's path on the cam, convex > 0, 1/m."""
        R, v = base_radius + roller_radius + motion.s, motion.v
        return (R**2 + 2 * v**2 - R * motion.a) / (R**2 + v**2) ** 1.5

    def profile_curvature(self, motion: Kinematics, base_radius: Any, roller_radius: Any) -> Any:
        """Of the cam, convex > 0, 1/m."""
        return offset_curvature(self.pitch_curvature(motion, base_radius, roller_radius), -roller_radius)

    def fit(self, profile_curvature: Any, roller_radius: Any) -> Any:
        """Sum of both curvatures at the contact, 1/m; < 0 where the roller undercuts the cam."""
        return profile_curvature + 1 / roller_radius


FLAT, ROLLER = FlatFollower(), RollerFollower()
FOLLOWERS = (FLAT, ROLLER)


def highest(function: Callable[[Any], Any], angle: Any) -> Extreme:
    """The largest value of a smooth ``function`` over the even cam angles ``angle``, and where it stands.

    >>> value, angle = highest(np.sin, np.linspace(0, 3, 31))
    >>> print(f"{value:.6f} at {angle:.4f}")
    1.000000 at 1.5708
    """
    inner = np.ones(np.shape(angle)[-1], dtype=bool)
    inner[[0, -1]] = False
    return peaks.highest(function, angle, inner)


@dataclass(frozen=True)
class ValveTrain:
    """A rigid train of one mass, held down by one spring, above a cam; lift ``h`` counts from the shut valve.

    On a follower of lift ``h`` and acceleration ``h''`` [m/rad^2] at the speed ``omega`` the cam presses with
    ``F = m omega^2 h'' + c h + F_0``.  The follower jumps where that is negative.
    """

    mass: Any
    spring_rate: Any
    preload: Any

    def spring_force(self, lift: Any) -> Any:
        """Force of the spring, N."""
        return self.preload + self.spring_rate * lift

    def force(self, motion: Kinematics, speed: Any) -> Any:
        """Force of the cam along the line of travel, N."""
        return self.mass * speed**2 * motion.a + self.spring_force(motion.s)

    def needed(self, motion: Kinematics, speed: Any) -> Any:
        """Spring force that keeps the train on the cam, N."""
        return -self.mass * speed**2 * motion.a

    def rate_needed(self, opening: Callable[[Any], Kinematics], angle: Any, speed: Any) -> Any:
        """Least rate with which a spring of this preload holds the train on the cam at ``speed``, N/m."""

        def lacking(alpha: Any) -> Any:
            motion = opening(alpha)
            open_ = motion.s > 0
            return np.where(
                open_, (self.needed(motion, speed) - self.preload) / np.where(open_, motion.s, 1), 0 * motion.s
            )

        return np.maximum(highest(lacking, angle)[0], 0)

    def spring_needed(
        self, opening: Callable[[Any], Kinematics], angle: Any, speed: Any, share: float
    ) -> tuple[Any, Any]:
        """Rate [N/m] and preload [N] of the weakest spring whose preload is ``share`` of its force at full lift."""
        full = opening(angle).s[..., -1:]

        def lacking(alpha: Any) -> Any:
            motion = opening(alpha)
            return self.needed(motion, speed) / (share + (1 - share) * motion.s / full)

        force = highest(lacking, angle)[0]
        return (1 - share) * force / full[..., 0], share * force
