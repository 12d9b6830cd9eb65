"""The high-speed cam's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from camkit import deg, mm
from camkit.machines.cam_lever import CamLever, lever_stress
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_load import ConstantTorque
from camkit.machines.high_speed_measures import GEOMETRY, HIGH_SPEED_MEASURES, high_speed_study, peak_stress, peak_wear
from camkit.motion import ShapedLaw
from camkit.quantities import quantities_of
from camkit.search.minimise import minimise
from lab import OWN_SHEETS, Instrument, eventually, kernel_value, on_page, open_notebook, run_all

START = HighSpeedCam()
SHAPED = ShapedLaw(c=(0.0, -0.15, 0.0, 0.0))


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its panels."""

    page: Page
    app: Instrument
    better: Locator
    faster: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)


@pytest.fixture(scope="module")
def book(window: Page) -> Workbook:
    open_notebook(window, "06_high_speed_cam.ipynb")
    run_all(window)
    panels = window.locator(OWN_SHEETS)
    optimise = panels.filter(has=window.get_by_role("button", name="Optimise from here"))
    shorten = panels.filter(has=window.get_by_role("button", name="Shorten the cycle"))
    return Workbook(window, Instrument(window), optimise.first, shorten.first)


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    book.app.reset()
    book.app.shows(START, HIGH_SPEED_MEASURES)


def test_sliders_coefficients_and_the_load_case_change_all_that_follows(book: Workbook) -> None:
    slider = book.app.slider("roller radius, mm")
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    r = book.app.shown()["values"][list(quantities_of(START)).index("roller_radius")]
    assert r > 30 * mm
    cam = START.replace(roller_radius=r)
    book.app.shows(cam, HIGH_SPEED_MEASURES)
    book.app.type("rise shape 2", "-0.15")
    book.app.shows(cam.replace(rise_law=SHAPED), HIGH_SPEED_MEASURES)
    book.app.choose("constant torque")
    book.app.shows(cam.replace(rise_law=SHAPED, load=ConstantTorque()), HIGH_SPEED_MEASURES)


def test_optimise_from_here_improves_and_says_why_it_stopped(book: Workbook) -> None:
    menus = book.better.locator("select")
    menus.nth(0).select_option(label="wear: sizes")
    book.better.get_by_role("button", name="Optimise from here").click()
    best = minimise(high_speed_study(objective=peak_wear))
    first = peak_wear.text(float(best.study.evaluate([best.study.x0]).f[0, 0]))
    expect(book.better).to_contain_text(on_page(f"wear index: {first} → {peak_wear.text(best.f)}"))
    expect(book.better).to_contain_text("Converged: no small change lowers it further")
    expect(book.better).to_contain_text("radius at the far dwell 140 mm (upper bound)")
    found = book.value("[app.design.arm_length, app.design.roller_radius, app.design.max_radius]")
    np.testing.assert_allclose(found, [getattr(best.design, name) for name in GEOMETRY], rtol=1e-4)
    assert book.value("float(app.measures[1](app.analysis))") < 0.6 * float(peak_wear(START.analyse()))
    book.better.get_by_role("button", name="Undo").click()
    book.app.shows(START, HIGH_SPEED_MEASURES)


def test_a_long_search_can_be_stopped_and_keeps_the_best(book: Workbook) -> None:
    menus = book.better.locator("select")
    menus.nth(0).select_option(label="stress index: sizes and laws")
    menus.nth(1).select_option(label="de")
    book.better.get_by_role("button", name="Optimise from here").click()
    expect(book.better).to_contain_text(re.compile(r"\d+ designs evaluated, best so far"))
    book.better.get_by_role("button", name="Stop").click()
    expect(book.better).to_contain_text(re.compile(r"The search was stopped after \d+ designs"))
    assert book.value("float(app.measures[0](app.analysis))") <= float(peak_stress(START.analyse())) * 1.001


def test_the_cycle_time_search_can_be_stopped(book: Workbook) -> None:
    run = book.faster.get_by_role("button", name="Shorten the cycle")
    run.click()
    book.faster.get_by_role("button", name="Stop").click()
    expect(book.faster).to_contain_text("(stopped)")
    expect(run).to_be_enabled()
    stopped = book.value("len(faster.steps)")
    run.click()
    expect(book.faster).to_contain_text(
        re.compile(r"An interval of [\d.]+ (?:deg|°) keeps .* % more output"), timeout=120_000
    )
    expect(run).to_be_enabled(timeout=120_000)
    assert book.value("len(faster.steps)") > stopped
    book.faster.get_by_role("button", name="Load the design").click()
    phi = book.value("faster.step.high")
    eventually(lambda: book.value("press_app.design.rise_angle") == pytest.approx(phi))
    assert 40 * deg < phi < 54 * deg
    assert book.value("float(press_app.measures[0](press_app.analysis))") < float(lever_stress(CamLever().analyse()))
