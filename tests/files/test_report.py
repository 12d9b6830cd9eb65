"""The report of a design: what it prints is what the analysis says, whatever a user has typed, in mm and in inches."""

import base64
import re
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import (
    RSSR,
    DoorHandleCam,
    Judgements,
    Study,
    Tolerances,
    TranslatingRollerCam,
    UniversalJointShaft,
    ValveCam,
    deg,
    door_handle_study,
    explore,
    mm,
    pareto_panel,
    quick_front,
    shaft_study,
    study_panel,
)
from camkit.cam import max_pressure_angle
from camkit.files import Decision, Session, TitleBlock, write_report
from camkit.files.workshop.inches import picture_in, unit_in, words_in
from camkit.files.workshop.report import report
from camkit.files.workshop.report_page import PAPER, heights, page
from camkit.files.workshop.report_texts import FITS, plainly, report_of, shortened
from camkit.files.workshop.reported import reported
from camkit.machines import ninety_degree_study, valve_study
from camkit.quantities import Choice, declared_in, measures_of, value_of
from camkit.quantities.markup import letters
from camkit.units import convert, factor, inch, lbf
from camkit.views import Axes, Band, Line, Picture
from camkit.views.defaults import default_views

EMPTY = {"meta", "img", "link", "br"}
DESIGNS = (TranslatingRollerCam(), ValveCam(), DoorHandleCam(), UniversalJointShaft())
HOSTILE = "<script>alert('x')</script>&amp;\"=1+1\"#$*_`\n{}張伟 Иван"


class Page(HTMLParser):
    """What a browser sees: elements, texts by the table's row, and what is not closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.rows: list[list[str]] = []
        self.texts: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)

    def handle_data(self, data):
        if {"td", "th"} & {*self.open}:
            self.rows[-1][-1] += data
        elif "style" not in self.open:
            self.texts.append(data)

    def pictures(self) -> list[str]:
        sources = [attrs["src"] or "" for tag, attrs in self.elements if tag == "img"]
        return [base64.b64decode(src.removeprefix("data:image/svg+xml;base64,")).decode() for src in sources]


def html_of(thing, **options) -> str:
    return report(thing, ".html", **options).data.decode()


@cache
def plain(design, unit="mm"):
    """The report of a design of which nothing is asked."""
    return report_of(reported(design), TitleBlock(), unit)


def si(number: str, unit: str) -> float:
    """A printed number with its unit, read as a person reads it."""
    plain = unit.replace("°", "deg").replace("µ", "u")
    for raised, power in zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·", "0123456789-.", strict=True):
        plain = plain.replace(raised, power)
    plain = re.sub(r"(?<=[A-Za-z])(-?[\d.]+)", r"^\1", plain)
    return float(number.replace("−", "-")) * factor(plain)


# ---------------------------------------------------------------- numbers


@pytest.mark.parametrize("unit", ["mm", "in"])
@pytest.mark.parametrize("design", DESIGNS, ids=lambda made: type(made).__name__)
def test_every_number_of_the_report_is_the_analysis(design, unit) -> None:
    told = plain(design, unit)
    analysis = design.analyse()
    values = {measure.name: measure.one(analysis) for measure in measures_of(design)}
    assert {row.name for row in told.measures} == {name for name, value in values.items() if np.isfinite(value)}
    for row in told.measures:
        assert_allclose(si(row.value, row.unit), values[row.name], rtol=6e-4, atol=1e-12)
    declared = declared_in(design)
    assert len(told.inputs) == len(declared)
    for row, (path, d) in zip(told.inputs, declared.items(), strict=True):
        if isinstance(d, Choice):
            assert (row.value, row.unit) == (d.text(value_of(design, path)), None)
        else:
            assert_allclose(si(row.value, row.unit or ""), value_of(design, path), rtol=6e-6, atol=1e-15)
        assert letters(d.symbol).startswith(row.letter)
    lengths = {row.unit for row in (*told.measures, *told.inputs)}
    assert ("mm" in lengths) == (unit == "mm") != ("in" in lengths)


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_the_page_prints_what_the_report_says(unit) -> None:
    told = report_of(reported(ValveCam(), valve_study()), TitleBlock(), unit)
    rows = Page(html_of(ValveCam(), study=valve_study(), unit=unit)).rows
    for row in told.measures:
        assert [row.name, row.value, row.unit] in [cells[:3] for cells in rows]
    cells = [[row[0], row[1], row[2]] for row in rows if len(row) > 2]
    for row in told.inputs:
        assert {*(f"{row.name} {row.meaning}", row.name)} & {
            name for symbol, name, value in cells if value == row.value
        }


def test_a_panel_with_limits_and_tolerances_shows_them() -> None:
    limit, within = {max_pressure_angle: 25 * deg}, {"base_radius": 0.1 * mm}
    told = report_of(reported(explore(TranslatingRollerCam(), at_most=limit, tolerances=within)), TitleBlock(), "mm")
    assert (told.good, told.verdict) == (True, "Feasible: keeps its limit.")
    assert (told.measures[0].name, told.measures[0].asked) == (max_pressure_angle.name, "at most 25°")
    (note,) = told.notes
    assert note.rows[0] == ("made within", "base radius ±0.1 mm")
    assert "0 of 1024 parts miss a limit" in dict(note.rows)["yield"]


def test_limits_and_the_verdict_are_those_of_the_study() -> None:
    study = door_handle_study()
    good, bad = (report_of(reported(d, study), TitleBlock(), "mm") for d in (decided().design, DoorHandleCam()))
    assert (good.good, good.verdict, good.faults) == (True, "Feasible: keeps all 5 limits.", ())
    evaluated = study.evaluate(study.x_of(DoorHandleCam())[None])
    count = int((evaluated.missed > 0).sum())
    assert (bad.good, bad.verdict[:32]) == (False, f"Infeasible: misses {count} of 5 limits")
    missed = [row for row in bad.measures if row.kept == "missed"]
    assert len(missed) == count > 0
    for row in missed:
        assert row.name in bad.verdict.lower()
        assert row.asked.split(", ")[-1] in bad.verdict
    assert [row.asked for row in bad.measures if row.name == "effort"] == ["small"]
    assert [row.name for row in bad.measures][: len(study.minimise)] == [m.name for m in study.minimise]
    assert bad.faults == ("relief groove undercut at 20.6 to 26.1°: roller 5 mm, concave radius 2.67 mm",)
    assert "Faulty:" in page(plain(DoorHandleCam())).data.decode()


def test_without_limits_there_is_no_verdict_but_of_what_cannot_be_made() -> None:
    assert plain(TranslatingRollerCam()).good is None
    undercut = plain(DoorHandleCam())
    assert (undercut.good, undercut.verdict) == (False, "Cannot be made as it is.")
    marked = report_of(reported(TranslatingRollerCam()), TitleBlock(faults=("the yield is 3 %",)), "in")
    assert (marked.good, marked.faults) == (False, ("the yield is 3 %",))


def test_the_yield_stands_there_with_its_confidence() -> None:
    study = shaft_study()
    made = Tolerances(study, {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}, parts=256, seed=7)
    told = dict(reported(study.start, tolerances=made).made())
    low, high = made.interval
    assert told["yield"] == (
        f"{100 * made.share:.1f} % of 256 parts keep every limit (95 % confidence: {100 * low:.1f} to "
        f"{100 * high:.1f} %); seed 7"
    )
    halves = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}
    asked = report_of(reported(study.start, study, halves), TitleBlock(), "mm")
    recheck = study.under(halves).recheck(study.x0[None])
    assert str(recheck) in dict(asked.notes[-1].rows)["yield"]
    assert not recheck.kept[0]
    assert (asked.good, "Infeasible" in asked.verdict) == (False, True)
    with pytest.raises(ValueError, match=r"^the tolerances are of another design than the report$"):
        reported(UniversalJointShaft(outer_diameter=0.12), tolerances=made)


@cache
def decided() -> Session:
    """A session in which a search found a front, and a person chose from it."""
    study = door_handle_study()
    record = {"population": 8, "generations": 3, "seed": 41, "seconds": 2.0, "versions": {"numpy": "2.0"}}
    front = replace(quick_front(study, 20), record=record)
    decision = Decision(front, 3, judgements=Judgements([m.name for m in study.minimise], [3]))
    return Session(study, decision.design, {}, {}, front, decision)


def test_a_session_has_its_decision_and_the_seed_of_its_search() -> None:
    session = decided()
    for thing in (session, session.decision):
        told = report_of(reported(thing), TitleBlock(), "mm")
        notes = {note.heading: dict(note.rows) for note in told.notes}
        assert "seed 41" in notes["Study"]["search"]
        assert {name: plainly(text) for name, text in session.decision.lines()} == notes["Decision"]
        assert "weights: effort 0.7500" in notes["Decision"]["judged"]
    other = replace(session, design=DoorHandleCam())
    assert ("note", "this report is of another design") in report_of(reported(other), TitleBlock(), "mm").notes[-1].rows


def test_panels_give_what_they_show_and_ask() -> None:
    limit = {max_pressure_angle: 15 * deg}
    app = explore(TranslatingRollerCam(), at_most=limit)
    told = reported(app)
    assert (told.design, told.limits) == (app.design, ((max_pressure_angle, 15 * deg, 1),))
    assert report_of(told, TitleBlock(), "mm").good is False
    study = Study(TranslatingRollerCam(), ["base_radius"], (max_pressure_angle,), at_most=limit)
    assert reported(study_panel(app, study)).study.at_most == limit
    app = explore(DoorHandleCam())
    front = pareto_panel(app, door_handle_study())
    assert reported(front).study.minimise == door_handle_study().minimise
    chosen = default_views(TranslatingRollerCam().analyse())[:2]
    assert len(report_of(reported(explore(TranslatingRollerCam(), *chosen)), TitleBlock(), "mm").curves) == 1


def test_an_analysis_is_taken_as_it_is() -> None:
    analysis = TranslatingRollerCam().analyse(31)
    assert reported(analysis).analysis is analysis
    study = ninety_degree_study()
    assert report_of(reported(study.start, study), TitleBlock(), "mm").drawing.title.startswith("Linkage in space")


# ---------------------------------------------------------------- the page


@pytest.mark.parametrize("thing", [decided, TranslatingRollerCam, DoorHandleCam], ids=["session", "design", "faulty"])
def test_the_page_is_valid_and_needs_nothing_else(thing) -> None:
    text = html_of(thing(), title=TitleBlock(author="张伟"))
    shown = Page(text)
    assert text.startswith("<!DOCTYPE html>")
    assert (shown.wrong, shown.open) == ([], [])
    assert not [attrs for _, attrs in shown.elements if "id" in attrs or any(name.startswith("on") for name in attrs)]
    assert {tag for tag, _ in shown.elements}.isdisjoint({"script", "link", "iframe", "object", "form"})
    outside = r"(?:https?:)?//[\w.]+|url\((?!#)|@import"
    assert re.findall(outside, re.sub(r"base64,[\w+/=]+", "", text)) == []
    for svg in shown.pictures():
        assert {*re.findall(outside, svg)} <= {"http://www.w3.org"}
        assert not re.search(r"<script|<image|<foreignObject|\son\w+=", svg)
    assert all(attrs["alt"] for tag, attrs in shown.elements if tag == "img")
    assert "A4" in text


def test_hostile_text_stays_text() -> None:
    block = TitleBlock(title=HOSTILE, number=HOSTILE, author=HOSTILE, material=HOSTILE, date=HOSTILE, faults=(HOSTILE,))
    text = html_of(TranslatingRollerCam(), title=block)
    shown = Page(text)
    assert "script" not in {tag for tag, _ in shown.elements}
    assert (shown.wrong, shown.open) == ([], [])
    assert "".join(shown.texts).count(HOSTILE) == 8  # title twice in the page, once each in the others and the footer


def test_what_has_no_room_is_left_out_and_said() -> None:
    told = plain(TranslatingRollerCam())
    many = replace(told, inputs=told.inputs * 12)
    shown = page(many)
    (without, left) = shown.remarks
    assert without == "For want of room it is not said what each input means"
    count = int(re.match(r"(\d+) of 324 inputs are left out", left)[1])
    assert Page(shown.data.decode()).elements.count(("sub", {})) < 324 - count
    for fit in FITS:
        above, below = heights(shortened(many, fit), fit)
        assert min(above, below) > 0
    assert above + below < 2 * PAPER
    assert shortened(told, FITS[0]) == told


def test_what_is_no_report_is_refused(tmp_path) -> None:
    with pytest.raises(ValueError, match=r"^a report ends in .pdf or .html, not in '.docx'$"):
        write_report(TranslatingRollerCam(), tmp_path / "cam.docx")
    with pytest.raises(ValueError, match="a design or its analysis can be exported"):
        write_report(object(), tmp_path / "cam.html")
    with pytest.raises(ValueError, match="a workshop's files are in mm or in inches"):
        write_report(TranslatingRollerCam(), tmp_path / "cam.html", unit="ell")
    with pytest.raises(ValueError, match="must be a"):
        write_report(RSSR(), tmp_path / "cam.html", study=door_handle_study())
    assert list(tmp_path.iterdir()) == []
    made = write_report(TranslatingRollerCam(), str(tmp_path / "cam.html"), unit="in")
    assert made.path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert np.isnan(made.deviation)


# ---------------------------------------------------------------- inches


@pytest.mark.parametrize("unit", ["mm", "N/mm", "m/s^2", "N m", "MPa", "kg", "N^0.5 mm^-0.5", "J", "kW", "J/(kg m)"])
def test_units_in_inches_measure_the_same(unit) -> None:
    other = unit_in(unit, "in")
    assert other != unit == unit_in(unit, "mm")
    assert_allclose(convert(2.0, unit, other) * factor(other), 2.0 * factor(unit), rtol=1e-12)


def test_texts_in_inches_keep_everything_else() -> None:
    assert (
        words_in("radius 25.4 mm of 3 cams, 45 deg, 10 rpm, 2 m", "in")
        == "radius 1 in of 3 cams, 45 deg, 10 rpm, 6.56 ft"
    )
    assert float(words_in("1751.27 N/mm", "in").split()[0]) == pytest.approx(1751.27e3 / (lbf / inch), rel=1e-5)
    assert words_in("the 4 mm-roller, 5 mmol", "mm") == "the 4 mm-roller, 5 mmol"


def test_pictures_in_inches_are_the_same_curves() -> None:
    for design in (TranslatingRollerCam(), ValveCam()):
        analysis = design.analyse()
        for view in default_views(analysis):
            before, after = view(analysis), picture_in(view(analysis), "in")
            assert [m.key for m in before.marks] == [m.key for m in after.marks]
            assert not re.search(r"\b(mm|N|MPa)\b", after.axes.ylabel)
    axes = Axes(xlabel="x  [mm]", ylabel="F  [10^3 N]", xlim=(0, 50.8))
    lines = Picture.of(axes, Line("a", [25.4], [1.0]), Band("b", 1.0, 2.0, along="y"))
    moved = picture_in(lines, "in")
    assert (moved.axes.xlabel, moved.axes.ylabel) == ("x  [in]", "F  [10^3 lbf]")
    assert_allclose(moved.axes.xlim, [0, 2])
    assert_allclose(moved["a"].x, [1.0])
    assert_allclose(moved["a"].y, [1 / lbf])
    assert_allclose([moved["b"].low, moved["b"].high], [1 / 25.4, 2 / 25.4])
    assert picture_in(lines, "mm") is lines
    raised = picture_in(Picture.of(Axes(ylabel="[m/s²]"), Line("a", [0.0], [1.0])), "in")
    assert raised.axes.ylabel == "[ft/s^2]"
    assert_allclose(raised["a"].y, [1 / 0.3048])
    word = Picture.of(Axes(ylabel="[m-ary N]"), Line("a", [0.0], [1.0]))
    assert picture_in(word, "in") is word
