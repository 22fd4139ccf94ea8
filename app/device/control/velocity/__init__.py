"""Joint velocities from encoder angles: one estimator per file, chosen by name.

All of them answer a first, bad, repeated or late reading and a jump of the encoder in one way (see
`readings`), are zero at rest without subnormal numbers, and depend on nothing but their readings.
"""

from app.device.control.velocity.alpha_beta import AlphaBeta
from app.device.control.velocity.difference import BackwardDifference
from app.device.control.velocity.filtered import VelocityFilter
from app.device.control.velocity.foaw import AdaptiveWindow
from app.device.control.velocity.kalman import Kalman
from app.device.control.velocity.method import velocity_stage
from app.mechanisms.profile import DEFAULT_VELOCITY, VelocityMethod

__all__ = [
    "DEFAULT_VELOCITY",
    "AdaptiveWindow",
    "AlphaBeta",
    "BackwardDifference",
    "Kalman",
    "VelocityFilter",
    "VelocityMethod",
    "velocity_stage",
]
