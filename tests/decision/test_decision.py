"""Decisions against published judgements, consistent matrices, worked cases and brute force."""

import math
from itertools import combinations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from pymoo.operators.survival.rank_and_crowding.metrics import calc_crowding_distance
from scipy.optimize import minimize, minimize_scalar

from camkit import ahp, most_isolated, topsis, weighted_sum
from camkit.data import load
from camkit.decision import (
    CHOOSERS,
    RANDOM_INDEX,
    SAATY_SCALE,
    WEIGHING,
    Judgements,
    achievement,
    crowding_distance,
    judged_weights,
    judgement_ranges,
    knee,
    normalised,
    random_index,
    weight_lattice,
    winner_map,
)
from camkit.machines.door_handle import PAPER_JUDGEMENTS

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


def matrix_of(judgements):
    return ahp(judgements).array


NAMED = Judgements(("taste", "price", "smell"), ["3", None, "1/2"])


def test_judgements_are_one_value_however_they_are_given():
    matrix = [[1, 3, None], ["1/3", 1, 0.5], ["?", 2, 1]]
    for shape in (NAMED.matrix, NAMED.array, matrix, [3, None, 0.5], (3.0, math.nan, 0.5)):
        again = Judgements(["taste", "price", "smell"], shape)
        assert (again, hash(again), again.note) == (NAMED, hash(NAMED), "")
    assert NAMED.above == (3.0, None, 0.5)
    assert NAMED.names == ("taste", "price", "smell")
    assert ahp(NAMED) is NAMED
    assert ahp(NAMED, "geometric") == Judgements(NAMED.names, NAMED.matrix, "geometric") != NAMED
    assert ahp([3]).names == ("criterion 1", "criterion 2")
    with pytest.raises(AttributeError):
        NAMED.method = "geometric"


def test_a_gap_is_filled_by_what_the_others_imply_and_a_pair_judged_anew():
    """3 times as much as the price, which matters half as much as the smell: 3/2 of the smell."""
    assert NAMED.complete().above == pytest.approx((3, 1.5, 0.5))
    assert_allclose(NAMED.weights, np.array([3, 1, 2]) / 6)
    assert (NAMED.missing, NAMED.complete().missing) == (1, 0)
    assert NAMED.consistency_ratio == pytest.approx(0, abs=1e-12)
    assert NAMED.judging((0, 2), "1,5") == Judgements(NAMED.names, [3, 1.5, 0.5])
    assert NAMED.judging((0, 2), "1,5").judging((0, 2), None) == NAMED
    with pytest.raises(ValueError, match="no judgement connects taste with price, smell; judge one such"):
        NAMED.judging((0, 1), None)


@pytest.mark.parametrize("rule", CHOOSERS)
def test_a_chooser_takes_judgements_for_weights(rule):
    front, judgements = [[0, 1], [0.1, 0.3], [0.2, 0.2], [1, 0]], Judgements(("a", "b"), ["1/4"])
    assert CHOOSERS[rule](front, judgements) == CHOOSERS[rule](front, [0.2, 0.8])
    if rule in WEIGHING:
        assert judgement_ranges(front, judgements, CHOOSERS[rule]) == judgement_ranges(front, [0.25], CHOOSERS[rule])


@pytest.mark.parametrize(
    ("names", "matrix", "method", "sentence"),
    [
        (["a", "b"], [1, 2, 3], "eigenvector", "there are 3 rows of judgements for 2 criteria"),
        ("ab", [1], "eigenvector", "the list of names is 'ab'; it must be a tuple, with a place for each criterion"),
        (["a", 5], [1], "eigenvector", "the name of a criterion is 5; it must be a text"),
        (["<b>"] * 2, [3], "eigenvector", "two criteria have the name '<b>'; each must have a name of its own"),
        (["a", "b"], ["x"], "eigenvector", "'x' is no number above 0; 3, 1/5 or 0.4 are"),
        (["a", "b"], [3], "mean", "the method is 'mean'; there are 'eigenvector' and 'geometric'"),
    ],
)
def test_judgements_that_cannot_be_are_refused_in_a_sentence(names, matrix, method, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        Judgements(names, matrix, method)


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
    assert [random_index(n) for n in range(1, 11)] == list(RANDOM_INDEX)
    assert [random_index(n) for n in (11, 15)] == pytest.approx([1.5118, 1.5855], abs=1e-4)  # Alonso, Lamata (2006)
    assert sorted({*range(1, 10), *(1 / k for k in range(1, 10))}) == list(SAATY_SCALE)


@pytest.mark.parametrize(("n", "width"), [(3, 0.12), (6, 0.012), (10, 0.006), (12, 0.004), (20, 0.006), (30, 0.008)])
def test_the_random_index_is_the_mean_of_random_judgements(n, width):
    """Of matrices of his scale, their largest eigenvalue by LAPACK; Saaty's own 0.58 for three is a tenth too large."""
    i, j = np.triu_indices(n, 1)
    drawn = np.random.default_rng(n).choice(SAATY_SCALE, (4000, len(i)))
    matrices = np.ones((4000, n, n))
    matrices[:, i, j], matrices[:, j, i] = drawn, 1 / drawn
    largest = np.linalg.eigvals(matrices[:: 1 if n < 20 else 8]).real.max(-1)
    assert random_index(n) == pytest.approx((largest.mean() - n) / (n - 1), rel=width, abs=0.005)


def test_twelve_criteria_one_judgement_three_times_too_large():
    w = np.arange(1, 13.0)
    a = w[:, None] / w
    a[0, -1], a[-1, 0] = 3 * a[0, -1], a[-1, 0] / 3
    judgement = ahp(a)
    assert judgement.lambda_max == pytest.approx(12.091201, abs=5e-7)
    assert judgement.consistency_index == pytest.approx(0.008291, abs=5e-7)
    assert judgement.weights[[0, -1]] == pytest.approx([0.014923, 0.145184], abs=5e-7)
    assert judgement.consistency_ratio == pytest.approx(0.008291 / 1.535, rel=1e-3)
    assert judgement.worst == {(0, 11): pytest.approx(1 / 12)}


def test_reciprocals_as_papers_print_them():
    """0.33 and 0.14 beside 3 and 7; the exact matrix is told by its larger entries."""
    judgement = ahp([[1, 3, 7], [0.33, 1, 5], [0.14, 0.2, 1]])
    assert judgement.weights == pytest.approx([0.649118, 0.278955, 0.071927], abs=5e-7)
    assert judgement.consistency_ratio == pytest.approx(0.0559, abs=5e-5)
    assert judgement.note == "rounded reciprocals are read as exact ones: 0.33 as 1/3, 0.14 as 1/7"
    assert ahp([3, 7, 5]).note == ""
    assert_array_equal(judgement.array, matrix_of([3, 7, 5]))
    assert_array_equal(matrix_of([[1, 0.33], [3, 1]]), matrix_of([1 / 3]))


@given(st.integers(2, 9), st.integers(2, 5), st.booleans())
@settings(deadline=None)
def test_any_number_of_decimals_rounded_or_cut_off(more, decimals, cut):
    step = 10.0**-decimals
    less = 10**decimals // more / 10**decimals if cut else round(1 / more, decimals)
    assert matrix_of([[1, more], [less, 1]])[0, 1] == more
    for wrong in (less + 2 * step, less - 2 * step):
        assume(round(wrong, decimals) != round(wrong, decimals - 1))  # 0.140 reads as 0.14, which is 1/7
        with pytest.raises(ValueError, match="one must be 1 over the other"):
            ahp([[1, more], [round(wrong, decimals), 1]])


@pytest.mark.parametrize(
    ("more", "less"),
    [(8, 0.13), (8, 0.12), (6, 0.17), (6, 0.16), (7, 0.143), (1.06, 0.95), (1.06, 0.94), (2.47, 0.4), (1.25, 0.8)],
)
def test_roundings_of_both_sides_of_a_pair(more, less):
    """1.06 may be 1.0551, whose reciprocal 0.9478 is printed as 0.95."""
    assert matrix_of([[1, less], [more, 1]]).tolist() == [[1, 1 / more], [more, 1]]


@pytest.mark.parametrize(
    ("more", "less"), [(2, 0.51), (2, 0.49), (9, 0.12), (9, 0.1), (8, 0.14), (8, 0.11), (1.06, 0.96), (1.06, 0.92)]
)
def test_a_digit_beside_a_rounding_is_a_contradiction(more, less):
    with pytest.raises(ValueError, match="one must be 1 over the other"):
        ahp([[1, more], [less, 1]])


@pytest.mark.parametrize("lower", [0.3, 0.25, 0.36])
def test_reciprocals_that_no_rounding_explains_are_contradictions(lower):
    with pytest.raises(ValueError, match=r"\(2, 1\) is .*; one must be 1 over the other \(text such as '1/3' is exact"):
        ahp([[1, 3], [lower, 1]])


def test_judgements_as_text():
    assert_array_equal(matrix_of([["1", "3"], ["1/3", 1]]), matrix_of([3]))
    assert_array_equal(matrix_of(["4", " 1 / 2", None]), matrix_of([4, 0.5, None]))
    assert_array_equal(matrix_of(["0,5", "", "2"]), matrix_of([0.5, None, 2]))


def test_ratio_and_index_are_saatys_definition():
    judgement = ahp(LEADER)
    largest = max(np.linalg.eigvals(judgement.array).real)
    assert judgement.lambda_max == pytest.approx(largest)
    assert judgement.consistency_index == pytest.approx((largest - 4) / 3)
    assert judgement.consistency_ratio == pytest.approx((largest - 4) / 3 / 0.90)
    assert_allclose(judgement.array @ judgement.weights, largest * judgement.weights)
    assert ahp([[1]]).consistency_index == 0


weight_lists = st.lists(st.floats(0.05, 20), min_size=1, max_size=14)


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
    assert_allclose(ahp(judgement.array.tolist()).weights, judgement.weights)
    largest = max(np.linalg.eigvals(judgement.array).real)
    for method in ("eigenvector", "geometric"):  # the weights differ, the contradiction does not
        assert ahp(upper, method).lambda_max == pytest.approx(largest, rel=1e-9)
    if n == 3:  # for three criteria both methods agree (Saaty and Vargas 1984)
        assert_allclose(ahp(upper, "geometric").weights, judgement.weights, rtol=1e-6)
    swapped = ahp(judgement.array[::-1, ::-1])
    assert_allclose(swapped.weights[::-1], judgement.weights, rtol=1e-6)


def test_an_upper_triangle_is_read_row_by_row():
    assert_array_equal(matrix_of(LEADER)[0], [1, 4, 3, 7])
    assert_array_equal(matrix_of(LEADER)[1], [1 / 4, 1, 1 / 3, 3])
    assert_array_equal(matrix_of(LEADER)[:, 3], [7, 3, 5, 1])
    assert matrix_of([7]).tolist() == [[1, 7], [1 / 7, 1]]
    for n in range(2, 16):
        w = np.arange(1.0, n + 1)
        assert_allclose(matrix_of((w[:, None] / w)[np.triu_indices(n, 1)]), w[:, None] / w)


def test_the_worst_judgement_is_the_one_that_was_spoiled():
    w = np.array([0.4, 0.3, 0.2, 0.1])
    for i, j in ((0, 1), (0, 3), (2, 3)):
        a = w[:, None] / w
        a[i, j], a[j, i] = a[i, j] * 6, a[j, i] / 6
        judgement = ahp(a)
        assert judgement.worst == {(i, j): pytest.approx(w[i] / w[j])}
        assert judgement.consistency_ratio > 0.1


def by_hand(upper):
    """For each pair without which all hang together: least ``lambda_max`` over that judgement, and where it is."""
    told = {}
    for k, pair in enumerate(combinations(range(len(matrix_of(upper))), 2)):
        if upper[k] is not None:
            try:
                ahp(with_gap(upper, k))
            except ValueError:
                continue
            found = minimize_scalar(
                lambda log, k=k: ahp([np.exp(log) if m == k else v for m, v in enumerate(upper)]).lambda_max,
                bounds=(-12, 12), options={"xatol": 1e-9},
            )  # fmt: skip
            told[pair] = found.fun, np.exp(found.x)
    return told


@pytest.mark.parametrize(
    "upper",
    [
        LEADER,
        [1 / 2, 7, 3, 2, 5, 1 / 4],
        [2, 5, 1, 7, 3, 1 / 2, 2, 4, 1, 9],
        [2, 5, None, 7, 3, 1 / 2, 2, None, 1, 9],
        [*np.array(DRINKS)[np.triu_indices(7, 1)]],
    ],
    ids=["4", "4 random", "5", "5 with gaps", "7"],
)
@pytest.mark.parametrize("method", ["eigenvector", "geometric"])
def test_the_worst_judgement_is_the_one_without_which_lambda_max_is_least(upper, method):
    told = by_hand(upper)
    pair = min(told, key=lambda pair: told[pair][0])
    assert ahp(upper, method).worst == {pair: pytest.approx(told[pair][1], rel=1e-5)}


@pytest.mark.parametrize("upper", [[5, 5, 5], [9, 1 / 9, 9], [2, 3, 1 / 7]])
def test_three_judgements_contradict_each_other_together(upper):
    a, b, c = upper  # of the pairs 1 2, 1 3, 2 3
    expected = {(0, 1): b / c, (0, 2): a * c, (1, 2): b / a}
    assert ahp(upper).worst == {pair: pytest.approx(value) for pair, value in expected.items()}
    # A fourth criterion that hangs on one judgement changes nothing: that one cannot be left out.
    assert ahp([a, b, 2, c, None, None]).worst == {pair: pytest.approx(value) for pair, value in expected.items()}


def test_too_few_judgements_to_contradict_each_other():
    assert ahp([3]).worst == ahp([[1]]).worst == ahp([2, None, 3]).worst == {}


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
    assert inner[most_isolated(f)] == pytest.approx(inner.max())


def test_crowding_takes_an_inner_design_if_there_is_one():
    assert most_isolated([[0, 1], [0.1, 0.8], [0.5, 0.2], [1, 0]]) == 2
    assert most_isolated([[0, 1], [1, 0]]) == 0
    assert most_isolated([[3, 4]]) == 0
    assert most_isolated([[0, 1], [0.5, 0.5], [1, 0]]) == 1


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
    assert topsis(WORKED, weights, scale="range") == chosen


def test_the_two_scales_of_topsis_choose_differently():
    """By the vector 0.6 .. 0.9 is the smaller spread of the two; lengths sqrt(1.07) and sqrt(1.66)."""
    three = [[0.1, 0.9], [0.5, 0.7], [0.9, 0.6]]
    assert topsis(three, [1, 2]) == topsis(three, [1, 2], scale="vector") == 0
    assert topsis(three, [1, 2], scale="range") == 2


def closeness(f, weights, scale):
    """Hwang and Yoon's steps 1 to 5, one number at a time."""
    p, k = f.shape
    share = [w / sum(weights) for w in weights]
    if scale == "vector":
        size = [math.sqrt(sum(f[i, j] ** 2 for i in range(p))) for j in range(k)]
        y = [[share[j] * f[i, j] / size[j] for j in range(k)] for i in range(p)]
    else:
        low, span = f.min(axis=0), np.ptp(f, axis=0)
        y = [[share[j] * (f[i, j] - low[j]) / span[j] for j in range(k)] for i in range(p)]
    ideal, worst = ([end(row[j] for row in y) for j in range(k)] for end in (min, max))
    return [math.dist(row, worst) / (math.dist(row, worst) + math.dist(row, ideal)) for row in y]


@pytest.mark.parametrize("scale", ["vector", "range"])
def test_topsis_is_its_definition(scale):
    rng, swayed = np.random.default_rng(8), 0
    for _ in range(200):
        f = rng.normal(size=(rng.integers(2, 9), rng.integers(2, 5))) * rng.uniform(0.1, 50)
        weights = rng.uniform(0.05, 1, f.shape[1])
        told = closeness(f, weights, scale)
        assert topsis(f, weights, scale) == np.argmax(told)
        swayed += np.argmax(told) != np.argmax(closeness(f, np.sqrt(weights), scale))
    assert swayed > 10  # weights that are squared once too seldom choose others


def test_objectives_as_large_as_numbers_go_are_chosen_from_alike():
    f = np.array([[-1.0, 0.9], [0.2, 0.7], [1.0, -0.6]])
    for choose in (weighted_sum, topsis, knee, most_isolated):
        assert choose(f * [1.7e308, 1e-300], [1, 2]) == choose(f, [1, 2])
        assert choose((f - 2) * [5e307, 1e-300], [1, 2]) == choose(f - 2, [1, 2])  # all below 0


# Weighted sums by hand: 3/4, 1/4: 0.25, 0.275, 0.4, 0.75; 1/4, 3/4: 0.75, 0.425, 0.2, 0.25; equal: 0.5, 0.35, 0.3, 0.5.
@pytest.mark.parametrize(
    ("weights", "chosen"), [([3, 1], 0), ([1, 3], 2), ([1, 1], 2), (None, 2), ([1, 0], 0), ([0, 1], 3)]
)
def test_weighted_sum_of_a_worked_case(weights, chosen):
    assert weighted_sum(WORKED, weights) == chosen


@given(fronts, st.sampled_from([most_isolated, topsis, weighted_sum]), st.integers(1, 9), st.integers(-9, 9))
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


# ---------------------------------------------------------------- judgements that nobody made

NAN = np.nan
ways = st.sampled_from(["eigenvector", "geometric"])


@st.composite
def gapped(draw):
    """Weights, and their consistent matrix with random gaps that leave all criteria connected through a chain."""
    w = np.array(draw(st.lists(st.floats(0.1, 9), min_size=2, max_size=7)))
    order = draw(st.permutations(range(len(w))))
    known = np.eye(len(w), dtype=bool)
    for place in range(1, len(w)):
        i, j = order[place], order[draw(st.integers(0, place - 1))]
        known[i, j] = known[j, i] = True
    more = np.array(draw(st.lists(st.booleans(), min_size=w.size**2, max_size=w.size**2))).reshape(known.shape)
    return w, np.where(known | more | more.T, w[:, None] / w, NAN)


@given(gapped(), ways)
@settings(deadline=None)
def test_consistent_judgements_with_gaps_give_the_exact_weights(case, method):
    w, matrix = case
    judgement = ahp(matrix, method)
    assert_allclose(judgement.weights, w / w.sum(), rtol=1e-9)
    assert_allclose(judgement.complete().array, w[:, None] / w, rtol=1e-9)
    assert judgement.consistency_ratio == pytest.approx(0, abs=1e-8)
    assert judgement.missing == np.isnan(matrix).sum() / 2


def with_gap(upper, *gaps):
    return [None if k in gaps else value for k, value in enumerate(upper)]


@pytest.mark.parametrize("gaps", [(0,), (1,), (5,), (1, 4), (0, 5), (0, 1, 3)])
def test_gaps_are_filled_so_that_lambda_max_is_least(gaps):
    """Against a search of all fillings; the least is the only one (Bozoki, Fulop, Ronyai 2010)."""

    def filled(logs):
        upper = np.array(LEADER, dtype=float)
        upper[list(gaps)] = np.exp(logs)
        return upper

    found = minimize(
        lambda logs: ahp(filled(logs)).lambda_max,
        np.zeros(len(gaps)),
        method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-13},
    )
    judgement = ahp(with_gap(LEADER, *gaps))
    assert judgement.lambda_max == pytest.approx(found.fun, rel=1e-12)
    assert_allclose(judgement.complete().array, matrix_of(filled(found.x)), rtol=1e-5)
    assert_allclose(judgement.weights, ahp(judgement.complete().array).weights, rtol=1e-12)


def test_geometric_weights_with_gaps_are_those_of_the_completed_matrix():
    judgement = ahp(with_gap(LEADER, 1, 4), "geometric")
    means = judgement.complete().array.prod(axis=1) ** (1 / 4)
    assert_allclose(judgement.weights, means / means.sum(), rtol=1e-12)
    assert_allclose(judgement.complete().array, ahp(with_gap(LEADER, 1, 4)).complete().array)


def test_geometric_weights_of_a_full_matrix_are_row_means():
    matrix = np.array(DRINKS)
    means = matrix.prod(axis=1) ** (1 / 7)
    assert_allclose(ahp(DRINKS, "geometric").weights, means / means.sum(), rtol=1e-10)


# Random indices of incomplete matrices with 0, 1, 2, ... gaps: Agoston and Csato (2022), Table 2.
@pytest.mark.parametrize(
    ("upper", "gaps", "published"),
    [
        (LEADER, (0, 4), (0.884, 0.583, 0.306)),
        ([2, 5, 1, 7, 3, 1 / 2, 2, 4, 1, 9], (0, 4, 7, 9), (1.109, 0.925, 0.739, 0.557, 0.379)),
    ],
    ids=["4", "5"],
)
def test_the_random_index_falls_with_every_gap(upper, gaps, published):
    for count, index in enumerate(published):
        judgement = ahp(with_gap(upper, *gaps[:count]))
        assert judgement.missing == count
        assert judgement.consistency_index > 1e-6
        assert judgement.consistency_index / judgement.consistency_ratio == pytest.approx(index, rel=0.04)


@pytest.mark.parametrize(
    ("judgements", "sentence"),
    [
        ([None], "no judgement connects criterion 1 with criterion 2; judge one such pair"),
        (
            [3, None, None, None, None, 2],
            "no judgement connects criterion 1, 2 with criterion 3, 4; judge one such pair",
        ),
        ([None, None, 5], "no judgement connects criterion 1 with criterion 2, 3; judge one such pair"),
        ([None, 0, 5], r"judgement \(1, 3\) is 0; it must be a positive number"),
    ],
)
def test_criteria_that_no_judgement_connects_are_refused(judgements, sentence):
    with pytest.raises(ValueError, match=sentence):
        ahp(judgements)


def test_one_side_of_a_pair_is_enough():
    assert_allclose(matrix_of([[1, 2, 4], [None, None, 2], [None, None, None]]), ahp([2, 4, 2]).complete().array)


@given(st.lists(said | st.none(), min_size=6, max_size=6))
@settings(deadline=None)
def test_many_matrices_at_once_have_the_weights_of_each(upper):
    try:
        matrix = matrix_of(upper)
    except ValueError:
        return
    many = np.stack([matrix, matrix_of(LEADER), matrix])
    for method in ("eigenvector", "geometric"):
        together = judged_weights(many, method)
        assert_allclose(together[0], ahp(upper, method).weights, rtol=1e-9)
        assert_allclose(together[1], ahp(LEADER, method).weights, rtol=1e-9)


# ---------------------------------------------------------------- the knee

BENT = np.array([[0, 1], [0.05, 0.6], [0.15, 0.2], [0.5, 0.1], [1, 0]])


def test_the_knee_is_farthest_from_the_line_through_the_ends():
    x, y = BENT.T
    distance = (1 - x - y) / np.sqrt(2)
    assert knee(BENT) == np.argmax(distance) == 2
    assert knee(BENT * [7, 0.01] + [3, 5]) == 2


@given(st.lists(st.floats(0.01, 0.99).map(lambda x: round(x, 3)), min_size=1, max_size=20, unique=True))
@settings(deadline=None)
def test_the_knee_of_two_objectives_is_the_weighted_sum_with_equal_weights(xs):
    f = np.array([[0, 1], *[[x, (1 - x) ** 3] for x in sorted(xs)], [1, 0]])
    assert knee(f, [9, 1]) == weighted_sum(f)


def test_the_knee_of_a_ball_is_where_its_normal_is_that_of_the_plane_through_the_corners():
    # On the ball |1 - y| = 1 the point farthest from x + y + z = 1 is y = 1 - 1/sqrt(3); stretching changes nothing.
    rng = np.random.default_rng(3)
    u = abs(rng.normal(size=(4000, 3)))
    f = np.vstack([1 - u / np.linalg.norm(u, axis=1)[:, None], 1 - np.eye(3), np.full(3, 1 - 1 / np.sqrt(3))])
    assert knee(f * [5, 0.2, 30]) == len(f) - 1


def test_a_knee_where_the_corners_make_no_plane():
    one_is_best_twice = np.array([[0, 0, 1], [1, 1, 0], [0.3, 0.3, 0.3]])
    assert knee(one_is_best_twice) == 2
    assert knee([[1.0], [0.0], [2.0]]) == 1


# ---------------------------------------------------------------- many weights at once, and how sure a choice is

many_fronts = arrays(float, st.tuples(st.integers(1, 12), st.integers(1, 4)), elements=cents)


@given(many_fronts, st.sampled_from(list(CHOOSERS)), st.integers(0, 1000))
@settings(deadline=None)
def test_many_weights_at_once_choose_as_one_by_one(f, rule, seed):
    weights = np.random.default_rng(seed).dirichlet(np.ones(f.shape[1]), 20)
    together = CHOOSERS[rule](f, weights)
    assert together.shape == (20,)
    merits = [normalised(f) @ w for w in weights]
    for i, w, merit in zip(together, weights, merits, strict=True):
        one = CHOOSERS[rule](f, w)
        assert i == one or (rule in WEIGHING and abs(merit[i] - merit[one]) < 1e-9)


def test_weights_for_another_number_of_objectives_are_refused_also_when_many():
    with pytest.raises(ValueError, match="there are 3 weights for 2 objectives"):
        weighted_sum(WORKED, np.ones((5, 3)))
    with pytest.raises(ValueError, match="none negative"):
        topsis(WORKED, [[1, 1], [1, -1]])


FRONT3 = np.array([[0, 0.7, 0.9], [0.2, 0.3, 0.5], [0.6, 0.1, 0.3], [0.9, 0.8, 0], [0.4, 0, 0.95], [0.45, 0.35, 0.2]])


@pytest.mark.parametrize("choose", [weighted_sum, topsis])
@pytest.mark.parametrize("method", ["eigenvector", "geometric"])
@pytest.mark.parametrize("judgements", [[2, 3, 2], [1, 1, 1], [1 / 3, 5, 4], [4, None, 1 / 2]])
def test_how_far_a_judgement_may_move_against_a_fine_sweep(choose, method, judgements):
    judged = ahp(judgements, method)
    winner = choose(FRONT3, judged.weights)
    for told in judgement_ranges(FRONT3, judged, choose):
        i, j = told.pair
        assert told.judged == pytest.approx(judged.complete().array[i, j])
        for end, beyond, last in ((told.low, told.below, 1 / 9), (told.high, told.above, 9)):
            sweep = np.geomspace(told.judged, last, 3000)
            matrices = np.tile(judged.array, (3000, 1, 1))
            matrices[:, i, j], matrices[:, j, i] = sweep, 1 / sweep
            wins = np.array([choose(FRONT3, w) for w in judged_weights(matrices[::10], method)])
            assert beyond is None or beyond != winner
            if (wins == winner).all():
                assert beyond is None
                assert end == pytest.approx(last)
            else:
                first = 10 * int(np.argmax(wins != winner))
                assert sorted(sweep[[first - 10, first]])[0] <= end <= sorted(sweep[[first - 10, first]])[1]
                just = [ahp(at(judged.array, i, j, end * f), method).weights for f in (1 - 1e-7, 1 + 1e-7)]
                inside, outside = just if last > 1 else just[::-1]
                assert choose(FRONT3, inside) == winner
                assert choose(FRONT3, outside) == beyond


def at(matrix, i, j, value):
    changed = matrix.copy()
    changed[i, j], changed[j, i] = value, 1 / value
    return changed


def test_ranges_of_two_objectives_are_known():
    # w1 : w2 = r.  Design 1 beats design 0 while 0.1 r + 0.5 < 1 and design 2 while 0.1 r + 0.5 < r.
    (told,) = judgement_ranges([[0, 1], [0.1, 0.5], [1, 0]], [2])
    assert (told.below, told.above) == (2, 0)
    assert told.low == pytest.approx(5 / 9, rel=1e-8)
    assert told.high == pytest.approx(5, rel=1e-8)


def test_a_winner_who_loses_beyond_the_scale_stays_to_its_ends():
    """0.05 w1 + 0.05 w2 is the least between w2 = 19 w1 and w1 = 19 w2."""
    (told,) = judgement_ranges([[0, 1], [0.05, 0.05], [1, 0]], [2])
    assert (told.low, told.high, told.below, told.above) == (pytest.approx(1 / 9), pytest.approx(9), None, None)


def test_ranges_with_many_criteria_and_gaps_are_bounded():
    """Each bound of a large matrix with gaps against the winners just inside and just outside."""
    upper = [2, 5, None, 7, 3, 1 / 2, 2, None, 1, 9, 4, 1, 3, 1 / 3, 2]
    ball = abs(np.random.default_rng(6).normal(size=(300, 6)))
    f = 1 - ball / np.linalg.norm(ball, axis=1)[:, None]  # on a ball nearly every design wins somewhere
    judged = ahp(upper)
    winner, bounded = weighted_sum(f, judged.weights), 0
    for told in judgement_ranges(f, upper):
        for end, beyond, out in ((told.low, told.below, 1 - 1e-7), (told.high, told.above, 1 + 1e-7)):
            if beyond is not None:
                bounded += 1
                inside, outside = (ahp(at(judged.array, *told.pair, end * s)).weights for s in (1 / out, out))
                assert (weighted_sum(f, inside), weighted_sum(f, outside)) == (winner, beyond)
    assert bounded > 15


def test_rules_that_ask_for_no_weights_stay_to_the_ends_of_the_scale():
    for choose in (knee, most_isolated):
        for told in judgement_ranges(FRONT3, [2, 3, 2], choose):
            assert (told.low, told.high, told.below, told.above) == (pytest.approx(1 / 9), pytest.approx(9), None, None)


def test_a_judgement_off_the_scale_and_one_objective():
    (told,) = judgement_ranges([[0, 1], [1, 0]], [20])
    assert (told.high, told.above) == (20, None)
    assert told.low == pytest.approx(1, rel=1e-8)
    assert judgement_ranges([[1.0], [2.0]], [[1]]) == ()
    with pytest.raises(ValueError, match="there are 3 weights for 2 objectives"):
        judgement_ranges(WORKED, [1, 2, 3])


@pytest.mark.parametrize(("k", "steps"), [(1, 5), (2, 7), (3, 6), (4, 5), (10, 8)])
def test_a_lattice_has_every_weighting_once(k, steps):
    weights = weight_lattice(k, steps)
    assert len(weights) == math.comb(steps + k - 1, k - 1)
    assert_allclose(weights.sum(axis=1), 1)
    assert len(np.unique((weights * steps).round(), axis=0)) == len(weights)
    assert_allclose(weights * steps, (weights * steps).round(), atol=1e-12)


def test_shares_of_the_triangle_are_areas():
    # Of the corners of a cube each wins where its objective weighs most: a third of the triangle.
    corners = winner_map(1 - np.eye(3))
    assert set(corners.shares) == {0, 1, 2}
    assert_allclose(list(corners.shares.values()), 1 / 3, atol=0.02)
    # A design with 0.499 everywhere wins where no weight is above 0.501: the inner triangle, a quarter of the whole.
    inner = winner_map([*(1 - np.eye(3)), [0.499, 0.499, 0.499]])
    assert inner.shares[3] == pytest.approx(1 / 4, abs=0.02)
    assert sum(inner.shares.values()) == pytest.approx(1)


@pytest.mark.parametrize("k", [1, 2, 3, 4, 5, 6])
def test_a_map_says_what_the_chooser_says(k):
    f = np.random.default_rng(k).random((9, k))
    for choose in (weighted_sum, topsis):
        chart = winner_map(f, choose)
        steps = {1: 1, 2: 1000, 3: 60, 4: 20, 5: 12, 6: 8}[k]
        assert len(chart.weights) == math.comb(steps + k - 1, k - 1)
        for i in range(0, len(chart.weights), max(len(chart.weights) // 7, 1)):
            assert chart.winners[i] == choose(f, chart.weights[i])


# ---------------------------------------------------------------- a reference point


def test_the_nearest_design_to_a_wish_by_hand():
    """Ranges 4 and 10: short by 0.25 and 0.3, by 0.5 and 0.1, by 0 and 0.6."""
    front = [[2, 5], [3, 3], [1, 8], [5, 2], [4, 12]]
    assert achievement(front, [1, 2]) == 0
    assert achievement(front, [3, 0]) == 1
    assert achievement(front, [[1, 2], [0, 9], [9, 0]]).tolist() == [0, 2, 3]
    assert achievement(front) == 0
    assert achievement([[1, 3], [1, 3]], [0, 0]) == 0


fronts = arrays(float, st.tuples(st.integers(1, 30), st.integers(1, 4)), elements=st.integers(-9, 9).map(float))


@given(fronts, st.data())
@settings(deadline=None)
def test_no_design_is_better_than_the_nearest_in_everything_and_units_do_not_matter(f, data):
    k = f.shape[1]
    wish = np.array(data.draw(st.lists(st.integers(-20, 20).map(float), min_size=k, max_size=k)))
    chosen = achievement(f, wish)
    assert not ((f <= f[chosen]).all(-1) & (f < f[chosen]).any(-1)).any()
    short = (f - wish) / np.where(np.ptp(f, axis=0) > 0, np.ptp(f, axis=0), 1)
    assert short[chosen].max() <= short.max(-1).min() + 1e-4 * abs(short).sum(-1).max() * 2
    scale = 2.0 ** np.arange(k)
    assert achievement(8 * scale * f, 8 * scale * wish) == chosen
    efficient = [i for i in range(len(f)) if not ((f <= f[i]).all(-1) & (f < f[i]).any(-1)).any()]
    for i in efficient:
        assert (f[achievement(f, f[i])] == f[i]).all()


@pytest.mark.parametrize("wish", [[1.0], [1.0, 2.0, 3.0], [math.nan, 1.0], "ab", [[1.0]]])
def test_what_is_no_wish(wish):
    with pytest.raises(ValueError, match=r"the reference point is .*; it must be 2 finite numbers"):
        achievement([[0, 1], [1, 0]], wish)
