"""A kernel as the text of LLVM: for a few designs side by side one group of loops after the other."""

from __future__ import annotations

from ..loops import COPY, Span
from .fused import PICKED, Fused, Group, Step
from .library import library
from .rows import POWER
from .words import BEGINNINGS, OF_TRUTHS, ONE, WORDS, ZERO, Truth, Value, Words, literal

MANY = """define void @kernel(ptr %S, ptr %H, ptr %N, ptr %X, ptr %O, i64 %p, i64 %begin, i64 %end) #0 {{
entry:
  br label %loop
loop:
  %at = phi i64 [%begin, %entry], [%next, %loop]
  %x = getelementptr double, ptr %X, i64 %at
  %o = getelementptr double, ptr %O, i64 %at
  call void @block(ptr %S, ptr %H, ptr %N, ptr %x, ptr %o, i64 %p)
  %next = add i64 %at, {lanes}
  %more = icmp slt i64 %next, %end
  br i1 %more, label %loop, label %done
done:
  ret void
}}
attributes #0 = {{ nounwind {width} }}
attributes #1 = {{ nounwind noinline {width} }}
"""


def text(fused: Fused, moving: int, lanes: int, own: bool) -> str:
    """All of a kernel, for programs with so many inputs that move, in vectors of so many ``lanes``.

    Sine and cosine are those of the library, if it may have its ``own``.
    ``kernel(S, H, N, X, O, p, begin, end)``: steady numbers, the heap, numpy's loops (see `by_numpy`), inputs
    ``(moving, p)``, outputs ``(n, p)``, and which designs.
    """
    return "\n".join((library(lanes, own), _Block(fused, lanes).text(moving), many(lanes)))


def many(lanes: int) -> str:
    """What goes from one ``block`` of designs to the next."""
    width = f'"min-legal-vector-width"="{64 * lanes}" "prefer-vector-width"="{64 * lanes}"'
    return MANY.format(lanes=lanes, width=width)


class _Block(Words):
    """What is done to a few designs side by side."""

    def __init__(self, fused: Fused, lanes: int) -> None:
        super().__init__(lanes)
        self._fused, self._steady, self._constants = fused, fused.steady, len(fused.loops.constants)
        self._here: dict[Span, Value] = {}
        """What is known in this round of a group: by the place where it would stand."""
        self._turn: Value | None = None

    def text(self, moving: int) -> str:
        """The whole function."""
        for k in range(moving):
            self._put(self._of(k, "%X"), (self._steady + k, 0))
        for number, group in enumerate(self._fused.groups):
            self._done(number, group)
        for k, at in enumerate(self._fused.outputs):
            if at >= self._steady:
                value = self.number(self._taken((at, 0)))
                self.line(f"store {self.numbers} {value}, ptr {self._row(k, '%O')}, align 8")
        self.line("ret void")
        takes = "ptr noalias %S, ptr noalias %H, ptr noalias %N, ptr noalias %X, ptr noalias %O, i64 %p"
        return "\n".join((f"define internal void @block({takes}) #1 {{", "entry:", *self.lines, "}"))

    def _row(self, k: int, base: str) -> Value:
        return self.named(f"getelementptr double, ptr {base}, i64 {self.named(f'mul i64 %p, {k}')}")

    def _of(self, k: int, base: str) -> Value:
        return self.named(f"load {self.numbers}, ptr {self._row(k, base)}, align 8")

    def _done(self, number: int, group: Group) -> None:
        """A group, if one of the designs side by side needs it."""
        self._here, self._turn = {}, None
        if group.needed is None:
            self._all(number, group)
            return
        needed = self.is_true(self._loaded(group.needed))
        some = self.named(f"call i1 @llvm.vector.reduce.or.v{self.lanes}i1({self.truths} {needed})")
        self.line(f"br i1 {some}, label %needed{number}, label %done{number}")
        self.lines.append(f"needed{number}:")
        self._all(number, group)
        self.line(f"br label %done{number}")
        self.lines.append(f"done{number}:")

    def _all(self, number: int, group: Group) -> None:
        """All steps of a group."""
        self._here = {}
        if group.alone:
            self._alone(number, group.steps[0])
        elif group.times == 1:
            for step in group.steps:
                self._made(step)
        else:
            self._loop(number, group)
        self._here, self._turn = {}, None

    def _loop(self, number: int, group: Group) -> None:
        """Every step of a group, so many times; folds go from one turn to the next."""
        before = {id(s): self._begin(s) for s in group.steps if s.fold}
        self.line(f"br label %before{number}")
        self.lines.append(f"before{number}:")
        self.line(f"br label %loop{number}")
        self.lines.append(f"loop{number}:")
        self._turn = Value(f"%j{number}")
        self.line(f"{self._turn} = phi i64 [0, %before{number}], [%next{number}, %loop{number}]")
        heads = len(self.lines)
        folded = list[tuple[tuple[Value, ...], tuple[Value, ...], tuple[Value, ...]]]()
        for step in group.steps:
            starts = before.get(id(step), ())
            names = tuple(type(start)(f"%f{number}_{len(folded)}_{k}") for k, start in enumerate(starts))
            ends = self._made(step, names)
            folded += [(names, starts, ends)] if step.fold else []
        self.lines[heads:heads] = [
            f"  {name} = phi {self.kind(name)} [{start}, %before{number}], [{end}, %loop{number}]"
            for each in folded
            for name, start, end in zip(*each, strict=True)
        ]
        self.line(f"%next{number} = add nuw nsw i64 {self._turn}, 1")
        self.line(f"%more{number} = icmp ult i64 %next{number}, {group.times}")
        self.line(f"br i1 %more{number}, label %loop{number}, label %after{number}")
        self.lines.append(f"after{number}:")
        self._turn = None
        for step, (_, _, ends) in zip((s for s in group.steps if s.fold), folded, strict=True):
            self._put(ends[-1], (step.result[0], 0))

    def _begin(self, step: Step) -> tuple[Value, ...]:
        """What a fold begins with; the place of the largest with the largest so far and its place."""
        if step.operation == "argmax":
            return literal(float("-inf")), literal(0.0)
        if not step.begins:
            start = self._loaded(step.operands[0][0])
            return (self.is_true(start),) if step.operation in OF_TRUTHS else (start,)
        start = BEGINNINGS[step.operation]
        if step.operation in OF_TRUTHS:
            start = Truth("splat (i1 true)" if start == literal(1.0) else "zeroinitializer")
        return (start,)

    def _made(self, step: Step, before: tuple[Value, ...] = ()) -> tuple[Value, ...]:
        """One turn of a step: what it makes."""
        if step.operation == "argmax" and before:
            return self._place_of_the_largest(step, *before)
        if step.fold:
            value = WORDS[step.operation](self, before[0], self._taken(step.operands[-1]))
            return (self.is_true(value) if before[0].truth else self.number(value),)
        value = self._result(step)
        self._here[self._key(step.result)] = value
        if step.stored:
            self._put(value, step.result)
        return (value,)

    def _result(self, step: Step) -> Value:
        if step.operation == COPY:
            return self._taken(step.operands[0])
        if step.operation == PICKED:
            return self._picked(step)
        if step.operation == "argmax":  # of one number
            return ZERO
        operands = [self._taken(span) for span in step.operands]
        if step.operation == POWER and step.operands[1][0] < 0 and not step.operands[1][1]:
            exponent = self._fused.value(step.operands[1][0])
            if exponent in (0, 1):
                return operands[0] if exponent else ONE
        return WORDS[step.operation](self, *operands)

    def _place_of_the_largest(self, step: Step, best: Value, place: Value) -> tuple[Value, Value]:
        value = self.number(self._taken(step.operands[-1]))
        more = self.both("or", self.compared("ogt", value, best), self.compared("uno", value, value))
        better = self.both("and", more, self.compared("ord", best, best))
        here = self._everywhere(self.named(f"sitofp i64 {self._turn} to double"))
        return self.where(better, value, best), self.where(better, here, place)

    def _picked(self, step: Step) -> Value:
        row, (place, size) = step.operands[0], map(self._taken, step.operands[1:])
        steady = row[0] < self._steady
        base, (apart, aside) = self._pointer(row), (1, 0) if steady else (self.lanes, 1)
        return self.named(
            f"call fastcc {self.numbers} @picked(ptr {base}, i64 {apart}, i64 {aside}, "
            f"{self.numbers} {self.number(place)}, {self.numbers} {size})"
        )

    def _alone(self, number: int, step: Step) -> None:
        """A step that reads what it has made, or goes through its row more than once: place by place."""
        group = Group(step.times, False, [Step(COPY, step.times, step.result, step.operands, False, stored=True)])
        self._loop(number, group if step.operation == "sorted" else Group(step.times, False, [step]))
        if step.operation == "sorted":
            row = self._pointer((step.result[0], 0))
            self.line(f"call fastcc void @sorted(ptr {row}, i64 {step.times}, i64 {8 * self.lanes * step.result[1]})")

    def _key(self, span: Span) -> Span:
        return span if self._turn else (span[0], 0)

    def _taken(self, span: Span) -> Value:
        """An operand: known here, or from where it stands."""
        known = self._here.get(self._key(span))
        if known is None:
            known = self._here[self._key(span)] = self._loaded(*span)
        return known

    def _loaded(self, first: int, step: int = 0) -> Value:
        if first < 0 and not (step and self._turn):
            return literal(self._fused.value(first))
        pointer = self._pointer((first, step))
        if first >= self._steady:
            return self.named(f"load {self.numbers}, ptr {pointer}, align {8 * self.lanes}")
        return self._everywhere(self.named(f"load double, ptr {pointer}"))

    def _everywhere(self, number: Value) -> Value:
        one = self.named(f"insertelement {self.numbers} poison, double {number}, i64 0")
        zeros = f"<{self.lanes} x i32> zeroinitializer"
        return self.named(f"shufflevector {self.numbers} {one}, {self.numbers} poison, {zeros}")

    def _pointer(self, span: Span) -> Value:
        first, step = span
        moves = first >= self._steady
        base, size = ("%H", self.lanes) if moves else ("%S", 1)
        at = int(self._fused.places[first]) * size if moves else first + self._constants
        pointer = self.named(f"getelementptr double, ptr {base}, i64 {at}")
        if not (step and self._turn):
            return pointer
        on = self.named(f"mul i64 {self._turn}, {step * size}")
        return self.named(f"getelementptr double, ptr {pointer}, i64 {on}")

    def _put(self, value: Value, span: Span) -> None:
        """Note a value where it stands."""
        number = self.number(value)
        self.line(f"store {self.numbers} {number}, ptr {self._pointer(span)}, align {8 * self.lanes}")
