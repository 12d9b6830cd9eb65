"""A parameter is declared once: symbol, default, range, unit and meaning.

Sliders, optimiser bounds, tables, saved files and the refusal of bad numbers all read the same
declaration, which sits on the field of the design that it describes:

>>> @dataclass(frozen=True)
... class Lever(Design):
...     arm: float = quantity("l", 50, 20, 90, "mm", "pivot to roller centre")
>>> Lever().arm
0.05
>>> Lever(arm=-0.01)
Traceback (most recent call last):
    ...
ValueError: the arm (pivot to roller centre) is -10 mm; it must be a finite number above 0 mm

A design is a frozen dataclass.  Its fields hold one number each, or arrays of shape ``(p, 1)`` for a
population of ``p`` designs: one number that cannot be built is refused in a sentence, a member of a
population that cannot be built becomes ``nan`` and disturbs nobody else.  What is no number is checked against
the annotation of its field (`refuse_kinds`).  A number that was meant in the unit of its declaration, but typed
without it, draws a `UnitRemark`.

A design is a tree: it holds a motion, loads, materials, and these hold laws.  Every quantity has a path:

>>> from camkit import TranslatingRollerCam
>>> cam = TranslatingRollerCam()
>>> quantities_of(cam)["motion.rise.lift"].text(value_of(cam, "motion.rise.lift"))
'20 mm'
>>> with_quantities(cam, {"motion.rise.lift": 0.03, "load.spring_rate": 8e3}).load.spring_rate
8000.0
"""

from dataclasses import dataclass  # noqa: F401 - for the example above

from .declaration import (
    Choice,
    Declared,
    Quantity,
    UnitRemark,
    choice,
    counted,
    declarations,
    numbered,
    quantity,
    row,
    unremarked,
)
from .design import (
    Analysable,
    Conversion,
    D,
    Design,
    measures_of,
    refuse_design,
    refuse_population,
    refuse_unmeasured,
)
from .known import certain, floats, known, text_if, text_of, unless
from .markup import words
from .measure import CurveMeasure, LeastMeasure, Measure, PeakMeasure
from .tree import Paths, choices_of, declared_in, label, members, quantities_of, value_of, with_quantities

__all__ = [
    "Analysable",
    "Choice",
    "Conversion",
    "CurveMeasure",
    "D",
    "Declared",
    "Design",
    "LeastMeasure",
    "Measure",
    "Paths",
    "PeakMeasure",
    "Quantity",
    "UnitRemark",
    "certain",
    "choice",
    "choices_of",
    "counted",
    "declarations",
    "declared_in",
    "floats",
    "known",
    "label",
    "measures_of",
    "members",
    "numbered",
    "quantities_of",
    "quantity",
    "refuse_design",
    "refuse_population",
    "refuse_unmeasured",
    "row",
    "text_if",
    "text_of",
    "unless",
    "unremarked",
    "value_of",
    "with_quantities",
    "words",
]
