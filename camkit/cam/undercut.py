"""What a person is told of a cam that the follower, or the tool in its place, would cut away."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..units import deg, mm


def undercut_in_words(analysis: Any) -> str:
    """One sentence that says which flank is undercut, at which cam angle and by how much; empty if none is.

    By how much: how far the least convex radius of curvature lies below 0, which under a roller is by how much its
    radius is larger than that of its path.

    >>> from camkit import TranslatingFlatCam, mm
    >>> undercut_in_words(TranslatingFlatCam().analyse())
    ''
    >>> undercut_in_words(TranslatingFlatCam(base_radius=8 * mm).analyse())
    'Undercut: the follower cuts away the profile at 87.61 deg by 2.66 mm.'
    """
    curves = getattr(analysis, "curves", None) or {"": analysis}
    told = [words for name, curve in curves.items() for words in _flanks(curve, name if len(curves) > 1 else "")]
    return f"Undercut: the follower cuts away {', and '.join(told)}." if told else ""


def _flanks(curve: Any, name: str) -> Iterator[str]:
    """Each flank of a curve that is undercut, in words."""
    of = f" of the {name} curve" if name else ""
    for flank, (radius, cam_angle) in _margins(curve).items():
        if radius <= 0:
            deep = f" by {-float(radius) / mm:.3g} mm" if -np.inf < radius < 0 else ""
            yield f"{flank}{of} at {float(cam_angle) / deg:.4g} deg{deep}"


def _margins(curve: Any) -> dict[str, tuple[Any, Any]]:
    """Least convex radius (m) of each flank, and the cam angle at which it stands."""
    if hasattr(curve, "least_radius_angle"):
        return {"the profile": (curve.least_radius, curve.least_radius_angle)}
    if not hasattr(curve, "profile_margin"):
        return {}
    if not getattr(curve, "groove", False):
        return {"the profile": curve.profile_margin}
    return {"the inner flank": curve.profile_margin, "the outer flank": curve.outer_profile_margin}
