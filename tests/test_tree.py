"""A design is a tree: every quantity of every design has a path, by which it is read, set and freed."""

from dataclasses import dataclass

import numpy as np
import pytest
from hand import choose, move, sliders
from numpy.testing import assert_allclose

from camkit import (
    RSSR,
    DoorHandleCam,
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Study,
    Sweep,
    Tolerances,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    ValveCam,
    deg,
    explore,
    mm,
    quick_front,
)
from camkit.cam import ConjugatePair, ContactPair
from camkit.cam.follower_measures import FLAT_CURVE
from camkit.files import Session, from_json, to_json
from camkit.linkage import DoubleUniversalJoint, UniversalJoint
from camkit.machines import CamLever
from camkit.machines.cabin_door import CabinDoorLinkage
from camkit.motion import (
    LAW_MENU,
    Cycloidal,
    Dwell,
    Kinematics,
    Law,
    MotionProgram,
    Peaks,
    Poly345,
    Return,
    Rise,
    ShapedLaw,
)
from camkit.quantities import choices_of, declared_in, quantities_of, quantity, value_of, with_quantities
from camkit.views import pressure_angle

DESIGNS = [
    TranslatingRollerCam(),
    TranslatingFlatCam(),
    OscillatingRollerCam(),
    OscillatingFlatCam(),
    DoorHandleCam(),
    HighSpeedCam(),
    CamLever(),
    ValveCam(),
    RSSR(),
    CabinDoorLinkage(),
    UniversalJointShaft(),
    UniversalJoint(),
    DoubleUniversalJoint(),
    *(
        OscillatingRollerCam(MotionProgram((Rise(2.0, 0.3, law), Dwell(1.0), Return(2.0, 0.3, law), Dwell(1.0))))
        for law in LAW_MENU
    ),
]
every_design = pytest.mark.parametrize("design", DESIGNS, ids=lambda d: type(d).__name__)


@every_design
def test_every_path_can_be_read_set_and_set_as_a_column(design):
    for path, declared in quantities_of(design).items():
        value = value_of(design, path)
        assert declared.allows(value), path
        other = value + 1e-3 * max(abs(value), declared.factor * 1e-3)
        changed = with_quantities(design, {path: other})
        assert value_of(changed, path) == other, path
        assert value_of(with_quantities(changed, {path: value}), path) == value
        column = np.array([[value], [other], [value]])
        many = with_quantities(design, {path: column})
        np.testing.assert_array_equal(value_of(many, path), column)


@every_design
def test_every_choice_can_be_read_and_set_by_value_and_by_name(design):
    for path, declared in choices_of(design).items():
        for name, option in declared.named.items():
            assert value_of(with_quantities(design, {path: option}), path) == option
            assert value_of(with_quantities(design, {path: name}), path) == option


# ---------------------------------------------------------------- what the paths are


def test_a_segment_is_called_by_its_kind_and_count_or_by_its_own_name():
    law = Cycloidal()
    segments = (Rise(1, 0.1, law), Dwell(0.5), Rise(1, 0.1, law, name="high"), Dwell(0.5), Return(1, 0.2, law))
    program = MotionProgram(segments)
    assert program.names == ("rise", "dwell", "high", "dwell2", "return")
    assert "motion.high.lift" in quantities_of(OscillatingRollerCam(program))


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        (("a", "a"), "a segment of the program is called a; it must have a name that nothing else has"),
        (("start", ""), "a segment of the program is called start; it must have a name that nothing else has"),
        (("a.b", ""), "the name of the dwell is 'a.b'; it must be made of letters, digits and _"),
        ((1, ""), "the name of the dwell is 1; it must be made of letters, digits and _"),
    ],
)
def test_names_that_paths_cannot_use_are_refused(names, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        MotionProgram(tuple(Dwell(1.0, name=name) for name in names))


@pytest.mark.parametrize(("design", "unit"), [(TranslatingFlatCam(), "mm"), (OscillatingFlatCam(), "deg")])
def test_a_lift_is_in_the_unit_of_the_follower(design, unit):
    declared = quantities_of(design)
    assert declared["motion.rise.lift"].unit == declared["motion.start"].unit == unit
    assert quantities_of(design.motion)["rise.lift"].unit == ""


def test_a_coefficient_goes_as_far_as_its_family():
    for family, wide in (("degree 9", 0.6), ("B-spline", 0.2)):
        law = with_quantities(ShapedLaw(Poly345(), (0.0,) * 4), {"family": family})
        assert quantities_of(law)["c3"].high == wide
        assert quantities_of(law)["c3"].symbol == "c_3"


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("motion.rise.lifts", "'motion.rise.lifts' is no path of TranslatingRollerCam; near it are motion.rise.lift, "),
        ("motion.dwell2.angle", "'motion.dwell2.angle' .*: it takes up what the other segments leave of the turn$"),
        ("motion.return.lift", "'motion.return.lift' .*: it takes the follower back to where the turn began$"),
        ("%", "'%' is no path of TranslatingRollerCam; there are motion.rise.angle, .* and 15 more$"),
        (3, "3 is no path of TranslatingRollerCam; there are "),
    ],
)
def test_an_unknown_path_is_refused_in_a_sentence(path, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        with_quantities(TranslatingRollerCam(), {path: 1.0})


def test_what_is_refused_is_refused_by_its_owner():
    with pytest.raises(ValueError, match=r"^the spring rate \(closing spring\) is -1 N/mm; it must be"):
        with_quantities(TranslatingRollerCam(), {"load.spring_rate": -1e3})
    with pytest.raises(ValueError, match=r"^the rotation is 'left'; it must be one of 1 \(counter-clockwise\), -1"):
        with_quantities(TranslatingRollerCam(), {"rotation": "left"})


def test_all_of_one_part_changes_at_once():
    """Both sizes alone would be refused: the offset must stay within base circle and roller."""
    cam = TranslatingRollerCam(base_radius=12 * mm, roller_radius=3 * mm, offset=0.0)
    with pytest.raises(ValueError, match="offset"):
        with_quantities(cam, {"offset": 20 * mm})
    assert with_quantities(cam, {"offset": 20 * mm, "base_radius": 30 * mm}).offset == 20 * mm


def test_what_is_chosen_has_quantities_of_its_own():
    shaped = {"motion.rise.law": "shaped", "motion.rise.law.c1": 0.1}
    law = with_quantities(OscillatingRollerCam(), shaped).motion.segments[0].law
    assert law == ShapedLaw(Poly345(), (0.0, 0.1, 0.0, 0.0))


PAIR, STEEL = ConjugatePair(), TranslatingRollerCam(contact=ContactPair(cam_material="42CrMo"))


@pytest.mark.parametrize(("design", "choice", "beside"), [
    (PAIR, {"cam": "rocking face"}, {"spread": 1.4, "face_offset": 2 * mm}),
    (STEEL, {"contact.cam_material": "own numbers"}, {"contact.cam_modulus": 1e11, "contact.width": 9 * mm}),
    (TranslatingRollerCam(), {"contact": "along a line", "contact.cam_material": "own numbers"},
     {"contact.cam_modulus": 1e11, "base_radius": 31 * mm}),
])  # fmt: skip
def test_a_choice_and_what_it_brings_beside_itself_are_set_at_once(design, choice, beside):
    for values in (choice | beside, beside | choice):
        changed = with_quantities(design, values)
        assert [value_of(changed, path) for path in beside] == list(beside.values())
        assert changed == with_quantities(with_quantities(design, choice), beside)


@pytest.mark.parametrize(("design", "values", "sentence"), [
    (PAIR, {"cam": "rocking face", "distance": 0.2}, "'distance' .*: the second cam of a rocking face has none"),
    (STEEL.replace(contact=ContactPair()), {"contact.cam_modulus": 1e11, "contact.cam_material": "42CrMo"},
     "'contact.cam_modulus' is no path of TranslatingRollerCam: it is that of the cam_material"),
    (STEEL, {"contact": "not given", "contact.width": 9 * mm}, "'contact.width' is no path of .*; near it are contact"),
])  # fmt: skip
def test_what_the_chosen_design_does_not_have_is_refused_beside_the_choice(design, values, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        with_quantities(design, values)


def test_a_design_that_has_not_what_a_study_frees_is_none_of_it():
    study = Study(PAIR, ["distance"], PAIR.measures[:1])
    rocking = with_quantities(PAIR, {"cam": "rocking face"})
    for refused in (study.x_of, study.around, lambda design: Session(study, design)):
        with pytest.raises(
            ValueError, match=r"^'distance' is no (path of this|quantity of) ConjugatePair: the second cam of a rock"
        ):
            refused(rocking)


# ---------------------------------------------------------------- a turn stays closed


def turn(*segments, start=0.0):
    return MotionProgram(segments, start)


LAW = Cycloidal()
TURNS = {
    "the last dwell": (turn(Rise(2.0, 0.3, LAW), Dwell(1.0), Return(2.0, 0.3, LAW), Dwell(2 * np.pi - 5)), 3, 2),
    "a dwell before the end": (turn(Rise(2.0, 0.3, LAW), Dwell(1.0), Return(2 * np.pi - 3, 0.3, LAW)), 1, 2),
    "no dwell": (turn(Return(2.0, 0.3, LAW), Rise(2 * np.pi - 2, 0.3, LAW)), 1, 1),
}


@pytest.mark.parametrize(("program", "angle", "lift"), TURNS.values(), ids=TURNS)
def test_a_turn_stays_closed_when_its_segments_change(program, angle, lift):
    names, free = program.names, quantities_of(program)
    assert f"{names[angle]}.angle" not in free
    assert f"{names[lift]}.lift" not in free
    angles, lifts = ([n for n in free if n.endswith(end)] for end in (".angle", ".lift"))
    assert len(angles) == len(names) - 1
    bend, swing = np.array([[-0.05], [0.0], [0.1]]), np.array([[0.02], [0.0], [-0.01]])
    changes = {n: value_of(program, n) + bend for n in angles} | {n: value_of(program, n) + swing for n in lifts}
    many = with_quantities(program, changes)
    assert many.possible.all()
    assert many.periodic.all()
    assert_allclose(many.segments[angle].angle, program.segments[angle].angle - len(angles) * bend, rtol=1e-12)
    assert_allclose(many.levels[-1], 0.0, atol=1e-15)
    for i in range(3):
        one = with_quantities(program, {n: float(x[i, 0]) for n, x in changes.items()})
        phi = np.linspace(0, 2 * np.pi, 97)
        assert_allclose(one(phi).s, many(phi).s[i], atol=1e-14)


def test_a_turn_that_cannot_be_closed_is_refused_and_drops_out_of_a_population():
    program = TURNS["the last dwell"][0]
    with pytest.raises(ValueError, match=r"^the other segments take 401\.07 deg of the turn; they must leave some for"):
        with_quantities(program, {"rise.angle": 4.0})
    many = with_quantities(program, {"rise.angle": np.array([[2.0], [4.0]])})
    assert many.possible.tolist() == [[True], [False]]
    rises = turn(Rise(1.0, 0.1, LAW), Rise(1.0, 0.1, LAW), Return(2 * np.pi - 3, 0.3, LAW), Rise(1.0, 0.1, LAW))
    with pytest.raises(ValueError, match=r"^the rise that closes the turn would have to move by -0\.2 .* too large$"):
        with_quantities(rises, {"rise.lift": 0.4})


def test_a_part_of_a_turn_is_not_closed():
    part = turn(Rise(2.0, 0.3, LAW), Dwell(1.0), Return(2.0, 0.3, LAW))
    assert list(quantities_of(part)) == [
        "rise.angle",
        "rise.lift",
        "dwell.angle",
        "return.angle",
        "return.lift",
        "start",
    ]
    assert with_quantities(part, {"rise.lift": 0.2}).segments[2].lift == 0.3


# ---------------------------------------------------------------- what reads the tree


def own_cam():
    """An oscillating flat follower with free coefficients of the law, as no module of camkit has it."""
    up, down = ShapedLaw(Poly345(), (0.05, 0.0, -0.02, 0.0)), ShapedLaw(Cycloidal(), (0.0,) * 4)
    program = turn(Rise(2.0, 0.2, up), Dwell(1.0), Return(2.1, 0.2, down), Dwell(2 * np.pi - 5.1))
    return OscillatingFlatCam(motion=program)


FREE = {
    "motion.rise.angle": (1.8, 2.2),
    "motion.rise.law.c0": (-0.1, 0.1),
    "motion.return.law.c1": (-0.1, 0.1),
    "load.spring_rate": (2.0, 8.0),
    "load.preload": (1.0, 6.0),
}


def test_a_population_over_any_paths_equals_its_members_one_by_one():
    study = Study(own_cam(), FREE, FLAT_CURVE[:6], angles=121)
    rng = np.random.default_rng(1)
    low, high = study.bounds
    x = low + (high - low) * rng.random((500, len(FREE)))
    together = study.evaluate(x)
    apart = np.concatenate([study.evaluate(row).f for row in x])
    assert np.isfinite(apart).all()
    assert_allclose(together.f, apart, rtol=1e-12, atol=1e-12)


def test_a_front_of_a_cam_that_no_module_names():
    torque, force = (m for m in FLAT_CURVE if m.name in ("peak cam torque without friction", "minimum contact force"))
    free = {path: bounds for path, bounds in FREE.items() if path != "motion.rise.angle"}
    found = quick_front(Study(own_cam(), free, (torque, -force), angles=121), size=30)
    assert len(found) == 30
    assert np.ptp(found.x, axis=0).all()


@dataclass(frozen=True)
class Bent(Law):
    """A user's law with a parameter: ``s = p345 + k u^3 (1 - u)^3``."""

    k: float = quantity("k", 0, -2, 2, "", "bends the law", above=None)

    name = "bent"
    continuity = 2

    def at(self, u):
        return Kinematics(*(p + self.k * b for p, b in zip(Poly345().at(u), bump(u), strict=True)))

    def peaks(self):
        return Peaks(np.nan, np.nan, np.nan)


def bump(u):
    """``(u - u^2)^3`` and its derivatives."""
    w, d = u - u**2, 1 - 2 * u
    return w**3, 3 * w**2 * d, 6 * w * d**2 - 6 * w**2, 6 * d**3 - 36 * w * d


def test_a_law_of_ones_own_is_in_every_study_sweep_tolerance_and_file():
    path = "motion.rise.law.k"
    cam = with_quantities(TranslatingRollerCam(), {"motion.rise.law": Bent(0.5)})
    assert quantities_of(cam)[path].meaning == "bends the law"
    study = Study(cam, [path], TranslatingRollerCam.measures[:2])
    assert study.bounds.ravel().tolist() == [-2.0, 2.0]
    assert Sweep(study, n=5).evaluation.f.shape == (5, 2)
    made = Tolerances(study, {path: 0.1, "motion.rise.lift": 0.1 * mm}, parts=16)
    assert np.ptp(made.x[:, 0]) > 0.1
    again = from_json(to_json(Session(study, cam)), Session)
    assert (again.design, dict(again.study.free)) == (cam, dict(study.free))
    with pytest.raises(ValueError, match=r"^the k \(bends the law\) is inf; it must be"):
        Bent(np.inf)


def test_every_path_has_a_control_and_what_is_chosen_brings_its_own():
    app = explore(OscillatingFlatCam(), pressure_angle)
    assert sliders(app) == list(declared_in(app.design))
    choose(app, "motion.rise.law", "shaped")
    move(app, "motion.rise.law.c0", 0.1)
    assert app.design.motion.segments[0].law == ShapedLaw(Poly345(), (0.1, 0.0, 0.0, 0.0))
    app.load(with_quantities(app.design, {"motion.rise.law": Bent(0.5)}))
    move(app, "motion.rise.law.k", -1.0)
    choose(app, "rotation", "clockwise")
    assert (app.design.rotation, app.design.motion.segments[0].law) == (-1, Bent(-1.0))
    choose(app, "motion.rise.law", "cycloidal")
    assert "motion.rise.law.k" not in sliders(app)
    move(app, "motion.rise.angle", 130.0)
    assert app.design.motion.segments[3].angle == pytest.approx(50 * deg)


def test_named_paths_alone_have_controls_where_that_is_asked_for():
    app = explore(own_cam(), pressure_angle, free=["motion.rise.law.c0", "load.preload"])
    assert sliders(app) == ["motion.rise.law.c0", "load.preload"]
    app.load(OscillatingFlatCam())
    assert sliders(app) == ["load.preload"]
