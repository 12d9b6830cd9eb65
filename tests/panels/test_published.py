"""`make app`: what it binds to, and the limits of the kernels that it starts."""

import asyncio
import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from voila.tornado.execution_request_handler import ExecutionRequestHandler

from camkit.panels.kit import search_files
from camkit.panels.kit.published import PublishedKernels

REPOSITORY = Path(__file__).parents[2]


@pytest.mark.skipif(not shutil.which("make"), reason="no make here")
@pytest.mark.parametrize(
    ("arguments", "host"), [([], "127.0.0.1"), (["HOST=0.0.0.0"], "0.0.0.0"), (["HOST=::1"], "::1")]
)
def test_pages_are_shown_to_this_machine_unless_told_otherwise(arguments, host):
    """On the command line: some shells export a HOST of their own."""
    said = subprocess.run(
        ["make", "-n", "app", *arguments],
        cwd=REPOSITORY, env=os.environ | {"HOST": "example.org"}, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert f" --Voila.ip={host} " in said
    assert " --Voila.config_file_paths=notebooks" in said


def test_the_limits_of_published_pages_are_known_by_these_names():
    limits = json.loads((REPOSITORY / "notebooks" / "voila.json").read_text())
    name = PublishedKernels.__name__
    pages = limits["VoilaConfiguration"]
    assert pages.pop("multi_kernel_manager_class") == f"{PublishedKernels.__module__}.{name}"
    assert pages == {"template": "camkit", "progressive_rendering": True}  # pictures appear while a notebook runs
    kernels = PublishedKernels(**limits[name])
    assert {key: getattr(kernels, key) for key in limits[name]} == limits[name]
    assert kernels.most > 0
    assert kernels.cull_idle_timeout > 0
    assert kernels.cull_connected


def test_a_page_that_never_opens_gives_its_place_back():
    """A plain GET runs the notebook and never connects; neither a running notebook nor an open page is ended."""

    async def visits():
        kernels = PublishedKernels(closed_for=1)
        crawled, opened, running = [await kernels.start_kernel() for _ in range(3)]
        try:
            kernels.notify_connect(opened)
            kernels.stop_watching_activity(running)
            kernels.get_kernel(running).execution_state = "busy"
            async with asyncio.timeout(60):
                while crawled in kernels:
                    await asyncio.sleep(0.2)
            await asyncio.sleep(2 * kernels.closed_for)
            assert {opened, running} == set(kernels.list_kernel_ids())
            kernels.get_kernel(running).execution_state = "idle"
            async with asyncio.timeout(60):
                while running in kernels:
                    await asyncio.sleep(0.2)
            assert kernels.list_kernel_ids() == [opened]
        finally:
            await kernels.shutdown_all(now=True)

    asyncio.run(visits())


def test_the_notebook_of_a_page_that_never_opened_is_forgotten():
    """Voila keeps it for a page that asks for it; a crawler's does not."""

    async def visit():
        kernels = PublishedKernels()
        kernel_id = await kernels.start_kernel()
        ExecutionRequestHandler._execution_data[kernel_id] = {"nb": "a notebook"}
        await kernels.shutdown_kernel(kernel_id, now=True)
        assert kernel_id not in ExecutionRequestHandler._execution_data

    asyncio.run(visit())


def test_a_published_page_keeps_its_searches_to_itself(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    beside = search_files.keep("kind-1", "{}")
    beside.checkpoint.write_bytes(b"")
    beside.release()
    monkeypatch.setenv("VOILA_BASE_URL", "/")
    assert search_files.pending("kind") is None
    own = search_files.keep("kind-1", "{}")
    assert own.page.parent != beside.page.parent
    assert own.page.parent.stat().st_mode & 0o077 == 0
    own.checkpoint.write_bytes(b"")
    own.release()
    again = search_files.pending("kind")
    assert again.page == own.page
    again.remove()
