"""Elastic trains behind any cam: their steady motion, contact loss and flight, and cams made for them."""

from .speeds import SpeedSweep, contact_loss_speed, speed_sweep
from .spring import HelicalSpring, MasslessSpring
from .steady import Response
from .trains import ElasticArm, ElasticTrain, Train, TrainChain

__all__ = [
    "ElasticArm",
    "ElasticTrain",
    "HelicalSpring",
    "MasslessSpring",
    "Response",
    "SpeedSweep",
    "Train",
    "TrainChain",
    "contact_loss_speed",
    "speed_sweep",
]
