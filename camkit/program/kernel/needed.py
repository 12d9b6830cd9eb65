"""What a program needs for some designs alone: what only a ``where`` takes that seldom asks for it.

Tops of curves are such: they are looked at closely where they are in doubt, which most designs are nowhere.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import takewhile

import numpy as np

from ..program import Program, numbers_in
from ..record import Recorded

Reason = frozenset[tuple[int, bool]]
"""Conditions by number, and how one of them has to be anywhere."""
Reasons = tuple[Reason, ...]
"""All of them have to be there; where there is none, it is always needed."""
FEW = 4
"""A condition of so few numbers is one of its own; others choose number by number."""
WORTH = 1000
"""So many numbers at least are left out together."""


def reasons(program: Program, moving: Sequence[int]) -> dict[int, Reasons]:
    """For which reasons each of the ``moving`` calls is needed, if not always."""
    moves, found = set(moving), dict[int, Reasons]()
    for out in program.outputs.values():
        if isinstance(out, Recorded):
            found[out.number] = ()
    for k in reversed(moving):
        call = program.calls[k]
        for n in set(numbers_in(call.arguments)) & moves:
            own = _asked(call, program.calls[n], moves)
            reason = _known(found[k] + ((own,) if own else ()), n)
            found[n] = _either(found[n], reason) if n in found else reason
    worth = Counter[Reasons]()
    for k in moving:
        for end in range(1, len(found[k]) + 1):
            worth[found[k][:end]] += program.calls[k].size
    return {k: _worthwhile(each, worth) for k, each in found.items()}


def _asked(call: Recorded, given: Recorded, moves: set[int]) -> Reason:
    """When a call asks for what it is given, if it does so for some designs alone."""
    if call.function is not np.where:
        return frozenset()
    condition, *ways = call.arguments
    if not isinstance(condition, Recorded) or condition.number not in moves:
        return frozenset()
    if ways[0] is ways[1] or (condition.size > FEW and given.size >= condition.size):
        return frozenset()
    return frozenset({(condition.number, ways[0] is given)})


def _known(each: Reasons, call: int) -> Reasons:
    """Those reasons that are known before a call."""
    return tuple(takewhile(lambda reason: all(number < call for number, _ in reason), each))


def _either(one: Reasons, other: Reasons) -> Reasons:
    """What is needed for one of two reasons."""
    n = next((k for k, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))
    same = one[:n]
    return (*same, one[n] | other[n]) if len(one) == len(other) == n + 1 else same


def _worthwhile(each: Reasons, worth: Counter[Reasons]) -> Reasons:
    """Those reasons, from the first, for which enough is left out."""
    while each and worth[each] < WORTH:
        each = each[:-1]
    return each
