"""High-speed disk cam with a roller on a rocking arm: contact stress and wear, the motion law itself free.

The arm swings away over the first interval of the cam's turn, dwells, swings back over another and dwells.  The
cam is given by the arm's length ``l``, the roller's radius ``r`` and the profile's largest radius ``r_k2``; where
the arm starts and the smallest radius ``r_k1`` follow.  The stress between cam and roller grows with
``F_sigma = sqrt(N / rho_pr)``, wear with ``F_wear = N F_sigma``: ``N`` is the normal force and ``rho_pr`` the
reduced radius of both surfaces.  "Margin" is ``q = 1 - r kappa`` with the pitch curve's curvature ``kappa``.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov.  The geometry is that of `OscillatingRollerCam`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np

from ..cam import bodies
from ..cam.directions import CLOSURES, ROTATIONS
from ..cam.force_closure import ContactPair
from ..cam.loads import Friction
from ..cam.lubricated_pair import LubricatedPair
from ..geometry import Body, angle_opposite, end_to_end
from ..motion import LAW_MENU, Dwell, MotionProgram, Return, Rise, ShapedLaw
from ..quantities import Design, choice, counted, quantity, unless
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import deg, mm
from .high_speed_analysis import HighSpeedAnalysis
from .high_speed_load import ConstantTorque, InertialSpringLoad, SliderLoad

HAIR = 1e-9
"""Share of an interval by which its last angle lies before the dwell, so that the law still speaks there."""


ACCELERATION = AnalysisCurve("acceleration", "1/rad", "acceleration")
"""Of the arm by the cam angle; the coefficients of the laws shape it."""
STRONG = 12.0
"""The strongest closing spring ``K`` that a slider or a study offers."""
CONTACTS = ContactPair(width=20 * mm), LubricatedPair(width=20 * mm)
"""What can be said of the contact, for a menu."""
LOADS = InertialSpringLoad(), ConstantTorque(), SliderLoad()
"""What the arm can resist with, for a menu."""


@dataclass(frozen=True)
class FreeLawCam(Design):
    """What every high-speed cam has: sizes, two motion laws, and what touches.

    Each law is a 3-4-5 polynomial that four coefficients shape, which make the paper's polynomials of degree 9 or
    splines of it (see `ShapedLaw`), or any other law.
    """

    arm_length: float = quantity("l", 165, 40, 290, "mm", "arm: pivot to roller centre")
    roller_radius: float = quantity("r", 30, 20, 200, "mm", "roller")
    max_radius: float = quantity(
        "r_k2", 130, 60, 140, "mm", "largest radius of the profile", name="radius at the far dwell"
    )
    rise_law: Any = choice("a", ShapedLaw(), LAW_MENU, "law by which the arm swings away")
    return_law: Any = choice("a'", ShapedLaw(), LAW_MENU, "law by which the arm swings back", c="d")
    contact: ContactPair = choice("C", CONTACTS[0], CONTACTS, "materials and length of the line of contact")
    """The materials of cam and roller and the length of the line on which they touch; lubricant and strength."""


@dataclass(frozen=True)
class HighSpeedCam(FreeLawCam):
    """A cam between two dwells, its laws free (defaults: the paper's first design).

    ``spring_factor`` is the rate of the closing spring over ``J omega^2`` at the rated speed (``speed`` = 100 %); 0
    stands for the weakest spring that holds the arm's inertia there.  Faster, the same spring may let the roller lift.
    With a ``groove`` the cam is closed by form: 0 is then no spring at all, and stress and wear are those of the flank
    that works, the outer one where the normal force is below 0.
    ``load`` is an `InertialSpringLoad`, a `ConstantTorque` or anything else with a ``name`` and their method
    ``resisting_torque``.

    >>> cam = HighSpeedCam(165 * mm, 30 * mm, 130 * mm)
    >>> analysis = cam.analyse()
    >>> print(f"{analysis.rise.stress_coefficient.max():.4f}, {analysis.fall.wear_coefficient.max():.2f}")
    2.4780, 410.00

    Raises ``ValueError`` for sizes that cannot be built: the sentence says which and what is possible.
    """

    load: Any = choice("M", InertialSpringLoad(), LOADS, "what the arm resists with")
    centre_distance: float = quantity("L", 200, 100, 400, "mm", "cam axis to arm pivot")
    swing: float = quantity("PS", 30, 2, 60, "deg", "swing of the arm", asked=True)
    rise_angle: float = quantity("phi_1", 90, 30, 170, "deg", "cam angle over which the arm swings away", asked=True)
    return_angle: float = quantity("phi_2", 90, 30, 170, "deg", "cam angle over which the arm swings back", asked=True)
    speed: float = quantity(
        "n", 100, 10, 200, "%", "for the rated speed load and spring are given", name="speed, % of rated"
    )
    spring_factor: float = quantity(
        "K", 0, 0, STRONG, "", "closing spring / inertia by rated speed squared; 0: the weakest", at_least=0
    )
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")
    rated_speed: float = quantity("n_0", 600, 10, 6000, "rpm", "for which load and spring are given")
    """Of which film and surface velocities alone depend."""
    groove: bool = choice("g", False, CLOSURES, "what guides the roller: a groove, or a plate and a spring or weight")

    offers: ClassVar[tuple[str | AnalysisCurve, ...]] = (
        "bodies",
        "motion",
        ACCELERATION,
        "pressure_angle",
        "stress_coefficient",
        "wear_coefficient",
        "pressure",
        "cam_torque",
    )
    """The shapes and curves that are shown of its analysis where nobody chooses, in this order."""
    friction: ClassVar[Friction] = Friction(0, 0, 0, 0)
    """None is counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._refuse_intervals()
        self._refuse_sizes()

    def following(self) -> dict[str, str]:
        """Without a film the rated speed has no effect."""
        lubricated = isinstance(self.contact, LubricatedPair)
        return {} if lubricated else {"rated_speed": "the contact has no lubricant"}

    def _refuse_intervals(self) -> None:
        moving = self.rise_angle + self.return_angle
        fits = moving < 2 * np.pi
        if refuse := unless(fits):
            refuse(
                f"the arm swings over {moving / deg:.4g} deg of the cam; there are 360 deg, and two dwells "
                "need some of them"
            )
        self._keep(fits)

    def _refuse_sizes(self) -> None:
        L, l, psi = self.centre_distance, self.arm_length, self.end_angle
        reaches, starts, clear = psi < np.pi, self.start_angle > 0, self.min_radius > 0
        if refuse := unless(reaches):
            refuse(
                f"the roller's centre has to come {(self.max_radius + self.roller_radius) / mm:.4g} mm from the cam "
                f"axis (r_k2 + r); an arm of {l / mm:.4g} mm at {L / mm:.4g} mm reaches {abs(L - l) / mm:.4g} to "
                f"{(L + l) / mm:.4g} mm"
            )
        if refuse := unless(starts):
            refuse(
                f"the arm ends at {psi / deg:.4g} deg from the line of centres and swings "
                f"{self.swing / deg:.4g} deg; it must start above 0 deg"
            )
        if refuse := unless(clear):
            refuse(
                f"the minimum radius r_k1 of the profile is {self.min_radius / mm:.4g} mm; it must be above 0 mm: "
                f"the roller of {self.roller_radius / mm:.4g} mm covers the cam axis"
            )
        self._keep(reaches & starts & clear)

    def ready_for(self, paths: Iterable[str]) -> Self:
        """The same cam (see `Design.ready_for`); a spring that is free has a rate, the weakest that holds.

        Where none holds, because the arm passes its start, it is the strongest that a slider offers.
        """
        needed = {*paths}
        ready = super().ready_for(needed)
        if "spring_factor" not in needed or ready.spring_factor or ready.groove:
            return ready
        weakest = float(ready.analyse().min_spring_factor) * self.speed**2
        return ready.replace(spring_factor=min(weakest, STRONG))

    @property
    def end_angle(self) -> Value:
        """``psi_max``: where the roller's centre is ``r_k2 + r`` from the cam axis, rad; ``nan`` if it never is."""
        return angle_opposite(self.max_radius + self.roller_radius, self.arm_length, self.centre_distance)

    @property
    def start_angle(self) -> Value:
        """``psi_0``: the arm from the line pivot -> cam axis at its near dwell, rad."""
        return self.end_angle - self.swing

    @property
    def min_radius(self) -> Array:
        """``r_k1``: smallest radius of the profile, m."""
        L, l = self.centre_distance, self.arm_length
        return np.sqrt(L**2 + l**2 - 2 * L * l * np.cos(self.start_angle)) - self.roller_radius

    @property
    def dwell_angle(self) -> Value:
        """Cam angle of each of the two dwells, rad: they share what the intervals leave."""
        return np.pi - (self.rise_angle + self.return_angle) / 2

    @cached_property
    def motion(self) -> MotionProgram:
        """The arm's travel over a turn of the cam: rise, dwell, return, dwell."""
        away = Rise(self.rise_angle, self.swing, self.rise_law)
        back = Return(self.return_angle, self.swing, self.return_law)
        return MotionProgram((away, Dwell(self.dwell_angle), back, Dwell(self.dwell_angle)))

    def suited(self) -> bool:
        """Whether the two laws suit the dwells."""
        return self.motion.suited()

    def angles(self, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Cam angles of the whole turn, of the rise and of the return, ``n`` even ones in either of these."""
        n = counted(n, "angles", 5)
        share, dwell = np.linspace(0, 1 - HAIR, n), np.linspace(0, 1, n // 4 + 2) * self.dwell_angle
        rise, far = share * self.rise_angle, self.rise_angle + dwell
        fall, near = far[..., -1:] + share * self.return_angle, 2 * np.pi - self.dwell_angle + dwell
        return end_to_end(rise, far[..., :-1], fall, near), rise, fall

    def analyse(self, n: int = 401) -> HighSpeedAnalysis:
        """Geometry and forces at ``n`` even cam angles of either interval, and some of the dwells."""
        return self.analysed(n, self)

    def analysed(self, n: int, machine: Design) -> HighSpeedAnalysis:
        """The same as a part of a ``machine``."""
        analysis = HighSpeedAnalysis(self, *self.angles(n), machine)
        analysis.refuse_impossible()
        return analysis

    def drawn(self, analysis: HighSpeedAnalysis) -> tuple[Body, ...]:
        """The cam, and the arm with its roller."""
        return *bodies.disk(analysis, self.groove), *analysis.follower
