"""Editions of a lesson: what each leaves out, and that each runs."""

import json
import sys
from pathlib import Path

import nbformat
import pytest

from camkit.__main__ import main
from camkit.course import lessons_in, read_lesson, write_editions
from camkit.course.lessons import attempted, source

FOLDER = Path(__file__).parents[2] / "notebooks/course"
LESSONS = sorted(FOLDER.glob("[0-9]*.ipynb"))


@pytest.fixture(scope="module")
def editions(tmp_path_factory):
    out = tmp_path_factory.mktemp("editions")
    return out, write_editions(FOLDER, out)


def read(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    return notebook


def test_every_lesson_has_every_edition(editions):
    out, written = editions
    names = {str(path.relative_to(out)) for path in written}
    for lesson in LESSONS:
        assert {f"{edition}/{lesson.name}" for edition in ("learner", "instructor", "otter", "nbgrader")} < names
        assert f"learner/exercises_{lesson.stem}.py" in names
        assert f"instructor/exercises_{lesson.stem}.py" not in names


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_instructor_has_all_of_it(path, editions):
    made, whole = read(editions[0] / "instructor" / path.name), read(path)
    assert made == whole


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_learner_has_no_solution_no_note_and_no_output(path, editions):
    made, lesson = read(editions[0] / "learner" / path.name), read_lesson(path)
    text = "\n".join(cell.source for cell in made.cells)
    for word in ("lambda p", "lambda:", ".solution", "answer=", "mistakes", "For the instructor", "**Solution"):
        assert word not in text
    assert not any(cell.get("outputs") for cell in made.cells)
    assert {name for name, _ in filter(None, (attempted(c.source) for c in made.cells if c.cell_type == "code"))} == {
        *lesson.exercises
    }
    for name in lesson.exercises:
        assert f"from {lesson.module} import " in text
        assert name in text
    kept = [cell.id for cell in made.cells]
    assert kept == [cell["id"] for cell in lesson.cells if cell["id"] in kept]


@pytest.mark.slow
@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_learners_edition_runs(path, editions, monkeypatch):
    """As somebody opens it, and runs all cells before any is answered."""
    folder = editions[0] / "learner"
    monkeypatch.chdir(folder)
    monkeypatch.syspath_prepend(str(folder))
    made = {"__name__": "__main__"}
    for cell in read(folder / path.name).cells:
        if cell.cell_type == "code":
            given = attempted(cell.source)
            if given and given[1] == "...":
                reply = eval(cell.source, made)
                assert not reply.counted
            else:
                exec(cell.source, made)
    sys.modules.pop(f"exercises_{path.stem}", None)


def test_the_command_writes_them(tmp_path, capsys):
    assert main(["course", str(LESSONS[0]), "--out", str(tmp_path), "--edition", "learner"]) == 0
    assert capsys.readouterr().out.split() == [str(path) for path in sorted((tmp_path / "learner").iterdir())]
    assert main(["course", str(LESSONS[0]), "--out", str(tmp_path), "--edition", "pupil"]) == 2
    assert "there is no edition 'pupil'; there are learner, instructor, otter, nbgrader, worksheet" in (
        capsys.readouterr().err
    )
    assert main(["course", str(tmp_path / "nowhere")]) == 2
    assert "there is no lesson in" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no notebook"),
        (b"[]", "is no notebook"),
        (json.dumps({"nbformat": 3, "cells": []}).encode(), "is no notebook"),
        (json.dumps({"nbformat": 4, "cells": []}).encode(), "has no exercise"),
    ],
)
def test_what_is_no_lesson_is_refused(tmp_path, content, words):
    (tmp_path / "01_none.ipynb").write_bytes(content)
    with pytest.raises(ValueError, match=words):
        lessons_in(tmp_path)


def test_a_cell_is_split_into_what_is_defined_and_what_is_shown():
    lesson = read_lesson(LESSONS[0])
    assert "lambda" in lesson.definitions
    assert all(source(cell) for cell in lesson.cells)
