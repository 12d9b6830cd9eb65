"""What a page says of a measure: the words of the code, and a test that there is."""

import ast
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pytest
from every_machine import MACHINES

from camkit import Measure
from camkit.data import load
from camkit.quantities import measures_of
from camkit.render.reasons import reason_of

ROOT = Path(__file__).parents[2]
UNSAID = {
    "maximum pressure angle",  # of a pair of cams, as the next two
    "base radius (pitch)",
    "peak contact force",
    "minimum contact force",
    "peak normal force",
    "gap from roller to pivot",
    "arm and roller l + r",
}
"""What no docstring says."""
SUMS = {"arm and roller l + r"}
"""No more than a sum of two sizes: no test holds it."""


@pytest.mark.parametrize("test", sorted({test for wing in load("measures_held").values() for test in wing.values()}))
def test_the_test_that_holds_a_measure_is_there(test):
    file, name = test.split("::")
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


@pytest.mark.parametrize("name", MACHINES)
def test_every_measure_of_the_package_has_a_test_and_most_a_formula(name):
    design = MACHINES[name]
    analysis, measures = design.analyse(), measures_of(design)
    reasons = {measure.name: reason_of(measure, analysis) for measure in measures}
    assert {name for name, why in reasons.items() if not why["test"]} <= SUMS
    assert all(why["source"] for why in reasons.values())
    assert {name for name, why in reasons.items() if not why["formula"]} <= UNSAID


@dataclass
class Own:
    """An analysis of somebody."""

    @cached_property
    def height(self):
        """``h = r cos phi``.

        More than that is not said.
        """
        return 2.0


def test_the_words_are_those_of_the_code_and_what_nobody_says_is_empty():
    tall = Measure("height", "mm", lambda analysis: analysis.height)
    nothing = {"formula": [], "source": "", "test": ""}
    assert reason_of(tall, Own()) == nothing | {"formula": ["``h = r cos phi``."]}
    assert reason_of(-tall, Own()) == reason_of(tall, Own())
    assert reason_of(Measure("size", "mm", lambda analysis: 3.0), Own()) == nothing
    assert reason_of(Measure("length", "mm", len), Own()) == nothing
