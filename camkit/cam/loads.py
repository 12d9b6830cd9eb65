"""What a rocking arm resists with, and what rubs on the way from cam to arm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..quantities import Design, quantity
from ..quantities.kinds import numbers, shown
from ..quantities.types import Array, Value


@dataclass(frozen=True)
class ArmLoad(Design):
    """The torque that a cam must put into a rocking arm.

    Inertia of a uniform arm, ``I = m l^2 / 3`` (Gong, Liu, He 2025), and what a real machine adds: a
    constant torque, torques tabulated over the arm's travel and over the cam angle, a torsion spring, the
    arm's weight, damping.  Torque counts positive where it resists a growing arm angle.
    """

    mass: float = quantity("m", 2, 0, 10, "kg", "uniform arm", at_least=0, name="arm mass")
    speed: float = quantity("omega", 15, 0, 100, "rpm", "speed of the cam", at_least=0, name="cam speed")
    torque: float = quantity("T", 0, -50, 50, "N m", "constant resisting torque", above=None, name="resisting torque")
    spring_rate: float = quantity("c", 0, 0, 50, "N m/rad", "torsion spring on the arm", at_least=0, name="spring rate")
    preload: float = quantity(
        "T_0", 0, 0, 50, "N m", "torque of the spring at the motion's level 0", at_least=0, name="spring preload"
    )
    gravity: float = quantity(
        "g", 0, 0, 9.81, "m/s^2", "weight of the arm; 0: it turns level", at_least=0, name="gravity"
    )
    up_angle: float = quantity(
        "u", 90, -180, 180, "deg", "from the line cam-pivot to straight up", above=None, name="direction of gravity"
    )
    torque_table: tuple[tuple[float, float], ...] = ()
    """Pairs of arm travel (from the motion's level 0) [rad] and resisting torque [N m], in order; straight between."""
    cam_angle_table: tuple[tuple[float, float], ...] = ()
    """The same over the cam angle [rad]: the work of the machine, which differs between rise and return."""
    table_factor: float = quantity("k", 1, 0, 3, "", "by which what the tables give is multiplied", above=None)
    damping: float = quantity(
        "d", 0, 0, 10, "N m s/rad", "torque over the arm's velocity", at_least=0, name="arm damping"
    )

    def __post_init__(self) -> None:
        torques = as_table("torque table", "travel", "torque", self.torque_table)
        object.__setattr__(self, "torque_table", torques)
        torques = as_table("cam angle table", "cam angle", "torque", self.cam_angle_table)
        object.__setattr__(self, "cam_angle_table", torques)
        super().__post_init__()

    def following(self) -> dict[str, str]:
        """Without a table its factor has no effect."""
        entries = len(self.torque_table) + len(self.cam_angle_table)
        return {} if entries else {"table_factor": "there is no table of the load"}

    @property
    def travel_table(self) -> Table:
        """The table over the travel, whatever it holds."""
        return self.torque_table

    def inertia(self, arm_length: Value) -> Value:
        """Moment of inertia about the arm's pivot, kg m^2."""
        return self.mass * arm_length**2 / 3

    def static_torque(self, arm_length: Value, arm_angle: Value, travel: Value, cam_angle: Value = 0.0) -> Array:
        """Torque about the arm's pivot without its inertia, N m (``travel`` from the motion's level 0, rad)."""
        weight = self.mass * self.gravity * arm_length / 2 * np.sin(arm_angle + self.up_angle)
        static = self.torque + self.preload + self.spring_rate * travel + weight
        k = self.table_factor
        return static + k * tabulated(self.torque_table, travel) + k * tabulated(self.cam_angle_table, cam_angle)

    def arm_force(self, arm_length: Value, arm_angle: Value, velocity: Value, acceleration: Value) -> Array:
        """Weight and inertia of the uniform arm, machine's frame, ``(2, n)``, N: what else it resists with is a couple.

        ``velocity`` and ``acceleration`` are those by the cam angle.
        """
        sin, cos, up, turns = np.sin(arm_angle), np.cos(arm_angle), self.up_angle, arm_length / 2 * self.speed**2
        x = self.gravity * np.cos(up) + turns * (acceleration * sin + velocity**2 * cos)
        y = self.gravity * np.sin(up) + turns * (acceleration * cos - velocity**2 * sin)
        return -np.stack(np.broadcast_arrays(self.mass * x, self.mass * y))

    def resisting_torque(
        self,
        arm_length: Value,
        arm_angle: Value,
        travel: Value,
        acceleration: Value,
        cam_angle: Value = 0.0,
        velocity: Value = 0.0,
    ) -> Array:
        """Torque about the arm's pivot, N m, at each arm angle (``travel`` from the motion's level 0, rad).

        ``velocity`` and ``acceleration`` are those by the cam angle.
        """
        moving = self.inertia(arm_length) * self.speed**2 * acceleration + self.damping * self.speed * velocity
        return moving + self.static_torque(arm_length, arm_angle, travel, cam_angle)

    def opposite(self, spread: Value, arm_length: Value, other_length: Value) -> ArmLoad:
        """The same load as a second arm of ``other_length`` on the same shaft feels it, mirrored.

        The second arm's angle is ``spread`` less this one's, so all that resists the one helps the other.
        """
        ratio = arm_length / other_length
        return self.replace(
            mass=self.mass * ratio**2,
            gravity=self.gravity / ratio,
            up_angle=-spread - self.up_angle,
            torque=-(self.torque + self.preload),
            preload=0.0,
            torque_table=opposite_table(self.torque_table, -1),
            cam_angle_table=opposite_table(self.cam_angle_table, 1),
        )


Table = tuple[tuple[float, float], ...]
"""Pairs of an argument and a load, in order of the argument."""
LARGEST = 1e9
"""A load (N, N m) or what it is tabulated over (m, rad) above this is a slip."""


def as_table(name: str, first: str, second: str, table: object) -> Table:
    """``table``, a tuple, list or array of pairs, as a tuple of pairs of floats.

    ``ValueError`` if it is none, has an entry that is no finite number of a possible size, or is out of order.

    >>> as_table("torque table", "travel", "torque", np.array([[0, 1], [2, 3]]))
    ((0.0, 1.0), (2.0, 3.0))
    """
    try:
        entries = numbers(table, name)
    except ValueError:
        entries = np.zeros(1)
    if entries.shape != (0,) and entries.shape[1:] != (2,):
        raise ValueError(f"the {name} is {shown(table)}; it must hold pairs of numbers ({first}, {second})")
    if not np.isfinite(entries).all():
        raise ValueError(f"the {name} has an entry that is not a finite number; it holds ({first}, {second})")
    if (abs(entries) > LARGEST).any():
        most = f"at most {LARGEST:g} in size"
        raise ValueError(f"the {name} has the entry {entries[abs(entries) > LARGEST][0]:g}; an entry must be {most}")
    if entries.size and (np.diff(entries[:, 0]) <= 0).any():
        raise ValueError(f"the {name}'s {first} must grow from entry to entry; it does not")
    return tuple((at, load) for at, load in entries.tolist())


def tabulated(table: Table, at: Value) -> Value:
    """The load that ``table`` gives, straight between its entries and constant outside; 0 from an empty one."""
    return np.interp(at, *np.transpose(table)) if len(table) else 0.0


def opposite_table(table: Table, side: int) -> Table:
    """``table`` with the load reversed, and with ``side=-1`` the argument too."""
    return tuple((side * x, -load) for x, load in table[::side])


@dataclass(frozen=True)
class Contact:
    """Where and how cam and roller meet; lengths in m, ``alpha`` in rad, arrays ``(n,)`` or ``(p, n)``."""

    arm_length: Value
    roller_radius: Value
    rotation: int
    velocity: Array
    alpha: Value
    offset: Array
    """``Q = R sin(alpha - beta)``: cam axis to the contact normal."""
    reach: Array
    """``B = R cos(alpha - beta)``: along the normal to the roller's centre."""

    @property
    def sense(self) -> Value:
        """``k``: +1 where the arm's angle changes against the cam's rotation, -1 where it goes with it."""
        return np.where(self.rotation * self.velocity < 0, -1.0, 1.0)


@dataclass(frozen=True)
class FollowerFriction(Design):
    """Coulomb friction between cam and follower, friction circles of the pins that every follower has.

    A friction circle has the radius ``pin radius * coefficient``: the force in the pin touches it.
    """

    coefficient: float = quantity("f", 0.05, 0, 0.3, "", "friction between cam and follower", at_least=0)
    cam_axis: float = quantity("rho_1", 1.5, 0, 5, "mm", "friction circle of the cam axis", at_least=0)
    roller_pin: float = quantity("rho_2", 0.5, 0, 5, "mm", "friction circle of the roller pin", at_least=0)


@dataclass(frozen=True)
class Friction(FollowerFriction):
    """Friction of a rocking arm: at the cam and in the pins, that of its pivot too."""

    arm_pivot: float = quantity("rho_3", 1, 0, 5, "mm", "friction circle of the arm pivot", at_least=0)

    def published_efficiency(self, contact: Contact) -> Array:
        """Power out over power in as published, every friction counted as a loss: equation (21), put right.

        ``eta = |v| T / M`` with ``lam = arctan f`` and ``k = +1`` where the arm's angle changes against the rotation

            T = F [l cos(alpha + k lam) - r sin(lam) - rho_2 - rho_3]
            M = F [R sin(alpha - beta + lam) - r sin(lam) + rho_1]

        The print lacks the square root over ``R^2`` and misplaces brackets.  Two terms are on the cautious
        side: the roller's shift ``r sin(lam)`` helps the arm where ``sigma = +1``, and a roller that slides
        does not turn on its pin.  `camkit.cam.statics.efficiency` has neither.
        """
        c, lam = contact, np.arctan(self.coefficient)
        shift = c.roller_radius * np.sin(lam)
        arm = c.arm_length * np.cos(c.alpha + c.sense * lam) - shift - self.roller_pin - self.arm_pivot
        cam = abs(c.offset) * np.cos(lam) + c.reach * np.sin(lam) - shift + self.cam_axis
        return _power_ratio(c, arm, cam)


def _power_ratio(contact: Contact, arm: Array, cam: Array) -> Array:
    """``|v| arm / cam``; 0 where the arm rests, and 0 where friction jams it (``arm`` not positive)."""
    v = abs(contact.velocity)
    return np.where(v == 0, 0.0 * arm, np.maximum(v * arm, 0.0) / np.where(v == 0, 1.0, cam))
