"""Designs, sessions, profiles and tables as files."""

from .cells import TableQuestion
from .decisions import Decision
from .designs import Read, from_json, read, read_json, to_json, write
from .motion_tables import electronic_cam_csv, motion_csv
from .motions import read_motion
from .outlines import read_outline
from .profiles import table_csv
from .schema import json_schema
from .sessions import Session
from .workshop import (
    Blank,
    Milling,
    TitleBlock,
    ToolPath,
    Written,
    faults,
    to_workshop,
    tool_path,
    write_3mf,
    write_drawing,
    write_dxf,
    write_gcode,
    write_report,
    write_step,
    write_stl,
    write_table,
)

__all__ = [
    "Blank",
    "Decision",
    "Milling",
    "Read",
    "Session",
    "TableQuestion",
    "TitleBlock",
    "ToolPath",
    "Written",
    "electronic_cam_csv",
    "faults",
    "from_json",
    "json_schema",
    "motion_csv",
    "read",
    "read_json",
    "read_motion",
    "read_outline",
    "table_csv",
    "to_json",
    "to_workshop",
    "tool_path",
    "write",
    "write_3mf",
    "write_drawing",
    "write_dxf",
    "write_gcode",
    "write_report",
    "write_step",
    "write_stl",
    "write_table",
]
