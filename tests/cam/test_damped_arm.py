"""A rocking arm whose load grows with its velocity: torques, preload, power, and the speed at which it leaves."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import ArmLoad, Dwell, MotionProgram, OscillatingFlatCam, OscillatingRollerCam, Poly345, Return, Rise, deg
from camkit.cam import ConjugatePair, jump_speed, min_force, peak_force, preload_needed, torque_balance
from camkit.dynamics import ElasticTrain

MOTION = MotionProgram((Rise(90 * deg, 20 * deg, Poly345()), Dwell(60 * deg), Return(110 * deg, 20 * deg, Poly345())))
MOTION = MotionProgram((*MOTION.segments, Dwell(100 * deg)))
LOAD = ArmLoad(mass=1.5, speed=30, spring_rate=8, preload=6, damping=0.4)
CAMS = (OscillatingRollerCam(MOTION, load=LOAD), OscillatingFlatCam(MOTION, load=LOAD))
every_cam = pytest.mark.parametrize("cam", CAMS, ids=lambda cam: type(cam).__name__)


@every_cam
def test_damping_takes_its_power_and_nothing_else_changes(cam):
    damped, plain = cam.analyse(), cam.replace(load=LOAD.replace(damping=0.0)).analyse()
    assert_allclose(damped.resistance - plain.resistance, 0.4 * 30 * MOTION(damped.cam_angle).v, atol=1e-12)
    assert_allclose(damped.static_resistance, plain.static_resistance)
    phi = np.linspace(0, 2 * np.pi, 100001)
    lost = 0.4 * 30 * np.trapezoid(MOTION(phi).v ** 2, phi) / (2 * np.pi)
    torques = (torque_balance(a.cam_angle, a.cam_torque).mean for a in (damped, plain))
    assert next(torques) - next(torques) == pytest.approx(lost, rel=1e-5)


@every_cam
@pytest.mark.parametrize("damping", [0.0, 0.2, 5.0, 100.0])
def test_it_leaves_at_the_lowest_speed_at_which_the_force_is_0(cam, damping):
    cam = cam.replace(load=LOAD.replace(damping=damping))
    speed = jump_speed(cam.analyse())

    def least(turns):
        return min_force(cam.replace(load=cam.load.replace(speed=turns)).analyse())

    assert least(speed) == pytest.approx(0, abs=1e-6)
    assert (least(np.linspace(0.02, 0.999, 100)[:, None] * speed) > 0).all()
    kept = cam.replace(load=cam.load.replace(preload=preload_needed(cam.analyse(), 40.0), speed=40.0))
    assert min_force(kept.analyse()) == pytest.approx(0, abs=1e-7)


@every_cam
def test_a_train_behind_the_cam_has_that_damping_to_the_frame(cam):
    load = LOAD.replace(gravity=9.81)
    plain, damped = (cam.replace(load=load.replace(damping=d)).analyse() for d in (0.0, 0.3))
    by_train = ElasticTrain(4e3, 0.2, 0.3).follow(plain)
    by_load = ElasticTrain(4e3, 0.2).follow(damped)
    assert_allclose(by_load.contact_force, by_train.contact_force, rtol=1e-10)


def test_the_second_arm_of_a_pair_feels_it_the_other_way_round():
    pair = ConjugatePair(OscillatingRollerCam(MOTION, load=LOAD.replace(spring_rate=0.0, preload=0.0))).analyse()
    assert_allclose(pair.second.resistance, -pair.first.resistance, atol=1e-9)


def test_a_population_is_each_of_its_members():
    damping = np.array([[0.0], [0.3], [5.0]])
    many = CAMS[0].replace(load=LOAD.replace(damping=damping)).analyse()
    for i, each in enumerate(damping[:, 0]):
        one = CAMS[0].replace(load=LOAD.replace(damping=float(each))).analyse()
        for measure in (min_force, peak_force, jump_speed):
            assert measure(many)[i] == pytest.approx(measure(one), rel=1e-12)
    with pytest.raises(ValueError, match=r"the damping \(.*\) is -1 N m s/rad"):
        ArmLoad(damping=-1.0)
