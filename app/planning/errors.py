"""Errors of planning."""

from app.core.errors import AcusError


class PlanError(AcusError, ValueError):
    """A plan that cannot be used: incomplete, not finite, or entry and target too close."""


class MeasurementError(AcusError, ValueError):
    """A measurement that measures nothing: a point that is not finite, a region without extent."""


class MotionError(AcusError):
    """The arm cannot move as asked: out of reach, at a limit, in the way of something."""


class FulcrumError(MotionError):
    """A pivot that is not defined: the tip at the fulcrum, or a shaft too flat for the trocar."""


class PlannerMissingError(MotionError):
    """A package that plans the arm's motion is not installed."""
