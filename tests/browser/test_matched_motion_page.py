"""A motion with matched transitions on the page: its angle and its velocity move the picture, and it stays smooth."""

import nbformat

from camkit import TranslatingRollerCam
from camkit.cam import max_pressure_angle, peak_acceleration
from camkit.motion import Dwell, MatchedProgram, Polynomial, Uniform
from camkit.quantities import quantities_of, with_quantities
from camkit.quantities.tree import label
from camkit.units import deg, inch, mm, rpm
from camkit.views import default_views
from lab import Instrument, eventually, open_notebook, run_all
from test_living_page import compare

CELL = """
from camkit import TranslatingRollerCam, explore
from camkit.cam import max_pressure_angle, peak_acceleration
from camkit.motion import Dwell, MatchedProgram, Polynomial, Uniform
from camkit.units import deg, inch, mm, rpm
belt = Uniform(22 * inch / (58 * rpm), 1.1 * inch, name="hold")
motion = MatchedProgram((Polynomial(60 * deg, name="up"), belt, Polynomial(name="back"), Dwell(60 * deg)))
app = explore(TranslatingRollerCam(motion, base_radius=120 * mm), measures=[max_pressure_angle, peak_acceleration])
app
"""
MEASURES = (max_pressure_angle, peak_acceleration)
BELT = Uniform(22 * inch / (58 * rpm), 1.1 * inch, name="hold")
MOTION = MatchedProgram((Polynomial(60 * deg, name="up"), BELT, Polynomial(name="back"), Dwell(60 * deg)))
START = TranslatingRollerCam(MOTION, base_radius=120 * mm)
ANGLE, VELOCITY = "motion.up.angle", "motion.hold.velocity"


def test_a_conveyor_follows_its_sliders(page, server):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "conveyor.ipynb")
    open_notebook(page, "conveyor.ipynb")
    run_all(page)
    app, paths = Instrument(page), list(quantities_of(START))
    app.shows(START, MEASURES)
    moved = START
    for path in (ANGLE, VELOCITY):
        before = app.shown()
        slider = app.slider(_label(path))
        slider.focus()
        for _ in range(4):
            slider.press("ArrowRight")
        eventually(lambda before=before: app.shown()["values"] != before["values"])
        moved = with_quantities(moved, {path: app.shown()["values"][paths.index(path)]})
        app.shows(moved, MEASURES)
        assert app.shown()["pictures"] != before["pictures"]
        compare(app.shown(), moved, default_views(moved.analyse()), MEASURES)
        assert all(joint.lawful for joint in moved.motion.transitions())
    app.type(_label(ANGLE), "350")
    app.root.locator(".camkit-over", has_text="the other parts take").wait_for()


def _label(path):
    quantity = quantities_of(START)[path]
    return f"{label(path, quantity)}, {quantity.unit}"
