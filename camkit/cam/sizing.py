"""How large a cam has to be: the sizes that keep a limit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..extrema import Extreme
from ..quantities import unless
from ..quantities.kinds import one_number
from ..quantities.types import Array, Value
from ..units import deg, mm

STEPS, HALVINGS = 48, 40
LARGEST = 1000.0
"""A radius beyond this (m) is a slip."""


def refuse_pressure_angle(limit: Value) -> None:
    """``ValueError`` for a limit of the pressure angle that no cam or every cam keeps."""
    angle = one_number(limit, "the pressure angle wanted", "lie between 0 and 90 deg")
    if not 0 < angle < np.pi / 2:
        raise ValueError(f"the pressure angle wanted is {angle / deg:.4g} deg; it must lie between 0 and 90 deg")


def refuse_radius(limit: Value) -> None:
    """``ValueError`` for a least radius of curvature that is no length."""
    must = "be a finite number of at least 0 mm"
    radius = one_number(limit, "the least radius wanted", must)
    if not (np.isfinite(radius) and radius >= 0):
        raise ValueError(f"the least radius wanted is {radius / mm:.4g} mm; it must {must}")
    if radius > LARGEST:
        raise ValueError(f"the least radius wanted is {radius / mm:.4g} mm; it must be at most {LARGEST / mm:.6g} mm")


def if_possible(size: Value, drop: Extreme, excepted: bool | Array = False) -> Value:
    """``size`` that keeps a least radius of curvature; ``nan`` in a population where the speed drops at once.

    ``drop`` is the largest such drop and where it is (see `CamAnalysis.corner`): the profile is cut away there,
    however large it is.  ``ValueError`` for one design, if it is not ``excepted``.
    """
    possible = (drop.value == 0) | excepted
    if refuse := unless(possible):
        refuse(
            f"the follower's speed drops at once at a cam angle of {drop.cam_angle / deg:.4g} deg; no size keeps a "
            "least radius of curvature there: choose a motion whose speed does not jump"
        )
    return np.where(possible, size, np.nan)[()]


def min_from_which_on(keeps: Callable[[Array], Value], ample: Array) -> Array:
    """The least size from which on up to ``ample`` every size keeps a limit, element by element.

    ``keeps`` says which sizes of an array do.  From ``ample`` downwards the largest that fails is found, then the
    place where that ends; 0 if none fails.

    >>> round(float(min_from_which_on(lambda x: (x - 1) * (x - 2) >= 0, np.array(5.0))), 9)
    2.0
    """
    low = 0.0 * ample
    for share in np.arange(1, STEPS) / STEPS:
        low = np.where(keeps(share * ample), low, share * ample)
    high = low + ample / STEPS
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        good = keeps(middle)
        low, high = np.where(good, low, middle), np.where(good, middle, high)
    return high
