"""Views of the shaft, its joints and the trials: what is drawn against numbers, and that drawing again moves it."""

import numpy as np
import pytest
from matplotlib.path import Path

from camkit import GPa, deg, kW, mm, picture, rpm
from camkit.linkage.universal_joint import DoubleUniversalJoint
from camkit.machines.shaft import PLANE_WINDOW, UniversalJointShaft, lightest_shaft, shaft_study
from camkit.papers.optimiser_trials import measured_trials
from camkit.papers.problems import tension_spring
from camkit.papers.shaft import printed_designs
from camkit.render.artists import WARNING, _find, moving
from camkit.render.design_map import design_plane, level_curve, region_below
from camkit.render.picture import draw, layout
from camkit.render.shaft import SHAFT_VIEWS, diameters, on_the_plane
from camkit.search.competitive import CompetitiveAlgorithm
from camkit.search.evolution import StudyProblem
from camkit.study.design_map import DesignMap
from camkit.views.optimiser_trials import evaluations_needed, solved_within
from camkit.views.shaft import candidates, section, utilisation
from camkit.views.universal_joint import JOINT_VIEWS, drive, pins

OTHERS = (
    UniversalJointShaft(power=400 * kW),
    UniversalJointShaft(length=3.5, allowable_shear=40e6, allowable_twist=2 * deg),
    UniversalJointShaft(power=20 * kW, outer_diameter=260 * mm),
)


def drawn(shown, *views, **position):
    figure, axes = layout(views, dpi=50)
    draw(shown, axes, views, **position)
    return figure, axes


def data_of(ax):
    """Where everything stands that was drawn with a key."""
    place = {"Polygon": "get_xy", "Text": "get_position", "Line2D": "get_data"}
    return {a.get_gid(): np.array(getattr(a, place[type(a).__name__])()) for a in moving(ax)}


def xy(ax, key):
    return np.array(_find(ax, key).get_data(), dtype=float)


def redrawn_in_place(first, others, views, **position) -> None:
    figure, axes = drawn(first, *views, **position)
    artists = [set(moving(ax)) for ax in axes]
    for other in (*others, first):
        draw(other, axes, views, **position)
        assert [set(moving(ax)) for ax in axes] == artists
    figure.canvas.draw()
    _, fresh = drawn(first, *views, **position)
    for ax, new in zip(axes, fresh, strict=True):
        before, after = data_of(new), data_of(ax)
        assert before.keys() == after.keys()
        for key in before:
            np.testing.assert_array_equal(after[key], before[key], err_msg=key)


@pytest.mark.filterwarnings("error")
def test_the_shafts_views_move_what_they_drew() -> None:
    redrawn_in_place(UniversalJointShaft().analyse(), [s.analyse() for s in OTHERS], SHAFT_VIEWS)


@pytest.mark.filterwarnings("error")
def test_the_joints_views_move_what_they_drew() -> None:
    others = [
        DoubleUniversalJoint(phase=30 * deg, inertia=2.0).analyse(),
        DoubleUniversalJoint(first_angle=0.0).analyse(),
    ]
    redrawn_in_place(DoubleUniversalJoint().analyse(), others, JOINT_VIEWS, turn=40 * deg)


def test_the_twist_curve_is_the_closed_form() -> None:
    a = UniversalJointShaft().analyse()
    _, (ax,) = drawn(a, diameters)
    D, d = xy(ax, "limit 1")
    assert len(D) > 40
    np.testing.assert_allclose(D, a.shaft.stiff_diameter(d * mm) / mm, rtol=0, atol=0.01)


def test_every_limits_curve_is_where_it_is_just_kept() -> None:
    for a in (UniversalJointShaft().analyse(), *(s.analyse() for s in OTHERS[:2])):
        _, (ax,) = drawn(a, diameters)
        for i in range(4):
            x = xy(ax, f"limit {i}").T * mm
            x = x[np.isfinite(x).all(axis=1)]
            g = a.sizes.plane.study.evaluate(x).g[:, i] if len(x) else np.zeros(1)
            assert abs(g).max() < 0.02, a.sizes.plane.measures[i].name


@pytest.mark.parametrize("data", [{}, {"power": 330 * kW}, {"length": 3.3, "power": 150 * kW}])
def test_the_shaded_region_is_what_the_study_calls_feasible(data) -> None:
    study = shaft_study(UniversalJointShaft(**data))
    plane = DesignMap(study, PLANE_WINDOW)
    outline = Path(region_below(*plane.axes, plane.worst, 0.0).T)
    x = np.random.default_rng(4).uniform(*PLANE_WINDOW, (4000, 2))
    inside, feasible = outline.contains_points(x), study.evaluate(x).feasible
    assert feasible.any()
    assert (inside == feasible).mean() > 0.995


def test_level_curves_and_regions_of_a_known_field() -> None:
    axis = np.linspace(-2, 2, 161)
    z = np.hypot(*np.meshgrid(axis, axis))
    assert np.hypot(*level_curve(axis, axis, z, 1.5)) == pytest.approx(1.5, abs=1e-3)
    assert np.isnan(level_curve(axis, axis, z, 9.0)).all()
    x, y = region_below(axis, axis, z, 1.0)
    assert abs(np.sum(x * np.roll(y, 1) - y * np.roll(x, 1))) / 2 == pytest.approx(np.pi, rel=1e-3)
    two = region_below(
        axis, axis, np.minimum(np.hypot(axis - 1, axis[:, None]), np.hypot(axis + 1, axis[:, None])), 0.5
    )
    assert np.isnan(two[0]).sum() == 1


def test_the_contours_of_the_area_have_their_values() -> None:
    a = UniversalJointShaft().analyse()
    _, (ax,) = drawn(a, diameters)
    told = [t for t in ax.texts if (t.get_gid() or "").startswith("objective") and t.get_text()]
    assert len(told) > 4
    for label in told:
        D, d = label.get_position()
        assert np.pi * (D**2 - d**2) / 4 == pytest.approx(float(label.get_text()), rel=1e-3)


def test_the_marks_of_the_plane() -> None:
    a = UniversalJointShaft().analyse()
    _, (ax,) = drawn(a, diameters)
    best = lightest_shaft()
    corner = [[best.outer_diameter / mm], [best.inner_diameter / mm]]
    assert xy(ax, "best") == pytest.approx(np.array(corner), rel=1e-7)
    assert xy(ax, "closed form") == pytest.approx(np.array(corner), rel=1e-12)
    assert xy(ax, "this tube") == pytest.approx(np.array([[128.64], [101.78]]))
    assert _find(ax, "this tube").get_markerfacecolor() != WARNING
    assert xy(ax, "EN 10210-2").shape == (2, 75)
    told = {t.get_gid(): t.get_text() for t in ax.texts}
    assert told["limit 1 name"] == "twist 1 deg/m"
    assert told["kept"] == "kept all over: critical speed 1500 rpm"
    assert told["nothing"] == ""
    diameters(OTHERS[1].analyse(), ax)
    assert _find(ax, "this tube").get_markerfacecolor() == WARNING
    assert _find(ax, "nothing").get_text() == "nothing within the bounds\nkeeps every limit"
    assert np.isnan(xy(ax, "best")).all()


def test_the_names_of_limits_keep_apart() -> None:
    for shaft in (UniversalJointShaft(), OTHERS[0], UniversalJointShaft(length=3.3, power=150 * kW)):
        figure, (ax, *_) = drawn(shaft.analyse(), *SHAFT_VIEWS)
        figure.canvas.draw()
        names = [t for t in ax.texts if (t.get_gid() or "").endswith("name") and t.get_text()]
        boxes = [t.get_window_extent() for t in names]
        assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_the_bars_are_the_utilisations() -> None:
    a = UniversalJointShaft().analyse()
    shown = utilisation(a)
    for name, use in a.utilisation.items():
        assert shown[name].x[1] == pytest.approx(100 * use)
        assert shown[f"{name} value"].words == f"{100 * use:.1f} %"
    shown = utilisation(OTHERS[0].analyse())
    assert shown["twist"].x[1] == 125
    assert shown["twist"].role == "trouble"
    assert shown["critical speed"].role != "trouble"


def test_the_section_is_to_scale() -> None:
    a = UniversalJointShaft().analyse()
    shown = section(a)
    assert shown["outside"].radius == pytest.approx(128.64 / 2)
    assert shown["inside"].radius == pytest.approx(101.78 / 2)
    assert shown.axes.equal
    for series, tube in a.sizes.nearest(a.shaft).items():
        radius = np.hypot(shown[series].x, shown[series].y)
        assert np.nanmax(radius) == pytest.approx(tube.outer_diameter / mm / 2)
        assert np.nanmin(radius) == pytest.approx(tube.inner_diameter / mm / 2)
    assert shown["GB/T 17395"].label == "nearest GB/T 17395: 133 × 16 mm"
    assert section(OTHERS[2].analyse()).axes.xlim[1] > 130
    none = section(UniversalJointShaft(max_speed=5000 * rpm, length=5.0).analyse())["GB/T 17395"]
    assert none.label == "no GB/T 17395 tube keeps every limit"
    assert np.isnan([none.x, none.y]).all()


def test_named_tubes_on_a_part_of_the_plane() -> None:
    view = on_the_plane(printed_designs(), [[125 * mm, 95 * mm], [133 * mm, 105 * mm]])
    _, (ax,) = drawn(UniversalJointShaft().analyse(), view)
    assert ax.get_xlim() == pytest.approx((125, 133))
    assert xy(ax, "genetic algorithm").ravel().tolist() == pytest.approx([129, 101])


def test_a_plane_of_another_study() -> None:
    study = tension_spring.study.replace(free={"coil": (0.25, 1.3), "turns": (2.0, 15.0)})
    _, (ax,) = drawn(DesignMap(study), design_plane)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("coil D  []", "turns N  []")
    assert {t.get_text() for t in ax.texts} >= {"deflection", "surge"}


def test_the_pins_of_a_cross_stand_square_and_turn_as_computed() -> None:
    """Geometry alone: a cross is rigid, so both its pins are square to each other at every input angle."""
    a = DoubleUniversalJoint(first_angle=25 * deg, second_angle=15 * deg, phase=37 * deg).analyse(73)
    for i in range(73):
        pin = pins(a, i)
        assert pin["input"] @ pin["intermediate, first"] == pytest.approx(0, abs=1e-12)
        assert pin["intermediate, second"] @ pin["driven"] == pytest.approx(0, abs=1e-12)
        assert pin["intermediate, first"] @ pin["intermediate, second"] == pytest.approx(np.cos(37 * deg))


def test_the_drawing_turns_and_can_be_seen_from_elsewhere() -> None:
    a = DoubleUniversalJoint().analyse()
    shown = drive(a, turn=0.0, azimuth=-90 * deg, elevation=0.0)
    straight = np.diff(
        [shown["input 0 shaft"].x, shown["input 0 shaft"].y]
    )  # seen from the side, the input falls by its angle
    assert np.degrees(np.arctan2(straight[1], straight[0]))[0] % 180 == pytest.approx(160)
    turned = drive(a, turn=60 * deg, azimuth=-90 * deg, elevation=0.0)
    assert abs(turned["input 0 left pin"].y - shown["input 0 left pin"].y).max() > 0.2
    above = drive(a, turn=60 * deg, azimuth=-90 * deg, elevation=90 * deg)
    assert abs(above["input 0 shaft"].y).max() < 1e-12  # from above the shafts lie in one line


def test_curves_over_a_turn() -> None:
    a = DoubleUniversalJoint(phase=90 * deg).analyse()
    _, axes = drawn(a, *JOINT_VIEWS)
    speed = xy(axes[1], "driven")[1]
    assert (speed.min(), speed.max()) == pytest.approx((441.5, 566.2), abs=0.06)
    assert xy(axes[1], "input")[1] == pytest.approx(500)
    assert xy(axes[4], "driven")[1] == pytest.approx(a.output_couple)


def test_candidates_are_drawn_where_they_stood() -> None:
    algorithm = CompetitiveAlgorithm().setup(StudyProblem(shaft_study()), termination=("n_gen", 21), seed=1)
    algorithm.run()
    views = candidates(optimum=4776e-6), candidates("outer_diameter", 129 * mm), candidates("inner_diameter")
    shown = [view(algorithm) for view in views]
    x, f = algorithm.paths
    for k in range(4):
        assert shown[0][f"candidate {k}"].y == pytest.approx(f[:, k] / mm**2)
        assert shown[2][f"candidate {k}"].y == pytest.approx(x[:, k, 1] / mm)
    assert shown[1]["optimum"].y == pytest.approx([129, 129])
    assert [one.axes.ylabel for one in shown] == ["area of the tube  [mm^2]", "D  [mm]", "d  [mm]"]


def test_boxes_of_trials() -> None:
    some = measured_trials("tension spring")
    _, (ax,) = drawn(some, evaluations_needed)
    for i, one in enumerate(some):
        needed = one.to(0.01)
        assert sorted(xy(ax, f"runs {i} 0.01")[0]) == sorted(needed[np.isfinite(needed)])
        assert _find(ax, f"arrived {i} 0.01").get_text() == f"{np.isfinite(needed).sum()} of 30"
        half = xy(ax, f"median {i} 0.01")[0]
        assert half.tolist() == ([one.median(0.01)] * 2 if np.isfinite(one.median(0.01)) else [])


def test_the_share_of_runs_that_arrived() -> None:
    everything = [t for p in ("tension spring", "welded beam") for t in measured_trials(p)]
    _, (ax, one) = drawn(everything, solved_within(0.01), solved_within(0.01, "welded beam"))
    for method in ("SLSQP", "GA (pymoo)", "random search"):
        needed = np.concatenate([t.to(0.01) for t in everything if t.method == method])
        n, share = xy(ax, method)
        assert share[-1] == pytest.approx(100 * np.isfinite(needed).mean())
        for count in (60, 1500, 9000):
            assert share[np.searchsorted(n, count, side="right") - 1] == pytest.approx(100 * (needed <= count).mean())
    assert xy(one, "GA (pymoo)")[1, -1] == pytest.approx(100 * 5 / 30)


def test_a_picture_of_the_shaft_is_a_small_file() -> None:
    shaft = UniversalJointShaft(elastic_modulus=210 * GPa, max_speed=900 * rpm)
    assert 20_000 < len(picture(shaft, *SHAFT_VIEWS)._repr_png_()) < 90_000
