"""DXF drawings of cams: read back by ezdxf, audited, drawn, and held against the exact cam by its points."""

import io
from functools import cache

import ezdxf
import numpy as np
import pytest
from ezdxf import recover
from numpy.testing import assert_allclose
from scipy.spatial import cKDTree

from camkit import (
    DoorHandleCam,
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    ValveCam,
    explore,
    write_dxf,
)
from camkit.cam import BarrelCam, ConjugatePair
from camkit.cam.undercut import undercut_in_words
from camkit.files import Blank, TitleBlock
from camkit.files.workshop.contours import contours
from camkit.files.workshop.dxf import dxf
from camkit.files.workshop.subject import subjects
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.units import deg, inch, mm, um

LAW = Cycloidal()
FLAT = TranslatingFlatCam(
    MotionProgram((Rise(60 * deg, 25 * mm, LAW), Dwell(20 * deg), Return(60 * deg, 25 * mm, LAW), Dwell(220 * deg))),
    20 * mm,
)
"""25 mm in 60 deg and back: the face cuts it away."""
CAMS = {
    "groove": TranslatingRollerCam(offset=6 * mm, rotation=-1),
    "plate": TranslatingRollerCam(groove=False),
    "face": TranslatingFlatCam(),
    "arm": OscillatingRollerCam(),
    "face on an arm": OscillatingFlatCam(),
    "high speed": HighSpeedCam(),
    "valve": ValveCam(),
    "door": DoorHandleCam(),
    "drum": BarrelCam(),
    "pair": ConjugatePair(),
    "undercut": FLAT,
    "open plate": TranslatingRollerCam(MotionProgram((Rise(120 * deg, 20 * mm, LAW),)), groove=False),
}
DATED = TitleBlock(date="2026-11-30")


@cache
def made(name, entity="arcs", unit="mm"):
    return dxf(CAMS[name], 1 * um, entity, unit, title=DATED)


def opened(data):
    document, auditor = recover.read(io.BytesIO(data))
    assert not auditor.errors
    assert not auditor.fixes
    again = document.audit()
    assert not again.errors
    assert not again.fixes
    return document


def lines_on(entities, worth=mm):
    """Entities as ezdxf makes lines of them, 0.02 um from their arcs and splines, m."""
    for each in entities:
        if each.dxftype() == "LWPOLYLINE":
            yield from lines_on(each.virtual_entities(), worth)
        elif each.dxftype() == "LINE":
            yield np.array([each.dxf.start.vec2, each.dxf.end.vec2]).T * worth
        else:
            yield np.array([(p.x, p.y) for p in each.flattening(2e-5 * mm / worth)]).T * worth


def points_on(entities, worth=mm):
    return np.hstack(list(lines_on(entities, worth)))


def exact(name):
    return [line for subject in subjects(CAMS[name]) for line in contours(subject, 29)]


@pytest.mark.parametrize(
    ("name", "entity"),
    [("face", "chords"), ("groove", "spline"), ("undercut", "spline"), ("undercut", "arcs"), ("door", "arcs")],
)
def test_a_drawing_lies_on_the_cam(name, entity):
    """By points that ezdxf makes of it, and points of the cam at other angles than those of which it was made."""
    found = made(name, entity)
    assert found.deviation < 1 * um
    space = opened(found.data).modelspace()
    for layer in {line.layer for line in exact(name)} - {"FAULT"}:
        lines = list(lines_on(space.query(f'*[layer=="{layer}"]')))
        cam = [part.finer(20).points for line in exact(name) if line.layer == layer for part in line.stretches]
        assert from_lines(lines, np.hstack(cam)[:, ::7]) < 1.03 * um  # of which 0.02 um are ezdxf's chords
        assert from_lines(cam, np.hstack(lines)) < 1.1 * um  # of which 0.07 um are the chords between its points


def from_lines(lines, points):
    """The largest distance of points from chords that are long beside it, m: of those at the four nearest corners."""
    corners = np.hstack([np.column_stack([[np.nan] * 2, line, [np.nan] * 2]) for line in lines])
    real = np.flatnonzero(np.isfinite(corners[0]))
    near, away = real[cKDTree(corners[:, real].T).query(points.T, k=4)[1]].T, []
    for i, j in ((k + side, k + side + 1) for k in near for side in (-1, 0)):
        start, along = corners[:, i], corners[:, j] - corners[:, i]
        share = np.clip(((points - start) * along).sum(0) / np.maximum((along**2).sum(0), 1e-30), 0, 1)
        away.append(np.hypot(*(points - start - share * along)))
    return np.nanmin(away, axis=0).max()


@pytest.mark.parametrize("name", CAMS)
def test_every_contour_is_one_entity_without_doubled_points(name):
    document = opened(made(name).data)
    space, lines = document.modelspace(), exact(name)
    cut = space.query("LWPOLYLINE").filter(lambda each: each.dxf.layer[:3] in ("CAM", "GRO", "PIT"))
    assert len(cut) == sum(line.layer != "FAULT" for line in lines)
    assert [each.closed for each in cut] == [line.closed for line in lines if line.layer != "FAULT"]
    for each in space.query("LWPOLYLINE"):
        corners = np.array(each.get_points("xy"))
        steps = np.hypot(*np.diff(np.vstack([corners, corners[:1]] if each.closed else corners).T))
        assert steps.min() > 1e-5
        assert max(abs(bulge) for *_, bulge in each.get_points("xyb")) <= 1 + 1e-6
    assert made(name).deviation < 1 * um
    assert f"read back, at most {made(name).deviation / um:.3g} um off" in words(document)


def words(document, layer="*"):
    return "\n".join(each.dxf.text for each in document.modelspace().query("TEXT") if layer in ("*", each.dxf.layer))


@pytest.mark.parametrize(("unit", "number", "metric", "worth"), [("mm", 4, 1, mm), ("in", 1, 0, inch)])
def test_the_header_says_unit_and_extents(unit, number, metric, worth):
    document = opened(made("groove", "arcs", unit).data)
    assert document.dxfversion == "AC1015"
    assert (document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == (number, metric)
    low, high = (np.array(document.header[name])[:2] * worth for name in ("$EXTMIN", "$EXTMAX"))
    space = document.modelspace()
    points = points_on(space.query("LWPOLYLINE LINE CIRCLE"), worth)
    assert (low[:, None] <= points + 1e-9).all()
    assert (high[:, None] >= points - 1e-9).all()
    assert (high - low).max() < 4 * np.ptp(points, axis=1).max()
    assert f"lengths in {'inches' if unit == 'in' else 'mm'}" in words(document, "NOTES")
    cut = points_on(space.query('*[layer=="GROOVE"]'), worth)
    assert np.hypot(*cut).max() == pytest.approx(
        np.hypot(*TranslatingRollerCam(offset=6 * mm).analyse().outer_profile).max(), abs=2 * um
    )


def test_layers_have_colours_lines_and_weights():
    document = opened(dxf(DoorHandleCam(), blank=Blank(bore=20 * mm, key="DIN 6885-1", hub_diameter=40 * mm)).data)
    names = {"GROOVE", "PITCH", "CENTRE", "BORE", "KEYWAY", "HUB", "DATUM", "NOTES", "FAULT"}
    assert names <= {layer.dxf.name for layer in document.layers}
    assert names == {each.dxf.layer for each in document.modelspace()}
    looks = {layer.dxf.name: (layer.dxf.color, layer.dxf.linetype, layer.dxf.lineweight) for layer in document.layers}
    assert len({looks[name] for name in names}) >= 8
    assert looks["PITCH"][1] == looks["CENTRE"][1] == "CENTER"
    assert looks["FAULT"][0] == ezdxf.colors.RED


def test_a_bore_with_its_keyway_closes():
    blank = Blank(bore=20 * mm, key="DIN 6885-1", key_angle=90 * deg)
    space = opened(dxf(CAMS["plate"], blank=blank).data).modelspace()
    (bore,), (keyway,) = space.query('*[layer=="BORE"]'), space.query('*[layer=="KEYWAY"]')
    ends = [np.array(each.get_points("xy")) for each in (bore, keyway)]
    assert_allclose(ends[0][[0, -1]], ends[1][[-1, 0]], rtol=0, atol=1e-12)
    assert ends[1][:, 1].max() == pytest.approx(10 + 2.8)
    assert np.ptp(ends[1][:, 0]) == pytest.approx(6)
    assert_allclose(np.hypot(*points_on([bore])), 10 * mm, rtol=0, atol=0.1 * um)
    (circle,) = opened(made("plate").data).modelspace().query('*[layer=="BORE"]')
    assert_allclose(np.hypot(*points_on([circle])), 6 * mm, rtol=0, atol=0.1 * um)


@pytest.mark.parametrize("name", ["undercut", "door"])
def test_what_undercut_takes_is_on_its_own_layer_with_a_sentence(name):
    found = made(name)
    space = opened(found.data).modelspace()
    lost = [line for line in exact(name) if line.layer == "FAULT"]
    assert len(space.query('LWPOLYLINE[layer=="FAULT"]')) == len(lost) > 0
    sentence = undercut_in_words(CAMS[name].analyse())
    assert f"FAULTY: {sentence}" in words(space.doc, "FAULT").replace("\n", " ")
    assert sentence in found.remarks
    assert not space.query('*[layer=="FAULT"]').filter(lambda each: each.dxf.linetype != "BYLAYER")
    assert "FAULT" not in {each.dxf.layer for each in opened(made("groove").data).modelspace()}


TEXTS = [
    "凸轮轴",
    "Кулачок",
    "<script>alert(1)</script>",
    "=1+1",
    'a "quoted" name',
    "two\n  0\nLINE\n  8\nCAM",
    "%%u50%%d",
    "^J^I",
    "\\U+4E2D",
]


@pytest.mark.parametrize("text", TEXTS)
def test_words_of_users_come_out_as_one_line(text):
    document = opened(dxf(CAMS["face"], title=TitleBlock(title=text, author="张三", date="2026-11-30")).data)
    first = document.modelspace().query('TEXT[layer=="NOTES"]')[0].plain_text()
    assert "".join(first.split()).replace("^", "") == "".join(text.split()).replace("^", "")
    assert "张三" in words(document)
    assert len(document.modelspace().query("LINE")) == 0


def test_faults_that_are_known_are_marked():
    document = opened(dxf(CAMS["face"], title=TitleBlock(faults=("the yield is 12 %",))).data)
    assert "FAULTY: the yield is 12 %" in words(document, "FAULT")


def arrow(document):
    """By how much the arrow of the datum turns, and whether its line points along x."""
    line, curve, _ = document.modelspace().query('LWPOLYLINE[layer=="DATUM"]')
    assert [y for _, y in line.get_points("xy")] == [0, 0]
    return curve.get_points("xyb")[0][2]


def test_the_datum_turns_as_the_cam_does():
    assert arrow(opened(made("plate").data)) > 0 > arrow(opened(made("groove").data))
    assert "the cam turns counter-clockwise" in words(opened(made("plate").data))
    assert "the cam turns clockwise" in words(opened(made("groove").data))


def test_a_pair_is_one_drawing_with_numbered_layers():
    found = made("pair")
    assert found.what == "56 arcs on CAM1, 56 arcs on CAM2"
    layers = {each.dxf.layer for each in opened(found.data).modelspace()}
    assert {"CAM1", "PITCH1", "CAM2", "PITCH2"} <= layers


def test_a_drum_says_from_where_it_is_seen_and_how_it_turns():
    told = " ".join(dxf(BarrelCam(rotation=-1), unit="in").remarks)
    assert "unrolled at the mean radius 2.3622 in, seen from outside" in told
    assert told.endswith("the drum turns clockwise as seen from below, along the rise")


def test_a_drum_is_unrolled():
    document = opened(made("drum").data)
    walls = document.modelspace().query('LWPOLYLINE[layer=="GROOVE"]')
    for wall in walls:
        x = np.array(wall.get_points("xy"))[:, 0]
        assert np.ptp(x) == pytest.approx(120 * np.pi, abs=1e-6)
    assert "unrolled at the mean radius 60 mm" in words(document)
    assert not document.modelspace().query('*[layer=="BORE"]')


def test_an_open_plate_says_so():
    assert made("open plate").remarks == ("the motion covers 120 deg; where it ends the contour is open",)


def test_one_spline_is_one_edge():
    space = opened(made("groove", "spline").data).modelspace()
    found = space.query('SPLINE[layer=="GROOVE"]')
    assert [each.closed for each in found] == [True, True]
    assert made("groove", "spline").what == "2 splines on GROOVE"


def test_the_picture_has_every_layer_s_colour():
    from ezdxf.addons.drawing import Frontend, RenderContext, layout, svg

    document = opened(dxf(FLAT, blank=Blank(bore=10 * mm, key="DIN 6885-1")).data)
    backend = svg.SVGBackend()
    Frontend(RenderContext(document), backend).draw_layout(document.modelspace())
    picture = backend.get_string(layout.Page(200, 200, layout.Units.mm)).lower()
    for colour in ("#ff0000", "#00ff00", "#00ffff", "#ff00ff", "#ff7f00"):
        assert colour in picture


def test_a_file_is_written_the_same_each_time(tmp_path):
    for name in ("one.dxf", "two.dxf"):
        done = write_dxf(CAMS["face"], tmp_path / name, 0.2 * um, title=DATED)
        assert done.deviation < 0.2 * um
        assert str(done).startswith(f"{name}: ")
    assert (tmp_path / "one.dxf").read_bytes() == (tmp_path / "two.dxf").read_bytes()


def test_a_panel_and_an_analysis_give_what_the_design_does():
    panel = explore(CAMS["face"])
    assert dxf(panel, title=DATED).data == dxf(CAMS["face"].analyse(31), title=DATED).data == made("face").data


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ((TranslatingFlatCam().motion,), "given is a MotionProgram; a design or its analysis can be exported"),
        ((TranslatingRollerCam(base_radius=np.array([[0.03], [0.04]])),), "a population; one design can be exported"),
        ((TranslatingFlatCam(), 1 * um, "dots"), "the entity is 'dots'; it must be one of 'arcs', 'spline', 'chords'"),
        ((TranslatingFlatCam(), 0.0), "the tolerance of the drawing is 0.* it must be 0.01 um to 1 mm, in m"),
        ((TranslatingFlatCam(), 1.0), "the tolerance of the drawing is 1"),
        ((TranslatingFlatCam(), 1 * um, "arcs", "furlong"), "the unit is 'furlong'"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_a_sentence(arguments, why):
    with pytest.raises(ValueError, match=why) as refusal:
        dxf(*arguments)
    assert "\n" not in str(refusal.value)
