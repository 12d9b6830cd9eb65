"""Things in space as seen on a turntable: no perspective, the vertical stays upright."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from .artists import PALE, area, line, text

NEAR = 10
"""Drawing order of what lies at the middle of a scene; nearer things come later."""


@dataclass(frozen=True)
class Turntable:
    """A scene around ``centre``, ``(3,)``, of size ``radius``, on ``ax``; the rows of ``frame`` are x, y and up."""

    ax: Axes
    frame: np.ndarray
    centre: np.ndarray
    radius: float
    depth: float
    """How far the floor lies below the centre."""
    azimuth: float
    elevation: float

    @cached_property
    def eye(self) -> np.ndarray:
        """Rows: to the right, up, towards the viewer; a view from azimuth and elevation.

        >>> Turntable(None, np.eye(3), np.zeros(3), 1.0, 1.0, 0.0, 0.0).eye.round(6).tolist()
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
        """
        sin, cos, up, flat = *_sin_cos(self.azimuth), *_sin_cos(self.elevation)
        right = np.array([-sin, cos, 0.0])
        above = np.array([-up * cos, -up * sin, flat])
        return np.stack([right, above, np.cross(right, above)]) @ self.frame

    def seen(self, points: Any) -> np.ndarray:
        """Where ``points`` ``(3, ...)`` are on the picture, and how near they are, ``(3, ...)``."""
        middle = self.centre.reshape(3, *(1 for _ in np.shape(points)[1:]))
        return np.tensordot(self.eye, np.asarray(points) - middle, 1)

    def look(self) -> None:
        """The window of the axes: a ball around the scene, and a little more floor."""
        self.ax.set(xlim=(-self.radius, self.radius), ylim=(-1.2 * self.radius, 0.96 * self.radius))

    def path(self, key: str, points: Any, **style: Any) -> Line2D:
        """A line through ``points`` ``(3, n)``."""
        return line(self.ax, key, *self.seen(points)[:2], **style)

    def link(self, key: str, ends: Any, width: float, **style: Any) -> None:
        """A thick line that parts what lies behind it."""
        x, y, near = self.seen(ends)
        order = NEAR + 4 * near.mean() / self.radius
        round_ends = {"solid_capstyle": "round", "label": "_"}
        line(self.ax, f"{key} edge", x, y, color="white", linewidth=width + 3, **round_ends).set_zorder(order - 0.01)
        line(self.ax, key, x, y, linewidth=width, **round_ends | style).set_zorder(order)

    def ball(self, key: str, point: Any, size: float, **style: Any) -> None:
        """A round mark at ``point`` ``(3,)``."""
        x, y, near = self.seen(point)
        order = NEAR + 4 * near / self.radius + 2.5  # above the links that it joins
        line(self.ax, key, [x], [y], linestyle="none", marker="o", markersize=size, **style).set_zorder(order)

    def arrow(self, key: str, start: Any, along: Any, **style: Any) -> None:
        """An arrow from ``start``, ``along`` being direction and length."""
        foot, tip = self.seen(start)[:2], self.seen(start + along)[:2]
        back, side = 0.22 * (foot - tip), 0.09 * (foot - tip)[::-1] * [1, -1]
        line(self.ax, key, *np.transpose([foot, tip, tip + back + side, tip, tip + back - side]), **style)

    def face(self, key: str, corners: Any, **style: Any) -> Any:
        """A filled polygon with ``corners`` ``(3, n)``."""
        return area(self.ax, key, self.seen(corners)[:2], **style)

    def words(self, key: str, point: Any, said: str, **style: Any) -> None:
        """A text at ``point`` ``(3,)``."""
        x, y, _ = self.seen(point)
        text(self.ax, key, float(x), float(y), said, **style)

    def axis(self, key: str, point: Any, along: Any, **style: Any) -> None:
        """A line through ``point``, ``along`` being direction and half its length."""
        self.path(key, np.stack([point - along, point + along], axis=1), linewidth=1.6, linestyle="-.", **style)

    def box(self, key: str, low: Any, high: Any, **style: Any) -> Line2D:
        """The edges of a box from corner ``low`` to corner ``high``."""
        corners = np.array(list(product(*zip(low, high, strict=True))))
        edges = [(a, b) for a in corners for b in corners if (a < b).sum() == 1 == (a != b).sum()]
        return self.path(key, np.concatenate([[a, b, [np.nan] * 3] for a, b in edges]).T, **style)

    def floor(self, key: str, step: float) -> None:
        """A square grid below the scene, with lines ``step`` apart."""
        ticks = np.arange(-np.floor(self.radius / step), np.floor(self.radius / step) + 1) * step
        ends = ticks[[0, -1]]
        lines = [[(t, ends[0]), (t, ends[1]), (np.nan, np.nan)] for t in ticks]
        flat = np.concatenate([*lines, *(np.array(one)[:, ::-1] for one in lines)]).T
        grid = self.frame.T @ np.vstack([flat, np.full(flat.shape[1], -self.depth)]) + self.centre[:, None]
        self.path(key, grid, color=PALE, linewidth=0.8, zorder=1, label="_")

    def shadow(self, key: str, points: Any, **style: Any) -> None:
        """The shadow of ``points`` ``(3, n)`` on the floor, light from straight above."""
        self.path(key, self.dropped(points), **{"color": PALE, "zorder": 2, "label": "_"} | style)

    def dropped(self, points: Any) -> np.ndarray:
        """``points`` ``(3, n)`` let fall to the floor."""
        up = self.frame[2][:, None]
        return points - up * (up.T @ (points - self.centre[:, None]) + self.depth)


def _sin_cos(angle: float) -> tuple[float, float]:
    return float(np.sin(angle)), float(np.cos(angle))
