"""Resume: a search that was stopped, or whose kernel was killed, goes on from the file of its ended parts.

Beside that file stands what the search follows from: the design that it began with, and what the panel's boxes said.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from ...files import from_json, to_json
from ...quantities import Analysable
from ...search.checkpoint import why
from ...search.protocol import Step
from ...study.study import Study
from ..instrument import Instrument
from .inputs import Input
from .parts import Button
from .runner import Runner
from .search_files import Kept, keep, pending

Begun = Callable[[Path | None], Iterator[Step]]
"""A search that is ready to begin, or to go on from a checkpoint."""


class KeptSteps:
    """The steps of a search; its files go when it ends, and stay when it is stopped before.

    ``unkept`` says why it has no files, or has lost them; empty where it is kept.
    """

    def __init__(self, begun: Begun, kept: Kept | None = None, unkept: str = "") -> None:
        self._begun, self._kept, self.unkept = begun, kept, unkept

    def __iter__(self) -> Iterator[Step]:
        ended = False
        try:
            for step in self._begun(self._kept.checkpoint if self._kept else None):
                self.unkept = step.unkept or self.unkept
                yield step
            ended = True
        finally:
            if self._kept:
                self._kept.remove() if ended else self._kept.release()


class Resuming:
    """The button *Resume* of a panel whose search follows from the design in an instrument and from ``boxes``.

    ``begun(design)`` prepares the search, ``ValueError`` in a sentence if it cannot be.  What is kept is known by the
    ``name`` of the panel and the ``studies`` that it searches.
    """

    runner: Runner

    def __init__(
        self,
        name: str,
        explorer: Instrument,
        studies: Mapping[str, Study],
        boxes: Mapping[str, Input],
        begun: Callable[[Analysable], Begun],
    ) -> None:
        self.kind = f"{name}-{type(explorer.start).__name__}-{_short(repr([*map(_known_by, studies.items())]))}"
        self._explorer, self._boxes, self._begun = explorer, boxes, begun
        last = "go on with the last search that was stopped or killed"
        self.button = Button("Resume", self.resume, tooltip=last)
        self.steps = KeptSteps(lambda path: iter(()))
        self.offer()

    def begin(self) -> KeptSteps:
        """The search that the panel asks for, in files of its own; without them, and why, where none can be."""
        begun = self._begun(self._explorer.design)
        try:
            boxes = {name: box.value for name, box in self._boxes.items()}
            text = json.dumps({"design": to_json(self._explorer.design), "boxes": boxes})
            self.steps = KeptSteps(begun, keep(f"{self.kind}-{_short(text)}", text))
        except OSError as error:
            self.steps = KeptSteps(begun, unkept=why(error))
        except ValueError as refusal:  # a law of one's own, which no file can hold
            self.steps = KeptSteps(begun, unkept=str(refusal))
        self.button.disabled = True
        return self.steps

    def resume(self) -> None:
        """Go on with the last search that did not end, as it began; returns at once."""
        self.runner.begin(self._resumed, "This cannot be resumed")

    def _resumed(self) -> KeptSteps:
        kept = pending(self.kind)
        if kept is None:
            raise ValueError("there is no search that did not end")
        try:
            self.steps = KeptSteps(self._begun(self._put_back(kept)), kept)
        except ValueError:
            kept.release()
            raise
        self.button.disabled = True
        return self.steps

    def _put_back(self, kept: Kept) -> Analysable:
        """Show in the boxes what a search began with; its design."""
        damaged = ValueError(f"the file {kept.page.name} is damaged; delete it to begin anew")
        try:
            entries = json.loads(kept.text())
            boxes = {name: entries["boxes"][name] for name in self._boxes}
            if any(type(value) is not type(self._boxes[name].value) for name, value in boxes.items()):
                raise damaged
            design: Analysable = from_json(entries["design"], type(self._explorer.start))
            for name, value in boxes.items():
                self._boxes[name].value = value
        except Exception:  # whatever a file that somebody made can lead to
            raise damaged from None
        return design

    def offer(self) -> None:
        """Whether a search did not end, and nobody runs it."""
        if kept := pending(self.kind):
            kept.release()
        self.button.disabled = kept is None

    def tell(self) -> None:
        """Say that the search is not kept, if it is not."""
        if self.steps.unkept:
            self.runner.banner.show_message(
                f"This search is not kept in a file to resume it from: {self.steps.unkept}."
            )


def _known_by(named: tuple[str, Study]) -> object:
    name, study = named
    limits = [(measure.label, value, sense) for measure, value, sense in study.limits]
    return name, dict(study.free), [measure.label for measure in study.minimise], limits


def _short(text: str) -> str:
    """A name for a text."""
    return hashlib.sha256(text.encode()).hexdigest()[:12]
