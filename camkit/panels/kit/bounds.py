"""Rows of a search space: which quantities are free, and between which bounds."""

from __future__ import annotations

from collections.abc import Callable

import ipywidgets as w

from ...quantities import Quantity, words
from ...study.study import refuse_bounds
from ...units import in_unit
from .controls import label_html, small_html
from .number import NumberBox, staying
from .quiet import Quiet


class Bounds:
    """One row of the search space: whether a quantity is free, and between which bounds."""

    def __init__(
        self,
        name: str,
        declared: Quantity,
        bounds: tuple[float, float],
        free: bool,
        refused: Callable[[str], None],
    ) -> None:
        self.name, self.declared = name, declared
        narrow = w.Layout(width="84px")
        self.free = w.Checkbox(value=free, indent=False, layout=w.Layout(width="22px"), tooltip="free to change")
        self.low, self.high = (
            NumberBox(0.0, staying(f"bounds of the {words(name)}", refused, "stay"), declared.unit, layout=narrow)
            for _ in range(2)
        )
        self._refused, self._quiet = refused, Quiet()
        self._show(bounds)
        for box in (self.low, self.high):
            self._quiet.hear(box, lambda _: self._check())
        label = w.HTML(label_html(name, declared), layout=w.Layout(flex="1 1 170px"))
        unit = w.HTML(small_html(declared.unit), layout=w.Layout(width="44px"))
        self.row = w.HBox([self.free, label, self.low, self.high, unit], layout=w.Layout(align_items="center"))
        self.row.add_class("camkit-knob")

    def _show(self, bounds: tuple[float, float]) -> None:
        """Show ``bounds`` (SI), rounded to what fits; as long as nobody edits them they stay exact."""
        self._exact = bounds
        with self._quiet:
            self.low.value, self.high.value = self._shown = [
                float(f"{in_unit(b, self.declared.unit):.6g}") for b in bounds
            ]

    def _check(self) -> None:
        """Say at once what a search could not take; it stays, since the other bound may be typed next."""
        try:
            refuse_bounds({self.name: self.declared}, {self.name: self.value})
        except ValueError as refusal:
            self._refused(f"This cannot be searched: {refusal}.")

    @property
    def value(self) -> tuple[float, float]:
        """The bounds in SI."""
        if [self.low.value, self.high.value] == self._shown:
            return self._exact
        return self.low.value * self.declared.factor, self.high.value * self.declared.factor

    @property
    def words(self) -> str:
        """``from 40 to 60 mm``, or ``fixed``."""
        if not self.free.value:
            return "fixed"
        return f"from {self.low.value:.6g} to {self.high.value:.6g} {self.declared.unit}".rstrip()

    def set(self, bounds: tuple[float, float] | None) -> None:
        """Show other bounds (SI); ``None``: not free."""
        self.free.value = bounds is not None
        if bounds is not None:
            self._show(bounds)
