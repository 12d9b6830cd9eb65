"""Several views in one figure."""

from __future__ import annotations

import inspect
import io
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from .artists import STYLE

View = Callable[..., Axes]


class Picture(Figure):
    """A figure that shows itself in a notebook, as a small file; pyplot never sees it, so none is left behind."""

    def _repr_png_(self) -> bytes:
        with rc_context(STYLE):
            self.canvas.draw()
        return small_png(self)


def small_png(figure: Figure) -> bytes:
    """The pixels of a drawn figure as a PNG file of 256 colours: a third of the usual size."""
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])  # type: ignore[attr-defined]
    out = io.BytesIO()
    image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(out, "PNG", optimize=True)
    return out.getvalue()


def layout(
    views: Sequence[View], width: float = 12.6, height: float = 7.0, dpi: int = 100
) -> tuple[Picture, list[Axes]]:
    """A figure with one pair of axes for each view: the first large on the left, the others in two columns."""
    with rc_context(STYLE):
        figure = Picture(figsize=(width, height), dpi=dpi, layout="constrained")
        FigureCanvasAgg(figure)
        rest = len(views) - 1
        columns = 2 if rest > 3 else 1
        rows = max(1, -(-rest // columns))
        grid = figure.add_gridspec(rows, (2 + columns) if rest else 1)
        axes = [figure.add_subplot(grid[:, :2] if rest else grid[:, :])]
        axes += [figure.add_subplot(grid[i // columns, 2 + i % columns]) for i in range(rest)]
    return figure, axes


POSITIONS = ("turn", "azimuth", "elevation")
"""What a view may ask for beside the analysis: where the mechanism stands, from where it is seen (rad)."""


def positions_of(view: View) -> tuple[str, ...]:
    """Which of `POSITIONS` a view takes."""
    takes = inspect.signature(view).parameters
    return tuple(name for name in POSITIONS if name in takes)


def draw(analysis: Any, axes: Sequence[Axes], views: Sequence[View], **position: float) -> None:
    """Every view of ``analysis`` on its axes: drawn the first time, moved the next."""
    with rc_context(STYLE):
        for view, ax in zip(views, axes, strict=True):
            view(analysis, ax, **{name: position[name] for name in positions_of(view) if name in position})


def picture(shown: Any, *views: View, width: float = 12.6, height: float = 7.0, **position: float) -> Picture:
    """A still figure of ``shown`` through ``views``: of a design (its analysis), or of what the views take."""
    if not views:
        raise ValueError("the picture needs one or more views")
    figure, axes = layout(views, width, height)
    draw(shown.analyse() if hasattr(shown, "analyse") else shown, axes, views, **position)
    return figure
