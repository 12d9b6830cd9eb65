"""A linkage in space with the letters of its formulas, drawn from a real design."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..linkage.rssr import RSSR
from ..linkage.rssr_analysis import RSSRAnalysis
from ..quantities.types import Array
from ..units import deg, mm
from ..views.picture import Axes, Colour, Formula, Picture, Text
from ..views.space import CRANK, NEITHER, ROCKER, crank_circle, rocker_circle, scene_of
from ..views.turntable import Turntable


def linkage_sketch(
    analysis: RSSRAnalysis, turn: float = 0.0, azimuth: float = -58 * deg, elevation: float = 24 * deg
) -> Picture:
    """The geometry of a linkage with two ball joints at crank angle ``turn``, with the letters of the formulas."""
    here = analysis.at(turn)
    linkage, scene = here.linkage, scene_of(here.linkage, (), azimuth, elevation)
    root, b, c, hinge = np.moveaxis(here.chain[..., 0] / mm, 1, 0)
    _axes(scene, linkage, root, hinge, np.array([linkage.axis_distance / mm, 0.0, 0.0]))
    for key, angle, circle, centre, style, letter in (
        ("phi1", here.crank_angle[0], crank_circle, root, CRANK, r"$\varphi_1$"),
        ("phi3", here.rocker_angle[0], rocker_circle, hinge, ROCKER, r"$\varphi_3$"),
    ):
        _angle(scene, key, centre, circle(linkage, np.linspace(0, angle, 41)), style, letter)
    for key, ends, style, letter, shift in (
        ("crank", (root, b), CRANK, "$l_1$", -14),
        ("coupler", (b, c), NEITHER, "$l_2$", 14),
        ("rocker", (hinge, c), ROCKER, "$l_3$", -13),
    ):
        scene.link(key, np.stack(ends, axis=1), **style)
        _beside(scene, f"{key} name", letter, ends, shift)
    for key, point, size, style in (
        ("root", root, 8, CRANK),
        ("hinge", hinge, 8, ROCKER),
        ("B", b, 12, NEITHER),
        ("C", c, 12, NEITHER),
    ):
        scene.ball(key, point, size, fill="paper", **style)
    _ways(scene, here, b, c)
    return scene.picture(Axes(equal=True, bare=True))


def _letter(scene: Turntable, key: str, point: ArrayLike, words: str) -> None:
    scene.words(key, point, Formula(words), size=15)


def _axes(scene: Turntable, linkage: RSSR, root: np.ndarray, hinge: np.ndarray, foot: np.ndarray) -> None:
    """Both axes, their common perpendicular, the offsets along them and the angle between them."""
    origin, reach = np.zeros(3), 0.45 * scene.radius
    for key, point, axis, start, style, letter, share, shift in (
        ("crank axis", root, linkage.crank_axis, origin, CRANK, "$s_0$", 0.5, -10),
        ("rocker axis", hinge, linkage.rocker_axis, foot, ROCKER, "$s_3$", 1.0, 12),
    ):
        ends = np.stack([start - 0.5 * reach * axis, point + 0.4 * reach * axis], axis=1)
        scene.path(key, ends, stroke="dashdot", **style)
        _beside(scene, f"{key} name", letter, (start, start + share * (point - start)), shift)
    scene.path("common perpendicular", np.stack([origin, foot], axis=1), role="guide", stroke="bold")
    _beside(scene, "common perpendicular name", "$h_0$", (origin, foot), -9)
    parallel = np.stack([foot, foot + reach * linkage.crank_axis], axis=1)
    scene.path("parallel", parallel, stroke="thin dotted", **CRANK)
    lean = np.linspace(0, linkage.axis_angle, 21)
    arc = foot[:, None] + 0.7 * reach * np.stack([0 * lean, np.sin(lean), np.cos(lean)])
    scene.path("L", arc)
    _letter(scene, "L name", foot + 1.18 * (arc[:, 10] - foot), "$L$")
    for key, point in (("O", origin), ("foot", foot)):
        scene.ball(key, point, 5, role="guide")


def _angle(scene: Turntable, key: str, centre: Array, arc: Array, style: Colour, letter: str) -> None:
    """An angle about an axis, from the direction of the x axis."""
    small = centre[:, None] + 0.38 * (arc - centre[:, None])
    scene.path(f"{key} zero", np.stack([centre, arc[:, 0]], axis=1), role="guide", stroke="dashed")
    scene.path(f"{key} circle", arc, stroke="thin", **style)
    scene.path(key, small, **style)
    _letter(scene, f"{key} name", centre + 1.35 * (small[:, 20] - centre), letter)


def _ways(scene: Turntable, here: RSSRAnalysis, b: np.ndarray, c: np.ndarray) -> None:
    """The ways of both joints and the pressure angles between them and the coupler."""
    along, size = here.coupler_direction[:, 0], 0.42 * scene.radius
    for key, point, way, force, letters in (
        ("1", b, here.crank_motion[:, 0], along, ("$v_B$", r"$\alpha_1$", "$B$")),
        ("2", c, here.rocker_motion[:, 0], -along, ("$v_C$", r"$\alpha_2$", "$C$")),
    ):
        folded = way * np.where(way @ force >= 0, 1, -1)
        away = -(folded + force) / np.linalg.norm(folded + force)
        share = np.linspace(0, 1, 13)
        fan = np.outer(folded, 1 - share) + np.outer(force, share)
        arc = point[:, None] + 0.7 * size * fan / np.linalg.norm(fan, axis=0)
        scene.arrow(f"v{key}", point, size * folded, role="velocity")
        scene.path(f"alpha{key}", arc, at=18.0)
        _letter(scene, f"v{key} name", point + 1.15 * size * folded, letters[0])
        _letter(scene, f"alpha{key} name", point + 1.25 * (arc[:, 6] - point), letters[1])
        _letter(scene, f"joint{key} name", point + 0.2 * size * away, letters[2])


def _beside(scene: Turntable, key: str, letter: str, ends: Sequence[Array], shift: float) -> None:
    """A letter beside the middle of a line, ``shift`` mm across it on the picture."""
    (x0, y0, _), (x1, y1, _) = (scene.seen(end) for end in ends)
    across = np.array([y1 - y0, x0 - x1]) / np.maximum(np.hypot(x1 - x0, y1 - y0), 1e-12)
    x, y = np.array([x0 + x1, y0 + y1]) / 2 + shift * across
    scene.put(19.0, Text(key, x, y, Formula(letter), size=15))
