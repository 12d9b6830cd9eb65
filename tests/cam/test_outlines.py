"""Motion from outlines: drawn of arcs and lines, or measured; against closed forms and the follower lowered on points.

Reference values (mm, rad, at cam angles in degrees) are closed forms, confirmed by the envelope of 400 000 points.
"""

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import camkit
from camkit import (
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    motion_from_outline,
)
from camkit.cam import DrawnOutline, MeasuredOutline, OutlineMotion, cam_from_outline, peak_acceleration
from camkit.files import from_json, to_json
from camkit.files.workshop import tables
from camkit.motion import Dwell
from camkit.units import deg, mm, um

GOLDEN = json.loads((Path(__file__).parents[1] / "data" / "outlines.json").read_text(encoding="utf-8"))
ECCENTRIC = DrawnOutline.circle(40 * mm, 0.0, -15 * mm)
TANGENT = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm)
HOLLOW = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm, -60 * mm)
FOLLOWERS = {
    "roller 10": TranslatingRollerCam(roller_radius=10 * mm),
    "roller 10, offset 8": TranslatingRollerCam(roller_radius=10 * mm, offset=8 * mm),
    "the same, clockwise": TranslatingRollerCam(roller_radius=10 * mm, offset=8 * mm, rotation=-1),
    "flat": TranslatingFlatCam(),
    "arm 90, 70, roller 12": OscillatingRollerCam(
        centre_distance=90 * mm, arm_length=70 * mm, roller_radius=12 * mm
    ),
    "the same, clockwise, arm": OscillatingRollerCam(
        centre_distance=90 * mm, arm_length=70 * mm, roller_radius=12 * mm, rotation=-1
    ),
    "flat arm 90, 5": OscillatingFlatCam(centre_distance=90 * mm, face_offset=5 * mm),
    "roller 12": TranslatingRollerCam(roller_radius=12 * mm),
    "roller 12, offset 6": TranslatingRollerCam(roller_radius=12 * mm, offset=6 * mm),
    "arm 80, 65, roller 12": OscillatingRollerCam(
        centre_distance=80 * mm, arm_length=65 * mm, roller_radius=12 * mm
    ),
}  # fmt: skip
OUTLINES = {"eccentric 40, 15": ECCENTRIC, "tangent 25, 8, 40": TANGENT, "hollow 25, 8, 40, flanks 60": HOLLOW}
CASES = [(outline, follower) for outline, values in GOLDEN.items() for follower in values if follower in FOLLOWERS]


def unit(motion):
    return mm if motion.unit == "mm" else 1.0


def lowered(points, cam, angles):
    """The follower let down on a cam of many points: the highest place at which any of them holds it up."""
    sigma, r = cam.rotation, getattr(cam, "roller_radius", 0.0)
    found = []
    for phi in angles:
        cos, sin = np.cos(sigma * phi), np.sin(sigma * phi)
        x, y = points[0] * cos - points[1] * sin, points[0] * sin + points[1] * cos
        with np.errstate(invalid="ignore"):
            if isinstance(cam, TranslatingRollerCam) and r == 0:
                at = _over_line(x - cam.offset, y)
            elif isinstance(cam, TranslatingRollerCam):
                at = y + np.sqrt(r**2 - (x - cam.offset) ** 2)
            elif isinstance(cam, TranslatingFlatCam):
                at = y
            else:
                a = cam.centre_distance
                d, mu = np.hypot(a - x, y), np.arctan2(y, a - x)
                if isinstance(cam, OscillatingFlatCam):
                    at = mu - np.arcsin(cam.face_offset / d)
                else:
                    l = cam.arm_length
                    at = mu + np.arccos((d**2 + l**2 - r**2) / (2 * d * l))
        found.append(np.nanmax(at))
    return np.array(found)


def _over_line(x, y):
    """Where a closed line of points crosses the y axis."""
    after, up = np.roll(x, -1), np.roll(y, -1)
    k = (x < 0) != (after < 0)
    return y[k] + (up - y)[k] * x[k] / (x - after)[k]


def dense(outline, n=20_000):
    """Many points of an outline, each piece by itself."""
    each = np.linspace(0, 1, n)
    return np.concatenate([piece.at(each).point for piece in outline.pieces], axis=1)


@pytest.mark.parametrize(("outline", "follower"), CASES)
def test_goldens(outline, follower):
    expected, motion = GOLDEN[outline][follower], motion_from_outline(OUTLINES[outline], FOLLOWERS[follower])
    s, v, a, _ = motion(np.array(expected["deg"]) * deg)
    found = (s + motion.lowest, v, a)
    for values, name in zip(found, "sva", strict=True):
        assert_allclose(values / unit(motion), expected[name], rtol=0, atol=1e-7 * np.abs(expected[name]).max())
    levels = motion(np.linspace(0, 2 * np.pi, 2001)).s
    assert -1e-12 <= levels.min() < 1e-5 * levels.max()


def test_the_case_of_the_eccentric():
    follower = TranslatingRollerCam(roller_radius=10 * mm)
    motion = motion_from_outline(DrawnOutline.circle(50 * mm, 0, -25 * mm), follower)
    assert_allclose(motion(np.array([0, 60, 90, 180]) * deg).s / mm, [0, 8.457573, 19.543560, 50], atol=1e-6)
    cam = cam_from_outline(DrawnOutline.circle(50 * mm, 0, -25 * mm), follower)
    assert cam.base_radius == pytest.approx(25 * mm, abs=1e-12)
    assert cam.analyse().highest(lambda at: abs(at.pressure_angle)).value / deg == pytest.approx(24.624318, abs=1e-6)
    turn = np.arange(360) * deg
    r = -25 * np.sin(turn) + np.sqrt(2500 - 625 * np.cos(turn) ** 2)
    measured = motion_from_outline(MeasuredOutline.polar(turn, np.round(r, 3) * mm, 1 * um), follower)
    assert_allclose(measured(np.array([0, 60, 90, 180]) * deg).s / mm, [0, 8.457573, 19.543560, 50], atol=5e-4)


def test_contact_changes_where_the_pieces_meet():
    edges = GOLDEN["tangent 25, 8, 40, roller 12, edges"]
    motion = motion_from_outline(TANGENT, FOLLOWERS["roller 12"])
    ends = np.asarray(motion.edges) / deg
    assert_allclose(ends[1:3], [edges["nose_end_deg"], edges["flank_end_deg"]], atol=1e-9)
    assert motion.jumps == ()
    joint = motion.transitions()[0]
    assert joint.order == 2  # the acceleration jumps, the velocity does not
    just = np.array([ends[1] - 1e-7, ends[1] + 1e-7]) * deg
    assert_allclose(motion(just).a / mm, [edges["before"][2], edges["after"][2]], rtol=1e-5)
    assert isinstance(motion.segments[2], Dwell)


def test_a_roller_too_wide_for_the_hollow_leaps_and_the_jump_is_named():
    motion = motion_from_outline(HOLLOW, TranslatingRollerCam(roller_radius=75 * mm))
    leap, back = motion.jumps
    assert leap.cam_angle / deg == pytest.approx(53.9227, abs=1e-3)
    assert (leap.before / mm, leap.after) == (pytest.approx(-42.29046, abs=1e-4), 0.0)
    assert back.cam_angle == pytest.approx(2 * np.pi - leap.cam_angle)
    assert any("at 53.9228 deg the contact leaps over a part of the outline" in told for told in motion.remarks)
    assert any("the velocity jumps from -42.29 to 0 mm/rad" in told for told in motion.remarks)


@pytest.mark.parametrize("rotation", [1, -1])
@pytest.mark.parametrize("kind", ["roller 10, offset 8", "flat", "arm 90, 70, roller 12", "flat arm 90, 5", "knife"])
@pytest.mark.parametrize("shape", ["tangent", "hollow", "corners"])
def test_it_is_the_follower_let_down_on_the_outline(shape, kind, rotation):
    outline = {
        "tangent": TANGENT,
        "hollow": HOLLOW,
        "corners": DrawnOutline(
            ((0.030, -0.02), (0.031, 0.022), (0.002, 0.026), (-0.022, 0.018), (-0.03, -0.018)), (0.0, 0.3, 0, 0.4, 0)
        ),
    }[shape]
    knife = TranslatingRollerCam(roller_radius=0.0, offset=3 * mm)
    cam = (knife if kind == "knife" else FOLLOWERS[kind]).replace(rotation=rotation)
    motion, angles = motion_from_outline(outline, cam), np.linspace(0, 2 * np.pi, 40) + 0.003
    held = lowered(dense(outline), cam, angles)
    assert_allclose(motion(angles).s + motion.lowest, held, rtol=0, atol=2e-7)


@pytest.mark.parametrize("kind", list(FOLLOWERS)[:7])
@pytest.mark.parametrize("scatter", [0.0, 5.0])
def test_points_give_the_motion_as_well_as_they_know_it(kind, scatter):
    turn = np.arange(360) * deg
    r = -15 * np.sin(turn) + np.sqrt(1600 - 225 * np.cos(turn) ** 2)
    r = np.round(r + scatter / 1e3 * noise(360, 7), 3)
    exact = motion_from_outline(ECCENTRIC, FOLLOWERS[kind])
    motion = motion_from_outline(MeasuredOutline.polar(turn, r * mm, 1 * um), FOLLOWERS[kind])
    x, size = np.linspace(0, 2 * np.pi, 721), 60 * mm if motion.unit == "deg" else 1.0
    off = [abs(one - other).max() * size for one, other in zip(motion(x)[:3], exact(x)[:3], strict=True)]
    most = (0.2 * um, 0.5 * um, 3e-4 * abs(exact(x).a).max() * size)
    assert (np.array(off) < np.array(most) * (1 if scatter == 0 else 25)).all()
    assert motion.noise == pytest.approx(scatter * um or 0.3 * um, rel=0.15)


def noise(n, seed):
    """Even noise of variance 1."""
    x, found = seed, []
    for _ in range(n):
        x = 16807 * x % (2**31 - 1)
        found.append(np.sqrt(12) * (x / (2**31 - 1) - 0.5))
    return np.array(found)


def points(n=400, scatter=0.002):
    """An outline with a hollow, measured."""
    turn = 2 * np.pi * np.arange(n) / n
    r = 40 + 6 * np.cos(turn) + 2 * np.cos(3 * turn + 1) + scatter * noise(n, 3)
    return np.round(np.array([r * np.cos(turn), r * np.sin(turn)]), 4) * mm


@pytest.mark.parametrize("change", ["backwards", "begun elsewhere", "closed", "rows", "doubled"])
def test_how_points_are_written_does_not_matter(change):
    given, cam = points(), FOLLOWERS["roller 10"]
    other = {
        "backwards": given[:, ::-1],
        "begun elsewhere": np.roll(given, 137, axis=1),
        "closed": np.append(given, given[:, :1], axis=1),
        "rows": given.T,
        "doubled": np.repeat(given, 2, axis=1),
    }[change]
    x = np.linspace(0, 2 * np.pi, 361)
    one, same = motion_from_outline(given, cam), motion_from_outline(other.tolist(), cam)
    assert_allclose(same(x).s, one(x).s, rtol=0, atol=1e-9)
    assert_allclose(same(x).a, one(x).a, rtol=0, atol=1e-6)


def test_bad_points_are_named_and_left_out():
    given = points()
    clean = motion_from_outline(given, FOLLOWERS["roller 10"])
    given[:, 80] *= 1 + 0.03 / 40
    motion = motion_from_outline(given, FOLLOWERS["roller 10"])
    ((row, angle, off),) = motion.bad_rows
    assert (row, angle) == (81, pytest.approx(72 * deg, abs=1e-6))
    assert off == pytest.approx(0.03 * mm, rel=0.2)
    assert any("point 81 at polar angle 72 deg is 0.0" in told for told in motion.remarks)
    x = np.linspace(0, 2 * np.pi, 361)
    assert_allclose(motion(x).s, clean(x).s, atol=2e-6)


def test_a_steep_outline_is_smoothed_over_its_length():
    """A slot as radii tell it badly: x and y over the length of the chords tell it well."""
    corners = np.array([(0.04, -0.01), (0.04, 0.01), (-0.02, 0.01), (-0.02, -0.01)])
    slot = DrawnOutline(corners.tolist(), (1.0, 0.0, 1.0, 0.0))
    u = np.arange(2000) / 2000
    around = np.concatenate(
        [piece.at(u).point[:, :: 10 if k % 2 else 5] for k, piece in enumerate(slot.pieces)], axis=1
    )
    outline = MeasuredOutline(around.T.tolist())
    assert "x and y smoothed over its length" in outline.remarks[0]
    cam = FOLLOWERS["roller 10"]
    x = np.linspace(0, 2 * np.pi, 181)
    motion = motion_from_outline(outline, cam)
    assert_allclose(motion(x).s + motion.lowest, lowered(dense(slot), cam, x), atol=1e-5)


@pytest.mark.parametrize("rotation", [1, -1])
@pytest.mark.parametrize(
    "design",
    [
        TranslatingRollerCam(groove=False, offset=5 * mm),
        TranslatingRollerCam(groove=False, roller_radius=0.0),
        TranslatingFlatCam(),
        OscillatingRollerCam(groove=False),
        OscillatingFlatCam(),
    ],
    ids=lambda cam: type(cam).__name__ + ("" if cam.roller_radius else " sharp"),
)
def test_a_cam_is_designed_anew_from_its_profile(design, rotation):
    """Through the points that go to the workshop, written to 1 nm: what comes back is the design."""
    design = design.replace(rotation=rotation)
    rows = [row.split(",") for row in tables.table(design.analyse(1441)).data.decode().splitlines()]
    x, y = (rows[0].index(f"profile {axis} [mm]") for axis in "xy")
    profile = np.array([[float(row[x]), float(row[y])] for row in rows[1:]]) * mm
    cam = cam_from_outline(MeasuredOutline(profile, 1e-9), design)
    assert isinstance(cam.motion, OutlineMotion)
    of = "base_radius" if hasattr(design, "base_radius") else "start_angle"
    assert getattr(cam, of) == pytest.approx(getattr(design, of), abs=1e-6)
    angles = np.linspace(0, 2 * np.pi, 721)
    size = 1.0 if cam.motion.unit == "mm" else 60 * mm
    expected, found = design.motion(angles), cam.motion(angles)
    assert_allclose(found.s * size, expected.s * size, rtol=0, atol=0.5 * um)
    assert_allclose(found.v * size, expected.v * size, rtol=0, atol=20 * um)
    assert_allclose(cam.analyse(1441).profile, design.analyse(1441).profile, rtol=0, atol=20 * um)


def test_a_drawn_cam_is_designed_anew_to_the_last_digit():
    cam = cam_from_outline(TANGENT, FOLLOWERS["roller 12"].replace(groove=False))
    x, y = cam.analyse(2001).profile
    on_nose, on_base = abs(np.hypot(x, y - 40 * mm) - 8 * mm) < 1e-9, abs(np.hypot(x, y) - 25 * mm) < 1e-9
    leans = np.arccos((25 - 8) / 40)  # the flank's normal, from the nose's direction
    on_flank = abs(np.sin(leans) * abs(x) + np.cos(leans) * y - 25 * mm) < 1e-9
    assert (on_nose | on_base | on_flank).all()
    assert min(on_nose.sum(), on_base.sum(), on_flank.sum()) > 10
    assert np.isfinite(peak_acceleration(cam.analyse()))


def test_a_corner_under_a_knife_edge_is_named():
    square = DrawnOutline(((0.02, -0.02), (0.02, 0.02), (-0.02, 0.02), (-0.02, -0.02)))
    motion = motion_from_outline(square, TranslatingRollerCam(roller_radius=0.0))
    assert len(motion.jumps) == 4
    assert [round(jump.cam_angle / deg, 6) for jump in motion.jumps] == [45, 135, 225, 315]
    assert any("at 45 deg the follower passes a corner: the velocity jumps from 28" in told for told in motion.remarks)
    assert motion.lowest == pytest.approx(20 * mm)


def test_joints_that_are_not_quite_tangent_are_taken_as_tangent():
    rounded = DrawnOutline(np.round(np.array(TANGENT.corners), 7).tolist(), np.round(TANGENT.bulges, 6).tolist())
    motion = motion_from_outline(rounded, FOLLOWERS["roller 12"])
    assert motion.jumps == ()
    assert "not quite tangent; taken as tangent" in motion.remarks[-1]
    x = np.linspace(0, 2 * np.pi, 721)
    assert_allclose(motion(x).s, motion_from_outline(TANGENT, FOLLOWERS["roller 12"])(x).s, atol=1e-6)


def test_an_outline_of_many_arcs_is_taken_as_points():
    turn = 2 * np.pi * np.arange(300) / 300
    r = 40 * mm + 5 * mm * np.cos(turn)
    outline = DrawnOutline(np.array([r * np.cos(turn), r * np.sin(turn)]).T.tolist(), (0.002,) * 300)
    motion = motion_from_outline(outline, FOLLOWERS["roller 10"])
    assert any("lines and arcs taken as points on them" in told for told in motion.remarks)
    assert len(motion.segments) < 10


def test_it_is_saved_with_what_it_says():
    cam = cam_from_outline(HOLLOW, FOLLOWERS["roller 12"].replace(groove=False))
    read = from_json(to_json(cam))
    assert read == cam
    assert read.motion.remarks == cam.motion.remarks
    assert read.motion.jumps == cam.motion.jumps
    assert read.motion.outline == cam.motion.outline


def eight(t):
    """A line that crosses itself at x = 8 mm."""
    return 25 * mm * np.cos(t) + 8 * mm, 25 * mm * np.sin(2 * t)


ROUND = [(0.04 * np.cos(t), 0.04 * np.sin(t)) for t in np.arange(0, 6.28, 0.1)]


@pytest.mark.parametrize(
    ("given", "cam", "why"),
    [
        (ROUND, FOLLOWERS["flat"], "the follower does not move: for it the outline is a circle about the cam axis"),
        (ROUND[:5], FOLLOWERS["flat"], "the points of the outline are 2 x 5; they must be 12 to"),
        (ROUND[:40], FOLLOWERS["flat"], "between points 40 and 1 of the outline .* points are missing"),
        (
            np.array(ROUND) * 1000,
            FOLLOWERS["flat"],
            "the outline reaches 40 m from the cam axis; .* write points [*] mm",
        ),
        (np.array(ROUND) + 0.1, FOLLOWERS["flat"], "the outline lies beside the cam axis"),
        (ROUND * 2, FOLLOWERS["flat"], "the outline goes around the cam axis 2 times.* its points in their order"),
        (np.array(eight(np.arange(0, 6.28, 0.02))), FOLLOWERS["flat"], "the outline crosses itself near x 8"),
        ([*ROUND[:20], (np.nan, 1), *ROUND[20:]], FOLLOWERS["flat"], "point 21 of the outline holds a number"),
        (ECCENTRIC, camkit.HighSpeedCam(), "the follower is .*; it must be a design of one of"),
        (ECCENTRIC, TranslatingRollerCam(base_radius=np.array([[0.03], [0.04]])), "the follower is a population"),
        (
            ECCENTRIC,
            TranslatingRollerCam(base_radius=90 * mm, offset=60 * mm),
            "the follower touches the outline nowhere at cam angle .*passes beside the cam",
        ),
        (
            ECCENTRIC,
            OscillatingRollerCam(centre_distance=150 * mm, arm_length=80 * mm),
            "the follower touches the outline nowhere at cam angle",
        ),
    ],
)
def test_what_is_no_outline_is_refused(given, cam, why):
    with pytest.raises(ValueError, match=why):
        motion_from_outline(given, cam)


@pytest.mark.parametrize(
    ("made", "why"),
    [
        (lambda: DrawnOutline(((0.02, 0), (-0.02, 0)), (1.0,)), "2 corners and 1 bulges"),
        (lambda: DrawnOutline(((0.02, 0), (-0.02, 0)), (1.0, np.inf)), "it needs a finite one for each"),
        (lambda: DrawnOutline.circle(0.01, 0.02), "the outline lies beside the cam axis"),
        (lambda: DrawnOutline(np.array(eight(np.arange(0.1, 6.2, 0.6))).T, (0.0,) * 11), "the outline crosses itself"),
        (lambda: DrawnOutline.circle(-0.01), "the radius of the circle is -0.01; it must be above 0 m"),
        (lambda: DrawnOutline.tangent(0.025, 0.008, 0.010), "the nose must stand out of the base circle"),
        (lambda: DrawnOutline.tangent(0.025, 0.008, 0.040, 0.020), "no flank touches base circle and nose"),
        (lambda: DrawnOutline.tangent(0.025, 0.008, 0.040, 0.025), "no flank touches base circle and nose"),
        (lambda: DrawnOutline.tangent(0.025, 0.008, 0.040, 0.008), "no flank touches base circle and nose"),
        (
            lambda: DrawnOutline.tangent(0.025, 0.008, 0.040, 0.0),
            "the flank's radius is 0; it must be a number",
        ),
        (lambda: MeasuredOutline.polar([0.0, 1.0], [0.02]), "2 polar angles and 1 radii"),
        (lambda: MeasuredOutline.polar(np.arange(6), np.arange(6)), "point 1 of the outline has the radius 0 m"),
        (lambda: MeasuredOutline(ROUND, tolerance=0.0), "the tolerance is 0; it must be above 0 m"),
    ],
)
def test_what_cannot_be_drawn_is_refused(made, why):
    with pytest.raises(ValueError, match=why):
        made()


@pytest.mark.parametrize("flank", [None, -60 * mm, 90 * mm])
def test_flanks_of_a_tangent_cam_are_tangent_to_both(flank):
    pieces = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm, flank).pieces
    assert len(pieces) == 4
    ends = np.array([0.0, 1.0])
    for one, after in zip(pieces, pieces[1:] + pieces[:1], strict=True):
        first, second = one.at(ends), after.at(ends)
        assert_allclose(first.point[:, 1], second.point[:, 0], atol=1e-12)
        assert np.cos(first.normal[1] - second.normal[0]) == pytest.approx(1, abs=1e-12)
    radii = sorted(float(piece.at(ends).radius[0]) / mm for piece in pieces)
    other = np.inf if flank is None else flank / mm
    assert_allclose(radii, sorted([25, 8, other, other]))


@pytest.mark.parametrize("digits", [4, 5, 6, 7])
def test_an_outline_drawn_to_so_many_digits_of_a_millimetre_closes(digits):
    follower = TranslatingRollerCam(roller_radius=12 * mm, groove=False)
    for turned in (0.3, 1.7, 4.0):
        turn = np.array([[np.cos(turned), np.sin(turned)], [-np.sin(turned), np.cos(turned)]])
        corners = np.round(np.array(TANGENT.corners) @ turn / mm, digits) * mm
        motion = motion_from_outline(DrawnOutline(corners, np.round(TANGENT.bulges, digits + 3)), follower)
        assert motion.closes
        whole = motion_from_outline(DrawnOutline(np.array(TANGENT.corners) @ turn, TANGENT.bulges), follower)
        x = np.linspace(0, 2 * np.pi, 400)
        assert_allclose(motion(x).s, whole(x).s, rtol=0, atol=20 * 10.0**-digits * mm)


def test_a_smooth_outline_has_no_jumps_however_the_arm_is_set():
    assert motion_from_outline(ECCENTRIC, OscillatingFlatCam(centre_distance=90 * mm, face_offset=60 * mm)).jumps == ()
