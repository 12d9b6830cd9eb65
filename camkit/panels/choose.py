"""`choose_panel`: which design of a front, by which rule, and how sure that choice is."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Protocol, runtime_checkable

import ipywidgets as w
import numpy as np

from ..decision import JudgementRange, Judgements
from ..quantities import Measure, label
from ..quantities.kinds import refuse_arguments
from ..quantities.markup import Html, attribute, html, joined, table
from ..render.draw import colour
from ..render.picture import below
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
from .instrument import Instrument
from .kit.banner import Banner
from .kit.controls import bar_html, small_html, tables_html
from .kit.front_picker import objective_texts, place_on
from .kit.layout import button, menu, wrapped
from .kit.panel import Panel
from .kit.picture import LivePicture
from .kit.quiet import Quiet

NO_FRONT = "There is no front to choose from yet: run a search."
HINT = "Drag along an axis to keep a band of it; click into the band to drop it; click a line to load its design."


@runtime_checkable
class FrontSource(Protocol):
    """A panel with a front, such as `pareto_panel` gives."""

    front: Front
    explorer: Instrument
    importance: Any

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
        self._columns: Any = None
        self._said: Judgements | None = None
        self._held: tuple[int, float] | None = None
        self._quiet = Quiet()
        self._drawing = threading.RLock()  # a search reports from a thread of its own
        self.banner, self.numbers, self._verdict, self.count = Banner(), w.HTML(), w.HTML(), w.HTML()
        self._brushed, self._judged = w.Box(), w.Box()
        self._make_pictures()
        self._make_controls()
        children = [self.numbers, self._loads, self._brushed, self._brush, self._judged, self._verdict]
        self._body = w.VBox(children)
        super().__init__([self.banner, self._body])
        self.take_up()
        source.on_front(self.take_up)
        source.explorer.on_change(lambda _: self._select())
        if source.importance:
            source.importance.on_change(self.take_up)

    def _make_controls(self) -> None:
        buttons = [self._load_button(rule) for rule in MARKS]
        self._loads = wrapped(w.HTML("load the winner by"), *buttons)
        self.axis = menu([], "keep of the", "330px")
        self.band = w.FloatRangeSlider(
            readout_format=".4g", continuous_update=True, layout=w.Layout(flex="1 1 260px", max_width="420px")
        )
        self._quiet.hear(self.axis, lambda _: self._show_band())
        self._quiet.hear(self.band, lambda band: self.keep(self.axis.value, band))
        clear = button("Keep all", lambda: self._brush_with({}), "undo", tooltip="drop every band")
        row = wrapped(self.axis, self.band, clear, self.count)
        self._brush = w.VBox([w.HTML(small_html(HINT)), row])

    def _load_button(self, rule: str) -> w.Button:
        return button(rule, lambda: self.source.select(self.shown.winners[rule]) if self.shown else None, "star")

    def take_up(self) -> None:
        """Show the source's front and the judgements as they are now."""
        with self._drawing:
            front = self.source.front
            self._body.layout.display = "" if len(front) else "none"
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
            self._show()

    def _judgements(self, front: Judged) -> Judgements | None:
        """The judgements of the front's objectives."""
        panel = self.source.importance
        fits = panel is not None and len(panel.names) == len(front.study.minimise)
        return panel.judgements if fits else None

    def _keep_bands(self, fresh: ShownDecision) -> None:
        """Take up another decision; bands stay if it has the same columns, pictures if it has the same objectives."""
        same = self.shown is not None and self.shown.designs.columns == fresh.designs.columns
        bands = self.shown.designs.bands if same and self.shown else {}
        self.shown = replace(fresh, designs=replace(fresh.designs, bands=bands, selected=self._selected(fresh)))
        if self._columns not in (None, fresh.designs.columns):  # else there are no others or they are drawn already
            self._make_pictures()
        self._columns = fresh.designs.columns
        if [label for label, _ in self.axis.options] != (labels := [c.name for c in fresh.designs.columns]):
            with self._quiet:
                self.axis.options = [(label, j) for j, label in enumerate(labels)]
                self.axis.index = 0

    def _make_pictures(self) -> None:
        """Figures whose axes are to be named after the columns and objectives of the next decision."""
        old = (*self._brushed.children, *self._judged.children)
        brushed = LivePicture((brushed_designs, front_winners), "Designs of the front", width=12.6, height=4.5)
        judged = LivePicture((winners_by_weight, judgement_bars), "Winners by weight", width=12.6, height=4.4)
        brushed.widget.on_pointer(self.pointed)
        judged.widget.on_click(self.map_clicked)
        brushed.said = self.summary
        self.pictures, self.picture = [brushed, judged], brushed
        self._brushed.children, self._judged.children = (brushed.widget,), (judged.widget,)
        for widget in old:
            widget.close()

    def _selected(self, shown: ShownDecision) -> int | None:
        """The front's design that is in the sliders, if one is."""
        return place_on(shown.front, self.source.explorer.design)

    def _select(self) -> None:
        """Mark the design in the sliders, if that changes anything."""
        with self._drawing:
            if self.shown and (selected := self._selected(self.shown)) != self.shown.designs.selected:
                self.shown = replace(self.shown, designs=replace(self.shown.designs, selected=selected))
                self.pictures[0].show(self.shown)

    def _show(self) -> None:
        assert self.shown
        for picture in self.pictures:
            picture.show(self.shown)
        self.numbers.value = self._table_html()
        self._verdict.value = joined(self.sureness, "<br>")
        self._show_band()

    # ------------------------------------------------------------ bands

    @property
    def designs(self) -> Designs:
        """The front's designs as the parallel coordinates show them."""
        assert self.shown
        return self.shown.designs

    def _brush_with(self, bands: dict[int, tuple[float, float]]) -> None:
        with self._drawing:
            if self.shown:
                self.shown = replace(self.shown, designs=replace(self.designs, bands=bands))
                self.pictures[0].show(self.shown)
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
        with self._quiet, self.band.hold_trait_notifications():
            self.band.min, self.band.max, self.band.step = low, high, (high - low) / 100 or 1.0
            self.band.value = designs.bands.get(j, (low, high))
        self.band.disabled = high <= low
        column = designs.columns[j]
        name = f"{column.name}, {column.unit}" if column.unit else column.name
        count = f"{designs.kept.sum()} of {len(designs.kept)} designs kept"
        self.count.value = html("<span {}>&ensp;{}</span>", attribute("data-name", name), count)

    def pointed(self, kind: str, x: float, y: float) -> None:
        """Drag a band, drop it or load a design."""
        at, height = self.pictures[0].in_data(x, y)
        column = int(np.clip(round(at), 0, len(self.designs.columns) - 1))
        inside = -0.45 < at < len(self.designs.columns) - 0.55 and -0.15 < height < 1.2
        if kind == "press":
            self._held = (column, self.designs.value(column, height)) if inside and abs(at - column) < 0.3 else None
        elif kind == "drag" and self._held:
            held, start = self._held
            self.keep(held, tuple(sorted((start, self.designs.value(held, height)))))  # type: ignore[arg-type]
        elif kind == "click" and inside:
            self._click(column, at, height)

    def _click(self, column: int, at: float, height: float) -> None:
        low, high = self.designs.bands.get(column, (np.inf, -np.inf))
        if abs(at - column) < 0.15 and low <= self.designs.value(column, height) <= high:
            self._brush_with({j: b for j, b in self.designs.bands.items() if j != column})
        elif (design := self.designs.nearest(at, height)) is not None:
            self.source.select(design)

    def map_clicked(self, x: float, y: float) -> None:
        """Load the winner at the weights under the pointer."""
        assert self.shown
        design = self.shown.winner_at(*self.pictures[1].in_data(x, y))
        if design is not None:
            self.source.select(design)

    # ------------------------------------------------------------ words

    def _table_html(self) -> Html:
        """The winners side by side."""
        assert self.shown
        front = self.shown.front
        declared = front.study.declared
        goals, free = front.study.minimise, front.study.free
        names = [*(m.name for m in goals), *(label(n, declared[n]) for n in free)]
        head = ("winner by", "design", *names, "share of all weightings won")
        rows = []
        for rule, i in self.shown.winners.items():
            values = [m.text(m.sign * f) for m, f in zip(goals, front.f[i], strict=True)]
            values += [declared[n].text(float(f"{x:.5g}")) for n, x in zip(free, front.x[i], strict=True)]
            share = f"{100 * self.shown.maps[rule].shares.get(i, 0):.0f} %" if rule in self.shown.maps else "all"
            rows.append((bar_html(colour("series", self.shown.index[i]), 11, rule), i, *values, share))
        return tables_html(table(head, rows))

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

    def still(self) -> bytes:
        """Both pictures, one below the other; without a front there is nothing to see."""
        return below(*(picture.png() for picture in self.pictures if self.shown))


def _numbers_of(front: Judged) -> tuple[object, ...]:
    """What tells one front from another."""
    return front.study.minimise, tuple(front.study.free), front.x.tobytes(), front.f.tobytes()


def choose_panel(source: FrontSource, measures: Sequence[Measure] | None = None) -> ChoosePanel:
    """The winners of ``source``'s front side by side, how sure they are, and bands to narrow it down.

    ``source`` is a `Search` or another panel with a front.
    """
    return ChoosePanel(source, measures)
