"""What is asked of a design: free quantities, objectives, limits; over ranges, maps and tolerances."""

from .design_map import DesignMap
from .residuals import SumOfResiduals
from .study import Evaluation, Study, WeightedSum, weighted
from .sweep import Sweep
from .tolerances import AnalysisCurve, Indices, Tolerances

__all__ = [
    "AnalysisCurve",
    "DesignMap",
    "Evaluation",
    "Indices",
    "Study",
    "SumOfResiduals",
    "Sweep",
    "Tolerances",
    "WeightedSum",
    "weighted",
]
