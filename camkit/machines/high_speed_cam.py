"""High-speed disk cam with a roller on a rocking arm: contact stress and wear, the motion law itself free.

The arm swings away over the first interval of the cam's turn, dwells, swings back over another and dwells.  The
cam is given by the arm's length ``l``, the roller's radius ``r`` and the profile's largest radius ``r_k2``; where
the arm starts and the smallest radius ``r_k1`` follow.  The stress between cam and roller grows with
``F_sigma = sqrt(N / rho_pr)``, wear with ``F_wear = N F_sigma``: ``N`` is the normal force and ``rho_pr`` the
reduced radius of both surfaces.  "Margin" is ``q = 1 - r kappa`` with the pitch curve's curvature ``kappa``.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov.  The geometry is that of `OscillatingRollerCam`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from operator import attrgetter
from typing import Any, ClassVar

import numpy as np

from ..cam.directions import ROTATIONS
from ..cam.loads import Friction
from ..cam.oscillating_roller import OscillatingRollerAnalysis
from ..cam.peaks import raised, with_tops
from ..contact import contact_modulus, line_contact
from ..geometry import angle_opposite
from ..kinds import shown
from ..motion import LAWS, Dwell, Kinematics, Law, MotionProgram, Poly345, Return, Rise
from ..motion.families.shaped import DEGREE9, FAMILIES, ShapedLaw
from ..motion.resolution import STEPS, Resolution, between, resolve
from ..quantities import Design, choice, counted, fails, members, quantity
from ..units import deg, mm
from .high_speed_load import ConstantTorque, InertialSpringLoad

HAIR = 1e-9
"""Share of an interval by which its last angle lies before the dwell, so that the law still speaks there."""
AT_REST = 1e-6
"""Share of the swing below which the arm counts as not having moved."""


_SPRING = attrgetter("spring_needed")


def joined(*stretches: Any) -> Any:
    """Arrays of angles, one behind the other, also where only some have a population axis."""
    lead = np.broadcast_shapes(*(values.shape[:-1] for values in stretches))
    return np.concatenate([np.broadcast_to(v, (*lead, v.shape[-1])) for v in stretches], axis=-1)


def number(value: Any) -> Any:
    """A field of a design as a number of the whole: one, or ``(p,)`` from ``(p, 1)``."""
    return np.atleast_1d(value)[..., 0]


@dataclass(frozen=True)
class FreeLawCam(Design):
    """What every high-speed cam has: sizes, two motion laws, and four coefficients that shape each of them.

    The coefficients are added to the laws in the sense of ``family`` (see `ShapedLaw`): on the 3-4-5 polynomial
    they make the paper's polynomials of degree 9, or splines.
    """

    arm_length: float = quantity("l", 165, 40, 290, "mm", "arm: pivot to roller centre")
    roller_radius: float = quantity("r", 30, 20, 200, "mm", "roller")
    max_radius: float = quantity("r_k2", 130, 60, 140, "mm", "largest radius of the profile")
    rise_law: Any = choice("a", Poly345(), LAWS, "law by which the arm swings away")
    return_law: Any = choice("a'", Poly345(), LAWS, "law by which the arm swings back")
    family: Any = choice("B", DEGREE9, FAMILIES, "what the coefficients add to the laws")
    rise_c0: float = quantity("c_0", 0, -0.6, 0.6, "", "shapes the law away", above=None)
    rise_c1: float = quantity("c_1", 0, -0.6, 0.6, "", "shapes the law away", above=None)
    rise_c2: float = quantity("c_2", 0, -0.6, 0.6, "", "shapes the law away", above=None)
    rise_c3: float = quantity("c_3", 0, -0.6, 0.6, "", "shapes the law away", above=None)
    return_c0: float = quantity("d_0", 0, -0.6, 0.6, "", "shapes the law back", above=None)
    return_c1: float = quantity("d_1", 0, -0.6, 0.6, "", "shapes the law back", above=None)
    return_c2: float = quantity("d_2", 0, -0.6, 0.6, "", "shapes the law back", above=None)
    return_c3: float = quantity("d_3", 0, -0.6, 0.6, "", "shapes the law back", above=None)
    contact_width: float = quantity("b", 20, 5, 60, "mm", "length of the line on which cam and roller touch")
    cam_modulus: float = quantity("E_1", 210, 90, 220, "GPa", "elastic modulus of the cam")
    roller_modulus: float = quantity("E_2", 210, 90, 320, "GPa", "elastic modulus of the roller")

    def _law(self, way: str) -> Law:
        base = getattr(self, f"{way}_law")
        if not isinstance(base, Law):
            raise ValueError(f"the {way} law is {shown(base)}; it must be a motion law such as Degree9((0, 0, 0, 0))")
        c = tuple(getattr(self, f"{way}_c{i}") for i in range(4))
        return base if all(np.ndim(ci) == 0 and ci == 0 for ci in c) else ShapedLaw(base, c, self.family)

    @cached_property
    def laws(self) -> tuple[Law, Law]:
        """The laws of rise and return with what the coefficients add to them."""
        return self._law("rise"), self._law("return")


@dataclass(frozen=True)
class HighSpeedCam(FreeLawCam):
    """A cam between two dwells, its laws free (defaults: the paper's first design).

    ``spring_factor`` is the rate of the closing spring over ``J omega^2`` at the rated speed (``speed`` = 100 %); 0
    stands for the weakest spring that holds the arm's inertia there.  Faster, the same spring may let the roller lift.
    ``load`` is an `InertialSpringLoad`, a `ConstantTorque` or anything else with a ``name`` and their method
    ``resisting_torque``.

    >>> cam = HighSpeedCam(165 * mm, 30 * mm, 130 * mm, Poly345(), Poly345())
    >>> analysis = cam.analyse()
    >>> print(f"{analysis.rise.stress_coefficient.max():.4f}, {analysis.fall.wear_coefficient.max():.2f}")
    2.4780, 410.00

    Raises ``ValueError`` for sizes that cannot be built: the sentence says which and what is possible.
    """

    load: Any = choice("M", InertialSpringLoad(), (InertialSpringLoad(), ConstantTorque()), "what the arm resists with")
    centre_distance: float = quantity("L", 200, 100, 400, "mm", "cam axis to arm pivot")
    swing: float = quantity("PS", 30, 2, 60, "deg", "swing of the arm")
    rise_angle: float = quantity("phi_1", 90, 30, 170, "deg", "cam angle over which the arm swings away")
    return_angle: float = quantity("phi_2", 90, 30, 170, "deg", "cam angle over which the arm swings back")
    speed: float = quantity("n", 100, 10, 200, "%", "share of the rated speed, for which load and spring are given")
    spring_factor: float = quantity(
        "K", 0, 0, 12, "", "closing spring / inertia by rated speed squared; 0: the weakest", at_least=0
    )
    rotation: int = choice("sigma", 1, ROTATIONS, "direction in which the cam turns")

    groove: ClassVar[bool] = False
    """A plate: spring or weight hold the roller to it."""
    friction: ClassVar[Friction] = Friction(0, 0, 0, 0)
    """None is counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.laws  # noqa: B018 - refuses what is no law
        self._refuse_intervals()
        self._refuse_sizes()

    def _refuse_intervals(self) -> None:
        moving = self.rise_angle + self.return_angle
        fits = moving < 2 * np.pi
        if fails(fits):
            raise ValueError(
                f"the arm swings over {moving / deg:.4g} deg of the cam; there are 360 deg, and two dwells "
                "need some of them"
            )
        self.keep(fits)

    def _refuse_sizes(self) -> None:
        L, l, psi = self.centre_distance, self.arm_length, self.end_angle
        reaches, starts, clear = psi < np.pi, self.start_angle > 0, self.min_radius > 0
        if fails(reaches):
            raise ValueError(
                f"the roller's centre has to come {(self.max_radius + self.roller_radius) / mm:.4g} mm from the cam "
                f"axis (r_k2 + r); an arm of {l / mm:.4g} mm at {L / mm:.4g} mm reaches {abs(L - l) / mm:.4g} to "
                f"{(L + l) / mm:.4g} mm"
            )
        if fails(starts):
            raise ValueError(
                f"the arm ends at {psi / deg:.4g} deg from the line of centres and swings "
                f"{self.swing / deg:.4g} deg; it must start above 0 deg"
            )
        if fails(clear):
            raise ValueError(
                f"the smallest radius r_k1 of the profile is {self.min_radius / mm:.4g} mm; it must be above 0 mm: "
                f"the roller of {self.roller_radius / mm:.4g} mm covers the cam axis"
            )
        self.keep(reaches & starts & clear)

    @property
    def end_angle(self) -> Any:
        """``psi_max``: where the roller's centre is ``r_k2 + r`` from the cam axis, rad; ``nan`` if it never is."""
        return angle_opposite(self.max_radius + self.roller_radius, self.arm_length, self.centre_distance)

    @property
    def start_angle(self) -> Any:
        """``psi_0``: the arm from the line pivot -> cam axis at its near dwell, rad."""
        return self.end_angle - self.swing

    @property
    def min_radius(self) -> Any:
        """``r_k1``: smallest radius of the profile, m."""
        L, l = self.centre_distance, self.arm_length
        return np.sqrt(L**2 + l**2 - 2 * L * l * np.cos(self.start_angle)) - self.roller_radius

    @property
    def dwell_angle(self) -> Any:
        """Cam angle of each of the two dwells, rad: they share what the intervals leave."""
        return np.pi - (self.rise_angle + self.return_angle) / 2

    @cached_property
    def motion(self) -> MotionProgram:
        """The arm's travel over a turn of the cam: rise, dwell, return, dwell."""
        away, back = self.laws
        moves = (Rise(self.rise_angle, self.swing, away), Return(self.return_angle, self.swing, back))
        return MotionProgram((moves[0], Dwell(self.dwell_angle), moves[1], Dwell(self.dwell_angle)))

    def angles(self, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Cam angles of the whole turn, of the rise and of the return, ``n`` even ones in either of these."""
        n = counted(n, "angles", 5)
        share, dwell = np.linspace(0, 1 - HAIR, n), np.linspace(0, 1, n // 4 + 2) * self.dwell_angle
        rise, far = share * self.rise_angle, self.rise_angle + dwell
        fall, near = far[..., -1:] + share * self.return_angle, 2 * np.pi - self.dwell_angle + dwell
        return joined(rise, far[..., :-1], fall, near), rise, fall

    def analyse(self, n: int = 401) -> HighSpeedAnalysis:
        """Geometry and forces at ``n`` even cam angles of either interval, and some of the dwells."""
        analysis = HighSpeedAnalysis(self, *self.angles(n))
        analysis.refuse_impossible()
        return analysis


@dataclass(frozen=True)
class HighSpeedContact(OscillatingRollerAnalysis):
    """Force, stress and wear between cam and roller, on the geometry of `OscillatingRollerAnalysis`.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``.
    """

    cam: Any

    @property
    @abstractmethod
    def rounding(self) -> Any:
        """A force that is rounding, N."""

    @property
    @abstractmethod
    def spring_rate(self) -> Any:
        """``K``, shaped to multiply arrays of angles."""

    @cached_property
    def resisting_torque(self) -> np.ndarray:
        """``M``: torque about the arm's pivot that the cam has to overcome, N m."""
        return self._torque(self.motion, self.cam.speed)

    def _torque(self, motion: Kinematics, speed: Any) -> np.ndarray:
        """What the load resists a motion with at a share of the rated speed, N m."""
        return self.cam.load.resisting_torque(motion, self.cam.swing, self._rate, speed)

    @property
    def _rate(self) -> Any:
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

    @property
    def normal_force(self) -> np.ndarray:
        """``N = M / (l cos theta)`` between cam and roller, N; < 0 where the roller would lift off."""
        return self.contact_force

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
            touching = np.where(self.normal_force >= -self.rounding, abs(self.normal_force), np.nan)
            return self.cam.roller_radius * self.margin / touching

    @cached_property
    def stress_coefficient(self) -> np.ndarray:
        """``F_sigma = sqrt(N / rho_pr)``, N^0.5 mm^-0.5; ``nan`` where undercut or without contact."""
        return inverse_root(self.ease / mm)

    @cached_property
    def wear_coefficient(self) -> np.ndarray:
        """``F_wear = N F_sigma``, N^1.5 mm^-0.5."""
        return self.normal_force * self.stress_coefficient

    @cached_property
    def spring_needed(self) -> np.ndarray:
        """``-psi''/psi``: ``K`` of the spring that holds the arm's inertia at the rated speed.

        Very negative, and of no account, where the arm has not moved.
        """
        psi = self.motion.s
        at_rest = psi <= AT_REST * self.cam.swing
        return np.where(at_rest, -1e12, -self.motion.a / np.where(at_rest, 1, psi))

    @cached_property
    def hertz_pressure(self) -> np.ndarray:
        """``p_0 = sqrt(N E* / (pi b rho_pr))``: largest pressure between cam and roller, Pa."""
        return self._pressure(self.normal_force, 1 / self.reduced_radius)

    def _pressure(self, force: Any, curvature: Any) -> np.ndarray:
        modulus = contact_modulus(self.cam.cam_modulus, self.cam.roller_modulus)
        return line_contact(force / self.cam.contact_width, curvature, modulus).pressure


def inverse_root(ease: Any) -> Any:
    """``ease ** -0.5``; ``nan`` where it is not above 0."""
    return np.where(ease > 0, ease, np.nan) ** -0.5


@dataclass(frozen=True)
class Glimpse(HighSpeedContact):
    """Some members of a population at a few cam angles each, ``(k, m)``."""

    whole: HighSpeedAnalysis
    rows: np.ndarray

    @property
    def spring_rate(self) -> Any:
        """``K`` of each."""
        return members(self.whole.spring_rate, self.rows)

    @property
    def rounding(self) -> Any:
        """That of each."""
        return members(self.whole.rounding, self.rows)

    @property
    def buildable(self) -> Any:
        """Whether each can be built."""
        return members(self.whole.buildable, self.rows)


@dataclass(frozen=True)
class Interval(HighSpeedContact):
    """A part of a turn in which the arm swings: away, back, or both."""

    whole: HighSpeedAnalysis
    segments: tuple[int, ...]
    """Those of the motion, by their numbers."""

    @property
    def spring_rate(self) -> Any:
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
    def buildable(self) -> Any:
        """That of the whole cam."""
        return self.whole.buildable

    @property
    def rounding(self) -> Any:
        """That of the whole cam."""
        return self.whole.rounding

    @cached_property
    def _tops(self) -> dict[Callable[[Any], Any], np.ndarray]:
        """What `tops` has found."""
        return {}

    def tops(self, curve: Callable[[Any], Any], but: Any = False) -> np.ndarray:
        """``curve(part)`` at the cam angles of the `resolution`, each peak that counts raised to its top.

        Not so exactly of those members of a population for which ``but`` holds.
        """
        if curve not in self._tops:
            values, inner = curve(self.resolved) + 0.0 * self.resolution.angle, self.resolution.inner
            look = partial(self._look, curve)
            self._tops[curve] = raised(values, inner) if self.rough else with_tops(values, inner, look, but)
        return self._tops[curve]

    def _look(self, curve: Callable[[Any], Any], at: Any, x: Any) -> Any:
        """``curve`` at ``x`` steps, ``(k, m)``, beside the cam angles of the `resolution` of flat index ``at``."""
        row, column = np.divmod(at, self.resolution.angle.shape[-1])
        left = column[:, None] - ((x <= 0) & (x < 0).any(-1, keepdims=True))
        pairs = [self.resolution.angle, *self.resolved.motion]
        (start, *first), (end, *second) = ([_picked(values, row, left + k) for values in pairs] for k in (0, 1))
        share = x + column[:, None] - left
        seen = Glimpse(members(self.cam, row), start + share * (end - start), self.whole, row)
        seen.__dict__["motion"] = between(Kinematics(*first), Kinematics(*second), end - start, share)
        return curve(seen) + 0.0 * share


def _picked(values: Any, row: Any, column: Any) -> Any:
    """Of each row the values in some columns, ``(k, m)``."""
    return values[column] if values.ndim == 1 else values[row[:, None] % len(values), column]


@dataclass(frozen=True)
class HighSpeedAnalysis(HighSpeedContact):
    """What follows from a `HighSpeedCam` over a turn, and of its two intervals ``rise`` and ``fall`` alone.

    Numbers of the cam are one or ``(p,)``; what cannot be built is ``nan``.
    """

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
        """Rise and fall together."""
        return Interval(self.cam, joined(self.rise_at, self.fall_at), self, (0, 2), rough=self.rough)

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
    def rounding(self) -> Any:
        """A force that is rounding, N."""
        return 1e-9 * abs(self.moving.resolved.normal_force).max(-1, keepdims=True)

    @cached_property
    def resolution(self) -> Resolution:
        """Half as many steps in each interval as the analysis has angles there, if that is more than shows it."""
        finer = self.rise_at.shape[-1] // 2
        return resolve(self.cam.motion, finer) if finer > STEPS and not self.rough else super().resolution

    @property
    def moving_angle(self) -> np.ndarray:
        """The cam angles of rise and fall that show their peaks, rad."""
        return self.moving.resolution.angle

    @property
    def start_angle(self) -> Any:
        """``psi_0``: the arm from the line of centres at its near dwell, rad."""
        return number(self.cam.start_angle)

    @property
    def min_radius(self) -> Any:
        """``r_k1``: smallest radius of the profile, m."""
        return number(self.cam.min_radius)

    @property
    def intervals(self) -> tuple[Interval, Interval]:
        """Rise and fall."""
        return self.rise, self.fall

    @cached_property
    def least_spring_factor(self) -> Any:
        """``max(-psi''/psi)``: the weakest spring that holds the arm's inertia at the rated speed.

        ``inf`` if the arm passes its start.  0/0 where the arm has not moved is left out.
        """
        return np.where(self.passes_start, np.inf, self.springs.max(-1))[()]

    @property
    def springs(self) -> np.ndarray:
        """``-psi''/psi`` over rise and fall with its peaks; of no account if the arm passes its start."""
        return self.moving.tops(_SPRING, self.passes_start)

    @cached_property
    def spring_rate(self) -> Any:
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
    def undercut_margin(self) -> Any:
        """Least ``q = 1 - r kappa``; 0 or less: the profile is undercut; ``-inf`` if the arm's speed drops at once."""
        return self.margins.min(-1)

    @cached_property
    def margins(self) -> np.ndarray:
        """``q`` over rise and fall, its valleys as deep as they are; ``-inf`` at a drop of the arm's speed."""
        margins, drop = -self.moving.tops(_tightness), self.corner(-1)
        away = abs(self.moving_angle - np.expand_dims(drop.cam_angle, -1))
        nearest = away <= away.min(-1, keepdims=True)
        return np.where((np.expand_dims(drop.value, -1) > 0) & nearest, -np.inf, margins)

    @cached_property
    def forces(self) -> np.ndarray:
        """``N`` over rise and fall, its valleys as deep as they are, N."""
        return -self.moving.tops(_pull)

    @cached_property
    def stress(self) -> np.ndarray:
        """``F_sigma`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(_strain)

    @cached_property
    def wear(self) -> np.ndarray:
        """``F_wear`` over rise and fall with its peaks, SI; ``nan`` where undercut or without contact."""
        return self._pressing(_attrition)

    def _pressing(self, curve: Callable[[Any], Any]) -> np.ndarray:
        """``curve ** -0.5`` of one that is below 0, with its peaks; ``nan`` throughout if the roller is pulled."""
        return np.where(self._pulled, np.nan, inverse_root(-self.moving.tops(curve, self._pulled[..., 0])))

    @property
    def pressure(self) -> np.ndarray:
        """``p_0`` over rise and fall with its peaks, Pa: only ``N / rho_pr = F_sigma^2`` counts."""
        return self._pressure(1.0, self.stress**2)

    @property
    def is_undercut(self) -> Any:
        """Whether the roller undercuts the profile."""
        return self.undercut_margin <= 0

    @property
    def _pulled(self) -> Any:
        """Whether the roller would have to be pulled somewhere, ``N < 0``: ``(..., 1)``."""
        return (self.forces < -self.rounding).any(-1, keepdims=True)

    @property
    def loses_contact(self) -> Any:
        """Whether the roller would lift off somewhere: ``N < 0``, or the arm's speed drops at once."""
        return self._pulled[..., 0] | (self.corner(-1).value > 0)

    @property
    def beyond(self) -> np.ndarray:
        """How far the arm is beyond the nearer end over rise and fall, as a share of the swing; 0 between the ends."""
        over = np.maximum(self.moving.tops(_before), self.moving.tops(_after))
        return np.where(over <= AT_REST, 0.0, over)

    @property
    def lead(self) -> np.ndarray:
        """Travel from either end over rise and fall as a share of what a 3-4-5 polynomial makes of it (see `_lag`)."""
        return -self.moving.tops(_lag)

    @property
    def passes_start(self) -> Any:
        """Whether the arm swings back beyond its start, ``a < 0``: no spring can then follow ``K``."""
        return self._passes(_before)

    @property
    def passes_end(self) -> Any:
        """Whether the arm swings beyond its end, ``a > 1``: ``r_k2`` is then not the largest radius."""
        return self._passes(_after)

    def _passes(self, end: Callable[[Any], Any]) -> Any:
        part = self.moving.resolved
        return (raised(end(part), part.resolution.inner) > AT_REST).any(-1)

    @property
    def flags(self) -> dict[str, Any]:
        """What is wrong with the cam, in words, and whether it is."""
        return {
            "the roller undercuts the profile": self.is_undercut,
            "the roller loses contact": self.loses_contact,
            "the arm passes its start": self.passes_start,
            "the arm passes its end": self.passes_end,
        }


def _tightness(part: Any) -> Any:
    return -part.margin


def _pull(part: Any) -> Any:
    return -part.normal_force


def _strain(part: Any) -> Any:
    """``-1 / F_sigma^2``."""
    return -part.ease


def _attrition(part: Any) -> Any:
    """``-1 / F_wear^2``."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return -part.ease / part.normal_force**2


def _before(part: Any) -> Any:
    """How far the arm is before its start, as a share of the swing."""
    return -part.motion.s / part.cam.swing


def _after(part: Any) -> Any:
    """How far the arm is beyond its end, as a share of the swing."""
    return part.motion.s / part.cam.swing - 1


def _lag(part: Any) -> Any:
    """Travel from either end as a share of what a 3-4-5 polynomial makes of it, the smaller one, below 0.

    Above 0 the arm is beyond an end.  It stays of a size near the ends, where the travel itself vanishes.
    """
    cam, (s, _, a, j) = part.cam, part.motion
    begun = cam.rise_angle + cam.dwell_angle
    back = part.cam_angle > begun - cam.dwell_angle / 2
    angle, way = np.where(back, cam.return_angle, cam.rise_angle), np.where(back, -1, 1) / cam.swing
    share, travel = (part.cam_angle - np.where(back, begun, 0.0)) / angle, back + way * s
    a, j = way * a * angle**2, way * j * angle**3
    return -np.minimum(_over_345(share, travel, a, j), _over_345(1 - share, 1 - travel, -a, j))


def _over_345(u: Any, s: Any, a: Any, j: Any) -> Any:
    """``s`` over that of a 3-4-5 polynomial at ``u`` from its beginning; next to that, by its derivatives ``a, j``.

    There both are rounding.  ``s = u^2 a / 4 - u^3 j / 12`` where it is of the third to fifth power of ``u``.
    """
    plain = u * u * u * (10 + u * (6 * u - 15))
    plain, u, s, a, j = np.broadcast_arrays(plain, u, s, a, j)
    share = s / plain
    lost = (u < 1e-4) & (abs(s) < 1e-11)
    u, a, j = u[lost], a[lost], j[lost]
    smooth = abs(a) <= 2 * u * abs(j) + 1e-6
    share[lost] = np.where(u > 1e-7, (a / u - j / 3) / 40, np.where(smooth, j / 60, a / (20 * u)))
    return share
