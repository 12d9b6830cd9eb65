"""Designs beside each other: disk cams to one scale, and the curve behind a peak for each of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..geometry import circle, rotated
from ..kinds import refuse_empty, refuse_kinds
from ..quantities import PeakMeasure
from ..units import deg, factor, mm
from .artists import BLUE, GREEN, GREY, INK, PALE, PURPLE, area, beside_title, colours, frame, line, new, text

SHADES = (GREY, BLUE, GREEN, PURPLE)
"""One for each design in turn; what the others are compared with comes first."""
GAP = 40.0
"""Between two cams with their arms, mm."""


@dataclass(frozen=True)
class Beside:
    """Analyses of cams by name, and the peak whose curves are compared."""

    analyses: Mapping[str, Any]
    peak: PeakMeasure | None = None
    """Without one, only the cams can be drawn."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        refuse_empty(self.analyses, "analyses")


def cams_beside(shown: Beside, ax: Axes, turn: float = 0.0) -> Axes:
    """Each cam with its arms and rollers, all to the same scale, turned by ``turn`` (rad)."""
    if new(ax):
        frame(ax, "To the same scale", "x  [mm]", "y  [mm]")
        ax.set_aspect("equal", adjustable="datalim")
    x = 0.0
    for (name, analysis), colour in zip(shown.analyses.items(), colours(len(shown.analyses), SHADES), strict=True):
        left, right = _reach(analysis)
        x -= left if x else 0.0
        _cam(ax, name, analysis, turn, x, colour)
        x += right + GAP
    return ax


def _reach(analysis: Any) -> tuple[float, float]:
    """How far a cam with its arms reaches to the left and to the right of its axis over the turn, mm."""
    size = float(np.hypot(*analysis.profile).max())
    ends = [[pivot[0], *centre[0]] for pivot, centre in analysis.cranks.values()]
    x = np.concatenate([[-size, size], *ends])
    radius = analysis.cam.roller_radius
    return min(x[0], x.min() - radius) / mm, max(x[1], x.max() + radius) / mm


def _cam(ax: Axes, name: str, analysis: Any, turn: float, x: float, colour: str) -> None:
    i = int(np.argmin(abs(analysis.cam_angle - turn)))
    at, style = np.array([[x], [0.0]]), {"color": colour, "zorder": 6}
    profile = rotated(analysis.profile, float(analysis.turn[i])) / mm + at
    area(ax, f"{name} cam", profile, facecolor=PALE, edgecolor=colour, linewidth=2.4, zorder=2)
    line(ax, f"{name} axis", [x], [0.0], marker="+", markersize=12, color=INK, zorder=6)
    for arm, (pivot, centre) in analysis.cranks.items():
        a, b = np.ravel(pivot) / mm + at[:, 0], centre[:, i] / mm + at[:, 0]
        line(ax, f"{name} {arm} arm", *np.transpose([a, b]), linewidth=4, solid_capstyle="round", alpha=0.85, **style)
        line(ax, f"{name} {arm} pivot", a[:1], a[1:], marker="o", markersize=9, markerfacecolor="white", **style)
        line(ax, f"{name} {arm} roller", *circle(b, analysis.cam.roller_radius / mm), linewidth=2, **style)
    bottom = -1.06 * float(np.hypot(*analysis.profile).max()) / mm
    text(ax, f"{name} name", x, bottom, name, color=INK, ha="center", va="top", fontweight="bold")


def curves_beside(shown: Beside, ax: Axes) -> Axes:
    """The curve whose largest value is the peak, for each cam over its turn; the largest value as a line."""
    peak, first = shown.peak, new(ax)
    if peak is None or peak.angle is None:
        raise ValueError("there is no peak, with an angle for its curve, whose curves could be compared")
    if first:
        frame(ax, peak.name[:1].upper() + peak.name[1:], "cam angle  [deg]", peak.label)
    for (name, analysis), colour in zip(shown.analyses.items(), colours(len(shown.analyses), SHADES), strict=True):
        x, y = np.ravel(peak.angle(analysis)) / deg, np.ravel(peak.curve(analysis)) / factor(peak.unit)
        jumps = np.flatnonzero(np.diff(x) > 3 * np.median(np.diff(x))) + 1
        line(ax, f"{name} curve", np.insert(x, jumps, np.nan), np.insert(y, jumps, np.nan), color=colour, label=name)
        line(ax, f"{name} peak", x[[0, -1]], [y.max()] * 2, color=colour, linewidth=1, linestyle="--", label="_")
    if first:
        ax.set_ylim(bottom=0)
        beside_title(ax)
    return ax
