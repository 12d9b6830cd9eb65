"""The quick front against fronts that are known, against brute force and NSGA-II; its panel against the package."""

import threading
import time
from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose, assert_array_equal
from sheets import click
from try_everything import try_everything

from camkit import (
    DoorHandleCam,
    Judgements,
    Measure,
    Study,
    ahp_panel,
    door_handle_study,
    explore,
    nsga2,
)
from camkit.data import load
from camkit.decision.choosers import normalised
from camkit.machines import lift_curve_study
from camkit.machines.door_handle import DOOR_HANDLE_SPACE, EXPANDED_SPACE, LIFT_SPACE, PAPER_JUDGEMENTS, stroke_radius
from camkit.machines.valve_measures import valve_front_study
from camkit.panels.kit.latest_only import Debounced, LatestOnly
from camkit.panels.live_pareto import live_pareto_panel
from camkit.quantities import Design, quantity
from camkit.render.artists import artist_of
from camkit.render.still import draw, layout
from camkit.search.checkpoint import versions
from camkit.search.fast_front import (
    Archive,
    _each_once,
    _everywhere,
    _thinned,
    _unbeaten,
    fast_front_steps,
    quick_front,
    spread,
)
from camkit.search.front import Front, reference_point
from camkit.search.nsga2 import nsga2_steps
from camkit.units import mm
from camkit.views import curvature
from camkit.views.front import LiveFront, live_pareto, searches_compared, shown_objectives

FOUR = {n: EXPANDED_SPACE[n] for n in ("lift_arm", "lift_start_angle", "lift_centre_distance", "relief_cam_angle")}


@dataclass(frozen=True)
class Point(Design):
    """A point in four dimensions; it cannot be built where ``a`` is above 3."""

    a: float = quantity("a", 1, -4, 4, "", "first", above=None)
    b: float = quantity("b", 1, -4, 4, "", "second", above=None)
    c: float = quantity("c", 1, -4, 4, "", "third", above=None)
    d: float = quantity("d", 1, -4, 4, "", "fourth", above=None)

    def analyse(self, n=1):
        coordinates = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (self.a, self.b, self.c, self.d)))
        return Seen(np.where(np.asarray(self.a) <= 3, np.stack(coordinates), np.nan), n)


@dataclass(frozen=True)
class Seen:
    x: np.ndarray
    angles: int


def measure(name, function):
    """A measure of the four coordinates; one number of each member."""
    return Measure(name, "", lambda seen: np.squeeze(function(seen.x), -1) if seen.x.ndim > 1 else function(seen.x))


near_0 = measure("distance from 0", lambda x: (x**2).sum(0))
near_1 = measure("distance from 1", lambda x: ((x - 1) ** 2).sum(0))
far = measure("largest distance from 2", lambda x: abs(x - 2).max(0))
first = measure("first", lambda x: x[0])
SPACE = {name: (-4.0, 4.0) for name in "abcd"}


def points(*minimise, space="abcd", **limits):
    return Study(Point(0, 0, 0, 0), {n: SPACE[n] for n in space}, minimise or (near_0, near_1), **limits)


# ---------------------------------------------------------------- fronts that are known


def off(front, curve):
    """How far each member is from a curve ``(2, k)`` that is drawn finely, in objectives."""
    return np.hypot(*(front.f.T[:, :, None] - curve[:, None])).min(1)


T = np.linspace(0, 1, 4001)


@pytest.mark.parametrize("space", ["ab", "abc", "abcd"])
def test_the_front_between_two_points(space):
    """Nearest to 0 and nearest to (1, 1, ..): the straight line between them."""
    front = quick_front(points(space=space))
    n = len(space)  # the coordinates that are not free stay at 0, 1 away
    assert len(front) == 100
    assert off(front, np.array([n * T**2, n * (1 - T) ** 2 + 4 - n])).max() < 0.01 * n
    t = np.linspace(0, 1, 100)
    as_many = Front(front.study, front.x, np.stack([n * t**2, n * (1 - t) ** 2 + 4 - n], axis=1))
    assert front.hypervolume((n, 4)) > 0.998 * as_many.hypervolume((n, 4))
    assert front.hypervolume((n, 4)) < n * n * 5 / 6  # of all of it: 1/6 is the integral of (1 - sqrt(t))^2


def corner(x):
    """The front between the two points where the first coordinate is at least ``x`` and the second is free."""
    along = np.array([x**2 + T**2, (1 - x) ** 2 + (1 - T) ** 2 + 2])[:, x >= T]
    beyond = np.array([2 * T**2, 2 * (1 - T) ** 2 + 2])[:, x <= T]
    return np.hstack([along, beyond])


def test_a_limit_cuts_the_front():
    """With the first coordinate at least 1/2 the front begins at (1/2, 0)."""
    front = quick_front(points(space="ab", at_least={first: 0.5}))
    assert (front.x[:, 0] >= 0.5).all()
    assert_allclose(front.f[[0, -1]], [(0.25, 3.25), (2, 2)], atol=0.01)
    assert off(front, corner(0.5)).max() < 0.01


def test_a_front_of_three_objectives_lies_on_its_sphere():
    """As far as possible along three axes within a radius of 1: the front is an eighth of the sphere, evenly filled."""
    on = [measure(f"minus {k}", lambda x, k=k: -x[k]) for k in range(3)]
    radius = measure("radius", lambda x: np.sqrt((x[:3] ** 2).sum(0)))
    study = Study(Point(0, 0, 0, 0), {n: (0.0, 2.0) for n in "abc"}, tuple(on), {radius: 1.0})
    front = quick_front(study)
    assert len(front) == 100
    assert np.median(np.linalg.norm(front.f, axis=1)) > 0.98
    directions = np.random.default_rng(1).dirichlet((1, 1, 1), 300) ** 0.5
    towards = front.f / -np.linalg.norm(front.f, axis=1, keepdims=True)
    assert np.arccos((directions @ towards.T).max(1)).max() < 0.25  # no hole wider than this, rad
    assert front.hypervolume((0, 0, 0)) > nsga2(study, 100, 70, 1).hypervolume((0, 0, 0))  # as many designs looked at


def test_brute_force_finds_nothing_better():
    """A grid of 40 000 designs of the valve cam against 100 of the quick front."""
    study = valve_front_study()
    front = quick_front(study)
    grid = np.stack(np.meshgrid(*np.linspace(*study.bounds, 200, axis=1)), -1).reshape(-1, 2)
    found = study.evaluate(grid)
    f = found.f[found.feasible]
    span = np.ptp(front.f, axis=0)
    assert not any((f < member - 0.002 * span).all(1).any() for member in front.f)
    assert (front.f.min(0) < f.min(0) + 0.01 * np.ptp(f, axis=0)).all()


@pytest.mark.slow
@pytest.mark.parametrize("space", [DOOR_HANDLE_SPACE, FOUR], ids=["three", "four"])
def test_it_reaches_a_long_search_of_nsga2_on_the_door_handle(space):
    study = door_handle_study(space=space)
    reference = reference_point(study)
    long = nsga2(study, population=100, generations=150, seed=1).hypervolume(reference)
    assert quick_front(study).hypervolume(reference) > 0.9995 * long


# ---------------------------------------------------------------- what every front is


@pytest.fixture(scope="module")
def lift():
    return quick_front(lift_curve_study())


def test_every_design_is_feasible_on_all_angles_and_none_beats_another(lift):
    evaluation = lift.study.evaluate(lift.x)
    assert lift.study.angles == 361
    assert evaluation.feasible.all()
    assert_allclose(evaluation.f, lift.f, rtol=1e-13)
    beats = (lift.f[:, None] <= lift.f).all(-1) & (lift.f[:, None] < lift.f).any(-1)
    assert not beats.any()
    assert (np.diff(lift.f[:, 0]) >= 0).all()
    low, high = lift.study.bounds
    assert ((lift.x >= low) & (lift.x <= high)).all()


def test_few_angles_are_never_the_last_word():
    """Seen at few angles everything keeps the limit; on all of them only half of the front does."""
    fine = Measure("seen", "", lambda s: first(s) * (s.angles > 200))
    front = quick_front(points(space="ab", at_most={fine: 0.5}).replace(angles=361))
    assert front.x[:, 0].max() <= 0.5
    assert front.x[:, 0].max() > 0.49
    assert len(front) > 90


@pytest.mark.parametrize("make", [door_handle_study, lift_curve_study, valve_front_study])
def test_a_rough_study_is_near_the_exact_one(make):
    """On feasible designs: objectives within half a per cent, so the exact rounds begin near their end."""
    study = make()
    low, high = study.bounds
    x = low + np.random.default_rng(5).random((300, len(low))) * (high - low)
    exact, rough = study.evaluate(x), study.replace(rough=True).evaluate(x)
    assert exact.feasible.sum() > 10
    assert_allclose(rough.f[exact.feasible], exact.f[exact.feasible], rtol=5e-3)
    assert (rough.feasible == exact.feasible).mean() > 0.98


def test_the_stored_search_is_what_the_search_finds():
    """Of the chart that notebook 15 shows: designs to the last one, hypervolume but for a processor's last bits."""
    stored, study = load("live_front_searches"), door_handle_study()
    quick, genetic = (stored["searches"][name] for name in ("quick_front", "NSGA-II (pymoo)"))
    *_, last = fast_front_steps(study)
    assert list(study.free) == stored["free"]
    assert_allclose(reference_point(study), stored["reference"], rtol=1e-9)
    assert last.evaluated == quick["designs"][-1]
    assert_allclose(last.front.hypervolume(stored["reference"]), quick["hypervolume"][-1], rtol=1e-6)
    for number, step in zip(range(1, 6), nsga2_steps(study, stored["population"], 5, stored["seed"]), strict=False):
        assert step.evaluated == genetic["designs"][number - 1] == 100 * number
        assert_allclose(step.front.hypervolume(stored["reference"]), genetic["hypervolume"][number - 1], rtol=1e-6)


def test_the_notebook_on_the_searches():
    """`quick_front` passes NSGA-II after a thirtieth of its designs; 0.7 % is missing in the end."""
    stored = load("live_front_searches")
    quick, genetic = (stored["searches"][name] for name in ("quick_front", "NSGA-II (pymoo)"))
    passed = next(n for n, v in zip(*quick.values(), strict=True) if v >= genetic["hypervolume"][-1])
    assert genetic["designs"][-1] / passed == pytest.approx(30, abs=3)
    assert 1 - quick["hypervolume"][-1] / stored["best"] == pytest.approx(0.007, abs=2e-4)
    assert stored["times_longer"] == pytest.approx(50, abs=5)


def test_it_is_the_same_at_every_call(lift):
    again = quick_front(lift_curve_study())
    assert_array_equal(again.x, lift.x)
    assert_array_equal(again.f, lift.f)


def test_a_front_tells_how_it_was_found(lift):
    assert lift.record["designs"] == [step.record["designs"] for step in fast_front_steps(lift_curve_study())][-1]
    assert lift.record["seconds"] > 0
    assert lift.record["versions"] == versions()
    study, looked = lift_curve_study(), []
    counted = Study.evaluate
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Study, "evaluate", lambda self, x: (looked.append(len(x)), counted(self, x))[1])
        *_, last = fast_front_steps(study)
    assert 0 < sum(looked) - last.record["designs"] <= 300  # those of the last rounds begin with what is there already


def test_the_last_bits_of_a_processor_do_not_grow_into_another_front(lift):
    noise = np.random.default_rng(3)

    class Noisy(Study):
        def evaluate(self, x):
            told = super().evaluate(x)
            return type(told)(told.x, told.f * (1 + 2e-16 * noise.integers(-1, 2, told.f.shape)), told.g)

    start = lift_curve_study()
    shaken = quick_front(Noisy(start.start, start.free, start.minimise, start.at_most, start.at_least, start.angles))
    assert_array_equal(shaken.x, lift.x)


def test_free_values_lie_on_the_grid():
    front = quick_front(points(space="ab"))
    shares = (front.x + 4) / 8 * 2**20
    assert_allclose(shares, np.round(shares), atol=1e-6)


@pytest.mark.parametrize("size", [4, 17, 60])
def test_it_holds_as_many_designs_as_are_asked_for(size):
    front = quick_front(points(space="ab"), size)
    assert len(front) == size
    gaps = np.hypot(*np.diff(front.f / np.ptp(front.f, axis=0), axis=0).T)
    assert gaps.max() < 4 * gaps.sum() / (size - 1)


def test_a_front_that_is_near_saves_most_of_the_search():
    moved = partial(lift_curve_study, reference=DoorHandleCam())
    before = quick_front(moved(DoorHandleCam()))
    study = moved(DoorHandleCam(lift_centre_distance=76 * mm))
    cold, warm = list(fast_front_steps(study)), list(fast_front_steps(study, start=before))
    assert len(warm) < len(cold) / 4
    assert (warm[-1].number, warm[-1].of) == (len(warm), len(warm))
    reference = reference_point(study)
    assert warm[-1].front.hypervolume(reference) > 0.998 * cold[-1].front.hypervolume(reference)


def test_a_start_that_is_not_feasible_any_more_does_no_harm():
    before = quick_front(points(space="ab"))
    study = points(space="ab", at_least={first: 1.5})
    front = quick_front(study, start=before)
    assert (front.x[:, 0] >= 1.5).all()
    assert off(front, corner(1.5)).max() < 0.01
    assert_allclose(front.f[[0, -1]], [(2.25, 3.25), (3.25, 2.25)], atol=0.01)


# ---------------------------------------------------------------- parts


@pytest.mark.parametrize("k", [2, 3])
def test_unbeaten_is_its_definition(k):
    f = np.random.default_rng(k).integers(0, 6, (80, k)).astype(float)
    rows = _unbeaten(f)
    beaten = [any((g <= h).all() and (g < h).any() for g in f) for h in f]
    assert {tuple(r) for r in f[rows]} == {tuple(h) for h, worse in zip(f, beaten, strict=True) if not worse}
    assert len(rows) == len(np.unique(f[rows], axis=0))
    assert (np.diff(f[rows, 0]) >= 0).all()


def test_thinning_keeps_the_ends_and_an_even_spread():
    t = np.sort(np.random.default_rng(1).random(400)) ** 3  # crowded at one end
    kept = _thinned(Archive(t[:, None], np.stack([t, 1 - t], 1), np.zeros(400)), 30)
    assert len(kept.f) == 30
    assert {t.min(), t.max()} <= set(kept.f[:, 0])
    gaps = np.diff(kept.f[:, 0])
    assert gaps.max() < 3.5 / 29


def test_the_search_begins_all_over_the_box():
    u = _everywhere(3, 64)
    assert u.shape == (27 + 64, 3)
    assert {(0, 0, 0), (1, 1, 1), (0.5, 0.5, 0.5), (1, 0, 0.5)} <= {tuple(row) for row in u}
    assert ((u >= 0) & (u <= 1)).all()


# ---------------------------------------------------------------- refusals


def test_what_it_does_not_serve_is_refused_in_a_sentence():
    five = door_handle_study(space={n: EXPANDED_SPACE[n] for n in list(EXPANDED_SPACE)[:5]})
    with pytest.raises(ValueError, match=r"^a quick front takes up to 4 free quantities; this study has 5: take nsga2"):
        quick_front(five)
    with pytest.raises(ValueError, match=r"takes two or more objectives; this study has one: take minimise$"):
        quick_front(points(near_0))
    with pytest.raises(ValueError, match=r"the number of designs on the front is 3; it must be .* at least 4$"):
        quick_front(points(), 3)
    with pytest.raises(ValueError, match=r"^the start has the free quantities a, b; this study has a, b, c$"):
        quick_front(points(space="abc"), start=quick_front(points(space="ab"), 4))


def test_an_empty_front_says_which_limit_stood_in_the_way():
    front = quick_front(points(space="ab", at_most={near_0: 0.01}, at_least={first: 0.2}))
    assert len(front) == 0
    assert "keeps every limit; the nearest misses the" in front.message
    nothing = quick_front(Study(Point(3.5, 0, 0, 0), {"a": (3.2, 4.0)}, (near_0, far)))
    assert "can be built" in nothing.message


# ---------------------------------------------------------------- the worker: newest wins


def test_only_the_newest_of_what_waits_is_done():
    done, go, began = [], threading.Event(), threading.Event()

    def work(task):
        began.set()
        go.wait(10)
        done.append((task, worker.stale))

    worker = LatestOnly(work)
    worker.ask(0)
    assert began.wait(10)
    for task in range(1, 6):
        worker.ask(task)
    assert worker.stale
    go.set()
    worker.wait(10)
    assert done == [(0, True), (5, False)]
    worker.ask(6)
    worker.wait(10)
    assert done[-1] == (6, False)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_work_that_fails_does_not_keep_the_next_from_being_done():
    done, go, began = [], threading.Event(), threading.Event()

    def work(task):
        began.set()
        go.wait(10)
        done.append(1 / task)

    worker = LatestOnly(work)
    worker.ask(0)
    assert began.wait(10)
    worker.ask(2)  # waits while the first fails
    go.set()
    until = time.monotonic() + 10
    while not done and time.monotonic() < until:
        time.sleep(0.001)
    assert done == [0.5]
    worker.wait(10)
    worker.ask(0)
    worker.wait(10)
    worker.ask(4)
    worker.wait(10)
    assert done == [0.5, 0.25]


def test_later_is_once_after_the_last_time_it_was_asked_for():
    done = threading.Event()
    later = Debounced(done.set, 0.05)
    assert not later.waiting
    for _ in range(3):
        later.ask()
    assert later.waiting
    assert done.wait(10)
    done.clear()
    later.ask()
    later.cancel()
    assert not later.waiting
    assert not done.wait(0.2)


# ---------------------------------------------------------------- the panel

STUDIES = {"lift curve alone": lift_curve_study(), "whole cam": door_handle_study()}
SLIDERS = ["lift_arm", "lift_start_angle", "relief_cam_angle", "lift_centre_distance", "lift_swing"]


@pytest.fixture(scope="module")
def workshop():
    app = explore(DoorHandleCam(), curvature, free=SLIDERS)
    criteria = ahp_panel(PAPER_JUDGEMENTS)
    importance = ahp_panel(Judgements(["effort", "least radius"], [1]))
    panel = live_pareto_panel(app, STUDIES, LIFT_SPACE, criteria=criteria, importance=importance)
    yield panel
    panel.settle()


@pytest.fixture
def panel(workshop):
    """The panel as it is when it has just been opened."""
    workshop.menu.value = "lift curve alone"
    workshop.picker.rule.value = workshop.picker.first_rule
    workshop.criteria.load(PAPER_JUDGEMENTS)
    workshop.importance.load([1])
    workshop.explorer.load(DoorHandleCam())
    workshop.settle()
    return workshop


def asked(make, cam):
    return quick_front(make(cam, space=LIFT_SPACE, reference=DoorHandleCam()))


def marks(panel, key):
    mark = panel.picture.shown[0][key]
    return np.array([mark.x, mark.y], dtype=float)


def test_it_opens_with_the_front_of_the_package(panel, lift):
    assert_array_equal(panel.front.x, lift.x)
    assert_allclose(marks(panel, "front"), shown_objectives(lift))
    radius = stroke_radius(DoorHandleCam().analyse(lift.study.angles))
    assert_allclose(marks(panel, "in the sliders").ravel(), [1, radius / mm], rtol=1e-5)
    assert panel.summary().startswith("100 designs on the front; winner by weighted sum:\neffort: 0.9")


def test_a_slider_moves_the_front_and_a_free_one_does_not(panel, lift):
    fronts = []
    panel.on_front(lambda: fronts.append(panel.front))
    move(panel.explorer, "lift_arm", 47)
    panel.settle()
    assert not fronts
    assert_array_equal(panel.front.x, lift.x)
    here = lift.study.evaluate([47 * mm, *lift.study.x0[1:]]).f[0]
    assert_allclose(marks(panel, "in the sliders").ravel(), here / (1, -mm))
    move(panel.explorer, "lift_centre_distance", 78)
    panel.settle()
    assert len(fronts) == 2  # at once from the front that was there, then from nothing
    alone = asked(lift_curve_study, DoorHandleCam(lift_centre_distance=78 * mm))
    assert_array_equal(panel.front.x, alone.x)
    assert_allclose(marks(panel, "front"), shown_objectives(alone))
    assert_allclose(marks(panel, "before"), shown_objectives(lift))
    reference = reference_point(alone.study)
    assert fronts[0].hypervolume(reference) > 0.995 * alone.hypervolume(reference)


def test_what_stays_does_not_depend_on_the_way(panel):
    fronts = []
    panel.on_front(lambda: fronts.append(panel.front))
    for shown in (70, 80, 90, 74, 76):
        move(panel.explorer, "lift_centre_distance", shown)
        time.sleep(0.01)
    panel.settle()
    assert_array_equal(panel.front.x, asked(lift_curve_study, DoorHandleCam(lift_centre_distance=76 * mm)).x)
    assert len(fronts) < 10  # two for each if they queued


def test_a_judgement_weighs_anew_at_once(panel, lift):
    weighed = []
    panel.on_front(lambda: weighed.append(panel.front))
    panel.criteria.load([3, 3, 1])
    study = lift.study.with_weights(panel.criteria.weights)
    assert_array_equal(weighed[0].f, lift.judged_by(study).f)
    panel.settle()
    assert_array_equal(panel.front.f, quick_front(study).f)


def test_the_importance_chooses_another_winner_of_the_same_front(panel, lift):
    panel.picker.rule.value = "weighted sum"
    panel.importance.load([9])
    little = panel.winner
    panel.importance.load([1 / 9])
    assert panel.front.f[panel.winner, 1] < panel.front.f[little, 1]
    assert_array_equal(panel.front.x, lift.x)
    assert_allclose(marks(panel, "winner").ravel(), shown_objectives(lift)[:, panel.winner])


def test_slider_click_and_button_load_a_design_and_keep_what_is_not_free(panel):
    move(panel.explorer, "lift_centre_distance", 78)
    panel.settle()
    panel.picker.pick.value = 7
    assert_allclose([getattr(panel.explorer.design, n) for n in LIFT_SPACE], panel.front.x[7])
    assert panel.explorer.design.lift_centre_distance == pytest.approx(78 * mm)
    assert_allclose(marks(panel, "in the sliders").ravel(), shown_objectives(panel.front)[:, 7], rtol=1e-9)
    click(panel, *shown_objectives(panel.front)[:, 60])
    assert panel.picker.pick.value == 60
    panel.picker.take.click()
    assert panel.picker.pick.value == panel.winner
    panel.select(1000)
    assert panel.picker.pick.value == panel.winner


def test_another_problem(panel, lift):
    panel.explorer.load(DoorHandleCam(roller_radius=3 * mm))
    panel.menu.value = "whole cam"
    panel.settle()
    cam = DoorHandleCam(roller_radius=3 * mm)
    assert_array_equal(panel.front.x, asked(door_handle_study, cam).x)
    assert "worse curve" in panel.picture.shown[0].axes.ylabel


def test_a_problem_without_a_design_is_told_in_place_of_the_picture(panel):
    move(panel.explorer, "lift_swing", 110)
    panel.settle()
    assert not len(panel.front)
    assert panel.winner is None
    assert "There is no front: no design that was evaluated" in panel.banner.text
    assert not panel.picture.visible
    assert not panel.numbers.visible
    assert panel.summary().startswith("no front: no design")
    panel.explorer.load(DoorHandleCam())
    panel.settle()
    assert panel.banner.text == ""
    assert panel.picture.visible
    assert panel.numbers.visible


def test_a_study_that_cannot_be_made_is_told_and_forgotten():
    app = explore(DoorHandleCam(), curvature, free=["handle_angle"])

    def refusing(analysis):
        if analysis.cam.handle_angle > 3.2:
            raise ValueError("the handle turns too far")
        return 0.0

    lift = lift_curve_study()
    panel = live_pareto_panel(app, lift.replace(at_most={**lift.at_most, Measure("refusing", "", refusing): 1.0}))
    move(app, "handle_angle", 190)
    panel.settle()
    assert "There is no front: the handle turns too far." in panel.banner.text
    move(app, "handle_angle", 180)
    panel.settle()
    assert panel.banner.text == ""


def test_five_free_quantities_are_refused():
    app = explore(DoorHandleCam(), curvature, free=SLIDERS)
    with pytest.raises(ValueError, match="a quick front takes up to 4 free quantities; this study has 7"):
        live_pareto_panel(app, door_handle_study(space=EXPANDED_SPACE))


def test_every_control_comes_back(panel):
    assert try_everything(panel) == 7
    panel.settle()


# ---------------------------------------------------------------- pictures


@pytest.mark.filterwarnings("error")
def test_drawing_again_moves_what_was_drawn(lift):
    _, axes = layout((live_pareto,), width=6, height=4)
    draw(LiveFront(lift, lift, (1.0, -0.03), 4), axes, (live_pareto,))
    first = list(axes[0].lines)
    other = quick_front(lift.study, 20)
    draw(LiveFront(other, lift, (0.9, -0.04), None), axes, (live_pareto,))
    assert list(axes[0].lines) == first
    assert_allclose(artist_of(axes[0], "front").get_data(), shown_objectives(other))
    assert_allclose(np.ravel(artist_of(axes[0], "in the sliders").get_data()), (0.9, 40))
    assert [t.get_text() for t in axes[0].get_legend().get_texts()] == ["before", "front", "in the sliders", "winner"]


def test_searches_are_compared_in_per_cent():
    _, axes = layout((searches_compared,), width=6, height=4)
    draw({"one": [(100, 0.5), (1000, 0.01)], "other": [(200, 0.2)]}, axes, (searches_compared,))
    assert_allclose(artist_of(axes[0], "one").get_data(), [(100, 1000), (50, 1)])
    assert axes[0].get_xscale() == axes[0].get_yscale() == "log"


@pytest.mark.parametrize("k", [1, 2, 3])
def test_rows_are_told_once_and_spread_as_they_always_were(k):
    """Against ``np.unique`` and the farthest-first choice by its definition; rows that are equal, and ends at once."""
    f = np.random.default_rng(k).integers(0, 12, (300, k)) / 7.0
    assert_array_equal(_each_once(f), np.unique(f, axis=0, return_index=True)[1])
    rows = f[_each_once(f)]
    size = min(20, len(rows) - 1)
    shares = normalised(rows)
    taken = list(dict.fromkeys(shares.argmin(0).tolist()))
    while len(taken) < size:
        gap = np.min([((shares - shares[one]) ** 2).sum(-1) for one in taken], axis=0)
        taken.append(int(gap.argmax()))
    assert_array_equal(spread(rows, size), np.sort(taken))
