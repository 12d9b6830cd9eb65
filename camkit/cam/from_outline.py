"""The motion of a follower on a cam that exists, from its outline, and the cam designed anew from that motion.

>>> from camkit.units import deg, mm
>>> eccentric = DrawnOutline.circle(50 * mm, 0.0, -25 * mm)
>>> motion = motion_from_outline(eccentric, TranslatingRollerCam(roller_radius=10 * mm))
>>> (motion([60 * deg, 90 * deg, 180 * deg]).s / mm).round(4).tolist()
[8.4576, 19.5436, 50.0]
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from math import factorial
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..motion import Dwell, Segment, TableMotion
from ..motion.table import Table
from ..quantities import Design, refuse_population
from ..quantities.kinds import kind_words, shown
from ..quantities.types import Array
from ..units import deg, factor, in_unit
from .compared import Compared, compared
from .measured_outline import MeasuredOutline
from .oscillating_flat import OscillatingFlatCam
from .oscillating_roller import OscillatingRollerCam
from .outline_contact import MEETS, Met, Stretch, runs, upper_envelope
from .outlines import MOST, TANGENT, CamOutline, DrawnOutline
from .translating_flat import TranslatingFlatCam
from .translating_roller import TranslatingRollerCam

MANY = 100
"""Pieces of a drawn outline: one of more is taken as points on it."""
RESTS = 5e-9
"""A follower whose level changes by less (m or rad) while it is on one piece rests."""
ROUNDING = 1e-9
"""A jump of the velocity below so much of the follower's height, per rad, is rounding."""
EXACT = 1e-8
"""Polynomials whose acceleration is this share of the largest off that of the contact, or less, follow it."""
STEPS = (8, 16, 32, 64, 128, 256, 512)
"""Polynomials for a stretch of contact: as many as are needed."""
EVEN = 513
"""Even cam angles at which it is looked how the acceleration changes along a stretch."""
ENOUGH = 128
"""So many, or more, are not doubled where that does not halve what they are off."""


class ContactJump(NamedTuple):
    """Where the contact leaps along the outline, or a corner passes: cam angle (rad), velocities before and after."""

    cam_angle: float
    before: float
    after: float


@dataclass(frozen=True)
class OutlineMotion(TableMotion):
    """The motion that an outline gives a follower; a motion program in all else (see `motion_from_outline`).

    Levels count from the lowest place of the follower: ``lowest`` is the height of the roller's centre or of the face
    above the cam axis there, m, or the arm's angle from the line of centres, rad.  ``jumps`` are where the contact
    leaps.  ``outline`` has the points of the outline as they were given (x, y, m).  ``bad_rows`` are points, by their
    polar angle and their distance from the outline (m), as ``noise`` is.
    """

    lowest: float = 0.0
    jumps: tuple[tuple[float, float, float], ...] = ()
    outline: tuple[tuple[float, float], ...] = field(default=(), repr=False, compare=False, metadata={"most": MOST})

    offers: ClassVar[tuple[str, ...]] = ("outline_deviation",)
    """What is shown of a cam with this motion besides."""

    def compared(self, analysis: Any) -> Compared:
        """The outline against the profile of a cam, this one or any other."""
        return compared(np.array(self.outline).T, analysis)

    def __post_init__(self) -> None:
        object.__setattr__(self, "jumps", tuple(ContactJump(*jump) for jump in self.jumps))
        super().__post_init__()


def motion_from_outline(points: object, follower: Design) -> OutlineMotion:
    """The motion of a ``follower`` on a cam of which the outline is known, m, about the cam axis at the origin.

    ``points`` are measured ones (x, y), pairs or two rows (see `MeasuredOutline`, also for polar ones), or a
    `DrawnOutline` of lines and arcs, or what `camkit.files.read_outline` read.  ``follower`` is a disk cam with the
    follower that is meant: its roller, offset, arm, centre distance and direction of rotation count, and its own
    motion and base radius do not.

    Levels count from the lowest one, cam angles from the outline as it lies, with the follower's axis along +y or the
    arm's pivot on the x axis.  Where the contact goes on smoothly the motion is exact: a circle of curvature gives the
    velocity and the acceleration of its place.  Where it leaps, as over a hollow that is narrower than the roller, the
    velocity jumps; ``remarks`` and ``jumps`` name the place.  `cam_from_outline` makes the cam of it.

    Raises ``ValueError`` in a sentence for what is no outline around the cam axis, and where the follower does not
    reach it.
    """
    outline = _outline(points)
    if type(follower) not in MEETS:
        raise ValueError(
            f"the follower is {shown(follower)}; it must be a design of one of "
            f"{', '.join(kind_words(kind) for kind in MEETS)}"
        )
    refuse_population(follower, "the follower")
    meet = partial(MEETS[type(follower)], follower)
    stretches = upper_envelope(runs(outline.pieces, meet, follower.rotation))  # type: ignore[attr-defined]
    return _motion(outline, follower, stretches)


def cam_from_outline(points: object, follower: Design) -> Any:
    """The cam with a given outline, designed anew: ``follower`` with the `motion_from_outline` and the size to it.

    Its profile is the outline, but for what the follower does not touch.

    >>> from camkit.units import mm
    >>> tangent = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm)
    >>> cam = cam_from_outline(tangent, TranslatingRollerCam(roller_radius=12 * mm, groove=False))
    >>> print(f"{cam.base_radius / mm:.6f} mm, {cam.analyse().profile_margin.value / mm:.6f} mm")
    25.000000 mm, 8.000000 mm
    """
    motion = motion_from_outline(points, follower)
    if isinstance(follower, TranslatingRollerCam):
        return follower.replace(motion=motion, base_radius=_base_radius(follower, motion.lowest))
    size = "base_radius" if isinstance(follower, TranslatingFlatCam) else "start_angle"
    return follower.replace(**{"motion": motion, size: motion.lowest})


def _base_radius(follower: TranslatingRollerCam, lowest: float) -> float:
    return float(np.hypot(lowest, follower.offset) - follower.roller_radius)


def _outline(points: Any) -> CamOutline:
    if not isinstance(points, CamOutline):
        return MeasuredOutline(points)
    if isinstance(points, DrawnOutline) and len(points.pieces) > MANY:
        said = f"its {len(points.pieces)} lines and arcs taken as points on them"
        return MeasuredOutline(points.points, said=(said, *points.said))  # type: ignore[arg-type]
    return points


class _Joint(NamedTuple):
    """Where one stretch ends and the next begins: the level, and the velocity on both sides."""

    s: float
    before: float
    after: float


def _motion(outline: CamOutline, follower: Design, stretches: list[Stretch]) -> OutlineMotion:
    ends = [stretch.run.at(np.array([stretch.start, stretch.end])) for stretch in stretches]
    lowest, highest = _reach(stretches)
    if highest - lowest < RESTS:
        raise ValueError("the follower does not move: for it the outline is a circle about the cam axis")
    still = [_rests(stretch) for stretch in stretches]
    height = highest if _unit(follower) == "mm" else 1.0
    joints, healed = _joints(ends, still, height)
    jumps = tuple(
        ContactJump(stretch.end, joint.before, joint.after)
        for stretch, joint in zip(stretches, joints[1:], strict=True)
        if abs(joint.after - joint.before) > ROUNDING * height
    )
    told = [*outline.remarks, _place_in_words(follower, lowest, highest)]
    told += [_jump_in_words(jump, _unit(follower)) for jump in jumps]
    if healed:
        told.append(f"at {healed} joint{'s' * (healed > 1)} lines and arcs are not quite tangent; taken as tangent")
    return OutlineMotion(
        tuple(_segments(stretches, joints, still, ends)),
        joints[0].s - lowest,
        remarks=tuple(told),
        noise=outline.noise,
        bad_rows=outline.bad_points,
        criterion=outline.criterion,
        unit=_unit(follower),
        lowest=lowest,
        jumps=jumps,
        outline=tuple(map(tuple, outline.points.T.tolist())),
    )


def _segments(stretches: list[Stretch], joints: list[_Joint], still: list[bool], ends: list[Met]) -> Iterator[Segment]:
    scale = max(float(abs(end.a).max()) for end in ends)
    for k, stretch in enumerate(stretches):
        if still[k]:
            yield Dwell(stretch.end - stretch.start)
        else:
            first, last = joints[k], joints[k + 1]
            begins, stops = (first.s, first.after, ends[k].a[0]), (last.s, last.before, ends[k].a[1])
            yield _table(stretch, begins, stops, scale)


def _reach(stretches: list[Stretch]) -> tuple[float, float]:
    """The lowest and the highest level."""
    lows, highs = [], []
    for start, end, run in stretches:
        x = np.linspace(start, end, 65)
        s = run.at(x).s
        lows.append(_extreme(run, x, int(np.argmin(s)), 1))
        highs.append(_extreme(run, x, int(np.argmax(s)), -1))
    return min(lows), max(highs)


def _extreme(run: Any, x: Array, k: int, way: int) -> float:
    """The lowest (``way`` = 1) or the highest level next to the best of some cam angles, by Newton's method."""
    low, high, at = x[max(k - 1, 0)], x[min(k + 1, len(x) - 1)], x[k : k + 1]
    best = way * float(run.at(at).s[0])
    for _ in range(4):
        met = run.at(at)
        if not way * met.a[0] > 0:
            break
        at = np.clip(at - met.v / met.a, low, high)
        best = min(best, way * float(run.at(at).s[0]))
    return way * best


def _rests(stretch: Stretch) -> bool:
    return bool(np.ptp(stretch.run.at(np.linspace(stretch.start, stretch.end, 17)).s) < RESTS)


def _joints(ends: list[Met], still: list[bool], height: float) -> tuple[list[_Joint], int]:
    """The follower where stretches meet, the turn's start and end too, and how many were not quite tangent.

    Where the velocity jumps by no more than pieces that were meant to be tangent let it, it is the mean of both.
    """
    joints, healed = [], 0
    before = [0.0 if rests else float(end.v[1]) for end, rests in zip(ends, still, strict=True)]
    after = [0.0 if rests else float(end.v[0]) for end, rests in zip(ends, still, strict=True)]
    for k in range(len(ends)):
        s, jump = (float(ends[k - 1].s[1]) + float(ends[k].s[0])) / 2, after[k] - before[k - 1]
        mean = 0.0 if still[k] or still[k - 1] else (after[k] + before[k - 1]) / 2
        close = abs(jump) <= 2 * TANGENT * height
        healed += close and abs(jump) > ROUNDING * height
        joints.append(_Joint(s, mean, mean) if close else _Joint(s, before[k - 1], after[k]))
    begin = still.index(False)
    for k in range(begin, begin + len(still)):  # a dwell ends where it began, though its arc was rounded
        if still[k % len(still)]:
            joints[(k + 1) % len(still)] = joints[(k + 1) % len(still)]._replace(s=joints[k % len(still)].s)
    return [*joints, joints[0]], healed


def _table(
    stretch: Stretch, first: tuple[float, float, float], last: tuple[float, float, float], scale: float
) -> Table:
    """Quintic polynomials along a stretch of contact, exact at their ends and to ``a`` at its own.

    Half of them are shared out by the cam angle, half by how the acceleration changes.
    """
    from scipy.interpolate import make_interp_spline

    off, even = np.inf, np.linspace(stretch.start, stretch.end, EVEN)
    changes = np.append(0.0, np.cumsum(abs(np.diff(stretch.run.at(even).a))))
    along = (np.linspace(0, 1, EVEN) + changes / max(changes[-1], EXACT * scale)) / 2
    along = along / along[-1]
    for n in STEPS:
        x = np.interp(np.linspace(0, 1, n + 1), along, even)
        s = stretch.run.at(x).s
        s[0], s[-1] = first[0], last[0]
        ends = tuple([(1, end[1]), (2, end[2])] for end in (first, last))
        spline = make_interp_spline(x, s, 5, bc_type=ends)
        middle = (x[1:] + x[:-1]) / 2
        before, off = off, float(abs(spline(middle, 2) - stretch.run.at(middle).a).max())
        if off < EXACT * scale or (n >= ENOUGH and off > before / 2):
            break
    angle = stretch.end - stretch.start
    powers = [spline(x[:-1], k) * angle**k / factorial(k) for k in range(6)]
    powers[0] -= powers[0][0]
    return Table(angle, (0.0, *((x[1:-1] - x[0]) / angle).tolist(), 1.0), tuple(map(tuple, np.array(powers).tolist())))


def _unit(follower: Design) -> str:
    return "mm" if isinstance(follower, TranslatingFlatCam | TranslatingRollerCam) else "deg"


def _place_in_words(follower: Design, lowest: float, highest: float) -> str:
    unit = _unit(follower)
    low, travel = (f"{in_unit(value, unit):.6g} {unit}" for value in (lowest, highest - lowest))
    places: dict[type, str] = {
        TranslatingRollerCam: "the roller's centre stands {} above the cam axis",
        TranslatingFlatCam: "the face stands {} above the cam axis, the base radius",
        OscillatingRollerCam: "the arm stands {} from the line of centres",
        OscillatingFlatCam: "the face stands {} from the line of centres",
    }
    what = places[type(follower)].format(low)
    if isinstance(follower, TranslatingRollerCam):
        what += f": the base radius is {in_unit(_base_radius(follower, lowest), 'mm'):.6g} mm"
    return f"at the lowest {what}; from there it moves by {travel}"


def _jump_in_words(jump: ContactJump, unit: str) -> str:
    before, after = (f"{value / factor(unit):.5g}" for value in (jump.before, jump.after))
    why = (
        "the contact leaps over a part of the outline that the follower does not touch"
        if jump.after > jump.before
        else "the follower passes a corner"
    )
    return f"at {jump.cam_angle / deg:.6g} deg {why}: the velocity jumps from {before} to {after} {unit}/rad"
