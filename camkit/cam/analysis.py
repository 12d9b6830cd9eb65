"""What the analyses of all disk cams share, whatever follows the cam.

The cam axis is the origin of the machine's frame; ``sigma`` = +1: the cam turns counter-clockwise.  A follower's
module adds where it touches the cam, the contact normal there, its pressure angle and its curvature.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np

from ..extrema import Extreme, crests
from ..geometry import Body, rotated
from ..motion import Kinematics, Law, MotionProgram
from ..motion.closing import TURN
from ..motion.resolution import ROUGH, STEPS, Resolution, resolve
from ..quantities import quantities_of, unless
from ..quantities.kinds import columns
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from . import bodies, corners, drive, extremes, statics, undercut
from .force_closure import ContactPair, contact_along, index_of_wear
from .measures import number
from .surfaces import Surfaces

OFFERS = ("bodies", "motion", "pressure_angle", "contact_force", "cam_torque", "curvature", "efficiency")
"""The shapes and curves of any cam with its follower that are shown where nobody chooses, in this order."""


@dataclass(frozen=True)
class CamAnalysis(ABC):
    """What follows from a disk cam at the given cam angles.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``; points ``(2, n)`` and ``(2, p, n)``.  Each is
    computed when first asked for.  ``nan`` where a member of a population cannot be built.
    """

    cam: Any
    cam_angle: np.ndarray
    rough: bool = field(default=False, kw_only=True)
    """Whether peaks may be a few tenths of a per cent off, as in the first rounds of a search."""
    acceleration_unit: ClassVar[str] = "mm/rad^2"
    """In which the follower's acceleration by the cam angle is shown."""

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]:
        """The shapes and curves that are shown of it where nobody chooses, in this order."""
        return (*OFFERS, *self.shaped, *self.cam.contact.offers, *getattr(self.cam.motion, "offers", ()))

    @property
    def shaped(self) -> tuple[AnalysisCurve, ...]:
        """The curve of its acceleration, where a motion law has coefficients: they shape it."""
        laws = (getattr(segment, "law", None) for segment in self.cam.motion.segments)
        coefficients = any(isinstance(law, Law) and quantities_of(law) for law in laws)
        return (AnalysisCurve("acceleration", self.acceleration_unit, "acceleration"),) if coefficients else ()

    @property
    def trouble(self) -> str:
        """What is lost of the profile, in a sentence; empty if nothing is."""
        return undercut.undercut_in_words(self)

    @property
    @abstractmethod
    def clear(self) -> Value:
        """At which of the cam angles the design can be built."""

    @abstractmethod
    def refusal(self) -> str:
        """Why it cannot be built, in a sentence."""

    def at(self, cam_angle: Array) -> Self:
        """The same cam at other cam angles."""
        other = replace(self, cam_angle=cam_angle)
        other.__dict__.update(resolved=self.resolved, resolution=self.resolution)  # cached: the cam has one
        return other

    @property
    def program(self) -> MotionProgram:
        """The motion over which extremes are looked for: all of the cam's."""
        motion: MotionProgram = self.cam.motion
        return motion

    def steps(self) -> int:
        """Into how many even steps a segment that moves is divided."""
        return ROUGH if self.rough else STEPS

    @cached_property
    def resolution(self) -> Resolution:
        """The cam angles that show every stretch of the motion, however narrow, with its joints from both sides.

        Those of the load's tables, too.
        """
        load, motion, steps = getattr(self.cam, "load", None), self.program, self.steps()
        angles, levels = (getattr(load, name, ()) for name in ("cam_angle_table", "travel_table"))
        if steps == STEPS and not (len(angles) or len(levels)):
            return motion.resolution
        return resolve(motion, steps, [x for x, _ in angles], [x for x, _ in levels])

    @cached_property
    def resolved(self) -> Self:
        """The same cam at the cam angles of its `resolution`."""
        other = replace(self, cam_angle=self.resolution.angle)
        motion = self.program.over(self.resolution)
        other.__dict__.update(resolved=other, resolution=self.resolution, motion=motion)
        return other

    @cached_property
    def buildable(self) -> Array:
        """Whether the design can be built, ``(..., 1)``."""
        return np.all(self.clear, axis=-1, keepdims=True) if self is self.resolved else self.resolved.buildable

    def refuse_impossible(self, before: Callable[[], str] = str) -> None:
        """``ValueError`` in a sentence, with words ``before`` it, if this is one design and it cannot be built."""
        if not columns(self.cam) and (refuse := unless(self.buildable[..., 0])):
            refuse(before() + self.resolved.refusal())

    @property
    @abstractmethod
    def normal(self) -> np.ndarray:
        """The contact normal, a unit vector from cam to follower in the frame of the machine."""

    @property
    @abstractmethod
    def pressure_angle(self) -> np.ndarray:
        """``alpha``, signed: between the contact normal and the way the follower goes where it is touched, rad."""

    @property
    @abstractmethod
    def profile_radii(self) -> Array:
        """Radii of curvature of the profile at `seen_at`, m."""

    @property
    @abstractmethod
    def profile_margin(self) -> Extreme:
        """Least convex radius of curvature of the profile, m; at or below 0 the follower cuts the cam away."""

    @abstractmethod
    def contact_point(self, flank: Value = 1) -> np.ndarray:
        """Where the follower touches the inner flank (+1) or a groove's outer one (-1), machine's frame, m."""

    @property
    @abstractmethod
    def driving_flank(self) -> Value:
        """The flank that gives the follower its motion: +1 the inner one, -1 a groove's outer one."""

    @property
    @abstractmethod
    def loaded_flank(self) -> Value:
        """The flank that gives the contact force."""

    @property
    @abstractmethod
    def fit(self) -> np.ndarray:
        """Curvature of cam and follower together where they press on each other, 1/m; not above 0: undercut."""

    @property
    @abstractmethod
    def surface_rates(self) -> tuple[Array, Array]:
        """How fast the contact runs along the profile, and the cam's surface past the follower's, per speed, m."""

    @property
    @abstractmethod
    def lean(self) -> Value:
        """Angle by which the force of a contact that is not smooth leans from the normal, rad."""

    @property
    @abstractmethod
    def bearing(self) -> statics.Bearing:
        """What leads the follower."""

    @property
    @abstractmethod
    def lever(self) -> np.ndarray:
        """Load on the follower that a smooth contact force of 1 N carries, 1 or m."""

    @property
    @abstractmethod
    def inertia(self) -> Array:
        """Mass (kg) of a sliding follower, moment of inertia (kg m^2) of an arm."""

    @property
    def preload(self) -> Value:
        """What of `static_resistance` is the spring's preload, N, or N m for an arm."""
        return self.cam.load.preload

    @property
    def closing_rate(self) -> Value:
        """By how much `static_resistance` grows with the travel through the spring, N/m, or N m/rad for an arm."""
        return self.cam.load.spring_rate

    @property
    def speed(self) -> Value:
        """At which the cam turns, rad/s."""
        return self.cam.load.speed

    @property
    @abstractmethod
    def static_resistance(self) -> np.ndarray:
        """What resists the follower's travel besides inertia, N, or N m for an arm."""

    @property
    @abstractmethod
    def resistance(self) -> np.ndarray:
        """What resists the follower's travel, N, or N m for an arm."""

    @cached_property
    def _found(self) -> dict[tuple[Callable[[Self], Value], int], Extreme]:
        """What `highest` (1) and `lowest` (-1) have found: an objective and a limit often ask for the same peak."""
        return {}

    @cached_property
    def motion(self) -> Kinematics:
        """The follower's travel and its derivatives with respect to the cam angle, ``s, v, a, j`` (m or rad)."""
        return self.cam.motion(self.cam_angle)

    @property
    def curves(self) -> dict[str, CamAnalysis]:
        """Every cam curve of the machine by its name: this one."""
        return {"cam": self}

    @property
    def bodies(self) -> tuple[Body, ...]:
        """What is drawn of one design: the cam, and the follower over the turn."""
        return (*bodies.disk(self, self.groove), *self.follower)

    @property
    @abstractmethod
    def follower(self) -> tuple[Body, ...]:
        """The follower's bodies."""

    curvature_limit: ClassVar[str] = "1 / roller radius"
    """What `max_curvature` is, for a legend; empty where there is no such limit."""

    @property
    @abstractmethod
    def max_curvature(self) -> Value:
        """The largest curvature of the pitch curve, convex or concave, that the follower can run on, 1/m."""

    @property
    def stretch(self) -> np.ndarray:
        """The name of the stretch of the profile to which each point belongs."""
        return np.full(self.cam_angle.shape[-1], "cam")

    @property
    def profile_angle(self) -> np.ndarray:
        """The cam angle at which the follower touches each point of the profile, rad."""
        return self.cam_angle

    @property
    def turn(self) -> np.ndarray:
        """How far the cam has turned counter-clockwise at each cam angle, rad."""
        return self.cam.rotation * self.cam_angle

    @property
    def velocity(self) -> np.ndarray:
        """``v = ds/dphi``, or ``dpsi/dphi`` of an arm."""
        return self.motion.v

    @property
    def acceleration(self) -> np.ndarray:
        """``w = d2s/dphi2``, or ``d2psi/dphi2`` of an arm."""
        return self.motion.a

    @property
    def jerk(self) -> np.ndarray:
        """``d3s/dphi3``, or ``d3psi/dphi3`` of an arm."""
        return self.motion.j

    def on_cam(self, points: np.ndarray) -> np.ndarray:
        """Points of the machine's frame as they lie on the cam at each cam angle."""
        return rotated(points, -self.turn)

    def surface_velocity(self, point: statics.Vector) -> statics.Vector:
        """Velocity of the cam's surface at ``point``, per speed of the cam, m."""
        sigma = self.cam.rotation
        return -sigma * point[1], sigma * point[0]

    @cached_property
    def contact_force(self) -> np.ndarray:
        """Force between cam and follower without friction, N; < 0 where only a groove's outer flank can give it."""
        return self.resistance / self.lever

    @cached_property
    def cam_torque(self) -> np.ndarray:
        """Torque on the cam without friction, N m: power in = power out."""
        return self.resistance * self.velocity

    turning = cached_property(drive.turning)
    torque_sweep = drive.torque_sweep

    @cached_property
    def contact_pressure(self) -> np.ndarray:
        """Largest Hertz pressure between cam and follower, Pa (see `contact_along`); ``nan`` without a ``contact``."""
        pair = self.cam.contact
        return contact_along(self, pair).pressure if isinstance(pair, ContactPair) else np.nan * self.contact_force

    @property
    def wear_index(self) -> np.ndarray:
        """``F sqrt(F kappa)``, force times index of stress, N^1.5 m^-0.5; ``nan`` where there is no contact."""
        return index_of_wear(self.contact_force * self.loaded_flank, self.fit)

    @cached_property
    def surfaces(self) -> Surfaces:
        """How both surfaces run past each other, their film and their wear."""
        return Surfaces(self)

    @cached_property
    def rubbing(self) -> statics.Rubbing:
        """Contact force and cam torque with friction."""
        return statics.rubbing(self)

    @cached_property
    def efficiency(self) -> np.ndarray:
        """Power out over power in, from the free-body diagram: cam to follower, or back where it drives the cam."""
        return statics.efficiency(self, self.driving_flank)

    @property
    @abstractmethod
    def groove(self) -> bool:
        """Whether the follower runs in a groove."""

    @property
    def form_closed(self) -> Value:
        """Whether a groove alone holds the follower, from both sides, and no spring does: it cannot jump."""
        return self.groove and number(self.closing_rate + self.preload) == 0

    @cached_property
    def _corners(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """By how much the speed of the follower jumps from each piece of the motion to the next, and where.

        ``(..., k)``; the last one leads back to the first.  A leap of the follower itself counts as both ways.
        """
        return corners.corners(self.resolved, self.resolution, self.program)

    def corner(self, way: int) -> Extreme:
        """The largest jump of the follower's speed, upwards (``way`` = 1) or downwards (-1), m/rad or 1; 0: none."""
        jumps, leaps, angle = self._corners
        size = np.maximum(way * jumps, leaps)
        most = np.argmax(size, axis=-1, keepdims=True)
        return Extreme(*(np.take_along_axis(x, most, -1)[..., 0] for x in np.broadcast_arrays(size, angle)))

    @property
    def bumps(self) -> Value:
        """Whether the speed of the follower jumps, by an acceleration without end."""
        return np.maximum(self.corner(1).value, self.corner(-1).value) > 0

    @property
    def struck(self) -> Value:
        """Whether it jumps while the cam turns and the follower has mass, by a force without end."""
        speed = getattr(self.cam.load, "speed", 1.0)  # one that does not say it always turns
        return self.bumps & (np.max(self.inertia, axis=-1) > 0) & (number(speed) != 0)

    def between(self, low: float, high: float) -> Self:
        """The same cam seen between two cam angles (rad) alone: extremes are those there.

        From 350 to 10 deg it is seen past the start of the turn, from 30 to 30 deg there alone.
        """
        if (low, high) not in self._zones:
            shown, (jumps, leaps, at) = self.resolution.between(low, high, self.program.span), self._corners
            inside = (at - low) % TURN <= (high - low) % TURN
            zone = self.at(shown.angle)
            corners = np.where(inside, jumps, 0.0), np.where(inside, leaps, 0.0), at
            zone.__dict__.update(resolved=zone, resolution=shown, buildable=self.buildable, _corners=corners)
            self._zones[low, high] = zone
        return self._zones[low, high]

    @cached_property
    def _zones(self) -> dict[tuple[float, float], Self]:
        """What `between` has made: an objective and a limit often ask for the same."""
        return {}

    def seen(self, f: Callable[[Self], Value], way: int = 1) -> Array:
        """``f(analysis)`` at `seen_at`: the largest around each (see `crests`), the least if ``way`` is -1."""
        shown = self.resolved
        values = way * crests(way * f(shown) + 0.0 * shown.cam_angle, self.resolution.inner)
        return np.where(self.buildable, values, np.nan)

    @property
    def seen_at(self) -> Array:
        """The cam angles that show every peak, rad."""
        return self.resolved.cam_angle

    def highest(self, f: Callable[[Self], Value]) -> Extreme:
        """The largest value of ``f(analysis)`` over the cam, whichever cam angles the analysis has."""
        return self._extreme(f, 1)

    def lowest(self, f: Callable[[Self], Value]) -> Extreme:
        """As `highest`, for the least value."""
        return self._extreme(f, -1)

    def _extreme(self, f: Callable[[Self], Value], way: int) -> Extreme:
        if (f, way) not in self._found:
            found = extremes.highest(self, f) if way > 0 else extremes.lowest(self, f)
            self._found[f, way] = Extreme(*(np.where(self.buildable[..., 0], x, np.nan)[()] for x in found))
        return self._found[f, way]
