"""A barrel cam on the page: the drum in space and unrolled, as the package draws and measures them."""

import nbformat

from camkit.cam import BarrelCam, bottom_pressure_angle, max_pressure_angle, undercut_margin
from camkit.units import mm
from camkit.views import default_views
from lab import Instrument, open_notebook, run_all
from test_living_page import compare

CELL = """
from camkit import explore
from camkit.cam import BarrelCam, bottom_pressure_angle, max_pressure_angle, undercut_margin
app = explore(BarrelCam(), measures=[max_pressure_angle, bottom_pressure_angle, undercut_margin])
app
"""
MEASURES = (max_pressure_angle, bottom_pressure_angle, undercut_margin)


def test_a_drum_lives_on_the_page(page, server):
    page.set_viewport_size({"width": 1366, "height": 768})
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "barrel.ipynb")
    open_notebook(page, "barrel.ipynb")
    run_all(page)
    app, views = Instrument(page), default_views(BarrelCam().analyse())
    app.type("cam angle, deg", "75")
    app.type("mean radius, mm", "80")
    app.type("roller radius, mm", "30")
    design = BarrelCam(mean_radius=80 * mm, roller_radius=30 * mm)
    app.shows(design, MEASURES)
    compare(app.shown(), design, views, MEASURES)
    app.type("roller radius, mm", "80")
    app.root.locator(".camkit-over", has_text="both together must stay below").wait_for()
