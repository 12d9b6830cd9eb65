"""A view in space, turned by hand: press on it and drag."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ...render.picture import positions_of
from .controls import NumberRow
from .picture import LivePicture


class Orbit:
    """A pointer dragged over a view in space turns the knobs ``azimuth`` and ``elevation`` as a hand turns a globe.

    The width of the picture is a whole turn; ``changed()`` is called after every step.
    """

    def __init__(self, picture: LivePicture, knobs: Mapping[str, NumberRow], changed: Callable[[], None]) -> None:
        self.picture, self.knobs, self._changed = picture, knobs, changed
        self._held: tuple[float, float] | None = None
        picture.widget.on_pointer(self.pointed)

    def pointed(self, kind: str, x: float, y: float) -> None:
        """What the pointer does at shares ``x, y`` of the picture's width and height."""
        if kind == "press":
            self._held = (x, y) if self._is_in_space(x, y) else None
        elif kind == "drag" and self._held:
            self._turn(x - self._held[0], y - self._held[1])
            self._held = (x, y)
        else:
            self._held = None

    def _is_in_space(self, x: float, y: float) -> bool:
        views = zip(self.picture.views, self.picture.axes, strict=True)
        return any("azimuth" in positions_of(view) and ax.get_position().contains(x, 1 - y) for view, ax in views)

    def _turn(self, dx: float, dy: float) -> None:
        width, height = self.picture.figure.get_size_inches()
        azimuth, elevation = self.knobs["azimuth"], self.knobs["elevation"]
        azimuth.set(np.mod(azimuth.value - 2 * np.pi * dx + np.pi, 2 * np.pi) - np.pi)
        elevation.set(np.clip(elevation.value + 2 * np.pi * dy * height / width, -np.pi / 2, np.pi / 2))
        self._changed()
