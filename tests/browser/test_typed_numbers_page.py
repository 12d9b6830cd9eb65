"""Numbers as people type them: the number that is meant, or a sentence, and never another number."""

from __future__ import annotations

import re

import nbformat
import pytest
from playwright.sync_api import Locator, Page, expect

from lab import LabServer, cell_output, eventually, kernel_value, open_notebook, run_all

CELLS = (
    """
from camkit import *
from camkit import edit_program
from camkit.views import mechanism
app = explore(TranslatingRollerCam(groove=False), mechanism, free=["base_radius", "roller_radius"])
app""",
    """
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
editor = edit_program(MotionProgram((Rise(100 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg),
                                     Return(100 * deg, 20 * mm, Cycloidal()), Dwell(100 * deg))))
editor""",
    """
finder = pareto_panel(explore(DoorHandleCam(), free=["lift_arm"], *[mechanism]), 
                      door_handle_study(space={"lift_arm": (45 * mm, 55 * mm)}))
finder""",
)


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Page:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in CELLS])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "typed.ipynb")
    open_notebook(window, "typed.ipynb")
    run_all(window)
    return window


def type_into(box: Locator, text: str) -> None:
    """Key by key, as a person does it."""
    box.click()
    box.press("Control+a")
    box.press_sequentially(text)
    box.press("Enter")


HEARD = """() => [...document.querySelectorAll('.camkit-sheet')].map((root) => root.parentElement.camkit)
    .every((sheet) => !sheet?.model || sheet.answered >= sheet.asked)"""  # no answer is under way
TAKEN = [("48,09", 48.09), ("1e1", 10.0), ("  12,5 ", 12.5), ("30.25", 30.25), ("1 in", 25.4), ("60,5mm", 60.5)]
REFUSED = ["2 kg", "abc", "1.234,5", "1,234.5", "1,234", "--5", "12abc", "∞", "nan", "1_0", ""]


def base_radius(page: Page) -> tuple[Locator, Locator]:
    """The box of the base radius, and where a page says why a text was not taken."""
    row = cell_output(page, 0).locator(".camkit-row").filter(has=page.get_by_label("base radius, mm, number"))
    return row.get_by_role("textbox"), row.locator(".camkit-refusal")


@pytest.mark.parametrize(("typed", "meant"), TAKEN)
def test_a_number_is_taken_as_it_is_meant(page: Page, typed: str, meant: float) -> None:
    box, _ = base_radius(page)
    type_into(box, typed)
    eventually(lambda: abs(1000 * kernel_value(page, "app.design.base_radius") - meant) < 1e-9)
    expect(box).to_have_value(f"{meant:g}")


@pytest.mark.parametrize("typed", REFUSED)
def test_what_is_no_number_is_refused_and_the_last_one_stays(page: Page, typed: str) -> None:
    box, refusal = base_radius(page)
    type_into(box, "30,25")
    expect(refusal).to_be_empty()
    if typed:
        type_into(box, typed)
    else:
        box.fill("")
        box.press("Enter")
    expect(refusal).not_to_be_empty()
    assert kernel_value(page, "app.design.base_radius") == pytest.approx(0.03025, abs=1e-12)
    expect(cell_output(page, 0).locator("canvas").first).to_be_visible()


@pytest.mark.parametrize("typed", ["1e160", "1e300"])
def test_a_number_far_too_large_leaves_a_page_that_lives(page: Page, typed: str) -> None:
    box, _ = base_radius(page)
    type_into(box, typed)
    expect(cell_output(page, 0).locator("canvas").first).to_be_visible()
    cell_output(page, 0).get_by_role("button", name="Reset").click()
    eventually(lambda: bool(kernel_value(page, "app.design == app.start")))
    expect(box).to_have_value("30")


def test_a_row_of_the_program_takes_a_comma_and_refuses_the_rest(page: Page) -> None:
    panel = cell_output(page, 1)
    lift, back = (panel.get_by_role("group", name=f"segment {k}").get_by_role("textbox", name="lift") for k in (1, 3))
    for box in (lift, back):
        type_into(box, "12,5")
    eventually(lambda: kernel_value(page, "float(editor.program.segments[0].lift)") == pytest.approx(0.0125))
    type_into(lift, "abc")
    expect(panel.get_by_role("alert").filter(has_text="'abc' is no number")).to_be_visible()
    assert kernel_value(page, "float(editor.program.segments[0].lift)") == pytest.approx(0.0125)


def test_counts_and_bounds_of_a_search_are_read_the_same_way(page: Page) -> None:
    panel = cell_output(page, 2)
    population = panel.get_by_label("population")
    type_into(population, "60")
    eventually(lambda: kernel_value(page, "finder.population.value") == 60)
    page.wait_for_function(HEARD)
    for typed in ("1.5", "2000", "12abc", "-4"):
        type_into(population, typed)
        expect(panel.locator(".camkit-refusal").filter(has_text=re.compile("from 4 to 1000|not known"))).to_be_visible()
        assert kernel_value(page, "finder.population.value") == 60
    low = panel.get_by_label("lift arm, from, mm")
    type_into(low, "46,5")
    eventually(lambda: kernel_value(page, "finder.bounds['lift_arm'].value[0]") == pytest.approx(0.0465))
