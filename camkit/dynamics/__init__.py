"""Elastic trains behind any cam: their steady motion, contact loss and flight, and cams made for them."""

from .camshaft import Camshaft, Windup
from .flight import Event, Flight, simulate
from .reduction import Part, Reduced, reduced, spring_part
from .speeds import SpeedSweep, contact_loss_speed, speed_sweep
from .spring import HelicalSpring, MasslessSpring
from .steady import Response
from .trains import ElasticArm, ElasticTrain, Train, TrainChain

__all__ = [
    "Camshaft",
    "ElasticArm",
    "ElasticTrain",
    "Event",
    "Flight",
    "HelicalSpring",
    "MasslessSpring",
    "Part",
    "Reduced",
    "Response",
    "SpeedSweep",
    "Train",
    "TrainChain",
    "Windup",
    "contact_loss_speed",
    "reduced",
    "simulate",
    "speed_sweep",
    "spring_part",
]
