"""Several conditions inside one polynomial: what numpy's own solution of all of them together says, too."""

from math import perm

import numpy as np
import pytest

from camkit.motion import Dwell, MatchedProgram, Polynomial, Through
from camkit.units import deg, mm

ANGLE = 150 * deg
POINTS = {
    "two levels": (Through(0.4, s=20 * mm), Through(0.6, s=18 * mm)),
    "a level and a velocity": (Through(0.4, s=20 * mm, v=0.0),),
    "s, v and a": (Through(0.3, s=12 * mm, v=20 * mm, a=-5 * mm), Through(angle=100 * deg, s=15 * mm)),
    "velocities alone": (Through(0.3, v=20 * mm), Through(0.7, v=-25 * mm)),
}


def together(points):
    """Rest at both ends and all conditions, as one system for the powers of the share."""
    asked = [(u, k, 0.0) for u in (0.0, 1.0) for k in range(3)]
    asked += [(float(p.place(ANGLE)), k, value * ANGLE**k) for p in points for k, value in p.given.items()]
    rows = [[perm(i, k) * u ** (i - k) if i >= k else 0.0 for i in range(len(asked))] for u, k, _ in asked]
    return np.polynomial.Polynomial(np.linalg.solve(rows, [value for *_, value in asked]))


@pytest.mark.parametrize("name", POINTS)
def test_one_polynomial_meets_every_condition_inside(name):
    program = MatchedProgram((Polynomial(ANGLE, POINTS[name]), Dwell(210 * deg)))
    share = np.linspace(0, 1, 101)
    motion, expected = program(share * ANGLE), together(POINTS[name])
    for k in range(4):
        wanted = (expected.deriv(k) if k else expected)(share) / ANGLE**k
        np.testing.assert_allclose(motion[k][:-1], wanted[:-1], atol=1e-9 * abs(wanted).max())


def test_points_inside_a_population_are_met_row_by_row():
    level = np.array([[20 * mm], [25 * mm]])
    points = Through(0.4, s=level), Through(0.6, s=18 * mm)
    both = MatchedProgram((Polynomial(ANGLE, points), Dwell(210 * deg)))(np.linspace(0, ANGLE, 20))
    for row, one in enumerate(level[:, 0]):
        alone = MatchedProgram((Polynomial(ANGLE, (Through(0.4, s=one), points[1])), Dwell(210 * deg)))
        np.testing.assert_allclose(both.s[row], alone(np.linspace(0, ANGLE, 20)).s, atol=1e-15)


@pytest.mark.parametrize("count", [5, 8])
def test_one_polynomial_goes_through_up_to_eight_points(count):
    places = np.arange(1, count + 1) / (count + 1)
    points = tuple(Through(float(u), s=20 * mm * np.sin(3 * u)) for u in places)
    program = MatchedProgram((Polynomial(ANGLE, points), Dwell(210 * deg)))
    np.testing.assert_allclose(program(places * ANGLE).s, 20 * mm * np.sin(3 * places), rtol=1e-6)


def test_more_values_than_one_polynomial_holds_are_for_a_spline():
    """Of twelve, one polynomial left a gap of a micrometre at its end."""
    points = tuple(Through(float(u), s=10 * mm * (i % 2)) for i, u in enumerate(np.arange(1, 13) / 13))
    with pytest.raises(ValueError, match="meet 12 values inside; beyond 8 it loses digits: form='spline'"):
        Polynomial(ANGLE, points)
    spline = MatchedProgram((Polynomial(ANGLE, points, "spline"), Dwell(210 * deg)))
    np.testing.assert_allclose(spline([point.share * ANGLE for point in points]).s, [p.s for p in points], atol=1e-12)
    assert all(transition.lawful for transition in spline.transitions())
