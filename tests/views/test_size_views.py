"""Views of the shaft, its joints and the trials: what is drawn against numbers, and that drawing again moves it."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.path import Path

from camkit import GPa, deg, kW, mm, picture, rpm
from camkit.linkage.universal_joint import DoubleUniversalJoint
from camkit.machines.shaft import PLANE_WINDOW, UniversalJointShaft, lightest_shaft, shaft_study
from camkit.papers.optimiser_trials import measured_trials
from camkit.papers.shaft import printed_designs
from camkit.papers.trial_pictures import evaluations_needed, solved_within
from camkit.render.artists import artist_of
from camkit.render.contours import level_curve, outlined, region
from camkit.render.still import draw
from camkit.search.competitive import CompetitiveAlgorithm
from camkit.search.evolution import StudyProblem
from camkit.study.design_map import DesignMap
from camkit.views.defaults import default_views
from camkit.views.design_map import design_plane, designs_on_plane
from camkit.views.picture import Text
from camkit.views.progress import candidates
from camkit.views.shafts import drive, pins
from camkit.views.sizes import plane_of_sizes, section, utilisation
from known_problems import tension_spring
from redrawing import as_drawn_anew, drawn, redrawn_in_place, xy

OTHERS = (
    UniversalJointShaft(power=400 * kW),
    UniversalJointShaft(length=3.5, allowable_shear=40e6, allowable_twist=2 * deg),
    UniversalJointShaft(power=20 * kW, outer_diameter=260 * mm),
)


@pytest.mark.filterwarnings("error")
def test_the_shafts_views_move_what_they_drew() -> None:
    """Names on curves come and go with the room for them."""
    first, views = UniversalJointShaft(), (plane_of_sizes, utilisation, section)
    assert default_views(first.analyse()) == views
    axes = drawn(first, *views)
    for other in (*OTHERS, first):
        draw(other.analyse(), axes, views)
        axes[0].figure.canvas.draw()
    as_drawn_anew(axes, first, views)


@pytest.mark.filterwarnings("error")
def test_the_joints_views_move_what_they_drew() -> None:
    others = [
        DoubleUniversalJoint(phase=30 * deg, inertia=2.0).analyse(),
        DoubleUniversalJoint(first_angle=0.0).analyse(),
    ]
    redrawn_in_place(DoubleUniversalJoint().analyse(), others, default_views(others[0]), turn=40 * deg)


def curve(view, key: str) -> np.ndarray:
    """The points of a contour's first level, ``(2, m)``."""
    mark = view[key]
    points = level_curve(mark.x, mark.y, mark.z, mark.levels[0])
    return points[:, np.isfinite(points).all(axis=0)]


def test_the_twist_curve_is_the_closed_form() -> None:
    a = UniversalJointShaft().analyse()
    D, d = curve(plane_of_sizes(a), "limit 1")
    assert len(D) > 40
    np.testing.assert_allclose(D, a.shaft.stiff_diameter(d * mm) / mm, rtol=0, atol=0.01)


def test_every_limits_curve_is_where_it_is_just_kept() -> None:
    for a in (UniversalJointShaft().analyse(), *(s.analyse() for s in OTHERS[:2])):
        view = plane_of_sizes(a)
        for i in range(4):
            x = curve(view, f"limit {i}").T * mm
            g = a.sizes.plane.study.evaluate(x).g[:, i] if len(x) else np.zeros(1)
            assert abs(g).max() < 0.02, a.sizes.plane.measures[i].name


@pytest.mark.parametrize("data", [{}, {"power": 330 * kW}, {"length": 3.3, "power": 150 * kW}])
def test_the_shaded_region_is_what_the_study_calls_feasible(data) -> None:
    study = shaft_study(UniversalJointShaft(**data))
    plane = DesignMap(study, PLANE_WINDOW)
    shaded = design_plane(plane)["allowed"]
    outline = Path(mm * region(shaded.x, shaded.y, shaded.z, shaded.low, shaded.high).T)
    x = np.random.default_rng(4).uniform(*PLANE_WINDOW, (4000, 2))
    inside, feasible = outline.contains_points(x), study.evaluate(x).feasible
    assert feasible.any()
    assert (inside == feasible).mean() > 0.995


def test_level_curves_and_regions_of_a_known_field() -> None:
    axis = np.linspace(-2, 2, 161)
    z = np.hypot(*np.meshgrid(axis, axis))
    assert np.hypot(*level_curve(axis, axis, z, 1.5)) == pytest.approx(1.5, abs=1e-3)
    assert np.isnan(level_curve(axis, axis, z, 9.0)).all()
    x, y = region(axis, axis, z, -np.inf, 1.0)
    assert abs(np.sum(x * np.roll(y, 1) - y * np.roll(x, 1))) / 2 == pytest.approx(np.pi, rel=1e-3)
    x, y = region(axis, axis, z, 1.0, 1.5)  # a ring; the inner outline goes the other way round
    x, y = np.nan_to_num(x), np.nan_to_num(y)
    assert abs(np.sum(x * np.roll(y, 1) - y * np.roll(x, 1))) / 2 == pytest.approx(1.25 * np.pi, rel=1e-3)
    apart = np.minimum(np.hypot(axis - 1, axis[:, None]), np.hypot(axis + 1, axis[:, None]))
    two = region(axis, axis, apart, -np.inf, 0.5)
    assert np.isnan(two[0]).sum() == 1


def named(view) -> dict[str, Text]:
    """The words of a view on axes of 700 x 500 pixels, with those that its contours get."""
    return {mark.key: mark for mark in outlined(view, np.array([700, 500])) if isinstance(mark, Text) and mark.words}


def test_the_contours_of_the_area_have_their_values() -> None:
    words = named(plane_of_sizes(UniversalJointShaft().analyse()))
    told = [text for key, text in words.items() if key.startswith("objective")]
    assert len(told) > 4
    for label in told:
        assert np.pi * (label.x**2 - label.y**2) / 4 == pytest.approx(float(label.words), rel=1e-3)


def test_the_marks_of_the_plane() -> None:
    view = plane_of_sizes(UniversalJointShaft().analyse())
    best = lightest_shaft()
    corner = [[best.outer_diameter / mm], [best.inner_diameter / mm]]
    for key, at, rel in (
        ("best", corner, 1e-7),
        ("closed form", corner, 1e-12),
        ("here", [[128.64], [101.78]], 1e-9),
    ):
        assert np.array([view[key].x, view[key].y]) == pytest.approx(np.array(at), rel=rel)
    assert np.isnan(view["here, missing"].x).all()
    assert len(view["EN 10210-2"].x) == 75
    assert named(view)["limit 1 name 0"].words == "twist 1 deg/m"
    assert [mark.label for mark in view.marks if "kept" in mark.label] == ["critical speed 1500 rpm: kept"]
    assert view["nothing"].words == ""
    view = plane_of_sizes(OTHERS[1].analyse())
    assert np.isnan(view["here"].x).all()
    assert np.isfinite(view["here, missing"].x).all()
    assert view["here, missing"].role == "trouble"
    assert view["nothing"].words == "nothing within the bounds\nkeeps every limit"
    assert np.isnan(view["best"].x).all()


def test_what_lies_beyond_the_bounds_is_veiled() -> None:
    veil = plane_of_sizes(UniversalJointShaft().analyse())["beyond"]
    points = np.transpose([veil.x, veil.y])
    outer, inner = (Path(part) for part in np.split(points[np.isfinite(points).all(1)], [5]))
    x = np.random.default_rng(3).uniform([104, 84], [150, 124], (500, 2))
    inside = ((x >= [108, 87]) & (x <= [140, 103])).all(1)
    assert outer.contains_points(x).all()
    assert (inner.contains_points(x) == inside).all()


def test_the_names_of_limits_keep_apart() -> None:
    for shaft in (UniversalJointShaft(), OTHERS[0], UniversalJointShaft(length=3.3, power=150 * kW)):
        ax, *_ = drawn(shaft, plane_of_sizes, utilisation, section)
        ax.figure.canvas.draw()
        boxes = [t.get_window_extent() for t in ax.texts if " name " in t.get_gid()]
        assert len(boxes) > 4
        assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_the_bars_are_the_utilisations() -> None:
    a = UniversalJointShaft().analyse()
    shown = utilisation(a)
    for name, use in a.utilisation.items():
        assert shown[name].x[1] == pytest.approx(100 * use)
        assert np.isnan(shown[f"{name}, missed"].x).all()
        assert shown[f"{name} value"].words == f"{100 * use:.1f} %"
    shown = utilisation(OTHERS[0].analyse())
    assert shown["twist, missed"].x[1] == 125
    assert shown["twist, missed"].role == "trouble"
    assert np.isnan(shown["twist"].x).all()
    assert np.isfinite(shown["critical speed"].x).all()


def test_the_section_is_to_scale() -> None:
    a = UniversalJointShaft().analyse()
    shown = section(a)
    for key, diameter in (("outside", 128.64), ("inside", 101.78)):
        assert np.hypot(shown[key].x, shown[key].y) == pytest.approx(diameter / 2)
    assert shown.axes.equal
    assert shown["sizes"].words == "D = 128.64 mm\nd = 101.78 mm\nwall 13.43 mm"
    for name, ring in list(a.rings.items())[1:]:
        radius = np.hypot(shown[name].x, shown[name].y)
        assert np.nanmax(radius) == pytest.approx(ring[0] / mm / 2)
        assert np.nanmin(radius) == pytest.approx(ring[1] / mm / 2)
    assert shown["nearest GB/T 17395"].label == "nearest GB/T 17395: 133 × 16 mm"
    assert section(OTHERS[2].analyse()).axes.xlim[1] > 130
    none = section(UniversalJointShaft(max_speed=5000 * rpm, length=5.0).analyse())["nearest GB/T 17395"]
    assert none.label == "nearest GB/T 17395: none"
    assert np.isnan([none.x, none.y]).all()


def test_named_tubes_on_a_part_of_the_plane() -> None:
    found = UniversalJointShaft().analyse().sizes
    part = replace(found.plane, window=[[125 * mm, 95 * mm], [133 * mm, 105 * mm]])
    shown = designs_on_plane(printed_designs(), found.limit_names)(part)
    assert shown.axes.xlim == pytest.approx((125, 133))
    assert (shown["genetic algorithm"].x, shown["genetic algorithm"].y) == pytest.approx((129, 101))


def test_a_plane_of_another_study() -> None:
    study = tension_spring.study.replace(free={"coil": (0.25, 1.3), "turns": (2.0, 15.0)})
    shown = design_plane(DesignMap(study))
    assert (shown.axes.xlabel, shown.axes.ylabel) == ("coil  D", "turns  N")
    assert {t.words for t in named(shown).values()} >= {"deflection", "surge"}


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
    axes = drawn(a, *default_views(a))
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
    ax = drawn(some, evaluations_needed)
    for i, one in enumerate(some):
        needed = one.to(0.01)
        assert sorted(xy(ax, f"runs {i} 0.01")[0]) == sorted(needed[np.isfinite(needed)])
        assert artist_of(ax, f"arrived {i} 0.01").get_text() == f"{np.isfinite(needed).sum()} of 30"
        half = xy(ax, f"median {i} 0.01")[0]
        assert half.tolist() == ([one.median(0.01)] * 2 if np.isfinite(one.median(0.01)) else [])


def test_the_share_of_runs_that_arrived() -> None:
    everything = [t for p in ("tension spring", "welded beam") for t in measured_trials(p)]
    ax, one = drawn(everything, solved_within(0.01), solved_within(0.01, "welded beam"))
    for method in ("SLSQP", "GA (pymoo)", "random search"):
        needed = np.concatenate([t.to(0.01) for t in everything if t.method == method])
        n, share = xy(ax, method)
        assert share[-1] == pytest.approx(100 * np.isfinite(needed).mean())
        for count in (60, 1500, 9000):
            assert share[np.searchsorted(n, count, side="right") - 1] == pytest.approx(100 * (needed <= count).mean())
    assert xy(one, "GA (pymoo)")[1, -1] == pytest.approx(100 * 5 / 30)


def test_a_picture_of_the_shaft_is_a_small_file() -> None:
    shaft = UniversalJointShaft(elastic_modulus=210 * GPa, max_speed=900 * rpm)
    assert 20_000 < len(picture(shaft)._repr_png_()) < 90_000
