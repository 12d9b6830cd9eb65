"""The door-handle paper's tables, printed beside computed.

The paper's masses and speed are not printed.  ``m omega^2 = 2 pi/180`` (lift) and ``0.5 pi/180`` (relief), with lengths
in mm, give its torques to the fourth digit, so they are taken here; forces and torques then have no unit that means
anything, and only their ratios before and after carry meaning.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from ..cam.loads import ArmLoad
from ..cam.measures import (
    max_pressure_angle,
    min_concave_radius,
    min_convex_radius,
    peak_force,
    peak_torque,
    published_mean_efficiency,
)
from ..data import as_printed
from ..machines.door_handle import DoorHandleAnalysis, DoorHandleCam
from ..quantities import Measure
from ..units import deg, mm, percent
from .published import Comparison, Row, Table

SOURCE = "Gong, Liu, He 2025"
PAPER_TORQUE = mm**2
"""The paper's torques are in kg mm^2/s^2."""
WHEN = ("before", "after")


def _printed(*keys: str) -> Any:
    entry = as_printed("door_handle")
    for key in keys:
        entry = entry[key]
    return entry


def before() -> DoorHandleCam:
    """The paper's design before the optimisation, at the speed that its torques imply."""
    return DoorHandleCam(lift_load=ArmLoad(speed=float(np.sqrt(deg))))


def after() -> DoorHandleCam:
    """The design that the paper chose from its front."""
    printed = _printed("table_3", "after")
    return before().replace(
        lift_arm=float(printed["lift_arm"]) * mm,
        lift_start_angle=float(printed["lift_start_angle_rad"]),
        relief_arm=float(printed["relief_arm"]) * mm,
    )


@cache
def _analyses() -> tuple[DoorHandleAnalysis, DoorHandleAnalysis]:
    return before().analyse(7201), after().analyse(7201)


def _computed(curve: str, measure: Measure, unit: float = 1.0) -> dict[str, float]:
    """A measure of one curve before and after."""
    return {when: float(measure(getattr(a, curve))) / unit for when, a in zip(WHEN, _analyses(), strict=True)}


def table_1() -> Comparison:
    """The base radii that follow from the printed dimensions."""
    lift, relief = _printed("table_1", "lift"), _printed("table_1", "relief")
    cam = before()
    rounded = cam.replace(lift_start_angle=float(lift["start_angle_rad"]))
    relief_radius = float(cam.analyse().relief.pitch_radius.max()) / mm
    a, l = cam.relief_centre_distance, cam.relief_arm
    whole_degree = float(np.sqrt(a**2 + l**2 - 2 * a * l * np.cos(25 * deg))) / mm
    why = "0.38 rad is 21.77 deg: 22 deg, rounded"
    start = f"psi_0' = {float(cam.relief.start_angle) / deg:.2f} deg from r_0 = 33.59 mm"
    rows = [
        Row("lift base radius from psi_0 = 22 deg", "mm", lift["base_radius"], float(cam.base_radius) / mm),
        Row("lift base radius from psi_0 = 0.38 rad", "mm", lift["base_radius"], float(rounded.base_radius) / mm, why),
        Row("relief base radius from the dimensions", "mm", relief["base_radius"], relief_radius, start),
        Row("relief base radius from psi_0' = 25 deg", "mm", relief["base_radius"], whole_degree, "24.88 deg, rounded"),
    ]
    return Comparison("Table 1: base radii", SOURCE, rows)


def table_3() -> Comparison:
    """What the paper's chosen design is worth by the paper's own limits."""
    printed = _printed("table_4")
    alpha = _computed("lift", max_pressure_angle)["after"]
    radius = {curve: _computed(curve, min_convex_radius, mm)["after"] for curve in ("lift", "relief")}
    kept = f"{alpha / deg:.2f} deg of at most 45: {'kept' if alpha <= 45 * deg else 'missed'}"
    remark = {"lift": "at least 7: kept, on the base circle", "relief": "at least 7: missed, less than the roller"}
    rows = [Row("lift: maximum angle", "rad", printed["lift"]["max_pressure_angle_rad"]["after"], alpha, kept)]
    rows += [
        Row(
            f"{curve}: minimum convex radius", "mm", printed[curve]["min_radius"]["after"], radius[curve], remark[curve]
        )
        for curve in ("lift", "relief")
    ]
    return Comparison("Table 3: the chosen design l1 = 48.09 mm, psi_0 = 0.34 rad, l2 = 74.49 mm", SOURCE, rows)


def table_4(curve: str) -> Comparison:
    """Largest pressure angle, torque, force and least radius of ``"lift"`` or ``"relief"``, before and after."""
    printed = _printed("table_4", curve)
    alpha = _computed(curve, max_pressure_angle)
    angles = printed["max_pressure_angle_rad"]
    rows = [
        Row(f"maximum pressure angle, {when}", "rad", angles[when], alpha[when], _REMARK[curve, when]) for when in WHEN
    ]
    if curve == "relief":
        kept = before().replace(relief_arm=after().relief_arm).analyse(7201)
        why = "at the base radius 33.59 mm of the start: only l_2 changed"
        rows.append(
            Row("the same, base radius kept", "rad", angles["after"], float(max_pressure_angle(kept.relief)), why)
        )
    return Comparison(f"Table 4: {curve} curve", SOURCE, [*rows, *_ratios(curve, printed), *_radii(curve, printed)])


_REMARK = {
    ("lift", "before"): "0.7584 from 0.38 rad, 0.7599 from 22 deg: the print lies between",
    ("lift", "after"): "0.7180 from 0.3435 rad: psi_0 is printed to two digits",
    ("relief", "before"): "",
    ("relief", "after"): "at the base radius 33.05 mm of the printed lift design",
}


def _ratios(curve: str, printed: Any) -> list[Row]:
    """Torque, where printed, and the ratios after to before of torque and force."""
    torque, force = _computed(curve, peak_torque, PAPER_TORQUE), _computed(curve, peak_force)
    values = [
        Row(f"torque M, {when}", "kg mm^2/s^2", printed["peak_torque"][when], torque[when], "m omega^2 fitted")
        for when in WHEN
        if printed["peak_torque"][when]
    ]
    why = "depends on how psi_0 was rounded"
    return [
        *values,
        Row("torque M, after / before", "", printed["peak_torque"]["ratio"], torque["after"] / torque["before"]),
        Row("force F, after / before", "", printed["peak_force"]["ratio"], force["after"] / force["before"], why),
    ]


def _radii(curve: str, printed: Any) -> list[Row]:
    """The printed least radius against the least convex and the least concave radius of the pitch curve."""
    kinds = {"convex": min_convex_radius, "concave": min_concave_radius}
    why = "from no sign variant of (14), nor from the geometry"
    return [
        Row(f"minimum radius, {when}, as {kind}", "mm", printed["min_radius"][when], computed[when], why)
        for kind, computed in ((kind, _computed(curve, measure, mm)) for kind, measure in kinds.items())
        for when in WHEN
    ]


def efficiencies() -> Comparison:
    """Mean efficiencies: the print does not follow from the paper's formula (21), however it is read."""
    rows = [
        Row(f"{curve}, {when}", "%", _printed("efficiency", curve, when), computed[when])
        for curve, computed in ((c, _computed(c, published_mean_efficiency, percent)) for c in ("lift", "relief"))
        for when in WHEN
    ]
    return Comparison("Mean efficiency", SOURCE, rows)


def text_torques() -> Comparison:
    """The torques in the paper's text are half of those in its table."""
    torque = _computed("lift", peak_torque, PAPER_TORQUE)
    rows = [
        Row(f"half the torque, {when}", "kg mm^2/s^2", _printed("text", "peak_torque", when), torque[when] / 2)
        for when in WHEN
    ]
    return Comparison("Torques in the text", SOURCE, rows)


def printed_torques() -> Table:
    """The lift curve's torques as they are printed, twice: what cannot be right?"""
    where = {"table 4": _printed("table_4", "lift", "peak_torque"), "text": _printed("text", "peak_torque")}
    rows = [(place, *(torque[when] for when in WHEN)) for place, torque in where.items()]
    return Table(("peak torque M [kg mm²/s²]", *WHEN), rows, "Torques of the lift curve, as printed")
