"""A drum with its groove, or its end face, as a mesh: a body is cut from it whose walls are the exact flanks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...quantities.types import Array
from ...units import mm
from .blank import Blank
from .mesh import Mesh, as_mesh, body
from .plan import bore_path, circle
from .prisms import Prism
from .subject import Subject

if TYPE_CHECKING:
    from manifold3d import Manifold

LEVELS, ACROSS = 7, 16
"""Points up a flank, and across the bottom of a groove."""
BEYOND = 2 * mm
"""How far the body that is cut away stands out of the drum."""
FIRST, MOST = 361, 6000
"""Cam angles to begin with, twice as many until the tolerance is kept, and no more than that."""


def drum_mesh(subject: Subject, blank: Blank, tolerance: float) -> tuple[Mesh, Array]:
    """The drum of one design and points ``(n, 3)`` on its exact flanks (m); ``tolerance`` is that of its chords.

    Its ends are those of its picture, its bore and hub those of the blank.  Raises ``ValueError`` for a bore that
    leaves nothing under the groove, and for flanks of no width.
    """
    cam, (low, high) = subject.design, map(float, subject.analysis.ends)
    _room(subject, blank)
    bore = (bore_path(blank),) if blank.bore else ()
    whole = body(Prism(circle(cam.surface_radius), bore, low, high), tolerance)
    if blank.hub_diameter:
        whole += body(Prism(circle(blank.hub_diameter / 2), bore, low - blank.hub_length, low), tolerance)
    ring, exact = _ring(subject, tolerance, high + BEYOND)
    made = whole - _as_body(ring)
    if not cam.groove:
        inner, least = _core(cam.bottom_radius), float(ring[0, :, 2].min())
        made -= body(Prism(circle(inner), (), least, high + BEYOND), tolerance)
    return as_mesh(made), exact


def _room(subject: Subject, blank: Blank) -> None:
    cam = subject.design
    if not cam.groove_depth > 0:
        raise ValueError(f"the groove depth of {subject.kind} is 0 mm; a solid's must be above 0")
    if blank.reach / 2 >= cam.bottom_radius:
        raise ValueError(
            f"the bore with its keyway reaches {blank.reach / 2 / mm:.4g} mm from the axis; the bottom of the groove "
            f"is at {cam.bottom_radius / mm:.4g} mm"
        )


def _core(bottom: float) -> float:
    """Within this radius the end of a drum is flat, m."""
    return 0.9 * bottom


def _ring(subject: Subject, tolerance: float, top: float) -> tuple[Array, Array]:
    """What is cut away, point by point around its section at every cam angle ``(k, n, 3)``, and exact points."""
    count = FIRST
    while True:
        fine = subject.design.analyse(2 * count - 1)
        heights = np.linspace(fine.cam.bottom_radius, fine.cam.surface_radius + BEYOND, 2 * LEVELS - 1)
        flanks = [
            np.stack([fine.in_space(h, side).T for h in heights]) for side in ((1, -1) if fine.cam.groove else (1,))
        ]
        off = max(float(np.linalg.norm(_missed(flank), axis=-1).max()) for flank in flanks)
        if off <= tolerance or 2 * count > MOST:
            break
        count = 2 * count - 1
    section = _grooved if fine.cam.groove else _end
    exact = np.concatenate([flank[1:LEVELS:2, 1::2].reshape(-1, 3) for flank in flanks])
    return section([flank[::2, :-1:2] for flank in flanks], fine.cam, top), exact


def _missed(flank: Array) -> Array:
    """From the middle of four points to the flank there."""
    return flank[1::2, 1::2] - (flank[:-1:2, :-1:2] + flank[2::2, :-1:2] + flank[:-1:2, 2::2] + flank[2::2, 2::2]) / 4


def _grooved(flanks: list[Array], cam: Any, top: float) -> Array:
    """Up the lower flank, down the upper one, and back on the cylinder of the bottom."""
    lower, upper = flanks
    share = np.linspace(0, 1, ACROSS)[1:-1, None, None]
    across = upper[0] + share * (lower[0] - upper[0])
    across[..., :2] *= cam.bottom_radius / np.linalg.norm(across[..., :2], axis=-1, keepdims=True)
    return np.concatenate([lower, upper[::-1], across])


def _end(flanks: list[Array], cam: Any, top: float) -> Array:
    """Up the flank, above it, and back over the core of the drum."""
    (lower,) = flanks
    inner = lower[:1].copy()
    inner[..., :2] *= 0.9 * _core(cam.bottom_radius) / np.linalg.norm(inner[..., :2], axis=-1, keepdims=True)
    lid = np.concatenate([lower[-1:], inner])
    lid[..., 2] = top
    return np.concatenate([lower, lid, inner])


def _as_body(ring: Array) -> Manifold:
    """A closed ring: each point goes on to the next around the section, and to that at the next cam angle."""
    from manifold3d import Manifold, Mesh64

    k, n, _ = ring.shape
    here = np.arange(k * n).reshape(k, n)
    over, on = np.roll(here, -1, axis=0), np.roll(here, -1, axis=1)
    both = np.roll(over, -1, axis=1)
    triangles = np.concatenate([np.stack([here, over, both], -1), np.stack([here, both, on], -1)]).reshape(-1, 3)
    found = Mesh(ring.reshape(-1, 3), triangles)
    outwards = triangles if found.volume > 0 else triangles[:, ::-1]
    return Manifold(Mesh64(np.ascontiguousarray(found.points / mm), np.ascontiguousarray(outwards).astype(np.uint64)))
