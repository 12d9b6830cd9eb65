"""Every public constructor and function, every argument, all kinds of bad values: it works or says in words why not.

Nothing else may come of it: no other exception, no warning of numpy.
"""

import dataclasses
import inspect
import re
import warnings
from decimal import Decimal
from fractions import Fraction
from functools import reduce
from importlib import import_module

import numpy as np
import pytest

import camkit
from camkit import (
    RSSR,
    Cycloidal,
    Decision,
    DesignMap,
    Dwell,
    Front,
    Judgements,
    Measure,
    MotionProgram,
    PeakMeasure,
    Return,
    Rise,
    Session,
    Study,
    Sweep,
    Tolerances,
    TranslatingRollerCam,
    UniversalJointShaft,
)
from camkit.decision import Judges, random_index
from camkit.linkage import Box
from camkit.machines import CamLever, SliderLoad, cam_lever_study
from camkit.machines.high_speed_measures import peak_stress
from camkit.machines.shaft import shaft_study
from camkit.motion import (
    AccelerationTable,
    DoubleHarmonic,
    FreePolynomial,
    Mirrored,
    ModifiedSine,
    OpenMove,
    Skewed,
    SplineLaw,
    TableLaw,
    UserLaw,
)
from camkit.quantities import Choice, LeastMeasure, Quantity, UnitRemark
from camkit.search.epsilon_constraint import epsilon_constraint_steps
from camkit.search.front import dominated, front_of
from camkit.study import AnalysisCurve, RobustStudy, Source, SumOfResiduals, Tolerance

ITSELF: list = []
ITSELF.append(ITSELF)
NESTED = reduce(lambda inner, _: [inner], range(40), 1.0)

BAD = {
    "nan": np.nan,
    "inf": np.inf,
    "-inf": -np.inf,
    "-1": -1,
    "0": 0,
    "2.5": 2.5,
    "1e12": 1e12,
    "1e160": 1e160,
    "-1e300": -1e300,
    "10**400": 10**400,
    "10**5000": 10**5000,
    "True": True,
    "None": None,
    "text": "abc",
    "no text": "",
    "bytes": b"abc",
    "complex": 1 + 2j,
    "no list": [],
    "list": [1, 2],
    "ragged": [[1, 2], [1]],
    "no tuple": (),
    "tuple of text": ("a", "b"),
    "tuple of None": (None, None),
    "mapping": {"a": 1},
    "set": {1, 2},
    "object": object(),
    "class": int,
    "function": lambda *anything: None,
    "decimal": Decimal("0.1"),
    "fraction": Fraction(1, 3),
    "date": np.datetime64("2020-01-01"),
    "shape ()": np.array(0.5),
    "shape (3,)": np.ones(3),
    "shape (2, 3)": np.ones((2, 3)),
    "shape (0,)": np.ones(0),
    "shape (2, 1, 1)": np.ones((2, 1, 1)),
    "array of complex": np.ones((2, 1), complex),
    "array of truths": np.ones((2, 1), bool),
    "array of text": np.array([["a"], ["b"]]),
    "array of objects": np.array([[None], [1]], dtype=object),
    "array of nan": np.full((2, 1), np.nan),
    "array of inf": np.full((2, 1), np.inf),
    "masked": np.ma.masked,
    "masked column": np.ma.array([[0.03], [0.04]], mask=[[False], [True]]),
    "matrix": np.ones((2, 1)).view(np.matrix),
    "list in itself": ITSELF,
    "lists in lists": NESTED,
    "list in a tuple": [("base_radius", ["offset"])],
    "class of designs": TranslatingRollerCam,
    "population": TranslatingRollerCam(base_radius=np.array([[0.03], [0.04]])),
    "another design": camkit.TranslatingFlatCam(),
}

LAW = Cycloidal()
PROGRAM = MotionProgram((Rise(2.0, 0.02, LAW), Dwell(1.0), Return(2.0, 0.02, LAW)))

HEIGHT = Measure("height", "mm", lambda analysis: analysis.pitch_radius.max(-1))
STUDY = Study(TranslatingRollerCam(), ["base_radius"], [HEIGHT], at_most={HEIGHT: 0.06}, angles=31)
BAD["study"] = STUDY

TURNS = np.arange(24) * np.pi / 12
CORNERS = ((0.03, -0.02), (0.03, 0.02), (-0.02, 0.02), (-0.02, -0.02))

GIVEN = {
    Rise: (2.0, 0.02, LAW),
    Return: (2.0, 0.02, LAW),
    Dwell: (1.0,),
    MotionProgram: (PROGRAM.segments,),
    Skewed: (LAW,),
    FreePolynomial: (),
    camkit.motion.FormError: (),
    camkit.motion.FormedProgram: ((Rise(1.0, 1.0, LAW),),),
    camkit.motion.ShapedLaw: (LAW, (0.1, 0.0, 0.0, 0.0)),
    SplineLaw: ((0.5,), (0.5,)),
    TableLaw: ((0.0, 0.5, 1.0), (0.0, 0.5, 1.0)),
    UserLaw: (ModifiedSine(),),
    Mirrored: (DoubleHarmonic(),),
    OpenMove: (1.0, LAW),
    AccelerationTable: ((0.0, 0.5, 1.0), (1.0, -1.0, 0.0), "steps"),
    Box: ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
    Measure: ("height", "mm", len),
    PeakMeasure: ("height", "mm", len),
    SumOfResiduals: ("height", "mm", len),
    Study: (TranslatingRollerCam(), ["base_radius"], [HEIGHT]),
    Sweep: (STUDY,),
    DesignMap: (shaft_study(),),
    Tolerances: (STUDY, {"base_radius": 0.001}),
    Tolerance: (0.001,),
    Source: ("wall", {"base_radius": -2.0}),
    RobustStudy: (TranslatingRollerCam(), ["base_radius"], [HEIGHT], {}, {}, 31, False, {"base_radius": 0.001}),
    LeastMeasure: ("height", "mm", len),
    SliderLoad: (0.2, 100.0, 1.0, abs),
    AnalysisCurve: ("pressure_angle", "deg", "pressure angle"),
    Quantity: ("x", 1.0, 0.0, 2.0, "mm", "a length"),
    Choice: ("law", LAW, (LAW,), "the law"),
    camkit.cam.DrawnOutline: (CORNERS,),
    camkit.cam.MeasuredOutline: (np.array([np.cos(TURNS), 0.2 + np.sin(TURNS)]) / 20,),
    Judgements: (("angle", "force"), [3]),
    Judges: ({"Anna": Judgements(("angle", "force"), [3]), "Ben": Judgements(("angle", "force"), [1])}, (1.0, 2.0)),
    Session: (STUDY, TranslatingRollerCam()),
    Decision: (Front(STUDY, np.array([[0.03]]), np.array([[0.05]])), 0),
}
"""What the constructors that have no defaults are given."""

NOT_MADE_BY_HAND = {"Front", "Transition", "ProgramPeaks", "Kinematics", "Peaks", "Law", "Segment"}
NOT_MADE_BY_HAND |= {"Contact", "Evaluation", "Indices", "JudgementRange", "Read", "Recheck", "SideBySide"}
NOT_MADE_BY_HAND |= {
    "CamOutline",
    "Compared",
    "ContactJump",
    "OutlineMotion",
    "Overshoot",
    "TableMotion",
    "TorqueBalance",
    "WeightedSum",
}
NOT_MADE_BY_HAND |= {"ToolPath", "WinnerMap", "Written"}
WINGS = [camkit, *(import_module(f"camkit.{wing}") for wing in ("motion", "cam", "linkage", "machines", "study"))]
WINGS += [camkit.decision, camkit.files]
NAMES = {name: wing for wing in WINGS for name in wing.__all__ if name not in NOT_MADE_BY_HAND}
PUBLIC = [getattr(wing, name) for name, wing in NAMES.items() if not name.endswith("Analysis")]
CLASSES = [c for c in PUBLIC if inspect.isclass(c) and dataclasses.is_dataclass(c)]
CASES = [(kind, f.name) for kind in [*CLASSES, Quantity, Choice] for f in dataclasses.fields(kind) if f.init]

PYTHON = re.compile(
    r"\bobject\b|NoneType|zip\(|\(\)|float:|inhomogeneous|unpack|ufunc|ambiguous|reshape|sequence|zero-size|iterable|dtype|"
    r"convert|operand|out of bounds|Traceback|not supported|0x[0-9a-f]{6}|\n"
)
"""What a person who never programmed should not read."""


def outcome(act):
    """ "" if ``act`` works or is refused in a sentence; what came of it otherwise."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", UnitRemark)
        try:
            act()
        except (ValueError, IndexError) as refused:
            said = str(refused)
            plain = not PYTHON.search(said.replace("Cycloidal()", "").replace("shape ()", ""))
            known = type(refused) in (ValueError, IndexError)
            return "" if plain and known and 10 < len(said) < 500 else f"{type(refused).__name__}: {said!r}"
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    return ""


def used(kind, name, value):
    """Make it and use it."""
    names = [f.name for f in dataclasses.fields(kind) if f.init]
    given = dict(zip(names, GIVEN.get(kind, ()), strict=False)) | {name: value}
    made = kind(**given)
    if kind is not Choice:
        repr(made)
    if isinstance(made, Study):
        made.evaluate(made.x0)
    elif isinstance(made, Sweep):
        made.evaluation  # noqa: B018
    elif isinstance(made, DesignMap):
        made.objective  # noqa: B018
    elif isinstance(made, Tolerances):
        made.share  # noqa: B018
    elif isinstance(made, RSSR):
        made.analyse([0.1, 0.2])
    elif hasattr(made, "analyse"):
        made.analyse(61)
    elif isinstance(made, camkit.motion.Law):
        made(0.3)
        made.peaks()
    elif isinstance(made, MotionProgram):
        made(0.3)
    elif isinstance(made, Rise | Return | Dwell):
        MotionProgram((made,))(0.3)


@pytest.mark.parametrize(("kind", "name"), CASES, ids=[f"{kind.__name__}.{name}" for kind, name in CASES])
def test_a_constructor_works_or_refuses_in_a_sentence(kind, name):
    failed = {bad: outcome(lambda v=value: used(kind, name, v)) for bad, value in BAD.items()}
    assert {bad: said for bad, said in failed.items() if said} == {}


def first_of(search):
    """The first step of a search that goes on."""

    def first_step(**given):
        return next(search(**given))

    first_step.__qualname__ = search.__qualname__
    return first_step


TWO = STUDY.replace(minimise=(HEIGHT, Measure("slope", "deg", lambda analysis: abs(analysis.pressure_angle).max(-1))))
missed = SumOfResiduals("missed", "mm", lambda analysis: analysis.pitch_radius - 0.05)
RESIDUAL = STUDY.replace(minimise=(missed,))
DOOR, DOOR_SPACE = camkit.DoorHandleCam(), {"lift_arm": (0.04, 0.06)}
SHAFT_SPACE = {"outer_diameter": (0.1, 0.15), "inner_diameter": (0.05, 0.103)}
FRONT = [[0.0, 1.0], [0.2, 0.2], [1.0, 0.0]]
ROLLER, FLAT, ROCKER = TranslatingRollerCam(), camkit.TranslatingFlatCam(), camkit.OscillatingRollerCam()

FUNCTIONS = {
    camkit.ahp: {"judgements": [5, 3, 1], "method": "geometric"},
    camkit.most_isolated: {"front": FRONT, "weights": (1, 1)},
    camkit.knee: {"front": FRONT, "weights": (1, 1)},
    camkit.topsis: {"front": FRONT, "weights": (1, 1), "scale": "range"},
    camkit.weighted_sum: {"front": FRONT, "weights": (1, 1)},
    camkit.decision.judgement_ranges: {"front": FRONT, "judgements": [3]},
    camkit.decision.winner_map: {"front": FRONT},
    camkit.contact.line_contact: {"force_per_length": 1e3, "curvature": 100.0, "modulus": 1e11},
    camkit.motion.residual_vibration: {"law": LAW, "tau": 1.5, "damping": 0.1},
    camkit.study.weighted: {"name": "sum", "weights": {HEIGHT: 1.0}, "reference": (2.0,)},
    PROGRAM.__call__: {"cam_angle": 0.3},
    PROGRAM.in_time: {"cam_angle": 0.3, "speed": 10.0},
    LAW.__call__: {"u": 0.3},
    ROLLER.base_radius_for: {"pressure_angle": 0.4, "min_radius": 0.001},
    ROLLER.conjugate: {"distance": 0.1, "roller_radius": 0.005},
    ROLLER.replace: {"motion": PROGRAM, "base_radius": 0.03},
    FLAT.base_radius_for: {"min_radius": 0.001},
    FLAT.conjugate: {"distance": 0.1},
    ROCKER.conjugate: {"spread": 1.2, "arm_length": 0.06, "roller_radius": 0.005},
    camkit.OscillatingFlatCam().face_offset_for: {"min_radius": 0.001},
    camkit.OscillatingFlatCam().conjugate: {"spread": 1.0, "face_offset": 0.01},
    camkit.ValveCam().with_spring: {"preload_share": 0.4},
    UniversalJointShaft().made_of: {"name": "45"},
    UniversalJointShaft().stiff_diameter: {"inner_diameter": 0.1},
    STUDY.design: {"x": [0.03]},
    STUDY.evaluate: {"x": [[0.03]]},
    STUDY.with_weights: {"weights": (1.0,)},}  # fmt: skip
FUNCTIONS |= {
    kind().analyse: {"n": 61}
    for kind in CLASSES
    if hasattr(kind, "analyse") and hasattr(kind, "measures") and kind not in (RSSR, Study)
}
CAM = TranslatingRollerCam()
CROSS = TWO.evaluate([[0.03], [0.04], [0.05]])
FOUND = front_of(CROSS, TWO)
SPREAD = Tolerances(STUDY, {"base_radius": 0.001}, parts=64)
CURVE = AnalysisCurve("pressure_angle", "deg", "pressure angle")
FUNCTIONS |= {
    camkit.machines.cam_lever_study: {
        "start": CamLever(), "objective": peak_stress, "max_radius": 0.11, "free_laws": False, "angles": 31
    },
    camkit.machines.corrected_valve_study: {"start": camkit.ValveCam(), "weights": (0.5, 0.5)},
    camkit.machines.door_handle_paper_study: {"start": DOOR},
    camkit.door_handle_study: {"start": DOOR, "space": DOOR_SPACE, "reference": DOOR, "weights": (1, 1, 1)},
    camkit.high_speed_study: {
        "start": camkit.HighSpeedCam(), "objective": peak_stress, "free_laws": True, "free_spring": True,
        "space": {"arm_length": (0.1, 0.2)}, "at_most": {peak_stress: 1.0}, "at_least": {peak_stress: 1.0}, "angles": 31
    },
    camkit.machines.lift_curve_study: {"start": DOOR, "space": DOOR_SPACE, "reference": DOOR, "weights": (1, 1, 1)},
    camkit.machines.lightest_shaft: {"start": UniversalJointShaft(), "space": SHAFT_SPACE},
    camkit.rssr_study: {
        "start": camkit.machines.CabinDoorLinkage(), "objective": missed, "space": {"crank": (0.05, 0.1)},
        "min_swing": 1.0,
        "inside": Box(*GIVEN[Box]), "outside": Box(*GIVEN[Box]), "positions": 5
    },
    camkit.shaft_study: {"start": UniversalJointShaft(), "space": SHAFT_SPACE},
    camkit.valve_study: {
        "start": camkit.ValveCam(), "weights": (0.5, 0.5), "printed_sign": False, "paper_units": False
    },
    camkit.machines.valve_front_study: {"start": camkit.ValveCam(), "limited": HEIGHT, "space": {"n": (2.0, 20.0)}},
    camkit.minimise: {"study": STUDY, "method": "slsqp", "seed": 1, "starts": 1, "designs": 40, "recheck": 61},
    camkit.nsga2: {"study": TWO, "population": 4, "generations": 1, "seed": 1},
    camkit.polish: {"study": RESIDUAL, "x": [0.03]},
    camkit.quick_front: {"study": TWO, "size": 4, "start": FOUND},
    first_of(camkit.search.shortest_interval): {
        "study": cam_lever_study(free_laws=False, angles=31), "limit": 1e3, "shortest": 0.9, "longest": 1.0,
        "intervals": ("rise_angle",), "tolerance": 0.05
    },
    first_of(camkit.search.trade_off): {"study": TWO, "points": 2},
    first_of(epsilon_constraint_steps): {"study": TWO, "points": 2},
    front_of: {"evaluation": CROSS, "study": TWO},
    dominated: {"f": FRONT},
    FOUND.__getitem__: {"i": 0},
    FOUND.hypervolume: {"reference": (1.0, 1.0)},
    FOUND.judged_by: {"study": TWO},
    SPREAD.of: {"measure": HEIGHT},
    SPREAD.percentiles: {"measure": HEIGHT, "levels": (5, 95)},
    SPREAD.band: {"curve": CURVE, "levels": (5, 95)},
    random_index: {"n": 12},
    camkit.quantity: {
        "symbol": "l", "default": 50, "low": 20, "high": 90, "unit": "mm", "meaning": "a length", "above": 0.0,
        "at_least": 1.0, "at_most": 100.0
    },
    camkit.decision.side_by_side: {
        "designs": {"cam": CAM}, "measures": (HEIGHT,), "study": STUDY, "analyses": [CAM.analyse(31)]
    },
    RSSR().closure: {"crank_angle": 0.3},
    RSSR().discriminant: {"crank_angle": 0.3},
    RSSR().assembles: {"crank_angle": 0.3},
    RSSR().analyse: {"crank_angle": 0.3, "branch": 1, "load": camkit.linkage.RockerLoad(), "through": False},
    Box(*GIVEN[Box]).depth: {"points": (0.5, 0.5, 0.5)},
    Box(*GIVEN[Box]).clearance: {"start": (0.5, 0.5, 0.5), "end": (0.5, 0.5, 2.0)},
}  # fmt: skip
CALLS = [(function, name) for function, given in FUNCTIONS.items() for name in given]


def _called(function, name):
    return f"{getattr(function, '__qualname__', function)}.{name}"


@pytest.mark.parametrize(("function", "name"), CALLS, ids=[_called(*call) for call in CALLS])
def test_a_function_works_or_refuses_in_a_sentence(function, name):
    given = FUNCTIONS[function]
    failed = {bad: outcome(lambda v=value: function(**given | {name: v})) for bad, value in BAD.items()}
    assert {bad: said for bad, said in failed.items() if said} == {}


def test_every_argument_is_good_before_one_is_bad():
    for function, given in FUNCTIONS.items():
        function(**given)
