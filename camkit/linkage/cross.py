"""The cross of a universal joint: how it turns its output shaft, and what it does to both shafts.

Formulas as in every textbook of machine kinematics; signs and phases are checked against vector geometry.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..quantities.types import Value


@dataclass(frozen=True)
class Cross:
    """Where the cross of one joint takes its output: geometry alone.

    ``angle`` is ``beta``, ``input_angle`` is ``phi``, both rad.  ``nan`` where ``beta`` is not in 0 .. 90 deg.
    """

    angle: Value
    input_angle: Value

    @cached_property
    def bend(self) -> Value:
        """``beta`` where a joint can turn, rad."""
        return np.where((self.angle >= 0) & (self.angle < np.pi / 2), self.angle, np.nan)[()]

    @cached_property
    def cosine(self) -> Value:
        """``cos(beta)``."""
        return np.cos(self.bend)

    @cached_property
    def lead(self) -> Value:
        """``psi - phi``: how far the output is ahead of the input, rad.

        It is the series ``sum tan(beta/2)^(2k) sin(2 k phi) / k`` over ``k = 1, 2, ...``.
        """
        sine, cosine = np.sin(self.input_angle), np.cos(self.input_angle)
        return np.arctan2((1 - self.cosine) * sine * cosine, self.cosine * cosine**2 + sine**2)

    @property
    def second_order(self) -> Value:
        """Amplitude of ``sin(2 phi)`` in the lead, ``tan(beta/2)^2``, rad."""
        return np.tan(self.bend / 2) ** 2

    @cached_property
    def output_angle(self) -> Value:
        """``psi``, rad; it goes on beyond a full turn."""
        return self.input_angle + self.lead

    @cached_property
    def _distance(self) -> Value:
        return 1 - np.sin(self.bend) ** 2 * np.cos(self.input_angle) ** 2

    @cached_property
    def ratio(self) -> Value:
        """Output speed over input speed, ``dpsi/dphi = cos(beta) / (1 - sin(beta)^2 cos(phi)^2)``."""
        return self.cosine / self._distance

    @cached_property
    def ratio_slope(self) -> Value:
        """``d2psi/dphi2 = -cos(beta) sin(beta)^2 sin(2 phi) / (1 - sin(beta)^2 cos(phi)^2)^2``, 1/rad."""
        return -self.cosine * np.sin(self.bend) ** 2 * np.sin(2 * self.input_angle) / self._distance**2

    @cached_property
    def input_couple(self) -> Value:
        """Couple that bends the input shaft, per torque in it: ``tan(beta) sin(phi)``.

        Its axis turns with the shaft, square to the pins of the input's fork.
        """
        return np.tan(self.bend) * np.sin(self.input_angle)

    @cached_property
    def output_couple(self) -> Value:
        """Couple that bends the output shaft, per torque in it: ``tan(beta) cos(psi)``.

        Its axis turns with the shaft, square to the pins of the output's fork.
        """
        return np.tan(self.bend) * np.cos(self.output_angle)
