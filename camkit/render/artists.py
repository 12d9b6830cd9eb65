"""Curves that can be drawn once and moved afterwards.

Each is known by a key: the first call draws it, every later call with the same key on the same axes moves it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from ..views.picture import Formula as Formula
from ..views.picture import gaps as gaps
from .draw import drawn as drawn
from .draw import moving as moving
from .draw import plain as plain
from .draw import theme_style

INK = "#1f2933"
GREY = "#7b8794"
PALE = "#e4e7eb"
BLUE = "#0072B2"
ORANGE = "#E69F00"
GREEN = "#009E73"
SKY = "#56B4E9"
PURPLE = "#CC79A7"
WARNING = "#D55E00"
COLOURS = (BLUE, ORANGE, GREEN, PURPLE, SKY)
"""Okabe and Ito's colour-blind-safe palette; vermilion is kept for warnings."""


def colours(n: int, first: Sequence[str] = COLOURS) -> list[str]:
    """``n`` colours that differ: ``first``, then darker and paler shades of them, and so on from the beginning.

    >>> len(set(colours(15)))
    15
    """
    shades = [*first]
    for towards, share in ((0.0, 0.45), (1.0, 0.5), (0.0, 0.7)):
        shades += [_mixed(colour, towards, share) for colour in first]
    return [shades[i % len(shades)] for i in range(n)]


def _mixed(colour: str, towards: float, share: float) -> str:
    red, green, blue = ((1 - share) * c + share * towards for c in to_rgb(colour))
    return to_hex((red, green, blue))


STYLE = theme_style()
_find = drawn


def new(ax: Axes) -> bool:
    """Whether nothing has been drawn on ``ax`` yet, so that labels and bands are still to come."""
    return not moving(ax)


def line(ax: Axes, key: str, x: Any, y: Any, **style: Any) -> Line2D:
    """A curve known as ``key``."""
    found = _find(ax, key)
    if found is None:
        if "label" in style:
            style["label"] = plain(style["label"])
        (found,) = ax.plot(x, y, gid=key, **style)
    else:
        found.set_data(x, y)
    return found


def area(ax: Axes, key: str, points: Any, **style: Any) -> Polygon:
    """A filled polygon known as ``key``; ``points`` are ``(2, n)``."""
    found = _find(ax, key)
    if found is None:
        found = ax.add_patch(Polygon(np.transpose(points), closed=True, gid=key, **style))
    else:
        found.set_xy(np.transpose(points))
    return found


def text(ax: Axes, key: str, x: float, y: float, words: str, **style: Any) -> Any:
    """A text known as ``key``."""
    found = _find(ax, key)
    if found is None:
        return ax.text(x, y, plain(words), gid=key, **style)
    found.set_position((x, y))
    found.set_text(plain(words))
    return found


def frame(ax: Axes, title: str, xlabel: str, ylabel: str) -> None:
    """Title and axis labels, and few ticks: text takes three quarters of a drawing's time."""
    if ax.get_xscale() == ax.get_yscale() == "linear":
        ax.locator_params(nbins=5)
    ax.set_title(plain(title))
    ax.set_xlabel(plain(xlabel))
    ax.set_ylabel(plain(ylabel))


def beside_title(ax: Axes, handles: Any = None) -> None:
    """The legend in one row above the axes, where no curve can meet it."""
    handles = handles or ax.get_legend_handles_labels()[0]
    place: Any = {"loc": "lower right", "bbox_to_anchor": (1.02, 0.99), "borderaxespad": 0.1}
    ax.legend(handles=handles, ncols=len(handles), columnspacing=0.9, handletextpad=0.4, **place)
