"""Exports of what is not meant for them, to places where nothing can be written, of sizes that are almost nothing."""

import os
from concurrent.futures import ThreadPoolExecutor

import pytest

from camkit import (
    Dwell,
    MotionProgram,
    Poly345,
    Rise,
    Session,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    door_handle_study,
    mm,
    rpm,
    um,
)
from camkit.files import Blank, Milling, write_gcode
from camkit.files.workshop.contours import contours
from camkit.files.workshop.drawing import drawing
from camkit.files.workshop.dxf import dxf
from camkit.files.workshop.gcode import gcode
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.tables import table
from camkit.files.workshop.written import Made, written

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
