"""Units against the SI brochure's prefixes and the definitions of degree, turn and minute."""

from fractions import Fraction
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import camkit
from camkit.units import FACTORS, factor, in_unit

PREFIX = {"u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9}
SI = {
    "m": 1,
    "rad": 1,
    "s": 1,
    "kg": 1,
    "N": 1,
    "Pa": 1,
    "W": 1,
    "deg": pi / 180,
    "rpm": 2 * pi / 60,
    "%": 0.01,
    "1": 1,
}
typed = st.decimals(-1000000, 1000000, allow_nan=False, places=6).map(float)


def worth(unit):
    """SI value of a name such as ``N m/rad`` or ``mm/rad^2``, from its parts."""
    total = 1.0
    for side, part in enumerate(unit.split("/")):
        for name in part.split():
            base, _, power = name.partition("^")
            one = SI[base] if base in SI else PREFIX[base[0]] * SI[base[1:]]
            total *= one ** ((-1) ** side * float(power or 1))
    return total


@pytest.mark.parametrize("unit", FACTORS)
def test_every_unit_is_the_product_of_its_parts(unit):
    assert factor(unit) == pytest.approx(worth(unit), rel=1e-14)


@pytest.mark.parametrize("name", ["mm", "cm", "m", "deg", "rad", "rpm", "N", "MPa", "GPa", "kW", "kg"])
def test_units_are_plain_numbers_to_multiply_by(name):
    assert getattr(camkit, name) == factor(name)
    assert type(getattr(camkit, name)) is float


@given(typed, st.sampled_from(list(FACTORS)))
@settings(deadline=None)
def test_a_typed_number_comes_back_to_the_last_digit(value, unit):
    assert in_unit(value * factor(unit), unit) == value


@given(st.floats(1e-30, 1e12) | st.floats(-1e12, -1e-30), st.sampled_from(list(FACTORS)))
@settings(deadline=None)
def test_any_number_comes_back_to_fifteen_digits(value, unit):
    exact = Fraction(value) / Fraction(factor(unit))
    assert abs(Fraction(in_unit(value, unit)) - exact) <= abs(exact) * Fraction(1, 10**14)


def test_arrays_are_divided_as_they_are():
    values = np.array([[0.05], [np.nan]])
    np.testing.assert_array_equal(in_unit(values, "mm"), values / 1e-3)
