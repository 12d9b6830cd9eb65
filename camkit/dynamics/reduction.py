"""Parts of a real train as one mass and one spring at the follower.

A part that moves ``i`` times as far as the follower has there the mass ``m i^2`` and the stiffness ``k i^2``; springs
in a row give by the sum of what each gives.  Of a part that turns, ``i`` is its angle over the follower's way, rad/m.

Source: Norton, Cam Design and Manufacturing Handbook (lumped models of cam-follower systems); VDI 2149 part 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..quantities.kinds import a_number, listed, refuse_arguments, refuse_kinds, shown
from ..quantities.markup import table
from ..quantities.types import Value


@dataclass(frozen=True)
class Part:
    """A part of a train: its ``mass`` (kg) or moment of inertia (kg m^2), and its ``stiffness`` (N/m or N m/rad).

    ``ratio`` is its way over that of the follower, 1 where it moves along; of a part that turns, rad/m.  A part without
    a stiffness is rigid.

    >>> rocker = Part("rocker", 2e-4, ratio=1 / 0.04)
    >>> print(f"{rocker.reduced_mass:.3f} kg")
    0.125 kg

    Raises ``ValueError`` for a mass below 0, a stiffness that is not above 0 and a ratio that is 0.
    """

    name: str
    mass: Value = 0.0
    stiffness: Value | None = None
    ratio: Value = 1.0

    def __post_init__(self) -> None:
        refuse_kinds(self)
        mass = a_number(self.mass, f"the mass of the {self.name}", "be at least 0", lambda m: m >= 0)
        ratio = a_number(
            self.ratio, f"the ratio of the {self.name}", "be a finite number other than 0", lambda i: i != 0
        )
        object.__setattr__(self, "mass", mass)
        object.__setattr__(self, "ratio", ratio)
        if self.stiffness is not None:
            what = f"the stiffness of the {self.name}"
            stiffness = a_number(self.stiffness, what, "be a finite number above 0", lambda k: k > 0)
            object.__setattr__(self, "stiffness", stiffness)

    @property
    def reduced_mass(self) -> Value:
        """``m i^2``: at the follower."""
        return self.mass * self.ratio**2

    @property
    def compliance(self) -> Value:
        """``1 / (k i^2)``: at the follower; 0 of a rigid part."""
        return 0.0 if self.stiffness is None else 1 / (self.stiffness * self.ratio**2)


def spring_part(mass: Value, ratio: Value = 1.0, name: str = "return spring") -> Part:
    """A return spring of that ``mass`` (kg), one end of which moves: a third of it.

    >>> print(f"{spring_part(0.06).reduced_mass:.3f} kg")
    0.020 kg
    """
    refuse_arguments(spring_part, locals())
    return Part(name, a_number(mass, f"the mass of the {name}", "be at least 0", lambda m: m >= 0) / 3, None, ratio)


class Reduced(NamedTuple):
    """A train as the follower feels it."""

    mass: Value
    """``sum m_i i^2``, kg, or kg m^2 of an arm."""
    stiffness: Value
    """``1 / k = sum 1 / (k_i i^2)``, N/m, or N m/rad of an arm; ``inf`` where every part is rigid."""
    rows: tuple[tuple[str, Value, Value], ...]
    """Of each part its name, its mass and its share of the compliance."""

    def _repr_html_(self) -> str:
        head = ("part", "mass at the follower [kg, kg m²]", "share of what gives [%]")
        rows = [(name, _cell(mass), _cell(100 * share)) for name, mass, share in self.rows]
        return table(head, rows, f"together {_cell(self.mass)}, {_cell(self.stiffness)} N/m or N m/rad")


def _cell(value: Value) -> str:
    return shown(value) if np.ndim(value) else f"{value:.4g}"


def reduced(parts: Sequence[Part]) -> Reduced:
    """All parts of a train at the follower: one mass and one spring.

    >>> train = reduced([Part("pushrod", 0.05, 8e6), Part("rocker", 2e-4, 4e3, 1 / 0.04), spring_part(0.06)])
    >>> print(f"{train.mass:.3f} kg, {train.stiffness / 1e6:.3f} N/um")
    0.195 kg, 1.905 N/um

    Raises ``ValueError`` for what are no parts, and where there are none.
    """
    each = listed(parts, "the parts of the train", "part")
    if not each or not all(isinstance(part, Part) for part in each):
        raise ValueError(f"the parts of the train are {shown(parts)}; they must be one Part or more")
    give = sum(part.compliance for part in each)
    rigid = all(part.stiffness is None for part in each)
    shares = (part.compliance / give if not rigid else 0.0 for part in each)
    rows = tuple((part.name, part.reduced_mass, share) for part, share in zip(each, shares, strict=True))
    return Reduced(sum(part.reduced_mass for part in each), float("inf") if rigid else 1 / give, rows)
