"""Views of trials: how many evaluations each method needed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..kinds import refuse_arguments, refuse_empty
from ..papers.optimiser_trials import Trials
from .artists import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY, line, new, plain, text

STYLES: Any = (
    {"color": BLUE},
    {"color": SKY, "linestyle": "--"},
    {"color": GREEN},
    {"color": GREEN, "linestyle": "--"},
    {"color": GREEN, "linestyle": "-."},
    {"color": ORANGE},
    {"color": PURPLE},
    {"color": PURPLE, "linestyle": "--"},
    {"color": GREY, "linestyle": ":"},
)
"""A line for each method, in the order of the data file; related methods share a colour."""
TARGETS = (0.01, 0.001)
FEWEST = 3
"""Where the axis of evaluations begins."""


def _percent(target: float) -> str:
    return f"{100 * target:g} %"


def evaluations_needed(trials: Sequence[Trials], ax: Axes) -> Axes:
    """Trials of several methods on one problem: every run a dot, the quartiles of all runs a box, the median a bar.

    Filled dots: to 1 %; hollow ones: to 0.1 %.  Runs that did not arrive count as beyond the budget.
    """
    refuse_arguments(evaluations_needed, locals())
    refuse_empty(trials, "trials")
    budget = trials[0].budget
    if new(ax):
        ax.set_title(plain(trials[0].problem) + ": to 1 % (filled) and to 0.1 % (hollow)")
        ax.set_xscale("log")
        ax.set(xlim=(FEWEST, 5.5 * budget), ylim=(0.5 - len(trials), 0.9), xlabel="evaluations")
        ax.set_yticks([-i for i in range(len(trials))], [plain(t.method) for t in trials])
        ax.grid(axis="y", visible=False)
        ax.axvline(budget, color=GREY, linewidth=1.2)
        ax.text(0.93 * budget, 0.62, "budget", ha="right", va="center", color=GREY, fontsize=9.5)
        ax.text(2.4 * budget, 0.62, "runs that arrived", ha="center", va="center", color=GREY, fontsize=9.5)
    for i, (one, style) in enumerate(zip(trials, STYLES[: len(trials)], strict=True)):
        for target, y, fill in zip(TARGETS, (0.2 - i, -0.2 - i), (style["color"], "white"), strict=True):
            _box(ax, f"{i} {target}", y, one, target, style["color"], fill)
    return ax


def _box(ax: Axes, key: str, y: float, trials: Any, target: float, colour: str, fill: str) -> None:
    needed, budget = np.sort(trials.to(target)), trials.budget
    came, spread = np.isfinite(needed), y + np.linspace(-0.11, 0.11, len(needed))
    lower, middle, upper = (min(trials.quantile(target, q), budget) for q in (0.25, 0.5, 0.75))
    box = [lower, upper] if lower < budget else []
    half = [middle, middle] if middle < budget else []
    flat: Any = {"solid_capstyle": "butt"}
    line(ax, f"box {key}", box, [y, y][: len(box)], color=colour, alpha=0.28, linewidth=11, zorder=2, **flat)
    line(ax, f"runs {key}", needed[came], spread[came], linestyle="none", marker="o", markersize=3.8, color=colour,
         markerfacecolor=fill, markeredgewidth=0.8, zorder=3)  # fmt: skip
    line(ax, f"median {key}", half, [y - 0.17, y + 0.17][: len(half)], color=INK, linewidth=2.2, zorder=4, **flat)
    text(
        ax,
        f"arrived {key}",
        2.4 * budget,
        y,
        f"{came.sum()} of {len(came)}",
        ha="center",
        va="center",
        color=INK,
        fontsize=9.5,
    )


def solved_within(target: float, problem: str | None = None) -> Callable[[Sequence[Trials], Axes], Axes]:
    """A view of trials: the share of a method's runs that arrived, over evaluations; of all problems or of one."""

    refuse_arguments(solved_within, locals())

    def shares(trials: Sequence[Trials], ax: Axes) -> Axes:
        first, budget = new(ax), trials[0].budget
        methods = dict.fromkeys(t.method for t in trials)
        for method, style in zip(methods, STYLES[: len(methods)], strict=True):
            mine = [t for t in trials if t.method == method and problem in (None, t.problem)]
            needed = np.sort(np.concatenate([t.to(target) for t in mine]))
            line(ax, method, *_steps(needed, budget), drawstyle="steps-post", label=method, **style)
        if first:
            ax.set_title(f"{plain(problem or 'All problems')}, to {_percent(target)}")
            ax.set_xscale("log")
            ax.set(xlim=(FEWEST, budget), ylim=(-2, 102), xlabel="evaluations", ylabel="runs that arrived  [%]")
            if problem is None:
                ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.11), ncols=3, columnspacing=1.2, handlelength=2)
        return ax

    return shares


def _steps(needed: np.ndarray, budget: int) -> tuple[np.ndarray, np.ndarray]:
    """The share in percent, as steps from 0 to the budget."""
    came = needed[np.isfinite(needed)]
    share = 100 * np.arange(len(came) + 1) / len(needed)
    return np.concatenate([[1.0], came, [budget]]), np.append(share, share[-1])
