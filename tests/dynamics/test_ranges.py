"""Measures between two speeds, and cams that a search makes good at all of them."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import differential_evolution

from camkit import Session, Study, TranslatingFlatCam, minimise, rpm
from camkit.dynamics import (
    ElasticFollower,
    ElasticTrain,
    dwell_vibration_between,
    min_force_between,
    peak_force_between,
    polydyne,
    speed_sweep,
)
from camkit.files import from_json, to_json
from camkit.motion import Cycloidal, ModifiedSine, Poly56789, ShapedLaw
from train_cases import A, flat, program

LOW, HIGH = 540 * rpm, 660 * rpm
STILL, FORCE, LEAST = (make(LOW, HIGH) for make in (dwell_vibration_between, peak_force_between, min_force_between))
SPEEDS = np.geomspace(LOW, HIGH, 22)
SHAPED = ShapedLaw(Cycloidal())
FREE = [f"cam.motion.{move}.law.c{i}" for move in ("rise", "return") for i in (1, 3)]
STUDY = Study(ElasticFollower(flat(SHAPED, preload=500.0), A), FREE, (STILL,))


def swept(cam, speeds=SPEEDS):
    sweep = speed_sweep(cam.analyse(), A, speeds, 720)
    still, forces = sweep.dwell_vibration.max((-1, -2)) / 0.02, (sweep.max_force, sweep.least_force)
    return np.stack([still, forces[0].max(-1), forces[1].min(-1)])


def test_they_are_the_worst_of_a_sweep_and_a_search_sees_all_of_it():
    analysis, expected = ElasticFollower(flat(), A).analyse(), swept(flat())
    assert_allclose([measure(analysis) for measure in (STILL, FORCE, LEAST)], expected, rtol=1e-12)
    seen = [measure.curve(analysis) for measure in (STILL, FORCE, LEAST)]
    assert {curve.shape for curve in seen} == {(22 * 720,)}
    assert_allclose([seen[0].max(), seen[1].max(), seen[2].min()], expected, rtol=1e-9)
    finer = dwell_vibration_between(LOW, HIGH, 400)(analysis)
    assert 0 <= finer - expected[0] < 1e-3 * finer  # steps of 1 %


def test_a_population_is_each_of_its_members_and_what_cannot_be_is_none():
    mass, damping = np.array([[2.0], [1.5], [2.0]]), np.array([[100.0], [50.0], [-1.0]])
    with np.errstate(invalid="ignore"):
        many = ElasticFollower(flat(mass=mass), ElasticTrain(8e5, damping, 20.0)).analyse()
    for measure in (STILL, FORCE, LEAST):
        assert measure.curve(many).shape == (3, 22 * 720)
        assert np.isnan(measure(many)[2])
        for i in range(2):
            train = ElasticTrain(8e5, float(damping[i, 0]), 20.0)
            alone = ElasticFollower(flat(mass=float(mass[i, 0])), train).analyse()
            assert measure(many)[i] == pytest.approx(measure(alone), rel=1e-10)
            assert_allclose(measure.curve(many)[i], measure.curve(alone), rtol=1e-9, atol=1e-9)


def test_a_search_finds_what_another_one_finds():
    """Differential evolution over one law for rise and return, judged by `speed_sweep`."""

    def worst(c):
        c1, c3 = np.reshape(c, (2, -1, 1))
        return swept(flat(replace(SHAPED, c=(0.0, c1, 0.0, c3)), preload=500.0), SPEEDS[::3])[0]

    box, how = [(-0.15, 0.15)] * 2, {"updating": "deferred", "vectorized": True, "polish": False}
    other = differential_evolution(worst, box, rng=1, popsize=12, maxiter=24, **how)
    found = minimise(STUDY.replace(minimise=(dwell_vibration_between(LOW, HIGH, 8),)))
    assert other.fun / 1.02 < found.f <= other.fun
    assert_allclose(found.x, np.tile(other.x, 2), atol=5e-3)


def test_a_cam_for_a_range_of_speeds_is_better_there_than_laws_and_a_polydyne_cam_for_one():
    still, force, least = (
        make(LOW, HIGH, 8) for make in (dwell_vibration_between, peak_force_between, min_force_between)
    )
    limited = STUDY.replace(minimise=(still,), at_most={force: 950.0}, at_least={least: 100.0})
    found = minimise(limited)
    analysis, held = found.design.analyse(), flat(preload=500.0)
    for_one = held.replace(motion=polydyne(program(Poly56789()), A, held.load, np.sqrt(LOW * HIGH)))
    others = [flat(Cycloidal(), preload=500.0), flat(ModifiedSine(), preload=500.0), for_one]
    dwell = [swept(cam)[0] for cam in others]
    assert_allclose(dwell, [0.005177, 0.015387, 0.001782], rtol=1e-3)
    assert found.f < min(dwell) / 2.5
    between = dwell_vibration_between(LOW, HIGH, 200)(analysis)
    assert found.f <= between < 1.02 * found.f  # between the speeds that it has seen, too
    assert FORCE(analysis) < 950 * 1.001
    assert LEAST(analysis) > 100 * 0.999


def test_a_study_with_them_comes_back_from_a_file():
    study = STUDY.replace(at_least={min_force_between(300 * rpm, 700 * rpm, 30): 10.0})
    again = from_json(to_json(Session(study, study.start))).study
    assert_allclose(again.evaluate(study.x0).f, study.evaluate(study.x0).f, rtol=1e-12)
    assert [m.name for m in again.measures] == [m.name for m in study.measures]


def test_refusals():
    cases = (
        (lambda: dwell_vibration_between(HIGH, LOW), "are from 660 to 540 rpm; the lower one must come first"),
        (
            lambda: peak_force_between(-1.0, HIGH),
            "the lowest speed of the cam is -1; it must be a finite number above 0",
        ),
        (lambda: min_force_between(LOW, np.inf), "the highest speed of the cam is inf"),
        (lambda: dwell_vibration_between(LOW, HIGH, 0), "the number of speeds from 540 to 660 rpm is 0"),
        (lambda: dwell_vibration_between(1.0, 1e9), "the number of speeds .* at most 2000"),
        (lambda: STILL(ElasticFollower(flat(), ElasticTrain(damping=0.0)).analyse()), "the train has no damping"),
        (lambda: STILL(TranslatingFlatCam().analyse()), "does not apply to"),
    )
    for refused, sentence in cases:
        with pytest.raises(ValueError, match=sentence):
            refused()
    one = dwell_vibration_between(600 * rpm, 600 * rpm)(ElasticFollower(flat(), A).analyse())
    assert one == pytest.approx(8.6634883e-5 / 0.02, rel=1e-4)
