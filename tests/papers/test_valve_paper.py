"""The valve-cam paper's notebook: its tables hold what they say, and the findings it tells are true."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import nsga2
from camkit.data import load
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import (
    PAPER_BOX,
    PAPER_MIN_RADIUS,
    corrected_valve_study,
    fullness,
    nose_deceleration,
    valve_front_study,
    valve_study,
)
from camkit.papers import valve_cam as paper
from camkit.search.minimise import minimise
from camkit.study.design_map import DesignMap
from camkit.units import deg, mm, rpm


def verdicts(table):
    return [row.verdict for row in table.rows]


def test_the_defaults_are_the_papers_data():
    data, cam = load("valve")["paper"]["data"], ValveCam()
    assert_allclose(cam.base_radius, data["base_radius"] * mm)
    assert_allclose(cam.max_lift, data["max_lift"] * mm)
    assert_allclose(cam.load.speed, data["speed"] * rpm)
    assert_allclose(cam.half_angle, data["half_angle"] * deg)
    assert_allclose(cam.seating_velocity, data["seating_velocity"])
    assert_allclose(PAPER_MIN_RADIUS, data["min_radius"] * mm)
    assert {name: tuple(data[name]) for name in ("n", "m")} == PAPER_BOX
    assert valve_study().minimise[0].weights == tuple(data["weights"])


def test_the_normalisers_hold_in_the_units_of_the_listing_only():
    assert verdicts(paper.normalisers()) == ["reproduced", "off by +0.196 %", "reproduced", "off by +219 %"]
    assert_allclose([row.computed for row in paper.normalisers().rows][1::2], (0.638392546, 1912.441), rtol=1e-6)


@pytest.mark.parametrize("table", [paper.listing, paper.corners, paper.lifts, paper.sharpest])
def test_the_formulas_hold(table):
    assert set(verdicts(table())) == {"reproduced"}


def test_the_optimum_with_the_sign_as_printed():
    found = minimise(valve_study(printed_sign=True)).design
    assert set(verdicts(paper.sign_as_printed(found))) == {"reproduced"}


def test_the_front_that_a_search_finds_holds_the_known_points():
    front = nsga2(valve_front_study(), population=60, generations=60, seed=2)
    for row in paper.front_points(front).rows:
        assert_allclose(row.computed, float(row.printed), atol=6e-4)


@pytest.mark.parametrize(("measure", "sign"), [(fullness, 1), (nose_deceleration, -1)])
def test_every_step_in_n_or_m_is_a_gain(measure, sign):
    values = DesignMap(valve_study().replace(minimise=(measure,)), n=41).objective
    assert (sign * np.diff(values, axis=0) > 0).all()
    assert (sign * np.diff(values, axis=1) > 0).all()


@pytest.mark.parametrize("method", ["slsqp", "de"])
@pytest.mark.parametrize("paper_units", [False, True])
def test_as_meant_every_weight_gives_the_corner(method, paper_units):
    for w in (0.02, 0.5, 0.98):
        study = valve_study(weights=(w, 1 - w), paper_units=paper_units)
        assert_allclose(minimise(study, method).x, (20, 20), atol=1e-3)


def test_as_printed_there_are_two_ends():
    study = valve_study(printed_sign=True)
    for w, best in ((0.4, 4.827593), (0.55, 4.827593), (0.56, 20.0), (0.98, 20.0)):
        assert_allclose(minimise(study.with_weights((w, 1 - w)), "de").x, (best, 20), atol=1e-3)
    stuck = minimise(study.with_weights((0.58, 0.42)))  # slopes lead to the end of the valley where they begin
    assert_allclose(stuck.x, (4.827593, 20), atol=1e-3)


def test_all_cams_on_the_nose_limit_decelerate_alike():
    edge = [minimise(valve_study(printed_sign=True).replace(free={"n": (3, 20)}, start=ValveCam(m=m))) for m in (3, 20)]
    assert_allclose([nose_deceleration(found.design.analyse()) for found in edge], 1048.152, rtol=1e-6)


def test_as_corrected_the_weight_moves_the_optimum():
    study = corrected_valve_study(ValveCam(base_radius=24.5 * mm))
    for w, best in ((0.5, (4.0305, 20)), (0.8, (5.807, 20)), (0.98, (20, 20))):
        for method in ("slsqp", "de"):
            assert_allclose(minimise(study.with_weights((w, 1 - w)), method).x, best, atol=2e-3)
        assert_allclose(DesignMap(study.with_weights((w, 1 - w)), n=21).best, best, atol=2e-3)
