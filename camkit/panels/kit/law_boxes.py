"""A menu of laws, and boxes for the numbers and choices that the chosen one declares."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ...motion import LAW_MENU, Law
from ...quantities import choices_of, quantities_of, unremarked, value_of, with_quantities, words
from ...units import factor, in_unit
from .inputs import Amount, Menu
from .parts import row
from .quiet import Quiet


def named_as(law: object) -> str:
    """What a law is called in a menu, also one that is somebody's own function."""
    return str(getattr(law, "name", "own law"))


def _with_own(menu: Sequence[Law], law: Law) -> list[Law]:
    """The options of a menu, with ``law`` in place of the one that it is another of; else behind them."""
    alike = [k for k, option in enumerate(menu) if option == law]
    alike += [k for k, option in enumerate(menu) if type(option) is type(law) and named_as(option) == named_as(law)]
    place = alike[0] if alike else len(menu)
    return [*menu[:place], law, *menu[place + 1 :]]


class LawBoxes:
    """The menu and the boxes; ``take(make)`` gets another law, which may be none that can be."""

    def __init__(self, quiet: Quiet, take: Callable[[Callable[[], Law]], None]) -> None:
        self._quiet, self._take = quiet, take
        self.menu = Menu((), tooltip="law")
        self.group = row(look="law", description="numbers of the law", visible=False)
        self.boxes: dict[str, Amount | Menu] = {}
        quiet.hear(self.menu, lambda law: take(lambda: law))

    @property
    def law(self) -> Law:
        """What the menu and the boxes say."""
        law: Law = self.menu.value
        return law

    def show(self, law: Law) -> None:
        """Stand at ``law``."""
        options = _with_own(LAW_MENU, law)
        self.menu.offer([(named_as(option), option) for option in options], law)
        wanted = [*choices_of(law), *quantities_of(law)] if isinstance(law, Law) else []
        if list(self.boxes) != wanted:
            self.boxes = {path: self._box(law, path) for path in wanted}
            self.group.children = tuple(self.boxes.values())
        for path, box in self.boxes.items():
            self._put(law, path, box)
        self.group.visible = bool(self.boxes)

    def _box(self, law: Law, path: str) -> Amount | Menu:
        box: Amount | Menu
        if path in choices_of(law):
            box = Menu((), words(path), tooltip=choices_of(law)[path].meaning)
        else:
            declared = quantities_of(law)[path]
            box = Amount(description=words(path), unit=declared.unit, tooltip=declared.meaning, named=True)
        self._quiet.hear(box, lambda value: self._typed(path, value))
        return box

    def _put(self, law: Law, path: str, box: Amount | Menu) -> None:
        if isinstance(box, Menu):
            value = value_of(law, path)
            named = choices_of(law)[path].named
            box.offer([*named.items(), *([] if value in named.values() else [(named_as(value), value)])], value)
        else:
            box.value = in_unit(float(value_of(law, path)), box.unit)

    def _typed(self, path: str, value: object) -> None:
        box, law = self.boxes[path], self.law
        si = value if isinstance(box, Menu) else box.value * factor(box.unit)
        self._take(lambda: _with(law, path, si))


def _with(law: Law, path: str, value: object) -> Law:
    """A law with another number or choice in it."""
    with unremarked():  # a panel's numbers have their units
        return with_quantities(law, {path: value})
