"""Units against the SI brochure's prefixes and the definitions of degree, turn and minute."""

import re
from fractions import Fraction
from math import pi

import numpy as np
import pytest
import scipy.constants as codata
from hypothesis import given, settings
from hypothesis import strategies as st

import camkit
from camkit.units import convert, factor, in_unit, known_units
from camkit.units.typed import typed_number

PREFIX = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "k": 1e3, "M": 1e6, "G": 1e9}
SI = {"m": 1, "g": 1e-3, "s": 1, "rad": 1, "N": 1, "Pa": 1, "W": 1, "J": 1, "Hz": 1, "1": 1}
SI |= {"deg": pi / 180, "rpm": 2 * pi / 60, "%": 0.01, "min": 60, "in": 0.0254, "psi": 6894.757293168361}
UNITS = [
    *("", "%", "m", "cm", "mm", "um", "in", "mm/rad", "mm/rad^3", "1/rad", "1/rad^2", "1/m", "1/mm", "mm^2"),
    *("rad", "deg", "deg/m", "s", "rpm", "rad/s", "deg/s", "m/s", "m/s^2", "rad/s^2", "kg", "kg/m^3", "kg m^2"),
    *("N", "kN", "N/m", "N/mm", "N^0.5 mm^-0.5", "N^1.5 mm^-0.5", "N m", "N mm", "N m/rad", "Pa", "MPa", "W", "kW"),
    *("GPa", "kJ", "mJ", "g", "Hz", "min", "1/min", "N^1.5 cm^-0.5", "kW min", "psi", "in^2", "m^4", "mm^3", "mm/min"),
]  # fmt: skip
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


@pytest.mark.parametrize("unit", UNITS)
def test_every_unit_is_the_product_of_its_parts(unit):
    assert factor(unit) == pytest.approx(worth(unit), rel=1e-14)


@pytest.mark.parametrize(("unit", "si"), [
    ("in", codata.inch), ("inch", codata.inch), ("ft", codata.foot), ("lbf", codata.lbf), ("psi", codata.psi),
    ("lb", codata.lb), ("oz", codata.oz), ("hp", codata.hp),
    ("um", codata.micron), ("min", codata.minute), ("deg", codata.degree), ("lbf in", codata.lbf * codata.inch),
    ("lbf/in", codata.lbf / codata.inch), ("kW min", 6e4), ("J/(kg m)", 1.0), ("N*mm", 1e-3), ("kN·m", 1e3),
])  # fmt: skip
def test_units_by_definition_agree_with_codata(unit, si):
    assert factor(unit) == pytest.approx(si, rel=1e-15)


@pytest.mark.parametrize(("same", "other"), [
    ("kN*m", "kN m"), ("N/mm^2", "MPa"), ("N/(mm mm)", "MPa"), ("J", "N m"), ("W", "N m/s"), ("µm", "um"),
    ("N m^-2", "Pa"),
    ("1/mm", "mm^-1"), ("psi", "lbf/in^2"), ("Hz", "1/s"), ("°", "deg"), ("mm * mm", "mm^2"), ("1", ""),
])  # fmt: skip
def test_one_unit_may_be_written_in_several_ways(same, other):
    assert convert(1.0, same, other) == pytest.approx(1.0, rel=1e-14)


@pytest.mark.parametrize("unit", [
    "furlong", "J/kg m", "m/s/s", "N**2", "m^", "m^99", "m^1e9", "2 mm", "/s", "/", "N/", "(N m", "N/(", "N/()",
    "kdeg", "mpsi",
    "mm\n", "N\nm", "\nmm", "mm\r",
    " ", "mm ^2", "m" * 99, "<b>", "kN m " * 50, "^2", "m^2^2", "mm]", "1 mm",
])  # fmt: skip
def test_what_is_no_product_of_powers_is_refused_in_a_sentence(unit):
    with pytest.raises(ValueError, match=r"^the unit '.*' is not known; it must be a product of powers") as refusal:
        factor(unit)
    assert len(str(refusal.value)) < 220


@pytest.mark.parametrize(("unit", "into"), [
    ("kg", "mm"), ("N", "kg"), ("rpm", "Hz"), ("deg", "%"), ("N m", "N"), ("mm/rad", "mm"), ("s", ""), ("MPa", "N/mm"),
])  # fmt: skip
def test_what_measures_something_else_is_not_converted(unit, into):
    with pytest.raises(ValueError, match=f"^{unit} cannot be converted into {into or 'a plain number'}$"):
        convert(1.0, unit, into)


@pytest.mark.parametrize("unit", ["nm^9 nm^9 nm^9 nm^9 nm^9", "Gm^9 Gm^9 Gm^9 Gm^9 Gm^9 Gm^9", "1/(nm^9 nm^9 Gm^-9)"])
def test_a_unit_that_a_computer_cannot_hold_is_refused(unit):
    with pytest.raises(
        ValueError, match=rf"^the unit {re.escape(repr(unit))} is too large or too small for a computer"
    ):
        factor(unit)


@pytest.mark.parametrize(("value", "said"), [
    (None, "what is given in m is None; it must be a number"),
    (True, "what is given in m is True; it must be a number"),
    ("1", "what is given in m is '1'; it must be a number"),
    (1j, "what is given in m is 1j; it must be a number"),
    (np.array([1.0]), r"what is given in m is array\(\[1.\]\); it must be a number"),
    (10**400, "inf m is too large for a computer"),
    (1e307, r"1e\+307 m is too large for a computer"),
    (-5e-324, r"-4.94065645841247e-324 m is too small for a computer"),
])  # fmt: skip
def test_what_is_no_number_is_not_converted(value, said):
    with pytest.raises(ValueError, match=f"^{said}$"):
        convert(value, "m", "mm")


@pytest.mark.parametrize(
    "value", ["1", True, np.True_, 1j, None, [1.0], np.array(["1"]), np.array([True]), np.array([1j]), 10**400]
)
def test_what_is_no_number_is_not_shown_in_a_unit(value):
    with pytest.raises(ValueError, match=r"^what is to be shown in mm is no number that a computer can hold$"):
        in_unit(value, "mm")


def test_numbers_of_every_type_are_converted():
    for one in (1, 1.0, np.float32(1), np.int64(1), Fraction(1)):
        assert convert(one, "m", "mm") == 1000
    assert convert(0, "m", "mm") == 0
    assert np.isnan(convert(np.nan, "m", "mm"))


def test_every_unit_is_listed_by_its_name():
    units = known_units()
    assert {"mm", "um", "µm", "°", "deg", "rpm", "in", "inch", "lbf", "psi", "%", "kPa", "min"} < set(units)
    assert not {"kdeg", "mpsi", "kin"} & set(units)
    for name, (worth, (length, mass, time, angle)) in units.items():
        assert worth == factor(name)
        assert convert(1.0, name, f"m^{length} kg^{mass} s^{time} rad^{angle}") == pytest.approx(worth, rel=1e-14)


@pytest.mark.parametrize("text", [None, 1.0, b"1"])
def test_what_is_no_text_was_not_typed(text):
    with pytest.raises(ValueError, match=f"^what is typed is {re.escape(repr(text))}; it must be a text$"):
        typed_number(text)


def test_a_measure_and_a_quantity_may_have_any_unit():
    energy = camkit.Measure("energy", "kN*mm", lambda analysis: 2.5)
    assert energy.text(energy(None)) == "2.5 kN*mm"
    stiff = camkit.quantities.Quantity("k", 40, 10, 90, "lbf/in", "stiffness")
    assert stiff.text(7005.0739) == "40 lbf/in"  # 1 lbf/in is 175.126835 N/m


@pytest.mark.parametrize(("text", "unit", "meant"), [
    ("2 in", "mm", 50.8), ("2in", "mm", 50.8), ("60,5mm", "mm", 60.5), ("1e3 um", "mm", 1.0),
    ("0,5 rad", "deg", 90 / pi),
    ("1e-3 m", "mm", 1.0), ("12", "mm", 12.0), ("50 %", "", 0.5), ("-3 °", "deg", -3.0), ("60 rpm", "rad/s", 2 * pi),
    ("100 psi", "MPa", 0.6894757293168361), ("10 lbf/in", "N/mm", 1.7512683524647636), ("2 kN*m", "N m", 2000.0),
])  # fmt: skip
def test_a_number_may_be_typed_with_its_unit(text, unit, meant):
    assert typed_number(text, unit) == pytest.approx(meant, rel=2e-15)


@pytest.mark.parametrize(("text", "said"), [
    ("2 kg", "kg cannot be converted into mm"),
    ("2 lb", "lb cannot be converted into mm"),
    ("12abc", "the unit 'abc' is not known; it must be"),
    ("1e", "the unit 'e' is not known; it must be"),
    ("1/2", "'1/2' is no number"),
    ("1/2 in", "'1/2 in' is no number"),
    ("1 2 in", "'1 2 in' is no number"),
    ("1,234 mm", "'1,234 mm' may be 1.234 or 1234; write"),
    ("in", "'in' is no number"),
    ("1e999 in", "'1e999 in' is too large"),
    ("1e308 km", r"1e\+308 km is too large"),
    ("1e-320 um", "'1e-320 um' is too small"),
    ("5e-324 mm", "'5e-324 mm' is too small"),
    ("1e-307 um", "1e-307 um is too small"),
    ("3e-308 um", "3e-308 um is too small"),
    ("5 %", "% cannot be converted into mm"),
])  # fmt: skip
def test_a_number_with_another_unit_is_refused(text, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        typed_number(text, "mm")


@pytest.mark.parametrize(
    "name", ["mm", "cm", "m", "deg", "rad", "rpm", "N", "MPa", "GPa", "kW", "kg", "um", "inch", "lbf", "psi"]
)
def test_units_are_plain_numbers_to_multiply_by(name):
    assert getattr(camkit, name) == factor(name)
    assert type(getattr(camkit, name)) is float


@given(typed, st.sampled_from(UNITS))
@settings(deadline=None)
def test_a_typed_number_comes_back_to_the_last_digit(value, unit):
    assert in_unit(value * factor(unit), unit) == value


@given(st.floats(1e-30, 1e12) | st.floats(-1e12, -1e-30), st.sampled_from(UNITS))
@settings(deadline=None)
def test_any_number_comes_back_to_fifteen_digits(value, unit):
    exact = Fraction(value) / Fraction(factor(unit))
    assert abs(Fraction(in_unit(value, unit)) - exact) <= abs(exact) * Fraction(1, 10**14)


def test_arrays_are_divided_as_they_are():
    values = np.array([[0.05], [np.nan]])
    np.testing.assert_array_equal(in_unit(values, "mm"), values / 1e-3)
