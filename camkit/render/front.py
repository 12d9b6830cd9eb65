"""Views of a decision: the Pareto front, several fronts laid over each other, the weights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..decision import Judgements
from ..kinds import numbers, refuse_empty, refuse_kinds, shown
from ..search.front import Front
from ..units import factor
from .artists import BLUE, GREY, INK, WARNING, colours, line, new, plain, text


@dataclass(frozen=True)
class ShownFront:
    """A front with what is marked on it: indices of the design in the sliders and of the winner."""

    front: Front
    selected: int | None = None
    winner: int | None = None
    start: Any = None
    """Objectives of the starting design, ``(k,)``."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for what, place in (("selected design", self.selected), ("winner", self.winner)):
            if place is not None and not 0 <= place < len(self.front):
                raise ValueError(f"the {what} is {place}; there are {len(self.front)} designs, counted from 0")
        _refuse_objectives(self.start, "starting design", self.front)


def _refuse_objectives(at: Any, what: str, front: Front) -> None:
    """``ValueError`` for objectives of a design that are not a number for each of the front's."""
    if at is not None and numbers(at, f"the objectives of the {what}").shape != (len(front.study.minimise),):
        raise ValueError(f"the objectives of the {what} are {shown(at)}; there must be {len(front.study.minimise)}")


def shown_objectives(front: Any) -> np.ndarray:
    """The first two objectives as a person reads them: in their units, large is large; ``(2, p)``."""
    return _shown(front.study.minimise, np.reshape(front.f, (-1, len(front.study.minimise))).T)


def _shown(objectives: Any, f: Any) -> np.ndarray:
    """Two rows, the second of them 0 where there is one objective only."""
    rows = [m.sign * np.asarray(values) / factor(m.unit) for m, values in zip(objectives, f, strict=True)]
    return np.array([*rows, 0 * rows[0]])[:2]


def _better(measure: Any) -> str:
    return "larger is better" if measure.sign < 0 else "smaller is better"


def pareto(shown: ShownFront, ax: Axes) -> Axes:
    """The front of the first two objectives, the start, the design in the sliders and the winner."""
    first, objectives = new(ax), shown.front.study.minimise
    x, y = shown_objectives(shown.front)
    line(ax, "front", x, y, linestyle="none", marker="o", markersize=6, color=BLUE, alpha=0.75, label="front")
    begin: Any = ([], []) if shown.start is None else _shown(objectives, np.reshape(shown.start, (-1, 1)))
    line(ax, "start", *begin, linestyle="none", marker="s", markersize=8, color=GREY, label="start")
    for key, index, style in (
        ("in the sliders", shown.selected, {"marker": "o", "markersize": 14, "markeredgecolor": INK}),
        ("winner", shown.winner, {"marker": "*", "markersize": 19, "markeredgecolor": WARNING}),
    ):
        at = slice(0, 0) if index is None else slice(index, index + 1)
        line(ax, key, x[at], y[at], linestyle="none", markerfacecolor="none", markeredgewidth=2, label=key, **style)
    _name_axes(ax, objectives)
    if first:
        ax.set_title("Pareto front")
        ax.legend(loc="best")
    return ax


def _name_axes(ax: Axes, objectives: Any) -> None:
    ax.set_xlabel(plain(f"{objectives[0].label}\n({_better(objectives[0])})"))
    if len(objectives) > 1:
        ax.set_ylabel(plain(f"{objectives[1].label}\n({_better(objectives[1])})"))


@dataclass(frozen=True)
class ShownFronts:
    """Fronts of the same objectives by name, and the objectives of two single designs, ``(k,)``."""

    fronts: Mapping[str, Front]
    start: Any = None
    here: Any = None
    """Of the design in the sliders."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        refuse_empty(self.fronts, "fronts")
        for front in self.fronts.values():
            _refuse_objectives(self.start, "starting design", front)
            _refuse_objectives(self.here, "design in the sliders", front)


MARKS: Any = (
    {"marker": "o", "markersize": 8, "markerfacecolor": "none", "markeredgewidth": 1.6},
    {"marker": ".", "markersize": 5},
)
"""Fronts take turns: rings, and dots that fit into them."""


def fronts_overlaid(shown: ShownFronts, ax: Axes) -> Axes:
    """Several fronts of the same two objectives, the start and the design in the sliders."""
    first, objectives = new(ax), next(iter(shown.fronts.values())).study.minimise[:2]
    told = colours(len(shown.fronts))
    for i, (name, front) in enumerate(shown.fronts.items()):
        style = {"linestyle": "none", "color": told[i], **MARKS[i % len(MARKS)]}
        line(ax, f"front {name}", *shown_objectives(front), label=name, **style)
    for key, f, style in (
        ("start", shown.start, {"marker": "s", "markersize": 8, "color": GREY}),
        ("in the sliders", shown.here, {"marker": "P", "markersize": 11, "color": INK, "markerfacecolor": "white"}),
    ):
        x, y = [] if f is None else [f[0]], [] if f is None else [f[1]]
        at = [m.sign * np.array(v) / factor(m.unit) for m, v in zip(objectives, (x, y), strict=True)]
        line(ax, key, *at, linestyle="none", label=key if f is not None else "_", zorder=6, **style)
    if first:
        ax.set_title("What one objective costs the other")
        _name_axes(ax, objectives)
        ax.legend(loc="upper right")
    return ax


def weight_bars(judgements: Judgements, ax: Axes) -> Axes:
    """Weights of the criteria as bars; the consistency ratio above them."""
    first = new(ax)
    for i, (name, weight) in enumerate(zip(judgements.names, judgements.weights, strict=True)):
        line(ax, name, [0, 100 * weight], [-i, -i], color=BLUE, linewidth=16, solid_capstyle="butt")
        text(ax, f"{name} value", 100 * weight + 1.5, -i, f"{100 * weight:.1f} %", va="center", color=INK)
    ratio = judgements.consistency_ratio
    line(
        ax,
        "inconsistent",
        [100] if ratio > 0.1 else [],
        [0.62] if ratio > 0.1 else [],
        color=WARNING,
        marker="o",
        clip_on=False,
    )
    text(ax, "ratio", 98, 0.62, f"consistency ratio {ratio:.3f}", ha="right", va="center", color=INK)
    if first:
        ax.set_title("Weights")
        ax.set_yticks([-i for i in range(len(judgements.names))], [plain(name) for name in judgements.names])
        ax.set(xlim=(0, 104), ylim=(0.5 - len(judgements.names), 0.9), xlabel="weight  [%]")
        ax.grid(axis="y", visible=False)
    return ax
