"""The workers of a cluster come to the same end as one process, to the last bit; what one loses is done again."""

import os
import signal
import time
from functools import partial

import dask
import numpy as np
import pytest
from distributed import Client, LocalCluster

from camkit import mm, shaft_study
from camkit.machines import door_handle_study
from camkit.search import compute, every, jobs, search, seeds
from camkit.search.checkpoint import versions
from camkit.search.jobs import crew_of, done
from camkit.study import Sweep

DOOR = door_handle_study().replace(angles=61)
SHAFT = shaft_study()
SWEPT = SHAFT.freeing({"outer_diameter": (0.12, 0.14)}).under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})


@pytest.fixture(scope="module")
def address():
    """Of the scheduler of two processes; it gives a task up when one of them has died of it."""
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
    ):
        yield cluster.scheduler_address


@pytest.fixture
def eager(monkeypatch):
    """Work is shared however small it is."""
    monkeypatch.setattr(jobs, "BEGIN", -1e9)
    monkeypatch.setattr(seeds, "TRIED", 0.0)
    monkeypatch.setattr(every, "CHUNK", 256)


@pytest.fixture
def outside(monkeypatch):
    """Which tasks were given away."""
    given, parallel = [], jobs._parallel

    def seen(crew, tasks):
        given.append(tasks)
        return parallel(crew, tasks)

    monkeypatch.setattr(jobs, "_parallel", seen)
    return given


def last(study, method, **options):
    *_, step = search(study, method, **options)
    evaluation = step.evaluation
    return step.evaluated, *(value.tobytes() for value in (evaluation.x, evaluation.f, evaluation.g))


def test_seeds_are_shared(address, eager, outside):
    given = {"population": 12, "generations": 6, "seeds": range(4)}
    assert last(DOOR, "nsga2", cluster=address, **given) == last(DOOR, "nsga2", **given)
    assert outside == [4]


@pytest.mark.parametrize("designs", [12, np.linspace(*DOOR.bounds, 1500)], ids=["grid", "table"])
def test_designs_are_shared(designs, address, eager, outside):
    assert last(DOOR, "every", cluster=address, designs=designs) == last(DOOR, "every", designs=designs)
    assert outside
    assert outside[0] > 1


def test_a_sweep_is_shared(address, eager, outside):
    shared, one = Sweep(SWEPT, n=500), Sweep(SWEPT, n=500)
    list(compute(shared, cluster=address))
    list(compute(one))
    assert outside
    assert shared.evaluation.g.tobytes() == one.evaluation.g.tobytes()


def squared(here, marker, fails, k):
    """The square of ``k``; the first process other than that ``here`` which comes to 3 ends, or fails."""
    if k == 3 and os.getpid() != here and not marker.exists():
        marker.write_text("")
        if fails == "killed":
            os.kill(os.getpid(), signal.SIGKILL)
        raise MemoryError
    return k * k


@pytest.mark.parametrize(("fails", "told"), [("raised", "MemoryError"), ("killed", "KilledWorker")])
def test_a_lost_task_is_done_again(fails, told, address, tmp_path):
    work = partial(squared, os.getpid(), tmp_path / "marker", fails)
    with crew_of(1, address) as crew, pytest.warns(RuntimeWarning, match=f"^a part of the work was lost .*: {told}"):
        assert sorted(done(work, range(8), crew)) == [(k, k * k) for k in range(8)]


def short(k):
    time.sleep(0.1)
    return os.getpid()


def test_the_cluster_works_on_after_a_loop_was_left(address, recwarn):
    with Client(address, set_as_default=False) as client:
        client.wait_for_workers(2, 30)
    with crew_of(1, address) as crew:
        next(steps := done(short, range(20), crew))
        steps.close()
    with crew_of(1, address) as crew:
        assert crew.size == 2
        assert len({process for _, process in done(short, range(10), crew)} | {os.getpid()}) == 3
    assert not [each for each in recwarn.list if each.category is RuntimeWarning]


def test_a_cluster_that_is_not_there_is_refused(monkeypatch):
    monkeypatch.setattr(jobs, "PATIENCE", 0.5)
    begun = time.monotonic()
    told = r"^no scheduler answers at the cluster tcp://127\.0\.0\.1:9, after 0\.5 s: OSError: Timed out"
    with pytest.raises(ValueError, match=told):
        next(search(DOOR, "every", cluster="tcp://127.0.0.1:9"))
    assert time.monotonic() - begun < 30


def test_a_cluster_without_workers_is_refused(monkeypatch):
    monkeypatch.setattr(jobs, "PATIENCE", 0.5)
    with LocalCluster(n_workers=0, dashboard_address=":0") as empty:
        address = empty.scheduler_address
        with pytest.raises(ValueError, match=f"^there is no worker in the cluster {address}, after 0.5 s"):
            next(search(DOOR, "every", cluster=address))


def test_other_versions_are_refused(address, monkeypatch):
    here = os.getpid()
    monkeypatch.setattr(jobs, "versions", lambda: {**versions(), **({"numpy": "1.0"} if os.getpid() == here else {})})
    with pytest.raises(ValueError, match=r"^the worker tcp://\S+ has numpy \S+; here it is numpy 1\.0: the versions"):
        next(search(DOOR, "every", cluster=address))
