"""`presets`: menus and buttons that put other designs into the sliders."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import ipywidgets as w

from ..quantities import D
from ..quantities.kinds import refuse_arguments
from .instrument import Instrument
from .kit.displayed import Displayed
from .kit.inputs import Menu
from .kit.parts import Banner, Button, row
from .kit.quiet import Quiet
from .kit.sheet import IMPOSSIBLE, Sheet

Change = Callable[[D], D]
"""From the design in the sliders to the one that is offered; ``ValueError`` in a sentence where there is none."""


class Presets(Displayed, w.VBox):
    """An `Instrument` under a row of menus and buttons, each of which changes its design.

    ``menus`` maps a menu's name to its options, ``buttons`` a button's words to what it does: a function from the
    design in the sliders to another.  A menu shows which of its options the design already is, and nothing if it
    is none.  An offer that cannot be made is refused in a sentence, and the design stays.
    """

    def __init__(
        self, explorer: Instrument, menus: Mapping[str, Mapping[str, Change]], buttons: Mapping[str, Change]
    ) -> None:
        refuse_arguments(Presets.__init__, locals())
        self.explorer = explorer
        self._quiet = Quiet()
        self.menus = {name: self._menu(name, options) for name, options in menus.items()}
        self.buttons = {words: Button(words, partial(self._make, change)) for words, change in buttons.items()}
        self.banner = Banner()
        self.sheet = Sheet(row(*self.menus.values(), *self.buttons.values()), self.banner)
        self.sheet.banner = self.banner
        super().__init__([self.sheet, explorer])
        explorer.on_change(self._follow)
        self._follow(explorer.design)

    def _menu(self, name: str, options: Mapping[str, Change]) -> Menu:
        offers = Menu(list(options.items()), name, value=None)
        self._quiet.hear(offers, lambda change: self._make(change) if change else None)
        return offers

    def _make(self, change: Change) -> None:
        try:
            self.explorer.load(change(self.explorer.design))
        except IMPOSSIBLE as refusal:
            self._follow(self.explorer.design)
            self.banner.show_message(f"This cannot be offered: {refusal}.")
        else:
            self._follow(self.explorer.design)

    def _follow(self, design: object) -> None:
        """Every menu shows which of its options the design is."""
        with self.sheet.held(), self._quiet:
            self.banner.show_message("")
            for offers in self.menus.values():
                offers.value = next((change for _, change in offers.options if _leads_to(change, design)), None)

    def drawing(self) -> Callable[[], bytes]:
        """What draws the picture of the instrument."""
        return self.explorer.drawing()

    def summary(self) -> str:
        """The numbers of the instrument."""
        return self.explorer.summary()


def _leads_to(change: Change, design: object) -> bool:
    try:
        return bool(change(design) == design)
    except IMPOSSIBLE:  # an offer that cannot be made now
        return False


def presets(
    explorer: Instrument,
    menus: Mapping[str, Mapping[str, Change]] | None = None,
    buttons: Mapping[str, Change] | None = None,
) -> Presets:
    """Menus and buttons above ``explorer`` that put other designs into its sliders (see `Presets`)."""
    return Presets(explorer, {} if menus is None else menus, {} if buttons is None else buttons)
