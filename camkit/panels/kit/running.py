"""What panels let run in threads: when a notebook's cell runs again, nothing that it began goes on unseen."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Generator, Iterator
from typing import Any, NamedTuple

from IPython.core.getipython import get_ipython

from ...search.protocol import Step

REPORT = 0.25
"""Seconds between two steps of a search that are shown."""

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
    """The steps of a search in a thread of its own, begun by a panel of this ``kind`` that was made at ``place``.

    ``steps()`` gives them.  ``show(step, last)`` is called for the first, now and then, and for the last; then ``end``
    with the error that the search ended with, if it did.  After Stop the step that comes next is the last.
    """

    def __init__(
        self,
        kind: str,
        place: Place,
        steps: Callable[[], Iterator[Step]],
        show: Callable[[Step, bool], None] = lambda step, last: None,
        end: Callable[[Exception | None], None] = lambda error: None,
    ) -> None:
        self.kind, self.place = kind, place
        self._steps, self._show, self._end = steps, show, end
        self._stop = threading.Event()
        self.step: Step | None = None
        self.ended = False
        """Whether the search came to its end."""
        self.thread = threading.Thread(target=self._run)

    def start(self) -> None:
        """Returns at once."""
        RUNNING.append(self)
        self.thread.start()

    def stop(self) -> None:
        """End the search with its next step."""
        self._stop.set()

    @property
    def stopping(self) -> bool:
        """Whether the next step is the last."""
        return self._stop.is_set() or not threading.main_thread().is_alive()  # the kernel is going

    def _run(self) -> None:
        error = None
        try:
            self._follow()
        except Exception as caught:  # shown to the user: a thread has no other way to speak
            error = caught
        finally:
            try:
                self._end(error)
            finally:
                RUNNING.remove(self)

    def _follow(self) -> None:
        shown, steps = -REPORT, self._steps()
        for step in steps:
            self.step = step
            if self.stopping:
                break
            if time.monotonic() - shown > REPORT:
                self._show(step, False)
                shown = time.monotonic()
        else:
            self.ended = True
        if isinstance(steps, Generator):
            steps.close()
        if self.step:
            self._show(self.step, True)


def left_behind(kind: str, place: Place) -> list[Job]:
    """Jobs whose panel a new one of this kind, made at ``place``, replaces.

    An earlier run of the same cell made it; where nobody says which cell it is, it is of the same kind.
    """
    return [job for job in list(RUNNING) if _replaced(job, kind, place)]


def _replaced(job: Job, kind: str, place: Place) -> bool:
    if job.place.cell and place.cell:
        return job.place.cell == place.cell and job.place.run != place.run
    return job.kind == kind
