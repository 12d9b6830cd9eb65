"""Views of fronts: one with its winner, several laid over each other, one that follows the sliders, the weights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..decision import Judgements
from ..quantities.kinds import numbers, refuse_arguments, refuse_empty, refuse_kinds, shown
from ..units import factor
from .picture import Axes, Line, Mark, Picture, Points, Text, gaps


@dataclass(frozen=True)
class ShownFront:
    """A front with what is marked on it: indices of the design in the sliders and of the winner."""

    front: Any
    selected: int | None = None
    winner: int | None = None
    start: Any = None
    """Objectives of the starting design, ``(k,)``."""
    known: Any = None
    """Points of the front that are known, as they are read, ``(2, m)``."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for what, place in (("selected design", self.selected), ("winner", self.winner)):
            if place is not None and not 0 <= place < len(self.front):
                raise ValueError(f"the {what} is {place}; there are {len(self.front)} designs, counted from 0")
        _refuse_objectives(self.start, "starting design", self.front)
        if self.known is not None and numbers(self.known, "the points of the front that are known").shape[:-1] != (2,):
            raise ValueError(f"the points of the front that are known are {shown(self.known)}; they must be two rows")


def _refuse_objectives(at: Any, what: str, front: Any) -> None:
    """``ValueError`` for objectives of a design that are not a number for each of the front's."""
    if at is not None and numbers(at, f"the objectives of the {what}").shape != (len(front.study.minimise),):
        raise ValueError(f"the objectives of the {what} are {shown(at)}; there must be {len(front.study.minimise)}")


def shown_objectives(front: Any) -> np.ndarray:
    """The first two objectives as a person reads them: in their units, large is large; ``(2, p)``."""
    return _read(front.study.minimise, np.reshape(front.f, (-1, len(front.study.minimise))).T)


def _read(objectives: Any, f: Any) -> np.ndarray:
    """Two rows, the second of them 0 where there is one objective only."""
    rows = [m.sign * np.asarray(values) / factor(m.unit) for m, values in zip(objectives, f, strict=True)]
    return np.array([*rows, 0 * rows[0]])[:2]


def _one(objectives: Any, f: Any) -> np.ndarray:
    """A single design's first two objectives as they are read, ``(2, 1)``; ``(2, 0)`` of none."""
    return np.zeros((2, 0)) if f is None else _read(objectives, np.reshape(f, (-1, 1)))


def _axes(title: str, objectives: Any) -> Axes:
    x, y = ([f"{m.label}\n({'larger' if m.sign < 0 else 'smaller'} is better)" for m in objectives] + [""])[:2]
    return Axes(title=title, xlabel=x, ylabel=y)


def pareto(shown: ShownFront) -> Picture:
    """The front of the first two objectives, the start, the design in the sliders and the winner."""
    known = np.zeros((2, 0)) if shown.known is None else shown.known
    style: Any = {"mark": "diamond", "size": 9, "fill": "none", "role": "allowed"}
    label = "" if shown.known is None else "known points"
    axes = _axes("Pareto front", shown.front.study.minimise)
    return Picture.of(axes, _front(shown), Points("known", *known, label=label, **style))


def _front(shown: ShownFront) -> list[Mark]:
    x, y = shown_objectives(shown.front)
    here, winner = (slice(0, 0) if i is None else slice(i, i + 1) for i in (shown.selected, shown.winner))
    return [
        Points("front", x, y, role="position", size=6, opacity=0.75, label="front"),
        Points("start", *_one(shown.front.study.minimise, shown.start), role="guide", mark="square", label="start"),
        Points("in the sliders", x[here], y[here], size=14, fill="none", label="in the sliders"),
        Points("winner", x[winner], y[winner], role="limit", mark="star", size=19, fill="none", label="winner"),
    ]


@dataclass(frozen=True)
class ShownFronts:
    """Fronts of the same objectives by name, and the objectives of two single designs, ``(k,)``."""

    fronts: Mapping[str, Any]
    start: Any = None
    here: Any = None
    """Of the design in the sliders."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        refuse_empty(self.fronts, "fronts")
        for front in self.fronts.values():
            _refuse_objectives(self.start, "starting design", front)
            _refuse_objectives(self.here, "design in the sliders", front)


FORMS: Any = ({"size": 8, "fill": "none"}, {"size": 3})
"""Fronts take turns: rings, and dots that fit into them."""


def fronts_overlaid(shown: ShownFronts) -> Picture:
    """Several fronts of the same two objectives, the start and the design in the sliders."""
    objectives = next(iter(shown.fronts.values())).study.minimise[:2]
    marks: list[Mark] = [
        Points(f"front {name}", *shown_objectives(front), role="series", index=i, label=name, **FORMS[i % 2])
        for i, (name, front) in enumerate(shown.fronts.items())
    ]
    start, here = (_one(objectives, None if f is None else f[: len(objectives)]) for f in (shown.start, shown.here))
    named = ["" if f is None else "shown" for f in (shown.start, shown.here)]
    marks += [
        Points("start", *start, role="guide", mark="square", label=named[0] and "start"),
        Points("in the sliders", *here, size=11, fill="paper", label=named[1] and "in the sliders"),
    ]
    return Picture.of(_axes("What one objective costs the other", objectives), marks)


@dataclass(frozen=True)
class LiveFront:
    """A front as it is now and as it was ``before``, its winner, and the objectives of the design in the sliders."""

    front: Any
    before: Any
    here: Any
    winner: int | None = None


def live_pareto(shown: LiveFront) -> Picture:
    """The front as it is now, pale as it was before, its winner and where the design in the sliders stands."""
    objectives = shown.front.study.minimise[:2]
    front = {mark.key: mark for mark in _front(ShownFront(shown.front, winner=shown.winner))}
    before = shown_objectives(shown.before)
    here = [m.sign * v / factor(m.unit) for m, v in zip(objectives, shown.here, strict=False)]
    return Picture.of(
        _axes("What is possible", objectives),
        Points("before", *before, role="ghost", size=6, label="before"),
        front["front"],
        Points("in the sliders", *np.reshape(here, (-1, 1)), size=14, fill="none", label="in the sliders"),
        front["winner"],
    )


def searches_compared(searches: Mapping[str, Any]) -> Picture:
    """What each search still lacks of the best hypervolume known, against the designs evaluated; both axes logarithmic.

    ``searches``: pairs of designs evaluated and missing share of the hypervolume, ``(k, 2)``, by name.
    """
    refuse_arguments(searches_compared, locals())
    for name, points in searches.items():
        if np.shape(numbers(points, f"the points of {name}"))[1:] != (2,):
            raise ValueError(f"the points of {name} are {shown(points)}; they must be pairs of designs and shares")
    axes = Axes(
        title="How fast a front is found",
        xlabel="designs evaluated",
        ylabel="hypervolume still missing  [%]",
        log="xy",
    )
    return Picture.of(
        axes,
        [
            Line(name, *(np.transpose(points) * [[1], [100]]), role="series", index=i, label=name)
            for i, (name, points) in enumerate(searches.items())
        ],
    )


def weight_bars(judgements: Judgements) -> Picture:
    """Weights of the criteria as bars; the consistency ratio above them."""
    names = judgements.names
    marks: list[Mark] = []
    for i, (name, weight) in enumerate(zip(names, judgements.weights, strict=True)):
        marks.append(Line(name, [0, 100 * weight], [-i, -i], role="position", stroke="bar"))
        share = 100 * weight
        marks.append(Text(f"{name} value", share + 1.5, -i, "{:.1f} %", values=(share,), anchor="left", size=11))
    ratio = judgements.consistency_ratio
    marks.append(Points("inconsistent", gaps(100.0, ratio > 0.1), 0.62, role="trouble"))
    marks.append(Text("ratio", 98, 0.62, "consistency ratio {:.3f}", values=(ratio,), anchor="right", size=11))
    axes = Axes(
        title="Weights",
        xlabel="weight  [%]",
        xlim=(0, 104),
        ylim=(0.5 - len(names), 0.9),
        yticks={-i: name for i, name in enumerate(names)},
    )
    return Picture.of(axes, marks)
