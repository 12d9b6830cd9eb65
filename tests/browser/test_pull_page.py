"""A limit's chip or the peak of a curve is dragged, and the free sliders follow by least change within the limits."""

import re

import nbformat
import pytest

from camkit import TranslatingRollerCam, deg
from camkit.cam import max_pressure_angle, min_profile_radius
from lab import Instrument, eventually, kernel_value, open_notebook, run_all

CELL = """
from camkit import TranslatingRollerCam, deg, explore, mm
from camkit.cam import max_pressure_angle, min_profile_radius
app = explore(TranslatingRollerCam(groove=False), free=["base_radius", "roller_radius", "offset"],
              measures=[max_pressure_angle, min_profile_radius],
              at_most={max_pressure_angle: 30 * deg}, at_least={min_profile_radius: 5 * mm})
app
"""
ANGLE = "max_pressure_angle.one(app.analysis) / deg"


def drag(page, x, y, dx, dy):
    page.mouse.move(x, y)
    page.mouse.down()
    for part in (0.3, 0.7, 1):
        page.mouse.move(x + part * dx, y + part * dy)
    said = page.locator(".camkit-tip").inner_text()
    page.mouse.up()
    return said


def test_chips_and_peaks_are_pulled_and_the_sliders_follow(page, server):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "pull.ipynb")
    open_notebook(page, "pull.ipynb")
    run_all(page)
    app, start = Instrument(page), TranslatingRollerCam(groove=False)
    chip = app.root.locator(".camkit-chip", has_text="maximum pressure angle")
    before = max_pressure_angle.one(start.analyse()) / deg
    pull_chip(page, chip, 25, 1.1 * before)
    assert kernel_value(page, "app.design.base_radius") < start.base_radius
    app.root.get_by_role("button", name="Undo").click()  # one step
    app.shows(start, [max_pressure_angle, min_profile_radius])
    pull_peak(page, app, 12)
    app.reset()
    app.shows(start, [max_pressure_angle, min_profile_radius])
    box = chip.bounding_box()
    drag(page, box["x"] + 30, box["y"] + box["height"] / 2, 150, 0)
    note = app.root.locator(".camkit-note")
    note.wait_for()
    assert "the highest found is 30 deg; it is held by its own limit" in note.inner_text()
    assert kernel_value(page, ANGLE) == pytest.approx(30, rel=1e-3)
    app.reset()
    app.shows(start, [max_pressure_angle, min_profile_radius])
    chip.focus()
    page.keyboard.press("ArrowLeft")
    eventually(lambda: kernel_value(page, ANGLE) == pytest.approx(0.99 * before, rel=1e-5))
    chip.click()  # a click is still a click
    app.root.locator(".camkit-ring").first.wait_for()


def pull_chip(page, chip, by, wanted):
    box = chip.bounding_box()
    said = drag(page, box["x"] + 30, box["y"] + box["height"] / 2, by, 0)
    assert f"{wanted:.4g}" in said
    eventually(lambda: kernel_value(page, ANGLE) == pytest.approx(wanted, rel=1e-5))


def pull_peak(page, app, down):
    peak = app.root.get_by_role("slider", name="maximum pressure angle, peak of the curve")
    peak.wait_for()
    peak.scroll_into_view_if_needed()
    box = peak.bounding_box()
    said = drag(page, box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 0, down)
    wanted = float(re.search(r": ([\d.]+)", said)[1])
    eventually(lambda: kernel_value(page, ANGLE) == pytest.approx(wanted, rel=1e-3))
    peak.wait_for()
