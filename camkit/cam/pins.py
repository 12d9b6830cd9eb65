"""The pins of a follower: that about which an arm rocks and that on which a roller turns, and what they bear.

A pin of the diameter ``d`` and the length ``l`` bears a force ``F`` with the mean pressure ``p = F / (d l)`` on its
projected area; where it turns in its bush at the angular speed ``w`` they slide on each other at ``w d / 2``, and ``p``
times that is what a plain bearing is chosen by.

The roller's pin bears the contact force, as the roller's own mass is not counted.  The arm's pivot bears what is left
of all other forces on the arm: contact force, weight and inertia of a uniform arm, the force of a slider on its lever.
A load that is given as a torque, such as that of a torsion spring, is a couple and leaves the pivot alone.

Source: Shigley's Mechanical Engineering Design (lubrication and journal bearings: pressure and PV of bushings).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, make_dataclass
from functools import cache
from typing import Any, ClassVar, Protocol, cast

import numpy as np

from ..quantities import Analysable, Design, Measure, quantity, unless
from ..quantities.design import refuse_no_cam, with_more
from ..quantities.kinds import shown
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import mm
from .measures import number, over_cam
from .oscillating_roller import OscillatingRollerCam
from .statics import Bearing

CURVES = (
    AnalysisCurve("pivot_pressure", "MPa", "pressure in the arm's pivot"),
    AnalysisCurve("pin_pressure", "MPa", "pressure on the roller's pin"),
)


class Pinned(Protocol):
    """The analysis of a cam with one follower, and its pins."""

    cam: Design
    pins: CamWithPins

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]: ...

    @property
    def contact_force(self) -> Array: ...

    @property
    def normal(self) -> Array: ...

    @property
    def arm_force(self) -> Array: ...

    @property
    def velocity(self) -> Array: ...

    @property
    def speed(self) -> Value: ...

    @property
    def loaded_flank(self) -> Array: ...

    @property
    def bearing(self) -> Bearing: ...

    @property
    def roller_centre(self) -> Array: ...

    @property
    def pivot_force(self) -> Array: ...

    @property
    def pivot_pressure(self) -> Array: ...

    @property
    def pin_pressure(self) -> Array: ...

    @property
    def roller_spin(self) -> Array: ...

    def contact_point(self, flank: Value) -> Array: ...

    def surface_velocity(self, point: Array) -> Array: ...


@dataclass(frozen=True)
class CamWithPins(Design):
    """A ``cam`` with one follower, whatever it is, and the sizes of its pins.

    Its analysis is that of the cam, with the forces in the pins, their pressures and ``pv``: those of an elastic train
    if the cam is an `ElasticFollower`.  A sliding follower has no pivot, a flat face no roller: what a pin that is not
    there bears is ``nan``.

    >>> from camkit import HighSpeedCam
    >>> machine = CamWithPins(HighSpeedCam(), pivot_diameter=16 * mm, pivot_length=20 * mm)
    >>> print(f"{pivot_pressure(machine.analyse()) / 1e6:.3f} MPa")
    0.526 MPa

    Raises ``ValueError`` for what is no cam; `analyse` does for a roller's pin that is as thick as the roller.
    """

    cam: Design = field(default_factory=OscillatingRollerCam)
    pivot_diameter: float = quantity("d_A", 20, 4, 80, "mm", "pin about which the arm rocks")
    pivot_length: float = quantity("l_A", 30, 4, 120, "mm", "of that pin in its bush")
    pin_diameter: float = quantity("d_B", 6, 1, 60, "mm", "pin on which the roller turns")
    pin_length: float = quantity("l_B", 15, 2, 100, "mm", "of that pin in the roller")
    rated_speed: float = quantity(
        "omega_0", 0, 0, 2000, "rpm", "of a cam whose speed is a share of it, for pv; 0: not known", at_least=0
    )

    answers_for: ClassVar[tuple[str, ...]] = ("cam",)
    name: ClassVar[str] = "cam with its pins"

    def __post_init__(self) -> None:
        refuse_no_cam(self.cam, CamWithPins)
        super().__post_init__()

    def analyse(self, n: int = 721) -> Any:
        """The cam at ``n`` cam angles, with what its pins bear."""
        bare = cast(Analysable, self.cam).analyse(n)
        if not hasattr(type(bare), "contact_force"):
            raise ValueError(f"the cam is {shown(self.cam)}; it must have one follower, and pins those of that")
        analysis = with_more(bare, _pinned, pins=self)
        room = ring(analysis)
        if refuse := unless(np.logical_not(room <= 0)):
            pin, roller = self.pin_diameter / mm, 2 * _radius(analysis) / mm
            refuse(f"the roller's pin is {pin:.4g} mm thick, the roller {roller:.4g} mm; the pin must be thinner")
        return analysis


@cache
def _pinned(kind: type[Pinned]) -> type:
    """The analysis of a cam of a ``kind``, with its pins."""
    own = {name: property(f) for name, f in OWN.items()}
    own["offers"] = property(lambda a: _after_mechanism(kind.offers.__get__(a, kind)))
    more = [("pins", CamWithPins, field(kw_only=True, repr=False))]
    return make_dataclass(f"{kind.__name__}WithPins", more, bases=(kind,), frozen=True, namespace=own)


def _after_mechanism(offered: Sequence[str | AnalysisCurve]) -> tuple[str | AnalysisCurve, ...]:
    """The curves of the pins where they are seen first: beside the mechanism."""
    mechanism, *curves = offered
    return (mechanism, *CURVES, *curves)


def _size(force: Array) -> Array:
    return np.sqrt(force[0] * force[0] + force[1] * force[1])


def _pivot_force(a: Pinned) -> Array:
    """Of the pivot on the arm, machine's frame, ``(2, n)``, N; ``nan`` where nothing rocks."""
    others = a.arm_force if hasattr(a, "arm_force") else (np.nan, np.nan)
    both = (a.contact_force * along + other for along, other in zip(a.normal, others, strict=True))
    return -np.stack(np.broadcast_arrays(*both))


def _pivot_pressure(a: Pinned) -> Array:
    """Mean pressure in the arm's pivot, Pa."""
    return _size(a.pivot_force) / (a.pins.pivot_diameter * a.pins.pivot_length)


def _pin_pressure(a: Pinned) -> Array:
    """Mean pressure on the roller's pin, Pa; ``nan`` where no roller has room for it."""
    pressure = abs(a.contact_force) / (a.pins.pin_diameter * a.pins.pin_length)
    return np.where(np.expand_dims(ring(a), -1) > 0, pressure, np.nan)


def _turns(a: Pinned) -> Array:
    """How fast the cam turns, rad/s, ``(1,)`` or ``(p, 1)``; ``nan`` where only a share of it is known."""
    speed = np.atleast_1d(a.speed)
    if not getattr(a, "rated", False):
        return speed
    return speed * np.where(np.greater(a.pins.rated_speed, 0), a.pins.rated_speed, np.nan)


def _pivot_pv(a: Pinned) -> Array:
    """Pressure times sliding speed in the arm's pivot, W/m^2."""
    return a.pivot_pressure * abs(a.velocity) * _turns(a) * a.pins.pivot_diameter / 2


def _roller_spin(a: Pinned) -> Array:
    """Of a roller that rolls, on its pin, over the speed of the cam: as its surface runs with the flank that works."""
    flank, (nx, ny), rocks = a.loaded_flank, a.normal, hasattr(a, "arm_force")
    point = a.contact_point(flank)
    cam, centre = a.surface_velocity(point), a.bearing.velocity_at(getattr(a, "roller_centre", point))
    along = nx * (centre[1] - cam[1]) - ny * (centre[0] - cam[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        return along / (flank * _radius(a)) + (a.velocity if rocks else 0.0)


def _pin_pv(a: Pinned) -> Array:
    """Pressure times sliding speed on the roller's pin, W/m^2."""
    return a.pin_pressure * abs(a.roller_spin) * _turns(a) * a.pins.pin_diameter / 2


OWN = {
    "pivot_force": _pivot_force,
    "pivot_pressure": _pivot_pressure,
    "pivot_pv": _pivot_pv,
    "pin_pressure": _pin_pressure,
    "roller_spin": _roller_spin,
    "pin_pv": _pin_pv,
}
"""What an analysis with pins has besides."""


def _radius(a: Pinned) -> Value:
    """Of the roller, m; ``nan`` where there is none."""
    radius: Value = getattr(a.cam, "roller_radius", np.nan)
    return np.where(np.greater(radius, 0), radius, np.nan)[()]


def ring(a: Pinned) -> Value:
    """How much of the roller is left around its pin, m; ``nan`` without a roller."""
    return number(_radius(a) - a.pins.pin_diameter / 2)


def _volume(a: Pinned) -> Value:
    p = a.pins
    return np.pi / 4 * number(p.pivot_diameter**2 * p.pivot_length + p.pin_diameter**2 * p.pin_length)


pivot_pressure = over_cam("peak pressure in the arm's pivot", "MPa", lambda a: a.pivot_pressure)
pivot_pv = over_cam("peak pv in the arm's pivot", "MPa m/s", lambda a: a.pivot_pv)
pin_pressure = over_cam("peak pressure on the roller's pin", "MPa", lambda a: a.pin_pressure)
pin_pv = over_cam("peak pv on the roller's pin", "MPa m/s", lambda a: a.pin_pv)
ring_thickness = Measure("roller around its pin", "mm", ring)
pin_volume = Measure("volume of both pins", "cm^3", _volume)

CamWithPins.measures = (pivot_pressure, pivot_pv, pin_pressure, pin_pv, ring_thickness, pin_volume)
