"""Fronts of two searches over each other: against the closed form, brute force and the package's own numbers."""

import threading
import time
from dataclasses import dataclass
from functools import partial

import ipywidgets as w
import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose
from sheets import click, parts
from try_everything import try_everything

from camkit import Measure, Study, explore
from camkit.data import load
from camkit.machines.cam_lever import CamLever, lever_stress
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_measures import high_speed_study, peak_stress
from camkit.panels.fronts import compare_fronts
from camkit.panels.kit.parts import Button
from camkit.papers.high_speed_cam import trade_off_studies
from camkit.quantities import Design, quantity
from camkit.render.artists import artist_of, moving
from camkit.render.still import draw, layout
from camkit.search.epsilon_constraint import dominated_shares, epsilon_constraint_steps, trade_off
from camkit.search.front import Front, front_of
from camkit.search.minimise import minimise
from camkit.search.nsga2 import nsga2_steps
from camkit.units import deg, mm
from camkit.views.beside import Beside, cams_beside, curves_beside
from camkit.views.front import ShownFronts, fronts_overlaid
from camkit.views.picture import Axes, Picture, Points


@dataclass(frozen=True)
class Place(Design):
    """A point whose distances from (0, 0) and (2, 0) mm are both to be small: the front is the line between them."""

    x: float = quantity("x", 3, -5, 5, "mm", "to the right", above=None)
    y: float = quantity("y", 1, -5, 5, "mm", "upwards", above=None)

    def analyse(self, n=1):
        return self


def distance(name, x):
    return Measure(name, "mm^2", lambda a: np.atleast_1d((a.x - x) ** 2 + a.y**2)[..., 0])


here, there = distance("from here", 0.0), distance("from there", 2 * mm)


def places(**limits):
    return Study(Place(), ("x", "y"), (here, there), **limits)


def view(analysis):
    return Picture.of(Axes(), Points("place", analysis.x, analysis.y))


@pytest.fixture(scope="module")
def fronts():
    *_, smooth = epsilon_constraint_steps(places(), 9)
    *_, evolved = nsga2_steps(places(), 40, 60, 1)
    return {"limits": smooth.front, "NSGA-II": evolved.front}


def on_the_line(front, tolerance):
    return np.sqrt(front.f).sum(-1) == pytest.approx(2 * mm, rel=tolerance)


# ---------------------------------------------------------------- fronts


def test_both_ways_find_the_front_that_is_known(fronts):
    assert on_the_line(fronts["limits"], 1e-5)
    assert on_the_line(fronts["NSGA-II"], 2e-2)
    assert len(fronts["limits"]) == 9
    assert len(fronts["NSGA-II"]) == 40


def test_the_steps_of_a_trade_off_are_its_designs_so_far():
    every, minima = list(epsilon_constraint_steps(places(), 4)), list(trade_off(places(), 4))
    assert len(every) > 8
    assert all(step.number == len(step.front) for step in every)
    assert [s.evaluated for s in every] == sorted(s.evaluated for s in every)
    steps = [step for step in every if step.message]
    assert [(s.number, s.of) for s in steps] == [(1, 4), (2, 4), (3, 4), (4, 4)]
    for i, step in enumerate(steps):
        assert_allclose(step.evaluation.x, [best.x for best in minima[: i + 1]])
        assert step.feasible == i + 1
    with pytest.raises(ValueError, match="has 1 objectives; a trade-off is between two"):
        epsilon_constraint_steps(places().replace(minimise=(here,)))


def test_dominated_shares_by_throwing_darts(fronts):
    start = places().evaluate(places().x0).f[0]
    shares = dominated_shares(fronts, start)
    best = np.concatenate([front.f for front in fronts.values()]).min(0)
    darts = np.random.default_rng(1).uniform(best, start, (100_000, 2))
    for name, front in fronts.items():
        beaten = (front.f[:, None] <= darts).all(-1).any(0).mean()
        assert shares[name] == pytest.approx(beaten, abs=5e-3)
    assert shares["NSGA-II"] > shares["limits"]  # on a line that both find, more designs dominate more


def test_dominated_shares_of_nothing_and_where_the_start_is_best(fronts):
    study = places()
    nothing = Front(study, np.zeros((0, 2)), np.zeros((0, 2)))
    assert dominated_shares({"none": nothing}, (1, 1)) == {"none": 0}
    assert dominated_shares({**fronts, "none": nothing}, (1, 1))["none"] == 0
    assert np.isnan(list(dominated_shares(fronts, (0.0, 1.0)).values())).all()


# ---------------------------------------------------------------- pictures


def drawn(shown, *views, **position):
    _, axes = layout(views, width=8, height=5)
    draw(shown, axes, views, **position)
    return axes


def xy(ax, key):
    return np.array(artist_of(ax, key).get_data(), dtype=float)


def test_fronts_are_drawn_in_their_units_with_the_start_and_the_design(fronts):
    shown = ShownFronts(fronts, start=np.array([10, 2]) * mm**2, here=np.array([3, 4]) * mm**2)
    made = fronts_overlaid(shown)
    for name, front in fronts.items():
        assert_allclose([made[f"front {name}"].x, made[f"front {name}"].y], front.f.T / mm**2)
    assert (*made["start"].x, *made["start"].y) == pytest.approx((10, 2))
    assert (*made["in the sliders"].x, *made["in the sliders"].y) == pytest.approx((3, 4))
    assert [mark.label for mark in made.marks] == ["limits", "NSGA-II", "start", "in the sliders"]
    assert made.axes.xlabel == "from here  [mm^2]\n(smaller is better)"


@pytest.mark.filterwarnings("error")
def test_fronts_drawn_again_are_moved(fronts):
    (ax,) = drawn(ShownFronts(fronts), fronts_overlaid)
    artists = set(moving(ax))
    empty = {name: Front(front.study, front.x[:0], front.f[:0]) for name, front in fronts.items()}
    draw(ShownFronts(empty, start=(1.0, 1.0)), [ax], (fronts_overlaid,))
    assert set(moving(ax)) == artists
    assert xy(ax, "front limits").size == 0
    ax.figure.canvas.draw()
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["limits", "NSGA-II", "start"]


def test_what_is_to_be_large_is_shown_large():
    study = Study(Place(), ("x", "y"), (here, -there))
    f = np.array([[1.0, -4.0]]) * mm**2
    (ax,) = drawn(ShownFronts({"one": Front(study, np.zeros((1, 2)), f)}, here=f[0]), fronts_overlaid)
    assert_allclose(xy(ax, "front one").ravel(), (1, 4))
    assert_allclose(xy(ax, "in the sliders").ravel(), (1, 4))
    assert ax.get_ylabel().endswith("(larger is better)")


@pytest.mark.parametrize(
    ("designs", "peak"),
    [
        ((HighSpeedCam(), HighSpeedCam(161 * mm, 82.5 * mm, 140 * mm)), peak_stress),
        ((CamLever(), CamLever(lever=200 * mm)), lever_stress),
    ],
    ids=["cams", "presses"],
)
def test_cams_beside_each_other_do_not_meet(designs, peak):
    analyses = {name: design.analyse(91) for name, design in zip("ab", designs, strict=True)}
    cams, curves = drawn(Beside(analyses, peak), cams_beside, curves_beside, turn=40 * deg)
    spans, offsets = [], []
    for name, analysis in analyses.items():
        outline = artist_of(cams, f"{name} body").get_xy()
        offsets.append(float(xy(cams, f"{name} axis")[0, 0]))
        radius = np.hypot(*(outline - [offsets[-1], 0]).T)
        assert radius.max() == pytest.approx(np.hypot(*analysis.profile).max() / mm)
        parts = [xy(cams, line.get_gid())[0] for line in cams.lines if line.get_gid().startswith(f"{name} ")]
        spans.append((min(outline[:, 0].min(), *map(np.min, parts)), max(outline[:, 0].max(), *map(np.max, parts))))
    assert offsets[0] == 0
    assert spans[0][1] < spans[1][0]
    for name, analysis in analyses.items():
        x, y = xy(curves, f"{name} curve")
        unit = {"N^0.5 mm^-0.5": mm**0.5, "N^0.5 cm^-0.5": (10 * mm) ** 0.5}[peak.unit]
        assert np.nanmax(y) == pytest.approx(float(peak(analysis)) * unit)
        assert xy(curves, f"{name} peak")[1] == pytest.approx(np.nanmax(y))
        assert np.isnan(x).sum() == 1  # the far dwell


def test_a_turned_roller_touches_its_turned_cam():
    analysis = HighSpeedCam().analyse(181)
    for turn in (0.3, 1.0, 4.0):
        (ax,) = drawn(Beside({"a": analysis}), cams_beside, turn=turn)
        arm = next(key for key in (line.get_gid() for line in ax.lines) if key.endswith(" roller"))
        circle = xy(ax, arm)
        centre = (circle.max(1) + circle.min(1)) / 2
        gap = np.hypot(*(artist_of(ax, "a body").get_xy() - centre).T).min()
        assert gap == pytest.approx(30, abs=0.05)


# ---------------------------------------------------------------- the panel


@pytest.fixture
def app():
    panel = explore(Place(), view, measures=(here, there))
    yield panel
    close(panel)


def inside(panel, kind):
    children = getattr(panel, "children", ())
    return [child for child in children if isinstance(child, kind)] + [x for c in children for x in inside(c, kind)]


def close(*panels):
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()
            thread.join()
    for panel in panels:
        for widget in [*inside(panel, w.Widget), panel]:
            widget.close()


WAYS = {
    "limits": (places(), partial(epsilon_constraint_steps, points=5)),
    "NSGA-II": (places(), partial(nsga2_steps, population=20, generations=15, seed=1)),
}


@pytest.fixture
def panel(app, fronts):
    panel = compare_fronts(app, WAYS, fronts)
    yield panel
    panel.stop()
    panel.wait(10)
    close(panel)


def marked(panel, key):
    mark = panel.picture.shown[0][key]
    return np.array([mark.x, mark.y], dtype=float)


def ring(panel):
    return marked(panel, "in the sliders").ravel()


def test_a_design_that_is_picked_goes_into_the_sliders(panel, app, fronts):
    panel.select("NSGA-II", 3)
    assert app.design == fronts["NSGA-II"][3]
    assert (panel.menu.value, panel.pick.value, panel.pick.max) == ("NSGA-II", 3, 39)
    panel.pick.value = 5
    assert app.design == fronts["NSGA-II"][5]
    panel.menu.value = "limits"
    assert panel.pick.max == 8
    panel.pick.value = 0
    assert app.design == fronts["limits"][0]
    assert_allclose(ring(panel), fronts["limits"].f[0] / mm**2, atol=1e-12)


def test_in_a_tab_of_the_instrument_the_page_has_every_design_that_a_point_stands_for(panel, app, fronts):
    assert app.tabs == [{"title": "Fronts", "sheets": [panel]}]
    x, y, designs = map(np.frombuffer, panel.picture.data[0]["offered"])
    every = list(fronts.values())
    assert_allclose([x, y], np.concatenate([front.f for front in every]).T / mm**2)
    assert_allclose(designs.reshape(-1, 2), np.concatenate([front.x for front in every]))


def test_the_cross_follows_the_sliders(panel, app):
    move(app, "x", 1.5)
    assert_allclose(ring(panel), [1.5**2 + 1, 0.5**2 + 1])
    assert "in the sliders: from here 3.25 mm^2, from there 1.25 mm^2" in panel.summary()


def test_a_click_loads_the_nearest_design_of_any_front(panel, app, fronts):
    for name, i in (("limits", 4), ("NSGA-II", 11)):
        click(panel, *(fronts[name].f[i] / mm**2 + [0.001, -0.001]))
        assert (panel.menu.value, panel.pick.value) == (name, i)
        assert app.design == fronts[name][i]


def test_the_searches_run_around_the_design_in_the_sliders(app):
    panel = compare_fronts(app, {"limits": (places(at_most={here: 9 * mm**2}), WAYS["limits"][1])})
    assert len(panel.fronts["limits"]) == 0
    assert panel.pick.disabled
    move(app, "x", 2.5)
    panel.run()
    panel.wait(60)
    front = panel.fronts["limits"]
    assert front.study.start == app.design
    assert on_the_line(front, 1e-5)
    assert (panel.runner.progress.value, panel.runner.progress.max) == (5, 5)
    assert panel.runner.status.text.startswith("all fronts are there")
    assert panel.seconds["limits"] > 0
    assert not panel.pick.disabled
    assert_allclose(marked(panel, "front limits"), front.f.T / mm**2)
    assert front[2].analyse() == front[2]  # its study no longer listens to Stop
    assert panel.table.text.split("\n")[1].startswith(f"limits  5  {100 * panel.shares()['limits']:.1f} %  ")
    close(panel)


def test_stop_keeps_the_fronts_so_far(app):
    endless = partial(nsga2_steps, population=8, generations=10**6, seed=1)
    panel = compare_fronts(app, {"endless": (places(), endless), "never": (places(), endless)})
    panel.run()
    until = time.monotonic() + 20
    while panel.runner.progress.value < 3 and time.monotonic() < until:
        time.sleep(0.01)
    panel.run()  # a second press does nothing
    panel.stop()
    panel.wait(20)
    assert panel.runner.status.text == "stopped"
    assert len(panel.fronts["endless"]) > 0
    assert len(panel.fronts["never"]) == 0
    assert panel.runner.stop_button.disabled
    panel.select("never", 0)
    assert app.design == Place()
    close(panel)


def test_what_cannot_be_searched_is_said(app):
    broken = (places(), lambda study: nsga2_steps(study, 1, 5, 1))
    panel = compare_fronts(app, {"broken": broken})
    panel.run()
    panel.wait(20)
    assert "the population is 1; it must be a whole number of at least 4" in panel.banner.text
    assert panel.banner.visible
    close(panel)


def test_fronts_that_do_not_belong_together_are_refused(app, fronts):
    with pytest.raises(ValueError, match="there is nothing to compare"):
        compare_fronts(app)
    other = front_of(places().replace(minimise=(here,)).evaluate([[0.0, 0.0]]), places().replace(minimise=(here,)))
    with pytest.raises(ValueError, match="of the same two objectives"):
        compare_fronts(app, given={**fronts, "other": other})
    with pytest.raises(ValueError, match="the fronts are of from here; they must be of the same two objectives"):
        compare_fronts(app, given={"other": other})


def test_given_fronts_need_no_search_and_everything_moves(app, fronts):
    panel = compare_fronts(app, given=fronts)
    assert not parts(panel, Button)
    assert try_everything(panel) == 2
    assert panel.shares() == dominated_shares(fronts, panel.start)
    assert panel.summary().startswith("limits: 9 designs, dominates ")
    close(panel)


def test_what_cannot_be_compared_is_not_given_as_a_number(app):
    study = places()
    best = Front(study, np.zeros((1, 2)), study.evaluate([study.x0]).f)
    nothing = Front(study, np.zeros((0, 2)), np.zeros((0, 2)))
    panel = compare_fronts(app, given={"the start": best, "nothing": nothing})
    assert panel.table.text.split("\n")[1:] == ["the start  1    ", "nothing  0    "]
    sentence = "in one of the objectives no design is better than the starting design"
    assert sentence in panel.note.text
    lines = panel.summary().split("\n")
    assert lines[:2] == ["the start: 1 design", "nothing: 0 designs"]
    assert sentence in lines[2]
    panel.menu.value = "nothing"
    assert (panel.pick.disabled, panel.pick.value, panel.pick.max) == (True, 0, 0)
    close(panel)


def test_a_shorter_front_in_the_menu_keeps_the_slider_on_it(panel, fronts):
    panel.select("NSGA-II", 30)
    panel.menu.value = "limits"
    assert (panel.pick.value, panel.pick.max) == (8, 8)


# ---------------------------------------------------------------- what was measured of the high-speed cam


@pytest.fixture(scope="module")
def measured():
    searches = load("high_speed_searches")["fronts"]
    return {
        (name, method): front_of(study.evaluate(kept["x"]), study)
        for name, methods in searches.items()
        for (method, kept), study in zip(methods.items(), trade_off_studies(name == "laws free"), strict=True)
    }


def test_stored_designs_keep_their_limits_and_are_fronts(measured):
    for (name, method), front in measured.items():
        stored = load("high_speed_searches")["fronts"][name][method]["x"]
        assert len(front) == len(stored) >= 33
        dense = front.study.replace(angles=4001).evaluate(front.x)
        assert dense.g.max() <= 1e-9
        assert_allclose(dense.f, front.f, rtol=1e-3)


def test_no_evolved_design_beats_the_constrained_optima(measured):
    for name in ("sizes alone", "laws free"):
        smooth, evolved = measured[name, "epsilon-constraint"].f, measured[name, "NSGA-II"].f
        assert not (evolved[:, None] < smooth[None] * (1 - 1e-4)).all(-1).any()
        assert (smooth[:, None] < evolved[None]).all(-1).any()
    laws, sizes = (measured[name, "epsilon-constraint"].f for name in ("laws free", "sizes alone"))
    assert (laws[:, None] < sizes[None]).all(-1).any(0).all()


def test_stored_trials_are_of_the_optimum_that_minimise_finds():
    trials = load("high_speed_searches")["min_stress"]
    for problem, free in (("3 sizes", False), ("3 sizes, 8 coefficients", True)):
        least = minimise(high_speed_study(free_laws=free)).f * mm**0.5
        for method, trial in trials[problem].items():
            assert len(trial["stress"]) == len(trial["designs"]) == len(trial["seconds"]) == 10
            assert min(trial["stress"]) >= least * (1 - 1e-4)
            if method == "SLSQP, epigraph":
                assert trial["stress"] == pytest.approx([least] * 10, rel=1e-4)


def test_the_time_that_is_left_is_of_one_search_and_says_how_many_come_after_it():
    way = places(), partial(nsga2_steps, population=20, generations=15, seed=1)
    panel = compare_fronts(explore(Place(), view, measures=(here, there)), {"first": way, "second": way})
    left = []
    panel.runner.left.observe(lambda _: left.append(panel.runner.left.text), "value")
    panel.run()
    panel.wait(60)
    assert any(words.endswith("this search; 1 more after it") for words in left)
    assert left[-1] == ""
