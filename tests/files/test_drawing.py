"""The workshop drawing: read back from its SVG, to scale, saying what the design says, nothing on top of anything."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import (
    DoorHandleCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    ValveCam,
    deg,
    inch,
    mm,
    um,
)
from camkit.cam import BarrelCam, ConjugatePair, TranslatingRollerAnalysis, max_pressure_angle
from camkit.files import Blank, TitleBlock, write_drawing
from camkit.files.workshop.arcs import ArcPath, distances
from camkit.files.workshop.contours import contours
from camkit.files.workshop.drawing import drawing
from camkit.files.workshop.figure import figure
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.svg import FONT, fitted, text_width
from camkit.files.workshop.svg_path import read_path, read_paths
from camkit.files.workshop.view import View
from camkit.quantities import words
from camkit.study import Study, Tolerances, general_tolerances

SVG = "{http://www.w3.org/2000/svg}"
DATED = TitleBlock(date="2026-11-30")
KEYED = Blank(bore=20 * mm, key="DIN 6885-1", hub_diameter=36 * mm, hub_length=12 * mm, thickness=16 * mm)
PLATE = TranslatingRollerCam(groove=False)
HOSTILE = TitleBlock(
    title="</text><script>alert('1')</script> & \"凸轮\"",
    number="=1+1",
    author="Мария\nКюри\x00\u202e",
    material="<b>]]>",
)


def made(cam, **options):
    """The root of a drawing as SVG, and what was said of it."""
    found = drawing(cam, ".svg", **{"title": DATED, **options})
    return ElementTree.fromstring(found.data.decode()), found


def sheets(root):
    return root.findall(f"{SVG}svg")


def texts(element):
    return ["".join(text.itertext()) for text in element.iter(f"{SVG}text")]


def points(element, name):
    """The corners of all paths of a class, mm on the paper, ``(2, n)``."""
    paths = [path for path in element.iter(f"{SVG}path") if path.get("class") == name]
    return np.hstack([read_path(path.get("d"))[0] for path in paths])


def boxes(sheet):
    """About where each text stands, by its attributes alone: left, top, right, bottom, and what it says."""
    for text in sheet.iter(f"{SVG}text"):
        if text.get("class") == "FAULTY":
            continue
        x, y, size = (float(text.get(name)) for name in ("x", "y", "font-size"))
        wide = text_width("".join(text.itertext()), size)
        left = x - {"start": 0, "middle": wide / 2, "end": wide}[text.get("text-anchor")]
        if "rotate(-90" in text.get("transform", ""):
            yield x - 0.7 * size, y - wide / 2, x + 0.2 * size, y + wide / 2, text.text
        else:
            yield left, y - 0.7 * size, left + wide, y + 0.2 * size, text.text


def crowded(found):
    """Pairs of texts of which one stands on the other."""
    left, top, right, bottom = np.array([box[:4] for box in found]).T
    over = (left < right[:, None]) & (left[:, None] < right) & (top < bottom[:, None]) & (top[:, None] < bottom)
    return [(found[i], found[j]) for i, j in np.argwhere(np.triu(over, 1))]


def tidy(root):
    """Whether on every sheet all texts are within the border and none is on top of another."""
    for sheet in sheets(root):
        wide, high = float(sheet.get("width")), float(sheet.get("height"))
        found = list(boxes(sheet))
        outside = [
            box for box in found if not (box[0] > 20 and box[1] > 10 and box[2] < wide - 10 and box[3] < high - 10)
        ]
        assert not outside
        assert not crowded(found)


def with_profile():
    return {name: cam for name, cam in MACHINES.items() if name not in ("cabin door", "shaft")}


SMALL = ("roller", "roller on a drum", "pair of cams")


@pytest.mark.parametrize(("name", "sheet"), [*((n, "A3") for n in with_profile()), *((n, "A4") for n in SMALL)])
def test_every_cam_has_a_drawing_that_is_exact_and_tidy(name, sheet):
    root, found = made(MACHINES[name], sheet=sheet, blank=Blank(bore=16 * mm, key="DIN 6885-1", key_angle=30 * deg))
    assert 0 < found.deviation < 0.8 * um
    assert len(sheets(root)) == (2 if "pair" in name else 1) * (2 if sheet == "A4" else 1)
    tidy(root)
    size = {"A3": ("420mm", 297), "A4": ("210mm", 297)}[sheet]
    assert root.get("width") == size[0]
    assert root.get("height") == f"{size[1] * len(sheets(root))}mm"


@pytest.mark.parametrize(("sheet", "scale"), [("A3", 1), ("A4", 0.5), ("A3", 0.5), ("A3", 0.2)])
def test_the_profile_is_to_scale(sheet, scale):
    root, found = made(PLATE, sheet=sheet, scale=scale)
    profile = TranslatingRollerAnalysis(PLATE, np.linspace(0, 2 * np.pi, 36001)).profile / mm
    drawn = points(root, "CAM")
    path = next(path for path in root.iter(f"{SVG}path") if path.get("class") == "CAM")
    corners, bulges, closed = read_path(path.get("d"))
    along = ArcPath("CAM", corners * [[1], [-1]], bulges, closed).points(200)
    assert np.ptp(along, axis=1) == pytest.approx(scale * np.ptp(profile, axis=1), abs=1e-3)
    radius = np.hypot(*(drawn - centre_of(root)[:, None])) / scale
    expected = np.interp(angles(drawn, centre_of(root)), *by_angle(profile))
    assert radius == pytest.approx(expected, abs=1e-3)
    assert f"scale {'1:1' if scale == 1 else f'1:{round(1 / scale)}'}" in found.what


def centre_of(root):
    """Where the axis is, from the circle of the bore: it is drawn as two arcs between its right and left ends."""
    for path in root.iter(f"{SVG}path"):
        numbers = re.fullmatch(r"M(\S+) (\S+)A(\S+) \S+ 0 0 0 (\S+) \S+A.*", path.get("d"))
        if numbers and path.get("stroke-width") == "0.5" and path.get("class") is None:
            right, y, _, left = map(float, numbers.groups())
            return np.array([(right + left) / 2, y])
    raise AssertionError("no bore")


def angles(drawn, centre):
    x, y = drawn - centre[:, None]
    return np.arctan2(-y, x)


def by_angle(profile):
    angle = np.arctan2(profile[1], profile[0])
    order = np.argsort(angle)
    return angle[order], np.hypot(*profile)[order]


def test_the_scale_bar_is_as_long_as_it_says():
    for cam, options in ((PLATE, {}), (PLATE, {"scale": 0.2}), (BarrelCam(), {"unit": "in"})):
        root, found = made(cam, **options)
        bar = np.ptp(points(root, "SCALE")[0])
        said = texts(root)
        length = float(said[next(i for i, text in enumerate(said) if text.endswith("on the cam")) - 1])
        above, below = re.search(r"scale (\d+):(\d+)", found.what).groups()
        worth = 25.4 if options.get("unit") == "in" else 1.0
        assert bar == pytest.approx(length * worth * int(above) / int(below))


def test_dimensions_say_what_the_design_has_and_how_well_it_is_kept():
    half = {"base_radius": 0.02 * mm, "roller_radius": 0.005 * mm}
    root, _ = made(PLATE, blank=KEYED, tolerances=half)
    said = texts(root)
    for text in ("R30 ±0.02", "R8 ±0.005", "R50", "Ø20 H7", "6 JS9", "22.8 +0.1 / 0", "Ø36", "12", "16", "0.04", "B"):
        assert text in said
    together = " ".join(said)
    assert "Limits of Ø20 H7: +0.021 / 0; 6 JS9: ±0.015." in together
    assert "base radius 30 ±0.02; roller radius 8 ±0.005; offset 0." in together
    assert "±" not in "".join(texts(made(PLATE)[0])).replace("JS9: ±0.015", "")


def test_tolerances_of_a_study_are_taken_too():
    study = Study(PLATE, ["base_radius"], (max_pressure_angle,))
    root, _ = made(PLATE, tolerances=Tolerances(study, {"base_radius": 0.1 * mm}))
    assert {"R30 ±0.1", "0.2"} <= {*texts(root)}


def test_the_zone_of_the_profile_can_be_asked_for():
    root, _ = made(TranslatingFlatCam(), profile_tolerance=0.05 * mm, blank=Blank(bore=0))
    assert "0.05" in texts(root)
    assert "B" not in texts(root)


def test_inches_have_four_decimals_and_the_third_angle():
    cam = TranslatingRollerCam(groove=False, base_radius=1.25 * inch)
    root, _ = made(
        cam, unit="in", blank=Blank(bore=0.75 * inch, key="ANSI B17.1"), tolerances={"base_radius": 0.001 * inch}
    )
    said = texts(root)
    assert {"R1.2500 ±0.0010", "Ø0.7500 H7", "0.1875", "inch"} <= {*said}
    assert float(radii(root)[90]) == 1.25


def radii(root):
    """The radius that stands nearest to the right of each angle of the table, as it is printed."""
    cells = [box for box in boxes(root) if re.fullmatch(r"\d+(\.\d{3,4})?", box[4])]
    rows = {}
    for _, y, right, _, angle in cells:
        beside = [(box[0], box[4]) for box in cells if box[1] == y and box[0] > right and "." in box[4]]
        if angle.isdigit() and beside:
            rows[int(angle)] = min(beside)[1]
    return rows


def test_the_table_has_the_radius_of_every_whole_degree():
    root, _ = made(PLATE)
    rows = {int(a): float(r) for a, r in radii(root).items()}
    profile = TranslatingRollerAnalysis(PLATE, np.linspace(0, 2 * np.pi, 72001)).profile / mm
    assert sorted(rows) == list(range(360))
    away = [r - np.interp((a * deg + np.pi) % (2 * np.pi) - np.pi, *by_angle(profile)) for a, r in rows.items()]
    assert np.abs(away).max() < 6e-4


def test_titles_are_text_whatever_they_hold():
    root, found = made(PLATE, title=HOSTILE)
    assert "script" not in {element.tag.removeprefix(SVG) for element in root.iter()}
    assert b"<script" not in found.data
    said = "".join(texts(root)).replace(" ", "")
    for text in ("</text><script>alert('1')</script>&\"凸轮\"", "=1+1", "МарияКюри", "<b>]]>"):
        assert text in said
    assert "\x00" not in found.data.decode()
    tidy(root)


def test_a_very_long_title_stays_in_its_cell():
    title = TitleBlock(title="Hebel " * 80, number="№" * 90, author="王" * 200, material="W" * 300, date="2" * 60)
    root, _ = made(PLATE, title=title, blank=KEYED)
    tidy(root)
    assert any(text.endswith("…") for text in texts(root))


def test_a_faulty_cam_is_marked_on_every_sheet():
    fault = "relief groove undercut at 20.6 to 26.1 deg"
    root, _ = made(DoorHandleCam(), sheet="A4", title=TitleBlock(faults=(fault,)))
    for sheet in sheets(root):
        assert [text for text in sheet.iter(f"{SVG}text") if text.get("class") == "FAULTY"]
        assert f"FAULTY: {fault}" in " ".join(texts(sheet))
    assert len(points(root, "FAULT"))
    tidy(root)


def test_both_cams_of_a_pair_stand_on_their_own_sheet_as_they_stand_on_the_shaft():
    root, found = made(ConjugatePair(), title=TitleBlock(title="Pair"))
    first, second = sheets(root)
    assert "Pair, first cam" in texts(first)
    assert "Pair, second cam" in texts(second)
    assert "2 sheets A3" in found.what


def test_what_is_read_back_is_compared_with_the_exact_cam():
    (cam,) = subjects(PLATE)
    _, found = made(PLATE)
    text = found.data.decode()
    (path,) = read_paths(text, ("CAM",))
    exact = next(curve for curve in contours(cam, 100) if curve.layer == "CAM").points
    view = View(None, tuple(centre_of(ElementTree.fromstring(text))), 1.0)
    assert distances(view.back(path), exact).max() < 0.8 * um
    off = view.back(path._replace(corners=path.corners + np.array([[0.01], [0.0]])))
    assert distances(off, exact).max() == pytest.approx(10 * um, abs=1 * um)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"sheet": "A5"}, "the sheet is 'A5'; there are A4, A3"),
        ({"unit": "ft"}, "'mm', 'in'"),
        ({"scale": 5}, "the largest standard one that has room is 1:1"),
        ({"scale": np.nan}, "the scale is nan"),
        ({"scale": -1}, "the scale is -1"),
        ({"profile_tolerance": -1e-5}, "the profile tolerance is -1e-05"),
        ({"tolerances": {"base_radius": -1e-5}}, "the tolerance of the base radius is -1e-05"),
        ({"tolerances": {"lift_arm": 1e-5}}, "lift_arm"),
    ],
)
def test_what_cannot_be_drawn_is_said(options, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        made(PLATE, **options)


def test_what_has_no_profile_and_other_endings_are_refused(tmp_path):
    with pytest.raises(ValueError, match="has no cam profile"):
        made(UniversalJointShaft())
    with pytest.raises(ValueError, match=r"a drawing ends in \.svg or \.pdf, not in '\.png'"):
        write_drawing(PLATE, tmp_path / "cam.png")
    assert not list(tmp_path.iterdir())


def test_a_drawing_is_written_and_the_same_again(tmp_path):
    first = write_drawing(PLATE, tmp_path / "cam.SVG", title=DATED)
    again = write_drawing(PLATE.analyse(), tmp_path / "again.svg", title=DATED)
    assert first.path.read_bytes() == again.path.read_bytes()
    assert re.fullmatch(r"cam\.SVG: 1 sheet A3, scale 1:1; read back, at most 0\.\d+ um off", str(first))


@pytest.mark.parametrize("name", with_profile())
def test_a_figure_keeps_within_its_size(name):
    root = ElementTree.fromstring(figure(MACHINES[name], 160, 90))
    assert root.get("width") == "160mm"
    high = float(root.get("height").removesuffix("mm"))
    assert high <= 90
    layer = next(c for c in ("CAM", "GROOVE") if any(p.get("class") == c for p in root.iter(f"{SVG}path")))
    drawn = points(root, layer)
    assert (drawn.min(1) > 0).all()
    assert (drawn.max(1) < (160, high)).all()


def test_texts_are_broken_at_blanks_and_within_what_is_too_wide():
    assert fitted("王" * 30, 40, 5, 2.5, lines=2)[0] == ["王" * 15, "王" * 15]
    lines, size = fitted("one two three", 12, 5, 2.5, lines=3)
    assert lines == ["one", "two", "three"]
    assert size == 5
    assert all(text_width(line, 2.5) <= 12 for line in fitted("m" * 40, 12, 5, 2.5)[0])


def test_widths_of_letters_are_those_of_the_font():
    """Against Liberation Sans, which has the metrics of Arial; DejaVu, which matplotlib brings, is wider."""
    from matplotlib.font_manager import FontProperties, findfont
    from matplotlib.textpath import TextPath

    prop = FontProperties(family=FONT.split(", ")[0])
    if "Liberation" not in findfont(prop):
        pytest.skip("Liberation Sans is not installed")
    for text in ("R1.2500 ±0.0010", "largest radius", "Sizes of the mechanism: lift arm 50", "DIN 6885-1"):
        wide = TextPath((0, 0), text, size=100, prop=prop).get_extents().width
        assert text_width(text, 100) == pytest.approx(wide, rel=0.06)


def test_general_tolerances_name_the_sizes_that_are_listed():
    root, _ = made(ValveCam())
    together = " ".join(texts(root))
    for path in general_tolerances(ValveCam()):
        assert words(path) in together


@pytest.mark.parametrize("rotation", [1, -1])
def test_an_unrolled_drum_is_seen_from_outside_whichever_way_it_turns(rotation):
    drum = BarrelCam(rotation=rotation)
    root, found = made(drum, blank=Blank())
    tidy(root)
    assert found.deviation < 0.8 * um
    said = texts(root)
    assert "376.991 around the mean radius R60" in said
    assert f"{'counter-' * (rotation > 0)}clockwise as seen from below" in " ".join(said)
    (subject,) = subjects(drum)
    x, y, z = subject.analysis.in_space(drum.mean_radius)
    around, along = subject.analysis.pitch
    azimuth = np.unwrap(np.arctan2(y, x))
    assert azimuth * drum.mean_radius == pytest.approx(around, abs=1e-9)  # x goes with the azimuth, z is upwards
    assert z == pytest.approx(along, abs=1e-12)
    # the roller stands still and goes around the drum with the azimuth: about z the drum turns the other way
    assert np.sign(azimuth[-1]) == rotation
