"""The yield of designs by parts that are judged exactly, as few of them as are needed, and what is sure of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import counted
from ..quantities.types import Array
from .study import KEPT
from .three_point import DEEP, ThreePoint, bounded, seen

if TYPE_CHECKING:
    from .robust import RobustStudy
    from .study import Evaluation

SEED = 20768
"""Of parts that no search has seen."""
LOOKS = 1024, 4096, 16384
"""How many parts there are at first, and while it is not decided."""
BATCH, SURE, SAFE = 8, 2.0, 0.25
"""So many parts are judged at a time, until the next lies so many of the model's errors within its limits.

An error by which the model has seen a part too near to its limit counts less.
"""
CONFIDENCE = 0.95
CORNERS = 10
"""Of up to so many tolerances all corners are judged; of more the one where the model is worst."""
ROWS = 4096
"""So many parts are judged at once."""


@dataclass(frozen=True)
class Recheck:
    """What exact parts say of ``p`` designs.

    In a worst case the parts are the corners of the tolerances, and nothing is left open.
    """

    share: Array
    """The yield, ``(p,)``."""
    interval: Array
    """Between which yields the true one lies, ``(p, 2)`` (Clopper and Pearson; each end holds with 95 %).

    Who looks up to three times errs up to three times as often: then each look is sure to a third of the error.
    """
    missed: Array
    """How many parts miss a limit or cannot be built, ``(p,)``."""
    parts: Array
    """Of how many, ``(p,)``."""
    wanted: float
    """The yield that there has to be."""
    evaluations: int
    """How many designs were evaluated, all together."""

    @property
    def kept(self) -> Array:
        """Which designs have the yield for sure, ``(p,)``."""
        return np.asarray(self.interval[:, 0] >= self.wanted)

    @property
    def decided(self) -> Array:
        """For which designs it is sure whether they have the yield or not, ``(p,)``."""
        return np.asarray(self.kept | (self.interval[:, 1] < self.wanted))

    def of(self, rows: Array) -> Recheck:
        """What is said of some of the designs."""
        share, interval, missed, parts = (v[rows] for v in (self.share, self.interval, self.missed, self.parts))
        return replace(self, share=share, interval=interval, missed=missed, parts=parts)

    def __str__(self) -> str:
        return "; ".join(self._text(i) for i in range(len(self.share)))

    def _text(self, i: int) -> str:
        (low, high), share = 100 * self.interval[i], 100 * self.share[i]
        if self.wanted == 1 and self.missed[i] == 0 and not self.decided[i]:
            return f"none of {self.parts[i]} parts misses: at least {low:.2f} %, of all only a worst case is sure"
        return f"{share:.1f} % ({low:.1f} to {high:.1f}){'' if self.decided[i] else ', not decided'}"


def clopper_pearson(missed: Array, parts: Array, looks: int = 1) -> Array:
    """The ends of the yield's interval when ``missed`` of ``parts`` miss, ``(..., 2)``; each holds with 95 %.

    ``looks``: how often there is a look at most, after more and more parts.

    >>> clopper_pearson(np.array([4, 5]), np.array([1024, 1024]))[:, 0].round(4).tolist()
    [0.9911, 0.9898]
    """
    from scipy.special import betaincinv

    missed, parts = np.asarray(missed, dtype=float), np.asarray(parts, dtype=float)
    kept, beyond = parts - missed, (1 - CONFIDENCE) / looks
    low = np.where(kept > 0, betaincinv(np.maximum(kept, 1), missed + 1, beyond), 0.0)
    high = np.where(missed > 0, betaincinv(kept + 1, np.maximum(missed, 1), 1 - beyond), 1.0)
    return np.stack([low, high], axis=-1)


def rechecked(study: RobustStudy, x: Array, parts: int | None) -> Recheck:
    """`RobustStudy.recheck`: models of the limits say which parts are judged."""
    p, wanted = len(x), study.yield_at_least
    looked = p * (2 * len(study.tolerances) + 1)
    if study.worst_case:
        models = study.models(x)
        found = largest(study, study.made(x, corners(study, models)))
        missed, used = (found > KEPT).sum(1), found.shape[1]
        share = 1 - missed / used
        return Recheck(share, np.stack([share, share], -1), missed, np.full(p, used), 1.0, looked + found.size)
    numbers = LOOKS if parts is None else (counted(parts, "parts", 4, 2**20),)
    if numbers[0] & (numbers[0] - 1):
        raise ValueError(f"the number of parts is {numbers[0]}; it must be a power of 2")
    models = models_by_few_angles(study, study.roughly, x, study.nominal.evaluate(x))
    missed, of, open_ = np.zeros(p, dtype=int), np.full(p, numbers[0]), np.arange(p)
    for number in numbers:
        missed[open_], judged = _missed(study, x[open_], [_rows(model, open_) for model in models], number)
        of[open_], looked = number, looked + judged
        interval = clopper_pearson(missed, of, len(numbers))
        said = Recheck(1 - missed / of, interval, missed, of, wanted, looked)
        open_ = np.flatnonzero(~said.decided)
        if not len(open_):
            break
    return said


def models_by_few_angles(study: RobustStudy, rough: RobustStudy, x: Array, found: Evaluation) -> list[ThreePoint]:
    """Models of the limits of designs, on the ``rough`` study's angles, moved to what all angles have ``found``."""
    with np.errstate(invalid="ignore"):
        by = bounded(seen(found.g)) - bounded(seen(rough.nominal.evaluate(x).g))
    by, models = np.where(np.isfinite(by), by, 0.0), rough.models(x)
    return [m._replace(centre=m.centre + by[:, i : i + 1]) if study.limits else m for i, m in enumerate(models)]


def joined(every: Sequence[tuple[Array, Recheck]]) -> Recheck:
    """What is said of groups of designs, each with its rows, as one."""
    rows = np.argsort(np.concatenate([at for at, _ in every]))
    names = ("share", "interval", "missed", "parts")
    columns = {name: np.concatenate([getattr(found, name) for _, found in every])[rows] for name in names}
    return Recheck(**columns, wanted=every[0][1].wanted, evaluations=sum(found.evaluations for _, found in every))


def _rows(model: ThreePoint, rows: Array) -> ThreePoint:
    return ThreePoint(*(part[rows] for part in model))


def largest(study: RobustStudy, parts: Array) -> Array:
    """The largest ``g`` of each of ``parts`` ``(p, m, n_paths)``, ``(p, m)``; ``inf`` for what cannot be built."""
    return np.asarray(_limits(study, parts).max(-1))


def _limits(study: RobustStudy, parts: Array) -> Array:
    """Each ``g`` of parts, ``(p, m, n_limits)`` (without limits one that is kept); ``inf`` for what cannot be built."""
    rows = parts.reshape(-1, parts.shape[-1])
    if len(rows) > ROWS:  # so many at once have no room in a small machine
        every = np.array_split(parts, -(-len(rows) // ROWS), axis=1)
        return np.concatenate([_limits(study, few) for few in every], axis=1)
    found = study.judged(rows)
    g = found.g if study.limits else np.full((len(rows), 1), DEEP)
    g = np.where(np.isfinite(found.f).all(-1, keepdims=True), g, np.inf)
    return seen(g).reshape(*parts.shape[:2], g.shape[-1])


def _missed(study: RobustStudy, x: Array, models: list[ThreePoint], number: int) -> tuple[Array, int]:
    """How many of ``number`` parts of each design miss a limit, ``(p,)``, and how many were judged for it.

    The worst by the models are judged, until all others lie well within each limit by the largest error seen of it.
    """
    z, p, judged, batch = study.shares(number, SEED), len(x), 0, BATCH
    few = np.array_split(z, max(1, number // 1024))
    guess = np.concatenate([np.stack([model.at(rows) for model in models], axis=1) for rows in few], axis=-1)
    missed, error = np.zeros(p, dtype=int), np.full((p, guess.shape[1]), 0.0 if study.limits else -DEEP)
    left, open_ = guess.max(1), np.arange(p)
    while len(open_):
        tried = np.argpartition(-left[open_], min(batch, number) - 1, axis=1)[:, :batch]
        here, guessed = (open_[:, None], tried), guess[open_[:, None], :, tried]
        found = _limits(study, study.made(x[open_], z[tried]))
        new = left[here] > -np.inf
        missed[open_] += ((found.max(-1) > KEPT) & new).sum(1)
        off = np.minimum(abs(found - guessed), abs(bounded(found) - guessed))  # by itself or its reciprocal
        off = np.where(found > guessed, off, SAFE * off)
        error[open_] = np.maximum(error[open_], np.where(new[..., None], np.minimum(off, 1.0), 0.0).max(1))
        judged, batch = judged + tried.size, min(2 * batch, 256)
        guess[open_[:, None], :, tried] = -np.inf
        left[open_] = (guess[open_] + SURE * error[open_, :, None]).max(1)
        open_ = open_[left[open_].max(1) >= -KEPT]
    return missed, judged


def corners(study: RobustStudy, models: list[ThreePoint]) -> Array:
    """The corners of the tolerances that count, as shares, ``(m, k)`` or ``(p, m, k)``."""
    k = len(study.tolerances)
    if k <= CORNERS:
        return np.array(list(product((-1.0, 1.0), repeat=k)))
    return np.stack([model.corner for model in models], axis=1) if models else np.zeros((1, k))
