"""Files for the workshop: what machines, CAD, inspection and colleagues take unseen.

Each is read back after it was written, and says how far it lies from the exact cam.
"""

from .blank import Blank
from .title import TitleBlock
from .written import Written

__all__ = ["Blank", "TitleBlock", "Written"]
