"""Lessons as two programs grade them: otter 7 and nbgrader make an assignment of each, and grade a submission."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from camkit.course import read_lesson, write_editions

REPOSITORY = Path(__file__).parents[3]
LESSONS = sorted((REPOSITORY / "notebooks/course").glob("[0-9]*.ipynb"))
RIGHT = "harder"
"""What the submission below gets right, of the first lesson."""


def run(*command, folder):
    """What a program of this environment says."""
    beside = {"PATH": os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))}  # nbgrader calls alembic
    given, told = [sys.executable, "-m", *map(str, command)], os.environ | beside
    done = subprocess.run(given, cwd=folder, env=told, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def solve(path, name, attempt):
    """Answer one exercise of a notebook as a learner does."""
    notebook = nbformat.read(path, as_version=4)
    cell = next(each for each in notebook.cells if f"{name}.check(" in each.source and each.cell_type == "code")
    cell.source = cell.source.replace(f"{name}.check(...)", f"{name}.check({attempt})")
    nbformat.write(notebook, path)


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_otter_assigns_every_lesson_and_its_solutions_pass(lesson, tmp_path):
    write_editions(lesson, tmp_path, "otter")
    said = run("otter", "assign", f"otter/{lesson.name}", "made", "-v", folder=tmp_path)
    assert "All autograder tests passed" in said
    student = nbformat.read(tmp_path / "made/student" / lesson.name, as_version=4)
    assert not any(".solution" in cell.source for cell in student.cells)
    assert sum(".check(...)" in cell.source for cell in student.cells) > 2


def test_otter_grades_a_submission(tmp_path):
    write_editions(LESSONS[0], tmp_path, "otter")
    run("otter", "assign", f"otter/{LESSONS[0].name}", "made", "--no-run-tests", folder=tmp_path)
    submission = tmp_path / "made/student" / LESSONS[0].name
    solve(submission, RIGHT, f"{RIGHT}.solution")
    grader = next((tmp_path / "made/autograder").glob("*.zip"))
    run("otter", "run", "-a", grader, "-o", tmp_path, submission, folder=tmp_path)
    results = json.loads((tmp_path / "results.json").read_text())
    scores = {test["name"]: test["score"] for test in results["tests"] if "score" in test}
    assert {name for name, score in scores.items() if score} == {RIGHT}
    assert len(scores) == len(read_lesson(LESSONS[0]).exercises)


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_what_nbgrader_starts_from_is_a_notebook_of_its_schema(lesson, tmp_path):
    from nbgrader.nbgraderformat import ValidationError, read

    written = write_editions(lesson, tmp_path, "nbgrader")
    notebook = read(written[0], as_version=4)
    nbformat.validate(notebook)
    marked = [cell.metadata.nbgrader for cell in notebook.cells if "nbgrader" in cell.metadata]
    assert len(marked) == 2 * sum(mark.grade for mark in marked) > 4
    notebook.cells[-1].metadata["nbgrader"] = {"schema_version": 3, "grade": True}
    nbformat.write(notebook, written[0])
    with pytest.raises(ValidationError):
        read(written[0], as_version=4)


def test_nbgrader_makes_an_assignment_and_grades_it(tmp_path):
    write_editions(LESSONS[0], tmp_path, "nbgrader")
    source = tmp_path / "source/lesson"
    shutil.copytree(tmp_path / "nbgrader", source)
    run("nbgrader", "generate_assignment", "lesson", "--create", folder=tmp_path)
    released = tmp_path / "release/lesson" / LESSONS[0].name
    assert ".solution" not in released.read_text()
    submitted = tmp_path / "submitted/ada/lesson"
    shutil.copytree(released.parent, submitted)
    solve(submitted / LESSONS[0].name, RIGHT, f"{RIGHT}.solution")
    run("nbgrader", "autograde", "lesson", "--create", folder=tmp_path)
    run("nbgrader", "export", folder=tmp_path)
    row = (tmp_path / "grades.csv").read_text().splitlines()[1].split(",")
    head = (tmp_path / "grades.csv").read_text().splitlines()[0].split(",")
    grade = dict(zip(head, row, strict=True))
    assert (float(grade["score"]), float(grade["max_score"])) == (1, len(read_lesson(LESSONS[0]).exercises))
