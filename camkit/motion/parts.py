"""What a matched program is made of, beside segments: parts that follow from their ends, and conditions.

Source: VDI 2143 part 1 (motions with given ends); Norton, Cam Design and Manufacturing Handbook (polynomial functions,
spline functions).
"""

from __future__ import annotations

from abc import ABC
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..quantities import Choice, Declared, Quantity, certain, unless
from ..quantities.kinds import a_number, kind_words, listed, number, refuse_kinds, refuse_lengths, shown
from ..quantities.types import Array, Value
from .families.free import LETTERS
from .law import Kinematics, Law
from .segments import ANGLE, LAW, _refuse_name, a_law, degrees, positive

SHARE = Quantity("u", 0.5, 0.02, 0.98, "", "share of the part at which it holds", at_most=1)
WITHIN = Quantity("phi", 45, 1, 240, "deg", "cam angle from the start of the part at which it holds")
VELOCITY = Quantity("v", 1, -10, 10, "", "change of the follower's level per radian of the cam", above=None)
TRAVEL = Quantity("h", 1, -10, 10, "", "change of the follower's level", above=None)
GIVEN = tuple(
    Quantity(letter, 0, -size, size, "", f"the follower's {name} there", above=None, name=name)
    for letter, name, size in zip(
        LETTERS, ("level", "velocity", "acceleration", "jerk"), (10, 40, 200, 1200), strict=True
    )
)
"""``s, v, a, j`` as a condition gives them, per rad^k."""
FORM = Choice("form", "polynomial", {"polynomial": "polynomial", "spline": "spline"}, "of a part with conditions in it")
MATCH, FREE = "match", "free"
MOST_POINTS, MOST_VALUES = 12, 8
"""Conditions inside one part."""
Wanted = Value | str
"""A number that both sides have, ``match`` or ``free``."""


def per_radian(unit: str, most: float) -> dict[str, Quantity]:
    """Declarations of what parts and conditions hold, for a follower whose level is in ``unit``."""
    per = ("", "/rad", "/rad^2", "/rad^3")
    units = [unit + one if unit else "" for one in per]
    sizes = (most, 4 * most, 20 * most, 120 * most)
    given = zip(GIVEN, sizes, units, strict=True)
    made = {
        q.symbol: Quantity(q.symbol, 0, -size, size, in_unit, q.meaning, above=None, name=q.name)
        for q, size, in_unit in given
    }
    velocity = Quantity("v", most / 4, -4 * most, 4 * most, units[1], VELOCITY.meaning, above=None)
    return made | {
        "velocity": velocity,
        "travel": Quantity("h", most / 4, -most, most, unit, TRAVEL.meaning, above=None),
    }


class _Some(Declared):
    """What holds numbers of which some are left open: those are no quantities."""

    open_because = "it is left open"

    def _check_given(self, what: str, *names: str) -> None:
        """Refuse a given number that is none."""
        for name in names:
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, a_number(value, f"the {name} of {what}"))

    def following(self) -> dict[str, str]:
        """The numbers that are left open, and why they are no quantities."""
        fields = [name for name in self.__dataclass_fields__ if "declared" in self.__dataclass_fields__[name].metadata]
        return {name: self.open_because for name in fields if getattr(self, name) is None}


@dataclass(frozen=True)
class Boundary(_Some):
    """What holds at a transition: for each of ``s, v, a, j`` a number, ``"match"`` or ``"free"``.

    A number (m or rad, per rad^k) is what both sides have; ``"match"``: they have the same; ``"free"``: it may jump.
    Numbers may be columns ``(p, 1)``.  ``ValueError`` for anything else.

    >>> Boundary(s=0.02, v=0.0).v, Boundary().a, Boundary().j
    (0.0, 'match', 'free')
    """

    s: Wanted = field(default=MATCH, metadata={"declared": GIVEN[0], "by_owner": True})
    v: Wanted = field(default=MATCH, metadata={"declared": GIVEN[1], "by_owner": True})
    a: Wanted = field(default=MATCH, metadata={"declared": GIVEN[2], "by_owner": True})
    j: Wanted = field(default=FREE, metadata={"declared": GIVEN[3], "by_owner": True})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _refuse_name(self)
        for letter in LETTERS:
            value = getattr(self, letter)
            if not (isinstance(value, str) and value in (MATCH, FREE)):
                must = "be a finite number, 'match' or 'free'"
                object.__setattr__(self, letter, a_number(value, f"the {letter} of a boundary", must))
        refuse_lengths(self)

    def following(self) -> dict[str, str]:
        """What is matched or free."""
        held = {letter: getattr(self, letter) for letter in LETTERS}
        return {letter: f"it is set to {shown(value)}" for letter, value in held.items() if isinstance(value, str)}


@dataclass(frozen=True)
class Through(_Some):
    """What a `Polynomial` goes through: ``s, v, a`` (m or rad, per rad^k) at a place inside it, those that are given.

    The place is a ``share`` of its angle, above 0 and below 1, or an ``angle`` (rad) from its start.

    >>> Through(0.5, s=0.02).s, Through(angle=0.7, v=0.0).share
    (0.02, None)
    """

    share: Value | None = field(default=None, metadata={"declared": SHARE})
    angle: Value | None = field(default=None, metadata={"declared": WITHIN}, kw_only=True)
    s: Value | None = field(default=None, metadata={"declared": GIVEN[0], "by_owner": True}, kw_only=True)
    v: Value | None = field(default=None, metadata={"declared": GIVEN[1], "by_owner": True}, kw_only=True)
    a: Value | None = field(default=None, metadata={"declared": GIVEN[2], "by_owner": True}, kw_only=True)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _refuse_name(self)
        self._check_given("a condition inside a part", "share", "angle", "s", "v", "a")
        if (self.share is None) == (self.angle is None):
            raise ValueError("a condition inside a part has a share or an angle, one of them, at which it holds")
        if not self.given:
            raise ValueError("a condition inside a part gives nothing; it must give s, v or a")
        refuse_lengths(self)

    @property
    def given(self) -> dict[int, Value]:
        """What is given, by its order."""
        return {k: value for k, value in enumerate((self.s, self.v, self.a)) if value is not None}

    def place(self, angle: Value) -> Any:
        """Its share of a part that takes ``angle``."""
        return self.share if self.angle is None else self.angle / angle


class Part(_Some, ABC):
    """A part of a matched program whose motion follows from what holds at its ends."""

    angle: Value | None
    name: str = ""
    open_because = "it follows from the others"

    def taken(self) -> Value | None:
        """The cam angle that it takes, rad; ``None``: the rest of the turn."""
        return self.angle

    def _check_angle(self) -> None:
        _refuse_name(self)
        if self.angle is not None:
            object.__setattr__(self, "angle", an_angle(self.angle, f"the angle of the {kind_words(type(self))}"))


@dataclass(frozen=True)
class Polynomial(Part):
    """A polynomial over ``angle`` (rad; ``None``: the rest of the turn) whose form follows from its conditions.

    Between its ends and the points it goes ``through`` the integral of its third derivative squared is the least
    possible (of the fourth, where a jerk is given or matched).  With points inside it is one polynomial of the least
    degree through all, or, with the ``form`` ``"spline"``, several that join as smoothly as they can.

    >>> Polynomial(1.5, (Through(0.5, s=0.02),), "spline").form
    'spline'
    """

    angle: Value | None = field(default=None, metadata={"declared": ANGLE})
    through: tuple[Through, ...] = field(default=(), metadata={"most": MOST_POINTS})
    form: str = field(default="polynomial", metadata={"declared": FORM})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        self._check_angle()
        object.__setattr__(self, "through", listed(self.through, "what the polynomial goes through", "condition"))
        if len(self.through) > MOST_POINTS:
            raise ValueError(f"the polynomial goes through {len(self.through)} points; there can be {MOST_POINTS}")
        refuse_kinds(self, ("angle", "form"))
        if not FORM.allows(self.form):
            raise ValueError(f"the form of the polynomial is {shown(self.form)}; it must be {FORM.possible}")
        values = sum(len(point.given) for point in self.through)
        if self.form == "polynomial" and values > MOST_VALUES:
            raise ValueError(
                f"one polynomial is to meet {values} values inside; beyond {MOST_VALUES} it loses digits: "
                "form='spline' meets them"
            )
        refuse_names(self.point_names, "a point of the polynomial", ("angle", "through", "form"))
        refuse_lengths(self)

    @property
    def point_names(self) -> tuple[str, ...]:
        """What paths call the points: by their own names, or ``point1``, ``point2``."""
        return tuple(point.name or f"point{i}" for i, point in enumerate(self.through, start=1))

    def following(self) -> dict[str, str]:
        """The angle, if it is the rest of the turn, and the form where there are no points."""
        return super().following() | ({} if self.through else {"form": "it matters with points inside alone"})

    def branches(self) -> Mapping[str, Declared]:
        """The points by name."""
        return dict(zip(self.point_names, self.through, strict=True))

    def changed(self, changes: Mapping[str, Any]) -> Polynomial:
        """With other points by name."""
        points = tuple(changes.get(n, point) for n, point in self.branches().items())
        fields = {name: value for name, value in changes.items() if name not in self.point_names}
        return self.replace(**{"through": points, **fields})


@dataclass(frozen=True)
class Uniform(Part):
    """Constant ``velocity`` (m or rad, per rad) over a ``travel`` (m or rad) or over an ``angle`` (rad).

    Two of the three are given and the third follows; or the angle alone, and the velocity follows from the conditions.

    >>> from camkit.units import deg, inch, rpm
    >>> belt = Uniform(22 * inch / (58 * rpm), 1.1 * inch)
    >>> print(f"{belt.taken() / deg:.4f} deg")
    17.4000 deg
    """

    velocity: Value | None = field(default=None, metadata={"declared": VELOCITY, "by_owner": True})
    travel: Value | None = field(default=None, metadata={"declared": TRAVEL, "by_owner": True})
    angle: Value | None = field(default=None, metadata={"declared": ANGLE})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        self._check_angle()
        self._check_given("the stretch at constant velocity", "velocity", "travel")
        if not any(value is None for value in (self.velocity, self.travel, self.angle)):
            raise ValueError("the stretch at constant velocity has a velocity, a travel and an angle; give two of them")
        refuse_lengths(self)
        if self.velocity is not None and self.travel is not None:
            self._refuse_backwards(self.travel / np.where(self.velocity == 0, np.nan, self.velocity))

    def _refuse_backwards(self, angle: Value) -> None:
        if refuse := unless(positive(angle)):
            refuse(
                f"at {self.velocity:.6g} per rad a travel of {self.travel:.6g} (follower units) takes "
                f"{degrees(angle)}; it must take a finite angle above 0 deg"
            )

    def taken(self) -> Value | None:
        """The cam angle that it takes, rad."""
        if self.angle is not None or self.velocity is None or self.travel is None:
            return self.angle
        angle = self.travel / np.where(self.velocity == 0, np.nan, self.velocity)
        return angle if certain(positive(angle)) else np.where(positive(angle), angle, np.nan)

    def speed(self, angle: Value) -> Value | None:
        """The velocity if it takes ``angle``; ``None`` where it follows from the conditions."""
        if self.velocity is not None or self.travel is None:
            return self.velocity
        return self.travel / angle


@dataclass(frozen=True)
class OpenMove(Part):
    """A motion ``law`` over ``angle`` (rad) whose lift, up or down, follows from the conditions.

    >>> from camkit.motion import Cycloidal
    >>> OpenMove(1.0, Cycloidal()).law.name
    'cycloidal'
    """

    angle: Value | None = field(metadata={"declared": ANGLE})
    law: Law | Callable[[Array], Kinematics] = field(metadata={"declared": LAW})
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        self._check_angle()
        object.__setattr__(self, "law", a_law(self.law, "open move"))
        refuse_lengths(self)


def an_angle(value: object, what: str) -> Value:
    """An angle above 0 (rad), or a column; ``ValueError`` in a sentence for anything else."""
    read = number(value)
    must = "it must be a finite angle above 0 deg"
    if read is None:
        raise ValueError(f"{what} is {shown(value)}; {must}")
    if refuse := unless(positive(read)):
        refuse(f"{what} is {degrees(read)}; {must}")
    return read if certain(positive(read)) else np.where(positive(read), read, np.nan)


def refuse_names(names: Sequence[str], what: str, taken: Sequence[str]) -> None:
    """``ValueError`` in a sentence for a name that several have, or that is ``taken``."""
    for name in names:
        if names.count(name) > 1 or name in taken:
            raise ValueError(f"{what} is called {name}; it must have a name that nothing else has")
