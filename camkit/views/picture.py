"""A picture as data: axes, and marks with roles.  A view makes one of an analysis, a renderer draws it.

A mark has a key, by which a renderer moves it when the picture changes, and a role, which says what it means: colours
and widths belong to the renderer.  Marks are drawn in their order, later ones above.  What has a label is named in
the legend.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import wrap
from typing import Any, Self, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ..quantities.types import Array, Value

ROLES = (
    "ink",  # what is read: letters, the design in hand, edges
    "paper",  # the background, to part what crosses
    "onto",  # what is written on the colour of a series
    "guide",  # lines that help to read: axes, circles, zero
    "ghost",  # what was, or what is left out
    "body",  # a solid, filled
    "profile",  # what is cut, or the curve that the picture is about
    "flank",  # the other side of a groove
    "pitch",  # the way of a roller's centre
    "follower",  # what is moved
    "position",
    "velocity",
    "acceleration",
    "jerk",
    "limit",  # what must not be crossed
    "allowed",  # where limits are kept; what is known to be right
    "trouble",  # what misses a limit or cannot be made
    "series",  # one of several alike things, by its index
)
"""What a mark may mean."""


class Colour(TypedDict, total=False):
    """What a mark is, by which a renderer knows its colour."""

    role: str
    index: int


class LabelStyle(Colour, total=False):
    """And its name in the legend."""

    label: str


class MarkStyle(LabelStyle, total=False):
    """Options that every mark has."""

    opacity: float


class LineStyle(MarkStyle, total=False):
    """Those of a line."""

    stroke: str


class Formula(str):
    """Text between dollars that is meant as a formula."""

    __slots__ = ()


@dataclass(frozen=True, kw_only=True)
class Axes:
    """How a picture is framed: its title, what its axes show, in which window."""

    title: str = ""
    xlabel: str = ""
    ylabel: str = ""
    equal: bool = False
    """Whether both axes have one scale."""
    xlim: tuple[Value | None, Value | None] | None = None
    ylim: tuple[Value | None, Value | None] | None = None
    """Ends of an axis, either of which may be ``None``; without them the axis fits what is drawn."""
    log: str = ""
    """The axes with a logarithmic scale: "x", "y" or "xy"."""
    xticks: Mapping[float, str] | None = None
    yticks: Mapping[float, str] | None = None
    """Places with their names, instead of numbers."""
    grid: bool = True
    """Whether lines cross the picture at the numbers of its scales."""
    bare: bool = False
    """Whether there are neither scales nor frame."""


@dataclass(frozen=True)
class Mark:
    """What all marks share; places are in the units of the axes."""

    key: str
    role: str = field(kw_only=True, default="ink")
    index: int = field(kw_only=True, default=0)
    """Of a "series"."""
    label: str = field(kw_only=True, default="")
    """Its name in the legend."""
    opacity: float = field(kw_only=True, default=1.0)
    height: float = field(kw_only=True, default=0.0)
    """Marks of a larger one lie above, whatever their order."""


@dataclass(frozen=True)
class Line(Mark):
    """A curve through points; ``nan`` parts it."""

    x: ArrayLike
    y: ArrayLike
    stroke: str = field(kw_only=True, default="")
    """How it is drawn, if not as its role: "thin", "dashed", "dotted", "bold", "arm", "bar", or two of them."""
    steps: bool = field(kw_only=True, default=False)
    """Whether each value holds up to the next place."""
    shaped: bool = field(kw_only=True, default=False)
    """Whether it is the acceleration of a follower, on which a page has a handle for each coefficient of a law."""


@dataclass(frozen=True)
class Band(Mark):
    """All between two values of one axis; a line where they are equal."""

    low: ArrayLike
    high: ArrayLike
    along: str = field(kw_only=True, default="x")
    """The axis along which it runs, from end to end; the values are of the other one."""


@dataclass(frozen=True)
class Area(Mark):
    """All between two curves over the same places."""

    x: ArrayLike
    low: ArrayLike
    high: ArrayLike


@dataclass(frozen=True)
class Polygon(Mark):
    """A filled outline; ``nan`` parts it."""

    x: ArrayLike
    y: ArrayLike
    edged: bool = field(kw_only=True, default=False)


@dataclass(frozen=True)
class Contour(Mark):
    """Where values on a grid are one of several levels: ``z`` ``(m, n)`` over ``x`` ``(n,)`` and ``y`` ``(m,)``."""

    x: ArrayLike
    y: ArrayLike
    z: ArrayLike
    levels: Sequence[float] | np.ndarray
    names: tuple[str, ...] = field(kw_only=True, default=())
    """Written on the curves, one for each level; of several levels those that find room."""
    stroke: str = field(kw_only=True, default="")


@dataclass(frozen=True)
class Region(Mark):
    """Where values on a grid, as of a `Contour`, are between two levels."""

    x: ArrayLike
    y: ArrayLike
    z: ArrayLike
    low: float
    high: float


@dataclass(frozen=True)
class Points(Mark):
    """Marks of one kind."""

    x: ArrayLike
    y: ArrayLike
    mark: str = field(kw_only=True, default="dot")
    """Its form: "dot", "plus", "cross", "star", "square", "diamond", "triangle"."""
    size: float = field(kw_only=True, default=8.0)
    """Its diameter on the page, points (1/72 inch)."""
    fill: str = field(kw_only=True, default="full")
    """Inside: "full", "paper" or "none"."""
    names: tuple[str, ...] | None = field(kw_only=True, default=None)
    """What is said of each of them under the pointer, if something is."""


@dataclass(frozen=True)
class Circle(Mark):
    """A circle that is to scale; a knife edge, whose radius is 0, is a point."""

    x: Value
    y: Value
    radius: Value


@dataclass(frozen=True)
class Text(Mark):
    """Words at a place; at ``nan`` they are not shown."""

    x: Value
    y: Value
    words: str
    anchor: str = field(kw_only=True, default="")
    """Which part of the words is at the place: "left" or "right", "top" or "bottom", or both; else the middle."""
    size: float = field(kw_only=True, default=10.0)
    bold: bool = field(kw_only=True, default=False)
    boxed: bool = field(kw_only=True, default=False)
    """Whether the background is kept clear behind them."""
    framed: bool = field(kw_only=True, default=False)
    """Whether a box around them has the colour of the role, and the words that of ink."""


@dataclass(frozen=True)
class Picture:
    """Axes, and marks in the order in which they are drawn."""

    axes: Axes
    marks: tuple[Mark, ...]

    @classmethod
    def of(cls, axes: Axes, *marks: Mark | Iterable[Mark]) -> Self:
        """A picture of ``marks``, one by one or several at once."""
        return cls(axes, tuple(m for some in marks for m in ((some,) if isinstance(some, Mark) else some)))

    def __post_init__(self) -> None:
        keys = [mark.key for mark in self.marks]
        if len(set(keys)) < len(keys):
            twice = next(key for key in keys if keys.count(key) > 1)
            raise ValueError(f"two marks of a picture have the key {twice!r}; each needs its own")
        for mark in self.marks:
            if mark.role not in ROLES:
                raise ValueError(f"the mark {mark.key!r} has the role {mark.role!r}; it must be one of {ROLES}")

    def __getitem__(self, key: str) -> Any:
        """The mark with that key.

        >>> Picture.of(Axes(), Points("here", [1.0], [2.0]))["here"].y
        [2.0]
        """
        for mark in self.marks:
            if mark.key == key:
                return mark
        raise KeyError(key)

    def __contains__(self, key: str) -> bool:
        return any(mark.key == key for mark in self.marks)


View = Callable[..., Picture]
"""``view(analysis) -> Picture``; it may ask for ``turn``, ``azimuth``, ``elevation`` (rad) and ``limits`` by name."""


def gaps(values: ArrayLike, where: ArrayLike) -> Array:
    """``values`` with ``nan`` where ``where`` does not hold, so that a curve shows there only."""
    return np.where(where, values, np.nan)


def in_lines(words: str, width: int, most: int) -> str:
    """Words in at most so many lines of ``width`` letters; where there are too many, some in the middle are left out.

    >>> in_lines("maximum pressure angle of the worse curve, lift", 16, 2).splitlines()
    ['maximum pressure', '… curve, lift']
    """
    every = words.split()
    for gone in range(max(len(every) - 1, 1)):
        start = (len(every) - gone + 1) // 2
        kept = [*every[:start], "…", *every[start + gone :]] if gone else every
        lines = wrap(" ".join(kept), width, break_long_words=False)
        if len(lines) <= most:
            break
    return "\n".join(lines)


def joined(pieces: Array) -> np.ndarray:
    """Outlines ``(k, corners, 2)`` as one, each closed, with ``nan`` between them, ``(2, m)``."""
    gap = np.full((len(pieces), 1, 2), np.nan)
    return np.asarray(np.concatenate([pieces, np.asarray(pieces)[:, :1], gap], axis=1).reshape(-1, 2)[:-1].T)
