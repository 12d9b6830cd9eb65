"""Published pages: visitors do not see each other, closed pages leave no kernel, and there are not too many."""

import re
import shutil
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import Browser, Page, expect

from lab import eventually, voila_server

REPOSITORY = Path(__file__).parents[2]
SEARCH = """
from camkit import DoorHandleCam, door_handle_study, explore, pareto_panel
from camkit.machines.door_handle import PAPER_SPACE
from camkit.views import pressure_angle

app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm"])
pareto_panel(app, {"lift": door_handle_study(space=PAPER_SPACE)}, generations=10000)
"""


def write(path: Path, source: str) -> None:
    nbformat.write(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source)]), path)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two notebooks, and the limits of those that are published."""
    (tmp_path / "notebooks").mkdir()
    shutil.copy(REPOSITORY / "notebooks" / "voila.json", tmp_path / "notebooks")
    write(tmp_path / "notebooks" / "search.ipynb", SEARCH)
    write(tmp_path / "notebooks" / "sum.ipynb", "1 + 1")
    return tmp_path


@pytest.fixture
def visitor(browser: Browser) -> Iterator[Callable[[str], Page]]:
    """Opens a page as somebody who was never here."""
    contexts = []

    def opened(address: str) -> Page:
        contexts.append(browser.new_context())
        page = contexts[-1].new_page()
        page.goto(f"{address}/voila/render/search.ipynb", wait_until="commit")
        expect(page.get_by_role("button", name="Optimise")).to_be_enabled(timeout=60_000)
        return page

    yield opened
    for context in contexts:
        context.close()


def kernels(folder: Path, address: str) -> list[str]:
    """Those that run, of all that were ever started."""
    started = re.findall("Kernel started: ([0-9a-f-]+)", (folder / "server.log").read_text())
    return [kernel for kernel in started if status(f"{address}/api/kernels/{kernel}")[0] == 200]


def status(address: str) -> tuple[int, str]:
    try:
        with urllib.request.urlopen(address, timeout=60) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as refusal:
        return refusal.code, refusal.read().decode()


def test_visitors_neither_see_nor_wait_for_each_other(folder: Path, visitor: Callable[[str], Page]) -> None:
    with voila_server(folder, REPOSITORY, "--PublishedKernels.most=2", "--PublishedKernels.closed_for=10") as address:
        ann = visitor(address)
        ann.get_by_role("button", name="Optimise").click()
        expect(ann.locator(".camkit-status")).to_contain_text("generation ")
        ann.get_by_role("button", name="Stop").click()
        expect(ann.locator(".camkit-status")).to_contain_text("(stopped)")
        expect(ann.get_by_role("button", name="Resume")).to_be_enabled()

        bob = visitor(address)
        expect(bob.get_by_role("button", name="Resume")).to_be_disabled()
        bob.get_by_role("button", name="Optimise").click()  # the very same search
        expect(bob.locator(".camkit-status")).to_contain_text("generation ")
        expect(bob.get_by_role("alert")).to_have_count(0)
        ann.get_by_role("button", name="Resume").click()
        expect(ann.locator(".camkit-hint").filter(has_text=re.compile(" left$")).first).to_be_visible()
        expect(ann.get_by_role("alert")).to_have_count(0)
        assert not (folder / "notebooks" / ".camkit").exists()

        said, page = status(f"{address}/voila/render/sum.ipynb")
        assert said == 503
        assert "all 2 places are taken, please come back in a few minutes" in page
        assert len(kernels(folder, address)) == 2
        bob.close()  # in the midst of a search, and without a word to the server
        eventually(lambda: len(kernels(folder, address)) == 1, seconds=60)
        expect(ann.locator(".camkit-hint").filter(has_text=re.compile(" left$")).first).to_be_visible()
        assert status(f"{address}/voila/render/sum.ipynb")[0] == 200


def test_the_number_of_kernels_is_bounded_and_idle_ones_end(folder: Path) -> None:
    """Also when all come at once, and for pages that were asked for and never shown."""
    options = (
        "--PublishedKernels.most=2",
        "--PublishedKernels.cull_idle_timeout=5",
        "--PublishedKernels.cull_interval=1",
    )
    with voila_server(folder, REPOSITORY, *options) as address:
        with ThreadPoolExecutor(4) as crowd:
            said = [s for s, _ in crowd.map(status, [f"{address}/voila/render/sum.ipynb"] * 4)]
        assert sorted(said) == [200, 200, 503, 503]
        eventually(lambda: not kernels(folder, address), seconds=40)
        assert status(f"{address}/voila/render/sum.ipynb")[0] == 200
