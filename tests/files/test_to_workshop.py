"""One zip with all that a workshop takes, the same for the same design; a faulty one only if somebody insists."""

import csv
import io
import json
import re
import zipfile

import numpy as np
import pytest

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam, UniversalJointShaft, mm, to_workshop
from camkit.cam import ConjugatePair
from camkit.files import TitleBlock, from_json
from camkit.files.workshop import exports
from camkit.files.workshop.exports import EXPORTS, Order, exports_of
from camkit.files.workshop.package import README, package

DATED = TitleBlock(date="2026-11-30")
HOSTILE = TitleBlock(
    title="Кулачок <script>alert(1)</script>", number="=1+1", author="王小明\nFAULTY: no", date="2026-11-30"
)


def opened(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="module")
def roller():
    return package(Order(TranslatingRollerCam(), title=DATED))


def test_a_zip_is_written_with_what_it_says(tmp_path, few):
    done = to_workshop(TranslatingRollerCam(), tmp_path / "cam.zip", title=DATED)
    files = opened(done.path.read_bytes())
    assert done.what == f"{len(files) - 1} files and README.txt"
    assert np.isnan(done.deviation)
    assert list(tmp_path.iterdir()) == [done.path]


def test_every_file_is_named_in_the_text_and_the_text_names_no_other(roller):
    files = opened(roller.data)
    text = files.pop(README).decode()
    named = {line for line in text.splitlines() if line.startswith("TranslatingRollerCam")}
    assert named == set(files)
    for export in EXPORTS:
        if f"TranslatingRollerCam{export.ending}" in files:
            assert export.use in " ".join(text.split())


def test_the_design_comes_back(roller):
    files = opened(roller.data)
    assert from_json(files["TranslatingRollerCam.json"]) == TranslatingRollerCam()


def test_the_same_design_gives_the_same_zip(roller):
    again, before = (opened(data) for data in (package(Order(TranslatingRollerCam(), title=DATED)).data, roller.data))
    assert list(again) == list(before)
    assert [name for name in again if again[name] != before[name]] == []


@pytest.fixture
def few(monkeypatch):
    """The first of the exports alone, where the text beside them is what counts."""
    monkeypatch.setattr(exports, "EXPORTS", exports.EXPORTS[:1])


def test_a_faulty_design_is_refused_and_marked_if_somebody_insists(tmp_path, few):
    with pytest.raises(ValueError, match=r"undercut .*; insist=True writes it nevertheless, marked FAULTY"):
        to_workshop(DoorHandleCam(), tmp_path / "cam.zip", title=DATED)
    assert not list(tmp_path.iterdir())
    done = to_workshop(DoorHandleCam(), tmp_path / "cam.zip", title=DATED, insist=True)
    assert "undercut" in done.remarks[0]
    assert "FAULTY: relief groove undercut" in opened(done.path.read_bytes())[README].decode()


def test_a_pair_and_a_shaft_get_what_they_have():
    for design in (ConjugatePair(), UniversalJointShaft()):
        made = package(Order(design, title=DATED))
        assert {f"{type(design).__name__}.json", README} <= set(opened(made.data))


def test_names_of_a_title_stay_text(few):
    text = opened(package(Order(TranslatingRollerCam(), title=HOSTILE)).data)[README].decode()
    assert "Кулачок <script>" in text
    assert "王小明" in text
    assert not [line for line in text.splitlines() if line.startswith("FAULTY")]


@pytest.mark.parametrize(("rotation", "said"), [(1, "turns counter-clockwise."), (-1, "turns clockwise.")])
def test_the_text_says_which_way_the_cam_turns(rotation, said, few):
    text = opened(package(Order(TranslatingRollerCam(rotation=rotation), title=DATED)).data)[README].decode()
    assert said in text
    assert "turns" not in opened(package(Order(UniversalJointShaft(), title=DATED)).data)[README].decode()


def test_a_tool_that_is_too_large_for_the_groove_is_said_to_be_another():
    (export,) = (each for each in EXPORTS if each.key == "nc")
    made = export.make(Order(TranslatingRollerCam(), tool_radius=20 * mm))
    assert "a tool of radius 20 mm does not go into the groove: this is for 8 mm" in made.remarks
    assert "tool of radius 8 mm" in made.what
    assert not [said for said in export.make(Order(TranslatingRollerCam())).remarks if "go into the groove" in said]


def test_the_list_of_files_has_each_key_and_ending_once():
    assert len({export.key for export in EXPORTS}) == len(EXPORTS) == len({export.ending for export in EXPORTS})
    assert {export.key for export in exports_of(Order(UniversalJointShaft()))} >= {"json"}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"unit": "furlong"}, "'mm', 'in'"),
        ({"tool_radius": 0.0}, "the radius of the tool is 0"),
        ({"tool_radius": float("nan")}, "tool_radius"),
        ({"title": "a cam"}, "the argument title"),
        ({"insist": "yes"}, "the argument insist"),
        ({"least_yield": None}, "the argument least_yield"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(tmp_path, given, said):
    with pytest.raises(ValueError, match=said):
        to_workshop(TranslatingRollerCam(), tmp_path / "cam.zip", **given)
    assert not list(tmp_path.iterdir())


def test_the_schema_of_the_design_in_the_zip_is_that_of_designs(roller):
    assert json.loads(opened(roller.data)["TranslatingRollerCam.json"])["schema"] == "camkit/1"


@pytest.mark.parametrize(("halves", "half"), [({"base_radius": 0.1 * mm}, 0.1), (None, 0.025)])
def test_the_inspection_asks_for_what_the_drawing_asks_for(halves, half):
    order = Order(TranslatingFlatCam(), title=DATED, tolerances=halves)
    made = {export.key: export.make for export in EXPORTS if export.key in ("inspection", "picture")}
    heads, first, *_ = csv.reader(made["inspection"](order).data.decode("utf-8-sig").splitlines())
    limits = [float(first[heads.index(f"{side} limit [mm]")]) for side in ("lower", "upper")]
    assert limits == pytest.approx([-half, half])
    assert f"in a zone {2 * half:g} wide" in " ".join(re.findall(">([^<>]+)<", made["picture"](order).data.decode()))
