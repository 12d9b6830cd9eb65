"""Peaks are right whatever cam angles an analysis has: against a very fine table of each segment of the motion."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, OscillatingRollerCam, door_handle_study, nsga2
from camkit.cam.follower_measures import min_force, min_profile_radius, peak_pressure
from camkit.cam.force_closure import ContactPair, contact_along, jump_speed
from camkit.cam.loads import ArmLoad
from camkit.cam.measures import (
    base_radius,
    max_pressure_angle,
    min_concave_radius,
    min_convex_radius,
    part,
    peak_force,
    peak_torque,
    undercut_margin,
)
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.slide import SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.extrema import highest, highest_between, raised
from camkit.machines import high_speed_measures, valve_measures
from camkit.machines.cam_lever import CamLever, cam_lever_study, closing_share, lever_stress, lever_wear
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_load import ConstantTorque, InertialSpringLoad
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_train import FOLLOWERS
from camkit.motion import (
    LAWS,
    Cycloidal,
    Degree9,
    Dwell,
    FreePolynomial,
    MotionProgram,
    Poly345,
    Poly4567,
    Return,
    Rise,
    Skewed,
    SplineLaw,
)
from camkit.motion.families.shaped import FAMILIES, ShapedLaw
from camkit.motion.law import law_peaks
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
        max_pressure_angle: abs(a.pressure_angle).max(),
        base_radius: a.pitch_radius.min(),
        peak_force: abs(a.contact_force).max(),
        min_force: a.contact_force.min(),
        peak_torque: abs(a.cam_torque).max(),
        min_profile_radius: radius(a.curvature) - cam.roller_radius if cam.roller_radius else a.profile_radius.min(),
    }
    if cam.roller_radius:
        bent = abs(a.curvature) if cam.groove else a.curvature
        value |= {
            min_convex_radius: radius(a.curvature),
            min_concave_radius: radius(-a.curvature),
            undercut_margin: 1 - cam.roller_radius * bent.max(),
        }
    if not (a.undercut.any() or a.outer_undercut.any()):
        value[peak_pressure] = contact_along(a, PAIR).pressure.max()
    return value


def right(cam, n):
    """Ten times better than 0.1 %: at a needle, a radius of 0.1 mm, the table itself is no better than 5e-5."""
    found, values = cam.replace(contact=PAIR).analyse(n), expected(cam)
    sizes = {undercut_margin: 1, min_profile_radius: values[base_radius], min_force: values[peak_force]}
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
        assert max_pressure_angle(analysis) / deg == pytest.approx(26.234, abs=1e-3)
        assert peak_force(analysis) == pytest.approx(995.2, abs=0.1)
        assert undercut_margin(analysis) == pytest.approx(-8.54, abs=0.005)


def test_a_law_that_stops_with_a_jolt_is_seen_before_the_joint():
    """At the end of a harmonic rise the follower is thrown: the acceleration there belongs to no angle after it."""
    from camkit.motion import SimpleHarmonic

    cam = TranslatingRollerCam(MotionProgram((Rise(90 * deg, 20 * mm, SimpleHarmonic()), Dwell(60 * deg))), load=SLIDE)
    a, h = np.pi**2 / 2 * 20 * mm / (90 * deg) ** 2, 20 * mm
    thrown = SLIDE.resisting_force(h, -a)
    for n in (2, 7, 361):
        assert min_force(cam.analyse(n)) == pytest.approx(thrown, rel=1e-7)
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
        split *= deg
        cam = DoorHandleCam(l * mm, psi, 78 * mm, relief_cam_angle=split, motion_law=law, lift_load=ArmLoad(torque=5))
        analysis = cam.analyse(61)
        for name in ("lift", "relief"):
            for measure, value in expected(getattr(cam, name)).items():
                if measure in (min_profile_radius, min_force) or measure.name == "peak contact pressure":
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


@pytest.mark.parametrize("law", [*LAWS, Skewed(Cycloidal(), 0.4)], ids=str)
def test_peaks_of_a_law_are_those_of_its_closed_form(law):
    for stated, found in zip(law.peaks(), law_peaks(law), strict=True):
        assert np.isinf(stated) or found == pytest.approx(stated, rel=1e-10)


def test_pieces_are_searched_between_ends_of_their_own():
    """A tooth that jumps down at each end, and a population whose ends differ."""
    found = highest_between(lambda x: x % 1, (0.0, 1.0, 2.0, 2.9))
    assert found.value == pytest.approx(1, abs=1e-10)
    assert found.cam_angle == pytest.approx(1, abs=1e-10)
    end = np.array([[0.3], [0.5], [0.9]])
    many = highest_between(lambda x: x * (1 - x), (0.0, end, 1.0))
    assert_allclose(many.value, [0.25] * 3, rtol=1e-12)
    assert_allclose(many.cam_angle, [0.5] * 3, rtol=1e-9)
    assert_allclose(highest_between(lambda x: x * (1 - x), (0.0, end)).cam_angle, [0.3, 0.5, 0.5], rtol=1e-9)


# ---------------------------------------------------------------- high-speed cams


@pytest.mark.parametrize("law", [law for law in LAWS if law.name != "parabolic"], ids=lambda law: law.name)
def test_peaks_of_a_high_speed_cam(law):
    """At 5 angles as at 20001 of either interval, which are even and know nothing of the laws' kinks."""
    cam = HighSpeedCam(rise_law=law, return_law=Skewed(Cycloidal(), 0.43), spring_factor=9, rise_angle=63 * deg)
    rise, fall = cam.analyse(20_001).intervals
    few = cam.analyse(5)
    expected = {
        high_speed_measures.max_pressure_angle: [abs(part.pressure_angle).max() for part in (rise, fall)],
        high_speed_measures.peak_force: [part.contact_force.max() for part in (rise, fall)],
        high_speed_measures.peak_torque: [abs(part.cam_torque).max() for part in (rise, fall)],
        high_speed_measures.peak_stress: [np.nanmax(part.stress_coefficient) / mm**0.5 for part in (rise, fall)],
        high_speed_measures.peak_wear: [np.nanmax(part.wear_coefficient) / mm**0.5 for part in (rise, fall)],
        high_speed_measures.peak_pressure: [np.nanmax(part.contact_pressure) for part in (rise, fall)],
    }
    for measure, values in expected.items():
        assert measure(few) == pytest.approx(max(values), rel=3e-4), measure.name
    least = min(part.margin.min() for part in (rise, fall))
    assert high_speed_measures.undercut_margin(few) == pytest.approx(least, abs=3e-4)


def travel_of_345(u):
    return u**3 * (10 - 15 * u + 6 * u**2)


def least_share(cam, at):
    """Travel from either end over that of a 3-4-5 polynomial; at the ends, by the jerk there if they are dwells."""
    back = at.cam_angle > np.pi
    angle, begun = np.where(back, cam.return_angle, cam.rise_angle), np.where(back, cam.rise_angle + cam.dwell_angle, 0)
    u, s = (at.cam_angle - begun) / angle, np.where(back, 1 - at.motion.s / cam.swing, at.motion.s / cam.swing)
    bend, jerk = (abs(x) * angle**k / cam.swing for k, x in ((2, at.acceleration), (3, at.jerk)))
    share = np.minimum(s / travel_of_345(u), (1 - s) / travel_of_345(1 - u))
    limit = np.where(back, -1, 1) * at.jerk * angle**3 / cam.swing / 60
    near = np.minimum(u, 1 - u)
    ends = np.where((near < 1e-6) & (bend < 3e-9 * jerk + 1e-6), limit, np.inf)
    return np.where(near > 1e-3, share, ends)


def curves_of(analysis):
    """Every curve of a high-speed cam of which a measure is the largest value, from its definition."""
    cam, spring = analysis.cam, float(np.ravel(analysis.spring_rate)[0])

    def force(at):
        return at.resisting_torque / (cam.arm_length * np.cos(at.pressure_angle))

    def stress(at):
        return np.sqrt(force(at) / (cam.roller_radius * (1 - cam.roller_radius * at.curvature)))

    def wear(at):
        return force(at) * stress(at)

    def spring_use(at):
        moved = at.motion.s > 1e-5 * cam.swing
        return np.where(moved, -at.acceleration / np.where(moved, at.motion.s, 1), -np.inf) * cam.speed**2 / spring

    curves = {
        high_speed_measures.max_pressure_angle: lambda at: abs(at.pressure_angle),
        high_speed_measures.peak_force: force,
        high_speed_measures.peak_torque: lambda at: abs(at.resisting_torque * at.velocity),
        -high_speed_measures.undercut_margin: lambda at: cam.roller_radius * at.curvature - 1,
        -high_speed_measures.min_lead: lambda at: -least_share(cam, at),
        high_speed_measures.overrun: lambda at: np.maximum(-at.motion.s, at.motion.s - cam.swing) / cam.swing,
    }
    press = analysis.machine
    if press is cam:
        own = {high_speed_measures.spring_use: spring_use, -high_speed_measures.min_force: lambda at: -force(at)}
        return curves | own | {high_speed_measures.peak_stress: stress, high_speed_measures.peak_wear: wear}
    factor = press.inertia * press.shaft_speed**2 / (press.weight * press.lever)
    return curves | {closing_share: lambda at: -at.acceleration * factor, lever_stress: stress, lever_wear: wear}


STRESSES = (high_speed_measures.peak_stress, high_speed_measures.peak_wear, lever_stress, lever_wear)


def tops_of(analysis, curves):
    """The largest value of each curve over rise and fall: of a fine table of each piece, then of its hills closer."""
    program, pieces = analysis.cam.motion, []
    for i in (0, 2):
        for low, high in pairwise((0.0, *program.segments[i].kinks, 1.0)):
            share = low + (high - low) * np.linspace(1e-9, 1 - 1e-9, 2001)
            table = program.starts[i] + share * program.segments[i].angle
            pieces.append(zoomed(analysis, curves, table))
    return {measure: np.max([piece[measure] for piece in pieces]) for measure in curves}


def hills_of(values, most=4):
    """Where a curve is no lower than beside: its highest places."""
    padded = np.concatenate([[-np.inf], values, [-np.inf]])
    tops = np.flatnonzero((values >= padded[:-2]) & (values >= padded[2:]))
    return tops[np.argsort(values[tops])[-most:]]


def zoomed(analysis, curves, table):
    """The largest value of each curve in a table, and twice closer around its hills; those of all curves at once."""
    at, last = analysis.at(table), len(table) - 1
    values = {measure: curve(at) for measure, curve in curves.items()}
    found = {measure: value.max() for measure, value in values.items()}
    hills = [(measure, k) for measure, value in values.items() for k in hills_of(value)]
    low, high = (table[[min(max(k + step, 0), last) for _, k in hills]] for step in (-1, 1))
    for _ in range(2):
        near = np.linspace(low, high, 101, axis=-1)
        at = analysis.at(near.ravel())
        closer = {measure: curve(at).reshape(near.shape) for measure, curve in curves.items()}
        best = np.array([closer[measure][row].argmax() for row, (measure, _) in enumerate(hills)])
        for row, (measure, _) in enumerate(hills):
            found[measure] = max(found[measure], closer[measure][row, best[row]])
        rows = np.arange(len(hills))
        low, high = near[rows, np.maximum(best - 1, 0)], near[rows, np.minimum(best + 1, 100)]
    return found


def right_everywhere(analysis, measures):
    """The measures of one high-speed cam against their curves: to 0.1 %."""
    with np.errstate(all="ignore"):
        tops = tops_of(analysis, curves_of(analysis) | {"pull": lambda at: -at.resisting_torque})
    pull = tops.pop("pull")
    pressed = tops[-high_speed_measures.undercut_margin] < 0 and pull < 0
    assert set(tops) <= {*measures, *(-m for m in measures)}
    for measure, top in tops.items():
        value = measure(analysis)
        if measure in STRESSES and not pressed:
            assert np.isnan(value), measure.name
        elif measure == -high_speed_measures.undercut_margin and analysis.corner(-1).value > 0:
            assert value == np.inf
        elif measure == high_speed_measures.overrun:
            assert value == pytest.approx(top if top > 2e-6 else 0, rel=1e-3, abs=2e-6)
        elif measure != high_speed_measures.spring_use or not analysis.passes_start:  # else no spring holds the arm
            assert value == pytest.approx(top, rel=1e-3, abs=1e-5), measure.name


SOME = (0.2, 0.4, 0.6, 0.8)
FREE = {
    "3-4-5": Poly345(),
    "degree 9": Degree9((0.5, -0.4, 0.3, -0.6)),
    "B-spline": SplineLaw(SOME, (0.1, 0.4, 0.8, 0.93)),
    "free polynomial": FreePolynomial(start=(0, 0, 0, 20), end=(1, 0, 0)),
    "speed at an end": FreePolynomial(start=(0, 0), end=(1, 0.3)),
}


def random_designs(study, seed, rows, share=1.0):
    """Coefficients and sizes over a share of their bounds, a few of them as they are at the start."""
    rng, (low, high) = np.random.default_rng(seed), study.bounds
    x = low + rng.random((rows, len(low))) * (high - low)
    return study.x0 + share * np.where(rng.random(x.shape) < 0.2, 0, x - study.x0)


CASES = (
    (InertialSpringLoad(), 0.5, 9.0, 1.0),
    (InertialSpringLoad(), 1.7, 3.0, 1.0),
    (InertialSpringLoad(), 1.0, 0.0, 0.05),  # the weakest spring, which arms that pass their start do not have
    (ConstantTorque(), 1.0, 1.0, 1.0),
)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
@pytest.mark.parametrize("law", FREE)
def test_peaks_of_high_speed_cams_with_free_laws(family, law):
    for k, (load, speed, spring, share) in enumerate(CASES):
        laws = {"rise_law": ShapedLaw(FREE[law], family=family), "return_law": ShapedLaw(family=family)}
        cam = HighSpeedCam(load=load, speed=speed, spring_factor=spring, **laws)
        study = high_speed_measures.high_speed_study(cam, free_laws=True, free_spring=False)
        study = study.replace(start=cam)
        checked(study, random_designs(study, 10 * list(FREE).index(law) + k, 4, share), HighSpeedCam.measures)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
@pytest.mark.parametrize("law", FREE)
def test_peaks_of_cams_with_a_lever_and_free_laws(family, law):
    laws = {"rise_law": ShapedLaw(FREE[law], family=family), "return_law": ShapedLaw(family=family)}
    study = cam_lever_study(CamLever(shaft_speed=80 * rpm, **laws))
    checked(study, random_designs(study, list(FREE).index(law), 5), CamLever.measures)


def checked(study, x, measures):
    """Each of some designs, and all of them as one population."""
    many = study.analysis(x)
    for i, row in enumerate(x):
        try:
            one = study.design(row).analyse(5)
        except ValueError:
            assert np.isnan(many.undercut_margin[i])
            continue
        if np.isfinite(one.spring_factor):
            right_everywhere(one, measures)
        for measure in measures:
            value = np.broadcast_to(measure(many), len(x))[i]
            assert value == pytest.approx(measure(one), rel=1e-7, abs=1e-9, nan_ok=True), measure.name


@pytest.mark.parametrize(("n", "m"), [(6, 16), (20, 20), (3, 1)])
def test_peaks_of_a_valve_cam(n, m):
    for follower in FOLLOWERS:
        cam = ValveCam(n=n, m=m, follower=follower, base_radius=30 * mm)
        fine, few = cam.analyse(20_001), cam.analyse(3)
        assert max_pressure_angle(few) == pytest.approx(abs(fine.pressure_angle).max(), rel=1e-5)
        assert peak_force(few) == pytest.approx(abs(fine.contact_force).max(), rel=1e-5)
        assert valve_measures.peak_stress(few) == pytest.approx(fine.contact_stress.max(), rel=1e-5, nan_ok=True)
        assert valve_measures.peak_camshaft_torque(few) == pytest.approx(abs(fine.cam_torque).max(), rel=1e-5)
        assert valve_measures.face_reach(few) == pytest.approx(abs(fine.velocity).max(), rel=1e-5)
        tightest = (
            fine.profile_radius.min() if follower == FOLLOWERS[0] else 1 / fine.curvature.max() - cam.roller_radius
        )
        assert few.profile_margin.value == pytest.approx(tightest, abs=1e-4 * 30 * mm)


@pytest.mark.parametrize("off", [-1e-13, 0.0, 1e-13])
def test_of_two_tops_that_rounding_tells_apart_the_first_is_found(off):
    x, inner = np.linspace(0, 3, 301), np.ones(301, dtype=bool)
    inner[[0, -1]] = False
    found = highest(lambda t: np.sin(np.pi * t) ** 2 * np.where(t > 1.5, 1 + off, 1.0), x, inner)
    assert found.cam_angle == pytest.approx(0.5)
    assert highest(lambda t: np.sin(np.pi * t) ** 2 * np.where(t > 2, 1 + 1e-9, 1.0), x, inner).cam_angle > 2


def test_a_curve_that_is_infinite_or_unknown_somewhere_stays_so():
    x, inner = np.linspace(0, 3, 301), np.zeros(301, dtype=bool)
    for value in (np.inf, np.nan):
        found = highest(lambda t, value=value: np.where(abs(t - 1) < 1e-9, value, np.sin(t)), x, inner)
        assert_array_equal(found.value, value)
