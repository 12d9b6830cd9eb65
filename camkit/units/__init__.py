"""Units are plain numbers to multiply by: ``50 * mm``, ``22 * deg``, ``1800 * rpm``, ``2 * inch``.

Inside camkit everything is SI and radians.  A unit appears in two places only: where a user types a
number, and where a number is shown.  There its name may be any product of powers:

>>> round(50 * mm, 3), round(180 * deg, 6)
(0.05, 3.141593)
>>> in_unit(0.05, "mm"), in_unit(4.2e-3, "cm^2"), factor("kN*m"), convert(2, "in", "mm")
(50.0, 42.0, 1000.0, 50.8)
"""

import re
from functools import lru_cache
from math import inf, pi
from numbers import Real
from sys import float_info
from typing import Any, NamedTuple

m = 1.0
cm = 1e-2
mm = 1e-3
um = 1e-6
inch = 0.0254  # international yard and pound agreement, 1959: exact
rad = 1.0
deg = pi / 180
s = 1.0
rpm = 2 * pi / 60
kg = 1.0
N = 1.0
kN = 1e3
lbf = 4.4482216152605  # 0.45359237 kg at 9.80665 m/s^2: exact
Pa = 1.0
MPa = 1e6
GPa = 1e9
psi = lbf / inch**2
W = 1.0
kW = 1e3
percent = 1e-2


class _Unit(NamedTuple):
    """What a unit is worth in SI, and the powers of length, mass, time and angle that it is made of."""

    factor: float
    dimension: tuple[float, float, float, float]


_PREFIXES = {"n": 1e-9, "u": um, "µ": um, "μ": um, "m": mm, "c": cm, "d": 0.1, "k": 1e3, "M": 1e6, "G": 1e9}
_SI = {
    "m": _Unit(m, (1, 0, 0, 0)),
    "g": _Unit(1e-3 * kg, (0, 1, 0, 0)),
    "s": _Unit(s, (0, 0, 1, 0)),
    "rad": _Unit(rad, (0, 0, 0, 1)),
    "N": _Unit(N, (1, 1, -2, 0)),
    "J": _Unit(N * m, (2, 1, -2, 0)),
    "W": _Unit(W, (2, 1, -3, 0)),
    "Pa": _Unit(Pa, (-1, 1, -2, 0)),
    "Hz": _Unit(1 / s, (0, 0, -1, 0)),
}
"""Units that take a prefix."""
_OTHERS = {
    "%": _Unit(percent, (0, 0, 0, 0)),
    "deg": _Unit(deg, (0, 0, 0, 1)),
    "°": _Unit(deg, (0, 0, 0, 1)),
    "rpm": _Unit(rpm, (0, 0, -1, 1)),
    "min": _Unit(60 * s, (0, 0, 1, 0)),
    "in": _Unit(inch, (1, 0, 0, 0)),
    "inch": _Unit(inch, (1, 0, 0, 0)),
    "ft": _Unit(12 * inch, (1, 0, 0, 0)),
    "lb": _Unit(0.45359237 * kg, (0, 1, 0, 0)),
    "oz": _Unit(0.45359237 / 16 * kg, (0, 1, 0, 0)),
    "lbf": _Unit(lbf, (1, 1, -2, 0)),
    "psi": _Unit(psi, (-1, 1, -2, 0)),
    "hp": _Unit(550 * 12 * inch * lbf / s, (2, 1, -3, 0)),
}
_NAMES = ", ".join((*_SI, *(name for name in _OTHERS if name not in ("in", "°"))))

_LONGEST = 40
_LEAST = 1e-150
"""A unit is worth more than this in SI, and less than its reciprocal: two of them still have a product."""
_POWER = re.compile(r"([A-Za-zµμ%°]+)(?:\^([+-]?[0-9](?:\.[0-9]{1,2})?))?")
_BETWEEN = re.compile(r"\s*[*·]\s*|\s+")


def factor(unit: str) -> float:
    """The SI value of one ``unit``: a product of powers such as ``mm^2``, ``N m/rad`` or ``J/(kg m)``.

    Raises ``ValueError`` in a sentence for what is no such product.
    """
    return _unit(unit).factor


def known_units() -> dict[str, tuple[float, tuple[float, float, float, float]]]:
    """Every unit by its name: its SI value, and the powers of length, mass, time and angle that it is made of.

    >>> known_units()["kN"], known_units()["rpm"] == (rpm, (0, 0, -1, 1))
    ((1000.0, (1, 1, -2, 0)), True)
    """
    prefixed = (prefix + name for prefix in _PREFIXES for name in _SI)
    return {name: (one.factor, one.dimension) for name in (*_SI, *_OTHERS, *prefixed) if (one := _named(name))}


def in_unit(value: Any, unit: str) -> Any:
    """``value`` (SI, number or array) expressed in ``unit``, free of the last digit's noise for a number.

    Raises ``ValueError`` in a sentence for what is no such number or array: text, truths, complex numbers.
    """
    si = factor(unit)
    holds = getattr(value, "dtype", None)
    try:
        if isinstance(value, (bool, complex)) if holds is None else holds.kind not in "iuf":
            raise TypeError
        shown = value / si
    except (TypeError, OverflowError):
        raise ValueError(f"what is to be shown in {unit} is no number that a computer can hold") from None
    return float(f"{shown:.15g}") if isinstance(shown, float) else shown


def convert(value: float, unit: str, into: str) -> float:
    """``value``, which is given in ``unit``, expressed in ``into``.

    Raises ``ValueError`` in a sentence where the two measure different things, for what is no real number, and where a
    computer cannot hold the result with all its digits.  An angle is a thing of its own: ``rpm``
    goes into ``deg/s``, not into ``Hz``.
    """
    given, wanted = _unit(unit), _unit(into)
    if given.dimension != wanted.dimension:
        raise ValueError(f"{unit} cannot be converted into {into or 'a plain number'}")
    if not isinstance(value, Real) or isinstance(value, bool):
        raise ValueError(f"what is given in {unit or 'plain numbers'} is {repr(value)[:_LONGEST]}; it must be a number")
    try:
        number = float(value)
    except OverflowError:
        number = inf if value > 0 else -inf
    si = number * given.factor
    converted = in_unit(si, into)
    if 0 < abs(value) < inf and not all(float_info.min <= abs(held) < inf for held in (si, converted)):
        told = "large" if inf in (abs(si), abs(converted)) else "small"
        raise ValueError(f"{number:.15g} {unit}".rstrip() + f" is too {told} for a computer")
    return converted


def follower_unit(unit: str) -> str:
    """``unit``, if it is one of a length or of an angle; ``ValueError`` in a sentence for any other.

    >>> follower_unit("kg")
    Traceback (most recent call last):
        ...
    ValueError: the unit of the follower is 'kg'; it must be one of a length or of an angle, such as 'mm' or 'deg'
    """
    if _unit(unit).dimension not in ((1, 0, 0, 0), (0, 0, 0, 1)):
        must = "it must be one of a length or of an angle, such as 'mm' or 'deg'"
        raise ValueError(f"the unit of the follower is {unit!r}; {must}")
    return unit


def _unit(unit: str) -> _Unit:
    if not isinstance(unit, str):
        raise ValueError(f"the unit must be a text, a product of powers of {_NAMES}")
    found = _parsed(unit) if len(unit) <= _LONGEST else None
    if found is not None and not _LEAST < found.factor < 1 / _LEAST:
        raise ValueError(f"the unit {unit!r} is too large or too small for a computer in SI")
    if found is None:
        told = unit if len(unit) <= _LONGEST else f"{unit[:_LONGEST]}..."
        raise ValueError(f"the unit {told!r} is not known; it must be a product of powers, as in N/mm^2, of {_NAMES}")
    return found


@lru_cache(512)
def _parsed(unit: str) -> _Unit | None:
    """What ``unit`` is; ``None`` for what is no product of powers, or ambiguous as ``J/kg m`` is."""
    if len(f"{unit}.".splitlines()) > 1:
        return None
    above, divided, below = unit.partition("/")
    first = [] if unit == "" or above.strip() == "1" else _powers(above)
    second = _powers(below[1:-1]) if below[:1] + below[-1:] == "()" else _powers(below) if divided else []
    if first is None or second is None or (len(second) > 1 and below[0] != "("):
        return None
    every = [*first, *((one, -power) for one, power in second)]
    product = 1.0
    for one, power in every:
        product *= one.factor**power
    length, mass, time, angle = (sum(one.dimension[k] * power for one, power in every) for k in range(4))
    return _Unit(product, (length, mass, time, angle))


def _powers(product: str) -> list[tuple[_Unit, float]] | None:
    """The units of a product without a division, and their powers."""
    found = []
    for part in _BETWEEN.split(product.strip()):
        matched = _POWER.fullmatch(part)
        one = _named(matched[1]) if matched else None
        if matched is None or one is None:
            return None
        found.append((one, float(matched[2] or 1)))
    return found


def _named(name: str) -> _Unit | None:
    known = _SI.get(name) or _OTHERS.get(name)
    if known is None and name[0] in _PREFIXES and name[1:] in _SI:
        return _Unit(_PREFIXES[name[0]] * _SI[name[1:]].factor, _SI[name[1:]].dimension)
    return known
