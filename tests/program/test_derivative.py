"""The slopes of a program: against differences and complex steps, of every operation and of every study."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit.program import CannotRecord, derivative, record, recorded
from camkit.program.derivative import SLOPES
from camkit.program.operations import ALONG, EACH, FOLDS
from camkit.program.page import numbers
from camkit.quantities import quantities_of
from program_cases import CASES, INPUTS, case, designs_beside, expression, judged, start_of
from test_studies_and_views import STUDIES

STEP = 1e-6
DESIGNS = 12
ABOVE_ONE = {np.arccosh}
ANALYTIC = [f for f in EACH if isinstance(f, np.ufunc) and {"D->D", "DD->D"} & {*f.types}]
KINKED = {np.sign, np.minimum, np.maximum, np.fmin, np.fmax}
"""What numpy has of complex numbers too, but by their real parts."""


def program_of(function, arrays):
    return recorded(lambda given: {"out": function(*given.values())}, {str(i): a for i, a in enumerate(arrays)})


def slope(function, arrays, direction):
    """The value and the slope of a function of arrays, by its program, which was recorded at other numbers."""
    program = program_of(function, [np.ones(np.shape(a)) for a in arrays])
    both = derivative(program, program.inputs)
    found = both({str(i): a for i, a in enumerate(arrays)} | ways(range(len(arrays)), direction))
    return found["out"], found["d out"]


def differences(function, arrays, direction, step=STEP):
    """The slope by a step forwards and one backwards, and whether both see the same one."""
    with np.errstate(all="ignore"):
        here, ahead, behind = (
            np.asarray(function(*(a + k * step * d for a, d in zip(arrays, direction, strict=True))), dtype=float)
            for k in (0, 1, -1)
        )
        forwards, backwards = (ahead - here) / step, (here - behind) / step
        smooth = abs(forwards - backwards) < 1e-4 * (1 + abs(forwards) + abs(backwards))
        return (forwards + backwards) / 2, smooth


def together(told, prefix=""):
    """What a study's objectives and limits are, or their slopes."""
    return np.concatenate([np.ravel(told[f"{prefix}{name}"]) for name in "fg"])


def ways(paths, direction):
    return {f"d {path}": number for path, number in zip(paths, direction, strict=True)}


def drawn(arrays, function=None, seed=0):
    """Ordinary numbers at which functions are defined, in the shapes of arrays; and a direction."""
    rng = np.random.default_rng(seed)
    numbers = [rng.uniform(0.1, 0.9, np.shape(a)) + (function in ABOVE_ONE) for a in arrays]
    return numbers, [rng.normal(size=np.shape(a)) for a in arrays]


@pytest.mark.parametrize("function", [*EACH, *FOLDS, *ALONG])
def test_every_operation_has_a_slope_or_gives_no_number_that_has_one(function):
    use, arrays = case(function)
    assert function in SLOPES or np.asarray(use(*(np.ones(np.shape(a)) for a in arrays))).dtype.kind in "bi"


def test_an_operation_without_a_slope_is_refused(monkeypatch):
    monkeypatch.delitem(SLOPES, np.sin)
    with pytest.raises(CannotRecord, match="sin has no slope"):
        slope(np.sin, [np.ones(3)], [np.ones(3)])


def test_what_is_no_input_is_refused():
    program = recorded(lambda given: {"out": given["x"] ** 2}, {"x": 1.0})
    with pytest.raises(ValueError, match=r"^the program has no input y; it has x$"):
        derivative(program, ["x", "y"])


@pytest.mark.parametrize("name", CASES)
def test_a_row_of_the_table_against_differences(name):
    function, arrays = CASES[name]
    arrays, direction = drawn(arrays, function)
    value, found = slope(function, arrays, direction)
    expected, smooth = differences(function, arrays, direction)
    assert smooth.mean() > 0.99
    assert_array_equal(value, function(*arrays))
    assert_allclose(found[smooth], expected[smooth], rtol=2e-8, atol=2e-8)


@pytest.mark.parametrize("function", [f for f in ANALYTIC if f not in KINKED])
def test_an_operation_against_a_complex_step(function):
    arrays, direction = drawn([np.ones(50)] * function.nin, function)
    expected = function(*(a + 1e-30j * d for a, d in zip(arrays, direction, strict=True))).imag / 1e-30
    assert_allclose(slope(function, arrays, direction)[1], expected, rtol=2e-14)


@pytest.mark.parametrize("name", CASES)
def test_the_slope_is_no_number_where_the_value_is_none(name):
    function, arrays = CASES[name]
    value, found = slope(function, arrays, [np.ones(np.shape(a)) for a in arrays])
    with np.errstate(all="ignore"):
        assert_array_equal(value, function(*arrays))
    assert np.shape(found) == np.shape(value)
    assert np.isnan(found[np.isnan(value)]).all()


@pytest.mark.parametrize("seed", range(60))
def test_an_expression_at_random(seed):
    arrays, direction = drawn([np.asarray(value) for value in INPUTS.values()], seed=seed)
    arrays = [3 * a - 1 for a in arrays]
    value, found = slope(expression(seed), arrays, direction)
    expected, smooth = differences(expression(seed), arrays, direction)
    known = smooth & np.isfinite(expected)
    size = np.max(abs(expected), initial=1, where=known) * (1 + np.max(abs(value), initial=0, where=known))
    assert_allclose(found[known], expected[known], rtol=1e-6, atol=1e-8 * size)


@pytest.mark.parametrize(
    ("function", "at", "direction", "expected"),
    [
        (abs, 0.0, 1.0, 0.0),
        (lambda x: np.maximum(x, 1 - x), 0.5, 1.0, 1.0),
        (lambda x: np.minimum(x, 1 - x), 0.5, 1.0, 1.0),
        (lambda x: np.where(x > 0.5, 3 * x, x), 0.5, 1.0, 1.0),
        (lambda x: np.sqrt(np.maximum(x, 0.0)), -1.0, 1.0, 0.0),
        (lambda x: np.sqrt(x), 0.0, 0.0, 0.0),
        (lambda x: np.sqrt(x), 0.0, 1.0, np.inf),
        (lambda x: x**1.5, 0.0, 1.0, 0.0),
        (lambda x: np.sum(x ** np.arange(3.0)), 0.0, 1.0, 1.0),
        (lambda x: np.hypot(x, x), 0.0, 1.0, 0.0),
        (lambda x: np.arccos(np.clip(x, -1.0, 1.0)), 2.0, 1.0, 0.0),
        (lambda x: np.arctan2(0 * x, 0 * x), 1.0, 1.0, 0.0),
        (lambda x: np.where(x > 0, np.log(x), x), -2.0, 1.0, 1.0),
        (lambda x: np.max(np.stack([x, x, 2 * x]), axis=0), 0.0, 1.0, 1.0),
        (lambda x: np.prod(np.stack([x, x, x]), axis=0), 0.0, 1.0, 0.0),
        (lambda x: np.floor(x), 2.0, 1.0, 0.0),
        (lambda x: 2.0**x, 3.0, 1.0, 8 * np.log(2)),
    ],
)
def test_at_ties_and_at_edges_it_is_that_of_the_branch_taken(function, at, direction, expected):
    assert slope(function, [np.float64(at)], [np.float64(direction)])[1] == expected


def test_sorted_slopes_go_with_their_numbers():
    x = np.array([[3.0, 1.0, 1.0, np.nan, 2.0], [0.0, -1.0, np.nan, np.nan, 5.0]])
    given = np.arange(10.0).reshape(2, 5)
    for axis in (-1, 0, None):
        _, found = slope(lambda m, axis=axis: np.sort(m, axis=axis), [x], [given])
        order = np.argsort(x, axis=axis, kind="stable")
        expected = np.ravel(given)[order] if axis is None else np.take_along_axis(given, order, axis)
        assert_array_equal(found, np.where(np.isnan(np.sort(x, axis=axis)), np.nan, expected))


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_a_study_against_differences(name):
    study = STUDIES[name].replace(angles=61)
    program, free = record(judged(study, 1), study.start), [*study.free]
    both, start, draw = derivative(program, free), start_of(study.start), np.random.default_rng(2)
    (low, high), seen = study.bounds, 0

    def said(x):
        return together(program(start | dict(zip(free, x, strict=True))))

    for x in study.x0 + 0.2 * (draw.uniform(low, high, (DESIGNS, len(free))) - study.x0):
        way = draw.normal(size=len(x)) * (high - low)
        slopes = together(both(start | dict(zip(free, x, strict=True)) | ways(free, way)), "d ")
        expected, smooth = differences(said, [x], [way], 1e-7)
        value = said(x)
        assert np.isnan(slopes[np.isnan(value)]).all()
        known = np.isfinite(value) & np.isfinite(expected) & smooth
        size = abs(expected) + abs(value)
        assert_allclose((slopes / size)[known], (expected / size)[known], atol=2e-5)
        seen += known.sum()
    assert seen > DESIGNS


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_designs_of_a_study_that_cannot_be_built_have_the_same_values(name):
    study = STUDIES[name].replace(angles=61)
    program, paths = record(judged(study, 1), study.start), [*quantities_of(study.start)]
    both, values = derivative(program, paths), designs_beside(study.start, DESIGNS, 3)
    for k in range(DESIGNS):
        here = {path: values[path][k, 0] for path in paths}
        assert_array_equal(together(both(here | ways(paths, np.ones(len(paths))))), together(program(here)))


def test_native_code_and_the_page_take_it():
    pytest.importorskip("llvmlite")
    from camkit.program.kernel import Kernel

    study = STUDIES["shaft"]
    program, free = record(judged(study, 1), study.start), [*study.free]
    both = derivative(program, free)
    start = start_of(study.start)
    others = {name: value for name, value in start.items() if name not in free}
    x, way = study.x0 * np.linspace(0.99, 1.01, 5)[:, None], np.eye(5, len(free))
    found = Kernel(both, [*free, *ways(free, free)])(others, np.hstack([x, way]))
    for each, direction, row in zip(x, way, found, strict=True):
        told = both(start | dict(zip(free, each, strict=True)) | ways(free, direction))
        expected = np.concatenate([np.ravel(value) for value in told.values()])
        assert_allclose(row, expected, rtol=1e-9, atol=1e-11 * np.max(abs(expected)))
    assert json.loads(numbers(both))[2]
