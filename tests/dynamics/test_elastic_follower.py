"""Any cam with an elastic train: its forces are the train's, and studies, searches, tolerances and panels take it."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import (
    HighSpeedCam,
    OscillatingRollerCam,
    Study,
    Tolerances,
    TranslatingRollerCam,
    deg,
    minimise,
    mm,
    rpm,
    with_quantities,
)
from camkit.cam import (
    ArmLoad,
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
    contact_loss_margin,
    contact_loss_speed,
    contact_margin,
    damping_ratio,
    dwell_vibration,
    dynamic_factor,
    elastic_study,
    natural_frequency,
    period_ratio,
    tuned,
)
from camkit.machines import CamLever, ValveCam, high_speed_measures, high_speed_study
from camkit.machines.high_speed_measures import min_lead, overrun, peak_stress, peak_wear, undercut_margin
from camkit.motion import Cycloidal, ModifiedSine
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


def test_a_motion_that_would_pull_is_called_formal():
    fast, slow = (ElasticFollower(flat(speed=n * rpm), A).analyse(91) for n in (800, 600))
    assert fast.trouble.startswith("the follower leaves the cam, its least contact force would be -")
    assert "the follower leaves the cam" in fast.trouble
    assert slow.trouble == ""


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


def elastic_high_speed(tau, **fields):
    cam = HighSpeedCam(**fields)
    return ElasticFollower(cam, tuned(ElasticArm(), cam.analyse(), tau), samples=2880)


@pytest.mark.parametrize("tau", GIVEN["high_speed"]["ratios"])
def test_stress_and_wear_of_a_high_speed_cam(tau):
    """Of rise and return and of the turn; ``nan`` where contact is lost, of which the reference takes no notice."""
    analysis, expected = elastic_high_speed(tau).analyse(), VALUES["high_speed"][f"tau {tau}"]
    lost = expected["least_moment"] < 0
    for name, part in (("rise", analysis.rise), ("return", analysis.fall)):
        for kind in ("sigma", "wear"):
            curve = {"sigma": "stress_coefficient", "wear": "wear_coefficient"}[kind]
            found = part.highest(lambda at, curve=curve: np.nan_to_num(getattr(at, curve))).value
            assert found == pytest.approx(expected[f"{kind}_{name}"], rel=1e-6)
    moments = [getattr(analysis, way)(lambda at: at.resistance).value for way in ("lowest", "highest")]
    most = expected["most_moment"]
    assert_allclose(moments, [expected["least_moment"], most], rtol=0, atol=1e-6 * most)
    assert (min_force(analysis) < 0) == lost
    for measure, kind in ((peak_stress, "sigma"), (peak_wear, "wear")):
        assert np.isnan(measure(analysis)) == lost
        if not lost:
            assert measure(analysis) * mm**0.5 == pytest.approx(expected[f"{kind}_turn"], rel=1e-6)


def test_the_force_of_a_high_speed_cam_is_seen_in_the_dwells_too():
    """At ``tau`` 10 the train swings back in the dwell at the near end: the least force of the turn is there."""
    analysis = elastic_high_speed(10).analyse()
    least = analysis.lowest(lambda at: at.contact_force)
    assert least.cam_angle > 270 * deg
    assert high_speed_measures.min_force(analysis) == pytest.approx(least.value, rel=1e-6)
    assert analysis.fall.contact_force.min() > 1.1 * least.value
    for measure in (min_lead, overrun, undercut_margin):
        assert measure(analysis) == pytest.approx(measure(HighSpeedCam().analyse()), rel=1e-6)


def test_a_train_by_its_natural_periods():
    arm = OscillatingRollerCam(groove=False, load=ArmLoad(mass=3.0, speed=200 * rpm, spring_rate=8.0, preload=5.0))
    slide = flat(damping=15.0)
    for cam, train in (
        (arm, ElasticArm(cam_side_mass=1e-4)),
        (slide, ElasticTrain(ground_damping=4.0)),
        (CamLever(), ElasticArm()),
    ):
        tau, zeta = np.array([[2.5], [7.0]]), 0.08
        made = tuned(train, cam.analyse(), tau, zeta)
        analysis = ElasticFollower(cam, made).analyse()
        beta = analysis.cam.motion.starts[1]
        frequency = tau[:, 0] * 2 * np.pi * analysis.response.speed[..., 0] / beta
        assert_allclose(analysis.response.natural_frequency, frequency, rtol=1e-12)
        assert_allclose(damping_ratio(analysis), zeta, rtol=1e-12)
        assert_allclose(period_ratio(analysis), tau[:, 0], rtol=1e-12)
        assert tuned(train, cam.analyse(), 7, zeta).stiffness == pytest.approx(made.stiffness[1, 0], rel=1e-14)


def test_refusals_of_natural_periods():
    analysis = HighSpeedCam().analyse()
    with pytest.raises(ValueError, match="the period ratio is 0; it must be a finite number above 0 and at most 10000"):
        tuned(ElasticArm(), analysis, 0)
    with pytest.raises(ValueError, match=r"the return spring alone has 25\.4416 .* the period ratio must be larger"):
        tuned(ElasticArm(), analysis, 0.3)
    with pytest.raises(ValueError, match=r"that to the frame alone is 5 .* the damping ratio must be larger"):
        tuned(ElasticArm(ground_damping=5.0), analysis, 3, 0.01)
    with pytest.raises(ValueError, match="the cam is at rest"):
        tuned(ElasticArm(), OscillatingRollerCam(load=ArmLoad(speed=0.0)).analyse(), 3)
    many = tuned(ElasticArm(), analysis, np.array([[0.3], [3.0]]))
    assert np.isnan(many.stiffness[:, 0]).tolist() == [True, False]


def test_a_share_of_the_rated_speed_is_no_speed_in_rpm():
    analysis = elastic_high_speed(5).analyse()
    assert np.isnan([contact_loss(analysis), natural_frequency(analysis)]).all()
    faster = elastic_high_speed(5, speed=1 + contact_loss_margin(analysis), spring_factor=analysis.spring_factor)
    faster = faster.replace(train=elastic_high_speed(5).train).analyse()
    assert contact_margin(faster) == pytest.approx(0, abs=1e-4)


def test_the_study_of_a_high_speed_cam_with_a_train():
    study = elastic_study(high_speed_study(), elastic_high_speed(5).train)
    assert [*study.free] == ["cam.arm_length", "cam.roller_radius", "cam.max_radius"]
    start = peak_stress(study.start.analyse())
    found = minimise(study, "slsqp", starts=1, seed=1, designs=400)
    assert peak_stress(found.design.analyse()) < 0.75 * start  # 2.595 to 1.835
    assert min_force(found.design.analyse()) > 0
    laws = elastic_study(high_speed_study(free_laws=True), elastic_high_speed(5).train)
    assert laws.around(laws.start.replace(cam=HighSpeedCam())).start.cam.spring_factor == pytest.approx(
        2.54416, rel=1e-5
    )
    menus = high_speed_study().replace(free={"rise_law": (Cycloidal(), ModifiedSine())})
    menus = elastic_study(menus, elastic_high_speed(10).train)
    assert menus.design([1.0]).cam.rise_law == ModifiedSine()
    assert np.isfinite(menus.evaluate([[0.0], [1.0]]).f).all()


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


@pytest.mark.filterwarnings("error")
def test_a_cam_that_cannot_be_beside_others_is_nan_without_a_warning():
    speeds = {"load.speed": np.array([[800.0], [-1.0]]) * rpm}
    analysis = ElasticFollower(with_quantities(ValveCam(), speeds), ElasticTrain(5e6, 100.0, 10.0)).analyse()
    assert np.isnan(peak_force(analysis)).tolist() == [False, True]


def test_a_population_of_trains_behind_one_cam():
    stiff = np.array([[8e5], [4e5]])
    many = ElasticFollower(flat(), replace(A, stiffness=stiff)).analyse()
    alone = ElasticFollower(flat(), replace(A, stiffness=4e5)).analyse()
    assert peak_force(many)[1] == pytest.approx(peak_force(alone), rel=1e-9)


def test_refusals():
    with pytest.raises(ValueError, match="the cam is 3; it must be a design that can be analysed, such as a cam"):
        ElasticFollower(3)
    with pytest.raises(ValueError, match="the number of samples of a turn is 2"):
        ElasticFollower(flat(), A, 2)
    with pytest.raises(ValueError, match="the train is 3; it must be one of one mass"):
        ElasticFollower(flat(), 3)
    with pytest.raises(ValueError, match="the dynamic factor does not apply to"):
        dynamic_factor(flat().analyse())
    with pytest.raises(ValueError, match="has no damping"):
        contact_loss_speed(flat().analyse(), ElasticTrain(damping=0.0))
