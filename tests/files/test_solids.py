"""Solids without Open CASCADE and manifold: sizes, what is refused, and what is asked for where they are missing."""

import sys

import numpy as np
import pytest

from camkit import (
    MotionProgram,
    Return,
    Rise,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    deg,
    mm,
)
from camkit.cam import BarrelCam
from camkit.files import Blank, write_3mf, write_step, write_stl
from camkit.files.workshop.arcs import ArcPath
from camkit.files.workshop.mesh import Mesh, chords, off
from camkit.files.workshop.plan import bore_path, circle
from camkit.files.workshop.printing import STL, read_stl
from camkit.files.workshop.prisms import area, parts
from camkit.files.workshop.step_file import quoted
from camkit.motion import SimpleHarmonic

TETRAHEDRON = Mesh(
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
)


def plate():
    law = SimpleHarmonic()
    return TranslatingFlatCam(
        motion=MotionProgram((Rise(180 * deg, 20 * mm, law), Return(180 * deg, 20 * mm, law))), base_radius=25 * mm
    )


@pytest.mark.parametrize(("write", "ending"), [(write_step, "step"), (write_stl, "stl"), (write_3mf, "3mf")])
def test_a_missing_library_is_asked_for_in_a_sentence(monkeypatch, tmp_path, write, ending):
    for name in ("OCP", "manifold3d"):
        monkeypatch.setitem(sys.modules, name, None)
    extra = r"OCP, .*camkit\[step\]' \(about 380 MB\)" if write is write_step else r"manifold3d, .*camkit\[print\]'$"
    with pytest.raises(ModuleNotFoundError, match=extra):
        write(plate(), tmp_path / f"cam.{ending}")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("cam", "sizes", "said"),
    [
        (BarrelCam(), {}, "BarrelCam is a drum, whose flanks are no prisms"),
        (UniversalJointShaft(), {}, "has no cam profile"),
        (plate(), {"bore": 60 * mm}, "reaches 30 mm from the axis; the nearest flank of the cam is at 25 mm"),
        (
            TranslatingRollerCam(),
            {"groove_depth": 10 * mm},
            "the groove depth is 10 mm; it must be below the thickness",
        ),
        (TranslatingRollerCam(), {"outer_diameter": 50 * mm}, "the outer diameter is 50 mm; the groove takes"),
    ],
)
def test_what_has_no_room_is_refused(cam, sizes, said):
    with pytest.raises(ValueError, match=said):
        parts(cam, Blank(**sizes), 1e-6)


def test_an_eccentric_circle_is_as_large_as_its_arcs():
    (part,) = parts(plate(), Blank(bore=20 * mm, hub_diameter=36 * mm, hub_length=15 * mm), 1e-8)
    disk, hub = part.added
    assert disk.volume == pytest.approx(np.pi * (35**2 - 10**2) * 10 * mm**3, rel=1e-6)
    assert hub.volume == pytest.approx(np.pi * (18**2 - 10**2) * 15 * mm**3)
    assert (hub.low, hub.high, disk.low, disk.high) == pytest.approx((-15 * mm, 0, 0, 10 * mm))
    assert part.volume == pytest.approx(disk.volume + hub.volume)


def test_a_grooved_disk_has_a_wall_as_thick_as_the_groove_is_deep():
    (part,) = parts(TranslatingRollerCam(), Blank(groove_depth=7 * mm), 1e-6)
    (disk,), (pocket,) = part.added, part.cut
    outer = np.hypot(*pocket.outline.points(50)).max()
    assert disk.outline.corners[0, 0] == pytest.approx(outer + 7 * mm, abs=1e-6)
    assert (pocket.low, pocket.high) == pytest.approx((3 * mm, 10 * mm))
    assert part.volume == pytest.approx(disk.volume - pocket.volume)


def test_the_area_of_a_bore_with_its_keyway_and_of_nearly_straight_arcs():
    blank = Blank(bore=20 * mm, key="DIN 6885-1", key_angle=30 * deg)
    x = np.linspace(-3, 3, 200001)
    slot = np.trapezoid(12.8 - np.sqrt(10**2 - x**2), x)
    assert area(bore_path(blank)) == pytest.approx((np.pi * 10**2 + slot) * mm**2, rel=1e-9)
    for turns in (2e-3, 0.9e-3, 1e-6):  # a lens of two arcs whose chord is 2
        lens = ArcPath("", np.array([[1.0, -1.0], [0.0, 0.0]]), np.full(2, np.tan(turns / 4)), True)
        assert area(lens) == pytest.approx(2 * turns / 3, rel=1e-6)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_chords_of_a_circle_keep_the_tolerance_and_are_few(tolerance):
    points = chords(circle(0.1), tolerance)
    middles = (points + np.roll(points, -1, axis=1)) / 2
    assert np.hypot(*points) == pytest.approx(0.1)
    assert (0.1 - np.hypot(*middles)).max() <= tolerance * (1 + 1e-9)
    assert points.shape[1] <= 2 * np.pi / (2 * np.arccos(1 - tolerance / 0.1)) + 2


def test_corners_of_lines_stay():
    square = ArcPath("", np.array([[0.0, 1, 1, 0], [0, 0, 1, 1]]), np.zeros(4), True)
    assert np.array_equal(chords(square, 1e-6), square.corners)


def test_a_mesh_knows_whether_it_is_closed_and_how_large_it_is():
    assert TETRAHEDRON.watertight
    assert TETRAHEDRON.volume == pytest.approx(1 / 6)
    assert TETRAHEDRON.area == pytest.approx(1.5 + np.sqrt(3) / 2)
    assert not Mesh(TETRAHEDRON.points, TETRAHEDRON.triangles[1:]).watertight
    turned = TETRAHEDRON.triangles.copy()
    turned[0] = turned[0, ::-1]
    assert not Mesh(TETRAHEDRON.points, turned).watertight


def test_distances_from_a_mesh_are_those_of_many_points_on_it():
    rng = np.random.default_rng(1)
    share = rng.dirichlet(np.ones(3), 40_000)
    on_it = np.concatenate([share @ TETRAHEDRON.points[corners] for corners in TETRAHEDRON.triangles])
    points = rng.uniform(-0.5, 1.2, (60, 3))
    brute = np.linalg.norm(points[:, None] - on_it[None], axis=-1).min(1)
    assert off(TETRAHEDRON, points) == pytest.approx(brute, abs=6e-3)
    assert (off(TETRAHEDRON, points) <= brute + 1e-12).all()


def test_an_stl_is_read_in_mm_and_its_corners_become_one_point():
    out = np.zeros(4, STL)
    out["corners"] = TETRAHEDRON.points[TETRAHEDRON.triangles]
    mesh = read_stl(b" " * 80 + np.uint32(4).tobytes() + out.tobytes())
    assert len(mesh.points) == 4
    assert mesh.watertight
    assert mesh.volume == pytest.approx(mm**3 / 6)


def test_a_text_of_a_step_file_is_ascii():
    assert quoted("凸 'x' \\ é 😀\n") == r"\X2\51F8\X0\ ''x'' \\ \X2\00E9\X0\ \X4\0001F600\X0" "\\"
