"""Cams, trains and reference values for tests of dynamics, and a train integrated in time without any of camkit's."""

import json
from functools import cache
from pathlib import Path

import numpy as np

from camkit import deg, rpm
from camkit.cam import SlideLoad, TranslatingFlatCam
from camkit.dynamics import ElasticTrain
from camkit.machines import ValveCam
from camkit.machines.valve_motion import Ramp
from camkit.motion import Cycloidal, Dwell, Mirrored, ModifiedSine, MotionProgram, Poly345, Return, Rise, SimpleHarmonic

REFERENCE = json.loads((Path(__file__).parents[1] / "data" / "dynamics.json").read_text(encoding="utf-8"))
GIVEN, VALUES = REFERENCE["given"], REFERENCE["values"]
LAWS = {"cycloidal": Cycloidal(), "modified_sine": ModifiedSine(), "p345": Poly345(), "harmonic": SimpleHarmonic()}
A = ElasticTrain(8e5, 100.0, 20.0)
"""Train A of the reference values."""


def program(law, lift=0.02, angles=(120, 60, 120, 60)):
    rise, far, back, near = (angle * deg for angle in angles)
    return MotionProgram((Rise(rise, lift, law), Dwell(far), Return(back, lift, law), Dwell(near)))


def flat(law="cycloidal", speed=600 * rpm, **load):
    """A flat face, whose contact force goes along the travel, under the load of train A."""
    motion = program(LAWS[law] if isinstance(law, str) else law)
    held = {"mass": 2.0, "speed": speed, "spring_rate": 5e3, "preload": 300.0, **load}
    return TranslatingFlatCam(motion, 0.04, load=SlideLoad(**held))


@cache
def valve():
    """A valve cam that begins in the middle of its base circle, at level 0."""
    cam = ValveCam(n=5.8, m=20.0)
    aside, up = np.pi - cam.half_angle - cam.ramp_angle, (cam.ramp_angle, cam.ramp_height)
    ramp, lift = Ramp(1.0), (cam.half_angle, cam.max_lift)
    opening = Dwell(aside), Rise(*up, ramp), Rise(*lift, cam.flank)
    closing = Return(*lift, Mirrored(cam.flank)), Return(*up, Mirrored(ramp)), Dwell(aside)
    load = SlideLoad(mass=0.25, speed=800 * rpm, spring_rate=3e4, preload=250.0)
    return TranslatingFlatCam(MotionProgram((*opening, *closing)), 0.04, load=load)


def at(response, curve, degrees):
    """A curve of a response at some cam angles, straight between its samples."""
    turn = np.append(response.cam_angle, 2 * np.pi)
    return np.interp(np.radians(degrees), turn, np.append(curve, curve[0]))


def differs(response, curve, expected):
    """By how much a curve differs from values by cam angle in degrees, at most."""
    angles, values = np.array(list(map(float, expected))), np.array(list(expected.values()))
    return np.max(abs(at(response, curve, angles) - values))


def integrated(motion, speed, m, kf, ks, cf, cs, steps=20000):
    """``x`` of one mass in steady motion at ``steps`` even cam angles, by Runge and Kutta's method and nothing else.

    The state after a turn is that at its start: found from the free motion and one run from rest.
    """
    h = 2 * np.pi / steps
    s, v, *_ = motion(np.arange(2 * steps + 2) % (2 * steps) * h / 2)
    push = ((kf * s + cf * speed * v) / m / speed).tolist()
    holds, rubs = (kf + ks) / m / speed, (cf + cs) / m / speed

    def run(x, u, forced):
        found = []
        for i in range(steps):
            found.append(x)
            f0, f1, f2 = push[2 * i : 2 * i + 3] if forced else (0.0, 0.0, 0.0)
            a1, b1 = u / speed, f0 - holds * x - rubs * u
            a2, b2 = (u + h / 2 * b1) / speed, f1 - holds * (x + h / 2 * a1) - rubs * (u + h / 2 * b1)
            a3, b3 = (u + h / 2 * b2) / speed, f1 - holds * (x + h / 2 * a2) - rubs * (u + h / 2 * b2)
            a4, b4 = (u + h * b3) / speed, f2 - holds * (x + h * a3) - rubs * (u + h * b3)
            x, u = x + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), u + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
        return found, (x, u)

    free = np.transpose([run(1.0, 0.0, False)[1], run(0.0, 1.0, False)[1]])
    start = np.linalg.solve(np.eye(2) - free, run(0.0, 0.0, True)[1])
    return np.array(run(*start.tolist(), True)[0])
