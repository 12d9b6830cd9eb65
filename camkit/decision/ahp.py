"""From pairwise judgements to weights: Saaty's analytic hierarchy process; not every pair needs to be judged."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from ..quantities import counted
from ..quantities.kinds import listed, refuse_arguments, shown
from ..units.typed import typed_number
from .weights import completed, judged_weights, lambda_max, refuse_method

RANDOM_INDEX = (0, 0, 0.58, 0.90, 1.12, 1.24, 1.32, 1.41, 1.45, 1.49)
"""Saaty (1980): mean consistency index of random reciprocal matrices of order 1..10; `random_index` goes on."""

MIN_JUDGEMENT, MAX_JUDGEMENT = 1e-6, 1e6
"""Judgements beyond these are slips of the pen; Saaty's own scale ends at 1/9 and 9."""

SAATY_SCALE = (*(1 / k for k in range(9, 1, -1)), *map(float, range(1, 10)))
"""The judgements that Saaty's scale knows, 1/9 .. 9."""

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
class Judgements:
    """How many times each of ``names`` matters more than each other: pairwise judgements, and the weights they give.

    ``matrix[i][j]`` says how many times the first, ``i``, matters more than the second.  Given is the reciprocal matrix
    or what is above its diagonal, row by row; an entry is a number or text such as ``"1/3"``, and ``None`` (or ``nan``)
    stands where nobody has judged.  Of a pair that is printed with rounded reciprocals, such as 3 and 0.33, the one
    above 1 counts, and ``note`` says so.  ``method``: the weights are the principal eigenvector, ``"eigenvector"``
    (Saaty 1980), or the geometric means of the rows, ``"geometric"`` (Crawford, Williams 1985).  Without names the
    criteria are numbered.

    >>> judgements = Judgements(("angle", "force", "torque"), [5, None, "1"])
    >>> judgements.matrix[0], judgements.above, judgements.missing
    ((1.0, 5.0, None), (5.0, None, 1.0), 1)
    >>> (judgements.weights * 7).round(6).tolist()
    [5.0, 1.0, 1.0]

    Raises ``ValueError`` naming the entry that is not positive or not reciprocal, or the criteria that no judgement
    connects.
    """

    names: Sequence[str]
    matrix: Any
    method: str = "eigenvector"
    note: str = field(default="", init=False, compare=False)

    def __post_init__(self) -> None:
        names = listed(self.names, "the list of names", "criterion")
        wrong = [name for name in names if not isinstance(name, str) or not name.strip()]
        if wrong:
            raise ValueError(f"the name of a criterion is {shown(wrong[0])}; it must be a text")
        if twice := [name for i, name in enumerate(names) if name in names[:i]]:
            raise ValueError(f"two criteria have the name {shown(twice[0])}; each must have a name of its own")
        matrix, note = _matrix(self.matrix, names)
        if names and len(names) != len(matrix):
            raise ValueError(f"there are {len(matrix)} rows of judgements for {len(names)} criteria")
        refuse_method(self.method)
        rows = tuple(tuple(None if math.isnan(v) else v for v in row) for row in matrix.tolist())
        object.__setattr__(self, "names", names or tuple(f"criterion {i + 1}" for i in range(len(matrix))))
        object.__setattr__(self, "matrix", rows)
        object.__setattr__(self, "note", note)

    @cached_property
    def array(self) -> np.ndarray:
        """The matrix as an array ``(n, n)``, ``nan`` where nobody has judged."""
        return np.array(self.matrix, dtype=float)

    @property
    def above(self) -> tuple[float | None, ...]:
        """What is above the diagonal of the matrix, row by row."""
        return tuple(self.matrix[i][j] for i, j in self.pairs)

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The places in the matrix of what is `above` its diagonal."""
        return list(combinations(range(len(self.matrix)), 2))

    def judging(self, pair: tuple[int, int], value: object) -> Judgements:
        """The same judgements but for one pair; ``None`` leaves it open.

        >>> Judgements(("a", "b"), [3]).judging((0, 1), "1/5").above
        (0.2,)
        """
        refuse_arguments(Judgements.judging, locals())
        if pair not in self.pairs:
            raise ValueError(f"the pair is {shown(pair)}; there are {', '.join(map(str, self.pairs)) or 'none'}")
        above = [value if p == pair else judged for p, judged in zip(self.pairs, self.above, strict=True)]
        return replace(self, matrix=above)

    def complete(self) -> Judgements:
        """The same judgements, with those that are missing as they contradict the others least (see `completed`)."""
        return replace(self, matrix=self._completed)

    @cached_property
    def _completed(self) -> np.ndarray:
        return completed(self.array)

    @cached_property
    def weights(self) -> np.ndarray:
        """The weights of the criteria, ``(n,)``; they add to 1."""
        return judged_weights(self._completed, self.method)

    @cached_property
    def lambda_max(self) -> float:
        """The largest eigenvalue of the matrix; ``n`` for judgements without contradiction."""
        return float(lambda_max(self._completed))

    @property
    def missing(self) -> int:
        """How many pairs nobody has judged."""
        return self.above.count(None)

    @property
    def consistency_index(self) -> float:
        """``(lambda_max - n) / (n - 1)``; 0 for judgements without contradiction."""
        n = len(self.matrix)
        return max((self.lambda_max - n) / (n - 1), 0.0) if n > 1 else 0.0

    @property
    def consistency_ratio(self) -> float:
        """Consistency index over the `random_index`; above 0.1 the judgements contradict each other.

        Fewer judgements contradict each other less, even at random: with ``m`` pairs missing the random index is
        ``1 - 2 m / ((n - 1) (n - 2))`` of the full one (Agoston, Csato 2022).
        """
        n = len(self.matrix)
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
        pairs = [pair for pair in self.pairs if _redundant(self.array, pair)]
        if not pairs:
            return {}
        others = completed(np.stack([_unjudged(self.array, pair) for pair in pairs]))
        left = lambda_max(others)
        return {
            pair: float(full[pair])
            for pair, full, value in zip(pairs, others, left, strict=True)
            if value <= left.min() * (1 + ALIKE)
        }

    def __iter__(self) -> Iterator[np.ndarray | float]:
        """Unpacks as weights and consistency ratio."""
        return iter((self.weights, self.consistency_ratio))


def _judged(i: int, j: int, names: Sequence[str]) -> str:
    """What a judgement is called: by the ``names`` of the criteria, if they have any."""
    return f"the judgement of {names[i]} against {names[j]}" if names else f"judgement ({i + 1}, {j + 1})"


def _matrix(judgements: object, names: Sequence[str]) -> tuple[np.ndarray, str]:
    """The reciprocal matrix, and a note on the rounded reciprocals in it."""
    given = _entries(judgements)
    a = _from_above(given) if given.ndim == 1 else given
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise ValueError(f"the judgements have the shape {a.shape}; they must be a square matrix")
    names = names if len(names) == len(a) else ()
    with np.errstate(divide="ignore", over="ignore"):
        a = np.where(np.isnan(a), np.where(np.eye(len(a), dtype=bool), 1, 1 / a.T), a)
    for i, j in np.argwhere(~(np.isnan(a) | ((a >= MIN_JUDGEMENT) & (a <= MAX_JUDGEMENT)))):
        possible = 0 < a[i, j] < math.inf
        must = f"nobody tells apart more than {MAX_JUDGEMENT:g} to 1" if possible else "it must be a positive number"
        raise ValueError(f"{_judged(i, j, names)} is {a[i, j]:g}; {must}")
    rounded = _exact_reciprocals(a, names)
    _refuse_gaps(a, names)
    return a, f"rounded reciprocals are read as exact ones: {', '.join(dict.fromkeys(rounded))}" if rounded else ""


def _exact_reciprocals(a: np.ndarray, names: Sequence[str]) -> list[str]:
    """Make rounded reciprocals in ``a`` exact, and say which; refuse what is no reciprocal."""
    rounded = []
    for i, j in np.argwhere(np.triu(abs(a * a.T - 1) > 1e-6)):
        more, less = max(a[i, j], a[j, i]), min(a[i, j], a[j, i])
        if i == j or not _rounded_reciprocal(more, less):
            raise ValueError(
                f"{_judged(i, j, names)} is {a[i, j]:.6g} and {_judged(j, i, names)} is {a[j, i]:.6g}; "
                + ("the diagonal must be 1" if i == j else ONE_OVER_THE_OTHER)
            )
        rounded.append(f"{less:g} as 1/{more:g}")
        a[i, j], a[j, i] = (more, 1 / more) if a[i, j] == more else (1 / more, more)
    return rounded


ONE_OVER_THE_OTHER = "one must be 1 over the other (text such as '1/3' is exact, None leaves a place open)"


def _entries(judgements: object) -> np.ndarray:
    """Judgements as numbers, ``nan`` for none."""
    wrong = "the judgements must be a square matrix of numbers, or what is above its diagonal"
    try:
        given = np.array(judgements, dtype=object)
    except ValueError:
        raise ValueError(wrong) from None
    if given.ndim not in (1, 2):
        raise ValueError(wrong)
    if not given.size:
        raise ValueError("there are no judgements; those of a single criterion are [[1]]")
    return np.array([_entry(entry, wrong) for entry in given.flat]).reshape(given.shape)


def _entry(entry: object, wrong: str) -> float:
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
    joined = ~np.isnan(a) | np.eye(len(a), dtype=bool)
    for _ in range(len(a).bit_length()):  # each time over ways twice as long
        joined = joined @ joined
    firsts, group = np.unique(joined.argmax(-1), return_inverse=True)
    return len(firsts), group


def _unjudged(a: np.ndarray, pair: tuple[int, int]) -> np.ndarray:
    """The matrix without one judgement."""
    without = a.copy()
    without[pair] = without[pair[::-1]] = np.nan
    return without


def _redundant(a: np.ndarray, pair: tuple[int, int]) -> bool:
    """Whether a pair is judged and all criteria are connected without that judgement too."""
    return not np.isnan(a[pair]) and _groups(_unjudged(a, pair))[0] == 1


def _refuse_gaps(a: np.ndarray, names: Sequence[str]) -> None:
    """Criteria that no chain of judgements connects have no weights among each other."""
    groups, group = _groups(a)
    if groups > 1:
        called = names or [str(i + 1) for i in range(len(a))]
        first, rest = (", ".join(called[int(i)] for i in np.flatnonzero(side)) for side in (group == 0, group != 0))
        what = "" if names else "criterion "
        raise ValueError(f"no judgement connects {what}{first} with {what}{rest}; judge one such pair")


def _from_above(values: np.ndarray) -> np.ndarray:
    n = round((1 + np.sqrt(1 + 8 * len(values))) / 2)
    if n * (n - 1) // 2 != len(values):
        raise ValueError(
            f"{len(values)} judgements are not what is above the diagonal of a matrix; 1, 3, 6, 10, ... are"
        )
    a = np.full((n, n), np.nan)
    a[np.triu_indices(n, 1)] = values
    np.fill_diagonal(a, 1)
    return a


def ahp(judgements: object, method: str | None = None) -> Judgements:
    """Pairwise judgements with their weights and consistency (Saaty 1980); unpacks as weights and consistency ratio.

    ``judgements`` are `Judgements`, or a reciprocal matrix or what is above its diagonal, whose criteria have no names.
    ``method``: ``"eigenvector"`` (unless said otherwise) or ``"geometric"``, see `Judgements`.

    >>> weights, ratio = ahp([[1, 5, 5], [1 / 5, 1, 1], [1 / 5, 1, 1]])
    >>> (weights * 7).round(6).tolist(), round(ratio, 6)
    ([5.0, 1.0, 1.0], 0.0)
    >>> print(ahp([[1, 3], [0.33, 1]]).note)
    rounded reciprocals are read as exact ones: 0.33 as 1/3

    Raises ``ValueError`` for a matrix that is not square, positive and reciprocal, naming the entry, and for criteria
    that no judgement connects.
    """
    if isinstance(judgements, Judgements):
        return judgements if method is None else replace(judgements, method=method)
    return Judgements((), judgements, "eigenvector" if method is None else method)
