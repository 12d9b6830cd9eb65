"""Jobs in threads, and what becomes of them when a notebook's cell is run again."""

import subprocess
import sys
import threading
import time
from functools import cache
from types import SimpleNamespace

import pytest

from camkit import Measure, Study, explore
from camkit.machines.cam_lever import CamLever, cam_lever_study
from camkit.panels.cycle_time import cycle_time_panel
from camkit.panels.fronts import compare_fronts
from camkit.panels.kit import running
from camkit.panels.kit.running import RUNNING, Job, Place, here, left_behind
from camkit.panels.optimise import optimise_panel
from camkit.panels.pareto import pareto_panel
from camkit.search.protocol import search
from camkit.units import deg, mm
from camkit.views.picture import Axes, Picture


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Where searches are kept."""
    monkeypatch.chdir(tmp_path)


def slow(analysis):
    if threading.current_thread() is not threading.main_thread():
        time.sleep(0.02)
    return analysis.min_radius


least = Measure("least radius", "mm", slow)
GEOMETRY = {"max_radius": (100 * mm, 120 * mm), "lever": (210 * mm, 290 * mm)}


def view(analysis):
    return Picture.of(Axes())


ONE_WISH = Study(CamLever(), GEOMETRY, (least,), angles=31)
TWO_WISHES = ONE_WISH.replace(minimise=(least, Measure("largest radius", "mm", slow)))
INTERVAL = cam_lever_study(free_laws=False, angles=31).replace(minimise=(least,))


def endless(study):
    return search(study, "nsga2", population=20, generations=10_000, seed=1)


PANELS = {
    "improve": lambda app: optimise_panel(app, ONE_WISH, methods=("de",)),
    "shorten": lambda app: cycle_time_panel(app, INTERVAL, 1 * mm, 50 * deg, 61 * deg),
    "trade": lambda app: compare_fronts(app, {"all at once": (TWO_WISHES, endless)}),
}


@pytest.fixture(autouse=True)
def _nothing_goes_on():
    yield
    for job in RUNNING[:]:
        job.stop()
        job.thread.join(20)


@cache
def an_explorer(**changes):
    """Made once: to record its program takes longer than all else here."""
    return explore(CamLever(**changes), view)


def underway(panel):
    panel.run()
    assert not panel.runner.banner.visible, panel.runner.banner.text
    until = time.monotonic() + 20
    while not (panel.runner.job.step and panel.runner.job.step.evaluated >= 5) and time.monotonic() < until:
        time.sleep(0.01)
    assert panel.runner.stop_button.disabled is False
    return RUNNING[-1]


@pytest.mark.parametrize("make", PANELS.values(), ids=PANELS)
@pytest.mark.parametrize("cell", ["", "cell"], ids=["no cell", "a cell"])
def test_a_panel_that_is_made_anew_ends_the_job_of_the_one_before(make, cell, monkeypatch):
    at = iter([Place(cell, "first"), Place(cell, "first"), Place(cell, "second")])
    module = sys.modules["camkit.panels.kit.runner"]
    monkeypatch.setattr(module, "here", lambda: next(at))
    panel, beside = make(an_explorer()), make(an_explorer(lever=251 * mm))
    job = underway(panel)
    assert RUNNING[:] == [job]
    other = make(an_explorer())
    job.thread.join(20)
    assert not job.thread.is_alive()
    assert not RUNNING
    assert panel.runner.stop_button.disabled
    for one in (panel, beside, other):
        one.stop()
        one.wait(20)


def test_another_panel_leaves_a_job_alone():
    app, another = an_explorer(), an_explorer(lever=251 * mm)
    panel = optimise_panel(app, ONE_WISH, methods=("de",))
    job = underway(panel)
    optimise_panel(another, ONE_WISH, methods=("de",))
    optimise_panel(app, {"another": ONE_WISH}, methods=("de",))
    assert not panel.runner.job.stopping
    assert RUNNING[:] == [job]
    panel.stop()
    panel.wait(20)
    assert not RUNNING


def test_which_jobs_a_panel_replaces():
    def job(kind, cell, run):
        return Job(kind, Place(cell, run), ())

    jobs = [
        job("a", "1", "x"),
        job("a", "2", "x"),
        job("b", "1", "x"),
        job("b", "1", "y"),
        job("a", "", ""),
        job("b", "", ""),
    ]
    RUNNING.extend(jobs)
    try:
        assert left_behind("a", Place("1", "y")) == [jobs[0], jobs[2], jobs[4]]
        assert left_behind("a", Place("1", "z")) == [jobs[0], jobs[2], jobs[3], jobs[4]]
        assert left_behind("b", Place("3", "z")) == [jobs[5]]
        assert left_behind("b", Place("", "")) == [jobs[2], jobs[3], jobs[5]]
    finally:
        RUNNING.clear()


def test_a_job_that_breaks_is_not_running(monkeypatch):
    monkeypatch.setattr(threading, "excepthook", lambda _: None)
    job = Job("a", here(), (1 / 0 for _ in range(1)))
    job.start()
    job.thread.join(10)
    assert not RUNNING


def test_a_front_is_shown_whole_before_the_search_shows_the_next(tmp_path, monkeypatch):
    """Another rule is asked for while the search goes on, which shows its fronts from a thread of its own."""
    monkeypatch.chdir(tmp_path)
    asked, alone = threading.Event(), []

    def radius(analysis):
        if asked.is_set() and threading.current_thread() is threading.main_thread():
            before = panel.front
            time.sleep(4 * running.REPORT)
            alone.append(panel.front is before)
        return slow(analysis)

    two = TWO_WISHES.replace(minimise=(Measure("radius", "mm", radius), TWO_WISHES.minimise[1]))
    panel = pareto_panel(an_explorer(), two, population=20, generations=10_000)
    panel.run()
    until = time.monotonic() + 20
    while not len(panel.front) and time.monotonic() < until:
        time.sleep(0.01)
    asked.set()
    panel.picker.rule.value = panel.picker.rule.options[2]
    assert alone
    assert all(alone)


def test_a_cell_is_known_by_what_the_notebook_says(monkeypatch):
    assert here() == Place("", "")
    message = {"header": {"msg_id": "7"}, "metadata": {"cellId": "abc"}}
    monkeypatch.setattr(running, "get_ipython", lambda: SimpleNamespace(parent_header=message))
    assert here() == Place("abc", "7")
    del message["metadata"]
    assert here() == Place("", "7")
    monkeypatch.setattr(running, "get_ipython", lambda: SimpleNamespace())
    assert here() == Place("", "")


ENDS = """
import time
from camkit.panels.kit.running import Job
Job("a", ("", ""), (time.sleep(0.1) for _ in range(1))).start()
"""


def test_a_python_that_ends_waits_for_a_job():
    assert subprocess.run([sys.executable, "-c", ENDS], timeout=60).returncode == 0
