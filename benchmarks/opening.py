"""How soon the panels of the live notebooks are there after *Run All*, in JupyterLab and headless Chromium.

``python benchmarks/opening.py [name ...]`` from the repository's root, a notebook a line: seconds from *Run All* to the
first panel that has drawn, to the second one, and to the end of all cells; how many widget models the kernel holds; in
between, as what they are compared with, a notebook with one plain slider of ipywidgets.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "tests" / "browser"))

import nbformat  # noqa: E402
from playwright.sync_api import Page, sync_playwright  # noqa: E402

from lab import CHROMIUM_FLAGS, find_chromium, kernel_value, lab_server, open_notebook  # noqa: E402

PLAIN = "plain.ipynb"
PANEL = (
    ".camkit-page canvas, .camkit-page table, .camkit-panel img, .camkit-sheet, .jp-OutputArea-output .widget-slider"
)
OPENED = """(panel) => {
    const begin = performance.now(), seconds = () => (performance.now() - begin) / 1000, found = [];
    const notebook = window.jupyterapp.shell.currentWidget.node;
    const cells = () => new Set([...notebook.querySelectorAll(panel)]
        .filter((part) => part.clientWidth).map((part) => part.closest('.jp-Cell')));
    window.camkitOpened = new Promise((done) => {
        let ended = 0;
        const look = () => {
            while (found.length < Math.min(cells().size, 2)) found.push(seconds());
            if (ended && (found.length > 1 || seconds() - ended > 3)) done({ found, ended });
            else requestAnimationFrame(look);
        };
        window.jupyterapp.commands.execute('notebook:run-all-cells').finally(() => { ended = seconds(); });
        look();
    });
}"""
MODELS = "len(__import__('ipywidgets').widgets.widget._instances)"


def opened(page: Page, name: str) -> str:
    """A line of the table for one notebook."""
    open_notebook(page, name)
    page.evaluate(OPENED, PANEL)
    page.set_default_timeout(300_000)
    result = page.evaluate("camkitOpened")
    first, second = ([f"{seconds:.1f}" for seconds in result["found"]] + ["", ""])[:2]
    models = kernel_value(page, MODELS, timeout=120)
    return f"{name:42}{first:>7}{second:>8}{result['ended']:8.1f}{models:8}"


def main() -> None:
    notebooks = [path for path in sorted((ROOT / "notebooks").glob("*.ipynb")) if "explore" in path.read_text()]
    names = [path.name for path in notebooks if len(sys.argv) < 2 or path.name.startswith(tuple(sys.argv[1:]))]
    slider = "from ipywidgets import FloatSlider\nFloatSlider()"
    print(f"{'':42}{'first':>7}{'second':>8}{'all':>8}{'models':>8}")
    with TemporaryDirectory() as temporary, sync_playwright() as playwright:
        folder = Path(temporary)
        root = folder / "notebooks"
        root.mkdir()
        for path in notebooks:
            (root / path.name).write_text(path.read_text(encoding="utf-8"), encoding="utf-8")
        plain = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(slider)])
        plain.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
        nbformat.write(plain, root / PLAIN)
        with lab_server(folder, root, ROOT) as server:
            browser = playwright.chromium.launch(executable_path=find_chromium(), args=CHROMIUM_FLAGS)
            context = browser.new_context(base_url=server.url, viewport={"width": 1366, "height": 768})
            context.request.get(f"/api/me?token={server.token}")
            page = context.new_page()
            for k, name in enumerate(names):
                if k % 3 == 0:
                    print(opened(page, PLAIN), flush=True)
                    server.end_kernels()
                print(opened(page, name), flush=True)
                server.end_kernels()
            browser.close()


if __name__ == "__main__":
    main()
