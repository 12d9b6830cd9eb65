"""Panels that optimise in the background, driven in this process: what they find, how they stop, what they refuse."""

import threading

import numpy as np
import pytest
from hand import at, move
from numpy.testing import assert_allclose, assert_array_equal
from try_everything import try_everything

from camkit import Measure, explore
from camkit.machines.cam_lever import CamLever, cam_lever_study
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_measures import (
    GEOMETRY,
    high_speed_study,
    max_pressure_angle,
    min_radius,
    peak_stress,
    peak_wear,
)
from camkit.motion import ShapedLaw
from camkit.panels.cycle_time import cycle_time_panel
from camkit.panels.optimise import optimise_panel
from camkit.quantities import quantities_of
from camkit.search.cycle_time import shortest_interval
from camkit.search.minimise import minimise
from camkit.search.minimum import Minimum
from camkit.search.protocol import search, stepwise
from camkit.study.study import KEPT, Study
from camkit.units import cm, deg, mm
from camkit.views.intervals import contact_stress

FIRST = HighSpeedCam()
SIZES = high_speed_study(angles=101)
GOALS = {"stress": SIZES, "wear": SIZES.replace(minimise=(peak_wear,))}


def app_of(design):
    return explore(design, contact_stress, free=["arm_length", "roller_radius", "max_radius"])


PATIENCE = 60
"""How long, in seconds, something is waited for that happens at once on an idle machine."""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Where searches are kept."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def app():
    return app_of(FIRST)


def xy(panel, key):
    mark = panel.picture.shown[0][key]
    return np.array([mark.x, mark.y], dtype=float)


class Gate:
    """A measure that stands still once it has been asked ``after`` times, until it may go on."""

    def __init__(self, measure, after):
        self.measure, self.left = measure, after
        self.reached, self.open = threading.Event(), threading.Event()

    def __call__(self, analysis):
        self.left -= 1
        if self.left == 0:
            self.reached.set()
            assert self.open.wait(PATIENCE)
        return self.measure(analysis)

    def stop(self, panel):
        """Run ``panel`` to the gate and stop it there."""
        panel.run()
        assert self.reached.wait(PATIENCE)
        assert panel.runner.run_button.disabled
        assert not panel.runner.stop_button.disabled
        panel.stop()
        self.open.set()
        panel.wait(PATIENCE)
        assert not panel.runner.run_button.disabled
        assert panel.runner.stop_button.disabled


# --- the steps of a search --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["slsqp", "de", "ga"])
def test_a_search_in_steps_finds_the_same(method):
    study = high_speed_study(angles=101)
    best, steps = minimise(study, method, designs=1000), list(search(study, method, designs=1000))
    *before, last = steps
    assert_array_equal(last.best.x, best.x)
    assert (last.message, last.best.message, last.best.study) == (best.message, best.message, study)
    assert not any(step.message for step in before)
    assert last.evaluated >= best.evaluations
    assert before[-1].best.f == pytest.approx(best.f, rel=1e-6)
    seen = [step.summary for step in before]
    assert seen[-1].evaluated == last.evaluated == sum(len(step.evaluation.x) for step in before)
    assert min(each.f for each in seen if each.feasible) == before[-1].best.f


def steps_of(study, *populations):
    """The steps of a search that evaluates these populations, one after the other."""

    def work(followed):
        for x in populations:
            followed.evaluate(x)
        return Minimum(study, study.x0, 0.0, True, 0, message="done")

    return list(stepwise(study, work))[:-1]


def test_what_counts_as_the_best_so_far():
    study = high_speed_study()
    start, better, broken, unbuilt = study.x0, study.x0 * [1, 1.5, 1], study.x0 * [1, 1, 0.85], study.x0 * [1, 0.1, 9]
    evaluation = study.evaluate([start, better, broken, unbuilt])
    assert evaluation.feasible.tolist() == [True, True, False, False]
    assert evaluation.f[2, 0] < np.inf == evaluation.f[3, 0]
    steps = steps_of(study, [broken, unbuilt], [start, broken], [unbuilt, better], [start])
    assert [step.summary.feasible for step in steps] == [False, True, True, True]
    assert [step.evaluated for step in steps] == [2, 4, 6, 7]
    assert [step.best and step.best.f for step in steps] == [None, *evaluation.f[[0, 1, 1], 0]]
    assert_allclose(steps[-1].best.x, better)


def test_a_limit_may_be_missed_by_a_millionth():
    study, kept = high_speed_study(), []
    radius = float(min_radius(FIRST.analyse()))
    for share in (0.5, 2):
        (step,) = steps_of(study.replace(at_least={min_radius: radius * (1 + share * KEPT)}), [study.x0])
        kept.append(step.summary.feasible)
    assert kept == [True, False]


def test_a_limit_of_0_may_be_missed_by_the_tolerance_of_all_limits():
    study, kept = high_speed_study(), []
    radius = float(min_radius(FIRST.analyse()))
    for shift in (0.5, 2):
        below = Measure("radius less 44.6", "", lambda a, shift=shift: a.min_radius - radius + shift * KEPT)
        (step,) = steps_of(study.replace(at_most={below: 0.0}, at_least={}), [study.x0])
        kept.append(step.summary.feasible)
    assert kept == [True, False]


@pytest.mark.parametrize("method", ["slsqp", "de"])
def test_a_search_that_is_left_evaluates_nothing_more(method):
    asked, threads = [], threading.active_count()
    stress = Measure("stress", "N^0.5 mm^-0.5", lambda analysis: asked.append(1) or peak_stress(analysis))
    steps = search(high_speed_study(angles=101).replace(minimise=(stress,)), method)
    assert not asked
    next(steps)
    before = len(asked)
    steps.close()
    assert (len(asked), threading.active_count()) == (before, threads)
    assert list(steps) == []


def test_what_a_search_cannot_do_is_said():
    study = high_speed_study()
    with pytest.raises(ValueError, match="the method is 'best'; there are 'nsga2', 'fast_front', "):
        search(study, "best")
    with pytest.raises(ValueError, match=r"the method 'slsqp' cannot search like this: .*population"):
        search(study, population=3)
    with pytest.raises(ValueError, match="the study has 2 objectives; minimise takes one"):
        next(search(study.replace(minimise=(peak_stress, peak_wear)), "de"))


# --- optimise from here -----------------------------------------------------------------------------------------------


def test_the_optimum_comes_into_the_sliders_with_the_reason(app):
    panel = optimise_panel(app, GOALS)
    assert panel.summary().endswith("not run yet")
    panel.run()
    panel.wait(PATIENCE)
    best = minimise(high_speed_study(angles=101))
    assert panel.minimum.f == pytest.approx(best.f, rel=1e-9)
    for name, value in zip(GEOMETRY, best.x, strict=True):
        assert getattr(app.design, name) == pytest.approx(value, rel=1e-9)
        assert at(app, name) == pytest.approx(value / quantities_of(app.design)[name].factor, rel=1e-9)
    first = high_speed_study(angles=101).evaluate([best.study.x0]).f[0, 0]
    lines = panel.summary().split("\n")
    assert lines[0] == "problem: stress, method: slsqp"
    assert lines[1] == f"stress index F_sigma: {peak_stress.text(first)} → {peak_stress.text(best.f)}"
    assert lines[2] == best.message
    assert "radius at the far dwell 140 mm (upper bound)" in panel.verdict.text
    gain = peak_stress.text(-best.rates["max_radius"] * mm)
    assert f"1 mm more room for the radius at the far dwell: {gain} less {peak_stress.name}." in panel.verdict.text
    assert f"best so far {peak_stress.text(best.f)}" in panel.runner.status.text
    panel.back.click()
    assert app.design == FIRST


def test_it_starts_from_the_sliders_and_takes_what_is_chosen(app):
    panel = optimise_panel(app, GOALS, methods=("slsqp", "de"))
    move(app, "roller_radius", 50)
    panel.problem.value = "wear"
    panel.run()
    panel.wait(PATIENCE)
    start = FIRST.replace(roller_radius=50 * mm)
    assert_allclose(panel.study.x0[1], 50 * mm)
    assert panel.minimum.f == pytest.approx(minimise(high_speed_study(start, peak_wear, angles=101)).f, rel=1e-9)
    assert panel.picture.shown[0].axes.ylabel.startswith("wear index")
    panel.back.click()
    assert app.design == start


def test_an_arm_that_passes_its_start_can_be_optimised():
    app = app_of(HighSpeedCam(rise_law=ShapedLaw(c=(-0.6, 0.0, 0.0, 0.0))))
    panel = optimise_panel(app, high_speed_study(free_laws=True, angles=101))
    panel.run()
    panel.wait(PATIENCE)
    assert panel.banner.text == ""
    assert panel.minimum.feasible
    assert not app.analysis.passes_start
    assert panel.summary().split("\n")[1] == f"stress index F_sigma: none → {peak_stress.text(panel.minimum.f)}"


def test_several_starts_are_asked_of_slsqp_alone(app):
    panel = optimise_panel(app, SIZES, methods=("slsqp", "de"))
    states = [panel.starts.disabled]
    for method in ("de", "slsqp"):
        panel.method.value = method
        states.append(panel.starts.disabled)
    assert states == [False, True, False]


def test_the_search_is_drawn_in_the_measures_unit(app):
    panel = optimise_panel(app, SIZES)
    panel.run()
    panel.wait(PATIENCE)
    x, y = xy(panel, "best")
    assert y[0] == pytest.approx(2.478, abs=5e-3)
    assert y[-1] == pytest.approx(panel.minimum.f * mm**0.5, rel=1e-5)
    assert (np.diff(y) <= 0).all()
    assert (np.diff(x) > 0).all()
    assert x[-1] == panel.runner.job.step.evaluated
    dots = len(xy(panel, "keeps all limits")[0]) + len(xy(panel, "misses a limit")[0])
    assert 10 < dots <= len(x)


@pytest.mark.parametrize("method", ["slsqp", "de"])
def test_stop_keeps_the_best_so_far(app, method):
    gate = Gate(peak_stress, 40)
    blocked = Measure("stress", "N^0.5 mm^-0.5", gate)
    panel = optimise_panel(app, SIZES.replace(minimise=(blocked,)), methods=(method,))
    gate.stop(panel)
    step = panel.runner.job.step
    assert panel.minimum is None
    assert panel.summary().endswith(f"The search was stopped after {step.evaluated} designs.")
    assert step.evaluated < (2000 if method == "de" else 200)  # a measure is asked once of each generation
    assert_allclose([getattr(app.design, name) for name in GEOMETRY], step.best.x)
    study = high_speed_study(app.design, angles=101)
    assert study.evaluate([study.x0]).f[0, 0] < 78.3  # that of the first design is 78.36
    panel.back.click()
    assert app.design == FIRST
    panel.run()
    panel.wait(PATIENCE)
    assert panel.minimum.feasible


def test_stopped_without_a_design_that_keeps_the_limits_the_sliders_stay(app):
    gate = Gate(peak_stress, 2)
    blocked = Measure("stress", "", gate)
    panel = optimise_panel(app, high_speed_study(None, blocked, at_most={max_pressure_angle: 20 * deg}, angles=101))
    gate.stop(panel)
    assert app.design == FIRST
    assert panel.summary().endswith("None of them keeps every limit; the design in the sliders stays.")


def test_what_cannot_be_searched_is_said_in_a_sentence(app):
    panel = optimise_panel(app, SIZES.replace(minimise=(peak_stress, peak_wear)))
    panel.run()
    panel.wait(PATIENCE)
    assert "This cannot be searched: the study has 2 objectives; minimise takes one" in panel.banner.text
    assert not panel.runner.run_button.disabled
    move(app, "roller_radius", 45)
    panel.run()
    panel.wait(PATIENCE)
    assert app.design.roller_radius == 45 * mm
    with pytest.raises(ValueError, match="it must be a CamLever"):
        optimise_panel(app, cam_lever_study())


def test_an_error_in_the_thread_is_shown():
    def broken(analysis):
        if threading.current_thread() is not threading.main_thread():
            raise RuntimeError("out of order")
        return analysis.min_radius

    app = app_of(FIRST)
    panel = optimise_panel(app, Study(FIRST, GEOMETRY, (Measure("r", "mm", broken),)))
    panel.run()
    panel.wait(PATIENCE)
    assert "This cannot be searched: the r cannot be computed: RuntimeError: out of order." in panel.banner.text
    assert not panel.runner.run_button.disabled


def test_every_control_of_the_panels_comes_back(app):
    assert try_everything(optimise_panel(app, GOALS, methods=("slsqp", "de"))) == 3
    limit = 2 / mm**0.5
    panel = cycle_time_panel(app, high_speed_study(), limit, 60 * deg, 90 * deg)
    assert try_everything(panel) == 3
    assert panel.limit.value == pytest.approx(limit)
    assert [tab["title"] for tab in app.tabs] == ["Optimise", "Cycle time"]


# --- the cycle time ---------------------------------------------------------------------------------------------------


LIMIT = 9 / cm**0.5
LEVERS = {f"{r} mm": cam_lever_study(max_radius=r * mm, free_laws=False, angles=101) for r in (110, 120)}
LEVER = LEVERS["110 mm"]


def press_app():
    return app_of(CamLever())


def test_the_shortest_interval_and_its_design():
    app = press_app()
    panel = cycle_time_panel(app, LEVERS, LIMIT, 50 * deg, 61 * deg)
    panel.run()
    panel.wait(PATIENCE)
    *_, last = shortest_interval(LEVER, LIMIT, 50 * deg, 61 * deg)
    assert panel.step.high == pytest.approx(last.high, rel=1e-12)
    assert panel.summary() == f"problem: 110 mm\n{last.message}"
    assert last.message in panel.verdict.text
    assert app.design == CamLever()
    panel.take.click()
    assert app.design.rise_angle == app.design.return_angle == pytest.approx(last.high)
    assert app.design.max_radius == pytest.approx(110 * mm)
    study = LEVER.around(app.design)
    assert study.evaluate([study.x0]).f[0, 0] <= LIMIT * (1 + 1e-9)
    assert 0 < panel.runner.progress.value <= panel.runner.progress.max


def test_the_intervals_are_drawn():
    panel = cycle_time_panel(press_app(), LEVERS, LIMIT, 50 * deg, 61 * deg)
    panel.run()
    panel.wait(PATIENCE)
    kept, missed = xy(panel, "keeps the limit"), xy(panel, "does not")
    assert len(kept[0]) + len(missed[0]) == len(panel.steps)
    assert (kept[1] <= 9).all()
    assert (missed[1] > 9).all()
    assert kept[0].min() == pytest.approx(panel.step.high / deg)
    assert missed[0].max() == pytest.approx(panel.step.low / deg)
    assert_allclose(xy(panel, "limit")[1], 9)
    assert panel.picture.shown[0].axes.ylabel.endswith("[N^0.5 cm^-0.5]")


def test_stop_keeps_the_shortest_so_far():
    app = press_app()
    panel = cycle_time_panel(app, LEVERS, LIMIT, 50 * deg, 61 * deg)
    runner, show, states = panel.runner, panel._show, []

    def fourth_step_is_the_last(step):
        show(step)
        if len(panel.steps) == 4:
            states.append((runner.run_button.disabled, runner.stop_button.disabled))
            runner.stop_button.click()

    panel._show = fourth_step_is_the_last
    panel.run()
    panel.wait(PATIENCE)
    states.append((runner.run_button.disabled, runner.stop_button.disabled))
    assert states == [(True, False), (False, True)]
    assert len(panel.steps) == 4
    assert panel.runner.status.text.endswith("(stopped)")
    assert panel.step.best is not None
    assert panel.step.high < 61 * deg
    panel.take.click()
    assert app.design.rise_angle == pytest.approx(panel.step.high)


def test_a_limit_that_not_even_the_longest_interval_keeps():
    app = press_app()
    panel = cycle_time_panel(app, LEVERS, 5 / cm**0.5, 50 * deg, 61 * deg)
    panel.run()
    panel.wait(PATIENCE)
    assert panel.take.disabled
    assert "does not keep the stress index F_sigma of at most 5 N^0.5 cm^-0.5" in panel.verdict.text
    panel.load()
    assert app.design == CamLever()


def test_reversed_intervals_are_refused_in_a_sentence():
    panel = cycle_time_panel(press_app(), LEVERS, LIMIT, 50 * deg, 61 * deg)
    panel.longest.take({"value": 45 * deg})
    panel.run()
    assert "This cannot be searched: the interval is to lie between 50 and 45 deg" in panel.banner.text
    assert not panel.steps
    panel.longest.take({"value": 61 * deg})
    panel.limit.take({"value": 9.3 / cm**0.5})
    panel.run()
    panel.wait(PATIENCE)
    assert panel.banner.text == ""
    assert panel.step.limit == pytest.approx(9.3 / cm**0.5)
