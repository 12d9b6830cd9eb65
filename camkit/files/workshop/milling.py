"""How a cam is milled or ground: the tool, its feeds and depths, the control that reads the program."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from ...quantities import Design, choice, quantity, unless
from ...quantities.design import refuse_population
from ...units import mm, rpm

CLIMB, CONVENTIONAL = "climb", "conventional"
LINUXCNC, FANUC = "LinuxCNC", "Fanuc"
MOST_PASSES = 500
FLATTEST = 0.01 * mm
"""Less than this deep, or round, nothing is milled: as it is written it could be nothing."""


@dataclass(frozen=True)
class Milling(Design):
    """What a program for a milling machine or a grinding machine needs to know besides the cam.

    >>> Milling(step_down=3 * mm).levels(10 * mm)
    (-0.0025, -0.005, -0.0075, -0.01)
    """

    tool_radius: float = quantity("r_t", 5, 0.5, 150, "mm", "of the cutter or the grinding wheel")
    feed: float = quantity("v_f", 300, 10, 5000, "mm/min", "along the path", at_least=1)
    plunge_feed: float = quantity("v_z", 100, 5, 2000, "mm/min", "down to the depth of a pass", at_least=1)
    spindle_speed: float = quantity("n", 3000, 0, 30000, "rpm", "of the tool; 0: it is turned on by hand", at_least=0)
    depth: float = quantity("t", 0, 0, 100, "mm", "below the top; 0: of the whole cam, or of its groove", at_least=0)
    step_down: float = quantity("a_p", 2, 0.1, 100, "mm", "largest depth of one pass")
    safe_height: float = quantity("z_s", 5, 1, 100, "mm", "above the top, at which nothing is in the way", at_least=0.1)
    lead_in: float = quantity("r_l", 3, 0, 50, "mm", "radius of the arcs on to the path and off it", at_least=0)
    direction: str = choice("way", CLIMB, {name: name for name in (CLIMB, CONVENTIONAL)}, "tool turning clockwise")
    dialect: str = choice("dialect", LINUXCNC, {name: name for name in (LINUXCNC, FANUC)}, "of the control")

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_population(self, "the milling")
        if refuse := unless(not self.spindle_speed or self.spindle_speed >= 1 * rpm):
            refuse(f"the spindle speed is {self.spindle_speed / rpm:.4g} rpm; it must be 0 or at least 1 rpm")
        if refuse := unless(not self.lead_in or self.lead_in >= FLATTEST):
            refuse(f"the lead in is {self.lead_in / mm:.4g} mm; it must be 0 or at least {FLATTEST / mm:g} mm")

    def levels(self, depth: float) -> tuple[float, ...]:
        """The heights (m) of the passes down to a ``depth``, even steps, the last one at it."""
        if refuse := unless(depth >= FLATTEST):
            refuse(f"the depth is {depth / mm:.4g} mm; it must be at least {FLATTEST / mm:g} mm")
        passes = ceil(depth / self.step_down - 1e-9)
        if refuse := unless(passes <= MOST_PASSES):
            refuse(
                f"the step down is {self.step_down / mm:.4g} mm, {passes} passes for {depth / mm:.4g} mm; at most "
                f"{MOST_PASSES} are possible"
            )
        return tuple(-depth * k / passes for k in range(1, passes + 1))
