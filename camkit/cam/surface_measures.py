"""Measures of the surfaces of a cam and its follower: film, wear, life of surfaces and bearing.

They are those of a `LubricatedPair` and of the `RollerBearing` in it.  Of a pair of cams each counts where it pushes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from operator import attrgetter
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import LeastMeasure, Measure
from ..quantities.types import Array, Value
from .follower_measures import peak_pressure
from .life import RollerBearing
from .lubricated_pair import LubricatedPair
from .measures import least_over_cam, over_cam, seen_at
from .surfaces import share_below

if TYPE_CHECKING:
    from .analysis import CamAnalysis


def _least(name: str, unit: str, f: Callable[[CamAnalysis], Value], struck: float = 0.0) -> LeastMeasure:
    """The least value of ``f`` where a cam pushes, of which a search sees every cam angle; ``struck`` less if it is."""

    def below(analysis: CamAnalysis) -> Value:
        return -f(analysis)

    def blow(analysis: CamAnalysis) -> Array:
        return np.where(analysis.struck, struck, 0.0)

    def whole(analysis: CamAnalysis) -> Value:
        return -analysis.highest(below).value - blow(analysis)

    def points(analysis: CamAnalysis) -> Value:
        return -analysis.seen(below) - blow(analysis)[..., None]

    return LeastMeasure(name, unit, whole, angle=seen_at, points=points)


def _log_life(analysis: CamAnalysis) -> Array:
    life: Array = analysis.cam.contact.strength.log_life(analysis.contact_pressure)
    return life


def _film(name: str, unit: str, f: Callable[[CamAnalysis], Value]) -> LeastMeasure:
    """The least of a film: 0 where the entrainment velocity changes sign while a cam pushes."""
    least = _least(name, unit, f)

    def whole(analysis: CamAnalysis) -> Value:
        reverses = analysis.highest(_drawn_in).value * analysis.highest(_drawn_back).value > 0
        return np.where(reverses, 0.0 * least(analysis), least(analysis))[()]

    return replace(least, function=whole)


def _drawn_in(analysis: CamAnalysis) -> Value:
    velocity: Array = analysis.surfaces.entrainment_velocity
    return velocity


def _drawn_back(analysis: CamAnalysis) -> Value:
    return -_drawn_in(analysis)


def _each(f: Callable[[CamAnalysis, Value], Value], of: Callable[..., Value]) -> Callable[[CamAnalysis], Value]:
    """The worse of the cams of an analysis: ``f`` of one, and where its follower is held by the other one."""

    def worse(analysis: CamAnalysis) -> Value:
        curves = [curve.resolved for curve in analysis.curves.values()]
        held = [(curve.contact_force < 0) & (len(curves) > 1) for curve in curves]
        return reduce(of, [f(*each) for each in zip(curves, held, strict=True)])

    return worse


def _thin(curve: CamAnalysis, held: Value) -> Value:
    return share_below(curve, but=held)


def _equivalent(curve: CamAnalysis, held: Value) -> Value:
    force = curve.contact_force * curve.loaded_flank
    load: Value = curve.surfaces.equivalent_load(np.where(held, 0.0, np.where(force >= 0, force, np.nan)))
    return load + 0.0 * curve.surfaces.roller_turns


def _hours(curve: CamAnalysis, held: Value) -> Value:
    hours: Value = curve.cam.contact.bearing.life(curve, _equivalent(curve, held)).hours
    return hours


def _roller_life(analysis: CamAnalysis) -> Value:
    return min_life(analysis) - np.log10(_each(lambda curve, held: curve.surfaces.roller_turns, np.maximum)(analysis))


min_entrainment = least_over_cam("minimum entrainment velocity", "m/s", attrgetter("surfaces.entrainment_velocity"))
"""Signed: where it is below 0, it is 0 on the way, and there is no film."""
min_film = _film("minimum film thickness", "um", attrgetter("surfaces.film"))
min_film_ratio = _film("minimum film over roughness", "", attrgetter("surfaces.film_ratio"))
thin_film = Measure("share of the motion with a film thinner than the roughness", "%", _each(_thin, np.maximum))
peak_rubbing = over_cam("peak of pressure times sliding", "MPa m/s", attrgetter("surfaces.rubbing_intensity"), "struck")
peak_load_stress = over_cam("peak load-stress factor", "MPa", attrgetter("surfaces.load_stress"), "struck")
pressure_share = over_cam(
    "peak contact pressure, of the allowable", "%", attrgetter("surfaces.pressure_share"), "struck"
)
min_life = _least("life of the cam's surface, lg of its turns", "", _log_life, struck=np.inf)
roller_life = Measure("life of the roller's surface, lg of the cam's turns", "", _roller_life)
bearing_load = Measure("load of the roller's bearing", "N", _each(_equivalent, np.maximum))
bearing_life = Measure("life of the roller's bearing, hours", "", _each(_hours, np.minimum))

LubricatedPair.measures = (
    peak_pressure,
    min_entrainment,
    min_film,
    min_film_ratio,
    thin_film,
    peak_rubbing,
    peak_load_stress,
    pressure_share,
    min_life,
)
RollerBearing.measures = roller_life, bearing_load, bearing_life
