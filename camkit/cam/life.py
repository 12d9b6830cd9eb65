"""How long surfaces and the roller's bearing live.

A surface bears the pressure ``S`` for ``N_ref`` loadings, and another pressure ``N = N_ref (S / p_0)^e`` times.  That
is the same as ``lg K = (B - lg N) / A`` with ``A = e / 2`` and Buckingham's load-stress factor
``K = F kappa / b = pi p_0^2 / E*``.  Each point of the cam is loaded once a turn, the roller's as often as it turns.
Sliding shortens the life: choose ``S`` and ``e`` for it.

Source: Norton, Cam Design and Manufacturing Handbook (surface fatigue; data of Talbourdet and Cram); ISO 281.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np

from ..data.surface_strengths import SURFACES
from ..quantities import Design, choice, quantity
from ..quantities.applied import applied
from ..quantities.kinds import numbers, refuse_shapes
from ..quantities.types import Array, Value
from .measures import number

if TYPE_CHECKING:
    from .analysis import CamAnalysis

OWN = "own numbers"
ROLLERS = 10 / 3
"""Exponent of the life of roller bearings, ISO 281."""


@dataclass(frozen=True)
class SurfaceStrength(Design):
    """The pressure that a surface bears: one of `SURFACES` by its name, or its numbers.

    >>> hard = SurfaceStrength(surface="induction-hardened steel")
    >>> print(f"{hard.life(1e9):.3e} loadings at 1000 MPa, {hard.allowable(1e9) / 1e6:.0f} MPa for 1e9 of them")
    9.439e+11 loadings at 1000 MPa, 1453 MPa for 1e9 of them

    Raises ``ValueError`` for numbers that are not above 0.
    """

    pressure: float = quantity("S", 1500, 300, 3000, "MPa", "largest pressure that the surface bears so many times")
    cycles: float = quantity("N_ref", 1e8, 1e6, 1e9, "", "loadings that it bears with that pressure", at_most=1e15)
    exponent: float = quantity("e", 18, 5, 30, "", "by which the life falls with the pressure")
    surface: str = choice("S_n", OWN, {OWN: OWN, **{name: name for name in SURFACES}}, "kind of surface")

    def following(self) -> dict[str, str]:
        """What a surface of the menu gives."""
        given = ("pressure", "cycles", "exponent") if self.surface != OWN else ()
        return {name: "it is that of the surface" for name in given}

    @property
    def line(self) -> tuple[Value, Value, Value]:
        """``S`` (Pa), ``N_ref`` and ``e``."""
        return SURFACES.get(self.surface) or (self.pressure, self.cycles, self.exponent)

    def life(self, pressure: Value) -> Array:
        """Loadings with a Hertz ``pressure`` (Pa) before the surface pits; ``inf`` for none."""
        with np.errstate(over="ignore"):
            return 10 ** self.log_life(pressure)

    def log_life(self, pressure: Value) -> Array:
        """``lg N``: what a search can compare, however long the life is."""
        S, cycles, e = self.line
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.log10(cycles) + e * (np.log10(S) - np.log10(numbers(pressure, "the pressures")))

    def allowable(self, cycles: Value) -> Array:
        """Pressure that the surface bears so many times, Pa."""
        S, known, e = self.line
        with np.errstate(divide="ignore", invalid="ignore"):
            return S * (known / numbers(cycles, "the loadings")) ** (1 / e)


def load_stress_factor(pressure: Value, modulus: Value) -> Array:
    """Buckingham's ``K = F kappa / b = pi p_0^2 / E*`` of a Hertz pressure, Pa.

    >>> from camkit.units import psi
    >>> print(f"{load_stress_factor(271e3 * psi, 16.7e6 * psi) / psi:.0f} psi")
    13816 psi
    """
    p0, E = numbers(pressure, "the pressures"), numbers(modulus, "the moduli")
    refuse_shapes({"pressures": p0, "moduli": E})
    with np.errstate(over="ignore", invalid="ignore"):
        return np.pi * p0**2 / np.where(E > 0, E, np.nan)[()]


class BearingLife(NamedTuple):
    """How long nine of ten bearings live at least: in their own turns, turns of the cam, and hours."""

    load: Value
    """``P``: the constant load that would wear the bearing as much, N."""
    turns: Value
    """``L10``, turns of the roller."""
    cam_turns: Value
    hours: Value


@dataclass(frozen=True)
class NoBearing(Design):
    """Nothing is said of a roller's bearing."""

    name: ClassVar[str] = "not given"


@dataclass(frozen=True)
class RollerBearing(Design):
    """The needle or roller bearing in which a roller turns, by its basic dynamic load rating.

    >>> from camkit import TranslatingRollerCam
    >>> life = RollerBearing().life(TranslatingRollerCam(groove=False).analyse())
    >>> print(f"{life.load:.1f} N, {life.cam_turns:.2e} turns of the cam, {life.hours:.3g} h")
    120.5 N, 3.62e+11 turns of the cam, 2.01e+07 h

    Raises ``ValueError`` for a rating that is not above 0.
    """

    rating: float = quantity("C", 9.15, 1, 100, "kN", "basic dynamic load rating", name="load rating of the bearing")

    name: ClassVar[str] = "roller bearing"

    def life(self, analysis: CamAnalysis, load: Value | None = None) -> BearingLife:
        """By the force between cam and roller (see `Surfaces.bearing_load`), or under another ``load``, N.

        ``L10 = 1e6 (C / P)^(10/3)``; ``nan`` where the roller leaves the cam, and under a flat face.
        """
        with applied("the life of the bearing", analysis), np.errstate(all="ignore"):
            borne = analysis.surfaces.bearing_load if load is None else numbers(load, "the load of the bearing")[()]
            own = 1e6 * (number(self.rating) / borne) ** ROLLERS
            cam = own / analysis.surfaces.roller_turns
            hour = 3600 * np.abs(number(analysis.surfaces.turning_speed)) / (2 * np.pi)  # in turns
            return BearingLife(borne, own, cam, cam / hour)
