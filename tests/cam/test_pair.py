"""Pairs of cams as one design: where both sides of the follower stand, which cam pushes, and how hard."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import MPa, Study, deg, mm
from camkit.cam import ContactPair, base_radius, max_pressure_angle, mean_efficiency, peak_force, peak_torque
from camkit.cam.follower_measures import min_profile_radius, peak_pressure
from camkit.cam.force_closure import NoContact
from camkit.cam.pair import CAMS, ConjugatePair
from camkit.geometry import rotated
from camkit.quantities import measures_of, quantities_of, with_quantities
from camkit.views import default_views
from camkit.views.cam import contact_pressure

PAIRS = [ConjugatePair(cam.replace(rotation=sigma, contact=ContactPair())) for cam in CAMS for sigma in (1, -1)]
every_pair = pytest.mark.parametrize("pair", PAIRS, ids=lambda p: f"{p.cam.name}, {p.cam.rotation:+d}")


def part(analysis, name, what):
    return next(body for body in analysis.bodies if body.name == name and body.part == what)


@every_pair
def test_both_cams_turn_as_one_and_touch_their_side_of_one_follower(pair):
    """Each profile, turned with the shaft by the angle of the first cam, touches roller or face and does not cut it."""
    analysis = pair.analyse(721)
    for i in (0, 100, 333):
        turn = pair.cam.rotation * analysis.cam_angle[i]
        for name, radius in (("first", pair.cam.roller_radius), ("second", pair.second.roller_radius)):
            profile = part(analysis, name, "profile")
            assert_allclose(profile.at(i), rotated(profile.at(0), turn), atol=1e-12)  # one shaft
            if pair.cam.roller_radius:
                centre = part(analysis, name, "roller").at(i)
                assert np.hypot(*(profile.at(i) - centre[:, None])).min() == pytest.approx(radius, abs=2e-6)
            else:
                a, b = part(analysis, name, "face").at(i).T
                along = (b - a) / np.hypot(*(b - a))
                beyond = along[0] * (profile.at(i)[1] - a[1]) - along[1] * (profile.at(i)[0] - a[0])
                assert min(abs(beyond.max()), abs(beyond.min())) < 2e-6  # all of the cam lies on one side, and touches


@pytest.mark.parametrize("pair", [p for p in PAIRS if p.cam.roller_radius], ids=lambda p: p.cam.name)
def test_both_rollers_belong_to_one_rigid_follower(pair):
    analysis = pair.analyse(91)
    centres = [np.stack([part(analysis, name, "roller").at(i) for i in range(91)], -1) for name in ("first", "second")]
    if pair.mirrored:
        pivot = np.array([[pair.cam.centre_distance], [0.0]])
        one, two = (np.arctan2(*(centre - pivot)[::-1]) for centre in centres)
        assert_allclose(np.mod(two - one, 2 * np.pi), pair.spread, rtol=1e-12)
    else:
        assert_allclose(centres[0] - centres[1], [[0.0], [pair.distance]] + 0 * centres[0], atol=1e-15)


@every_pair
def test_measures_count_each_cam_where_it_pushes(pair):
    few, fine = pair.analyse(3), pair.analyse(20_001)
    first, second = fine.first, fine.second
    pushing = [curve.contact_force >= 0 for curve in (first, second)]
    assert (pushing[0] | pushing[1]).all()
    assert all(each.mean() > 0.05 for each in pushing)

    def largest(of):
        return max(of(curve)[where].max() for curve, where in zip((first, second), pushing, strict=True))

    assert peak_force(few) == pytest.approx(largest(lambda a: a.contact_force), rel=1e-5)
    assert peak_torque(few) == pytest.approx(abs(first.cam_torque).max(), rel=1e-5)
    steepest = largest(lambda a: abs(a.pressure_angle))  # often where the other cam takes over, between two angles
    assert max_pressure_angle(few) == pytest.approx(steepest, rel=1e-4, abs=1e-9)
    assert peak_pressure(few) == pytest.approx(largest(lambda a: a.contact_pressure), rel=1e-5)
    assert base_radius(few) == pytest.approx(min(a.pitch_radius.min() for a in (first, second)), rel=1e-7)
    tight = min(a.profile_margin.value for a in (first, second))
    assert min_profile_radius(few) == tight
    assert 0.2 < mean_efficiency(few) < 1


@every_pair
def test_the_pressure_of_a_pair_is_shown_where_its_cams_push(pair):
    analysis = pair.analyse(91)
    assert peak_pressure in measures_of(pair)
    assert default_views(analysis)[-1] is contact_pressure
    shown = contact_pressure(analysis)
    for name, curve in analysis.curves.items():
        one = curve.cam.analyse(91)  # alone
        pushed = np.where(one.contact_force >= 0, one.contact_pressure, np.nan)
        assert_allclose(shown[name].y * MPa, pushed, rtol=1e-12)
        assert np.isnan(shown[f"{name} none"].y).all()  # nothing is wrong where the other cam pushes
    bare = pair.replace(cam=pair.cam.replace(contact=NoContact()))
    assert peak_pressure not in measures_of(bare)
    assert contact_pressure not in default_views(bare.analyse(91))
    with pytest.raises(ValueError, match=r"^the peak contact pressure does .*: the cam contact is not given; it must "):
        Study(bare, ["distance" if "distance" in quantities_of(bare) else "spread"], (peak_pressure,))


def test_the_sizes_of_the_second_cam_are_those_that_its_follower_has():
    own = {type(p.cam): [path for path in quantities_of(p) if not path.startswith("cam.")] for p in PAIRS}
    assert list(own.values()) == [
        ["distance", "roller_radius"],
        ["distance"],
        ["spread", "arm_length", "roller_radius"],
        ["spread", "face_offset"],
    ]
    pair = with_quantities(ConjugatePair(), {"distance": 120 * mm, "roller_radius": 5 * mm})
    assert pair.second.roller_radius == 5 * mm
    assert pair.second.start_height == pytest.approx(120 * mm - pair.first.start_height)
    rocking = with_quantities(with_quantities(pair, {"cam": "rocking face"}), {"spread": 70 * deg})
    assert rocking.second.start_angle == pytest.approx(70 * deg - rocking.cam.start_angle)
    with pytest.raises(ValueError, match=r"^'cam.groove' is no path of ConjugatePair: each cam of a pair is a plate$"):
        with_quantities(pair, {"cam.groove": "groove"})
    with pytest.raises(ValueError, match=r"^the rollers' centres are 20 mm apart; the first stands 38 mm above"):
        ConjugatePair(distance=20 * mm)
    low = r"^the second cam cannot be built; the distance is 50 mm, the roller radius is 8 mm: the roller's centre "
    with pytest.raises(ValueError, match=low):
        ConjugatePair(distance=50 * mm).analyse()
