"""Cam cards: printed values, brute force, lash and rocker, dwells, populations, tables, and as measures of a search."""

import json
from pathlib import Path

import numpy as np
import pytest

from camkit import Study, TranslatingRollerCam, ValveCam, minimise, read_motion
from camkit.cam import ConjugatePair, OscillatingRollerCam, at_lift, peak_acceleration
from camkit.files import from_json, to_json
from camkit.motion import (
    LAWS,
    Cycloidal,
    Dwell,
    FormError,
    Kinematics,
    MotionProgram,
    Poly345,
    Poly4567,
    Return,
    Rise,
    cam_card,
    motion_from_table,
)
from camkit.panels import explore
from camkit.program import record, recorded
from camkit.quantities import value_of
from camkit.search.front import Front
from camkit.units import deg, mm

DATA = Path(__file__).parents[1] / "data"
PRINTED = json.loads((DATA / "motion_tables.json").read_text())["card"]
TURN = 2 * np.pi


def unequal(lift=10 * mm, rise=60 * deg, law=None):
    """3-4-5 up in 60 deg, 4-5-6-7 down in 75 deg, a dwell."""
    up, down = Rise(rise, lift, law or Poly345()), Return(75 * deg, lift, law or Poly4567())
    return MotionProgram((up, down, Dwell(TURN - 75 * deg - rise)))


def cubed(u):
    """``s = (1 - t^2)^3`` with ``t = 1 - u`` from the nose: the lobe of the table."""
    t = 1 - u
    w = 1 - t * t
    return Kinematics(w**3, 6 * t * w**2, 24 * t * t * w - 6 * w**2, 48 * t**3 - 72 * t * w)


def mirrored(u):
    s, v, a, j = cubed(1 - u)
    return Kinematics(1 - s, v, -a, j)


UP, DOWN = Rise(70 * deg, 8.5 * mm, cubed), Return(70 * deg, 8.5 * mm, mirrored)
LOBE = MotionProgram((UP, DOWN, Dwell(220 * deg)))
CAMS = {"cubed": LOBE, "unequal": unequal()}


@pytest.mark.parametrize(("name", "lift"), [(name, lift) for name in CAMS for lift in PRINTED[name]])
def test_the_printed_cards(name, lift):
    card, row = cam_card(CAMS[name], float(lift) * mm), PRINTED[name][lift]
    for key in ("opens", "closes", "duration", "centre"):
        assert getattr(card, key) / deg == pytest.approx(row[key], abs=3e-8)
    for key in ("area", "area_over"):
        assert getattr(card, key) / mm / deg == pytest.approx(row[key], rel=1e-9)
    assert card.crank.duration / deg == pytest.approx(row["driving"], abs=3e-8)


def test_whole_areas():
    assert cam_card(unequal(), 1 * mm).whole_area / mm / deg == pytest.approx(675, rel=1e-12)
    assert cam_card(LOBE, 1.27 * mm).whole_area / mm / deg == pytest.approx(8.5 * 140 * 16 / 35, rel=1e-12)


def test_a_table_says_the_same_to_its_rounding():
    """Rows to 0.001 mm: 95.914 cam deg, 191.83 crank deg, 544.0 mm deg."""
    card = cam_card(read_motion(DATA / "tables" / "lobe_european.csv"), 1.27 * mm)
    assert card.duration / deg == pytest.approx(95.9144, abs=0.01)
    assert card.crank.duration / deg == pytest.approx(191.83, abs=0.02)
    assert card.centre / deg == pytest.approx(0, abs=1e-3)
    assert card.whole_area / mm / deg == pytest.approx(544.0, rel=2e-4)


@pytest.mark.parametrize("law", [law for law in LAWS if law.continuity >= 1])
@pytest.mark.parametrize(("lash", "ratio"), [(0.0, 1.0), (0.2 * mm, 1.0), (0.3 * mm, 1.6)])
def test_by_brute_force(law, lash, ratio):
    """A million samples, nothing else; the trapezoidal rule is good to 1e-11 of the area."""
    motion, lift = unequal(law=law), 0.8 * mm
    x = np.linspace(-np.pi + 60 * deg, np.pi + 60 * deg, 1_000_001)
    s = motion(x).s
    valve = ratio * np.maximum(s - s.min() - lash, 0)
    on = x[valve > lift]
    card = cam_card(motion, lift, lash=lash, ratio=ratio)
    assert card.opens == pytest.approx(on[0] - 60 * deg, abs=1e-5)
    assert card.closes == pytest.approx(on[-1] - 60 * deg, abs=1e-5)
    assert card.peak == pytest.approx(valve.max(), rel=1e-9)
    assert card.whole_area == pytest.approx(np.trapezoid(valve, x), rel=1e-8)
    assert card.area_over == pytest.approx(np.trapezoid(np.maximum(valve - lift, 0), x), rel=1e-7)
    assert card.area == pytest.approx(card.area_over + lift * card.duration, rel=1e-12)


@pytest.mark.parametrize("level", [1e-9, 1e-6, 1e-3, 0.3, 1 - 1e-9])
def test_very_low_and_very_high_lifts(level):
    card = cam_card(unequal(), level * 10 * mm)
    for angle in (card.nose + card.opens, card.nose + card.closes):
        assert unequal()(angle).s == pytest.approx(level * 10 * mm, rel=1e-9)


def test_an_upper_dwell_has_its_nose_in_the_middle():
    law = Cycloidal()
    motion = MotionProgram(
        (Rise(60 * deg, 5 * mm, law), Dwell(30 * deg), Return(60 * deg, 5 * mm, law), Dwell(210 * deg))
    )
    card = cam_card(motion, 2.5 * mm)
    assert card.nose / deg == pytest.approx(75)
    assert (card.opens / deg, card.closes / deg) == pytest.approx((-45, 45))


def test_the_lobe_may_lie_anywhere_in_the_turn():
    """Over its end, begun on the upper dwell, and counted from another level."""
    plain = cam_card(unequal(), 1 * mm)
    parts = Return(75 * deg, 10 * mm, Poly4567()), Dwell(225 * deg), Rise(60 * deg, 10 * mm, Poly345())
    for motion in (MotionProgram(parts, start=13 * mm), MotionProgram(parts, start=-5 * mm)):
        card = cam_card(motion, 1 * mm)
        assert card.duration == pytest.approx(plain.duration, rel=1e-9)
        assert card.centre == pytest.approx(plain.centre, abs=1e-9)
        assert card.area == pytest.approx(plain.area, rel=1e-9)


def test_from_a_dead_centre():
    """Opening is before the one at 10 deg by 31.2 deg of the cam, twice that of the crank."""
    card = cam_card(unequal(), 1 * mm, zero=46 * deg)
    assert card.opens / deg == pytest.approx(60 - 45.201813 - 46, abs=1e-6)
    assert (card.closes - card.opens) / deg == pytest.approx(99.306659, abs=1e-6)
    assert card.crank.opens == pytest.approx(2 * card.opens)
    assert card.crank.area == pytest.approx(2 * card.area)
    around = cam_card(unequal(), 1 * mm, zero=46 * deg + TURN)
    assert around.opens == pytest.approx(card.opens)


def test_a_lobe_with_two_tops_is_open_from_the_first_to_the_last():
    law = Cycloidal()
    up, down = Rise(40 * deg, 5 * mm, law), Return(40 * deg, 5 * mm, law)
    low = MotionProgram((up, down, Rise(40 * deg, 8 * mm, law), Return(40 * deg, 8 * mm, law), Dwell(200 * deg)))
    card = cam_card(low, 1 * mm)
    one, two = (cam_card(MotionProgram((Rise(40 * deg, h, law), Return(40 * deg, h, law), Dwell(280 * deg))), 1 * mm)
                for h in (5 * mm, 8 * mm))  # fmt: skip
    assert card.duration == pytest.approx(80 * deg + (one.duration + two.duration) / 2, rel=1e-9)
    assert card.whole_area == pytest.approx(one.whole_area + two.whole_area, rel=1e-9)


@pytest.mark.parametrize("dip", [0.0, 0.1, 0.3, 1.0])
def test_between_two_lobes_the_follower_may_drop_below_the_lash_and_the_lift(dip):
    """Down to 0, 0.1 .. mm between them; the lash is 0.2 mm, the card one at 0.5 mm."""
    law, high, low = Cycloidal(), 8 * mm, (8 - dip) * mm
    up, down = Rise(40 * deg, high, law), Return(40 * deg, high, law)
    motion = MotionProgram((up, Return(40 * deg, low, law), Rise(40 * deg, low, law), down, Dwell(200 * deg)))
    card = cam_card(motion, 0.5 * mm, lash=0.2 * mm)
    x = np.linspace(0, 160 * deg, 1_000_001)
    s = np.maximum(motion(x).s - 0.2 * mm, 0)
    assert card.whole_area == pytest.approx(np.trapezoid(s, x), rel=1e-11)
    assert card.area_over == pytest.approx(np.trapezoid(np.maximum(s - 0.5 * mm, 0), x), rel=1e-11)
    inside = np.linspace(card.nose + card.opens, card.nose + card.closes, 1_000_001)
    assert card.area == pytest.approx(np.trapezoid(np.maximum(motion(inside).s - 0.2 * mm, 0), inside), rel=1e-11)


def test_a_motion_without_a_dwell():
    """An eccentric: ``s = 5 (1 - cos phi)``, lowest between two rows."""
    x = np.arange(0, 360, 4) * deg
    card = cam_card(motion_from_table(x, 5 * mm * (1 - np.cos(x + 1 * deg))), 5 * mm)
    assert card.duration / deg == pytest.approx(180, abs=1e-4)
    assert card.nose / deg == pytest.approx(179, abs=1e-3)
    assert card.whole_area / mm / deg == pytest.approx(1800, rel=1e-5)


def test_waves_of_a_profile_count():
    made = FormError(amplitude=0.02 * mm, waves=9).on(unequal())
    x = np.linspace(0, TURN, 400_001)
    s = made(x).s
    on = x[s - s.min() > 1 * mm]
    assert cam_card(made, 1 * mm).duration == pytest.approx(on[-1] - on[0], abs=4e-5)


# ---------------------------------------------------------------- populations


def test_a_population_equals_its_members():
    lifts, rises = np.array([[10.0], [4.0], [0.5], [np.nan]]) * mm, np.array([[60.0], [80.0], [50.0], [60.0]]) * deg
    together = cam_card(unequal(lifts, rises), 1 * mm, lash=0.1 * mm)
    for i in range(2):
        alone = cam_card(unequal(float(lifts[i, 0]), float(rises[i, 0])), 1 * mm, lash=0.1 * mm)
        for name, value in vars(alone).items():
            assert getattr(together, name)[i] == pytest.approx(value, rel=1e-10), name
    assert together.duration[2] == together.area[2] == 0
    assert np.isnan(together.opens[2])
    assert all(np.isnan(value[3]) for value in vars(together).values())


def test_columns_of_lifts():
    lifts = np.array([[0.1], [1.0], [5.0]]) * mm
    card = cam_card(unequal(), lifts)
    assert card.duration / deg == pytest.approx([PRINTED["unequal"][k]["duration"] for k in ("0.1", "1.0", "5.0")])


def test_a_card_can_be_recorded():
    def card(given):
        found = at_lift("duration", 1 * mm), at_lift("lobe area", 1 * mm), at_lift("lobe centre", 1 * mm)
        cam = TranslatingRollerCam(unequal(given["h"], given["beta"]))
        analysis = type("One", (), {"curves": {"cam": type("Curve", (), {"cam": cam})}})
        return {measure.name: measure(analysis) for measure in found}

    program = recorded(card, {"h": 8 * mm, "beta": 1.2})
    for h, beta in ((10 * mm, 60 * deg), (3 * mm, 100 * deg)):
        found, alone = program({"h": h, "beta": beta}), cam_card(unequal(h, beta), 1 * mm)
        assert [np.asarray(x).item() for x in found.values()] == pytest.approx(
            [alone.duration, alone.area, alone.centre], rel=1e-12
        )


# ---------------------------------------------------------------- measures


def test_measures_of_any_follower():
    for cam in (TranslatingRollerCam(unequal()), ConjugatePair(TranslatingRollerCam(unequal(), groove=False))):
        analysis = cam.analyse(73)
        assert at_lift("duration", 1 * mm).one(analysis) / deg == pytest.approx(99.306659, abs=1e-6)
        assert at_lift("lobe area over it", 1 * mm).one(analysis) / mm / deg == pytest.approx(566.839599, abs=1e-5)
        assert at_lift("opening", 1 * mm).one(analysis) / deg == pytest.approx(-45.201813, abs=1e-6)
    arm = OscillatingRollerCam(unequal(10 * deg))
    swing = at_lift("lobe area", 1 * deg, unit="deg")
    assert (swing.name, swing.unit) == ("lobe area at 1 deg lift", "deg^2")
    assert swing.one(arm.analyse()) / deg**2 == pytest.approx(666.146258, abs=1e-5)


def test_of_a_valve_cam_from_its_base_circle():
    """Ramps included: the cam is open while the lift is more than 1 mm above the base circle."""
    cam = ValveCam()
    x = np.linspace(0, TURN, 1_000_001)
    s = cam.motion(x).s
    open_at = s > -cam.ramp_height + 1 * mm
    measure = at_lift("duration", 1 * mm)
    assert measure.one(cam.analyse()) == pytest.approx(open_at.mean() * TURN, abs=1e-5)
    lashed = at_lift("duration", 1 * mm, 0.3 * mm, 1.4)
    assert lashed.name == "duration at 1 mm lift, lash 0.3 mm, rocker 1.4"
    above = s > -cam.ramp_height + (0.3 + 1 / 1.4) * mm
    assert lashed.one(cam.analyse()) == pytest.approx(above.mean() * TURN, abs=1e-5)


def test_an_instrument_shows_it_of_a_valve_cam():
    """Worked out in the page: the ramp's kinks move with its share."""
    measure = at_lift("duration", 1 * mm, 0.2 * mm)
    program = record(lambda cam: {"open": measure(cam.analyse(31))}, ValveCam())
    app = explore(ValveCam(), measures=(measure,))
    for half in (62 * deg, 70 * deg):
        cam = ValveCam(half_angle=half)
        found = program({path: value_of(cam, path) for path in program.inputs})["open"]
        assert np.asarray(found).item() == pytest.approx(measure.one(cam.analyse(31)), rel=1e-12)
    assert "duration at 1 mm lift, lash 0.2 mm" in app.summary()


def test_a_search_can_limit_the_duration_at_a_lift():
    """The gentlest rise that keeps the follower above 1 mm for 110 deg at least: just these."""
    cam = TranslatingRollerCam(unequal(), groove=False, base_radius=60 * mm)
    duration = at_lift("duration", 1 * mm)
    study = Study(
        cam, {"motion.rise.angle": (40 * deg, 90 * deg)}, (-duration,), at_most={peak_acceleration: 40 * mm}, angles=91
    )
    assert minimise(study, starts=1).design.motion.segments[0].angle / deg == pytest.approx(90, abs=1e-3)
    least = study.replace(minimise=(duration,), at_most={}, at_least={duration: 110 * deg})
    best = minimise(least, starts=2)
    assert duration.one(best.design.analyse()) / deg == pytest.approx(110, abs=1e-4)
    again = from_json(to_json(Front(least, least.x0[None], np.zeros((1, 1)))))
    assert again.study.at_least == least.at_least
    assert next(iter(again.study.at_least)).one(cam.analyse()) == duration.one(cam.analyse())


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: cam_card(unequal(), 0.0), "the lift of the card is 0"),
        (lambda: cam_card(unequal(), 11 * mm), "never passed on the way up and down; the largest is 0.01"),
        (lambda: cam_card(unequal(), 1 * mm, lash=-1e-4), "the lash is -0.0001"),
        (lambda: cam_card(unequal(), 1 * mm, ratio=0.0), "the ratio of the rocker is 0"),
        (lambda: cam_card(MotionProgram((Rise(1.0, 1.0, Cycloidal()),)), 0.5), "never passed on the way up and down"),
        (lambda: cam_card(MotionProgram((Rise(TURN, 1.0, Cycloidal()),), advance=1.0), 0.5), "comes back to its base"),
        (
            lambda: cam_card(unequal(np.array([[1.0], [2.0]])), np.full((3, 1), 0.5)),
            "2 in its motion and 3 in its lift",
        ),
        (
            lambda: at_lift("duration", 1 * mm, unit="kg"),
            "the unit of the follower is 'kg'; it must be one of a length",
        ),
        (lambda: at_lift("width", 1 * mm), "'width' is not on a cam card; there are opening, closing, duration"),
        (lambda: at_lift("duration", 0.0), "the lift of the card is 0"),
        (lambda: at_lift("duration", 1 * mm, -1.0), "the lash is -1"),
        (lambda: at_lift("duration", 1 * mm, unit="furlong"), "furlong"),
    ],
)
def test_refusals(ask, sentence):
    with pytest.raises(ValueError, match=sentence):
        ask()


def test_a_lash_above_the_lift_leaves_no_lift():
    with pytest.raises(ValueError, match=r"the largest is 0$"):
        cam_card(unequal(), 1 * mm, lash=12 * mm)


def test_a_design_without_a_lift_has_no_card():
    card = cam_card(unequal(), np.array([[1 * mm], [np.nan]]))
    assert np.isfinite(card.duration[0])
    assert np.isnan([card.duration[1], card.area[1], card.whole_area[1]]).all()


def test_the_nose_of_two_equal_lobes_is_on_one_of_them():
    up, down = Rise(40 * deg, 10 * mm, Cycloidal()), Return(40 * deg, 10 * mm, Cycloidal())
    card = cam_card(MotionProgram((up, down, Dwell(60 * deg), up, down, Dwell(140 * deg))), 1 * mm)
    assert card.nose / deg == pytest.approx(40, abs=1e-6)
