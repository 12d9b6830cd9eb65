"""Motion laws against printed tables."""

import numpy as np
import pytest

from camkit.motion import (
    LAWS,
    Cycloidal,
    Degree9,
    FreePolynomial,
    ModifiedTrapezoid,
    MotionProgram,
    Poly345,
    Return,
    Rise,
    SimpleHarmonic,
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
