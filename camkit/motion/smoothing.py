"""Rows of a table, smoothed: quintic splines of which as much is left as the rows know.

What is least is ``sum (s - y)^2 + lambda int (s'''')^2`` over quintic B-splines with even knots; ``lambda`` is that of
the least generalised cross-validation, ``N RSS / (N - edf)^2``, and never so small that less than the rounding of the
rows is smoothed away.  One generalised eigenproblem gives every ``lambda`` at once.

Source: Craven, Wahba, Smoothing noisy data with spline functions; Eilers, Marx, Flexible smoothing with B-splines;
Wood, Generalized Additive Models.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..quantities.types import Array

CARDINAL = (
    np.array(
        [
            [1, 26, 66, 26, 1, 0],
            [-5, -50, 0, 50, 5, 0],
            [10, 20, -60, 20, 10, 0],
            [-10, 20, 0, -20, 10, 0],
            [5, -20, 30, -20, 5, 0],
            [-1, 5, -10, 10, -5, 1],
        ]
    )
    / 120
)
"""Of the share of a span between two knots, what stands before each power for each of six coefficients."""
SPANS, MOST_SPANS = 200, 800
"""Between the knots at first, and at most."""
WEIGHTS = 10.0 ** np.arange(-18, 12.01, 0.1)
"""Of smoothness, that are looked at; the least of the criterion is then sought between three of them."""
CANDIDATE, BAD = 4.0, 5.0
"""Robust scales at which a row is set aside until there is a curve, and at which it is off the curve."""
CONTINUED = 8
"""Good rows on one side of a row, through which a cubic goes on to it."""
CONTINUES = 0.4
"""A row that is nearer to such a cubic than so much of its distance from the curve is where two motions join."""
SURE = 0.2
"""What the scatter of good rows makes of such a cubic is no more than so much of that distance."""
FITS = 12
"""So often, at most, rows are left out and others taken back."""
DRAWN = 0.9
"""A curve through good rows that has been determined by more of them cannot tell a bad one."""
NEIGHBOURS = 7
"""Rows that stand out where one does."""
FEW, SHARE = 3, 0.02
"""So many bad rows may be named; with more the rows are rough, and none is."""


class BadRow(NamedTuple):
    """A row far off the curve through all others: its number from 1, its angle (rad) and deviation (m or rad)."""

    row: int
    angle: float
    deviation: float


@dataclass(frozen=True)
class Rows:
    """Rows to be smoothed: shares ``u`` of the span in order, their ``y``, by how much they are rounded, their ends.

    ``ends`` is ``"turn"`` (the last row is followed by the first), ``"level"`` (as high at both ends) or ``"free"``;
    so many derivatives are 0 there as ``rest`` says: v, or v and a.
    """

    u: Array
    y: Array
    digit: float
    ends: str
    rest: int = 0
    tolerance: float | None = None

    @cached_property
    def smoothed(self) -> Smoothed:
        """All rows smoothed but the bad ones."""
        return _without_bad_rows(self)


@dataclass(frozen=True)
class Smoothed:
    """A spline through rows: its coefficients ``(n + 5,)`` for ``n`` even spans, and what it left of the rows."""

    coefficients: Array
    noise: float
    free: float
    """How many numbers the rows have determined, ``edf``."""
    by: str
    validated: float
    """What `by` is least of: generalised cross-validation."""
    leverage: Array
    bad: tuple[int, ...] = ()
    off: tuple[float, ...] = ()
    """The places of the rows that were left out, and how far they are off."""

    def __call__(self, u: Array) -> Array:
        """The level at shares ``u`` of the span."""
        spans = len(self.coefficients) - 5
        place, weights = _basis(u, spans)
        return (self.coefficients[place] * weights).sum(-1)

    @property
    def powers(self) -> Array:
        """What stands before each power of the distance (a share of the span) from each knot, ``(6, n)``."""
        spans = len(self.coefficients) - 5
        windows = np.lib.stride_tricks.sliding_window_view(self.coefficients, 6)
        return (CARDINAL @ windows.T) * float(spans) ** np.arange(6)[:, None]


def _basis(u: Array, spans: int) -> tuple[Array, Array]:
    """Of each ``u`` the places of the six coefficients that count there, and how much they do, ``(rows, 6)``."""
    span = np.clip(np.floor(u * spans), 0, spans - 1)
    share = u * spans - span
    return span.astype(int)[:, None] + np.arange(6), (share[:, None] ** np.arange(6)) @ CARDINAL


def _matrix(u: Array, spans: int) -> Any:
    from scipy.sparse import csr_array

    place, weights = _basis(u, spans)
    rows = np.repeat(np.arange(len(u)), 6)
    return csr_array((weights.ravel(), (rows, place.ravel())), shape=(len(u), spans + 5))


def _roughness(spans: int) -> Array:
    """``int (s'''')^2`` of the coefficients: the fourth derivative is a line in each span, two points are enough."""
    from scipy.sparse import csr_array

    at = np.array([-1, 1]) / np.sqrt(12) + 0.5
    weights = (24 * CARDINAL[4] + 120 * CARDINAL[5] * at[:, None]) * spans**3.5 / np.sqrt(2)
    place = np.repeat(np.arange(spans)[:, None] + np.arange(6), 2, axis=0)
    rows = np.repeat(np.arange(2 * spans), 6)
    fourth = csr_array((np.tile(weights, (spans, 1)).ravel(), (rows, place.ravel())), shape=(2 * spans, spans + 5))
    return np.asarray((fourth.T @ fourth).todense())


def _allowed(ends: str, rest: int, spans: int) -> Array:
    """The coefficients that the ends allow, as columns."""
    if ends == "turn":  # the last five are the first five
        return np.vstack([np.eye(spans), np.eye(spans)[:5]])
    every = np.eye(spans + 5)
    first, last = every[:6], every[-6:]
    order = np.arange(6)
    rows = [CARDINAL[0] @ first - CARDINAL.sum(0) @ last] if ends == "level" else []
    for k, at_last in ((1, order @ CARDINAL), (2, (order * (order - 1)) @ CARDINAL))[:rest]:
        rows += [CARDINAL[k] @ first, at_last @ last]
    return np.linalg.svd(np.stack(rows))[2][len(rows) :].T if rows else every


class _Spectrum:
    """The splines of some rows for every weight of smoothness: ``V, mu`` of ``B'B`` against ``B'B + kappa P``."""

    def __init__(self, rows: Rows, out: Array, spans: int) -> None:
        from scipy.linalg import eigh

        self.rows, self.spans, self.y = rows, spans, rows.y[~out]
        self.basis, allowed = _matrix(rows.u[~out], spans), _allowed(rows.ends, rows.rest, spans)
        points = allowed.T @ (self.basis.T @ self.basis @ allowed)
        rough = allowed.T @ _roughness(spans) @ allowed
        kappa = 1e8 * np.trace(points) / np.trace(rough)
        mu, V = eigh(points, points + kappa * rough)
        self.mu, self.V = np.clip(mu, 0.0, 1.0), allowed @ V
        self.g = self.V.T @ (self.basis.T @ self.y)
        self.known = self.mu > 1e-14
        least = self.residual(WEIGHTS[0])
        self.rest = max(float(least @ least - self._lost(WEIGHTS[0])), 0.0)

    def kept(self, tau: Array | float) -> Array:
        """``f``: which share of each pattern is left at a weight."""
        tau = np.asarray(tau)[..., None]
        return np.where(self.known, self.mu / (self.mu + tau * (1 - self.mu)), 0.0)

    def _lost(self, tau: Array | float) -> Array:
        sizes = np.divide(self.g**2, self.mu, out=np.zeros_like(self.g), where=self.known)
        return (sizes * (1 - self.kept(tau)) ** 2).sum(-1)

    def squares(self, tau: Array | float) -> Array:
        """``RSS``, the sum of the squared deviations."""
        return self.rest + self._lost(tau)

    def coefficients(self, tau: float) -> Array:
        return self.V @ (np.where(self.known, self.g, 0.0) / (self.mu + tau * (1 - self.mu)))

    def residual(self, tau: float) -> Array:
        return self.y - self.basis @ self.coefficients(tau)

    def validated(self, tau: Array | float) -> Array:
        """The criterion of generalised cross-validation."""
        N = len(self.y)
        left = N - self.kept(tau).sum(-1)
        return np.where(left > 1e-3 * N, N * self.squares(tau) / np.maximum(left, 1e-3 * N) ** 2, np.inf)

    def chosen(self) -> tuple[float, str]:
        """The weight, and by what it was chosen."""
        rows = self.rows
        if rows.tolerance is not None:
            most = rows.tolerance
            return _largest(lambda tau: np.max(np.abs(self.residual(tau))) <= most), "tolerance"
        best = int(np.argmin(self.validated(WEIGHTS)))
        tau = WEIGHTS[best]
        for width in (0.1, 0.005, 0.00025):
            near = tau * 10 ** np.linspace(-width, width, 41)
            tau = near[int(np.argmin(self.validated(near)))]
        N, rounding = len(self.y), rows.digit**2 / 12
        if self.squares(tau) / (N - self.kept(tau).sum()) < rounding:
            return max(_largest(lambda tau: self.squares(tau) <= N * rounding), tau), "rounding"
        return float(tau), "cross-validation"

    def smoothed(self) -> Smoothed:
        tau, by = self.chosen()
        free, residual = float(self.kept(tau).sum()), self.residual(tau)
        noise = np.sqrt(residual @ residual / max(len(residual) - free, 1e-3 * len(residual)))
        coefficients, validated = self.coefficients(tau), float(self.validated(tau))
        return Smoothed(coefficients, float(noise), free, by, validated, self.leverage(tau, self.rows.u))

    def leverage(self, tau: float, u: Array) -> Array:
        """``h``: by how much the curve follows each row."""
        half = self.V * np.sqrt(1 / (self.mu + tau * (1 - self.mu)))
        spread = half @ half.T
        place, weights = _basis(u, self.spans)
        return np.einsum("ri,rij,rj->r", weights, spread[place[:, :, None], place[:, None, :]], weights)


def _largest(holds: Any) -> float:
    """The largest weight, to a hair, for which something holds; the least where it never does."""
    low, high = -18.0, 12.0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(10**middle) else (low, middle)
    return float(10**low)


def smooth(rows: Rows, out: Array, spans: int = SPANS) -> Smoothed:
    """A spline through the rows but for those ``out``; more knots are taken until most of them say nothing."""
    most = min(MOST_SPANS, len(rows.u))
    spans = min(spans, most)
    while True:
        found = _Spectrum(rows, out, spans).smoothed()
        if found.free <= spans / 3 or spans == most:
            return found
        spans = min(2 * spans, most)


def _without_bad_rows(rows: Rows) -> Smoothed:
    """The rows smoothed without those that are off the curve through all others; the worst are found first."""
    most, none = max(FEW, int(SHARE * len(rows.u))), np.zeros(len(rows.u), dtype=bool)
    out = _suspect(rows)
    out = none if out.sum() > 2 * NEIGHBOURS * most else out
    spans = SPANS
    for _ in range(FITS):
        found = smooth(rows, out, spans)
        spans, (off, scale) = len(found.coefficients) - 5, _off(rows, found, out)
        bad = [i for i in np.argsort(-off) if off[i] > BAD * scale and not _goes_on(rows, i, out, off)]
        if len(bad) > most or found.free > DRAWN * (~out).sum():
            break
        new = [i for i in bad if not out[i] and off[i] > off[bad[0]] / 2]
        back = out & ~np.isin(np.arange(len(out)), bad)
        if not (new or back.any()):
            gone = rows.y[bad] - found(rows.u[bad])
            return replace(found, bad=tuple(int(i) for i in bad), off=tuple(gone.tolist()))
        out = out & ~back
        out[new] = True
    return smooth(rows, none, spans)


def _off(rows: Rows, found: Smoothed, out: Array) -> tuple[Array, float]:
    """How far each row is off the curve, as if it did not draw it to itself; and how far rows are that are good."""
    inside = np.sqrt(np.maximum(1 - found.leverage, 1e-3))
    off = np.abs(rows.y - found(rows.u)) / np.where(out, np.sqrt(1 + found.leverage), inside)
    return off, max(1.4826 * float(np.median(off)), rows.digit)


def _goes_on(rows: Rows, i: int, out: Array, off: Array) -> bool:
    """Whether a row goes on what the rows on one side of it are, as where one part of a motion joins another.

    Asked are the cubics through some good rows and through four, where these are good enough to say so.
    """
    n, good = len(rows.u), np.flatnonzero(~out & (np.arange(len(out)) != i))
    scatter = max(float(np.median(off)), rows.digit / np.sqrt(12))
    if rows.ends == "turn":
        good = np.concatenate([good - n, good, good + n])
    for near in (good[good < i][-CONTINUED:], good[good > i][:CONTINUED][::-1]):
        for some in (near, near[-4:]) if len(near) >= 4 else ():
            x = rows.u[some % n] + some // n - rows.u[i]
            weights = np.linalg.pinv(np.vander(x / np.ptp(x), 4))[-1]
            apart = abs(rows.y[i] - weights @ rows.y[some % n])
            if apart < CONTINUES * off[i] and np.linalg.norm(weights) * scatter < SURE * off[i]:
                return True
    return False


def _suspect(rows: Rows) -> Array:
    """Rows that stand out of the cubic through two neighbours on each side, next or next but one."""
    n, turn = len(rows.u), rows.ends == "turn"
    out = np.zeros(n, dtype=bool)
    for sides in ([-2, -1, 1, 2], [-3, -2, 2, 3]):
        reach = 0 if turn else sides[-1]
        if n < 2 * sides[-1] + 1:
            continue
        here = np.arange(reach, n - reach)
        there = here[:, None] + np.array(sides)
        x = rows.u[there % n] + there // n - rows.u[here][:, None]
        weights = np.stack([np.prod(np.delete(x, k, 1) / (np.delete(x, k, 1) - x[:, [k]]), 1) for k in range(4)], 1)
        apart = np.abs(rows.y[here] - (weights * rows.y[there % n]).sum(1))
        out[here] |= apart > CANDIDATE * max(1.4826 * float(np.median(apart)), rows.digit)
    return out
