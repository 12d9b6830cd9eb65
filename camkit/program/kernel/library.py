"""What the operations of a kernel need: functions of LLVM in which one branch for rare numbers is worth a call."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .words import BY_NUMPY, Value, Words, literal

SMALL = 2.0**19
"""Angles up to this are reduced by three parts of half of pi; others numpy sees to."""
HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
SINE = (1.58962301576546568060e-10, -2.50507477628578072866e-8, 2.75573136213857245213e-6,
        -1.98412698295885395996e-4, 8.33333333332211858878e-3, -1.66666666666666307295e-1)  # fmt: skip
COSINE = (-1.13585365213876817300e-11, 2.08757008419747316778e-9, -2.75573141792967388112e-7,
          2.48015872888517045348e-5, -1.38888888888730564116e-3, 4.16666666666665929218e-2)  # fmt: skip
"""The polynomials of the sine and the cosine up to a quarter of pi (Cephes, ``sin.c``), highest power first."""
WHOLE = 2.0**52
"""Larger numbers have no fraction."""


def library(lanes: int) -> str:
    """All of it, for vectors of so many lanes."""
    return "\n".join(
        (
            _by_numpy(lanes, 1),
            _by_numpy(lanes, 2),
            _guarded("sin", ("a",), lanes, lambda w: _circular(w, False)),
            _guarded("cos", ("a",), lanes, lambda w: _circular(w, True)),
            _guarded("remainder", ("a", "b"), lanes, _remainder),
            _picked(lanes),
            _sorted(lanes),
        )
    )


def _guarded(name: str, takes: tuple[str, ...], lanes: int, body: Callable[[Words], tuple[Value, Value]]) -> str:
    """A function with a quick way for numbers that are as usual in all lanes, and numpy's for others."""
    w = Words(lanes)
    found, usual = body(w)
    place = [str(function.__name__) for function in BY_NUMPY].index(name)
    given = [Value(f"%{a}") for a in takes]
    all_usual = w.named(f"call i1 @llvm.vector.reduce.and.v{lanes}i1({w.truths} {usual})")
    w.line(f"br i1 {all_usual}, label %quick, label %rare")
    w.lines.append("quick:")
    w.line(f"ret {w.numbers} {found}")
    w.lines.append("rare:")
    w.line(f"ret {w.numbers} {w.by_numpy(place, *given)}")
    head = f"define internal fastcc {w.numbers} @{name}(ptr %N, {', '.join(f'{w.numbers} {g}' for g in given)}) #1 {{"
    return "\n".join((head, *w.lines, "}"))


def _fused(w: Words, a: Value, b: Value, c: Value) -> Value:
    return w.called("fma", a, b, c)


def _polynomial(w: Words, z: Value, coefficients: tuple[float, ...]) -> Value:
    found = literal(coefficients[0])
    for c in coefficients[1:]:
        found = _fused(w, found, z, literal(c))
    return found


def _circular(w: Words, cosine: bool) -> tuple[Value, Value]:
    """The sine or the cosine: of what is left of whole quarters of a turn, by how many there are."""
    a, quarter = Value("%a"), literal(0.25)
    q = w.called("rint", w.two("fmul", a, literal(2 / np.pi)))
    r, minus = a, w.named(f"fneg {w.numbers} {q}")
    for part in HALF_PI:
        r = _fused(w, minus, literal(part), r)
    z = w.two("fmul", r, r)
    sine = _fused(w, w.two("fmul", r, z), _polynomial(w, z, SINE), r)
    half = _fused(w, z, literal(-0.5), literal(1.0))
    cos = _fused(w, w.two("fmul", z, z), _polynomial(w, z, COSINE), half)
    turns = w.two("fmul", q, literal(0.5))
    odd = w.compared("une", w.called("floor", turns), turns)
    value = w.where(odd, sine, cos) if cosine else w.where(odd, cos, sine)
    place = w.two("fmul", w.two("fadd", q, literal(1.0)) if cosine else q, quarter)
    below = w.compared("oge", w.two("fsub", place, w.called("floor", place)), literal(0.5))
    found = w.where(below, w.named(f"fneg {w.numbers} {value}"), value)
    return found, w.compared("ult", w.called("fabs", a), literal(SMALL))


def _remainder(w: Words) -> tuple[Value, Value]:
    """``a`` less a whole number of ``b``, exactly, with the sign of ``b``."""
    a, b, zero = Value("%a"), Value("%b"), literal(0.0)
    q = w.called("trunc", w.two("fdiv", a, b))
    r = _fused(w, w.named(f"fneg {w.numbers} {q}"), b, a)
    other = w.both("xor", w.compared("olt", r, zero), w.compared("olt", b, zero))
    none = w.compared("oeq", r, zero)
    found = w.where(none, w.called("copysign", zero, b), w.where(other, w.two("fadd", r, b), r))
    usual = w.compared("ult", w.called("fabs", q), literal(WHOLE))
    return found, w.both("and", usual, w.compared("ult", w.called("fabs", b), literal(float("inf"))))


def _by_numpy(lanes: int, takes: int) -> str:
    """A call of one of numpy's loops (``PyUFuncGenericFunction``), whose address and data stand in the table ``N``."""
    numbers, size = f"<{lanes} x double>", 8 * lanes
    given = ", ".join(f"{numbers} %x{k}" for k in range(takes))
    arrays = [f"  %a{k} = alloca {numbers}, align 64\n" for k in range(takes + 1)]
    stores = [f"  store {numbers} %x{k}, ptr %a{k}, align {size}\n" for k in range(takes)]
    places = [
        f"  %p{k} = getelementptr ptr, ptr %args, i64 {k}\n  store ptr %a{k}, ptr %p{k}\n"
        f"  %s{k} = getelementptr i64, ptr %steps, i64 {k}\n  store i64 8, ptr %s{k}\n"
        for k in range(takes + 1)
    ]
    return (
        f"define internal fastcc {numbers} @numpy{takes}(ptr %N, i64 %k, {given}) #1 {{\n"
        "  %args = alloca [3 x ptr]\n  %steps = alloca [3 x i64]\n  %n = alloca i64\n"
        f"{''.join(arrays + stores + places)}"
        f"  store i64 {lanes}, ptr %n\n"
        "  %at = getelementptr ptr, ptr %N, i64 %k\n  %loop = load ptr, ptr %at\n"
        "  %beside = getelementptr ptr, ptr %at, i64 1\n  %data = load ptr, ptr %beside\n"
        "  call void %loop(ptr %args, ptr %n, ptr %steps, ptr %data)\n"
        f"  %y = load {numbers}, ptr %a{takes}, align {size}\n  ret {numbers} %y\n}}"
    )


def _picked(lanes: int) -> str:
    """Of each lane what stands at its own place of a row of ``size``; from its end if the place is below 0."""
    w = Words(lanes)
    whole = f"<{lanes} x i64>"
    place = Value("%place")
    behind = w.where(w.compared("olt", place, literal(0.0)), Value("%size"), literal(0.0))
    at = w.two("fadd", place, behind)
    last = w.two("fsub", Value("%size"), literal(1.0))
    at = w.where(w.compared("olt", at, last), at, last)
    at = w.where(w.compared("ogt", at, literal(0.0)), at, literal(0.0))
    places = w.named(f"fptosi {w.numbers} {at} to {whole}")
    found = Value("poison")
    for lane in range(lanes):
        i = w.named(f"extractelement {whole} {places}, i64 {lane}")
        i = w.named(f"mul i64 {i}, %apart")
        i = w.named(f"add i64 {i}, {'%aside' if lane == 1 else w.named(f'mul i64 %aside, {lane}')}")
        x = w.named(f"load double, ptr {w.named(f'getelementptr double, ptr %row, i64 {i}')}")
        found = w.named(f"insertelement {w.numbers} {found}, double {x}, i64 {lane}")
    w.line(f"ret {w.numbers} {found}")
    takes = f"ptr %row, i64 %apart, i64 %aside, {w.numbers} %place, {w.numbers} %size"
    return "\n".join((f"define internal fastcc {w.numbers} @picked({takes}) #1 {{", *w.lines, "}"))


def _sorted(lanes: int) -> str:
    """Sort ``n`` vectors, a lane each for itself, that stand so many bytes apart; what is no number comes last."""
    numbers, truths = f"<{lanes} x double>", f"<{lanes} x i1>"
    return f"""define internal fastcc void @sorted(ptr %row, i64 %n, i64 %apart) #1 {{
entry:
  %last = sub i64 %n, 1
  %any = icmp sgt i64 %last, 0
  br i1 %any, label %round, label %done
round:
  %k = phi i64 [0, %entry], [%k1, %next]
  br label %pair
pair:
  %i = phi i64 [0, %round], [%i1, %pair]
  %at = mul i64 %i, %apart
  %p = getelementptr i8, ptr %row, i64 %at
  %q = getelementptr i8, ptr %p, i64 %apart
  %a = load {numbers}, ptr %p, align 8
  %b = load {numbers}, ptr %q, align 8
  %above = fcmp ugt {numbers} %a, %b
  %known = fcmp ord {numbers} %b, %b
  %swap = and {truths} %above, %known
  %low = select {truths} %swap, {numbers} %b, {numbers} %a
  %high = select {truths} %swap, {numbers} %a, {numbers} %b
  store {numbers} %low, ptr %p, align 8
  store {numbers} %high, ptr %q, align 8
  %i1 = add i64 %i, 1
  %more = icmp slt i64 %i1, %last
  br i1 %more, label %pair, label %next
next:
  %k1 = add i64 %k, 1
  %again = icmp slt i64 %k1, %last
  br i1 %again, label %round, label %done
done:
  ret void
}}"""
