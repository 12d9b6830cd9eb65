"""Panels that optimise and that shorten a cycle: progress, Stop, and Resume to the result that there is without one."""

import json
import os
import signal
import subprocess
import sys
import textwrap
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import explore, minimise
from camkit.machines import HighSpeedCam, cam_lever_study, high_speed_study
from camkit.machines.cam_lever import CamLever
from camkit.machines.high_speed_measures import peak_stress
from camkit.panels.cycle_time import cycle_time_panel
from camkit.panels.optimise import optimise_panel
from camkit.search.cycle_time import shortest_interval
from camkit.units import cm, deg

HIGH = high_speed_study(angles=41)
LEVER = cam_lever_study(free_laws=False).replace(angles=41)
CYCLE = {"limit": 9 / cm**0.5, "shortest": 50 * deg, "longest": 61 * deg}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Where searches are kept."""
    monkeypatch.chdir(tmp_path)
    return tmp_path / ".camkit"


def optimiser(study=HIGH, starts=4):
    panel = optimise_panel(explore(HighSpeedCam()), study)
    panel.starts.value = starts
    return undrawn(panel)


def shortener(study=LEVER):
    return undrawn(cycle_time_panel(explore(CamLever()), study, *CYCLE.values()))


def undrawn(panel):
    """Each step is shown here, of which nobody looks at the picture."""
    panel.picture.show = lambda shown: None
    return panel


def stop_at(panel, number):
    """Let a search run until so many of its parts have ended, and stop it."""
    job_shows, numbers = panel.runner.show, []

    def show(step, last):
        job_shows(step, last)
        if step.number >= number and not last:
            numbers.append((panel.runner.progress.value, panel.runner.progress.max, panel.runner.left.value))
            panel.stop()

    panel.runner.show = show
    panel.run()
    panel.wait(60)
    return numbers[-1]


@pytest.fixture(autouse=True)
def shown_at_once(monkeypatch):
    monkeypatch.setattr("camkit.panels.kit.running.REPORT", -1.0)


def test_an_optimisation_goes_on_in_another_panel():
    first = optimiser()
    assert first.resuming.button.disabled
    value, most, left = stop_at(first, 2)
    assert (value, most) == (2, 5)
    assert left[0].endswith(" left")
    assert not first.resuming.button.disabled
    assert first.minimum is None
    assert "stopped" in first.summary()
    second = optimiser(starts=1)
    assert not second.resuming.button.disabled
    second.resuming.resume()
    second.wait(60)
    assert second.starts.value == 4
    expected = minimise(HIGH, starts=4)
    assert_array_equal(second.minimum.x, expected.x)
    assert second.minimum.message == expected.message
    assert (second.runner.progress.value, second.runner.progress.max) == (5, 5)
    assert second.resuming.button.disabled
    first.resuming.resume()
    assert "there is no search that did not end" in first.banner.value[0]


def test_it_goes_on_from_the_design_that_it_began_with():
    first = optimiser()
    first.explorer.load(first.explorer.design.replace(arm_length=0.2))
    stop_at(first, 1)
    second = optimiser()
    here = second.explorer.design
    second.resuming.resume()
    second.wait(60)
    assert second.study.start.arm_length == 0.2
    assert second.before == here, "Undo loads what was in the sliders"
    assert_array_equal(second.minimum.x, minimise(HIGH.around(here.replace(arm_length=0.2)), starts=4).x)


def test_a_cycle_goes_on_to_the_same_interval():
    panel = shortener()
    value, most, _ = stop_at(panel, 3)
    assert value == 3 < most
    tried = len(panel.steps)
    other = shortener()
    other.resuming.resume()
    other.wait(60)
    *_, expected = shortest_interval(LEVER, **CYCLE)
    assert len(other.steps) > tried
    assert other.step.high == expected.high
    assert other.step.words == expected.words
    assert_array_equal(other.step.best.x, expected.best.x)


def test_panels_of_other_studies_do_not_offer_it():
    stop_at(optimiser(), 1)
    assert optimiser(HIGH.replace(at_most={peak_stress: 1e9})).resuming.button.disabled
    assert shortener().resuming.button.disabled


def test_a_damaged_page_is_refused_in_a_sentence(folder):
    panel = optimiser()
    stop_at(panel, 1)
    (page,) = folder.glob("optimise-*.json")
    text = page.read_text()
    for damaged in (
        "no JSON",
        json.dumps(json.loads(text) | {"boxes": {}}),
        json.dumps(json.loads(text) | {"design": "{}"}),
        text.replace('"slsqp"', '"none"'),
        text.replace('"starts": 4', '"starts": "4"'),
    ):
        page.write_text(damaged)
        panel.resuming.resume()
        assert f"This cannot be resumed: the file {page.name} is damaged; delete it" in panel.banner.value[0]
        assert not panel.runner.running


def test_a_damaged_checkpoint_is_told(folder):
    panel = optimiser()
    stop_at(panel, 1)
    (kept,) = folder.glob("optimise-*.search")
    kept.write_text("no checkpoint\n")
    panel.resuming.resume()
    panel.wait(60)
    assert f"the checkpoint {kept.name} is damaged; delete it" in panel.banner.value[0]


def test_a_killed_kernel_leaves_a_search_to_be_resumed(folder):
    program = textwrap.dedent("""
        import os, signal
        from camkit import explore
        from camkit.machines import HighSpeedCam, high_speed_study
        from camkit.panels.optimise import optimise_panel

        panel = optimise_panel(explore(HighSpeedCam()), high_speed_study(angles=41))
        panel.starts.value = 4
        show = panel.runner._show
        panel.runner._show = lambda step, last: os.kill(os.getpid(), 9) if step.number >= 2 else show(step, last)
        import camkit.panels.kit.running as running
        running.REPORT = -1.0
        panel.run()
        panel.wait(60)
    """)
    ended = subprocess.run([sys.executable, "-c", program], env=os.environ, check=False)
    assert ended.returncode == -signal.SIGKILL
    (kept,) = folder.glob("optimise-*.search")
    assert len(kept.read_bytes().splitlines()) >= 3
    panel = optimiser(starts=1)
    assert not panel.resuming.button.disabled
    panel.resuming.resume()
    panel.wait(60)
    assert_array_equal(panel.minimum.x, minimise(HIGH, starts=4).x)
    assert not list(folder.glob("optimise-*"))


def test_a_search_for_a_measure_of_ones_own_is_kept():
    own = replace(peak_stress, name="own", function=lambda a: 2 * a.stress)
    panel = optimiser(HIGH.replace(minimise=(own,)), starts=1)
    panel.run()
    panel.wait(60)
    assert not panel.resuming.steps.unkept
    assert np.isclose(panel.minimum.f, 2 * minimise(HIGH).f, rtol=1e-6)


def test_where_nothing_can_be_kept_the_search_goes_on_and_says_so(folder):
    Path(folder).write_text("a file", encoding="utf-8")
    panel = optimiser(starts=1)
    panel.run()
    panel.wait(60)
    assert "not kept in a file to resume it from: .camkit is not a folder" in panel.banner.value[0]
    assert panel.minimum.f == minimise(HIGH).f
