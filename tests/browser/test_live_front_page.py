"""The live front's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest
from numpy.testing import assert_allclose
from playwright.sync_api import BrowserContext, Locator, Page, expect

from camkit import ArmLoad, DoorHandleCam, ahp, door_handle_study, mm
from camkit.search.fast_front import quick_front
from lab import LabServer, kernel_value, open_notebook, run_all

PAPER = DoorHandleCam(lift_load=ArmLoad(torque=10))


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its panels."""

    page: Page
    sliders: Locator
    live: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)

    def box(self, name: str) -> Locator:
        label = self.page.locator("span[title]", has_text=re.compile(rf"\s{name}$"))
        return self.sliders.locator(".camkit-knob").filter(has=label).get_by_role("spinbutton")

    def type(self, name: str, text: str) -> None:
        self.box(name).fill(text)
        self.box(name).press("Enter")

    def shows(self, front: Any) -> None:
        """The page tells the front's winner, computed here; the kernel holds the same designs."""
        winner = self.value("(live.settle(), live.winner)[1]")
        f = front.f[winner]
        goals = ", ".join(f"{m.name} {m.text(m.sign * v)}" for m, v in zip(front.study.minimise, f, strict=True))
        expect(self.live).to_contain_text(
            re.compile(rf"winner: design {winner}, {winner + 1}(st|nd|rd|th) of {len(front)}: {re.escape(goals)}")
        )
        expect(self.live).to_contain_text(re.compile(rf"{len(front)} designs on the front, found in \d+ ms"))
        assert_allclose(self.value("live.front.f"), front.f, rtol=1e-9)


@pytest.fixture(scope="module")
def book(context: BrowserContext, server: LabServer) -> Iterator[Workbook]:
    page = context.new_page()
    open_notebook(page, "15_live_front.ipynb")
    run_all(page)
    panels = page.locator(".camkit-panel")
    yield Workbook(page, panels.filter(has_text="centre distance").first, panels.filter(has_text="choose by").first)
    page.close()
    server.end_kernels()


def test_sliders_and_judgements_move_the_front(book: Workbook) -> None:
    image = book.live.locator("img.camkit-image")
    book.shows(quick_front(door_handle_study(PAPER)))
    before = image.get_attribute("src")

    book.type("lift centre distance", "78")
    moved = PAPER.replace(lift_centre_distance=78 * mm)
    front = quick_front(door_handle_study(moved, reference=PAPER))
    book.shows(front)
    assert image.get_attribute("src") != before

    book.live.get_by_role("button", name="Load the winner").click()
    chosen = front.x[book.value("live.winner")]
    expect(book.box("lift arm")).to_have_value(f"{chosen[0] / mm:.6g}")
    expect(book.box("lift centre distance")).to_have_value("78")
    assert_allclose(book.value("live.front.f"), front.f, rtol=1e-9)  # free quantities move no front

    book.value("criteria.load([1, 1, 1])")
    book.shows(quick_front(front.study.with_weights(ahp([1, 1, 1]).weights)))


def test_what_is_impossible_is_told_in_place_of_the_picture(book: Workbook) -> None:
    book.value("criteria.load([5, 5, 1])")
    book.type("lift swing", "110")
    alert = book.live.get_by_role("alert")
    expect(alert).to_contain_text("There is no front: no design that was evaluated keeps every limit")
    expect(book.live.locator("img.camkit-image")).to_be_hidden()
    book.sliders.get_by_role("button", name="Reset").click()
    expect(alert).to_be_hidden()
    book.shows(quick_front(door_handle_study(PAPER)))
