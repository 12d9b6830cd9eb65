"""Progress: kept whatever several kernels do, set aside where it is damaged, nowhere else."""

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from camkit.course import exercise, learner, progress
from camkit.course.exercises import OPENED
from camkit.course.records import NOW, file

ANSWERING = """
import sys
from camkit.course import exercise, learner
learner("Ada")
for i in range(int(sys.argv[2])):
    exercise(f"{sys.argv[1]} {i}", "?", lambda p: 1.0, lesson="a lesson").check(1.0)
"""


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A file of progress, as on a learner's machine."""
    monkeypatch.delenv("CAMKIT_LEARNER")
    monkeypatch.delenv("VOILA_BASE_URL", raising=False)
    monkeypatch.setenv("CAMKIT_COURSE", str(tmp_path / "data" / "course.json"))
    OPENED.clear()
    NOW.name, NOW.lessons = "", {}
    yield tmp_path / "data" / "course.json"
    NOW.name, NOW.lessons = "", {}


def answer(name="a task", value=1.0):
    return exercise(name, "?", lambda p: 1.0, lesson="a lesson").check(value)


def again():
    """As in another kernel."""
    NOW.name, NOW.lessons = "", {}


def test_the_next_kernel_goes_on(kept):
    learner("Ada")
    answer()
    answer("another", 2.0)
    again()
    assert progress().learner == "Ada"
    assert [told for _, _, told in progress().rows] == ["✓ right, 1 attempt", "1 attempt"]
    assert progress().title == "Ada: 1 of 2 exercises done."


def test_a_name_is_drawn_once(kept):
    drawn = learner().learner
    assert len(drawn) == 8
    again()
    assert learner().learner == drawn


def test_several_learners_share_a_machine(kept):
    learner("Ada")
    answer()
    assert learner("Ben").lessons == {}
    answer(value=2.0)
    assert learner("Ada").title == "Ada: 1 of 1 exercises done."
    assert json.loads(kept.read_text())["now"] == "Ada"


def test_kernels_at_the_same_time_lose_nothing(kept):
    commands = [[sys.executable, "-c", ANSWERING, name, "12"] for name in ("one", "two", "three")]
    running = [subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(Path.cwd())}) for command in commands]
    assert [each.wait(timeout=240) for each in running] == [0, 0, 0]
    learner("Ada")
    done = progress().lessons["a lesson"]
    assert len(done) == 36
    assert all(record["right"] for record in done.values())


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"\xff\xfe", b"[]", b"null", b'{"now": 3}', b'{"now": "Ada", "learners": []}',
     b'{"now": "Ada", "learners": {"Ada": {"a lesson": {"a task": {"attempts": "many"}}}}}',
     b'{"now": "Ada", "learners": {"Ada": {"a lesson": {"a task": {"attempts": 1, "hints": -5, "right": false}}}}}',
     b'{"now": "Ada", "learners": {"Ada": {"a lesson": []}}}', b"[" * 100_000, b" " * (2**22 + 1)],
    ids=lambda content: repr(content[:60]),
)  # fmt: skip
def test_a_damaged_file_is_set_aside_with_a_sentence(kept, content):
    kept.parent.mkdir()
    kept.write_bytes(content)
    said = learner("Ada").message
    aside = next(kept.parent.glob("course.damaged-*.json"))
    assert said == f"The record of progress was damaged: it is set aside as {aside.name}, and a new one begins."
    assert aside.read_bytes() == content
    assert answer().right
    assert progress().message == ""
    assert progress().title == "Ada: 1 of 1 exercises done."


def test_where_nothing_can_be_kept_a_sentence_says_so_and_the_lesson_goes_on(kept):
    kept.parent.write_text("a file where a folder should be")
    learner("Ada")
    reply = answer()
    assert reply.right
    assert "Progress is not kept: " in reply.sentence
    assert progress().title.startswith("Ada: 1 of 1 exercises done. Progress is not kept: ")


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="everybody may write everything")
def test_a_folder_that_may_not_be_written(kept):
    kept.parent.mkdir()
    kept.parent.chmod(stat.S_IRUSR | stat.S_IXUSR)
    assert "Progress is not kept" in answer().sentence


def test_where_the_file_is(monkeypatch):
    assert file() is None  # tests learn under a name of their own
    monkeypatch.delenv("CAMKIT_LEARNER")
    monkeypatch.delenv("CAMKIT_COURSE", raising=False)
    monkeypatch.setenv("XDG_DATA_HOME", "/somewhere")
    if sys.platform not in ("win32", "darwin"):
        assert file() == Path("/somewhere/camkit/course.json")
    monkeypatch.setenv("VOILA_BASE_URL", "/")
    assert file() is None  # strangers' pages


def test_a_name_that_is_given_by_the_environment(monkeypatch):
    monkeypatch.setenv("CAMKIT_LEARNER", "a class")
    again()
    assert learner().learner == "a class"
    again()
