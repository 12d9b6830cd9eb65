"""The view of a barrel cam: its drum unrolled at the mean radius, from cam angle 0 to the end of the turn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...geometry import Disc
from ...quantities.types import Array
from ...units import mm
from .blank import Blank
from .contours import Contour
from .dimensions import Words, across, upright
from .subject import Subject
from .svg import Box
from .view import View

TICKS = (10, 30, 45, 60, 90, 180, 360)
"""Between the cam angles that are marked, deg."""
ABOVE, BELOW, BESIDE = 10.0, 20.0, 9.0
"""Room for words and dimensions, mm."""


@dataclass(frozen=True)
class Unrolled:
    """What is seen of one drum whose surface is laid flat: around it to the right, along its axis upwards."""

    subject: Subject
    curves: tuple[Contour, ...]
    blank: Blank
    words: Words
    zone: float = 0.0

    @cached_property
    def turn(self) -> float:
        """Around the drum at its mean radius, m; below 0 where cam angles grow to the left."""
        return float(self.subject.analysis.period[0])

    @property
    def sides(self) -> tuple[float, float]:
        """The left and the right end of the turn, m."""
        return min(0.0, self.turn), max(0.0, self.turn)

    @cached_property
    def rollers(self) -> list[tuple[Array, float]]:
        """Where the roller stands at cam angle 0, and its radius, m."""
        start = int(abs(self.subject.analysis.cam_angle).argmin())
        return [(b.at(start), float(b.radius)) for b in self.subject.analysis.bodies if isinstance(b, Disc)]

    @cached_property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest place of the drum along its axis, m."""
        guide = next(body.points[1] for body in self.subject.analysis.bodies if body.part == "guide")
        top = max(float(c.points[1].max()) for c in self.curves if c.layer != "PITCH")
        return float(guide.min()), max(float(guide.max()), top)

    @cached_property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, lowest and highest place of all that is seen, m."""
        points = np.hstack([curve.points for curve in self.curves])
        reach = [(c[0] - r, c[0] + r, c[1] - r, c[1] + r) for c, r in self.rollers]
        rows = np.array([(points[0].min(), points[0].max(), *self.ends), (*self.sides, *self.ends), *reach])
        return float(rows[:, 0].min()), float(rows[:, 1].max()), float(rows[:, 2].min()), float(rows[:, 3].max())

    @property
    def grooved(self) -> bool:
        return any(curve.layer == "GROOVE" for curve in self.curves)

    def draw(self, view: View) -> Box:
        """All lines and the dimensions of the drum; the box on the paper that they take."""
        left, right, low, high = self.extent
        (x0, y1), (x1, y0) = view.at(np.array([left, low])), view.at(np.array([right, high]))
        (start, end), (bottom, _) = view.at(np.array([(0.0, self.turn), self.ends]))
        for x in (0.0, self.turn):
            view.line((x, self.ends[0]), (x, self.ends[1]), "thin")
        for y in self.ends if self.grooved else self.ends[:1]:
            view.line((0.0, y), (self.turn, y), "visible")
        for curve in self.curves:
            view.curve(curve)
        for centre, radius in self.rollers:
            view.circle(centre, radius, "neighbour")
            for arm in np.eye(2) * (radius + 1.5 * mm / view.scale):
                view.line(centre - arm, centre + arm, "centre")
        step = next(step for step in TICKS if abs(end - start) * step / 360 > 11)
        for angle in range(0, 361, step):
            x = float(start + (end - start) * angle / 360)
            view.paper.line((x, bottom), (x, bottom + 2), "thin")
            view.paper.text((x, bottom + 6), f"{angle}°", 3.0, "middle")
        return Box(float(x0), float(y0), float(x1), float(y1))

    def dimension(self, view: View, box: Box) -> None:
        """Write the dimensions of the drum, and what runs in it, around the ``box`` of its lines."""
        (left, right), (bottom, top) = view.at(np.array([self.sides, self.ends]))
        length = abs(self.turn)
        around = f"{self.words.length(length)} around the mean radius R{self.words.length(length / 2 / np.pi)}"
        across(view.paper, float(left), float(right), float(bottom), float(bottom) + 14, around)
        if self.grooved:
            wide = self.words.length(float(np.ptp(self.ends)))
            upright(view.paper, (float(top), float(bottom)), float(right), box.right + 7, wide)
        view.paper.text((box.left, box.top - 3), self._said, 3.5)

    @property
    def _said(self) -> str:
        """Of the roller, and of the groove in which it runs."""
        said = []
        for _, radius in self.rollers:
            half = self.words.tolerance(self.subject.design, "roller_radius", radius)
            said.append(f"roller R{self.words.length(radius)}{self.words.plus_minus(half)} at cam angle 0°")
            if self.grooved:
                depth = self.words.length(self.subject.analysis.cam.groove_depth)
                said.append(f"groove {self.words.length(2 * radius)} wide, {depth} deep")
        return "; ".join(said)
