"""How a panel shows itself in a cell, and when the picture is made that stands for it where there is no kernel.

That picture takes longer than all else.  A page that runs the cell gets the panel alone first; the picture follows when
no cell has run and no page has spoken for a while, and nobody waits for it.
"""

from __future__ import annotations

import asyncio
import base64
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import ipywidgets as w
from IPython.core.getipython import get_ipython
from IPython.display import display

from .kept_designs import published
from .running import Place, here

REST = 1.0
"""Seconds without a running cell and without a word from a page after which pictures are made."""
BETWEEN = 0.1
"""Seconds between two of them, in which the kernel hears what a person does."""
SOON, PATIENCE = 0.02, 2.0
"""Seconds in which the next word of a page comes if it is on its way, and that a cell waits for all of them at most."""
Bundle = tuple[dict[str, object], dict[str, object]]


class Displayed(w.DOMWidget):
    """A widget that shows itself in a notebook: the live view, its numbers as text, and a still picture."""

    def drawing(self) -> Callable[[], bytes]:
        """What draws, as a PNG file, the picture of what is shown now, even if something else is shown by then."""
        raise NotImplementedError

    def still(self) -> bytes:
        """The picture, as a PNG file, that stands for the panel where there is no kernel."""
        return self.drawing()()

    def summary(self) -> str:
        """The panel's numbers, a line each."""
        raise NotImplementedError

    def settle(self) -> None:
        """Wait until everything that is shown belongs to what was asked for last."""

    def _handle_msg(self, msg: dict[str, Any]) -> None:
        """A page speaks: a picture that comes now would take the slider out of somebody's hand."""
        LATER.postpone()
        with HEARING.word():
            super()._handle_msg(msg)

    def _live(self) -> Bundle:
        """The live view, and the numbers where there is no kernel."""
        self.settle()
        made: Any = super()._repr_mimebundle_()
        data, about = made if isinstance(made, tuple) else (made or {}, {})
        return data | {"text/plain": self.summary()}, about

    def _repr_mimebundle_(self, **wanted: Any) -> Bundle:
        """The live panel for a kernel, the picture and the numbers where there is none."""
        data, about = self._live()
        return data if published() else data | _drawn(self.drawing()), about

    def _ipython_display_(self) -> None:
        """Show the panel alone, and its picture later; all at once where no page runs the cell."""
        place = here()
        if not place.cell:
            raise NotImplementedError  # IPython then asks for the whole bundle
        (data, about), draw = self._live(), self.drawing()
        shown: Any = display(data, metadata=about, raw=True, display_id=True)
        if not published():
            LATER.add(place, lambda: shown.update(data | _drawn(draw), metadata=about, raw=True))


def _drawn(draw: Callable[[], bytes]) -> dict[str, object]:
    return {"image/png": base64.b64encode(draw()).decode("ascii")}


class Later:
    """What is done when no cell runs; of a cell that runs again, what its last run asked for."""

    def __init__(self) -> None:
        self._acts: list[tuple[Place, Callable[[], None]]] = []
        self.timer: asyncio.TimerHandle | None = None
        self._hears = False

    def add(self, place: Place, act: Callable[[], None]) -> None:
        """Called while a cell runs."""
        self._acts = [(other, each) for other, each in self._acts if other.cell != place.cell or other == place]
        self._acts.append((place, act))
        if not self._hears:
            self._hears = True
            events: Any = get_ipython().events  # type: ignore[union-attr]
            events.register("pre_run_cell", self._wait)
            events.register("post_run_cell", lambda *_: self._rest(REST))

    def postpone(self) -> None:
        """Begin to rest anew."""
        if self.timer:
            self._rest(REST)

    def _wait(self, *_: object) -> None:
        if self.timer:
            self.timer.cancel()
            self.timer = None

    def _rest(self, seconds: float) -> None:
        self._wait()
        if self._acts:
            self.timer = asyncio.get_running_loop().call_later(seconds, self._next)

    def _next(self) -> None:
        (_, act), *self._acts = self._acts
        try:
            with suppress(ValueError, ArithmeticError):  # a design that cannot be drawn has no picture
                act()
        finally:  # whatever somebody's own view raises, the next picture is made
            self._rest(BETWEEN)


LATER = Later()
"""Of this kernel."""


class Hearing:
    """What pages say, which newer kernels hear on a thread of its own: a cell that is run waits until all is heard."""

    def __init__(self) -> None:
        self._thread: int | None = None
        self._last = -float("inf")
        self._waits = False

    @contextmanager
    def word(self) -> Iterator[None]:
        """A page speaks."""
        shell: Any = get_ipython()
        if shell and not self._waits:
            self._waits = True
            shell.events.register("pre_run_cell", self.wait)
        self._thread = threading.get_ident()
        try:
            yield
        finally:
            self._thread, self._last = None, time.monotonic()

    def wait(self, *_: object) -> None:
        """Until nobody speaks on another thread; somebody's own function that never ends is not waited for."""
        end = time.monotonic() + PATIENCE
        while (now := time.monotonic()) < end and self._thread != threading.get_ident():
            if self._thread is None and now - self._last > SOON:
                return
            time.sleep(SOON / 4)


HEARING = Hearing()
"""Of this kernel."""
