"""Helical springs against reference values, a published spring, and a spring of many short ones."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import mm
from camkit.dynamics import HelicalSpring
from train_cases import VALUES


def test_reference_values():
    spring, expected = HelicalSpring(), VALUES["spring"]
    found = [spring.rate, spring.active_mass, spring.surge_frequency, spring.index, spring.wahl_factor]
    names = ("rate", "active_mass", "surge_hz", "index", "wahl", "solid", "stress")
    assert_allclose([*found, spring.solid_length, spring.stress(450)], [expected[n] for n in names], rtol=1e-12)
    for nu, (real, imaginary) in VALUES["surge"]["K_at"].items():
        stiffness = spring.dynamic_stiffness(float(nu) * spring.surge_frequency)
        assert stiffness == pytest.approx(complex(real, imaginary), rel=1e-9)


def test_a_published_spring():
    """6.45 N/mm; a third of 9.9 g, that of all its coils, and 0.25 kg swing on it at 25.4 Hz."""
    spring = HelicalSpring(2 * mm, 16 * mm, 6, 8)
    mass = spring.active_mass * spring.total_coils / spring.active_coils
    assert (round(spring.rate / 1e3, 2), round(1e3 * mass, 1)) == (6.45, 9.9)
    assert round(np.sqrt(spring.rate / (0.25 + mass / 3)) / (2 * np.pi), 1) == 25.4


@pytest.mark.parametrize("nu", [0.1, 0.5, 0.9, 1.4])
def test_the_wave_is_that_of_many_short_springs(nu):
    """A chain of ``n`` equal masses and springs held at its far end, by its matrix."""
    spring, n = HelicalSpring(surge_damping=0.0), 4000
    k, m, w = n * spring.rate, spring.active_mass / n, 2 * np.pi * nu * spring.surge_frequency
    resists = k
    for _ in range(n - 1):
        resists = resists - m * w**2
        resists = k * resists / (k + resists)
    end = resists - m * w**2 / 2
    stiffness = spring.dynamic_stiffness(nu * spring.surge_frequency).real
    assert stiffness == pytest.approx(end, rel=1e-2, abs=1e-3 * spring.rate)


def test_the_first_term_is_a_third_of_the_mass():
    spring = HelicalSpring(surge_damping=0.0)
    w = 2 * np.pi * 0.01 * spring.surge_frequency
    third = spring.rate - spring.active_mass * w**2 / 3
    assert spring.dynamic_stiffness(0.01 * spring.surge_frequency).real == pytest.approx(third, rel=1e-7)
    assert spring.dynamic_stiffness(0.0) == spring.rate
