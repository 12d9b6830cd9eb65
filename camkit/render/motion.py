"""Views of motion: programs around the turn, laws laid over each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..kinds import refuse_kinds
from ..motion import Kinematics, Law, MotionProgram, residual_vibration
from ..units import deg, factor
from .artists import BLUE, COLOURS, GREEN, GREY, INK, ORANGE, PURPLE, WARNING, frame, line, new

HAIR = 1e-9
"""How far (rad) before and after a joint the two sides of a jump are drawn."""


@dataclass(frozen=True)
class ShownProgram:
    """A motion program as it is drawn: ``n`` cam angles and both sides of every joint, lifts in ``unit``."""

    program: MotionProgram
    unit: str = "mm"
    n: int = 721

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


def _derivative(shown: ShownProgram, ax: Axes, k: int, name: str, colour: str) -> Axes:
    unit = shown.unit + ("" if k == 0 else "/rad" if k == 1 else f"/rad^{k}")
    if new(ax):
        frame(ax, name, "cam angle  [deg]", f"{'svaj'[k]}  [{unit}]")
        ax.axhline(0, color=GREY, linewidth=0.8)
    scale = factor(shown.unit)
    line(ax, name, shown.cam_angle / deg, shown.motion[k] / scale, color=colour)
    at = np.interp(shown.breaks, shown.cam_angle, shown.motion[k]) / scale
    line(
        ax,
        "breaks",
        shown.breaks / deg,
        at,
        linestyle="none",
        marker="x",
        markersize=9,
        color=WARNING,
        markeredgewidth=2.5,
    )
    return ax


def displacement(shown: ShownProgram, ax: Axes) -> Axes:
    """Position, with a handle at every joint."""
    _derivative(shown, ax, 0, "Displacement", BLUE)
    y = np.asarray(shown.program.levels, dtype=float) / factor(shown.unit)
    style = {"linestyle": "none", "marker": "o", "markersize": 10, "markerfacecolor": "white", "markeredgewidth": 2}
    line(ax, "handles", shown.joints / deg, y, color=INK, **style)
    return ax


def velocity(shown: ShownProgram, ax: Axes) -> Axes:
    """First derivative with respect to the cam angle."""
    return _derivative(shown, ax, 1, "Velocity", GREEN)


def acceleration(shown: ShownProgram, ax: Axes) -> Axes:
    """Second derivative with respect to the cam angle."""
    return _derivative(shown, ax, 2, "Acceleration", ORANGE)


def jerk(shown: ShownProgram, ax: Axes) -> Axes:
    """Third derivative with respect to the cam angle."""
    return _derivative(shown, ax, 3, "Jerk", PURPLE)


PROGRAM_VIEWS = (displacement, velocity, acceleration, jerk)
"""A motion program at a glance."""

DASHES = ("-", "--", "-.", ":")


def law_overlay(k: int, name: str) -> Any:
    """A view that lays the ``k``-th derivative of several laws over each other."""

    def view(laws: Sequence[Law], ax: Axes) -> Axes:
        u = np.linspace(0, 1, 1001)
        first = new(ax)
        for i, law in enumerate(laws):
            style = {"color": (*COLOURS, INK, GREY)[i % 7], "linestyle": DASHES[i // 7], "label": law.name}
            line(ax, law.name, u, law(u)[k], **style)
        if first:
            frame(ax, name, "share of the angle", f"{'svaj'[k]}")
            if k == 0:
                ax.legend(loc="upper left")
        return ax

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


def vibration_left(shown: ShownVibration, ax: Axes) -> Axes:
    """What still rings after the rise, against the speed of the machine (fast on the left)."""
    if new(ax):
        frame(ax, "Residual vibration", "rise time / natural period", "amplitude after the rise  [% of lift]")
        ax.set(xscale="log", yscale="log", ylim=(0.003, 200))
        ax.set_xticks([0.5, 1, 2, 3, 5, 10], ["0.5", "1", "2", "3", "5", "10"])
        ax.minorticks_off()
    for i, (law, residual) in enumerate(zip(shown.laws, shown.residual, strict=True)):
        line(
            ax,
            law.name,
            shown.tau,
            np.maximum(100 * residual, 1e-4),
            color=(*COLOURS, INK, GREY)[i % 7],
            label=law.name,
        )
    if ax.get_legend() is None:
        ax.legend(loc="lower left")
    return ax
