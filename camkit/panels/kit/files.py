"""What the page of an instrument opens and saves, and the tabs that open with that."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import ipywidgets as w
import traitlets

from ...files import designs
from ...files.json_file import MOST_BYTES, content_of, text_of
from ...files.outlines import takes_outline
from ...motion import MotionProgram, TableMotion
from ...quantities import words
from .design_files import file_of, files_of, remarked
from .motions_in import motions_in, with_motion
from .sheet import IMPOSSIBLE, reason

TABLES = ".csv,.txt,.tsv,.dat,.asc,.xlsx"
"""The names of files that may hold a table end so."""
DRAWINGS = ",.dxf"


class Files(w.DOMWidget):
    """An instrument whose page opens saved designs and tables of motions, and saves what it shows."""

    message = traitlets.Unicode().tag(sync=True)
    tabs = traitlets.List().tag(sync=True, **w.widget_serialization)  # type: ignore[var-annotated]
    """What stands beside the curves, by its title: sheets."""
    opened = traitlets.Unicode().tag(sync=True)
    """The tab that is to be seen now, by its title."""
    design: Any
    analysis: Any

    @property
    def files(self) -> Mapping[str, object]:
        """What the page saves; of what it opens the most bytes, and what motions are called that a table can give."""
        motions = list(map(words, motions_in(self.design)))
        readable = TABLES + DRAWINGS * takes_outline(self.design)
        return {"files": files_of(self), "most": MOST_BYTES + 1, "tables": motions, "readable": readable}

    def open_file(self, file: bytes, name: str = "") -> None:
        """Show what a file holds: a saved design, or a motion or an outline for this one (see `table_panel`)."""
        if name.lower().endswith(".json") or _is_json(file) or not motions_in(self.design):
            self.load_json(file)
            return
        from .. import tables  # they stand on this one

        panel = tables.table_panel(self)
        self.opened = ""  # it may have been left since
        self.opened = tables.TITLE
        panel.read(file)

    def load_json(self, file: str | bytes) -> None:
        """Show the design that a saved file holds, or this one with the motion program in it.

        A file that cannot be used is refused in a sentence.
        """
        try:
            found = self._read(file)
            found.thing.analyse()
        except IMPOSSIBLE as refusal:
            self.message = f"This file cannot be used: {reason(refusal)}."
        else:
            self.load(found.thing)
            if self.design == found.thing:  # else it cannot be computed, which the page says
                self.message = remarked(found)

    def _read(self, file: str | bytes) -> designs.Read:
        motion = next(iter(motions_in(self.design)), None)
        if motion is None or "program" not in content_of(text_of(file)):
            return designs.read_json(file, type(self.design))
        found = designs.read_json(file, MotionProgram)
        return replace(found, thing=with_motion(self.design, motion, found.thing))

    def load(self, design: Any) -> None:
        """Show a design, or say why not."""
        raise NotImplementedError

    def send_file(self, kind: str) -> None:
        """Give the page a file of what it shows."""
        name, data = file_of(self, kind)
        self.send({"file": name}, [data])

    def open_workshop(self) -> None:
        """Open the tab that sends the design to the workshop."""
        from ..workshop import TITLE, WorkshopPanel

        if not any(tab["title"] == TITLE for tab in self.tabs):
            WorkshopPanel(self)
        self.opened = ""  # it may have been left since
        self.opened = TITLE

    def open_study(self) -> None:
        """Open the tab in which a study is made."""
        from ..study import StudyPanel

        if not any(tab["title"] == "Study" for tab in self.tabs):  # another page, or one of another make, may ask again
            StudyPanel(self)

    def show_table(self) -> None:
        """Open a tab that says what was understood of a table, for a design whose motion is from one."""
        if any(isinstance(motion, TableMotion) for motion in motions_in(self.design).values()):
            from ..tables import table_panel

            table_panel(self)


def _is_json(file: bytes) -> bool:
    """Whether a file begins as a saved design does."""
    return file[:99].replace(b"\0", b"").lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n").startswith(b"{")
