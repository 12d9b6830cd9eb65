"""Drawing that explains the valve cam: the geometry with its letters, made from a real design."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc

from ..geometry import circle, rotated
from ..units import deg, mm
from .artists import BLUE, GREEN, GREY, INK, ORANGE, PALE, PURPLE

LETTER: Any = {"fontsize": 15, "color": INK, "ha": "center", "va": "center"}


def valve_cam_sketch(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """A valve cam under a flat face with the letters of the formulas, at cam angle ``turn``."""
    whole, cam = analysis.whole, analysis.cam
    i = int(np.argmin(abs(whole.cam_angle - turn)))
    alpha, r0, h = float(whole.cam_angle[i]), cam.base_radius / mm, whole.lift[i] / mm
    profile = rotated(whole.profile, alpha) / mm
    ax.fill(*profile, color=PALE)
    ax.plot(*profile, color=BLUE, linewidth=2.8)
    ax.plot(*circle((0, 0), r0), color=GREY, linestyle="--", linewidth=1.1)
    ax.plot(0, 0, "o", color=INK, markerfacecolor="white", markersize=9, zorder=5)
    ax.plot([-26, 26], [r0 + h] * 2, color=ORANGE, linewidth=4, solid_capstyle="round")
    ax.plot([0, 0], [r0 + h, r0 + h + 16], color=ORANGE, linewidth=7, alpha=0.55)
    ax.plot([0, 0], [0, r0 + h], color=GREY, linewidth=1, linestyle="-.")
    _angles(ax, alpha, cam.half_angle, r0, (cam.base_radius + cam.max_lift) / mm)
    _lengths(ax, r0, h)
    _contact(ax, whole.contact_point[:, i] / mm, whole.flat_radius[i] / mm, r0 + h)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax


def _angles(ax: Axes, alpha: float, half: float, r0: float, tip: float) -> None:
    """The radii to the start of the flank and to the nose, the cam angle and the half angle."""
    for turned, length, word in ((alpha, r0, "start of the flank"), (alpha - half, tip, "nose")):
        x, y = length * np.array([-np.sin(turned), np.cos(turned)])
        ax.plot([0, x], [0, y], color=GREY, linewidth=1)
        ax.plot(x, y, "o", color=BLUE, markersize=8, zorder=4)
        side = "right" if x < 0 else "left"
        ax.text(x * 1.06, y * 1.02 + 0.6, word, color=BLUE, fontsize=12, ha=side, va="bottom" if x < 0 else "top")
    for size, first, last, letter, at in (
        (22, 90, 90 + alpha / deg, r"$\alpha$", alpha / 2),
        (34, 90 + (alpha - half) / deg, 90 + alpha / deg, r"$\alpha_B$", (alpha - half) * 0.72),
    ):
        ax.add_patch(Arc((0, 0), size, size, theta1=first, theta2=last, color=INK))
        beside = size / 2 + 2.6
        ax.text(-beside * np.sin(at), beside * np.cos(at), letter, **LETTER)


def _lengths(ax: Axes, r0: float, h: float) -> None:
    """Base radius and lift beside the line of travel, far left."""
    x = -1.5 * r0
    for low, high, letter in ((0, r0, "$r_0$"), (r0, r0 + h, "$h$")):
        ax.annotate("", (x, high), (x, low), arrowprops={"arrowstyle": "<|-|>", "color": INK})
        ax.text(x - 3, (low + high) / 2, letter, **LETTER)
    for y, end in ((0, -1), (r0, -1), (r0 + h, -25)):
        ax.plot([x - 1.5, end], [y, y], color=GREY, linewidth=0.7, linestyle=":")


def _contact(ax: Axes, contact: Any, radius: float, face: float) -> None:
    """The contact, its distance from the line of travel, and the circle that fits the cam there."""
    x, y = contact
    ax.plot(*circle((x, y - radius), radius), color=PURPLE, linewidth=1.6)
    ax.plot([x, x], [y, y - radius], color=PURPLE, linewidth=1.6)
    ax.plot(x, y - radius, "+", color=PURPLE, markersize=10)
    ax.text(x - 2.6, y - 0.6 * radius, r"$\rho$", **(LETTER | {"color": PURPLE}))
    ax.plot(x, y, "o", color=INK, markerfacecolor="white", markersize=9, zorder=6)
    ax.annotate("", (x, face + 4), (0, face + 4), arrowprops={"arrowstyle": "<|-|>", "color": GREEN})
    ax.plot([x, x], [face, face + 5], color=GREEN, linewidth=0.8)
    ax.text(x / 2, face + 6.8, r"$h'$", **(LETTER | {"color": GREEN}))
    ax.text(x + 2, face + 1.2, "contact", color=INK, fontsize=12, ha="left", va="bottom")
