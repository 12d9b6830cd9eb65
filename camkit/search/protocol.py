"""A study that is watched while a search runs on it: how many designs were looked at, the best so far, and a stop.

Searches need not know: they look at the designs of a `MonitoredStudy` as of any other.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np

from ..study.study import Study


class SearchStopped(Exception):
    """Somebody asked a watched search to end."""


class Evaluated(NamedTuple):
    """The best of the designs that a search looked at together: how many it had seen by then, objective, limits."""

    looked: int
    f: float
    kept: bool


class Monitor:
    """How far a search has come; ``stop()`` ends it with `SearchStopped` before the next design.

    ``looked`` counts designs, ``best`` are the free values of the best so far that keeps every limit (``None`` while
    there is none) and ``f`` is its objective.  ``report(watch)`` is called after every `Evaluated`.
    """

    def __init__(self, report: Callable[[Monitor], None] = lambda watch: None) -> None:
        self.looked, self.f = 0, np.inf
        self.best: np.ndarray | None = None
        self.looks: list[Evaluated] = []
        self._report, self._stop = report, threading.Event()

    def stop(self) -> None:
        """End the search before the next design."""
        self._stop.set()

    def before(self) -> None:
        """Raise `SearchStopped` if the search is to end."""
        if self._stop.is_set():
            raise SearchStopped

    def after(self, study: Study, x: np.ndarray, analysis: Any) -> None:
        """Take note of designs ``(p, n_free)`` and their analysis."""
        evaluation = study.judge(x, analysis)
        f, kept = evaluation.f[:, 0], evaluation.feasible
        self.looked += len(x)
        i = np.lexsort((f, ~kept))[0]
        self.looks.append(Evaluated(self.looked, float(f[i]), bool(kept[i])))
        if kept[i] and f[i] < self.f:
            self.best, self.f = x[i].copy(), float(f[i])
        self._report(self)


@dataclass(frozen=True)
class MonitoredStudy(Study):
    """A study whose every look at designs goes through a `Monitor`."""

    watch: Monitor | None = None

    def analyse(self, x: Any) -> Any:
        """The analysis of the design or population ``x``; `SearchStopped` if the search is to end."""
        assert self.watch is not None
        self.watch.before()
        analysis = super().analyse(x)
        self.watch.after(self, np.atleast_2d(x), analysis)
        return analysis


def monitored(study: Study, watch: Monitor) -> MonitoredStudy:
    """``study`` under ``watch``.

    >>> from camkit.machines.high_speed_study import high_speed_study
    >>> watch, study = Monitor(), high_speed_study()
    >>> _ = monitored(study, watch).evaluate([study.x0, study.x0])
    >>> watch.looked, watch.looks[0].kept, f"{watch.f:.4f}"
    (2, True, '78.3608')
    """
    return MonitoredStudy(**{f.name: getattr(study, f.name) for f in fields(Study)}, watch=watch)


def unmonitored(study: Study) -> Study:
    """``study`` without a `Monitor`, if it has one."""
    return Study(**{f.name: getattr(study, f.name) for f in fields(Study)})


def on_grid(shares: np.ndarray) -> np.ndarray:
    """Shares of the width between two bounds, moved to the nearest millionth (``2^-20``).

    Processors differ in the last bits of a power.  A search doubles such differences from generation to generation;
    on a grid they never arise, and a seed gives the same front everywhere.
    """
    return np.round(shares * 2**20) / 2**20
