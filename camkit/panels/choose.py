"""`choose_panel`: which design of a front, by which rule, and how sure that choice is."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Protocol, runtime_checkable

import numpy as np

from ..decision import JudgementRange, Judgements, achievement
from ..files import Decision, to_json
from ..files.decisions import BY_HAND, REFERENCE
from ..quantities import Measure, label
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..render.figure import picture, small_png
from ..search.front import Front
from ..views.decision import (
    MARKS,
    ShownDecision,
    brushed_designs,
    decision,
    front_winners,
    judgement_bars,
    winners_by_weight,
)
from ..views.front import Judged
from ..views.parallel import Designs
from .ahp import AhpPanel
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.front_picker import FrontPanel, costs, objective_texts, place_on
from .kit.inputs import Download, Menu, Span
from .kit.parts import Banner, Button, Group, Table, Words, row
from .kit.quiet import Quiet
from .kit.reference import ReferencePoint
from .kit.sheet import Panel

NO_FRONT = "There is no front to choose from yet: run a search."
HINT = "Drag along an axis to keep a band, click it to drop it; click a line to load it."


@runtime_checkable
class FrontSource(Protocol):
    """A panel with a front, such as `pareto_panel` gives."""

    front: Front
    explorer: Instrument
    importance: AhpPanel | None

    def select(self, index: int | None) -> None:
        """Load a design of the front."""
        ...

    def on_front(self, act: Callable[[], None]) -> None:
        """Call ``act()`` after each new front."""
        ...


class ChoosePanel(Panel):
    """Every rule's winner of a front, where else each wins, and how far the judgements may move.

    ``source`` is a panel with a ``front``, the ``explorer`` that shows its designs, the ``importance`` of its
    objectives (judgements, or ``None``: all count alike), ``select(i)`` to load a design, and ``on_front(act)``.
    ``measures`` are shown beside objectives and free quantities; by default those that have a limit.
    """

    def __init__(self, source: FrontSource, measures: Sequence[Measure] | None = None) -> None:
        refuse_arguments(ChoosePanel.__init__, locals())
        self.source, self.measures = source, measures
        self.shown: ShownDecision | None = None
        self._key: object = None
        self._said: Judgements | None = None
        self._brush_from: tuple[int, float] | None = None
        self._quiet, self._drawing = Quiet(), threading.RLock()  # a search reports from a thread of its own
        self._by = ""
        self.banner, self.numbers, self.verdict, self.count = Banner(), Table(), Words(), Words(role="status")
        self.picture = LivePicture((brushed_designs,), "Designs of the front")
        self.points = LivePicture((front_winners,), "Winners on the front")
        self.map = LivePicture((winners_by_weight, judgement_bars), "Winners by weight")
        self.picture.on_pointer(self.pointed)
        self.map.on_click(self.map_clicked)
        self.reference = ReferencePoint(self.points, partial(self._take, REFERENCE), self._draw)
        self.picture.pixels = self.points.pixels = self.map.pixels = 240
        hint = Words(value=[HINT], look="hint")
        save = Download("Save decision", "decision.json", "application/json", self._json, self.banner.show_message)
        loads = row(Words(value=["load the winner by"]), *map(self._load_button, MARKS), save, hint)
        designs = Group(self.points, self.picture, look="beside")
        sure = Group(self.map, self.verdict, look="room", description="Who wins at which weights")
        self._decided = Group(self.numbers, loads, designs, self.reference.box, self._brush(), sure)
        super().__init__(self.banner, self._decided)
        self.take_up()
        source.on_front(self.take_up)
        source.explorer.on_change(lambda _: self._select())
        if source.importance:
            source.importance.on_change(self.take_up)
        source.explorer.add_tab("Decision", self)

    def _brush(self) -> Group:
        """What narrows the front down to a band, with the keys too."""
        self.axis, self.band = Menu([], "keep of the"), Span()
        self._quiet.hear(self.axis, lambda _: self._show_band())
        self._quiet.hear(self.band, lambda band: self.keep(self.axis.value, band))
        clear = Button("Keep all", lambda: self._brush_with({}), tooltip="drop every band")
        return row(self.count, self.axis, self.band, clear)

    def _load_button(self, rule: str) -> Button:
        return Button(rule, lambda: self._take(rule, self.shown.winners[rule]) if self.shown else None)

    def _take(self, rule: str, design: int) -> None:
        """Load what a rule chooses."""
        self._by = rule
        self.source.select(design)

    def take_up(self) -> None:
        """Show the source's front and the judgements as they are now."""
        with self._drawing, self.held():
            front = self.source.front
            self._decided.visible = bool(len(front))
            self.banner.show_message("" if len(front) else f"{NO_FRONT} {front.message}".strip())
            if not len(front):
                self.shown = None
                return
            key, said = _numbers_of(front), self._judgements(front)
            if self.shown is None or key != self._key:
                self._keep_bands(decision(front, said, self.measures))
            elif said != self._said:
                self.shown = self.shown.judged(said)
            else:
                return
            self._key, self._said = key, said
            self.reference.show(front)
            self._show()

    def _judgements(self, front: Judged) -> Judgements | None:
        """The judgements of the front's objectives."""
        panel = self.source.importance
        return panel.judgements if panel and len(panel.names) == len(front.study.minimise) else None

    def _keep_bands(self, fresh: ShownDecision) -> None:
        """Take up another decision; bands stay if it has the same columns."""
        columns = fresh.designs.columns
        bands = self.designs.bands if self.shown and self.designs.columns == columns else {}
        self.shown = replace(fresh, designs=replace(fresh.designs, bands=bands, selected=self._selected(fresh)))
        named = [(column.name, j) for j, column in enumerate(columns)]
        if list(self.axis.options) != named:
            with self._quiet:
                self.axis.offer(named, 0)

    def _selected(self, shown: ShownDecision) -> int | None:
        """The front's design that is in the sliders, if one is."""
        return place_on(shown.front, self.source.explorer.design)

    def _select(self) -> None:
        """Mark the design in the sliders, if that changes anything."""
        with self._drawing, self.held():
            if self.shown and (selected := self._selected(self.shown)) != self.shown.designs.selected:
                self.shown = replace(self.shown, designs=replace(self.shown.designs, selected=selected))
                self._draw()

    def _draw(self) -> None:
        """The designs, as they are kept and marked."""
        assert self.shown
        shown = replace(self.shown, reference=self.reference.point)
        for each in (self.picture, self.points):
            each.show(shown)

    def _show(self) -> None:
        assert self.shown
        self._draw()
        self.map.show(self.shown)
        self.numbers.put(*self._table())
        self.verdict.say(*self.sureness, *costs(self.source.front, dict.fromkeys(self.shown.winners.values())))
        self._show_band()

    # ------------------------------------------------------------ the decision

    def decide(self) -> Decision:
        """The decision for the design in the sliders, as it stands now.

        Its rule is the one by which it was loaded, another one that takes it, or none: chosen by hand.

        Raises ``ValueError`` where the design is none of the front's.
        """
        if self.shown is None or self.designs.selected is None:
            raise ValueError("the design in the sliders is none of the front's; load one of these")
        panel, front, wish = self.source.importance, self.source.front, self.reference.wished
        judged = panel.given if panel and self._judgements(front) else None
        wished = {} if wish is None else {REFERENCE: achievement(front, wish)}
        winners = {**self.shown.winners, **wished}
        rules = [rule for rule in (self._by, *MARKS, REFERENCE) if winners.get(rule) == self.designs.selected]
        return Decision(front, self.designs.selected, rules[0] if rules else BY_HAND, judged, wish)

    def _json(self) -> str:
        decision = self.decide()
        if isinstance(self.source, FrontPanel):
            self.source.decision = decision
        return to_json(decision)

    # ------------------------------------------------------------ bands

    @property
    def designs(self) -> Designs:
        """The front's designs as the parallel coordinates show them."""
        assert self.shown
        return self.shown.designs

    def _brush_with(self, bands: dict[int, tuple[float, float]]) -> None:
        with self._drawing, self.held():
            if self.shown:
                self.shown = replace(self.shown, designs=replace(self.designs, bands=bands))
                self._draw()
                self._show_band()

    def keep(self, column: int, band: tuple[float, float]) -> None:
        """Keep what is inside ``band`` (in the column's unit); the whole column: no band."""
        low, high = self.designs.ends[:, column]
        whole = band[0] <= low and band[1] >= high
        others = {j: b for j, b in self.designs.bands.items() if j != column}
        self._brush_with(others if whole else {**others, column: (float(band[0]), float(band[1]))})

    def _show_band(self) -> None:
        """Slider and count say what the bands keep."""
        designs, j = self.designs, self.axis.value
        low, high = map(float, designs.ends[:, j])
        column = designs.columns[j]
        with self._quiet, self.held(), self.band.hold_trait_notifications():
            self.band.description, self.band.unit = column.name, column.unit
            self.band.min, self.band.max, self.band.disabled = low, high, high <= low
            self.band.value = designs.bands.get(j, (low, high))
        self.count.say(f"{designs.kept.sum()} of {len(designs.kept)} designs kept")

    def pointed(self, view: int, kind: str, at: Array, pixel: Array) -> None:
        """Drag a band, drop it or load a design."""
        if view or not self.shown:
            return
        across, height = map(float, at)
        column = int(np.clip(round(across), 0, len(self.designs.columns) - 1))
        inside = -0.45 < across < len(self.designs.columns) - 0.55 and -0.15 < height < 1.2
        if kind == "press":
            near = inside and abs(across - column) < 0.3
            self._brush_from = (column, self.designs.value(column, height)) if near else None
        elif kind == "drag" and self._brush_from:
            held, start = self._brush_from
            low, high = sorted((start, self.designs.value(held, height)))
            self.keep(held, (low, high))
        elif kind == "click" and inside:
            self._click(column, across, height)

    def _click(self, column: int, at: float, height: float) -> None:
        low, high = self.designs.bands.get(column, (np.inf, -np.inf))
        if abs(at - column) < 0.15 and low <= self.designs.value(column, height) <= high:
            self._brush_with({j: b for j, b in self.designs.bands.items() if j != column})
        elif (design := self.designs.nearest(at, height)) is not None:
            self.source.select(design)

    def map_clicked(self, view: int, at: Array, pixel: Array) -> None:
        """Load the winner at the weights under the pointer."""
        design = self.shown.winner_at(*map(float, at)) if self.shown and view == 0 else None
        if design is not None:
            self.source.select(design)

    # ------------------------------------------------------------ words

    def _table(self) -> tuple[Sequence[object], list[Sequence[object]]]:
        """The winners side by side: the head and the rows."""
        assert self.shown
        front = self.shown.front
        declared = front.study.declared
        goals, free = front.study.minimise, front.study.free
        names = [*(m.name for m in goals), *(label(n, declared[n]) for n in free)]
        head = ("winner by", "design", *names, "share of all weightings won")
        rows: list[Sequence[object]] = []
        for rule, i in self.shown.winners.items():
            values = [m.text(m.sign * f) for m, f in zip(goals, front.f[i], strict=True)]
            values += [declared[n].text(x) for n, x in zip(free, front.x[i], strict=True)]
            share = f"{100 * self.shown.maps[rule].shares.get(i, 0):.0f} %" if rule in self.shown.maps else "all"
            rows.append(({"words": rule, "series": self.shown.index[i]}, i, *values, share))
        return head, rows

    @property
    def sureness(self) -> list[str]:
        """How far each judgement may move before the winner changes, a sentence for each rule."""
        if not self.shown:
            return []
        return [
            f"The winner by {rule} (design {self.shown.winners[rule]}) stays while one judgement moves alone: "
            f"{'; '.join(self._range_text(told) for told in ranges)}."
            for rule, ranges in self.shown.ranges.items()
            if ranges
        ]

    def _range_text(self, told: JudgementRange) -> str:
        assert self.shown
        first, second = (self.shown.names[i] for i in told.pair)
        return f"{first} against {second} from {told.low:.3g} to {told.high:.3g} (now {told.judged:.3g})"

    def summary(self) -> str:
        """The winners and how sure they are."""
        if not self.shown:
            return NO_FRONT
        return "\n".join([*(f"{rule}: {self._told(i)}" for rule, i in self.shown.winners.items()), *self.sureness])

    def _told(self, design: int) -> str:
        """A design's objectives."""
        assert self.shown
        front = self.shown.front
        return f"design {design}, {', '.join(objective_texts(front.study, front.f[design]))}"

    def drawing(self) -> Callable[[], bytes]:
        """What draws all four views, two below two; without a front there is nothing to see."""
        rows = (brushed_designs, front_winners), (winners_by_weight, judgement_bars)
        shown = self.shown
        return lambda: small_png(*(picture(shown, *views, width=12.6, height=4.5) for views in rows if shown))


def _numbers_of(front: Judged) -> tuple[object, ...]:
    """What tells one front from another."""
    return front.study.minimise, tuple(front.study.free), front.x.tobytes(), front.f.tobytes()


def choose_panel(source: FrontSource, measures: Sequence[Measure] | None = None) -> ChoosePanel:
    """The winners of ``source``'s front side by side, how sure they are, and bands to narrow it down.

    ``source`` is a panel with a front, such as `pareto_panel` gives; the sheet is a tab of its instrument, too.
    """
    return ChoosePanel(source, measures)
