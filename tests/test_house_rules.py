"""What the house asks of names: what serves every mechanism names none."""

import ast
import re
from pathlib import Path

import pytest

from camkit import machines as wing

CAMKIT = Path(__file__).parents[1] / "camkit"
GENERAL = [path for wing in ("study", "search", "views", "render", "panels") for path in CAMKIT.glob(f"{wing}/**/*.py")]
SHOWING = [path for path in GENERAL if path.relative_to(CAMKIT).parts[0] in ("views", "render", "panels")]


def machines() -> set[str]:
    """The modules and the classes of machines, but for the word shaft, which any machine may have."""
    modules = {path.stem for path in CAMKIT.glob("machines/*.py")} - {"__init__", "shaft"}
    return modules | {name.lower() for name in wing.__all__ if isinstance(getattr(wing, name), type)}


def names_in(source: str) -> set[str]:
    """Every identifier of a module's code and every word in its strings, docstrings apart."""
    tree = ast.parse(source)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    said = {
        id(node.body[0].value) for node in ast.walk(tree) if isinstance(node, documented) and ast.get_docstring(node)
    }
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in said:
            found |= set(re.findall(r"\w+", node.value))
        for field in ("id", "attr", "arg", "name", "module"):
            if isinstance(name := getattr(node, field, None), str):
                found |= {name, *name.split(".")}
    return found


@pytest.mark.parametrize("path", GENERAL, ids=lambda path: str(path.relative_to(CAMKIT)))
def test_what_serves_every_mechanism_names_none(path: Path) -> None:
    names = {name.lower() for name in names_in(path.read_text(encoding="utf-8"))}
    assert not names & machines()
    assert not [name for name in names if re.search("door|valve|high_?speed|lever|cabin|rssr|universal_?joint", name)]


@pytest.mark.parametrize("path", SHOWING, ids=lambda path: str(path.relative_to(CAMKIT)))
def test_what_shows_a_design_names_no_quantity_of_one(path: Path) -> None:
    """`roller_radius` stands for all: a view draws the circles that an analysis offers."""
    assert "roller_radius" not in path.read_text(encoding="utf-8")


OF_PYTHON = {"_fields", "_instances", "_execution_data", "_repr_html_", "_repr_mimebundle_", "_repr_png_"}
"""Of Python, IPython and Jupyter, for which there is no other name."""


def hidden(source: str) -> set[str]:
    """What assertions ask of others' private members, in expressions for the kernel too."""
    asserted = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Assert)]
    nodes = [node for each in asserted for node in ast.walk(each)]
    asked = {node.attr for node in nodes if isinstance(node, ast.Attribute) and ast.unparse(node.value) != "self"}
    texts = " ".join(node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str))
    names = asked | set(re.findall(r"\w\.(_\w+)", texts))
    return {name for name in names if re.match("_[a-z]", name)} - OF_PYTHON


def test_nothing_is_asserted_of_private_members() -> None:
    sources = {path.name: path.read_text(encoding="utf-8") for path in Path(__file__).parent.rglob("*.py")}
    assert {name: found for name, source in sources.items() if (found := hidden(source))} == {}
    example = "assert app._{}.named or kernel_value(page, 'app._{}')".format("keeper", "page")
    assert hidden(example) == {"_keeper", "_page"}


def test_a_name_would_be_found() -> None:
    assert {"valvecam", "highspeedcam", "door_handle", "universaljointshaft"} <= machines()
    source = 'from camkit.machines.valve_cam import ValveCam\nprint("a roller_radius here", ValveCam().max_lift)\n'
    assert {"valve_cam", "ValveCam", "roller_radius", "max_lift"} <= names_in(source)
    assert names_in('"""RSSR"""\n') == set()
