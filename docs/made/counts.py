"""What holds the numbers of this package, counted in the repository while the page is made."""

import ast
import doctest
import json
from functools import cache
from pathlib import Path

from camkit.data import load

from .held import REPOSITORY, functions
from .ledger import compared
from .tables import table

TESTS = REPOSITORY / "tests"


@cache
def tests() -> list[tuple[Path, str]]:
    """Every test function: its file, and its text with what decorates it."""
    files = [(path.relative_to(TESTS), functions(path)) for path in sorted(TESTS.rglob("test_*.py"))]
    return [(path, text) for path, of in files for name, text in of.items() if name.startswith("test_")]


def marked(word: str) -> int:
    """How many tests have a decorator or a call of that name."""
    return sum(word in text for _, text in tests())


def below(folder: str) -> int:
    return sum(path.parts[0] == folder for path, _ in tests())


def examples() -> int:
    """Lines of examples in docstrings, all of which are run."""
    parser = doctest.DocTestParser()
    texts = (path.read_text(encoding="utf-8") for path in (REPOSITORY / "camkit").rglob("*.py"))
    docs = (ast.get_docstring(node) or "" for text in texts for node in ast.walk(ast.parse(text)) if documented(node))
    return sum(len(parser.get_examples(doc)) for doc in docs)


def documented(node: ast.AST) -> bool:
    return isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))


def cells() -> int:
    """Code cells of the notebooks, whose outputs are compared with the stored ones."""
    books = (json.loads(path.read_text(encoding="utf-8")) for path in (REPOSITORY / "notebooks").rglob("*.ipynb"))
    return sum(cell["cell_type"] == "code" for book in books for cell in book["cells"])


def kinds() -> str:
    """The kinds of checks, with how many there are."""
    held = load("measures_held")
    printed = sum(len(found.rows) for _, found in compared())
    rows = [
        ("tests in all", len(tests()), "each holds one sentence, which is its name"),
        (
            "tests of any design",
            marked("@given"),
            "hypothesis draws hundreds of designs and looks for one that breaks it",
        ),
        (
            "tests that read a refusal",
            marked("pytest.raises"),
            "bad input gives a sentence that names what is possible",
        ),
        ("tests in a browser", below("browser"), "a real JupyterLab in a real Chromium: drag, type, press keys"),
        ("tests with a foreign reader", below("tools"), "files read back by the programs a workshop has"),
        ("measures held by a test", sum(map(len, held.values())), "the page of a panel names the test of each measure"),
        ("numbers of papers", printed, "beside what is computed, with a verdict: [the ledger](papers.md)"),
        ("examples in docstrings", examples(), "run as they stand"),
        ("cells of notebooks", cells(), "run anew, each output compared with the stored one"),
    ]
    return table(("what", "how many", "what it is"), rows)


def folders() -> str:
    """Tests by the part of the package that they look at."""
    names = sorted({path.parts[0] for path, _ in tests() if len(path.parts) > 1})
    rows = [(f"`{name}`", below(name)) for name in names]
    return table(("part", "tests"), [*rows, ("the house itself", len(tests()) - sum(count for _, count in rows))])
