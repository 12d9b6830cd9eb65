"""`Runner`: two buttons around a search in a thread of its own.

`JobPanel`: a panel with a `Runner` on the left and its picture on the right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import ipywidgets as w

from ...quantities.markup import Html, html
from ...search.protocol import Step
from .banner import Banner
from .layout import button, column, wrapped
from .panel import IMPOSSIBLE, Panel, reason
from .running import Job, here, left_behind


def told(result: str, why: str) -> Html:
    """A result and what there is to say about it, for a page."""
    return html("<div style='line-height: 1.45'><b>{}</b><br>{}</div>", result, why)


class Runner:
    """Run and Stop, a line that says how far the search is, and a banner for what is impossible.

    ``prepare()`` gives the steps of a search, ``ValueError`` if it cannot be; they are taken in a `Job`,
    ``show(step, last)`` is called now and then, and ``ended()`` when it is over.  ``page`` is what the panel was made
    of: what its jobs are known by.
    """

    def __init__(
        self,
        description: str,
        prepare: Callable[[], Iterable[Step]],
        show: Callable[[Step, bool], None],
        *page: object,
        ended: Callable[[], None] = lambda: None,
    ) -> None:
        self.kind, self.place = f"{description} {page}", here()
        self._prepare, self.show, self._ended = prepare, show, ended
        self.job: Job | None = None
        self.run_button = button(description, self.run, "play", button_style="primary")
        self.stop_button = button("Stop", self.stop, "stop", disabled=True)
        self.status, self.banner = w.HTML("not run yet"), Banner()
        self.status.add_class("camkit-status")

    @property
    def running(self) -> bool:
        """Whether a job of this runner goes on."""
        return self.job is not None and self.job.thread.is_alive()

    def replace_old(self, take_over: Callable[[Job], bool] = lambda job: False) -> None:
        """Stop what the same panel began before its cell was run again, unless the new one takes it over."""
        for job in left_behind(self.kind, self.place):
            if not (job.kind == self.kind and take_over(job)):
                job.stop()

    def run(self) -> None:
        """Start the search; returns at once."""
        self.begin(self._prepare, "This cannot be searched")

    def begin(self, prepare: Callable[[], Iterable[Step]], refused: str) -> None:
        """Start what ``prepare()`` gives; where it cannot be, say so after the words of ``refused``."""
        if self.running:
            return
        try:
            steps = prepare()
        except IMPOSSIBLE as refusal:
            self.banner.show_message(f"{refused}: {reason(refusal)}.")
            return
        self.banner.show_message("")
        self.adopt(Job(self.kind, self.place, steps, self))
        assert self.job
        self.job.start()

    def adopt(self, job: Job) -> None:
        """A job of one's own from now on."""
        self.job, job.owner = job, self
        self._show_buttons(running=True)

    def leave(self, why: str) -> None:
        """Somebody else has taken the job over."""
        self.job, self.status.value = None, why
        self._show_buttons(running=False)

    def end(self, error: Exception | None) -> None:
        """The job is over."""
        if error:
            began = (self.job and self.job.step) or not isinstance(error, IMPOSSIBLE)
            early = "The search ended early" if began else "This cannot be searched"
            self.banner.show_message(f"{early}: {reason(error)}.")
        self._show_buttons(running=False)

    def _show_buttons(self, running: bool) -> None:
        self.run_button.disabled, self.stop_button.disabled = running, not running
        if not running:
            self._ended()

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        if self.job and self.running:
            self.status.value = "stopping"
            self.job.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the search has ended."""
        if self.job:
            self.job.thread.join(seconds)


class JobPanel(Panel):
    """A panel around the job of its ``runner``."""

    runner: Runner

    def __init__(self, children: Sequence[w.Widget]) -> None:
        self.banner = self.runner.banner
        super().__init__(children)
        self.runner.replace_old(self._take_over)

    def _take_over(self, job: Job) -> bool:
        """Go on with a job that the panel of the cell's run before has begun, if that can be."""
        return False

    def _beside_picture(
        self, asked: Sequence[w.Widget], left: tuple[int, int] = (400, 620), right: tuple[int, int] = (420, 660)
    ) -> w.Widget:
        """What is asked, and the picture beside it or below; ``left`` and ``right``: usual and largest widths, px."""
        return wrapped(column(asked, *left), column([self.picture.widget], *right))

    def run(self) -> None:
        """Start the job; returns at once."""
        self.runner.run()

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        self.runner.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the job has ended."""
        self.runner.wait(seconds)
