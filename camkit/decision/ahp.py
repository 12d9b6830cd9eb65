"""From judgements to weights, and from a front to one design; and how sure that choice is.

`ahp` is Saaty's analytic hierarchy process; not every pair needs to be judged.  The choosers take a front (anything
with an ``f``, or the array itself: ``(p, k)``, every objective to be small) and return the index of the chosen design:
one for weights ``(k,)``, an array ``(m,)`` for many at once ``(m, k)``.  `judgement_ranges` says how far each judgement
may move before another design wins, `winner_map` which design wins at which weights.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
from scipy.sparse.csgraph import connected_components

from ..kinds import numbers, refuse_arguments, shown
from ..quantities import counted
from ..typed import typed_number

RANDOM_INDEX = (0, 0, 0.58, 0.90, 1.12, 1.24, 1.32, 1.41, 1.45, 1.49)
"""Saaty (1980): mean consistency index of random reciprocal matrices of order 1..10; `random_index` goes on."""

LEAST_TOLD, MOST_TOLD = 1e-6, 1e6
"""Judgements beyond these are slips of the pen; Saaty's own scale ends at 1/9 and 9."""

SAATY_SCALE = (*(1 / k for k in range(9, 1, -1)), *map(float, range(1, 10)))
"""The judgements that Saaty's scale knows, 1/9 .. 9."""

ROUNDS, SETTLED = 1000, 1e-13
"""How often missing judgements are improved at most, and by which share the last round may still move them."""

SQUARINGS = 50
"""How often a matrix is squared at most until its columns are its eigenvector."""

ALIKE = 1e-9
"""Values of ``lambda_max`` that differ by less than this share are alike."""


def random_index(n: int) -> float:
    """The consistency index of random judgements among ``n`` criteria: `RANDOM_INDEX`, beyond 10 a fitted line.

    The mean ``lambda_max`` of random matrices is ``2.7699 n - 4.3513`` (Alonso, Lamata 2006).  Saaty's own numbers
    for 11 and 12 criteria, 1.51 and 1.48, come from too few matrices: the index grows with ``n``.

    >>> random_index(10), round(random_index(12), 4)
    (1.49, 1.5352)
    """
    n = counted(n, "criteria", 1)
    return float(RANDOM_INDEX[n - 1] if n <= len(RANDOM_INDEX) else (1.7699 * n - 4.3513) / (n - 1))


@dataclass(frozen=True)
class Judgement:
    """What follows from a matrix of pairwise judgements; unpacks as weights and consistency ratio.

    ``matrix`` is ``nan`` where nobody has judged; ``completed`` holds there what contradicts the others least (see
    `completed`).  ``note`` says which rounded reciprocals were read as exact ones.
    """

    matrix: np.ndarray
    completed: np.ndarray
    weights: np.ndarray
    lambda_max: float
    note: str = ""

    @property
    def missing(self) -> int:
        """How many pairs nobody has judged."""
        return int(np.isnan(self.matrix).sum()) // 2

    @property
    def consistency_index(self) -> float:
        """``(lambda_max - n) / (n - 1)``; 0 for judgements without contradiction."""
        n = len(self.weights)
        return max((self.lambda_max - n) / (n - 1), 0.0) if n > 1 else 0.0

    @property
    def consistency_ratio(self) -> float:
        """Consistency index over the `random_index`; above 0.1 the judgements contradict each other.

        Fewer judgements contradict each other less, even at random: with ``m`` pairs missing the random index is
        ``1 - 2 m / ((n - 1) (n - 2))`` of the full one (Agoston, Csato 2022).
        """
        n = len(self.weights)
        random = random_index(n) * (1 - 2 * self.missing / ((n - 1) * (n - 2)) if n > 2 else 0)
        return self.consistency_index / random if random > 1e-9 else 0.0

    @property
    def worst(self) -> dict[tuple[int, int], float]:
        """The judgement that contributes most to the contradiction, and what the others imply in its place.

        It is the one without which ``lambda_max`` is least.  There are several, ``{(row, column): implied}``, where
        it makes no difference which of them is left out, as in any round of three; none where the judgements are too
        few to contradict each other.

        >>> {pair: round(implied, 6) for pair, implied in ahp([9, 1 / 9, 9]).worst.items()}
        {(0, 1): 0.012346, (0, 2): 81.0, (1, 2): 0.012346}
        """
        pairs = [pair for pair in combinations(range(len(self.matrix)), 2) if _spared(self.matrix, pair)]
        if not pairs:
            return {}
        others = completed(np.stack([_unjudged(self.matrix, pair) for pair in pairs]))
        left = _lambda_max(others)
        return {
            pair: float(full[pair])
            for pair, full, value in zip(pairs, others, left, strict=True)
            if value <= left.min() * (1 + ALIKE)
        }

    def __iter__(self) -> Iterator[Any]:
        return iter((self.weights, self.consistency_ratio))


def judgement_matrix(judgements: Any) -> np.ndarray:
    """The reciprocal matrix from itself or from its upper triangle, read row by row.

    An entry is a number or text such as ``"1/3"``; ``None`` or ``nan`` stands where nobody has judged.  Of a pair
    that is printed with rounded reciprocals, such as 3 and 0.33, the one above 1 counts.

    >>> judgement_matrix([4, 3, 1 / 2]).tolist()
    [[1.0, 4.0, 3.0], [0.25, 1.0, 0.5], [0.3333333333333333, 2.0, 1.0]]
    >>> judgement_matrix(["4", None, "1/2"])[0].tolist()
    [1.0, 4.0, nan]
    >>> judgement_matrix([[1, 3], [0.33, 1]]).tolist()
    [[1.0, 3.0], [0.3333333333333333, 1.0]]

    Raises ``ValueError`` naming the entry that is not positive or not reciprocal, or the criteria that no judgement
    connects.
    """
    return _read(judgements)[0]


def _read(judgements: Any) -> tuple[np.ndarray, str]:
    """The reciprocal matrix, and a note on the rounded reciprocals in it."""
    told = _entries(judgements)
    a = _from_upper(told) if told.ndim == 1 else told
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise ValueError(f"the judgements have the shape {a.shape}; they must be a square matrix")
    with np.errstate(divide="ignore", over="ignore"):
        a = np.where(np.isnan(a), np.where(np.eye(len(a), dtype=bool), 1, 1 / a.T), a)
    for i, j in np.argwhere(~(np.isnan(a) | ((a >= LEAST_TOLD) & (a <= MOST_TOLD)))):
        possible = 0 < a[i, j] < math.inf
        must = f"nobody tells apart more than {MOST_TOLD:g} to 1" if possible else "it must be a positive number"
        raise ValueError(f"judgement ({i + 1}, {j + 1}) is {a[i, j]:g}; {must}")
    rounded = []
    for i, j in np.argwhere(np.triu(abs(a * a.T - 1) > 1e-6)):
        more, less = max(a[i, j], a[j, i]), min(a[i, j], a[j, i])
        if i == j or not _rounded_reciprocal(more, less):
            raise ValueError(
                f"judgement ({i + 1}, {j + 1}) is {a[i, j]:.6g} and ({j + 1}, {i + 1}) is {a[j, i]:.6g}; "
                + ("the diagonal must be 1" if i == j else ONE_OVER_THE_OTHER)
            )
        rounded.append(f"{less:g} as 1/{more:g}")
        a[i, j], a[j, i] = (more, 1 / more) if a[i, j] == more else (1 / more, more)
    _refuse_gaps(a)
    return a, f"rounded reciprocals are read as exact ones: {', '.join(dict.fromkeys(rounded))}" if rounded else ""


ONE_OVER_THE_OTHER = "one must be 1 over the other (text such as '1/3' is exact, None leaves a place open)"


def _entries(judgements: Any) -> np.ndarray:
    """Judgements as numbers, ``nan`` for none."""
    wrong = "the judgements must be a square matrix of numbers or its upper triangle"
    try:
        told = np.array(judgements, dtype=object)
    except ValueError:
        raise ValueError(wrong) from None
    if not told.ndim:
        raise ValueError(wrong)
    if not told.size:
        raise ValueError("there are no judgements; those of a single criterion are [[1]]")
    return np.array([_told(entry, wrong) for entry in told.flat]).reshape(told.shape)


def _told(entry: Any, wrong: str) -> float:
    if entry is None:
        return math.nan
    if isinstance(entry, str):
        return typed_judgement(entry)
    if isinstance(entry, (bool, np.bool_)) or not isinstance(entry, (int, float, Fraction, np.number)):
        raise ValueError(wrong)
    if isinstance(entry, np.complexfloating):
        raise ValueError(wrong)
    try:
        return float(entry)
    except OverflowError:
        return math.inf


def typed_judgement(words: str) -> float:
    """A judgement as a person types it: ``3``, ``1/3``, ``0.4`` or ``0,4``; ``nan`` for an empty text or ``?``.

    >>> typed_judgement(" 1 / 4 "), typed_judgement("0,4"), typed_judgement("")
    (0.25, 0.4, nan)

    Raises ``ValueError`` for anything else.
    """
    refuse_arguments(typed_judgement, locals())
    if words.strip() in ("", "?"):
        return math.nan
    above, fraction, below = words.partition("/")
    try:
        value = typed_number(above) / (typed_number(below) if fraction else 1.0)
    except (ValueError, ZeroDivisionError):
        value = math.nan
    if not 0 < value < math.inf:
        raise ValueError(f"{words[:40]!r} is no number above 0; 3, 1/5 or 0.4 are")
    return value


def _rounded_reciprocal(more: float, less: float) -> bool:
    """Whether ``less`` is ``1 / more`` with two decimals or more, rounded or cut off, as papers print it."""
    decimals = max(len(f"{value:.12g}".partition(".")[2]) for value in (more, less))
    if decimals < 2:
        return False
    step = 10.0**-decimals
    off = 0 if more == round(more) else step / 2  # what is no whole number may have been rounded itself
    return 1 / (more + off) - step * (1 - ALIKE) < less < 1 / (more - off) + step / 2 * (1 + ALIKE)


def _groups(a: np.ndarray) -> tuple[int, np.ndarray]:
    """How many groups of criteria the judgements connect, and the group of each criterion."""
    count, group = connected_components(~np.isnan(a), directed=False)
    return int(count), group


def _unjudged(a: np.ndarray, pair: tuple[int, int]) -> np.ndarray:
    """The matrix without one judgement."""
    without = a.copy()
    without[pair] = without[pair[::-1]] = np.nan
    return without


def _spared(a: np.ndarray, pair: tuple[int, int]) -> bool:
    """Whether a pair is judged and all criteria are connected without that judgement too."""
    return not np.isnan(a[pair]) and _groups(_unjudged(a, pair))[0] == 1


def _refuse_gaps(a: np.ndarray) -> None:
    """Criteria that no chain of judgements connects have no weights among each other."""
    groups, group = _groups(a)
    if groups > 1:
        first, rest = (", ".join(map(str, np.flatnonzero(side) + 1)) for side in (group == 0, group != 0))
        raise ValueError(f"no judgement connects criterion {first} with criterion {rest}; judge one such pair")


def _from_upper(values: np.ndarray) -> np.ndarray:
    n = round((1 + np.sqrt(1 + 8 * len(values))) / 2)
    if n * (n - 1) // 2 != len(values):
        raise ValueError(f"{len(values)} judgements are no upper triangle; 1, 3, 6, 10, ... are")
    a = np.full((n, n), np.nan)
    a[np.triu_indices(n, 1)] = values
    np.fill_diagonal(a, 1)
    return a


def judged_weights(matrices: Any, method: str = "eigenvector") -> np.ndarray:
    """Weights ``(..., n)`` of reciprocal matrices ``(..., n, n)``, `completed` where nobody has judged.

    ``"eigenvector"``: the principal eigenvector (Saaty 1980).  ``"geometric"``: the geometric means of the rows
    (Crawford, Williams 1985).
    """
    if not isinstance(method, str) or method not in METHODS:
        raise ValueError(f"the method is {shown(method)}; there are {' and '.join(map(repr, METHODS))}")
    w = METHODS[method](completed(matrices))
    return np.asarray(w / w.sum(-1, keepdims=True))


def completed(matrices: Any) -> np.ndarray:
    """Reciprocal matrices ``(..., n, n)`` with the missing judgements (``nan``) that contradict the others least.

    They are those with the least ``lambda_max`` (Bozoki, Fulop, Ronyai 2010: there is one such completion).  With the
    eigenvectors ``x`` of the matrix and ``y`` of its transpose ``lambda_max`` does not change with ``a_ij`` where
    ``y_i a_ij x_j = y_j a_ji x_i``; each round puts that ``a_ij`` in.

    >>> completed([[1, 5, np.nan], [1 / 5, 1, 1], [np.nan, 1, 1]]).round(9)[0].tolist()
    [1.0, 5.0, 5.0]
    """
    must = "the judgements must be square matrices of numbers"
    a = _numbers(matrices, must)
    if not a.ndim:
        raise ValueError(must)
    if a.ndim < 2 or a.shape[-1] != a.shape[-2] or not a.size:
        raise ValueError(f"the judgements have the shape {a.shape}; they must be square matrices")
    known = ~np.isnan(a)
    if known.all():
        return a
    full = np.where(known, a, _consistent(a, known))
    open_ = np.arange(full[..., 0, 0].size)
    flat, fixed = full.reshape(-1, *full.shape[-2:]), known.reshape(-1, *full.shape[-2:])
    for _ in range(ROUNDS):
        x, y = _eigenvectors(flat[open_])
        level = np.sqrt(x[:, :, None] * y[:, None, :] / (x[:, None, :] * y[:, :, None]))
        before = flat[open_]
        flat[open_] = now = np.where(fixed[open_], before, level)
        # A matrix that has settled needs no further round.
        open_ = open_[(abs(now - before) > SETTLED * before).any((-2, -1))]
        if not open_.size:
            break
    return flat.reshape(full.shape)


def _consistent(a: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Ratios of weights that come nearest to the judgements that there are, in the squares of their logarithms."""
    n = a.shape[-1]
    laplacian = known.sum(-1)[..., None] * np.eye(n) - known
    said = np.log(np.where(known, a, 1)).sum(-1)
    # The weights' scale is free; a mean logarithm of 0 fixes it.
    logs = np.linalg.solve(laplacian + 1 / n, said[..., None])
    return np.asarray(np.exp(logs - np.swapaxes(logs, -1, -2)))


def _eigenvectors(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Principal eigenvectors ``(..., n)`` of positive matrices ``(..., n, n)`` and of their transposes.

    The columns of a high power of a matrix are its eigenvector, the rows that of its transpose.  All numbers are
    positive, so nothing cancels; for thousands of small matrices at once this is 20 times as fast as LAPACK.
    """
    power = a / a.max((-2, -1), keepdims=True)
    for _ in range(SQUARINGS):
        before, power = power, power @ power
        power /= power.max((-2, -1), keepdims=True)
        # The error is squared in every round, so it is gone in the round after one that changes this little.
        if (abs(power - before) <= 1e-9 * power).all():
            break
    return power.sum(-1), power.sum(-2)


def _eigenvector(a: np.ndarray) -> np.ndarray:
    return _eigenvectors(a)[0]


def _lambda_max(a: np.ndarray) -> np.ndarray:
    """The largest eigenvalue ``(...)`` of positive matrices ``(..., n, n)``."""
    x = _eigenvector(a)[..., None]
    return np.asarray((a @ x / x).mean((-2, -1)))


def _geometric(a: np.ndarray) -> np.ndarray:
    return np.asarray(np.exp(np.log(a).mean(-1)))


METHODS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "eigenvector": _eigenvector,
    "geometric": _geometric,
}
"""Ways from judgements to weights, by name."""


def ahp(judgements: Any, method: str = "eigenvector") -> Judgement:
    """Weights and consistency of pairwise judgements (Saaty 1980).

    ``judgements[i][j]`` says how many times criterion ``i`` matters more than ``j``; a reciprocal matrix, or its
    upper triangle row by row, with ``None`` where nobody has judged (see `judgement_matrix`).  ``method``:
    ``"eigenvector"`` (principal eigenvector) or ``"geometric"`` (row geometric means); see `judged_weights`.

    >>> weights, ratio = ahp([[1, 5, 5], [1 / 5, 1, 1], [1 / 5, 1, 1]])
    >>> (weights * 7).round(6).tolist(), round(ratio, 6)
    ([5.0, 1.0, 1.0], 0.0)
    >>> (ahp([5, None, 1]).weights * 7).round(6).tolist()
    [5.0, 1.0, 1.0]
    >>> print(ahp([[1, 3], [0.33, 1]]).note)
    rounded reciprocals are read as exact ones: 0.33 as 1/3

    Raises ``ValueError`` for a matrix that is not square, positive and reciprocal, naming the entry, and for criteria
    that no judgement connects.
    """
    a, note = _read(judgements)
    full = completed(a)
    return Judgement(a, full, judged_weights(full, method), float(_lambda_max(full)), note)


def _numbers(value: Any, must: str) -> np.ndarray:
    """An array of numbers, refused with a sentence where it is none."""
    try:
        return numbers(value, "all")
    except ValueError:
        raise ValueError(must) from None


def _objectives(front: Any) -> np.ndarray:
    f = _numbers(getattr(front, "f", front), "the front must be a table of numbers, a row for each design")
    if not f.size:
        raise ValueError("the front is empty; there is no design to choose")
    if f.ndim != 2:
        raise ValueError(f"the front has the shape {f.shape}; it must be a table, a row for each design")
    if not np.isfinite(f).all():
        raise ValueError("the front has an objective that is not a finite number")
    return f


def _weights(weights: Any, k: int) -> np.ndarray:
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


def _whatever_the_weights(index: int, weights: Any, k: int) -> Any:
    """The same design for every set of weights."""
    return index if _weights(weights, k).ndim == 1 else np.full(len(weights), index)


def normalised(f: Any) -> np.ndarray:
    """Objectives scaled to 0 (best of the front) .. 1 (worst)."""
    f = _of_size_one(_objectives(f))
    span = np.ptp(f, axis=0)
    return np.asarray((f - f.min(axis=0)) / np.where(span > 0, span, 1))


def _of_size_one(f: np.ndarray) -> np.ndarray:
    """Each objective divided by a power of two, which rounds nothing, so that no square or difference overflows."""
    return np.asarray(np.ldexp(f, -np.frexp(abs(f).max(axis=0))[1]))


def _of_length_one(f: Any) -> np.ndarray:
    """Each objective as a vector over the designs, divided by its length."""
    f = _of_size_one(_objectives(f))
    length = np.sqrt((f**2).sum(axis=0))
    return np.asarray(f / np.where(length > 0, length, 1))


def weighted_sum(front: Any, weights: Any = None) -> Any:
    """The design with the least weighted sum of normalised objectives.

    >>> weighted_sum([[0, 1], [0.2, 0.2], [1, 0]])
    1
    >>> weighted_sum([[0, 1], [0.2, 0.2], [1, 0]], [[1, 9], [1, 1], [9, 1]]).tolist()
    [2, 1, 0]
    """
    f = _objectives(front)
    return _chosen(-_weights(weights, f.shape[1]) @ normalised(f).T)


SCALES: dict[str, Callable[[Any], np.ndarray]] = {"vector": _of_length_one, "range": normalised}
"""Ways to make objectives comparable, by name."""


def topsis(front: Any, weights: Any = None, scale: str = "vector") -> Any:
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
    f = _objectives(front)
    y, squares = SCALES[scale](f), _weights(weights, f.shape[1]) ** 2
    to_best, to_worst = (np.sqrt(squares @ ((y - end) ** 2).T) for end in (y.min(axis=0), y.max(axis=0)))
    total = to_best + to_worst
    return _chosen(np.divide(to_worst, total, out=np.ones_like(total), where=total > 0))


def knee(front: Any, weights: Any = None) -> Any:
    """The design farthest from the plane through the best of each objective, towards the ideal (Das 1999).

    Beyond it a little more of one wish costs much of another.  Objectives are normalised.  Of two objectives the plane
    is the line between the front's ends, and the knee is where a weighted sum with equal weights is least.  Where the
    best designs are no corners of a plane that faces the ideal, the plane meets every axis at 1.  ``weights`` are not
    used; they are there so that every chooser is called alike.

    >>> knee([[0, 1], [0.1, 0.3], [0.5, 0.2], [1, 0]])
    1
    """
    f = _objectives(front)
    y = normalised(f)
    corners = y[np.argmin(y, axis=0)]
    normal = np.ones(len(corners))
    if np.linalg.matrix_rank(corners) == len(corners):
        through = np.linalg.solve(corners, normal)
        normal = through if (through > 0).all() else normal
    return _whatever_the_weights(int(np.argmin(y @ normal)), weights, f.shape[1])


def crowding_distance(f: Any) -> np.ndarray:
    """Crowding distance of each member of a front, ``inf`` at the ends (Deb et al. 2002)."""
    y = normalised(f)
    distance = np.zeros(len(y))
    for column in y.T:
        order = np.argsort(column, kind="stable")
        sorted_ = column[order]
        distance[order[[0, -1]]] = np.inf
        distance[order[1:-1]] += sorted_[2:] - sorted_[:-2]
    return distance


def most_isolated(front: Any, weights: Any = None) -> Any:
    """The inner design that stands most alone on the front, the way in which the door-handle paper chooses.

    ``weights`` are not used; they are there so that every chooser is called alike.

    >>> most_isolated([[0, 1], [0.1, 0.8], [0.5, 0.2], [1, 0]])
    2
    """
    f = _objectives(front)
    distance = crowding_distance(f)
    inner = np.isfinite(distance)
    alone = int(np.argmax(np.where(inner, distance, -1))) if inner.any() else 0
    return _whatever_the_weights(alone, weights, f.shape[1])


CHOOSERS = {"crowding distance": most_isolated, "weighted sum": weighted_sum, "TOPSIS": topsis, "knee": knee}
"""The ways to choose, by the name that a menu shows."""

WEIGHING = ("weighted sum", "TOPSIS")
"""Those of them that ask for weights."""


# ---------------------------------------------------------------- how sure a choice is

Chooser = Callable[[Any, Any], Any]

LEAST, MOST = SAATY_SCALE[0], SAATY_SCALE[-1]
STEPS = 100
"""Steps from a judgement to either end of Saaty's scale, looked at for another winner."""
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


def _refuse_no_rule(choose: Any) -> None:
    if not callable(choose):
        raise ValueError(f"the rule is {choose!r}; it must be weighted_sum, topsis, knee, crowding or one like them")


def judgement_ranges(
    front: Any, judgements: Any, choose: Chooser = weighted_sum, method: str = "eigenvector"
) -> tuple[JudgementRange, ...]:
    """How far each judgement of the objectives may move before ``choose`` takes another design.

    Each judgement is moved by itself on the continuous scale 1/9 .. 9, in even steps of its logarithm; the step in
    which the winner changes is then parted again and again.  A design that wins for less than a step (1/100 of the
    way to the scale's end) may be passed over.

    >>> two = judgement_ranges([[0, 1], [0.2, 0.2], [1, 0]], [1])[0]  # 0.2 w1 + 0.2 w2 < w2 where w1 < 4 w2
    >>> two.pair, round(two.low, 6), round(two.high, 6), two.below, two.above
    ((0, 1), 0.25, 4.0, 2, 0)

    Raises ``ValueError`` if there are not as many criteria as objectives.
    """
    _refuse_no_rule(choose)
    front = _objectives(front)
    judged = ahp(judgements, method)
    winner = choose(front, judged.weights)
    pairs = list(combinations(range(len(judged.weights)), 2))
    if not pairs:
        return ()
    now = np.array([judged.completed[pair] for pair in pairs])
    ends = np.stack([np.minimum(now, LEAST), np.maximum(now, MOST)], axis=-1)

    def winners(values: np.ndarray) -> np.ndarray:
        """Who wins when each pair is judged ``values``, ``(pairs, 2, m)``."""
        weights = judged_weights(_rejudged(judged.matrix, pairs, values), method)
        return np.reshape(choose(front, weights.reshape(-1, weights.shape[-1])), values.shape)

    stays, goes = np.broadcast_to(now[:, None, None], (*ends.shape, 1)), ends[..., None]
    changes = np.zeros(ends.shape, dtype=bool)
    for parts in PARTS:
        share = np.linspace(0, 1, parts + 1)
        values = stays ** (1 - share) * goes**share
        others = winners(values) != winner
        changes = changes | others.any(-1)
        first = np.maximum(np.argmax(others, axis=-1), 1)[..., None]
        stays, goes = (np.take_along_axis(values, first - back, axis=-1) for back in (1, 0))
    next_ = winners(goes)[..., 0]
    far = np.where(changes, stays[..., 0], ends)
    return tuple(
        JudgementRange(
            pair, float(v), float(low), float(high), *(int(n) if c else None for n, c in zip(n2, c2, strict=True))
        )
        for pair, v, (low, high), n2, c2 in zip(pairs, now, far, next_, changes, strict=True)
    )


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


def winner_map(front: Any, choose: Chooser = weighted_sum) -> WinnerMap:
    """Who wins at every set of weights, on an even lattice of them.

    >>> {design: round(share, 2) for design, share in winner_map([[0, 1], [0.2, 0.2], [1, 0]]).shares.items()}
    {1: 0.6, 0: 0.2, 2: 0.2}
    """
    _refuse_no_rule(choose)
    k = _objectives(front).shape[1]
    weights = weight_lattice(k, LATTICE.get(k, 8))
    return WinnerMap(weights, np.asarray(choose(front, weights)))
