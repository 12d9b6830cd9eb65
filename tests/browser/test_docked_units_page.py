"""Sheets in tabs of an instrument show their numbers in its units, and take what is typed in them."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

from camkit import inch, mm
from camkit.units import convert
from test_sheet_sizes import STUDY, decision, editor, instrument, tolerances

LIVE = """() => { for (const sheet of camkit.sheets) {
    Object.assign(sheet.model, { stored: false, send: (message) => { (globalThis.sent ??= []).push(message); } });
    sheet.root.classList.remove("camkit-stored"); sheet._sendNext(); } }"""


@pytest.fixture(scope="module")
def sheets():
    app = instrument()
    found = {"Tolerances": tolerances(), "Decision": decision(), "Motion": editor()}
    found["Search"] = found["Decision"].source
    for name, sheet in found.items():
        app.add_tab(name, sheet)
    return app, found


@pytest.fixture
def page(browser, sheets, tmp_path):
    """The instrument as a file whose sheets say what is done with them, in inches, radians and pounds."""
    app, _ = sheets
    (tmp_path / "cam.html").write_text(app.html(), encoding="utf-8")
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.goto((tmp_path / "cam.html").as_uri())
    page.wait_for_function("() => globalThis.camkit?.outputs && camkit.sheets.length === 4")
    page.evaluate(LIVE)
    page.get_by_label("units", exact=True).select_option("inch, rad, lbf")
    yield page
    page.close()


def said(page):
    return page.evaluate("() => sent.at(-1)")


def show(page, tab):
    page.get_by_role("tab", name=tab).click()
    page.wait_for_function("() => camkit.sheets.every((sheet) => !sheet.frame)")


def test_tables_and_pictures_have_the_units_of_the_instrument(page, sheets):
    panel = sheets[1]["Tolerances"]
    show(page, "Tolerances")
    cells = [[*row.locator("td").all_inner_texts()] for row in page.locator("tbody tr:visible").all()]
    seen = set()
    for (name, *row), (measure, *own) in zip(cells, panel._rows(), strict=True):
        assert name == measure
        for text, before in zip(row, own, strict=True):
            number, _, unit = before.partition(" ")
            shown = {"mm": "inch", "deg": "rad", "N": "lbf", "N mm": "lbf inch"}.get(unit)
            if shown and number != "nan":
                seen.add(unit)
                assert text.endswith(shown)
                assert float(text.split()[0]) == pytest.approx(convert(float(number), unit, shown), rel=2e-3)
            else:
                assert text == before
    assert {"mm", "deg"} <= seen
    force = next(k for k, view in enumerate(panel.bands.shown) if view.axes.title == "Contact force")
    drawn = page.evaluate(f"() => camkit.sheets[0].shown().pictures[{2 + force}].marks[0]")
    mark = panel.bands.shown[force].marks[0]
    for part in ("x", "low", "high", "y"):
        if drawn.get(part) is not None:
            found, own = (
                (np.ravel([*drawn[part].values()] if isinstance(drawn[part], dict) else drawn[part])),
                getattr(mark, part),
            )
            ratio = convert(1, "deg", "rad") if part == "x" else convert(1, "N", "lbf")
            assert found == pytest.approx(ratio * np.ravel(own), rel=1e-9)


def test_what_is_typed_counts_in_the_units_of_the_instrument(page, sheets):
    show(page, "Tolerances")
    box = page.get_by_label("lift arm, inch, number", exact=True).last
    box.fill("0.02")
    box.press("Enter")
    assert said(page)["value"] == pytest.approx(0.02 * inch, rel=1e-12)
    box.fill("0.4 mm")
    box.press("Enter")
    page.evaluate("() => { for (const sheet of camkit.sheets) { sheet.answered = sheet.asked; sheet._sendNext(); } }")
    assert said(page)["value"] == pytest.approx(0.4 * mm, rel=1e-12)
    show(page, "Motion")
    lift = page.get_by_label("lift, inch", exact=True).first
    expect(lift).to_have_value(re.compile(r"0\.7874"))
    lift.fill("1")
    lift.press("Enter")
    assert said(page)["value"] == pytest.approx(25.4, rel=1e-9)  # the box is declared in mm
    show(page, "Search")
    bound = page.get_by_label(re.compile("lift arm.*inch")).locator("visible=true").last
    low, high = STUDY.bounds[0][0], STUDY.bounds[1][0]
    assert float(bound.input_value()) == pytest.approx(high / inch, rel=1e-5) or low
    bound.fill("2")
    bound.press("Enter")
    assert said(page)["value"] == pytest.approx(50.8, rel=1e-9)


def test_a_band_and_the_axes_of_designs_follow(page):
    show(page, "Decision")
    page.get_by_label("keep of the").evaluate("menu => menu.value")
    words = page.evaluate("() => camkit.sheets[1].shown().pictures[1].marks.map((mark) => mark.words).filter(Boolean)")
    assert any(text.endswith(" inch") for text in words)
    assert not any(text.endswith(" mm") for text in words)
    page.get_by_label("units", exact=True).select_option("mm, deg, N")
    page.wait_for_function("() => camkit.sheets.every((sheet) => !sheet.frame)")
    words = page.evaluate("() => camkit.sheets[1].shown().pictures[1].marks.map((mark) => mark.words).filter(Boolean)")
    assert any(text.endswith(" mm") for text in words)
