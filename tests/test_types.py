"""What type checkers find in users' code, and how much the annotations of camkit say."""

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]
USER = REPOSITORY / "tests/data/user/study_of_mine.py"


@pytest.mark.slow
def test_mypy_finds_a_wrong_argument_in_users_code_and_nothing_else(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", "--config-file="]
    given = {**os.environ, "MYPYPATH": str(REPOSITORY)}
    done = subprocess.run(
        [*command, "--config-file=", str(USER)], capture_output=True, text=True, env=given, cwd=tmp_path
    )
    found = {int(line) for line in re.findall(r"study_of_mine\.py:(\d+): error", done.stdout)}
    lines = USER.read_text(encoding="utf-8").splitlines()
    assert found == {number for number, line in enumerate(lines, 1) if line.endswith("# wrong")}, done.stdout


def modules() -> Iterator[ast.Module]:
    for path in (REPOSITORY / "camkit").rglob("*.py"):
        yield ast.parse(path.read_text(encoding="utf-8"))


def annotations() -> Iterator[ast.expr]:
    """Of every argument, result and field in camkit."""
    for node in (node for module in modules() for node in ast.walk(module)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            given = node.args
            each = (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg)
            yield from (argument.annotation for argument in each if argument and argument.annotation)
            if node.returns:
                yield node.returns
        elif isinstance(node, ast.AnnAssign):
            yield node.annotation


def names(part: ast.AST) -> set[str]:
    return {each.id for each in ast.walk(part) if isinstance(each, ast.Name)}


def vague() -> set[str]:
    """``Any``, and the names of types that are made of it."""
    found = {"Any"}
    for module in modules():
        for node in module.body:
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value and "Any" in names(node.value):
                found |= names(node.targets[0] if isinstance(node, ast.Assign) else node.target)
    return found


def test_annotations_say_something() -> None:
    every, hollow = list(annotations()), vague()
    share = sum(not hollow.isdisjoint(names(each)) for each in every) / len(every)
    assert len(every) > 5000
    assert share <= 0.05
