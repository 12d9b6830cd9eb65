"""Zeros of functions with two harmonics: the unit-circle roots of a quartic, and what a fine sampling sees."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from camkit.linkage.limits import harmonics, slope, value, zeros

few = settings(max_examples=50, deadline=None)
number = st.floats(-3, 3).map(lambda x: round(x, 3))
five_numbers = st.tuples(*[number] * 5)


def function(c0, c1, s1, c2, s2):
    return lambda x: c0 + c1 * np.cos(x) + s1 * np.sin(x) + c2 * np.cos(2 * x) + s2 * np.sin(2 * x)


def unit_circle_roots(c0, c1, s1, c2, s2):
    """The textbook's way: numpy's roots of the quartic in ``z`` that have modulus 1."""
    one, two = (c1 - 1j * s1) / 2, (c2 - 1j * s2) / 2
    roots = np.roots([two, one, c0, np.conj(one), np.conj(two)])
    return np.sort(np.mod(np.angle(roots[abs(abs(roots) - 1) < 1e-9]), 2 * np.pi))


@few
@given(five_numbers)
def test_five_samples_tell_the_whole_function_and_its_slope(numbers):
    f, angle, h = function(*numbers), np.linspace(0, 7, 29), 1e-6
    c = harmonics(f)
    assert value(c, angle) == pytest.approx(f(angle), abs=1e-13)
    assert value(slope(c), angle) == pytest.approx((f(angle + h) - f(angle - h)) / (2 * h), abs=1e-8)


def clear(f):
    """Whether no two zeros are about to merge, which nobody could tell from none."""
    extremes = zeros(slope(harmonics(f)))
    return np.min(abs(f(extremes[np.isfinite(extremes)])), initial=1) > 1e-3


@few
@given(five_numbers)
def test_zeros_are_what_sampling_sees(numbers):
    f = function(*numbers)
    assume(clear(f))
    found = zeros(harmonics(f))
    found = found[np.isfinite(found)]
    assert f(found) == pytest.approx(0, abs=1e-12)
    angle = np.linspace(0, 2 * np.pi, 20001) + 1.2345e-5
    assert len(found) == np.sum(np.diff(np.sign(f(angle))) != 0)


@few
@given(five_numbers)
def test_zeros_are_the_unit_circle_roots(numbers):
    f = function(*numbers)
    assume(clear(f) and np.hypot(numbers[3], numbers[4]) > 0.1)
    found, roots = zeros(harmonics(f)), unit_circle_roots(*numbers)
    assert np.isfinite(found).sum() == len(roots)
    for root in roots:
        assert np.nanmin(abs(np.exp(1j * found) - np.exp(1j * root))) < 1e-9


@pytest.mark.parametrize(
    ("numbers", "degrees"),
    [
        ((0, 1, 0, 0, 0), [90, 270]),
        ((-0.5, 0, 1, 0, 0), [30, 150]),
        ((0, 0, 0, 1, 0), [45, 135, 225, 315]),
        ((0, 0, 0, 0, 1), [0, 90, 180, 270]),
        ((1, 0, 0, 0, 0), []),
        ((2, 1, 0, 0, 0), []),
        ((-0.5, 1, 0, 1e-15, 0), [60, 300]),
    ],
)
def test_a_quartic_that_loses_its_leading_terms(numbers, degrees):
    found = zeros(harmonics(lambda angle: function(*numbers)(angle) + 0 * angle))
    found = np.mod(np.degrees(found[np.isfinite(found)]) + 1e-9, 360) - 1e-9
    assert np.sort(found) == pytest.approx(np.array(degrees, float), abs=1e-8)


def test_a_population_is_its_members_and_one_that_is_not_a_number_disturbs_nobody():
    rng = np.random.default_rng(5)
    c = rng.normal(size=(50, 5))
    c[7] = np.nan
    together = zeros(c)
    assert together.shape == (50, 4)
    assert np.isnan(together[7]).all()
    for one, row in zip(c, together, strict=True):
        np.testing.assert_allclose(row, zeros(one), rtol=0, atol=1e-12)


@pytest.mark.parametrize("touch", [1e-3, 1e-6, 1e-9, 1e-12])
def test_zeros_that_are_about_to_merge_are_told_from_none(touch):
    c = np.random.default_rng(3).normal(size=(200, 5))
    lowest = np.nanmin(value(c, zeros(slope(c))), axis=-1)
    lift = np.zeros(5)
    lift[0] = 1
    above, below = (zeros(c - np.multiply.outer(lowest - side * touch, lift)) for side in (1, -1))
    assert np.isnan(above).all()
    assert (np.isfinite(below).sum(-1) >= 2).all()
