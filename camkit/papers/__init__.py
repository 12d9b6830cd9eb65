"""What published papers print, beside what is computed: one module for each paper; sketches with their letters."""

from . import cabin_door, door_handle, high_speed_cam, high_speed_optima, optimiser_trials, shaft, valve_cam
from .optimiser_trials import Trials, measured_trials, probability_faster, trial_table
from .published import Comparison, Row, Table
from .sketch_in_space import linkage_sketch
from .sketches import flat_face_sketch, roller_cam_sketch, two_radii_sketch
from .trial_pictures import evaluations_needed, solved_within

__all__ = [
    "Comparison",
    "Row",
    "Table",
    "Trials",
    "cabin_door",
    "door_handle",
    "evaluations_needed",
    "flat_face_sketch",
    "high_speed_cam",
    "high_speed_optima",
    "linkage_sketch",
    "measured_trials",
    "optimiser_trials",
    "probability_faster",
    "roller_cam_sketch",
    "shaft",
    "solved_within",
    "trial_table",
    "two_radii_sketch",
    "valve_cam",
]
