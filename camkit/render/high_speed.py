"""Views of a high-speed cam and of the cam with lever: motion, contact stress, wear, Hertz pressure, with their peaks.

Blue is the interval in which the arm swings away, orange the one in which it swings back, grey the dwells.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ..geometry import circle, rotated
from ..kinds import refuse_arguments, refuse_empty
from ..search.minimise import Minimum
from ..units import deg, factor, mm
from ..views.cam import cam_torque, mechanism, pressure_angle
from .artists import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    WARNING,
    Formula,
    area,
    beside_title,
    frame,
    gaps,
    line,
    new,
    text,
)
from .progress import axis_label, unit_text

AWAY_BACK = (("away", BLUE), ("back", ORANGE))
ROOM = 1.42
"""Height of the axes over the highest peak: there its value is written."""


class Along(NamedTuple):
    """What a curve is drawn over: its name, the function that gives it, its unit, and how a place on it is signed."""

    name: str
    of: Callable[[Any], Any]
    unit: str
    sign: str


TURN = Along("cam angle", lambda part: part.cam_angle, "deg", "°")
WAY = Along("way of the slider", lambda part: part.cam.load.way(part.motion, part.cam.swing), "mm", " mm")


def motion_over_turn(analysis: Any, ax: Axes) -> Axes:
    """Travel, velocity, acceleration and jerk by the cam angle over the whole turn, each over its own peak."""
    first = new(ax)
    if first:
        frame(ax, "Motion", "cam angle  [deg]", "share of its peak")
    parts = (("s", BLUE, "-"), ("v", GREEN, "-"), ("a", ORANGE, "-"), ("j", PURPLE, ":"))
    for (key, colour, style), values in zip(parts, analysis.motion, strict=True):
        share = values / np.abs(values).max()
        line(ax, key, analysis.cam_angle / deg, share, color=colour, linestyle=style, label=key)
    if first:
        beside_title(ax)
    return ax


class Curve(NamedTuple):
    """What is drawn: title, letter, unit, and the function that gives it, SI."""

    title: str
    letter: str
    unit: str
    of: Callable[[Any], Any]


def _stress(part: Any) -> Any:
    return part.stress_coefficient / mm**0.5


def _wear(part: Any) -> Any:
    return part.wear_coefficient / mm**0.5


STRESS = Curve("Contact stress", r"$F_\sigma$", "N^0.5 mm^-0.5", _stress)
WEAR = Curve("Wear", r"$F_{wear}$", "N^1.5 mm^-0.5", _wear)
HERTZ = Curve("Hertz pressure", "$p_0$", "MPa", attrgetter("hertz_pressure"))


def _with_peaks(analysis: Any, ax: Axes, curve: Curve, along: Along = TURN) -> Axes:
    """A curve with the peaks of away and back, their values and places.

    Vermilion, at 0: there is none, as the roller undercuts the profile or has lost contact, or no spring holds the arm.
    """
    if new(ax):
        frame(ax, curve.title, f"{along.name}  [{along.unit}]", Formula(f"{curve.letter}  [{unit_text(curve.unit)}]"))
    x, y = _values(analysis, curve, along)
    line(ax, "dwell", x, y, color=GREY, linewidth=1.4)
    for (way, colour), part, middle in zip(AWAY_BACK, analysis.intervals, (0.25, 0.75), strict=True):
        line(ax, way, *_values(part, curve, along), color=colour)
        where, peak = _peak(part, curve, along)
        line(ax, f"{way} peak", where, peak, color=colour, marker="o", markersize=8, zorder=4)
        there = np.isfinite(peak[0])
        told = f"{peak[0]:.4g}\nat {where[0]:.1f}{along.sign}" if there else _why_none(part)
        style: Any = {"ha": "center", "va": "top", "fontsize": 10, "linespacing": 1.05, "transform": ax.transAxes}
        text(ax, f"{way} value", middle, 0.985, f"{way} {told}", **style).set_color(INK if there else WARNING)
    line(ax, "none", x, gaps(0 * x, ~np.isfinite(y)), color=WARNING, linewidth=4.5, zorder=4)
    line(ax, "room", x[[0, -1]], [0, ROOM * (np.nanmax(y, initial=0) or 1.0)], alpha=0)
    return ax


def _values(part: Any, curve: Curve, along: Along) -> tuple[Any, Any]:
    """Where, and what there is, in the units of the axes."""
    return along.of(part) / factor(along.unit), curve.of(part) / factor(curve.unit)


def _peak(part: Any, curve: Curve, along: Along) -> tuple[Any, Any]:
    """Where an interval's peak is and how high, ``(1,)`` in the units of the axes."""
    found = part.highest(curve.of)
    where = along.of(part.at(np.atleast_1d(found.cam_angle)))
    return where / factor(along.unit), np.atleast_1d(found.value) / factor(curve.unit)


def _why_none(part: Any) -> str:
    """Why a stress is missing somewhere in an interval."""
    if not np.isfinite(part.normal_force).all():  # no spring follows an arm that passes its start
        return "arm passes\nits start"
    return "undercut\n" if part.undercut.any() else "loses\ncontact"


def contact_stress(analysis: Any, ax: Axes) -> Axes:
    """The coefficient ``F_sigma`` over the turn."""
    return _with_peaks(analysis, ax, STRESS)


def wear(analysis: Any, ax: Axes) -> Axes:
    """The coefficient ``F_wear`` over the turn."""
    return _with_peaks(analysis, ax, WEAR)


def hertz_pressure(analysis: Any, ax: Axes) -> Axes:
    """The largest pressure between cam and roller over the turn."""
    return _with_peaks(analysis, ax, HERTZ)


HIGH_SPEED_VIEWS = (
    mechanism,
    motion_over_turn,
    pressure_angle,
    contact_stress,
    wear,
    hertz_pressure,
    cam_torque,
)
"""What a designer of a high-speed cam wants to see at once."""

# ---------------------------------------------------------------- the cam with lever


def cam_lever_mechanism(analysis: Any, ax: Axes, turn: float = 0.0) -> Axes:
    """Cam, roller, lever and slider to scale, the cam turned by ``turn`` (rad).

    The slider goes up and down where the paper's sizes put it; the lever is level at half stroke.
    """
    press, i = analysis.press, int(np.argmin(abs(analysis.cam_angle - turn)))
    cam = rotated(analysis.profile, float(analysis.turn[i]))
    pitch = rotated(analysis.pitch, float(analysis.turn[i]))
    if new(ax):
        frame(ax, "Cam, lever and slider", "x  [mm]", "y  [mm]")
        ax.set_aspect("equal", adjustable="datalim")
        ax.plot(0, 0, "+", color=INK, markersize=12)
    profile = _upright(press, cam)
    area(ax, "cam", profile, facecolor=PALE, edgecolor="none", zorder=1)
    line(ax, "pitch", *_upright(press, pitch), color=GREY, linestyle="--", linewidth=1, zorder=2)
    line(ax, "profile", *profile, color=BLUE, linewidth=2.4, zorder=3, label="cam")
    cut = gaps(profile, analysis.undercut)
    line(ax, "undercut", *cut, color=WARNING, linewidth=4.5, zorder=4, label="undercut")
    pivot, centre = (_upright(press, point) for point in (analysis.cranks["arm"][0], analysis.roller_centre[:, i]))
    _lever(ax, pivot, centre, pivot + _to_slider(analysis, i) / mm, press.roller_radius / mm)
    if ax.get_legend() is None:
        shown = [line for line in ax.lines if not str(line.get_label()).startswith("_")]
        ax.legend(
            handles=shown, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4.2, ncols=5, columnspacing=1.2
        )
    return ax


def _upright(press: Any, points: Any) -> np.ndarray:
    """Points of the machine's frame as they stand: pivot below the cam axis and beside it, arm under the cam; mm."""
    x, y = points
    down = -np.arctan2(press.pivot_height, press.slider_distance - press.lever)
    return rotated(np.array([x, -y]), down) / mm


def _to_slider(analysis: Any, i: int) -> np.ndarray:
    """From the lever's pivot to its end."""
    tilt = analysis.motion.s[i] - analysis.press.swing / 2
    return analysis.press.lever * np.array([np.cos(tilt), np.sin(tilt)])


def _lever(ax: Axes, pivot: Any, centre: Any, end: Any, radius: float) -> None:
    """Arm with roller, lever with slider, and the line on which the slider goes."""
    round_ends: Any = {"solid_capstyle": "round", "zorder": 6}
    line(ax, "guide", [end[0]] * 2, [end[1] - 90, end[1] + 90], color=GREY, linestyle=":", linewidth=1.2)
    line(ax, "arm", *np.transpose([centre, pivot]), color=ORANGE, linewidth=5, alpha=0.85, label="arm", **round_ends)
    line(ax, "roller", *circle(centre, radius), color=ORANGE, linewidth=2.2, **round_ends)
    line(ax, "lever", *np.transpose([pivot, end]), color=GREEN, linewidth=5, alpha=0.85, label="lever", **round_ends)
    dot: Any = {"marker": "o", "markersize": 9, "markerfacecolor": "white", "zorder": 7}
    line(ax, "pivot", [pivot[0]], [pivot[1]], color=INK, **dot)
    block = np.array([[-16, 16, 16, -16, -16], [-34, -34, 34, 34, -34]]) + np.reshape(end, (2, 1))
    line(ax, "slider", *block, color=PURPLE, linewidth=3, zorder=5, label="slider")


def lever_stress_over_way(analysis: Any, ax: Axes) -> Axes:
    """The coefficient ``F_sigma`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, ax, STRESS._replace(unit="N^0.5 cm^-0.5"), WAY)


def lever_wear_over_way(analysis: Any, ax: Axes) -> Axes:
    """The coefficient ``F_wear`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, ax, WEAR._replace(unit="N^1.5 cm^-0.5"), WAY)


def slider_load(analysis: Any, ax: Axes) -> Axes:
    """Weight ``G`` of the slider, and with it the force ``P`` of the work, over the slider's way."""
    press, first = analysis.press, new(ax)
    if first:
        frame(ax, "", "way of the slider  [mm]", "F  [N]")
    ax.set_title("Load" if press.force_curve else "Load (stand-in)")
    way = analysis.rise.cam.load.way(analysis.rise.motion, press.swing)
    line(ax, "weight", way / mm, press.weight + 0 * way, color=GREY, linestyle="--", label="G")
    line(ax, "load", way / mm, press.weight + press.force(way), color=BLUE, label="G + P")
    line(ax, "zero", way[[0, -1]] / mm, [0, 0], color=GREY, linewidth=0.8, label="_")
    if first:
        beside_title(ax)
    return ax


CAM_LEVER_VIEWS = (
    cam_lever_mechanism,
    motion_over_turn,
    pressure_angle,
    lever_stress_over_way,
    lever_wear_over_way,
    hertz_pressure,
    slider_load,
)
"""What a designer of a cam with lever wants to see at once."""


def radius_sweep(found: Sequence[Minimum], ax: Axes) -> Axes:
    """The least objective of several results of `minimise` over the largest radius that each was allowed."""
    refuse_arguments(radius_sweep, locals())
    refuse_empty(found, "results")
    measure = found[0].study.minimise[0]
    if new(ax):
        frame(ax, "What a larger cam buys", "largest radius allowed  [mm]", axis_label(measure))
    radius = np.array([best.study.free["max_radius"][1] for best in found]) / mm
    least = np.array([best.f for best in found]) / factor(measure.unit)
    line(ax, "least", radius, least, color=BLUE, marker="o", markersize=8)
    for x, y in zip(radius, least, strict=True):
        text(ax, f"at {x:g}", x, y, f" {y:.2f}", va="bottom", ha="left", color=INK, fontsize=11)
    ax.margins(0.12)
    return ax
