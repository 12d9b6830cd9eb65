"""Every search goes on from its checkpoint, after a stop or a killed process, to the result that it has without one."""

import json
import os
import signal
import subprocess
import sys
import textwrap
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from camkit import mm, shaft_study
from camkit.machines import cam_lever_study, door_handle_study, high_speed_study
from camkit.machines import high_speed_measures as fast
from camkit.search import search
from camkit.search.parts import Parts, _chained
from camkit.units import cm, deg

HIGH = high_speed_study(angles=41)
TWO = HIGH.replace(minimise=(fast.peak_stress, fast.peak_wear))
DOOR = door_handle_study()
CASES = {
    "slsqp": (HIGH, {"starts": 4}),
    "de": (HIGH, {"designs": 640}),
    "ga": (HIGH, {"designs": 1000}),
    "competitive": (HIGH, {"designs": 700}),
    "epsilon_constraint": (TWO, {"points": 4}),
    "fast_front": (DOOR.replace(angles=61), {"size": 20}),
    "cycle_time": (
        cam_lever_study(free_laws=False).replace(angles=41),
        {"limit": 9 / cm**0.5, "shortest": 50 * deg, "longest": 61 * deg, "tolerance": 1 * deg},
    ),
    "nsga2": (DOOR.replace(angles=61), {"population": 12, "generations": 6}),
}


def whole(method, **more):
    study, options = CASES[method]
    return list(search(study, method, **options, **more))


def result(step):
    """All that a search has found, to the last bit."""
    evaluation = step.evaluation
    told = (step.evaluated, step.message, step.number, step.of)
    best = step.best and (step.best.x.tolist(), step.best.f, step.best.message, step.best.ends, step.best.evaluations)
    return told, best, evaluation.x.tolist(), evaluation.f.tolist(), evaluation.g.tolist()


@pytest.fixture(scope="module")
def unbroken():
    return cache(whole)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("method", CASES)
def test_a_search_that_was_stopped_ends_as_without_the_break(method, share, unbroken, tmp_path):
    path, steps = tmp_path / "a.search", unbroken(method)
    whole_until(method, path, int(share * len(steps)))
    *_, last = whole(method, checkpoint=path)
    assert result(last) == result(steps[-1])
    assert last.seconds_left == 0


def whole_until(method, path, count):
    study, options = CASES[method]
    for k, _ in enumerate(search(study, method, checkpoint=path, **options)):
        if k >= count:
            break


@pytest.mark.parametrize("method", [name for name in CASES if name != "nsga2"])
def test_what_has_ended_is_not_computed_again(method, unbroken, tmp_path, monkeypatch):
    path, part, expected = tmp_path / "a.search", Parts.part, result(unbroken(method)[-1])
    whole(method, checkpoint=path)

    def refused():
        raise AssertionError("computed again")

    monkeypatch.setattr(Parts, "part", lambda self, asked, work, designs: part(self, asked, refused, designs))
    assert result(whole(method, checkpoint=path)[-1]) == expected


@pytest.mark.parametrize("method", CASES)
def test_progress_and_time_left_are_told(method, unbroken):
    steps = unbroken(method)
    assert all(0 <= step.number <= step.of for step in steps)
    assert steps[-1].number == steps[-1].of > 0
    assert (np.diff([step.number for step in steps]) >= 0).all()
    middle = [step for step in steps if 0 < step.number < step.of]
    assert middle, "it says where it stands before it ends"
    assert all(0 < step.seconds_left < 1e4 for step in middle)


def test_descents_are_counted():
    steps = whole("slsqp")
    assert {step.number for step in steps} >= {0, 1, 2, 3, 4}
    assert steps[0].of == 5, "four starts, and the exact end"


def test_a_killed_process_leaves_what_had_ended(tmp_path, unbroken):
    path = tmp_path / "a.search"
    program = textwrap.dedent(f"""
        import os, signal
        from camkit.machines import high_speed_study
        from camkit.search import search

        for step in search(high_speed_study(angles=41), "slsqp", starts=4, checkpoint={str(path)!r}):
            if step.number == 2:
                os.kill(os.getpid(), signal.SIGKILL)
    """)
    ended = subprocess.run([sys.executable, "-c", program], env=os.environ, check=False)
    assert ended.returncode == -signal.SIGKILL
    lines = path.read_bytes().splitlines()
    assert len(lines) == 3, "what it is, and two descents"
    with path.open("ab") as file:
        file.write(b'{"seconds": 1.0, "arr')  # a line that was being written
    *_, last = whole("slsqp", checkpoint=path)
    assert result(last) == result(unbroken("slsqp")[-1])
    assert last.seconds > json.loads(lines[-1].rpartition(b"\t")[0])["seconds"], "both parts of its time count"


def test_a_robust_search_goes_on(tmp_path):
    study = shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
    steps = list(search(study, "slsqp"))
    for step in search(study, "slsqp", checkpoint=tmp_path / "a.search"):
        if step.number == 2:
            break
    *_, last = search(study, "slsqp", checkpoint=tmp_path / "a.search")
    assert result(last) == result(steps[-1])


# ---------------------------------------------------------------- files that do not belong here


@pytest.fixture
def kept(tmp_path):
    path = tmp_path / "a.search"
    whole_until("slsqp", path, 60)
    return path


def edited(path, number, **changes):
    """As somebody would write it who knows how the digests are made."""
    digest, lines = "", []
    for k, line in enumerate(path.read_text().splitlines()):
        entry = json.loads(line.rpartition("\t")[0])
        text = json.dumps({**entry, **(changes if k == number else {})})
        digest = _chained(digest, text)
        lines.append(f"{text}\t{digest}\n")
    path.write_text("".join(lines))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda p: p.write_text(p.read_text().replace('"arrays"', '"arrows"', 1)), "is damaged; delete it"),
        (lambda p: p.write_bytes(b"\xff\n"), "is damaged; delete it"),
        (lambda p: edited(p, 0, schema="other/1"), "is damaged; delete it"),
        (lambda p: edited(p, 0, study="0" * 64), "is of another study"),
        (lambda p: edited(p, 0, method="ga"), "has the method ga; here it is slsqp"),
        (lambda p: edited(p, 0, versions={}), "has other versions"),
        (lambda p: edited(p, 1, arrays=[]), "is damaged; delete it"),
        (lambda p: edited(p, 1, arrays=[[[2], "AAAA"]]), "is damaged; delete it"),
        (lambda p: edited(p, 1, seconds=-1.0), "is damaged; delete it"),
        (lambda p: edited(p, 1, arrays=[[[0], ""], [[0], ""]]), "is of another search; delete it"),
    ],
)
def test_a_file_that_does_not_belong_is_refused_in_a_sentence(kept, change, sentence):
    change(kept)
    with pytest.raises(ValueError, match=sentence):
        whole("slsqp", checkpoint=kept)


def test_other_options_are_another_search(kept):
    study, _ = CASES["slsqp"]
    with pytest.raises(ValueError, match="has other options"):
        search(study, "slsqp", starts=3, checkpoint=kept)


def test_a_search_goes_on_where_its_file_cannot_be_written(tmp_path, unbroken):
    steps = whole("slsqp", checkpoint=tmp_path / "nowhere" / "a.search")
    assert steps[-1].unkept == "no such file or directory"
    assert replace(steps[-1], unkept="").best.f == unbroken("slsqp")[-1].best.f


def test_a_link_is_not_followed(tmp_path):
    target = tmp_path / "mine.txt"
    target.write_text("mine")
    (tmp_path / "a.search").symlink_to(target)
    with pytest.raises(ValueError, match="is damaged; delete it"):
        whole("slsqp", checkpoint=tmp_path / "a.search")
    assert target.read_text() == "mine"
