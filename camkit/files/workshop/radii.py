"""The table of radii at whole degrees, in columns on a sheet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...quantities.types import Array
from ...units import deg
from .contours import Contour
from .polar import radii
from .subject import Subject
from .svg import Box, Paper, text_width
from .written import LENGTHS

EDGES = ("CAM", "GROOVE")
"""The layers of what is cut."""
WHOLE = np.arange(360)
"""The directions or cam angles of the table, deg."""
HEAD = 9.0
"""Height of its heading, mm."""
LARGEST, LEAST = 2.8, 1.7
"""Of its letters, mm."""


@dataclass(frozen=True)
class Table:
    """Columns of numbers as they are printed, by their headings; the first are the angles."""

    name: str
    columns: Mapping[str, Sequence[str]]

    @property
    def rows(self) -> int:
        return len(next(iter(self.columns.values())))


def flank_radii(curves: Sequence[Contour], direction: Array) -> dict[str, Array]:
    """The radius (m) of the profile, or of both walls of a groove, in every ``direction`` (rad); ``nan``: none."""
    edges = [curve for curve in curves if curve.layer in EDGES]
    inner, outer = radii([stretch for edge in edges for stretch in edge.stretches], direction)
    return {"inner R": inner, "outer R": outer} if edges[0].layer == "GROOVE" else {"R": outer}


def radii_table(subject: Subject, curves: Sequence[Contour], unit: str) -> Table:
    """Radii of the flanks by direction; of a drum the path of the roller's centre on it by cam angle.

    >>> from camkit import TranslatingFlatCam
    >>> from .contours import contours
    >>> from .subject import subjects
    >>> (cam,) = subjects(TranslatingFlatCam())
    >>> {name: column[90] for name, column in radii_table(cam, contours(cam), "mm").columns.items()}
    {'deg': '90', 'R': '30.000'}
    """
    if subject.drum:
        return _drum_table(subject, unit)
    found = flank_radii(curves, WHOLE * deg)
    there = np.any([np.isfinite(values) for values in found.values()], axis=0)
    of = "walls of the groove" if len(found) > 1 else "profile"
    return _table(f"Radii of the {of} at whole degrees, {unit}", {n: v[there] for n, v in found.items()}, unit, there)


def _drum_table(subject: Subject, unit: str) -> Table:
    analysis = subject.analysis
    if len(analysis.cam_angle) != 361:
        analysis = subject.design.analyse(361)
    x, y = analysis.pitch[:, :-1]
    name = f"Path of the roller's centre around and along the drum at whole degrees of the cam angle, {unit}"
    return _table(name, {"around": x, "along": y}, unit, np.ones(360, dtype=bool))


def _table(name: str, columns: Mapping[str, Array], unit: str, rows: Array) -> Table:
    decimals = 3 if unit == "mm" else 4
    said = {head: [f"{v / LENGTHS[unit]:z.{decimals}f}" for v in values] for head, values in columns.items()}
    return Table(name, {"deg": [str(d) for d in WHOLE[rows]], **said})


def draw_table(paper: Paper, box: Box, table: Table) -> bool:
    """Draw a table as large as a box allows, and say whether it found room."""
    for size in np.arange(LARGEST, LEAST - 1e-9, -0.1):
        widths = [
            max(text_width(text, size) for text in (head, *column)) + 1.6 for head, column in table.columns.items()
        ]
        rows = int((box.height - HEAD - 1) / (1.32 * size))
        blocks = -(-table.rows // rows) if rows > 0 else 10**6
        if blocks * sum(widths) <= box.width:
            _draw(paper, box, table, float(size), widths, blocks)
            return True
    return False


def _draw(paper: Paper, box: Box, table: Table, size: float, widths: Sequence[float], blocks: int) -> None:
    """Blocks of as many rows each, side by side over the whole width."""
    rows, block = -(-table.rows // blocks), box.width / blocks
    spread = block / sum(widths)
    paper.text((box.left, box.top + 3.6), table.name, 2.8, bold=True)
    bottom = box.top + HEAD + 1.32 * size * rows + 0.7
    for b in range(blocks):
        left = box.left + b * block
        if b:
            paper.line((left, box.top + 5), (left, bottom))
        right = left
        for (head, column), width in zip(table.columns.items(), widths, strict=True):
            right += spread * width
            for row, text in enumerate((head, *column[b * rows : (b + 1) * rows])):
                y = box.top + HEAD - 1.2 if row == 0 else box.top + HEAD + 1.32 * size * row - 0.3
                paper.text((right - 0.8, y), text, size, "end", bold=row == 0)
    paper.line((box.left, box.top + 5), (box.right, box.top + 5))
    paper.line((box.left, box.top + HEAD), (box.right, box.top + HEAD))
    paper.line((box.left, bottom), (box.right, bottom))
