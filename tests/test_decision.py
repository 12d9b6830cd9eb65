"""Decisions against published judgements, consistent matrices, worked cases and brute force."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from pymoo.operators.survival.rank_and_crowding.metrics import calc_crowding_distance

from camkit import ahp, crowding, topsis, weighted_sum
from camkit.cam.door_handle import PAPER_JUDGEMENTS
from camkit.decision import CHOOSERS, RANDOM_INDEX, SAATY_SCALE, crowding_distance, judgement_matrix
from camkit.reference import load

# AHPy 2.1, tests and README.
DRINKS = [
    [1, 9, 5, 2, 1, 1, 1 / 2],
    [1 / 9, 1, 1 / 3, 1 / 9, 1 / 9, 1 / 9, 1 / 9],
    [1 / 5, 3, 1, 1 / 3, 1 / 4, 1 / 3, 1 / 9],
    [1 / 2, 9, 3, 1, 1 / 2, 1, 1 / 3],
    [1, 9, 4, 2, 1, 2, 1 / 2],
    [1, 9, 3, 1, 1 / 2, 1, 1 / 3],
    [2, 9, 9, 3, 2, 3, 1],
]
LEADER = [4, 3, 7, 1 / 3, 3, 5]


@pytest.mark.parametrize(
    ("judgements", "weights", "ratio"),
    [
        (DRINKS, [0.177, 0.019, 0.042, 0.116, 0.190, 0.129, 0.327], 0.022),
        (LEADER, [0.548, 0.127, 0.270, 0.056], 0.044),
    ],
    ids=["drinks", "leader"],
)
def test_published_judgements(judgements, weights, ratio):
    got, got_ratio = ahp(judgements)
    assert got.round(3).tolist() == weights
    assert round(got_ratio, 3) == ratio


def test_the_door_handle_papers_judgements():
    weights, ratio = ahp(PAPER_JUDGEMENTS)
    assert_allclose(weights, [5 / 7, 1 / 7, 1 / 7], rtol=1e-12)
    assert ratio == pytest.approx(0, abs=1e-12)
    assert_allclose(ahp(load("door_handle")["judgements"]).weights, weights)


def test_the_random_index_is_saatys():
    assert RANDOM_INDEX == (0, 0, 0.58, 0.90, 1.12, 1.24, 1.32, 1.41, 1.45, 1.49)
    assert sorted({*range(1, 10), *(1 / k for k in range(1, 10))}) == list(SAATY_SCALE)


def test_ratio_and_index_are_saatys_definition():
    judgement = ahp(LEADER)
    largest = max(np.linalg.eigvals(judgement.matrix).real)
    assert judgement.lambda_max == pytest.approx(largest)
    assert judgement.consistency_index == pytest.approx((largest - 4) / 3)
    assert judgement.consistency_ratio == pytest.approx((largest - 4) / 3 / 0.90)
    assert_allclose(judgement.matrix @ judgement.weights, largest * judgement.weights)


weight_lists = st.lists(st.floats(0.05, 20), min_size=1, max_size=10)


@given(weight_lists, st.sampled_from(["eigenvector", "geometric"]))
@settings(deadline=None)
def test_consistent_judgements_give_back_their_weights(weights, method):
    w = np.array(weights)
    judgement = ahp(w[:, None] / w, method)
    assert_allclose(judgement.weights, w / w.sum(), rtol=1e-9)
    assert judgement.consistency_ratio == pytest.approx(0, abs=1e-9)
    assert judgement.consistency_index >= 0


said = st.sampled_from(SAATY_SCALE)


@given(st.lists(said, min_size=3, max_size=3) | st.lists(said, min_size=6, max_size=6))
@settings(deadline=None)
def test_any_judgements_of_saatys_scale(upper):
    judgement = ahp(upper)
    n = len(judgement.weights)
    assert judgement.weights.sum() == pytest.approx(1)
    assert (judgement.weights > 0).all()
    assert judgement.lambda_max >= n - 1e-9
    assert_allclose(ahp(judgement.matrix.tolist()).weights, judgement.weights)
    if n == 3:  # for three criteria both methods agree (Saaty and Vargas 1984)
        assert_allclose(ahp(upper, "geometric").weights, judgement.weights, rtol=1e-6)
    swapped = ahp(judgement.matrix[::-1, ::-1])
    assert_allclose(swapped.weights[::-1], judgement.weights, rtol=1e-6)


def test_an_upper_triangle_is_read_row_by_row():
    assert_array_equal(judgement_matrix(LEADER)[0], [1, 4, 3, 7])
    assert_array_equal(judgement_matrix(LEADER)[1], [1 / 4, 1, 1 / 3, 3])
    assert_array_equal(judgement_matrix(LEADER)[:, 3], [7, 3, 5, 1])
    assert judgement_matrix([7]).tolist() == [[1, 7], [1 / 7, 1]]


def test_the_worst_judgement_is_the_one_that_was_spoiled():
    w = np.array([0.4, 0.3, 0.2, 0.1])
    for i, j in ((0, 1), (0, 3), (2, 3)):
        a = w[:, None] / w
        a[i, j], a[j, i] = a[i, j] * 6, a[j, i] / 6
        judgement = ahp(a)
        assert judgement.worst == (i, j)
        assert judgement.consistency_ratio > 0.1


# ---------------------------------------------------------------- choosing from a front

cents = st.integers(-10000, 10000).map(lambda x: x / 100)
fronts = arrays(float, st.tuples(st.integers(1, 12), st.integers(2, 3)), elements=cents)


def lonely(f):
    """Crowding distance from its definition, one member and one objective at a time."""
    total = np.zeros(len(f))
    for k in range(f.shape[1]):
        order = sorted(range(len(f)), key=lambda i: f[i, k])
        span = f[order[-1], k] - f[order[0], k] or 1
        for place, i in enumerate(order):
            if place in (0, len(order) - 1):
                total[i] = np.inf
            else:
                total[i] += (f[order[place + 1], k] - f[order[place - 1], k]) / span
    return total


@given(fronts)
@settings(deadline=None)
def test_crowding_distance_is_its_definition(f):
    assert_allclose(crowding_distance(f), lonely(f), rtol=1e-9, atol=1e-12)


@given(st.lists(st.floats(0, 1).map(lambda x: round(x, 3)), min_size=3, max_size=20, unique=True))
@settings(deadline=None)
def test_crowding_distance_is_pymoos(xs):
    f = np.array([[x, (1 - x) ** 2] for x in xs])
    assert_allclose(crowding_distance(f), 2 * calc_crowding_distance(f), rtol=1e-9)
    inner = np.where(np.isfinite(lonely(f)), lonely(f), -1)
    assert inner[crowding(f)] == pytest.approx(inner.max())


def test_crowding_takes_an_inner_design_if_there_is_one():
    assert crowding([[0, 1], [0.1, 0.8], [0.5, 0.2], [1, 0]]) == 2
    assert crowding([[0, 1], [1, 0]]) == 0
    assert crowding([[3, 4]]) == 0
    assert crowding([[0, 1], [0.5, 0.5], [1, 0]]) == 1


# Objectives and, worked out by hand with weights 3/4 and 1/4 after scaling to 0 .. 1, distances to best and worst:
#   (10, 400) -> (0,    1   ) -> weighted (0,    0.25)   best 0.2500, worst 0.7500   closeness 0.7500
#   (12, 300) -> (0.2,  0.5 ) -> weighted (0.15, 0.125)  best 0.1953, worst 0.6129   closeness 0.7584
#   (15, 220) -> (0.5,  0.1 ) -> weighted (0.375,0.025)  best 0.3758, worst 0.4373   closeness 0.5378
#   (20, 200) -> (1,    0   ) -> weighted (0.75, 0)      best 0.7500, worst 0.2500   closeness 0.2500
# with 1/4 and 3/4 the closenesses are 0.2500, 0.5291, 0.8248 and 0.7500; with equal weights 0.5, 0.6366, 0.6688, 0.5.
WORKED = np.array([[10, 400], [12, 300], [15, 220], [20, 200]])


@pytest.mark.parametrize(
    ("weights", "chosen"), [([3, 1], 1), ([1, 3], 2), ([1, 1], 2), (None, 2), ([1, 0], 0), ([0, 1], 3)]
)
def test_topsis_of_a_worked_case(weights, chosen):
    assert topsis(WORKED, weights) == chosen


# Weighted sums by hand: 3/4, 1/4: 0.25, 0.275, 0.4, 0.75; 1/4, 3/4: 0.75, 0.425, 0.2, 0.25; equal: 0.5, 0.35, 0.3, 0.5.
@pytest.mark.parametrize(
    ("weights", "chosen"), [([3, 1], 0), ([1, 3], 2), ([1, 1], 2), (None, 2), ([1, 0], 0), ([0, 1], 3)]
)
def test_weighted_sum_of_a_worked_case(weights, chosen):
    assert weighted_sum(WORKED, weights) == chosen


@given(fronts, st.sampled_from([crowding, topsis, weighted_sum]), st.integers(1, 9), st.integers(-9, 9))
@settings(deadline=None)
def test_the_unit_of_an_objective_does_not_sway_a_choice(f, choose, weight, power):
    weights = [weight] + [3] * (f.shape[1] - 1)
    scaled = np.column_stack([f[:, 0] * 2.0**power, f[:, 1:]])
    assert choose(scaled, weights) == choose(f, weights)


@pytest.mark.parametrize("choose", CHOOSERS.values(), ids=CHOOSERS.keys())
def test_every_chooser_takes_an_array_or_a_front_and_weights(choose):
    class Anything:
        f = WORKED

    assert choose(Anything()) == choose(WORKED) == choose(WORKED.tolist())
    assert choose(WORKED, [5, 2]) in range(4)
    assert type(choose(WORKED)) is int
    assert choose([[1.0, 1.0]] * 3) in range(3)  # all alike
    assert choose([[1.0, 1.0]]) == 0
