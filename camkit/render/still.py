"""Several views in one figure."""

from __future__ import annotations

import inspect
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from ..quantities import Analysable, Measure, refuse_design, refuse_population
from ..quantities.applied import applied
from ..quantities.kinds import a_number, refuse_arguments
from ..study.study import refuse_limits
from ..units import deg
from ..views.defaults import default_views
from ..views.picture import Picture, View
from .artists import draw_picture, theme_style
from .positions import given_to, made_by, view_name

LARGEST = 100
"""No figure is wider or higher, inches."""
HEIGHT, ROW = 7.0, 2.7
"""Of a figure whose height nobody gave, inches: with up to seven views, and for each row of one with more."""
ACROSS = {
    1: [slice(0, 4)],
    2: [slice(0, 2), slice(2, 4)],
    3: [slice(0, 2), slice(2, 3), slice(3, 4)],
    4: [slice(i, i + 1) for i in range(4)],
}
"""Of four columns, those of each of so many pictures in a row."""
STRIP = {"left": 0.01, "right": 0.99, "bottom": 0.02, "top": 0.9, "wspace": 0.04}
"""Where pictures side by side stand, shares of the figure and of a picture's width."""


class Still(Figure):
    """A figure that shows itself in a notebook, as a small file; pyplot never sees it, so none is left behind."""

    def _repr_png_(self) -> bytes:
        return below(self)


def below(*figures: Figure) -> bytes:
    """Figures of the same width, each below the one before, as a PNG file of 256 colours; a white dot of none."""
    images = [*map(_pixels, figures)] or [Image.new("RGB", (1, 1), "white")]
    whole = Image.new("RGB", (images[0].width, sum(image.height for image in images)), "white")
    for i, image in enumerate(images):
        whole.paste(image, (0, sum(above.height for above in images[:i])))
    out = io.BytesIO()
    few_colours = whole.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)  # a third of the usual size
    few_colours.save(out, "PNG", optimize=True)
    return out.getvalue()


def _pixels(figure: Figure) -> Image.Image:
    """What a figure looks like; the fourth channel of its canvas, opaque, is not used."""
    with rc_context(theme_style()):
        figure.canvas.draw()
    buffer = figure.canvas.buffer_rgba()  # type: ignore[attr-defined]
    return Image.frombuffer("RGBX", buffer.shape[1::-1], buffer, "raw", "RGBX", 0, 1).convert("RGB")


def layout(
    views: Sequence[View], width: float = 12.6, height: float | None = None, dpi: int = 100
) -> tuple[Still, list[Axes]]:
    """A figure with one pair of axes for each view: the first large on the left, the others in two columns.

    More than seven go on below, up to four beside each other, in a higher figure (``height`` inches, if it is given).
    """
    if not views:
        raise ValueError("the picture needs one or more views")
    rest = len(views) - 1
    columns = 2 if rest > 3 else 1
    beside = rest if rest <= 6 else 4 if rest <= 8 else 6
    below = [len(part) for part in np.array_split(range(rest - beside), -(-(rest - beside) // 4))] if rest > 6 else []
    rows = max(1, -(-beside // columns))
    height = (ROW * (rows + len(below)) if below else HEIGHT) if height is None else height
    for name, size in (("width", width), ("height", height)):
        a_number(size, f"the {name} of the picture", f"be from 0.1 to {LARGEST} inches", lambda s: 0.1 <= s <= LARGEST)
    with rc_context(theme_style()):
        figure = Still(figsize=(width, height), dpi=dpi, layout="constrained")
        FigureCanvasAgg(figure)
        grid = figure.add_gridspec(rows + len(below), (2 + columns) if rest else 1)
        axes = [figure.add_subplot(grid[:rows, :2] if rest else grid[:, :])]
        axes += [figure.add_subplot(grid[i // columns, 2 + i % columns]) for i in range(beside)]
        axes += [figure.add_subplot(grid[rows + i, span]) for i, many in enumerate(below) for span in ACROSS[many]]
    return figure, axes


def draw(analysis: object, axes: Sequence[Axes], views: Sequence[View], **asked: object) -> None:
    """Every view of ``analysis`` on its axes: drawn the first time, moved the next.

    ``asked`` is what a view may ask for: a position of the mechanism, and the ``limits`` (a mapping from measures to
    SI), so that a picture shows the limit that its panel or its study has.
    """
    with rc_context(theme_style()):
        for view, ax in zip(views, axes, strict=True):
            given = given_to(view, asked)
            try:
                inspect.signature(view).bind(analysis, **given)
            except TypeError as unfit:
                raise ValueError(f"the view {view_name(view)} cannot show an analysis: {unfit}") from None
            with applied(f"the view {view_name(view)}", analysis):
                draw_picture(made_by(view, analysis, given), ax)


def figure_of(
    shown: object,
    *views: View,
    width: float,
    height: float | None,
    turn: float | None,
    azimuth: float | None,
    elevation: float | None,
    limits: Mapping[Measure, float] | None,
) -> Still:
    """What `camkit.picture` gives."""
    refuse_arguments(figure_of, locals())
    refuse_limits(limits or {}, {})
    given = {"turn": turn, "azimuth": azimuth, "elevation": elevation, "limits": limits}
    asked = {name: value for name, value in given.items() if value is not None}
    if isinstance(shown, Analysable):
        refuse_design(shown, "what the picture shows")
    refuse_population(shown, "what the picture shows")
    analysis = shown.analyse() if isinstance(shown, Analysable) else shown
    drawn = views or default_views(analysis)
    figure, axes = layout(drawn, width, height)
    draw(analysis, axes, drawn, **asked)
    return figure


def strip(analysis: object, view: View, turns: Iterable[float]) -> Still:
    """Pictures side by side of a mechanism that turns: ``view`` of it at each of ``turns`` (rad), to the same scale.

    Only what is drawn, and the angle: the large picture has the scales and the legend.
    """
    turns = tuple(turns)
    with rc_context(theme_style()):
        figure = Still(figsize=(12.6, 2.9), dpi=100)
        FigureCanvasAgg(figure)
        axes = figure.subplots(1, len(turns), gridspec_kw=STRIP)
        for ax, turn in zip(axes, turns, strict=True):
            made = made_by(view, analysis, {"turn": turn})
            marks = tuple(replace(mark, label="") for mark in made.marks)
            draw_picture(Picture(replace(made.axes, bare=True, title=f"{turn / deg:.0f}°"), marks), ax)
        limits = [np.array([ax.get_xlim(), ax.get_ylim()]) for ax in axes]
        low, high = np.min(limits, axis=0)[:, 0], np.max(limits, axis=0)[:, 1]
        for ax in axes:
            ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), adjustable="box")
    return figure


def saved(figure: Figure, kind: str) -> bytes:
    """A figure as a file of a ``kind`` that matplotlib writes: "svg", "pdf"."""
    out = io.BytesIO()
    with rc_context(theme_style() | {"svg.hashsalt": "camkit"}):
        figure.savefig(out, format=kind, metadata={"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind))
    return out.getvalue()
