"""Motion laws and motion programs: how a follower should move, before there is a cam."""

from .card import cam_card
from .controller import controller_error, controller_rows
from .families.acceleration import AccelerationTable
from .families.constant_velocity import ConstantVelocity
from .families.free import Degree9, FreePolynomial
from .families.half import HalfCycloidalEnd, HalfCycloidalStart, HalfHarmonicEnd, HalfHarmonicStart
from .families.harmonic import Cycloidal, SimpleHarmonic
from .families.mirrored import Mirrored
from .families.modified import ModifiedConstantVelocity, ModifiedSine, ModifiedTrapezoid
from .families.own import UserLaw
from .families.plain import HALF_LAWS, LAWS
from .families.polynomial import Parabolic, Poly345, Poly4567, Poly56789
from .families.powers import PowerPolynomial
from .families.shaped import DEGREE9, SPLINE, ShapedLaw
from .families.sines import Freudenstein, Gutman, SumOfSines
from .families.skewed import Skewed
from .families.spline import SplineLaw, TableLaw
from .families.to_nose import DoubleHarmonic, EighthOrder
from .form import FormedMatchedProgram, FormedProgram, FormError
from .held import motion_in
from .law import Kinematics, Law, Peaks
from .lobe import lobe_by_acceleration
from .made_smooth import matched
from .matched import MatchedProgram
from .overshoot import Overshoot
from .parts import Boundary, OpenMove, Part, Polynomial, Through, Uniform
from .program import MotionProgram
from .segments import LAW_MENU, Dwell, Return, Rise, Segment
from .table import TableMotion, motion_from_table
from .transitions import ProgramPeaks, Transition
from .vibration import residual_vibration

__all__ = [
    "DEGREE9",
    "HALF_LAWS",
    "LAWS",
    "LAW_MENU",
    "SPLINE",
    "AccelerationTable",
    "Boundary",
    "ConstantVelocity",
    "Cycloidal",
    "Degree9",
    "DoubleHarmonic",
    "Dwell",
    "EighthOrder",
    "FormError",
    "FormedMatchedProgram",
    "FormedProgram",
    "FreePolynomial",
    "Freudenstein",
    "Gutman",
    "HalfCycloidalEnd",
    "HalfCycloidalStart",
    "HalfHarmonicEnd",
    "HalfHarmonicStart",
    "Kinematics",
    "Law",
    "MatchedProgram",
    "Mirrored",
    "ModifiedConstantVelocity",
    "ModifiedSine",
    "ModifiedTrapezoid",
    "MotionProgram",
    "OpenMove",
    "Overshoot",
    "Parabolic",
    "Part",
    "Peaks",
    "Poly345",
    "Poly4567",
    "Poly56789",
    "Polynomial",
    "PowerPolynomial",
    "ProgramPeaks",
    "Return",
    "Rise",
    "Segment",
    "ShapedLaw",
    "SimpleHarmonic",
    "Skewed",
    "SplineLaw",
    "SumOfSines",
    "TableLaw",
    "TableMotion",
    "Through",
    "Transition",
    "Uniform",
    "UserLaw",
    "cam_card",
    "controller_error",
    "controller_rows",
    "lobe_by_acceleration",
    "matched",
    "motion_from_table",
    "motion_in",
    "residual_vibration",
]
