"""Parts reduced to the follower, against energies and a static deflection."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit.dynamics import Part, reduced, spring_part


def test_kinetic_energy_and_deflection_are_those_of_the_parts():
    """A pushrod, a rocker of 40 and 60 mm, a valve on its long arm, a spring there."""
    arm, ratio = 0.04, 60 / 40
    parts = [
        Part("pushrod", 0.05, 8e6),
        Part("rocker", 2e-4, 4e3, 1 / arm),
        Part("valve", 0.08, 2e7, ratio),
        spring_part(0.06, ratio),
    ]
    found, v, F = reduced(parts), 3.0, 500.0
    spring = np.trapezoid(0.06 * (ratio * v * np.linspace(0, 1, 20001)) ** 2 / 2, np.linspace(0, 1, 20001))
    energy = 0.05 * v**2 / 2 + 2e-4 * (v / arm) ** 2 / 2 + 0.08 * (ratio * v) ** 2 / 2 + spring
    assert found.mass * v**2 / 2 == pytest.approx(energy, rel=1e-8)
    gives = F / 8e6 + (F * arm / 4e3) * arm + (F / ratio / 2e7) / ratio
    assert F / found.stiffness == pytest.approx(gives, rel=1e-12)
    assert [name for name, *_ in found.rows] == ["pushrod", "rocker", "valve", "return spring"]
    assert sum(mass for _, mass, _ in found.rows) == pytest.approx(found.mass)
    expected = np.array([1 / 8e6, arm**2 / 4e3, 1 / (2e7 * ratio**2), 0.0]) * found.stiffness
    assert_allclose([share for *_, share in found.rows], expected, rtol=1e-12)


def test_the_table_of_parts_escapes_their_names():
    text = reduced([Part("<b>rod</b>", 0.05, 8e6), spring_part(0.06)])._repr_html_()
    assert "<td>&lt;b&gt;rod&lt;/b&gt;</td><td>0.05</td><td>100</td>" in text
    assert "together 0.07, 8e+06 N/m" in text


def test_rigid_parts_have_no_end_of_stiffness():
    assert reduced([Part("slide", 2.0)]).stiffness == np.inf


def test_a_population_of_parts():
    found = reduced([Part("rod", np.array([[0.1], [0.2]]), np.array([[1e6], [2e6]]))])
    assert_allclose(found.mass, [[0.1], [0.2]])
    assert_allclose(found.stiffness, [[1e6], [2e6]])


def test_refusals():
    with pytest.raises(ValueError, match="the mass of the rod is -1; it must be at least 0"):
        Part("rod", -1.0)
    with pytest.raises(ValueError, match="the stiffness of the rod is 0; it must be a finite number above 0"):
        Part("rod", 1.0, 0.0)
    with pytest.raises(ValueError, match="the ratio of the rod is 0"):
        Part("rod", 1.0, 1.0, 0.0)
    with pytest.raises(ValueError, match="they must be one Part or more"):
        reduced([])
    with pytest.raises(ValueError, match="they must be one Part or more"):
        reduced([1.0])
