"""Files: what was saved comes back, what a table holds is the analysis, and what is damaged is refused in words."""

import json
import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit import ArmLoad, DoorHandleCam, Friction, OscillatingRollerCam, ahp, door_handle_study, nsga2, read, write
from camkit.files import Session, from_json, to_json
from camkit.files.designs import SCHEMA
from camkit.machines import lift_curve_study
from camkit.machines.door_handle import EXPANDED_SPACE
from camkit.motion import (
    HALF_LAWS,
    LAWS,
    ConstantVelocity,
    Cycloidal,
    Degree9,
    Dwell,
    FreePolynomial,
    MotionProgram,
    Poly345,
    Return,
    Rise,
    Skewed,
    SplineLaw,
    TableLaw,
)
from camkit.quantities import Quantity, declarations
from camkit.units import deg, mm

# ---------------------------------------------------------------- round trips


def numbers(kind, of):
    """Values inside every declared range of ``kind``: numbers as typed, in the unit, or any SI values."""
    return {
        name: st.floats(declared.low, declared.high).map(partial(of, declared))
        for name, declared in declarations(kind).items()
        if isinstance(declared, Quantity)
    }


def typed(declared, value):
    return float(f"{value:.9g}") * declared.factor


def found(declared, value):
    return value * declared.factor


tables = st.just(()) | st.just(((0.0, 1.0), (0.5, -2.25)))


def door_handles(of):
    def build(sizes, law, table):
        sizes = {k: v for k, v in sizes.items() if k not in ("relief_cam_angle", "handle_angle", "relief_arm")}
        try:
            return DoorHandleCam(**sizes, motion_law=law, lift_load=ArmLoad(torque_table=table))
        except ValueError:  # the relief crank does not reach; another time
            return DoorHandleCam(motion_law=law, lift_load=ArmLoad(torque_table=table))

    kinds = numbers(DoorHandleCam, of)
    for name in kinds:
        if declarations(DoorHandleCam)[name].above == 0:
            kinds[name] = kinds[name].filter(lambda value: value > 0)
    return st.builds(build, st.fixed_dictionaries(kinds), st.sampled_from(LAWS), tables)


@given(door_handles(typed))
@settings(max_examples=50, deadline=None)
def test_a_design_with_typed_numbers_comes_back_exactly(design):
    assert from_json(to_json(design)) == design
    assert from_json(to_json(design), DoorHandleCam) == design


@given(door_handles(found))
@settings(max_examples=50, deadline=None)
def test_any_design_comes_back_to_fourteen_digits(design):
    again = from_json(to_json(design))
    for name, declared in declarations(DoorHandleCam).items():
        if isinstance(declared, Quantity):
            assert math.isclose(getattr(again, name), getattr(design, name), rel_tol=1e-14), name
    assert again.motion_law == design.motion_law
    assert to_json(again) == to_json(design)


EVERY_LAW = [
    *LAWS,
    *HALF_LAWS,
    ConstantVelocity(0.3, "parabolic"),
    Skewed(Poly345(), 0.4),
    Degree9((0.1, 0.2, -0.3, 0.4)),
    FreePolynomial((0, 0.5, 0), (1, 0.25, 0)),
    SplineLaw((0.3, 0.7), (0.2, 0.8)),
    TableLaw(tuple(np.linspace(0, 1, 21)), tuple(Cycloidal()(np.linspace(0, 1, 21)).s)),
]


@pytest.mark.parametrize("law", EVERY_LAW, ids=lambda law: type(law).__name__)
def test_a_program_of_any_law_comes_back(law):
    program = MotionProgram((Dwell(0.3), Rise(1.1, 0.4, law), Dwell(0.2), Return(0.9, 0.3, law)), start=0.05)
    cam = OscillatingRollerCam(
        motion=program,
        rotation=-1,
        load=ArmLoad(mass=3.0, torque_table=((0.0, 1.0), (0.2, 4.0))),
        friction=Friction(coefficient=0.1),
    )
    again = from_json(to_json(cam))
    phi = np.linspace(0, program.span, 50)
    assert again == cam
    assert_array_equal(again.motion(phi), cam.motion(phi))


def test_files_say_their_schema_and_units(tmp_path):
    path = tmp_path / "cam.json"
    write(DoorHandleCam(lift_arm=48.09 * mm, lift_start_angle=20.5 * deg), path)
    content = json.loads(path.read_text(encoding="utf-8"))
    assert content["schema"] == SCHEMA == "camkit/1"
    design = content["design"]
    assert (design["kind"], design["motion_law"]) == ("DoorHandleCam", "cycloidal")
    assert (design["lift_arm [mm]"], design["lift_start_angle [deg]"], design["friction"]["coefficient"]) == (
        48.09,
        20.5,
        0.05,
    )
    assert read(path) == DoorHandleCam(lift_arm=48.09 * mm, lift_start_angle=20.5 * deg)


@pytest.fixture(scope="module", params=["lift", "whole"])
def work(request):
    whole = request.param == "whole"
    study = door_handle_study(space=EXPANDED_SPACE) if whole else lift_curve_study()
    front = nsga2(study, 40, 30, 5)
    judgements = {"criteria": ahp([5.0, 5.0, 1.0]), "importance": ahp([1 / 3])}
    return Session(study, front[0], judgements, {"population": 40, "generations": 30, "seed": 5}, front)


def test_a_whole_study_comes_back(work, tmp_path):
    write(work, tmp_path / "study.json")
    again = read(tmp_path / "study.json")
    assert isinstance(again, Session)
    assert again.study.start == work.study.start
    assert again.study.angles == work.study.angles
    assert list(again.study.free) == list(work.study.free)
    assert_allclose(again.study.bounds, work.study.bounds, rtol=1e-14)
    for mine, theirs in zip(again.study.limits, work.study.limits, strict=True):
        assert (mine[0], mine[2]) == (theirs[0], theirs[2])
        assert math.isclose(mine[1], theirs[1], rel_tol=1e-14)
    effort, radius = again.study.minimise
    assert (effort.name, effort.parts, effort.weights) == ("effort", *_of(work.study.minimise[0]))
    assert_allclose(effort.reference, work.study.minimise[0].reference, rtol=1e-14)
    assert radius == work.study.minimise[1]
    assert dict(again.judgements) == dict(work.judgements)
    assert dict(again.search) == dict(work.search)
    assert_allclose(again.front.x, work.front.x, rtol=1e-14)
    before, after = work.study.evaluate(work.front.x), again.study.evaluate(again.front.x)
    assert_allclose(after.f, before.f, rtol=1e-10)
    assert_array_equal(after.feasible, before.feasible)


def _of(measure):
    return measure.parts, measure.weights


def test_a_study_without_a_front_or_limits_comes_back(work):
    bare = Session(work.study.replace(at_most={}, at_least={}), work.design)
    again = from_json(to_json(bare))
    assert again.front.x.shape == (0, len(work.study.free))
    assert again.study.limits == ()
    assert (dict(again.judgements), dict(again.search)) == ({}, {})


def test_the_sign_of_a_weighted_sum_comes_back(work):
    effort = work.study.minimise[0]
    again = from_json(to_json(replace(work, study=work.study.replace(minimise=(-effort,)))))
    assert again.study.minimise[0].sign == -1


# ---------------------------------------------------------------- damage

GOOD = to_json(DoorHandleCam())


def changed(text, change):
    """``text`` with ``change`` made to its design or work."""
    content = json.loads(text)
    change(content["session"] if "session" in content else content["design"])
    return json.dumps(content)


@given(st.integers(1, len(GOOD) - 1))
@settings(max_examples=60, deadline=None)
def test_a_file_cut_short_is_refused(length):
    with pytest.raises(ValueError, match=r"^the file is damaged: it is no JSON at line "):
        from_json(GOOD[:length])


def nested(inner):
    return st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3)


scalars = st.none() | st.booleans() | st.floats() | st.text(max_size=5) | st.integers()


@given(st.recursive(scalars, nested))
@settings(max_examples=100, deadline=None)
def test_whatever_json_it_is_a_stranger_is_refused(anything):
    for content in (anything, {"schema": SCHEMA, "design": anything}, {"schema": SCHEMA, "session": anything}):
        with pytest.raises(ValueError, match=r"^the file "):
            from_json(json.dumps(content))


@given(
    st.sampled_from(sorted(json.loads(GOOD)["design"])), st.sampled_from([None, "x", True, [], {}, [1.0], {"kind": 3}])
)
@settings(max_examples=100, deadline=None)
def test_a_design_with_a_spoiled_entry_is_refused(key, rubbish):
    assume((key, rubbish) != ("torque_table", []))  # an empty table is a table
    with pytest.raises(ValueError, match=r"^the (file|.*; it must)"):
        from_json(changed(GOOD, lambda design: design.update({key: rubbish}))).analyse(31)


WORK_DAMAGE = {
    "no start": lambda w: w.pop("start"),
    "start is a law": lambda w: w.update(start={"kind": "Cycloidal"}),
    "start is a number": lambda w: w.update(start=5),
    "a front of text": lambda w: w.update(front="abc"),
    "a ragged front": lambda w: w.update(front=[[1, 2, 3], [1]]),
    "a front that is not finite": lambda w: w.update(front=[[math.nan, 1, 1]]),
    "a front with other columns": lambda w: w.update(front=[[50, 22]] * 3),
    "an unknown free quantity": lambda w: w["free"].update({"wing [mm]": [1, 2]}),
    "bounds of text": lambda w: w["free"].update({"lift_arm [mm]": ["a", "b"]}),
    "one bound": lambda w: w["free"].update({"lift_arm [mm]": [50]}),
    "reversed bounds": lambda w: w["free"].update({"lift_arm [mm]": [60, 50]}),
    "nothing free": lambda w: w.update(free={}, front=[]),
    "an unknown measure": lambda w: w.update(minimise=["speed"]),
    "a measure that is a number": lambda w: w.update(minimise=[5]),
    "no objective": lambda w: w.update(minimise=[]),
    "a sum of nothing": lambda w: w["minimise"][0].update(weights={}),
    "a reference too short": lambda w: w["minimise"][0].update(reference=[1]),
    "a limit on an unknown measure": lambda w: w["at_most"].update({"speed [m/s]": 5}),
    "a limit of text": lambda w: w.update(at_most={"maximum pressure angle, lift [deg]": "45"}),
    "angles of text": lambda w: w.update(angles="many"),
    "no angles": lambda w: w.update(angles=None),
    "negative angles": lambda w: w.update(angles=-1),
    "a design of another kind": lambda w: w.update(design=json.loads(to_json(OscillatingRollerCam()))["design"]),
    "judgements that are a number": lambda w: w.update(judgements=5),
    "judgements of text": lambda w: w.update(judgements={"criteria": "abc"}),
    "a search that is a number": lambda w: w.update(search=5),
    "a search of text": lambda w: w.update(search={"population": "many"}),
    "a search with an unknown setting": lambda w: w.update(search={"explorer": 1}),
}
PYTHON = "object|NoneType|zip|int\\(|float:|inhomogeneous|unpack|multiply|subscript|iterable|dataclass|literal"
"""What a person who never programmed should not read."""


@pytest.mark.parametrize("damage", WORK_DAMAGE.values(), ids=WORK_DAMAGE.keys())
def test_a_damaged_study_is_refused_in_words(damage):
    good = to_json(Session(door_handle_study(), DoorHandleCam(), {"criteria": ahp([5, 5, 1])}, {"population": 9}))
    from_json(good)
    with pytest.raises(ValueError, match=f"^(?!.*({PYTHON}))the |^a study needs") as refused:
        from_json(changed(good, damage))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "text",
    ["[" * 100000, GOOD.replace("50.0", "9" * 400, 1), GOOD.replace("0.05", "1e999"), "\x00", "\ufeff" + GOOD[:20]],
    ids=["deep", "huge", "infinite", "zero byte", "byte order mark"],
)
def test_hostile_text_is_refused_like_any_other(text):
    with pytest.raises(ValueError, match=r"^the "):
        from_json(text)


@pytest.mark.parametrize("thing", [None, 3.5, "x", [1, 2], Rise(1, 1, Cycloidal())], ids=repr)
def test_only_a_design_or_a_work_is_saved(thing):
    """What could not be read again is not written."""
    with pytest.raises(ValueError, match="design"):
        to_json(thing)


def test_what_has_no_place_in_a_file_is_refused_in_words():
    own_law = MotionProgram((Rise(1.0, 0.3, lambda u: Cycloidal()(u)),))
    with pytest.raises(ValueError, match="law"):
        to_json(OscillatingRollerCam(motion=own_law))
    with pytest.raises(ValueError, match=r"population|one design"):
        to_json(DoorHandleCam(lift_arm=np.array([[0.05], [0.06]])))


def test_a_bad_file_of_another_kind_is_named():
    with pytest.raises(
        ValueError, match=r"^the file holds an oscillating roller cam; a door handle cam is wanted here$"
    ):
        from_json(to_json(OscillatingRollerCam()), DoorHandleCam)
    with pytest.raises(ValueError, match=r"^the file holds a door handle cam; a study is wanted here$"):
        from_json(GOOD, Session)
    with pytest.raises(ValueError, match=r"^the file holds a study; a door handle cam is wanted here$"):
        from_json(to_json(Session(door_handle_study(), DoorHandleCam())), DoorHandleCam)


def test_a_judgement_that_was_not_made_and_the_record_come_back(work):
    record = {"population": 40, "generations": 30, "seed": 5, "seconds": 1.5, "versions": {"numpy": "2.4.6"}}
    kept = replace(work, judgements={"criteria": ahp([5.0, None, 1.0])}, front=replace(work.front, record=record))
    again = from_json(to_json(kept))
    assert again.judgements == {"criteria": ahp([5.0, None, 1.0])}
    assert again.front.record == record
    quick = {"designs": 6977, "seconds": 0.2, "versions": {"numpy": "2.4.6"}}
    assert from_json(to_json(replace(work, front=replace(work.front, record=quick)))).front.record == quick


def test_a_study_of_an_older_camkit_has_no_record(work):
    content = json.loads(to_json(work))
    del content["session"]["record"]
    assert from_json(json.dumps(content)).front.record == {}


@pytest.mark.parametrize(
    "record",
    [[1], "seed", {"seed": 1}, *({"population": 4, "generations": 3, "seed": 5, "seconds": 1.5, "versions": {}} | wrong
     for wrong in ({"seed": "1"}, {"seed": True}, {"seconds": None}, {"versions": {"numpy": 2}}, {"more": 1}))],
)  # fmt: skip
def test_a_record_that_is_garbled_is_refused(work, record):
    content = json.loads(to_json(work))
    content["session"]["record"] = record
    with pytest.raises(ValueError, match=r"^the file\b"):
        from_json(json.dumps(content))
