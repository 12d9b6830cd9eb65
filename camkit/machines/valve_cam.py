"""Valve cam whose lift is a high-order polynomial of the cam angle.

Over the opening flank, with ``b = 1 - alpha / alpha_B`` from 1 at its start to 0 at the nose,

    h = C_0 + C_p b^p + C_q b^q + C_r b^r + C_s b^s,   p = 2,  q = 2n,  r = 2n + 2m,  s = 2n + 4m

The closing flank mirrors it; a ramp on either side takes up the lash between base circle and flank.

Source: He Zhenjun, Li Xuefeng, Mech. Sci. Technol. Aerosp. Eng. 27(10) 2008, 1141-1144.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from ..cam.force_closure import ContactPair
from ..cam.lubricated_pair import LubricatedPair
from ..cam.slide import SlideFriction
from ..motion import Mirrored, MotionProgram, Return, Rise
from ..quantities import Design, choice, counted, quantity, unless
from ..quantities.kinds import one_number
from ..quantities.types import Array, Value
from ..units import deg, mm
from .valve_analysis import ValveAnalysis
from .valve_motion import BLEND, Flank, Ramp
from .valve_train import FLAT, FOLLOWERS, ValveLoad

LEAST_GAP = 1e-3
"""Exponents closer than this count as repeated: the coefficients would be the difference of huge numbers."""
CONTACTS = ContactPair(width=14 * mm), LubricatedPair(width=14 * mm)
"""What can be said of the contact, for a menu."""


@dataclass(frozen=True)
class ValveCam(Design):
    """Cam of an engine valve: ramp, flank, nose, mirrored flank, ramp, base circle (defaults: the paper's data).

    ``base_radius`` is where the working flank begins, at lift 0; the base circle itself lies lower by the
    `ramp_height`, which is the lash that the ramp takes up.  ``seating_velocity`` is the follower's at that point.
    The train (mass, spring, widths, materials) is not the paper's; its defaults are those of a truck engine.

    >>> cam = ValveCam(n=20, m=20).analyse()
    >>> print(f"{cam.fullness:.6f}, {cam.nose_acceleration:.3f} m/s^2, {cam.profile_margin.value / mm:.3f} mm")
    0.638393, -862.722 m/s^2, 1.159 mm

    Raises ``ValueError`` for exponents that repeat and for sizes that cannot be built.
    """

    n: float = quantity("n", 6, 3, 20, "", "second exponent 2n", above=1)
    m: float = quantity("m", 16, 1, 20, "", "third and fourth exponent 2n + 2m, 2n + 4m")
    max_lift: float = quantity("h_max", 13, 5, 20, "mm", "lift at the nose")
    half_angle: float = quantity("alpha_B", 62, 40, 90, "deg", "cam angle of one flank, start to nose")
    seating_velocity: float = quantity("v_g", 0.2, 0, 0.6, "m/s", "follower where the flank begins", at_least=0)
    base_radius: float = quantity("r_0", 21, 12, 40, "mm", "cam axis to follower where the flank begins")
    ramp_angle: float = quantity("alpha_r", 25, 5, 60, "deg", "cam angle of one ramp")
    follower: Any = choice("follower", FLAT, FOLLOWERS, "what rides on the cam")
    roller_radius: float = quantity("r_r", 10, 3, 25, "mm", "roller, where there is one")
    speed_margin: float = quantity("x", 15, 0, 60, "%", "overspeed that must not make the follower jump", at_least=0)
    load: ValveLoad = field(default_factory=ValveLoad)
    """The train and the spring above the cam, and the camshaft's speed."""
    contact: ContactPair = choice("C", CONTACTS[0], CONTACTS, "materials and length of the line of contact")
    """The materials of cam and follower and the length of the line on which they touch; lubricant and strength."""

    offset: ClassVar[float] = 0.0
    """The follower travels in line with the cam axis."""
    rotation: ClassVar[int] = 1
    """Counter-clockwise."""
    groove: ClassVar[bool] = False
    """A plate: the spring holds the follower to it."""
    friction: ClassVar[SlideFriction] = SlideFriction(0, 0, 0, 0)
    """None is counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if refuse := unless(self._exponents_differ):
            refuse(
                f"the exponents are {', '.join(f'{e:.6g}' for e in self._exponents)}; "
                f"each must lie at least {LEAST_GAP:g} above the one before"
            )
        if refuse := unless(self._fits_the_turn):
            refuse(
                f"two flanks and two ramps need {2 * (self.half_angle + self.ramp_angle) / deg:.4g} deg of the cam; "
                "there are 360 deg"
            )
        if refuse := unless(self.base_radius > self.ramp_height):
            refuse(
                f"the base radius is {self.base_radius / mm:.4g} mm and the ramp {self.ramp_height / mm:.4g} mm high; "
                "the base circle must keep some radius"
            )
        self._keep(self._exponents_differ & self._fits_the_turn & (self.base_radius > self.ramp_height))

    @property
    def _exponents(self) -> tuple[Value, ...]:
        """``p, q, r, s``."""
        return 2.0, 2.0 * self.n, 2.0 * self.n + 2.0 * self.m, 2.0 * self.n + 4.0 * self.m

    @property
    def _exponents_differ(self) -> bool | Array:
        p, q, r, s = self._exponents
        return (q - p >= LEAST_GAP) & (r - q >= LEAST_GAP) & (s - r >= LEAST_GAP)

    @property
    def _fits_the_turn(self) -> bool:
        return self.half_angle + self.ramp_angle <= np.pi * (1 + 1e-12)

    @property
    def seating_slope(self) -> Value:
        """``h'(0) = v_g / omega``, m/rad."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.divide(self.seating_velocity, self.load.speed)

    @property
    def ramp_height(self) -> Value:
        """Lift of the ramp: from the base circle to the start of the flank, m."""
        return self.seating_slope * self.ramp_angle * (1 - BLEND / 2)

    @cached_property
    def flank(self) -> Flank:
        """The lift's polynomial, for a lift of 1; ``nan`` where a member of a population cannot be built."""
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = self.seating_slope * self.half_angle / self.max_lift
        return Flank.of(self._exponents, slope)

    @cached_property
    def motion(self) -> MotionProgram:
        """Lift and its derivatives by cam angle over a turn that begins with the opening flank.

        The ramps and the base circle have negative lift.
        """
        aside, height = np.pi - self.half_angle, self.ramp_height
        with np.errstate(divide="ignore", invalid="ignore"):
            ramp = Ramp(self.ramp_angle / aside)
        return MotionProgram(
            (
                *self.opening.segments,
                Return(self.half_angle, self.max_lift, Mirrored(self.flank)),
                Return(aside, height, Mirrored(ramp)),
                Rise(aside, height, ramp),
            )
        )

    @cached_property
    def opening(self) -> MotionProgram:
        """The opening flank alone."""
        return MotionProgram((Rise(self.half_angle, self.max_lift, self.flank),))

    @property
    def start_height(self) -> Value:
        """Cam axis to the roller's centre where the flank begins, m."""
        return self.base_radius + self.roller_radius

    def analyse(self, n: int = 721) -> ValveAnalysis:
        """The opening flank at ``n`` cam angles; `ValveAnalysis.whole` is the whole cam."""
        angles: np.ndarray = np.linspace(0, 1, counted(n, "cam angles")) * self.half_angle
        return self.follower.analysis(self, angles)

    def with_spring(self, preload_share: float = 0.4) -> ValveCam:
        """The same cam under the weakest spring that holds the follower on it up to the speed margin.

        Its preload is ``preload_share`` of its force at full lift.

        >>> from camkit.cam import jump_speed
        >>> cam = ValveCam().with_spring()
        >>> print(f"{jump_speed(cam.analyse()) / cam.load.speed:.4f}")
        1.1500
        """
        must = "lie above 0, up to 1"
        preload_share = one_number(preload_share, "the preload's share of the full force", must)
        if not 0 < preload_share <= 1:
            raise ValueError(
                f"the preload's share of the full force is {preload_share:g}; it must lie above 0, up to 1"
            )

        def lacking(at: ValveAnalysis) -> Value:
            share = preload_share + (1 - preload_share) * at.lift / self.max_lift
            return np.maximum(at.needed_at(at.top_speed) - at.other_force, 0) / share

        force = self.analyse(2).highest(lacking).value
        force = float(force) if np.ndim(force) == 0 else force[..., None]
        rate, preload = (1 - preload_share) * force / self.max_lift, preload_share * force
        return self.replace(load=self.load.replace(spring_rate=rate, preload=preload))
