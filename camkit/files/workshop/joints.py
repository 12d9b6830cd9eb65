"""Where the joints of a linkage or of a shaft are, over the turn of its crank or of its input shaft."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...linkage import DoubleUniversalJointAnalysis, DrivelineAnalysis, RSSRAnalysis, UniversalJointAnalysis
from ...linkage.cross import Cross
from ...machines.shaft_analysis import ShaftAnalysis
from ...quantities.types import Value
from ...units import deg
from .columns import Table, Units

CHAIN = "crank root", "crank joint", "rocker joint", "rocker root"
"""The ends of the links of an RSSR linkage, in order."""
STEP = 1 * deg


def joint_columns(analysis: object, units: Units) -> Table | None:
    """The joints of a mechanism in space, machine's frame, over its analysis; ``None`` for what has none.

    Of an RSSR linkage all four, with crank and rocker angle.  Of a shaft its two joints, and how the tube turns.  Of
    universal joints, whose shafts have no length, the angle of every shaft and the unit vectors of the pins of each.

    >>> from camkit import UniversalJointShaft
    >>> table = joint_columns(UniversalJointShaft().analyse(), Units("mm"))
    >>> table["second joint x [mm]"][:2].round(6).tolist()
    [2410.0, 2410.0]
    """
    if isinstance(analysis, RSSRAnalysis):
        return _linkage(analysis, units)
    if isinstance(analysis, ShaftAnalysis):
        return _shaft(analysis, units)
    if isinstance(analysis, DrivelineAnalysis):
        return _driveline(analysis, units)
    if isinstance(analysis, DoubleUniversalJointAnalysis):
        return _angles(units, [analysis.input_angle, analysis.intermediate_angle, analysis.output_angle])
    if isinstance(analysis, UniversalJointAnalysis):
        return _angles(units, [analysis.input_angle, analysis.output_angle])
    return None


def _linkage(analysis: RSSRAnalysis, units: Units) -> Table:
    columns = dict(units.column("crank angle", "angle", analysis.crank_angle))
    columns |= units.column("rocker angle", "angle", analysis.rocker_angle)
    for name, points in zip(CHAIN, np.moveaxis(analysis.chain, 1, 0), strict=True):
        columns |= units.points(name, points)
    return columns


def _shaft(analysis: ShaftAnalysis, units: Units) -> Table:
    turn = np.arange(0, 361) * STEP
    columns = dict(_angles(units, [turn, Cross(analysis.shaft.joint_angle, turn).output_angle]))
    for name, x in (("first joint", 0.0), ("second joint", analysis.shaft.length)):
        columns |= units.points(name, np.array([[x], [0.0], [0.0]]) + 0.0 * turn)
    return columns


def _angles(units: Units, angles: Sequence[Value]) -> Table:
    names = ["input angle", *(f"angle of shaft {k}" for k in range(2, len(angles))), "output angle"]
    parts = (units.column(name, "angle", angle) for name, angle in zip(names, angles, strict=True))
    return {heading: values for part in parts for heading, values in part.items()}


def _driveline(analysis: DrivelineAnalysis, units: Units) -> Table:
    leads = np.cumsum([cross.lead + 0.0 * analysis.input_angle for cross in analysis.crosses], axis=0)
    columns = dict(_angles(units, [analysis.input_angle, *(analysis.input_angle + lead for lead in leads)]))
    for k, (cross, (along, normal), (behind, _)) in enumerate(
        zip(analysis.crosses, analysis.planes, analysis.planes[1:], strict=False), 1
    ):
        angle = cross.input_angle + 0.0 * analysis.input_angle
        pin = np.outer(np.cross(normal, along), np.cos(angle)) + np.outer(normal, np.sin(angle))
        other = np.cross(behind, pin, axisb=0).T
        other = other / np.sqrt((other**2).sum(0))
        for name, vectors in ((f"joint {k} pin", pin), (f"joint {k} driven pin", other)):
            columns |= {f"{name} {axis}": row for axis, row in zip("xyz", vectors, strict=True)}
    return columns
