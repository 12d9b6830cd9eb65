"""The tables of the high-speed cam paper, printed beside computed, and the problems whose optima it prints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from ..data import as_printed
from ..machines.cam_lever import CamLever, cam_lever_study
from ..machines.high_speed_analysis import HighSpeedAnalysis
from ..machines.high_speed_cam import HighSpeedCam
from ..machines.high_speed_load import ConstantTorque, InertialSpringLoad
from ..machines.high_speed_measures import GEOMETRY, high_speed_study, peak_stress, peak_wear
from ..quantities import Measure
from ..study.study import Study
from ..units import cm, deg, mm
from .published import Comparison, Row, Table

SOURCE = "Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov"
WAYS = ("rise", "return")
LOADS = {"table_1": InertialSpringLoad(), "table_2": ConstantTorque()}
ANGLES = 4001
REMARK = {
    ("wear, geometry", "stress", "return"): "near undercut: half a millimetre more or less makes it 4.8 to 6.8",
    ("wear, geometry", "wear", "return"): "near undercut: half a millimetre more or less makes it 198 to 261",
    ("stress", "lever", ""): "swing, start angle and smallest radius are those of 201.25, not of 200.1",
    ("stress", "centre_distance", ""): "340.4 for 370.4: a digit",
    ("cycle time", "swing", ""): "5.06 for 5.16: a digit",
    ("initial", "wear", "rise"): "printed to two digits",
}
LEVER = {"stress": 201.25 * mm}
"""Where the printed lever fits nothing else in its row: the one that gives 370.4 mm for ``L`` and all the rest."""
STRESS_CAP = 2 / mm**0.5
"""``F_sigma`` of at most 2 N^0.5 mm^-0.5."""


def _cam(table: str, row: str) -> HighSpeedCam:
    l, r, k2 = (float(size) * mm for size in as_printed("high_speed")[table][row]["sizes"])
    return HighSpeedCam(l, r, k2, load=LOADS[table])


def _rows(name: str, printed: Any, analysis: HighSpeedAnalysis, scale: float = 1.0) -> Iterator[Row]:
    """Stress, wear and pressure angle of rise and return; ``scale`` from the analysis's units to the table's."""
    for quantity, unit, of in (
        ("stress", "N^0.5 mm^-0.5", lambda s: scale * s.stress_coefficient),
        ("wear", "N^1.5 mm^-0.5", lambda s: scale * s.wear_coefficient),
        ("angle", "deg", lambda s: abs(s.pressure_angle) / deg),
    ):
        for way, text, stretch in zip(WAYS, printed.get(quantity, ()), analysis.intervals, strict=False):
            shown = unit if scale == 1 else unit.replace("mm", "cm")
            remark = REMARK.get((name, quantity, way), "")
            yield Row(f"{name}: {quantity}, {way}", shown, text, float(of(stretch).max()), remark)


def table(number: int) -> Comparison:
    """Table 1 (inertia and spring) or 2 (constant torque): the designs with printed laws."""
    key = f"table_{number}"
    printed = as_printed("high_speed")[key]
    rows = [
        row for name in printed if name != "what" for row in _rows(name, printed[name], _cam(key, name).analyse(ANGLES))
    ]
    return Comparison(f"Table {number}: {printed['what'].split(';')[0]}", SOURCE, rows)


def _sizes(name: str, printed: Any, press: CamLever) -> Iterator[Row]:
    """What follows from the sizes of a row of table 3."""
    for quantity, unit, value in (
        ("lever", "mm", press.lever / mm),
        ("min_radius", "mm", press.cam.min_radius / mm),
        ("centre_distance", "mm", press.cam.centre_distance / mm),
        ("swing", "deg", press.swing / deg),
        ("start_angle", "deg", press.cam.start_angle / deg),
    ):
        remark = REMARK.get((name, quantity, ""), "")
        yield Row(f"{name}: {quantity.replace('_', ' ')}", unit, printed[quantity], float(value), remark)


def _press(name: str, printed: Any) -> CamLever:
    """The cam and lever of a row of table 3, with the lever of `LEVER` if there is one."""
    l, r, k2 = (float(size) * mm for size in printed["sizes"])
    x = LEVER.get(name, float(printed["lever"]) * mm)
    interval = float(printed["interval"]) * deg
    return CamLever(l, r, k2, lever=x, rise_angle=interval, return_angle=interval)


def table_3() -> Comparison:
    """The cam and lever: the sizes of every row, and stress and wear of the first under the stand-in load."""
    printed = as_printed("high_speed")["table_3"]
    rows: list[Row] = []
    for name in ("initial", "stress", "cycle time"):
        rows += _sizes(name, printed[name], _press(name, printed[name]))
    rows += _rows("initial", printed["initial"], CamLever().analyse(ANGLES), float(np.sqrt(cm / mm)))
    return Comparison("Table 3: cam and lever, stand-in load", SOURCE, rows)


def printed_table_3() -> Table:
    """The sizes of table 3 as they are printed: in which row do they contradict each other?"""
    head = ("row", "arm l [mm]", "roller r [mm]", "axes L [mm]", "start angle ψ₀ [deg]", "smallest radius r_k1 [mm]")
    names = ("centre_distance", "start_angle", "min_radius")
    printed = as_printed("high_speed")["table_3"]
    rows = [(name, *row["sizes"][:2], *map(row.get, names)) for name, row in printed.items() if "sizes" in row]
    return Table(head, rows, "Table 3: three cams, as printed")


class Problem(NamedTuple):
    """A problem of the paper; ``printed`` is the optimum that it prints, in multiples of ``unit`` (SI), or ``None``."""

    name: str
    printed: float | None
    unit: float
    study: Study

    def gain(self, f: float) -> float | None:
        """By how much ``f`` (SI) is less than the printed optimum, as a share of it."""
        return None if self.printed is None else 1 - f / self.unit / self.printed


def problems() -> tuple[Problem, ...]:
    """What the paper optimises of tables 1 and 2; laws are the 3-4-5 polynomial unless said to be free."""
    torque, unit = HighSpeedCam(load=ConstantTorque()), mm**-0.5
    cap: dict[Measure, float] = {peak_stress: STRESS_CAP}
    free_torque = high_speed_study(torque, peak_wear, free_laws=True)
    free_capped = high_speed_study(objective=peak_wear, free_laws=True, at_most=cap)
    return (
        Problem("least wear", 224, unit, high_speed_study(objective=peak_wear)),
        Problem("least stress", 1.71, unit, high_speed_study()),
        Problem("least wear, stress capped", None, unit, high_speed_study(objective=peak_wear, at_most=cap)),
        Problem("least wear, constant torque", 125, unit, high_speed_study(torque, peak_wear)),
        Problem("least stress, laws free", 1.44, unit, high_speed_study(free_laws=True)),
        Problem("least wear, stress capped, laws free", 167, unit, free_capped),
        Problem("least wear, constant torque, laws free", 101, unit, free_torque),
        Problem("least wear, laws free", 160, unit, high_speed_study(objective=peak_wear, free_laws=True)),
    )


def trade_off_studies(free_laws: bool = False) -> tuple[Study, Study]:
    """Contact stress against wear, for a method that follows slopes and for one without (see `high_speed_study`)."""
    smooth, plain = (high_speed_study(free_laws=free_laws, free_spring=spring) for spring in (True, False))
    both = (peak_stress, peak_wear)
    return smooth.replace(minimise=both), plain.replace(minimise=both)


def lever_problems() -> tuple[Problem, ...]:
    """The paper's sweep of the cam and lever: the least stress with ``r_k2`` of at most 94 to 140 mm."""
    sweep, unit = as_printed("high_speed")["table_3"]["sweep"], cm**-0.5
    return tuple(
        Problem(f"r_k2 at most {radius} mm", float(stress), unit, cam_lever_study(max_radius=float(radius) * mm))
        for radius, stress in zip(sweep["max_radius"], sweep["stress"], strict=True)
    )


def with_printed_sizes(row: str) -> Study:
    """A row with free laws, its coefficients free and its sizes as printed: how good could the paper's laws be?"""
    printed = as_printed("high_speed")["free_laws"][row]["sizes"]
    l, r, k2 = (float(size) * mm for size in printed)
    load = LOADS[row.partition(",")[0].replace(" ", "_")]
    study = high_speed_study(HighSpeedCam(load=load), peak_stress if "stress" in row else peak_wear, free_laws=True)
    laws = {name: bounds for name, bounds in study.free.items() if name not in GEOMETRY}
    cap = {peak_stress: STRESS_CAP} if "at most 2" in row else {}
    start = study.start.replace(arm_length=l, roller_radius=r, max_radius=k2)
    return study.replace(start=start, free=laws, at_most={**(study.at_most or {}), **cap})
