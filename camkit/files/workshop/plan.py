"""What of a blank is seen in plan: bore, keyway and hub as lines and arcs."""

from __future__ import annotations

import numpy as np

from ...geometry import rotated
from .arcs import ArcPath
from .blank import Blank

BORE, KEYWAY, HUB = "BORE", "KEYWAY", "HUB"


def circle(radius: float, layer: str = "") -> ArcPath:
    """A circle about the cam axis, as two arcs."""
    return ArcPath(layer, radius * np.array([[1.0, -1.0], [0.0, 0.0]]), np.ones(2), True)


def bore_path(blank: Blank) -> ArcPath:
    """The outline of the bore, counter-clockwise from its keyway on, if it has one."""
    radius, keyway = blank.bore / 2, blank.keyway
    if keyway is None:
        return circle(radius, BORE)
    half, floor = keyway.width / 2, radius + keyway.depth
    mouth, arc = np.sqrt(radius**2 - half**2), np.tan((np.pi - np.arcsin(half / radius)) / 4)
    corners = np.array([[mouth, floor, floor, mouth, -radius], [-half, -half, half, half, 0.0]])
    return ArcPath(KEYWAY, rotated(corners, blank.key_angle), np.array([0.0, 0.0, 0.0, arc, arc]), True)


def plan(blank: Blank) -> list[ArcPath]:
    """Bore and hub as circles; with a keyway the bore's arc, and from its one end to the other the keyway's sides.

    >>> from camkit.units import mm
    >>> [(path.layer, path.closed) for path in plan(Blank(bore=20 * mm, key="DIN 6885-1"))]
    [('BORE', False), ('KEYWAY', False)]
    """
    hub = [circle(blank.hub_diameter / 2, HUB)] if blank.hub_diameter else []
    if not blank.bore:
        return hub
    whole = bore_path(blank)
    if blank.keyway is None:
        return [whole, *hub]
    bore = ArcPath(BORE, whole.corners[:, [3, 4, 0]], whole.bulges[3:], False)
    return [bore, ArcPath(KEYWAY, whole.corners[:, :4], whole.bulges[:3], False), *hub]
