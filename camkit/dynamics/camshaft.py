"""An elastic camshaft: the train's torque winds it up, so that the cam leads and lags the even turn of its drive.

Behind a shaft ``k_t, c_t`` that is driven evenly the cam stands at ``phi = omega t + theta``,

    J_c theta'' + c_t theta' + k_t theta = -M,   M = N s'(phi)

A fixed point is sought: the motion at ``phi`` gives ``N`` and ``M`` by Fourier series over the turn, and these
``theta``.

Source: Koster, Vibrations of Cam Mechanisms (windup of the camshaft).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..motion.closing import TURN
from ..quantities import Design, quantity
from ..quantities.design import refuse_population
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..units import in_unit
from .driven import Analysed, bottom, top
from .steady import Response, response_of
from .trains import Train

SETTLED, ROUNDS, SWELLS = 1e-12, 500, 1.0
"""Rad by which ``theta`` still changes in the end; rounds at most; rad beyond which it is lost."""


@dataclass(frozen=True)
class Windup:
    """Steady motion of a train and its cam on an elastic shaft, at even angles ``(n,)`` of the drive."""

    response: Response = field(repr=False)
    """Of the train, at the angles of the drive."""
    angle: Array = field(repr=False)
    """``theta``: by how much the cam leads its drive, rad."""
    speed: Array = field(repr=False)
    """Of the cam, rad/s."""
    cam_torque: Array = field(repr=False)
    """``M = N s'(phi)``, N m."""
    rounds: int
    """After which it has settled."""

    @property
    def drive_angle(self) -> Array:
        """``omega t``, rad."""
        return self.response.cam_angle

    @property
    def range(self) -> tuple[float, float]:
        """The least and the largest angle, rad."""
        return float(bottom(self.angle)), float(top(self.angle))


@dataclass(frozen=True)
class Camshaft(Design):
    """The shaft between an even drive and the cam, and the inertia on it.

    >>> from camkit import TranslatingFlatCam, deg, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> windup = Camshaft().windup(TranslatingFlatCam().analyse(), ElasticTrain())
    >>> print(f"{windup.range[0] / deg:.4f} to {windup.range[1] / deg:.4f} deg")
    -0.0564 to 0.0564 deg

    Raises ``ValueError`` for a stiffness or an inertia that is not above 0, and damping below 0.
    """

    stiffness: float = quantity("k_t", 2000, 50, 50000, "N m/rad", "of the shaft", name="shaft stiffness")
    inertia: float = quantity("J_c", 0.002, 1e-5, 0.1, "kg m^2", "of cam and shaft", name="camshaft inertia")
    damping: float = quantity("c_t", 0.2, 0, 10, "N m s/rad", "of the shaft", at_least=0, name="shaft damping")

    def windup(self, analysis: Any, train: Train, speed: float | None = None, samples: int | None = None) -> Windup:
        """Steady motion of a train behind a cam on this shaft, which is driven evenly at ``speed`` (rad/s).

        Raises ``ValueError`` for a population, a mass at the cam, and a shaft so soft that nothing settles, and as
        `Train.follow` does.
        """
        refuse_arguments(Camshaft.windup, locals())
        for thing, what in ((analysis, "the analysis"), (train, "the train"), (self, "the camshaft")):
            refuse_population(thing, what)
        if np.any(train.cam_side_mass):
            raise ValueError("the train has a mass at the cam; behind an elastic camshaft it must be 0")
        first = train.follow(analysis, speed, samples)
        turns = float(first.speed[0])
        found = first
        theta = rate = 0.0 * first.cam_angle
        for rounds in range(1, ROUNDS + 1):
            torque = found.resistance * found.driven.velocity
            before, (theta, rate) = theta, self._twist(torque, turns)
            change = abs(theta - before).max()
            if not change < SWELLS:
                break
            found = _turned(first, analysis, theta)
            if change < SETTLED:
                return Windup(found, theta, turns + rate, found.resistance * found.driven.velocity, rounds)
        raise ValueError(
            f"the windup of the camshaft does not settle at {in_unit(turns, 'rpm'):.6g} rpm; a shaft of "
            f"{float(self.stiffness):.6g} N m/rad is too soft for this torque, or at resonance"
        )

    def _twist(self, torque: Array, speed: float) -> tuple[Array, Array]:
        """``theta`` under a torque over the turn, and its derivative by time."""
        n, half = len(torque), len(torque) // 2
        wave = np.arange(half + 1) * speed
        rubs = 1j * wave * (np.arange(half + 1) < half)
        with np.errstate(divide="ignore", invalid="ignore"):
            theta = -np.fft.rfft(torque) / (self.stiffness - self.inertia * wave**2 + self.damping * rubs)
        return np.fft.irfft(theta, n), np.fft.irfft(rubs * theta, n)


def _turned(first: Response, analysis: Analysed, theta: Array) -> Response:
    """The response to a cam that leads its drive by ``theta``."""
    at = first.driven.at(analysis, np.mod(first.cam_angle + theta, TURN))
    return response_of(first.train, replace(at, cam_angle=first.cam_angle), first.speed)
