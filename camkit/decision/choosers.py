"""From a front to one design: the choosers, and the measures of distance behind them.

A chooser takes a front (anything with an ``f``, or the array itself: ``(p, k)``, every objective to be small) and gives
the index of the selected design: one for `Judgements` or weights ``(k,)``, an array ``(m,)`` for many at once
``(m, k)``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..quantities.kinds import numbers, shown
from .ahp import Judgements


def _numbers(value: object, must: str) -> np.ndarray:
    """An array of numbers, refused with a sentence where it is none."""
    try:
        return numbers(value, "all")
    except ValueError:
        raise ValueError(must) from None


def objectives_of(front: object) -> np.ndarray:
    """The objectives of a front, ``(p, k)``; ``ValueError`` for what is no front to choose from."""
    f = _numbers(getattr(front, "f", front), "the front must be a table of numbers, a row for each design")
    if not f.size:
        raise ValueError("the front is empty; there is no design to choose")
    if f.ndim != 2:
        raise ValueError(f"the front has the shape {f.shape}; it must be a table, a row for each design")
    if not np.isfinite(f).all():
        raise ValueError("the front has an objective that is not a finite number")
    return f


def _weights(weights: object, k: int) -> np.ndarray:
    weights = weights.weights if isinstance(weights, Judgements) else weights
    must = f"the weights are {shown(weights)}; they must be numbers"
    w = np.full(k, 1 / k) if weights is None else _numbers(weights, must)
    if w.ndim not in (1, 2) or w.shape[-1] != k:
        raise ValueError(f"there are {w.shape[-1] if w.ndim else 1} weights for {k} objectives")
    if not (np.isfinite(w).all() and (w >= 0).all() and (w.sum(-1) > 0).all()):
        raise ValueError("the weights must be finite, none negative, not all 0")
    return w / w.sum(-1, keepdims=True)


def _chosen(merit: np.ndarray) -> Any:
    """The index of the largest merit, for each set of weights."""
    best = np.argmax(merit, axis=-1)
    return best if best.ndim else int(best)


def _whatever_the_weights(index: int, weights: object, k: int) -> Any:
    """The same design for every set of weights."""
    w = _weights(weights, k)
    return index if w.ndim == 1 else np.full(len(w), index)


def normalised(f: object) -> np.ndarray:
    """Objectives scaled to 0 (best of the front) .. 1 (worst)."""
    f = _of_size_one(objectives_of(f))
    span = np.ptp(f, axis=0)
    return np.asarray((f - f.min(axis=0)) / np.where(span > 0, span, 1))


def _of_size_one(f: np.ndarray) -> np.ndarray:
    """Each objective divided by a power of two, which rounds nothing, so that no square or difference overflows."""
    return np.asarray(np.ldexp(f, -np.frexp(abs(f).max(axis=0))[1]))


def _of_length_one(f: object) -> np.ndarray:
    """Each objective as a vector over the designs, divided by its length."""
    f = _of_size_one(objectives_of(f))
    length = np.sqrt((f**2).sum(axis=0))
    return np.asarray(f / np.where(length > 0, length, 1))


def weighted_sum(front: object, weights: object = None) -> Any:
    """The design with the least weighted sum of normalised objectives.

    >>> weighted_sum([[0, 1], [0.2, 0.2], [1, 0]])
    1
    >>> weighted_sum([[0, 1], [0.2, 0.2], [1, 0]], [[1, 9], [1, 1], [9, 1]]).tolist()
    [2, 1, 0]
    """
    f = objectives_of(front)
    return _chosen(-_weights(weights, f.shape[1]) @ normalised(f).T)


SCALES: dict[str, Callable[[object], np.ndarray]] = {"vector": _of_length_one, "range": normalised}
"""Ways to make objectives comparable, by name."""


def topsis(front: object, weights: object = None, scale: str = "vector") -> Any:
    """The design nearest the ideal and farthest from the worst (Hwang, Yoon 1981).

    ``scale`` makes the objectives comparable: ``"vector"``, Hwang and Yoon's own way, divides each by its length as a
    vector over all designs; ``"range"`` scales each to 0 .. 1 over the front, as the `weighted_sum` does.  They may
    choose differently: a wish in which the designs hardly differ, measured by its size, counts less by the vector.

    >>> three = [[0.1, 0.9], [0.5, 0.7], [0.9, 0.6]]
    >>> topsis(three, [1, 2]), topsis(three, [1, 2], scale="range")
    (0, 2)

    Raises ``ValueError`` for a scale of another name.
    """
    if not isinstance(scale, str) or scale not in SCALES:
        raise ValueError(f"the scale is {shown(scale)}; there are {' and '.join(map(repr, SCALES))}")
    f = objectives_of(front)
    y, squares = SCALES[scale](f), _weights(weights, f.shape[1]) ** 2
    to_best, to_worst = (np.sqrt(squares @ ((y - end) ** 2).T) for end in (y.min(axis=0), y.max(axis=0)))
    total = to_best + to_worst
    return _chosen(np.divide(to_worst, total, out=np.ones_like(total), where=total > 0))


def knee(front: object, weights: object = None) -> Any:
    """The design farthest from the plane through the best of each objective, towards the ideal (Das 1999).

    Beyond it a little more of one wish costs much of another.  Objectives are normalised.  Of two objectives the plane
    is the line between the front's ends, and the knee is where a weighted sum with equal weights is least.  Where the
    best designs are no corners of a plane that faces the ideal, the plane meets every axis at 1.  ``weights`` are not
    used; they are there so that every chooser is called alike.

    >>> knee([[0, 1], [0.1, 0.3], [0.5, 0.2], [1, 0]])
    1
    """
    f = objectives_of(front)
    y = normalised(f)
    corners = y[np.argmin(y, axis=0)]
    normal = np.ones(len(corners))
    if np.linalg.matrix_rank(corners) == len(corners):
        through = np.linalg.solve(corners, normal)
        normal = through if (through > 0).all() else normal
    return _whatever_the_weights(int(np.argmin(y @ normal)), weights, f.shape[1])


def crowding_distance(f: object) -> np.ndarray:
    """Crowding distance of each member of a front, ``inf`` at the ends (Deb et al. 2002)."""
    y = normalised(f)
    distance = np.zeros(len(y))
    for column in y.T:
        order = np.argsort(column, kind="stable")
        sorted_ = column[order]
        distance[order[[0, -1]]] = np.inf
        distance[order[1:-1]] += sorted_[2:] - sorted_[:-2]
    return distance


def most_isolated(front: object, weights: object = None) -> Any:
    """The inner design that stands most alone on the front, the way in which the door-handle paper chooses.

    ``weights`` are not used; they are there so that every chooser is called alike.

    >>> most_isolated([[0, 1], [0.1, 0.8], [0.5, 0.2], [1, 0]])
    2
    """
    f = objectives_of(front)
    distance = crowding_distance(f)
    inner = np.isfinite(distance)
    alone = int(np.argmax(np.where(inner, distance, -1))) if inner.any() else 0
    return _whatever_the_weights(alone, weights, f.shape[1])


AUGMENTED = 1e-4
"""How much the sum of all shortfalls counts beside the largest: so little that it only decides between equals."""


def achievement(front: object, reference: object = None) -> Any:
    """The design that comes nearest to a ``reference``, what a person wishes of each objective (Wierzbicki 1980).

    ``reference``: ``(k,)`` in the front's own units, all to be small, or ``(m, k)``; by default the ideal, the best of
    each.  The augmented achievement function: least is the largest amount by which a design falls short of a wish,
    in ranges of the objectives from the front's ideal to its nadir, plus `AUGMENTED` times the sum of these amounts.
    A wish that can be met is exceeded alike in all; so no other design of the front is better in everything, and a
    design of the front is chosen by its own objectives.

    >>> front = [[0, 1], [0.2, 0.5], [0.5, 0.2], [1, 0]]
    >>> achievement(front, [0.1, 0.4]), achievement(front, [0.4, 0.1]), achievement(front, [[0, 1], [2, 2]]).tolist()
    (1, 2, [0, 1])

    Raises ``ValueError`` for a reference that is not a finite number for each objective.
    """
    f = objectives_of(front)
    must = f"the reference point is {shown(reference)}; it must be {f.shape[1]} finite numbers"
    wish = f.min(0) if reference is None else _numbers(reference, must)
    if wish.ndim not in (1, 2) or wish.shape[-1] != f.shape[1] or not np.isfinite(wish).all():
        raise ValueError(must)
    scale = -np.frexp(abs(f).max(axis=0))[1]  # as in `normalised`
    f, wish = np.ldexp(f, scale), np.ldexp(wish, scale)
    span = np.ptp(f, axis=0)
    short = (f - wish[..., None, :]) / np.where(span > 0, span, 1)
    return _chosen(-(short.max(-1) + AUGMENTED * short.sum(-1)))


CHOOSERS = {"crowding distance": most_isolated, "weighted sum": weighted_sum, "TOPSIS": topsis, "knee": knee}
"""The ways to choose, by the name that a menu shows."""

WEIGHING = ("weighted sum", "TOPSIS")
"""Those of them that ask for weights."""
