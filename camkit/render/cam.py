"""Views of disk cams: each takes any cam analysis that has ``curves`` (and ``cranks`` for the mechanism)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..geometry import circle, rotated
from ..quantities import Measure
from ..units import deg, mm
from .artists import (
    BLUE,
    COLOURS,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    SKY,
    WARNING,
    area,
    beside_title,
    colours,
    frame,
    gaps,
    line,
    new,
)

CURVE_COLOUR = {"cam": BLUE, "lift": BLUE, "relief": ORANGE}


def cam_mechanism(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """The cam as it is cut, its rollers, faces and cranks, with the cam turned by ``turn`` (rad).

    Grey band: the groove between its two flanks; vermilion: stretches that the roller undercuts.
    """
    i = int(np.argmin(abs(analysis.cam_angle - turn)))
    on_machine = float(analysis.turn[i])
    pitch, inner, outer = (
        rotated(getattr(analysis, k), on_machine) / mm for k in ("pitch", "profile", "outer_profile")
    )
    if new(ax):
        frame(ax, "Cam and follower", "x  [mm]", "y  [mm]")
        ax.set_aspect("equal", adjustable="datalim")
        ax.plot(0, 0, "+", color=INK, markersize=12)
    area(ax, "groove", np.hstack([inner, outer[:, ::-1]]), facecolor=PALE, edgecolor="none", zorder=1)
    line(ax, "pitch", *pitch, color=GREY, linestyle="--", linewidth=1, zorder=2, label="pitch curve")
    line(ax, "profile", *inner, color=BLUE, linewidth=2.4, zorder=3, label="profile")
    groove = "groove's outer flank" if np.isfinite(outer).any() else "_"
    line(ax, "outer flank", *outer, color=SKY, linewidth=1.4, zorder=3, label=groove)
    cut = (*gaps(inner, analysis.undercut), *gaps(outer, analysis.outer_undercut))
    line(ax, "undercut", cut[0], cut[1], color=WARNING, linewidth=4.5, zorder=4, label="undercut")
    line(ax, "outer undercut", cut[2], cut[3], color=WARNING, linewidth=4.5, zorder=4)
    for (name, (pivot, centre)), colour in zip(analysis.cranks.items(), colours(len(analysis.cranks)), strict=True):
        _crank(ax, name, pivot / mm, centre[:, i] / mm, analysis.cam.roller_radius / mm, colour)
    if hasattr(analysis, "face"):
        face = analysis.face[..., i] / mm
        line(ax, "face", *face, color=COLOURS[0], linewidth=6, solid_capstyle="butt", zorder=6)
    if ax.get_legend() is None:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4.2, ncols=4, columnspacing=1.2)
    return ax


def _crank(ax: Axes, name: str, pivot: Any, centre: Any, radius: float, colour: str) -> None:
    arm = {"color": colour, "solid_capstyle": "round", "zorder": 6}
    line(ax, f"{name} arm", [pivot[0], centre[0]], [pivot[1], centre[1]], linewidth=4, alpha=0.85, **arm)
    line(ax, f"{name} pivot", [pivot[0]], [pivot[1]], marker="o", markersize=9, markerfacecolor="white", **arm)
    line(ax, f"{name} roller", *circle(centre, radius), linewidth=2, **arm)


def motion(analysis: Any, ax: Axes) -> Axes:
    """Position, velocity, acceleration and jerk of every follower, each over its own peak."""
    first = new(ax)
    if first:
        frame(ax, "Motion", "cam angle  [deg]", "share of its peak")
    parts = (("s", BLUE, "-"), ("v", GREEN, "-"), ("a", ORANGE, "-"), ("j", PURPLE, ":"))
    for name, curve in analysis.curves.items():
        moves = _moving(curve)
        for (key, colour, style), values in zip(parts, curve.motion, strict=True):
            peak = np.abs(values).max() or 1.0
            label = key if name == next(iter(analysis.curves)) else "_"
            line(
                ax,
                f"{name} {key}",
                curve.cam_angle / deg,
                gaps(values / peak, moves),
                color=colour,
                linestyle=style,
                label=label,
            )
    if first:
        beside_title(ax)
    return ax


def _moving(curve: Any) -> Any:
    """Where the follower moves, and one sample on either side."""
    v = curve.velocity != 0
    return v | np.append(v[1:], False) | np.insert(v[:-1], 0, False)


def _each(analysis: Any, ax: Axes, name: str, unit: float, dwell: bool = True) -> None:
    for curve_name, curve in analysis.curves.items():
        y = getattr(curve, name) / unit
        y = y if dwell else gaps(y, _moving(curve))
        line(ax, curve_name, curve.cam_angle / deg, y, color=CURVE_COLOUR.get(curve_name, BLUE), label=curve_name)


def _legend(ax: Axes, analysis: Any) -> None:
    if len(analysis.curves) > 1:
        beside_title(ax)


def pressure_angle(analysis: Any, ax: Axes, limits: Mapping[Measure, float] | None = None) -> Axes:
    """The signed pressure angle, and the band that the ``limits`` of its measures leave; without any, no band."""
    first = new(ax)
    if first:
        frame(ax, "Pressure angle", "cam angle  [deg]", "alpha  [deg]")
        allowed = {value / deg for measure, value in (limits or {}).items() if "pressure angle" in measure.name}
        for limit in allowed:
            for edge in (-limit, limit):
                ax.axhline(edge, color=GREEN, linewidth=1)
        if allowed:
            ax.axhspan(-min(allowed), min(allowed), color=GREEN, alpha=0.10, linewidth=0)
    _each(analysis, ax, "pressure_angle", deg)
    if first:
        _legend(ax, analysis)
    return ax


def contact_force(analysis: Any, ax: Axes) -> Axes:
    """Force between cam and follower, without friction."""
    first = new(ax)
    if first:
        frame(ax, "Contact force", "cam angle  [deg]", "F  [N]")
    _each(analysis, ax, "contact_force", 1.0)
    if first:
        _legend(ax, analysis)
    return ax


def cam_torque(analysis: Any, ax: Axes) -> Axes:
    """Torque on the cam, without friction."""
    first = new(ax)
    if first:
        frame(ax, "Cam torque", "cam angle  [deg]", "M  [N mm]")
    _each(analysis, ax, "cam_torque", mm)
    if first:
        _legend(ax, analysis)
    return ax


def curvature(analysis: Any, ax: Axes) -> Axes:
    """Curvature of the pitch curve (full) and of the profile (thin), with the limits that the roller sets.

    Outside the band of plus and minus one over the roller's radius a flank is undercut.
    """
    first = new(ax)
    limit = mm / analysis.cam.roller_radius if analysis.cam.roller_radius else np.inf
    if first:
        frame(ax, "Curvature", "cam angle  [deg]", "kappa  [1/mm]")
    x = analysis.cam_angle[[0, -1]] / deg
    for sign in (-1, 1):
        line(
            ax,
            f"limit {sign}",
            x,
            [sign * limit] * 2,
            color=WARNING,
            linewidth=1,
            label="1 / roller radius" if sign > 0 else "_",
        )
    _each(analysis, ax, "curvature", 1 / mm)
    for name, curve in analysis.curves.items():
        inner = gaps(curve.profile_curvature * mm, abs(curve.profile_curvature * mm) < 2 * limit)
        line(
            ax,
            f"{name} profile",
            curve.cam_angle / deg,
            inner,
            color=CURVE_COLOUR.get(name, BLUE),
            linewidth=1,
            linestyle="--",
            label="_",
        )
    if first:
        beside_title(ax, [line for line in ax.lines if str(line.get_label()).startswith("1 /")])
    return ax


def efficiency(analysis: Any, ax: Axes) -> Axes:
    """Power out over power in: from the free-body diagram (full) and, of a rocking roller, as published (thin)."""
    first = new(ax)
    if first:
        frame(ax, "Efficiency", "cam angle  [deg]", "eta  [%]")
        ax.set_ylim(0, 100)
    for name, curve in analysis.curves.items():
        colour, moves = CURVE_COLOUR.get(name, BLUE), _moving(curve)
        x = curve.cam_angle / deg
        line(ax, name, x, gaps(100 * curve.efficiency, moves), color=colour, label=name)
        if hasattr(curve, "published_efficiency"):
            published, thin = gaps(100 * curve.published_efficiency, moves), {"linewidth": 1, "linestyle": "--"}
            line(ax, f"{name} published", x, published, color=colour, label="_", **thin)
    if first:
        _legend(ax, analysis)
    return ax


DOOR_HANDLE_VIEWS = (cam_mechanism, motion, pressure_angle, contact_force, cam_torque, curvature, efficiency)
"""What a designer of a cam wants to see at once."""
