"""Views of fronts: one with its winner, several laid over each other, one that follows the sliders, the weights."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import cycle
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ..decision import Judgements, Judges
from ..quantities import Measure
from ..quantities.kinds import numbers, refuse_arguments, refuse_empty, refuse_kinds, shown
from ..quantities.types import Array
from ..study.study import Study
from ..units import factor
from .picture import Axes, Line, Mark, Picture, Points, Text, gaps


@runtime_checkable
class Judged(Protocol):
    """Designs of a study with their objectives, such as a front."""

    @property
    def study(self) -> Study:
        """What the designs were judged by."""
        ...

    @property
    def x(self) -> Array:
        """Their free values, ``(p, n)``."""
        ...

    @property
    def f(self) -> Array:
        """Their objectives, ``(p, k)``."""
        ...

    def __len__(self) -> int: ...


@dataclass(frozen=True)
class ShownFront:
    """A front with what is marked on it: indices of the design in the sliders and of the winner."""

    front: Judged
    selected: int | None = None
    winner: int | None = None
    start: Array | Sequence[float] | None = None
    """Objectives of the starting design, ``(k,)``."""
    known: Array | Sequence[Sequence[float]] | None = None
    """Points of the front that are known, as they are read, ``(2, m)``."""
    reference: Array | Sequence[float] | None = None
    """Objectives that a person wishes, ``(k,)``."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for what, place in (("selected design", self.selected), ("winner", self.winner)):
            if place is not None and not 0 <= place < len(self.front):
                raise ValueError(f"the {what} is {place}; there are {len(self.front)} designs, counted from 0")
        _refuse_objectives(self.start, "starting design", self.front)
        _refuse_objectives(self.reference, "reference point", self.front)
        if self.known is not None and numbers(self.known, "the points of the front that are known").shape[:-1] != (2,):
            raise ValueError(f"the points of the front that are known are {shown(self.known)}; they must be two rows")


def _refuse_objectives(at: object, what: str, front: Judged) -> None:
    """``ValueError`` for objectives of a design that are not a number for each of the front's."""
    if at is not None and numbers(at, f"the objectives of the {what}").shape != (len(front.study.minimise),):
        raise ValueError(f"the objectives of the {what} are {shown(at)}; there must be {len(front.study.minimise)}")


def shown_objectives(front: Judged) -> np.ndarray:
    """The first two objectives as a person reads them: in their units, large is large; ``(2, p)``."""
    return _read(front.study.minimise, np.reshape(front.f, (-1, len(front.study.minimise))).T)


def _read(objectives: Sequence[Measure], f: Iterable[ArrayLike]) -> np.ndarray:
    """Two rows, the second of them 0 where there is one objective only."""
    rows = [m.sign * np.asarray(values) / factor(m.unit) for m, values in zip(objectives, f, strict=True)]
    return np.array([*rows, 0 * rows[0]])[:2]


def one_design(objectives: Sequence[Measure], f: ArrayLike | None) -> np.ndarray:
    """A single design's first two objectives as they are read, ``(2, 1)``; ``(2, 0)`` of none."""
    return np.zeros((2, 0)) if f is None else _read(objectives, np.reshape(f, (-1, 1)))


def axes_of(title: str, objectives: Sequence[Measure]) -> Axes:
    """The axes of the first two objectives."""
    x, y = ([f"{m.label}\n({'larger' if m.sign < 0 else 'smaller'} is better)" for m in objectives] + [""])[:2]
    return Axes(title=title, xlabel=x, ylabel=y)


def pareto(shown: ShownFront) -> Picture:
    """The front of the first two objectives, the start, the design in the sliders and the winner."""
    known = np.zeros((2, 0)) if shown.known is None else shown.known
    label = "" if shown.known is None else "known points"
    return Picture.of(
        axes_of("Pareto front", shown.front.study.minimise),
        _front(shown),
        Points("known", *known, role="allowed", mark="diamond", size=9, fill="none", label=label),
        wished(shown.front, shown.reference),
    )


def wished(front: Judged, reference: ArrayLike | None) -> Points:
    """The reference point among the first two objectives, if there is one: what a person wishes of them."""
    label = "" if reference is None else "reference point"
    at = one_design(front.study.minimise, reference)
    return Points("reference", *at, mark="plus", size=13, label=label)


def _front(shown: ShownFront) -> list[Mark]:
    x, y = shown_objectives(shown.front)
    here, winner = (slice(0, 0) if i is None else slice(i, i + 1) for i in (shown.selected, shown.winner))
    return [
        Points("front", x, y, role="position", size=6, opacity=0.75, label="front"),
        Points(
            "start", *one_design(shown.front.study.minimise, shown.start), role="guide", mark="square", label="start"
        ),
        Points("in the sliders", x[here], y[here], size=14, fill="none", label="in the sliders"),
        Points("winner", x[winner], y[winner], role="limit", mark="star", size=19, fill="none", label="winner"),
    ]


@dataclass(frozen=True)
class ShownFronts:
    """Fronts of the same objectives by name, and the objectives of two single designs, ``(k,)``."""

    fronts: Mapping[str, Judged]
    start: Array | Sequence[float] | None = None
    here: Array | Sequence[float] | None = None
    """Of the design in the sliders."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        refuse_empty(self.fronts, "fronts")
        for front in self.fronts.values():
            _refuse_objectives(self.start, "starting design", front)
            _refuse_objectives(self.here, "design in the sliders", front)


FORMS = ((8, "none"), (3, "full"))
"""Size and inside of points; fronts take turns: rings, and dots that fit into them."""


def fronts_overlaid(shown: ShownFronts) -> Picture:
    """Several fronts of the same two objectives, the start and the design in the sliders."""
    objectives = next(iter(shown.fronts.values())).study.minimise[:2]
    marks: list[Mark] = [
        Points(f"front {name}", *shown_objectives(front), role="series", index=i, size=size, fill=fill, label=name)
        for i, ((name, front), (size, fill)) in enumerate(zip(shown.fronts.items(), cycle(FORMS), strict=False))
    ]
    start, here = (
        one_design(objectives, None if f is None else f[: len(objectives)]) for f in (shown.start, shown.here)
    )
    named = ["" if f is None else "shown" for f in (shown.start, shown.here)]
    marks += [
        Points("start", *start, role="guide", mark="square", label=named[0] and "start"),
        Points("in the sliders", *here, size=11, fill="paper", label=named[1] and "in the sliders"),
    ]
    return Picture.of(axes_of("What one objective costs the other", objectives), marks)


@dataclass(frozen=True)
class LiveFront:
    """A front as it is now and as it was ``before``, its winner, and the objectives of the design in the sliders."""

    front: Judged
    before: Judged
    here: Array | Sequence[float]
    winner: int | None = None
    reference: Array | Sequence[float] | None = None
    """Objectives that a person wishes, ``(k,)``."""


def live_pareto(shown: LiveFront) -> Picture:
    """The front as it is now, pale as it was before, its winner and where the design in the sliders stands."""
    objectives = shown.front.study.minimise[:2]
    front = {mark.key: mark for mark in _front(ShownFront(shown.front, winner=shown.winner))}
    before = shown_objectives(shown.before)
    here = [m.sign * v / factor(m.unit) for m, v in zip(objectives, shown.here, strict=False)]
    return Picture.of(
        axes_of("What is possible", objectives),
        Points("before", *before, role="ghost", size=6, label="before"),
        front["front"],
        Points("in the sliders", *np.reshape(here, (-1, 1)), size=14, fill="none", label="in the sliders"),
        front["winner"],
        wished(shown.front, shown.reference),
    )


def searches_compared(searches: Mapping[str, object]) -> Picture:
    """What each search still lacks of the best hypervolume known, against the designs evaluated; both axes logarithmic.

    ``searches``: pairs of designs evaluated and missing share of the hypervolume, ``(k, 2)``, by name.
    """
    refuse_arguments(searches_compared, locals())
    tables = {name: numbers(points, f"the points of {name}") for name, points in searches.items()}
    for name, points in tables.items():
        if points.shape[1:] != (2,):
            told = shown(searches[name])
            raise ValueError(f"the points of {name} are {told}; they must be pairs of designs and shares")
    axes = Axes(
        title="How fast a front is found",
        xlabel="designs evaluated",
        ylabel="hypervolume still missing  [%]",
        log="xy",
    )
    return Picture.of(
        axes,
        [
            Line(name, *(points.T * [[1], [100]]), role="series", index=i, label=name)
            for i, (name, points) in enumerate(tables.items())
        ],
    )


def weight_bars(judgements: Judgements) -> Picture:
    """Weights of the criteria as bars; the consistency ratio above them."""
    names = judgements.names
    marks: list[Mark] = []
    for i, (name, weight) in enumerate(zip(names, judgements.weights, strict=True)):
        marks.append(Line(name, [0, 100 * weight], [-i, -i], role="position", stroke="bar"))
        share = 100 * weight
        marks.append(Text(f"{name} value", share + 1.5, -i, f"{share:.1f} %", anchor="left", size=11))
    ratio = judgements.consistency_ratio
    marks.append(Points("inconsistent", gaps(100.0, ratio > 0.1), 0.62, role="trouble"))
    marks.append(Text("ratio", 98, 0.62, f"consistency ratio {ratio:.3f}", anchor="right", size=11))
    axes = Axes(
        title="Weights",
        xlabel="weight  [%]",
        xlim=(0, 104),
        ylim=(0.5 - len(names), 0.9),
        yticks={-i: name for i, name in enumerate(names)},
    )
    return Picture.of(axes, marks)


def judges_beside(judges: Judges) -> Picture:
    """The weights of a group as bars, and those of each judge on them."""
    together = weight_bars(judges.judgements)
    rows = -np.arange(len(judges.names)) - 0.38  # below the bars
    points = [
        Points(f"judge {i}", 100 * said.weights, rows, role="series", index=i, size=7, fill="paper", label=name)
        for i, (name, said) in enumerate(judges.said.items())
    ]
    return Picture.of(together.axes, list(together.marks), points)
