"""The live front's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from playwright.sync_api import Locator, Page, expect

from camkit import ArmLoad, DoorHandleCam, ahp, door_handle_study, mm
from camkit.search.fast_front import quick_front
from camkit.views.front import shown_objectives
from lab import OWN_SHEETS, eventually, kernel_value, marks_of, open_notebook, run_all, type_number

PAPER = DoorHandleCam(lift_load=ArmLoad(torque=10))


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its live front."""

    page: Page
    live: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)

    def shows(self, front: Any) -> None:
        """The page draws the front and tells its winner, computed here; the kernel holds the same designs."""
        winner = self.value("(live.settle(), live.winner)[1]")
        f = front.f[winner]
        goals = ", ".join(f"{m.name} {m.text(m.sign * v)}" for m, v in zip(front.study.minimise, f, strict=True))
        expect(self.live).to_contain_text(
            re.compile(rf"winner: design {winner} of 0 to {len(front) - 1}: {re.escape(goals)}")
        )
        expect(self.live).to_contain_text(re.compile(rf"{len(front)} designs on the front, found in \d+ ms"))
        assert_allclose(self.value("live.front.f"), front.f, rtol=1e-9)
        eventually(lambda: np.shape(marks_of(self.live)["front"]) == (2, len(front)))
        assert_allclose(marks_of(self.live)["front"], shown_objectives(front), rtol=1e-9)


@pytest.fixture(scope="module")
def book(window: Page) -> Workbook:
    open_notebook(window, "15_live_front.ipynb")
    run_all(window)
    return Workbook(window, window.locator(OWN_SHEETS).filter(has_text="choose by").first)


def test_sliders_and_judgements_move_the_front(book: Workbook) -> None:
    book.shows(quick_front(door_handle_study(PAPER)))

    type_number(book.page, "lift centre distance, mm", "78")
    eventually(lambda: book.value("app.design.lift_centre_distance") == 78 * mm)
    moved = PAPER.replace(lift_centre_distance=78 * mm)
    front = quick_front(door_handle_study(moved, reference=PAPER))
    book.shows(front)

    book.live.get_by_role("button", name="Load the winner").click()
    chosen = front.x[book.value("live.winner")]
    eventually(lambda: book.value("app.design.lift_arm") == pytest.approx(chosen[0], rel=1e-12))
    assert book.value("app.design.lift_centre_distance") == 78 * mm
    assert_allclose(book.value("live.front.f"), front.f, rtol=1e-9)  # free quantities move no front

    book.value("criteria.load([1, 1, 1])")
    book.shows(quick_front(front.study.with_weights(ahp([1, 1, 1]).weights)))


def test_what_is_impossible_is_told_in_place_of_the_picture(book: Workbook) -> None:
    book.value("criteria.load([5, 5, 1])")
    type_number(book.page, "lift swing, deg", "110")
    alert = book.live.get_by_role("alert")
    expect(alert).to_contain_text("There is no front: no design that was evaluated keeps every limit")
    expect(book.live.locator("canvas")).to_be_hidden()
    book.value("app.load(app.start)")
    expect(alert).to_be_hidden()
    book.shows(quick_front(door_handle_study(PAPER)))
