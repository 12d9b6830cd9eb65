"""The plane of two free quantities: what is allowed, what it costs, where the best design is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import Analysable, label
from ..quantities.kinds import numbers, refuse_arguments, refuse_kinds, shown
from ..quantities.types import Array, Value
from ..study.design_map import DesignMap
from ..study.study import KEPT
from ..units import factor
from .picture import Axes, Contour, Line, LineStyle, Mark, Picture, Points, Polygon, Region, Text, View

SHADES = 8
"""How many shades show the objective; each covers about the same area, whatever the objective is."""
LINES = 12
"""At most so many contours of the objective."""


def units_of(plane: DesignMap) -> np.ndarray:
    """The units of both quantities, ``(2, 1)``."""
    return np.array([q.factor for q in plane.declared])[:, None]


def _axes(plane: DesignMap, title: str, xlim: tuple[Value, Value], ylim: tuple[Value, Value]) -> Axes:
    """The axes are named after the quantities, with their symbols and units."""
    x, y = (
        label(name, q) + ("" if name == q.symbol else f"  {q.symbol}") + (f"  [{q.unit}]" if q.unit else "")
        for name, q in zip(plane.study.free, plane.declared, strict=True)
    )
    return Axes(title=title, xlabel=x, ylabel=y, grid=False, xlim=xlim, ylim=ylim)


def design_plane(plane: DesignMap, names: Sequence[str] | None = None) -> Picture:
    """A `DesignMap`: the objective's contours, a curve for each limit, the feasible region, bounds, the best design.

    ``names`` says what the limits' curves are called (default: their measures' names).
    """
    refuse_arguments(design_plane, locals())
    units = units_of(plane)
    x, y = plane.axes / units
    measure = plane.study.minimise[0]
    z = plane.objective / factor(measure.unit)
    levels = _round_levels(z)
    values = tuple(f"{level:.5g}" for level in levels)
    best = plane.best[:, None] / units
    allowed = Region("allowed", x, y, np.minimum(plane.worst, 1.0), -np.inf, 0.0, role="allowed", opacity=0.33)
    return Picture.of(
        _axes(plane, "What is allowed, and what it costs", (x[0], x[-1]), (y[0], y[-1])),
        allowed,
        _bounds(plane, x, y),
        Contour("objective", x, y, z, levels, names=values, role="guide", stroke="thin", label=measure.label),
        _limits(plane, x, y, names or [m.name for m in plane.measures]),
        Points("best", *best, mark="star", size=19, fill="paper", label="optimum, searched"),
        _nothing(plane),
    )


def _round_levels(z: np.ndarray) -> np.ndarray:
    """Round numbers among the values ``z``, at most `LINES`."""
    z = z[np.isfinite(z)]
    least = np.subtract(*np.quantile(z, [1, 0])) / LINES if len(z) else 0.0
    if not least > 0:
        return z[:0]
    decade = 10.0 ** np.floor(np.log10(least))
    step = next(k for k in (1, 2, 2.5, 5, 10) if k * decade >= least) * decade
    return np.arange(np.ceil(z.min() / step), np.floor(z.max() / step) + 1) * step


def _bounds(plane: DesignMap, x: Array, y: Array) -> list[Mark]:
    """The bounds, and a veil over what lies beyond them."""
    (x0, y0), (x1, y1) = plane.study.bounds / units_of(plane).T
    corners = [x0, x0, x1, x1, x0], [y0, y1, y1, y0, y0]
    across = [x[0], x[-1], x[-1], x[0], x[0], np.nan, *np.clip(corners[0], x[0], x[-1])]
    upright = [y[0], y[0], y[-1], y[-1], y[0], np.nan, *np.clip(corners[1], y[0], y[-1])]
    return [
        Polygon("beyond", across, upright, role="paper", opacity=0.6),
        Line("bounds", *corners, stroke="thin dashed", label="bounds"),
    ]


def _limits(plane: DesignMap, x: Array, y: Array, names: Sequence[str]) -> list[Mark]:
    """A curve for each limit with its name; one that has no curve here, being kept all over, is in the legend."""
    marks: list[Mark] = []
    for i, (name, limit) in enumerate(zip(names, plane.limits, strict=True)):
        label = f"{name}: kept" if np.nanmax(limit) <= KEPT else ""
        style: LineStyle = {"role": "series", "index": i, "stroke": "line", "label": label}
        marks.append(Contour(f"limit {i}", x, y, np.minimum(limit, 1.0), [0.0], names=(name,), **style))
    return marks


def _nothing(plane: DesignMap) -> Text:
    """A sentence in the bounds where no design there keeps every limit."""
    x, y = plane.study.bounds.mean(axis=0) / units_of(plane)[:, 0]
    told = "" if np.isfinite(plane.best).all() else "nothing within the bounds\nkeeps every limit"
    return Text("nothing", x, y, told, role="trouble", size=12, boxed=True)


def designs_on_plane(designs: Mapping[str, Analysable], limits: Sequence[str] | None = None) -> View:
    """A view of a `DesignMap` with some designs on it by name; ``limits`` are what its limits' curves are called."""
    refuse_arguments(designs_on_plane, locals())

    def view(plane: DesignMap) -> Picture:
        drawn = design_plane(plane, limits)
        places = {name: plane.study.x_of(design) / units_of(plane)[:, 0] for name, design in designs.items()}
        return Picture.of(
            drawn.axes,
            drawn.marks,
            [Text(f"{n} name", x, y, f"     {n}", anchor="left", boxed=True) for n, (x, y) in places.items()],
            [Points(n, x, y, role="series", index=i, size=12) for i, (n, (x, y)) in enumerate(places.items())],
        )

    return view


@dataclass(frozen=True)
class ShownPlane:
    """A `DesignMap` with what is marked on it: free values of the design in the sliders and of the optimum, SI."""

    plane: DesignMap
    here: ArrayLike | None = None
    best: ArrayLike | None = None

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for name, at in (("design in the sliders", self.here), ("optimum", self.best)):
            if at is not None and numbers(at, f"the {name}").shape != (2,):
                raise ValueError(f"the {name} is {shown(at)}; it must be two numbers, or None")


def objective_plane(shown: ShownPlane) -> Picture:
    """The objective over two quantities, the darker the better; faded where a limit is missed; the optimum."""
    plane = shown.plane
    x, y = plane.axes / units_of(plane)
    measure = plane.study.minimise[0]
    limits = [f"{m.name} {'at most' if sense > 0 else 'at least'} {m.text(v)}" for m, v, sense in plane.study.limits]
    worst, label = np.clip(plane.worst, -1, 1), limits[0] if len(limits) == 1 else "a limit" if limits else ""
    return Picture.of(
        _axes(plane, measure.label[:1].upper() + measure.label[1:], _ends(x), _ends(y)),
        _shades(x, y, plane.objective / factor(measure.unit), measure.sign),
        Region("missed", x, y, worst, 0, np.inf, role="paper", opacity=0.72),
        Contour("limit", x, y, worst, [0.0], role="limit", stroke="line", label=label),
        _mark("in the sliders", shown.here, plane, size=13),
        _mark("optimum", shown.best, plane, mark="star", size=20, role="limit"),
    )


def _ends(values: np.ndarray) -> tuple[Array, Array]:
    """First and last value, and room for a mark on the edge."""
    room = 0.025 * np.ptp(values)
    return values[0] - room, values[-1] + room


def _shades(x: Array, y: Array, z: np.ndarray, sign: int) -> list[Mark]:
    """Shades between levels that part the plane into equal areas, every second level with its value as it is read."""
    levels = np.nanquantile(z, np.arange(1, SHADES) / SHADES)
    ends = [-np.inf, *levels, np.inf]
    shades = [
        Region(f"shade {i}", x, y, z, ends[i], ends[i + 1], role="position", opacity=0.7 - 0.62 * i / (SHADES - 1))
        for i in range(SHADES)
    ]
    values = tuple(f"{sign * level:.4g}" if i % 2 == 0 else "" for i, level in enumerate(levels))
    return [*shades, Contour("levels", x, y, z, levels, names=values, role="paper", stroke="thin")]


def _mark(
    name: str, at: ArrayLike | None, plane: DesignMap, size: float, mark: str = "dot", role: str = "ink"
) -> Points:
    x, y = np.full((2, 1), np.nan) if at is None else np.reshape(at, (2, 1)) / units_of(plane)
    label = "" if at is None else name
    return Points(name, x, y, role=role, mark=mark, size=size, fill="paper", label=label)
