"""The drawing as PDF, read by poppler: its pages, its texts, and its curves to the micrometre."""

import re
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest

from camkit import DoorHandleCam, TranslatingRollerCam, inch, mm
from camkit.cam import ConjugatePair, TranslatingRollerAnalysis
from camkit.files import Blank, TitleBlock, write_drawing

PLATE = TranslatingRollerCam(groove=False)
KEYED = Blank(bore=20 * mm, key="DIN 6885-1")
NAMES = TitleBlock(title="门把手凸轮 <script>", author="Мария Кюри", number="#let x = 1", material="*42CrMo4* $x$")
POINT = 25.4 / 72


def told(tool, *more):
    return subprocess.run([tool, *more], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize(
    ("cam", "sheet", "pages", "size"),
    [
        (PLATE, "A3", 1, (420, 297)),
        (PLATE, "A4", 2, (210, 297)),
        (ConjugatePair(), "A3", 2, (420, 297)),
    ],
)
def test_pages_are_as_many_and_as_large_as_the_sheets(tmp_path, cam, sheet, pages, size):
    done = write_drawing(cam, tmp_path / "cam.pdf", sheet=sheet)
    said = told("pdfinfo", done.path)
    assert f"Pages:           {pages}" in said
    found = re.search(r"Page size:\s+(\S+) x (\S+) pts", said)
    assert [float(x) * POINT for x in found.groups()] == pytest.approx(size, abs=0.05)
    assert not done.remarks


def test_texts_are_texts_in_every_script(tmp_path):
    done = write_drawing(PLATE, tmp_path / "cam.pdf", title=NAMES, blank=KEYED, tolerances={"base_radius": 0.02 * mm})
    said = told("pdftotext", done.path, "-")
    for text in (NAMES.title, NAMES.author, NAMES.number, NAMES.material, "R30 ±0.02", "Ø20 H7", "48.036", "0°"):
        assert text in said
    assert {"yes"} == {line.split()[-5] for line in told("pdffonts", done.path).splitlines()[2:]}


def test_a_letter_that_no_font_has_is_told(tmp_path):
    done = write_drawing(PLATE, tmp_path / "cam.pdf", title=TitleBlock(title="cam \U00012345"))
    assert len(done.remarks) == 1
    assert "\U00012345" in done.remarks[0]
    assert done.path.read_bytes().startswith(b"%PDF")


def test_a_faulty_cam_says_so_on_both_pages(tmp_path):
    title = TitleBlock(faults=("relief groove undercut",))
    done = write_drawing(DoorHandleCam(), tmp_path / "cam.pdf", sheet="A4", title=title)
    for page in ("1", "2"):
        assert "FAULTY: relief groove undercut" in told("pdftotext", done.path, "-f", page, "-l", page, "-")


def thick_curves(path):
    """Points on every curve of the first page that is drawn with a visible edge's line, as poppler sees it, mm."""
    svg = path.with_suffix(".svg")
    told("pdftocairo", "-svg", "-noshrink", "-origpagesizes", "-f", "1", "-l", "1", path, svg)
    for element in ElementTree.parse(svg).iter("{http://www.w3.org/2000/svg}path"):
        if "stroke-width:0.5;" in element.get("style", ""):
            numbers = re.findall(r"[-+.\de]+", element.get("transform").removeprefix("matrix"))
            a, b, c, d, e, f = map(float, numbers)
            x, y = np.array(list(bezier(element.get("d")))).T
            yield np.stack([a * x + c * y + e, b * x + d * y + f]) * POINT


def bezier(data):
    """Points along a path of lines and cubics."""
    at, u = np.zeros(2), np.linspace(0, 1, 41)[1:, None]
    for letter, numbers in re.findall(r"([MLC])([^MLCZ]*)", data):
        values = np.array(numbers.split(), dtype=float).reshape(-1, 2)
        if letter == "C":
            p, q, r = values
            yield from (1 - u) ** 3 * at + 3 * u * (1 - u) ** 2 * p + 3 * u**2 * (1 - u) * q + u**3 * r
        else:
            yield values[-1]
        at = values[-1]


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_the_profile_in_the_file_is_the_exact_one(tmp_path, unit):
    done = write_drawing(PLATE, tmp_path / "cam.pdf", unit=unit, blank=Blank(bore=inch))
    profile = TranslatingRollerAnalysis(PLATE, np.linspace(0, 2 * np.pi, 36001)).profile / mm
    size = np.ptp(profile, axis=1)
    (drawn,) = (points for points in thick_curves(done.path) if np.abs(np.ptp(points, axis=1) - size).max() < 0.01)
    centre = (drawn.max(1) + drawn.min(1)) / 2 - (profile.max(1) + profile.min(1)) / 2 * (1, -1)
    x, y = (drawn - centre[:, None]) * [[1], [-1]]
    angle = np.arctan2(profile[1], profile[0])
    order = np.argsort(angle)
    away = np.hypot(x, y) - np.interp(np.arctan2(y, x), angle[order], np.hypot(*profile)[order])
    assert np.abs(away).max() < 2e-3


def test_without_typst_a_pdf_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "typst", None)
    with pytest.raises(ModuleNotFoundError, match=r"a drawing as PDF needs typst.*camkit\[report\]"):
        write_drawing(PLATE, tmp_path / "cam.pdf")
