"""Who may write and resume the files of a search: one at a time, and anybody after a kernel was killed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from camkit.panels.kit.search_files import keep, pending

HOLD = """
import sys, time
from pathlib import Path
from camkit.panels.kit.search_files import keep
kept = keep("kind-1", "{}")
kept.checkpoint.write_bytes(b"x")
print("held", flush=True)
time.sleep(600)
"""


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def kernel():
    """Another process that holds a search."""
    with subprocess.Popen([sys.executable, "-c", HOLD], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


def test_a_search_of_another_kernel_is_nobody_elses_until_that_is_killed(kernel):
    for _ in range(2):  # trying is no harm
        assert pending("kind") is None
        with pytest.raises(OSError, match=r"^the very same search runs already$"):
            keep("kind-1", "[]")
    kernel.kill()
    kernel.wait()
    kept = pending("kind")
    assert (kept.page.name, kept.text(), kept.checkpoint.read_bytes()) == ("kind-1.json", "{}", b"x")
    kept.remove()
    assert os.listdir(".camkit") == [".gitignore"]


def test_a_search_of_this_kernel_is_held_once():
    kept = keep("kind-1", "{}")
    kept.checkpoint.write_bytes(b"x")
    assert pending("kind") is None
    with pytest.raises(OSError, match=r"^the very same search runs already$"):
        keep("kind-1", "[]")
    assert kept.text() == "{}"
    kept.release()
    again = keep("kind-1", "[]")
    assert not again.checkpoint.exists()
    assert again.text() == "[]"
    again.release()
    assert sorted(os.listdir(".camkit")) == [".gitignore", "kind-1.json"]


@pytest.mark.parametrize("name", ["kind-1.lock", "kind-1.json"])
def test_nothing_is_written_through_a_link(tmp_path, name):
    mine = tmp_path / "mine"
    mine.write_text("mine")
    Path(".camkit").mkdir()
    (Path(".camkit") / name).symlink_to(mine)
    with pytest.raises(OSError, match="symbolic links"):
        keep("kind-1", "{}")
    assert mine.read_text() == (Path(".camkit") / name).read_text() == "mine"
