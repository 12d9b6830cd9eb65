"""The shaft's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from camkit import deg, kW, mm, rpm
from camkit.linkage.universal_joint import DOUBLE_UNIVERSAL_JOINT_MEASURES, DoubleUniversalJoint
from camkit.machines.shaft import TUBE_NUMBERS, UniversalJointShaft, lightest_shaft
from camkit.quantities import quantities_of
from camkit.views import plane_of_sizes
from lab import Instrument, eventually, open_notebook, run_all

START = UniversalJointShaft()


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its two instruments, the first under menus and buttons."""

    page: Page
    bench: Locator
    tube: Instrument
    joints: Instrument

    def press(self, words: str) -> None:
        self.bench.get_by_role("button", name=words).click()


@pytest.fixture(scope="module")
def book(window: Page) -> Workbook:
    open_notebook(window, "12_universal_joint_shaft.ipynb")
    run_all(window)
    bench = window.locator(".camkit-sheet").filter(has=window.get_by_role("button", name="lightest, by formula"))
    return Workbook(window, bench, Instrument(window), Instrument(window, "drive_app", 1))


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    book.tube.reset()
    book.tube.shows(START, TUBE_NUMBERS)


def test_typed_power_and_a_slider_move_the_limits_and_the_tube(book: Workbook) -> None:
    book.tube.type("power, kW", "300")
    changed = START.replace(power=300 * kW)
    book.tube.shows(changed, TUBE_NUMBERS)
    slider = book.tube.slider("outer diameter, mm")
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    wide = book.tube.shown()["values"][list(quantities_of(START)).index("outer_diameter")]
    assert wide > START.outer_diameter
    moved = changed.replace(outer_diameter=wide)
    book.tube.shows(moved, TUBE_NUMBERS)
    drawn = plane_of_sizes(moved.analyse())  # it does not compute in the page: the kernel draws it
    marks = {mark.key: mark for mark in drawn.marks}

    def follows() -> bool:
        shown = {p["name"]: p for p in book.tube.shown()["pictures"]}["plane_of_sizes"]
        points = [mark for mark in shown["marks"] if mark["kind"] == "points" and mark["key"] in marks]
        return bool(points) and all(
            np.allclose(np.array(p["x"], dtype=float), np.ravel(marks[p["key"]].x), equal_nan=True) for p in points
        )

    eventually(follows)


def test_a_material_from_the_menu(book: Workbook) -> None:
    book.bench.get_by_label("material").select_option(label="EN AW-6082 T6")
    changed = START.made_of("EN AW-6082 T6")
    book.tube.shows(changed, TUBE_NUMBERS)


def test_buttons_put_a_tube_into_the_sliders(book: Workbook) -> None:
    book.press("lightest, by formula")
    book.tube.shows(lightest_shaft(), TUBE_NUMBERS)
    book.press("nearest GB/T 17395 tube")
    book.tube.shows(START.replace(outer_diameter=133 * mm, inner_diameter=103 * mm), TUBE_NUMBERS)


def test_an_offer_that_cannot_be_made_is_a_sentence(book: Workbook) -> None:
    book.press("lightest EN 10210 tube")
    alert = book.bench.get_by_role("alert").first
    expect(alert).to_contain_text("This cannot be offered: none of the 3 standard tubes within 108 to 140 mm outside")
    book.tube.shows(START, TUBE_NUMBERS)


def test_the_joints_follow_their_sliders(book: Workbook) -> None:
    book.joints.type("phase, deg", "90")
    first = DoubleUniversalJoint(
        first_angle=15 * deg,
        second_angle=12 * deg,
        speed=1000 * rpm,
        torque=START.torque,
        inertia=START.analyse().inertia,
    )
    book.joints.shows(first.replace(phase=90 * deg), DOUBLE_UNIVERSAL_JOINT_MEASURES)
