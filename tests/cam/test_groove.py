"""Walls that merge: by geometry, the flanks of a groove against every position of the tool that cuts it."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import DoorHandleCam, OscillatingRollerCam
from camkit.cam import groove
from camkit.cam.measures import groove_gap, undercut_margin
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.motion import LAWS, Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.units import deg, mm


def wall(pitch, r):
    """The least distance of places at least pi r apart along the curve, less the groove's width."""
    x, y = pitch
    along = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    distance = np.hypot(x[:, None] - x, y[:, None] - y)
    return np.where(along[None, :] - along[:, None] >= np.pi * r, distance, np.inf).min() - 2 * r


def cut(pitch, flank, r):
    """By how much the tool on its way along the pitch curve cuts into a flank of the groove that it has left."""
    gap = np.hypot(*(flank[:, :, None] - pitch[:, None, :])).min(-1)
    return r - gap.min()


def test_the_ends_of_an_open_groove_merge():
    """350 deg with a rise of 5 mm: the end lies 5 mm outside the start, the groove is 16 mm wide."""
    cam = TranslatingRollerCam(MotionProgram((Rise(350 * deg, 5 * mm, Cycloidal()),)))
    analysis = cam.analyse(3001)
    assert groove_gap(analysis) == pytest.approx(wall(analysis.pitch, 8 * mm), abs=1e-3 * mm)
    assert groove_gap(analysis) / mm == pytest.approx(-7.36, abs=0.01)
    assert undercut_margin(analysis) > 0.5  # which sees nothing of it
    assert cut(analysis.pitch, analysis.profile[:, ::10], 8 * mm) > 0.5 * mm
    assert groove_gap(cam.replace(roller_radius=3 * mm).analyse()) > 0
    assert groove_gap(cam.replace(groove=False).analyse()) == np.inf
    for angle, merges in ((300, False), (330, False), (345, True)):
        open_ = cam.replace(motion=MotionProgram((Rise(angle * deg, 5 * mm, Cycloidal()),))).analyse(2001)
        assert (groove_gap(open_) < 0) == merges == (wall(open_.pitch, 8 * mm) < 0)


@pytest.mark.parametrize("at", [45.0, 46.3, 47.9, 50.0, 51.1])
@pytest.mark.parametrize("radius", [12.01, 12.5, 13])
def test_a_waist_is_found_between_the_places_looked_at(radius, at):
    """Two legs 30 mm apart around a half circle; both bulge inwards by 1.5 mm at the same height."""

    def hairpin(t):
        bend = np.clip(t - 100, 0, 15 * np.pi) / 15
        leg = np.minimum(t, 100) - np.maximum(t - 100 - 15 * np.pi, 0)
        half = 15 - 1.5 * np.exp(-(((leg - at) / 15) ** 2))
        return np.stack([-half * np.cos(bend), leg + 15 * np.sin(bend)])

    assert groove.gap(hairpin, 200 + 15 * np.pi, radius) == pytest.approx(27 - 2 * radius, abs=2e-3)


@pytest.mark.parametrize("degrees", [182, 186, 190, 200, 215])
def test_of_an_arc_only_places_half_a_circle_apart_count(degrees):
    """Its ends are the nearest of them: nearer places lie along the groove, not side by side."""
    r, span = 10.2, np.radians(degrees)
    chord = 2 * r * np.sin(span / 2)
    assert groove.gap(lambda u: r * np.stack([np.cos(u), np.sin(u)]), span, 10) == pytest.approx(chord - 20, abs=1e-9)


def test_a_closed_cam_has_no_ends():
    assert groove_gap(TranslatingRollerCam().analyse()) == np.inf
    assert groove_gap(OscillatingRollerCam().analyse()) == np.inf


RANGES = {
    "lift_arm": (42 * mm, 58 * mm),
    "lift_start_angle": (26 * deg, 32 * deg),
    "relief_arm": (78 * mm, 92 * mm),
    "relief_cam_angle": (38 * deg, 48 * deg),
    "handle_angle": (190 * deg, 200 * deg),
    "lift_swing": (35 * deg, 46 * deg),
    "relief_swing": (15 * deg, 26 * deg),
    "roller_radius": (4 * mm, 9 * mm),
}
"""Where the lift curve ends beside the beginning of the relief curve."""


def random_doors(n):
    low, high = np.array(list(RANGES.values())).T
    return list(RANGES), low + (high - low) * np.random.default_rng(3).random((n, len(low)))


def test_the_whole_groove_of_door_handles_by_geometry():
    """Where the curvature is kept, walls merge where brute force over all pairs says so, and by as much."""
    names, rows = random_doors(120)
    many = DoorHandleCam(**dict(zip(names, rows.T[:, :, None], strict=True))).analyse(61)
    margin = np.minimum(undercut_margin(many.lift), undercut_margin(many.relief))
    gaps, merged = groove_gap(many), 0
    for row, gap in zip(rows[margin > 0], gaps[margin > 0], strict=True):
        pitch = DoorHandleCam(**dict(zip(names, map(float, row), strict=True))).analyse(601).pitch
        brute = wall(pitch, row[-1])
        assert (gap < 0) == (brute < 0)
        if gap < 0:
            merged += 1
            assert gap == pytest.approx(brute, abs=0.02 * mm)
        else:
            assert gap > brute - 0.05 * mm
    assert merged >= 3


def test_a_population_of_grooves_is_its_members():
    names, rows = random_doors(12)
    gaps = groove_gap(DoorHandleCam(**dict(zip(names, rows.T[:, :, None], strict=True))).analyse(61))
    for row, gap in zip(rows, gaps, strict=True):
        if np.isfinite(gap):
            one = DoorHandleCam(**dict(zip(names, map(float, row), strict=True)))
            assert groove_gap(one.analyse(61)) == pytest.approx(gap, rel=1e-12)
    spans = np.array([[350.0], [300.0]]) * deg
    some = TranslatingRollerCam(MotionProgram((Rise(spans, 5 * mm, Cycloidal()),))).analyse(91)
    assert_array_equal(groove_gap(some) < 0, [True, False])


@pytest.mark.parametrize("kind", ["slides", "rocks"])
def test_of_closed_cams_the_local_test_is_enough(kind):
    """Random closed cams: where neither flank is locally undercut no position of the roller cuts one, or the follower
    is nearly wedged."""
    rng, kept, cut_away = np.random.default_rng(11), 0, 0
    for _ in range(150):
        up, high, down = rng.uniform(30, 120), rng.uniform(1, 60), rng.uniform(30, 120)
        spans = np.array([up, high, down, 360 - up - high - down]) * deg
        lift = rng.uniform(5, 60) * (mm if kind == "slides" else deg)
        laws = [LAWS[i] for i in rng.integers(len(LAWS), size=2)]
        moves = (Rise(spans[0], lift, laws[0]), Dwell(spans[1]), Return(spans[2], lift, laws[1]), Dwell(spans[3]))
        sigma, r = int(rng.choice([-1, 1])), rng.uniform(2, 20) * mm
        if kind == "slides":
            e = rng.uniform(-10, 10) * mm
            cam = TranslatingRollerCam(MotionProgram(moves), rng.uniform(12, 50) * mm, r, e, sigma)
        else:
            l, psi = rng.uniform(40, 90) * mm, rng.uniform(15, 60) * deg
            cam = OscillatingRollerCam(MotionProgram(moves), 80 * mm, l, psi, r, sigma)
        try:
            fine = cam.analyse(1201)
        except ValueError:
            continue
        if abs(fine.pressure_angle).max() > 85 * deg:
            continue
        for flank, margin in ((fine.profile, fine.profile_margin), (fine.outer_profile, fine.outer_profile_margin)):
            gouge = cut(fine.pitch, flank[:, ::6], cam.roller_radius)
            if margin.value > 0:
                kept += 1
                assert gouge < 1e-3 * cam.roller_radius
            elif margin.value < -0.2 * cam.roller_radius:
                cut_away += gouge > 1e-3 * cam.roller_radius
    assert kept > 60
    assert cut_away > 5
