"""Universal joints in a row against forks and crosses turned in space, two joints, one joint, and published angles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from camkit import Measure, Study, minimise
from camkit.linkage import DoubleUniversalJoint, Driveline, UniversalJoint
from camkit.linkage.universal_joint import UNIVERSAL_JOINT_MEASURES
from camkit.quantities import quantities_of, with_quantities
from camkit.units import deg
from camkit.views import default_views

few = settings(max_examples=25, deadline=None)
bend = st.floats(0, 40).map(lambda x: round(x, 2) * deg)
twist = st.floats(-90, 90).map(lambda x: round(x, 1) * deg)


@st.composite
def lines(draw, least=1):
    n = draw(st.integers(least, 5))
    rows = (tuple(draw(each) for _ in range(k)) for each, k in ((bend, n), (twist, n - 1), (twist, n - 1)))
    return Driveline(*rows)


def rotation(axis, angle):
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def turned_in_space(line, phi):
    """Angle of the driven shaft: each cross makes a pin square to the one before, each shaft carries it on."""
    along, normal = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    pin = np.outer(np.cos(phi), np.cross(normal, along)) + np.outer(np.sin(phi), normal)
    for i, angle in enumerate(line.angles):
        along = rotation(normal, angle) @ along
        pin = np.cross(along, pin)
        pin /= np.linalg.norm(pin, axis=1)[:, None]
        if i < len(line.phases):
            pin = pin @ rotation(along, line.phases[i]).T
            normal = rotation(along, line.planes[i]) @ normal
    first = pin[0]
    return np.unwrap(np.arctan2(pin @ np.cross(along, first), pin @ first))


@few
@given(lines())
def test_the_driven_shaft_turns_as_forks_and_crosses_in_space(line):
    a = line.analyse(721)
    angle = turned_in_space(line, a.input_angle)
    assert_allclose(angle, a.output_angle - a.output_angle[0], atol=1e-9)
    h = 1e-5
    near = [turned_in_space(line, np.concatenate([[0.0], a.input_angle + x]))[1:] for x in (-h, h)]
    assert_allclose(a.speed_ratio, (near[1] - near[0]) / (2 * h), atol=1e-8)
    slope = (line.analyse(721).speed_ratio[2:] - a.speed_ratio[:-2]) / (a.input_angle[2] - a.input_angle[0])
    peak = abs(a.output_acceleration).max()
    assert_allclose(a.output_acceleration[1:-1] / line.speed**2, slope, atol=2e-3 * (1 + peak / line.speed**2))


@few
@given(lines())
def test_it_is_as_uneven_as_the_equivalent_joint(line):
    a = line.analyse(3601)
    one = UniversalJoint(angle=float(a.equivalent_angle)).analyse(3601)
    assert a.speed_ratio.max() == pytest.approx(one.speed_ratio.max(), abs=2e-5)
    assert a.speed_ratio.min() == pytest.approx(one.speed_ratio.min(), abs=2e-5)
    assert_allclose(a.output_torque * a.output_speed, line.torque * line.speed)


def test_three_joints_in_one_plane():
    a = Driveline((10 * deg, 8 * deg, 6 * deg)).analyse(3601)
    assert a.speed_ratio.min() == pytest.approx(0.9890381, abs=1e-7)
    assert a.speed_ratio.max() == pytest.approx(1.0110834, abs=1e-7)
    assert np.degrees(a.equivalent_angle) == pytest.approx(8.491367, abs=1e-6)
    assert np.degrees(a.handbook_angle) == pytest.approx(np.sqrt(100 - 64 + 36), abs=1e-9)
    crossed = Driveline((10 * deg, 8 * deg, 6 * deg), (90 * deg, 90 * deg)).analyse()
    assert np.degrees(crossed.handbook_angle) == pytest.approx(np.sqrt(100 + 64 + 36), abs=1e-9)
    four = Driveline((4 * deg, 7 * deg, 5 * deg, 3 * deg)).analyse()
    assert np.degrees(four.handbook_angle) == pytest.approx(np.sqrt(abs(16 - 49 + 25 - 9)), abs=1e-9)


@few
@given(bend, bend, twist)
def test_two_joints_are_the_double_joint(first, second, phase):
    double = DoubleUniversalJoint(first, second, phase, 50.0, 80.0).analyse()
    line = Driveline((first, second), (phase,), speed=50.0, torque=80.0).analyse()
    for measure in UNIVERSAL_JOINT_MEASURES:
        assert measure(line) == pytest.approx(measure(double), rel=1e-9, abs=1e-9)
    assert line.second_order == pytest.approx(double.second_order, rel=1e-9, abs=1e-15)
    assert line.inertial_excitation == pytest.approx(double.inertial_excitation)


def test_what_is_not_in_one_plane():
    """A plane turned by 90 deg is undone by forks turned by 90 deg; half a turn of a plane changes nothing."""
    flat, angles = Driveline((12 * deg, 12 * deg)).analyse(), (12 * deg, 12 * deg)
    assert np.ptp(flat.speed_ratio) == pytest.approx(0, abs=1e-12)
    assert np.ptp(Driveline(angles, planes=(90 * deg,)).analyse().speed_ratio) > 0.08
    assert np.ptp(Driveline(angles, (90 * deg,), (90 * deg,)).analyse().speed_ratio) == pytest.approx(0, abs=1e-12)
    assert np.ptp(Driveline(angles, planes=(180 * deg,)).analyse().speed_ratio) == pytest.approx(0, abs=1e-12)


@few
@given(lines(least=2), st.integers(1, 4))
def test_the_best_phase_is_the_best(line, shaft):
    shaft = min(shaft, len(line.phases))
    found, tried = line.best_phase(shaft), np.linspace(-90, 90, 181)[:, None] * deg

    def unevenness(phase):
        phases = (*line.phases[: shaft - 1], phase, *line.phases[shaft:])
        return line.replace(phases=phases).analyse(61).second_order

    assert -90 * deg - 1e-6 <= found <= 90 * deg
    assert unevenness(found) <= unevenness(tried).min() + 1e-15
    solved = line.replace(forks=1).analyse()
    last = line.best_phase(len(line.phases))
    assert solved.phases == (*line.phases[:-1], last)
    assert solved.second_order <= line.analyse().second_order + 1e-15


def test_it_is_a_design_like_others():
    line = Driveline((10 * deg, 8 * deg, 6 * deg))
    assert {"angle2", "phase1", "plane0", "speed", "torque"} <= set(quantities_of(line))
    assert with_quantities(line, {"phase1": 0.3}).phases == (0.0, 0.3)
    uneven = next(m for m in line.measures if m.name == "equivalent angle")
    skew = line.replace(phases=(20 * deg, 10 * deg))
    best = minimise(Study(skew, ["phase1"], (uneven,)), seed=1).f
    assert best == pytest.approx(uneven(skew.replace(forks=1).analyse()), abs=1e-6)
    many = line.replace(angles=(10 * deg, np.array([[2.0], [8.0]]) * deg, 6 * deg)).analyse()
    for i, angle in enumerate((2, 8)):
        one = line.replace(angles=(10 * deg, angle * deg, 6 * deg)).analyse()
        for measure in line.measures:
            assert isinstance(measure, Measure)
            assert np.broadcast_to(measure(many), 2)[i] == pytest.approx(measure(one), rel=1e-9)
    pins = line.analyse().pins(0.7)
    assert all(abs(before @ behind) < 1e-12 for before, behind in pins)
    assert [view(line.analyse()) is not None for view in default_views(line.analyse())] == [True] * 5


def test_refusals():
    with pytest.raises(ValueError, match=r"^the driveline has 3 joints, 1 phases and 2 planes; it must have one joint"):
        Driveline((0.1, 0.1, 0.1), (0.0,))
    with pytest.raises(ValueError, match=r"^joint angle 2 is 90 deg; a universal joint turns below 90 deg only$"):
        Driveline((0.1, 90 * deg))
    with pytest.raises(
        ValueError, match=r"^the shaft whose phase is wanted is 3; it must be a whole number from 1 to 2$"
    ):
        Driveline().best_phase(3)
