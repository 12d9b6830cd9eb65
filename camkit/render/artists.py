"""Draws a picture on matplotlib's axes: the first time anew, the next time by moving what is there.

Each mark is one artist, known by the mark's key.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.ticker import NullLocator

from ..geometry import circle
from ..quantities.markup import letters
from ..quantities.types import Value
from ..views import picture as shown
from .contours import outlined
from .roles import ROLES, STROKES, colour, letter_colour

Patch = shown.Band | shown.Area | shown.Polygon
FORMS = {"dot": "o", "plus": "+", "cross": "x", "star": "*", "square": "s", "diamond": "D", "triangle": "^"}


def theme_style(theme: str = "light") -> Any:
    """Matplotlib's settings for pictures of a theme; ``matplotlib.rc_context(theme_style())`` around one's own."""
    ink, guide, pale, paper = (getattr(ROLES[name], theme) for name in ("ink", "guide", "body", "paper"))
    return {
        "font.size": 11,
        "font.family": "DejaVu Sans",
        "text.color": ink,
        "axes.titlesize": 11.5,
        "axes.titleweight": "bold",
        "axes.titlelocation": "left",
        "axes.titlecolor": ink,
        "axes.labelsize": 11,
        "axes.labelcolor": ink,
        "axes.edgecolor": guide,
        "axes.facecolor": paper,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": pale,
        "grid.linewidth": 0.8,
        "xtick.color": ink,
        "ytick.color": ink,
        "xtick.labelsize": 10,
        "ytick.labelsize": 10,
        "legend.fontsize": 9.5,
        "legend.frameon": False,
        "legend.handlelength": 1.2,
        "lines.linewidth": 1.9,
        "figure.facecolor": paper,
    }


def plain(words: object) -> str:
    """Text that is drawn letter by letter: matplotlib reads what stands between two dollars as a formula.

    Symbols and powers in it are written as in the literature: α, l₁, mm².

    >>> print(plain("5 $ or 6 $"))
    5 \\$ or 6 \\$
    """
    return words if isinstance(words, shown.Formula) else letters(str(words)).replace("$", r"\$")


def moving(ax: Axes) -> list[Artist]:
    """Everything on ``ax`` that was drawn with a key, lowest first."""
    found = [artist for artist in (*ax.patches, *ax.lines, *ax.texts) if artist.get_gid()]
    return sorted(found, key=lambda artist: artist.get_zorder())


def artist_of(ax: Axes, key: str) -> Artist | None:
    """The artist of the mark ``key``, if there is one."""
    return next((artist for artist in moving(ax) if artist.get_gid() == key), None)


def draw_picture(picture: shown.Picture, ax: Axes, theme: str = "light") -> None:
    """``picture`` on ``ax``: marks that are there already move, others appear, those that are gone disappear."""
    there = {artist.get_gid(): artist for artist in moving(ax)}
    box = ax.get_window_extent()
    marks = outlined(picture, np.array([box.width, box.height]) * 100 / ax.figure.dpi)
    for gone in there.keys() - {mark.key for mark in marks}:
        there[gone].remove()
    for order, mark in enumerate(sorted(marks, key=lambda mark: float(mark.height))):
        _put(ax, mark, there.get(mark.key), theme).set_zorder(2.6 + 0.002 * order)
    _frame(ax, picture.axes)
    _legend(ax, picture)


def _put(ax: Axes, mark: shown.Mark, artist: Any, theme: str) -> Artist:
    """The artist of ``mark``, made or moved."""
    style = {"alpha": mark.opacity, "label": plain(mark.label) if mark.label else f"_{mark.key}"}
    if isinstance(mark, shown.Text):
        return _put_text(ax, mark, artist, {**style, "color": letter_colour(mark.role, mark.index, theme)}, theme)
    tint = colour(mark.role, mark.index, theme)
    if isinstance(mark, Patch):
        return _put_patch(ax, mark, artist, {**style, "facecolor": tint, **_edge(mark, tint)})
    x, y = _places(mark)
    if artist is None:
        (artist,) = ax.plot(x, y, gid=mark.key)
    else:
        artist.set_data(x, y)
    artist.set(**style, **_stroke(mark, tint, theme))
    return artist


def _places(mark: Any) -> tuple[np.ndarray, np.ndarray]:
    """Points of a line, places of points, a circle's outline."""
    if isinstance(mark, shown.Circle):
        x, y = circle((mark.x, mark.y), mark.radius)
        return np.asarray(x), np.asarray(y)
    x, y = np.broadcast_arrays(np.atleast_1d(mark.x), np.atleast_1d(mark.y))
    return x, y


def _stroke(mark: shown.Mark, tint: str, theme: str) -> dict[str, object]:
    """Width and dashes of a line, form and size of points."""
    if isinstance(mark, shown.Points):
        inside = {"full": tint, "paper": colour("paper", theme=theme), "none": "none"}[mark.fill]
        form = {"marker": FORMS[mark.mark], "markersize": mark.size, "markeredgewidth": _rim(mark)}
        return {"linestyle": "none", "color": tint, "markerfacecolor": inside, **form}
    role = ROLES[mark.role]
    style: dict[str, object] = {"color": tint, "linewidth": role.width, "linestyle": role.dashes}
    for name in getattr(mark, "stroke", "").split():
        style |= STROKES[name]
    return style | ({"drawstyle": "steps-post"} if getattr(mark, "steps", False) else {})


def _rim(mark: shown.Points) -> float:
    return 0.0 if mark.fill == "full" and mark.mark not in ("plus", "cross") else 2.0 if mark.size > 6 else 1.2


def _edge(mark: shown.Mark, tint: str) -> dict[str, object]:
    edged = getattr(mark, "edged", isinstance(mark, shown.Band))
    return {"edgecolor": tint if edged else "none", "linewidth": ROLES[mark.role].width if edged else 0.0}


def _put_patch(ax: Axes, mark: Patch, artist: Any, style: dict[str, Any]) -> Artist:
    corners = _corners(mark)
    if artist is None:
        over = {"x": ax.get_yaxis_transform, "y": ax.get_xaxis_transform}
        place = {"transform": over[mark.along]()} if isinstance(mark, shown.Band) else {}
        artist = ax.add_artist(Polygon(corners, closed=True, gid=mark.key, **place))
    along = getattr(mark, "along", "")
    ax.update_datalim(corners, updatex=along != "x", updatey=along != "y")  # add_patch would look at every corner
    artist.set_xy(corners)
    if isinstance(mark, shown.Band):
        style |= {"facecolor": (*to_rgb(style["facecolor"]), mark.opacity), "alpha": None}
    artist.set(**style)
    return artist


def _corners(mark: Patch) -> np.ndarray:
    """The outline of a patch, ``(m, 2)``; a band's ends lie just outside the axes, where no edge shows."""
    if isinstance(mark, shown.Polygon):
        return np.stack([np.asarray(mark.x, dtype=float), np.asarray(mark.y, dtype=float)], axis=-1)
    if isinstance(mark, shown.Area):
        x, low, high = (np.asarray(v, dtype=float) for v in (mark.x, mark.low, mark.high))
        return np.stack([np.append(x, x[::-1]), np.append(low, high[::-1])], axis=-1)
    ends, across = np.array([-0.05, 1.05, 1.05, -0.05]), np.array([mark.low, mark.low, mark.high, mark.high])
    return np.stack([ends, across] if mark.along == "x" else [across, ends], axis=-1)


def _put_text(ax: Axes, mark: shown.Text, artist: Any, style: dict[str, object], theme: str) -> Artist:
    if artist is None:
        artist = ax.text(0, 0, "", gid=mark.key, clip_on=False)
    if mark.boxed or mark.framed:
        edge = style["color"] if mark.framed else "none"
        artist.set_bbox({"facecolor": colour("paper", theme=theme), "edgecolor": edge, "pad": 1.2, "alpha": 0.85})
    if mark.framed:
        style["color"] = colour("ink", theme=theme)
    words = mark.words if isinstance(mark.words, shown.Formula) else plain(mark.words)
    at = mark.anchor.split()
    across = next((a for a in at if a in ("left", "right")), "center")
    upright = next((a for a in at if a in ("top", "bottom")), "center")
    seen = np.isfinite(np.append(mark.x, mark.y)).all()
    place = (mark.x, mark.y) if seen else (1.0, 1.0)
    artist.set(position=place, text=words if seen else "", ha=across, va=upright, fontsize=mark.size, **style)
    artist.set_fontweight("bold" if mark.bold else "normal")
    return artist


def _frame(ax: Axes, axes: shown.Axes) -> None:
    """Title, labels, scales and window; few ticks: text takes three quarters of a drawing's time."""
    ax.set_title(plain(axes.title), loc="left")
    ax.set_xlabel(plain(axes.xlabel))
    ax.set_ylabel(plain(axes.ylabel))
    _scale(ax, "x", axes.log, axes.xticks, axes.xlim)
    _scale(ax, "y", axes.log, axes.yticks, axes.ylim)
    if axes.equal:
        ax.set_aspect("equal", adjustable="box" if axes.bare or axes.xlim is not None else "datalim")
    if not axes.grid:
        ax.grid(visible=False)
    if axes.bare:
        ax.set_axis_off()


def _scale(
    ax: Axes,
    name: Literal["x", "y"],
    log: str,
    ticks: Mapping[float, str] | None,
    ends: tuple[Value | None, Value | None] | None,
) -> None:
    """Scale, ticks and ends of the axis ``name``."""
    kind = "log" if name in log else "linear"
    if getattr(ax, f"get_{name}scale")() != kind:
        getattr(ax, f"set_{name}scale")(kind)
    if ticks is not None:
        getattr(ax, f"set_{name}ticks")(list(ticks), [plain(words) for words in ticks.values()])
        getattr(ax, f"{name}axis").set_minor_locator(NullLocator())
        ax.grid(axis=name, visible=False)
    elif kind == "linear":
        ax.locator_params(axis=name, nbins=5)
    if ends is not None:
        getattr(ax, f"set_{name}lim")(*ends)


LETTER, BOLD, SAMPLE = 6.3, 9.1, 33.0
"""Pixels, of 100 an inch, that a letter of the legend and of the title takes, and the sample before a name."""
LARGEST_SAMPLE = 11.0
"""No mark is larger in the legend, points."""


def _legend(ax: Axes, picture: shown.Picture) -> None:
    """Labelled marks in one row above the axes if there is room beside the title, else below; no curve meets them."""
    labels = list(dict.fromkeys(plain(mark.label) for mark in picture.marks if mark.label))
    legend = ax.get_legend()
    if set(labels) == {text.get_text() for text in (legend.get_texts() if legend else ())}:
        return
    if legend:
        legend.remove()
    if labels:
        named = {artist.get_label(): artist for artist in reversed(moving(ax))}
        legend = ax.legend(handles=[named[label] for label in labels], **_place(ax, picture.axes, labels))
        for sample in legend.legend_handles:
            if isinstance(sample, Line2D):
                sample.set_markersize(min(sample.get_markersize(), LARGEST_SAMPLE))


def _place(ax: Axes, axes: shown.Axes, labels: Sequence[str]) -> dict[str, Any]:
    room = 1.1 * ax.get_window_extent().width * 100 / ax.figure.dpi  # the layout to come widens them a little
    row = sum(map(len, labels)) * LETTER + SAMPLE * len(labels)
    if not axes.equal and row + BOLD * len(axes.title) < room:
        spaces = {"columnspacing": 0.9, "handletextpad": 0.4, "borderaxespad": 0.1}
        return {"loc": "lower right", "bbox_to_anchor": (1.02, 0.99), "ncols": len(labels), **spaces}
    columns = next((n for n in range(len(labels), 1, -1) if _width(labels, n) < room), 1)
    below = 1.0 if axes.bare else 4.2 if axes.xlabel else 2.6
    return {
        "loc": "upper center",
        "bbox_to_anchor": (0.5, 0),
        "borderaxespad": below,
        "ncols": columns,
        "columnspacing": 1.2,
    }


def _width(labels: Sequence[str], columns: int) -> float:
    """Of a legend with so many columns, each as wide as its longest label, pixels."""
    return sum(LETTER * max(map(len, part)) + SAMPLE + 9 for part in np.array_split(labels, columns))
