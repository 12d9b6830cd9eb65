"""How sure a choice is: how far each judgement may move before another design wins, and which wins at which weights."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..quantities import counted
from ..quantities.kinds import shown
from .ahp import SAATY_SCALE, ahp, judged_weights
from .choosers import objectives_of, weighted_sum

Chooser = Callable[[object, object], int | np.ndarray]

LEAST, MOST = SAATY_SCALE[0], SAATY_SCALE[-1]
STEPS = 100
"""Steps from a judgement to either end of Saaty's scale, searched for another winner."""
PARTS = (STEPS, *[8] * 10)
"""Into how many the way is parted, then the step in which the winner changes: to better than 1e-10 of the judgement."""


@dataclass(frozen=True)
class JudgementRange:
    """How far one judgement may move, all others staying, before another design wins.

    The winner stays while the judgement of criteria ``pair`` is between ``low`` and ``high``; ``below`` and ``above``
    are the designs that win beyond them, ``None`` where the winner stays to the end of Saaty's scale, 1/9 or 9.
    ``judged`` is the judgement now; where nobody has judged, what the others imply.
    """

    pair: tuple[int, int]
    judged: float
    low: float
    high: float
    below: int | None
    above: int | None


def _refuse_no_rule(choose: object) -> None:
    if not callable(choose):
        raise ValueError(
            f"the rule is {shown(choose)}; it must be weighted_sum, topsis, knee, most_isolated or one like them"
        )


def judgement_ranges(front: object, judgements: object, choose: Chooser = weighted_sum) -> tuple[JudgementRange, ...]:
    """How far each judgement of the objectives may move before ``choose`` takes another design.

    Each judgement is moved by itself on the continuous scale 1/9 .. 9, in even steps of its logarithm; the step in
    which the winner changes is then parted again and again.  A design that wins for less than a step (1/100 of the
    way to the scale's end) may be passed over.

    >>> two = judgement_ranges([[0, 1], [0.2, 0.2], [1, 0]], [1])[0]  # 0.2 w1 + 0.2 w2 < w2 where w1 < 4 w2
    >>> two.pair, round(two.low, 6), round(two.high, 6), two.below, two.above
    ((0, 1), 0.25, 4.0, 2, 0)

    ``judgements`` are what `ahp` takes.  Raises ``ValueError`` if there are not as many criteria as objectives.
    """
    _refuse_no_rule(choose)
    front, judged = objectives_of(front), ahp(judgements)
    winner, pairs = choose(front, judged.weights), judged.pairs
    if not pairs:
        return ()
    now = np.array(judged.complete().above, dtype=float)
    ends = np.stack([np.minimum(now, LEAST), np.maximum(now, MOST)], axis=-1)

    def winners(values: np.ndarray) -> np.ndarray:
        """Who wins when each pair is judged ``values``, ``(pairs, 2, m)``."""
        weights = judged_weights(_rejudged(judged.array, pairs, values), judged.method)
        return np.reshape(choose(front, weights.reshape(-1, weights.shape[-1])), values.shape)

    stays, goes, changes = _first_changes(now, ends, lambda values: winners(values) != winner)
    next_ = winners(goes)[..., 0]
    far = np.where(changes, stays[..., 0], ends)
    return tuple(
        JudgementRange(
            pair, float(v), float(low), float(high), *(int(n) if c else None for n, c in zip(n2, c2, strict=True))
        )
        for pair, v, (low, high), n2, c2 in zip(pairs, now, far, next_, changes, strict=True)
    )


def _first_changes(
    now: np.ndarray, ends: np.ndarray, other: Callable[[np.ndarray], np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """From ``now`` to both ``ends``: the last value without an ``other`` winner, the first with one, if any."""
    stays, goes = np.broadcast_to(now[:, None, None], (*ends.shape, 1)), ends[..., None]
    changes = np.zeros(ends.shape, dtype=bool)
    for parts in PARTS:
        share = np.linspace(0, 1, parts + 1)
        values = stays ** (1 - share) * goes**share
        others = other(values)
        changes = changes | others.any(-1)
        first = np.maximum(np.argmax(others, axis=-1), 1)[..., None]
        stays, goes = (np.take_along_axis(values, first - back, axis=-1) for back in (1, 0))
    return stays, goes, changes


def _rejudged(matrix: np.ndarray, pairs: list[tuple[int, int]], values: np.ndarray) -> np.ndarray:
    """The matrix once for each value, ``(pairs, 2, m, n, n)``, in which only that pair is judged anew."""
    many = np.broadcast_to(matrix, (*values.shape, *matrix.shape)).copy()
    k, (i, j) = np.arange(len(pairs)), np.transpose(pairs)
    many[k, :, :, i, j], many[k, :, :, j, i] = values, 1 / values
    return many


MOST_WEIGHTINGS = 10**6
"""More weightings than these are not listed."""


def weight_lattice(k: int, steps: int) -> np.ndarray:
    """All weights of ``k`` objectives that are multiples of ``1 / steps`` and add to 1, ``(m, k)``.

    >>> weight_lattice(2, 2).tolist()
    [[0.0, 1.0], [0.5, 0.5], [1.0, 0.0]]
    """
    k, steps = counted(k, "objectives", 1), counted(steps, "steps", 1)
    if max(k, steps) > MOST_WEIGHTINGS or math.comb(steps + k - 1, k - 1) > MOST_WEIGHTINGS:
        raise ValueError(f"{steps} steps of {k} weights make more than {MOST_WEIGHTINGS:g} weightings; take fewer")
    # Stars and bars: k - 1 bars among the steps part them into k weights.
    places = steps + k - 1
    bars = np.array(list(combinations(range(places), k - 1)), dtype=int).reshape(math.comb(places, k - 1), k - 1)
    return (np.diff(bars, axis=1, prepend=-1, append=places) - 1) / steps


@dataclass(frozen=True)
class WinnerMap:
    """Which design wins at which weights: ``weights`` ``(m, k)``, evenly spread, and ``winners`` ``(m,)``."""

    weights: np.ndarray
    winners: np.ndarray

    @property
    def shares(self) -> dict[int, float]:
        """The share of all weights at which each design wins, the largest first."""
        designs, counts = np.unique(self.winners, return_counts=True)
        order = np.argsort(-counts, kind="stable")
        return {int(designs[i]): float(counts[i] / len(self.winners)) for i in order}


LATTICE = {1: 1, 2: 1000, 3: 60, 4: 20, 5: 12}
"""Steps of a `winner_map` for so many objectives; 8 for more."""


def winner_map(front: object, choose: Chooser = weighted_sum) -> WinnerMap:
    """Who wins at every set of weights, on an even lattice of them.

    >>> {design: round(share, 2) for design, share in winner_map([[0, 1], [0.2, 0.2], [1, 0]]).shares.items()}
    {1: 0.6, 0: 0.2, 2: 0.2}
    """
    _refuse_no_rule(choose)
    k = objectives_of(front).shape[1]
    weights = weight_lattice(k, LATTICE.get(k, 8))
    return WinnerMap(weights, np.asarray(choose(front, weights)))
