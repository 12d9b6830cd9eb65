"""What published papers print, beside what is computed: one module for each paper."""

from . import cabin_door, door_handle, high_speed_cam, optimiser_trials, shaft, valve_cam
from .optimiser_trials import Trials, measured_trials, probability_faster, trial_table
from .published import Comparison, Row, Table

__all__ = [
    "Comparison",
    "Row",
    "Table",
    "Trials",
    "cabin_door",
    "door_handle",
    "high_speed_cam",
    "measured_trials",
    "optimiser_trials",
    "probability_faster",
    "shaft",
    "trial_table",
    "valve_cam",
]
