"""A lobe from its acceleration: the rise and the return of a valve or a cam that comes back to where it began."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..quantities.kinds import a_number, numbers, shown
from ..quantities.types import Array
from .families.acceleration import AccelerationTable, Pieces, pieces_of, spread, zones_of
from .segments import SMALLEST, Return, Rise

LOBES = ("lines", "steps")
SAME = 1e-9
"""Places, or velocities as a share of the largest, that differ by less are the same."""


def lobe_by_acceleration(
    angle: ArrayLike, acceleration: ArrayLike, lift: float, shape: str = "lines"
) -> tuple[Rise, Return]:
    """The rise to the nose and the return from it whose acceleration is a table of three zones of one sign or more.

    ``angle`` (rad) and ``acceleration`` (to any scale) are the rows, joined by ``lines`` or ``steps``.  That velocity
    and position come back to 0 at the end fixes what the zones are to each other; the ``lift`` (m or rad), which is
    reached at the nose, fixes the size.  Of more than three zones, the scales that differ least from their mean are
    taken.

    ``ValueError``: rows that do not increase or match, fewer than three zones, a zone that would have to change its
    sign, an acceleration that does not lead to one nose and back.

    >>> from camkit.units import deg, mm
    >>> at = [-68, -60, -50, -42, -34, 0, 38, 48, 56, 64, 74]
    >>> a = [0, 1, 1, 0, -0.4, -0.5, -0.4, 0, 0.8, 0.8, 0]
    >>> rise, back = lobe_by_acceleration(np.array(at) * deg, a, 9 * mm)
    >>> print(f"nose at {-68 + rise.angle / deg:.6f} deg")
    nose at 2.461440 deg
    """
    at, a = numbers(angle, "the cam angles of the lobe"), numbers(acceleration, "the accelerations of the lobe")
    height = a_number(lift, "the lift of the lobe", "be a finite number above 0", lambda h: h > 0)
    if not isinstance(shape, str) or shape not in LOBES:
        raise ValueError(f"the acceleration of the lobe is joined by {shown(shape)}; it can be {' or '.join(LOBES)}")
    if at.ndim != 1 or at.shape != a.shape or at.size < 4 or not (np.diff(at) > 0).all() or not np.isfinite(a).all():
        told = f"the lobe has {at.size} angles and {a.size} accelerations"
        raise ValueError(f"{told}; it needs as many of each in a row, four at least, at angles that increase")
    span = at[-1] - at[0]
    u, values = _scaled(pieces_of((at - at[0]) / span, a / np.maximum(np.max(np.abs(a)), SMALLEST), shape))
    nose = _nose(u, values, shape)
    before, after = u < nose - SAME, u > nose + SAME
    there = np.interp(nose, u, values) if shape == "lines" else values[~after][-1]
    return (
        Rise(nose * span, height, AccelerationTable((*u[before], nose), (*values[before], there), shape)),
        Return((1 - nose) * span, height, AccelerationTable((nose, *u[after]), (-there, *-values[after]), shape)),
    )


def _scaled(pieces: Pieces) -> tuple[Array, Array]:
    """The places of the pieces, and the acceleration there when position and velocity come back to 0."""
    zones = zones_of(pieces)
    beside = spread(zones)
    G11, G12, G22 = (float(x[0]) for x in beside.G)
    g1, g2 = (float(x[0]) for x in beside.g)
    det = G11 * G22 - G12**2
    if zones.there.sum() < 3 or det <= 1e-12 * G11 * G22:
        raise ValueError("the acceleration of the lobe has too few zones of one sign; it needs three at least")
    l, m = (G12 * g2 - G22 * g1) / det, (G12 * g1 - G11 * g2) / det
    x = 1 + l * beside.V + m * beside.S
    if (least := np.min(np.where(zones.there > 0, x, np.inf))) <= 0:
        raise ValueError(
            f"the least scale of a zone of the lobe is {least:.6g} times the mean; each must be above 0: a zone would "
            "have to change its sign"
        )
    scale = zones.of @ x
    last = pieces.c[0][-1] + pieces.c[1][-1] * pieces.width[-1]
    return np.append(pieces.start, 1.0), np.append(scale * pieces.c[0], scale[-1] * last)


def _nose(u: Array, a: Array, shape: str) -> float:
    """Where the velocity comes down to 0."""
    w = np.diff(u)
    steep = np.diff(a) / w if shape == "lines" else 0 * w
    v = np.append(0.0, np.cumsum(w * (a[:-1] + w * steep / 2)))
    none = SAME * np.max(np.abs(v))
    down = np.flatnonzero((v[:-1] > none) & (v[1:] <= none))
    k = int(down[0]) if len(down) == 1 else -1
    if k < 0 or v[: k + 1].min() < -none or v[k + 1 :].max() > none or v[-2] > -none:
        raise ValueError("the acceleration of the lobe does not lead up to one nose and back from it")
    root = np.sqrt(np.maximum(a[k] ** 2 - 2 * steep[k] * v[k], 0.0))
    return float(u[k] + 2 * v[k] / (root - a[k]))  # without a difference of like numbers
