"""The notebook of tolerances in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from camkit import ArmLoad, DoorHandleCam, deg, door_handle_study, mm
from camkit.panels.tolerances import SETTLED
from camkit.study.tolerances import Tolerances
from lab import OWN_SHEETS, eventually, kernel_value, on_page, open_notebook, run_all

SIZES = {"lift_arm": 45 * mm, "lift_start_angle": 27 * deg, "relief_cam_angle": 45 * deg}
CAM = DoorHandleCam(**SIZES, lift_load=ArmLoad(torque=10))
MEDIUM = {"lift_arm": 0.3 * mm, "lift_centre_distance": 0.3 * mm, "lift_start_angle": 0.5 * deg}


@pytest.fixture(scope="module")
def page(window: Page) -> Page:
    open_notebook(window, "17_tolerances.ipynb")
    run_all(window)
    return window


@pytest.fixture
def explorer(page: Page) -> Locator:
    return page.locator(".camkit-page").first


@pytest.fixture
def panel(page: Page) -> Locator:
    """As it was at first."""
    kernel_value(page, "app.load(cam)")
    panel = page.locator(OWN_SHEETS).filter(has_text="Tolerances").first
    panel.get_by_role("button", name="Reset").click()
    panel.scroll_into_view_if_needed()
    shows(panel, MEDIUM)
    return panel


def box_of(panel: Locator, name: str) -> Locator:
    return panel.get_by_role("textbox", name=f"{name}, number").first


def parts(half_widths: dict[str, float], start: object = None) -> Tolerances:
    study = door_handle_study(CAM)
    study = study.replace(start=start or study.start, at_most=dict.fromkeys(study.at_most, 44 * deg))
    return Tolerances(study, half_widths, parts=SETTLED)


def shows(panel: Locator, half_widths: dict[str, float], start: object = None) -> None:
    """The table holds the parts' measures, computed here."""
    made = parts(half_widths, start)
    for i, measure in enumerate(made.measures, start=1):
        low, high = made.percentiles(measure, (2.5, 97.5))
        expect(panel.locator("tr").nth(i).locator("td").nth(2)).to_have_text(on_page(measure.text(low)))
        expect(panel.locator("tr").nth(i).locator("td").nth(3)).to_have_text(on_page(measure.text(high)))
    (max_pressure_angle,) = made.study.at_most
    expect(panel.locator("tr").nth(3).locator("td").nth(4)).to_have_text(
        f"{100 * made.missed[max_pressure_angle]:.1f} %"
    )


def drawn(panel: Locator) -> dict[str, Any]:
    """The marks of the cloud that the page has drawn, by key, and how many points each has."""
    shown = panel.evaluate("root => root.parentElement.camkit.shown().pictures[0].marks")
    return {mark["key"]: len(mark["x"]) for mark in shown}


def test_a_typed_tolerance_and_a_key_on_the_slider_change_the_parts(panel: Locator) -> None:
    box = box_of(panel, "lift arm, mm")
    box.fill("1.2")
    box.press("Enter")
    shows(panel, MEDIUM | {"lift_arm": 1.2 * mm})
    made = parts(MEDIUM | {"lift_arm": 1.2 * mm})
    kept = int(made.evaluation.feasible.sum())
    eventually(lambda: (drawn(panel)["kept"], drawn(panel)["missed"]) == (kept, SETTLED - kept))
    handle = panel.get_by_role("slider", name="lift arm, mm")
    handle.focus()
    handle.press("ArrowLeft")
    expect(box).to_have_value("1.195")
    shows(panel, MEDIUM | {"lift_arm": 1.195 * mm})


def test_what_cannot_be_made_is_said_in_place_of_the_picture(panel: Locator) -> None:
    box = box_of(panel, "lift arm, mm")
    box.fill("60")
    box.press("Enter")
    sentence = "the lift arm of 45 mm less its tolerance of 60 mm is -15 mm; it must be a finite number above 0 mm"
    expect(panel.get_by_text(sentence)).to_have_text(f"This cannot be made: {sentence}.")
    expect(panel.locator("canvas").first).to_be_hidden()
    panel.get_by_role("button", name="Reset").click()
    expect(panel.get_by_text("This cannot be made")).to_have_count(0)
    shows(panel, MEDIUM)
    expect(panel.locator("canvas").first).to_be_visible()


def test_the_parts_follow_the_design_in_the_sliders(page: Page, explorer: Locator, panel: Locator) -> None:
    box = box_of(explorer, "lift arm, mm")
    box.fill("46")
    box.press("Enter")
    shows(panel, MEDIUM, CAM.replace(lift_arm=46 * mm))
    kernel_value(page, "app.load(cam)")
    shows(panel, MEDIUM)


def test_a_drag_leaves_nothing_queued(page: Page, panel: Locator) -> None:
    """When the pointer is let go, the last of thirty places soon counts, and nothing comes after it."""
    slider = panel.get_by_role("slider", name="lift arm, mm")
    place = slider.bounding_box()
    assert place
    y = place["y"] + place["height"] / 2
    page.mouse.move(place["x"] + place["width"] * 0.2, y)
    page.mouse.down()
    page.mouse.move(place["x"] + place["width"] * 0.6, y, steps=30)
    page.mouse.up()
    half = float(slider.input_value()) * mm
    assert half == pytest.approx(0.9 * mm, rel=0.05)
    eventually(lambda: kernel_value(page, "tolerances.knobs['lift_arm'].value") == pytest.approx(half))
    expect(box_of(panel, "lift arm, mm")).to_have_value(f"{half / mm:.6g}")
    shows(panel, MEDIUM | {"lift_arm": half})
    assert kernel_value(page, "tolerances.knobs['lift_arm'].value") == pytest.approx(half)
