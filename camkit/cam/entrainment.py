"""How the surfaces of cam and follower run through their contact: what draws a lubricant in, and what slides.

With ``K`` the point of contact and ``t`` the direction in which the cam's surface runs,

    u_1 = (v_cam - dK/dt) t,  u_2 = (v_follower - dK/dt) t,  U = (u_1 + u_2) / 2

A roller rolls, so both are the length of the profile that passes: ``omega g (1 - r kappa)``, ``g`` the pitch curve's
length per rad.  Under a flat face ``u_1 = omega rho`` times how fast the cam turns past the face, and the rest slides.
Where ``U`` changes sign, nothing is drawn in: there is no steady film.

Source: Norton, Cam Design and Manufacturing Handbook (cam materials and lubrication); Johnson, Contact Mechanics (1.5).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..quantities import refuse_population
from ..quantities.applied import applied
from ..quantities.kinds import a_number
from ..quantities.types import Array, Value
from .force_closure import FASTEST

if TYPE_CHECKING:
    from .analysis import CamAnalysis

HALVINGS = 45
"""Of a step between two cam angles, in which the entrainment velocity changes sign."""


class Entrainment(NamedTuple):
    """Velocities of both surfaces past their contact, m/s, along the direction in which the cam's surface runs."""

    cam: Array
    """``u_1``."""
    follower: Array
    """``u_2``."""

    @property
    def velocity(self) -> Array:
        """``U``: entrainment velocity, the mean of both."""
        return (self.cam + self.follower) / 2

    @property
    def sliding(self) -> Array:
        """``u_1 - u_2``."""
        return self.cam - self.follower


def entrainment(analysis: CamAnalysis, speed: Value | None = None) -> Entrainment:
    """Of any cam, at its cam angles, with the cam turning at ``speed`` (rad/s; its own).

    >>> from camkit import TranslatingFlatCam
    >>> fast = entrainment(TranslatingFlatCam().analyse())
    >>> print(f"{fast.velocity.min():.3f} to {fast.velocity.max():.3f} m/s, sliding up to {fast.sliding.max():.3f} m/s")
    -0.145 to 1.401 m/s, sliding up to 1.571 m/s

    Raises ``ValueError`` for a speed that is none, and where a high-speed cam does not say its rated speed.
    """
    with applied("the entrainment", analysis):
        if speed is None:
            return analysis.surfaces.entrainment
        must = f"be a finite number of at least 0 and at most {FASTEST:g}"
        speed = a_number(speed, "the speed of the cam", must, lambda w: (w >= 0) & (w <= FASTEST))
        return at_speed(speed, analysis.surface_rates)


def at_speed(speed: Value, rates: tuple[Array, Array]) -> Entrainment:
    """Of a cam that turns at ``speed`` (rad/s), by its ``surface_rates`` (m)."""
    along, past = rates
    return Entrainment(speed * along, speed * (along - past))


def reversals(analysis: CamAnalysis) -> Array:
    """The cam angles (rad) of one design at which the entrainment velocity changes sign, in order.

    There the film breaks down for a moment, however thick it is beside.

    >>> from camkit import TranslatingFlatCam, TranslatingRollerCam
    >>> np.degrees(reversals(TranslatingFlatCam().analyse())).round(3)
    array([ 77.491, 100.123, 199.877, 222.509])
    >>> reversals(TranslatingRollerCam().analyse())
    array([], dtype=float64)

    Raises ``ValueError`` for a population.
    """
    refuse_population(analysis, "where the entrainment changes sign")
    with applied("the entrainment", analysis):
        shown = analysis.resolved
        angle, positive = shown.cam_angle, _drawn_in(shown) > 0
        at = np.flatnonzero(positive[1:] != positive[:-1])
        low, high, side = angle[at], angle[at + 1], positive[at]
        for _ in range(HALVINGS if len(at) else 0):
            middle = (low + high) / 2
            same = (_drawn_in(analysis.at(middle)) > 0) == side
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return (low + high) / 2


def _drawn_in(analysis: CamAnalysis) -> Array:
    """``2 U`` per speed of the cam, m."""
    along, past = analysis.surface_rates
    return 2 * along - past
