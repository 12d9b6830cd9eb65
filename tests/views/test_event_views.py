"""Views of the valve cam: what is drawn against numbers, that drawing again moves it, and the tables to download."""

import csv
import io

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose, assert_array_equal

from camkit import explore, nsga2, picture
from camkit.files import from_json, to_json
from camkit.files.profiles import table_csv
from camkit.files.workshop import tables
from camkit.geometry import rotated
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import VALVE_MEASURES, min_radius, valve_front_study
from camkit.machines.valve_train import FLAT, ROLLER, ValveLoad
from camkit.papers.sketches import flat_face_sketch
from camkit.papers.valve_cam import known_front
from camkit.render.positions import turn_range
from camkit.units import deg, mm, rpm
from camkit.views.defaults import default_views
from camkit.views.event import (
    acceleration,
    cam_and_follower,
    camshaft_torque,
    jerk,
    lift,
    radius_of_curvature,
    spring_and_inertia,
    stress_over_event,
    velocity,
)
from camkit.views.front import ShownFront, pareto
from redrawing import drawn, redrawn_in_place, xy

OTHERS = (
    ValveCam(n=20, m=20, follower=ROLLER, half_angle=70 * deg),
    ValveCam(n=3, m=2, base_radius=18 * mm),
    ValveCam(n=1.2, m=4, seating_velocity=0.0),
    ValveCam(load=ValveLoad(speed=4000 * rpm, spring_rate=0.0)),
)


VALVE_VIEWS = default_views(ValveCam().analyse())


@pytest.mark.filterwarnings("error")
def test_drawing_again_moves_what_was_drawn():
    """Everything but the follower, which may have a face or a roller."""
    redrawn_in_place(ValveCam(), OTHERS, VALVE_VIEWS, lambda a: not a.get_gid().startswith("follower"), turn=0.4)


@pytest.mark.parametrize("follower", [FLAT, ROLLER])
@pytest.mark.parametrize("turn", [-100, 0, 30, 62, 118, 200])
def test_the_follower_touches_the_turned_cam(follower, turn):
    cam = ValveCam(follower=follower)
    ax = drawn(cam, cam_and_follower, turn=turn * deg)
    profile, face, contact = (
        xy(ax, key) for key in ("base circle", "follower face" if follower == FLAT else "follower roller", "contact")
    )
    height = (cam.base_radius + cam.motion(np.array([turn * deg])).s[0]) / mm
    assert np.hypot(*(profile - contact)).min() < 0.2
    if follower == FLAT:
        assert_allclose(face[1], height, atol=0.08)
        assert face[0, 0] < contact[0, 0] < face[0, 1]
        assert_allclose(profile[1].max(), height, atol=0.08)  # the face lies on the cam and cuts nothing off
    else:
        centre = np.array([[0], [height + cam.roller_radius / mm]])
        assert_allclose(np.hypot(*(face - centre)), cam.roller_radius / mm, atol=0.08)
        assert_allclose(np.hypot(*(profile - centre)).min(), cam.roller_radius / mm, atol=0.08)


def test_the_nose_points_up_when_the_cam_has_turned_so_far():
    ax = drawn(ValveCam(), cam_and_follower, turn=62 * deg)
    x, y = xy(ax, "flanks")
    assert_allclose((np.nanmax(y), x[np.nanargmax(y)]), (34, 0), atol=1e-9)
    x, y = xy(ax, "base circle")
    assert_allclose(np.hypot(x, y).min(), (21 - ValveCam().ramp_height / mm))


def test_stretches_are_coloured_where_they_are():
    cam = ValveCam()
    whole = cam.analyse().whole
    ax = drawn(cam, cam_and_follower, turn=62 * deg)
    from_nose = abs(whole.cam_angle - cam.half_angle)
    assert_array_equal(np.isfinite(xy(ax, "flanks")[0]), from_nose <= cam.half_angle)
    assert_array_equal(np.isfinite(xy(ax, "ramps")[0]), from_nose <= cam.half_angle + cam.ramp_angle)
    assert not np.isfinite(xy(ax, "undercut")).any()
    sharp = ValveCam(n=3, m=2)
    assert_array_equal(
        np.isfinite(xy(drawn(sharp, cam_and_follower, turn=0.0), "undercut")[0]), sharp.analyse().whole.undercut
    )


def test_motion_is_drawn_over_the_event_in_its_units():
    cam = ValveCam()
    event = cam.analyse().event
    for view, key, values in (
        (lift, "lift", event.lift / mm),
        (velocity, "velocity", event.velocity * cam.load.speed),
        (acceleration, "acceleration", event.acceleration * cam.load.speed**2),
        (jerk, "jerk", event.jerk * cam.load.speed**3 / 1e6),
    ):
        x, y = xy(drawn(cam, view), key)
        assert_allclose(x, event.cam_angle / deg)
        assert_allclose(y, values)


def test_the_dot_on_the_lift_follows_the_cam():
    for turn in (-20, 0, 62, 140):
        ((x,), (y,)) = xy(drawn(ValveCam(), lift, turn=turn * deg), "here")
        assert_allclose(x, turn, atol=0.1)
        assert_allclose(y, ValveCam().motion(np.array([x * deg])).s[0] / mm, atol=1e-9)
    assert_array_equal(xy(drawn(ValveCam(), lift, turn=200 * deg), "here")[0], np.nan)  # on the base circle


def test_the_least_radius_is_marked_and_warned_of():
    limits = {min_radius: 4.5 * mm}
    for cam, kept in ((ValveCam(n=20, m=20), False), (ValveCam(n=20, m=20, base_radius=25 * mm), True)):
        view = radius_of_curvature(cam.analyse(), limits)
        shown, hidden = (view[key] for key in (("least", "least, missing") if kept else ("least, missing", "least")))
        assert_allclose((shown.x, shown.y), (12.571, 1.159 + cam.base_radius / mm - 21), atol=2e-3)
        assert_allclose(view["flat"].y.min(), shown.y, atol=0.02)
        assert shown.role == ("position" if kept else "trouble")
        assert np.isnan(hidden.y)
        assert_allclose(view["limit 0"].y, 4.5)
    assert "limit 0" not in radius_of_curvature(cam.analyse())


def test_the_rollers_radius_has_a_gap_where_the_cam_is_hollow():
    cam = ValveCam(n=20, m=20, follower=ROLLER)
    event = cam.analyse().event
    y = xy(drawn(cam, radius_of_curvature), "roller")[1]
    assert np.isnan(y).any()
    curvature = event.roller.curvature
    assert_array_equal(np.isnan(y), curvature <= 0)
    assert_allclose(y[curvature > 0], (1 / curvature - cam.roller_radius)[curvature > 0] / mm)


def test_a_jump_is_drawn_where_the_spring_is_too_weak():
    weak = ValveCam(load=ValveLoad(preload=60.0, spring_rate=8e3))
    event = weak.analyse().event
    ax = drawn(weak, spring_and_inertia)
    lost = np.isfinite(xy(ax, "inertia jump")[1])
    assert lost.any()
    assert_array_equal(lost, event.is_open & (event.resistance < 0))
    assert_array_equal(np.isfinite(xy(ax, "overspeed jump")[1]), event.is_open & (event.force_at(event.top_speed) < 0))
    held = drawn(ValveCam().with_spring(), spring_and_inertia)
    assert not np.isfinite(xy(held, "inertia jump")[1]).any()


def test_stress_is_drawn_where_the_valve_is_open_and_undercut_is_warned_of():
    cam = ValveCam(n=3, m=2)
    event = cam.analyse().event
    ax = drawn(cam, stress_over_event)
    y = xy(ax, "stress")[1]
    shown = event.is_open & ~event.undercut
    assert_array_equal(np.isfinite(y), shown)
    assert_allclose(y[shown], event.contact_stress[shown] / 1e6)
    assert_array_equal(np.isfinite(xy(ax, "undercut")[1]), event.undercut)


def test_the_torque_is_drawn_over_a_whole_turn():
    x, y = xy(drawn(ValveCam(), camshaft_torque), "torque")
    assert_allclose(np.ptp(x), 360)
    assert abs(np.trapezoid(y, x)) < 1e-9 * np.abs(y).max()


def test_the_fronts_known_points_are_on_it():
    front = nsga2(valve_front_study(), population=40, generations=40, seed=1)
    (ax,) = picture(ShownFront(front, known=known_front()), pareto, width=5, height=4).axes
    known, found = xy(ax, "known").T, xy(ax, "front").T
    assert len(known) == 5
    for point in known:
        assert (abs(found - point) / np.ptp(known, axis=0)).max(1).min() < 0.05
    assert [t.get_text() for t in ax.get_legend().get_texts()] == [
        "front",
        "start",
        "in the sliders",
        "winner",
        "known points",
    ]
    with pytest.raises(ValueError, match="known"):  # axes of words would be drawn
        ShownFront(front, known=known_front().astype(str))


def test_the_sketch_is_made_from_the_cam():
    cam = ValveCam(n=4, m=3, base_radius=34 * mm, half_angle=70 * deg)
    shown = flat_face_sketch(cam.analyse(), turn=40 * deg)
    whole = cam.analyse().whole
    i = int(np.argmin(abs(whole.cam_angle - 40 * deg)))
    contact, rho = whole.contact_point()[:, i] / mm, whole.profile_radius[i] / mm
    points = np.array([shown["fitting circle"].x, shown["fitting circle"].y])
    assert_allclose(np.hypot(*(points - [[contact[0]], [contact[1] - rho]])), rho)
    profile = rotated(whole.profile, float(whole.cam_angle[i])) / mm
    near = np.hypot(*(profile - contact[:, None])) < 1
    gap = np.hypot(*(profile[:, near] - [[contact[0]], [contact[1] - rho]])) - rho
    assert abs(gap).max() < 0.01  # the circle fits the cam where they touch


# --- the panel and its tables -----------------------------------------------------------------------------------------


def test_the_turn_of_the_page_covers_a_whole_turn():
    app = explore(ValveCam(), cam_and_follower, free=["half_angle"], turn=0.0)
    assert turn_range(app.analysis)[1:] == pytest.approx((-118 * deg, 242 * deg), abs=0.5 * deg)
    move(app, "half_angle", 70)
    assert turn_range(app.analysis)[1:] == pytest.approx((-110 * deg, 250 * deg), abs=0.5 * deg)


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_the_lift_table_as_csv():
    analysis = ValveCam().analyse()
    ((title, table),) = analysis.tables.items()
    assert title == "Lift table"
    read = rows(table_csv(table))
    assert len(read) == 360
    assert list(read[0]) == list(table)
    for heading, column in table.items():
        assert_allclose([float(row[heading]) for row in read], column, atol=5.1e-7)
    nose = next(row for row in read if float(row["cam angle [deg]"]) == 0)
    assert_allclose(float(nose["lift [mm]"]), 13 + analysis.cam.ramp_height / mm, atol=5.1e-7)
    assert_allclose(float(nose["profile radius [mm]"]), analysis.nose_radius / mm, atol=5.1e-7)


@pytest.mark.parametrize(("follower", "columns"), [(FLAT, 5), (ROLLER, 7)])
def test_the_profile_as_csv_is_the_whole_cam(follower, columns):
    cam = ValveCam(follower=follower)
    read = rows(tables.table(cam.analyse(181)).data.decode())
    assert len(read) == 181
    assert len(read[0]) == columns
    points = np.array([[float(row[f"profile {k} [mm]"]) for row in read] for k in "xy"])
    assert_allclose(points, cam.analyse(181).whole.profile / mm, atol=5.1e-7)
    assert_allclose(points[:, 0], points[:, -1], atol=1e-5)
    assert {row["stretch"] for row in read} == {
        "base circle", "opening ramp", "opening flank", "closing flank", "closing ramp",
    }  # fmt: skip


def test_a_design_comes_back_from_its_file():
    cam = ValveCam(n=6.37, follower=ROLLER, load=ValveLoad(speed=2000 * rpm))
    assert from_json(to_json(cam)) == cam
    assert len({(m.name, m.unit) for m in VALVE_MEASURES}) == len(VALVE_MEASURES)
