"""All that a program is made of: one row for each function of numpy that can be recorded.

A row says what the function is in the languages that programs are written in: JavaScript, whose ``{0}``, ``{1}`` are
operands and ``M`` is ``Math`` (names in small letters are functions of `camkit.program.page`).  Truths are 0 and 1.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import written


@dataclass(frozen=True)
class Each:
    """An operation on numbers, done for each element."""

    javascript: str

    @cached_property
    def operands(self) -> int:
        """How many numbers it takes."""
        return sum(f"{{{k}}}" in self.javascript for k in range(3))


@dataclass(frozen=True)
class Fold:
    """Many numbers become one along axes: by the operation ``by``, from ``start``."""

    by: Callable[..., object]
    start: float


@dataclass(frozen=True)
class Along:
    """A function of the page's library that goes along an axis (that one, unless another is asked for)."""

    javascript: str
    axis: int | None


@dataclass(frozen=True)
class Pick:
    """Numbers are picked from rows, at computed places."""


@dataclass(frozen=True)
class Move:
    """Numbers only change their places, which can be done before the program runs."""


@dataclass(frozen=True)
class Written:
    """Written with the other rows, as numpy works it out."""

    by: Callable[..., object]


Row = Each | Fold | Along | Pick | Move | Written


def _library(*names: str) -> dict[object, Row]:
    """Functions of one number that JavaScript has by the same name."""
    spelled = {name: name.replace("arc", "a").replace("absolute", "abs") for name in names}
    return {getattr(np, name): Each(f"M.{spelled[name]}({{0}})") for name in names}


def _truth(test: str) -> Each:
    return Each(f"+({test})")


_POWER = Each("pow({0},{1})")
POWERS = {-1: "1/{0}", 0: "1", 0.5: "M.sqrt({0})", 1: "{0}", 2: "{0}*{0}", 3: "{0}*{0}*{0}"}
"""Powers that need no logarithm; all but the cube are worked out in this way by numpy, too."""

_MOVES: tuple[object, ...] = (
    *(operator.getitem, np.broadcast_to, np.stack, np.concatenate, np.expand_dims, np.squeeze, np.reshape, np.ravel),
    *(np.transpose, np.moveaxis, np.swapaxes, np.repeat, np.tile, np.roll, np.flip, np.vstack, np.hstack),
    *(np.column_stack, np.atleast_1d, np.atleast_2d, np.copy, np.diagonal),
)

TABLE: dict[object, Row] = {
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
    np.less: _truth("{0}<{1}"),
    np.less_equal: _truth("{0}<={1}"),
    np.greater: _truth("{0}>{1}"),
    np.greater_equal: _truth("{0}>={1}"),
    np.equal: _truth("{0}==={1}"),
    np.not_equal: _truth("{0}!=={1}"),
    np.logical_and: _truth("{0}!==0&&{1}!==0"),
    np.logical_or: _truth("{0}!==0||{1}!==0"),
    np.logical_xor: _truth("({0}!==0)!==({1}!==0)"),
    np.logical_not: _truth("{0}===0"),
    np.bitwise_and: _truth("{0}!==0&&{1}!==0"),
    np.bitwise_or: _truth("{0}!==0||{1}!==0"),
    np.bitwise_xor: _truth("{0}!=={1}"),
    np.invert: _truth("{0}===0"),
    np.isfinite: _truth("Number.isFinite({0})"),
    np.isnan: _truth("{0}!=={0}"),
    np.isinf: _truth("M.abs({0})===Infinity"),
    np.where: Each("{0}!==0?{1}:{2}"),
    np.add.reduce: Fold(np.add, 0.0),
    np.multiply.reduce: Fold(np.multiply, 1.0),
    np.minimum.reduce: Fold(np.minimum, np.inf),
    np.maximum.reduce: Fold(np.maximum, -np.inf),
    np.fmin.reduce: Fold(np.fmin, np.nan),
    np.fmax.reduce: Fold(np.fmax, np.nan),
    np.logical_and.reduce: Fold(np.logical_and, 1.0),
    np.logical_or.reduce: Fold(np.logical_or, 0.0),
    np.bitwise_and.reduce: Fold(np.logical_and, 1.0),
    np.bitwise_or.reduce: Fold(np.logical_or, 0.0),
    np.argmax: Along("argmax", None),
    np.add.accumulate: Along("accumulate", 0),
    np.sort: Along("sorted", -1),
    written.picked: Pick(),
    written.whole: Each("M.trunc({0})"),
    **dict.fromkeys(_MOVES, Move()),
    **{function: Written(by) for function, by in written.BY.items()},
}
"""Each function of numpy that can be recorded, and what it is elsewhere."""
