"""The body that carries the cam: how thick it is, its bore with a keyway, its hub."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...data import load
from ...quantities import Design, choice, quantity, unless
from ...quantities.design import refuse_population
from ...units import factor, inch, mm

NONE, DIN, ANSI = "none", "DIN 6885-1", "ANSI B17.1"


class Keyway(NamedTuple):
    """A parallel keyway in a bore, m: its width, and how deep it is below the bore's circle at its middle."""

    width: float
    depth: float


@dataclass(frozen=True)
class Blank(Design):
    """What a cam is cut from; the cam's axis is the bore's, and angle 0 of the cam is that of the drawing.

    >>> from camkit.units import mm
    >>> Blank(bore=20 * mm, key=DIN).keyway
    Keyway(width=0.006, depth=0.0028)
    """

    thickness: float = quantity("b", 10, 2, 100, "mm", "of the cam")
    bore: float = quantity("d", 12, 0, 100, "mm", "diameter of the bore; 0: none", at_least=0)
    key: str = choice("key", NONE, {name: name for name in (NONE, DIN, ANSI)}, "standard of the keyway")
    key_angle: float = quantity("phi_k", 0, -180, 180, "deg", "direction of the keyway on the cam", above=None)
    hub_diameter: float = quantity("D_h", 0, 0, 200, "mm", "of the hub; 0: none", at_least=0)
    hub_length: float = quantity("l_h", 10, 0, 100, "mm", "of the hub beyond the cam", at_least=0)
    groove_depth: float = quantity("t_g", 6, 1, 60, "mm", "of the follower's groove, if there is one")
    outer_diameter: float = quantity(
        "D", 0, 0, 500, "mm", "of a cam with a groove; 0: a wall as thick as the groove is deep", at_least=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_population(self, "the blank")
        if refuse := unless(self.key == NONE or self.keyway is not None):
            refuse(f"the bore is {self.bore / mm:.4g} mm, for which {self.key} has no key: {_range_of(self.key)}")
        if refuse := unless(not self.hub_diameter or self.hub_diameter > self.reach):
            refuse(
                f"the hub diameter is {self.hub_diameter / mm:.4g} mm; with its keyway the bore takes "
                f"{self.reach / mm:.4g} mm"
            )

    @property
    def keyway(self) -> Keyway | None:
        """The standard's for this bore; ``None``: there is none."""
        if self.key == NONE:
            return None
        standard = load("keyways")[self.key]
        worth = factor(standard["unit"])
        for over, to, width, *depth in standard["rows"]:
            if over * worth < self.bore <= to * worth * (1 + 1e-12):
                return Keyway(width * worth, depth[0] * worth if depth else _depth_of_a_square_key(self.bore, width))
        return None

    @property
    def reach(self) -> float:
        """Twice the largest distance of bore and keyway from the axis, m."""
        keyway = self.keyway
        return self.bore if keyway is None else 2 * float(np.hypot(self.bore / 2 + keyway.depth, keyway.width / 2))


def _depth_of_a_square_key(bore: float, width: float) -> float:
    """From the bore's circle: ``T - D`` with ``T = (D - H + sqrt(D^2 - W^2)) / 2 + H + .005 in`` and ``H = W``."""
    w = width * inch
    return float((bore - w + np.sqrt(bore**2 - w**2)) / 2 + w + 0.005 * inch - bore)


def _range_of(key: str) -> str:
    """For which bores a standard has keys."""
    standard = load("keyways")[key]
    rows, unit = standard["rows"], standard["unit"]
    return f"it has them over {rows[0][0]:g} and up to {rows[-1][1]:g} {unit}"
