"""By how much a cam deviates along its normals while the sizes it is made after stay within tolerances.

The worst part is at a corner of the tolerances' box; at which one, the signs of the sizes' own influences say, point by
point.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...quantities import Paths, Quantity, value_of, words
from ...quantities.kinds import one_number
from ...quantities.types import Array
from ...study.spread import Source, Tolerance
from ...study.tolerances import Tolerances
from .subject import Subject, cams_of

ROWS = 721
"""Cam angles at which every part is analysed; between them a flank is the parabola through three of its points."""
ON = 1e-6
"""A point farther (m) from a flank than this does not lie on it."""
FAR = 10.0
"""So many rows a flank is followed at most to where it crosses a normal."""
NOTHING = 1e-12
"""A size that moves a point less (m) does not move it."""

Within = Tolerances | Mapping[str | Source, object]


def half_widths(design: object, given: Within | None) -> dict[str, float]:
    """Half widths of tolerances by path, SI; a `Source` widens all that it moves.

    ``ValueError`` in a sentence for a path that the design does not have, and for a tolerance that goes farther to one
    side than to the other.
    """
    told = (given.half_widths if isinstance(given, Tolerances) else given or {}).items()
    halves: dict[str, float] = {}
    for key, tolerance in told:
        name, moves, of = (key.name, key.moves, key.of) if isinstance(key, Source) else (key, *(((key, 1.0),),) * 2)
        Paths(design, dict.fromkeys(path for path, _ in (*moves, *of)), Quantity)
        half = _half(tolerance, name, sum(factor * value_of(design, path) for path, factor in of))
        for path, factor in moves:
            halves[path] = halves.get(path, 0.0) + abs(factor) * half
    return halves


def _half(given: object, name: str, value: float) -> float:
    """How far a tolerance reaches to either side of a value."""
    what = f"the tolerance of the {words(name)}"
    if isinstance(given, (Tolerance, tuple)) or callable(given):
        tolerance = given if isinstance(given, Tolerance) else Tolerance(given)
        low, given = (float(side[0]) for side in tolerance.between(name, np.array([value])))
        if not np.isclose(-low, given, rtol=1e-9, atol=0):
            raise ValueError(f"{what} goes from {low:g} to {given:g} (SI); here it must reach as far to both sides")
    return one_number(given, what, "be finite and at least 0", lambda x: 0 <= x < np.inf)


def deviations(subject: Subject, halves: Mapping[str, float], points: Array, normals: Array) -> tuple[Array, Array]:
    """The lowest and the highest deviation of a cam at its ``points`` along unit ``normals``, ``(3, n)``; ``(n,)``, m.

    Sizes are within ``halves``, half widths by path.  A flat face that moves its cam's profile moves it by as much:

    >>> from camkit import TranslatingFlatCam, um
    >>> from .subject import subjects
    >>> (cam,) = subjects(TranslatingFlatCam(base_radius=0.03))
    >>> low, high = deviations(cam, {"base_radius": 25 * um}, np.array([[0.0], [0.03], [0.0]]), np.eye(3)[:, 1:2])
    >>> (low / um).round(3).tolist(), (high / um).round(3).tolist()
    ([-25.0], [25.0])

    Raises ``ValueError`` where a part within the tolerances cannot be built.
    """
    halves = {path: half for path, half in halves.items() if half}
    if not halves:
        return np.zeros(points.shape[1]), np.zeros(points.shape[1])
    one = np.eye(len(halves))
    alone = _of_parts(subject, halves, np.concatenate([one, -one]), points, normals)
    falls = (alone[: len(halves)] - alone[len(halves) :]).T < -NOTHING
    corners = np.unique(np.where(falls, -1.0, 1.0), axis=0)
    found = _of_parts(subject, halves, np.concatenate([corners, -corners]), points, normals)
    return np.minimum(found.min(0), 0.0), np.maximum(found.max(0), 0.0)


def _of_parts(subject: Subject, halves: Mapping[str, float], shares: Array, points: Array, normals: Array) -> Array:
    """How far each part lies off, ``(p, n)``, m; ``shares`` ``(p, k)`` of the half widths are what it deviates by."""
    from scipy.spatial import cKDTree

    parts = _parts(subject, halves, np.vstack([0.0 * shares[:1], shares]))
    drum = subject.drum
    away = points * [[1.0], [1.0], [0.0]] if drum else np.array([[0.0], [0.0], [1.0]]) + 0.0 * points
    along = np.cross(normals, away / np.sqrt((away**2).sum(0)), axis=0)
    lines = np.stack([along, normals])
    made = _flanks(parts, subject.analysis.cam.mean_radius if drum else None)
    flanks = [_of_each(flank, 1 + len(shares)) for flank in made]
    if not all(np.isfinite(flank).all() for flank in flanks):
        raise ValueError("the tolerances are too wide: a part within them cannot be built")
    stretch = np.atleast_2d(parts.analysis.stretch)[0]
    rows = 1 + np.flatnonzero((stretch[2:] == stretch[1:-1]) & (stretch[:-2] == stretch[1:-1]))
    trees = [cKDTree(flank[:, 0, rows].T).query(points.T) for flank in flanks]
    which = np.argmin([distance for distance, _ in trees], axis=0)
    found = [_crossing(flank, rows[near], points, lines) for flank, (_, near) in zip(flanks, trees, strict=True)]
    off = np.take_along_axis(np.stack(found), which[None, None], axis=0)[0]
    if not drum and len(flanks) > 1:
        off = np.where(abs(off[0]) > ON, _round_ends(parts, points, lines, off), off)
    return np.asarray(off - off[0])[1:]


def _parts(subject: Subject, halves: Mapping[str, float], shares: Array) -> Subject:
    """The same cam of a population."""
    paths = Paths(subject.design, halves, Quantity)
    values = np.array(paths.values(subject.design)) + shares * list(halves.values())
    design = paths.put(subject.design, [*values.T[:, :, None]])
    return next(part for part in cams_of(design, design.analyse(ROWS)) if part.name == subject.name)


def _flanks(parts: Subject, radius: float | None) -> list[Array]:
    """Of a population in space, ``(3, p, rows)``, those of a drum at a radius."""
    a = parts.analysis
    if radius is not None:
        return [a.in_space(radius, side) for side in ((1, -1) if a.groove else (1,))]
    flat = [a.profile, *([a.outer_profile] if np.isfinite(a.outer_profile).any() else [])]
    return [_in_space(parts, flank) for flank in flat]


def _of_each(flank: Array, p: int) -> Array:
    """A flank that all parts of a population may share, ``(3, p, rows)``."""
    return np.broadcast_to(flank if flank.ndim > 2 else flank[:, None], (3, p, flank.shape[-1]))


def _in_space(parts: Subject, flat: Array) -> Array:
    x, y = parts.on_the_shaft(flat.reshape(2, -1)).reshape(flat.shape)
    return np.stack([x, y, 0.0 * x])


def _crossing(flank: Array, near: Array, points: Array, lines: Array) -> Array:
    """How far along its normal every point's flank lies, ``(p, n)``, m, by the parabola through three rows of it."""
    before, here, behind = (
        np.einsum("lin,ipn->lpn", lines, flank[:, :, near + k] - points[:, None]) for k in (-1, 0, 1)
    )
    slope, bend = (behind - before) / 2, (behind + before) / 2 - here
    a, b, c = here[0], slope[0], bend[0]
    root = np.sqrt(np.maximum(b * b - 4 * a * c, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        rows = -2 * a / (b + np.copysign(root, b))
    rows = np.clip(np.nan_to_num(rows), -FAR, FAR)
    return np.asarray(here[1] + rows * (slope[1] + rows * bend[1]))


def _round_ends(parts: Subject, points: Array, lines: Array, off: Array) -> Array:
    """The same of the points at an end of an open groove, a circle of the roller's radius; ``off`` of all others."""
    radius = np.asarray(parts.analysis.cam.roller_radius)
    ends = _of_each(_in_space(parts, parts.analysis.pitch[..., [0, -1]]), len(off))
    for centre in ends.transpose(2, 0, 1):
        along, up = np.einsum("lin,ipn->lpn", lines, centre[:, :, None] - points[:, None])
        on = abs(np.hypot(along[0], up[0]) - np.ravel(radius)[0]) < ON
        off = np.where(on, up - np.sqrt(np.maximum(radius**2 - along**2, 0.0)), off)
    return off
