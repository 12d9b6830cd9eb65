"""`explore`: a design under sliders, computed and drawn by the page itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from os import PathLike
from typing import TYPE_CHECKING, Any

import anywidget
import ipywidgets as w
import numpy as np
import traitlets

from ..quantities import (
    Analysable,
    Choice,
    Measure,
    Paths,
    declared_in,
    measures_of,
    refuse_design,
)
from ..quantities.applied import a_new_file, raised
from ..quantities.kinds import refuse_arguments
from ..render.figure import picture, small_png
from ..render.living import Living, limited, living
from ..render.page_parts import STYLE, script
from ..render.positions import positions_of, turn_range
from ..study.study import refuse_limits
from ..units import factor
from ..views.defaults import default_views
from ..views.picture import View
from .kit.changes import changed, numbers_of, with_numbers
from .kit.conversions import convert, offered
from .kit.displayed import Displayed
from .kit.files import Files
from .kit.keeper import Keeper
from .kit.makes import Makes
from .kit.seek import pull
from .kit.sheet import IMPOSSIBLE, Sheet, reason
from .kit.slider import slider_of
from .kit.yields import Made

if TYPE_CHECKING:
    from ..render.still import Still

AGREED = 1e-9
"""Page and kernel differ by less than such a share of a measure's size."""


class Instrument(Made, Files, Displayed, anywidget.AnyWidget):
    """A design under sliders; the page computes and draws it, the kernel is told what a person settles on.

    ``design`` is what is shown, the last one that could be built; setting it moves the page.  ``on_change(f)`` calls
    ``f(design)`` after every change.  What cannot be built the page says in a sentence.
    """

    _esm = script("widget.js")
    _css = STYLE
    structure = traitlets.Dict().tag(sync=True)
    program = traitlets.Bytes().tag(sync=True)
    values = traitlets.List(traitlets.Float()).tag(sync=True)
    computed = traitlets.List(traitlets.Float(allow_none=True)).tag(sync=True)
    """The measures of ``values`` as the page computes them."""
    said = traitlets.Dict().tag(sync=True)
    """Of which make these are, which view of the page said them, and ``at`` which time of its clock."""
    page = traitlets.Dict().tag(sync=True)
    """How the page was left beside its design: where it stands, what Undo goes back to, what is pinned."""
    design: Any = traitlets.Any()

    def __init__(
        self,
        design: Analysable,
        views: Sequence[View],
        free: Sequence[str] | None = None,
        measures: Sequence[Measure] | None = None,
        at_most: Mapping[Measure, float] | None = None,
        at_least: Mapping[Measure, float] | None = None,
        turn: float | None = None,
        azimuth: float | None = None,
        elevation: float | None = None,
        tolerances: Mapping[Any, Any] | None = None,
    ) -> None:
        refuse_arguments(Instrument.__init__, locals())
        refuse_design(design, "the design of the panel")
        refuse_limits(at_most or {}, at_least or {})
        self.start: Any = design
        self.analysis: Any = None
        self.measures = limited(measures_of(design) if measures is None else measures, at_most, at_least)
        self.limits = {"at_most": at_most, "at_least": at_least}
        self._chosen = tuple(views)
        self._free = tuple(Paths(design, free).declared) if free is not None and len(free) else None
        position = {"turn": turn, "azimuth": azimuth, "elevation": elevation}
        self._position = {name: value for name, value in position.items() if value is not None}
        self.followers: list[Callable[..., object]] = []
        self.makes = Makes()
        self._now: list[float] = []
        self._overtaken: dict[object, float] = {}
        super().__init__(design=design, tolerances=tolerances)
        self._first = self._now
        self.keeper = Keeper(self)
        self.observe(lambda _: self.keeper.keep(), "page")
        self._send_structure()
        self.observe(self._settled, "values")
        self.observe(self._shown, "design")
        self.on_msg(lambda _, message, buffers: self._asked(message, buffers))
        self.show_table()

    @property
    def views(self) -> tuple[View, ...]:
        """What is drawn: what was chosen, or what the analysis offers."""
        return self._chosen or default_views(self.analysis)

    def on_change(self, act: Callable[..., object]) -> None:
        """Call ``act(design)`` after every change of what is shown."""
        self.followers.append(act)

    def add_tab(self, title: str, *sheets: Sheet) -> None:
        """Show sheets in a tab of that title, in place of those that are there."""
        self.tabs = [*(tab for tab in self.tabs if tab["title"] != title), {"title": title, "sheets": list(sheets)}]

    def load(self, design: Analysable) -> None:
        """Show ``design``; the last one stays where it cannot be computed, and the page says why.

        ``ValueError`` for what is no design of this kind.
        """
        self._refuse_other(design)
        try:
            self.design = design
        except IMPOSSIBLE as error:
            self._go_back(error)
        else:
            self._push()

    def control(self, path: str) -> w.FloatSlider:
        """An ordinary slider for the quantity at ``path``, in its unit, linked both ways; it acts on release."""
        return slider_of(self, path)

    def _refuse_other(self, design: object) -> None:
        refuse_design(design, "the design")
        Paths(self.start, ()).values(design)  # refuses another kind

    @traitlets.validate("design")
    def _possible(self, proposal: Mapping[str, Analysable]) -> Analysable:
        """A design that can be computed and shown, with all that follows from it; else the last one stays whole."""
        design = proposal["value"]
        self._refuse_other(design)
        analysis = self.living.analysis_of(design) if self.structure else design.analyse()
        now = [measure.one(analysis) for measure in self.measures]
        if not self.makes.find(design):
            self.makes.add(self._recorded(design, analysis))
        self.analysis, self._now = analysis, now
        return design

    def _recorded(self, design: Analysable, analysis: object) -> Living:
        """Structure and program for a design; another law has other coefficients."""
        free = None if self._free is None else [path for path in self._free if path in declared_in(design)]
        position = self._stand(self._chosen or default_views(analysis))
        made = living(design, self._chosen, self.measures, **self.limits, free=free, position=position)
        made.structure  # noqa: B018  recorded here
        return made

    def _shown(self, change: traitlets.Bunch) -> None:
        """The page shows the new design; those that follow hear of it."""
        with self.hold_sync():
            self.message = ""
            self._send_structure()
        if still := [p["name"] for p in self.structure["pictures"] if p["still"]]:
            try:
                self._answer(self.living.show_still(self.design), {"still": still, "values": self.values})
            except IMPOSSIBLE as error:
                self.message = f"Not everything can be drawn: {reason(error)}."
        self.show_table()
        self._tell_followers()

    @property
    def living(self) -> Living:
        """What the page shows, and the program that it runs."""
        return self.makes.last[1]

    def _send_structure(self) -> None:
        with self.hold_sync():
            first = {m.name: float(n) for m, n in zip(self.measures, self._first, strict=True) if np.isfinite(n)}
            more = {**self.files, "conversions": offered(self.design), "first": first, "make": self.makes.last[0]}
            self.structure, self.program = {**self.living.structure, **more}, self.living.packed
            self._push()

    def _push(self) -> None:
        """The page's sliders at the values of the design."""
        self.values = list(numbers_of(self.design).values())

    def _stand(self, views: Sequence[View]) -> dict[str, float]:
        """Where the mechanism stands when the page begins."""
        asked = {name for view in views for name in positions_of(view)}
        return {name: value for name, value in self._position.items() if name in asked}

    def _settled(self, change: traitlets.Bunch) -> None:
        """What the page shows becomes the design, if it can be built."""
        numbers = list(numbers_of(self.design).values())
        if self._old:
            self._push()
        elif len(change.new) == len(numbers) and change.new != numbers:
            self._try(lambda: self._of(change.new))

    def _of(self, values: Sequence[float]) -> Any:
        """The design whose quantities have these values, in their order."""
        return with_numbers(self.design, values)

    def _try(self, make: Callable[[], Analysable]) -> None:
        before = self.design
        try:
            self.design = make()
        except Exception as error:
            if self.design is not before:  # what is linked to it refuses
                self.message = f"What follows this panel cannot be shown everywhere: {reason(error)}."
            elif not isinstance(error, ValueError) or isinstance(error, np.linalg.LinAlgError):
                self._go_back(error)  # else the page says it in the same words

    def _go_back(self, error: Exception) -> None:
        self._push()
        self.message = f"This design cannot be computed and drawn, so the last one stays: {reason(error)}."

    def _tell_followers(self) -> None:
        """Each of them, whatever the others make of it."""
        for act in self.followers:
            try:
                act(self.design)
            except IMPOSSIBLE as error:
                self.message = f"What follows this panel cannot be shown everywhere: {reason(error)}."
            except Exception as error:  # somebody's own function: what this panel shows stays whole
                self.message = f"What follows this panel cannot be computed: {raised(error)}."

    @traitlets.observe("computed")
    def _compare(self, change: traitlets.Bunch) -> None:
        """A visible error where page and kernel differ."""
        if self._old or self.values != list(numbers_of(self.design).values()):
            return  # they are of another design
        for measure, first, now, page in zip(self.measures, self._first, self._now, change.new, strict=False):
            size = np.nanmax(np.abs([first, now, 0.0])) if np.isfinite([first, now]).all() else abs(now)
            if page is not None and np.isfinite(now) and abs(page - now) > AGREED * (size or factor(measure.unit)):
                self.message = (
                    f"The page computes {measure.text(page)} for the {measure.name}, the kernel {measure.text(now)}."
                )

    def _asked(self, message: Mapping[str, Any], buffers: Sequence[memoryview]) -> None:
        """What the page asks for: a choice from a menu, a file, or what it may not compute itself."""
        try:
            self._catch_up(message)
            if "choose" in message:
                path, option = message["choose"]
                Paths(self.design, [path], Choice)
                self.design = changed(self.design, {path: option})
            elif "back" in message:
                self.load(self.makes.design(*message["back"]))
            elif "pin" in message:
                self._show_pinned(*message["pin"])
            elif "reset" in message:
                self.load(self.start)
            elif "file" in message:
                if (seen := self._of(self.values)) != self.design:
                    seen.analyse()  # refuses what cannot be built
                self.send_file(message["file"])
            elif "open" in message:
                self.open_file(bytes(buffers[0]), message["open"])
            elif "session" in message:
                self.keeper.answer(message["session"])
            elif "convert" in message:
                convert(self, message["convert"])
            elif "seek" in message:
                pull(self, *message["seek"])
            elif "study" in message:
                self.open_study()
            elif "workshop" in message:
                self.open_workshop()
            elif "compute" in message:
                self._compute(message)
        except Exception as error:  # a page must always be answered
            self.message = f"{reason(error)[:1].upper()}{reason(error)[1:]}."

    def _catch_up(self, message: Mapping[str, Any]) -> None:
        """What the page shows when it asks comes with the question, which may overtake it; then it is old."""
        if "said" in message:
            self.said = message["said"]
            if not self._old:
                self.values = message["values"]
            self._overtaken[self.said.get("view")] = self.said["at"]

    @property
    def _old(self) -> bool:
        """Whether what the page said last is of a design that was left since."""
        here, before = self.makes.last[0], self._overtaken.get(self.said.get("view"), -np.inf)
        return bool(self.said.get("at", np.inf) <= before or self.said.get("make", here) != here)

    def _compute(self, message: Mapping[str, Any]) -> None:
        count = len(self.structure["quantities"])
        values, names = message["compute"], (p["name"] for p in self.structure["positions"])
        try:
            shown = self.living.show(self._of(values[:count]), **dict(zip(names, values[count:], strict=True)))
        except Exception as error:  # whatever somebody's own mechanism raises
            shown = {"sentence": reason(error), "arrays": []}
        self._answer(shown, {"answer": message["number"]})

    def _show_pinned(self, make: object, values: Sequence[float], position: Sequence[float]) -> None:
        """The pictures and measures of a design of another make, for a page that has pinned it."""
        design, living = self.makes.design(make, values), self.makes.living(make)
        seen = living.show(design, **dict(zip(living.first, position, strict=True)))
        self._answer(seen, {"pinned": {"make": make, "values": values}})

    def _answer(self, shown: Mapping[str, Any], more: Mapping[str, object]) -> None:
        arrays = [np.asarray(array, dtype=float).tobytes() for array in shown["arrays"]]
        self.send({**more, **{name: part for name, part in shown.items() if name != "arrays"}}, arrays)

    def to_html(self, path: str | PathLike[str]) -> None:
        """Write the panel as one HTML file that computes without Python (see `camkit.render.to_html`)."""
        a_new_file(path).write_text(self.html(), encoding="utf-8")

    def html(self) -> str:
        """The page of the design as it is now, as one file."""
        docks = [{"title": tab["title"], "sheets": [sheet.stored() for sheet in tab["sheets"]]} for tab in self.tabs]
        return replace(self.living, design=self.design).html(docks, self.keeper.alike)

    def rows(self) -> list[tuple[Measure, float, float]]:
        """Every measure with its value now and at the start, SI; one that is infinite is left out: there is none."""
        every = zip(self.measures, self._now, self._first, strict=True)
        return [(m, now, first) for m, now, first in every if not (np.isinf(now) and np.isinf(first))]

    def summary(self) -> str:
        """Every measure as it is now."""
        return "\n".join(f"{m.name}: {m.text(now)}" for m, now, _ in self.rows())

    def figure(self) -> Still:
        """The views of the design, as a figure of matplotlib."""
        return self._figure(self.analysis, self.views)

    def _figure(self, analysis: object, views: Sequence[View]) -> Still:
        limits = {measure: value for part in self.limits.values() for measure, value in (part or {}).items()}
        return picture(analysis, *views, limits=limits, **self._stand(views))

    def drawing(self) -> Callable[[], bytes]:
        """What draws the picture; below it the mechanism in four positions, if it can be turned in its plane."""
        return partial(self._png, self.analysis, self.views)

    def _png(self, analysis: object, views: Sequence[View]) -> bytes:
        from ..render.still import strip

        figure, turning = self._figure(analysis, views), [view for view in views if "turn" in positions_of(view)]
        if not turning or "azimuth" in positions_of(turning[0]):
            return small_png(figure)
        _, low, high = turn_range(analysis)
        turns = np.linspace(low, high, 5)[:4]  # a whole turn ends where it began
        return small_png(figure, strip(analysis, turning[0], turns))


def explore(design: Analysable, *views: View, free: Sequence[str] | None = None, **options: Any) -> Instrument:
    """Sliders and menus for the ``free`` paths of ``design`` (default: all) over live ``views`` of it.

    Without ``views`` it shows the shapes and curves that the analysis offers, in its order.

    Paths are those of `quantities_of` and `choices_of`, such as ``"load.mass"`` or ``"motion.rise.law"``; where another
    law is chosen, the sliders of its coefficients appear.
    ``measures`` (default: all of the design) are listed with their value now, at the start and the change; ``at_most``
    and ``at_least`` map measures to limits; ``turn`` is the cam angle (rad) at which the mechanism stands first,
    ``azimuth`` and ``elevation`` where it is seen from in space.  The yield is that of parts within ``tolerances`` (see
    `Study.under`; default: `general_tolerances`).  The result's ``.design`` is a plain design for the next cell.
    """
    return Instrument(design, views, free, **options)
