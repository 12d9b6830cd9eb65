"""The section through a cam's axis along its angle 0, and the detail of its bore with the keyway."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...quantities.types import Array
from ...units import in_unit, mm
from .blank import Blank
from .dimensions import Words, across, upright
from .plan import bore_path
from .svg import Box, Paper, arcs_data
from .view import View, datum, largest_scale

HATCH = 2.2
"""Between the lines of a section, mm."""
ABOVE, BELOW = 16.0, 13.0
"""Room for the name and the dimensions of a section, mm."""


def depth(blank: Blank) -> float:
    """From the front face to the back of the hub, m."""
    return blank.thickness + (blank.hub_length if blank.hub_diameter else 0.0)


def section_height(blank: Blank, scale: float) -> float:
    """On the paper with its dimensions, mm."""
    return depth(blank) / mm * scale + ABOVE + BELOW


def draw_section(view: View, blank: Blank, walls: Sequence[Sequence[float]], words: Words, way: int) -> None:
    """The cut along angle 0 from its front face, the height 0 of the view, back: upwards (``way`` +1) or down (-1).

    ``walls`` are the radii that it meets at 0 and at 180 deg, m: the sides of a groove and, the last, the rim.
    """
    halves = [_half(blank, radii, side) for radii, side in zip(walls, (1, -1), strict=True)]
    outlines = halves if blank.bore else [[*halves[0], *halves[1][::-1]]]
    for corners in outlines:
        drawn = view.at(np.array(corners).T * np.array([[1.0], [way]]))
        view.paper.polygon(list(drawn.T), "visible", name="SECTION")
        for start, end in hatching(drawn):
            view.paper.line(start, end, "hatch")
    _behind(view, blank, way)
    _dimensions(view, blank, walls, words, way)


def _key_side(blank: Blank) -> int:
    """On which side of the axis the cut runs through the keyway, +1 or -1; 0: on none."""
    if blank.keyway is None or abs(np.sin(blank.key_angle)) > 1e-9:
        return 0
    return int(np.sign(np.cos(blank.key_angle)))


def _inner(blank: Blank, side: int) -> float:
    """Where the material begins on a side of the axis, m."""
    keyway = blank.keyway
    return blank.bore / 2 + (keyway.depth if keyway is not None and _key_side(blank) == side else 0.0)


def _half(blank: Blank, radii: Sequence[float], side: int) -> list[tuple[float, float]]:
    """Corners of the cut on one side of the axis: along the radius, and back from the front face, m."""
    *groove, rim = radii
    corners = [(_inner(blank, side), 0.0)]
    for i, radius in enumerate(groove):
        into = (0.0, blank.groove_depth)
        corners += [(radius, z) for z in (into if i % 2 == 0 else into[::-1])]
    corners += [(rim, 0.0), (rim, blank.thickness)]
    if blank.hub_diameter:
        corners += [(blank.hub_diameter / 2, z) for z in (blank.thickness, depth(blank))]
    corners.append((_inner(blank, side), depth(blank)))
    return [(side * r, z) for r, z in corners]


def hatching(corners: Array) -> Iterator[tuple[Array, Array]]:
    """Lines at 45 degrees, `HATCH` apart, within a polygon ``(2, k)`` on the paper.

    >>> square = np.array([[0.0, 30.0, 30.0, 0.0], [0.0, 0.0, 30.0, 30.0]])
    >>> bool(abs(sum(np.hypot(*(end - start)) for start, end in hatching(square)) * HATCH / 900 - 1) < 0.02)
    True
    """
    along, aside = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2)
    start, end = corners, np.roll(corners, -1, axis=1)
    low, high = np.sort(aside @ corners)[[0, -1]]
    for level in np.arange(np.ceil(low / HATCH), high / HATCH) * HATCH:
        before, after = aside @ start - level, aside @ end - level
        cut = (before < 0) != (after < 0)
        share = before[cut] / (before[cut] - after[cut])
        places = np.sort(along @ (start[:, cut] + share * (end - start)[:, cut]))
        for first, last in zip(places[::2], places[1::2], strict=True):
            yield first * along + level * aside, last * along + level * aside


def _behind(view: View, blank: Blank, way: int) -> None:
    """What is seen behind the cut: the ends of the bore and the edge of the keyway; and the axis."""
    back, over = depth(blank), 4 * mm / view.scale
    if blank.bore:
        for z in (0.0, back):
            view.line((-_inner(blank, -1), way * z), (_inner(blank, 1), way * z), "visible")
    if blank.keyway is not None and (side := _key_side(blank)):
        edge = side * np.sqrt((blank.bore / 2) ** 2 - (blank.keyway.width / 2) ** 2)
        view.line((edge, 0.0), (edge, way * back), "visible")
    view.line((0.0, -way * over), (0.0, way * (back + over)), "centre")


def _dimensions(view: View, blank: Blank, walls: Sequence[Sequence[float]], words: Words, way: int) -> None:
    """Thickness, hub and, where no detail shows it, bore."""
    paper, (x0, front) = view.paper, view.centre
    middle, back = (front - way * view.length(z) for z in (blank.thickness, depth(blank)))
    right, left = x0 + view.length(walls[0][-1]), x0 - view.length(walls[1][-1])
    upright(paper, (front, middle), right, right + 8, words.length(blank.thickness))
    if blank.hub_diameter:
        hub = view.length(blank.hub_diameter / 2)
        upright(paper, (middle, back), x0 - hub, left - 8, words.length(blank.hub_length))
        across(paper, x0 - hub, x0 + hub, back, back - way * 6, f"Ø{words.length(blank.hub_diameter)}")
    if blank.bore and blank.keyway is None:
        bore = view.length(blank.bore / 2)
        across(paper, x0 - bore, x0 + bore, front, front + way * 7, words.bore(blank))
        datum(paper, (x0 + bore / 2, front + way * 7))


def draw_detail(paper: Paper, box: Box, blank: Blank, words: Words) -> float:
    """The bore with its keyway pointing up, as large as a box allows, with its dimensions; its scale."""
    keyway = blank.keyway
    assert keyway is not None
    radius, half = blank.bore / 2, keyway.width / 2
    scale = largest_scale((blank.bore, blank.bore + keyway.depth), (box.width - 36, box.height - 32))
    x, y = box.left + 12 + in_unit(radius, "mm") * scale, box.top + 16 + in_unit(radius + keyway.depth, "mm") * scale
    view = View(paper, (x, y), scale)
    draw_bore(view, blank, np.pi / 2)
    wide, out, side = (view.length(value) for value in (radius, radius + keyway.depth, half))
    paper.line((x - wide - 3, y), (x + wide + 3, y), "centre")
    paper.line((x, y + wide + 3), (x, y - out - 3), "centre")
    across(paper, x - side, x + side, y - out, y - out - 5, words.key_width(blank))
    upright(paper, (y - out, y + wide), x + side, x + wide + 8, words.key_reach(blank))
    across(paper, x - wide, x + wide, y, y + wide + 7, words.bore(blank))
    datum(paper, (x + wide / 2, y + wide + 7))
    return scale


def draw_bore(view: View, blank: Blank, key_angle: float) -> None:
    """The bore's circle with its keyway in a direction, one closed line."""
    if not blank.bore:
        return
    if blank.keyway is None:
        view.circle((0.0, 0.0), blank.bore / 2, "visible")
        return
    path = bore_path(blank.replace(key_angle=key_angle))
    view.paper.path(arcs_data(view.at(path.corners), path.bulges, True), "visible", name="BORE")
