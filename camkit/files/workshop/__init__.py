"""Files for the workshop: what machines, CAD, inspection and colleagues take unseen.

Each is read back after it was written, and says how far it lies from the exact cam.
"""

from .blank import Blank
from .drawing import write_drawing
from .dxf import write_dxf
from .faults import faults
from .gcode import write_gcode
from .milling import Milling
from .package import to_workshop
from .printing import write_3mf, write_stl
from .report import write_report
from .solid import write_step
from .tables import write_table
from .title import TitleBlock
from .toolpath import ToolPath, tool_path
from .written import Written

__all__ = [
    "Blank",
    "Milling",
    "TitleBlock",
    "ToolPath",
    "Written",
    "faults",
    "to_workshop",
    "tool_path",
    "write_3mf",
    "write_drawing",
    "write_dxf",
    "write_gcode",
    "write_report",
    "write_step",
    "write_stl",
    "write_table",
]
