"""A mechanism that no program can be made of: it asks for the truth of a number."""

from dataclasses import dataclass

import numpy as np

from camkit import mm
from camkit.quantities import Design, quantity
from camkit.study import AnalysisCurve


@dataclass(frozen=True)
class Stubborn(Design):
    x: float = quantity("x", 1, 0.1, 4, "mm", "a length")

    def analyse(self, n=5):
        return Stubbornly(self)


@dataclass(frozen=True)
class Stubbornly:
    cam: Stubborn
    cam_angle = np.linspace(0, 1, 5)
    offers = (AnalysisCurve("height", "mm", "height"),)

    @property
    def height(self):
        return self.cam.x * (self.cam_angle if self.cam.x > 2 * mm else 2 * self.cam_angle)
