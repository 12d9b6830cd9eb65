"""What a search may change: a row for every quantity of a design, in the groups that its sliders stand in."""

from __future__ import annotations

from collections.abc import Callable

from ...quantities import Analysable, quantities_of
from ...render.living import group_of
from ...study.study import Space
from .bounds import Bounds
from .inputs import Typed
from .parts import Group
from .quiet import Quiet

MANY = 8
"""From so many rows on there is a box to find one."""


class FreeQuantities:
    """Rows of `Bounds` for the quantities of a design; ``part`` is all of them, ``free`` what is ticked."""

    def __init__(self, refused: Callable[[str], None]) -> None:
        self._refused = refused
        self.rows: dict[str, Bounds] = {}
        self._known: dict[str, Bounds] = {}
        self._groups: dict[str, Group] = {}
        self.find = Typed(placeholder="find a quantity", description="find a quantity")
        Quiet().hear(self.find, lambda _: self._filter())
        self._all = Group()
        self.part = Group(Group(self.find, look="find"), self._all)

    def offer(self, design: Analysable) -> None:
        """Rows for the quantities of a design; those that are there already stay as they are."""
        declared = quantities_of(design)
        if list(declared) == list(self.rows):
            return
        for path, q in declared.items():
            if path not in self._known:
                self._known[path] = Bounds(path, q, (q.low * q.factor, q.high * q.factor), False, self._refused)
        self.rows = {path: self._known[path] for path in declared}
        self.find.visible = len(self.rows) > MANY
        self._filter()

    def ask(self, free: Space) -> None:
        """Free these and nothing else; a group with one of them is unfolded."""
        for path, bounds in self.rows.items():
            bounds.set(free.get(path))
        self._filter()

    @property
    def ticked(self) -> list[Bounds]:
        """The rows of what is free."""
        return [bounds for bounds in self.rows.values() if bounds.free.value]

    @property
    def free(self) -> Space:
        """What is free, and between which bounds (SI)."""
        return {bounds.name: bounds.value for bounds in self.ticked}

    def _filter(self) -> None:
        """Those whose name has in it what is looked for, in their groups."""
        wanted = self.find.value.strip().lower()
        inside: dict[str, list[Bounds]] = {}
        for path, bounds in self.rows.items():
            if wanted in bounds.free.description.lower():
                inside.setdefault(group_of(path, bounds.declared), []).append(bounds)
        shown = []
        for name, rows in inside.items():
            group = self._groups.setdefault(name, Group(Group(look="bounds"), look="fold"))
            group.children[0].children = tuple(part for bounds in rows for part in bounds.parts)
            group.description = f"{name[:1].upper()}{name[1:]} ({len(rows)})"
            group.open = bool(wanted) or any(bounds.free.value for bounds in rows)
            shown.append(group)
        self._all.children = tuple(shown)
