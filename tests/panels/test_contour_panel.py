"""The survey of a study over two quantities: its picture against the study, its panel against the package."""

import itertools
from dataclasses import dataclass

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose
from scipy.interpolate import RegularGridInterpolator
from sheets import do, press
from try_everything import try_everything

from camkit import Measure, Study, explore
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_measures import peak_wear
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import corrected_valve_study, valve_study
from camkit.motion import Cycloidal
from camkit.panels.contours import contour_panel, optimum
from camkit.quantities import Design, quantity
from camkit.render.contours import level_curve
from camkit.search.minimise import minimise
from camkit.study.design_map import DesignMap
from camkit.study.weighted import weighted
from camkit.units import mm, rpm
from camkit.views.cam import pressure_angle
from camkit.views.design_map import SHADES, ShownPlane, objective_plane
from camkit.views.event import lift

WIDE = ValveCam(base_radius=24.5 * mm)


def at(mark, x):
    """What the grid of a mark says at points ``(p, 2)`` in the units of the axes."""
    return RegularGridInterpolator((mark.y, mark.x), mark.z)(np.asarray(x)[:, ::-1])


def covers(region, x):
    value = at(region, x)
    return (region.low <= value) & (value < region.high)


def legend(view):
    return [mark.label for mark in view.marks if mark.label]


def curve(contour, i=0):
    """A contour's points, ``(m, 2)``."""
    points = level_curve(contour.x, contour.y, contour.z, contour.levels[i]).T
    return points[np.isfinite(points).all(1)]


# --- the picture ------------------------------------------------------------------------------------------------------


def test_each_shade_covers_the_same_area_and_darker_is_better():
    plane = DesignMap(valve_study(), n=61)
    view = objective_plane(ShownPlane(plane))
    shades = [view[f"shade {i}"] for i in range(SHADES)]
    assert (np.diff([shade.opacity for shade in shades]) < 0).all()
    x = np.random.default_rng(1).uniform(*plane.study.bounds, (4000, 2))
    f = plane.study.evaluate(x).f[:, 0]
    inside = np.array([covers(shade, x) for shade in shades])
    assert (inside.sum(0) == 1).all()
    assert_allclose(inside.mean(1), 1 / SHADES, atol=0.03)
    for lower, upper in itertools.pairwise(inside):
        assert f[lower].max() < f[upper].max() + 1e-3


def test_levels_are_where_the_objective_has_the_value_that_is_told():
    study = corrected_valve_study(WIDE, (0.9, 0.1))
    levels = objective_plane(ShownPlane(DesignMap(study, n=61)))["levels"]
    for i in range(0, SHADES - 1, 2):
        assert_allclose(study.evaluate(curve(levels, i)).f[:, 0], float(levels.names[i]), atol=2e-3)


def test_the_veil_covers_what_misses_the_limit():
    study = corrected_valve_study(WIDE)
    view = objective_plane(ShownPlane(DesignMap(study, n=61)))
    x = np.random.default_rng(2).uniform(*study.bounds, (4000, 2))
    feasible = study.evaluate(x).feasible
    assert 0.2 < feasible.mean() < 0.8
    assert (covers(view["missed"], x) == ~feasible).mean() > 0.99
    assert abs(study.evaluate(curve(view["limit"])).g).max() < 0.02


def test_marks_and_legend():
    view = objective_plane(ShownPlane(DesignMap(valve_study(), n=21), here=(6, 16), best=(20, 20)))
    assert_allclose([view["in the sliders"].x, view["in the sliders"].y], [[6], [16]])
    assert_allclose([view["optimum"].x, view["optimum"].y], [[20], [20]])
    assert legend(view) == ["radius at the nose (flat follower) at least 4.5 mm", "in the sliders", "optimum"]
    assert view.axes.xlabel == "n"
    assert view.axes.title == "Fullness against nose deceleration"
    view = objective_plane(ShownPlane(DesignMap(corrected_valve_study(), n=21)))
    assert np.isnan(view["optimum"].x).all()
    assert legend(view) == ["minimum convex radius of curvature at least 4.5 mm"]


@dataclass(frozen=True)
class Slab(Design):
    """A plate of two lengths; a long one cannot be built."""

    width: float = quantity("b", 30, 10, 60, "mm", "its width")
    height: float = quantity("h", 30, 10, 60, "mm", "its height")

    def analyse(self, n=1):
        return self


area = Measure("area", "mm^2", lambda p: (p.width * p.height).sum(-1) if np.ndim(p.width) else p.width * p.height)
slim = Measure("width", "mm", lambda p: np.where(p.width < 50 * mm, p.width, np.nan).sum(-1))
tall = Measure("height", "mm", lambda p: p.height.sum(-1))


def test_lengths_are_shown_in_their_units_and_what_grows_is_read_as_it_is():
    study = Study(Slab(), ("width", "height"), (-area,), at_most={slim: 40 * mm}, at_least={tall: 20 * mm})
    view = objective_plane(ShownPlane(DesignMap(study, n=41), here=(0.03, 0.03), best=(0.04, 0.06)))
    assert (view.axes.xlabel, view.axes.ylabel) == ("width  b  [mm]", "height  h  [mm]")
    assert view.axes.title == "Area  [mm^2]"
    assert legend(view) == ["a limit", "in the sliders", "optimum"]
    assert_allclose([view["in the sliders"].x, view["in the sliders"].y], [[30], [30]])
    assert_allclose(curve(view["levels"], 2).prod(1), float(view["levels"].names[2]), rtol=5e-3)
    assert covers(view["missed"], [(55, 40), (45, 40), (30, 15)]).all()  # cannot be built, too wide, too low
    assert not covers(view["missed"], [(35, 40)]).any()


def test_without_a_limit_nothing_is_veiled():
    view = objective_plane(ShownPlane(DesignMap(Study(Slab(), ("width", "height"), (area,)), n=11)))
    assert not len(curve(view["limit"]))
    assert legend(view) == []


@pytest.mark.parametrize("w", [0.4, 0.55, 0.557, 0.558, 0.6])
def test_the_optimum_is_the_lower_of_two_valleys(w):
    study = valve_study(weights=(w, 1 - w), printed_sign=True)
    assert_allclose(optimum(DesignMap(study, n=21)), (4.827593 if w < 0.5577 else 20, 20), atol=1e-5)
    assert_allclose(optimum(DesignMap(study, n=21)), minimise(study, "de").x, atol=1e-3)


def test_an_optimum_inside_the_plane_and_one_that_is_not_there():
    study = corrected_valve_study(WIDE, (0.9, 0.1))
    x = optimum(DesignMap(study, n=21))
    near = study.evaluate(x + 0.05 * np.array([(1, 0), (-1, 0), (0, 1), (0, -1), (0, 0)])).f[:, 0]
    assert near.argmin() == 4
    assert optimum(DesignMap(corrected_valve_study(), n=21)) is None


# --- the panel --------------------------------------------------------------------------------------------------------

PROBLEMS = {
    "nose deceleration": valve_study(),
    "sign as printed": valve_study(printed_sign=True),
    "corrected": corrected_valve_study(),
}


@pytest.fixture(scope="module")
def workshop():
    app = explore(ValveCam(), lift, free=["n", "m", "base_radius", "load.speed"])
    panel = contour_panel(app, PROBLEMS, weights={"fullness": 0.5, "wear": 0.5}, steps=21)
    yield panel
    settled(panel)


@pytest.fixture
def panel(workshop):
    """The panel as it is when it has just been opened."""
    workshop.menu.value = "nose deceleration"
    for knob in workshop.knobs:
        do(workshop, knob, value=0.5)
    workshop.explorer.load(ValveCam())
    return settled(workshop)


def settled(panel):
    panel.later.ask()
    panel.settle()
    return panel


def mark(panel, name):
    shown = panel.picture.shown[0][name]
    return np.ravel([shown.x, shown.y])


def test_it_opens_with_the_optimum(panel):
    assert_allclose(mark(panel, "optimum"), (20, 20))
    assert_allclose(mark(panel, "in the sliders"), (6, 16))
    assert panel.summary() == (
        "nose deceleration: W_1 0.5, W_2 0.5\noptimum: n 20, m 20\nfullness / largest in the box: 1\n"
        "nose deceleration / largest in the box: 0.4511\nradius at the nose (flat follower): 9.719 mm"
    )


def test_weights_move_the_optimum(panel):
    panel.menu.value = "sign as printed"
    for typed, best in ((0.5, 4.827593), (0.62, 4.827593), (0.65, 20)):  # jumps at W1 = 0.5577: 0.5 of 0.8966
        do(panel, panel.knobs[0], value=typed)
        settled(panel)
        assert_allclose(panel.optimum, (best, 20), atol=1e-5)
        assert_allclose(mark(panel, "optimum"), (best, 20), atol=1e-5)
        assert_allclose(panel.weights, (typed / (typed + 0.5), 0.5 / (typed + 0.5)))
        assert panel.plane.study.minimise[0].weights == panel.weights


def test_the_objective_follows_a_weight_at_once_and_the_optimum_a_moment_later(panel):
    before = panel.picture.shown[0]["levels"].levels
    panel.menu.value = "sign as printed"
    assert panel.optimum is None
    assert "looking for the optimum" in panel.summary()
    f, shown = panel.plane.evaluation.f[:, 0], panel.plane.study.evaluate(mark(panel, "optimum"))  # the grid's best
    assert shown.feasible.all()
    assert_allclose(shown.f[0, 0], f[panel.plane.evaluation.feasible].min(), rtol=1e-12)
    assert panel.take.disabled
    assert not np.allclose(panel.picture.shown[0]["levels"].levels, before)
    panel.settle()
    assert not panel.take.disabled
    assert panel.optimum is not None


def test_the_design_in_the_sliders_counts(panel):
    panel.menu.value = "corrected"
    settled(panel)
    assert panel.optimum is None
    assert panel.summary().endswith("no design between the bounds keeps every limit")
    move(panel.explorer, "base_radius", 24.5)
    settled(panel)
    assert_allclose(panel.optimum, DesignMap(corrected_valve_study(WIDE), n=21).best, rtol=1e-6)
    assert_allclose(panel.optimum, (4.0305, 20), atol=1e-4)
    assert "minimum convex radius of curvature: 4.5 mm" in panel.summary()


def test_free_quantities_move_the_mark_and_nothing_else(panel):
    plane = panel.plane
    move(panel.explorer, "n", 9)
    settled(panel)
    assert panel.plane is plane
    assert_allclose(mark(panel, "in the sliders"), (9, 16))
    move(panel.explorer, "load.speed", 1500)
    settled(panel)
    assert panel.plane is not plane
    assert_allclose(panel.plane.study.start.load.speed, 1500 * rpm)


def test_a_law_without_the_free_coefficients_is_surveyed_shaped():
    cam = HighSpeedCam()
    wear = weighted("wear", {peak_wear: 1.0}, (1.0,))
    study = Study(cam, {"rise_law.c0": (-0.5, 0.5), "rise_law.c1": (-0.5, 0.5)}, (wear,), angles=61)
    explorer = explore(cam, pressure_angle, free=["arm_length"])
    survey = contour_panel(explorer, study, {"wear": 1.0}, steps=5)
    explorer.load(cam.replace(rise_law=Cycloidal()))
    survey.settle()
    assert survey.banner.text == ""
    press(survey, "Load the optimum")
    assert explorer.design.rise_law.base == Cycloidal()


def test_a_design_outside_the_bounds_is_surveyed_too(panel):
    move(panel.explorer, "n", 30)
    settled(panel)
    assert_allclose(mark(panel, "in the sliders"), (30, 16))
    assert_allclose(panel.optimum, (20, 20))


def test_the_optimum_and_a_clicked_point_are_loaded(panel):
    press(panel, "Load the optimum")
    assert_allclose((panel.explorer.design.n, panel.explorer.design.m), (20, 20), rtol=1e-12)
    do(panel, panel.picture, does="click", view=0, at=[8.0, 12.0], pixel=[0.05, 0.05])
    assert_allclose((panel.explorer.design.n, panel.explorer.design.m), (8, 12), rtol=1e-9)
    do(panel, panel.picture, does="click", view=0, at=[2.0, 12.0], pixel=[0.05, 0.05])  # beyond the bounds
    assert_allclose(panel.explorer.design.n, 8, rtol=1e-9)


def test_weights_that_are_all_0_are_refused_in_a_sentence(panel):
    do(panel, panel.knobs[0], value=0)
    settled(panel)
    assert panel.weights == (0, 1)
    do(panel, panel.knobs[1], value=0)
    assert "This cannot be surveyed: all weights are 0; at least one must be above 0." in panel.banner.text
    settled(panel)
    assert_allclose(panel.optimum, (20, 20))
    assert "W_1 0, W_2 1" in panel.summary()
    do(panel, panel.knobs[1], value=0.5)
    assert panel.banner.text == ""


def test_every_control_comes_back(panel):
    assert try_everything(panel) == 3


def test_a_study_of_three_quantities_is_refused():
    app = explore(ValveCam(), lift, free=["n"])
    three = valve_study().freeing(("n", "m", "max_lift"))
    with pytest.raises(ValueError, match="a plane shows two free quantities; this study has 3"):
        contour_panel(app, three, weights={"fullness": 0.5, "wear": 0.5})
