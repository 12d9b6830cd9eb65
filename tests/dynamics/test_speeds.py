"""Sweeps over the speed, and the speed at which a train leaves its cam."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import rpm, with_quantities
from camkit.cam import BarrelCam, jump_speed
from camkit.dynamics import ElasticTrain, HelicalSpring, contact_loss_speed, simulate, speed_sweep
from train_cases import VALUES, A, flat, valve


@pytest.mark.parametrize("law", ["cycloidal", "modified_sine"])
def test_a_sweep(law):
    expected = VALUES["sweep"][law]
    turns = np.array([float(n) for n in expected]) * rpm
    sweep, values = speed_sweep(flat(law).analyse(), A, turns, 5760), np.array(list(expected.values()))
    assert_allclose(sweep.max_force, values[:, 0], rtol=1e-6)
    assert_allclose(sweep.least_force, values[:, 1], rtol=1e-6)
    assert_allclose(sweep.max_acceleration, values[:, 2], rtol=1e-6)
    assert_allclose(sweep.dwell_vibration, values[:, 3:], rtol=1e-5)


def test_a_sweep_of_a_population_is_that_of_each_member():
    mass = np.array([[2.0], [1.0]])
    turns = np.array([300.0, 500.0, 700.0]) * rpm
    many = speed_sweep(flat(mass=mass).analyse(), A, turns, 720)
    for i in range(2):
        one = speed_sweep(flat(mass=float(mass[i, 0])).analyse(), A, turns, 720)
        for name in one._fields[1:]:
            assert_allclose(getattr(many, name)[i], getattr(one, name), rtol=1e-11)


@pytest.mark.parametrize("law", ["cycloidal", "modified_sine", "p345"])
def test_contact_loss(law):
    analysis, expected = flat(law).analyse(), VALUES[f"jump {law}"]
    assert contact_loss_speed(analysis, A) / rpm == pytest.approx(expected["elastic_rpm"], rel=1e-7)
    assert jump_speed(analysis) / rpm == pytest.approx(expected["rigid_rpm"], rel=1e-7)


def test_contact_loss_of_a_valve_train():
    analysis, expected = valve().analyse(), VALUES["valve jump"]
    speed = contact_loss_speed(analysis, ElasticTrain(5e6, 100.0, 10.0))
    assert speed / rpm == pytest.approx(expected["elastic_rpm"], rel=1e-6)
    assert jump_speed(analysis) / rpm == pytest.approx(expected["rigid_rpm"], rel=1e-7)


def test_it_is_the_lowest_speed_with_a_force_of_0():
    """A light damping: the least force falls below 0 at a resonance and comes back above it."""
    analysis, train = flat("modified_sine", preload=150.0).analyse(), ElasticTrain(8e5, 8.0)
    speed = contact_loss_speed(analysis, train)
    slower = np.linspace(0.2 * speed, 0.999 * speed, 400)
    assert (speed_sweep(analysis, train, slower).least_force > 0).all()
    assert train.follow(analysis, 1.0005 * speed).least_force < 0
    assert abs(train.follow(analysis, speed).least_force) < 1e-3


@pytest.mark.parametrize("ratio", [1e-3, 1e-4])
def test_a_narrow_resonance_is_not_passed_over(ratio):
    """Next to no damping: the lowest resonance at which the least force is below 0, which harmonics show one by one."""
    analysis, train = flat("modified_sine").analyse(), ElasticTrain(8e5, 2 * ratio * np.sqrt(2 * 8.05e5))
    resonances = np.sqrt(8.05e5 / 2) / np.arange(60, 10, -1)
    least = speed_sweep(analysis, train, resonances, 5760).least_force
    first = resonances[np.flatnonzero(least < 0)[0]]
    assert contact_loss_speed(analysis, train) == pytest.approx(first, rel=5 * ratio)


def test_a_population_loses_contact_as_each_of_its_members_does():
    mass, preload = np.array([[2.0], [1.5], [1.0]]), np.array([[300.0], [250.0], [-5.0]])
    many = contact_loss_speed(flat(mass=mass, preload=0.0, force=preload).analyse(), A)
    for i in range(2):
        alone = flat(mass=float(mass[i, 0]), preload=0.0, force=float(preload[i, 0]))
        assert many[i] == pytest.approx(contact_loss_speed(alone.analyse(), A), rel=1e-6)
    assert many[2] == 0


def test_a_stiff_train_loses_contact_where_a_rigid_one_does():
    analysis = flat().analyse()
    stiff = ElasticTrain(8e8, 2 * 0.3 * np.sqrt(2 * 8e8))
    assert contact_loss_speed(analysis, stiff) == pytest.approx(jump_speed(analysis), rel=0.02)


def test_a_strong_preload_on_a_soft_train_is_never_lost():
    assert contact_loss_speed(flat(preload=5000.0).analyse(), ElasticTrain(1e4, 10.0)) == np.inf


def test_refusals():
    with pytest.raises(ValueError, match="the train has no damping: every resonance loses contact"):
        contact_loss_speed(flat().analyse(), ElasticTrain(8e5, 0.0))
    with pytest.raises(ValueError, match="they must be numbers in a row"):
        speed_sweep(flat().analyse(), A, 3.0)
    with pytest.raises(ValueError, match="the speed of the cam is -1; it must be a finite number above 0"):
        speed_sweep(flat().analyse(), A, [10.0, -1.0])


@pytest.mark.parametrize(
    ("path", "values"),
    [("damping", (100.0, 40.0)), ("ground_damping", (20.0, 60.0)), ("cam_side_mass", (0.0, 0.3)),
     ("spring.surge_damping", (0.01, 0.05))],
)  # fmt: skip
def test_trains_that_differ_in_what_a_cam_at_rest_does_not_feel(path, values):
    analysis, train = flat().analyse(), A.replace(spring=HelicalSpring())
    many = contact_loss_speed(analysis, with_quantities(train, {path: np.array(values)[:, None]}))
    alone = [contact_loss_speed(analysis, with_quantities(train, {path: value})) for value in values]
    assert_allclose(many, alone, rtol=1e-6)


def test_a_groove_lets_no_follower_leave_it():
    analysis = BarrelCam().analyse()
    assert contact_loss_speed(analysis, ElasticTrain()) == jump_speed(analysis) == np.inf
    with pytest.raises(ValueError, match="a groove holds the follower from both sides"):
        simulate(analysis, ElasticTrain(), 300 * rpm)


def test_a_train_that_cannot_be_has_no_speed_and_changes_no_other_one():
    analysis = flat("cycloidal").analyse()
    damping = np.array([[100.0], [100.0], [0.0]])
    found = contact_loss_speed(analysis, ElasticTrain(np.array([[8e5], [np.nan], [8e5]]), damping))
    assert np.isnan(found[1:]).all()
    assert found[0] == pytest.approx(contact_loss_speed(analysis, ElasticTrain(stiffness=8e5)), rel=1e-6)
