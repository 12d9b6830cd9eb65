"""The yield in the verdict of an instrument, in JupyterLab: it follows a slider, and tells why parts fail."""

import re

import pytest
from playwright.sync_api import expect

from camkit import ArmLoad, DoorHandleCam, deg, door_handle_study, mm
from camkit.study import general_tolerances
from lab import eventually, kernel_value
from test_instrument_page import PAGE, settled, shown  # noqa: F401

CAM = DoorHandleCam(
    lift_arm=45 * mm, lift_start_angle=27 * deg, relief_cam_angle=45 * deg, lift_load=ArmLoad(torque=10)
)
CELL = """
from camkit import ArmLoad, DoorHandleCam, deg, door_handle_study, explore, live_pareto_panel, mm, tolerance_panel
cam = DoorHandleCam(
    lift_arm=45 * mm, lift_start_angle=27 * deg, relief_cam_angle=45 * deg, lift_load=ArmLoad(torque=10)
)
study = door_handle_study(cam)
app = explore(cam, at_most=study.at_most, at_least=study.at_least)
app"""
MIDDLE = f"""() => {{ const parts = [...{PAGE}.sheets.at(-1).parts.values()];
    const [chart] = parts.flatMap(({{ part }}) => part.charts ?? []), [x, y] = chart.offered, k = x.length >> 1;
    const box = chart.canvas.getBoundingClientRect();
    return [box.left + chart.x(x[k]), box.top + chart.y(y[k])]; }}"""
PALE = re.compile("camkit-older")


@pytest.fixture
def page(window, shown):  # noqa: F811
    if window.evaluate("window.jupyterapp?.shell.currentWidget?.context?.path") != "yield.ipynb":
        shown(CELL, "yield.ipynb")
    return window


def slider(page):
    return page.locator(".camkit-left").get_by_role("slider", name="lift arm, mm", exact=True)


def chip(page):
    return page.locator(".camkit-chips .camkit-chip").first


def told(page):
    """The yield that the page shows, %, and whether it has an interval."""
    found = re.fullmatch(r"yield ([\d.]+) %\s*(\(.* to .*\))?", chip(page).inner_text())
    return found and (float(found[1]), bool(found[2]))


def within(lift_arm, half_widths):
    """The yield, computed here."""
    study = door_handle_study(CAM)
    study = study.replace(start=CAM.replace(lift_arm=lift_arm))
    robust = study.under(half_widths or general_tolerances(study.start))
    return robust.recheck(robust.x0).share[0]


def test_the_yield_follows_a_slider_and_then_is_sure(page):
    expect(chip(page)).to_have_text(re.compile(r"yield 100.0 % \(99.[67] to 100.0\)"))
    expect(chip(page)).to_have_class("camkit-chip camkit-ok")
    at = slider(page).bounding_box()
    page.mouse.move(at["x"] + at["width"] * 0.25, at["y"] + at["height"] / 2)
    page.mouse.down()
    seen = set()
    for share in (0.3, 0.32, 0.34, 0.36):
        page.mouse.move(at["x"] + at["width"] * share, at["y"] + at["height"] / 2)
        expect(chip(page)).not_to_have_class(PALE)
        page.wait_for_function("() => !document.querySelector('.camkit-older')")
        seen.add(told(page)[0])
    page.mouse.up()
    assert len(seen) > 1
    eventually(lambda: told(page)[1])
    expected = within(kernel_value(page, "app.design.lift_arm"), None)
    assert told(page)[0] == pytest.approx(100 * expected, abs=0.051)
    chip(page).click()
    expect(page.locator(".camkit-why")).to_contain_text("more than any other")


def the_robust_front_stands_beside_the_nominal_one(page):
    kernel_value(page, "globals().update(live=live_pareto_panel(app, study))")
    page.get_by_role("tab", name="Live front").click()
    sheet = page.locator(".camkit-sheet").filter(has_text="choose by")
    sheet.get_by_role("checkbox", name="made within tolerances").check()
    expect(sheet).to_contain_text("by exact parts", timeout=60_000)
    expect(sheet).to_contain_text("the price: ")
    marks = page.evaluate(f"() => {PAGE}.sheets.at(-1).shown().pictures[0].marks.map((m) => [m.key, m.x.length])")
    drawn = dict(marks)
    assert drawn["robust"] + drawn["open"] == kernel_value(page, "len(live.front)")
    assert sum(drawn[f"yield {k}"] for k in range(4)) == kernel_value(page, "len(live.robust.nominal)")
    sheet.locator("canvas").first.scroll_into_view_if_needed()
    at = page.evaluate(MIDDLE)
    page.mouse.move(*at)
    expect(sheet.locator(".camkit-tip")).to_contain_text(re.compile(r"yield [\d.]+ % \(.* to .*\)"))


def test_its_tolerances_are_those_of_the_panel_in_the_tab_that_a_click_opens(page):
    kernel_value(page, "tolerance_panel(app, study, {'lift_arm': 1 * mm}) and None")
    kernel_value(page, "app.load(cam.replace(lift_arm=46.4 * mm))")
    expected = 100 * within(46.4 * mm, {"lift_arm": 1 * mm})
    assert 20 < expected < 95
    eventually(lambda: told(page)[1] and told(page)[0] == pytest.approx(expected, abs=0.051))
    expect(chip(page)).to_have_class("camkit-chip camkit-bad")
    chip(page).click()
    expect(page.get_by_role("tab", name="Tolerances")).to_have_attribute("aria-selected", "true")
    the_robust_front_stands_beside_the_nominal_one(page)
    page.evaluate(f"() => {{ {PAGE}.left = true; }}")  # as when the kernel has ended: nobody tells it any more
    slider(page).press("ArrowRight")
    expect(page.locator(".camkit-chips")).not_to_contain_text("yield")
