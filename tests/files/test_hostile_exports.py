"""Exports of what is not meant for them, to places where nothing can be written, of sizes that are almost nothing."""

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from camkit import (
    Dwell,
    MotionProgram,
    OscillatingRollerCam,
    Poly345,
    Rise,
    Session,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    door_handle_study,
    mm,
    rpm,
    to_workshop,
    um,
    write_dxf,
)
from camkit.cam import CamWithPins, DrivenCam, cam_from_outline
from camkit.dynamics import ElasticFollower
from camkit.files import (
    Blank,
    Milling,
    TitleBlock,
    from_json,
    write_3mf,
    write_drawing,
    write_gcode,
    write_report,
    write_step,
    write_stl,
    write_table,
)
from camkit.files.workshop.contours import contours
from camkit.files.workshop.deviations import half_widths
from camkit.files.workshop.drawing import drawing
from camkit.files.workshop.dxf import dxf
from camkit.files.workshop.exports import EXPORTS, Order
from camkit.files.workshop.gcode import gcode
from camkit.files.workshop.report import report
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.tables import table
from camkit.files.workshop.written import Made, written
from camkit.study.spread import Source, Tolerance, iso_2768

FLAT = TranslatingFlatCam()


def test_threads_that_write_the_same_file_leave_one_of_them_whole(tmp_path):
    path, contents = tmp_path / "cam.ngc", [bytes([65 + k]) * 20_000 for k in range(4)]
    with ThreadPoolExecutor(4) as pool:
        done = [*pool.map(lambda content: written(Made(content, "letters"), path).path, contents * 50)]
    assert done == [path] * 200
    assert path.read_bytes() in contents
    assert os.listdir(tmp_path) == ["cam.ngc"]


def test_there_must_be_a_folder_to_write_into(tmp_path):
    with pytest.raises(ValueError, match=r"^there is no folder .* to write 'cam.ngc' into$"):
        write_gcode(FLAT, tmp_path / "none" / "cam.ngc")


def test_what_was_there_stays_when_writing_fails(tmp_path):
    path = tmp_path / "cam.ngc"
    path.write_text("good")
    with pytest.raises(ValueError, match="tool radius"):
        write_gcode(FLAT, path, tool_radius=0.0)
    (tmp_path / f".cam.ngc.{os.getpid()}.part").mkdir()  # nothing can be written beside it
    with pytest.raises(OSError, match="directory"):
        written(Made(b"new", "letters"), path)
    assert path.read_text() == "good"


def test_a_session_and_a_study_are_exported_as_their_design():
    study = door_handle_study()
    for given in (study, Session(study, study.start)):
        (subject,) = subjects(given)
        assert subject.design is study.start
        assert subject.analysis.profile.shape[0] == 2


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"feed": 1e-12}, "feed .* at least 1 mm/min"),
        ({"plunge_feed": 1e-9}, "plunge feed .* at least 1 mm/min"),
        ({"safe_height": 1e-12}, "safe height .* at least 0.1 mm"),
        ({"spindle_speed": 0.4 * rpm}, "spindle speed is 0.4 rpm; it must be 0 or at least 1 rpm"),
        ({"lead_in": 1e-12}, "lead in is 1e-09 mm; it must be 0 or at least 0.01 mm"),
        ({"depth": 1 * um}, "depth is 0.001 mm; it must be at least 0.01 mm"),
    ],
)
def test_what_would_be_written_as_nothing_is_refused(given, said):
    with pytest.raises(ValueError, match=said):
        Milling(**given).levels(given.get("depth", 10 * mm))


def test_a_blank_as_thin_as_nothing_is_not_milled():
    with pytest.raises(ValueError, match="depth is 1e-09 mm"):
        gcode(FLAT, blank=Blank(thickness=1e-12))


SHORT = MotionProgram((Rise(0.01 * deg, 10 * um, Poly345()),))


def test_a_profile_of_which_nothing_is_left_is_refused_in_a_sentence():
    cam = TranslatingRollerCam(SHORT, groove=False)
    for make in (gcode, dxf, lambda given: table(given, "polar")):
        with pytest.raises(ValueError, match=r"^the tool leaves no piece of the profile whole: it is undercut$"):
            make(cam)


def test_a_groove_shorter_than_what_is_lost_of_it_has_contours():
    (subject,) = subjects(TranslatingRollerCam(SHORT))
    assert {"GROOVE", "PITCH", "FAULT"} <= {contour.layer for contour in contours(subject)}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("groove", [False, True])
def test_a_circle_is_drawn_without_a_warning(groove):
    cam = TranslatingRollerCam(MotionProgram((Dwell(360 * deg),)), groove=groove)
    assert gcode(cam, tool_radius=6 * mm).deviation < 1 * um


def test_a_face_that_rests_is_drawn():
    """It touches the cam at one point: it is as long as nothing."""
    assert drawing(TranslatingFlatCam(MotionProgram((Dwell(360 * deg),))), ".svg").deviation < 1 * um


WRITERS = {
    write_gcode: "a program of G-code ends in .ngc or .nc or .tap or .cnc or .gcode or .txt",
    write_dxf: "a DXF drawing ends in .dxf",
    write_step: "a STEP file ends in .step or .stp",
    write_stl: "an STL file ends in .stl",
    write_3mf: "a 3MF file ends in .3mf",
    write_drawing: "a drawing ends in .svg or .pdf",
    write_report: "a report ends in .pdf or .html",
    write_table: "a table of profile ends in csv or xlsx",
    to_workshop: "what goes to the workshop ends in .zip",
}


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_another_ending_or_no_folder_is_refused_before_anything_is_made(write, tmp_path, monkeypatch):
    monkeypatch.setattr(type(FLAT), "analyse", lambda cam: pytest.fail("it is analysed"))
    with pytest.raises(ValueError, match=rf"^{WRITERS[write]}, not in '.?png'$"):
        write(FLAT, tmp_path / "cam.png")
    with pytest.raises(ValueError, match=r"^there is no folder"):
        write(FLAT, tmp_path / "none" / "cam.png")


def test_cam_tables_are_no_workbooks(tmp_path):
    with pytest.raises(ValueError, match=r"^a table of codesys ends in csv, not in 'xlsx'$"):
        write_table(FLAT, tmp_path / "cam.xlsx", "codesys")


@pytest.mark.parametrize(
    "whole",
    [
        CamWithPins(OscillatingRollerCam(groove=False)),
        DrivenCam(),
        ElasticFollower(TranslatingRollerCam(groove=False)),
    ],
    ids=lambda whole: type(whole).__name__,
)
def test_what_is_around_a_cam_goes_to_the_workshop_too(whole):
    order = Order(whole, title=TitleBlock(author="M. Curie"))
    for same in (order, replace(order, unit="in")):
        assert same.kind == type(whole).__name__
        (design,) = (export for export in EXPORTS if export.key == "json")
        assert from_json(design.make(same).data.decode()) == whole


def test_half_widths_are_those_of_tolerances_of_every_kind():
    cam = TranslatingRollerCam(base_radius=40 * mm)
    wall = Source("wall", {"base_radius": 1.0, "roller_radius": -0.5})
    for given in (20 * um, Tolerance(20 * um), Tolerance((-20 * um, 20 * um), "normal"), (-20 * um, 20 * um)):
        assert half_widths(cam, {"base_radius": given}) == {"base_radius": pytest.approx(20 * um)}
    assert half_widths(cam, {"base_radius": iso_2768}) == {"base_radius": pytest.approx(0.3 * mm)}  # 30 to 120 mm, m
    found = half_widths(cam, {wall: Tolerance(20 * um), "base_radius": 5 * um})
    assert found == {"base_radius": pytest.approx(25 * um), "roller_radius": pytest.approx(10 * um)}
    with pytest.raises(ValueError, match=r"^the tolerance of the base radius goes from -1e-05 to 2e-05 .* both sides$"):
        half_widths(cam, {"base_radius": Tolerance((-10 * um, 20 * um))})
    with pytest.raises(ValueError, match=r"^'bore' is no quantity of TranslatingRollerCam"):
        half_widths(cam, {Source("wall", {"bore": 1.0}): 20 * um})


def test_an_inspection_file_knows_tolerances_with_sources():
    cam = TranslatingRollerCam(groove=False)
    of_source, plain = (
        Order(cam, tolerances={key: Tolerance(20 * um)}).limits
        for key in (Source("wall", {"base_radius": 1.0}), "base_radius")
    )
    assert of_source == plain == pytest.approx((-20 * um, 20 * um), rel=1e-3)


def test_rows_at_one_place_of_32_bits_are_one_row():
    """The motion of a measured outline has samples that lie a millionth of a degree beside whole degrees."""
    turn = np.linspace(0, 2 * np.pi, 721)
    cam = cam_from_outline(40 * mm * np.array([np.cos(turn) - 0.375, np.sin(turn)]), TranslatingFlatCam())
    made = table(cam, "rockwell")
    master = np.array([line.split(",")[0] for line in made.data.decode().splitlines()[1:]], dtype=np.float32)
    assert (np.diff(master) > 0).all()
    assert (master[0], master[-1]) == (0, 360)
    assert made.deviation < 1 * um


def test_a_title_of_ten_thousand_letters_is_cut_on_a_sheet():
    for title in ("x" * 10_000, "ij " * 4000, "\u51f8" * 10_000):
        made = drawing(FLAT, ".svg", title=TitleBlock(title, title, title, title, title, (title,)))
        assert made.deviation < 1 * um
        assert "\u2026" in made.data.decode()


def test_half_a_letter_is_left_out_of_a_report():
    page = report(FLAT, ".html", TitleBlock("inlet\ud800cam", author="\udfff")).data.decode()
    assert "inletcam" in page.replace(" ", "")
