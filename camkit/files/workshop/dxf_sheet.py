"""A sheet as a DXF file: its layers, line types, entities and header."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...quantities.extras import extra
from ...quantities.markup import plain
from ...quantities.types import Array
from .arcs import ArcPath
from .splines import Spline
from .written import LENGTHS

if TYPE_CHECKING:
    from ezdxf.document import Drawing

LINES = {"CENTER": [2.0, 1.25, -0.25, 0.25, -0.25], "DASHED": [0.75, 0.5, -0.25]}
"""Line types, their dashes in a text's heights."""


class Layer(NamedTuple):
    """How a layer looks."""

    colour: int
    """By AutoCAD's index; 7 is black on white and white on black."""
    line: str = "Continuous"
    weight: int = 18
    """Of its lines, hundredths of a mm."""


LAYERS = {
    "CAM": Layer(7, weight=50),
    "GROOVE": Layer(5, weight=50),
    "PITCH": Layer(8, "CENTER"),
    "CENTRE": Layer(3, "CENTER"),
    "BORE": Layer(4, weight=50),
    "KEYWAY": Layer(6, weight=50),
    "HUB": Layer(9, weight=25),
    "DATUM": Layer(30),
    "NOTES": Layer(8),
    "FAULT": Layer(1, "DASHED", 35),
}


class Sheet(NamedTuple):
    """What is drawn, in m: paths and splines of the cam, lines about it, and texts at places."""

    drawn: list[ArcPath | Spline]
    about: list[ArcPath]
    texts: list[tuple[str, str, float, float]]
    """Layer, words, and where they begin, m."""
    height: float
    """Of a text, m."""


def drawing(sheet: Sheet, unit: str) -> bytes:
    """The drawing as a file."""
    with extra("a DXF drawing"):
        import ezdxf
    worth, out = LENGTHS[unit], io.BytesIO()
    with _undated():
        file = ezdxf.new("R2000", units=ezdxf.units.MM if unit == "mm" else ezdxf.units.IN)
        file.header["$MEASUREMENT"] = int(unit == "mm")
        file.header["$LTSCALE"] = sheet.height / worth
        _declare(file, dict.fromkeys(layer for layer, _ in _boxes(sheet)))
        _fill(file, sheet, worth)
        stream = io.TextIOWrapper(out, encoding=file.output_encoding, errors="dxfreplace", newline="\r\n")
        file.write(stream)
        stream.flush()
    return out.getvalue()


def _declare(file: Drawing, layers: Iterable[str]) -> None:
    """Line types, the style of texts, and how each layer looks."""
    file.styles.add("NOTES", font="arial.ttf")
    for name, dashes in LINES.items():
        file.linetypes.add(name, dashes)
    for name in layers:
        look = LAYERS[name.rstrip("12")]
        file.layers.add(name, color=look.colour, linetype=look.line, lineweight=look.weight)


def without_codes(words: str) -> str:
    """One line of text without the codes that CAD reads in it, such as ``%%d`` for a degree.

    >>> without_codes("100%%d")
    '100% %d'
    """
    line = plain(words)
    return line.replace("%%", "% %").replace("^", "^ ").replace("\\U+", "\\ U+").replace("\\M+", "\\ M+")


@contextmanager
def _undated() -> Iterator[None]:
    """The same drawing is the same file: ezdxf puts no time and no random number into it."""
    from ezdxf import options

    before, options.write_fixed_meta_data_for_testing = options.write_fixed_meta_data_for_testing, True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def _fill(file: Drawing, sheet: Sheet, worth: float) -> None:
    """Put everything into the model space, and say how far it reaches."""
    space = file.modelspace()
    for each in [*sheet.drawn, *sheet.about]:
        look = {"layer": each.layer}
        if isinstance(each, Spline):
            line = space.add_open_spline(
                _rows(each.controls, worth), degree=3, knots=each.knots / worth, dxfattribs=look
            )
            line.closed = each.closed
        else:
            bulges = np.append(each.bulges, np.zeros(each.corners.shape[1] - len(each.bulges)))
            rows = np.column_stack([each.corners.T / worth, bulges])
            space.add_lwpolyline(rows.tolist(), format="xyb", close=each.closed, dxfattribs=look)
    for layer, words, x, y in sheet.texts:
        look = {"layer": layer, "style": "NOTES"}
        space.add_text(words, height=sheet.height / worth, dxfattribs=look).set_placement((x / worth, y / worth))
    points = np.hstack([box for _, box in _boxes(sheet)]) / worth
    space.reset_extents((*points.min(1), 0), (*points.max(1), 0))


def _rows(points: Array, worth: float) -> list[tuple[float, float, float]]:
    return [(float(x), float(y), 0.0) for x, y in points.T / worth]


def _boxes(sheet: Sheet) -> Iterator[tuple[str, Array]]:
    """Layer and points of all that is drawn; of a text the corners of about its box."""
    for each in [*sheet.drawn, *sheet.about]:
        yield each.layer, each.controls if isinstance(each, Spline) else each.points(8)
    for layer, words, x, y in sheet.texts:
        yield layer, np.array([[x, x + 0.8 * sheet.height * len(words)], [y, y + sheet.height]])
