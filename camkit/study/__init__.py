"""What is asked of a design: free quantities, objectives, limits; over ranges, maps and tolerances."""

from .design_map import DesignMap
from .failures import failures
from .recheck import Recheck
from .residuals import SumOfResiduals
from .robust import RobustStudy
from .spread import Source, Tolerance, en_10210, iso_286, iso_2768
from .study import Evaluation, Study
from .sweep import Sweep
from .tolerances import AnalysisCurve, Indices, Tolerances, general_tolerances
from .weighted import WeightedSum, weighted

__all__ = [
    "AnalysisCurve",
    "DesignMap",
    "Evaluation",
    "Indices",
    "Recheck",
    "RobustStudy",
    "Source",
    "Study",
    "SumOfResiduals",
    "Sweep",
    "Tolerance",
    "Tolerances",
    "WeightedSum",
    "en_10210",
    "failures",
    "general_tolerances",
    "iso_286",
    "iso_2768",
    "weighted",
]
