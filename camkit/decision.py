"""From judgements to weights, and from a front to one design.

`ahp` is Saaty's analytic hierarchy process.  The choosers take a front (anything with an ``f``, or the array
itself: ``(p, k)``, every objective to be small) and return the index of the chosen design.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

RANDOM_INDEX = (0, 0, 0.58, 0.90, 1.12, 1.24, 1.32, 1.41, 1.45, 1.49)
"""Saaty (1980): mean consistency index of random reciprocal matrices of order 1..10."""

SAATY_SCALE = (*(1 / k for k in range(9, 1, -1)), *map(float, range(1, 10)))
"""The judgements that Saaty's scale knows, 1/9 .. 9."""


@dataclass(frozen=True)
class Judgement:
    """What follows from a matrix of pairwise judgements; unpacks as weights and consistency ratio."""

    matrix: np.ndarray
    weights: np.ndarray
    lambda_max: float

    @property
    def consistency_index(self) -> float:
        """``(lambda_max - n) / (n - 1)``; 0 for judgements without contradiction."""
        n = len(self.weights)
        return max((self.lambda_max - n) / (n - 1), 0.0) if n > 1 else 0.0

    @property
    def consistency_ratio(self) -> float:
        """Consistency index over Saaty's (1980) random index; above 0.1 the judgements contradict each other."""
        random = RANDOM_INDEX[len(self.weights) - 1]
        return self.consistency_index / random if random else 0.0

    @property
    def worst(self) -> tuple[int, int]:
        """Row and column of the judgement that lies farthest from what the weights say."""
        gap = abs(np.log(self.matrix * self.weights / self.weights[:, None]))
        i, j = np.unravel_index(np.argmax(np.triu(gap, 1)), gap.shape)
        return int(i), int(j)

    def __iter__(self) -> Iterator[Any]:
        return iter((self.weights, self.consistency_ratio))


def judgement_matrix(judgements: Any) -> np.ndarray:
    """The reciprocal matrix from itself or from its upper triangle, read row by row.

    >>> judgement_matrix([4, 3, 1 / 2]).tolist()
    [[1.0, 4.0, 3.0], [0.25, 1.0, 0.5], [0.3333333333333333, 2.0, 1.0]]

    Raises ``ValueError`` naming the entry that is missing, not positive or not reciprocal.
    """
    try:
        a = np.array(judgements, dtype=float)
    except (TypeError, ValueError):
        raise ValueError("the judgements must be a square matrix of numbers or its upper triangle") from None
    if a.ndim == 1:
        a = _from_upper(a)
    if a.ndim != 2 or a.shape[0] != a.shape[1] or not a.size:
        raise ValueError(f"the judgements have the shape {a.shape}; they must be a square matrix")
    if len(a) > len(RANDOM_INDEX):
        raise ValueError(f"there are {len(a)} criteria; Saaty's random index is known up to {len(RANDOM_INDEX)}")
    for i, j in np.ndindex(a.shape):
        if not (np.isfinite(a[i, j]) and a[i, j] > 0):
            raise ValueError(f"judgement ({i + 1}, {j + 1}) is {a[i, j]:g}; it must be a positive number")
    for i, j in np.ndindex(a.shape):
        if j >= i and abs(a[i, j] * a[j, i] - 1) > 1e-6:
            raise ValueError(
                f"judgement ({i + 1}, {j + 1}) is {a[i, j]:.6g} and ({j + 1}, {i + 1}) is {a[j, i]:.6g}; "
                + ("the diagonal must be 1" if i == j else "one must be 1 over the other")
            )
    return a


def _from_upper(values: np.ndarray) -> np.ndarray:
    n = round((1 + np.sqrt(1 + 8 * len(values))) / 2)
    if n * (n - 1) // 2 != len(values):
        raise ValueError(f"{len(values)} judgements are no upper triangle; 1, 3, 6, 10, ... are")
    a = np.eye(n)
    a[np.triu_indices(n, 1)] = values
    with np.errstate(divide="ignore"):
        return np.where(np.tri(n, k=-1, dtype=bool), 1 / np.where(a.T == 0, np.nan, a.T), a)


def ahp(judgements: Any, method: str = "eigenvector") -> Judgement:
    """Weights and consistency of pairwise judgements (Saaty 1980).

    ``judgements[i][j]`` says how many times criterion ``i`` matters more than ``j``; a reciprocal matrix, or its
    upper triangle row by row.  ``method``: ``"eigenvector"`` (principal eigenvector) or ``"geometric"`` (row
    geometric means).

    >>> weights, ratio = ahp([[1, 5, 5], [1 / 5, 1, 1], [1 / 5, 1, 1]])
    >>> (weights * 7).round(6).tolist(), round(ratio, 6)
    ([5.0, 1.0, 1.0], 0.0)

    Raises ``ValueError`` for a matrix that is not square, positive and reciprocal, naming the entry.
    """
    a = judgement_matrix(judgements)
    if method == "eigenvector":
        values, vectors = np.linalg.eig(a)
        w = abs(vectors[:, np.argmax(values.real)].real)
    elif method == "geometric":
        w = np.exp(np.log(a).mean(axis=1))
    else:
        raise ValueError(f"the method is {method!r}; there are 'eigenvector' and 'geometric'")
    w = w / w.sum()
    return Judgement(a, w, float(np.mean(a @ w / w)))


def _objectives(front: Any) -> np.ndarray:
    try:
        f = np.asarray(getattr(front, "f", front), dtype=float)
    except (TypeError, ValueError):
        raise ValueError("the front must be a table of numbers, a row for each design") from None
    if f.ndim != 2 or not f.size:
        raise ValueError("the front is empty; there is no design to choose")
    if not np.isfinite(f).all():
        raise ValueError("the front has an objective that is not a finite number")
    return f


def _weights(weights: Any, k: int) -> np.ndarray:
    try:
        w = np.full(k, 1 / k) if weights is None else np.asarray(weights, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"the weights are {weights!r}; they must be numbers") from None
    if w.shape != (k,):
        raise ValueError(f"there are {w.size} weights for {k} objectives")
    if not (np.isfinite(w).all() and (w >= 0).all() and w.sum() > 0):
        raise ValueError("the weights must be finite, none negative, not all 0")
    return w / w.sum()


def normalised(f: np.ndarray) -> np.ndarray:
    """Objectives scaled to 0 (best of the front) .. 1 (worst)."""
    span = np.ptp(f, axis=0)
    return (f - f.min(axis=0)) / np.where(span > 0, span, 1)


def weighted_sum(front: Any, weights: Any = None) -> int:
    """The design with the least weighted sum of normalised objectives.

    >>> weighted_sum([[0, 1], [0.2, 0.2], [1, 0]])
    1
    """
    f = _objectives(front)
    return int(np.argmin(normalised(f) @ _weights(weights, f.shape[1])))


def topsis(front: Any, weights: Any = None) -> int:
    """The design nearest the ideal and farthest from the worst (Hwang, Yoon 1981; normalised by the range).

    >>> topsis([[0, 1], [0.2, 0.2], [1, 0]])
    1
    """
    f = _objectives(front)
    y = normalised(f) * _weights(weights, f.shape[1])
    to_best = np.linalg.norm(y - y.min(axis=0), axis=1)
    to_worst = np.linalg.norm(y - y.max(axis=0), axis=1)
    total = to_best + to_worst
    return int(np.argmax(np.divide(to_worst, total, out=np.ones_like(total), where=total > 0)))


def crowding_distance(f: Any) -> np.ndarray:
    """Crowding distance of each member of a front, ``inf`` at the ends (Deb et al. 2002)."""
    y = normalised(np.asarray(f, dtype=float))
    distance = np.zeros(len(y))
    for column in y.T:
        order = np.argsort(column, kind="stable")
        sorted_ = column[order]
        distance[order[[0, -1]]] = np.inf
        distance[order[1:-1]] += sorted_[2:] - sorted_[:-2]
    return distance


def crowding(front: Any, weights: Any = None) -> int:
    """The inner design that stands most alone on the front, the way in which the door-handle paper chooses.

    ``weights`` are not used; they are there so that every chooser is called alike.

    >>> crowding([[0, 1], [0.1, 0.8], [0.5, 0.2], [1, 0]])
    2
    """
    f = _objectives(front)
    distance = crowding_distance(f)
    inner = np.isfinite(distance)
    return int(np.argmax(np.where(inner, distance, -1))) if inner.any() else 0


CHOOSERS = {"crowding distance": crowding, "weighted sum": weighted_sum, "TOPSIS": topsis}
"""The ways to choose, by the name that a menu shows."""
