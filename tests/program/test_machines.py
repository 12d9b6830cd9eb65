"""Cams of every follower with every law: what a program gives of other designs is what numpy gives, to the last bit."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.program import record
from camkit.quantities import with_quantities
from machine_cases import LAWS
from program_cases import designs_beside

CAMS = [
    TranslatingRollerCam(),
    TranslatingRollerCam(groove=False),
    OscillatingRollerCam(rotation=-1),
    TranslatingFlatCam(),
    OscillatingFlatCam(),
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


@pytest.mark.parametrize("law", LAWS)
def test_a_cam_replays_to_the_last_bit(law):
    for cam in CAMS:
        design = with_law(cam, LAWS[law])
        values = designs_beside(design, ROWS, 1)
        with np.errstate(all="ignore"):
            expected = curves(with_quantities(design, values))
        found = record(curves, design, rows=ROWS)(values)
        for name, value in expected.items():
            assert_array_equal(found[name], value, err_msg=f"{type(cam).__name__} {name}")
