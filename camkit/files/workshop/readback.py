"""A program of G-code read back: how far the tool's centre strays from its exact path, and that it gouges nothing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np

from ...units import um
from .arcs import ArcPath, dense_path, distances
from .nc import LINE, RAPID, Move, moves
from .toolpath import ToolPath

ON_ARC = 16
"""Places on each line or arc that are looked at."""


class Wanted(NamedTuple):
    """A pass that a program is to make."""

    path: ToolPath
    number: int
    """Which of its paths."""
    led: bool
    """Whether it begins and ends with a lead."""
    level: float
    """Its height, m."""
    feed: float
    """m/s."""


class Pass(NamedTuple):
    """What a program does between going down and going up."""

    way: ArcPath
    """Of the tool's centre, in the plane."""
    level: float
    """Its height, m."""
    feeds: tuple[float, ...]
    """Each that is used, m/s."""
    mismatch: float
    """By how much the radii at both ends of an arc differ at most, m."""


def deviation(program: str, wanted: Sequence[Wanted], tolerance: float) -> float:
    """The largest distance (m) of what a program does from the exact paths, and of these from what it does.

    ``ValueError`` in a sentence for a program that strays by more than the ``tolerance``, enters the cam, or makes
    other passes than are ``wanted``.
    """
    made = list(passes(program))
    if len(made) != len(wanted):
        raise ValueError(f"the program, read back, makes {len(made)} passes in place of {len(wanted)}")
    found: dict[tuple[int, int, bytes], float] = {}
    for done, want in zip(made, wanted, strict=True):
        if not np.allclose((done.level, *done.feeds), (want.level, want.feed), rtol=0.01, atol=um):
            raise ValueError(f"the program, read back, makes a pass at {done.level / um:.0f} um and feeds {done.feeds}")
        key = id(want.path), want.number, done.way.corners.tobytes() + done.way.bulges.tobytes()
        if key not in found:
            found[key] = astray(done.way, want)
            worst = max(found[key], done.mismatch)
            depth = float(want.path.keep_out.depth(done.way.points(ON_ARC)).max())
            if max(worst, depth) > tolerance:
                raise ValueError(
                    f"the program, read back, strays by {worst / um:.3g} um and enters the cam by "
                    f"{max(depth, 0) / um:.3g} um; at most {tolerance / um:g} um are allowed"
                )
    return max(found.values())


def astray(way: ArcPath, want: Wanted) -> float:
    """How far (m) a pass without its leads lies from the exact path, or that from the pass."""
    lead = slice(1, -1) if want.led else slice(None)
    cut = ArcPath("", way.corners[:, lead], way.bulges[lead], False)
    exact = dense_path(want.path.contours[want.number], 1)
    return max(float(distances(exact, cut.points(ON_ARC)).max()), float(distances(cut, exact.corners).max()))


def passes(program: str) -> Iterator[Pass]:
    """What a program does, from going down to going up; ``ValueError`` where it moves as no such program may."""
    for rapid, group in groupby(moves(program), key=lambda move: move.kind == RAPID):
        going = list(group)
        flat = [move for move in going if (move.start[:2] != move.end[:2]).any() or move.kind > LINE]
        if any(move.start[2] != move.end[2] for move in flat) or (rapid and any(move.end[2] <= 0 for move in going)):
            raise ValueError("the program, read back, moves sideways while it goes down, or fast below the top")
        if flat and not rapid:
            feeds, missed = tuple({move.feed for move in flat}), max(move.mismatch for move in flat)
            yield Pass(_way(flat), float(flat[0].end[2]), feeds, missed)


def _way(level: Sequence[Move]) -> ArcPath:
    """Moves that follow each other, as one path in the plane."""
    corners = np.stack([level[0].start[:2], *(move.end[:2] for move in level)], axis=1)
    return ArcPath("", corners, np.array([move.bulge for move in level]), False)
