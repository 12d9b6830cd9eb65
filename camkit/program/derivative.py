"""Derivatives of a program, exactly: beside each number goes its slope (forward mode), in a program again.

Of what has a kink the slope is that of the branch taken, of what has steps it is 0.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from ..quantities.known import known
from ..quantities.types import Array
from .operations import ALONG, FOLDS, MOVES
from .program import Program, numbers_in, recorded
from .record import Recorded, cannot, mapped, name_of
from .written import Axis, picked

Slopes = Sequence[Array | None]
"""Of each operand its slope; ``None`` where nothing depends on what moves."""
Rule = Callable[..., Array | None]
"""The slope of a result: by the result, the operands and their slopes, and by the axis of what goes along one."""


def derivative(program: Program, inputs: Sequence[str]) -> Program:
    """The program, and how each output ``y`` changes along a direction: the output ``"d y"``.

    The direction has a number for each of some ``inputs``: it is the input ``"d x"`` beside ``x``.  A slope is no
    number where its output is none; texts and refusals are left out.

    >>> area = recorded(lambda size: {"area": size["width"] * size["height"]}, {"width": 2.0, "height": 3.0})
    >>> told = derivative(area, ["width"])({"width": 4.0, "height": 5.0, "d width": 1.0})
    >>> {name: float(value) for name, value in told.items()}
    {'area': 20.0, 'd area': 5.0}

    Raises ``ValueError`` for a name that is no input; `CannotRecord` for an operation that has no slope.
    """
    if unknown := [name for name in inputs if name not in program.inputs]:
        raise ValueError(f"the program has no input {unknown[0]}; it has {', '.join(program.inputs)}")
    given = {name: call.result(()) for name, call in zip(program.inputs, program.calls, strict=False)}
    ways = {f"d {name}": np.zeros_like(given[name]) for name in inputs}
    return recorded(partial(_both, program.of_numbers), given | ways)


def _both(program: Program, given: dict[str, Array]) -> dict[str, object]:
    """Outputs and their slopes."""
    values = {k: given[name] for k, name in enumerate(program.inputs)}
    slopes = {k: given[f"d {name}"] for k, name in enumerate(program.inputs) if f"d {name}" in given}
    for k in program.needed:
        call = program.calls[k]
        arguments = mapped(lambda x: values[x.number] if isinstance(x, Recorded) else x, call.arguments)
        values[k] = _again(values[0], call, *arguments)
        slope = _slope(call, values[k], arguments, slopes) if call.dtype.kind == "f" else None
        if slope is not None:
            slopes[k] = slope if np.shape(slope) == call.shape else np.broadcast_to(slope, call.shape)
    found: dict[str, object] = {}
    for name, out in program.outputs.items():
        number = _number(out)
        y, slope = values.get(number, out), slopes.get(number, np.zeros(()))
        found |= {str(name): y, f"d {name}": np.where(np.isnan(y), np.nan, slope)}
    return found


def _again(of: object, call: Recorded, *arguments: object) -> Array:
    """A call once more, where ``of`` is recorded."""
    assert isinstance(of, Recorded)
    return of.recording.call(call.function, *arguments, **call.named)


def _slope(call: Recorded, y: Array, arguments: Sequence[Array], slopes: Mapping[int, Array]) -> Array | None:
    """How the result of a call changes, ``None`` if it does not; ``arguments`` are those of the new program."""
    if slopes.keys().isdisjoint(numbers_in(call.arguments)):
        return None
    first, *others = call.arguments
    if call.function in MOVES:
        return _again(y, call, mapped(lambda x: _or_zeros(slopes, x), first), *others)
    if call.function not in SLOPES:
        raise cannot(f"{name_of(call.function)} has no slope")
    if call.function in FOLDS or call.function in ALONG:
        axis = {"axis": others[0]} if others else {}
        return SLOPES[call.function](y, arguments[:1], [_or_zeros(slopes, first)], **axis, **call.named)
    return SLOPES[call.function](y, arguments, [slopes.get(n) for n in map(_number, call.arguments)])


def _number(x: object) -> int:
    return x.number if isinstance(x, Recorded) else -1


def _or_zeros(slopes: Mapping[int, Array], x: object) -> Array:
    """The slope of something, 0 where it has none."""
    return slopes.get(_number(x), np.zeros(x.shape if isinstance(x, (Recorded, np.ndarray)) else ()))


def _sum(first: Array, *others: Array) -> Array:
    return sum(others, first)


def _by(*shares: Callable[..., Array] | float) -> Rule:
    """The slope of a function with these derivatives, each by one operand: numbers, or functions of all operands."""

    def slope(y: Array, x: Sequence[Array], slopes: Slopes) -> Array | None:
        terms = ((s(y, *x) if callable(s) else s, d) for s, d in zip(shares, slopes, strict=True) if d is not None)
        return _sum(*(d if isinstance(s, float) and s == 1 else s * d for s, d in terms))

    return slope


def _steep(*shares: Callable[..., Array]) -> Rule:
    """The same where a derivative can be infinite: what does not move has no slope there either."""

    def slope(y: Array, x: Sequence[Array], slopes: Slopes) -> Array | None:
        terms = ((s(y, *x), d) for s, d in zip(shares, slopes, strict=True) if d is not None)
        return _sum(*(np.where(d == 0, 0.0, s * d) for s, d in terms))

    return slope


def _chosen(first: Callable[..., Array]) -> Rule:
    """The slope of the first of two operands where a condition holds, else of the second."""

    def slope(y: Array, x: Sequence[Array], slopes: Slopes) -> Array | None:
        a, b = (0.0 if d is None else d for d in slopes[-2:])
        return None if slopes[-2] is slopes[-1] is None else np.where(first(*x), a, b)

    return slope


def _quotient(y: Array, x: Sequence[Array], slopes: Slopes) -> Array | None:
    da, db = slopes
    less = None if db is None else y * db
    return (da if less is None else -less if da is None else da - less) / x[1]


def _flat(*_: object, **__: object) -> None:
    """What goes in steps."""


def _by_base(y: Array, a: Array, b: Array) -> Array:
    if known(b) and np.all(np.equal(b, 2)):
        return 2 * a
    return np.where(np.equal(b, 0), 0.0, b * a ** (b - 1))


def _in_rows(values: Array, axis: Axis) -> Array:
    """An array with one axis, several or all of them last, as one."""
    values = np.atleast_1d(values)
    axes = tuple(range(values.ndim)) if axis is None else axis if isinstance(axis, tuple) else (axis,)
    last = np.moveaxis(values, axes, tuple(range(-len(axes), 0)))
    return np.reshape(last, (*last.shape[: last.ndim - len(axes)], -1))


def _folded(fold: Callable[[Array, Array], Array]) -> Rule:
    """The slope of what is made of many numbers along axes, by one function of rows and their slopes."""

    def slope(y: Array, x: Sequence[Array], slopes: Sequence[Array], axis: Axis = 0, keepdims: bool = False) -> Array:
        return np.reshape(fold(_in_rows(x[0], axis), _in_rows(slopes[0], axis)), y.shape)

    return slope


def _at_largest(key: Callable[[Array], Array]) -> Rule:
    return _folded(lambda rows, slopes: np.take_along_axis(slopes, np.argmax(key(rows), -1, keepdims=True), -1))


def _product(rows: Array, slopes: Array) -> Array:
    value, slope = rows[..., 0], slopes[..., 0]
    for k in range(1, rows.shape[-1]):
        value, slope = value * rows[..., k], slope * rows[..., k] + value * slopes[..., k]
    return slope


def _in_order(rows: Array, slopes: Array) -> Array:
    """Slopes in the order of what they belong to: each stands where so many numbers come before it."""
    here, other, n = np.expand_dims(rows, -1), np.expand_dims(rows, -2), np.arange(rows.shape[-1])
    unknown, known_one = np.isnan(here), np.logical_not(np.isnan(other))
    alike = (here == other) | (unknown & np.isnan(other))
    before = (other < here) | (unknown & known_one) | (alike & (n < n[:, None]))
    place = np.sum(np.where(before, 1.0, 0.0), axis=-1)
    return np.sum(np.where(np.expand_dims(place, -1) == n, np.expand_dims(slopes, -1), 0.0), axis=-2)


def _sorted(y: Array, x: Sequence[Array], slopes: Sequence[Array], axis: int | None = -1) -> Array:
    a, d = map(np.ravel, (x[0], slopes[0])) if axis is None else (np.moveaxis(v, axis, -1) for v in (x[0], slopes[0]))
    return np.moveaxis(_in_order(a, d), -1, -1 if axis is None else axis)


SLOPES: dict[object, Rule] = {
    np.add: _by(1.0, 1.0),
    np.subtract: lambda y, x, d: d[0] if d[1] is None else -d[1] if d[0] is None else d[0] - d[1],
    np.multiply: _by(lambda y, a, b: b, lambda y, a, b: a),
    np.true_divide: _quotient,
    np.remainder: _by(1.0, lambda y, a, b: -np.floor_divide(a, b)),
    np.negative: lambda y, x, d: -d[0],
    np.positive: _by(1.0),
    np.square: _by(lambda y, a: 2 * a),
    np.reciprocal: _by(lambda y, a: -y * y),
    **dict.fromkeys((np.power, operator.pow), _steep(_by_base, lambda y, a, b: np.where(a == 0, 0.0, y * np.log(a)))),
    np.sqrt: _steep(lambda y, a: 0.5 / y),
    np.cbrt: _steep(lambda y, a: 1 / (3 * y * y)),
    np.exp: _by(lambda y, a: y),
    np.expm1: _by(lambda y, a: y + 1),
    np.log: _by(lambda y, a: 1 / a),
    np.log1p: _by(lambda y, a: 1 / (1 + a)),
    np.log2: _by(lambda y, a: 1 / (np.log(2) * a)),
    np.log10: _by(lambda y, a: 1 / (np.log(10) * a)),
    np.sin: _by(lambda y, a: np.cos(a)),
    np.cos: _by(lambda y, a: -np.sin(a)),
    np.tan: _by(lambda y, a: 1 + y * y),
    np.arcsin: _steep(lambda y, a: 1 / np.sqrt(1 - a * a)),
    np.arccos: _steep(lambda y, a: -1 / np.sqrt(1 - a * a)),
    np.arctan: _by(lambda y, a: 1 / (1 + a * a)),
    np.sinh: _by(lambda y, a: np.cosh(a)),
    np.cosh: _by(lambda y, a: np.sinh(a)),
    np.tanh: _by(lambda y, a: 1 - y * y),
    np.arcsinh: _by(lambda y, a: 1 / np.sqrt(1 + a * a)),
    np.arccosh: _steep(lambda y, a: 1 / np.sqrt(a * a - 1)),
    np.arctanh: _steep(lambda y, a: 1 / (1 - a * a)),
    np.absolute: _by(lambda y, a: np.sign(a)),
    np.arctan2: _steep(lambda y, a, b: b / (a * a + b * b), lambda y, a, b: -a / (a * a + b * b)),
    np.hypot: _steep(lambda y, a, b: a / np.where(y == 0, 1.0, y), lambda y, a, b: b / np.where(y == 0, 1.0, y)),
    np.copysign: lambda y, x, d: None if d[0] is None else np.sign(x[0]) * np.copysign(1.0, x[1]) * d[0],
    np.degrees: _by(180 / np.pi),
    np.where: _chosen(lambda condition, a, b: condition),
    np.maximum: _chosen(lambda a, b: a >= b),
    np.minimum: _chosen(lambda a, b: a <= b),
    np.fmax: _chosen(lambda a, b: (a >= b) | np.isnan(b)),
    np.fmin: _chosen(lambda a, b: (a <= b) | np.isnan(b)),
    picked: lambda y, x, d: None if d[0] is None else y.recording.call(picked, d[0], *x[1:]),
    **dict.fromkeys((np.floor_divide, np.floor, np.ceil, np.trunc, np.sign), _flat),
    np.add.reduce: lambda y, x, d, **named: y.recording.call(np.add.reduce, d[0], **named),
    np.add.accumulate: lambda y, x, d, **named: y.recording.call(np.add.accumulate, d[0], **named),
    np.multiply.reduce: _folded(_product),
    np.maximum.reduce: _at_largest(lambda rows: rows),
    np.minimum.reduce: _at_largest(lambda rows: -rows),
    np.fmax.reduce: _at_largest(lambda rows: np.where(np.isnan(rows), -np.inf, rows)),
    np.fmin.reduce: _at_largest(lambda rows: np.where(np.isnan(rows), -np.inf, -rows)),
    np.sort: _sorted,
}
"""How the result of an operation changes: by the result, the operands and how these change.  Moves move slopes too;
what gives truths or whole numbers has none."""
