"""Rows for a controller: where they stand, what they hold, and how near its curve between them comes."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import BPoly

from camkit.motion import (
    Boundary,
    ConstantVelocity,
    Cycloidal,
    Dwell,
    MatchedProgram,
    ModifiedSine,
    MotionProgram,
    Parabolic,
    Poly345,
    Poly4567,
    PowerPolynomial,
    Return,
    Rise,
    SimpleHarmonic,
    SplineLaw,
    controller_error,
    controller_rows,
    motion_from_table,
)
from camkit.motion.controller import WAYS, hermite
from camkit.units import deg, mm

PRINTED = json.loads((Path(__file__).parents[1] / "data" / "motion_tables.json").read_text())["electronic"]
LAWS = {"3-4-5": Poly345(), "4-5-6-7": Poly4567(), "cycloidal": Cycloidal(), "modified sine": ModifiedSine()}


LEAPS = MatchedProgram((Dwell(1.0), Dwell(1.0)), (Boundary(0.0), Boundary("free"), Boundary(0.02)))


def stroke(law, lift=20 * mm):
    """120 deg up, 60 deg of dwell, 120 deg down, 60 deg of dwell."""
    up, back = Rise(120 * deg, lift, law), Return(120 * deg, lift, law)
    return MotionProgram((up, Dwell(60 * deg), back, Dwell(60 * deg)))


@pytest.mark.parametrize("law", [law for law in LAWS if law != "modified sine"])
@pytest.mark.parametrize("rows", [36, 72, 180, 360])
@pytest.mark.parametrize("way", ["linear", "cubic", "poly5"])
def test_the_error_is_the_printed_one(law, rows, way):
    """Values of the specification, by sampling; less than 1e-10 mm is rounding there as here."""
    found, printed = controller_error(stroke(LAWS[law]), way, 360 / rows * deg) / mm, PRINTED[law][str(rows)][way][0]
    assert found == pytest.approx(printed, rel=1.5e-3) if printed > 1e-10 else found < 1e-10


@pytest.mark.parametrize(
    ("step", "errors"), [(1, (1.09e-3, 6.2e-8, 1.4e-12)), (5, (0.0270, 3.9e-5, 2.2e-8)), (10, (0.105, 6.0e-4, 1.4e-6))]
)
def test_a_cycloid_in_a_controller(step, errors):
    found = [controller_error(stroke(Cycloidal()), way, step * deg) / mm for way in ("linear", "cubic", "poly5")]
    assert found == pytest.approx(errors, rel=0.03)


@pytest.mark.parametrize(("way", "order", "divisor"), [("linear", 2, 8), ("cubic", 4, 384), ("poly5", 6, 46080)])
def test_the_error_is_that_of_the_next_derivative(way, order, divisor):
    """``h^2m |s^(2m)| / divisor``: of the cycloid ``|s^(k)| = h (2 pi)^(k-1) / beta^k`` at its largest."""
    step, beta = 2 * deg, 120 * deg
    largest = 20 * mm * (2 * np.pi) ** (order - 1) / beta**order
    assert controller_error(stroke(Cycloidal()), way, step) == pytest.approx(step**order * largest / divisor, rel=3e-3)


def test_rows_at_kinks_make_a_modified_sine_three_times_better():
    assert PRINTED["modified sine"]["36"]["poly5"][0] == pytest.approx(3.2e-5, rel=0.01)  # without them
    assert controller_error(stroke(ModifiedSine()), "poly5", 10 * deg) / mm == pytest.approx(1e-5, rel=0.02)


@pytest.mark.parametrize(("law", "way"), [(Poly345(), "poly5"), (Poly4567(), "poly7"), (Parabolic(), "cubic")])
def test_what_is_of_the_degree_is_exact_by_its_own_rows(law, way):
    assert controller_error(stroke(law), way, None) < 1e-13 * 20 * mm
    assert controller_error(stroke(law), "linear", None) > 1 * mm


def test_rows_stand_at_joints_and_kinks():
    rows = controller_rows(stroke(ModifiedSine()), "poly5", None)
    assert rows.angle / deg == pytest.approx([0, 15, 105, 120, 180, 195, 285, 300, 360])
    assert rows.values.shape == (3, 9)
    assert rows.values[2, 1] == pytest.approx(4 * np.pi**2 / (np.pi + 4) * 20 * mm / (120 * deg) ** 2)
    every = controller_rows(stroke(ModifiedSine()), "poly5", 5 * deg).angle / deg
    assert every == pytest.approx(np.arange(0, 361, 5))


def test_conditions_inside_a_law_have_rows():
    law = SplineLaw((0.3, 0.6), (0.2, 0.7))
    program = MotionProgram((Rise(100 * deg, 10 * mm, law), Dwell(10 * deg)))
    assert controller_rows(program, "poly5", None).angle / deg == pytest.approx([0, 30, 60, 100, 110])
    assert controller_error(program, "poly5", None) < 1e-15


def test_a_table_has_rows_at_its_knots():
    x = np.arange(0, 360, 10) * deg
    motion = motion_from_table(x, 10 * mm * np.sin(x) + 2 * mm * np.cos(2 * x))
    assert controller_error(motion, "poly5", None) < 1e-13


@pytest.mark.parametrize(
    ("law", "way", "at"),
    [
        (SimpleHarmonic(), "poly5", [0, 120, 120, 180, 180, 300, 300, 360]),
        (SimpleHarmonic(), "cubic", [0, 120, 180, 300, 360]),
        (Parabolic(), "poly5", [0, 60, 60, 120, 120, 180, 180, 240, 240, 300, 300, 360]),
        (Cycloidal(), "poly5", [0, 120, 180, 300, 360]),
        (Cycloidal(), "poly7", [0, 120, 120, 180, 180, 300, 300, 360]),
        (lambda u: (u, 1 + 0 * u, 0 * u, 0 * u), "cubic", [0, 120, 120, 180, 180, 300, 300, 360]),
    ],
)
def test_where_what_a_row_holds_jumps_there_are_two(law, way, at):
    rows = controller_rows(stroke(law), way, None)
    assert rows.angle / deg == pytest.approx(at)


def test_the_two_rows_hold_both_sides():
    rows = controller_rows(stroke(Parabolic()), "poly5", None)
    a = 4 * 20 * mm / (120 * deg) ** 2
    assert rows.values[2] == pytest.approx([a, a, -a, -a, 0, 0, -a, -a, a, a, 0, 0])
    assert rows.values[0] == pytest.approx(np.array([0, 10, 10, 20, 20, 20, 20, 10, 10, 0, 0, 0]) * mm)
    velocity = controller_rows(stroke(ConstantVelocity(0.2)), "poly5", 7 * deg).values[1]
    assert abs(velocity).max() == pytest.approx(stroke(ConstantVelocity(0.2)).peaks().velocity.value)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("law", [Cycloidal(), SimpleHarmonic(), ModifiedSine(), Poly4567()])
def test_the_error_is_that_of_a_curve_made_otherwise(way, law):
    """By scipy's Bernstein polynomials of each piece, at many more angles."""
    program = stroke(law)
    angle, values = controller_rows(program, way, 20 * deg)
    worst = 0.0
    for k in np.flatnonzero(np.diff(angle) > 1e-9):
        curve = BPoly.from_derivatives(angle[k : k + 2], [values[:, k], values[:, k + 1]])
        x = np.linspace(angle[k], angle[k + 1], 301)[1:-1]
        worst = max(worst, abs(curve(x) - program(x).s).max())
    assert controller_error(program, way, 20 * deg) == pytest.approx(worst, rel=2e-3, abs=1e-15)


def test_hermite_has_what_is_given_at_both_ends():
    rng = np.random.default_rng(3)
    for m in range(1, 5):
        first, second, step = rng.normal(size=(m, 6)), rng.normal(size=(m, 6)), rng.uniform(0.2, 2, 6)
        powers = hermite(first, second, step)
        for k in range(6):
            curve = BPoly.from_derivatives([0, step[k]], [first[:, k], second[:, k]])
            shares = np.linspace(0, 1, 9)
            found = np.polynomial.polynomial.polyval(shares, powers[:, k])
            assert found == pytest.approx(curve(shares * step[k]), abs=1e-12)


def test_a_motion_that_goes_on():
    program = MotionProgram((Rise(120 * deg, 60 * deg, Poly345()), Dwell(240 * deg)), advance=60 * deg)
    rows = controller_rows(program, "poly5", None)
    assert rows.values[0] / deg == pytest.approx([0, 60, 60])


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: controller_rows(stroke(Cycloidal()), "poly6"), "the way of the controller is 'poly6'"),
        (lambda: controller_rows(stroke(Cycloidal()), step=0.0), "the step of the table"),
        (lambda: controller_rows(stroke(Cycloidal()), step=1e-5), "the table would have 628319 rows"),
        (lambda: controller_rows(stroke(Cycloidal(), np.array([[0.01], [0.02]]))), "the program is a population"),
        (lambda: controller_rows(LEAPS), "leaps to another level"),
    ],
)  # fmt: skip
def test_refusals(ask, sentence):
    with pytest.raises(ValueError, match=sentence):
        ask()


def test_no_controller_follows_an_infinite_jerk():
    law = PowerPolynomial((2.5, 4, 5))
    with pytest.raises(ValueError, match="a derivative that rows of poly7 hold is infinite somewhere"):
        controller_rows(stroke(law), "poly7")
    assert np.isfinite(controller_rows(stroke(law), "cubic").values).all()
