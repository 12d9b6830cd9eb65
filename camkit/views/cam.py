"""Views of cams: the mechanism to scale, and the curves over the cam angle.

They show whatever analysis offers ``bodies`` (see `camkit.geometry.Body`) and ``curves`` by name.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Protocol, SupportsIndex

import numpy as np

from ..geometry import Body, Disc, Outline
from ..motion import Kinematics
from ..quantities import Measure
from ..quantities.types import Array, Value
from ..units import MPa, deg, mm
from .picture import Axes, Band, Circle, Colour, LabelStyle, Line, LineStyle, Mark, Picture, Points, Polygon, gaps

ANGLE = "cam angle  [deg]"
PARTS = {"body": "", "pitch": "pitch curve", "profile": "profile", "flank": "groove's outer flank"}
"""The cam's parts and their names in the legend."""

MOTION = ("position", "velocity", "acceleration", "jerk")


class CamCurve(Protocol):
    """A cam curve with its follower over the turn."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def motion(self) -> Kinematics: ...
    @property
    def velocity(self) -> Array: ...
    @property
    def profile_curvature(self) -> Array: ...
    @property
    def efficiency(self) -> Array: ...
    @property
    def contact_force(self) -> Array: ...
    @property
    def contact_pressure(self) -> Array: ...


class Cam(Protocol):
    """The analysis of a cam: its bodies, and its curves by name."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def bodies(self) -> tuple[Body, ...]: ...
    @property
    def curves(self) -> Mapping[str, CamCurve]: ...
    @property
    def max_curvature(self) -> Value: ...
    @property
    def curvature_limit(self) -> str: ...


def position(cam_angle: Array, turn: Value) -> np.intp:
    """Which of the cam angles is nearest to ``turn`` (rad)."""
    return np.argmin(abs(cam_angle - turn), axis=-1)


def mechanism(analysis: Cam, turn: float = 0.0) -> Picture:
    """The cam as it is cut and its followers, to scale, with the cam turned by ``turn`` (rad).

    Of a groove the band between its two flanks is filled; trouble: stretches that the follower undercuts.
    """
    axes = Axes(title="Cam and follower", xlabel="x  [mm]", ylabel="y  [mm]", equal=True)
    return Picture.of(axes, bodies(analysis.bodies, position(analysis.cam_angle, turn)))


def bodies(
    shown: tuple[Body, ...], i: SupportsIndex, away: float = 0.0, prefix: str = "", index: int | None = None
) -> list[Mark]:
    """Marks of bodies at position ``i``, shifted by ``away`` mm along x.

    What belongs to one name has one colour, and its name in the legend where there are several; with ``index`` all
    have that of the series.
    """
    names = list(dict.fromkeys(body.name for body in shown if body.name))
    marks: list[Mark] = []
    for body in shown:
        style: LabelStyle = {}
        if index is not None:
            style = {"role": "series", "index": index, "label": ""}
        elif body.name:
            style = {"role": "series", "index": names.index(body.name), "label": body.name if len(names) > 1 else ""}
        marks += _body(body, i, away, f"{prefix} {body.name} {body.part}".strip().replace("  ", " "), style)
    return marks


def _body(body: Body, i: SupportsIndex, away: float, key: str, style: LabelStyle) -> Iterator[Mark]:
    """The marks of one body."""
    x, y = body.at(i) / mm
    x = x + away
    if isinstance(body, Disc):
        yield Circle(key, x, y, body.radius / mm, **style)
    elif body.part in ("pivot", "axis"):
        yield Points(key, x, y, mark="plus" if body.part == "axis" else "dot", size=10, fill="paper", **style)
    elif body.part == "body":
        yield Polygon(key, x, y, role="body")
    elif body.part == "mass":
        yield Polygon(key, x, y, edged=True, **style)
    elif body.part in ("spring", "frame"):
        yield Line(key, x, y, stroke="line" if body.part == "spring" else "bold", **style)
    elif body.part in ("arm", "face", "block"):
        yield Line(key, x, y, stroke="arm", opacity=1.0 if body.part == "face" else 0.85, **style)
    else:
        yield Line(key, x, y, **({"role": body.part, "label": PARTS.get(body.part, "")} | style))
        if isinstance(body, Outline) and body.cut is not None:
            cut = gaps(x, body.cut), gaps(y, body.cut)
            label = "undercut" if body.part == "profile" else ""
            yield Line(f"{key} undercut", *cut, role="trouble", label=label)


def motion(analysis: Cam) -> Picture:
    """Position, velocity, acceleration and jerk of every follower, each over its own peak."""
    marks = []
    for name, curve in analysis.curves.items():
        moves = _moving(curve)
        for key, role, values in zip(
            "svaj", ("position", "velocity", "acceleration", "jerk"), curve.motion, strict=True
        ):
            peak = np.max(abs(values), axis=-1)
            share = values / np.where(peak > 0, peak, 1.0)
            marks.append(Line(f"{name} {key}", curve.cam_angle / deg, gaps(share, moves), role=role, label=key))
    return Picture.of(Axes(title="Motion", xlabel=ANGLE, ylabel="normalised"), marks)


def _moving(curve: CamCurve) -> Array:
    """Where the follower moves, and one sample on either side."""
    v = curve.velocity != 0
    still = np.zeros_like(v[:1])
    return v | np.concatenate([v[1:], still]) | np.concatenate([still, v[:-1]])


def _each(analysis: Cam, name: str, unit: float, named: bool = True) -> list[Mark]:
    """A curve of every follower, ``named`` in the legend where there are several."""
    several = named and len(analysis.curves) > 1
    return [
        Line(key, curve.cam_angle / deg, getattr(curve, name) / unit, role="series", index=i, label=several * key)
        for i, (key, curve) in enumerate(analysis.curves.items())
    ]


def pressure_angle(analysis: Cam, limits: Mapping[Measure, float] | None = None) -> Picture:
    """The signed pressure angle, and the band that the ``limits`` of its measures leave; without any, no band."""
    allowed = {value / deg for measure, value in (limits or {}).items() if "pressure angle" in measure.name}
    bands = [
        Band(f"allowed {i}", -limit, limit, role="allowed", opacity=0.1) for i, limit in enumerate(sorted(allowed))
    ]
    axes = Axes(title="Pressure angle", xlabel=ANGLE, ylabel="α  [deg]")
    return Picture.of(axes, bands, _each(analysis, "pressure_angle", deg))


def contact_force(analysis: Cam) -> Picture:
    """Force between cam and follower, without friction."""
    axes = Axes(title="Contact force", xlabel=ANGLE, ylabel="F  [N]")
    return Picture.of(axes, _each(analysis, "contact_force", 1.0))


def cam_torque(analysis: Cam) -> Picture:
    """Torque on the cam, without friction."""
    axes = Axes(title="Cam torque", xlabel=ANGLE, ylabel="M  [N mm]")
    return Picture.of(axes, _each(analysis, "cam_torque", mm))


def curvature(analysis: Cam) -> Picture:
    """Curvature of the pitch curve (full) and of the profile (thin), with the limits that the follower sets.

    Outside the band of plus and minus one over the roller's radius a flank is undercut.
    """
    limit = analysis.max_curvature * mm
    x = analysis.cam_angle[[0, -1]] / deg
    bounds = [
        Line(f"limit {sign}", x, sign * limit + 0 * x, role="limit", label=analysis.curvature_limit if sign > 0 else "")
        for sign in (-1, 1)
    ]
    marks = _each(analysis, "curvature", 1 / mm, named=False)
    for i, (name, curve) in enumerate(analysis.curves.items()):
        inner = curve.profile_curvature * mm
        shown = gaps(inner, abs(inner) < 2 * limit)
        style: LineStyle = {"role": "series", "index": i, "stroke": "thin dashed"}
        marks.append(Line(f"{name} profile", curve.cam_angle / deg, shown, **style))
    return Picture.of(Axes(title="Curvature", xlabel=ANGLE, ylabel="κ  [1/mm]"), bounds, marks)


def efficiency(analysis: Cam) -> Picture:
    """Power out over power in: from the free-body diagram (full) and, of a rocking roller, as published (thin)."""
    marks, several = [], len(analysis.curves) > 1
    for i, (name, curve) in enumerate(analysis.curves.items()):
        style: Colour = {"role": "series", "index": i}
        x, moves = curve.cam_angle / deg, _moving(curve)
        marks.append(Line(name, x, gaps(100 * curve.efficiency, moves), label=several * name, **style))
        if hasattr(curve, "published_efficiency"):
            published = gaps(100 * curve.published_efficiency, moves)
            marks.append(Line(f"{name} published", x, published, stroke="thin dashed", **style))
    return Picture.of(Axes(title="Efficiency", xlabel=ANGLE, ylabel="η  [%]", ylim=(0, 100)), marks)


def contact_pressure(analysis: Cam) -> Picture:
    """Largest Hertz pressure between cam and follower; trouble: undercut, or the follower would have to be pulled.

    Of a pair of cams none where the other one pushes.
    """
    marks, several = [], len(analysis.curves) > 1
    for i, (name, curve) in enumerate(analysis.curves.items()):
        x, y = curve.cam_angle / deg, curve.contact_pressure / MPa
        there, other = np.isfinite(y), several & (curve.contact_force < 0)
        marks.append(Line(name, x, gaps(y, there), label=several * name, role="series", index=i))
        marks.append(Line(f"{name} none", x, gaps(0 * x, ~(there | other)), role="trouble"))
    return Picture.of(Axes(title="Contact pressure", xlabel=ANGLE, ylabel="p₀  [MPa]"), marks)
