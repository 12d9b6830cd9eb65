"""Spatial four-bar linkage with two turning and two ball joints, in the order R-S-S-R.

The crank turns about the z axis.  The x axis is the common perpendicular of both axes, ``h_0`` long; the rocker's
axis stands on its far end and has the direction ``(0, sin L, cos L)``.  Crank and rocker angle count from the x
axis, right-handed about their own axes.  Crank and rocker lie ``s_0`` and ``s_3`` along their axes from the x axis.

Formulas after Liu Jianwei, Geng Kaizhen, Ship Sci. Technol. 41(6) 2019, 143-146, with the last term of the closure
constant and the rocker's direction of motion put right, and checked against brute-force geometry.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np

from ..geometry import vector
from ..quantities import Design, Quantity, counted, declarations, quantity, unless
from ..quantities.kinds import numbers, one_number, shown
from ..quantities.known import certain
from ..quantities.types import Array, Value
from . import limits
from .load import RockerLoad
from .rssr_analysis import RSSRAnalysis
from .rubbing import LinkageFriction

FEWEST = 61
"""Positions of a whole turn: with fewer, what is worst between them would be missed."""


def _angles(crank_angle: Value) -> np.ndarray:
    """Crank angles as an array, ``nan`` for those that are not finite."""
    angles = numbers(crank_angle, "the crank angles")
    return angles if certain(np.isfinite(angles)) else np.where(np.isfinite(angles), angles, np.nan)


@dataclass(frozen=True)
class Links(Design):
    """The sizes of an RSSR linkage, which a bare linkage and a machine with one have in common."""

    crank: float = quantity("l_1", 100, 20, 300, "mm", "crank: axis to ball joint")
    coupler: float = quantity("l_2", 180, 50, 500, "mm", "coupler: ball joint to ball joint")
    rocker: float = quantity("l_3", 110, 20, 300, "mm", "rocker: axis to ball joint")
    crank_offset: float = quantity(
        "s_0", 120, -300, 300, "mm", "crank along its axis from the common perpendicular", above=None
    )
    rocker_offset: float = quantity(
        "s_3", 80, -300, 300, "mm", "rocker along its axis from the common perpendicular", above=None
    )
    axis_distance: float = quantity("h_0", 0, 0, 300, "mm", "common perpendicular of both axes", at_least=0)
    axis_angle: float = quantity("L", 90, 0, 180, "deg", "between both axes", above=None)

    @property
    def sizes(self) -> tuple[float, ...]:
        """``l_1, l_2, l_3, s_0, s_3, h_0, L``."""
        lengths = (self.crank, self.coupler, self.rocker, self.crank_offset, self.rocker_offset, self.axis_distance)
        return *lengths, self.axis_angle


@dataclass(frozen=True)
class RSSR(Links):
    """Spatial linkage: crank, coupler between two ball joints, rocker (Liu, Geng 2019).

    >>> from camkit import deg, mm
    >>> linkage = RSSR(100*mm, 180*mm, 110*mm, 120*mm, 80*mm, axis_distance=0.0, axis_angle=90*deg)
    >>> print(np.degrees(linkage.analyse([0, 60*deg]).rocker_angle).round(6))
    [237.596379 195.880281]
    >>> print(np.degrees(linkage.limit_angles()).round(6))
    [265.623052 274.376948]
    >>> print(np.degrees(np.ptp(linkage.replace(crank=20*mm).analyse().rocker_angle)).round(3))
    23.462

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a crank angle that cannot be reached.
    """

    @property
    def has_possible_sizes(self) -> Array:
        """Whether every size is allowed; a population holds them unchecked."""
        declared = declarations(self).items()
        return reduce(np.logical_and, [q.allows(getattr(self, k)) for k, q in declared if isinstance(q, Quantity)])

    def closure(self, crank_angle: Value) -> tuple[Array, Array, Array]:
        """``A, B, K`` of ``A sin(phi_3) + B cos(phi_3) + K = 0``: the ball joints are ``l_2`` apart.

        The print lacks ``1 / l_1`` in the last term, which only shows where the axes are not at 90 deg.
        """
        l1, l2, l3, s0, s3, h0, L = self.sizes
        angle = _angles(crank_angle)
        sin, cos = np.sin(angle), np.cos(angle)
        a = s0 * np.sin(L) / l1 - np.cos(L) * sin
        b = h0 / l1 - cos
        k = (l1**2 + l3**2 + s0**2 + s3**2 + h0**2 - l2**2) / (2 * l1 * l3)
        return a, b, k - (s3 * np.sin(L) * sin + h0 * cos + s0 * s3 * np.cos(L) / l1) / l3

    def discriminant(self, crank_angle: Value) -> Array:
        """``A^2 + B^2 - K^2``; the linkage can be assembled where it is not negative."""
        a, b, k = self.closure(crank_angle)
        return a**2 + b**2 - k**2

    def assembles(self, crank_angle: Value) -> Array:
        """Whether the coupler reaches from crank to rocker, crank angle by crank angle."""
        return limits.reaches(*self.closure(crank_angle))

    @cached_property
    def _harmonics(self) -> np.ndarray:
        return limits.harmonics(self.discriminant)

    @cached_property
    def all_limit_angles(self) -> np.ndarray:
        """The limit angles, ``(..., 4)``, filled up with ``nan``."""
        return limits.zeros(self._harmonics)

    def limit_angles(self) -> np.ndarray:
        """Crank angles at which the linkage is stretched out or folded, growing, in [0, 2 pi): none, 2 or 4.

        For ``p`` designs ``(p, 4)``, filled up with ``nan``.
        """
        angles = self.all_limit_angles
        return angles if angles.ndim > 1 else angles[np.isfinite(angles)]

    @cached_property
    def extreme_angles(self) -> np.ndarray:
        """Crank angles at which the discriminant is least or largest, ``(..., 4)``, ``nan`` where there are fewer."""
        return limits.zeros(limits.slope(self._harmonics))

    @property
    def full_turn(self) -> Array:
        """Whether the crank can turn all the way round: the discriminant is positive everywhere; ``(p,)`` for ``p``."""
        extremes = np.where(np.isnan(self.extreme_angles), 0.0, self.extreme_angles)
        return self.discriminant(extremes).min(-1) > limits.ROUNDING

    def possible_crank_angles(self) -> np.ndarray:
        """Ranges of crank angles, one design, ``(k, 2)``, rad: ``[[0, 2 pi]]`` for a full turn, ``k = 0`` for none.

        A range that passes 0 begins below 0.
        """
        return self.all_possible_crank_angles[np.isfinite(self.all_possible_crank_angles[:, 0])]

    @cached_property
    def all_possible_crank_angles(self) -> np.ndarray:
        """The same filled up with ``nan``, ``(2, 2)``."""
        turn, missing = 2 * np.pi, np.isnan(self.all_limit_angles)
        ends = np.where(missing, np.where(missing[:1], 0.0, self.all_limit_angles[:1]), self.all_limit_angles)
        starts = np.append(ends[:1], ends[1:] + np.where(missing[1:], turn, 0.0))
        ranges = np.stack([starts, np.append(starts[1:], starts[:1] + turn)], axis=-1)
        possible = self._assembles_between(ranges)
        possible = np.where(missing, possible[:1], possible)
        before = np.roll(possible, 1)
        low, high = (np.sort(np.where(begins, ends, np.nan))[:2] for begins in (possible & ~before, before & ~possible))
        past_zero = (high[0] < low[0]) & (low == np.fmax.reduce(low))
        parts = np.stack([np.sort(low - np.where(past_zero, turn, 0.0)), high], axis=-1)
        return np.where(possible.all(), np.stack([[0.0, turn], [np.nan, np.nan]]), parts)

    def _assembles_between(self, ranges: Array) -> Array:
        """Whether the linkage can be assembled in ranges ``(k, 2)`` of crank angles that begin and end at a limit.

        Asked where the discriminant is farthest from 0, because two limits that merge may be found as none or as one.
        """
        low, high = ranges[:, :1], ranges[:, 1:]
        inside = low + (high - low) * np.arange(1, 8) / 8
        farthest = np.argmax(abs(self.discriminant(inside)), axis=-1)[:, None]
        return self.assembles(np.take_along_axis(inside, farthest, -1))[:, 0]

    @cached_property
    def crank_root(self) -> np.ndarray:
        """Where the crank stands on its axis, ``(3,)``, m."""
        return vector(0.0, 0.0, self.crank_offset)

    @cached_property
    def rocker_root(self) -> np.ndarray:
        """Where the rocker stands on its axis, ``(3,)``, m."""
        s3, L = self.rocker_offset, self.axis_angle
        return vector(self.axis_distance, s3 * np.sin(L), s3 * np.cos(L))

    @property
    def crank_axis(self) -> np.ndarray:
        """Direction of the crank's axis."""
        return vector(0.0, 0.0, 1.0)

    @cached_property
    def rocker_axis(self) -> np.ndarray:
        """Direction of the rocker's axis."""
        return vector(0.0, np.sin(self.axis_angle), np.cos(self.axis_angle))

    def crank_direction(self, angle: Value) -> np.ndarray:
        """Unit vector across the crank's axis at ``angle`` about it."""
        return vector(np.cos(angle), np.sin(angle), 0.0)

    def rocker_direction(self, angle: Value) -> np.ndarray:
        """Unit vector across the rocker's axis at ``angle`` about it."""
        sin, L = np.sin(angle), self.axis_angle
        return vector(np.cos(angle), np.cos(L) * sin, -np.sin(L) * sin)

    def analyse(
        self,
        crank_angle: Value = 361,
        branch: int = 1,
        load: RockerLoad | None = None,
        friction: LinkageFriction | None = None,
        *,
        through: bool = False,
        turning: int | None = None,
    ) -> RSSRAnalysis:
        """Positions, motion and static forces at the given crank angles (rad).

        A whole number of 2 or more in place of angles is how many there are over one turn, both ends included, as
        every other design is analysed; it must be 61 or more, as measures are found at these positions alone.  An
        angle in rad is a ``float``.

        There are two ways to assemble a linkage: ``branch`` +1 or -1, the sign of the arc cosine.  ``through``: the
        crank passes all angles between the given ones too, so that the linkage has to be assembled there as well.
        What rubs does so against the way the crank turns: from the first angle to the last, unless ``turning`` is +1 or
        -1.
        """
        one_number(branch, "the branch", "be +1 or -1", lambda sign: sign in (1, -1))
        if turning is not None:
            one_number(turning, "the way the crank turns", "be +1 or -1", lambda sign: sign in (1, -1))
        if not (load is None or isinstance(load, RockerLoad)):
            raise ValueError(f"the load is {shown(load)}; it must be a RockerLoad")
        if not (friction is None or isinstance(friction, LinkageFriction)):
            raise ValueError(f"the friction is {shown(friction)}; it must be a LinkageFriction")
        if not isinstance(through, (bool, np.bool_)):
            raise ValueError(f"through is {shown(through)}; it must be True or False")
        if isinstance(crank_angle, (int, np.integer)) and crank_angle >= 2:
            crank_angle, through = np.linspace(0, 2 * np.pi, counted(crank_angle, "crank angles", FEWEST)), True
        try:
            angles = np.atleast_1d(_angles(crank_angle))
        except ValueError:
            angles = np.zeros(0)
        if refuse := unless(angles.size and (angles.ndim > 1 or np.isfinite(angles).all())):
            refuse("the crank angles must be one or more finite numbers")
        friction = friction or LinkageFriction()
        analysis = RSSRAnalysis(self, angles, branch, load or RockerLoad(), through, friction, turning)
        analysis.refuse_impossible()
        return analysis
