"""A picture on a sheet: views of what is shown, as marks that the page draws."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import traitlets

from ...quantities.applied import applied
from ...quantities.types import Array
from ...render.figure import picture, small_png
from ...render.living import plain_picture
from ...render.positions import given_to, view_name
from ...views.picture import Picture, View
from .parts import Message, Part

FARTHEST = 1e30
"""No mark is drawn farther than this, in the units of its axes."""
INCH = 62
"""Pixels of the page for an inch of the still picture."""


class LivePicture(Part):
    """Views of what is shown, beside each other: in the page as marks, and as a still picture where there is none.

    ``width`` and ``height`` are those of the still picture, inches.
    """

    kind = "picture"
    description = traitlets.Unicode("").tag(page=True)
    pixels = traitlets.Int().tag(page=True)
    pointing = traitlets.Unicode("").tag(page=True)
    """What a person may do in it beside looking: "click", or "drag", which includes it."""
    movable = traitlets.Unicode("").tag(page=True)
    """The key of the mark that a person may drag, or move with the arrow keys."""
    count = traitlets.Int(0).tag(page=True)
    """How often it has been drawn: by it the page knows another picture."""

    def __init__(self, views: tuple[View, ...], description: str, width: float = 12.6, height: float = 7.0) -> None:
        self.views, self.size = views, (width, height)
        self.data: list[dict[str, object]] = []
        self.shown: tuple[Picture, ...] = ()
        """What the views have made."""
        self._last: tuple[object, dict[str, object]] | None = None
        self._offered: dict[str, object] = {}
        self._pointed: Callable[[int, str, Array, Array], None] = lambda *told: None
        self._moved: Callable[[int, Array], None] = lambda *told: None
        super().__init__(description=description, pixels=round(INCH * height))

    def show(self, thing: object, views: tuple[View, ...] | None = None, **asked: object) -> None:
        """Show something else, through other ``views`` if they are given.

        What cannot be drawn raises ``ValueError`` or ``ArithmeticError``, and the picture stays as it was.
        """
        through = self.views if views is None else views
        shown = tuple(_made(view, thing, asked) for view in through)
        for each in shown:
            _refuse_far_marks(each)
        self.data = [plain_picture(each, view_name(view)) for view, each in zip(through, shown, strict=True)]
        self.data[0] |= self._offered
        self.views, self.shown, self._last = through, shown, (thing, asked)
        self.count += 1

    def offer(self, points: Array, designs: Array) -> None:
        """Designs at ``points`` ``(n, 2)`` of the first view: the page shows the one under the pointer as a ghost.

        ``designs`` ``(n, q)`` are the values of all quantities of the panel's design, SI; the next `show` sends them.
        """
        rows = (*np.asarray(points, dtype=float).T, np.ravel(designs))
        self._offered = {"offered": [np.ascontiguousarray(row, dtype=float).tobytes() for row in rows]}

    def drawing(self) -> Callable[[], bytes]:
        """What draws the picture as a PNG file as it is now."""
        if not self._last:
            return small_png
        thing, asked = self._last
        figure = partial(picture, thing, *self.views, width=self.size[0], height=self.size[1], **asked)  # type: ignore[arg-type]
        return lambda: figure()._repr_png_()

    def on_pointer(self, act: Callable[[int, str, Array, Array], None]) -> None:
        """Call ``act(view, kind, at, pixel)``: "press", "drag", "release", "click" in the picture of a view.

        ``at`` is the place in its user units ``(2,)``, ``pixel`` the size of a pixel in them.
        """
        self._pointed, self.pointing = act, "drag"

    def on_click(self, act: Callable[[int, Array, Array], None]) -> None:
        """Call ``act(view, at, pixel)`` at every click."""
        self._pointed = lambda view, kind, at, pixel: act(view, at, pixel) if kind == "click" else None
        self.pointing = "click"

    def on_move(self, key: str, act: Callable[[int, Array], None]) -> None:
        """Let a person move the mark ``key``, a point: ``act(view, at)`` is told where to; `on_click` goes on."""
        self._moved, self.movable = act, key

    def take(self, message: Message) -> None:
        """The pointer does something."""
        at, pixel = (np.array(message[name], dtype=float) for name in ("at", "pixel"))
        if at.shape != (2,) or pixel.shape != (2,) or not np.isfinite([at, pixel]).all():
            return
        if message["does"] == "move":
            self._moved(int(message["view"]), at)
        else:
            self._pointed(int(message["view"]), str(message["does"]), at, pixel)


def nearest(points: Array, at: Array, pixel: Array, within: float = np.inf) -> int | None:
    """Which of ``points`` ``(p, 2)`` is nearest to ``at``, less than ``within`` pixels away.

    >>> nearest(np.array([[0.0, 0.0], [1.0, 5.0]]), np.array([0.9, 4.0]), np.array([0.01, 0.1]))
    1
    """
    away = np.hypot(*((points - at) / pixel).T)
    return int(np.nanargmin(away)) if np.nanmin(away, initial=np.inf) < within else None


def _made(view: View, thing: Any, asked: Mapping[str, object]) -> Picture:
    with applied(f"the view {view_name(view)}", thing):
        return view(thing, **given_to(view, asked))


def _refuse_far_marks(shown: Picture) -> None:
    """No renderer finds scales for numbers of any size."""
    for mark in shown.marks:
        for name in ("x", "y", "low", "high"):
            values = np.abs(np.asarray(getattr(mark, name, 0.0), dtype=float))
            far = values[np.isfinite(values)].max(initial=0)
            if far > FARTHEST:
                raise OverflowError(f"a curve reaches {far:.3g}, farther than can be drawn")
