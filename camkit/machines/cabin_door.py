"""The RSSR linkage of a ship's cabin door: a crank sweeps, the door on the rocker opens.

Source: Liu Jianwei, Geng Kaizhen, Ship Sci. Technol. 41(6) 2019, 143-146.  The paper does not print the distance
and the angle of the axes, the crank's sweep or the branch; the defaults here are intersecting axes at 90 deg, 15 to
105 deg and branch +1.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property

import numpy as np

from ..linkage.load import RockerLoad
from ..linkage.measures import (
    JOINTS,
    MAKERS,
    SWEEP,
    assembly_margin,
    clearance_from,
    departure,
    excess,
    max_crank_ball_angle,
    max_departure,
    max_pressure_angle,
    max_rocker_ball_angle,
    room_in,
    swing,
)
from ..linkage.rssr import RSSR, Links
from ..linkage.rssr_analysis import RSSRAnalysis
from ..linkage.rubbing import LinkageFriction
from ..linkage.space import Box
from ..quantities import Measure, choice, counted, quantity, unless
from ..quantities.kinds import refuse_arguments, shown
from ..study.study import Space, Study
from ..units import deg, mm

PAPER_SPACE = {
    "crank": (80 * mm, 120 * mm),
    "coupler": (120 * mm, 250 * mm),
    "rocker": (90 * mm, 130 * mm),
    "crank_offset": (20 * mm, 200 * mm),
    "rocker_offset": (20 * mm, 150 * mm),
}
"""The paper's free quantities and their bounds."""

PAPER_POSITIONS = 30
"""Crank angles that the paper sums over."""


HOUSING = Box((-120 * mm, -20 * mm, -20 * mm), (120 * mm, 120 * mm, 120 * mm), "the housing")
"""Space for the centre lines of the linkage of `ninety_degree_study`; both axes cross at its long side.

What has a thickness needs as much more on every side: ball joints of 12 mm radius 264 x 164 x 164 mm.
"""


class Branch(IntEnum):
    """The two ways to assemble a linkage: the sign of the arc cosine."""

    plus = 1
    minus = -1


@dataclass(frozen=True)
class CabinDoorLinkage(Links):
    """An `RSSR` linkage with the sweep that its crank makes and the door that its rocker carries.

    >>> door = CabinDoorLinkage(80*mm, 141.914*mm, 130*mm, 136.787*mm, 100.344*mm)
    >>> print(f"{departure()(door.analyse(30)) / deg:.2f} deg, opens {swing(door.analyse(30)) / deg:.1f} deg")
    213.30 deg, opens 53.7 deg

    Raises ``ValueError`` for a size that cannot be built; `analyse` does for a sweep that cannot be assembled.
    """

    measures = (*SWEEP, *JOINTS, excess(), max_departure(), max_pressure_angle, room_in(HOUSING))
    makers = MAKERS

    start_angle: float = quantity(
        "phi_a", 15, -180, 180, "deg", "crank angle with the door shut", above=None, asked=True
    )
    end_angle: float = quantity(
        "phi_b", 105, -180, 360, "deg", "crank angle with the door open", above=None, asked=True
    )
    branch: int = choice("", Branch.plus, tuple(Branch), "which of the two ways it is assembled")
    load: RockerLoad = field(default_factory=RockerLoad)
    friction: LinkageFriction = field(default_factory=LinkageFriction)

    def __post_init__(self) -> None:
        if not isinstance(self.branch, int) or self.branch not in tuple(Branch):
            raise ValueError(f"the branch is {shown(self.branch)}; it must be +1 or -1")
        object.__setattr__(self, "branch", Branch(self.branch))
        super().__post_init__()
        if refuse := unless(self.start_angle != self.end_angle):
            refuse(
                f"the crank sweeps from {self.start_angle / deg:.5g} to {self.end_angle / deg:.5g} deg; it must move"
            )

    @cached_property
    def linkage(self) -> RSSR:
        """The linkage alone."""
        return RSSR(*self.sizes)

    def analyse(self, n: int = 181) -> RSSRAnalysis:
        """Positions, motion and static forces at ``n`` crank angles from shut to open, both included.

        A sweep that passes an angle at which the linkage cannot be assembled is refused, whether or not it is one
        of the ``n``; such a member of a population is ``nan``.
        """
        share = np.linspace(0, 1, counted(n, "crank angles"))
        sweep = self.start_angle + share * (self.end_angle - self.start_angle)
        return self.linkage.analyse(sweep, self.branch, self.load, self.friction, through=True)


def rssr_study(
    start: CabinDoorLinkage | None = None,
    objective: Measure | None = None,
    *,
    space: Space | None = None,
    min_swing: float | None = None,
    ball_angle: float | None = None,
    inside: Box | None = None,
    outside: Box | None = None,
    positions: int = PAPER_POSITIONS,
) -> Study:
    """The paper's synthesis: pressure angles near 30 deg at both ball joints over the crank's sweep.

    ``objective`` is `departure` unless said otherwise (`excess`, `max_departure`, `max_pressure_angle`, ...).  The door
    turns by ``min_swing`` or more; both ball joints need half a cone of at most ``ball_angle``; the centre lines of all
    links stay ``inside`` one box and ``outside`` another.
    The discriminant must not fall below 0 between the positions either, so both branches are continuous.
    ``space`` maps free quantities to bounds in SI.

    >>> study = rssr_study()
    >>> paper = study.evaluate(np.array([[80, 141.914, 130, 136.787, 100.344]]) * mm)
    >>> (paper.f / deg).round(2).tolist(), paper.feasible.tolist()
    ([[213.3]], [True])
    """
    refuse_arguments(rssr_study, locals())
    swung = {} if min_swing is None else {swing: min_swing}
    balls = {} if ball_angle is None else dict.fromkeys((max_crank_ball_angle, max_rocker_ball_angle), ball_angle)
    housed = {} if inside is None else {room_in(inside): 0.0}
    clear = {} if outside is None else {clearance_from(outside): 0.0}
    return Study(
        start=start or CabinDoorLinkage(),
        free=space or PAPER_SPACE,
        minimise=(objective or departure(),),
        at_most=balls,
        at_least={assembly_margin: 0.0, **swung, **housed, **clear},
        angles=positions,
    )


def ninety_degree_study() -> Study:
    """A door that opens 90 deg, its linkage in a small housing: the least steep pressure angles.

    The paper's bounds, sweep and positions, but the paper's optimum opens 53.7 deg only.  A closer pulls the door
    of 30 kg shut with 10 N m, and as the ship heels by 10 deg it opens uphill; the rocker angle falls as it opens.
    Some 3 of 1000 random designs keep the limits: the housing leaves 1 in 30 its room, and few of these open so far.

    >>> study = ninety_degree_study()
    >>> whole_mm = study.evaluate(np.array([120, 120, 120, 99, 99]) * mm)
    >>> (whole_mm.f / deg).round(1).tolist(), whole_mm.feasible.tolist()
    ([[42.2]], [True])
    """
    door = RockerLoad(mass=30, reach=400 * mm, lean=10 * deg, downhill=280 * deg, torque=-10)
    return rssr_study(CabinDoorLinkage(load=door), max_pressure_angle, min_swing=90 * deg, inside=HOUSING)
