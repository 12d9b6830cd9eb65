"""Return springs that can be bought or wound: what a spring does in a machine, and the weakest that holds contact.

In this house the load's ``spring_rate`` and ``preload`` are the return spring: what follower, cam and train are held
by.  A `HelicalSpring` says what that spring is made of; `fitted` gives a cam the rate and preload of one, so that both
agree, and a train's ``spring`` adds how its coils surge.

Source: Shigley, Mechanical Engineering Design (helical compression springs: clash allowance 15 %, index 4 to 12,
surge at 15 to 20 times the frequency of the machine, buckling, Zimmerli's endurance strength), cited from memory.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..data.spring_wires import spring_wires
from ..quantities import D, counted, quantities_of, refuse_design, refuse_population, with_quantities
from ..quantities.applied import applied
from ..quantities.kinds import numbers, one_number, refuse_arguments, refuse_empty, shown
from ..quantities.markup import table
from ..quantities.types import Array, Value
from ..units import MPa, mm
from .driven import Driven, bottom, driven
from .spring import HelicalSpring
from .steady import LEAST, response_of
from .trains import Train

CLASH, SURGE, SLENDER = 0.15, 15.0, 5.26
"""Deflection left to the solid length over the largest one, at least; first natural frequency of the spring over that
of the shaft, at least; free length over coil diameter above which a spring between flat ends may buckle."""
INDICES = 4.0, 12.0
ENDURED, PEENED = 241 * MPa, 398 * MPa
"""Alternating shear stress that springs endure for ever as they are wound, and shot-peened (Zimmerli)."""
RATES, SPEEDS, SLOWEST = 64, 40, 0.5
"""At so many rates and speeds the preload is found that an elastic train needs, from such a share of the fastest."""
SAMPLES = 360
"""Cam angles of a rigid follower at which its spring is asked for."""
COILS = np.array([8, 9, 10, 11.2, 12.5, 14, 16, 18, 20, 22.4, 25, 28, 31.5, 35.5, 40, 45, 50, 56, 63, 71, 80]) * mm
"""Mean diameters of the coil: preferred numbers, R 20."""
ACTIVE = np.arange(3, 12.5, 0.5)
"""Active coils, whole and half."""
MOST_COILS = 1000
SHOWN_ROWS = 12


class SpringDuty(NamedTuple):
    """What a spring does between its preload and the top of the travel: numbers, or one for each spring."""

    largest_force: Value
    """N."""
    free_length: Value
    """With the clash allowance left at the top of the travel, m."""
    preload_length: Value
    """Built in, at the level 0 of the travel, m."""
    pitch: Value
    """Of the free spring with closed and ground ends, m."""
    clash_margin: Value
    """Deflection left to the solid length over the largest one."""
    max_stress: Value
    """With Wahl's factor at the largest force, Pa."""
    mean_stress: Value
    alternating_stress: Value
    """Half of what the stress goes up and down, Pa."""
    slenderness: Value
    """Free length over the coil's diameter: above 5.26 it may buckle between flat ends."""


def spring_duty(spring: HelicalSpring, preload: Value, travel: Value, clash: float = CLASH) -> SpringDuty:
    """What a ``spring`` does that is built in with a ``preload`` (N) and compressed by the ``travel`` (m) besides.

    Its free length leaves the share ``clash`` of the largest deflection to the solid length.

    >>> duty = spring_duty(HelicalSpring(), preload=300, travel=8 * mm)
    >>> print(f"{duty.largest_force:.1f} N, free {duty.free_length / mm:.2f} mm, {duty.max_stress / MPa:.1f} MPa")
    454.1 N, free 59.11 mm, 613.6 MPa

    Raises ``ValueError`` for a preload or travel below 0 and for a clash that is not from 0 to 1.
    """
    refuse_arguments(spring_duty, locals())
    clash = one_number(clash, "the clash allowance", "be from 0 to 1", lambda share: 0 <= share <= 1)
    F, h = numbers(preload, "the preload"), numbers(travel, "the travel")
    for what, value in (("preload", F), ("travel", h)):
        if not (value[np.isfinite(value)] >= 0).all():
            raise ValueError(f"the {what} of the spring is {shown(value[()])}; it must be at least 0")
    rate, solid, d = spring.rate, spring.solid_length, spring.wire
    most = F + rate * h
    free = solid + (1 + clash) * most / rate
    low, high = spring.stress(F), spring.stress(most)
    return SpringDuty(
        most,
        free,
        free - F / rate,
        (free - (spring.total_coils - spring.active_coils) * d) / spring.active_coils,
        clash + 0.0 * most,
        high,
        (low + high) / 2,
        (high - low) / 2,
        free / spring.coil,
    )


class NearSurge(NamedTuple):
    """Harmonics of a lift near the surge of a spring."""

    ratio: float
    """First natural frequency of the spring over that of the shaft."""
    number: Array
    amplitude: Array
    """m or rad."""


def near_surge(spring: HelicalSpring, analysis: Any, around: int = 2) -> NearSurge:
    """Which harmonics of the motion are near the first natural frequency of a spring, and how large they are.

    >>> from camkit import TranslatingFlatCam
    >>> near = near_surge(HelicalSpring(), TranslatingFlatCam().analyse())
    >>> print(f"{near.ratio:.1f}", near.number)
    60.8 [59 60 61 62 63]

    Raises ``ValueError`` for what is no analysis of one cam that turns.
    """
    refuse_arguments(near_surge, locals())
    around = counted(around, "harmonics on either side", 0, 1000)
    with applied("the surge", analysis):
        refuse_population(analysis, "the cam")
        given = driven(analysis, LEAST)
        if not float(given.speed[0]) > 0:
            raise ValueError("the cam is at rest; nothing makes its spring surge")
        sizes = 2 * abs(np.fft.rfft(given.travel)) / LEAST
        ratio = float(2 * np.pi * spring.surge_frequency / given.speed[0])
    number = np.round(ratio) + np.arange(-around, around + 1)
    number = number[(number >= 1) & (number < len(sizes))].astype(int)
    return NearSurge(ratio, number, sizes[number])


@dataclass(frozen=True, repr=False)
class ReturnSprings:
    """Springs of a search, those that serve first and of these the weakest; arrays ``(p,)`` go with each other."""

    wire: Array
    coil: Array
    active_coils: Array
    preload: Array
    """The least that keeps the follower on the cam up to the speed margin, N."""
    duty: SpringDuty
    surge_ratio: Array
    """First natural frequency over that of the shaft at its speed."""
    why_not: Array
    """Why it does not serve, as text; empty where it does."""

    def __len__(self) -> int:
        return len(self.wire)

    @property
    def serve(self) -> Array:
        """Which of them serve."""
        return self.why_not == ""

    def __getitem__(self, i: int) -> HelicalSpring:
        return HelicalSpring(*(float(x[i]) for x in (self.wire, self.coil, self.active_coils, self.active_coils + 2)))

    def __repr__(self) -> str:
        return f"{int(self.serve.sum())} of {len(self)} springs serve, the weakest first"

    def _repr_html_(self) -> str:
        head = ("d [mm]", "D [mm]", "active coils", "preload [N]", "largest force [N]", "free length [mm]",
                "stress [MPa]", "f_1 / f", "")  # fmt: skip
        sizes = self.wire / mm, self.coil / mm, self.active_coils, self.preload
        does = self.duty.largest_force, self.duty.free_length / mm, self.duty.max_stress / MPa, self.surge_ratio
        cells = np.stack([*sizes, *does], axis=-1)[:SHOWN_ROWS]
        rows = [(*(f"{x:.4g}" for x in row), str(why)) for row, why in zip(cells, self.why_not, strict=False)]
        return table(head, rows, repr(self))


def return_springs(
    analysis: Any,
    train: Train | None = None,
    margin: float = 0.15,
    wire: str = "EN 10270-1 SM",
    coils: ArrayLike = COILS,
    active_coils: ArrayLike = ACTIVE,
    max_outside: float | None = None,
    max_length: float | None = None,
    peened: bool = False,
) -> ReturnSprings:
    """Real springs for a sliding follower: the weakest that holds it on the cam ``margin`` above its speed.

    All combinations of standard wires (see `camkit.data.spring_wires`), mean ``coils`` (m) and ``active_coils`` with an
    index from 4 to 12, two more coils closed and ground, each with the least preload that keeps contact, of a rigid
    follower with a third of the spring's mass or of an elastic ``train`` without it.  Of these serve those whose stress
    is allowed and endured (shot-peened: 398 MPa of alternating stress in place of 241), whose surge is at least 15
    times the shaft's frequency, that cannot buckle, and that are within ``max_outside`` and ``max_length`` (m);
    ``why_not`` says what the others lack.

    >>> from camkit import TranslatingFlatCam
    >>> from camkit.quantities import with_quantities
    >>> cam = with_quantities(TranslatingFlatCam(), {"load.mass": 2.0, "load.speed": 63.0})
    >>> found = return_springs(cam.analyse())
    >>> print(f"{1e3 * found.wire[0]:.1f} mm, {found.duty.largest_force[0]:.0f} N, {found.serve.sum()} of {len(found)}")
    3.6 mm, 315 N, 941 of 6441

    Raises ``ValueError`` for a cam whose follower is on an arm or whose shaft rests, and for a grid without a spring.
    """
    refuse_arguments(return_springs, locals())
    margin = one_number(margin, "the speed margin", "be a finite number of at least 0", lambda x: 0 <= x < 1e3)
    with applied("the search for return springs", analysis):
        refuse_population(analysis, "the cam")
        held = _Held.of(analysis, LEAST if train else SAMPLES)
    wires = spring_wires(wire)
    place, coil, n = _grid(wires.diameter, coils, active_coils)
    d = wires.diameter[place]
    columns: list[Any] = [x[:, None] for x in (d, coil, n, n + 2)]
    spring = HelicalSpring(*columns)
    bears = np.ravel(spring_duty(spring, 0.0, held.travel).max_stress) <= wires.shear[place]
    preload = held.elastic(train, spring, margin, bears) if train else held.rigid(spring, margin)
    duty = SpringDuty(*(np.ravel(x) for x in spring_duty(spring, preload[:, None], held.travel)))
    ratio = np.ravel(spring.surge_frequency) * 2 * np.pi / held.speed
    reasons = {
        "no preload keeps contact": ~np.isfinite(preload),
        "the stress at the largest force is too large": duty.max_stress > wires.shear[place],
        "the alternating stress is not endured for ever": duty.alternating_stress > PEENED,
        "the alternating stress is endured shot-peened only": (duty.alternating_stress > ENDURED) & (not peened),
        "its coils surge: f_1 below 15 shaft frequencies": ratio < SURGE,
        "it may buckle": duty.slenderness > SLENDER,
        "it is too wide": coil + d > (np.inf if max_outside is None else max_outside),
        "it is too long": duty.free_length > (np.inf if max_length is None else max_length),
    }
    why = np.select(list(reasons.values()), list(reasons), "")
    order = np.lexsort((np.asarray(duty.largest_force), why != ""))
    ordered = SpringDuty(*(np.asarray(x)[order] for x in duty))
    return ReturnSprings(d[order], coil[order], n[order], preload[order], ordered, ratio[order], why[order])


def _grid(wires: Array, coils: ArrayLike, active_coils: ArrayLike) -> tuple[Array, Array, Array]:
    """Place of the wire, coil and active coils of all springs with a possible index; ``ValueError`` for none."""
    asked = (coils, "the coil diameters"), (active_coils, "the active coils")
    sizes = [numbers(given, what).ravel() for given, what in asked]
    place, coil, n = (x.ravel() for x in np.meshgrid(np.arange(len(wires)), *sizes, indexing="ij"))
    index = coil / wires[place]
    fits = (index >= INDICES[0]) & (index <= INDICES[1]) & (n >= 1) & (n < MOST_COILS)
    refuse_empty(coil[fits], "springs with an index from 4 to 12 in the grid")
    return place[fits], coil[fits], n[fits]


class _Held(NamedTuple):
    """A sliding follower without its spring."""

    given: Driven
    free: Array
    """What holds it besides the spring, at each cam angle, N."""
    height: Array
    """Travel from the motion's level 0, m."""
    speed: float

    @classmethod
    def of(cls, analysis: Any, samples: int) -> _Held:
        if not analysis.acceleration_unit.startswith("mm"):
            raise ValueError("the follower is on an arm; the springs of the search push a sliding one")
        given = driven(analysis, samples)
        if not float(given.speed[0]) > 0:
            raise ValueError("the cam is at rest; a spring is found for one that turns")
        height = given.level + given.travel
        spring = analysis.preload + given.rate * given.level
        return cls(given, given.preload + given.load - spring, height, float(given.speed[0]))

    @property
    def travel(self) -> float:
        """The highest level, m."""
        return float(max(self.height.max(), 0.0))

    def rigid(self, spring: HelicalSpring, margin: float) -> Array:
        """The least preload of each spring with a third of its mass on the follower, N."""
        given, top = self.given, (1 + margin) * self.speed
        moving = (
            given.mass + spring.active_mass / 3
        ) * given.acceleration * top**2 + given.damping * top * given.velocity
        lacks = -(self.free + spring.rate * self.height + np.minimum(moving, 0.0))
        return np.maximum(lacks.max(-1), 0.0)

    def elastic(self, train: Train, spring: HelicalSpring, margin: float, bears: Array) -> Array:
        """The same behind a train, to which the rate alone counts: found at a few rates and speeds, straight between.

        The rates are those of springs that bear the travel alone (``bears``).
        """
        given, rate, top = self.given, np.ravel(spring.rate), (1 + margin) * self.speed
        some = rate[bears] if bears.any() else rate
        rates = np.geomspace(some.min(), some.max(), RATES)
        speeds = np.geomspace(SLOWEST, 1.0, SPEEDS) * top
        k, turns = (x.reshape(-1, 1) for x in np.meshgrid(rates, speeds, indexing="ij"))
        least = []
        for rows in np.array_split(np.arange(len(k)), RATES):  # of so many the series stay in the processor's cache
            alone = replace(given, rate=k[rows], preload=self.free[:1] + k[rows] * given.level)
            least.append(bottom(response_of(train, alone, turns[rows]).resistance))
        lacks = -np.concatenate(least).reshape(RATES, SPEEDS).min(-1)
        return np.maximum(np.interp(np.log(rate), np.log(rates), lacks), 0.0)


def fitted(cam: D, spring: HelicalSpring, preload: Value) -> D:
    """The ``cam``, or cam with a train, whose load has the rate of ``spring`` and its ``preload`` (N).

    >>> from camkit import TranslatingFlatCam
    >>> fitted(TranslatingFlatCam(), HelicalSpring(), 200.0).load.spring_rate == HelicalSpring().rate
    True

    Raises ``ValueError`` for a design whose load has no spring.
    """
    refuse_design(cam, "the cam")
    refuse_arguments(fitted, locals())
    paths = {name: [p for p in quantities_of(cam) if p.endswith(f"load.{name}")] for name in ("spring_rate", "preload")}
    if not all(paths.values()):
        raise ValueError(f"the design is {shown(cam)}; it must have a load with a spring")
    return with_quantities(cam, {paths["spring_rate"][0]: spring.rate, paths["preload"][0]: preload})
