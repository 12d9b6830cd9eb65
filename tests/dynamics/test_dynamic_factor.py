"""The dynamic factor beside the elastic train, against the reference values and powers of the factor."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, OscillatingRollerCam, TranslatingRollerCam, deg, mm, rpm
from camkit.cam import ArmLoad, ContactPair
from camkit.cam import peak_force as force_of
from camkit.cam import peak_pressure as pressure_of
from camkit.cam import peak_torque as torque_of
from camkit.cam import peak_wear as wear_of
from camkit.dynamics import ElasticArm, ElasticFollower, factor_check, tuned
from camkit.machines import CamLever, ValveCam
from camkit.machines.high_speed_measures import (
    min_force,
    peak_force,
    peak_pressure,
    peak_stress,
    peak_torque,
    peak_wear,
)
from camkit.motion import ModifiedSine
from camkit.views import factor_errors
from train_cases import GIVEN, VALUES, A, flat, program

RATIOS = np.array(GIVEN["high_speed"]["ratios"], dtype=float)
REFERENCE = VALUES["high_speed"]
POWERS = {peak_stress: 0.5, peak_wear: 1.5, peak_pressure: 0.5, peak_force: 1.0, peak_torque: 1.0}

WAYS = ("highest", "lowest")


def high_speed(tau, **fields):
    cam = HighSpeedCam(**fields)
    return ElasticFollower(cam, tuned(ElasticArm(), cam.analyse(), tau))


def test_the_rows_of_the_high_speed_cam_beside_the_factor():
    """The formal peaks where contact is lost, too; the factor is that of the load's torque."""
    found = factor_check(high_speed(RATIOS[:, None]), [peak_stress, peak_wear])
    expected = [REFERENCE[f"tau {tau:g}"] for tau in RATIOS]
    rigid = REFERENCE["rigid"]
    factor = np.array([row["most_moment"] for row in expected]) / rigid["most_moment"]
    assert_allclose(found.load_factor, factor, rtol=1e-5)
    assert found.loses_contact.tolist() == [row["least_moment"] < 0 for row in expected]
    for row, kind, power in zip(found.rows, ("sigma", "wear"), (0.5, 1.5), strict=True):
        real = np.array([each[f"{kind}_turn"] for each in expected])
        assert_allclose(row.rigid * mm**0.5, rigid[f"{kind}_turn"], rtol=1e-6)
        assert_allclose(row.elastic * mm**0.5, real, rtol=2e-6)
        assert_allclose(row.load_error, rigid[f"{kind}_turn"] * factor**power / real - 1, atol=2e-5)
    three = found.rows[1]
    assert three.by_load[2] * mm**0.5 == pytest.approx(637, abs=1)
    assert three.load_error[2] == pytest.approx(0.19, abs=5e-3)


@pytest.mark.parametrize("fields", [{}, {"groove": True}, {"spring_factor": 3.0, "rise_law": ModifiedSine()}])
def test_each_measure_goes_with_its_power_of_the_factor(fields):
    found = factor_check(high_speed(6, **fields))
    assert {*POWERS} <= {row.measure for row in found.rows}
    assert min_force not in {row.measure for row in found.rows}
    elastic, rigid = high_speed(6, **fields).analyse(), HighSpeedCam(**fields).analyse()
    most = {way: [getattr(a, way)(lambda at: at.contact_force).value for a in (elastic, rigid)] for way in WAYS}
    sizes = np.fmax(most["highest"], -np.array(most["lowest"]) if rigid.groove else -np.inf)
    assert found.contact_factor == pytest.approx(sizes[0] / sizes[1], rel=1e-6)
    for row in found.rows:
        power = POWERS.get(row.measure, 0.5)
        assert row.by_load == pytest.approx(row.rigid * found.load_factor**power, rel=1e-6)
        assert row.by_contact == pytest.approx(row.rigid * found.contact_factor**power, rel=1e-6)
        assert row.elastic == pytest.approx(row.measure(elastic), rel=1e-12)


def test_other_cams_and_a_population_as_its_members():
    load = ArmLoad(mass=3.0, speed=300 * rpm, spring_rate=8.0, preload=30.0)
    arm = OscillatingRollerCam(program(ModifiedSine(), 30 * deg), groove=False, load=load, contact=ContactPair())
    roller = TranslatingRollerCam(flat().motion, load=flat().load, groove=False, contact=ContactPair())
    for cam, train in ((arm, ElasticArm()), (roller, A)):
        one = factor_check(ElasticFollower(cam, train))
        powers = {force_of: 1, torque_of: 1, wear_of: 1.5, pressure_of: 0.5}
        assert {row.measure for row in one.rows} == {*powers}
        for row in one.rows:
            assert row.by_load == pytest.approx(row.rigid * one.load_factor ** powers[row.measure], rel=1e-6)
        many = factor_check(ElasticFollower(cam, train.replace(stiffness=train.stiffness * np.array([[0.5], [1.0]]))))
        for alone, each in zip(one.rows, many.rows, strict=True):
            assert_allclose([each.by_load[1], each.elastic[1]], [alone.by_load, alone.elastic], rtol=1e-6)
    assert len(factor_check(ElasticFollower(CamLever(), ElasticArm(5e4, 50.0))).rows) == 6
    valve = factor_check(ElasticFollower(ValveCam(), A.replace(stiffness=5e6)))
    assert valve.loses_contact
    assert "leaves the cam" in valve._repr_html_()


def test_its_view_names_what_is_off_and_where_the_train_leaves_the_cam():
    found = factor_check(high_speed(RATIOS[:, None]), [peak_wear])
    marks = factor_errors(found, RATIOS)
    assert_allclose(marks["wear index"].y, 100 * found.rows[0].load_error[::-1])
    assert_allclose(marks["wear index, contact"].y, 100 * found.rows[0].contact_error[::-1])
    assert marks["lost"].x.tolist() == [2, 3]
