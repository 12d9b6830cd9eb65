"""`LatestOnly`: work in a thread that never queues; of what is asked for meanwhile, only the newest is done.

`Debounced`: work that waits until all is quiet.
"""

from __future__ import annotations

import threading
from collections.abc import Callable


class LatestOnly:
    """Calls ``work(task)`` in a thread of its own for the newest task; those in between are left out.

    ``work`` may look at ``stale`` to break off.
    """

    def __init__(self, work: Callable[..., object]) -> None:
        self._work, self._lock = work, threading.Lock()
        self._next: tuple[object, ...] = ()
        self._thread: threading.Thread | None = None

    @property
    def stale(self) -> bool:
        """Whether something newer waits, or the kernel is going and nobody waits any more."""
        return bool(self._next) or not threading.main_thread().is_alive()

    def ask(self, task: object) -> None:
        """Do ``task`` as soon as what is being done is finished; returns at once."""
        with self._lock:
            self._next = (task,)
            if self._thread is None:
                self._begin()

    def _begin(self) -> None:
        """A thread, if something waits; the lock is held."""
        self._thread = threading.Thread(target=self._run) if self._next else None
        if self._thread:
            self._thread.start()

    def wait(self, seconds: float | None = None) -> None:
        """Until nothing is left to do."""
        thread = self._thread
        if thread and thread is not threading.current_thread():
            thread.join(seconds)

    def _run(self) -> None:
        try:
            while task := self._taken():
                self._work(*task)
        except BaseException:
            with self._lock:
                self._begin()  # what waits is not to blame
            raise

    def _taken(self) -> tuple[object, ...]:
        """The newest task; without one the thread ends, and the next task begins another."""
        with self._lock:
            task, self._next = self._next, ()
            if not task:
                self._thread = None
            return task


class Debounced:
    """Calls ``act()`` so many ``seconds`` after the last `ask`, if the kernel is there by then, or in `settle`."""

    def __init__(self, act: Callable[[], None], seconds: float) -> None:
        self._act, self._seconds, self._acting = act, seconds, threading.RLock()
        self._timer: threading.Timer | None = None

    @property
    def waiting(self) -> bool:
        """Whether it was asked for and is still to be done."""
        return self._timer is not None

    def ask(self, seconds: float | None = None) -> None:
        """Put it off until nobody has asked for a while."""
        self.cancel()
        self._timer = threading.Timer(self._seconds if seconds is None else seconds, self._do)
        self._timer.start()

    def cancel(self) -> None:
        """It is not to be done any more, or is being done."""
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def settle(self) -> None:
        """Do it now, if it is still to be done, or wait while it is being done."""
        with self._acting:
            if self.waiting:
                self.cancel()
                self._act()

    def _do(self) -> None:
        if threading.main_thread().is_alive():  # else the kernel is going, and nobody looks
            self.settle()
