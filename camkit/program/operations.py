"""All that a program is made of: the functions of numpy that can be recorded, and what each is in JavaScript.

``{0}``, ``{1}`` are operands, ``M`` is ``Math``, and names in small letters are functions of `camkit.program.page`.
Truths are 0 and 1.  What numpy writes with other functions is in `camkit.program.written`.
"""

from __future__ import annotations

import operator
from typing import Any

import numpy as np

from .written import picked, whole


def _of_one(names: str) -> dict[object, str]:
    """Functions of one number that JavaScript has by the same name, but for an ``arc``."""
    return {getattr(np, name): f"M.{name.replace('arc', 'a')}({{0}})" for name in names.split()}


EACH: dict[Any, str] = {
    np.add: "{0}+{1}",
    np.subtract: "{0}-{1}",
    np.multiply: "{0}*{1}",
    np.true_divide: "{0}/{1}",
    np.floor_divide: "div({0},{1})",
    np.remainder: "mod({0},{1})",
    np.negative: "-{0}",
    np.positive: "{0}",
    np.square: "{0}*{0}",
    np.reciprocal: "1/{0}",
    np.power: "pow({0},{1})",
    operator.pow: "pow({0},{1})",
    **_of_one("sqrt cbrt floor ceil trunc sign exp expm1 log log1p log2 log10 sin cos tan arcsin arccos arctan"),
    **_of_one("sinh cosh tanh arcsinh arccosh arctanh"),
    np.absolute: "M.abs({0})",
    np.arctan2: "M.atan2({0},{1})",
    np.hypot: "M.hypot({0},{1})",
    np.copysign: "copysign({0},{1})",
    np.minimum: "M.min({0},{1})",
    np.maximum: "M.max({0},{1})",
    np.fmin: "fmin({0},{1})",
    np.fmax: "fmax({0},{1})",
    np.degrees: "{0}*(180/M.PI)",
    np.less: "{0}<{1}",
    np.less_equal: "{0}<={1}",
    np.greater: "{0}>{1}",
    np.greater_equal: "{0}>={1}",
    np.equal: "{0}==={1}",
    np.not_equal: "{0}!=={1}",
    np.logical_and: "{0}!==0&&{1}!==0",
    np.logical_or: "{0}!==0||{1}!==0",
    np.logical_not: "{0}===0",
    np.bitwise_and: "{0}&{1}",
    np.bitwise_or: "{0}|{1}",
    np.invert: "{0}===0",
    np.isfinite: "Number.isFinite({0})",
    np.isnan: "{0}!=={0}",
    np.isinf: "M.abs({0})===Infinity",
    np.where: "{0}!==0?{1}:{2}",
    picked: "H[a+{1}+({1}<0?{2}:0)]",
    whole: "M.trunc({0})",
}
"""What is done to numbers, or to those of arrays one by one."""
OF_NO_WHOLE = (np.invert, np.reciprocal)
"""Of these, what numpy does to whole numbers in another way."""

_FOLDED = (np.add, np.multiply, np.minimum, np.maximum, np.fmin, np.fmax)
_OF_TRUTHS = (np.logical_and, np.logical_or, np.bitwise_and, np.bitwise_or)
FOLDS: dict[Any, str] = {function.reduce: EACH[function] for function in (*_FOLDED, *_OF_TRUTHS)}
FOLDS[np.add.accumulate] = EACH[np.add]
"""What makes one number of many along axes, or of each and of all before it: by an operation on two."""

ALONG: dict[Any, tuple[str, int | None]] = {np.argmax: ("argmax", None), np.sort: ("sorted", -1)}
"""Functions of the page's library that go along an axis: that one, unless another is asked for."""

MOVES = {
    *(operator.getitem, np.broadcast_to, np.stack, np.concatenate, np.expand_dims, np.squeeze, np.reshape, np.ravel),
    *(np.transpose, np.moveaxis, np.swapaxes, np.repeat, np.tile, np.roll, np.flip, np.vstack, np.hstack),
    *(np.column_stack, np.atleast_1d, np.atleast_2d, np.copy, np.diagonal),
}
"""Numbers only change their places, which can be done before a program runs."""


def operands(operation: str) -> int:
    """How many numbers an operation takes."""
    return 1 + ("{1}" in operation) + ("{2}" in operation)
