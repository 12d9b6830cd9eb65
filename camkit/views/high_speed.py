"""Views of a cam of two intervals: motion, contact stress, wear, Hertz pressure, with their peaks.

The first of the series is the interval in which the arm swings away, the second that in which it swings back.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from ..quantities.kinds import refuse_arguments, refuse_empty
from ..units import deg, factor, mm
from .cam import ANGLE, MOTION, cam_torque, mechanism, pressure_angle
from .picture import Axes, Line, Mark, Picture, Points, Text, gaps

AWAY_BACK = ("away", "back")
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


def motion_over_turn(analysis: Any) -> Picture:
    """Travel, velocity, acceleration and jerk by the cam angle over the whole turn, each over its own peak."""
    marks = [
        Line(key, analysis.cam_angle / deg, values / np.max(abs(values)), role=role, label=key)
        for key, role, values in zip("svaj", MOTION, analysis.motion, strict=True)
    ]
    return Picture.of(Axes(title="Motion", xlabel=ANGLE, ylabel="share of its peak"), marks)


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


STRESS = Curve("Contact stress", "F_sigma", "N^0.5 mm^-0.5", _stress)
WEAR = Curve("Wear", "F_wear", "N^1.5 mm^-0.5", _wear)
HERTZ = Curve("Hertz pressure", "p_0", "MPa", attrgetter("hertz_pressure"))


def _with_peaks(analysis: Any, curve: Curve, along: Along = TURN) -> Picture:
    """A curve with the peaks of away and back, their values and places.

    Trouble, at 0: there is none, as the roller undercuts the profile or has lost contact, or no spring holds the arm.
    """
    x, y = _values(analysis, curve, along)
    top = ROOM * (np.nanmax(y, initial=0) or 1.0)
    marks: list[Mark] = [Line("dwell", x, y, role="guide", stroke="thin")]
    for index, (way, part) in enumerate(zip(AWAY_BACK, analysis.intervals, strict=True)):
        style: Any = {"role": "series", "index": index}
        where, peak = _peak(part, curve, along)
        there = bool(np.isfinite(peak[0]))
        told = f"{peak[0]:.4g}\nat {where[0]:.1f}{along.sign}" if there else _why_none(part)
        middle = np.min(x) + (0.25 + 0.5 * index) * np.ptp(x)
        marks += [
            Line(way, *_values(part, curve, along), **style),
            Points(f"{way} peak", where, peak, **style),
            Text(f"{way} value", middle, top, f"{way} {told}", anchor="top", role="ink" if there else "trouble"),
        ]
    marks.append(Line("none", x, gaps(0 * x, ~np.isfinite(y)), role="trouble"))
    label = f"{curve.letter}  [{curve.unit}]"
    return Picture.of(
        Axes(title=curve.title, xlabel=f"{along.name}  [{along.unit}]", ylabel=label, ylim=(0, top)), marks
    )


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
    if not np.isfinite(part.contact_force).all():  # no spring follows an arm that passes its start
        return "arm passes\nits start"
    return "undercut\n" if part.undercut.any() else "loses\ncontact"


def contact_stress(analysis: Any) -> Picture:
    """The coefficient ``F_sigma`` over the turn."""
    return _with_peaks(analysis, STRESS)


def wear(analysis: Any) -> Picture:
    """The coefficient ``F_wear`` over the turn."""
    return _with_peaks(analysis, WEAR)


def hertz_pressure(analysis: Any) -> Picture:
    """The largest pressure between cam and roller over the turn."""
    return _with_peaks(analysis, HERTZ)


HIGH_SPEED_VIEWS = (mechanism, motion_over_turn, pressure_angle, contact_stress, wear, hertz_pressure, cam_torque)
"""What a designer of a high-speed cam wants to see at once."""


def stress_over_way(analysis: Any) -> Picture:
    """The coefficient ``F_sigma`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, STRESS._replace(unit="N^0.5 cm^-0.5"), WAY)


def wear_over_way(analysis: Any) -> Picture:
    """The coefficient ``F_wear`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, WEAR._replace(unit="N^1.5 cm^-0.5"), WAY)


def slider_load(analysis: Any) -> Picture:
    """Weight ``G`` of the slider, and with it the force ``P`` of the work, over the slider's way."""
    press = analysis.press
    way = analysis.rise.cam.load.way(analysis.rise.motion, press.swing)
    title = "Load" if press.force_curve else "Load (stand-in)"
    return Picture.of(
        Axes(title=title, xlabel="way of the slider  [mm]", ylabel="F  [N]"),
        Line("zero", way[[0, -1]] / mm, [0, 0], role="guide"),
        Line("weight", way / mm, press.weight + 0 * way, role="guide", stroke="dashed", label="G"),
        Line("load", way / mm, press.weight + press.force(way), role="profile", label="G + P"),
    )


CAM_LEVER_VIEWS = (
    mechanism,
    motion_over_turn,
    pressure_angle,
    stress_over_way,
    wear_over_way,
    hertz_pressure,
    slider_load,
)
"""What a designer of a cam with lever wants to see at once."""


def radius_sweep(found: Sequence[Any]) -> Picture:
    """The least objective of several results of `minimise` over the largest radius that each was allowed."""
    refuse_arguments(radius_sweep, locals())
    refuse_empty(found, "results")
    measure = found[0].study.minimise[0]
    radius = np.array([best.study.free["max_radius"][1] for best in found]) / mm
    least = np.array([best.f for best in found]) / factor(measure.unit)
    told = [
        Text(f"at {x:g}", x, y, f" {y:.2f}", anchor="left bottom", size=11) for x, y in zip(radius, least, strict=True)
    ]
    axes = Axes(title="What a larger cam buys", xlabel="largest radius allowed  [mm]", ylabel=two_lines(measure))
    return Picture.of(
        axes, Line("least", radius, least, role="position"), Points("results", radius, least, role="position"), told
    )


def two_lines(measure: Any) -> str:
    """Name and unit of a measure in two lines, for a short axis."""
    return f"{measure.name}\n[{measure.unit}]" if measure.unit else str(measure.name)
