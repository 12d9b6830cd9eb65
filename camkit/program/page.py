"""A program as JavaScript: a function of the inputs' numbers, in their order, that gives the outputs', in theirs.

The text holds numbers and the operations of the table, and nothing else: no name, no unit, no sentence of a design.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from .loops import Loops, Span, Step
from .program import Program

LONGEST = 6000
"""So many characters, about, has a function at most: an engine optimises no longer one."""
LIBRARY = """const M=Math,
fmin=(a,b)=>a!==a?b:b!==b?a:M.min(a,b),
fmax=(a,b)=>a!==a?b:b!==b?a:M.max(a,b),
mod=(a,b)=>{const r=a%b;return r!==0&&(r<0)!==(b<0)?r+b:r},
div=(a,b)=>{if(b===0)return a/b;const m=a%b,d=(a-m)/b-+(m!==0&&(m<0)!==(b<0)),f=M.floor(d);return d-f>0.5?f+1:f},
pow=(a,b)=>a===1||b===0||a===-1&&M.abs(b)===Infinity?1:M.pow(a,b),
copysign=(a,b)=>b<0||Object.is(b,-0)?-M.abs(a):M.abs(a),
rint=a=>{const f=M.floor(a),d=a-f;return d<0.5||d===0.5&&f%2===0?f:f+1},
argmax=(at,n,out)=>{let k=0;for(let j=1;j<n&&H[at+k]===H[at+k];j++){const x=H[at+j];if(x>H[at+k]||x!==x)k=j}H[out]=k},
accumulate=(at,n,out)=>{let sum=0;for(let j=0;j<n;j++)H[out+j]=sum+=H[at+j]},
sorted=(at,n,out)=>{for(let j=0;j<n;j++)H[out+j]=H[at+j];H.subarray(out,out+n).sort()},
pick=(at,n,out,place)=>{const k=H[place];H[out]=H[at+(k<0?k+n:k)]};
"""
"""What the operations of the table need."""


def javascript(program: Program) -> str:
    """An expression whose value is the function: from an array of numbers to an array of arrays of numbers.

    >>> from camkit.program import recorded
    >>> text = javascript(recorded(lambda given: {"double": 2 * given["x"]}, {"x": 1.0}))
    >>> print(text[text.index("function f0"):])
    function f0(){H[1]=2.0*H[0];}
    return X=>{H.set(X);f0();return [H.slice(1,2)]}})()
    """
    loops = Loops(program)
    functions = list(_functions([_text(group) for group in loops.groups]))
    lines = [
        f"(()=>{{{LIBRARY}const H=new Float64Array({loops.size});",
        *(f"H.set([{','.join(map(_number, values))}],{at});" for at, values in loops.constants.items()),
        *(f"function f{k}(){{{text}}}" for k, text in enumerate(functions)),
    ]
    slices = ",".join(f"H.slice({at[0]},{at[-1] + 1})" if at.size else "[]" for at in loops.outputs)
    calls = "".join(f"f{k}();" for k in range(len(functions)))
    return "\n".join([*lines, f"return X=>{{H.set(X);{calls}return [{slices}]}}}})()"])


def _functions(texts: Sequence[list[str]]) -> Iterator[str]:
    """Statements put together to bodies of functions."""
    body = ""
    for statement in (statement for text in texts for statement in text):
        if body and len(body) + len(statement) > LONGEST:
            yield body
            body = ""
        body += statement
    if body:
        yield body


def _text(group: Sequence[Step]) -> list[str]:
    """The statements of steps that go together."""
    if group[0].count > 1:
        return [_loop(group)]
    return [f"H[{step.out}]={_said(step, {})};" if step.count else step.code for step in group]


def _loop(group: Sequence[Step]) -> str:
    """One loop for all steps of a group; what only they read has a name and no address."""
    names: dict[Span, str] = {}
    before, within, after = "", "", ""
    for step in group:
        name = f"v{step.out}"
        if step.start is not None:
            before += f"let {name}={_number(step.start)};"
            within += f"{name}={step.code.format(name, _operand(step.operands[0], names))};"
            after += f"H[{step.out}]={name};"
            continue
        within += f"const {name}={_said(step, names)};" + (f"H[{step.out}+j]={name};" if step.stored else "")
        names[Span(step.out, 1)] = name
    return f"{{{before}for(let j=0;j<{group[0].count};j++){{{within}}}{after}}}"


def _said(step: Step, names: dict[Span, str]) -> str:
    """What a step does, for one element."""
    return step.code.format(*(_operand(operand, names) for operand in step.operands))


def _operand(operand: Span | float, names: dict[Span, str]) -> str:
    if not isinstance(operand, Span):
        return _number(operand)
    return names.get(operand) or f"H[{operand.first}{'+j' if operand.step else ''}]"


def _number(value: float) -> str:
    """A number as JavaScript reads it to the last digit."""
    if np.isfinite(value):
        return repr(float(value)) if value > 0 or not np.signbit(value) else f"({float(value)!r})"
    return "NaN" if value != value else "Infinity" if value > 0 else "(-Infinity)"
