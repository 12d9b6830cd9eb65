"""What follows from a high-speed cam: forces, stress and wear along it, and their peaks.

Rise and fall are parts of the turn of their own.  The peaks of both are found together, to 0.1 % (see `with_tops`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from ..cam.measures import number
from ..cam.oscillating_roller import OscillatingRollerAnalysis
from ..contact import line_contact
from ..extrema import raised, with_tops
from ..geometry import Body
from ..motion import Kinematics
from ..motion.resolution import STEPS, along, between
from ..quantities import members
from ..quantities.known import certain
from ..quantities.types import Array, Value
from ..study import AnalysisCurve
from ..units import mm
from . import high_speed_curves as curves

AWAY, BACK = 0, 2
"""The segments of the motion in which the arm swings, by their numbers."""
WHOLE = (0, 1, 2, 3)
"""All of them: between the two in which the arm swings it dwells."""


def inverse_root(ease: Array) -> Array:
    """``ease ** -0.5``; ``nan`` where it is not above 0."""
    return np.where(ease > 0, ease, np.nan) ** -0.5


@dataclass(frozen=True)
class HighSpeedAnalysis(OscillatingRollerAnalysis):
    """What follows from a `HighSpeedCam` over a turn, and of its two intervals ``rise`` and ``fall`` alone.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``, numbers of the cam one or ``(p,)``; ``nan`` is what
    cannot be built.
    """

    cam: Any
    rise_at: np.ndarray
    fall_at: np.ndarray
    machine: Any
    """The design that was analysed: the cam, or what it drives; it says what is shown and drawn of it."""

    @property
    def offers(self) -> tuple[str | AnalysisCurve, ...]:
        """The shapes and curves that are shown of it where nobody chooses, in this order."""
        offers: tuple[str | AnalysisCurve, ...] = (*self.machine.offers, *getattr(self.cam.contact, "more", ()))
        return (*offers, "contact_force") if self.groove else offers

    @property
    def bodies(self) -> tuple[Body, ...]:
        """What is drawn of one design."""
        bodies: tuple[Body, ...] = self.machine.drawn(self)
        return bodies

    def steps(self) -> int:
        """Half as many in each interval as the analysis has angles there, if that is more than shows it."""
        return super().steps() if self.rough else max(STEPS, self.rise_at.shape[-1] // 2)

    # ---------------------------------------------------------------- the intervals

    def _part(self, *segments: int) -> HighSpeedAnalysis:
        """The same cam at the cam angles of its `resolution` in some segments alone, its peaks those of these."""
        whole, here = self.resolved, self.resolution.within(segments)
        part = replace(self, cam_angle=whole.cam_angle[..., here])
        part.__dict__.update(
            resolved=part,
            resolution=self.resolution.of(segments),
            motion=Kinematics(*(x[..., here] for x in whole.motion)),
            buildable=self.buildable,
            moving=part if len(segments) > 1 else self.moving,
        )
        return part

    def between(self, low: float, high: float) -> HighSpeedAnalysis:
        """The same cam seen between two cam angles (rad) alone."""
        zone = super().between(low, high)
        for part in (zone, zone.moving):
            part.__dict__.update({name: getattr(self, name) for name in OF_THE_WHOLE if hasattr(self, name)})
        return zone

    @cached_property
    def rise(self) -> HighSpeedAnalysis:
        """The interval in which the arm swings away."""
        rise: HighSpeedAnalysis = self._part(AWAY).at(self.rise_at)
        return rise

    @cached_property
    def fall(self) -> HighSpeedAnalysis:
        """The interval in which the arm swings back."""
        fall: HighSpeedAnalysis = self._part(BACK).at(self.fall_at)
        return fall

    @property
    def intervals(self) -> tuple[HighSpeedAnalysis, HighSpeedAnalysis]:
        """Rise and fall."""
        return self.rise, self.fall

    @cached_property
    def moving(self) -> HighSpeedAnalysis:
        """Rise and fall together, at the cam angles that show their peaks; the dwells too if a train swings in them."""
        shown = WHOLE if hasattr(self, "response") else (AWAY, BACK)
        moving: HighSpeedAnalysis = self._part(*shown) if self is self.resolved else self.resolved.moving
        return moving

    def tops(self, curve: Callable[[HighSpeedAnalysis], Array], but: Value = False) -> np.ndarray:
        """``curve(part)`` over rise and fall, at the cam angles of `moving`, each peak that counts raised to its top.

        Not so exactly of those members of a population for which ``but`` holds.
        """
        part, found = self.moving, self.moving._tops
        if curve not in found:
            values, inner = curve(part) + 0.0 * part.cam_angle, part.resolution.inner
            near = partial(part._near, curve)
            found[curve] = raised(values, inner) if self.rough else with_tops(values, inner, near, but)
        return found[curve]

    @cached_property
    def _tops(self) -> dict[Callable[[HighSpeedAnalysis], Array], np.ndarray]:
        """What `tops` has found."""
        return {}

    def _near(self, curve: Callable[[HighSpeedAnalysis], Array], rows: Any, at: Array, x: Array) -> Array:
        """``curve`` at ``x`` steps, ``(..., k, m)``, beside the samples ``at`` of some rows, or of all (``None``)."""
        cam, whole = self.cam, {name: value for name, value in vars(self).items() if name in OF_THE_WHOLE}
        if rows is not None:
            cam, whole = members(cam, rows), {name: members(value, rows) for name, value in whole.items()}
        lead, before = at.shape[:-1], (x <= 0) & (x < 0).any(-1, keepdims=True)
        columns = np.reshape((np.expand_dims(at, -1) + np.array([-1, 0, 1])) % self.cam_angle.shape[-1], (*lead, -1))
        angle, *motion = (
            np.reshape(_picked(values, rows, columns), (*at.shape, 3)) for values in (self.cam_angle, *self.motion)
        )
        step = angle[..., 1:] - angle[..., :-1]
        powers = between(Kinematics(*(m[..., :-1] for m in motion)), Kinematics(*(m[..., 1:] for m in motion)), step)

        def here(values: Array) -> Array:
            return np.where(before, values[..., :1], values[..., 1:2])

        share, steps = x + before, here(step)
        seen = replace(self, cam=cam, cam_angle=np.reshape(here(angle) + share * steps, (*lead, -1)))
        found = (np.reshape(m, (*lead, -1)) for m in along([*here(powers)], steps, share))
        seen.__dict__.update(whole, motion=Kinematics(*found))
        return np.reshape(curve(seen) + np.zeros(seen.cam_angle.shape), x.shape)

    # ---------------------------------------------------------------- forces

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """``M``: torque about the arm's pivot that the cam has to overcome, N m."""
        return self._torque(self.motion, self.cam.speed)

    def _torque(self, motion: Kinematics, speed: Value) -> np.ndarray:
        """What the load resists a motion with at a share of the rated speed, N m."""
        return self.cam.load.resisting_torque(motion, self.cam.swing, self._rate, speed)

    @property
    def _rate(self) -> Array:
        """``K``, ``nan`` where no spring holds the arm."""
        return np.where(np.isfinite(self.spring_rate), self.spring_rate, np.nan)

    @cached_property
    def static_resistance(self) -> np.ndarray:
        """Torque about the arm's pivot besides inertia, N m."""
        return self._torque(self.motion, 0.0)

    @cached_property
    def inertia(self) -> Array:
        """``J omega_0^2``: torque at the rated speed for an acceleration of 1 rad by cam angle squared, N m."""
        return self._torque(self.motion._replace(a=self.motion.a + 1), 1.0) - self._torque(self.motion, 1.0)

    @property
    def preload(self) -> Value:
        """Torque of the closing spring before the arm moves, N m; 0 if the load has none."""
        preload = getattr(self.cam.load, "preload", None)
        return preload(self.cam.swing, self._rate) if preload else 0.0

    @property
    def closing_rate(self) -> Value:
        """Rate of the closing spring, N m/rad; 0 if the load has none."""
        rate = getattr(self.cam.load, "spring_rate", None)
        return rate(self._rate) if rate else 0.0

    @property
    def arm_force(self) -> Array:
        """Sum of the forces on the arm besides those of cam and pivot, N; a load that is a torque has none."""
        loaded: Callable[[HighSpeedAnalysis], Array] | None = getattr(self.machine, "arm_force", None)
        return loaded(self) if loaded else 0.0 * self.normal

    @property
    def speed(self) -> Value:
        """At which the cam turns, as a share of the rated speed."""
        return self.cam.speed

    @property
    def rated(self) -> bool:
        """Whether that is a share, as of a `HighSpeedCam` by itself, and no speed in rad/s."""
        return self.machine is self.cam

    @property
    def rated_speed(self) -> Value:
        """What a `speed` of 1 is, rad/s."""
        rated: Value = self.cam.rated_speed if self.rated else 1.0
        return rated

    @property
    def way(self) -> Array:
        """Of the slider that the arm lifts, from its lowest position, m."""
        return self.cam.load.way(self.motion, self.cam.swing)

    @cached_property
    def rounding(self) -> Array:
        """A force that is rounding, N."""
        return 1e-9 * abs(self.moving.contact_force).max(-1, keepdims=True)

    @cached_property
    def margin(self) -> np.ndarray:
        """``q = 1 - r kappa``: 0 or less where the roller undercuts the profile; of a groove the worse flank's."""
        return 1 - self.cam.roller_radius * (abs(self.curvature) if self.groove else self.curvature)

    @cached_property
    def ease(self) -> np.ndarray:
        """``r q / |N| = 1 / F_sigma^2`` of the flank that works, m/N; ``nan`` without contact.

        It is smooth where ``F_sigma`` has a pole.
        """
        r, N = self.cam.roller_radius, self.contact_force
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.groove:
                return r * (1 - r * self.bend(self.loaded_flank)) / abs(N)
            return r * self.margin / np.where(-self.rounding <= N, abs(N), np.nan)

    @cached_property
    def stress_coefficient(self) -> np.ndarray:
        """``F_sigma = sqrt(N / rho_pr)``, N^0.5 mm^-0.5; ``nan`` where undercut or without contact.

        ``rho_pr = 1 / (1/r + kappa/q) = r q`` is the reduced radius of both surfaces.
        """
        return inverse_root(self.ease / mm)

    @cached_property
    def wear_coefficient(self) -> np.ndarray:
        """``F_wear = N F_sigma``, N^1.5 mm^-0.5."""
        return (abs(self.contact_force) if self.groove else self.contact_force) * self.stress_coefficient

    # ---------------------------------------------------------------- peaks

    @property
    def moving_angle(self) -> np.ndarray:
        """The cam angles of rise and fall that show their peaks, rad."""
        return self.moving.cam_angle

    @property
    def min_radius(self) -> Value:
        """``r_k1``: smallest radius of the profile, m."""
        return number(self.cam.min_radius)

    @cached_property
    def min_spring_factor(self) -> Array:
        """``max(-psi''/psi)``: the weakest spring that holds the arm's inertia at the rated speed.

        ``inf`` if the arm passes its start.  0/0 where the arm has not moved is left out.
        """
        return np.where(self.passes_start, np.inf, self.springs.max(-1))[()]

    @property
    def springs(self) -> np.ndarray:
        """``-psi''/psi`` over rise and fall with its peaks; of no account if the arm passes its start."""
        return self.tops(curves.spring_needed, self.passes_start)

    @cached_property
    def spring_rate(self) -> Array:
        """`spring_factor`, shaped to multiply arrays of angles."""
        given = self.cam.spring_factor
        if self.groove or certain(given > 0):
            return given
        return np.where(given > 0, given, np.expand_dims(self.min_spring_factor, -1))

    @property
    def spring_factor(self) -> Value:
        """``K``: rate of the closing spring over ``J omega^2`` at the rated speed."""
        return number(self.spring_rate)

    @cached_property
    def undercut_margin(self) -> Array:
        """Least ``q = 1 - r kappa``, of a groove of either flank; 0 or less: it is undercut.

        ``-inf`` if the arm's speed drops at once, of a groove if it jumps.
        """
        return self.margins.min(-1)

    @cached_property
    def margins(self) -> np.ndarray:
        """``q`` over rise and fall, its valleys as deep as they are; ``-inf`` where the flank has a corner."""
        margins = -self.tops(curves.tightness)
        for way in (-1, 1) if self.groove else (-1,):
            corner = self.corner(way)
            away = abs(self.moving_angle - np.expand_dims(corner.cam_angle, -1))
            nearest = away <= away.min(-1, keepdims=True)
            margins = np.where((np.expand_dims(corner.value, -1) > 0) & nearest, -np.inf, margins)
        return margins

    @cached_property
    def forces(self) -> np.ndarray:
        """``N`` over rise and fall, its valleys as deep as they are, N; below 0 at a groove's outer flank."""
        return -self.tops(curves.pull)

    @cached_property
    def stress(self) -> np.ndarray:
        """``F_sigma`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(curves.strain)

    @cached_property
    def wear(self) -> np.ndarray:
        """``F_wear`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(curves.attrition)

    def _pressing(self, curve: Callable[[HighSpeedAnalysis], Array]) -> np.ndarray:
        """``curve ** -0.5`` of one that is below 0, with its peaks; ``nan`` throughout if the roller is pulled."""
        return np.where(self._pulled, np.nan, inverse_root(-self.tops(curve, self._pulled[..., 0])))

    @property
    def pressure(self) -> np.ndarray:
        """``p_0`` over rise and fall with its peaks, Pa: only ``N / rho_pr = F_sigma^2`` counts."""
        pair = self.cam.contact
        return line_contact(self.stress**2 / pair.width, 1.0, pair.modulus).pressure

    @cached_property
    def _pulled(self) -> Any:
        """Whether the roller would have to be pulled somewhere, ``N < 0``: ``(..., 1)``."""
        if self.groove:
            return np.zeros(np.shape(self.rounding), dtype=bool)
        return (self.forces < -self.rounding).any(-1, keepdims=True)

    @property
    def loses_contact(self) -> Array:
        """Whether the roller lifts off somewhere: ``N < 0``, or the arm's speed drops at once; in a groove never."""
        return self._pulled[..., 0] if self.groove else self._pulled[..., 0] | (self.corner(-1).value > 0)

    @property
    def beyond(self) -> np.ndarray:
        """How far the arm is beyond the nearer end over rise and fall, as a share of the swing; 0 between the ends."""
        over = np.maximum(self.tops(curves.before), self.tops(curves.after))
        return np.where(over <= curves.AT_REST, 0.0, over)

    @property
    def lead(self) -> np.ndarray:
        """Travel from either end over rise and fall as a share of what a 3-4-5 polynomial makes of it (see `lag`)."""
        lead, moves = -self.tops(curves.lag), self.moving.resolution.moves
        return lead if moves.all() else np.where(moves, lead, 1.0)

    @cached_property
    def passes_start(self) -> Array:
        """Whether the arm swings back beyond its start, ``a < 0``: no spring can then follow ``K``."""
        return self._passes(curves.before)

    @property
    def passes_end(self) -> Array:
        """Whether the arm swings beyond its end, ``a > 1``: ``r_k2`` is then not the largest radius."""
        return self._passes(curves.after)

    def _passes(self, end: Callable[[HighSpeedAnalysis], Array]) -> Any:
        part = self.moving
        return (raised(end(part), part.resolution.inner) > curves.AT_REST).any(-1)

    @property
    def flags(self) -> dict[str, Array]:
        """What is wrong with the cam, in words, and whether it is."""
        return {
            "the roller undercuts the profile": self.undercut_margin <= 0,
            "the roller loses contact": self.loses_contact,
            "the arm passes its start": self.passes_start,
            "the arm passes its end": self.passes_end,
        }


OF_THE_WHOLE = ("buildable", "spring_rate", "rounding", "response", "factor")
"""What is the same wherever a cam is looked at, and follows from all of it; a rigid follower has no response."""


def _picked(values: Array, rows: Array | None, columns: Array) -> Array:
    """Of some rows, or of all (``None``), the values in some columns of each."""
    if rows is None:
        return np.take_along_axis(np.broadcast_to(values, (*columns.shape[:-1], values.shape[-1])), columns, -1)
    return values[columns] if values.ndim == 1 else values[rows[:, None] % len(values), columns]
