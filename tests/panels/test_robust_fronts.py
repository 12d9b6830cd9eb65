"""Fronts of designs that survive being made, beside nominal ones, in the panels: against searches and parts in hand."""

import numpy as np
import pytest
from hand import move
from numpy.testing import assert_allclose, assert_array_equal
from sheets import alert, do, parts

from camkit import (
    ArmLoad,
    DoorHandleCam,
    compare_fronts,
    deg,
    door_handle_study,
    explore,
    live_pareto_panel,
    mm,
    nsga2,
    pareto_panel,
    quick_front,
    shaft_study,
)
from camkit.machines.door_handle import EXPANDED_SPACE
from camkit.panels.kit.inputs import Check
from camkit.panels.kit.robust_fronts import checked
from camkit.search.front import Front
from camkit.search.robust_front import most_tolerant
from camkit.study import general_tolerances
from camkit.views.robust_front import RobustFront, robust_pareto

PAPER = DoorHandleCam(lift_load=ArmLoad(torque=10))
STUDY = door_handle_study(PAPER)
LIMITS = {"at_most": STUDY.at_most, "at_least": STUDY.at_least}
WIDE = {"lift_arm": 1 * mm, "lift_start_angle": 1 * deg, "relief_cam_angle": 1 * deg}


def ticked(panel):
    """Tick the box, as the page does."""
    (box,) = [part for part in parts(panel, Check) if part.description == "made within tolerances"]
    do(panel, box, value=True)
    panel.settle()
    return panel


def keys(panel):
    """How many points each mark of the picture has."""
    return {mark.key: len(mark.x) for mark in panel.picture.shown[0].marks}


@pytest.fixture(scope="module")
def fronts():
    """The robust front, and the nominal one."""
    return quick_front(STUDY.under(WIDE)), quick_front(STUDY)


@pytest.fixture(scope="module")
def live():
    app = explore(PAPER, **LIMITS, tolerances=WIDE)
    return ticked(live_pareto_panel(app, STUDY))


def test_a_tick_shows_the_robust_front_beside_the_nominal_one(live, fronts):
    robust, (expected, nominal) = STUDY.under(WIDE), fronts
    assert_allclose(live.front.x, expected.x)
    assert live.front.study == robust
    assert_allclose(live.robust.nominal.x, nominal.x)
    drawn = keys(live)
    assert drawn["robust"] + drawn["open"] == len(expected)
    assert drawn["robust"] == expected.yields.decided.sum()
    yields = robust.modelled_yield(nominal.x)
    assert drawn["yield 0"] == (yields >= 0.99).sum()
    assert sum(drawn[f"yield {k}"] for k in range(4)) == len(nominal)
    exact = robust.recheck(nominal.x[::9], 1024).share
    assert_allclose(yields[::9], exact, atol=0.02)
    assert "by exact parts" in live.status.text


def test_the_price_and_why_nominal_designs_fail_are_said(live):
    said, nominal = live.robust.words.text, live.robust.nominal
    share, ends = live.front.price(nominal)
    assert f"the price: {100 * share:.1f} % of the hypervolume" in said
    assert f"{STUDY.minimise[1].text(abs(ends[1]))} worse" in said
    assert f"{(live.robust.yields >= 0.99).sum()} of {len(nominal)} nominal designs yield 99 % or more" in said
    assert "made within lift arm ±1 mm, lift start angle ±1 deg, relief cam angle ±1 deg" in said
    assert "miss the limit of the maximum pressure angle" in said


def test_points_say_their_yields(live):
    marks = live.picture.shown[0]
    recheck = live.front.yields
    assert_array_equal(marks["robust"].names, [f"yield {recheck.of([i])}" for i in np.flatnonzero(recheck.decided)])
    assert all(name.endswith("by the model") for name in marks["yield 0"].names)


def test_the_robust_front_follows_the_sliders_first_by_the_model(live):
    seen = []
    live.on_front(lambda: seen.append((live.front.study.start.lift_centre_distance, checked(live.front) is not None)))
    move(live.explorer, "lift_centre_distance", 76)
    live.settle()
    assert seen == [(76 * mm, False), (76 * mm, True)]
    live.robust.tick.value = False
    live.settle()
    assert live.front.study == live.front.study.nominal
    assert not live.robust.words.text
    assert "front" in keys(live)


def test_where_nothing_is_robust_a_factor_on_the_tolerances_is_said():
    coarse = {path: 12 * half for path, half in WIDE.items()}
    app = explore(PAPER, **LIMITS, tolerances=coarse)
    panel = ticked(live_pareto_panel(app, STUDY))
    assert len(panel.front) == 0
    assert keys(panel)["yield 0"] == 0
    x, factor = most_tolerant(STUDY.under(coarse))
    assert f"within {factor:.2f} times these one is" in panel.robust.words.text
    assert 0 < factor < 1
    for share, kept in ((0.9, True), (1.3, False)):
        within = STUDY.under({path: share * factor * half for path, half in coarse.items()})
        assert (within.recheck(x, 4096).share[0] >= 0.99) == kept


def test_the_most_tolerant_shaft_is_the_thickest_one():
    half = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}
    study = shaft_study().under(half)
    x, factor = most_tolerant(study)
    grid = np.stack(np.meshgrid(*(np.linspace(*bounds, 15) for bounds in study.free.values())), -1).reshape(-1, 2)
    assert factor >= 0.98 * study.tolerance_factor(grid).max()
    assert factor == pytest.approx(study.tolerance_factor(x)[0])


def test_without_tolerances_or_with_a_yield_that_is_none_a_sentence_is_said(live):
    live.robust.wanted.take({"value": 0.4})
    live.robust.tick.value = True
    live._changed()
    assert "the yield is 0.4" in alert(live)
    live.robust.wanted.take({"value": 0.99})


def test_nsga2_finds_both_fronts_one_after_the_other():
    study = door_handle_study(PAPER, space=EXPANDED_SPACE)
    app = explore(PAPER, **LIMITS)
    panel = pareto_panel(app, study, population=12, generations=6)
    panel.robust.tick.value = True
    panel.run()
    panel.wait()
    robust = study.under(app.within(PAPER))
    nominal, expected = nsga2(study, 12, 6, seed=1), nsga2(robust, 12, 6, seed=1)
    assert_allclose(panel.robust.nominal.x, nominal.x)
    assert_allclose(panel.front.x, expected.x)
    assert checked(panel.front) is not None
    drawn = keys(panel)
    assert drawn["robust"] + drawn["open"] == len(expected)
    assert "made within lift arm ±0.3 mm" in panel.robust.words.text
    assert general_tolerances(PAPER).keys() == robust.tolerances.keys()
    panel.robust.tick.value = False
    panel.run()
    panel.wait()
    assert_allclose(panel.front.x, nominal.x)
    assert "front" in keys(panel)


def test_fronts_that_are_compared_have_their_yields_beside(fronts):
    robust, nominal = fronts
    panel = compare_fronts(explore(PAPER), given={"robust": robust, "as drawn": nominal})
    assert panel.table.head[-1] == "yields"
    shares = robust.study.modelled_yield(nominal.x)
    assert panel.table.rows[1][-1] == f"{100 * shares.min():.1f} to {100 * shares.max():.1f} %"
    assert panel.table.rows[0][-1] == f"{100 * robust.yields.share.min():.1f} to 100.0 %"
    assert "beside as drawn, the price: " in panel.note.text
    assert "yields" not in compare_fronts(explore(PAPER), given={"as drawn": nominal}).table.head


def test_yields_that_do_not_belong_to_the_designs_are_refused(fronts):
    _, nominal = fronts
    with pytest.raises(ValueError, match="3 yields for 100 designs"):
        RobustFront(nominal, nominal, np.ones(3))
    empty = Front(nominal.study, nominal.x[:0], nominal.f[:0])
    picture = robust_pareto(RobustFront(empty, nominal, np.linspace(0, 1, 100), wanted=0.8))
    assert picture["yield 1"].label == "nominal, yield 50 to 80 %"
    assert len(picture["yield 0"].x) == 20
