"""Designs with names: kept beside the notebook, shown again with Undo, and in a file kept in the page."""

import pytest
from playwright.sync_api import expect

from camkit import DoorHandleCam, explore, mm
from camkit.panels.kit.keeper import Keeper
from camkit.quantities import choices_of
from lab import eventually, kernel_value, load_notebook
from test_instrument_page import PAGE, settled
from test_session_page import RESTART, SAVE, notebook, run, step

EVIL = "<img src=x onerror='window.ran=1'>"
LAW = "motion_law"
__all__ = ["notebook"]


def keep(page, name):
    """Opens the menu and keeps the design under a name."""
    page.locator(".camkit-names summary").click()
    page.get_by_label("name for this design").fill(name)
    page.get_by_role("button", name="Keep", exact=True).click()
    page.keyboard.press("Escape")


def press(page, button):
    page.locator(".camkit-names summary").click()
    page.get_by_role("button", name=button, exact=True).click()
    page.keyboard.press("Escape")


def arm(page):
    return page.evaluate(f"{PAGE}.values[0]")


def test_names_outlive_a_reload_and_a_kernel(page, notebook):
    run(page)
    step(page, 3)
    keep(page, EVIL)
    keep(page, "again")
    kept = arm(page)
    step(page, 2)
    page.locator(".camkit-names summary").click()
    page.get_by_role("button", name="Rename again").click()
    page.get_by_label("name for this design").fill("thick")
    page.get_by_label("name for this design").press("Enter")
    page.keyboard.press("Escape")
    head = page.locator(".camkit-names summary")
    expect(head).to_have_text("Designs (2)")
    eventually(lambda: kernel_value(page, "list(app.keeper.named)") == [EVIL, "thick"])
    page.evaluate(SAVE)
    load_notebook(page, notebook)  # the kernel is the same
    page.wait_for_selector(".camkit-page canvas")
    expect(head).to_have_text("Designs (2)")
    page.evaluate(RESTART)
    run(page)
    expect(head).to_have_text("Designs (2)")
    before = arm(page)
    press(page, f"Show {EVIL}")
    settled(page)
    assert arm(page) == pytest.approx(kept, rel=1e-12) != before
    expect(head).to_have_text(EVIL)
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == pytest.approx(kept, rel=1e-12))
    page.get_by_role("button", name="Undo").click()
    settled(page)
    assert arm(page) == before
    press(page, "Forget thick")
    eventually(lambda: kernel_value(page, "list(app.keeper.named)") == [EVIL])
    assert not page.evaluate("window.ran")


def test_a_name_brings_back_what_was_chosen_too(page, notebook):
    run(page)
    keep(page, "as before")
    law = kernel_value(page, f"str(type(app.design.{LAW}).__name__)")
    other = next(
        name for name, option in choices_of(DoorHandleCam())[LAW].named.items() if type(option).__name__ != law
    )
    page.locator(".camkit-left details").last.evaluate("group => { group.open = true; }")
    page.locator(".camkit-left select").first.select_option(other)
    eventually(lambda: page.evaluate(f"{PAGE}.structure.choices.some((c) => c.chosen === '{other}')"))
    expect(page.locator(".camkit-names summary")).to_have_text("Designs (1)")
    press(page, "Show as before")
    eventually(lambda: kernel_value(page, f"str(type(app.design.{LAW}).__name__)") == law)
    expect(page.locator(".camkit-names summary")).to_have_text("as before")


def test_names_live_in_a_file(browser, tmp_path, monkeypatch):
    """Those of the notebook, and those that whoever opened it gives; what cannot be built gets none."""
    monkeypatch.chdir(tmp_path)
    app = explore(DoorHandleCam())
    keeper: Keeper = app.keeper
    keeper.named = {EVIL: app.design.replace(lift_arm=48 * mm)}
    (tmp_path / "cam.html").write_text(app.html(), encoding="utf-8")
    page = browser.new_page(viewport={"width": 934, "height": 612})
    page.goto((tmp_path / "cam.html").as_uri())
    page.wait_for_function("() => globalThis.camkit?.outputs")
    first = page.evaluate("camkit.values[0]")
    press(page, f"Show {EVIL}")
    assert page.evaluate("camkit.values[0]") == pytest.approx(0.048)
    keep(page, "  mine ")
    expect(page.locator(".camkit-names summary")).to_have_text(EVIL)  # the first of two names for it
    page.get_by_role("button", name="Undo").click()
    assert page.evaluate("camkit.values[0]") == first
    expect(page.locator(".camkit-names summary")).to_have_text("Designs (2)")
    page.locator(".camkit-names summary").click()
    page.get_by_label("name for this design").fill("mine")
    expect(page.get_by_role("button", name="Replace")).to_be_enabled()
    page.evaluate("() => camkit.put([-1, ...camkit.values.slice(1)])")
    page.wait_for_function("() => camkit.sentence")
    page.get_by_label("name for this design").fill("never")
    expect(page.get_by_role("button", name="Keep", exact=True)).to_be_disabled()
    page.mouse.click(600, 300)
    expect(page.get_by_label("name for this design")).to_be_hidden()
    assert page.evaluate("globalThis.ran") is None
    page.close()


def test_designs_are_kept_in_a_narrow_window(page, notebook):
    run(page)
    page.set_viewport_size({"width": 400, "height": 768})
    page.evaluate("() => window.jupyterapp.shell.collapseLeft()")
    page.wait_for_selector(".camkit-page.camkit-narrow")
    page.locator(".camkit-names > summary").click()
    right = "(element) => element.getBoundingClientRect().right"
    assert page.locator(".camkit-naming button").evaluate(right) <= page.locator(".camkit-page").evaluate(right)
