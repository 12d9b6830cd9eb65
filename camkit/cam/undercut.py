"""What a person is told of a cam that the follower, or the tool in its place, would cut away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..quantities import text_if
from ..quantities.types import Array
from ..units import deg, mm
from .flank import Cut
from .measures import number

INNER, OUTER, ONLY = "inner flank", "outer flank", "profile"
"""What the flanks of a groove are called, and that of a plate."""


def undercut_in_words(analysis: object, cuts: Sequence[Cut] = ()) -> str:
    """What is undercut, at which cam angles, and which walls of a groove merge; empty if nothing is lost.

    The words of screen and files.  ``cuts`` are told where nothing else is: what `flank.flanks` found.

    Of a roller it says its radius and that of its path, which is less; of a face by how much the radius of curvature of
    the profile lies below 0.  How far the follower then stays from its place is another, smaller number, which
    `flank.flanks` finds.  The cam angles are those around the sharpest place.

    >>> from camkit import TranslatingRollerCam, deg, mm
    >>> from camkit.motion import Cycloidal, MotionProgram, Rise
    >>> undercut_in_words(TranslatingRollerCam().analyse())
    ''
    >>> motion = MotionProgram((Rise(40 * deg, 30 * mm, Cycloidal()),))
    >>> undercut_in_words(TranslatingRollerCam(motion, roller_radius=20 * mm, groove=False).analyse())
    'profile undercut at 28.4 to 35.7 deg: roller 20 mm, convex radius 16.1 mm'
    """
    curves = getattr(analysis, "curves", None) or {"": analysis}
    told, any_lost = "", np.array(False)
    for name, curve in curves.items():
        for lost, words in _flanks(curve, f"{name} " if len(curves) > 1 else ""):
            told, any_lost = told + text_if(lost, text_if(any_lost, "; ") + words), any_lost | lost
    gap = getattr(analysis, "groove_gap", np.inf)
    merged = f"walls merge: two parts of the groove overlap by {-gap / mm:.3g} mm"
    said = told + text_if(gap < 0, text_if(any_lost, "; ") + merged)
    return said if said or not cuts else f"undercut: the follower cuts away {', and '.join(map(str, cuts))}"


def _flanks(curve: Any, name: str) -> Iterator[tuple[Array, str]]:
    """Whether each flank of a curve is undercut, and which in words."""
    if not hasattr(curve, "profile_margin"):
        return
    groove, roller = getattr(curve, "groove", False), number(curve.cam.roller_radius)
    flanks = {"convex": (curve.undercut, curve.profile_margin)}
    flanks |= {"concave": (curve.outer_undercut, curve.outer_profile_margin)} if groove else {}
    for side, (cut, (radius, cam_angle)) in flanks.items():
        face = f"radius of curvature {-radius / mm:.3g} mm too small"
        rolls = f"roller {roller / mm:.3g} mm, {side} radius {(radius + roller) / mm:.3g} mm"
        why = text_if(np.greater(roller, 0), rolls, face)
        first, last = _stretch(cut, curve.cam_angle, cam_angle)
        place = f"at {first / deg:.3g} to {last / deg:.3g} deg" + text_if(np.isfinite(radius), f": {why}")
        yield radius < 0, f"{name}{'groove' if groove else ONLY} undercut {place}"  # at 0 a cusp: nothing is lost


def _stretch(cut: Array, cam_angle: Array, at: Array) -> tuple[Array, Array]:
    """Between which cam angles that are not cut the angle ``at`` stands."""
    left = np.logical_not(cut)
    before = np.where(left & (cam_angle < at), cam_angle, cam_angle[..., 0]).max(-1)
    after = np.where(left & (cam_angle > at), cam_angle, cam_angle[..., -1]).min(-1)
    return before, after
