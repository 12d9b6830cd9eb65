"""The test of the house: a cam that nobody here thought of, in fifteen lines of a notebook.

An oscillating flat follower, a measured rise, a return with two free coefficients of its law, spring rate and preload
free: it gets sliders, a front that follows them, a choice by judgements and a yield, without an edit to the package.
"""

import ast
import importlib
import pkgutil

import numpy as np
import pytest
from hand import move, sliders
from numpy.testing import assert_allclose, assert_array_equal

import camkit
from camkit import Tolerances
from camkit.quantities import value_of

NOTEBOOK = """
from camkit import (Cycloidal, Dwell, Judgements, MotionProgram, OscillatingFlatCam, Return, Rise, Study, ahp_panel,
                    deg, explore, live_pareto_panel, mm, tolerance_panel)
from camkit.cam import jump_margin, min_force, min_profile_radius, peak_force
from camkit.motion import ShapedLaw, TableLaw
measured = [0, 0.05, 0.36, 1.09, 2.29, 4.05, 6.01, 7.97, 9.72, 10.91, 11.65, 11.96, 12]  # deg, every 1/12 of the rise
rise = Rise(110 * deg, 12 * deg, TableLaw([i / 12 for i in range(13)], [s / 12 for s in measured], 0.005))
back = Return(110 * deg, 12 * deg, ShapedLaw(Cycloidal()))
cam = OscillatingFlatCam(MotionProgram((rise, Dwell(50 * deg), back, Dwell(90 * deg))), face_offset=20 * mm)
free = ["motion.return.law.c1", "motion.return.law.c2", "load.spring_rate", "load.preload"]
study = Study(cam, free, (peak_force, -jump_margin), at_least={min_force: 5, min_profile_radius: 15 * mm})
app = explore(cam, free=free, measures=cam.measures)
choice = ahp_panel(Judgements(["little force", "high speed"], [3]))
live = live_pareto_panel(app, study, importance=choice)
live.select(live.winner)
spread = tolerance_panel(app, study, {"load.spring_rate": 1, "load.preload": 1, "face_offset": 0.2 * mm}, front=live)
"""


def _lines(source):
    """Lines of a notebook as a person counts them: statements, however they are broken."""
    return len(ast.parse(source).body)


@pytest.fixture(scope="module")
def made():
    """All that the notebook makes, by name."""
    names: dict = {}
    exec(NOTEBOOK, names)
    yield names
    names["live"].settle()
    names["spread"].settle()


def test_it_takes_fifteen_lines_and_imports_from_camkit_and_its_wings_alone():
    assert _lines(NOTEBOOK) <= 15
    wings = {f"camkit.{module.name}" for module in pkgutil.iter_modules(camkit.__path__) if module.ispkg}
    taken = {node.module for node in ast.walk(ast.parse(NOTEBOOK)) if isinstance(node, ast.ImportFrom)}
    assert taken <= wings | {"camkit"}
    for node in ast.walk(ast.parse(NOTEBOOK)):
        if isinstance(node, ast.ImportFrom):
            names = {alias.name for alias in node.names}
            assert names <= set(importlib.import_module(node.module).__all__)


def test_every_free_quantity_has_a_slider_and_every_curve_a_picture(made):
    app = made["app"]
    assert sliders(app) == made["free"]
    assert [view.__name__ for view in app.views][:3] == ["mechanism", "motion", "pressure_angle"]
    before, force = made["cam"], app.analysis.contact_force
    move(app, "motion.return.law.c1", 0.1)
    assert value_of(app.design, "motion.return.law.c1") == 0.1
    assert np.abs(app.analysis.contact_force - force).max() > 0.01
    app.load(before)


def test_the_front_follows_the_design_and_its_winner_is_that_of_the_judgements(made):
    live, study, choice = made["live"], made["study"], made["choice"]
    live.settle()
    front = live.front
    assert len(front) > 20
    assert study.evaluate(front.x).feasible.all()
    assert_allclose(study.evaluate(front.x).f, front.f)
    assert not camkit.search.dominated(front.f).any()
    assert_allclose(choice.weights, [0.75, 0.25])
    live.picker.rule.value = "weighted sum"
    assert live.winner == camkit.weighted_sum(front, choice.weights)
    choice.load([1 / 9])
    assert live.winner == camkit.weighted_sum(front, [0.1, 0.9])
    assert front.f[live.winner, 1] == front.f[:, 1].min()  # who wants speed gets the highest
    choice.load([3])


def test_the_yield_is_that_of_the_parts_that_keep_the_limits(made):
    live, spread, study = made["live"], made["spread"], made["study"]
    live.settle()
    live.select(live.winner)
    spread.settle()
    parts = spread.tolerances
    assert parts.study.start == made["app"].design == live.front[live.winner]
    assert parts.x.shape == (len(parts.x), 3)
    motion, load = parts.study.start.motion, parts.study.start.load
    kept = []
    for rate, preload, offset in parts.x[::16]:
        part = made["cam"].replace(
            motion=motion, face_offset=offset, load=load.replace(spring_rate=rate, preload=preload)
        )
        at = part.analyse(study.angles)
        kept.append(all(measure(at) >= limit for measure, limit in study.at_least.items()))
    assert_array_equal(parts.evaluation.feasible[::16], kept)
    radius = made["min_profile_radius"]
    edge = parts.study.replace(at_least={radius: float(radius(parts.nominal))})
    assert Tolerances(edge, parts.half_widths, parts=512).share == pytest.approx(0.5, abs=0.05)  # as the face goes
    assert f"{100 * parts.share:.1f} % of parts" in spread.summary()
