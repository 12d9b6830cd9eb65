"""What the arm of a high-speed cam resists with: each load is a ``name`` and a ``resisting_torque``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..cam.loads import Table, as_table, tabulated
from ..motion import Kinematics
from ..quantities import Design, quantity
from ..quantities.types import Array, Value


@dataclass(frozen=True)
class InertialSpringLoad(Design):
    """A mass that the arm swings and a spring that keeps it on the cam.

    ``M = J omega_0^2 [n^2 psi'' + (alpha_s PS + psi) K]``: ``PS`` is the swing, ``K`` the rate of the closing spring
    over ``J omega_0^2`` at the rated speed, ``alpha_s PS`` how far the spring is wound up before the arm moves.
    A spring keeps its stiffness: with the share ``n`` of the rated speed inertia grows by ``n^2``, the spring does not.

    Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov (table 1).
    """

    inertia_speed2: float = quantity("J omega^2", 10, 0.1, 100, "N m", "inertia of the arm by rated speed squared")
    closing: float = quantity("alpha_s", 0.5, 0, 2, "", "winding of the spring at the start / swing", at_least=0)

    name: ClassVar[str] = "inertia and closing spring"

    def resisting_torque(self, motion: Kinematics, swing: Array, spring_factor: Value, speed: Value) -> Array:
        """About the arm's pivot, N m; ``speed`` is a share of the speed for which ``inertia_speed2`` is given."""
        spring = (self.closing * swing + motion.s) * spring_factor
        return self.inertia_speed2 * (speed**2 * motion.a + spring)

    def spring_rate(self, spring_factor: Value) -> Value:
        """Of the closing spring, N m/rad."""
        return self.inertia_speed2 * spring_factor

    def preload(self, swing: Array, spring_factor: Value) -> Array:
        """Torque of the spring before the arm moves, N m."""
        return self.inertia_speed2 * self.closing * swing * spring_factor


@dataclass(frozen=True)
class ConstantTorque(Design):
    """The same torque at every angle (table 2 of the same paper).

    >>> ConstantTorque(-1)
    Traceback (most recent call last):
        ...
    ValueError: the torque (constant torque on the arm) is -1 N m; it must be a finite number above 0 N m
    """

    torque: float = quantity("M", 10, 0.1, 100, "N m", "constant torque on the arm")

    name: ClassVar[str] = "constant torque"

    def resisting_torque(self, motion: Kinematics, swing: Value, spring_factor: Value, speed: Value) -> Array:
        """About the arm's pivot, N m."""
        return self.torque + 0.0 * motion.s


@dataclass(frozen=True)
class SliderLoad(Design):
    """A lever of length ``x`` that lifts a slider and swings evenly about the level.

    ``M = [G + P(s)] x cos(psi - PS / 2) + J omega^2 psi''``: ``G`` weight, ``P`` force of the work at the slider's
    way ``s = x [sin(psi - PS / 2) + sin(PS / 2)]``.  No spring: the weight keeps the roller on the cam.
    """

    lever: float = quantity("x", 250, 200, 300, "mm", "lever: pivot to slider")
    weight: float = quantity("G", 147, 10, 1000, "N", "weight of the slider")
    inertia_speed2: float = quantity(
        "J omega^2", 25, 0.1, 100, "N m", "inertia of the lever by rated speed squared", at_most=1e12
    )
    force: Table | Callable[[Value], Value] = ()
    """``P`` in N of ``s`` in m: a function, or a table of pairs joined by straight lines."""

    name: ClassVar[str] = "slider on a lever"

    def __post_init__(self) -> None:
        if not callable(self.force):
            object.__setattr__(self, "force", as_table("force", "way", "force", self.force))
        super().__post_init__()

    def _force(self, way: Value) -> Value:
        return self.force(way) if callable(self.force) else tabulated(self.force, way)

    def way(self, motion: Kinematics, swing: Array) -> Value:
        """``s``: of the slider from its lowest position, m."""
        return self.lever * (np.sin(motion.s - swing / 2) + np.sin(swing / 2))

    def resisting_torque(self, motion: Kinematics, swing: Array, spring_factor: Value, speed: Value) -> Array:
        """About the lever's pivot, N m."""
        static = self.weight + self._force(self.way(motion, swing))
        inertia = self.inertia_speed2 * speed**2 * motion.a
        return static * self.lever * np.cos(motion.s - swing / 2) + inertia
