"""Elastic trains behind any cam: their steady motion, contact loss and flight, and cams made for them."""

from .beside_plain import CamsOverSpeed, beside_plain
from .camshaft import Camshaft, Windup
from .factor import FactorCheck, FactorRow, factor_check
from .flight import Event, Flight, simulate
from .follower import (
    ElasticFollower,
    acceleration_ratio,
    contact_loss,
    contact_loss_margin,
    contact_margin,
    damping_ratio,
    dwell_vibration,
    dynamic_factor,
    elastic_study,
    natural_frequency,
    period_ratio,
)
from .polydyne import PolydyneProgram, polydyne
from .ranges import dwell_vibration_between, min_force_between, peak_force_between
from .reduction import Part, Reduced, reduced, spring_part
from .return_springs import fitted, near_surge, return_springs, spring_duty
from .speeds import SpeedSweep, contact_loss_speed, speed_sweep
from .spring import HelicalSpring, MasslessSpring, spring_agreement
from .steady import Response
from .trains import ElasticArm, ElasticTrain, Train, TrainChain
from .tuning import tuned

__all__ = [
    "CamsOverSpeed",
    "Camshaft",
    "ElasticArm",
    "ElasticFollower",
    "ElasticTrain",
    "Event",
    "FactorCheck",
    "FactorRow",
    "Flight",
    "HelicalSpring",
    "MasslessSpring",
    "Part",
    "PolydyneProgram",
    "Reduced",
    "Response",
    "SpeedSweep",
    "Train",
    "TrainChain",
    "Windup",
    "acceleration_ratio",
    "beside_plain",
    "contact_loss",
    "contact_loss_margin",
    "contact_loss_speed",
    "contact_margin",
    "damping_ratio",
    "dwell_vibration",
    "dwell_vibration_between",
    "dynamic_factor",
    "elastic_study",
    "factor_check",
    "fitted",
    "min_force_between",
    "natural_frequency",
    "near_surge",
    "peak_force_between",
    "period_ratio",
    "polydyne",
    "reduced",
    "return_springs",
    "simulate",
    "speed_sweep",
    "spring_agreement",
    "spring_duty",
    "spring_part",
    "tuned",
]
