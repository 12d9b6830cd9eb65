"""Declarations: what a slider, a bound, a table and a refusal read from one place."""

from collections.abc import Callable
from dataclasses import FrozenInstanceError, dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from camkit import (
    ArmLoad,
    DoorHandleCam,
    Friction,
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    SlideLoad,
    Study,
    TranslatingRollerCam,
    UniversalJointShaft,
    rssr_study,
)
from camkit.cam import ContactPair
from camkit.motion import LAWS, Cycloidal, Poly345
from camkit.quantities import (
    Choice,
    Design,
    Measure,
    Quantity,
    UnitRemark,
    choice,
    declarations,
    label,
    quantity,
    unremarked,
)
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
        ({}, "a finite number above 0 mm", [1e-9, 2], [0, -1, 2.01, 1e160, np.nan, np.inf]),
        ({"above": -3}, "a finite number above -3 mm", [-2.9 * mm], [-3 * mm, -np.inf]),
        ({"at_least": 0}, "a finite number of at least 0 mm", [0, 1e-14, 1], [-1e-9, 1e-16, 1e300, np.nan]),
        ({"above": None}, "a finite number", [-2, 0, 2], [-2.01, 2.01, np.nan, np.inf, -np.inf]),
        ({"at_most": 4}, "a finite number above 0 mm and at most 4 mm", [4 * mm], [4.01 * mm]),
        ({"above": None, "at_most": 4}, "a finite number of a size of at most 4 mm", [-4 * mm], [-4.01 * mm]),
    ],
)
def test_what_is_possible_is_said_and_checked_alike(limits, words, allowed, refused):
    declared = Quantity("x", 1, 0, 2, "mm", "a length", **limits)
    assert declared.possible == words
    assert all(declared.allows(value) for value in allowed)
    assert not any(declared.allows(value) for value in refused)
    column = np.array(allowed + refused)[:, None]
    assert declared.allows(column).ravel().tolist() == [True] * len(allowed) + [False] * len(refused)


@pytest.mark.parametrize(
    "build",
    [lambda x: HighSpeedCam(arm_length=x, centre_distance=x), lambda x: OscillatingRollerCam(arm_length=x),
     lambda x: rssr_study().start.replace(rocker=x), lambda x: TranslatingRollerCam(base_radius=x)],
)  # fmt: skip
@pytest.mark.parametrize("size", [5e-324, 1e-300, 1e-200, 1e-20])
def test_a_number_above_0_of_an_absurdly_small_size_is_refused(build, size):
    """Before anything is divided by it, which would overflow."""
    with pytest.raises(ValueError, match=r"it must be a finite number of at least [0-9.e-]+ mm$"):
        build(size)


@given(st.floats(allow_nan=True, allow_infinity=True))
@settings(deadline=None)
def test_one_number_is_kept_or_refused(value):
    possible = 9e-13 <= value <= 900  # a thousand times the 900 mm that a slider offers, or a million-millionth of it
    if possible:
        assert Crowbar(length=value).length == value
    else:
        with pytest.raises(
            ValueError, match=r"^the length \(claw to grip\) is .*; it must be a finite number (above|of at least)"
        ):
            Crowbar(length=value)


TOO_LARGE = {
    "far beyond a slider": (900.1, "is 900100 mm; it must be a finite number above 0 mm and at most 900000 mm"),
    "1e160": (1e160, "is 1e+163 mm; it must be a finite number above 0 mm and at most 900000 mm"),
    "an integer of 5000 digits": (10**5000, "is inf mm; it must be a finite number above 0 mm"),
}


@pytest.mark.parametrize(("value", "said"), TOO_LARGE.values(), ids=TOO_LARGE)
def test_a_number_too_large_is_refused_and_in_a_population_nan(value, said):
    with pytest.raises(ValueError) as refused:  # noqa: PT011  the whole sentence is compared
        Crowbar(length=value)
    assert str(refused.value) == f"the length (claw to grip) {said}"
    column = np.array([[0.3], [np.inf if value > 1e300 else value]])
    assert_array_equal(Crowbar(length=column).length, [[0.3], [np.nan]])


@pytest.mark.parametrize("kind", [DoorHandleCam, HighSpeedCam, TranslatingRollerCam, UniversalJointShaft])
@pytest.mark.parametrize("size", [1e160, 1e300, -1e300])
def test_no_number_of_a_design_overflows(kind, size):
    for name, declared in declarations(kind).items():
        if isinstance(declared, Quantity):
            with pytest.raises(ValueError, match="; it must be a finite number"):
                kind(**{name: size})


LEFT_OUT = {
    "mm": (lambda: TranslatingRollerCam(base_radius=30),
           "the base radius is 30000 mm, numbers being in SI units; did you mean 30*mm?"),
    "deg": (lambda: OscillatingFlatCam(start_angle=22),
            "the start angle is 1260.51 deg, numbers being in SI units; did you mean 22*deg?"),
    "rpm": (lambda: SlideLoad(speed=3000),
            "the speed is 28647.9 rpm, numbers being in SI units; did you mean 3000*rpm?"),
    "GPa": (lambda: ContactPair(cam_modulus=210),
            "the cam modulus is 2.1e-07 GPa, numbers being in SI units; did you mean 210*GPa?"),
    "N/mm": (lambda: SlideLoad(spring_rate=5),
             "the spring rate is 0.005 N/mm, numbers being in SI units; did you mean 5*N/mm?"),
    "a change": (lambda: TranslatingRollerCam().replace(base_radius=30),
                 "the base radius is 30000 mm, numbers being in SI units; did you mean 30*mm?"),
    "bounds": (lambda: Study(TranslatingRollerCam(), {"base_radius": (0.03, 60)}, [Measure("height", "", len)]),
               "the base radius is 60000 mm, numbers being in SI units; did you mean 60*mm?"),
}  # fmt: skip


@pytest.mark.parametrize(("make", "sentence"), LEFT_OUT.values(), ids=LEFT_OUT)
def test_a_unit_that_was_left_out_is_remarked_once_where_it_was_typed(make, sentence):
    with pytest.warns(UnitRemark) as remarks:
        make()
    assert [str(remark.message) for remark in remarks] == [sentence]
    assert remarks[0].filename == __file__


def test_a_remark_on_one_quantity_is_not_made_again_for_a_change_of_another(recwarn):
    with unremarked():
        cam = TranslatingRollerCam(base_radius=30)
    cam.replace(roller_radius=9 * mm)
    assert not recwarn


@every_design
def test_no_number_within_a_declared_range_draws_a_remark(kind, recwarn):
    """Nor does any that is a few times as large or as small."""
    for name, declared in declarations(kind).items():
        if isinstance(declared, Quantity):
            ends = np.array([declared.low, declared.default, declared.high]) * declared.factor
            for value in (ends[:, None] * [1 / 4, 1 / 3, 1, 2, 4]).ravel():
                assert not declared.unit_left_out(float(value)), (name, value)
    assert not recwarn


def test_members_of_a_population_and_designs_of_a_study_draw_no_remark(recwarn):
    TranslatingRollerCam(base_radius=np.array([[0.03], [30.0]]))
    Study(TranslatingRollerCam(), ["base_radius"], [Measure("height", "", len)]).design([30.0])
    assert not recwarn


@dataclass(frozen=True)
class Toolbox(Design):
    """Holds another design and what is no number."""

    bar: Crowbar = field(default_factory=Crowbar)
    width: float = quantity("b", 300, 100, 900, "mm", "of the box")
    locks: int = 1
    open: bool = False
    label: str = ""
    key: object = None
    shelves: tuple[float, ...] = ()
    test: Callable[[float], bool] | None = None


KINDS = {
    "a design": ({"bar": "long"}, "the bar is 'long'; it must be a Crowbar"),
    "a class": ({"bar": Crowbar}, "the bar is the class Crowbar; it must be a Crowbar"),
    "a whole number": ({"locks": 1.5}, "the locks is 1.5; it must be a whole number"),
    "no truth": ({"locks": True}, "the locks is True; it must be a whole number"),
    "a truth": ({"open": 1}, "the open is 1; it must be True or False"),
    "a text": ({"label": 7}, "the label is 7; it must be a text"),
    "a tuple": ({"shelves": 0.3}, "the shelves is 0.3; it must be a tuple"),
    "a function": ({"test": "x > 1"}, "the test is 'x > 1'; it must be a function or None"),
    "a complex number": ({"width": 1 + 2j}, "the width is (1+2j); it must be a finite number above 0 mm"),
    "a truth for a number": ({"width": np.True_}, "the width is True; it must be a finite number above 0 mm"),
    "None": ({"width": None}, "the width is None; it must be a finite number above 0 mm"),
    "a list": ({"width": [0.3]}, "the width is [0.3]; it must be a finite number above 0 mm"),
    "an array of the shape (3,)": (
        {"width": np.ones(3)},
        "the width is an array of shape (3,); it must be a finite number above 0 mm, "
        "or a column of them of the shape (p, 1)",
    ),
    "an array of the shape (2, 3)": (
        {"width": np.ones((2, 3))},
        "the width is an array of shape (2, 3); it must be a finite number above 0 mm, "
        "or a column of them of the shape (p, 1)",
    ),
    "an array of truths": (
        {"width": np.array([[True]])},
        "the width is an array of truths of shape (1, 1); it must be a finite number above 0 mm, "
        "or a column of them of the shape (p, 1)",
    ),
    "columns of different lengths": (
        {"width": np.ones((2, 1)), "bar": Crowbar(length=np.ones((3, 1)))},
        "the Toolbox has columns of 3 in its bar and 2 in its width; they must be equally long",
    ),
}


@pytest.mark.parametrize(("values", "sentence"), KINDS.values(), ids=KINDS)
def test_a_field_of_another_kind_than_annotated_is_refused(values, sentence):
    with pytest.raises(ValueError) as refused:  # noqa: PT011  the whole sentence is compared
        Toolbox(**values)
    assert str(refused.value) == sentence


def test_numbers_of_any_type_are_kept_as_floats():
    for value in (1, np.int8(1), np.float32(1), np.array(1), np.array(1.0)):
        assert type(Crowbar(length=value).length) in (float, np.float64)
        assert Crowbar(length=value) == Crowbar(length=1.0)
    column = Crowbar(length=np.array([[1], [2]], dtype=np.uint8)).length
    assert (column.dtype, column.tolist()) == (float, [[1.0], [2.0]])


def test_a_column_of_one_member_goes_with_any():
    Toolbox(width=np.ones((1, 1)), bar=Crowbar(length=np.ones((3, 1))))


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
    design = kind()
    html, following = design._repr_html_(), design.following()
    for name, declared in declarations(kind).items():
        if name in following:
            continue
        assert label(name, declared) in html
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


@pytest.mark.parametrize(("wrong", "said"), [
    ({"low": 2.0, "high": 1.0}, "the range of x goes from 2 to 1 mm; the first must be below the second"),
    ({"low": -np.inf}, "the low is -inf; it must be a finite number"),
    ({"default": -1.0, "low": -2.0}, "the default of x is -1 mm; it must be a finite number above 0 mm"),
    ({"default": 0.05}, r"the default of x is 0.05 mm; it must be in the range from 0.1 to 2 mm"),
    ({"default": 5.0, "unit": ""}, r"the default of x is 5; it must be in the range from 0.1 to 2"),
])  # fmt: skip
def test_a_declaration_that_contradicts_itself_is_refused(wrong, said):
    with pytest.raises(ValueError, match=f"^{said}$"):
        quantity(**{"symbol": "x", "default": 1.0, "low": 0.1, "high": 2.0, "unit": "mm", "meaning": "m"} | wrong)


def test_the_options_of_a_choice_are_listed():
    for options in (None, 3, "abc"):
        with pytest.raises(ValueError, match=r"^the tuple of options is .*; it must be a tuple"):
            choice("x", 1, options, "m")


def test_nothing_public_changes_a_design_in_place():
    assert not hasattr(TranslatingRollerCam(), "keep")
