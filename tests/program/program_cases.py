"""What programs are tried on: every row of the table at awkward numbers, and expressions made at random."""

import operator
from itertools import product

import numpy as np

from camkit.program.operations import ALONG, EACH, FOLDS, MOVES, operands
from camkit.program.written import BY, picked, whole
from camkit.quantities import Paths, quantities_of

AWKWARD = [
    np.nan,
    np.inf,
    -np.inf,
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1.5,
    2.5,
    -2.5,
    3.0,
    1e-9,
    1e9,
]
"""Numbers at which functions are not what they are elsewhere; halves, which are rounded to even, and ordinary ones."""
ONE = np.array(AWKWARD)
PAIRS = np.array(list(product(AWKWARD, AWKWARD)))
ROWS = np.array([[a, b, 1.5, b] for a, b in product(AWKWARD, AWKWARD)])
ORDINARY = np.random.default_rng(5).normal(size=(4, 7))
TRUTHS = {
    np.bitwise_and,
    np.bitwise_or,
    np.invert,
    np.bitwise_and.reduce,
    np.bitwise_or.reduce,
}
"""What is asked of truths only."""
SPECIAL = {
    np.where: lambda x, y: np.where(x > y, x, y),
    np.argmax: lambda m: np.argmax(m, axis=-1),
    np.add.accumulate: lambda m: np.add.accumulate(m, axis=-1),
    np.sort: lambda m: np.sort(m, axis=-1),
    np.take: lambda m: np.take(m, np.argmax(m[:, 1:], axis=-1) - 2, axis=-1),
    picked: lambda m: np.take_along_axis(m, np.argmax(m, axis=0, keepdims=True) - 1, 0),
    np.take_along_axis: lambda m: np.take_along_axis(m, np.argmax(m, axis=-1, keepdims=True) - 1, -1),
    whole: lambda x: np.where(np.isfinite(x), x, 0.0).astype(int),
    operator.getitem: lambda m: m[1:, None, ::-2],
    np.broadcast_to: lambda x: np.broadcast_to(x, (3, *x.shape)),
    np.stack: lambda x: np.stack([x, 2 * x, np.zeros(x.shape)], axis=-1),
    np.concatenate: lambda m: np.concatenate([m, np.ones(m.shape), -m], axis=-1),
    np.expand_dims: lambda x: np.expand_dims(x, 0),
    np.squeeze: lambda x: np.squeeze(x[None]),
    np.reshape: lambda m: np.reshape(m, (-1, 2)),
    np.ravel: np.ravel,
    np.transpose: np.transpose,
    np.moveaxis: lambda m: np.moveaxis(m, 0, -1),
    np.swapaxes: lambda m: np.swapaxes(m, 0, 1),
    np.repeat: lambda x: np.repeat(x, 3),
    np.tile: lambda x: np.tile(x, 2),
    np.roll: lambda m: np.roll(m, -1, axis=-1),
    np.flip: lambda m: np.flip(m, axis=-1),
    np.vstack: lambda x: np.vstack([x, -x]),
    np.hstack: lambda x: np.hstack([x, -x]),
    np.column_stack: lambda x: np.column_stack([x, -x]),
    np.atleast_1d: np.atleast_1d,
    np.atleast_2d: np.atleast_2d,
    np.copy: np.copy,
    np.append: lambda x: np.append(x, x[:2]),
    np.diagonal: np.diagonal,
    np.broadcast_arrays: lambda x: np.broadcast_arrays(x, x[:, None])[1],
    np.argmin: lambda m: np.argmin(m, axis=-1, keepdims=True),
    np.clip: lambda x: np.clip(x, -1.0, 2.0),
    np.diff: lambda m: np.diff(m, axis=-1),
    np.trapezoid: lambda m: np.trapezoid(m, m**2),
    np.unwrap: lambda m: np.unwrap(3 * m),
    np.select: lambda x: np.select([x > 1, x > 0], [x, 2 * x], -1.0),
    np.interp: lambda x: np.interp(x, [-1.0, 0.5, 2.0], [3.0, 1.0, 7.0]),
    np.cross: lambda m: np.cross(m[:3], m[1:4] ** 2, axis=0),
    np.linalg.norm: lambda m: np.linalg.norm(m, axis=0),
    np.zeros_like: lambda x: x + np.zeros_like(x),
    np.ones_like: lambda x: x + np.ones_like(x),
    np.full_like: lambda x: x + np.full_like(x, 2.0),
}
OF_ROWS = {np.argmax, np.argmin, np.add.accumulate, np.sort, np.take_along_axis}
OF_ORDINARY = {
    picked,
    np.take,
    operator.getitem,
    np.concatenate,
    np.reshape,
    np.transpose,
    np.moveaxis,
    np.swapaxes,
    np.roll,
    np.flip,
} | {*(np.diagonal, np.diff, np.trapezoid, np.unwrap, np.cross, np.linalg.norm)}


def case(function):
    """A use of a function of the table, and the arrays that it takes."""
    use = SPECIAL.get(function)
    if use and function is not np.where:
        arrays = [ROWS if function in OF_ROWS else ORDINARY if function in OF_ORDINARY else ONE]
    elif function in EACH:
        use, arrays = use or function, [ONE] if operands(EACH[function]) == 1 else list(PAIRS.T)
    else:
        use, arrays = (lambda m: function(m, axis=-1)), [ROWS]
    if function in TRUTHS:
        return (lambda *given: use(*(values > 0 for values in given))), arrays
    return use, arrays


FUNCTIONS = [*EACH, *FOLDS, *ALONG, *sorted(MOVES, key=lambda f: f.__name__), *BY]
CASES = {f"{i:03d} {getattr(f, '__qualname__', f)}": case(f) for i, f in enumerate(FUNCTIONS)}
CASES["a sum along an axis of one number"] = (lambda x: np.sum(x[:, None], axis=-1), [ONE])


def expression(seed):
    """A function of a number, a row and a table, put together at random."""
    rng = np.random.default_rng(seed)
    steps = [(rng.integers(len(STEPS)), rng.integers(0, 1000, 3)) for _ in range(rng.integers(3, 16))]

    def value(x, y, z):
        found = [x, y, z]
        for step, places in steps:
            found.append(STEPS[step](*(found[place % len(found)] for place in places)))
        return np.stack(np.broadcast_arrays(*(_last_row(each) for each in found[-3:])))

    return value


def _last_row(values):
    return values.sum(0) if values.ndim == 2 else values


STEPS = (
    lambda a, b, c: a + b,
    lambda a, b, c: a - b,
    lambda a, b, c: a * b,
    lambda a, b, c: a / b,
    lambda a, b, c: 2.5 - a,
    lambda a, b, c: a**2 + b**3 - c**0.5,
    lambda a, b, c: np.sin(a) * np.cos(b),
    lambda a, b, c: np.arctan2(a, b),
    lambda a, b, c: np.hypot(a, b),
    lambda a, b, c: np.where(a > b, a, c),
    lambda a, b, c: np.where((a > 0) & ~(b >= c) | np.isnan(a), 1.0, a),
    lambda a, b, c: np.minimum(a, b),
    lambda a, b, c: np.maximum(abs(a), b),
    lambda a, b, c: np.mod(a, 3.0) + b // 2,
    lambda a, b, c: np.clip(a, -1, 1),
    lambda a, b, c: a - np.max(b),
    lambda a, b, c: a + np.sum(b, axis=-1, keepdims=True) if b.ndim else a,
    lambda a, b, c: np.roll(a, 1, axis=-1) if a.ndim else a,
    lambda a, b, c: a[..., ::-1] if a.ndim else a,
    lambda a, b, c: np.concatenate([a[..., 3:], a[..., :3]], axis=-1) if a.ndim else a,
    lambda a, b, c: np.cumsum(a, axis=-1) if a.ndim else a,
    lambda a, b, c: np.take_along_axis(a, np.argmax(a, axis=-1, keepdims=True), -1) + b if a.ndim else b,
    lambda a, b, c: np.take(a, np.argmin(np.ravel(b), keepdims=True) % a.shape[-1], axis=-1) * 0.5 if a.ndim else a,
    lambda a, b, c: np.append(a[1:], 2 * a[:1]) if a.ndim == 1 else b,
)
INPUTS = {
    "x": np.float64(0.7),
    "y": np.array([0.3, -1.2, 2.0, 0.0, 5.5]),
    "z": np.arange(15.0).reshape(3, 5) / 4 - 1,
}


def judged(study, p):
    """What the study says of a design or of ``p``."""

    def function(design):
        found = study.judge(np.empty((p, 0)), design.analyse(study.angles))
        return {"f": found.f, "g": found.g}

    return function


def designs_beside(design, p, seed):
    """Values by path for ``p`` designs: some numbers from anywhere in the range of their declarations."""
    rng, declared = np.random.default_rng(seed), quantities_of(design)
    low, high = (np.array([getattr(q, end) * q.factor for q in declared.values()]) for end in ("low", "high"))
    start = np.array(list(start_of(design).values()))
    values = np.where(rng.random((p, len(low))) < 0.4, rng.uniform(low, high, (p, len(low))), start)
    return {path: values[:, i : i + 1].copy() for i, path in enumerate(declared)}


def start_of(design):
    paths = quantities_of(design)
    return dict(zip(paths, Paths(design, paths).values(design), strict=True))
