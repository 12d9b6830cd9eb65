"""How notebooks open in the JupyterLab of `make lab`: unchanged, without news, with what they were saved with."""

from pathlib import Path

from playwright.sync_api import Page

from lab import LabServer, open_notebook

REPOSITORY = Path(__file__).parents[2]
NOTEBOOKS = sorted(path.name for path in (REPOSITORY / "notebooks").glob("*.ipynb"))

OPENED = """async (name) => {
    const { commands } = window.jupyterapp, panel = await commands.execute('docmanager:open', { path: name });
    await panel.context.ready;
    await panel.context.sessionContext.ready;
    await (await panel.context.sessionContext.session.kernel.info);
    await new Promise(resolve => setTimeout(resolve, 300));
    const { dirty } = panel.context.model;
    await panel.context.sessionContext.shutdown();
    panel.dispose();
    return dirty;
}"""
"""Whether a notebook that opens has the mark of what is not saved."""


def test_notebooks_open_without_the_mark_of_what_is_not_saved(page: Page, server: LabServer) -> None:
    first = (server.root / NOTEBOOKS[0]).read_text(encoding="utf-8")
    other = first.replace('"version": "3.', '"version": "2.')  # another Python stored it
    assert other != first
    (server.root / "other.ipynb").write_text(other, encoding="utf-8")
    open_notebook(page, "other.ipynb")
    assert page.get_by_text("Jupyter news").count() == 0
    assert not [name for name in ("other.ipynb", *NOTEBOOKS) if page.evaluate(OPENED, name)]
