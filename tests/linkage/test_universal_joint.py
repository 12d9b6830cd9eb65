"""Universal joints against vector geometry, series and published cases."""

import numpy as np
import pytest

from camkit.linkage.universal_joint import (
    DOUBLE_UNIVERSAL_JOINT_MEASURES,
    UNIVERSAL_JOINT_MEASURES,
    Cross,
    DoubleUniversalJoint,
    UniversalJoint,
    angle_error,
    equivalent_angle,
    fastest,
    fluctuation,
    inertial_excitation,
    peak_acceleration,
    peak_equivalent_torque,
    peak_input_couple,
    peak_intermediate_acceleration,
    peak_intermediate_torque,
    peak_output_couple,
    peak_torque,
    slowest,
    torsional_excitation,
)
from camkit.machines.shaft import UniversalJointShaft
from camkit.units import deg, rpm

TURN = np.linspace(0, 2 * np.pi, 2881)
BENDS = (5 * deg, 20 * deg, 45 * deg, 70 * deg)
DRIVES = [
    (first * deg, second * deg, phase * deg)
    for first, second, phase in ((20, 20, 0), (20, 20, 90), (30, 12, 0), (30, 12, 35), (15, 40, -70), (0, 25, 10))
]


def around(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For a shaft in the plane z = 0: the direction square to it in that plane, and the plane's normal."""
    return np.array([-axis[1], axis[0], 0.0]), np.array([0.0, 0.0, 1.0])


def pin(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Direction of a fork's pin, ``(n, 3)``, turned by ``angle`` from where it lies in the plane z = 0."""
    inside, normal = around(axis)
    return np.cos(angle)[:, None] * inside + np.sin(angle)[:, None] * normal


def driven_pin(axis: np.ndarray, driver: np.ndarray) -> np.ndarray:
    """The other pin of a rigid cross: square to the driver's pin and to its own shaft."""
    p = np.cross(axis, driver)
    return p / np.linalg.norm(p, axis=1)[:, None]


def angle_of(axis: np.ndarray, p: np.ndarray) -> np.ndarray:
    inside, normal = around(axis)
    return np.unwrap(np.arctan2(p @ normal, p @ inside))


def shaft(angle: float) -> np.ndarray:
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def brute_force(first: float, second: float, phase: float, turn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles of intermediate and driven shaft from crosses of vectors alone, input, middle and output in Z."""
    middle = angle_of(shaft(first), driven_pin(shaft(first), pin(shaft(0), turn)))
    driver = pin(shaft(first), middle + phase)
    output = angle_of(shaft(first - second), driven_pin(shaft(first - second), driver))
    return middle - np.pi / 2, output - np.pi - phase


@pytest.mark.parametrize("bend", BENDS)
def test_one_joint_against_vectors(bend) -> None:
    middle, _ = brute_force(bend, 0.3, 0, TURN)
    a = UniversalJoint(angle=bend).analyse(len(TURN))
    assert a.output_angle == pytest.approx(middle, abs=1e-12)
    assert np.tan(a.output_angle[100]) == pytest.approx(np.tan(a.input_angle[100]) / np.cos(bend), rel=1e-12)
    assert a.lead == pytest.approx(a.output_angle - a.input_angle, abs=1e-12)


@pytest.mark.parametrize(("first", "second", "phase"), DRIVES)
def test_two_joints_against_vectors(first, second, phase) -> None:
    middle, output = brute_force(first, second, phase, TURN)
    a = DoubleUniversalJoint(first_angle=first, second_angle=second, phase=phase).analyse(len(TURN))
    assert a.intermediate_angle == pytest.approx(middle, abs=1e-12)
    gap = a.output_angle - output
    assert gap == pytest.approx(gap.mean(), abs=1e-11)
    assert gap.mean() / np.pi == pytest.approx(round(gap.mean() / np.pi), abs=1e-11)  # a pin has two ends
    assert a.lead == pytest.approx(a.output_angle - a.input_angle, abs=1e-12)


def slope(y: np.ndarray, step: float) -> np.ndarray:
    """Central difference of fourth order, the first and last two points left out."""
    return (y[:-4] - 8 * y[1:-3] + 8 * y[3:-1] - y[4:]) / (12 * step)


@pytest.mark.parametrize("bend", BENDS)
def test_speed_and_acceleration_of_one_joint_are_derivatives(bend) -> None:
    a = UniversalJoint(angle=bend, speed=30.0).analyse(len(TURN))
    time_step = TURN[1] / 30.0
    assert a.output_speed[2:-2] == pytest.approx(slope(a.output_angle, time_step), rel=1e-6)
    peak = abs(a.output_acceleration).max()
    assert a.output_acceleration[2:-2] == pytest.approx(slope(a.output_speed, time_step), abs=1e-5 * peak)


@pytest.mark.parametrize(("first", "second", "phase"), DRIVES)
def test_speed_and_acceleration_of_two_joints_are_derivatives(first, second, phase) -> None:
    drive = DoubleUniversalJoint(first_angle=first, second_angle=second, phase=phase, speed=30.0)
    a = drive.analyse(len(TURN))
    time_step = TURN[1] / 30.0
    assert a.output_speed[2:-2] == pytest.approx(slope(a.output_angle, time_step), rel=1e-8)
    assert a.intermediate_speed[2:-2] == pytest.approx(slope(a.intermediate_angle, time_step), rel=1e-8)
    size = abs(a.output_acceleration).max() + 1.0
    assert a.output_acceleration[2:-2] == pytest.approx(slope(a.output_speed, time_step), abs=1e-7 * size)
    size = abs(a.intermediate_acceleration).max() + 1.0
    assert a.intermediate_acceleration[2:-2] == pytest.approx(slope(a.intermediate_speed, time_step), abs=1e-7 * size)


def test_case_v7_a_a_fluctuation_of_100_rpm() -> None:
    """1200 rpm, 100 rpm in all: cos beta = 0.9592, 1251 and 1151 rpm (exact angle 16.42290792771 deg)."""
    joint = UniversalJoint(angle=16.42290792771 * deg, speed=1200 * rpm)
    a = joint.analyse()
    assert np.cos(joint.angle) == pytest.approx(0.9592, abs=5e-5)
    assert fluctuation(a) * joint.speed / rpm == pytest.approx(100, abs=1e-7)
    assert (fastest(a) / rpm, slowest(a) / rpm) == pytest.approx((1251, 1151), abs=0.5)
    assert fluctuation(a) == pytest.approx(np.sin(joint.angle) * np.tan(joint.angle), rel=1e-12)


def test_case_v7_b_forks_90_degrees_out_of_phase() -> None:
    """20 deg, 500 rpm: intermediate minimum 469.85, driven shaft 441.5 .. 566.2 rpm."""
    a = DoubleUniversalJoint(first_angle=20 * deg, second_angle=20 * deg, phase=90 * deg, speed=500 * rpm).analyse()
    assert a.intermediate_speed.min() / rpm == pytest.approx(469.8463103929542, abs=1e-9)
    assert slowest(a) / rpm == pytest.approx(441.5111107797445, abs=1e-9)
    assert fastest(a) / rpm == pytest.approx(566.237165715897, abs=1e-9)


@pytest.mark.parametrize("bend", BENDS)
def test_equal_angles_in_phase_cancel(bend) -> None:
    drive = DoubleUniversalJoint(first_angle=bend, second_angle=bend, speed=100.0)
    a = drive.analyse()
    assert a.speed_ratio == pytest.approx(1, abs=1e-12)
    assert a.lead == pytest.approx(0, abs=1e-12)
    assert a.output_acceleration == pytest.approx(0, abs=1e-8)
    assert equivalent_angle(a) == 0
    assert torsional_excitation(a) == 0
    assert peak_intermediate_acceleration(a) > 70  # the shaft between them shakes all the same


@pytest.mark.parametrize(("first", "second", "phase"), DRIVES)
def test_two_joints_are_as_uneven_as_one_at_the_equivalent_angle(first, second, phase) -> None:
    a = DoubleUniversalJoint(first_angle=first, second_angle=second, phase=phase).analyse(36001)
    one = UniversalJoint(angle=float(equivalent_angle(a))).analyse(36001)
    for measure in (slowest, fastest, fluctuation, angle_error, peak_acceleration):
        assert measure(a) == pytest.approx(measure(one), rel=1e-6, abs=1e-9), measure.name


def test_equivalent_angle_of_small_angles_is_the_handbooks() -> None:
    for first, second, phase in ((2.0, 3.0, 0.0), (2.0, 2.0, 90.0), (1.0, 2.5, 30.0)):
        drive = DoubleUniversalJoint(first_angle=first * deg, second_angle=second * deg, phase=phase * deg)
        handbook = (first**4 + second**4 - 2 * first**2 * second**2 * np.cos(2 * phase * deg)) ** 0.25
        a = drive.analyse()
        assert equivalent_angle(a) / deg == pytest.approx(handbook, rel=2e-3)
        assert torsional_excitation(a) == pytest.approx((drive.speed * handbook * deg) ** 2, rel=4e-3)


@pytest.mark.parametrize("bend", BENDS)
def test_the_lead_is_its_series(bend) -> None:
    t = np.tan(bend / 2) ** 2
    series = sum(t**k * np.sin(2 * k * TURN) / k for k in range(1, 80))
    assert Cross(bend, TURN).lead == pytest.approx(series, abs=1e-12)


@pytest.mark.parametrize(("first", "second", "phase"), DRIVES)
def test_excitation_is_the_second_order_of_the_motion(first, second, phase) -> None:
    """Orders of the lead by Fourier transform; acceleration of order 2 is 4 omega^2 times it."""
    a = DoubleUniversalJoint(first_angle=first, second_angle=second, phase=phase, speed=40.0).analyse(4097)
    orders = abs(np.fft.rfft(a.lead[:-1])) / 2048
    assert torsional_excitation(a) == pytest.approx(4 * 40.0**2 * orders[2], abs=1e-9)
    assert orders[1::2] == pytest.approx(0, abs=1e-13)
    orders = abs(np.fft.rfft(a.first.lead[:-1])) / 2048
    assert inertial_excitation(a) == pytest.approx(4 * 40.0**2 * orders[2], abs=1e-9)


@pytest.mark.parametrize("bend", BENDS)
def test_couples_against_vectors(bend) -> None:
    """Frictionless pins pass a couple square to both; what of it is not along a shaft bends that shaft."""
    a = UniversalJoint(angle=bend, torque=250.0).analyse(len(TURN))
    input_axis, output_axis = shaft(0), shaft(bend)
    driver = pin(input_axis, TURN)
    driven = driven_pin(output_axis, driver)
    normal = np.cross(driver, driven)
    passed = (250.0 / (normal @ input_axis))[:, None] * normal
    assert a.output_torque == pytest.approx(passed @ output_axis, rel=1e-10)
    bends_input = passed - 250.0 * input_axis
    assert bends_input == pytest.approx(-a.input_couple[:, None] * np.cross(input_axis, driver), abs=1e-9)
    bends_output = passed - (passed @ output_axis)[:, None] * output_axis
    size = abs(a.output_couple).max()
    assert np.linalg.norm(bends_output, axis=1) == pytest.approx(abs(a.output_couple), abs=1e-9 * size)
    along = (bends_output * np.cross(output_axis, driven)).sum(1)
    assert abs(along) == pytest.approx(abs(a.output_couple), abs=1e-9 * size)
    assert peak_input_couple(a) == pytest.approx(250.0 * np.tan(bend), rel=1e-6)
    assert peak_torque(a) == pytest.approx(250.0 / np.cos(bend), rel=1e-6)


def passed_on(axis: np.ndarray, torque: np.ndarray, pin: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The couple that a frictionless cross passes on, square to both pins, with ``torque`` along ``axis``."""
    normal = np.cross(pin, other)
    return (torque / (normal @ axis))[:, None] * normal


@pytest.mark.parametrize("bend", [5 * deg, 15 * deg, 20 * deg, 44 * deg])
def test_torque_and_bending_of_the_shaft_behind_a_joint_over_a_turn(bend) -> None:
    """The vectors added up: torque ``T cos .. T / cos``, couple at most ``T sin``, none where the torque is largest."""
    axis = shaft(bend)
    driver = pin(shaft(0), TURN)
    passed = passed_on(shaft(0), np.full(len(TURN), 250.0), driver, driven_pin(axis, driver))
    torque = passed @ axis
    couple = np.linalg.norm(passed - torque[:, None] * axis, axis=1)
    assert (torque.min(), torque.max()) == pytest.approx((250 * np.cos(bend), 250 / np.cos(bend)), rel=1e-6)
    assert couple.max() == pytest.approx(250 * np.sin(bend), rel=1e-6)
    assert couple[np.argmax(torque)] == pytest.approx(0, abs=1e-9)
    assert np.linalg.norm(passed, axis=1).max() == pytest.approx(250 / np.cos(bend), rel=1e-6)
    a = DoubleUniversalJoint(first_angle=bend, second_angle=0.0, torque=250.0).analyse(len(TURN))
    assert a.equivalent_torque == pytest.approx(np.linalg.norm(passed, axis=1), rel=1e-10)
    assert peak_intermediate_torque(a) == pytest.approx(torque.max(), rel=1e-12)
    assert UniversalJointShaft(joint_angle=bend).tube_torque == pytest.approx(
        UniversalJointShaft().torque / 250 * peak_equivalent_torque(a), rel=1e-6
    )


@pytest.mark.parametrize(("first", "second", "phase"), DRIVES)
def test_the_intermediate_shaft_between_two_joints_over_a_turn(first, second, phase) -> None:
    """Torque and bending at both its ends, and at places between them, from crosses of vectors."""
    middle_axis, last_axis = shaft(first), shaft(first - second)
    driver = pin(shaft(0), TURN)
    middle = driven_pin(middle_axis, driver)
    start = passed_on(shaft(0), np.full(len(TURN), 250.0), driver, middle)
    other = pin(middle_axis, angle_of(middle_axis, middle) + phase)
    end = passed_on(middle_axis, start @ middle_axis, other, driven_pin(last_axis, other))
    along = np.array([np.linalg.norm(start + share * (end - start), axis=1) for share in np.linspace(0, 1, 21)])
    a = DoubleUniversalJoint(first_angle=first, second_angle=second, phase=phase, torque=250.0).analyse(len(TURN))
    assert a.equivalent_torque == pytest.approx(along.max(0), rel=1e-10)
    if phase == 0 and second <= first:
        assert peak_equivalent_torque(a) == pytest.approx(250 / np.cos(first), rel=1e-6)
    if first == second and phase == 90 * deg:  # badly put together: both at once
        assert peak_equivalent_torque(a) == pytest.approx(250 / np.cos(first) ** 2, rel=1e-6)


def test_power_is_kept() -> None:
    a = UniversalJoint(angle=35 * deg, torque=80.0, speed=20.0).analyse()
    assert a.output_torque * a.output_speed == pytest.approx(80.0 * 20.0, rel=1e-12)
    drive = DoubleUniversalJoint(first_angle=30 * deg, second_angle=10 * deg, phase=20 * deg, inertia=3.0, speed=20.0)
    a = drive.analyse(2881)
    flow = drive.torque * drive.speed - a.output_torque * a.output_speed
    energy = drive.inertia * a.intermediate_speed**2 / 2
    assert flow[2:-2] == pytest.approx(slope(energy, TURN[1] / 20.0), abs=1e-6 * abs(flow).max())
    assert np.trapezoid(flow, a.input_angle) == pytest.approx(0, abs=1e-9 * abs(flow).max())


def test_couple_on_the_driven_shaft_is_that_of_its_own_joint() -> None:
    a = DoubleUniversalJoint(first_angle=0.0, second_angle=25 * deg, torque=60.0).analyse()
    one = UniversalJoint(angle=25 * deg, torque=60.0).analyse()
    assert peak_output_couple(a) == pytest.approx(peak_output_couple(one), rel=1e-12)
    assert a.input_couple == pytest.approx(0, abs=1e-15)


def test_a_straight_joint_does_nothing() -> None:
    a = UniversalJoint(angle=0.0).analyse()
    assert (a.speed_ratio == 1).all()
    assert (a.lead == 0).all()
    assert (a.input_couple == 0).all()
    assert (a.output_acceleration == 0).all()


def test_a_population_equals_its_members() -> None:
    rng = np.random.default_rng(2)
    rows = rng.uniform((0, 0, -1.5, 1, -50, 0), (1.2, 1.2, 1.5, 90, 50, 2), (12, 6))
    fields = ("first_angle", "second_angle", "phase", "speed", "torque", "inertia")
    together = DoubleUniversalJoint(**dict(zip(fields, rows.T[..., None], strict=True))).analyse()
    assert together.output_speed.shape == (12, 361)
    for measure in DOUBLE_UNIVERSAL_JOINT_MEASURES:
        alone = [measure(DoubleUniversalJoint(*map(float, row)).analyse()) for row in rows]
        assert measure(together) == pytest.approx(alone, rel=1e-11), measure.name
    singles = UniversalJoint(angle=rows[:, :1], speed=rows[:, 3:4], torque=rows[:, 4:5]).analyse()
    for measure in UNIVERSAL_JOINT_MEASURES:
        alone = [measure(UniversalJoint(float(r[0]), float(r[3]), float(r[4])).analyse()) for r in rows]
        assert measure(singles) == pytest.approx(alone, rel=1e-12), measure.name


def test_what_a_population_cannot_turn_is_nan_alone() -> None:
    angles = np.array([[20.0], [90.0], [120.0], [-5.0]]) * deg
    assert np.isfinite(fluctuation(UniversalJoint(angle=angles).analyse())).tolist() == [True, False, False, False]
    both = DoubleUniversalJoint(second_angle=angles).analyse()
    assert np.isfinite(torsional_excitation(both)).tolist() == [True, False, False, False]
    assert np.isfinite(fluctuation(both)).tolist() == [True, False, False, False]


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: UniversalJoint(angle=90 * deg), "the angle is 90 deg; a universal joint turns below 90 deg only"),
        (
            lambda: DoubleUniversalJoint(first_angle=95 * deg),
            "the first angle is 95 deg; a universal joint turns below 90 deg only",
        ),
        (
            lambda: DoubleUniversalJoint(second_angle=180 * deg),
            "the second angle is 180 deg; a universal joint turns below 90 deg only",
        ),
        (
            lambda: UniversalJoint(angle=-5 * deg),
            "the angle (between the shafts) is -5 deg; it must be a finite number of at least 0 deg",
        ),
        (
            lambda: DoubleUniversalJoint(inertia=-1.0),
            "the inertia (intermediate shaft with its forks) is -1 kg m^2; "
            "it must be a finite number of at least 0 kg m^2",
        ),
    ],
)
def test_refusals(make, said) -> None:
    with pytest.raises(ValueError, match=r".") as refused:
        make()
    assert str(refused.value) == said


def test_joints_are_measured_at_angles_enough():
    joint = DoubleUniversalJoint()
    fine = abs(joint.analyse(100_001).intermediate_torque).max()
    assert abs(joint.analyse(61).intermediate_torque).max() == pytest.approx(fine, rel=2e-3)
    with pytest.raises(ValueError, match=r"^the number of input angles is 3; it must be a whole number of at least 61"):
        joint.analyse(3)
