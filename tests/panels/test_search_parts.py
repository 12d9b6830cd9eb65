"""The parts of a page of searches, without the page: its search, its sessions, the choice from its front."""

import os
import threading
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit.cam import OscillatingRollerCam
from camkit.decision import CHOOSERS, Judgements
from camkit.files import Session
from camkit.machines.door_handle import (
    DOOR_HANDLE_SPACE,
    EXPANDED_SPACE,
    PAPER_JUDGEMENTS,
    DoorHandleCam,
    door_handle_study,
    lift_curve_study,
)
from camkit.panels.kit.front_picker import FrontChoice, costs, place_on
from camkit.panels.kit.latest_only import Debounced
from camkit.panels.kit.parts import plain
from camkit.panels.kit.quiet import Quiet
from camkit.panels.kit.search_job import SessionSearch
from camkit.panels.kit.search_page import SearchPage
from camkit.search.front import Front, front_of, reference_point
from camkit.search.nsga2 import nsga2
from camkit.units import mm

STUDIES = {"lift curve alone": lift_curve_study(), "whole cam": door_handle_study()}
JUDGEMENTS = {"criteria": PAPER_JUDGEMENTS, "importance": Judgements(["effort", "least radius"], [3])}
OFFERED = {"population": range(4, 101), "generations": range(1, 101), "seed": range(10), "mode": tuple(STUDIES),
           "rule": tuple(CHOOSERS)}  # fmt: skip
SEARCH = {"population": 20, "generations": 12, "seed": 4, "mode": "lift curve alone", "rule": "TOPSIS"}
COLUMNS = {name: judged.names for name, judged in JUDGEMENTS.items()}


def a_page(studies=STUDIES, judged=COLUMNS):
    return SearchPage(DoorHandleCam(), studies, tuple(EXPANDED_SPACE), judged, OFFERED)


def a_session(page, **search):
    study = page.study("lift curve alone", DoorHandleCam(), DOOR_HANDLE_SPACE, JUDGEMENTS)
    return Session(study, DoorHandleCam(), JUDGEMENTS, SEARCH | search)


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def files():
    return sorted(os.listdir(".camkit"))


# ---------------------------------------------------------------- the search


def test_a_search_has_the_steps_of_its_session_and_its_files_go_with_the_last():
    page = a_page()
    search = page.search(a_session(page))
    numbers, feasible = [], []
    for step in search:
        numbers.append(step.number)
        feasible.append(step.feasible)
        assert [name.rpartition(".")[2] for name in files()] == ["gitignore", "json", "lock", "search"]
    assert numbers == list(range(1, 13))
    assert files() == [".gitignore"]
    assert_array_equal(step.front.x, nsga2(search.session.study, 20, 12, 4).x)
    assert_array_equal(search.reference, reference_point(search.session.study))
    assert search.unkept == ""


def test_a_search_that_is_left_is_resumed_by_its_own_page_alone():
    page = a_page()
    assert not page.can_resume()
    search = page.search(a_session(page))
    steps = iter(search)
    assert next(steps).number == 1
    assert not page.can_resume()  # somebody runs it
    assert next(steps).number == 2
    steps.close()
    assert page.can_resume()
    assert not a_page({"another": lift_curve_study()}).can_resume()
    assert not a_page(judged={"criteria": COLUMNS["criteria"]}).can_resume()
    resumed = page.resume(a_session(page, seed=9))
    assert (resumed.session.search, resumed.session.judgements) == (SEARCH, JUDGEMENTS)
    *_, last = resumed
    assert_array_equal(last.front.x, nsga2(search.session.study, 20, 12, 4).x)
    assert not page.can_resume()
    with pytest.raises(ValueError, match="there is no search that did not end"):
        page.resume(a_session(page))


def test_a_search_that_cannot_be_kept_says_why_and_runs():
    open(".camkit", "w", encoding="utf-8").close()
    page = a_page()
    search = page.search(a_session(page))
    assert search.unkept == ".camkit is not a folder"
    *_, last = search
    assert last.number == 12


def test_a_search_that_breaks_leaves_its_files_to_be_resumed():
    page = a_page()
    search = page.search(a_session(page))
    steps = iter(search)
    next(steps)
    with pytest.raises(KeyboardInterrupt):
        steps.throw(KeyboardInterrupt)
    assert page.can_resume()


def test_the_page_knows_its_own_search_from_another_of_the_same_name():
    page = a_page()
    search = page.search(a_session(page))
    *_, _ = search
    session = search.session  # as its file says it
    assert page.searches_as(session)
    assert not a_page(STUDIES | {"lift curve alone": door_handle_study()}).searches_as(session)
    assert not a_page({"whole cam": door_handle_study()}).searches_as(session)
    assert not SearchPage(OscillatingRollerCam(), STUDIES, (), COLUMNS, OFFERED).searches_as(session)


# ---------------------------------------------------------------- the session

REFUSED = {
    "a population that is not offered": ({"search": {"population": 1000}}, "1000 for 'population'"),
    "a rule that is not there": ({"search": {"rule": "dice"}}, "'dice' for 'rule'"),
    "judgements of two": ({"judgements": {"criteria": Judgements(["a", "b"], [1])}}, "not for 3 criteria"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_session_of_another_page_is_refused(name):
    page = a_page()
    page.check(a_session(page))
    changes, sentence = REFUSED[name]
    with pytest.raises(ValueError, match=sentence):
        page.check(replace(a_session(page), **changes))


def test_a_session_of_another_mechanism_is_refused():
    rollers = SearchPage(OscillatingRollerCam(), STUDIES, (), {}, OFFERED)
    with pytest.raises(ValueError, match="the file holds a door handle cam; an oscillating roller cam is wanted here"):
        rollers.check(a_session(a_page()))


def test_the_kind_of_a_page_is_what_it_is_made_of():
    kinds = {a_page().kind, a_page().kind, a_page({"another": lift_curve_study()}).kind, a_page(judged={}).kind}
    assert len(kinds) == 3
    assert all(kind.startswith("DoorHandleCam-") for kind in kinds)


# ---------------------------------------------------------------- the choice


@pytest.fixture(scope="module")
def front():
    study = lift_curve_study()
    x = np.linspace(*study.bounds, 400)
    found = study.evaluate(np.random.default_rng(1).permuted(x, axis=0))
    return front_of(found, study)


@pytest.mark.parametrize("rule", CHOOSERS)
def test_the_winner_is_the_rules_own_and_said_with_its_units(front, rule):
    choice = FrontChoice(front, rule, np.array([0.7, 0.3]))
    assert choice.winner == CHOOSERS[rule](front, np.array([0.7, 0.3]))
    winner, free = choice.verdict()
    assert f"winner: design {choice.winner} of 0 to " in plain(winner)
    assert f"lift arm {front.x[choice.winner, 0] / mm:.4g}"[:11] in free
    assert choice.summary().splitlines()[0] == f"{len(front)} designs on the front; winner by {rule}:"
    assert len(choice.summary().splitlines()) == 3


def test_what_one_objective_costs_the_other_at_a_design(front):
    i = len(front) // 2
    first, second = front.study.minimise
    cost = 0.01 * front.rates(i)[0, 1]  # the first, the effort, has no unit
    assert cost > 0
    assert costs(front, [0, i]) == [
        f"At design {i}: 0.01 less {first.name} costs {second.text(cost)} less {second.name}."
    ]


def test_a_front_without_a_design_has_no_winner():
    study = lift_curve_study()
    choice = FrontChoice(Front(study, np.zeros((0, len(study.free))), np.zeros((0, 2)), "no luck"))
    assert choice.winner is None
    assert choice.verdict() == ["no luck"]
    assert choice.summary() == "no front: no luck"


def test_a_design_is_found_on_the_front_that_it_is_of(front):
    assert len(front) > 3
    assert [place_on(front, front[i]) for i in range(len(front))] == list(range(len(front)))
    assert place_on(front, front[1].replace(lift_arm=front[1].lift_arm * (1 + 1e-7))) is None


# ---------------------------------------------------------------- quiet, and debounced


def test_what_a_panel_moves_itself_is_not_heard_but_what_another_thread_moves_is():
    quiet, heard = Quiet(), []
    act = quiet.unless(heard.append)
    with quiet:
        with quiet:
            act("inside")
        act("still inside")
        other = threading.Thread(target=act, args=("meanwhile",))
        other.start()
        other.join()
    act("after")
    assert heard == ["meanwhile", "after"]
    with pytest.raises(ZeroDivisionError), quiet:
        _ = 1 / 0
    act("after an error")
    assert heard[-1] == "after an error"


def test_what_is_debounced_is_done_at_once_when_it_has_to_settle():
    done = []
    later = Debounced(lambda: done.append(later.waiting), 60)
    later.settle()
    assert done == []
    later.ask()
    later.settle()
    later.settle()
    assert done == [False]
    assert not later.waiting


def test_a_session_search_without_files_runs_all_the_same():
    page = a_page()
    *_, last = SessionSearch(a_session(page))
    assert_allclose(last.front.f, nsga2(a_session(page).study, 20, 12, 4).f, rtol=1e-9)
