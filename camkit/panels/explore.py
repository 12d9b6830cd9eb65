"""`explore`: a design under sliders, its pictures and its measures."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import ipywidgets as w
import numpy as np

from ..files import designs, profiles
from ..quantities import (
    Analysable,
    Choice,
    D,
    Measure,
    Paths,
    Quantity,
    declared_in,
    refuse_design,
    unremarked,
    value_of,
    with_quantities,
)
from ..quantities.kinds import refuse_arguments
from ..quantities.markup import html, table
from ..render.picture import VIEWPOINT, below, positions_of, small_png, strip, turn_range
from ..study.study import keeps, refuse_limits
from ..units import deg
from ..views.defaults import default_views
from ..views.picture import View
from .kit.banner import Banner
from .kit.controls import Download, Menu, NumberRow, Upload, control, tables_html
from .kit.layout import button
from .kit.orbit import Orbit
from .kit.panel import IMPOSSIBLE, Panel, reason
from .kit.picture import DRAWING, LivePicture


def changed(design: D, values: Mapping[str, object]) -> D:
    """``design`` with other values by path, as a panel gives them."""
    with unremarked():  # a panel's numbers have their units
        return with_quantities(design, values)


def remarked(found: designs.Read) -> str:
    """What a panel says of a file that it has loaded; nothing if there is nothing to remark."""
    return f"The file is loaded, but {'; and '.join(found.remarks)}." if found.remarks else ""


class Explorer(Panel):
    """Sliders for a design's quantities; pictures and measures follow at once.

    ``design`` is the design that is shown, the last one that could be built.  ``load(design)`` shows another,
    ``on_change(f)`` calls ``f(design)`` after every change.  What cannot be built shows as a sentence in place
    of the picture.
    """

    def __init__(
        self,
        design: Analysable,
        views: Sequence[View],
        free: Sequence[str] | None = None,
        measures: Sequence[Measure] = (),
        at_most: Mapping[Measure, float] | None = None,
        at_least: Mapping[Measure, float] | None = None,
        width: float = 12.6,
        height: float = 7.0,
        turn: float | None = None,
        azimuth: float | None = None,
        elevation: float | None = None,
    ) -> None:
        refuse_arguments(Explorer.__init__, locals())
        refuse_design(design, "the design of the panel")
        refuse_limits(at_most or {}, at_least or {})
        self.start: Any = design
        self.design: Any = design
        self.analysis = design.analyse()
        self.measures = tuple(measures)
        upper, lower = dict(at_most or {}), dict(at_least or {})
        self._limits = {m: (v, 1) for m, v in upper.items()} | {m: (v, -1) for m, v in lower.items()}
        self._first = [m.one(self.analysis) for m in self.measures]
        self._offers = None if views else self._offered()
        self._stands: dict[str, float] = {}
        views = tuple(views) or default_views(self.analysis)
        self.picture = LivePicture(views, f"Pictures of the {type(design).__name__}", width=width, height=height)
        self.banner, self.trouble, self._impossible = Banner(), Banner(), ""
        self._free = Paths(design, free).declared if free is not None and len(free) else None
        self.controls: dict[str, NumberRow | Menu] = {}
        self._grid = w.Box()
        self._grid.add_class("camkit-grid")
        self.positions: dict[str, NumberRow] = {}
        self._fit_positions(views, {"turn": turn, "azimuth": azimuth, "elevation": elevation})
        Orbit(self.picture, self.positions, self._turned)
        self._fit_controls(design)
        self.numbers = w.HTML()
        super().__init__([self._grid, self._buttons(), self.banner, self.trouble, self.picture.widget, self.numbers])
        self._show()

    def _offered(self) -> tuple[object, ...]:
        """What the analysis offers."""
        return tuple(getattr(self.analysis, "offers", ()))

    def _fit_positions(self, views: Sequence[View], first: Mapping[str, float | None]) -> None:
        """The controls of the positions that the views can show; one that is new stands at its ``first`` value."""
        there = dict(self.positions)
        wanted = dict.fromkeys(name for view in views for name in positions_of(view))
        made = {name: there.get(name) or self._position(name, first.get(name)) for name in wanted}
        self.positions.clear()
        self.positions.update(made)

    def _fit_controls(self, design: object) -> None:
        """Controls for the paths that ``design`` has: another law has other coefficients."""
        declared = {path: d for path, d in declared_in(design).items() if self._free is None or path in self._free}
        if declared != {path: knob.declared for path, knob in self.controls.items()}:
            self.controls = {path: self._control(path, d, value_of(design, path)) for path, d in declared.items()}
        rows = tuple(c.row for c in (*self.controls.values(), *self.positions.values()))
        if rows != self._grid.children:
            self._grid.children = rows
        for path, knob in self.controls.items():
            if isinstance(knob, Menu):  # what is chosen may have changed below: a coefficient of the law
                knob.set(value_of(design, path))

    def _control(self, path: str, declared: Quantity | Choice, value: object) -> NumberRow | Menu:
        """The control of a path, the one that is there if its declaration is the same."""
        there = self.controls.get(path)
        if there and there.declared == declared:
            return there
        return control(path, declared, value, self._changed, self._refuse_number)

    def _set_controls(self, design: object) -> None:
        """Every control at what ``design`` has."""
        self._fit_controls(design)
        for path, knob in self.controls.items():
            knob.set(value_of(design, path))

    def _position(self, name: str, value: float | None) -> NumberRow:
        """The control that turns the mechanism or the view of it."""
        if name == "turn":
            angle, low, high = self._turn_range()
            declared = Quantity("theta", low / deg, low / deg, high / deg, "deg", "turns the mechanism", above=None)
            return NumberRow(
                f"{angle}_shown", declared, low if value is None else value, self._turned, self._refuse_number
            )
        declared = VIEWPOINT[name]
        value = declared.default * deg if value is None else value
        return NumberRow(name, declared, value, self._turned, self._refuse_number)

    def _turn_range(self) -> tuple[str, float, float]:
        """The angle that turns the mechanism, and how far: as the analysis says, or over its own angles."""
        angle, low, high = turn_range(self.analysis)
        return angle, float(low), float(high)

    def _buttons(self) -> w.Widget:
        back = "back to the design and the position that the panel began with"
        began = {name: knob.value for name, knob in self.positions.items()}
        reset = button("Reset", lambda: self._begin_again(began), "undo", tooltip=back)
        name = type(self.design).__name__
        save = self._file("Save design", f"{name}.json", "application/json", lambda: designs.to_json(self.design))
        table = self._file("Profile as CSV", f"{name}.csv", "text/csv", lambda: profiles.profile_csv(self.analysis))
        drawing = self._file(
            "Profile as DXF", f"{name}.dxf", "image/vnd.dxf", lambda: profiles.profile_dxf(self.analysis)
        )
        load = Upload("Load design", self.load_json)
        has_profile = hasattr(self.analysis, "profile")
        return w.HBox([reset, save, load, *([table, drawing] if has_profile else [])])

    def _begin_again(self, positions: Mapping[str, float]) -> None:
        """The design that the panel began with, in the positions of then."""
        for name in positions.keys() & self.positions.keys():
            self.positions[name].set(positions[name])
        self.load(self.start)

    def _file(self, description: str, filename: str, mime: str, content: Callable[[], str]) -> Download:
        """A download of the design that the controls show; none where they show what cannot be built."""

        def shown() -> str:
            if self._impossible:
                raise ValueError(self._impossible[0].lower() + self._impossible[1:-1])
            return content()

        return Download(description, filename, mime, shown, self.banner.show_message)

    def load_json(self, file: str | bytes) -> None:
        """Show the design that a saved file holds; a file that cannot be used is refused in a sentence."""
        try:
            found = designs.read_json(file, type(self.design))
            found.thing.analyse()
        except IMPOSSIBLE as refusal:
            self.banner.show_message(f"This file cannot be used: {reason(refusal)}.")
        else:
            self.load(found.thing)
            if self.design is found.thing:  # else it cannot be built, which the banner says
                self.banner.show_message(remarked(found))

    def load(self, design: Analysable) -> None:
        """Show ``design``: every slider moves to its value; the last one stays where it cannot be built or drawn.

        ``ValueError`` for what is no design of this kind.
        """
        refuse_design(design, "the design")
        Paths(self.start, ()).values(design)  # refuses another kind
        try:
            analysis = design.analyse()
        except IMPOSSIBLE as error:
            self._go_back(self.design, self.analysis, error)
        else:
            self._set_controls(design)
            self._take(design, analysis)

    def _changed(self) -> None:
        self._try(lambda: changed(self.design, self._moved()))

    def _moved(self) -> dict[str, object]:
        """The controls that do not stand at the design's values; what was chosen anew has values of its own."""
        moved = {p: knob.value for p, knob in self.controls.items() if knob.value != value_of(self.design, p)}
        chosen = [f"{path}." for path in moved if isinstance(self.controls[path], Menu)]
        return {path: value for path, value in moved.items() if not path.startswith(tuple(chosen))}

    def _try(self, make: Callable[[], Analysable]) -> None:
        """Show the design that ``make()`` gives if it can be built, computed and drawn."""
        try:
            design = make()
            analysis = design.analyse()
        except (ArithmeticError, np.linalg.LinAlgError) as error:
            self._go_back(self.design, self.analysis, error)
        except ValueError as refusal:
            self._refuse(str(refusal))
        else:
            self._take(design, analysis)

    def _take(self, design: Analysable, analysis: object) -> None:
        """Show a design and its analysis, or the last one where they cannot be drawn; tell the followers."""
        last = self.design, self.analysis
        self.design, self.analysis = design, analysis
        try:
            self._show()
        except IMPOSSIBLE as error:
            self._go_back(*last, error)
            return
        self._tell_followers(self.design)

    def _refuse(self, sentence: str) -> None:
        """The sentence in place of the picture and the numbers, which would belong to another design."""
        taken = "What was typed is taken. " if self._impossible.endswith(f": {sentence}.") else ""
        self._impossible = f"This cannot be built: {sentence}."
        self.refuse_picture(taken + self._impossible)
        self.trouble.show_message("")

    def _refuse_number(self, sentence: str) -> None:
        """Say why a number was not taken; what is shown stays."""
        self.banner.show_message(f"{sentence} {self._impossible}".strip())

    def _go_back(self, design: object, analysis: object, error: Exception) -> None:
        """Controls, picture and numbers of the last design, and a sentence that says why."""
        self.design, self.analysis = design, analysis
        self._set_controls(design)
        self._fit_turn()
        self._reveal()
        self.banner.show_message(f"This design cannot be computed and drawn, so the last one stays: {reason(error)}.")

    def _turned(self) -> None:
        if self._impossible:
            return
        try:
            self._show()
        except IMPOSSIBLE as error:
            for name, value in self._stands.items():
                self.positions[name].set(value)
            self.banner.show_message(f"This position cannot be drawn, so the last one stays: {reason(error)}.")

    def _fit_turn(self) -> None:
        if "turn" in self.positions:
            self.positions["turn"].between(*self._turn_range()[1:])

    def _show(self) -> None:
        """Everything is made before anything is shown."""
        numbers = self._table_html()
        self._fit_turn()
        limits = {measure: value for measure, (value, _) in self._limits.items()}
        before = self.picture.views
        try:
            views = self._fit_views()
            position = {name: knob.value for name, knob in self.positions.items()}
            self.picture.show(self.analysis, views, limits=limits, **position)
        except Exception:
            self._fit_positions(before, self._stands)
            raise
        if self._offers is not None:
            self._offers = self._offered()
        self._stands = position
        self._fit_controls(self.design)
        self.numbers.value = numbers
        self._reveal()

    def _fit_views(self) -> tuple[View, ...]:
        """The views that there are, or where nobody chose them, those of what the analysis offers now."""
        if self._offers is None or self._offers == self._offered():
            return self.picture.views
        views = default_views(self.analysis)
        self._fit_positions(views, {})
        return views

    def _reveal(self) -> None:
        """Picture and numbers belong to the design."""
        self._impossible = ""
        self.refuse_picture("")
        self.trouble.show_message(getattr(self.analysis, "trouble", ""), "status")

    def rows(self) -> list[tuple[Measure, float, float]]:
        """Every measure with its value now and at the start, SI; one that is infinite is left out: there is none."""
        every = [(m, m.one(self.analysis), first) for m, first in zip(self.measures, self._first, strict=True)]
        return [(m, now, first) for m, now, first in every if not (np.isinf(now) and np.isinf(first))]

    def _table_html(self) -> str:
        rows = [self._row_cells(*row) for row in self.rows()]
        half = -(-len(rows) // 2) if len(rows) > 9 else max(len(rows), 1)
        head = ("measure", "now", "start", "change", "limit", "")
        return tables_html(*(table(head, rows[i : i + half]) for i in range(0, len(rows), half)))

    def _row_cells(self, measure: Measure, now: float, first: float) -> tuple[str, ...]:
        change = f"{100 * (now - first) / abs(first):+.1f} %" if first and np.isfinite([now, first]).all() else ""
        return (measure.name, measure.text(now), measure.text(first), change, *self._verdict(measure, now))

    def _verdict(self, measure: Measure, now: float) -> tuple[str, str]:
        if measure not in self._limits:
            return "", ""
        value, sense = self._limits[measure]
        limit = html("&le; {}" if sense > 0 else "&ge; {}", measure.text(value))
        met = keeps(now, value, sense)
        return limit, "met" if met else html("<span class='camkit-missed'>{}</span>", "not met")

    def still(self) -> bytes:
        """The picture; below it the mechanism in four positions, if it can be turned."""
        turning = [view for view in self.picture.views if "turn" in positions_of(view)]
        if not turning or "azimuth" in self.positions:
            return super().still()
        low, high = self._turn_range()[1:]
        turns = np.linspace(low, high, 5)[:4]  # a whole turn ends where it began
        picture = super().still()
        with DRAWING:
            below_it = strip(self.analysis, turning[0], turns, width=self.picture.figure.get_figwidth())
            return below(picture, small_png(below_it))

    def summary(self) -> str:
        """Every measure as it is now."""
        return "\n".join(f"{m.name}: {m.text(now)}" for m, now, _ in self.rows())


def explore(design: Analysable, *views: View, free: Sequence[str] | None = None, **options: Any) -> Explorer:
    """Sliders and menus for the ``free`` paths of ``design`` (default: all) over live ``views`` of it.

    Without ``views`` it shows the shapes and curves that the analysis offers, in its order.

    Paths are those of `quantities_of` and `choices_of`, such as ``"load.mass"`` or ``"motion.rise.law"``; where another
    law is chosen, the sliders of its coefficients appear.
    ``measures`` are listed with their value now, at the start and the change; ``at_most`` and ``at_least`` map
    measures to limits; ``turn`` is the cam angle (rad) at which the mechanism stands first, ``azimuth`` and
    ``elevation`` where it is seen from in space.  The result's ``.design`` is a plain design for the next cell.
    """
    return Explorer(design, views, free, **options)
