"""Live panels for JupyterLab: sliders on one side, pictures and numbers of the same design on the other."""

from .explore import Explorer, explore
from .judge import Judgements, judge
from .search import Search, search
from .trial import try_everything

__all__ = ["Explorer", "Judgements", "Search", "explore", "judge", "search", "try_everything"]
