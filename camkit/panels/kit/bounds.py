"""Rows of a search space: which quantities are free, and between which bounds; which menus, and with which options."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from dataclasses import replace

import numpy as np

from ...quantities import Quantity, label, words
from ...study.free import Free, Menu, declared_with, refuse_bounds
from ...units import in_unit
from .inputs import Amount, Check
from .parts import Part, row
from .quiet import Quiet


class Bounds:
    """One row of the search space: whether a quantity is free, and between which bounds.

    ``refused(sentence)`` is called after each bound that is typed: with why they could not be searched, or nothing.
    """

    def __init__(
        self,
        name: str,
        declared: Quantity,
        bounds: tuple[float, float],
        free: bool,
        refused: Callable[[str], None],
    ) -> None:
        self.name, self.declared = name, declared
        self.free = Check(value=free, description=label(name, declared), tooltip=f"free to change: {declared.meaning}")
        self.low, self.high = (
            Amount(unit=declared.unit, description=f"{label(name, declared)}, {end}") for end in ("from", "to")
        )
        self._refused, self._quiet = refused, Quiet()
        self._show(bounds)
        for box in (self.low, self.high):
            self._quiet.hear(box, lambda _: self._check())

    @property
    def parts(self) -> tuple[Part, ...]:
        """What stands in the row."""
        return self.free, self.low, self.high

    def _show(self, bounds: tuple[float, float]) -> None:
        """Show ``bounds`` (SI), rounded to what a slider tells apart; as long as nobody edits them they stay exact."""
        self._exact = bounds
        with self._quiet:
            self.low.value, self.high.value = self._shown = [self._rounded(b) for b in bounds]

    def _rounded(self, bound: float) -> float:
        """In its unit: with four digits if that is all of it, else in hundredths of the declared range at most."""
        declared, value = self.declared, in_unit(bound, self.declared.unit)
        near = float(f"{value:.4g}")
        decimals = 1 - int(np.floor(np.log10((declared.high - declared.low) / 20)))
        return near if abs(near - value) <= 1e-12 * abs(value) else round(value, decimals)

    def _check(self) -> None:
        """Say at once what a search could not take; it stays, since the other bound may be typed next."""
        try:
            refuse_bounds({self.name: self.declared}, {self.name: self.value})
        except ValueError as refusal:
            self._refused(f"This cannot be searched: {refusal}.")
        else:
            self._refused("")

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


class Options:
    """A row for a menu: whether it is free, and which of its options are tried."""

    def __init__(self, menu: Menu) -> None:
        self.name, self.menu, self._quiet = menu.name, menu, Quiet()
        alike = ", alike" if len(menu.paths) > 1 else ""
        name = " and ".join(map(words, menu.paths))
        self.free = Check(description=f"{name}{alike}", tooltip=f"free: {menu.meaning}")
        self.all = Check(description="all", value=True)
        self.options = {name: Check(description=name, value=True) for name in menu.options}
        self.tried = row(
            self.all, *self.options.values(), look="tried", description=f"options of {self.free.description}"
        )
        self._quiet.hear(self.all, lambda every: self._tick(self.options if every else ()))
        self._show()
        self.free.observe(lambda _: self._show(), "value")

    def _show(self) -> None:
        self.tried.visible = self.free.value

    def _tick(self, names: Iterable[str]) -> None:
        for name, box in self.options.items():
            box.value = name in names

    @property
    def parts(self) -> tuple[Part, ...]:
        """What stands in the row."""
        return self.free, self.tried

    @property
    def value(self) -> Menu:
        """The menu with the options that are ticked; ``ValueError`` if there is none."""
        options = {name: self.menu.options[name] for name, box in self.options.items() if box.value}
        if not options:
            raise ValueError(f"no option of the {words(self.name)} is to be tried; tick one or more")
        return replace(self.menu, names=tuple(options), values=tuple(options.values()))

    @property
    def words(self) -> str:
        """The options that are ticked."""
        return f"one of {', '.join(name for name, box in self.options.items() if box.value) or 'nothing'}"

    def set(self, menu: Menu | None) -> None:
        """Free the menu with these options; ``None``: not free."""
        self.free.value = menu is not None
        if menu is not None:
            self._tick(menu.options)
            with self._quiet:
                self.all.value = len(menu.options) == len(self.options)


def rows_of(
    design: object, space: Free, free: Container[str], refused: Callable[[str], None]
) -> dict[str, Bounds | Options]:
    """A row for all in ``space``, by its name; those that are ``free`` are ticked."""
    menus = {name: Options(menu) for name, menu in space.items() if isinstance(menu, Menu)}
    declared = declared_with(design, [row.menu for row in menus.values()], [n for n in space if n not in menus])
    for name, options in menus.items():
        options.free.value = name in free
    bounds = {n: Bounds(n, q, space[n], n in free, refused) for n, q in declared.items()}
    return {name: menus.get(name) or bounds[name] for name in space}
