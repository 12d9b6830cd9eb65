"""How notebooks open in the JupyterLab of `make lab`: unchanged, without news, with what they were saved with."""

from pathlib import Path

import nbformat
from playwright.sync_api import Page

from lab import STORED, Instrument, LabServer, load_notebook, open_notebook, run_all

REPOSITORY = Path(__file__).parents[2]
NOTEBOOKS = sorted(path.name for path in (REPOSITORY / "notebooks").glob("*.ipynb"))

OPENED = """async (names) => {
    const { commands, shell } = window.jupyterapp, { id } = shell.currentWidget.sessionContext.session.kernel;
    const panels = [];
    for (const path of names) {
        const panel = await commands.execute('docmanager:open', { path, kernel: { id } });
        await panel.context.ready;
        await panel.context.sessionContext.ready;
        await panel.context.sessionContext.session.kernel.info;
        panels.push(panel);
    }
    await new Promise(resolve => setTimeout(resolve, 1000));
    return names.filter((name, k) => panels[k].context.model.dirty);
}"""
"""Those of some notebooks, opened with the kernel of the one in front, that have the mark of what is not saved."""


def test_notebooks_open_without_the_mark_of_what_is_not_saved(page: Page, server: LabServer) -> None:
    first = (server.root / NOTEBOOKS[0]).read_text(encoding="utf-8")
    other = first.replace('"version": "3.', '"version": "2.')  # another Python stored it
    assert other != first
    (server.root / "other.ipynb").write_text(other, encoding="utf-8")
    load_notebook(page, "other.ipynb")
    assert page.get_by_text("Jupyter news").count() == 0
    assert page.evaluate(OPENED, ["other.ipynb", *NOTEBOOKS]) == []


CELLS = (
    "from camkit import TranslatingRollerCam, explore, presets\n"
    "from camkit.views import mechanism, pressure_angle\n"
    "app = explore(TranslatingRollerCam(), mechanism, pressure_angle)\napp",
    "presets(app, buttons={'itself': lambda cam: cam})",
)


def test_a_panel_comes_before_its_stored_picture_and_stays_as_it_stands(page: Page, server: LabServer) -> None:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in CELLS])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "panel first.ipynb")
    open_notebook(page, "panel first.ipynb")
    run_all(page, pictures=True)
    panels, slider = page.locator(".camkit-page"), Instrument(page).slider("base radius, mm")
    panels.nth(1).locator("canvas").first.wait_for()
    slider.press("ArrowRight")
    moved = slider.input_value()
    page.evaluate("() => { window.camkitPanels = [...document.querySelectorAll('.camkit-page')]; }")
    page.wait_for_function(f"() => ({STORED})().flat().every(Boolean)", timeout=60_000)
    page.wait_for_timeout(200)
    assert page.evaluate("() => [...document.querySelectorAll('.camkit-page')].every((p, k) => p === camkitPanels[k])")
    assert panels.count() == 2
    assert slider.input_value() == moved
    assert slider.evaluate("slider => slider === document.activeElement")
    slider.press("ArrowRight")
    assert slider.input_value() > moved
