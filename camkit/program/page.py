"""A program as JavaScript: a function of the inputs' numbers, in their order, that gives the outputs', in theirs.

It is one text for all programs, which is made of the table, and the numbers of this one: no name, no unit, no sentence
of a design is in them.  A loop is done by a function of its own for each operation; which, and where, are numbers.
"""

from __future__ import annotations

import json

from .loops import Loops
from .operations import ALONG, EACH, operands
from .program import Program
from .record import uncollected

LIBRARY = """M=Math,H=new Float64Array(size),
fmin=(a,b)=>a!==a?b:b!==b?a:M.min(a,b),
fmax=(a,b)=>a!==a?b:b!==b?a:M.max(a,b),
mod=(a,b)=>{const r=a%b;return r!==0&&(r<0)!==(b<0)?r+b:r},
div=(a,b)=>{if(b===0)return a/b;const m=a%b,d=(a-m)/b-+(m!==0&&(m<0)!==(b<0)),f=M.floor(d);return d-f>0.5?f+1:f},
pow=(a,b)=>b===2?a*a:b===3?a*a*a:a===1||b===0||a===-1&&M.abs(b)===Infinity?1:M.pow(a,b),
copysign=(a,b)=>b<0||Object.is(b,-0)?-M.abs(a):M.abs(a),
argmax=(n,o,p,a)=>{let k=0;for(let j=1;j<n&&H[a+k]===H[a+k];j++){const x=H[a+j];if(x>H[a+k]||x!==x)k=j}H[o]=k},
sorted=(n,o,p,a)=>H.slice(a,a+n).sort().forEach((x,j)=>{H[o+j*p]=x})"""
"""What the operations of the table need; ``H`` is the heap."""
RUN = """const at=(o,a)=>a<0?~a:o-a;
H.set(Float64Array.from(constants,Number));
const every=[],moving=[];
for(let o=constants.length,k=0;k<loops.length;){
const kind=kinds[loops[k]],n=loops[k+1];
o+=loops[k+2];
const loop=[kind[0],n,o,kind[2],at(o,loops[k+3]),kind[3],at(o,loops[k+4]),kind[4],at(o,loops[k+5]),kind[5]];
every.push(...loop);
if(kind[1])moving.push(...loop);
o+=n;
k+=kind.length}
const[E,V]=[every,moving].map(l=>Int32Array.from(l)),alike=(a,at)=>{
for(let j=0;j<a.length;j++)if(!Object.is(a[j],H[at+j]))return false;
return true};
let before=[],last=[];
return X=>{
const all=!before.length||before.some((x,k)=>k<steady&&x!==X[k]),L=all?E:V;
before=Array.from(X);
H.set(X,constants.length);
for(let i=0;i<L.length;i+=10)F[L[i]](L[i+1],L[i+2],L[i+3],L[i+4],L[i+5],L[i+6],L[i+7],L[i+8],L[i+9]);
return last=outputs.map(([at,n],k)=>last[k]&&alike(last[k],at)?last[k]:H.slice(at,at+n))}"""
"""One loop after the other is done, or where the steady inputs stay, each that depends on others; what its operation
does not take it is given in vain.  An output that is as it was is the same array once more: so a page knows it."""
NAMES = "opaqbrcs"
"""What the operations' functions call addresses and steps, of the result first."""


def _function(operation: str) -> str:
    """An operation as a function of how often it is done, and of the addresses and steps of its result and operands."""
    if "{" not in operation:
        return operation
    names = NAMES[: 2 + 2 * operands(operation)]
    steps = ",".join(f"{at}+={step}" for at, step in zip(names[::2], names[1::2], strict=True))
    said = operation.format(*(f"H[{at}]" for at in names[2::2]))
    return f"({','.join('n' + names)})=>{{for(;n>0;n--,{steps})H[o]={said}}}"


OPERATIONS = dict.fromkeys([*EACH.values(), *(name for name, _ in ALONG.values())])
NUMBERED = {operation: number for number, operation in enumerate(OPERATIONS)}
MACHINE = "(size,constants,outputs,steady,kinds,loops)=>{{const {},\nF=[{}];\n{}}}".format(
    LIBRARY, ",\n".join(map(_function, OPERATIONS)), RUN
)
"""A function that makes of the numbers of any program its function: from an array of numbers to an array of arrays."""


@uncollected()
def numbers(program: Program, steady: int = 0) -> str:
    """What `MACHINE` takes, as JSON; constants are words, which can be infinite or no number.

    Where the first ``steady`` inputs, one number each, stay as they are, only what depends on the others is done.

    >>> from camkit.program import recorded
    >>> numbers(recorded(lambda given: {"double": 2 * given["x"]}, {"x": 1.5}))
    '[3,["2.0"],[[2,1]],0,[[2,1,0,0,0]],[0,1,1,-1,-2]]'
    """
    loops = Loops(program, steady)
    constants = [repr(value).replace("inf", "Infinity").replace("nan", "NaN") for value in loops.constants.tolist()]
    return json.dumps((loops.size, constants, loops.outputs, steady, *_table(loops)), separators=(",", ":"))


def _table(loops: Loops) -> tuple[list[tuple[int, ...]], list[int]]:
    """The kinds of loops; and of each loop its kind, how often it goes, and its addresses.

    Of its result how far it is behind the end of the one before, of operands how far they are before it; of constants
    and inputs their address with all bits turned, which is below 0.
    """
    kinds, rows, at, begin = dict[tuple[int, ...], int](), list[int](), 0, len(loops.constants)
    for operation, times, ((result, step), *others), moving in loops.loops:
        kind = (NUMBERED[operation], int(moving), step, *(step for _, step in others))
        rows += [kinds.setdefault(kind, len(kinds)), times, result - at]
        rows += [result - first if first >= loops.inputs else ~(begin + first) for first, _ in others]
        at = result + times
    return list(kinds), rows
