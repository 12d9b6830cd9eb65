"""From a table that is dropped on an instrument to a robust design, by clicks alone; and back to it after a restart."""

from __future__ import annotations

import base64
import re
from pathlib import Path

import nbformat
import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from camkit import deg
from lab import eventually, kernel_value, open_notebook, run_all, screenshot

TABLES = Path(__file__).parents[1] / "data" / "tables"
SHOTS = Path(__file__).parents[2] / ".browser"
LOBE = (TABLES / "lobe_european.csv").read_bytes()
CRANK = "".join(f"{2 * x};{9 - 9 * np.cos(x * deg) + (x == 90) * 0.2:.4f}\n" for x in range(360)).encode()
SOURCE = """
from camkit import TranslatingFlatCam, explore
from camkit.cam import min_profile_radius
from camkit.units import mm

app = explore(TranslatingFlatCam(base_radius=30 * mm), at_least={min_profile_radius: 3 * mm})
app"""
PANEL = "document.querySelector('.camkit-page').parentElement.camkit"
MARGIN = "minimum convex radius of curvature, profile"
DROP = """([kind, name, base64]) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)), dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], name));
    const event = new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true });
    document.querySelector('.camkit-left').dispatchEvent(event);
    return event.defaultPrevented;
}"""
RESTART = "() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.restart()"
TIMES = f"""() => {{ // ms of one computation and drawing, the median of some, while a slider moves
    const panel = {PANEL}, times = [];
    const k = panel.structure.quantities.findIndex((one) => one.name === 'base radius');
    for (let i = 0; i < 15; i++) {{
        const values = panel.values.slice(), begun = performance.now();
        values[k] += i * 1e-5;
        panel.engine.run(values);
        times.push(performance.now() - begun);
    }}
    return times.sort((a, b) => a - b)[7];
}}"""


def drag(page: Page, name: str, data: bytes, *kinds: str) -> list[bool]:
    """A file over the panel, as a browser tells of it; and whether the panel takes it from the browser."""
    return [page.evaluate(DROP, [kind, name, base64.b64encode(data).decode()]) for kind in kinds]


@pytest.fixture
def panel(page: Page, server, request) -> Page:
    """A notebook with a cam under sliders, on a small screen."""
    page.set_viewport_size({"width": 1366, "height": 768})
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SOURCE)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    name = f"{request.node.name}.ipynb"
    nbformat.write(notebook, server.root / name)
    open_notebook(page, name)
    run(page)
    return page


def run(page: Page) -> None:
    run_all(page)
    page.wait_for_selector(".camkit-page canvas")


def dock(page: Page) -> Locator:
    return page.locator(".camkit-dock:visible")


def choose(page: Page, name: str, option: str) -> None:
    """An option of a menu by the keyboard alone."""
    menu = dock(page).get_by_label(name, exact=True)
    menu.focus()
    menu.press_sequentially(option)
    menu.blur()


def type_in(page: Page, name: str, text: str) -> None:
    box = dock(page).get_by_label(name, exact=True)
    box.fill(text)
    box.press("Enter")


def table_of(page: Page) -> bool:
    return kernel_value(page, "type(app.design.motion).__name__") == "TableMotion"


def test_from_a_dropped_table_to_a_robust_design(panel):
    page, over = panel, panel.locator(".camkit-drop")
    assert drag(page, "lobe.csv", LOBE, "dragenter", "dragover") == [True, True]
    expect(over).to_have_text(
        "Drop a saved design (JSON), the table of a motion or the outline of a cam (CSV, TXT, XLSX, DXF)"
    )
    screenshot(page, SHOTS / "drop_over.png")
    drag(page, "lobe.csv", LOBE, "drop")
    expect(over).to_be_hidden()
    page.get_by_role("tab", name="Table", exact=True, selected=True).wait_for()
    dock(page).get_by_text(
        "Semicolons and decimal commas, angles in deg (of the cam), levels in mm, 141 rows"
    ).wait_for()
    expect(dock(page).locator("canvas")).to_have_count(4)
    expect(page.locator(".camkit-chips")).to_contain_text("4.333 mm")
    expect(page.locator(".camkit-note:visible")).to_have_count(0)  # page and kernel agree
    screenshot(page, SHOTS / "drop_table.png")
    assert dock(page).evaluate("dock => dock.scrollWidth <= dock.clientWidth")

    with page.expect_file_chooser() as chosen:
        page.get_by_role("button", name="Motion from a table").press("Enter")
    chosen.value.set_files({"name": "crank.csv", "mimeType": "text/csv", "buffer": CRANK})
    dock(page).get_by_text("The angles span 718 °, more than a turn of the cam. What are they in?").wait_for()
    screenshot(page, SHOTS / "drop_asks.png")
    dock(page).get_by_text("The motion stays as it was until then.").wait_for()
    dock(page).get_by_role("button", name="degrees of a crank that turns twice as often").press("Enter")
    dock(page).get_by_text("Row 91 at 90 ° is 0.2 mm off the curve through the others: left out.").wait_for()
    eventually(lambda: kernel_value(page, "float(app.design.motion(3.14159265).s)") == pytest.approx(0.018, abs=1e-5))
    screenshot(page, SHOTS / "drop_bad_row.png")
    page.get_by_role("button", name="Undo").click()
    dock(page).get_by_text("141 rows").wait_for()
    page.get_by_label("base radius, mm", exact=True).press("ArrowRight")
    eventually(lambda: kernel_value(page, "app.design.base_radius > 0.03 and len(app.design.motion.row_levels)") == 141)
    dock(page).get_by_role("combobox", name="ends").select_option("free")
    dock(page).get_by_text("agree with a rest at both").wait_for(state="hidden")
    page.get_by_role("button", name="Undo").click()
    dock(page).get_by_text("agree with a rest at both").wait_for()
    expect(dock(page).get_by_role("combobox", name="ends")).to_have_value("0")

    page.get_by_role("tab", name="Study").click()
    choose(page, "base radius (pitch): make it", "small")
    type_in(page, f"{MARGIN}, at least, mm", "3")
    type_in(page, "find a quantity", "base radius")
    dock(page).get_by_text("Size (1)").wait_for()
    dock(page).get_by_label("base radius", exact=True).check()
    dock(page).get_by_label("made within tolerances, yield at least").check()
    dock(page).get_by_role("button", name="Find", exact=True).click()
    page.get_by_role("tab", name="Optimise", selected=True).wait_for()
    page.get_by_text("At their limits").wait_for()
    chip = page.locator(".camkit-chips .camkit-chip").first
    expect(chip).to_have_text(re.compile(r"yield (99|100)\.\d % \(.* to .*\)"))
    assert kernel_value(page, "0.0288 < app.design.base_radius < 0.0295") is True
    assert table_of(page)
    screenshot(page, SHOTS / "drop_robust.png")

    found = kernel_value(page, "app.design.base_radius")
    eventually(lambda: kernel_value(page, "app.page['tab']") == "Optimise")
    page.evaluate(RESTART)
    run(page)
    assert not table_of(page)
    page.locator(".camkit-offer").get_by_role("button", name="Continue").click()
    page.get_by_role("tab", name="Table", exact=True).click()
    dock(page).get_by_text("141 rows").wait_for()
    assert kernel_value(page, "app.design.base_radius") == pytest.approx(found, abs=1e-12)
    assert table_of(page)


def test_thousands_of_rows_move_as_fast_as_any_motion(panel):
    page, x = panel, np.arange(0, 360, 0.05)
    before = page.evaluate(TIMES)
    y = 9 - 9 * np.cos(x * deg) + 0.05 * np.sin(97 * x * deg)
    drag(page, "many.csv", "".join(f"{a:.2f};{b:.5f}\n" for a, b in zip(x, y, strict=True)).encode(), "drop")
    dock(page).get_by_text("7200 rows").wait_for()
    eventually(lambda: page.evaluate(f"() => !{PANEL}.structure.pictures.some((one) => one.still)") is True)
    after = page.evaluate(TIMES)
    assert after < 3 * before + 10
    screenshot(page, SHOTS / "drop_many.png")


def test_what_is_no_table_is_refused_and_what_is_no_file_is_left_to_the_browser(panel):
    page = panel
    drag(page, "photo.csv", b"\x89PNG" + bytes(99), "drop")
    dock(page).get_by_text("This table cannot be used: the file is a PNG picture").wait_for()
    assert not table_of(page)
    words = """() => { const options = { dataTransfer: new DataTransfer(), bubbles: true, cancelable: true };
        const event = new DragEvent('dragover', options);
        document.querySelector('.camkit-left').dispatchEvent(event);
        return event.defaultPrevented; }"""
    assert page.evaluate(words) is False
