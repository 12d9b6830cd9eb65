"""The instrument in the kernel: what the page settles on becomes the design, and what it asks for is answered."""

import gc
import io
import json
import re
import threading
import tracemalloc

import numpy as np
import pytest
from hand import ask, choose, move, open_file
from PIL import Image
from stubborn import Stubborn

from camkit import DoorHandleCam, Measure, TranslatingRollerCam, UniversalJointShaft, explore, mm
from camkit.cam import max_pressure_angle, min_profile_radius
from camkit.files import to_json
from camkit.motion import ShapedLaw
from camkit.panels.kit.changes import numbers_of
from camkit.quantities import quantities_of, value_of
from camkit.render import living
from camkit.views import mechanism, pressure_angle


@pytest.fixture
def app():
    return explore(TranslatingRollerCam(groove=False), mechanism, measures=[max_pressure_angle, min_profile_radius])


@pytest.fixture
def sent(app, monkeypatch):
    messages = []
    monkeypatch.setattr(type(app), "send", lambda self, content, buffers=(): messages.append((content, list(buffers))))
    return messages


def test_what_the_page_settles_on_is_the_design(app):
    heard = []
    app.on_change(heard.append)
    move(app, "base_radius", 45)
    assert app.design.base_radius == 45 * mm
    assert heard == [app.design]
    assert app.analysis.cam is app.design
    assert app.rows()[0][1] == max_pressure_angle.one(app.design.analyse())


def test_what_cannot_be_built_leaves_the_last_design(app):
    before = app.design
    move(app, "base_radius", -1000)
    assert app.design is before
    place = list(quantities_of(before)).index("base_radius")
    assert app.values[place] == -1.0  # the page goes on showing what was asked for, and says why it cannot be
    app.load(before)
    assert app.values[place] == before.base_radius


def test_a_design_moves_the_page(app):
    app.design = app.design.replace(base_radius=50 * mm)
    assert app.values[list(quantities_of(app.design)).index("base_radius")] == 50 * mm
    with pytest.raises(ValueError, match="it must be a TranslatingRollerCam"):
        app.load(DoorHandleCam())


def test_reset_goes_back_in_what_was_chosen_too(app):
    start = app.design
    rise = next(choice for choice in app.structure["choices"] if choice["path"] == "motion.rise.law")
    ask(app, choose=[rise["path"], next(option for option in rise["options"] if option != rise["chosen"])])
    assert app.design != start
    ask(app, reset=True)
    assert app.design == start


def test_a_choice_brings_its_quantities(app):
    path = "motion.rise.law"
    rises = [choice for choice in app.structure["choices"] if choice["path"] == path]
    law = next(option for option in rises[0]["options"] if option != rises[0]["chosen"])
    program = app.program
    ask(app, choose=[path, law])
    assert value_of(app.design, path).name == law
    assert app.program != program
    rise, *others = app.design.motion.segments
    shaped = app.design.motion.replace(segments=(rise.replace(law=ShapedLaw(c=(0.1, 0.0, 0.0, 0.0))), *others))
    app.load(app.design.replace(motion=shaped))
    names = [q["name"] for q in app.structure["quantities"]]
    assert "rise shape 1" in names
    assert len(app.values) == len(names)


def test_a_slider_of_its_own_is_linked_both_ways(app):
    slider = app.control("base_radius")
    slider.value = 42.0
    assert app.design.base_radius == 42 * mm
    move(app, "base_radius", 44)
    assert slider.value == 44.0


def test_a_slider_of_its_own_that_asks_for_too_much_moves_the_page_there_which_says_why(app):
    slider, before = app.control("base_radius"), app.design
    slider.min = -2000
    slider.value = -1000
    place = list(quantities_of(before)).index("base_radius")
    assert app.design is before
    assert app.values[place] == -1.0
    slider.value = before.base_radius / mm
    assert app.values[place] == pytest.approx(before.base_radius)
    assert app.design == before


def test_files_are_what_they_say(app, sent):
    begins = {
        "html": b"<!doctype html>",
        "picture-svg": b"<?xml",
        "picture-pdf": b"%PDF",
        "json": b"{",
        "dxf": b"  0",
        "csv": b"stretch,",
    }
    for kind, words, _ in app.structure["files"]:
        ask(app, file=kind)
        if not sent:
            assert re.search(r"needs \w+, which is not installed: pip install 'camkit", app.message), kind
            continue
        content, (data,) = sent.pop()
        assert content["file"].startswith("TranslatingRollerCam")
        assert data
        assert words
        assert data.startswith(begins.pop(kind, b"")), data[:40]
    assert not begins


def test_a_file_is_opened_or_refused_in_a_sentence(app, sent):
    ask(app, file="json")
    saved = sent.pop()[1][0].decode()
    move(app, "base_radius", 45)
    open_file(app, saved)
    assert app.design == app.start
    open_file(app, "{}")
    assert app.message.startswith("This file cannot be used: ")


def test_where_page_and_kernel_differ_it_is_said(app):
    app.computed = [max_pressure_angle.one(app.analysis), min_profile_radius.one(app.analysis)]
    assert app.message == ""
    app.computed = [max_pressure_angle.one(app.analysis) * (1 + 1e-6), None]
    assert app.message.startswith("The page computes ")
    app.message = ""
    app._now[0] = app._first[0] = 0.0
    app.computed = [1e-20, None]
    assert app.message == ""  # rounding beside nothing


def test_the_page_hears_of_the_numbers_at_the_start(app):
    first = {measure.name: measure.one(app.analysis) for measure in (max_pressure_angle, min_profile_radius)}
    move(app, "base_radius", 45)
    assert {name: app.structure["first"][name] for name in first} == first


def test_a_follower_that_fails_is_said_and_stops_no_other(app):
    heard = []
    app.on_change(lambda design: 1 / 0)
    app.on_change(heard.append)
    move(app, "base_radius", 45)
    assert heard == [app.design]
    assert app.message.startswith("What follows this panel cannot be shown everywhere: ")


def test_an_option_that_is_taken_back_is_not_recorded_again(app, monkeypatch):
    made, record = [], living.record
    monkeypatch.setattr(living, "record", lambda *given: made.append(0) or record(*given))
    plain, first = app.structure, app.program
    choose(app, "motion.rise.law", "modified sine")
    other = app.program
    move(app, "base_radius", 45)
    choose(app, "motion.rise.law", "cycloidal")
    assert (app.structure, app.program) == (plain, first)
    assert app.rows()[0][1] == max_pressure_angle.one(app.design.analyse())
    choose(app, "motion.rise.law", "modified sine")
    assert (app.program, other != first, len(made)) == (other, True, 1)
    for law in ("simple harmonic", "cycloidal"):
        choose(app, "motion.rise.law", law)
    assert len(made) == 3  # of three, the last two are held


def test_what_does_not_record_the_kernel_computes(monkeypatch):
    highest = Measure("highest", "mm", lambda analysis: analysis.height[-1])
    app, messages = explore(Stubborn(), measures=[highest]), []
    monkeypatch.setattr(type(app), "send", lambda self, content, buffers=(): messages.append((content, list(buffers))))
    assert app.program == b""
    ask(app, compute=[3 * mm], number=7)
    content, buffers = messages.pop()
    arrays = [np.frombuffer(buffer) for buffer in buffers]
    assert content["answer"] == 7
    assert arrays[content["measures"][0]["value"]["at"]] == 3 * mm
    curve = next(mark for mark in content["pictures"][0]["marks"] if mark["key"] == "curve")
    np.testing.assert_allclose(arrays[curve["y"]["at"]], 3 * np.linspace(0, 1, 5))
    ask(app, compute=[-3 * mm], number=8)
    assert "must be" in messages.pop()[0]["sentence"]


def test_pictures_that_do_not_record_follow(monkeypatch):
    app, messages = explore(UniversalJointShaft()), []
    monkeypatch.setattr(type(app), "send", lambda self, content, buffers=(): messages.append((content, list(buffers))))
    move(app, "length", 3000)
    content, _ = messages.pop()
    assert content["still"] == [p["name"] for p in app.structure["pictures"] if p["still"]]
    assert set(content["pictures"]) == {str(k) for k, p in enumerate(app.structure["pictures"]) if p["still"]}


def test_the_state_is_plain(app):
    assert json.loads(json.dumps(app.structure))["name"] == "Translating roller cam"
    assert "image/png" in app._repr_mimebundle_()[0]


def test_a_loaded_design_moves_every_slider_to_the_last_digit_and_calls_followers_once(app):
    seen = []
    app.on_change(seen.append)
    wanted = app.design.replace(base_radius=47.123456789 * mm, roller_radius=6 * mm)
    app.load(wanted)
    assert app.design is wanted
    assert seen == [wanted]
    assert app.values == [value_of(wanted, path) for path in quantities_of(wanted)]
    move(app, "roller_radius", 7)
    assert app.design == wanted.replace(roller_radius=7 * mm)  # what does not move keeps every digit


def test_a_measure_that_is_infinite_now_and_at_the_start_is_left_out():
    never = Measure("never", "mm", lambda analysis: np.inf)
    later = Measure("later", "mm", lambda analysis: np.where(analysis.cam.base_radius > 35 * mm, np.inf, 1.0))
    app = explore(TranslatingRollerCam(), mechanism, measures=[never, later])
    assert [m for m, _, _ in app.rows()] == [later]
    move(app, "base_radius", 40)
    assert [m for m, _, _ in app.rows()] == [later]
    assert "never" not in app.summary()


def test_without_a_kernel_the_mechanism_stands_in_four_positions(app):
    plain, still = (Image.open(io.BytesIO(data)).convert("RGB") for data in (app.figure()._repr_png_(), app.still()))
    assert still.width == plain.width
    assert still.height > plain.height
    below = np.asarray(still)[plain.height :]
    four = np.array_split(np.asarray(below, int), 4, axis=1)
    assert all((part.min(axis=-1) < 200).sum() > 100 for part in four)
    assert all((a[:, : b.shape[1]] != b[:, : a.shape[1]]).any() for a, b in zip(four[1:], four, strict=False))
    app = explore(TranslatingRollerCam(), pressure_angle)
    assert app.still() == app.figure()._repr_png_()


FILE = to_json(DoorHandleCam())


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (FILE[:99], "the file is damaged: it is no JSON at line"),
        (FILE.replace("camkit/1", "camkit/9"), "the file follows the schema 'camkit/9'"),
        (FILE.replace("75.0", "-75.0"), "the relief arm (pivot to roller centre) is -75 mm"),
        (FILE.replace("75.0", "20.0"), "the relief roller has to rest on the lift curve's base circle"),
        (FILE.replace("50.0", "9" * 400, 1), "the "),
        ("[" * 100000, "the file is damaged"),
        (
            FILE.replace('"torque_table": []', '"torque_table": [[0, "a"]]'),
            "the file says [[0, 'a']] for 'torque_table'; a list of pairs of numbers belongs there",
        ),
        (to_json(TranslatingRollerCam()), "the file holds a"),
    ],
    ids=["cut short", "schema", "negative", "impossible", "huge", "deep", "table", "other kind"],
)
def test_a_file_that_cannot_be_used_is_refused_and_changes_nothing(text, sentence):
    app = explore(DoorHandleCam(), pressure_angle)
    move(app, "lift_arm", 48)
    good, values, structure = app.design, app.values, app.structure
    open_file(app, text)
    assert app.message.startswith(f"This file cannot be used: {sentence}")
    assert app.design is good
    assert (app.values, app.structure) == (values, structure)


def test_moves_leave_nothing_behind(app):
    def show(times):
        for i in range(times):
            move(app, "base_radius", 30 + (i % 40) / 5)
        gc.collect()

    show(10)
    threads, waiting = threading.active_count(), callbacks(app)
    tracemalloc.start()
    show(5)
    start = tracemalloc.get_traced_memory()[0]
    show(60)
    grown = tracemalloc.get_traced_memory()[0] - start
    tracemalloc.stop()
    assert callbacks(app) == waiting > 3
    assert grown < 100_000  # less than one curve for each move
    assert threading.active_count() == threads


def callbacks(app):
    """How many functions wait for a change or a message."""
    waiting = sum(len(acts) for kinds in app._trait_notifiers.values() for acts in kinds.values())
    return waiting + len(app._msg_callbacks.callbacks)


@pytest.mark.parametrize(
    "message",
    [
        5,
        {"choose": ["nowhere", "x"]},
        {"choose": ["base_radius", "x"]},
        {"choose": ["motion.rise.law", "no law"]},
        {"choose": 5},
        {"file": "exe"},
        {"file": ["json"]},
        {"open": None},
        {"open": "[" * 100_000},
        {"open": '{"__proto__": {"kind": 1e400}}'},
        {"compute": [1.0]},
    ],
    ids=lambda message: str(message)[:30],
)
def test_whatever_the_page_asks_is_answered_in_a_sentence(app, message):
    before = app.design
    app._handle_custom_msg(message, [])
    assert app.message.endswith(".")
    assert app.design is before


def test_numbers_of_another_design_are_answered(app, sent):
    for values in ([1.0], ["x"] * len(app.values), [None] * len(app.values)):
        ask(app, compute=values, number=3)
        assert sent.pop()[0]["sentence"]


def test_a_design_that_cannot_be_shown_leaves_everything_as_it_was(app):
    before, structure = app.design, app.structure
    for other in (DoorHandleCam(), "design", type(before)):
        with pytest.raises(ValueError, match="the design is"):
            app.design = other
    assert app.design is before
    assert app.structure is structure


def test_a_free_quantity_that_a_law_takes_away_comes_back():
    cam = TranslatingRollerCam()
    rise, *others = cam.motion.segments
    shaped = cam.replace(
        motion=cam.motion.replace(segments=(rise.replace(law=ShapedLaw(c=(0.1, 0.0, 0.0, 0.0))), *others))
    )
    app = explore(shaped, mechanism, free=["motion.rise.law", "motion.rise.law.c0"], measures=[])
    app.design = cam
    assert not any(q["free"] for q in app.structure["quantities"])
    assert len(app.values) == len(app.structure["quantities"])
    app.design = shaped
    assert [q["name"] for q in app.structure["quantities"] if q["free"]] == ["rise shape 1"]


def test_a_slider_of_its_own_makes_room_for_a_design_beyond_its_ends(app):
    slider = app.control("base_radius")
    wide = app.design.replace(base_radius=3 * slider.max * mm)
    app.design = wide
    assert app.design is wide
    assert slider.value == pytest.approx(wide.base_radius / mm)


def test_what_cannot_be_built_is_not_saved_as_the_last_design(app, sent):
    move(app, "base_radius", -1000)
    ask(app, file="json")
    assert not sent
    assert "must be" in app.message


def test_two_that_follow_each_other_come_to_rest(app):
    other = explore(app.design, mechanism, measures=[max_pressure_angle])
    app.on_change(other.load)
    other.on_change(app.load)
    move(app, "base_radius", 45)
    assert other.design == app.design
    move(other, "base_radius", 48)
    assert app.design.base_radius == 48 * mm
    assert app.values == other.values


def test_a_limit_is_shown_though_its_measure_is_not_listed():
    app = explore(TranslatingRollerCam(), mechanism, measures=[], at_most={max_pressure_angle: np.float64(1)})
    assert [m["limit"] for m in app.structure["measures"]] == [1.0]


def test_a_mechanism_of_plain_numbers_is_computed_by_the_kernel():
    rounded = Measure(
        "rounded", "mm", lambda analysis: round(analysis.cam.x, 6) * {True: 1}[analysis.cam.x.is_integer() < 2]
    )
    app = explore(Stubborn(), measures=[rounded])
    assert app.program == b""
    assert app.rows()[0][1] == 1 * mm


def test_a_measure_that_fails_is_said_in_a_sentence_at_once():
    broken = Measure("broken", "mm", lambda analysis: None + analysis.height[-1])
    with pytest.raises(ValueError, match="the broken cannot be computed: TypeError"):
        explore(Stubborn(), measures=[broken])


def no_view(analysis):
    return None + analysis.cam.start_height


def test_a_view_that_fails_is_said_in_a_sentence_at_once():
    with pytest.raises(ValueError, match="the view no view cannot be computed: TypeError"):
        explore(TranslatingRollerCam(), no_view)


def test_a_measure_may_have_a_limit_on_both_sides():
    limits = {"at_most": {max_pressure_angle: 0.5}, "at_least": {max_pressure_angle: 0.1}}
    app = explore(TranslatingRollerCam(), mechanism, measures=[max_pressure_angle, min_profile_radius], **limits)
    rows = [(m["name"], m.get("limit"), m.get("sense")) for m in app.structure["measures"]]
    name = max_pressure_angle.name
    assert rows == [(name, 0.5, 1), (min_profile_radius.name, None, None), (name, 0.1, -1)]
    assert len(app.rows()) == 2


def test_a_page_that_is_saved_begins_with_the_design_as_it_is_now(app, tmp_path):
    move(app, "base_radius", 45)
    app.to_html(tmp_path / "cam.html")
    text = (tmp_path / "cam.html").read_text(encoding="utf-8")
    structure = json.loads(text.partition('id="structure">')[2].partition("</script>")[0])
    place = list(quantities_of(app.design)).index("base_radius")
    assert structure["quantities"][place]["value"] == 45 * mm


def test_each_view_of_a_page_has_its_own_clock(app):
    """Two computers show one notebook, and the clock of one goes ten seconds too fast."""
    make, values = app.structure["make"], list(app.values)
    ask(app, session={"hello": True}, values=values, said={"at": 10_000, "make": make, "view": 0.25})
    moved = [values[0] * 1.001, *values[1:]]
    app.set_state({"values": moved, "computed": [], "said": {"at": 20, "make": make, "view": 0.75}})
    assert app.values == list(numbers_of(app.design).values()) == moved


def test_what_a_question_overtakes_is_old(app):
    """The page's last values come with its question, and once more after it."""
    values, make, law = [*app.values], app.structure["make"], value_of(app.design, "motion.rise.law")
    values[0] += 1 * mm
    option = next(o for o in app.structure["choices"] if o["path"] == "motion.rise.law")["options"][-1]
    late = {
        "values": values,
        "computed": [m.one(app.design.analyse()) for m in app.measures],
        "said": {"at": 5, "make": make},
    }
    ask(app, choose=["motion.rise.law", option], values=values, said={"at": 5, "make": make})
    assert app.values[0] == values[0]
    chosen = app.design
    assert value_of(chosen, "motion.rise.law") != law
    app.set_state(late)
    assert app.message == ""
    assert app.design == chosen
    app.set_state({**late, "values": [2 * value for value in values]})
    assert app.values == [*numbers_of(chosen).values()]  # the page hears what there is
    now = {"values": [*numbers_of(chosen).values()], "computed": [9.0, 9.0]}
    app.set_state({**now, "said": {"at": 6, "make": make}})  # of the other law still
    assert app.message == ""
    app.set_state({**now, "computed": [8.0, 8.0], "said": {"at": 7, "make": app.structure["make"]}})
    assert "The page computes" in app.message


def test_the_page_comes_back_to_a_make(app, sent):
    values, make, first = [*app.values], app.structure["make"], app.design
    rise, *others = first.motion.segments
    shaped = (rise.replace(law=ShapedLaw(c=(0.1, 0.0, 0.0, 0.0))), *others)
    app.design = first.replace(motion=first.motion.replace(segments=shaped))
    other = app.structure["make"]
    assert other != make
    values[0] += 1 * mm
    ask(app, back=[make, values])
    assert app.structure["make"] == make
    assert numbers_of(app.design) == pytest.approx(dict(zip(quantities_of(first), values, strict=True)))
    assert app.makes.living(make) is app.living  # recorded once
    ask(app, back=["never", values])
    assert app.message == "No design of the make 'never' is remembered here."
    ask(app, pin=[other, [*numbers_of(app.makes.living(other).design).values()], [1.0]])
    assert sent[-1][0]["pinned"]["make"] == other
    assert sent[-1][0]["measures"][0]["name"] == max_pressure_angle.name
