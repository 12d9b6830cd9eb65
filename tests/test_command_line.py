"""`camkit check`, `export` and `optimise`: what they print, what they write, how they end, and no traceback ever."""

import json
import subprocess
import sys
import zipfile

import numpy as np
import pytest

import camkit.__main__ as command
from camkit import (
    DoorHandleCam,
    Session,
    TranslatingRollerCam,
    door_handle_study,
    mm,
    nsga2,
    read,
    shaft_study,
    write,
)
from camkit.cam import max_pressure_angle
from camkit.data import load
from camkit.files import Decision
from camkit.files.workshop import exports

SHAFT = shaft_study()


@pytest.fixture
def files(tmp_path, monkeypatch):
    """A folder with saved files, in which the commands run."""
    monkeypatch.chdir(tmp_path)
    door = door_handle_study()
    write(TranslatingRollerCam(), "cam.json")
    write(DoorHandleCam(), "door.json")
    write(Session(door, door.start), "study.json")
    write(Session(SHAFT, SHAFT.start), "shaft.json")
    write(TranslatingRollerCam().motion, "program.json")
    return tmp_path


def asked(capsys, *arguments):
    """The exit code of a command, and what it says on stdout and stderr."""
    code = command.main([*arguments])
    said = capsys.readouterr()
    assert "Traceback" not in said.err
    return code, said.out, said.err


# ---------------------------------------------------------------- check


def test_a_sound_design_with_its_measures(files, capsys):
    code, out, err = asked(capsys, "check", "cam.json")
    assert (code, err) == (0, "")
    analysis = TranslatingRollerCam().analyse()
    assert [line.split("  ")[-1].strip() for line in out.splitlines() if "maximum pressure angle" in line] == [
        max_pressure_angle.text(max_pressure_angle.one(analysis))
    ]
    assert out.splitlines()[-1] == "nothing is wrong with it"


def test_a_faulty_design_ends_with_1_and_says_why(files, capsys):
    code, out, _ = asked(capsys, "check", "door.json")
    assert code == 1
    assert "FAULTY: relief groove undercut at 20.6 to 26.1 deg" in out


def test_limits_of_a_study_and_which_are_missed(files, capsys):
    code, out, _ = asked(capsys, "check", "study.json")
    assert code == 1
    assert "43.54 deg  (at most 45 deg, kept)" in out
    assert "-0.8749  (at least 0.1, missed)" in out
    assert "FAULTY: the undercut margin, worse curve is -0.8749; it must be at least 0.1" in out


def test_the_yield_of_a_study_under_tolerances(files, capsys):
    half = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}
    write(Session(SHAFT.under(half), SHAFT.start), "robust.json")
    code, out, _ = asked(capsys, "check", "robust.json")
    assert code == 1
    assert "at least 99 %" in out
    assert "FAULTY: the yield is" in out
    wide = SHAFT.start.replace(outer_diameter=0.135)
    write(Session(SHAFT.under(half), wide), "robust.json")
    assert asked(capsys, "check", "robust.json")[0] == 0


def test_the_design_of_a_decision_and_of_a_front(files, capsys):
    front = nsga2(door_handle_study(), population=20, generations=9, seed=1)
    write(front, "front.json")
    write(Decision(front, 3), "decision.json")
    assert asked(capsys, "check", "front.json")[0] == 1  # of its start, which is undercut
    code, out, _ = asked(capsys, "check", "decision.json")
    assert code == 0, out
    assert "missed" not in out


def test_remarks_of_a_file_go_to_stderr(files, capsys):
    text = (files / "cam.json").read_text()
    assert '"roller_radius [mm]": 8.0' in text
    (files / "cam.json").write_text(text.replace('"roller_radius [mm]": 8.0', '"roller_radius [mm]": 9.0'))
    code, _, err = asked(capsys, "check", "cam.json")
    assert code == 0
    assert "cam.json: its content does not match its digest" in err


# ---------------------------------------------------------------- export


def test_files_that_are_asked_for(files, capsys):
    code, out, err = asked(capsys, "export", "cam.json", "--json", "--out", "made")
    assert (code, err) == (0, "")
    assert out.startswith("TranslatingRollerCam.json: the design")
    assert read("made/TranslatingRollerCam.json") == TranslatingRollerCam()
    assert [path.name for path in (files / "made").iterdir()] == ["TranslatingRollerCam.json"]


def test_tables_by_their_kinds(files, capsys):
    assert asked(capsys, "export", "cam.json", "--table", "radii", "motion", "--out", "made")[0] == 0
    assert sorted(path.name for path in (files / "made").iterdir()) == [
        "TranslatingRollerCam-motion.csv",
        "TranslatingRollerCam-radii.csv",
    ]
    code, _, err = asked(capsys, "export", "cam.json", "--table", "joints")
    assert code == 2
    assert "of a TranslatingRollerCam there is no joints; there can be --json, --dxf" in err
    assert "--table " in err
    assert "csv radii motion workbook" in err


def test_all_files_and_the_zip_are_the_same_files(files, capsys):
    date = ("--date", "2026-11-30")
    assert asked(capsys, "export", "cam.json", "--all", "--out", "made", *date)[0] == 0
    assert asked(capsys, "export", "cam.json", "--zip", *date, "--title", "Кулачок <b>")[0] == 0
    with zipfile.ZipFile("TranslatingRollerCam.zip") as archive:
        names = set(archive.namelist()) - {"README.txt"}
        assert "Кулачок <b>" in archive.read("README.txt").decode()
    assert names == {path.name for path in (files / "made").iterdir()}


def test_a_faulty_design_is_written_only_if_somebody_insists(files, capsys, monkeypatch):
    monkeypatch.setattr(exports, "EXPORTS", exports.EXPORTS[:1])
    code, out, err = asked(capsys, "export", "door.json", "--json", "--zip")
    assert (code, out) == (1, "")
    assert "undercut" in err
    assert "--insist" in err
    assert not list(files.glob("DoorHandleCam*"))
    assert asked(capsys, "export", "door.json", "--json", "--zip", "--insist")[0] == 0
    with zipfile.ZipFile("DoorHandleCam.zip") as archive:
        assert "FAULTY: relief groove undercut" in archive.read("README.txt").decode()


def test_sizes_of_the_blank_as_they_are_typed(files, capsys):
    given = command.parser().parse_args(
        ["export", "cam.json", "--unit", "in", "--bore", "1", "--key", "ANSI B17.1", "--thickness", "12mm",
         "--key-angle", "90", "--tool-radius", "0,25"]
    )  # fmt: skip
    assert (given.bore, given.tool_radius) == ("1", "0,25")
    assert asked(capsys, "export", "cam.json", "--json", "--unit", "in", "--bore", "1", "--key", "ANSI B17.1")[0] == 0
    code, _, err = asked(
        capsys, "export", "cam.json", "--json", "--bore", "1in", "--key", "DIN 6885-1", "--hub-diameter", "26"
    )
    assert code == 2
    assert "the hub diameter is 26 mm; with its keyway the bore takes" in err


# ---------------------------------------------------------------- optimise


def test_a_front_is_found_as_in_a_notebook(files, capsys):
    code, out, err = asked(
        capsys,
        "optimise",
        "study.json",
        "--seed",
        "3",
        "--generations",
        "6",
        "--population",
        "20",
        "--out",
        "found.json",
    )
    assert code == 0, err
    found = read("found.json")
    front = nsga2(door_handle_study(), population=20, generations=6, seed=3)
    assert np.allclose(found.front.x, front.x, rtol=1e-12, atol=0)
    assert out.startswith(f"found.json: {len(front)} designs of 120 evaluated")
    assert found.search["seed"] == 3
    assert "of 6" in err
    assert not list(files.glob("*.search"))


def test_a_minimum_is_found(files, capsys):
    code, out, _ = asked(capsys, "optimise", "shaft.json")
    assert code == 0
    assert "Converged" in out
    found = read("shaft.found.json")
    assert SHAFT.evaluate(SHAFT.x_of(found.design)).feasible.all()
    assert SHAFT.evaluate(SHAFT.x_of(found.design)).f[0, 0] < SHAFT.evaluate(SHAFT.x0).f[0, 0]


def test_a_search_that_is_stopped_goes_on_to_the_same_front(files, capsys, monkeypatch):
    how = ("--seed", "1", "--generations", "8", "--population", "20", "--out", "found.json")
    assert asked(capsys, "optimise", "study.json", *how)[0] == 0
    whole, searches = read("found.json").front.x, command.search
    (files / "found.json").unlink()

    def interrupted(*given, **more):
        for step in searches(*given, **more):
            yield step
            if step.number == 3:
                raise KeyboardInterrupt

    monkeypatch.setattr(command, "search", interrupted)
    code, _, err = asked(capsys, "optimise", "study.json", *how)
    assert code == 130
    assert "the same command goes on" in err
    assert [path.name for path in files.glob("found*")] == ["found.search"]
    monkeypatch.setattr(command, "search", searches)
    code, _, err = asked(capsys, "optimise", "study.json", *how)
    assert code == 0
    assert err.splitlines()[0].startswith("3 of 8")
    assert (read("found.json").front.x == whole).all()


def test_a_study_that_no_design_can_keep_ends_with_1(files, capsys):
    stress = next(measure for measure, _, _ in SHAFT.limits)
    write(Session(SHAFT.replace(at_most={**SHAFT.at_most, stress: 1e-3}), SHAFT.start), "hard.json")
    code, out, _ = asked(capsys, "optimise", "hard.json")
    assert code == 1
    assert "hard.found.json: 0 designs" in out
    assert stress.name in out


# ---------------------------------------------------------------- what cannot be done


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "arguments are required"),
        (("weigh", "cam.json"), "invalid choice"),
        (("check",), "arguments are required"),
        (("check", "nothing.json"), "nothing.json: No such file or directory"),
        (("check", "."), "Is a directory"),
        (("check", "program.json"), "holds no design"),
        (("check", "noise.json"), "noise.json: the file is no text"),
        (("export", "cam.json"), "no file is asked for; of a TranslatingRollerCam there can be --json"),
        (("export", "cam.json", "--json", "--unit", "furlong"), "'mm', 'in'"),
        (("export", "cam.json", "--json", "--bore", "five"), "--bore: 'five' is no number"),
        (("export", "cam.json", "--json", "--key", "mine"), "it must be one of none, DIN 6885-1, ANSI B17.1"),
        (("export", "cam.json", "--json", "--tool-radius", "-1"), "the radius of the tool is -0.001"),
        (("export", "cam.json", "--json", "--out", "cam.json"), "cam.json: File exists"),
        (("optimise", "cam.json"), "holds a design; a study"),
        (("optimise", "study.json", "--method", "luck"), "the method is 'luck'"),
        (("optimise", "study.json", "--population", "1"), "the population is 1"),
        (("optimise", "study.json", "--seed", "one"), "invalid int value"),
        (("optimise", "study.json", "--out", "nowhere/found.json"), "there is no folder"),
    ],
)
def test_what_cannot_be_done_is_a_sentence_and_ends_with_2(files, capsys, arguments, said):
    (files / "noise.json").write_bytes(b"\x00\xff{")
    code, out, err = asked(capsys, *arguments)
    assert (code, out) == (2, "")
    assert said in err


@pytest.mark.parametrize(
    "arguments", [["--help"], ["check", "--help"], ["export", "--help"], ["optimise", "--help"], ["schema", "--help"]]
)
def test_help_has_examples_and_the_exit_codes(capsys, arguments):
    code, out, _ = asked(capsys, *arguments)
    assert code == 0
    assert "camkit check cam.json" in out
    assert "exit codes:" in out


def test_the_schema_is_the_one_that_is_published(capsys):
    code, out, _ = asked(capsys, "schema")
    assert code == 0
    assert json.loads(out) == load("schema")


def test_it_runs_as_a_module_and_says_its_version():
    done = subprocess.run([sys.executable, "-m", "camkit", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["camkit", camkit_version()]


def camkit_version():
    from importlib.metadata import version

    return version("camkit")


def test_a_saved_session_is_json_of_the_same_schema(files, capsys):
    asked(capsys, "optimise", "shaft.json")
    assert json.loads((files / "shaft.found.json").read_text())["schema"] == "camkit/1"
