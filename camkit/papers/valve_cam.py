"""The valve cam's paper, printed beside computed, and the tables that show what its problem comes to.

The paper prints two numbers that can be checked, the normalisers of its objective.  The others here are its formulas
evaluated anew, apart from this package; each table says which it is.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..data import as_printed
from ..machines.valve_cam import ValveCam
from ..machines.valve_measures import (
    LOWER,
    PAPER_MIN_RADIUS,
    UPPER,
    corner,
    fullness,
    in_paper_units,
    listed_deceleration,
    nose_deceleration,
)
from ..units import deg, mm
from ..views.front import Judged
from .published import Comparison, Row, Table

PAPER = "He, Li 2008"
FORMULAS = "the paper's formulas"
APART = "evaluated apart"
"""By another program than this package."""


def _of_formulas(name: str) -> Any:
    return as_printed("valve")["formulas"][name]


def _normalisers() -> tuple[float, float]:
    """``K1`` and ``K2`` of the paper's cam, SI."""
    return fullness.one(corner(ValveCam(), UPPER)), nose_deceleration.one(corner(ValveCam(), LOWER))


def normalisers() -> Comparison:
    """The two normalisers, in the units of the paper's listing and in SI."""
    printed = as_printed("valve")["paper"]
    cam = in_paper_units(ValveCam())
    listed = fullness.one(corner(cam, UPPER)), listed_deceleration.one(corner(cam, LOWER))
    si = _normalisers()
    unit = "mm (rad/s)^2/deg^2"
    rows = [
        Row("K1, units mixed as in the listing", "", printed["K1"], listed[0]),
        Row("K1, SI", "", printed["K1"], si[0], "v = 1.148 mm instead of 0.066 mm"),
        Row("K2, units mixed as in the listing", unit, printed["K2"], listed[1]),
        Row("K2, SI", "m/s^2", printed["K2"], si[1], "another unit, another v"),
    ]
    return Comparison("Normalisers: largest fullness, largest nose deceleration in the box", PAPER, rows)


def listing() -> Comparison:
    """Lengths that stand for the seating velocity: in SI, and as the listing mixes its units."""
    cam = ValveCam()
    stated, listed = (float(c.seating_slope * c.half_angle) / mm for c in (cam, in_paper_units(cam)))
    rows = [
        Row("h'(0) = v_g / omega", "mm/rad", _of_formulas("seating_slope"), float(cam.seating_slope) / mm),
        Row("v = v_g alpha_B / omega", "mm", _of_formulas("v"), stated),
        Row("v in m/s and deg, taken for mm", "", _of_formulas("v_listed"), listed, "what the listing computes with"),
    ]
    return Comparison("The seating velocity", FORMULAS, rows, APART)


def seating() -> Table:
    """The cam's data, and the length that its program listing makes of them: where is the error?"""
    printed = as_printed("valve")["paper"]["data"]
    rows = [
        ("seating velocity of the valve, v_g", printed["seating_velocity"], "m/s"),
        ("speed of the cam, omega", printed["speed"], "rpm"),
        ("angle of the flank, alpha_B", printed["half_angle"], "deg"),
        ("lift at the nose", printed["max_lift"], "mm"),
        ("v = v_g alpha_B / omega", _of_formulas("v_listed"), "mm"),
    ]
    return Table(("quantity", "value", "unit"), rows, "The start of the flank, as the listing computes with it")


def corners() -> Comparison:
    """The two corners of the box that the normalisers come from."""
    rows = []
    for n, m in ((20, 20), (3, 1)):
        value, a = _of_formulas(f"corner_{n}_{m}"), ValveCam(n=n, m=m).analyse()
        names = [f"C_{e:g}" for e in a.exponents]
        rows += [
            Row(f"({n}, {m}): {name}", "mm", C, float(computed / mm))
            for name, C, computed in zip(names, value["coefficients"], a.coefficients, strict=True)
        ]
        rows += [
            Row(f"({n}, {m}): fullness", "", value["fullness"], float(a.fullness)),
            Row(f"({n}, {m}): nose acceleration", "m/s^2", value["nose_acceleration"], float(a.nose_acceleration)),
            Row(f"({n}, {m}): radius at the nose", "mm", value["nose_radius"], float(a.nose_radius / mm)),
        ]
    return Comparison("The corners (20, 20) and (3, 1)", FORMULAS, rows, APART)


def lifts() -> Comparison:
    """Two lifts of the cam (5, 4)."""
    printed = _of_formulas("lift_5_4")
    lift = ValveCam(n=5, m=4).motion(np.array(list(printed), dtype=float) * deg).s / mm
    rows = [Row(f"h({at} deg)", "mm", value, float(h)) for (at, value), h in zip(printed.items(), lift, strict=True)]
    return Comparison("Lift of the cam (5, 4)", FORMULAS, rows, APART)


def sharpest() -> Comparison:
    """Where the cam of the corner (20, 20) is sharpest, which is not at its nose."""
    value, a = _of_formulas("corner_20_20"), ValveCam(n=20, m=20).analyse()
    least, where = a.profile_margin
    needed = float(a.base_radius_for(PAPER_MIN_RADIUS) / mm)
    rows = [
        Row("radius at the nose", "mm", value["nose_radius"], float(a.nose_radius / mm), "at least 4.5: kept"),
        Row(
            "least radius anywhere",
            "mm",
            value["min_radius"],
            float(least / mm),
            "at least 4.5: missed",
        ),
        Row("where", "deg", value["min_radius_angle"], float(where / deg)),
        Row("base radius that would keep 4.5 mm", "mm", value["base_radius_needed"], needed),
    ]
    return Comparison("Radius of curvature under a flat face at (20, 20)", FORMULAS, rows, APART)


def sign_as_printed(found: ValveCam) -> Comparison:
    """The optimum for little weight on the fullness with the sign as printed, and the weight at which it jumps.

    The objective is linear in ``W1``, so both candidates are equal where ``W1 gain = (1 - W1) loss``.
    """
    value, a, far = _of_formulas("sign_as_printed"), found.analyse(), corner(ValveCam(), UPPER)
    K1, K2 = _normalisers()
    gain = (far.fullness - a.fullness) / K1
    loss = (far.nose_acceleration - a.nose_acceleration) / K2
    rows = [
        Row("n, with m = 20", "", value["n"], found.n),
        Row("fullness", "", value["fullness"], float(a.fullness)),
        Row("nose acceleration", "m/s^2", value["nose_acceleration"], float(a.nose_acceleration)),
        Row("W1 at which the optimum jumps to (20, 20)", "", value["switch"], float(loss / (gain + loss))),
    ]
    return Comparison("Optimum with the sign as printed, W1 = 0.5", FORMULAS, rows, APART)


def front_points(front: Judged) -> Comparison:
    """Points of the front of fullness against peak positive acceleration beside a front that was found."""
    value = _of_formulas("front")
    order = np.argsort(front.f[:, 1])
    peak, xi = front.f[order, 1], -front.f[order, 0]
    rows = [
        Row(f"most fullness at {a} m/s^2", "", full, float(np.interp(float(a), peak, xi)))
        for a, full in zip(value["acceleration"], value["fullness"], strict=True)
    ]
    return Comparison("The front of fullness against peak positive acceleration", FORMULAS, rows, APART)


def known_front() -> np.ndarray:
    """Points of the front of fullness against peak positive acceleration, evaluated apart, ``(2, 5)``, m/s^2."""
    points = _of_formulas("front")
    return np.array([points["fullness"], points["acceleration"]], float)
