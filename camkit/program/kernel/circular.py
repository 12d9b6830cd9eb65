"""The sine and the cosine to the last bit as numpy has them from glibc on processors with fused multiply-add.

Near a multiple of 1/128, whose sine and cosine are known to twice as many digits, short polynomials are enough; the
order of operations is that of ``sysdeps/ieee754/dbl-64/s_sin.c``, each product that is added fused with the addition.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import pi

from .words import ZERO, Truth, Value, Words, literal

PLACES = 128
"""The table has the angles 0, 1/128, ... up to 1."""
BIG, ROUNDS = 1.5 * 2.0**45, 1.5 * 2.0**52
"""Added to an angle they leave its place in the table, and whole numbers, in the last bits."""
SMALL, NEAR, FAR = map(float.fromhex, ("0x1.b6p-1", "0x1.368fdp+1", "0x1.921fbp+26"))
"""Up to the first an angle is taken as it is, up to the second its distance from half of pi; beyond the last numpy."""
TINY = 0.126
"""Sines of less need no table."""
HALF_PI = tuple(map(float.fromhex, ("0x1.921fb54442d18p+0", "0x1.1a62633145c07p-54")))
PARTS = tuple(map(float.fromhex, ("0x1.921fb58p+0", "-0x1.dde973cp-27", "-0x1.cb3b398p-55", "-0x1.d747f23e32ed7p-83")))
"""Half of pi in two parts, and in four of which three are short."""
SINE = 8.33333214285722277379541354343671e-03, -1.66666666666664880952546298448555e-01
COSINE = 1.38888874007937613028114285595617e-03, -4.16666666666664434524222570944589e-02, 0.5
NEAR_ZERO = (-2.5022014848318398e-08, 2.755729806860771e-06, -1.9841269834414642e-04,
             8.3333333333323288e-03, -1.6666666666666666e-01)  # fmt: skip
"""Polynomials, highest power first."""


def table() -> str:
    """For each place sine and its rest, cosine and its rest; after these the same of its derivative."""
    numbers = [number for k in range(PLACES) for number in _row(k)]
    words = ", ".join(literal(number).removeprefix("splat (")[:-1] for number in numbers)
    return f"@circle = private constant [{len(numbers)} x double] [{words}], align 64"


def _row(place: int) -> Iterator[float]:
    angle, term = Fraction(place, PLACES), Fraction(1)
    sums = [Fraction(0), Fraction(0)]
    for k in range(40):  # the series of the cosine and of the sine
        sums[k % 2] += term if k % 4 < 2 else -term
        term *= angle / (k + 1)
    cosine, sine = sums
    for exact in (sine, cosine, cosine, -sine):
        yield float(exact)
        yield float(exact - Fraction(float(exact)))


def circular(w: Words, cosine: bool) -> tuple[Value, Value]:
    """The sine or the cosine of ``%a``, and whether that is how it is found."""
    x = Value("%a")
    size, whole = w.called("fabs", x), w.wholes
    small, near = w.compared("olt", size, literal(SMALL)), w.compared("olt", size, literal(NEAR))
    far, far_rest, quarters = _less_quarters(w, x)
    beside, rest = w.two("fsub", literal(HALF_PI[0]), size), literal(HALF_PI[1])
    below = w.compared("olt", x, ZERO)
    at_near = w.named(f"select {w.truths} {below}, {whole} splat (i64 3), {whole} splat (i64 1)")
    if cosine:
        beside, distance = w.two("fadd", beside, rest), beside
        rest = w.two("fadd", w.two("fsub", distance, beside), rest)
        quarters, at_near = w.named(f"add {whole} {quarters}, splat (i64 1)"), Value("zeroinitializer")
    a, da = w.where(near, beside, far), w.where(near, rest, far_rest)
    n = w.named(f"select {w.truths} {near}, {whole} {at_near}, {whole} {quarters}")
    a, da = w.where(small, x, a), w.where(small, ZERO, da)
    n = w.named(f"select {w.truths} {small}, {whole} splat (i64 {int(cosine)}), {whole} {n}")
    usual = w.both("or", w.compared("ult", size, literal(FAR)), w.compared("oeq", size, literal(float("inf"))))
    return _turned(w, a, da, n), usual


def _less_quarters(w: Words, x: Value) -> tuple[Value, Value, Value]:
    """What is left of an angle without whole quarters of a turn, in two parts, and how many these are."""
    t = w.called("fma", x, literal(2 / pi), literal(ROUNDS))
    minus = w.named(f"fneg {w.numbers} {w.two('fsub', t, literal(ROUNDS))}")
    first, second, third, fourth = map(literal, PARTS)
    y = w.called("fma", minus, second, w.called("fma", minus, first, x))
    t2 = w.called("fma", minus, third, y)
    rest = w.called("fma", minus, third, w.two("fsub", y, t2))
    a = w.called("fma", minus, fourth, t2)
    last = w.called("fma", minus, fourth, w.two("fsub", t2, a))
    return a, w.two("fadd", last, rest), w.named(f"bitcast {w.numbers} {t} to {w.wholes}")


def _turned(w: Words, a: Value, da: Value, n: Value) -> Value:
    """The sine of ``a + da`` and of ``n`` quarters of a turn."""
    odd = w.named(f"trunc {w.wholes} {n} to {w.truths}", Truth)
    size = w.called("fabs", a)
    sign = _and(w, w.named(f"bitcast {w.numbers} {a} to {w.wholes}"), -(2**63))
    d = _signed(w, da, sign)
    placed = w.two("fadd", literal(BIG), size)
    x = w.two("fsub", size, w.two("fsub", placed, literal(BIG)))
    x, y = w.where(odd, w.two("fadd", x, d), x), w.where(odd, ZERO, d)
    xx = w.two("fmul", x, x)
    of_sine, of_cosine = _polynomial(w, xx, SINE), _polynomial(w, xx, COSINE)
    s = w.called("fma", w.two("fmul", x, xx), of_sine, w.where(odd, x, d))
    s = w.two("fadd", s, w.where(odd, ZERO, x))
    minus = w.named(f"fneg {w.numbers} {w.called('fma', x, y, w.two('fmul', of_cosine, xx))}")
    at = _and(w, w.named(f"bitcast {w.numbers} {placed} to {w.wholes}"), PLACES - 1)
    row = w.named(f"shl {w.wholes} {at}, splat (i64 3)")
    row = w.named(f"add {w.wholes} {row}, {_and(w, w.named(f'shl {w.wholes} {n}, splat (i64 2)'), 4)}")
    f, f_rest, slope, slope_rest = (_looked_up(w, row, k) for k in range(4))
    more = w.called("fma", s, slope, w.called("fma", minus, f, w.called("fma", s, slope_rest, f_rest)))
    z = w.two("fmul", size, size)
    near = w.called("fma", _polynomial(w, z, NEAR_ZERO), size, w.two("fmul", d, literal(-0.5)))
    near = w.two("fadd", size, w.called("fma", near, z, d))
    tiny = w.both("and", w.no(odd), w.compared("olt", size, literal(TINY)))
    found = w.where(tiny, near, w.two("fadd", f, more))
    own = w.named(f"select {w.truths} {odd}, {w.wholes} zeroinitializer, {w.wholes} {sign}")
    return _signed(w, _signed(w, found, own), w.named(f"shl {w.wholes} {_and(w, n, 2)}, splat (i64 62)"))


def _polynomial(w: Words, z: Value, coefficients: tuple[float, ...]) -> Value:
    found = literal(coefficients[0])
    for c in coefficients[1:]:
        found = w.called("fma", found, z, literal(c))
    return found


def _and(w: Words, bits: Value, mask: int) -> Value:
    return w.named(f"and {w.wholes} {bits}, splat (i64 {mask})")


def _signed(w: Words, number: Value, sign: Value) -> Value:
    """A number with its sign changed where the sign bit is set."""
    bits = w.named(f"xor {w.wholes} {w.named(f'bitcast {w.numbers} {number} to {w.wholes}')}, {sign}")
    return w.named(f"bitcast {w.wholes} {bits} to {w.numbers}")


def _looked_up(w: Words, row: Value, k: int) -> Value:
    pointers, places = f"<{w.lanes} x ptr>", w.named(f"or {w.wholes} {row}, splat (i64 {k})")
    at = w.named(f"getelementptr double, ptr @circle, {w.wholes} {places}")
    return w.named(
        f"call {w.numbers} @llvm.masked.gather.v{w.lanes}f64.v{w.lanes}p0({pointers} {at}, i32 8, "
        f"{w.truths} splat (i1 true), {w.numbers} poison)"
    )
