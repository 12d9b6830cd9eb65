"""Outlines from files: every dialect of points, drawings of every entity, and what cannot be read refused."""

import io

import ezdxf
import numpy as np
import openpyxl
import pytest
from numpy.testing import assert_allclose

from camkit import (
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    motion_from_outline,
)
from camkit.cam import DrawnOutline, MeasuredOutline, cam_from_outline
from camkit.files import TableQuestion, read_outline
from camkit.files.workshop import tables
from camkit.files.workshop.arcs import dense_path, distances
from camkit.files.workshop.contours import contours
from camkit.files.workshop.dxf import dxf
from camkit.files.workshop.subject import subjects
from camkit.units import deg, inch, mm, um

TURN = np.arange(0, 360, 2) * deg
R = 40 + 5 * np.cos(TURN) + 2 * np.sin(2 * TURN)
X, Y = R * np.cos(TURN), R * np.sin(TURN)


def table(head, *columns, sep=";", point="."):
    rows = [sep.join(f"{value:.4f}".replace(".", point) for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([head, *rows] if head else rows).encode()


def workbook():
    book = openpyxl.Workbook()
    book.active.append(["x [mm]", "y [mm]"])
    for row in zip(X, Y, strict=True):
        book.active.append([round(float(value), 4) for value in row])
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()


TABLES = {
    "points": (table("x [mm];y [mm]", X, Y), "semicolons and decimal points, x and y in mm"),
    "european": (table("X;Y", X, Y, point=","), "semicolons and decimal commas, x and y in mm as no unit is named"),
    "no heading": (table("", X, Y, sep=" "), "blanks and decimal points, x and y in mm as no unit is named"),
    "inches": (
        table("x (in),y (in)", X / 25.4 * 10, Y / 25.4 * 10, sep=","),
        "commas and decimal points, x and y in in",
    ),
    "measuring machine": (table("", X, Y, 0 * X + 12.5, sep="\t"), "tabs and decimal points"),
    "counted": (table("", 1 + np.arange(len(X)), X, Y, sep="\t"), "tabs and decimal points"),
    "swapped": (table("y [mm];x [mm]", Y, X), "x and y in mm"),
    "polar": (table("theta [deg];r [mm]", TURN / deg, R), "radii in mm, angles in deg"),
    "polar, radians": (table("radius [mm];angle [rad]", R, TURN), "radii in mm, angles in rad"),
    "polar, no heading": (table("", TURN / deg, R, sep=" "), "radii in mm as no unit is named, angles in deg"),
    "polar, begun elsewhere": (
        table("", np.roll(TURN / deg, 70), np.roll(R, 70), sep=" "),
        "radii in mm as no unit is named",
    ),
    "polar, backwards": (table("r;theta", R[::-1], TURN[::-1] / deg), "radii in mm"),
    "workbook": (workbook(), "the sheet Sheet, x and y in mm"),
}


@pytest.mark.parametrize("name", list(TABLES))
def test_points_in_any_dialect(name):
    data, said = TABLES[name]
    outline = read_outline(data)
    assert isinstance(outline, MeasuredOutline)
    assert said in outline.remarks[1]
    size = 10 if name == "inches" else 1
    x, y = outline.points / mm / size
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    assert_allclose(r, 40 + 5 * np.cos(theta) + 2 * np.sin(2 * theta), atol=2e-3)
    assert outline.digit == pytest.approx(1e-4 * (inch if name == "inches" else mm))


def test_the_axis_may_lie_elsewhere_and_units_may_be_said():
    outline = read_outline(table("", X / 10 + 7, Y / 10 - 3, sep=" "), unit="cm", axis=(7, -3))
    assert_allclose(outline.points / mm, [X, Y], atol=2e-3)
    with pytest.raises(ValueError, match="the outline lies beside the cam axis"):
        read_outline(table("", X + 70, Y, sep=" "))


def test_what_a_table_leaves_open_is_asked():
    data = table("", X, Y, R, X + Y, sep=" ")
    with pytest.raises(TableQuestion, match=r"4 columns .* which are x and y; say columns=\(1, 2\)") as asked:
        read_outline(data)
    assert asked.value.argument == "columns"
    assert_allclose(read_outline(data, columns=(1, 2)).points / mm, [X, Y], atol=1e-3)
    both = read_outline(table("", R, TURN / deg, sep=" "), columns=(1, 2))
    assert_allclose(both.points / mm, [X, Y], atol=1e-3)


FOLLOWERS = {
    "roller": TranslatingRollerCam(groove=False, offset=5 * mm),
    "groove": TranslatingRollerCam(),
    "knife edge": TranslatingRollerCam(groove=False, roller_radius=0.0),
    "face": TranslatingFlatCam(),
    "arm": OscillatingRollerCam(groove=False),
    "arm with a face": OscillatingFlatCam(),
}


@pytest.mark.parametrize("rotation", [1, -1])
@pytest.mark.parametrize("kind", list(FOLLOWERS))
def test_the_workshop_s_table_comes_back_as_the_design(kind, rotation):
    design = FOLLOWERS[kind].replace(rotation=rotation)
    outline = read_outline(tables.table(design.analyse(721)).data)
    assert isinstance(outline, MeasuredOutline)
    cam = cam_from_outline(outline, design)
    x = np.linspace(0, 2 * np.pi, 721)
    size = 1.0 if cam.motion.unit == "mm" else 60 * mm
    assert_allclose(cam.motion(x).s * size, design.motion(x).s * size, rtol=0, atol=1 * um)
    assert_allclose(cam.motion(x).v * size, design.motion(x).v * size, rtol=0, atol=40 * um)


@pytest.mark.parametrize("unit", ["mm", "in"])
@pytest.mark.parametrize("kind", list(FOLLOWERS))
def test_the_workshop_s_drawing_comes_back_within_its_tolerance(kind, unit):
    """By its arcs, which lie on the cam to 1 um: so does the follower, over the cosine of its pressure angle."""
    design = FOLLOWERS[kind].replace(rotation=-1)
    outline = read_outline(dxf(design, 1 * um, unit=unit).data)
    assert isinstance(outline, DrawnOutline)
    exact = [line for line in contours(subjects(design)[0]) if line.layer != "PITCH"]
    assert np.min([distances(dense_path(line), outline.points) for line in exact], axis=0).max() < 1 * um
    cam = cam_from_outline(outline, design)
    x = np.linspace(0, 2 * np.pi, 721)
    size = 1.0 if cam.motion.unit == "mm" else 60 * mm
    assert_allclose(cam.motion(x).s * size, design.motion(x).s * size, rtol=0, atol=1.3 * um)


@pytest.mark.parametrize("entity", ["spline", "chords"])
def test_a_drawing_by_splines_or_chords_comes_back_by_points(entity):
    design = TranslatingFlatCam()
    outline = read_outline(dxf(design, 0.2 * um, entity).data)
    assert isinstance(outline, MeasuredOutline)
    x = np.linspace(0, 2 * np.pi, 721)
    assert_allclose(cam_from_outline(outline, design).motion(x).s, design.motion(x).s, rtol=0, atol=0.5 * um)


def drawn(draw, units=4):
    drawing = ezdxf.new("R2010", units=units)
    draw(drawing.modelspace())
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue().encode()


def tangent(space, gap=0.0, layer="0", scale=1.0):
    """A tangent cam, r 25, nose 8 at 40, as four entities in no order and of no one direction."""
    leans = np.degrees(np.arccos((25 - 8) / 40))
    n, attributes = np.array([np.sin(np.radians(leans)), np.cos(np.radians(leans))]), {"layer": layer}
    right, top = scale * 25 * n, scale * (np.array([0, 40]) + 8 * n)
    space.add_line(right + np.array([0, gap]), top, attributes)
    space.add_arc((0, 0), scale * 25, 90 + leans, 90 - leans, dxfattribs=attributes)
    space.add_line(top * [-1, 1], right * [-1, 1], attributes)
    space.add_arc((0, 40 * scale), scale * 8, 90 - leans, 90 + leans, dxfattribs=attributes)


@pytest.mark.parametrize(("units", "scale", "said"), [(4, 1, "mm by"), (1, 1 / 25.4, "in by"), (0, 1, "mm as its")])
def test_lines_and_arcs_of_a_drawing_stay_exact(units, scale, said):
    outline = read_outline(drawn(lambda space: tangent(space, scale=scale), units))
    assert isinstance(outline, DrawnOutline)
    assert outline.remarks[0].startswith("an outline of 2 arcs and 2 lines, 25 to 48 mm")
    assert f"coordinates in {said}" in outline.remarks[1]
    motion = motion_from_outline(outline, TranslatingRollerCam(roller_radius=12 * mm))
    expected = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm)
    x = np.linspace(0, 2 * np.pi, 361)
    same = motion_from_outline(expected, TranslatingRollerCam(roller_radius=12 * mm))
    assert_allclose(motion(x).a, same(x).a, rtol=0, atol=1e-8)
    assert motion.jumps == ()


def test_a_polyline_with_bulges_and_a_circle_stay_exact():
    eccentric = DrawnOutline.circle(40 * mm, 0, -15 * mm)
    cam, x = TranslatingRollerCam(roller_radius=10 * mm), np.linspace(0, 2 * np.pi, 181)
    expected = motion_from_outline(eccentric, cam)
    for draw in (
        lambda space: space.add_circle((0, -15), 40),
        lambda space: space.add_lwpolyline([(40, -15, 1), (-40, -15, 1)], format="xyb", close=True),
        lambda space: space.add_polyline2d([(40, -15, 1), (-40, -15, 1)], format="xyb", close=True),
        lambda space: space.add_circle((0, -15), 40, dxfattribs={"extrusion": (0, 0, -1)}),
        lambda space: space.add_lwpolyline(
            [(-40, -15, -1), (40, -15, -1)], format="xyb", close=True, dxfattribs={"extrusion": (0, 0, -1)}
        ),
    ):
        outline = read_outline(drawn(draw))
        assert isinstance(outline, DrawnOutline)
        assert_allclose(motion_from_outline(outline, cam)(x).s, expected(x).s, rtol=0, atol=1e-12)


def test_splines_and_ellipses_are_taken_by_points():
    cam, x = TranslatingRollerCam(roller_radius=10 * mm), np.linspace(0, 2 * np.pi, 181)
    close = np.array([[40 * np.cos(t), 40 * np.sin(t) - 15, 0] for t in np.linspace(0, 2 * np.pi, 361)])
    expected = motion_from_outline(DrawnOutline.circle(40 * mm, 0, -15 * mm), cam)
    for draw in (
        lambda space: space.add_spline(close),
        lambda space: space.add_ellipse((0, -15), (40, 0), 1.0),
    ):
        outline = read_outline(drawn(draw))
        assert isinstance(outline, MeasuredOutline)
        assert "its curve taken by points on it" in outline.remarks[-2]
        assert_allclose(motion_from_outline(outline, cam)(x).s, expected(x).s, rtol=0, atol=5e-6)


def test_of_several_loops_one_is_asked_for():
    def draw(space):
        space.add_circle((0, 0), 6, dxfattribs={"layer": "bore"})
        space.add_circle((20, 0), 3, dxfattribs={"layer": "holes"})
        tangent(space, layer="plate")

    data = drawn(draw)
    with pytest.raises(TableQuestion, match="2 closed loops of the drawing go around the cam axis") as asked:
        read_outline(data)
    assert asked.value.argument == "loop"
    assert list(asked.value.options) == [
        "loop 1 (layer 'bore', 6 to 6 mm from the axis)",
        "loop 2 (layer 'plate', 25 to 48 mm from the axis)",
    ]
    assert read_outline(data, loop=2).remarks[0].startswith("an outline of 2 arcs and 2 lines")
    with pytest.raises(ValueError, match="loop is 3; it must be a number from 1 to 2"):
        read_outline(data, loop=3)


def test_gaps_are_named_or_closed():
    with pytest.raises(ValueError, match=r"no outline of the drawing is closed: at x .* mm one is open by 0.5 mm"):
        read_outline(drawn(lambda space: tangent(space, 0.5)))
    outline = read_outline(drawn(lambda space: tangent(space, 0.005)))
    assert any("a gap of 0.005 mm was closed" in told for told in outline.remarks)
    assert_allclose(outline.points.max(), 48 * mm, atol=1e-6)


def test_the_axis_of_a_drawing_may_lie_elsewhere():
    data = drawn(lambda space: space.add_circle((100, 35), 40))
    with pytest.raises(ValueError, match=r"the outline lies beside the cam axis, the origin.*; say axis="):
        read_outline(data)
    assert read_outline(data, axis=(100, 50)).remarks[0] == "an outline of 1 arc, 25 to 55 mm from the cam axis"


def test_a_drawing_in_another_unit_says_how_far_it_would_reach():
    data = drawn(lambda space: (space.doc.header.__setitem__("$INSUNITS", 6), space.add_circle((5, 0), 40)))
    with pytest.raises(ValueError, match=r"the outline reaches 4.* m from the cam axis"):
        read_outline(data)
    assert read_outline(data, unit="mm").remarks[0] == "an outline of 1 arc, 35 to 45 mm from the cam axis"


def blocks(space):
    block = space.doc.blocks.new("cam")
    block.add_circle((0, 0), 5)
    space.add_blockref("cam", (0, 0))


REFUSED = {
    "nothing": (b"", "the file is empty"),
    "a picture": (b"\x89PNG\r\n\x1a\n", "the file is a PNG picture, no table of an outline"),
    "words": (b"hello world\nhow are you\n", "no rows of two numbers or more; a table of an outline has x and y"),
    "few points": (b"1;2\n3;4\n5;6\n", "the points of the outline are 2 x 3; they must be 12 to"),
    "huge": (table("", X, Y, sep=" ").replace(b"40.", b"1e300"), "line 136 of the table is no row of 2 numbers"),
    "infinite": (b"1e400 1\n" * 20, "line 1 of the table holds a number that no cam can have"),
    "broken drawing": (b"0\nSECTION\n2\nENTITIES\n0\nLINE\n", "the drawing"),
    "binary drawing": (b"AutoCAD Binary DXF\r\n\x1a\x00" + b"\xff" * 50, "the drawing cannot be read"),
    "empty drawing": (drawn(lambda space: None), "the drawing has no lines, arcs, circles"),
    "blocks alone": (drawn(blocks), "it has INSERT, which are not read: blocks must be exploded"),
    "not a number": (drawn(lambda s: s.add_circle((0, 0), 40)).replace(b"40.0", b"nan"), "the drawing|the outline"),
    "too large": (drawn(lambda s: s.add_circle((0, 0), 4e7)), "the drawing|the outline"),
}


@pytest.mark.parametrize("name", list(REFUSED))
def test_what_is_no_outline_is_refused_in_a_sentence(name):
    data, why = REFUSED[name]
    with pytest.raises(ValueError, match=why) as refusal:
        read_outline(data)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("at", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_a_drawing_cut_off_anywhere_is_read_or_refused_in_a_sentence(at):
    data = drawn(tangent)
    said = ""
    try:
        said = str(read_outline(data[: int(at * len(data))]).remarks)
    except ValueError as refusal:
        said = str(refusal)
    assert said
    assert "\n" not in said


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ({"unit": "ell"}, "unit is 'ell'; it must be one of 'mm'"),
        ({"axis": (1, 2, 3)}, "it must be x and y of the cam axis"),
        ({"axis": (1, np.inf)}, "a coordinate of the axis is inf"),
        ({"columns": (1, 1)}, "columns is .*; it must be two numbers from 1 to 2"),
        ({"polar": True}, "no column of the table goes once around"),
        ({"delimiter": "x"}, "delimiter is 'x'"),
        ({"loop": "two"}, "the argument loop is 'two'"),
    ],
)
def test_answers_that_cannot_be_are_refused(arguments, why):
    with pytest.raises(ValueError, match=why):
        read_outline(table("", X, Y, sep=" "), **arguments)
