"""Fronts of designs that survive being made, against many parts of each that no search has seen."""

from functools import cache
from itertools import islice

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, Poly345, ValveCam, deg, mm, nsga2, quick_front, shaft_study
from camkit.machines import (
    corrected_valve_study,
    door_handle,
    door_handle_study,
    ninety_degree_study,
    rssr_study,
)
from camkit.machines.shaft import twist_utilisation
from camkit.machines.valve_measures import fullness, peak_acceleration
from camkit.quantities import Measure, value_of
from camkit.search import fast_front, search
from camkit.search.front import Front
from camkit.search.nsga2 import nsga2_steps
from camkit.search.robust_front import Room
from camkit.study.margins import FittedMargins

TUBE = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}


def general(paths):
    return {path: 0.5 * deg if "angle" in path else 0.3 * mm for path in paths}


def shaft():
    study = shaft_study()
    return study.replace(minimise=(*study.minimise, twist_utilisation)).under(TUBE)


def valve():
    cam = ValveCam(base_radius=24.5 * mm)
    widths = {"max_lift": 0.05 * mm, "base_radius": 0.05 * mm, "half_angle": 0.5 * deg, "seating_velocity": 0.02}
    spring = {f"load.{name}": 0.06 * getattr(cam.load, name) for name in ("spring_rate", "preload")}
    study = corrected_valve_study(cam).replace(minimise=(-fullness, peak_acceleration))
    return study.under({**widths, **spring})


def door():
    return door_handle_study().under(general(door_handle.EXPANDED_SPACE))


def whole_cam():
    start = DoorHandleCam(motion_law=Poly345())
    study = door_handle_study(start, space=door_handle.EXPANDED_SPACE, reference=DoorHandleCam())
    return study.under(general(study.free))


def linkage():
    """A door's linkage, its pressure angles against the length of its crank."""
    study = ninety_degree_study()
    size = rssr_study().minimise[0]
    return study.replace(minimise=(*study.minimise, size)).under(dict.fromkeys(study.free, 0.3 * mm))


@cache
def found(machine):
    """The nominal and the robust front of a machine."""
    robust = machine()
    if len(robust.free) > 4:
        return nsga2(robust.nominal, 60, 60), nsga2(robust, 60, 60)
    return quick_front(robust.nominal), quick_front(robust)


def by_chance(robust, x, parts=100_000, at_once=5000):
    """The yield of one design by plain random parts, judged by the nominal study with all that deviates free."""
    half = {path: tolerance.deviation for path, tolerance in robust.tolerances.items()}
    middle = dict.fromkeys(half | robust.free) | dict(zip(robust.free, x, strict=True))
    middle = {path: value_of(robust.start, path) if v is None else v for path, v in middle.items()}
    study = robust.nominal.replace(free={path: (v - abs(v) / 2, v + abs(v) / 2) for path, v in middle.items()})
    at, widths = np.array([*middle.values()]), np.array([half.get(path, 0.0) for path in middle])
    draw, times = np.random.default_rng(11), parts // at_once
    kept = [study.evaluate(at + widths * draw.uniform(-1, 1, (at_once, len(at)))).feasible for _ in range(times)]
    return np.mean(kept)


@pytest.mark.slow
@pytest.mark.parametrize("machine", [shaft, valve, door, whole_cam, linkage])
def test_every_design_of_a_robust_front_survives_being_made(machine):
    """As it says for sure, and by 4096 parts all, to 0.2 % of scatter."""
    nominal, front = found(machine)
    robust = front.study
    assert len(front) > 40
    assert front.yields.kept.all()
    assert front.yields.share.shape == (len(front),)
    assert (robust.recheck(front.x, 2**12).share > 0.988).all()
    assert (robust.recheck(nominal.x, 1024).share < 0.9).any()


@pytest.mark.slow
@pytest.mark.parametrize("machine", [shaft, valve, whole_cam, linkage])
def test_plain_parts_agree_that_designs_of_a_robust_front_survive(machine):
    """1e5 parts of the design with the least yield, 2e4 of one in the middle, to four times their scatter."""
    _, front = found(machine)
    for i, parts in ((front.yields.share.argmin(), 100_000), (len(front) // 2, 20_000)):
        share, (low, high) = by_chance(front.study, front.x[i], parts), front.yields.interval[i]
        scatter = 4 * (0.99 * 0.01 / parts) ** 0.5
        assert share > 0.99 - scatter
        assert low - scatter < share < high + scatter


@pytest.mark.parametrize(("machine", "most"), [(valve, 0.03), (door, 0.02)])
def test_the_price_of_survival(machine, most):
    nominal, front = found(machine)
    price = front.price(nominal)
    assert 0 < price.share < most
    worst = np.maximum(nominal.f.max(0), front.f.max(0))
    assert price.share == pytest.approx(1 - front.hypervolume(worst) / nominal.hypervolume(worst))
    assert_allclose(price.ends, front.f.min(0) - nominal.f.min(0))


def test_margins_that_are_fitted_lose_nothing(monkeypatch):
    """Against the search that looks at every design within its tolerances, at several times the cost of a fit."""
    _, front = found(valve)
    monkeypatch.setattr(fast_front, "Room", lambda study: Room(study, fits=False))
    every = quick_front(valve().sought)
    assert front.price(every).share == pytest.approx(0, abs=0.002)


def test_the_whole_cam_of_notebook_02():
    """7 quantities are free.  A margin of 1.5 deg on the pressure angle alone keeps 0.972 of the hypervolume."""
    nominal, front = found(whole_cam)
    assert len(front) == 60
    assert 0.972 < front.hypervolume() / nominal.hypervolume() < 0.995
    assert (front.study.recheck(nominal.x, 1024).share >= 0.99).mean() < 0.6


def test_a_front_that_is_near_saves_most_of_the_search():
    _, front = found(valve)
    warm = quick_front(front.study, start=front)
    assert len(warm) > 90
    assert (warm.yields.share >= 0.99).all()
    assert abs(warm.price(front).share) < 0.005


def test_other_objectives_and_the_worst_case():
    study = valve()
    for options in ({"objective": "95 %"}, {"worst_case": True}):
        robust = study.nominal.under(study.tolerances, **options)
        front = quick_front(robust, 20)
        assert len(front) > 10, options
        assert robust.recheck(front.x, 1024).kept.all() or "objective" in options
        assert (front.yields.share >= 0.99).all()
    mean = quick_front(study.nominal.under(study.tolerances, objective="mean"), 20)
    assert_allclose(mean.f, mean.study.evaluate(mean.x).f)


def test_a_small_limit_that_parts_miss_by_many_times_its_size():
    """A force of at least 1 N that moves by 15 N with each of two deviations, and 0.99 of the parts of a known one."""

    def force_of(a):
        return np.ravel(20 + 3e4 * (a.shaft.outer_diameter + a.shaft.inner_diameter - 0.23))

    force, widths = Measure("force", "N", force_of), dict.fromkeys(TUBE, 0.5 * mm)
    study = shaft().nominal.replace(at_most={}, at_least={force: 1.0})
    front = quick_front(study.under(widths), 20)
    assert len(front) > 10
    least = force_of(front.study.analysis(front.x)).min()
    assert least == pytest.approx(1 + 15 * (2 - 0.08**0.5), abs=0.6)  # a corner of the square: (2 - s)^2 / 8 = 0.01


def test_where_nothing_survives_it_is_said():
    study = valve().nominal
    wide = study.under({"base_radius": 5 * mm})
    front = quick_front(wide, 20)
    assert len(front) == 0
    assert "no design" in front.message
    assert (wide.tolerance_factor(study.x0)[0]) < 1


def test_the_steps_of_a_robust_search_are_those_of_any():
    robust = valve()
    steps = list(islice(search(robust, "fast_front", size=20), 26))
    assert [step.number for step in steps] == list(range(1, 27))
    assert robust.evaluate(steps[-1].front.x).feasible.mean() > 0.9
    generations = list(search(robust, "nsga2", population=20, generations=12))
    assert [step.number for step in generations] == list(range(1, 13))
    for step in (*steps, *generations):  # stopped anywhere, and before margins are fitted
        assert robust.evaluate(step.front.x).feasible.all(), step.number
    assert len(generations[-1].front) > 10


def test_a_robust_search_goes_on_from_its_checkpoint(tmp_path):
    robust, file = valve(), tmp_path / "search"
    whole = [step.front.x for step in nsga2_steps(robust, 12, 6, 3, tmp_path / "whole")]
    list(islice(nsga2_steps(robust, 12, 6, 3, file), 3))
    again = [step.front.x for step in nsga2_steps(robust, 12, 6, 3, file)]
    assert_array_equal(again[-1], whole[-1])
    with pytest.raises(ValueError, match="another study"):
        nsga2(robust.nominal, 12, 6, 3, file)


def test_a_front_without_a_volume_has_no_share_to_lose():
    """Two designs dominate nothing up to the worst of both, three with one within do."""
    study = shaft_study()
    study = study.replace(minimise=(*study.minimise, twist_utilisation))
    ends, within = np.array([[0.0, 1.0], [1.0, 0.0]]), np.array([[0.5, 0.5]])
    two, one, three = (Front(study, np.ones((len(f), 2)), f) for f in (ends, within, np.vstack([ends, within])))
    assert np.isnan(one.price(two).share)
    assert np.isnan(two.price(two).share)
    assert one.price(three).share == 0
    assert_allclose(one.price(two).ends, 0.5)


def test_a_price_needs_the_same_objectives():
    nominal, front = found(valve)
    with pytest.raises(ValueError, match="has other objectives"):
        front.price(found(door)[0])
    empty = Front(front.study, front.x[:0], front.f[:0])
    with pytest.raises(ValueError, match="there is no design on one of the fronts"):
        empty.price(nominal)
    assert nominal.yields is None


# ---------------------------------------------------------------- the fit


def test_a_fit_goes_through_a_quadratic_and_not_beyond_what_was_seen():
    draw, bounds = np.random.default_rng(3), np.array([[0.0, -1.0], [2.0, 1.0]])
    x = bounds[0] + draw.random((40, 2)) * (bounds[1] - bounds[0])
    margins = np.stack([0.1 + 0.02 * x[:, 0] * x[:, 1], 0.2 - 0.01 * x[:, 1] ** 2], axis=-1)
    fit = FittedMargins.to(bounds, x, -margins, margins)
    assert_allclose(fit.at(x), margins, atol=2e-4)
    assert (fit.at(np.array([[5.0, 5.0]])) <= margins.max(0)).all()
    assert_allclose(fit.at(x[:1]), margins[:1], atol=2e-4)


def test_a_fit_is_raised_by_what_breaks_a_limit_and_no_more():
    bounds, x = np.array([[0.0], [1.0]]), np.linspace(0, 1, 9)[:, None]
    flat = np.full((9, 1), 0.1)
    fit = FittedMargins.to(bounds, x, -flat, flat)
    far, close = fit.above(x, np.full((9, 1), -0.9), 2 * flat), fit.above(x, -1.05 * flat, 2 * flat)
    assert far.raised == 0
    assert close.raised == pytest.approx(0.095)
    assert_allclose(close.at(x), 0.195, atol=1e-9)
