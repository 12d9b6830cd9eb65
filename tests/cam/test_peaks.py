"""Peaks are right whatever cam angles an analysis has: against a very fine table of each segment of the motion."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, OscillatingRollerCam, door_handle_study, nsga2
from camkit.cam import high_speed_study, valve_study
from camkit.cam.closing import ContactPair, contact_along, jump_speed
from camkit.cam.follower_measures import least_force, least_profile_radius, peak_pressure
from camkit.cam.high_speed import HighSpeedCam
from camkit.cam.load import ArmLoad
from camkit.cam.measures import (
    base_radius,
    least_concave_radius,
    least_convex_radius,
    part,
    peak_force,
    peak_torque,
    steepest,
    undercut_margin,
)
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.peaks import highest, raised
from camkit.cam.slide import SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.cam.valve import ValveCam
from camkit.cam.valve_train import FOLLOWERS
from camkit.motion import LAWS, Cycloidal, Dwell, MotionProgram, Poly4567, Return, Rise, Skewed
from camkit.units import N, deg, kg, mm, rpm

PAIR = ContactPair()
SLIDE = SlideLoad(mass=2 * kg, speed=300 * rpm, force=30 * N, spring_rate=6e3, preload=300 * N, gravity=9.81)
ARM = ArmLoad(mass=2 * kg, speed=200 * rpm, torque=3, spring_rate=8, preload=20, gravity=9.81, up_angle=70 * deg)
FINE = np.linspace(1e-9, 1 - 1e-9, 5001)


def fine_table(cam):
    """The cam at 5001 angles of each smooth piece of its motion, which are not the package's."""
    program, angles = cam.motion, []
    for start, segment in zip(program.starts, program.segments, strict=False):
        for low, high in pairwise((0.0, *segment.kinks, 1.0)):
            angles.append(start + (low + (high - low) * FINE) * segment.angle)
    return replace(cam.analyse(31), cam_angle=np.concatenate(angles))


def radius(curvature):
    most = curvature.max()
    return 1 / most if most > 0 else np.inf


def expected(cam):
    """Every measure from its definition over the fine table."""
    a = fine_table(cam)
    value = {
        steepest: abs(a.pressure_angle).max(),
        base_radius: a.pitch_radius.min(),
        peak_force: abs(a.contact_force).max(),
        least_force: a.contact_force.min(),
        peak_torque: abs(a.cam_torque).max(),
        least_profile_radius: radius(a.curvature) - cam.roller_radius if cam.roller_radius else a.profile_radius.min(),
    }
    if cam.roller_radius:
        bent = abs(a.curvature) if cam.groove else a.curvature
        value |= {
            least_convex_radius: radius(a.curvature),
            least_concave_radius: radius(-a.curvature),
            undercut_margin: 1 - cam.roller_radius * bent.max(),
        }
    if not (a.undercut.any() or a.outer_undercut.any()):
        value[peak_pressure(PAIR)] = contact_along(a, PAIR).pressure.max()
    return value


def right(cam, n):
    """Ten times better than 0.1 %: at a needle, a radius of 0.1 mm, the table itself is no better than 5e-5."""
    found, values = cam.analyse(n), expected(cam)
    sizes = {undercut_margin: 1, least_profile_radius: values[base_radius], least_force: values[peak_force]}
    for measure, value in values.items():
        close = 1e-4 * (abs(value) + sizes.get(measure, 0)) if np.isfinite(value) else 0
        assert_allclose(measure(found), value, rtol=0, atol=close, err_msg=measure.name)


LAW = st.one_of(st.sampled_from(LAWS), st.builds(lambda x: Skewed(Cycloidal(), x), st.floats(0.2, 0.8)))
SPAN = st.one_of(st.floats(0.5, 8), st.floats(20, 120))


@st.composite
def programs(draw, lift):
    """Up and down again between dwells, the rise or the return often narrow, the lift then small."""
    up, down, rest = draw(SPAN), draw(SPAN), draw(st.floats(1, 100))
    height = lift * min(1.0, min(up, down) / 90) * draw(st.floats(0.1, 1))
    away, back = Rise(up * deg, height, draw(LAW)), Return(down * deg, height, draw(LAW))
    return MotionProgram((away, Dwell(rest * deg), back, Dwell((360 - up - down - rest) * deg)))


@st.composite
def cams(draw):
    kind, sigma = draw(st.sampled_from(["slide", "face", "arm", "plate", "rocking"])), draw(st.sampled_from([1, -1]))
    groove = draw(st.booleans())
    if kind in ("slide", "face"):
        motion, size = draw(programs(25 * mm)), draw(st.floats(25, 60)) * mm
        offset = draw(st.floats(-12, 12)) * mm
        if kind == "face":
            return TranslatingFlatCam(motion, size, offset, sigma, load=SLIDE)
        return TranslatingRollerCam(motion, size, draw(st.floats(1, 12)) * mm, offset, sigma, load=SLIDE, groove=groove)
    motion = draw(programs(20 * deg))
    if kind == "rocking":
        return OscillatingFlatCam(motion, 90 * mm, draw(st.floats(15, 30)) * deg, 8 * mm, 300 * mm, sigma, load=ARM)
    l, psi, r = draw(st.floats(45, 75)) * mm, draw(st.floats(25, 60)) * deg, draw(st.floats(1, 8)) * mm
    return OscillatingRollerCam(motion, 80 * mm, l, psi, r, sigma, load=ARM, groove=groove)


@settings(max_examples=120, deadline=None)
@given(cams(), st.sampled_from([2, 3, 10, 31, 361, 721]))
def test_every_peak_is_that_of_a_very_fine_table(cam, n):
    try:
        cam.analyse(n)
    except ValueError:
        with pytest.raises(ValueError, match="must"):
            cam.analyse(7201)
        return
    right(cam, n)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_a_narrow_rise_is_seen_with_every_law(law):
    for angle in (0.05, 2, 119):
        lift = 0.15 * mm * angle
        motion = MotionProgram((Dwell(100 * deg), Rise(angle * deg, lift, law), Dwell(40 * deg)))
        right(TranslatingRollerCam(motion, load=SLIDE), 361)
        right(TranslatingFlatCam(motion, load=SLIDE), 361)


def test_a_rise_of_two_degrees():
    rise, back = (of(angle * deg, 0.3 * mm, Poly4567()) for of, angle in ((Rise, 2), (Return, 180)))
    motion = MotionProgram((rise, Dwell(178 * deg), back))
    for n in (3, 721):
        analysis = TranslatingRollerCam(motion).analyse(n)
        assert steepest(analysis) / deg == pytest.approx(26.234, abs=1e-3)
        assert peak_force(analysis) == pytest.approx(995.2, abs=0.1)
        assert undercut_margin(analysis) == pytest.approx(-8.54, abs=0.005)


def test_a_law_that_stops_with_a_jolt_is_seen_before_the_joint():
    """At the end of a harmonic rise the follower is thrown: the acceleration there belongs to no angle after it."""
    from camkit.motion import SimpleHarmonic

    cam = TranslatingRollerCam(MotionProgram((Rise(90 * deg, 20 * mm, SimpleHarmonic()), Dwell(60 * deg))), load=SLIDE)
    a, h = np.pi**2 / 2 * 20 * mm / (90 * deg) ** 2, 20 * mm
    thrown = SLIDE.resisting_force(h, -a)
    for n in (2, 7, 361):
        assert least_force(cam.analyse(n)) == pytest.approx(thrown, rel=1e-7)
        speed = np.sqrt(SLIDE.static_force(h) / (SLIDE.mass * a))
        assert jump_speed(cam.analyse(n)) == pytest.approx(speed, rel=1e-7)


def test_the_design_of_a_front_keeps_its_limits_at_any_number_of_angles():
    study = door_handle_study()
    front = nsga2(study, 40, 40, seed=1)
    for angles in (61, 361, 7201):
        assert study.replace(angles=angles).evaluate(front.x).feasible.all()


def test_both_curves_of_a_door_handle():
    rng = np.random.default_rng(7)
    for law in LAWS:
        l, psi, split = rng.uniform(42, 58), rng.uniform(0.3, 0.5), rng.uniform(16, 80)
        cam = DoorHandleCam(l * mm, psi, 78 * mm, relief_cam_angle=split * deg, motion_law=law, door_torque=5)
        analysis = cam.analyse(61)
        for name in ("lift", "relief"):
            for measure, value in expected(getattr(cam, name)).items():
                if measure in (least_profile_radius, least_force) or measure.name == "peak contact pressure":
                    continue
                assert_allclose(part(measure, name)(analysis), value, rtol=1e-5, atol=1e-5, err_msg=measure.name)


def test_a_population_with_angles_of_its_own_is_its_members():
    lifts, spans = np.array([[4.0], [9.0], [1.0]]) * mm, np.array([[30.0], [100.0], [1.5]]) * deg

    def cam(lift, span):
        rest = 2 * np.pi - 2 * span - 1
        motion = (Rise(span, lift, LAWS[2]), Dwell(1.0), Return(span, lift, Skewed(Cycloidal(), 0.4)), Dwell(rest))
        return TranslatingRollerCam(MotionProgram(motion), load=SLIDE)

    many = cam(lifts, spans).analyse(61)
    for measure in TranslatingRollerCam.measures:
        singles = [measure(cam(h, b).analyse(61)) for h, b in zip(lifts[:, 0], spans[:, 0], strict=True)]
        assert_allclose(measure(many), singles, rtol=1e-12, err_msg=measure.name)


# ---------------------------------------------------------------- the finder itself


def test_raised_lifts_maxima_to_the_parabola_and_nothing_else():
    x = np.arange(7.0)
    assert_allclose(raised(-((x - 3.3) ** 2)), [*-((x[:3] - 3.3) ** 2), 0, *-((x[4:] - 3.3) ** 2)], atol=1e-15)
    assert_allclose(raised(x), x)
    assert_allclose(raised(np.array([[0.0, 1, 0], [0, np.inf, 0]])), [[0, 1, 0], [0, np.inf, 0]])
    assert_array_equal(raised(np.array([0.0, 2, 1.9, 0]), np.array([False, False, False, False])), [0, 2, 1.9, 0])


@pytest.mark.parametrize(
    "shape", [lambda x: -abs(x), lambda x: 1 / (1e-4 + x**2), lambda x: -(x**2), lambda x: -np.exp(9 * x)]
)
def test_corners_and_needles_are_zoomed_in_on(shape):
    at, x = np.array([[0.123], [0.5], [0.777], [0.9999]]), np.linspace(0, 1, 101)
    inner = (x > 0) & (x < 1)
    found = highest(lambda angle: shape(angle - at), x, inner)
    best = shape(at - at) if shape(1.0) < shape(0.0) and shape(-1.0) < shape(0.0) else shape(0 - at)
    assert_allclose(found.value, best[:, 0], rtol=1e-6, atol=1e-5)


# ---------------------------------------------------------------- high-speed cams


@pytest.mark.parametrize("law", [law for law in LAWS if law.name != "parabolic"], ids=lambda law: law.name)
def test_peaks_of_a_high_speed_cam(law):
    """At 5 angles as at 20001 of either interval, which are even and know nothing of the laws' kinks."""
    cam = HighSpeedCam(rise_law=law, return_law=Skewed(Cycloidal(), 0.43), spring_factor=9, rise_angle=63 * deg)
    rise, fall = cam.analyse(20_001).intervals
    few = cam.analyse(5)
    expected = {
        high_speed_study.steepest: [abs(part.pressure_angle).max() for part in (rise, fall)],
        high_speed_study.peak_force: [part.normal_force.max() for part in (rise, fall)],
        high_speed_study.peak_torque: [abs(part.cam_torque).max() for part in (rise, fall)],
        high_speed_study.peak_stress: [np.nanmax(part.stress_coefficient) / mm**0.5 for part in (rise, fall)],
        high_speed_study.peak_wear: [np.nanmax(part.wear_coefficient) / mm**0.5 for part in (rise, fall)],
        high_speed_study.peak_pressure: [np.nanmax(part.hertz_pressure) for part in (rise, fall)],
    }
    for measure, values in expected.items():
        assert measure(few) == pytest.approx(max(values), rel=3e-4), measure.name
    least = min(part.margin.min() for part in (rise, fall))
    assert high_speed_study.undercut_margin(few) == pytest.approx(least, abs=3e-4)


@pytest.mark.parametrize(("n", "m"), [(6, 16), (20, 20), (3, 1)])
def test_peaks_of_a_valve_cam(n, m):
    for follower in FOLLOWERS:
        cam = ValveCam(n=n, m=m, follower=follower, base_radius=30 * mm)
        fine, few = cam.analyse(20_001), cam.analyse(3)
        assert steepest(few) == pytest.approx(abs(fine.pressure_angle).max(), rel=1e-5)
        assert peak_force(few) == pytest.approx(abs(fine.contact_force).max(), rel=1e-5)
        assert valve_study.peak_stress(few) == pytest.approx(fine.contact_stress.max(), rel=1e-5, nan_ok=True)
        assert valve_study.peak_camshaft_torque(few) == pytest.approx(abs(fine.cam_torque).max(), rel=1e-5)
        assert valve_study.face_reach(few) == pytest.approx(abs(fine.velocity).max(), rel=1e-5)
        tightest = fine.flat_radius.min() if follower == FOLLOWERS[0] else 1 / fine.curvature.max() - cam.roller_radius
        assert few.least_radius == pytest.approx(tightest, abs=1e-4 * 30 * mm)
