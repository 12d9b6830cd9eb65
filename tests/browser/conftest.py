"""One JupyterLab and one Chromium, with one window, for all browser tests of a process."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, ViewportSize, expect, sync_playwright

from lab import CHROMIUM_FLAGS, LabServer, close_all, copy_notebooks, find_chromium, lab_server, screenshot

HERE = Path(__file__).parent
REPOSITORY = HERE.parents[1]
SIZE: ViewportSize = {"width": 1400, "height": 900}

expect.set_options(timeout=15_000)  # two shared cores may be busy


SLOWEST = (
    *("living", "session", "voila", "run_again", "published", "high_speed", "door_handle", "instrument", "opening"),
    *("programs_of", "names", "valve", "live_front"),
)
"""Files of tests, the slowest first: so all processes come to an end together."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents:
            item.add_marker("browser")
    items.sort(key=place)


def place(item: pytest.Item) -> int:
    """Where a test's file stands among the others."""
    return next((k for k, name in enumerate(SLOWEST) if item.path.name.startswith(f"test_{name}")), len(SLOWEST))


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
    context = browser.new_context(base_url=server.url, viewport=SIZE)
    context.request.get(f"/api/me?token={server.token}")  # the answer sets the login cookie
    yield context
    context.close()


@contextmanager
def kept(context: BrowserContext, session: pytest.Session) -> Iterator[Page]:
    """A window that stays open for the next test, unless one has failed in it."""
    page = next(iter(context.pages), None) or context.new_page()
    failed = session.testsfailed
    yield page
    if session.testsfailed > failed:
        page.close()


@contextmanager
def desk(context: BrowserContext, server: LabServer, session: pytest.Session) -> Iterator[Page]:
    """A window of 1400 x 900 without notebooks, whose JupyterLab stays loaded."""
    with kept(context, session) as page:
        page.set_viewport_size(SIZE)
        yield page
        if not page.is_closed():
            close_all(page)
        server.end_kernels()


@pytest.fixture
def page(context: BrowserContext, server: LabServer, request: pytest.FixtureRequest) -> Iterator[Page]:
    """A window of JupyterLab; what it showed when a test failed is kept in .browser/."""
    failed = request.session.testsfailed
    with desk(context, server, request.session) as page:
        yield page
        if request.session.testsfailed > failed:
            screenshot(page, REPOSITORY / ".browser" / f"{request.node.name}.png")


@pytest.fixture(scope="module")
def window(context: BrowserContext, server: LabServer, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The same for all tests of a file."""
    with desk(context, server, request.session) as page:
        yield page


@pytest.fixture(scope="session")
def outside(browser: Browser) -> Iterator[BrowserContext]:
    """Windows for files that live without JupyterLab."""
    context = browser.new_context()
    yield context
    context.close()


@pytest.fixture
def reader(outside: BrowserContext, request: pytest.FixtureRequest) -> Iterator[Page]:
    """A window for such a file."""
    with kept(outside, request.session) as page:
        page.mouse.move(0, 0)
        yield page


@pytest.fixture(autouse=True)
def _window_of_a_failed_test(request: pytest.FixtureRequest) -> Iterator[None]:
    """What it showed is kept in .browser/."""
    failed = request.session.testsfailed
    yield
    if request.session.testsfailed > failed and "window" in request.fixturenames:
        screenshot(request.getfixturevalue("window"), REPOSITORY / ".browser" / f"{request.node.name}.png")
