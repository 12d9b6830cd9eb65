"""Designs side by side: the table against the designs' own numbers, the files, the tray and its picture."""

import base64
import io
from html.parser import HTMLParser

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose
from PIL import Image
from sheets import alert, do, parts, press

from camkit import (
    DoorHandleCam,
    Measure,
    Study,
    TranslatingRollerCam,
    UniversalJointShaft,
    door_handle_study,
    explore,
    shaft_study,
)
from camkit.decision import side_by_side
from camkit.machines import lift_curve_study
from camkit.machines.door_handle import CURVE_TABLE, stroke_radius
from camkit.motion import Poly345
from camkit.panels.kit.inputs import Download
from camkit.panels.kit.parts import Button, bold, plain
from camkit.panels.shortlist import shortlist
from camkit.render.still import draw, layout
from camkit.units import mm
from camkit.views import mechanism, pressure_angle
from camkit.views.overlay import PLACES, Kept, measures_overlaid, profiles_overlaid
from camkit.views.picture import Axes, Picture

ARMS = (50 * mm, 46 * mm, 54 * mm)
DESIGNS = {f"arm {arm / mm:.0f}": DoorHandleCam(lift_arm=arm) for arm in ARMS}
STUDY = lift_curve_study()
STEEPEST, BASE = CURVE_TABLE[:2]


def line_of(table, name):
    return next(line for line in table.lines if line.name == name)


# --- the table --------------------------------------------------------------------------------------------------------


def test_the_table_has_what_differs_and_every_measure_as_the_designs_have_it():
    table = side_by_side(DESIGNS, CURVE_TABLE[:7], STUDY)
    assert table.names == tuple(DESIGNS)
    names = [line.name for line in table.lines]
    assert names[:3] == ["lift arm", "effort", stroke_radius.name]
    assert len(set(names)) == len(names) == 1 + 2 + 7
    assert line_of(table, "lift arm").texts == ("50 mm", "46 mm", "54 mm")
    for measure in CURVE_TABLE[:7]:
        expected = tuple(measure.text(measure(design.analyse())) for design in DESIGNS.values())
        assert line_of(table, measure.name).texts == expected


def test_the_best_is_least_or_largest_as_the_study_says_and_a_missed_limit_is_told():
    table = side_by_side(DESIGNS, CURVE_TABLE[:7], STUDY)
    analyses = [design.analyse() for design in DESIGNS.values()]
    for measure, best in ((STEEPEST, np.argmin), (BASE, np.argmax), (stroke_radius, np.argmax)):
        line = line_of(table, measure.name)
        assert np.flatnonzero(line.best) == best([measure(a) for a in analyses])
    steep = line_of(table, STEEPEST.name)
    assert steep.limit == "at most 45 deg"
    assert list(steep.missed) == [STEEPEST(a) > STUDY.at_most[STEEPEST] for a in analyses] == [False, False, True]
    assert not any(line_of(table, "lift arm").best)
    assert not any(line_of(table, CURVE_TABLE[6].name).best)  # nobody said that a small torque is better


@pytest.mark.parametrize("side", ["at_most", "at_least"])
def test_a_number_that_is_not_there_keeps_no_limit(side):
    unknown = Measure(STEEPEST.name, STEEPEST.unit, lambda analysis: np.nan)
    study = STUDY.replace(**({"at_most": {}, "at_least": {}} | {side: {unknown: 1.0}}))
    assert line_of(side_by_side(DESIGNS, (), study), STEEPEST.name).missed == (True, True, True)


def test_designs_that_are_alike_have_no_best():
    table = side_by_side({"one": DoorHandleCam(), "other": DoorHandleCam(relief_arm=76 * mm)}, (), STUDY)
    assert [line.name for line in table.lines if line.texts[0] != line.texts[1]] == ["relief arm"]
    assert not any(any(line.best) for line in table.lines)


def test_a_choice_that_differs_is_told_by_name():
    law = Poly345()
    table = side_by_side({"one": DoorHandleCam(), "other": DoorHandleCam(motion_law=law)})
    assert line_of(table, "motion law").texts == (DoorHandleCam().motion_law.name, law.name)


def test_designs_of_two_kinds_are_refused():
    with pytest.raises(ValueError, match="the designs are DoorHandleCam and UniversalJointShaft; designs of one kind"):
        side_by_side({"a": DoorHandleCam(), "b": UniversalJointShaft()})


def test_markdown_is_a_table_with_bold_bests():
    table = side_by_side(DESIGNS, CURVE_TABLE[:3], STUDY)
    lines = table.markdown("Three arms").splitlines()
    assert lines[0] == "# Three arms"
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    assert {len(row) for row in rows} == {5}
    assert rows[0] == ["", *DESIGNS, "limit"]
    steep = next(row for row in rows if row[0] == STEEPEST.name)
    values = [STEEPEST.text(STEEPEST(d.analyse())) for d in DESIGNS.values()]
    assert steep == [STEEPEST.name, values[0], f"**{values[1]}**", f"{values[2]} (not met)", "at most 45 deg"]


class Reader(HTMLParser):
    """Cells of every row, pictures, and what a page asks other places for."""

    def __init__(self):
        super().__init__()
        self.rows, self.images, self.open = [], [], []

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "img"):
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag == "img":
            self.images.append(dict(attrs))
        assert tag not in ("link", "script")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.rows and {"td", "th"} & set(self.open):
            self.rows[-1][-1] += data


def read(page):
    reader = Reader()
    reader.feed(page)
    assert reader.open == []
    return reader


def test_the_page_holds_the_same_table_and_its_picture():
    table = side_by_side(DESIGNS, CURVE_TABLE[:3], STUDY)
    out = io.BytesIO()
    Image.new("RGB", (3, 2), "red").save(out, "PNG")
    page = read(table.page("Three <arms>", out.getvalue()))
    assert page.rows[0] == ["", *DESIGNS, "limit"]
    for line, row in zip(table.lines, page.rows[1:], strict=True):
        told = [f"{text} not met" if missed else text for text, missed in zip(line.texts, line.missed, strict=True)]
        assert row == [line.name, *told, line.limit]
    (image,) = page.images
    assert image["src"].startswith("data:image/png;base64,")
    assert base64.b64decode(image["src"].partition(",")[2]) == out.getvalue()
    assert "Three &lt;arms&gt;" in table.page("Three <arms>")
    assert "<img" not in table.page()
    assert table.page().count("<b>") == sum(sum(line.best) for line in table.lines) > 0


# --- the pictures -----------------------------------------------------------------------------------------------------


def drawn(view, kept):
    _, axes = layout((view,), width=5, height=4)
    draw(kept, axes, (view,))
    return axes[0]


def test_profiles_are_those_of_the_designs_in_the_colours_of_their_places():
    kept = Kept({place: design.analyse() for place, design in zip("ACE", DESIGNS.values(), strict=True)})
    shown = profiles_overlaid(kept)
    for place in PLACES:
        assert (place in shown) == (place in kept.analyses)
        if place in kept.analyses:
            curve, profile = shown[place], kept.analyses[place].profile / mm
            assert_allclose(np.array([curve.x, curve.y])[:, : profile.shape[1]], profile)
            assert (curve.role, curve.index, curve.label) == ("series", PLACES.index(place), place)


@pytest.mark.parametrize("many", [4, 12])
def test_measures_are_shown_against_the_first(many):
    measures = CURVE_TABLE[:many]
    analyses = {place: design.analyse() for place, design in zip("BC", DESIGNS.values(), strict=False)}
    shown = measures_overlaid(Kept(analyses, measures))
    ratios = [100 * (m(analyses["C"]) / m(analyses["B"]) - 1) for m in measures]
    assert_allclose(shown["B"].x, 0, atol=1e-12)
    assert_allclose(shown["C"].x, ratios)
    assert any("\n" in words for words in shown.axes.yticks.values()) == (many == 4)  # no row stands over another
    ticks = [words.replace("\n", " ") for words in shown.axes.yticks.values()]
    for words, measure in zip(ticks, measures, strict=True):
        begin, _, end = words.partition("…")
        assert measure.name.startswith(begin.strip())
        assert measure.name.endswith(end.strip())
    assert list(shown.axes.yticks) == list(shown["B"].y)
    assert "B" not in measures_overlaid(Kept({}, measures))


# --- the panel --------------------------------------------------------------------------------------------------------


@pytest.fixture
def panel():
    app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm"], measures=CURVE_TABLE[:4])
    return shortlist(app, STUDY)


def keep(panel, arm):
    panel.explorer.load(DoorHandleCam(lift_arm=arm * mm))
    press(panel, "Keep this design")


def downloaded(panel, words):
    button, sent = next(part for part in parts(panel, Download) if part.description == words), []
    button.send = sent.append
    do(panel, button)
    return sent[0]


def cells(table):
    """The words of the table that the page shows."""
    yield ["", *table.names, "limit"]
    for line in table.lines:
        told = zip(line.texts, line.missed, strict=True)
        yield [line.name, *(f"{text} not met" if missed else text for text, missed in told), line.limit]


def test_five_designs_are_kept_and_a_sixth_is_refused_in_a_sentence(panel):
    assert panel.summary() == "no design is kept yet"
    for arm in (46, 47, 48, 49, 50):
        keep(panel, arm)
    assert list(panel.designs) == list(PLACES)
    assert alert(panel) == ""
    keep(panel, 51)
    assert alert(panel) == (
        "This design is not kept: 5 designs are kept already, as many as the tray holds; remove one to make room."
    )
    assert [design.lift_arm for design in panel.designs.values()] == [arm * mm for arm in (46, 47, 48, 49, 50)]
    parts(panel, Button)[6].click()  # Remove of the second design
    assert list(panel.designs) == ["A", "C", "D", "E"]
    keep(panel, 51)
    assert {place: round(design.lift_arm / mm) for place, design in panel.designs.items()} == dict(
        zip("ABCDE", (46, 51, 48, 49, 50), strict=True)
    )


def test_a_design_is_kept_once(panel):
    keep(panel, 46)
    keep(panel, 46)
    assert alert(panel) == "This design is not kept: it is design A already."
    assert list(panel.designs) == ["A"]


def test_a_kept_design_goes_back_into_the_sliders(panel):
    keep(panel, 46)
    keep(panel, 54)
    press(panel, "Load")
    assert panel.explorer.design == DoorHandleCam(lift_arm=46 * mm)


def test_the_files_are_the_table_and_the_picture(panel):
    keep(panel, 46)
    keep(panel, 54)
    named = {"design A": DoorHandleCam(lift_arm=46 * mm), "design B": DoorHandleCam(lift_arm=54 * mm)}
    table = side_by_side(named, CURVE_TABLE[:4], STUDY)
    file = downloaded(panel, "Save as Markdown")
    assert file["name"] == "designs.md"
    assert file["text"] == table.markdown("Designs side by side")
    assert panel.summary() == file["text"]
    file = downloaded(panel, "Save as HTML")
    assert file["name"] == "designs.html"
    assert file["mime"] == "text/html"
    page = read(file["text"])
    assert table.html() in file["text"]
    image = Image.open(io.BytesIO(base64.b64decode(page.images[0]["src"].partition(",")[2])))
    assert image.size == (1260, 480)
    assert panel.numbers.text == "\n".join("  ".join(row) for row in cells(table))
    best = {
        (name, k) for name, *row, _ in panel.numbers.rows for k, cell in enumerate(row) if cell == bold(plain(cell))
    }
    assert best == {(line.name, k) for line in table.lines for k in np.flatnonzero(line.best)} != set()


def test_an_empty_tray_shows_and_saves_nothing_but_words(panel):
    assert not panel.picture.visible
    assert "<img" not in downloaded(panel, "Save as HTML")["text"]
    keep(panel, 46)
    assert panel.picture.visible
    press(panel, "Remove")
    assert not panel.picture.visible


def test_designs_without_a_profile_are_compared_in_numbers():
    app = explore(UniversalJointShaft(), lambda analysis: Picture.of(Axes()), free=["outer_diameter"])
    panel = shortlist(app, shaft_study())
    press(panel, "Keep this design")
    app.load(UniversalJointShaft(outer_diameter=120 * mm))
    press(panel, "Keep this design")
    assert panel.picture.views == (measures_overlaid,)
    assert line_of(panel.table, "outer diameter").texts == ("128.64 mm", "120 mm")


def test_a_study_of_another_mechanism_is_refused_at_once():
    with pytest.raises(ValueError, match=r" does not apply to a TranslatingRollerAnalysis, which has no "):
        shortlist(explore(TranslatingRollerCam(), mechanism, free=["base_radius"]), door_handle_study())


def test_a_measure_that_fails_for_one_design_keeps_the_others():
    radius = Measure("radius", "mm", lambda a: {True: a.cam.base_radius}[a.cam.base_radius < 32 * mm])
    app = explore(TranslatingRollerCam(groove=False), mechanism, free=["base_radius"])
    kept = shortlist(app, Study(app.design, ["base_radius"], [radius]))
    kept.keep()
    before = kept.summary()
    move(app, "base_radius", 35)
    kept.keep()
    assert "This design is not kept: the radius cannot be computed: KeyError: False." in kept.banner.text
    assert (list(kept.designs), kept.summary()) == (["A"], before)
