"""Drawings that explain the high-speed cam: the geometry with its letters, and the contact, made from a real design."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc

from ..geometry import circle, rotated
from ..units import deg, mm
from .artists import BLUE, GREEN, GREY, INK, ORANGE, PALE, PURPLE

LETTER: Any = {"fontsize": 15, "color": INK, "ha": "center", "va": "center"}


def high_speed_sketch(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """A high-speed cam with the letters of the formulas, at cam angle ``turn``."""
    i = int(np.argmin(abs(analysis.cam_angle - turn)))
    cam, profile = analysis.cam, rotated(analysis.profile, float(analysis.turn[i])) / mm
    pivot, centre = analysis.cranks["arm"][0] / mm, analysis.roller_centre[:, i] / mm
    ax.fill(*profile, color=PALE)
    ax.plot(*profile, color=BLUE, linewidth=2.8)
    _radii(ax, profile, float(cam.min_radius / mm), cam.max_radius / mm)
    ax.plot(*circle(centre, cam.roller_radius / mm), color=ORANGE, linewidth=2.4)
    ax.plot(*np.transpose([pivot, centre]), color=ORANGE, linewidth=5, solid_capstyle="round")
    ax.plot(*np.transpose([(0, 0), pivot]), color=GREY, linewidth=1.2, linestyle="-.")
    for (x, y), name in (((0, 0), "O"), (pivot, "A")):
        ax.plot(x, y, "o", color=INK, markerfacecolor="white", markersize=10, zorder=6)
        ax.text(x, y - 13, name, **LETTER)
    ax.text(pivot[0] * 0.8, -10, "$L$", **LETTER)
    _write(ax, (pivot + 2 * centre) / 3 + (9, 8), "$l$")
    _arm_angle(ax, pivot, float(analysis.arm_angle[i]))
    _contact(ax, analysis, i, centre)
    ax.set_ylim(None, centre[1] + 100)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax


def _write(ax: Axes, at: Any, letter: str, colour: str = INK) -> None:
    ax.text(float(at[0]), float(at[1]), letter, **(LETTER | {"color": colour}))


def _radii(ax: Axes, profile: Any, least: float, largest: float) -> None:
    """The smallest and the largest circle of the profile, each with a radius."""
    for radius, letter, at in ((least, "$r_{k1}$", 150 * deg), (largest, "$r_{k2}$", 283 * deg)):
        ax.plot(*circle((0, 0), radius), color=GREY, linewidth=1, linestyle=":")
        x, y = radius * np.cos(at), radius * np.sin(at)
        ax.annotate("", (x, y), (0, 0), arrowprops={"arrowstyle": "-|>", "color": PURPLE})
        _write(ax, (0.6 * x - 13 * np.sin(at), 0.6 * y + 13 * np.cos(at)), letter, PURPLE)


def _arm_angle(ax: Axes, pivot: Any, t: float) -> None:
    """The arm's angle from the line of centres."""
    ax.add_patch(Arc(pivot, 84, 84, theta1=180 - t / deg, theta2=180, color=INK))
    ax.text(pivot[0] - 56 * np.cos(t / 2), pivot[1] + 56 * np.sin(t / 2), "$t$", **LETTER)


def _contact(ax: Axes, analysis: Any, i: int, centre: Any) -> None:
    """The normal force on the roller, the way its centre goes, the pressure angle between them, the roller's radius."""
    t, normal = float(analysis.arm_angle[i]), analysis.normal[:, i]
    moves, radius = np.array([np.sin(t), np.cos(t)]), analysis.cam.roller_radius / mm
    for direction, colour, letter in ((normal, INK, "$N$"), (moves, GREEN, r"$\psi'$")):
        tip = centre + 78 * direction
        ax.annotate(
            "", tip, centre, annotation_clip=False, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2.4}
        )
        _write(ax, centre + 90 * direction, letter, colour)
    ends = np.sort(np.degrees([np.arctan2(*v[::-1]) for v in (normal, moves)]))
    ax.add_patch(Arc(centre, 100, 100, theta1=ends[0], theta2=ends[1], color=INK))
    middle = np.radians(ends.mean())
    _write(ax, centre + 62 * np.array([np.cos(middle), np.sin(middle)]), r"$\theta$")
    ax.plot(*np.transpose([centre, centre - radius * normal]), color=ORANGE, linewidth=1.6)
    _write(ax, centre - 0.55 * radius * normal + (-8, 3), "$r$")
