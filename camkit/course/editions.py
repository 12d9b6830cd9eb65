"""The editions of a lesson, all made from the instructor's: for learners, and for two programs that grade."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from ..quantities.kinds import refuse_arguments
from .instruments import DesignExercise, FrontExercise
from .lessons import EXERCISE, INSTRUCTOR, SOLUTION, Cell, Lesson, attempted, lessons_in, source, split, tags

POINTS = 1
"""Of each exercise, where it is graded."""
SIGNED = 'learner("your name or number")'
NBGRADER = {"schema_version": 3, "task": False, "points": POINTS}


def learners(lesson: Lesson) -> list[Cell]:
    """The cells of the learner's edition: without solutions, notes and outputs, the exercises in their module."""
    kept = (cell for cell in lesson.cells if not tags(cell) & {SOLUTION, INSTRUCTOR})
    return [without_output(_asked(lesson, cell) if EXERCISE in tags(cell) else cell) for cell in kept]


def _asked(lesson: Lesson, cell: Cell) -> Cell:
    """The cell of an exercise as a learner has it: it imports what is defined there, and shows it."""
    defined, shown = split(source(cell))
    names = [each for part in ast.parse(defined).body if isinstance(part, ast.Assign) for each in part.targets]
    wanted = ", ".join(ast.unparse(name) for name in names)
    return with_source(cell, f"from {lesson.module} import {wanted}\n\n{shown}")


def otter(lesson: Lesson) -> list[Cell]:
    """The cells of a source for ``otter assign``: each attempt is a question with its solution and a test."""
    more = f"init_cell: false\nfiles: [{lesson.module}.py]\nrequirements: ['camkit[lab]']"
    cells = [raw(lesson, "config", f"# ASSIGNMENT CONFIG\nname: {lesson.name}\n{more}")]
    for cell in map(signed, learners(lesson)):
        attempt = _attempt(lesson, cell)
        cells += _question(lesson, cell, *attempt) if attempt else [cell]
    return cells


def _attempt(lesson: Lesson, cell: Cell) -> tuple[str, str, str] | None:
    """Of a cell that is an attempt: its exercise, what ``check`` is given there, and what a right one is given.

    A grader runs a notebook again, in which nobody moves a slider: there a design is written down, and a choice from a
    front stays an exercise without points.
    """
    name, given = (attempted(source(cell)) if cell["cell_type"] == "code" else None) or ("", "")
    task = lesson.exercises.get(name)
    if task is None or isinstance(task, FrontExercise):
        return None
    return name, f"{name}.start" if isinstance(task, DesignExercise) else given, f"{name}.solution"


def _question(lesson: Lesson, cell: Cell, name: str, given: str, right: str) -> Iterator[Cell]:
    prompt = f'""" # BEGIN PROMPT\n{name}_reply = {name}.check({given})\n""" # END PROMPT'
    solution = f"{name}_reply = {name}.check({right})  # SOLUTION NO PROMPT"
    yield raw(lesson, f"{name}-question", f"# BEGIN QUESTION\nname: {name}\npoints: {POINTS}")
    yield raw(lesson, f"{name}-solution", "# BEGIN SOLUTION")
    yield with_source(cell, f"{solution}\n{prompt}\n{name}_reply")
    yield raw(lesson, f"{name}-solved", "# END SOLUTION")
    yield raw(lesson, f"{name}-tests", "# BEGIN TESTS")
    yield code(lesson, f"{name}-test", f"assert {name}_reply.right, str({name}_reply)")
    yield raw(lesson, f"{name}-tested", "# END TESTS")
    yield raw(lesson, f"{name}-end", "# END QUESTION")


def nbgrader(lesson: Lesson) -> list[Cell]:
    """The cells of a source for ``nbgrader generate_assignment``: each attempt with its solution, and a test."""
    cells: list[Cell] = []
    for cell in map(signed, learners(lesson)):
        attempt = _attempt(lesson, cell)
        if not attempt:
            cells.append(cell)
            continue
        name, given, right = attempt
        solved = f"{name}_reply = {name}.check({right})"
        marked = f"{name}_reply = {name}.check({given})\n### BEGIN SOLUTION\n{solved}\n### END SOLUTION\n{name}_reply"
        cells.append(graded(with_source(cell, marked), name, solution=True))
        test = code(lesson, f"{name}-test", f"assert {name}_reply.right, str({name}_reply)")
        cells.append(graded(test, f"{name}_test", solution=False))
    return cells


def signed(cell: Cell) -> Cell:
    """The cell that says who learns, with a name to be written there: graders draw the same numbers from it."""
    return with_source(cell, SIGNED) if source(cell).startswith("learner(") else cell


def graded(cell: Cell, name: str, solution: bool) -> Cell:
    """A cell as nbgrader marks it: of a solution, or a test with its points that nobody may change."""
    marks = {**NBGRADER, "grade_id": name, "solution": solution, "grade": not solution, "locked": not solution}
    if solution:
        del marks["points"]
    return {**cell, "metadata": {**cell["metadata"], "nbgrader": {**marks, "cell_type": "code"}}}


def raw(lesson: Lesson, name: str, text: str) -> Cell:
    """A raw cell, as otter marks what lies between."""
    return {"cell_type": "raw", "id": named(lesson, name), "metadata": {}, "source": text}


def code(lesson: Lesson, name: str, text: str) -> Cell:
    """A cell of code."""
    cell = {"cell_type": "code", "id": named(lesson, name), "metadata": {}, "source": text}
    return {**cell, "outputs": [], "execution_count": None}


def named(lesson: Lesson, name: str) -> str:
    """An id of a cell, as short as they must be."""
    return f"{lesson.name[:2]}-{name}"[:64].replace("_", "-")


def with_source(cell: Cell, text: str) -> Cell:
    """A cell with another text, that anybody may see."""
    shown = {name: value for name, value in cell["metadata"].items() if name != "jupyter"}
    return {**cell, "source": text, "metadata": shown}


def without_output(cell: Cell) -> Cell:
    """A cell as it is before it has run."""
    return {**cell, "outputs": [], "execution_count": None} if cell["cell_type"] == "code" else cell


def instructors(lesson: Lesson) -> list[Cell]:
    """The cells of the instructor's edition: all, with solutions and notes."""
    return lesson.cells


WORKSHEET = "worksheet"
EDITIONS = {"learner": learners, "instructor": instructors, "otter": otter, "nbgrader": nbgrader}
"""Each edition by its name: the cells of a lesson."""


def write_editions(
    folder: str | PathLike[str], out: str | PathLike[str], *editions: str, learner: str = WORKSHEET
) -> list[Path]:
    """Write editions of the lessons in a folder (or of one notebook) to folders of their names in ``out``.

    They are ``"learner"``, ``"instructor"``, ``"otter"`` and ``"nbgrader"`` (what these two programs start from), and
    ``"worksheet"``, a PDF with the numbers of ``learner``; without any, all but the worksheet, which needs the extra
    ``report``.
    """
    refuse_arguments(write_editions, locals())
    if unknown := {*editions} - {*EDITIONS, WORKSHEET}:
        raise ValueError(f"there is no edition {sorted(unknown)[0]!r}; there are {', '.join((*EDITIONS, WORKSHEET))}")
    lessons = lessons_in(folder)
    return [
        path for name in editions or EDITIONS for each in lessons for path in _write(each, name, Path(out), learner)
    ]


def _write(lesson: Lesson, edition: str, out: Path, learner: str) -> Iterator[Path]:
    place = out / edition
    place.mkdir(parents=True, exist_ok=True)
    if edition == WORKSHEET:
        from .worksheet import worksheet

        yield _saved(place / f"{lesson.name}.pdf", worksheet(lesson, learner))
        return
    notebook = {**lesson.notebook, "cells": EDITIONS[edition](lesson)}
    text = json.dumps(notebook, ensure_ascii=False, indent=1) + "\n"
    yield _saved(place / f"{lesson.name}.ipynb", text.encode())
    if edition != "instructor":
        yield _saved(place / f"{lesson.module}.py", lesson.definitions.encode())


def _saved(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path
