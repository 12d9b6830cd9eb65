"""The search against problems whose fronts are known, against brute force and against chance."""

import os
import pickle
import signal
import subprocess
import sys
import time
from base64 import b64encode
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, Measure, Study, door_handle_study, nsga2
from camkit.machines import door_handle_paper_study, lift_curve_study
from camkit.machines.door_handle import EXPANDED_SPACE
from camkit.motion import Poly345
from camkit.quantities import Design, quantity
from camkit.search.checkpoint import Checkpoint, fingerprint, read, versions
from camkit.search.front import Front, dominated, front_of, reference_point
from camkit.search.nsga2 import nsga2_steps
from camkit.units import mm


@dataclass(frozen=True)
class Ball(Design):
    """A point of the plane; it cannot be built where y is above 3."""

    x: float = quantity("x", 1, -5, 5, "", "across", above=None)
    y: float = quantity("y", 1, 0, 4, "", "up", above=None)

    def analyse(self, n=1):
        buildable = np.where(np.asarray(self.y) <= 3, 1.0, np.nan)
        return np.broadcast_arrays(self.x * buildable, self.y * buildable)


def last(values):
    return np.asarray(values)[..., 0] if np.ndim(values) else values


near_0 = Measure("distance from 0", "", lambda p: last(p[0] ** 2 + p[1] ** 2))
near_2 = Measure("distance from 2", "", lambda p: last((p[0] - 2) ** 2 + p[1] ** 2))
right = Measure("place", "mm", lambda p: last(p[0]))
SPACE = {"x": (-5.0, 5.0), "y": (0.0, 4.0)}


def two_places(**limits):
    """Schaffer's problem in the plane: near (0, 0) and near (2, 0); the front is sqrt(f1) + sqrt(f2) = 2."""
    return Study(Ball(), SPACE, (near_0, near_2), **limits)


# ---------------------------------------------------------------- a known front


def test_the_front_of_schaffers_problem():
    front = nsga2(two_places(), population=60, generations=80, seed=1)
    assert len(front) > 50
    assert_allclose(np.sqrt(front.f).sum(1), 2, atol=0.05)
    assert_allclose(front.f[[0, -1], [0, 1]], 0, atol=0.01)
    # Up to (4, 4) the front dominates 16 - 8/3: the integral of (sqrt(f1) - 2)^2 from 0 to 4 is 8/3.
    assert 0.98 * (16 - 8 / 3) < front.hypervolume((4, 4)) < 16 - 8 / 3


def test_a_limit_cuts_the_front():
    """With x of at least 1 the front begins at f1 = f2 = 1."""
    front = nsga2(two_places(at_least={right: 1.0}), population=60, generations=80, seed=2)
    assert (front.x[:, 0] >= 1).all()
    assert_allclose(front.f[0], [1, 1], atol=0.02)
    # Up to (4, 4): from f1 = 1 to 4 the integral of 4 - (sqrt(f1) - 2)^2 is 12 - 5/6.
    assert 0.98 * (12 - 5 / 6) < front.hypervolume((4, 4)) < 12 - 5 / 6


def test_a_minus_sign_makes_large():
    front = nsga2(Study(Ball(), SPACE, (-right, near_0)), population=40, generations=60, seed=1)
    assert front.f[0, 0] == pytest.approx(-5, abs=0.05)
    # The front is f2 = f1^2 from f1 = -5 to 0; up to (0, 25) it dominates 125 - 125/3.
    assert 0.97 * (125 - 125 / 3) < front.hypervolume((0, 25)) < 125 - 125 / 3


# ---------------------------------------------------------------- what every front is


@pytest.fixture(scope="module")
def lift():
    return nsga2(lift_curve_study(), population=40, generations=25, seed=3)


def test_a_front_is_repeatable_by_its_seed(lift):
    again = nsga2(lift_curve_study(), population=40, generations=25, seed=3)
    assert_array_equal(again.x, lift.x)
    assert_array_equal(again.f, lift.f)
    other = nsga2(lift_curve_study(), population=40, generations=25, seed=4)
    assert not np.array_equal(other.f, lift.f)


def test_a_front_is_feasible_and_nondominated(lift):
    evaluation = lift.study.evaluate(lift.x)
    assert evaluation.feasible.all()
    assert_array_equal(evaluation.f, lift.f)
    assert not brute_dominated(lift.f).any()
    low, high = lift.study.bounds
    assert ((lift.x >= low) & (lift.x <= high)).all()
    assert (np.diff(lift.f[:, 0]) >= 0).all()
    assert lift.message == ""


def test_a_member_of_a_front_is_a_design_again(lift):
    for i in (0, len(lift) - 1, -1):
        cam = lift[i]
        assert isinstance(cam, DoorHandleCam)
        assert_array_equal([getattr(cam, name) for name in lift.study.free], lift.x[i])
        analysis = cam.analyse(lift.study.angles)
        assert_array_equal([measure(analysis) for measure in lift.study.minimise], lift.f[i])
    assert len(list(lift)) == len(lift)


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("whole", [False, True])
def test_a_search_beats_chance_with_the_same_budget(seed, whole):
    study = door_handle_study(space=EXPANDED_SPACE) if whole else lift_curve_study()
    reference = reference_point(study)
    front = nsga2(study, population=40, generations=25, seed=seed)
    chance = np.random.default_rng(seed).uniform(*study.bounds, size=(1000, len(study.free)))
    assert front.hypervolume(reference) > front_of(study.evaluate(chance), study).hypervolume(reference)


def test_leaving_early_keeps_the_front_so_far():
    study = two_places()
    for generation in nsga2_steps(study, 20, 1000, 1):
        assert generation.of == 1000
        assert generation.feasible == generation.evaluation.feasible.sum() <= 20
        if generation.number == 7:
            break
    assert_array_equal(generation.front.f, nsga2(study, 20, 7, 1).f)


def test_a_generation_is_one_evaluation():
    calls = []

    class Counting(Study):
        def evaluate(self, x):
            calls.append(len(x))
            return super().evaluate(x)

    nsga2(Counting(Ball(), SPACE, (near_0, near_2)), population=30, generations=9, seed=1)
    assert calls == [30] * 9


# ---------------------------------------------------------------- domination and volume


def brute_dominated(f):
    return np.array([any((g <= h).all() and (g < h).any() for g in f) for h in f], dtype=bool)


few = st.integers(0, 4).map(float)
any_number = few | st.sampled_from([np.inf, -np.inf, np.nan, -0.0])


@given(arrays(float, st.tuples(st.integers(0, 12), st.integers(1, 4)), elements=any_number))
@settings(deadline=None)
def test_dominated_is_its_definition(f):
    assert dominated(f).tolist() == brute_dominated(f).tolist()


@given(arrays(float, st.tuples(st.integers(1, 8), st.just(2)), elements=few))
@settings(deadline=None)
def test_the_hypervolume_counts_the_cells_that_are_dominated(f):
    """On a grid of whole numbers: cells below the reference point whose lower corner some member beats or equals."""
    study = two_places()
    corners = np.stack(np.meshgrid(np.arange(5), np.arange(5)), -1).reshape(-1, 2)
    cells = sum((f <= corner).all(1).any() for corner in corners)
    assert Front(study, f, f).hypervolume((5, 5)) == pytest.approx(cells)


def test_the_reference_point_belongs_to_the_study_alone():
    study = two_places(at_least={right: 1.0})
    point = reference_point(study)
    assert_array_equal(point, reference_point(two_places(at_least={right: 1.0})))
    far = np.max([[25 + 9, 9 + 9], [1 + 9, 1 + 9]], axis=0)  # the corners of what is feasible
    assert (point <= far).all()
    assert (point > 0.7 * far).all()
    front = nsga2(study, 20, 20, 1)
    assert front.hypervolume() == front.hypervolume(point) > 0


def test_the_reference_point_of_a_study_that_nothing_satisfies():
    """Then of what can be built at least, so that a hypervolume still is a number."""
    study = two_places(at_least={right: 9.0})
    assert np.isfinite(reference_point(study)).all()
    assert nsga2(study, 20, 5, 1).hypervolume() == 0
    nothing = Study(Ball(), {"y": (3.5, 4.0)}, (near_0, near_2))
    assert nsga2(nothing, 8, 2, 1).hypervolume() == 0
    assert np.isfinite(reference_point(nothing)).all()


# ---------------------------------------------------------------- fronts without a design


def test_an_empty_front_says_which_limit_stood_in_the_way():
    front = nsga2(two_places(at_least={right: 0.01}, at_most={near_2: 0.01, near_0: 2.0}), 60, 60, 1)
    assert len(front) == 0
    assert front.f.shape == (0, 2)
    assert front.message == (
        f"no design that was evaluated keeps every limit; the nearest misses the distance from 0 of at most 2 by "
        f"{front.message.split()[-1]}"
    )
    # The nearest: x with the least (x^2/2 - 1) + ((x - 2)^2/0.01 - 1) where both are above 0 is x = 1.9: 3.61 - 2.
    assert float(front.message.split()[-1]) == pytest.approx(1.61, abs=0.01)


def test_an_empty_front_says_the_limit_in_its_unit():
    front = nsga2(two_places(at_least={right: 8.0}), 40, 60, 1)
    assert front.message == (
        "no design that was evaluated keeps every limit; the nearest misses the place of at least 8000 mm by 3000 mm"
    )


def test_an_empty_front_says_by_how_much_a_limit_of_nothing_is_missed():
    study = Study(Ball(), {"x": (1.0, 3.0)}, (near_0, near_2), at_most={right: 0.0})
    assert front_of(study.evaluate([[1.0], [3.0]]), study).message.endswith("the place of at most 0 mm by 1000 mm")


def test_an_empty_front_says_that_nothing_can_be_built():
    front = nsga2(Study(Ball(), {"y": (3.5, 4.0)}, (near_0,)), 8, 3, 1)
    assert front.message == "no design that was evaluated can be built; widen or move the bounds"


# ---------------------------------------------------------------- a front under other objectives


def test_new_weights_judge_the_same_designs(lift):
    study = lift.study.with_weights((0, 0, 1))
    judged = lift.judged_by(study)
    assert judged.study is study
    assert set(map(tuple, judged.x)) <= set(map(tuple, lift.x))
    assert_array_equal(judged.f, study.evaluate(judged.x).f)
    dropped = {tuple(x) for x in lift.x} - {tuple(x) for x in judged.x}
    everyone = study.evaluate(lift.x)
    assert {tuple(x) for x in lift.x[brute_dominated(everyone.f)]} == dropped


def test_an_empty_front_stays_empty_when_judged_anew():
    empty = nsga2(two_places(at_least={right: 9.0}), 8, 2, 1)
    again = empty.judged_by(Study(Ball(), SPACE, (near_0,)))
    assert (len(again), again.f.shape, again.message) == (0, (0, 1), empty.message)


def test_the_papers_problem_has_a_front_of_smaller_arms(lift):
    """Objective values of the start are (1, -47.04 mm); the front does better in effort at no less radius."""
    better = lift.f[lift.f[:, 1] <= -47.04 * mm]
    assert better[:, 0].min() < 0.95


# ---------------------------------------------------------------- a search that was killed goes on


def every_number(generation):
    return [generation.number, *(getattr(generation.evaluation, k).tolist() for k in "xfg")]


@pytest.mark.parametrize(
    "study",
    [
        two_places(),
        two_places(at_least={right: 1.0}),
        lift_curve_study(),
        door_handle_study(),
        door_handle_paper_study(),
    ],
    ids=["no limits", "a limit", "lift", "whole cam", "the paper's box: hardly anything feasible"],
)
@pytest.mark.parametrize("stop", [1, 2, 7])
def test_a_search_goes_on_as_if_it_had_never_stopped(study, stop, tmp_path):
    """Bit by bit, wherever it was stopped, and without evaluating anything twice."""
    path = tmp_path / "going.search"
    whole = [every_number(g) for g in nsga2_steps(study, 24, 12, 5)]
    before = [every_number(g) for g in islice(nsga2_steps(study, 24, 12, 5, path), stop)]
    after = [every_number(g) for g in nsga2_steps(study, 24, 12, 5, path)]
    assert before == whole[:stop]
    assert after == whole[stop - 1 :]
    assert [every_number(g) for g in nsga2_steps(study, 24, 12, 5, path)] == whole[-1:]
    assert os.listdir(tmp_path) == ["going.search"]


def test_a_search_goes_on_with_more_generations(tmp_path):
    study, path = door_handle_study(), tmp_path / "going.search"
    nsga2(study, 20, 5, 1, path)
    assert_array_equal(nsga2(study, 20, 9, 1, path).f, nsga2(study, 20, 9, 1).f)


KILLED = """
import sys
from camkit import door_handle_study
from camkit.search.nsga2 import nsga2_steps
for generation in nsga2_steps(door_handle_study(), 40, 10_000, 3, sys.argv[1]):
    print(generation.number, flush=True)
"""


def test_a_killed_process_loses_no_generation(tmp_path):
    path = tmp_path / "going.search"
    process = subprocess.Popen([sys.executable, "-c", KILLED, path], stdout=subprocess.PIPE, text=True)
    told = list(islice(process.stdout, 12))
    time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    told += process.stdout.readlines()
    assert process.wait() == -signal.SIGKILL
    last = int([line for line in told if line.endswith("\n")][-1])
    kept = read(path)
    assert last <= kept.number <= last + 1  # written before it is told
    front = nsga2(door_handle_study(), 40, kept.number + 10, 3, path)
    again = nsga2(door_handle_study(), 40, kept.number + 10, 3)
    assert_array_equal(front.x, again.x)
    assert_array_equal(front.f, again.f)
    assert front.record["seconds"] > kept.seconds


def test_no_generations_are_refused():
    with pytest.raises(ValueError, match=r"^the number of generations is 0; it must be a whole number of at least 1$"):
        nsga2(two_places(), 8, 0)


def test_a_front_says_how_it_was_found(tmp_path):
    front = nsga2(two_places(), 20, 5, 7, tmp_path / "going.search")
    told = dict(front.record)
    assert 0 < told.pop("seconds") < 60
    assert told == {"population": 20, "generations": 5, "seed": 7, "versions": versions()}
    assert list(told["versions"]) == ["python", "camkit", "numpy", "scipy", "pymoo"]
    assert told["versions"]["numpy"] == np.__version__
    assert front.judged_by(two_places(at_least={right: 1.0})).record == front.record


def test_a_study_is_recognised_by_what_it_says():
    study = door_handle_study()
    same = study.replace(start=study.start.replace(lift_arm=0.051))  # lift_arm is free
    assert fingerprint(study) == fingerprint(same)
    others = [
        study.replace(start=study.start.replace(motion_law=Poly345())),
        study.with_weights((0.5, 0.25, 0.25)),
        study.replace(at_most={}),
        study.replace(free={**study.free, "lift_arm": (0.045, np.nextafter(0.055, 1))}),
    ]
    assert len({fingerprint(s) for s in (study, *others)}) == 5  # more angles say the same: peaks lie between them


@pytest.fixture
def kept(tmp_path):
    path = tmp_path / "lift.search"
    nsga2(two_places(), 8, 3, 1, path)
    return path


def changed(path, **entries):
    replace(read(path), **entries).write(path)


def as_it_is(path):
    pass


DAMAGED = {}, "is damaged; delete it to begin anew"
REFUSED = {
    "another study": (as_it_is, {"study": two_places(at_least={right: 1.0})},
        "is of another study; name another file, or delete it to begin anew"),
    "another seed": (as_it_is, {"seed": 2}, "has the seed 1; here it is 2"),
    "another population": (as_it_is, {"population": 9}, "has the population 8; here it is 9"),
    "fewer generations": (as_it_is, {"generations": 2}, "has 3 generations; here are 2 to be run"),
    "another numpy": (lambda path: changed(path, versions={**versions(), "numpy": "1.0"}), {},
        f"was written with numpy 1.0; with numpy {np.__version__} the search would not go on as it began"),
    "another algorithm": (lambda path: changed(path, algorithm="GA"), {},
        "is of the algorithm 'GA', which cannot go on faithfully; NSGA-II alone can"),
    "cut short": (lambda path: path.write_bytes(path.read_bytes()[:900]), *DAMAGED),
    "empty": (lambda path: path.write_bytes(b""), *DAMAGED),
    "text": (lambda path: path.write_text("front"), *DAMAGED),
    "a pickle": (lambda path: path.write_bytes(pickle.dumps([1, 2])), *DAMAGED),
    "a population too many": (lambda path: changed(path, population=9), *DAMAGED),
    "no random generator": (lambda path: changed(path, random={}), *DAMAGED),
    "a negative generation": (lambda path: changed(path, number=-1), *DAMAGED),
    "a count of text": (lambda path: changed(path, number="3"), *DAMAGED),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_a_checkpoint_that_cannot_be_gone_on_from_is_refused(kept, case):
    spoil, settings, sentence = REFUSED[case]
    spoil(kept)
    with pytest.raises(ValueError, match=r"^the checkpoint lift\.search ") as refusal:
        nsga2(**{"study": two_places(), "population": 8, "generations": 3, "seed": 1, **settings}, checkpoint=kept)
    assert str(refusal.value) == f"the checkpoint lift.search {sentence}"


def test_a_flipped_bit_is_seen(kept):
    """Wherever in the numbers it is: the file carries a check sum."""
    whole = bytearray(kept.read_bytes())
    at = whole.index(b64encode(read(kept).x.tobytes())[:8])
    whole[at] ^= 1
    kept.write_bytes(whole)
    with pytest.raises(ValueError, match="is damaged"):
        read(kept)


def test_another_file_and_no_file_are_refused(kept):
    kept.write_text('{"schema": "camkit-checkpoint/9"}')
    with pytest.raises(ValueError, match=r"the file lift\.search is no checkpoint of the schema 'camkit-checkpoint/3'"):
        read(kept)
    with pytest.raises(ValueError, match=r"there is no checkpoint none\.search"):
        read(kept.with_name("none.search"))


def test_a_checkpoint_is_replaced_whole(kept, monkeypatch):
    """While the new one is half written the old one is read."""
    before = read(kept)

    def breaks(path, content):
        with path.open("wb") as file:
            file.write(content[:100])
        raise OSError("the disk is full")

    monkeypatch.setattr(Path, "write_bytes", breaks)
    with pytest.raises(OSError, match="full"):
        before.write(kept)
    assert isinstance(read(kept), Checkpoint)
    assert read(kept).number == before.number


def test_numbers_of_numpy_are_the_numbers_that_they_are():
    """An unsigned population is no larger than the same number without a type."""
    plain, unsigned = (nsga2(two_places(), kind(8), kind(3), kind(1)) for kind in (int, np.uint16))
    assert_array_equal(unsigned.x, plain.x)
