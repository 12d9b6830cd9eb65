"""What every panel owes to a person: it follows the hand, it fits the window, it can be read and heard."""

import time
from collections.abc import Iterator

import nbformat
import pytest
from playwright.sync_api import Locator, Page, expect

from lab import Instrument, LabServer, cell_output, eventually, kernel_value, open_notebook, run_all

EXPLORER = """
from camkit import DoorHandleCam, Judgements, ahp_panel, deg, door_handle_study, explore
from camkit.machines.door_handle import CURVE_TABLE

study = door_handle_study()
app = explore(DoorHandleCam(), free=["lift_arm", "relief_arm", "motion_law"], measures=CURVE_TABLE,
              at_most=study.at_most, turn=75 * deg)
moves = []
app.on_change(lambda design: moves.append(design.lift_arm))
app"""

# The contrast of an element's letters with what lies behind them, as WCAG 2 reckons it.
CONTRAST = """(element) => {
    const channels = (colour) => colour.match(/[\\d.]+/g).map(Number);
    const luminance = (colour) => channels(colour).slice(0, 3)
        .map(c => c / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    let behind = element;
    const seen = (e) => getComputedStyle(e).backgroundColor;
    while (behind.parentElement && (channels(seen(behind))[3] ?? 1) < 1) behind = behind.parentElement;
    const [low, high] = [luminance(getComputedStyle(element).color), luminance(seen(behind))].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
}"""

# JupyterLab hides everything for a moment while it takes another theme: the pictures are drawn in it nevertheless.
DARK = "root => root.parentElement.camkit.charts.every(({ how, size }) => how.dark && size?.width)"

# Everything in the panel whose content is wider than itself.
TOO_NARROW = """(panel) => [panel, ...panel.querySelectorAll('*')]
    .filter(e => e.clientWidth && e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX !== 'visible')
    .filter(e => !e.matches(".camkit-said, .camkit-row label, .camkit-name, b[title]")) // heard alone; or told whole
    .map(e => `${e.outerHTML.slice(0, 120)} ${e.scrollWidth} > ${e.clientWidth}`)"""


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Iterator[Page]:
    cells = [EXPLORER, "ahp_panel(Judgements(['pressure angle', 'contact force', 'cam torque'], [1, 1, 1]))"]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in cells])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "panels.ipynb")
    open_notebook(window, "panels.ipynb")
    run_all(window)
    toggle = "window.jupyterapp.commands.execute('application:toggle-left-area')"
    window.evaluate(toggle)  # more room for the notebook
    yield window
    window.evaluate(toggle)


@pytest.fixture
def explorer(page: Page) -> Locator:
    return cell_output(page, 0)


def test_after_a_fast_drag_the_last_value_is_shown_and_nothing_queues(page: Page, explorer: Locator) -> None:
    handle = explorer.get_by_label("lift arm, mm", exact=True)
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for i in range(60):
        page.mouse.move(x + 40 - abs(i - 40), y)
    page.mouse.up()
    last = Instrument(page).shown()["values"][0]
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == pytest.approx(last, rel=1e-12))
    moves = kernel_value(page, "moves")
    assert moves[-1] == pytest.approx(last, rel=1e-12)
    assert 1 <= len(moves) < 60  # those in between were left out
    time.sleep(0.5)
    assert kernel_value(page, "moves") == moves  # nothing comes after


def test_everything_can_be_reached_with_the_tab_key(page: Page, explorer: Locator) -> None:
    wanted = {"lift arm, mm", "relief arm, mm", "motion law", "Reset", "Open", "Export"}
    Instrument(page).slider("lift arm, mm").focus()
    page.keyboard.press("Shift+Tab")
    met = set()
    for _ in range(25):
        met.add(page.evaluate("document.activeElement.ariaLabel || document.activeElement.textContent.trim()"))
        page.keyboard.press("Tab")
    explorer.get_by_role("button", name="Reset").focus()
    for _ in range(12):
        met.add(page.evaluate("document.activeElement.ariaLabel || document.activeElement.textContent.trim()"))
        page.keyboard.press("Tab")
    assert wanted <= met


# 853 x 480 is 1280 x 720 at a zoom of 150 %.
@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080), (853, 480)])
def test_the_panels_fit_the_window(page: Page, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    for i in range(2):
        panel = cell_output(page, i).locator(".camkit-page, .camkit-panel, .camkit-sheet")
        page.wait_for_timeout(300)  # the page is laid out anew
        assert panel.evaluate(TOO_NARROW) == []


def test_the_panels_can_be_read_in_the_dark(page: Page, explorer: Locator) -> None:
    change = "theme => window.jupyterapp.commands.execute('apputils:change-theme', {theme})"
    page.evaluate(change, "JupyterLab Dark")
    expect(page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
    try:
        for word in (explorer.get_by_text("relief arm").first, explorer.locator(".camkit-chips > *").first):
            eventually(lambda word=word: word.evaluate(CONTRAST) > 4.5, seconds=5)
        eventually(lambda: explorer.locator(".camkit-page").evaluate(DARK))
    finally:
        page.evaluate(change, "JupyterLab Light")
