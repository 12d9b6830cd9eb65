"""An ordinary slider of a notebook, beside a panel whose design it moves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import ipywidgets as w
import numpy as np
import traitlets

from ...quantities import Paths, Quantity, label, value_of
from ...units import in_unit
from .changes import numbers_of


class Moved(Protocol):
    """A panel that shows a design."""

    design: Any
    values: Any
    """Of its quantities, in their order."""

    def on_change(self, act: Callable[..., object]) -> None:
        """Call ``act(design)`` after every change."""


def slider_of(panel: Moved, path: str) -> w.FloatSlider:
    """A slider for the quantity at ``path``, in its unit, linked both ways; it acts on release."""
    declared: Quantity = Paths(panel.design, [path], Quantity).declared[path]
    low, high, name = declared.low, declared.high, label(path, declared)
    step = 10 ** np.floor(np.log10((high - low) / 500))
    # While it moves it would send back, too, what it is told, rounded to its steps.
    slider = w.FloatSlider(min=low, max=high, step=step, description=name, continuous_update=False)

    def follow(design: object) -> None:
        value = in_unit(value_of(design, path), declared.unit)
        slider.min, slider.max = min(slider.min, value), max(slider.max, value)  # else it would move the design
        slider.value = value

    def move(change: traitlets.Bunch) -> None:
        numbers, asked = numbers_of(panel.design), change.new * declared.factor
        if abs(asked - panel.values[list(numbers).index(path)]) > 1e-12 * declared.most * declared.factor:
            panel.values = list({**numbers, path: asked}.values())  # the page says why it cannot be, if it cannot

    follow(panel.design)
    slider.observe(move, "value")
    panel.on_change(follow)
    return slider
