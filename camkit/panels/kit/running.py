"""What panels let run in threads: when a notebook's cell runs again, nothing that it began goes on unseen."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, NamedTuple

from IPython.core.getipython import get_ipython

RUNNING: list[Job] = []
"""Every job of this kernel that has not ended."""


class Place(NamedTuple):
    """A notebook's cell, and the message that made it run; empty where there is no notebook that says so."""

    cell: str
    run: str


def here() -> Place:
    """Where the code that runs now stands."""
    message: Any = getattr(get_ipython(), "parent_header", None) or {}
    cell = message.get("metadata", {}).get("cellId", "")
    return Place(str(cell), str(message.get("header", {}).get("msg_id", "")))


class Job:
    """``work()`` in a thread of its own, begun by a panel of this ``kind`` that was made at ``place``."""

    def __init__(self, kind: str, place: Place, work: Callable[[], None], stop: Callable[[], None]) -> None:
        self.kind, self.place, self.stop, self._work = kind, place, stop, work
        self.thread = threading.Thread(target=self._run)

    def start(self) -> None:
        """Returns at once."""
        RUNNING.append(self)
        self.thread.start()

    def _run(self) -> None:
        try:
            self._work()
        finally:
            RUNNING.remove(self)


def left_behind(kind: str, place: Place) -> list[Job]:
    """Jobs whose panel a new one of this kind, made at ``place``, replaces.

    An earlier run of the same cell made it; where nobody says which cell it is, it is of the same kind.
    """
    return [job for job in list(RUNNING) if _replaced(job, kind, place)]


def _replaced(job: Job, kind: str, place: Place) -> bool:
    if job.place.cell and place.cell:
        return job.place.cell == place.cell and job.place.run != place.run
    return job.kind == kind
