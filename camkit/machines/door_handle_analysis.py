"""What follows from the cam of a cabin-door handle: both of its curves, and the groove that joins them.

Source: Gong, Liu, He, Nanjing University of Aeronautics and Astronautics, 2025.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from ..cam import bodies, groove
from ..cam.analysis import OFFERS, CamAnalysis
from ..cam.oscillating_roller import OscillatingRollerAnalysis
from ..cam.undercut import undercut_in_words
from ..geometry import Body, end_to_end, rotated, vector
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .door_handle import DoorHandleCam


@dataclass(frozen=True)
class DoorHandleAnalysis:
    """Both curves of a `DoorHandleCam` over the handle angle, and the groove that joins them.

    ``cam_angle[..., :k]`` is the relief crank's motion, the rest the lift crank's.
    """

    offers: ClassVar[tuple[str, ...]] = OFFERS
    """The shapes and curves that are shown of it where nobody chooses: those of each of its curves."""

    cam: DoorHandleCam
    cam_angle: np.ndarray
    k: int
    rough: bool = field(default=False, kw_only=True)
    """Whether peaks may be a few tenths of a per cent off, as in the first rounds of a search."""

    @property
    def trouble(self) -> str:
        """What is lost of the profile, in a sentence; empty if nothing is."""
        return undercut_in_words(self)

    @cached_property
    def lift(self) -> OscillatingRollerAnalysis:
        """The lift curve."""
        return OscillatingRollerAnalysis(self.cam.lift, self.cam_angle, rough=self.rough)

    @cached_property
    def relief(self) -> OscillatingRollerAnalysis:
        """The relief curve, in the frame of its own (mirrored) crank."""
        return OscillatingRollerAnalysis(self.cam.relief, self.cam_angle, rough=self.rough)

    def between(self, low: float, high: float) -> DoorHandleAnalysis:
        """Both curves seen between two handle angles (rad) alone (see `CamAnalysis.between`)."""
        zone = replace(self)
        zone.__dict__.update({name: curve.between(low, high) for name, curve in self.curves.items()})
        return zone

    @property
    def curves(self) -> dict[str, OscillatingRollerAnalysis]:
        """Both cam curves by name."""
        return {"lift": self.lift, "relief": self.relief}

    @property
    def cranks(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Both cranks by name: pivot ``(2,)`` and roller centre ``(2, n)`` in the machine's frame, m."""
        pivot = self.from_relief(vector(self.cam.relief_centre_distance, 0.0))
        lift = self.lift.cranks["arm"]
        return {"lift": lift, "relief": (pivot, self.from_relief(self.relief.roller_centre))}

    @property
    def bodies(self) -> tuple[Body, ...]:
        """What is drawn of one design: the cam with its groove, and both cranks with their rollers."""
        disk, radius, cranks = bodies.disk(self, True), self.cam.roller_radius, self.cranks.items()
        arms = [(*bodies.rocker(name, pivot, end), bodies.roller(name, end, radius)) for name, (pivot, end) in cranks]
        return (*disk, *(body for arm in arms for body in arm))

    curvature_limit: ClassVar[str] = CamAnalysis.curvature_limit

    @property
    def max_curvature(self) -> Value:
        """The largest curvature of the pitch curve that both rollers can run on, 1/m."""
        return self.lift.max_curvature

    @property
    def turn(self) -> np.ndarray:
        """How far the cam has turned counter-clockwise at each handle angle, rad."""
        return self.cam_angle

    def from_relief(self, points: np.ndarray) -> np.ndarray:
        """Points of the relief curve's own frame in the frame of the whole cam."""
        x, y = points
        return rotated(np.stack([x, -y]), self.cam.relief_direction)

    def _joined(self, name: str) -> np.ndarray:
        """A curve's points along the whole groove, ``(2, ..., 2n)``: relief curve, transition arc, lift curve.

        The transition arc is what the relief roller runs over while its crank dwells.
        """
        both = self.from_relief(getattr(self.relief, name)), getattr(self.lift, name)[..., self.k :]
        return np.stack([end_to_end(relief, lift) for relief, lift in zip(*both, strict=True)])

    @cached_property
    def stretch(self) -> np.ndarray:
        """The name of the stretch to which each point of the groove belongs."""
        n = self.cam_angle.shape[-1]
        return np.repeat(["relief", "transition", "lift"], [self.k, n - self.k, n - self.k])

    @property
    def profile_angle(self) -> np.ndarray:
        """The handle angle at which a roller touches each point of the groove, rad."""
        return end_to_end(self.cam_angle, self.cam_angle[..., self.k :])

    @cached_property
    def pitch(self) -> np.ndarray:
        """Pitch curve of the whole groove, m."""
        return self._joined("pitch")

    @cached_property
    def profile(self) -> np.ndarray:
        """Inner flank of the whole groove, m."""
        return self._joined("profile")

    @cached_property
    def outer_profile(self) -> np.ndarray:
        """Outer flank of the whole groove, m."""
        return self._joined("outer_profile")

    @cached_property
    def stroke_curvature(self) -> Value:
        """The largest convex curvature of the lift curve from its least convex (most hollow) place on, 1/m.

        A rise begins on the base circle with that circle's curvature, so the most convex point of the whole curve says
        how large the disk is.  Behind the most hollow place lies what the stroke itself bends.
        """
        hollow = np.expand_dims(self.lift.lowest(_curvature).cam_angle, -1)
        most = self.lift.highest(lambda at: np.where(at.cam_angle >= hollow, at.curvature, -np.inf)).value
        return np.where(np.isinf(self.lift.sharpest(1).value), np.inf, most)[()]

    def _along(self, name: str) -> np.ndarray:
        return end_to_end(getattr(self.relief, name), getattr(self.lift, name)[..., self.k :])

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature of the whole pitch curve, convex > 0, 1/m."""
        return self._along("curvature")

    @cached_property
    def groove_gap(self) -> Value:
        """Least width of the wall between two parts of the whole groove, m; below 0 they merge (see `groove.gap`)."""
        cam, after = self.cam, self.cam.lift_cam_angle

        def path(place: Array) -> np.ndarray:
            """The relief roller's way over the handle angle, then the lift roller's over its own."""
            lift = place - after
            relief = self.from_relief(self.relief.at(np.minimum(place, cam.handle_angle)).pitch)
            both = zip(self.lift.at(np.maximum(lift, 0.0)).pitch, relief, strict=True)
            return np.stack([np.where(lift > cam.relief_cam_angle, x, y) for x, y in both])

        return groove.gap(path, cam.handle_angle + after, cam.roller_radius, self.rough)

    @cached_property
    def undercut(self) -> np.ndarray:
        """Where the inner flank of the groove is undercut."""
        return self._along("undercut")

    @cached_property
    def outer_undercut(self) -> np.ndarray:
        """Where the outer flank of the groove is undercut."""
        return self._along("outer_undercut")


def _curvature(curve: OscillatingRollerAnalysis) -> np.ndarray:
    return curve.curvature
