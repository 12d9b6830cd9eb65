"""A notebook run again, or a page loaded again, while a search runs: it is seen and can be stopped, or has ended."""

import re
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import Page, expect

from lab import LabServer, cell, eventually, kernel_value, open_notebook, run_all

NAME = "run_again.ipynb"
EXPLORER = """
from camkit import DoorHandleCam, door_handle_study, explore, pareto_panel
from camkit.panels.kit.running import RUNNING
from camkit.machines.door_handle import PAPER_SPACE
from camkit.views import pressure_angle

app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm"])
app
"""
SEARCH = """
finder = pareto_panel(app, {"lift": door_handle_study(space=PAPER_SPACE)}, generations=10000)
finder
"""
PATIENT = """
const wait = window.setTimeout;
window.setTimeout = (act, time, ...given) => wait(act, time === 4000 ? 60000 : time, ...given);
"""
"""JupyterLab gives the kernel 4 s to send all its widgets to a page that is loaded, then asks for each and may end
with none: too short on a busy machine."""
LEFT = re.compile(r"\d+ (s|min) left")
THREADS = "[job.thread.ident for job in RUNNING]"


def write(path: Path, *sources: str) -> None:
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), path)


@pytest.fixture
def running(page: Page, server: LabServer) -> Page:
    """The notebook, with its search underway."""
    write(server.root / NAME, EXPLORER, SEARCH)
    open_notebook(page, NAME)
    run_all(page)
    finder = cell(page, 1)
    finder.get_by_role("button", name="Optimise").click()
    expect(finder.get_by_text(LEFT)).to_be_visible()
    return page


def stop(page: Page) -> None:
    finder = cell(page, 1)
    finder.get_by_role("button", name="Stop").click()
    expect(finder.locator(".camkit-status")).to_contain_text("(stopped)")
    eventually(lambda: kernel_value(page, THREADS) == [])
    expect(finder.get_by_role("button", name="Resume")).to_be_enabled()


def test_all_cells_run_twice_while_a_search_runs(running: Page) -> None:
    """One thread from first to last; the new panel shows how far it is and stops it."""
    first, threads = kernel_value(running, "id(finder)"), kernel_value(running, THREADS)
    assert len(threads) == 1
    for _ in range(2):
        reached = kernel_value(running, "finder.progress.value")
        run_all(running)
        assert kernel_value(running, THREADS) == threads
        assert kernel_value(running, "finder.progress.value") >= reached
        finder = cell(running, 1)
        expect(finder.locator(".camkit-status")).to_have_count(1)
        expect(finder.get_by_text(LEFT)).to_be_visible()
        expect(finder.get_by_role("button", name="Stop")).to_be_enabled()
        expect(finder.get_by_role("button", name="Optimise")).to_be_disabled()
    assert kernel_value(running, "id(finder)") != first
    stop(running)


def test_a_cell_that_was_changed_ends_the_search(running: Page) -> None:
    """Another start is another page, which cannot show the search that runs."""
    change = (
        """(source) => window.jupyterapp.shell.currentWidget.content.widgets[0].model.sharedModel.setSource(source)"""
    )
    running.evaluate(change, EXPLORER.replace("DoorHandleCam()", "DoorHandleCam(roller_radius=0.004)"))
    run_all(running)
    eventually(lambda: kernel_value(running, THREADS) == [])
    expect(cell(running, 1).get_by_role("button", name="Optimise")).to_be_enabled()


def test_a_page_that_is_loaded_again_still_shows_the_search(running: Page) -> None:
    threads = kernel_value(running, THREADS)
    running.evaluate("() => window.jupyterapp.commands.execute('docmanager:save')")
    running.add_init_script(PATIENT)
    running.goto(f"/lab/tree/{NAME}")
    loaded = "() => window.jupyterapp?.shell.currentWidget?.sessionContext?.session?.kernel"
    running.wait_for_function(loaded, timeout=60_000)
    assert kernel_value(running, THREADS) == threads
    expect(cell(running, 1).get_by_text(LEFT)).to_be_visible(timeout=60_000)
    run_all(running)
    assert kernel_value(running, THREADS) == threads
    stop(running)
    running.close()  # the next one is not that patient
