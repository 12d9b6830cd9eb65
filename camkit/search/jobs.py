"""Work shared among processes: of this machine, or of a cluster that is there; joblib is the one way out.

What is done for a task follows from the task alone, so that it is the same wherever it is done.
"""

from __future__ import annotations

import math
import re
import time
import warnings
from collections import Counter
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from ..quantities.applied import raised
from ..quantities.extras import extra
from ..quantities.kinds import shown, whole
from .checkpoint import versions
from .threads import in_one_thread

if TYPE_CHECKING:
    from concurrent.futures import Future

    from distributed import Client
    from joblib import Parallel
    from joblib.parallel import ParallelBackendBase

T = TypeVar("T")
R = TypeVar("R")
MOST = 512
"""So many processes there may be on one machine."""
BEGIN = 6.0
"""Seconds of the processor that must be saved: a process takes 2 to begin, and many of the clock where it is busy."""
LOST = 1.1
"""How much longer a task takes where others are done beside it, with its way there and back: 1.85 in place of 2."""
PATIENCE = 5.0
"""Seconds until a cluster has answered."""
IDLE = 60
"""Seconds after which a process that has nothing to do ends."""
ROUNDS = 3
"""How often work is handed to other processes, if some of them are lost; what is left is then done here."""


class Crew(NamedTuple):
    """Who does the work: so many processes, or this one alone."""

    size: int = 1
    client: Client | None = None
    """How the cluster is spoken to, if the processes are those of one."""


class Cost(NamedTuple):
    """Seconds of the processor that a task took: by the thread that did it, and by all that it had help from."""

    own: float
    all: float

    def times(self, factor: float) -> Cost:
        """So many times as much."""
        return Cost(self.own * factor, self.all * factor)

    @classmethod
    def since(cls, begun: Cost) -> Cost:
        """What was spent since then."""
        now = cls.now()
        return cls(now.own - begun.own, now.all - begun.all)

    @classmethod
    def now(cls) -> Cost:
        """What was spent up to now."""
        return cls(time.thread_time(), time.process_time())


def pays(cost: Cost, left: float, crew: Crew) -> bool:
    """Whether processes are done sooner with ``left`` tasks like one of that ``cost`` than this one is.

    What has help from threads here has none there.

    >>> [pays(Cost(5.0, 5.0), left, Crew(2)) for left in (1, 2, 4)]
    [False, False, True]
    """
    if crew.size == 1:
        return False
    from joblib import cpu_count

    here = left * (cost.own + max(cost.all - cost.own, 0) / cpu_count())
    return here > math.ceil(left / crew.size) * cost.all * LOST + BEGIN


def refuse_crew(jobs: object, cluster: object) -> None:
    """``ValueError`` in a sentence for what is no number of processes, and no address of a cluster."""
    whole(jobs, "the number of jobs", 1, MOST)
    if not isinstance(cluster, str) or not re.fullmatch(r"(?:(?:tcp|tls|ws|wss)://[^\s/]+:\d+)?", cluster):
        raise ValueError(f"the cluster is {shown(cluster)}; it must be the address of its scheduler: 'tcp://name:8786'")
    if cluster and jobs != 1:
        raise ValueError(f"there are {jobs} jobs and a cluster; give one of them: all workers of a cluster work")


@contextmanager
def crew_of(jobs: int, cluster: str) -> Iterator[Crew]:
    """The processes as they were asked for; ``ValueError`` in a sentence where the cluster is not there."""
    if not cluster:
        with extra("more than one job"):
            if jobs > 1:
                import cloudpickle  # noqa: F401
                import joblib  # noqa: F401
        yield Crew(jobs)
        return
    client = _connected(cluster)
    try:
        yield Crew(sum(client.ncores().values()), client)
    finally:
        with suppress(Exception):  # the work is done, or the cluster is gone
            client.close()


def done(work: Callable[[T], R], tasks: Sequence[T], crew: Crew) -> Generator[tuple[T, R]]:
    """Each of the ``tasks`` with what ``work`` gives for it, as it is done: here in order, elsewhere in any.

    A task that was lost with its process is done again, by another one or here, and one that could not be done there is
    done here; a warning (``RuntimeWarning``) says so.

    >>> list(done(abs, [-1, 2], Crew()))
    [(-1, 1), (2, 2)]
    """
    left, lost = dict(enumerate(tasks)), Counter[int]()
    for _ in range(ROUNDS):
        sent: list[int] = []
        with closing(_elsewhere(work, left, crew, sent)) as found:
            for place, result, why in found:
                sent.remove(place)
                task = left.pop(place)
                if why:
                    _warn(why)
                yield task, work(task) if why else result
        lost.update(sent)
        for task in [left.pop(place) for place in sent if lost[place] > 1]:
            yield task, work(task)
        if not sent:
            break
    for task in left.values():
        yield task, work(task)


def _warn(lost: str) -> None:
    warnings.warn(f"a part of the work was lost and is done again: {lost}", RuntimeWarning, stacklevel=3)


# ---------------------------------------------------------------- other processes


def _elsewhere(
    work: Callable[[T], R], left: Mapping[int, T], crew: Crew, sent: list[int]
) -> Generator[tuple[int, Any, str]]:
    """The place of each task that other processes have done, its result, and why there is none.

    ``sent`` are the places of those that are on their way; a warning says why no more of them will come.
    """
    if crew.size == 1 or not left:
        return
    import cloudpickle
    from joblib import delayed

    packed, waiting = cloudpickle.dumps(work), [*left.items()]

    def calls() -> Iterator[Any]:
        for place, task in waiting:
            sent.append(place)
            yield delayed(tried)(packed, place, (task,))

    results = None
    try:
        results = _parallel(crew, len(left))(calls())
        for result in results:  # noqa: UP028  left without a word below
            yield result
    except Exception as error:
        _warn(raised(error).partition("\n")[0])
    finally:
        if results is not None:
            with warnings.catch_warnings():  # what was not waited for is not worth a word
                warnings.simplefilter("ignore")
                results.close()


def _parallel(crew: Crew, tasks: int) -> Parallel:
    """What hands tasks to the processes, one at a time."""
    from joblib import Parallel, parallel_config

    given: dict[str, Any] = {"return_as": "generator_unordered", "batch_size": 1}
    if crew.client is not None:
        return Parallel(n_jobs=-1, backend=telling(crew.client), **given)
    with parallel_config("loky", inner_max_num_threads=1, idle_worker_timeout=IDLE):
        return Parallel(min(crew.size, tasks), pre_dispatch="n_jobs", max_nbytes=None, **given)


def tried(packed: bytes, place: int, task: tuple[Any]) -> tuple[int, Any, str]:
    """What another process does: its ``place``, the result, and why there is none."""
    try:
        with in_one_thread():
            return place, unpacked(packed)(*task), ""
    except Exception as error:
        return place, None, raised(error)


@lru_cache(maxsize=8)
def unpacked(packed: bytes) -> Callable[..., Any]:
    """The work, once for all tasks of it: with its study, which remembers what was made for it."""
    import cloudpickle

    work: Callable[..., Any] = cloudpickle.loads(packed)
    return work


# ---------------------------------------------------------------- a cluster


def _connected(cluster: str) -> Client:
    """How a cluster is spoken to that answers, has workers, and has there what is here."""
    with extra("a cluster", "cluster"):
        from distributed import Client
    client = None
    try:
        client = Client(cluster, timeout=PATIENCE, set_as_default=False)
        client.wait_for_workers(1, PATIENCE)
        found = client.run(versions, on_error="return")
        for worker, theirs in found.items():
            _refuse_other(worker, theirs)
    except Exception as error:
        if client is not None:
            client.close()
        if isinstance(error, ValueError):
            raise
        lacking = "no scheduler answers at" if client is None else "there is no worker in"
        raise ValueError(f"{lacking} the cluster {cluster}, after {PATIENCE:g} s: {raised(error)}") from None
    return client


def _refuse_other(worker: str, theirs: Mapping[str, str] | Exception) -> None:
    """``ValueError`` for a worker with other versions than there are here: it would answer otherwise, or not at all."""
    if isinstance(theirs, Exception):
        raise ValueError(f"the worker {worker} cannot load camkit: {raised(theirs)}")
    for what, here in versions().items():
        if theirs.get(what) != here:
            there = f"{what} {theirs.get(what)}"
            raise ValueError(f"the worker {worker} has {there}; here it is {what} {here}: the versions must agree")


def telling(client: Client) -> ParallelBackendBase:
    """joblib's way to a cluster, with word of a task that dask has given up, such as one that several workers died of.

    joblib 1.6 sets the error and tells nobody, so that whoever waits for the task would wait without end.
    """
    from joblib._dask import DaskDistributedBackend

    class Telling(DaskDistributedBackend):
        def submit(self, func: Callable[[], object], callback: Callable[[object], None]) -> Future:
            def told(future: Future) -> None:
                if error := future.exception():
                    callback(error)

            future: Future = super().submit(func, callback)
            future.add_done_callback(told)
            return future

        def retrieve_result_callback(self, out: object) -> object:
            if isinstance(out, BaseException):
                raise out
            return super().retrieve_result_callback(out)

    return Telling(client=client)
