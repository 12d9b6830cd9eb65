"""From sliders to a robust choice, in notebook 18 and without code: the front survives being made."""

import re

import pytest
from playwright.sync_api import expect

from lab import Instrument, eventually, kernel_value, open_notebook, run_all


def test_from_sliders_to_a_design_that_survives_being_made(page, server):
    page.set_viewport_size({"width": 1366, "height": 768})
    open_notebook(page, "18_your_own_cam.ipynb")
    run_all(page)
    app = Instrument(page)
    chip = app.root.locator(".camkit-chips .camkit-chip").first
    expect(chip).to_have_text(re.compile(r"yield 99\.\d % \(99\.\d to "))
    app.type("spring preload, N", "20")
    expect(chip).to_have_class(re.compile("camkit-bad"))
    eventually(lambda: float(re.search(r"yield ([\d.]+) %", chip.inner_text())[1]) < 99)

    page.get_by_role("tab", name="Study").click()
    dock = page.locator(".camkit-dock:visible")
    dock.get_by_label("made within tolerances").check()
    dock.get_by_role("button", name="Find", exact=True).click()
    page.get_by_role("tab", name="Live front", selected=True).wait_for()
    sheet = page.locator(".camkit-sheet").filter(has_text="choose by").and_(page.locator(":visible")).first
    expect(sheet).to_contain_text("by exact parts", timeout=60_000)
    sheet.get_by_role("button", name="Load the winner").click()
    expect(chip).to_have_text(re.compile(r"yield (99\.\d|100\.0) % \(99\.\d to "), timeout=30_000)
    expect(chip).to_have_class(re.compile("camkit-ok"))
    said = kernel_value(
        page, "study.around(app.design).under(tolerances).recheck(study.around(app.design).x0).share[0]"
    )
    assert said >= 0.99
    shown = float(re.search(r"yield ([\d.]+) %", chip.inner_text())[1])
    assert shown == pytest.approx(100 * said, abs=0.051)
