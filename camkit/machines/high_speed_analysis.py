"""What follows from a high-speed cam: forces, stress and wear along it, and their peaks.

Rise and fall are parts of the turn of their own.  The peaks of both are found together, to 0.1 % (see `with_tops`).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, ClassVar

import numpy as np

from ..cam.measures import number
from ..cam.oscillating_roller import OscillatingRollerAnalysis
from ..contact import line_contact
from ..extrema import raised, with_tops
from ..motion import Kinematics
from ..motion.resolution import STEPS, Resolution, between, resolve
from ..quantities import members
from ..quantities.types import Array, Value
from ..units import mm
from . import high_speed_curves as curves


@dataclass(frozen=True)
class HighSpeedContact(OscillatingRollerAnalysis):
    """Force, stress and wear between cam and roller, on the geometry of `OscillatingRollerAnalysis`.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``.
    """

    cam: Any

    @property
    @abstractmethod
    def rounding(self) -> Array:
        """A force that is rounding, N."""

    @property
    @abstractmethod
    def spring_rate(self) -> Array:
        """``K``, shaped to multiply arrays of angles."""

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """``M``: torque about the arm's pivot that the cam has to overcome, N m."""
        return self._torque(self.motion, self.cam.speed)

    def _torque(self, motion: Kinematics, speed: Any) -> np.ndarray:
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
    def inertia(self) -> Any:
        """``J omega_0^2``: torque at the rated speed for an acceleration of 1 rad by cam angle squared, N m."""
        return self._torque(self.motion._replace(a=self.motion.a + 1), 1.0) - self._torque(self.motion, 1.0)

    @property
    def preload(self) -> Any:
        """Torque of the closing spring before the arm moves, N m; 0 if the load has none."""
        preload = getattr(self.cam.load, "preload", None)
        return preload(self.cam.swing, self._rate) if preload else 0.0

    @cached_property
    def margin(self) -> np.ndarray:
        """``q = 1 - r kappa``: 0 or less where the roller undercuts the profile."""
        return 1 - self.cam.roller_radius * self.curvature

    @cached_property
    def reduced_radius(self) -> np.ndarray:
        """``rho_pr = 1 / (1/r + kappa/q)``, which is ``r q``, m; ``nan`` where the profile is undercut."""
        return np.where(self.margin > 0, self.cam.roller_radius * self.margin, np.nan)

    @cached_property
    def ease(self) -> np.ndarray:
        """``r q / N = 1 / F_sigma^2``, m/N: smooth where ``F_sigma`` has a pole; ``nan`` without contact."""
        with np.errstate(divide="ignore", invalid="ignore"):
            touching = np.where(self.contact_force >= -self.rounding, abs(self.contact_force), np.nan)
            return self.cam.roller_radius * self.margin / touching

    @cached_property
    def stress_coefficient(self) -> np.ndarray:
        """``F_sigma = sqrt(N / rho_pr)``, N^0.5 mm^-0.5; ``nan`` where undercut or without contact."""
        return inverse_root(self.ease / mm)

    @cached_property
    def wear_coefficient(self) -> np.ndarray:
        """``F_wear = N F_sigma``, N^1.5 mm^-0.5."""
        return self.contact_force * self.stress_coefficient

    @cached_property
    def hertz_pressure(self) -> np.ndarray:
        """``p_0 = sqrt(N E* / (pi b rho_pr))``: largest pressure between cam and roller, Pa."""
        return self._pressure(self.contact_force, 1 / self.reduced_radius)

    def _pressure(self, force: Any, curvature: Any) -> np.ndarray:
        pair = self.cam.contact
        return line_contact(force / pair.width, curvature, pair.modulus).pressure


def inverse_root(ease: Any) -> Array:
    """``ease ** -0.5``; ``nan`` where it is not above 0."""
    return np.where(ease > 0, ease, np.nan) ** -0.5


@dataclass(frozen=True)
class Glimpse(HighSpeedContact):
    """Some members of a population at a few cam angles each, ``(k, m)``."""

    whole: HighSpeedAnalysis
    rows: np.ndarray

    @property
    def spring_rate(self) -> Array:
        """``K`` of each."""
        return members(self.whole.spring_rate, self.rows)

    @property
    def rounding(self) -> Array:
        """That of each."""
        return members(self.whole.rounding, self.rows)

    @property
    def buildable(self) -> Array:
        """Whether each can be built."""
        return members(self.whole.buildable, self.rows)


@dataclass(frozen=True)
class Interval(HighSpeedContact):
    """A part of a turn in which the arm swings: away, back, or both."""

    whole: HighSpeedAnalysis
    segments: tuple[int, ...]
    """Those of the motion, by their numbers."""

    @property
    def spring_rate(self) -> Array:
        """``K`` of the whole cam."""
        return self.whole.spring_rate

    @cached_property
    def resolution(self) -> Resolution:
        """The cam angles of the whole cam's that lie in this part."""
        return self.whole.resolution.of(self.segments)

    @cached_property
    def resolved(self) -> Interval:
        """This part at the cam angles of its `resolution`."""
        other, here = replace(self, cam_angle=self.resolution.angle), self.whole.resolution.within(self.segments)
        motion = Kinematics(*(x[..., here] for x in self.whole.resolved.motion))
        other.__dict__.update(resolved=other, resolution=self.resolution, motion=motion)
        return other

    @property
    def buildable(self) -> Array:
        """That of the whole cam."""
        return self.whole.buildable

    @property
    def rounding(self) -> Array:
        """That of the whole cam."""
        return self.whole.rounding

    @cached_property
    def _tops(self) -> dict[Callable[[Any], Any], np.ndarray]:
        """What `tops` has found."""
        return {}

    def tops(self, curve: Callable[[Any], Any], but: Value = False) -> np.ndarray:
        """``curve(part)`` at the cam angles of the `resolution`, each peak that counts raised to its top.

        Not so exactly of those members of a population for which ``but`` holds.
        """
        if curve not in self._tops:
            values, inner = curve(self.resolved) + 0.0 * self.resolution.angle, self.resolution.inner
            look = partial(self._look, curve)
            self._tops[curve] = raised(values, inner) if self.rough else with_tops(values, inner, look, but)
        return self._tops[curve]

    def _look(self, curve: Callable[[Any], Any], at: Value, x: Any) -> Array:
        """``curve`` at ``x`` steps, ``(k, m)``, beside the cam angles of the `resolution` of flat index ``at``."""
        row, column = np.divmod(at, self.resolution.angle.shape[-1])
        left = column[:, None] - ((x <= 0) & (x < 0).any(-1, keepdims=True))
        pairs = [self.resolution.angle, *self.resolved.motion]
        (start, *first), (end, *second) = ([_picked(values, row, left + k) for values in pairs] for k in (0, 1))
        share = x + column[:, None] - left
        seen = Glimpse(members(self.cam, row), start + share * (end - start), self.whole, row)
        seen.__dict__["motion"] = between(Kinematics(*first), Kinematics(*second), end - start, share)
        return curve(seen) + 0.0 * share


def _picked(values: Array, row: Any, column: Any) -> Array:
    """Of each row the values in some columns, ``(k, m)``."""
    return values[column] if values.ndim == 1 else values[row[:, None] % len(values), column]


@dataclass(frozen=True)
class HighSpeedAnalysis(HighSpeedContact):
    """What follows from a `HighSpeedCam` over a turn, and of its two intervals ``rise`` and ``fall`` alone.

    Numbers of the cam are one or ``(p,)``; what cannot be built is ``nan``.
    """

    offers: ClassVar[tuple[str, ...]] = (
        "bodies",
        "motion",
        "pressure_angle",
        "stress_coefficient",
        "wear_coefficient",
        "hertz_pressure",
        "cam_torque",
    )
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    rise_at: np.ndarray
    fall_at: np.ndarray

    @cached_property
    def rise(self) -> Interval:
        """The interval in which the arm swings away."""
        return Interval(self.cam, self.rise_at, self, (0,), rough=self.rough)

    @cached_property
    def fall(self) -> Interval:
        """The interval in which the arm swings back."""
        return Interval(self.cam, self.fall_at, self, (2,), rough=self.rough)

    @cached_property
    def moving(self) -> Interval:
        """Rise and fall together, at the cam angles that show their peaks."""
        return Interval(self.cam, self.resolution.of((0, 2)).angle, self, (0, 2), rough=self.rough)

    def at(self, cam_angle: Any) -> Any:
        """The same cam at other cam angles."""
        other = super().at(cam_angle)
        other.__dict__["moving"] = self.moving
        return other

    @cached_property
    def resolved(self) -> Any:
        """The same cam at the cam angles of its `resolution`."""
        other = super().resolved
        other.__dict__["moving"] = self.moving
        return other

    @cached_property
    def rounding(self) -> Array:
        """A force that is rounding, N."""
        return 1e-9 * abs(self.moving.resolved.contact_force).max(-1, keepdims=True)

    @cached_property
    def resolution(self) -> Resolution:
        """Half as many steps in each interval as the analysis has angles there, if that is more than shows it."""
        finer = self.rise_at.shape[-1] // 2
        return resolve(self.cam.motion, finer) if finer > STEPS and not self.rough else super().resolution

    @property
    def moving_angle(self) -> np.ndarray:
        """The cam angles of rise and fall that show their peaks, rad."""
        return self.moving.cam_angle

    @property
    def min_radius(self) -> Any:
        """``r_k1``: smallest radius of the profile, m."""
        return number(self.cam.min_radius)

    @property
    def intervals(self) -> tuple[Interval, Interval]:
        """Rise and fall."""
        return self.rise, self.fall

    @cached_property
    def least_spring_factor(self) -> Array:
        """``max(-psi''/psi)``: the weakest spring that holds the arm's inertia at the rated speed.

        ``inf`` if the arm passes its start.  0/0 where the arm has not moved is left out.
        """
        return np.where(self.passes_start, np.inf, self.springs.max(-1))[()]

    @property
    def springs(self) -> np.ndarray:
        """``-psi''/psi`` over rise and fall with its peaks; of no account if the arm passes its start."""
        return self.moving.tops(curves.spring_needed, self.passes_start)

    @cached_property
    def spring_rate(self) -> Array:
        """`spring_factor`, shaped to multiply arrays of angles."""
        given = self.cam.spring_factor
        if np.all(given > 0):
            return given
        return np.where(given > 0, given, np.asarray(self.least_spring_factor)[..., None])

    @property
    def spring_factor(self) -> Any:
        """``K``: rate of the closing spring over ``J omega^2`` at the rated speed."""
        return number(self.spring_rate)

    @cached_property
    def undercut_margin(self) -> Array:
        """Least ``q = 1 - r kappa``; 0 or less: the profile is undercut; ``-inf`` if the arm's speed drops at once."""
        return self.margins.min(-1)

    @cached_property
    def margins(self) -> np.ndarray:
        """``q`` over rise and fall, its valleys as deep as they are; ``-inf`` at a drop of the arm's speed."""
        margins, drop = -self.moving.tops(curves.tightness), self.corner(-1)
        away = abs(self.moving_angle - np.expand_dims(drop.cam_angle, -1))
        nearest = away <= away.min(-1, keepdims=True)
        return np.where((np.expand_dims(drop.value, -1) > 0) & nearest, -np.inf, margins)

    @cached_property
    def forces(self) -> np.ndarray:
        """``N`` over rise and fall, its valleys as deep as they are, N."""
        return -self.moving.tops(curves.pull)

    @cached_property
    def stress(self) -> np.ndarray:
        """``F_sigma`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(curves.strain)

    @cached_property
    def wear(self) -> np.ndarray:
        """``F_wear`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(curves.attrition)

    def _pressing(self, curve: Callable[[Any], Any]) -> np.ndarray:
        """``curve ** -0.5`` of one that is below 0, with its peaks; ``nan`` throughout if the roller is pulled."""
        return np.where(self._pulled, np.nan, inverse_root(-self.moving.tops(curve, self._pulled[..., 0])))

    @property
    def pressure(self) -> np.ndarray:
        """``p_0`` over rise and fall with its peaks, Pa: only ``N / rho_pr = F_sigma^2`` counts."""
        return self._pressure(1.0, self.stress**2)

    @property
    def _pulled(self) -> Any:
        """Whether the roller would have to be pulled somewhere, ``N < 0``: ``(..., 1)``."""
        return (self.forces < -self.rounding).any(-1, keepdims=True)

    @property
    def loses_contact(self) -> Array:
        """Whether the roller would lift off somewhere: ``N < 0``, or the arm's speed drops at once."""
        return self._pulled[..., 0] | (self.corner(-1).value > 0)

    @property
    def beyond(self) -> np.ndarray:
        """How far the arm is beyond the nearer end over rise and fall, as a share of the swing; 0 between the ends."""
        over = np.maximum(self.moving.tops(curves.before), self.moving.tops(curves.after))
        return np.where(over <= curves.AT_REST, 0.0, over)

    @property
    def lead(self) -> np.ndarray:
        """Travel from either end over rise and fall as a share of what a 3-4-5 polynomial makes of it (see `lag`)."""
        return -self.moving.tops(curves.lag)

    @property
    def passes_start(self) -> Array:
        """Whether the arm swings back beyond its start, ``a < 0``: no spring can then follow ``K``."""
        return self._passes(curves.before)

    @property
    def passes_end(self) -> Array:
        """Whether the arm swings beyond its end, ``a > 1``: ``r_k2`` is then not the largest radius."""
        return self._passes(curves.after)

    def _passes(self, end: Callable[[Any], Any]) -> Any:
        part = self.moving.resolved
        return (raised(end(part), part.resolution.inner) > curves.AT_REST).any(-1)

    @property
    def flags(self) -> dict[str, Any]:
        """What is wrong with the cam, in words, and whether it is."""
        return {
            "the roller undercuts the profile": self.undercut_margin <= 0,
            "the roller loses contact": self.loses_contact,
            "the arm passes its start": self.passes_start,
            "the arm passes its end": self.passes_end,
        }
