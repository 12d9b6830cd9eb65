"""Views of a valve cam: the whole cam with its follower, the motion, radii of curvature, forces, stress, torque."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..data import load
from ..geometry import circle, rotated
from ..machines.valve_study import PAPER_MIN_RADIUS
from ..machines.valve_train import FLAT
from ..units import MPa, deg, mm
from .artists import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    WARNING,
    area,
    beside_title,
    frame,
    gaps,
    line,
    new,
    plain,
)
from .front import ShownFront, pareto

SHOWN_RADIUS = (-10, 45)
"""Radii of curvature (mm) that the view shows: where the flank begins they are far larger, and of no concern."""


def cam_and_follower(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """The whole cam at the cam angle ``turn`` with its follower; vermilion: stretches that the follower undercuts."""
    whole, cam = analysis.whole, analysis.cam
    i = int(np.argmin(abs(_around(whole.cam_angle - turn))))
    profile = rotated(whole.profile, float(whole.turn[i])) / mm
    if new(ax):
        frame(ax, f"Cam and {cam.follower.name}", "x  [mm]", "y  [mm]")
        ax.set_aspect("equal", adjustable="datalim")
        ax.plot(0, 0, "+", color=INK, markersize=14, zorder=5)
    ax.set_title(plain(f"Cam and {cam.follower.name}"))
    tip = circle((0, 0), np.hypot(*whole.profile).max() / mm)
    line(ax, "tip circle", *tip, color=GREY, linewidth=0.8, linestyle=":", zorder=1)
    area(ax, "cam", profile, facecolor=PALE, edgecolor="none", zorder=1)
    from_nose = abs(whole.cam_angle - cam.half_angle)
    ramps = from_nose <= cam.half_angle + cam.ramp_angle
    line(ax, "base circle", *profile, color=GREY, linewidth=2.4, zorder=3, label="base circle")
    line(ax, "ramps", *gaps(profile, ramps), color=GREEN, linewidth=3, zorder=3.1, label="ramps")
    line(ax, "flanks", *gaps(profile, from_nose <= cam.half_angle), color=BLUE, linewidth=3, zorder=3.2, label="flanks")
    line(ax, "undercut", *gaps(profile, whole.undercut), color=WARNING, linewidth=5, zorder=3.3, label="undercut")
    _follower(ax, whole, i)
    if ax.get_legend() is None:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4.2, ncols=4, columnspacing=1.2)
    return ax


def _around(angle: Any) -> Any:
    """The same angle within half a turn of 0."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _follower(ax: Axes, whole: Any, i: int) -> None:
    """Face or roller with its stem, which ends at a height that no turn changes, and the contact."""
    cam, lift = whole.cam, whole.lift[i]
    style: Any = {"color": ORANGE, "zorder": 4, "solid_capstyle": "round"}
    flat = cam.follower == FLAT
    height = (cam.base_radius + lift + (0 if flat else cam.roller_radius)) / mm
    top = (cam.base_radius + 1.6 * cam.max_lift + (0 if flat else 2 * cam.roller_radius)) / mm
    reach = 1.15 * abs(whole.velocity).max() / mm
    wheel = circle((0, height), cam.roller_radius / mm)
    line(ax, "follower", *([[-reach, reach], [height] * 2] if flat else wheel), linewidth=4 if flat else 2.5, **style)
    line(ax, "stem", [0, 0], [height, top], linewidth=7, alpha=0.55, **style)
    x, y = whole.contact_point[:, i] / mm
    line(ax, "contact", [x], [y], marker="o", markersize=9, color=INK, markerfacecolor="white", zorder=6)


def _over_event(ax: Axes, analysis: Any, title: str, ylabel: str) -> bool:
    """Labels, and thin lines at the nose and at both ends of the flanks; whether this is the first drawing."""
    first = new(ax)
    if first:
        frame(ax, title, "cam angle  [deg]", ylabel)
    ends = np.array([0, 1, 2]) * analysis.cam.half_angle / deg
    for name, x, style in zip(("start", "nose", "end"), ends, (":", "--", ":"), strict=True):
        line(ax, name, [x, x], [0, 1], color=GREY, linewidth=0.9, linestyle=style, transform=ax.get_xaxis_transform())
    return first


def lift(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """Lift from the start of the flank, negative on the ramps; the dot is at the cam angle ``turn``."""
    event = analysis.event
    _over_event(ax, analysis, "Lift", "h  [mm]")
    line(ax, "lift", event.cam_angle / deg, event.lift / mm, color=BLUE)
    off = _around(event.cam_angle - turn)
    i = np.flatnonzero(abs(off) == abs(off).min())[: int(abs(off).min() < 1 * deg)]
    here = {"marker": "o", "markersize": 8, "color": ORANGE, "linestyle": "none", "zorder": 4}
    line(ax, "here", event.cam_angle[i] / deg, event.lift[i] / mm, **here)
    return ax


def velocity(analysis: Any, ax: Axes) -> Axes:
    """Velocity of the follower at the camshaft's speed."""
    _over_event(ax, analysis, "Velocity", "v  [m/s]")
    line(ax, "velocity", analysis.event.cam_angle / deg, analysis.event.in_time.v, color=GREEN)
    return ax


def acceleration(analysis: Any, ax: Axes) -> Axes:
    """Acceleration of the follower at the camshaft's speed."""
    _over_event(ax, analysis, "Acceleration", "a  [m/s$^2$]")
    line(ax, "acceleration", analysis.event.cam_angle / deg, analysis.event.in_time.a, color=ORANGE)
    return ax


def jerk(analysis: Any, ax: Axes) -> Axes:
    """Jerk of the follower at the camshaft's speed."""
    _over_event(ax, analysis, "Jerk", r"j  [10$^6$ m/s$^3$]")
    j = analysis.event.in_time.j / 1e6
    line(ax, "jerk", analysis.event.cam_angle / deg, gaps(j, np.isfinite(j)), color=PURPLE)
    return ax


def radius_of_curvature(analysis: Any, ax: Axes) -> Axes:
    """Radius of the cam under a flat face and under the roller, the paper's limit, and the least under a face.

    Below 0 a flat face undercuts the cam; where the roller's curve has a gap the cam under it is hollow.
    """
    event = analysis.event
    first = _over_event(ax, analysis, "Radius", r"$\rho$  [mm]")
    x = event.cam_angle / deg
    line(ax, "flat", x, event.flat_radius / mm, color=BLUE, label="flat face")
    roller = gaps(event.roller_profile_radius / mm, event.curvature > 0)
    line(ax, "roller", x, roller, color=GREEN, linewidth=1.3, linestyle="--", label="roller")
    limit = PAPER_MIN_RADIUS / mm
    line(ax, "limit", x[[0, -1]], [limit] * 2, color=WARNING, linewidth=1.2)
    at, least = analysis.min_radius_angle / deg, analysis.min_radius / mm
    colour = BLUE if least >= limit else WARNING
    dot = line(ax, "least", [at], [least], marker="o", markersize=8, linestyle="none", zorder=4)
    dot.set_color(colour)
    if first:
        ax.set_ylim(*SHOWN_RADIUS)
        _legend(ax)
    return ax


def _legend(ax: Axes) -> None:
    beside_title(ax, [line for line in ax.lines if not str(line.get_label()).startswith("_")])


def spring_and_inertia(analysis: Any, ax: Axes) -> Axes:
    """The spring against what inertia asks of it, at the speed and (dashed) with the margin; vermilion: a jump."""
    event = analysis.event
    first = _over_event(ax, analysis, "Force", "F  [N]")
    x, spring = event.cam_angle / deg, event.spring_force
    line(ax, "spring", x, gaps(spring, event.valve_open), color=GREEN, label="spring")
    for key, speed, style in (("inertia", analysis.cam.speed, "-"), ("overspeed", analysis.top_speed, "--")):
        needed = event.needed_at(speed)
        pulled = gaps(needed, event.valve_open & (needed > 0))
        line(ax, key, x, pulled, color=ORANGE, linestyle=style, label=key if style == "-" else "_")
        line(ax, f"{key} jump", x, gaps(pulled, needed > spring), color=WARNING, linewidth=3.5, linestyle=style)
    if first:
        _legend(ax)
    return ax


def contact_stress(analysis: Any, ax: Axes) -> Axes:
    """Largest pressure between cam and follower while the valve is open; vermilion: undercut, where they do not fit."""
    event = analysis.event
    _over_event(ax, analysis, "Contact stress", "$p_0$  [MPa]")
    x = event.cam_angle / deg
    line(ax, "stress", x, gaps(event.contact_stress / MPa, event.valve_open), color=BLUE)
    line(ax, "undercut", x, gaps(0 * x, event.undercut), color=WARNING, linewidth=4)
    return ax


def camshaft_torque(analysis: Any, ax: Axes) -> Axes:
    """Torque on the camshaft over a whole turn, without friction: what the spring takes it gives back."""
    whole = analysis.whole
    _over_event(ax, analysis, "Camshaft torque", "M  [N m]")
    line(ax, "torque", whole.cam_angle / deg, whole.cam_torque, color=BLUE)
    return ax


def fullness_front(shown: ShownFront, ax: Axes) -> Axes:
    """A front of fullness against peak positive acceleration, and the points that are known of it."""
    pareto(shown, ax)
    points = load("valve")["formulas"]["front"]
    style: Any = {"linestyle": "none", "marker": "D", "markersize": 9, "markerfacecolor": "none", "markeredgewidth": 2}
    line(ax, "known", points["fullness"], points["acceleration"], color=GREEN, label="known points", zorder=6, **style)
    ax.legend(handles=[mark for mark in ax.lines if mark.get_label() in ("front", "start", "known points")])
    return ax


VALVE_VIEWS = (
    cam_and_follower,
    lift,
    velocity,
    acceleration,
    jerk,
    radius_of_curvature,
    spring_and_inertia,
    contact_stress,
    camshaft_torque,
)
"""What a designer of a valve cam wants to see at once."""
