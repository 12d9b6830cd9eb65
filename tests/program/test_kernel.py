"""Programs as native code: what numpy says, at awkward numbers, of expressions at random, of every machine."""

import os
import re
import signal

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit.program import record, recorded
from camkit.quantities import with_quantities
from machine_cases import LAWS
from program_cases import CASES, INPUTS, designs_beside, expression
from test_machines import CAMS, curves, with_law
from test_studies_and_views import STUDIES

pytest.importorskip("llvmlite")
from camkit.program.kernel import Kernel, compiler, kernel, needed, stored, trial

DESIGNS = 200


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def of_numbers(function, arrays):
    """A program of ``function`` whose inputs are the numbers of arrays, one by one; and these."""
    ends = np.cumsum([0, *(array.size for array in arrays)])
    numbers = np.concatenate([np.ravel(array) for array in arrays])

    def whole(given):
        row = np.stack([*given.values()])
        parts = zip(ends, ends[1:], arrays, strict=False)
        return {"out": function(*(np.reshape(row[a:b], array.shape) for a, b, array in parts))}

    return recorded(whole, {str(i): number for i, number in enumerate(numbers)}), numbers


def compare(function, arrays):
    """The kernel's numbers and numpy's, of the arrays' numbers as they are and twice by lot."""
    program, numbers = of_numbers(function, arrays)
    draw, ends = np.random.default_rng(1), np.cumsum([array.size for array in arrays])[:-1]
    rows = np.stack([numbers, *(draw.permutation(numbers) for _ in range(2))])
    found = Kernel(program, program.inputs)({}, rows)
    for row, each in zip(rows, found, strict=True):
        given = [np.reshape(part, array.shape) for part, array in zip(np.split(row, ends), arrays, strict=True)]
        with np.errstate(all="ignore"):
            expected = np.ravel(np.asarray(function(*given), dtype=float))
        yield each, expected


@pytest.mark.parametrize("name", CASES)
def test_a_row_of_the_table_at_awkward_numbers(name):
    function, arrays = CASES[name]
    for found, expected in compare(function, arrays):
        assert_array_equal(found, expected)


@pytest.mark.parametrize("seed", range(40))
def test_an_expression_at_random(seed):
    for found, expected in compare(expression(seed), [np.asarray(value) for value in INPUTS.values()]):
        assert_array_equal(found, expected)


@pytest.mark.parametrize("seed", range(40))
def test_an_expression_at_random_whose_arms_are_all_left_out_where_none_needs_them(seed, monkeypatch):
    monkeypatch.setattr(needed, "WORTH", 1)
    for found, expected in compare(expression(seed), [np.asarray(value) for value in INPUTS.values()]):
        assert_array_equal(found, expected)


def seldom(x, y):
    """A curve that is looked at closely if one number asks for it, still more closely if another does."""
    row, near, far = np.arange(200.0), x > 1, y < -1
    closely = np.cumsum(np.sin(x * row), axis=-1)
    best = np.argmax(closely, axis=-1)[..., None]
    top = np.take_along_axis(closely, best, -1)
    once_more = np.sort(np.cos(y * row[:9] + top), axis=-1)[..., 4:5] + (closely / (y + row)).sum(-1, keepdims=True)
    inner = np.where(far, once_more, top)
    steps = np.where(top * row > y, top, y)
    each = np.where(x * row > 300, steps + closely[..., :1], x)
    return {
        "nested": np.where(near, inner, y)[..., 0],
        "shared": np.where(far, np.sqrt(closely).sum(-1, keepdims=True), x)[..., 0],
        "else": np.where(np.isnan(x) | ~near, x, (np.exp(closely) * each).max(-1, keepdims=True))[..., 0],
        "row": np.where(np.stack([x, y], axis=-1)[..., 0, :] > 2, np.log1p(row * x).sum(-1, keepdims=True), y)[..., 1],
    }


@pytest.mark.parametrize("worth", [1, 100, 10**9])
def test_what_some_designs_alone_need_is_there_for_them(worth, monkeypatch):
    monkeypatch.setattr(needed, "WORTH", worth)
    made, machine_code = [], compiler.machine_code
    monkeypatch.setattr(compiler, "machine_code", lambda text: made.append(text) or machine_code(text))
    program = recorded(lambda given: seldom(*(np.reshape(x, (1,)) for x in given.values())), {"x": 0.5, "y": 0.5})
    found = Kernel(program, ["x", "y"])
    draw = np.random.default_rng(4)
    x = np.vstack([draw.normal(size=(2000, 2)) * scale for scale in (0.2, 1, 3)])
    x = np.vstack([x, np.repeat(draw.normal(size=(100, 2)) * 3, 8, axis=0), np.full((9, 2), np.nan), x[:200]])
    with np.errstate(all="ignore"):
        expected = np.stack([*seldom(x[:, :1], x[:, 1:]).values()], axis=-1)
    assert_array_equal(found({}, x), expected)
    assert ("label %needed" in made[-1]) == (worth < 10**9)


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_a_study_says_what_numpy_says(name):
    study = STUDIES[name]
    values = designs_beside(study.start, DESIGNS, 3)

    def measured(design, p=1):
        analysis = study.analysis_of(design)
        return {str(i): measure.of(analysis, p) for i, measure in enumerate(study.measures)}

    with np.errstate(all="ignore"):
        expected = np.stack([*measured(with_quantities(study.start, values), DESIGNS).values()], axis=-1)
    found = Kernel(record(measured, study.start), [*values])({}, np.hstack([*values.values()]))
    assert np.isfinite(expected).all(-1).mean() > 0.02
    assert_array_equal(found, expected)


@pytest.mark.slow
@pytest.mark.parametrize(("place", "law"), [*enumerate(LAWS)])
def test_a_cam_with_any_law_and_follower(place, law):
    cam = with_law(CAMS[place % len(CAMS)], LAWS[law])
    values = designs_beside(cam, DESIGNS, 1)
    with np.errstate(all="ignore"):
        expected = curves(with_quantities(cam, values))
    shapes = {name: np.shape(value) for name, value in curves(cam).items()}
    found = Kernel(record(curves, cam), [*values])({}, np.hstack([*values.values()]))
    ends = np.cumsum([int(np.prod(shape)) for shape in shapes.values()])
    for (name, shape), column in zip(shapes.items(), np.split(found, ends[:-1], axis=1), strict=True):
        rows = np.moveaxis(column.reshape(DESIGNS, *shape), 0, -2 if shape else -1)
        value = np.broadcast_to(expected[name].reshape(DESIGNS) if not shape else expected[name], rows.shape)
        assert_array_equal(rows, value, name)


@pytest.mark.parametrize("own", [True, False])
@pytest.mark.parametrize("function", [np.sin, np.cos])
def test_sine_and_cosine_are_numpys_to_the_last_bit_by_either_way(own, function, monkeypatch):
    if not trial.own_circle() and own:
        pytest.skip("numpy has them from elsewhere")
    monkeypatch.setattr(kernel, "own_circle", lambda: own)
    circle = Kernel(recorded(lambda given: {"y": function(given["x"])}, {"x": 1.0}), ["x"])
    sizes = 10.0 ** np.random.default_rng(2).uniform(-20, 20, 50_000)
    x = np.concatenate([trial.angles()[1:], np.random.default_rng(3).uniform(-8, 8, 200_000), sizes, -sizes])
    assert_array_equal(circle({}, x[:, None])[:, 0], function(x))


def test_another_sine_is_not_taken(monkeypatch):
    trial.own_circle.cache_clear()
    monkeypatch.setattr(trial.np, "sin", lambda x: np.nextafter(np.cos(x - np.pi / 2), 1))
    assert not trial.own_circle()
    trial.own_circle.cache_clear()


@pytest.mark.parametrize("exponent", [2.0, 0.5, -1.0, 1.0, 0.0, 3.0, -0.5, 2.5])
def test_a_power_is_numpys_whether_its_exponent_is_one_or_many(exponent):
    x = np.abs(np.random.default_rng(1).normal(size=(500, 1)))
    row = np.array([exponent, 2.0, exponent, 0.5])
    ways = {"one": lambda x, e: x**exponent, "given": lambda x, e: x**e, "row": lambda x, e: x**row}
    program = recorded(lambda given: {n: way(**given) for n, way in ways.items()}, {"x": 1.5, "e": exponent})
    found = Kernel(program, ["x"])({"e": exponent}, x)
    assert_array_equal(found, np.hstack([way(x, exponent) for way in ways.values()]))


@pytest.mark.parametrize("n", [1, 2, 7, 8, 9, 15, 16, 100, 128, 129, 136, 137, 300, 1000])
def test_a_sum_is_added_in_numpys_order(n):
    row, x = np.random.default_rng(n).normal(size=n), np.random.default_rng(1).normal(size=(40, 1))
    ways = {
        "along": lambda x: (row * x).sum(-1),
        "mean": lambda x: np.mean(row * x, axis=-1),
        "trapezoid": lambda x: np.trapezoid(row * x, axis=-1) if n > 1 else 0 * x.sum(-1),
    }
    program = recorded(lambda given: {name: way(np.stack([given["x"]])) for name, way in ways.items()}, {"x": 1.5})
    found = Kernel(program, ["x"])({}, x)
    assert_array_equal(found, np.stack([way(x) for way in ways.values()], axis=-1))


def product(value=3.0):
    return recorded(lambda given: {"area": given["x"] * given["y"] + value, "side": given["y"]}, {"x": 1.0, "y": 1.0})


def files(cache):
    return sorted(cache.iterdir())


def test_code_is_made_once_for_each_program(cache, monkeypatch):
    found = Kernel(product(), ["x"])({"y": 5.0}, np.array([[2.0]]))
    assert found.tolist() == [[13.0, 5.0]]
    (file,) = files(cache)
    before = file.stat().st_mtime_ns
    monkeypatch.setattr(kernel, "code_of", None)  # now it cannot be made
    assert Kernel(product(), ["x"])({"y": 7.0}, np.array([[2.0]])).tolist() == [[17.0, 7.0]]
    assert files(cache)[0].stat().st_mtime_ns == before
    for program, inputs in ((product(4.0), ["x"]), (product(), ["y"]), (product(), ["y", "x"])):
        with pytest.raises(TypeError):
            Kernel(program, inputs)


@pytest.mark.parametrize("harm", [lambda b: b[:-1], lambda b: b"", lambda b: b[:40] + b"x" + b[41:], lambda b: b[:32]])
def test_a_damaged_file_is_written_anew(cache, harm):
    Kernel(product(), ["x"])
    (file,) = files(cache)
    whole = file.read_bytes()
    file.write_bytes(harm(whole))
    assert Kernel(product(), ["x"])({"y": 5.0}, np.array([[2.0]])).tolist() == [[13.0, 5.0]]
    assert stored.read(file.name) is not None
    assert len(files(cache)) == 1


def test_code_of_another_processor_or_another_version_is_not_taken(cache, monkeypatch):
    Kernel(product(), ["x"])
    for what in ("processor", "code"):
        if what == "processor":
            monkeypatch.setattr(compiler, "processor", lambda: "another")
        else:
            monkeypatch.setattr(stored, "_of_this_code", lambda: "another")
        before = len(files(cache))
        Kernel(product(), ["x"])
        assert len(files(cache)) == before + 1


def test_the_cache_keeps_what_was_last_made(cache, monkeypatch):
    monkeypatch.setattr(stored, "MOST", 3)
    for value in range(6):
        Kernel(product(float(value)), ["x"])
    assert len(files(cache)) == 3


def test_a_cache_that_cannot_be_written_to_is_none(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path / "file" / "below"))
    assert Kernel(product(), ["x"])({"y": 5.0}, np.array([[2.0]])).tolist() == [[13.0, 5.0]]


@pytest.mark.parametrize("rows", [0, 1, 7, 8, 9, 255, 257, 5000])
def test_any_number_of_designs_whoever_shares_them(rows, monkeypatch):
    monkeypatch.setattr(kernel, "threads", lambda: 2)
    program = recorded(lambda given: {"sum": np.sum(np.sin(given["x"] * np.arange(50.0)))}, {"x": 1.0})
    x = np.random.default_rng(rows).normal(size=(rows, 1))
    found = Kernel(program, ["x"])({}, x)
    assert found.shape == (rows, 1)
    assert_array_equal(found[:, 0], np.sin(x * np.arange(50.0)).sum(-1))
    one_by_one = [Kernel(program, ["x"])({}, row[None])[0] for row in x[:3]]
    assert_array_equal(found[:3], np.reshape(one_by_one, (-1, 1)))


def test_what_no_input_changes_is_as_numpy_says():
    program = recorded(lambda given: {"a": np.cumsum(given["y"] * np.arange(3.0)), "b": 2.0}, {"x": 1.0, "y": 1.0})
    assert Kernel(program, ["x"])({"y": 3.0}, np.zeros((2, 1))).tolist() == [[0.0, 3.0, 9.0, 2.0]] * 2


def test_no_flag_lets_llvm_change_a_digit(monkeypatch):
    texts = []
    monkeypatch.setattr(compiler, "machine_code", lambda text: texts.append(text) or b"")
    program, _ = of_numbers(expression(4), [np.asarray(value) for value in INPUTS.values()])
    kernel.code_of(program, program.inputs)
    flags = "fast|nnan|ninf|nsz|arcp|contract|afn|reassoc"
    assert not re.search(rf"\b({flags})\b", texts[0].replace("fastcc", ""))


def area():
    return Kernel(recorded(lambda given: {"out": given["a"] * given["b"]}, {"a": 2.0, "b": 3.0}), ["a"])


def test_whole_numbers_are_numbers():
    assert area()({"b": 5.0}, np.array([[4], [6]])).tolist() == [[20.0], [30.0]]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system that does not fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_has_threads_of_its_own(monkeypatch):
    monkeypatch.setattr(kernel, "threads", lambda: 2)
    kernel_of, x = area(), np.ones((2 * kernel.SHARED, 1))
    kernel_of({"b": 5.0}, x)
    child = os.fork()
    if not child:
        signal.alarm(20)
        os._exit(int((kernel_of({"b": 5.0}, x) != 5).any()))
    assert os.waitpid(child, 0)[1] == 0
