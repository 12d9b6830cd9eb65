"""`shortlist`: up to five designs kept side by side, their measures and profiles, to be taken along as a file."""

from __future__ import annotations

from functools import partial

from ..decision import SideBySide, side_by_side
from ..decision.summary import NOT_MET, Line
from ..quantities import Analysable, Measure
from ..quantities.kinds import refuse_arguments
from ..study.study import Study
from ..views.overlay import PLACES, Kept, measures_overlaid, profiles_overlaid
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.inputs import Download
from .kit.parts import Banner, Button, Group, Table, Words, bold, row
from .kit.sheet import IMPOSSIBLE, Panel, reason

TITLE = "Designs side by side"
MOST_MEASURES = 12
"""So many measures are drawn; the table has all."""


class Shortlist(Panel):
    """Designs of an `Instrument` that are worth keeping, in columns.

    ``designs`` are the kept ones by the letter of their place.  ``keep()`` keeps the design in the sliders, ``drop``
    and ``load`` take a letter.  ``study`` says which measures are to be small or large and what must be kept, so that
    the best of a line can be marked.
    """

    def __init__(self, explorer: Instrument, study: Study | None = None) -> None:
        refuse_arguments(Shortlist.__init__, locals())
        self.explorer, self.study = explorer, study
        self.designs: dict[str, Analysable] = {}
        self._analyses: dict[str, object] = {}
        self.banner, self.numbers, self._places = Banner(), Table(), row()
        views = (profiles_overlaid, measures_overlaid) if self._has_profile(explorer.analysis) else (measures_overlaid,)
        every = _measures(explorer, study)
        for measure in every:  # refuses a study of another mechanism
            measure.one(explorer.analysis)
        self._measures = every[:MOST_MEASURES]
        self.picture = LivePicture(views, "Kept designs", width=12.6, height=4.8)
        self.picture.pixels = min(60 + 26 * len(self._measures), 250)
        keep = Button("Keep this design", self.keep, primary=True)
        files = [
            Download("Save as Markdown", "designs.md", "text/markdown", self.markdown),
            Download("Save as HTML", "designs.html", "text/html", self.html),
        ]
        super().__init__(row(keep, *files), self.banner, self._places, self.picture, self.numbers)
        self._show()
        explorer.add_tab("Designs", self)

    @staticmethod
    def _has_profile(analysis: object) -> bool:
        return hasattr(getattr(analysis, "whole", analysis), "profile")

    def keep(self) -> None:
        """Keep the design in the sliders, if there is a place and it is not kept yet."""
        design = self.explorer.design
        same = next((place for place, kept in self.designs.items() if kept == design), None)
        free = [place for place in PLACES if place not in self.designs]
        if same or not free:
            full = f"{len(PLACES)} designs are kept already, as many as the tray holds; remove one to make room"
            self.banner.show_message(f"This design is not kept: {f'it is design {same} already' if same else full}.")
            return
        self._put({**self.designs, free[0]: design}, {**self._analyses, free[0]: self.explorer.analysis})

    def drop(self, place: str) -> None:
        """Keep a design no longer."""
        rest = [p for p in self.designs if p != place]
        self._put({p: self.designs[p] for p in rest}, {p: self._analyses[p] for p in rest})

    def load(self, place: str) -> None:
        """Put a kept design into the sliders."""
        self.explorer.load(self.designs[place])

    def _put(self, designs: dict[str, Analysable], analyses: dict[str, object]) -> None:
        last = self.designs, self._analyses
        self.designs = {p: designs[p] for p in PLACES if p in designs}
        self._analyses = {p: analyses[p] for p in PLACES if p in analyses}
        try:
            self._show()
            self.banner.show_message("")
        except IMPOSSIBLE as error:
            self.designs, self._analyses = last
            self._show()
            self.banner.show_message(f"This design is not kept: {reason(error)}.")

    @property
    def table(self) -> SideBySide:
        """The kept designs side by side."""
        named = {f"design {place}": design for place, design in self.designs.items()}
        return side_by_side(named, self.explorer.measures, self.study, list(self._analyses.values()))

    def markdown(self) -> str:
        """The table as Markdown."""
        return self.table.markdown(TITLE)

    def html(self) -> str:
        """Table and picture as a page that needs no other file."""
        return self.table.page(TITLE, self.picture.drawing()() if self.designs else b"")

    def _show(self) -> None:
        with self.held():
            self._places.children = tuple(self._row(place) for place in self.designs)
            self.picture.visible = self.numbers.visible = bool(self.designs)
            self.picture.show(Kept(self._analyses, self._measures))
            if self.designs:
                table = self.table
                self.numbers.put(("", *table.names, "limit"), [_cells(line) for line in table.lines])

    def _row(self, place: str) -> Group:
        """The letter of a kept design in its colour, and what can be done with it."""
        load = Button("Load", partial(self.load, place), tooltip=f"put design {place} into the sliders")
        drop = Button("Remove", partial(self.drop, place), tooltip=f"keep design {place} no longer")
        letter = Words(value=[{"words": f"design {place}", "series": PLACES.index(place)}])
        return row(letter, load, drop)

    def summary(self) -> str:
        """The table as Markdown."""
        return self.markdown() if self.designs else "no design is kept yet"


def _measures(explorer: Instrument, study: Study | None) -> tuple[Measure, ...]:
    """The study's objectives and limits, then the explorer's measures."""
    told = (*study.minimise, *(m for m, _, _ in study.limits)) if study else ()
    return tuple(dict.fromkeys(m if m.sign > 0 else -m for m in (*told, *explorer.measures)))


def _cells(line: Line) -> list[object]:
    """A line of the table: the best ones bold, and which miss a limit."""
    cells = [bold(text) if best else text for text, best in zip(line.texts, line.best, strict=True)]
    missed = {"words": NOT_MET, "look": "missed"}
    told = [[cell, " ", missed] if no else cell for cell, no in zip(cells, line.missed, strict=True)]
    return [line.name, *told, line.limit]


def shortlist(explorer: Instrument, study: Study | None = None) -> Shortlist:
    """A list of up to five designs of ``explorer``, compared in a table and a picture, saved as a file."""
    return Shortlist(explorer, study)
