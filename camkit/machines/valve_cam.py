"""Valve cam whose lift is a high-order polynomial of the cam angle.

Over the opening flank, with ``b = 1 - alpha / alpha_B`` from 1 at its start to 0 at the nose,

    h = C_0 + C_p b^p + C_q b^q + C_r b^r + C_s b^s,   p = 2,  q = 2n,  r = 2n + 2m,  s = 2n + 4m

The closing flank mirrors it; a ramp on either side takes up the lash between base circle and flank.

Source: He Zhenjun, Li Xuefeng, Mech. Sci. Technol. Aerosp. Eng. 27(10) 2008, 1141-1144.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from typing import Any

import numpy as np

from ..cam.force_closure import jump_speed, preload_needed
from ..cam.peaks import Extreme
from ..cam.sizing import min_from_which_on
from ..contact import LineContact, contact_modulus, line_contact
from ..geometry import Body, Disc, Outline, rotated
from ..kinds import numbers, one_number
from ..motion import Kinematics, Poly345
from ..quantities import Design, Quantity, choice, counted, declarations, fails, quantity
from ..units import deg, mm
from .valve_train import FLAT, FOLLOWERS, ROLLER, ValveTrain, highest

LEAST_GAP = 1e-3
"""Exponents closer than this count as repeated: the coefficients would be the difference of huge numbers."""
BLEND = 1 / 3
"""Share of a ramp over which the follower gains the seating velocity; the rest of it is straight."""
FLANK_ANGLES = 129
"""Even cam angles of the flank between which extremes are looked for, however many an analysis has."""
ROUNDING = 1e-12
"""A lift this little (m) below 0 is the start of the flank."""


@dataclass(frozen=True)
class ValveCam(Design):
    """Cam of an engine valve: ramp, flank, nose, mirrored flank, ramp, base circle (defaults: the paper's data).

    ``base_radius`` is where the working flank begins, at lift 0; the base circle itself lies lower by the
    `ramp_height`, which is the lash that the ramp takes up.  ``seating_velocity`` is the follower's at that point.
    The train (mass, spring, widths, materials) is not the paper's; its defaults are those of a truck engine.

    >>> cam = ValveCam(n=20, m=20).analyse()
    >>> print(f"{cam.fullness:.6f}, {cam.nose_acceleration:.3f} m/s^2, {cam.min_radius / mm:.3f} mm")
    0.638393, -862.722 m/s^2, 1.159 mm

    Raises ``ValueError`` for exponents that repeat and for sizes that cannot be built.
    """

    n: float = quantity("n", 6, 3, 20, "", "second exponent 2n", above=1)
    m: float = quantity("m", 16, 1, 20, "", "third and fourth exponent 2n + 2m, 2n + 4m")
    max_lift: float = quantity("h_max", 13, 5, 20, "mm", "lift at the nose")
    half_angle: float = quantity("alpha_B", 62, 40, 90, "deg", "cam angle of one flank, start to nose")
    speed: float = quantity("omega", 1800, 300, 4000, "rpm", "speed of the camshaft")
    seating_velocity: float = quantity("v_g", 0.2, 0, 0.6, "m/s", "follower where the flank begins", at_least=0)
    base_radius: float = quantity("r_0", 21, 12, 40, "mm", "cam axis to follower where the flank begins")
    ramp_angle: float = quantity("alpha_r", 25, 5, 60, "deg", "cam angle of one ramp")
    follower: Any = choice("follower", FLAT, FOLLOWERS, "what rides on the cam")
    roller_radius: float = quantity("r_r", 10, 3, 25, "mm", "roller, where there is one")
    train_mass: float = quantity("m_v", 0.25, 0.02, 1, "kg", "valve, spring's share, tappet, as felt at the cam")
    spring_rate: float = quantity("c", 30, 0, 100, "N/mm", "valve spring", at_least=0)
    spring_preload: float = quantity("F_0", 250, 0, 1000, "N", "valve spring with the valve shut", at_least=0)
    speed_margin: float = quantity("x", 15, 0, 60, "%", "overspeed that must not make the follower jump", at_least=0)
    contact_width: float = quantity("w", 14, 4, 40, "mm", "length of the line on which cam and follower touch")
    cam_modulus: float = quantity("E_1", 210, 90, 220, "GPa", "elastic modulus of the cam")
    follower_modulus: float = quantity("E_2", 210, 90, 320, "GPa", "elastic modulus of the follower")

    def __post_init__(self) -> None:
        super().__post_init__()
        if fails(self._exponents_differ):
            raise ValueError(
                f"the exponents are {', '.join(f'{e:.6g}' for e in self._exponents)}; "
                f"each must lie at least {LEAST_GAP:g} above the one before"
            )
        if fails(self._fits_the_turn):
            raise ValueError(
                f"two flanks and two ramps need {2 * (self.half_angle + self.ramp_angle) / deg:.4g} deg of the cam; "
                "there are 360 deg"
            )
        if fails(self.base_radius > self.ramp_height):
            raise ValueError(
                f"the base radius is {self.base_radius / mm:.4g} mm and the ramp {self.ramp_height / mm:.4g} mm high; "
                "the base circle must keep some radius"
            )

    @property
    def _exponents(self) -> tuple[Any, ...]:
        """``p, q, r, s``."""
        return 2.0, 2.0 * self.n, 2.0 * self.n + 2.0 * self.m, 2.0 * self.n + 4.0 * self.m

    @property
    def _exponents_differ(self) -> Any:
        p, q, r, s = self._exponents
        return (q - p >= LEAST_GAP) & (r - q >= LEAST_GAP) & (s - r >= LEAST_GAP)

    @property
    def _fits_the_turn(self) -> Any:
        return self.half_angle + self.ramp_angle <= np.pi * (1 + 1e-12)

    @cached_property
    def buildable(self) -> Any:
        """Whether the design can be built, one answer or ``(p, 1)``."""
        numbers = {k: q for k, q in declarations(self).items() if isinstance(q, Quantity)}
        allowed = [declared.allows(getattr(self, name)) for name, declared in numbers.items()]
        whole = [self._exponents_differ, self._fits_the_turn, self.base_radius > self.ramp_height]
        return reduce(np.logical_and, [*allowed, *whole])

    @property
    def seating_slope(self) -> Any:
        """``h'(0) = v_g / omega``, m/rad."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.divide(self.seating_velocity, self.speed)

    @property
    def ramp_height(self) -> Any:
        """Lift of the ramp: from the base circle to the start of the flank, m."""
        return self.seating_slope * self.ramp_angle * (1 - BLEND / 2)

    @cached_property
    def flank(self) -> Flank:
        """The lift's polynomial."""
        return Flank.of(self)

    @property
    def train(self) -> ValveTrain:
        """The mass and the spring above the cam."""
        return ValveTrain(self.train_mass, self.spring_rate, self.spring_preload)

    def motion(self, cam_angle: Any) -> Kinematics:
        """Lift and its derivatives by cam angle, at angles within half a turn of the nose.

        0 is the start of the opening flank; the ramp and the base circle have negative lift.
        """
        from_nose = np.where(self.buildable, numbers(cam_angle, "the cam angles") - self.half_angle, np.nan)
        inward = self.half_angle - abs(from_nose)
        opening = np.where(from_nose > 0, -1.0, 1.0)
        flank, ramp = self.flank(np.maximum(inward, 0)), self._ramp(inward)
        s, v, a, j = (np.where(inward >= 0, f, r) for f, r in zip(flank, ramp, strict=True))
        return Kinematics(s, opening * v, a, opening * j)

    def _ramp(self, inward: Any) -> Kinematics:
        """The ramp before the flank and the base circle before the ramp, ``inward <= 0``.

        The slope grows after the 3-4-5 polynomial and then stays ``v_g / omega``, so that lift, velocity,
        acceleration and jerk have no jump anywhere on the cam.
        """
        slope, blend = self.seating_slope, BLEND * np.where(self.buildable, self.ramp_angle, np.nan)
        t = np.clip((inward + self.ramp_angle) / blend, 0, 1)
        straight = np.maximum(inward + self.ramp_angle - blend, 0)
        growth = Poly345().at(t)
        lift = slope * (blend * t**4 * (2.5 - 3 * t + t**2) + straight) - self.ramp_height
        return Kinematics(lift, slope * growth.s, slope / blend * growth.v, slope / blend**2 * growth.a)

    def analyse(self, n: int = 721) -> ValveAnalysis:
        """The opening flank at ``n`` cam angles; `ValveAnalysis.whole` is the whole cam."""
        return ValveAnalysis(self, np.linspace(0, 1, counted(n, "cam angles")) * self.half_angle)

    def with_spring(self, preload_share: float = 0.4) -> ValveCam:
        """The same cam under the weakest spring that holds the follower on it up to the speed margin.

        Its preload is ``preload_share`` of its force at full lift.

        >>> cam = ValveCam().with_spring()
        >>> print(f"{cam.analyse().jump_speed / cam.speed:.4f}")
        1.1500
        """
        must = "lie above 0, up to 1"
        preload_share = one_number(preload_share, "the preload's share of the full force", must)
        if not 0 < preload_share <= 1:
            raise ValueError(
                f"the preload's share of the full force is {preload_share:g}; it must lie above 0, up to 1"
            )
        top = self.speed * (1 + self.speed_margin)
        found = self.train.spring_needed(self.flank, self.analyse().cam_angle, top, preload_share)
        rate, preload = (float(x) if np.ndim(x) == 0 else x[..., None] for x in found)
        return self.replace(spring_rate=rate, spring_preload=preload)


@dataclass(frozen=True)
class Flank:
    """The polynomial of the opening flank; called with cam angles it gives the lift and its derivatives.

    ``coefficients`` and ``exponents`` are ``(4, 1)`` for one cam, ``(4, p, 1)`` for ``p``, in the order p, q, r, s.
    """

    lift: Any
    angle: Any
    exponents: np.ndarray
    coefficients: np.ndarray

    @classmethod
    def of(cls, cam: ValveCam) -> Flank:
        """Coefficients from ``h = 0, h' = v_g / omega, h'' = h''' = 0`` at the start, in closed form.

        The moments ``sum C_i = -C_0`` and ``sum C_i e_i^k = -v``, k = 1, 2, 3, solved by Lagrange:
        ``C_i = [-C_0 E3 + v (E2 - E1 + 1)] / prod (e_j - e_i)``, ``E`` the symmetric sums of the other three.
        """
        given = (*cam._exponents, cam.max_lift, cam.seating_slope * cam.half_angle, cam.buildable)
        *e, C0, v, buildable = np.broadcast_arrays(*map(np.atleast_1d, given))
        C = []
        with np.errstate(divide="ignore", invalid="ignore"):
            for i in range(4):
                x, y, z = (e[j] for j in range(4) if j != i)
                E1, E2, E3 = x + y + z, x * y + y * z + z * x, x * y * z
                C.append((-C0 * E3 + v * (E2 - E1 + 1)) / ((x - e[i]) * (y - e[i]) * (z - e[i])))
        return cls(cam.max_lift, cam.half_angle, np.stack(e), np.where(buildable, np.stack(C), np.nan))

    def __call__(self, alpha: Any) -> Kinematics:
        """``h, h', h'', h'''`` at the cam angles ``alpha`` from 0 to ``alpha_B``.

        Where ``n < 1.5`` the jerk at the nose is infinite.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            b, slope = np.clip(1 - alpha / self.angle, 0, 1), np.divide(-1, self.angle)
            terms = [(C, e, C * b ** (e - 2)) for C, e in zip(self.coefficients, self.exponents, strict=True)]
            s = self.lift + sum(t for _, _, t in terms) * b**2
            v = sum(e * t for _, e, t in terms) * b * slope
            a = sum(e * (e - 1) * t for _, e, t in terms) * slope**2
            # the square term has no third derivative, not even at the nose, where b is 0
            j = sum(e * (e - 1) * (e - 2) * C * b ** (e - 3) for C, e, _ in terms[1:]) * slope**3
        return Kinematics(s, v, a, j)


@dataclass(frozen=True)
class ValveAnalysis:
    """What follows from a `ValveCam` at the given cam angles, counted from the start of the opening flank.

    Arrays are ``(n,)`` for one design and ``(p, n)`` for ``p``; points ``(2, n)`` and ``(2, p, n)``; numbers of
    the cam as a whole are one or ``(p,)``.  Derivatives are by cam angle.  ``nan`` where a member of a population
    cannot be built.
    """

    cam: ValveCam
    cam_angle: np.ndarray

    @cached_property
    def whole(self) -> ValveAnalysis:
        """The whole cam at as many angles, from half a turn before the nose to half a turn after it."""
        turn = np.linspace(-np.pi, np.pi, self.cam_angle.shape[-1])
        return ValveAnalysis(self.cam, turn + self.cam.half_angle)

    @cached_property
    def event(self) -> ValveAnalysis:
        """From the start of the opening ramp to the end of the closing one, at twice as many angles."""
        half = self.cam.half_angle + self.cam.ramp_angle
        around = np.linspace(-1, 1, 2 * self.cam_angle.shape[-1] - 1)
        return ValveAnalysis(self.cam, self.cam.half_angle + half * around)

    @property
    def turn_range(self) -> np.ndarray:
        """Cam angles between which the cam turns once, the nose in the middle, rad."""
        return self.cam.half_angle + np.array([-np.pi, np.pi])

    @property
    def turn(self) -> np.ndarray:
        """How far the cam has turned counter-clockwise at each cam angle, rad."""
        return self.cam_angle

    @property
    def coefficients(self) -> np.ndarray:
        """``C_p, C_q, C_r, C_s``, m."""
        return self.cam.flank.coefficients[..., 0]

    @property
    def exponents(self) -> np.ndarray:
        """``p, q, r, s``."""
        return self.cam.flank.exponents[..., 0]

    @cached_property
    def motion(self) -> Kinematics:
        """Lift and its derivatives, ``s, v, a, j``."""
        return self.cam.motion(self.cam_angle)

    @property
    def lift(self) -> np.ndarray:
        """``h``: from the start of the flank, m; negative on ramp and base circle."""
        return self.motion.s

    @property
    def velocity(self) -> np.ndarray:
        """``h'``, m/rad."""
        return self.motion.v

    @property
    def acceleration(self) -> np.ndarray:
        """``h''``, m/rad^2."""
        return self.motion.a

    @property
    def jerk(self) -> np.ndarray:
        """``h'''``, m/rad^3."""
        return self.motion.j

    @cached_property
    def in_time(self) -> Kinematics:
        """Lift, velocity, acceleration, jerk by time at the camshaft's speed: m, m/s, m/s^2, m/s^3."""
        omega = self.cam.speed
        return Kinematics(self.lift, self.velocity * omega, self.acceleration * omega**2, self.jerk * omega**3)

    @cached_property
    def fullness(self) -> Any:
        """``xi = 1 + sum C_i / (1 + e_i) / C_0``: mean lift of a flank over the lift at the nose."""
        return 1 + (self.coefficients / (1 + self.exponents)).sum(0) / _number(self.cam.max_lift)

    @cached_property
    def _nose_curve(self) -> Any:
        """``h''`` at the nose, ``2 C_p / alpha_B^2``, m/rad^2."""
        return 2 * self.coefficients[0] / _number(self.cam.half_angle) ** 2

    @cached_property
    def nose_acceleration(self) -> Any:
        """Of the follower at the nose, m/s^2, negative."""
        return self._nose_curve * _number(self.cam.speed) ** 2

    @cached_property
    def peak_acceleration(self) -> Any:
        """Largest acceleration of the opening follower, anywhere on the flank, m/s^2."""
        peak, _ = highest(lambda alpha: self.cam.flank(alpha).a, self._flank_angle)
        return peak * _number(self.cam.speed) ** 2

    @cached_property
    def nose_radius(self) -> Any:
        """Radius of curvature at the nose under a flat follower, ``r_0 + h + h''``, m."""
        return _number(self.cam.base_radius) + _number(self.cam.max_lift) + self._nose_curve

    @cached_property
    def _tightest(self) -> tuple[Any, Any]:
        """Largest convex curvature of the roller centre's path on the flank, 1/m, and its cam angle."""
        return self._tightest_on(self.cam.base_radius)

    def _tightest_on(self, base_radius: Any) -> tuple[Any, Any]:
        roller = self.cam.roller_radius
        return highest(lambda at: ROLLER.pitch_curvature(self.cam.flank(at), base_radius, roller), self._flank_angle)

    @cached_property
    def _least_flat(self) -> tuple[Any, Any]:
        def bent(alpha: Any) -> Any:
            motion = self.cam.flank(alpha)
            return -(self.cam.base_radius + motion.s + motion.a)

        negative, angle = highest(bent, self._flank_angle)
        return -negative, angle

    @property
    def min_radius(self) -> Any:
        """Least convex radius of curvature of the cam under the chosen follower, m; below 0 it is undercut."""
        if self.cam.follower == FLAT:
            return self._least_flat[0]
        return 1 / self._tightest[0] - _number(self.cam.roller_radius)

    @property
    def min_radius_angle(self) -> Any:
        """Cam angle of the `min_radius`, rad."""
        return (self._least_flat if self.cam.follower == FLAT else self._tightest)[1]

    @cached_property
    def min_concave_radius(self) -> Any:
        """Least radius of the hollow flank under a roller, m: a grinding wheel must be smaller; ``inf`` if none is."""
        if self.cam.follower == FLAT:
            return np.inf + 0 * self.fullness
        base, roller = self.cam.base_radius, self.cam.roller_radius
        hollow, _ = highest(lambda at: -ROLLER.pitch_curvature(self.cam.flank(at), base, roller), self._flank_angle)
        return np.where(hollow > 0, 1 / np.where(hollow > 0, hollow, 1.0) + _number(roller), np.inf + 0 * hollow)

    def base_radius_for(self, min_radius: float) -> Any:
        """Least base radius from which on the cam keeps the given `min_radius`, m.

        Under a flat face every radius of curvature grows with it; under a roller of the radius ``r`` the path of
        its centre must keep ``rho = min_radius + r``, sure to be so from ``ample`` on (see
        `TranslatingRollerAnalysis.height_for`).
        """
        base, roller = _number(self.cam.base_radius), _number(self.cam.roller_radius)
        if self.cam.follower == FLAT:
            return base + min_radius - self.min_radius
        rho, motion = min_radius + roller, self.cam.flank(self._flank_angle)
        w, v = (abs(x).max(-1) for x in (motion.a, motion.v))
        ample = np.maximum(np.maximum(3 * rho, np.sqrt(3 * w * rho)), np.cbrt(6 * v**2 * rho))
        return min_from_which_on(lambda size: rho * self._tightest_on(np.asarray(size)[..., None])[0] <= 1, ample)

    def highest(self, f: Callable[[Any], Any]) -> Extreme:
        """The largest value of ``f(analysis)`` over the opening flank, whichever cam angles the analysis has."""
        return highest(lambda angle: f(replace(self, cam_angle=angle)), self._flank_angle)

    def lowest(self, f: Callable[[Any], Any]) -> Extreme:
        """As `highest`, for the least value."""
        value, angle = self.highest(lambda at: -f(at))
        return Extreme(-value, angle)

    @cached_property
    def _flank_angle(self) -> np.ndarray:
        return np.linspace(0, 1, FLANK_ANGLES) * self.cam.half_angle

    @property
    def _geometry(self) -> tuple[Kinematics, Any, Any]:
        return self.motion, self.cam.base_radius, self.cam.roller_radius

    @cached_property
    def flat_radius(self) -> np.ndarray:
        """Radius of curvature of the cam for a flat follower, ``rho = r_0 + h + h''``, m."""
        return self.cam.base_radius + self.lift + self.acceleration

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature of a roller centre's path on the cam (pitch curve), convex > 0, 1/m."""
        return ROLLER.pitch_curvature(*self._geometry)

    @cached_property
    def roller_profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam for a roller, convex > 0, m; ``inf`` where it turns hollow."""
        with np.errstate(divide="ignore"):
            return 1 / self.curvature - self.cam.roller_radius

    @cached_property
    def profile_curvature(self) -> np.ndarray:
        """Curvature of the cam under the chosen follower, convex > 0, 1/m."""
        return self.cam.follower.profile_curvature(*self._geometry)

    @cached_property
    def profile_radius(self) -> np.ndarray:
        """Radius of curvature of the cam under the chosen follower, convex > 0, m."""
        return self.flat_radius if self.cam.follower == FLAT else self.roller_profile_radius

    @cached_property
    def fit(self) -> np.ndarray:
        """Curvature of cam and follower together at their contact, 1/m."""
        return self.cam.follower.fit(self.profile_curvature, self.cam.roller_radius)

    @cached_property
    def undercut(self) -> np.ndarray:
        """Where the chosen follower would cut the cam away: the two cannot fit."""
        return self.fit < 0

    @cached_property
    def pressure_angle(self) -> np.ndarray:
        """Between the contact normal and the line of travel, rad; 0 for a flat face."""
        return self.cam.follower.pressure_angle(*self._geometry)

    @cached_property
    def contact_point(self) -> np.ndarray:
        """Where follower and cam touch, in the frame of the machine, m."""
        return self.cam.follower.contact_point(*self._geometry)

    def on_cam(self, points: np.ndarray) -> np.ndarray:
        """Points of the machine's frame as they lie on the cam at each cam angle."""
        return rotated(points, -self.turn)

    @cached_property
    def profile(self) -> np.ndarray:
        """The cam under the chosen follower, m; closed for the `whole` cam."""
        return self.on_cam(self.contact_point)

    @cached_property
    def pitch(self) -> np.ndarray:
        """Path of the roller's centre on the cam, m; ``nan`` under a flat face, which has none."""
        height = self.cam.base_radius + self.cam.roller_radius + self.lift
        return self.on_cam(np.stack([0 * height, height if self.cam.follower == ROLLER else np.nan * height]))

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The follower of one design: face or roller, with its stem."""
        cam, r = self.cam, self.cam.roller_radius
        flat, length, wide = cam.follower == FLAT, 1.6 * cam.max_lift, 1.15 * abs(self.velocity).max()
        at: Any = {"x": 0.0, "y": cam.base_radius + self.lift + (0.0 if flat else r)}
        face = Outline("follower", "face", np.array([[-wide, wide], [0, 0]]), **at)
        stem = Outline("follower", "arm", np.array([[0, 0], [0, length + (0.0 if flat else r)]]), **at)
        return face if flat else Disc("follower", "roller", r, **at), stem

    @property
    def face_normal(self) -> np.ndarray | None:
        """A flat face's normal as the cam sees it, outward, at each cam angle; ``None`` under a roller."""
        return rotated(np.array([0.0, 1.0]), -self.turn) if self.cam.follower == FLAT else None

    @property
    def outer_profile(self) -> np.ndarray:
        """``nan``: a valve cam has no groove and so no outer flank."""
        return np.nan * self.profile

    @property
    def profile_angle(self) -> np.ndarray:
        """The cam angle at which the follower touches each point of the profile, rad."""
        return self.cam_angle

    @cached_property
    def stretch(self) -> np.ndarray:
        """Which part of the cam each point belongs to, in words."""
        from_nose = abs(self.cam_angle - self.cam.half_angle)
        on_flank, on_ramp = from_nose <= self.cam.half_angle, from_nose <= self.cam.half_angle + self.cam.ramp_angle
        side = np.where(self.cam_angle <= self.cam.half_angle, "opening ", "closing ")
        part = np.where(on_flank, "flank", "ramp")
        return np.where(on_ramp, np.char.add(side, part), "base circle")

    @property
    def valve_open(self) -> np.ndarray:
        """Where the cam holds the valve open; on ramp and base circle the lash is open instead."""
        return self.lift >= -ROUNDING

    def force_at(self, speed: Any) -> np.ndarray:
        """Force between cam and follower along the line of travel with the camshaft at ``speed``, N.

        0 where the valve is shut; negative where the follower would have to be pulled: there it jumps.
        """
        return np.where(self.valve_open, self.cam.train.force(self.motion, speed), 0 * self.lift)

    def needed_at(self, speed: Any) -> np.ndarray:
        """Spring force that keeps the train on the cam at ``speed``, N; negative where the cam lifts it anyway."""
        return np.where(self.valve_open, self.cam.train.needed(self.motion, speed), 0 * self.lift)

    @cached_property
    def spring_force(self) -> np.ndarray:
        """Force of the valve spring, N."""
        return self.cam.train.spring_force(np.maximum(self.lift, 0))

    @property
    def static_resistance(self) -> np.ndarray:
        """What resists the follower's travel besides inertia, N: the spring."""
        return self.spring_force

    @property
    def inertia(self) -> Any:
        """What the cam throws about, kg: the train while the valve is open, nothing while it is shut."""
        return np.where(self.valve_open, self.cam.train_mass, 0.0)

    @property
    def preload(self) -> Any:
        """Of the valve spring, N."""
        return self.cam.spring_preload

    @property
    def form_closed(self) -> bool:
        """Whether the cam holds the follower from both sides: it does not."""
        return False

    def corner(self, way: int) -> Extreme:
        """The largest jump of the follower's speed (see `CamAnalysis.corner`): there is none."""
        return Extreme(0.0, 0.0)

    @property
    def loaded_flank(self) -> Any:
        """The cam's outline, there is no other."""
        return 1.0

    @cached_property
    def follower_force(self) -> np.ndarray:
        """Force between cam and follower along the line of travel, N."""
        return self.force_at(self.cam.speed)

    @cached_property
    def contact_force(self) -> np.ndarray:
        """Force between cam and follower along the contact normal, without friction, N."""
        return self.follower_force / np.cos(self.pressure_angle)

    @cached_property
    def contact(self) -> LineContact:
        """Pressure, half width and shear at the contact; ``nan`` where the cam is undercut."""
        force = np.maximum(self.contact_force, 0)
        modulus = contact_modulus(self.cam.cam_modulus, self.cam.follower_modulus)
        return line_contact(force / self.cam.contact_width, self.fit, modulus)

    @property
    def contact_stress(self) -> np.ndarray:
        """``p_0``: largest pressure between cam and follower, Pa."""
        return self.contact.pressure

    @cached_property
    def cam_torque(self) -> np.ndarray:
        """Torque that turns the camshaft, without friction, N m: power in = power out."""
        return self.follower_force * self.velocity

    @cached_property
    def jump_speed(self) -> Any:
        """Speed of the camshaft at which the follower first leaves the cam, rad/s."""
        return jump_speed(self)

    @property
    def jump_margin(self) -> Any:
        """How far the `jump_speed` lies above the speed, as a share of it."""
        return self.jump_speed / _number(self.cam.speed) - 1

    @property
    def top_speed(self) -> Any:
        """Speed of the camshaft with the speed margin, rad/s."""
        return self.cam.speed * (1 + self.cam.speed_margin)

    @cached_property
    def preload_needed(self) -> Any:
        """Least preload that keeps the follower on the cam up to the speed margin at the given rate, N."""
        return preload_needed(self, self.top_speed)

    @cached_property
    def rate_needed(self) -> Any:
        """Least spring rate that keeps the follower on the cam up to the speed margin with the given preload, N/m."""
        return self.cam.train.rate_needed(self.cam.flank, self._flank_angle, self.top_speed)

    @property
    def tables(self) -> dict[str, dict[str, np.ndarray]]:
        """What a workshop asks for, by its name: columns by heading."""
        return {"Lift table": self.lift_table}

    @cached_property
    def lift_table(self) -> dict[str, np.ndarray]:
        """The whole cam every degree from the nose, -180 .. 179: columns by heading, in the units they name.

        The lift counts from the base circle.
        """
        angle = np.arange(-180, 180) * deg
        at = ValveAnalysis(self.cam, angle + self.cam.half_angle)
        return {
            "cam angle [deg]": angle / deg,
            "lift [mm]": (at.lift + self.cam.ramp_height) / mm,
            "velocity [mm/rad]": at.velocity / mm,
            "acceleration [mm/rad^2]": at.acceleration / mm,
            "profile radius [mm]": at.profile_radius / mm,
        }


def _number(value: Any) -> Any:
    """A field of a design as a number of the cam as a whole: one, or ``(p,)`` from ``(p, 1)``."""
    return np.atleast_1d(value)[..., 0]
