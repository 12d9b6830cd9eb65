"""Every study, every table of measures and every default view of the machines replays as numpy works it out."""

import numpy as np
import pytest
from every_machine import MACHINES
from numpy.testing import assert_allclose, assert_array_equal

from camkit.linkage import DoubleUniversalJoint
from camkit.machines import (
    cam_lever_study,
    corrected_valve_study,
    door_handle_paper_study,
    door_handle_study,
    high_speed_study,
    lift_curve_study,
    ninety_degree_study,
    rssr_study,
    shaft_study,
    valve_front_study,
    valve_study,
)
from camkit.program import CannotRecord, record
from camkit.quantities import measures_of, with_quantities
from camkit.views import default_views
from machine_cases import NOT_YET, everything, of_picture
from program_cases import designs_beside

ROWS, BLOCKS = 20, 10
OF_MEASURES = 4
"""Blocks of designs whose tables of measures are compared: each has numbers from anywhere in their ranges."""

STUDIES = {
    "door handle": door_handle_study(),
    "door handle, as published": door_handle_paper_study(),
    "lift curve": lift_curve_study(),
    "linkage": rssr_study(),
    "linkage in a housing": ninety_degree_study(),
    "shaft": shaft_study(),
    "valve": valve_study(),
    "valve, corrected": corrected_valve_study(),
    "valve, front": valve_front_study(),
    "high speed": high_speed_study(),
    "high speed, laws free": high_speed_study(free_laws=True),
    "high speed, weakest spring": high_speed_study(free_laws=True, free_spring=False),
    "lever": cam_lever_study(),
}
DESIGNS = MACHINES | {"double joint": DoubleUniversalJoint()}
ANGLES = 61
VIEWS = {(name, view.__name__): view for name, d in DESIGNS.items() for view in default_views(d.analyse(ANGLES))}


def check(function, start, blocks=BLOCKS):
    """A program of ``function`` against numpy, to the last bit, over designs of which some can be built."""
    program, built = record(function, start, rows=ROWS), 0
    for block in range(blocks):
        values = designs_beside(start, ROWS, block)
        with np.errstate(all="ignore"):
            expected = function(with_quantities(start, values))
        found = program(values)
        assert found.keys() == expected.keys()
        for name, value in expected.items():
            assert_array_equal(found[name], value, err_msg=name, strict=True)
        built += np.isfinite(np.stack(list(expected.values()), axis=-1)).all(-1).sum()
    return built


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_a_study_replays_to_the_last_bit(name):
    study = STUDIES[name]

    def judged(design):
        found = study.judge(np.empty((ROWS, 0)), design.analyse(study.angles))
        columns = [*found.f.T, *found.g.T]
        return {str(i): column for i, column in enumerate(columns)}

    assert check(judged, study.start) >= 20


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_a_table_of_measures_replays_to_the_last_bit(name):
    design = DESIGNS[name]

    def measured(design):
        analysis = design.analyse(ANGLES)
        return {measure.name: measure.of(analysis, ROWS) for measure in measures_of(design)}

    check(measured, design, OF_MEASURES)


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_all_views_replay(name):
    design = DESIGNS[name]
    function, position = everything(design, ANGLES)
    program, seen = record(function, design, position), 0
    for seed in range(60):
        if seen == 4:
            break
        values = {path: float(column[0, 0]) for path, column in designs_beside(design, 1, seed).items()}
        place = {k: v + 0.3 * seed for k, v in position.items()}
        try:
            with np.errstate(all="ignore"):
                expected = function(with_quantities(design, values), **place)
        except ValueError:  # it cannot be built
            continue
        found, seen = program(values | place), seen + 1
        assert found.keys() == expected.keys()
        for key, value in expected.items():
            if isinstance(value, str):
                assert found[key] == value
                continue
            size = np.max(abs(np.asarray(value)), initial=0, where=np.isfinite(value))
            assert_allclose(found[key], value, rtol=1e-12, atol=1e-12 * size, err_msg=key)
    assert seen >= 3


@pytest.mark.parametrize(("name", "view"), NOT_YET)
def test_a_view_that_cannot_be_recorded_is_refused_where_it_asks(name, view):
    def shown(design):
        return of_picture(VIEWS[name, view](design.analyse(ANGLES)))

    with pytest.raises(CannotRecord, match=r"^camkit/\w+/\w+.py, line \d+: "):
        record(shown, DESIGNS[name])
