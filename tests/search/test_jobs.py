"""What processes share comes to the same end, to the last bit, as what one does; what one loses is done again."""

import json
import os
import signal
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from camkit import Study, mm, shaft_study
from camkit.machines import door_handle_study, high_speed_study
from camkit.search import compute, every, front_of, jobs, search, seeds
from camkit.search.jobs import Cost, Crew, crew_of, done, pays
from camkit.study import Sweep

DOOR = door_handle_study().replace(angles=61)
HIGH = high_speed_study(angles=41)
SHAFT = shaft_study()
ROBUST = SHAFT.under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
CASES = {
    "nsga2": (DOOR, "nsga2", {"population": 12, "generations": 6, "seeds": range(4)}),
    "under tolerances": (ROBUST, "de", {"designs": 300, "seeds": (3, 1, 2)}),
    "a minimum": (HIGH, "slsqp", {"recheck": 61, "seeds": np.array([5, 6])}),
    "a grid": (DOOR, "every", {"designs": 12}),
    "a grid under tolerances": (ROBUST, "every", {"designs": (30, 40)}),
    "a table": (SHAFT, "every", {"designs": np.linspace(*SHAFT.bounds, 500)}),
}


@pytest.fixture
def eager(monkeypatch):
    """Processes are begun however small the work is."""
    monkeypatch.setattr(jobs, "BEGIN", -1e9)
    monkeypatch.setattr(seeds, "TRIED", 0.0)
    monkeypatch.setattr(every, "CHUNK", 256)


@pytest.fixture
def alone(monkeypatch):
    """No process may be begun."""
    monkeypatch.setattr(jobs, "_parallel", None)


def result(step):
    """All that a search has found, to the last bit, but for how long it took."""
    e, best = step.evaluation, step.best
    told = [step.number, step.of, step.evaluated, step.message, *(value.tobytes() for value in (e.x, e.f, e.g))]
    if best is not None:
        descended = best.descended if best.descended is None else best.descended.tobytes()
        told += [best.x.tobytes(), best.f, best.feasible, best.evaluations, best.ends, best.active, descended]
        told += [best.message, best.study.angles]
    return [*told, {seed: result(each)[2:] for seed, each in step.seeds.items()}]


def last(case, **more):
    study, method, options = CASES[case]
    *_, step = search(study, method, **options, **more)
    return step


@pytest.mark.parametrize("case", CASES)
def test_two_processes_find_what_one_finds(case, eager):
    assert result(last(case, jobs=2)) == result(last(case))


@pytest.mark.parametrize("case", CASES)
def test_small_work_is_done_here(case, alone):
    assert last(case, jobs=2).number


def test_each_seed_is_a_search_of_its_own():
    step = last("nsga2")
    study, method, options = CASES["nsga2"]
    for seed in options["seeds"]:
        *_, own = search(study, method, population=12, generations=6, seed=seed)
        assert step.seeds[seed].front.f.tobytes() == own.front.f.tobytes()
    every_f = np.concatenate([each.front.f for each in step.seeds.values()])
    assert all(not (every_f <= f).all(-1)[(every_f < f).any(-1)].any() for f in step.front.f)
    assert step.front.record["seeds"] == [0, 1, 2, 3]


def test_the_best_of_all_seeds_is_the_minimum():
    step = last("a minimum")
    assert step.best.f == min(each.best.f for each in step.seeds.values())
    assert step.best.design == step.best.study.design(step.best.x)


@pytest.mark.parametrize("case", ["a grid", "a grid under tolerances", "a table"])
def test_every_design_is_looked_at(case, eager):
    study, _, options = CASES[case]
    step, given = last(case), options["designs"]
    if isinstance(given, np.ndarray):
        x = given
    else:
        counts = given if isinstance(given, tuple) else [given] * len(study.free)
        axes = [np.linspace(*b, n) for b, n in zip(study.bounds.T, counts, strict=True)]
        x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
    said = study.evaluate(x)
    assert step.evaluated == len(x)
    if len(study.minimise) == 1:
        f = np.where(said.feasible, said.f[:, 0], np.inf)
        assert step.best.x.tolist() == x[f.argmin()].tolist()
        return
    expected = front_of(said, study)
    assert np.unique(step.front.f, axis=0).tolist() == pytest.approx(np.unique(expected.f, axis=0), rel=1e-12)


def test_a_grid_without_a_feasible_design_says_what_comes_nearest():
    start, (outer, inner) = SHAFT.start, SHAFT.bounds.T
    study = Study(start, SHAFT.free, SHAFT.minimise, at_most={**SHAFT.at_most, SHAFT.minimise[0]: 1e-3})
    *_, step = search(study, "every", designs=5)
    assert not step.best.feasible
    assert step.message.startswith("Every design was looked at. No design was found that keeps every limit; this one")
    grid = np.stack(np.meshgrid(np.linspace(*outer, 5), np.linspace(*inner, 5), indexing="ij"), -1).reshape(-1, 2)
    said = study.evaluate(grid)
    missed = np.where(np.isfinite(said.f[:, 0]), said.missed.sum(-1), np.inf)
    assert step.best.x.tolist() == grid[missed.argmin()].tolist()


def test_all_options_of_a_menu_are_looked_at():
    study = SHAFT.replace(free={"outer_diameter": (0.12, 0.14), "inner_diameter": {0.1, 0.103}})
    *_, step = search(study, "every", designs=7)
    assert step.of == 14
    *_, step = search(study, "every", designs=(9, 2))
    assert step.of == 18
    with pytest.raises(ValueError, match=r"^the inner_diameter has 2 options, all of which are looked at; given is 3$"):
        search(study, "every", designs=(9, 3))


# ---------------------------------------------------------------- sweeps

SWEPT = SHAFT.freeing({"outer_diameter": (0.12, 0.14)}).under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})


def test_a_sweep_is_shared(eager):
    shared, one = Sweep(SWEPT, n=700), Sweep(SWEPT, n=700)
    steps = list(compute(shared, jobs=2))
    assert len(steps) > 2
    assert [step.number for step in steps] == sorted(step.number for step in steps)
    list(compute(one))
    assert vars(one).keys() >= {"evaluation"}
    for name in ("x", "f", "g"):
        assert getattr(shared.evaluation, name).tobytes() == getattr(one.evaluation, name).tobytes()
    assert one.limits == pytest.approx(Sweep(SWEPT, n=700).limits, rel=1e-12)


def test_a_sweep_that_was_stopped_goes_on(eager, tmp_path, monkeypatch):
    path, sweep = tmp_path / "a.sweep", Sweep(SWEPT, n=700)
    for step in compute(sweep, checkpoint=path):
        if step.number > 200:
            break
    assert "evaluation" not in vars(sweep)
    asked, evaluate = [], type(SWEPT).evaluate
    monkeypatch.setattr(type(SWEPT), "evaluate", lambda self, x: [asked.append(len(x)), evaluate(self, x)][1])
    *_, end = compute(sweep, checkpoint=path)
    assert end.number == 700
    monkeypatch.undo()
    assert sum(asked) < 700 - step.number + 200  # the study is recognised, and what is made once is made
    assert sweep.limits == pytest.approx(Sweep(SWEPT, n=700).limits, rel=1e-12)


# ---------------------------------------------------------------- what is lost


def squared(here, marker, fails, k):
    """The square of ``k``; the first process other than that ``here`` which comes to 3 ends, or fails."""
    if k == 3 and os.getpid() != here and not marker.exists():
        marker.write_text("")
        if fails == "killed":
            os.kill(os.getpid(), signal.SIGKILL)
        raise MemoryError
    return k * k


@pytest.mark.parametrize(("fails", "told"), [("killed", "TerminatedWorkerError"), ("raised", "MemoryError")])
def test_a_lost_task_is_done_again(fails, told, tmp_path):
    work = partial(squared, os.getpid(), tmp_path / "marker", fails)
    with crew_of(2, "") as crew, pytest.warns(RuntimeWarning, match=f"^a part of the work was lost .* again: {told}"):
        assert sorted(done(work, range(8), crew)) == [(k, k * k) for k in range(8)]
    assert (tmp_path / "marker").exists()


def deadly(here, k):
    if os.getpid() != here:
        os.kill(os.getpid(), signal.SIGKILL)
    return k


def test_what_kills_every_process_is_done_here():
    with crew_of(2, "") as crew, pytest.warns(RuntimeWarning, match="again: TerminatedWorkerError"):
        assert sorted(done(partial(deadly, os.getpid()), range(3), crew)) == [(k, k) for k in range(3)]


def refused(k):
    raise ValueError(f"{k} cannot be built")


def test_what_fails_everywhere_fails_here():
    with (
        crew_of(2, "") as crew,
        pytest.warns(RuntimeWarning, match="ValueError: "),
        pytest.raises(ValueError, match="cannot be built"),
    ):
        list(done(refused, range(5), crew))


def slow(k):
    time.sleep(0.05 if k == 0 else 60)
    return k


def test_leaving_the_loop_ends_the_processes(recwarn):
    with crew_of(2, "") as crew:
        next(steps := done(slow, range(4), crew))
        begun = time.monotonic()
        steps.close()
    assert time.monotonic() - begun < 30
    assert not recwarn.list


def pools(k):
    import threadpoolctl

    np.linalg.inv(np.eye(2))
    told = [pool["num_threads"] for pool in threadpoolctl.threadpool_info() if pool["user_api"] == "blas"]
    return told, os.environ["OMP_NUM_THREADS"], os.environ.get("CAMKIT_CACHE")


def test_processes_have_one_thread_each_and_the_same_cache(monkeypatch, tmp_path):
    pytest.importorskip("threadpoolctl")
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path))
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    crew = Crew(3)  # of which there are none yet
    for _, (threads, openmp, cache) in done(pools, range(3), crew):
        assert {*threads} == {1}
        assert (openmp, cache) == ("1", str(tmp_path))


# ---------------------------------------------------------------- goes on


@pytest.mark.parametrize(("case", "jobs", "count"), [("nsga2", 2, 1), ("a minimum", 1, 1), ("a grid", 1, 2)])
def test_what_has_ended_is_not_done_again(case, jobs, count, eager, tmp_path, monkeypatch):
    path, expected = tmp_path / "a.search", result(last(case))
    study, method, options = CASES[case]
    for k, _ in enumerate(search(study, method, checkpoint=path, jobs=jobs, **options), 1):
        if k == count:
            break
    lines = len(path.read_text().splitlines())
    assert lines > count
    assert result(last(case, checkpoint=path)) == expected
    begun = len(path.read_text().splitlines())
    monkeypatch.setattr(seeds, "_shared", None)
    monkeypatch.setattr(every.Work, "_shared", None)
    assert result(last(case, checkpoint=path)) == expected
    assert len(path.read_text().splitlines()) == begun


def test_seeds_can_be_added(tmp_path, monkeypatch):
    path, (study, method, options) = tmp_path / "a.search", CASES["nsga2"]
    given = {name: value for name, value in options.items() if name != "seeds"}
    list(search(study, method, seeds=(0, 1, 2), checkpoint=path, **given))
    first, *_, end = search(study, method, seeds=range(4), checkpoint=path, **given)
    assert first.number == 3
    assert result(end) == result(last("nsga2"))


def test_another_or_a_damaged_checkpoint_is_refused(tmp_path):
    path, (study, method, options) = tmp_path / "a.search", CASES["nsga2"]
    last("nsga2", checkpoint=path)
    with pytest.raises(ValueError, match=r"^the checkpoint a.search has other options"):
        search(study, method, **{**options, "population": 16}, checkpoint=path)
    with pytest.raises(ValueError, match=r"^the checkpoint a.search has the method nsga2 with seeds; here it is every"):
        search(study, "every", checkpoint=path)
    head, *lines = path.read_text().splitlines()
    path.write_text("\n".join([head, *lines[1:], ""]))
    with pytest.raises(ValueError, match=r"^the checkpoint a.search is damaged; delete it to begin anew$"):
        search(study, method, **options, checkpoint=path)


@pytest.mark.parametrize("wrong", ["told", "best", "tables", "designs"])
def test_what_somebody_wrote_is_refused(wrong, tmp_path, monkeypatch):
    from camkit.search import parts

    path, case = tmp_path / "a.search", "a minimum" if wrong in ("told", "best") else "a grid"
    last(case, checkpoint=path)
    text = [json.loads(line.partition("\t")[0]) for line in path.read_text().splitlines()]
    entry = text[-1]
    match wrong:
        case "told":
            entry["told"] = [1]
        case "best":
            entry["told"]["best"] = {"x": "y"}
        case "tables":
            entry["arrays"] = entry["arrays"][:3]
        case "designs":
            entry["arrays"][0] = parts._entry([5, 3])
    digest, lines = "", []
    for told in map(json.dumps, text):
        digest = parts._chained(digest, told)
        lines.append(f"{told}\t{digest}\n")
    path.write_text("".join(lines))
    with pytest.raises(ValueError, match=r"^the checkpoint a.search is damaged; delete it to begin anew$"):
        last(case, checkpoint=path)


# ---------------------------------------------------------------- what is refused

BAD = {
    "no job": ({"jobs": 0}, r"the number of jobs is 0; it must be a whole number of at least 1"),
    "half a job": ({"jobs": 2.5}, r"the number of jobs is 2.5; it must be a whole number"),
    "a word": ({"jobs": "two"}, r"the number of jobs is 'two'; it must be a whole number"),
    "a truth": ({"jobs": True}, r"the number of jobs is True; it must be a whole number"),
    "many": ({"jobs": 10**6}, r"the number of jobs is 1000000; it must be a whole number of at most 512"),
    "no address": ({"cluster": "nonsense"}, r"the cluster is 'nonsense'; it must be the address of its scheduler"),
    "no text": ({"cluster": 7}, r"the cluster is 7; it must be the address"),
    "both": ({"jobs": 2, "cluster": "tcp://a:1"}, r"there are 2 jobs and a cluster; give one of them"),
    "an endless range": ({"seeds": range(10**30)}, r"there are too many seeds; .* up to 10000"),
    "no seed": ({"seeds": ()}, r"there are 0 seeds; there must be one or more"),
    "twice": ({"seeds": (1, 2, 1)}, r"the seed 1 is there twice"),
    "one number": ({"seeds": 3}, r"the seeds are 3; they must be whole numbers, such as range\(30\)"),
    "letters": ({"seeds": "123"}, r"the seeds are '123'; they must be whole numbers"),
    "a part": ({"seeds": (1.5,)}, r"one of the seeds is 1.5; it must be a whole number"),
    "below": ({"seeds": (-1,)}, r"one of the seeds is -1; it must be a whole number of at least 0"),
    "seed and seeds": ({"seed": 1}, r"there are a seed and seeds; give one of them"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_is_no_job_is_refused(case):
    given, told = BAD[case]
    with pytest.raises(ValueError, match=f"^{told}"):
        search(DOOR, "nsga2", **{"seeds": range(3), **given})
    if given.keys() <= {"jobs", "cluster"}:
        with pytest.raises(ValueError, match=f"^{told}"):
            search(DOOR, "every", **given)
        with pytest.raises(ValueError, match=f"^{told}"):
            compute(Sweep(SWEPT), **given)


@pytest.mark.parametrize(
    ("designs", "told"),
    [
        (1, "the number of values of the .* is 1; it must be a whole number of at least 2"),
        ((10, 10), "there are 2 numbers of designs for 3 free quantities"),
        ((10, 10, "x"), "the number of values of the .* is 'x'"),
        (np.zeros((4, 2)), "the designs are .*; they must be a table with 3 columns"),
        (np.zeros((0, 3)), "the designs are .*; they must be a table"),
        (None, "the number of values of the .* is None"),
        (100_000, "these are 1e\\+15 designs; there can be up to 1e\\+12"),
    ],
)
def test_what_is_no_grid_is_refused(designs, told):
    with pytest.raises(ValueError, match=f"^{told}"):
        search(DOOR, "every", designs=designs)


def test_jobs_share_seeds_or_designs():
    with pytest.raises(ValueError, match=r"^jobs, or a cluster, share seeds or the designs of 'every'"):
        search(DOOR, "nsga2", jobs=2)
    with pytest.raises(ValueError, match=r"^the method 'fast_front' cannot search like this: .*'seed'"):
        search(DOOR, "fast_front", seeds=range(3))


def test_what_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "joblib", None)
    steps = search(DOOR, "every", jobs=2)
    with pytest.raises(ModuleNotFoundError, match=r"^more than one job needs joblib, .*: pip install 'camkit\[lab\]'$"):
        next(steps)
    monkeypatch.setitem(sys.modules, "distributed", None)
    steps = search(DOOR, "every", cluster="tcp://127.0.0.1:9")
    told = r"^a cluster needs distributed, which is not installed: pip install 'camkit\[cluster\]'$"
    with pytest.raises(ModuleNotFoundError, match=told):
        next(steps)
    assert next(search(DOOR, "every", designs=2)).number == 8  # one job needs neither


def test_processes_pay_where_they_save_more_than_they_take():
    plain, helped = Cost(1.0, 1.0), Cost(0.1, 1.0)
    assert not pays(plain, 100, Crew())
    assert not pays(plain, 1, Crew(8))
    assert pays(plain, 100, Crew(2))
    assert not pays(plain.times(1e-3), 100, Crew(2))
    assert not pays(helped, 2, Crew(2))


def test_a_file_that_cannot_be_written_ends_no_search(tmp_path):
    step = last("nsga2", checkpoint=Path(tmp_path / "none" / "a.search"))
    assert "no such file" in step.unkept
    assert result(step) == result(last("nsga2"))
