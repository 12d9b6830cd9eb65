"""What the operations of a kernel need: functions of LLVM in which one branch for rare numbers is worth a call."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from .circular import circular, table
from .words import BY_NUMPY, Value, Words, literal

NAMES = [str(function.__name__) for function in BY_NUMPY]
WHOLE = 2.0**52
"""Larger numbers have no fraction."""


def library(lanes: int, own: bool) -> str:
    """All of it, for vectors of so many lanes; sine and cosine of its ``own`` or numpy's."""
    remainder = _guarded("remainder", ("a", "b"), lanes, _remainder)
    return "\n".join((circle(lanes, own), _by_numpy(lanes, 2), remainder, _picked(lanes), _sorted(lanes)))


def circle(lanes: int, own: bool) -> str:
    """Sine and cosine."""
    if own:
        ways = {"sin": False, "cos": True}
        each = (_guarded(name, ("a",), lanes, partial(circular, cosine=way)) for name, way in ways.items())
        return "\n".join((table(), _by_numpy(lanes, 1), *each))
    return "\n".join((_by_numpy(lanes, 1), _numpys("sin", lanes), _numpys("cos", lanes)))


def _numpys(name: str, lanes: int) -> str:
    w = Words(lanes)
    w.line(f"ret {w.numbers} {w.by_numpy(NAMES.index(name), Value('%a'))}")
    return "\n".join((f"define internal fastcc {w.numbers} @{name}(ptr %N, {w.numbers} %a) #1 {{", *w.lines, "}"))


def _guarded(name: str, takes: tuple[str, ...], lanes: int, body: Callable[[Words], tuple[Value, Value]]) -> str:
    """A function with a quick way for numbers that are as usual in all lanes, and numpy's for others."""
    w = Words(lanes)
    found, usual = body(w)
    given = [Value(f"%{a}") for a in takes]
    all_usual = w.named(f"call i1 @llvm.vector.reduce.and.v{lanes}i1({w.truths} {usual})")
    w.line(f"br i1 {all_usual}, label %quick, label %rare")
    w.lines.append("quick:")
    w.line(f"ret {w.numbers} {found}")
    w.lines.append("rare:")
    w.line(f"ret {w.numbers} {w.by_numpy(NAMES.index(name), *given)}")
    head = f"define internal fastcc {w.numbers} @{name}(ptr %N, {', '.join(f'{w.numbers} {g}' for g in given)}) #1 {{"
    return "\n".join((head, *w.lines, "}"))


def _fused(w: Words, a: Value, b: Value, c: Value) -> Value:
    return w.called("fma", a, b, c)


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
