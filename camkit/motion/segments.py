"""What a motion program is made of: rises, returns and dwells over a cam angle."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np

from ..quantities import Choice, Declared, Quantity, certain, text_if, text_of, unless
from ..quantities.kinds import a_number, finite, kind_words, number, refuse_lengths, shown
from ..quantities.types import Array, Value
from ..units import in_unit
from .families.acceleration import AccelerationTable
from .families.constant_velocity import ConstantVelocity
from .families.free import FreePolynomial
from .families.harmonic import Cycloidal
from .families.mirrored import Mirrored
from .families.modified import ModifiedConstantVelocity
from .families.own import UserLaw
from .families.plain import HALF_LAWS, LAWS
from .families.powers import PowerPolynomial
from .families.shaped import ShapedLaw
from .families.sines import Freudenstein, Gutman, SumOfSines
from .families.skewed import Skewed
from .families.spline import SplineLaw
from .families.to_nose import DoubleHarmonic, EighthOrder
from .law import Kinematics, Kinked, Law

LAW_MENU: tuple[Law, ...] = (
    *LAWS,
    Gutman(),
    Freudenstein(),
    SumOfSines(),
    ShapedLaw(),
    FreePolynomial(),
    PowerPolynomial(),
    SplineLaw((0.25, 0.5, 0.75), (0.1, 0.5, 0.9)),
    AccelerationTable((0, 0.1, 0.375, 0.475, 0.575, 0.9, 1), (0, 1, 1, 0, -1, -1, 0)),
    ConstantVelocity(),
    ModifiedConstantVelocity(),
    Skewed(Cycloidal()),
    DoubleHarmonic(),
    EighthOrder(),
    Mirrored(DoubleHarmonic()),
    Mirrored(EighthOrder()),
    *HALF_LAWS,
)
"""What the law of a segment can be, for a menu."""

ANGLE = Quantity("beta", 90, 10, 240, "deg", "cam angle of the segment")
LIFT = Quantity("h", 1, 0.1, 10, "", "change of the follower's level", at_least=0)
SMALLEST = 1e-150
"""A lift above 0 is no smaller: its square is still a number that one can divide by."""
LAW = Choice("law", Cycloidal(), LAW_MENU, "motion law of the segment")


class Segment(Kinked, Declared, ABC):
    """A part of a program over some cam ``angle`` (rad); paths call it by its ``name``, if it has one."""

    angle: Value
    name: str = ""

    @property
    @abstractmethod
    def change(self) -> Value:
        """What the segment adds to the level."""

    @property
    @abstractmethod
    def still(self) -> bool:
        """Whether the follower rests."""

    @property
    def reach(self) -> tuple[Value, Value]:
        """How far the segment goes below and above its first level."""
        return np.minimum(self.change, 0.0), np.maximum(self.change, 0.0)

    @abstractmethod
    def motion(self, u: Array) -> Kinematics:
        """``s`` from the segment's first level and its derivatives per rad^k, at the share ``u`` of it."""


@dataclass(frozen=True)
class Dwell(Segment):
    """The follower rests over ``angle`` (rad, above 0; a population's has the shape ``(p, 1)``).

    >>> Dwell(0.0)
    Traceback (most recent call last):
        ...
    ValueError: the angle of the dwell is 0 deg; it must be a finite angle above 0 deg
    """

    angle: Value = field(metadata={"declared": ANGLE})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _refuse_name(self)
        _refuse_angle(self)

    @property
    def change(self) -> Value:
        return 0.0

    @property
    def still(self) -> bool:
        return True

    def motion(self, u: Array) -> Kinematics:
        rest = 0.0 * u
        return Kinematics(rest, rest, rest, rest)


@dataclass(frozen=True)
class Move(Segment):
    """A segment that follows a motion law."""

    angle: Value = field(metadata={"declared": ANGLE})
    lift: Value = field(metadata={"declared": LIFT, "by_owner": True})
    law: Law | Callable[[Array], Kinematics] = field(metadata={"declared": LAW})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _refuse_name(self)
        _refuse_angle(self)
        what, other = kind_of(self), "return" if isinstance(self, Rise) else "rise"
        must = f"be 0 or a number of at least {SMALLEST:g} (less than 0 is a {other})"
        lift = a_number(self.lift, f"the lift of the {what}", must, lambda lift: (lift == 0) | (lift >= SMALLEST))
        object.__setattr__(self, "lift", lift)
        object.__setattr__(self, "law", a_law(self.law, what))
        refuse_lengths(self)

    @property
    def still(self) -> bool:
        return certain(self.lift == 0)

    @property
    def kinks(self) -> tuple[Value, ...]:
        return self._law.kinks

    @property
    def _law(self) -> Law:
        """The law; a function of one's own has become one."""
        return cast(Law, self.law)

    @property
    def kinks_move(self) -> bool:
        return self._law.kinks_move or any(map(np.ndim, self.kinks))

    def motion(self, u: Array) -> Kinematics:
        s, v, a, j = self.law(u)
        h, beta = self.change, self.angle
        return Kinematics(h * s, h * v / beta, h * a / beta**2, h * j / beta**3)


@dataclass(frozen=True)
class Rise(Move):
    """The level grows by ``lift`` (m or rad) over ``angle`` (rad, above 0) after the motion law ``law``.

    ``lift`` is 0 or more.  ``angle`` and ``lift`` may be arrays of shape ``(p, 1)``, a population.  ``law`` is a
    motion law, or any function of ``u`` in [0, 1] that gives ``s, v, a, j`` (it becomes a `UserLaw`).  What cannot be
    is refused by ``ValueError``.
    """

    @property
    def change(self) -> Value:
        return self.lift


@dataclass(frozen=True)
class Return(Move):
    """The level falls by ``lift`` over ``angle``; otherwise as ``Rise``.  A program may begin with a return."""

    @property
    def change(self) -> Value:
        return -self.lift


def a_law(law: object, what: str) -> Law:
    """``law``, or a function of one's own as a law; ``ValueError`` in a sentence for anything else."""
    if isinstance(law, Law):
        return law
    if isinstance(law, type) or not callable(law):
        raise ValueError(f"the law of the {what} is {shown(law)}; it must be a motion law such as Cycloidal()")
    return UserLaw(law)


def positive(angle: Value) -> bool:
    """Whether an angle is finite and above 0, element by element."""
    return finite(angle) is not False and finite(angle) & (angle > 0)


def kind_of(segment: Segment) -> str:
    """Rise, return or dwell, as a word."""
    return type(segment).__name__.lower()


def degrees(angle: Value, digits: int = 6) -> str:
    """An angle as a sentence says it."""
    return text_of(in_unit(angle, "deg"), f"~.{digits}g") + text_if(finite(angle), " deg")


def _refuse_name(segment: Any) -> None:
    """``ValueError`` for a name that paths cannot hold, of a segment or what else has one."""
    name = segment.name
    if not isinstance(name, str) or not (name.isidentifier() or name == ""):
        kind = kind_words(type(segment))
        raise ValueError(f"the name of the {kind} is {shown(name)}; it must be made of letters, digits and _")


def _refuse_angle(segment: Segment) -> None:
    angle = number(segment.angle)
    must = "it must be a finite angle above 0 deg"
    if angle is None:
        raise ValueError(f"the angle of the {kind_of(segment)} is {shown(segment.angle)}; {must}")
    if refuse := unless(positive(angle)):
        refuse(f"the angle of the {kind_of(segment)} is {degrees(angle)}; {must}")
    if not certain(positive(angle)):
        angle = np.where(positive(angle), angle, np.nan)
    object.__setattr__(segment, "angle", angle)
