"""Points to be probed on a cam: where they are, the surface's normal, and how far off they may be."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from ...geometry import rotated
from ...quantities.types import Array, Value
from .columns import Table, Units, stacked
from .curves import Contour, Stretch
from .deviations import NOTHING, deviations
from .named import named_contours
from .sheets import Column
from .subject import Subject

POINTS = 360
"""Of every contour."""


def inspection_columns(
    subject: Subject,
    units: Units,
    limits: tuple[float, float],
    halves: Mapping[str, float] = MappingProxyType({}),
    count: int = POINTS,
) -> Table:
    """Points of every contour that is cut at even distances, with unit normals and the limits of their deviation.

    X, Y, Z are nominal, I, J, K the normal, out of the material; a deviation is measured along it, above 0 where there
    is too much.  ``limits`` are the lower and the upper one, m; with the half widths of tolerances that move the cam
    every point has limits of its own (see `deviations`).
    """
    probed = _of_a_drum(subject, count) if subject.drum else _of_a_disk(subject, count)
    within = {name: deviations(subject, halves, *both) for name, both in probed.items()}
    moved = any(abs(each).max() > NOTHING for both in within.values() for each in both)
    tables = {name: _columns(*both, units, within[name] if moved else limits) for name, both in probed.items()}
    table = stacked(tables, "curve")
    return {"point": np.arange(1.0, 1 + len(table["curve"])), **table}


def largest_deviation(cams: Sequence[Subject], halves: Mapping[str, float]) -> float:
    """Of any point of some cams along its normal, to either side, with sizes within half widths (see `deviations`), m.

    >>> from camkit import TranslatingRollerCam, um
    >>> from .subject import subjects
    >>> round(largest_deviation(subjects(TranslatingRollerCam()), {"base_radius": 20 * um}) / um, 2)
    20.0
    """
    found = [deviations(cam, halves, *both) for cam in cams for both in _probed(cam, POINTS).values()]
    return float(np.max(np.abs(found)))


def _columns(points: Array, normals: Array, units: Units, limits: tuple[Value, Value]) -> Table:
    columns: dict[str, Column] = {}
    for name, values in zip("XYZ", points, strict=True):
        columns |= units.column(name, "length", values)
    columns |= dict(zip("IJK", normals, strict=True))
    for name, limit in zip(("lower limit", "upper limit"), limits, strict=True):
        columns |= units.column(name, "length", limit + np.zeros(points.shape[1]))
    return columns


Probed = dict[str, tuple[Array, Array]]
"""Points and normals in space, ``(3, n)``, by the name of their curve."""


def _probed(subject: Subject, count: int) -> Probed:
    return _of_a_drum(subject, count) if subject.drum else _of_a_disk(subject, count)


def _of_a_disk(subject: Subject, count: int) -> Probed:
    cut = {name: contour for name, contour in named_contours(subject).items() if contour.layer != "PITCH"}
    found = {}
    for name, contour in cut.items():
        points, (x, y) = evenly(contour, count)
        normals = _outward(contour, cut) * np.stack([y, -x])
        found[name] = np.vstack([points, 0.0 * x]), np.vstack([normals, 0.0 * x])
    return found


def _of_a_drum(subject: Subject, count: int) -> Probed:
    """Both flanks at the mean radius, at even steps of the cam angle; their normals are square to the roller's axis."""
    first, last = subject.analysis.cam_angle[[0, -1]]
    at = subject.analysis.at(first + (last - first) * (np.arange(count) + 0.5) / count)
    radius, (around, along) = at.cam.mean_radius, at.normal
    normals = np.vstack([rotated(np.stack([0.0 * around, around]), at.turn), along])
    sides = {"lower flank": 1, "upper flank": -1} if at.groove else {"lower flank": 1}
    return {name: (at.in_space(radius, side), side * normals) for name, side in sides.items()}


def evenly(contour: Contour, count: int) -> Stretch:
    """Points of a contour at even distances along it, with their tangents; none stands on a corner.

    >>> turn = np.linspace(0, 2 * np.pi, 100)
    >>> circle = Stretch(np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)]))
    >>> evenly(Contour("CAM", (circle,), True), 4).points.round(6).tolist()[0]
    [0.707107, -0.707107, -0.707107, 0.707107]
    """
    lengths = [np.append(0, np.cumsum(np.hypot(*np.diff(stretch.points)))) for stretch in contour.stretches]
    begins = np.cumsum([0.0, *(length[-1] for length in lengths)])
    at = begins[-1] * (np.arange(count) + 0.5) / count
    parts = []
    for stretch, length, begin in zip(contour.stretches, lengths, begins, strict=False):
        here = at[(at > begin) & (at < begin + length[-1])] - begin
        parts.append(stretch.at(np.interp(here, length, np.arange(len(length)))))
    points, tangents = (np.hstack(each) for each in zip(*parts, strict=True))
    return Stretch(points, tangents)


def _outward(contour: Contour, cut: Mapping[str, Contour]) -> float:
    """1 where the material lies to the left of the direction of travel, -1: to its right.

    Contours run counter-clockwise: a plate's material is inside, a groove's outside, but within its inner wall.
    """
    if contour.layer == "CAM":
        return 1.0
    others = (other for other in cut.values() if other is not contour and other.layer == "GROOVE")
    return 1.0 if any(_inside(contour.points[:, 0], other.points) for other in others) else -1.0


def _inside(point: Array, around: Array) -> bool:
    """Whether a point lies within a closed polygon: the angles at which its sides are seen add up to a turn."""
    spokes = around - point[:, None]
    turned = np.diff(np.unwrap(np.arctan2(spokes[1], spokes[0]), axis=-1)).sum()
    return bool(abs(turned) > np.pi)
