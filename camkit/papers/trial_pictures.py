"""Views of trials: how many evaluations each method needed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..quantities.kinds import refuse_arguments, refuse_empty
from ..views.picture import Axes, Band, Colour, Line, Mark, Picture, Points, Text, View
from .optimiser_trials import TARGETS, Trials

FEWEST = 3
"""Where the axis of evaluations begins."""


def evaluations_needed(trials: Sequence[Trials]) -> Picture:
    """Trials of several methods on one problem: every run a dot, the quartiles of all runs a box, the median a bar.

    Filled dots: to 1 %; hollow ones: to 0.1 %.  Runs that did not arrive count as beyond the budget.
    """
    refuse_arguments(evaluations_needed, locals())
    refuse_empty(trials, "trials")
    budget = trials[0].budget
    marks: list[Mark] = [
        Band("budget", budget, budget, role="guide", along="y"),
        Text("budget name", 0.93 * budget, 0.62, "budget", role="guide", anchor="right"),
        Text("arrived", 2.4 * budget, 0.62, "runs that arrived", role="guide"),
    ]
    for i, one in enumerate(trials):
        for target, y, fill in zip(TARGETS, (0.2 - i, -0.2 - i), ("full", "paper"), strict=True):
            marks += _box(f"{i} {target}", y, one, target, i, fill)
    axes = Axes(
        title=f"{trials[0].problem}: to 1 % (filled) and to 0.1 % (hollow)",
        xlabel="evaluations",
        log="x",
        xlim=(FEWEST, 5.5 * budget),
        ylim=(0.5 - len(trials), 0.9),
        yticks={-i: one.method for i, one in enumerate(trials)},
    )
    return Picture.of(axes, marks)


def _box(key: str, y: float, trials: Trials, target: float, index: int, fill: str) -> list[Mark]:
    needed, budget = np.sort(trials.to(target)), trials.budget
    came, spread = np.isfinite(needed), y + np.linspace(-0.11, 0.11, len(needed))
    lower, middle, upper = (min(trials.quantile(target, q), budget) for q in (0.25, 0.5, 0.75))
    box = [lower, upper] if lower < budget else []
    half = [middle, middle] if middle < budget else []
    style: Colour = {"role": "series", "index": index}
    return [
        Line(f"box {key}", box, [y, y][: len(box)], stroke="bar", opacity=0.28, **style),
        Points(f"runs {key}", needed[came], spread[came], size=3.8, fill=fill, **style),
        Line(f"median {key}", half, [y - 0.17, y + 0.17][: len(half)], stroke="bold"),
        Text(f"arrived {key}", 2.4 * budget, y, f"{came.sum()} of {len(came)}"),
    ]


def solved_within(target: float, problem: str | None = None) -> View:
    """A view of trials: the share of a method's runs that arrived, over evaluations; of all problems or of one."""

    refuse_arguments(solved_within, locals())

    def shares(trials: Sequence[Trials]) -> Picture:
        budget = trials[0].budget
        marks = []
        for index, method in enumerate(dict.fromkeys(t.method for t in trials)):
            mine = [t for t in trials if t.method == method and problem in (None, t.problem)]
            needed = np.sort(np.concatenate([t.to(target) for t in mine]))
            label = method if problem is None else ""
            marks.append(Line(method, *_steps(needed, budget), role="series", index=index, steps=True, label=label))
        axes = Axes(
            title=f"{problem or 'All problems'}, to {100 * target:g} %",
            xlabel="evaluations",
            ylabel="runs that arrived  [%]",
            log="x",
            xlim=(FEWEST, budget),
            ylim=(-2, 102),
        )
        return Picture.of(axes, marks)

    return shares


def _steps(needed: np.ndarray, budget: int) -> tuple[np.ndarray, np.ndarray]:
    """The share in percent, as steps from 0 to the budget."""
    came = needed[np.isfinite(needed)]
    share = 100 * np.arange(len(came) + 1) / len(needed)
    return np.concatenate([[1.0], came, [budget]]), np.append(share, share[-1])
