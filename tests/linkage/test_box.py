"""Boxes against points sampled along the links."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit.linkage.measures import clearance_from, room_in
from camkit.linkage.rssr import RSSR
from camkit.linkage.space import Box
from camkit.units import deg, mm

coordinate = st.floats(-2, 2).map(lambda x: round(x, 2))
point = st.tuples(coordinate, coordinate, coordinate).map(np.array)
BOX = Box((-0.5, 0.0, -1.0), (0.7, 0.4, 0.3))


def farthest_wall(points):
    """How far ``points`` ``(3, n)`` lie beyond the wall that they pass most; < 0 inside."""
    low, high = np.array(BOX.low)[:, None], np.array(BOX.high)[:, None]
    return np.maximum(low - points, points - high).max(0)


@settings(max_examples=100, deadline=None)
@given(point, point)
def test_clearance_of_a_link_is_that_of_its_nearest_point(start, end):
    along = start[:, None] + (end - start)[:, None] * np.linspace(0, 1, 4001)
    sampled = farthest_wall(along).min()
    found = BOX.clearance(start, end)
    assert found <= sampled + 1e-12
    assert found == pytest.approx(sampled, abs=np.abs(end - start).max() / 4000 + 1e-12)


@given(point)
def test_depth_of_a_point(one):
    assert BOX.depth(one) == pytest.approx(-farthest_wall(one[:, None])[0])
    assert BOX.clearance(one, one) == pytest.approx(-BOX.depth(one))


def test_links_of_a_sweep_and_of_a_population():
    sweep = np.linspace(15, 105, 30) * deg
    cranks = np.array([[80.0], [100.0], [400.0]]) * mm
    housing = Box((-130 * mm, -20 * mm, -10 * mm), (130 * mm, 150 * mm, 150 * mm), "the housing")
    wall = Box((20 * mm, 60 * mm, 20 * mm), (60 * mm, 100 * mm, 70 * mm), "the wall")
    together = RSSR(crank=cranks).analyse(sweep)
    assert room_in(housing)(together).shape == clearance_from(wall)(together).shape == (3,)
    assert np.isnan(room_in(housing)(together)[2])
    assert np.isnan(clearance_from(wall)(together)[2])
    for i in (0, 1):
        one = RSSR(crank=float(cranks[i, 0])).analyse(sweep)
        ends = one.chain.reshape(3, -1)
        room = min((ends - np.reshape(housing.low, (3, 1))).min(), (np.reshape(housing.high, (3, 1)) - ends).min())
        assert room_in(housing)(one) == pytest.approx(room)
        assert room_in(housing)(together)[i] == pytest.approx(room)
        share = np.linspace(0, 1, 501)[:, None, None]
        points = np.concatenate(
            [
                a + share * (b - a)
                for a, b in zip(np.moveaxis(one.chain, 1, 0)[:-1], np.moveaxis(one.chain, 1, 0)[1:], strict=True)
            ]
        )
        low, high = (np.reshape(corner, (3, 1)) for corner in (wall.low, wall.high))
        clearance = np.maximum(low - points, points - high).max(1).min()
        assert clearance_from(wall)(one) == pytest.approx(clearance, abs=0.5 * mm)
        assert clearance_from(wall)(together)[i] == pytest.approx(float(clearance_from(wall)(one)))


@pytest.mark.parametrize("corner", [(0, 0.5, 1), (0, 0.4, np.nan), (0, 0.4, np.inf)])
def test_a_box_has_its_corners_in_order(corner):
    with pytest.raises(ValueError, match=r"^the wall goes from .* mm along [yz]; both must be finite, the first below"):
        Box(corner, (1, 0.5, 2), "the wall")
