"""What is built, what it holds, and `camkit lab` and `camkit app` up to the point where a browser would open."""

import email
import json
import os
import re
import socket
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from importlib.metadata import version
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from urllib.request import urlopen

import numpy
import pytest
import scipy

import camkit.__main__ as command
from camkit.workbook import FIRST, RECORD, copy, files

REPOSITORY = Path(__file__).parents[1]
PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
INSIDE = "camkit/workbook_files/"


def python(*arguments: str | Path, executable: str | Path = sys.executable, **options) -> str:
    """What a Python process prints; its error is the test's error."""
    done = subprocess.run([executable, *arguments], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the source archive and the wheel that is made of it; nothing is fetched for it."""
    folder = tmp_path_factory.mktemp("built")
    python("-m", "build", "--no-isolation", "--outdir", folder, REPOSITORY)
    return folder


@pytest.fixture(scope="module")
def wheel(built: Path) -> Path:
    return next(built.glob("camkit-*.whl"))


def described(wheel: Path) -> email.message.Message:
    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return email.message_from_bytes(archive.read(name))


# ---------------------------------------------------------------- what is built


@pytest.mark.slow
def test_the_wheel_holds_the_package_and_the_notebooks(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    packed = {name for name in archive.namelist() if ".dist-info/" not in name}
    ours = {path.relative_to(REPOSITORY).as_posix() for path in REPOSITORY.glob("camkit/**/*") if path.is_file()}
    assert {name for name in packed if not name.startswith(INSIDE)} == {n for n in ours if "__pycache__" not in n}
    notebooks = {name.removeprefix(INSIDE) for name in packed if name.startswith(f"{INSIDE}notebooks/")}
    assert notebooks == {f"notebooks/{name}" for name in files()}
    assert all(archive.read(INSIDE + name) == (REPOSITORY / name).read_bytes() for name in notebooks)
    settings = {name.removeprefix(f"{INSIDE}.jupyter/") for name in packed} - packed
    assert {"jupyter_server_config.py", "labconfig/default_setting_overrides.json"} < settings
    assert "cards.py" not in settings


@pytest.mark.slow
def test_the_source_archive_can_build_and_check_itself(built: Path) -> None:
    with tarfile.open(next(built.glob("camkit-*.tar.gz"))) as archive:
        held = {name.partition("/")[2] for name in archive.getnames()}
    assert {"Makefile", "constraints.txt", "hatch_build.py", "tests/test_package.py", ".ci/run"} < held
    assert {f"notebooks/{name}" for name in files()} < held
    assert not [name for name in held if re.search(r"(^|/)(\.venv|\.camkit|__pycache__|\.ipynb_checkpoints)/", name)]


@pytest.mark.slow
def test_the_description_shows_on_an_index_what_is_there(wheel: Path) -> None:
    """Nobody can look into a repository from there: no relative picture, no relative link."""
    told = described(wheel)
    assert told["Description-Content-Type"] == "text/markdown"
    text = str(told.get_payload())
    assert "# camkit" in text
    assert "pip install" in text
    assert re.findall(r"!\[[^\]]*\]\((?!https:)[^)]*\)", text) == []
    assert re.findall(r"\]\((?!https:|#)[^)]*\)", text) == []
    assert told["Version"] == camkit_version()


def camkit_version() -> str:
    return re.search(r'__version__ = "(.+)"', (REPOSITORY / "camkit/__init__.py").read_text(encoding="utf-8"))[1]  # type: ignore[index]


def test_a_link_of_the_readme_stays_as_its_words() -> None:
    spec = spec_from_file_location("hatch_build", REPOSITORY / "hatch_build.py")
    assert spec and spec.loader  # noqa: PT018
    spec.loader.exec_module(build := module_from_spec(spec))
    text = "![panel](a/b.png)[one](a.md) [two](https://doi.org/1) [three](#three)"
    assert build.elsewhere(text) == "one [two](https://doi.org/1) [three](#three)"
    assert build.elsewhere("[![live](a.png)](b.ipynb), then") == ", then"


# ---------------------------------------------------------------- installed from the wheel


@pytest.fixture(scope="module")
def alone(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment with the wheel beside numpy and scipy, and nothing else."""
    folder = tmp_path_factory.mktemp("alone")
    python("-m", "venv", "--without-pip", folder)
    site = Path(sysconfig.get_path("purelib", "venv", {"base": str(folder)}))
    for package in (numpy, scipy):  # linked, not installed again: they are large
        installed = Path(package.__file__).parent
        for part in installed.parent.glob(f"{installed.name}*"):  # the package, its version, its libraries
            (site / part.name).symlink_to(part)
    python("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", site, wheel)
    return folder


def in_it(alone: Path, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    clean = {name: value for name, value in os.environ.items() if not re.match("PYTHON|COV", name)}
    command = [alone / "bin/python", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=clean)


@pytest.mark.slow
def test_the_wheel_works_beside_numpy_and_scipy_alone(alone: Path, tmp_path: Path) -> None:
    code = "import camkit; from camkit import *; print(camkit.__file__, 50 * mm, 'explore' in dir(camkit))"
    path, length, panels = in_it(alone, "-c", code, cwd=tmp_path).stdout.split()
    assert Path(path).is_relative_to(alone)
    assert (length, panels) == ("0.05", "False")


@pytest.mark.slow
def test_without_the_extra_lab_says_what_to_install_and_copies_nothing(alone: Path, tmp_path: Path) -> None:
    done = in_it(alone, "-m", "camkit", "lab", cwd=tmp_path)
    said = "camkit: the workbook needs jupyterlab, which is not installed: pip install 'camkit[lab]'"
    assert (done.returncode, done.stdout, done.stderr.strip()) == (2, "", said)
    done = in_it(alone, "-m", "camkit", "app", cwd=tmp_path)
    assert (done.returncode, done.stderr.strip()[-25:]) == (2, "pip install 'camkit[app]'")
    assert not [*tmp_path.iterdir()]


@pytest.mark.slow
def test_an_installed_camkit_copies_the_notebooks_of_its_wheel(alone: Path, tmp_path: Path) -> None:
    code = "from pathlib import Path; from camkit.workbook import copy; print(copy(Path('here')))"
    assert in_it(alone, "-c", code, cwd=tmp_path).stdout == f"{len([*files()])} copied\n"
    for name in files():
        assert (tmp_path / "here" / name).read_bytes() == (REPOSITORY / "notebooks" / name).read_bytes()


# ---------------------------------------------------------------- copying


def test_all_is_copied_once(tmp_path: Path) -> None:
    assert copy(tmp_path / "a" / "b").new == [*files()]
    assert str(copy(tmp_path / "a" / "b")) == "all files are there"


def test_what_the_user_has_changed_stays(tmp_path: Path) -> None:
    copy(tmp_path)
    (tmp_path / FIRST).write_text("mine", encoding="utf-8")
    (tmp_path / "images/door_handle_panel.png").unlink()
    assert str(copy(tmp_path)) == f"1 copied, kept as you changed it: {FIRST}"
    assert (tmp_path / FIRST).read_text(encoding="utf-8") == "mine"


def test_a_file_of_an_earlier_camkit_that_nobody_changed_is_brought_up_to_date(tmp_path: Path, monkeypatch) -> None:
    copy(tmp_path)
    newer = tmp_path / "newer"
    (newer / "notebooks").mkdir(parents=True)
    for name in (FIRST, "01_door_handle_cam.ipynb"):
        (newer / "notebooks" / name).write_text("newer", encoding="utf-8")
    (tmp_path / "01_door_handle_cam.ipynb").write_text("mine", encoding="utf-8")
    monkeypatch.setattr("camkit.workbook.home", lambda: newer)
    assert copy(tmp_path) == ([], [FIRST], ["01_door_handle_cam.ipynb"])
    assert (tmp_path / FIRST).read_text(encoding="utf-8") == "newer"
    assert (tmp_path / "01_door_handle_cam.ipynb").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("record", ["{", "[1]", "[" * 100_000, '{"00_start_here.ipynb": 1}', None])
def test_without_a_readable_record_every_other_file_is_the_users(tmp_path: Path, record: str | None) -> None:
    copy(tmp_path)
    (tmp_path / FIRST).write_text("mine", encoding="utf-8")
    (tmp_path / RECORD).unlink()
    if record is not None:
        (tmp_path / RECORD).write_text(record, encoding="utf-8")
    assert copy(tmp_path).kept == [FIRST]


def test_the_notebooks_of_a_clone_are_opened_where_they_are() -> None:
    assert str(copy(REPOSITORY / "notebooks")) == "all files are there"
    assert not (REPOSITORY / "notebooks" / RECORD).exists()


# ---------------------------------------------------------------- the commands


def told(*arguments: str, cwd: Path) -> str:
    return python("-m", "camkit", *arguments, cwd=cwd, env=os.environ | {"PYTHONPATH": str(REPOSITORY)})


@pytest.mark.slow
def test_lab_copies_and_hands_options_and_settings_over(tmp_path: Path) -> None:
    """`--show-config-json` is JupyterLab's own: it says how it would run, and ends."""
    said = told("lab", "--port", "8899", "--no-browser", "--ServerApp.token=abc", "--show-config-json", cwd=tmp_path)
    copied, opening, config = said.split("\n", 2)
    assert copied == f"camkit-notebooks: {len([*files()])} copied"
    assert opening.startswith(f"Opening {Path('camkit-notebooks', FIRST)} in JupyterLab")
    server = json.loads(config)["ServerApp"]
    assert server["token"] == "abc"
    assert (server["port"], server["open_browser"]) == (8899, False)
    assert "contents_manager_class" in server  # of our own settings
    assert told("lab", "--version", cwd=tmp_path).split()[-1] == version("jupyterlab")


@pytest.mark.slow
def test_app_shows_the_cards_to_this_machine_alone(tmp_path: Path) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    arguments = [sys.executable, "-m", "camkit", "app", "here", f"--port={port}", "--no-browser"]
    given = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    with subprocess.Popen(arguments, cwd=tmp_path, env=given, stderr=subprocess.PIPE, text=True) as server:
        assert server.stderr
        try:
            said = next(line for line in server.stderr if f":{port}/" in line)
            assert f"http://127.0.0.1:{port}/" in said
            page = urlopen(f"http://127.0.0.1:{port}/").read().decode()
        finally:
            server.terminate()
    assert "How large does a cam have to be?" in page
    assert all(f"{Path(name).stem}.png" in page for name in files() if name.startswith("images/cards/"))
    assert (tmp_path / "here" / "voila.json").is_file()


def test_a_folder_that_is_a_file_is_refused_in_a_sentence(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("work").write_text("mine", encoding="utf-8")
    assert command.main(["lab", "work"]) == 2
    assert "Traceback" not in (said := capsys.readouterr().err)
    assert said.startswith("camkit: work")
    assert command.main(["check", "cam.json", "--port=1"]) == 2
    assert "unrecognized arguments: --port=1" in capsys.readouterr().err
