"""Contours and regions of a grid as lines, words and outlines, which axes can move."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from contourpy import FillType, contour_generator
from numpy.typing import ArrayLike

from ..views.picture import Contour, LabelStyle, Line, Mark, MarkStyle, Picture, Polygon, Region, Text

NOTHING = np.full((2, 1), np.nan)
SIZE = 9.5
"""Of a name on a curve, points."""
LETTER, ROW = 7.2, 17.0
"""Width and height of a letter of such a name with what is clear around it, pixels of 100 an inch."""
PLACES = (0.30, 0.72, 0.50, 0.20)
"""How far along its curve a name stands if nothing is in its way there; contours take turns by their index."""


def level_curve(x: ArrayLike, y: ArrayLike, z: ArrayLike, level: float) -> np.ndarray:
    """Where ``z`` on a grid is ``level``, as one curve with ``nan`` between its pieces, ``(2, m)``."""
    pieces = contour_generator(x, y, np.ma.masked_invalid(z)).lines(level)
    return _joined([piece for piece in pieces if len(piece) > 1])


def region(x: ArrayLike, y: ArrayLike, z: ArrayLike, low: float, high: float) -> np.ndarray:
    """The outline of where ``z`` on a grid is from ``low`` to ``high``, ``nan`` between its pieces, ``(2, m)``."""
    generator: Any = contour_generator(x, y, np.ma.masked_invalid(z), fill_type=FillType.OuterOffset)
    points, offsets = generator.filled(low, high)
    return _joined([p[a:b] for p, o in zip(points, offsets, strict=True) for a, b in pairwise(o)])


def _joined(pieces: Sequence[Any]) -> np.ndarray:
    if not pieces:
        return NOTHING
    return np.concatenate([row for piece in pieces for row in (piece, NOTHING.T)])[:-1].T


def outlined(picture: Picture, size: np.ndarray) -> list[Mark]:
    """The marks of a picture, its contours and regions as simple ones, on axes of ``size`` pixels, 100 an inch.

    The names of curves lie above all contours; those of later ones choose their places first.
    """
    taken: list[np.ndarray] = []
    names: list[Text] = []
    above: list[Mark] = []
    marks: list[Mark] = []
    for mark in reversed(picture.marks):
        look: MarkStyle = {"role": mark.role, "index": mark.index, "label": mark.label, "opacity": mark.opacity}
        if isinstance(mark, Region):
            marks.append(Polygon(mark.key, *region(mark.x, mark.y, mark.z, mark.low, mark.high), **look))
        elif isinstance(mark, Contour):
            curves = [level_curve(mark.x, mark.y, mark.z, level) for level in mark.levels]
            marks.append(Line(mark.key, *_joined([c.T for c in curves]), stroke=mark.stroke, **look))
            names += _names(mark, curves, size, taken)
        else:
            (marks if marks else above).append(mark)
    return [*marks[::-1], *names[::-1], *above[::-1]]


def _names(mark: Contour, curves: Sequence[np.ndarray], size: np.ndarray, taken: list[np.ndarray]) -> Iterator[Text]:
    """Names of a contour where they are clear of the edges and of what is ``taken``; a sole one in any case."""
    share, sole = PLACES[mark.index % len(PLACES)], len(curves) == 1
    for i, (name, curve) in enumerate(zip(mark.names, curves, strict=bool(mark.names))):
        half = np.array([len(name) * LETTER, ROW]) / size / 2
        x, y = _place(mark, curve, share, half, taken, sole) if name else NOTHING[:, 0]
        if np.isfinite(x):
            role = "ink" if mark.role == "paper" else mark.role
            look: LabelStyle = {"role": role, "index": mark.index}
            yield Text(f"{mark.key} name {i}", x, y, name, size=SIZE, framed=sole, boxed=not sole, **look)


def _place(
    mark: Contour, curve: np.ndarray, share: float, half: np.ndarray, taken: list[np.ndarray], sole: bool
) -> np.ndarray:
    """A point about ``share`` along a curve for a name that reaches ``half`` (shares of the axes) each way."""
    points = curve[:, np.isfinite(curve).all(axis=0)]
    if points.shape[1] < 2:
        return NOTHING[:, 0]
    steps = np.hypot(*np.diff(points))
    way = np.concatenate([[0], np.cumsum(steps)]) / max(steps.sum(), 1e-300)
    shares = np.linspace(0.04, 0.96, 47)
    candidates = points[:, np.searchsorted(way, shares[np.argsort(abs(shares - share))])].T
    low, high = np.array([[np.min(v), np.max(v)] for v in (mark.x, mark.y)]).T
    seen = (candidates - low) / (high - low)
    clear = ((seen > half) & (seen < 1 - half)).all(-1)
    for middle, reach in taken:
        clear &= (abs(seen - middle) > half + reach).any(-1)
    if not (sole or clear.any()):
        return NOTHING[:, 0]
    i = int(np.argmax(clear))
    taken.append(np.array([seen[i], half]))
    return np.asarray(candidates[i])
