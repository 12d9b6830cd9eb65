"""The shaft's paper: what of its Table 1 is reproduced, and each slip by an independent sum."""

import numpy as np
import pytest

from camkit import mm, rpm
from camkit.papers import shaft


def verdicts(comparison) -> list[str]:
    return [row.verdict for row in comparison.rows]


def test_one_area_is_reproduced_with_pi_and_two_with_3_14() -> None:
    assert verdicts(shaft.table_1()) == ["reproduced", "agrees to 0.059 %", "agrees to 0.051 %"]
    assert verdicts(shaft.table_1_with_rounded_pi()) == ["agrees to 0.051 %", "reproduced", "reproduced"]
    assert pytest.approx(5055, abs=0.5) == 3.14 / 4 * (129**2 - 101**2)
    assert pytest.approx(4858.43, abs=0.005) == 3.14 / 4 * (128.64**2 - 101.78**2)


def test_the_sag_has_384() -> None:
    """The bending line in closed form is q x (L^3 - 2 L x^2 + x^3) / (24 E I): 5/384 in the middle."""
    x = 0.5
    assert 5 / (x * (1 - 2 * x**2 + x**3) / 24) == pytest.approx(384, rel=1e-14)
    assert shaft.sag_number() == pytest.approx(384, rel=1e-7)
    assert verdicts(shaft.sag()) == ["off by +10.3 %"]


def test_the_critical_speed_with_the_misprint() -> None:
    for design in shaft.printed_designs().values():
        a = design.analyse()
        y = 5 * a.mass * 9.81 * design.length**3 / (348 * design.elastic_modulus * a.polar_moment / 2)
        assert shaft.critical_speed_as_printed(design) == pytest.approx(np.sqrt(9.81 / y), rel=1e-12)
        assert shaft.critical_speed_as_printed(design) / rpm > 1500


def test_the_optimum_is_1_74_percent_lighter() -> None:
    optimum = shaft.global_optimum()
    assert optimum.rows[2].computed == pytest.approx(4776.191895, abs=5e-7)
    assert optimum.rows[2].remark == "1.74 % lighter than the paper's tube"
    assert not any(row.reproduced for row in optimum.rows)


def test_the_best_whole_millimetres() -> None:
    best = shaft.best_whole_millimetres()
    assert best.analyse().area / mm**2 == pytest.approx(4898.53, abs=5e-3)
    assert 1 - best.analyse().area / shaft.printed_designs()["genetic algorithm"].analyse().area == pytest.approx(
        0.032, abs=5e-4
    )
