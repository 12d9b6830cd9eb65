"""What a program says in words is what plain Python says: why a design cannot be built, and what is undercut."""

from math import inf, nan, pi

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import TranslatingRollerCam, mm
from camkit.cam.pair import CAMS, ConjugatePair
from camkit.linkage import RSSR, DoubleUniversalJoint
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.motion.segments import LAW_MENU
from camkit.program import record
from camkit.quantities import quantities_of, with_quantities
from program_cases import designs_beside, start_of

ANGLES = 61
SEEDS, OF_A_LAW = 60, 16
"""So many designs of each machine; fewer of each law, which says what is wrong with it whoever holds it."""
LAW, REST = Cycloidal(), Dwell(2 * pi - 4)
OPEN = MotionProgram((Rise(2.0, 20 * mm, LAW), Dwell(1.0), Return(2.0, 20 * mm, LAW)))
DOWN_FIRST = MotionProgram((Return(1.0, 9 * mm, LAW), Rise(2.0, 4 * mm, LAW), Rise(1.0, 5 * mm, LAW), REST))
UP_FIRST = MotionProgram((Rise(1.0, 9 * mm, LAW), Return(2.0, 4 * mm, LAW), Return(1.0, 5 * mm, LAW), REST))
LAWS = {law.name: with_quantities(TranslatingRollerCam(), {"motion.rise.law": law}) for law in LAW_MENU}
DESIGNS = {
    **MACHINES,
    **LAWS,
    "pair of faces": ConjugatePair(CAMS[1]),
    "pair of faces on arms": ConjugatePair(CAMS[3]),
    "linkage": RSSR(crank=20 * mm),
    "double joint": DoubleUniversalJoint(),
    "part of a turn": TranslatingRollerCam(OPEN),
    "down first": TranslatingRollerCam(DOWN_FIRST, base_radius=50 * mm),
    "up first": TranslatingRollerCam(UP_FIRST),
}
REFUSED = {
    "the base radius (cam axis to profile at the motion's level 0) is nan": ("roller", {"base_radius": nan}),
    "the base radius (cam axis to profile at the motion's level 0) is inf": ("roller", {"base_radius": inf}),
    "the roller radius (roller; 0 is a knife edge) is 1e-12 mm": ("roller", {"roller_radius": 1e-15}),
    "the offset (follower's axis beside the cam axis) is 1e+06 mm": ("roller", {"offset": 1e3}),
    "the offset of the follower is 50 mm": ("roller", {"offset": 0.05}),
    "the roller's centre comes down to": ("roller", {"motion.start": -0.05}),
    "the roller of radius 20 mm comes within": ("roller", {"roller_radius": 0.02, "motion.start": -0.035}),
    "the face comes down to": ("face", {"base_radius": 0.01, "motion.start": -0.02}),
    "the angle of the rise is 0 deg": ("roller", {"motion.rise.angle": 0.0}),
    "the angle of the dwell is nan;": ("roller", {"motion.dwell.angle": nan}),
    "the lift of the rise is -0.001": ("roller", {"motion.rise.lift": -0.001}),
    "the start of the program is inf": ("roller", {"motion.start": inf}),
    "the other segments take 466": ("roller", {"motion.rise.angle": 5.0}),
    "the return that closes the turn would have to move by": ("up first", {"motion.rise.lift": 0.002}),
    "the rise that closes the turn would have to move by": ("down first", {"motion.rise.lift": 0.02}),
    "the program spans 401": ("part of a turn", {"motion.rise.angle": 4.0}),
    "the program spans 1031": ("part of a turn", {"motion.rise.angle": 15.0}),
    "the program spans 0.005": ("part of a turn", {"motion.rise.angle": 2 * pi - 3 + 1e-4}),
    "the program spans 359.99": ("part of a turn", {"motion.rise.angle": 2 * pi - 3 - 1e-4}),
    "the program ends 0.01 from": ("part of a turn", {"motion.rise.angle": 2 * pi - 3, "motion.rise.lift": 0.03}),
    "the coefficient c1 of the shaped law is 800": ("shaped", {"motion.rise.law.c1": 800.0}),
    "v at the start of the free polynomial is nan": ("free polynomial", {"motion.rise.law.start_v": nan}),
    "a value of the spline is -5000": ("B-spline", {"motion.rise.law.s1": -5000.0}),
    "the inflection of the skewed law is 1.5": ("skewed", {"motion.rise.law.inflection": 1.5}),
    "the blend of the constant velocity law": ("constant velocity with blends", {"motion.rise.law.blend": 0.0}),
    "the arm swings from": ("roller on an arm", {"start_angle": 2.9}),
    "the roller of radius 40 mm comes within": ("roller on an arm", {"roller_radius": 0.04, "centre_distance": 0.07}),
    "the arm swings from 85": ("face on an arm", {"start_angle": 1.5}),
    "the arm moves with the cam by": ("face on an arm", {"motion.rise.lift": 1.2}),
    "the face comes down to -": ("face on an arm", {"face_offset": -0.06}),
    "the face is touched up to": ("face on an arm", {"arm_length": 0.02}),
    "the rollers' centres are 30 mm apart": ("pair of cams", {"distance": 0.03}),
    "the faces are 20 mm apart": ("pair of faces", {"distance": 0.02}),
    "the second cam cannot be built; the spread is 3 deg": ("pair of faces on arms", {"spread": 3 * pi / 180}),
    "the second cam cannot be built; the distance is": ("pair of cams", {"distance": 0.06}),
    "the arm swings over 401.1 deg": ("high speed", {"rise_angle": 5.0, "return_angle": 2.0}),
    "the roller's centre has to come": ("high speed", {"max_radius": 0.4}),
    "the arm ends at": ("high speed", {"swing": 1.2}),
    "the minimum radius r_k1": ("high speed", {"arm_length": 0.26, "roller_radius": 0.125, "swing": 0.86}),
    "the stroke is 600 mm": ("lever", {"stroke": 0.6}),
    "the relief cam angle is 200.5 deg": ("door handle", {"relief_cam_angle": 3.5}),
    "relief curve, transition arc": ("door handle", {"handle_angle": 4.0}),
    "the relief roller has to rest": ("door handle", {"relief_centre_distance": 0.25}),
    "the exponents are 2,": ("valve", {"n": 1.0 + 1e-9}),
    "two flanks and two ramps need": ("valve", {"half_angle": 3.0, "ramp_angle": 0.4}),
    "the base radius is 2 mm and the ramp": ("valve", {"base_radius": 0.002, "seating_velocity": 2.0}),
    "the crank sweeps from 15 to 15 deg": ("cabin door", {"start_angle": 15 * pi / 180, "end_angle": 15 * pi / 180}),
    "the crank cannot sweep from 15 to 300 deg": ("cabin door", {"end_angle": 300 * pi / 180}),
    "the coupler of 900 mm cannot be assembled": ("cabin door", {"coupler": 0.9}),
    "the crank cannot sweep from 0 to 360 deg": ("linkage", {"crank": 0.15}),
    "the inner diameter is 200 mm": ("shaft", {"inner_diameter": 0.2}),
    "the lowest speed is": ("shaft", {"speed": 150.0}),
    "the joint angle is 91.6": ("shaft", {"joint_angle": 1.6}),
    "the first angle is 91.6": ("double joint", {"first_angle": 1.6}),
}
"""A design that each sentence refuses, by how it begins: no other place refuses one for its numbers alone."""


def trouble(design):
    return {"trouble": getattr(design.analyse(ANGLES), "trouble", "")}


def in_plain_python(design, values):
    """The sentence that refuses a design, "" if it can be built; and what is undercut."""
    try:
        with np.errstate(all="ignore"):
            return "", trouble(with_quantities(design, values))["trouble"]
    except ValueError as refusal:
        return str(refusal), ""


@pytest.fixture(scope="module")
def programs():
    return {}


@pytest.mark.parametrize("sentence", REFUSED)
def test_a_design_is_refused_in_the_same_sentence(sentence, programs):
    name, changed = REFUSED[sentence]
    if name not in programs:
        programs[name] = record(trouble, DESIGNS[name])
    start = start_of(DESIGNS[name])
    values = start | changed
    refusal, _ = in_plain_python(DESIGNS[name], values)
    assert refusal.startswith(sentence)
    assert programs[name].refusal(values) == refusal
    assert not programs[name].refusal(start)


def beside(design, seed):
    """Values by path, some of them from anywhere in their ranges."""
    return {path: float(column[0, 0]) for path, column in designs_beside(design, 1, seed).items()}


def wild(design, seed):
    """Values by path, some of them far out of all ranges."""
    rng, values = np.random.default_rng(seed), start_of(design)
    for path, declared in quantities_of(design).items():
        if rng.random() < 0.05:
            strange = rng.choice([0.0, 1e-14, 3.0, 2e3, -1.0, nan, inf, -inf])
            values[path] = strange * declared.high * declared.factor
    return values


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_what_is_wrong_with_a_design_is_said_in_the_same_words(name):
    program = record(trouble, DESIGNS[name])
    for seed in range(OF_A_LAW if name in LAWS else SEEDS):
        values = wild(DESIGNS[name], seed) if seed % 2 else beside(DESIGNS[name], seed)
        refusal, said = in_plain_python(DESIGNS[name], values)
        assert program.refusal(values) == refusal
        assert refusal or program(values)["trouble"] == said
