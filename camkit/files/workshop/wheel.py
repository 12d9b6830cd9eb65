"""What a cam grinder follows: how far the wheel's centre is from the cam's axis while the cam turns."""

from __future__ import annotations

import numpy as np

from ...quantities.kinds import numbers
from ...quantities.types import Array
from ...units import deg
from .curves import Stretch
from .toolpath import tool_path

ROUNDS = 8
"""Steps towards a direction, each of which leaves a hundredth of the way or less."""
NEAR = 1e-7
"""A direction that a stretch misses by less (rad) is at its end."""


def wheel_path(cam: object, wheel_radius: float, direction: Array) -> dict[str, Array]:
    """Where the centre of a wheel is that touches a cam, for every ``direction`` (rad) from the cam's axis.

    ``x`` and ``y`` on the cam and the ``distance`` from its axis, m.  A grinder whose wheel is on its x axis turns the
    cam back by the direction: its C axis.

    >>> from camkit import TranslatingFlatCam, mm
    >>> path = wheel_path(TranslatingFlatCam(), 60 * mm, np.array([np.pi / 2]))
    >>> {name: (values / mm).round(3).tolist() for name, values in path.items()}
    {'distance': [90.0], 'x': [0.0], 'y': [90.0]}

    Raises ``ValueError`` for a path that does not go all the way around the axis, or goes back on it.
    """
    wanted = np.ravel(numbers(direction, "the directions"))
    found = np.full(wanted.shape, np.nan)
    for line in tool_path(cam, wheel_radius).contours:
        for stretch in line.stretches:
            here, distance = _met(stretch, wanted)
            found[here] = distance
    lost = wanted[np.isnan(found)]
    if lost.size:
        raise ValueError(f"the wheel does not come past {lost[0] / deg:.4g} deg: its path does not go around the cam")
    return {"distance": found, "x": found * np.cos(wanted), "y": found * np.sin(wanted)}


def _met(stretch: Stretch, wanted: Array) -> tuple[Array, Array]:
    """Which of the directions a stretch has, and how far it is from the axis there, m."""
    angle = np.unwrap(np.arctan2(*stretch.points[::-1]))
    sense = np.sign(angle[-1] - angle[0])
    if not (sense * np.diff(angle) > 0).all():
        raise ValueError(f"the path of the wheel goes back at {angle[0] / deg:.4g} deg as seen from the cam's axis")
    ahead = (sense * (wanted - angle[0]) + NEAR) % (2 * np.pi) - NEAR
    here = np.flatnonzero(ahead <= sense * (angle[-1] - angle[0]) + NEAR)
    ahead, gone = ahead[here], sense * (angle - angle[0])
    place, last = np.interp(ahead, gone, np.arange(gone.size)), gone.size - 1
    for _ in range(ROUNDS):
        now = np.arctan2(*stretch.at(place).points[::-1])
        missed = (sense * (wanted[here] - now) + np.pi) % (2 * np.pi) - np.pi
        place = np.clip(place + missed / np.diff(gone)[np.minimum(place.astype(int), last - 1)], 0, last)
    return here, np.hypot(*stretch.at(place).points)
