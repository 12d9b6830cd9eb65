"""How far a crank turns, and positions away from the sweep: against a fine sampling of the discriminant."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from camkit.linkage.rssr import RSSR
from camkit.linkage.rssr_analysis import NEXT_TO
from camkit.machines.cabin_door import Branch, CabinDoorLinkage
from camkit.units import deg, mm

few = settings(max_examples=50, deadline=None)
length = st.floats(40, 200).map(lambda x: round(x, 1) * mm)
linkages = st.builds(
    RSSR,
    crank=length,
    coupler=st.floats(60, 400).map(lambda x: round(x, 1) * mm),
    rocker=length,
    crank_offset=st.floats(-200, 200).map(lambda x: round(x, 1) * mm),
    rocker_offset=st.floats(-200, 200).map(lambda x: round(x, 1) * mm),
    axis_distance=st.floats(0, 200).map(lambda x: round(x, 1) * mm),
    axis_angle=st.floats(-180, 180).map(lambda x: round(x, 1) * deg),
)
EXAMPLE = CabinDoorLinkage()


@few
@given(linkages, st.floats(-400, 700))
def test_a_crank_turns_to_the_limits_and_no_further(linkage, degrees):
    turn = round(degrees, 1) * deg
    assume(linkage.discriminant(turn) > 1e-3)
    a = linkage.analyse(turn)
    low, high = a.turn_range
    assert low < turn < high
    within = linkage.discriminant(np.linspace(low, high, 2001))
    assert within.min() > -1e-12
    if linkage.full_turn or high - low > 2 * np.pi - 4 * NEXT_TO:  # or its limits are one: it folds there
        assert high - low == pytest.approx(2 * np.pi)
    else:
        beyond = np.array([low, high]) + np.array([-1, 1]) * 3 * NEXT_TO
        assert (linkage.discriminant(beyond) < 1e-9).all()


@few
@given(linkages, st.floats(0, 360), st.floats(-30, 30), st.sampled_from([1, -1]))
def test_every_turn_of_a_slider_can_be_shown(linkage, degrees, turn, branch):
    assume(linkage.discriminant(degrees * deg) > 1e-3)
    a = linkage.analyse(degrees * deg, branch)
    here, there = a.at(turn), a.at(turn, -branch)
    assert np.isfinite(here.chain).all()
    low, high = a.turn_range
    assert here.crank_angle[0] == there.crank_angle[0] == min(max(turn, low), high)
    assert (here.branch, there.branch) == (branch, -branch)


def test_a_sweep_turns_about_its_middle_or_to_its_limits():
    turns = RSSR(20 * mm, 180 * mm, 110 * mm, 120 * mm, 80 * mm).analyse(np.linspace(20, 80, 7) * deg)
    assert np.degrees(turns.turn_range) == pytest.approx([50 - 180, 50 + 180])
    low, high = EXAMPLE.linkage.possible_crank_angles()[0]
    for sweep in (np.linspace(low, high, 31), np.array([low, low + 1 * deg]), np.array([high - 1 * deg, high])):
        a = EXAMPLE.linkage.analyse(sweep)
        assert a.turn_range == pytest.approx([low, high], abs=2 * NEXT_TO)
        assert a.possible_turn == pytest.approx(high - low, abs=1e-9)


def test_a_position_is_that_of_the_sweep():
    a = EXAMPLE.replace(branch=-1).analyse(7)
    for i in (0, 3, 6):
        here = a.at(a.crank_angle[i])
        np.testing.assert_allclose(here.chain[..., 0], a.chain[..., i])
        assert here.crank_torque[0] == pytest.approx(a.crank_torque[i])


def test_one_turn_position_by_position():
    a = EXAMPLE.analyse(91)
    turn = a.one_turn()
    crank, rocker = turn.crank_angle[:, 0], turn.rocker_angle[:, 0]
    assert np.degrees(crank[[0, -1]]) == pytest.approx([-120, 240])
    assert (np.diff(crank) >= 0).all()
    np.testing.assert_array_equal(np.isnan(rocker), ~EXAMPLE.linkage.assembles(crank))
    for angle, expected in zip(a.crank_angle[::30], a.rocker_angle[::30], strict=True):
        i = np.argmin(abs(crank - angle))
        assert rocker[i] == pytest.approx(expected, abs=1e-9)
    # the branches come together at both limits: 265.623052 and 274.376948 deg, a turn lower
    other = a.one_turn(-1).rocker_angle[:, 0]
    ends = np.flatnonzero(np.diff(np.isnan(rocker).astype(int)))
    last, first = ends[0], ends[1] + 1
    assert np.degrees(crank[[last, first]]) == pytest.approx([265.623052 - 360, 274.376948 - 360], abs=1e-5)
    apart = np.mod(rocker[[last, first]] - other[[last, first]] + np.pi, 2 * np.pi) - np.pi
    assert apart == pytest.approx(0, abs=0.01)


def test_the_branch_may_be_named_or_counted():
    assert EXAMPLE.branch is Branch.plus
    assert EXAMPLE.replace(branch=-1) == EXAMPLE.replace(branch=Branch.minus)
    assert EXAMPLE.replace(branch=-1).analyse(3).branch == -1
    with pytest.raises(ValueError, match=r"^the branch is 'plus'; it must be \+1 or -1$"):
        EXAMPLE.replace(branch="plus")
