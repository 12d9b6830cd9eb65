"""The same motion, better: a cam that exists is measured, and a study makes its acceleration smaller near it."""

import numpy as np
import pytest

from camkit import (
    Dwell,
    MotionProgram,
    Return,
    Rise,
    Study,
    TranslatingRollerCam,
    deg,
    minimise,
    mm,
)
from camkit.cam import MeasuredOutline, cam_from_outline, deviation_from, peak_acceleration
from camkit.motion import SPLINE, Cycloidal, Poly4567, ShapedLaw
from camkit.units import um


def program(law):
    """12 mm up in 100 deg and down in 120 deg, with dwells."""
    return MotionProgram(
        (Rise(100 * deg, 12 * mm, law), Dwell(60 * deg), Return(120 * deg, 12 * mm, law), Dwell(80 * deg))
    )


def old_cam():
    """A cam whose acceleration is high, 4-5-6-7, and its points with 1 um of scatter."""
    design = TranslatingRollerCam(program(Poly4567()), 40 * mm, 10 * mm, groove=False)
    x, y = design.analyse(721).profile[:, :-1]
    scatter = 1 * um * np.random.default_rng(1).standard_normal(720)
    return design, MeasuredOutline((np.array([x, y]) * (1 + scatter / np.hypot(x, y))).T, 0.1 * um)


def test_the_same_lift_with_less_acceleration_within_a_band_of_the_old_cam():
    design, outline = old_cam()
    read = cam_from_outline(outline, design)
    deviation = deviation_from(read.motion)
    assert deviation.one(design.analyse()) < 5 * um  # the old cam itself is near what was read of it
    start = read.replace(motion=program(ShapedLaw(Poly4567(), family=SPLINE)))
    free = tuple(f"motion.{move}.law.c{k}" for move in ("rise", "return") for k in range(4))
    before, reached = peak_acceleration.one(start.analyse()), {}
    for band in (0.05, 0.1):
        found = minimise(Study(start, free, [peak_acceleration], at_most={deviation: band * mm})).design.analyse()
        angles = np.linspace(0, 2 * np.pi, 5001)
        assert abs(found.cam.motion(angles).s - read.motion(angles).s).max() <= band * mm * 1.0001
        assert abs(found.cam.motion(100 * deg).s - 12 * mm) < 1e-12  # the same lift at the same angle
        reached[band] = peak_acceleration.one(found)
    assert reached[0.1] < reached[0.05] < 0.97 * before
    assert reached[0.1] < 0.94 * before


def test_a_deviation_is_that_of_the_levels():
    design, _ = old_cam()
    other = design.replace(motion=MotionProgram((Rise(100 * deg, 12 * mm, Cycloidal()), *design.motion.segments[1:])))
    x = np.linspace(0, 2 * np.pi, 20_001)
    expected = np.abs(other.motion(x).s - design.motion(x).s).max()
    assert deviation_from(design.motion).one(other.analyse()) == pytest.approx(expected, rel=1e-6)
    with pytest.raises(ValueError, match="unit is 'in'; it must be 'mm' for a sliding follower"):
        deviation_from(design.motion, "in")
