"""Elastic trains: many designs at once with their motion, and one over many speeds: milliseconds of the processor."""

from time import process_time

import numpy as np

from camkit.cam import SlideLoad, TranslatingFlatCam
from camkit.dynamics import ElasticFollower, ElasticTrain, contact_loss_speed, dwell_vibration_between, speed_sweep
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.units import deg, mm, rpm

DESIGNS, ANGLES, SPEEDS, SAMPLES, ROUNDS = 500, 360, 200, 720, 12


def cam(angle, lift, mass):
    """Rise and return with dwells, the second dwell taking up the angle."""
    move = (Rise(angle, lift, Cycloidal()), Dwell(60 * deg), Return(angle, lift, Cycloidal()))
    motion = MotionProgram((*move, Dwell(300 * deg - 2 * angle)))
    load = SlideLoad(mass=mass, speed=600 * rpm, spring_rate=5e3, preload=300.0)
    return TranslatingFlatCam(motion, 40 * mm, load=load)


def least(work):
    """The least time of the processor that some work takes, ms."""
    work()
    found = []
    for _ in range(ROUNDS):
        start = process_time()
        work()
        found.append(1e3 * (process_time() - start))
    return min(found)


def test_many_designs(report):
    random = np.random.default_rng(1)
    angle, lift, mass, stiffness = (
        random.uniform(low, high, (DESIGNS, 1))
        for low, high in ((100 * deg, 120 * deg), (15 * mm, 20 * mm), (1.0, 2.0), (6e5, 9e5))
    )

    def work():
        response = ElasticTrain(stiffness, 100.0, 20.0).follow(cam(angle, lift, mass).analyse(2), samples=ANGLES)
        return response.max_force, response.least_force

    alone = ElasticTrain(float(stiffness[7, 0]), 100.0, 20.0).follow(
        cam(*(float(x[7, 0]) for x in (angle, lift, mass))).analyse(2), samples=ANGLES
    )
    assert abs(work()[0][7] / alone.max_force - 1) < 1e-10
    taken = least(work)
    report(f"elastic trains, {DESIGNS} designs x {ANGLES} angles with their motion", f"{taken:.0f} ms")
    assert taken < 50


def test_many_speeds(report):
    analysis, train = cam(120 * deg, 20 * mm, 2.0).analyse(), ElasticTrain(8e5, 100.0, 20.0)
    speeds = np.linspace(200, 600, SPEEDS) * rpm
    taken = least(lambda: speed_sweep(analysis, train, speeds, SAMPLES))
    report(f"an elastic train, {SPEEDS} speeds x {SAMPLES} angles", f"{taken:.0f} ms")
    assert taken < 20


def test_a_measure_between_two_speeds(report):
    within = dwell_vibration_between(200 * rpm, 600 * rpm, SPEEDS)
    analysis = ElasticFollower(cam(120 * deg, 20 * mm, 2.0), ElasticTrain(8e5, 100.0, 20.0)).analyse()
    taken = least(lambda: within.curve(analysis))
    report(f"vibration between two speeds, {SPEEDS} speeds x {SAMPLES} angles", f"{taken:.0f} ms")
    assert taken < 20


def test_contact_loss(report):
    analysis, train = cam(120 * deg, 20 * mm, 2.0).analyse(), ElasticTrain(8e5, 100.0, 20.0)
    report("speed of contact loss of an elastic train", f"{least(lambda: contact_loss_speed(analysis, train)):.0f} ms")
