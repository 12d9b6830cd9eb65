"""One protocol for every search: ``for step in search(study, method, seed=1)``.

A `Step` says how far the search has come and what it has found by then; leave the loop to stop it.  Panels, pictures,
progress and time left know steps, and nothing else of a search.  What is found is a `Front` where there are several
objectives, and a `Minimum` where there is one.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Generator, Iterator, Mapping
from contextvars import copy_context
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from importlib import import_module
from inspect import signature
from queue import SimpleQueue
from typing import Any, NamedTuple, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..quantities.kinds import refuse_arguments
from ..study.margins import TightenedStudy
from ..study.options import Plain
from ..study.robust import RobustStudy
from ..study.study import Evaluation, Study
from .front import Front, front_of
from .minimum import Minimum, Reached
from .parts import Arrays, Parts, parts_of
from .threads import one_by_one

ONE = "minimise", "minimise_steps"
METHODS = {
    "nsga2": ("nsga2", "nsga2_steps"),
    "fast_front": ("fast_front", "fast_front_steps"),
    "epsilon_constraint": ("epsilon_constraint", "epsilon_constraint_steps"),
    "slsqp": ONE,
    "de": ONE,
    "ga": ONE,
    "competitive": ONE,
    "cycle_time": ("cycle_time", "cycle_time_steps"),
    "every": ("every", "every_steps"),
}
"""Where each method lives: its module, loaded when it is first asked for, and the function that gives its steps."""


class Evaluated(NamedTuple):
    """The best of the designs of a step: how many designs were evaluated by then, its objective, its limits."""

    evaluated: int
    f: float
    feasible: bool


T = TypeVar("T")
F = TypeVar("F", bound=Study)


@dataclass(frozen=True)
class Step:
    """Where a search stands after ``number`` of ``of`` parts (0 where nobody knows how many there will be)."""

    number: int
    of: int
    study: Study
    found: Evaluation | Callable[[], Evaluation]
    """What the search works with now, or how to get it."""
    evaluated: int = 0
    """How many designs were evaluated so far."""
    best: Minimum | None = None
    """The best design so far that keeps every limit, of a search with one objective."""
    message: str = ""
    """Why the search ended, or why it goes on without its checkpoint; empty where there is nothing to say."""
    record: Mapping[str, Any] = field(default_factory=dict)
    """How it was found: size, seed, seconds, versions."""
    options: tuple[Reached, ...] = ()
    """What was reached with each combination of options, at the end of a search that went through them."""
    seconds: float = np.nan
    """How long the search has taken, without its breaks."""
    unkept: str = ""
    """Why it goes on without its checkpoint; empty where it does not."""
    seeds: Mapping[int, Step] = field(default_factory=dict)
    """The last step with each seed that has ended, of a search from several."""

    @cached_property
    def evaluation(self) -> Evaluation:
        """The designs that the search works with now."""
        return self.found() if callable(self.found) else self.found

    @cached_property
    def front(self) -> Front:
        """The front so far."""
        return replace(front_of(self.evaluation, self.study), record=self.record, options=self.options)

    @property
    def feasible(self) -> int:
        """How many of the step's designs keep every limit."""
        return int(self.evaluation.feasible.sum())

    @property
    def seconds_left(self) -> float:
        """How long the search still takes, if it goes on as it did; ``nan`` where that cannot be known."""
        seconds = self.record.get("seconds", self.seconds)
        known = self.of and self.number
        return float(seconds / self.number * (self.of - self.number)) if known else np.nan

    @property
    def summary(self) -> Evaluated:
        """The best of the step's designs, by its first objective."""
        f, feasible = self.evaluation.f[:, 0], self.evaluation.feasible
        i = np.lexsort((f, ~feasible))[0]
        return Evaluated(self.evaluated, float(f[i]), bool(feasible[i]))


def search(study: Study, method: str = "", **options: Any) -> Iterator[Step]:
    """The steps of a search for the best designs of ``study``; leave the loop to stop it.

    ``step.number`` of ``step.of``, ``step.front`` (several objectives) or ``step.best`` (one) and ``step.message`` tell
    where it stands.  Without a ``method`` it is ``"nsga2"`` for several objectives and ``"slsqp"`` for one.

    - ``"nsga2"``: ``population``, ``generations``, ``seed``, ``checkpoint``; see `camkit.nsga2`.
    - ``"fast_front"``: ``size``, ``start``; see `camkit.quick_front`.
    - ``"epsilon_constraint"``: ``points`` and the options of one search; see `camkit.trade_off`.
    - ``"slsqp"``, ``"de"``, ``"ga"``, ``"competitive"``: ``seed``, ``starts``, ``designs``, ``recheck``; see
      `camkit.minimise`.  A step is one evaluation, and a stop takes effect before the next.
    - ``"cycle_time"``: ``limit``, ``shortest``, ``longest``, ``intervals``; see `camkit.shortest_interval`.
    - ``"every"``: ``designs``, a number of values of each free quantity (one number for all, or one each), whose
      combinations are all looked at, or a table of designs; however many there are, part by part, a step for each.

    ``seeds``, such as ``range(30)``, in place of a ``seed``: a search from each of them and the best of all, a step for
    each that has ended, and in ``step.seeds`` what each found.  ``jobs`` processes share the seeds, or the designs of
    ``"every"``, and so do the workers of a ``cluster`` of dask (``"tcp://name:8786"``, extra ``cluster``): to the same
    result to the last bit, and only where it is faster.  What is lost with a process is done again, and a warning says
    so.

    All take a ``checkpoint``, the name of a file in which what has ended of the search is kept: the same call goes on
    from it after a stop or the end of the process, to the same result as without the break.  It goes on without the
    file where it cannot be written, and says why in ``step.unkept``, ``"nsga2"`` in ``step.message``.

    >>> from camkit.machines import door_handle_study
    >>> for step in search(door_handle_study(), "nsga2", population=20, generations=9, seed=1):
    ...     if step.number == 3:
    ...         break
    >>> step.number, step.of, step.evaluated, len(step.front) > 0
    (3, 9, 60, True)
    >>> *_, last = search(door_handle_study(), "nsga2", population=20, generations=9, seeds=range(3), jobs=2)
    >>> [*last.seeds], last.evaluated, len(last.front) > len(last.seeds[0].front)
    ([0, 1, 2], 540, True)
    >>> *_, last = search(door_handle_study(), "every", designs=(20, 20, 20))
    >>> last.evaluated, len(last.front)
    (8000, 62)

    Raises ``ValueError`` for a method that there is not, and an option that it does not take; for a checkpoint that is
    damaged, or of another study, method, options or versions; for seeds, jobs or a cluster that are none, or that does
    not answer.
    """
    refuse_arguments(search, locals())
    method = method or ("slsqp" if len(study.minimise) == 1 else "nsga2")
    if method not in METHODS:
        raise ValueError(f"the method is {method!r}; there are {', '.join(map(repr, METHODS))}")
    if "seeds" in options:
        from .seeds import seeds_steps

        return seeds_steps(study, method, **options)
    if method != "every" and not {"jobs", "cluster"}.isdisjoint(options):
        raise ValueError(
            "jobs, or a cluster, share seeds or the designs of 'every': give seeds=range(30), for instance"
        )
    module, name = METHODS[method]
    steps = getattr(import_module(f".{module}", __package__), name)
    chosen = {"method": method} if METHODS[method] == ONE else {}
    checkpoint = None if method in ("nsga2", "every") else options.pop("checkpoint", None)
    try:
        signature(steps).bind(study, **chosen, **options)
    except TypeError as unfit:
        raise ValueError(f"the method {method!r} cannot search like this: {unfit}") from None
    if checkpoint is None:
        return _timed(steps(study, **chosen, **options), Parts())
    parts = parts_of(checkpoint, study, method, options)
    return _timed(steps(_followed(study, _nobody, parts), **chosen, **options), parts)


def _timed(steps: Iterator[Step], parts: Parts) -> Iterator[Step]:
    """The steps of a search, with how long they took."""
    try:
        for step in one_by_one(steps):
            known: dict[str, Any] = {"study": plain(step.study), "seconds": parts.seconds, "unkept": parts.unkept}
            yield step if "seconds" in step.record and not parts.path else replace(step, **known)
    finally:
        if isinstance(steps, Generator):
            steps.close()


# ---------------------------------------------------------------- searches that do not know of steps


class SearchStopped(Exception):
    """Nobody asks for the next step of a search any more."""


@dataclass(frozen=True)
class _FollowedStudy(TightenedStudy):
    """A study that hands every analysis of designs on, to a search whose ended ``parts`` are counted and kept."""

    follow: Callable[[Evaluation], None] | None = None
    parts: Parts | None = None

    def as_plain(self, start: Any, free: Any, of: Plain[Self]) -> Self:
        """The same study with some options, followed as designs of this one."""
        return _followed_too(super().as_plain(start, free, of), of)

    def analysis(self, x: ArrayLike) -> Any:
        """The analysis of the design or population ``x``."""
        analysis = super().analysis(x)
        assert self.follow is not None
        self.follow(self.judge(np.atleast_2d(x), analysis))
        return analysis

    def evaluate(self, x: ArrayLike) -> Evaluation:
        """Objectives and limits of designs."""
        found = super().evaluate(x)
        assert self.follow is not None
        if not self.menus:  # else those with the same options were handed on
            self.follow(found)
        return found


@dataclass(frozen=True)
class _FollowedRobustStudy(RobustStudy):
    """A study under tolerances that hands every evaluation of designs on, and those of itself as it is tightened."""

    follow: Callable[[Evaluation], None] | None = None
    parts: Parts | None = None

    def as_plain(self, start: Any, free: Any, of: Plain[Self]) -> Self:
        """The same study with some options, followed as designs of this one."""
        return _followed_too(super().as_plain(start, free, of), of)

    def evaluate(self, x: ArrayLike) -> Evaluation:
        """Objectives and limits of designs."""
        found = super().evaluate(x)
        assert self.follow is not None
        if not self.menus:  # else those with the same options were handed on
            self.follow(found)
        return found

    def tightened(self, margins: Callable[[np.ndarray], np.ndarray]) -> TightenedStudy:
        """The nominal study with limits tightened by ``margins``."""
        return _FollowedStudy(**_fields(self, Study), margins=margins, follow=self.follow, parts=self.parts)


def _followed_too(study: F, of: Plain[F]) -> F:
    """``study`` with the options ``of`` a plain one, whose designs are handed on as those of the whole study."""
    follow: Any = study.__dict__["follow"]
    study.__dict__["follow"] = lambda found: follow(replace(found, x=of.rows(found.x)))
    return study


def _fields(study: Study, kind: type) -> dict[str, Any]:
    return {f.name: getattr(study, f.name) for f in fields(kind)}


def plain(study: Study) -> Study:
    """``study`` as it was before somebody followed it."""
    if isinstance(study, _FollowedRobustStudy):
        return RobustStudy(**_fields(study, RobustStudy))
    return Study(**_fields(study, Study)) if isinstance(study, _FollowedStudy) else study


def _followed(study: Study, follow: Callable[[Evaluation], None], parts: Parts) -> Study:
    if isinstance(study, RobustStudy):
        return _FollowedRobustStudy(**_fields(study, RobustStudy), follow=follow, parts=parts)
    return _FollowedStudy(**_fields(study, Study), follow=follow, parts=parts)


def _nobody(evaluation: Evaluation) -> None:
    """Who is told of designs where the steps of a search are not made of them."""


def ended(study: Study, asked: ArrayLike, work: Callable[[], Arrays], designs: Callable[[Arrays], int]) -> Arrays:
    """What ``work()`` gives, a part of a search that follows from ``asked``; or what its checkpoint has of it.

    So many ``designs`` were then looked at for it.
    """
    parts: Parts | None = getattr(study, "parts", None)
    if not parts:
        return work()
    return parts.part(np.asarray(asked), work, designs)


def looked_at(study: Study, x: np.ndarray) -> Evaluation:
    """What a study says of designs of which a search looks at many together: a part of it."""
    new: list[Evaluation] = []

    def work() -> Arrays:
        new.append(study.evaluate(x))
        return new[0].x, new[0].f, new[0].g

    known = Evaluation(*ended(study, x, work, lambda found: 0))
    if not new:
        study.follow(known)  # type: ignore[attr-defined]
    return new[0] if new else known


def stepwise(study: Study, work: Callable[[Study], Minimum], of: int = 0, planned: int = 1) -> Iterator[Step]:
    """A step for each evaluation of ``work(study)``, and a last one with its result, whose message is not empty.

    It stands at so many designs ``of`` those that will be looked at, or where that is 0 at so many parts of those that
    are ``planned``.
    """
    parts: Parts = getattr(study, "parts", None) or Parts()
    begun, study = (parts.number, parts.skipped), plain(study)

    def follow(give: Callable[[Step], None]) -> None:
        best, looked = None, 0

        def note(evaluation: Evaluation) -> None:
            nonlocal best, looked
            looked += len(evaluation.x)
            count, done = looked + parts.skipped - begun[1], parts.number - begun[0]
            number, whole = (count, max(of, count)) if of else (done, max(planned, done + 1))
            step = Step(number, whole, study, evaluation, count)
            i = int(np.lexsort((evaluation.f[:, 0], ~evaluation.feasible))[0])
            better = step.summary.feasible and (best is None or step.summary.f < best.f)
            if better and (study.nominal is study or study.evaluate(evaluation.x[i]).feasible[0]):
                best = Minimum(study, evaluation.x[i].copy(), step.summary.f, True, count)
            give(replace(step, best=best))

        found = work(_followed(study, note, parts))
        end, count = partial(found.study.evaluate, found.x), looked + parts.skipped - begun[1]
        number = count if of else max(parts.number - begun[0], 1)
        give(Step(number, number, study, end, count, found, found.message))

    return relayed(follow)


def relayed(work: Callable[[Callable[[T], None]], None]) -> Iterator[T]:
    """What ``work(give)`` gives, one by one.

    ``work`` runs in a thread of its own, which waits in ``give`` until the next is asked for.  When the loop is left,
    ``give`` raises `SearchStopped` there.
    """
    asked: SimpleQueue[bool] = SimpleQueue()
    given: SimpleQueue[tuple[bool, Any]] = SimpleQueue()

    def give(thing: object) -> None:
        given.put((True, thing))
        if not asked.get():
            raise SearchStopped

    def run() -> None:
        try:
            work(give)
        except BaseException as error:
            given.put((False, error))
        else:
            given.put((False, None))

    thread = threading.Thread(target=copy_context().run, args=(run,), daemon=True)
    thread.start()
    try:
        while True:
            goes_on, thing = given.get()
            if not goes_on and thing:
                raise thing
            if not goes_on:
                return
            yield thing
            asked.put(True)
    finally:
        asked.put(False)
        thread.join()


# ---------------------------------------------------------------- the grid


def on_grid(shares: np.ndarray) -> np.ndarray:
    """Shares of the width between two bounds, moved to the nearest millionth (``2^-20``).

    Processors differ in the last bits of a power.  A search doubles such differences from generation to generation;
    on a grid they never arise, and a seed gives the same front everywhere.
    """
    return np.round(shares * 2**20) / 2**20
