"""Machines whose fields were flat once: designs drawn at random have the numbers that they had then."""

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit.files import read_json
from camkit.quantities import quantities_of, value_of, with_quantities

DESIGNS = json.loads((Path(__file__).parents[1] / "data" / "flat_machines.json").read_text())
TOLERANCE = 1e-12
LAST_DIGITS = 100
"""So many times what one last digit of an input moves a number, it may differ: a spline is the solution of equations,
and its acceleration was 1.5e-15 of its largest off where the numbers were written, and is 3.1e-15 (by exact fractions).
"""


def measured(design):
    analysis = design.analyse(91)
    return {f"{m.name} [{m.unit}]": float(m(analysis)) for m in design.measures}


def moved(design, names):
    """How far one last digit of an input moves the measures, at most."""
    now, most = measured(design), dict.fromkeys(names, 0.0)
    for path in quantities_of(design):
        for way in (-np.inf, np.inf):
            beside = measured(with_quantities(design, {path: np.nextafter(value_of(design, path), way)}))
            most = {name: max(most[name], abs(beside[name] - now[name])) for name in names}
    return most


@pytest.mark.parametrize("kind", ["HighSpeedCam", "CamLever", "ValveCam"])
def test_a_design_as_it_was_written_has_the_measures_that_it_had(kind):
    """Laws, families of coefficients, loads, followers and sizes of all kinds; a measure may be nan or infinite."""
    drawn = [each for each in DESIGNS if each["design"]["kind"] == kind]
    assert len(drawn) >= 15
    for each in drawn:
        design = read_json(json.dumps({"schema": "camkit/1", "design": each["design"]})).thing
        now, then = measured(design), {name: float(value) for name, value in each["measures"].items()}
        assert now.keys() >= then.keys()
        off = [n for n in then if not np.isclose(now[n], then[n], rtol=TOLERANCE, atol=1e-15, equal_nan=True)]
        for name, most in (moved(design, off) if off else {}).items():
            assert_allclose(
                now[name], then[name], rtol=0, atol=LAST_DIGITS * most, err_msg=f"{name} of {each['design']}"
            )
