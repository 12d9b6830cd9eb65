"""What the benchmarks share: a JupyterLab in a Chromium, and a list of results printed at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import Page, sync_playwright

REPOSITORY = Path(__file__).parents[1]
sys.path.append(str(REPOSITORY / "tests" / "browser"))

from lab import CHROMIUM_FLAGS, find_chromium, lab_server, open_notebook, run_all  # noqa: E402

RESULTS = pytest.StashKey[list[tuple[str, str]]]()


@pytest.fixture
def report(request: pytest.FixtureRequest) -> Callable[[str, str], None]:
    """``report(what, value)``: a line of the summary."""
    return lambda what, value: request.config.stash.setdefault(RESULTS, []).append((what, value))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    results = config.stash.get(RESULTS, [])
    if results:
        terminalreporter.section("results for benchmarks/README.md")
    for what, value in results:
        terminalreporter.write_line(f"{what:<72} {value}")


@pytest.fixture(scope="module")
def page(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A notebook made of the module's ``CELLS``, opened and run."""
    chromium = find_chromium()
    if chromium is None:
        pytest.skip("no Chromium found: install one (apt-get install chromium) or name it in CAMKIT_CHROMIUM")
    folder = tmp_path_factory.mktemp("lab")
    root = folder / "notebooks"
    root.mkdir()
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in request.module.CELLS])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, root / "live.ipynb")
    with sync_playwright() as playwright, lab_server(folder, root, REPOSITORY) as server:
        browser = playwright.chromium.launch(executable_path=chromium, args=CHROMIUM_FLAGS)
        context = browser.new_context(base_url=server.url, viewport={"width": 1400, "height": 900})
        context.request.get(f"/api/me?token={server.token}")
        page = context.new_page()
        open_notebook(page, "live.ipynb")
        run_all(page)
        yield page
        browser.close()
