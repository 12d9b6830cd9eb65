"""The kernels of published pages: one for each page that is open, not for ever, and not too many.

Voila is told to use them in ``notebooks/voila.json``, where their limits are.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

from jupyter_server.services.kernels.kernelmanager import AsyncMappingKernelManager
from tornado.ioloop import IOLoop
from tornado.web import HTTPError
from traitlets import Integer
from voila.tornado.execution_request_handler import ExecutionRequestHandler


class PublishedKernels(AsyncMappingKernelManager):
    """Kernels that end with their page, whatever they compute, or when nobody has touched it for a while.

    The while is ``cull_idle_timeout``; a running search that is looked at is no rest.  A page that never opens, such
    as a crawler's, ends as if it were closed when its notebook has run.
    """

    most = Integer(16, min=1, config=True, help="kernels at the same time; whoever comes then is asked to wait")
    closed_for = Integer(60, min=1, config=True, help="seconds without a page after which a kernel ends")
    _starting = 0

    async def start_kernel(self, **kwargs: Any) -> str:  # type: ignore[override]
        """A kernel for a page that opens; a page too many is refused in a sentence."""
        if len(self) + self._starting >= self.most:
            said = f"all {self.most} places are taken, please come back in a few minutes"
            raise HTTPError(503, said, reason=said)
        self._starting += 1
        try:
            kernel_id = await super().start_kernel(**kwargs)
        finally:
            self._starting -= 1
        self._look_later(self._end_if_never_opened, kernel_id)
        return kernel_id

    async def shutdown_kernel(self, kernel_id: str, *how: Any, **more: Any) -> None:  # type: ignore[override]
        """End a kernel, and forget the notebook that Voila keeps for its page, which may never ask for it."""
        await super().shutdown_kernel(kernel_id, *how, **more)
        ExecutionRequestHandler._execution_data.pop(kernel_id, None)

    def notify_disconnect(self, kernel_id: str) -> None:
        """A page was closed, or its line is broken: it has a while to come back."""
        super().notify_disconnect(kernel_id)
        self._look_later(self._end_if_closed, kernel_id)

    def _look_later(self, look: Callable[[str], object], kernel_id: str) -> None:
        IOLoop.current().call_later(self.closed_for, look, kernel_id)

    def _closed(self, kernel_id: str) -> bool:
        return kernel_id in self and not self._kernel_connections.get(kernel_id)

    async def _end_if_closed(self, kernel_id: str) -> None:
        if self._closed(kernel_id):
            await self.shutdown_kernel(kernel_id)

    async def _end_if_never_opened(self, kernel_id: str) -> None:
        """As long as its notebook runs, a page cannot open: the while begins when the kernel comes to rest."""
        if not self._closed(kernel_id):
            return
        kernel: Any = self.get_kernel(kernel_id)
        rest = (datetime.now(UTC) - kernel.last_activity).total_seconds()
        if kernel.execution_state == "busy" or rest < self.closed_for:
            self._look_later(self._end_if_never_opened, kernel_id)
        else:
            await self.shutdown_kernel(kernel_id)
