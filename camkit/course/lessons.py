"""A lesson: a notebook whose cells say by their tags what they are for, and the exercises in it."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from types import ModuleType
from typing import Any

from .exercises import Exercise

EXERCISE, SOLUTION, INSTRUCTOR = "exercise", "solution", "instructor"
"""Tags: a cell that defines an exercise and shows it; the worked solution; what is for the instructor alone."""
Cell = dict[str, Any]
"""A cell of a notebook, as nbformat 4 has it."""


@dataclass(frozen=True)
class Lesson:
    """The notebook of a lesson, the instructor's edition: the one source of all others."""

    path: Path
    notebook: dict[str, Any]

    @property
    def cells(self) -> list[Cell]:
        """All of its cells."""
        found: list[Cell] = self.notebook["cells"]
        return found

    @property
    def name(self) -> str:
        """What its files are called."""
        return self.path.stem

    @property
    def title(self) -> str:
        """Its first heading."""
        heads = (re.match(r"# (.+)", source(cell)) for cell in self.cells if cell["cell_type"] == "markdown")
        return next((head[1] for head in heads if head), self.name)

    @property
    def module(self) -> str:
        """The module of its exercises, in which all that says their answers stands, out of a learner's sight."""
        return f"exercises_{self.name}"

    @cached_property
    def definitions(self) -> str:
        """The code of that module: what the notebook imports, and what its cells of exercises define."""
        shown = [cell for cell in self.cells if cell["cell_type"] == "code" and not tags(cell) & {SOLUTION, INSTRUCTOR}]
        imports = dict.fromkeys(line for cell in shown for line in _imports(source(cell)))
        defined = [split(source(cell))[0] for cell in shown if EXERCISE in tags(cell)]
        head = f'"""The exercises of the lesson {self.name}; their answers are computed here."""'
        return "\n\n".join([head, "\n".join(imports), *filter(None, defined)]) + "\n"

    @cached_property
    def exercises(self) -> dict[str, Exercise]:
        """Its exercises by their names in the code."""
        made = ModuleType(self.module)
        exec(compile(self.definitions, f"{self.module}.py", "exec"), vars(made))
        return {name: thing for name, thing in vars(made).items() if isinstance(thing, Exercise)}


def read_lesson(path: str | PathLike[str]) -> Lesson:
    """The lesson in a notebook; ``ValueError`` for what is none."""
    path = Path(path)
    try:
        found = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or found.get("nbformat") != 4 or not isinstance(found.get("cells"), list):
        raise ValueError(f"{path} is no notebook of nbformat 4")
    lesson = Lesson(path, found)
    if not lesson.exercises:
        raise ValueError(f"{path} has no exercise: a cell with the tag {EXERCISE!r} defines one and shows it")
    return lesson


def lessons_in(folder: str | PathLike[str]) -> list[Lesson]:
    """The lessons of a folder in the order of their names; one notebook is a folder of one."""
    place = Path(folder)
    found = [place] if place.is_file() else sorted(place.glob("[0-9]*.ipynb"))
    if not found:
        raise ValueError(f"there is no lesson in {place}: their notebooks begin with a number, as 01_motion_laws.ipynb")
    return [read_lesson(path) for path in found]


def tags(cell: Cell) -> set[str]:
    """What a cell is for."""
    return {*cell["metadata"].get("tags", ())}


def source(cell: Cell) -> str:
    """The text of a cell."""
    return "".join(cell["source"])


def split(code: str) -> tuple[str, str]:
    """What a cell of an exercise defines, its imports apart, and what it shows: its last line.

    >>> split("from math import pi\\n\\nturn = 2 * pi\\nturn")
    ('turn = 2 * pi', 'turn')
    """
    *defined, last = ast.parse(code).body
    ends = isinstance(last, ast.Expr)
    kept = [part for part in (*defined, *([] if ends else [last])) if not isinstance(part, ast.Import | ast.ImportFrom)]
    return "\n".join(ast.get_source_segment(code, part) or "" for part in kept), ast.unparse(last) if ends else ""


def attempted(code: str) -> tuple[str, str] | None:
    """Of a cell in which a learner answers, nothing but a call of ``check``: its exercise and what is given.

    >>> attempted("peak.check(...)  # your number")
    ('peak', '...')
    """
    body = ast.parse(code).body
    call = body[0].value if len(body) == 1 and isinstance(body[0], ast.Expr) else None
    if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Attribute) or call.func.attr != "check":
        return None
    given = [*map(ast.unparse, call.args), *(f"{each.arg}={ast.unparse(each.value)}" for each in call.keywords)]
    return ast.unparse(call.func.value), ", ".join(given)


def _imports(code: str) -> Iterator[str]:
    for part in ast.parse(code).body:
        if isinstance(part, ast.Import | ast.ImportFrom):
            yield ast.unparse(part)
