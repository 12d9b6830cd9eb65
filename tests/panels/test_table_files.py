"""A table that is dropped on a panel becomes the motion of its design: what is said, asked, drawn and taken back."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from hand import answers, at, file_of, move, open_file
from numpy.testing import assert_allclose
from sheets import alert, do, parts, press, upload

from camkit import (
    DoorHandleCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    explore,
    mm,
    read_motion,
)
from camkit.cam import BarrelCam
from camkit.files import from_json, to_json
from camkit.motion import TableMotion
from camkit.panels import TablePanel, table_panel
from camkit.panels.kit.motions_in import motions_in
from camkit.panels.kit.parts import Button
from camkit.quantities import Design

TABLES = Path(__file__).parents[1] / "data" / "tables"
LOBE = (TABLES / "lobe_european.csv").read_bytes()
ANGLES = np.arange(0.0, 360, 5)


def lifts(angle):
    return 10 - 10 * np.cos(angle * deg)


def rows(x=ANGLES, y=None, heading=""):
    return heading + "".join(f"{a:.6g};{b:.4f}\n" for a, b in zip(x, lifts(ANGLES) if y is None else y, strict=True))


@pytest.fixture
def app():
    return explore(TranslatingFlatCam(base_radius=30 * mm))


def sheet(app):
    (panel,) = (tab["sheets"][0] for tab in app.tabs if tab["title"] == "Table")
    return panel


def offered(panel):
    """What is asked, and the buttons that answer it."""
    return panel.question.text, [part.description for part in panel.options.children]


def test_a_dropped_table_is_the_motion_of_the_design(app):
    before = app.design
    open_file(app, LOBE, "lobe.csv")
    panel = sheet(app)
    assert app.opened == "Table"
    assert app.design == before.replace(motion=read_motion(LOBE))
    assert panel.motion == app.design.motion
    assert panel.told.text.startswith(
        "Semicolons and decimal commas, angles in deg (of the cam), levels in mm, 141 rows"
    )
    assert panel.more.text.startswith("Smoothed by the smoothest curve")
    assert [len(shown.marks) for shown in panel.picture.shown] == [3, 3, 3, 3]
    assert (alert(panel), app.message, offered(panel)) == ("", "", ("", []))
    assert not [picture["still"] for picture in app.structure["pictures"] if picture["still"]]  # the page draws all


def test_what_was_there_comes_back_and_so_does_the_table(app):
    before, (make, values) = app.design, (app.structure["make"], app.values)
    open_file(app, LOBE)
    taken, (later, others) = app.design, (app.structure["make"], app.values)
    panel = sheet(app)
    go_back(app, make, values)
    assert app.design == before
    assert panel.motion is None
    assert [part.visible for part in (panel.picture, panel.ways)] == [False, False]
    assert panel.told.text.startswith("Drop a table of a motion here")
    go_back(app, later, others)
    assert app.design == taken
    assert panel.picture.visible
    assert panel.ways.visible


def go_back(app, make, values):
    """Undo or Redo, as the page asks for it."""
    answers(app, back=[make, values])


def test_pictures_are_drawn_anew_for_another_motion_alone(app):
    open_file(app, LOBE)
    drawn = sheet(app).picture.count
    move(app, "base_radius", 41)
    assert sheet(app).picture.count == drawn
    move(app, "motion.start", 1)
    assert sheet(app).picture.count == drawn + 1


def test_sliders_live_on_with_a_table(app):
    open_file(app, LOBE)
    motion = app.design.motion
    move(app, "base_radius", 41)
    assert (app.design.base_radius, at(app, "base_radius")) == (pytest.approx(41 * mm), pytest.approx(41))
    assert app.design.motion == motion
    assert sheet(app).ways.visible  # it is known how it was read
    move(app, "motion.start", 1)
    assert app.design.motion(0.0).s == pytest.approx(1 * mm)
    assert app.design.motion.segments == motion.segments
    assert sheet(app).ways.visible


def test_bad_rows_are_named_in_sight_and_marked(app):
    y = lifts(ANGLES)
    y[[7, 30]] += 0.4
    open_file(app, rows(y=y))
    panel = sheet(app)
    assert [line.split(" is ")[0] for line in panel.bad.text.split("\n")] == ["Row 8 at 35 deg", "Row 31 at 150 deg"]
    (marks,) = (mark for mark in panel.picture.shown[0].marks if mark.key == "bad rows")
    assert_allclose(marks.x, [35, 150])


def test_many_bad_rows_are_named_but_not_all_in_sight(app):
    x = np.arange(0.0, 360, 1)
    y = lifts(x)
    y[[20, 60, 100, 140, 180, 220]] += 0.4
    open_file(app, rows(x, y))
    panel = sheet(app)
    assert panel.bad.text.split("\n")[-1] == "2 more rows are left out."
    assert "Row 221 at 220 deg" in panel.more.text


# --- questions --------------------------------------------------------------------------------------------------------


def test_a_question_is_answered_by_a_button(app):
    before = app.design
    open_file(app, rows(2 * ANGLES))
    panel = sheet(app)
    question = "The angles span 710 deg, more than a turn of the cam. What are they in?"
    assert offered(panel) == (question, ["degrees of a crank that turns twice as often"])
    assert app.design == before
    press(panel, "degrees of a crank that turns twice as often")
    assert offered(panel) == ("", [])
    assert_allclose(app.design.motion(ANGLES * deg).s / mm, lifts(ANGLES), atol=1e-3)
    assert panel.angles.value == "crank deg"


def test_one_question_follows_another(app):
    lines = zip(range(11), np.linspace(0, 1, 11), np.linspace(0, 1, 11) ** 2 * 5, strict=True)
    open_file(app, "".join(f"{i};{x:.2f};{y:.4f}\n" for i, x, y in lines))
    panel = sheet(app)
    assert offered(panel)[0].startswith("The table has 3 columns (semicolons and decimal points)")
    assert len(offered(panel)[1]) == 6
    press(panel, "angle in column 2 (0 to 1), lift in column 3 (0 to 5)")
    assert offered(panel) == ("The angles span 1 without a unit. What are they in?", ["degrees", "radians"])
    press(panel, "radians")
    assert app.design.motion.span == pytest.approx(1.0)
    assert app.design.motion(1.0).s == pytest.approx(5 * mm, rel=1e-3)


def test_a_follower_that_swings_asks_for_angles():
    app = explore(OscillatingRollerCam())
    open_file(app, rows(heading="cam;lift\n"))
    panel = sheet(app)
    question = "The levels are read in mm, and this follower swings. What are they in?"
    assert offered(panel) == (question, ["deg", "rad"])
    press(panel, "deg")
    assert app.design.motion(90 * deg).s == pytest.approx(10 * deg, rel=1e-3)
    assert panel.within.unit == "deg"


def test_a_follower_on_a_line_asks_for_lengths(app):
    open_file(app, rows(heading="cam [deg];rocker [deg]\n"))
    panel = sheet(app)
    assert offered(panel)[0].startswith("The levels are read in deg, and this follower moves along a line.")
    press(panel, "mm")
    assert app.design.motion(90 * deg).s == pytest.approx(10 * mm, rel=1e-3)


def test_another_file_forgets_the_question(app):
    open_file(app, rows(2 * ANGLES))
    open_file(app, LOBE)
    assert offered(sheet(app)) == ("", [])


# --- other ways to read it --------------------------------------------------------------------------------------------


def pick(panel, menu, name):
    do(
        panel,
        menu,
        value=[str(option[0] if isinstance(option, tuple) else option) for option in menu.options].index(name),
    )


def test_what_was_decided_can_be_changed(app):
    open_file(app, LOBE)
    panel = sheet(app)
    pick(panel, panel.ends, "free")
    assert app.design.motion == read_motion(LOBE, rest=False)
    pick(panel, panel.lifts, "in")
    assert app.design.motion == read_motion(LOBE, rest=False, lift_unit="in")
    pick(panel, panel.lifts, "as found")
    do(panel, panel.near, value=True)
    do(panel, panel.within, value=0.02)
    assert app.design.motion == read_motion(LOBE, rest=False, tolerance=0.02 * mm)
    assert "within 0.02 mm" in panel.more.text
    do(panel, panel.near, value=False)
    assert app.design.motion == read_motion(LOBE, rest=False)


def test_a_choice_that_is_no_motion_is_refused_and_can_be_left(app):
    open_file(app, LOBE)
    panel, motion = sheet(app), app.design.motion
    pick(panel, panel.angles, "rad")
    assert alert(panel).startswith("This table cannot be used: the angles span 8021.41 deg, more than a turn")
    assert app.design.motion == motion
    assert panel.angles.value is None  # how it is read, not how it cannot be


def test_the_answers_of_a_motion_come_back_with_it(app):
    open_file(app, LOBE)
    panel = sheet(app)
    make, values = app.structure["make"], app.values
    pick(panel, panel.ends, "free")
    go_back(app, make, values)
    assert panel.ends.value is None


# --- what cannot be ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "This table cannot be used: the file is empty."),
        (b"words\n", "This table cannot be used: the file has no rows of two numbers or more"),
        (b"\x89PNG\r\n\x1a\n" + bytes(9), "This table cannot be used: the file is a PNG picture"),
        (b"0;1\n" * 4_000_000, "This table cannot be used: the file has more than 10 million bytes"),
        (rows(ANGLES * 3).encode(), "This table cannot be used: the angles span 1065 deg"),
    ],
    ids=["empty", "words", "picture", "large", "three turns"],
)
def test_what_is_no_table_changes_nothing(app, data, why):
    before = app.design
    open_file(app, data, "file.csv")
    assert alert(sheet(app)).startswith(why)
    assert app.design == before
    open_file(app, LOBE)
    assert alert(sheet(app)) == ""


def test_what_a_design_cannot_be_built_with_is_shown_and_tried_again():
    app = explore(TranslatingRollerCam(base_radius=40 * mm))
    before = app.design
    open_file(app, rows(y=lifts(ANGLES) * 3 - 55))
    panel = sheet(app)
    assert alert(panel).startswith("The table is read, but the design cannot be built with it: ")
    assert app.design == before
    assert panel.picture.visible
    assert panel.motion.row_levels[0] == pytest.approx(-55 * mm)
    move(app, "base_radius", 70)
    assert [part.visible for part in (panel.use, panel.picture)] == [True, True]
    press(panel, "Use this motion")
    assert (alert(panel), panel.use.visible) == ("", False)
    assert app.design.motion.start == pytest.approx(-55 * mm, abs=1e-5)


def test_ends_that_are_not_level_leave_a_part_of_a_cam(app):
    open_file(app, (TABLES / "segment.txt").read_bytes())
    assert app.design.motion.span == pytest.approx(30 * deg)
    assert "with ends as the rows have them" in sheet(app).told.text
    assert "a cam of it goes around this part of the turn alone" in sheet(app).told.text
    assert app.message == ""


def test_words_of_a_file_stay_words(app):
    name = "<img src=x>"
    open_file(app, rows().replace("\n", f";{name}\n"))
    assert name.upper() in sheet(app).told.text  # the page makes text nodes of it
    assert "<img src=x" not in app.html().lower()
    open_file(app, rows().replace(";", f";{name};1;"))
    assert name not in " ".join(offered(sheet(app))[1])


# --- where it stands --------------------------------------------------------------------------------------------------


def test_a_design_with_a_table_opens_with_what_is_known_of_it():
    cam = TranslatingFlatCam(read_motion(LOBE), base_radius=30 * mm)
    app = explore(from_json(to_json(cam)))
    panel = sheet(app)
    assert panel.told.text.startswith("Semicolons and decimal commas")
    assert panel.picture.visible
    assert not panel.ways.visible  # its file is not known any more
    assert app.opened == ""
    assert table_panel(app) is panel


def test_a_saved_design_brings_its_table_with_it(app):
    open_file(app, LOBE)
    saved = file_of(app, "json")
    other = explore(TranslatingFlatCam())
    open_file(other, saved, "design.json")
    assert other.design == app.design
    assert sheet(other).told.text == sheet(app).told.text


def test_a_file_is_chosen_in_the_tab_too(app):
    panel = table_panel(app)
    assert panel.told.text.startswith("Drop a table of a motion here")
    upload(panel, "Choose a table", LOBE)
    assert isinstance(app.design.motion, TableMotion)


def test_a_design_without_a_motion_takes_saved_designs_alone():
    app = explore(DoorHandleCam())
    assert app.structure["tables"] == []
    open_file(app, LOBE, "lobe.csv")
    assert app.message.startswith("This file cannot be used: ")
    assert app.tabs == []


@dataclass(frozen=True)
class TwoCams(Design):
    """Two cams on a shaft, each with a motion of its own."""

    feed: TranslatingFlatCam = field(default_factory=TranslatingFlatCam)
    stop: TranslatingFlatCam = field(default_factory=TranslatingFlatCam)

    def analyse(self, n=181):
        return self.feed.analyse(n)


def test_of_several_motions_one_is_chosen():
    app = explore(TwoCams())
    assert list(motions_in(app.design)) == ["feed.motion", "stop.motion"]
    assert app.structure["tables"] == ["feed motion", "stop motion"]
    panel = table_panel(app)
    pick(panel, panel.where, "stop.motion")
    upload(panel, "Choose a table", LOBE)
    assert isinstance(app.design.stop.motion, TableMotion)
    assert app.design.feed == TranslatingFlatCam()


def test_it_is_one_tab_of_a_panel(app):
    assert table_panel(app) is table_panel(app)
    assert isinstance(table_panel(app), TablePanel)
    assert [part.description for part in parts(table_panel(app), Button) if part.visible] == []


TURN = np.arange(0.0, 360, 2) * deg
ECCENTRIC = np.array([8 + 25 * np.cos(TURN), 25 * np.sin(TURN)])
"""The outline of a circle beside the cam axis, mm."""


def coordinates(outline, heading=""):
    return heading + "".join(f"{x:.5f};{y:.5f}\n" for x, y in outline.T)


def radii(outline, heading="angle;radius\n"):
    angle = np.arctan2(outline[1], outline[0]) / deg % 360
    order = np.argsort(angle)
    return coordinates(np.array([angle, np.hypot(*outline)])[:, order], heading)


@pytest.mark.parametrize(
    "file", [coordinates(ECCENTRIC), coordinates(ECCENTRIC, "x [mm];y [mm]\n"), radii(ECCENTRIC)], ids=["", "x", "r"]
)
def test_a_dropped_outline_is_the_cam_of_the_design_and_no_table_of_a_motion(app, file):
    open_file(app, file, "outline.csv")
    assert app.design.base_radius == pytest.approx(17 * mm, abs=2e-5 * mm)
    assert_allclose(app.design.motion(TURN).s, 8 * mm * (1 + np.cos(TURN - 90 * deg)), atol=5e-5 * mm)
    panel = sheet(app)
    assert panel.told.text.startswith("An outline of 180 points, 17 to 33 mm from the cam axis")
    assert (alert(panel), panel.ways.visible, panel.picture.visible) == ("", False, True)


@pytest.mark.parametrize("kind", ["dxf", "csv"])
def test_the_profile_that_a_page_saves_comes_back_as_the_same_cam(kind):
    design = TranslatingRollerCam(base_radius=40 * mm)
    other = explore(TranslatingRollerCam())
    open_file(other, file_of(explore(design), kind), f"profile.{kind}")
    assert other.design.base_radius == pytest.approx(40 * mm, abs=1e-3 * mm)
    assert_allclose(other.design.motion(TURN).s, design.motion(TURN).s, atol=2e-3 * mm)


def test_an_outline_that_is_none_is_refused_as_an_outline(app):
    open_file(app, coordinates(ECCENTRIC + np.array([[40], [0]])), "outline.csv")
    assert alert(sheet(app)).startswith("This outline cannot be used: the outline lies beside the cam axis, the origin")


def test_a_design_without_a_disk_cam_says_what_takes_an_outline():
    app = explore(BarrelCam())
    before = app.design
    open_file(app, coordinates(ECCENTRIC), "outline.csv")
    assert alert(sheet(app)).startswith(
        "This outline cannot be used: it goes with a disk cam, and this is a barrel cam"
    )
    assert app.design == before


def test_rows_of_a_motion_in_any_order_are_a_table_of_a_motion_if_they_say_lift(app):
    order = np.random.default_rng(1).permutation(len(ANGLES))
    open_file(app, rows(ANGLES[order], lifts(ANGLES[order]), "angle;lift\n"))
    assert "the angles must increase" in alert(sheet(app))


def test_a_saved_motion_program_is_the_motion_of_the_design(app):
    motion = OscillatingRollerCam().motion
    open_file(app, to_json(motion), "program.json")
    assert (app.design, app.message) == (TranslatingFlatCam(base_radius=30 * mm, motion=motion), "")


def test_a_saved_motion_program_without_a_place_for_it_is_refused():
    app = explore(DoorHandleCam())
    open_file(app, to_json(TranslatingRollerCam().motion), "program.json")
    assert app.message == "This file cannot be used: the file holds a motion program; a door handle cam is wanted here."
