"""`Newest`: work in a thread that never queues; of what is asked for meanwhile, only the newest is done."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any


class Newest:
    """Calls ``work(task)`` in a thread of its own for the newest task; those in between are left out.

    ``work`` may look at ``stale`` to break off.
    """

    def __init__(self, work: Callable[[Any], None]) -> None:
        self._work, self._lock = work, threading.Lock()
        self._next: tuple[Any, ...] = ()
        self._thread: threading.Thread | None = None

    @property
    def stale(self) -> bool:
        """Whether something newer waits, or the kernel is going and nobody waits any more."""
        return bool(self._next) or not threading.main_thread().is_alive()

    def ask(self, task: Any) -> None:
        """Do ``task`` as soon as what is being done is finished; returns at once."""
        with self._lock:
            self._next = (task,)
            if self._thread is None:
                self._thread = threading.Thread(target=self._run)
                self._thread.start()

    def wait(self, seconds: float | None = None) -> None:
        """Until nothing is left to do."""
        thread = self._thread
        if thread and thread is not threading.current_thread():
            thread.join(seconds)

    def _run(self) -> None:
        while True:
            with self._lock:
                task, self._next = self._next, ()
                if not task:
                    self._thread = None
                    return
            self._work(*task)
