"""The follower as the tool that cuts the cam: rollers or straight faces, one for each cam angle.

Both say how deep a point lies in them, and how far they stay from touching what is left of a flank.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

BLOCK = 256
"""How many points are compared with all faces at once."""


def _near(points: np.ndarray) -> cKDTree:
    """A tree that finds the nearest of points ``(2, n)``; scipy.spatial takes half a second to load."""
    from scipy.spatial import cKDTree

    return cKDTree(points.T)


@dataclass(frozen=True)
class Roller:
    """Rollers at ``centres`` ``(2, n)``, those of the rows first, or none: ``radius`` 0 cuts nothing away."""

    centres: np.ndarray
    radius: float

    @cached_property
    def _tree(self) -> cKDTree:
        return _near(self.centres)

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How deep points lie in a roller, < 0 outside of all, m."""
        return np.asarray(self.radius - self._tree.query(points.T)[0])

    def gaps(self, rows: np.ndarray, left: np.ndarray) -> np.ndarray:
        """How far the rollers of ``rows`` are from touching the points that are ``left``, m."""
        return np.asarray(_near(left).query(self.centres[:, rows].T)[0] - self.radius)


@dataclass(frozen=True)
class Face:
    """Straight faces with outward normals ``(2, n)`` through ``points`` ``(2, n)``."""

    normals: np.ndarray
    points: np.ndarray

    @cached_property
    def _reach(self) -> np.ndarray:
        return np.asarray((self.normals * self.points).sum(0))

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How far points lie beyond a face, < 0 before all, m."""
        blocks = np.array_split(points, max(points.shape[1] // BLOCK, 1), axis=1)
        return np.concatenate([(b.T @ self.normals - self._reach).max(-1) for b in blocks])

    def gaps(self, rows: np.ndarray, left: np.ndarray) -> np.ndarray:
        """How far the faces of ``rows`` are from touching the points that are ``left``, m."""
        return np.asarray(self._reach[rows] - (self.normals[:, rows].T @ left).max(-1))
