"""Controls that a panel moves itself: nobody is to take that for the hand of a person."""

from __future__ import annotations

import threading
from collections.abc import Callable

from traitlets import HasTraits


class Quiet(threading.local):
    """Inside ``with quiet:`` nothing that moves is taken for a person's doing; what other threads move still is.

    >>> quiet, moved = Quiet(), print
    >>> act = quiet.unless(moved)
    >>> act(1)
    1
    >>> with quiet:
    ...     act(2)
    """

    def __init__(self) -> None:
        self._depth = 0

    def __enter__(self) -> None:
        self._depth += 1

    def __exit__(self, *_: object) -> None:
        self._depth -= 1

    def unless(self, act: Callable[..., object]) -> Callable[..., None]:
        """``act``, but nothing while it is quiet."""

        def heard(*given: object) -> None:
            if not self._depth:
                act(*given)

        return heard

    def hear(self, part: HasTraits, act: Callable[..., object]) -> None:
        """Call ``act(value)`` for each value that a person gives ``part``."""
        part.observe(self.unless(lambda change: act(change.new)), "value")
