"""Every number of every machine: as a column of two and of three designs it gives what each design has by itself."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from every_machine import MACHINES
from numpy.testing import assert_allclose

from camkit import Dwell, MotionProgram, OscillatingFlatCam, Return, Rise, deg, mm
from camkit.machines import UniversalJointShaft
from camkit.motion import ShapedLaw
from camkit.quantities import measures_of, quantities_of, value_of, with_quantities

ANGLES, STEP = 31, 0.01
CURVES = ("contact_force", "cam_torque", "contact_pressure", "efficiency", "rubbing")
every_machine = pytest.mark.parametrize("design", MACHINES.values(), ids=MACHINES)


def results(design):
    """All measures of a design or of a population, and the curves of its forces, by name."""
    analysis = design.analyse(ANGLES)
    found = {measure.name: np.asarray(measure(analysis))[..., None] for measure in measures_of(design)}
    for name, curve in getattr(analysis, "curves", {}).items():
        forces = {f"{name}.{of}": getattr(curve, of) for of in CURVES}
        pushed = forces.pop(f"{name}.rubbing")
        found |= forces | {f"{name}.rubbing.{of}": getattr(pushed, of) for of in pushed._fields}
    return found


@cache
def of_itself(design):
    return results(design)


def steps(design, path):
    """Three values of a quantity, the first that of the design; on the side on which all can be built."""
    declared, value = quantities_of(design)[path], float(value_of(design, path))
    step = STEP * (declared.high - declared.low) * declared.factor
    return value + np.arange(3) * (step if declared.allows(value + 2 * step) else -step)


def check(design, columns):
    """Columns of two and of three against each design alone, to 1e-12 of the largest value."""
    others = [with_quantities(design, {path: float(v[i]) for path, v in columns.items()}) for i in (1, 2)]
    alone = [of_itself(design), *map(results, others)]
    for count in (2, 3):
        many = results(with_quantities(design, {path: values[:count, None] for path, values in columns.items()}))
        for name, values in many.items():
            expected = np.stack([single[name] for single in alone[:count]])
            found = np.broadcast_to(values, expected.shape)
            size = np.max(abs(expected), initial=0, where=np.isfinite(expected))
            assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * size, err_msg=f"{name}, {[*columns]} of {count}")


@pytest.mark.slow
@every_machine
def test_each_quantity_alone_as_a_column(design):
    for path in quantities_of(design):
        check(design, {path: steps(design, path)})


@pytest.mark.slow
@every_machine
def test_two_numbers_of_load_friction_and_contact_as_columns(design):
    """The geometry is then one for all, and the forces are of each."""
    paths = [path for path in quantities_of(design) if {"load", "friction", "contact"} & set(path.split("."))]
    for pair in pairwise(paths):
        check(design, {path: steps(design, path) for path in pair})


@pytest.mark.slow
def test_five_hundred_cams_each_with_a_motion_and_a_spring_of_its_own():
    """The cam of `tests/test_house.py`, in one call and one by one."""
    rise, back = Rise(110 * deg, 12 * deg, ShapedLaw()), Return(110 * deg, 12 * deg, ShapedLaw())
    cam = OscillatingFlatCam(MotionProgram((rise, Dwell(50 * deg), back, Dwell(90 * deg))), face_offset=20 * mm)
    low, high = np.transpose([(95 * deg, 125 * deg), (-0.2, 0.2), (-0.2, 0.2), (1.0, 5.0)])
    paths = ("motion.rise.angle", "motion.rise.law.c0", "motion.return.law.c2", "load.spring_rate")
    x = low + (high - low) * np.random.default_rng(5).random((500, 4))
    many = with_quantities(cam, dict(zip(paths, x.T[..., None], strict=True))).analyse(ANGLES)
    single = (with_quantities(cam, dict(zip(paths, values, strict=True))).analyse(ANGLES) for values in x.tolist())
    alone = np.transpose([[measure(one) for measure in measures_of(cam)] for one in single])
    assert np.ptp(alone, axis=1).all()  # each measure is that of its cam
    for measure, values in zip(measures_of(cam), alone, strict=True):
        assert_allclose(np.broadcast_to(measure(many), 500), values, rtol=1e-12, atol=1e-12, err_msg=measure.name)


@every_machine
@pytest.mark.parametrize("size", [5e-324, 1e-300, 1e-160])
def test_a_number_that_may_be_0_is_0_or_no_absurdly_small_one(design, size):
    """All such numbers of all machines."""
    at_zero = [path for path, declared in quantities_of(design).items() if declared.at_least == 0]
    assert at_zero or isinstance(design, UniversalJointShaft)
    for path in at_zero:
        with pytest.raises(ValueError, match=r"it must be .*at least [0-9.e-]+.*( unless it is 0$|\(less than 0)"):
            with_quantities(design, {path: size})
        with_quantities(design, {path: 0.0})
