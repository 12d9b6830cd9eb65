"""Physics and views, recorded once: plain numpy code becomes a program that runs elsewhere.

A program holds numbers and the operations of one table (`operations`), and nothing else: inputs and outputs go by their
place, names stay outside.
"""

from .derivative import derivative
from .program import Program, record, recorded, unrecorded
from .record import CannotRecord

__all__ = ["CannotRecord", "Program", "derivative", "record", "recorded", "unrecorded"]
