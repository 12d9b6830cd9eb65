"""A sheet of paper as SVG, true to scale: x to the right and y downwards in mm, every line as its role asks (ISO 128).

Arcs are arcs in the file.  Texts are texts, letter by letter what they were given as.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...quantities.markup import Html, attribute, html, plain
from ...quantities.types import Array

INK, RED = "#000000", "#c00000"
CHAIN, TWO_DOTS, DASHES = "6 0.8 0.4 0.8", "6 0.8 0.4 0.8 0.4 0.8", "3 0.8"
LINES = {
    "frame": (0.7, ""),
    "visible": (0.5, ""),
    "thin": (0.18, ""),
    "hatch": (0.13, ""),
    "hidden": (0.25, DASHES),
    "centre": (0.18, CHAIN),
    "pitch": (0.18, CHAIN),
    "neighbour": (0.18, TWO_DOTS),
    "fault": (0.5, ""),
}
"""Width (mm) and dashes of the line of each role; a neighbour is a part that this sheet does not make."""
FONT = "Liberation Sans, Arial, Helvetica, Noto Sans, Noto Sans CJK SC, WenQuanYi Zen Hei, DejaVu Sans, sans-serif"
ARROW, ARROW_WIDTH = 2.8, 0.95
"""Of an arrow head, mm."""
WIDE_ARC = 0.4
"""An arc of a larger bulge is written as two: the radius of half a turn says too little of where it runs."""

_WIDTHS = {
    0.222: "ijl'|",
    0.278: "It.,:;/\\!f []",
    0.333: "r()-`",
    0.5: "ckszvxyJ",
    0.556: "abdeghnopqu0123456789#$?_L",
    0.584: "+<>=±~×",
    0.667: "ABEKPSVXY&",
    0.722: "CDHNRUw",
    0.778: "GOQØ",
    0.833: "mM",
    0.9: "%W@",
}
_WIDTH = {letter: width for width, letters in _WIDTHS.items() for letter in letters}


class Box(NamedTuple):
    """A rectangle on the paper, mm."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.bottom - self.top

    def within(self, other: Box) -> bool:
        """Whether it lies in another."""
        return (
            self.left >= other.left
            and self.top >= other.top
            and self.right <= other.right
            and self.bottom <= other.bottom
        )


def text_width(text: str, size: float = 1.0) -> float:
    """About how wide a text of a ``size`` is: a Latin letter as in Helvetica, a Chinese one as wide as it is high."""
    return size * sum(_WIDTH.get(c, 1.0 if unicodedata.east_asian_width(c) in "WF" else 0.6) for c in text)


def fitted(text: str, width: float, size: float, least: float, lines: int = 1) -> tuple[list[str], float]:
    """``text`` in so many ``lines`` at most and as large as a ``width`` (mm) allows, and that size; cut if it must be.

    >>> fitted("Cam of the inlet valve", 30, 5, 2.5, lines=2)
    (['Cam of the', 'inlet valve'], 5)
    >>> fitted("x" * 60, 20, 5, 2.5)[0]
    ['xxxxxxxxxxxxxx…']
    """
    text = text[: lines * (2 + int(width / (least * min(_WIDTH.values()))))]  # of more there is never room
    while True:
        found = _broken(text, width, size)
        if len(found) <= lines:
            return found, size
        if size <= least:
            last = found[lines - 1]
            while last and text_width(last + "…", size) > width:
                last = last[:-1]
            return [*found[: lines - 1], last + "…"], size
        size = max(least, 0.9 * size)


def _broken(text: str, width: float, size: float) -> list[str]:
    """``text`` in lines of a ``width``: at blanks, and within a word that is wider, or of Chinese letters."""
    lines, line = [], ""
    for word in re.findall(r"\s*[\u2e80-\uffff]|\s*[^\s\u2e80-\uffff]+", text):
        if text_width((line + word).strip(), size) <= width:
            line += word
            continue
        if line.strip():
            lines.append(line.strip())
        line = ""
        for letter in word.strip():
            if line and text_width(line + letter, size) > width:
                lines.append(line)
                line = ""
            line += letter
    return [*lines, line.strip()] if line.strip() or not lines else lines


@dataclass
class Paper:
    """A sheet of a size in mm, what is drawn on it so far, and the places of its texts."""

    width: float
    height: float
    marks: list[Html] = field(default_factory=list)
    texts: list[tuple[Box, str]] = field(default_factory=list)

    def path(self, data: str, role: str, fill: str = "none", name: str = "") -> None:
        """A path by its data, drawn as its role asks; ``name`` is its class, by which it is found again."""
        width, dashes = LINES[role]
        said = [attribute("class", name)] if name else []
        said += [attribute("stroke-dasharray", dashes)] if dashes else []
        ink = RED if role == "fault" else INK
        said += [Html(f"d='{data}' fill='{fill}' stroke='{ink}' stroke-width='{width}' stroke-linejoin='round'")]
        self.marks.append(html("<path {}/>", Html(" ".join(said))))

    def line(self, start: Sequence[float] | Array, end: Sequence[float] | Array, role: str = "thin") -> None:
        self.path(f"M{xy(start)}L{xy(end)}", role)

    def polygon(self, corners: Sequence[Sequence[float]], role: str, fill: str = "none", name: str = "") -> None:
        self.path(f"M{'L'.join(map(xy, corners))}Z", role, fill, name)

    def box(self, box: Box, role: str, fill: str = "none") -> None:
        left, top, right, bottom = box
        self.polygon([(left, top), (right, top), (right, bottom), (left, bottom)], role, fill)

    def circle(self, centre: Sequence[float] | Array, radius: float, role: str, name: str = "") -> None:
        """A whole circle, as two arcs."""
        x, y = centre
        half = f"A{n(radius)} {n(radius)} 0 0 0 "
        self.path(f"M{xy((x + radius, y))}{half}{xy((x - radius, y))}{half}{xy((x + radius, y))}Z", role, name=name)

    def arrow(self, tip: Sequence[float] | Array, direction: Sequence[float] | Array) -> None:
        """A closed, filled arrow head that points along a ``direction``."""
        along = np.asarray(direction, dtype=float) / np.hypot(*direction)
        across = np.array([-along[1], along[0]]) * ARROW_WIDTH / 2
        back = np.asarray(tip) - ARROW * along
        self.solid([np.asarray(tip), back + across, back - across])

    def solid(self, corners: Sequence[Sequence[float] | Array]) -> None:
        """A polygon that is black without a line around it."""
        self.marks.append(html("<path {}/>", Html(f"d='M{'L'.join(map(xy, corners))}Z' fill='{INK}'")))

    def text(
        self,
        place: Sequence[float],
        text: object,
        size: float = 3.5,
        anchor: str = "start",
        upright: bool = False,
        bold: bool = False,
        ink: str = INK,
    ) -> None:
        """A line of text on its base line; ``upright``: it runs from below to above."""
        said, (x, y) = plain(text), place
        wide, high, low = text_width(said, size) * (1.07 if bold else 1.0), 0.74 * size, 0.22 * size
        before = {"start": 0.0, "middle": wide / 2, "end": wide}[anchor]
        left, right = x - before, x - before + wide
        box = Box(left, y - high, right, y + low)
        if upright:
            box = Box(x - high, y + before - wide, x + low, y + before)
        self.texts.append((box, said))
        turned = f" transform='rotate(-90 {n(x)} {n(y)})'" if upright else ""
        heavy = " font-weight='bold'" if bold else ""
        look = f"x='{n(x)}' y='{n(y)}' font-size='{n(size)}' text-anchor='{anchor}' fill='{ink}'{turned}{heavy}"
        self.marks.append(html("<text {}>{}</text>", Html(look), said))

    def paragraph(
        self, place: Sequence[float], texts: Sequence[str], width: float, size: float = 2.8, ink: str = INK
    ) -> float:
        """Texts below each other from a place down, in as many lines as a ``width`` asks; where they end, mm."""
        x, y = place
        for text in texts:
            for line in _broken(text, width, size):
                y += 1.4 * size
                self.text((x, y), line, size, ink=ink)
            y += 0.35 * size
        return float(y)

    def stamp(self, word: str) -> None:
        """A word in red across the whole sheet, below all else."""
        size = 0.8 * self.width / text_width(word)
        x, y = self.width / 2, self.height / 2 + size / 3
        place = f"x='{n(x)}' y='{n(y)}' font-size='{n(size)}' transform='rotate(-35 {n(x)} {n(self.height / 2)})'"
        style = f"text-anchor='middle' font-weight='bold' fill='{RED}' fill-opacity='0.18'"
        self.marks.insert(0, html("<text class='FAULTY' {} {}>{}</text>", Html(place), Html(style), word))

    def svg(self, top: float = 0.0) -> Html:
        """The sheet as an element that is as large as the paper, so far below the top of what it stands in."""
        size, place = f"width='{n(self.width)}' height='{n(self.height)}'", f"x='0' y='{n(top)}'"
        seen = f"viewBox='0 0 {n(self.width)} {n(self.height)}'"
        ground = f"<rect {size} fill='#ffffff'/>"
        return Html(f"<svg {place} {size} {seen}>{ground}\n{chr(10).join(self.marks)}\n</svg>")


def document(sheets: Sequence[Paper], title: str, about: str = "") -> str:
    """Sheets one below the other as an SVG file whose millimetres are millimetres."""
    width, height = max(sheet.width for sheet in sheets), sum(sheet.height for sheet in sheets)
    tops = np.append(0.0, np.cumsum([sheet.height for sheet in sheets]))
    within = "\n".join(sheet.svg(float(top)) for sheet, top in zip(sheets, tops, strict=False))
    size = f"width='{n(width)}mm' height='{n(height)}mm' viewBox='0 0 {n(width)} {n(height)}'"
    return html(
        "<svg xmlns='http://www.w3.org/2000/svg' {} {}><title>{}</title><desc>{}</desc>\n{}\n</svg>\n",
        Html(size),
        attribute("font-family", FONT),
        plain(title),
        plain(about),
        Html(within),
    )


def n(value: float) -> str:
    """A length on the paper, mm, to the hundredth of a micrometre.

    >>> n(12.5), n(-0.0)
    ('12.5', '0')
    """
    said = f"{value:z.5f}"
    return said.rstrip("0").rstrip(".")


def xy(point: Sequence[float] | Array) -> str:
    """A point on the paper as a path says it."""
    return f"{n(float(point[0]))} {n(float(point[1]))}"


def arcs_data(corners: Array, bulges: Array, closed: bool) -> str:
    """The data of a path through ``corners`` ``(2, k)`` on the paper, each with the bulge of the way to the next.

    A bulge is the tangent of a quarter of the arc's angle, above 0 where it is seen to run counter-clockwise.

    >>> arcs_data(np.array([[0.0, 1.0], [0.0, 1.0]]), np.array([0.25, 0.0]), True)
    'M0 0A1.5026 1.5026 0 0 0 1 1L0 0Z'
    """
    ends = np.column_stack([corners, corners[:, :1]]) if closed else corners
    data = [f"M{xy(ends[:, 0])}"]
    for (start, end), bulge in zip(pairwise(ends.T), bulges, strict=True):
        data += _arc(start, end, float(bulge))
    return "".join(data) + ("Z" if closed else "")


def _arc(start: Array, end: Array, bulge: float) -> list[str]:
    if abs(bulge) > WIDE_ARC:
        way = end - start
        middle = (start + end) / 2 + bulge / 2 * np.array([-way[1], way[0]])
        half = float(np.tan(np.arctan(bulge) / 2))
        return [*_arc(start, middle, half), *_arc(middle, end, half)]
    chord = float(np.hypot(*(end - start)))
    if abs(bulge) * chord < 1e-6:  # its height over the chord is twice that: below what is written
        return [f"L{xy(end)}"]
    radius = n(chord * (1 + bulge**2) / (4 * abs(bulge)))
    return [f"A{radius} {radius} 0 0 {int(bulge < 0)} {xy(end)}"]
