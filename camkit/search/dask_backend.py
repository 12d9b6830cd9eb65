"""joblib's way to a cluster of dask, with word of tasks that dask has given up."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from joblib._dask import DaskDistributedBackend


class TellingBackend(DaskDistributedBackend):
    """Tells of a task that ends with an error of dask itself, such as one that several workers died of.

    joblib 1.6 sets the error and tells nobody, so that whoever waits for the task would wait without end.
    """

    def submit(self, func: Callable[[], Any], callback: Callable[[object], None] | None = None) -> Future:
        """Hand a task on; ``callback`` is told what it gives, or the error."""

        def told(future: Future) -> None:
            if callback and (error := future.exception()):
                callback(error)

        future: Future = super().submit(func, callback)
        future.add_done_callback(told)
        return future

    def retrieve_result_callback(self, out: object) -> Any:
        """What a task gives; raises its error."""
        if isinstance(out, BaseException):
            raise out
        return super().retrieve_result_callback(out)
