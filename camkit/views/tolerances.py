"""Views of `Tolerances`: bands on curves, the cloud of parts beside the front, which tolerance matters."""

from __future__ import annotations

import numpy as np

from ..quantities import Measure, words
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Value
from ..study.tolerances import AnalysisCurve, Tolerances
from ..units import deg, factor
from .front import Judged, shown_objectives
from .picture import Area, Axes, Colour, Line, Mark, Picture, Points, Text, View, gaps, in_lines


def band(curve: AnalysisCurve) -> View:
    """A view of ``curve`` as it was drawn, and of where the curves of 95 % and of half of the parts lie."""
    refuse_arguments(band, locals())
    return lambda tolerances: _band(tolerances, curve, 0.0)


def deviation(curve: AnalysisCurve) -> View:
    """A view of how far the parts' curves lie from ``curve`` as it was drawn."""
    refuse_arguments(deviation, locals())
    return lambda tolerances: _band(tolerances, curve, curve.values(tolerances.nominal))


def _band(tolerances: Tolerances, curve: AnalysisCurve, base: Value) -> Picture:
    unit = factor(curve.unit)
    angle, x = curve.angle(tolerances.nominal)
    x = x / deg
    nominal, edges = curve.values(tolerances.nominal), tolerances.band(curve)
    known = np.isfinite(edges).all(axis=0) & np.isfinite(nominal)
    low, lower, upper, high = ((edges - base) / unit)[:, known]
    limits = curve.limits if np.ndim(base) == 0 else ()
    axes = Axes(
        title=curve.label[:1].upper() + curve.label[1:],
        xlabel=f"{angle}  [deg]",
        ylabel=f"{'' if np.ndim(base) == 0 else 'deviation  '}[{curve.unit}]",
    )
    return Picture.of(
        axes,
        Area("most", x[known], low, high, role="flank", opacity=0.35, label="95 %"),
        Area("half", x[known], lower, upper, role="profile", opacity=0.5, label="half"),
        Line("drawn", x, (nominal - base) / unit),
        [
            Line(f"limit {i}", x[[0, -1]], [limit / unit] * 2, role="limit", stroke="dashed")
            for i, limit in enumerate(limits)
        ],
    )


def cloud(front: Judged | None = None) -> View:
    """A view of every part in the first two objectives, beside ``front``; trouble: what misses a limit.

    With one objective: which share of the parts stays below each of its values.
    """
    refuse_arguments(cloud, locals())
    return lambda tolerances: _cloud(tolerances, front)


def _cloud(tolerances: Tolerances, front: Judged | None) -> Picture:
    study, kept = tolerances.study, tolerances.evaluation.feasible
    x, y = _places(tolerances)
    marks: list[Mark] = []
    if len(study.minimise) > 1:
        at = shown_objectives(front) if front is not None and len(front) else np.zeros((2, 0))
        marks.append(Points("front", *at, role="guide", size=5, opacity=0.6, label="front"))
    for key, where, role, label in (
        ("kept", kept, "position", "keeps all limits"),
        ("missed", ~kept, "trouble", "misses one"),
    ):
        marks.append(Points(key, x[where], y[where], role=role, size=2, opacity=0.6, label=label))
    goals = [_positive(m) for m in study.minimise]
    drawn = [m.one(tolerances.nominal) / factor(m.unit) for m in goals][:2]
    here = [*drawn, 50.0][:2]
    marks.append(Points("drawn", here[:1], here[1:], mark="square", size=9, fill="paper", label="as drawn"))
    low, high = tolerances.interval
    axes = Axes(
        title=f"{100 * tolerances.share:.1f} % of parts keep all limits  ({100 * low:.1f} to {100 * high:.1f} %)",
        xlabel=study.minimise[0].label,
        ylabel=study.minimise[1].label if len(study.minimise) > 1 else "parts  [%]",
    )
    return Picture.of(axes, marks)


def _positive(measure: Measure) -> Measure:
    return measure if measure.sign > 0 else -measure


def _places(tolerances: Tolerances) -> np.ndarray:
    """Where each part's point is, ``(2, p)``: two objectives, or one and the share of parts below it, %."""
    found = [tolerances.of(_positive(m)) / factor(m.unit) for m in tolerances.study.minimise[:2]]
    if len(found) == 1:
        found.append(100 * (np.argsort(np.argsort(found[0])) + 0.5) / tolerances.parts)
    return np.array(found)


def sobol_bars(tolerances: Tolerances) -> Picture:
    """For each measure which share of its variance each tolerance causes, and what they cause together."""
    measures, shares = tolerances.measures, 100 * _shares(tolerances)
    names = [*tolerances.half_widths, "together"]
    marks: list[Mark] = []
    for j, name in enumerate(names):
        style: Colour = {"role": "guide"} if name == "together" else {"role": "series", "index": j}
        for i in range(len(measures)):
            start, end = shares[i, :j].sum(), shares[i, : j + 1].sum()
            label = words(name) if i == 0 else ""
            ends = gaps(np.stack([start, end]), end > start)
            marks.append(Line(f"{name} {i}", ends, [-i, -i], stroke="bar", label=label, **style))
            middle, share = gaps((start + end) / 2, end - start > 8), f"{end - start:.0f}"
            marks.append(Text(f"{name} {i} value", middle, -i, share, role="paper", bold=True, size=11))
    for i in range(len(measures)):
        still = gaps(2.0, ~shares[i].any())
        marks.append(Text(f"still {i}", still, -i, "does not vary", role="guide", anchor="left", size=11))
    axes = Axes(
        title="Which tolerance matters",
        xlabel="share of the variance  [%]",
        xlim=(0, 100),
        ylim=(0.5 - len(measures), 0.6),
        yticks={-i: in_lines(measure.name, 22, 2) for i, measure in enumerate(measures)},
    )
    return Picture.of(axes, marks)


def _shares(tolerances: Tolerances) -> np.ndarray:
    """Shares of variance, ``(s, n + 1)``: of each tolerance on its own, and the rest; 0 for what does not vary."""
    given, first = list(tolerances.half_widths), tolerances.indices.first
    shares = np.zeros((len(first), len(given)))
    shares[:, [given.index(name) for name in tolerances.names]] = np.clip(np.nan_to_num(first), 0, 1)
    shares = shares / np.maximum(shares.sum(1, keepdims=True), 1)
    rest = np.where(np.isfinite(first).all(1), 1 - shares.sum(1), 0)
    return np.column_stack([shares, rest])
