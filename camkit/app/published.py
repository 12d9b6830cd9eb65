"""The kernels of published pages: one for each page that is open, not for ever, and not too many.

Voila is told to use them in ``notebooks/voila.json``, where their limits are.
"""

from __future__ import annotations

from typing import Any

from jupyter_server.services.kernels.kernelmanager import AsyncMappingKernelManager
from tornado.ioloop import IOLoop
from tornado.web import HTTPError
from traitlets import Integer


class PublishedKernels(AsyncMappingKernelManager):
    """Kernels that end with their page, whatever they compute, or when nobody has touched it for a while.

    The while is ``cull_idle_timeout``; a running search that is looked at is no rest.
    """

    most = Integer(16, min=1, config=True, help="kernels at the same time; whoever comes then is asked to wait")
    closed_for = Integer(60, min=0, config=True, help="seconds without a page after which a kernel ends")
    _starting = 0

    async def start_kernel(self, **kwargs: Any) -> str:  # type: ignore[override]
        """A kernel for a page that opens; a page too many is refused in a sentence."""
        if len(self) + self._starting >= self.most:
            said = f"all {self.most} places are taken, please come back in a few minutes"
            raise HTTPError(503, said, reason=said)
        self._starting += 1
        try:
            return await super().start_kernel(**kwargs)
        finally:
            self._starting -= 1

    def notify_disconnect(self, kernel_id: str) -> None:
        """A page was closed, or its line is broken: it has a while to come back."""
        super().notify_disconnect(kernel_id)
        IOLoop.current().call_later(self.closed_for, self._end_if_closed, kernel_id)

    async def _end_if_closed(self, kernel_id: str) -> None:
        if kernel_id in self and not self._kernel_connections.get(kernel_id):
            await self.shutdown_kernel(kernel_id)
