"""What the pins of a follower bear, against static equilibrium and a roller rolled by brute force."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from camkit import (
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Study,
    TranslatingRollerCam,
    deg,
    minimise,
    mm,
    rpm,
)
from camkit.cam import (
    ArmLoad,
    CamWithPins,
    ConjugatePair,
    peak_force,
    pin_pressure,
    pin_pv,
    pin_volume,
    pivot_pressure,
    pivot_pv,
    ring_thickness,
)
from camkit.dynamics import ElasticArm, ElasticFollower, tuned
from camkit.machines import CamLever
from camkit.quantities import measures_of, quantities_of, value_of, with_quantities

LOAD = ArmLoad(mass=3.0, speed=400 * rpm, spring_rate=8.0, preload=6.0, torque=2.0, gravity=9.81, up_angle=40 * deg)


def arm(**fields):
    return OscillatingRollerCam(**{"load": LOAD, "groove": False, **fields})


def balance(analysis, points, forces):
    """Sum of the forces, and their moment about the pivot, counter-clockwise."""
    pivot = np.reshape([analysis.cam.centre_distance, 0.0], (2, 1))
    reach = [point - pivot for point in points]
    moment = sum(r[0] * f[1] - r[1] * f[0] for r, f in zip(reach, forces, strict=True))
    return sum(forces), moment


def arm_by_differences(machine, phi, h=1e-4):
    """Centre of the uniform arm, and the force that accelerates it, from positions at three times."""

    def centre(t):
        cam, psi = machine.cam, machine.cam.start_angle + machine.cam.motion(t % (2 * np.pi)).s
        return np.array([cam.centre_distance - cam.arm_length / 2 * np.cos(psi), cam.arm_length / 2 * np.sin(psi)])

    before, here, after = (centre(phi + k * h) for k in (-1, 0, 1))
    return here, LOAD.mass * (before - 2 * here + after) / h**2 * LOAD.speed**2


@settings(max_examples=20, deadline=None)
@given(st.booleans(), st.sampled_from([1, -1]), st.floats(20, 45), st.floats(40, 70), st.floats(-180, 180))
def test_all_forces_on_an_arm_are_in_balance(groove, rotation, start, length, up):
    """Contact, pivot, weight and inertia of a uniform arm; its torques are couples."""
    load = LOAD.replace(up_angle=up * deg)
    cam = arm(groove=groove, rotation=rotation, start_angle=start * deg, arm_length=length * mm, load=load)
    machine = CamWithPins(cam)
    analysis = machine.analyse(73)
    phi = analysis.cam_angle[3:17]  # within the rise
    at = analysis.at(phi)
    centre, accelerates = arm_by_differences(machine, phi)
    down = -load.mass * load.gravity * np.array([[np.cos(load.up_angle)], [np.sin(load.up_angle)]]) + 0 * centre
    contact = at.contact_force * at.normal
    total, moment = balance(at, [centre, at.roller_centre, centre], [down, contact, -accelerates])
    assert_allclose(total + at.pivot_force, 0, atol=1e-5 * abs(contact).max())
    about_centre = load.mass * cam.arm_length**2 / 12 * load.speed**2 * at.acceleration  # clockwise, of the arm itself
    couple = load.torque + load.preload + load.spring_rate * at.motion.s
    assert_allclose(-moment, couple + about_centre, atol=1e-5 * abs(couple + about_centre).max())


def test_a_lever_and_its_slider_are_in_balance():
    """In the frame of the machine as it is drawn: the slider hangs on the end of the level lever."""
    press = CamLever()
    analysis = CamWithPins(press).analyse(91).rise
    ((pivot, centre),) = analysis.cranks.values()
    tilt = analysis.motion.s - press.swing / 2
    bodies = {body.name + body.part: body for body in press.analyse(91).bodies}
    assert {"leverarm", "sliderblock"} <= set(bodies)
    down = np.arctan2(-press.pivot_height, press.slider_distance - press.lever)
    turn = np.array([[np.cos(down), np.sin(down)], [np.sin(down), -np.cos(down)]])  # mirrored, then turned
    Q = press.weight + press.force(analysis.way)
    end = press.lever * np.stack([np.cos(tilt), np.sin(tilt)])
    contact, hangs = turn @ (analysis.contact_force * analysis.normal), np.stack([0 * Q, -Q])
    arm_of = turn @ (centre - np.reshape(pivot, (2, 1)))
    moment = arm_of[0] * contact[1] - arm_of[1] * contact[0] + end[0] * hangs[1]
    inertia = press.inertia * press.shaft_speed**2 * analysis.acceleration
    assert_allclose(moment, inertia, atol=1e-9 * abs(moment).max() + 1e-9)
    assert_allclose(turn @ analysis.pivot_force, -(contact + hangs), atol=1e-9)


@pytest.mark.parametrize("rotation", [1, -1])
@pytest.mark.parametrize("groove", [True, False])
def test_a_roller_turns_as_far_as_the_flank_runs(rotation, groove):
    """Over a stretch: the flank's length past the contact, and the turn of the contact's normal on the roller."""
    for cam in (arm(rotation=rotation, groove=groove), TranslatingRollerCam(groove=groove)):
        turns = np.linspace(20 * deg, 100 * deg, 4001)
        at = CamWithPins(cam, pin_diameter=4 * mm).analyse().at(turns)
        flank = at.loaded_flank[2000]
        same = slice(*np.flatnonzero(at.loaded_flank == flank)[[0, -1]])
        profile = at.profile if flank > 0 else at.outer_profile
        nx, ny = at.on_cam(at.normal)
        along = np.stack([-ny, nx])
        arc = (np.diff(profile) * (along[:, 1:] + along[:, :-1]) / 2).sum(0)[same]  # as the contact runs on the cam
        angle = np.unwrap(np.arctan2(*at.normal[::-1]))
        rolled = flank * arc / cam.roller_radius + np.diff(angle)[same]  # as far on the roller
        swings = np.diff(at.motion.s)[same] if isinstance(cam, OscillatingRollerCam) else 0.0
        spun = ((at.roller_spin[1:] + at.roller_spin[:-1]) / 2 * np.diff(turns))[same]
        assert_allclose(spun, rolled + swings, rtol=2e-5, atol=1e-9)


def test_pressures_and_pv_by_their_definition():
    machine = CamWithPins(arm(), 16 * mm, 25 * mm, 6 * mm, 14 * mm)
    analysis = machine.analyse()
    force = abs(analysis.contact_force)
    assert_allclose(analysis.pin_pressure, force / (6 * mm * 14 * mm), rtol=1e-12)
    assert_allclose(analysis.pivot_pressure, np.hypot(*analysis.pivot_force) / (16 * mm * 25 * mm), rtol=1e-12)
    speeds = abs(analysis.velocity) * LOAD.speed * 8 * mm, abs(analysis.roller_spin) * LOAD.speed * 3 * mm
    assert_allclose(analysis.pivot_pv, analysis.pivot_pressure * speeds[0], rtol=1e-12)
    assert_allclose(analysis.pin_pv, analysis.pin_pressure * speeds[1], rtol=1e-12)
    assert pin_pressure(analysis) == pytest.approx(peak_force(analysis) / (6 * mm * 14 * mm), rel=1e-9)
    assert pin_volume(analysis) == pytest.approx(np.pi / 4 * (16**2 * 25 + 6**2 * 14) * mm**3)
    assert ring_thickness(analysis) == pytest.approx(2 * mm)


def test_what_is_not_there_bears_nothing_known():
    slides, flat = CamWithPins(TranslatingRollerCam()).analyse(), CamWithPins(OscillatingFlatCam(load=LOAD)).analyse()
    assert np.isnan([pivot_pressure(slides), pivot_pv(slides)]).all()
    assert pin_pv(slides) > 0
    assert np.isnan([pin_pressure(flat), pin_pv(flat), ring_thickness(flat)]).all()
    assert pivot_pressure(flat) > 0
    share = CamWithPins(HighSpeedCam())
    assert np.isnan(pin_pv(share.analyse()))
    known, faster = (share.replace(rated_speed=600 * rpm, cam=HighSpeedCam(speed=n)).analyse() for n in (1.0, 1.1))
    assert pin_pv(known) > 0
    assert pin_pv(faster) > 1.1 * pin_pv(known)


def test_pins_bear_the_force_of_an_elastic_train():
    cam = HighSpeedCam()
    train = tuned(ElasticArm(), cam.analyse(), 5)
    outer, inner = CamWithPins(ElasticFollower(cam, train)), ElasticFollower(CamWithPins(cam), train)
    one, other = outer.analyse(), inner.analyse()
    most = one.highest(lambda a: a.contact_force).value
    assert most == pytest.approx(177.3944, rel=1e-5)
    for analysis in (one, other):
        assert pivot_pressure(analysis) == pytest.approx(most / (20 * mm * 30 * mm), rel=1e-9)
        assert pin_pressure(analysis) == pytest.approx(most / (6 * mm * 15 * mm), rel=1e-9)
    assert {*measures_of(outer)} == {*measures_of(inner)} > {*CamWithPins.measures, *ElasticFollower.measures}
    assert "cam.train.stiffness" in quantities_of(outer)


def test_a_study_finds_the_smallest_pins():
    machine = CamWithPins(arm())
    free = {
        "pivot_diameter": (6 * mm, 40 * mm),
        "pin_diameter": (3 * mm, 9 * mm),
        "cam.roller_radius": (4 * mm, 9 * mm),
    }
    limits = {pivot_pressure: 2e6, pin_pressure: 4e6, pivot_pv: 1.5e6}
    study = Study(machine, free, (pin_volume,), at_most=limits, at_least={ring_thickness: 2 * mm}, angles=91)
    found = minimise(study, "slsqp", starts=1, seed=1)
    analysis = found.design.analyse()
    assert pin_volume(analysis) < 0.8 * pin_volume(machine.analyse())
    for measure, limit in limits.items():
        assert measure(analysis) <= limit * (1 + 1e-8)
    assert ring_thickness(analysis) >= 2 * mm * (1 - 1e-8)
    x = study.x0 * np.array([[1.0, 1.0, 1.0], [1.2, 0.8, 1.1], [1.0, 1.0, 0.5]])
    many = study.evaluate(x)
    for row, f, g in zip(x[:2], many.f, many.g, strict=False):
        alone = study.evaluate(row)
        assert_allclose(alone.f[0], f, rtol=1e-12)
        assert_allclose(alone.g[0], g, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("cam", [arm(), arm(groove=True), TranslatingRollerCam(), CamLever(), HighSpeedCam()])
@pytest.mark.parametrize("scale", [[1.0, 1.3], [1.0, 1.3, 0.8]])
def test_a_population_of_loads_is_each_of_its_members(cam, scale):
    """Two and three of them: as many as a vector has parts, and one more."""
    names = {"load.speed", "shaft_speed", "speed"} & {*quantities_of(cam)}
    columns = {name: np.array(scale)[:, None] * value_of(cam, name) for name in names}
    many = CamWithPins(with_quantities(cam, columns)).analyse()
    for i in range(len(scale)):
        one = CamWithPins(with_quantities(cam, {name: float(x[i, 0]) for name, x in columns.items()})).analyse()
        for measure in (pivot_pressure, pivot_pv, pin_pressure, pin_pv):
            assert_allclose(np.broadcast_to(measure(many), len(scale))[i], measure(one), rtol=1e-9)


def test_pins_that_cannot_be():
    with pytest.raises(ValueError, match="the cam has all that a cam with pins has already"):
        CamWithPins(ElasticFollower(CamWithPins(arm())))
    with pytest.raises(ValueError, match="the roller's pin is 6 mm thick, the roller 6 mm; the pin must be thinner"):
        CamWithPins(arm(roller_radius=3 * mm)).analyse()
    with pytest.raises(ValueError, match="the cam is 3; it must be a design that can be analysed, such as a cam"):
        CamWithPins(3)
    with pytest.raises(ValueError, match=r"the pivot diameter .* is 0 mm"):
        CamWithPins(arm(), 0.0)
    with pytest.raises(ValueError, match="does not apply"):
        pivot_pressure(arm().analyse())
    with pytest.raises(ValueError, match="it must have one follower"):
        CamWithPins(ConjugatePair()).analyse()
    many = CamWithPins(arm(), pin_diameter=np.array([[4.0], [12.0]]) * mm).analyse()
    assert np.isnan(pin_pressure(many)).tolist() == [False, True]
