"""Universal joints in a row, as many as there are: the driveline of a truck, of a rolling mill, of a propeller.

From joint to joint the direction of a fork turns as a vector ``p = (cos, sin)`` does, counted from where the fork lies
in the plane of its joint: a joint at ``beta`` makes ``diag(cos beta, 1) p`` of it, the shaft behind turns it by 90 deg
and by the ``phase`` of its forks, less the angle by which the ``plane`` of the next joint is turned.  Of the product
``M`` of all these matrices its condition ``k`` alone says how unevenly the driven shaft turns: from ``1/k`` to ``k`` of
the input's speed, as behind one joint with ``cos beta_e = 1/k``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import ClassVar

import numpy as np

from ..geometry import dot, vector
from ..quantities import Design, Measure, Quantity, choice, counted, numbered, quantity, row, unless
from ..quantities.kinds import a_number, listed, one_number, refuse_lengths
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import deg
from .cross import Cross
from .universal_joint import (
    FEWEST,
    UNIVERSAL_JOINT_MEASURES,
    equivalent_angle,
    inertial_excitation,
    peak,
    torsional_excitation,
)

ANGLE = Quantity("beta", 8, 0, 45, "deg", "between the shafts of a joint", at_least=0, name="joint angle")
PHASE = Quantity("delta", 0, -90, 90, "deg", "twist of the forks of a shaft", above=None, name="fork phase")
PLANE = Quantity(
    "gamma", 0, -180, 180, "deg", "from the plane of one joint to that of the next", above=None, name="joint plane"
)
FORKS = {"as they are": 0, "of the last shaft turned to cancel best": 1}
Matrix = tuple[Value, Value, Value, Value]
"""``(m11, m12, m21, m22)``."""


def _times(a: Matrix, b: Matrix) -> Matrix:
    return a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]


def _bent(angle: Value) -> Matrix:
    return np.cos(angle), 0.0, 0.0, 1.0


def _turn(by: Value) -> Matrix:
    return np.cos(by), -np.sin(by), np.sin(by), np.cos(by)


def _second_order(m: Matrix) -> Value:
    """``tan(beta_e / 2)^2`` of the one joint that turns as unevenly as a product of joints.

    ``k + 1/k - 2`` is a sum of squares, ``((m11 - m22)^2 + (m12 + m21)^2) / det``, which loses no digits where the
    joints all but cancel.
    """
    excess = ((m[0] - m[3]) ** 2 + (m[1] + m[2]) ** 2) / (m[0] * m[3] - m[1] * m[2])
    return np.tanh(np.arcsinh(np.sqrt(excess) / 2))


def _rotated(points: Array, axis: Array, angle: Value) -> Array:
    """A vector turned about a unit vector (Rodrigues)."""
    across = np.cross(axis, points)
    return np.cos(angle) * points + np.sin(angle) * across + (1 - np.cos(angle)) * dot(axis, points) * axis


@dataclass(frozen=True)
class Driveline(Design):
    """Universal joints in a row, the input shaft turning evenly, without friction.

    ``angles`` of the joints from the input on, ``phases`` of the forks of the shafts between them, and ``planes``: by
    how much the plane in which a joint bends is turned about the shaft from that of the joint before, all rad; of these
    there is one less.  Without them every shaft's forks are in line, and all shafts lie in one plane.

    >>> line = Driveline((10 * deg, 8 * deg, 6 * deg)).analyse()
    >>> print(f"{line.equivalent_angle / deg:.4f} deg, by the handbook {line.handbook_angle / deg:.4f} deg")
    8.4914 deg, by the handbook 8.4853 deg

    Raises ``ValueError`` for an angle of 90 deg or more, and where there are not one phase and one plane less than
    joints.
    """

    angles: tuple[Value, ...] = row(numbered("angle", ANGLE, 1), default=(10 * deg, 8 * deg, 6 * deg))
    phases: tuple[Value, ...] = row(numbered("phase", PHASE, 1), default=())
    planes: tuple[Value, ...] = row(numbered("plane", PLANE, 1), default=())
    forks: int = choice("F", 0, FORKS, "forks of the shafts between the joints")
    speed: float = quantity("n", 500, 0, 3000, "rpm", "input shaft", at_least=0)
    torque: float = quantity("T", 100, 0, 1000, "N m", "in the input shaft", above=None)

    def __post_init__(self) -> None:
        for name, declared in (("angles", ANGLE), ("phases", PHASE), ("planes", PLANE)):
            given = listed(getattr(self, name), f"the {name} of the driveline")
            if name != "angles" and not given:
                given = (0.0,) * (len(self.angles) - 1)
            must, what = f"be {declared.possible}", f"one of the {name} of the driveline"
            object.__setattr__(self, name, tuple(a_number(x, what, must, declared.allows) for x in given))
        n, phases, planes = len(self.angles), len(self.phases), len(self.planes)
        if not n or phases != n - 1 or planes != n - 1:
            raise ValueError(
                f"the driveline has {n} joints, {phases} phases and {planes} planes; it must have one joint or more, "
                "and a phase and a plane for each shaft between two joints"
            )
        for i, angle in enumerate(self.angles):
            if refuse := unless(angle < np.pi / 2):
                refuse(f"joint angle {i + 1} is {angle / deg:.6g} deg; a universal joint turns below 90 deg only")
        super().__post_init__()
        refuse_lengths(self)

    def following(self) -> dict[str, str]:
        """The phase of the last shaft, where it is solved for."""
        last = len(self.phases) - 1
        return {f"phase{last}": "it is turned so that the joints cancel best"} if self.forks and last >= 0 else {}

    def best_phase(self, shaft: int) -> Value:
        """The phase of a shaft between two joints, the first being 1, at which the driven shaft turns most evenly.

        With ``A`` the joints behind the shaft and ``B`` those before it, ``|A R(t) B|`` is least where the long way out
        of ``B`` becomes the short way into ``A``.  rad, from -90 up to 90 deg.

        >>> line = Driveline((10 * deg, 8 * deg, 6 * deg))
        >>> print(f"{line.best_phase(2) / deg:.1f} deg")
        -90.0 deg
        """
        must = f"be a whole number from 1 to {len(self.phases)}"
        one_number(shaft, "the shaft whose phase is wanted", must, lambda i: i in range(1, len(self.phases) + 1))
        turns = [np.pi / 2 + a - b for a, b in zip(self.phases, self.planes, strict=True)]
        before, behind = _bent(self.angles[0]), _bent(self.angles[-1])
        for angle, turn in zip(self.angles[1:shaft], turns, strict=False):
            before = _times(_bent(angle), _times(_turn(turn), before))
        for angle, turn in zip(self.angles[-2 : shaft - 1 : -1], turns[::-1], strict=False):
            behind = _times(_times(behind, _turn(turn)), _bent(angle))
        (a, b, c, d), (e, f, g, h) = before, behind
        out = np.arctan2(a * c + b * d, (a**2 + b**2 - c**2 - d**2) / 2)
        into = np.arctan2(e * f + g * h, (e**2 + g**2 - f**2 - h**2) / 2)
        phase = (into - out - np.pi) / 2 - np.pi / 2 + self.planes[shaft - 1]
        return np.mod(phase + np.pi / 2 + ROUNDING, np.pi) - np.pi / 2 - ROUNDING

    def analyse(self, n: int = 361) -> DrivelineAnalysis:
        """Angles, speeds, torques and couples at ``n`` input angles of a turn, 61 or more: peaks are those at them."""
        return DrivelineAnalysis(self, np.linspace(0, 2 * np.pi, counted(n, "input angles", FEWEST)))


ROUNDING = 1e-9
"""A phase that lies below -90 deg by no more is -90 deg, rad."""


@dataclass(frozen=True)
class DrivelineAnalysis:
    """What follows from a `Driveline` at the input angles; ``(n,)`` or ``(p, n)``."""

    offers: ClassVar[tuple[str | AnalysisCurve, ...]] = (
        "shafts",
        AnalysisCurve("output_speed", "rpm", "speed of the driven shaft"),
        AnalysisCurve("lead", "deg", "lead of the driven shaft"),
        AnalysisCurve("output_torque", "N m", "torque in the driven shaft"),
        AnalysisCurve("output_couple", "N m", "couple on the driven shaft's bearings"),
    )
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    line: Driveline
    input_angle: np.ndarray

    @property
    def crank_angle(self) -> np.ndarray:
        """The input angle, by the name under which a panel turns a mechanism."""
        return self.input_angle

    @cached_property
    def phases(self) -> tuple[Value, ...]:
        """Of the forks of the shafts between the joints, rad, the last as it is solved for where that is wanted."""
        phases, last = self.line.phases, len(self.line.phases)
        return (*phases[:-1], self.line.best_phase(last)) if self.line.forks and last else phases

    @cached_property
    def _turns(self) -> list[Value]:
        """By how much the fork at a joint is turned from the output of the joint before, rad."""
        return [np.pi / 2 + phase - plane for phase, plane in zip(self.phases, self.line.planes, strict=True)]

    @cached_property
    def crosses(self) -> list[Cross]:
        """Geometry of each joint."""
        found = [Cross(self.line.angles[0], self.input_angle)]
        for angle, turn in zip(self.line.angles[1:], self._turns, strict=True):
            found.append(Cross(angle, found[-1].output_angle + turn))
        return found

    @cached_property
    def planes(self) -> list[tuple[Array, Array]]:
        """Direction of each shaft in space and the normal of the plane of the joint behind it, ``(3,)``, one design.

        The input shaft lies along x, and its joint bends it in the plane of x and y.
        """
        along, normal = vector(1.0, 0.0, 0.0), vector(0.0, 0.0, 1.0)
        found = [(along, normal)]
        for angle, plane in zip(self.line.angles, (*self.line.planes, 0.0), strict=True):
            along = _rotated(along, normal, angle)
            normal = _rotated(normal, along, plane)
            found.append((along, normal))
        return found

    @property
    def shafts(self) -> list[Array]:
        """Direction of each shaft in space, the input first, ``(3,)``, one design."""
        return [along for along, _ in self.planes]

    def pins(self, turn: Value) -> list[tuple[Array, Array]]:
        """At each joint the pins of the shaft before it and of that behind it, the input turned by ``turn`` (rad).

        Unit vectors ``(3,)``, of one design.
        """
        line = DrivelineAnalysis(self.line, np.atleast_1d(turn))
        found = []
        for cross, (along, normal), (behind, _) in zip(line.crosses, self.planes, self.planes[1:], strict=False):
            angle = np.atleast_1d(cross.input_angle)[..., 0]
            pin = np.cos(angle) * np.cross(normal, along) + np.sin(angle) * normal
            other = np.cross(behind, pin)
            found.append((pin, other / np.sqrt(dot(other, other))))
        return found

    @cached_property
    def speed_ratios(self) -> list[Value]:
        """Speed of each shaft over that of the input, the input first."""
        found = [1.0 + 0.0 * self.lead]
        for cross in self.crosses:
            found.append(found[-1] * cross.ratio)
        return found

    @property
    def joints(self) -> int:
        """How many there are."""
        return len(self.line.angles)

    @property
    def lead(self) -> Value:
        """Of the driven shaft ahead of the input shaft, rad."""
        return sum(cross.lead for cross in self.crosses)

    @property
    def output_angle(self) -> Value:
        """Of the driven shaft, rad."""
        return self.input_angle + self.lead

    @property
    def speed_ratio(self) -> Value:
        """Speed of the driven shaft over that of the input."""
        return self.speed_ratios[-1]

    @property
    def output_speed(self) -> Value:
        """Of the driven shaft, rad/s."""
        return self.line.speed * self.speed_ratio

    @property
    def output_acceleration(self) -> Value:
        """Of the driven shaft, rad/s^2: ``omega^2 r`` times the sum of ``r_i' / r_i``, by the angle of the input."""
        grown = sum(c.ratio_slope / c.ratio * r for c, r in zip(self.crosses, self.speed_ratios, strict=False))
        return self.line.speed**2 * self.speed_ratio * grown

    @cached_property
    def shaft_torques(self) -> list[Value]:
        """In each shaft, the input first, N m: power in = power out."""
        return [self.line.torque / ratio for ratio in self.speed_ratios]

    @property
    def output_torque(self) -> Value:
        """In the driven shaft, N m."""
        return self.shaft_torques[-1]

    @cached_property
    def couples(self) -> list[tuple[Value, Value]]:
        """At each joint the couples that bend the shaft before it and the shaft behind it, N m."""
        ends = zip(self.crosses, self.shaft_torques, self.shaft_torques[1:], strict=False)
        return [(cross.input_couple * before, cross.output_couple * behind) for cross, before, behind in ends]

    @property
    def input_couple(self) -> Value:
        """Secondary couple on the input shaft's bearings, N m."""
        return self.couples[0][0]

    @property
    def output_couple(self) -> Value:
        """Secondary couple on the driven shaft's bearings, N m."""
        return self.couples[-1][1]

    @cached_property
    def _second_orders(self) -> list[Value]:
        """Of the lead of each shaft behind a joint, rad."""
        m = _bent(self.crosses[0].bend)
        found = [_second_order(m)]
        for cross, turn in zip(self.crosses[1:], self._turns, strict=True):
            m = _times(_bent(cross.bend), _times(_turn(turn), m))
            found.append(_second_order(m))
        return found

    @property
    def second_order(self) -> Value:
        """Second order of the driven shaft's `lead`, ``tan(beta_e / 2)^2`` of the equivalent angle, rad."""
        return self._second_orders[-1]

    @cached_property
    def equivalent_angle(self) -> Value:
        """``beta_e``: angle of the one joint that would turn the driven shaft as unevenly, rad."""
        return 2 * np.arctan(np.sqrt(self.second_order))

    @cached_property
    def handbook_angle(self) -> Value:
        """The same as handbooks have it, ``sqrt(|sum beta_i^2 exp(2 j t_i)|)``, for small angles, rad.

        ``t_i`` is by how much the forks up to the joint are turned: forks in line and all in one plane make it
        ``sqrt(beta_1^2 - beta_2^2 + beta_3^2 - ...)``.
        """
        turned: Sequence[Value] = [sum(self._turns[:i], 0.0) for i in range(self.joints)]
        x, y = (
            sum(angle**2 * wave(2 * t) for angle, t in zip(self.line.angles, turned, strict=True))
            for wave in (np.cos, np.sin)
        )
        return np.sqrt(np.hypot(x, y))

    @property
    def torsional_excitation(self) -> Value:
        """Second order of the driven shaft's acceleration, rad/s^2; near handbooks' ``omega^2 beta_e^2``."""
        return 4 * self.line.speed**2 * self.second_order

    @property
    def inertial_excitation(self) -> Value:
        """Largest second order of the acceleration of a shaft between two joints, rad/s^2; 0 where there is none."""
        return 4 * self.line.speed**2 * reduce(np.maximum, self._second_orders[:-1], 0.0 * self.second_order)


def _largest_couple(analysis: DrivelineAnalysis) -> Value:
    """The largest couple on the bearings of any shaft, N m."""
    sizes: list[Array] = [np.maximum(np.abs(first), np.abs(second)).max(-1) for first, second in analysis.couples]
    return reduce(np.maximum, sizes)


handbook_angle = peak("equivalent angle by the handbook", "deg", "handbook_angle")
peak_couple = Measure("peak couple on any shaft's bearings", "N m", _largest_couple)

DRIVELINE_MEASURES = (
    *UNIVERSAL_JOINT_MEASURES,
    peak_couple,
    equivalent_angle,
    handbook_angle,
    torsional_excitation,
    inertial_excitation,
)
"""Measures of joints in a row."""
Driveline.measures = DRIVELINE_MEASURES
