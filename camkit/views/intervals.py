"""Curves with their peaks over the two intervals in which a cam moves: contact stress, wear, Hertz pressure.

The first of the series is the interval in which the arm swings away, the second that in which it swings back.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any, NamedTuple, Protocol

import numpy as np

from ..extrema import Extreme
from ..quantities.types import Array, Value
from ..units import factor, mm
from .picture import Axes, Line, Mark, Picture, Points, Text, gaps

AWAY_BACK = ("away", "back")
ROOM = 1.42
"""Height of the axes over the highest peak: there its value is written."""


class Moving(Protocol):
    """What rolls on a cam while it moves, at some cam angles."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def contact_force(self) -> Array: ...
    @property
    def contact_pressure(self) -> Array: ...
    @property
    def stress_coefficient(self) -> Array: ...
    @property
    def wear_coefficient(self) -> Array: ...
    @property
    def undercut(self) -> Array: ...
    @property
    def way(self) -> Array: ...
    def at(self, cam_angle: Array) -> Moving: ...
    def highest(self, f: Callable[[Moving], Array]) -> Extreme: ...


class TwoIntervals(Moving, Protocol):
    """A cam that moves something away in one interval and back in another."""

    @property
    def machine(self) -> Any: ...
    @property
    def rise(self) -> Moving: ...
    @property
    def intervals(self) -> tuple[Moving, Moving]: ...


class Along(NamedTuple):
    """What a curve is drawn over: its name, the function that gives it, its unit, and how a place on it is signed."""

    name: str
    of: Callable[[Moving], Array]
    unit: str
    sign: str


TURN = Along("cam angle", attrgetter("cam_angle"), "deg", "°")
WAY = Along("way of the slider", attrgetter("way"), "mm", " mm")


class Curve(NamedTuple):
    """What is drawn: title, letter, unit, and the function that gives it, SI."""

    title: str
    letter: str
    unit: str
    of: Callable[[Moving], Array]


def _stress(part: Moving) -> Array:
    return part.stress_coefficient / mm**0.5


def _wear(part: Moving) -> Array:
    return part.wear_coefficient / mm**0.5


STRESS = Curve("Stress index", "Fσ", "N^0.5 mm^-0.5", _stress)
WEAR = Curve("Wear", "F_wear", "N^1.5 mm^-0.5", _wear)
HERTZ = Curve("Hertz pressure", "p_0", "MPa", attrgetter("contact_pressure"))


def _with_peaks(analysis: TwoIntervals, curve: Curve, along: Along = TURN) -> Picture:
    """A curve with the peaks of away and back, their values and places.

    Trouble, at 0: there is none, as the roller undercuts the profile or has lost contact, or no spring holds the arm.
    """
    x, y = _values(analysis, curve, along)
    top = np.fmax.reduce(y, axis=-1)
    top = ROOM * np.where(top > 0, top, 1.0)
    marks: list[Mark] = [Line("dwell", x, y, role="guide", stroke="thin")]
    for index, (way, part) in enumerate(zip(AWAY_BACK, analysis.intervals, strict=True)):
        where, peak = _peak(part, curve, along)
        marks.append(Line(way, *_values(part, curve, along), role="series", index=index))
        marks.append(Points(f"{way} peak", where, peak, role="series", index=index))
        marks += _told(way, part, np.min(x) + (0.25 + 0.5 * index) * np.ptp(x), top, (peak[0], where[0]), along)
    marks.append(Line("none", x, gaps(0 * x, ~np.isfinite(y)), role="trouble"))
    x_label, y_label = f"{along.name}  [{along.unit}]", f"{curve.letter}  [{curve.unit}]"
    return Picture.of(Axes(title=curve.title, xlabel=x_label, ylabel=y_label, ylim=(0, top)), marks)


def _told(way: str, part: Moving, x: Value, top: Value, found: tuple[Value, Value], along: Along) -> list[Mark]:
    """The peak and its place in words, or why a stress is missing somewhere in the interval."""
    there = np.isfinite(found[0])
    held = np.isfinite(part.contact_force).all()  # no spring follows an arm that passes its start
    cut = held & part.undercut.any()
    reasons = {
        "arm passes\nits start": ~there & ~held,
        "undercut\n": ~there & cut,
        "loses\ncontact": ~there & held & ~cut,
    }
    words = f"{way} {found[0]:.4g}\nat {found[1]:.1f}{along.sign}"
    return [
        Text(f"{way} value", gaps(x, there), top, words, anchor="top"),
        *(
            Text(f"{way} {why}", gaps(x, where), top, f"{way} {why}", role="trouble", anchor="top")
            for why, where in reasons.items()
        ),
    ]


def _values(part: Moving, curve: Curve, along: Along) -> tuple[Array, Array]:
    """Where, and what there is, in the units of the axes."""
    return along.of(part) / factor(along.unit), curve.of(part) / factor(curve.unit)


def _peak(part: Moving, curve: Curve, along: Along) -> tuple[Array, Array]:
    """Where an interval's peak is and how high, ``(1,)`` in the units of the axes."""
    found = part.highest(curve.of)
    where = along.of(part.at(np.atleast_1d(found.cam_angle)))
    return where / factor(along.unit), np.atleast_1d(found.value) / factor(curve.unit)


def contact_stress(analysis: TwoIntervals) -> Picture:
    """The coefficient ``F_sigma`` over the turn."""
    return _with_peaks(analysis, STRESS)


def wear(analysis: TwoIntervals) -> Picture:
    """The coefficient ``F_wear`` over the turn."""
    return _with_peaks(analysis, WEAR)


def hertz_pressure(analysis: TwoIntervals) -> Picture:
    """The largest pressure between cam and roller over the turn."""
    return _with_peaks(analysis, HERTZ)


def stress_over_way(analysis: TwoIntervals) -> Picture:
    """The coefficient ``F_sigma`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, STRESS._replace(unit="N^0.5 cm^-0.5"), WAY)


def wear_over_way(analysis: TwoIntervals) -> Picture:
    """The coefficient ``F_wear`` over the slider's way, in the paper's unit."""
    return _with_peaks(analysis, WEAR._replace(unit="N^1.5 cm^-0.5"), WAY)


def load_over_way(analysis: TwoIntervals) -> Picture:
    """Weight ``G`` of the slider, and with it the force ``P`` of the work, over the slider's way."""
    press, way = analysis.machine, analysis.rise.way
    title = "Load" if press.force_curve else "Load (stand-in)"
    return Picture.of(
        Axes(title=title, xlabel="way of the slider  [mm]", ylabel="F  [N]"),
        Line("zero", way[[0, -1]] / mm, [0, 0], role="guide"),
        Line("weight", way / mm, press.weight + 0 * way, role="guide", stroke="dashed", label="G"),
        Line("load", way / mm, press.weight + press.force(way), role="profile", label="G + P"),
    )
