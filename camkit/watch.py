"""A study that is watched while a search runs on it: how many designs were looked at, the best so far, and a stop.

Searches need not know: they look at the designs of a `WatchedStudy` as of any other.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np

from .study import Study


class Stopped(Exception):
    """Somebody asked a watched search to end."""


class Look(NamedTuple):
    """The best of the designs that a search looked at together: how many it had seen by then, objective, limits."""

    looked: int
    f: float
    kept: bool


class Watch:
    """How far a search has come; ``stop()`` ends it with `Stopped` before the next design.

    ``looked`` counts designs, ``best`` are the free values of the best so far that keeps every limit (``None`` while
    there is none) and ``f`` is its objective.  ``report(watch)`` is called after every `Look`.
    """

    def __init__(self, report: Callable[[Watch], None] = lambda watch: None) -> None:
        self.looked, self.f = 0, np.inf
        self.best: np.ndarray | None = None
        self.looks: list[Look] = []
        self._report, self._stop = report, threading.Event()

    def stop(self) -> None:
        """End the search before the next design."""
        self._stop.set()

    def before(self) -> None:
        """Raise `Stopped` if the search is to end."""
        if self._stop.is_set():
            raise Stopped

    def after(self, study: Study, x: np.ndarray, analysis: Any) -> None:
        """Take note of designs ``(p, n_free)`` and their analysis."""
        evaluation = study.judge(x, analysis)
        f, kept = evaluation.f[:, 0], evaluation.feasible
        self.looked += len(x)
        i = np.lexsort((f, ~kept))[0]
        self.looks.append(Look(self.looked, float(f[i]), bool(kept[i])))
        if kept[i] and f[i] < self.f:
            self.best, self.f = x[i].copy(), float(f[i])
        self._report(self)


@dataclass(frozen=True)
class WatchedStudy(Study):
    """A study whose every look at designs goes through a `Watch`."""

    watch: Watch | None = None

    def analyse(self, x: Any) -> Any:
        """The analysis of the design or population ``x``; `Stopped` if the search is to end."""
        assert self.watch is not None
        self.watch.before()
        analysis = super().analyse(x)
        self.watch.after(self, np.atleast_2d(x), analysis)
        return analysis


def watched(study: Study, watch: Watch) -> WatchedStudy:
    """``study`` under ``watch``.

    >>> from camkit.cam.high_speed_study import high_speed_study
    >>> watch, study = Watch(), high_speed_study()
    >>> _ = watched(study, watch).evaluate([study.x0, study.x0])
    >>> watch.looked, watch.looks[0].kept, f"{watch.f:.4f}"
    (2, True, '78.3608')
    """
    return WatchedStudy(**{f.name: getattr(study, f.name) for f in fields(Study)}, watch=watch)


def unwatched(study: Study) -> Study:
    """``study`` without a `Watch`, if it has one."""
    return Study(**{f.name: getattr(study, f.name) for f in fields(Study)})
