"""What each operation of the table is in LLVM: strictly as IEEE 754 says, without a flag that would change a digit.

A number is a vector of so many designs side by side (`LANES`), a truth a vector of bits.
"""

from __future__ import annotations

import operator
import struct
from collections.abc import Callable

import numpy as np

from ..operations import EACH, FOLDS
from ..written import whole
from .rows import RAISED

BY_NUMPY = (
    *(np.sin, np.cos, np.remainder, np.tan, np.arcsin, np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.arcsinh),
    *(np.arccosh, np.arctanh, np.exp, np.expm1, np.log, np.log1p, np.log2, np.log10, np.cbrt, np.arctan2, np.hypot),
    *(np.power, np.floor_divide),
)
"""Functions that are done by numpy's own loops, to the last bit the same; the first three for rare numbers alone."""


class Value(str):
    """A name or a literal in the text."""

    truth = False


class Truth(Value):
    """One that is a truth."""

    truth = True


def literal(number: float) -> Value:
    """The same number for every design."""
    return Value(f"splat (double 0x{struct.unpack('<Q', struct.pack('<d', number))[0]:016X})")


ZERO, ONE = literal(0.0), literal(1.0)


class Words:
    """The text of a function, line by line."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        self.numbers, self.truths, self.wholes = f"<{lanes} x double>", f"<{lanes} x i1>", f"<{lanes} x i64>"
        self.lines: list[str] = []
        self._names = 0

    def kind(self, value: Value) -> str:
        """The type of a value, as LLVM calls it."""
        return self.truths if value.truth else self.numbers

    def line(self, text: str) -> None:
        """One more line."""
        self.lines.append(f"  {text}")

    def named(self, text: str, kind: type[Value] = Value) -> Value:
        """A line that makes a value."""
        self._names += 1
        name = kind(f"%v{self._names}")
        self.line(f"{name} = {text}")
        return name

    def number(self, value: Value) -> Value:
        """A truth as 0 or 1."""
        if not value.truth:
            return value
        return self.named(f"select {self.truths} {value}, {self.numbers} {ONE}, {self.numbers} {ZERO}")

    def is_true(self, value: Value) -> Value:
        """Whether a number is not 0."""
        return value if value.truth else self.compared("une", value, ZERO)

    def two(self, word: str, a: Value, b: Value) -> Value:
        """Such as ``fadd``."""
        return self.named(f"{word} {self.numbers} {self.number(a)}, {self.number(b)}")

    def compared(self, how: str, a: Value, b: Value) -> Value:
        """Such as ``olt``: ordered and less than."""
        return self.named(f"fcmp {how} {self.numbers} {self.number(a)}, {self.number(b)}", Truth)

    def both(self, word: str, a: Value, b: Value) -> Value:
        """``and``, ``or``, ``xor`` of truths."""
        return self.named(f"{word} {self.truths} {self.is_true(a)}, {self.is_true(b)}", Truth)

    def no(self, a: Value) -> Value:
        """Not."""
        return self.named(f"xor {self.truths} {self.is_true(a)}, splat (i1 true)", Truth)

    def where(self, condition: Value, a: Value, b: Value) -> Value:
        """``a`` where the condition holds, else ``b``."""
        c = self.is_true(condition)
        if a.truth and b.truth:
            return self.named(f"select {self.truths} {c}, {self.truths} {a}, {self.truths} {b}", Truth)
        return self.named(f"select {self.truths} {c}, {self.numbers} {self.number(a)}, {self.numbers} {self.number(b)}")

    def called(self, name: str, *arguments: Value) -> Value:
        """A function of LLVM's, by the part of its name that differs."""
        given = ", ".join(f"{self.numbers} {self.number(a)}" for a in arguments)
        return self.named(f"call {self.numbers} @llvm.{name}.v{self.lanes}f64({given})")

    def helped(self, name: str, *arguments: Value) -> Value:
        """A function of `camkit.program.kernel.library`."""
        given = ", ".join(f"{self.numbers} {self.number(a)}" for a in arguments)
        return self.named(f"call fastcc {self.numbers} @{name}(ptr %N, {given})")

    def by_numpy(self, place: int, *arguments: Value) -> Value:
        """One of numpy's loops."""
        given = ", ".join(f"{self.numbers} {self.number(a)}" for a in arguments)
        return self.named(f"call fastcc {self.numbers} @numpy{len(arguments)}(ptr %N, i64 {2 * place}, {given})")


def _larger(w: Words, how: str, a: Value, b: Value) -> Value:
    """The larger or the less; no number if one of them is none."""
    return w.where(w.compared("uno", a, a), a, w.where(w.compared(how, a, b), a, b))


def _larger_known(w: Words, how: str, a: Value, b: Value) -> Value:
    """The larger or the less; the other if one is no number."""
    return w.where(w.both("or", w.compared(how, a, b), w.compared("uno", b, b)), a, b)


def _sign(w: Words, a: Value) -> Value:
    below = w.where(w.compared("olt", a, ZERO), literal(-1.0), w.two("fmul", a, ZERO))
    return w.where(w.compared("ogt", a, ZERO), ONE, below)


def _known(w: Words, how: str, a: Value) -> Value:
    return w.compared(how, w.called("fabs", a), literal(np.inf))


def _raised(w: Words, a: Value, exponent: Value) -> Value:
    """A power whose exponent is one number for all."""
    found = w.by_numpy(BY_NUMPY.index(np.power), a, exponent)
    for special, value in ((-1.0, w.two("fdiv", ONE, a)), (0.5, w.called("sqrt", a)), (2.0, w.two("fmul", a, a))):
        found = w.where(w.compared("oeq", exponent, literal(special)), value, found)
    return found


def _plain(word: str) -> Callable[[Words, Value, Value], Value]:
    return lambda w, a, b: w.two(word, a, b)


def _compared(how: str) -> Callable[[Words, Value, Value], Value]:
    return lambda w, a, b: w.compared(how, a, b)


def _of_llvm(name: str) -> Callable[..., Value]:
    return lambda w, *arguments: w.called(name, *arguments)


def _of_truths(word: str) -> Callable[[Words, Value, Value], Value]:
    return lambda w, a, b: w.both(word, a, b)


def _of_library(name: str) -> Callable[..., Value]:
    return lambda w, *arguments: w.helped(name, *arguments)


def _of_numpy(place: int) -> Callable[..., Value]:
    return lambda w, *arguments: w.by_numpy(place, *arguments)


_WORDS: dict[object, Callable[..., Value]] = {
    **{function: _of_numpy(place) for place, function in enumerate(BY_NUMPY)},
    np.add: _plain("fadd"),
    np.subtract: _plain("fsub"),
    np.multiply: _plain("fmul"),
    np.true_divide: _plain("fdiv"),
    np.negative: lambda w, a: w.named(f"fneg {w.numbers} {w.number(a)}"),
    np.positive: lambda w, a: a,
    np.square: lambda w, a: w.two("fmul", a, a),
    np.reciprocal: lambda w, a: w.two("fdiv", ONE, a),
    **{getattr(np, name): _of_llvm(name) for name in ("sqrt", "floor", "ceil", "trunc", "copysign")},
    np.absolute: _of_llvm("fabs"),
    np.sign: _sign,
    **{getattr(np, name): _of_library(name) for name in ("sin", "cos", "remainder")},
    np.minimum: lambda w, a, b: _larger(w, "olt", a, b),
    np.maximum: lambda w, a, b: _larger(w, "ogt", a, b),
    np.fmin: lambda w, a, b: _larger_known(w, "ole", a, b),
    np.fmax: lambda w, a, b: _larger_known(w, "oge", a, b),
    np.degrees: lambda w, a: w.two("fmul", a, literal(180 / np.pi)),
    np.less: _compared("olt"),
    np.less_equal: _compared("ole"),
    np.greater: _compared("ogt"),
    np.greater_equal: _compared("oge"),
    np.equal: _compared("oeq"),
    np.not_equal: _compared("une"),
    np.logical_and: _of_truths("and"),
    np.logical_or: _of_truths("or"),
    np.logical_not: lambda w, a: w.no(a),
    np.bitwise_and: _of_truths("and"),
    np.bitwise_or: _of_truths("or"),
    np.invert: lambda w, a: w.no(a),
    np.isfinite: lambda w, a: _known(w, "olt", a),
    np.isnan: lambda w, a: w.compared("uno", a, a),
    np.isinf: lambda w, a: _known(w, "oeq", a),
    np.where: lambda w, c, a, b: w.where(c, a, b),
    operator.pow: _of_numpy(BY_NUMPY.index(np.power)),
    whole: _of_llvm("trunc"),
}
WORDS = {EACH[function]: word for function, word in _WORDS.items()} | {RAISED: _raised}
"""What to write for an operation."""
NOTHING = {
    np.add: -0.0,
    np.multiply: 1.0,
    np.minimum: np.inf,
    np.maximum: -np.inf,
    np.fmin: np.nan,
    np.fmax: np.nan,
    np.logical_and: 1.0,
    np.logical_or: 0.0,
    np.bitwise_and: 1.0,
    np.bitwise_or: 0.0,
}
BEGINNINGS = {FOLDS[function.reduce]: literal(value) for function, value in NOTHING.items()}
"""What a fold of no number is, to the last bit; of truths 1 and 0."""
OF_TRUTHS = {EACH[f] for f in (np.logical_and, np.logical_or, np.bitwise_and, np.bitwise_or)}
