"""Laws that do not rest at both ends, between dwells: a blow on the follower, which no search may take for gentle."""

from dataclasses import replace

import numpy as np
import pytest

from camkit import (
    Cycloidal,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Study,
    TranslatingFlatCam,
    TranslatingRollerCam,
    minimise,
    mm,
    rpm,
    with_quantities,
)
from camkit.cam import ConjugatePair, min_force, peak_acceleration, peak_force, peak_torque, peak_wear
from camkit.motion import ConstantVelocity, HalfHarmonicStart

CAMS = [TranslatingRollerCam(), TranslatingFlatCam(), OscillatingRollerCam(), OscillatingFlatCam()]
FORCED = (peak_force, peak_torque)


def under(cam, law):
    parts = [replace(part, law=law) if hasattr(part, "law") else part for part in cam.motion.segments]
    return replace(cam, motion=replace(cam.motion, segments=tuple(parts)))


@pytest.mark.parametrize("cam", CAMS, ids=lambda cam: type(cam).__name__)
def test_a_follower_that_is_struck_has_no_largest_acceleration_and_force(cam):
    gentle, struck = (under(cam, law).analyse() for law in (Cycloidal(), HalfHarmonicStart()))
    for measure in (peak_acceleration, *FORCED, min_force):
        assert np.isfinite(measure.one(gentle))
    assert gentle.program.peaks().acceleration.value == pytest.approx(peak_acceleration.one(gentle), rel=1e-6)
    assert struck.program.peaks().acceleration.value == np.inf
    assert {m.one(struck) for m in (peak_acceleration, *FORCED, -min_force)} == {np.inf}
    assert np.isinf(peak_force.curve(struck)).all()


def test_forces_grow_without_end_towards_that_of_a_blow():
    """Constant velocity with ever shorter blends: halve them, and the acceleration and its force double."""
    cam = with_quantities(TranslatingRollerCam(), {"load.speed": 3000 * rpm})
    force = [peak_force.one(under(cam, ConstantVelocity(blend=b)).analyse()) for b in (0.04, 0.02, 0.01)]
    assert force[2] - force[1] == pytest.approx(2 * (force[1] - force[0]), rel=0.05)


def test_without_mass_or_at_rest_forces_are_finite():
    for free in ({"load.speed": 0.0}, {"load.mass": 0.0}):
        struck = with_quantities(under(TranslatingRollerCam(), HalfHarmonicStart()), free).analyse()
        assert peak_acceleration.one(struck) == np.inf
        assert np.isfinite([m.one(struck) for m in (*FORCED, min_force)]).all()


def test_a_pair_is_struck_as_its_first_cam():
    pair = ConjugatePair()
    assert np.isfinite(peak_force.one(pair.analyse()))
    assert peak_force.one(replace(pair, cam=under(pair.cam, HalfHarmonicStart())).analyse()) == np.inf


def test_a_zone_without_a_blow_has_its_peak():
    struck = under(TranslatingRollerCam(), HalfHarmonicStart()).analyse()  # at 120 and 300 degrees
    assert np.isfinite(peak_force.between(0.2, 1.8).one(struck))
    assert peak_force.between(1.8, 2.4).one(struck) == np.inf


def test_no_search_takes_a_blow_for_the_best_law():
    cam = TranslatingRollerCam()
    laws = [(law, law) for law in (HalfHarmonicStart(), Cycloidal())]
    free = {("motion.rise.law", "motion.return.law"): laws, "base_radius": (20 * mm, 60 * mm)}
    best = minimise(Study(cam, free, (peak_wear,)))
    assert best.design.motion.segments[0].law == Cycloidal()
