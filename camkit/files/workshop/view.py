"""A cam on paper: where a point of it is drawn, its curves as arcs, and the words that point at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...quantities.types import Array
from ...units import mm, um
from .arcs import ArcPath, arc_path
from .contours import Contour
from .svg import Box, Paper, arcs_data, text_width

TOLERANCE = 0.5 * um
"""Of the arcs of a curve, m, on the cam."""
ROLES = {"CAM": "visible", "GROOVE": "visible", "PITCH": "pitch", "FAULT": "fault"}
SCALES = (100, 50, 20, 10, 5, 2, 1, 1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100, 1 / 200, 1 / 500, 1 / 1000)
"""ISO 5455."""
GAP = 1.2
"""Between two notes, mm."""
BEND = 5.0
"""From a view to where the lines of its notes bend, mm."""
CELL = 7.0
"""Height of the frame of a tolerance, and width of its symbol, mm."""


def scale_text(scale: float) -> str:
    """A scale as it is written on a drawing.

    >>> scale_text(2), scale_text(0.5), scale_text(1)
    ('2:1', '1:2', '1:1')
    """
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


def largest_scale(extent: tuple[float, float], room: tuple[float, float]) -> float:
    """The largest standard scale at which what is ``extent`` (m) wide and high fits into a ``room`` (mm).

    >>> largest_scale((0.100, 0.100), (180, 150))
    1
    """
    fits = [s for s in SCALES if all(size / mm * s <= most for size, most in zip(extent, room, strict=True))]
    if not fits:
        wide, high = (size / mm for size in extent)
        raise ValueError(f"the cam is {wide:.4g} mm x {high:.4g} mm; the largest that a sheet takes is at 1:1000")
    return fits[0]


@dataclass(frozen=True)
class View:
    """The cam at a scale on a paper; ``centre`` is where its axis, the origin, is drawn, mm."""

    paper: Paper
    centre: tuple[float, float]
    scale: float

    def at(self, points: Array) -> Array:
        """Where points ``(2, ...)`` of the cam (m, y upwards) are on the paper (mm, y downwards)."""
        x, y = np.asarray(points, dtype=float) / mm * self.scale
        return np.stack([self.centre[0] + x, self.centre[1] - y])

    def back(self, path: ArcPath) -> ArcPath:
        """A path on the paper as it is on the cam, m."""
        x, y = path.corners
        corners = np.stack([x - self.centre[0], self.centre[1] - y]) * mm / self.scale
        return path._replace(corners=corners)

    def length(self, value: float) -> float:
        """Of a length of the cam on the paper, mm."""
        return value / mm * self.scale

    def curve(self, contour: Contour) -> None:
        """A contour by its arcs, in the line of its layer, which is its class."""
        drawn = arc_path(contour, TOLERANCE)
        data = arcs_data(self.at(drawn.corners), drawn.bulges, drawn.closed)
        self.paper.path(data, ROLES[contour.layer], name=contour.layer)

    def circle(self, centre: Sequence[float] | Array, radius: float, role: str) -> None:
        self.paper.circle(self.at(np.asarray(centre)), self.length(radius), role)

    def line(self, start: Sequence[float] | Array, end: Sequence[float] | Array, role: str) -> None:
        self.paper.line(self.at(np.asarray(start)), self.at(np.asarray(end)), role)


class Note(NamedTuple):
    """Lines of words beside a view that point at a place on the paper, mm."""

    place: Array
    lines: tuple[str, ...]
    size: float = 3.5
    cells: tuple[str, ...] = ()
    """In place of lines: what stands in the frame of a profile tolerance behind its symbol."""

    @property
    def height(self) -> float:
        return 1.25 * self.size * len(self.lines) if self.lines else CELL

    @property
    def width(self) -> float:
        if self.cells:
            return CELL + sum(_cell_width(cell, self.size) for cell in self.cells)
        return max(text_width(line, self.size) for line in self.lines)


def write_notes(paper: Paper, notes: Sequence[Note], room: Box, view: Box, clear: tuple[float, float]) -> None:
    """Notes in two columns of a ``room``, left and right of a ``view``, each with a line and an arrow to its place.

    Between two heights the room is kept ``clear``.
    """
    middle, level = (view.left + view.right) / 2, sum(clear) / 2
    for side in (-1, 1):
        column = sorted((n for n in notes if (n.place[0] >= middle) == (side > 0)), key=lambda n: float(n.place[1]))
        above = [note for note in column if note.place[1] < level]
        while above and sum(note.height + GAP for note in above) > clear[0] - room.top:
            above.pop()
        below = column[len(above) :]
        for part, top, bottom in ((above, room.top, clear[0]), (below, clear[1], room.bottom)):
            bends = _uncrossed(part, top, bottom, view.right if side > 0 else view.left, side)
            for note, bend in bends:
                _write_note(paper, note, bend, side)


def _uncrossed(notes: Sequence[Note], top: float, bottom: float, edge: float, side: int) -> list[tuple[Note, Array]]:
    """Notes one below the other with the bends of their lines, in an order in which no two lines cross."""
    ordered = list(notes)
    for _ in range(len(ordered) ** 2):
        tops = _tops(ordered, top, bottom)
        bends = [np.array([edge + side * BEND, y + n.height / 2]) for n, y in zip(ordered, tops, strict=True)]
        lines = [(note.place, bend) for note, bend in zip(ordered, bends, strict=True)]
        crossed = next((i for i in range(len(lines) - 1) if _cross(*lines[i], *lines[i + 1])), None)
        if crossed is None:
            break
        ordered[crossed : crossed + 2] = ordered[crossed + 1], ordered[crossed]
    return list(zip(ordered, bends, strict=True)) if ordered else []


def _cross(a: Array, b: Array, c: Array, d: Array) -> bool:
    """Whether the lines from a to b and from c to d cross."""

    def side(p: Array, q: Array, r: Array) -> float:
        return float(np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])))

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def _tops(notes: Sequence[Note], top: float, bottom: float) -> list[float]:
    """Where notes begin, as near to the height of their places as the others and the room allow."""
    tops: list[float] = []
    for note in notes:
        tops.append(max(top, float(note.place[1]) - note.height / 2))
        top = tops[-1] + note.height + GAP
    for i in range(len(notes) - 1, -1, -1):
        tops[i] = min(tops[i], bottom - notes[i].height)
        bottom = tops[i] - GAP
    return tops


def _write_note(paper: Paper, note: Note, bend: Array, side: int) -> None:
    edge, top = float(bend[0]), float(bend[1]) - note.height / 2
    paper.line(note.place, bend)
    paper.line(bend, bend + np.array([side * 2.0, 0.0]))
    if np.hypot(*(note.place - bend)) > 1:
        paper.arrow(note.place, note.place - bend)
    if note.cells:
        _frame(paper, edge + side * 2 - (note.width if side < 0 else 0.0), top, note)
    for i, line in enumerate(note.lines):
        base = top + 1.25 * note.size * (i + 1) - 0.3 * note.size
        paper.text((edge + side * 3, base), line, note.size, "start" if side > 0 else "end")


def _cell_width(cell: str, size: float) -> float:
    return text_width(cell, size) + 3


def _frame(paper: Paper, left: float, top: float, note: Note) -> None:
    """The frame of a tolerance of a line's profile (ISO 1101): its symbol, the width of the zone, the datum."""
    paper.box(Box(left, top, left + CELL, top + CELL), "thin")
    low = top + CELL - 2.2
    half = arcs_data(np.array([[left + CELL - 1.5, left + 1.5], [low, low]]), np.array([1.0]), False)
    paper.path(half, "thin")
    x = left + CELL
    for cell in note.cells:
        width = _cell_width(cell, note.size)
        paper.box(Box(x, top, x + width, top + CELL), "thin")
        paper.text((x + width / 2, top + CELL / 2 + 0.35 * note.size), cell, note.size, "middle")
        x += width


def datum(paper: Paper, place: tuple[float, float]) -> None:
    """The mark of the datum B: a filled triangle that hangs on a line at a place, mm, with the letter below it."""
    x, y = place
    paper.solid([(x, y), (x - 1.6, y + 2.8), (x + 1.6, y + 2.8)])
    paper.line((x, y + 2.8), (x, y + 5))
    paper.box(Box(x - 2.8, y + 5, x + 2.8, y + 10.6), "thin")
    paper.text((x, y + 9), "B", 3.5, "middle")
