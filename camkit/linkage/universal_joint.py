"""Universal (Hooke's, cardan) joints: how evenly they turn what they drive, alone or two in a row.

An input shaft turns evenly by the angle ``phi``, counted from where its fork lies in the plane of the two shafts.
A joint at the angle ``beta`` turns its output by ``psi`` with ``tan psi = tan phi / cos beta``: faster than the
input where the input's fork lies in the plane of the shafts, slower where it stands square to it, twice a turn.

Formulas as in every textbook of machine kinematics; signs and phases are checked against vector geometry.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..quantities import Design, Measure, counted, quantity, unless
from ..quantities.types import Value
from ..units import deg
from .cross import Cross


def _refuse_square(name: str, angle: Value) -> None:
    if refuse := unless(angle < np.pi / 2):
        refuse(f"the {name} is {angle / deg:.6g} deg; a universal joint turns below 90 deg only")


FEWEST = 61
"""Input angles of a turn: with fewer, peaks between them would be missed."""


@dataclass(frozen=True)
class UniversalJoint(Design):
    """One universal joint, its input shaft turning evenly, without friction.

    >>> from camkit.units import rpm
    >>> joint = UniversalJoint(angle=20*deg, speed=500*rpm).analyse()
    >>> print(f"{joint.output_speed.min() / rpm:.2f} to {joint.output_speed.max() / rpm:.2f} rpm")
    469.85 to 532.09 rpm

    Raises ``ValueError`` for an angle of 90 deg or more.
    """

    angle: float = quantity("beta", 20, 0, 45, "deg", "between the shafts", at_least=0)
    speed: float = quantity("n", 500, 0, 3000, "rpm", "input shaft", at_least=0)
    torque: float = quantity("T", 100, 0, 1000, "N m", "in the input shaft", above=None)

    def __post_init__(self) -> None:
        super().__post_init__()
        _refuse_square("angle", self.angle)

    def analyse(self, n: int = 361) -> UniversalJointAnalysis:
        """Angles, speeds and couples at ``n`` input angles of one turn, 61 or more: peaks are looked for at these."""
        return UniversalJointAnalysis(self, np.linspace(0, 2 * np.pi, counted(n, "input angles", FEWEST)))


@dataclass(frozen=True)
class UniversalJointAnalysis:
    """What follows from a `UniversalJoint` at the input angles; ``(n,)`` or ``(p, n)``."""

    joint: UniversalJoint
    input_angle: np.ndarray

    @cached_property
    def cross(self) -> Cross:
        """The joint's geometry."""
        return Cross(self.joint.angle, self.input_angle)

    @property
    def output_angle(self) -> Value:
        """Of the output shaft, rad."""
        return self.cross.output_angle

    @property
    def lead(self) -> Value:
        """Of the output shaft ahead of the input shaft, rad."""
        return self.cross.lead

    @property
    def speed_ratio(self) -> Value:
        """Output speed over input speed."""
        return self.cross.ratio

    @property
    def output_speed(self) -> Value:
        """rad/s."""
        return self.joint.speed * self.cross.ratio

    @property
    def output_acceleration(self) -> Value:
        """rad/s^2."""
        return self.joint.speed**2 * self.cross.ratio_slope

    @property
    def output_torque(self) -> Value:
        """Power in = power out: ``T / ratio``, N m."""
        return self.joint.torque / self.cross.ratio

    @property
    def input_couple(self) -> Value:
        """Secondary couple on the input shaft's bearings, N m (see `Cross.input_couple`)."""
        return self.joint.torque * self.cross.input_couple

    @property
    def output_couple(self) -> Value:
        """Secondary couple on the output shaft's bearings, N m (see `Cross.output_couple`)."""
        return self.output_torque * self.cross.output_couple


@dataclass(frozen=True)
class DoubleUniversalJoint(Design):
    """Two universal joints and the shaft between them, the input shaft turning evenly, without friction.

    Equal angles and forks in phase cancel: the driven shaft turns as evenly as the input.  ``phase`` is how far the
    intermediate shaft's forks are turned against each other from there.  In a drive whose joints bend in
    different planes it is counted from where each fork lies in the plane of its own joint.

    >>> from camkit.units import rpm
    >>> drive = DoubleUniversalJoint(first_angle=20*deg, second_angle=20*deg, phase=90*deg, speed=500*rpm).analyse()
    >>> print(f"{drive.output_speed.min() / rpm:.1f} to {drive.output_speed.max() / rpm:.1f} rpm")
    441.5 to 566.2 rpm

    Raises ``ValueError`` for an angle of 90 deg or more.
    """

    first_angle: float = quantity("beta_1", 20, 0, 45, "deg", "between input and intermediate shaft", at_least=0)
    second_angle: float = quantity("beta_2", 20, 0, 45, "deg", "between intermediate and driven shaft", at_least=0)
    phase: float = quantity("delta", 0, -90, 90, "deg", "twist of the intermediate shaft's forks", above=None)
    speed: float = quantity("n", 500, 0, 3000, "rpm", "input shaft", at_least=0)
    torque: float = quantity("T", 100, 0, 1000, "N m", "in the input shaft", above=None)
    inertia: float = quantity("J", 0, 0, 5, "kg m^2", "intermediate shaft with its forks", at_least=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        _refuse_square("first angle", self.first_angle)
        _refuse_square("second angle", self.second_angle)

    def analyse(self, n: int = 361) -> DoubleUniversalJointAnalysis:
        """Angles, speeds, torques and couples at ``n`` input angles of a turn, 61 or more: peaks are those at them."""
        return DoubleUniversalJointAnalysis(self, np.linspace(0, 2 * np.pi, counted(n, "input angles", FEWEST)))


@dataclass(frozen=True)
class DoubleUniversalJointAnalysis:
    """What follows from a `DoubleUniversalJoint` at the input angles; ``(n,)`` or ``(p, n)``."""

    offers: ClassVar[tuple[str, ...]] = (
        "drive",
        "output_speed",
        "lead",
        "output_torque",
        "output_couple",
    )
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    drive: DoubleUniversalJoint
    input_angle: np.ndarray

    @property
    def crank_angle(self) -> np.ndarray:
        """The input angle, by the name under which a panel turns a mechanism."""
        return self.input_angle

    @property
    def _turned(self) -> Value:
        """The second joint's fork against the first one's: square to it in phase, rad."""
        return np.pi / 2 + self.drive.phase

    @cached_property
    def first(self) -> Cross:
        """Geometry of the joint at the input."""
        return Cross(self.drive.first_angle, self.input_angle)

    @cached_property
    def second(self) -> Cross:
        """Geometry of the joint at the driven shaft."""
        return Cross(self.drive.second_angle, self.first.output_angle + self._turned)

    @property
    def intermediate_angle(self) -> Value:
        """rad."""
        return self.first.output_angle

    @property
    def output_angle(self) -> Value:
        """Of the driven shaft, rad."""
        return self.second.output_angle - self._turned

    @property
    def lead(self) -> Value:
        """Of the driven shaft ahead of the input shaft, rad."""
        return self.first.lead + self.second.lead

    @property
    def intermediate_speed(self) -> Value:
        """rad/s."""
        return self.drive.speed * self.first.ratio

    @property
    def intermediate_acceleration(self) -> Value:
        """rad/s^2; it is there however well the joints cancel."""
        return self.drive.speed**2 * self.first.ratio_slope

    @property
    def speed_ratio(self) -> Value:
        """Speed of the driven shaft over that of the input."""
        return self.first.ratio * self.second.ratio

    @property
    def output_speed(self) -> Value:
        """Of the driven shaft, rad/s."""
        return self.drive.speed * self.speed_ratio

    @property
    def output_acceleration(self) -> Value:
        """Of the driven shaft, rad/s^2: ``omega^2 (r_1' r_2 + r_1^2 r_2')``."""
        first, second = self.first, self.second
        return self.drive.speed**2 * (first.ratio_slope * second.ratio + first.ratio**2 * second.ratio_slope)

    @cached_property
    def inertia_torque(self) -> Value:
        """What the intermediate shaft's inertia takes, N m."""
        return self.drive.inertia * self.intermediate_acceleration

    @cached_property
    def intermediate_torque(self) -> Value:
        """In the intermediate shaft at its driven end, ``T / r_1 - J alpha``, N m."""
        return self.drive.torque / self.first.ratio - self.inertia_torque

    @property
    def output_torque(self) -> Value:
        """In the driven shaft, N m."""
        return self.intermediate_torque / self.second.ratio

    @property
    def input_couple(self) -> Value:
        """Secondary couple on the input shaft's bearings, N m."""
        return self.drive.torque * self.first.input_couple

    @property
    def output_couple(self) -> Value:
        """Secondary couple on the driven shaft's bearings, N m."""
        return self.output_torque * self.second.output_couple

    @cached_property
    def intermediate_couples(self) -> tuple[Value, Value]:
        """Couples that bend the intermediate shaft, at its first and at its second joint, N m."""
        first = self.drive.torque / self.first.ratio * self.first.output_couple
        return first, self.intermediate_torque * self.second.input_couple

    @cached_property
    def equivalent_torque(self) -> Value:
        """Torque that would strain the intermediate shaft as torque and bending do, ``sqrt(T^2 + C^2)`` (Tresca), N m.

        At the end where it is larger; between its ends the couple is never larger than at one of them.  Behind a
        joint of ``beta`` alone it is ``T / cos(beta)`` at most, where nothing bends.
        """
        first, second = self.intermediate_couples
        at_first = np.hypot(self.drive.torque / self.first.ratio, first)
        return np.maximum(at_first, np.hypot(self.intermediate_torque, second))

    @cached_property
    def second_order(self) -> Value:
        """Second order of the driven shaft's `lead`, ``tan(beta_e / 2)^2`` of the equivalent angle, rad.

        The joints take the direction ``(cos, sin)`` of the input to that of the driven shaft by the matrix
        ``diag(cos beta_2, 1) R(90 deg + delta) diag(cos beta_1, 1)``, of which its condition ``k`` alone
        matters: the speed ratio runs from ``1/k`` to ``k``, as that of one joint with ``cos beta_e = 1/k``.

            ``k + 1/k = [(1 + c_1^2 c_2^2) sin(delta)^2 + (c_1^2 + c_2^2) cos(delta)^2] / (c_1 c_2)``
        """
        c1, c2 = self.first.cosine, self.second.cosine
        sine, cosine = np.sin(self.drive.phase), np.cos(self.drive.phase)
        # k + 1/k - 2 as a sum of squares loses no digits where the joints all but cancel
        excess = (((1 - c1 * c2) * sine) ** 2 + ((c1 - c2) * cosine) ** 2) / (c1 * c2)
        return np.tanh(np.arcsinh(np.sqrt(excess) / 2))

    @cached_property
    def equivalent_angle(self) -> Value:
        """``beta_e``: angle of the one joint that would turn the driven shaft as unevenly, rad.

        For small angles ``beta_e^4 = beta_1^4 + beta_2^4 - 2 beta_1^2 beta_2^2 cos(2 delta)``.
        """
        return 2 * np.arctan(np.sqrt(self.second_order))

    @property
    def torsional_excitation(self) -> Value:
        """Second order of the driven shaft's acceleration, rad/s^2; near handbooks' ``omega^2 beta_e^2``."""
        return 4 * self.drive.speed**2 * self.second_order

    @property
    def inertial_excitation(self) -> Value:
        """Second order of the intermediate shaft's acceleration, rad/s^2."""
        return 4 * self.drive.speed**2 * self.first.second_order


def peak(name: str, unit: str, attribute: str) -> Measure:
    """The largest size of a curve."""
    return Measure(name, unit, lambda a: np.max(abs(getattr(a, attribute)), axis=-1))


slowest = Measure("minimum output speed", "rpm", lambda a: a.output_speed.min(-1))
fastest = Measure("maximum output speed", "rpm", lambda a: a.output_speed.max(-1))
fluctuation = Measure("fluctuation of the speed", "%", lambda a: np.ptp(a.speed_ratio, axis=-1))
angle_error = Measure("angle error, peak to peak", "deg", lambda a: np.ptp(a.lead, axis=-1))
peak_acceleration = peak("peak acceleration of the output", "rad/s^2", "output_acceleration")
peak_torque = peak("peak torque of the output", "N m", "output_torque")
peak_input_couple = peak("peak couple on the input's bearings", "N m", "input_couple")
peak_output_couple = peak("peak couple on the output's bearings", "N m", "output_couple")

UNIVERSAL_JOINT_MEASURES = (
    slowest,
    fastest,
    fluctuation,
    angle_error,
    peak_acceleration,
    peak_torque,
    peak_input_couple,
    peak_output_couple,
)
"""Measures of one joint and of two."""

peak_intermediate_acceleration = peak(
    "peak acceleration of the intermediate shaft", "rad/s^2", "intermediate_acceleration"
)
peak_intermediate_torque = peak("peak torque of the intermediate shaft", "N m", "intermediate_torque")
peak_equivalent_torque = peak("peak equivalent torque of the intermediate shaft", "N m", "equivalent_torque")
equivalent_angle = peak("equivalent angle", "deg", "equivalent_angle")
torsional_excitation = peak("torsional excitation", "rad/s^2", "torsional_excitation")
inertial_excitation = peak("inertial excitation", "rad/s^2", "inertial_excitation")

DOUBLE_UNIVERSAL_JOINT_MEASURES = (
    *UNIVERSAL_JOINT_MEASURES,
    peak_intermediate_acceleration,
    peak_intermediate_torque,
    peak_equivalent_torque,
    equivalent_angle,
    torsional_excitation,
    inertial_excitation,
)
"""Measures of two joints.

Dana's Spicer torsional analysis calculator asks for a torsional excitation of at most 300 rad/s^2 and an inertial
one of at most 1000 rad/s^2 in road vehicles.
"""
UniversalJoint.measures = UNIVERSAL_JOINT_MEASURES
DoubleUniversalJoint.measures = DOUBLE_UNIVERSAL_JOINT_MEASURES
