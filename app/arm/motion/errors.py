"""Errors of the arm's motion."""

from app.core.errors import AcusError


class MotionError(AcusError):
    """The arm cannot move as asked: out of reach, at a limit, in the way of something."""


class FulcrumError(MotionError):
    """A pivot that is not defined: the tip at the fulcrum, or a shaft too flat for the trocar."""


class PlannerMissingError(MotionError):
    """A package that plans the arm's motion is not installed."""
