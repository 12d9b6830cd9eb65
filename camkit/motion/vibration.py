"""How a motion law shakes a follower that is one mass on a spring: the classical reason to choose a law.

The cam moves one end of a spring after the law ``s(u)``, the mass on the other end follows with ``x(u)``:

    x'' + 2 zeta W (x' - s') + W^2 (x - s) = 0,   W = 2 pi tau,   tau = rise time / natural period

so a slow cam has a large ``tau``.  The deviation ``z = x - s`` is the convolution of the velocity with the
derivative of the impulse response,

    z(u) = -Re [c y(u)],   y(u) = int_0^u s'(t) e^{m (u - t)} dt,   m = -zeta W + i W sqrt(1 - zeta^2),
    c = 1 + i zeta / sqrt(1 - zeta^2)

taken by Gauss's rule between the law's kinks, exact to rounding.  After the rise ``z`` rings on as ``e^{m t}``.
A motion program is followed in the same way, from rest to its end.

Source: Norton, Cam Design and Manufacturing Handbook (dynamics of cam systems); Koster, Vibrations of Cam Mechanisms.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..quantities.kinds import a_number, numbers, shown
from ..quantities.types import Array, Value
from .law import Kinematics, Law
from .program import MotionProgram

GAUSS = np.polynomial.legendre.leggauss(5)
LARGEST = 1e4
"""A rise of more natural periods is not followed: it takes many steps, and leaves nothing to see."""
LARGEST_ALONE = 500.0
"""The same where every design of a population has a ratio of its own."""
PHASES = np.exp(2j * np.pi * np.arange(32) / 32)
LEAST, PER_PERIOD = 24, 48
"""Panels of the integration: at least in each smooth piece of the law, and in a natural period."""


class Vibration(NamedTuple):
    """How far the mass strays from the law, for a rise of 1 over a time of 1; all of the shape of ``tau``.

    Of a motion program: in the follower's unit (m or rad), over a time of 1 for its whole span.
    """

    residual: Array
    """Largest deviation after the rise, a share of the lift."""
    during: Value
    """Largest deviation during the rise, a share of the lift."""
    acceleration: Array
    """Largest acceleration of the mass during and after the rise, in the unit of ``Ca``."""


@dataclass(frozen=True)
class _Whole:
    """A program run once, over a time of 1 for its span."""

    program: MotionProgram

    @property
    def kinks(self) -> tuple[Value, ...]:
        program = self.program
        parts = zip(program.starts[:-1], program.segments, strict=True)
        inner = [(start, *(start + u * segment.angle for u in segment.kinks)) for start, segment in parts]
        return tuple(angle / program.span for part in inner for angle in part)[1:]

    def __call__(self, u: Value) -> Kinematics:
        s, v, a, j = self.program(u * self.program.span)
        span = self.program.span
        return Kinematics(s, v * span, a * span**2, j * span**3)


def residual_vibration(law: Law | MotionProgram, tau: Value, damping: float = 0.0) -> Vibration:
    """Vibration of a follower that is one mass on a spring, at each ``tau`` ``(r,)`` (or one number).

    A rise over the angle ``beta`` at the shaft's ``omega`` has ``tau = (beta / omega) (omega_n / 2 pi)``.
    Of a motion program ``tau`` is the time of its whole span over the natural period; it is run once, from rest, and
    ``residual`` is what still swings when it is over.

    ``damping`` is the ratio ``zeta`` to critical damping, at least 0 and below 1.  A population of ``p`` laws gives
    ``(p, r)``.  ``during`` and ``acceleration`` are looked for at 48 instants of a natural period or more; their
    error is below 0.3 %, that of ``residual`` is rounding.

    >>> from camkit.motion import Cycloidal, SimpleHarmonic
    >>> [round(float(residual_vibration(law, 3.5).residual), 6) for law in (SimpleHarmonic(), Cycloidal())]
    [0.0, 0.008084]

    >>> from camkit.motion import Rise
    >>> rise = MotionProgram((Rise(2.0, 0.02, Cycloidal()),))  # 20 mm: in metres what is a share of the lift above
    >>> round(float(residual_vibration(rise, 3.5).residual), 8)
    0.00016168

    Raises ``ValueError`` for what is neither a law nor a program, a ``tau`` that is not above 0, a damping ratio out
    of its range.
    """
    if not isinstance(law, Law | MotionProgram):
        raise ValueError(f"residual vibration is that of a motion law or of a motion program, not of {shown(law)}")
    motion = law if isinstance(law, Law) else _Whole(law)
    ratio = _ratios(tau)
    share = a_number(damping, "the damping ratio", "be at least 0 and below 1", lambda z: (z >= 0) & (z < 1))
    if np.ndim(share):
        raise ValueError("the damping ratio is a column; it must be one number")
    damping = float(share)
    W = 2 * np.pi * ratio[:, None]
    m, c = _root(W, damping), 1 + 1j * damping / np.sqrt(1 - damping**2)
    panels = _panels(motion, float(ratio.max()))
    y = _convolved(motion, panels, m)
    z, end = -(c * y).real, -c * y[..., -1:]
    relative = -(c * (motion(panels).v[..., None, :] + m * y)).real
    pull = abs(W**2 * z + 2 * damping * W * relative).max(-1)
    after = _ringing((W**2 + 2 * damping * W * m) * end, m)
    parts = _ringing(end, m), abs(z).max(-1), np.maximum(pull, after)
    return Vibration(*(part if np.ndim(tau) else part[..., 0] for part in parts))


def left_swinging(program: MotionProgram, tau: Value, damping: float = 0.0) -> Array:
    """How a mass swings on after a motion that was run once from rest, at 32 phases: ``(32,)`` or ``(p, 32)``.

    Their largest is the ``residual`` of `residual_vibration`, in the follower's unit (m or rad).  Each of ``p`` designs
    may have a ``tau`` of its own, ``(p, 1)``; ``nan`` where it is not above 0 or beyond `LARGEST_ALONE`.

    >>> from camkit.motion import Cycloidal, Rise
    >>> rise = MotionProgram((Rise(2.0, 0.02, Cycloidal()),))
    >>> round(float(left_swinging(rise, 3.5).max()), 8)
    0.00016168
    """
    motion, ratio = _Whole(program), np.atleast_1d(tau)
    ratio = np.where((ratio > 0) & (ratio <= LARGEST_ALONE), ratio, np.nan)
    m, (x, weight) = _root(2 * np.pi * ratio, damping), GAUSS
    panels = _panels(motion, float(np.nanmax(ratio, initial=0.0)))
    width = np.diff(panels, axis=-1)[..., None]
    at = panels[..., :-1, None] + width * (x + 1) / 2
    v = motion(at.reshape(*at.shape[:-2], -1)).v
    v = v.reshape(*v.shape[:-1], *at.shape[-2:])
    y = (weight / 2 * width * v * np.exp(m[..., None] * (1 - at))).sum((-2, -1))
    end = -(1 + 1j * damping / np.sqrt(1 - damping**2)) * np.expand_dims(y, -1)
    with np.errstate(invalid="ignore"):  # a ratio that is none
        most, phases = np.expand_dims(_ringing(end, m), -1), (end * PHASES).real
    return np.minimum(np.where(phases >= phases.max(-1, keepdims=True), np.inf, phases), most)


def _ratios(tau: object) -> np.ndarray:
    """The period ratios in a row, ``(r,)``; ``ValueError`` for what they cannot be."""
    ratio = np.atleast_1d(numbers(tau, "the period ratios tau"))
    if not (np.isfinite(ratio).all() and (ratio > 0).all()):
        raise ValueError("the period ratio tau holds a value that is not a finite number above 0; it must be that")
    if ratio.ndim > 1 or not ratio.size:
        raise ValueError(f"the period ratios tau are {shown(tau)}; they must be numbers in a row")
    if ratio.max() > LARGEST:
        raise ValueError(f"the period ratio tau is {ratio.max():.6g}; it must be at most {LARGEST:.6g}")
    return ratio


def _root(W: Value, damping: float) -> Array:
    """``m``: the free vibration goes as ``e^{m t}``."""
    return W * (-damping + 1j * np.sqrt(1 - damping**2))


def _panels(law: Law | _Whole, tau: float) -> Array:
    """Ends of the panels of integration from 0 to 1: no kink inside any, none longer than a part of a period."""
    edges = np.broadcast_arrays(*(np.atleast_1d(edge) for edge in (0.0, *law.kinks, 1.0)))
    pieces = []
    for low, high in pairwise(edges):
        count = LEAST + int(np.ceil(PER_PERIOD * tau * np.nanmax(high - low)))
        pieces.append(low + (high - low) * np.arange(count) / count)
    return np.concatenate([*pieces, edges[-1]], axis=-1)


def _convolved(law: Law | _Whole, panels: Array, m: Array) -> Array:
    """``y`` at the end of each panel, ``(..., r, k + 1)``, for the roots ``m`` ``(r, 1)``."""
    x, weight = GAUSS
    width = np.diff(panels, axis=-1)
    at = panels[..., :-1, None] + width[..., None] * (x + 1) / 2
    v = law(at.reshape(*at.shape[:-2], -1)).v.reshape(at.shape)
    fading = np.exp(m[..., None] * (width[..., None] * (1 - x) / 2)[..., None, :, :])
    inside = (weight / 2 * width[..., None] * v)[..., None, :, :] * fading
    step = inside.sum(-1)
    carried = np.exp(m * width[..., None, :])
    y = np.zeros((*step.shape[:-1], step.shape[-1] + 1), dtype=complex)
    for k in range(step.shape[-1]):
        y[..., k + 1] = carried[..., k] * y[..., k] + step[..., k]
    return y


def _ringing(amplitude: Array, m: Array) -> Array:
    """The largest ``|Re(amplitude e^{m t})|`` over ``t >= 0``: at once, or where its slope first vanishes."""
    turn = (np.pi / 2 - np.angle(amplitude * m)) % np.pi
    later = amplitude * np.exp(m * turn / m.imag)
    return np.maximum(abs(amplitude.real), abs(later.real))[..., 0]
