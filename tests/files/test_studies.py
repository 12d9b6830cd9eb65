"""What every study of the package owes to a search: designs that keep its limits, and no free quantity for nothing."""

import numpy as np
import pytest
from test_files import studies

from camkit import quick_front
from camkit.quantities import words
from camkit.search.fast_front import MOST_FREE

STUDIES = studies()
STAY = {"door_handle_study": {"lift_arm"}, "door_handle_paper_study": {"lift_arm", "lift_start_angle"}}
"""What stays on a bound along a front: the study's docstring says so, in bold."""
FRONTS = [name for name, make in STUDIES.items() if len(make().minimise) > 1 and len(make().free) <= MOST_FREE]


def said_of(name):
    """The docstring of a study, in one line."""
    return " ".join(STUDIES[name].__doc__.split())


def test_the_studies_of_the_package_are_here():
    assert set(STUDIES) >= {
        "door_handle_study", "door_handle_paper_study", "lift_curve_study", "high_speed_study", "cam_lever_study",
        "valve_study", "corrected_valve_study", "valve_front_study", "rssr_study", "ninety_degree_study",
        "shaft_study",
    }  # fmt: skip


@pytest.mark.parametrize("name", STUDIES)
def test_one_random_design_in_a_hundred_is_feasible_or_the_docstring_says_why_not(name):
    study = STUDIES[name]()
    x = np.random.default_rng(0).uniform(*study.bounds, (5_000, len(study.free)))
    feasible = np.concatenate([study.evaluate(part).feasible for part in np.array_split(x, 20)])
    assert feasible.mean() >= 0.01 or "random design" in said_of(name)


@pytest.mark.parametrize("name", STUDIES)
def test_no_free_quantity_is_without_effect(name):
    """Moved alone anywhere in its bounds, each changes an objective or a limit of most designs that can be built."""
    study, draw = STUDIES[name](), np.random.default_rng(1)
    x = draw.uniform(*study.bounds, (400, len(study.free)))
    here = study.evaluate(x)
    for j, quantity in enumerate(study.free):
        moved = x.copy()
        moved[:, j] = draw.uniform(*study.bounds[:, j], len(x))
        there = study.evaluate(moved)
        built = np.isfinite(here.f).all(1) & np.isfinite(there.f).all(1)
        changed = (here.f != there.f).any(1) | (here.g != there.g).any(1)
        assert built.sum() > 10
        assert changed[built].mean() > 0.5, quantity


@pytest.mark.parametrize("name", FRONTS)
def test_along_the_front_only_what_is_named_stays_on_a_bound(name):
    study = STUDIES[name]()
    low, high = study.bounds
    share = (quick_front(study).x - low) / (high - low)
    stays = np.maximum((share < 1e-3).mean(0), (share > 1 - 1e-3).mean(0)) > 0.8
    assert {quantity for quantity, on in zip(study.free, stays, strict=True) if on} == STAY.get(name, set())
    for quantity in STAY.get(name, ()):
        bold = [part for i, part in enumerate(said_of(name).split("**")) if i % 2]
        assert any(words(quantity).split()[-1] in part and "bound" in part for part in bold)


def test_a_quantity_without_effect_would_be_noticed():
    study = STUDIES["lift_curve_study"]()
    dummy = study.replace(free={**study.free, "relief_arm": (0.072, 0.078)})
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(STUDIES, "dummy", lambda: dummy)
        with pytest.raises(AssertionError, match="relief_arm"):
            test_no_free_quantity_is_without_effect("dummy")
