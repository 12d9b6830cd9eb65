"""Notebook 7 in a real browser: the door handle's instrument lives there as it does in JupyterLab."""

import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect, sync_playwright

from camkit.workbook import copy

REPOSITORY = Path(__file__).parents[3]
LONG = 120_000
"""Milliseconds: two shared cores may be busy."""


def chromium() -> str:
    names = ("chromium", "chromium-browser", "google-chrome")
    found = os.environ.get("CAMKIT_CHROMIUM") or next(filter(None, map(shutil.which, names)), None)
    if not found:
        (pytest.fail if os.environ.get("CI") else pytest.skip)(
            "no Chromium found: install one (apt-get install chromium)"
        )
    return str(found)


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Notebook 7 as anybody starts it, over a copy of the notebooks, with no settings of ours."""
    copy(tmp_path / "notebooks")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ("--no-browser", "--allow-root", f"--port={port}", "--IdentityProvider.token=abc")
    homes = {f"JUPYTER_{name}_DIR": str(tmp_path / name) for name in ("CONFIG", "DATA", "RUNTIME")}
    given = os.environ | homes | {"OPENBLAS_NUM_THREADS": "1", "JUPYTER_PREFER_ENV_PATH": "1"}
    command = [sys.executable, "-m", "notebook", *options]
    with (tmp_path / "log").open("w", encoding="utf-8") as log:
        server = subprocess.Popen(command, cwd=tmp_path / "notebooks", env=given, stdout=log, stderr=log)
        yield f"http://127.0.0.1:{port}"
        server.terminate()
        server.wait(30)


@pytest.fixture
def page(address: str) -> Iterator[Page]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.set_default_timeout(LONG)
        for _ in range(240):  # until the server answers
            try:
                page.goto(f"{address}/notebooks/01_door_handle_cam.ipynb?token=abc", timeout=LONG)
                break
            except Exception:
                page.wait_for_timeout(500)
        yield page
        browser.close()


def test_an_instrument_lives_in_notebook_7(page: Page) -> None:
    expect(page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]")).to_be_attached(timeout=LONG)
    for _ in range(240):  # it says so before there is a kernel, too
        kernels = page.request.get(f"{page.url.partition('/notebooks')[0]}/api/kernels").json()
        if any(kernel["connections"] and kernel["execution_state"] == "idle" for kernel in kernels):
            break
        page.wait_for_timeout(500)
    page.wait_for_timeout(1000)
    page.locator(".jp-Notebook .jp-Cell").first.click()
    for _ in range(3):  # the title, the imports, the instrument
        page.keyboard.press("Shift+Enter")
    instrument = page.locator(".camkit-page").first
    expect(instrument.locator("canvas").first).to_be_visible(timeout=LONG)
    slider = instrument.get_by_role("slider", name="lift arm, mm", exact=True).first
    box = instrument.get_by_label("lift arm, mm, number", exact=True)
    before, drawn = box.input_value(), instrument.locator("canvas").first.evaluate("c => c.toDataURL()")
    slider.focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    expect(box).not_to_have_value(before)
    page.wait_for_function(
        "drawn => document.querySelector('.camkit-page canvas').toDataURL() !== drawn", arg=drawn, timeout=LONG
    )
    folder = REPOSITORY / ".browser"
    folder.mkdir(exist_ok=True)
    page.screenshot(path=folder / "notebook7.png")
    wanted = float(box.input_value())
    page.get_by_role("heading", name="Move it").click()  # the next cell
    page.keyboard.press("Escape")
    page.keyboard.press("a")
    page.keyboard.press("Enter")
    page.keyboard.type("1000 * app.design.lift_arm")
    page.keyboard.press("Shift+Enter")  # the kernel has heard of it
    told = page.locator(".jp-Notebook .jp-Cell").nth(3).locator(".jp-OutputArea-executeResult pre")
    assert float(told.inner_text(timeout=LONG)) == pytest.approx(wanted, abs=0.01)
    assert not page.locator("[data-mime-type='application/vnd.jupyter.error']").count()
