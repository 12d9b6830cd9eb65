"""The types that annotations speak of: arrays, and what may be one number or one for each of many designs."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

Array: TypeAlias = np.ndarray
"""Numbers of any shape; along a turn they are ``(n,)`` for one design and ``(p, n)`` for ``p`` designs."""
Value: TypeAlias = float | np.ndarray
"""One number, or an array of them: a column ``(p, 1)`` for ``p`` designs."""
