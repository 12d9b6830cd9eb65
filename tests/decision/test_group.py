"""Groups of judges against worked values, identities of the geometric mean, and what no group can be."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit import ahp, group
from camkit.decision import Judgements, Judges

PEOPLE = [[3, 5, 2], [1 / 2, 4, 6], [4, 4, 1]]


def test_three_people_as_one():
    """The weights by a hand's geometric means: (3 / 2 * 4)^(1/3) and so on, and LAPACK's eigenvector."""
    three = group(PEOPLE)
    assert_allclose(three.weights, [0.562199, 0.305789, 0.132011], atol=5e-7)
    assert three.judgements.consistency_ratio == pytest.approx(0.000118, abs=5e-7)
    assert_allclose(three.judgements.above, np.cbrt([6, 80, 12]), rtol=1e-12)
    assert [*three.said] == ["judge 1", "judge 2", "judge 3"]
    for judged, said in zip(three.said.values(), PEOPLE, strict=True):
        assert judged == ahp(said)


def test_weights_of_judges_are_repeated_judges():
    """A judge who counts twice is two who say the same."""
    for method in ("judgements", "priorities"):
        twice = group([PEOPLE[0], PEOPLE[0], PEOPLE[1]], method=method)
        for weights in ([2, 1], {"b": 0.5, "a": 1.0}):
            counted = group({"a": PEOPLE[0], "b": PEOPLE[1]}, weights, method)
            assert_allclose(counted.weights, twice.weights, rtol=1e-12)
            assert_allclose(counted.influence, [2 / 3, 1 / 3], rtol=1e-15)
    assert_allclose(group(PEOPLE, [1e300, 1e300, 1e300]).weights, group(PEOPLE).weights)


def test_joined_priorities_are_the_mean_of_the_weights():
    each = [ahp(said).weights for said in PEOPLE]
    joined = group(PEOPLE, [1, 2, 3], method="priorities")
    assert_allclose(joined.weights, np.average(each, axis=0, weights=[1, 2, 3]), rtol=1e-12)
    assert joined.judgements.consistency_ratio == pytest.approx(0, abs=1e-12)


scale = st.sampled_from([1 / 9, 1 / 5, 1 / 3, 1.0, 2.0, 4.0, 7.0])


@given(st.lists(st.tuples(*[scale] * 6), min_size=2, max_size=4), st.data())
@settings(deadline=None, max_examples=50)
def test_geometric_means_of_rows_commute_with_joining(said, data):
    """By rows' geometric means the joined judgements' weights are the joined weights' geometric mean."""
    shares = np.array(data.draw(st.lists(st.floats(0.1, 10), min_size=len(said), max_size=len(said))))
    judged = [ahp(list(each), "geometric") for each in said]
    logs = shares / shares.sum() @ np.log([each.weights for each in judged])
    expected = np.exp(logs) / np.exp(logs).sum()
    joined = group(judged, shares)
    assert_allclose(joined.weights, expected, rtol=1e-9)
    assert_allclose(joined.judgements.array * joined.judgements.array.T, 1, rtol=1e-12)


def test_a_pair_is_judged_by_those_who_judged_it():
    two = group({"a": [2, None, 4], "b": [None, 3, 1]})
    assert_allclose(two.judgements.above, [2, 3, 2])
    nobody = group({"a": [2, None, 4], "b": [8, None, 1]})
    assert_allclose(nobody.judgements.array[0, 1], 4)
    assert nobody.judgements.above[1] is None
    assert math.isnan(nobody.ratios[0, 0, 2])
    assert list(nobody.disputed)[-1] == (0, 2)


def test_disagreement_by_hand():
    """The group says sqrt(2 * 8) = 4 of the first pair, so each is apart by 2; they agree on the others."""
    two = group({"a": [2, 1, 3], "b": [8, 1, 3]})
    assert {pair: round(ratio, 12) for pair, ratio in two.disputed.items()} == {(0, 1): 2, (0, 2): 1, (1, 2): 1}
    assert next(iter(two.disputed)) == (0, 1)
    assert_allclose(two.ratios[:, 0, 1], [1 / 2, 2])
    # of nine entries seven are 1, the two others 2 and 1/2: Saaty's index
    assert_allclose(two.incompatibility, [9.5 / 9, 9.5 / 9])
    same = group([PEOPLE[0], PEOPLE[0]])
    assert_allclose(same.incompatibility, 1)
    assert_allclose([*same.disputed.values()], 1)


def test_a_table_of_each_judge_and_the_group():
    evil = "<b>Anna</b>"
    two = group({evil: Judgements(("a", "b"), [3]), "Ben": Judgements(("a", "b"), [1])}, [3, 1])
    head, rows = two.rows()
    assert head == ("judge", "counts", "a", "b", "consistency ratio", "apart from the group")
    assert rows[0][:4] == (evil, "75 %", "0.7500", "0.2500")
    assert rows[2][:4] == ("group", "", "0.6951", "0.3049")  # 3^(3/4) to 1
    assert evil not in two._repr_html_()
    assert "&lt;b&gt;Anna" in two._repr_html_()
    assert_array_equal(group([[[1]], [[1]]]).weights, [1])


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: group([[3, 5, 2]]), "there is one judge; a group has two or more"),
        (lambda: group({}), "there is no judge"),
        (lambda: group([[3, 5, 2], [3]]), "judge 2 judges criterion 1, criterion 2, but judge 1 criterion 1, "),
        (
            lambda: group({"A": Judgements(("x", "y"), [3]), "B": Judgements(("y", "x"), [3])}),
            "B judges y, x, but A x, y; all must judge the same criteria",
        ),
        (lambda: group([[3], [2]], [0, 1]), "the weight of judge 1 is 0; it must be a positive number"),
        (lambda: group([[3], [2]], [1, -2]), "the weight of judge 2 is -2; it must be a positive number"),
        (lambda: group([[3], [2]], [1, math.inf]), "the weights of the judges .* inf|the weight of judge 2 is inf"),
        (lambda: group([[3], [2]], [1]), "there must be a weight for each of 2 judges; given are 1"),
        (lambda: group({"A": [3], "B": [2]}, {"A": 1}), "the weights are those of A; the judges are A, B"),
        (lambda: group([[3], [2]], "ab"), "the weights of the judges must be numbers"),
        (lambda: group([[3], [2]], method="median"), "the method is 'median'; there are 'judgements' and 'priorities'"),
        (lambda: group([[3], ["x"]]), "judge 2: 'x' is no number above 0"),
        (lambda: group("AB"), "the list of judges is 'AB'"),
        (lambda: group(3), "the list of judges is 3"),
        (lambda: group([ahp([3]), ahp([2], "geometric")]), "the weights of judge 2 are by 'geometric'"),
        (lambda: Judges({"A": 3, "B": 4}, (1.0, 1.0)), "said"),
    ],
)
def test_what_is_no_group(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
