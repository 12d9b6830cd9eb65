"""What turns a cam: reference values, a shaft with a flywheel integrated in time, the energy of a motor, its ratio."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from camkit import HighSpeedCam, OscillatingRollerCam, Study, TranslatingRollerCam, deg, explore, rpm
from camkit.cam import (
    ArmLoad,
    ConjugatePair,
    DrivenCam,
    Motor,
    OscillatingBarrelCam,
    Servo,
    best_ratio,
    flywheel,
    mean_motor_power,
    motor_peak,
    motor_power,
    motor_rms,
    peak_torque,
    rms_torque,
    speed_fluctuation,
    surplus_work,
    torque_balance,
    torque_sweep,
)
from camkit.dynamics import ElasticFollower
from camkit.files import Session, from_json, to_json
from camkit.linkage import Driveline
from camkit.machines import CamLever
from camkit.motion import Cycloidal, HalfHarmonicStart, ModifiedTrapezoid
from camkit.quantities import measures_of, quantities_of
from camkit.views import surplus_over_turn, torque_and_work, torque_over_speed
from train_cases import LAWS, VALUES, A, flat, program

EXPECTED = VALUES["drive"]
ELASTIC = ElasticFollower(flat(), A)
DRIVEN = DrivenCam(ELASTIC, Motor(5, 0.9))
ARM = OscillatingRollerCam(program(Cycloidal(), 20 * deg), load=ArmLoad(mass=1.5, speed=300 * rpm))


def test_reference_values():
    analysis, most = DRIVEN.analyse(), EXPECTED["peak"]
    turning = analysis.turning
    ends = (getattr(analysis, find)(lambda at: at.cam_torque).value for find in ("highest", "lowest"))
    found = dict(zip(("peak", "least"), ends, strict=True))
    found |= {"mean": turning.mean, "rms": rms_torque(analysis), "swing": surplus_work(analysis)}
    found |= {
        "flywheel": flywheel(0.02)(analysis),
        "motor_rms": motor_rms(analysis),
        "motor_peak": motor_peak(analysis),
    }
    found["motor_mean"] = mean_motor_power(analysis) / (5 * 600 * rpm)
    assert found.keys() == EXPECTED.keys()
    for name, value in found.items():
        assert value == pytest.approx(EXPECTED[name], rel=1e-6, abs=1e-7 * most)


@settings(max_examples=25, deadline=None)
@given(
    law=st.sampled_from([*LAWS.values(), ModifiedTrapezoid()]),
    speed=st.floats(10, 1500),
    rate=st.integers(0, 200),
    work=st.floats(-300, 300),
)
def test_a_turn_is_what_many_small_steps_of_it_give(law, speed, rate, work):
    cam = flat(law, speed=speed * rpm, spring_rate=rate * 100.0, cam_angle_table=((0.5, 0.0), (1.0, work), (2.5, 0.0)))
    analysis = cam.analyse(40001)
    turning, phi, M = analysis.turning, analysis.cam_angle, analysis.cam_torque
    balance, most = torque_balance(phi, M), abs(M).max()
    assert turning.mean == pytest.approx(balance.mean, abs=2e-6 * most)
    assert turning.rms == pytest.approx(np.sqrt(np.trapezoid(M**2, phi) / np.ptp(phi)), rel=2e-6)
    assert turning.swing == pytest.approx(balance.swing, rel=2e-5)


@pytest.mark.parametrize("fluctuation", [0.005, 0.02, 0.3])
@pytest.mark.parametrize("cam", [ELASTIC, ARM], ids=["elastic", "arm"])
def test_a_shaft_with_that_flywheel_turns_as_evenly(cam, fluctuation):
    """``I omega' = M_mean - M(phi)``, integrated in time by Runge and Kutta's method from the start of a turn."""
    analysis = cam.analyse(2881)
    phi, M, mean = analysis.cam_angle, analysis.cam_torque, analysis.turning.mean
    omega, inertia = float(np.ravel(analysis.speed)[0]), flywheel(fluctuation)(analysis)

    def rate(state):
        angle, speed = state
        return np.array([speed, (mean - np.interp(angle % (2 * np.pi), phi, M)) / inertia])

    def turn(speed):
        h, states = 2 * np.pi / omega / 1500, [np.array([0.0, speed])]
        while states[-1][0] < 2 * np.pi:
            y = states[-1]
            k1 = rate(y)
            k2 = rate(y + h / 2 * k1)
            k3 = rate(y + h / 2 * k2)
            states.append(y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3)))
        speeds = np.array(states)[:, 1]
        return speeds.max(), speeds.min()

    start = omega
    for _ in range(4):  # the speed at the start of the turn with which the middle of it is omega
        start += omega - sum(turn(start)) / 2
    high, low = turn(start)
    assert (high - low) / omega == pytest.approx(fluctuation, rel=1e-3)


def test_rotor_and_flywheel_hold_the_speed_together():
    motor = Motor(ratio=5, inertia=1e-3, flywheel=0.0904047 - 5**2 * 1e-3)
    assert speed_fluctuation(DrivenCam(ELASTIC, motor).analyse()) == pytest.approx(0.02, rel=1e-5)
    assert speed_fluctuation(DrivenCam(ELASTIC, Motor(inertia=0.0)).analyse()) == np.inf


@pytest.mark.parametrize("motor", [Motor(7, 0.8), Servo(300, 0.7)], ids=["motor", "servo"])
@pytest.mark.parametrize("cam", [ELASTIC, ARM, ConjugatePair(), CamLever()], ids=lambda cam: type(cam).__name__)
def test_the_gear_takes_what_motor_and_load_do_not_have_in_common(motor, cam):
    """A motor's work of a turn is that of the load and what the gear loses, which it does whoever drives."""
    analysis = DrivenCam(cam, motor).analyse(20001)
    first = next(iter(analysis.curves.values()))
    load = first.resistance * first.velocity * first.speed
    rotor = motor.inertia * motor.ratio**2 * first.acceleration * first.velocity * first.speed**3
    lost = analysis.motor_power - load - isinstance(motor, Servo) * rotor
    share = np.where(load >= 0, 1 / motor.efficiency - 1, 1 - motor.efficiency)
    assert (lost >= -1e-9 * abs(load).max()).all()
    assert_allclose(lost, share * abs(load), atol=1e-9 * abs(load).max())
    mean = np.trapezoid(load + lost, analysis.cam_angle) / np.ptp(analysis.cam_angle)
    assert mean_motor_power(analysis) == pytest.approx(mean, abs=2e-6 * abs(load).max())
    assert motor_power(analysis) == pytest.approx(abs(analysis.motor_power).max(), rel=1e-5)
    assert motor_peak(analysis) == pytest.approx(abs(analysis.motor_torque).max(), rel=1e-5)


@pytest.mark.parametrize("efficiency", [1.0, 0.7])
def test_no_other_ratio_of_a_servo_has_less_torque(efficiency):
    machine = DrivenCam(ARM.replace(load=ARM.load.replace(torque=0.3, spring_rate=0.5)), Servo(20, efficiency))
    found = minimize_scalar(
        lambda i: motor_rms(machine.replace(motor=replace(machine.motor, ratio=i)).analyse(61)),
        bounds=(2, 200), method="bounded", options={"xatol": 1e-7},
    )  # fmt: skip
    assert best_ratio(machine.analyse()) == pytest.approx(found.x, rel=1e-5)


def test_the_ratio_for_an_inertia_alone():
    load = ArmLoad(mass=1.5, speed=300 * rpm)
    machine = DrivenCam(ARM.replace(load=load), Servo(20, 1.0, 2e-5))
    assert best_ratio(machine.analyse()) == pytest.approx(np.sqrt(load.inertia(ARM.arm_length) / 2e-5), rel=1e-9)
    psi = machine.analyse().resolved.acceleration * load.speed**2
    torque = (2e-5 * 20 + load.inertia(ARM.arm_length) / 20) * psi
    assert_allclose(machine.analyse().resolved.motor_torque, torque, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    "cam", [ELASTIC, ARM, DRIVEN, TranslatingRollerCam(), OscillatingBarrelCam(), ConjugatePair()],
    ids=lambda cam: type(cam).__name__,
)  # fmt: skip
def test_a_sweep_is_the_same_cam_at_each_speed(cam):
    path = next(p for p in quantities_of(cam) if p.endswith("load.speed"))
    sweep = torque_sweep(cam.analyse(), [40.0, 90.0])
    for i, speed in enumerate(sweep.speed):
        at = Study(cam, [path], (rms_torque,)).design([speed]).analyse()
        assert sweep.peak[i] == pytest.approx(peak_torque(at), rel=1e-5)
        assert (sweep.rms[i], sweep.swing[i]) == pytest.approx((rms_torque(at), surplus_work(at)), rel=1e-6)


def test_a_population_and_one_that_cannot_be_built():
    cam = TranslatingRollerCam(groove=False)
    cams = cam.replace(offset=np.array([[0.0], [1.0]]))
    analysis = DrivenCam(cams, Motor(np.array([[5.0], [7.0]]))).analyse()
    alone = DrivenCam(cam.replace(offset=0.0), Motor(5)).analyse()
    for measure in (rms_torque, surplus_work, flywheel(0.1), motor_rms, motor_peak, motor_power, speed_fluctuation):
        value = measure(analysis)
        assert value[0] == pytest.approx(measure(alone), rel=1e-9)
        assert np.isnan(value[1])


def test_a_speed_that_is_a_share_of_a_rated_one_gives_torque_but_neither_power_nor_flywheel():
    analysis = DrivenCam(HighSpeedCam(), Motor(5, 0.9)).analyse()
    assert motor_peak(analysis) == pytest.approx(peak_torque(analysis) / 4.5, rel=1e-6)
    assert np.isnan([motor_power(analysis), mean_motor_power(analysis), flywheel(0.02)(analysis)]).all()
    assert torque_over_speed(analysis).axes.xlabel == "speed of the cam  [% of rated]"


def test_a_motor_leaves_a_cam_ready_for_what_is_free():
    assert DrivenCam(HighSpeedCam()).ready_for(["cam.spring_factor"]).cam == HighSpeedCam().ready_for(["spring_factor"])


def test_a_struck_follower_takes_torque_without_end():
    analysis = DrivenCam(flat(HalfHarmonicStart()), Motor()).analyse()
    assert {m(analysis) for m in (rms_torque, surplus_work, motor_rms, motor_peak, motor_power)} == {np.inf}


def test_a_study_its_files_and_its_page():
    limits = {flywheel(0.05): 0.04, motor_peak: 2.5}
    study = Study(DRIVEN, ["motor.ratio", "cam.cam.load.preload"], (motor_rms,), at_most=limits, angles=61)
    again = from_json(to_json(Session(study, study.start))).study
    x = study.x0 * np.array([[1.0], [1.1]])
    assert_allclose(again.evaluate(x).f, study.evaluate(x).f)
    assert_allclose(again.evaluate(x).g, study.evaluate(x).g)
    servo = DRIVEN.replace(motor=Servo())
    assert from_json(to_json(servo)) == servo
    assert {motor_rms, speed_fluctuation, rms_torque} <= {*measures_of(DRIVEN)}
    assert best_ratio in measures_of(servo)
    shown = [view.__name__ for view in explore(DRIVEN).views]
    assert shown[1:4] == ["torque_and_work", "motor_torque", "torque_over_speed"]


def test_views():
    analysis = ELASTIC.analyse()
    picture, turning = torque_and_work(analysis), analysis.turning
    assert_allclose(picture["mean"].y, turning.mean)
    assert f"{turning.swing:.4g} J" in picture["numbers"].words
    area = np.trapezoid(picture["surplus"].high - picture["surplus"].low, picture["surplus"].x * deg)
    back = np.trapezoid(picture["given back"].high - picture["given back"].low, picture["given back"].x * deg)
    assert area == pytest.approx(back, rel=1e-3)
    ends = [surplus_over_turn(analysis)[f"end {i}"].y[0] for i in (0, 1)]
    assert np.ptp(ends) == pytest.approx(turning.swing, rel=1e-4)
    swept = torque_over_speed(analysis)
    assert np.interp(600, swept["rms"].x, swept["rms"].y) == pytest.approx(turning.rms, rel=1e-4)


def test_drive_refusals():
    with pytest.raises(ValueError, match="the cam is 3; it must be a design that can be analysed, such as a cam"):
        DrivenCam(3)
    with pytest.raises(ValueError, match="the cam has all that a driven cam has already"):
        DrivenCam(ElasticFollower(DRIVEN.replace(cam=flat())))
    with pytest.raises(ValueError, match="the cam is a Driveline; it must be one that a torque turns"):
        DrivenCam(Driveline()).analyse()
    with pytest.raises(ValueError, match=r"efficiency .*is 120 %; it must be .* at most 100 %"):
        Motor(efficiency=1.2)
    with pytest.raises(ValueError, match=r"ratio .*is 0"):
        Servo(ratio=0)
    with pytest.raises(ValueError, match="the speed fluctuation is 0; it must be a number above 0 and at most 2"):
        flywheel(0)
    for speeds in ([], [0.0], [[1.0]], [np.nan], "fast"):
        with pytest.raises(ValueError, match="the speeds of the cam"):
            torque_sweep(ARM.analyse(), speeds)
    with pytest.raises(ValueError, match=r"does not apply to .*it must be moves the follower"):
        Study(DRIVEN, ["motor.ratio"], (best_ratio,))
    with pytest.raises(ValueError, match="the cam is at rest"):
        torque_over_speed(ARM.replace(load=ARM.load.replace(speed=0.0)).analyse())
