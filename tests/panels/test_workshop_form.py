"""The form "To the workshop" of an instrument: what is wrong is said, a faulty design waits for somebody to insist."""

import io
import zipfile

import pytest
from hand import ask, choose, file_of, move
from sheets import alert, do

from camkit import DoorHandleCam, Study, TranslatingRollerCam, UniversalJointShaft, deg, explore, mm, study_panel
from camkit.cam import max_pressure_angle
from camkit.files import from_json
from camkit.files.workshop import exports
from camkit.panels.workshop import SOUND, TITLE, WorkshopPanel
from camkit.study.spread import Tolerance

EXPORTS = exports.EXPORTS
LIMIT = {max_pressure_angle: 25 * deg}
HOSTILE = "<script>alert(1)</script>\n=1+1 凸轮"


def opened(app):
    """The form, as the menu of the page opens it."""
    ask(app, workshop=True)
    return next(tab["sheets"][0] for tab in app.tabs if tab["title"] == TITLE)


@pytest.fixture(autouse=True)
def _few_files(monkeypatch):
    """What all of them are is tested where they are made; here the design alone is enough."""
    monkeypatch.setattr(exports, "EXPORTS", tuple(each for each in exports.EXPORTS if each.key in ("json", "dxf")))


@pytest.fixture
def app():
    return explore(TranslatingRollerCam(), at_most=LIMIT)


@pytest.fixture
def form(app):
    return opened(app)


def pressed(form):
    """The name and the files of the zip that the page gets; nothing if it gets none."""
    sent = []
    form.send = lambda content, buffers=(): sent.append((content, buffers))
    do(form, form.button)
    form.settle()
    del form.send
    if not sent:
        return "", {}
    ((content, (data,)),) = sent
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return content["name"], {name: archive.read(name) for name in archive.namelist()}


def test_it_opens_once_and_is_seen_again(app):
    form = opened(app)
    app.opened = "Curves"
    assert opened(app) is form
    assert app.opened == TITLE
    assert [tab["title"] for tab in app.tabs] == [TITLE]
    assert SOUND in app.html()  # a page without a kernel shows what was said


def test_a_sound_design_gives_its_zip(app, form):
    assert form.verdict.text == SOUND
    assert not form.insist.visible
    name, files = pressed(form)
    assert name == "TranslatingRollerCam.zip"
    assert from_json(files["TranslatingRollerCam.json"]) == app.design
    assert form.status.text.startswith(f"{len(files) - 1} files and README.txt")
    assert alert(form) == ""


def test_the_files_say_what_was_typed(form):
    do(form, form.title["title"], value=HOSTILE)
    do(form, form.title["author"], value="M. Curie")
    do(form, form.title["date"], value="2026-11-30")
    do(form, form.unit, value=1)
    text = pressed(form)[1]["README.txt"].decode()
    assert "<script>alert(1)</script> =1+1 凸轮" in text
    assert "2026-11-30, M. Curie" in text
    assert "lengths in inches" in text
    assert form.order.unit == "in"


def test_what_cannot_be_a_blank_is_said_and_nothing_is_made_of_it(form):
    do(form, form.key, value=1)
    do(form, form.sizes["bore"], value=20 * mm)
    assert form.blank.keyway.width == pytest.approx(6 * mm)
    do(form, form.sizes["hub_diameter"], value=21 * mm)
    assert alert(form).startswith("There is no such blank: the hub diameter is 21 mm; with its keyway the bore takes")
    assert (form.button.disabled, form.verdict.text) == (True, "")
    assert form.blank.hub_diameter == 0
    do(form, form.sizes["hub_diameter"], value=30 * mm)
    assert (alert(form), form.button.disabled, form.verdict.text) == ("", False, SOUND)
    assert form.order.blank.hub_diameter == 30 * mm


def test_a_bore_as_large_as_the_cam_is_a_fault(form):
    do(form, form.sizes["bore"], value=60 * mm)
    assert "the bore with its keyway reaches 30 mm from the axis" in form.verdict.text
    assert form.button.disabled


def test_a_faulty_design_waits_for_somebody_to_insist(app, form):
    move(app, "base_radius", 20)
    form.settle()
    assert "the maximum pressure angle is 27.36 deg; it must be at most 25 deg" in form.verdict.text
    assert form.insist.visible
    assert form.button.disabled
    do(form, form.insist, value=True)
    assert not form.button.disabled
    text = pressed(form)[1]["README.txt"].decode()
    assert "FAULTY: the maximum pressure angle is 27.36 deg; it must be at most 25 deg" in text
    move(app, "base_radius", 30)
    form.settle()
    assert form.verdict.text == SOUND
    assert not form.insist.visible
    assert "FAULTY" not in pressed(form)[1]["README.txt"].decode()


def test_a_yield_that_is_too_low_is_found_when_the_button_is_pressed():
    value = max_pressure_angle.one(TranslatingRollerCam().analyse())
    tight = {"base_radius": Tolerance(0.2 * mm)}
    form = opened(explore(TranslatingRollerCam(), at_most={max_pressure_angle: value}, tolerances=tight))
    assert form.verdict.text == SOUND
    assert pressed(form) == ("", {})
    assert "the yield is" in form.verdict.text
    assert form.insist.visible
    assert form.status.text == ""
    do(form, form.insist, value=True)
    assert "FAULTY: the yield is" in pressed(form)[1]["README.txt"].decode()


def test_the_zip_has_the_page_the_study_and_a_report_with_limits_and_yield(app, form, monkeypatch):
    keys = ("json", "page", "study")
    monkeypatch.setattr(exports, "EXPORTS", tuple(each for each in EXPORTS if each.key in keys))
    app.tolerances = {"base_radius": 0.1 * mm}
    files = pressed(form)[1]
    assert "TranslatingRollerCam-study.json" not in files  # limits alone are no study
    page = files["TranslatingRollerCam.html"].decode()
    assert page.startswith("<!doctype html>")
    assert len(page) > len(app.html()) / 2
    report = files["TranslatingRollerCam-report.html"].decode()
    assert "at most 25°" in report
    assert "Feasible: keeps its limit." in report
    assert "base radius ±0.1 mm" in report
    assert "0 of 1024 parts miss a limit" in report
    study = Study(app.design, ["base_radius"], (-max_pressure_angle,), at_most={max_pressure_angle: 30 * deg})
    study_panel(app, study)
    session = from_json(pressed(form)[1]["TranslatingRollerCam-study.json"])
    assert session.study.at_most == {max_pressure_angle: 30 * deg}
    assert session.study.tolerances == study.under(app.tolerances).tolerances
    assert session.design == app.design


def test_each_file_is_told_and_stop_ends_it(form, monkeypatch):
    told = []
    form.status.observe(lambda change: told.append(form.status.text), "value")
    pressed(form)
    assert "Design (JSON), 1 of 3 ..." in told
    assert not form.stop.visible
    first, *others = exports.EXPORTS

    def stopped(order):
        form.stop.click()
        return first.make(order)

    monkeypatch.setattr(exports, "EXPORTS", (first._replace(make=stopped), *others))
    assert pressed(form) == ("", {})
    assert form.status.text == "Stopped: there is no zip."
    assert not form.stop.visible


def test_undercut_and_a_shaft_without_a_profile():
    form = opened(explore(DoorHandleCam()))
    assert "relief groove undercut" in form.verdict.text
    form = opened(explore(UniversalJointShaft()))
    assert form.verdict.text == SOUND
    name, files = pressed(form)
    assert name == "UniversalJointShaft.zip"
    assert {"UniversalJointShaft.json", "README.txt"} <= set(files)
    (blank,) = [part for part in form.top.children if form.key in part.inside()]
    assert not blank.visible


def test_a_design_of_another_make_is_judged_too(app, form):
    choose(app, "motion.rise.law", "simple harmonic")
    form.settle()
    assert form.order.design == app.design
    assert form.order.kind == "TranslatingRollerCam"


def test_what_the_menu_offers_and_a_kind_that_there_is_not(app):
    kinds, _, groups = zip(*app.structure["files"], strict=True)
    assert kinds[:3] == ("json", "html", "dxf")
    assert list(dict.fromkeys(groups)) == [group for group in exports.GROUPS if group in groups]
    assert dict(zip(kinds, groups, strict=True))["picture-svg"] == "Records"
    assert len(kinds) == len(set(kinds))
    assert "study" not in kinds
    assert file_of(app, "dxf").startswith(b"  0")
    assert file_of(app, "exe") == b""
    assert "is no kind of file here; there are json, html" in app.message


def test_a_file_that_cannot_be_made_is_named_and_the_others_are_made(app, form, monkeypatch):
    def refuse(order):
        raise ModuleNotFoundError("the solid needs build123d, which is not installed: pip install 'camkit[step]'")

    first, *others = exports.EXPORTS
    monkeypatch.setattr(exports, "EXPORTS", (*others, first._replace(make=refuse)))
    files = pressed(form)[1]
    assert "TranslatingRollerCam.json" not in files
    assert form.lacking.text.endswith("pip install 'camkit[step]'")
    assert "pip install 'camkit[step]'" in files["README.txt"].decode()


def test_an_error_of_somebodys_own_is_said(form, monkeypatch):
    from camkit.panels import workshop

    def break_(*_):
        raise RuntimeError("no paper in the printer")

    monkeypatch.setattr(workshop, "package", break_)
    assert pressed(form) == ("", {})
    assert alert(form) == "Nothing is made: no paper in the printer."
    assert not form.button.disabled


def test_only_an_instrument_has_one():
    with pytest.raises(ValueError, match="the argument explorer"):
        WorkshopPanel(TranslatingRollerCam())
