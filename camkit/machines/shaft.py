"""The intermediate tube of a shaft with two universal joints: as light as strength, stiffness and speed allow.

Source: Lyu, Du, Li, Yuan, Luo, Guangdong University of Technology, 2007 (drive of a ZJ-15A drilling rig).  The
paper sizes outer diameter ``D`` and inner diameter ``d`` of the tube for the least area of its section.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from ..data.materials import MATERIALS
from ..data.tubes import TUBE_FILES, standard_tubes
from ..quantities import Design, Measure, quantities_of, quantity, refuse_population, unless, value_of, words
from ..quantities.kinds import numbers, refuse_arguments, shown
from ..quantities.types import Array, Value
from ..study.design_map import DesignMap
from ..study.study import Space, Study
from ..units import deg, kW, mm, rpm
from .shaft_analysis import ShaftAnalysis, nearest_of

TORQUE_NUMBER = 9550
"""Handbooks' ``M [N m] = 9550 P [kW] / n [rpm]``; exact is 30000 / pi = 9549.2966, the paper uses 9550."""


@dataclass(frozen=True)
class UniversalJointShaft(Design):
    """The tube between two universal joints (defaults: the paper's best design and data).

    >>> from camkit import MPa
    >>> tube = UniversalJointShaft(outer_diameter=128*mm, inner_diameter=98*mm).analyse()
    >>> print(f"{tube.area / mm**2:.0f} mm^2, {tube.shear_stress / MPa:.3f} MPa, {tube.critical_speed / rpm:.1f} rpm")
    5325 mm^2, 83.564 MPa, 2974.7 rpm

    Raises ``ValueError`` for a quantity that is not positive, a bore as wide as the tube, a highest speed
    below the lowest, or a joint angle of 90 deg or more.
    """

    outer_diameter: float = quantity("D", 128.64, 108, 140, "mm", "tube, outside")
    inner_diameter: float = quantity("d", 101.78, 87, 103, "mm", "tube, inside")
    length: float = quantity("L", 2.41, 0.5, 5, "m", "between the joints")
    power: float = quantity("P", 257, 20, 600, "kW", "transmitted")
    service_factor: float = quantity("K_A", 1.5, 1, 3, "", "for shocks: torque over nominal torque")
    speed: float = quantity("n_min", 163, 50, 1000, "rpm", "lowest speed at full power; it sets the torque")
    max_speed: float = quantity("n_max", 1000, 100, 5000, "rpm", "highest speed")
    elastic_modulus: float = quantity("E", 206, 60, 220, "GPa", "Young's modulus")
    shear_modulus: float = quantity("G", 79.4, 20, 90, "GPa", "shear modulus")
    density: float = quantity("rho", 7850, 1500, 8000, "kg/m^3", "mass over volume; not printed in the paper")
    allowable_shear: float = quantity("tau_p", 98, 20, 300, "MPa", "shear stress that is allowed")
    allowable_twist: float = quantity("theta_p", 1, 0.1, 2, "deg/m", "twist over length that is allowed")
    speed_margin: float = quantity("s", 1.5, 1.25, 2, "", "critical speed over highest speed; the paper: 1.25 to 1.5")
    joint_angle: float = quantity("beta", 0, 0, 45, "deg", "of the joint before the tube; the paper: none", at_least=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if refuse := unless(self.inner_diameter < self.outer_diameter):
            refuse(
                f"the inner diameter is {self.inner_diameter / mm:.6g} mm; "
                f"it must be below the outer diameter of {self.outer_diameter / mm:.6g} mm"
            )
        if refuse := unless(self.speed <= self.max_speed):
            refuse(
                f"the lowest speed is {self.speed / rpm:.6g} rpm; "
                f"it must not be above the highest speed of {self.max_speed / rpm:.6g} rpm"
            )
        if refuse := unless(self.joint_angle < np.pi / 2):
            refuse(f"the joint angle is {self.joint_angle / deg:.6g} deg; a universal joint turns below 90 deg only")
        in_order = (self.inner_diameter < self.outer_diameter) & (self.speed <= self.max_speed)
        self._keep(in_order & (self.joint_angle < np.pi / 2))

    def made_of(self, name: str) -> UniversalJointShaft:
        """The same shaft of another of `MATERIALS`: moduli, density and allowable shear stress change.

        >>> from camkit import MPa
        >>> round(UniversalJointShaft().made_of("40Cr").allowable_shear / MPa, 1)
        142.5
        """
        if not isinstance(name, str) or name not in MATERIALS:
            raise ValueError(f"the material {shown(name)} is not known; there are {', '.join(MATERIALS)}")
        material = MATERIALS[name]
        properties = ("elastic_modulus", "shear_modulus", "density", "allowable_shear")
        return self.replace(**{p: getattr(material, p) for p in properties})

    @property
    def torque(self) -> Value:
        """In the shaft before the joint, ``M = 9550 K_A P / n`` with kW and rpm, N m: 0.0074 % above the exact one."""
        return TORQUE_NUMBER * self.service_factor * (self.power / kW) / (self.speed / rpm)

    @property
    def tube_torque(self) -> Array:
        """The maximum torque in the tube over a turn, ``M / cos(beta)``, N m.

        Behind a joint the torque swings between ``M cos(beta)`` and this, twice a turn.  The couple that the joint
        bends the tube with is nothing where the torque is largest: with ``psi`` the tube's angle from where it is
        least, torque and couple together are ``M / sqrt(1 - sin(beta)^2 sin(psi)^2)`` (Tresca), so this is the most
        of both.  A joint behind the tube with forks in phase adds nothing unless its angle is larger; see
        `DoubleUniversalJoint` for any other drive.
        """
        return self.torque / np.cos(self.joint_angle)

    @property
    def stiff_difference(self) -> Array:
        """``D^4 - d^4`` at which the twist is just what is allowed, m^4: ``32 M / (pi G theta_p cos(beta))``."""
        return 32 * self.tube_torque / (np.pi * self.shear_modulus * self.allowable_twist)

    def stiff_diameter(self, inner_diameter: Value) -> Array:
        """Outer diameter at which the twist is just what is allowed, m (see `stiff_difference`)."""
        bore = numbers(inner_diameter, "the inner diameters")
        with np.errstate(over="ignore"):
            return ((self.stiff_difference + bore**4) ** 0.25)[()]

    @property
    def twist_governs_below(self) -> Value:
        """Outer diameter up to which a tube that is stiff enough is strong enough, m: ``2 tau_p / (G theta_p)``."""
        return 2 * self.allowable_shear / (self.shear_modulus * self.allowable_twist)

    @property
    def sizes(self) -> TubeSizes:
        """Which diameters the shaft's other data allow, found once for all tubes that differ in these alone."""
        others = self.replace(**{name: float(np.mean(ends)) for name, ends in PAPER_SPACE.items()})
        refuse_population(others, "the shaft whose sizes are wanted")
        return _sizes(others)

    def analyse(self, n: int = 1) -> ShaftAnalysis:
        """Stresses, twist and speeds; ``n`` is there so that every design is analysed alike (a tube has no angle)."""
        return ShaftAnalysis(self)


def _measure(name: str, unit: str, of: Callable[[ShaftAnalysis], Value]) -> Measure:
    return Measure(name, unit, lambda a: np.max(of(a), axis=-1))


def _utilisation(of: str, limit: str) -> Measure:
    return _measure(f"utilisation of the {of}", "%", lambda a: a.utilisation[limit])


def _margin(use: Measure) -> Measure:
    return Measure(use.name.replace("utilisation", "margin"), "%", lambda a: 1 - use(a))


tube_area = _measure("area of the tube", "mm^2", lambda a: a.area)
tube_mass = _measure("mass of the tube", "kg", lambda a: a.mass)
tube_torque = _measure("maximum torque in the tube", "N m", lambda a: a.tube_torque)
shear_stress = _measure("shear stress", "MPa", lambda a: a.shear_stress)
twist = _measure("twist", "deg/m", lambda a: a.twist)
critical_speed = _measure("critical speed", "rpm", lambda a: a.critical_speed)
buckling_stress = _measure("buckling stress", "GPa", lambda a: a.buckling_stress)

shear_utilisation = _utilisation("shear stress", "shear stress")
twist_utilisation = _utilisation("twist", "twist")
speed_utilisation = _utilisation("critical speed", "critical speed")
buckling_utilisation = _utilisation("buckling stress", "buckling")

UTILISATIONS = (shear_utilisation, twist_utilisation, speed_utilisation, buckling_utilisation)
"""What each limit is used up by; 100 % is the limit."""

MARGINS = tuple(_margin(use) for use in UTILISATIONS)
"""What each limit leaves."""

TUBE_NUMBERS = (tube_area, tube_mass, tube_torque, shear_stress, twist, critical_speed, buckling_stress, *UTILISATIONS)
"""What a designer of the tube wants to read."""

SHAFT_MEASURES = (*TUBE_NUMBERS, *MARGINS)
"""Every measure of the tube, for tables."""
UniversalJointShaft.measures = SHAFT_MEASURES

PAPER_SPACE = {"outer_diameter": (108 * mm, 140 * mm), "inner_diameter": (87 * mm, 103 * mm)}
"""The paper's bounds."""

PLANE_WINDOW = np.array([[104, 84], [150, 124]]) * mm
"""What a picture of both diameters shows: the paper's bounds and what lies beyond them, ``(2, 2)``, m."""


def shaft_study(start: UniversalJointShaft | None = None, *, space: Space | None = None) -> Study:
    """The paper's problem: the least area that keeps shear stress, twist, critical speed and buckling stress.

    ``space`` maps free quantities to bounds in SI.

    >>> study = shaft_study()
    >>> study.evaluate([[128*mm, 98*mm]]).f.round(6).tolist(), study.evaluate([[128*mm, 98*mm]]).feasible.tolist()
    ([[0.005325]], [True])
    """
    refuse_arguments(shaft_study, locals())
    return Study(
        start=start or UniversalJointShaft(),
        free=space or PAPER_SPACE,
        minimise=(tube_area,),
        at_most=dict.fromkeys(UTILISATIONS, 1.0),
    )


def lightest_shaft(start: UniversalJointShaft | None = None, *, space: Space | None = None) -> UniversalJointShaft:
    """The lightest tube within bounds (``space`` as in `shaft_study`), in closed form where the twist governs.

    Stiffness fixes ``D^4 - d^4``, so the area ``pi/4 (D^4 - d^4) / (D^2 + d^2)`` falls as the bore grows: the
    bore is the widest that is allowed, or that leaves a tube of the widest ``D`` stiff enough.  The outer diameter
    follows (`UniversalJointShaft.stiff_diameter`); where it would be below its bound it is there.

    >>> tube = lightest_shaft()
    >>> print(f"{tube.outer_diameter / mm:.6f} mm, {tube.analyse().area / mm**2:.6f} mm^2")
    129.190698 mm, 4776.191895 mm^2
    >>> behind_a_joint = lightest_shaft(UniversalJointShaft(joint_angle=20*deg))
    >>> print(f"{behind_a_joint.outer_diameter / mm:.3f} mm")
    130.409 mm

    Raises ``ValueError`` where no tube within the bounds is stiff enough, or another limit than the twist governs.
    """
    study = shaft_study(start, space=space)
    start, space = study.start, study.free
    if set(space) != set(PAPER_SPACE):
        both = " and the ".join(map(words, PAPER_SPACE))
        raise ValueError(f"the space is {shown(space)}; it must have bounds of the {both}")
    (narrowest, widest), (min_bore, bore) = space["outer_diameter"], space["inner_diameter"]
    if widest**4 - min_bore**4 < start.stiff_difference:
        stiffest = start.replace(outer_diameter=widest, inner_diameter=min_bore).analyse()
        raise ValueError(
            f"even the stiffest tube within the bounds, {widest / mm:.6g} mm outside and {min_bore / mm:.6g} mm "
            f"inside, takes {100 * stiffest.utilisation['twist']:.4g} % of its limit on twist"
        )
    bore = min(bore, (widest**4 - start.stiff_difference) ** 0.25)
    tube = start.replace(outer_diameter=max(start.stiff_diameter(bore), narrowest), inner_diameter=bore)
    others = {name: use for name, use in tube.analyse().utilisation.items() if name != "twist"}
    worst = max(others, key=others.__getitem__)
    if others[worst] > 1:
        raise ValueError(
            f"the lightest tube that keeps the twist takes {100 * others[worst]:.4g} % of its limit on {worst}; "
            "the closed form holds where the twist governs"
        )
    return tube


def _refuse_tubes(function: Callable[..., object], given: Mapping[str, Any]) -> None:
    """``ValueError`` for tubes that are no array of two diameters each, and for another argument of a wrong kind."""
    refuse_arguments(function, given)
    shape = given["tubes"].shape
    if len(shape) != 2 or shape[1] != 2 or given["tubes"].dtype.kind not in "iuf":
        raise ValueError(f"the tubes are {shown(given['tubes'])}; they must be an array of both diameters, (n, 2)")


def tubes_that_hold(shaft: UniversalJointShaft, tubes: np.ndarray) -> np.ndarray:
    """Those of some tubes, ``(n, 2)`` m, with which ``shaft`` keeps every limit, whatever bounds there are.

    >>> len(tubes_that_hold(UniversalJointShaft(), standard_tubes()))
    52
    """
    _refuse_tubes(tubes_that_hold, locals())
    analysis = shaft.replace(outer_diameter=tubes[:, :1], inner_diameter=tubes[:, 1:]).analyse()
    return tubes[np.max(list(analysis.utilisation.values()), axis=0)[:, 0] <= 1]


def nearest_tube(shaft: UniversalJointShaft, tubes: np.ndarray) -> UniversalJointShaft:
    """``shaft`` with the standard tube whose two diameters lie nearest among those that keep every limit.

    >>> tube = nearest_tube(UniversalJointShaft(), standard_tubes("GB/T 17395"))
    >>> print(f"{tube.outer_diameter / mm:.0f} x {tube.inner_diameter / mm:.0f} mm")
    133 x 101 mm

    Raises ``ValueError`` if there is none.
    """
    holding = tubes_that_hold(shaft, tubes)
    if not len(holding):
        raise ValueError(f"none of the {len(tubes)} standard tubes keeps every limit")
    D, d = nearest_of(np.array([shaft.outer_diameter, shaft.inner_diameter]), holding)
    return shaft.replace(outer_diameter=float(D), inner_diameter=float(d))


def lightest_tube(study: Study, tubes: np.ndarray) -> UniversalJointShaft:
    """The standard tube with the least area within the bounds and limits of a `shaft_study`.

    Raises ``ValueError`` if there is none.
    """
    _refuse_tubes(lightest_tube, locals())
    low, high = study.bounds
    inside = tubes[((tubes >= low) & (tubes <= high)).all(-1)]
    evaluation = study.evaluate(inside) if len(inside) else None
    if evaluation is None or not evaluation.feasible.any():
        raise ValueError(
            f"none of the {len(inside)} standard tubes within {low[0] / mm:.4g} to {high[0] / mm:.4g} mm outside and "
            f"{low[1] / mm:.4g} to {high[1] / mm:.4g} mm inside keeps every limit"
        )
    return study.design(inside[np.argmin(np.where(evaluation.feasible, evaluation.f[:, 0], np.inf))])


@dataclass(frozen=True)
class TubeSizes:
    """Which diameters a shaft's power, speeds, length and material allow; its own diameters do not matter.

    >>> sizes = UniversalJointShaft().analyse().sizes
    >>> (1e3 * sizes.closed_form).round(4).tolist(), sizes is UniversalJointShaft(inner_diameter=90*mm).analyse().sizes
    ([129.1907, 103.0], True)
    """

    shaft: UniversalJointShaft

    @cached_property
    def plane(self) -> DesignMap:
        """The paper's problem over the plane of both diameters."""
        return DesignMap(shaft_study(self.shaft), PLANE_WINDOW)

    @property
    def limit_names(self) -> tuple[str, ...]:
        """The limits with what they allow, in the order of the study."""
        s, q = self.shaft, quantities_of(self.shaft)
        tau, theta = (q[n].text(value_of(s, n)) for n in ("allowable_shear", "allowable_twist"))
        speed = f"{s.speed_margin * s.max_speed / rpm:.4g} rpm"
        return f"shear stress {tau}", f"twist {theta}", f"critical speed {speed}", "buckling"

    @cached_property
    def closed_form(self) -> np.ndarray:
        """Both diameters of `lightest_shaft`, ``(2,)`` m; ``nan`` where there is none in closed form."""
        try:
            tube = lightest_shaft(self.shaft)
        except ValueError:
            return np.full(2, np.nan)
        return np.array([tube.outer_diameter, tube.inner_diameter])

    @cached_property
    def catalogue(self) -> dict[str, np.ndarray]:
        """The sizes of each series of `standard_tubes`, by the series' name."""
        return {series: standard_tubes(series) for series in TUBE_FILES}

    @cached_property
    def holding(self) -> dict[str, np.ndarray]:
        """`tubes_that_hold` of each series."""
        return {series: tubes_that_hold(self.shaft, tubes) for series, tubes in self.catalogue.items()}


_sizes = lru_cache(maxsize=16)(TubeSizes)
