"""How roles look, to every renderer: their colours in each theme, and the strokes of lines."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Role(NamedTuple):
    """How a meaning looks: its colour in each theme, the width of its lines in points, their dashes."""

    light: str
    dark: str
    print: str
    width: float = 1.9
    dashes: str | tuple[int, tuple[float, ...]] = "-"


ROLES: dict[str, Role] = {
    "ink": Role("#1f2933", "#e6edf3", "#000000", 1.5),
    "paper": Role("#ffffff", "#111417", "#ffffff", 7.0),
    "onto": Role("#1f2933", "#111417", "#000000", 1.5),
    "guide": Role("#7b8794", "#93a1af", "#6b6b6b", 1.0),
    "ghost": Role("#8b949d", "#66727d", "#8f8f8f", 1.0),
    "body": Role("#e4e7eb", "#2a3138", "#e6e6e6", 1.0),
    "profile": Role("#005a92", "#3590d0", "#004f7c", 2.4),
    "flank": Role("#359cd8", "#bfe2fa", "#3a8fbf", 1.4),
    "pitch": Role("#7b8794", "#93a1af", "#6b6b6b", 1.0, "--"),
    "follower": Role("#c68800", "#f8c55c", "#b58100", 2.2),
    "position": Role("#005a92", "#3590d0", "#004f7c"),
    "velocity": Role("#00664a", "#35b377", "#006e50"),
    "acceleration": Role("#c68800", "#f8c55c", "#b58100"),
    "jerk": Role("#c9609f", "#d27bad", "#99557b", 1.9, ":"),
    "limit": Role("#ae3400", "#f96f38", "#8f2f00", 1.2),
    "allowed": Role("#00664a", "#35b377", "#006e50", 1.0),
    "trouble": Role("#ae3400", "#f96f38", "#8f2f00", 4.5),
    "series": Role("", "", ""),
}
"""The hues of Okabe and Ito's colour-blind-safe palette, as dark (on black: as pale) as a line must be to be seen:
its contrast with the paper is at least 3 : 1 (WCAG 2.2, 1.4.11). Vermilion is kept for limits and trouble."""

SERIES = ("position", "follower", "velocity", "jerk", "flank")
"""The roles whose colours a series takes in turn: blue, orange, green, purple, sky."""
SHADES = ((0.0, 0.0), (0.0, 0.45), (1.0, 0.5), (0.0, 0.7))
"""The colours of a series return darker and paler: towards black (0) or white (1), and how far."""

STROKES: dict[str, dict[str, object]] = {
    "solid": {"linestyle": "-"},
    "line": {"linewidth": 1.9},
    "thin": {"linewidth": 1.0},
    "bold": {"linewidth": 3.0},
    "dashed": {"linestyle": "--"},
    "dotted": {"linestyle": ":"},
    "dashdot": {"linestyle": "-."},
    "arm": {"linewidth": 4.5, "solid_capstyle": "round"},
    "shaft": {"linewidth": 9, "solid_capstyle": "round", "solid_joinstyle": "round"},
    "bar": {"linewidth": 16, "solid_capstyle": "butt"},
}


def colour(role: str, index: int = 0, theme: str = "light") -> str:
    """The colour of a role; a series has 20 that differ and begins anew.

    >>> colour("trouble"), len({colour("series", i) for i in range(20)})
    ('#ae3400', 20)
    """
    if role != "series":
        return str(getattr(ROLES[role], theme))
    towards, share = SHADES[index // len(SERIES) % len(SHADES)]
    plain_colour = _rgb(getattr(ROLES[SERIES[index % len(SERIES)]], theme))
    red, green, blue = ((1 - share) * c + share * towards for c in plain_colour)
    return _hex((red, green, blue))


def _rgb(shade: str) -> tuple[float, float, float]:
    """Red, green and blue, from 0 to 1."""
    red, green, blue = (int(shade[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


def _hex(shade: tuple[float, ...]) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in shade)


def contrast(one: str, other: str) -> float:
    """The contrast of two colours, from 1 to 21 (WCAG 2.2).

    >>> contrast("#000000", "#ffffff"), round(contrast("#7b8794", "#ffffff"), 2)
    (21.0, 3.66)
    """
    dark, pale = sorted(_luminance(each) for each in (one, other))
    return (pale + 0.05) / (dark + 0.05)


def _luminance(shade: str) -> float:
    parts = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in _rgb(shade))
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), parts, strict=True))


LEGIBLE = 4.5
"""The contrast of letters with the paper that they stand on is at least this (WCAG 2.2, 1.4.3)."""


def letter_colour(role: str, index: int = 0, theme: str = "light") -> str:
    """The colour of letters in a role: the role's, as much nearer to ink as makes them legible on paper.

    >>> letter_colour("follower"), letter_colour("limit")
    ('#946b0f', '#ae3400')
    """
    tint, ink, paper = colour(role, index, theme), colour("ink", 0, theme), colour("paper", 0, theme)
    if role in ("paper", "onto"):  # they stand on something else
        return tint
    ends = np.array([_rgb(tint), _rgb(ink)])
    steps = (_hex(tuple((np.array([1 - s, s]) @ ends).tolist())) for s in np.linspace(0, 1, 21))
    return next(shade for shade in steps if contrast(shade, paper) >= LEGIBLE)
