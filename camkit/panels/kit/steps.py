"""What a person has done, to be undone and done again."""

from __future__ import annotations

from typing import Generic, TypeVar

REMEMBERED = 50
T = TypeVar("T")


class Steps(Generic[T]):
    """The states that a person has gone through, the last ``REMEMBERED`` of them, and those that were undone.

    >>> steps = Steps()
    >>> steps.leave("first"), steps.leave("second")
    (None, None)
    >>> steps.undo("third"), steps.undo("second"), steps.undo("first"), steps.redo("first")
    ('second', 'first', None, 'second')
    """

    def __init__(self) -> None:
        self._past: list[T] = []
        self._future: list[T] = []

    def leave(self, state: T) -> None:
        """Another state comes after this one."""
        self._past = [*self._past, state][-REMEMBERED:]
        self._future = []

    def undo(self, now: T) -> T | None:
        """The state before ``now``, if there is one."""
        return self._go(self._past, self._future, now)

    def redo(self, now: T) -> T | None:
        """The state that was left for ``now`` by `undo`, if there is one."""
        return self._go(self._future, self._past, now)

    @staticmethod
    def _go(there: list[T], back: list[T], now: T) -> T | None:
        if not there:
            return None
        back.append(now)
        return there.pop()

    @property
    def before(self) -> bool:
        """Whether there is anything to undo."""
        return bool(self._past)

    @property
    def after(self) -> bool:
        """Whether there is anything to do again."""
        return bool(self._future)
