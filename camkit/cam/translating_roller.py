"""Disk cam with a roller on a sliding follower.

The cam axis O is the origin.  The follower slides along +y, its axis at ``x = e``, the offset.  The roller's centre
stands at the height ``h = h_0 + s``, ``h_0 = sqrt((r_b + r_T)^2 - e^2)``.  ``sigma = +1``: the cam turns
counter-clockwise, its top runs to -x, and an offset ``e > 0`` eases the rise; ``sigma = -1``: clockwise.

Source: Norton, Cam Design and Manufacturing Handbook (cam size determination); VDI 2143 part 1; with the offset's
sign and both senses of rotation checked against brute-force geometry.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, reduce
from typing import ClassVar

import numpy as np

from ..geometry import Body, vector
from ..motion import MotionProgram, motion_in
from ..quantities import choice, quantity, text_if, unless
from ..quantities.kinds import a_number
from ..quantities.types import Array, Value
from ..units import mm
from . import bodies
from .conjugate import opposite
from .directions import CLOSURES, ROTATIONS
from .extremes import highest
from .follower_measures import ROLLER_CURVE, jump_margin
from .followers import DiskCam, SlidingAnalysis, over_the_motion, rise_and_return
from .lubricated_pair import AnyContact, contact_choice
from .measures import SLIDING, number
from .roller_analysis import RollerAnalysis
from .shaking import MAKERS
from .sizing import if_possible, min_from_which_on, refuse_pressure_angle, refuse_radius
from .slide import SlideFriction, SlideLoad


@dataclass(frozen=True)
class TranslatingRollerCam(DiskCam):
    """A disk cam that lifts a sliding follower through a roller, as a plate (inner flank) or a groove (both).

    ``motion`` gives the follower's level; at the level 0, wherever the motion begins, the profile has the
    ``base_radius``.  ``rotation`` is ``sigma``: +1 counter-clockwise, -1 clockwise.  A roller of radius 0 is a
    knife edge.

    >>> from camkit.motion import Cycloidal, Rise
    >>> from camkit.units import deg
    >>> rise = MotionProgram((Rise(120 * deg, 20 * mm, Cycloidal()),))
    >>> for offset in (0, 5 * mm):
    ...     alpha = TranslatingRollerCam(rise, 30 * mm, 8 * mm, offset).analyse(2001).pressure_angle
    ...     print(f"{np.degrees(alpha.max()):.4f} deg")
    22.0528 deg
    16.6857 deg

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a follower that would pass beside
    the cam, or a roller that would cover the cam axis.
    """

    motion: MotionProgram = motion_in("mm", 20, 60, lambda: rise_and_return(20 * mm))
    base_radius: float = quantity("r_b", 30, 10, 100, "mm", "cam axis to profile at the motion's level 0")
    roller_radius: float = quantity("r_T", 8, 0, 40, "mm", "roller; 0 is a knife edge", at_least=0)
    offset: float = quantity("e", 0, -30, 30, "mm", "follower's axis beside the cam axis", above=None)
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")
    load: SlideLoad = field(default_factory=SlideLoad)
    friction: SlideFriction = field(default_factory=SlideFriction)
    groove: bool = choice("g", True, CLOSURES, "what guides the roller: a groove, or a plate and a spring or weight")
    """Whether the roller runs in a groove, or (``False``) on a plate to which a spring or a weight holds it."""
    contact: AnyContact = contact_choice()

    name: ClassVar[str] = "sliding roller"

    def __post_init__(self) -> None:
        super().__post_init__()
        if refuse := unless(abs(self.offset) < self.prime_radius):
            refuse(
                f"the offset of the follower is {self.offset / mm:.4g} mm; base circle and roller make "
                f"{self.prime_radius / mm:.4g} mm, and it must stay below that"
            )
        self._keep(abs(self.offset) < self.prime_radius)

    @property
    def prime_radius(self) -> Value:
        """Cam axis to roller centre at the motion's level 0, m."""
        return self.base_radius + self.roller_radius

    @property
    def start_height(self) -> Array:
        """``h_0``: height of the roller's centre at the motion's level 0, m."""
        return np.sqrt(self.prime_radius**2 - self.offset**2)

    def analyse(self, n: int = 721) -> TranslatingRollerAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(TranslatingRollerAnalysis, self, n)

    def base_radius_for(self, *, pressure_angle: Value | None = None, min_radius: Value | None = None) -> Value:
        """Least base radius from which on every larger one keeps the limits that are given, m.

        ``pressure_angle``: its largest size, rad; ``h >= |v - sigma e| / tan(alpha)`` everywhere.
        ``min_radius``: of curvature of the profile where it is convex, m.  Everything else stays as it is.  Where
        the limits leave that open, the least is where the roller just touches the cam axis; a cam must be larger.
        Where the follower's speed drops at once the profile has a corner, which only a knife edge can follow: there no
        base radius keeps a ``min_radius``, which is a ``ValueError``, or ``nan`` in a population.

        >>> from camkit.units import deg
        >>> cam = TranslatingRollerCam()
        >>> wide = cam.replace(base_radius=cam.base_radius_for(pressure_angle=20 * deg))
        >>> print(f"{wide.base_radius / mm:.2f} mm, {abs(wide.analyse().pressure_angle).max() / deg:.3f} deg")
        35.24 mm, 20.000 deg
        """
        if pressure_angle is not None:
            refuse_pressure_angle(pressure_angle)
        if min_radius is not None:
            refuse_radius(min_radius)

        def start_height(at: TranslatingRollerAnalysis) -> Array:
            steep = 0.0 if pressure_angle is None else abs(at.across) / np.tan(pressure_angle)
            tight = 0.0 if min_radius is None else at.height_for(min_radius)
            clear = np.sqrt(np.maximum(self.roller_radius**2 - self.offset**2, 0.0))
            return reduce(np.maximum, (steep, tight, clear)) - at.motion.s

        analysis = TranslatingRollerAnalysis(self, self.motion.resolution.angle)
        height = highest(analysis, start_height).value
        e, r = (number(x) for x in (self.offset, self.roller_radius))
        size = np.maximum(np.hypot(np.maximum(height, 0), e) - r, 0)
        if min_radius is None:
            return size
        return if_possible(size, analysis.corner(-1), (r == 0) & (np.asarray(min_radius) == 0))

    def conjugate(self, distance: Value, roller_radius: Value | None = None) -> TranslatingRollerCam:
        """The second cam of a pair: it carries a roller below the cam axis, ``distance`` from the first one's centre.

        Given in the machine's frame turned by half a turn, so its follower again slides along +y.
        """
        distance = a_number(distance, "the distance of the rollers")
        r = self.roller_radius if roller_radius is None else a_number(roller_radius, "the second roller's radius")
        height = distance - self.start_height
        if refuse := unless(height > 0):
            refuse(
                f"the rollers' centres are {distance / mm:.4g} mm apart; the first stands "
                f"{self.start_height / mm:.4g} mm above the cam axis, and the second must stand below it"
            )
        return self.replace(
            motion=opposite(self.motion),
            base_radius=np.where(height > 0, np.hypot(height, self.offset) - r, np.nan)[()],
            roller_radius=r,
            offset=-self.offset,
            load=self.load.opposite(),
        )


@dataclass(frozen=True)
class TranslatingRollerAnalysis(SlidingAnalysis, RollerAnalysis):
    """What follows from a `TranslatingRollerCam` at the given cam angles."""

    cam: TranslatingRollerCam

    @property
    def clear(self) -> Array:
        """Where the roller is above the level of the cam axis and clear of the axis."""
        h = self.cam.start_height + self.motion.s
        return (h > 0) & (np.hypot(self.cam.offset, h) > self.cam.roller_radius)

    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""
        h = self.cam.start_height + self.motion.s
        return text_if(
            h.min() <= 0,
            f"the roller's centre comes down to {h.min() / mm:.4g} mm above the cam axis; it must stay above 0 mm",
            f"the roller of radius {self.cam.roller_radius / mm:.4g} mm comes within "
            f"{np.hypot(self.cam.offset, h).min() / mm:.4g} mm of the cam axis; it must stay outside it",
        )

    @cached_property
    def pitch_radius(self) -> np.ndarray:
        """``R``: cam axis to roller centre, m."""
        return np.hypot(self.cam.offset, self.height)

    @cached_property
    def across(self) -> np.ndarray:
        """``v - sigma e``: the contact normal's component across the travel, to where the cam's surface runs."""
        return self.velocity - self.cam.rotation * self.cam.offset

    @cached_property
    def _size(self) -> np.ndarray:
        """``sqrt(h^2 + (v - sigma e)^2)``: the length of the normal that is `height` high."""
        return np.sqrt(self.height * self.height + self.across * self.across)

    @cached_property
    def pressure_angle(self) -> np.ndarray:
        """``alpha``: ``tan alpha = (v - sigma e) / h``, > 0 where the normal leans as the cam's surface runs, rad."""
        return np.arctan2(self.across, self.height)

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature of the pitch curve, convex > 0, 1/m.

        ``kappa = [h^2 - h w + (v - sigma e)(2 v - sigma e)] / [h^2 + (v - sigma e)^2]^1.5``
        """
        h, g, size = self.height, self.across, self._size
        return (h * h - h * self.acceleration + g * (g + self.velocity)) / (size * size * size)

    def height_for(self, min_radius: Value) -> np.ndarray:
        """Height ``h`` from which on the profile is nowhere more convex than ``min_radius``, angle by angle, m.

        ``kappa <= (h^2 + h |w| + |c|) / h^3`` with ``c = (v - sigma e)(2 v - sigma e)``; from the ``ample`` height on
        each of the three is at most a third of what is allowed.
        """
        g, w, rho = self.across, self.acceleration, min_radius + self.cam.roller_radius
        c = g * (g + self.velocity)
        ample = reduce(np.maximum, (3 * rho, np.sqrt(3 * abs(w) * rho), np.cbrt(3 * abs(c) * rho)))
        return min_from_which_on(lambda h: rho * (h**2 - h * w + c) <= (h**2 + g**2) ** 1.5, ample)

    @cached_property
    def roller_centre(self) -> np.ndarray:
        """The roller's centre in the frame of the machine, m."""
        return self.foot

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal, a unit vector from cam to roller in the frame of the machine."""
        direction = vector(-self.cam.rotation * self.across, self.height)
        return direction / self._size

    @property
    def follower(self) -> tuple[Body, ...]:
        """The stem with its roller."""
        ((name, (mouth, centre)),) = self.cranks.items()
        return *bodies.stem(name, mouth, centre), bodies.roller(name, centre, self.cam.roller_radius)

    @property
    def lever(self) -> np.ndarray:
        """``cos alpha``."""
        return self.height / self._size


TranslatingRollerCam.measures = (*ROLLER_CURVE, jump_margin, *SLIDING)
TranslatingRollerCam.makers = MAKERS
