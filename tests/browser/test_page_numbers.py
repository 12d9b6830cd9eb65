"""Numbers in the page: written as Python's ``format`` does, and read as the kernel does where it takes a text."""

import json
import unicodedata
from fractions import Fraction
from math import inf, nan
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import camkit.render
from camkit import Measure
from camkit.program.texts import filled
from camkit.units import factor, known_units
from camkit.units.typed import typed_number

SOURCE = Path(camkit.render.__file__).parent / "page/numbers.js"
CASES = json.loads((Path(__file__).parents[1] / "data/page/numbers.json").read_text(encoding="utf-8"))
UNITS = ["mm", "deg", "", "N/mm", "rad/s", "N m", "mm/rad^2", "%", "kg m^2", "N^0.5 mm^-0.5", "in", "lbf/in", "deg/s"]
OPEN = """([source, units]) => import(URL.createObjectURL(new Blob([source], {type: "text/javascript"})))
    .then(numbers => Object.assign(window, numbers, {read: (text, unit) => numbers.parse(text, unit, units)}))"""
CALL = "([name, calls]) => calls.map(given => window[name](...given))"

batches = settings(max_examples=5, deadline=None, phases=set(Phase) - {Phase.shrink})  # each of some hundred


@pytest.fixture(scope="module")
def call(browser):
    """What a function of the module gives for each of many lists of arguments."""
    page = browser.new_page()
    page.evaluate(OPEN, [SOURCE.read_text(encoding="utf-8"), known_units()])
    yield lambda name, calls: page.evaluate(CALL, [name, [list(one) for one in calls]])
    page.close()


def of_kernel(text, unit):
    try:
        return typed_number(text, unit)
    except ValueError:
        return None


def many(examples):
    return st.lists(examples, min_size=150, max_size=200)


def test_numbers_are_written_as_in_the_table_and_as_by_python(call):
    table = [(float(value), spec) for value, spec, _ in CASES["format"]]
    assert call("format", table) == [text for *_, text in CASES["format"]] == [format(v, spec) for v, spec in table]


def test_measures_are_written_as_in_the_table_and_as_by_the_kernel(call):
    values = [float(value) for value, _ in CASES["measure"]]
    expected = [text for _, text in CASES["measure"]]
    assert call("format", [(value, "measure") for value in values]) == expected
    assert [Measure("height", "", id).text(value) for value in values] == expected


@pytest.mark.parametrize("spec", [".4g", ".1f", "~.3g", "~.6g", "~.10g", "~measure"])
def test_a_sentence_is_filled_as_a_program_fills_it(call, spec):
    values = [0.1 + 0.2, 2.675000000000001, 12345.67, -1e-7, 0.0, -0.0, 1e300, nan, inf, -inf]
    template = ("it is ", (0, spec), (1, (" mm, and ", (0, ".3g"))), ".")
    for holds in (1.0, 0.0):
        expected = [filled(template, {0: value, 1: holds}) for value in values]
        assert call("fill", [(template, [[value], [holds]]) for value in values]) == expected


def test_a_way_to_write_numbers_that_the_page_does_not_know_is_an_error(call):
    for spec in ("", "d", ".3", "8.3f", "z.1f", "x"):
        with pytest.raises(Exception, match="no number is written as"):
            call("format", [(1.0, spec)])


floats = st.floats() | st.floats(-1e7, 1e7)
between = st.builds(
    lambda x, k: (float(10 * x + 5) * 10**k, f".{len(str(x))}g"), st.integers(1, 9999), st.integers(0, 15)
)
between |= st.builds(lambda x, n: ((2 * x + 1) / 2 ** (n + 1), f".{n}f"), st.integers(-999, 999), st.integers(0, 12))
specs = st.builds("{}{}{}{}".format, st.sampled_from(["", "+"]), st.sampled_from(["", "", ","]),
                  st.sampled_from(["", *(f".{n}" for n in range(18))]), st.sampled_from("efg%"))  # fmt: skip


def test_any_number_is_written_as_by_python(call):
    @given(many(st.tuples(floats, specs) | between))
    @batches
    def same(cases):
        assert call("format", cases) == [format(value, spec) for value, spec in cases]

    same()


def test_any_measure_is_written_as_by_the_kernel(call):
    @given(many(st.tuples(floats, st.sampled_from(UNITS))))
    @batches
    def same(cases):
        found = call("format", [(value / factor(unit), "measure") for value, unit in cases])
        assert [f"{text} {unit}".rstrip() for text, (_, unit) in zip(found, cases, strict=True)] == [
            Measure("height", unit, id).text(value) for value, unit in cases
        ]

    same()


def test_sentences_are_filled_in_as_in_the_table(call):
    numbers = [[[float(x) for x in output] for output in outputs] for _, outputs, _ in CASES["fill"]]
    cases = [(parts, outputs) for (parts, *_), outputs in zip(CASES["fill"], numbers, strict=True)]
    assert call("fill", cases) == [text for *_, text in CASES["fill"]]


def test_typed_numbers_are_taken_as_in_the_table(call):
    found = call("read", [case[:2] for case in CASES["taken"]])
    for (text, unit, meant), read in zip(CASES["taken"], found, strict=True):
        assert read == {"value": pytest.approx(meant, rel=1e-14)}, (text, unit)


def test_other_texts_are_refused_in_the_table_s_sentences(call):
    found = call("read", [case[:2] for case in CASES["refused"]])
    assert found == [{"error": said} for *_, said in CASES["refused"]]


def test_the_kernel_reads_no_other_number_than_the_table():
    for text, unit, meant in CASES["taken"]:
        assert of_kernel(text, unit) in (None, pytest.approx(meant, rel=1e-14)), text
    assert [of_kernel(text, unit) for text, unit, _ in CASES["refused"]] == [None] * len(CASES["refused"])


words = st.text("0123456789.,eE+-−*/×^ \u00a0°%µmindegrskNPa·()", max_size=12)
decimals = st.builds(
    "{}{}{}{}{}".format, st.sampled_from(["", "", "-", "+", "−"]), st.integers(0, 99999), st.sampled_from(",."),
    st.sampled_from(["", "0", "5", "09", "125", "00001"]), st.sampled_from(["", "", "", "e3", "E-2", "e+300", "e-310"]),
)  # fmt: skip
with_units = st.builds(
    "{}{}{}".format, decimals, st.sampled_from(["", " ", "  "]), st.sampled_from([*known_units(), *UNITS])
)


def test_any_text_is_read_as_by_the_kernel_where_the_kernel_takes_it(call):
    taken = 0

    @given(many(st.tuples(words | decimals | with_units, st.sampled_from(UNITS))))
    @batches
    def same(cases):
        nonlocal taken
        for (text, unit), read in zip(cases, call("read", cases), strict=True):
            expected = of_kernel(text, unit)
            if expected is not None:
                taken += 1
                assert read == {"value": pytest.approx(expected, rel=1e-14, abs=0)}, (text, unit)
            elif not any(sign in text for sign in "*/×"):
                assert list(read) == ["error"], (text, unit)

    same()
    assert taken > 100


plain = st.integers(1, 999).map(str) | st.decimals("0.01", 99, places=2).map(str)
products = st.lists(st.tuples(st.sampled_from(["*", "/", " * ", " × "]), plain), min_size=1, max_size=3)


def test_products_and_fractions_are_worked_out_from_left_to_right(call):
    @given(many(st.tuples(plain, products)))
    @batches
    def same(cases):
        texts = [first + "".join(sign + number for sign, number in others) for first, others in cases]
        for (first, others), read in zip(cases, call("read", [(text, "mm") for text in texts]), strict=True):
            value = Fraction(first)
            for sign, number in others:
                value = value / Fraction(number) if sign == "/" else value * Fraction(number)
            assert read == {"value": pytest.approx(float(value), rel=1e-15)}

    same()


def test_whole_numbers_with_a_fraction_are_added_up(call):
    @given(many(st.tuples(st.integers(0, 999), st.integers(0, 63), st.integers(1, 64))))
    @batches
    def same(cases):
        found = call("read", [(f"{whole} {above}/{below} in", "in") for whole, above, below in cases])
        for (whole, above, below), read in zip(cases, found, strict=True):
            if above < below:
                assert read == {"value": pytest.approx(float(whole + Fraction(above, below)), rel=1e-15)}
            else:
                assert "is no number" in read["error"]

    same()


signs = st.sampled_from([chr(sign) for sign in (0xBC, 0xBD, 0xBE, *range(0x2150, 0x215F))])


def test_small_fractions_and_inch_marks_are_read_as_they_are_meant(call):
    @given(many(st.tuples(st.integers(0, 999).map(str) | st.just(""), st.sampled_from(["", " "]), signs)))
    @batches
    def same(cases):
        found = call("read", [(f'{whole}{gap if whole else ""}{sign}"', "in") for whole, gap, sign in cases])
        for (whole, _, sign), read in zip(cases, found, strict=True):
            value = int(whole or 0) + Fraction(unicodedata.normalize("NFKD", sign).replace("\u2044", "/"))
            assert read == {"value": pytest.approx(float(value), rel=1e-15)}

    same()


def test_units_and_symbols_are_shown_as_in_the_table(call):
    for name in ("pretty", "letters"):
        assert call(name, [(text,) for text, _ in CASES[name]]) == [shown for _, shown in CASES[name]]


def test_a_unit_as_it_is_shown_may_be_typed(call):
    shown = call("pretty", [(unit,) for unit in UNITS])
    assert not any(set("^_*") & set(unit) for unit in shown)
    assert call("read", [(f"7 {unit}", own) for unit, own in zip(shown, UNITS, strict=True)]) == [{"value": 7}] * len(
        UNITS
    )


def test_the_page_knows_every_unit_by_its_name(call):
    found = call("read", [(f"3 {name}", name) for name in known_units()])
    assert found == [{"value": 3}] * len(known_units())
