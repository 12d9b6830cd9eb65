"""Steady motion of elastic trains: reference values of two other methods, time integration, limits, power, refusals."""

import re
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, OscillatingRollerCam, deg, mm, rpm
from camkit.cam import ArmLoad, SlideLoad, TranslatingFlatCam, TranslatingRollerCam
from camkit.dynamics import ElasticArm, ElasticTrain, HelicalSpring, TrainChain
from camkit.machines.high_speed_measures import peak_stress, peak_wear
from camkit.motion import Cycloidal, Kinematics, Law, MotionProgram, Peaks, Return, Rise, SimpleHarmonic
from train_cases import GIVEN, LAWS, VALUES, A, differs, flat, integrated, program, valve

SAME = 1e-6
"""Of a peak."""


def agrees(response, expected, position="x_at"):
    most = expected["most"]
    assert differs(response, response.contact_force, expected["N_at"]) < SAME * most
    if position in expected:
        assert differs(response, response.position, expected[position]) < SAME * 0.02
    assert_allclose([response.max_force, response.least_force], [most, expected["least"]], rtol=0, atol=SAME * most)


@pytest.mark.parametrize("law", LAWS)
def test_one_mass(law):
    response, expected = A.follow(flat(law).analyse()), VALUES[f"one_mass {law}"]
    agrees(response, expected)
    assert response.natural_frequency == pytest.approx(expected["natural_frequency"], rel=1e-12)
    assert response.damping_ratio == pytest.approx(expected["damping_ratio"], rel=1e-12)
    assert response.dynamic_factor == pytest.approx(expected["dynamic_factor"], rel=SAME)
    assert response.max_acceleration == pytest.approx(expected["acceleration_up"], rel=SAME)
    assert_allclose(response.dwell_vibration, expected["dwell"], rtol=SAME)
    assert response.contact_margin == pytest.approx(expected["least"] / 300, abs=SAME)
    rough = 1e-4 if law == "harmonic" else SAME  # a jump of the acceleration
    few = A.follow(flat(law).analyse(), samples=720)
    assert few.max_force == pytest.approx(expected["most"], rel=2 * rough)
    assert abs(response.cam_torque).max() == pytest.approx(expected["torque_peak"], rel=1e-4)
    assert response.cam_torque.mean() == pytest.approx(expected["torque_mean"], rel=SAME)


def test_a_part_at_the_cam_and_a_table_of_the_machine():
    table = tuple((angle * deg, force) for angle, force in GIVEN["loaded"]["table"])
    train, expected = replace(A, cam_side_mass=GIVEN["loaded"]["m0"]), VALUES["loaded"]
    response = train.follow(flat("modified_sine", cam_angle_table=table).analyse())
    agrees(response, expected)
    assert response.dynamic_factor == pytest.approx(expected["dynamic_factor"], rel=SAME)
    assert_allclose(response.dwell_vibration, expected["dwell"], rtol=1e-5)


def test_a_valve_train():
    response, expected = ElasticTrain(5e6, 100.0, 10.0).follow(valve().analyse()), VALUES["valve"]
    agrees(response, expected)
    assert_allclose(response.dwell_vibration, expected["dwell"], rtol=1e-5)
    lifts = VALUES["valve lift harmonics"]
    assert_allclose(response.harmonics[[int(n) for n in lifts]], list(lifts.values()), rtol=0, atol=1e-9)


def test_an_arm():
    given, expected = GIVEN["arm"], VALUES["arm"]
    load = ArmLoad(mass=3 * given["J"] / given["l"] ** 2, speed=400 * rpm, spring_rate=8.0, preload=5.0)
    motion = program(Cycloidal(), 30 * deg)
    cam = OscillatingRollerCam(motion, 80 * mm, 60 * mm, start_angle=25 * deg, groove=False, load=load)
    response = ElasticArm(1500.0, 0.3, 0.02).follow(cam.analyse())
    agrees(response, expected)
    assert differs(response, response.resistance, expected["moment_at"]) < SAME * 15
    assert_allclose(response.stiffness_spread, expected["stiffness_spread"], rtol=1e-5)
    assert response.dynamic_factor == pytest.approx(expected["dynamic_factor"], rel=SAME)


@pytest.mark.parametrize("tau", GIVEN["high_speed"]["ratios"])
def test_the_arm_of_a_high_speed_cam(tau):
    analysis, expected = HighSpeedCam().analyse(), VALUES["high_speed"][f"tau {tau}"]
    frequency, inertia = tau * 2 * np.pi / (90 * deg), 10.0
    stiffness = inertia * frequency**2 - analysis.closing_rate[0]
    train = ElasticArm(stiffness, 2 * GIVEN["high_speed"]["zeta"] * inertia * frequency)
    response = train.follow(analysis)
    assert response.natural_frequency == pytest.approx(frequency, rel=1e-12)
    assert response.damping_ratio == pytest.approx(0.05, rel=1e-12)
    found = [response.resistance.min(), response.resistance.max()]
    assert_allclose(found, [expected["least_moment"], expected["most_moment"]], rtol=0, atol=1e-4)
    assert analysis.closing_rate[0] / inertia == pytest.approx(VALUES["high_speed"]["K"], rel=1e-6)
    assert {peak_stress, peak_wear} <= set(HighSpeedCam.measures)


def test_a_chain():
    given, expected = GIVEN["two"], VALUES["two_mass"]
    chain = TrainChain((given["k1"], given["k2"]), (given["c1"], given["c2"]), (given["m1"],), 20.0)
    response = chain.follow(flat("p345", 500 * rpm).analyse())
    agrees(response, expected, "x2_at")
    assert_allclose(response.natural_frequencies, expected["natural_frequencies"], rtol=1e-12)


def test_a_chain_of_one_is_one_mass():
    analysis = flat("p345").analyse()
    one, chain = A.follow(analysis), TrainChain((8e5,), (100.0,), (), 20.0).follow(analysis)
    assert_allclose(chain.contact_force, one.contact_force, rtol=1e-13)
    assert_allclose(chain.natural_frequencies, [one.natural_frequency], rtol=1e-14)


def test_a_chain_with_a_stiff_spring_is_one_mass():
    analysis = flat("p345").analyse()
    chain = TrainChain((8e5, 1e10), (100.0, 100.0), (0.5,), 20.0).follow(analysis)
    assert_allclose(chain.contact_force, A.follow(analysis).contact_force, rtol=0, atol=0.05)


def test_surge():
    spring, expected = HelicalSpring(), VALUES["surge"]
    analysis = flat(spring_rate=spring.rate).analyse()
    response = replace(A, spring=spring).follow(analysis)
    assert_allclose([response.max_force, response.least_force], [expected["N_most"], expected["N_least"]], rtol=1e-8)
    without = A.follow(analysis)
    assert_allclose([without.max_force, without.least_force], list(expected["without"].values()), rtol=1e-8)
    third = A.follow(flat(spring_rate=spring.rate, mass=2 + spring.active_mass / 3).analyse())
    assert third.max_force == pytest.approx(expected["third_of_mass"]["N_most"], rel=1e-8)


# ---------------------------------------------------------------- independent checks


@settings(max_examples=5, deadline=None, derandomize=True, phases=[Phase.generate])
@given(
    st.sampled_from(["cycloidal", "modified_sine", "p345"]), st.floats(0.5, 3.0), st.floats(3e5, 3e6),
    st.floats(1e3, 3e4), st.floats(50.0, 300.0), st.floats(1.0, 50.0), st.floats(200.0, 800.0),
)  # fmt: skip
def test_as_time_integration_has_it(law, m, kf, ks, cf, cs, turns):
    cam = flat(law, turns * rpm, mass=m, spring_rate=ks)
    response = ElasticTrain(kf, cf, cs).follow(cam.analyse(), samples=2000)
    assert_allclose(response.position, integrated(cam.motion, turns * rpm, m, kf, ks, cf, cs)[::10], rtol=0, atol=1e-8)


def test_a_stiff_train_is_rigid():
    """At the same damping ratio the error falls as the root of the stiffness."""
    analysis, away = flat().analyse(), []
    for stiffness in (8e7, 8e9):
        damping = 2 * 0.05 * np.sqrt(2 * stiffness)
        response = ElasticTrain(stiffness, damping, 20.0).follow(analysis, samples=23040)
        rigid = response.rigid_resistance + 20.0 * 600 * rpm * response.driven.velocity
        away.append(abs(response.resistance - rigid).max())
    assert away[0] < 0.05 * 536
    assert away[1] < away[0] / 8


def test_the_factor_of_a_force_that_is_largest_at_a_corner():
    """The spring alone is most compressed where the dwell begins: there the rigid force is known, 50 + 5e3 * 0.02 N."""
    slow = ElasticTrain(8e5, 100.0, 20.0).follow(flat(speed=300 * rpm, mass=0.7, preload=50.0).analyse(), samples=720)
    assert slow.rigid_contact_force.max() == pytest.approx(150)
    assert slow.dynamic_factor == pytest.approx(slow.max_force / 150, rel=1e-12)


def test_a_slow_cam_moves_a_train_as_if_it_stood_still():
    response = A.follow(flat(speed=5 * rpm).analyse())
    s, v = response.driven.travel, 5 * rpm * response.driven.velocity
    assert_allclose(response.contact_force, 300 + (8e5 * 5e3 * s) / 8.05e5 + 20 * v, rtol=0, atol=0.05)


def test_the_power_of_the_cam_goes_into_the_dampers():
    table = ((30 * deg, 0.0), (60 * deg, 150.0), (110 * deg, 150.0), (125 * deg, 0.0))
    response = A.follow(flat("modified_sine", cam_angle_table=table).analyse())
    n, speed = len(response.cam_angle), 600 * rpm
    x_t = np.fft.irfft(1j * np.arange(n // 2 + 1) * speed * np.fft.rfft(response.position), n)
    s_t = speed * response.driven.velocity
    lost = 100.0 * (s_t - x_t) ** 2 + 20.0 * x_t**2 + response.driven.load * x_t
    assert response.cam_torque.mean() * speed == pytest.approx(lost.mean(), rel=1e-5)


def test_a_part_at_the_cam_only_moves_mass():
    """A train without stiffness worth the name carries nothing: the part at the cam is a rigid follower."""
    response = ElasticTrain(11.3219, 0.0, 0.0, 1.5).follow(flat(preload=50.0, spring_rate=0.0).analyse(), 300 * rpm)
    rigid = 50.0 + 1.5 * (300 * rpm) ** 2 * response.driven.acceleration
    assert_allclose(response.resistance, rigid, rtol=0, atol=0.3)


def test_an_eccentric_in_closed_form():
    """One harmonic: ``z = -h (m w^2 - k_s) / (k_f + k_s - m w^2)`` times the cosine."""
    law = SimpleHarmonic()
    motion = MotionProgram((Rise(180 * deg, 0.02, law), Return(180 * deg, 0.02, law)))
    cam = TranslatingFlatCam(motion, 0.04, load=SlideLoad(mass=1.0, speed=60.0, spring_rate=2e3, preload=30.0))
    response, kf, ks, m, w = ElasticTrain(2e5, 0.0).follow(cam.analyse()), 2e5, 2e3, 1.0, 60.0
    mean, swing = 0.01, -0.01 * np.cos(response.cam_angle)
    z = ks * mean / (kf + ks) + swing * (ks - m * w**2) / (kf + ks - m * w**2)
    assert_allclose(response.contact_force, 30 + kf * z, rtol=1e-9)


# ---------------------------------------------------------------- populations and speeds


def test_a_population_is_each_of_its_members():
    mass, k, lift = (np.array([[a], [b], [c]]) for a, b, c in ((2.0, 1.5, 1.0), (8e5, 5e5, 1e6), (0.02, 0.015, 0.01)))
    cam = flat(mass=mass)
    cam = cam.replace(motion=program(Cycloidal(), lift))
    train = TrainChain((k, 3e6), (100.0, np.array([[50.0], [70.0], [90.0]])), (0.2,), 20.0)
    many = train.follow(cam.analyse(), samples=720)
    for i in range(3):
        alone = flat(mass=float(mass[i, 0])).replace(motion=program(Cycloidal(), float(lift[i, 0])))
        chain = TrainChain((float(k[i, 0]), 3e6), (100.0, 50.0 + 20 * i), (0.2,), 20.0)
        one = chain.follow(alone.analyse(), samples=720)
        for name in ("contact_force", "position", "cam_torque", "dwell_vibration", "natural_frequencies"):
            assert_allclose(getattr(many, name)[i], getattr(one, name), rtol=1e-11, atol=1e-12)
        for name in ("max_force", "least_force", "dynamic_factor", "max_acceleration", "damping_ratio"):
            assert getattr(many, name)[i] == pytest.approx(getattr(one, name), rel=1e-11)


def test_what_cannot_be_in_a_population_disturbs_nobody():
    mass = np.array([[2.0], [0.3], [1.0]])
    many = replace(A, cam_side_mass=0.5).follow(flat(mass=mass).analyse(), samples=720)
    assert_allclose(np.isnan(many.max_force), [False, True, False])
    alone = replace(A, cam_side_mass=0.5).follow(flat(mass=1.0).analyse(), samples=720)
    assert many.max_force[2] == pytest.approx(alone.max_force, rel=1e-12)


def test_a_column_of_speeds_gives_a_row_for_each():
    speeds = np.array([[300.0], [450.0]]) * rpm
    both, one = A.follow(flat().analyse(), speeds), A.follow(flat().analyse(), 450 * rpm, 720)
    assert both.contact_force.shape == (2, 720)
    assert_allclose(both.contact_force[1], one.contact_force, rtol=1e-12)


@pytest.mark.parametrize("degrees", [60.0, 0.7, 0.2, 0.01])
def test_vibration_in_a_dwell_between_two_samples(degrees):
    """A step of 0.5 deg shows what one of 0.008 does, where the dwell begins and ends anywhere, or holds no sample."""
    motion = program(SimpleHarmonic(), angles=(120.3, degrees, 120, 119.7 - degrees))
    cam = flat().replace(motion=motion)
    few, many = (A.follow(cam.analyse(), samples=n).dwell_vibration for n in (720, 46080))
    assert_allclose(few, many, rtol=1e-5)
    assert (few > 5e-5).all()


# ---------------------------------------------------------------- refusals


def test_refusals_in_a_sentence():
    short = MotionProgram((Rise(120 * deg, 0.02, Cycloidal()),))
    cases = (
        (
            lambda: ElasticTrain(0.0),
            r"the stiffness \(.*\) is 0 N/mm; it must be a finite number above 0",
        ),
        (lambda: ElasticTrain(8e5, -1.0), "damping .* is -1"),
        (lambda: replace(A, cam_side_mass=2.0).follow(flat().analyse()), "the load must have more"),
        (lambda: A.follow(flat().analyse(), 0.0), "the speed of the cam is 0; it must be a finite number above 0"),
        (lambda: A.follow(flat(speed=0.0).analyse()), "the cam is at rest"),
        (lambda: A.follow(flat().replace(motion=short).analyse()), "spans 120 deg; .* a full turn of 360 deg"),
        (
            lambda: A.follow(flat(mass=np.array([[1.0], [2.0]])).analyse(), np.array([[9.0], [8.0], [7.0]])),
            "columns of 2 in its cam and 3 in its speed; they must be equally long",
        ),
        (lambda: A.follow(3.0), "an elastic train does not apply to 3"),
        (lambda: A.follow(flat().analyse(), 0.1), "times the speed of the cam; it can be at most"),
        (lambda: TrainChain((8e5,), (1.0, 2.0), ()), "1 springs, 2 dampers and 0 masses"),
        (lambda: TrainChain((-8e5,), (1.0,), ()), "one of the stiffness of the chain is -800000; it must be"),
        (lambda: HelicalSpring(wire=30 * mm), "the wire is 30 mm thick; it must be below the coil's 28 mm"),
        (lambda: HelicalSpring(total_coils=5.0), "it must have its 6 active ones"),
    )
    for refused, sentence in cases:
        with pytest.raises(ValueError, match=sentence):
            refused()


@dataclass(frozen=True)
class StraightLine(Law):
    """A law whose velocity jumps at both ends."""

    name = "straight line"
    continuity = 0

    def at(self, u):
        return Kinematics(u, 1.0 + 0.0 * u, 0.0 * u, 0.0 * u)

    def peaks(self):
        return Peaks(1.0, np.inf, np.inf)


def test_a_jump_of_the_velocity_is_refused_with_its_place():
    with pytest.raises(ValueError, match=r"the velocity of the follower jumps at 120 deg of the cam"):
        A.follow(flat(StraightLine()).analyse())


def test_resonance_without_damping_is_refused_with_its_harmonic():
    w = 25.0
    train = ElasticTrain(2.0 * (3 * w) ** 2 - 1e3, 0.0)
    with pytest.raises(ValueError, match=re.escape("harmonic 3 of motion or load is at resonance")):
        train.follow(flat(spring_rate=1e3).analyse(), w)
    two = np.array([[w], [2.2 * w]])
    assert_allclose(np.isnan(train.follow(flat(spring_rate=1e3).analyse(), two).max_force), [True, False])


def test_any_cam_with_one_follower_drives_a_train():
    for cam in (TranslatingRollerCam(groove=False), TranslatingFlatCam(), valve()):
        assert ElasticTrain().follow(cam.analyse()).dynamic_factor > 1


def test_a_load_shakes_a_train_at_resonance_too():
    turn = np.linspace(0, 2 * np.pi, 721)
    wave = tuple((float(x), 20 * np.cos(5 * x)) for x in turn)
    train, cam = ElasticTrain(8e5, 0.0), flat(mass=2.0, spring_rate=5e3, cam_angle_table=wave)
    with pytest.raises(ValueError, match="harmonic 5 of motion or load is at resonance"):
        train.follow(cam.analyse(), np.sqrt((8e5 + 5e3) / 2) / 5)
