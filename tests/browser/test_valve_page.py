"""The valve cam's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from camkit import mm
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import (
    VALVE_MEASURES,
    keeping_min_radius,
    valve_study,
)
from camkit.machines.valve_train import ROLLER
from camkit.quantities import quantities_of
from camkit.search.minimise import minimise
from lab import Instrument, eventually, in_picture, kernel_value, open_notebook, run_all

START = ValveCam()


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and two of its panels."""

    page: Page
    bench: Locator
    plane: Locator
    app: Instrument

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)


@pytest.fixture(scope="module")
def book(window: Page) -> Workbook:
    open_notebook(window, "08_valve_cam.ipynb")
    run_all(window)
    panels = window.locator(".camkit-sheet")
    bench = panels.filter(has=window.get_by_role("button", name="Weakest spring"))
    plane = panels.filter(has=window.get_by_role("button", name="Load the optimum"))
    return Workbook(window, bench, plane.first, Instrument(window))


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    book.app.reset()
    book.app.shows(START, VALVE_MEASURES)


def test_the_roller_from_the_menu_and_a_slider(book: Workbook) -> None:
    book.app.choose("roller")
    changed = START.replace(follower=ROLLER)
    book.app.shows(changed, VALVE_MEASURES)
    slider = book.app.slider("n")
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    n = book.app.shown()["values"][list(quantities_of(changed)).index("n")]
    assert n > 6
    book.app.shows(changed.replace(n=n), VALVE_MEASURES)


def test_buttons_size_the_spring_and_the_base_circle(book: Workbook) -> None:
    book.bench.get_by_role("button", name="Weakest spring").click()
    book.app.shows(START.with_spring(), VALVE_MEASURES)
    book.bench.get_by_role("button", name="Smallest base circle for radius 4.5 mm").click()
    book.app.shows(keeping_min_radius(START.with_spring()), VALVE_MEASURES)
    assert book.value("app.analysis.profile_margin.value") == pytest.approx(4.5 * mm, rel=1e-9)


def test_a_weight_moves_the_optimum_and_a_click_loads_a_design(book: Workbook) -> None:
    book.plane.get_by_label("problem").select_option(label="sign as printed")
    for typed in ("0.5", "0.7"):
        box = book.plane.get_by_role("textbox", name=re.compile("^fullness.*number")).first
        box.fill(typed)
        box.press("Enter")
        w = float(typed) / (float(typed) + 0.5)
        best = minimise(valve_study(weights=(w, 1 - w), printed_sign=True), "de").design
        expect(book.plane).to_contain_text(f"optimum: n {best.n:.4g}, m {best.m:.4g}")
        np.testing.assert_allclose(book.value("plane.optimum"), (best.n, best.m), atol=1e-3)
    book.plane.get_by_role("button", name="Load the optimum").click()
    book.app.shows(START.replace(n=20.0, m=20.0), VALVE_MEASURES)

    book.page.mouse.click(*in_picture(book.plane, 9.0, 12.0))
    eventually(lambda: abs(book.value("app.design.n") - 9) < 0.1)
    assert book.value("app.design.m") == pytest.approx(12, abs=0.1)
