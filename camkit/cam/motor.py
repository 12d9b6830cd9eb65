"""A cam with its motor: torque and power of a motor that turns the cam, or of one that moves the follower itself.

Through a gear with the ratio ``i`` and the efficiency ``eta`` a motor gives ``M / (i eta)`` where the cam takes the
torque ``M``, and gets ``M eta / i`` back where it drives.  A servo in place of the cam, with a rotor of the inertia
``J_m``, moves what resists with ``N`` (inertia included) along the motion ``psi``:

    T = J_m i psi'' + N / (i eta),   N eta / i where the load gives power back

By an inertia ``J`` alone its rms torque is least at ``i = sqrt(J / J_m)``.

Source: Norton, Design of Machinery (motors and flywheels); Pasch, Seering, On the Drive Systems for High-Performance
Machines (ratio of the gear).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, make_dataclass
from functools import cache
from typing import Any, ClassVar, Protocol

import numpy as np

from ..extrema import Extreme, raised
from ..quantities import Design, Measure, PeakMeasure, choice, quantity
from ..quantities.design import refuse_no_cam, with_more
from ..quantities.kinds import numbers, shown
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from .drive import Turned, cam_of, mean_size, running_integral, speed_of, turning_of
from .measures import number
from .shaking import MAKERS
from .translating_roller import TranslatingRollerCam


@dataclass(frozen=True)
class Motor(Design):
    """A motor that turns the cam evenly, through a gear; a ``flywheel`` may sit on the cam's shaft.

    >>> motor = Motor(ratio=5, efficiency=0.9)
    >>> motor.torque([9.0, -9.0]).round(3).tolist()
    [2.0, -1.62]
    """

    ratio: float = quantity("i", 5, 0.5, 200, "", "turns of the motor for one of the cam", name="gear ratio")
    efficiency: float = quantity("eta", 90, 30, 100, "%", "of the gear", at_most=100, name="gear efficiency")
    inertia: float = quantity("J_m", 1, 0.01, 50, "kg cm^2", "of the rotor", at_least=0, name="rotor inertia")
    flywheel: float = quantity("I", 0, 0, 2000, "kg cm^2", "on the shaft of the cam", at_least=0)

    name: ClassVar[str] = "turns the cam"

    def torque(self, cam_torque: Value) -> Array:
        """Of the motor, N m, for a torque ``M`` on the cam: ``M / (i eta)``, or ``M eta / i`` where the cam drives."""
        M = numbers(cam_torque, "the torque on the cam")
        return through(M, M >= 0, self.efficiency) / self.ratio

    def drives(self, analysis: Turned) -> tuple[Array, Array]:
        """Torque (N m) and speed (rad/s) of the motor along the cam of an ``analysis``."""
        torque = self.torque(analysis.cam_torque)
        return torque, self.ratio * speed_of(analysis) + 0.0 * torque

    def fluctuation(self, analysis: Turned) -> Value:
        """``(omega_max - omega_min) / omega`` of the cam with flywheel and rotor, at an even torque of the motor.

        ``inf`` without either.
        """
        inertia = number(self.flywheel + self.inertia * self.ratio**2)
        with np.errstate(divide="ignore", invalid="ignore"):
            share: Value = analysis.turning.swing / (inertia * number(speed_of(analysis)) ** 2)
        return share


@dataclass(frozen=True)
class Servo(Design):
    """A motor that moves the follower by itself along the same motion, through a gear or a screw, without a cam.

    For a sliding follower the ratio is in rad/m: ``2 pi`` over the lead of a screw.
    """

    ratio: float = quantity(
        "i", 50, 1, 1000, "", "turns of the motor for one of the arm; of a slide rad/m", name="gear ratio"
    )
    efficiency: float = quantity("eta", 90, 30, 100, "%", "of the gear", at_most=100, name="gear efficiency")
    inertia: float = quantity("J_m", 1, 0.01, 50, "kg cm^2", "of the rotor", at_least=0, name="rotor inertia")

    name: ClassVar[str] = "moves the follower"

    def torque(self, resistance: Value, velocity: Value, acceleration: Value) -> Array:
        """Of the motor, N m, for what resists the follower, inertia included (N m; N of a slide).

        ``velocity`` and ``acceleration`` are those of the follower by time, rad/s and rad/s^2 (m/s and m/s^2).

        >>> Servo(ratio=10, efficiency=0.8, inertia=1e-3).torque(4.0, 2.0, 30.0).round(9)
        np.float64(0.8)
        """
        v, a = numbers(velocity, "the velocity"), numbers(acceleration, "the acceleration")
        return self.inertia * self.ratio * a + self._geared(numbers(resistance, "what resists"), v) / self.ratio

    def _geared(self, resistance: Array, velocity: Array) -> Array:
        return through(resistance, resistance * velocity >= 0, self.efficiency)

    def drives(self, analysis: Turned) -> tuple[Array, Array]:
        """Torque (N m) and speed (rad/s) of the motor along the motion of an ``analysis``."""
        load, v, a = _followed(analysis)
        return self.torque(load, v, a), self.ratio * v

    def best_ratio(self, analysis: Turned) -> Value:
        """The ratio of the least rms torque: ``i^4 = mean of (N / eta)^2 / mean of (J_m psi'')^2``.

        ``sqrt(J / J_m)`` of an inertia alone; ``inf`` of a motor without inertia.
        """
        load, v, a = _followed(analysis.resolved)
        mean = [
            running_integral(analysis.resolved.cam_angle, x**2, analysis.resolution)[..., -1]
            for x in np.broadcast_arrays(self._geared(load, v), a)
        ]
        with np.errstate(divide="ignore", invalid="ignore"):
            best: Value = (mean[0] / mean[1]) ** 0.25 / np.sqrt(number(self.inertia))
        return best


def _followed(analysis: Turned) -> tuple[Array, Array, Array]:
    """What resists the follower, inertia included, and its velocity and acceleration by time."""
    cam, speed = cam_of(analysis), speed_of(analysis)
    return cam.resistance, cam.velocity * speed, cam.acceleration * speed**2


def through(load: Array, driving: Array, efficiency: Value) -> Array:
    """What a gear takes for a ``load``: more where the motor is ``driving``, less where the load is."""
    return np.where(driving, load / efficiency, load * efficiency)


MOTORS = Motor(), Servo()
"""What a motor can do, for a menu."""


@dataclass(frozen=True)
class DrivenCam(Design):
    """A ``cam``, whatever its follower, rigid or with an elastic train, and the ``motor`` that turns it.

    Its analysis is that of the cam, with torque and power of the motor beside it: ``motor_torque`` and ``motor_power``.

    >>> from camkit import TranslatingRollerCam
    >>> machine = DrivenCam(TranslatingRollerCam(), Motor(ratio=5))
    >>> print(motor_rms.text(motor_rms(machine.analyse())))
    0.1953 N m

    Raises ``ValueError`` for what is no cam.
    """

    cam: Design = field(default=TranslatingRollerCam())
    motor: Motor | Servo = choice("D", MOTORS[0], MOTORS, "what the motor does")

    answers_for: ClassVar[tuple[str, ...]] = ("cam",)
    name: ClassVar[str] = "cam with a motor"

    def __post_init__(self) -> None:
        refuse_no_cam(self.cam, DrivenCam)
        super().__post_init__()

    def analyse(self, n: int = 721) -> Any:
        """The cam at ``n`` cam angles, and its motor."""
        alone: Any = self.cam.analyse(n)  # type: ignore[attr-defined]
        if not hasattr(type(alone), "turning"):
            raise ValueError(f"the cam is {shown(self.cam)}; it must be one that a torque turns")
        return with_more(alone, _driven, motor=self.motor)


class Driven(Turned, Protocol):
    """The analysis of a cam that has a motor."""

    @property
    def motor(self) -> Motor | Servo: ...
    def highest(self, f: Callable[[Turned], Value]) -> Extreme: ...


class Motored:
    """What the analysis of a cam has besides, with a motor."""

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]:
        """The mechanism, then what concerns the drive: work, torque of the motor, both over speeds; then the cam."""
        torque = AnalysisCurve("motor_torque", "N m", "motor torque")
        mechanism, *curves = super().offers  # type: ignore[misc]
        return (mechanism, "turning", torque, "torque_sweep", *curves)

    @property
    def motor_torque(self: Driven) -> Array:
        """N m; below 0 where the motor brakes."""
        return self.motor.drives(self)[0]

    @property
    def motor_power(self: Driven) -> Array:
        """W; below 0 where the motor brakes."""
        return np.multiply(*self.motor.drives(self))


@cache
def _driven(kind: Any) -> Any:
    """The analysis of a cam of a ``kind``, with its motor."""
    motor = [("motor", object, field(kw_only=True, repr=False))]
    return make_dataclass(f"Driven{kind.__name__}", motor, bases=(Motored, kind), frozen=True)


# ---------------------------------------------------------------- measures


def _over_turn(name: str, unit: str, size: Callable[[Motor | Servo, Turned], Array]) -> PeakMeasure:
    """The largest size of a curve of the motor along a cam."""

    def points(analysis: Driven) -> Array:
        sizes = np.where(cam_of(analysis).buildable, abs(size(analysis.motor, analysis.resolved)), np.nan)
        return raised(sizes, analysis.resolution.inner) + np.where(analysis.struck, np.inf, 0.0)[..., None]

    def value(analysis: Driven) -> Value:
        most = analysis.highest(lambda at: abs(size(analysis.motor, at))).value
        return most + np.where(analysis.struck, np.inf, 0.0)

    return PeakMeasure(name, unit, value, points=points, angle=lambda a: a.resolved.cam_angle)


def _mean_power(analysis: Driven) -> Value:
    """Of what resists and what the gear loses, whichever way the power goes; a rotor gives back all that it takes."""
    eta, speed = number(analysis.motor.efficiency), number(speed_of(analysis))
    lost = (1 / eta - eta) / 2 * mean_size(analysis)
    mean: Value = speed * ((1 / eta + eta) / 2 * analysis.turning.mean + lost)
    return mean


motor_rms = Measure("rms motor torque", "N m", lambda a: turning_of(a, "motor_torque").rms)
motor_peak = _over_turn("peak motor torque", "N m", lambda motor, at: motor.drives(at)[0])
motor_power = _over_turn("peak motor power", "W", lambda motor, at: np.multiply(*motor.drives(at)))
mean_motor_power = Measure("mean motor power", "W", _mean_power)
speed_fluctuation = Measure("speed fluctuation of the cam", "%", lambda a: a.motor.fluctuation(a))
best_ratio = Measure("gear ratio of the least rms torque", "", lambda a: a.motor.best_ratio(a))

DrivenCam.measures = (motor_rms, motor_peak, motor_power, mean_motor_power)
Motor.measures, Servo.measures = (speed_fluctuation,), (best_ratio,)
DrivenCam.makers = MAKERS
