"""Tolerances against distributions that are known: straight lines, Ishigami's function, the normal law."""

import re
import threading
from dataclasses import dataclass

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose, assert_array_equal
from scipy.stats import norm
from sheets import alert, do
from try_everything import try_everything

from camkit import DoorHandleCam, Measure, Study, deg, explore, mm, nsga2, picture
from camkit.machines import door_handle_paper_study, lift_curve_study
from camkit.panels.tolerances import MOVING, SETTLED, general_tolerances, tolerance_panel
from camkit.quantities import Design, Quantity, quantity
from camkit.render.artists import artist_of
from camkit.study.tolerances import AnalysisCurve, Indices, Tolerances, general_tolerance
from camkit.views import pressure_angle
from camkit.views.front import shown_objectives
from camkit.views.tolerances import band, cloud, deviation, sobol_bars


@dataclass(frozen=True)
class Block(Design):
    """Three lengths; it cannot be built where the first is above 4."""

    x: float = quantity("x", 0, -5, 5, "", "first", above=None)
    y: float = quantity("y", 0, -5, 5, "", "second", above=None)
    z: float = quantity("z", 0, -5, 5, "", "third", above=None)

    def analyse(self, n=5):
        return Place(*np.broadcast_arrays(np.where(np.asarray(self.x) <= 4, self.x, np.nan), self.y, self.z), n)


@dataclass(frozen=True)
class Place:
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    n: int

    @property
    def cam_angle(self):
        return np.linspace(0, 1, self.n)

    @property
    def slope(self):
        """A curve: x at angle 0, y at angle 1; between them a straight line."""
        return self.x * (1 - self.cam_angle) + self.y * self.cam_angle


def last(values):
    return np.asarray(values)[..., 0] if np.ndim(values) else values


A, B, C = 3.0, -2.0, 1.0
total = Measure("sum", "", lambda p: last(A * p.x + B * p.y + C * p.z))
product = Measure("product", "", lambda p: last(p.x * p.y))
ishigami = Measure("Ishigami", "", lambda p: last(np.sin(p.x) + 7 * np.sin(p.y) ** 2 + 0.1 * p.z**4 * np.sin(p.x)))
constant = Measure("constant", "", lambda p: last(0 * p.x + 4))
ONE = {"x": (-5.0, 5.0)}


def a_study(*measures, start=None, **limits):
    return Study(start or Block(), ONE, measures, **limits)


# ---------------------------------------------------------------- which tolerance matters


def test_a_straight_line_shares_its_variance_by_slope_and_width():
    """var = sum((slope * width)^2): the shares are known, whatever the law of the spread."""
    widths = {"x": 0.1, "y": 0.4, "z": 0.2}
    parts = np.square([A * 0.1, B * 0.4, C * 0.2])
    for spread in ("uniform", "normal"):
        indices = Tolerances(a_study(total), widths, spread, 4096).indices
        assert_allclose(indices.first[0], parts / parts.sum(), atol=0.004)
        assert_allclose(indices.total[0], parts / parts.sum(), atol=0.004)


def test_the_indices_of_ishigamis_function():
    """Ishigami and Homma 1990, a = 7, b = 0.1 over -pi to pi: closed form.

    With n draws the standard error of a first index is about sqrt(2 S_total / n), here 0.003: the tolerance is 3 of it.
    """
    a, b = 7, 0.1
    whole = a**2 / 8 + b * np.pi**4 / 5 + b**2 * np.pi**8 / 18 + 1 / 2
    alone = np.array([0.5 * (1 + b * np.pi**4 / 5) ** 2, a**2 / 8, 0]) / whole
    together = b**2 * np.pi**8 * (1 / 18 - 1 / 50) / whole
    found = Tolerances(a_study(ishigami), dict.fromkeys("xyz", np.pi), parts=2**17).indices
    assert_allclose(found.first[0], alone, atol=0.01)
    assert_allclose(found.total[0], alone + np.array([together, 0, together]), atol=0.01)


def test_what_two_tolerances_cause_together_is_in_the_total():
    """x * y around 0 is all interplay."""
    found = Tolerances(a_study(product, total), {"x": 0.3, "y": 0.2}, parts=4096).indices
    assert isinstance(found, Indices)
    assert found.first.shape == found.total.shape == (2, 2)
    assert_allclose(found.first[0], 0, atol=0.01)
    assert_allclose(found.total[0], 1, atol=0.02)


def test_a_single_tolerance_causes_everything():
    found = Tolerances(a_study(total, constant), {"x": 0.3}).indices
    assert_array_equal(found.first, [[1], [np.nan]])
    assert_array_equal(found.total, [[1], [np.nan]])


def test_what_does_not_vary_or_not_always_is_has_no_shares():
    widths = {"x": 0.5, "y": 0.5}
    found = Tolerances(a_study(constant, total), widths).indices
    assert np.isnan(found.first[0]).all()
    assert np.isfinite(found.first[1]).all()
    some = Tolerances(a_study(total, start=Block(x=4.0)), widths)
    assert np.isnan(some.indices.first).all()
    assert some.share == pytest.approx(0.5, abs=0.01)


# ---------------------------------------------------------------- the parts


def test_the_parts_are_spread_as_they_should_be():
    start = Block(x=1.0, y=-2.0)
    for spread, deviation_ in (("uniform", 0.3 / np.sqrt(3)), ("normal", 0.1)):
        made = Tolerances(a_study(total, start=start), {"x": 0.3, "y": 0.0, "z": 0.3}, spread, 4096)
        assert made.names == ("x", "z")
        assert made.x.shape == (4096, 2)
        assert_allclose(made.x.mean(0), [1, 0], atol=1e-3)
        assert_allclose(made.x.std(0), deviation_, rtol=0.01)
        assert abs(np.corrcoef(made.x.T)[0, 1]) < 0.01
        assert (abs(made.x - [1, 0]) <= 0.3).mean() == pytest.approx(1 if spread == "uniform" else 0.9973, abs=0.001)
        assert_allclose(made.of(total), A * made.x[:, 0] + B * -2 + C * made.x[:, 1])


def test_a_seed_gives_the_same_parts_again():
    study, widths = a_study(total), {"x": 0.3}
    assert_array_equal(Tolerances(study, widths).x, Tolerances(study, widths).x)
    assert not np.array_equal(Tolerances(study, widths, seed=2).x, Tolerances(study, widths).x)


def test_the_yield_of_a_normal_sum_is_the_normal_law():
    widths = {"x": 0.3, "y": 0.6, "z": 0.9}
    sigma = np.sqrt((A * 0.1) ** 2 + (B * 0.2) ** 2 + (C * 0.3) ** 2)
    for limit in (-0.5, 0.0, 0.4, 1.0):
        made = Tolerances(a_study(product, at_most={total: limit}), widths, "normal", 4096)
        assert made.share == pytest.approx(norm.cdf(limit / sigma), abs=0.003)
        assert made.missed == {total: pytest.approx(1 - made.share)}
        low, high = made.interval
        assert low < made.share < high
        assert high - low == pytest.approx(2 * 1.96 * np.sqrt(made.share * (1 - made.share) / 4096), rel=0.02)


def test_the_evaluation_is_the_studys_own():
    study = door_handle_paper_study(DoorHandleCam(lift_arm=45 * mm, lift_start_angle=0.46, relief_arm=79.5 * mm))
    made = Tolerances(study, {"relief_arm": 0.3 * mm, "lift_arm": 1 * mm, "lift_start_angle": 1 * deg}, parts=128)
    theirs = study.replace(free={n: study.free[n] for n in made.names}).evaluate(made.x)
    for name in ("x", "f", "g", "feasible"):
        assert_array_equal(getattr(made.evaluation, name), getattr(theirs, name))
    assert 0 < made.share < 1
    assert made.share == theirs.feasible.mean()


def test_parts_that_cannot_be_built_miss_the_limits_and_leave_the_bands_alone():
    made = Tolerances(a_study(total, start=Block(x=3.5)), {"x": 1.0, "y": 0.5}, parts=4096)
    assert made.share == pytest.approx(0.75, abs=0.002)
    built = made.x[:, 0] <= 4
    assert_array_equal(np.isfinite(made.of(total)), built)
    low, high = made.percentiles(total, (0, 100))
    assert A * 2.5 + B * 0.5 <= low < A * 2.5 + B * 0.4
    assert A * 4 - B * 0.4 < high <= A * 4 - B * 0.5
    edges = made.band(AnalysisCurve("slope", "", "slope"), (0, 100))
    assert_allclose(edges[:, 0], [2.5, 4], atol=0.002)


def test_bands_are_percentiles_of_the_curve_at_each_point():
    study = a_study(total)
    made = Tolerances(study, {"x": 0.4, "y": 0.2}, parts=4096)
    edges = made.band(AnalysisCurve("slope", "", "slope"), (2.5, 50, 97.5))
    assert edges.shape == (3, study.angles)
    assert_allclose(edges[:, 0], [-0.38, 0, 0.38], atol=0.002)  # x alone
    assert_allclose(edges[:, -1], [-0.19, 0, 0.19], atol=0.002)  # y alone
    assert_allclose(made.percentiles(total, 50), 0, atol=0.01)


def test_one_call_measures_all_parts():
    calls = []

    class Counting(Study):
        def values(self, x, paths=None):
            calls.append(len(x))
            return super().values(x, paths)

    made = Tolerances(
        Counting(Block(), ONE, (total, product), {product: 1.0}), {"x": 0.1, "y": 0.1, "z": 0.1}, parts=64
    )
    made.share, made.interval, made.missed, made.band(AnalysisCurve("slope", "", "slope"))
    assert calls == [64]
    assert made.indices.first.shape == (2, 3)
    assert calls == [64, 3 * 32]


# ---------------------------------------------------------------- general tolerances


@pytest.mark.parametrize(
    ("nominal", "permitted"),
    [(3, 0.1), (6, 0.1), (6.1, 0.2), (30, 0.2), (50, 0.3), (120, 0.3), (400, 0.5), (700, 0.8), (2000, 1.2), (9000, 2)],
)
def test_lengths_have_the_medium_deviations_of_iso_2768(nominal, permitted):
    """ISO 2768-1:1989, table 1, class m."""
    declared = Quantity("l", 50, 1, 10_000, "mm", "a length")
    assert general_tolerance(declared, nominal * mm) == pytest.approx(permitted * mm)


def test_angles_and_the_rest_have_a_general_tolerance_too():
    assert general_tolerance(Quantity("a", 30, 0, 90, "deg", "an angle"), 0.5) == pytest.approx(0.5 * deg)
    assert general_tolerance(Quantity("k", 30, 0, 90, "N/m", "a stiffness"), -30.0) == pytest.approx(0.3)
    assert list(general_tolerances(lift_curve_study())) == ["lift_arm", "lift_start_angle"]


# ---------------------------------------------------------------- refusals


@pytest.mark.parametrize(
    ("widths", "options", "sentence"),
    [
        ({"lift_arms": 1.0}, {}, "'lift_arms' is no quantity of DoorHandleCam; near it are lift_arm, "),
        ({"lift_arm": -1 * mm}, {},
         "the tolerance of the lift arm is -1 mm; it must be a finite number of at least 0"),
        ({"lift_arm": np.nan}, {},
         "the tolerance of the lift arm is nan mm; it must be a finite number of at least 0"),
        ({"lift_arm": "1 mm"}, {}, "the tolerance of the lift arm is '1 mm'; it must be a number of at least 0"),
        ({"lift_arm": 60 * mm}, {},
         "the lift arm of 50 mm less its tolerance of 60 mm is -10 mm; it must be a finite number above 0 mm"),
        ({"lift_arm": 0.0}, {}, "there is no tolerance above 0; one must be"),
        ({}, {}, "there is no tolerance above 0; one must be"),
        ({"lift_arm": 1 * mm}, {"spread": "even"}, "the spread is 'even'; there are uniform, normal"),
        ({"lift_arm": 1 * mm}, {"parts": 1000}, "the number of parts is 1000; it must be a power of 2"),
        ({"lift_arm": 1 * mm}, {"parts": 2}, "the number of parts is 2; it must be a whole number of at least 4"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused_in_a_sentence(widths, options, sentence):
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}"):
        Tolerances(lift_curve_study(), widths, **options)


def test_a_curve_that_is_not_there_is_refused():
    made = Tolerances(a_study(total), {"x": 0.1})
    with pytest.raises(ValueError, match="the analysis has no curve 'slop'"):
        made.band(AnalysisCurve("slop", "", "slope"))


@dataclass(frozen=True)
class Stroke:
    """A curve over the crank's angle, and one over none."""

    owner: object = None
    crank_angle: object = None


def test_a_curve_is_drawn_over_the_angle_that_is_there():
    """The cam's before the crank's; without either it is refused."""
    turned = np.linspace(0, 2, 5)
    name, angle = AnalysisCurve("crank_angle", "rad", "").angle(Stroke(crank_angle=turned))
    assert name == "crank angle"
    assert_array_equal(angle, turned)
    name, angle = AnalysisCurve("owner.slope", "", "").angle(Stroke(owner=Place(1.0, 2.0, 3.0, 5), crank_angle=turned))
    assert name == "cam angle"
    assert_array_equal(angle, np.linspace(0, 1, 5))
    sentence = "the curve 'owner.real' has no cam angle or crank angle over which it can be drawn"
    with pytest.raises(ValueError, match=sentence):
        AnalysisCurve("owner.real", "", "").angle(Stroke(owner=1.0))


# ---------------------------------------------------------------- pictures

LIFT = {"lift_arm": 1 * mm, "lift_start_angle": 1 * deg, "lift_centre_distance": 0.3 * mm}
CURVES = (
    AnalysisCurve("lift.pressure_angle", "deg", "pressure angle", (44 * deg,)),
    AnalysisCurve("lift.curvature", "1/mm", "curvature"),
)


@pytest.fixture(scope="module")
def study():
    return lift_curve_study().replace(at_most={m: 44 * deg for m in lift_curve_study().at_most})


def test_the_views_show_the_numbers(study):
    made, front = Tolerances(study, LIFT, parts=256), nsga2(study, 12, 4, 1)
    curve = CURVES[0]
    ax, bars, drawn, off = picture(made, cloud(front), sobol_bars, band(curve), deviation(curve)).axes
    kept = made.evaluation.feasible
    x, y = np.hstack([artist_of(ax, "kept").get_xydata().T, artist_of(ax, "missed").get_xydata().T])
    assert_allclose(np.sort(x), np.sort(made.evaluation.f[:, 0]))
    assert_allclose(np.sort(y), np.sort(-made.evaluation.f[:, 1] / mm))
    assert len(artist_of(ax, "missed").get_xydata()) == (~kept).sum() > 0
    assert_array_equal(artist_of(ax, "front").get_xydata().T, shown_objectives(front))
    assert ax.get_title(loc="left").startswith(f"{100 * made.share:.1f} % of parts keep all limits")

    shares = made.indices.first[0]
    ends = [artist_of(bars, f"{name} 0").get_xdata()[-1] for name in LIFT]
    assert_allclose(ends, 100 * np.cumsum(shares), atol=0.5)
    assert_allclose(artist_of(bars, "together 0").get_xdata()[-1:] if shares.sum() < 1 else 100, 100)

    low, _, _, high = made.band(curve) / deg
    outline = artist_of(drawn, "most").get_xy()
    assert_allclose([outline[:, 1].min(), outline[:, 1].max()], [low.min(), high.max()])
    nominal = made.nominal.lift.pressure_angle / deg
    assert_allclose(artist_of(off, "most").get_xy()[:361, 1], low - nominal, atol=1e-9)
    assert drawn.get_xlabel() == "cam angle  [deg]"
    assert artist_of(drawn, "limit 0").get_ydata() == pytest.approx([44, 44])
    assert artist_of(off, "limit 0") is None


def test_a_study_with_one_objective_shows_how_its_parts_are_distributed():
    made = Tolerances(a_study(total, at_most={total: 0.0}), {"x": 1.0}, parts=64)
    (ax,) = picture(made, cloud()).axes
    points = np.vstack([artist_of(ax, "kept").get_xydata(), artist_of(ax, "missed").get_xydata()])
    assert_allclose(np.diff(points[np.argsort(points[:, 0]), 1]), 100 / 64)
    assert_allclose(artist_of(ax, "drawn").get_xydata(), [[0, 50]])


def test_a_measure_that_does_not_vary_says_so():
    made = Tolerances(a_study(constant, total), {"x": 1.0}, parts=64)
    (ax,) = picture(made, sobol_bars).axes
    assert [artist_of(ax, f"still {i}").get_text() for i in range(2)] == ["does not vary", ""]
    assert np.isnan(artist_of(ax, "x 0").get_xdata()).all()


# ---------------------------------------------------------------- the panel


@pytest.fixture
def panel(study):
    app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm"])
    shown = tolerance_panel(app, study, LIFT, curves=CURVES)
    yield shown
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()
            thread.join()
    shown.close()
    app.close()


def drawn_parts(panel):
    """The first objective of every part that is drawn."""
    view = panel.picture.shown[0]
    return np.sort([*view["kept"].x, *view["missed"].x])


def test_a_moved_tolerance_counts_at_once_and_with_more_parts_when_all_is_quiet(panel):
    before = panel.picture.shown[0]["kept"].x
    do(panel, panel.knobs["lift_arm"], value=3 * mm)
    assert panel.tolerances.half_widths["lift_arm"] == pytest.approx(3 * mm)
    assert panel.tolerances.parts == MOVING
    assert_array_equal(drawn_parts(panel), np.sort(panel.tolerances.of(panel.study.minimise[0])))
    assert len(drawn_parts(panel)) == MOVING != len(before)
    panel.settle()
    assert panel.tolerances.parts == SETTLED
    expected = Tolerances(panel.study, LIFT | {"lift_arm": 3 * mm}, parts=SETTLED)
    assert panel.tolerances.share == expected.share
    assert len(drawn_parts(panel)) == SETTLED
    assert panel.summary().startswith(
        "lift arm ± 3 mm, lift start angle ± 1 deg, lift centre distance ± 0.3 mm: "
        f"{100 * expected.share:.1f} % of parts keep all limits"
    )
    panel.spread.value = "normal"
    assert panel.tolerances.spread == "normal"
    panel.reset()
    assert panel.tolerances.half_widths == pytest.approx(LIFT)


def test_the_panel_follows_the_design_in_the_sliders(panel):
    move(panel.explorer, "lift_arm", 52.0)
    panel.settle()
    assert panel.tolerances.study.start == panel.explorer.design
    assert panel.tolerances.x[:, 0].mean() == pytest.approx(52 * mm, rel=1e-3)


def test_the_table_holds_the_parts_measures(panel):
    made = panel.tolerances
    for measure in made.measures:
        low, high = made.percentiles(measure, (2.5, 97.5))
        cells = [measure.name, measure.text(float(measure(made.nominal))), measure.text(low), measure.text(high)]
        assert cells in [row[:4] for row in panel.numbers.rows]
    max_pressure_angle = next(iter(panel.study.at_most))
    (told,) = [row[4] for row in panel.numbers.rows if row[0] == max_pressure_angle.name]
    assert told == f"{100 * made.missed[max_pressure_angle]:.1f} %"


@pytest.mark.parametrize(
    ("typed", "sentence"),
    [
        (-1.0, "the tolerance of the lift arm is -1 mm; it must be a finite number of at least 0"),
        (60.0, "the lift arm of 50 mm less its tolerance of 60 mm is -10 mm; it must be a finite number above 0 mm"),
    ],
)
def test_what_cannot_be_made_is_said_in_place_of_the_picture(panel, typed, sentence):
    do(panel, panel.knobs["lift_arm"], value=typed * mm)
    assert f"This cannot be made: {sentence}." in panel.banner.text
    assert not panel.picture.visible
    panel.settle()
    assert sentence in panel.banner.text
    panel.reset()
    assert alert(panel) == ""
    assert panel.picture.visible


def test_a_tolerance_of_0_leaves_its_bar_out_and_comes_back(panel):
    do(panel, panel.knobs["lift_arm"], value=0.0)
    assert panel.tolerances.names == ("lift_start_angle", "lift_centre_distance")
    assert np.isnan(panel.picture.shown[1]["lift_arm 0"].x).all()
    do(panel, panel.knobs["lift_arm"], value=2 * mm)
    assert np.isfinite(panel.picture.shown[1]["lift_arm 0"].x).all()


def test_the_front_of_a_search_is_shown_when_it_changes(study):
    app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm"])

    class Finder:
        front = ()

        def on_front(self, act):
            self.act = act

    finder = Finder()
    shown = tolerance_panel(app, study, front=finder)
    assert list(shown.knobs) == ["lift_arm", "lift_start_angle"]
    finder.front = nsga2(study, 12, 4, 1)
    finder.act()
    shown.settle()
    front = shown.picture.shown[0]["front"]
    assert_array_equal([front.x, front.y], shown_objectives(finder.front))


def test_everything_can_be_tried_and_read_without_a_kernel(panel):
    assert try_everything(panel) == 4
    bundle, _ = panel._repr_mimebundle_()
    assert panel.tolerances.parts == SETTLED
    assert bundle["text/plain"] == panel.summary()
    assert len(bundle["image/png"]) < 150_000
