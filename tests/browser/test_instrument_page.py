"""The instrument in JupyterLab: the page computes, with the kernel ended too, and the kernel knows what it shows."""

import inspect

import nbformat
import pytest
import stubborn
from playwright.sync_api import expect

from camkit import ArmLoad, DoorHandleCam, door_handle_study
from camkit.quantities import choices_of, measures_of
from camkit.views import default_views
from lab import Instrument, cell, cell_output, eventually, kernel_value, open_notebook, run_all, shown_by
from test_living_page import DRAG, compare

START = """
from camkit import ArmLoad, DoorHandleCam, deg, door_handle_study, explore
study = door_handle_study(DoorHandleCam(lift_load=ArmLoad(torque=10)))
app = explore(study.start, at_most=study.at_most, at_least=study.at_least, turn=75 * deg)
app
"""
STUBBORN = f"{inspect.getsource(stubborn)}\nfrom camkit import explore\napp = explore(Stubborn())\napp"
BUSY = """() => { const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
    kernel.requestExecute({ code: "import time; time.sleep(8)" }); }"""
STUDY = door_handle_study(DoorHandleCam(lift_load=ArmLoad(torque=10)))
LIMITS = {**STUDY.at_most, **STUDY.at_least}
PAGE = "document.querySelector('.camkit-page').parentElement.camkit"


SLOW = START.replace("\napp\n", "\nimport time\napp.on_change(lambda design: time.sleep(0.3))\napp\n")
BESIDE = (
    START.removesuffix("app\n")
    + """
import ipywidgets
beside = app.control("lift_arm")
ipywidgets.VBox([app, beside])
"""
)


@pytest.fixture
def shown(window, server):
    """Runs one cell, or more, and gives the page when its panel has drawn."""

    def show(source, name, *more):
        notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(each) for each in (source, *more)])
        notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
        nbformat.write(notebook, server.root / name)
        open_notebook(window, name)
        run_all(window)
        window.wait_for_selector(".camkit-page canvas")
        settled(window)
        return window

    return show


@pytest.fixture
def started(window, shown):
    """The page of ``START`` as it was at first; its notebook is opened unless it is open."""
    if window.evaluate("window.jupyterapp?.shell.currentWidget?.context?.path") != "started.ipynb":
        shown(START, "started.ipynb")
    kernel_value(window, "app.load(app.start)")
    Instrument(window).shows(STUDY.start, measures_of(STUDY.start))
    return window


def settled(page):
    page.wait_for_function(f"() => {PAGE}.outputs && !{PAGE}.frame")


def of_page(page):
    return shown_by(page, PAGE)


def test_everything_is_on_one_screen(started):
    page = started
    page.set_viewport_size({"width": 1366, "height": 768})
    settled(page)
    box = page.locator(".camkit-page").bounding_box()
    assert box["height"] <= 647
    assert box["width"] <= 960
    for part in ("left", "middle", "right-side", "chips", "play"):
        inner = page.locator(f".camkit-{part}").bounding_box()
        assert box["x"] <= inner["x"]
        assert inner["x"] + inner["width"] <= box["x"] + box["width"] + 1
        assert inner["y"] + inner["height"] <= box["y"] + box["height"] + 1


def test_the_kernel_moves_the_page_and_undo_moves_the_kernel(started):
    page = started
    kernel_value(page, "setattr(app, 'design', app.design.replace(lift_arm=0.052))")
    page.wait_for_function(f"() => {PAGE}.values[0] === 0.052 && !{PAGE}.frame")
    page.get_by_role("button", name="Undo").click()
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == 0.05)
    page.get_by_role("button", name="Redo").click()
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == 0.052)


def test_a_choice_is_made_by_the_kernel_and_drawn_by_the_page(started):
    page = started
    menu = page.locator(".camkit-left details", has_text="Choices")
    menu.locator("summary").click()
    select = menu.locator("select").first
    option = select.locator("option").nth(3).inner_text()
    page.evaluate(f"{PAGE}.positions.turnTo(40)")
    select.select_option(option)
    eventually(lambda: kernel_value(page, "app.design.motion_law.name") == option)
    page.wait_for_function(f"() => {PAGE}?.structure.choices[0].chosen === {option!r}")
    settled(page)
    assert page.evaluate(f"{PAGE}.positions.angle") == pytest.approx(40)
    law = STUDY.start.replace(motion_law=choices_of(STUDY.start)["motion_law"].named[option])
    compare(of_page(page), law, default_views(law.analyse()), measures_of(law), LIMITS)


def test_a_kernel_that_is_busy_stops_nothing(started):
    page = started
    page.evaluate(BUSY)
    before = page.evaluate(f"{PAGE}.shownAt")
    page.get_by_label("lift arm, mm", exact=True).focus()
    for _ in range(10):
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(30)
    settled(page)
    assert page.evaluate(f"{PAGE}.shownAt") >= before + 5
    assert of_page(page)["values"][0] == pytest.approx(0.051)


def test_a_cell_reads_what_the_page_shows_though_the_kernel_is_slow(shown):
    page = shown(SLOW, "slow.ipynb", "print(app.design.lift_arm)")
    output = cell_output(page, 1)
    first = output.inner_text()
    page.get_by_label("lift arm, mm", exact=True).focus()
    for _ in range(6):
        page.keyboard.press("ArrowRight")
    settled(page)
    moved = page.evaluate(f"{PAGE}.values[0]")
    cell(page, 1).locator(".cm-content").click()
    page.keyboard.press("Control+Enter")
    eventually(lambda: output.inner_text() not in ("", first))
    assert float(output.inner_text()) == moved
    eventually(lambda: kernel_value(page, "app.values[0]") == moved)
    assert kernel_value(page, "app.message") == ""


def test_a_number_is_typed_as_people_type(started):
    page = started
    box = page.get_by_label("lift arm, mm, number")
    for text, value in (("48,123456789", 0.048123456789), ("1 7/8 in", 0.047625), ("52.5", 0.0525)):
        box.fill(text)
        box.press("Enter")
        eventually(lambda value=value: kernel_value(page, "app.design.lift_arm") == pytest.approx(value, rel=1e-14))
        box.blur()  # the box shows fewer digits than count
        assert page.evaluate(f"{PAGE}.values[0]") == pytest.approx(value, rel=1e-14)
    box.fill("400")
    box.press("Enter")
    expect(page.locator(".camkit-over")).to_contain_text("This cannot be built: ")
    assert kernel_value(page, "app.design.lift_arm") == pytest.approx(0.0525)
    box.fill("abc")
    box.press("Enter")
    expect(page.locator(".camkit-refusal:not(:empty)")).to_contain_text("is no number")


def test_what_does_not_record_is_computed_by_the_kernel(shown):
    page = shown(STUBBORN, "stubborn.ipynb")
    page.evaluate(DRAG, [0.8, 0])
    page.wait_for_function(f"() => {PAGE}.numbers && Math.abs({PAGE}.values[0] - 0.00322) < 1e-9 && !{PAGE}.frame")
    eventually(lambda: of_page(page)["pictures"][0]["marks"][0]["y"][-1] == "3.22")


def test_the_page_computes_with_the_kernel_ended(shown, server):
    page = shown(START, "instrument.ipynb")
    views = default_views(STUDY.start.analyse())
    compare(of_page(page), STUDY.start, views, measures_of(STUDY.start), LIMITS)
    slider = page.get_by_label("lift arm, mm", exact=True)
    slider.focus()
    page.keyboard.press("ArrowRight")
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == pytest.approx(0.0501))  # a step to the right
    assert kernel_value(page, "app.message") == ""  # page and kernel agree in every measure
    page.evaluate("() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.restart()")
    expect(page.locator(".camkit-note")).to_contain_text("No kernel knows this page: it computes by itself")
    server.end_kernels()
    for k in range(5):
        page.keyboard.press("ArrowRight")
        page.evaluate(DRAG, [0.4, 2 + k])
    settled(page)
    found = of_page(page)
    assert found["values"][0] == pytest.approx(0.0506)
    compare(found, STUDY.start, views, measures_of(STUDY.start), LIMITS)


def test_an_ordinary_slider_beside_it_leaves_the_design_as_it_is_typed(shown):
    page = shown(BESIDE, "beside.ipynb")
    steps = page.evaluate(f"{PAGE}.history.past.length")
    for text, value in (("50.013", 0.050013), ("47.6251", 0.0476251)):
        box = page.get_by_label("lift arm, mm, number")
        box.fill(text)
        box.press("Enter")
        eventually(lambda value=value: kernel_value(page, "beside.value") == pytest.approx(1000 * value, rel=1e-12))
        page.wait_for_timeout(400)  # what it sends back would be here
        assert kernel_value(page, "app.design.lift_arm") == pytest.approx(value, rel=1e-12)
    assert page.evaluate(f"{PAGE}.history.past.length") == steps + 2
    page.locator(".widget-slider .noUi-handle").press("ArrowRight")
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == pytest.approx(0.04764, abs=1e-9))
    page.wait_for_function(f"() => Math.abs({PAGE}.values[0] - 0.04764) < 1e-9")
