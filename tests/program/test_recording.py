"""Plain numpy code runs once and becomes a program: what it gives, and what cannot be."""

import gc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from camkit import DoorHandleCam, TranslatingRollerCam, door_handle_study
from camkit.program import CannotRecord, record, recorded
from camkit.quantities import Measure, certain, floats, known, unless, with_quantities
from program_cases import CASES, INPUTS, expression, judged, start_of


def program_of(function, arrays):
    return recorded(lambda given: {"out": function(*given.values())}, {str(i): a for i, a in enumerate(arrays)})


def replayed(function, arrays):
    """What a program of ``function``, recorded with other numbers, gives of ``arrays``."""
    program = program_of(function, [np.ones(np.shape(array)) for array in arrays])
    return program({str(i): array for i, array in enumerate(arrays)})["out"]


@pytest.mark.parametrize("name", CASES)
def test_a_row_of_the_table_gives_what_numpy_gives(name):
    function, arrays = CASES[name]
    with np.errstate(all="ignore"):
        assert_array_equal(replayed(function, arrays), function(*arrays), strict=True)


@given(st.integers(0, 10**6), st.lists(st.sampled_from([np.nan, np.inf, 0.0, 1.0]) | st.floats(-9, 9), min_size=21))
@settings(max_examples=60, deadline=None)
def test_an_expression_gives_what_numpy_gives(seed, numbers):
    inputs = [np.float64(numbers[0]), np.array(numbers[1:6]), np.array(numbers[6:21]).reshape(3, 5)]
    with np.errstate(all="ignore"):
        assert_array_equal(replayed(expression(seed), inputs), expression(seed)(*inputs))


def test_what_is_computed_again_is_there_once():
    twice = program_of(lambda x: np.sin(x) + np.sin(x) * np.cos(2 * x), [INPUTS["y"]])
    assert [call.function for call in twice.calls[1:]] == [np.sin, np.multiply, np.cos, np.multiply, np.add]


def test_what_no_output_needs_is_not_run():
    def function(x):
        np.exp(x)
        return x + 1

    program = program_of(function, [INPUTS["x"]])
    assert [program.calls[k].function for k in program.needed] == [np.add]


def test_an_output_may_be_known():
    program = recorded(lambda given: {"half": 0.5, "x": given["x"]}, {"x": 1.0})
    assert program({"x": 3.0}) == {"half": 0.5, "x": 3.0}


def test_inputs_have_the_shapes_of_the_recording():
    program = program_of(np.sin, [INPUTS["y"]])
    with pytest.raises(ValueError, match=r"^the input 0 has the shape \(3,\); it must have \(5,\)$"):
        program({"0": np.ones(3)})


REFUSED = {
    "truth": (lambda x: 1 if x[0] > 0 else 2, "a truth value, a number, a text or a plain array"),
    "chain": (lambda x: 0 < x[0] < 1, "a truth value, a number, a text or a plain array"),
    "number": (lambda x: float(x[0]), "a truth value, a number, a text or a plain array"),
    "text": (lambda x: f"{x[0]}", "a text of several numbers, or of one without a format, is asked for"),
    "text of several": (lambda x: f"{x:.3f}", "a text of several numbers, or of one without a format, is asked for"),
    "format": (lambda x: f"{x[0]:8.2f}", "a number is written as '8.2f'; as '.4g'"),
    "text of one": (lambda x: str(x[0]), "a truth value, a number, a text or a plain array"),
    "rounded": (lambda x: round(x[0]), "a truth value, a number, a text or a plain array"),
    "method": (lambda x: x.std(), "the std of a recorded value is asked for"),
    "item": (lambda x: x[0].item(), "the item of a recorded value is asked for"),
    "whole numbers": (lambda x: ~np.argmax(x), "invert of whole numbers cannot be recorded"),
    "index": (lambda x: [1, 2, 3][np.argmax(x)], "a truth value, a number, a text or a plain array"),
    "plain array": (lambda x: np.arange(5)[np.argmax(x)], "a truth value, a number, a text or a plain array"),
    "asarray": (lambda x: np.asarray(x), "a truth value, a number, a text or a plain array"),
    "array": (lambda x: np.array([x[0], 1.0]), "a truth value, a number, a text or a plain array"),
    "writing": (lambda x: x.__setitem__(0, 1.0), "a recorded array is written into"),
    "writing into": (lambda x: np.zeros(5).__setitem__(0, x[0]), "a truth value, a number, a text or a plain array"),
    "out": (lambda x: np.sin(x, out=np.zeros(5)), "a computed value is written into an array"),
    "copyto": (lambda x: np.copyto(np.zeros(5), x), "copyto cannot be recorded; it is not in the table"),
    "mask": (lambda x: x[x > 0], "an array is indexed by computed values; only its last axis can be"),
    "unknown": (lambda x: np.linalg.eigvals(x[:, None] * x), "eigvals cannot be recorded; it is not in the table"),
    "unknown ufunc": (lambda x: np.logaddexp(x, x), "logaddexp cannot be recorded; it is not in the table"),
    "unknown reduction": (lambda x: np.hypot.reduce(x), r"hypot.reduce cannot be recorded; it is not in the table"),
    "option": (lambda x: np.max(x, initial=0.0), "max cannot be recorded with these arguments"),
    "where": (lambda x: np.where(x > 0), "where cannot be recorded with these arguments"),
    "complex": (lambda x: np.exp(1j * x), "complex numbers and texts cannot be recorded"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_recorded_is_refused_with_file_and_line(name):
    function, why = REFUSED[name]
    line = function.__code__.co_firstlineno
    with pytest.raises(CannotRecord, match=rf"^tests/program/test_recording.py, line {line}: {why}"):
        program_of(function, [INPUTS["y"]])


def test_garbage_is_collected_again_after_a_recording_that_fails():
    with pytest.raises(CannotRecord):
        program_of(bool, [INPUTS["x"]])
    assert gc.isenabled()


def test_the_line_is_that_of_the_physics():
    def asks(cam):
        return {"z": 1.0 if Measure("height", "m", lambda a: a.cam.roller_radius > 0.01)(cam.analyse(31)) else 0.0}

    with pytest.raises(CannotRecord, match=r"^tests/program/test_recording.py, line \d+: a truth value"):
        record(asks, TranslatingRollerCam())


def test_what_physics_may_ask_of_a_number():
    def asks(given):
        x = given["x"]
        assert not known(x)
        assert not certain(x > 0)
        assert unless(x > 0)
        assert floats(x) is x
        return {"x": x}

    recorded(asks, {"x": -1.0})
    assert (known(-1.0), certain(-1.0 > 0), unless(1.0 > 0)) == (True, False, None)


ROWS, BLOCKS = 10, 20


@pytest.mark.slow
def test_one_design_that_cannot_be_built_is_nan_where_it_would_be_refused():
    study = door_handle_study(DoorHandleCam())
    program, start = record(judged(study, 1), study.start), start_of(study.start)
    assert_array_equal(program(start)["f"], study.evaluate(study.x0).f)
    for path, value in {"relief_centre_distance": 0.25, "relief_cam_angle": 3.5, "roller_radius": 0.05}.items():
        assert np.isinf(program(start | {path: value})["f"]).all()
        with pytest.raises(ValueError, match=r"the relief roller has|the relief cam angle is|the roller of radius"):
            with_quantities(study.start, {path: value}).analyse()


def test_a_lift_is_recorded_where_the_angles_of_its_program_stand():
    design, path = TranslatingRollerCam(), "motion.rise.lift"
    turn = np.linspace(0, 2 * np.pi, 91)

    def levels(lift):
        return with_quantities(design, {path: lift}).motion(turn).s

    assert_array_equal(replayed(levels, [np.float64(0.03)]), levels(0.03))
