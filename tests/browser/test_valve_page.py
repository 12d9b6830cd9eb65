"""The valve cam's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, Locator, Page, expect

from camkit import deg, mm, profile_csv, rpm
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import (
    PAPER_MIN_RADIUS,
    VALVE_MEASURES,
    keeping_least_radius,
    min_radius,
    nose_radius,
    valve_study,
)
from camkit.machines.valve_train import ROLLER
from camkit.search.minimise import minimise
from lab import LabServer, eventually, kernel_value, open_notebook, run_all, table_of_measures

START = ValveCam()


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and two of its panels."""

    page: Page
    bench: Locator
    plane: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)

    def row(self, panel: Locator, name: str) -> Locator:
        label = self.page.locator("span[title]", has_text=re.compile(rf"(^|\s){name}$"))
        return panel.locator(".camkit-knob").filter(has=label)

    def type(self, panel: Locator, name: str, text: str) -> None:
        box = self.row(panel, name).get_by_role("spinbutton")
        box.fill(text)
        box.press("Enter")


@pytest.fixture(scope="module")
def book(context: BrowserContext, server: LabServer) -> Iterator[Workbook]:
    page = context.new_page()
    open_notebook(page, "08_valve_cam.ipynb")
    run_all(page)
    panels = page.locator(".camkit-panel")
    # a panel inside a panel: the outer one, with the buttons, comes first
    yield Workbook(page, panels.filter(has_text="half angle").first, panels.filter(has_text="wear").first)
    page.close()
    server.end_kernels()


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    book.bench.get_by_role("button", name="Reset").click()
    shows(book, START)


def shows(book: Workbook, cam: ValveCam) -> None:
    """Boxes and table show ``cam``, computed here."""
    for name, shown in (("n", cam.n), ("base radius", cam.base_radius / mm), ("cam speed", cam.load.speed / rpm)):
        expect(book.row(book.bench, name).get_by_role("spinbutton")).to_have_value(f"{shown:.6g}")
    limits = dict.fromkeys((nose_radius, min_radius), PAPER_MIN_RADIUS)
    expected = table_of_measures(VALVE_MEASURES, cam.analyse(), START.analyse(), {}, limits)
    expect(book.bench.locator(".camkit-tables tr:has(td)")).to_have_text(expected)


def test_a_slider_changes_the_exponents_and_all_that_follows(book: Workbook) -> None:
    slider = book.row(book.bench, "n").get_by_role("slider")
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    n = float(slider.get_attribute("aria-valuetext") or 0)
    assert n > 6
    shows(book, START.replace(n=n))
    np.testing.assert_allclose(book.value("app.analysis.coefficients"), ValveCam(n=n).analyse().coefficients, rtol=1e-9)


def test_the_roller_from_the_menu_and_the_profile_to_download(book: Workbook) -> None:
    book.bench.get_by_label("follower").or_(book.bench.locator("select")).first.select_option(label="roller")
    changed = START.replace(follower=ROLLER)
    shows(book, changed)
    with book.page.expect_download() as expected:
        book.bench.get_by_role("button", name="Profile as CSV").click()
    text = Path(expected.value.path()).read_text(encoding="utf-8")
    assert text == profile_csv(changed.analyse())


def test_buttons_size_the_spring_and_the_base_circle(book: Workbook) -> None:
    book.bench.get_by_role("button", name="Weakest spring").click()
    shows(book, START.with_spring())
    book.bench.get_by_role("button", name="Smallest base circle for radius 4.5 mm").click()
    shows(book, keeping_least_radius(START.with_spring()))
    assert book.value("app.analysis.profile_margin.value") == pytest.approx(4.5 * mm, rel=1e-9)


def test_what_cannot_be_built_is_said_in_a_sentence(book: Workbook) -> None:
    book.type(book.bench, "half angle", "160")
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the sentence is what is compared
        START.replace(half_angle=160 * deg)
    expect(book.bench.get_by_role("alert")).to_have_text(f"This cannot be built: {refused.value}.")


def test_a_weight_moves_the_optimum_and_a_click_loads_a_design(book: Workbook) -> None:
    book.plane.locator("select").select_option(label="sign as printed")
    for typed in ("0.5", "0.7"):
        book.type(book.plane, "fullness", typed)
        w = float(typed) / (float(typed) + 0.5)
        best = minimise(valve_study(weights=(w, 1 - w), printed_sign=True), "de").design
        expect(book.plane).to_contain_text(f"optimum: n {best.n:.4g}, m {best.m:.4g}")
        np.testing.assert_allclose(book.value("plane.optimum"), (best.n, best.m), atol=1e-3)
    book.plane.get_by_role("button", name="Load the optimum").click()
    shows(book, START.replace(n=20.0, m=20.0))

    x, y = book.value("plane.picture.axes[0].transData.transform((9.0, 12.0))")
    width, height = book.value("plane.picture.figure.canvas.get_width_height()")
    image = book.plane.locator("img.camkit-image")
    box = image.bounding_box()
    assert box
    image.click(position={"x": x / width * box["width"], "y": (1 - y / height) * box["height"]})
    eventually(lambda: abs(book.value("app.design.n") - 9) < 0.1)
    assert book.value("app.design.m") == pytest.approx(12, abs=0.1)
