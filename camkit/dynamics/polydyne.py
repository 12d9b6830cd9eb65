"""Cams that are made for an elastic train: its end moves as is wanted at one speed of the cam.

The wanted motion ``y`` of the last mass asks at the design speed ``omega`` for the motion ``s`` of the cam by

    k_f s + c_f omega s' = m omega^2 y'' + (c_s + c_f) omega y' + (k_s + k_f) y

so that of a train without damping ``s = y (1 + k_s / k_f) + m omega^2 y'' / k_f``.  Both sides are Chebyshev series
over each smooth piece of the motion; the equation of first order is solved piece by piece, and around the turn.  The
derivative of order ``k`` of ``s`` is continuous where that of order ``k + 2`` of ``y`` is: laws such as 5-6-7-8-9.

Source: Dudley, New methods in valve cam design; Stoddart, Polydyne cam design; Rothbart, Cam Design Handbook.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, reduce
from itertools import pairwise
from typing import Any, Self

import numpy as np
from numpy.polynomial import chebyshev

from ..motion import FormError, Kinematics, MotionProgram, Transition
from ..motion.closing import TURN
from ..motion.form import Formed
from ..motion.program import SAME_JOINT
from ..motion.resolution import Resolution
from ..motion.transitions import SMOOTH
from ..quantities import certain, known, quantity, unless
from ..quantities.applied import applied
from ..quantities.kinds import a_number, finite, refuse_arguments
from ..quantities.types import Array, Value
from .steady import a_speed
from .trains import Train

DEGREE = 32
"""Of the series of a piece."""
NEGLIGIBLE = 1e-15
"""Of a train's mass."""


@dataclass(frozen=True)
class PolydyneProgram(MotionProgram):
    """The motion of a cam whose train moves after ``segments`` at the ``design_speed`` (see `polydyne`).

    Its segments are those of the wanted motion, which keep their paths; what is called with cam angles, and so every
    analysis of a cam, is what the cam has to do.  So are its `transitions`.
    """

    design_speed: Value = quantity("omega_d", 600, 10, 6000, "rpm", "at which the end of the train moves as wanted")
    mass: Value = field(default=1.0)
    """``m``: of the end of the train, kg or kg m^2."""
    stiffness: Value = field(default=1e6)
    """``k_f``, N/m or N m/rad."""
    damping: Value = field(default=0.0)
    """``c_f``, N s/m or N m s/rad."""
    rate: Value = field(default=0.0)
    """``k_s`` of the return spring."""
    ground_damping: Value = field(default=0.0)
    """``c_s``."""

    def __post_init__(self) -> None:
        for name in ("mass", "stiffness"):
            must = "be a finite number above 0"
            given = a_number(getattr(self, name), f"the {name} of the train", must, lambda x: x > 0)
            object.__setattr__(self, name, given)
        for name in ("damping", "rate", "ground_damping"):
            what, must = f"the {name.replace('_', ' ')} of the train", "be a finite number of at least 0"
            object.__setattr__(self, name, a_number(getattr(self, name), what, must, lambda x: x >= 0))
        object.__setattr__(self, "design_speed", a_speed(self.design_speed))
        super().__post_init__()
        if refuse := unless(self.periodic):
            refuse("a polydyne cam needs a motion over a full turn of 360 deg")
        if refuse := unless(self.comes_back):
            refuse("a polydyne cam needs a motion that comes back to where it began")
        self._refuse_members()

    def _refuse_members(self) -> None:
        """Members of a population whose train, speed or motion cannot be begin nowhere: their rows are ``nan``."""
        given = self.mass, self.stiffness, self.damping, self.rate, self.ground_damping, self.design_speed
        ok = reduce(np.logical_and, [finite(x) for x in given], self.periodic & self.comes_back)
        if not certain(ok):
            object.__setattr__(self, "start", np.where(ok, self.start, np.nan))

    @property
    def lag(self) -> Value:
        """``c_f omega / k_f``: the angle over which the train's damper answers, rad."""
        return self.damping * self.design_speed / self.stiffness

    @cached_property
    def _pieces(self) -> list[_Piece]:
        """What the cam does in each smooth piece, in order."""
        pieces = []
        for i, segment in enumerate(self.segments):
            start, end = self.starts[i], self.starts[i + 1]
            for low, high in pairwise((0.0, *segment.kinks, 1.0)):
                begin, width = start + low * (end - start), (high - low) * (end - start)
                series = self._wanted(i, low, high)
                if not certain(self.damping == 0):
                    series = _settled(series, self.lag / width)
                pieces.append(_Piece(begin, width, series, np.zeros(1), self.lag))
        return pieces if certain(self.damping == 0) else _joined(pieces)

    def _wanted(self, i: int, low: Value, high: Value) -> Series:
        """The series of the right side over ``k_f``, between two shares of a segment."""
        u = low + (high - low) * (1 + NODES) / 2
        s, v, a, _ = self._moved(i, u)
        k, w = self.stiffness, self.design_speed
        c = self.ground_damping + self.damping
        asked = s * (1 + self.rate / k) + v * c * w / k + a * self.mass * w**2 / k + 0.0 * u
        factors = asked @ TO_SERIES if known(asked) else (asked[..., None] * TO_SERIES).sum(-2)
        return [factors[..., n : n + 1] for n in range(DEGREE + 1)]

    @property
    def wanted(self) -> MotionProgram:
        """The motion of the train's end: what the cam would do with a rigid train."""
        return MotionProgram(self.segments, self.start, advance=self.advance)

    @property
    def plain(self) -> Self:
        """What the cam would do for a train without mass and damping: ``s = y (1 + k_s / k_f)``."""
        return self.replace(mass=NEGLIGIBLE * self.mass, damping=0.0, ground_damping=0.0)

    def with_form(self, form: FormError) -> FormedPolydyneProgram:
        """What a profile with an error of form does."""
        given = {f.name: getattr(self, f.name) for f in fields(PolydyneProgram)}
        return FormedPolydyneProgram(**given, form=form)

    def over(self, shown: Resolution) -> Kinematics:
        """``s, v, a, j`` at the cam angles of a resolution."""
        return self._at(shown.angle)

    def _at(self, x: Array) -> Kinematics:
        first, *others = self._pieces
        motion = first.at(x)
        for piece in others:
            pairs = zip(piece.at(x), motion, strict=True)
            motion = Kinematics(*(np.where(x >= piece.begin - SAME_JOINT, *pair) for pair in pairs))
        return self._if_possible(*motion)

    def changed(self, changes: Mapping[str, object]) -> Self:
        """With other segments by name, and for another speed."""
        wanted = super().changed(changes)
        speed = changes.get("design_speed", self.design_speed)
        return self.replace(segments=wanted.segments, start=wanted.start, design_speed=speed)

    def transitions(self) -> list[Transition]:
        """A record for each joint of what the cam does, kinks inside the laws among them; the turn's own joint last."""
        if np.ndim(self.possible):
            raise ValueError("the program is a population; joints are named for one program at a time")
        pieces = self._pieces
        after = [*pieces[1:], pieces[0]]
        sides = [(one.at(_end(one)), other.at(_begin(other))) for one, other in zip(pieces, after, strict=True)]
        shown = [piece.at(_along(piece)) for piece in pieces]
        scales = [max(float(abs(motion[k]).max()) for motion in shown) for k in range(4)]
        angles = [*(float(np.ravel(piece.begin)[0]) for piece in pieces[1:]), TURN]
        return [_transition(angle, *pair, scales) for angle, pair in zip(angles, sides, strict=True)]


@dataclass(frozen=True)
class FormedPolydyneProgram(Formed, PolydyneProgram):
    """A polydyne motion as a profile with an error of ``form`` gives it."""

    form: FormError = field(default_factory=FormError)


def _transition(angle: float, before: Kinematics, after: Kinematics, scales: list[float]) -> Transition:
    jumps = [float((y - x)[0]) for x, y in zip(before, after, strict=True)]
    broken = [abs(jump) > SMOOTH * scale for jump, scale in zip(jumps, scales, strict=True)]
    s, v, a, j = jumps
    return Transition(angle, s, v, a, j, broken.index(True) if any(broken) else None)


def _begin(piece: _Piece) -> Array:
    return np.atleast_1d(piece.begin + 0.0 * piece.width)


def _end(piece: _Piece) -> Array:
    return np.atleast_1d(piece.begin + piece.width)


def _along(piece: _Piece) -> Array:
    return np.atleast_1d(piece.begin + piece.width * np.linspace(0, 1, 65))


NODES = chebyshev.chebpts1(DEGREE + 1)
TO_SERIES = np.linalg.inv(chebyshev.chebvander(NODES, DEGREE)).T
"""From values at the nodes to the factors of Chebyshev's polynomials."""
Series = list[Array]
"""The factors of Chebyshev's polynomials, each a number ``(1,)`` or a column ``(p, 1)``."""


@dataclass(frozen=True)
class _Piece:
    """``s`` over a smooth piece: a series in the share of it, and what fades from its beginning."""

    begin: Value
    width: Value
    series: Series
    fading: Array
    lag: Value

    def at(self, x: Array) -> Kinematics:
        u = np.minimum(np.maximum(2 * (x - self.begin) / self.width - 1, -1.0), 1.0)
        found, series = [], self.series
        for k in range(4):
            found.append(_summed(series, u) * (2 / self.width) ** k + self._fades(x, k))
            series = _derived(series)
        return Kinematics(*found)

    def _fades(self, x: Array, k: int) -> Value:
        if certain(self.lag == 0):
            return 0.0
        late, lag = np.maximum(x - self.begin, 0.0), np.where(self.lag > 0, self.lag, 1.0)
        return np.where(self.lag > 0, self.fading * np.exp(-late / lag) * (-1 / lag) ** k, 0.0)


def _summed(series: Series, u: Array) -> Array:
    """A series at ``u``, by Clenshaw's rule."""
    first, second = 0.0 * u, 0.0 * u
    for factor in series[:0:-1]:
        first, second = factor + 2 * u * first - second, first
    return series[0] + u * first - second


def _derived(series: Series) -> Series:
    """The series of the derivative: ``d_(n-1) = d_(n+1) + 2 n s_n``, and half of it at 0."""
    found: Series = [0.0 * series[0]] * 2
    for n in range(len(series) - 1, 0, -1):
        found.insert(0, found[1] + 2 * n * series[n])
    return [found[0] / 2, *found[1:-1]]


def _settled(wanted: Series, share: Value) -> Series:
    """The series ``s`` with ``s + lag s' = wanted``, ``share`` being the lag over the width of the piece.

    From the last factor to the first, as the derivative's depend on later ones alone.
    """
    found: Series = [wanted[-1]]
    slopes: Series = [0.0 * wanted[-1]] * 2
    for n in range(len(wanted) - 2, -1, -1):
        slopes.insert(0, slopes[1] + 2 * (n + 1) * found[0])
        found.insert(0, wanted[n] - 2 * share * slopes[0] / (1 if n else 2))
    return found


def _joined(pieces: list[_Piece]) -> list[_Piece]:
    """The same with what fades from each joint, so that ``s`` is continuous there and around the turn."""
    lag = np.where(pieces[0].lag > 0, pieces[0].lag, 1.0)
    before = [pieces[-1], *pieces[:-1]]
    jumps = [old.at(_end(old)).s - new.at(_begin(new)).s for old, new in zip(before, pieces, strict=True)]
    carried = _faded(pieces, jumps, lag, 0.0 * jumps[0])[-1] / (1 - np.exp(-TURN / lag))
    fading = _faded(pieces, jumps, lag, carried)
    return [replace(piece, fading=first) for piece, first in zip(pieces, fading, strict=False)]


def _faded(pieces: list[_Piece], jumps: list[Array], lag: Array, carried: Array) -> list[Array]:
    """What fades from the beginning of each piece, and what is left of it at the end of the last."""
    found = []
    for piece, jump in zip(pieces, jumps, strict=True):
        found.append(carried + jump)
        carried = found[-1] * np.exp(-piece.width / lag)
    return [*found, carried]


def polydyne(motion: MotionProgram, train: Train, load: Any, speed: Value) -> PolydyneProgram:
    """The motion of a cam, turning at ``speed`` (rad/s), behind whose ``train`` the load moves after ``motion``.

    ``load`` is that of a sliding follower, or the analysis of any cam that has it; it may have a spring with its
    preload and a constant force.  The result goes into every cam in place of its motion.

    >>> from camkit import Dwell, MotionProgram, Return, Rise, SlideLoad, deg, mm, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> from camkit.motion import Poly56789
    >>> up, down = Rise(120 * deg, 20 * mm, Poly56789()), Return(120 * deg, 20 * mm, Poly56789())
    >>> wanted = MotionProgram((up, Dwell(60 * deg), down, Dwell(60 * deg)))
    >>> cam = polydyne(wanted, ElasticTrain(8e5, 0), SlideLoad(mass=2, spring_rate=5e3), 600 * rpm)
    >>> print(f"{cam(150 * deg).s / mm:.3f} mm")
    20.125 mm

    Raises ``ValueError`` for a motion that is shorter than a turn, a train of several masses or with a spring that
    surges, and a load that depends on more than the travel.
    """
    refuse_arguments(polydyne, locals())
    if len(train.springs) != 1 or train.spring.name != "without mass":
        raise ValueError(
            "a polydyne cam is made for a train of one mass behind one spring, with a return spring that does not surge"
        )
    with applied("a polydyne cam", load):
        rocks = hasattr(load, "closing_rate")
        mass, rate = (load.inertia, load.closing_rate) if rocks else (load.mass, load.spring_rate)
        _refuse_load(load.cam.load if rocks else load)
    mass, rate = (_number(x) for x in (mass, rate))
    ((stiffness, damping),) = train.springs
    return PolydyneProgram(
        motion.segments,
        motion.start,
        a_speed(speed),
        mass - train.cam_side_mass,
        stiffness,
        damping,
        rate,
        train.ground_damping + getattr(load, "damping", 0.0),
        advance=motion.advance,
    )


def _number(value: Value) -> Value:
    """A number, or a column, of what an analysis may have along the turn."""
    several = np.atleast_1d(value)
    return float(several[0]) if several.ndim == 1 else several[..., :1]


def _refuse_load(load: object) -> None:
    """``ValueError`` for a load that is more than a spring and a constant."""
    tables = any(len(getattr(load, name, ())) for name in ("cam_angle_table", "travel_table"))
    if tables or (hasattr(load, "torque_table") and np.any(getattr(load, "gravity", 0.0))):
        raise ValueError(
            "the load has a table, or a weight on an arm; a polydyne cam is made for a spring, its preload and a "
            "constant"
        )
