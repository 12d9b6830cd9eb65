"""All that a program is made of: one row for each function of numpy that can be recorded.

A row says what the function is in the languages that programs are written in: JavaScript, whose ``{0}``, ``{1}`` are
operands and ``M`` is ``Math`` (names in small letters are functions of `camkit.program.page`).  Truths are 0 and 1.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import written


@dataclass(frozen=True)
class Each:
    """An operation on numbers, done for each element."""

    javascript: str

    @property
    def operands(self) -> int:
        """How many numbers it takes."""
        return 1 + ("{1}" in self.javascript) + ("{2}" in self.javascript)


@dataclass(frozen=True)
class Fold:
    """An operation on two numbers makes one of many along an axis, or of each and of all before it."""

    javascript: str
    axis: int | None = 0


@dataclass(frozen=True)
class Along:
    """A function of the page's library that goes along an axis (that one, unless another is asked for)."""

    javascript: str
    axis: int | None


@dataclass(frozen=True)
class Move:
    """Numbers only change their places, which can be done before the program runs."""


@dataclass(frozen=True)
class Written:
    """Written with the other rows, as numpy works it out."""

    by: Callable[..., object]


Row = Each | Fold | Along | Move | Written


def _library(*names: str) -> dict[object, Each]:
    """Functions of one number that JavaScript has by the same name."""
    spelled = {name: name.replace("arc", "a").replace("absolute", "abs") for name in names}
    return {getattr(np, name): Each(f"M.{spelled[name]}({{0}})") for name in names}


_POWER = Each("pow({0},{1})")

_MOVES: tuple[object, ...] = (
    *(operator.getitem, np.broadcast_to, np.stack, np.concatenate, np.expand_dims, np.squeeze, np.reshape, np.ravel),
    *(np.transpose, np.moveaxis, np.swapaxes, np.repeat, np.tile, np.roll, np.flip, np.vstack, np.hstack),
    *(np.column_stack, np.atleast_1d, np.atleast_2d, np.copy, np.diagonal),
)

_EACH: dict[Any, Each] = {
    np.add: Each("{0}+{1}"),
    np.subtract: Each("{0}-{1}"),
    np.multiply: Each("{0}*{1}"),
    np.true_divide: Each("{0}/{1}"),
    np.floor_divide: Each("div({0},{1})"),
    np.remainder: Each("mod({0},{1})"),
    np.negative: Each("-{0}"),
    np.positive: Each("{0}"),
    np.square: Each("{0}*{0}"),
    np.reciprocal: Each("1/{0}"),
    np.power: _POWER,
    operator.pow: _POWER,
    **_library("absolute", "sqrt", "cbrt", "floor", "ceil", "trunc", "sign", "sin", "cos", "tan", "arcsin", "arccos"),
    **_library("arctan", "sinh", "cosh", "tanh", "arcsinh", "arccosh", "arctanh", "exp", "expm1", "log", "log1p"),
    **_library("log2", "log10"),
    np.rint: Each("rint({0})"),
    np.arctan2: Each("M.atan2({0},{1})"),
    np.hypot: Each("M.hypot({0},{1})"),
    np.copysign: Each("copysign({0},{1})"),
    np.minimum: Each("M.min({0},{1})"),
    np.maximum: Each("M.max({0},{1})"),
    np.fmin: Each("fmin({0},{1})"),
    np.fmax: Each("fmax({0},{1})"),
    np.deg2rad: Each("{0}*(M.PI/180)"),
    np.radians: Each("{0}*(M.PI/180)"),
    np.rad2deg: Each("{0}*(180/M.PI)"),
    np.degrees: Each("{0}*(180/M.PI)"),
    np.less: Each("{0}<{1}"),
    np.less_equal: Each("{0}<={1}"),
    np.greater: Each("{0}>{1}"),
    np.greater_equal: Each("{0}>={1}"),
    np.equal: Each("{0}==={1}"),
    np.not_equal: Each("{0}!=={1}"),
    np.logical_and: Each("{0}!==0&&{1}!==0"),
    np.logical_or: Each("{0}!==0||{1}!==0"),
    np.logical_xor: Each("({0}!==0)!==({1}!==0)"),
    np.logical_not: Each("{0}===0"),
    np.bitwise_and: Each("{0}&{1}"),
    np.bitwise_or: Each("{0}|{1}"),
    np.bitwise_xor: Each("{0}^{1}"),
    np.invert: Each("{0}===0"),
    np.isfinite: Each("Number.isFinite({0})"),
    np.isnan: Each("{0}!=={0}"),
    np.isinf: Each("M.abs({0})===Infinity"),
    np.where: Each("{0}!==0?{1}:{2}"),
    written.picked: Each("H[a+{1}+({1}<0?{2}:0)]"),
    written.whole: Each("M.trunc({0})"),
}
_FOLDED = (np.add, np.multiply, np.minimum, np.maximum, np.fmin, np.fmax, np.logical_and, np.logical_or)

TABLE: dict[object, Row] = {
    **_EACH,
    **{function.reduce: Fold(_EACH[function].javascript) for function in _FOLDED},
    np.bitwise_and.reduce: Fold("{0}&{1}"),
    np.bitwise_or.reduce: Fold("{0}|{1}"),
    np.add.accumulate: Fold("{0}+{1}"),
    np.argmax: Along("argmax", None),
    np.sort: Along("sorted", -1),
    **dict.fromkeys(_MOVES, Move()),
    **{function: Written(by) for function, by in written.BY.items()},
}
"""Each function of numpy that can be recorded, and what it is elsewhere."""
