"""Views: ``view(analysis) -> Picture``.  They compute no physics, and know numpy and units only."""

from .at_speed import (
    acceleration_beside_cam,
    cam_and_train,
    force_beside_rigid,
    force_over_speed,
    gap_and_strikes,
    spectrum_of_lift,
)
from .beside import Beside, cams_beside, curves_beside
from .cam import cam_torque, contact_force, contact_pressure, curvature, efficiency, mechanism, motion, pressure_angle
from .decision import ShownDecision, brushed_designs, front_winners, judgement_bars, winners_by_weight
from .defaults import curve_view, default_views
from .design_map import ShownPlane, design_plane, designs_on_plane, objective_plane
from .development import shapes_in_space, unrolled_cam
from .event import cam_and_follower, lift, radius_of_curvature, spring_and_inertia, stress_over_event
from .factor import factor_errors
from .front import LiveFront, ShownFront, ShownFronts, fronts_overlaid, live_pareto, pareto, searches_compared
from .intervals import contact_stress, hertz_pressure, load_over_way, stress_over_way, wear, wear_over_way
from .laws import LAW_VIEWS, ShownProgram, ShownVibration, vibration_left
from .outlines import deviation_over, laid_over, outline_deviation, outline_laid_over
from .picture import Area, Axes, Band, Circle, Contour, Line, Picture, Points, Polygon, Region, Text, View
from .progress import candidates, convergence, min_over_bound
from .shafts import drive
from .sizes import plane_of_sizes, section, utilisation
from .space import ball_joints, linkage_in_space, output_angle, pressure_angles, velocity_ratio
from .speeds import force_beside_plain, vibration_beside_plain
from .surfaces import entrainment, film_ratio
from .sweep import limit_sweep, sweep_view
from .tables import TABLE_VIEWS
from .tolerances import band, cloud, deviation, sobol_bars
from .turning import surplus_over_turn, torque_and_work, torque_over_speed

__all__ = [
    "LAW_VIEWS",
    "TABLE_VIEWS",
    "Area",
    "Axes",
    "Band",
    "Beside",
    "Circle",
    "Contour",
    "Line",
    "LiveFront",
    "Picture",
    "Points",
    "Polygon",
    "Region",
    "ShownDecision",
    "ShownFront",
    "ShownFronts",
    "ShownPlane",
    "ShownProgram",
    "ShownVibration",
    "Text",
    "View",
    "acceleration_beside_cam",
    "ball_joints",
    "band",
    "brushed_designs",
    "cam_and_follower",
    "cam_and_train",
    "cam_torque",
    "cams_beside",
    "candidates",
    "cloud",
    "contact_force",
    "contact_pressure",
    "contact_stress",
    "convergence",
    "curvature",
    "curve_view",
    "curves_beside",
    "default_views",
    "design_plane",
    "designs_on_plane",
    "deviation",
    "deviation_over",
    "drive",
    "efficiency",
    "entrainment",
    "factor_errors",
    "film_ratio",
    "force_beside_plain",
    "force_beside_rigid",
    "force_over_speed",
    "front_winners",
    "fronts_overlaid",
    "gap_and_strikes",
    "hertz_pressure",
    "judgement_bars",
    "laid_over",
    "lift",
    "limit_sweep",
    "linkage_in_space",
    "live_pareto",
    "load_over_way",
    "mechanism",
    "min_over_bound",
    "motion",
    "objective_plane",
    "outline_deviation",
    "outline_laid_over",
    "output_angle",
    "pareto",
    "plane_of_sizes",
    "pressure_angle",
    "pressure_angles",
    "radius_of_curvature",
    "searches_compared",
    "section",
    "shapes_in_space",
    "sobol_bars",
    "spectrum_of_lift",
    "spring_and_inertia",
    "stress_over_event",
    "stress_over_way",
    "surplus_over_turn",
    "sweep_view",
    "torque_and_work",
    "torque_over_speed",
    "unrolled_cam",
    "utilisation",
    "velocity_ratio",
    "vibration_beside_plain",
    "vibration_left",
    "wear",
    "wear_over_way",
    "winners_by_weight",
]
