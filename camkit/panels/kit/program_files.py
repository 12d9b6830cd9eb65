"""The files of a motion program: saved and opened, as code, as a table, as the rows of a controller."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from ...files import designs, electronic_cam_csv, motion_csv
from ...motion import MotionProgram, controller_error
from ...units import deg, in_unit
from ...views.laws import MotionUnits
from .design_files import remarked
from .inputs import Copy, Download, Menu, Upload
from .parts import row
from .program_code import code_of

WAYS = ("poly5", "poly7", "cubic", "linear")
"""What controllers do between the rows of a table."""
STEPS = (1.0, 0.5, 0.1)
"""Angles between the rows, deg."""


class Edited(Protocol):
    """A panel whose program is saved."""

    unit: str

    @property
    def program(self) -> MotionProgram:
        """What is saved."""

    @property
    def units(self) -> MotionUnits:
        """What it is shown in."""

    def load(self, program: MotionProgram) -> None:
        """Show another program."""


class ProgramFiles:
    """Buttons for the files of the program of an editor; ``say(sentence)`` and ``refused(sentence)`` tell of them."""

    def __init__(self, editor: Edited, say: Callable[[str], object], refused: Callable[[str], None]) -> None:
        self.editor, self.say, self.refused = editor, say, refused
        tables = [(f"table, every {step:g}°", partial(self._table, step)) for step in STEPS]
        controllers = [(f"controller, {way}", partial(self._rows, way)) for way in WAYS]
        self.kind = Menu([*tables, *controllers], tooltip="what is in the table")
        self.comma = Menu([("decimals 1.5", "."), ("decimals 1,5", ",")], tooltip="decimal sign of the table")
        self.group = row(
            Download("Save", "motion.json", "application/json", lambda: designs.to_json(editor.program), refused),
            Upload("Open", self._open),
            Copy("Copy as code", self._code, refused),
            Download("Table", "motion.csv", "text/csv", lambda: self.kind.value(), refused),
            self.kind,
            self.comma,
            look="files",
        )

    def _open(self, data: bytes) -> None:
        found = designs.read_json(data, MotionProgram)
        self.editor.load(found.thing)
        self.say(remarked(found))

    def _code(self) -> str:
        text = code_of(self.editor.program, self.editor.unit)
        self.say("The program is copied as lines of Python.")
        return text

    def _table(self, step: float) -> str:
        editor = self.editor
        return motion_csv(
            editor.program, step=step * deg, unit=editor.unit, decimal=self.comma.value, speed=editor.units.speed
        )

    def _rows(self, way: str) -> str:
        program, unit = self.editor.program, self.editor.unit
        text = electronic_cam_csv(program, way, unit=unit, decimal=self.comma.value)
        error = in_unit(controller_error(program, way, 1 * deg), unit)
        self.say(f"Between its rows a controller with {way} is within {error:.2g} {unit} of the program.")
        return text
