"""Steady motion of an elastic train behind a cam that turns evenly: a Fourier series, by one transform of s and q.

With the deviation ``z = s - x`` a train of one mass has

    Z_n = [(k_s - m n^2 omega^2 + i n omega c_s) S_n + Q_n] / D_n
    D_n = k_f + k_s - m n^2 omega^2 + i n omega (c_f + c_s)

and the force ``T_n = (k_f + i n omega c_f) Z_n``; chains and springs with surge follow in the same way (see
`camkit.dynamics.trains`).  With 720 samples the force is right to 1e-6 of its peak for motions whose acceleration is
continuous, and to 2e-4 where it jumps.

Source: Norton, Cam Design and Manufacturing Handbook (dynamics of cam systems); Koster, Vibrations of Cam Mechanisms.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..extrema import raised
from ..motion.closing import TURN
from ..quantities import certain, counted, unless
from ..quantities.kinds import a_number, refuse_unequal
from ..quantities.types import Array, Value
from ..units import in_unit
from .driven import Analysed, Driven, bottom, driven, top, top_with_corners
from .trains import Passed, Train, natural_modes, passed

LEAST, ALONE, MOST = 720, 11520, 46080
"""Samples of a turn without asking: of several designs or speeds at least, of one at one speed at least, at most."""
PER_PERIOD = 20
"""Samples of a natural period, at least."""
AT_RESONANCE = 1e-9
"""Nearer to resonance than this, over the static stiffness, an undamped train has no steady motion."""
FASTEST = 1e9
"""A speed (rad/s) above this is a slip."""


def respond(
    train: Train, analysis: Analysed, speed: Value | None = None, samples: int | None = None, least: int | None = None
) -> Response:
    """See `Train.follow`; ``least`` are samples that there are at least, of several designs and of one."""
    turns = None if speed is None else a_speed(speed)
    refuse_unequal({"cam": getattr(analysis, "cam", None), "train": train, "speed": turns}, "elastic follower")
    if samples is not None:
        count = counted(samples, "samples of a turn", 8, MOST)
        return response_of(train, driven(analysis, count + count % 2), turns)
    begin = least or LEAST
    found = response_of(train, driven(analysis, begin), turns)
    alone = least is None and found.train_force.ndim == 1
    count = max(enough(found.natural_frequency, found.speed), ALONE if alone else begin)
    return found if count == begin else response_of(train, driven(analysis, count), turns)


def a_speed(speed: Value) -> Value:
    """A speed of the cam, rad/s; ``ValueError`` for what is none."""
    must = f"be a finite number above 0 and at most {FASTEST:g} rad/s"
    return a_number(speed, "the speed of the cam", must, lambda w: (w > 0) & (w <= FASTEST))


def enough(frequency: Value, speed: Value) -> int:
    """How many samples of a turn show the natural frequency; ``ValueError`` where that would be too many for one."""
    ratios = np.atleast_1d(frequency)[..., None] / speed
    ratio = np.nanmax(ratios, initial=0.0)
    count = LEAST * 2 ** max(0, int(np.ceil(np.log2(max(PER_PERIOD * ratio, 1) / LEAST))))
    if count > MOST and ratios.size > 1:
        return MOST
    if count > MOST:
        raise ValueError(
            f"the natural frequency of the train is {ratio:.6g} times the speed of the cam; it can be at most "
            f"{MOST // PER_PERIOD} times: a slower cam moves the train as if it stood still"
        )
    return count


def response_of(train: Train, given: Driven, speed: Value | None) -> Response:
    """The response to what drives a train, at the cam's own speed or another; what cannot be is refused."""
    _refuse_mass(train, given)
    turns = given.speed if speed is None else np.atleast_1d(speed)
    if refuse := unless(np.all(turns > 0) if turns.ndim == 1 else turns > 0):
        refuse("the cam is at rest; for steady motion its speed must be above 0 rpm")
    response = Response(train, given, np.where(turns > 0, turns, np.nan))
    response.refuse_resonance()
    return response


def _refuse_mass(train: Train, given: Driven) -> None:
    """``ValueError`` in a sentence for one load that has no mass left for the end of the train."""
    rest = last_mass(train, given)
    if refuse := unless(np.all(rest > 0) if rest.ndim == 1 else rest > 0):
        parts = float((given.mass - rest)[0])
        refuse(
            f"the load has a mass of {float(given.mass[0]):.6g} and the train's parts before its end {parts:.6g} "
            "(kg, of an arm kg m^2); the load must have more"
        )


def last_mass(train: Train, given: Driven) -> Array:
    """``m``: what the train's parts leave of the load's mass, ``(1,)`` or ``(p, 1)``."""
    return given.mass - train.cam_side_mass - sum(train.masses)


def grounded(train: Train, given: Driven) -> Array:
    """``c_s``: damping of the last mass to the frame, the train's and the load's."""
    return given.damping + train.ground_damping


@dataclass(frozen=True)
class Response:
    """Steady motion of a `Train` at even cam angles, ``(n,)``, or ``(p, n)`` of a population or of ``p`` speeds.

    Numbers are one or ``(p,)``.  A motion in which ``least_force`` is below 0 is formal: the follower leaves the cam
    (see `camkit.dynamics.simulate`).
    """

    train: Train
    driven: Driven = field(repr=False)
    speed: Array
    """Of the cam, rad/s, ``(1,)`` or ``(p, 1)``."""

    @property
    def cam_angle(self) -> Array:
        """Even, from 0 to below 360 deg, rad."""
        return self.driven.cam_angle

    # ---------------------------------------------------------------- by harmonics

    @cached_property
    def _frequency(self) -> Array:
        """``n omega``."""
        return np.arange(len(self.cam_angle) // 2 + 1) * self.speed

    @cached_property
    def _lift(self) -> Array:
        return np.fft.rfft(self.driven.travel)

    @cached_property
    def _passed(self) -> Passed:
        given = self.driven
        mass = last_mass(self.train, given)
        load = np.fft.rfft(given.load)
        return passed(
            self.train,
            np.where(mass > 0, mass, np.nan),
            given.rate,
            grounded(self.train, given),
            self._frequency,
            load,
            self._lift,
        )

    def _in_time(self, series: Array) -> Array:
        values = np.fft.irfft(series, len(self.cam_angle))
        return values if self._hit is None else np.where(self._hit.any(-1, keepdims=True), np.nan, values)

    @cached_property
    def _hit(self) -> Array | None:
        """Which harmonics that are there are at resonance; ``None`` where every spring has a damper."""
        dampers = [c for _, c in self.train.springs]
        if all(certain(c > 0) for c in dampers):
            return None
        stiffness = self.train.springs[0][0] + self.driven.rate
        size = np.maximum(stiffness * abs(self._lift), abs(np.fft.rfft(self.driven.load)))
        there = size > AT_RESONANCE * size.max(-1, keepdims=True)
        return (abs(self._passed.whole) < AT_RESONANCE * stiffness) & there

    def refuse_resonance(self) -> None:
        """``ValueError`` in a sentence if an undamped train is at resonance with a harmonic that is there."""
        if self._hit is not None and self._hit.ndim == 1 and self._hit.any():
            raise ValueError(
                f"harmonic {int(np.argmax(self._hit))} of motion or load is at resonance with the undamped train at "
                f"{in_unit(float(self.speed[0]), 'rpm'):.6g} rpm; give the train some damping or the cam another speed"
            )

    @property
    def harmonics(self) -> Array:
        """Amplitudes ``2 |S_n| / samples`` of the lift, m or rad, by number ``n``; that of 0 is twice the mean."""
        return 2 * abs(self._lift) / len(self.cam_angle)

    # ---------------------------------------------------------------- over the turn

    @cached_property
    def _dynamic(self) -> Array:
        """``T``: the train's force less ``N_0``."""
        return self._in_time(self._passed.force)

    @cached_property
    def train_force(self) -> Array:
        """``N_0 + T``: with which the first spring and its damper press, N or N m; 0 where it is slack."""
        return self.driven.preload + self._dynamic

    @cached_property
    def _steepness(self) -> Array:
        """``dT/dphi``."""
        order = np.arange(len(self.cam_angle) // 2 + 1)
        return self._in_time(1j * order * (order < order[-1]) * self._passed.force)

    def train_force_at(self, cam_angle: Array) -> Array:
        """The `train_force` at any cam angles (rad), ``(k,)`` or ``(p, k)``: cubics between the even ones."""
        n = len(self.cam_angle)
        step, (low, x) = TURN / n, _step_of(cam_angle, n)
        high = (low + 1) % n
        (T0, T1), (v0, v1) = (
            [_placed(values, at) for at in (low, high)] for values in (self._dynamic, self._steepness)
        )
        bent, back = 3 * (T1 - T0) - step * (2 * v0 + v1), 2 * (T0 - T1) + step * (v0 + v1)
        return self.driven.preload + T0 + x * (step * v0 + x * (bent + x * back))

    @cached_property
    def position(self) -> Array:
        """``x``: of the last mass, from its assembled rest, m or rad."""
        return self._in_time(self._passed.end)

    @cached_property
    def acceleration(self) -> Array:
        """``x''``: of the last mass by time, m/s^2 or rad/s^2, from the forces on it."""
        return self._in_time(-(self._frequency**2) * self._passed.end)

    @cached_property
    def resistance(self) -> Array:
        """``N = N_0 + T + m_0 omega^2 w``: what the cam has to overcome along the travel, N or N m."""
        return self.train_force + self.train.cam_side_mass * self.speed**2 * self.driven.acceleration

    @cached_property
    def rigid_resistance(self) -> Array:
        """The same of a rigid train, ``N_0 + k_s s + q + (m + m_0) omega^2 w``, and the damping of the load."""
        given = self.driven
        static = given.preload + given.rate * given.travel + given.load
        return static + given.mass * self.speed**2 * given.acceleration + given.damping * self.speed * given.velocity

    @cached_property
    def contact_force(self) -> Array:
        """Between cam and follower along the contact normal, N."""
        return self.resistance / self.driven.lever

    @property
    def rigid_contact_force(self) -> Array:
        """The same of a rigid train, the damping of the load with it."""
        return self.rigid_resistance / self.driven.lever

    @cached_property
    def cam_torque(self) -> Array:
        """``N v``: on the cam without friction, N m."""
        return self.resistance * self.driven.velocity

    # ---------------------------------------------------------------- numbers

    @cached_property
    def _modes(self) -> tuple[Array, Array]:
        return natural_modes(
            self.train, last_mass(self.train, self.driven), self.driven.rate, grounded(self.train, self.driven)
        )

    @property
    def natural_frequencies(self) -> Array:
        """Of the train with its end on the cam, the lowest first, rad/s: ``(k,)`` or ``(p, k)``."""
        return self._modes[0]

    @property
    def natural_frequency(self) -> Value:
        """``omega_n``: the lowest of them, rad/s; of one mass ``sqrt((k_f + k_s) / m)``."""
        return self._modes[0][..., 0]

    @property
    def damping_ratio(self) -> Value:
        """``zeta`` of the lowest mode; of one mass ``(c_f + c_s) / (2 sqrt(m (k_f + k_s)))``."""
        return self.damping_ratios[..., 0]

    @property
    def damping_ratios(self) -> Array:
        """Of all modes, the lowest first: ``(k,)`` or ``(p, k)``."""
        return self._modes[1]

    @property
    def max_force(self) -> Value:
        """The largest contact force, N."""
        return top(self.contact_force)

    @property
    def least_force(self) -> Value:
        """The least contact force, N; below 0 the follower leaves the cam, and this motion is formal."""
        return bottom(self.contact_force)

    @property
    def contact_margin(self) -> Value:
        """The least of ``N`` over ``N_0``: what is left of the force at rest; ``nan`` where there is none."""
        return bottom(self.resistance / self.held)

    @property
    def held(self) -> Array:
        """``N_0`` where it presses, ``nan`` where not, ``(1,)`` or ``(p, 1)``."""
        return np.where(self.driven.preload > 0, self.driven.preload, np.nan)

    @property
    def dynamic_factor(self) -> Value:
        """``K_d``: the largest contact force over that of a rigid train, wherever in the turn either stands."""
        return self.max_force / top_with_corners(self.rigid_contact_force)

    @property
    def stiffness_spread(self) -> tuple[Value, Value]:
        """The least and the largest ``lever^2`` over its mean: how a stiffness along the contact normal would change.

        What a cam or a roller gives acts along the normal, so that the arm feels it times ``lever^2``.  The train's
        stiffness is constant: give it the mean over the turn, and see here how far that is off.
        """
        square = np.square(self.driven.lever + 0.0 * self.cam_angle)
        mean = square.mean(-1)
        return bottom(square) / mean, top(square) / mean

    @property
    def max_acceleration(self) -> Value:
        """The largest acceleration of the last mass, m/s^2 or rad/s^2."""
        return top(self.acceleration)

    @property
    def rest(self) -> Array:
        """Where the last mass would stand if the cam stood still, ``(k_f s - q) / (k_f + k_s)``, m or rad."""
        return self._rest(self.driven.travel, self.driven.load)

    def _rest(self, travel: Array, load: Array) -> Array:
        k = self.train.static_stiffness
        return (k * travel - load) / (k + self.driven.rate)

    @property
    def dwell_vibration(self) -> Array:
        """The largest ``|x - rest|`` in each dwell, m or rad, the dwells last; empty where there is none."""
        away, given = abs(self.position - self.rest), self.driven
        found = [
            np.maximum(_within(self.cam_angle, away, *dwell), self._near(*margin))
            for dwell, margin in zip(given.dwells, given.margins, strict=True)
        ]
        return np.stack(found, axis=-1) if found else np.zeros((*away.shape[:-1], 0))

    def _near(self, cam_angle: Array, travel: Array, load: Array) -> Array:
        """The largest where a dwell begins and ends."""
        away: Array = abs(_between(self.position, cam_angle) - self._rest(travel, load)).max(-1)
        return away


def _step_of(cam_angle: Array, n: int) -> tuple[Array, Array]:
    """Which of ``n`` even steps of a turn a cam angle (rad) is in, and what share of it lies before the angle."""
    share = np.mod(cam_angle, TURN) * n / TURN
    low = np.where(np.isfinite(share), np.minimum(np.floor(share), n - 1), 0).astype(int)
    return low, share - low


def _between(values: Array, cam_angle: Array) -> Array:
    """Values at even cam angles of a turn at others (rad), by the cubic through the four around."""
    n = values.shape[-1]
    low, x = _step_of(cam_angle, n)
    far, left, right, away = (_placed(values, (low + k) % n) for k in (-1, 0, 1, 2))
    middle = (1 + x) * (2 - x) * ((1 - x) * left + x * right) / 2
    return middle - x * (1 - x) * ((2 - x) * far + (1 + x) * away) / 6


def _placed(values: Array, at: Array) -> Array:
    """Of values ``(n,)`` or ``(p, n)`` those at places ``(k,)`` or ``(p, k)``."""
    if values.ndim == 1 or at.ndim == 1:
        return values[..., at]
    rows = np.broadcast_shapes(values.shape[:-1], at.shape[:-1])
    every, places = np.broadcast_to(values, (*rows, values.shape[-1])), np.broadcast_to(at, (*rows, at.shape[-1]))
    return np.take_along_axis(every, places, axis=-1)


def _within(angle: Array, values: Array, start: Array, end: Array) -> Array:
    """The largest of ``values`` in a dwell, with the tops of parabolas whose three samples are all in it."""
    hair = 1e-9
    inside = np.atleast_1d((angle >= start - hair) & (angle <= end + hair))
    some = np.flatnonzero(np.atleast_2d(inside).any(0))
    if not len(some):
        return np.zeros(values.shape[:-1])
    here = slice(some[0], some[-1] + 1)
    mine = np.broadcast_to(inside, values.shape)[..., here]
    held = np.where(mine, values[..., here], 0.0)
    deep = mine & np.roll(mine, 1, axis=-1) & np.roll(mine, -1, axis=-1)
    return np.max(np.where(deep, raised(held, True), held), axis=-1)
