"""Every control of the live notebooks: it can be moved, and comes back; and how many widgets a notebook holds."""

import dis
from pathlib import Path
from types import CodeType

import ipywidgets as w
import matplotlib.pyplot as plt
import nbformat
import pytest
from ipywidgets.widgets import widget
from try_everything import inside, try_everything

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
OPTIONS = 3
"""So many of a menu are tried in a notebook; all of them in the tests of its panel."""
MODELS = 40
"""Widget models that a notebook may hold: each is a message of its own before the first panel is seen."""
LIVE = sorted(path.name for path in NOTEBOOKS.glob("*.ipynb") if "widget-view" in path.read_text(encoding="utf-8"))
TABS = {
    "08_valve_cam.ipynb": ["Map", "Front"],
    "16_decision.ipynb": ["Judgements", "Front", "Decision", "Designs"],
    "17_tolerances.ipynb": ["Tolerances"],
}
"""What stands beside the curves of a notebook's first panel."""


def stored(code):
    """The names that the code of a cell gives a value."""
    return {each.argval for each in dis.get_instructions(code) if each.opname == "STORE_NAME"}


def needed(code):
    """The names that it takes from cells before it, in its functions too."""
    found, own = set(), set()
    for each in dis.get_instructions(code):
        if each.opname == "STORE_NAME":
            own.add(each.argval)
        elif each.opname in ("LOAD_NAME", "LOAD_GLOBAL") and each.argval not in own:
            found.add(each.argval)
    return found.union(*(needed(part) - own for part in code.co_consts if isinstance(part, CodeType)))


def behind_panels(cells):
    """The code of the cells that show a panel, and of those whose names they need; nbval runs all the others too."""
    kept, wanted = [], set()
    for cell in reversed([cell for cell in cells if cell.cell_type == "code"]):
        code = compile(cell.source, "a cell", "exec")
        if "widget-view" in str(cell.outputs) or wanted & stored(code):
            kept, wanted = [code, *kept], wanted - stored(code) | needed(code)
    return kept


def test_a_panel_needs_the_cells_whose_names_it_uses():
    sources = ["x = y = 1", "z = 2", "def f(): return x", "for row in (z,): y = row", "print(y)", "for y in (1,): f(y)"]
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    cells[-1].outputs = [nbformat.v4.new_output("display_data", {"application/vnd.jupyter.widget-view+json": {}})]
    assert [sorted(stored(code)) for code in behind_panels(cells)] == [["x", "y"], ["f"], ["y"]]


@pytest.mark.slow
@pytest.mark.parametrize("name", LIVE)
def test_every_control_moves_and_comes_back(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a search is kept beside the notebook, and tables lie there
    (tmp_path / "data").symlink_to(NOTEBOOKS / "data")
    made, others = {"__name__": "__main__"}, set(widget._instances)
    for code in behind_panels(nbformat.read(NOTEBOOKS / name, as_version=4).cells):
        exec(code, made)
    assert 0 < len(set(widget._instances) - others) <= MODELS
    assert name not in TABS or [tab["title"] for tab in made["app"].tabs] == TABS[name]
    named = {id(panel): panel for panel in made.values() if isinstance(panel, w.DOMWidget)}
    held = {id(part) for panel in named.values() for part in inside(panel)[1:]}
    panels = [panel for panel in named.values() if id(panel) not in held]
    assert sum(try_everything(panel, OPTIONS) for panel in panels) > 0
    for panel in panels:
        getattr(panel, "settle", bool)()
    plt.close("all")
