"""Motion laws against printed tables."""

import json
from pathlib import Path

import numpy as np
import pytest

from camkit.motion import (
    LAWS,
    Cycloidal,
    Degree9,
    DoubleHarmonic,
    Dwell,
    EighthOrder,
    FreePolynomial,
    Freudenstein,
    Gutman,
    Mirrored,
    ModifiedConstantVelocity,
    ModifiedTrapezoid,
    MotionProgram,
    Poly345,
    PowerPolynomial,
    Return,
    Rise,
    SimpleHarmonic,
    SumOfSines,
)
from camkit.units import deg, mm, rpm

# Norton, Cam Design and Manufacturing Handbook, and VDI 2143 part 1: Cv, Ca, Cj and the continuity at dwells.
CHARACTERISTICS = {
    "simple harmonic": ("1.570796", "4.934802", "inf", 1),
    "parabolic": ("2", "4", "inf", 1),
    "cycloidal": ("2", "6.283185", "39.478418", 2),
    "modified trapezoid": ("2", "4.888124", "61.42597", 2),
    "modified sine": ("1.759603", "5.527957", "69.46636", 2),
    "3-4-5 polynomial": ("1.875", "5.773503", "60", 2),
    "4-5-6-7 polynomial": ("2.1875", "7.513188", "52.5", 3),
    "5-6-7-8-9 polynomial": ("2.460938", "9.371976", "78.75", 4),
}

# A published cycloidal table, lift 20 over 60 deg (scribd 402730349): angle deg, s, v per deg, a per deg^2.
CYCLOIDAL = [
    (5, 0.075117, 0.044658, 0.017453),
    (10, 0.576689, 0.166667, 0.030230),
    (15, 1.816901, 0.333333, 0.034907),
    (20, 3.910022, 0.500000, 0.030230),
    (25, 6.741784, 0.622008, 0.017453),
    (30, 10, 0.666667, 0),
]

# The motion table of a CAD system's cam generator (Autodesk Inventor help, user motion): a cubic's u, s.
CUBIC = [(0.1, 0.028), (0.2, 0.104), (0.3, 0.216), (0.4, 0.352), (0.5, 0.5)]


def test_every_law_of_the_menu_has_its_row():
    assert [law.name for law in LAWS] == list(CHARACTERISTICS)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_characteristics(law):
    *printed, continuity = CHARACTERISTICS[law.name]
    for peak, text in zip(law.peaks(), printed, strict=True):
        digits = len(text.partition(".")[2])
        assert peak == pytest.approx(float(text), abs=0.5001 * 10**-digits)
    assert law.continuity == continuity


@pytest.mark.parametrize(("angle", "s", "v", "a"), CYCLOIDAL)
def test_cycloidal_table(angle, s, v, a):
    found = MotionProgram((Rise(60 * deg, 20, Cycloidal()),))(angle * deg)
    assert found.s == pytest.approx(s, abs=5e-7)
    assert found.v * deg == pytest.approx(v, abs=5e-7)
    assert found.a * deg**2 == pytest.approx(a, abs=5e-7)


def test_harmonic_problem():
    """Lift 50 mm, rise in 120 deg, return in 60 deg, 100 rpm (mycoursehelp QA 67124)."""
    program = MotionProgram((Rise(120 * deg, 50 * mm, SimpleHarmonic()), Return(60 * deg, 50 * mm, SimpleHarmonic())))
    _, v, a, _ = program.in_time(np.array([0, 60, 150, 180 - 1e-6]) * deg, 100 * rpm)
    assert round(v[1], 2) == 0.39
    assert round(-v[2], 2) == 0.79  # printed .78, cut off: 0.7854
    assert a[0] == pytest.approx(6.17, abs=0.005)
    assert a[3] == pytest.approx(24.67, abs=0.01)


@pytest.mark.parametrize(("u", "s"), CUBIC)
def test_cubic_table(u, s):
    assert FreePolynomial(start=(0, 0), end=(1, 0))(u).s == pytest.approx(s, abs=1e-12)


def test_modified_trapezoid_is_half_way_at_half_time():
    """A published tool prints 0.375 here."""
    assert ModifiedTrapezoid()(0.5).s == pytest.approx(0.5, abs=1e-15)


def test_trapezoid_against_nortons_decimals():
    """Norton's piecewise formulas of the modified trapezoid with their printed eight-digit constants."""
    s = ModifiedTrapezoid()([0.1, 0.25, 0.45]).s
    printed = [
        0.38898448 * 0.1 - 0.0309544 * np.sin(4 * np.pi * 0.1),
        2.44406184 * 0.25**2 - 0.22203097 * 0.25 + 0.00723407,
        1.6110154 * 0.45 - 0.0309544 * np.sin(4 * np.pi * 0.45 - np.pi) - 0.3055077,
    ]
    assert np.allclose(s, printed, atol=2e-7)


def test_345_peaks_of_the_high_speed_cam():
    """max b 1.875, max c 5.773503 and max(-c/a) 6.277462 at k = 0.755993 (Zinchenko and others' Shun law)."""
    k = np.linspace(0.7, 0.8, 200001)
    s, _, a, _ = Degree9()(k)
    best = np.argmax(-a / s)
    assert (-a / s)[best] == pytest.approx(6.277462, abs=5e-7)
    assert k[best] == pytest.approx(0.755993, abs=2e-6)
    assert Poly345().peaks().Ca == pytest.approx(5.773503, abs=5e-7)


# ---------------------------------------------------------------- laws beside those of the menu LAWS

REFERENCE = json.loads((Path(__file__).parents[1] / "data" / "motion_laws.json").read_text())["laws"]
OF_REFERENCE = {
    "double harmonic": DoubleHarmonic(),
    "eighth order": EighthOrder(),
    "mcv 0": ModifiedConstantVelocity(0),
    "mcv 0.2": ModifiedConstantVelocity(0.2),
    "mcv 0.333333": ModifiedConstantVelocity(1 / 3),
    "mcv 0.6": ModifiedConstantVelocity(0.6),
    "freudenstein 1-3": SumOfSines(1 / 28),
    "freudenstein 1-3-5": Freudenstein(),
    **{powers: PowerPolynomial([int(p) for p in powers.split("-")]) for powers in ("3-4-6", "3-5-7", "4-5-7-9")},
    "5-7-9-11-13": PowerPolynomial((5, 7, 9, 11, 13)),
}


def test_every_reference_has_its_law():
    assert {*OF_REFERENCE} == {*REFERENCE}


@pytest.mark.parametrize("name", REFERENCE)
def test_laws_against_twice_integrated_accelerations(name):
    law, told = OF_REFERENCE[name], REFERENCE[name]
    size = (1, told["Cv"], max(told["a_max"], -told["a_min"]), max(told["j_max"], -told["j_min"]))
    assert law.peaks() == pytest.approx(size[1:], rel=1e-9)
    assert law([0.25, 0.5, 0.75]).s == pytest.approx(told["s"], abs=1e-12)
    assert [*law(0.3)] == pytest.approx(told["at_03"], abs=1e-10)
    for u, ends in zip((0.0, 1.0), told["ends"], strict=True):
        assert np.abs(np.array(law(u)[1:]) - ends) / size[1:] == pytest.approx(0, abs=1e-9)
    u = np.linspace(0, 1, 200_001)
    for k, letter in ((2, "a"), (3, "j")):
        x = law(u)[k]
        assert x.max() == pytest.approx(told[f"{letter}_max"], abs=1e-6 * size[k])
        assert x.min() == pytest.approx(told[f"{letter}_min"], abs=1e-6 * size[k])


@pytest.mark.parametrize("name", [name for name in REFERENCE if "coefficients" in REFERENCE[name]])
def test_factors_of_powers(name):
    assert OF_REFERENCE[name].c == pytest.approx(REFERENCE[name]["coefficients"], rel=1e-12)


@pytest.mark.parametrize(
    ("law", "printed"),
    [
        (ModifiedConstantVelocity(), ("1.28", "8.01", "201.4")),  # MCV50: VDI 2143; Neklutin
        (Gutman(), ("2", "5.1302", "59.2176")),  # largest v at the middle; j(0) = 6 pi^2
        (DoubleHarmonic(), ("2.04", "9.87", "42.4")),
        (EighthOrder(), ("1.78", "5.268", "36.59")),
    ],
    ids=str,
)
def test_printed_peaks(law, printed):
    for peak, text in zip(law.peaks(), printed, strict=True):
        assert peak == pytest.approx(float(text), abs=0.51 * 10 ** -len(text.partition(".")[2]))


@pytest.mark.parametrize("law", [DoubleHarmonic(), EighthOrder()], ids=lambda law: law.name)
def test_a_return_from_the_nose_goes_on_with_the_acceleration_of_the_rise(law):
    rise, back = Rise(90 * deg, 20 * mm, law), Return(90 * deg, 20 * mm, Mirrored(law))
    nose = MotionProgram((rise, back, Dwell(180 * deg))).transitions()[0]
    assert nose.order is None
    struck = MotionProgram((rise, Return(90 * deg, 20 * mm, law), Dwell(180 * deg))).transitions()[0]
    assert struck.order == 2


REST, STRAIGHT, TURN, MOVING = (0.0, 0.0), (1.7, 0.0), (0.0, -3.1), (0.6, 2.3)


@pytest.mark.parametrize("end", [REST, STRAIGHT, TURN, MOVING], ids=["R", "G", "U", "B"])
@pytest.mark.parametrize("start", [REST, STRAIGHT, TURN, MOVING], ids=["R", "G", "U", "B"])
def test_the_sixteen_pairs_of_vdi_2143(start, end):
    """VDI 2143 part 1: from and to rest, constant velocity, a reversal and any motion, by the quintic's closed form."""
    (v0, a0), (v1, a1) = start, end
    law = FreePolynomial((0, v0, a0), (1, v1, a1))
    d, e, f = 1 - v0 - a0 / 2, v1 - v0 - a0, a1 - a0
    powers = np.polynomial.Polynomial(
        [0, v0, a0 / 2, 10 * d - 4 * e + f / 2, 7 * e - 15 * d - f, 6 * d - 3 * e + f / 2]
    )
    u = np.linspace(0, 1, 21)
    for k in range(4):
        assert law(u)[k] == pytest.approx(powers.deriv(k)(u) if k else powers(u), abs=1e-10)


@pytest.mark.parametrize(("velocity", "kept"), [(1.6, False), (5 / 3, True), (2.0, True), (2.5, True), (2.6, False)])
def test_from_rest_to_a_constant_velocity_within_its_bounds(velocity, kept):
    """A rise of 1 from rest to the velocity V: it neither passes V nor turns back for 5/3 <= V <= 5/2."""
    v = FreePolynomial((0, 0, 0), (1, velocity, 0))(np.linspace(0, 1, 20_001)).v
    assert (v.min() > -1e-9 and v.max() < velocity + 1e-9) == kept


def test_to_twice_the_mean_velocity_there_is_a_polynomial_of_two_powers():
    u = np.linspace(0, 1, 21)
    assert FreePolynomial((0, 0, 0), (1, 2, 0))(u).s == pytest.approx(2 * u**3 - u**4, abs=1e-12)
    assert PowerPolynomial((3, 4), (2,))(u).s == pytest.approx(2 * u**3 - u**4, abs=1e-12)


def test_a_first_exponent_between_two_and_three_has_an_infinite_jerk():
    law = PowerPolynomial((2.5, 4, 5))
    assert law.continuity == 2
    assert law.peaks().Cj == np.inf
    rise, back = Rise(90 * deg, 20 * mm, law), Return(90 * deg, 20 * mm, law)
    program = MotionProgram((Dwell(90 * deg), rise, Dwell(90 * deg), back))
    joints = program.transitions()
    assert [joint.lawful for joint in joints] == [False, True, False, True]
    assert joints[0].text("mm") == "90°: infinite jerk: vibration, not for a fast cam"
    assert program.peaks().jerk.value == np.inf
    assert np.isfinite(program.peaks().acceleration.value)
    assert PowerPolynomial((1.5, 4, 5)).peaks()[1:] == (np.inf, np.inf)
    assert PowerPolynomial((2, 3)).peaks().Cj == pytest.approx(12)
