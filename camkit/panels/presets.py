"""`presets`: menus and buttons that put other designs into the sliders."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import ipywidgets as w

from ..quantities import D
from ..quantities.kinds import refuse_arguments
from .explore import Explorer
from .kit.banner import Banner
from .kit.layout import button, menu, wrapped
from .kit.panel import IMPOSSIBLE, Panel
from .kit.quiet import Quiet

Change = Callable[[D], D]
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
        self._quiet = Quiet()
        self.banner = Banner()
        self.menus = {name: self._menu(name, options) for name, options in menus.items()}
        self.buttons = {words: button(words, partial(self._make, change)) for words, change in buttons.items()}
        super().__init__([wrapped(*self.menus.values(), *self.buttons.values()), self.banner, explorer])
        explorer.on_change(self._follow)
        self._follow(explorer.design)

    def _menu(self, name: str, options: Mapping[str, Change]) -> w.Dropdown:
        offers = menu(list(options.items()), name, "230px", value=None)
        self._quiet.hear(offers, lambda change: self._make(change) if change else None)
        return offers

    def _make(self, change: Change) -> None:
        try:
            self.explorer.load(change(self.explorer.design))
        except IMPOSSIBLE as refusal:
            self.banner.show_message(f"This cannot be offered: {refusal}.")

    def _follow(self, design: object) -> None:
        """Every menu shows which of its options the design is."""
        self.banner.show_message("")
        with self._quiet:
            for offers in self.menus.values():
                offers.value = next((change for _, change in offers.options if _leads_to(change, design)), None)

    def summary(self) -> str:
        """The explorer's numbers."""
        return self.explorer.summary()


def _leads_to(change: Change, design: object) -> bool:
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
