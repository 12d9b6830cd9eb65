"""The decision panel and its views against the package's own winners, weights and numbers."""

import math
import re
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest
from matplotlib.path import Path
from numpy.testing import assert_allclose
from sheets import alert, do, downloaded, press, upload
from try_everything import try_everything

from camkit import DoorHandleCam, Judgements, Measure, Study, ahp, ahp_panel, door_handle_study, explore, pareto_panel
from camkit.decision import CHOOSERS, WEIGHING, achievement, judgement_ranges, topsis, weighted_sum, winner_map
from camkit.files import Session, from_json, to_json
from camkit.panels.choose import choose_panel
from camkit.quantities import Design, quantity
from camkit.render.artists import moving
from camkit.render.still import draw, layout
from camkit.search.front import Front, front_of
from camkit.units import mm
from camkit.views.decision import APART, MARKS, decision, front_winners, judgement_bars, triangle, winners_by_weight
from camkit.views.parallel import Column, Designs, parallel_coordinates
from camkit.views.picture import Axes, Picture, Polygon


@dataclass(frozen=True)
class Plate(Design):
    """A plate of two lengths."""

    width: float = quantity("b", 30, 10, 60, "mm", "its width")
    height: float = quantity("h", 30, 10, 60, "mm", "its height")

    def analyse(self, n=1):
        return self


def flat(x):
    return np.sum(x, axis=-1) if np.ndim(x) else x


area = Measure("area", "mm^2", lambda p: flat(p.width * p.height))
slim = Measure("width", "mm", lambda p: flat(p.width))
tall = Measure("height", "mm", lambda p: flat(p.height))
round_ = Measure("edge", "mm", lambda p: flat(2 * (p.width + p.height)))
slope = Measure("slope", "", lambda p: flat(p.height / p.width))
GOALS = ((slim,), (slim, -area), (slim, -area, slope), (slim, -area, slope, -tall))


def a_front(k, n=9):
    study = Study(Plate(), ("width", "height"), GOALS[k - 1], at_most={round_: 200 * mm})
    grid = np.stack(np.meshgrid(*[np.linspace(*b, n) for b in study.bounds.T]), -1).reshape(-1, 2)
    return front_of(study.evaluate(grid), study)


UPPERS = {1: None, 2: [2], 3: [2, 3, None], 4: [2, 3, 4, 2, 2, 1]}


def xy(shown, key):
    return np.array([shown[key].x, shown[key].y], dtype=float)


# --- the views --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_a_decision_is_what_the_package_says(k):
    front = a_front(k)
    shown = decision(front, UPPERS[k] and ahp(UPPERS[k]))
    weights = np.ones(1) if k == 1 else ahp(UPPERS[k]).weights
    assert_allclose(shown.weights, weights)
    assert shown.winners == {rule: CHOOSERS[rule](front, weights) for rule in MARKS}
    assert set(shown.index) == set(shown.winners.values())
    assert sorted(shown.index.values()) == list(range(1, 1 + len(shown.index)))
    for rule in WEIGHING:
        assert shown.ranges[rule] == (() if k == 1 else judgement_ranges(front, UPPERS[k], CHOOSERS[rule]))
        assert (shown.maps[rule].winners == winner_map(front, CHOOSERS[rule]).winners).all()
    names = [*(m.name for m in front.study.minimise), "width", "height", "edge"]
    assert [column.name for column in shown.designs.columns] == names
    values = shown.designs.values
    assert_allclose(values[:, k : k + 2], front.x / mm)
    assert_allclose(values[:, k + 2], 2 * front.x.sum(1) / mm)
    assert_allclose(values[:, 0], front.f[:, 0] / mm)
    if k > 1:
        assert_allclose(values[:, 1], -front.f[:, 1] / mm**2)


@pytest.mark.parametrize("k", [1, 2, 3, 4])
@pytest.mark.parametrize("view", [front_winners, winners_by_weight, judgement_bars])
@pytest.mark.filterwarnings("error")
def test_every_view_of_one_to_four_objectives_is_drawn_and_moved(k, view):
    shown = decision(a_front(k), UPPERS[k] and ahp(UPPERS[k]))
    _, (ax,) = layout((view,), width=6, height=5)
    for each in (shown, shown.judged(None if k == 1 else ahp(np.ones((k, k))))):
        draw(each, [ax], (view,))
        ax.figure.canvas.draw()
        assert [artist.get_gid() for artist in moving(ax)] == [mark.key for mark in view(each).marks]


def test_marks_are_at_the_winners_in_their_designs_colours():
    front = a_front(2)
    shown = decision(front, ahp([5]))
    view = front_winners(shown)
    for rule in MARKS:
        i = CHOOSERS[rule](front, ahp([5]).weights)
        assert_allclose(xy(view, rule).ravel(), [front.f[i, 0] / mm, -front.f[i, 1] / mm**2])
        assert (view[rule].role, view[rule].index) == ("series", shown.index[i])


def looks(view, key, x, y):
    """Role and place in the series of the regions of a map that cover a point, lowest first."""
    regions = [m for m in view.marks if isinstance(m, Polygon) and m.key.startswith(f"{key} ")]
    return [(m.role, m.index) for m in regions if _covers(m, x, y)]


def look_of(shown, winner):
    return ("series", shown.index[winner]) if winner in shown.index else ("guide", 0)


def _covers(region, x, y):
    points = np.transpose([region.x, region.y])
    pieces = np.split(points, np.flatnonzero(np.isnan(points[:, 0])))
    pieces = [piece[np.isfinite(piece).all(1)] for piece in pieces]
    return sum(len(piece) > 2 and Path(piece).contains_point((x, y)) for piece in pieces) % 2 == 1  # not in a hole


def test_the_triangle_has_the_winners_colour_at_every_weighting():
    front = a_front(3)
    shown = decision(front, ahp([2, 3, None]))
    view = winners_by_weight(shown)
    for weights in 0.05 + 0.85 * np.random.default_rng(5).dirichlet(np.ones(3), 12):
        for k, (rule, choose) in enumerate((("weighted sum", weighted_sum), ("TOPSIS", topsis))):
            near = weights + 0.012 * (np.eye(3) - 1 / 3)  # nothing else wins near by
            if len({choose(front, v) for v in (weights, *near, *(2 * weights - near))}) > 1:
                continue
            x, y = triangle(weights) + np.array([k * APART, 0])
            winner = choose(front, weights)
            assert shown.winner_at(x, y) == winner
            assert look_of(shown, winner) in looks(view, rule, x, y)
            assert ("paper", 0) not in looks(view, rule, x, y)
    cells = [
        m for m in view.marks if m.key.startswith("weighted sum") and getattr(m, "role", "") in ("series", "guide")
    ]
    beyond = [(x, y) for m in cells for x, y in np.transpose([m.x, m.y]) if y < -1e-3]
    assert beyond
    assert {looks(view, "weighted sum", x, y)[-1] for x, y in beyond[:20]} == {
        ("paper", 0)
    }  # what sticks out is hidden
    x, y = xy(view, "weighted sum now").ravel()
    assert_allclose((x, y), triangle(ahp([2, 3, None]).weights))
    assert_allclose(triangle(np.eye(3)[1]), (0, 0), atol=1e-12)


def test_the_line_of_weights_changes_colour_where_the_winner_changes():
    front = a_front(2)
    shown = decision(front, ahp([1]))
    view = winners_by_weight(shown)
    told = judgement_ranges(front, [1])[0]
    for ratio in np.geomspace(told.low * 1.02, told.high * 0.98, 5):
        (look,) = looks(view, "weighted sum", 100 * ratio / (1 + ratio), 0)
        assert look == look_of(shown, shown.winners["weighted sum"])
    for ratio in (told.low * 0.95, told.high * 1.05):
        assert shown.winner_at(100 * ratio / (1 + ratio), 0) == weighted_sum(front, [ratio, 1])
        assert shown.winner_at(100 * ratio / (1 + ratio), 0) != shown.winners["weighted sum"]
    assert_allclose(xy(view, "now")[0], 50)


def test_bars_end_where_the_winner_changes():
    shown = decision(a_front(3), ahp([2, 3, None]))
    view = judgement_bars(shown)
    for rule in WEIGHING:
        for p, told in enumerate(shown.ranges[rule]):
            bar = xy(view, f"{p} {rule}")[0]
            assert_allclose((bar.min(), bar.max()), (told.low, told.high))
            assert_allclose(view[f"{p} {rule} now"].x, told.judged)
            beyond = "stays" if told.above is None else f"next: design {told.above}"
            assert view[f"{p} {rule} above"].words == beyond


VALUES = np.array([[1.0, 40, 7], [2, 30, 7], [4, 20, 7], [5, 10, 7]])
COLUMNS = (Column("one", "mm", 1), Column("two", "", -1), Column("three", "N"))


def test_parallel_coordinates_part_what_the_bands_keep():
    shown = Designs(COLUMNS, VALUES, bands={0: (1.5, 5), 1: (15, 50)}, marked={3: 2}, selected=1)
    assert shown.kept.tolist() == [False, True, True, False]
    view = parallel_coordinates(shown)
    heights = np.array([[0, 1, 0.5], [0.25, 2 / 3, 0.5], [0.75, 1 / 3, 0.5], [1, 0, 0.5]])
    for key, rows in (("kept", [1, 2]), ("left out", [0, 3]), ("in the sliders", [1]), ("marked 3", [3])):
        x, y = xy(view, key)
        assert_allclose(y[np.isfinite(x)].reshape(-1, 3), heights[rows])
        assert_allclose(x[np.isfinite(x)].reshape(-1, 3), [[0, 1, 2]] * len(rows))
    assert view["marked 3"].index == 2
    assert_allclose(view["band 0"].y, [0.125, 0.125, 1, 1])
    assert "band 2" not in view
    assert view["name 0"].words == "one\n↓ better"
    assert (view["low 0"].words, view["high 0"].words) == ("1 mm", "5 mm")
    assert (view["low 1"].words, view["high 1"].words) == ("10", "40")
    assert shown.value(1, 0.5) == 25
    assert shown.nearest(0.5, 0.46) == 1  # halfway from 0.25 to 2/3
    assert shown.nearest(0, 0.1) == 1  # design 0 is nearer, but left out
    assert Designs(COLUMNS, VALUES, bands={0: (9, 10)}).nearest(0, 0) is None


# --- the panel --------------------------------------------------------------------------------------------------------


class Source:
    """What a decision asks of a panel with a front."""

    def __init__(self, front, importance=None):
        self.front, self.importance, self.followers = front, importance, []
        self.explorer = explore(Plate(), lambda analysis: Picture.of(Axes()))

    def on_front(self, act):
        self.followers.append(act)

    def select(self, i):
        self.explorer.load(self.front[i])

    def show(self, front):
        self.front = front
        for act in self.followers:
            act()


@pytest.fixture
def source():
    return Source(a_front(3), ahp_panel(Judgements([m.name for m in GOALS[2]], [2, 3, None])))


def rows(panel):
    return {cells[0]["words"]: cells[1:] for cells in panel.numbers.rows}


def point(panel, does, x, y):
    """What the pointer does on the parallel coordinates, as the page tells it."""
    do(panel, panel.picture, does=does, view=0, at=[x, y], pixel=[0.01, 0.005])


def shown(panel, part):
    """Whether the page shows a part: it and all that it stands in are visible."""

    def visible(state):
        children = state.get("children", ())
        return state["visible"] and (state["id"] == part.number or any(map(visible, children)))

    return visible(panel.body)


def click_map(panel, x, y):
    do(panel, panel.map, does="click", view=0, at=[x, y], pixel=[0.005, 0.005])


def test_the_table_has_every_rules_winner(source):
    panel = choose_panel(source)
    for rule in MARKS:
        i = CHOOSERS[rule](source.front, source.importance.weights)
        f, x = source.front.f[i], source.front.x[i]
        assert rows(panel)[rule][:6] == [
            str(i), slim.text(f[0]), area.text(-f[1]), slope.text(f[2]), f"{x[0] / mm:.5g} mm", f"{x[1] / mm:.5g} mm",
        ]  # fmt: skip
    share = winner_map(source.front, topsis).shares[panel.shown.winners["TOPSIS"]]
    assert rows(panel)["TOPSIS"][6] == f"{100 * share:.0f} %"


def test_a_judgement_moves_winners_and_ranges(source):
    panel = choose_panel(source)
    source.importance.boxes[(0, 1)].value = "1/7"
    weights = ahp([1 / 7, 3, None]).weights
    assert_allclose(panel.shown.weights, weights)
    assert rows(panel)["weighted sum"][0] == str(weighted_sum(source.front, weights))
    assert panel.shown.ranges["TOPSIS"] == judgement_ranges(source.front, [1 / 7, 3, None], topsis)
    x, y = triangle(weights)
    assert (panel.map.shown[0]["weighted sum now"].x, panel.map.shown[0]["weighted sum now"].y) == (x, y)
    source.importance.method.value = "geometric"
    assert_allclose(panel.shown.weights, ahp([1 / 7, 3, None], "geometric").weights)


def test_each_winner_can_be_loaded_and_is_marked(source):
    panel = choose_panel(source)
    for rule, i in panel.shown.winners.items():
        press(panel, rule)
        assert source.explorer.design == source.front[i]
        assert panel.designs.selected == i
    source.explorer.load(Plate(width=11.1 * mm))
    assert panel.designs.selected is None


def test_a_dragged_band_keeps_what_is_inside_and_a_click_drops_it(source):
    panel = choose_panel(source)
    values = panel.designs.values[:, 0]
    low, high = values.min(), values.max()
    point(panel, "press", 0.02, 0.3)
    point(panel, "drag", 0.02, 0.6)
    point(panel, "drag", 0.30, 0.8)
    point(panel, "release", 0.30, 0.8)
    band = panel.designs.bands[0]
    assert_allclose(band, (low + 0.3 * (high - low), low + 0.8 * (high - low)), rtol=1e-6)
    inside_band = (band[0] <= values) & (values <= band[1])
    assert (panel.designs.kept == inside_band).all()
    assert f"{inside_band.sum()} of {len(values)} designs kept" in panel.count.text
    assert_allclose(panel.band.value, band)
    point(panel, "press", 0, 0.5)
    point(panel, "click", 0, 0.5)
    assert panel.designs.bands == {}
    assert panel.designs.kept.all()


def test_a_band_can_be_set_with_the_keys_too(source):
    panel = choose_panel(source)
    panel.axis.value = 3
    values = panel.designs.values[:, 3]
    assert (panel.band.min, panel.band.max) == (values.min(), values.max())
    do(panel, panel.band, value=[values.min(), 30])
    assert (panel.designs.kept == (values <= 30)).all()
    press(panel, "Keep all")
    assert panel.designs.kept.all()
    assert panel.band.value == (values.min(), values.max())


def test_a_click_on_a_line_loads_its_design(source):
    panel = choose_panel(source)
    heights = panel.designs.height(panel.designs.values)
    for i in (0, 5):
        y = heights[i, 0] + 0.5 * (heights[i, 1] - heights[i, 0])
        expected = panel.designs.nearest(0.5, y)
        point(panel, "press", 0.5, y)
        point(panel, "click", 0.5, y)
        assert source.explorer.design == source.front[expected]


def test_a_click_on_the_map_loads_the_winner_there(source):
    panel = choose_panel(source)
    weights = np.array([0.1, 0.1, 0.8])
    click_map(panel, *triangle(weights))
    assert source.explorer.design == source.front[weighted_sum(source.front, weights)]
    shown = source.explorer.design
    click_map(panel, 1.3, 0.5)  # beside the triangles
    assert source.explorer.design == shown


def test_bands_stay_with_a_new_front_of_the_same_study_and_go_with_another(source):
    panel = choose_panel(source)
    panel.keep(0, (20.0, 40.0))
    source.show(a_front(3, n=7))
    assert panel.designs.bands == {0: (20.0, 40.0)}
    source.show(a_front(2))
    assert panel.designs.bands == {}
    assert_allclose(panel.shown.weights, 0.5)  # the judgements are for three objectives


def test_without_a_front_there_is_a_sentence(source):
    full, study = source.front, source.front.study
    source.front = Front(study, np.zeros((0, 2)), np.zeros((0, 3)), "no design can be built")
    panel = choose_panel(source)
    assert "There is no front to choose from yet: run a search. no design can be built" in panel.banner.text
    assert not shown(panel, panel.numbers)
    assert panel._repr_mimebundle_()[0]["text/plain"].startswith("There is no front")
    source.show(full)
    assert shown(panel, panel.numbers)
    assert panel.summary().startswith("weighted sum: design ")


@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_one_to_four_objectives(k):
    source = Source(a_front(k))
    panel = choose_panel(source, measures=(round_, slope))
    assert_allclose(panel.shown.weights, 1 / k)
    assert panel._repr_mimebundle_()[0]["image/png"]
    assert len(panel.sureness) == (0 if k == 1 else 2)
    press(panel, "knee")
    assert source.explorer.design == source.front[panel.shown.winners["knee"]]
    assert try_everything(panel) == (1 if k == 1 else 2 + k)  # one design has no band, and no wishes
    assert panel.designs.bands == {}


def test_an_empty_front_between_two_studies_leaves_no_axes_of_the_first(source):
    panel = choose_panel(source)
    study = a_front(2).study
    source.show(Front(study, np.zeros((0, 2)), np.zeros((0, 2)), "stopped"))
    source.show(a_front(2))
    assert "slope" not in [column.name for column in panel.designs.columns]
    assert panel.picture.shown[0]["name 2"].words.startswith("width")
    assert panel.axis.described()["names"] == [column.name for column in panel.designs.columns]


def test_the_band_is_called_after_its_axis(source):
    panel = choose_panel(source)
    for name in ("width", "slope"):
        panel.axis.value = [c.name for c in panel.designs.columns].index(name)
        assert panel.band.description == name


def test_what_a_wish_costs_the_other_is_told_for_each_winner():
    """Evenly spaced, the parabola through three points has the slope of the chord between the outer two."""
    front = a_front(2)
    panel = choose_panel(Source(front, ahp_panel(Judgements(["width", "area"], [1]))))
    told = [line for line in panel.verdict.value if "costs" in line]
    (width, area_), inner = (front.f / (mm, -(mm**2))).T, [i for i in panel.shown.index if 0 < i < len(front) - 1]
    chords = {i: (area_[i + 1] - area_[i - 1]) / (width[i + 1] - width[i - 1]) for i in inner}
    said = [re.fullmatch(r"At design (\d+): 1 mm less width costs (.*) mm\^2 less area\.", line) for line in told]
    assert {int(each[1]): float(each[2]) for each in said} == {i: pytest.approx(c, rel=5e-4) for i, c in chords.items()}
    assert told
    assert not [line for line in choose_panel(Source(a_front(3))).verdict.value if "costs" in line]


# --- a reference point ------------------------------------------------------------------------------------------------


def wish_of(panel):
    """What stands in the boxes of the reference point."""
    return [line.children[1].value for line in panel.reference.box.children]


def test_a_reference_point_that_is_dragged_picks_the_nearest_design():
    front = a_front(2)
    panel = choose_panel(source := Source(front))
    ideal = [front.f[:, 0].min() / mm, -front.f[:, 1].min() / mm**2]
    assert_allclose(xy(panel.points.shown[0], "reference").ravel(), ideal)
    assert_allclose(wish_of(panel), ideal, rtol=1e-5)
    assert panel.points.movable == "reference"
    for at in ([25.0, 2000.0], [40.0, 2300.0], [12.0, 500.0]):
        do(panel, panel.points, does="move", view=0, at=at, pixel=[0.1, 1.0])
        expected = achievement(front, [at[0] * mm, -at[1] * mm**2])
        assert source.explorer.design == front[expected]
        assert panel.designs.selected == expected
        assert_allclose(xy(panel.points.shown[0], "reference").ravel(), at)
        assert_allclose(wish_of(panel), at)
    do(panel, panel.points, does="move", view=0, at=[math.inf, 1.0], pixel=[0.1, 1.0])
    assert_allclose(wish_of(panel), [12, 500])
    source.show(front_of(front.study.evaluate(front.x[:-1]), front.study))
    assert_allclose(wish_of(panel), [12, 500])  # what is wished stays


def test_a_reference_point_is_typed_where_there_are_more_objectives(source):
    panel = choose_panel(source)
    assert [line.children[0].text for line in panel.reference.box.children] == ["width", "area", "slope"]
    panel.reference.box.children[2].children[1].value = 1.5
    wish = source.front.f.min(0)
    wish[2] = 1.5
    assert source.explorer.design == source.front[achievement(source.front, wish)]
    do(panel, panel.points, does="move", view=0, at=[30.0, 900.0], pixel=[0.1, 1.0])
    wish[:2] = 30 * mm, -900 * mm**2
    assert source.explorer.design == source.front[achievement(source.front, wish)]
    assert_allclose(wish_of(panel), [30, 900, 1.5])


def decided(panel):
    """The decision in the file that a person saves."""
    return from_json(downloaded(panel, "Save decision")["text"], measures=(*GOALS[3], round_))


def test_the_decision_is_saved_with_its_rule_and_its_judgements(source):
    panel = choose_panel(source)
    assert downloaded(panel, "Save decision") == {}
    assert "Nothing is saved: the design in the sliders is none of the front's; load one of these." in alert(panel)
    for rule in MARKS:
        press(panel, rule)
        decision = decided(panel)
        assert (decision.rule, decision.chosen) == (rule, panel.shown.winners[rule]) == (rule, decision.taken)
        assert decision.judgements == source.importance.judgements
        assert decision.reference is None
    others = set(range(len(source.front))) - set(panel.shown.winners.values())
    source.select(min(others))
    assert (decided(panel).rule, decided(panel).chosen) == ("by hand", min(others))
    do(panel, panel.points, does="move", view=0, at=[30.0, 900.0], pixel=[0.1, 1.0])
    decision = decided(panel)
    assert decision.rule == "reference point"
    assert decision.design == source.explorer.design == decision.front[decision.taken]
    assert_allclose(decision.reference[:2], [30 * mm, -900 * mm**2])


def test_a_page_of_searches_keeps_the_decision(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a search is kept beside the notebook
    front = a_front(2)
    finder = pareto_panel(explore(Plate(), lambda analysis: Picture.of(Axes())), front.study)
    finder.load(Session(front.study, front[3], front=front))
    panel = choose_panel(finder)
    assert finder.session().decision is None
    told = decided(panel).lines()
    assert finder.session().decision.lines() == told
    saved = downloaded(finder, "Save study")["text"]
    finder.load(Session(front.study, front[1], front=front))
    assert finder.session().decision is None
    upload(finder, "Load study", saved)
    assert finder.session().decision.lines() == told


def test_one_objective_has_no_reference_point():
    panel = choose_panel(Source(a_front(1)))
    assert not panel.reference.box.visible
    assert panel.points.shown[0]["reference"].label == ""
    do(panel, panel.points, does="move", view=0, at=[1.0, 1.0], pixel=[0.1, 1.0])
    assert panel.banner.text == ""


# --- judgements typed and left open -----------------------------------------------------------------------------------


def test_a_typed_judgementcounts_exactly_and_moves_the_slider():
    panel = ahp_panel(Judgements(["a", "b", "c"], [1, 1, 1]))
    for words, value in (("3.7", 3.7), ("1/3", 1 / 3), (" 2 / 5 ", 0.4), ("0,25", 0.25)):
        panel.boxes[(0, 1)].value = words
        assert panel.judgements.above == (value, 1, 1)
        assert panel.sliders[(0, 1)].value == value
    assert panel.boxes[(0, 1)].value == "1/4"
    panel.sliders[(0, 1)].value = 5.0
    assert panel.boxes[(0, 1)].value == "5"
    assert_allclose(panel.weights, ahp([5, 1, 1]).weights)


def test_an_empty_box_leaves_a_pair_open():
    panel = ahp_panel(Judgements(["a", "b", "c"], [2, 8, 4]))
    panel.boxes[(0, 2)].value = ""
    assert panel.judgements.above == (2, None, 4)
    assert_allclose(panel.weights, ahp([2, None, 4]).weights)
    assert panel.sliders[(0, 2)].value == 8
    assert panel.sliders[(0, 2)].pale
    assert panel.numbers.rows[0][3] == "(8)"
    assert "not judged: 1" in panel.summary()
    panel.boxes[(0, 1)].value = "?"
    assert panel.judgements.above == (2, None, 4)
    assert "The judgement of a against b stays as it was: no judgement connects a with b, c; " in panel.banner.text
    assert panel.boxes[(0, 1)].value == "2"
    panel.sliders[(0, 2)].value = 7.0
    assert panel.judgements.above == (2, 7, 4)
    assert not panel.sliders[(0, 2)].pale


@pytest.mark.parametrize(
    "words", ["many", "-3", "0", "1/0", "inf", "3;4", "1 2", "1_0", "1/2/3", "1,234", "nan", "--5", "2 in", "∞"]
)
def test_what_is_no_judgement_is_refused_in_a_sentence(words):
    panel = ahp_panel(Judgements(["a", "b"], [3]))
    panel.boxes[(0, 1)].value = words
    assert f"The judgement of a against b stays as it was: {words!r} is no number above 0" in panel.banner.text
    assert panel.judgements.above == (3,)
    assert panel.boxes[(0, 1)].value == "3"


@pytest.mark.parametrize("typed", ["2/3", "5/7", "1/3", "2.5", "0.4", "3"])
def test_a_judgement_is_shown_as_it_was_typed(typed):
    panel = ahp_panel(Judgements(["a", "b"], [2]))
    panel.boxes[(0, 1)].value = typed
    assert (panel.boxes[(0, 1)].value, panel.judgements.above) == (typed, (float(Fraction(typed)),))
    assert panel.numbers.rows[0][2] == typed
    panel.boxes[(0, 1)].value = "nobody"
    assert panel.boxes[(0, 1)].value == typed


def test_an_open_judgement_goes_to_a_file_and_back():
    panel = ahp_panel(Judgements(["a", "b", "c"], [2, None, 4]))
    work = Session(door_handle_study(), DoorHandleCam(), {"importance": panel.judgements})
    again = from_json(to_json(work)).judgements["importance"]
    assert again == panel.judgements
    panel.load([1, 1, 1])
    panel.load(again)
    assert panel.judgements.above == (2, None, 4)
