"""`Runner`: two buttons around a search in a thread of its own.

`JobPanel`: a panel with a `Runner`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, nullcontext

from ...search.protocol import Step
from .parts import Banner, Button, Group, Part, Progress, Words, row
from .running import Job, here, left_behind
from .sheet import IMPOSSIBLE, Panel, reason


class Runner:
    """Run and Stop, how far the search is and how long it still takes, and a banner for what is impossible.

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
        self._prepare, self._show, self._ended = prepare, show, ended
        self.held: Callable[[], AbstractContextManager[None]] = nullcontext
        """What changes inside reaches the page together."""
        self.job: Job | None = None
        self.run_button = Button(description, self.run, primary=True)
        self.stop_button = Button("Stop", self.stop, disabled=True)
        self.progress, self.left = Progress(visible=False), Words(look="hint")
        self.status, self.banner = Words(value=["not run yet"], look="status"), Banner()

    def buttons(self, *others: Part) -> Group:
        """Run, Stop and ``others`` in a row, with how far the search is."""
        return row(self.run_button, self.stop_button, *others, self.progress, self.left)

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
        self.progress.value = 0
        self.adopt(Job(self.kind, self.place, steps, self))
        assert self.job
        self.job.start()

    def adopt(self, job: Job) -> None:
        """A job of one's own from now on."""
        self.job, job.owner = job, self
        self._show_buttons(running=True)

    def leave(self, why: str) -> None:
        """Somebody else has taken the job over."""
        self.job = None
        self.status.say(why)
        self._show_buttons(running=False)

    def show(self, step: Step, last: bool) -> None:
        """Show where the search stands."""
        with self.held():
            self.progress.visible, self.progress.max, self.progress.value = step.of > 0, step.of, step.number
            self.left.say("" if last else time_left(step))
            self._show(step, last)

    def end(self, error: Exception | None) -> None:
        """The job is over."""
        with self.held():
            if error:
                began = (self.job and self.job.step) or not isinstance(error, IMPOSSIBLE)
                early = "The search ended early" if began else "This cannot be searched"
                self.banner.show_message(f"{early}: {reason(error)}.")
            self._show_buttons(running=False)

    def _show_buttons(self, running: bool) -> None:
        self.run_button.disabled, self.stop_button.disabled = running, not running
        if not running:
            self.left.say()
            self._ended()

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        if self.job and self.running:
            self.status.say("stopping")
            self.job.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the search has ended."""
        if self.job:
            self.job.thread.join(seconds)


def time_left(step: Step) -> str:
    """How long a search still takes if it goes on as it did, in words; empty where nobody knows."""
    left = step.seconds_left
    if left < 90:
        return f"{left:.0f} s left"
    return f"{left / 60:.0f} min left" if left < float("inf") else ""


class JobPanel(Panel):
    """A panel around the job of its ``runner``."""

    runner: Runner

    def __init__(self, *children: Part, heading: str = "") -> None:
        self.banner, self.runner.held = self.runner.banner, self.held
        super().__init__(*children, heading=heading)
        self.runner.replace_old(self._take_over)

    def _take_over(self, job: Job) -> bool:
        """Go on with a job that the panel of the cell's run before has begun, if that can be."""
        return False

    def _beside_picture(self, *asked: Part) -> Group:
        """What is asked, and the picture beside it."""
        return Group(Group(*asked), self.picture, look="beside")

    def run(self) -> None:
        """Start the job; returns at once."""
        self.runner.run()

    def stop(self) -> None:
        """Stop before the next design; the best so far stays."""
        self.runner.stop()

    def wait(self, seconds: float | None = None) -> None:
        """Until the job has ended."""
        self.runner.wait(seconds)
