"""What the analyses of all cams under a roller share: both flanks, and where the roller cuts them away."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..extrema import Extreme
from ..geometry import offset_curvature, vector
from ..quantities import certain
from ..quantities.types import Array, Value
from . import groove
from .analysis import CamAnalysis
from .measures import number, radius_of


@dataclass(frozen=True)
class RollerAnalysis(CamAnalysis):
    """A cam under a roller: a plate (inner flank) or a groove (both flanks)."""

    @property
    @abstractmethod
    def roller_centre(self) -> np.ndarray:
        """The roller's centre in the frame of the machine, m."""

    @property
    @abstractmethod
    def curvature(self) -> np.ndarray:
        """Curvature of the pitch curve, convex > 0, 1/m."""

    def bend(self, side: Value) -> Array:
        """Curvature of the pitch curve as seen from the inner flank (``side`` +1) or from the outer one (-1), 1/m."""
        return side * self.curvature

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
        return self.cam.roller_radius * self.bend(1) >= 1

    @cached_property
    def outer_undercut(self) -> np.ndarray:
        """Where the roller would cut away a groove's outer flank: ``-r_T kappa >= 1``; nowhere on a plate."""
        return (self.cam.roller_radius * self.bend(-1) >= 1) & self.groove

    @cached_property
    def profile_margin(self) -> Extreme:
        """Least convex radius of the inner flank, ``1 / kappa - r_T``, m; ``inf`` if it is convex nowhere."""
        return self._margin(1)

    @cached_property
    def outer_profile_margin(self) -> Extreme:
        """The same for a groove's outer flank, which the roller cuts where the pitch curve is hollow."""
        return self._margin(-1)

    def sharpest(self, side: int) -> Extreme:
        """The largest convex (``side`` = 1) or hollow (-1) curvature of the pitch curve, 1/m; ``inf`` at a corner.

        The pitch curve has a corner where the follower's speed jumps: a convex one where it drops.
        """
        found, corner = self.highest(_convex if side > 0 else _concave), self.corner(-side)
        jumps = (corner.value > 0) & ~np.isnan(found.value)
        value, angle = (np.where(jumps, *pair)[()] for pair in ((np.inf, found.value), (corner.cam_angle, found[1])))
        return Extreme(value, angle)

    def bends(self, side: int) -> Array:
        """The convex (``side`` = 1) or hollow (-1) curvature at `seen_at`, 1/m; ``inf`` throughout with a corner."""
        corner = np.expand_dims(self.corner(-side).value > 0, -1)
        return np.where(corner, np.inf, self.seen(_convex if side > 0 else _concave))

    @property
    def profile_radii(self) -> Array:
        """Radii of curvature of the inner flank at `seen_at`, m."""
        return radius_of(self.bends(1)) - self.cam.roller_radius

    def _margin(self, flank: int) -> Extreme:
        most, angle = self.sharpest(flank)
        return Extreme(radius_of(most) - number(self.cam.roller_radius), angle)

    @property
    def max_curvature(self) -> Array:
        """``1 / r_T``; ``inf`` for a knife edge."""
        with np.errstate(divide="ignore"):
            return np.divide(1.0, self.cam.roller_radius)

    @cached_property
    def groove_gap(self) -> Value:
        """Least width of the wall between two parts of an open groove, m; below 0 they merge (see `groove.gap`).

        ``inf`` for a closed cam, of which the local test of both flanks is enough, and for a plate.
        """
        motion = self.cam.motion
        if not self.groove or certain(motion.periodic):
            return np.where(self.buildable[..., 0], np.inf, np.nan)[()]
        found = groove.gap(lambda angle: self.at(angle).path, motion.span, self.cam.roller_radius, self.rough)
        return np.where(number(motion.periodic) & np.isfinite(found), np.inf, found)[()]

    def contact_point(self, flank: Value = 1) -> np.ndarray:
        """Where the roller touches the inner flank (+1) or the outer one (-1), machine's frame, m."""
        away = flank * self.cam.roller_radius
        (x, y), (across, along) = self.roller_centre, self.normal
        return vector(x - away * across, y - away * along)

    @property
    def groove(self) -> bool:
        """Whether the roller runs in a groove; a cam that does not say has one."""
        return bool(getattr(self.cam, "groove", True))

    @property
    def driving_flank(self) -> Value:
        """The inner flank where the follower goes out; in a groove the outer one where it comes back."""
        return np.where((self.velocity < 0) & self.groove, -1.0, 1.0)

    @property
    def loaded_flank(self) -> Array:
        """The inner flank; in a groove the outer one where the follower pulls."""
        return np.where((self.contact_force < 0) & self.groove, -1.0, 1.0)

    @property
    def lean(self) -> Array:
        """The roller slides (``arctan f``) or, if that is easier, turns on its pin (``arcsin(rho_2 / r_T)``)."""
        friction, r = self.cam.friction, self.cam.roller_radius
        share = np.where(np.greater(r, 0), friction.roller_pin / np.where(np.greater(r, 0), r, 1.0), 1.0)
        return np.minimum(np.arctan(friction.coefficient), np.arcsin(np.clip(share, 0, 1)))

    @cached_property
    def fit(self) -> np.ndarray:
        """``1 / (r_T (1 -+ r_T kappa))``: on the inner flank, on the outer one where the force is negative."""
        r, flank = self.cam.roller_radius, self.loaded_flank
        with np.errstate(divide="ignore", invalid="ignore"):
            return 1 / (r * (1 - r * self.bend(flank)))

    @property
    def surface_rates(self) -> tuple[Array, Array]:
        """``g (1 - r kappa)`` on the flank that presses, ``g`` the pitch curve's length per rad; 0: it rolls."""
        centre, kappa = self.roller_centre, self.loaded_flank * self.curvature
        (sx, sy), (vx, vy) = self.surface_velocity(centre), self.bearing.velocity_at(centre)
        return np.hypot(sx - vx, sy - vy) * (1 - self.cam.roller_radius * kappa), 0.0 * self.contact_force

    @cached_property
    def pitch(self) -> np.ndarray:
        """Pitch curve: the roller's centre as the cam sees it, m."""
        return self.on_cam(self.roller_centre)

    @property
    def path(self) -> np.ndarray:
        """Where the roller's centre runs in the cam, in the plane or in space, for the distance of its parts, m."""
        return self.pitch

    @cached_property
    def profile(self) -> np.ndarray:
        """Inner flank, the profile of a plate cam, m."""
        return self.on_cam(self.contact_point(1))

    @cached_property
    def outer_profile(self) -> np.ndarray:
        """Outer flank of a groove cam, m; ``nan`` on a plate cam, which has none."""
        flank = self.on_cam(self.contact_point(-1))
        return flank if self.groove else np.full_like(flank, np.nan)


def _convex(analysis: RollerAnalysis) -> Array:
    return analysis.bend(1)


def _concave(analysis: RollerAnalysis) -> Array:
    return analysis.bend(-1)
