"""Machines whose fields were flat once: designs drawn at random have the numbers that they had then."""

import json
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from camkit.files import read_json

DESIGNS = json.loads((Path(__file__).parents[1] / "data" / "flat_machines.json").read_text())


@pytest.mark.parametrize("kind", ["HighSpeedCam", "CamLever", "ValveCam"])
def test_a_design_as_it_was_written_has_the_measures_that_it_had(kind):
    """Laws, families of coefficients, loads, followers and sizes of all kinds; a measure may be nan or infinite."""
    drawn = [each for each in DESIGNS if each["design"]["kind"] == kind]
    assert len(drawn) >= 15
    for each in drawn:
        design = read_json(json.dumps({"schema": "camkit/1", "design": each["design"]})).thing
        analysis = design.analyse(91)
        now = {f"{m.name} [{m.unit}]": float(m(analysis)) for m in design.measures}
        assert now.keys() >= each["measures"].keys()
        for name, value in each["measures"].items():
            assert_allclose(now[name], float(value), rtol=1e-12, atol=1e-15, err_msg=f"{name} of {each['design']}")
