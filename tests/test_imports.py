"""The maths needs numpy and scipy only, and what is installed from the wheel is all of camkit."""

import ast
import re
import subprocess
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

import camkit

REPOSITORY = Path(__file__).parents[1]

# The modules that need the [lab] extra; `import camkit` must not need them.
LAB = {"panels", "render"}
PYMOO = {"competitive", "evolution", "nsga2", "toolbox_genetic"}

# As on a machine where nothing else is installed: an import of anything else fails.
ONLY_NUMPY_AND_SCIPY = """
import importlib, sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        allowed = sys.stdlib_module_names | {"camkit", "numpy", "scipy"}
        if name.partition(".")[0] not in allowed and not name.startswith("_sysconfigdata"):  # named by platform
            raise ModuleNotFoundError(f"{name} is not part of the maths", name=name)

sys.meta_path.insert(0, Refuse())
for name in sys.argv[1:]:
    importlib.import_module(name)
"""


def python(*arguments: str | Path, executable: str | Path = sys.executable, **options) -> str:
    """What a Python process prints; its error is the test's error."""
    done = subprocess.run([executable, *arguments], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def maths() -> list[str]:
    """``camkit`` and every module below it that the maths is made of."""
    files = (path.relative_to(REPOSITORY).with_suffix("") for path in REPOSITORY.glob("camkit/**/*.py"))
    names = [".".join(part for part in path.parts if part != "__init__") for path in files]
    parts = [name.split(".") for name in names]
    lab = [p for p in parts if (p[1:2] and p[1] in LAB) or (p[1:2] == ["search"] and p[-1] in PYMOO)]
    return sorted(".".join(p) for p in parts if p not in lab)


def test_the_maths_imports_numpy_and_scipy_only() -> None:
    python("-c", ONLY_NUMPY_AND_SCIPY, *maths(), cwd=REPOSITORY)


OPENING = """
import sys
import camkit.papers
from camkit import DoorHandleCam, ahp_panel, explore, pareto_panel
from camkit.machines import door_handle
app, criteria = explore(DoorHandleCam()), ahp_panel(door_handle.PAPER_JUDGEMENTS)
later = {"scipy.optimize", "scipy.sparse", "scipy.spatial", "scipy.stats", "pymoo", "matplotlib", "PIL"}
print(*sorted(later & set(sys.modules)))
"""


def test_a_panel_opens_without_what_only_searches_and_still_pictures_need() -> None:
    assert python("-c", OPENING, cwd=REPOSITORY).strip() == ""


GROUND = {"units", "quantities", "geometry", "contact", "extrema", "data"}
WINGS = {*("motion", "cam", "linkage", "dynamics", "machines", "study", "search", "decision"), *("files", "papers"),
         *("views", "program", "render", "panels", "course")}  # fmt: skip


def imported(folder: str) -> set[str]:
    """The libraries that a folder's code imports, wherever in a file that stands."""
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in REPOSITORY.glob(f"{folder}/**/*.py")]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    plain = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    named = {node.module for node in nodes if isinstance(node, ast.ImportFrom) and not node.level and node.module}
    ours = {path.stem for path in REPOSITORY.glob("tests/**/*.py")} | {path.stem for path in REPOSITORY.glob("*/*.py")}
    return {name.partition(".")[0] for name in plain | named} - sys.stdlib_module_names - ours - {"camkit", "made"}


@pytest.mark.parametrize("folder", ["camkit", "tests", "benchmarks", "docs", ".jupyter"])
def test_what_is_imported_is_declared(folder: str) -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    tools = [each for extra in ("step", "print", "report", "docs", "cluster") for each in extras[extra]]
    listed = project["dependencies"] + extras["lab"] + extras["app"] + tools
    readers = re.findall(r"(?m)^NEEDS_\w+ := \S+ (.+)$", (REPOSITORY / "Makefile").read_text(encoding="utf-8"))
    listed += extras["test"] + " ".join(readers).split() if folder != "camkit" else []
    declared = {re.match(r"[\w-]+", each)[0].lower().replace("-", "_") for each in listed}  # type: ignore[index]
    found = {"OCP": ["cadquery-ocp-novtk"]} | packages_distributions()
    brought = {name: {d.lower().replace("-", "_") for d in by} for name, by in found.items()}
    assert {name for name in imported(folder) if not brought.get(name, {name}) & declared} == set()


def test_nothing_else_stands_at_the_root() -> None:
    beside = ("__init__.py", "__pycache__", "py.typed")
    found = {path.stem for path in (REPOSITORY / "camkit").iterdir() if path.name not in beside}
    assert found == GROUND | WINGS | {"__main__", "workbook"}


def test_a_forbidden_import_would_be_seen() -> None:
    refused = subprocess.run([sys.executable, "-c", ONLY_NUMPY_AND_SCIPY, "matplotlib"], capture_output=True, text=True)
    assert "matplotlib is not part of the maths" in refused.stderr


WING = """
import sys
import camkit.search as wing
assert set(wing.__all__) <= set(dir(wing))
assert "pymoo" not in sys.modules
from camkit.search import Front, Minimum, Step, search
from camkit.machines.high_speed_measures import high_speed_study
*_, last = search(high_speed_study(angles=61), "slsqp", seed=1)
of_pymoo = {"CompetitiveAlgorithm", "StudyProblem", "ToolboxGenetic"}
print(last.best.feasible, [name for name in wing.__all__ if name not in of_pymoo and not hasattr(wing, name)])
"""


def test_the_wing_of_searches_needs_pymoo_only_for_what_is_pymoos() -> None:
    assert python("-c", ONLY_NUMPY_AND_SCIPY + WING, cwd=REPOSITORY).split() == ["True", "[]"]


STAR = """
import camkit
from camkit import *

assert set(camkit.__all__) <= set(dir(camkit)), "dir leaves out a public name"
assert all(hasattr(camkit, name) for name in dir(camkit)), "dir lists what is not there"
print(TranslatingRollerCam().analyse(31).profile.shape, "nsga2" in globals(), "nsga2" in dir(camkit))
try:
    from camkit import nsga2
    print("loaded")
except ImportError as refused:
    print(refused)
"""


def test_a_star_import_without_the_extra_leaves_out_what_needs_it() -> None:
    said = python("-c", ONLY_NUMPY_AND_SCIPY + STAR, cwd=REPOSITORY).splitlines()
    assert said == ["(2, 31) False False", "nsga2 needs pymoo, which is not installed: pip install 'camkit[lab]'"]


def test_a_star_import_with_the_extra_brings_everything() -> None:
    assert python("-c", STAR, cwd=REPOSITORY).splitlines() == ["(2, 31) True True", "loaded"]
    assert set(camkit._LATER) <= set(camkit.__all__) <= set(dir(camkit))


def test_a_name_that_there_is_not_is_said() -> None:
    with pytest.raises(AttributeError, match=r"^camkit has no 'wobble'$"):
        camkit.wobble  # noqa: B018


def test_no_name_that_is_loaded_later_is_that_of_a_module() -> None:
    """Python binds a submodule to its package as soon as anybody imports it; the name would then be the module."""
    modules = {path.stem for path in (REPOSITORY / "camkit").iterdir()}
    assert not modules & camkit._LATER.keys()
    for name in camkit._LATER:
        assert callable(getattr(camkit, name))


WINGS_WITHOUT = """
import camkit
for name in ("panels", "render"):
    try:
        getattr(camkit, name)
    except ImportError as refused:
        print(refused)
print(camkit.views.mechanism.__name__)
"""


def test_a_wing_without_the_extra_says_what_it_needs() -> None:
    said = python("-c", ONLY_NUMPY_AND_SCIPY + WINGS_WITHOUT, cwd=REPOSITORY).splitlines()
    assert re.fullmatch(r"camkit\.panels needs \w+, which is not installed: pip install 'camkit\[lab\]'", said[0])
    assert said[1] == "camkit.render needs matplotlib, which is not installed: pip install 'camkit[lab]'"
    assert said[2:] == ["mechanism"]
