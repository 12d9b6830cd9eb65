"""The panel of a linkage without a page: sliders of what a design holds, the crank's range, turning by hand."""

from functools import partial

import pytest
from hand import at, choose, move
from try_everything import try_everything

from camkit import explore
from camkit.files import from_json, to_json
from camkit.linkage.measures import SWEEP, max_pressure_angle, room_in
from camkit.machines.cabin_door import HOUSING, Branch, ninety_degree_study
from camkit.units import deg, mm
from camkit.views.space import linkage_in_space, output_angle

START = ninety_degree_study().start
FREE = ("crank", "coupler", "branch", "load.mass", "load.lean", "load.torque")


@pytest.fixture(scope="module")
def one_panel():
    view = partial(linkage_in_space, inside=HOUSING)
    measures = (max_pressure_angle, room_in(HOUSING), *SWEEP)
    return explore(START, view, output_angle, free=FREE, measures=measures, turn=1.0)


@pytest.fixture
def panel(one_panel):
    one_panel.load(START)
    return one_panel


def test_sliders_reach_into_the_load(panel):
    move(panel, "load.mass", 55)
    move(panel, "load.lean", 20)
    move(panel, "crank", 110)
    load = START.load.replace(mass=55.0, lean=20 * deg)
    assert panel.design == START.replace(crank=110 * mm, load=load)
    assert panel.analysis.load == load
    assert from_json(to_json(panel.design)) == panel.design
    panel.load(START)
    assert at(panel, "load.mass") == 30


def test_the_load_refuses_in_its_own_words(panel):
    move(panel, "load.mass", -1)
    assert panel.design == START
    panel.load(START)
    panel.load_json(to_json(START).replace("30.0", "-1.0"))
    assert "the mass (what turns with the rocker, such as a door) is -1 kg" in panel.message


def test_a_name_that_no_part_has_is_refused():
    with pytest.raises(ValueError, match=r"^'load\.mas' is no path of CabinDoorLinkage; near it are load\.mass, "):
        explore(START, linkage_in_space, free=["load.mas"])


def test_the_menu_changes_the_branch(panel):
    choose(panel, "branch", Branch.minus)
    assert panel.design == START.replace(branch=-1)
    assert panel.analysis.rocker_angle[0] == START.replace(branch=-1).analyse(3).rocker_angle[0]


def test_every_control_moves_and_comes_back(panel):
    assert try_everything(panel) == len(FREE)
    assert panel.design == START
