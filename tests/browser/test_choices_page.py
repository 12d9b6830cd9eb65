"""A choice from a menu is a step as any other: Undo and Redo go over it, what is pinned and where it stands stays."""

import numpy as np
import pytest
from playwright.sync_api import expect

from camkit.quantities import choices_of, measures_of
from camkit.views import default_views, pressure_angle
from lab import eventually, kernel_value, open_notebook
from test_instrument_page import BUSY, LIMITS, PAGE, STUDY, of_page, settled
from test_living_page import compare
from test_names_page import keep, press
from test_session_page import SAVE, notebook, run, step

LAW = "motion_law"
FIRST = STUDY.start.motion_law
OPTION, OTHER = next((name, law) for name, law in choices_of(STUDY.start)[LAW].named.items() if law != FIRST)
MENU = ".camkit-left .camkit-choice select"
GHOST = f"""(name) => {{ const chart = {PAGE}.charts.find(({{ picture }}) => picture.name === name),
    {{ picture, outputs }} = chart.how.ghost, is = ({{ kind, role }}) => kind === "line" && role !== "limit";
    return Array.from(outputs[picture.marks.find(is).y.at]); }}"""
__all__ = ["notebook"]


def choose(page, option, law):
    page.locator(".camkit-left details").last.evaluate("group => { group.open = true; }")
    page.locator(MENU).first.focus()
    page.locator(MENU).first.select_option(option)
    comes(page, law)


def comes(page, law):
    """Page and kernel come to a law."""
    eventually(lambda: kernel_value(page, f"app.design.{LAW}.name") == law.name)
    page.wait_for_function(f"() => {PAGE}.structure.choices[0].chosen === {law.name!r}")
    settled(page)
    assert kernel_value(page, "app.message") == ""


def pinned_as(page, design):
    line = next(m for m in pressure_angle(design.analyse()).marks if type(m).__name__ == "Line" and m.role != "limit")
    there = page.evaluate(GHOST, "pressure_angle")
    np.testing.assert_allclose(there, line.y, rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(line.y)))


def arm(page):
    return page.evaluate(f"{PAGE}.values[0]")


def test_undo_goes_back_over_a_choice_and_the_pin_stays(page, notebook):
    run(page)
    step(page, 2)
    page.get_by_role("button", name="Pin to compare").click()
    before, moved = STUDY.start.replace(lift_arm=arm(page)), arm(page)
    step(page, 3)
    last = arm(page)
    page.evaluate(f"{PAGE}.positions.turnTo(40)")
    choose(page, OPTION, OTHER)
    assert arm(page) == last
    assert page.evaluate(f"{PAGE}.positions.angle") == pytest.approx(40)
    column, menu = (page.locator(part).first.bounding_box() for part in (".camkit-left", MENU))
    assert column["y"] <= menu["y"] < menu["y"] + menu["height"] <= column["y"] + column["height"]  # still in sight
    design = STUDY.start.replace(lift_arm=last, motion_law=OTHER)
    compare(of_page(page), design, default_views(design.analyse()), measures_of(design), LIMITS)
    pinned_as(page, before)  # of the law that it had
    standing = page.evaluate(GHOST, "mechanism")
    page.evaluate(f"{PAGE}.positions.turnTo(80)")
    page.wait_for_function(f"() => !{PAGE}.frame")
    assert page.evaluate(GHOST, "mechanism") != standing  # it turns with the other one
    measure = measures_of(design)[0]
    then = page.evaluate(f"{PAGE}.judged[0].then")
    assert then == pytest.approx(float(measure.one(before.analyse())), rel=1e-9)

    page.keyboard.press("Control+z")  # the menu still has the focus
    comes(page, FIRST)
    assert arm(page) == last
    assert page.evaluate(f"{PAGE}.positions.angle") == pytest.approx(80)
    assert kernel_value(page, f"app.design == app.start.replace(lift_arm={last!r})") is True
    for _ in range(3):
        page.keyboard.press("Control+z")
    settled(page)
    assert arm(page) == moved
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == moved)
    for _ in range(3):
        page.keyboard.press("Control+Shift+z")
    page.get_by_role("button", name="Redo").click()
    comes(page, OTHER)
    assert arm(page) == last
    pinned_as(page, before)
    assert page.get_by_role("button", name="Redo").get_attribute("aria-disabled") == "true"

    page.evaluate(SAVE)
    left = "app.page.get('make', '') == app.structure['make'] != (app.page['pinned'] or {}).get('make')"
    eventually(lambda: kernel_value(page, left))
    page.evaluate(SAVE)
    open_notebook(page, notebook)  # the kernel is the same
    page.wait_for_selector(".camkit-page canvas")
    page.wait_for_function(f"() => {PAGE}?.ghost && !{PAGE}.frame")
    pinned_as(page, before)
    page.get_by_role("button", name="Undo").click()
    comes(page, FIRST)
    assert arm(page) == last


def test_undo_pressed_quickly_goes_back_as_often(page, notebook):
    run(page)
    first = arm(page)
    step(page, 2)
    moved = arm(page)
    choose(page, OPTION, OTHER)
    for _ in range(2):
        page.keyboard.press("Control+z")  # the second one while the law is on its way
    comes(page, FIRST)
    eventually(lambda: arm(page) != moved)
    between = arm(page)
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    settled(page)
    assert arm(page) == first != between
    for _ in range(5):
        page.keyboard.press("Control+Shift+z")
    comes(page, OTHER)
    assert arm(page) == moved


def test_a_named_design_of_another_law_is_one_step(page, notebook):
    run(page)
    step(page, 1)
    first = arm(page)
    keep(page, "as before")
    choose(page, OPTION, OTHER)
    step(page, 1)
    steps = page.evaluate(f"{PAGE}.history.past.length")
    press(page, "Show as before")
    comes(page, FIRST)
    assert arm(page) == first
    assert page.evaluate(f"{PAGE}.history.past.length") == steps + 1
    page.get_by_role("button", name="Undo").click()
    comes(page, OTHER)
    assert arm(page) > first
    page.get_by_role("button", name="Redo").click()
    comes(page, FIRST)
    assert arm(page) == first


def test_a_choice_that_is_taken_back_needs_its_kernel(page, notebook, server):
    run(page)
    choose(page, OPTION, OTHER)
    undo = page.get_by_role("button", name="Undo")
    expect(undo).to_have_attribute("aria-disabled", "false")
    server.end_kernels()
    expect(page.locator(".camkit-note")).to_contain_text("No kernel knows this page: it computes by itself")
    page.evaluate(f"{PAGE}.ask(true)")
    expect(undo).to_have_attribute("aria-disabled", "true")
    undo.click(force=True)
    settled(page)
    assert page.evaluate(f"{PAGE}.structure.choices[0].chosen") == OTHER.name
    step(page, 1)
    undo.click()  # of this law it can
    settled(page)
    assert arm(page) == STUDY.start.lift_arm


def test_reset_counts_also_while_the_kernel_is_busy(page, notebook):
    """What the page said before is still on its way when the question is asked."""
    run(page)
    page.evaluate(BUSY.replace("sleep(8)", "sleep(3)"))
    step(page, 4)
    assert arm(page) > STUDY.start.lift_arm
    page.get_by_role("button", name="Reset").click()
    eventually(lambda: arm(page) == STUDY.start.lift_arm)
    page.wait_for_timeout(500)
    assert kernel_value(page, "[app.design == app.start, app.values[0], app.message]") == [
        True,
        STUDY.start.lift_arm,
        "",
    ]
    settled(page)
    assert arm(page) == STUDY.start.lift_arm
