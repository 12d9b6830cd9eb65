"""What the rocker of a linkage resists with: a door's weight about its hinge, and the constant torque of a closer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..quantities import Design, quantity
from ..quantities.types import Array, Value


@dataclass(frozen=True)
class RockerLoad(Design):
    """A weight that turns with the rocker, and a constant torque on it, such as a door closer's.

    The torque keeps its sign whichever way the rocker turns: what resists one way drives the other, unlike friction.
    The hinge axis leans by ``epsilon`` from straight up; a centre of gravity at the rocker angle ``delta`` is at
    its lowest.  A ship that heels by 10 deg gives an upright door ``lean=10*deg``; a hatch has ``lean=90*deg``.

    >>> load = RockerLoad(mass=30, reach=0.4, lean=np.pi / 2, torque=0)
    >>> print(f"{load.resisting_torque(np.pi / 2):.2f} N m")
    117.72 N m
    """

    mass: float = quantity("m", 30, 0, 200, "kg", "what turns with the rocker, such as a door", at_least=0)
    reach: float = quantity("r_G", 400, 0, 1000, "mm", "hinge axis to centre of gravity", at_least=0)
    rise: float = quantity(
        "z_G", 0, -1000, 1000, "mm", "centre of gravity along the hinge from the rocker's plane", above=None
    )
    mass_angle: float = quantity("gamma", 0, -180, 180, "deg", "from the rocker to the centre of gravity", above=None)
    lean: float = quantity("epsilon", 0, 0, 180, "deg", "hinge axis from straight up", above=None)
    downhill: float = quantity("delta", 0, -180, 360, "deg", "direction about the hinge that slopes down", above=None)
    torque: float = quantity(
        "T", 10, -50, 50, "N m", "constant, against a growing rocker angle; < 0: a falling one", above=None
    )
    gravity: float = quantity("g", 9.81, 0, 9.81, "m/s^2", "weight of a mass; 0: none", at_least=0)

    def resisting_torque(self, rocker_angle: Value) -> Array:
        """Torque about the hinge, N m, positive where it resists a growing ``rocker_angle``."""
        weight = self.mass * self.gravity * np.sin(self.lean)
        return self.torque + weight * self.reach * np.sin(rocker_angle + self.mass_angle - self.downhill)
