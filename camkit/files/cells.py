"""The rows of numbers in a table that somebody saved: text in any of its dialects, or a workbook."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import dropwhile
from typing import Any

from ..quantities.extras import extra
from ..quantities.kinds import shown
from .json_file import BINARY, MOST_BYTES

DELIMITERS = {";": "semicolons", "\t": "tabs", "|": "bars", ",": "commas", " ": "blanks"}
DECIMALS = {".": "decimal points", ",": "decimal commas"}
MOST_UNPACKED = 100_000_000
"""Bytes of a workbook that is unpacked."""
MOST_LINES = 50_000
LONGEST = 40
"""So many characters at most are read as a number."""
_NUMBER = {
    ".": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?"),
    ",": re.compile(r"[+-]?(\d+(,\d+)?|,\d+)([eE][+-]?\d{1,3})?"),
}
_NO_NUMBER = re.compile(r"[+-]?(nan|inf(inity)?)|n/?a|#.*|-+|\?+|=.*|", re.IGNORECASE)
"""What stands where a number is missing."""
_MINUS = str.maketrans({"−": "-", "–": "-", "\xa0": " ", "\u202f": " "})


class TableQuestion(ValueError):
    """What a table leaves open: the ``argument`` of `read_motion` that says it, and its ``options`` by their names.

    >>> question = TableQuestion("the table has no unit", "angle_unit='deg'", "angle_unit", {"deg": "deg"})
    >>> str(question), question.why, question.options
    ("the table has no unit; say angle_unit='deg'", 'the table has no unit', {'deg': 'deg'})
    """

    def __init__(self, why: str, say: str, argument: str, options: Mapping[str, Any]) -> None:
        self.why, self.argument, self.options = why, argument, dict(options)
        super().__init__(f"{why}; say {say}")


@dataclass(frozen=True)
class Cells:
    """A table as it was found: ``rows`` of as many numbers each, and the cells around them."""

    rows: tuple[tuple[str, ...], ...]
    """Numbers as they were written, with decimal points."""
    behind: tuple[tuple[str, ...], ...]
    """What stands behind the numbers of each row."""
    heading: tuple[tuple[str, ...], ...]
    """The cells of the lines above."""
    how: str
    """By what columns and digits are told apart."""
    lines: tuple[int, ...]
    """The line of each row, from 1."""
    broken: int | None = None
    """The line that is no row, where rows should go on."""


def cells_of(
    data: bytes,
    delimiter: str | None,
    decimal: str | None,
    sheet: str | None,
    of: str = "a motion",
    in_each: str = "an angle and a lift",
) -> Cells:
    """The table in the bytes of a file; ``ValueError`` in a sentence where there is none, or more than one.

    ``of`` what it is a table, and what a row has ``in_each``, stand in the sentences.
    """
    if len(data) > MOST_BYTES:
        raise ValueError(f"the file has more than {MOST_BYTES // 10**6} million bytes; no table of {of} has")
    if data[:4] == b"PK\x03\x04":
        return _workbook(data, sheet)
    lines = _text(data, of).translate(_MINUS).splitlines()
    if len(lines) > MOST_LINES:
        raise ValueError(f"the file has {len(lines)} lines; a table of {of} has at most {MOST_LINES}")
    ways = [(d, p) for d in DELIMITERS for p in DECIMALS if d != p and delimiter in (None, d) and decimal in (None, p)]
    found: list[Cells] = []
    for words in (0, 1):  # rows may begin with a word
        tried = [
            _table([_split(line, d)[words:] for line in lines], p, f"{DELIMITERS[d]} and {DECIMALS[p]}")
            for d, p in ways
        ]
        found = found or [table for table in tried if table]
    if not found:
        raise ValueError(f"the file has no rows of two numbers or more; a table of {of} has {in_each} in each")
    return _whole(max(found, key=lambda table: (len(table.rows), len(table.rows[0]))))


def _whole(found: Cells) -> Cells:
    if found.broken is not None:
        raise ValueError(
            f"line {found.broken + 1} of the table is no row of {len(found.rows[0])} numbers as those around it are; "
            "mend it or take it out"
        )
    return found


def _text(data: bytes, of: str) -> str:
    """Text by its byte order mark, as bare UTF-16, as UTF-8, or as Windows-1252."""
    for start, kind in (*BINARY.items(), (b"\xd0\xcf\x11\xe0", "an Excel workbook of the old kind (XLS)")):
        if data.startswith(start):
            raise ValueError(f"the file is {kind}, no table of {of}; save it as CSV or XLSX")
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        encoding = "utf-16"
    elif b"\0" in data:
        odd, even = data[1::2], data[::2]
        encoding = "utf-16-le" if odd.count(0) > len(odd) / 2 else "utf-16-be" if even.count(0) > len(even) / 2 else ""
    else:
        encoding = "utf-8-sig"
    try:
        text = data.decode(encoding) if encoding else "\0"
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace") if encoding == "utf-8-sig" else "\0"
    if re.search(r"[\0-\x08\x0e-\x1f]", text):
        raise ValueError(f"the file is no text and no workbook, so no table of {of}")
    if not text.strip():
        raise ValueError("the file is empty")
    if text.lstrip()[0] in "{[<":
        kind = "a page of HTML or XML" if text.lstrip()[0] == "<" else "JSON"
        raise ValueError(f"the file is {kind}, no table of {of} (`read` takes saved designs)")
    return text


def _split(line: str, delimiter: str) -> list[str]:
    if delimiter == " ":
        return line.split()
    return [part.strip().strip('"').strip() for part in line.split(delimiter)]


def _table(lines: Sequence[Sequence[str]], decimal: str, how: str) -> Cells | None:
    """The longest run of lines that begin with the same number of numbers, at least two; empty lines do not count."""
    lines = [[*dropwhile("".__eq__, cells)] for cells in lines]
    counts = [(i, _numbers(cells, decimal)) for i, cells in enumerate(lines) if cells]
    runs: list[tuple[int, int, int]] = []  # how many lines, how many numbers, the first of them
    for k, (_, count) in enumerate(counts):
        if runs and k and counts[k - 1][1] == count:
            runs[-1] = (runs[-1][0] + 1, count, runs[-1][2])
        else:
            runs.append((1, count, k))
    tables = [run for run in runs if run[1] >= 2]
    if not tables:
        return None
    size, count, first = max(tables, key=lambda run: run[:2])
    here = [i for i, _ in counts[first : first + size]]
    return Cells(
        tuple(tuple(_plain(cell, decimal) for cell in lines[i][:count]) for i in here),
        tuple(tuple(lines[i][count:]) for i in here),
        tuple(tuple(lines[i]) for i, _ in counts[:first]),
        how,
        tuple(i + 1 for i in here),
        _broken(lines, counts[:first], counts[first + size :], count),
    )


def _numbers(cells: Sequence[str], decimal: str) -> int:
    """How many numbers a line begins with."""
    count = 0
    for cell in cells:
        if len(cell) > LONGEST or not _NUMBER[decimal].fullmatch(cell):
            break
        count += 1
    return count


def _plain(cell: str, decimal: str) -> str:
    return cell.replace(decimal, ".")


def _broken(
    lines: Sequence[Sequence[str]], before: Sequence[tuple[int, int]], after: Sequence[tuple[int, int]], count: int
) -> int | None:
    """The line that interrupts a run of rows: others follow or lead, or it is a row that lacks a number."""

    def lacks(line: tuple[int, int], least: int) -> bool:
        i, numbers = line
        cells = lines[i][numbers:count]
        return 0 < numbers < count and any(len(cell) >= least and _NO_NUMBER.fullmatch(cell) for cell in cells)

    if after and (any(n == count for _, n in after) or lacks(after[0], 0)):
        return after[0][0]
    if before and (any(n == count for _, n in before) or lacks(before[-1], 1)):
        return before[-1][0]
    return None


def _workbook(data: bytes, sheet: str | None) -> Cells:
    """The table in a workbook, by the values that it was saved with; nothing in it is worked out."""
    with extra("a workbook"):
        import openpyxl
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            if sum(info.file_size for info in packed.infolist()) > MOST_UNPACKED:
                raise ValueError(f"unpacked it has more than {MOST_UNPACKED // 10**6} million bytes")
        book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
        sheets = {page.title: _sheet(page) for page in book.worksheets}
    except Exception as error:  # whatever a damaged workbook makes of its reader
        raise ValueError(f"the workbook cannot be read ({shown(str(error))}); save it again as XLSX or CSV") from None
    if sheet is not None and sheet not in sheets:
        raise ValueError(f"the workbook has no sheet {shown(sheet)}; there are {', '.join(map(shown, sheets))}")
    tables = {name: _table(lines, ".", f"the sheet {name}") for name, lines in sheets.items() if sheet in (None, name)}
    found = {name: table for name, table in tables.items() if table}
    if not found:
        raise ValueError(
            "the workbook has no rows of two numbers or more; formulas count by the values that they were saved with"
        )
    if len(found) > 1:
        why = f"the workbook has tables in {', '.join(map(shown, found))}"
        raise TableQuestion(why, "sheet=", "sheet", {name: name for name in found})
    return _whole(next(iter(found.values())))


def _sheet(page: Any) -> list[list[str]]:
    """The cells of a sheet as text, numbers with all their digits."""
    return [["" if cell is None else str(cell).strip() for cell in row] for row in page.iter_rows(values_only=True)]
