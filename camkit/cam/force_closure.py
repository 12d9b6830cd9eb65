"""What keeps a follower on its cam, and what the shaft and the surfaces bear.

Every function takes any cam's analysis.  Jump and preload are those of a rigid follower without friction:
the inner flank pushes with ``Q / lever``, ``Q = J omega^2 w + (what resists besides)``, and cannot pull.  The
extremes are those of the whole curve, whatever cam angles the analysis has (see `camkit.extrema`).

Speeds are in rad/s.  Only a high-speed cam knows its speed as a share of the rated one, at which its load is given:
there speeds are such shares, and 1.2 is 20 % above the rated speed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from ..contact import LineContact, contact_modulus, line_contact
from ..data.materials import MATERIALS
from ..quantities import Design, choice, quantity
from ..quantities.applied import applied
from ..quantities.kinds import a_number, numbers, refuse_arguments, refuse_shapes, shown
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .analysis import CamAnalysis
    from .translating_roller import TranslatingRollerAnalysis


FASTEST = 1e9
"""A speed (rad/s) above this is a slip."""


def jump_speed(analysis: CamAnalysis) -> Value:
    """Speed of the cam at which the follower first leaves it: ``sqrt(static / (-J w))`` at its least.

    With damping it is the least ``omega`` with ``J omega^2 w + d omega v + static = 0`` somewhere.

    0 if the follower does not even stay on a resting cam, or if its speed drops at once; ``inf`` if it stays at any
    speed, as it does in a groove without a spring: that is form closed.

    >>> from camkit.cam import TranslatingRollerCam
    >>> from camkit.units import rpm
    >>> print(f"{jump_speed(TranslatingRollerCam().analyse()) / rpm:.1f} rpm")
    943.7 rpm
    """

    def slackness(at: CamAnalysis) -> Array:
        static, throw = at.static_resistance, -at.inertia * at.acceleration
        pull = -getattr(at, "damping", 0.0) * at.velocity / 2
        holds = np.where(static > 0, static, np.nan)
        room = pull**2 + throw * holds  # of x = 1 / omega: static x^2 - 2 pull x - throw = 0
        x = np.where(room >= 0, pull + np.sqrt(np.maximum(room, 0.0)), 0.0) / holds
        thrown = np.where((throw > 0) | (pull > 0), np.maximum(x, 0.0) ** 2, 0.0 * static)
        at_once = (static == 0) & ((pull > 0) | ((throw > 0) & (pull == 0)))
        return np.where((static < 0) | at_once, np.inf, np.where(np.isnan(thrown) & (pull < 0), 0.0, thrown))

    with applied("the jump speed", analysis), np.errstate(divide="ignore"):
        slack = np.where(_thrown_off(analysis), np.inf, analysis.highest(slackness).value)
        return 1 / np.sqrt(np.where(analysis.form_closed, 0.0 * np.isfinite(slack), slack))[()]


def preload_needed(analysis: TranslatingRollerAnalysis, speed: Value) -> Value:
    """Least preload of the spring that keeps the follower on the cam at ``speed``, N, or N m for an arm.

    The spring's rate and all other loads stay as they are; of a load without spring it is what one would have to add.
    ``inf`` where the follower's speed drops at once.  ``ValueError`` for a speed that is none.

    >>> from camkit.cam import TranslatingRollerCam
    >>> from camkit.units import rpm
    >>> cam = TranslatingRollerCam()
    >>> least = preload_needed(cam.analyse(), 1200 * rpm)
    >>> closed = cam.replace(load=cam.load.replace(preload=least))
    >>> print(f"{least:.2f} N, jumps at {jump_speed(closed.analyse()) / rpm:.1f} rpm")
    135.88 N, jumps at 1200.0 rpm
    """
    must = f"be a finite number of at least 0 and at most {FASTEST:g}"
    speed = a_number(speed, "the speed of the cam", must, lambda w: (w >= 0) & (w <= FASTEST))

    def lacking(at: TranslatingRollerAnalysis) -> Array:
        without = at.static_resistance - at.preload
        moving = at.inertia * np.square(speed) * at.acceleration + getattr(at, "damping", 0.0) * speed * at.velocity
        return -(moving + without)

    with applied("the preload that is needed", analysis):
        least = np.maximum(analysis.highest(lacking).value, 0.0)
        drops = _thrown_off(analysis) & np.logical_not(analysis.form_closed) & (np.atleast_1d(speed)[..., 0] > 0)
    return np.where(drops, np.inf, least)[()]


def _thrown_off(analysis: CamAnalysis) -> bool:
    """Whether the follower has mass and its speed drops at once, which no force can make it follow."""
    return (analysis.corner(-1).value > 0) & (np.max(analysis.inertia, axis=-1) > 0)


class TorqueBalance(NamedTuple):
    """How a torque is spread over the cam angle: numbers, or ``(p,)``; ``surplus`` has the cam angle last."""

    mean: Value
    """What the motor gives all the time, N m."""
    surplus: Value
    """Work that the torque took above the mean since the first cam angle, J."""
    swing: Value
    """Between the largest and the least ``surplus``, J: what a flywheel has to store."""


def torque_balance(cam_angle: Value, torque: Value) -> TorqueBalance:
    """Mean and swing of a ``torque`` (N m) given over ``cam_angle`` (rad), by the trapezoid rule.

    Without friction the mean over a full turn is the work of the machine alone: what mass, spring and weight take
    they give back.

    >>> phi = np.linspace(0, 2 * np.pi, 721)
    >>> balance = torque_balance(phi, 5 + 2 * np.sin(phi))
    >>> print(f"{balance.mean:.4f} N m, {balance.swing:.4f} J")
    5.0000 N m, 4.0000 J
    """
    given = f"the torque is {shown(torque)}, the cam angles are {shown(cam_angle)}"
    cam_angle, torque = numbers(cam_angle, "the cam angles"), numbers(torque, "the torque")
    if cam_angle.shape[-1:] != torque.shape[-1:] or cam_angle.ndim > torque.ndim or not torque.size:
        raise ValueError(f"{given}; each needs the other")
    if cam_angle.shape[-1:] < (2,):
        raise ValueError(f"{given}; they must be arrays of two or more")
    refuse_shapes({"torques": torque, "cam angles": cam_angle})
    step = np.diff(cam_angle, axis=-1)
    with np.errstate(invalid="ignore"):  # the torque is infinite where friction jams the follower
        middle = (torque[..., 1:] + torque[..., :-1]) / 2
        mean = (middle * step).sum(-1) / step.sum(-1)
        gained = np.cumsum((middle - np.expand_dims(mean, -1)) * step, axis=-1)
        surplus = np.concatenate([0.0 * gained[..., :1], gained], axis=-1)
        return TorqueBalance(mean, surplus, surplus.max(-1) - surplus.min(-1))


OWN = "own numbers"
MENU = {OWN: OWN, **{name: name for name in MATERIALS}}
"""A material by its name, or the numbers that stand beside it."""


@dataclass(frozen=True)
class ContactPair(Design):
    """The materials of cam and follower and the width on which they touch.

    A material is one of `MATERIALS` by its name, or its modulus and Poisson's ratio are given.

    >>> soft = ContactPair(cam_material="EN AW-6082 T6", follower_material="42CrMo")
    >>> print(f"{soft.modulus / 1e9:.2f} GPa")
    57.28 GPa
    """

    width: float = quantity("b", 15, 2, 60, "mm", "width of the contact")
    cam_modulus: float = quantity("E_1", 210, 50, 220, "GPa", "elastic modulus of the cam")
    follower_modulus: float = quantity("E_2", 210, 50, 650, "GPa", "elastic modulus of the follower")
    cam_poisson: float = quantity("nu_1", 0.3, 0, 0.5, "", "Poisson's ratio of the cam", at_least=0, at_most=0.5)
    follower_poisson: float = quantity(
        "nu_2", 0.3, 0, 0.5, "", "Poisson's ratio of the follower", at_least=0, at_most=0.5
    )
    cam_material: str = choice("M_1", OWN, MENU, "what the cam is made of")
    follower_material: str = choice("M_2", OWN, MENU, "what the follower is made of")

    name: ClassVar[str] = "along a line"
    offers: ClassVar[tuple[str, ...]] = ("contact_pressure",)

    def following(self) -> dict[str, str]:
        """What a material of the menu gives."""
        return {
            f"{body}_{name}": f"it is that of the {body}_material"
            for body in ("cam", "follower")
            for name in ("modulus", "poisson")
            if getattr(self, f"{body}_material") != OWN
        }

    def _elastic(self, body: str) -> tuple[Value, Value]:
        """Elastic modulus (Pa) and Poisson's ratio of ``cam`` or ``follower``."""
        material = MATERIALS.get(getattr(self, f"{body}_material"))
        if material:
            return material.elastic_modulus, material.poisson
        return getattr(self, f"{body}_modulus"), getattr(self, f"{body}_poisson")

    @property
    def modulus(self) -> Value:
        """``E*``, Pa."""
        (cam, cam_poisson), (follower, follower_poisson) = self._elastic("cam"), self._elastic("follower")
        return contact_modulus(cam, follower, cam_poisson, follower_poisson)


@dataclass(frozen=True)
class NoContact(Design):
    """Nothing is said of materials and width: no pressure is worked out."""

    name: ClassVar[str] = "not given"
    offers: ClassVar[tuple[str, ...]] = ()


def index_of_wear(force: Array, curvature: Array) -> Array:
    """``F sqrt(F kappa)`` of the ``curvature`` of both surfaces together; ``nan`` where undercut or pulled apart.

    >>> print(index_of_wear(np.array([100.0, -1.0]), np.array([400.0, 400.0])))
    [20000.    nan]

    Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov (``F_wear = N F_sigma``).
    """
    with np.errstate(invalid="ignore"):
        return np.where((force >= 0) & (curvature > 0), force * np.sqrt(force * curvature), np.nan)


def contact_along(analysis: Any, pair: ContactPair) -> LineContact:
    """Pressure, half width, largest shear and its depth along the cam, on the flank that gives the force.

    ``nan`` where that flank is undercut, and where a flat face would have to be pulled.

    >>> from camkit.cam import TranslatingRollerCam
    >>> print(f"{contact_along(TranslatingRollerCam().analyse(), ContactPair()).pressure.max() / 1e6:.1f} MPa")
    230.8 MPa
    """
    refuse_arguments(contact_along, locals())
    with applied("the contact along the cam", analysis):
        force = analysis.contact_force * analysis.loaded_flank
        return line_contact(force / pair.width, analysis.fit, pair.modulus)
