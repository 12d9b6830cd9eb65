"""Contours as cubic splines: through exact points along exact tangents, as few as keep a tolerance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...quantities.types import Array
from .arcs import FINE, spans
from .curves import SAME, Contour, Stretch, from_cubic, smooth_runs, tangent_length


class Spline(NamedTuple):
    """A cubic B-spline with a continuous tangent; it begins at its first control point and ends at its last."""

    layer: str
    controls: Array
    """``(2, n)``, m."""
    knots: Array
    """``(n + 4,)``, m: about the length along it; each but the ends is there twice."""
    closed: bool


def splines(contour: Contour, tolerance: float) -> list[Spline]:
    """The contour as one spline, or as one from each corner to the next, nowhere farther from it than the tolerance.

    >>> from .contours import contours
    >>> from .subject import subjects
    >>> from camkit import TranslatingFlatCam
    >>> (spline,) = splines(contours(subjects(TranslatingFlatCam())[0])[0], 1e-6)
    >>> spline.closed, len(spline.knots) - spline.controls.shape[1]
    (True, 4)
    """
    return [_spline(contour.layer, run, tolerance) for run in smooth_runs(contour)]


def _spline(layer: str, run: Stretch, tolerance: float) -> Spline:
    fine = run.finer(FINE)

    def off(i: int, j: int) -> float:
        start, end = (Stretch(fine.points[:, [k]], fine.tangents[:, [k]]) for k in (i, j))
        if (start.tangents * end.tangents).sum() < 0:
            return np.inf
        return float(from_cubic(start, end, fine.points[:, i : j + 1]).max())

    at = list(spans(fine.points.shape[1] - 1, off, tolerance))
    points, tangents = fine.points[:, at], fine.tangents[:, at]
    size = tangent_length(points[:, :-1], tangents[:, :-1], points[:, 1:], tangents[:, 1:])
    ahead, behind = points[:, :-1] + size / 3 * tangents[:, :-1], points[:, 1:] - size / 3 * tangents[:, 1:]
    between = np.stack([ahead, behind], axis=2).reshape(2, -1)
    knots = np.repeat(np.append(0.0, np.cumsum(size)), 2)
    knots = np.concatenate([knots[:1], knots[:1], knots, knots[-1:], knots[-1:]])
    closed = bool(np.hypot(*(points[:, 0] - points[:, -1])) <= SAME)
    return Spline(layer, np.column_stack([points[:, 0], between, points[:, -1]]), knots, closed)
