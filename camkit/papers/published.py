"""Tables to read: any rows under a heading, and printed against computed with a verdict for each number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..quantities.kinds import refuse_kinds
from ..quantities.markup import html, table


@dataclass(frozen=True)
class Table:
    """Rows under a heading; numbers are shown with ``digits`` digits.

    >>> Table(("law", "Cv"), [("cycloidal", 2.0), ("3-4-5", 1.875)], digits=3)
    law        Cv
    cycloidal  2
    3-4-5      1.88
    """

    head: Sequence[str]
    rows: Sequence[Sequence[object]]
    title: str = ""
    digits: int = 5

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if other := {len(row) for row in self.rows} - {len(self.head)}:
            raise ValueError(f"the table has {len(self.head)} headings and a row of {max(other)}; they must be as many")

    def _cells(self) -> list[list[str]]:
        shown = [[self._text(cell) for cell in row] for row in self.rows]
        return [list(self.head), *shown]

    def _text(self, cell: object) -> str:
        return f"{cell:.{self.digits}g}" if isinstance(cell, (float, np.floating)) else str(cell)

    def __repr__(self) -> str:
        widths = [max(map(len, column)) for column in zip(*self._cells(), strict=True)]
        lines = ("  ".join(c.ljust(n) for c, n in zip(row, widths, strict=True)).rstrip() for row in self._cells())
        return "\n".join([*([self.title] if self.title else []), *lines])

    def _repr_html_(self) -> str:
        head, *rows = self._cells()
        return table(head, rows, html("<b>{}</b>", self.title), "text-align:left")


AGREES = 0.1
"""A gap of at most this (percent) that rounded inputs explain still counts as agreement."""


@dataclass(frozen=True)
class Row:
    """One printed number and its recomputation; ``printed`` is text, so that its last digit is known."""

    name: str
    unit: str
    printed: str
    computed: float
    remark: str = ""

    @property
    def step(self) -> float:
        """One unit of the last printed digit."""
        _, _, decimals = self.printed.partition(".")
        return 10.0 ** -len(decimals)

    @property
    def verdict(self) -> str:
        """Whether the print is reproduced to its last digit, agrees to 0.1 %, or by how much it is missed."""
        gap = abs(self.computed - float(self.printed))
        if gap <= 0.5 * self.step * (1 + 1e-9):
            return "reproduced"
        if gap <= 1.5 * self.step:
            return "reproduced but for the last digit"
        percent = 100 * (self.computed / float(self.printed) - 1)
        return f"agrees to {abs(percent):.2g} %" if abs(percent) <= AGREES else f"off by {percent:+.3g} %"

    @property
    def reproduced(self) -> bool:
        """Whether the verdict is good."""
        return not self.verdict.startswith("off")

    def cells(self) -> tuple[str, ...]:
        """The row as text, the computed number with one digit more than the print."""
        digits = max(int(np.round(-np.log10(self.step))), 0) + 1
        return self.name, self.unit, self.printed, f"{self.computed:.{digits}f}", self.verdict, self.remark


@dataclass(frozen=True)
class Comparison:
    """A printed table beside its recomputation; shows as a table in a notebook, as text elsewhere.

    ``against`` says what stands beside the computed numbers where nobody printed them.

    >>> print(Comparison("Areas", "a book", [Row("disk of radius 1", "m^2", "3.14", 3.14159)]))
    Areas (a book)
    disk of radius 1 [m^2]: printed 3.14, computed 3.142: reproduced
    """

    title: str
    source: str
    rows: Sequence[Row]
    against: str = "printed"

    def __repr__(self) -> str:
        lines = (
            f"{name}{f' [{unit}]' if unit else ''}: {self.against} {printed}, computed {computed}: {verdict}"
            for name, unit, printed, computed, verdict, _ in (row.cells() for row in self.rows)
        )
        return "\n".join([f"{self.title} ({self.source})", *lines])

    def _repr_html_(self) -> str:
        words = ("quantity", "unit", self.against, "computed", "verdict", "remark")
        rows = [[self._marked(cell, row) for cell in row.cells()] for row in self.rows]
        return table(words, rows, html("<b>{}</b> ({})", self.title, self.source), "text-align:left")

    @staticmethod
    def _marked(cell: str, row: Row) -> str:
        return html("<b>{}</b>", cell) if cell == row.verdict and not row.reproduced else cell
