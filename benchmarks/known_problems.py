"""Three published design problems with known optima, for comparing optimisers.

They are stated as published, in the sources' own units (cm, inches, pounds, psi).  Every limit is a utilisation
that must be at most 1.  A design this small is its own analysis.
Of the speed reducer 1 random design in 1000 is feasible, of the tension spring 7: they are narrow by intent.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from camkit.quantities import Design, Measure, Quantity, declarations, quantity, unless
from camkit.study.study import Study


@dataclass(frozen=True)
class KnownProblem:
    """A study whose optimum is known.

    >>> at_optimum = tension_spring.study.evaluate(tension_spring.x)
    >>> at_optimum.f.round(9).tolist(), at_optimum.feasible.tolist()
    ([[0.012665233]], [True])
    """

    name: str
    source: str
    study: Study
    x: tuple[float, ...]
    """Free values at the optimum, all digits; every limit is kept."""
    f: float
    """The optimum as the literature prints it."""


def _study(start: Design, cost: str, *limits: str) -> Study:
    def measure(name: str) -> Measure:
        return Measure(name.replace("_", " "), "", lambda a: np.max(getattr(a, name), axis=-1))

    limited = {measure(name): 1.0 for name in limits}
    type(start).measures = (measure(cost), *limited)
    ranges = {name: (q.low, q.high) for name, q in declarations(start).items() if isinstance(q, Quantity)}
    return Study(start, ranges, (measure(cost),), limited)


@dataclass(frozen=True)
class SpeedReducer(Design):
    """Gear pair of a light aircraft's speed reducer: the least volume of gears and shafts (Golinski 1970).

    The number of teeth is taken as continuous; at the optimum it is at its lower bound, a whole number.
    """

    face_width: float = quantity("b", 3.6, 2.6, 3.6, "", "face width of the gears, cm")
    module: float = quantity("m", 0.7, 0.7, 0.8, "", "module of the teeth, cm")
    teeth: float = quantity("z", 17, 17, 28, "", "teeth of the pinion")
    first_length: float = quantity("l_1", 8.0, 7.3, 8.3, "", "first shaft between its bearings, cm")
    second_length: float = quantity("l_2", 8.0, 7.3, 8.3, "", "second shaft between its bearings, cm")
    first_diameter: float = quantity("d_1", 3.5, 2.9, 3.9, "", "first shaft, cm")
    second_diameter: float = quantity("d_2", 5.4, 5.0, 5.5, "", "second shaft, cm")

    def analyse(self, n: int = 1) -> SpeedReducer:
        """The design itself."""
        return self

    @cached_property
    def volume(self) -> Any:
        """Of gears and shafts, cm^3."""
        b, m, z, d1, d2 = self.face_width, self.module, self.teeth, self.first_diameter, self.second_diameter
        gears = 0.7854 * b * m**2 * (3.3333 * z**2 + 14.9334 * z - 43.0934) - 1.508 * b * (d1**2 + d2**2)
        shafts = 7.4777 * (d1**3 + d2**3) + 0.7854 * (self.first_length * d1**2 + self.second_length * d2**2)
        return gears + shafts

    @property
    def tooth_bending(self) -> Any:
        """Bending stress of the teeth."""
        return 27 / (self.face_width * self.module**2 * self.teeth)

    @property
    def tooth_contact(self) -> Any:
        """Contact stress of the teeth."""
        return 397.5 / (self.face_width * self.module**2 * self.teeth**2)

    @property
    def first_deflection(self) -> Any:
        """Deflection of the first shaft."""
        return 1.93 * self.first_length**3 / (self.module * self.teeth * self.first_diameter**4)

    @property
    def second_deflection(self) -> Any:
        """Deflection of the second shaft."""
        return 1.93 * self.second_length**3 / (self.module * self.teeth * self.second_diameter**4)

    @property
    def first_stress(self) -> Any:
        """Stress of the first shaft."""
        bending = 745 * self.first_length / (self.module * self.teeth)
        return np.sqrt(bending**2 + 16.9e6) / (110 * self.first_diameter**3)

    @property
    def second_stress(self) -> Any:
        """Stress of the second shaft."""
        bending = 745 * self.second_length / (self.module * self.teeth)
        return np.sqrt(bending**2 + 157.5e6) / (85 * self.second_diameter**3)

    @property
    def pitch_diameter(self) -> Any:
        """Of the pinion."""
        return self.module * self.teeth / 40

    @property
    def least_width(self) -> Any:
        """Face width of at least 5 modules."""
        return 5 * self.module / self.face_width

    @property
    def largest_width(self) -> Any:
        """Face width of at most 12 modules."""
        return self.face_width / (12 * self.module)

    @property
    def first_fit(self) -> Any:
        """Room for the first shaft's bearings."""
        return (1.5 * self.first_diameter + 1.9) / self.first_length

    @property
    def second_fit(self) -> Any:
        """Room for the second shaft's bearings."""
        return (1.1 * self.second_diameter + 1.9) / self.second_length


@dataclass(frozen=True)
class TensionSpring(Design):
    """Coil spring in tension or compression: the least weight (Belegundu 1982; default: Arora 1989).

    Raises ``ValueError`` for a wire as thick as the coil.
    """

    wire: float = quantity("d", 0.053396, 0.05, 2.0, "", "diameter of the wire, in")
    coil: float = quantity("D", 0.39918, 0.25, 1.3, "", "mean diameter of the coil, in")
    turns: float = quantity("N", 9.1854, 2.0, 15.0, "", "active turns")

    def __post_init__(self) -> None:
        super().__post_init__()
        if refuse := unless(self.wire < self.coil):
            refuse(f"the wire d is {self.wire:g} in thick; it must be below the coil's {self.coil:g} in")

    def analyse(self, n: int = 1) -> TensionSpring:
        """The design itself."""
        return self

    @cached_property
    def weight(self) -> Any:
        """``(N + 2) D d^2``, weight up to a factor; ``nan`` for a wire as thick as the coil."""
        return np.where(self.wire < self.coil, (self.turns + 2) * self.coil * self.wire**2, np.nan)[()]

    @property
    def deflection(self) -> Any:
        """Least deflection under the load."""
        return 71785 * self.wire**4 / (self.coil**3 * self.turns)

    @property
    def shear_stress(self) -> Any:
        """Shear stress under the load."""
        d, D = self.wire, self.coil
        with np.errstate(divide="ignore", invalid="ignore"):
            return (4 * D**2 - d * D) / (12566 * (D * d**3 - d**4)) + 1 / (5108 * d**2)

    @property
    def surge(self) -> Any:
        """Least frequency of surge."""
        return self.coil**2 * self.turns / (140.45 * self.wire)

    @property
    def outer_diameter(self) -> Any:
        """Largest outer diameter, 1.5 in."""
        return (self.wire + self.coil) / 1.5


@dataclass(frozen=True)
class WeldedBeam(Design):
    """Bar welded to a support: the least cost of weld and bar (default: Ragsdell, Phillips 1976).

    Of the versions in print this is the one of Coello Coello (2000), with seven limits, ``l^2 / 12`` in the weld's
    polar moment and the optimum 1.724852.

    >>> round(WeldedBeam().cost, 4)  # as Ragsdell and Phillips print it: 2.385937
    2.3859
    """

    weld: float = quantity("h", 0.2455, 0.1, 2.0, "", "thickness of the weld, in")
    joint: float = quantity("l", 6.196, 0.1, 10.0, "", "length of the weld, in")
    height: float = quantity("t", 8.273, 0.1, 10.0, "", "height of the bar, in")
    thickness: float = quantity("b", 0.2455, 0.1, 2.0, "", "thickness of the bar, in")

    load = 6000.0
    """lb"""
    overhang = 14.0
    """in"""

    def analyse(self, n: int = 1) -> WeldedBeam:
        """The design itself."""
        return self

    @cached_property
    def cost(self) -> Any:
        """Of weld and bar, dollars."""
        bar = 0.04811 * self.height * self.thickness * (self.overhang + self.joint)
        return 1.10471 * self.weld**2 * self.joint + bar

    @property
    def weld_stress(self) -> Any:
        """Shear stress of the weld, of 13600 psi: direct ``tau'`` and from the moment ``tau''``."""
        h, l = self.weld, self.joint
        direct = self.load / (np.sqrt(2) * h * l)
        radius = np.sqrt(l**2 / 4 + ((h + self.height) / 2) ** 2)
        polar = 2 * np.sqrt(2) * h * l * (l**2 / 12 + ((h + self.height) / 2) ** 2)
        moment = self.load * (self.overhang + l / 2) * radius / polar
        return np.sqrt(direct**2 + direct * moment * l / radius + moment**2) / 13600

    @property
    def bending_stress(self) -> Any:
        """``6 P L / (b t^2)``, of 30000 psi."""
        return 6 * self.load * self.overhang / (self.thickness * self.height**2) / 30000

    @property
    def weld_on_bar(self) -> Any:
        """The weld is no thicker than the bar."""
        return self.weld / self.thickness

    @property
    def budget(self) -> Any:
        """Cost, counted with the weld's material alone, of 5 dollars."""
        bar = 0.04811 * self.height * self.thickness * (self.overhang + self.joint)
        return (0.10471 * self.weld**2 + bar) / 5

    @property
    def least_weld(self) -> Any:
        """The weld is at least 0.125 in thick."""
        return 0.125 / self.weld

    @property
    def sag(self) -> Any:
        """Deflection of the bar's end, ``4 P L^3 / (E b t^3)``, of 0.25 in."""
        return 2.1952 / (self.thickness * self.height**3) / 0.25

    @property
    def buckling(self) -> Any:
        """Load over the load at which the bar buckles."""
        t, b, L, E, G = self.height, self.thickness, self.overhang, 30e6, 12e6
        limit = 4.013 * E * np.sqrt(t**2 * b**6 / 36) / L**2 * (1 - t / (2 * L) * np.sqrt(E / (4 * G)))
        return self.load / limit


speed_reducer = KnownProblem(
    "speed reducer",
    "J. Golinski, J. Mechanisms 5 (1970) 287-309; optimum: Mezura-Montes, Coello Coello, MICAI 2005 and later",
    _study(
        SpeedReducer(),
        "volume",
        "tooth_bending",
        "tooth_contact",
        "first_deflection",
        "second_deflection",
        "first_stress",
        "second_stress",
        "pitch_diameter",
        "least_width",
        "largest_width",
        "first_fit",
        "second_fit",
    ),
    (3.5, 0.7, 17.0, 7.3, 7.715319911478247, 3.350214666096448, 5.286654464980223),
    2994.471066,
)

tension_spring = KnownProblem(
    "tension spring",
    "A. D. Belegundu, Univ. of Iowa 1982; J. S. Arora, Introduction to Optimum Design, 1989",
    _study(TensionSpring(), "weight", "deflection", "shear_stress", "surge", "outer_diameter"),
    (0.0516890610827635, 0.35671773979944094, 11.2889657516134),
    0.012665232,
)

welded_beam = KnownProblem(
    "welded beam",
    "Ragsdell, Phillips, J. Eng. Ind. 98 (1976) 1021-1025; version of Coello Coello, Comput. Ind. 41 (2000) 113-127",
    _study(
        WeldedBeam(),
        "cost",
        "weld_stress",
        "bending_stress",
        "weld_on_bar",
        "budget",
        "least_weld",
        "sag",
        "buckling",
    ),
    (0.20572963978607949, 3.470488665628002, 9.036623910357634, 0.20572963978607949),
    1.724852311,
)

KNOWN_PROBLEMS = (speed_reducer, tension_spring, welded_beam)
"""The three problems."""
