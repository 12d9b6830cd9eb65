"""Cams of every follower and every law: what a program gives of other designs is what numpy gives, to the last bit."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.cam import BarrelCam, OscillatingBarrelCam
from camkit.cam.loads import ArmLoad
from camkit.cam.slide import SlideLoad
from camkit.machines import CamLever
from camkit.motion import FreePolynomial, SplineLaw, TableLaw
from camkit.program import CannotRecord, record, recorded
from camkit.quantities import with_quantities
from machine_cases import LAWS
from program_cases import designs_beside

CAMS = [
    TranslatingRollerCam(),
    TranslatingRollerCam(groove=False),
    OscillatingRollerCam(rotation=-1),
    TranslatingFlatCam(),
    OscillatingFlatCam(),
    BarrelCam(),
    OscillatingBarrelCam(rotation=-1),
]
ROWS = 5


def curves(cam):
    analysis = cam.analyse(31)
    names = ("pressure_angle", "contact_force", "cam_torque", "efficiency", "profile")
    return {name: getattr(analysis, name) for name in names} | {"margin": analysis.profile_margin.value}


def with_law(cam, law):
    """The same cam, its first rise by ``law``."""
    first, *others = cam.motion.segments
    return cam.replace(motion=replace(cam.motion, segments=(replace(first, law=law), *others)))


@pytest.mark.parametrize(("place", "law"), enumerate(LAWS))
def test_a_cam_replays_to_the_last_bit(place, law):
    """Each law with two followers in turn; a law knows nothing of its follower."""
    for cam in (CAMS[place % len(CAMS)], CAMS[(place + place // len(CAMS) + 1) % len(CAMS)]):
        design = with_law(cam, LAWS[law])
        values = designs_beside(design, ROWS, 1)
        with np.errstate(all="ignore"):
            expected = curves(with_quantities(design, values))
        found = record(curves, design, rows=ROWS)(values)
        for name, value in expected.items():
            assert_array_equal(found[name], value, err_msg=f"{type(cam).__name__} {name}")


def smooth(rows):
    u = np.linspace(0, 1, rows)
    return TableLaw(tuple(u), tuple(u**2 * (3 - 2 * u)), 0.0)


COLUMN = np.array([[0.2], [0.4], [0.6]])
PIECES = [smooth(4), SplineLaw((0.4, 0.5), (0.2, 0.5)), SplineLaw((0.4,), (COLUMN,)), FreePolynomial((0, COLUMN))]


def motion_of(law, u):
    return recorded(lambda given: law.at(given["u"])._asdict(), {"u": 0 * u})


@pytest.mark.parametrize("shape", [(), (1,), (5,), (3, 1), (3, 4)])
def test_a_law_in_pieces_replays_at_any_place(shape):
    u = np.random.default_rng(1).random(shape)
    for law in PIECES:
        found = motion_of(law, u)({"u": u})
        for name, value in law.at(u)._asdict().items():
            assert np.shape(found[name]) == np.shape(value)
            assert_array_equal(found[name], value)


def test_the_program_of_a_table_grows_by_the_halvings_of_its_rows_alone():
    few, *doubled = (len(motion_of(smooth(rows), np.zeros(5)).calls) for rows in (4, 100, 200, 400, 800))
    steps = np.diff(doubled)
    assert (steps == steps[0]).all()
    assert steps[0] < 10
    assert doubled[0] < 2 * few


FORCES = {"table": ((0.0, 100.0), (0.005, 300.0), (0.02, 100.0)), "function": lambda way: 100 + 1e4 * way}


@pytest.mark.slow
@pytest.mark.parametrize("kind", FORCES)
def test_a_force_of_the_users_own_replays_to_the_last_bit(kind):
    def measured(press):
        analysis = press.analyse(31)
        return {measure.name: measure.of(analysis, ROWS) for measure in press.measures}

    press = CamLever(force_curve=FORCES[kind])
    program = record(measured, press, rows=ROWS)
    for seed in range(4):
        values = designs_beside(press, ROWS, seed)
        with np.errstate(all="ignore"):
            expected = measured(with_quantities(press, values))
        for name, value in program(values).items():
            assert_array_equal(value, expected[name], err_msg=name)


LOADS = [
    TranslatingRollerCam(load=SlideLoad(force_table=((0.0, 5.0), (0.01, 20.0)))),
    TranslatingFlatCam(load=SlideLoad(cam_angle_table=((0.0, 5.0), (1.0, 20.0)))),
    OscillatingRollerCam(load=ArmLoad(torque_table=((0.0, 1.0), (0.1, 2.0)))),
]


@pytest.mark.parametrize("cam", LOADS, ids=lambda cam: cam.name)
def test_a_table_of_the_load_is_refused_with_what_can_be_recorded(cam):
    where = r"^camkit/motion/resolution.py, line \d+: the load has a table, .* a constant load, .* can be recorded$"
    with pytest.raises(CannotRecord, match=where):
        record(curves, cam)
