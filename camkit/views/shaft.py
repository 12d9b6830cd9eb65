"""Views of the shaft with two universal joints: limits used up, the tube's section, how a search's candidates moved."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..geometry import circle
from ..quantities import Measure, Quantity, declarations, words
from ..quantities.kinds import refuse_arguments
from ..units import factor, mm, percent
from .picture import Axes, Band, Circle, Line, Mark, Picture, Polygon, Text, View, picture

MOST = 125.0
"""A bar ends here, percent of its limit."""


def utilisation(analysis: Any) -> Picture:
    """What each limit is used up by, as bars; the limit is at 100 %."""
    used = analysis.utilisation
    marks: list[Mark] = [Band("limit", 100, 100, role="limit", along="y")]
    for i, (name, use) in enumerate(used.items()):
        role = "trouble" if use > 1 else "position"
        marks.append(Line(name, [0, min(use / percent, MOST)], [-i, -i], role=role, stroke="bar"))
        marks.append(Text(f"{name} value", 161, -i, f"{use / percent:.1f} %", anchor="right", size=11))
    axes = Axes(
        title="Limits used up",
        xlabel="utilisation  [%]",
        xlim=(0, 162),
        ylim=(0.6 - len(used), 0.6),
        yticks={-i: name for i, name in enumerate(used)},
    )
    return picture(axes, marks)


def section(analysis: Any) -> Picture:
    """The tube's section to scale, with the nearest standard tube of each series that keeps every limit."""
    shaft = analysis.shaft
    D, d = shaft.outer_diameter / mm, shaft.inner_diameter / mm
    reach = max(82.0, 0.58 * D)
    outer, inner = circle((0, 0), D / 2), circle((0, 0), d / 2)
    told = f"D = {D:.5g} mm\nd = {d:.5g} mm\nwall {(D - d) / 2:.4g} mm"
    window = (-reach, reach)
    return picture(
        Axes(title="Section, to scale", xlabel="[mm]", ylabel="[mm]", equal=True, xlim=window, ylim=window),
        Polygon("wall", *np.hstack([outer, inner[:, ::-1]]), role="flank", opacity=0.55),
        Circle("outside", 0.0, 0.0, D / 2, role="position"),
        Circle("inside", 0.0, 0.0, d / 2, role="position"),
        [_standard(i, *found) for i, found in enumerate(analysis.sizes.nearest(shaft).items())],
        Text("sizes", 0, 0, told, size=11),
    )


def _standard(number: int, series: str, tube: Any) -> Line:
    """The outlines of a standard tube, its size told in the legend; ``None``: that none holds."""
    both, told = np.full((2, 1), np.nan), f"no {series} tube keeps every limit"
    if tube is not None:
        D, d = tube.outer_diameter / mm, tube.inner_diameter / mm
        both = np.hstack([circle((0, 0), D / 2), [[np.nan], [np.nan]], circle((0, 0), d / 2)])
        told = f"nearest {series}: {D:.5g} × {(D - d) / 2:.4g} mm"
    return Line(series, *both, role="series", index=1 + 2 * number, stroke="dashed", label=told)


def candidates(name: str | None = None, optimum: float | None = None) -> View:
    """A view of a finished competitive search: where its candidates stood in each cycle, the paper's Fig. 2.

    ``name`` is a free quantity, or the objective if none is said; ``optimum`` (SI) is drawn if it is known.
    """

    refuse_arguments(candidates, locals())

    def paths(search: Any) -> Picture:
        study, (x, f) = search.problem.study, search.paths
        what = _free(study, name) if name else _objective(study)
        values = (x[..., list(study.free).index(name)] if name else f) / what.factor
        cycles, named = np.arange(len(values)), name is None
        marks: list[Mark] = []
        for k in range(values.shape[1])[::-1]:
            label = ("best", "others", "", "")[min(k, 3)] if named else ""
            role = "guide" if k else "profile"
            marks.append(Line(f"candidate {k}", cycles, values[:, k], role=role, label=label))
        if optimum is not None:
            known, label = [optimum / what.factor] * 2, "true optimum" if named else ""
            marks.append(Line("optimum", cycles[[0, -1]], known, role="allowed", stroke="dashed", label=label))
        return picture(Axes(title=what.title, xlabel="cycle", ylabel=what.label), marks)

    return paths


class _Shown(NamedTuple):
    """What an axis shows."""

    title: str
    label: str
    factor: float


def _free(study: Any, name: str) -> _Shown:
    declared = declarations(study.start)[name]
    assert isinstance(declared, Quantity)
    return _Shown(words(name).capitalize(), f"{declared.symbol}  [{declared.unit}]", declared.factor)


def _objective(study: Any) -> _Shown:
    measure: Measure = study.minimise[0]
    return _Shown(measure.name.capitalize(), measure.label, factor(measure.unit))
