"""Plane geometry against complex numbers, triangles laid out by their corners, and curves differentiated."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit.geometry import angle_opposite, circle, offset_curvature, polar_angle, rotated

coordinates = st.floats(-1, 1)
angles = st.floats(-10, 10)
sides = st.floats(0.01, 10)


@given(coordinates, coordinates, angles)
@settings(deadline=None)
def test_to_rotate_is_to_multiply_by_a_complex_unit(x, y, angle):
    z = (x + 1j * y) * np.exp(1j * angle)
    assert_allclose(rotated(np.array([x, y]), angle), [z.real, z.imag], atol=1e-15)


def test_shapes_of_rotated_points():
    points = np.ones((2, 4, 7))
    assert rotated(points, 0.3).shape == (2, 4, 7)
    assert rotated(points, np.zeros(7)).shape == (2, 4, 7)
    assert rotated(np.ones((2, 7)), np.zeros((4, 1))).shape == (2, 4, 7)
    assert_array_equal(rotated(points, np.zeros((4, 7))), points)


@given(st.floats(0.1, 5), st.floats(-3.1, 3.1))
@settings(deadline=None)
def test_polar_angle_is_the_argument(radius, angle):
    assert polar_angle(radius * np.array([np.cos(angle), np.sin(angle)])) == pytest.approx(angle, abs=1e-12)


@given(sides, sides, st.floats(0.01, 3.13))
@settings(deadline=None)
def test_the_angle_of_a_triangle_laid_out_by_its_corners(first, second, angle):
    third = np.hypot(first - second * np.cos(angle), second * np.sin(angle))
    assert_allclose(angle_opposite(third, first, second), angle, atol=1e-6)


@given(sides, sides)
@settings(deadline=None)
def test_a_triangle_that_does_not_close_has_no_angle(first, second):
    for side in (1.001 * (first + second), 0.999 * abs(first - second) - 1e-3):
        assert side < 0 or np.isnan(angle_opposite(side, first, second))
    member = angle_opposite(np.array([[first], [3 * (first + second)]]), first, second)
    assert np.isnan(member).tolist()[1] == [True]


def test_a_circle_closes_and_keeps_its_radius():
    points = circle((3.0, -2.0), 0.5, 25)
    assert points.shape == (2, 25)
    assert_allclose(points[:, 0], points[:, -1], atol=1e-15)
    assert_allclose(np.hypot(points[0] - 3, points[1] + 2), 0.5)


def three_point_curvature(points):
    """One over the radius of the circle through three neighbours, convex > 0 on a counter-clockwise curve."""
    a, b, c = points[:, :-2], points[:, 1:-1], points[:, 2:]
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return 2 * area / (np.hypot(*(b - a)) * np.hypot(*(c - b)) * np.hypot(*(c - a)))


@pytest.mark.parametrize("distance", [-0.3, 0.0, 0.7])
def test_curvature_of_a_parallel_curve_of_an_ellipse(distance):
    turn = np.linspace(0, 2 * np.pi, 20001)
    ellipse = np.array([2 * np.cos(turn), np.sin(turn)])
    normal = np.array([np.cos(turn), 2 * np.sin(turn)])
    parallel = ellipse + distance * normal / np.hypot(*normal)
    kappa = 2 / (4 * np.sin(turn) ** 2 + np.cos(turn) ** 2) ** 1.5
    assert_allclose(offset_curvature(kappa, distance)[1:-1], three_point_curvature(parallel), rtol=1e-5)


@given(st.floats(-50, 50), st.floats(-0.01, 0.01))
@settings(max_examples=50, deadline=None)
def test_an_offset_and_back_is_the_same_curve(kappa, distance):
    assert offset_curvature(offset_curvature(kappa, distance), -distance) == pytest.approx(kappa, rel=1e-9, abs=1e-12)


def test_an_offset_by_the_radius_is_a_point():
    assert np.isinf(offset_curvature(10.0, -0.1))
    assert offset_curvature(0.0, 0.1) == 0
