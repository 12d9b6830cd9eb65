"""A law that runs from its end to its beginning."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...quantities import Choice
from ...quantities.kinds import shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks
from .powers import PowerPolynomial
from .to_nose import DoubleHarmonic, EighthOrder

MENU = (DoubleHarmonic(), EighthOrder(), PowerPolynomial())


@dataclass(frozen=True)
class Mirrored(Law):
    """The mirror image of a law ``S``: ``s(u) = 1 - S(1 - u)``.

    A symmetric law is its own.  A law that ends at a nose, such as `DoubleHarmonic`, has the one that begins there:
    the law of the return that follows it.

    >>> Mirrored(DoubleHarmonic())(0.0).a.round(6)
    np.float64(9.869604)
    >>> Mirrored("double harmonic")
    Traceback (most recent call last):
        ...
    ValueError: the law to be mirrored is 'double harmonic'; it must be a motion law such as Cycloidal()
    """

    law: Law = field(
        default=DoubleHarmonic(), metadata={"declared": Choice("S", DoubleHarmonic(), MENU, "law that is mirrored")}
    )

    def __post_init__(self) -> None:
        if not isinstance(self.law, Law):
            given = shown(self.law)
            raise ValueError(f"the law to be mirrored is {given}; it must be a motion law such as Cycloidal()")

    @property
    def name(self) -> str:
        return f"{self.law.name}, mirrored"

    @property
    def continuity(self) -> int:
        return self.law.continuity

    @property
    def kinks_move(self) -> bool:
        return self.law.kinks_move

    @property
    def kinks(self) -> tuple[Value, ...]:
        return tuple(1 - x for x in reversed(self.law.kinks))

    def at(self, u: Array) -> Kinematics:
        s, v, a, j = self.law.at(1 - u)
        return Kinematics(1 - s, v, -a, j)

    def peaks(self) -> Peaks:
        return self.law.peaks()
