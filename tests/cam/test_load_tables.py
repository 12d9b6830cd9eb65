"""What a load does at its own cam angles and travels, wherever the motion rests: against very fine tables."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import OscillatingRollerCam
from camkit.cam.follower_measures import mean_torque, min_force
from camkit.cam.force_closure import jump_speed, preload_needed
from camkit.cam.loads import ArmLoad
from camkit.cam.measures import mean_efficiency, peak_force, peak_torque
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.slide import SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.motion import Cycloidal, Dwell, FreePolynomial, MotionProgram, Poly345, Return, Rise
from camkit.units import N, deg, kg, mm, rpm

TURN = 2 * np.pi
TENT = ((121 * deg, 0.0), (125 * deg, 800.0), (129 * deg, 0.0))


def closed(lift):
    rise, back = Rise(100 * deg, lift, Poly345()), Return(90 * deg, lift, Cycloidal())
    return MotionProgram((rise, Dwell(70 * deg), back, Dwell(100 * deg)))


def tables(seed, top, size):
    """A random load over the cam angle and one over the travel, whose corners a table of 50001 angles resolves."""
    rng = np.random.default_rng(seed)
    angles = (np.arange(24) + rng.uniform(0, 0.7, 24)) / 24 * TURN
    levels = ((np.arange(9) + rng.uniform(0, 0.7, 9)) / 9 * 1.2 - 0.1) * top
    loads = size * rng.normal(size=33)
    return tuple(zip(angles, loads[:24], strict=True)), tuple(zip(levels, loads[24:], strict=True))


def cam_with(kind, seed):
    if kind in (TranslatingRollerCam, TranslatingFlatCam):
        over_angle, over_travel = tables(seed, 20 * mm, 60 * N)
        load = SlideLoad(mass=1 * kg, speed=200 * rpm, preload=60 * N, force_table=over_travel)
        return kind(closed(20 * mm), 60 * mm, load=load.replace(cam_angle_table=over_angle))
    over_angle, over_travel = tables(seed, 12 * deg, 3)
    load = ArmLoad(mass=1 * kg, speed=200 * rpm, preload=3, torque_table=over_travel, cam_angle_table=over_angle)
    return kind(closed(12 * deg), load=load)


every_kind = pytest.mark.parametrize(
    "kind", [TranslatingRollerCam, TranslatingFlatCam, OscillatingFlatCam, OscillatingRollerCam]
)


@every_kind
@pytest.mark.parametrize("seed", range(5))
def test_extremes_see_every_corner_of_a_load(kind, seed):
    cam = cam_with(kind, seed)
    a, fine = cam.analyse(31), cam.analyse(50001)
    top = abs(fine.contact_force).max()
    assert_allclose(peak_force(a), top, rtol=1e-3)
    assert_allclose(min_force(a), fine.contact_force.min(), atol=1e-3 * top)
    assert_allclose(peak_torque(a), abs(fine.cam_torque).max(), rtol=1e-3)
    lacking = -(fine.inertia * cam.load.speed**2 * fine.acceleration + fine.static_resistance - fine.preload)
    assert_allclose(preload_needed(a, cam.load.speed), max(lacking.max(), 0), rtol=1e-3)


def test_a_load_that_works_in_a_dwell_alone_is_seen():
    pushed = TranslatingRollerCam(load=SlideLoad(cam_angle_table=TENT)).analyse()
    assert_allclose(peak_force(pushed), 950, rtol=1e-6)  # 50 N preload, 20 mm of 5 N/mm, 800 N
    load = SlideLoad(cam_angle_table=tuple((x, -y) for x, y in TENT))
    pulled = TranslatingRollerCam(load=load, groove=False).analyse()
    assert_allclose(min_force(pulled), -650, rtol=1e-6)
    assert_allclose(preload_needed(pulled, 300 * rpm), 700, rtol=1e-6)
    assert jump_speed(pulled) == 0


def test_a_population_sees_the_corners_of_a_load_as_each_design_does():
    over_angle, over_travel = tables(3, 20 * mm, 60 * N)
    load = SlideLoad(mass=1 * kg, speed=200 * rpm, preload=60 * N, force_table=over_travel, cam_angle_table=over_angle)
    angles, lifts = np.array([[80.0], [110.0], [130.0]]) * deg, np.array([[8.0], [14.0], [20.0]]) * mm

    def cam(angle, lift):
        rise, back = Rise(angle, lift, Poly345()), Return(100 * deg, lift, Poly345())
        return TranslatingFlatCam(MotionProgram((rise, Dwell(60 * deg), back)), 60 * mm, load=load)

    for measure in (peak_force, min_force, peak_torque):
        alone = [measure(cam(a, h).analyse(7)) for a, h in zip(angles.ravel(), lifts.ravel(), strict=True)]
        assert_allclose(measure(cam(angles, lifts).analyse(7)), alone, rtol=1e-4)


@every_kind
def test_the_mean_torque_with_friction_is_the_same_at_any_number_of_angles(kind):
    cam = cam_with(kind, 1)
    fine = cam.analyse(50001)
    mean = np.trapezoid(fine.rubbing.cam_torque, fine.cam_angle) / fine.cam_angle[-1]
    for n in (7, 90, 721):
        assert_allclose(mean_torque(cam.analyse(n)), mean, atol=1e-3 * abs(fine.rubbing.cam_torque).mean())


# ---------------------------------------------------------------- speed that drops at once

DROPS = FreePolynomial(end=(1, 0.5, 0))


def dropping(lift):
    back = Return(120 * deg, lift, Cycloidal())
    return MotionProgram((Rise(120 * deg, lift, DROPS), Dwell(60 * deg), back, Dwell(60 * deg)))


PLATES = [
    TranslatingRollerCam(dropping(20 * mm), groove=False),
    TranslatingFlatCam(dropping(20 * mm), 60 * mm),
    OscillatingFlatCam(dropping(6 * deg)),
]
every_plate = pytest.mark.parametrize("cam", PLATES, ids=lambda cam: type(cam).__name__)


@every_plate
def test_no_spring_holds_a_follower_whose_speed_drops_at_once(cam):
    """The deceleration of a drop over ever less time is beyond every spring's force: ``m dv / dt``."""
    a = cam.analyse()
    assert a.corner(-1).value > 0
    assert jump_speed(a) == 0
    assert preload_needed(a, 100 * rpm) == np.inf
    assert preload_needed(a, 0.0) < np.inf


def test_a_groove_without_spring_follows_a_drop_of_speed():
    load = SlideLoad(spring_rate=0, preload=0)
    assert jump_speed(TranslatingRollerCam(dropping(20 * mm), load=load).analyse()) == np.inf


@every_plate
def test_no_size_keeps_a_least_radius_where_the_speed_drops(cam):
    size = cam.face_offset_for if isinstance(cam, OscillatingFlatCam) else cam.base_radius_for
    with pytest.raises(ValueError, match="speed drops at once at a cam angle of 120 deg"):
        size(min_radius=5 * mm)


def test_a_knife_edge_and_a_limit_of_the_pressure_angle_have_a_size_all_the_same():
    cam = TranslatingRollerCam(dropping(20 * mm), roller_radius=0.0, groove=False)
    assert np.isfinite(cam.base_radius_for(min_radius=0.0))
    assert np.isfinite(cam.base_radius_for(pressure_angle=30 * deg))


def test_in_a_population_the_design_whose_speed_drops_has_no_size():
    slope = np.array([[0.0], [0.5]])
    motion = MotionProgram((Rise(120 * deg, 20 * mm, FreePolynomial(end=(1, slope, 0))), Dwell(60 * deg)))
    sizes = TranslatingFlatCam(motion, 60 * mm).base_radius_for(min_radius=5 * mm)
    assert np.isfinite(sizes[0])
    assert np.isnan(sizes[1])


def test_a_rise_of_nothing_is_a_dwell():
    def efficiency(rest):
        rise, back = Rise(120 * deg, 20 * mm, Cycloidal()), Return(120 * deg, 20 * mm, Cycloidal())
        return mean_efficiency(TranslatingRollerCam(MotionProgram((rise, rest, back, rest))).analyse())

    assert_allclose(efficiency(Rise(60 * deg, 0, Cycloidal())), efficiency(Dwell(60 * deg)), rtol=1e-12)
