"""What parts within tolerances say by native code and by numpy: models, margins, yields, factors, curves, fronts."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, TranslatingRollerCam, ValveCam, deg, mm, quick_front, shaft_study
from camkit.cam import max_pressure_angle, min_convex_radius, peak_force
from camkit.machines import corrected_valve_study, door_handle_study, high_speed_study, ninety_degree_study
from camkit.machines.valve_measures import fullness, peak_acceleration
from camkit.study import AnalysisCurve, Study, Sweep, Tolerances, failures, native
from camkit.study.three_point import star

pytest.importorskip("llvmlite")

SIZES = {"base_radius": 0.1 * mm, "roller_radius": 0.05 * mm}


@pytest.fixture
def both(monkeypatch):
    """What native code says of some work and what numpy says."""

    def of(work):
        with monkeypatch.context() as patch:
            patch.setattr(native.Answers, "by_code", lambda self, x: None)
            alone = work()
        return work(), alone

    return of


@pytest.fixture(autouse=True)
def cache_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path))
    monkeypatch.delenv("CAMKIT_FAST", raising=False)
    monkeypatch.setattr(native, "KNOWN", type(native.KNOWN)())


def roller():
    free = {"base_radius": (25 * mm, 60 * mm), "offset": (-5 * mm, 5 * mm)}
    limits = {max_pressure_angle: 30 * deg}, {min_convex_radius: 20 * mm}
    return Study(TranslatingRollerCam(), free, (max_pressure_angle, peak_force), *limits, angles=91).under(SIZES)


def valve():
    widths = {"max_lift": 0.05 * mm, "base_radius": 0.05 * mm, "half_angle": 0.5 * deg, "seating_velocity": 0.02}
    study = corrected_valve_study(ValveCam(base_radius=24.5 * mm))
    return study.replace(minimise=(-fullness, peak_acceleration)).under(widths)


def door():
    study = door_handle_study(DoorHandleCam()).replace(angles=121)
    return study.under({path: 0.5 * deg if "angle" in path else 0.3 * mm for path in study.free})


def fast():
    study = high_speed_study().replace(angles=121)
    return study.under({path: 0.002 * (high - low) for path, (low, high) in study.free.items()})


def linkage():
    study = ninety_degree_study()
    return study.under(dict.fromkeys(study.free, 0.3 * mm))


def shaft():
    return shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})


EVERY = [roller, valve, door, fast, linkage, shaft]


def designs(study, p=24):
    """Some of all over the bounds, some near the start, and with tolerances wide of them some that cannot be built."""
    (low, high), draw = study.bounds, np.random.default_rng(3)
    near = np.clip(study.x0 + 0.02 * (high - low) * draw.standard_normal((p // 2, len(low))), low, high)
    return np.vstack([draw.uniform(low, high, (p // 2, len(low))), near])


def ready(answers, x):
    """Have the code of what is asked made; whether there is some."""
    answers.native.make(answers, x)
    answers.native.wait()
    return not answers.native.refused


def all_ready(study, x):
    """All that a study under tolerances asks: of its designs, of its parts, and of their points, and of few angles."""
    parts = study.made(x, star(len(study.tolerances))).reshape(-1, len(study._parts.declared))
    made = True
    for of in (study, study.roughly):
        made &= ready(native.Answers(of.nominal, tuple(of.free)), x)
        made &= ready(native.Answers(of, tuple(of._parts.declared)), parts)
        made &= ready(of._points, parts)
    return made


@pytest.mark.parametrize("machine", EVERY)
def test_models_margins_and_yields_are_those_of_numpy(machine, both):
    study, x = machine(), designs(machine())
    assert all_ready(study, x)
    for work in (study.margins, study.modelled_yield, study.modelled_growth, lambda x: study.evaluate(x).g):
        assert_array_equal(*both(lambda work=work: work(x)))
    (found, alone) = both(lambda: study.recheck(x[-6:], 256))
    assert_array_equal(found.missed, alone.missed)
    assert_array_equal(found.share, alone.share)


@pytest.mark.parametrize("machine", [roller, valve])
def test_points_of_parts_that_cannot_be_built(machine, both):
    """Sizes of nothing and less: the same places without a number, the others alike."""
    study = machine()
    parts = study.made(designs(study), star(len(study.tolerances))).reshape(-1, len(study._parts.declared))
    made = ready(study._points, parts)
    assert made
    parts = np.vstack([parts, -parts[:3], 0 * parts[:3], np.inf * parts[:3], np.nan * parts[:3]])
    found, alone = both(lambda: study._points(parts))
    assert not np.isfinite(alone[-6:]).all(-1).any()
    assert_array_equal(found, alone)


def test_points_end_with_the_measure_whose_points_they_are():
    study = roller()
    parts = study.made(designs(study), star(2)).reshape(-1, 3)
    f, force, steep, round_ = np.split(study._points(parts).T, study._points.ends)
    with np.errstate(invalid="ignore"):
        found = study.judge(parts, study.analysis_of_parts(parts))
    assert_array_equal(f[0], found.f[:, 0])
    assert_array_equal(force[0], found.f[:, 1])
    assert steep.shape[0] > 91
    assert_allclose(steep[:-1].max(0), steep[-1], rtol=1e-4)
    assert_allclose(-round_[-1], 20 * mm * (1 - found.g[:, 1]))
    assert_array_equal(f[0], steep[-1])


@pytest.mark.parametrize("machine", [roller, door])
def test_the_parts_of_one_design(machine, both):
    study = machine().nominal
    curve = AnalysisCurve("pressure_angle" if machine is roller else "lift.pressure_angle", "deg", "pressure angle")
    widths = dict(machine().tolerances)
    widths = {path: tolerance.deviation for path, tolerance in widths.items()}

    def parts():
        return Tolerances(study, widths, parts=128)

    some = parts()
    made = [ready(native.Answers(some._box, some.names, asked), some.x) for asked in (None, (curve,))]
    assert all(made)
    found, alone = both(lambda: (lambda t: (t.values, t.band(curve), t.share, t.indices.total))(parts()))
    for one, other in zip(found, alone, strict=True):
        assert_array_equal(one, other)
    assert_allclose(some.values, [np.broadcast_to(m(some.analysis), 128) for m in some.measures], rtol=1e-12)


def test_why_parts_fail_and_how_far_tolerances_can_grow(both):
    study = roller()
    x = designs(study)
    assert all_ready(study, x)
    found, alone = both(lambda: (failures(study, x), study.tolerance_factor(x[-4:])))
    assert_array_equal(found[0].missed, alone[0].missed)
    assert_array_equal(found[0].without, alone[0].without)
    assert_array_equal(found[1], alone[1])


def test_a_sweep(both):
    study = roller().nominal
    study = study.replace(free={"base_radius": study.free["base_radius"]})
    assert ready(native.Answers(study, ("base_radius",)), Sweep(study).x[:, None])
    assert_array_equal(*both(lambda: Sweep(study).limits))


def test_a_robust_front_is_the_same_whoever_answers(both):
    study = valve()
    assert all_ready(study, designs(study))
    found, alone = both(lambda: quick_front(valve(), 40))
    assert len(found) == len(alone) > 10
    assert_array_equal(found.f, alone.f)
    assert_array_equal(found.yields.missed, alone.yields.missed)
