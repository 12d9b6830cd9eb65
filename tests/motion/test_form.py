"""Errors of form: derivatives by differences, first-order formulas, and yields by parts made one by one."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, Study, TranslatingRollerCam, deg, mm
from camkit.cam import OscillatingRollerCam, TranslatingFlatCam
from camkit.cam.measures import max_pressure_angle, min_convex_radius
from camkit.motion import FormedProgram, FormError
from camkit.quantities import quantities_of, value_of, with_quantities

A, K = 0.01 * mm, 12
PROGRAM = MotionProgram(
    (Rise(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg), Return(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg))
)
PLAIN = TranslatingRollerCam(motion=PROGRAM, base_radius=30 * mm, roller_radius=8 * mm, offset=0.0)


def wavy(**error):
    return PLAIN.replace(motion=FormError(**{"amplitude": A, "waves": K, **error}).on(PROGRAM))


def test_it_rides_on_the_motion_and_its_derivatives():
    error = FormError(0.02 * mm, A, 0.3, K)
    program, phi = error.on(PROGRAM), np.linspace(0, 2 * np.pi, 2001)
    for made, wanted, rides in zip(program(phi), PROGRAM(phi), error.at(phi), strict=True):
        assert_allclose(made, wanted + rides, atol=1e-15)
    assert_allclose(error.at(phi).s, 0.02 * mm + A * np.cos(K * phi + 0.3))
    step = 1e-5
    for k in range(3):
        difference = (error.at(phi + step)[k] - error.at(phi - step)[k]) / (2 * step)
        assert_allclose(error.at(phi)[k + 1], difference, atol=1e-7 * A * K ** (k + 1) * K)


def test_the_pressure_angle_of_a_sliding_roller():
    """From ``tan(alpha) = v / (h_0 + s)`` to first order in ``e``; at most ``A k / 38 mm`` = 0.181 deg."""
    plain = PLAIN.analyse(3601)
    for phase in (0.0, 1.0, 2.5):
        made = wavy(phase=phase).analyse(3601)
        change = made.pressure_angle - plain.pressure_angle
        e, slope = FormError(0.0, A, phase, K).at(plain.cam_angle)[:2]
        height = 38 * mm + plain.motion.s
        first = np.cos(plain.pressure_angle) ** 2 * (slope - plain.motion.v * e / height) / height
        assert_allclose(change, first, atol=3e-6)
        assert abs(change).max() / deg == pytest.approx(0.181, abs=1e-3)


def test_the_curvature_where_the_follower_rests():
    """First order: ``A (k^2 - 1) / R^2`` on the dwell, where the pitch curve is a circle of 38 mm."""
    plain, made = (cam.analyse(3601) for cam in (PLAIN, wavy()))
    rests = plain.cam_angle > 305 * deg
    change = (made.curvature - plain.curvature)[rests]
    assert change.max() == pytest.approx(A * (K**2 - 1) / (38 * mm) ** 2, rel=0.01)
    assert change.min() == pytest.approx(-A * (K**2 - 1) / (38 * mm) ** 2, rel=0.01)


@pytest.mark.parametrize("waves", [1, 12, 90])
def test_no_wave_is_overlooked_however_many_there_are(waves):
    """Extremes against 36001 cam angles."""
    cam = wavy(waves=waves, amplitude=A / waves)
    assert max_pressure_angle(cam.analyse()) == pytest.approx(abs(cam.analyse(36001).pressure_angle).max(), rel=1e-4)
    radius = 1 / cam.analyse(36001).curvature.max()
    assert min_convex_radius(cam.analyse()) == pytest.approx(radius, rel=1e-3)


def test_an_offset_is_a_larger_cam_for_every_follower():
    for kind in (TranslatingFlatCam, TranslatingRollerCam):
        cam = kind(motion=PROGRAM, base_radius=30 * mm)
        made = cam.replace(motion=FormError(0.5 * mm).on(PROGRAM)).analyse()
        assert_allclose(made.profile, cam.replace(base_radius=30.5 * mm).analyse().profile, atol=1e-12)
    arm = OscillatingRollerCam()
    turned = arm.replace(motion=FormError(0.01).on(arm.motion)).analyse()
    assert_allclose(turned.pitch, arm.replace(start_angle=arm.start_angle + 0.01).analyse().pitch, atol=1e-12)


def test_a_profile_without_an_error_is_the_one_that_is_wanted():
    none = PLAIN.replace(motion=FormError(waves=1).on(PROGRAM)).analyse()
    assert_allclose(none.pressure_angle, PLAIN.analyse().pressure_angle, atol=1e-15)
    assert max_pressure_angle(none) == pytest.approx(max_pressure_angle(PLAIN.analyse()), rel=1e-12)


def test_its_numbers_have_paths():
    cam = wavy()
    own = [path for path in quantities_of(cam) if ".form." in path]
    assert own == ["motion.form.offset", "motion.form.amplitude", "motion.form.phase"]
    assert [quantities_of(cam)[path].unit for path in own] == ["mm", "mm", "deg"]
    other = with_quantities(cam, {"motion.form.amplitude": 2 * A, "motion.rise.angle": 130 * deg})
    assert isinstance(other.motion, FormedProgram)
    assert (other.motion.form.amplitude, other.motion.form.waves) == (2 * A, K)
    assert value_of(other, "motion.rise.angle") == 130 * deg
    assert other.motion.span == pytest.approx(2 * np.pi)


def test_a_yield_with_waves_is_that_of_parts_made_one_by_one():
    limit = max_pressure_angle(PLAIN.analyse()) + 0.06 * deg
    study = Study(wavy(amplitude=0.0), ["base_radius"], (min_convex_radius,), at_most={max_pressure_angle: limit})
    robust = study.under({"motion.form.amplitude": (0.0, A), "motion.form.phase": 180 * deg, "base_radius": 0.1 * mm})
    x = np.array([30.02 * mm])
    z = np.random.default_rng(5).uniform(-1, 1, (300, 3))
    parts = robust.made(x[None], z)[0]
    kept = [
        max_pressure_angle(wavy(amplitude=a, phase=p).replace(base_radius=r).analyse(study.angles)) <= limit
        for r, a, p in parts
    ]
    assert_array_equal(robust.judged(parts).feasible, kept)
    share = robust.recheck(x, 2**12).share[0]
    assert 0.3 < share < 0.9
    assert share == pytest.approx(np.mean(kept), abs=0.09)


@pytest.mark.parametrize(
    ("error", "said"),
    [
        ({"amplitude": -A}, "the amplitude"),
        ({"waves": 0}, "the number of waves in a turn is 0; it must be a whole number of at least 1"),
        ({"waves": 2.5}, "the number of waves in a turn is 2.5"),
        ({"offset": float("nan")}, "the offset"),
    ],
)
def test_what_is_no_error_of_form_is_refused(error, said):
    with pytest.raises(ValueError, match=said):
        FormError(**error)
