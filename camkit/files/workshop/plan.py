"""What of a blank is seen in plan: bore, keyway and hub as lines and arcs."""

from __future__ import annotations

import numpy as np

from ...geometry import rotated
from ...quantities.types import Array
from .arcs import ArcPath
from .blank import Blank

BORE, KEYWAY, HUB = "BORE", "KEYWAY", "HUB"


def circle(layer: str, radius: float) -> ArcPath:
    """A circle about the cam axis."""
    return ArcPath(layer, np.array([[radius, -radius], [0.0, 0.0]]), np.array([1.0, 1.0]), True)


def plan(blank: Blank) -> list[ArcPath]:
    """Bore and hub as circles; with a keyway the bore's arc, and from its one end to the other the keyway's sides.

    >>> from camkit.units import mm
    >>> [(path.layer, path.closed) for path in plan(Blank(bore=20 * mm, key="DIN 6885-1"))]
    [('BORE', False), ('KEYWAY', False)]
    """
    radius, keyway = blank.bore / 2, blank.keyway
    hub = [circle(HUB, blank.hub_diameter / 2)] if blank.hub_diameter else []
    if not radius:
        return hub
    if keyway is None:
        return [circle(BORE, radius), *hub]
    half = keyway.width / 2
    mouth, floor = np.sqrt(radius**2 - half**2), radius + keyway.depth
    slot = np.array([[mouth, floor, floor, mouth], [-half, -half, half, half]])
    around = 2 * np.pi - 2 * np.arcsin(half / radius)
    bore = np.array([[mouth, -radius, mouth], [half, 0.0, -half]])
    return [
        ArcPath(BORE, _at(bore, blank), np.full(2, np.tan(around / 8)), False),
        ArcPath(KEYWAY, _at(slot, blank), np.zeros(3), False),
        *hub,
    ]


def _at(points: Array, blank: Blank) -> Array:
    return rotated(points, blank.key_angle)
