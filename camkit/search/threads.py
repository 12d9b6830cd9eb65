"""Matrices of a search are small: to share one among threads takes longer than to do it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from functools import cache
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

T = TypeVar("T")


def in_one_thread() -> AbstractContextManager[object]:
    """A context in which BLAS works in one thread, where threadpoolctl is installed (extra ``lab``).

    >>> with in_one_thread():
    ...     pass
    """
    controller = _controller()
    return controller.limit(limits=1, user_api="blas") if controller else nullcontext()


@cache
def _controller() -> ThreadpoolController | None:
    """What knows the libraries of numpy and scipy, each its own."""
    try:
        import scipy.linalg  # noqa: F401
        from threadpoolctl import ThreadpoolController
    except ModuleNotFoundError:
        return None
    return ThreadpoolController()


def one_by_one(steps: Iterator[T]) -> Iterator[T]:
    """The steps of a search, each taken in one thread; whoever asked for it has as many as before.

    >>> list(one_by_one(iter([1, 2])))
    [1, 2]
    """
    while True:
        with in_one_thread():
            try:
                step = next(steps)
            except StopIteration:
                return
        yield step
