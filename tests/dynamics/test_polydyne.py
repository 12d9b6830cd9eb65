"""Polydyne cams: reference values, the load's motion behind them, laws that are not smooth enough, populations."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import OscillatingRollerCam, TranslatingRollerCam, deg, mm, rpm, with_quantities
from camkit.cam import ArmLoad, SlideLoad
from camkit.dynamics import ElasticArm, ElasticTrain, HelicalSpring, TrainChain, polydyne
from camkit.files import from_json, to_json
from camkit.motion import (
    Boundary,
    Cycloidal,
    Dwell,
    FormError,
    MatchedProgram,
    MotionProgram,
    Poly345,
    Poly4567,
    Poly56789,
    Polynomial,
    Rise,
    SplineLaw,
    Through,
)
from camkit.program import record
from camkit.quantities import quantities_of, value_of
from train_cases import GIVEN, VALUES, A, flat, program

WANTED, LOAD, SPEED = program(Poly56789()), flat().load, GIVEN["poly"]["rpm"] * rpm
TRAIN = replace(A, damping=0.0)
INDEX = MotionProgram((Rise(120 * deg, 20 * mm, Poly56789()), Dwell(240 * deg)), advance=20 * mm)
MADE = polydyne(WANTED, TRAIN, LOAD, SPEED)
CURVES = "pitch_radius", "pressure_angle", "contact_force", "efficiency"


def wide(motion):
    return flat().replace(motion=motion, base_radius=0.08).analyse()


def test_the_lift_of_the_cam():
    expected = VALUES["polydyne"]
    assert MADE(150 * deg).s == pytest.approx(expected["lift"], rel=1e-12)
    angles = np.radians([float(angle) for angle in expected["s_at"]])
    assert_allclose(MADE(angles).s, list(expected["s_at"].values()), rtol=1e-12)


def test_vibration_over_the_speed_beside_the_plain_cam():
    share = 1 + LOAD.spring_rate / TRAIN.stiffness
    lifted = (move if isinstance(move, Dwell) else replace(move, lift=share * move.lift) for move in WANTED.segments)
    cams = {"polydyne": wide(MADE), "plain": wide(MotionProgram(tuple(lifted)))}
    for turns, expected in VALUES["polydyne"]["off"].items():
        for name, analysis in cams.items():
            found = TRAIN.follow(analysis, float(turns) * rpm).dwell_vibration
            assert_allclose(found, expected[name], rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("damping", [0.0, 100.0, 400.0])
@pytest.mark.parametrize("law", [Poly56789(), SplineLaw((0.3, 0.7), (0.2, 0.8), (0.0,) * 3, (0.0,) * 3)])
def test_at_the_design_speed_the_load_moves_as_wanted(law, damping):
    """A spline of degree 7 too: a splinedyne cam."""
    train, wanted = ElasticTrain(8e5, damping, 20.0, 0.3), program(law)
    response = train.follow(wide(polydyne(wanted, train, LOAD, SPEED)), SPEED)
    assert_allclose(response.position, wanted(response.cam_angle).s, rtol=0, atol=1e-12)
    if not damping:  # or else the cam itself still moves in a dwell, as its damper answers
        assert response.dwell_vibration.max() < 1e-12


def test_its_derivatives_are_those_of_its_lift():
    made, h = polydyne(WANTED, A, LOAD, SPEED), 1e-6
    phi = np.linspace(0.01, 6.2, 3001)
    motion, after, before = made(phi), made(phi + h), made(phi - h)
    for low, high, slope in zip(before[:3], after[:3], motion[1:], strict=True):
        assert_allclose((high - low) / (2 * h), slope, rtol=0, atol=1e-8 * abs(slope).max())


def test_on_an_arm():
    load = ArmLoad(mass=3 * 5e-3 / 0.06**2, speed=400 * rpm, spring_rate=8.0, preload=5.0)
    wanted, train = program(Poly56789(), 30 * deg), ElasticArm(1500.0, 0.3, 0.02)
    cam = OscillatingRollerCam(wanted, 80 * mm, 60 * mm, start_angle=25 * deg, groove=False, load=load)
    made = polydyne(wanted, train, cam.analyse(), 400 * rpm)
    response = train.follow(cam.replace(motion=made).analyse())
    assert_allclose(response.position, wanted(response.cam_angle).s, rtol=0, atol=1e-12)


def test_it_goes_into_a_cam_with_its_paths():
    cam = TranslatingRollerCam(MADE, load=LOAD, groove=False)
    assert cam.analyse().profile_margin.value > 0
    slower = with_quantities(cam, {"motion.design_speed": 500 * rpm, "motion.rise.lift": 21 * mm}).motion
    again = polydyne(program(Poly56789(), 21 * mm), TRAIN, LOAD, 500 * rpm)
    phi = np.linspace(0, 6.28, 101)
    assert_allclose(slower(phi).s, again(phi).s, rtol=0, atol=1e-15)


@pytest.mark.parametrize(("law", "order"), [(Poly345(), 1), (Cycloidal(), 1), (Poly4567(), 2), (Poly56789(), 3)])
def test_a_law_that_is_not_smooth_enough_is_named_with_what_jumps(law, order):
    """The derivative of order ``k`` of the cam jumps where that of order ``k + 2`` of the load does."""
    joints = polydyne(program(law), TRAIN, LOAD, SPEED).transitions()
    assert [joint.order for joint in joints] == [order] * 4
    assert_allclose([joint.angle for joint in joints], np.radians([120, 180, 300, 360]))
    if order == 1:
        assert "velocity step" in joints[0].verdict
        with pytest.raises(ValueError, match="the velocity of the follower jumps"):
            TRAIN.follow(wide(polydyne(program(law), TRAIN, LOAD, SPEED)))


def test_a_population_is_each_of_its_members():
    mass, stiffness = np.array([[2.0], [1.5]]), np.array([[8e5], [7e5]])
    many = polydyne(WANTED, ElasticTrain(stiffness, 50.0, 20.0), LOAD.replace(mass=mass), SPEED)
    phi = np.linspace(0, 6.28, 101)
    for i in range(2):
        train = ElasticTrain(float(stiffness[i, 0]), 50.0, 20.0)
        one = polydyne(WANTED, train, LOAD.replace(mass=float(mass[i, 0])), SPEED)
        for found, expected, rounding in zip(many(phi), one(phi), (1e-13, 1e-10, 1e-8, 1e-6), strict=True):
            assert_allclose(found[i], expected, rtol=0, atol=rounding * abs(expected).max())


def test_what_cannot_be_in_a_population_is_nan():
    """A speed or a train that no single cam may have, and rows beside it that can be."""
    speeds = np.array([[600.0], [-1.0], [700.0]]) * rpm
    by_speed, by_train = polydyne(WANTED, TRAIN, LOAD, speeds), ElasticTrain(np.array([[8e5], [-1.0], [9e5]]), 0.0)
    for many in (by_speed, polydyne(WANTED, by_train, LOAD, SPEED)):
        assert_allclose(many.possible[:, 0], [True, False, True])
        assert_allclose(np.isnan(many([1.0, 3.0]).s[:, 0]), [False, True, False])


@pytest.mark.parametrize("train", [TRAIN, A])
def test_a_page_computes_it(train):
    cam = TranslatingRollerCam(polydyne(WANTED, train, LOAD, SPEED), load=LOAD, groove=False)
    values = {"motion.design_speed": 500 * rpm, "motion.rise.lift": 21 * mm}
    found = record(lambda cam: {name: getattr(cam.analyse(61), name) for name in CURVES}, cam)
    x = {path: values.get(path, value_of(cam, path)) for path in quantities_of(cam)}
    analysis = with_quantities(cam, values).analyse(61)
    for name in CURVES:
        expected = getattr(analysis, name)
        assert_allclose(found(x)[name], expected, rtol=0, atol=1e-9 * np.nanmax(abs(expected)))


def test_an_error_of_form_rides_on_it():
    error, phi = FormError(amplitude=0.01 * mm, waves=9), np.linspace(0, 6.28, 101)
    formed = error.on(MADE)
    for found, plain, wave in zip(formed(phi), MADE(phi), error.at(phi), strict=True):
        assert_allclose(found, plain + wave, rtol=0, atol=1e-12 * abs(plain).max())
    changed = with_quantities(formed, {"design_speed": 500 * rpm, "form.amplitude": 0.0})
    assert_allclose(changed(phi).s, polydyne(WANTED, TRAIN, LOAD, 500 * rpm)(phi).s, rtol=0, atol=1e-15)
    assert from_json(to_json(formed)) == formed


def test_a_matched_motion_is_wanted_too():
    """With jerk and its derivative given at both ends: five derivatives are continuous there."""
    ends = Boundary(0.0, 0.0, 0.0, j=0.0), Boundary(0.0, 0.0, 0.0, j=0.0)
    up = Polynomial(through=(Through(0.5, s=12 * mm),))
    wanted = MatchedProgram((up, Dwell(180 * deg)), ends)
    made = polydyne(wanted, A, LOAD, SPEED)
    response = A.follow(wide(made), SPEED)
    assert_allclose(response.position, wanted(response.cam_angle).s, rtol=0, atol=1e-6 * mm)
    phi = np.linspace(0, 6.28, 101)
    assert_allclose(made.wanted(phi).s, wanted(phi).s, rtol=0, atol=1e-15)


def test_refusals():
    short = MotionProgram((Rise(120 * deg, 20 * mm, Poly56789()),))
    table = ((0.0, 0.0), (1.0, 5.0))
    cases = (
        (lambda: polydyne(short, TRAIN, LOAD, SPEED), "over a full turn of 360 deg"),
        (lambda: polydyne(INDEX, TRAIN, LOAD, SPEED), "comes back to where it began"),
        (lambda: polydyne(WANTED, TrainChain(), LOAD, SPEED), "a train of one mass behind one spring"),
        (lambda: polydyne(WANTED, replace(A, spring=HelicalSpring()), LOAD, SPEED), "does not surge"),
        (lambda: polydyne(WANTED, TRAIN, LOAD.replace(cam_angle_table=table), SPEED), "the load has a table"),
        (lambda: polydyne(WANTED, TRAIN, LOAD, -1.0), "the speed of the cam is -1"),
        (lambda: polydyne(WANTED, TRAIN, 3.0, SPEED), "a polydyne cam does not apply to 3"),
        (lambda: polydyne(WANTED, replace(A, cam_side_mass=3.0), LOAD, SPEED), "the mass of the train is -1"),
        (lambda: polydyne(WANTED, TRAIN, SlideLoad(mass=0.0), SPEED), "the mass of the train is 0"),
    )
    for refused, sentence in cases:
        with pytest.raises(ValueError, match=sentence):
            refused()
