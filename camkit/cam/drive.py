"""What turns a cam: its torque over the turn, the work above the mean, the flywheel for it, and the motor.

The torque is ``M = N v``, that on the cam without friction; of a cam with an elastic train ``N`` is the train's.  Over
the turn its mean is all that a motor gives; what it takes above the mean, in one part of the turn, a flywheel stores:

    A(phi) = integral of (M - mean),   I = (max A - min A) / (delta omega^2)

where ``delta`` is the coefficient of speed fluctuation, ``(omega_max - omega_min) / omega``.

Source: Norton, Design of Machinery (flywheels); Rothbart, Cam Design Handbook (torque of cams).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple, Protocol, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..extrema import raised
from ..motion.resolution import Resolution
from ..quantities import Design, Measure, quantities_of, refuse_population, with_quantities
from ..quantities.applied import applied
from ..quantities.kinds import kind_words, numbers, one_number, shown
from ..quantities.types import Array, Value
from .measures import number

if TYPE_CHECKING:
    from .analysis import CamAnalysis

Of = TypeVar("Of", bound="Turned")
SPEED = "load.speed"
"""Where the speed of a cam stands in its design."""


class Turning(NamedTuple):
    """How the torque on a cam is spread over the turn: numbers, or ``(p,)``; curves have the cam angle last."""

    cam_angle: Array
    """At which the curves show every peak, rad."""
    torque: Array
    """``M``: on the cam without friction, N m."""
    mean: Value
    """What turns the cam all the time, N m."""
    rms: Value
    """Root of the mean of the square, N m: what warms a motor."""
    surplus: Array
    """``A``: work that the torque took above its mean since the first cam angle, J."""
    swing: Value
    """Between the largest and the least ``surplus``, J: what a flywheel has to store."""


class Turned(Protocol):
    """The analysis of a cam that a torque turns, or of a pair of cams."""

    @property
    def cam(self) -> Design: ...
    @property
    def resolved(self) -> Self: ...
    @property
    def resolution(self) -> Resolution: ...
    @property
    def cam_angle(self) -> Array: ...
    @property
    def cam_torque(self) -> Array: ...
    @property
    def turning(self) -> Turning: ...
    @property
    def struck(self) -> Value: ...
    @property
    def curves(self) -> Mapping[str, CamAnalysis]: ...


def turning(analysis: Turned) -> Turning:
    """How the torque on the cam is spread over the turn; without end where the follower is struck."""
    return turning_of(analysis, "cam_torque")


def turning_of(analysis: Turned, name: str) -> Turning:
    """The same of what an analysis calls ``name``, a torque or a power, over the turn."""
    seen, pieces = analysis.resolved, analysis.resolution
    angle, torque = seen.cam_angle, np.where(cam_of(analysis).buildable, getattr(seen, name), np.nan)
    more = np.where(analysis.struck, np.inf, 0.0)
    span = (angle[..., -1:] - angle[..., :1])[..., 0]
    work, square = (running_integral(angle, curve, pieces) for curve in (torque, torque**2))
    mean = work[..., -1] / span
    surplus = work - np.expand_dims(mean, -1) * (angle - angle[..., :1])
    above = torque - np.expand_dims(mean, -1)
    most, least = (top_by_slope(angle, way * surplus, way * above) for way in (1, -1))
    return Turning(angle, torque, mean, np.sqrt(square[..., -1] / span) + more, surplus, most + least + more)


def top_by_slope(angle: Array, values: Array, slope: Array) -> Array:
    """The largest of ``values`` over the ``angle``, the tops between two where their ``slope`` falls through 0."""
    here, there, step = slope[..., :-1], slope[..., 1:], np.diff(angle, axis=-1)
    fall = np.where(here > there, here - there, 1.0)
    before, after = (values[..., k] + step * slope[..., k] ** 2 / (2 * fall) for k in (np.s_[:-1], np.s_[1:]))
    top = np.where((here > 0) & (there < 0), (before * -there + after * here) / fall, -np.inf)
    return np.maximum(values.max(-1), top.max(-1))


def mean_size(analysis: Turned) -> Value:
    """Mean size of the torque on its cam over the turn, N m; straight in a step in which it changes its sign."""
    seen, pieces = analysis.resolved, analysis.resolution
    torque = np.where(cam_of(analysis).buildable, seen.cam_torque, np.nan)
    here, there, steps = torque[..., :-1], torque[..., 1:], np.diff(seen.cam_angle, axis=-1)
    change = np.where(here == there, 1.0, abs(there - here))
    crossed = (here**2 + there**2) / (2 * change) * steps
    work = abs(np.diff(running_integral(seen.cam_angle, torque, pieces), axis=-1))
    return np.where(here * there < 0, crossed, work).sum(-1) / steps.sum(-1)


def cam_of(analysis: Turned) -> CamAnalysis:
    """The analysis of a cam, or of the first of a pair on one shaft."""
    return next(iter(analysis.curves.values()))


def running_integral(angle: Array, values: Array, pieces: Resolution) -> Array:
    """The integral of ``values`` over the ``angle`` from the first one, at each of them: a parabola for each step.

    Inside a piece it is the mean of the parabolas through the point before and the one after the step.
    """
    last = angle.shape[-1] - 1
    before, here, there, after = (np.roll(values, k, axis=-1)[..., :-1] for k in (1, 0, -1, -2))
    ahead, back = (5 * here + 8 * there - after) / 12, (8 * here + 5 * there - before) / 12
    first, final = np.isin(np.arange(last), pieces.first), np.isin(np.arange(1, last + 1), pieces.last)
    across = np.isin(np.arange(last), pieces.last)
    inside = np.where(first, ahead, np.where(final, back, (ahead + back) / 2))
    steps = np.where(across, (here + there) / 2, inside) * np.diff(angle, axis=-1)
    return np.concatenate([0.0 * steps[..., :1], np.cumsum(steps, axis=-1)], axis=-1)


def speed_of(analysis: Turned) -> Value:
    """At which the cam turns, rad/s, one or ``(p, 1)``; ``nan`` of a share of a rated speed that nobody knows."""
    cam = cam_of(analysis)
    return np.where(getattr(cam, "rated", False), np.nan, cam.speed)


# ---------------------------------------------------------------- measures


def flywheel(fluctuation: float) -> Measure:
    """The moment of inertia on the cam's shaft that holds its speed within a coefficient of ``fluctuation``.

    ``I = swing / (delta omega^2)``: with a motor that gives the mean torque all the time, the speed of the cam goes
    from ``(1 - delta / 2) omega`` to ``(1 + delta / 2) omega``.  Without friction; ``nan`` for a cam at rest
    or one whose speed is a share of a rated one.

    >>> from camkit import TranslatingRollerCam
    >>> needed = flywheel(0.02)
    >>> print(f"{needed.name}: {needed.text(needed(TranslatingRollerCam().analyse()))}")
    flywheel for a speed fluctuation of 2 %: 1013 kg cm^2

    Raises ``ValueError`` for a fluctuation that is not above 0 and at most 2, of which the shaft would stand still.
    """
    must = "be a number above 0 and at most 2; for 2 % write 0.02"
    fluctuation = one_number(fluctuation, "the speed fluctuation", must, lambda share: 0 < share <= 2)

    def inertia(analysis: Turned) -> Value:
        speed = number(speed_of(analysis))
        return analysis.turning.swing / (fluctuation * np.where(speed > 0, speed, np.nan) ** 2)

    name = f"flywheel for a speed fluctuation of {100 * fluctuation:.6g} %"
    return Measure(name, "kg cm^2", inertia, made=("flywheel", fluctuation))


# ---------------------------------------------------------------- over speeds


class TorqueSweep(NamedTuple):
    """The torque on one cam at each speed, ``(k,)``, without friction."""

    speed: Array
    """Of the cam, rad/s."""
    peak: Array
    """The largest size, N m."""
    rms: Array
    """Root of the mean of the square, N m."""
    swing: Array
    """Surplus work, J."""


def torque_sweep(analysis: Turned, speeds: ArrayLike) -> TorqueSweep:
    """The torque on a cam, or on that of a cam with an elastic train, at several ``speeds`` (rad/s).

    >>> from camkit import TranslatingRollerCam, rpm
    >>> sweep = torque_sweep(TranslatingRollerCam().analyse(), [300 * rpm, 600 * rpm])
    >>> print(sweep.peak.round(3), sweep.rms.round(3))
    [1.967 2.008] [0.966 0.963]

    Raises ``ValueError`` for speeds that are not finite numbers above 0 in a row, for a population, and for a cam
    whose load has no speed.
    """
    row = numbers(speeds, "the speeds of the cam")
    if row.ndim != 1 or not row.size or not (np.isfinite(row) & (row > 0)).all():
        raise ValueError(f"the speeds of the cam are {shown(speeds)}; they must be finite numbers above 0 in a row")
    refuse_population(analysis, "the cam")
    with applied("the torque over speeds", analysis):
        seen = at_speeds(analysis, row)
        found = seen.turning
    peak = np.where(seen.struck, np.inf, raised(abs(found.torque), seen.resolution.inner).max(-1))
    return TorqueSweep(row, *np.broadcast_arrays(peak, found.rms, found.swing, row)[:3])


def at_speeds(analysis: Of, speeds: Array) -> Of:
    """The analysis of one cam at each of ``speeds``, ``(k,)``: a population of as many."""
    if hasattr(analysis, "at_speeds"):
        found: Of = analysis.at_speeds(speeds)
        return found
    design = analysis.cam
    paths = [path for path in quantities_of(design) if path.endswith(SPEED) or path == "speed"]
    if not paths:
        raise ValueError(f"the {kind_words(type(design))} has no speed at which its load turns; it must have one")
    changed: Of = replace(analysis, cam=with_quantities(design, {paths[0]: speeds[:, None]}))  # type: ignore[type-var]
    return changed
