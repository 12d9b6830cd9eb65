"""The universal-joint shaft's paper: Table 1 printed beside computed, its slips, and the optimum that it missed."""

from __future__ import annotations

import numpy as np

from ..data import as_printed
from ..machines.shaft import UniversalJointShaft, lightest_shaft, shaft_study
from ..units import mm
from .published import Comparison, Row, Table

SOURCE = "Lyu, Du, Li, Yuan, Luo 2007"
PAPER_PI = 3.14
"""What two of the paper's three areas were taken with."""


def _printed() -> list[dict[str, str]]:
    return list(as_printed("double_universal_joint_shaft")["table_1"])


def printed_designs() -> dict[str, UniversalJointShaft]:
    """The three tubes of Table 1, by the method that found them.

    >>> [round(float(shaft.analyse().area) / mm**2, 2) for shaft in printed_designs().values()]
    [5325.0, 5057.96, 4860.89]
    """
    return {
        row["method"]: UniversalJointShaft(
            outer_diameter=float(row["outer_diameter"]) * mm, inner_diameter=float(row["inner_diameter"]) * mm
        )
        for row in _printed()
    }


def _size(row: dict[str, str]) -> str:
    return f"{row['method']}, {row['outer_diameter']} x {row['inner_diameter']} mm"


def _area(method: str) -> float:
    return float(printed_designs()[method].analyse().area) / mm**2


def printed_table_1() -> Table:
    """Table 1 as it is printed: where is the error?"""
    names = ("method", "outer_diameter", "inner_diameter", "area")
    head = ("method", "outer diameter [mm]", "inner diameter [mm]", "area [mm²]")
    return Table(head, [tuple(row[name] for name in names) for row in _printed()], "Table 1, as printed")


def table_1() -> Comparison:
    """The areas of Table 1."""
    rows = [Row(_size(row), "mm^2", row["area"], _area(row["method"])) for row in _printed()]
    return Comparison("Table 1: area of the tube", SOURCE, rows)


def table_1_with_rounded_pi() -> Comparison:
    """The areas of Table 1 taken with 3.14 in place of pi."""
    rows = [Row(_size(row), "mm^2", row["area"], _area(row["method"]) * PAPER_PI / np.pi) for row in _printed()]
    return Comparison("Table 1 with 3.14 for pi", SOURCE, rows)


def sag_number(n: int = 20_001) -> float:
    """The number under the sag ``5 Q L^3 / (... E I)`` of a beam on two supports under its own weight.

    The bending moment ``q x (L - x) / 2`` is integrated twice by the trapezoidal rule, with ``q = L = E I = 1``.

    >>> round(sag_number(), 4)
    384.0
    """
    x = np.linspace(0, 1, n)
    slope = _integral(x * (1 - x) / 2, x)
    drop = _integral(slope, x)
    return float(5 / (x * drop[-1] - drop)[n // 2])


def _integral(y: np.ndarray, x: np.ndarray) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum((y[1:] + y[:-1]) / 2 * np.diff(x))])


def sag() -> Comparison:
    """The number under the sag, printed 348."""
    why = "digits turned round; the bending line integrated twice gives 384"
    return Comparison(
        "Sag of the tube, 5 Q L^3 / (348 E I)", SOURCE, [Row("number under the sag", "", "348", sag_number(), why)]
    )


def critical_speed_as_printed(shaft: UniversalJointShaft) -> float:
    """The critical speed that follows with the misprint, rad/s: ``sqrt(348 / 384)`` of the right one."""
    return float(shaft.analyse().critical_speed * np.sqrt(348 / 384))


def global_optimum() -> Comparison:
    """The paper's "global optimum" beside the one in closed form."""
    row, best = _printed()[-1], lightest_shaft()
    area = best.analyse().area
    lighter = 1 - area / printed_designs()[row["method"]].analyse().area
    rows = [
        Row("outer diameter", "mm", row["outer_diameter"], best.outer_diameter / mm, "where the twist is just allowed"),
        Row("inner diameter", "mm", row["inner_diameter"], best.inner_diameter / mm, "the paper's own upper bound"),
        Row("area", "mm^2", row["area"], float(area) / mm**2, f"{100 * lighter:.2f} % lighter than the paper's tube"),
    ]
    return Comparison("The optimum", SOURCE, rows)


def best_whole_millimetres() -> UniversalJointShaft:
    """The lightest tube of whole millimetres within the paper's bounds, by trying all 561.

    >>> tube = best_whole_millimetres()
    >>> print(f"{tube.outer_diameter / mm:.0f} x {tube.inner_diameter / mm:.0f} mm")
    129 x 102 mm
    """
    study = shaft_study()
    D, d = (np.arange(round(low / mm), round(high / mm) + 1) for low, high in study.free.values())
    x = np.stack(np.meshgrid(D, d), axis=-1).reshape(-1, 2) * mm
    evaluation = study.evaluate(x)
    best: UniversalJointShaft = study.design(x[np.argmin(np.where(evaluation.feasible, evaluation.f[:, 0], np.inf))])
    return best
