"""What a sliding follower resists with, and what rubs at its cam and in its guide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..quantities import Design, quantity
from ..quantities.types import Array, Value
from .loads import FollowerFriction, Table, as_table, opposite_table, tabulated


@dataclass(frozen=True)
class SlideLoad(Design):
    """The force that a cam must put into a sliding follower, positive where it resists the rise.

    ``Q = m omega^2 s'' + d omega s' + F + F_0 + c s + m g cos(u)`` and what the tables add.

    >>> load = SlideLoad(mass=2, force=100, preload=50, spring_rate=5e3, gravity=9.81, speed=10)
    >>> print(f"{load.resisting_force(travel=0.01, acceleration=-0.2):.2f} N")
    179.62 N
    """

    mass: float = quantity(
        "m", 0.5, 0, 10, "kg", "follower and all that moves with it", at_least=0, name="follower mass"
    )
    speed: float = quantity("omega", 300, 0, 3000, "rpm", "speed of the cam", at_least=0, name="cam speed")
    force: float = quantity("F", 0, -500, 500, "N", "constant resisting force", above=None, name="resisting force")
    spring_rate: float = quantity("c", 5, 0, 50, "N/mm", "closing spring", at_least=0, name="spring rate")
    preload: float = quantity(
        "F_0", 50, 0, 1000, "N", "force of the spring at the motion's level 0", at_least=0, name="spring preload"
    )
    gravity: float = quantity(
        "g", 0, 0, 9.81, "m/s^2", "weight of the follower; 0: it travels level", at_least=0, name="gravity"
    )
    up_angle: float = quantity(
        "u",
        0,
        -180,
        180,
        "deg",
        "from the direction of the rise to straight up",
        above=None,
        name="direction of gravity",
    )
    force_table: Table = ()
    """Pairs of travel (from the motion's level 0) [m] and resisting force [N], in order; straight lines between."""
    cam_angle_table: Table = ()
    """The same over the cam angle [rad]: the work of the machine, which differs between rise and return."""
    table_factor: float = quantity("k", 1, 0, 3, "", "by which what the tables give is multiplied", above=None)
    damping: float = quantity(
        "d", 0, 0, 200, "N s/m", "force over the follower's velocity", at_least=0, name="follower damping"
    )

    def __post_init__(self) -> None:
        forces = as_table("force table", "travel", "force", self.force_table)
        object.__setattr__(self, "force_table", forces)
        forces = as_table("cam angle table", "cam angle", "force", self.cam_angle_table)
        object.__setattr__(self, "cam_angle_table", forces)
        super().__post_init__()

    def following(self) -> dict[str, str]:
        """Without a table its factor has no effect."""
        entries = len(self.force_table) + len(self.cam_angle_table)
        return {} if entries else {"table_factor": "there is no table of the load"}

    @property
    def travel_table(self) -> Table:
        """The table over the travel, whatever it holds."""
        return self.force_table

    @property
    def side_force(self) -> Value:
        """The weight's part across the travel, to the right of the rise, N: it presses the follower into its guide."""
        return self.mass * self.gravity * np.sin(self.up_angle)

    def static_force(self, travel: Value, cam_angle: Value = 0.0) -> Array:
        """Force along the travel without inertia, N (``travel`` from the motion's level 0, m)."""
        weight = self.mass * self.gravity * np.cos(self.up_angle)
        static = self.force + self.preload + self.spring_rate * travel + weight
        k = self.table_factor
        return static + k * tabulated(self.force_table, travel) + k * tabulated(self.cam_angle_table, cam_angle)

    def resisting_force(
        self, travel: Value, acceleration: Value, cam_angle: Value = 0.0, velocity: Value = 0.0
    ) -> Array:
        """Force along the travel, N (``velocity`` and ``acceleration`` by the cam angle)."""
        moving = self.mass * self.speed**2 * acceleration + self.damping * self.speed * velocity
        return moving + self.static_force(travel, cam_angle)

    def opposite(self) -> SlideLoad:
        """The same load as a second cam on the other side of the follower feels it."""
        return self.replace(
            force=-(self.force + self.preload),
            preload=0.0,
            up_angle=self.up_angle + np.pi,
            force_table=opposite_table(self.force_table, -1),
            cam_angle_table=opposite_table(self.cam_angle_table, 1),
        )


@dataclass(frozen=True)
class SlideFriction(FollowerFriction):
    """Friction of a sliding follower: at the cam, in the pins and at both ends of its guide."""

    guide: float = quantity("mu", 0.1, 0, 0.3, "", "friction in the guide", at_least=0)
    overhang: float = quantity("A", 20, 0, 100, "mm", "follower at its highest to the guide", at_least=0)
    guide_length: float = quantity("B", 60, 20, 200, "mm", "between the two ends of the guide")
