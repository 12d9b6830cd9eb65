"""Native code of what a user changes: variables, attributes, kinds of studies; of forks; a cache with others' files."""

import os
import pickle
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import Measure, Study, TranslatingRollerCam, mm
from camkit.cam import base_radius, peak_force
from camkit.program.kernel import stored
from camkit.study import native

pytest.importorskip("llvmlite")
FACTOR = 2.0
LIMITS = np.array([0.0, 1.0])


class Scale:
    factor = 2.0


SCALE = Scale()
FREE = {"base_radius": (25 * mm, 60 * mm), "offset": (-5 * mm, 5 * mm)}


@pytest.fixture(autouse=True)
def cache_of_changes(tmp_path, monkeypatch):
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path))
    monkeypatch.delenv("CAMKIT_FAST", raising=False)
    monkeypatch.setattr(native, "KNOWN", type(native.KNOWN)())


def rows(of, p=native.WORTH + 1):
    return np.random.default_rng(1).uniform(*of.bounds, (p, len(of.free)))


def made(of):
    of.evaluate(rows(of))
    found = native.native(of, tuple(of.free))
    found.wait()
    assert found.refused == ""
    assert found.kernel is not None
    return of


def same_as_numpy(of):
    x = rows(of, 200)
    assert_array_equal(of.evaluate(x).f, of.judge(x, of.analysis(x)).f)


def nested():
    factor = [2.0]
    inner = lambda analysis: factor[0] * base_radius(analysis)  # noqa: E731
    return factor, lambda analysis: inner(analysis)


FACTORS, NESTED = nested()
READS = {
    "a variable": lambda analysis: FACTOR * base_radius(analysis),
    "an attribute": lambda analysis: SCALE.factor * base_radius(analysis),
    "an array, for some designs": lambda analysis: np.where(base_radius(analysis) > LIMITS[0], LIMITS[1], 0.0),
    "a variable of a function around another": NESTED,
}


@pytest.mark.parametrize("what", READS)
def test_what_a_measure_reads_may_change(what, monkeypatch):
    of = made(Study(TranslatingRollerCam(), FREE, (Measure("scaled", "", READS[what]), peak_force), angles=91))
    before = of.evaluate(rows(of, 200)).f
    monkeypatch.setitem(globals(), "FACTOR", 3.0)
    monkeypatch.setattr(SCALE, "factor", 3.0)
    monkeypatch.setitem(globals(), "LIMITS", np.array([0.05, 1.0]))
    FACTORS[0] += 1.0
    assert (of.evaluate(rows(of, 200)).f != before).any()
    same_as_numpy(of)
    same_as_numpy(of.replace(angles=91))
    same_as_numpy(made(of))


@dataclass(frozen=True)
class ScaledStudy(Study):
    scale: float = 2.0

    def analysis_of(self, design):
        return super().analysis_of(design.replace(roller_radius=self.scale * design.roller_radius))


def test_studies_of_another_kind_have_their_own_code():
    plain = made(Study(TranslatingRollerCam(), FREE, (peak_force,), angles=91))
    for scale in (0.5, 0.6):
        of = ScaledStudy(plain.start, FREE, (peak_force,), angles=91, scale=scale)
        same_as_numpy(of)
        same_as_numpy(made(of))
    same_as_numpy(plain)


def named(analysis):
    return FACTOR * base_radius(analysis)


def test_a_study_that_was_used_is_pickled_and_goes_on(monkeypatch):
    of = made(Study(TranslatingRollerCam(), FREE, (Measure("named", "", named),), angles=91))
    copy = pickle.loads(pickle.dumps(of))
    same_as_numpy(copy)
    monkeypatch.setitem(globals(), "FACTOR", 4.0)
    same_as_numpy(copy)


FORK = """
import os, signal, sys
import numpy as np
from camkit import Study, TranslatingRollerCam
from camkit.cam import peak_force
from camkit.study import native

of = Study(TranslatingRollerCam(), {"base_radius": (0.03, 0.06), "offset": (0, 0.005)}, (peak_force,), angles=91)
x = np.random.default_rng(1).uniform(*of.bounds, (native.WORTH + 1, 2))
with native.made_first():
    before = of.evaluate(x).f
other, third = of.replace(angles=101), of.replace(angles=111)
other.evaluate(x)  # its code is being made
child = os.fork()
if not child:
    signal.alarm(60)
    with native.made_first():
        assert (of.evaluate(x).f == before).all()
        other.evaluate(x), third.evaluate(x)
    os._exit(0)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")
def test_a_forked_process_evaluates_too():
    subprocess.run([sys.executable, "-W", "ignore", "-c", FORK], check=True, timeout=120)


def test_the_cache_lets_files_of_others_be(tmp_path, monkeypatch):
    monkeypatch.setattr(stored, "MOST", 2)
    theirs = [tmp_path / name for name in ("thesis.txt", "a" * 63, ".profile")]
    for file in theirs:
        file.write_text("mine", encoding="utf-8")
        os.utime(file, (1, 1))
    code = stored.Code(b"", np.zeros(1), (), (), (), 1, 1)
    for k in range(4):
        stored.write(f"{k:064x}", code)
    assert all(file.exists() for file in theirs)
    assert len([*tmp_path.iterdir()]) == len(theirs) + 2
