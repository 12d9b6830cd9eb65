"""The Study tab: wishes, limits and free quantities chosen by hand, and what is then searched."""

import numpy as np
import pytest
from hand import choose, move
from sheets import alert, do, downloaded, press, upload
from try_everything import try_everything

from camkit import (
    DoorHandleCam,
    Measure,
    TranslatingRollerCam,
    deg,
    door_handle_study,
    explore,
    mm,
    shaft_study,
    study_panel,
)
from camkit.cam import ContactPair, max_pressure_angle, min_force, peak_force, peak_pressure
from camkit.machines import cam_lever_study
from camkit.machines.high_speed_measures import high_speed_study
from camkit.motion import Cycloidal, ModifiedSine
from camkit.quantities import measures_of, quantities_of, with_quantities
from camkit.study import Study, general_tolerances
from camkit.units import MPa, N, rpm

PATIENCE = 60
ROLLER = with_quantities(TranslatingRollerCam(contact=ContactPair()), {"load.speed": 1200 * rpm})
LAWS = "motion.rise.law, motion.return.law"
SPRING = ("load.spring_rate", "load.preload")


def want(panel, measure, goal="–", limit="–", **boxes):
    """Choose from the menus of a measure, and type into its boxes, as the page says it."""
    wish = panel.wishes.rows[measure]
    for menu, name in ((wish.goal, goal), (wish.limit, limit)):
        do(panel, menu, value=[str(option[0]) for option in menu.options].index(name))
    for end, value in boxes.items():
        do(panel, wish.boxes[{"low": -1, "high": 1}[end]], value=value)


def free(panel, *paths):
    for path in paths:
        do(panel, panel.space.rows[path].free, value=True)


def gentle_roller(panel):
    """The least contact pressure with a contact force of at least 10 N and at most 25 degrees of pressure angle."""
    want(panel, peak_pressure, "small")
    want(panel, min_force, limit="at least", low=10.0)
    want(panel, max_pressure_angle, limit="at most", high=25.0)
    free(panel, *SPRING)


def opened(panel, title):
    return next(tab["sheets"][0] for tab in panel.explorer.tabs if tab["title"] == title)


# --- what is asked for ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "study",
    [door_handle_study(), shaft_study(), cam_lever_study(), high_speed_study(angles=101)],
    ids=lambda study: type(study.start).__name__,
)
def test_a_study_that_is_given_is_asked_for_as_it_is(study):
    panel = study_panel(explore(study.start), study)
    asked = panel.study
    assert asked == study.around(study.start)
    known = measures_of(study.start)
    first = [-m if -m in known else m for m in study.minimise]
    assert list(panel.wishes.rows)[: len(first)] == first
    assert set(panel.wishes.rows) >= {*known}
    assert [*panel.space.rows][: len(quantities_of(asked.start))] == [*quantities_of(asked.start)]


def test_it_begins_with_the_limits_of_the_instrument():
    app = explore(ROLLER, at_most={max_pressure_angle: 40 * deg}, at_least={peak_force: 5 * N})
    panel = study_panel(app)
    assert panel.summary() == "at most 40 deg: maximum pressure angle\nat least 5 N: peak contact force"
    want(panel, peak_force, "small", "between", low=5.0, high=150.0)
    free(panel, "base_radius")
    assert panel.study == Study(
        app.design, ["base_radius"], (peak_force,), {max_pressure_angle: 40 * deg, peak_force: 150.0}, {peak_force: 5.0}
    )
    assert panel.told.text.endswith("at least 5 N: peak contact force; free: base radius")


def test_values_follow_the_design_and_a_limit_begins_at_them():
    app = explore(ROLLER)
    panel = study_panel(app)
    wish = panel.wishes.rows[max_pressure_angle]
    for radius in (30, 44.4):
        move(app, "base_radius", radius)
        now = max_pressure_angle.one(app.analysis)
        assert wish.now.text == max_pressure_angle.text(now)
    for limit, end, sense in (("at most", 1, 1), ("at least", -1, -1)):
        want(panel, max_pressure_angle, "large", limit)
        begins = wish.boxes[end].value * deg
        assert 0 <= sense * (begins - now) < 0.01 * deg  # the design keeps it
    assert wish.objective == -max_pressure_angle
    want(panel, min_force, limit="at least")
    assert panel.wishes.limits(-1)[min_force] <= min_force.one(app.analysis) < 0


def test_a_measure_of_ones_own_is_one_line():
    size = Measure("size of the cam", "mm", lambda a: np.ravel(a.cam.base_radius + a.cam.roller_radius))
    panel = study_panel(explore(ROLLER), measures=[size])
    assert panel.wishes.rows[size].now.text == "38 mm"
    want(panel, size, "small")
    want(panel, max_pressure_angle, limit="at most", high=20.0)
    free(panel, "base_radius")
    press(panel, "Find")
    optimise = opened(panel, "Optimise")
    optimise.wait(PATIENCE)
    assert max_pressure_angle.one(panel.explorer.analysis) == pytest.approx(20 * deg, rel=1e-6)


# --- what is found ----------------------------------------------------------------------------------------------------


def test_the_least_contact_pressure_of_a_spring():
    app = explore(ROLLER)
    panel = study_panel(app)
    gentle_roller(panel)
    press(panel, "Find")
    optimise = opened(panel, "Optimise")
    optimise.wait(PATIENCE)
    assert app.opened == "Optimise"
    assert peak_pressure.one(app.analysis) / MPa == pytest.approx(305.6, abs=0.1)
    assert min_force.one(app.analysis) == pytest.approx(10, rel=1e-4)
    assert "the minimum contact force 10 N" in optimise.summary()
    assert optimise.options.rows == []
    assert panel.wishes.rows[min_force].now.text == "10 N"


def try_laws(panel, *names):
    """Free the laws of rise and return together, with these options."""
    free(panel, LAWS)
    laws = panel.space.rows[LAWS]
    do(panel, laws.all, value=False)
    for name in names:
        do(panel, laws.options[name], value=True)


def test_the_best_of_several_laws():
    app = explore(ROLLER)
    panel = study_panel(app)
    gentle_roller(panel)
    try_laws(panel)
    press(panel, "Find")
    said = "no option of the motion rise law, motion return law is to be tried; tick one or more"
    assert alert(panel) == f"This cannot be searched: {said}."
    try_laws(panel, "cycloidal", "modified sine", "4-5-6-7 polynomial")
    assert panel.summary().endswith("alike, one of cycloidal, modified sine, 4-5-6-7 polynomial")
    press(panel, "Find")
    optimise = opened(panel, "Optimise")
    optimise.wait(PATIENCE)
    laws = [segment.law for segment in app.design.motion.segments if hasattr(segment, "law")]
    assert laws == [ModifiedSine(), ModifiedSine()]
    assert optimise.options.text.split("\n") == [
        "motion rise law, motion return law  peak contact pressure",
        "modified sine  275.9 MPa",
        "cycloidal  305.6 MPa",
        "4-5-6-7 polynomial  334.1 MPa",
    ]


def test_a_front_of_several_laws_loads_designs_of_each():
    app = explore(ROLLER)
    panel = study_panel(app)
    want(panel, max_pressure_angle, "small")
    want(panel, peak_force, "small")
    free(panel, "base_radius")
    try_laws(panel, "cycloidal", "simple harmonic")
    press(panel, "Find")
    live, front = opened(panel, "Live front"), opened(panel, "Front")
    assert len(live.front)
    assert front.asked_study() == panel.study
    for place in range(len(live.front)):
        live.select(place)
        assert app.design == live.front[place]
    live.settle()
    assert app.opened == "Live front"


def test_menus_that_a_study_frees_are_asked_for_as_they_are():
    asked = {
        "roller_radius": {6 * mm, 8 * mm},
        "motion.rise.law": (Cycloidal(), ModifiedSine()),
        "offset": (0.0, 9 * mm),
    }
    study = Study(ROLLER, asked, (max_pressure_angle,))
    panel = study_panel(explore(ROLLER), study)
    assert panel.study.free.keys() == study.free.keys()
    assert all(panel.study.free[name] == free for name, free in study.free.items())
    do(panel, panel.space.rows["roller_radius, sizes"].free, value=False)
    assert panel.study.free.keys() == {"motion.rise.law", "offset"}


def test_a_yield_is_wanted_too():
    app = explore(ROLLER)
    panel = study_panel(app)
    gentle_roller(panel)
    nominal = panel.study
    do(panel, panel.robust, value=True)
    assert panel.study == nominal.under(app.within(app.design), 0.99)
    do(panel, panel.share, value=95.0)
    assert panel.study.yield_at_least == pytest.approx(0.95)
    assert "yield at least 95 %; free: spring rate" in panel.told.text
    do(panel, panel.share, value=20.0)
    press(panel, "Find")
    assert alert(panel) == "This cannot be searched: the yield is 0.2; it must lie above 0.5, up to 1."
    do(panel, panel.share, value=99.0)
    press(panel, "Find")
    optimise = opened(panel, "Optimise")
    optimise.wait(PATIENCE)
    found = panel.study.recheck(panel.study.x_of(app.design)[None])
    assert found.share[0] >= 0.99
    assert min_force.one(app.analysis) > 10.005  # there is room for the parts


def test_a_yield_is_wanted_of_a_front():
    given = door_handle_study().under({"lift_arm": 0.4 * mm}, 0.95)
    panel = study_panel(explore(given.start), given)
    press(panel, "Find")
    live, front = opened(panel, "Live front"), opened(panel, "Front")
    live.settle()
    assert live.front.study == front.asked_study() == panel.study == given
    assert live.robust.nominal.study == given.nominal


def test_a_study_under_tolerances_is_asked_for_as_it_is():
    given = shaft_study().under({"outer_diameter": 0.5 * mm}, 0.9)
    panel = study_panel(explore(given.start), given)
    assert panel.study == given
    do(panel, panel.robust, value=False)
    assert panel.study == shaft_study()


def test_several_wishes_open_front_judgements_and_decision_on_them():
    app = explore(door_handle_study().start)
    panel = study_panel(app, door_handle_study())
    followers = []
    for _ in range(2):
        press(panel, "Find")
        assert [tab["title"] for tab in app.tabs] == ["Study", "Front", "Judgements", "Live front", "Decision"]
        followers.append(len(app.followers))
    assert followers[0] == followers[1]  # the first ones follow no more
    assert app.opened == "Live front"
    assert opened(panel, "Live front").front.study.minimise == panel.study.minimise
    assert opened(panel, "Front").asked_study() == panel.study
    assert opened(panel, "Decision").source is opened(panel, "Live front")
    press(panel, "Tolerances")
    assert opened(panel, "Tolerances").half_widths == general_tolerances(app.design)  # as in the verdict
    assert app.opened == "Tolerances"


def test_a_front_of_many_free_quantities_is_searched_at_once():
    panel = study_panel(explore(ROLLER))
    want(panel, peak_pressure, "small")
    want(panel, max_pressure_angle, "small")
    free(panel, *SPRING, "base_radius", "roller_radius", "contact.width")
    press(panel, "Find")
    front = opened(panel, "Front")
    running = front.runner.job
    assert panel.explorer.opened == "Front"
    press(panel, "Find")  # stops the first one
    running.thread.join(PATIENCE)
    assert not running.ended
    again = opened(panel, "Front")
    assert again is not front
    again.stop()
    again.wait(PATIENCE)
    assert len(again.front)


def test_another_law_has_other_quantities_and_the_ticks_stay():
    app = explore(ROLLER)
    panel = study_panel(app)
    free(panel, *SPRING)
    choose(app, "motion.rise.law", "shaped")
    assert "motion.rise.law.c0" in panel.space.rows
    free(panel, "motion.rise.law.c0")
    want(panel, peak_pressure, "small")
    assert list(panel.study.free) == ["motion.rise.law.c0", *SPRING]
    choose(app, "motion.rise.law", "cycloidal")
    assert list(panel.study.free) == list(SPRING)


def test_quantities_are_found_by_their_names():
    panel = study_panel(explore(ROLLER))
    do(panel, panel.space.find, value="spring")
    groups = panel.space.part.children[1].children
    assert [(group.description, group.open) for group in groups] == [("Load (2)", True)]
    assert "base_radius" in panel.space.rows
    do(panel, panel.space.find, value="")
    assert len(panel.space.part.children[1].children) > 4


# --- what is none -----------------------------------------------------------------------------------------------------


def test_what_is_no_study_is_said_in_a_sentence():
    panel = study_panel(explore(ROLLER))
    app = panel.explorer

    def said(button="Find"):
        press(panel, button)
        assert [tab["title"] for tab in app.tabs] == ["Study"]
        return alert(panel)

    assert said() == "This cannot be searched: nothing is to be small or large; choose it for one measure or more."
    sentence = "nothing is to be kept; choose a limit for one measure or more"
    assert said("Tolerances") == f"This cannot be shown: {sentence}."
    want(panel, max_pressure_angle, "small")
    assert said() == "This cannot be searched: nothing may change; tick one quantity or more."
    free(panel, "contact.width")
    assert said() == (
        "This cannot be searched: the contact width has no effect on what the study judges; it must not be free."
    )
    want(panel, max_pressure_angle, "small", "between", low=30.0, high=20.0)
    assert said() == (
        "This cannot be searched: the maximum pressure angle is to be at least 30 deg and at most 20 deg; "
        "no design can be both."
    )
    want(panel, max_pressure_angle, "small")
    free(panel, "base_radius")
    do(panel, panel.space.rows["contact.width"].free, value=False)
    do(panel, panel.space.rows["base_radius"].low, value=200.0)
    reversed_ = "the bounds of the base radius are 200 mm and 100 mm; they must be finite, the first below the second"
    assert alert(panel) == f"This cannot be searched: {reversed_}."
    assert said() == f"This cannot be searched: {reversed_}."


def test_tolerances_of_limits_alone_are_those_of_the_verdict():
    app = explore(ROLLER, at_most={max_pressure_angle: 25 * deg}, tolerances={"base_radius": (-0.1 * mm, 0.3 * mm)})
    panel = study_panel(app)
    free(panel, *SPRING)  # what may change says nothing of what the workshop misses
    press(panel, "Tolerances")
    made = opened(panel, "Tolerances")
    assert alert(panel) == ""
    assert made.half_widths == pytest.approx({"base_radius": 0.3 * mm})
    assert made.tolerances.measures == (max_pressure_angle,)
    move(app, "base_radius", 35)
    made.settle()
    assert made.tolerances.study.start.base_radius == pytest.approx(35 * mm)
    assert [*app.tolerances] == ["base_radius"]


def test_a_limit_that_nothing_can_keep_is_said():
    app = explore(ROLLER)
    panel = study_panel(app)
    want(panel, peak_pressure, "small")
    want(panel, max_pressure_angle, limit="at most", high=1.0)
    free(panel, *SPRING)
    press(panel, "Find")
    optimise = opened(panel, "Optimise")
    optimise.wait(PATIENCE)
    told = "No design was found that keeps every limit; this one misses the maximum pressure angle of at most 1 deg"
    assert told in optimise.summary()


# --- files and what is kept -------------------------------------------------------------------------------------------


def test_a_saved_study_is_asked_for_again():
    first = study_panel(explore(ROLLER))
    assert downloaded(first, "Save study") == {}
    assert alert(first).startswith("Nothing is saved: nothing is to be small or large")
    gentle_roller(first)
    file = downloaded(first, "Save study")["text"]
    again = study_panel(explore(ROLLER.replace(base_radius=44 * mm)))
    upload(again, "Load study", file)
    assert again.study == first.study
    assert again.explorer.design == ROLLER
    upload(other := study_panel(explore(DoorHandleCam())), "Load study", file)
    assert alert(other).startswith("This file cannot be used: ")
    assert other.summary() == "nothing is asked for yet"


def test_what_is_asked_for_is_kept_with_the_page():
    first = study_panel(explore(ROLLER))
    gentle_roller(first)
    kept = dict(first.explorer.page)
    app = explore(ROLLER)
    app.page = kept  # somebody goes on with what they left
    later = study_panel(app)
    assert later.summary() == first.summary()
    want(later, max_pressure_angle)
    app.page = kept  # an old word of the page takes nothing back
    assert "pressure angle" not in later.summary()


def test_the_tab_is_made_when_a_page_first_shows_it():
    app = explore(ROLLER)
    assert app.tabs == []
    app._handle_custom_msg({"study": True}, [])
    (tab,) = app.tabs
    assert tab["title"] == "Study"
    gentle_roller(tab["sheets"][0])
    app._handle_custom_msg({"study": True}, [])  # another page shows it, too
    assert app.tabs == [tab]
    page = app.html()
    assert "at least 10 N: minimum contact force" in page
    assert ": make it" not in page  # nobody would hear of a menu


def test_every_control_of_the_panel_comes_back():
    assert try_everything(study_panel(explore(ROLLER), None)) > 100
