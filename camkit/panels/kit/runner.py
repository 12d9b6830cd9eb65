"""`Runner`: two buttons around a search in a thread of its own; `Choices`: the menus that say what the job is.

`JobPanel`: a panel with a `Runner` on the left and its picture on the right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import ipywidgets as w

from ...quantities import words
from ...quantities.markup import Html, html
from ...search.protocol import Step
from ...study.study import Study
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
    """Run and Stop, a line that says how far the search is, and a banner for what is impossible.

    ``prepare()`` gives the steps of a search, ``ValueError`` if it cannot be; they are taken in a `Job`, and
    ``show(step, last)`` is called now and then.  ``page`` is what the panel was made of: a search that was begun by
    the same panel, before its cell was run again, is stopped.
    """

    def __init__(
        self,
        description: str,
        prepare: Callable[[], Iterator[Step]],
        show: Callable[[Step, bool], None],
        *page: Any,
    ) -> None:
        self._kind, self._place = f"{description} {[named(thing) for thing in page]}", here()
        for left in left_behind(self._kind, self._place):
            left.stop()
        self._prepare, self._show = prepare, show
        self.job: Job | None = None
        fits = w.Layout(width="auto")
        self.run_button = w.Button(description=description, icon="play", button_style="primary", layout=fits)
        self.stop_button = w.Button(description="Stop", icon="stop", disabled=True, layout=fits)
        self.status, self.banner = w.HTML("not run yet"), banner()
        self.status.add_class("camkit-status")
        self.run_button.on_click(lambda _: self.run())
        self.stop_button.on_click(lambda _: self.stop())

    def run(self) -> None:
        """Start the search; returns at once."""
        if self.job and self.job.thread.is_alive():
            return
        try:
            steps = self._prepare()
        except IMPOSSIBLE as refusal:
            self._end(refusal)
            return
        show_message(self.banner, "")
        self.run_button.disabled, self.stop_button.disabled = True, False
        self.job = Job(self._kind, self._place, lambda: steps, self._show, self._end)
        self.job.start()

    def _end(self, error: Exception | None) -> None:
        if error:
            early = "This cannot be searched" if isinstance(error, IMPOSSIBLE) else "The search ended early"
            show_message(self.banner, f"{early}: {error}.")
        self.run_button.disabled, self.stop_button.disabled = False, True

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        if self.job:
            self.job.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the search has ended."""
        if self.job:
            self.job.thread.join(seconds)


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
