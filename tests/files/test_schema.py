"""The published schema: what camkit writes follows it, what is damaged does not; its ends are those declared."""

import json
from copy import deepcopy
from functools import cache
from pathlib import Path

import pytest

from camkit import (
    Cycloidal,
    DoorHandleCam,
    Dwell,
    Judgements,
    ModifiedSine,
    MotionProgram,
    Return,
    Rise,
    Study,
    TranslatingRollerCam,
    deg,
    door_handle_study,
    mm,
    quick_front,
    read,
    shaft_study,
)
from camkit.cam import ConjugatePair, ContactPair, DrivenCam, LubricatedPair, max_pressure_angle
from camkit.data import load
from camkit.decision import Judges
from camkit.dynamics import ElasticFollower
from camkit.files import Decision, Session, to_json
from camkit.files.entries import key, kinds
from camkit.files.schema import json_schema, text
from camkit.machines import standard_tubes
from camkit.motion import ShapedLaw, Skewed, SplineLaw, TableLaw
from camkit.quantities import Design, Quantity, declarations
from camkit.study import Source, weighted
from camkit.study.spread import iso_2768

ROOT = Path(__file__).parents[2]
HOSTILE = [
    ROOT / f"tests/data/files/{name}.json"
    for name in ("angles_study", "empty_row_table", "evil_study", "motion_is_number")
]
SAVED = sorted((ROOT / "tests/data").glob("sessions_*/*.json"))


@cache
def draft():
    """Imported where it is needed: it takes seconds."""
    from jsonschema import Draft202012Validator

    return Draft202012Validator


@cache
def schema():
    return draft()(load("schema"))


def follows(saved: str) -> bool:
    return schema().is_valid(json.loads(saved))


def test_the_published_schema_is_that_of_the_declarations() -> None:
    published = (ROOT / "camkit/data/schema.json").read_text(encoding="utf-8")
    assert published == text(), "write it anew as CONTRIBUTING.md says"
    draft().check_schema(json_schema())
    assert json_schema()["$schema"] == draft().META_SCHEMA["$id"]
    assert "http" not in published.replace("https://json-schema.org/draft/2020-12/schema", "")


# ---------------------------------------------------------------- what is written


def designs() -> list[Design]:
    """One of every kind that stands alone without anything given."""
    made = []
    for kind in kinds().values():
        try:
            design = kind()
        except (TypeError, ValueError):
            continue
        if kind.__module__.startswith("camkit.") and isinstance(design, Design):
            made.append(design)
    return made


@pytest.mark.parametrize("design", designs(), ids=lambda design: type(design).__name__)
def test_every_design_follows_it(design) -> None:
    assert follows(to_json(design))


LAWS = (Skewed(Cycloidal(), 0.4), ShapedLaw(Cycloidal(), (0.1, 0.0, 0.0, 0.0)), SplineLaw((0.5,), (0.5,)))
HALF = {"outer_diameter": 0.5 * mm, "inner_diameter": (0, 0.3 * mm)}
SHIFT = Source("both", {"outer_diameter": 1.0, "inner_diameter": 1.0})


def program(law) -> MotionProgram:
    return MotionProgram((Rise(2.0, 0.02, law, name="hoch"), Dwell(1.0), Return(2.0, 0.02, Cycloidal())))


@cache
def front():
    return quick_front(door_handle_study(), 12)


def decision(**given) -> Decision:
    return Decision(front(), 3, **given)


def menus() -> Study:
    """A study that frees a law, sizes and a number, whose objective is a weighted sum."""
    cam = TranslatingRollerCam()
    free = {
        "motion.rise.law": (Cycloidal(), ModifiedSine()),
        "roller_radius": {8 * mm, 11 * mm},
        "base_radius": (20 * mm, 40 * mm),
    }
    total = weighted("size and angle", {max_pressure_angle: 1.0, cam.measures[1]: 2.0}, (30 * deg, 30 * mm))
    zone = max_pressure_angle.between(30 * deg, 60 * deg)
    return Study(cam, free, (total,), at_most={zone: 40 * deg, max_pressure_angle: 50 * deg})


def judges() -> Judges:
    names = [measure.name for measure in front().study.minimise]
    return Judges({"Anna": Judgements(names, [3]), "张伟": Judgements(names, [5])}, (0.6, 0.4), "judgements")


def session(**given) -> Session:
    """Of a door handle, with all that a person may have done, or other things."""
    judged = {"importance": judges(), "effort": Judgements(["a", "b"], [3])}
    known = {"judgements": judged, "search": {"seed": 3, "mode": "quick"}, "front": front(), "decision": decision()}
    return Session(front().study, DoorHandleCam(), **{**known, **given})


def of_shaft(study: Study) -> Session:
    return Session(study, study.start)


SHAFT, PAIR = shaft_study(), ("outer_diameter", "inner_diameter")
THINGS = {
    "table law": lambda: program(TableLaw((0.0, 0.5, 1.0), (0.0, 0.5, 1.0))),
    **{type(law).__name__: (lambda law=law: program(law)) for law in LAWS},
    "contact": lambda: TranslatingRollerCam(contact=ContactPair()),
    "film": lambda: TranslatingRollerCam(contact=LubricatedPair()),
    "pair": ConjugatePair,
    "elastic": lambda: ElasticFollower(TranslatingRollerCam()),
    "motor": lambda: DrivenCam(TranslatingRollerCam()),
    "front": front,
    "session": session,
    "session without a front": lambda: session(front=None, decision=None, judgements={}, search={}),
    "decision": lambda: decision(judgements=judges(), yields="98 %"),
    "by a point": lambda: decision(rule="reference point", reference=tuple(front().f[3])),
    "menus": lambda: Session(menus(), menus().start),
    "tubes": lambda: of_shaft(SHAFT.replace(free={PAIR: standard_tubes()})),
    "tolerances": lambda: of_shaft(SHAFT.under(HALF, 0.95, correlation={PAIR: 0.5})),
    "standard": lambda: of_shaft(SHAFT.under({"outer_diameter": iso_2768, SHIFT: 0.1 * mm})),
}


@pytest.mark.parametrize("name", THINGS)
def test_all_that_is_written_follows_it(name) -> None:
    saved = to_json(THINGS[name]())
    assert [error.message for error in schema().iter_errors(json.loads(saved))] == []


@pytest.mark.parametrize("path", SAVED, ids=lambda path: path.stem)
def test_earlier_files_follow_it_once_they_are_written_again(path) -> None:
    if path.name == "expected.json":
        pytest.skip("no saved file")
    assert follows(to_json(read(path, tell=lambda remark: None)))


# ---------------------------------------------------------------- what is not as it should be


@pytest.mark.parametrize("path", HOSTILE, ids=lambda path: path.stem)
def test_hostile_and_outdated_files_do_not_follow_it(path) -> None:
    assert not follows(path.read_text(encoding="utf-8"))


OF_SESSION = {
    "no start": lambda held: held.pop("start"),
    "nothing free": lambda held: held.update(free={}),
    "three bounds": lambda held: held["free"].update({"lift_arm [mm]": [1, 2, 3]}),
    "no objective": lambda held: held.update(minimise=[]),
    "a script": lambda held: held.update(minimise=["<script>x</script>"]),
    "too many angles": lambda held: held.update(angles=10**9),
    "a seed below 0": lambda held: held["search"].update(seed=-1),
    "a front of words": lambda held: held["front"][0].append("x"),
    "a program as design": lambda held: held["design"].update(kind="MotionProgram"),
    "an undated decision": lambda held: held["decision"].pop("date"),
}
OF_DESIGN = {
    "unknown field": lambda held: held.update(colour="red"),
    "another unit": lambda held: held.update({"base_radius [in]": held.pop("base_radius [mm]")}),
    "unknown kind": lambda held: held.update(kind="os.system"),
    "no kind": lambda held: held.pop("kind"),
    "a number as text": lambda held: held.update({"base_radius [mm]": "30"}),
    "true as number": lambda held: held.update({"base_radius [mm]": True}),
    "a radius below 0": lambda held: held.update({"base_radius [mm]": -30}),
    "a huge radius": lambda held: held.update({"base_radius [mm]": 1e9}),
    "a number as motion": lambda held: held.update(motion=0),
    "no option": lambda held: held.update(rotation="sideways"),
    "no segments": lambda held: held["motion"].pop("segments"),
    "a law of words": lambda held: held["motion"]["segments"][0].update(law="cycloidal"),
    "a table of empty rows": lambda held: held["load"].update(force_table=[[]]),
}


@pytest.mark.parametrize(("held", "wrong"), [("session", OF_SESSION), ("design", OF_DESIGN)], ids=["session", "design"])
def test_what_is_wrong_in_one_place_does_not_follow_it(held, wrong) -> None:
    file = json.loads(to_json(THINGS["session" if held == "session" else "contact"]()))
    assert schema().is_valid(file)
    for name, spoil in wrong.items():
        spoiled = deepcopy(file)
        spoil(spoiled[held])
        assert not schema().is_valid(spoiled), name
    outside = ({"schema": "camkit/2"}, {"more": 1}, {"program": file[held]}, {"digest": 3})
    assert not any(schema().is_valid({**file, **other}) for other in outside)
    assert not schema().is_valid({"schema": "camkit/1"})


def test_ends_of_numbers_are_those_that_can_be_built() -> None:
    """Just inside and just outside each end, in the unit that the name says."""
    count = 0
    for name, kind in kinds().items():
        properties = load("schema")["$defs"].get(name, {"properties": {}})["properties"]
        for field, declared in declarations(kind).items():
            if not isinstance(declared, Quantity) or "default" not in properties.get(key(field, declared), {}):
                continue  # a number in SI, as programs have them
            one = draft()(properties[key(field, declared)])
            ends = {declared.most, -declared.most, 0.0, declared.above or 0.0, declared.at_least or 0.0}
            near = [end + step * max(abs(end), abs(declared.default), 1) for end in ends for step in (-1e-3, 1e-3)]
            for value in near:
                assert one.is_valid(value) == bool(declared.allows(value * declared.factor)), (name, field, value)
                count += 1
    assert count > 1000
