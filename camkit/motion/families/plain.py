"""Laws that need no parameter, for menus."""

from ..law import Law
from .half import HalfCycloidalEnd, HalfCycloidalStart, HalfHarmonicEnd, HalfHarmonicStart
from .harmonic import Cycloidal, SimpleHarmonic
from .modified import ModifiedSine, ModifiedTrapezoid
from .polynomial import Parabolic, Poly345, Poly4567, Poly56789

LAWS: tuple[Law, ...] = (
    SimpleHarmonic(),
    Parabolic(),
    Cycloidal(),
    ModifiedTrapezoid(),
    ModifiedSine(),
    Poly345(),
    Poly4567(),
    Poly56789(),
)
"""The classical laws from dwell to dwell that need no parameter, for a menu and to be compared."""

HALF_LAWS: tuple[Law, ...] = (HalfCycloidalStart(), HalfCycloidalEnd(), HalfHarmonicStart(), HalfHarmonicEnd())
"""The laws between rest and a velocity, for a program that joins them to constant velocity."""
