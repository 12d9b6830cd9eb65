"""Elastic trains between cam and load: masses and springs in series.

The cam moves the near end of the train by ``s``; each spring ``k_i`` with its damper ``c_i`` moves the mass behind it.
The last mass ``x`` is held by the return spring ``k_s`` of the load and by a damper ``c_s`` to the frame, and bears
the load ``q``.  A mass ``m_0`` at the cam follows it rigidly.  ``x = 0`` is the assembled rest at the cam angle 0,
where the train is already compressed by what resists there, ``N_0``.

Source: Norton, Cam Design and Manufacturing Handbook (dynamics of cam systems); Koster, Vibrations of Cam Mechanisms.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from ..quantities import Design, Quantity, choice, numbered, quantity, row
from ..quantities.kinds import a_number, listed, refuse_lengths
from ..quantities.types import Array, Value
from .spring import HelicalSpring, MasslessSpring

if TYPE_CHECKING:
    from .driven import Analysed
    from .steady import Response

SPRINGS = MasslessSpring(), HelicalSpring()
"""What a return spring can be, for a menu."""


def spring_choice() -> Any:
    """A dataclass field for the return spring of a train."""
    return choice("S", SPRINGS[0], SPRINGS, "return spring; its rate is the load's")


class Train(Design, ABC):
    """What every elastic train shares: how it follows a cam; one mass behind one spring, unless there are more."""

    damping: Value | tuple[Value, ...]
    masses: tuple[Value, ...] = ()
    """Between the springs, kg or kg m^2; what is left of the load's mass is behind the last spring."""
    ground_damping: Value
    cam_side_mass: Value
    spring: MasslessSpring | HelicalSpring

    @property
    @abstractmethod
    def stiffness(self) -> Value | tuple[Value, ...]:
        """Of each spring, N/m, of an arm N m/rad."""

    @property
    def springs(self) -> Sequence[tuple[Value, Value]]:
        """Stiffness and damping of each spring, that at the cam first: N/m, N s/m (of an arm N m/rad, N m s/rad)."""
        each = (given if isinstance(given, tuple) else (given,) for given in (self.stiffness, self.damping))
        return tuple(zip(*each, strict=True))

    @property
    def static_stiffness(self) -> Value:
        """``k_f`` of all springs in series: ``1 / k_f = sum 1 / k_i``, N/m or N m/rad."""
        return 1 / sum(1 / stiffness for stiffness, _ in self.springs)

    def follow(self, analysis: Analysed, speed: Value | None = None, samples: int | None = None) -> Response:
        """Steady motion behind the cam of an ``analysis`` that turns at ``speed`` (rad/s; that of its load).

        It is found at so many even ``samples`` of a turn: 11520 of one design, 720 of several, more where it takes
        them.  Columns ``(p, 1)`` in the cam or in the train are a population; a column of speeds for one design gives
        a row for each.

        >>> from camkit import TranslatingFlatCam
        >>> response = ElasticTrain().follow(TranslatingFlatCam().analyse())
        >>> print(f"{response.dynamic_factor:.3f}")
        1.002
        """
        from .steady import respond

        return respond(self, analysis, speed, samples)


@dataclass(frozen=True)
class ElasticTrain(Train):
    """One mass behind a spring: a pushrod, a stem, a rocker before a sliding load.

    Its mass is that of the cam's load, less what follows the cam rigidly.

    Raises ``ValueError`` for a stiffness that is not above 0 and for damping or masses below 0.
    """

    stiffness: float = quantity("k_f", 800, 10, 20000, "N/mm", "between cam and load", name="train stiffness")
    damping: float = quantity("c_f", 100, 0, 1000, "N s/m", "of the train", at_least=0, name="train damping")
    ground_damping: float = quantity(
        "c_s", 0, 0, 200, "N s/m", "between load and frame", at_least=0, name="damping to the frame"
    )
    cam_side_mass: float = quantity(
        "m_0", 0, 0, 5, "kg", "of the load's mass, what follows the cam rigidly", at_least=0, name="mass at the cam"
    )
    spring: MasslessSpring | HelicalSpring = spring_choice()

    name: ClassVar[str] = "one mass"


@dataclass(frozen=True)
class ElasticArm(Train):
    """One moment of inertia behind a spring, for a rocking arm: what an `ElasticTrain` is on a slide."""

    stiffness: float = quantity("k_f", 1500, 10, 50000, "N m/rad", "between cam and load", name="train stiffness")
    damping: float = quantity("c_f", 0.3, 0, 50, "N m s/rad", "of the train", at_least=0, name="train damping")
    ground_damping: float = quantity(
        "c_s", 0, 0, 5, "N m s/rad", "between load and frame", at_least=0, name="damping to the frame"
    )
    cam_side_mass: float = quantity(
        "J_0", 0, 0, 0.1, "kg m^2", "of the load's inertia, what follows the cam rigidly", at_least=0,
        name="inertia at the cam",
    )  # fmt: skip
    spring: MasslessSpring | HelicalSpring = spring_choice()

    name: ClassVar[str] = "one inertia, on an arm"


STIFFNESS = Quantity("k", 800, 10, 20000, "N/mm", "of a spring of the train", name="train stiffness")
DAMPING = Quantity("c", 100, 0, 1000, "N s/m", "of a spring of the train", at_least=0, name="train damping")
MASS = Quantity("m", 0.5, 0.01, 10, "kg", "between two springs of the train", name="train mass")


@dataclass(frozen=True)
class TrainChain(Train):
    """Several masses in series: tappet, pushrod, rocker, valve.

    ``stiffness`` and ``damping`` of the springs from the cam to the load, ``masses`` between them; what is left of the
    load's mass is behind the last spring.

    >>> chain = TrainChain((2e6, 1.2e6), (60, 50), (0.5,))
    >>> print(f"{chain.static_stiffness:.0f} N/m")
    750000 N/m

    Raises ``ValueError`` for numbers that a spring or a mass cannot have, and where there are not as many dampers as
    springs and one mass less.
    """

    stiffness: tuple[Value, ...] = row(numbered("stiffness", STIFFNESS, 1), default=(2e6, 1.2e6))
    damping: tuple[Value, ...] = row(numbered("damping", DAMPING, 1), default=(60.0, 50.0))
    masses: tuple[Value, ...] = row(numbered("mass", MASS, 1), default=(0.1,))
    ground_damping: float = quantity(
        "c_s", 0, 0, 200, "N s/m", "between load and frame", at_least=0, name="damping to the frame"
    )
    cam_side_mass: float = quantity(
        "m_0", 0, 0, 5, "kg", "of the load's mass, what follows the cam rigidly", at_least=0, name="mass at the cam"
    )
    spring: MasslessSpring | HelicalSpring = spring_choice()

    name: ClassVar[str] = "masses in series"

    def __post_init__(self) -> None:
        for name, declared in (("stiffness", STIFFNESS), ("damping", DAMPING), ("masses", MASS)):
            object.__setattr__(self, name, _row(getattr(self, name), name, declared))
        springs, dampers, masses = len(self.stiffness), len(self.damping), len(self.masses)
        if not springs or dampers != springs or masses != springs - 1:
            raise ValueError(
                f"the chain has {springs} springs, {dampers} dampers and {masses} masses between them; it must have "
                "one spring or more, a damper for each, and one mass less"
            )
        super().__post_init__()
        refuse_lengths(self)


def _row(given: object, name: str, declared: Quantity) -> tuple[Value, ...]:
    """The numbers of a row as its declaration allows them."""
    read = listed(given, f"the {name} of the chain")
    what = f"one of the {name} of the chain"
    return tuple(a_number(value, what, f"be {declared.possible}", declared.allows) for value in read)


class Passed(NamedTuple):
    """What a train passes on, as series of harmonics."""

    force: Array
    """Of the first spring and its damper, less ``N_0``."""
    end: Array
    """Motion of the last mass."""
    whole: Array
    """What resists a motion of the first mass with the cam's end held; 0 at resonance."""


def passed(train: Train, mass: Array, rate: Array, ground: Value, frequency: Array, load: Array, lift: Array) -> Passed:
    """What a train passes on between the series of ``s`` (``lift``) and of ``q`` (``load``), at ``n omega`` (rad/s).

    ``ground`` is the damping of the last ``mass`` to the frame.  From the load to the cam each part adds its own: where
    ``A`` resists a motion behind a spring ``K``, ``K A / (K + A)`` does before it.
    """
    even = np.arange(frequency.shape[-1]) < frequency.shape[-1] - 1
    rubs, throws = 1j * (frequency * even), frequency**2  # the last harmonic of an even number has no derivative
    springs = [k + c * rubs for k, c in train.springs]
    masses = [*train.masses, mass]
    behind = rate * train.spring.share(frequency / (2 * np.pi)) + ground * rubs
    each = []
    with np.errstate(divide="ignore", invalid="ignore"):
        for K, m in zip(springs[::-1], masses[::-1], strict=True):
            resists = behind - m * throws
            whole = K + resists
            yields = 1 / whole
            share = K * yields
            each.append((share, load * yields))
            behind, load = share * resists, share * load
        end = lift
        for share, loaded in each[::-1]:
            end = share * end - loaded
    return Passed(behind * lift + load, end, whole)


def natural_modes(train: Train, mass: Array, rate: Array, ground: Value) -> tuple[Array, Array]:
    """Natural frequencies (rad/s) of a train with its end on the cam, the lowest first, and their damping ratios.

    A return spring counts with its rate alone.  ``(k,)``, or ``(p, k)``; ``nan`` where the load has no mass left.
    """
    masses = np.broadcast_arrays(*(np.atleast_1d(m)[..., 0] for m in (*train.masses, mass)), rate[..., 0])[:-1]
    M = np.stack([np.where(m > 0, m, np.nan) for m in masses], axis=-1)
    stiff, rub = (series_matrix([part[i] for part in train.springs], end)
                  for i, end in ((0, rate), (1, ground)))  # fmt: skip
    scale = 1 / np.sqrt(M[..., :, None] * M[..., None, :])
    given = np.broadcast_to(stiff * scale, np.broadcast_shapes(np.shape(stiff), scale.shape))
    possible = np.isfinite(given).all((-2, -1), keepdims=True)
    square, shape = np.linalg.eigh(np.where(possible, given, np.eye(given.shape[-1])))
    square, shape = np.where(possible[..., 0], square, np.nan), np.where(possible, shape, np.nan)
    frequency = np.sqrt(square)
    damping = ((rub * scale) @ shape * shape).sum(-2)
    return frequency, damping / (2 * frequency)


def series_matrix(parts: list[Value], end: Value) -> Array:
    """Of springs (or dampers) in a row from the cam to the last mass, and one from there to the frame."""
    each = np.broadcast_arrays(*(np.atleast_1d(x)[..., 0] for x in (*parts, end)))
    n = len(parts)
    rows = [[0.0 * each[0]] * n for _ in range(n)]
    for i in range(n):
        rows[i][i] = each[i] + each[i + 1]
        if i:
            rows[i][i - 1] = rows[i - 1][i] = -each[i]
    return np.stack([np.stack(r, axis=-1) for r in rows], axis=-2)
