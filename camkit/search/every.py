"""Every design of a grid or a table, chunk by chunk: more than one array could hold, shared among processes.

Chunks begin at the same designs however they are shared, so that what is found is the same to the last bit.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import closing, nullcontext
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..study.native import made_first
from ..study.robust import RobustStudy
from ..study.study import Evaluation, Study
from ..study.sweep import Sweep
from .checkpoint import versions
from .designs import Designs, Grid, designs_of
from .front import dominated
from .jobs import Cost, Crew, crew_of, done, pays, refuse_crew
from .minimum import Found, Minimum, described
from .parts import Parts, parts_of
from .protocol import Step

CHUNK, BLOCK = 8192, 64
"""So many designs are evaluated in one call, fewer of a study under tolerances; a multiple of the second."""
LARGE = 4 * CHUNK
"""For so many designs native code is worth waiting for."""
TASK, EACH = 0.5, 4
"""A task takes so many seconds of the processor, or less if there would not be so many tasks for each process."""


def every_steps(
    study: Study,
    designs: object = 10,
    jobs: int = 1,
    cluster: str = "",
    checkpoint: str | Path | None = None,
) -> Iterator[Step]:
    """What is best of many ``designs``: of all combinations of so many values of each free quantity, or of a table.

    A step for each part of them.  Of designs that are as good as each other in all objectives the first is kept.
    """
    refuse_crew(jobs, cluster)
    refuse_arguments(every_steps, locals())
    work = Work(study, designs_of(study, designs), best)
    return _steps_to_best(work, work.done(work.parts("every", checkpoint), jobs, cluster))


def compute(sweep: Sweep, jobs: int = 1, cluster: str = "", checkpoint: str | Path | None = None) -> Iterator[Step]:
    """Evaluate a sweep of many values part by part; after the last step its ``evaluation`` is there.

    ``jobs``, ``cluster`` and ``checkpoint`` are those of `search`.

    >>> from camkit.machines import shaft_study
    >>> from camkit.study import Sweep
    >>> sweep = Sweep(shaft_study().freeing({"outer_diameter": (0.12, 0.14)}), n=20_000)
    >>> [f"{step.number} of {step.of}" for step in compute(sweep)][-1], sweep.limits.shape
    ('20000 of 20000', (4, 20000))

    Raises ``ValueError`` as `search` does for these.
    """
    refuse_crew(jobs, cluster)
    refuse_arguments(compute, locals())
    work = Work(sweep.study, Grid(0, sweep.n, (sweep.x,)), all_of)
    return _steps_to_all(sweep, work, work.done(work.parts("sweep", checkpoint), jobs, cluster))


def _steps_to_best(work: Work, found: Generator[Progress]) -> Iterator[Step]:
    with closing(found):
        for now in found:
            best = _minimum(work, now) if len(work.study.minimise) == 1 else None
            yield _step(work, now, best)


def _steps_to_all(sweep: Sweep, work: Work, found: Generator[Progress]) -> Iterator[Step]:
    with closing(found):
        for now in found:
            if now.looked == work.designs.count:
                vars(sweep)["evaluation"] = now.kept.evaluation
            yield _step(work, now, None)


def _minimum(work: Work, now: Progress) -> Minimum | None:
    """The best design so far, if it keeps every limit; at the end what there is to say of it."""
    x, f, feasible = now.kept.x[0], float(now.kept.f[0, 0]), bool(now.kept.evaluation.feasible[0])
    if now.looked == work.designs.count:
        return described(work.study, Found(x, now.looked, (), "Every design was looked at"))
    return Minimum(work.study, x, f, True, now.looked) if feasible else None


def _step(work: Work, now: Progress, best: Minimum | None) -> Step:
    seconds = now.parts.seconds
    record = {"designs": now.looked, "of": work.designs.name, "seconds": seconds, "versions": versions()}
    return Step(now.looked, work.designs.count, work.study, now.kept.evaluation, now.looked, best,
        best.message if best else "", record, seconds=seconds, unkept=now.parts.unkept)  # fmt: skip


# ---------------------------------------------------------------- what is kept


class Kept(NamedTuple):
    """Designs with their numbers, in order of these, and what a study says of them."""

    place: Array
    x: Array
    f: Array
    g: Array

    @property
    def evaluation(self) -> Evaluation:
        """The same without numbers."""
        return Evaluation(self.x, self.f, self.g)

    def at(self, rows: Array) -> Kept:
        """Some of them."""
        return Kept(*(column[rows] for column in self))


def joined(several: Sequence[Kept]) -> Kept:
    """Designs of several parts in order of their numbers."""
    whole = Kept(*(np.concatenate(columns) for columns in zip(*several, strict=True)))
    return whole.at(np.argsort(whole.place, kind="stable"))


def all_of(kept: Kept) -> Kept:
    """All of them."""
    return kept


def best(kept: Kept) -> Kept:
    """Those that keep every limit and are not dominated, of equals the first; else the one that misses least."""
    evaluation = kept.evaluation
    good = np.flatnonzero(evaluation.feasible)
    if not len(good):
        unknown = ~np.isfinite(kept.f).all(-1)
        return kept.at(np.lexsort((kept.place, evaluation.missed.sum(-1), unknown))[:1])
    if kept.f.shape[1] == 1:
        return kept.at(good[[kept.f[good, 0].argmin()]])
    good = good[~dominated(kept.f[good])]
    return kept.at(good[np.sort(np.unique(kept.f[good], axis=0, return_index=True)[1])])


def found_in(study: Study, thin: Callable[[Kept], Kept], chunk: int, natively: bool, designs: Designs) -> Kept:
    """What is kept of some designs."""
    found: list[Kept] = []
    with made_first() if natively else nullcontext():
        for some in designs.cut(chunk):
            said = study.evaluate(some.rows)
            found.append(Kept(np.arange(some.begin, some.end, dtype=float), said.x, said.f, said.g))
            found = [thin(joined(found))]
    return found[0]


# ---------------------------------------------------------------- the work


class Progress(NamedTuple):
    """How many designs were looked at, what is kept of them, and what of that is in a file."""

    looked: int
    kept: Kept
    parts: Parts


class Work(NamedTuple):
    """What is to be kept of a study's designs, as ``thin`` says it of some of them."""

    study: Study
    designs: Designs
    thin: Callable[[Kept], Kept]

    @property
    def chunk(self) -> int:
        """How many designs are evaluated in one call."""
        each = 2 * len(self.study.tolerances) + 2 if isinstance(self.study, RobustStudy) else 1
        return max(CHUNK // each // BLOCK, 1) * BLOCK

    @property
    def one(self) -> Callable[[Designs], Kept]:
        """What is to be done for some designs."""
        natively = self.designs.count * (CHUNK // self.chunk) >= LARGE
        return partial(found_in, self.study, self.thin, self.chunk, natively)

    def parts(self, method: str, checkpoint: str | Path | None) -> Parts:
        """The ended parts of the work, in a file or not."""
        if checkpoint is None:
            return Parts()
        return parts_of(checkpoint, self.study, method, {"designs": self.designs.name, "chunk": self.chunk})

    def done(self, parts: Parts, jobs: int, cluster: str) -> Generator[Progress]:
        """How far it is, again and again: at first with what is in a file."""
        known = self._known(parts)
        looked, kept = sum(end - begin for begin, end in known), [*known.values()]
        rest = self._rest(known, parts)
        if kept:
            kept = [self.thin(joined(kept))]
            yield Progress(looked, kept[0], parts)
        if not rest:
            return
        with crew_of(jobs, cluster) as crew, closing(self._shared(rest, crew)) as results:
            for some, found in results:
                parts.keep([some.begin, some.end], found)
                looked, kept = looked + some.count, [self.thin(joined([*kept, found]))]
                yield Progress(looked, kept[0], parts)

    def _shared(self, rest: list[Designs], crew: Crew) -> Generator[tuple[Designs, Kept]]:
        """Parts of what is left, each with what is kept of it; the first says whether it pays to share them."""
        (first, *chunks), others = rest[0].cut(self.chunk), rest[1:]
        self.one(next(first.cut(BLOCK)))  # what is made once is made
        begun = Cost.now()
        found, cost = self.one(first), Cost.since(begun)
        yield first, found
        rest = [rest[0].part(first.end, rest[0].end), *others] if chunks else others
        left = sum(some.count for some in rest) / self.chunk
        size = max(int(min(TASK / max(cost.all, 1e-9), left / (EACH * crew.size))), 1)
        tasks = [task for some in rest for task in some.cut(size * self.chunk)]
        outside = pays(cost.times(size), len(tasks), crew)
        yield from done(self.one, tasks, crew if outside else Crew())

    def _known(self, parts: Parts) -> dict[tuple[int, int], Kept]:
        """What is in the file, by the first of the designs that were looked at and the one after the last, in order."""
        known = {}
        sizes = [1, len(self.study.free), len(self.study.minimise), len(self.study.limits)]
        for asked, arrays, _ in sorted(parts.kept(), key=lambda part: part[0]):
            place, *tables = (array.reshape(len(array), -1) for array in arrays)
            if len(asked) != 2 or [table.shape[1] for table in (place, *tables)] != sizes:
                raise parts.damaged
            known[asked[0], asked[1]] = Kept(place[:, 0], *tables)
        return known

    def _rest(self, known: Iterable[tuple[int, int]], parts: Parts) -> list[Designs]:
        """What was not looked at."""
        ends = [0, *(end for both in known for end in both), self.designs.count]
        if ends != sorted(ends) or any(end % self.chunk for end in ends[:-1] if end < ends[-1]):
            raise parts.damaged
        return [self.designs.part(a, b) for a, b in zip(ends[::2], ends[1::2], strict=True) if a < b]
