"""The harness itself, proved on a tiny notebook: a slider, and a label that mirrors it."""

import sys
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import Page, expect

from lab import LabServer, cell_output, kernel_value, open_notebook, run_all

SLIDER = """
import ipywidgets as w
slider = w.FloatSlider(value=5, min=0, max=10, step=0.5)
label = w.HTML("untouched")
slider.observe(lambda change: setattr(label, "value", f"now {change.new}"), "value")
"""


def write(server: LabServer, name: str, *cells: str) -> None:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell.strip()) for cell in cells])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / name)


def test_a_slider_moves_the_kernel_of_this_python_and_the_page(page: Page, server: LabServer) -> None:
    write(server, "slider.ipynb", SLIDER, "w.VBox([slider, label])", "import sys, camkit")
    open_notebook(page, "slider.ipynb")
    run_all(page)
    output = cell_output(page, 1)
    expect(output).to_contain_text("untouched")

    output.get_by_role("slider").press("ArrowRight")

    expect(output).to_contain_text("now 5.5")
    assert kernel_value(page, "slider.value") == 5.5
    assert kernel_value(page, "[label.value, __import__('numpy').arange(3)]") == ["now 5.5", [0, 1, 2]]
    assert kernel_value(page, "sys.prefix") == sys.prefix
    assert Path(kernel_value(page, "list(camkit.__path__)")[0]) == Path(__file__).parents[2] / "camkit"


def test_a_cell_that_fails_is_named(page: Page, server: LabServer) -> None:
    write(server, "error.ipynb", "radius = 1", "radius / 0", "never = 'reached'")
    open_notebook(page, "error.ipynb")
    with pytest.raises(AssertionError, match=r"cell 1 ended in an error:\nradius / 0\n(.|\n)*ZeroDivisionError"):
        run_all(page)
    with pytest.raises(AssertionError, match="NameError: name 'never' is not defined"):
        kernel_value(page, "never")


def test_a_cell_that_hangs_is_named(page: Page, server: LabServer) -> None:
    write(server, "hangs.ipynb", "import time", "time.sleep(60)")
    open_notebook(page, "hangs.ipynb")
    with pytest.raises(AssertionError, match=r"after 1 s cell 1 still runs:\ntime.sleep\(60\)"):
        run_all(page, timeout=1)
