"""The curves of a cam by the names under which they are asked for and found in files."""

from __future__ import annotations

import numpy as np

from ...quantities.types import Array
from ...units import deg
from .contours import Contour, contours
from .curves import SAME, Stretch, smooth, smooth_runs
from .subject import Subject

LOST, CORNER = "FAULT", 0.1 * deg
"""The layer of what is cut away; stretches whose tangents differ by less (rad) are one smooth curve."""
WALLS = ("outer wall", "inner wall"), ("upper wall", "lower wall")
"""Of a groove in a disk, and of one around a drum."""
WORDS = {"CAM": "profile", "GROOVE": "groove", "PITCH": "pitch curve"}


def named_contours(subject: Subject) -> dict[str, Contour]:
    """What is cut, and the pitch curve: ``profile``; ``outer wall`` and ``inner wall``, or one ``groove`` with ends.

    Of several of a name the others are numbered.

    >>> from camkit import DoorHandleCam, TranslatingRollerCam
    >>> from .subject import subjects
    >>> list(named_contours(subjects(TranslatingRollerCam())[0]))
    ['outer wall', 'inner wall', 'pitch curve']
    """
    found = [contour for contour in contours(subject) if contour.layer != LOST]
    found.sort(key=_height if subject.drum else _size, reverse=True)
    named: dict[str, Contour] = {}
    walls = [contour for contour in found if contour.layer == "GROOVE"]
    for contour in found:
        name = WORDS[contour.layer]
        if contour.layer == "GROOVE" and len(walls) == 2:
            name = WALLS[subject.drum][contour is walls[1]]
        same = sum(other == name or other.startswith(f"{name} ") for other in named)
        named[f"{name} {same + 1}" if same else name] = contour
    order = list(WORDS)
    return dict(sorted(named.items(), key=lambda each: order.index(each[1].layer)))


def curves_of(subject: Subject) -> dict[str, list[Array]]:
    """The smooth parts of every curve by name, exact points ``(2, n)``, of a drum in space ``(3, n)``, m."""
    space = getattr(subject.analysis, "points_in_space", None)
    if space is not None:
        return {name: [points] for name, points in space.items()}
    return {name: smooth_parts(contour) for name, contour in named_contours(subject).items()}


def smooth_parts(contour: Contour) -> list[Array]:
    """Points ``(2, n)`` of a contour from corner to corner; a closed one without is one part, with one corner two."""
    first, *others = runs = smooth_runs(contour, CORNER)
    if contour.closed and not others and not smooth(first, first, CORNER):
        points, half = _points(first), first.points.shape[1] // 2
        return [points[:, : half + 1], points[:, half:]]
    return [_points(run) for run in runs]


def _points(run: Stretch) -> Array:
    """Of a run; where it ends at its start, that point again to the last digit."""
    points = run.points.copy()
    if np.hypot(*(points[:, 0] - points[:, -1])) <= SAME:
        points[:, -1] = points[:, 0]
    return points


def _height(contour: Contour) -> float:
    return float(contour.points[1].mean())


def _size(contour: Contour) -> float:
    return float(np.hypot(*contour.points).max())
