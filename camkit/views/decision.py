"""Views of a choice from a front: who wins by which rule, at which weights, and for how long."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..decision import CHOOSERS, WEIGHING, JudgementRange, Judgements, WinnerMap, judgement_ranges, winner_map
from ..quantities import Measure, label
from ..study.options import measured
from ..units import factor
from .front import Judged, wished
from .parallel import Column, Designs, parallel_coordinates
from .picture import Axes, Line, Mark, MarkStyle, Picture, Points, Polygon, Text, in_lines, joined

MARKS = {
    "weighted sum": ("star", 20),
    "TOPSIS": ("diamond", 11),
    "knee": ("triangle", 13),
    "crowding distance": ("square", 14),
}
"""The mark of each rule's winner, and its size."""
OTHERS = (0.18, 0.30, 0.42)
"""How strong the greys are of designs that win somewhere, but not now."""


@dataclass(frozen=True)
class ShownDecision:
    """A front and what follows from the judgements of its objectives; designs are named by their place on it."""

    front: Judged
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
    reference: Sequence[float] | None = None
    """Objectives that a person wishes, ``(k,)``."""

    def judged(self, judgements: Judgements | None = None) -> ShownDecision:
        """The same front under other judgements of its objectives; ``None``: all alike."""
        k = self.front.f.shape[1]
        judgements = Judgements(self.names, np.ones((k, k))) if judgements is None else judgements
        weights = judgements.weights
        winners = {rule: CHOOSERS[rule](self.front, weights) for rule in MARKS}
        ranges = {rule: judgement_ranges(self.front, judgements, CHOOSERS[rule]) for rule in WEIGHING}
        index = {design: i for i, design in enumerate(dict.fromkeys(winners.values()), start=1)}
        designs = replace(self.designs, marked=index)
        return replace(self, designs=designs, winners=winners, weights=weights, ranges=ranges)

    @property
    def index(self) -> Mapping[int, int]:
        """The place in the series of each design that wins now."""
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
    front: Judged, judgements: Judgements | None = None, measures: Sequence[Measure] | None = None
) -> ShownDecision:
    """A front that is not empty, and what follows from judgements of its objectives (``None``: all count alike).

    ``measures`` are shown beside objectives and free quantities; by default those that have a limit.
    """
    columns, values = _numbers(front, measures)
    maps = {rule: winner_map(front, CHOOSERS[rule]) for rule in WEIGHING}
    weights = np.zeros(front.f.shape[1])
    shown = ShownDecision(front, Designs(columns, values), {}, weights, maps, {})
    return shown.judged(judgements)


def _numbers(front: Judged, measures: Sequence[Measure] | None) -> tuple[tuple[Column, ...], np.ndarray]:
    """Every number of the front's designs that is shown, in its unit, ``(p, n)``."""
    study = front.study
    goals = [(Column(m.name, m.unit, m.sign), m.sign * f) for m, f in zip(study.minimise, front.f.T, strict=True)]
    free = [(Column(label(n, q), q.unit), x) for (n, q), x in zip(study.declared.items(), front.x.T, strict=True)]
    limited = {m: sense for m, _, sense in study.limits}
    further = [
        m for m in (limited if measures is None else measures) if m not in study.minimise and -m not in study.minimise
    ]
    values = measured(study, further, front.x).T
    told = [(Column(m.name, m.unit, limited.get(m, 0)), v) for m, v in zip(further, values, strict=True)]
    shown = [*goals, *free, *told]
    return tuple(c for c, _ in shown), np.column_stack([v / factor(c.unit) for c, v in shown])


def brushed_designs(shown: ShownDecision) -> Picture:
    """The front's designs in parallel coordinates."""
    return parallel_coordinates(shown.designs)


def front_winners(shown: ShownDecision) -> Picture:
    """The first two objectives of the front: what the bands keep, each rule's winner, the design in the sliders."""
    objectives, kept = shown.front.study.minimise[:2], shown.designs.kept
    columns = [m.sign * f / factor(m.unit) for m, f in zip(objectives, shown.front.f.T, strict=False)]
    x, y = [*columns, np.zeros(len(shown.front))][:2]
    labels = [_wrapped(m.label, 34) for m in objectives]
    at = [] if shown.designs.selected is None else [shown.designs.selected]
    yticks: dict[float, str] | None = {} if len(objectives) == 1 else None
    return Picture.of(
        Axes(title="Winners on the front", xlabel=labels[0], ylabel=[*labels, ""][1], yticks=yticks),
        Points("left out", x[~kept], y[~kept], role="ghost", size=5.5, opacity=0.5),
        Points("kept", x[kept], y[kept], role="position", size=5.5, opacity=0.7),
        Points("in the sliders", x[at], y[at], size=9),
        [
            Points(
                rule,
                x[[i]],
                y[[i]],
                role="series",
                index=shown.index[i],
                mark=MARKS[rule][0],
                size=MARKS[rule][1],
                fill="none",
                label=rule,
            )
            for rule, i in shown.winners.items()
        ],
        wished(shown.front, shown.reference),
    )


def _wrapped(words: str, width: int) -> str:
    return in_lines(words, width, 3)


# ---------------------------------------------------------------- who wins at which weights

NUMBERS, LARGE = 8, 0.025
"""So many designs at most have their number written on a map, if they win at this share of all weightings."""
BAR = 0.32
"""Half of a bar's height, where bars are 1 apart."""
TITLE = "Who wins at which weights"


def winners_by_weight(shown: ShownDecision) -> Picture:
    """The winner at every weighting: a line for two objectives, triangles for three, shares of all for any other."""
    views = {2: _weight_lines, 3: _weight_triangles}
    return views.get(len(shown.front.study.minimise), _weight_shares)(shown)


def _bar(key: str, low: ArrayLike, high: ArrayLike, y: ArrayLike, half: float, **style: Unpack[MarkStyle]) -> Polygon:
    """An upright rectangle over each stretch from ``low`` to ``high``."""
    low, high, y = np.broadcast_arrays(np.atleast_1d(low), high, y)
    x, heights = np.stack([low, high, high, low], axis=-1), np.stack([y - half, y - half, y + half, y + half], axis=-1)
    return Polygon(key, *joined(np.stack([x, heights], axis=-1)), **style)


def _look(shown: ShownDecision, design: int) -> MarkStyle:
    """The colour of a winner of now, or one of the greys."""
    if design in shown.index:
        return {"role": "series", "index": shown.index[design]}
    return {"role": "guide", "opacity": OTHERS[design % len(OTHERS)]}


def _number(shown: ShownDecision, key: str, x: float, y: float, design: int) -> Text:
    """The number of a design on its colour."""
    return Text(f"{key} number {design}", x, y, str(design), role="onto" if design in shown.index else "ink", size=9.5)


def _largest(chart: WinnerMap) -> list[int]:
    """The designs that win most."""
    return [design for design, share in chart.shares.items() if share > LARGE][:NUMBERS]


def _weight_lines(shown: ShownDecision) -> Picture:
    """For each rule the winners from all weight on the second objective to all on the first."""
    marks: list[Mark] = []
    for row, (rule, chart) in enumerate(shown.maps.items()):
        share = 100 * chart.weights[:, 0]
        half = 0.5 * (share[1] - share[0])
        for design in chart.shares:
            first, last = _runs(chart.winners == design).T
            low, high = share[first] - half, share[last] + half
            marks.append(_bar(f"{rule} {design}", low, high, -row, BAR, **_look(shown, design)))
            if design in _largest(chart):
                at = np.argmax(high - low)
                marks.append(_number(shown, rule, (low[at] + high[at]) / 2, -row, design))
    now = 100 * shown.weights[0]
    label = f"weight of the {shown.names[0]}  [%]; the rest is that of the {shown.names[1]}"
    axes = Axes(
        title=TITLE,
        xlabel=_wrapped(label, 90),
        xlim=(0, 100),
        ylim=(0.4 - len(shown.maps), 0.75),
        yticks={-i: rule for i, rule in enumerate(shown.maps)},
        grid=False,
    )
    marks.append(Line("now", [now, now], [0.45, 0.55 - len(shown.maps)], stroke="line"))
    return Picture.of(axes, marks, Text("now told", now, 0.5, "now", anchor="bottom"))


def _runs(where: np.ndarray) -> np.ndarray:
    """First and last index of each run of true values, ``(k, 2)``."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(int)))
    return edges.reshape(-1, 2) - [0, 1]


CORNERS = np.array([[0.5, np.sqrt(3) / 2], [0.0, 0.0], [1.0, 0.0]])
"""Where all weight is on the first, second, third objective."""
APART = 1.75
"""From one triangle to the next."""
ANCHORS = (("bottom", 0.05), ("top", -0.05), ("top", -0.05))
"""Where the names of the corners stand."""


def triangle(weights: object) -> np.ndarray:
    """Where weights ``(..., 3)`` lie in the triangle, ``(..., 2)``."""
    return np.asarray(np.asarray(weights, dtype=float) @ CORNERS)


def _weight_triangles(shown: ShownDecision) -> Picture:
    """For each rule a triangle, one objective at each corner: the nearer, the more it weighs."""
    marks: list[Mark] = []
    for k, (rule, chart) in enumerate(shown.maps.items()):
        away = np.array([k * APART, 0.0])
        marks += _cells(shown, rule, chart, away)
        marks.append(Line(f"{rule} edge", *(_closed(CORNERS) + away).T))
        x, y = triangle(shown.weights) + away
        marks.append(Points(f"{rule} now", x, y, size=10, fill="paper"))
        marks.append(Text(f"{rule} name", 0.5 + away[0], -0.36, f"by {rule}", anchor="top", size=11.5))
        for name, (x, y), (anchor, shift) in zip(shown.names, CORNERS + away, ANCHORS, strict=True):
            marks.append(Text(f"{rule} {name}", x, y + shift, _wrapped(name, 15), anchor=anchor, size=9.5))
    width = (-0.36, 1.36 + APART * (len(shown.maps) - 1))
    return Picture.of(Axes(title=TITLE, equal=True, bare=True, xlim=width, ylim=(-0.5, 1.22)), marks)


def _cells(shown: ShownDecision, rule: str, chart: WinnerMap, away: np.ndarray) -> list[Mark]:
    """Each weighting in its winner's colour, row by row, what is outside the triangle hidden, and numbers."""
    marks: list[Mark] = []
    step = 1 / (np.sqrt(8 * len(chart.weights) + 1) - 3) * 2
    points = triangle(chart.weights) + away
    order = np.lexsort((chart.weights[:, 2], chart.weights[:, 0]))  # upwards, and each row from left to right
    (x, y), winners = points[order].T, chart.winners[order]
    begins = np.r_[True, (np.diff(winners) != 0) | (np.diff(chart.weights[order, 0]) > 0)]
    first, last = np.flatnonzero(begins), np.flatnonzero(np.r_[begins[1:], True])
    for design in chart.shares:
        mine = winners[first] == design
        low, high = x[first[mine]] - step / 2, x[last[mine]] + step / 2
        marks.append(_bar(f"{rule} {design}", low, high, y[first[mine]], step * np.sqrt(3) / 4, **_look(shown, design)))
    middle = CORNERS.mean(axis=0)
    outside = middle + (1 + 4 * step) * (CORNERS - middle)
    rim = np.concatenate([_closed(outside), [[np.nan, np.nan]], _closed(CORNERS)[::-1]]) + away
    marks.append(Polygon(f"{rule} rim", *rim.T, role="paper"))
    for design in _largest(chart):
        x, y = _inside(points[chart.winners == design])
        marks.append(_number(shown, rule, x, y, design))
    return marks


def _closed(corners: np.ndarray) -> np.ndarray:
    return np.vstack([corners, corners[:1]])


def _inside(points: np.ndarray) -> np.ndarray:
    """The point of a region nearest its middle."""
    away = np.linalg.norm(points - points.mean(axis=0), axis=1)
    return np.asarray(points[np.argmin(away)])


MOST_SHARES = 8


def _weight_shares(shown: ShownDecision) -> Picture:
    """For each rule the designs that win at the largest shares of all weightings."""
    rows = MOST_SHARES + 1
    marks: list[Mark] = []
    for k, (rule, chart) in enumerate(shown.maps.items()):
        marks.append(Text(f"{rule} name", 0, -k * rows, f"by {rule}", anchor="left", bold=True))
        for i, (design, share) in enumerate([*chart.shares.items()][:MOST_SHARES], start=1):
            y, percent = -k * rows - i, 100 * share
            marks.append(_bar(f"{rule} {design}", 0, percent, y, BAR, **_look(shown, design)))
            told = f"design {design}: {percent:.0f} %"
            marks.append(Text(f"{rule} {design} share", percent + 1, y, told, anchor="left", size=9.5))
    axes = Axes(
        title=TITLE,
        xlabel="share of all weightings won  [%]",
        xlim=(0, 118),
        ylim=(0.5 - rows * len(shown.maps), 0.7),
        xticks={float(x): f"{x}" for x in range(0, 101, 20)},
        yticks={},
        grid=False,
    )
    return Picture.of(axes, marks)


# ---------------------------------------------------------------- how far a judgement may move

PITCH = 1.0
"""Room for the names above the bars of a judgement, where bars are 1 apart."""
LINE = 0.75
"""Room for each further line of names."""
RATIOS = {1 / 9: "1/9", 1 / 5: "1/5", 1 / 3: "1/3", 1: "1", 3: "3", 5: "5", 9: "9"}


def judgement_bars(shown: ShownDecision) -> Picture:
    """How far each judgement may move before another design wins, and which one wins then."""
    pairs = next(iter(shown.ranges.values()))
    names = [_wrapped(" : ".join(shown.names[i] for i in told.pair), 64) for told in pairs]
    more = LINE * max((each.count("\n") for each in names), default=0)
    step = len(shown.ranges) + PITCH + more
    marks: list[Mark] = [
        Text(f"{p} names", 1, 0.42 - p * step, each, anchor="bottom", size=9.5) for p, each in enumerate(names)
    ]
    for r, (rule, ranges) in enumerate(shown.ranges.items()):
        for p, told in enumerate(ranges):
            marks += _judgement_bar(f"{p} {rule}", shown, rule, told, -p * step - r)
    if not pairs:
        marks.append(Text("nothing", 1, 0.7 - step / 2, "one objective: there is nothing to judge", role="guide"))
    axes = Axes(
        title="How far each judgement may move",
        xlabel="how many times the first matters\nmore than the second" if pairs else "",
        log="x",
        xlim=(1 / 70, 70),
        ylim=(0.4 - max(len(pairs), 1) * step, 1.1 + more),
        xticks=RATIOS,
        yticks={},
    )
    return Picture.of(axes, marks)


def _judgement_bar(key: str, shown: ShownDecision, rule: str, told: JudgementRange, y: float) -> list[Mark]:
    ends = told.below, told.above
    below, above = ("stays" if design is None else f"next: design {design}" for design in ends)
    return [
        _bar(f"{key} scale", 1 / 9, 9, y, BAR / 2, role="body"),
        _bar(key, told.low, told.high, y, BAR / 2, **_look(shown, shown.winners[rule])),
        Points(f"{key} now", told.judged, y, role="onto", mark=MARKS[rule][0], size=7.5),
        Text(f"{key} below", 1 / 10, y, below, anchor="right", size=9.5),
        Text(f"{key} above", 10, y, above, anchor="left", size=9.5),
    ]
