"""A figure that lives: drawn once, its curves moved in place, sent as an image to the page.

A full drawing takes a few hundred milliseconds, three quarters of them for text.  So while something moves, only
the curves are drawn, over a stored background (blitting), and a little after the last move everything is
drawn again with axes that fit.

Nothing queues: the page sends a slider's next value when the kernel is done with the last one, and by then only the
newest is left.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

import anywidget
import numpy as np
import traitlets
from matplotlib import rc_context

from ...quantities.types import Array
from ...render.draw import moving, theme_style
from ...render.picture import draw, encoded, layout, pixels, small_png
from ...views.picture import View
from .latest_only import Debounced

SETTLE, PAUSE = 0.25, 1.0
"""Seconds after the last move until everything is drawn again, and seconds after which a move is no longer a drag."""


FARTHEST = 1e30
"""No curve is drawn farther than this, in the units of its axes."""

DRAWING = threading.RLock()
"""Held while anything is drawn: figures share matplotlib's fonts, which two threads must not use at once."""


class ImageWidget(anywidget.AnyWidget):
    """An image on the page that tells what the pointer does on it."""

    _esm = Path(__file__).with_name("image.js").read_text(encoding="utf-8")
    _css = ".camkit-image { display: block; width: 100%; height: auto; }"
    data = traitlets.Bytes(b"").tag(sync=True)
    mime = traitlets.Unicode("image/png").tag(sync=True)
    description = traitlets.Unicode("").tag(sync=True)

    def on_pointer(self, act: Callable[[str, float, float], None]) -> None:
        """Call ``act(kind, x, y)``: "press", "drag", "release", "click"; x and y are shares of width and height."""
        self.on_msg(lambda _, message, __: act(message["kind"], message["x"], message["y"]))

    def on_click(self, act: Callable[[float, float], None]) -> None:
        """Call ``act(x, y)`` at every click."""
        self.on_pointer(lambda kind, x, y: act(x, y) if kind == "click" else None)

    def put(self, data: bytes, mime: str) -> None:
        """Show another image."""
        with self.hold_sync():
            self.mime, self.data = mime, data


class LivePicture:
    """Views of an analysis in one figure, shown in ``widget``."""

    def __init__(self, views: tuple[View, ...], description: str, width: float = 12.6, height: float = 7.0) -> None:
        self.views = views
        self.figure, self.axes = layout(views, width, height)
        self.description = description
        self.said: Callable[[], str] = str
        self.widget = ImageWidget(description=description)
        self._background: object = None
        self._ends: list[tuple[tuple[float, float], tuple[float, float]]] = []
        self._last: tuple[object, dict[str, object]] | None = None
        self._later = Debounced(self._settle_and_describe, SETTLE)
        self._moved = 0.0

    def show(self, analysis: object, views: tuple[View, ...] | None = None, **position: object) -> None:
        """Show another analysis: at once with the axes as they are, and a little later with axes that fit.

        Through other ``views`` it is another figure of the same size.  What cannot be drawn raises ``ValueError`` or
        ``ArithmeticError``, and the picture stays as it was.
        """
        with DRAWING:
            before = self.views, self.figure, self.axes, self._background, self._last
            if views is not None and views != self.views:
                self.views, (self.figure, self.axes) = views, layout(views, *self.figure.get_size_inches())
                self._background = self._last = None
            try:
                draw(analysis, self.axes, self.views, **position)
                self._refuse_far_points()
            except (ValueError, ArithmeticError):
                self.views, self.figure, self.axes, self._background, self._last = before
                if self._last:
                    draw(self._last[0], self.axes, self.views, **self._last[1])
                raise
            self._last = analysis, position
            if self._background is None:
                self.settle()
            else:
                self._keep_axes()
                self._blit()
                self.widget.put(self._jpeg(), "image/jpeg")
                self._later.ask(self._patience())

    def _keep_axes(self) -> None:
        """The ends of the stored background, so that what moves over it is to its scale."""
        for ax, (across, up) in zip(self.axes, self._ends, strict=True):
            if ax.get_autoscalex_on():
                ax.set_xlim(across, auto=None)
            if ax.get_autoscaley_on():
                ax.set_ylim(up, auto=None)

    def _refuse_far_points(self) -> None:
        """Matplotlib finds no ticks and fills no area for numbers of any size."""
        for ax in self.axes:
            for curve in ax.lines:
                points = np.abs(np.asarray(curve.get_xydata(), dtype=float))
                far = points[np.isfinite(points)].max(initial=0)
                if far > FARTHEST:
                    raise OverflowError(f"a curve reaches {far:.3g}, farther than can be drawn")

    def settle(self) -> None:
        """Draw everything anew, axes fitted to the curves."""
        with DRAWING:
            self._later.cancel()
            for ax in self.axes:
                ax.relim()
                ax.autoscale_view()
                for artist in moving(ax):
                    artist.set_animated(True)
            with rc_context(theme_style()):
                self.figure.canvas.draw()
            self.figure.set_layout_engine("none")  # the first drawing has laid the axes out; that takes half a second
            self._ends = [(ax.get_xlim(), ax.get_ylim()) for ax in self.axes]
            self._background = self.figure.canvas.copy_from_bbox(self.figure.bbox)  # type: ignore[attr-defined]
            self._blit()
            self.widget.put(self._png(), "image/png")

    def png(self) -> bytes:
        """The picture as a PNG file, settled."""
        self._later.settle()
        with DRAWING:
            return small_png(self.figure)

    def _patience(self) -> float:
        """Seconds to wait for the next move; a full drawing would delay it, and on a busy machine it comes late."""
        now = time.monotonic()
        since, self._moved = now - self._moved, now
        return SETTLE + (2 * since if since < PAUSE else 0.0)

    def _settle_and_describe(self) -> None:
        self.settle()
        self.describe()

    def in_data(self, x: float, y: float, axes: int = 0) -> tuple[float, float]:
        """What stands at shares ``x, y`` of the picture's width and height, in the data of one of its axes."""
        across, up = self.axes[axes].transData.inverted().transform(self._in_pixels(x, y))
        return float(across), float(up)

    def nearest(self, points: Array, x: float, y: float, within: float = np.inf) -> int | None:
        """Which of ``points`` ``(p, 2)`` of the first axes is nearest to a share of the picture, ``within`` pixels."""
        away = np.hypot(*(self.axes[0].transData.transform(points) - self._in_pixels(x, y)).T)
        return int(np.argmin(away)) if away.min(initial=np.inf) < within else None

    def _in_pixels(self, x: float, y: float) -> tuple[float, float]:
        width, height = self.figure.canvas.get_width_height()
        return x * width, (1 - y) * height

    def describe(self) -> None:
        """Tell those who do not see the picture: the views' titles, and what ``said()`` has to say of the numbers."""
        titles = ", ".join(filter(None, (ax.get_title(loc="left") for ax in self.axes)))
        self.widget.description = "\n".join(filter(None, (self.description, titles, self.said())))

    def _blit(self) -> None:
        self.figure.canvas.restore_region(self._background)  # type: ignore[attr-defined]
        for ax in self.axes:
            for artist in moving(ax):
                ax.draw_artist(artist)

    def _jpeg(self) -> bytes:
        return encoded(pixels(self.figure), "JPEG", quality=88, subsampling=0)

    def _png(self) -> bytes:
        return encoded(pixels(self.figure).convert("RGB"), "PNG", compress_level=2)
