"""The sheet around a drawing: its border, the title block, the scale bar, the table of radii (ISO 5457, ISO 7200)."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import version
from itertools import pairwise

import numpy as np

from .dimensions import Words
from .svg import INK, Box, Paper, fitted
from .title import TitleBlock
from .written import LENGTHS

SIZES = {"A4": (210.0, 297.0), "A3": (420.0, 297.0)}
"""Width and height of a sheet, mm: A4 stands, A3 lies."""
EDGE, BOUND = 10.0, 20.0
"""Between paper and border, and on the left, where it is bound, mm."""
TITLE = (180.0, 40.0)
"""Width and height of the title block, mm."""
LABEL = 2.0
"""Size of the small words over what a title block says, mm."""
BARS = (1000, 500, 200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02)
"""Lengths of a scale bar, in the unit of the drawing."""


@dataclass(frozen=True)
class Facts:
    """What a title block says besides the words that it was given."""

    name: str
    scale: str
    words: Words
    tolerance: str
    sheet: str
    """Which of how many."""


def sheet_size(sheet: object) -> tuple[float, float]:
    """Width and height, mm; ``ValueError`` in a sentence for a size that there is not."""
    if not isinstance(sheet, str) or sheet not in SIZES:
        raise ValueError(f"the sheet is {sheet!r:.40}; there are {', '.join(SIZES)}")
    return SIZES[sheet]


def border(paper: Paper) -> Box:
    """Draw the border with its centring marks; the box within."""
    inner = Box(BOUND, EDGE, paper.width - EDGE, paper.height - EDGE)
    paper.box(inner, "frame")
    x, y = (inner.left + inner.right) / 2, (inner.top + inner.bottom) / 2
    for start, end in (
        ((x, 5), (x, inner.top)),
        ((x, inner.bottom), (x, paper.height - 5)),
        ((inner.left - 5, y), (inner.left, y)),
        ((inner.right, y), (paper.width - 5, y)),
    ):
        paper.line(start, end, "visible")
    return inner


def title_block(paper: Paper, inner: Box, title: TitleBlock, facts: Facts) -> Box:
    """Draw the title block in the lower right corner of the border; its box."""
    width, height = TITLE
    box = Box(inner.right - width, inner.bottom - height, inner.right, inner.bottom)
    paper.box(box, "visible", "#ffffff")
    words = (
        ((0, 0, 120, 16), "title", facts.name, 5.0, 2),
        ((120, 0, 60, 16), "number", title.number, 5.0, 2),
        ((0, 16, 60, 12), "author", title.author, 3.5, 2),
        ((60, 16, 60, 12), "material", title.material, 3.5, 2),
        ((120, 16, 30, 12), "date", title.day, 3.5, 1),
        ((150, 16, 30, 12), "sheet", facts.sheet, 3.5, 1),
        ((0, 28, 24, 12), "scale", facts.scale, 5.0, 1),
        ((24, 28, 36, 12), "unit", {"in": "inch"}.get(facts.words.unit, facts.words.unit), 3.5, 1),
        ((60, 28, 60, 12), "general tolerances", facts.tolerance, 3.5, 1),
        ((120, 28, 30, 12), "projection", "", 3.5, 1),
        ((150, 28, 30, 12), "made with", f"camkit {version('camkit')}", 3.0, 1),
    )
    for (x, y, w, h), label, text, size, lines in words:
        _cell(paper, Box(box.left + x, box.top + y, box.left + x + w, box.top + y + h), label, text, size, lines)
    _projection(paper, (box.left + 135, box.top + 35.2), facts.words.first_angle)
    return box


def _cell(paper: Paper, cell: Box, label: str, text: str, size: float, lines: int) -> None:
    paper.box(cell, "thin")
    paper.text((cell.left + 1.2, cell.top + 2.4), label, LABEL)
    if text.strip():
        said, size = fitted(text, cell.width - 3, size, 1.8, lines)
        high = 1.25 * size
        base = (cell.top + 3 + cell.bottom) / 2 - high * len(said) / 2 + 0.95 * size
        for i, line in enumerate(said):
            paper.text((cell.left + 1.5, base + i * high), line, size)


def _projection(paper: Paper, centre: tuple[float, float], first_angle: bool) -> None:
    """The symbol of the projection (ISO 5456-2): a truncated cone from its side and from its smaller end."""
    x, y = centre
    side = -1 if first_angle else 1
    cone, circles = x + side * 5.5, x - side * 5.5
    paper.polygon([(cone - 3.5, y - 1.5), (cone + 3.5, y - 3), (cone + 3.5, y + 3), (cone - 3.5, y + 1.5)], "thin")
    paper.circle((circles, y), 1.5, "thin")
    paper.circle((circles, y), 3.0, "thin")
    paper.line((cone - 4.5, y), (cone + 4.5, y), "centre")
    paper.line((circles - 4, y), (circles + 4, y), "centre")
    paper.line((circles, y - 4), (circles, y + 4), "centre")


def scale_bar(paper: Paper, place: tuple[float, float], scale: float, unit: str, most: float = 60.0) -> None:
    """A bar of a round length from ``place`` on, as long as the scale makes it: with it a copy is checked."""
    worth = LENGTHS[unit] * 1e3 * scale
    length = next(bar for bar in BARS if bar * worth <= most)
    x, y = place
    places = x + worth * length * np.linspace(0, 1, 6)
    for i, (start, end) in enumerate(pairwise(places)):
        corners = [(start, y), (end, y), (end, y + 1.4), (start, y + 1.4)]
        paper.polygon(corners, "thin", INK if i % 2 == 0 else "#ffffff", name="SCALE")
    for value, at in zip((0, length), places[[0, -1]], strict=True):
        paper.text((float(at), y - 1), f"{value:g}", 2.5, "middle")
    paper.text((float(places[-1]) + 4, y + 1.4), f"{'inches' if unit == 'in' else unit} on the cam", 2.5)
