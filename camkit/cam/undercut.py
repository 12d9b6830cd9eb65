"""What a person is told of a cam that the follower, or the tool in its place, would cut away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..quantities.types import Array
from ..units import deg, mm
from .flank import Cut

INNER, OUTER, ONLY = "inner flank", "outer flank", "profile"
"""What the flanks of a groove are called, and that of a plate."""


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
    told = [words for name, curve in curves.items() for words in _flanks(curve, name if len(curves) > 1 else "")]
    merged = list(_merged(analysis))
    if not told and not merged:
        told = [str(cut) for cut in cuts]
    return " ".join([*([f"Undercut: the follower cuts away {', and '.join(told)}."] if told else []), *merged])


def _merged(analysis: object) -> Iterator[str]:
    """Parts of a groove between which no wall is left, in words."""
    gap = float(getattr(analysis, "groove_gap", np.inf))
    if gap < 0:
        yield f"Walls merge: two parts of the groove overlap by {-gap / mm:.3g} mm."


def _flanks(curve: object, name: str) -> Iterator[str]:
    """Each flank of a curve that is undercut, in words."""
    of = f" of the {name} curve" if name else ""
    for flank, (radius, cam_angle) in _margins(curve).items():
        if radius < 0:  # at 0 a cusp, or a corner into which a knife edge fits: nothing is lost
            lacks = f"{-float(radius) / mm:.3g} mm too small"
            deep = f", where its radius of curvature is {lacks}" if np.isfinite(radius) else ""
            yield f"{flank}{of} at {float(cam_angle) / deg:.4g} deg{deep}"


def _margins(curve: Any) -> dict[str, tuple[Array, Array]]:
    """Least convex radius (m) of each flank, and the cam angle at which it stands."""
    if hasattr(curve, "min_radius_angle"):
        return {f"the {ONLY}": (curve.min_radius, curve.min_radius_angle)}
    if not hasattr(curve, "profile_margin"):
        return {}
    if not getattr(curve, "groove", False):
        return {f"the {ONLY}": curve.profile_margin}
    return {f"the {INNER}": curve.profile_margin, f"the {OUTER}": curve.outer_profile_margin}
