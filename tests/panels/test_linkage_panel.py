"""The panel of a linkage without a page: sliders of what a design holds, the crank's range, turning by hand."""

from functools import partial

import numpy as np
import pytest

from camkit import explore, try_everything
from camkit.files import from_json, to_json
from camkit.linkage.measures import SWEEP, max_pressure_angle, room_in
from camkit.machines.cabin_door import HOUSING, Branch, CabinDoorLinkage, ninety_degree_study
from camkit.units import deg, mm
from camkit.views.space import linkage_in_space, output_angle

START = ninety_degree_study().start
FREE = ("crank", "coupler", "branch", "load.mass", "load.lean", "load.torque")


@pytest.fixture(scope="module")
def one_panel():
    view = partial(linkage_in_space, inside=HOUSING)
    panel = explore(
        START, view, output_angle, free=FREE, measures=(max_pressure_angle, room_in(HOUSING), *SWEEP), turn=1.0
    )
    yield panel
    panel.picture.settle()  # no picture is left to be drawn after the tests


@pytest.fixture
def panel(one_panel):
    for name, value in (("turn", 1.0), ("azimuth", -60 * deg), ("elevation", 25 * deg)):
        one_panel.positions[name].set(value)
    one_panel.load(START)
    return one_panel


def test_sliders_reach_into_the_load(panel):
    panel.controls["load.mass"].box.value = 55
    panel.controls["load.lean"].box.value = 20
    panel.controls["crank"].box.value = 110
    load = START.load.replace(mass=55.0, lean=20 * deg)
    assert panel.design == START.replace(crank=110 * mm, load=load)
    assert panel.analysis.load == load
    assert from_json(to_json(panel.design)) == panel.design
    panel.load(START)
    assert panel.controls["load.mass"].box.value == 30


def test_the_load_refuses_in_its_own_words(panel):
    panel.controls["load.mass"].box.value = -1
    assert "the mass (what turns with the rocker, such as a door) is -1 kg" in panel.banner.value
    assert panel.design == START


def test_a_name_that_no_part_has_is_refused():
    with pytest.raises(ValueError, match=r"^'load\.mas' is no path of CabinDoorLinkage; near it are load\.mass, "):
        explore(START, linkage_in_space, free=["load.mas"])


def test_the_menu_changes_the_branch(panel):
    panel.controls["branch"].menu.value = Branch.minus
    assert panel.design == START.replace(branch=-1)
    assert panel.analysis.rocker_angle[0] == START.replace(branch=-1).analyse(3).rocker_angle[0]


def test_the_crank_slider_goes_as_far_as_the_crank(panel):
    knob = panel.positions["turn"]
    assert [knob.slider.min, knob.slider.max] == [-85.7, 265.7]  # -85.623 and 265.623
    knob.box.value = 230
    panel.controls["coupler"].box.value = 130
    low, high = panel.design.analyse().turn_range
    assert panel.design.coupler == 130 * mm
    ends = knob.slider.min * deg, knob.slider.max * deg
    assert ends == pytest.approx((low, high), abs=0.1 * deg)
    assert ends[0] <= low < high <= ends[1] == knob.value < 230 * deg
    panel.controls["coupler"].box.value = 180
    assert [knob.slider.min, knob.slider.max, knob.value] == [-85.7, 265.7, ends[1]]


def test_a_crank_that_turns_fully_has_a_whole_turn():
    joint = CabinDoorLinkage(50 * mm, 200 * mm, 130 * mm, 60 * mm, 50 * mm, 100 * mm)
    assert joint.linkage.full_turn
    panel = explore(joint, linkage_in_space, free=["crank"])
    knob = panel.positions["turn"]
    assert [knob.slider.min, knob.slider.max] == pytest.approx([-120, 240])


def test_a_pointer_turns_the_view_in_space_only(panel):
    azimuth, elevation = panel.positions["azimuth"], panel.positions["elevation"]
    height = np.divide(*panel.picture.figure.get_size_inches()[::-1])

    def pointed(kind, x, y):
        panel.picture.widget._handle_custom_msg({"kind": kind, "x": x, "y": y}, [])

    def at():
        return azimuth.value / deg, elevation.value / deg

    pointed("drag", 0.3, 0.5)
    assert at() == pytest.approx((-60, 25))
    pointed("press", 0.2, 0.5)
    pointed("drag", 0.3, 0.5)
    assert at() == pytest.approx((-60 - 36, 25))
    pointed("drag", 0.3, 0.6)
    assert at() == pytest.approx((-96, 25 + 36 * height))
    pointed("release", 0.3, 0.6)
    pointed("drag", 0.4, 0.6)
    assert at() == pytest.approx((-96, 25 + 36 * height))
    pointed("press", 0.95, 0.5)
    pointed("drag", 0.3, 0.6)
    assert at() == pytest.approx((-96, 25 + 36 * height))
    pointed("press", 0.2, 0.5)
    pointed("drag", 0.9, 0.0)
    assert at() == pytest.approx((180 - (96 + 252 - 180), max(25 + 36 * height - 180 * height, -90)))
    assert azimuth.slider.value == pytest.approx(azimuth.value / deg, abs=1)
    assert panel.design == START


def test_a_slider_shows_what_the_page_can_show(panel):
    """The steps count from the lower end; a number between two keeps its digits beside the slider."""
    crank = panel.controls["crank"]
    panel.load(START.replace(crank=119.243 * mm))
    assert crank.slider.value == pytest.approx(119.2, abs=1e-9)
    assert (crank.value, crank.box.value) == pytest.approx((119.243 * mm, 119.243), abs=1e-12)
    assert panel.design.crank == 119.243 * mm
    turn = panel.positions["turn"]
    turn.set(1.234)
    steps = (turn.slider.value - turn.slider.min) / turn.slider.step
    assert steps == pytest.approx(round(steps), abs=1e-6)
    turn.set(99.0)
    assert turn.slider.value == turn.slider.max


def test_every_control_moves_and_comes_back(panel):
    assert try_everything(panel) == "17 controls moved"
    assert panel.design == START
