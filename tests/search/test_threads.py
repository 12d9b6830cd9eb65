"""BLAS works in one thread within a search, and in as many as before outside of it."""

import sys

import numpy as np
import pytest
import scipy.linalg

from camkit import minimise, quick_front
from camkit.machines import high_speed_study, lift_curve_study
from camkit.search import threads
from camkit.search.protocol import search
from camkit.study.native import Answers

pools = pytest.importorskip("threadpoolctl")


def blas():
    """How many threads each library of matrices may take."""
    scipy.linalg.inv(np.linalg.inv(np.eye(2)))  # each has a library of its own
    return [pool["num_threads"] for pool in pools.threadpool_info() if pool["user_api"] == "blas"]


@pytest.fixture
def seen(monkeypatch):
    """What `blas` says whenever a study is asked, in an environment that allows two threads."""
    found, by_numpy = [], Answers.by_numpy

    def asked(self, *given):
        found.append(blas())
        return by_numpy(self, *given)

    monkeypatch.setattr(Answers, "by_numpy", asked)
    with pools.threadpool_limits(2, "blas"):
        yield found


@pytest.mark.parametrize("way", ["front", "steps", "minimum"])
def test_a_search_works_in_one_thread(seen, way):
    outside = blas()
    assert outside
    if way == "front":
        quick_front(lift_curve_study().replace(angles=61), 20)
    elif way == "steps":
        for step in search(lift_curve_study().replace(angles=61), "nsga2", population=8, generations=3):
            assert step.number
            assert blas() == outside
    else:
        minimise(high_speed_study(angles=41))
    assert seen
    assert all(number == 1 for each in seen for number in each)
    assert blas() == outside


def test_without_threadpoolctl_a_search_goes_as_before(monkeypatch):
    monkeypatch.setitem(sys.modules, "threadpoolctl", None)
    threads._controller.cache_clear()
    assert list(threads.one_by_one(iter("ab"))) == ["a", "b"]
    threads._controller.cache_clear()


def test_an_error_of_a_step_comes_out():
    def steps():
        yield 1
        raise ValueError("no further")

    with pytest.raises(ValueError, match="no further"):
        list(threads.one_by_one(steps()))
