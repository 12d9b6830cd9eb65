"""The weights that matrices of pairwise judgements give, for one matrix or thousands at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..quantities.kinds import numbers, shown

ROUNDS, SETTLED = 1000, 1e-13
"""How often missing judgements are improved at most, and by which share the last round may still move them."""

SQUARINGS = 50
"""How often a matrix is squared at most until its columns are its eigenvector."""


def judged_weights(matrices: object, method: str = "eigenvector") -> np.ndarray:
    """Weights ``(..., n)`` of reciprocal matrices ``(..., n, n)``, `completed` where nobody has judged.

    ``"eigenvector"``: the principal eigenvector (Saaty 1980).  ``"geometric"``: the geometric means of the rows
    (Crawford, Williams 1985).
    """
    refuse_method(method)
    w = METHODS[method](completed(matrices))
    return np.asarray(w / w.sum(-1, keepdims=True))


def completed(matrices: object) -> np.ndarray:
    """Reciprocal matrices ``(..., n, n)`` with the missing judgements (``nan``) that contradict the others least.

    They are those with the least ``lambda_max`` (Bozoki, Fulop, Ronyai 2010: there is one such completion).  With the
    eigenvectors ``x`` of the matrix and ``y`` of its transpose ``lambda_max`` does not change with ``a_ij`` where
    ``y_i a_ij x_j = y_j a_ji x_i``; each round puts that ``a_ij`` in.

    >>> completed([[1, 5, np.nan], [1 / 5, 1, 1], [np.nan, 1, 1]]).round(9)[0].tolist()
    [1.0, 5.0, 5.0]
    """
    try:
        a = numbers(matrices, "all")
    except ValueError:
        a = np.zeros(())
    if not a.ndim:
        raise ValueError("the judgements must be square matrices of numbers")
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


def lambda_max(a: np.ndarray) -> np.ndarray:
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


def refuse_method(method: str) -> None:
    """``ValueError`` in a sentence for what is no method of `METHODS`."""
    if not isinstance(method, str) or method not in METHODS:
        raise ValueError(f"the method is {shown(method)}; there are {' and '.join(map(repr, METHODS))}")
