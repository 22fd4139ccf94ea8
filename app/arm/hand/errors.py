"""Errors of the hand."""

from app.mechanisms.errors import MechanismError


class GraspError(MechanismError):
    """The hand cannot grip what was asked for so: the message says why."""
