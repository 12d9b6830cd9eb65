"""From many designs to one: judgements, choosers, how sure a choice is, designs side by side."""

from .ahp import (
    RANDOM_INDEX,
    SAATY_SCALE,
    Judgements,
    ahp,
    random_index,
    typed_judgement,
)
from .choosers import (
    CHOOSERS,
    SCALES,
    WEIGHING,
    achievement,
    crowding_distance,
    knee,
    most_isolated,
    normalised,
    topsis,
    weighted_sum,
)
from .group import Judges, group
from .robustness import JudgementRange, WinnerMap, judgement_ranges, weight_lattice, winner_map
from .summary import SideBySide, side_by_side
from .weights import METHODS, completed, judged_weights

__all__ = [
    "CHOOSERS",
    "METHODS",
    "RANDOM_INDEX",
    "SAATY_SCALE",
    "SCALES",
    "WEIGHING",
    "JudgementRange",
    "Judgements",
    "Judges",
    "SideBySide",
    "WinnerMap",
    "achievement",
    "ahp",
    "completed",
    "crowding_distance",
    "group",
    "judged_weights",
    "judgement_ranges",
    "knee",
    "most_isolated",
    "normalised",
    "random_index",
    "side_by_side",
    "topsis",
    "typed_judgement",
    "weight_lattice",
    "weighted_sum",
    "winner_map",
]
