"""Any cam with an elastic train: its forces are the train's, and studies, searches, tolerances and panels take it."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, Study, Tolerances, TranslatingRollerCam, deg, explore, minimise, mm, rpm
from camkit.cam import (
    ContactPair,
    contact_along,
    jump_speed,
    leaving_speed,
    max_pressure_angle,
    min_force,
    peak_force,
    peak_pressure,
    peak_torque,
)
from camkit.dynamics import (
    ElasticArm,
    ElasticFollower,
    ElasticTrain,
    contact_loss,
    contact_loss_speed,
    contact_margin,
    dwell_vibration,
    dynamic_factor,
)
from camkit.machines.high_speed_measures import peak_stress, peak_wear
from camkit.motion import Cycloidal
from camkit.quantities import measures_of, quantities_of
from train_cases import GIVEN, VALUES, A, flat, program

EXPECTED = VALUES["one_mass cycloidal"]
ROLLER = TranslatingRollerCam(program(Cycloidal()), load=flat().load, groove=False, contact=ContactPair())


def test_measures_of_the_cam_are_those_of_the_train():
    analysis = ElasticFollower(flat(), A, samples=2880).analyse()
    most = EXPECTED["most"]
    assert peak_force(analysis) == pytest.approx(most, rel=1e-6)
    assert min_force(analysis) == pytest.approx(EXPECTED["least"], abs=1e-6 * most)
    assert peak_torque(analysis) == pytest.approx(EXPECTED["torque_peak"], rel=1e-5)
    assert dynamic_factor(analysis) == pytest.approx(EXPECTED["dynamic_factor"], rel=1e-5)
    assert dwell_vibration(analysis) == pytest.approx(EXPECTED["dwell"][0] / 0.02, rel=1e-5)
    assert contact_margin(analysis) == pytest.approx(EXPECTED["least"] / 300, abs=1e-6)
    assert contact_loss(analysis) / rpm == pytest.approx(VALUES["jump cycloidal"]["elastic_rpm"], rel=1e-7)
    assert leaving_speed(analysis) / rpm == pytest.approx(VALUES["jump cycloidal"]["rigid_rpm"], rel=1e-7)


def test_geometry_is_that_of_the_cam():
    elastic, rigid = ElasticFollower(ROLLER, A).analyse(181), ROLLER.analyse(181)
    assert_allclose(elastic.profile, rigid.profile, rtol=1e-14)
    assert max_pressure_angle(elastic) == pytest.approx(max_pressure_angle(rigid), rel=1e-6)
    assert jump_speed(elastic) == pytest.approx(jump_speed(rigid), rel=1e-6)


def test_pressure_is_that_of_the_dynamic_force():
    elastic, pair = ElasticFollower(ROLLER, A).analyse(), ROLLER.contact
    pressure = contact_along(elastic, pair).pressure
    rigid = contact_along(ROLLER.analyse(), pair).pressure
    ratio = np.sqrt(elastic.contact_force / ROLLER.analyse().contact_force)
    assert_allclose(pressure, rigid * ratio, rtol=1e-9)
    assert peak_pressure(elastic) > 1.02 * peak_pressure(ROLLER.analyse())


@pytest.mark.parametrize("tau", GIVEN["high_speed"]["ratios"])
def test_stress_and_wear_of_a_high_speed_cam(tau):
    """Of rise and return; ``nan`` where contact is lost, of which the reference takes no notice."""
    cam, expected = HighSpeedCam(), VALUES["high_speed"][f"tau {tau}"]
    frequency, inertia = tau * 2 * np.pi / (90 * deg), 10.0
    stiffness = inertia * frequency**2 - cam.analyse().closing_rate[0]
    analysis = ElasticFollower(cam, ElasticArm(stiffness, 0.1 * inertia * frequency), samples=2880).analyse()
    lost = expected["least_moment"] < 0
    for name, part in (("rise", analysis.rise), ("return", analysis.fall)):
        for kind, curve in (("sigma", part.stress_coefficient), ("wear", part.wear_coefficient)):
            assert np.nanmax(curve) == pytest.approx(expected[f"{kind}_{name}"], rel=1e-4)
    assert np.isnan(peak_stress(analysis)) == lost
    if not lost:
        most = max(expected["wear_rise"], expected["wear_return"])
        assert peak_wear(analysis) * mm**0.5 == pytest.approx(most, rel=1e-5)


def test_forces_between_the_samples_are_those_of_more_samples():
    few, many = (ElasticFollower(flat(), A, samples=n).analyse(1001).contact_force for n in (720, 11520))
    assert_allclose(few, many, rtol=0, atol=2e-6 * many.max())


def test_all_quantities_and_measures_have_their_place():
    machine = ElasticFollower(ROLLER, A)
    paths = quantities_of(machine)
    assert {"cam.motion.rise.angle", "cam.load.preload", "train.stiffness", "train.cam_side_mass"} <= set(paths)
    assert {*ElasticFollower.measures, *measures_of(ROLLER)} == set(measures_of(machine))


STUDY = Study(
    ElasticFollower(ROLLER, A),
    ["cam.load.preload", "train.stiffness", "cam.roller_radius"],
    (peak_pressure,),
    at_least={contact_margin: 0.2},
    at_most={max_pressure_angle: 30 * deg},
    angles=181,
)


def test_a_study_judges_many_as_it_judges_each():
    x = STUDY.x0 * np.linspace(0.95, 1.05, 4)[:, None]
    alone = np.concatenate([STUDY.evaluate(each[None]).f for each in x])
    assert_allclose(STUDY.evaluate(x).f, alone, rtol=1e-9)


@pytest.mark.slow
def test_a_search_and_tolerances():
    found = minimise(STUDY, "slsqp", starts=1, seed=1)
    at = found.design.analyse()
    assert peak_pressure(at) < 0.98 * peak_pressure(STUDY.start.analyse())
    assert contact_margin(at) > 0.2 - 1e-6
    spread = Tolerances(STUDY, {"train.stiffness": 5e4, "cam.load.preload": 20.0}, parts=64)
    assert spread.share == 1


def test_a_panel_opens_with_the_curves_of_the_cam():
    app = explore(ElasticFollower(ROLLER, A), free=["train.stiffness", "cam.load.preload"])
    assert [view.__name__ for view in app.views][:4] == ["mechanism", "motion", "pressure_angle", "contact_force"]
    assert app.analysis.contact_force.max() == pytest.approx(614, rel=0.1)


def test_a_population_of_trains_behind_one_cam():
    stiff = np.array([[8e5], [4e5]])
    many = ElasticFollower(flat(), replace(A, stiffness=stiff)).analyse()
    alone = ElasticFollower(flat(), replace(A, stiffness=4e5)).analyse()
    assert peak_force(many)[1] == pytest.approx(peak_force(alone), rel=1e-9)


def test_refusals():
    with pytest.raises(ValueError, match="the cam is 3; it must be a design of a cam"):
        ElasticFollower(3)
    with pytest.raises(ValueError, match="the number of samples of a turn is 2"):
        ElasticFollower(flat(), A, 2)
    with pytest.raises(ValueError, match="the train is 3; it must be one of one mass"):
        ElasticFollower(flat(), 3)
    with pytest.raises(ValueError, match="the dynamic factor does not apply to"):
        dynamic_factor(flat().analyse())
    with pytest.raises(ValueError, match="has no damping"):
        contact_loss_speed(flat().analyse(), ElasticTrain(damping=0.0))
