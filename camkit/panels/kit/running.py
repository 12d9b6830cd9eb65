"""What panels let run in threads: when a notebook's cell runs again, nothing that it began goes on unseen."""

from __future__ import annotations

import threading
import time
from collections.abc import Generator, Iterable
from typing import Any, NamedTuple, Protocol

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


class Owner(Protocol):
    """Who began a job, or took it over."""

    def show(self, step: Step, last: bool) -> None:
        """Called with the first step, now and then, and with the last."""

    def end(self, error: Exception | None) -> None:
        """Called when it is over, with the error that it ended with, if it did."""


class Job:
    """The steps of a search in a thread of its own, begun by a panel of this ``kind`` that was made at ``place``.

    Its ``owner`` is told of them, and may be another one while ``lock`` is held.  After Stop the step that comes next
    is the last.
    """

    def __init__(self, kind: str, place: Place, steps: Iterable[Step], owner: Owner | None = None) -> None:
        self.kind, self.place, self.steps, self.owner = kind, place, steps, owner
        self._stop = threading.Event()
        self.lock = threading.RLock()
        self.step: Step | None = None
        self.over = False
        """Whether its owner has been told that it is over."""
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
        steps, shown = iter(self.steps), -REPORT
        try:
            for self.step in steps:
                if self.stopping:
                    break
                if time.monotonic() - shown > REPORT:
                    self._show(self.step, last=False)
                    shown = time.monotonic()
            else:
                self.ended = True
        finally:
            if isinstance(steps, Generator):
                steps.close()
        if self.step:
            self._show(self.step, last=True)

    def _show(self, step: Step, last: bool) -> None:
        with self.lock:
            if self.owner:
                self.owner.show(step, last)

    def _end(self, error: Exception | None) -> None:
        with self.lock:
            self.over = True
            if self.owner:
                self.owner.end(error)


def left_behind(kind: str, place: Place) -> list[Job]:
    """Jobs whose panel a new one of this kind, made at ``place``, replaces.

    An earlier run of the same cell made it; where nobody says which cell it is, it is of the same kind.
    """
    return [job for job in list(RUNNING) if _replaced(job, kind, place)]


def _replaced(job: Job, kind: str, place: Place) -> bool:
    if job.place.cell and place.cell:
        return job.place.cell == place.cell and job.place.run != place.run
    return job.kind == kind
