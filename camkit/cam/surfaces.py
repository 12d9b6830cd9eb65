"""What the surfaces of a cam and its follower do to each other along the turn, and how long they live.

What a lubricant, a roughness or a strength belongs to is ``nan`` unless the cam's contact is a `LubricatedPair`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..quantities.applied import applied
from ..quantities.kinds import shown
from ..quantities.types import Array, Value
from .entrainment import Entrainment, at_speed
from .film import film_thickness
from .life import ROLLERS, SurfaceStrength, load_stress_factor
from .lubricated_pair import LubricatedPair
from .measures import number

if TYPE_CHECKING:
    from .analysis import CamAnalysis

LOWEST = 1e-6
"""A film ratio below this counts as it: its logarithm is to have an end."""


@dataclass(frozen=True)
class Surfaces:
    """Both surfaces of the cam of an ``analysis``, at its cam angles."""

    analysis: CamAnalysis

    @property
    def turning_speed(self) -> Value:
        """At which the cam turns, rad/s, also where its own speed is a share of a rated one."""
        return self.analysis.speed * getattr(self.analysis, "rated_speed", 1.0)

    @cached_property
    def entrainment(self) -> Entrainment:
        """Velocities of both surfaces past their contact, m/s."""
        return at_speed(self.turning_speed, self.analysis.surface_rates)

    @property
    def entrainment_velocity(self) -> np.ndarray:
        """``U``, m/s; where it is 0 there is no film."""
        return self.entrainment.velocity

    @cached_property
    def film(self) -> np.ndarray:
        """Least thickness of the film of lubricant, m (see `film_thickness`); ``nan`` without a `LubricatedPair`."""
        at, pair = self.analysis, self.analysis.cam.contact
        if not isinstance(pair, LubricatedPair):
            return np.nan * at.contact_force
        w = at.contact_force * at.loaded_flank / pair.width
        return film_thickness(pair.lubricant, self.entrainment_velocity, w, at.fit, pair.modulus)

    @property
    def film_ratio(self) -> np.ndarray:
        """``lambda``: film over roughness of both surfaces; below 1 they touch."""
        return self.film / self._said("roughness")

    @property
    def rubbing_intensity(self) -> np.ndarray:
        """``PV = pi/4 p_0 |u_1 - u_2|``: mean pressure times sliding, W/m^2."""
        return np.pi / 4 * self.analysis.contact_pressure * abs(self.entrainment.sliding)

    @property
    def load_stress(self) -> np.ndarray:
        """Load-stress factor ``K = pi p_0^2 / E*``, Pa."""
        return load_stress_factor(self.analysis.contact_pressure, self._said("modulus"))

    @property
    def pressure_share(self) -> np.ndarray:
        """Pressure over the allowable one."""
        return self.analysis.contact_pressure / self._said("allowable")

    def _said(self, name: str) -> Value:
        """What the contact says, if it does."""
        value: Value = getattr(self.analysis.cam.contact, name, np.nan)
        return value

    @cached_property
    def _passed(self) -> np.ndarray:
        """Length of the profile that passes at each of the cam angles of the resolution, m."""
        shown = self.analysis.resolved
        return abs(shown.surface_rates[0]) * shown.resolution.weights

    @cached_property
    def roller_turns(self) -> Value:
        """Turns of the roller in a turn of the cam: length of the profile over ``2 pi r``; ``nan`` without a roller."""
        rolls = hasattr(type(self.analysis), "roller_centre")
        r = number(self.analysis.cam.roller_radius) if rolls else np.nan
        with np.errstate(divide="ignore", invalid="ignore"):
            turns: Value = np.where(np.greater(r, 0), self._passed.sum(-1) / (2 * np.pi * r), np.nan)[()]
        return turns

    @cached_property
    def bearing_load(self) -> Value:
        """``P``: the constant load that wears a roller's bearing as much as the force between cam and roller, N.

        ``P^(10/3)`` is the mean of ``F^(10/3)`` over the turns of the roller; ``nan`` where the roller leaves the cam.
        """
        shown = self.analysis.resolved
        force = shown.contact_force * shown.loaded_flank
        return self.equivalent_load(np.where(force >= 0, force, np.nan))

    def equivalent_load(self, force: Array) -> Value:
        """`bearing_load` under another ``force`` at the cam angles of the resolution, N."""
        most = np.max(force, axis=-1, keepdims=True)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(most != 0, force / most, 0.0 * force) ** ROLLERS
            mean: Array = (share * self._passed).sum(-1) / self._passed.sum(-1)
        return most[..., 0] * mean ** (1 / ROLLERS)


class SurfaceLife(NamedTuple):
    """How many turns of the cam its surface and the roller's last before they pit."""

    cam: Value
    roller: Value
    """``nan`` under a flat face."""


def cam_life(analysis: CamAnalysis, strength: SurfaceStrength | None = None) -> SurfaceLife:
    """Where the pressure is largest, of surfaces of a ``strength``: that of the cam's contact, unless it is given.

    >>> from camkit import TranslatingRollerCam
    >>> life = cam_life(TranslatingRollerCam(groove=False, contact=LubricatedPair()).analyse())
    >>> print(f"{life.cam:.2e}, {life.roller:.2e} turns of the cam")
    4.29e+22, 8.38e+21 turns of the cam

    ``inf`` where nothing presses, ``nan`` where the cam is undercut or the follower leaves it.  ``ValueError`` where
    nothing is said of the strength.
    """
    with applied("the life of the cam", analysis):
        given = getattr(analysis.cam.contact, "strength", None) if strength is None else strength
        if not isinstance(given, SurfaceStrength):
            raise ValueError(f"the strength of the surfaces is {shown(given)}; it must be a SurfaceStrength")
        cam = given.life(analysis.highest(_pressure).value)
        return SurfaceLife(cam, cam / analysis.surfaces.roller_turns)


def _pressure(analysis: CamAnalysis) -> Array:
    return analysis.contact_pressure


def share_below(analysis: CamAnalysis, least: float = 1.0, but: Value = False) -> Value:
    """Share of the motion's cam angle over which the film is thinner than ``least`` times the roughness.

    ``nan`` where there is no contact somewhere; ``but`` says at which cam angles of the resolution that is no matter.
    """
    shown = analysis.resolved
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(but, np.inf, shown.surfaces.film_ratio) / least
        over = np.minimum(np.log(np.maximum(ratio, LOWEST)), -np.log(LOWEST))
        one, other = over[..., :-1], over[..., 1:]
        size = abs(one) + abs(other)
        part = np.where(one * other < 0, -np.minimum(one, other) / size, np.where(one + other < 0, 1.0, 0.0 * size))
    step = np.diff(shown.cam_angle, axis=-1)
    return (part * step).sum(-1) / step.sum(-1)
