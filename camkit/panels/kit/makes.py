"""Designs of several makes under one panel: what is recorded of each, so that Undo comes back to it."""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ...quantities import Analysable
from ...quantities.kinds import shown
from ...render.living import Living
from .changes import alike, with_numbers

RECORDED, REMEMBERED = 2, 50
"""So many makes hold what is recorded, ten megabytes each: an option that is taken back is there at once; to so many
others one can come back."""


class Makes:
    """Each make of the designs that a panel has shown, by a name that no other panel gives: the newest last."""

    def __init__(self) -> None:
        self._id, self._count = uuid.uuid4().hex[:8], 0
        self._known: dict[str, Living] = {}

    @property
    def last(self) -> tuple[str, Living]:
        """The make that was shown last, by its name."""
        return next(reversed(self._known.items()))

    def find(self, design: Analysable) -> bool:
        """Whether a design is of a make that is known; if so, that is the last one from now on."""
        for name, living in reversed(self._known.items()):
            if alike(living.design, design):
                self._put(name, self._known.pop(name))
                return True
        return False

    def add(self, living: Living) -> None:
        """One make more, as it is recorded."""
        self._count += 1
        self._put(f"{self._id}.{self._count}", living)

    def design(self, name: object, values: Sequence[float]) -> Any:
        """The design of a make whose quantities have these values, in their order; ``ValueError`` for one not known."""
        return with_numbers(self.living(name).design, values)

    def living(self, name: object) -> Living:
        """What is recorded of a make; ``ValueError`` for one that is not known."""
        if name not in self._known:
            raise ValueError(f"no design of the make {shown(name)} is remembered here")
        return self._known[str(name)]

    def _put(self, name: str, living: Living) -> None:
        self._known[name] = living
        for old in [*self._known][:-REMEMBERED]:
            del self._known[old]
        for old in [*self._known][:-RECORDED]:
            self._known[old] = replace(self._known[old])  # it is recorded anew when it is asked for
