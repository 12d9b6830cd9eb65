"""Two cams on one shaft that hold a follower from both sides: each pushes where the other cannot.

The second cam is cut for the same follower with the opposite motion (see `conjugate`).  There is neither play nor
preload, so where the first cam would have to pull the second one pushes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..extrema import Extreme
from ..geometry import Body, Outline, end_to_end
from ..motion.resolution import Resolution
from ..quantities import Design, choice, counted, declarations, quantity, words
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import rpm
from .analysis import CamAnalysis
from .drive import torque_sweep, turning
from .follower_measures import min_profile_radius
from .loads import ArmLoad
from .measures import DRIVE, base_radius, max_pressure_angle, mean_efficiency, peak_force, peak_torque
from .oscillating_flat import OscillatingFlatCam
from .oscillating_roller import OscillatingRollerCam
from .shaking import MAKERS
from .slide import SlideLoad
from .translating_flat import TranslatingFlatCam
from .translating_roller import TranslatingRollerCam
from .undercut import undercut_in_words

OFFERS = ("bodies", "motion", "pressure_angle", "contact_force")
SLIDE, ARM = SlideLoad(spring_rate=0, preload=0), ArmLoad(mass=0.5, speed=300 * rpm)
CAMS = (
    TranslatingRollerCam(groove=False, load=SLIDE),
    TranslatingFlatCam(load=SLIDE),
    OscillatingRollerCam(groove=False, load=ARM),
    OscillatingFlatCam(load=ARM),
)
"""First cams of a pair, for a menu: without a spring."""
SECOND: dict[type, tuple[str, ...]] = {
    TranslatingRollerCam: ("distance", "roller_radius"),
    TranslatingFlatCam: ("distance",),
    OscillatingRollerCam: ("spread", "arm_length", "roller_radius"),
    OscillatingFlatCam: ("spread", "face_offset"),
}
"""What gives the second cam of each, in the order of its ``conjugate``."""


@dataclass(frozen=True)
class ConjugatePair(Design):
    """A pair of plate cams on one shaft that move one follower to and fro.

    ``cam`` is the first with its follower and load.  Of the sizes of the second those count that its follower has.

    >>> pair = ConjugatePair().analyse()
    >>> float(pair.first.contact_force.min()) < 0 < float(pair.second.contact_force.max())
    True

    Raises ``ValueError`` for a size that cannot be built; `analyse` does where one of both cams cannot.
    """

    cam: Any = choice("F", CAMS[0], CAMS, "first cam, and the follower that both hold")
    distance: float = quantity("D", 110, 40, 300, "mm", "from one roller or face of a sliding follower to the other")
    spread: float = quantity("delta", 80, 10, 180, "deg", "from one arm or face of a rocking follower to the other")
    arm_length: float = quantity("l_2", 60, 20, 120, "mm", "second arm: pivot to roller centre")
    roller_radius: float = quantity("r_2", 8, 0, 40, "mm", "second roller; 0 is a knife edge", at_least=0)
    face_offset: float = quantity("b_2", 5, -20, 40, "mm", "second face from the pivot, away from the cam", above=None)

    def __post_init__(self) -> None:
        super().__post_init__()
        self.second  # noqa: B018 - refuses what cannot be built

    @property
    def _given(self) -> tuple[str, ...]:
        """The sizes of the second cam that count."""
        return next(names for kind, names in SECOND.items() if isinstance(self.cam, kind))

    def following(self) -> dict[str, str]:
        """Sizes that the follower does not have, and what a pair leaves no choice of."""
        sizes = {name for names in SECOND.values() for name in names}.difference(self._given)
        return {name: f"the second cam of a {self.cam.name} has none" for name in sizes} | {
            "cam.groove": "each cam of a pair is a plate"
        }

    @cached_property
    def first(self) -> Any:
        """The first cam, a plate."""
        return self.cam.replace(groove=False) if hasattr(self.cam, "groove") else self.cam

    @cached_property
    def second(self) -> Any:
        """The second cam, in a frame of its own (see ``conjugate`` of the first)."""
        return self.first.conjugate(*(getattr(self, name) for name in self._given))

    @property
    def mirrored(self) -> bool:
        """Whether the frame of the second cam is mirrored in the line of centres, or else turned by half a turn."""
        return "spread" in self._given

    def analyse(self, n: int = 721) -> ConjugatePairAnalysis:
        """Geometry and forces of both cams at ``n`` cam angles over the motion's whole span."""
        turn = np.linspace(0, 1, counted(n, "cam angles")) * self.cam.motion.span
        analysis = ConjugatePairAnalysis(self, turn)
        analysis.first.refuse_impossible()
        analysis.second.refuse_impossible(self._before)
        return analysis

    def _before(self) -> str:
        """What stands before the sentence that refuses the second cam."""
        own = declarations(self)
        sizes = ", ".join(f"the {words(name)} is {own[name].text(getattr(self, name))}" for name in self._given)
        return f"the second cam cannot be built; {sizes}: "


@dataclass(frozen=True)
class ConjugatePairAnalysis:
    """What follows from a `ConjugatePair` at the given cam angles; arrays ``(n,)`` or ``(p, n)``."""

    cam: ConjugatePair
    cam_angle: np.ndarray
    rough: bool = field(default=False, kw_only=True)
    """Whether peaks may be a few tenths of a per cent off, as in the first rounds of a search."""

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]:
        """The shapes and curves that are shown of it where nobody chooses; a force below 0 is that of the other cam."""
        return (*OFFERS, *self.shaped, *self.cam.first.contact.offers)

    @property
    def trouble(self) -> str:
        """What is lost of either profile, in a sentence; empty if nothing is."""
        return undercut_in_words(self)

    @property
    def shaped(self) -> tuple[AnalysisCurve, ...]:
        """The curve of the follower's acceleration, where a motion law has coefficients: they shape it."""
        return tuple(replace(curve, name=f"first.{curve.name}") for curve in self.first.shaped)

    @cached_property
    def first(self) -> CamAnalysis:
        """The first cam, in the machine's frame."""
        first: CamAnalysis = self.cam.first.analyse(2)
        return replace(first, cam_angle=self.cam_angle, rough=self.rough)

    @cached_property
    def second(self) -> CamAnalysis:
        """The second cam, in a frame of its own."""
        return replace(self.first, cam=self.cam.second)

    @property
    def curves(self) -> dict[str, CamAnalysis]:
        """Both cams by name."""
        return {"first": self.first, "second": self.second}

    @property
    def struck(self) -> Value:
        """Whether the speed of a follower with mass jumps."""
        return self.first.struck

    @property
    def cam_torque(self) -> np.ndarray:
        """Torque on the shaft without friction, N m, whichever cam pushes."""
        return self.first.cam_torque

    @property
    def velocity(self) -> np.ndarray:
        """``v`` of the follower as the first cam gives it."""
        return self.first.velocity

    turning = cached_property(turning)
    torque_sweep = torque_sweep

    @property
    def efficiency(self) -> np.ndarray:
        """Power out over power in: of the first cam where the follower goes out, of the second where it comes back."""
        return np.where(self.velocity > 0, self.first.efficiency, self.second.efficiency)

    @property
    def resolution(self) -> Resolution:
        """The cam angles that show every stretch of the motion."""
        return self.first.resolution

    @cached_property
    def resolved(self) -> ConjugatePairAnalysis:
        """The same pair at the cam angles of its `resolution`."""
        return replace(self, cam_angle=self.resolution.angle)

    def between(self, low: float, high: float) -> ConjugatePairAnalysis:
        """The same pair seen between two cam angles (rad) alone (see `CamAnalysis.between`)."""
        both = {name: curve.between(low, high) for name, curve in self.curves.items()}
        zone = replace(self, cam_angle=both["first"].cam_angle)
        zone.__dict__.update(both, resolved=zone)
        return zone

    def seen(self, f: Callable[[Any], Value], way: int = 1) -> Array:
        """As `highest` and `lowest` see it, at `seen_at`: of the first cam and then of the second."""
        shown = _Pushing(f) if way > 0 else f
        return end_to_end(*(curve.seen(shown, way) for curve in self.curves.values()))

    @property
    def seen_at(self) -> Array:
        """The cam angles that show every peak, rad, of the first cam and then of the second."""
        return end_to_end(*(curve.seen_at for curve in self.curves.values()))

    def highest(self, f: Callable[[Any], Value]) -> Extreme:
        """The largest value of ``f`` of one of both cams over the angles at which that cam pushes."""
        return _larger(*(curve.highest(_Pushing(f)) for curve in self.curves.values()))

    def lowest(self, f: Callable[[Any], Value]) -> Extreme:
        """The least value of ``f`` of one of both cams, wherever it pushes."""
        return _smaller(*(curve.lowest(f) for curve in self.curves.values()))

    @property
    def profile_margin(self) -> Extreme:
        """The smaller of both cams' least convex radii, m; at or below 0 the follower cuts that cam away."""
        return _smaller(*(curve.profile_margin for curve in self.curves.values()))

    @property
    def profile_radii(self) -> Array:
        """Radii of curvature of both profiles at `seen_at`, m."""
        return end_to_end(*(curve.profile_radii for curve in self.curves.values()))

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Both cams and both sides of the follower, to scale."""
        move = _mirror if self.cam.mirrored else _half_turn
        return (
            *(replace(body, name="first") for body in self.first.bodies),
            *(replace(move(body), name="second") for body in self.second.bodies),
        )


@dataclass(frozen=True)
class _Pushing:
    """A curve of a cam where that cam pushes."""

    curve: Callable[[Any], Value]

    def __call__(self, analysis: CamAnalysis) -> Array:
        return np.where(analysis.contact_force >= 0, self.curve(analysis), -np.inf)


def _larger(one: Extreme, other: Extreme) -> Extreme:
    first = (one.value >= other.value) | np.isnan(one.value)
    return Extreme(*(np.where(first, x, y)[()] for x, y in zip(one, other, strict=True)))


def _smaller(one: Extreme, other: Extreme) -> Extreme:
    first = (one.value <= other.value) | np.isnan(one.value)
    return Extreme(*(np.where(first, x, y)[()] for x, y in zip(one, other, strict=True)))


def _half_turn(body: Body) -> Body:
    """A part of the second cam of a sliding follower as it stands in the machine."""
    return replace(body, x=-body.x, y=-body.y, angle=body.angle + np.pi)


def _mirror(body: Body) -> Body:
    """A part of the second cam of a rocking follower as it stands in the machine."""
    points = {"points": body.points * np.array([[1.0], [-1.0]])} if isinstance(body, Outline) else {}
    return replace(body, y=-body.y, angle=-body.angle, **points)


ConjugatePair.measures = (
    max_pressure_angle,
    base_radius,
    min_profile_radius,
    peak_force,
    peak_torque,
    mean_efficiency,
    *DRIVE,
)
ConjugatePair.makers = MAKERS
