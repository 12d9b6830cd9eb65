"""Views of motion: programs around the turn, laws laid over each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..motion import Kinematics, Law, MotionProgram, residual_vibration
from ..quantities.kinds import a_number, refuse_kinds
from ..quantities.types import Array
from ..units import deg, factor
from .cam import MOTION
from .picture import Axes, Line, Mark, MarkStyle, Picture, Points, Text, View

HAIR = 1e-9
"""How far (rad) before and after a joint the two sides of a jump are drawn."""


SLOWEST, FASTEST = 1e-6, 1e6
"""Speeds of a shaft (rad/s) for which motions are shown in time."""
METRES = {"mm": "m", "cm": "m", "um": "m"}
"""In which unit of length values in time are."""


@dataclass(frozen=True)
class MotionUnits:
    """What a motion is shown in: the unit of its ``lift``, and per rad or, at a ``speed`` (rad/s), in time."""

    lift: str = "mm"
    speed: float | None = None

    def __post_init__(self) -> None:
        factor(self.lift)
        if self.speed is not None:
            must = f"be a number from {SLOWEST:g} to {FASTEST:g} (rad/s)"
            a_number(self.speed, "the speed of the shaft", must, lambda speed: (speed >= SLOWEST) & (speed <= FASTEST))

    def of(self, k: int) -> str:
        """The unit of length or angle in that of the derivative of order ``k``."""
        return self.lift if self.speed is None or k == 0 else METRES.get(self.lift, self.lift)

    def name(self, k: int) -> str:
        """The unit of the derivative of order ``k``."""
        per = "/rad" if self.speed is None else "/s"
        return self.of(k) + ("" if k == 0 else per if k == 1 else f"{per}^{k}")

    def factor(self, k: int) -> float:
        """How much one of it is in the follower's unit (m or rad) per rad^k."""
        return factor(self.of(k)) / (1.0 if self.speed is None else self.speed**k)


@dataclass(frozen=True)
class ShownProgram:
    """A motion program as it is drawn: ``n`` cam angles and both sides of every joint, lifts in ``unit``.

    At a ``speed`` of the shaft (rad/s) derivatives are those in time, and ``over_time`` draws them over the time, too.
    """

    program: MotionProgram
    unit: str = "mm"
    n: int = 721
    speed: float | None = None
    over_time: bool = False

    @property
    def units(self) -> MotionUnits:
        """What numbers are shown in."""
        return MotionUnits(self.unit, self.speed)

    @cached_property
    def joints(self) -> np.ndarray:
        """Cam angles of the joints from 0 to the span, rad."""
        return np.asarray(self.program.edges, dtype=float)

    @cached_property
    def cam_angle(self) -> np.ndarray:
        """Cam angles, rad."""
        inner = self.joints[1:-1]
        return np.sort(np.concatenate([np.linspace(0, self.joints[-1], self.n), inner - HAIR, inner + HAIR]))

    @cached_property
    def motion(self) -> Kinematics:
        """``s, v, a, j`` at those angles."""
        return self.program(self.cam_angle)

    @cached_property
    def breaks(self) -> np.ndarray:
        """Cam angles at which the fundamental law is broken, rad."""
        return np.array([joint.angle for joint in self.program.transitions() if not joint.lawful])

    @property
    def across(self) -> float:
        """What cam angles (rad) are divided by for the axis."""
        return self.speed if self.over_time and self.speed else deg

    @property
    def axis(self) -> str:
        """The name of the axis."""
        return "time  [s]" if self.over_time and self.speed else "cam angle  [deg]"


def _derivative(shown: ShownProgram, k: int, name: str) -> Picture:
    """The ``k``-th derivative, with a cross wherever the fundamental law is broken."""
    scale, across = shown.units.factor(k), shown.across
    at = np.interp(shown.breaks, shown.cam_angle, shown.motion[k]) / scale
    return Picture.of(
        Axes(title=name, xlabel=shown.axis, ylabel=f"{'svaj'[k]}  [{shown.units.name(k)}]"),
        Line("zero", shown.joints[[0, -1]] / across, [0.0, 0.0], role="guide", stroke="thin"),
        Line(name, shown.cam_angle / across, shown.motion[k] / scale, role=MOTION[k], stroke="solid"),
        Points("breaks", shown.breaks / across, at, role="trouble", mark="cross", size=9),
    )


def displacement(shown: ShownProgram) -> Picture:
    """Position, with a handle at every joint."""
    drawn = _derivative(shown, 0, "Displacement")
    y = np.asarray(shown.program.levels, dtype=float) / shown.units.factor(0)
    return Picture.of(drawn.axes, drawn.marks, Points("handles", shown.joints / shown.across, y, size=10, fill="paper"))


def velocity(shown: ShownProgram) -> Picture:
    """First derivative with respect to the cam angle, or to time."""
    return _derivative(shown, 1, "Velocity")


def acceleration(shown: ShownProgram) -> Picture:
    """Second derivative with respect to the cam angle, or to time."""
    return _derivative(shown, 2, "Acceleration")


def jerk(shown: ShownProgram) -> Picture:
    """Third derivative with respect to the cam angle, or to time; an infinite one is a line marked ∞."""
    drawn = _derivative(shown, 3, "Jerk")
    marks = [mark for mark in drawn.marks if mark.key != "breaks"]
    return Picture.of(drawn.axes, marks, *_infinite(shown, float(np.abs(drawn["Jerk"].y).max())))


def _infinite(shown: ShownProgram, highest: float) -> list[Mark]:
    """A line for each infinite jerk, upwards where the acceleration jumps up."""
    broken = [joint for joint in shown.program.transitions() if not joint.lawful]
    tips = [(highest or 1.0) * np.sign((joint.s, joint.v, joint.a)[joint.order or 0]) for joint in broken]
    across = [joint.angle / shown.across for joint in broken]
    shafts = np.array([[0.0, tip, np.nan] for tip in tips]).ravel()
    words = [
        Text(f"infinite {k}", x, 0.8 * tip, " ∞", role="trouble", anchor="left", size=13, bold=True)
        for k, (x, tip) in enumerate(zip(across, tips, strict=True))
    ]
    return [Line("infinite", np.repeat(across, 3), shafts, role="trouble", stroke="thin"), *words] if words else []


PROGRAM_VIEWS = (displacement, velocity, acceleration, jerk)
"""A motion program at a glance."""

SHARES = np.linspace(0, 1, 1001)


def law_overlay(k: int, name: str) -> View:
    """A view that lays the ``k``-th derivative of several laws over each other."""

    def view(laws: Sequence[Law]) -> Picture:
        marks = [
            Line(f"{i} {law.name}", SHARES, law(SHARES)[k], role="series", index=i, label=law.name if k == 0 else "")
            for i, law in enumerate(laws)
        ]
        return Picture.of(Axes(title=name, xlabel="share of the angle", ylabel=f"{'svaj'[k]}"), marks)

    view.__doc__ = f"{name} of several laws, each with lift 1 over an angle of 1."
    return view


LAW_VIEWS = tuple(law_overlay(k, name) for k, name in enumerate(("Displacement", "Velocity", "Acceleration", "Jerk")))
"""All laws of a list laid over each other."""


@dataclass(frozen=True)
class ShownVibration:
    """The residual vibration of one mass on a spring behind each of several laws, over the period ratio ``tau``."""

    laws: tuple[Law, ...]
    fastest: float = 0.5
    slowest: float = 12.0

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if not 0 < self.fastest < self.slowest:
            told = f"{self.fastest:g} to {self.slowest:g}"
            raise ValueError(f"the period ratios go from {told}; both must be above 0, the first below the second")

    @cached_property
    def tau(self) -> np.ndarray:
        """Rise time over natural period."""
        return np.geomspace(self.fastest, self.slowest, 400)

    @cached_property
    def residual(self) -> list[np.ndarray]:
        """Largest deviation after the rise, a share of the lift, for each law."""
        return [residual_vibration(law, self.tau).residual for law in self.laws]


def vibration_left(shown: ShownVibration) -> Picture:
    """What still rings after the rise, against the speed of the machine (fast on the left)."""
    axes = Axes(
        title="Residual vibration",
        xlabel="rise time / natural period",
        ylabel="amplitude after the rise  [% of lift]",
        log="xy",
        xticks={ratio: f"{ratio:g}" for ratio in (0.5, 1.0, 2.0, 3.0, 5.0, 10.0)},
        ylim=(0.003, 200),
    )
    laws = enumerate(zip(shown.laws, shown.residual, strict=True))
    return Picture.of(axes, [_ringing(shown.tau, law, residual, i) for i, (law, residual) in laws])


def _ringing(tau: Array, law: Law, residual: Array, index: int) -> Line:
    style: MarkStyle = {"role": "series", "index": index, "label": law.name}
    return Line(f"{index} {law.name}", tau, np.maximum(100 * residual, 1e-4), **style)
