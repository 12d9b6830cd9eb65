"""A table as a file that spreadsheets and programs read without help: CSV or XLSX.

The first row are the headings, with units, and everything below them are rows: no reader of either has to leave out
lines.  Where the table comes from (`TitleBlock.lines`) stands in one heading more, over a last column that is empty, or
says in every row what is wrong with the design.  A line of its own above, with or without ``#``, would be taken for
headings by pandas, and below for a row; spreadsheets know no comments.
"""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...quantities.extras import extra
from ...quantities.kinds import shown
from ...quantities.markup import csv_cell, plain
from ...quantities.types import Array
from .written import zipped

DIGITS = 12
ENDINGS = ("csv", "xlsx")
Column = Sequence[str] | Array


@dataclass(frozen=True)
class Sheet:
    """Columns of numbers (in the units of their headings) or words by heading, and the lines that say whence."""

    columns: Mapping[str, Column]
    lines: tuple[str, ...] = ()

    @property
    def headings(self) -> list[str]:
        """The first row."""
        return [cell(heading) for heading in (*self.columns, *filter(None, ["; ".join(self.lines)]))]

    @property
    def rows(self) -> list[list[str | float | None]]:
        """All others: numbers with 12 digits, ``None`` for what is not there."""
        wrong = "; ".join(line for line in self.lines if line.startswith("FAULTY")) or None
        columns = [[_value(x) for x in column] for column in self.columns.values()]
        notes = [[wrong and cell(wrong)] * len(columns[0])] if self.lines else []
        return [list(row) for row in zip(*columns, *notes, strict=True)]

    def written(self, ending: str, decimal: str = ".") -> bytes:
        """As a file with that ending, ``"csv"`` or ``"xlsx"``; a decimal comma goes with semicolons between cells."""
        if decimal not in (".", ","):
            raise ValueError(f"the decimal sign is {shown(decimal)}; it must be a point or a comma")
        return workbook([self.headings, *self.rows]) if ending == "xlsx" else _text(self, decimal)


def cell(words: object) -> str:
    """Plain words, and nothing that a spreadsheet takes for a formula.

    >>> cell("=1+1")
    "'=1+1"
    """
    return csv_cell(plain(words))


def numbers_in(data: bytes, decimal: str = ".") -> dict[str, Array]:
    """The columns of numbers in a table that was written, by heading, as its readers find them; ``nan``: no number."""
    rows = read_workbook(data) if data.startswith(b"PK") else _lines(data, decimal)
    columns = dict(zip(map(str, rows[0]), zip(*rows[1:], strict=True), strict=True))
    return {
        heading: np.array([np.nan if x in (None, "") else float(str(x).replace(decimal, ".")) for x in column])
        for heading, column in columns.items()
        if not any(isinstance(x, str) and x and not _NUMBER.fullmatch(x) for x in column)
    }


_NUMBER = re.compile(r"-?[0-9.,]+(e[+-][0-9]+)?")


def _lines(data: bytes, decimal: str) -> list[list[str]]:
    text = io.StringIO(data.decode("utf-8-sig"), newline="")
    return [*csv.reader(text, delimiter="," if decimal == "." else ";")]


def read_workbook(data: bytes) -> list[list[object]]:
    """The cells of the first sheet."""
    with extra("a workbook"):
        from openpyxl import load_workbook
    return [list(row) for row in load_workbook(io.BytesIO(data)).worksheets[0].iter_rows(values_only=True)]


def _value(x: object) -> str | float | None:
    if isinstance(x, str):
        return cell(x)
    number = float(f"{x:z.{DIGITS}g}")
    return number if np.isfinite(number) else None


def _text(sheet: Sheet, decimal: str) -> bytes:
    """A byte order mark says that it is UTF-8 where it is not ASCII, or Excel would take it for another."""
    out = io.StringIO()
    writer = csv.writer(out, delimiter="," if decimal == "." else ";", lineterminator="\n")
    writer.writerow(sheet.headings)
    writer.writerows([_said(x, decimal) for x in row] for row in sheet.rows)
    text = out.getvalue()
    return text.encode("utf-8" if text.isascii() else "utf-8-sig")


def _said(x: str | float | None, decimal: str) -> str:
    return f"{x:.{DIGITS}g}".replace(".", decimal) if isinstance(x, float) else x or ""


def workbook(rows: Sequence[Sequence[str | float | None]], headed: bool = True) -> bytes:
    """Rows of words and numbers as XLSX; the first are headings, which stay in sight, if it is ``headed``."""
    with extra("a workbook"):
        from openpyxl import Workbook
        from openpyxl.styles import Alignment, Font
        from openpyxl.utils import get_column_letter
    book = Workbook()
    page = book.active
    for row in rows:
        page.append(row)
    for k, heading in enumerate(rows[0], 1):
        page.column_dimensions[get_column_letter(k)].width = min(max(len(str(heading)) / 2, 14), 60)
        if headed:
            page.cell(1, k).font = Font(bold=True)
            page.cell(1, k).alignment = Alignment(wrap_text=True, vertical="top")
            page.freeze_panes = "A2"
    out = io.BytesIO()
    book.save(out)
    return _dated(out.getvalue())


def _dated(data: bytes) -> bytes:
    """A workbook that does not say when it was made, so that a table gives the same file again."""
    with zipfile.ZipFile(io.BytesIO(data)) as given:
        files = {name: given.read(name) for name in given.namelist()}
    about = "docProps/core.xml"
    files[about] = re.sub(rb"[0-9]{4}(-[0-9]{2}){2}T[0-9:]{8}Z", b"1980-01-01T00:00:00Z", files[about])
    return zipped(files)
