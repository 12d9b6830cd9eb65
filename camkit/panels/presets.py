"""`presets`: menus and buttons that put other designs into the sliders."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import ipywidgets as w

from ..quantities.kinds import refuse_arguments
from .explore import Explorer
from .kit.controls import banner, show_message
from .kit.panel import IMPOSSIBLE, Panel

Change = Callable[[Any], Any]
"""From the design in the sliders to the one that is offered; ``ValueError`` in a sentence where there is none."""


class Presets(Panel):
    """An `Explorer` under a row of menus and buttons, each of which changes its design.

    ``menus`` maps a menu's name to its options, ``buttons`` a button's words to what it does: a function from the
    design in the sliders to another.  A menu shows which of its options the design already is, and nothing if it
    is none.  An offer that cannot be made is refused in a sentence, and the design stays.
    """

    def __init__(
        self, explorer: Explorer, menus: Mapping[str, Mapping[str, Change]], buttons: Mapping[str, Change]
    ) -> None:
        refuse_arguments(Presets.__init__, locals())
        self.explorer, self.picture = explorer, explorer.picture
        self._silent = False
        self._banner = banner()
        self.menus = {name: self._menu(name, options) for name, options in menus.items()}
        self.buttons = {words: self._button(words, change) for words, change in buttons.items()}
        row = w.HBox([*self.menus.values(), *self.buttons.values()], layout=w.Layout(flex_flow="row wrap"))
        super().__init__([row, self._banner, explorer])
        explorer.on_change(self._follow)
        self._follow(explorer.design)

    def _menu(self, name: str, options: Mapping[str, Change]) -> w.Dropdown:
        menu = w.Dropdown(
            options=list(options.items()), value=None, description=name, layout=w.Layout(width="230px"),
            style={"description_width": "initial"},
        )  # fmt: skip
        menu.observe(lambda change: self._chosen(change.new), "value")
        return menu

    def _chosen(self, change: Change | None) -> None:
        if change and not self._silent:
            self._make(change)

    def _button(self, words: str, change: Change) -> w.Button:
        button = w.Button(description=words, layout=w.Layout(width="auto"))
        button.on_click(lambda _: self._make(change))
        return button

    def _make(self, change: Change) -> None:
        try:
            self.explorer.load(change(self.explorer.design))
        except IMPOSSIBLE as refusal:
            show_message(self._banner, f"This cannot be offered: {refusal}.")

    def _follow(self, design: Any) -> None:
        """Every menu shows which of its options the design is."""
        show_message(self._banner, "")
        self._silent = True
        try:
            for menu in self.menus.values():
                menu.value = next((change for _, change in menu.options if _leads_to(change, design)), None)
        finally:
            self._silent = False

    def summary(self) -> str:
        """The explorer's numbers."""
        return self.explorer.summary()


def _leads_to(change: Change, design: Any) -> bool:
    try:
        return bool(change(design) == design)
    except IMPOSSIBLE:  # an offer that cannot be made now
        return False


def presets(
    explorer: Explorer,
    menus: Mapping[str, Mapping[str, Change]] | None = None,
    buttons: Mapping[str, Change] | None = None,
) -> Presets:
    """Menus and buttons above ``explorer`` that put other designs into its sliders (see `Presets`)."""
    return Presets(explorer, {} if menus is None else menus, {} if buttons is None else buttons)
