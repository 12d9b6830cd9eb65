"""Judgements of many criteria and of several judges: what stands on the sheet, and what counts."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from sheets import alert, press

from camkit import DoorHandleCam, Judgements, Session, ahp_panel, door_handle_study, explore, group, pareto_panel
from camkit.files import from_json, to_json

NAMES = ("angle", "force", "torque")
SAID = {"Anna": [3, 5, 2], "Ben": [1 / 2, 4, 6], "Chris": [4, 4, 1]}
THREE = group({name: Judgements(NAMES, said) for name, said in SAID.items()})


@pytest.fixture
def panel():
    return ahp_panel(THREE, "What matters?")


def test_one_judge_in_the_sliders_and_the_group_in_the_weights(panel):
    assert_allclose(panel.weights, [0.562199, 0.305789, 0.132011], atol=5e-7)
    assert panel.boxes[0, 1].value == "3"
    assert "0.5622" in panel.table.text
    assert "Most disputed: angle against force, where Ben says 1/2 and the group about 1.8." in panel.summary()
    seen = []
    panel.on_change(lambda: seen.append(panel.weights))
    panel.judge.value = "Ben"
    assert panel.boxes[0, 1].value == "1/2"
    panel.sliders[0, 1].value = 2.0
    changed = group([SAID["Anna"], [2, 4, 6], SAID["Chris"]])
    assert_allclose(panel.weights, changed.weights)
    assert_allclose(seen[-1], changed.weights)
    assert panel.given.said["Ben"].above == (2, 4, 6)
    assert panel.given.said["Anna"].above == (3, 5, 2)
    press(panel, "Reset")
    assert panel.given == THREE
    assert panel.judge.value == "Anna"


def test_how_much_a_judge_counts_and_what_is_joined(panel):
    panel.judge.value = "Chris"
    panel.share.value = 3.0
    assert_allclose(panel.weights, group(SAID, [1, 1, 3]).weights)
    panel.way.value = "priorities"
    assert_allclose(panel.weights, group(SAID, [1, 1, 3], "priorities").weights)
    panel.method.value = "geometric"
    assert {judged.method for judged in panel.given.said.values()} == {"geometric"}
    panel.share.value = 0.0
    assert alert(panel) == "The judges count as before: the weight of Chris is 0; it must be a positive number."
    assert (panel.share.value, panel.given.shares) == (3, (1, 1, 3))


def test_each_judge_is_drawn_beside_the_group(panel):
    drawn = panel.picture.shown[0]
    assert_allclose(drawn["angle"].x, [0, 56.2199], atol=1e-4)
    for i, judged in enumerate(THREE.said.values()):
        assert_allclose(drawn[f"judge {i}"].x, 100 * judged.weights)
    assert [drawn[f"judge {i}"].label for i in range(3)] == [*SAID]


def test_a_group_takes_no_single_judgements_and_other_criteria(panel):
    with pytest.raises(ValueError, match="this panel has those of a group"):
        panel.load([1, 2, 3])
    with pytest.raises(ValueError, match="this panel has 3 criteria"):
        panel.load(group([[1], [2]]))
    alone = ahp_panel(Judgements(NAMES, [1, 1, 1]))
    alone.load(THREE)
    assert alone.judgements == THREE.judgements


def test_a_group_goes_to_a_file_and_back(panel):
    panel.judge.value = "Ben"
    panel.boxes[0, 2].value = ""
    panel.share.value = 2.5
    work = Session(door_handle_study(), DoorHandleCam(), {"importance": panel.given})
    again = from_json(to_json(work)).judgements["importance"]
    assert again == panel.given
    assert (again.said["Ben"].above, again.shares) == ((1 / 2, None, 6), (1, 2.5, 1))
    with pytest.raises(ValueError, match="judgements of 'importance' that cannot be: the weight of Anna is -1"):
        from_json(to_json(work).replace('"shares": [\n     1.0,', '"shares": [\n     -1.0,'))


def test_a_page_of_searches_keeps_all_judges(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    study = door_handle_study()
    judged = ahp_panel(group([Judgements([m.name for m in study.minimise], [said]) for said in (2, 8)]))
    finder = pareto_panel(explore(study.start), study, importance=judged)
    assert_allclose(finder.picker.choice.weights, [0.8, 0.2])
    session = from_json(to_json(finder.session()))
    judged.boxes[0, 1].value = "1/2"
    finder.load(session)
    assert judged.given == session.judgements["importance"] == judged.start


def test_twelve_criteria_show_the_pairs_of_one():
    w = np.arange(1, 13.0)
    names = [f"wish {k}" for k in range(12)]
    panel = ahp_panel(Judgements(names, w[:, None] / w))

    def shown():
        return [pair for pair, box in panel.boxes.items() if box.visible and panel.sliders[pair].visible]

    assert shown() == [(0, k) for k in range(1, 12)]
    panel.of.value = 5
    assert shown() == [*((k, 5) for k in range(5)), *((5, k) for k in range(6, 12))]
    panel.boxes[2, 5].value = "4"
    assert panel.judgements.array[2, 5] == 4
    assert panel.judgements.worst == {(2, 5): pytest.approx(1 / 2)}
    few = ahp_panel(Judgements(names[:5], w[:5, None] / w[:5]))
    assert not few.of.visible
    assert all(box.visible for box in few.boxes.values())


def test_fifteen_criteria_go_to_a_file_and_back_and_into_a_panel():
    names = [f"wish {k}" for k in range(15)]
    said = np.random.default_rng(1).integers(1, 10, 105).tolist()
    said[7] = None
    judged = Judgements(names, said)
    session = Session(door_handle_study(), DoorHandleCam(), {"importance": judged, "group": group([judged, judged])})
    again = from_json(to_json(session)).judgements
    assert again == session.judgements
    panel = ahp_panel(again["group"])
    panel.of.value = 14
    panel.boxes[3, 14].value = "1/4"
    assert panel.said.array[3, 14] == 1 / 4
    assert panel.judgements.array[3, 14] == pytest.approx((judged.array[3, 14] / 4) ** 0.5)
