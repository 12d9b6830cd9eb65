"""A rigid follower whose load grows with its velocity: forces, preload, power, and the speed at which it leaves."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import Dwell, MotionProgram, Poly345, Return, Rise, SlideLoad, TranslatingFlatCam, deg, mm
from camkit.cam import jump_speed, min_force, peak_force, preload_needed, torque_balance
from camkit.dynamics import ElasticTrain
from camkit.machines.valve_train import ValveLoad
from camkit.motion import Cycloidal

MOTION = MotionProgram(
    (Rise(80 * deg, 12 * mm, Poly345()), Dwell(40 * deg), Return(160 * deg, 12 * mm, Poly345()), Dwell(80 * deg))
)
CAM = TranslatingFlatCam(MOTION, 100 * mm, load=SlideLoad(mass=6, speed=12, spring_rate=120, preload=8, damping=3))


def test_a_users_case():
    analysis = CAM.analyse()
    assert min_force(analysis) == pytest.approx(-21.103119, abs=1e-6)
    assert peak_force(analysis) == pytest.approx(39.062702, abs=1e-6)
    assert preload_needed(analysis, 12.0) == pytest.approx(29.103119, abs=1e-6)
    power = 12 * torque_balance(analysis.cam_angle, analysis.cam_torque).mean
    assert power == pytest.approx(0.0151947, abs=1e-7)
    phi = np.linspace(0, 2 * np.pi, 200001)
    assert power == pytest.approx(3 * 12**2 * np.trapezoid(MOTION(phi).v ** 2, phi) / (2 * np.pi), rel=1e-5)


def test_a_published_size():
    """3-4-5, 10 mm, rise 90, dwell 45, return 180, dwell 45 deg, 10 rad/s, 7.5 kg, 100 N/m, 10 N, 2.74 N s/m."""
    law = Poly345()
    motion = MotionProgram((Rise(90 * deg, 0.01, law), Dwell(45 * deg), Return(180 * deg, 0.01, law), Dwell(45 * deg)))
    load = SlideLoad(mass=7.5, speed=10, spring_rate=100, preload=10, damping=2.74)
    analysis = TranslatingFlatCam(motion, 0.1, load=load).analyse()
    expected = {"most": 27.764407190812584, "least": -6.47099368558357, "torque_most": 0.22695766011661128}
    assert peak_force(analysis) == pytest.approx(expected["most"], rel=1e-9)
    assert min_force(analysis) == pytest.approx(expected["least"], rel=1e-9)
    assert analysis.highest(lambda at: at.cam_torque).value == pytest.approx(expected["torque_most"], rel=1e-7)
    assert preload_needed(analysis, 10.0) == pytest.approx(16.47099368558357, rel=1e-9)


@pytest.mark.parametrize("damping", [0.0, 1.0, 30.0, 200.0, 2000.0])
def test_it_leaves_at_the_lowest_speed_at_which_the_force_is_0(damping):
    cam = CAM.replace(load=CAM.load.replace(damping=damping, preload=80.0))
    speed = jump_speed(cam.analyse())

    def least(turns):
        return min_force(cam.replace(load=cam.load.replace(speed=turns)).analyse())

    assert least(speed) == pytest.approx(0, abs=1e-6)
    slower = np.linspace(0.02, 0.999, 300)[:, None] * speed
    assert (least(slower) > 0).all()


def test_the_preload_that_is_needed_keeps_it_on():
    kept = CAM.replace(load=CAM.load.replace(preload=preload_needed(CAM.analyse(), 12.0)))
    assert min_force(kept.analyse()) == pytest.approx(0, abs=1e-8)
    assert jump_speed(kept.analyse()) == pytest.approx(12, rel=1e-8)


def test_a_population_is_each_of_its_members():
    damping = np.array([[0.0], [3.0], [50.0]])
    many = CAM.replace(load=CAM.load.replace(damping=damping)).analyse()
    for i, each in enumerate(damping[:, 0]):
        one = CAM.replace(load=CAM.load.replace(damping=float(each))).analyse()
        for measure in (min_force, peak_force, jump_speed):
            assert measure(many)[i] == pytest.approx(measure(one), rel=1e-12)


def test_a_train_behind_the_cam_has_that_damping_to_the_frame():
    law = Cycloidal()
    motion = MotionProgram((Rise(120 * deg, 0.02, law), Dwell(60 * deg), Return(120 * deg, 0.02, law), Dwell(60 * deg)))
    load = SlideLoad(mass=2.0, speed=62.8, spring_rate=5e3, preload=300.0)
    plain, damped = (TranslatingFlatCam(motion, 0.04, load=load.replace(damping=d)).analyse() for d in (0.0, 20.0))
    by_train = ElasticTrain(8e5, 100.0, 20.0).follow(plain)
    by_load = ElasticTrain(8e5, 100.0).follow(damped)
    assert_allclose(by_load.contact_force, by_train.contact_force, rtol=1e-12)
    assert by_load.damping_ratio == pytest.approx(by_train.damping_ratio, rel=1e-14)
    rigid = plain.resistance + 20.0 * 62.8 * plain.velocity
    assert_allclose(damped.resistance, rigid, rtol=1e-12)


def test_refusals():
    with pytest.raises(ValueError, match=r"the damping \(.*\) is -1 N s/m"):
        SlideLoad(damping=-1.0)
    with pytest.raises(ValueError, match="that of a valve must be 0: it would not be the same on both flanks"):
        ValveLoad(damping=1.0)
