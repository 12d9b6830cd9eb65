"""What a person is told of a cam that the follower, or the tool in its place, would cut away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..quantities import text_if
from ..quantities.types import Array
from ..units import deg, mm
from .flank import Cut

INNER, OUTER, ONLY = "inner flank", "outer flank", "profile"
"""What the flanks of a groove are called, and that of a plate."""
CUTS = "Undercut: the follower cuts away {}."


def undercut_in_words(analysis: object, cuts: Sequence[Cut] = ()) -> str:
    """What is undercut, at which cam angle, and which walls of a groove merge; empty if nothing is lost.

    The sentence of screen and files.  ``cuts`` are told where nothing else is: what `flank.flanks` found.

    Of a flank it says how much larger the least convex radius of curvature would have to be: how far it lies below 0,
    which under a roller is by how much the roller's radius is larger than that of its path.  How far the follower then
    stays from its place is another, smaller number, which `flank.flanks` finds.

    >>> from camkit import TranslatingRollerCam, deg, mm
    >>> from camkit.motion import Cycloidal, MotionProgram, Rise
    >>> undercut_in_words(TranslatingRollerCam().analyse())
    ''
    >>> motion = MotionProgram((Rise(40 * deg, 30 * mm, Cycloidal()),))
    >>> undercut_in_words(TranslatingRollerCam(motion, roller_radius=20 * mm, groove=False).analyse())
    'Undercut: the follower cuts away the profile at 32.3 deg, where its radius of curvature is 3.95 mm too small.'
    """
    curves = getattr(analysis, "curves", None) or {"": analysis}
    told, cut = "", np.array(False)
    for name, curve in curves.items():
        for lost, words in _flanks(curve, name if len(curves) > 1 else ""):
            told, cut = told + text_if(lost, text_if(cut, ", and ") + words), cut | lost
    gap = getattr(analysis, "groove_gap", np.inf)
    merged = text_if(gap < 0, f"Walls merge: two parts of the groove overlap by {-gap / mm:.3g} mm.")
    said = text_if(cut, CUTS.format(told) + text_if(gap < 0, " ")) + merged
    return said if said or not cuts else CUTS.format(", and ".join(map(str, cuts)))


def _flanks(curve: object, name: str) -> Iterator[tuple[Array, str]]:
    """Whether each flank of a curve is undercut, and which in words."""
    of = f" of the {name} curve" if name else ""
    for flank, (radius, cam_angle) in _margins(curve).items():
        lacks = f", where its radius of curvature is {-radius / mm:.3g} mm too small"
        where = f"{flank}{of} at {cam_angle / deg:.4g} deg" + text_if(np.isfinite(radius), lacks)
        yield radius < 0, where  # at 0 a cusp, or a corner into which a knife edge fits: nothing is lost


def _margins(curve: Any) -> dict[str, tuple[Array, Array]]:
    """Least convex radius (m) of each flank, and the cam angle at which it stands."""
    if not hasattr(curve, "profile_margin"):
        return {}
    if not getattr(curve, "groove", False):
        return {f"the {ONLY}": curve.profile_margin}
    return {f"the {INNER}": curve.profile_margin, f"the {OUTER}": curve.outer_profile_margin}
