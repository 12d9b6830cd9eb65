"""Studies by native code: numpy answers until it is there, and where it would say something else."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import DesignMap, Measure, Study, TranslatingRollerCam, deg, minimise, mm, nsga2, quick_front
from camkit.cam import base_radius, max_pressure_angle, min_convex_radius, peak_force
from camkit.machines import high_speed_study
from camkit.motion import Cycloidal, ModifiedSine
from camkit.search import trade_off
from camkit.search.checkpoint import fingerprint
from camkit.search.minimax import Epigraph
from camkit.study import native, weighted

pytest.importorskip("llvmlite")


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path))
    monkeypatch.delenv("CAMKIT_FAST", raising=False)
    monkeypatch.setattr(native, "KNOWN", type(native.KNOWN)())


def study(start=None, weights=(0.6, 0.4), **more):
    total = weighted("effort", dict(zip((max_pressure_angle, peak_force), weights, strict=True)), (0.5, 100.0))
    free = {"base_radius": (25 * mm, 60 * mm), "offset": (-5 * mm, 5 * mm)}
    return Study(start or TranslatingRollerCam(), free, (total, -min_convex_radius),
                 {max_pressure_angle: 30 * deg}, {base_radius: 30 * mm}, angles=91, **more)  # fmt: skip


def rows(of, p, seed=1):
    return np.random.default_rng(seed).uniform(*of.bounds, (p, len(of.free)))


def ready(of):
    """What answers for a study, as soon as it is there."""
    of.evaluate(rows(of, native.WORTH + 1))
    found = native.native(of, tuple(of.free))
    found.wait()
    assert found.refused == ""
    assert found.kernel is not None
    return found


def alike(first, second):
    assert_array_equal(first.f, second.f)
    assert_array_equal(first.g, second.g)


def by_numpy(of, x):
    return of.judge(x, of.analysis(x))


def test_the_same_to_the_last_bit_and_what_cannot_be_built():
    of = study()
    ready(of)
    x = np.vstack([rows(of, 200), [[-1.0, 0.0], [np.nan, 0.0], [0.03, 1.0], [0.0, 0.0], [np.inf, 0.0]]])
    found = of.evaluate(x)
    assert np.isinf(found.f[-5:]).any(-1).all()
    alike(found, by_numpy(of, x))


def test_what_does_not_follow_from_that_for_which_a_design_cannot_be_built_is_the_same():
    of = high_speed_study(free_laws=True).replace(angles=61)
    x = rows(of, 120)
    expected = by_numpy(of, x)
    assert (np.isfinite(expected.g).any(-1) & np.isinf(expected.f[:, 0])).any()
    with native.made_first():
        alike(of.evaluate(x), expected)
    assert native.native(of, tuple(of.free)).refused == ""


def test_numpy_answers_first_and_nobody_waits(monkeypatch):
    monkeypatch.setattr(native, "made", lambda *_: (_ for _ in ()).throw(AssertionError("not yet")))
    of = study()
    x = rows(of, native.WORTH // 2)
    of.evaluate(x)
    of.evaluate(x)
    found = native.native(of, tuple(of.free))
    assert not found.begun
    assert_array_equal(of.evaluate(x[:10]).f, by_numpy(of, x[:10]).f)
    found.wait()
    assert "not yet" in found.refused
    assert_array_equal(of.evaluate(x[:10]).f, by_numpy(of, x[:10]).f)


def test_studies_that_differ_in_numbers_alone_share_their_code():
    of, cam = study(), TranslatingRollerCam(roller_radius=6 * mm)
    found = ready(of)
    for other in (study(cam), study(weights=(0.2, 0.8)), of.replace(at_most={max_pressure_angle: 20 * deg})):
        assert native.native(other, tuple(other.free)) is found
        x = rows(other, 50, 2)
        alike(other.evaluate(x), by_numpy(other, x))
    first, *others = cam.motion.segments
    law = cam.replace(motion=replace(cam.motion, segments=(replace(first, law=ModifiedSine()), *others)))
    for other in (study(law), of.replace(angles=61), of.replace(rough=True), of.replace(minimise=(peak_force,))):
        assert native.native(other, tuple(other.free)) is not found


def test_menus_and_tolerances_go_through_it():
    of = study()
    menus = of.replace(free={**of.free, "motion.rise.law": (Cycloidal(), ModifiedSine())})
    for plain in menus.options.each():
        ready(plain.study)
    x = np.column_stack([rows(of, 100), np.arange(100) % 2])
    found = menus.evaluate(x)
    for k, plain in enumerate(menus.options.each()):
        assert_array_equal(found.f[k::2], by_numpy(plain.study, x[k::2, :2]).f)
    robust = of.under({"base_radius": 0.1 * mm, "roller_radius": 0.05 * mm})
    parts = robust.made(rows(of, 20), np.random.default_rng(1).uniform(-1, 1, (120, 2))).reshape(-1, 3)
    before = robust.judged(parts)
    native.native(robust, tuple(robust._parts.declared)).wait()
    alike(robust.judged(parts), before)
    alike(robust.judged(parts), robust.judge(parts, robust.analysis_of_parts(parts)))


def test_code_that_would_say_something_else_is_not_used():
    jumps = Measure("jumps", "", lambda analysis: analysis.cam.base_radius + 0 * max_pressure_angle(analysis))
    strange = Measure("strange", "", lambda analysis: 1.0 if hasattr(jumps.function(analysis), "recorded") else 2.0)
    of = study().replace(minimise=(peak_force, strange))
    of.evaluate(rows(of, native.WORTH + 1))
    found = native.native(of, tuple(of.free))
    found.wait()
    assert "native code and numpy differ" in found.refused
    assert of.evaluate(rows(of, 3)).f[:, 1].tolist() == [2.0] * 3


def test_what_cannot_be_recorded_numpy_answers():
    asks = Measure("asks", "", lambda analysis: 1.0 if np.all(analysis.cam.base_radius > 0) else 2.0)
    of = study().replace(minimise=(asks,))
    of.evaluate(rows(of, native.WORTH + 1))
    found = native.native(of, tuple(of.free))
    found.wait()
    assert found.refused.startswith("CannotRecord: ")
    assert of.evaluate(rows(of, 3)).f.tolist() == [[1.0]] * 3


@pytest.mark.parametrize("how", ["switched off", "not installed"])
def test_without_it_numpy_answers(how, monkeypatch):
    of = study()
    monkeypatch.setenv("CAMKIT_FAST", "0" if how == "switched off" else "1")
    if how == "not installed":
        monkeypatch.setitem(sys.modules, "llvmlite", None)
        native._installed.cache_clear()
    assert native.native(of, tuple(of.free)) is None
    x = rows(of, native.WORTH + 1)
    assert of.evaluate(x).f.shape == (len(x), 2)
    native._installed.cache_clear()


def test_so_many_programs_are_kept(monkeypatch):
    monkeypatch.setattr(native, "MOST", 2)
    for angles in (31, 32, 33):
        native.native(study().replace(angles=angles), ("base_radius",))
    assert [key[3] for key in native.KNOWN] == [32, 33]


def alone(monkeypatch, work):
    """What ``work`` gives while numpy answers."""
    with monkeypatch.context() as patch:
        patch.setattr(native.Answers, "__call__", native.Answers.by_numpy)
        return work()


def test_a_quick_front_is_the_same_whoever_answers(monkeypatch):
    free = {"base_radius": (25 * mm, 60 * mm), "roller_radius": (4 * mm, 8 * mm)}
    of = study().replace(free=free, minimise=(base_radius, peak_force), at_least={base_radius: 42.5 * mm})
    expected = alone(monkeypatch, lambda: quick_front(of))
    ready(of.roughly)
    ready(of)
    found = quick_front(of)
    assert_array_equal(found.x, expected.x)
    assert_array_equal(found.f, expected.f)


SEARCHES = {
    "nsga2": lambda of: nsga2(of, population=20, generations=10).x,
    "trade_off": lambda of: np.stack([each.x for each in trade_off(of, 4)]),
    "slsqp": lambda of: minimise(of.replace(minimise=of.minimise[:1]), starts=2).x,
    "de": lambda of: minimise(of.replace(minimise=of.minimise[:1]), method="de", designs=400).x,
    "map": lambda of: DesignMap(of.replace(minimise=of.minimise[:1]), n=12).evaluation.g,
}


@pytest.mark.parametrize("name", SEARCHES)
def test_a_search_is_the_same_whoever_answers(name, monkeypatch):
    of = study()
    expected = alone(monkeypatch, lambda: SEARCHES[name](of))
    for each in (of, of.replace(minimise=of.minimise[:1])):
        ready(each)
    assert_array_equal(SEARCHES[name](of), expected)


def test_a_study_has_one_fingerprint_whoever_answers(monkeypatch):
    of = study()
    expected = alone(monkeypatch, lambda: fingerprint(of))
    ready(of)
    assert fingerprint(study()) == expected


def test_a_descent_ends_at_the_same_bits_whoever_answers():
    of = study().replace(minimise=(peak_force,))
    alone, problem = minimise(of), Epigraph(of)
    x = rows(of, native.BLOCK)
    before = problem.answers(x)
    problem.answers.native.make(problem.answers, x)
    problem.answers.native.wait()
    assert problem.answers.native.refused == ""
    assert before.shape[1] > len(of.measures)
    for p in (1, 25, native.BLOCK):
        assert_array_equal(problem.answers(x[:p]), before[:p])
    both = minimise(of)
    assert_array_equal(both.x, alone.x)
    assert (both.f, both.evaluations, both.message) == (alone.f, alone.evaluations, alone.message)
