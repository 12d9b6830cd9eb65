"""An RSSR linkage with the letters of its formulas, drawn from a real design."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..units import deg, mm
from .artists import BLUE, GREEN, GREY, INK, ORANGE, SKY, Formula
from .linkage import crank_circle, rocker_circle, scene_of
from .turntable import Turntable

LETTER: Any = {"fontsize": 15, "color": INK, "ha": "center", "va": "center", "zorder": 20}


def rssr_sketch(
    analysis: Any, ax: Axes, turn: float = 0.0, azimuth: float = -58 * deg, elevation: float = 24 * deg
) -> Axes:
    """The geometry of an RSSR linkage at crank angle ``turn``, with the letters of the formulas."""
    here = analysis.at(turn)
    linkage, scene = here.linkage, scene_of(here.linkage, (), ax, azimuth, elevation)
    root, b, c, hinge = np.moveaxis(here.chain[..., 0] / mm, 1, 0)
    foot = np.array([linkage.axis_distance / mm, 0.0, 0.0])
    _axes(scene, linkage, root, hinge, foot)
    for key, angle, circle, centre, colour, letter in (
        ("phi1", here.crank_angle[0], crank_circle, root, BLUE, r"$\varphi_1$"),
        ("phi3", here.rocker_angle[0], rocker_circle, hinge, ORANGE, r"$\varphi_3$"),
    ):
        _angle(scene, key, centre, circle(linkage, np.linspace(0, angle, 41)), colour, letter)
    for key, ends, colour, letter, shift in (
        ("crank", (root, b), BLUE, "$l_1$", -14),
        ("coupler", (b, c), INK, "$l_2$", 14),
        ("rocker", (hinge, c), ORANGE, "$l_3$", -13),
    ):
        scene.link(key, np.stack(ends, axis=1), 6, color=colour)
        _beside(scene, letter, ends, shift)
    for key, point, size, colour in (
        ("root", root, 8, BLUE),
        ("hinge", hinge, 8, ORANGE),
        ("B", b, 12, INK),
        ("C", c, 12, INK),
    ):
        scene.ball(key, point, size, color=colour, markerfacecolor=SKY if size > 8 else "white", markeredgewidth=2)
    _ways(scene, here, b, c)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax


def _axes(scene: Turntable, linkage: Any, root: np.ndarray, hinge: np.ndarray, foot: np.ndarray) -> None:
    """Both axes, their common perpendicular, the offsets along them and the angle between them."""
    origin, reach = np.zeros(3), 0.45 * scene.radius
    for key, point, axis, start, colour, letter, share, shift in (
        ("crank axis", root, linkage.crank_axis, origin, BLUE, "$s_0$", 0.5, -10),
        ("rocker axis", hinge, linkage.rocker_axis, foot, ORANGE, "$s_3$", 1.0, 12),
    ):
        ends = np.stack([start - 0.5 * reach * axis, point + 0.4 * reach * axis], axis=1)
        scene.path(key, ends, color=colour, linewidth=1.5, linestyle="-.", zorder=3)
        _beside(scene, letter, (start, start + share * (point - start)), shift)
    scene.path("common perpendicular", np.stack([origin, foot], axis=1), color=GREY, linewidth=2.5, zorder=3)
    _beside(scene, "$h_0$", (origin, foot), -9)
    parallel = np.stack([foot, foot + reach * linkage.crank_axis], axis=1)
    scene.path("parallel", parallel, color=BLUE, linewidth=1, linestyle=":", zorder=3)
    lean = np.linspace(0, linkage.axis_angle, 21)
    arc = foot[:, None] + 0.7 * reach * np.stack([0 * lean, np.sin(lean), np.cos(lean)])
    scene.path("L", arc, color=INK, linewidth=1.5, zorder=3)
    scene.words("L name", foot + 1.18 * (arc[:, 10] - foot), Formula("$L$"), **LETTER)
    for key, point in (("O", origin), ("foot", foot)):
        scene.ball(key, point, 5, color=GREY)


def _angle(scene: Turntable, key: str, centre: Any, arc: Any, colour: str, letter: str) -> None:
    """An angle about an axis, from the direction of the x axis."""
    small = centre[:, None] + 0.38 * (arc - centre[:, None])
    scene.path(f"{key} zero", np.stack([centre, arc[:, 0]], axis=1), color=GREY, linewidth=1, linestyle="--", zorder=3)
    scene.path(f"{key} circle", arc, color=colour, linewidth=0.9, zorder=3)
    scene.path(key, small, color=colour, linewidth=1.6, zorder=3)
    scene.words(f"{key} name", centre + 1.35 * (small[:, 20] - centre), Formula(letter), **LETTER)


def _ways(scene: Turntable, here: Any, b: np.ndarray, c: np.ndarray) -> None:
    """The ways of both joints and the pressure angles between them and the coupler."""
    along, size = here.coupler_direction[:, 0], 0.42 * scene.radius
    for key, point, way, force, letters in (
        ("1", b, here.crank_motion[:, 0], along, ("$v_B$", r"$\alpha_1$", "$B$")),
        ("2", c, here.rocker_motion[:, 0], -along, ("$v_C$", r"$\alpha_2$", "$C$")),
    ):
        folded = way if way @ force >= 0 else -way
        away = -(folded + force) / np.linalg.norm(folded + force)
        share = np.linspace(0, 1, 13)
        fan = np.outer(folded, 1 - share) + np.outer(force, share)
        arc = point[:, None] + 0.7 * size * fan / np.linalg.norm(fan, axis=0)
        scene.arrow(f"v{key}", point, size * folded, color=GREEN, linewidth=2.2, zorder=18)
        scene.path(f"alpha{key}", arc, color=INK, linewidth=1.5, zorder=18)
        scene.words(f"v{key} name", point + 1.15 * size * folded, Formula(letters[0]), **LETTER)
        scene.words(f"alpha{key} name", point + 1.25 * (arc[:, 6] - point), Formula(letters[1]), **LETTER)
        scene.words(f"joint{key} name", point + 0.2 * size * away, Formula(letters[2]), **LETTER)


def _beside(scene: Turntable, letter: str, ends: Any, shift: float) -> None:
    """A letter beside the middle of a line, ``shift`` mm across it on the picture."""
    (x0, y0, _), (x1, y1, _) = (scene.seen(end) for end in ends)
    across = np.array([y1 - y0, x0 - x1]) / (np.hypot(x1 - x0, y1 - y0) or 1.0)
    x, y = np.array([x0 + x1, y0 + y1]) / 2 + shift * across
    scene.ax.text(float(x), float(y), letter, **LETTER)
