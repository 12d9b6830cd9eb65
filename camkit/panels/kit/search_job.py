"""The search that a session asks for, step by step, with the files that it can be resumed from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...files import Session
from ...search.front import Front, reference_point
from ...search.protocol import Step, search
from ...study.robust import RobustStudy
from .search_files import Kept

SIZE = ("population", "generations", "seed")
"""The settings of a session that are options of the search."""


class SessionSearch:
    """The steps of the search of a ``session``; its files go when it ends, and stay when it is stopped before.

    ``unkept`` says why it has no files, or has lost them; empty where it is kept.
    """

    def __init__(self, session: Session, kept: Kept | None = None, unkept: str = "") -> None:
        self.session, self.unkept, self._kept = session, unkept, kept
        self.reference: np.ndarray | None = None
        """The point up to which its hypervolumes count, known when it runs."""
        self.nominal: Front | None = None
        """The nominal front of a study within tolerances, known when it is found."""

    def __iter__(self) -> Iterator[Step]:
        ended = False
        try:
            self.reference = reference_point(self.session.study)
            for step in self._steps():
                self.unkept = step.message or self.unkept
                ended = step.number == step.of
                yield step
        finally:
            if self._kept:
                self._kept.remove() if ended else self._kept.release()

    def _steps(self) -> Iterator[Step]:
        size = {name: self.session.search[name] for name in SIZE}
        checkpoint, study = self._kept.checkpoint if self._kept else None, self.session.study
        if isinstance(study, RobustStudy):  # beside the nominal front, which is found first
            for step in search(study.nominal, "nsga2", **size):
                yield step
            self.nominal = step.front
        yield from search(study, "nsga2", checkpoint=checkpoint, **size)


def progress_text(step: Step, on_front: int, last: bool) -> str:
    """How far a search by NSGA-II has come, in words."""
    stopped = " (stopped)" if last and step.number < step.of else ""
    return (
        f"generation {step.number} of {step.of}{stopped}: {step.feasible} of {len(step.evaluation.x)} feasible, "
        f"{on_front} on the front"
    )
