"""`Runner`: two buttons around a job in a thread of its own; `Choices`: the menus that say what the job is.

`JobPanel`: a panel with a `Runner` on the left and its picture on the right.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import ipywidgets as w

from ...markup import Html, html
from ...quantities import words
from ...search.protocol import Monitor
from ...study.study import Study
from ..pareto import REPORT
from .controls import banner, show_message
from .panel import IMPOSSIBLE, Panel
from .running import Job, here, left_behind

MakeStudy = Callable[..., Study]
"""Makes a study around a design, from what is chosen."""


def told(result: str, why: str) -> Html:
    """A result and what there is to say about it, for a page."""
    return html("<div style='line-height: 1.45'><b>{}</b><br>{}</div>", result, why)


def named(thing: Any) -> str:
    """A function by its name, since it is another one whenever its cell runs; anything else by what it is."""
    return str(getattr(getattr(thing, "func", thing), "__qualname__", None) or repr(thing))


class Choices:
    """A menu for each of some questions; ``values`` are the answers by the question's name."""

    def __init__(self, choices: Mapping[str, Mapping[str, Any]]) -> None:
        self.menus = {name: self._menu(name, options) for name, options in choices.items()}

    def _menu(self, name: str, options: Mapping[str, Any]) -> w.Dropdown:
        style = {"description_width": "112px"}
        layout = w.Layout(width="100%", max_width="400px")
        return w.Dropdown(options=list(options.items()), description=words(name), layout=layout, style=style)

    @property
    def values(self) -> dict[str, Any]:
        """What is chosen in each menu."""
        return {name: menu.value for name, menu in self.menus.items()}

    @property
    def words(self) -> str:
        """What is chosen, in the menus' words."""
        return ", ".join(f"{menu.description}: {menu.label}" for menu in self.menus.values())


class Runner:
    """Run and Stop, a line that says how far the job is, and a banner for what is impossible.

    ``prepare()`` says what is to be done, ``ValueError`` if it cannot be.  ``job(task, watch)`` does it in a thread of
    its own, on studies under ``watch``: the page stays alive, and Stop takes effect before the next design.
    ``report(watch)`` is called now and then meanwhile.  ``page`` is what the panel was made of: a job that was begun
    by the same panel, before its cell was run again, is stopped.
    """

    def __init__(
        self,
        description: str,
        prepare: Callable[[], Any],
        job: Callable[[Any, Monitor], None],
        report: Callable[[Monitor], None],
        *page: Any,
    ) -> None:
        self._kind, self._place = f"{description} {[named(thing) for thing in page]}", here()
        for left in left_behind(self._kind, self._place):
            left.stop()
        self._prepare, self._job, self._report, self._reported = prepare, job, report, 0.0
        self.watch = Monitor()
        self._running: Job | None = None
        fits = w.Layout(width="auto")
        self.run_button = w.Button(description=description, icon="play", button_style="primary", layout=fits)
        self.stop_button = w.Button(description="Stop", icon="stop", disabled=True, layout=fits)
        self.status, self.banner = w.HTML("not run yet"), banner()
        self.status.add_class("camkit-status")
        self.run_button.on_click(lambda _: self.run())
        self.stop_button.on_click(lambda _: self.stop())

    def run(self) -> None:
        """Start the job; returns at once."""
        if self._running and self._running.thread.is_alive():
            return
        try:
            task = self._prepare()
        except IMPOSSIBLE as refusal:
            self._refuse(refusal)
            return
        show_message(self.banner, "")
        self.run_button.disabled, self.stop_button.disabled = True, False
        self.watch = watch = Monitor(self._look)
        self._running = Job(self._kind, self._place, lambda: self._work(task, watch), watch.stop)
        self._running.start()

    def _refuse(self, refusal: Exception) -> None:
        show_message(self.banner, f"This cannot be searched: {refusal}.")

    def _look(self, watch: Monitor) -> None:
        if not threading.main_thread().is_alive():  # the kernel is going, and nobody waits for the result
            watch.stop()
        if time.monotonic() - self._reported > REPORT:
            self._report(watch)
            self._reported = time.monotonic()

    def _work(self, task: Any, watch: Monitor) -> None:
        try:
            self._job(task, watch)
        except ValueError as refusal:
            self._refuse(refusal)
        except Exception as error:  # shown to the user: a thread has no other way to speak
            show_message(self.banner, f"The search ended early: {error}.")
        finally:
            self.run_button.disabled, self.stop_button.disabled = False, True

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        self.watch.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the job has ended."""
        if self._running:
            self._running.thread.join(seconds)


class JobPanel(Panel):
    """A panel around the job of its ``runner``."""

    runner: Runner

    def _beside_picture(
        self, asked: Sequence[w.Widget], left: tuple[int, int] = (400, 620), right: tuple[int, int] = (420, 660)
    ) -> w.Widget:
        """What is asked, and the picture beside it or below; ``left`` and ``right``: usual and largest widths, px."""
        sides = ((asked, left), ([self.picture.widget], right))
        columns = [
            w.VBox(children, layout=w.Layout(flex=f"1 1 {usual}px", max_width=f"{most}px"))
            for children, (usual, most) in sides
        ]
        return w.HBox(columns, layout=w.Layout(flex_flow="row wrap"))

    def run(self) -> None:
        """Start the job; returns at once."""
        self.runner.run()

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        self.runner.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the job has ended."""
        self.runner.wait(seconds)
