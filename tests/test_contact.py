"""Hertz line contact against published numbers and against the stresses of a half space, summed up."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit.contact import contact_modulus, line_contact
from camkit.units import GPa, MPa, N, mm

# slippy 0.5.2, solve_hertz_line: r1, r2 [mm], w [N/mm], E1, E2 [MPa], nu1, nu2 -> E* [GPa], half width [mm], p0 [MPa]
SLIPPY = [
    (5, 20, 4, 210000, 210000, 0.3, 0.3, 115.384615, 0.013287433, 191.645673),
    (5, 20, 400, 210000, 70000, 0.3, 0.33, 58.605196, 0.186443389, 1365.818926),
    (20, 20, 100, 210000, 210000, 0, 0.49, 119.324962, 0.103297404, 616.297939),
]
W, KAPPA, E = 40 * N / mm, 1 / (8 * mm), contact_modulus(210 * GPa, 170 * GPa)


@pytest.mark.parametrize(("r1", "r2", "w", "E1", "E2", "nu1", "nu2", "modulus", "half_width", "p0"), SLIPPY)
def test_published_contacts(r1, r2, w, E1, E2, nu1, nu2, modulus, half_width, p0):
    together = contact_modulus(E1 * MPa, E2 * MPa, nu1, nu2)
    contact = line_contact(w * N / mm, 1 / (r1 * mm) + 1 / (r2 * mm), together)
    assert_allclose(together, modulus * GPa, rtol=1e-8)
    assert_allclose(contact.half_width, half_width * mm, rtol=5e-8)
    assert_allclose(contact.pressure, p0 * MPa, rtol=1e-8)


def test_the_pressure_carries_the_load():
    p0, a, *_ = line_contact(W, KAPPA, E)
    turn = (np.arange(2000) + 0.5) * np.pi / 2000
    load = np.sum(p0 * np.sin(turn) * a * np.sin(turn)) * np.pi / 2000  # x = a cos(turn)
    assert_allclose(load, W, rtol=1e-12)


def test_the_surfaces_close_the_gap():
    """Slope of both surfaces together under the pressure: ``-(2 / (pi E*)) int p(s) / (x - s) ds = -kappa x``."""
    p0, a, *_ = line_contact(W, KAPPA, E)
    turn = (np.arange(4000) + 0.5) * np.pi / 4000
    s = a * np.cos(turn)
    p_ds = p0 * np.sin(turn) * a * np.sin(turn) * np.pi / 4000
    x = a * np.cos(np.arange(400, 3600, 400) * np.pi / 4000)  # halfway between the sources: Cauchy's value
    slope = -2 / (np.pi * E) * np.sum(p_ds / (x[:, None] - s), axis=-1)
    assert_allclose(slope, -KAPPA * x, rtol=1e-6, atol=1e-12)


def test_shear_below_the_middle_is_the_half_space_summed_up():
    """Flamant: a line load P gives ``2 P z^3 / (pi r^4)`` down and ``2 P x^2 z / (pi r^4)`` across, at depth z."""
    p0, a, shear, depth = line_contact(W, KAPPA, E)
    turn = (np.arange(2000) + 0.5) * np.pi / 2000
    x, P = a * np.cos(turn), p0 * np.sin(turn) * a * np.sin(turn) * np.pi / 2000
    z = np.linspace(0.5, 1.1, 6001)[:, None] * a
    tau = np.sum(P * z * (z**2 - x**2) / (np.pi * (x**2 + z**2) ** 2), axis=-1)
    assert_allclose(tau.max(), shear, rtol=1e-8)
    assert_allclose(z[tau.argmax(), 0], depth, atol=2e-4 * a)
    assert_allclose((shear / p0, depth / a), (0.300283, 0.786151), atol=5e-7)  # Johnson (1985), eq. (4.47): 0.30, 0.78


def test_limits():
    p0, a, *_ = line_contact(np.array([W, 4 * W, 0, -W, W]), np.array([KAPPA, KAPPA, KAPPA, KAPPA, -KAPPA]), E)
    assert_allclose(p0, [p0[0], 2 * p0[0], 0, np.nan, np.nan])
    assert_allclose(a, [a[0], 2 * a[0], 0, np.nan, np.nan])
    assert_allclose(contact_modulus(210 * GPa, 1e9 * GPa), 210 * GPa / (1 - 0.3**2), rtol=1e-6)  # on a rigid body


def test_refusals():
    with pytest.raises(ValueError, match=r"^the elastic modulus is 0 GPa; it must be a finite number above 0 GPa$"):
        contact_modulus(210 * GPa, 0.0)
    with pytest.raises(ValueError, match=r"^Poisson's ratio is 0\.7; it must lie between 0 and 0\.5$"):
        contact_modulus(210 * GPa, 210 * GPa, 0.7)


@pytest.mark.parametrize("wrong", [("a", 1), None, 1j, 10**400, "x", True, [[1, 2], [3]]])
def test_what_are_no_numbers_is_refused_in_a_sentence(wrong):
    for given in ((wrong, 210e9), (210e9, wrong), (210e9, 210e9, wrong), (210e9, 210e9, 0.3, wrong)):
        with pytest.raises(ValueError, match=r"^(the elastic moduli|Poisson's ratios) must be numbers; given is "):
            contact_modulus(*given)


def test_arrays_that_do_not_fit_one_another_are_refused_in_a_sentence():
    sentence = r"\(3,\) and .* of the shape \(2,\) and .*; each must fit the others, or be one number$"
    with pytest.raises(ValueError, match=rf"^there are forces per length of the shape {sentence}"):
        line_contact(np.ones(3), np.ones(2), 1)
    with pytest.raises(ValueError, match=rf"^there are moduli of the shape {sentence}"):
        contact_modulus(np.ones(3), np.ones(2))
    assert_allclose(contact_modulus([210e9, 70e9], 210e9), [contact_modulus(E, 210e9) for E in (210e9, 70e9)])


def test_a_population_is_its_members_and_a_bad_one_disturbs_nobody():
    moduli = np.array([210 * GPa, -1.0, 70 * GPa])[:, None]
    together = contact_modulus(moduli, 210 * GPa)
    assert_allclose(together[:, 0], [contact_modulus(210e9, 210e9), np.nan, contact_modulus(70e9, 210e9)])
    forces = np.linspace(0, W, 5)
    many = line_contact(forces, KAPPA, together)
    for row in (0, 2):
        one = line_contact(forces, KAPPA, together[row, 0])
        assert all(np.array_equal(a[row], b) for a, b in zip(many, one, strict=True))
    assert np.isnan(many.pressure[1]).all()
