"""What users import: names of camkit and of its wings, in notebooks, in the text files and in examples."""

import ast
import json
import re
import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from hand import sliders

import camkit

REPOSITORY = Path(__file__).parents[1]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("**/[0-9]*.ipynb"))
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
    assert len(set(camkit.__all__) - units) == len(camkit.__all__) - len(units) <= 72


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


# ---------------------------------------------------------------- the map

TEXT = (REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8")
MAP = re.search(r"```\nnotebooks\n(.*?)```", TEXT, re.DOTALL)[1]  # type: ignore[index]


def test_the_map_names_what_stands_at_the_root_in_the_order_of_its_floors() -> None:
    floors = [re.findall(r"(\w+)/?(?=  |$)", line.strip().partition("    ")[0]) for line in MAP.splitlines()]
    assert sorted(name for floor in floors for name in floor) == sorted(WINGS)
    settings = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))
    layers = settings["tool"]["importlinter"]["contracts"][0]["layers"]
    height = {name.strip(" ()"): -i for i, layer in enumerate(layers) for name in layer.split("|")}
    assert height.keys() == WINGS
    drawn = [height[name] for floor in floors for name in floor]
    assert drawn == sorted(drawn, reverse=True)


def test_what_the_text_names_is_there() -> None:
    named = set(re.findall(r"`((?:camkit|tests|notebooks)/[\w/.]+)`", TEXT)) - {"camkit/linkage/slider_crank.py"}
    assert len(named) > 8
    assert [path for path in sorted(named) if not (REPOSITORY / path).exists()] == []
    inside = MAP + TEXT[TEXT.index("In `quantities/`") : TEXT.index("`make lint`")]
    parts = {path.stem for path in (REPOSITORY / "camkit/quantities").glob("*.py")} - {"__init__"}
    assert parts <= set(re.findall(r"`(\w+)`", inside))


@pytest.mark.parametrize("word", ["mechanism", "motion law", "objective or a limit", "search", "view", "panel"])
def test_what_is_added_is_one_file_or_a_line(word: str) -> None:
    begins = TEXT.split(f"## Add a{'n' if word[0] == 'o' else ''} {word}\n\n")[1]
    assert re.match("One (file|line)", begins)


def test_the_mechanism_of_the_walk_has_a_panel_a_study_and_a_minimum() -> None:
    """The stroke of a crank on the slider's line is twice the crank, whatever the rod."""
    code = next(code for where, code in sources() if where == "CONTRIBUTING.md" and "SliderCrank" in code)
    made: dict = {"__name__": "__main__"}
    exec(code, made)
    assert made["app"].design.crank == pytest.approx(0.025, rel=1e-6)
    assert set(sliders(made["app"])) >= {"crank", "rod"}
    assert "position of the slider" in made["app"].views[0].__name__.replace("_", " ")
