"""Drawings that explain: a cam's geometry with the letters of the formulas, made from a real design."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike

from ..geometry import Disc, circle, rotated
from ..quantities.types import Array, Value
from ..units import deg, mm
from ..views.cam import Cam, position
from ..views.picture import Axes, Circle, Formula, Line, Mark, Picture, Points, Polygon, Text

BARE = Axes(equal=True, bare=True)


def letter(key: str, at: Sequence[Value] | Array, words: str, role: str = "ink") -> Text:
    """A letter of the formulas."""
    return Text(key, at[0], at[1], Formula(words), role=role, size=15)


def arc(key: str, centre: Sequence[Value] | Array, radius: Value, first: Value, last: Value) -> Line:
    """An arc about a centre between two angles (rad)."""
    turn = np.linspace(first, last, 37)
    return Line(key, centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn), stroke="thin")


def arrow(key: str, start: ArrayLike, tip: ArrayLike, role: str = "ink", both: bool = False) -> Line:
    """An arrow from ``start`` to ``tip``, with a head at ``both`` ends if asked for."""
    start, tip = np.asarray(start, dtype=float), np.asarray(tip, dtype=float)
    along = (tip - start) / np.hypot(*(tip - start))
    side = 1.2 * np.array([-along[1], along[0]])
    points = [start, tip, tip - 4 * along + side, tip, tip - 4 * along - side]
    if both:
        points = [start + 4 * along + side, start, start + 4 * along - side, *points]
    return Line(key, *np.transpose(points), role=role, stroke="solid")


def _stretch(key: str, first: ArrayLike, last: ArrayLike, role: str = "guide", stroke: str = "") -> Line:
    return Line(key, *np.transpose([first, last]), role=role, stroke=stroke)


def _pins(**at: Sequence[Value] | Array) -> list[Mark]:
    return [Points(name, x, y, size=9, fill="paper") for name, (x, y) in at.items()]


def _radius(analysis: Cam) -> Value:
    """Of the roller that the analysis offers, mm."""
    return next(body.radius for body in analysis.bodies if isinstance(body, Disc)) / mm


def _middle(first: ArrayLike, second: ArrayLike, shift: tuple[float, float]) -> Array:
    return (np.asarray(first) + np.asarray(second)) / 2 + shift


def _turned(analysis: Any, i: SupportsIndex, name: str) -> Array:
    """A curve of the cam in the machine's frame, mm."""
    return rotated(getattr(analysis, name), analysis.turn[i]) / mm


def roller_cam_sketch(analysis: Any, turn: float = 0.0) -> Picture:
    """The geometry of an oscillating roller cam (one curve) with the letters of the formulas, at cam angle ``turn``."""
    i = position(analysis.cam_angle, turn)
    pivot, centre, radius = analysis.cranks["arm"][0] / mm, analysis.roller_centre[:, i] / mm, _radius(analysis)
    return Picture.of(
        BARE,
        Line("pitch", *_turned(analysis, i, "pitch"), role="pitch"),
        Line("profile", *_turned(analysis, i, "profile"), role="profile"),
        Circle("roller", centre[0], centre[1], radius, role="follower"),
        _stretch("a", (0, 0), pivot),
        _stretch("R", (0, 0), centre),
        _stretch("arm", pivot, centre, role="follower", stroke="arm"),
        _pins(O=(0, 0), A=pivot),
        letter("O name", (0, -5.5), "O"),
        letter("A name", pivot - np.array([0, 5.5]), "A"),
        letter("a name", _middle((0, 0), pivot, (0, -4)), "$a$"),
        letter("l name", _middle(pivot, centre, (3, 4)), "$l$"),
        letter("R name", _middle((0, 0), centre, (-4, 1)), "$R$"),
        _pressure_angle(centre, analysis.normal[:, i], analysis.arm_angle[i]),
        _arm_angle(pivot, analysis.arm_angle[i]),
        _stretch("r", centre, centre - radius * analysis.normal[:, i], role="flank"),
        letter("r name", centre - 1.9 * radius * analysis.normal[:, i], "$r_T$"),
    )


def _pressure_angle(centre: Array, normal: Array, psi: Array) -> list[Mark]:
    """The contact normal, the direction in which the roller moves, and the angle between them."""
    moves = np.stack([np.sin(psi), np.cos(psi)])
    first, last = np.arctan2(normal[1], normal[0]), np.arctan2(moves[1], moves[0])
    middle = (first + last) / 2
    marks: list[Mark] = []
    for key, direction, role in (("normal", normal, "limit"), ("roller moves", moves, "allowed")):
        marks.append(arrow(key, centre, centre + 34.0 * direction, role))
        x, y = centre + 1.13 * 34.0 * direction
        marks.append(Text(f"{key} name", x, y, key, role=role, size=12, anchor="bottom"))
    marks.append(arc("alpha", centre, 20.0, first, last))
    marks.append(letter("alpha name", centre + 24.5 * np.stack([np.cos(middle), np.sin(middle)]), r"$\alpha$"))
    return marks


def _arm_angle(pivot: Array, psi: Array) -> list[Mark]:
    """The arm's angle from the line of centres."""
    at = pivot + 21 * np.stack([-np.cos(psi / 2), np.sin(psi / 2)])
    return [arc("psi", pivot, 17.0, np.pi - psi, np.pi), letter("psi name", at, r"$\psi$")]


def two_radii_sketch(analysis: Any, turn: float = 0.0) -> Picture:
    """A plate cam between its two radii, with the letters of its formulas, at cam angle ``turn``."""
    i, cam = position(analysis.cam_angle, turn), analysis.cam
    profile, pivot = _turned(analysis, i, "profile"), analysis.cranks["arm"][0] / mm
    centre, radius = analysis.roller_centre[:, i] / mm, _radius(analysis)
    normal, t = analysis.normal[:, i], analysis.arm_angle[i]
    middle = pivot + 56 * np.stack([-np.cos(t / 2), np.sin(t / 2)])
    return Picture.of(
        Axes(equal=True, bare=True, ylim=(None, centre[1] + 100)),
        Polygon("cam", *profile, role="body"),
        Line("profile", *profile, role="profile"),
        _two_radii(cam.min_radius / mm, cam.max_radius / mm),
        Circle("roller", centre[0], centre[1], radius, role="follower"),
        _stretch("arm", pivot, centre, role="follower", stroke="arm"),
        _stretch("L", (0, 0), pivot, stroke="dashdot"),
        _pins(O=(0, 0), A=pivot),
        letter("O name", (0, -13), "O"),
        letter("A name", pivot - np.array([0, 13]), "A"),
        letter("L name", (pivot[0] * 0.8, -10), "$L$"),
        letter("l name", (pivot + 2 * centre) / 3 + np.array([9, 8]), "$l$"),
        arc("t", pivot, 42.0, np.pi - t, np.pi),
        letter("t name", middle, "$t$"),
        _force_and_way(centre, normal, t),
        _stretch("r", centre, centre - radius * normal, role="follower"),
        letter("r name", centre - 0.55 * radius * normal + np.array([-8, 3]), "$r$"),
    )


def _two_radii(least: float, largest: float) -> list[Mark]:
    """The smallest and the largest circle of the profile, each with a radius."""
    marks: list[Mark] = []
    for key, radius, words, at in (
        ("least", least, "$r_{k1}$", 150 * deg),
        ("largest", largest, "$r_{k2}$", 283 * deg),
    ):
        away = np.array([np.cos(at), np.sin(at)])
        marks.append(Circle(f"{key} circle", 0.0, 0.0, radius, role="guide"))
        marks.append(arrow(f"{key} radius", (0, 0), radius * away, "jerk"))
        beside = 0.6 * radius * away + 13 * np.array([-away[1], away[0]])
        marks.append(letter(f"{key} name", beside, words, "jerk"))
    return marks


def _force_and_way(centre: Array, normal: Array, t: Array) -> list[Mark]:
    """The normal force on the roller, the way its centre goes, the pressure angle between them."""
    moves = np.stack([np.sin(t), np.cos(t)])
    first, last = (np.arctan2(v[1], v[0]) for v in (normal, moves))
    middle = (first + last) / 2
    return [
        arrow("N", centre, centre + 78 * normal),
        letter("N name", centre + 90 * normal, "$N$"),
        arrow("way", centre, centre + 78 * moves, "allowed"),
        letter("way name", centre + 90 * moves, r"$\psi'$", "allowed"),
        arc("theta", centre, 50.0, first, last),
        letter("theta name", centre + 62 * np.stack([np.cos(middle), np.sin(middle)]), r"$\theta$"),
    ]


def flat_face_sketch(analysis: Any, turn: float = 0.0) -> Picture:
    """A cam with a nose under a flat face, with the letters of the formulas, at cam angle ``turn``."""
    whole, cam = analysis.whole, analysis.cam
    i = position(whole.cam_angle, turn)
    alpha, r0, h = whole.cam_angle[i], cam.base_radius / mm, whole.lift[i] / mm
    profile, face = _turned(whole, i, "profile"), r0 + h
    return Picture.of(
        BARE,
        Polygon("cam", *profile, role="body"),
        Line("profile", *profile, role="profile"),
        Circle("base circle", 0.0, 0.0, r0, role="pitch"),
        _pins(O=(0, 0)),
        _stretch("face", (-26, face), (26, face), role="follower", stroke="arm"),
        _stretch("stem", (0, face), (0, face + 16), role="follower", stroke="arm"),
        _stretch("travel", (0, 0), (0, face), stroke="dashdot"),
        _cam_angles(alpha, cam.half_angle, r0, (cam.base_radius + cam.max_lift) / mm),
        _lengths(r0, h),
        _contact(whole.contact_point()[:, i] / mm, whole.flat.profile_radius[i] / mm, face),
    )


def _cam_angles(alpha: float, half: float, r0: object, tip: float) -> list[Mark]:
    """The radii to the start of the flank and to the nose, the cam angle and the half angle."""
    marks: list[Mark] = []
    for words, turned, length, side in (
        ("start of the flank", alpha, r0, "right bottom"),
        ("nose", alpha - half, tip, "left top"),
    ):
        x, y = length * np.stack([-np.sin(turned), np.cos(turned)])
        marks.append(_stretch(f"to {words}", (0, 0), (x, y)))
        marks.append(Points(words, x, y, role="position"))
        marks.append(Text(f"{words} name", 1.06 * x, 1.02 * y + 0.6, words, role="position", size=12, anchor=side))
    for key, size, first, words, at in (
        ("alpha", 11.0, 0.0, r"$\alpha$", alpha / 2),
        ("alpha_B", 17.0, alpha - half, r"$\alpha_B$", (alpha - half) * 0.72),
    ):
        marks.append(arc(key, (0, 0), size, np.pi / 2 + first, np.pi / 2 + alpha))
        beside = (size + 2.6) * np.stack([-np.sin(at), np.cos(at)])
        marks.append(letter(f"{key} name", beside, words))
    return marks


def _lengths(r0: float, h: float) -> list[Mark]:
    """Base radius and lift beside the line of travel, far left."""
    x = -1.5 * r0
    marks: list[Mark] = []
    for key, low, high, words in (("r_0", 0, r0, "$r_0$"), ("h", r0, r0 + h, "$h$")):
        marks.append(arrow(key, (x, low), (x, high), both=True))
        marks.append(letter(f"{key} name", (x - 3, (low + high) / 2), words))
    for key, y, end in (("axis", 0, -1), ("base", r0, -1), ("face line", r0 + h, -25)):
        marks.append(_stretch(f"to {key}", (x - 1.5, y), (end, y), stroke="dotted"))
    return marks


def _contact(contact: Array, radius: float, face: float) -> list[Mark]:
    """The contact, its distance from the line of travel, and the circle that fits the cam there."""
    x, y = contact
    return [
        Line("fitting circle", *circle((x, y - radius), radius), role="jerk", stroke="solid"),
        _stretch("rho", (x, y), (x, y - radius), role="jerk", stroke="solid"),
        Points("its centre", x, y - radius, role="jerk", mark="plus", size=10),
        letter("rho name", (x - 2.6, y - 0.6 * radius), r"$\rho$", "jerk"),
        Points("contact", x, y, size=9, fill="paper"),
        arrow("h'", (0, face + 4), (x, face + 4), "allowed", both=True),
        _stretch("to contact", (x, face), (x, face + 5), role="allowed"),
        letter("h' name", (x / 2, face + 6.8), r"$h'$", "allowed"),
        Text("contact name", x + 2, face + 1.2, "contact", size=12, anchor="left bottom"),
    ]
