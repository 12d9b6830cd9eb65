"""Round numbers along the axes of the page's pictures."""

from pathlib import Path

import pytest

import camkit.render

SOURCE = Path(camkit.render.__file__).parent / "page/scales.js"
CALL = """([source, ends]) => import(URL.createObjectURL(new Blob([source], {type: "text/javascript"})))
    .then(scales => scales.logTicks(...ends))"""


@pytest.fixture(scope="module")
def page(browser):
    page = browser.new_page()
    yield page
    page.close()


@pytest.mark.parametrize("ends", [(-29, 31, 1.1), (-7, 3, 0.4), (0.9, 4.2, 1), (-1e-9, 1e-9, 1)])
def test_an_axis_has_two_ticks_at_least(page, ends):
    marks = page.evaluate(CALL.replace("logTicks", "ticks"), [SOURCE.read_text(encoding="utf-8"), ends])
    assert len(marks) >= 2
    assert all(ends[0] <= mark <= ends[1] for mark in marks)


@pytest.mark.parametrize(
    ("ends", "marks"),
    [
        ((1, 87, 8), [1, 2, 5, 10, 20, 50]),
        ((1, 1000, 8), [1, 10, 100, 1000]),
        ((1, 1000, 10), [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]),
        ((1e-5, 1e3, 4), [1e-5, 1e-2, 10]),
        ((3, 7, 4), [3, 4, 5, 6, 7]),
        ((0.3, 0.3, 4), []),
    ],
)
def test_logarithmic_scales_have_ticks_at_round_numbers(page, ends, marks):
    assert page.evaluate(CALL, [SOURCE.read_text(encoding="utf-8"), ends]) == pytest.approx(marks, rel=1e-12)
