"""Files from anywhere: what camkit wrote comes back, whatever the study; anything else is told in a sentence."""

import copy
import importlib
import inspect
import json
import math
import pkgutil
import re
from collections import Counter
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hand import file_of
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from sheets import click

import camkit
from camkit import (
    ArmLoad,
    DoorHandleCam,
    HighSpeedCam,
    Judgements,
    Measure,
    OscillatingRollerCam,
    Study,
    TranslatingRollerCam,
    ValveCam,
    ahp,
    ahp_panel,
    door_handle_study,
    explore,
    high_speed_study,
    nsga2,
    pareto_panel,
    quantity,
    read,
    rssr_study,
    valve_study,
    write,
)
from camkit.dynamics import ElasticFollower
from camkit.files import Session, from_json, read_json, to_json
from camkit.files.entries import MOST_ROWS, exact_in_unit, fits
from camkit.files.json_file import EDITED, UNMARKED
from camkit.linkage.measures import departure, excess
from camkit.linkage.space import Box
from camkit.machines import lift_curve_study
from camkit.machines.cam_lever import CamLever
from camkit.machines.door_handle import CURVE_TABLE, DOOR_HANDLE_SPACE, EXPANDED_SPACE, PAPER_JUDGEMENTS, PAPER_SPACE
from camkit.machines.valve_measures import corrected_valve_study
from camkit.motion import Cycloidal, Dwell, Law, MotionProgram, Poly345, Return, Rise, Segment, Skewed
from camkit.motion.families.shaped import SPLINE, Family, ShapedLaw
from camkit.panels import Instrument
from camkit.papers.high_speed_cam import with_printed_sizes
from camkit.quantities import Design, Quantity, declarations
from camkit.search.front import front_of
from camkit.study.weighted import WeightedSum, weighted
from camkit.units import deg, factor, mm
from camkit.views import pressure_angle

FILES = Path(__file__).parents[1] / "data" / "files"
PYTHON = "object|NoneType|zip|int\\(|float:|inhomogeneous|unpack|multiply|subscript|iterable|dataclass|literal|argument"
"""What a person who never programmed should not read."""


def of_camkit(kind):
    return kind.__module__.startswith("camkit.")


MODULES = [
    importlib.import_module(found.name)
    for found in pkgutil.walk_packages(camkit.__path__, "camkit.")
    if "panels" not in found.name
]


def below(kind):
    for inner in kind.__subclasses__():
        yield inner
        yield from below(inner)


# ---------------------------------------------------------------- every study and every design of the package


def studies():
    """Every function of the package that makes a study without being told anything."""
    found = {}
    for module in MODULES:
        for name, thing in vars(module).items():
            if inspect.isfunction(thing) and thing.__annotations__.get("return") in ("Study", Study):
                needed = [p for p in inspect.signature(thing).parameters.values() if p.default is p.empty]
                if not needed and not name.startswith("_") and of_camkit(thing):
                    found[name] = thing
    return found


STUDIES = studies() | {
    "whole cam, expanded": partial(door_handle_study, space=EXPANDED_SPACE),
    "valve, printed sign": partial(valve_study, printed_sign=True),
    "valve, paper's units": partial(valve_study, paper_units=True),
    "valve, widened": partial(corrected_valve_study, ValveCam(base_radius=24.5 * mm)),
    "high speed, free laws": partial(high_speed_study, free_laws=True),
    "high speed, printed sizes": lambda: with_printed_sizes("table 1, wear with F_sigma at most 2"),
    "door, own box": partial(rssr_study, min_swing=50 * deg, inside=Box((-1, -1, -1), (1, 1, 1), "the room")),
    "door, another housing": partial(rssr_study, inside=Box((-1, -1, -1), (1, 1, 1), "the housing")),
    "door, around a post": partial(rssr_study, objective=excess(20 * deg), outside=Box((1,) * 3, (2,) * 3, "a post")),
    "door, another target": partial(rssr_study, objective=departure(25 * deg)),
}


def alike(first, second):
    """Whether two measures are the same number."""
    if not isinstance(first, WeightedSum):
        return first == second
    same = (first.name, first.sign, first.parts, first.weights) == (
        second.name,
        second.sign,
        second.parts,
        second.weights,
    )
    return same and np.allclose(first.reference, second.reference, rtol=1e-14)


def test_a_study_alone_is_saved_as_the_session_at_its_start():
    study = lift_curve_study()
    found = from_json(to_json(study))
    assert isinstance(found, Session)
    assert found.design == study.start
    assert found.study.x0.tolist() == study.x0.tolist()


def test_every_kind_of_mechanism_has_a_study_here():
    assert {type(make().start).__name__ for make in STUDIES.values()} >= {
        "DoorHandleCam", "ValveCam", "HighSpeedCam", "CamLever", "CabinDoorLinkage", "UniversalJointShaft",
    }  # fmt: skip


@pytest.mark.parametrize("name", STUDIES)
def test_every_study_comes_back(name):
    study = STUDIES[name]()
    found = read_json(to_json(Session(study, study.start)))
    again = found.thing.study
    assert found.remarks == ()
    assert (again.start, list(again.free), again.angles) == (study.start, list(study.free), study.angles)
    assert_array_equal(again.bounds, study.bounds)
    assert len(again.minimise) == len(study.minimise)
    assert all(map(alike, again.minimise, study.minimise))
    for mine, theirs in zip(again.limits, study.limits, strict=True):
        assert alike(mine[0], theirs[0])
        assert mine[2] == theirs[2]
        assert math.isclose(mine[1], theirs[1], rel_tol=1e-15)
    x = np.random.default_rng(1).uniform(*study.bounds, (20, len(study.free)))
    before, after = study.evaluate(x), again.evaluate(x)
    assert_allclose(after.f, before.f, rtol=1e-12)
    assert_allclose(after.g, before.g, rtol=1e-9, atol=1e-12)


DESIGNS = [kind for kind in dict.fromkeys(below(Design)) if of_camkit(kind) and not inspect.isabstract(kind)]


def test_every_design_that_the_package_has_is_of_a_mechanism_or_of_its_making():
    """A file may name each of them: a textbook problem of the benchmarks is none of camkit's."""
    assert {kind.__module__.split(".")[1] for kind in DESIGNS} == {"cam", "linkage", "dynamics", "machines", "files"}


@pytest.mark.parametrize("kind", DESIGNS, ids=lambda kind: kind.__name__)
def test_every_design_comes_back(kind):
    plain = design = kind(TranslatingRollerCam()) if kind is ElasticFollower else kind()
    for name, declared in declarations(kind).items():
        value = getattr(design, name)
        if isinstance(declared, Quantity):
            try:
                design = design.replace(**{name: float(np.nextafter(value * 1.0009765625, 1e9))})
            except ValueError:  # no such design; the next quantity
                continue
    for one in (plain, design):
        found = read_json(to_json(one), kind)
        assert found.remarks == ()
        for name, declared in declarations(kind).items():
            if isinstance(declared, Quantity):
                assert math.isclose(getattr(found.thing, name), getattr(one, name), rel_tol=3e-16), name
        assert to_json(found.thing) == to_json(one)
    assert from_json(to_json(plain)) == plain


@given(
    st.sampled_from(["mm", "deg", "rpm", "%", "kN m", "N^0.5 mm^-0.5", "in", "psi", "mm/rad^2", "MPa"]),
    st.floats(1e-9, 1e9),
)
@settings(max_examples=300, deadline=None)
def test_a_number_in_its_unit_is_the_number_that_gives_it_back(unit, value):
    """To the last bit where there is such a number, else to the last but one."""
    again = exact_in_unit(value, unit) * factor(unit)
    near = [value / factor(unit) * (1 + k * 2**-53) for k in range(-3, 4)]
    assert again == value or (
        math.isclose(again, value, rel_tol=1e-14) and value not in [v * factor(unit) for v in near]
    )


SHAPED = ShapedLaw(Poly345(), (0.1, -0.2, 0.0, 0.05))


@pytest.mark.parametrize(
    "law", [SHAPED, replace(SHAPED, family=SPLINE), ShapedLaw(Skewed(Cycloidal(), 0.4), (0.1,) * 4)]
)
def test_a_cam_with_a_shaped_law_comes_back(law):
    cam = OscillatingRollerCam(motion=MotionProgram((Rise(1.1, 0.4, law), Dwell(0.2), Return(0.9, 0.3, law))))
    assert from_json(to_json(cam)) == cam
    fast = HighSpeedCam(rise_law=SHAPED)
    assert from_json(to_json(fast), HighSpeedCam) == fast


def own_law(name):
    return dataclass(frozen=True)(type(name, (Cycloidal,), {"__annotations__": {}, "name": "my own"}))


def test_a_class_that_would_be_read_as_another_is_not_written():
    def cam(law):
        return OscillatingRollerCam(motion=MotionProgram((Rise(1.0, 0.3, law),)))

    with pytest.raises(ValueError, match=r"^the law of the rise is a Poly345 of your own, .* as camkit's: give"):
        to_json(cam(own_law("Poly345")()))
    older, newer = own_law("LawOfMyOwn"), own_law("LawOfMyOwn")
    assert from_json(to_json(cam(newer()))) == cam(newer())
    with pytest.raises(ValueError, match=r"^the law of the rise is a LawOfMyOwn of your own, .* as another one of yo"):
        to_json(cam(older()))


def long_laws(kind, *lengths):
    """Rises whose laws have so many points each, as a file says it."""
    more = {"start": [0, 0], "end": [0, 0]} if kind == "SplineLaw" else {"tolerance": 1.0}
    rows = [np.linspace(0, 1, n + 2)[1:-1] if kind == "SplineLaw" else np.linspace(0, 1, n) for n in lengths]
    laws = [{"kind": kind, "u": row.tolist(), "s": row.tolist(), **more} for row in rows]
    angle = 6 / len(laws)
    return [{"kind": "Rise", "angle": angle, "lift": 0.001, "law": law} for law in laws]


@pytest.mark.parametrize(
    ("kind", "lengths", "sentence"),
    [("SplineLaw", [300] * 5, "knots of splines"), ("TableLaw", [1500, 1500, 1001], "rows of tables of motion")],
)
def test_laws_that_would_take_long_together_are_refused(kind, lengths, sentence):
    content = json.loads(GOOD["program"])
    content["design"]["motion"]["segments"] = long_laws(kind, *lengths)
    with pytest.raises(ValueError, match=f"^the file has more than [0-9]+ {sentence} in all; they would take too long"):
        read_json(json.dumps(content))


@pytest.mark.parametrize(("kind", "lengths"), [("SplineLaw", [30] * 36), ("TableLaw", [3600])])
def test_laws_as_long_as_users_have_them_are_read(kind, lengths):
    content = json.loads(GOOD["program"])
    content["design"]["motion"]["segments"] = long_laws(kind, *lengths)
    cam = read_json(json.dumps(content)).thing
    assert len(cam.motion.segments) == len(lengths)
    study = Study(cam, ("roller_radius",), cam.measures[:1])
    assert read_json(to_json(Session(study, cam)), Session).thing.design == cam


def test_what_no_file_can_hold_is_refused_for_its_true_reason():
    family = Family("mine", lambda c: Cycloidal(), 1.0)
    one = MotionProgram((Rise(1.0, 0.3, replace(SHAPED, family=family)),))
    cases = {
        "the family of the shaped law is a family, which no file can hold": OscillatingRollerCam(motion=one),
        "the force curve of the cam lever is a function of one's own, which no file can hold": CamLever(
            force_curve=lambda s: 100 + 1e4 * s
        ),
    }
    for sentence, design in cases.items():
        with pytest.raises(ValueError, match=f"^{sentence}$"):
            to_json(design)


# ---------------------------------------------------------------- measures of one's own, fronts, judgements

slack = Measure("slack of the arm", "mm", lambda a: a.lift.pitch_radius.min(-1) - 30 * mm)
plain = door_handle_study()
owned = plain.replace(minimise=(-slack, plain.minimise[0]), at_least={slack: 1 * mm})


def test_a_measure_of_ones_own_comes_back_when_it_is_handed_over(tmp_path):
    write(Session(owned, owned.start), tmp_path / "own.json")
    again = read(tmp_path / "own.json", Session, measures=(slack,), tell=pytest.fail).study
    assert again.minimise[0] == -slack
    assert again.minimise[0].function is slack.function
    assert dict(again.at_least) == {slack: 1 * mm}
    with pytest.raises(ValueError, match=r"the measure 'slack of the arm \[mm\]', which its mechanism does not have"):
        read(tmp_path / "own.json")


def test_a_measure_of_ones_own_under_a_name_of_the_mechanism_is_not_written():
    """It would be read as the mechanism's."""
    false = Measure("base radius (pitch), lift", "mm", lambda a: 2 * a.lift.pitch_radius.min(-1))
    with pytest.raises(
        ValueError, match=r"^the base radius \(pitch\), lift of this study is not what a door handle cam has"
    ):
        to_json(Session(plain.replace(minimise=(false,)), plain.start))


def test_parts_of_either_sign_and_limits_on_a_weighted_sum_come_back():
    effort, radius = plain.minimise
    total = weighted("sum of both", {radius: 0.25, effort.parts[0]: 0.75}, (30 * mm, 0.5))
    study = plain.replace(
        minimise=(total, -effort.parts[1]), at_most={total: 2.5, effort: 1.5}, at_least={radius: -1.0}
    )
    again = from_json(to_json(Session(study, study.start))).study
    assert_array_equal(again.evaluate(again.x0).f, study.evaluate(study.x0).f)
    assert_allclose(again.evaluate(again.x0).g, study.evaluate(study.x0).g, rtol=1e-12)


@pytest.mark.parametrize("turn", [sorted, lambda items: sorted(items, reverse=True)])
def test_the_order_of_names_in_a_file_is_no_matter(turn):
    """What sorts the names of a JSON object may not exchange columns of the front or references of a sum."""
    effort, radius = plain.minimise
    total = weighted("sum of both", {radius: 0.25, effort.parts[0]: 0.75}, (30 * mm, 0.5))
    study = plain.replace(minimise=(total, -radius), at_most={effort: 1.5}, at_least={})
    front = nsga2(study.replace(at_most={}), 20, 3, 1)
    text = to_json(Session(study.replace(at_most={}), study.start, front=front))
    content = json.loads(text, object_pairs_hook=lambda items: dict(turn(items)))
    again, first = read_json(json.dumps(content)).thing, read_json(text).thing
    assert list(again.study.free) == list(study.free)
    assert again.study.minimise[0].parts == total.parts
    assert again.study.minimise[0].reference == first.study.minimise[0].reference
    assert_array_equal(again.front.x, first.front.x)
    assert_array_equal(again.front.f, first.front.f)
    limited = json.loads(to_json(Session(study, study.start)), object_pairs_hook=lambda items: dict(turn(items)))
    ((limit, _, _),) = read_json(json.dumps(limited)).thing.study.limits
    assert limit.parts == effort.parts
    assert_allclose(limit.reference, effort.reference, rtol=1e-14)


def test_columns_and_references_of_something_else_are_refused():
    def spoiled(change):
        content = json.loads(to_json(Session(plain, plain.start)))
        change(content["session"])
        with pytest.raises(ValueError, match=r"^the file (says .* for '(columns|weights)'|is damaged: the reference)"):
            read_json(json.dumps(content))

    spoiled(lambda session: session["columns"].pop())
    spoiled(lambda session: session["columns"].append(3))
    spoiled(lambda session: session["minimise"][0]["reference"].popitem())
    spoiled(lambda session: session["minimise"][0]["weights"].append(session["minimise"][0]["weights"][0]))
    spoiled(lambda session: session["minimise"][0]["weights"].append("x"))


@pytest.mark.parametrize("sign", [1, -1])
def test_an_objective_that_its_mechanism_declares_with_a_minus_keeps_its_sign(sign):
    study = high_speed_study()
    margin = next(m for m in HighSpeedCam.measures if m.sign < 0)
    wanted = margin if sign == margin.sign else -margin
    assert from_json(to_json(Session(study.replace(minimise=(wanted,)), study.start))).study.minimise == (wanted,)


@pytest.mark.parametrize(
    "how",
    [[], [5], ["room"], ["room in"], ["room in", [0, 0], [1, 1], "the room"], ["departure", "x"], ["departure", None],
     ["room in", [-1, -1, -1], [1, 1, 1], "another room"], ["room in", [1, 1, 1], [-1, -1, -1], "the room"], "room in"],
)  # fmt: skip
def test_a_measure_that_a_file_cannot_make_is_refused(how):
    study = rssr_study(inside=Box((-1, -1, -1), (1, 1, 1), "the room"))
    content = json.loads(to_json(Session(study, study.start)))
    content["session"]["made"] = {"room within the room [mm]": how}
    with pytest.raises(ValueError, match=r"^the file is damaged: .*room within the room"):
        read_json(json.dumps(content))


@pytest.fixture(scope="module")
def front():
    return nsga2(lift_curve_study(), 24, 12, 1)


def test_a_front_alone_is_saved(front, tmp_path):
    write(front, tmp_path / "front.json")
    again = read(tmp_path / "front.json", tell=pytest.fail)
    assert type(again) is type(front)
    assert_allclose(again.x, front.x, rtol=1e-15)
    assert_allclose(again.f, front.f, rtol=1e-12)
    assert again.record == {**front.record, "versions": dict(front.record["versions"])}
    assert again[2] == again.study.design(again.x[2])
    as_work = read(tmp_path / "front.json", Session)
    assert_array_equal(as_work.front.x, again.x)
    assert as_work.design == front.study.start


def test_an_empty_front_says_again_what_stood_in_the_way():
    tight = plain.replace(at_most={plain.minimise[0].parts[0]: 1 * deg})
    empty = nsga2(tight, 8, 2, 1)
    again = from_json(to_json(empty))
    assert len(again) == 0
    assert again.message == empty.message != ""


def worst_corner(front):
    """A design between the bounds, as it stands in a file, that is beaten or misses a limit."""
    study = front.study
    x = np.array(list(np.ndindex((2,) * len(study.free))))
    corners = np.take_along_axis(study.bounds, x, 0)
    told = study.evaluate(corners)
    beaten = (told.f[:, None] > front.f).all(-1).any(-1)
    declared = declarations(study.start)
    row = corners[np.flatnonzero(~told.feasible | beaten)[0]]
    return [v / declared[n].factor for n, v in zip(study.free, row, strict=True)]


@pytest.mark.parametrize("end", [0, 1])
def test_a_front_outside_the_bounds_of_its_study_is_refused(front, end):
    content = json.loads(to_json(front))
    declared = declarations(front.study.start)
    name, bounds = next(iter(front.study.free.items()))
    factor = declared[name].factor
    content["front"]["front"][3][0] = bounds[end] / factor
    read_json(json.dumps(content))  # on the bound
    content["front"]["front"][3][0] = (bounds[end] + (end - 0.5) * 1e-3) / factor
    refused = "^the front of the file has a design outside the bounds of its study: design 4 has .* for '.*'; the"
    for kind in (None, Session):
        with pytest.raises(ValueError, match=refused):
            read_json(json.dumps(content), kind)


def test_designs_of_an_edited_front_that_miss_a_limit_are_left_out_with_a_remark(front):
    content = json.loads(to_json(front))
    content["front"]["front"][3] = worst_corner(front)
    found = read_json(json.dumps(content))
    assert len(found.thing) == len(front) - 1
    assert EDITED in found.remarks
    assert found.remarks[-1].startswith(f"1 of its {len(front)} designs miss a limit or are dominated")


def test_judgements_come_back_with_names_gaps_and_method():
    judgements = {
        "criteria": Judgements(("angle", "<force>", "torque"), ["1/3", None, 7], "geometric"),
        "importance": ahp([[1, "4"], ["1/4", 1]]),
    }
    assert from_json(to_json(Session(plain, plain.start, judgements))).judgements == judgements
    for wrong in ("much", True, object(), [1, 2, 3]):
        with pytest.raises(ValueError, match=r"^the judgements is .*, each value a Judgements or a Judges$"):
            to_json(Session(plain, plain.start, {"criteria": wrong}))


@pytest.mark.parametrize(("entry", "method"), [([5, None, 1], "geometric"), ([[1, 3], [1 / 3, 1]], None)])
def test_judgements_of_0_1_0_are_read(entry, method):
    """A list above the diagonal, or a matrix, without names; the method stood beside it, if at all."""
    content = json.loads(GOOD["session"])
    content["session"] |= {"judgements": {"criteria": entry}, "methods": {"criteria": method} if method else {}}
    assert from_json(json.dumps(content)).judgements == {"criteria": ahp(entry, method)}


# ---------------------------------------------------------------- files of yesterday, edited, damaged

OLD = ["design_of_camkit_0_1.json", "program_of_camkit_0_1.json", "study_of_camkit_0_1.json"]


@pytest.mark.parametrize("name", OLD)
def test_files_of_camkit_0_1_still_load(name):
    """Written before files had a digest; the default spelled out in a new file is what they were read with."""
    told = []
    thing = read(FILES / name, tell=told.append)
    assert told[0] == f"{name}: {UNMARKED}"
    written, now = (numbers_in(json.loads(text)) for text in ((FILES / name).read_text(), to_json(thing)))
    assert not written - now
    assert isinstance(thing, Session) or read_json(to_json(thing)).thing == thing
    (thing.study.evaluate(thing.front.x) if isinstance(thing, Session) else thing.analyse())


def numbers_in(content):
    """Every number with a decimal point in a file, and how often it stands there."""
    inner = content.values() if isinstance(content, dict) else content if isinstance(content, list) else ()
    return sum(map(numbers_in, inner), Counter([content] if isinstance(content, float) else []))


def test_the_old_files_hold_what_was_saved():
    design = read(FILES / OLD[0], DoorHandleCam, tell=list)
    assert (design.lift_arm, design.lift_start_angle, design.motion_law) == (48.09 * mm, 20.5 * deg, Poly345())
    assert design.lift_load.torque_table == ((0.0, 1.0), (0.5, -2.25))
    program = read(FILES / OLD[1], OscillatingRollerCam, tell=list)
    assert program.motion.segments[1] == Rise(1.1, 0.4, Skewed(Poly345(), 0.4))
    work = read(FILES / OLD[2], Session, tell=list)
    assert work.front.x.shape == (20, 3)
    assert work.judgements == {"criteria": ahp([5.0, 5.0, 1.0]), "importance": ahp([1 / 3])}
    assert work.search["rule"] == "weighted sum"


SOME = np.random.default_rng(0).uniform(*plain.bounds, (2000, len(plain.free))).round(3)
FEW = front_of(plain.evaluate(SOME.clip(*plain.bounds)), plain)
FEW = replace(FEW, x=FEW.x[:2], f=FEW.f[:2])
GOOD = {
    "design": to_json(DoorHandleCam(lift_load=ArmLoad(torque_table=((0.0, 1.0), (0.5, -2.25))))),
    "program": to_json(
        OscillatingRollerCam(
            motion=MotionProgram((Rise(1.1, 0.4, SHAPED), Dwell(0.2), Return(0.9, 0.3, Skewed(Cycloidal(), 0.4))))
        )
    ),
    "session": to_json(
        Session(
            plain, plain.start, {"criteria": ahp([5.0, 5.0, 1.0], "geometric"), "importance": ahp([2.0])},
            {"population": 24, "generations": 12, "seed": 1, "mode": "lift curve alone", "rule": "weighted sum"},
            replace(
                FEW,
                record={"population": 24, "generations": 12, "seed": 1, "seconds": 1.5, "versions": {"numpy": "2.4.6"}},
            ),
        )
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", GOOD)
def test_every_flipped_digit_is_noticed(name):
    """Refused, or read with the remark that the content does not match its digest; the last of each row of digits."""
    text = GOOD[name]
    places = [digits.end() - 1 for digits in re.finditer(r"\d+", text)]
    for i in places:
        flipped = text[:i] + str((int(text[i]) + 1) % 10) + text[i + 1 :]
        try:
            found = read_json(flipped)
        except ValueError:
            continue
        assert found.remarks[0] == EDITED, text[i - 30 : i + 10]
    assert len(places) > 70


def test_spaces_and_line_ends_are_no_change_of_content():
    text = GOOD["session"]
    for other in (text.replace("\n", "\r\n"), json.dumps(json.loads(text)), json.dumps(json.loads(text), indent=4)):
        assert read_json(other).remarks == ()


def test_a_field_that_is_lacking_takes_its_default_with_a_remark():
    content = json.loads(to_json(DoorHandleCam(lift_arm=48 * mm)))
    del content["design"]["motion_law"], content["design"]["lift_load"]["gravity [m/s^2]"]
    del content["design"]["lift_load"]["torque_table"]
    found = read_json(json.dumps(content))
    assert found.thing == DoorHandleCam(lift_arm=48 * mm)
    assert "lacks" in found.remarks[1]
    assert "'motion_law' of the door handle cam" in found.remarks[1]
    program = json.loads(GOOD["program"])
    del program["design"]["motion"]["segments"][0]["lift"]
    with pytest.raises(ValueError, match=r"^the file lacks 'lift' of the rise$"):
        read_json(json.dumps(program))


@pytest.mark.parametrize("name", ["design", "at_most", "at_least", "angles", "judgements", "search", "front"])
def test_a_study_that_lacks_an_entry_takes_its_default_with_a_remark(name):
    content = json.loads(GOOD["session"])
    del content["session"][name]
    found = read_json(json.dumps(content))
    assert f"{name!r} of the study" in found.remarks[1]
    assert found.thing.study.angles == 361


# ---------------------------------------------------------------- hostile files

HOSTILE = {
    "evil_study.json": r"^the file has the name 'effort<img src=x.*'; a name has up to 100 letters, digits, spaces",
    "motion_is_number.json": r"^the file says 0 for 'motion'; a motion program belongs there$",
    "empty_row_table.json": r"^the file says \[\[\]\] for 'door_torque_table'; a list of pairs of numbers belongs",
    "angles_study.json": r"^the file's 'angles' is 1000000000; it must be a whole number of at most 20001$",
}


@pytest.mark.parametrize(("name", "sentence"), HOSTILE.items(), ids=HOSTILE)
def test_a_hostile_file_is_refused_in_a_sentence(name, sentence):
    with pytest.raises(ValueError, match=sentence) as refused:
        read(FILES / name)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


def design_with(*path, to, of="design"):
    return changed(GOOD[of], "design", *path, to=to)


def changed(text, *path, to):
    """``text`` with one entry changed."""
    content = json.loads(text)
    *way, last = path
    inner = content
    for step in way:
        inner = inner[step]
    inner[last] = to
    return json.dumps(content)


work_with = partial(changed, GOOD["session"], "session")
row = [50.0, 22.0, 75.0]
ABSURD = {
    "lists 600 deep": ('{"schema": "camkit/1", "design": ' + "[" * 600 + "]" * 600 + "}", "nested too deeply"),
    "designs 600 deep": (
        '{"schema": "camkit/1", "design": ' + '{"kind": "Skewed", "law": ' * 600 + "0" + "}" * 601, "nested too deeply"
    ),
    "5000 digits": (GOOD["design"].replace("75.0", "7" * 5000), "it has a whole number of 5000 digits"),
    "400 digits": (GOOD["design"].replace("75.0", "7" * 400), "it has a whole number of 400 digits"),
    "1e300": (GOOD["design"].replace("75.0", "1e300"), "it says 1e300; no number of a design is as large"),
    "1e999": (GOOD["design"].replace("75.0", "-1e999"), "it says -1e999"),
    "NaN": (GOOD["design"].replace("75.0", "NaN"), "it says NaN; every number must be finite"),
    "infinity": (GOOD["design"].replace("75.0", "-Infinity"), "it says -Infinity"),
    "a field twice": (GOOD["design"].replace('"friction"', '"friction": 1, "friction"'), "'friction' twice"),
    "a front of 200000": (work_with("front", to=[row] * 200_000), "more than 200000 entries"),
    "a front of 6000": (work_with("front", to=[row] * 6000), f"6000 entries in 'front'; .* at most {MOST_ROWS}"),
    "too many points": (
        changed(work_with("front", to=[row] * 4000), "session", "angles", to=20_000), "4000 designs at 20000 angles"
    ),
    "a long table": (
        design_with("lift_load", "torque_table", to=[[i, 1] for i in range(6000)]), "of 6000 entries"
    ),
    "a program of 600 segments": (
        design_with("motion", "segments", of="program", to=[{"kind": "Dwell", "angle": 0.01}] * 600), "of 600 entries"
    ),
    "a spline of 400 knots": (
        design_with("motion_law", to={"kind": "SplineLaw", "u": [0.002 * i for i in range(1, 400)], "s": []}),
        "of 399 entries; there can be at most 300",
    ),
    "a huge population": (work_with("search", "population", to=10**9), "the file's 'population' is 1000000000; it"),
    "a huge number of generations": (work_with("search", "generations", to=10**12), "the file's 'generations' is"),
    "a negative seed": (work_with("search", "seed", to=-1), "the file's 'seed' is -1; it must"),
    "no judgement at all": (work_with("judgements", to={"criteria": [None, None, None]}), "no judgement connects"),
    "text among judgements": (work_with("judgements", to={"criteria": [5, "1/3", 1]}), "where numbers belong"),
    "an unknown method": (work_with("judgements", "criteria", "method", to="dice"), "the method is 'dice'"),
    "a script as a name": (work_with("judgements", to={"<script>": [5, 5, 1]}), "the file has the name '<script>'"),
    "a formula as a name": (work_with("minimise", 0, "name", to="=1+2"), "the file has the name '=1"),
    "a name of two lines": (work_with("search", "rule", to="weighted\nsum"), "the file has the name"),
    "a script as a version": (work_with("record", "versions", "numpy", to="<b>"), "the file has the name '<b>'"),
    "a class of Python": (design_with("kind", to="Path"), "the file names a 'Path'"),
    "a list as a kind": (design_with("kind", to=["x"]), r"it says \['x'\] for 'kind', where a name belongs"),
    "a law without a kind": (design_with("motion_law", to={}), "it says an empty dict without a kind"),
    "a load of no kind": (
        design_with("load", "kind", of="program", to=None), "it says None for 'kind', where a name belongs"
    ),
    "a load as a law": (
        design_with("motion_law", to={"kind": "ArmLoad"}), "for 'motion_law'; there are simple"
    ),
    "a friction as a load": (
        design_with("load", of="program", to={"kind": "Friction"}), "for 'load'; an arm load belongs there"
    ),
    "true as a number": (design_with("rotation", of="program", to=True), "for 'rotation'; there are counter-cl"),
    "half a rotation": (design_with("rotation", of="program", to=1.0), "for 'rotation'; there are counter-cl"),
    "a groove of text": (design_with("groove", of="program", to="no"), "for 'groove'; there are groove, plate"),
    "a table of bare numbers": (
        design_with("lift_load", "torque_table", to=[1.0, 2.0]), "a list of pairs of numbers"
    ),
    "an angle of text": (
        design_with("motion", "segments", 1, "angle", of="program", to="12"), "for 'angle'; a number belongs"
    ),
    "two things in one file": (
        json.dumps(json.loads(GOOD["session"]) | json.loads(GOOD["design"])),
        "hold one design, program",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("text", "sentence"), ABSURD.values(), ids=ABSURD)
def test_an_absurd_file_is_refused_in_a_sentence(text, sentence):
    with pytest.raises(ValueError, match=f"^the file .*{sentence}|^{sentence}") as refused:
        read_json(text)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 300


RUBBISH = (
    None, True, 3, 2.5, -1e29, "x", "<img src=x onerror=alert(1)>", "x" * 10_000, [], {}, [[]], [None], ["x"],
    [1.0, 2.0], {"kind": 3}, {"kind": "Cycloidal"}, {"kind": "Friction"}, {"x": 1},
)  # fmt: skip


def places(content, path=()):
    """The way to every entry of a file, however deep."""
    if path:
        yield path
    inner = content.items() if isinstance(content, dict) else enumerate(content) if isinstance(content, list) else ()
    for step, value in inner:
        yield from places(value, (*path, step))


def json_kind(value):
    return float if isinstance(value, int) and not isinstance(value, bool) else type(value)


@pytest.mark.parametrize("name", GOOD)
def test_a_wrong_kind_in_any_field_is_refused_or_changes_nothing_that_breaks(name):
    """Every entry by every rubbish: one sentence; what is read all the same can be analysed or says why not.

    What stands inside a session's design is left as it is: it is read and analysed as that of a file of its own.
    """
    content = json.loads(GOOD[name])
    del content["digest"]
    tried = refused = 0
    for *way, last in places(content):
        if way[:2] == ["session", "design"]:
            continue
        inner = content
        for step in way:
            inner = inner[step]
        good = inner[last]
        for rubbish in RUBBISH:
            inner[last] = copy.deepcopy(rubbish)
            tried += 1
            found, sentence = told_of(partial(read_json, json.dumps(content)))
            assert not re.search(f"{PYTHON}|\n", sentence), sentence
            assert len(sentence) < 500
            refused += bool(sentence)
            if found:
                not_judged = "judgements" in way and (rubbish is None or rubbish == [])  # a gap; a list of 0.1.0
                chosen = {"law": {"kind": "Cycloidal"}, "base": {"kind": "Cycloidal"}, "rotation": 1, "groove": True}
                an_option = next((rubbish == option for name, option in chosen.items() if name in str(last)), False)
                assert json_kind(rubbish) is json_kind(good) or not_judged or an_option, (*way, last, rubbish)
                used(found.thing)
        inner[last] = good
    assert refused > 0.85 * tried > 200


def used(thing):
    """As a panel uses what it was given."""
    design, study = (thing.design, thing.study) if isinstance(thing, Session) else (thing, None)
    acts = [partial(design.analyse, 31)] if hasattr(design, "analyse") else []
    acts += [partial(study.replace(angles=min(study.angles, 31)).evaluate, thing.front.x)] if study else []
    with np.errstate(all="ignore"):
        for act in acts:
            _, sentence = told_of(act)
            assert not re.search(PYTHON, sentence), sentence


def told_of(act):
    """What ``act()`` gives, and the sentence in which it is refused."""
    try:
        return act(), ""
    except ValueError as refusal:
        return None, str(refusal)


@pytest.mark.parametrize(
    ("value", "hint", "does"),
    [(1, float, True), (True, float, False), ("1", float, False), (1.0, int, False), (None, float | None, True),
     ((), tuple[float, ...], True), (((),), tuple[tuple[float, float], ...], False), ((1.0, "a"), tuple[float], False),
     (Cycloidal(), Law, True), (Dwell(1.0), Law, False), (Dwell(1.0), Segment, True), (0, MotionProgram, False)],
)  # fmt: skip
def test_what_fits_a_field(value, hint, does):
    assert fits(value, hint) == does


# ---------------------------------------------------------------- other kinds of files, other encodings


def test_a_file_that_went_through_windows_is_the_same(tmp_path):
    path = tmp_path / "design.json"
    write(TranslatingRollerCam(), path)
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    assert read(path, tell=pytest.fail) == TranslatingRollerCam()
    assert from_json("\ufeff" + to_json(TranslatingRollerCam())) == TranslatingRollerCam()


OTHERS = {
    "UTF-16": (GOOD["design"].encode("utf-16"), "the file is written in UTF-16; save it as UTF-8"),
    "UTF-16 without a mark": (GOOD["design"].encode("utf-16-be"), "the file is written in UTF-16; save it as UTF-8"),
    "UTF-32 without a mark": (GOOD["design"].encode("utf-32-le"), "the file is written in UTF-32; save it as UTF-8"),
    "UTF-32, big first": (GOOD["design"].encode("utf-32-be"), "the file is written in UTF-32; save it as UTF-8"),
    "UTF-32": (GOOD["design"].encode("utf-32"), "the file is written in UTF-32; save it as UTF-8"),
    "Latin-1": (
        GOOD["session"].replace("weighted sum", "gewählte Summe").encode("latin-1"),
        "the file is written not in UTF-8 but perhaps in Latin-1 (Windows-1252); save it as UTF-8",
    ),
    "CSV": (b"angle;lift\n0;1,5\n", "the file is a table such as CSV, no saved design or study"),
    "PNG": (b"\x89PNG\r\n\x1a\n\0\0\0", "the file is a PNG picture, no saved design or study"),
    "ZIP": (b"PK\x03\x04\x14\0", "the file is a ZIP archive or an office document, no saved design or study"),
    "HTML": (b"<!DOCTYPE html>", "the file is a page of HTML or XML, no saved design or study"),
    "DXF": (b"  0\nSECTION\n", "the file is a DXF drawing, no saved design or study"),
    "prose": (b"Dear camkit", "the file is a text of another kind, no saved design or study"),
    "bytes": (b"abc\0\x01\x02", "the file is no text, and no saved design or study"),
    "nothing": (b"", "the file is empty"),
    "notebook": (b'{"cells": [], "nbformat": 4}', "the file is a notebook, no saved design or study"),
    "other JSON": (
        b'{"name": "camkit"}', "the file is JSON of another kind: it does not say which camkit schema it follows"
    ),
    "damaged": (
        GOOD["design"][:200].encode(), "the file is damaged: it is no JSON at line 8 (Expecting ',' delimiter)"
    ),
    "huge": (b"[" + b" " * 20_000_000, "the file has more than 10 million bytes; no saved design or study has"),
}  # fmt: skip


@pytest.mark.parametrize(("data", "sentence"), OTHERS.values(), ids=OTHERS)
def test_a_file_of_another_kind_is_told_apart(data, sentence, tmp_path):
    (tmp_path / "file").write_bytes(data)
    with pytest.raises(ValueError) as refused:  # noqa: PT011  the whole sentence is compared
        read(tmp_path / "file")
    if not sentence.startswith("the file is damaged"):
        assert str(refused.value) == sentence
    assert str(refused.value).startswith(sentence[:19])


@pytest.mark.parametrize("path", ["a\0b.json", "\ud800.json", Path("a\0b"), b"x.json", "/"])
def test_a_path_that_no_system_can_name_is_refused(path):
    for act in (partial(read, path), partial(write, DoorHandleCam(), path)):
        with pytest.raises(ValueError, match=r"^the path of the file is .*; it must be a text such as 'design.json'"):
            act()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"measures": ["x"]}, r"the argument measures is \['x'\]; it must be a tuple of which each is a Measure"),
        ({"measures": 5}, "the argument measures is 5; it must be a tuple of which each is a Measure"),
        ({"kind": 5}, "the argument kind is 5; it must be a type or None"),
    ],
)
def test_a_wrong_argument_is_told_apart_from_a_bad_file(given, sentence, tmp_path):
    path = tmp_path / "study.json"
    path.write_text(GOOD["session"])
    for act in (partial(read, path), partial(read_json, GOOD["session"]), partial(from_json, GOOD["session"])):
        with pytest.raises(ValueError, match=f"^{sentence}$"):
            act(**given)
    with pytest.raises(ValueError, match=r"^the argument tell is 5; it must be a function$"):
        read(path, tell=5)


@pytest.mark.parametrize("given", [None, 5, {}, 10**10, [1], 2.5])
def test_what_is_no_text_is_not_read(given):
    with pytest.raises(ValueError, match=r"^what is to be read is .*; it must be the text of a file, or its bytes"):
        from_json(given)
    if not isinstance(given, int):
        for act in (partial(read, given), partial(write, DoorHandleCam(), given)):
            with pytest.raises(ValueError, match=r"^the path of the file is .*; it must be a text such as"):
                act()


def test_an_error_of_the_disk_names_the_file_that_was_asked_for(tmp_path):
    (tmp_path / "file").touch()
    for path, error in (("none/x.json", FileNotFoundError), ("file/x.json", NotADirectoryError)):
        with pytest.raises(error) as told:
            write(DoorHandleCam(), tmp_path / path)
        assert told.value.filename == str(tmp_path / path)


def test_a_disk_that_fills_up_keeps_the_file_that_was_there(tmp_path, monkeypatch):
    path = tmp_path / "design.json"
    write(DoorHandleCam(), path)

    def full(self, content):
        self.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space left"):
        write(DoorHandleCam(lift_arm=48 * mm), path)
    monkeypatch.undo()
    assert read(path) == DoorHandleCam()
    (tmp_path / ".design.json.1.part").write_text("half")  # of a process that was killed
    write(DoorHandleCam(), path)
    assert [p.name for p in tmp_path.iterdir()] == ["design.json"]


@pytest.mark.parametrize("name", ["a < b", "=cost", "two\nlines", "x" * 200, "", "'quoted'"])
def test_a_name_that_a_file_may_not_have_is_not_written(name):
    effort = plain.minimise[0]
    study = plain.replace(minimise=(replace(effort, name=name),))
    with pytest.raises(ValueError, match=r"^this cannot be saved, as it could not be read again: the file has the na"):
        to_json(Session(study, study.start))


def test_a_design_of_ones_own_comes_back():
    @dataclass(frozen=True)
    class Bracket(Design):
        arm: float = quantity("l", 50, 20, 90, "mm", "pivot to roller centre")
        holes: tuple = ()
        note: str = "left"

    own = Bracket(0.06, ((1.0, 2.0),), "right")
    assert from_json(to_json(own), Bracket) == own


# ---------------------------------------------------------------- panels


@pytest.fixture(scope="module")
def page():
    """Notebook 01's panel."""
    limits = {"at_most": plain.at_most, "at_least": plain.at_least}
    app = explore(DoorHandleCam(), pressure_angle, measures=CURVE_TABLE[:5], **limits)
    criteria = ahp_panel(PAPER_JUDGEMENTS)
    importance = ahp_panel(Judgements(["effort", "least radius"], [1]))
    problems = {"lift curve alone": lift_curve_study(), "whole cam": door_handle_study()}
    return pareto_panel(
        app, problems, space=EXPANDED_SPACE, free=list(DOOR_HANDLE_SPACE), criteria=criteria, importance=importance
    )


def said(panel):
    if isinstance(panel, Instrument):
        return panel.message
    return panel.banner.text


BAD = {
    **{name: (FILES / name).read_bytes() for name in HOSTILE},
    **{name: text.encode() for name, (text, _) in ABSURD.items()},
    **{name: data for name, (data, _) in OTHERS.items()},
    "a design that cannot be analysed": design_with("lift_swing [deg]", to=179.0).encode(),
    "a study whose design cannot be analysed": work_with("design", "lift_swing [deg]", to=179.0).encode(),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_leaves_the_last_good_picture_and_one_sentence(page, name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    app = page.explorer

    def state():
        shown = app.design, app.analysis, app.structure, app.values
        return *shown, page.study, page.front, page.population.value, page.criteria.judgements, page.status.text

    before = state()
    for panel in (app, page):
        panel.load_json(BAD[name])
        assert said(panel).startswith("This file cannot be used: ")
        assert "\n" not in said(panel)
    assert all(a is b or a == b for a, b in zip(state(), before, strict=True))


EFFORT = lift_curve_study(DoorHandleCam()).minimise[0]
SIZES = DoorHandleCam.measures[:10]
GRID = np.stack(np.meshgrid(*(np.linspace(*ends, 7) for ends in plain.free.values()), indexing="ij"), -1).reshape(-1, 3)
FOREIGN = {
    "one objective": (SIZES[:1], "the study has 1 objective; the judgements here weigh 2: effort, least radius"),
    "three objectives": (SIZES[:3], "the study has 3 objectives; the judgements here weigh 2"),
    "ten objectives": (SIZES, "the study has 10 objectives; the judgements here weigh 2"),
    "one part": (
        (weighted("effort", {SIZES[0]: 1.0}, [1.0]), SIZES[1]),
        "its effort has 1 part; the judgements here weigh 3: pressure angle, contact force, cam torque",
    ),
    "beyond what can be drawn": (
        (weighted("effort", dict(zip(EFFORT.parts, (0.5, 0.3, 0.2), strict=True)), [1e-300] * 3), plain.minimise[1]),
        "a curve reaches",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FOREIGN)
def test_a_study_that_the_page_cannot_judge_or_draw_changes_nothing(page, name, monkeypatch, tmp_path):
    """Sound files of another page: the front, its picture and all that follows it stay together."""
    monkeypatch.chdir(tmp_path)
    minimise, sentence = FOREIGN[name]
    own = page.study
    good = front_of(own.evaluate(GRID), own)
    page.load(Session(own, page.explorer.design, front=good))
    assert len(page.front) > 3
    page.select(len(page.front) - 1)
    study = plain.replace(minimise=minimise)
    front = front_of(study.evaluate(GRID), study)
    other = {"judgements": {"criteria": ahp([9, 5, 1])}, "search": {"population": 44, "rule": "knee"}}
    text = to_json(Session(study, DoorHandleCam(lift_arm=45 * mm), front=front, **other))

    def state():
        shown = page.study, page.found, page.front, page.explorer.design
        boxes = (
            page.picker.rule.value,
            page.picker.pick.value,
            page.picker.pick.max,
            page.population.value,
            page.criteria.judgements,
        )
        told = page.winner, page.status.text, page.verdict.text, page.record.text, page.picture.data
        return shown, boxes, told, {name: bounds.value for name, bounds in page.bounds.items()}

    before = state()
    page.load_json(text)
    assert said(page).startswith(f"This file cannot be used: {sentence}")
    after = state()
    assert all(a is b for a, b in zip(after[0], before[0], strict=True))
    assert after[1:] == before[1:]
    page.importance.sliders[0, 1].value = 3.0
    page.criteria.load(PAPER_JUDGEMENTS)
    click(page, 0.5, 0.5)
    page.select(page.winner)
    assert page.explorer.design == page.front[page.winner]
    page.importance.load([1])
    page.explorer.load(DoorHandleCam())


def test_a_study_of_three_objectives_is_shown_where_nothing_weighs_them(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    app = explore(DoorHandleCam(), pressure_angle)
    finder = pareto_panel(app, lift_curve_study())
    study = plain.replace(minimise=SIZES[:3])
    finder.load_json(to_json(Session(study, app.design, front=front_of(study.evaluate(GRID), study))))
    assert said(finder) == ""
    assert finder.front.f.shape == (len(finder.front), 3)
    assert finder.winner is not None


def test_a_remark_shows_in_the_panel(page, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    app = page.explorer
    app.load_json(to_json(DoorHandleCam(lift_arm=48 * mm)).encode())
    assert said(app) == ""
    app.load_json(to_json(DoorHandleCam(lift_arm=48 * mm)).replace("48.0", "49.0"))
    assert app.design.lift_arm == 49 * mm
    assert said(app) == f"The file is loaded, but {EDITED}."
    page.load_json((FILES / OLD[2]).read_bytes())
    assert len(page.front) == 20
    assert said(page).startswith(f"The file is loaded, but {UNMARKED}; and friction is now friction.coefficient, ")
    assert " and 12 names more are others." in said(page)
    app.load(DoorHandleCam())


def test_designs_that_a_page_leaves_out_are_remarked(page, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    content = json.loads((FILES / OLD[2]).read_bytes())
    work = read(FILES / OLD[2], Session, tell=list)
    rows = content["work"]["front"]
    rows[3] = worst_corner(work.front)
    page.load_json(json.dumps(content))
    assert len(page.front) == 19
    assert said(page).endswith("1 of its 20 designs miss a limit or are dominated and were left out.")


def test_a_law_that_the_menu_does_not_offer_is_shown_when_it_is_loaded(page, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    app = page.explorer
    design = DoorHandleCam(motion_law=Skewed(Cycloidal(), 0.45))
    app.load_json(to_json(design))
    assert app.design == design
    assert [c["chosen"] for c in app.structure["choices"] if c["path"] == "motion_law"] == ["skewed"]
    app.load(DoorHandleCam())


def test_what_cannot_be_saved_is_told_in_the_panel(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    own = MotionProgram((Rise(1.0, 0.3, lambda u: Cycloidal()(u)), Return(1.0, 0.3, Cycloidal())))
    app = explore(OscillatingRollerCam(motion=own), pressure_angle)
    assert file_of(app, "json") == b""
    assert said(app) == (
        "The law of the rise is a function of one's own without a name in its module, which no file can hold: define "
        "it by def at the top of a module or notebook."
    )


def test_the_page_comes_back_with_its_methods_and_a_measure_of_ones_own(page, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    app = explore(DoorHandleCam(), pressure_angle, measures=(slack,))
    criteria = ahp_panel(PAPER_JUDGEMENTS)
    finder = pareto_panel(app, {"own": owned.freeing(PAPER_SPACE)}, criteria=criteria)
    criteria.method.value = "geometric"
    text = to_json(finder.session())
    criteria.method.value = "eigenvector"
    finder.load_json(text)
    assert said(finder) == ""
    assert criteria.method.value == "geometric"
    assert finder.study.minimise[0] == -slack
    finder.load_json(text.replace('"population": 100', '"population": 50000'))
    assert (
        said(finder)
        == "This file cannot be used: the file says 50000 for 'population', which is no setting of this search."
    )
