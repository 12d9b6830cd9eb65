"""Views of a design whose sizes can be seen as a whole: their plane, how limits are used, a section to scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from ..geometry import circle
from ..quantities.types import Array, Value
from ..study.design_map import DesignMap
from ..units import mm, percent
from .design_map import design_plane, units_of
from .picture import Axes, Band, Line, Mark, Picture, Points, Polygon, Text, gaps

MOST = 125.0
"""A bar ends here, percent of its limit."""


class Plane(Protocol):
    """A plane of two sizes: its map, what is for sale, and the optimum in closed form, ``(2,)``."""

    @property
    def plane(self) -> DesignMap: ...
    @property
    def limit_names(self) -> Sequence[str]: ...
    @property
    def catalogue(self) -> Mapping[str, Array]: ...
    @property
    def closed_form(self) -> Array: ...


class Sized(Protocol):
    """A design of two sizes, ``here`` ``(2,)``, and how far it uses up each limit."""

    @property
    def sizes(self) -> Plane: ...
    @property
    def here(self) -> Array: ...
    @property
    def utilisation(self) -> Mapping[str, Value]: ...
    @property
    def rings(self) -> Mapping[str, Array]: ...


def plane_of_sizes(analysis: Sized) -> Picture:
    """The plane of two sizes: limits, a catalogue, the optimum, and this design; trouble: it misses a limit."""
    found = analysis.sizes
    units = units_of(found.plane)
    plane = design_plane(found.plane, found.limit_names)
    region, veil, *lines = plane.marks
    here, kept = analysis.here[:, None] / units, np.max(list(analysis.utilisation.values())) <= 1
    return Picture.of(
        plane.axes,
        [region, veil],
        [
            Points(name, *(both.T / units), role="series", index=1 + 2 * i, mark="square", size=4.5, label=name)
            for i, (name, both) in enumerate(found.catalogue.items())
        ],
        lines,
        Points("closed form", *(found.closed_form[:, None] / units), mark="plus", size=15, label="in closed form"),
        Points("here", *gaps(here, kept), size=11, label="this design"),
        Points("here, missing", *gaps(here, ~kept), size=11, role="trouble"),
    )


def utilisation(analysis: Sized) -> Picture:
    """What each limit is used up by, as bars; the limit is at 100 %."""
    used = analysis.utilisation
    marks: list[Mark] = [Band("limit", 100, 100, role="limit", along="y")]
    for i, (name, use) in enumerate(used.items()):
        ends, y = np.stack([0 * use, np.minimum(use / percent, MOST)]), [-i, -i]
        marks.append(Line(name, gaps(ends, use <= 1), y, role="position", stroke="bar"))
        marks.append(Line(f"{name}, missed", gaps(ends, use > 1), y, role="trouble", stroke="bar"))
        marks.append(Text(f"{name} value", 161, -i, f"{use / percent:.1f} %", anchor="right", size=11))
    axes = Axes(
        title="Limits used up",
        xlabel="utilisation  [%]",
        xlim=(0, 162),
        ylim=(0.6 - len(used), 0.6),
        yticks={-i: name for i, name in enumerate(used)},
    )
    return Picture.of(axes, marks)


def section(analysis: Sized) -> Picture:
    """The section to scale, a ring, with what it is compared with dashed; ``nan``: there is no such ring."""
    (_, own), *others = analysis.rings.items()
    outer, inner = (circle((0, 0), diameter / mm / 2) for diameter in own)
    window = np.maximum(82.0, 0.58 * own[0] / mm) * np.array([-1, 1])
    D, d = own / mm
    return Picture.of(
        Axes(title="Section, to scale", xlabel="[mm]", ylabel="[mm]", equal=True, xlim=window, ylim=window),
        Polygon("wall", *np.hstack([outer, inner[:, ::-1]]), role="flank", opacity=0.55),
        Line("outside", *outer, role="position"),
        Line("inside", *inner, role="position"),
        [_ring(i, name, ring / mm) for i, (name, ring) in enumerate(others)],
        Text("sizes", 0, 0, f"D = {D:.5g} mm\nd = {d:.5g} mm\nwall {(D - d) / 2:.4g} mm", size=11),
    )


def _ring(number: int, name: str, ring: Array) -> Line:
    """The outlines of a ring, its size told in the legend."""
    both = np.hstack([circle((0, 0), ring[0] / 2), [[np.nan], [np.nan]], circle((0, 0), ring[1] / 2)])
    told = f"{ring[0]:.5g} × {(ring[0] - ring[1]) / 2:.4g} mm".replace("nan × nan mm", "none")
    return Line(name, *both, role="series", index=1 + 2 * number, stroke="dashed", label=f"{name}: {told}")
