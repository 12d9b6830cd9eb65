"""Round bars and tubes in space: the links of a linkage at its first position, and the tube of a shaft."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...linkage import RSSRAnalysis
from ...machines.shaft_analysis import ShaftAnalysis
from ...quantities.kinds import numbers, shown
from ...quantities.types import Array
from ...units import mm
from .skeleton import LINKS

BAR = 10 * mm
"""Diameter of the links, where nobody says another."""
Round = float | tuple[float, float]
"""The diameter of a bar, or the outer and the inner one of a tube, m."""


class Tube(NamedTuple):
    """A round bar along a straight line in space, m; with an inner diameter above 0 it is a tube."""

    name: str
    start: Array
    end: Array
    outer: float
    """Diameter."""
    inner: float = 0.0


def tubes_of(analysis: RSSRAnalysis | ShaftAnalysis, link: Round = BAR) -> tuple[Tube, ...]:
    """Crank, coupler and rocker at the first position, from joint to joint, or a shaft's tube along x from the origin.

    ``link`` is the diameter of the links, or the outer and the inner one; a shaft has diameters of its own.

    >>> from camkit import RSSR
    >>> [(tube.name, round(float(np.linalg.norm(tube.end - tube.start)), 6)) for tube in tubes_of(RSSR(0.02).analyse())]
    [('CRANK', 0.02), ('COUPLER', 0.18), ('ROCKER', 0.11)]
    """
    if isinstance(analysis, ShaftAnalysis):
        outer, inner = analysis.here.tolist()
        return (Tube("TUBE", np.zeros(3), np.array([analysis.shaft.length, 0.0, 0.0]), outer, inner),)
    outer, inner = _diameters(link)
    joints = analysis.chain[:, :, 0].T
    ends = zip(LINKS, joints, joints[1:], strict=False)
    return tuple(Tube(name, start, end, outer, inner) for name, start, end in ends)


def _diameters(link: object) -> tuple[float, float]:
    given = np.atleast_1d(numbers(link, "the diameter of the links (m)")).ravel()
    outer, inner = np.append(given, 0.0)[:2].tolist()
    if len(given) > 2 or not 0 <= inner < outer < np.inf:
        raise ValueError(
            f"the diameter of the links is {shown(link)}; it must be above 0, m, or an outer and an inner one"
        )
    return outer, inner
