"""The cam of an aircraft cabin-door handle: one disk, two cranks.

Over the first 30 deg of the handle a relief-flap crank swings 10 deg while the lift crank dwells; over the
next 150 deg the lift crank swings 69 deg while the relief crank dwells on the lift curve's base circle.

Source: Gong, Liu, He, Nanjing University of Aeronautics and Astronautics, 2025 (Tables 1, 3, 4).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..cam.loads import ArmLoad, Friction
from ..cam.measures import (
    CURVE,
    MOTION,
    base_radius,
    groove_gap,
    max_pressure_angle,
    min_convex_radius,
    part,
    peak_force,
    peak_torque,
    radius_of,
    undercut_margin,
    worst,
)
from ..cam.oscillating_roller import OscillatingRollerCam
from ..decision import Judgements
from ..geometry import angle_opposite, end_to_end
from ..motion import LAW_MENU, Cycloidal, Dwell, MotionProgram, Return, Rise
from ..quantities import Design, Measure, choice, counted, quantity, unless
from ..quantities.kinds import listed, refuse_arguments
from ..quantities.types import Array, Value
from ..study.study import Space, Study
from ..study.weighted import weighted
from ..units import deg, mm
from .door_handle_analysis import DoorHandleAnalysis

BOTH = ("lift", "relief")
SHARED = ("speed", "gravity", "up_angle")
"""What the loads of both cranks have in common."""


@dataclass(frozen=True)
class DoorHandleCam(Design):
    """Cam of a cabin-door handle with a lift and a relief crank (defaults: the paper's Table 1).

    The groove holds three stretches, one behind the other: the relief curve, the transition arc on which the
    relief crank dwells, the lift curve.  ``lift`` and ``relief`` are the two `OscillatingRollerCam` curves; the
    relief curve ends on the lift curve's base circle and so depends on the lift design.

    >>> cam = DoorHandleCam()
    >>> print(f"{cam.base_radius / mm:.3f} mm, {np.degrees(cam.relief.start_angle):.2f} deg")
    33.588 mm, 24.88 deg

    Raises ``ValueError`` for sizes that cannot be built: the sentence says which and what is possible.
    """

    lift_arm: float = quantity("l_1", 50, 40, 62, "mm", "pivot to roller centre")
    lift_start_angle: float = quantity("psi_0", 22, 15, 30, "deg", "lift arm from the line of centres at the start")
    relief_arm: float = quantity("l_2", 75, 60, 92, "mm", "pivot to roller centre")
    lift_centre_distance: float = quantity("a_1", 74.24, 60, 110, "mm", "cam axis to lift pivot")
    relief_centre_distance: float = quantity("a_2", 100, 85, 120, "mm", "cam axis to relief pivot")
    roller_radius: float = quantity("r_T", 5, 1, 12, "mm", "both rollers")
    lift_swing: float = quantity("tau_1", 69, 40, 80, "deg", "swing of the lift crank", asked=True)
    relief_swing: float = quantity("tau_2", 10, 2, 20, "deg", "swing of the relief crank", asked=True)
    relief_cam_angle: float = quantity("phi_2", 30, 15, 90, "deg", "handle angle for the relief crank")
    handle_angle: float = quantity(
        "phi", 180, 120, 200, "deg", "handle angle in all; the rest is for the lift crank", asked=True
    )
    motion_law: Any = choice("law", Cycloidal(), LAW_MENU, "motion law of both cranks")
    lift_load: ArmLoad = field(default_factory=ArmLoad)
    """What the lift crank resists with; its speed, gravity and direction of straight up are those of both cranks."""
    relief_load: ArmLoad = field(default_factory=lambda: ArmLoad(mass=0.5))
    """What the relief crank resists with; its swing away from the cam goes against its angle, hence torques < 0."""
    friction: Friction = field(default_factory=Friction)
    """Of both rollers and cranks."""

    def __post_init__(self) -> None:
        super().__post_init__()
        shares = self.relief_cam_angle < self.handle_angle
        if refuse := unless(shares):
            refuse(
                f"the relief cam angle is {self.relief_cam_angle / deg:.4g} deg of {self.handle_angle / deg:.4g} deg "
                "handle angle; it must leave some for the lift crank"
            )
        fits = self.handle_angle + self.lift_cam_angle <= 2 * np.pi
        if refuse := unless(fits):
            refuse(
                "relief curve, transition arc and lift curve need "
                f"{(self.handle_angle + self.lift_cam_angle) / deg:.4g} deg of the cam; there are 360 deg"
            )
        reaches = np.isfinite(self._relief_rest_angle)
        if refuse := unless(reaches):
            low = abs(self.relief_centre_distance - self.relief_arm) / mm
            high = (self.relief_centre_distance + self.relief_arm) / mm
            refuse(
                f"the relief roller has to rest on the lift curve's base circle of {self.base_radius / mm:.4g} mm; "
                f"an arm of {self.relief_arm / mm:.4g} mm at {self.relief_centre_distance / mm:.4g} mm reaches "
                f"{low:.4g} to {high:.4g} mm"
            )
        self._keep(shares & fits & reaches)

    @property
    def lift_cam_angle(self) -> Value:
        """Handle angle over which the lift crank swings."""
        return self.handle_angle - self.relief_cam_angle

    @property
    def base_radius(self) -> Array:
        """``r_0``: pitch radius of the lift curve at its start, on which the relief crank dwells."""
        a, l = self.lift_centre_distance, self.lift_arm
        return np.sqrt(a**2 + l**2 - 2 * a * l * np.cos(self.lift_start_angle))

    @property
    def _relief_rest_angle(self) -> Any:
        """``psi'``: the relief arm's angle with its roller on the base circle."""
        return angle_opposite(self.base_radius, self.relief_arm, self.relief_centre_distance)

    def following(self) -> dict[str, str]:
        """What the relief crank's load shares with the lift crank's."""
        return {f"relief_load.{name}": f"it is that of the lift_load: lift_load.{name}" for name in SHARED}

    def suited(self) -> bool:
        """Whether the motion law suits both curves."""
        return self.lift.motion.suited() and self.relief.motion.suited()

    @cached_property
    def lift(self) -> OscillatingRollerCam:
        """The lift curve: dwell, then rise; its arm swings against the cam's rotation."""
        return OscillatingRollerCam(
            motion=MotionProgram(
                (Dwell(self.relief_cam_angle), Rise(self.lift_cam_angle, self.lift_swing, self.motion_law))
            ),
            centre_distance=self.lift_centre_distance,
            arm_length=self.lift_arm,
            start_angle=self.lift_start_angle,
            roller_radius=self.roller_radius,
            rotation=1,
            load=self.lift_load,
            friction=self.friction,
        )

    @cached_property
    def relief(self) -> OscillatingRollerCam:
        """The relief curve: return, then dwell; a mirrored crank whose roller comes in to the base circle."""
        return OscillatingRollerCam(
            motion=MotionProgram(
                (Return(self.relief_cam_angle, self.relief_swing, self.motion_law), Dwell(self.lift_cam_angle))
            ),
            centre_distance=self.relief_centre_distance,
            arm_length=self.relief_arm,
            start_angle=self._relief_rest_angle + self.relief_swing,
            roller_radius=self.roller_radius,
            rotation=-1,
            load=self.relief_load.replace(
                speed=self.lift_load.speed,
                gravity=self.lift_load.gravity,
                up_angle=self.relief_direction - self.lift_load.up_angle,
            ),
            friction=self.friction,
        )

    @cached_property
    def relief_direction(self) -> Value:
        """Direction from the cam axis to the relief pivot; the lift pivot is at 0, the cam turns with growing angle.

        It follows from the order of the stretches: the transition arc ends where the lift curve begins, when
        the relief roller has used it up.
        """
        lift = self._roller_direction(self.lift_centre_distance, self.lift_arm, self.lift_start_angle)
        relief = self._roller_direction(self.relief_centre_distance, self.relief_arm, self._relief_rest_angle)
        return self.lift_cam_angle + lift + relief

    @staticmethod
    def _roller_direction(a: Value, l: Value, psi: Value) -> Value:
        return np.arctan2(l * np.sin(psi), a - l * np.cos(psi))

    def analyse(self, n: int = 721) -> DoorHandleAnalysis:
        """Both curves at ``n`` handle angles, a third of them over the relief motion."""
        analysis = DoorHandleAnalysis(self, *self._handle_angles(n))
        for curve in (analysis.lift, analysis.relief):
            curve.refuse_impossible()
        return analysis

    def _handle_angles(self, n: int) -> tuple[np.ndarray, int]:
        """Handle angles dense over both motions; the first ``k`` end a hair before the lift crank starts.

        A hair, so that a law that stops with a jolt is seen before the dwell that follows it.
        """
        k = counted(n, "handle angles", least=6) // 3
        before = np.linspace(0, 1, k) * self.relief_cam_angle * (1 - 1e-9)
        after = self.relief_cam_angle + np.linspace(0, 1, n - k) * self.lift_cam_angle
        return end_to_end(before, after), k


PAPER_JUDGEMENTS = Judgements(("pressure angle", "contact force", "cam torque"), (5, 5, 1))
"""The paper's AHP judgements."""

DOOR_HANDLE_SPACE = {
    "lift_arm": (40 * mm, 60 * mm),
    "lift_start_angle": (0.30, 0.55),
    "relief_cam_angle": (30 * deg, 75 * deg),
}
"""A space in which whole cams live: the relief crank may take a larger share of the handle angle."""

PAPER_SPACE = {
    "lift_arm": (45 * mm, 55 * mm),
    "lift_start_angle": (0.30, 0.46),
    "relief_arm": (67.5 * mm, 82.5 * mm),
}
"""The paper's free quantities; it prints no bounds, these are +-10 % of the lengths and 0.30..0.46 rad."""

LIFT_SPACE = {name: PAPER_SPACE[name] for name in ("lift_arm", "lift_start_angle")}
"""What of the paper's free quantities the lift curve depends on."""

EXPANDED_SPACE = PAPER_SPACE | {
    "lift_centre_distance": (60 * mm, 100 * mm),
    "relief_centre_distance": (85 * mm, 115 * mm),
    "relief_cam_angle": (30 * deg, 75 * deg),
    "roller_radius": (3 * mm, 6 * mm),
}
"""What the paper leaves for later: centre distances, relief motion angle and roller radius are free too."""

STUDY_ANGLES = 361
"""Handle angles of an analysis within a search."""

CURVE_TABLE = tuple(part(measure, name) for name in BOTH for measure in (*CURVE, *MOTION))
"""Every measure of both curves, for a table."""


stroke_radius = Measure(
    "minimum convex radius of curvature of the stroke, pitch curve, lift", "mm", lambda a: radius_of(a.stroke_curvature)
)

_LEAST = (base_radius, min_convex_radius, undercut_margin)
WORSE_CURVE = {
    m: worst(m, BOTH, np.minimum if m in _LEAST else np.maximum)
    for m in (max_pressure_angle, peak_force, peak_torque, *_LEAST)
}
LIFT_CURVE = {m: part(m, "lift") for m in CURVE}
EFFORT = (max_pressure_angle, peak_force, peak_torque)
DoorHandleCam.measures = (*CURVE_TABLE, *WORSE_CURVE.values(), groove_gap, stroke_radius)


def door_handle_study(
    start: DoorHandleCam | None = None,
    *,
    space: Space | None = None,
    reference: DoorHandleCam | None = None,
    weights: object = (5 / 7, 1 / 7, 1 / 7),
) -> Study:
    """The whole cam: little effort against a large least convex radius, both of the worse curve.

    Effort is the weighted sum of the largest pressure angle, contact force and cam torque, each divided by its
    value at ``reference`` (default: ``start``); ``weights`` are AHP weights.  Limits: at most 45 deg, a base radius
    of at least 30 mm, convex radii of at least 7 mm, and no undercut of either flank of the joined groove (the
    roller's radius is at most 0.9 of any radius of curvature), whose ends leave a wall.

    ``space`` maps free quantities to bounds in SI; default: lift arm, start angle and the relief crank's share of
    the handle angle, where a fifth of all designs keep the limits.  The paper's own design is not one of them, its
    relief curve is undercut; it is where a search starts and what effort is measured against.

    Two things to know before a front is believed.  The **lift arm stays on its lower bound**: neither strength nor
    wear resists a short arm here, and the contact force ``T / (l cos alpha)`` of a door torque, which does, weighs
    too little in the paper's judgements to lift it off.  And a constant ``lift_load.torque`` that outweighs the arms'
    inertia has the **peak torque T times the largest velocity**: motion law, swing and cam angle alone fix it, so
    where these are not free its judgement weighs nothing.  Without one, as in the paper, the arms' inertia is the only
    load and forces are tenths of a newton; the notebooks open at 10 N m, an assumption.

    >>> study = door_handle_study()
    >>> study.evaluate([0.042, 0.5, 60 * deg]).feasible.tolist(), study.evaluate(study.x0).feasible.tolist()
    ([True], [False])
    """
    refuse_arguments(door_handle_study, locals())
    start = start or DoorHandleCam()
    of = WORSE_CURVE
    joined = {of[undercut_margin]: 0.1, groove_gap: 0.0}
    return Study(
        start=start,
        free=space or DOOR_HANDLE_SPACE,
        minimise=(_effort(of, reference or start, weights), -of[min_convex_radius]),
        at_most={of[max_pressure_angle]: 45 * deg},
        at_least={of[base_radius]: 30 * mm, of[min_convex_radius]: 7 * mm, **joined},
        angles=STUDY_ANGLES,
    )


def door_handle_paper_study(start: DoorHandleCam | None = None) -> Study:
    """The whole cam in the paper's box: lift arm, start angle and relief arm, as far as the paper lets them go.

    Only 1 in 10 000 random designs keeps the limits, and the front is an edge of the box rather than a surface in it:
    the **lift arm stays on its lower bound and the start angle on its upper one** (45 mm, 0.46 rad), the relief arm
    runs from 79.0 to 80.6 mm, the effort from 1.029 to 1.069 of the start's.  At general tolerances (ISO 2768, medium)
    half of the cams drawn at either end of it miss a limit.

    >>> study = door_handle_paper_study()
    >>> study.evaluate([[0.045, 0.46, 0.080], study.x0]).feasible.tolist()
    [True, False]
    """
    return door_handle_study(start, space=PAPER_SPACE)


def lift_curve_study(
    start: DoorHandleCam | None = None,
    *,
    space: Space | None = None,
    reference: DoorHandleCam | None = None,
    weights: object = (5 / 7, 1 / 7, 1 / 7),
) -> Study:
    """The lift curve alone, as the paper judges it: little effort against a large least convex radius of its stroke.

    Effort, ``reference``, ``weights`` and limits are those of `door_handle_study`, of the lift curve only; nothing is
    said about the relief curve, except that its roller must reach the base circle.  The radius is that of the stroke
    (see `DoorHandleAnalysis.stroke_curvature`): the base circle, where the crank rests, is held by its own limit.

    Raises ``ValueError`` for a free quantity on which the lift curve does not depend, such as the relief arm.

    >>> study = lift_curve_study()
    >>> study.evaluate(study.x0).f.round(4).tolist()
    [[1.0, -0.047]]
    """
    refuse_arguments(lift_curve_study, locals())
    start = start or DoorHandleCam()
    of = LIFT_CURVE
    study = Study(
        start=start,
        free=LIFT_SPACE,
        minimise=(_effort(of, reference or start, weights), -stroke_radius),
        at_most={of[max_pressure_angle]: 45 * deg},
        at_least={of[base_radius]: 30 * mm, stroke_radius: 7 * mm},
        angles=STUDY_ANGLES,
    )
    return study.freeing(space) if space else study


def _effort(of: Mapping[Measure, Measure], reference: DoorHandleCam, weights: object) -> Measure:
    """The weighted sum of pressure angle, force and torque, each over its value at ``reference``."""
    parts = [of[measure] for measure in EFFORT]
    weights = listed(weights, "the weights", "part of the effort")
    if len(weights) != len(parts):
        raise ValueError(f"the effort has {len(parts)} parts (angle, force, torque); there are {len(weights)} weights")
    analysis = reference.analyse(STUDY_ANGLES)
    return weighted("effort", dict(zip(parts, weights, strict=True)), [m.one(analysis) for m in parts])
