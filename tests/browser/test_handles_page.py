"""Handles on the curve that motion laws shape: what a drag makes of it is what the package computes."""

import nbformat
import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, OscillatingRollerCam
from camkit.machines import high_speed_measures as fast
from camkit.quantities import quantities_of, with_quantities
from camkit.render.living import living
from lab import Instrument, eventually, kernel_value, open_notebook, run_all, shown_by

CELL = """
from camkit import HighSpeedCam, explore
from camkit.machines.high_speed_measures import HIGH_SPEED_MEASURES
app = explore(HighSpeedCam(), free=["arm_length", "rise_law.c0", "rise_law.c1"], measures=HIGH_SPEED_MEASURES)
app
"""
DRAWN = "() => globalThis.camkit?.outputs && !camkit.frame"
PLACED = "() => camkit.handles.known && !camkit.frame && !camkit.handles.idle.steps"
DESIGN = HighSpeedCam()
C1 = list(quantities_of(DESIGN)).index("rise_law.c1")


@pytest.fixture
def opened(browser, tmp_path):
    """Opens the page of a design whose quantities at some paths are free."""
    pages = []

    def open_page(design, free, **options):
        path = tmp_path / "design.html"
        path.write_text(living(design, free=free, measures=[]).html(), encoding="utf-8")
        page = browser.new_page(viewport={"width": 934, "height": 600}, **options)
        pages.append(page)
        page.goto(path.as_uri())
        page.wait_for_function(DRAWN)
        return page

    yield open_page
    for page in pages:
        page.close()


def handle(page, name="rise shape 2"):
    return page.get_by_role("slider", name=f"{name}, handle on the curve Acceleration")


def middle(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def acceleration(page):
    """The curve as it is drawn, and the values of all quantities."""
    shown = shown_by(page)
    (curve,) = [p for p in shown["pictures"] if p["name"] == "acceleration"]
    (line,) = [mark for mark in curve["marks"] if mark["key"] == "curve"]
    return np.array(line["y"], dtype=float), shown["values"]


def test_a_handle_takes_the_curve_along_and_its_coefficient_with_it(opened):
    page = opened(DESIGN, fast.COEFFICIENTS)
    page.wait_for_function(PLACED)
    assert page.locator(".camkit-handle").count() == len(fast.COEFFICIENTS)
    before, _ = acceleration(page)
    taken = handle(page)
    x, y = middle(taken.bounding_box())
    page.mouse.move(x, y)
    page.mouse.down()
    for down in range(6, 31, 6):
        page.mouse.move(x + 5, y + down)
        page.wait_for_function(DRAWN)
    assert_allclose(middle(taken.bounding_box()), (x, y + 30), atol=0.7)  # below the pointer, at its own angle
    page.mouse.up()
    page.wait_for_function(DRAWN)
    drawn, values = acceleration(page)
    assert values[C1] > 0.05
    assert float(page.get_by_label("rise shape 2, number").input_value()) == pytest.approx(values[C1])
    expected = with_quantities(DESIGN, {"rise_law.c1": values[C1]}).analyse().acceleration
    assert_allclose(drawn, expected, rtol=0, atol=1e-9 * abs(expected).max())
    assert page.evaluate("camkit.history.past.length") == 1
    page.keyboard.press("Control+z")
    page.wait_for_function(f"() => camkit.values[{C1}] === 0 && !camkit.frame")
    assert_allclose(acceleration(page)[0], before, rtol=0, atol=1e-12)


def test_handles_are_not_placed_anew_while_one_is_held(opened):
    """It is pressed again before the slopes of the last design are known."""
    page = opened(DESIGN, fast.COEFFICIENTS)
    page.wait_for_function(PLACED)
    page.mouse.move(*middle(handle(page).bounding_box()))
    page.evaluate("camkit.handles.idle.begin(camkit.handles._search(camkit.values.slice(), 'late'), 200)")
    page.mouse.down()
    page.wait_for_timeout(600)
    assert page.evaluate("camkit.handles.known") != "late"
    page.mouse.up()


def test_a_handle_stays_within_the_range_of_its_slider(opened):
    page = opened(DESIGN, fast.COEFFICIENTS)
    page.wait_for_function(PLACED)
    x, y = middle(handle(page).bounding_box())
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 3000)
    page.mouse.up()
    page.wait_for_function(f"() => camkit.values[{C1}] === 0.6 && !camkit.frame")
    page.wait_for_function(PLACED)
    assert handle(page).is_visible()  # and can be taken back from there


def test_keys_on_a_handle_step_its_coefficient_and_name_it(opened):
    page = opened(DESIGN, fast.COEFFICIENTS)
    page.wait_for_function(PLACED)
    taken, step = handle(page), float(page.get_by_label("rise shape 2", exact=True).get_attribute("step"))
    top = middle(taken.bounding_box())[1]
    taken.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowRight")
    page.wait_for_function(DRAWN)
    assert page.evaluate(f"camkit.values[{C1}]") == pytest.approx(11 * step)
    assert taken.get_attribute("aria-valuenow") == str(11 * step)
    assert page.evaluate("camkit.history.past.length") == 2
    down = middle(taken.bounding_box())[1]
    assert down > top
    page.keyboard.press("ArrowUp")  # the curve goes up, whatever that makes of the coefficient
    page.wait_for_function(DRAWN)
    assert middle(taken.bounding_box())[1] < down
    assert page.evaluate(f"camkit.values[{C1}]") == pytest.approx(10 * step)
    assert page.locator(".camkit-row.camkit-lit").inner_text().startswith("Rise shape 2")


def test_a_finger_drags_it(opened):
    page = opened(DESIGN, fast.COEFFICIENTS, has_touch=True)
    page.wait_for_function(PLACED)
    x, y = middle(handle(page).bounding_box())
    touch = page.context.new_cdp_session(page)
    for kind, down in (("touchStart", 0), ("touchMove", 12), ("touchMove", 24)):
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y + down}]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    page.wait_for_function(DRAWN)
    assert page.evaluate(f"camkit.values[{C1}]") > 0.04
    box = handle(page).bounding_box()
    assert min(box["width"], box["height"]) >= 24
    assert handle(page).evaluate("handle => getComputedStyle(handle).touchAction") == "none"


def test_there_are_none_without_free_coefficients_and_any_cam_with_some_has_them(opened):
    page = opened(DESIGN, ["arm_length", "roller_radius"])
    assert page.locator(".camkit-handle").count() == 0
    arm = with_quantities(OscillatingRollerCam(), {"motion.rise.law": "shaped"})
    page = opened(arm, ["motion.rise.law.c0", "motion.rise.law.c3", "arm_length"])
    page.wait_for_function(PLACED)
    assert page.locator(".camkit-handle").count() == 2
    assert all(box.is_visible() for box in page.locator(".camkit-handle").all())


def test_in_jupyterlab_the_kernel_has_the_coefficient_too(page, server):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "handles.ipynb")
    open_notebook(page, "handles.ipynb")
    run_all(page)
    app, taken = Instrument(page), handle(page)
    taken.scroll_into_view_if_needed()
    x, y = middle(taken.bounding_box())
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 20, steps=4)
    page.mouse.up()
    c1 = app.shown()["values"][C1]
    assert c1 > 0.03
    app.shows(with_quantities(DESIGN, {"rise_law.c1": c1}), fast.HIGH_SPEED_MEASURES)
    step = float(app.slider("rise shape 2").get_attribute("step"))
    taken.focus()
    page.keyboard.press("ArrowRight")
    eventually(lambda: kernel_value(page, "app.design.rise_law.c[1]") == pytest.approx(c1 + step))
