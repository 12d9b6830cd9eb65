"""The columns of a cam's tables, in mm or inches, headed by what they hold and its unit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...cam.analysis import CamAnalysis
from ...cam.flank import flanks
from ...cam.roller_analysis import RollerAnalysis
from ...cam.undercut import INNER, ONLY, OUTER
from ...motion.closing import TURN
from ...motion.controller import MOST_ROWS
from ...quantities.kinds import a_number
from ...quantities.types import Array, Value
from ...units import deg, in_unit
from ..motion_tables import derived_unit
from .polar import polar, radii
from .sheets import Column
from .subject import Subject
from .toolpath import ToolPath

STRAIGHT = 1e-6
"""A curve of less curvature (1/m) has no radius."""
ONCE = 1e-8
"""Places on a ray that are nearer (m) to each other are one."""
SAME_ANGLE = 1e-9
"""A row nearer (rad) to the last one than this is that row."""


UNITS = {
    "mm": {"length": "mm", "force": "N", "torque": "N m", "angle": "deg"},
    "in": {"length": "in", "force": "lbf", "torque": "lbf in", "angle": "deg"},
}


@dataclass(frozen=True)
class Units:
    """In which lengths, forces and torques are written: ``"mm"`` with N and N m, ``"in"`` with lbf and lbf in.

    >>> Units("in").column("contact force", "force", np.array([4.4482216152605]))
    {'contact force [lbf]': array([1.])}
    """

    length: str = "mm"

    def of(self, what: str) -> str:
        """The unit of a ``"length"``, a ``"force"``, a ``"torque"``, or an ``"angle"``."""
        return UNITS[self.length][what]

    def column(self, name: str, what: str, values: Value) -> dict[str, Column]:
        """A column of SI ``values`` in that unit, headed by its name and unit."""
        return {f"{name} [{self.of(what)}]": in_unit(np.asarray(values, dtype=float), self.of(what))}

    def points(self, name: str, points: Array) -> dict[str, Column]:
        """Two columns for points in the plane, three in space."""
        parts = (self.column(f"{name} {axis}".strip(), "length", row) for axis, row in zip("xyz", points, strict=False))
        return {heading: values for part in parts for heading, values in part.items()}


Table = Mapping[str, Column]


def stacked(tables: Mapping[str, Table], what: str) -> dict[str, Column]:
    """Tables one below the other, in the first column the name of each, headed by ``what`` it names, if it has one.

    A column that one of them lacks is ``nan`` there.

    >>> stacked({"first": {"x": np.array([1.0])}, "second": {"y": np.array([2.0])}}, "cam")["x"]
    array([ 1., nan])
    """
    sizes = [len(next(iter(table.values()))) for table in tables.values()]
    names = [name for name, size in zip(tables, sizes, strict=True) for _ in range(size)]
    columns: dict[str, Column] = {what: names} if any(names) else {}
    for heading in dict.fromkeys(heading for table in tables.values() for heading in table):
        parts = [table.get(heading, np.full(size, np.nan)) for table, size in zip(tables.values(), sizes, strict=True)]
        words = any(isinstance(part, list) for part in parts)
        columns[heading] = [x for part in parts for x in part] if words else np.concatenate(parts)
    return columns


def rows_between(first: float, last: float, step: float) -> Array:
    """The multiples of a ``step`` from the first angle to the last, and both of these, rad.

    >>> from camkit.units import deg
    >>> (rows_between(0.0, 90 * deg, 40 * deg) / deg).round(6).tolist()
    [0.0, 40.0, 80.0, 90.0]
    """
    step = float(a_number(step, "the step of the table (rad)", "be above 0", lambda value: value > 0))
    if (last - first) / step > MOST_ROWS:
        raise ValueError(f"the table would have {(last - first) / step:.0f} rows; there can be at most {MOST_ROWS}")
    inside = step * np.arange(np.ceil(first / step), np.floor(last / step) + 1)
    return np.array([first, *inside[(inside > first + SAME_ANGLE) & (inside < last - SAME_ANGLE)], last])


def profile_columns(subject: Subject, units: Units) -> Table:
    """Pitch curve and profile, a point for each cam angle of the analysis.

    Where the cam is undercut, the flank is what the tool leaves of it (see `flanks`): ``undercut`` names the flanks
    that are cut away at a row's cam angle, their points stand on the corner that is left, and ``theory`` is what was
    asked for.  Of a drum these are unrolled; its groove in space, both ends of every flank, has columns of its own.
    """
    analysis, place = subject.analysis, subject.on_the_shaft
    made = flanks(analysis)
    columns: dict[str, Column] = {"stretch": analysis.stretch.tolist()}
    columns |= units.column("cam angle", "angle", analysis.profile_angle)
    columns |= _curves(
        units, {"pitch curve": place(analysis.pitch), **{name: place(p) for name, p in made.points.items()}}
    )
    if made.cuts:
        names = (INNER, OUTER) if len(made.cut_away) > 1 else (ONLY,)
        away = dict(zip(names, made.cut_away.values(), strict=True))
        columns["undercut"] = [
            " and ".join(flank for flank, lost in away.items() if lost[k]) for k in range(len(analysis.profile_angle))
        ]
        columns |= _curves(units, {f"theory {flank}": place(points) for flank, points in made.theory.items()})
    return columns | _curves(units, getattr(analysis, "points_in_space", {}))


def _curves(units: Units, curves: Mapping[str, Array]) -> dict[str, Column]:
    """The points of curves, but for a curve that is not there."""
    there = (units.points(name, points) for name, points in curves.items() if np.isfinite(points).any())
    return {heading: values for part in there for heading, values in part.items()}


def polar_columns(subject: Subject, units: Units, step: float) -> Table:
    """The radius of every curve of the drawing at the multiples of ``step`` below a turn (see `polar`)."""
    direction = rows_between(0.0, TURN, step)[:-1]
    columns = dict(units.column("direction", "angle", direction))
    for name, radius in polar(subject, direction).items():
        columns |= units.column(f"{name} radius", "length", radius)
    return columns


def wheel_columns(path: ToolPath, units: Units, step: float) -> Table:
    """Where the centre of a tool stands: its distance from the cam's axis in every direction, and its place.

    A grinder with its wheel on the x axis turns the cam back by the direction (C) and has the wheel at the distance
    (X).  ``ValueError`` for a path that does not go around the axis, or past a direction more than once.
    """
    direction = rows_between(0.0, TURN, step)[:-1]
    inner, distance = radii([stretch for contour in path.contours for stretch in contour.stretches], direction)
    for wrong, said in ((np.isnan(distance), "does not come"), (distance - inner > ONCE, "comes more than once")):
        if wrong.any():
            place = f"{direction[wrong][0] / deg:.4g} deg"
            raise ValueError(f"the tool's centre {said} past {place}; its path has to go around the cam's axis once")
    columns = dict(units.column("direction", "angle", direction))
    columns |= units.column("distance of the centre", "length", distance)
    return columns | units.points("centre", distance * np.stack([np.cos(direction), np.sin(direction)]))


def motion_columns(subject: Subject, units: Units, step: float) -> Table:
    """Motion, pressure angle, radii of curvature, contact force and cam torque at multiples of ``step``.

    Derivatives are by the cam angle; radii of curvature are convex above 0 and empty where the curve is straight;
    force and torque are without friction, of a design's own load and speed.
    """
    curves = subject.analysis.curves
    tables = {name if len(curves) > 1 else "": _motion_of(curve, units, step) for name, curve in curves.items()}
    return stacked(tables, "curve")


def _motion_of(curve: CamAnalysis, units: Units, step: float) -> Table:
    at = curve.at(rows_between(float(curve.cam_angle[0]), float(curve.cam_angle[-1]), step))
    unit = units.of("length" if slides(curve) else "angle")
    columns = dict(units.column("cam angle", "angle", at.cam_angle))
    for k, (name, values) in enumerate(zip("svaj", at.motion, strict=True)):
        columns[f"{name} [{derived_unit(unit, 'rad', k)}]"] = in_unit(values + 0.0 * at.cam_angle, unit)
    columns |= units.column("pressure angle", "angle", at.pressure_angle)
    for name, curvature in _curvatures(at).items():
        columns |= units.column(f"radius of curvature, {name}", "length", _over(curvature))
    columns |= units.column("contact force", "force", at.contact_force + 0.0 * at.cam_angle)
    return columns | units.column("cam torque", "torque", at.cam_torque + 0.0 * at.cam_angle)


def slides(curve: CamAnalysis) -> bool:
    """Whether the follower slides, so that its level is a length; that of an arm is an angle."""
    return curve.acceleration_unit.startswith("mm")


def _curvatures(at: CamAnalysis) -> dict[str, Array]:
    if not isinstance(at, RollerAnalysis):
        return {"profile": at.fit}
    both = {"pitch curve": at.curvature, "profile": at.profile_curvature}
    return both | {"outer profile": at.outer_profile_curvature} if at.groove else both


def _over(curvature: Array) -> Array:
    bent = abs(curvature) > STRAIGHT
    return np.where(bent, 1 / np.where(bent, curvature, 1.0), np.nan)
