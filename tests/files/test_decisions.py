"""Decisions as records: what they say, as files, and what no decision can be."""

import json
import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import (
    Decision,
    Judgements,
    Measure,
    Session,
    Study,
    group,
    knee,
    mm,
    read,
    shaft_study,
    weighted_sum,
    write,
)
from camkit.decision import CHOOSERS, achievement
from camkit.files import from_json, read_json, to_json
from camkit.machines import UniversalJointShaft
from camkit.search import Front, front_of
from camkit.study.robust import RobustStudy

SHAFT = shaft_study()
(AREA,) = SHAFT.minimise
LIMITS = tuple(SHAFT.at_most)
TWO = SHAFT.replace(minimise=(AREA, LIMITS[0]))
NAMES = [m.name for m in TWO.minimise]


@pytest.fixture(scope="module")
def front():
    x = np.array([[d, 103 * mm] for d in np.linspace(128, 140, 30) * mm])
    record = {"population": 4, "generations": 2, "seed": 7, "seconds": 1.5, "versions": {"camkit": "0.1.0"}}
    found = front_of(TWO.evaluate(x), TWO)
    return Front(TWO, found.x, found.f, record=record)


def test_a_decision_tells_all_that_led_to_it(front):
    judged = Judgements(NAMES, [3])
    decision = Decision(front, weighted_sum(front, judged), "weighted sum", judged, date="2026-03-31", version="0.1.0")
    said = dict(decision.lines())
    assert said["decided"] == "2026-03-31, camkit 0.1.0"
    assert said["front"] == f"{len(front)} designs; found in 1.5 s: 2 generations, seed 7"
    assert said["judged"] == (
        f"{NAMES[0]} against {NAMES[1]} 3; weights: {NAMES[0]} 0.7500, {NAMES[1]} 0.2500; consistency ratio 0.0000"
    )
    assert said["rule"] == "weighted sum"
    assert said["chosen"] == f"design {decision.chosen} of 0 to {len(front) - 1}"
    least, most = (AREA.text(v) for v in (front.f[:, 0].min(), front.f[:, 0].max()))
    assert said[f"range of the {AREA.name}"] == f"{least} (best) to {most}"
    assert said["outer diameter"] == front.study.declared["outer_diameter"].text(front.x[decision.chosen, 0])
    assert said[AREA.name] == AREA.text(front.f[decision.chosen, 0])
    assert {m.name for m in LIMITS} < said.keys()
    assert decision.design == front[decision.chosen]
    assert_allclose(decision.ranges, [front.f.min(0), front.f.max(0)])
    middle = Decision(front, len(front) // 2)
    rate = front.rates(middle.chosen)[0, 1]
    assert middle.rates[0, 1] == rate > 0
    cost = LIMITS[0].text(1e-6 * rate)
    assert dict(middle.lines())["rate"] == f"1 mm^2 less {NAMES[0]} costs {cost} more {NAMES[1]}."
    assert "rate" not in dict(Decision(front, 0).lines())
    assert decision.text().splitlines()[0] == "decided: 2026-03-31, camkit 0.1.0"


@pytest.mark.parametrize(
    ("rule", "judged", "wish"),
    [
        ("by hand", None, None),
        ("knee", Judgements(NAMES, [2]), None),
        ("TOPSIS", group({"Anna": Judgements(NAMES, [3]), "Ben & <co>": Judgements(NAMES, ["1/2"])}, [1, 2.5]), None),
        ("reference point", None, (0.0051, 0.7)),
    ],
)
def test_a_decision_goes_to_a_file_and_back(front, rule, judged, wish, tmp_path):
    decision = Decision(front, 5, rule, judged, wish)
    write(decision, tmp_path / "decision.json")
    told = []
    again = read(tmp_path / "decision.json", measures=TWO.measures, tell=told.append)
    assert told == []
    assert again.lines() == decision.lines()
    same = ("chosen", "rule", "judgements", "date", "version", "yields")
    assert [getattr(again, name) for name in same] == [getattr(decision, name) for name in same]
    assert again.front.record == front.record
    assert_allclose(again.front.x, front.x, rtol=1e-15)
    assert again.taken == decision.taken
    if wish:
        assert_allclose(again.reference, wish, rtol=1e-14)
    session = Session(TWO, front[3], front=front, decision=decision)
    assert from_json(to_json(session)).decision.lines() == decision.lines()
    assert from_json(to_json(Session(TWO, front[3], front=front))).decision is None


def test_what_the_rule_takes_is_told_where_it_is_another(front):
    for rule, choose in CHOOSERS.items():
        decision = Decision(front, 1, rule)
        assert decision.taken == choose(front, None)
        assert (f"; the rule takes design {choose(front, None)}" in dict(decision.lines())["chosen"]) == (
            choose(front, None) != 1
        )
    wish = front.f[7]
    assert Decision(front, 7, "reference point", reference=wish).taken == achievement(front, wish) == 7
    assert Decision(front, 7).taken is None


def test_a_file_that_says_other_numbers_than_are_computed_is_remarked(front):
    decision = Decision(front, knee(front), "knee")
    content = json.loads(to_json(decision))
    key = f"{AREA.name} [mm^2]"
    content["decision"]["values"][key] *= 1.01
    text = json.dumps(content)
    value = decision.values[AREA]
    remark = f"the {AREA.name} of its chosen design is {AREA.text(value)}; it was {AREA.text(1.01 * value)} when it was"
    assert read_json(text).remarks[-1].startswith(remark)
    for damage, sentence in (
        ({"chosen": [999.0, 103.0]}, "the front of the file has a design outside the bounds"),
        ({"chosen": [130.123, 103.0]}, "its chosen design is none of its front"),
        ({"rule": "coin"}, "the rule is 'coin'; there are 'crowding distance'"),
        ({"rule": "reference point"}, "the rule is the reference point; there must be one"),
        ({"date": "yesterday"}, "the date is 'yesterday'; it must be as 2026-03-31"),
        ({"judgements": 5}, "where judgements belong"),
        ({"reference": [1]}, "where 2 numbers belong"),
        ({"yields": "<b>all</b>"}, "the file has the name '<b>all</b>'"),
        ({"values": 3}, "where names and values belong"),
    ):
        with pytest.raises(ValueError, match=re.escape(sentence)):
            read_json(json.dumps({**content, "decision": {**content["decision"], **damage}}))
    del content["decision"]["rule"]
    with pytest.raises(ValueError, match="it lacks 'rule' of the decision"):
        read_json(json.dumps(content))


def test_under_tolerances_the_yield_is_recorded(front):
    robust = TWO.under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
    assert isinstance(robust, RobustStudy)
    under = front_of(robust.evaluate(front.x), robust)
    decision = Decision(under, 1)
    assert decision.front.study == TWO
    assert decision.design == under[1]
    assert decision.yields == f"{under.yields.of(np.array([1]))}; tolerances on outer diameter, inner diameter"
    assert from_json(to_json(decision)).yields == decision.yields


def test_names_are_escaped_where_a_decision_is_shown():
    evil = Measure("<img src=x onerror=f()>", "mm", lambda a: np.atleast_1d(a.shaft.outer_diameter)[..., 0])
    study = Study(UniversalJointShaft(), ["outer_diameter"], (evil, AREA))
    x = np.array([[0.12], [0.13]])
    told = Decision(Front(study, x, study.evaluate(x).f), 0, judgements=Judgements(["<b>a</b>", "b"], [3]))
    assert "<img" not in told._repr_html_()
    assert "<b>a" not in told._repr_html_()
    assert "&lt;img src=x" in told._repr_html_()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"chosen": 99}, "the chosen design is 99; there are"),
        ({"chosen": -1}, "the chosen design is -1; there are"),
        ({"rule": "luck"}, "the rule is 'luck'; there are 'crowding distance', 'weighted sum', 'TOPSIS', 'knee', "),
        (
            {"judgements": Judgements(["a", "b", "c"], [1, 2, 3])},
            "the judgements are of 3 criteria; ",
        ),
        ({"reference": (1.0,)}, "the reference point is .*; it must be 2 finite numbers"),
        ({"rule": "reference point"}, "the rule is the reference point; there must be one"),
        ({"date": "31.3.2026"}, "the date is '31.3.2026'; it must be as 2026-03-31"),
    ],
)
def test_what_is_no_decision(front, given, sentence):
    with pytest.raises(ValueError, match=sentence):
        Decision(**{"front": front, "chosen": 0, **given})
