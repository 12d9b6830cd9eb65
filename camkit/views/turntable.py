"""Things in space as seen on a turntable: no perspective, the vertical stays upright; nearer things lie above."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..geometry import dot
from ..quantities.types import Array, Value
from .picture import Axes, Line, LineStyle, Mark, MarkStyle, Picture, Points, Polygon, Text, gaps

SQUARES = 40
"""No floor has more squares each way from its middle."""
NEAR = 10.0
"""Height in the drawing of what lies at the middle of a scene; nearer things come later, flat things before."""


def turned(rows: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """The product of a matrix ``(3, 3)`` and vectors ``(3, ...)``."""
    return (rows.reshape(3, 3, *(1 for _ in vectors.shape[1:])) * vectors).sum(1)


@dataclass(frozen=True)
class Turntable:
    """A scene around ``centre``, ``(3,)``, of size ``radius``; the rows of ``frame`` are x, y and up."""

    frame: np.ndarray
    centre: np.ndarray
    radius: Value
    depth: Value
    """How far the floor lies below the centre."""
    azimuth: Value
    elevation: Value
    drawn: list[Mark] = field(default_factory=list)
    """Marks so far, nearer things higher."""

    @cached_property
    def eye(self) -> np.ndarray:
        """Rows: to the right, up, towards the viewer; a view from azimuth and elevation.

        >>> Turntable(np.eye(3), np.zeros(3), 1.0, 1.0, 0.0, 0.0).eye.round(6).tolist()
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
        """
        sin, cos = np.sin(self.azimuth), np.cos(self.azimuth)
        up, flat = np.sin(self.elevation), np.cos(self.elevation)
        right = np.stack([-sin, cos, 0.0])
        above = np.stack([-up * cos, -up * sin, flat])
        return turned(np.stack([right, above, np.cross(right, above)]), self.frame)

    def seen(self, points: ArrayLike) -> np.ndarray:
        """Where ``points`` ``(3, ...)`` are on the picture, and how near they are, ``(3, ...)``."""
        middle = self.centre.reshape(3, *(1 for _ in np.shape(points)[1:]))
        return turned(self.eye, points - middle)

    def picture(self, axes: Axes, *more: Mark) -> Picture:
        """What has been put on the table, nearer things above, with ``more`` above all."""
        return Picture.of(axes, self.drawn, (replace(mark, height=np.inf) for mark in more))

    def put(self, height: float, mark: Mark) -> None:
        """Put a mark into the drawing at a height."""
        self.drawn.append(replace(mark, height=height))

    def height_of(self, near: Array) -> float:
        """How high in the drawing what lies ``near`` the viewer is."""
        return NEAR + 4 * np.mean(near) / self.radius

    def path(self, key: str, points: ArrayLike, at: float = 3.0, **style: Unpack[LineStyle]) -> None:
        """A line through ``points`` ``(3, n)``."""
        x, y, _ = self.seen(points)
        self.put(at, Line(key, x, y, **style))

    def bar(self, key: str, points: ArrayLike, **style: Unpack[LineStyle]) -> None:
        """A thick line through ``points`` ``(3, n)``, before what lies behind it."""
        x, y, near = self.seen(points)
        self.put(self.height_of(near), Line(key, x, y, **style))

    def link(self, key: str, ends: ArrayLike, **style: Unpack[MarkStyle]) -> None:
        """A thick line that parts what lies behind it."""
        x, y, near = self.seen(ends)
        self.put(self.height_of(near) - 0.01, Line(f"{key} edge", x, y, role="paper", stroke="solid"))
        self.put(self.height_of(near), Line(key, x, y, stroke="arm", **style))

    def ball(self, key: str, point: ArrayLike, size: float, fill: str = "full", **style: Unpack[MarkStyle]) -> None:
        """A round mark at ``point`` ``(3,)``, above the links that it joins."""
        x, y, near = self.seen(point)
        self.put(self.height_of(near) + 2.5, Points(key, x, y, size=size, fill=fill, **style))

    def arrow(self, key: str, start: Array, along: Array, **style: Unpack[LineStyle]) -> None:
        """An arrow from ``start``, ``along`` being direction and length."""
        foot, tip = self.seen(start)[:2], self.seen(start + along)[:2]
        back, side = 0.22 * (foot - tip), 0.09 * (foot - tip)[::-1] * np.array([1, -1])
        shaft = np.stack([foot, tip, tip + back + side, tip, tip + back - side], axis=1)
        self.put(18.0, Line(key, *shaft, **style))

    def face(
        self, key: str, corners: ArrayLike, at: float = 3.0, edged: bool = False, **style: Unpack[MarkStyle]
    ) -> None:
        """A filled polygon with ``corners`` ``(3, n)``."""
        x, y, _ = self.seen(corners)
        self.put(at, Polygon(key, x, y, edged=edged, **style))

    def words(self, key: str, point: ArrayLike, said: str, size: float = 10.0, bold: bool = False) -> None:
        """A text at ``point`` ``(3,)``."""
        x, y, _ = self.seen(point)
        self.put(19.0, Text(key, x, y, said, size=size, bold=bold))

    def axis(self, key: str, point: Array, along: Array, **style: Unpack[MarkStyle]) -> None:
        """A line through ``point``, ``along`` being direction and half its length."""
        self.path(key, np.stack([point - along, point + along], axis=1), at=4.0, stroke="dashdot", **style)

    def box(self, key: str, low: Array, high: Array, where: ArrayLike = True, **style: Unpack[LineStyle]) -> None:
        """The edges of a box from corner ``low`` to corner ``high``, if ``where`` holds."""
        corners = np.array(list(product(*zip(low, high, strict=True))))
        edges = [(i, i | axis) for i in range(8) for axis in (1, 2, 4) if not i & axis]
        path = np.concatenate([[corners[i], corners[j], [np.nan] * 3] for i, j in edges]).T
        self.path(key, gaps(path, where), **style)

    def floor(self, key: str, step: float) -> None:
        """A square grid below the scene, with lines ``step`` apart."""
        end = np.floor(self.radius / step) * step
        ticks = np.arange(-SQUARES, SQUARES + 1) * step
        across = np.repeat(gaps(ticks, abs(ticks) <= end), 3)
        along = np.tile(np.stack([-end, end, np.nan]), len(ticks))
        flat = np.concatenate([np.stack([across, along]), np.stack([along, across])], axis=1)
        below = np.broadcast_to(-self.depth, flat[:1].shape)
        grid = turned(self.frame.T, np.concatenate([flat, below])) + self.centre[:, None]
        self.path(key, grid, at=1.0, role="body")

    def shadow(self, key: str, points: ArrayLike) -> None:
        """The shadow of ``points`` ``(3, n)`` on the floor, light from straight above."""
        self.path(key, self.dropped(points), at=2.0, role="body", stroke="arm")

    def dropped(self, points: ArrayLike) -> np.ndarray:
        """``points`` ``(3, n)`` let fall to the floor."""
        up = self.frame[2][:, None]
        return points - up * (dot(up, points - self.centre[:, None]) + self.depth)
