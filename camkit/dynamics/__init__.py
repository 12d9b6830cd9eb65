"""Elastic trains behind any cam: their steady motion, contact loss and flight, and cams made for them."""

from .camshaft import Camshaft, Windup
from .flight import Event, Flight, simulate
from .follower import (
    ElasticFollower,
    acceleration_ratio,
    contact_loss,
    contact_margin,
    damping_ratio,
    dwell_vibration,
    dynamic_factor,
    natural_frequency,
)
from .polydyne import PolydyneProgram, polydyne
from .reduction import Part, Reduced, reduced, spring_part
from .speeds import SpeedSweep, contact_loss_speed, speed_sweep
from .spring import HelicalSpring, MasslessSpring
from .steady import Response
from .trains import ElasticArm, ElasticTrain, Train, TrainChain

__all__ = [
    "Camshaft",
    "ElasticArm",
    "ElasticFollower",
    "ElasticTrain",
    "Event",
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
    "contact_loss",
    "contact_loss_speed",
    "contact_margin",
    "damping_ratio",
    "dwell_vibration",
    "dynamic_factor",
    "natural_frequency",
    "polydyne",
    "reduced",
    "simulate",
    "speed_sweep",
    "spring_part",
]
