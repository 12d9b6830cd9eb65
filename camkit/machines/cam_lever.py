"""The cam and lever of a bookbinding press: the cam swings a lever, the lever lifts a slider that its weight closes.

The lever's length ``x`` is free with the cam: it sets the swing, the centre distance and the inertia.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov (table 3).  The paper shows the slider's force ``P(s)`` in a
figure that cannot be had, and prints neither speed nor weight.  The defaults here are a stand-in: a weight of 147 N,
a constant force of 123 N and 50 rpm, which give the paper's first row: F_sigma to the last digit, F_wear to 0.3 %.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from ..cam import bodies
from ..cam.loads import Table, as_table, tabulated
from ..cam.measures import number
from ..geometry import Body, Outline, rotated
from ..quantities import Measure, known, quantity, unless, unremarked
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array, Value
from ..study import AnalysisCurve, Study
from ..units import mm
from .high_speed_analysis import HighSpeedAnalysis
from .high_speed_cam import ACCELERATION, FreeLawCam, HighSpeedCam
from .high_speed_load import SliderLoad
from .high_speed_measures import (
    CLEAR,
    COEFFICIENTS,
    COMMON,
    laws_free,
    min_lead,
    min_radius,
    overrun,
    peak,
    undercut_margin,
)


@dataclass(frozen=True)
class CamLever(FreeLawCam):
    """A high-speed cam on a lever of length ``x`` (defaults: the paper's first design under the stand-in load).

    ``slider_force`` is constant; ``force_curve``, added to it, is the user's own: a function of the slider's way
    [m] that gives newtons, or a table of such pairs joined by straight lines.  With ``slider_force=0`` it stands
    alone.

    >>> press = CamLever()
    >>> print(f"{np.degrees(press.swing):.2f} deg, {press.cam.centre_distance / mm:.1f} mm")
    4.13 deg, 328.7 mm

    Raises ``ValueError`` for sizes that cannot be built: the sentence says which and what is possible.
    """

    arm_length: float = quantity("l", 313, 200, 380, "mm", "arm: pivot to roller centre")
    roller_radius: float = quantity("r", 45, 10, 50, "mm", "roller")
    max_radius: float = quantity(
        "r_k2", 94, 80, 140, "mm", "largest radius of the profile", name="radius at the far dwell"
    )
    lever: float = quantity("x", 250, 200, 300, "mm", "lever: pivot to slider")
    rise_angle: float = quantity("phi_1", 61, 40, 90, "deg", "cam angle over which the slider rises", asked=True)
    return_angle: float = quantity("phi_2", 61, 40, 90, "deg", "cam angle over which the slider sinks", asked=True)
    shaft_speed: float = quantity("omega", 50, 10, 200, "rpm", "speed of the cam (stand-in)")
    weight: float = quantity("G", 147, 10, 1000, "N", "weight of the slider (stand-in)")
    slider_force: float = quantity("P", 123, 0, 1000, "N", "force of the work on the slider (stand-in)", at_least=0)
    lever_mass: float = quantity("j", 15, 1, 50, "kg", "inertia of the lever by its length squared")
    stroke: float = quantity("h", 18, 5, 40, "mm", "stroke of the slider", asked=True)
    slider_distance: float = quantity("A", 525, 400, 700, "mm", "cam axis to slider, level")
    pivot_height: float = quantity("B", 180, 50, 300, "mm", "cam axis to lever pivot, upright")
    force_curve: Table | Callable[[Value], Value] = ()

    offers: ClassVar[tuple[str | AnalysisCurve, ...]] = (
        "bodies",
        "motion",
        ACCELERATION,
        "pressure_angle",
        "stress",
        "wear",
        "pressure",
        "way",
    )
    """The shapes and curves that are shown of its analysis where nobody chooses, in this order."""

    def __post_init__(self) -> None:
        if not callable(self.force_curve):
            object.__setattr__(self, "force_curve", as_table("force curve", "way", "force", self.force_curve))
        super().__post_init__()
        reaches = self.stroke < 2 * self.lever
        if refuse := unless(reaches):
            refuse(
                f"the stroke is {self.stroke / mm:.4g} mm; a lever of {self.lever / mm:.4g} mm "
                f"gives less than {2 * self.lever / mm:.4g} mm"
            )
        self._keep(reaches)
        self._refuse_force_curve()
        self.cam  # noqa: B018 - refuses what cannot be built

    def _refuse_force_curve(self) -> None:
        if not (callable(self.force_curve) and known(self.stroke)):
            return
        ways = np.linspace(0, 1, 5) * np.ravel(self.stroke)[0]
        if not np.isfinite(ways).all():  # a population whose first member cannot be built
            return
        try:
            with np.errstate(all="ignore"):
                forces = np.broadcast_to(np.asarray(self.force_curve(ways), dtype=float), ways.shape)
        except (TypeError, ValueError):
            forces = np.full(ways.shape, np.nan)
        if not np.isfinite(forces).all():
            raise ValueError(
                f"the force curve does not give a force for each way between 0 and {ways[-1] / mm:.4g} mm; it must "
                "take an array of ways [m] and give as many finite numbers [N], as lambda s: 100 + 1e4 * s does"
            )

    @property
    def swing(self) -> float:
        """Of the lever: ``2 arcsin(h / 2x)``, rad."""
        return 2 * np.arcsin(self.stroke / (2 * self.lever))

    @property
    def inertia(self) -> float:
        """``J = j x^2`` of the lever, kg m^2."""
        return self.lever_mass * self.lever**2

    def force(self, way: Value) -> Value:
        """``P``: of the work on the slider at its ``way`` from the lowest position, N."""
        own = self.force_curve(way) if callable(self.force_curve) else tabulated(self.force_curve, way)
        return self.slider_force + own + 0.0 * way

    def arm_force(self, analysis: HighSpeedAnalysis) -> Array:
        """Of the slider on the lever, machine's frame, ``(2, n)``, N; the lever's inertia is a couple."""
        pull = self.weight + self.force(analysis.way)
        upright = rotated(np.stack([0.0 * pull, -pull]), -self._down)
        return upright * _mirror(upright)

    @property
    def _down(self) -> Value:
        """Of the lever's pivot as seen from the cam axis, rad."""
        return -np.arctan2(self.pivot_height, self.slider_distance - self.lever)

    @cached_property
    def cam(self) -> HighSpeedCam:
        """The cam that swings the lever: its load is that at 1 rad/s, its speed in rad/s."""
        shared = {f.name: getattr(self, f.name) for f in fields(FreeLawCam)}
        with unremarked():
            return HighSpeedCam(
                **shared,
                load=SliderLoad(self.lever, self.weight, self.inertia, self.force),
                centre_distance=np.hypot(self.slider_distance - self.lever, self.pivot_height),
                swing=self.swing,
                rise_angle=self.rise_angle,
                return_angle=self.return_angle,
                speed=self.shaft_speed,
            )

    def analyse(self, n: int = 401) -> HighSpeedAnalysis:
        """Geometry and forces at ``n`` even cam angles of either interval, and some of the dwells."""
        return self.cam.analysed(n, self)

    def drawn(self, analysis: HighSpeedAnalysis) -> tuple[Body, ...]:
        """Cam, arm with roller, lever and slider as they stand: the slider goes up and down, the lever level at half.

        The arm lies under the cam, its pivot below the cam axis and beside it, where the paper's sizes put it.
        """
        cam, down = bodies.disk(analysis, False), self._down
        pivot, centre = (rotated(point * _mirror(point), down) for point in analysis.cranks["arm"])
        tilt = analysis.motion.s - self.swing / 2
        end = np.reshape(pivot, (2, 1)) + self.lever * np.stack([np.cos(tilt), np.sin(tilt)])
        return (
            *(_mirrored(part, down) for part in cam),
            Outline("", "guide", GUIDE, x=end[0], y=end[1]),
            *bodies.rocker("arm", pivot, centre),
            bodies.roller("arm", centre, self.roller_radius),
            *bodies.rocker("lever", pivot, end),
            Outline("slider", "block", BLOCK, x=end[0], y=end[1]),
        )


GUIDE = np.array([[0, 0], [-90, 90]]) * mm
BLOCK = np.array([[-16, 16, 16, -16, -16], [-34, -34, 34, 34, -34]]) * mm
"""The line on which the slider goes, and the slider: their sizes are those of a drawing."""


def _mirror(points: Value) -> np.ndarray:
    """What ``points`` ``(2, ...)`` are multiplied with to be mirrored in the x axis."""
    return np.reshape([1.0, -1.0], (2,) + (1,) * (np.ndim(points) - 1))


def _mirrored(part: Any, down: Value) -> Body:
    """A part of the cam turned over, so that the arm lies under it."""
    return replace(part, points=part.points * _mirror(part.points), angle=down - part.angle)


def _slowing(part: HighSpeedAnalysis) -> Array:
    return -part.acceleration


def _closing(analysis: HighSpeedAnalysis) -> Array:
    """``-J omega^2 psi'' / (G x)`` over rise and fall: what the lever's inertia takes of the closing weight."""
    press = analysis.machine
    return press.inertia * press.shaft_speed**2 * analysis.tops(_slowing) / (press.weight * press.lever)


lever_stress = peak("stress index F_sigma", "N^0.5 cm^-0.5", lambda a: a.stress)
lever_wear = peak("wear index", "N^1.5 cm^-0.5", lambda a: a.wear)
closing_share = peak("inertia / closing weight", "", _closing)
reach = Measure("arm and roller l + r", "mm", lambda a: number(a.cam.arm_length + a.cam.roller_radius))

CAM_LEVER_MEASURES = (
    lever_stress,
    lever_wear,
    *COMMON,
    reach,
    closing_share,
    overrun,
)
"""What a table of a cam and lever shows, in the paper's units."""
CamLever.measures = (*CAM_LEVER_MEASURES, min_lead)

LEVER_SIZES = {
    "arm_length": (200 * mm, 390 * mm),
    "lever": (200 * mm, 300 * mm),
    "roller_radius": (10 * mm, 50 * mm),
}


def cam_lever_study(
    start: CamLever | None = None,
    objective: Measure = lever_stress,
    *,
    max_radius: float = 110 * mm,
    free_laws: bool = True,
    angles: int = 201,
) -> Study:
    """The paper's problem of 12 variables: arm, lever, roller, largest radius up to ``max_radius``, both laws.

    ``l + r <= 400``, ``r <= 50``, ``r_k1 >= 60 mm``; inertia takes at most 0.4 of the closing weight.

    Fewer than 1 in 1000 random designs keep the limits: laws of random coefficients throw the arm about, 1 in 300 keeps
    the inertia below the weight.  A search finds its way all the same, it begins at a design that keeps them.

    >>> study = cam_lever_study()
    >>> len(study.free), f"{study.evaluate(study.x0).f[0, 0] / 10:.3f}"
    (12, '10.246')
    """
    refuse_arguments(cam_lever_study, locals())
    start = start or CamLever()
    start = start.ready_for(COEFFICIENTS) if free_laws else start
    return Study(
        start=start,
        free=LEVER_SIZES | {"max_radius": (80 * mm, max_radius)} | (laws_free(start) if free_laws else {}),
        minimise=(objective,),
        at_most={reach: 400 * mm, closing_share: 0.4},
        at_least={min_radius: 60 * mm, undercut_margin: CLEAR} | ({min_lead: 0.0} if free_laws else {}),
        angles=angles,
    )
