"""Declarations: what a slider, a bound, a table and a refusal read from one place."""

from dataclasses import FrozenInstanceError, dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from camkit import ArmLoad, DoorHandleCam, Friction, OscillatingRollerCam
from camkit.motion import LAWS, Cycloidal, Poly345
from camkit.quantities import Choice, Design, Measure, Quantity, choice, declarations, quantity
from camkit.units import deg, mm


@dataclass(frozen=True)
class Crowbar(Design):
    """A design for these tests."""

    length: float = quantity("L", 500, 200, 900, "mm", "claw to grip")
    bend: float = quantity("beta", -20, -90, 90, "deg", "of the claw", above=None)
    grip: float = quantity("f", 0.2, 0, 1, "", "hand on steel", at_least=0)
    law: object = choice("law", Cycloidal(), LAWS, "how it is swung")
    note: str = field(default="")


DESIGNS = [ArmLoad, DoorHandleCam, Friction, OscillatingRollerCam]
every_design = pytest.mark.parametrize("kind", DESIGNS, ids=lambda kind: kind.__name__)


def test_a_default_is_said_in_its_unit_and_kept_in_si():
    assert Crowbar().length == 500 * mm
    assert Crowbar().bend == -20 * deg
    assert Crowbar().grip == 0.2


def test_declarations_are_the_declared_fields_in_order():
    declared = declarations(Crowbar)
    assert list(declared) == ["length", "bend", "grip", "law"]
    assert declared == declarations(Crowbar())
    assert declared["length"] == Quantity("L", 500, 200, 900, "mm", "claw to grip")
    assert isinstance(declared["law"], Choice)
    assert declared["law"].options == LAWS


@every_design
def test_what_a_slider_offers_can_be_declared(kind):
    """The range holds the default and nothing that the declaration itself refuses, but for an open end at 0."""
    for name, declared in declarations(kind).items():
        if isinstance(declared, Choice):
            assert declared.default in declared.options
            continue
        assert declared.low < declared.high, name
        assert declared.low <= declared.default <= declared.high, name
        assert declared.allows(declared.default * declared.factor), name
        assert declared.allows(declared.low * declared.factor), name
        assert declared.allows(declared.high * declared.factor), name


@every_design
def test_symbols_and_meanings_are_there_once(kind):
    declared = declarations(kind).values()
    assert len({d.symbol for d in declared}) == len(declared)
    assert all(d.meaning and d.symbol for d in declared)


@pytest.mark.parametrize(
    ("limits", "words", "allowed", "refused"),
    [
        ({}, "a finite number above 0 mm", [1e-9, 5], [0, -1, np.nan, np.inf]),
        ({"above": -3}, "a finite number above -3 mm", [-2.9 * mm], [-3 * mm, -np.inf]),
        ({"at_least": 0}, "a finite number of at least 0 mm", [0, 1], [-1e-9, np.nan]),
        ({"above": None}, "a finite number", [-1e9, 0, 1e9], [np.nan, np.inf, -np.inf]),
    ],
)
def test_what_is_possible_is_said_and_checked_alike(limits, words, allowed, refused):
    declared = Quantity("x", 1, 0, 2, "mm", "a length", **limits)
    assert declared.possible == words
    assert all(declared.allows(value) for value in allowed)
    assert not any(declared.allows(value) for value in refused)
    column = np.array(allowed + refused)[:, None]
    assert declared.allows(column).ravel().tolist() == [True] * len(allowed) + [False] * len(refused)


@given(st.floats(allow_nan=True, allow_infinity=True))
@settings(deadline=None)
def test_one_number_is_kept_or_refused(value):
    possible = np.isfinite(value) and value > 0
    if possible:
        assert Crowbar(length=value).length == value
    else:
        with pytest.raises(ValueError, match=r"^the length L \(claw to grip\) is .*; it must be a finite number above"):
            Crowbar(length=value)


def test_a_population_is_kept_without_a_refusal():
    lengths = np.array([[0.3], [0.4], [0.5]])
    assert_array_equal(Crowbar(length=lengths).length, lengths)
    Crowbar(length=np.array([[0.3], [-0.4], [np.nan]]))  # its members are for the analysis to make nan


def test_a_design_is_a_value():
    assert Crowbar() == Crowbar(length=500 * mm)
    assert hash(Crowbar()) == hash(Crowbar(length=500 * mm))
    with pytest.raises(FrozenInstanceError):
        Crowbar().length = 1.0


def test_a_change_makes_another_design_and_is_checked():
    bar = Crowbar(note="red")
    longer = bar.replace(length=600 * mm, law=Poly345())
    assert (longer.length, longer.law, longer.note) == (600 * mm, Poly345(), "red")
    assert bar.length == 500 * mm
    with pytest.raises(ValueError, match="is -600 mm"):
        bar.replace(length=-600 * mm)
    with pytest.raises(ValueError, match=r"^Crowbar has no lenght; it has length, bend, grip, law, note$"):
        bar.replace(lenght=1)


def test_a_design_shows_as_a_table_in_display_units():
    html = Crowbar(length=512.5 * mm)._repr_html_()
    for cell in ("Crowbar", "length", "<i>L</i>", "512.5 mm", "claw to grip", "-20 deg", "0.2", "cycloidal"):
        assert f">{cell}</" in html or cell in html
    assert html.count("<tr>") == 4
    assert "3 values in mm" in Crowbar(length=np.ones((3, 1)))._repr_html_()


@every_design
def test_every_design_shows_as_a_table(kind):
    html = kind()._repr_html_()
    for name, declared in declarations(kind).items():
        assert name.replace("_", " ") in html
        assert declared.meaning in html
        if isinstance(declared, Quantity):
            assert f"{declared.default:.6g} {declared.unit}".strip() in html


@given(st.floats(-1e6, 1e6), st.sampled_from(["mm", "deg", "", "N mm", "%"]))
@settings(deadline=None)
def test_a_value_is_read_in_its_unit(value, unit):
    declared = Quantity("x", 1, 0, 2, unit, "anything")
    number, _, shown = declared.text(value * declared.factor).partition(" ")
    assert float(number) == pytest.approx(value, rel=1e-5, abs=1e-9)
    assert shown == unit


def test_a_measure_is_known_by_name_and_unit():
    height = Measure("height", "mm", lambda a: a)
    assert height == Measure("height", "mm", lambda a: 2 * a)
    assert {height: 1}[Measure("height", "mm", abs)] == 1
    assert height != Measure("height", "cm", lambda a: a)
    taller = -height
    assert height != taller
    assert height == -taller
    assert (height(0.05), taller(0.05), (-taller)(0.05)) == (0.05, -0.05, 0.05)


def test_a_measures_words():
    height = Measure("height", "mm", lambda a: a)
    assert height.label == "height  [mm]"
    assert height.text(0.0123456) == "12.35 mm"
    assert (-height).text(0.0123456) == "12.35 mm"
    assert Measure("margin", "", lambda a: a).label == "margin"
    assert Measure("margin", "", lambda a: a).text(np.float64(0.5)) == "0.5"
    assert height.text(np.inf) == "inf mm"
