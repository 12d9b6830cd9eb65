"""Several judges of the same criteria: what they say together, and where they disagree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..quantities.kinds import listed, numbers, refuse_kinds, shown
from ..quantities.markup import Html, table
from .ahp import Judgements, ahp

WAYS = ("judgements", "priorities")
"""What is joined: each judgement by the geometric mean, or the weights that follow from each judge's."""


@dataclass(frozen=True)
class Judges:
    """The `Judgements` of several judges by their names, how much each judge counts, and what they say together.

    ``shares`` are positive and of any sum.  ``method``: see `group`, which makes one.
    """

    said: Mapping[str, Judgements]
    shares: Sequence[float]
    method: str = WAYS[0]

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if self.method not in WAYS:
            raise ValueError(f"the method is {shown(self.method)}; there are {' and '.join(map(repr, WAYS))}")
        if len(self.said) < 2:
            raise ValueError(f"there is {'one judge' if self.said else 'no judge'}; a group has two or more")
        (first, one), *others = self.said.items()
        for name, other in others:
            if other.names != one.names:
                told = f"{name} judges {', '.join(other.names)}, but {first} {', '.join(one.names)}"
                raise ValueError(f"{told}; all must judge the same criteria")
            if other.method != one.method:
                told = f"the weights of {name} are by {other.method!r}, those of {first} by {one.method!r}"
                raise ValueError(f"{told}; all must be by the same method")
        shares = np.atleast_1d(numbers(self.shares, "the weights of the judges"))
        if shares.shape != (len(self.said),):
            raise ValueError(
                f"there must be a weight for each of {len(self.said)} judges; given are {len(self.shares)}"
            )
        for name, share in zip(self.said, shares, strict=True):
            if not 0 < share < np.inf:
                raise ValueError(f"the weight of {name} is {share:g}; it must be a positive number")
        object.__setattr__(self, "shares", tuple(shares.tolist()))

    @property
    def names(self) -> tuple[str, ...]:
        """The criteria."""
        return tuple(next(iter(self.said.values())).names)

    @cached_property
    def influence(self) -> np.ndarray:
        """How much each judge counts, ``(judges,)``; adds to 1."""
        shares = np.array(self.shares) / max(self.shares)
        return np.asarray(shares / shares.sum())

    @cached_property
    def judgements(self) -> Judgements:
        """What the group judges: weights, consistency and all else that follows from judgements.

        Joined priorities are judgements too, the ratios of the weights, which do not contradict each other.
        """
        judged = list(self.said.values())
        if self.method == "priorities":
            weights = self.influence @ np.stack([each.weights for each in judged])
            return Judgements(self.names, weights[:, None] / weights, judged[0].method)
        said = np.stack([each.array for each in judged])
        counts = self.influence[:, None, None] * ~np.isnan(said)  # a pair is judged by those who judged it
        with np.errstate(invalid="ignore"):
            joined = np.exp((counts * np.log(np.where(np.isnan(said), 1, said))).sum(0) / counts.sum(0))
        return Judgements(self.names, [joined[pair] for pair in judged[0].pairs] or [[1]], judged[0].method)

    @property
    def weights(self) -> np.ndarray:
        """The group's weights of the criteria, ``(n,)``; they add to 1."""
        return self.judgements.weights

    @cached_property
    def ratios(self) -> np.ndarray:
        """How many times each judge says what the group says of each pair, ``(judges, n, n)``; ``nan`` if nothing."""
        together = self.judgements.complete().array
        return np.stack([each.array / together for each in self.said.values()])

    @property
    def disputed(self) -> dict[tuple[int, int], float]:
        """By which ratio at most a judge differs from the group on each pair, 1 or more; the most disputed first."""
        apart = np.nan_to_num(np.exp(abs(np.log(self.ratios))), nan=1.0).max(0)
        pairs = self.judgements.pairs
        return {pair: float(apart[pair]) for pair in sorted(pairs, key=lambda pair: -apart[pair])}

    @property
    def incompatibility(self) -> np.ndarray:
        """How far each judge is from the group, ``(judges,)``: 1 says the same, above 1.1 is far (Saaty 1994).

        Saaty's index of compatibility: the mean of all entries ``a_ij g_ji`` of the judge's matrix ``a`` and the
        group's ``g``, missing judgements as the others imply them.
        """
        together = self.judgements.complete().array
        return np.array([(each.complete().array * together.T).mean() for each in self.said.values()])

    def rows(self) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
        """The head and the rows of a table: each judge and the group, weights, consistency, disagreement."""
        head = ("judge", "counts", *self.names, "consistency ratio", "apart from the group")
        judged = zip(self.said.items(), self.influence, self.incompatibility, strict=True)
        rows = [_row(name, f"{100 * share:.3g} %", each, f"{apart:.3f}") for (name, each), share, apart in judged]
        return head, [*rows, _row("group", "", self.judgements, "")]

    def _repr_html_(self) -> Html:
        return table(*self.rows())


def _row(name: str, counts: str, judged: Judgements, apart: str) -> tuple[str, ...]:
    weights = [f"{weight:.4f}" for weight in judged.weights]
    return (name, counts, *weights, f"{judged.consistency_ratio:.4f}", apart)


def group(
    judgements: Mapping[str, object] | Sequence[object],
    weights: Mapping[str, float] | Sequence[float] | None = None,
    method: str = WAYS[0],
) -> Judges:
    """Several judges of the same criteria as one: their joined judgements and weights, and where they disagree.

    ``judgements``: what `ahp` takes, by the judge's name or one judge after the other.  ``weights`` of the judges, by
    name or in the same order, are positive and of any sum; by default all count alike.  ``method``: a group that acts
    as one joins ``"judgements"``, each by its geometric mean (Aczel, Saaty 1983), as ``1/a`` then stays the reciprocal;
    persons of their own join ``"priorities"``, the mean of the weights that follow for each (AIJ and AIP of Forman,
    Peniwati 1998).  Of a pair count those who have judged it.

    >>> three = group({"A": [3, 5, 2], "B": ["1/2", 4, 6], "C": [4, 4, 1]})
    >>> three.weights.round(6).tolist(), round(three.judgements.consistency_ratio, 6)
    ([0.562199, 0.305789, 0.132011], 0.000118)
    >>> pair, ratio = next(iter(three.disputed.items()))
    >>> pair, round(ratio, 4), three.incompatibility.round(4).tolist()
    ((0, 1), 3.6342, [1.033, 1.3241, 1.1541])

    Raises ``ValueError`` for other criteria, fewer than two judges, and weights that are not positive.
    """
    each = {} if isinstance(judgements, Mapping) else listed(judgements, "the list of judges", "judge")
    named = judgements if isinstance(judgements, Mapping) else {f"judge {i}": j for i, j in enumerate(each, start=1)}
    judged = {str(name): _judged(str(name), said) for name, said in named.items()}
    if isinstance(weights, Mapping):
        if set(weights) != set(named):
            told = f"the weights are those of {', '.join(map(str, weights))}"
            raise ValueError(f"{told}; the judges are {', '.join(judged)}")
        weights = [weights[name] for name in named]
    given = np.ones(len(judged)) if weights is None else numbers(weights, "the weights of the judges")
    return Judges(judged, np.atleast_1d(given).tolist(), method)


def _judged(name: str, said: object) -> Judgements:
    try:
        return ahp(said)
    except ValueError as refusal:
        raise ValueError(f"{name}: {refusal}") from None
