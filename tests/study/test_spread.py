"""Tolerances and what standards print of them."""

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import mm
from camkit.study import Source, Tolerance, en_10210, iso_286, iso_2768
from camkit.study.spread import correlated, spread_shares
from camkit.units import um

ISO_286_TABLE = {  # ISO 286-1:2010, table 1, um: IT6, IT7, IT8, IT9, IT10, IT11
    25: (13, 21, 33, 52, 84, 130),
    40: (16, 25, 39, 62, 100, 160),
    100: (22, 35, 54, 87, 140, 220),
    300: (32, 52, 81, 130, 210, 320),
}


@pytest.mark.parametrize("diameter", ISO_286_TABLE)
def test_the_formula_gives_the_table_of_iso_286(diameter):
    """The table is the formula, rounded to two digits or to the next whole um."""
    found = [iso_286(diameter * mm, grade) / um for grade in (6, 7, 8, 9, 10, 11)]
    assert_allclose(found, ISO_286_TABLE[diameter], rtol=0.035, atol=0.6)


def test_a_step_of_iso_286_belongs_to_the_smaller_diameters():
    assert iso_286(50 * mm) == iso_286(31 * mm) < iso_286(50.01 * mm)
    assert np.isnan(iso_286(501 * mm))
    with pytest.raises(ValueError, match="the grade of ISO 286 is 12; there are 6, 7, 8, 9, 10, 11"):
        iso_286(50 * mm, 12)


def test_general_tolerances_of_lengths():
    """ISO 2768-1:1989, table 1."""
    lengths = np.array([3, 6, 6.1, 30, 31, 120, 121, 400, 401, 1000, 1001, 2000]) * mm
    assert_allclose(iso_2768(lengths) / mm, [0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.5, 0.5, 0.8, 0.8, 1.2, 1.2])
    fine = [0.05, 0.05, 0.1, 0.1, 0.15, 0.15, 0.2, 0.2, 0.3, 0.3, 0.5, 0.5]
    assert_allclose(iso_2768(lengths, "f") / mm, fine)
    with pytest.raises(ValueError, match="the grade of ISO 2768 is 'c'; there are f, m"):
        iso_2768(lengths, "c")


def test_a_tube_is_thinner_rather_than_thicker():
    """EN 10210-2: 1 % of the diameter but between 0.5 and 10 mm; the wall from -10 to +8 % of itself."""
    diameter, wall = en_10210("outer", "inner").values()
    sizes = np.array([30, 200, 2000]) * mm
    assert_allclose(diameter.between("outer", sizes), np.array([[-0.5, -2, -10], [0.5, 2, 10]]) * mm)
    assert_allclose(wall.between("wall", np.array([10 * mm])), np.array([[-1.0], [0.8]]) * mm)


def test_a_tolerance_is_a_half_width_or_two_deviations_or_a_function():
    values = np.array([0.02, 0.2])
    assert_allclose(Tolerance(0.001).between("x", values), [[-0.001] * 2, [0.001] * 2])
    assert_allclose(Tolerance((0, 0.002)).between("x", values), [[0, 0], [0.002, 0.002]])
    assert_allclose(Tolerance(partial(iso_2768, grade="f")).between("x", values)[1], [0.1 * mm, 0.2 * mm])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (-0.001, "the tolerance of the quantity goes from 0.001 to -0.001"),
        ((0.2, 0.1), "both must be finite, the first not above the second"),
        ((0.1, 0.2, 0.3), "a lowest and a highest deviation"),
        (float("nan"), "both must be finite"),
        ("wide", "the tolerance of the quantity is 'wide'; it must be a finite half width"),
    ],
)
def test_what_is_no_tolerance_is_refused(given, said):
    with pytest.raises(ValueError, match=said):
        Tolerance(given)


def test_other_refusals():
    with pytest.raises(ValueError, match="the spread is 'triangular'; there are uniform, normal"):
        Tolerance(0.1, "triangular")
    with pytest.raises(ValueError, match="a number for each value"):
        Tolerance(lambda x: np.ones(3)).between("x", np.ones(2))
    with pytest.raises(ValueError, match="the wall moves nothing"):
        Source("wall", {})
    with pytest.raises(ValueError, match="the wall moves 'bore'; it must be a mapping"):
        Source("wall", "bore")
    with pytest.raises(ValueError, match="how far the bore moves with the wall is 'twice'"):
        Source("wall", {"bore": "twice"})
    with pytest.raises(ValueError, match=r"the wall moves .*3: 1.0.*; it must be a mapping from paths"):
        Source("wall", {3: 1.0})
    with pytest.raises(ValueError, match="it must be two of x, y"):
        correlated(["x", "y"], {("x", "z"): 0.5})
    with pytest.raises(ValueError, match=r"the correlation of x and y is 1\.5; it must lie between -1 and 1"):
        correlated(["x", "y"], {("x", "y"): 1.5})
    with pytest.raises(ValueError, match="contradict each other"):
        correlated(["x", "y", "z"], {("x", "y"): 0.9, ("y", "z"): 0.9, ("x", "z"): -0.9})


def test_a_copula_keeps_the_spread_of_each_and_joins_their_ranks():
    """Spearman's rank correlation of a Gaussian copula is 6 / pi asin(r / 2)."""
    from scipy.stats import qmc, spearmanr

    unit = qmc.Sobol(2, rng=1).random(2**14)
    z = spread_shares(unit, ["uniform", "normal"], correlated(["x", "y"], {("x", "y"): 0.8}))
    assert spearmanr(z).statistic == pytest.approx(6 / np.pi * np.arcsin(0.4), abs=0.005)
    assert_allclose(z.mean(0), 0, atol=0.005)
    assert_allclose(z.std(0), [1 / np.sqrt(3), 1 / 3], rtol=0.01)
    assert abs(z[:, 0]).max() <= 1
