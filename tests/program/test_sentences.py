"""What a program says in words: the sentence that refuses a design, exactly as plain Python raises it."""

import numpy as np
import pytest
from every_machine import MACHINES

from camkit.program import record
from camkit.quantities import with_quantities
from program_cases import designs_beside

ANGLES, DESIGNS = 61, 60


def raised(design, values):
    """The sentence that refuses the design, "" if it can be built."""
    try:
        with np.errstate(all="ignore"):
            with_quantities(design, values).analyse(ANGLES)
    except ValueError as refusal:
        return str(refusal)
    return ""


@pytest.mark.parametrize("name", MACHINES)
def test_a_design_is_refused_in_the_same_sentence(name):
    design = MACHINES[name]

    def analysed(design):
        design.analyse(ANGLES)
        return {}

    program = record(analysed, design)
    for seed in range(DESIGNS):
        values = {path: float(column[0, 0]) for path, column in designs_beside(design, 1, seed).items()}
        assert program.refusal(values) == raised(design, values)
