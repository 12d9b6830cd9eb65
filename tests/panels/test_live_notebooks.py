"""Every control of the live notebooks: it can be moved, and comes back; and how many widgets a notebook holds."""

from pathlib import Path

import ipywidgets as w
import matplotlib.pyplot as plt
import nbformat
import pytest
from ipywidgets.widgets import widget
from try_everything import inside, try_everything

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
MODELS = 40
"""Widget models that a notebook may hold: each is a message of its own before the first panel is seen."""
LIVE = sorted(path.name for path in NOTEBOOKS.glob("*.ipynb") if "widget-view" in path.read_text(encoding="utf-8"))
TABS = {
    "08_valve_cam.ipynb": ["Map", "Front"],
    "16_decision.ipynb": ["Judgements", "Front", "Decision", "Designs"],
    "17_tolerances.ipynb": ["Tolerances"],
}
"""What stands beside the curves of a notebook's first panel."""


@pytest.mark.slow
@pytest.mark.parametrize("name", LIVE)
def test_every_control_moves_and_comes_back(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a search is kept beside the notebook
    made, others = {"__name__": "__main__"}, set(widget._instances)
    for cell in nbformat.read(NOTEBOOKS / name, as_version=4).cells:
        if cell.cell_type == "code":
            exec(cell.source, made)
    assert 0 < len(set(widget._instances) - others) <= MODELS
    assert name not in TABS or [tab["title"] for tab in made["app"].tabs] == TABS[name]
    named = {id(panel): panel for panel in made.values() if isinstance(panel, w.DOMWidget)}
    held = {id(part) for panel in named.values() for part in inside(panel)[1:]}
    panels = [panel for panel in named.values() if id(panel) not in held]
    assert sum(map(try_everything, panels)) > 0
    for panel in panels:
        getattr(panel, "settle", bool)()
    plt.close("all")
