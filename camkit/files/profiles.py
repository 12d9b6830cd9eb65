"""The profile of a cam as DXF, and any table as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..cam.flank import flanks
from ..cam.undercut import undercut_in_words
from ..quantities.kinds import refuse_arguments, shown
from ..quantities.markup import csv_cell
from ..quantities.types import Array
from ..units import in_unit

FAULT = "FAULT"
"""The layer of what a cam was to have and the tool cuts away."""
TEXT = 2.5
"""Height of the sentence on that layer, mm."""


def table_csv(columns: Mapping[str, Sequence[object] | Array]) -> str:
    """Columns of numbers (in the units that their headings name) or words as CSV text, numbers with six decimals.

    >>> print(table_csv({"cam angle [deg]": [0, 1], "lift [mm]": [0.0, 1 / 3]}), end="")
    cam angle [deg],lift [mm]
    0.000000,0.000000
    1.000000,0.333333
    """
    refuse_arguments(table_csv, locals())
    lengths = {len(column) for column in columns.values()}
    if len(lengths) != 1:
        raise ValueError(
            f"the columns have {' and '.join(map(str, sorted(lengths))) or 'no'} rows; they need as many each"
        )
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(map(csv_cell, columns))
    words = ([csv_cell(v) if isinstance(v, str) else f"{v:z.6f}" for v in column] for column in columns.values())
    writer.writerows(zip(*words, strict=True))
    return out.getvalue()


def _one_cam(analysis: Any) -> Any:
    """The whole cam, if it is one."""
    analysis = getattr(analysis, "whole", analysis)
    if not all(hasattr(analysis, name) for name in ("cam_angle", "pitch", "stretch")):
        raise ValueError(f"given is {shown(analysis)}; it must be the analysis of a cam, which has a profile")
    if np.ndim(analysis.cam_angle) > 1 or np.ndim(analysis.pitch) > 2:
        raise ValueError("this is a population; the profile of one design can be written")
    return analysis


def profile_dxf(analysis: Any) -> str:
    """The profile of a cam as a DXF drawing in mm, the cam axis at the origin, for CAD and machine tools.

    Pitch curve, profile, a groove's outer profile and the ends of an open groove are polylines on layers of these
    names, closed where the curve is, through the points at which it was analysed; of a drum they are unrolled at its
    mean radius.  Of a cam that is undercut the
    profile is what the tool leaves (see `flanks`); what was asked for besides is on the layer ``FAULT``, with a
    sentence.  Written by ezdxf.

    >>> from camkit import TranslatingRollerCam
    >>> text = profile_dxf(TranslatingRollerCam().analyse())
    >>> sum(line == "LWPOLYLINE" for line in text.splitlines())
    3
    """
    import ezdxf  # the maths does without

    given, analysis = analysis, _one_cam(analysis)
    made, drawing = flanks(analysis), ezdxf.new("R2010", units=ezdxf.units.MM)

    def draw(layer: str, points: np.ndarray, closed: bool) -> None:
        if layer not in drawing.layers:
            drawing.layers.add(layer, color=ezdxf.colors.RED if layer == FAULT else ezdxf.colors.BLACK)
        line = in_unit(points, "mm").T.tolist()
        drawing.modelspace().add_lwpolyline(line, close=closed, dxfattribs={"layer": layer})

    for points in _pieces(analysis.pitch):
        closed = bool(np.allclose(points[:, 0], points[:, -1], rtol=0, atol=1e-9))
        draw("pitch", points[:, :-1] if closed else points, closed)
    for piece in made.left:
        draw(piece.flank, piece.points, piece.closed)
    for piece in made.lost:
        draw(FAULT, piece.points, piece.closed)
    if made.cuts:
        sentence = undercut_in_words(given, made.cuts)
        below = in_unit(analysis.profile[1].min(), "mm") - 4 * TEXT
        drawing.modelspace().add_text(sentence, height=TEXT, dxfattribs={"layer": FAULT}).set_placement((0, below))
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue()


def _pieces(points: np.ndarray) -> list[np.ndarray]:
    """Runs of finite points ``(2, n)`` between gaps."""
    finite = np.isfinite(points).all(0)
    runs = np.split(np.arange(points.shape[1]), np.flatnonzero(np.diff(finite)) + 1)
    return [points[:, run] for run in runs if finite[run[0]] and len(run) > 1]
