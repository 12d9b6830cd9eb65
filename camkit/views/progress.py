"""How far a search has come: generation by generation, the best so far, the intervals that a bisection tried."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Measure, Quantity, declarations, label
from ..quantities.kinds import refuse_arguments, refuse_empty
from ..study.study import Study
from ..units import deg, factor, in_unit
from .picture import Axes, Band, Line, Mark, Picture, Points, Text, View

ROOM = 0.5
"""How far above the first design, as a share of it, designs that a search looked at are shown."""


def convergence(generations: Sequence[Any]) -> Picture:
    """Best and mean of the first objective in every generation of a search, designs that cannot be built left out."""
    refuse_arguments(convergence, locals())
    refuse_empty(generations, "generations")
    measure = generations[0].study.minimise[0]
    built = [g.evaluation.f[np.isfinite(g.evaluation.f[:, 0]), 0] for g in generations]
    numbers = [g.number for g in generations]
    mean, best = (in_unit(measure.sign * np.array([of(f) for f in built]), measure.unit) for of in (np.mean, np.min))
    return Picture.of(
        Axes(title="Convergence", xlabel="generation", ylabel=measure.label, log="x"),
        Line("mean", numbers, mean, role="guide", label="mean"),
        Line("best", numbers, best, role="profile", label="best"),
    )


class ShownLooks(NamedTuple):
    """What a search looked at, and its objective."""

    measure: Measure
    looks: Sequence[tuple[float, float, float]]


def best_so_far(shown: ShownLooks) -> Picture:
    """The objective of what a search looked at, those that miss a limit pale; the line is the best so far."""
    looked, f, kept = np.array(shown.looks, dtype=float).reshape(-1, 3).T
    sense = shown.measure.sign / factor(shown.measure.unit)
    best = np.fmin.accumulate(np.where(kept > 0, f, np.nan)) if len(f) else f
    top = (1 + ROOM) * (best[np.isfinite(best)][0] if np.isfinite(best).any() else np.inf)
    dots = [
        Points(key, looked[seen], sense * f[seen], role=role, size=4, label=key)
        for key, seen, role in (
            ("misses a limit", (kept == 0) & (f <= top), "flank"),
            ("keeps all limits", (kept > 0) & (f <= top), "guide"),
        )
    ]
    line = Line("best", looked, sense * best, role="profile", steps=True, label="best so far")
    axes = Axes(title="The search", xlabel="designs evaluated", ylabel=two_lines(shown.measure), log="x")
    return Picture.of(axes, dots, line)


class ShownIntervals(NamedTuple):
    """The steps of a bisection of intervals so far, and the objective that is limited."""

    measure: Measure
    limit: float
    steps: Sequence[Any]


def intervals_tried(shown: ShownIntervals) -> Picture:
    """The least objective at every interval that was tried; the answer lies in the band that is left."""
    unit = factor(shown.measure.unit)
    tried = np.array([(s.tried, s.optimum.f) for s in shown.steps if s.optimum.feasible]).reshape(-1, 2).T
    kept = tried[1] <= shown.limit
    dots = [
        Points(key, tried[0][where] / deg, tried[1][where] / unit, role=role, size=9, label=key)
        for key, where, role in (("keeps the limit", kept, "allowed"), ("does not", ~kept, "trouble"))
    ]
    ends = tried[0][[tried[0].argmin(), tried[0].argmax()]] / deg if tried.size else np.zeros(0)
    return Picture.of(
        Axes(title="Best designs", xlabel="interval  [deg]", ylabel=two_lines(shown.measure)),
        Band("left", *_left(shown), role="allowed", along="y", opacity=0.18),
        Line("limit", ends, 0 * ends + shown.limit / unit, role="limit", stroke="dashed", label="limit"),
        dots,
    )


def _left(shown: ShownIntervals) -> tuple[float, float]:
    """Between what is too short and what is long enough, deg."""
    last = shown.steps[-1] if shown.steps else None
    return (last.low / deg, last.high / deg) if last and last.low and last.best else (np.nan, np.nan)


def candidates(name: str | None = None, optimum: float | None = None) -> View:
    """A view of a finished competitive search: where its candidates stood in each cycle.

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
        return Picture.of(Axes(title=what.title, xlabel="cycle", ylabel=what.label), marks)

    return paths


class _Shown(NamedTuple):
    """What an axis shows."""

    title: str
    label: str
    factor: float


def _free(study: Study, name: str) -> _Shown:
    declared = declarations(study.start)[name]
    assert isinstance(declared, Quantity)
    return _Shown(label(name, declared).capitalize(), f"{declared.symbol}  [{declared.unit}]", declared.factor)


def _objective(study: Study) -> _Shown:
    measure: Measure = study.minimise[0]
    return _Shown(measure.name.capitalize(), measure.label, factor(measure.unit))


def min_over_bound(name: str) -> View:
    """A view of several results of `minimise`: the least objective over the upper bound that a free quantity had."""
    refuse_arguments(min_over_bound, locals())

    def view(found: Sequence[Any]) -> Picture:
        refuse_empty(found, "results")
        measure, declared = found[0].study.minimise[0], found[0].study.declared[name]
        bound = np.array([best.study.free[name][1] for best in found]) / declared.factor
        least = np.array([best.f for best in found]) / factor(measure.unit)
        told = [
            Text(f"at {x:g}", x, y, f" {y:.2f}", anchor="left bottom", size=11)
            for x, y in zip(bound, least, strict=True)
        ]
        called = label(name, declared)
        xlabel = f"bound of the {called}  [{declared.unit}]"
        axes = Axes(title=f"What a larger {called} buys", xlabel=xlabel, ylabel=two_lines(measure))
        results = Points("results", bound, least, role="position")
        return Picture.of(axes, Line("least", bound, least, role="position"), results, told)

    return view


def two_lines(measure: Measure) -> str:
    """Name and unit of a measure in two lines, for a short axis."""
    return f"{measure.name}\n[{measure.unit}]" if measure.unit else str(measure.name)
