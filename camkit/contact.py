"""Stress where two cylinders touch along a line: Hertz.

Source: Johnson, Contact Mechanics (1985), sections 4.2(c) and 4.1(b).
"""

from __future__ import annotations

from functools import reduce
from typing import NamedTuple

import numpy as np

from .quantities.kinds import numbers, refuse_shapes
from .quantities.known import unless
from .quantities.types import Array, Value

GOLDEN = (np.sqrt(5) - 1) / 2
"""``(z/a)^2`` where the shear below the middle of a line contact is largest: the root of ``t^2 + t = 1``."""


class LineContact(NamedTuple):
    """What two cylinders do to each other; unpacks as pressure, half width, shear, depth of the shear (SI)."""

    pressure: Array
    """``p_0``: largest pressure, in the middle, Pa."""
    half_width: Value
    """``a``: half the width of the contact, m."""
    shear: Array
    """Largest shear stress, below the middle of the contact, Pa."""
    shear_depth: Value
    """How deep that is, m."""


def contact_modulus(first: Value, second: Value, first_poisson: Value = 0.3, second_poisson: Value = 0.3) -> Value:
    """``E*`` of two bodies in contact, Pa: ``1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2``.

    >>> print(f"{contact_modulus(210e9, 210e9) / 1e9:.3f} GPa")
    115.385 GPa

    Raises ``ValueError`` for what are no numbers, a modulus that is not above 0 or a Poisson's ratio outside 0 to
    0.5; in an array such a member is ``nan``.
    """
    moduli = [numbers(E, "the elastic moduli") for E in (first, second)]
    ratios = [numbers(nu, "Poisson's ratios") for nu in (first_poisson, second_poisson)]
    names = ("moduli", "other moduli", "Poisson's ratios", "other ratios")
    refuse_shapes(dict(zip(names, (*moduli, *ratios), strict=True)))
    for modulus in moduli:
        if refuse := unless(np.isfinite(modulus) & (modulus > 0)):
            refuse(f"the elastic modulus is {modulus / 1e9:.6g} GPa; it must be a finite number above 0 GPa")
    for ratio in ratios:
        if refuse := unless((ratio >= 0) & (ratio <= 0.5)):
            refuse(f"Poisson's ratio is {ratio:.6g}; it must lie between 0 and 0.5")
    possible = reduce(np.logical_and, (*(E > 0 for E in moduli), *((nu >= 0) & (nu <= 0.5) for nu in ratios)))
    with np.errstate(divide="ignore", invalid="ignore"):
        compliance = sum((1 - nu**2) / E for E, nu in zip(moduli, ratios, strict=True))
        return np.where(possible, 1 / compliance, np.nan)[()]


def line_contact(force_per_length: Value, curvature: Value, modulus: Value) -> LineContact:
    """Pressure and shear where two parallel cylinders are pressed together, element by element.

    ``force_per_length``: ``w``, N/m; ``curvature``: ``kappa``, the sum of both curvatures, 1/m (a flat face
    adds 0, a hollow one counts negative); ``modulus``: ``E*`` of `contact_modulus`, Pa.

        p_0 = sqrt(w E* kappa / pi),  a = sqrt(4 w / (pi E* kappa))

    The shear on the axis, ``tau / p_0 = z/a - (z/a)^2 / sqrt(1 + (z/a)^2)``, is largest at ``z = 0.786 a``
    with ``0.300 p_0``.  ``nan`` where the surfaces do not fit (``kappa <= 0``) or are pulled (``w < 0``).

    >>> w, kappa = 4e3, 1 / 0.005 + 1 / 0.020
    >>> contact = line_contact(w, kappa, contact_modulus(210e9, 210e9))
    >>> print(f"{contact.pressure / 1e6:.3f} MPa, {contact.half_width * 1e6:.3f} um")
    191.646 MPa, 13.287 um
    """
    w = numbers(force_per_length, "the forces per length")
    kappa, E = numbers(curvature, "the curvatures"), numbers(modulus, "the moduli")
    refuse_shapes({"forces per length": w, "curvatures": kappa, "moduli": E})
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        fitting = np.where((w >= 0) & (kappa > 0), kappa, np.nan)
        p0 = np.sqrt(w * E * fitting / np.pi)[()]
        a = np.sqrt(4 * w / (np.pi * E * fitting))[()]
    return LineContact(p0, a, GOLDEN**2.5 * p0, np.sqrt(GOLDEN) * a)
