"""Drawings that explain: the geometry with its letters, made from a real design."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc

from ..geometry import circle, rotated
from ..units import deg, mm
from .artists import BLUE, GREEN, GREY, INK, ORANGE, SKY, WARNING

LETTER: Any = {"fontsize": 15, "color": INK, "ha": "center", "va": "center"}


def roller_cam_sketch(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """The geometry of an oscillating roller cam (one curve) with the letters of the formulas, at cam angle ``turn``."""
    i = int(np.argmin(abs(analysis.cam_angle - turn)))
    pivot, centre = (p / mm for p in (analysis.cranks["arm"][0], analysis.roller_centre[:, i]))
    normal, radius = analysis.normal[:, i], analysis.cam.roller_radius / mm
    on_machine = _turned(analysis, i)
    ax.plot(*(on_machine("pitch") / mm), color=GREY, linestyle="--", linewidth=1.2)
    ax.plot(*(on_machine("profile") / mm), color=BLUE, linewidth=2.6)
    ax.plot(*circle(centre, radius), color=ORANGE, linewidth=2.2)
    ax.plot(*np.transpose([[0, 0], pivot]), color=GREY, linewidth=1.2)
    ax.plot(*np.transpose([[0, 0], centre]), color=GREY, linewidth=1.2)
    ax.plot(*np.transpose([pivot, centre]), color=ORANGE, linewidth=4, solid_capstyle="round")
    for x, y, name in ((0, 0, "O"), (*pivot, "A")):
        ax.plot(x, y, "o", color=INK, markerfacecolor="white", markersize=9, zorder=5)
        ax.text(x, y - 5.5, name, **LETTER)
    _middle(ax, (0, 0), pivot, "$a$", (0, -4))
    _middle(ax, pivot, centre, "$l$", (3, 4))
    _middle(ax, (0, 0), centre, "$R$", (-4, 1))
    _angles(ax, analysis, i, pivot, centre, normal)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax


def _turned(analysis: Any, i: int) -> Any:
    return lambda name: rotated(getattr(analysis, name), float(analysis.turn[i]))


def _write(ax: Axes, at: Any, words: str, **style: Any) -> None:
    ax.text(float(at[0]), float(at[1]), words, **style)


def _middle(ax: Axes, first: Any, second: Any, letter: str, shift: tuple[float, float]) -> None:
    x, y = (np.asarray(first) + np.asarray(second)) / 2 + shift
    ax.text(x, y, letter, **LETTER)


def _angles(ax: Axes, analysis: Any, i: int, pivot: Any, centre: Any, normal: Any) -> None:
    """The contact normal, the direction in which the roller moves, and the angle between them; the arm's angle."""
    psi = float(analysis.arm_angle[i])
    moves = np.array([np.sin(psi), np.cos(psi)])
    size = 34.0
    for direction, colour, word in ((normal, WARNING, "normal"), (moves, GREEN, "roller moves")):
        tip = centre + size * direction
        ax.annotate(
            "", tip, centre, annotation_clip=False, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 2}
        )
        _write(ax, centre + 1.13 * size * direction, word, color=colour, fontsize=12, ha="center", va="bottom")
    ends = np.degrees([np.arctan2(normal[1], normal[0]), np.arctan2(moves[1], moves[0])])
    ax.add_patch(Arc(centre, 40, 40, theta1=min(ends), theta2=max(ends), color=INK))
    middle = np.radians(ends.mean())
    _write(ax, centre + 24.5 * np.array([np.cos(middle), np.sin(middle)]), r"$\alpha$", **LETTER)
    ax.add_patch(Arc(pivot, 34, 34, theta1=180 - psi / deg, theta2=180, color=INK))
    ax.text(pivot[0] - 21 * np.cos(psi / 2), pivot[1] + 21 * np.sin(psi / 2), r"$\psi$", **LETTER)
    contact = centre - analysis.cam.roller_radius / mm * normal
    ax.plot(*np.transpose([centre, contact]), color=SKY, linewidth=2)
    _write(ax, centre - 1.9 * analysis.cam.roller_radius / mm * normal, "$r_T$", **LETTER)
