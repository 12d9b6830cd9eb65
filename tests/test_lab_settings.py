"""`make lab`: what its JupyterLab is set to, under the names that JupyterLab knows."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

REPOSITORY = Path(__file__).parents[1]
SETTINGS = REPOSITORY / ".jupyter" / "labconfig" / "default_setting_overrides.json"
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.ipynb"))


@pytest.mark.skipif(not shutil.which("make"), reason="no make here")
@pytest.mark.parametrize("others", ["", "/elsewhere"])
def test_settings_stand_beside_those_that_are_there(others):
    """As the shell says them: JupyterLab's own folder stays the user's."""
    said = subprocess.run(
        ["make", "-n", "-o", ".venv/.lab", "lab"],
        cwd=REPOSITORY, env=os.environ | {"JUPYTER_CONFIG_PATH": others}, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    line = next(line for line in said.splitlines() if " lab " in line and "JUPYTER_CONFIG_PATH=" in line)
    value = line.partition("JUPYTER_CONFIG_PATH=")[2].split(" ")[0]
    path = subprocess.run(
        ["sh", "-c", f"echo {value}"], env=os.environ | {"JUPYTER_CONFIG_PATH": others}, capture_output=True, text=True
    ).stdout.strip()
    assert path == os.pathsep.join(filter(None, [str(REPOSITORY / ".jupyter"), others]))


def test_jupyterlab_knows_every_setting():
    schemas = [*Path(sys.prefix, "share/jupyter/lab/schemas").rglob("*.json")]
    schemas += Path(sys.prefix, "share/jupyter/labextensions").rglob("schemas/**/*.json")
    for plugin, settings in json.loads(SETTINGS.read_text()).items():
        package, _, name = plugin.partition(":")
        schema = next(json.loads(p.read_text()) for p in schemas if p.as_posix().endswith(f"{package}/{name}.json"))
        for key, value in settings.items():
            declared = schema["properties"][key]
            assert isinstance(value, {"boolean": bool, "string": str}[declared["type"]])
            assert value != declared["default"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_says_its_language_and_holds_no_state(path):
    """JupyterLab would mark it unsaved as it opens; a code host refuses to show one that holds widgets."""
    metadata = nbformat.read(path, as_version=4).metadata
    assert metadata.keys() == {"kernelspec", "language_info"}
    assert metadata.kernelspec == {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    assert metadata.language_info.file_extension == ".py"


LIVE = [path for path in NOTEBOOKS if "_paper" not in path.stem and "widget-view+json" in path.read_text("utf-8")]


@pytest.mark.parametrize("path", LIVE, ids=lambda path: path.stem)
def test_a_live_notebook_is_one_paragraph_and_its_panel(path):
    """What is behind it stands below; code that only shows something is folded, to be unfolded by whoever wants it."""
    cells = nbformat.read(path, as_version=4).cells
    panel = next(k for k, cell in enumerate(cells) if "widget-view+json" in str(cell.get("outputs")))
    title, *_ = (cell.source for cell in cells[:panel] if cell.cell_type == "markdown")
    assert title.startswith("# ")
    assert title.count("\n\n") == 1
    assert sum(cell.cell_type == "markdown" for cell in cells[:panel]) == 1
    for cell in cells:
        if cell.cell_type == "code" and (not cell.outputs or "image/png" in str(cell.outputs)):
            assert cell.metadata.jupyter.source_hidden
