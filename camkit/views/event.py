"""Views of a cam that opens something once a turn: the whole cam with its follower, and curves over that event."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np

from ..extrema import Extreme
from ..geometry import Body, rotated
from ..motion import Kinematics
from ..quantities import Measure
from ..quantities.types import Array, Value
from ..units import MPa, deg, mm
from .cam import ANGLE, bodies
from .picture import Axes, Band, Circle, Line, Mark, Picture, Points, Polygon, gaps

SHOWN_RADIUS = (-10, 45)
"""Radii of curvature (mm) that the view shows: where the flank begins they are far larger, and of no concern."""


class Event(Protocol):
    """A cam that opens something once a turn, at some of its cam angles."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def turn(self) -> Array: ...
    @property
    def lift(self) -> Array: ...
    @property
    def in_time(self) -> Kinematics: ...
    @property
    def profile(self) -> Array: ...
    @property
    def profile_radius(self) -> Array: ...
    @property
    def curvature(self) -> Array: ...
    @property
    def undercut(self) -> Array: ...
    @property
    def is_open(self) -> Array: ...
    @property
    def spring_force(self) -> Array: ...
    @property
    def contact_stress(self) -> Array: ...
    @property
    def cam_torque(self) -> Array: ...
    @property
    def bodies(self) -> tuple[Body, ...]: ...
    @property
    def flat(self) -> Event: ...
    @property
    def roller(self) -> Event: ...
    def contact_point(self) -> Array: ...
    def needed_at(self, speed: Value) -> Array: ...


class Opening(Protocol):
    """All of it: the turn, the event, and the design with its nose at ``half_angle``, ramps, follower and load."""

    @property
    def cam(self) -> Any: ...
    @property
    def whole(self) -> Event: ...
    @property
    def event(self) -> Event: ...
    @property
    def profile_margin(self) -> Extreme: ...
    @property
    def top_speed(self) -> Value: ...


def cam_and_follower(analysis: Opening, turn: float = 0.0) -> Picture:
    """The whole cam at the cam angle ``turn`` with its follower; trouble: stretches that the follower undercuts."""
    whole, cam = analysis.whole, analysis.cam
    i = np.argmin(abs(_around(whole.cam_angle - turn)))
    x, y = profile = rotated(whole.profile, np.take(whole.turn, i)) / mm
    from_nose = abs(whole.cam_angle - cam.half_angle)
    ramps, flanks = from_nose <= cam.half_angle + cam.ramp_angle, from_nose <= cam.half_angle
    contact = np.take(whole.contact_point(), i, axis=-1) / mm
    return Picture.of(
        Axes(title=f"Cam and {cam.follower.name}", xlabel="x  [mm]", ylabel="y  [mm]", equal=True),
        Circle("tip circle", 0.0, 0.0, np.max(np.hypot(*profile)), role="guide"),
        Polygon("cam", x, y, role="body"),
        Line("base circle", x, y, role="guide", stroke="bold", label="base circle"),
        Line("ramps", gaps(x, ramps), gaps(y, ramps), role="allowed", stroke="bold", label="ramps"),
        Line("flanks", gaps(x, flanks), gaps(y, flanks), role="profile", stroke="bold", label="flanks"),
        Line("undercut", gaps(x, whole.undercut), gaps(y, whole.undercut), role="trouble", label="undercut"),
        Points("axis", 0.0, 0.0, mark="plus", size=14),
        bodies(whole.bodies, i, index=1),
        Points("contact", contact[:1], contact[1:], size=9, fill="paper"),
    )


def _around(angle: Array) -> Array:
    """The same angle within half a turn of 0."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _over_event(
    half_angle: float, title: str, ylabel: str, *marks: Mark, ylim: tuple[float, float] | None = None
) -> Picture:
    """``marks`` over the cam angle, with thin lines at the nose and at both ends of the flanks."""
    ends = np.array([0, 1, 2]) * half_angle / deg
    lines = [
        Band(name, x, x, role="guide", along="y", opacity=0.0)
        for name, x in zip(("start", "nose", "end"), ends, strict=True)
    ]
    return Picture.of(Axes(title=title, xlabel=ANGLE, ylabel=ylabel, ylim=ylim), lines, marks)


def lift(analysis: Opening, turn: float = 0.0) -> Picture:
    """Lift from the start of the flank, negative on the ramps; the dot is at the cam angle ``turn``."""
    event = analysis.event
    x, y = event.cam_angle / deg, event.lift / mm
    off = abs(_around(event.cam_angle - turn))
    i = np.argmin(off)
    near = np.where(off[i] < 1 * deg, 0.0, np.nan)  # else on the base circle, which is not drawn
    curve, dot = Line("lift", x, y, role="position"), Points("here", x[i] + near, y[i] + near, role="follower")
    return _over_event(analysis.cam.half_angle, "Lift", "h  [mm]", curve, dot)


def velocity(analysis: Opening) -> Picture:
    """Velocity of the follower at the camshaft's speed."""
    event = analysis.event
    curve = Line("velocity", event.cam_angle / deg, event.in_time.v, role="velocity")
    return _over_event(analysis.cam.half_angle, "Velocity", "v  [m/s]", curve)


def acceleration(analysis: Opening) -> Picture:
    """Acceleration of the follower at the camshaft's speed."""
    event = analysis.event
    curve = Line("acceleration", event.cam_angle / deg, event.in_time.a, role="acceleration", shaped=True)
    return _over_event(analysis.cam.half_angle, "Acceleration", "a  [m/s^2]", curve)


def jerk(analysis: Opening) -> Picture:
    """Jerk of the follower at the camshaft's speed."""
    event = analysis.event
    j = event.in_time.j / 1e6
    curve = Line("jerk", event.cam_angle / deg, gaps(j, np.isfinite(j)), role="jerk", stroke="solid")
    return _over_event(analysis.cam.half_angle, "Jerk", "j  [10^6 m/s^3]", curve)


def radius_of_curvature(analysis: Opening, limits: Mapping[Measure, float] | None = None) -> Picture:
    """Radius of the cam under a flat face and under the roller, the ``limits`` of its measures, the least of them.

    Below 0 a flat face undercuts the cam; where the roller's curve has a gap the cam under it is concave.
    """
    event = analysis.event
    x = event.cam_angle / deg
    allowed = sorted({value / mm for measure, value in (limits or {}).items() if "radius" in measure.name})
    least, at = analysis.profile_margin.value / mm, analysis.profile_margin.cam_angle / deg
    kept = np.all([least >= limit for limit in allowed], axis=0)
    radius = gaps(event.roller.profile_radius / mm, event.roller.curvature > 0)
    return _over_event(
        analysis.cam.half_angle,
        "Radius",
        "ρ  [mm]",
        Line("flat", x, event.flat.profile_radius / mm, role="position", label="flat face"),
        Line("roller", x, radius, role="velocity", stroke="thin dashed", label="roller"),
        *(Line(f"limit {i}", x[[0, -1]], [limit] * 2, role="limit") for i, limit in enumerate(allowed)),
        Points("least", at, gaps(least, kept), role="position"),
        Points("least, missing", at, gaps(least, ~kept), role="trouble"),
        ylim=SHOWN_RADIUS,
    )


def spring_and_inertia(analysis: Opening) -> Picture:
    """The spring against what inertia asks of it, at the speed and (dashed) with the margin; trouble: a jump."""
    event = analysis.event
    x, spring = event.cam_angle / deg, event.spring_force
    marks: list[Mark] = [Line("spring", x, gaps(spring, event.is_open), role="velocity", label="spring")]
    speeds = {"inertia": (analysis.cam.load.speed, "solid"), "overspeed": (analysis.top_speed, "dashed")}
    for key, (speed, stroke) in speeds.items():
        needed = event.needed_at(speed)
        pulled = gaps(needed, event.is_open & (needed > 0))
        label = "inertia" if key == "inertia" else ""
        marks.append(Line(key, x, pulled, role="acceleration", stroke=stroke, label=label))
        marks.append(Line(f"{key} jump", x, gaps(pulled, needed > spring), role="trouble", stroke=stroke))
    return _over_event(analysis.cam.half_angle, "Force", "F  [N]", *marks)


def stress_over_event(analysis: Opening) -> Picture:
    """Largest pressure between cam and follower while it is open; trouble: undercut, where they do not fit."""
    event = analysis.event
    x = event.cam_angle / deg
    return _over_event(
        analysis.cam.half_angle,
        "Contact stress",
        "p₀  [MPa]",
        Line("stress", x, gaps(event.contact_stress / MPa, event.is_open), role="position"),
        Line("undercut", x, gaps(0 * x, event.undercut), role="trouble"),
    )


def camshaft_torque(analysis: Opening) -> Picture:
    """Torque on the camshaft over a whole turn, without friction: what the spring takes it gives back."""
    whole = analysis.whole
    curve = Line("torque", whole.cam_angle / deg, whole.cam_torque, role="position")
    return _over_event(analysis.cam.half_angle, "Camshaft torque", "M  [N m]", curve)
