"""What the analyses of all cams under a flat face share: the profile is the pitch curve, there is no groove."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..extrema import Extreme
from ..quantities.types import Array, Value
from .analysis import CamAnalysis

OF_ROLLERS = "friction.roller_pin", "contact.bearing", "contact.bearing.rating"
"""Paths of what a flat face has no use for."""


@dataclass(frozen=True)
class FlatAnalysis(CamAnalysis):
    """A cam under a flat face, held to it from outside: it has no groove, and its pitch curve is the profile."""

    @property
    @abstractmethod
    def profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam, convex > 0, m; at or below 0 the face cuts it away."""

    @property
    @abstractmethod
    def face_reach(self) -> tuple[Value, Value]:
        """Least and largest distance along the face at which it is touched, m."""

    @property
    def face_width(self) -> Value:
        """Least width of the face: how far the contact wanders, m."""
        low, high = self.face_reach
        return high - low

    @property
    def curvature(self) -> np.ndarray:
        """Curvature of the profile, convex > 0, 1/m."""
        return self.profile_curvature

    @cached_property
    def profile_curvature(self) -> np.ndarray:
        """Curvature of the profile, convex > 0, 1/m; < 0 where the face cuts it away."""
        with np.errstate(divide="ignore"):
            return 1 / self.profile_radius

    @property
    def outer_profile_curvature(self) -> np.ndarray:
        """``nan``: there is no outer flank."""
        return np.nan * self.profile_radius

    @cached_property
    def undercut(self) -> np.ndarray:
        """Where the face would cut the cam away: it would have to be hollow or pointed there."""
        return self.profile_radius <= 0

    @property
    def outer_undercut(self) -> np.ndarray:
        """Nowhere: there is no outer flank."""
        return np.zeros_like(self.undercut)

    @cached_property
    def profile_margin(self) -> Extreme:
        """Least radius of curvature of the profile, m; at or below 0 the face cuts it away.

        ``-inf`` where the follower's speed drops at once: the face cuts off the corner.
        """
        found, corner = self.lowest(_radius), self.corner(-1)
        drops = (corner.value > 0) & ~np.isnan(found.value)
        return Extreme(np.where(drops, -np.inf, found.value)[()], np.where(drops, corner.cam_angle, found[1])[()])

    @property
    def profile_radii(self) -> Array:
        """Radii of curvature of the profile at `seen_at`, m; ``-inf`` throughout where the follower's speed drops."""
        return np.where(np.expand_dims(self.corner(-1).value > 0, -1), -np.inf, self.seen(_radius, -1))

    groove: ClassVar[bool] = False
    curvature_limit: ClassVar[str] = ""

    @property
    def max_curvature(self) -> Value:
        """``inf``: a face is undercut where the profile is concave, not where it is sharp."""
        return np.inf

    @property
    def driving_flank(self) -> Value:
        """The profile, there is no other; where the follower comes back it drives the cam."""
        return 1.0

    @property
    def loaded_flank(self) -> Value:
        """The profile; where the follower pulls it has left the cam."""
        return 1.0

    @property
    def lean(self) -> Value:
        """The face slides: ``arctan f``."""
        return np.arctan(self.cam.friction.coefficient)

    @property
    def fit(self) -> np.ndarray:
        """Curvature of the profile; the face adds nothing."""
        return self.profile_curvature

    @property
    @abstractmethod
    def facing_rate(self) -> Value:
        """By how much the cam turns past the face, per turn of the cam."""

    @property
    def surface_rates(self) -> tuple[Array, Array]:
        """``rho`` times the `facing_rate`, and how fast the cam's surface runs past the face, along it."""
        point, (nx, ny) = self.contact_point(), self.normal
        (sx, sy), (vx, vy) = self.surface_velocity(point), self.bearing.velocity_at(point)
        slides = self.cam.rotation * (nx * (sy - vy) - ny * (sx - vx))
        return self.profile_radius * self.facing_rate, slides

    @property
    def face_normal(self) -> np.ndarray:
        """The face's normal as the cam sees it, outward, at each cam angle."""
        return self.on_cam(self.normal)

    @cached_property
    def pitch(self) -> np.ndarray:
        """The profile, m."""
        return self.profile

    @cached_property
    def pitch_radius(self) -> np.ndarray:
        """Cam axis to the point of contact, m."""
        return np.hypot(*self.contact_point())

    @cached_property
    def profile(self) -> np.ndarray:
        """The cam's outline, m."""
        return self.on_cam(self.contact_point())

    @property
    def outer_profile(self) -> np.ndarray:
        """``nan``: there is no outer flank."""
        return np.nan * self.profile


def _radius(analysis: FlatAnalysis) -> Array:
    return analysis.profile_radius
