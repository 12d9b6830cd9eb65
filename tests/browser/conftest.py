"""One JupyterLab and one Chromium for all browser tests of a process; a fresh page for each."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

from lab import CHROMIUM_FLAGS, LabServer, copy_notebooks, find_chromium, lab_server, screenshot

HERE = Path(__file__).parent
REPOSITORY = HERE.parents[1]

expect.set_options(timeout=15_000)  # two shared cores may be busy


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents:
            item.add_marker("browser")


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    chromium = find_chromium()
    if chromium is None:
        say = "no Chromium found: install one (apt-get install chromium) or name it in CAMKIT_CHROMIUM"
        if os.environ.get("CI"):
            pytest.fail(say)
        pytest.skip(say)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=CHROMIUM_FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def server(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[LabServer]:
    """JupyterLab over a copy of the notebooks (it starts after the browser: no browser, no server)."""
    folder = tmp_path_factory.mktemp("lab")
    root = folder / "notebooks"
    copy_notebooks(REPOSITORY / "notebooks", root)
    with lab_server(folder, root, REPOSITORY) as running:
        yield running


@pytest.fixture(scope="session")
def context(browser: Browser, server: LabServer) -> Iterator[BrowserContext]:
    """A browser that is logged in; shared, so that JupyterLab's own code is fetched once."""
    context = browser.new_context(base_url=server.url, viewport={"width": 1400, "height": 900})
    context.request.get(f"/api/me?token={server.token}")  # the answer sets the login cookie
    yield context
    context.close()


@pytest.fixture
def page(context: BrowserContext, server: LabServer, request: pytest.FixtureRequest) -> Iterator[Page]:
    """A window of 1400 x 900; what it showed when a test failed is kept in .browser/."""
    page = context.new_page()
    failed = request.session.testsfailed
    yield page
    if request.session.testsfailed > failed:
        screenshot(page, REPOSITORY / ".browser" / f"{request.node.name}.png")
    page.close()
    server.end_kernels()
