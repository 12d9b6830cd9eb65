"""Views of the high-speed cam and of the cam with lever: what is drawn against numbers, and that it moves."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import picture
from camkit.machines.cam_lever import CamLever, cam_lever_study, lever_stress, lever_wear
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_load import ConstantTorque
from camkit.machines.high_speed_measures import peak_pressure, peak_stress, peak_wear
from camkit.motion import ShapedLaw
from camkit.papers.sketches import two_radii_sketch
from camkit.render.artists import artist_of
from camkit.render.roles import colour
from camkit.render.still import draw
from camkit.search.minimise import minimise
from camkit.units import MPa, cm, deg, mm
from camkit.views import default_views, mechanism
from camkit.views.intervals import (
    contact_stress,
    hertz_pressure,
    load_over_way,
    stress_over_way,
    wear,
    wear_over_way,
)
from camkit.views.progress import min_over_bound
from redrawing import drawn, redrawn_in_place, xy

FIRST, PRESS = HighSpeedCam(), CamLever()
UNDERCUT = HighSpeedCam(roller_radius=115 * mm)
JUMPING = HighSpeedCam(spring_factor=1.0)
PASSING = HighSpeedCam(rise_law=ShapedLaw(c=(-0.4, 0.0, 0.0, 0.0)))
UNEVEN = HighSpeedCam(
    rise_angle=70 * deg,
    return_angle=130 * deg,
    rise_law=ShapedLaw(c=(0.0, 0.1, 0.0, 0.0)),
    return_law=ShapedLaw(c=(-0.2, 0.0, 0.0, 0.0)),
    load=ConstantTorque(),
)
TABLE = ((0.0, 30.0), (12 * mm, 60.0), (18 * mm, 420.0))
OTHER_PRESS = PRESS.replace(lever=210 * mm, arm_length=300 * mm, force_curve=TABLE)


def told(ax, way):
    """What is said of the peak of an interval."""
    (said,) = [text.get_text() for text in ax.texts if text.get_gid().startswith(f"{way} ") and text.get_text()]
    return said


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("first", "others", "views"),
    [
        (FIRST, (UNDERCUT, JUMPING, PASSING, UNEVEN), default_views(FIRST.analyse())),
        (
            PRESS,
            (PRESS.replace(lever=210 * mm, arm_length=300 * mm, force_curve=TABLE),),
            default_views(PRESS.analyse()),
        ),
    ],
    ids=["cam", "lever"],
)
def test_drawing_again_moves_what_was_drawn(first, others, views):
    redrawn_in_place(first, others, views, turn=0.4)


# --- over the turn ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cam", [FIRST, UNEVEN], ids=["first", "uneven"])
@pytest.mark.parametrize(
    ("view", "measure", "name", "factor"),
    [
        (contact_stress, peak_stress, "stress_coefficient", 1),
        (wear, peak_wear, "wear_coefficient", 1),
        (hertz_pressure, peak_pressure, "contact_pressure", MPa),
    ],
)
def test_curves_over_the_turn_and_their_peaks(cam, view, measure, name, factor):
    analysis, ax = cam.analyse(), drawn(cam, view)
    x, y = xy(ax, "dwell")
    assert_allclose(x, analysis.cam_angle / deg)
    assert_allclose(y, getattr(analysis, name) / factor, rtol=1e-12)
    heights = []
    fine = cam.analyse(40_001).intervals
    for way, interval, dense in zip(("away", "back"), analysis.intervals, fine, strict=True):
        x, y = xy(ax, way)
        assert_allclose(x, interval.cam_angle / deg)
        assert_allclose(y, getattr(interval, name) / factor, rtol=1e-12)
        ((angle,), (top,)) = xy(ax, f"{way} peak")
        values = getattr(dense, name) / factor
        assert top == pytest.approx(values.max(), rel=1e-6)
        assert angle == pytest.approx(dense.cam_angle[values.argmax()] / deg, abs=4e-3)
        assert told(ax, way) == f"{way} {top:.4g}\nat {angle:.1f}°"
        assert artist_of(ax, f"{way} value").get_color() == colour("ink")
        heights.append(top)
    unit = {"N^0.5 mm^-0.5": mm**-0.5, "N^1.5 mm^-0.5": mm**-0.5, "MPa": MPa}[measure.unit]
    assert max(heights) == pytest.approx(measure(analysis) / unit, rel=1e-6)
    assert not np.isfinite(xy(ax, "none")[1]).any()


def test_the_printed_peaks_of_the_first_design():
    axes = drawn(FIRST, contact_stress, wear)
    said = [told(ax, way).split("\n")[0] for ax in axes for way in ("away", "back")]
    assert said == ["away 2.478", "back 2.457", "away 345.3", "back 410"]


@pytest.mark.parametrize(
    ("cam", "way", "said"),
    [
        (UNDERCUT, "back", "back undercut\n"),
        (JUMPING, "away", "away loses\ncontact"),
        (PASSING, "away", "away arm passes\nits start"),
        (PASSING, "back", "back arm passes\nits start"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_where_there_is_no_stress_it_is_said_and_warned_of(cam, way, said):
    analysis, ax = cam.analyse(), drawn(cam, contact_stress)
    missing = np.isfinite(xy(ax, "none")[1])
    assert missing.any()
    assert_array_equal(missing, ~np.isfinite(analysis.stress_coefficient))
    assert told(ax, way) == said
    assert artist_of(ax, f"{way}{said.removeprefix(way)}").get_color() == colour("trouble")


def test_axes_without_a_curve_still_have_a_height():
    for view in (contact_stress, wear, hertz_pressure):
        ax = drawn(PASSING, view)
        ax.figure.canvas.draw()
        assert np.isfinite(ax.get_ylim()).all()
        assert ax.get_ylim()[1] > 1


def test_the_highest_peak_stays_below_its_words():
    for cam in (FIRST, UNDERCUT, UNEVEN):
        ax = drawn(cam, contact_stress)
        ax.figure.canvas.draw()
        lowest = min(text.get_window_extent().y0 for text in ax.texts if text.get_text())
        top = np.nanmax(xy(ax, "dwell")[1])
        assert ax.transData.transform((0, top))[1] < lowest


@pytest.mark.parametrize("turn", [0, 40, 90, 200, 300])
def test_the_roller_touches_the_turned_cam(turn):
    ax = drawn(FIRST, mechanism, turn=turn * deg)
    profile, roller, (arm_x, arm_y) = xy(ax, "profile"), xy(ax, "arm roller"), xy(ax, "arm arm")
    centre = np.array([[arm_x[1]], [arm_y[1]]])
    assert_allclose(np.hypot(*(roller - centre)), 30)
    assert np.hypot(*(profile - centre)).min() == pytest.approx(30, abs=0.02)
    assert np.hypot(arm_x[0] - arm_x[1], arm_y[0] - arm_y[1]) == pytest.approx(165)


# --- the lever --------------------------------------------------------------------------------------------------------


def press_at(turn, press=PRESS):
    ax = drawn(press, mechanism, turn=turn * deg)
    keys = {"roller": "arm roller", "arm": "arm arm", "lever": "lever arm", "slider": "slider block"}
    return {key: xy(ax, keys.get(key, key)) for key in ("profile", "pitch", "guide", *keys)}


@pytest.mark.parametrize("turn", [0, 30, 61, 200, 300])
def test_cam_lever_and_slider_to_scale(turn):
    shown = press_at(turn)
    pivot, centre = shown["arm"].T
    assert_allclose(pivot, (525 - 250, -180))  # the paper's sizes: pivot beside and below the cam axis
    assert np.hypot(*(centre - pivot)) == pytest.approx(313)
    assert np.hypot(*(shown["lever"][:, 1] - pivot)) == pytest.approx(250)
    assert_allclose(np.hypot(*(shown["roller"] - centre[:, None])), 45)
    assert np.hypot(*(shown["profile"] - centre[:, None])).min() == pytest.approx(45, abs=0.02)
    assert np.hypot(*shown["profile"]).max() == pytest.approx(94)


def test_the_slider_rises_by_its_stroke_and_arm_and_lever_are_one_piece():
    low, high = press_at(0), press_at(100)
    assert high["lever"][1, 1] - low["lever"][1, 1] == pytest.approx(18)
    assert low["lever"][1, 1] + high["lever"][1, 1] == pytest.approx(-360)  # level at half stroke

    def bend(shown):
        arm, lever = (np.diff(shown[key], axis=1)[:, 0] for key in ("arm", "lever"))
        return np.arctan2(arm[0] * lever[1] - arm[1] * lever[0], arm @ lever)

    for turn in (20, 45, 100, 210):
        assert bend(press_at(turn)) == pytest.approx(bend(low), abs=1e-9)


def test_stress_over_the_lift_in_the_papers_unit():
    analysis = PRESS.analyse()
    for view, measure, power in (
        (stress_over_way, lever_stress, "⁰·⁵"),
        (wear_over_way, lever_wear, "¹·⁵"),
    ):
        ax = drawn(PRESS, view)
        tops = [xy(ax, f"{way} peak") for way in ("away", "back")]
        assert max(top[1, 0] for top in tops) == pytest.approx(measure(analysis) * cm**0.5, rel=1e-6)
        assert f"[N{power} cm⁻⁰·⁵]" in ax.get_ylabel()
        x, _ = xy(ax, "away")
        assert_allclose(x, analysis.way[: len(x)] / mm, atol=1e-6)
        assert_allclose(x[[0, -1]], (0, 18), atol=1e-6)


def test_a_load_curve_of_ones_own_is_drawn_and_the_stand_in_is_named():
    ax = drawn(PRESS, load_over_way)
    assert ax.get_title(loc="left") == "Load (stand-in)"
    assert_allclose(xy(ax, "load")[1], 147 + 123)
    own = PRESS.replace(slider_force=0.0, force_curve=TABLE)
    draw(own.analyse(), [ax], [load_over_way])
    assert ax.get_title(loc="left") == "Load"
    x, y = xy(ax, "load")
    assert_allclose(y, 147 + np.interp(x, (0, 12, 18), (30, 60, 420)), rtol=1e-9)
    formula = own.replace(force_curve=lambda s: 1e5 * s)
    draw(formula.analyse(), [ax], [load_over_way])
    x, y = xy(ax, "load")
    assert_allclose(y, 147 + 100 * x)


def test_the_sweep_shows_every_radius_with_its_least_stress():
    found = [minimise(cam_lever_study(max_radius=k * mm, free_laws=False)) for k in (94, 110)]
    (ax,) = picture(found, min_over_bound("max_radius"), width=5, height=4).axes
    x, y = xy(ax, "least")
    assert_allclose(x, (94, 110))
    assert_allclose(y, [best.f * cm**0.5 for best in found])
    assert y[1] < y[0]
    assert [t.get_text().strip() for t in ax.texts] == [f"{value:.2f}" for value in y]


def test_the_sketch_is_made_from_the_cam():
    shown = two_radii_sketch(FIRST.analyse(), turn=40 * deg)
    said = {mark.words for mark in shown.marks if hasattr(mark, "words")}
    assert {"$l$", "$L$", "$r$", "$t$", r"$\theta$", "$N$", "$r_{k1}$", "$r_{k2}$", "O", "A"} <= said
    radii = {round(float(shown[f"{key} circle"].radius), 3) for key in ("least", "largest")}
    assert radii == {44.614, 130}
