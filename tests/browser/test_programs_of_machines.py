"""Programs of whole machines give in a browser what numpy gives: laws, followers, closures, loads, materials, views."""

import numpy as np
import pytest

from camkit.program import record
from camkit.program.page import numbers
from camkit.quantities import choices_of, quantities_of, value_of
from machine_cases import LAWS, designs_of_every_menu, everything, tables
from program_cases import designs_beside, start_of
from test_programs_page import TOLERANCE, page, replies  # noqa: F401

ANGLES, ROWS = 61, 12
DESIGNS = dict(designs_of_every_menu(3)) | tables()
PLACE_OF_TOP = 1e-9
"""A smooth top is as flat as its place is known: to the root of what its value is rounded to, at best 1e-8."""
LAST_DIGITS = 16
"""A number that the last digit of an input moves by more than a share is no better known: by so many of these."""


def inputs_of(program, design, position, seed=3):
    """Designs beside this one; and this one without some things that may be 0, as a roller is then a knife edge."""
    beside, declared, start = designs_beside(design, ROWS, seed), quantities_of(design), start_of(design) | position
    rng = np.random.default_rng(3)
    for key, value in position.items():
        beside[key] = value + 0.3 * rng.normal(size=(ROWS, 1))
    may_be_0 = [path for path, quantity in declared.items() if quantity.low == 0 and start[path]]
    rows = [{path: column[i, 0] for path, column in beside.items()} for i in range(ROWS)]
    rows += [start | {path: 0.0} for path in may_be_0 if "radius" in path or rng.random() < 0.3]
    return np.array([[row[path] for path in program.inputs] for row in rows])


def replayed(program, inputs):
    """The numbers of each output, a row for each design, by name."""
    names = [name for name in program.outputs if isinstance(name, str)]
    found = [program(dict(zip(program.inputs, row, strict=True))) for row in inputs]
    return {name: np.array([np.ravel(one[name]) for one in found], dtype=float) for name in names}


def possible(outputs):
    """How many designs give more than half of their numbers."""
    return sum(np.isfinite(np.concatenate([*outputs.values()], axis=-1)).mean(-1) > 0.5)


def test_every_law_and_every_option_of_the_short_menus_is_tried():
    designs = DESIGNS.values()
    menus = [(choice, value_of(design, path)) for design in designs for path, choice in choices_of(design).items()]
    tried = [choice.text(value) for choice, value in menus]
    assert {law.name for law in LAWS.values()} <= {*tried}
    assert {name for choice, _ in menus if len(choice.named) < 5 for name in choice.named} <= {*tried}


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_a_machine_is_in_the_page_what_it_is_in_numpy(page, name):  # noqa: F811
    function, position = everything(DESIGNS[name], ANGLES)
    program = record(function, DESIGNS[name], position)
    inputs = inputs_of(program, DESIGNS[name], position)
    expected = replayed(program, inputs)
    if possible(expected) < 3:  # such as a polynomial, whose exponents have to grow
        inputs = inputs_of(program, DESIGNS[name], position, seed=7)
        expected = replayed(program, inputs)
    assert possible(expected) >= 3
    (found,) = replies(page, [[numbers(program), inputs.tolist()]])
    places, moved = list(program.outputs), None
    for key, values in expected.items():
        of_page = np.array([one[places.index(key)] for one in found], dtype=float).reshape(values.shape)
        known = np.isfinite(values)
        np.testing.assert_array_equal(of_page[~known], values[~known], err_msg=key)
        apart = abs(np.where(known, of_page, 0.0) - np.where(known, values, 0.0))
        size = TOLERANCE * abs(values[known]).max(initial=0.0)
        if (apart > size).any():  # as far as the last digit of an input reaches?
            moved = moved or replayed(program, np.nextafter(inputs, np.inf))
            size = np.fmax(size, LAST_DIGITS * abs(moved[key] - values))
        if key.endswith("peak x"):
            size = np.fmax(size, PLACE_OF_TOP * abs(values[known]).max(initial=0.0))
        assert (apart <= size).all(), (key, np.argwhere(apart > size)[:5], apart.max())
