"""Barrel (cylindrical) cam: a groove around a drum moves a roller along the drum's axis, on a slide or on an arm.

The machine's frame is the plane that touches the drum at the roller: +y is the drum's axis, to where the follower
rises, x runs around the drum; in space z is the drum's axis, and the roller's axis runs along +x.  ``sigma = +1``: the
drum turns counter-clockwise as seen along the rise, its surface passes the roller to -x, and the groove, unrolled at
the mean radius ``R``, is ``x = R phi, y = s(phi)``.

In a section at the distance ``rho`` from the drum's axis, along the roller's, the drum runs through the plane as a
straight rack with the speed ``rho``: normal, pressure angle and flank there are those of the envelope in space, also of
a roller beside the drum's axis.  Unrolled, the path of a roller on an arm is that of its place in the plane, which
leaves the drum's surface by a few tenths of a millimetre; points in space have no such error.  The force acts at the
mean radius, in the plane: what the roller's pin and the guide bear across it is not counted.

Source: Norton, Cam Design and Manufacturing Handbook (barrel cams); Litvin, Fuentes, Gear Geometry and Applied Theory
(curvature of an envelope, undercut); checked against brute-force geometry in space.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property, reduce
from typing import Any, ClassVar

import numpy as np

from ..geometry import Body, Cylinder, Shape, rotated, vector
from ..motion import MotionProgram, motion_in
from ..quantities import Design, Measure, choice, quantity, text_if, unless
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import deg, mm
from . import bodies
from .directions import ROTATIONS
from .follower_measures import ROLLER_CURVE, jump_margin
from .followers import RockingAnalysis, SlidingAnalysis, comes_back, over_the_motion, rise_and_return
from .loads import ArmLoad, Friction
from .lubricated_pair import AnyContact, contact_choice
from .measures import ROCKING, SLIDING, base_radius, number, over_cam
from .roller_analysis import RollerAnalysis
from .shaking import MAKERS
from .slide import SlideFriction, SlideLoad
from .statics import Vector

CLOSURES = {"groove": True, "end face": False}
"""A groove has both flanks; the end of a drum has the lower one, to which a spring or a weight holds the roller."""


@dataclass(frozen=True)
class Drum(Design, ABC):
    """A drum that moves a roller along its axis.

    ``groove_depth`` is the length on which roller and flank touch, the mean radius in its middle.
    """

    motion: MotionProgram
    mean_radius: float = quantity("R", 60, 20, 200, "mm", "drum's axis to the middle of the groove's depth")
    groove_depth: float = quantity("d", 12, 0, 50, "mm", "along the roller; 0: all at the mean radius", at_least=0)
    roller_radius: float = quantity("r_T", 8, 0, 40, "mm", "roller; 0 is a knife edge", at_least=0)
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns, seen along the rise")
    groove: bool = choice("g", True, CLOSURES, "what guides the roller: a groove, or a drum's end and a spring")
    """Whether the roller runs in a groove, or (``False``) on a drum's end, to which a spring or a weight holds it."""
    contact: AnyContact = contact_choice()

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(comes_back(self.motion, "barrel cam"))
        if refuse := unless(self.bottom_radius > 0):
            refuse(
                f"the groove is {self.groove_depth / mm:.4g} mm deep around {self.mean_radius / mm:.4g} mm; its bottom "
                "must stay above 0 mm from the drum's axis"
            )
        self._keep(self.bottom_radius > 0)

    @property
    def bottom_radius(self) -> Value:
        """Drum's axis to the inner end of the roller, m."""
        return self.mean_radius - self.groove_depth / 2

    @property
    def surface_radius(self) -> Value:
        """Drum's axis to its surface, m."""
        return self.mean_radius + self.groove_depth / 2

    @abstractmethod
    def analyse(self, n: int = 721) -> DrumAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""


@dataclass(frozen=True)
class BarrelCam(Drum):
    """A barrel cam that moves a sliding follower along its axis, through a roller in a groove or on the drum's end.

    ``motion`` gives the follower's level.

    >>> alpha = BarrelCam().analyse().pressure_angle  # 50 mm in 120 deg around a radius of 60 mm, cycloidal
    >>> print(f"{np.degrees(alpha.max()):.3f} deg")
    38.512 deg

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a roller as large as the groove's bottom.
    """

    motion: MotionProgram = motion_in("mm", 50, 120, lambda: rise_and_return(50 * mm))
    load: SlideLoad = field(default_factory=lambda: SlideLoad(spring_rate=0.0, preload=0.0))
    friction: SlideFriction = field(default_factory=SlideFriction)

    name: ClassVar[str] = "sliding roller on a drum"
    offset: ClassVar[float] = 0.0
    start_height: ClassVar[float] = 0.0

    def analyse(self, n: int = 721) -> BarrelAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(BarrelAnalysis, self, n)


@dataclass(frozen=True)
class OscillatingBarrelCam(Drum):
    """A barrel cam that rocks an arm through a roller; the arm swings in a plane along the drum, beside its axis.

    ``motion`` gives the arm's angle beyond ``start_angle``, which the arm has at the motion's level 0; at 0 it stands
    at right angles to the drum's axis.

    >>> analysis = OscillatingBarrelCam().analyse()
    >>> print(f"{abs(analysis.roller_centre[0]).max() / mm:.2f} mm beside the axis")
    1.50 mm beside the axis

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a roller that passes beside the drum.
    """

    motion: MotionProgram = motion_in("deg", 30, 90, lambda: rise_and_return(30 * deg))
    centre_distance: float = quantity("a", 82.5, 20, 250, "mm", "drum's axis to arm pivot, beside it", above=None)
    arm_length: float = quantity("l", 84, 20, 250, "mm", "arm pivot to roller centre")
    start_angle: float = quantity(
        "psi_0", -15, -60, 60, "deg", "arm's angle from the cross-section of the drum at the level 0", above=None
    )
    load: ArmLoad = field(default_factory=ArmLoad)
    friction: Friction = field(default_factory=Friction)

    name: ClassVar[str] = "rocking roller on a drum"

    def analyse(self, n: int = 721) -> OscillatingBarrelAnalysis:
        """Geometry and forces at ``n`` cam angles over the motion's whole span."""
        return over_the_motion(OscillatingBarrelAnalysis, self, n)


@dataclass(frozen=True)
class DrumAnalysis(RollerAnalysis):
    """What follows from a `Drum` at the given cam angles; what is ``at`` a radius is so in that section."""

    cam: Any

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]:
        """What any cam shows, with the development and the drum in space in place of its plane picture."""
        return ("shapes", "development", *super().offers[1:], AnalysisCurve("skid", "%", "skid"))

    @property
    @abstractmethod
    def place(self) -> tuple[Array, Array]:
        """Where the motion has the roller's centre in the machine's frame, whether it can be built or not, m."""

    @property
    @abstractmethod
    def way(self) -> Vector:
        """The direction in which the roller goes for a growing level, a unit vector."""

    @property
    def swing_radius(self) -> Value:
        """How far the roller goes for a level of 1: 1, or the length of its arm, m."""
        return getattr(self.cam, "arm_length", 1.0)

    @cached_property
    def roller_centre(self) -> np.ndarray:
        """The roller's centre in the frame of the machine, m."""
        return vector(*(np.where(self.buildable, x, np.nan) for x in self.place))

    @cached_property
    def centre_velocity(self) -> tuple[Array, Array]:
        """Of the roller's centre, per speed of the cam, m."""
        (x, y), speed = self.way, self.swing_radius * self.velocity
        return speed * x, speed * y

    @property
    def clear(self) -> Array:
        """Where the roller is on the drum, and the drum's surface faster than the roller goes around it."""
        there = abs(self.place[0]) + self.cam.roller_radius < self.cam.bottom_radius
        return there & (self._past(self.cam.bottom_radius)[0] > 0)

    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""
        r, beside, bottom = self.cam.roller_radius, np.max(abs(self.place[0])), self.cam.bottom_radius
        return text_if(
            r + beside >= bottom,
            f"the roller of radius {r / mm:.4g} mm comes up to {beside / mm:.4g} mm beside the drum's axis; both "
            f"together must stay below the {bottom / mm:.4g} mm of the groove's bottom",
            "the arm carries the roller around the drum as fast as the drum turns; it must be slower",
        )

    def surface_velocity(self, point: Vector) -> Vector:
        """Velocity of the drum's surface at the mean radius, per speed of the cam, m."""
        return -self.cam.rotation * self.cam.mean_radius, 0.0

    def _past(self, radius: Value) -> tuple[Array, Array]:
        """Velocity of the roller's centre past the drum at ``radius``, around it and along it, m."""
        around, along = self.centre_velocity
        return self.cam.rotation * around + radius, along

    def rolling(self, radius: Value) -> Array:
        """Speed at which the drum runs past the roller at ``radius``, per speed of the cam, m."""
        return np.hypot(*self._past(radius))

    def normal_at(self, radius: Value) -> np.ndarray:
        """The contact normal at ``radius``, a unit vector from cam to roller."""
        around, along = self._past(radius)
        return vector(-self.cam.rotation * along, around) / self.rolling(radius)

    def pressure_angle_at(self, radius: Value) -> Array:
        """`pressure_angle` at ``radius``, rad: the nearer to the drum's axis, the larger."""
        (wx, wy), (nx, ny) = self.way, self.normal_at(radius)
        return np.arctan2(self.cam.rotation * (wx * ny - wy * nx), wx * nx + wy * ny)

    def _acceleration_along(self, normal: Vector) -> Array:
        """Part along ``normal`` of the roller centre's acceleration, per speed of the cam squared, m."""
        return self.swing_radius * self.acceleration * _product(self.way, normal)

    def bend_at(self, side: Value, radius: Value) -> Array:
        """`bend` at ``radius``, 1/m: ``(e a + e_x x + 2 r e_x^2) / (D^2 + r^2 e_x^2)``, ``e = -side n``.

        ``e`` leads from the roller's axis to where it touches, ``D`` is the speed of `rolling`, ``a`` the acceleration
        of the roller's centre, ``x`` how far that is beside the axis.  ``e a / D^2`` is the curvature of the groove
        unrolled at that radius; the rest is what the drum's roundness adds.
        """
        normal, r = self.normal_at(radius), self.cam.roller_radius
        twist = r * normal[0] * normal[0]
        flat = side * (self._acceleration_along(normal) + normal[0] * self.roller_centre[0])
        return (2 * twist - flat) / (self.rolling(radius) ** 2 + r * twist)

    def bend(self, side: Value) -> Array:
        """Curvature that a flank is parallel to across the line of contact, where along the roller it is largest, 1/m.

        At the bottom, at the surface, or where the roller goes ``sqrt(2)`` times as fast along the drum as around it.
        """
        low, high = self.cam.bottom_radius, self.cam.surface_radius
        between = np.clip(abs(self.centre_velocity[1]) / np.sqrt(2), low, high)
        return reduce(np.maximum, (self.bend_at(side, radius) for radius in (low, between, high)))

    @cached_property
    def normal(self) -> np.ndarray:
        """The contact normal at the mean radius, a unit vector from cam to roller in the frame of the machine."""
        return self.normal_at(self.cam.mean_radius)

    @cached_property
    def pressure_angle(self) -> np.ndarray:
        """``alpha`` at the mean radius, > 0 where the normal leans as the drum's surface runs; ``tan a = v / R``."""
        return self.pressure_angle_at(self.cam.mean_radius)

    @cached_property
    def curvature(self) -> np.ndarray:
        """Of the groove unrolled at the mean radius, convex > 0, 1/m: on a slide ``-w R / (R^2 + v^2)^1.5``."""
        return -self._acceleration_along(self.normal) / self.rolling(self.cam.mean_radius) ** 2

    @property
    def lever(self) -> np.ndarray:
        """``cos alpha``, of an arm ``l cos alpha``."""
        return self.swing_radius * _product(self.way, self.normal)

    @property
    def bottom_pressure_angle(self) -> Array:
        """``tan alpha = v / rho`` on a slide: at the groove's bottom it is the steepest."""
        return self.pressure_angle_at(self.cam.bottom_radius)

    @property
    def rolling_cone(self) -> Value:
        """``arctan(r_T / R)``: half angle of a roller with its tip on the drum's axis, without skid in a dwell, rad."""
        return np.arctan2(self.cam.roller_radius, self.cam.mean_radius)

    @property
    def skid(self) -> Array:
        """By how much the drum runs faster past the roller's outer end than past its inner one, over the mean."""
        inner, mean, outer = map(self.rolling, (self.cam.bottom_radius, self.cam.mean_radius, self.cam.surface_radius))
        return (outer - inner) / mean

    def on_cam(self, points: np.ndarray) -> np.ndarray:
        """Points of the machine's frame as they lie on the unrolled drum at each cam angle."""
        return vector(points[0] + self.cam.mean_radius * self.turn, points[1])

    @property
    def period(self) -> np.ndarray:
        """From a point of the unrolled drum to the same point a turn on, ``(2,)``, m."""
        return vector(2 * np.pi * self.cam.rotation * self.cam.mean_radius, 0.0)

    def in_space(self, radius: Value, side: int = 0) -> np.ndarray:
        """Where the roller's axis is at ``radius`` on the drum, or touches its lower (1) or upper (-1) flank, m."""
        (x, y), normal, r = self.roller_centre, self.normal_at(radius), side * self.cam.roller_radius
        return vector(*rotated(vector(radius, x - r * normal[0]), self.turn), y - r * normal[1])

    @property
    def path(self) -> np.ndarray:
        """The roller's centre at the groove's bottom, in space, m."""
        return self.in_space(self.cam.bottom_radius)

    @property
    def points_in_space(self) -> dict[str, np.ndarray]:
        """The groove's centre line at the mean radius, and both edges of every flank, for a milling machine, m."""
        edges = {"bottom": self.cam.bottom_radius, "surface": self.cam.surface_radius}.items()
        sides = (("lower", 1), ("upper", -1)) if self.groove else (("lower", 1),)
        flanks = {f"{flank} flank {edge}": self.in_space(r, side) for flank, side in sides for edge, r in edges}
        return {"groove": self.in_space(self.cam.mean_radius)} | flanks

    @property
    def ends(self) -> tuple[Array, Array]:
        """Both ends of the drum as it is drawn, m."""
        y, room = self.roller_centre[1], 2 * self.cam.roller_radius + self.cam.groove_depth / 2
        return np.min(y) - room, np.max(y) + room

    @property
    def development(self) -> tuple[Body, ...]:
        """The unrolled drum of one design with its groove, and the follower where it is on it over the turn."""
        return (*bodies.unrolled(self, self.groove, *self.ends), *self.follower)

    bodies = development

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """The drum of one design with its groove in space, and the roller over the turn."""
        x, y = self.roller_centre
        outer = self.cam.surface_radius + self.cam.groove_depth / 2
        pin = np.stack([vector(self.cam.bottom_radius, x, y), vector(outer, x, y)], axis=1)
        return *bodies.drum(self, self.groove, *self.ends), Cylinder("", "roller", self.cam.roller_radius, pin)


def _product(a: Any, b: Any) -> Any:
    """Scalar product in the plane, also of a curve and a population."""
    return a[0] * b[0] + a[1] * b[1]


@dataclass(frozen=True)
class BarrelAnalysis(SlidingAnalysis, DrumAnalysis):
    """What follows from a `BarrelCam` at the given cam angles."""

    cam: BarrelCam
    way: ClassVar[Vector] = (0.0, 1.0)

    @property
    def place(self) -> tuple[Array, Array]:
        """``(0, s)``."""
        return 0.0 * self.motion.s, self.motion.s

    @property
    def follower(self) -> tuple[Body, ...]:
        """The stem with its roller, on the unrolled drum."""
        stem = bodies.stem("follower", vector(self.pitch[0], self.bearing.mouth), self.pitch)
        return *stem, bodies.roller("follower", self.pitch, self.cam.roller_radius)


@dataclass(frozen=True)
class OscillatingBarrelAnalysis(RockingAnalysis, DrumAnalysis):
    """What follows from an `OscillatingBarrelCam` at the given cam angles."""

    cam: OscillatingBarrelCam

    @cached_property
    def way(self) -> tuple[Array, Array]:
        """``(sin psi, cos psi)``."""
        psi = self.cam.start_angle + self.motion.s
        return np.sin(psi), np.cos(psi)

    @property
    def place(self) -> tuple[Array, Array]:
        """``(a - l cos psi, l sin psi)``, m."""
        (sin, cos), l = self.way, self.cam.arm_length
        return self.cam.centre_distance - l * cos, l * sin

    @cached_property
    def arm_angle(self) -> np.ndarray:
        """``psi``: the arm's angle from the drum's cross-section, rad."""
        return np.where(self.buildable, self.cam.start_angle + self.motion.s, np.nan)

    def _acceleration_along(self, normal: Vector) -> Array:
        """Also of the swing: ``l v^2`` to the pivot."""
        (sin, cos), v = self.way, self.velocity
        return super()._acceleration_along(normal) + self.cam.arm_length * v * v * _product((cos, -sin), normal)

    @property
    def follower(self) -> tuple[Body, ...]:
        """The arm with its roller, on the unrolled drum."""
        arm = bodies.rocker("arm", self.on_cam(vector(self.cam.centre_distance, 0.0)), self.pitch)
        return *arm, bodies.roller("arm", self.pitch, self.cam.roller_radius)


_BOTTOM, _CONE = "maximum pressure angle, groove's bottom", "half angle of a conical roller that does not skid"
bottom_pressure_angle = over_cam(_BOTTOM, "deg", lambda a: abs(a.bottom_pressure_angle))
peak_skid = over_cam("skid of the roller's ends", "%", lambda a: a.skid)
rolling_cone = Measure(_CONE, "deg", lambda a: number(a.rolling_cone))
DRUM = (*ROLLER_CURVE, jump_margin, bottom_pressure_angle, peak_skid, rolling_cone)
BarrelCam.measures, OscillatingBarrelCam.measures = (
    tuple(measure for measure in (*DRUM, *moved) if measure is not base_radius) for moved in (SLIDING, ROCKING)
)
BarrelCam.makers = OscillatingBarrelCam.makers = MAKERS
