"""Views of a choice from a front: who wins by which rule, at which weights, and for how long."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.path import Path

from ..decision import CHOOSERS, WEIGHING, JudgementRange, Judgements, WinnerMap, judgement_ranges, winner_map
from ..quantities import Measure, words
from ..units import factor
from .artists import BLUE, GREEN, GREY, INK, ORANGE, PALE, PURPLE, SKY, area, line, new, plain, text
from .parallel import Column, Designs, parallel_coordinates

WINNER_COLOURS = (ORANGE, GREEN, PURPLE, SKY)
MARKS: dict[str, Any] = {
    "weighted sum": {"marker": "*", "markersize": 20},
    "TOPSIS": {"marker": "D", "markersize": 11},
    "knee": {"marker": "^", "markersize": 13},
    "crowding distance": {"marker": "s", "markersize": 14},
}
"""The mark of each rule's winner."""
OTHERS = tuple(to_hex([1 - share * (1 - c) for c in to_rgb(GREY)]) for share in (0.18, 0.30, 0.42))  # type: ignore[arg-type]
"""Greys for designs that win somewhere, but not now."""


@dataclass(frozen=True)
class ShownDecision:
    """A front and what follows from the judgements of its objectives; designs are named by their place on it."""

    front: Any
    designs: Designs
    """Objectives, free quantities and further measures of the front's designs; winners are marked."""
    winners: Mapping[str, int]
    """The design that each rule takes."""
    weights: np.ndarray
    """Weights of the objectives, ``(k,)``."""
    maps: Mapping[str, WinnerMap]
    """Who wins at which weights, for each rule that asks for weights."""
    ranges: Mapping[str, tuple[JudgementRange, ...]]
    """How far each judgement may move, for the same rules."""

    def judged(self, judgements: Judgements | None = None) -> ShownDecision:
        """The same front under other judgements of its objectives; ``None``: all alike."""
        k = self.front.f.shape[1]
        judgements = Judgements(self.names, np.ones((k, k))) if judgements is None else judgements
        weights = judgements.weights
        winners = {rule: CHOOSERS[rule](self.front, weights) for rule in MARKS}
        ranges = {rule: judgement_ranges(self.front, judgements, CHOOSERS[rule]) for rule in WEIGHING}
        colours = dict(zip(dict.fromkeys(winners.values()), WINNER_COLOURS, strict=False))
        designs = replace(self.designs, marked=colours)
        return replace(self, designs=designs, winners=winners, weights=weights, ranges=ranges)

    @property
    def colours(self) -> Mapping[int, str]:
        """A colour for each design that wins now."""
        return self.designs.marked

    def winner_at(self, x: float, y: float) -> int | None:
        """Who wins at a point of the map of winners, if it shows weights there."""
        k, rules = len(self.weights), list(self.maps)
        if k == 2 and 0 <= x <= 100 and (row := round(-y)) in range(len(rules)) and abs(row + y) < BAR:
            chart = self.maps[rules[row]]
            return int(chart.winners[np.argmin(abs(chart.weights[:, 0] - x / 100))])
        if k == 3 and (number := int((x + 0.5 * (APART - 1)) // APART)) in range(len(rules)):
            chart = self.maps[rules[number]]
            away = np.linalg.norm(triangle(chart.weights) - (x - number * APART, y), axis=1)
            return int(chart.winners[np.argmin(away)]) if away.min() < 0.03 else None
        return None

    @property
    def names(self) -> list[str]:
        """The objectives' names."""
        return [measure.name for measure in self.front.study.minimise]


def decision(
    front: Any, judgements: Judgements | None = None, measures: Sequence[Measure] | None = None
) -> ShownDecision:
    """A front that is not empty, and what follows from judgements of its objectives (``None``: all count alike).

    ``measures`` are shown beside objectives and free quantities; by default those that have a limit.
    """
    columns, values = _numbers(front, measures)
    maps = {rule: winner_map(front, CHOOSERS[rule]) for rule in WEIGHING}
    weights = np.zeros(front.f.shape[1])
    shown = ShownDecision(front, Designs(columns, values), {}, weights, maps, {})
    return shown.judged(judgements)


def _numbers(front: Any, measures: Sequence[Measure] | None) -> tuple[tuple[Column, ...], np.ndarray]:
    """Every number of the front's designs that is shown, in its unit, ``(p, n)``."""
    study, p = front.study, len(front)
    goals = [(Column(m.name, m.unit, m.sign), m.sign * f) for m, f in zip(study.minimise, front.f.T, strict=True)]
    free = [(Column(words(n), q.unit), x) for (n, q), x in zip(study.declared.items(), front.x.T, strict=True)]
    limited = {m: sense for m, _, sense in study.limits}
    further = [
        m for m in (limited if measures is None else measures) if m not in study.minimise and -m not in study.minimise
    ]
    analysis = study.analysis(front.x) if further else None
    told = [(Column(m.name, m.unit, limited.get(m, 0)), np.broadcast_to(m(analysis), p)) for m in further]
    shown = [*goals, *free, *told]
    return tuple(c for c, _ in shown), np.column_stack([v / factor(c.unit) for c, v in shown])


def brushed_designs(shown: ShownDecision, ax: Axes) -> Axes:
    """The front's designs in parallel coordinates."""
    return parallel_coordinates(shown.designs, ax)


def front_winners(shown: ShownDecision, ax: Axes) -> Axes:
    """The first two objectives of the front: what the bands keep, each rule's winner, the design in the sliders."""
    first, objectives = new(ax), shown.front.study.minimise[:2]
    kept, selected = shown.designs.kept, shown.designs.selected
    columns = [m.sign * f / factor(m.unit) for m, f in zip(objectives, shown.front.f.T, strict=False)]
    x, y = columns if len(columns) == 2 else (*columns, np.zeros(len(shown.front)))
    dots: Any = {"linestyle": "none", "marker": "o", "markersize": 5.5}
    line(ax, "left out", x[~kept], y[~kept], color=PALE, zorder=1.5, **dots)
    line(ax, "kept", x[kept], y[kept], color=BLUE, alpha=0.7, zorder=2, **dots)
    at = slice(0, 0) if selected is None else slice(selected, selected + 1)
    line(ax, "in the sliders", x[at], y[at], linestyle="none", marker="o", markersize=9, color=INK, zorder=3)
    for rule, style in MARKS.items():
        i = shown.winners[rule]
        hollow: Any = {"linestyle": "none", "markerfacecolor": "none", "markeredgewidth": 2.4, "zorder": 4}
        mark = line(ax, rule, x[i : i + 1], y[i : i + 1], markeredgecolor=INK, label=rule, **hollow, **style)
        mark.set_markeredgecolor(shown.colours[i])
    if first:
        ax.set_title("Winners on the front", pad=44)
        ax.margins(0.08)
        ax.locator_params(nbins=5)
        ax.set_xlabel(plain(_wrapped(objectives[0].label, 34)))
        ax.set_ylabel(plain(_wrapped(objectives[1].label, 30)) if len(objectives) == 2 else "")
        ax.tick_params(left=len(objectives) == 2, labelleft=len(objectives) == 2)
        place: Any = {"loc": "lower left", "bbox_to_anchor": (-0.04, 0.99), "ncols": 2, "borderaxespad": 0.2}
        legend = ax.legend(handles=[_plain_mark(ax, rule) for rule in MARKS], columnspacing=1.0, **place)
        legend.set_in_layout(True)
    return ax


def _plain_mark(ax: Axes, rule: str) -> Any:
    """A rule's mark for the legend, where it has no design's colour."""
    size = 0.62 * MARKS[rule]["markersize"]
    (mark,) = ax.plot(
        [], [], linestyle="none", marker=MARKS[rule]["marker"], markersize=size, markerfacecolor="none",
        markeredgecolor=INK, markeredgewidth=1.5, label=rule,
    )  # fmt: skip
    return mark


def _wrapped(words: str, width: int) -> str:
    return fill(" ".join(words.split()), width, break_long_words=False)


# ---------------------------------------------------------------- who wins at which weights

NUMBERS, LARGE = 8, 0.025
"""So many designs at most have their number written on a map, if they win at this share of all weightings."""
BAR = 0.32
"""Half of a bar's height, where bars are 1 apart."""


def winners_by_weight(shown: ShownDecision, ax: Axes) -> Axes:
    """The winner at every weighting: a line for two objectives, triangles for three, shares of all for any other."""
    if new(ax):
        ax.set_title("Who wins at which weights", pad=12)
    views = {2: _weight_lines, 3: _weight_triangles}
    views.get(len(shown.front.study.minimise), _weight_shares)(shown, ax)
    return ax


def _slots(shown: ShownDecision, winners: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """A colour and which of ``winners`` have it, for every winner of now and for the others."""
    now = [*shown.colours, *[-1] * len(WINNER_COLOURS)][: len(WINNER_COLOURS)]
    slots = [(colour, winners == design) for colour, design in zip(WINNER_COLOURS, now, strict=True)]
    others = ~np.isin(winners, now)
    return slots + [(grey, others & (winners % len(OTHERS) == i)) for i, grey in enumerate(OTHERS)]


def _largest(chart: WinnerMap) -> list[tuple[str, np.ndarray]]:
    """Number and weightings of the designs that win most, for `NUMBERS` texts, which may be empty."""
    large = [design for design, share in chart.shares.items() if share > LARGE][:NUMBERS]
    told = [(str(design), chart.winners == design) for design in large]
    return [*told, *[("", chart.winners >= 0)] * NUMBERS][:NUMBERS]


def _joined(pieces: np.ndarray) -> np.ndarray:
    """Polygons ``(n, corners, 2)`` as one outline with ``nan`` between them, ``(2, m)``."""
    if not len(pieces):
        return np.full((2, 1), np.nan)
    parted = np.concatenate([pieces, np.full((len(pieces), 1, 2), np.nan)], axis=1)
    return np.asarray(parted.reshape(-1, 2)[:-1].T)


def _weight_lines(shown: ShownDecision, ax: Axes) -> None:
    """For each rule the winners from all weight on the second objective to all on the first."""
    first = new(ax)
    for row, (rule, chart) in enumerate(shown.maps.items()):
        share = 100 * chart.weights[:, 0]
        half = 0.5 * (share[1] - share[0])
        for i, (colour, where) in enumerate(_slots(shown, chart.winners)):
            bars = _bars(share, half, where, -row - BAR, BAR - row)
            area(ax, f"{rule} {i}", bars, facecolor=colour, edgecolor="white", linewidth=0.6)
        for i, (name, where) in enumerate(_largest(chart)):
            at = np.mean([share[k] for k in max(_runs(where), key=lambda run: run[1] - run[0])])
            text(ax, f"{rule} number {i}", float(at), -row, name, ha="center", va="center", color=INK, zorder=3)
    now = 100 * shown.weights[0]
    line(ax, "now", [now, now], [0.45, 0.55 - len(shown.maps)], color=INK, linewidth=2.2)
    text(ax, "now told", now, 0.5, "now", ha="center", va="bottom", color=INK)
    if first:
        ax.set(xlim=(0, 100), ylim=(0.4 - len(shown.maps), 0.75))
        ax.set_yticks([-i for i in range(len(shown.maps))], list(shown.maps))
        label = f"weight of the {shown.names[0]}  [%]; the rest is that of the {shown.names[1]}"
        ax.set_xlabel(plain(_wrapped(label, 90)))
        ax.grid(visible=False)


def _bars(share: np.ndarray, half: float, where: np.ndarray, bottom: float, top: float) -> np.ndarray:
    """An upright rectangle over each run of shares, as one outline."""
    ends = [(share[a] - half, share[b] + half) for a, b in _runs(where)]
    return _joined(np.array([[(x0, bottom), (x1, bottom), (x1, top), (x0, top)] for x0, x1 in ends]))


def _runs(where: np.ndarray) -> list[tuple[int, int]]:
    """First and last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(int)))
    return [(int(a), int(b) - 1) for a, b in edges.reshape(-1, 2)]


CORNERS = np.array([[0.5, np.sqrt(3) / 2], [0.0, 0.0], [1.0, 0.0]])
"""Where all weight is on the first, second, third objective."""
APART = 1.62
"""From one triangle to the next."""


def triangle(weights: Any) -> np.ndarray:
    """Where weights ``(..., 3)`` lie in the triangle, ``(..., 2)``."""
    return np.asarray(np.asarray(weights, dtype=float) @ CORNERS)


def _weight_triangles(shown: ShownDecision, ax: Axes) -> None:
    """For each rule a triangle, one objective at each corner: the nearer, the more it weighs."""
    first = new(ax)
    for k, (rule, chart) in enumerate(shown.maps.items()):
        away = np.array([k * APART, 0.0])
        inside = _clip(away)
        step = 1 / (np.sqrt(8 * len(chart.weights) + 1) - 3) * 2
        turns = np.deg2rad(np.arange(30, 390, 60))
        cell = step / np.sqrt(3) * np.column_stack([np.cos(turns), np.sin(turns)])
        points = triangle(chart.weights) + away
        for i, (colour, where) in enumerate(_slots(shown, chart.winners)):
            cells = points[where][:, None] + cell
            region = area(ax, f"{rule} {i}", _joined(cells), facecolor=colour, edgecolor=colour, linewidth=0.7)
            region.set_clip_path(inside, ax.transData)
        for i, (name, where) in enumerate(_largest(chart)):
            x, y = _inside(points[where])
            style: Any = {"ha": "center", "va": "center", "fontsize": 9.5, "zorder": 3}
            text(ax, f"{rule} number {i}", x, y, name, color=INK, **style)
        line(ax, f"{rule} edge", *(np.vstack([CORNERS, CORNERS[:1]]) + away).T, color=INK, linewidth=1.4)
        x, y = triangle(shown.weights) + away
        line(ax, f"{rule} now", [x], [y], linestyle="none", marker="o", markersize=10, markerfacecolor="white",
             markeredgecolor=INK, markeredgewidth=2.2)  # fmt: skip
        text(ax, f"{rule} name", 0.5 + away[0], -0.3, f"by {rule}", ha="center", va="top", color=INK, fontsize=11.5)
        for name, (x, y), (ha, va, dy) in zip(shown.names, CORNERS + away, _AT_CORNERS, strict=True):
            words = _wrapped(name, 20)
            text(ax, f"{rule} {name}", x, y + dy, words, ha=ha, va=va, color=INK, fontsize=9.5)
    if first:
        ax.set(xlim=(-0.36, 1.36 + APART * (len(shown.maps) - 1)), ylim=(-0.42, 1.1))
        ax.set_aspect("equal")
        ax.set_axis_off()


_AT_CORNERS = (("center", "bottom", 0.05), ("center", "top", -0.05), ("center", "top", -0.05))


def _clip(away: np.ndarray) -> Path:
    """A triangle's outline."""
    return Path(np.vstack([CORNERS, CORNERS[:1]]) + away)


def _inside(points: np.ndarray) -> np.ndarray:
    """The point of a region nearest its middle."""
    away = np.linalg.norm(points - points.mean(axis=0), axis=1)
    return np.asarray(points[np.argmin(away)])


MOST_SHARES = 8


def _weight_shares(shown: ShownDecision, ax: Axes) -> None:
    """For each rule the designs that win at the largest shares of all weightings."""
    first = new(ax)
    rows = len(shown.maps) * (MOST_SHARES + 1)
    for k, (rule, chart) in enumerate(shown.maps.items()):
        top = -k * (MOST_SHARES + 1.0)
        shares = [*list(chart.shares.items())[:MOST_SHARES], *[(-1, 0.0)] * MOST_SHARES][:MOST_SHARES]
        text(ax, f"{rule} name", 0, top, f"by {rule}", va="center", color=INK, fontweight="bold")
        for i, (design, share) in enumerate(shares):
            y, percent = top - 1 - i, 100 * share
            bar = line(ax, f"{rule} {i}", [0, percent], [y, y], linewidth=9, solid_capstyle="butt", color=GREY)
            bar.set_color(shown.colours.get(design, OTHERS[1]))
            told = f"design {design}: {percent:.0f} %" if share else ""
            text(ax, f"{rule} {i} design", percent + 1, y, told, va="center", color=INK, fontsize=9.5)
    if first:
        ax.set(xlim=(0, 118), ylim=(0.5 - rows, 0.7), xlabel="share of all weightings  [%]")
        ax.set_yticks([])
        ax.set_xticks(range(0, 101, 20))
        ax.grid(visible=False)


# ---------------------------------------------------------------- how far a judgement may move

PITCH = 1.0
"""Room for the names above the bars of a judgement, where bars are 1 apart."""
SAID = (1 / 9, 1 / 5, 1 / 3, 1, 3, 5, 9)


def judgement_bars(shown: ShownDecision, ax: Axes) -> Axes:
    """How far each judgement may move before another design wins, and which one wins then."""
    first = new(ax)
    rules = list(shown.ranges)
    count = len(shown.ranges[rules[0]])
    for p in range(count):
        for r, rule in enumerate(rules):
            _judgement_bar(shown, ax, rule, shown.ranges[rule][p], -p * (len(rules) + PITCH) - r, p)
    if first:
        ax.set_title("How far each judgement may move", pad=12)
        ax.set_xscale("log")
        ax.set(xlim=(1 / 26, 26), ylim=(0.4 - max(count, 1) * (len(rules) + PITCH), 1.1))
        ax.set_xticks(SAID, ["1/9", "1/5", "1/3", "1", "3", "5", "9"])
        ax.minorticks_off()
        ax.set_yticks([])
        ax.set_xlabel("how many times the first matters\nmore than the second" if count else "")
        if not count:
            told = "one objective: there is nothing to judge"
            text(ax, "nothing", 0.5, 0.5, told, transform=ax.transAxes, ha="center", color=GREY)
    return ax


def _judgement_bar(shown: ShownDecision, ax: Axes, rule: str, told: Any, y: float, p: int) -> None:
    key = f"{p} {rule}"
    if rule == next(iter(shown.ranges)):
        words = " : ".join(shown.names[i] for i in told.pair)
        text(ax, f"{p} names", 1, y + 0.42, words, ha="center", va="bottom", color=INK, fontsize=9.5)
    line(ax, f"{key} scale", [1 / 9, 9], [y, y], color=PALE, linewidth=9, solid_capstyle="butt", zorder=1.5)
    bar = line(ax, key, [told.low, told.high], [y, y], color=BLUE, linewidth=9, solid_capstyle="butt", zorder=2)
    bar.set_color(shown.colours[shown.winners[rule]])
    mark = MARKS[rule]["marker"]
    line(ax, f"{key} now", [told.judged], [y], marker=mark, markersize=7.5, color=INK, linestyle="none", zorder=3)
    ends: Any = {"va": "center", "color": INK, "fontsize": 9.5}
    text(ax, f"{key} below", 1 / 10, y, _next(told.below), ha="right", **ends)
    text(ax, f"{key} above", 10, y, _next(told.above), ha="left", **ends)


def _next(design: int | None) -> str:
    """Who wins beyond the end of a bar."""
    return "stays" if design is None else f"then {design}"
