"""The Study tab in JupyterLab: from wishes and ticks to a design that was found, without a line of code."""

import nbformat
import pytest

from lab import eventually, kernel_value, open_notebook, run_all

SOURCE = """
from camkit import TranslatingRollerCam, explore
from camkit.cam import ContactPair
from camkit.quantities import with_quantities
from camkit.units import rpm

app = explore(with_quantities(TranslatingRollerCam(contact=ContactPair()), {"load.speed": 1200 * rpm}))
app"""
PANEL = "document.querySelector('.camkit-page').parentElement.camkit"
PRESSURE = "dict((m.name, now) for m, now, _ in app.rows())['peak contact pressure'] / 1e6"


def choose(dock, name, option):
    """An option of a menu by the keyboard alone."""
    menu = dock.get_by_label(name, exact=True)
    menu.focus()
    menu.press_sequentially(option)
    menu.blur()


def type_in(dock, name, text):
    box = dock.get_by_label(name, exact=True)
    box.fill(text)
    box.press("Enter")


def test_from_wishes_and_ticks_to_the_design_that_is_found(page, server):
    page.set_viewport_size({"width": 1366, "height": 768})
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SOURCE)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "wishes.ipynb")
    open_notebook(page, "wishes.ipynb")
    run_all(page)
    page.wait_for_selector(".camkit-page canvas")
    assert kernel_value(page, "len(app.tabs)") == 0  # it costs nothing before it is looked at
    page.get_by_role("tab", name="Study").click()
    dock = page.locator(".camkit-dock:visible")
    dock.get_by_role("button", name="Find", exact=True).click()
    sentence = "This cannot be searched: nothing is to be small or large; choose it for one measure or more."
    dock.get_by_text(sentence).wait_for()

    choose(dock, "peak contact pressure: make it", "small")
    choose(dock, "minimum contact force: keep it", "at least")
    type_in(dock, "minimum contact force, at least, N", "1,0e1")
    choose(dock, "maximum pressure angle: keep it", "at most")
    type_in(dock, "maximum pressure angle, at most, deg", "0.4363323 rad")
    dock.get_by_text(sentence).wait_for(state="hidden")
    type_in(dock, "find a quantity", "spring")
    dock.get_by_text("Load (2)").wait_for()
    for name in ("spring rate", "spring preload"):
        dock.get_by_label(name, exact=True).press(" ")
    told = (
        "at most 25 °: maximum pressure angle; at least 10 N: minimum contact force; free: spring rate, spring preload"
    )
    dock.get_by_text(told).wait_for()
    assert dock.evaluate("dock => dock.scrollWidth <= dock.clientWidth")
    steps = page.evaluate(f"() => {PANEL}.history.past.length")
    dock.get_by_role("button", name="Find", exact=True).click()
    page.get_by_role("tab", name="Optimise", selected=True).wait_for()
    page.get_by_text("At their limits: the minimum contact force 10 N").wait_for()
    eventually(lambda: kernel_value(page, PRESSURE) == pytest.approx(305.6, abs=0.1))
    shown = f"() => {PANEL}.shown().measures.find((m) => m.name === 'peak contact pressure').value / 1e6"
    eventually(lambda: page.evaluate(shown) == pytest.approx(305.6, abs=0.1))
    assert page.evaluate(f"() => {PANEL}.history.past.length") == steps + 1

    page.get_by_role("tab", name="Study").click()
    kernel_value(page, "setattr(app, 'design', app.design.replace(rotation=-1))")  # of another make
    page.wait_for_function(f"() => {PANEL}.structure.choices.some((choice) => choice.chosen === 'clockwise')")
    dock.get_by_text(told).wait_for()  # what was asked for stays
    kernel_value(page, "setattr(app, 'design', app.design.replace(rotation=1))")
    dock.get_by_text(told).wait_for()
    page.get_by_role("tab", name="Optimise").click()
    kept = "'Optimise' == app.page['tab'] and 'peak contact pressure' in app.page['study']"
    eventually(lambda: kernel_value(page, kept) is True)

    page.get_by_role("tab", name="Study").click()
    choose(dock, "maximum pressure angle: make it", "small")
    type_in(dock, "find a quantity", "base")
    dock.get_by_text("Size (1)").wait_for()
    dock.get_by_label("base radius", exact=True).check()
    dock.get_by_role("button", name="Find", exact=True).click()
    page.get_by_role("tab", name="Live front", selected=True).wait_for()
    names = page.get_by_role("tab").all_inner_texts()
    assert {"Study", "Judgements", "Front", "Live front", "Decision"} <= {*names}
