"""Constant velocity, led in and out by a blend.

Source: Norton, Cam Design and Manufacturing Handbook (unacceptable cam curves, and constant velocity); VDI 2143 part 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy import cos, inf, pi, sin

from ...quantities import choice, quantity
from ...quantities.kinds import a_number, shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, mirrored

SHAPES = ("cycloidal", "parabolic")


@dataclass(frozen=True)
class ConstantVelocity(Law):
    """The velocity ``V = 1 / (1 - b)`` between two blends of duration ``b`` = ``blend``.

    On the first half, and on the second by ``s(u) = 1 - s(1 - u)``::

        u <= b   cycloidal blend   s = V/2 [u - b/pi sin(pi u/b)]
                 parabolic blend   s = V u^2 / (2 b)
        u >= b                     s = V (u - b/2)

    ``blend`` lies in (0, 1/2] (an array ``(p, 1)`` for a population: ``nan`` outside); ``ValueError`` else.
    With ``blend = 1/2`` nothing straight is left: the cycloidal or the parabolic law itself.

    >>> ConstantVelocity(0.2)(0.5).v
    np.float64(1.25)
    >>> ConstantVelocity(0.7)
    Traceback (most recent call last):
        ...
    ValueError: the blend of the constant velocity law is 0.7; it must be above 0 and at most 0.5
    """

    blend: Value = quantity("b", 0.25, 0.01, 0.5, "", "share of the time spent in each blend")
    shape: str = choice("", "cycloidal", {shape: shape for shape in SHAPES}, "what the blends are")

    name = "constant velocity with blends"

    def __post_init__(self) -> None:
        what, must = "the blend of the constant velocity law", "be above 0 and at most 0.5"
        object.__setattr__(self, "blend", a_number(self.blend, what, must, lambda b: (b > 0) & (b <= 0.5)))
        if not isinstance(self.shape, str) or self.shape not in SHAPES:
            raise ValueError(f"the blend has the shape {shown(self.shape)}; it can be {' or '.join(SHAPES)}")

    @property
    def continuity(self) -> int:
        return 2 if self.shape == "cycloidal" else 1

    @property
    def kinks_move(self) -> bool:
        return True

    @property
    def kinks(self) -> tuple[Value, ...]:
        return (self.blend, 1 - self.blend)

    def at(self, u: Array) -> Kinematics:
        return mirrored(u, self._first_half)

    def _first_half(self, u: Array) -> Kinematics:
        b = self.blend
        V = 1 / (1 - b)
        straight = (V * (u - b / 2), V + 0 * u, 0 * u * b, 0 * u * b)
        blended = _cycloidal(u, b, V) if self.shape == "cycloidal" else _parabolic(u, b, V)
        return Kinematics(*(np.where(u <= b, x, y) for x, y in zip(blended, straight, strict=True)))

    def peaks(self) -> Peaks:
        b = self.blend
        V = 1 / (1 - b)
        if self.shape == "parabolic":
            return Peaks(V, V / b, inf + 0 * b)
        return Peaks(V, pi * V / (2 * b), pi**2 * V / (2 * b**2))


def _cycloidal(u: Array, b: Value, V: Value) -> tuple[Array, Array, Array, Array]:
    k = pi / b
    return V / 2 * (u - sin(k * u) / k), V / 2 * (1 - cos(k * u)), V / 2 * k * sin(k * u), V / 2 * k**2 * cos(k * u)


def _parabolic(u: Array, b: Value, V: Value) -> tuple[Array, Array, Array, Array]:
    return V * u**2 / (2 * b), V * u / b, V / b + 0 * u, 0 * u * b
