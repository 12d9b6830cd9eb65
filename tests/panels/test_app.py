"""The panels without a page: what a person moves, types, presses and loads, against the package's own numbers."""

import base64
import errno
import gc
import io
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import replace
from functools import partial
from itertools import combinations
from pathlib import Path

import matplotlib.figure
import numpy as np
import pytest
from hand import at, choose, move
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image
from sheets import alert, click, do, downloaded, parts, press, upload
from try_everything import try_everything

from camkit import (
    ArmLoad,
    DoorHandleCam,
    Friction,
    Judgements,
    OscillatingRollerCam,
    ahp,
    ahp_panel,
    door_handle_study,
    explore,
    most_isolated,
    nsga2,
    pareto_panel,
)
from camkit.decision import CHOOSERS
from camkit.files import Session, from_json, to_json
from camkit.machines import lift_curve_study
from camkit.machines.door_handle import (
    CURVE_TABLE,
    DOOR_HANDLE_SPACE,
    EXPANDED_SPACE,
    PAPER_JUDGEMENTS,
    PAPER_SPACE,
    stroke_radius,
)
from camkit.motion import Poly345
from camkit.panels.kit.inputs import Amount, Input, Span, Typed
from camkit.panels.kit.parts import Group, Words
from camkit.panels.kit.runner import time_left
from camkit.panels.kit.running import RUNNING, Place
from camkit.panels.kit.search_files import pending
from camkit.panels.kit.sheet import Sheet, picture_of
from camkit.quantities import quantities_of, value_of
from camkit.search.checkpoint import read
from camkit.search.protocol import Step, search
from camkit.units import in_unit, mm
from camkit.views import pressure_angle
from camkit.views.front import shown_objectives

SLIDERS = ("lift_arm", "lift_start_angle", "relief_arm", "roller_radius", "motion_law", "friction.coefficient")
STUDIES = {"lift curve alone": lift_curve_study(), "whole cam": door_handle_study()}


def close(*panels):
    for panel in panels:
        panel.close()


@pytest.fixture(autouse=True)
def _no_drawing_goes_on():
    yield
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()
            thread.join()


@pytest.fixture(autouse=True, scope="module")
def _searches_are_kept_elsewhere(tmp_path_factory):
    before = os.getcwd()
    os.chdir(tmp_path_factory.mktemp("notebooks"))
    yield
    os.chdir(before)


def an_explorer():
    study = lift_curve_study()
    return explore(DoorHandleCam(), pressure_angle, free=SLIDERS, measures=(*CURVE_TABLE[:5], stroke_radius),
                   at_most=study.at_most, at_least=study.at_least)  # fmt: skip


def a_search(app, population=24, generations=12):
    criteria = ahp_panel(PAPER_JUDGEMENTS)
    importance = ahp_panel(Judgements(["effort", "least radius"], [1]))
    return pareto_panel(app, STUDIES, space=EXPANDED_SPACE, free=list(DOOR_HANDLE_SPACE), criteria=criteria,
                  importance=importance, population=population, generations=generations)  # fmt: skip


def run(finder, **settings):
    for name, value in settings.items():
        getattr(finder, name).value = value
    press(finder, "Optimise")
    finder.wait(60)


@pytest.fixture
def app():
    panel = an_explorer()
    yield panel
    close(panel)


@pytest.fixture(scope="module")
def workshop():
    panel = a_search(an_explorer())
    yield panel
    close(panel, panel.criteria, panel.importance, panel.explorer)


@pytest.fixture(scope="module")
def opened(workshop):
    """The page as it was opened."""
    return workshop.session()


@pytest.fixture
def finder(workshop, opened):
    """A search panel as it is when it has just been opened, but quicker than opening one."""
    yield workshop
    workshop.stop()
    workshop.wait(10)
    for name, bounds in workshop.bounds.items():
        bounds.set(EXPANDED_SPACE[name])
    workshop.load(opened)
    shutil.rmtree(".camkit", ignore_errors=True)
    workshop.resume_button.disabled = True


@pytest.fixture(scope="module")
def found():
    """A search that has been run, for tests that only look and select."""
    panel = a_search(an_explorer(), population=40, generations=30)
    run(panel)
    yield panel
    close(panel, panel.criteria, panel.importance, panel.explorer)


FILE = to_json(DoorHandleCam())


# ---------------------------------------------------------------- judgements


def test_a_moved_judgement_changes_weights_ratio_and_picture():
    panel = ahp_panel(replace(PAPER_JUDGEMENTS, names=["angle", "force", "torque"]), "effort")
    seen = []
    panel.on_change(lambda: seen.append(panel.weights))
    panel.sliders[(0, 2)].value = 1 / 3
    expected = ahp([5, 1 / 3, 1])
    assert_array_equal(panel.weights, expected.weights)
    assert_array_equal(seen[0], expected.weights)
    assert panel.judgements.above == (5, 1 / 3, 1)
    assert_allclose(panel.picture.shown[0]["angle"].x, [0, 100 * expected.weights[0]])
    for text in (f"{expected.weights[0]:.4f}", f"consistency ratio: {expected.consistency_ratio:.4f}"):
        assert text in panel.summary()
    assert f"{expected.weights[1]:.4f}" in panel.numbers.text


def test_judgements_that_contradict_each_other_are_pointed_at():
    panel = ahp_panel(Judgements(["angle", "force", "torque"], [1, 1, 1]))
    assert alert(panel) == ""
    panel.load([5, 1 / 5, 5])
    ratio = ahp([5, 1 / 5, 5]).consistency_ratio
    assert alert(panel).startswith(f"The judgements contradict each other (consistency ratio {ratio:.2f}, above 0.10).")
    assert (
        "Each of angle against force, angle against torque, force against torque may be the one that is off; "
        "take angle against force: 5 was said, the rest implies about 1/25."
    ) in alert(panel)
    press(panel, "Reset")
    assert alert(panel) == ""
    assert panel.judgements.above == (1, 1, 1)


def test_the_judgement_that_hurts_most_is_told_with_what_the_others_imply():
    a = np.array([8.0, 4, 2, 1])  # consistent, so that what is spoiled is known
    upper = [a[i] / a[j] for i, j in combinations(range(4), 2)]
    names = ["angle", "force", "torque", "radius"]
    panel = ahp_panel(Judgements(names, upper))
    assert alert(panel) == ""
    for k, (i, j) in enumerate(combinations(range(4), 2)):
        panel.load([1 / 9 if m == k else v for m, v in enumerate(upper)])
        told = f"Look again at {names[i]} against {names[j]}: 1/9 was said, the others imply about {upper[k]:g}."
        assert told in alert(panel)


def test_a_judgement_off_saatys_scale_has_a_place_on_its_slider():
    panel = ahp_panel(Judgements(["a", "b"], [2.5]))
    assert panel.judgements.above == (2.5,)
    panel.load([1 / 7.5])
    assert panel.judgements.above == pytest.approx((1 / 7.5,))
    assert_allclose(panel.weights, [1 / 8.5, 7.5 / 8.5])


def test_rounded_reciprocals_are_told():
    panel = ahp_panel(Judgements(["a", "b", "c"], [[1, 3, 7], [0.33, 1, 5], [0.14, 0.2, 1]]))
    assert alert(panel) == "Rounded reciprocals are read as exact ones: 0.33 as 1/3, 0.14 as 1/7."
    panel.boxes[0, 1].value = "1/4"
    assert panel.judgements.above == (1 / 4, 7, 5)
    assert "Rounded" not in alert(panel)


def test_judgements_for_another_number_of_criteria_are_refused():
    panel = ahp_panel(Judgements(["a", "b", "c"], [1, 2, 3]))
    with pytest.raises(ValueError, match="3 criteria"):
        panel.load([1, 2, 3, 4, 5, 6])
    assert panel.judgements.above == (1, 2, 3)


# ---------------------------------------------------------------- search


@pytest.mark.parametrize("mode", STUDIES)
def test_a_search_finds_what_the_package_finds(finder, mode):
    finder.mode.value = mode
    run(finder, seed=3)
    space = {name: EXPANDED_SPACE[name] for name in DOOR_HANDLE_SPACE}
    front = nsga2(STUDIES[mode].freeing(space), 24, 12, 3)
    assert_array_equal(finder.front.x, front.x)
    assert_allclose(finder.front.f, front.f, rtol=1e-12)
    assert finder.progress.value == finder.progress.max == 12
    assert finder.status.text.startswith("generation 12 of 12: ")
    assert f"{len(front)} on the front" in finder.status.text
    assert (finder.runner.run_button.disabled, finder.runner.stop_button.disabled) == (False, True)
    assert alert(finder) == front.message


def test_a_search_starts_from_the_design_in_the_sliders(finder):
    app = finder.explorer
    move(app, "roller_radius", 4.0)
    choose(app, "motion_law", Poly345())
    run(finder)
    assert finder.study.start == app.design
    assert finder.front[0].roller_radius == 4 * mm
    effort = finder.study.minimise[0]
    assert effort(DoorHandleCam().analyse(finder.study.angles)) == pytest.approx(1, rel=1e-3)  # the panel's start


def test_what_is_ticked_is_free_between_the_bounds_that_are_typed(finder):
    assert not finder.bounds["lift_centre_distance"].free.value
    finder.bounds["lift_centre_distance"].free.value = True
    finder.bounds["lift_centre_distance"].low.value = 63.5
    finder.bounds["lift_arm"].free.value = False
    run(finder)
    assert list(finder.study.free) == ["lift_start_angle", "lift_centre_distance", "relief_cam_angle"]
    assert finder.study.free["lift_centre_distance"] == pytest.approx((63.5 * mm, 100 * mm))
    assert finder.study.free["lift_start_angle"] == EXPANDED_SPACE["lift_start_angle"]  # exact while nobody edits it
    assert (finder.front.x[:, 1] >= 63.5 * mm).all()


def test_bounds_that_no_design_lies_between_are_told_when_they_are_typed(finder):
    low, high = (getattr(finder.bounds["lift_arm"], end) for end in ("low", "high"))
    do(finder, low, value=70.0)
    assert alert(finder).startswith(
        "This cannot be searched: the bounds of the lift arm are 70 mm and 55 mm; they must"
    )
    do(finder, high, value=80.0)
    assert alert(finder) == ""
    assert finder.bounds["lift_arm"].value == pytest.approx((70 * mm, 80 * mm))


def test_a_search_that_cannot_be_is_refused_in_a_sentence(finder):
    before = finder.front
    finder.bounds["relief_arm"].free.value = True
    run(finder)
    expected = "the relief arm has no effect on what the study judges; it must not be free"
    assert alert(finder) == f"This cannot be searched: {expected}."
    finder.bounds["relief_arm"].free.value = False
    finder.bounds["lift_arm"].low.value = 60.0
    run(finder)
    expected = "the bounds of the lift arm are 60 mm and 55 mm; they must be finite, the first below the second"
    assert alert(finder) == f"This cannot be searched: {expected}."
    for bounds in finder.bounds.values():
        bounds.free.value = False
    run(finder)
    assert alert(finder) == "This cannot be searched: no quantity is free; tick one or more."
    assert finder.front is before
    assert not finder.runner.run_button.disabled


def test_any_one_quantity_can_be_searched_for_the_whole_cam(finder):
    finder.mode.value = "whole cam"
    ended = {}
    for name in EXPANDED_SPACE:
        for key, bounds in finder.bounds.items():
            bounds.free.value = key == name
        run(finder, population=8, generations=1)
        ended[name] = (finder.status.text.startswith("generation 1 of 1: "), alert(finder))
    assert {name for name, (done, said) in ended.items() if not done or "ended early" in said} == set()


def test_an_empty_front_says_why(finder):
    finder.mode.value = "whole cam"
    finder.bounds["relief_cam_angle"].free.value = False
    run(finder, population=8, generations=2)
    assert len(finder.front) == 0
    assert alert(finder) == finder.front.message != ""
    assert finder.winner is None
    assert finder.picker.take.disabled
    assert finder.picker.pick.disabled
    finder.select(0)
    press(finder, "Load the winner")
    assert finder.explorer.design == DoorHandleCam()
    assert finder.summary().startswith("no front yet")


def test_stop_takes_effect_after_the_running_generation_and_keeps_the_front(finder, monkeypatch):
    module, late = sys.modules["camkit.panels.kit.search_job"], []

    def followed(*args, **options):
        for step in search(*args, **options):
            if finder.runner.job.stopping:
                late.append(step.number)
            yield step

    monkeypatch.setattr(module, "search", followed)
    finder.population.value, finder.generations.value = 100, 10000
    press(finder, "Optimise")
    assert (finder.runner.run_button.disabled, finder.runner.stop_button.disabled) == (True, False)
    deadline = time.monotonic() + 30
    while finder.progress.value < 3 and time.monotonic() < deadline:
        time.sleep(0.01)
    shown = finder.progress.value
    press(finder, "Stop")
    finder.wait(10)
    assert late in (
        [],
        [finder.progress.value],
    )  # pressed just before a generation was looked at, or before it was made
    assert len(finder.front) > 0
    assert finder.progress.value >= shown > 0
    assert "(stopped)" in finder.status.text
    assert finder.progress.value < 10000
    assert (finder.runner.run_button.disabled, finder.runner.stop_button.disabled) == (False, True)
    assert finder.winner is not None
    run(finder, population=12, generations=3)  # and another can be run
    assert finder.status.text.startswith("generation 3 of 3: ")


def test_a_panel_that_follows_the_front_is_called_after_it_is_shown(finder):
    seen = []
    finder.on_front(lambda: seen.append((len(finder.front), finder.winner, finder.picker.pick.max + 1)))
    run(finder)
    assert len(seen) >= 1
    assert seen[-1] == (len(finder.front), finder.winner, len(finder.front))
    before = len(seen)
    finder.criteria.sliders[(0, 1)].value = 1 / 9
    assert len(seen) > before


# ---------------------------------------------------------------- a search that was stopped or killed


@pytest.fixture
def stopped(finder, monkeypatch):
    """Runs a search that is stopped after its third generation and gives the names of the files that it left."""
    monkeypatch.setattr(sys.modules["camkit.panels.kit.running"], "REPORT", 0.0)

    def stop_after_three(change):
        if change.new == 3:
            press(finder, "Stop")

    def run_and_stop():
        finder.progress.observe(stop_after_three, "value")
        press(finder, "Optimise")
        finder.wait(30)
        finder.progress.unobserve_all("value")
        assert finder.progress.value == 4
        return sorted(os.listdir(".camkit"))

    return run_and_stop


def test_a_stopped_search_is_resumed_to_the_same_front(finder, stopped):
    """Also from a page that was opened anew: all is put back, and a sentence says what the search needed."""
    typed = explore(DoorHandleCam(lift_start_angle=0.371234567890123), pressure_angle, free=SLIDERS).design
    finder.explorer.load(typed)
    finder.bounds["relief_cam_angle"].free.value = False
    finder.bounds["lift_arm"].set((45.123456789 * mm, 54.987654321 * mm))
    finder.criteria.sliders[(0, 2)].value = 3.0
    finder.population.value, finder.generations.value, finder.seed.value = 40, 60, 4
    finder.criteria.method.value = "geometric"
    study = finder.asked_study()
    files = stopped()
    assert "(stopped)" in finder.status.text
    assert (len(files), files[0]) == (3, ".gitignore")
    assert not finder.resume_button.disabled

    other = fresh()
    assert not other.resume_button.disabled
    press(other, "Resume")
    other.wait(60)
    assert alert(other) == (
        "The search goes on with what it began with: population 40, not 100; generations 60, not 100; seed 4, not 1; "
        "lift arm from 45.1 to 55 mm, not from 45 to 55 mm; "
        "lift start angle from 17.19 to 26.36 deg, not fixed."
    )
    assert other.status.text.startswith("generation 60 of 60: ")
    assert_allclose(other.study.evaluate(other.front.x).f, study.evaluate(other.front.x).f, rtol=1e-14)
    uninterrupted = nsga2(other.study, 40, 60, 4)  # the study as its file says it, in units
    assert_array_equal(other.front.x, uninterrupted.x)
    assert_array_equal(other.front.f, uninterrupted.f)
    assert other.explorer.design == typed
    assert other.criteria.judgements == finder.criteria.judgements
    assert other.criteria.method.value == "geometric"
    finder.criteria.method.value = "eigenvector"
    assert {n: b.value for n, b in other.bounds.items() if b.free.value} == dict(study.free)
    assert os.listdir(".camkit") == [".gitignore"]  # a search that has ended leaves nothing
    assert other.resume_button.disabled
    press(finder, "Resume")
    assert alert(finder) == "This cannot be resumed: there is no search that did not end."


def test_what_was_typed_since_a_search_began_stays_when_it_is_resumed(finder, stopped):
    """The search has its own study and size; design and judgements are the page's, and these weigh the front."""
    finder.explorer.load(DoorHandleCam(lift_arm=47 * mm))
    finder.population.value, finder.generations.value, finder.seed.value = 24, 40, 3
    study = finder.asked_study()
    stopped()
    typed = DoorHandleCam(lift_arm=48.09 * mm, lift_load=ArmLoad(torque=12))
    finder.explorer.load(typed)
    finder.criteria.boxes[(0, 1)].value = "3"
    finder.picker.rule.value = "TOPSIS"
    finder.generations.value, finder.bounds["lift_arm"].low.value = 60, 41.0
    judged = finder.criteria.judgements
    press(finder, "Resume")
    finder.wait(60)
    assert alert(finder) == (
        "The search goes on with what it began with: generations 40, not 60; lift arm from 45 to 55 mm, "
        "not from 41 to 55 mm; its own design, while yours stays in the sliders."
    )
    assert finder.explorer.design == typed
    assert at(finder.explorer, "lift_arm") == 48.09
    assert (finder.criteria.judgements, finder.picker.rule.value) == (judged, "TOPSIS")
    assert finder.criteria.boxes[(0, 1)].value == "3"
    assert_array_equal(finder.found.x, nsga2(finder.found.study, 24, 40, 3).x)
    assert_allclose(finder.found.f, study.evaluate(finder.found.x).f, rtol=1e-14)
    weighed = study.with_weights(judged.weights)
    assert_allclose(finder.front.f, weighed.evaluate(finder.front.x).f, rtol=1e-14)
    run(finder, generations=2)  # a search of its own says nothing of that
    assert alert(finder) == ""


@pytest.mark.parametrize(("damaged", "what"), [(2, "checkpoint"), (1, "file")])
def test_a_search_that_cannot_be_resumed_says_so_and_changes_nothing(finder, stopped, damaged, what):
    finder.criteria.sliders[(0, 2)].value = 3.0
    finder.population.value, finder.generations.value = 40, 1000
    name = stopped()[damaged]
    (Path(".camkit") / name).write_bytes(b"{")
    finder.criteria.load(PAPER_JUDGEMENTS)
    finder.population.value = 24
    before = page_of(finder)
    press(finder, "Resume")
    finder.wait(10)
    assert alert(finder) == f"This cannot be resumed: the {what} {name} is damaged; delete it to begin anew."
    assert page_of(finder) == before
    assert not finder.runner.run_button.disabled


def test_only_a_page_of_the_same_kind_offers_to_resume_a_search(finder, stopped):
    """Notebooks of one folder share the files: other problems, judgements, bounds or another start are another page."""
    stopped()
    weighed = ahp_panel(PAPER_JUDGEMENTS)
    importance = ahp_panel(Judgements(["effort", "least radius"], [1]))
    same = {"space": EXPANDED_SPACE, "free": list(DOOR_HANDLE_SPACE), "criteria": weighed, "importance": importance}
    other_start = explore(DoorHandleCam(friction=Friction(0.2)), pressure_angle, free=SLIDERS)
    pages = {
        "problems": pareto_panel(an_explorer(), {"another": door_handle_study()}, **same),
        "judgements": pareto_panel(an_explorer(), STUDIES, **(same | {"importance": None})),
        "bounds": pareto_panel(an_explorer(), STUDIES, **(same | {"space": PAPER_SPACE})),
        "start": pareto_panel(other_start, STUDIES, **same),
    }
    assert {name for name, page in pages.items() if not page.resume_button.disabled} == set()
    pages["judgements"].resume()
    assert alert(pages["judgements"]) == "This cannot be resumed: there is no search that did not end."
    newer, own = pages["problems"], pareto_panel(an_explorer(), STUDIES, **same)
    press(newer, "Optimise")
    newer.stop()
    newer.wait(10)
    assert not newer.resume_button.disabled
    press(own, "Resume")
    own.wait(30)
    size = "population 24, not 100; generations 12, not 100"
    assert alert(own) == f"The search goes on with what it began with: {size}."
    assert own.status.text.startswith("generation 12 of 12: ")


def underway(finder, generation=1):
    """Runs an endless search until it has come so far."""
    finder.generations.value = 10000
    press(finder, "Optimise")
    until = time.monotonic() + 30
    while finder.progress.value < generation and time.monotonic() < until:
        time.sleep(0.005)


def test_a_search_that_runs_is_nobody_elses(finder, monkeypatch):
    """Neither offered to resume nor written by the same search on another page."""
    monkeypatch.setattr(finder.runner, "place", Place("a cell", "its run"))
    monkeypatch.setattr(sys.modules["camkit.panels.kit.runner"], "here", lambda: Place("another cell", "its run"))
    underway(finder)
    other = a_search(an_explorer(), generations=10000)
    assert other.resume_button.disabled
    assert not other.runner.run_button.disabled
    asked = replace(other.session(), study=other.asked_study(), front=None)
    assert other.page.search(asked).unkept == "the very same search runs already"
    code = "import sys; from camkit.panels.kit.search_files import pending as u; sys.exit(u(sys.argv[1]) is not None)"
    assert subprocess.run([sys.executable, "-c", code, finder.page.kind]).returncode == 0  # another kernel
    finder.stop()
    finder.wait(10)
    assert subprocess.run([sys.executable, "-c", code, finder.page.kind]).returncode == 1


# ---------------------------------------------------------------- a cell that is run again while its search runs


def searching():
    """Threads in which something is searched for."""
    return [job.thread for job in RUNNING if job.thread.is_alive()]


CELLS = {
    "of a notebook": (Place("cell", "first"), Place("cell", "second")),
    "that nobody names": (Place("", ""), Place("", "")),
}


@pytest.mark.parametrize("places", CELLS.values(), ids=CELLS)
def test_a_cell_that_is_run_again_takes_over_the_search_that_runs(finder, monkeypatch, places):
    """One thread, the page as it was at Optimise, progress, Stop, and the front of a search without a break."""
    monkeypatch.setattr(sys.modules["camkit.panels.kit.running"], "REPORT", 0.0)
    monkeypatch.setattr(finder.runner, "place", places[0])
    monkeypatch.setattr(sys.modules["camkit.panels.kit.runner"], "here", lambda: places[1])
    design = DoorHandleCam(lift_start_angle=0.371234567890123)
    finder.explorer.load(design)
    finder.bounds["relief_arm"].free.value = False
    finder.criteria.sliders[(0, 2)].value = 3.0
    finder.population.value, finder.seed.value = 40, 4
    underway(finder, 3)
    reached, study = finder.progress.value, finder.study
    threads = searching()

    other = a_search(an_explorer())
    assert searching() == threads
    assert len(threads) == 1
    assert (other.runner.run_button.disabled, other.runner.stop_button.disabled) == (True, False)
    assert (finder.runner.run_button.disabled, finder.runner.stop_button.disabled) == (False, True)
    assert finder.status.text == "the search goes on in a newer panel"
    assert other.progress.value >= reached
    assert len(other.front) > 0
    assert other.explorer.design == design
    assert other.criteria.judgements == finder.criteria.judgements
    assert (other.population.value, other.seed.value) == (40, 4)
    finder.stop()  # does nothing any more
    shown, until = other.progress.value, time.monotonic() + 30
    while other.progress.value < shown + 3 and time.monotonic() < until:
        time.sleep(0.005)
    assert finder.status.text == "the search goes on in a newer panel"
    press(other, "Stop")
    other.wait(10)
    assert searching() == []
    assert "(stopped)" in other.status.text
    assert (other.runner.run_button.disabled, other.runner.stop_button.disabled) == (False, True)
    assert not other.resume_button.disabled
    assert_array_equal(other.front.x, nsga2(study, 40, other.progress.value, 4).x)
    press(other, "Optimise")  # and another can be run
    other.stop()
    other.wait(10)
    assert searching() == []


def test_a_search_that_ends_in_a_newer_panel_leaves_nothing(finder, monkeypatch):
    finder.explorer.load(DoorHandleCam(lift_start_angle=0.38))
    finder.generations.value = 150
    press(finder, "Optimise")
    others = [a_search(an_explorer()) for _ in range(2)]
    others[-1].wait(60)
    assert searching() == []
    assert others[-1].status.text.startswith("generation 150 of 150: ")
    assert os.listdir(".camkit") == [".gitignore"]
    assert [other.resume_button.disabled for other in (finder, *others)] == [True] * 3
    assert not any(other.runner.run_button.disabled for other in (finder, *others))


OTHERS = {
    "another page": lambda: pareto_panel(an_explorer(), {"another": door_handle_study()}, space=PAPER_SPACE,
                                   free=list(PAPER_SPACE)),
    "another study of the same name": lambda: pareto_panel(
        an_explorer(), STUDIES | {"lift curve alone": door_handle_study()}, space=EXPANDED_SPACE,
        free=list(PAPER_SPACE), criteria=ahp_panel(PAPER_JUDGEMENTS),
        importance=ahp_panel(Judgements(["effort", "least radius"], [1]))),
}  # fmt: skip


@pytest.mark.parametrize("make", OTHERS.values(), ids=OTHERS)
def test_a_cell_that_was_changed_and_is_run_again_ends_the_search_that_runs(finder, monkeypatch, make):
    monkeypatch.setattr(finder.runner, "place", Place("cell", "first"))
    monkeypatch.setattr(sys.modules["camkit.panels.kit.runner"], "here", lambda: Place("cell", "second"))
    underway(finder)
    other = make()
    finder.wait(10)
    assert searching() == []
    assert "(stopped)" in finder.status.text
    assert not other.runner.run_button.disabled


def test_what_is_free_may_be_said_by_names_or_by_their_box():
    by_names, by_box = (
        pareto_panel(an_explorer(), STUDIES, space=EXPANDED_SPACE, free=free)
        for free in (list(DOOR_HANDLE_SPACE), DOOR_HANDLE_SPACE)
    )
    assert list(by_box.study.free) == list(by_names.study.free) == list(DOOR_HANDLE_SPACE)


def test_two_searches_of_one_run_of_a_cell_run_beside_each_other(finder, monkeypatch):
    monkeypatch.setattr(finder.runner, "place", Place("cell", "first"))
    monkeypatch.setattr(sys.modules["camkit.panels.kit.runner"], "here", lambda: Place("cell", "first"))
    underway(finder)
    other = pareto_panel(an_explorer(), {"another": door_handle_study()}, space=PAPER_SPACE, free=list(PAPER_SPACE))
    underway(other)
    assert len(searching()) == 2
    for panel in (finder, other):
        panel.stop()
        panel.wait(10)
    assert searching() == []


UNKEPT = "This search is not kept in a file to resume it from: {}."


def test_a_folder_that_cannot_be_written_does_not_stop_a_search(finder, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError("read only")

    monkeypatch.setattr(Path, "mkdir", refuse)
    run(finder)
    assert finder.status.text.startswith("generation 12 of 12: ")
    assert alert(finder) == UNKEPT.format("read only")
    assert finder.resume_button.disabled
    monkeypatch.undo()
    run(finder)
    assert alert(finder) == ""


def leads_elsewhere(folder, elsewhere):
    elsewhere.mkdir()
    folder.symlink_to(elsewhere)


def leads_nowhere(folder, elsewhere):
    folder.symlink_to(elsewhere)


def is_a_file(folder, elsewhere):
    folder.write_text("mine")


def is_somebody_elses(folder, elsewhere):
    folder.mkdir()
    os.chown(folder, 65534, -1)


FOLDERS = {
    leads_elsewhere: ".camkit is a link, which is not followed",
    leads_nowhere: ".camkit is a link, which is not followed",
    is_a_file: ".camkit is not a folder",
    is_somebody_elses: "the folder .camkit belongs to somebody else",
}


@pytest.mark.parametrize("make", FOLDERS, ids=lambda make: make.__name__)
def test_a_folder_that_is_not_the_searches_own_is_left_alone(finder, tmp_path, make):
    if make is is_somebody_elses and os.geteuid() != 0:
        pytest.skip("only root can give a folder away")
    folder, elsewhere = Path(".camkit"), tmp_path / "elsewhere"
    make(folder, elsewhere)
    try:
        run(finder)
        assert finder.status.text.startswith("generation 12 of 12: ")
        assert alert(finder) == UNKEPT.format(FOLDERS[make])
        assert finder.resume_button.disabled
        assert os.listdir(elsewhere if elsewhere.exists() else tmp_path) == []
        assert make is not is_a_file or folder.read_text(encoding="utf-8") == "mine"
        assert make is not is_somebody_elses or os.listdir(folder) == []
    finally:
        shutil.rmtree(folder) if folder.is_dir() and not folder.is_symlink() else folder.unlink()


def test_a_search_behind_a_link_is_not_resumed(finder, stopped, tmp_path):
    finder.generations.value = 1000
    stopped()
    Path(".camkit").rename(tmp_path / "elsewhere")
    Path(".camkit").symlink_to(tmp_path / "elsewhere")
    try:
        assert fresh().resume_button.disabled
    finally:
        Path(".camkit").unlink()


def test_a_file_of_somebody_else_is_not_overwritten(finder, stopped, tmp_path):
    """Neither a .gitignore that was there before nor a file to which a page's name leads."""
    folder, mine = Path(".camkit"), tmp_path / "mine"
    folder.mkdir()
    (folder / ".gitignore").write_text("mine")
    mine.write_text("mine")
    finder.generations.value = 1000
    name = next(name for name in stopped() if name.endswith(".json"))
    (folder / name).unlink()
    (folder / name).symlink_to(mine)
    assert fresh().resume_button.disabled
    stopped()
    assert alert(finder) == UNKEPT.format("too many levels of symbolic links")
    assert (folder / ".gitignore").read_text() == mine.read_text() == "mine"


def test_a_disk_that_fills_up_ends_no_search(finder, stopped, monkeypatch):
    """The generation before stays whole, and nothing half written beside it; the search can be resumed from there."""
    write, full = Path.write_bytes, OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def fills_up(path, content):
        if finder.progress.value >= 1:
            write(path, content[:100])
            raise full
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", fills_up)
    finder.generations.value = 1000
    files = stopped()
    assert alert(finder) == UNKEPT.format("no space left on device")
    assert [Path(name).suffix for name in files] == ["", ".json", ".search"]
    monkeypatch.undo()
    assert read(Path(".camkit") / files[-1]).number == 1
    assert not finder.resume_button.disabled


def test_a_disk_that_is_full_from_the_start_ends_no_search(finder, monkeypatch):
    def full(kept, text):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(sys.modules["camkit.panels.kit.search_files"].Kept, "begin", full)
    run(finder)
    assert finder.status.text.startswith("generation 12 of 12: ")
    assert alert(finder) == UNKEPT.format("no space left on device")
    assert os.listdir(".camkit") == [".gitignore"]


def test_a_folder_that_vanishes_ends_no_search(finder, monkeypatch):
    monkeypatch.setattr(sys.modules["camkit.panels.kit.running"], "REPORT", 0.0)
    finder.generations.value = 60
    finder.progress.observe(lambda change: change.new == 3 and shutil.rmtree(".camkit"), "value")
    run(finder)
    finder.progress.unobserve_all("value")
    assert finder.status.text.startswith("generation 60 of 60: ")
    assert alert(finder) == UNKEPT.format("no such file or directory")
    assert not Path(".camkit").exists()


def test_what_a_killed_kernel_left_half_written_is_removed(finder, stopped):
    """When the next page opens; not what somebody still writes."""
    finder.generations.value = 1000
    name = next(name for name in stopped() if name.endswith(".search"))
    for part in (f".{name}.1.part", ".gone.search.1.part"):
        (Path(".camkit") / part).write_bytes(b"half")
    held = pending(finder.page.kind)
    assert sorted(os.listdir(".camkit"))[:2] == [".gitignore", name.replace("search", "json")]
    (Path(".camkit") / f".{name}.1.part").write_bytes(b"half")
    fresh()
    assert f".{name}.1.part" in os.listdir(".camkit")
    held.release()
    fresh()
    assert f".{name}.1.part" not in os.listdir(".camkit")


PAGES = {
    "no text": lambda page: b"\xff\xfe",
    "no JSON": lambda page: b"{",
    "a list": lambda page: b"[]",
    "a number": lambda page: b"1",
    "nested": lambda page: b"[" * 100_000,
    "a page of ten million letters": lambda page: b" " * 10_000_000,
    "a huge number": lambda page: page.replace(b'"seed": 1', b'"seed": ' + b"9" * 5000),
    "a design alone": lambda page: to_json(DoorHandleCam()).encode(),
    "space that is a number": lambda page: edited(page, "free", to=1),
    "bounds that are a number": lambda page: edited(page, "free", to={"lift_arm [mm]": 1}),
    "no judgements": lambda page: edited(page, "judgements", to={}),
    "no judgement of the objectives": lambda page: edited(page, "judgements", "importance"),
    "judgements that are a number": lambda page: edited(page, "judgements", to=1),
    "a method that is not there": lambda page: edited(page, "judgements", "criteria", "method", to="x"),
    "a method that is nested": lambda page: edited(page, "judgements", "criteria", "method", to=[[]]),
    "a design that is a number": lambda page: edited(page, "design", to=1),
    "numbers that are text": lambda page: edited(page, "design", "lift_arm [mm]", to="<b>"),
    "numbers that are too large": lambda page: edited(page, "design", "lift_arm [mm]", to=1e300),
    "settings that are a number": lambda page: edited(page, "search", to=1),
    "no settings": lambda page: edited(page, "search", to={}),
    "a menu that is not there": lambda page: edited(page, "search", "mode", to="x"),
    "a huge population": lambda page: edited(page, "search", "population", to=10**400),
}  # fmt: skip


def edited(page, *path, to=None):
    """A page with one entry changed, or left out."""
    content = json.loads(page)
    inner = content["session"]
    for step in path[:-1]:
        inner = inner[step]
    if to is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = to
    return json.dumps(content).encode()


def page_of(finder):
    """What is set on a page."""
    session = finder.session()
    bounds = {name: (row.value, row.free.value) for name, row in finder.bounds.items()}
    return session.design, session.judgements, session.search, bounds


@pytest.fixture(scope="module")
def a_stopped_search(workshop, opened):
    """Its page, and its checkpoint."""
    workshop.generations.value = 10000
    press(workshop, "Optimise")
    workshop.stop()
    workshop.wait(30)
    return {path.name: path.read_bytes() for path in Path(".camkit").glob("*-*")}


@pytest.mark.parametrize("change", PAGES.values(), ids=PAGES)
def test_a_page_that_somebody_made_is_refused_and_the_lock_let_go(a_stopped_search, finder, change):
    Path(".camkit").mkdir(exist_ok=True)
    for name, content in a_stopped_search.items():
        (Path(".camkit") / name).write_bytes(change(content) if name.endswith("json") else content)
    before = page_of(finder)
    finder.resume()
    finder.wait(10)
    assert alert(finder).startswith("This cannot be resumed: ")
    assert len(alert(finder)) < 600
    assert page_of(finder) == before
    for _ in range(2):  # nobody holds it, and a search that follows begins anew
        held = pending(finder.page.kind)
        held.release()
    run(finder, generations=2)
    assert finder.status.text.startswith("generation 2 of 2: ")
    assert alert(finder) == ""


def test_the_page_the_download_and_the_file_to_resume_from_are_one_session(finder, stopped):
    finder.generations.value = 1000
    finder.criteria.sliders[(0, 2)].value = 3.0
    page = next(name for name in stopped() if name.endswith(".json"))
    saved = downloaded(finder, "Save study")["text"]
    assert saved == to_json(finder.session())
    began = replace(from_json(saved, Session), front=None)  # as it was at Optimise
    assert (Path(".camkit") / page).read_text() == to_json(began)


def test_a_step_tells_the_time_that_is_left():
    study = door_handle_study()
    at = partial(Step, study=study, found=study.evaluate(study.x0), record={"seconds": 5.0})
    assert time_left(at(10, 30)) == "10 s left"
    assert time_left(at(10, 1010)) == "8 min left"
    assert time_left(at(10, 0)) == time_left(at(0, 0)) == ""  # nobody knows how long it will be


def test_a_running_search_tells_the_time_that_is_left(finder):
    said, left = [], []
    finder.status.observe(lambda _: said.append(finder.status.text), "value")
    finder.runner.left.observe(lambda _: left.append(finder.runner.left.text), "value")
    finder.population.value, finder.generations.value = 100, 10000
    press(finder, "Optimise")
    until = time.monotonic() + 30
    while not said and time.monotonic() < until:
        time.sleep(0.01)
    finder.stop()
    finder.wait(10)
    for words in (finder.status, finder.runner.left):
        words.unobserve_all()
    assert re.fullmatch(r"generation \d+ of 10000: .* on the front", said[0])
    assert re.fullmatch(r"\d+ (s|min) left", left[0])
    assert said[-2:-1] == ["stopping"]
    assert re.fullmatch(r"generation \d+ of 10000 \(stopped\): .* on the front", said[-1])
    assert re.fullmatch(r"hypervolume [\d.e-]+", finder.details.text)
    assert left[-1] == ""


def test_what_a_search_shows_from_its_thread_reaches_the_page_at_once_and_whole(finder):
    """Progress, words and picture of each step in one message."""
    told = []

    def listen(change):
        value = {part["id"]: part.get("value") for part in inside_of(change.new)}
        (shown,) = getattr(finder, picture_of(finder.picture))
        points = len(shown["arrays"][shown["picture"]["marks"][0]["x"]["at"]]) // 8
        told.append((threading.current_thread(), value[finder.progress.number], value[finder.status.number], points))

    finder.observe(listen, "body")
    underway(finder, 3)
    finder.stop()
    finder.wait(10)
    finder.unobserve(listen, "body")
    steps = [step for thread, *step in told if thread is not threading.main_thread()]
    assert len(steps) > 1
    for number, (status,), points in steps:
        assert status == "stopping" or re.match(rf"generation {number} of 10000.* {points} on the front", status)


def inside_of(state):
    """What the page is told of each part."""
    yield state
    for child in state.get("children", ()):
        yield from inside_of(child)


def test_the_page_says_how_its_front_was_found_and_saves_it(finder):
    run(finder, population=40, generations=30, seed=9)
    record = finder.front.record
    assert (record["population"], record["generations"], record["seed"]) == (40, 30, 9)
    assert finder.record.text == f"found in {record['seconds']:.3g} s: 30 generations, seed 9"
    saved = downloaded(finder, "Save study")["text"]
    assert json.loads(saved)["session"]["record"]["versions"]["python"] == sys.version.split()[0]
    other = fresh()
    upload(other, "Load study", saved)
    assert other.record.text == finder.record.text
    older = json.loads(saved)
    del older["session"]["record"]
    upload(other, "Load study", json.dumps(older))
    assert alert(other).startswith("The file is loaded, but its content does not match its digest")
    assert other.record.text == ""
    assert len(other.front) == len(finder.front)


def test_a_second_press_does_not_start_a_second_search(finder):
    finder.generations.value = 10000
    press(finder, "Optimise")
    thread = finder.runner.job.thread
    finder.run()
    assert finder.runner.job.thread is thread
    finder.stop()
    finder.wait(10)
    assert not thread.is_alive()


def test_a_search_that_breaks_says_so(finder, monkeypatch):
    def breaks(study):
        raise RuntimeError("broken")

    monkeypatch.setattr(sys.modules["camkit.panels.kit.search_job"], "reference_point", breaks)
    run(finder)
    assert alert(finder) == "The search ended early: RuntimeError: broken."
    assert not finder.runner.run_button.disabled


def test_a_judgement_weighs_the_front_anew_and_the_winner_with_it(finder):
    run(finder, population=40, generations=30)
    finder.picker.rule.value = "weighted sum"
    x, f, (before,) = finder.front.x, finder.front.f, finder.picture.shown
    finder.criteria.sliders[(0, 1)].value = 1 / 9
    finder.criteria.sliders[(0, 2)].value = 1 / 9
    assert_allclose(finder.study.minimise[0].weights, finder.criteria.weights)
    assert {tuple(row) for row in finder.front.x} <= {tuple(row) for row in x}
    assert_array_equal(finder.front.f, finder.study.evaluate(finder.front.x).f)
    assert not np.array_equal(finder.front.f[:, 0].min(), f[:, 0].min())
    assert_allclose([finder.picture.shown[0]["front"].x, finder.picture.shown[0]["front"].y],
                    shown_objectives(finder.front))  # fmt: skip
    assert not np.array_equal(finder.picture.shown[0]["front"].x, before["front"].x)
    winners = set()
    for value in (1 / 9, 1.0, 9.0):
        finder.importance.sliders[(0, 1)].value = value
        assert finder.winner == CHOOSERS["weighted sum"](finder.front, finder.importance.weights)
        winners.add(finder.winner)
    assert len(winners) > 1
    assert f"winner: design {finder.winner}" in finder.verdict.text


def test_a_judgement_that_is_taken_back_brings_the_whole_front_back(finder):
    run(finder, population=40, generations=30)
    x, f = finder.front.x, finder.front.f
    finder.criteria.load([1 / 9, 1, 9])
    finder.criteria.load(PAPER_JUDGEMENTS)
    assert_array_equal(finder.front.x, x)
    assert_allclose(finder.front.f, f, rtol=1e-9)


def test_a_judgement_changed_during_a_search_counts_when_it_ends(finder):
    finder.generations.value = 10000
    press(finder, "Optimise")
    deadline = time.monotonic() + 30
    while finder.progress.value < 2 and time.monotonic() < deadline:
        time.sleep(0.01)
    finder.criteria.load([1 / 9, 1 / 9, 1])
    time.sleep(0.6)
    press(finder, "Stop")
    finder.wait(10)
    assert_allclose(finder.front.study.minimise[0].weights, finder.criteria.weights)
    assert_array_equal(finder.front.f, finder.study.evaluate(finder.front.x).f)


def test_every_rule_chooses_its_winner(found):
    for name, chosen_by in CHOOSERS.items():
        found.picker.rule.value = name
        assert found.winner == chosen_by(found.front, found.importance.weights)
    found.picker.rule.value = "crowding distance"
    press(found, "Load the winner")
    index = most_isolated(found.front)
    assert found.explorer.design == found.front[index]
    assert found.picker.pick.value == index


def test_a_selected_design_goes_into_the_sliders(found):
    app, last = found.explorer, len(found.front) - 1
    found.picker.pick.value = last
    assert app.design == found.front[last]
    assert found.picker.selected == last
    found.select(2)
    assert app.design == found.front[2]
    assert found.picker.pick.value == 2
    assert at(app, "lift_arm") == pytest.approx(found.front.x[2, 0] / mm, rel=1e-14)


def test_a_click_loads_the_nearest_point_of_the_front(found):
    points = shown_objectives(found.front)
    for index in (0, len(found.front) // 2, len(found.front) - 1):
        click(found, *points[:, index])
        loaded = found.picker.selected
        assert found.explorer.design == found.front[loaded]
        assert_allclose(points[:, loaded], points[:, index], rtol=1e-12)  # itself, or one in the same place


def test_the_mark_on_the_front_leaves_a_design_that_is_moved_away(found):
    found.select(3)
    mark = found.picture.shown[0]["in the sliders"]
    assert_allclose(np.ravel([mark.x, mark.y]), shown_objectives(found.front)[:, 3])
    move(found.explorer, "lift_arm", 61.0)
    assert np.size(found.picture.shown[0]["in the sliders"].x) == 0


def test_a_click_before_there_is_a_front_does_nothing(finder):
    app = finder.explorer
    click(finder, 0.5, 0.5)
    assert app.design == DoorHandleCam()


def test_a_smaller_front_does_not_move_the_sliders(finder):
    """A new search, or new judgements, leave the design in hand alone."""
    app = finder.explorer
    run(finder, population=40, generations=30)
    finder.picker.pick.value = len(finder.front) - 1
    mine = app.design
    run(finder, population=4, generations=1)
    assert len(finder.front) < 30
    assert app.design is mine


# ---------------------------------------------------------------- whole studies


def fresh():
    app = explore(DoorHandleCam(), pressure_angle, free=SLIDERS)
    criteria = ahp_panel(Judgements(["pressure angle", "contact force", "cam torque"], [1, 1, 1]))
    importance = ahp_panel(Judgements(["effort", "least radius"], [1]))
    return pareto_panel(app, STUDIES, space=EXPANDED_SPACE, free=["lift_arm"], criteria=criteria, importance=importance)


@pytest.mark.parametrize("mode", STUDIES)
def test_a_study_goes_to_a_file_and_back(finder, mode):
    """Into panels that have just been opened: the same front, winner, judgements, bounds, settings and design."""
    finder.mode.value = mode
    finder.bounds["relief_cam_angle"].free.value = True
    finder.bounds["relief_cam_angle"].low.value = 42.0
    finder.importance.sliders[(0, 1)].value = 3.0
    finder.picker.rule.value = "TOPSIS"
    run(finder, population=40, generations=30, seed=9)
    assert len(finder.front) > 5
    finder.select(finder.winner)
    saved = downloaded(finder, "Save study")
    assert (saved["name"], saved["mime"]) == ("study.json", "application/json")

    other = fresh()
    upload(other, "Load study", saved["text"])
    assert alert(other) == ""
    assert_allclose(other.front.x, finder.front.x, rtol=1e-14)
    assert_allclose(other.front.f, finder.front.f, rtol=1e-9)
    assert other.winner == finder.winner
    assert other.criteria.judgements == finder.criteria.judgements
    assert other.importance.judgements == finder.importance.judgements
    assert [b.free.value for b in other.bounds.values()] == [b.free.value for b in finder.bounds.values()]
    assert other.bounds["relief_cam_angle"].value == pytest.approx(finder.bounds["relief_cam_angle"].value)
    assert [getattr(other, k).value for k in ("population", "generations", "seed")] == [40, 30, 9]
    assert_allclose(other.explorer.design.lift_arm, finder.explorer.design.lift_arm, rtol=1e-14)
    assert other.mode.value == mode  # or Optimise would go on with another problem
    assert other.picker.rule.value == "TOPSIS"
    for path, quantity in quantities_of(other.explorer.design).items():
        assert at(other.explorer, path) == in_unit(value_of(other.explorer.design, path), quantity.unit)
    assert_allclose(other.front.study.bounds, finder.study.bounds, rtol=1e-14)


def test_a_study_without_a_front_replaces_the_front_that_was_there(finder):
    saved = downloaded(finder, "Save study")["text"]
    run(finder)
    upload(finder, "Load study", saved)
    assert len(finder.front) == 0
    assert finder.winner is None
    assert finder.picker.pick.disabled
    assert finder.front.study is finder.study or finder.front.study == finder.study


OTHER = json.loads(to_json(OscillatingRollerCam()))["design"]
BROKEN_STUDIES = {
    "six judgements for three": {"judgements": {"criteria": [1, 2, 3, 4, 5, 6]}},
    "a negative judgement": {"judgements": {"criteria": [1, -2, 3]}},
    "judgements of text": {"judgements": {"criteria": "abc"}},
    "a population of text": {"search": {"population": "many"}},
    "an unknown setting": {"search": {"explorer": 5}},
    "an unknown problem": {"search": {"mode": "half a cam"}},
    "an unknown rule": {"search": {"rule": "dice"}},
    "a front of two columns": {"front": [[1, 2]]},
    "another mechanism": {
        "start": OTHER, "design": OTHER, "free": {"arm_length [mm]": [50, 70]}, "minimise": ["peak contact force [N]"],
        "at_most": {}, "at_least": {}, "front": [],
    },
}  # fmt: skip


@pytest.mark.parametrize("change", [None, "cut short", *BROKEN_STUDIES])
def test_a_study_that_cannot_be_used_is_refused_and_changes_nothing(found, change):
    found.select(1)
    content = json.loads(downloaded(found, "Save study")["text"])
    content["session"].update(BROKEN_STUDIES.get(change, {}))
    text = json.dumps(content)[: 500 if change == "cut short" else None]

    def state():
        return (found.explorer.design, found.front, found.study, found.criteria.judgements,
                found.bounds["lift_arm"].value, found.population.value, found.winner, found.status.text)  # fmt: skip

    before = state()
    upload(found, "Load study", FILE if change is None else text)
    after, said = state(), alert(found)
    for bounds in found.bounds.values():  # for the tests that follow, should it have been used after all
        bounds.set(EXPANDED_SPACE[bounds.name] if bounds.name in DOOR_HANDLE_SPACE else None)
    found.criteria.load(PAPER_JUDGEMENTS)
    found.population.value = 40
    found.explorer.load(before[0])

    assert said.startswith("This file cannot be used: ")
    assert not any(word in said for word in ("reshape", "object", "attribute", "literal", "trait"))
    assert all(a is b or a == b for a, b in zip(after[3:], before[3:], strict=True))
    assert all(a is b for a, b in zip(after[:3], before[:3], strict=True))


# ---------------------------------------------------------------- the page without a kernel, and nothing left behind


def test_every_panel_reads_without_a_kernel(found):
    for panel in (found.explorer, found.criteria, found.importance, found):
        bundle = panel._repr_mimebundle_()
        bundle = bundle[0] if isinstance(bundle, tuple) else bundle
        still = Image.open(io.BytesIO(base64.b64decode(bundle["image/png"])))
        assert still.format == "PNG"
        assert still.size[0] > 300
        assert bundle["text/plain"] == panel.summary() != ""
        assert "application/vnd.jupyter.widget-view+json" in bundle
        assert len(bundle["image/png"]) < 200_000


def test_the_summaries_are_the_numbers(found):
    app = found.explorer
    for measure in app.measures:
        assert f"{measure.name}: {measure.text(measure(app.design.analyse()))}" in app.summary()
    f = found.front.f[found.winner]
    for measure, value in zip(found.study.minimise, f, strict=True):
        assert f"{measure.name}: {measure.text(measure.sign * value)}" in found.summary()


def figures():
    gc.collect()
    return sum(isinstance(thing, matplotlib.figure.Figure) for thing in gc.get_objects())


# ---------------------------------------------------------------- try_everything


def test_everything_can_be_tried(finder):
    app = finder.explorer
    run(finder)
    design = app.design
    assert try_everything(finder) == len(parts(finder, Input)) == 10 + 3 * len(EXPANDED_SPACE)
    assert try_everything(finder.criteria) > try_everything(finder.importance) > 0
    assert try_everything(app) == len(SLIDERS)
    assert app.design.replace(**{k: getattr(design, k) for k in DOOR_HANDLE_SPACE}) == design


def test_try_everything_bites_when_a_callback_raises():
    finder = a_search(an_explorer())
    app = finder.explorer

    def broken(*_):
        raise RuntimeError("a broken callback")

    assert try_everything(app)
    app.on_change(broken)
    with pytest.raises(AssertionError, match="a broken callback"):
        try_everything(app)
    finder.importance.on_change(broken)
    with pytest.raises((RuntimeError, AssertionError), match="a broken callback"):
        try_everything(finder.importance)
    finder.seed.observe(broken, "value")
    with pytest.raises((RuntimeError, AssertionError), match="a broken callback"):
        try_everything(finder)
    close(finder, finder.criteria, finder.importance, app)


def test_try_everything_moves_bands_and_boxes_of_text_too():
    band, words = Span(value=(2.0, 8.0), min=0.0, max=10.0), Typed(value="1/7")
    seen = []
    for control in (band, words):
        control.observe(lambda change: seen.append(change.new), "value")
    assert try_everything(Sheet(Group(band))) == 1
    assert try_everything(Sheet(Group(Group(words), Words()))) == 1
    assert seen == [(5, 8), (2, 5), (2, 8), "", "1/7"]
    assert try_everything(Sheet()) == 0


def test_try_everything_bites_when_a_control_does_not_come_back():
    sticky = Amount(value=1.0, description="sticky")
    sticky.observe(lambda change: setattr(sticky, "value", 7.0), "value")
    with pytest.raises(AssertionError, match="sticky did not come back"):
        try_everything(Sheet(sticky))
