"""Cam angles that show every stretch of a program, however narrow, and its joints and kinks from both sides."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from .program import MotionProgram, Segment

STEPS, LEAST, REST = 128, 16, 2
"""Even steps in a segment that moves, in the least of its smooth pieces, and in a dwell."""
ROUGH = 48
"""Even steps in a segment that moves where a search looks roughly."""
HAIR, ROUNDING = 1e-9, 4e-12
"""How far inside the ends of a piece its first and last angles lie: a share of it, and at least so many rad."""


class Resolution(NamedTuple):
    """Cam angles in the order of the program; within each of its smooth pieces they are even."""

    angle: np.ndarray
    """The cam angles, ``(n,)`` or ``(p, n)``, rad."""
    first: np.ndarray
    """Where each piece begins, ``(k,)``; its first and last angles lie a hair inside it, so that both sides speak."""
    last: np.ndarray
    """Where each piece ends, ``(k,)``."""
    moves: np.ndarray
    """Which angles belong to a segment that moves, ``(n,)``."""
    shares: tuple[tuple[int, Any], ...]
    """Of each piece the number of its segment, and its angles as shares of that."""

    @property
    def inner(self) -> np.ndarray:
        """Which angles have a neighbour of the same piece on both sides, ``(n,)``."""
        inside = np.ones(self.angle.shape[-1], dtype=bool)
        inside[self.first] = inside[self.last] = False
        return inside


def resolve(program: MotionProgram, steps: int = STEPS) -> Resolution:
    """The same number of ``steps`` for every segment that moves, whatever its angle.

    >>> from camkit.motion import Cycloidal, Dwell, MotionProgram, Rise
    >>> narrow = resolve(MotionProgram((Dwell(3.0), Rise(0.01, 1.0, Cycloidal()))))
    >>> narrow.angle.size, int((narrow.angle > 3).sum())
    (132, 129)
    """
    shares = [(i, *piece) for i, segment in enumerate(program.segments) for piece in _pieces(segment, steps)]
    spans = list(pairwise(program.starts))
    pieces = [
        (start + low * (end - start), start + high * (end - start), even)
        for i, low, high, even in shares
        for start, end in (spans[i],)
    ]
    sizes = np.array([even + 1 for *_, even in pieces])
    angles = [np.atleast_1d(_inside(low, high, even)) for low, high, even in pieces]
    lead = np.broadcast_shapes(*(angle.shape[:-1] for angle in angles))
    joined = np.concatenate([np.broadcast_to(angle, (*lead, angle.shape[-1])) for angle in angles], axis=-1)
    ends = np.cumsum(sizes)
    moves = np.repeat([even > REST for *_, even in pieces], sizes)
    return Resolution(joined, ends - sizes, ends - 1, moves, tuple((i, _inside(*piece)) for i, *piece in shares))


def _pieces(segment: Segment, steps: int) -> list[tuple[Any, Any, int]]:
    """The smooth pieces of a segment: from and to, as shares of it, and their steps."""
    if segment.still:
        return [(0.0, 1.0, REST)]
    ends = list(pairwise((0.0, *segment.kinks, 1.0)))
    alike = any(np.ndim(kink) for kink in segment.kinks)  # a population's: as many steps for each of its members
    shares = [1 / len(ends) if alike else high - low for low, high in ends]
    return [(low, high, max(LEAST, int(np.ceil(steps * x)))) for (low, high), x in zip(ends, shares, strict=True)]


def _inside(low: Any, high: Any, steps: int) -> Any:
    hair = np.minimum(np.maximum(HAIR * (high - low), ROUNDING), (high - low) / 4)
    return low + hair + (high - low - 2 * hair) * np.linspace(0, 1, steps + 1)
