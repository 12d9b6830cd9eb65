"""Views of both surfaces of a cam and its follower over the cam angle: how they run past each other, and their film."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple, Protocol

import numpy as np

from ..quantities.types import Array
from ..units import deg
from .cam import ANGLE
from .picture import Axes, Colour, Line, Mark, Picture, Points, gaps


class Velocities(Protocol):
    """Of both surfaces past their contact."""

    @property
    def velocity(self) -> Array: ...
    @property
    def sliding(self) -> Array: ...


class Surfaces(Protocol):
    """Both surfaces over the turn."""

    @property
    def entrainment(self) -> Velocities: ...
    @property
    def film_ratio(self) -> Array: ...


class Touching(Protocol):
    """A cam curve with its follower over the turn."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def contact_force(self) -> Array: ...
    @property
    def surfaces(self) -> Surfaces: ...


class Touched(Protocol):
    """The analysis of a cam: its curves by name."""

    @property
    def curves(self) -> Mapping[str, Touching]: ...


class _Stretch(NamedTuple):
    """A curve of a cam that is shown: its key, its legend, where it is, and where it touches its follower."""

    key: str
    label: str
    curve: Touching
    x: Array
    touches: Array
    style: Colour


def _stretches(analysis: Touched) -> Iterator[_Stretch]:
    """Every curve; of a cam that opens something that event, while it is open; of a pair each where it pushes."""
    curves = {"cam": analysis.event} if hasattr(analysis, "event") else analysis.curves
    several = len(curves) > 1
    for i, (key, curve) in enumerate(curves.items()):
        x = curve.cam_angle / deg
        touches = getattr(curve, "is_open", True) & (np.logical_not(several) | (curve.contact_force >= 0))
        yield _Stretch(key, several * key, curve, x, touches, {"role": "series", "index": i})


def entrainment(analysis: Touched) -> Picture:
    """What draws a lubricant in (full), and how fast the cam's surface slides past the follower (thin).

    Marked is where the entrainment velocity changes sign: there is no film.
    """
    marks: list[Mark] = []
    for key, label, curve, x, touches, style in _stretches(analysis):
        U, sliding = curve.surfaces.entrainment.velocity, curve.surfaces.entrainment.sliding
        rubs = gaps(sliding, touches)
        marks.append(Line(f"{key} sliding", x, rubs, label="sliding", stroke="thin dashed", **style))
        marks.append(Line(key, x, gaps(U, touches), label=label or "entrainment", **style))
        place = _crossings(x, gaps(U, touches))
        marks.append(Points(f"{key} none", place, 0 * place, role="trouble", label="" if marks[2:] else "no film"))
    axes = Axes(title="Entrainment", xlabel=ANGLE, ylabel="U  [m/s]")
    return Picture.of(axes, marks)


def _crossings(x: Array, y: Array) -> Array:
    """Where a curve changes sign between two of its points; ``nan`` between all others."""
    before, after = y[..., :-1], y[..., 1:]
    crosses = (before * after < 0) | ((before == 0) & (after != 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(crosses, x[:-1] - before * np.diff(x) / (after - before), np.nan)


def film_ratio(analysis: Touched) -> Picture:
    """Film over the roughness of both surfaces; trouble: below 1 they touch; undercut, or the follower pulled."""
    marks: list[Mark] = []
    ends = np.array([0, -1])
    for key, label, curve, x, touches, style in _stretches(analysis):
        y = gaps(curve.surfaces.film_ratio, touches)
        there = np.isfinite(y)
        if not marks:
            marks.append(Line("limit", x[ends], 1.0 + 0 * x[ends], role="limit", label="roughness"))
        marks.append(Line(key, x, gaps(y, there), label=label, **style))
        marks.append(Line(f"{key} thin", x, gaps(y, y < 1), role="trouble"))
        marks.append(Line(f"{key} none", x, gaps(0 * x, touches & np.isnan(curve.surfaces.film_ratio)), role="trouble"))
    axes = Axes(title="Film over roughness", xlabel=ANGLE, ylabel="λ = h / Rq")
    return Picture.of(axes, marks)
