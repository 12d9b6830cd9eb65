"""The polynomial valve cam against published numbers, a linear solve, finite differences and brute-force envelopes.

Source of the published system: He Zhenjun, Li Xuefeng, Mech. Sci. Technol. Aerosp. Eng. 27(10) 2008, 1141-1144;
reference values recomputed from its formulas to 9 digits.
"""

import re
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from camkit.cam.follower_measures import jump_margin
from camkit.cam.force_closure import jump_speed, preload_needed
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.geometry import rotated
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import (
    LOWER,
    PAPER_BOX,
    PAPER_MIN_RADIUS,
    UPPER,
    VALVE_MEASURES,
    corner,
    corrected_valve_study,
    fullness,
    in_paper_units,
    keeping_min_radius,
    listed_deceleration,
    min_radius,
    nose_acceleration,
    nose_deceleration,
    nose_radius,
    peak_acceleration,
    valve_front_study,
    valve_study,
)
from camkit.machines.valve_train import FLAT, ROLLER, ValveLoad
from camkit.search.minimise import minimise
from camkit.study.study import Study
from camkit.units import deg, mm, rpm

DESIGNS = [(3, 1), (5, 4), (20, 20), (6.37, 12.9)]


def grid(steps: int) -> np.ndarray:
    n, m = (np.linspace(*PAPER_BOX[k], steps) for k in ("n", "m"))
    return np.stack(np.meshgrid(n, m, indexing="ij"), axis=-1).reshape(-1, 2)


# --- the polynomial ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("n", "m", "exponents", "coefficients", "xi", "a", "nose"),
    [
        (20, 20, (2, 40, 80, 120), (-14.2159788, 1.96010934, -0.954377671, 0.210247077), 0.638392546, -862.722, 9.7189),
        (3, 1, (2, 6, 8, 10), (-31.5133102, 61.5196759, -61.4120370, 18.4056713), 0.471828583, -1912.441, -19.825),
    ],
)
def test_reference_designs(n, m, exponents, coefficients, xi, a, nose):
    analysis = ValveCam(n=n, m=m).analyse()
    assert_allclose(analysis.exponents, exponents)
    assert_allclose(analysis.coefficients / mm, coefficients, rtol=1e-8)
    assert_allclose(analysis.fullness, xi, rtol=1e-9)
    assert_allclose(analysis.nose_acceleration, a, rtol=1e-6)
    assert_allclose(analysis.nose_radius / mm, nose, atol=5e-4)


def test_reference_lifts():
    cam = ValveCam(n=5, m=4)
    assert_allclose(cam.motion(np.array([20, 40]) * deg).s / mm, [4.28289096, 10.54697463], rtol=1e-9)
    analysis = cam.analyse(63)
    assert_allclose(analysis.cam_angle[[20, 40]], np.array([20, 40]) * deg)
    assert_allclose(analysis.lift[[20, 40]] / mm, [4.28289096, 10.54697463], rtol=1e-9)
    assert_allclose(cam.seating_slope / mm, 1.0610330, rtol=1e-7)
    assert_allclose(cam.seating_slope * cam.half_angle / mm, 1.1481481, rtol=1e-7)


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_coefficients_solve_the_boundary_conditions(n, m):
    cam = ValveCam(n=n, m=m)
    e = np.array([2, 2 * n, 2 * n + 2 * m, 2 * n + 4 * m])
    rows = np.stack([e**0, e, e * (e - 1), e * (e - 1) * (e - 2)])
    conditions = [-cam.max_lift, -cam.seating_slope * cam.half_angle, 0, 0]
    assert_allclose(cam.analyse().coefficients, np.linalg.solve(rows, conditions), rtol=1e-10)


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_boundary_conditions(n, m):
    cam = ValveCam(n=n, m=m)
    analysis = cam.analyse()
    size = abs(analysis.coefficients).sum()
    assert_allclose(analysis.lift[[0, -1]], [0, 13 * mm], atol=1e-14 * size)
    assert_allclose(analysis.velocity[[0, -1]], [0.2 / (1800 * rpm), 0], atol=1e-11 * size)
    assert_allclose(analysis.acceleration[0], 0, atol=1e-9 * size)
    assert_allclose(analysis.jerk[0], 0, atol=1e-7 * size)


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_derivatives_are_finite_differences(n, m):
    cam, d = ValveCam(n=n, m=m), 1e-5
    alpha = np.linspace(0.01, 2 * cam.half_angle - 0.01, 500)  # both flanks
    alpha = alpha[abs(alpha - cam.half_angle) > 1e-3]
    before, at, after = (cam.motion(alpha + x) for x in (-d, 0, d))
    for lower, higher in pairwise(range(4)):
        difference = (after[lower] - before[lower]) / (2 * d)
        assert_allclose(difference, at[higher], atol=2e-6 * abs(at[higher]).max())


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_fullness_is_the_mean_lift(n, m):
    analysis = ValveCam(n=n, m=m).analyse(20001)
    mean = np.trapezoid(analysis.lift, analysis.cam_angle) / analysis.cam_angle[-1]
    assert_allclose(analysis.fullness, mean / (13 * mm), rtol=1e-7)


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_extremes_are_those_of_a_very_fine_table(n, m):
    cam = ValveCam(n=n, m=m)
    fine = cam.analyse(400_001)
    for coarse in (cam.analyse(), cam.analyse(181)):
        assert_allclose(coarse.peak_acceleration, fine.acceleration.max() * cam.load.speed**2, rtol=1e-7)
        assert_allclose(coarse.profile_margin.value, fine.flat.profile_radius.min(), atol=1e-8)
        assert_allclose(coarse.profile_margin.cam_angle, fine.cam_angle[fine.flat.profile_radius.argmin()], atol=1e-5)
    assert_allclose(cam.analyse().nose_radius, fine.flat.profile_radius[-1], rtol=1e-12)


def test_jerk_at_the_nose():
    pointed = ValveCam(n=1.2, m=4)  # 2n < 3: h''' ~ b^(2n - 3), down to -inf before the nose, from inf after it
    assert pointed.analyse().jerk[-1] == np.inf
    before, after = pointed.motion(pointed.half_angle + np.array([-1e-9, 1e-9])).j
    assert_allclose(after, -before)
    assert before < 1e3 * pointed.analyse().jerk[-2] < 0
    assert ValveCam(n=1.6, m=4).analyse().jerk[-1] == 0


# --- the whole cam ----------------------------------------------------------------------------------------------------


def test_nothing_jumps_on_the_whole_cam():
    cam, hair = ValveCam(n=5, m=4), 1e-9
    blend = cam.ramp_angle / 3
    opening = np.array([-cam.ramp_angle, blend - cam.ramp_angle, 0.0])
    seams = np.concatenate([opening, [cam.half_angle], 2 * cam.half_angle - opening])
    before, after = cam.motion(seams - hair), cam.motion(seams + hair)
    for left, right, size in zip(before, after, (13 * mm, 13 * mm, 100 * mm, 1.0), strict=True):
        assert_allclose(left, right, atol=1e-6 * size)


def test_ramp():
    cam = ValveCam()
    ramp = np.linspace(-cam.ramp_angle, 0, 20001)
    at = cam.motion(ramp)
    assert_allclose(at.s[[0, -1]], [-cam.ramp_height, 0], atol=1e-15)
    assert_allclose(np.trapezoid(at.v, ramp), cam.ramp_height, rtol=1e-8)
    assert_allclose(np.trapezoid(at.a, ramp), cam.seating_slope, rtol=1e-8)
    assert_allclose(at.v[-10000:], cam.seating_velocity / cam.load.speed)
    assert_allclose(np.gradient(at.s, ramp)[1:-1], at.v[1:-1], atol=1e-9)
    assert_allclose(np.gradient(at.v, ramp)[1:-1], at.a[1:-1], atol=1e-6)
    assert_allclose(np.gradient(at.a, ramp)[1:-1], at.j[1:-1], atol=1e-4)


def test_without_a_seating_velocity_there_is_no_ramp():
    analysis = ValveCam(seating_velocity=0.0).analyse()
    assert analysis.cam.ramp_height == 0
    assert_allclose(analysis.whole.lift.min(), 0, atol=1e-15)
    assert_allclose(analysis.velocity[0], 0, atol=1e-12)


@pytest.mark.parametrize("follower", [FLAT, ROLLER])
def test_the_whole_cam_is_closed_and_symmetric(follower):
    analysis = ValveCam(follower=follower).analyse()
    whole = analysis.whole
    assert_allclose(whole.profile[:, 0], whole.profile[:, -1], atol=1e-12)
    assert_allclose(whole.lift, whole.lift[::-1], atol=1e-15)
    assert_allclose(whole.velocity, -whole.velocity[::-1], atol=1e-12)
    base = whole.lift == whole.lift.min()
    assert_allclose(np.hypot(*whole.profile)[base], analysis.cam.base_radius - analysis.cam.ramp_height)
    assert_allclose(np.hypot(*whole.profile).max(), 34 * mm)
    assert_allclose(whole.lift[360], 13 * mm)


def test_the_event_runs_from_ramp_to_ramp():
    cam = ValveCam()
    event = cam.analyse(101).event
    assert event.cam_angle.shape == (201,)
    assert_allclose(event.cam_angle[[0, 100, 200]] / deg, (-25, 62, 149))
    assert_allclose(event.lift[[0, -1]], -cam.ramp_height)
    assert set(event.stretch) == {"opening ramp", "opening flank", "closing flank", "closing ramp"}


def test_every_point_of_the_whole_cam_belongs_to_a_stretch():
    whole = ValveCam().analyse().whole
    assert_allclose(whole.turn_range, whole.cam_angle[[0, -1]])
    for words, lowest, highest_ in (
        ("opening ramp", -25, 0), ("opening flank", 0, 62), ("closing flank", 62, 124), ("closing ramp", 124, 149),
    ):  # fmt: skip
        here = whole.cam_angle[whole.stretch == words] / deg
        assert lowest - 1e-9 <= here.min() < lowest + 0.51
        assert highest_ - 0.51 < here.max() <= highest_ + 1e-9
    assert (whole.lift[whole.stretch == "base circle"] == whole.lift.min()).all()


def test_time_derivatives_are_those_of_the_turning_cam():
    cam, dt = ValveCam(), 1e-7
    analysis = cam.analyse()
    before, after = (cam.motion(analysis.cam_angle[50:-50] + x * dt * cam.load.speed) for x in (-1, 1))
    moves = analysis.in_time
    for k in range(3):
        scale = cam.load.speed**k
        difference = (after[k] - before[k]) * scale / (2 * dt)
        assert_allclose(difference, moves[k + 1][50:-50], atol=1e-5 * abs(moves[k + 1]).max())


def test_the_spring_that_is_needed_is_what_the_resistance_lacks():
    event = ValveCam().analyse().event
    for speed in (event.cam.load.speed, event.top_speed):
        open_ = event.is_open
        assert_allclose((event.spring_force - event.needed_at(speed))[open_], event.force_at(speed)[open_], atol=1e-9)
        assert (event.needed_at(speed)[~open_] == 0).all()


def test_the_base_circle_that_keeps_the_limit_everywhere():
    for n, m in DESIGNS:
        cam = keeping_min_radius(ValveCam(n=n, m=m))
        assert_allclose(cam.analyse(100_001).profile_radius.min(), PAPER_MIN_RADIUS, rtol=1e-6)
    assert_allclose(keeping_min_radius(ValveCam(n=20, m=20)).base_radius / mm, 24.341, atol=5e-4)


def test_lift_table():
    cam = ValveCam()
    table = cam.analyse().lift_table
    angle, lift, velocity, acceleration, radius = table.values()
    assert_allclose(angle, np.arange(-180, 180))
    assert_allclose(lift.min(), 0, atol=1e-12)
    assert lift[180] == lift.max()
    assert_allclose(lift[180], 13 + cam.ramp_height / mm)
    assert_allclose(lift[1:180], lift[:180:-1], atol=1e-12)
    assert_allclose(lift[180 - 42] - cam.ramp_height / mm, cam.motion(20 * deg).s / mm)
    step = np.roll(lift, -1) - lift  # every degree, the last one too, is what slope and bend at its ends make of it
    slope, bend = (velocity + np.roll(velocity, -1)) / 2, (np.roll(acceleration, -1) - acceleration) / 12
    assert_allclose(step, slope * deg - bend * deg**2, atol=1e-4)
    assert_allclose(radius[180], cam.analyse().nose_radius / mm)


# --- geometry, by brute force: the follower stands still on the cam at two close angles ------------------------------


def line_envelope(cam: ValveCam, alpha: np.ndarray, d: float = 1e-5) -> np.ndarray:
    """Where the face at ``alpha - d`` cuts the face at ``alpha + d``, on the cam."""
    normals = np.stack([rotated(np.array([0.0, 1.0]), -(alpha + x)) for x in (-d, d)])  # (2 faces, 2, n)
    heights = np.stack([cam.base_radius + cam.motion(alpha + x).s for x in (-d, d)])
    return np.linalg.solve(np.moveaxis(normals, -1, 0), heights.T[..., None])[..., 0].T


def circle_envelope(cam: ValveCam, alpha: np.ndarray, d: float = 1e-5) -> np.ndarray:
    """Where the roller at ``alpha - d`` cuts the roller at ``alpha + d``, on the side of the cam axis."""
    r = cam.roller_radius
    first, second = (
        rotated(np.stack([0 * alpha, cam.base_radius + r + cam.motion(alpha + x).s]), -(alpha + x)) for x in (-d, d)
    )
    along = second - first
    half = np.hypot(*along) / 2
    inward = np.stack([-along[1], along[0]]) / (2 * half)
    inward *= np.where((inward * first).sum(0) > 0, -1, 1)
    return (first + second) / 2 + np.sqrt(r**2 - half**2) * inward


@pytest.mark.parametrize(
    "cam", [ValveCam(follower=ROLLER), ValveCam(n=20, m=20, roller_radius=3 * mm, follower=ROLLER)]
)
def test_radii_under_a_roller_are_those_of_a_fine_table(cam):
    fine = 1 / cam.analyse(200_001).profile_curvature
    coarse = cam.analyse(91)
    assert_allclose(coarse.profile_margin.value, fine[fine > 0].min(), rtol=1e-7)
    assert_allclose(coarse.min_concave_radius, -fine[fine < 0].max(), rtol=1e-7)


@pytest.mark.parametrize("least", [4.5, 30])
def test_the_base_circle_for_a_least_radius_under_a_roller(least):
    cam = keeping_min_radius(ValveCam(follower=ROLLER), least * mm)
    assert_allclose(cam.analyse(200_001).profile_margin.value, least * mm, rtol=1e-6)
    smaller = cam.replace(base_radius=0.999 * cam.base_radius)
    assert smaller.analyse().profile_margin.value < least * mm


def test_a_flat_face_has_no_hollow_cam():
    assert ValveCam().analyse().min_concave_radius == np.inf


ENVELOPES = [(FLAT, line_envelope), (ROLLER, circle_envelope)]


@pytest.mark.parametrize(("follower", "envelope"), ENVELOPES)
@pytest.mark.parametrize(("n", "m"), [(6, 16), (20, 20), (5, 4)])
def test_profile_is_the_envelope_of_the_follower(follower, envelope, n, m):
    analysis = ValveCam(n=n, m=m, follower=follower).analyse().whole
    assert_allclose(analysis.profile, envelope(analysis.cam, analysis.cam_angle), atol=1e-8)


@pytest.mark.parametrize(("follower", "envelope"), ENVELOPES)
@pytest.mark.parametrize(("n", "m"), [(6, 16), (20, 20), (3, 1)])
def test_radius_is_that_of_the_envelope(follower, envelope, n, m):
    """``rho = ds / dtheta``: how far the contact runs along the tangent while the tangent turns."""
    cam, d = ValveCam(n=n, m=m, follower=follower), 1e-4
    analysis = cam.analyse().whole
    alpha = analysis.cam_angle
    points = [envelope(cam, alpha + x) for x in (-d, 0, d)]
    chord = points[2] - points[0]
    turned = rotated(np.stack(np.broadcast_arrays(1.0, np.tan(analysis.pressure_angle))), -alpha)
    tangent = turned / np.hypot(*turned)
    slopes = [cam.analyse().at(alpha + x).pressure_angle - (alpha + x) for x in (-d, d)]
    brute = -(slopes[1] - slopes[0]) / (chord * tangent).sum(0)
    scale = 1 / (5 * mm)
    assert_allclose(
        np.clip(analysis.profile_curvature, -scale, scale), np.clip(brute, -scale, scale), atol=2e-4 * scale
    )


@pytest.mark.parametrize(("n", "m"), DESIGNS)
def test_roller_radius_is_the_circle_through_three_points(n, m):
    """No tangent, no slope: three neighbouring points of the brute-force envelope, and their circle."""
    cam = ValveCam(n=n, m=m, follower=ROLLER)
    alpha = np.linspace(0.02, cam.half_angle, 200)
    a, b, c = (circle_envelope(cam, alpha + x) for x in (-3e-4, 0, 3e-4))
    area = (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]
    sides = np.hypot(*(b - a)) * np.hypot(*(c - b)) * np.hypot(*(c - a))
    curvature = -2 * area / sides  # the contact runs clockwise round the cam
    analysis = cam.analyse().at(alpha)
    assert not analysis.undercut.any()
    assert_allclose(analysis.profile_curvature, curvature, atol=1e-3 / (5 * mm))
    assert_allclose(1 / analysis.profile_curvature, analysis.profile_radius)


def test_face_and_roller_touch_and_never_cut():
    flat, roller = (ValveCam(n=6, m=16, follower=f).analyse(2881).whole for f in (FLAT, ROLLER))
    assert not flat.undercut.any()
    assert not roller.undercut.any()
    at = slice(None, None, 10)
    up = rotated(np.array([0.0, 1.0]), -flat.cam_angle[at])
    assert_allclose((flat.profile.T @ up).max(0), flat.cam.base_radius + flat.lift[at], atol=1e-12)
    centres = roller.pitch[:, at]
    gap = np.hypot(*(roller.profile[:, :, None] - centres[:, None])).min(0)
    assert_allclose(gap, roller.cam.roller_radius, atol=1e-12)


def test_undercut_is_seen_where_the_envelope_is_cut():
    sharp = ValveCam(n=3, m=1).analyse(1441).whole
    assert sharp.undercut.any()
    up = rotated(np.array([0.0, 1.0]), -sharp.cam_angle)
    inside = (sharp.profile.T @ up).max(0) - (sharp.cam.base_radius + sharp.lift)
    assert inside.max() > 0.1 * mm
    assert np.isnan(sharp.contact_stress[sharp.undercut]).all()


def test_least_radius_and_the_base_radius_it_asks_for():
    cam = ValveCam(n=20, m=20)
    analysis = cam.analyse()
    assert_allclose(analysis.profile_margin.value / mm, 1.159, atol=5e-4)
    assert_allclose(analysis.profile_margin.cam_angle / deg, 12.571, atol=5e-4)
    needed = analysis.base_radius_for(4.5 * mm)
    assert_allclose(needed / mm, 24.341, atol=5e-4)
    assert_allclose(cam.replace(base_radius=float(needed)).analyse().profile_margin.value, 4.5 * mm, rtol=1e-9)


# --- forces -----------------------------------------------------------------------------------------------------------


def min_force(cam: ValveCam, over: float) -> float:
    """Least force on the open valve at ``over`` times the cam's speed, looked for in a very fine table."""
    flank = cam.analyse(100_001)
    lift, curve = flank.lift, flank.acceleration
    train = cam.load
    force = train.mass * (over * train.speed) ** 2 * curve + train.spring_rate * lift + train.preload
    return force.min()


def preload_for(analysis):
    """Least preload that holds the follower up to the speed margin."""
    return preload_needed(analysis, analysis.top_speed)


@pytest.mark.parametrize("share", [0.3, 0.4, 1.0])
def test_the_sized_spring_holds_up_to_the_margin_and_no_further(share):
    cam = ValveCam(n=8, m=5, speed_margin=0.2).with_spring(share)
    assert_allclose(cam.load.preload / (cam.load.preload + cam.load.spring_rate * cam.max_lift), share)
    assert min_force(cam, 1.0) > 0
    assert_allclose(min_force(cam, 1.2), 0, atol=1e-4)
    assert min_force(cam, 1.2 * 1.001) < -0.1
    whole = cam.analyse(3601).whole
    assert (whole.resistance[whole.is_open] > 0).all()
    assert (whole.resistance[~whole.is_open] == 0).all()


def test_preload_for_a_rate():
    cam = ValveCam(load=ValveLoad(0.4, spring_rate=8000.0, preload=180.0))
    cam = cam.replace(load=cam.load.replace(preload=float(preload_for(cam.analyse()))))
    assert_allclose(min_force(cam, 1 + cam.speed_margin), 0, atol=1e-4)
    assert_allclose(jump_speed(cam.analyse()), 1.15 * cam.load.speed, rtol=1e-6)
    assert_allclose(jump_margin(cam.analyse()), 0.15, rtol=1e-5)


def test_a_strong_spring_needs_no_more():
    analysis = ValveCam(load=ValveLoad(spring_rate=1e6, preload=5000.0)).analyse()
    assert preload_for(analysis) == 0
    assert jump_margin(analysis) > 1


def test_what_resists_besides_the_spring_helps_to_hold_the_follower():
    """A constant force and a table of the lift, on either flank alike: the sized spring is so much weaker."""
    load = ValveLoad(force=40.0, force_table=((0.0, 0.0), (13 * mm, 26.0)), gravity=9.81)
    cam = ValveCam(load=load)
    sprung, whole = cam.with_spring(), cam.analyse(361).whole
    fine = sprung.analyse(100_001)
    others = 40 + 2000 * fine.lift + 9.81 * load.mass
    spring = sprung.load.preload + sprung.load.spring_rate * fine.lift
    lacks = -load.mass * fine.top_speed**2 * fine.acceleration - others - spring
    assert lacks.max() == pytest.approx(0, abs=1e-4)
    assert sprung.load.preload < ValveCam().with_spring().load.preload - 10
    assert_allclose(whole.resistance, whole.resistance[::-1], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("follower", [FLAT, ROLLER])
def test_under_either_follower_it_is_a_cam_of_the_family(follower):
    """Geometry and forces of the whole turn as a sliding follower without an offset has them, from its own angles."""
    cam = ValveCam(n=8, m=5, follower=follower)
    sizes = {"motion": cam.motion, "base_radius": cam.base_radius, "load": cam.load}
    rolls = {"roller_radius": cam.roller_radius, "groove": False}
    one = TranslatingFlatCam(**sizes) if follower == FLAT else TranslatingRollerCam(**sizes, **rolls)
    family = one.analyse(361)
    ours = cam.analyse().at(family.cam_angle)
    for name in ("profile", "profile_curvature", "pressure_angle", "undercut", "lift"):
        assert_allclose(getattr(ours, name), getattr(family, "travel" if name == "lift" else name), atol=1e-15)
    open_ = ours.is_open
    assert_allclose(ours.contact_force[open_], family.contact_force[open_], rtol=1e-12)
    assert cam.motion.periodic
    assert all(joint.order is None for joint in cam.motion.transitions())


def test_force_at_another_speed():
    analysis = ValveCam().analyse()
    assert_allclose(analysis.force_at(0.0), analysis.spring_force)
    assert_allclose(analysis.force_at(analysis.cam.load.speed), analysis.resistance)
    assert analysis.force_at(0.999 * jump_speed(analysis)).min() > 0
    assert analysis.force_at(1.01 * jump_speed(analysis)).min() < 0


@pytest.mark.parametrize(("follower", "envelope"), ENVELOPES)
def test_torque_is_the_moment_of_the_contact_force(follower, envelope):
    """Moment about the cam axis of the force in the brute-force contact point, along the brute-force normal."""
    analysis = ValveCam(follower=follower).analyse().whole
    alpha = analysis.cam_angle
    x, y = envelope(analysis.cam, alpha)
    after, before = (envelope(analysis.cam, alpha + d) for d in (1e-5, -1e-5))
    tx, ty = (after - before) / np.hypot(*(after - before))
    push = np.stack([-ty, tx])  # out of the cam, on the follower
    up = rotated(np.array([0.0, 1.0]), -alpha)
    force = push * analysis.resistance / (push * up).sum(0)  # its part along the line of travel is known
    assert_allclose(x * force[1] - y * force[0], analysis.cam_torque, atol=2e-4 * analysis.cam_torque.max())
    assert_allclose(np.hypot(*force), abs(analysis.contact_force), rtol=1e-5, atol=1e-3)


def test_power_balance_of_the_torque():
    analysis = ValveCam().analyse(20001)
    cam, lift = analysis.cam, 13 * mm
    assert_allclose(analysis.cam_torque * cam.load.speed, analysis.resistance * analysis.velocity * cam.load.speed)
    work = np.trapezoid(analysis.cam_torque, analysis.cam_angle)
    spring = cam.load.preload * lift + cam.load.spring_rate * lift**2 / 2
    kinetic = -cam.load.mass * cam.seating_velocity**2 / 2  # the train comes up the ramp with the seating velocity
    assert_allclose(work, spring + kinetic, rtol=1e-6)


@pytest.mark.parametrize("angles", [181, 720, 721])
def test_the_mean_torque_of_a_turn_is_zero(angles):
    """Without friction the spring gives back what it took."""
    whole = ValveCam().analyse(angles).whole
    assert abs(np.trapezoid(whole.cam_torque, whole.cam_angle)) < 1e-11 * whole.cam_torque.max()


def test_contact_stress():
    """Over the nose, from Hertz's formula written out: ``p0^2 = F E / (2 pi (1 - nu^2) b rho)`` for like metals."""
    flat, roller = (ValveCam(follower=f).analyse() for f in (FLAT, ROLLER))
    E, b, rr = 210e9, 14 * mm, flat.cam.roller_radius
    F = flat.resistance[-1]
    p0 = np.sqrt(F * E / (2 * np.pi * (1 - 0.3**2) * b * flat.nose_radius))
    assert_allclose(flat.contact_stress[-1], p0)
    rho = roller.profile_radius[-1]
    assert_allclose(roller.contact_stress[-1], np.sqrt(F * E / (2 * np.pi * (1 - 0.3**2) * b) * (1 / rho + 1 / rr)))
    assert flat.whole.contact_stress[0] == 0  # the lash is open
    assert_allclose(flat.contact.shear_depth / flat.contact.half_width, 0.786151, atol=1e-6)


# --- the paper's problem and the corrected ones -----------------------------------------------------------------------


def test_the_listing_mixes_units():
    cam = in_paper_units(ValveCam())
    assert_allclose(cam.seating_slope * cam.half_angle / mm, 0.0657840, atol=5e-8)
    assert_allclose(cam.seating_slope * cam.half_angle / mm, 0.2 * 62 / (1800 * rpm))
    K = fullness(corner(cam, UPPER)), listed_deceleration(corner(cam, LOWER))
    assert_allclose(K, (0.637143792, 599.758), rtol=1e-6)
    a = cam.replace(n=3, m=1).analyse()
    assert_allclose(599.758, -2 * a.coefficients[0] / mm / 62**2 * (1800 * rpm) ** 2, rtol=1e-6)
    K = fullness(corner(ValveCam(), UPPER)), nose_deceleration(corner(ValveCam(), LOWER))
    assert_allclose(K, (0.638392546, 1912.441), rtol=1e-6)


@pytest.mark.parametrize("cam", [ValveCam(), ValveCam(max_lift=9 * mm, half_angle=70 * deg, seating_velocity=0.4)])
def test_what_is_weighed_is_over_the_largest_of_the_same_cam_in_the_box(cam):
    """Whatever else the cam is: the box is searched with a grid that holds its corners."""
    x = grid(9)
    for study, at in ((valve_study(), cam), (valve_study(paper_units=True), in_paper_units(cam))):
        e = study.around(cam).evaluate(x)
        plain = Study(at, PAPER_BOX, (fullness, nose_deceleration), at_least={nose_radius: PAPER_MIN_RADIUS}, angles=91)
        known = plain.evaluate(x)
        assert_allclose(e.f[:, 0], 0.5 * (known.f * [-1, 1] / known.f.max(0)).sum(1), rtol=1e-12)
        assert_allclose(e.g, known.g, rtol=1e-12)
    e, known = corrected_valve_study(cam).evaluate(x), Study(cam, PAPER_BOX, (fullness, peak_acceleration), angles=91)
    known = known.evaluate(x).f
    assert_allclose(e.f[:, 0], 0.5 * (known * [-1, 1] / known.max(0)).sum(1), rtol=1e-7)


def test_fullness_and_wear_agree():
    """Both get better with either exponent, so there is nothing to weigh."""
    steps = 35
    analysis = valve_study().analysis(grid(steps))
    for values in (analysis.fullness, analysis.nose_acceleration):
        values = values.reshape(steps, steps)
        assert (np.diff(values, axis=0) > 0).all()
        assert (np.diff(values, axis=1) > 0).all()


@pytest.mark.parametrize("paper_units", [False, True])
def test_with_the_size_of_the_acceleration_every_weight_gives_the_corner(paper_units):
    x = grid(25)
    for w in np.linspace(0, 1, 11):
        result = valve_study(weights=(w, 1 - w), paper_units=paper_units).evaluate(x)
        best = np.where(result.feasible, result.f[:, 0], np.inf).argmin()
        assert_allclose(x[best], (20, 20))


def at_the_limit(m: float) -> float:
    """The n at which the radius at the nose is 4.5 mm."""
    return brentq(lambda n: ValveCam(n=n, m=m).analyse().nose_radius - PAPER_MIN_RADIUS, 3, 20, xtol=1e-13)


def test_with_the_printed_sign_the_optimum_jumps():
    n = at_the_limit(20)
    sharp, far = ValveCam(n=n, m=20).analyse(), ValveCam(n=20, m=20).analyse()
    assert_allclose(n, 4.827593, atol=5e-7)
    assert_allclose(sharp.fullness, 0.5893091, atol=5e-8)
    assert_allclose(sharp.nose_acceleration, -1048.152, atol=5e-4)
    K1, K2 = fullness(corner(ValveCam(), UPPER)), nose_deceleration(corner(ValveCam(), LOWER))
    gain = (far.fullness - sharp.fullness) / K1
    loss = (far.nose_acceleration - sharp.nose_acceleration) / K2
    switch = loss / (gain + loss)
    assert_allclose(switch, 0.5577, atol=5e-5)

    edge = [(at_the_limit(m), m) for m in np.linspace(2, 20, 19)]
    x = np.concatenate([edge, grid(35)])
    for w, best in ((0.1, edge[-1]), (switch - 1e-3, edge[-1]), (switch + 1e-3, (20, 20)), (0.9, (20, 20))):
        result = valve_study(weights=(w, 1 - w), printed_sign=True).evaluate(x)
        kept = result.g[:, 0] <= 1e-9  # the edge itself is kept up to rounding
        assert_allclose(x[np.where(kept, result.f[:, 0], np.inf).argmin()], best)


def test_no_exponents_meet_the_limit_everywhere():
    study = corrected_valve_study()
    x = grid(35)
    assert not study.evaluate(x).feasible.any()
    assert min_radius(study.analysis(x)).max() < 2.2 * mm
    assert (nose_radius(study.analysis(x)) > PAPER_MIN_RADIUS).any()  # what the paper looks at is kept
    kept = corrected_valve_study(ValveCam(base_radius=24.342 * mm)).evaluate([[20, 20]])
    assert kept.feasible.all()
    assert not corrected_valve_study(ValveCam(base_radius=24.340 * mm)).evaluate([[20, 20]]).feasible.any()


def test_the_corrected_problem_has_something_to_weigh():
    start, x = ValveCam(base_radius=24.5 * mm), grid(35)
    best = []
    for w in (0.5, 0.8, 0.95):
        result = corrected_valve_study(start, (w, 1 - w)).evaluate(x)
        assert result.feasible.any()
        best.append(x[np.where(result.feasible, result.f[:, 0], np.inf).argmin()])
    assert len({tuple(b) for b in best}) == 3


def least_acceleration(full):
    """Least peak acceleration of a cam with at least this fullness, m/s^2."""
    limits = {fullness: full, nose_radius: PAPER_MIN_RADIUS}
    found = minimise(Study(ValveCam(n=20, m=20), PAPER_BOX, (peak_acceleration,), at_least=limits, angles=91))
    assert found.feasible
    return found.f


def test_the_front_of_fullness_against_acceleration():
    """Published to three digits of fullness: between the ends of what rounds to it, up to 0.5 % above the least."""
    for full, most in ((0.586, 4938), (0.600, 5887), (0.617, 7980), (0.630, 10798)):
        assert least_acceleration(full - 0.0005) < most < 1.005 * least_acceleration(full + 0.0005)
    assert least_acceleration(0.6375) < 13895
    # two of them to the last digit: the upper corner, and (n, m) from a finer scan
    exact = valve_front_study().evaluate([[20, 20], [6, 19.4]])
    assert_allclose(-exact.f[:, 0], (0.638393, 0.600000), atol=1e-6)
    assert_allclose(exact.f[:, 1], (13895, 5887), atol=0.5)


def test_a_front_may_be_limited_anywhere_and_have_other_bounds():
    study = valve_front_study(ValveCam(base_radius=24.5 * mm), min_radius, {"n": (10, 20), "m": (5, 20)})
    assert_allclose(study.bounds, [[10, 5], [20, 20]])
    ((measure, limit, sense),) = study.limits
    assert (measure, limit, sense) == (min_radius, PAPER_MIN_RADIUS, -1)
    assert study.evaluate([[12, 6], [12, 8]]).feasible.tolist() == [False, True]


# --- what cannot be built, and populations ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"n": 1.0}, "the n (second exponent 2n) is 1; it must be a finite number above 1"),
        ({"m": 0.0}, "the m (third and fourth exponent 2n + 2m, 2n + 4m) is 0; it must be a finite number above 0"),
        ({"m": 1e-4}, "the exponents are 2, 12, 12.0002, 12.0004; each must lie at least 0.001 above the one before"),
        (
            {"n": 1.0001, "m": 4},
            "the exponents are 2, 2.0002, 10.0002, 18.0002; each must lie at least 0.001 above the one before",
        ),
        (
            {"half_angle": 0.0},
            "the half angle (cam angle of one flank, start to nose) is 0 deg; it must be a finite number above 0 deg",
        ),
        (
            {"half_angle": 160 * deg},
            "two flanks and two ramps need 370 deg of the cam; there are 360 deg",
        ),
        (
            {"base_radius": 0.3 * mm},
            "the base radius is 0.3 mm and the ramp 0.3858 mm high; the base circle must keep some radius",
        ),
        (
            {"max_lift": np.nan},
            "the maximum lift (lift at the nose) is nan mm; it must be a finite number above 0 mm",
        ),
    ],
)
def test_refusals(changes, sentence):
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        ValveCam(**changes)


def test_a_share_that_cannot_be_is_refused():
    with pytest.raises(ValueError, match=r"^the preload's share of the full force is 0; it must lie above 0, up to 1$"):
        ValveCam().with_spring(0)


COLUMNS = {
    "n": (20, 5, 1.0, 6.37, 3, 8, 8, 8, 8),
    "m": (20, 4, 4, 12.9, 1, 1e-9, 5, 5, 5),
    "half_angle": tuple(np.array([62, 70, 62, 60, 55, 62, 62, 0, 62]) * deg),
    "base_radius": tuple(np.array([21, 25, 21, 30, 21, 21, 21, 21, 0.1]) * mm),
    "speed": tuple(np.array([1800, 1500, 1800, 2000, 900, 1800, 0, 1800, 1800]) * rpm),
    "spring_rate": (30e3, 20e3, 30e3, 40e3, 30e3, 30e3, 30e3, 30e3, 30e3),
}
CANNOT = (2, 5, 6, 7, 8)
ARRAYS = ("motion", "profile_radius", "profile_curvature", "pressure_angle", "cam_angle")
FORCES = ("spring_force", "resistance", "contact_force", "contact", "cam_torque")
NUMBERS = ("fullness", "nose_acceleration", "peak_acceleration", "nose_radius", "min_concave_radius")


def in_columns(columns, follower):
    """A valve cam with some of its own quantities and some of its load's."""
    of_load = {k: columns[k] for k in ("speed", "spring_rate")}
    own = {k: v for k, v in columns.items() if k not in of_load}
    return ValveCam(**own, follower=follower, load=ValveLoad(**of_load))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("follower", [FLAT, ROLLER])
def test_a_population_is_its_members(follower):
    many = in_columns({k: np.array(v)[:, None] for k, v in COLUMNS.items()}, follower)
    analysis = many.analyse(91)
    sprung = many.with_spring()
    assert analysis.coefficients.shape == analysis.exponents.shape == (4, 9)
    for i in range(9):
        if i in CANNOT:
            assert np.isnan(analysis.lift[i]).all()
            assert np.isnan(analysis.whole.profile[:, i]).all()
            assert np.isnan([measure(analysis)[i] for measure in VALVE_MEASURES]).all()
            continue
        cam = in_columns({k: v[i] for k, v in COLUMNS.items()}, follower)
        one = cam.analyse(91)
        assert_allclose(analysis.coefficients[:, i], one.coefficients, rtol=1e-12)
        for name in ARRAYS + FORCES:
            ours, theirs = (getattr(a, name) for a in (analysis, one))
            assert_allclose(np.array(ours)[..., i, :], theirs, rtol=1e-9, atol=1e-9, err_msg=name)
        for name in NUMBERS:
            assert_allclose(getattr(analysis, name)[i], getattr(one, name), rtol=1e-9, atol=1e-12, err_msg=name)
        for number in (jump_speed, preload_for, lambda a: a.profile_margin, lambda a: a.roller.curvature[..., -1]):
            assert_allclose(np.array(number(analysis))[..., i], number(one), rtol=1e-9, atol=1e-12)
        for measure in VALVE_MEASURES:
            assert_allclose(measure(analysis)[i], measure(one), rtol=1e-9)
        assert_allclose(analysis.whole.profile[:, i], one.whole.profile, atol=1e-12)
        assert_allclose(analysis.event.lift[i], one.event.lift, atol=1e-12)
        assert_allclose(analysis.in_time.a[i], one.in_time.a, rtol=1e-9, atol=1e-6)
        assert_allclose(analysis.needed_at(100.0)[i], one.needed_at(100.0), rtol=1e-9, atol=1e-9)
        assert (analysis.whole.stretch[i] == one.whole.stretch).all()
        assert_allclose(sprung.load.spring_rate[i, 0], cam.with_spring().load.spring_rate)
        assert_allclose(sprung.load.preload[i, 0], cam.with_spring().load.preload)


def test_measures_of_a_single_cam_are_numbers():
    analysis = ValveCam().analyse()
    assert all(np.ndim(measure(analysis)) == 0 for measure in VALVE_MEASURES)
    assert nose_acceleration(analysis) < 0 < peak_acceleration(analysis)
    assert 0 < fullness(analysis) < 1
