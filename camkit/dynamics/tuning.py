"""An elastic train by its natural periods in the first stroke and its damping ratio, in place of stiffness and damping.

Source: Norton, Cam Design and Manufacturing Handbook (dynamics of cam systems: period ratio).
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from ..motion.closing import TURN
from ..quantities import unless
from ..quantities.applied import applied
from ..quantities.kinds import a_number, shown
from ..quantities.types import Array, Value
from .driven import Analysed, column
from .trains import ElasticArm, ElasticTrain

T = TypeVar("T", ElasticTrain, ElasticArm)

MOST = 1e4
"""A period ratio or a damping ratio above this is a slip."""


def first_stroke(analysis: Analysed) -> Array:
    """``beta``: cam angle of the first segment that moves, rad, ``(1,)`` or ``(p, 1)``; ``nan`` if none does."""
    motion = analysis.cam.motion
    moves = [i for i, segment in enumerate(motion.segments) if not segment.still]
    return column(motion.starts[moves[0] + 1] - motion.starts[moves[0]]) if moves else np.array([np.nan])


def tuned(train: T, analysis: Analysed, period_ratio: Value, damping_ratio: Value = 0.05) -> T:
    """The ``train`` as stiff and damped as makes so many natural periods of the first stroke of a cam.

    With ``period_ratio`` ``tau`` the train swings at ``omega_n = 2 pi tau omega / beta``: ``beta`` is the angle of the
    first segment that moves, ``omega`` the speed of the ``analysis``.  Then ``k_f = m omega_n^2 - k_s``, and ``c_f =
    2 zeta m omega_n - c_s``.  Columns ``(p, 1)`` make a population.

    >>> from camkit import HighSpeedCam
    >>> train = tuned(ElasticArm(), HighSpeedCam().analyse(), period_ratio=5)
    >>> print(f"{train.stiffness:.1f} N m/rad")
    3974.6 N m/rad

    The cam above has its speed as a share of the rated one: its stiffness is in N m/rad all the same, its damping is
    what a damper has times the rated speed.

    Raises ``ValueError`` for a train of several masses, where return spring or damping to the frame alone are more than
    that, for a cam at rest or without a stroke, and where an elastic train does not apply.
    """
    if not isinstance(train, (ElasticTrain, ElasticArm)):
        raise ValueError(f"the train is {shown(train)}; it must be an ElasticTrain or an ElasticArm")
    must = f"be a finite number above 0 and at most {MOST:g}"
    tau = column(a_number(period_ratio, "the period ratio", must, lambda x: (x > 0) & (x <= MOST)))
    must = f"be a finite number from 0 to {MOST:g}"
    zeta = column(a_number(damping_ratio, "the damping ratio", must, lambda x: (x >= 0) & (x <= MOST)))
    with applied("an elastic train", analysis):
        beta, turns = first_stroke(analysis), column(analysis.speed)
        if refuse := unless(_all((turns > 0) & (beta > 0))):
            refuse("the cam is at rest or without a stroke; natural periods are counted while it moves the follower")
        mass, rate = column(analysis.inertia) - train.cam_side_mass, column(analysis.closing_rate)
        ground = train.ground_damping + column(getattr(analysis, "damping", 0.0))
    frequency = tau * TURN * turns / beta
    stiffness, damping = mass * frequency**2 - rate, 2 * zeta * mass * frequency - ground
    if refuse := unless(_all(stiffness > 0)):
        refuse(
            f"a period ratio of {tau.item():.6g} takes {(stiffness + rate).item():.6g} of both springs, the return "
            f"spring alone has {rate.item():.6g} (N/m, of an arm N m/rad); the period ratio must be larger"
        )
    if refuse := unless(_all(damping >= 0)):
        refuse(
            f"a damping ratio of {zeta.item():.6g} takes a damping of {(damping + ground).item():.6g}, that to the "
            f"frame alone is {ground.item():.6g} (N s/m, of an arm N m s/rad); the damping ratio must be larger"
        )
    return train.replace(stiffness=_number(stiffness), damping=_number(damping))


def _all(ok: Array) -> Array:
    """The answer of one design; those of a population as they are."""
    return ok[0] if ok.ndim == 1 else ok


def _number(value: Array) -> Value:
    """One number, or a column of them."""
    return float(value[0]) if value.ndim == 1 else value
