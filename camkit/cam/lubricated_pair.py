"""What is said of the contact of cam and follower: nothing, materials and width, or lubricant and strength as well."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeAlias

import numpy as np

from ..quantities import choice, quantity
from ..quantities.types import Value
from .film import Lubricant
from .force_closure import ContactPair, NoContact
from .life import NoBearing, RollerBearing, SurfaceStrength


@dataclass(frozen=True)
class LubricatedPair(ContactPair):
    """Materials, width, lubricant, roughness and strength: what film, wear and life follow from.

    >>> from camkit import TranslatingFlatCam
    >>> surfaces = TranslatingFlatCam(contact=LubricatedPair()).analyse().surfaces
    >>> print(f"{surfaces.film.max() * 1e6:.3f} um, {surfaces.film_ratio.max():.2f} of the roughness")
    0.421 um, 0.99 of the roughness
    """

    cam_roughness: float = quantity("R_q1", 0.3, 0.02, 3, "um", "root mean square roughness of the cam")
    follower_roughness: float = quantity("R_q2", 0.3, 0.02, 3, "um", "root mean square roughness of the follower")
    wanted_turns: float = quantity(
        "N", 1e8, 1e6, 1e10, "", "turns of the cam that its surface must bear", at_most=1e15, asked=True
    )
    lubricant: Lubricant = field(default_factory=Lubricant)
    strength: SurfaceStrength = field(default_factory=SurfaceStrength)
    """Of the weaker surface."""
    bearing: NoBearing | RollerBearing = choice(
        "C", NoBearing(), (NoBearing(), RollerBearing()), "in which the roller turns"
    )

    name: ClassVar[str] = "lubricated line"
    more: ClassVar[tuple[str, ...]] = ("surface_rates", "surfaces")
    offers: ClassVar[tuple[str, ...]] = (*ContactPair.offers, *more)

    @property
    def roughness(self) -> Value:
        """``sqrt(R_q1^2 + R_q2^2)``, m."""
        return np.hypot(self.cam_roughness, self.follower_roughness)

    @property
    def allowable(self) -> Value:
        """Pressure that the surface bears in every one of the turns, Pa."""
        return self.strength.allowable(self.wanted_turns)


AnyContact: TypeAlias = ContactPair | NoContact
"""What a cam may say of its contact."""


def contact_choice() -> Any:
    """A dataclass field for the contact of cam and follower, which a design need not give."""
    options = NoContact(), ContactPair(), LubricatedPair()
    return choice("C", options[0], options, "materials and width, for the pressure between them")
