"""What users import: names of camkit and of its wings, in notebooks, in the text files and in examples."""

import ast
import json
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

import camkit

REPOSITORY = Path(__file__).parents[1]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.ipynb"))
WINGS = {p.stem for p in (REPOSITORY / "camkit").iterdir() if p.name not in ("__init__.py", "__pycache__", "py.typed")}


def sources() -> Iterator[tuple[str, str]]:
    """Code that is written for readers to follow: where it stands, and what it says."""
    for path in NOTEBOOKS:
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                yield path.name, "".join(cell["source"])
    for path in (REPOSITORY / "README.md", REPOSITORY / "CONTRIBUTING.md"):
        for code in re.findall(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL):
            yield path.name, code
    for path in REPOSITORY.glob("camkit/**/*.py"):
        for line in re.findall(r">>> ((?:from|import) camkit.*)", path.read_text(encoding="utf-8")):
            yield path.name, line


def imported() -> list[tuple[str, str, str]]:
    """Where something is imported from camkit, from which module, and its name."""
    found = []
    for where, code in sources():
        for node in ast.walk(ast.parse(code)):
            if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "camkit":
                found += [(where, node.module or "", alias.name) for alias in node.names]
            if isinstance(node, ast.Import):
                found += [(where, "", a.name) for a in node.names if a.name.startswith("camkit.")]
    return found


def public(module: str) -> set[str]:
    """The names that a module offers."""
    found = import_module(module)
    own = {name for name, thing in vars(found).items() if getattr(thing, "__module__", module) == module}
    return set(getattr(found, "__all__", {name for name in own if name[0] != "_"}))


def test_the_names_are_those_that_users_need_first() -> None:
    units = {name for name in camkit.__all__ if isinstance(getattr(camkit, name), float)}
    assert {"inch", "lbf", "psi", "um"} < units
    assert len(set(camkit.__all__) - units) == len(camkit.__all__) - len(units) <= 70


def test_notebooks_texts_and_examples_import_from_camkit_and_its_wings_only() -> None:
    imports = imported()
    assert len(imports) > 300
    deep = [one for one in imports if one[1] != "camkit" and one[1].removeprefix("camkit.") not in WINGS]
    assert deep == []
    offered = {module: public(module) for module in {module for _, module, _ in imports}}
    assert [one for one in imports if one[2] not in offered[one[1]]] == []


@pytest.mark.parametrize("wing", sorted(WINGS))
def test_a_wing_lists_what_it_offers(wing: str) -> None:
    module = import_module(f"camkit.{wing}")
    assert all(hasattr(module, name) for name in public(f"camkit.{wing}"))
    assert public(f"camkit.{wing}") <= set(dir(module))
    if hasattr(module, "__all__"):
        assert module.__doc__
        assert len(module.__all__) == len(set(module.__all__))
