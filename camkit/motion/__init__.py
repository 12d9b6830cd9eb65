"""Motion laws and motion programs: how a follower should move, before there is a cam."""

from .families.constant_velocity import ConstantVelocity
from .families.free import Degree9, FreePolynomial
from .families.half import HalfCycloidalEnd, HalfCycloidalStart, HalfHarmonicEnd, HalfHarmonicStart
from .families.harmonic import Cycloidal, SimpleHarmonic
from .families.modified import ModifiedSine, ModifiedTrapezoid
from .families.polynomial import Parabolic, Poly345, Poly4567, Poly56789
from .families.skewed import Skewed
from .families.spline import SplineLaw, TableLaw
from .law import Kinematics, Law, Peaks
from .program import Dwell, MotionProgram, Return, Rise, Segment, program_between
from .transitions import Peak, ProgramPeaks, Transition
from .vibration import period_ratio, residual_vibration

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
"""The laws that need no parameter, for a menu."""

HALF_LAWS: tuple[Law, ...] = (HalfCycloidalStart(), HalfCycloidalEnd(), HalfHarmonicStart(), HalfHarmonicEnd())
"""The laws between rest and a velocity, for a program that joins them to constant velocity."""

__all__ = [
    "HALF_LAWS",
    "LAWS",
    "ConstantVelocity",
    "Cycloidal",
    "Degree9",
    "Dwell",
    "FreePolynomial",
    "HalfCycloidalEnd",
    "HalfCycloidalStart",
    "HalfHarmonicEnd",
    "HalfHarmonicStart",
    "Kinematics",
    "Law",
    "ModifiedSine",
    "ModifiedTrapezoid",
    "MotionProgram",
    "Parabolic",
    "Peak",
    "Peaks",
    "Poly345",
    "Poly4567",
    "Poly56789",
    "ProgramPeaks",
    "Return",
    "Rise",
    "Segment",
    "SimpleHarmonic",
    "Skewed",
    "SplineLaw",
    "TableLaw",
    "Transition",
    "period_ratio",
    "program_between",
    "residual_vibration",
]
