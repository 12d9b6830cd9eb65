"""Cams of every follower with every law: what a program gives of other designs is what numpy gives, to the last bit."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.motion.segments import LAW_MENU
from camkit.program import CannotRecord, record
from camkit.quantities import with_quantities
from program_cases import designs_beside

CAMS = [
    TranslatingRollerCam(),
    TranslatingRollerCam(groove=False),
    OscillatingRollerCam(rotation=-1),
    TranslatingFlatCam(),
    OscillatingFlatCam(),
]
NOT_YET = {"free polynomial": "its coefficients solve equations", "B-spline": "scipy evaluates it"}
"""Laws that cannot be recorded, and why."""
ROWS = 5


def curves(cam):
    analysis = cam.analyse(31)
    names = ("pressure_angle", "contact_force", "cam_torque", "efficiency", "profile")
    return {name: getattr(analysis, name) for name in names} | {"margin": analysis.profile_margin.value}


@pytest.mark.parametrize("law", [law for law in LAW_MENU if law.name not in NOT_YET], ids=lambda law: law.name)
def test_a_cam_replays_to_the_last_bit(law):
    for cam in CAMS:
        design = with_quantities(cam, {"motion.rise.law": law})
        values = designs_beside(design, ROWS, 1)
        with np.errstate(all="ignore"):
            expected = curves(with_quantities(design, values))
        found = record(curves, design, rows=ROWS)(values)
        for name, value in expected.items():
            assert_array_equal(found[name], value, err_msg=f"{type(cam).__name__} {name}")


@pytest.mark.parametrize("name", NOT_YET)
def test_a_law_that_cannot_be_recorded_is_refused_where_it_asks(name):
    law = next(law for law in LAW_MENU if law.name == name)
    with pytest.raises(CannotRecord, match=r"^camkit/motion/families/\w+.py, line \d+: a truth value"):
        record(curves, with_quantities(CAMS[0], {"motion.rise.law": law}))
