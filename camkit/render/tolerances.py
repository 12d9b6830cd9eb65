"""Views of `Tolerances`: bands on curves, the cloud of parts beside the front, which tolerance matters."""

from __future__ import annotations

from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..kinds import refuse_arguments
from ..quantities import Measure, words
from ..search.front import Front
from ..study.tolerances import AnalysisCurve, Tolerances
from ..units import deg, factor
from .artists import BLUE, GREY, INK, SKY, WARNING, area, colours, frame, line, new, plain, text
from .front import shown_objectives
from .picture import View


def band(curve: AnalysisCurve) -> View:
    """A view of ``curve`` as it was drawn, and of where the curves of 95 % and of half of the parts lie."""
    refuse_arguments(band, locals())
    return lambda tolerances, ax: _band(tolerances, ax, curve, 0.0)


def deviation(curve: AnalysisCurve) -> View:
    """A view of how far the parts' curves lie from ``curve`` as it was drawn."""
    refuse_arguments(deviation, locals())
    return lambda tolerances, ax: _band(tolerances, ax, curve, curve.values(tolerances.nominal))


def _band(tolerances: Tolerances, ax: Axes, curve: AnalysisCurve, base: Any) -> Axes:
    first, unit = new(ax), factor(curve.unit)
    angle, x = curve.angle(tolerances.nominal)
    x = x / deg
    nominal, edges = curve.values(tolerances.nominal), tolerances.band(curve)
    known = np.isfinite(edges).all(axis=0) & np.isfinite(nominal)
    low, lower, upper, high = ((edges - base) / unit)[:, known]
    outer = _between(x[known], low, high)
    area(ax, "most", outer, facecolor=SKY, alpha=0.35, edgecolor="none", zorder=1, label="95 %")
    inner = _between(x[known], lower, upper)
    area(ax, "half", inner, facecolor=BLUE, alpha=0.5, edgecolor="none", zorder=2, label="half")
    line(ax, "drawn", x, (nominal - base) / unit, color=INK, linewidth=1.3, zorder=3, label="_")
    for i, limit in enumerate(curve.limits if np.ndim(base) == 0 else ()):
        line(ax, f"limit {i}", x[[0, -1]], [limit / unit] * 2, color=WARNING, linewidth=1, linestyle="--", label="_")
    if first:
        of = "" if np.ndim(base) == 0 else "deviation  "
        frame(ax, curve.label[:1].upper() + curve.label[1:], f"{angle}  [deg]", f"{of}[{curve.unit}]")
        place: Any = {"loc": "lower right", "bbox_to_anchor": (1.02, 0.99), "borderaxespad": 0.1}
        ax.legend(ncols=2, handlelength=0.8, handletextpad=0.3, columnspacing=0.6, **place)
    return ax


def _between(x: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """The outline of what lies between two curves, ``(2, 2m)``."""
    return np.array([np.append(x, x[::-1]), np.append(low, high[::-1])])


def cloud(front: Front | None = None) -> View:
    """A view of every part in the first two objectives, beside ``front``; what misses a limit is vermilion.

    With one objective: which share of the parts stays below each of its values.
    """
    refuse_arguments(cloud, locals())
    return lambda tolerances, ax: _cloud(tolerances, ax, front)


def _cloud(tolerances: Tolerances, ax: Axes, front: Any) -> Axes:
    first, study = new(ax), tolerances.study
    kept = tolerances.evaluation.feasible
    x, y = _places(tolerances)
    if len(study.minimise) > 1:
        at = shown_objectives(front) if front is not None and len(front) else np.zeros((2, 0))
        line(
            ax, "front", *at, linestyle="none", marker="o", markersize=5, color=GREY, alpha=0.6, label="front", zorder=1
        )
    dots: Any = {"linestyle": "none", "marker": ".", "markersize": 4, "alpha": 0.6}
    line(ax, "kept", x[kept], y[kept], color=BLUE, label="keeps all limits", zorder=2, **dots)
    line(ax, "missed", x[~kept], y[~kept], color=WARNING, label="misses one", zorder=3, **dots)
    drawn = [m.sign * float(_plain(m)(tolerances.nominal)) / factor(m.unit) for m in map(_plain, study.minimise)][:2]
    if len(drawn) == 1:
        drawn.append(50.0)
    style: Any = {
        "marker": "s",
        "markersize": 9,
        "markerfacecolor": "white",
        "markeredgecolor": INK,
        "markeredgewidth": 2,
    }
    line(ax, "drawn", drawn[:1], drawn[1:], linestyle="none", label="as drawn", zorder=4, **style)
    low, high = tolerances.interval
    told = f"{100 * tolerances.share:.1f} % of parts keep all limits  ({100 * low:.1f} to {100 * high:.1f} %)"
    text(ax, "yield", 0.02, 1.02, told, transform=ax.transAxes, color=INK, va="bottom", fontweight="bold")
    if first:
        frame(ax, "", study.minimise[0].label, study.minimise[1].label if len(study.minimise) > 1 else "parts  [%]")
        handles = ax.get_legend_handles_labels()[0]
        ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.11), ncols=len(handles), markerscale=1.6)
    return ax


def _plain(measure: Measure) -> Measure:
    return measure if measure.sign > 0 else -measure


def _places(tolerances: Tolerances) -> np.ndarray:
    """Where each part's point is, ``(2, p)``: two objectives, or one and the share of parts below it, %."""
    found = [tolerances.of(_plain(m)) / factor(m.unit) for m in tolerances.study.minimise[:2]]
    if len(found) == 1:
        found.append(100 * (np.argsort(np.argsort(found[0])) + 0.5) / tolerances.parts)
    return np.array(found)


def sobol_bars(tolerances: Tolerances, ax: Axes) -> Axes:
    """For each measure which share of its variance each tolerance causes, and in grey what they cause together."""
    first, measures, shares = new(ax), tolerances.measures, _shares(tolerances)
    bars = {**dict(zip(tolerances.half_widths, colours(len(tolerances.half_widths)), strict=True)), "together": GREY}
    for j, (name, colour) in enumerate(bars.items()):
        for i in range(len(measures)):
            start, end = 100 * shares[i, :j].sum(), 100 * shares[i, : j + 1].sum()
            style: Any = {"color": colour, "linewidth": 17, "solid_capstyle": "butt"}
            line(ax, f"{name} {i}", [start, end] if end > start else [], [-i, -i] if end > start else [], **style)
            told = f"{end - start:.0f}" if end - start > 8 else ""
            text(
                ax,
                f"{name} {i} value",
                (start + end) / 2,
                -i,
                told,
                ha="center",
                va="center",
                color="white",
                weight="bold",
            )
        if first:
            ax.plot([], [], color=colour, linewidth=8, label=words(name))
    for i in range(len(measures)):
        told = "" if shares[i].any() else "does not vary"
        text(ax, f"still {i}", 2, -i, told, va="center", color=GREY)
    if first:
        _label_bars(ax, [fill(measure.name, 20) for measure in measures], 2 if len(bars) < 7 else 3)
    return ax


def _label_bars(ax: Axes, names: list[str], columns: int) -> None:
    ax.set_title("Which tolerance matters")
    ax.set_yticks([-i for i in range(len(names))], [plain(name) for name in names])
    ax.set(xlim=(0, 100), ylim=(0.5 - len(names), 0.6), xlabel="share of the variance  [%]")
    ax.grid(axis="y", visible=False)
    ax.legend(loc="upper center", bbox_to_anchor=(0.4, -0.2), ncols=columns, columnspacing=1.2)


def _shares(tolerances: Tolerances) -> np.ndarray:
    """Shares of variance, ``(s, n + 1)``: of each tolerance on its own, and the rest; 0 for what does not vary."""
    given, first = list(tolerances.half_widths), tolerances.indices.first
    shares = np.zeros((len(first), len(given)))
    shares[:, [given.index(name) for name in tolerances.names]] = np.clip(np.nan_to_num(first), 0, 1)
    shares = shares / np.maximum(shares.sum(1, keepdims=True), 1)
    rest = np.where(np.isfinite(first).all(1), 1 - shares.sum(1), 0)
    return np.column_stack([shares, rest])
