"""What the text of a program holds, whatever the design and its names are: numbers and operations of the table."""

import re

import numpy as np
import pytest

from camkit import DoorHandleCam, door_handle_study
from camkit.program import record, recorded
from camkit.program.page import LIBRARY, javascript
from program_cases import CASES, INPUTS, expression, judged

HOSTILE = ["</script><img src=x onerror=alert(1)>", "<!--", "');alert(1);('", "\u2028", "`${alert(1)}`", "\\"]
WORDS = {*re.findall(r"[A-Za-z_]\w*", LIBRARY), "H", "X", "j", "set", "slice", "function", "Float64Array", "new", "let"}
WORDS |= {*("PI", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh")}
WORDS |= {*("atanh", "sqrt", "cbrt", "exp", "expm1", "log", "log1p", "log2", "log10", "hypot", "sign", "ceil", "trunc")}
WORDS |= {*("max", "isFinite", "isNaN", "Number", "NaN", "Infinity", "const", "for", "return", "e")}


def words_of(text):
    return {word for word in re.findall(r"[A-Za-z_]\w*", text) if not re.fullmatch(r"[vf]\d+", word)}


@pytest.mark.parametrize("name", CASES)
def test_the_text_holds_operations_of_the_table_alone(name):
    function, arrays = CASES[name]
    text = javascript(recorded(lambda given: {"out": function(*given.values())}, {"x": arrays[0], "y": arrays[-1]}
                               if len(arrays) > 1 else {"x": arrays[0]}))  # fmt: skip
    assert words_of(text) <= WORDS


def test_no_name_enters_the_text():
    inputs = {name: float(i) for i, name in enumerate(HOSTILE)}
    program = recorded(lambda given: {f"{name}!": np.sin(x) + 1 for name, x in given.items()}, inputs)
    text = javascript(program)
    assert words_of(text) <= WORDS
    assert "<!" not in text
    assert "</" not in text
    assert text.isascii()
    assert not set("'\"`\\$") & set(text)


def test_the_same_program_has_the_same_text():
    first, second = (recorded(lambda given: {"o": expression(3)(*given.values())}, INPUTS) for _ in range(2))
    assert javascript(first) == javascript(second)


@pytest.mark.slow
def test_no_function_is_too_long_to_be_optimised():
    study = door_handle_study(DoorHandleCam())
    text = javascript(record(judged(study, 1), study.start))
    lengths = [len(body) for body in re.split(r"\nfunction f\d+", text)[1:]]
    assert len(lengths) > 20
    assert max(lengths) < 6500
    assert len(text) < 300_000
