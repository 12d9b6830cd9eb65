"""What a search may change: a row for every quantity and menu of a design, in the groups that its sliders stand in."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...quantities import Analysable, Choice, Quantity, declared_in
from ...render.living import group_of
from ...study.free import Free, Menu, freed
from .bounds import Bounds, Options
from .inputs import Typed
from .parts import Group
from .quiet import Quiet

MANY = 8
"""From so many rows on there is a box to find one."""
CHOICES = "choices"
"""The group in which menus stand."""


class Space:
    """Rows for the quantities and menus of a design; ``part`` is all of them, ``free`` what is ticked.

    Menus with the same options, such as the laws of rise and return, have a row more, to move together.
    """

    def __init__(self, refused: Callable[[str], None]) -> None:
        self._refused = refused
        self.rows: dict[str, Bounds | Options] = {}
        self._known: dict[str, Bounds | Options] = {}
        self._others: dict[str, Bounds | Options] = {}
        self._groups: dict[str, Group] = {}
        self._paths: list[str] = []
        self.find = Typed(placeholder="find a quantity", description="find a quantity")
        Quiet().hear(self.find, lambda _: self._filter())
        self._all = Group()
        self.part = Group(Group(self.find, look="find"), self._all)

    def offer(self, design: Analysable) -> None:
        """Rows for what a design has; those that are there already stay as they are."""
        declared = declared_in(design)
        if list(declared) == self._paths:
            return
        self._paths = list(declared)
        rows: list[Bounds | Options] = []
        for path, q in declared.items():
            if isinstance(q, Quantity):
                bounds = (q.low * q.factor, q.high * q.factor)
                rows.append(self._known.get(path) or Bounds(path, q, bounds, False, self._refused))
        for menu in _menus(design, {path: d for path, d in declared.items() if isinstance(d, Choice)}):
            rows.append(self._known.get(menu.name) or Options(menu))
        self.rows = {each.name: each for each in rows} | self._others
        self._known |= self.rows
        self.find.visible = len(self.rows) > MANY
        self._filter()

    def ask(self, free: Free) -> None:
        """Free these and nothing else; a group with one of them is unfolded."""
        for name, asked in free.items():
            if isinstance(asked, Menu) and not isinstance(self.rows.get(name), Options):
                self._others[f"{name}, sizes"] = Options(asked)  # of a quantity, or of several together
        self.rows |= self._others
        for each in self.rows.values():
            asked = free.get(each.name)
            each.set(asked if isinstance(asked, Menu) == isinstance(each, Options) else None)
        self._filter()

    @property
    def ticked(self) -> list[Bounds | Options]:
        """The rows of what is free."""
        return [each for each in self.rows.values() if each.free.value]

    @property
    def free(self) -> Free:
        """What is free: between which bounds (SI), or with which options."""
        return {each.name: each.value for each in self.ticked}

    def _filter(self) -> None:
        """Those whose name has in it what is looked for, in their groups."""
        wanted = self.find.value.strip().lower()
        inside: dict[str, list[Bounds | Options]] = {}
        for name, each in self.rows.items():
            if wanted in each.free.description.lower():
                title = group_of(name, each.declared) if isinstance(each, Bounds) else CHOICES
                inside.setdefault(title, []).append(each)
        shown = []
        for title, rows in inside.items():
            group = self._groups.setdefault(title, Group(Group(look="bounds"), look="fold"))
            group.children[0].children = tuple(part for each in rows for part in each.parts)
            group.description = f"{title[:1].upper()}{title[1:]} ({len(rows)})"
            group.open = bool(wanted) or any(each.free.value for each in rows)
            shown.append(group)
        self._all.children = tuple(shown)


def _menus(design: Analysable, choices: Mapping[str, Choice]) -> list[Menu]:
    """The menu of each choice, and of those that have the same options together."""
    alike: dict[tuple[str, ...], list[str]] = {}
    for path, choice in choices.items():
        alike.setdefault(tuple(choice.named), []).append(path)
    keys = [tuple(paths) for paths in alike.values() if len(paths) > 1]
    asked = dict.fromkeys([*keys, *choices])
    return [menu for key in asked for menu in freed(design, {key: None}).values() if isinstance(menu, Menu)]
