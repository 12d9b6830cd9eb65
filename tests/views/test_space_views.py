"""What the views draw, against the analysis and an independent projection; drawn again they move what they drew."""

from functools import partial

import numpy as np
import pytest
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from camkit.linkage.measures import room_in
from camkit.linkage.space import Box
from camkit.machines.cabin_door import HOUSING, CabinDoorLinkage, ninety_degree_study, rssr_study
from camkit.papers.sketch_in_space import linkage_sketch
from camkit.render.artists import moving
from camkit.render.positions import positions_of
from camkit.render.still import draw
from camkit.search.nsga2 import nsga2_steps
from camkit.units import deg, mm
from camkit.views.defaults import default_views
from camkit.views.progress import convergence
from camkit.views.space import linkage_in_space, output_angle, pressure_angles
from camkit.views.turntable import Turntable

EXAMPLE = CabinDoorLinkage()
SKEW = CabinDoorLinkage(90 * mm, 200 * mm, 110 * mm, 120 * mm, 80 * mm, 40 * mm, 70 * deg, -40 * deg, 20 * deg)
PRACTICAL = ninety_degree_study().design(np.array([120, 120, 120, 99, 99]) * mm)


def axes(count=1):
    return [Figure().add_subplot() for _ in range(count)]


def data(picture, key):
    mark = picture[key]
    return np.array(np.broadcast_arrays(np.atleast_1d(mark.x), np.atleast_1d(mark.y)))


def shown(design, view=linkage_in_space, **position):
    return view(design.analyse(), **position)


LINKAGE_VIEWS = default_views(CabinDoorLinkage().analyse(91))
CURVES = LINKAGE_VIEWS[1:]


@pytest.mark.parametrize("view", LINKAGE_VIEWS)
def test_a_view_drawn_again_moves_what_it_drew(view):
    moved, fresh = axes(2)
    draw(EXAMPLE.analyse(), [moved], [view], turn=1.0, azimuth=0.2, elevation=0.3)
    before = moving(moved)
    for ax in (moved, fresh):
        draw(SKEW.analyse(), [ax], [view], turn=-0.3, azimuth=-1.0, elevation=0.5)
    assert set(moving(moved)) == set(before)
    for was, new in zip(*(sorted(moving(ax), key=lambda a: a.get_gid()) for ax in (moved, fresh)), strict=True):
        assert was.get_gid() == new.get_gid()
        if hasattr(was, "get_data"):
            np.testing.assert_array_equal(was.get_data(), new.get_data())
            assert was.get_color() == new.get_color()
        elif hasattr(was, "get_xy"):
            np.testing.assert_array_equal(was.get_xy(), new.get_xy())
        else:
            assert (was.get_text(), was.get_position()) == (new.get_text(), new.get_position())
    assert moved.get_legend() is None or len(moved.get_legend().get_texts()) == len(fresh.get_legend().get_texts())


def test_only_the_view_in_space_asks_where_it_is_seen_from():
    assert positions_of(linkage_in_space) == positions_of(partial(linkage_in_space, inside=HOUSING))
    assert positions_of(linkage_in_space) == ("turn", "azimuth", "elevation")
    assert {positions_of(view) for view in CURVES} == {("turn",)}


# The turntable.


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 0), (-60, 25), (130, -40), (20, 90)])
def test_the_turntable_by_turning_the_scene(azimuth, elevation):
    """Turn the scene back by the azimuth, tip it towards the viewer on +x, and read off y and z."""
    points = np.random.default_rng(0).normal(size=(3, 7))
    table = Turntable(np.eye(3), np.array([0.1, -0.2, 0.3]), 1.0, 1.0, azimuth * deg, elevation * deg)
    turned = Rotation.from_euler("zy", [-azimuth, elevation], degrees=True)
    near, right, up = turned.apply(points.T - table.centre).T
    np.testing.assert_allclose(table.seen(points), [right, up, near], atol=1e-12)


def test_the_turntable_drops_points_straight_to_its_floor():
    up = np.array([0.0, 0.6, 0.8])
    table = Turntable(np.stack([[1, 0, 0], np.cross(up, [1, 0, 0]), up]), np.ones(3), 1.0, 2.0, 0.0, 0.0)
    points = np.random.default_rng(1).normal(size=(3, 5))
    fallen = table.dropped(points)
    np.testing.assert_allclose(up @ (fallen - 1), -2.0)
    np.testing.assert_allclose(np.cross(points - fallen, up, axis=0), 0, atol=1e-12)


def projected(design, turn, points, azimuth, elevation):
    """Points on the picture, mm, but for where its centre lies: the rocker's axis is tipped upright first."""
    upright = Rotation.from_euler("x", design.axis_angle)
    seen = (Rotation.from_euler("zy", [-azimuth, elevation]) * upright).apply(points.T).T / mm
    return seen[1:]


@pytest.mark.parametrize("design", [EXAMPLE, SKEW, PRACTICAL])
@pytest.mark.parametrize(("azimuth", "elevation"), [(-60, 25), (110, -35)])
def test_links_in_space_are_where_the_analysis_has_them(design, azimuth, elevation):
    turn = design.start_angle + 0.4
    ax = shown(design, turn=turn, azimuth=azimuth * deg, elevation=elevation * deg)
    here = design.linkage.analyse(turn, design.branch)
    chain = projected(design, turn, here.chain[..., 0], azimuth * deg, elevation * deg)
    drawn = np.hstack([data(ax, "crank"), data(ax, "coupler")[:, 1:], data(ax, "rocker")[:, :1]])
    np.testing.assert_allclose(np.diff(drawn), np.diff(chain), atol=1e-9)
    other = design.linkage.analyse(turn, -design.branch).chain[:, 1:, 0]
    faint = projected(design, turn, other, azimuth * deg, elevation * deg)
    np.testing.assert_allclose(np.diff(data(ax, "other branch")), np.diff(faint), atol=1e-9)
    numbers = f"crank {turn / deg:.1f}°   rocker {here.rocker_angle[0] / deg:.1f}°"
    assert ax["numbers"].words == numbers
    for name, angle in (("α₁", here.crank_pressure_angle), ("α₂", here.rocker_pressure_angle)):
        assert ax[name].words == f"{name} {angle[0] / deg:.0f}°"


def test_seen_from_above_circles_and_pressure_angles_are_true():
    """From straight above the rocker's circle is round, and its pressure angle, if flat, is seen as it is."""
    flat = CabinDoorLinkage(50 * mm, 130 * mm, 90 * mm, 0.0, 0.0, 120 * mm, 0.0, 40 * deg, 100 * deg)
    ax = shown(flat, turn=1.0, elevation=90 * deg)
    rocker = data(ax, "rocker circle")
    np.testing.assert_allclose(np.ptp(rocker, axis=1), 2 * 90, rtol=1e-3)
    here = flat.linkage.analyse(1.0)
    for name, angle in (("α₁", here.crank_pressure_angle), ("α₂", here.rocker_pressure_angle)):
        joint, tip = data(ax, f"{name} way")[:, :2].T
        ends = data(ax, f"{name} arc")[:, [0, -1]].T - joint
        cosine = ends[0] @ ends[1] / np.prod(np.linalg.norm(ends, axis=1))
        assert np.arccos(cosine) == pytest.approx(angle[0], abs=1e-6)
        assert np.linalg.det([ends[0], tip - joint]) == pytest.approx(0, abs=1e-6)


def test_nothing_jumps_while_the_crank_turns():
    a = PRACTICAL.analyse()
    windows = set()
    for turn in np.linspace(-1, 4, 7):
        ax = linkage_in_space(a, turn=turn)
        windows.add((*ax.axes.xlim, *ax.axes.ylim))
        x, y = np.hstack([data(ax, key) for key in ("crank", "coupler", "rocker", "other branch", "shadow")])
        assert ax.axes.xlim[0] < x.min() < x.max() < ax.axes.xlim[1]
        assert ax.axes.ylim[0] < y.min() < y.max() < ax.axes.ylim[1]
    assert len(windows) == 1


def test_where_the_crank_cannot_go_is_shown():
    ax = shown(PRACTICAL, turn=10.0)
    limits = PRACTICAL.linkage.limit_angles() / deg
    never = data(ax, "never")
    (possible,) = PRACTICAL.linkage.possible_crank_angles() / deg
    assert np.mod(possible, 360) == pytest.approx(np.sort(limits)[::-1])
    assert 360 * np.isfinite(never[0]).mean() == pytest.approx(360 - np.ptp(possible), abs=6)
    assert np.isfinite(data(ax, "limits")).sum(-1).tolist() == [2, 2]
    high = PRACTICAL.analyse().turn_range[1] / deg
    assert ax["numbers"].words.startswith(f"crank {high:.1f}°")
    assert ax["never"].role == "trouble"


def test_a_box_is_in_trouble_when_a_link_breaks_it():
    pipe = Box((-60 * mm, 90 * mm, 60 * mm), (-40 * mm, 110 * mm, 110 * mm), "the pipe")
    for design in (PRACTICAL, EXAMPLE, PRACTICAL):
        view = linkage_in_space(design.analyse(), inside=HOUSING)
        broken = bool(room_in(HOUSING)(design.analyse()) < 0)
        for key, seen in (("the housing", not broken), ("the housing, broken", broken)):
            assert np.isfinite(view[key].x).sum() == (24 if seen else 0)  # both ends of twelve edges
        assert view["the housing, broken"].role == "trouble"
        assert view["the housing"].label == "the housing"
    optimum = rssr_study().design(np.array([80, 141.914, 130, 136.787, 100.344]) * mm)
    assert np.isfinite(shown(optimum, partial(linkage_in_space, outside=pipe))["the pipe, broken"].x).any()


# The curves.


def test_output_angle_of_both_branches():
    ax = shown(EXAMPLE, output_angle, turn=60 * deg)
    a = EXAMPLE.analyse()
    np.testing.assert_allclose(data(ax, "swept"), [a.crank_angle / deg, a.rocker_angle / deg])
    np.testing.assert_allclose(data(ax, "now")[:, 0], [60, 195.880281], atol=1e-6)
    for key, branch in (("own", 1), ("other", -1)):
        x, y = data(ax, key)
        for angle in (-100, 0, 100, 200):
            i = np.argmin(abs(x - angle))
            expected = np.mod(EXAMPLE.linkage.analyse(x[i] * deg, branch).rocker_angle[0], 2 * np.pi)
            assert np.isnan(y[i]) or y[i] == pytest.approx(expected / deg)
    wall = data(ax, "never")
    hatched = wall[0, wall[1] > 0]
    assert [hatched.min(), hatched.max()] == pytest.approx([265.623052 - 360, 274.376948 - 360], abs=1e-3)
    assert ax["sweep"].x[:2] == pytest.approx([15, 105])


def test_a_dot_follows_the_crank_within_the_sweep():
    a = EXAMPLE.analyse(91)
    for turn, inside in ((40 * deg, True), (150 * deg, False), (105 * deg, True)):
        ax = pressure_angles(a, turn=turn)
        x, y = data(ax, "crank now")[:, 0]
        here = EXAMPLE.linkage.analyse(turn).crank_pressure_angle[0]
        assert (x, y) == pytest.approx((turn / deg, here / deg), abs=1e-3) if inside else np.isnan([x, y]).any()
    backwards = EXAMPLE.replace(start_angle=105 * deg, end_angle=15 * deg).analyse(91)
    ax = pressure_angles(backwards, turn=40 * deg)
    assert data(ax, "crank now")[1, 0] == pytest.approx(
        EXAMPLE.linkage.analyse(40 * deg).crank_pressure_angle[0] / deg, abs=1e-3
    )


@pytest.mark.parametrize(
    ("view", "curves"),
    [
        (1, {"crank": lambda a: a.crank_pressure_angle / deg, "rocker": lambda a: a.rocker_pressure_angle / deg}),
        (2, {"ratio": lambda a: a.ratio}),
        (3, {"acceleration": lambda a: a.acceleration_ratio}),
        (4, {"on the crank": lambda a: a.crank_torque, "resisting": lambda a: a.resisting_torque}),
        (5, {"coupler": lambda a: a.coupler_force, "hinge": lambda a: np.sqrt((a.rocker_bearing_force**2).sum(0))}),
    ],
)
def test_curves_show_the_analysis_with_units(view, curves):
    ax = shown(PRACTICAL, CURVES[view])
    a = PRACTICAL.analyse()
    for key, values in curves.items():
        np.testing.assert_allclose(data(ax, key), [a.crank_angle / deg, values(a)])
    assert ax.axes.xlabel == "crank angle  [deg]"
    assert ax.axes.ylabel.endswith("]")


# Other pictures.


def test_the_sketch_has_every_letter():
    ax = shown(
        CabinDoorLinkage(80 * mm, 180 * mm, 90 * mm, 130 * mm, 110 * mm, 120 * mm, 75 * deg, 45 * deg, 55 * deg),
        linkage_sketch,
        turn=50 * deg,
    )
    letters = {mark.words.strip("$") for mark in ax.marks if hasattr(mark, "words")}
    greek = {r"\varphi_1", r"\varphi_3", r"\alpha_1", r"\alpha_2"}
    assert letters == {"l_1", "l_2", "l_3", "s_0", "s_3", "h_0", "L", "v_B", "v_C", "B", "C", *greek}


def test_convergence_shows_best_and_mean():
    generations = list(nsga2_steps(rssr_study(), 10, 6, seed=1))
    shown = convergence(generations)
    f = [g.evaluation.f[np.isfinite(g.evaluation.f)] / deg for g in generations]
    np.testing.assert_allclose([shown["best"].x, shown["best"].y], [range(1, 7), [v.min() for v in f]])
    np.testing.assert_allclose(shown["mean"].y, [v.mean() for v in f])
    assert shown.axes.ylabel == "pressure angles off 30 deg  [deg]"
