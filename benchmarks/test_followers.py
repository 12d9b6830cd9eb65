"""1000 designs at 361 cam angles, all at once and one by one, for each follower: microseconds a design."""

from time import perf_counter

import numpy as np
import pytest

from camkit import OscillatingRollerCam
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.units import deg, mm

DESIGNS, ANGLES, ALONE = 1000, 361, 100
CAMS = {
    TranslatingRollerCam: {"base_radius": (25 * mm, 60 * mm), "offset": (-8 * mm, 8 * mm)},
    TranslatingFlatCam: {"base_radius": (25 * mm, 60 * mm)},
    OscillatingRollerCam: {"arm_length": (50 * mm, 65 * mm), "start_angle": (25 * deg, 40 * deg)},
    OscillatingFlatCam: {"centre_distance": (70 * mm, 85 * mm), "start_angle": (15 * deg, 30 * deg)},
}
ASKED = ("pressure_angle", "profile_curvature", "profile", "contact_force", "cam_torque")


def evaluate(cam):
    """What a study of a cam asks for: geometry, forces and the margin of undercut."""
    analysis = cam.analyse(ANGLES)
    return [getattr(analysis, name) for name in ASKED] + [analysis.profile_margin.value]


@pytest.mark.parametrize("kind", CAMS, ids=lambda kind: kind.__name__)
def test_a_thousand_designs(benchmark, report, kind):
    random = np.random.default_rng(1)
    columns = {name: random.uniform(low, high, (DESIGNS, 1)) for name, (low, high) in CAMS[kind].items()}
    many = kind(**columns)
    singles = [kind(**{name: float(values[i, 0]) for name, values in columns.items()}) for i in range(ALONE)]
    start = perf_counter()
    alone = [evaluate(single) for single in singles]
    one_by_one = (perf_counter() - start) / ALONE
    found = benchmark.pedantic(evaluate, (many,), rounds=5, warmup_rounds=1)
    assert np.allclose(found[-1][:ALONE], [single[-1] for single in alone], rtol=1e-9)
    at_once = benchmark.stats.stats.median / DESIGNS
    report(
        f"{kind.__name__}, {DESIGNS} designs x {ANGLES} angles",
        f"{1e6 * at_once:.0f} us a design, {1e6 * one_by_one:.0f} us one by one",
    )
    assert at_once < one_by_one / 2
