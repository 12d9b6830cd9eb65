"""Programs written as JavaScript give in a browser what numpy gives: every row of the table, and a whole machine."""

import json

import numpy as np
import pytest

from camkit import DoorHandleCam, door_handle_study
from camkit.program import record, recorded
from camkit.program.page import MACHINE, numbers
from camkit.quantities import with_quantities
from program_cases import CASES, INPUTS, designs_beside, expression, judged

RUN = f"""jobs => JSON.stringify(jobs.map(([numbers, inputs]) => {{
    const f = ({MACHINE})(...JSON.parse(numbers));
    return inputs.map(x => f(x).map(a => [...a]));
}}), (_, x) => typeof x === "number" && !Number.isFinite(x) ? String(x) : x).replace(/"/g, "")"""
TOLERANCE = 1e-12
"""Of the largest of an output: JavaScript's functions differ from numpy's in the last digit."""


@pytest.fixture(scope="module")
def page(browser):
    page = browser.new_page()
    yield page
    page.close()


def replies(page, jobs, run=RUN):
    """What each program makes of each of its inputs; one text, since many values take long to come to Python."""
    return json.loads(page.evaluate(run, jobs))


def flat(arrays):
    return [float(x) for array in arrays for x in np.ravel(array)]


def program_of(function, arrays):
    shapes = {str(i): np.ones(np.shape(array)) for i, array in enumerate(arrays)}
    return recorded(lambda given: {"out": function(*given.values())}, shapes)


def same(found, expected):
    """Whether numbers agree: what is not finite exactly, the others to a share of the largest."""
    found, expected = np.ravel(np.asarray(found, dtype=float)), np.ravel(np.asarray(expected, dtype=float))
    known = np.isfinite(expected)
    np.testing.assert_array_equal(found[~known], expected[~known])
    largest = abs(expected[known]).max(initial=0.0)
    np.testing.assert_allclose(found[known], expected[known], rtol=0, atol=TOLERANCE * largest)


def run(page, uses):
    """What the browser gives of each function and its arrays, and what numpy gives."""
    found = replies(page, [[numbers(program_of(f, arrays)), [flat(arrays)]] for f, arrays in uses])
    with np.errstate(all="ignore"):
        return [(job[0][0], f(*arrays)) for job, (f, arrays) in zip(found, uses, strict=True)]


def test_every_row_of_the_table_is_in_the_page_what_it_is_in_numpy(page):
    for name, (found, expected) in zip(CASES, run(page, CASES.values()), strict=True):
        for number, of_numpy in zip(np.ravel(found), np.ravel(expected), strict=True):
            np.testing.assert_allclose(number, of_numpy, rtol=TOLERANCE, atol=0, err_msg=name)


TABLES = {
    "wide": np.random.default_rng(2).normal(size=(3, 4, 9)),
    "high": np.random.default_rng(3).normal(size=(9, 4, 2)),
}
ALONG = {
    "one axis": lambda m: np.sum(m, axis=0),
    "the axis between": lambda m: np.max(m, axis=1, keepdims=True),
    "two axes": lambda m: np.min(m, axis=(0, 2)),
    "all axes": lambda m: np.any(m > 2),
    "so far": lambda m: np.add.accumulate(m, axis=1),
    "where it is highest": lambda m: np.argmax(m, axis=1),
    "in order": lambda m: np.sort(m, axis=0),
    "picked": lambda m: np.take_along_axis(m, np.argmin(m, axis=1, keepdims=True), 1),
    "the other way": lambda m: m[::-1, :, ::-2] * m[:, :1, 0:1],
    "each with each": lambda m: m[0, :, None] - m[-1, None, :],
    "truths": lambda m: (m > 0) + (m < -1) * (m < 0),
}


@pytest.mark.parametrize("table", TABLES)
def test_what_goes_along_axes_goes_along_them_in_the_page(page, table):
    for found, expected in run(page, [(use, [TABLES[table]]) for use in ALONG.values()]):
        same(found, expected)


def test_expressions_made_at_random_are_in_the_page_what_they_are_in_numpy(page):
    rng = np.random.default_rng(7)
    uses = [(expression(seed), [rng.normal(size=np.shape(x)) for x in INPUTS.values()]) for seed in range(200)]
    for found, expected in run(page, uses):
        same(found, expected)


def test_the_study_of_the_door_handle_is_in_the_page_what_it_is_in_numpy(page):
    study, p = door_handle_study(DoorHandleCam()), 200
    text = numbers(record(judged(study, 1), study.start))
    values = designs_beside(study.start, p, 3)
    with np.errstate(all="ignore"):
        expected = judged(study, p)(with_quantities(study.start, values))
    ((*found,),) = replies(page, [[text, np.hstack(list(values.values())).tolist()]])
    assert 20 <= np.isfinite(expected["f"]).all(-1).sum() <= p - 20
    for k, name in enumerate(expected):
        for column, of_numpy in zip(np.transpose([one[k] for one in found]), expected[name].T, strict=True):
            same(column, of_numpy)


def test_what_rests_while_steady_inputs_stay_is_not_done_again_and_comes_out_the_same(page):
    x = np.linspace(0, 3, 7)

    def value(a, b, turn):
        curve = np.cumsum(a * np.sin(x) + b)  # rests
        place = np.argmin(abs(x - turn))
        return np.stack([curve[place], np.sum(curve), np.max(curve * np.cos(turn)), np.sort(turn - curve)[0]])

    program = recorded(lambda given: {"out": value(*given.values())}, {"a": 1.0, "b": 2.0, "turn": 0.3})
    inputs = [[1, 2, 0.3], [1, 2, 1.4], [1, 2, 2.9], [1, -2, 2.9], [1, -2, 0.1], [np.nan, 2, 0.1], [1, 2, 0.1]]
    given = [[str(x) for x in row] for row in inputs]
    run_in_turn = RUN.replace("f(x)", "f(x.map(s => s === 'nan' ? NaN : Number(s)))")
    ((*found,),) = replies(page, [[numbers(program, steady=2), given]], run_in_turn)
    for one, row in zip(found, inputs, strict=True):
        same(one[0], value(*row))


def test_an_output_that_stays_is_the_same_array_and_what_changes_is_another_one(page):
    inputs, sizes = {"still": 1.0, "turn": 1.0}, np.array([1.0, 2.0])
    program = recorded(lambda x: {"shape": x["still"] * sizes, "place": x["turn"] * x["still"] * sizes}, inputs)
    found = page.evaluate(
        f"""text => {{ const f = ({MACHINE})(...JSON.parse(text));
        const [first, turned, moved] = [[2, 3], [2, 4], [5, 4]].map(x => f(x));
        return [first[0] === turned[0], first[1] === turned[1], first[0] === moved[0], [first, turned, moved]
            .map(outputs => outputs.map(array => [...array]))]; }}""",
        numbers(program, steady=1),
    )
    assert found[:3] == [True, False, False]
    assert found[3] == [[[2, 4], [6, 12]], [[2, 4], [8, 16]], [[5, 10], [20, 40]]]
