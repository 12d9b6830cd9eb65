"""Names that are pieces of a page: every panel, table and report shows them letter by letter, and nothing runs."""

from __future__ import annotations

import json
import re

import nbformat
import pytest
from playwright.sync_api import BrowserContext, Page, expect

from lab import LabServer, cell_output, kernel_value, open_notebook, run_all

EVIL = (
    "<img src=x onerror=\"window.ran=1\" class='evil'>'\"</script><script>window.ran=1</script>\n<b class=evil>$x$|`y`"
)

DESIGN = (
    f"EVIL = {EVIL!r}\n"
    + """
from dataclasses import dataclass
import numpy as np
from camkit import *
from camkit import contour_panel, tolerance_panel, compare_fronts, shortlist, choose_panel, edit_program, presets
from camkit import study_panel
from camkit.papers.published import Comparison, Row, Table
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.views.picture import Axes, Picture, Points
from camkit.quantities import Design, Measure, quantity
from camkit.decision import side_by_side

@dataclass(frozen=True)
class Evil(Design):
    x: float = quantity(EVIL, 1, 0.1, 4, "mm", EVIL)
    y: float = quantity(EVIL, 2, 0.1, 4, "mm", EVIL)
    def analyse(self, n=361):
        return Made(self)

@dataclass(frozen=True)
class Made:
    cam: Evil
    cam_angle = np.linspace(0, 1, 5)

class EvilLaw(Cycloidal):
    name = EVIL

def measure(i, of):
    return Measure(f"{EVIL} {i}", "mm", lambda a: np.ravel(of(a.cam)) if np.ndim(a.cam.x) else of(a.cam))

first, second = measure(1, lambda c: c.x + c.y), measure(2, lambda c: 3 * c.y - 2 * c.x)
limited = measure(3, lambda c: 2 * c.x)
space = {"x": (0.5 * mm, 3 * mm), "y": (0.5 * mm, 3 * mm)}

def study(start=Evil(), weights=None, reference=None, space=space):
    return Study(start, space, (first, second), at_most={limited: 5 * mm})

def view(analysis):
    point = Points("point", [analysis.cam.x], [analysis.cam.y], label=EVIL)
    return Picture(Axes(title=EVIL, xlabel=EVIL, ylabel=EVIL), (point,))"""
)

PANELS = (
    "app = explore(Evil(), view, measures=(first, second, limited), at_most={limited: 1 * mm})\napp",
    "kept = shortlist(app, study())\nkept.keep()\nkept",
    "judged = ahp_panel(Judgements([EVIL, 'b'], [3]), EVIL)\njudged.boxes[0, 1].value = EVIL\njudged",
    "found = pareto_panel(app, {EVIL: study()}, space=space, free=['x', 'y'], population=24, generations=3)\n"
    "found.run()\nfound.wait()\nfound",
    "choose_panel(found)",
    "live_pareto_panel(app, {EVIL: study()}, space)",
    "compare_fronts(app, given={EVIL: found.front})",
    "contour_panel(app, {EVIL: Study(Evil(), space, (first,), at_most={limited: 5 * mm})}, {'x': 1.0})",
    "tolerance_panel(app, study())",
    "study_panel(app, study())",
    "presets(app, {EVIL: {EVIL: lambda design: design}}, {EVIL: lambda design: design})",
    "edit_program(MotionProgram((Rise(2.0, 0.01, EvilLaw()), Dwell(1.0), Return(2.0, 0.01, EvilLaw()))))",
    "Evil()",
    "Comparison(EVIL, EVIL, [Row(EVIL, EVIL, '3.1', 4.0, EVIL)], EVIL)",
    "Table((EVIL, 'b'), [(EVIL, 1.0)], EVIL)",
    "table = side_by_side({EVIL: Evil(), 'b': Evil(x=2 * mm)}, (first, second), study())\ntable",
    "from IPython.display import Markdown\nMarkdown(table.markdown(EVIL))",
    "found.load_json(evil_study)\nfound",
)


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Page:
    cells = [DESIGN, f"evil_study = {json.dumps({'schema': EVIL})!r}", *PANELS]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in cells])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "hostile.ipynb")
    open_notebook(window, "hostile.ipynb")
    window.evaluate("window.ran = 0")
    run_all(window, pictures=True)
    return window


# Waits until another image that does not exist has said so: one that is on the page would have, too.
MISSING = """() => new Promise(resolve => {
    const image = new Image();
    image.onerror = resolve;
    image.src = 'x?' + Date.now();
})"""


def assert_nothing_ran(page: Page) -> None:
    page.evaluate(MISSING)
    assert page.evaluate("window.ran") == 0
    assert page.locator(".evil").count() == 0
    assert page.locator("img[src=x], img[onerror]").count() == 0


@pytest.mark.parametrize("i", range(len(PANELS)))
def test_a_name_makes_no_element(page: Page, i: int) -> None:
    output = cell_output(page, 2 + i)
    expect(output).to_be_visible()
    expect(output.locator(".camkit-panel, .camkit-sheet, .camkit-page, table").first).to_be_visible()
    assert_nothing_ran(page)
    shown = output.inner_text() + " ".join(output.locator("select").all_inner_texts())
    assert "<img src=x" in shown or "edit_program" in PANELS[i], shown


def test_a_page_that_was_saved_makes_no_element(page: Page, context: BrowserContext) -> None:
    told = kernel_value(page, "kept.html()")
    saved = context.new_page()
    saved.set_content(f"<script>window.ran = 0</script>{told}")
    assert_nothing_ran(saved)
    expect(saved.locator("td").filter(has_text=re.compile("img src=x")).first).to_be_visible()
    saved.close()


def test_a_sentence_makes_no_element(page: Page) -> None:
    explorer = cell_output(page, 2)
    box = explorer.locator(".camkit-left .camkit-box input").first
    box.fill(EVIL.replace("\n", " "))
    box.press("Enter")
    expect(explorer.locator(".camkit-refusal:not(:empty)")).to_contain_text("is no number")
    assert_nothing_ran(page)
