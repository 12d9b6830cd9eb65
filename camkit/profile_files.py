"""Files for the workshop: the profile of a cam as CSV and as DXF, and any table as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from typing import Any

import numpy as np

from .markup import csv_cell
from .units import in_unit


def table_csv(columns: Mapping[str, Any]) -> str:
    """Columns of numbers (in the units that their headings name) or words as CSV text, numbers with six decimals.

    >>> print(table_csv({"cam angle [deg]": [0, 1], "lift [mm]": [0.0, 1 / 3]}), end="")
    cam angle [deg],lift [mm]
    0.000000,0.000000
    1.000000,0.333333
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(map(csv_cell, columns))
    words = ([csv_cell(v) if isinstance(v, str) else f"{v:.6f}" for v in column] for column in columns.values())
    writer.writerows(zip(*words, strict=True))
    return out.getvalue()


def profile_csv(analysis: Any) -> str:
    """The profile of a cam as CSV text, a row for each cam angle, units in the heading.

    Of an analysis that covers a part of the cam it takes the ``whole``.

    >>> from camkit import DoorHandleCam
    >>> print(profile_csv(DoorHandleCam().analyse(361)).splitlines()[0])
    stretch,cam_angle_deg,pitch_x_mm,pitch_y_mm,profile_x_mm,profile_y_mm,outer_profile_x_mm,outer_profile_y_mm
    """
    return table_csv(_profile_columns(_one_cam(analysis)))


def _one_cam(analysis: Any) -> Any:
    """The whole cam, if it is one."""
    analysis = getattr(analysis, "whole", analysis)
    if np.ndim(analysis.cam_angle) > 1 or np.ndim(analysis.pitch) > 2:
        raise ValueError("this is a population; the profile of one design can be written")
    return analysis


def _profile_columns(analysis: Any) -> dict[str, Any]:
    columns = {"stretch": list(analysis.stretch), "cam_angle_deg": in_unit(analysis.profile_angle, "deg")}
    for name in ("pitch", "profile", "outer_profile"):
        for axis, values in zip("xy", getattr(analysis, name), strict=True):
            columns[f"{name}_{axis}_mm"] = in_unit(values, "mm")
    return {name: column for name, column in columns.items() if name == "stretch" or np.isfinite(column).any()}


def profile_dxf(analysis: Any) -> str:
    """The profile of a cam as a DXF drawing in mm, the cam axis at the origin, for CAD and machine tools.

    Pitch curve, profile and a groove's outer profile are polylines on layers of these names, closed where the curve
    is, through the points at which it was analysed.  Written by ezdxf.

    >>> from camkit import TranslatingRollerCam
    >>> text = profile_dxf(TranslatingRollerCam().analyse())
    >>> sum(line == "LWPOLYLINE" for line in text.splitlines())
    3
    """
    import ezdxf  # the maths does without

    analysis = _one_cam(analysis)
    drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
    for name in ("pitch", "profile", "outer_profile"):
        layer = drawing.layers.add(name.replace("_", " ")).dxf.name
        for piece in _pieces(in_unit(getattr(analysis, name), "mm").T):
            closed = bool(np.allclose(piece[0], piece[-1], atol=1e-6))
            line = piece[:-1] if closed else piece
            drawing.modelspace().add_lwpolyline(line.tolist(), close=closed, dxfattribs={"layer": layer})
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue()


def _pieces(points: np.ndarray) -> list[np.ndarray]:
    """Runs of finite points ``(n, 2)`` between gaps."""
    finite = np.isfinite(points).all(-1)
    runs = np.split(np.arange(len(points)), np.flatnonzero(np.diff(finite)) + 1)
    return [points[run] for run in runs if finite[run[0]] and len(run) > 1]
