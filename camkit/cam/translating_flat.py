"""Disk cam with a flat face on a sliding follower.

The follower slides along +y; its face is square to that and stands at the height ``r_0 + s`` above the cam axis.
That height is the cam's support function, so the face is touched at ``x = sigma v`` and the radius of curvature
is ``rho = r_0 + s + w``.

Source: Norton, Cam Design and Manufacturing Handbook (flat-faced followers); checked against brute-force geometry.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..geometry import Body, Outline, vector
from ..motion import MotionProgram, motion_in
from ..quantities import choice, quantity, unless
from ..quantities.kinds import a_number
from ..quantities.types import Array, Value
from ..units import mm
from . import bodies
from .conjugate import opposite
from .directions import ROTATIONS
from .extremes import lowest
from .flat_analysis import OF_ROLLERS, FlatAnalysis
from .follower_measures import FLAT_CURVE, jump_margin
from .followers import DiskCam, SlidingAnalysis, over_the_motion, rise_and_return
from .lubricated_pair import AnyContact, contact_choice
from .measures import SLIDING
from .shaking import MAKERS
from .sizing import if_possible, refuse_radius
from .slide import SlideFriction, SlideLoad


@dataclass(frozen=True)
class TranslatingFlatCam(DiskCam):
    """A disk cam that lifts a sliding follower through a flat face.

    ``motion`` gives the follower's level; at the level 0, wherever the motion begins, the face stands
    ``base_radius`` above the cam axis.  ``rotation`` is +1 counter-clockwise, -1 clockwise.  An ``offset`` of the
    follower's axis does not change the cam: it moves the contact on the face, and so what rubs in the guide.

    >>> cam = TranslatingFlatCam().analyse()
    >>> print(f"{cam.face_width / mm:.4f} mm, {cam.profile_margin.value / mm:.4f} mm")
    38.1972 mm, 19.3360 mm

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a face that would pass the cam axis.
    """

    motion: MotionProgram = motion_in("mm", 20, 60, lambda: rise_and_return(20 * mm))
    base_radius: float = quantity("r_0", 30, 10, 100, "mm", "cam axis to face at the motion's level 0")
    offset: float = quantity("e", 0, -30, 30, "mm", "follower's axis beside the cam axis", above=None)
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")
    load: SlideLoad = field(default_factory=SlideLoad)
    friction: SlideFriction = field(default_factory=SlideFriction)
    contact: AnyContact = contact_choice()

    name: ClassVar[str] = "sliding face"
    roller_radius: ClassVar[float] = 0.0
    """There is no roller."""

    def following(self) -> dict[str, str]:
        """No roller, no pin, no bearing."""
        return dict.fromkeys(OF_ROLLERS, "a flat face has no roller")

    @property
    def start_height(self) -> Value:
        """Height of the face at the motion's level 0: the base radius, m."""
        return self.base_radius

    def analyse(self, n: int = 721) -> TranslatingFlatAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(TranslatingFlatAnalysis, self, n)

    def base_radius_for(self, *, min_radius: Value) -> Value:
        """Least base radius with which no radius of curvature is below ``min_radius``: ``rho - s - w``, m.

        ``ValueError`` (``nan`` in a population) where the follower's speed drops at once: none keeps it there.

        >>> cam = TranslatingFlatCam()
        >>> cam.replace(base_radius=cam.base_radius_for(min_radius=4 * mm)).analyse().profile_margin.value.round(9)
        np.float64(0.004)
        """
        refuse_radius(min_radius)
        analysis = TranslatingFlatAnalysis(self, self.motion.resolution.angle)
        size = min_radius - lowest(analysis, lambda at: at.motion.s + at.acceleration).value
        return if_possible(size, analysis.corner(-1))

    def conjugate(self, distance: Value) -> TranslatingFlatCam:
        """The second cam of a pair: it carries a second face below the cam axis, ``distance`` from the first.

        Given in the machine's frame turned by half a turn, so its follower again slides along +y.
        """
        distance = a_number(distance, "the distance of the faces")
        if refuse := unless(distance > self.base_radius):
            refuse(
                f"the faces are {distance / mm:.4g} mm apart; the first stands {self.base_radius / mm:.4g} mm above "
                "the cam axis, and the second must stand below it"
            )
        return self.replace(
            motion=opposite(self.motion),
            base_radius=distance - self.base_radius,
            offset=-self.offset,
            load=self.load.opposite(),
        )


@dataclass(frozen=True)
class TranslatingFlatAnalysis(SlidingAnalysis, FlatAnalysis):
    """What follows from a `TranslatingFlatCam` at the given cam angles."""

    cam: TranslatingFlatCam

    @property
    def clear(self) -> Array:
        """Where the face stays above the cam axis."""
        return self.cam.base_radius + self.motion.s > 0

    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""
        least = (self.cam.base_radius + self.motion.s).min()
        return f"the face comes down to {least / mm:.4g} mm above the cam axis; it must stay above 0 mm"

    @cached_property
    def profile_radius(self) -> np.ndarray:
        """``rho = r_0 + s + w``: radius of curvature of the cam, convex > 0, m."""
        return self.height + self.acceleration

    @property
    def facing_rate(self) -> Value:
        """1: the face keeps its direction."""
        return 1.0

    @property
    def pressure_angle(self) -> np.ndarray:
        """0: the face is square to the travel, rad."""
        return 0.0 * self.height

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal: along the travel."""
        return np.stack([0.0 * self.height, 1.0 + 0.0 * self.height])

    def contact_point(self, flank: Value = 1) -> np.ndarray:
        """Where face and cam touch, machine's frame, m: ``(sigma v, r_0 + s)``; ``nan`` for an outer flank."""
        return vector(self.cam.rotation * self.velocity + 0.0 * self.height, self._on(flank))

    def _on(self, flank: Value) -> Value:
        return np.where(np.greater(flank, 0), self.height, np.nan)

    @cached_property
    def contact_offset(self) -> np.ndarray:
        """``sigma v - e``: from the follower's axis to where its face is touched, m."""
        return self.contact_point()[0] - self.cam.offset

    @cached_property
    def face_reach(self) -> tuple[Value, Value]:
        """How far the face has to reach to either side of the follower's axis: least and largest offset, m."""
        return self.lowest(lambda at: at.contact_offset).value, self.highest(lambda at: at.contact_offset).value

    @property
    def face(self) -> np.ndarray:
        """Both ends of the narrowest face in the frame of the machine, ``(2, 2, ...)``: x, y of each end, m."""
        ends = (self.cam.offset + np.expand_dims(x, -1) for x in self.face_reach)
        return np.stack([vector(x, self.height) for x in ends], axis=1)

    @property
    def follower(self) -> tuple[Body, ...]:
        """The stem with its face, as narrow as it may be."""
        ((name, (mouth, foot)),) = self.cranks.items()
        face = np.stack([np.stack(self.face_reach), np.zeros(2)])
        return *bodies.stem(name, mouth, foot), Outline(name, "face", face, x=foot[0], y=foot[1])

    @property
    def lever(self) -> np.ndarray:
        """1: the contact force goes along the travel."""
        return 1.0 + 0.0 * self.height


TranslatingFlatCam.measures = (*FLAT_CURVE, jump_margin, *SLIDING)
TranslatingFlatCam.makers = MAKERS
