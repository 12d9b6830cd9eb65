"""Files for the workshop: what machines, CAD, inspection and colleagues take unseen.

Each is read back after it was written, and says how far it lies from the exact cam.
"""

from .blank import Blank
from .faults import faults
from .package import to_workshop
from .report import write_report
from .title import TitleBlock
from .written import Written

__all__ = ["Blank", "TitleBlock", "Written", "faults", "to_workshop", "write_report"]
