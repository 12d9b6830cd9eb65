"""What the text of a program holds, whatever the design and its names are: one text for all, and numbers."""

import re

import numpy as np
import pytest

from camkit import DoorHandleCam, door_handle_study
from camkit.program import record, recorded
from camkit.program.page import MACHINE, numbers
from program_cases import CASES, INPUTS, expression, judged

HOSTILE = ["</script><img src=x onerror=alert(1)>", "<!--", "');alert(1);('", "\u2028", "`${alert(1)}`", "\\"]
NUMBERS = r'[-+0-9.e,"\[\]]|NaN|Infinity'


@pytest.mark.parametrize("name", CASES)
def test_the_text_holds_numbers_alone(name):
    function, arrays = CASES[name]
    text = numbers(recorded(lambda given: {"out": function(*given.values())}, dict(zip("xy", arrays, strict=False))))
    assert re.fullmatch(f"({NUMBERS})+", text)


def test_no_name_enters_the_text():
    inputs = {name: float(i) for i, name in enumerate(HOSTILE)}
    program = recorded(lambda given: {f"{name}!": np.sin(x) + 1 for name, x in given.items()}, inputs)
    assert re.fullmatch(f"({NUMBERS})+", numbers(program))


def test_the_text_for_all_can_stand_in_a_page():
    assert "<!" not in MACHINE
    assert "</" not in MACHINE
    assert MACHINE.isascii()
    assert not set("'\"`\\$") & set(MACHINE)


def test_the_same_program_has_the_same_text():
    first, second = (recorded(lambda given: {"o": expression(3)(*given.values())}, INPUTS) for _ in range(2))
    assert numbers(first) == numbers(second)


@pytest.mark.slow
def test_a_study_is_a_short_text():
    study = door_handle_study(DoorHandleCam())
    assert len(numbers(record(judged(study, 1), study.start))) < 200_000
