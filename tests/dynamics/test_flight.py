"""Loss of contact, flight and strikes in time, against reference values of two other integrators and steady motion."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import deg, rpm
from camkit.cam import SlideLoad, TranslatingFlatCam
from camkit.dynamics import ElasticTrain, HelicalSpring, TrainChain, contact_loss_speed, simulate
from camkit.motion import MotionProgram, Return, Rise, SimpleHarmonic
from train_cases import GIVEN, VALUES, A, flat


def agrees(flight, expected, tolerance=3e-5):
    """Events in their order, to some deg."""
    assert [event.kind for event in flight.events] == [kind for kind, _ in expected["events"]]
    angles = np.degrees([event.cam_angle for event in flight.events])
    assert_allclose(angles, [angle for _, angle in expected["events"]], rtol=0, atol=tolerance)
    assert flight.max_gap == pytest.approx(expected["gap_most"], rel=1e-6)
    assert flight.impulse == pytest.approx(expected["impulse_most"], rel=1e-6)


@pytest.mark.parametrize("with_mass", [False, True])
def test_two_turns_beyond_the_loss_of_contact(with_mass):
    train = replace(A, cam_side_mass=GIVEN["bounce2"]["m0"] if with_mass else 0.0)
    flight = simulate(flat("modified_sine", 900 * rpm).analyse(), train, turns=2)
    agrees(flight, VALUES[f"bounce2 {'with mass' if with_mass else 'massless'}"])


@pytest.fixture(scope="module")
def eccentric():
    half = SimpleHarmonic()
    motion = MotionProgram((Rise(180 * deg, 0.02, half), Return(180 * deg, 0.02, half)))
    load = SlideLoad(mass=1.0, speed=VALUES["bounce"]["rpm"] * rpm, spring_rate=2e3, preload=30.0)
    return TranslatingFlatCam(motion, 0.04, load=load).analyse()


def test_an_undamped_train_on_an_eccentric(eccentric):
    agrees(simulate(eccentric, ElasticTrain(2e5, 0.0), turns=3), VALUES["bounce"])


def test_an_eccentric_is_left_at_the_speed_of_the_closed_form(eccentric):
    """``omega^2 = [k_s + B k_f / (e k_f + B)] / m``, ``B = N_0 + e k_f k_s / (k_f + k_s)``, next to no damping."""
    kf, ks, e = 2e5, 2e3, 0.01
    B = 30 + e * kf * ks / (kf + ks)
    expected = np.sqrt(ks + B * kf / (e * kf + B))
    assert contact_loss_speed(eccentric, ElasticTrain(kf, 0.02)) == pytest.approx(expected, rel=1e-6)
    assert expected / rpm == pytest.approx(VALUES["bounce"]["elastic_rpm"], rel=1e-9)


def test_without_loss_of_contact_it_settles_into_steady_motion():
    train = TrainChain((2e6, 1.2e6), (400.0, 300.0), (0.5,), 60.0)
    analysis = flat("p345", 400 * rpm).analyse()
    flight, steady = simulate(analysis, train, turns=12), train.follow(analysis)
    last = flight.cam_angle > 22 * np.pi
    assert flight.events == ()
    expected = np.interp(flight.cam_angle[last] % (2 * np.pi), steady.cam_angle, steady.resistance)
    assert_allclose(flight.resistance[last][:-1], expected[:-1], rtol=0, atol=1e-2)


def test_it_goes_on_from_any_state():
    """From where a turn has ended: the second turn of two."""
    analysis = flat("modified_sine", 400 * rpm).analyse()
    two = simulate(analysis, A, turns=2)
    n = len(two.cam_angle) // 2
    x, h = two.position, 2 * np.pi / n / (400 * rpm)
    speed = (8 * (x[n + 1] - x[n - 1]) - x[n + 2] + x[n - 2]) / (12 * h)
    again = simulate(analysis, A, state=(x[n], speed))
    assert_allclose(again.position, x[n:], rtol=0, atol=1e-10)
    assert simulate(analysis, A, state=(1e-3, 0.0)).events[0].kind == "off"  # pushed away from the cam


def test_in_flight_nothing_presses_and_the_gap_is_open():
    flight = simulate(flat(speed=900 * rpm).analyse(), A)
    flies = flight.gap > 0
    assert flies.any()
    assert (flight.resistance[flies] == 0).all()
    assert (flight.resistance >= 0).all()
    assert (flight.gap >= 0).all()


def test_a_light_part_at_the_cam_flies_as_one_without_mass():
    analysis = flat("modified_sine", 900 * rpm).analyse()
    light, none = (simulate(analysis, replace(A, cam_side_mass=m)) for m in (1e-4, 0.0))
    assert light.events[0].cam_angle == pytest.approx(none.events[0].cam_angle, abs=0.05 * deg)
    assert light.max_gap == pytest.approx(none.max_gap, rel=0.05)


def test_refusals():
    with pytest.raises(ValueError, match="the return spring of the train surges"):
        simulate(flat().analyse(), replace(A, spring=HelicalSpring()))
    with pytest.raises(ValueError, match="the number of turns is 0; it must be a whole number of at least 1"):
        simulate(flat().analyse(), A, turns=0)
    with pytest.raises(ValueError, match="is a population"):
        simulate(flat(mass=np.array([[1.0], [2.0]])).analyse(), A)
    for state in ((0.0,), (0.0, np.nan), "rest"):
        with pytest.raises(ValueError, match="the state of the train"):
            simulate(flat().analyse(), A, state=state)
    with pytest.raises(ValueError, match="the train is a population"):
        simulate(flat().analyse(), ElasticTrain(np.array([[1e5], [2e5]])))
