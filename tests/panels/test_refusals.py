"""Bad input, and the sentence that each must give: what it is, its value, what is possible.

The sentences are the contract with the person who typed the number, so they are compared word for word.
"""

import json
from dataclasses import fields
from functools import reduce

import numpy as np
import pytest
from hand import sliders

from camkit import (
    RSSR,
    ArmLoad,
    Cycloidal,
    DoorHandleCam,
    Dwell,
    Friction,
    Judgements,
    Measure,
    MotionProgram,
    OscillatingRollerCam,
    PeakMeasure,
    Return,
    Rise,
    Study,
    UniversalJointShaft,
    ahp,
    door_handle_study,
    most_isolated,
    nsga2,
    picture,
    read,
    topsis,
    weighted_sum,
    with_quantities,
    write_table,
)
from camkit.data import load as reference
from camkit.decision import (
    crowding_distance,
    judged_weights,
    judgement_ranges,
    side_by_side,
    weight_lattice,
    winner_map,
)
from camkit.files import Session, from_json, to_json
from camkit.linkage.measures import departure, max_departure
from camkit.machines import CamLever, ValveCam, lift_curve_study
from camkit.panels import ahp_panel, choose_panel, contour_panel, explore
from camkit.quantities import Paths, choices_of, declarations
from camkit.search.front import Front
from camkit.study import SumOfResiduals, weighted
from camkit.units import deg, factor, mm
from camkit.views import pressure_angle

NAN, INF = float("nan"), float("inf")
height = Measure("height", "mm", lambda analysis: analysis)
CAM, ROLLER = DoorHandleCam(), OscillatingRollerCam()
COLUMNS = DoorHandleCam(lift_arm=np.array([[0.05], [0.06]]))
ITSELF: list = []
ITSELF.append(ITSELF)
NESTED = reduce(lambda inner, _: [inner], range(40), 1.0)
GOOD = json.loads(to_json(CAM))
LAWS = choices_of(CAM)["motion_law"].offered


def a_study(free=("lift_arm",), minimise=(height,), **more):
    return Study(CAM, free, minimise, **more)


def a_front(f=0.5):
    """A front of one design and two objectives."""
    level, depth = (Measure(name, "mm", lambda analysis: 0.0) for name in ("level", "depth"))
    return Front(a_study(minimise=(level, depth)), np.array([[0.05]]), np.array([[f, 0.5]]))


def a_file(**entries):
    """The default cam's file with other entries; ``...`` leaves one out."""
    design = {k: v for k, v in (GOOD["design"] | entries).items() if v is not ...}
    return from_json(json.dumps(GOOD | {"design": design}))


# fmt: off
REFUSALS = [
    # one number of a design
    (lambda: DoorHandleCam(lift_arm=NAN),
     "the lift arm (pivot to roller centre) is nan mm; it must be a finite number above 0 mm"),
    (lambda: DoorHandleCam(relief_arm=-75 * mm),
     "the relief arm (pivot to roller centre) is -75 mm; it must be a finite number above 0 mm"),
    (lambda: DoorHandleCam(lift_centre_distance=INF),
     "the lift centre distance (cam axis to lift pivot) is inf mm; it must be a finite number above 0 mm"),
    (lambda: DoorHandleCam(roller_radius=0),
     "the roller radius (both rollers) is 0 mm; it must be a finite number above 0 mm"),
    (lambda: DoorHandleCam(lift_start_angle="22"),
     "the lift start angle is '22'; it must be a finite number above 0 deg"),
    (lambda: DoorHandleCam(lift_arm=True), "the lift arm is True; it must be a finite number above 0 mm"),
    (lambda: ArmLoad(speed=-90 * deg),
     "the speed (speed of the cam) is -15 rpm; it must be a finite number of at least 0 rpm"),
    (lambda: ArmLoad(torque=INF),
     "the torque (constant resisting torque) is inf N m; it must be a finite number"),
    (lambda: CAM.replace(lift_swing=-69 * deg),
     "the lift swing (swing of the lift crank) is -69 deg; it must be a finite number above 0 deg"),
    (lambda: OscillatingRollerCam(roller_radius=-1 * mm),
     "the roller radius (roller; 0 is a knife edge) is -1 mm; it must be a finite number of at least 0 mm"),
    (lambda: OscillatingRollerCam(start_angle=-3 * deg),
     "the start angle (arm's angle from the line of centres at the level 0) is -3 deg; "
     "it must be a finite number above 0 deg"),
    (lambda: OscillatingRollerCam(rotation=0),
     "the rotation is 0; it must be one of 1 (counter-clockwise), -1 (clockwise)"),
    (lambda: ArmLoad(mass=-1), "the mass (uniform arm) is -1 kg; it must be a finite number of at least 0 kg"),
    (lambda: Friction(coefficient=NAN),
     "the coefficient (friction between cam and follower) is nan; it must be a finite number of at least 0"),
    (lambda: ArmLoad(torque_table=((0.0, NAN),)),
     "the torque table has an entry that is not a finite number; it holds (travel, torque)"),

    # numbers that do not go together
    (lambda: DoorHandleCam(relief_arm=20 * mm),
     "the relief roller has to rest on the lift curve's base circle of 33.59 mm; "
     "an arm of 20 mm at 100 mm reaches 80 to 120 mm"),
    (lambda: DoorHandleCam(relief_cam_angle=180 * deg),
     "the relief cam angle is 180 deg of 180 deg handle angle; it must leave some for the lift crank"),
    (lambda: DoorHandleCam(handle_angle=200 * deg),
     "relief curve, transition arc and lift curve need 370 deg of the cam; there are 360 deg"),
    (lambda: DoorHandleCam(lift_swing=160 * deg).analyse(),
     "the arm swings from 22 to 182 deg from the line of centres; it must stay between 0 and 180 deg"),
    (lambda: OscillatingRollerCam(roller_radius=100 * mm).analyse(),
     "the roller of radius 100 mm comes within 36.05 mm of the cam axis; it must stay outside it"),
    (lambda: DoorHandleCam(motion_law="cycloidal").analyse(),
     "the motion law is 'cycloidal'; it must be one of simple harmonic, parabolic, cycloidal, modified trapezoid, "
     "modified sine, 3-4-5 polynomial, 4-5-6-7 polynomial, 5-6-7-8-9 polynomial and 19 more or another like them"),

    # motion programs
    (lambda: Rise(0, 1, Cycloidal()), "the angle of the rise is 0 deg; it must be a finite angle above 0 deg"),
    (lambda: Rise(1, NAN, Cycloidal()),
     "the lift of the rise is nan; it must be 0 or a number of at least 1e-150 (less than 0 is a return)"),
    (lambda: Dwell(-90 * deg), "the angle of the dwell is -90 deg; it must be a finite angle above 0 deg"),
    (lambda: MotionProgram(()), "the program is empty; it needs at least one rise, return or dwell"),
    (lambda: MotionProgram((Rise(4, 1, Cycloidal()), Return(3, 1, Cycloidal()))),
     "the program spans 401.07 deg; it can span at most 360 deg"),

    # studies
    (lambda: a_study(free=("wing",)), "'wing' is no quantity of DoorHandleCam; near it are lift_swing, relief_swing"),
    (lambda: a_study(free={"motion_law": (0.0, 1.0)}), f"0 is no option of the motion law; there are {LAWS}"),
    (lambda: a_study(free=()), "a study needs the names of one or more free quantities"),
    (lambda: a_study(minimise=()), "a study needs a tuple of one or more measures to minimise"),
    (lambda: a_study(free={"lift_arm": (60 * mm, 50 * mm)}),
     "the bounds of the lift arm are 60 mm and 50 mm; they must be finite, the first below the second"),
    (lambda: a_study(free={"lift_arm": (50 * mm, NAN)}),
     "the bounds of the lift arm are 50 mm and nan mm; they must be finite, the first below the second"),
    (lambda: a_study(free={"lift_arm": (-5 * mm, 50 * mm)}),
     "the bounds of the lift arm are -5 mm and 50 mm; each must be a finite number above 0 mm"),
    (lambda: a_study(at_most={height: 60}, at_least={height: 70}),
     "the height is to be at least 70000 mm and at most 60000 mm; no design can be both"),
    (lambda: explore(CAM, pressure_angle, at_most={height: 60}, at_least={height: 70}),
     "the height is to be at least 70000 mm and at most 60000 mm; no design can be both"),
    (lambda: explore(DoorHandleCam, pressure_angle),
     "the argument design is the class DoorHandleCam; it must be a design that can be analysed, such as a cam"),
    (lambda: explore(COLUMNS),
     "the design of the panel is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: explore(a_study()),
     "the argument design is a Study; it must be a design that can be analysed, such as a cam"),
    (lambda: picture(a_study()), "the picture needs one or more views"),
    (lambda: picture(DoorHandleCam, pressure_angle),
     "what the picture shows is the class DoorHandleCam; it must be a design that can be analysed, such as a cam"),
    (lambda: picture(COLUMNS),
     "what the picture shows is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: picture(COLUMNS.analyse(31)),
     "what the picture shows is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: picture(CAM, lambda: None), "the view <lambda> cannot show an analysis: too many positional arguments"),
    (lambda: picture(CAM, [lambda: None]), "one of the views is a list; it must be a function"),
    (lambda: side_by_side({"a": a_study()}),
     "a is a Study; it must be a design that can be analysed, such as a cam"),
    (lambda: side_by_side({"a": COLUMNS}),
     "a is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: explore(CAM, 3), "the argument views is (3,); it must be a tuple of which each is a function"),
    (lambda: picture(3, pressure_angle), "the view pressure angle does not apply to 3, which has no curves"),
    (lambda: picture(CAM, 3), "one of the views is 3; it must be a function"),
    (lambda: choose_panel(3),
     "the argument source is 3; it must be a panel with a front, such as `pareto_panel` gives"),
    (lambda: a_study().x_of(ROLLER), "the design is an OscillatingRollerCam; it must be a DoorHandleCam"),
    (lambda: a_study().x_of(DoorHandleCam),
     "the design is the class DoorHandleCam; it must be a design that can be analysed, such as a cam"),
    (lambda: a_study().x_of(COLUMNS),
     "the design is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: Session(a_study(), ROLLER), "the design is an OscillatingRollerCam; it must be a DoorHandleCam"),
    (lambda: Session(a_study(), a_study()),
     "the design is a Study; it must be a design that can be analysed, such as a cam"),
    (lambda: Study(a_study(), ("lift_arm",), (height,)),
     "the start of the study is a Study; it must be a design that can be analysed, such as a cam"),
    (lambda: Study(COLUMNS, ("lift_arm",), (height,)),
     "the start of the study is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: a_study(free={"lift_arm": np.array(1.0)}),
     "the bounds of the lift arm are an array of shape (); they must be two numbers"),
    (lambda: a_study(free={"lift_arm": {-0.05, 0.06}}),
     "one option of the lift arm is -50 mm; it must be a finite number above 0 mm"),
    (lambda: a_study(free={"lift_arm": {"short": 0.05, "long": "wide"}}),
     "one option of the lift arm is 'wide'; it must be a finite number above 0 mm"),
    (lambda: a_study().replace(nothing=1),
     "Study has no nothing; it has start, free, minimise, at_most, at_least, angles, rough"),
    (lambda: door_handle_study().with_weights((1, 1)), "there are 2 weights for the effort; it has 3 measures"),
    (lambda: door_handle_study().with_weights({1, 2, 3}),
     "the tuple of weights is {1, 2, 3}; it must be a tuple, with a place for each measure"),
    (lambda: a_study(at_most={height: NAN}), "the limit of the height is nan; it must be a finite number"),
    (lambda: door_handle_study().evaluate([[1.0, 2.0]]), "x has 2 columns; this study has 3 free quantities"),
    (lambda: lift_curve_study(space={"relief_arm": (70 * mm, 80 * mm)}),
     "the relief arm has no effect on what the study judges; it must not be free"),
    (lambda: lift_curve_study(DoorHandleCam(lift_load=ArmLoad(mass=0))),
     "the peak contact force, lift at the reference design is 0; it must be finite and not 0"),
    (lambda: weighted("sum", {height: -2}, (1,)),
     "the weight of the height is -2; it must be a finite number of at least 0"),
    (lambda: weighted("sum", {height: INF}, (1,)),
     "the weight of the height is inf; it must be a finite number of at least 0"),
    (lambda: weighted("sum", {height: 10**400}, (1,)),
     "the weight of the height is a very large number; it must be a finite number of at least 0"),
    (lambda: weighted("sum", {height: 1}, (10**400,)),
     "the height at the reference design is a very large number; it must be finite and not 0"),
    (lambda: weighted("sum", {height: 0}, (1,)), "every weight of the sum is 0; one or more must be above 0"),
    (lambda: a_study().with_weights(None),
     "the tuple of weights is None; it must be a tuple, with a place for each measure"),
    (lambda: a_study().with_weights((1, "2")),
     "the weight of measure 2 is '2'; it must be a finite number of at least 0"),
    (lambda: a_study(at_most={height: 20 * mm, -height: -30 * mm}),
     "the height is to be at least 30 mm and at most 20 mm; no design can be both"),
    (lambda: a_study(at_least={height: 30 * mm, -height: -20 * mm}),
     "the height is to be at least 30 mm and at most 20 mm; no design can be both"),
    (lambda: winner_map([[1, 2], [2, 1]], object()),
     "the rule is something else; it must be weighted_sum, topsis, knee, most_isolated or one like them"),
    (lambda: COLUMNS.analyse().bodies,
     "what is drawn is a population, a DoorHandleCam with columns; it must be one design"),
    (lambda: OscillatingRollerCam(arm_length=np.array([[0.05], [0.051]])).analyse().bodies,
     "what is drawn is a population, an OscillatingRollerCam with columns; it must be one design"),
    (lambda: ValveCam(max_lift=np.array([[0.012], [0.013]])).analyse().bodies,
     "what is drawn is a population, a ValveCam with columns; it must be one design"),
    (lambda: CamLever(lever=np.array([[0.2], [0.25]])).analyse().bodies,
     "what is drawn is a population, a HighSpeedCam with columns; it must be one design"),
    (lambda: UniversalJointShaft(power=np.array([[1e5], [2e5]])).sizes,
     "the shaft whose sizes are wanted is a population, a UniversalJointShaft with columns; it must be one design"),
    (lambda: UniversalJointShaft(outer_diameter=np.array([[0.12], [0.13]])).analyse().rings,
     "the shaft whose place is wanted is a population, a UniversalJointShaft with columns; it must be one design"),
    (lambda: explore(RSSR()),
     "the crank cannot sweep from 0 to 360 deg: the linkage can be assembled from -85.623 to 265.62 deg only; "
     "give it other sizes for a whole turn, or analyse a part of the turn"),

    # measures
    (lambda: Measure("h", "mm", lambda a: None)(3), "the h gives None; a measure gives real numbers, one or an array"),
    (lambda: Measure("h", "mm", lambda a: {1, 2})(3),
     "the h gives {1, 2}; a measure gives real numbers, one or an array"),
    (lambda: (-Measure("h", "mm", lambda a: (i for i in ())))(3),
     "the h gives a generator; a measure gives real numbers, one or an array"),
    (lambda: PeakMeasure("h", "mm", lambda a: [1, 2])(3),
     "the h gives [1, 2]; a measure gives real numbers, one or an array"),
    (lambda: PeakMeasure("h", "mm", lambda a: 3.0)(3),
     "the h gives 3; it is the largest value of a curve, its points last"),
    (lambda: PeakMeasure("h", "mm", lambda a: np.zeros((2, 0)))(3),
     "the h gives an array of shape (2, 0); it is the largest value of a curve, its points last"),
    (lambda: SumOfResiduals("h", "mm", lambda a: None)(3),
     "the h gives None; a measure gives real numbers, one or an array"),
    (lambda: height.text("x"), "the height is 'x'; it must be one number"),
    (lambda: height.text(np.ones((2, 1))), "the height is an array of shape (2, 1); it must be one number"),
    (lambda: departure(np.array([[0.5], [0.6]])),
     "the pressure angle that is aimed at is an array of shape (2, 1); it must be a finite number"),
    (lambda: max_departure(0.5, np.ones((2, 3))),
     "the weights of the positions have the shape (2, 3); they must be one for each position"),
    (lambda: departure(0.5, np.ones(5))(RSSR().analyse([0.1, 0.2])),
     "there are 5 weights for 2 positions; there must be one for each"),

    # searches
    (lambda: nsga2(door_handle_study(), population=3), "the population is 3; it must be a whole number of at least 4"),
    (lambda: nsga2(door_handle_study(), population=9.5),
     "the population is 9.5; it must be a whole number of at least 4"),
    (lambda: nsga2(door_handle_study(), seed=-1), "the seed is -1; it must be a whole number of at least 0"),
    (lambda: nsga2(door_handle_study(), seed=None), "the seed is None; it must be a whole number of at least 0"),

    # judgements
    (lambda: ahp([[1, 5], [1 / 4, 1]]),
     "judgement (1, 2) is 5 and judgement (2, 1) is 0.25; one must be 1 over the other "
     "(text such as '1/3' is exact, None leaves a place open)"),
    (lambda: ahp([[2, 5], [1 / 5, 1]]), "judgement (1, 1) is 2 and judgement (1, 1) is 2; the diagonal must be 1"),
    (lambda: ahp([]), "there are no judgements; those of a single criterion are [[1]]"),
    (lambda: ahp([NAN]), "no judgement connects criterion 1 with criterion 2; judge one such pair"),
    (lambda: ahp(["1/0"]), "'1/0' is no number above 0; 3, 1/5 or 0.4 are"),
    (lambda: Judgements(["effort", "radius"], [1e300]),
     "the judgement of effort against radius is 1e+300; nobody tells apart more than 1e+06 to 1"),
    (lambda: Judgements(["effort", "radius"], [[1, 5], [1 / 4, 1]]),
     "the judgement of effort against radius is 5 and the judgement of radius against effort is 0.25; one must be 1 "
     "over the other (text such as '1/3' is exact, None leaves a place open)"),
    (lambda: ahp([1e300]), "judgement (1, 2) is 1e+300; nobody tells apart more than 1e+06 to 1"),
    (lambda: ahp([[1, -5], [-1 / 5, 1]]), "judgement (1, 2) is -5; it must be a positive number"),
    (lambda: ahp([5, 0, 1]), "judgement (1, 3) is 0; it must be a positive number"),
    (lambda: ahp([5, INF, 1]), "judgement (1, 3) is inf; it must be a positive number"),
    (lambda: ahp([[1, 2, 3], [1, 2, 3]]), "the judgements have the shape (2, 3); they must be a square matrix"),
    (lambda: ahp([5, 1]), "2 judgements are not what is above the diagonal of a matrix; 1, 3, 6, 10, ... are"),
    (lambda: ahp([[1, 2], [1]]), "the judgements must be a square matrix of numbers, or what is above its diagonal"),
    (lambda: ahp([5], "mean"), "the method is 'mean'; there are 'eigenvector' and 'geometric'"),
    (lambda: ahp_panel(Judgements(["a", "b"], [1, 2, 3])), "there are 3 rows of judgements for 2 criteria"),

    # choosing
    (lambda: most_isolated(np.zeros((0, 2))), "the front is empty; there is no design to choose"),
    (lambda: most_isolated([1, 2]), "the front has the shape (2,); it must be a table, a row for each design"),
    (lambda: crowding_distance([[1, NAN], [2, 1]]), "the front has an objective that is not a finite number"),
    (lambda: topsis([[1, 2], [2, 1]], scale="sum"), "the scale is 'sum'; there are 'vector' and 'range'"),
    (lambda: weight_lattice(2, 2.5), "the number of steps is 2.5; it must be a whole number of at least 1"),
    (lambda: a_front().hypervolume(NAN),
     "the reference point is nan; it must be 2 finite numbers"),
    (lambda: a_front().hypervolume((1, NAN)),
     "the reference point is (1, nan); it must be 2 finite numbers"),
    (lambda: a_front(NAN).hypervolume((1, 1)), "the front has an objective that is not a finite number"),
    (lambda: topsis([[1, NAN]]), "the front has an objective that is not a finite number"),
    (lambda: topsis([[1, 2], [2, 1]], [1, 2, 3]), "there are 3 weights for 2 objectives"),
    (lambda: weighted_sum([[1, 2], [2, 1]], [1, -1]), "the weights must be finite, none negative, not all 0"),

    # files
    (lambda: from_json("[1, 2"), "the file is damaged: it is no JSON at line 1 (Expecting ',' delimiter)"),
    (lambda: from_json("{}"), "the file is JSON of another kind: it does not say which camkit schema it follows"),
    (lambda: from_json('{"schema": "camkit/2"}'),
     "the file follows the schema 'camkit/2'; this camkit reads 'camkit/1'"),
    (lambda: from_json('{"schema": "camkit/1"}'), 
     "the file is damaged: beside its schema it must hold one design, program, study, front or decision"),
    (lambda: a_file(kind="Boat"), "the file names a 'Boat', which this camkit does not know"),
    (lambda: a_file(wing=3), "the file has 'wing', which a door handle cam does not have"),
    (lambda: a_file(**{"lift_arm [mm]": "50"}),
     "the file says '50' for 'lift_arm [mm]'; it must be a finite number above 0 mm"),
    (lambda: a_file(**{"lift_arm [mm]": NAN}), "the file is damaged: it says NaN; every number must be finite"),
    (lambda: a_file(motion_law="wobbly"),
     "the file says 'wobbly' for 'motion_law'; there are simple harmonic, parabolic, cycloidal, modified trapezoid, "
     "modified sine, 3-4-5 polynomial, 4-5-6-7 polynomial, 5-6-7-8-9 polynomial and 19 more"),
    (lambda: from_json(to_json(CAM), Session), "the file holds a door handle cam; a study is wanted here"),

    # columns and paths
    (lambda: with_quantities(OscillatingRollerCam(), {
        "motion.rise.angle": np.array([[1.0], [1.1]]), "motion.return.angle": np.array([[1.0], [1.1], [1.2]])}),
     "the program has columns of 2 in its segment 1 and 3 in its segment 3; they must be equally long"),
    (lambda: DoorHandleCam(lift_arm=np.ma.masked),
     "the lift arm is a masked array; it must be a finite number above 0 mm, or a column of them of the shape "
     "(p, 1)"),
    (lambda: DoorHandleCam(lift_arm=np.ones((2, 1)).view(np.matrix)),
     "the lift arm is a matrix; it must be a finite number above 0 mm, or a column of them of the shape (p, 1)"),
    (lambda: ArmLoad(torque_table=ITSELF),
     "the torque table is [[...]]; it must hold pairs of numbers (travel, torque)"),
    (lambda: ArmLoad(torque_table=(DoorHandleCam, DoorHandleCam)),
     "the torque table is a tuple; it must hold pairs of numbers (travel, torque)"),
    (lambda: ahp(ITSELF), "the judgements must be a square matrix of numbers, or what is above its diagonal"),
    (lambda: OscillatingRollerCam().motion(NESTED), "the cam angles must be numbers; given is a list"),
    (lambda: declarations(5), "the design is 5; it must be a design, such as a cam, or a class of designs"),
    (lambda: Paths(CAM, 5), "the paths are 5; they must be a tuple of paths"),
    (lambda: Paths(CAM, "lift_arm"), "the paths are 'lift_arm'; they must be a tuple of paths"),
    (lambda: Paths(CAM, ["lift_arm"]).values(DoorHandleCam),
     "the design is the class DoorHandleCam; it must be a DoorHandleCam"),
    (lambda: contour_panel(explore(CAM, pressure_angle), {"a": a_study()}, {3: 1.0}),
     "the argument weights is {3: 1.0}; it must be a mapping such as {name: value}, each name a text"),

    # names
    (lambda: ArmLoad().replace(weight=1),
     f"ArmLoad has no weight; it has {', '.join(field.name for field in fields(ArmLoad))}"),
    (lambda: explore(CAM, pressure_angle, free=["arm"]),
     "'arm' is no path of DoorHandleCam; near it are lift_arm"),
]
# fmt: on


def _name(case):
    return case if isinstance(case, str) else ""


@pytest.mark.parametrize(("bad", "sentence"), REFUSALS, ids=_name)
def test_bad_input_gives_its_sentence(bad, sentence):
    with pytest.raises(ValueError) as refused:  # noqa: PT011  the whole sentence is compared
        bad()
    assert str(refused.value) == sentence


def test_there_are_sentences_for_at_least_25_kinds_of_bad_input():
    assert len({sentence for _, sentence in REFUSALS}) >= 25


def test_an_unknown_reference_is_refused_with_those_there_are():
    with pytest.raises(ValueError, match=r"^there is no reference 'boat'; there are .*door_handle"):
        reference("boat")


def test_an_unknown_unit_is_refused_with_the_units_there_are():
    with pytest.raises(ValueError, match=r"^the unit 'furlong' is not known; it must be .*, of m, g, .*, lbf, psi"):
        factor("furlong")


PYTHON = (
    r"object|NoneType|zip|\(\)|float:|inhomogeneous|unpack|ufunc|ambiguous|reshape|sequence|zero-size|argument|iter"
)
"""What a person who never programmed should not read."""

IN_WORDS = {
    "a torque table of three columns": lambda: DoorHandleCam(lift_load=ArmLoad(torque_table=((0, 1, 2),))),
    "a torque table of text": lambda: DoorHandleCam(lift_load=ArmLoad(torque_table="abc")),
    "a ragged torque table": lambda: DoorHandleCam(lift_load=ArmLoad(torque_table=((0, 1), (2,)))),
    "a torque table that goes back": lambda: DoorHandleCam(lift_load=ArmLoad(torque_table=((0, 1), (0, 2)))),
    "no cam angles": lambda: OscillatingRollerCam().analyse(0),
    "a negative number of cam angles": lambda: DoorHandleCam().analyse(-5),
    "one handle angle": lambda: DoorHandleCam().analyse(1),
    "a rotation for each": lambda: OscillatingRollerCam(rotation=np.array([[1], [-1]])),
    "a law that is none": lambda: DoorHandleCam(motion_law="cycloidal"),
    "one bound": lambda: a_study(free={"lift_arm": 50 * mm}),
    "three bounds": lambda: a_study(free={"lift_arm": (1, 2, 3)}),
    "bounds of text": lambda: a_study(free={"lift_arm": ("a", "b")}),
    "an objective that is a name": lambda: a_study(minimise=("height",)),
    "an objective by itself": lambda: a_study(minimise=height),
    "a limit of text": lambda: a_study(at_most={height: "45"}),
    "a limit on a name": lambda: a_study(at_most={"height": 45}),
    "no angles": lambda: a_study(angles=0),
    "too few weights": lambda: door_handle_study(weights=(1, 1)),
    "too many references": lambda: weighted("sum", {height: 1}, (1, 2)),
    "too few free values": lambda: door_handle_study().design([0.05, 0.38]),
    "a reference point of three": lambda: nsga2(door_handle_study(), 8, 1).hypervolume((1, 2, 3)),
    "judgements that are true or false": lambda: ahp([True]),
    "complex judgements": lambda: ahp([2 + 1j]),
    "judgements that are one number": lambda: ahp(5),
    "a judgement too large for a number": lambda: ahp([10**400]),
    "a stack of judgements": lambda: ahp(np.ones((2, 3, 3))),
    "judgements inside a judgement": lambda: ahp([[1, [2]], [3, 1]]),
    "a rule that is none": lambda: winner_map([[1, 2], [2, 1]], "TOPSIS"),
    "a rule for ranges that is none": lambda: judgement_ranges([[1, 2], [2, 1]], [3], None),
    "scales in a list": lambda: topsis([[1, 2], [2, 1]], scale=["vector"]),
    "weights of a matrix that is not square": lambda: judged_weights([[1, 2, 3], [1, 2, 3]]),
    "weights of a matrix of text": lambda: judged_weights("3"),
    "a front too large for numbers": lambda: topsis([[10**400, 1]]),
    "designs of text": lambda: a_study().evaluate("x"),
    "designs in a cube": lambda: a_study().evaluate(np.zeros((2, 2, 1))),
    "more weightings than there is room for": lambda: weight_lattice(30, 10**6),
    "a complex front": lambda: topsis([[1, 2j], [2, 1]]),
    "a ragged front": lambda: topsis([[1, 2], [1]]),
    "weights of text": lambda: topsis([[1, 2], [2, 1]], ["a", "b"]),
    "a profile of many": lambda: write_table(DoorHandleCam(lift_arm=np.array([[0.05], [0.06]])), "profile.csv"),
    "a file that is not there": lambda: read("no such file.json"),
}


@pytest.mark.parametrize("bad", IN_WORDS.values(), ids=IN_WORDS.keys())
def test_bad_input_is_refused_in_words(bad):
    """Whatever the wording: a ``ValueError`` (or that a file is missing) in a person's language, when it is given."""
    with pytest.raises((ValueError, FileNotFoundError), match=rf"^(?!.*({PYTHON})).*"):
        bad()


def test_free_paths_may_come_in_an_array():
    arms = explore(CAM, pressure_angle, free=np.array(["lift_arm", "relief_arm"]))
    assert sliders(arms) == ["lift_arm", "relief_arm"]
